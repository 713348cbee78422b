//! A request to stop, from another thread.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// A flag shared by all its clones, by which another thread ends a long run.
///
/// ```
/// use trueaxis_nc::{Control, NoLibrary, Program, Settings, Stop, interpret};
/// let endless = b"O1\nN1 G91 G1 X1 F100\nGOTO 1\n";
/// let program = Program::new("demo.nc", endless.to_vec(), Control::Fanuc);
/// let (stop, mut moves) = (Stop::default(), 0);
/// let settings = Settings { stop: stop.clone(), ..Settings::default() };
/// let outcome = interpret(&program, &NoLibrary, &settings, &mut |_| {
///     moves += 1;
///     stop.request();
/// });
/// assert!(!outcome.finished && !outcome.problems.has_errors() && moves < 10);
/// ```
#[derive(Debug, Clone, Default)]
pub struct Stop(Arc<AtomicBool>);

impl Stop {
    /// Requests the end of the run.
    pub fn request(&self) {
        self.0.store(true, Ordering::Relaxed);
    }

    /// Whether the end was requested.
    pub fn is_requested(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

impl From<Arc<AtomicBool>> for Stop {
    fn from(flag: Arc<AtomicBool>) -> Self {
        Self(flag)
    }
}

/// Equal if both have the same state now.
impl PartialEq for Stop {
    fn eq(&self, other: &Self) -> bool {
        self.is_requested() == other.is_requested()
    }
}
