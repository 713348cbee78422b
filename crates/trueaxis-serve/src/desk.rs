//! What the server keeps between requests.

use crate::change::ChangeEntry;
use crate::kept::Kept;
use crate::made::Made;
use crate::project::Project;
use crate::simulated::Simulated;
use crate::turn::Turns;
use std::collections::HashMap;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};
use tokio::sync::{Notify, broadcast};

/// Short questions that are worked on at a time; a pose never waits for a simulation.
const QUICK_AT_A_TIME: usize = 4;
/// Long ones.
const LONG_AT_A_TIME: usize = 2;

/// Whether a request is still awaited; whoever gives it up says so here.
#[derive(Clone, Default)]
pub(crate) struct Halt {
    /// True if it is not.
    pub(crate) flag: Arc<AtomicBool>,
    news: Arc<Notify>,
}

impl Halt {
    /// The answer is not awaited any more.
    pub(crate) fn call(&self) {
        self.flag.store(true, Ordering::Relaxed);
        self.news.notify_one();
    }

    pub(crate) fn is_called(&self) -> bool {
        self.flag.load(Ordering::Relaxed)
    }

    /// Waits until it is given up.
    pub(crate) async fn called(&self) {
        self.news.notified().await;
    }
}

/// One request at work: where its progress goes, and whether it is still awaited.
#[derive(Clone)]
pub(crate) struct Job {
    pub(crate) halt: Halt,
    tell: Arc<dyn Fn(f64) + Send + Sync>,
}

impl Job {
    pub(crate) fn new(tell: impl Fn(f64) + Send + Sync + 'static) -> Self {
        Self { halt: Halt::default(), tell: Arc::new(tell) }
    }

    /// The part that is done, 0 to 1. Work that is not awaited any more ends here: it unwinds, without the message of a
    /// panic, to the thread that it was given (`turn.rs`); on the way files that are half written vanish.
    pub(crate) fn tell(&self, done: f64) {
        if self.halt.is_called() {
            std::panic::resume_unwind(Box::new("given up"));
        }
        (self.tell)(done);
    }
}

/// A report in one form.
pub(crate) struct KeptReport {
    pub(crate) bytes: Vec<u8>,
    pub(crate) media_type: &'static str,
}

/// The shared desk of all windows.
pub(crate) struct Desk {
    pub(crate) project: Project,
    pub(crate) simulations: Kept<Simulated>,
    pub(crate) reports: Kept<KeptReport>,
    pub(crate) made: Kept<Made>,
    /// One file is saved at a time: between looking at its version and replacing it.
    pub(crate) saving: Mutex<()>,
    /// The versions of the files that the page itself has written, so that they are reported once.
    pub(crate) written: Mutex<HashMap<String, String>>,
    /// Files that were saved, for the other windows.
    pub(crate) changed: broadcast::Sender<ChangeEntry>,
    pub(crate) quick: Turns,
    pub(crate) long: Turns,
}

impl Desk {
    pub(crate) fn of(project: Project) -> Self {
        Self {
            project,
            simulations: Kept::of(4),
            reports: Kept::of(16),
            made: Kept::of(8),
            saving: Mutex::default(),
            written: Mutex::default(),
            changed: broadcast::channel(64).0,
            quick: Turns::of(QUICK_AT_A_TIME),
            long: Turns::of(LONG_AT_A_TIME),
        }
    }
}
