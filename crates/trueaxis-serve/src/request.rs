//! A request of the page: how it is read, answered and described.

use crate::body;
use crate::desk::{Desk, Job};
use crate::frame::{Arrays, Frame};
use crate::refusal::Refusal;
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::Value;
use std::marker::PhantomData;
use trueaxis::JsonSchema;
use trueaxis::files::disk;
use trueaxis::input::{Diagnostics, Files};
use trueaxis::questions;
use trueaxis::report::{DiagnosticEntry, document};

/// A request of the page; how it is answered stands with it.
pub(crate) trait Request: DeserializeOwned + JsonSchema {
    /// The answer: a document, or the header of a binary piece.
    type Answer<'a>: Serialize + JsonSchema;

    /// Answers it.
    fn answer(self, desk: &Desk, job: &Job) -> Result<Reply<Self>, Refusal>;
}

/// The answer to a request of one type, ready to be sent.
pub(crate) struct Reply<R> {
    message: Message,
    request: PhantomData<R>,
}

/// An answer on its way.
#[derive(Debug)]
pub(crate) enum Message {
    Json(Value),
    Frame(Frame),
}

impl<R: Request> Reply<R> {
    /// A document.
    pub(crate) fn json(answer: &R::Answer<'_>) -> Self {
        Self { message: Message::Json(document(answer)), request: PhantomData }
    }

    /// A header with its arrays.
    pub(crate) fn frame(header: &R::Answer<'_>, arrays: Arrays) -> Self {
        Self { message: Message::Frame(Frame::new(header, arrays)), request: PhantomData }
    }
}

/// Puts a question of the library; its answer, and the warnings and notes of its files.
pub(crate) fn ask<Q: questions::Question>(
    question: &Q,
    job: &Job,
) -> Result<(Q::Answer, Diagnostics), Refusal> {
    ask_with(question, &disk(), job)
}

/// The same with other files than those of the disk.
pub(crate) fn ask_with<Q: questions::Question>(
    question: &Q,
    files: &Files,
    job: &Job,
) -> Result<(Q::Answer, Diagnostics), Refusal> {
    let mut problems = Diagnostics::new();
    match questions::ask(question, files, &|part| job.tell(part), &mut problems) {
        Some(answer) => Ok((answer, problems)),
        None => Err(Refusal::unusable(&problems)),
    }
}

/// A document of the command line with the problems of its input.
#[derive(Debug, Serialize, JsonSchema)]
pub(crate) struct Diagnosed<'a, T> {
    #[serde(flatten)]
    pub(crate) document: T,
    /// The problems found in the input.
    pub(crate) diagnostics: Vec<DiagnosticEntry<'a>>,
}

/// How long a request usually takes.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Pace {
    /// Fast enough to follow a slider.
    Quick,
    /// Long enough for a progress bar.
    Long,
}

/// One kind of request.
pub(crate) struct Question {
    pub(crate) name: &'static str,
    pub(crate) pace: Pace,
    pub(crate) work: fn(&Desk, Value, &Job) -> Result<Message, Refusal>,
    #[cfg(feature = "schemas")]
    pub(crate) schemas: fn() -> [trueaxis::NamedSchema; 2],
}

/// Reads a request of one type and answers it.
pub(crate) fn work<R: Request>(desk: &Desk, body: Value, job: &Job) -> Result<Message, Refusal> {
    Ok(body::read::<R>(body)?.answer(desk, job)?.message)
}
