//! The socket of one window: questions as text, answers as text or binary pieces.
//!
//! ```text
//!     {"id": 7, "ask": "pose", "body": {…}}        from the page
//!     {"id": 7, "stop": true}                      the answer is not awaited any more
//!     {"id": 7, "progress": 0.4}                   to the page, any number of times
//!     {"id": 7, "reply": {…}} | {"id": 7, "error": {…}} | a binary piece with "id": 7, each with "files_read"
//!     {"changed": {"path", "version", "window"}}   another window saved a file
//! ```

use crate::body;
use crate::change::ChangeEntry;
use crate::desk::{Desk, Halt, Job};
use crate::refusal::{Refusal, RefusalEntry};
use crate::request::Message as Answer;
use crate::turn::{Answered, answer};
use axum::extract::ws::{Message, WebSocket};
use futures_util::{SinkExt, StreamExt};
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::collections::HashMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use tokio::sync::{broadcast, mpsc};
use trueaxis::JsonSchema;
use trueaxis::report::document;

/// What a window sends: a request, or that it no longer waits for one.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct SocketRequest {
    /// The number of the request, chosen by the page; its answers have the same.
    id: u64,
    /// The name of the request, such as `pose`.
    ask: Option<String>,
    /// The request.
    body: Option<Value>,
    /// True if the answer is not awaited any more.
    stop: Option<bool>,
}

/// What a window receives as text; answers with arrays are binary.
#[derive(Serialize, JsonSchema)]
#[serde(untagged)]
pub(crate) enum SocketAnswer<'a> {
    /// How much of the work is done.
    Progress {
        /// The number of the request.
        id: u64,
        /// The share that is done, 0 to 1.
        progress: f64,
    },
    /// The answer.
    Reply {
        /// The number of the request.
        id: u64,
        /// The document; its type depends on the request.
        reply: &'a Value,
        /// The files below the project folder that were read or looked for: where one of them changes, so may the answer.
        files_read: &'a [String],
    },
    /// The request is refused.
    Error {
        /// The number of the request; null if it could not be read.
        id: Option<u64>,
        /// Why.
        error: RefusalEntry<'a>,
        /// The files below the project folder that were read or looked for.
        files_read: &'a [String],
    },
    /// A file was saved, perhaps by another window.
    Changed {
        /// Which; without a path any file may have changed.
        changed: ChangeEntry,
    },
}

impl SocketAnswer<'_> {
    fn message(&self) -> Message {
        Message::Text(document(self).to_string().into())
    }
}

/// Questions of one window that wait at a time.
const MOST_OPEN: usize = 32;

/// Answers that wait for a window that reads slowly; work on further ones waits for it.
const MOST_UNREAD: usize = 32;

/// The questions that are being worked on, and where each is given up.
#[derive(Default)]
struct Open(Mutex<HashMap<u64, Halt>>);

impl Open {
    fn lock(&self) -> MutexGuard<'_, HashMap<u64, Halt>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Serves a window until it goes; it learns of every file that is sent to `changed`.
pub(crate) async fn serve(
    socket: WebSocket,
    desk: Arc<Desk>,
    mut changed: broadcast::Receiver<ChangeEntry>,
) {
    let (mut sink, mut stream) = socket.split();
    let (out, mut queue) = mpsc::channel::<Message>(MOST_UNREAD);
    let writer = tokio::spawn(async move {
        while let Some(message) = queue.recv().await {
            if sink.send(message).await.is_err() {
                break;
            }
        }
    });
    let open = Arc::new(Open::default());
    loop {
        let message = tokio::select! {
            message = stream.next() => message,
            news = changed.recv() => {
                let changed = match news {
                    Ok(change) => change,
                    // So many files changed that some changes are lost: any file may have changed.
                    Err(broadcast::error::RecvError::Lagged(_)) => ChangeEntry::default(),
                    Err(broadcast::error::RecvError::Closed) => break,
                };
                let news = SocketAnswer::Changed { changed }.message();
                if out.try_send(news).is_err() && out.is_closed() { break }
                continue;
            }
        };
        match message {
            Some(Ok(Message::Text(words))) => take(&words, &desk, &out, &open).await,
            Some(Ok(Message::Binary(_))) => {
                let refusal = Refusal::bad("questions are text", r#"{"id": 1, "ask": "project"}"#);
                refuse(&out, None, &refusal).await;
            }
            Some(Ok(Message::Ping(_) | Message::Pong(_))) => {}
            Some(Ok(Message::Close(_)) | Err(_)) | None => break,
        }
        if out.is_closed() {
            break;
        }
    }
    // What is still open is not awaited any more.
    open.lock().values().for_each(Halt::call);
    drop(out);
    writer.abort();
}

/// To the window; if it is gone, it is not read.
async fn refuse(out: &mpsc::Sender<Message>, id: Option<u64>, refusal: &Refusal) {
    let _ = out
        .send(SocketAnswer::Error { id, error: refusal.entry(), files_read: &[] }.message())
        .await;
}

/// One message of the page.
async fn take(words: &str, desk: &Arc<Desk>, out: &mpsc::Sender<Message>, open: &Arc<Open>) {
    let message = match body::parse(words.as_bytes()) {
        Ok(message) => message,
        Err(refusal) => {
            // Whose answer it would be, where that can be read all the same.
            let message: Value = serde_json::from_str(words).unwrap_or(Value::Null);
            return refuse(out, message["id"].as_u64(), &refusal).await;
        }
    };
    let id = message["id"].as_u64();
    let (id, name, body) = match body::read::<SocketRequest>(message) {
        Ok(SocketRequest { id, stop: Some(true), .. }) => {
            if let Some(stop) = open.lock().get(&id) {
                stop.call();
            }
            return;
        }
        Ok(SocketRequest { id, ask: Some(name), body, .. }) => (id, name, body),
        Ok(_) => {
            let example = r#"{"id": 1, "ask": "project", "body": {}}"#;
            return refuse(out, id, &Refusal::bad("missing field `ask`", example)).await;
        }
        Err(refusal) => return refuse(out, id, &refusal).await,
    };
    if open.lock().len() >= MOST_OPEN {
        let refusal = Refusal::new(429, "busy", "too many open questions", "wait for an answer");
        return refuse(out, Some(id), &refusal).await;
    }
    let news = out.clone();
    // A window that is slow misses some of them, no more.
    let job = Job::new(move |progress| {
        let _ = news.try_send(SocketAnswer::Progress { id, progress }.message());
    });
    open.lock().insert(id, job.halt.clone());
    let body = body.unwrap_or_else(|| Value::Object(serde_json::Map::new()));
    let (desk, out, open) = (desk.clone(), out.clone(), open.clone());
    tokio::spawn(async move {
        let Answered { result, files_read } = answer(desk, &name, body, job).await;
        let files_read = &*files_read;
        let message = match result {
            Ok(Answer::Json(reply)) => {
                SocketAnswer::Reply { id, reply: &reply, files_read }.message()
            }
            Ok(Answer::Frame(frame)) => Message::Binary(frame.bytes(Some(id), files_read).into()),
            Err(refusal) => {
                let error = refusal.entry();
                SocketAnswer::Error { id: Some(id), error, files_read }.message()
            }
        };
        let _ = out.send(message).await;
        open.lock().remove(&id);
    });
}
