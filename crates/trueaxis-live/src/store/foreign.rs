//! Files of a person in a folder that no run has made.

use super::Event;
use std::fs::File;
use std::io::{BufRead, BufReader};
use std::path::Path;

/// What a run writes over or removes.
const NAMES: [&str; 10] = [
    "state.json",
    "metrics.prom",
    "stop",
    "datum-asked",
    "history.csv",
    "history-before.csv",
    "journal.jsonl",
    "owned",
    "datum.json",
    "heat.json",
];

/// One of them, in a folder that no run has opened.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("it has a file `{0}` that no run has made")]
pub struct Foreign(pub &'static str);

/// The first of them; none where a run has been.
pub(super) fn foreign_file(folder: &Path) -> Option<Foreign> {
    let has = |name: &&str| folder.join(name).exists();
    let is_ours = folder.join("lock").exists() || has_events(folder);
    NAMES.into_iter().filter(|_| !is_ours).find(has).map(Foreign)
}

/// Whether its journal is one.
fn has_events(folder: &Path) -> bool {
    let Ok(file) = File::open(folder.join("journal.jsonl")) else { return false };
    let first = BufReader::new(file).lines().next();
    first.and_then(Result::ok).is_some_and(|line| serde_json::from_str::<Event>(&line).is_ok())
}
