//! The body of a request as it comes in: so long, within so much time.

use crate::refusal::Refusal;
use axum::body::{Body, HttpBody};
use futures_util::StreamExt;
use std::time::Duration;
use tokio::time::timeout;

/// No question is longer: an NC program of a million lines fits.
pub(crate) const MOST_BYTES: usize = 64 << 20;

/// How long sending it may take.
const SENDING: Duration = Duration::from_secs(60);

/// How long nothing of it may come.
const PAUSE: Duration = Duration::from_secs(5);

/// All bytes of a body.
///
/// # Errors
/// 413 if it is too long or breaks off, 408 if it comes too slowly.
pub(crate) async fn received(body: Body) -> Result<Vec<u8>, Refusal> {
    // What is announced too long is not waited for.
    if body.size_hint().lower() > MOST_BYTES as u64 {
        return Err(too_long());
    }
    let whole = timeout(SENDING, pieces(body)).await;
    whole.unwrap_or_else(|_| Err(too_slow("the body did not come", SENDING)))
}

async fn pieces(body: Body) -> Result<Vec<u8>, Refusal> {
    let mut pieces = body.into_data_stream();
    let mut bytes = Vec::new();
    loop {
        match timeout(PAUSE, pieces.next()).await {
            Err(_) => return Err(too_slow("nothing more of the body came", PAUSE)),
            Ok(None) => return Ok(bytes),
            Ok(Some(Ok(piece))) if bytes.len() + piece.len() <= MOST_BYTES => {
                bytes.extend_from_slice(&piece);
            }
            Ok(Some(_)) => return Err(too_long()),
        }
    }
}

fn too_long() -> Refusal {
    let message = format!("the body is longer than {} MB or broke off", MOST_BYTES >> 20);
    Refusal::new(413, "too-long", message, "send less at a time")
}

fn too_slow(what: &str, limit: Duration) -> Refusal {
    let message = format!("{what} within {} s", limit.as_secs());
    Refusal::new(408, "too-slow", message, "send it faster")
}
