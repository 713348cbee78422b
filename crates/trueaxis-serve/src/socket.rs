//! The socket of one window: questions as text, answers as text or binary pieces.
//!
//! ```text
//!     {"id": 7, "ask": "pose", "body": {…}}        from the page
//!     {"id": 7, "stop": true}                      nobody waits for it any more
//!     {"id": 7, "progress": 0.4}                   to the page, any number of times
//!     {"id": 7, "reply": {…}} | {"id": 7, "error": {…}} | a binary piece with "id": 7
//!     {"changed": {"path", "version", "window"}}   another window saved a file
//! ```

use crate::desk::{Desk, Job, Reply, answer};
use crate::refusal::Refusal;
use axum::extract::ws::{Message, WebSocket};
use futures_util::{SinkExt, StreamExt};
use serde_json::{Value, json};
use std::collections::HashMap;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use tokio::sync::{broadcast, mpsc};

/// Questions of one window that wait at a time.
const MOST_OPEN: usize = 32;

/// Answers that wait for a window that reads slowly; work on further ones waits for it.
const MOST_UNREAD: usize = 32;

/// The questions that are being worked on, with the flag that stops each.
#[derive(Default)]
struct Open(Mutex<HashMap<u64, Arc<AtomicBool>>>);

impl Open {
    fn lock(&self) -> MutexGuard<'_, HashMap<u64, Arc<AtomicBool>>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Serves a window until it goes.
pub(crate) async fn serve(socket: WebSocket, desk: Arc<Desk>) {
    let (mut sink, mut stream) = socket.split();
    let (out, mut queue) = mpsc::channel::<Message>(MOST_UNREAD);
    let writer = tokio::spawn(async move {
        while let Some(message) = queue.recv().await {
            if sink.send(message).await.is_err() {
                break;
            }
        }
    });
    let mut changed = desk.changed.subscribe();
    let open = Arc::new(Open::default());
    loop {
        let message = tokio::select! {
            message = stream.next() => message,
            news = changed.recv() => {
                let news = match news {
                    Ok(news) => news,
                    // So many files changed that some news is lost: look at all of them.
                    Err(broadcast::error::RecvError::Lagged(_)) => json!({ "changed": {} }),
                    Err(broadcast::error::RecvError::Closed) => break,
                };
                if out.try_send(text(&news)).is_err() && out.is_closed() { break }
                continue;
            }
        };
        match message {
            Some(Ok(Message::Text(words))) => take(&words, &desk, &out, &open).await,
            Some(Ok(Message::Binary(_))) => {
                let refusal = Refusal::bad("questions are text", r#"{"id": 1, "ask": "project"}"#);
                send(&out, json!({ "error": refusal.json() })).await;
            }
            Some(Ok(Message::Ping(_) | Message::Pong(_))) => {}
            Some(Ok(Message::Close(_)) | Err(_)) | None => break,
        }
        if out.is_closed() {
            break;
        }
    }
    // Nobody waits for what is still open.
    open.lock().values().for_each(|stop| stop.store(true, Ordering::Relaxed));
    drop(out);
    writer.abort();
}

fn text(value: &Value) -> Message {
    Message::Text(value.to_string().into())
}

/// To the window; if it is gone, nobody reads it.
async fn send(out: &mpsc::Sender<Message>, value: Value) {
    let _ = out.send(text(&value)).await;
}

/// One message of the page.
async fn take(words: &str, desk: &Arc<Desk>, out: &mpsc::Sender<Message>, open: &Arc<Open>) {
    let message: Value = serde_json::from_str(words).unwrap_or(Value::Null);
    let id = message["id"].as_u64();
    if let (Some(id), Some(true)) = (id, message["stop"].as_bool()) {
        if let Some(stop) = open.lock().get(&id) {
            stop.store(true, Ordering::Relaxed);
        }
        return;
    }
    let (Some(id), Some(name)) = (id, message["ask"].as_str()) else {
        let refusal =
            Refusal::bad("this is no question", r#"{"id": 1, "ask": "project", "body": {}}"#);
        return send(out, json!({ "id": id, "error": refusal.json() })).await;
    };
    if open.lock().len() >= MOST_OPEN {
        let refusal = Refusal::new(429, "busy", "too many open questions", "wait for an answer");
        return send(out, json!({ "id": id, "error": refusal.json() })).await;
    }
    let news = out.clone();
    // A window that is slow misses some of them, no more.
    let job = Job::new(move |done| {
        let _ = news.try_send(text(&json!({ "id": id, "progress": done })));
    });
    open.lock().insert(id, job.stop.clone());
    let body = message.get("body").cloned().unwrap_or_else(|| json!({}));
    let (desk, out, open, name) = (desk.clone(), out.clone(), open.clone(), name.to_owned());
    tokio::spawn(async move {
        let message = match answer(desk, &name, body, job).await {
            Ok(Reply::Json(value)) => text(&json!({ "id": id, "reply": value })),
            Ok(Reply::Frame(frame)) => Message::Binary(frame.bytes(Some(id)).into()),
            Err(refusal) => text(&json!({ "id": id, "error": refusal.json() })),
        };
        let _ = out.send(message).await;
        open.lock().remove(&id);
    });
}
