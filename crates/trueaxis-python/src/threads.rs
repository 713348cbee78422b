//! The threads that compute: one pool for each process, so that a process that was forked has threads, too.

use pyo3::exceptions::{PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};
use std::sync::{Arc, Mutex};

/// The questions recurse as on the first thread of the command, which has this stack.
const STACK_BYTES: usize = 8 << 20;

/// The pool and the process that made it.
static POOL: Mutex<Option<(u32, Arc<ThreadPool>)>> = Mutex::new(None);

/// Works with the interpreter lock released, on so many threads; without a number as many as `RAYON_NUM_THREADS`
/// says, else one for each core. The numbers that come out do not depend on it.
pub fn work<T: Send>(
    py: Python<'_>,
    threads: Option<usize>,
    work: impl FnOnce() -> T + Send,
) -> PyResult<T> {
    let pool = match threads {
        Some(count) => new_pool(count)?,
        None => usual_pool()?,
    };
    Ok(py.detach(|| pool.install(work)))
}

/// More threads than any computer has processors; each costs its stack.
const MOST_THREADS: usize = 4096;

fn new_pool(count: usize) -> PyResult<Arc<ThreadPool>> {
    if count > MOST_THREADS {
        let message = format!(
            "threads={count}: at most {MOST_THREADS}, and more than there are cores help nothing"
        );
        return Err(PyValueError::new_err(message));
    }
    let pool = ThreadPoolBuilder::new().num_threads(count).stack_size(STACK_BYTES).build();
    pool.map(Arc::new).map_err(|e| PyRuntimeError::new_err(format!("no threads: {e}")))
}

fn usual_pool() -> PyResult<Arc<ThreadPool>> {
    let process = std::process::id();
    // A lock that is held, perhaps by a thread that is not in this process, is not waited for.
    let Ok(mut held) = POOL.try_lock() else { return new_pool(0) };
    if let Some((_, pool)) = held.as_ref().filter(|(of, _)| *of == process) {
        return Ok(Arc::clone(pool));
    }
    let pool = new_pool(0)?;
    // The pool of the parent process has no threads here: it is never asked again, also not to end.
    std::mem::forget(held.replace((process, Arc::clone(&pool))));
    Ok(pool)
}
