//! A request at work: in its turn and within its time.
//!
//! A request whose time is over, or that is not awaited any more (its window or connection is gone), gives its turn
//! back at once, and its result is dropped. The thread ends at its next report of progress; as a thread cannot be ended
//! from outside, work that reports none runs on to its end, and so many such threads are let be, no more.

use crate::answers::QUESTIONS;
use crate::body::short;
use crate::desk::{Desk, Halt, Job};
use crate::refusal::Refusal;
use crate::request::{Message, Pace, Question};
use serde_json::Value;
use std::sync::Arc;
use std::time::Duration;
use tokio::sync::Semaphore;
use tokio::time::timeout;

/// How long a request may wait for its turn.
const TURN: Duration = Duration::from_secs(60);

/// Threads whose work was given up and that still run, for each kind of request.
const GIVEN_UP: usize = 4;

/// The turns of one kind of requests.
pub(crate) struct Turns {
    /// Requests that are answered at a time.
    turns: Arc<Semaphore>,
    /// Threads that work, awaited or not.
    threads: Arc<Semaphore>,
}

impl Turns {
    pub(crate) fn of(at_a_time: usize) -> Self {
        let threads = Arc::new(Semaphore::new(at_a_time + GIVEN_UP));
        Self { turns: Arc::new(Semaphore::new(at_a_time)), threads }
    }

    /// Does a piece of work on a thread of its own when its turn comes.
    pub(crate) async fn take<T: Send + 'static>(
        &self,
        most: Duration,
        halt: &Halt,
        work: impl FnOnce() -> Result<T, Refusal> + Send + 'static,
    ) -> Result<T, Refusal> {
        // Where this future is dropped, its connection is gone.
        let mut given_up = GivenUp(Some(halt));
        let stopped = || Refusal::new(409, "stopped", "the request was given up", "ask again");
        let busy = |message| Refusal::new(503, "busy", message, "ask again later");
        let turn = tokio::select! {
            turn = timeout(TURN, self.turns.clone().acquire_owned()) => turn,
            () = halt.called() => return Err(stopped()),
        };
        let Ok(Ok(_turn)) = turn else {
            return Err(busy("too much is being computed at the moment"));
        };
        let Ok(thread) = self.threads.clone().try_acquire_owned() else {
            return Err(busy("work that was given up is still running"));
        };
        let working = tokio::task::spawn_blocking(move || {
            let _thread = thread;
            work()
        });
        let done = tokio::select! {
            done = timeout(most, working) => done,
            () = halt.called() => return Err(stopped()),
        };
        if done.is_ok() {
            given_up.0 = None;
        }
        match done {
            Ok(Ok(answer)) => answer,
            Ok(Err(_)) => {
                let hint = "please report it with the files; the server goes on";
                Err(Refusal::new(500, "failed", "the request failed inside TrueAxis", hint))
            }
            Err(_) => {
                let message = format!("this took more than {} s", most.as_secs());
                let hint = "use the command line for very long work";
                Err(Refusal::new(504, "too-long", message, hint))
            }
        }
    }
}

/// Says at its end that the work is not awaited any more, unless it was answered.
struct GivenUp<'h>(Option<&'h Halt>);

impl Drop for GivenUp<'_> {
    fn drop(&mut self) {
        if let Some(halt) = self.0 {
            halt.call();
        }
    }
}

/// An answer or a refusal, and the files of the project that were read or looked for on the way to it.
pub(crate) struct Answered {
    pub(crate) result: Result<Message, Refusal>,
    pub(crate) files_read: Vec<String>,
}

/// Answers one request on a thread of its own, in its turn and within its time.
pub(crate) async fn answer(desk: Arc<Desk>, name: &str, body: Value, job: Job) -> Answered {
    let refused = |refusal| Answered { result: Err(refusal), files_read: Vec::new() };
    worked(desk, name, body, job).await.unwrap_or_else(refused)
}

async fn worked(desk: Arc<Desk>, name: &str, body: Value, job: Job) -> Result<Answered, Refusal> {
    let Some(Question { pace, work, .. }) = QUESTIONS.iter().find(|a| a.name == name) else {
        let names: Vec<_> = QUESTIONS.iter().map(|a| a.name).collect();
        let message = format!("`{}` is not a known request", short(name));
        return Err(Refusal::new(404, "unknown-request", message, &names.join(", ")));
    };
    let (turns, most) = match pace {
        Pace::Quick => (&desk.quick, Duration::from_secs(20)),
        Pace::Long => (&desk.long, Duration::from_secs(600)),
    };
    let (halt, own) = (job.halt.clone(), desk.clone());
    let work = move || {
        let root = own.project.root();
        let (result, files_read) = trueaxis::files::noted_within(root, || work(&own, body, &job));
        Ok(Answered { result, files_read })
    };
    turns.take(most, &halt, work).await
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::mpsc::{Receiver, Sender, channel};

    fn wait<T>(work: impl Future<Output = T>) -> T {
        tokio::runtime::Builder::new_multi_thread().enable_time().build().unwrap().block_on(work)
    }

    /// Work that hangs until its other end is dropped.
    fn hanging() -> (Sender<()>, impl FnOnce() -> Result<(), Refusal> + Send + 'static) {
        let (end, hang): (Sender<()>, Receiver<()>) = channel();
        let work = move || {
            let _ = hang.recv();
            Ok(())
        };
        (end, work)
    }

    #[test]
    fn a_turn_comes_back_when_the_time_is_over() {
        wait(async {
            let (turns, short) = (Turns::of(1), Duration::from_millis(20));
            let mut ends = Vec::new();
            for given_up in 0..=GIVEN_UP {
                let (end, work) = hanging();
                ends.push(end);
                let refused = turns.take(short, &Halt::default(), work).await.unwrap_err();
                assert_eq!(refused.status, 504, "{given_up}");
                assert_eq!(turns.turns.available_permits(), 1);
                // The next one is answered though the thread of this one still hangs.
                let next = turns.take(TURN, &Halt::default(), || Ok(7)).await;
                assert_eq!(next.is_ok(), given_up < GIVEN_UP, "{given_up}");
            }
            drop(ends);
            let mut answer = Err(503);
            while answer == Err(503) {
                tokio::time::sleep(Duration::from_millis(1)).await;
                answer = turns.take(TURN, &Halt::default(), || Ok(7)).await.map_err(|r| r.status);
            }
            assert_eq!(answer, Ok(7));
        });
    }

    #[test]
    fn a_turn_comes_back_when_the_work_is_given_up() {
        wait(async {
            let turns = Arc::new(Turns::of(1));
            let halt = Halt::default();
            let (_end, work) = hanging();
            let first = tokio::spawn({
                let (turns, halt) = (turns.clone(), halt.clone());
                async move { turns.take(TURN, &halt, work).await.map_err(|r| r.status) }
            });
            // The first one is at work: only then does the second wait.
            while turns.turns.available_permits() > 0 {
                tokio::time::sleep(Duration::from_millis(1)).await;
            }
            let waits = Halt::default();
            let second = tokio::spawn({
                let (turns, waits) = (turns.clone(), waits.clone());
                async move { turns.take(TURN, &waits, || Ok(2)).await.map_err(|r| r.status) }
            });
            tokio::time::sleep(Duration::from_millis(20)).await;
            // It leaves the queue.
            waits.call();
            assert_eq!(second.await.unwrap(), Err(409));
            halt.call();
            assert_eq!(first.await.unwrap(), Err(409));
            assert_eq!(turns.take(TURN, &Halt::default(), || Ok(3)).await.ok(), Some(3));
        });
    }

    #[test]
    fn a_connection_that_goes_gives_its_work_up() {
        wait(async {
            let turns = Turns::of(1);
            let (job, (tell, told)) = (Job::new(|_| ()), channel());
            let (halt, own) = (job.halt.clone(), job.clone());
            // Work that reports its progress for ever.
            let work = move || -> Result<(), Refusal> {
                let _end = tell;
                loop {
                    own.tell(0.5);
                    std::thread::sleep(Duration::from_millis(1));
                }
            };
            let gone = timeout(Duration::from_millis(20), turns.take(TURN, &halt, work)).await;
            assert!(gone.is_err());
            // The thread has ended: its end of the channel is dropped.
            let ended: Result<(), _> = told.recv_timeout(Duration::from_secs(5));
            assert_eq!(ended, Err(std::sync::mpsc::RecvTimeoutError::Disconnected));
            assert_eq!(turns.turns.available_permits(), 1);
        });
    }
}
