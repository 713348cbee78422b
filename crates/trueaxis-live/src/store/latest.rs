//! A file that holds the latest of something. It is written beside the loop, which must not wait for a disk; what comes
//! while the disk is busy replaces what waits.

use std::path::PathBuf;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;

/// What waits, and whether more comes.
#[derive(Debug, Default)]
struct Waiting {
    text: Option<String>,
    is_over: bool,
}

/// The file; the last text is in it once this is dropped.
#[derive(Debug)]
pub(super) struct Latest {
    waiting: Arc<(Mutex<Waiting>, Condvar)>,
    writer: Option<JoinHandle<()>>,
    fault: Arc<Mutex<Option<String>>>,
}

fn locked<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Latest {
    pub fn of(path: PathBuf) -> Self {
        let waiting = Arc::new((Mutex::new(Waiting::default()), Condvar::new()));
        let fault = Arc::new(Mutex::new(None));
        let (theirs, said) = (Arc::clone(&waiting), Arc::clone(&fault));
        let writer = std::thread::spawn(move || {
            while let Some(text) = next(&theirs) {
                let written = trueaxis::files::write(&path, text.as_bytes());
                *locked(&said) = written.err().map(|error| error.to_string());
            }
        });
        Self { waiting, writer: Some(writer), fault }
    }

    /// The latest; what went wrong with an earlier one.
    pub fn put(&self, text: String) -> Result<(), String> {
        locked(&self.waiting.0).text = Some(text);
        self.waiting.1.notify_one();
        locked(&self.fault).clone().map_or(Ok(()), Err)
    }
}

/// Waits for the next text; none at the end.
fn next(waiting: &(Mutex<Waiting>, Condvar)) -> Option<String> {
    let mut held = locked(&waiting.0);
    loop {
        if let Some(text) = held.text.take() {
            return Some(text);
        }
        if held.is_over {
            return None;
        }
        held = waiting.1.wait(held).unwrap_or_else(PoisonError::into_inner);
    }
}

impl Drop for Latest {
    fn drop(&mut self) {
        locked(&self.waiting.0).is_over = true;
        self.waiting.1.notify_one();
        if let Some(writer) = self.writer.take() {
            // A writer that has panicked has nothing more to say.
            let _ = writer.join();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_text_is_in_the_file_at_the_end() {
        let path = std::env::temp_dir().join(format!("trueaxis-latest-{}", std::process::id()));
        let latest = Latest::of(path.clone());
        for i in 0..200 {
            latest.put(format!("{i}\n")).expect("written");
        }
        drop(latest);
        let text = std::fs::read_to_string(&path).expect("the file");
        std::fs::remove_file(&path).expect("removed");
        assert_eq!(text, "199\n");
    }
}
