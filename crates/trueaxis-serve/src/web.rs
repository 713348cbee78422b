//! The ways in: the page, requests by POST, the socket, reports, files that were made.

use crate::desk::{Desk, Job};
use crate::guard::{Guard, add_headers};
use crate::places::{Place, Stage};
use crate::refusal::{Refusal, RefusedAnswer};
use crate::request::Message;
use crate::sending::{MOST_BYTES, received};
use crate::turn::answer;
use crate::{body, page, socket};
use axum::body::{Body, Bytes};
use axum::extract::rejection::PathRejection;
use axum::extract::ws::rejection::WebSocketUpgradeRejection;
use axum::extract::{Path, Request, State, WebSocketUpgrade};
use axum::http::{StatusCode, header};
use axum::middleware::{Next, from_fn_with_state};
use axum::response::{IntoResponse, Response};
use axum::routing::{get, post};
use axum::{Extension, Router};
use serde_json::Value;
use std::sync::Arc;
use tokio::sync::Semaphore;
use trueaxis::report::document;

/// Windows at a time.
const MOST_SOCKETS: usize = 64;

#[derive(Clone)]
pub(crate) struct Shared {
    desk: Arc<Desk>,
    guard: Arc<Guard>,
    sockets: Arc<Semaphore>,
}

/// The whole server as one function from requests to answers; each connection adds its [`Place`] ([`at_place`]).
pub(crate) fn router(desk: Arc<Desk>, guard: Guard) -> Router {
    let sockets = Arc::new(Semaphore::new(MOST_SOCKETS));
    let shared = Shared { desk, guard: Arc::new(guard), sockets };
    Router::new()
        .route("/api/socket", get(open_socket))
        .route("/api/{name}", post(ask))
        .route("/report/{number}", get(report))
        .route("/made/{number}/{file}", get(made))
        .fallback(get(file).fallback(other_method))
        .method_not_allowed_fallback(other_method)
        .layer(from_fn_with_state(shared.clone(), guarded))
        .with_state(shared)
}

/// The server for one connection.
pub(crate) fn at_place(router: &Router, place: Arc<Place>) -> Router {
    router.clone().layer(Extension(place))
}

/// No one who may not ask gets past this; every answer gets its headers here.
async fn guarded(
    State(shared): State<Shared>,
    Extension(place): Extension<Arc<Place>>,
    request: Request,
    next: Next,
) -> Response {
    let path = request.uri().path();
    let (report, is_api) = (path.starts_with("/report/"), path.starts_with("/api/"));
    let guard = &shared.guard;
    let mut response = match guard.cookie(request.uri(), request.headers()) {
        Some(cookie) => {
            let to = [(header::LOCATION, "/".parse()), (header::SET_COOKIE, Ok(cookie))];
            let mut response = StatusCode::SEE_OTHER.into_response();
            for (name, value) in to {
                value.map(|value| response.headers_mut().insert(name, value)).ok();
            }
            response
        }
        None => match guard.check(request.method(), request.headers()) {
            Ok(()) if place.go_on(Stage::Working) => {
                let response = next.run(request).await;
                // Where it has had to go, no further request comes.
                let _ = place.go_on(Stage::Idle);
                response
            }
            Ok(()) => refused(&busy("too many requests are being answered")),
            Err(refusal) if refusal.status == 401 && !is_api => without_token(),
            Err(refusal) => refused(&refusal),
        },
    };
    add_headers(response.headers_mut(), report);
    response
}

/// For a person who opens the page without its link.
fn without_token() -> Response {
    let words = "This page needs its token.\n\nOpen the whole link that `trueaxis serve` printed when it started; \
                 it ends in /?token=…\nAfter a restart the link is another one.\n";
    (StatusCode::UNAUTHORIZED, words).into_response()
}

fn busy(message: &str) -> Refusal {
    Refusal::new(503, "busy", message, "ask again later")
}

async fn file(request: Request) -> Response {
    let path = request.uri().path();
    match page::file(path) {
        Some((kind, bytes)) => {
            ([(header::CONTENT_TYPE, kind)], Bytes::from_static(bytes)).into_response()
        }
        None if path == "/" && !page::is_there() => {
            let words = "This trueaxis was built without the page; POST /api/project answers.\n";
            words.into_response()
        }
        None => refused(&Refusal::new(404, "not-found", "there is nothing here", "go to /")),
    }
}

async fn other_method() -> Response {
    let hint = "POST /api/NAME with JSON; GET for the page, reports and files";
    let message = "nothing here is asked in this way";
    refused(&Refusal::new(405, "other-method", message, hint))
}

/// A path that cannot be read, such as `/report/x`.
fn no_such(error: &PathRejection) -> Response {
    refused(&Refusal::new(404, "not-found", format!("no such address: {error}"), "go to /"))
}

async fn ask(
    State(shared): State<Shared>,
    Extension(place): Extension<Arc<Place>>,
    name: Result<Path<String>, PathRejection>,
    sent: Body,
) -> Response {
    let name = match name {
        Ok(Path(name)) => name,
        Err(error) => return no_such(&error),
    };
    let _ = place.go_on(Stage::Sending);
    let bytes = match received(sent).await {
        Ok(body) => body,
        Err(refusal) => return refused(&refusal),
    };
    if !place.go_on(Stage::Working) {
        return refused(&busy("too many requests are being answered"));
    }
    let body = match body::parse(&bytes) {
        Ok(value) => value,
        Err(refusal) => return refused(&refusal),
    };
    match answer(shared.desk, &name, body, Job::new(|_| ())).await.result {
        Ok(Message::Json(value)) => json_response(StatusCode::OK, &value),
        Ok(Message::Frame(frame)) => {
            let kind = [(header::CONTENT_TYPE, "application/octet-stream")];
            (kind, frame.bytes(None, &[])).into_response()
        }
        Err(refusal) => refused(&refusal),
    }
}

async fn open_socket(
    State(shared): State<Shared>,
    upgrade: Result<WebSocketUpgrade, WebSocketUpgradeRejection>,
) -> Response {
    let upgrade = match upgrade {
        Ok(upgrade) => upgrade,
        Err(error) => {
            let message = format!("this address is that of a WebSocket: {error}");
            return refused(&Refusal::bad(message, "GET with Upgrade: websocket"));
        }
    };
    let Ok(place) = shared.sockets.clone().try_acquire_owned() else {
        let message = format!("{MOST_SOCKETS} windows are open already");
        return refused(&Refusal::new(503, "busy", message, "close one of them"));
    };
    let upgrade = upgrade.max_message_size(MOST_BYTES).max_frame_size(MOST_BYTES);
    // It listens before it is answered: what is saved between the answer and the first message counts, too.
    let changed = shared.desk.changed.subscribe();
    upgrade.on_upgrade(move |socket| async move {
        socket::serve(socket, shared.desk, changed).await;
        drop(place);
    })
}

async fn report(
    State(shared): State<Shared>,
    number: Result<Path<u64>, PathRejection>,
) -> Response {
    let number = match number {
        Ok(Path(number)) => number,
        Err(error) => return no_such(&error),
    };
    match shared.desk.reports.of_number(number) {
        Some(report) => {
            ([(header::CONTENT_TYPE, report.media_type)], report.bytes.clone()).into_response()
        }
        None => {
            let message = "this report is not kept any more";
            refused(&Refusal::new(404, "no-report", message, "make it again"))
        }
    }
}

/// A file that an answer made, as it would be written.
async fn made(
    State(shared): State<Shared>,
    made: Result<Path<(u64, usize)>, PathRejection>,
) -> Response {
    let (number, file) = match made {
        Ok(Path(made)) => made,
        Err(error) => return no_such(&error),
    };
    match shared.desk.made_file(number, file, |_, file| file.content.clone()) {
        Ok(content) => {
            let kind = [
                (header::CONTENT_TYPE, "application/octet-stream"),
                (header::CONTENT_DISPOSITION, "attachment"),
            ];
            (kind, content).into_response()
        }
        Err(refusal) => refused(&refusal),
    }
}

fn json_response(status: StatusCode, value: &Value) -> Response {
    let kind = [(header::CONTENT_TYPE, "application/json")];
    (status, kind, value.to_string()).into_response()
}

fn refused(refusal: &Refusal) -> Response {
    let status = StatusCode::from_u16(refusal.status).unwrap_or(StatusCode::BAD_REQUEST);
    json_response(status, &document(&RefusedAnswer { error: refusal.entry() }))
}
