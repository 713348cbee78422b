//! What the server keeps between requests, and how it works on one.

use crate::answers::{ChangeEntry, Message, Pace, QUESTIONS, Question};
use crate::body::short;
use crate::kept::Kept;
use crate::project::Project;
use crate::refusal::Refusal;
use serde_json::Value;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};
use std::time::Duration;
use tokio::sync::{Semaphore, broadcast};
use tokio::time::timeout;

/// Short questions that are worked on at a time; a pose never waits behind a simulation.
const QUICK_AT_A_TIME: usize = 4;
/// Long ones.
const LONG_AT_A_TIME: usize = 2;
/// How long a request may wait for its turn.
const TURN: Duration = Duration::from_secs(60);

/// One request at work: whom to tell, and whether anybody still waits for it.
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
    pub(crate) simulations: Kept<crate::answers::Simulated>,
    pub(crate) reports: Kept<String>,
    /// One file is saved at a time: between looking at its version and replacing it.
    pub(crate) saving: Mutex<()>,
    /// Files that were saved, for the other windows.
    pub(crate) changed: broadcast::Sender<ChangeEntry>,
    quick: Arc<Semaphore>,
    long: Arc<Semaphore>,
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

/// Answers one request on a thread of its own, in its turn and within its time.
pub(crate) async fn answer(
    desk: Arc<Desk>,
    name: &str,
    body: Value,
    job: Job,
) -> Result<Message, Refusal> {
    let Some(Question { pace, work, .. }) = QUESTIONS.iter().find(|a| a.name == name) else {
        let names: Vec<_> = QUESTIONS.iter().map(|a| a.name).collect();
        let message = format!("`{}` is not a known request", short(name));
        return Err(Refusal::new(404, "unknown-request", message, &names.join(", ")));
    };
    let (turns, most) = match pace {
        Pace::Quick => (&desk.quick, Duration::from_secs(20)),
        Pace::Long => (&desk.long, Duration::from_secs(600)),
    };
    let Ok(Ok(turn)) = timeout(TURN, turns.clone().acquire_owned()).await else {
        let message = "too much is being computed at the moment";
        return Err(Refusal::new(503, "busy", message, "ask again later"));
    };
    let stop = job.stop.clone();
    let working = tokio::task::spawn_blocking(move || {
        let _turn = turn;
        trueaxis::files::within(desk.project.root(), || work(&desk, body, &job))
    });
    match timeout(most, working).await {
        Ok(Ok(answer)) => answer,
        Ok(Err(_)) => {
            let hint = "please report it with the files; the server goes on";
            Err(Refusal::new(500, "failed", "the request failed inside TrueAxis", hint))
        }
        Err(_) => {
            stop.store(true, Ordering::Relaxed);
            let message = format!("this took more than {} s", most.as_secs());
            Err(Refusal::new(504, "too-long", message, "use the command line for very long work"))
        }
    }
}
