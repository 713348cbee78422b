//! A request at work: in its turn and within its time.

use crate::answers::QUESTIONS;
use crate::body::short;
use crate::desk::{Desk, Job};
use crate::refusal::Refusal;
use crate::request::{Message, Pace, Question};
use serde_json::Value;
use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::time::Duration;
use tokio::time::timeout;

/// How long a request may wait for its turn.
const TURN: Duration = Duration::from_secs(60);

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
