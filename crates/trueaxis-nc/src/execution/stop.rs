//! A wish to stop, asked from another thread.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// A flag that all its clones share: whoever waits for a long run asks it to stop.
///
/// ```
/// use trueaxis_nc::{Control, NoLibrary, Program, Settings, Stop, interpret};
/// let endless = b"O1\nN1 G91 G1 X1 F100\nGOTO 1\n";
/// let program = Program::new("demo.nc", endless.to_vec(), Control::Fanuc);
/// let (stop, mut moves) = (Stop::default(), 0);
/// let settings = Settings { stop: stop.clone(), ..Settings::default() };
/// let outcome = interpret(&program, &NoLibrary, &settings, &mut |_| {
///     moves += 1;
///     stop.ask();
/// });
/// assert!(!outcome.finished && !outcome.problems.has_errors() && moves < 10);
/// ```
#[derive(Debug, Clone, Default)]
pub struct Stop(Arc<AtomicBool>);

impl Stop {
    /// Whoever looks at this flag ends its work.
    pub fn ask(&self) {
        self.0.store(true, Ordering::Relaxed);
    }

    /// Whether somebody asked.
    pub fn is_asked(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

impl From<Arc<AtomicBool>> for Stop {
    fn from(flag: Arc<AtomicBool>) -> Self {
        Self(flag)
    }
}

/// By what they say now.
impl PartialEq for Stop {
    fn eq(&self, other: &Self) -> bool {
        self.is_asked() == other.is_asked()
    }
}
