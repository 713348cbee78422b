//! What the server keeps between requests.

use crate::change::ChangeEntry;
use crate::kept::Kept;
use crate::project::Project;
use crate::simulated::Simulated;
use std::sync::atomic::AtomicBool;
use std::sync::{Arc, Mutex};
use tokio::sync::{Semaphore, broadcast};

/// Short questions that are worked on at a time; a pose never waits for a simulation.
const QUICK_AT_A_TIME: usize = 4;
/// Long ones.
const LONG_AT_A_TIME: usize = 2;

/// One request at work: where its progress goes, and whether it is still awaited.
#[derive(Clone)]
pub(crate) struct Job {
    pub(crate) stop: Arc<AtomicBool>,
    tell: Arc<dyn Fn(f64) + Send + Sync>,
}

impl Job {
    pub(crate) fn new(tell: impl Fn(f64) + Send + Sync + 'static) -> Self {
        Self { stop: Arc::default(), tell: Arc::new(tell) }
    }

    /// The part that is done, 0 to 1.
    pub(crate) fn tell(&self, done: f64) {
        (self.tell)(done);
    }
}

/// The shared desk of all windows.
pub(crate) struct Desk {
    pub(crate) project: Project,
    pub(crate) simulations: Kept<Simulated>,
    pub(crate) reports: Kept<String>,
    /// One file is saved at a time: between looking at its version and replacing it.
    pub(crate) saving: Mutex<()>,
    /// Files that were saved, for the other windows.
    pub(crate) changed: broadcast::Sender<ChangeEntry>,
    pub(crate) quick: Arc<Semaphore>,
    pub(crate) long: Arc<Semaphore>,
}

impl Desk {
    pub(crate) fn of(project: Project) -> Self {
        Self {
            project,
            simulations: Kept::of(4),
            reports: Kept::of(16),
            saving: Mutex::default(),
            changed: broadcast::channel(64).0,
            quick: Arc::new(Semaphore::new(QUICK_AT_A_TIME)),
            long: Arc::new(Semaphore::new(LONG_AT_A_TIME)),
        }
    }
}
