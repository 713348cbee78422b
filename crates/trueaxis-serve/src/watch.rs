//! Files of the project that other programs write: the open windows learn of it within a second.

use crate::change::ChangeEntry;
use crate::desk::Desk;
use std::collections::BTreeMap;
use std::sync::{Arc, PoisonError, Weak};
use std::time::Duration;

const EVERY: Duration = Duration::from_millis(700);
/// Where more files change at once, any file may have changed.
const MOST_CHANGES: usize = 32;

/// What tells that a file may have changed, by its path.
pub(crate) type Stamps = BTreeMap<String, u64>;

/// Looks as long as the desk is there; only while a window is open.
pub(crate) fn watch(desk: &Arc<Desk>) {
    let desk = Arc::downgrade(desk);
    std::thread::spawn(move || look(&desk));
}

fn look(desk: &Weak<Desk>) {
    let mut before: Option<Stamps> = None;
    loop {
        std::thread::sleep(EVERY);
        let Some(desk) = desk.upgrade() else { return };
        let is_open = desk.changed.receiver_count() > 0;
        let now = is_open.then(|| desk.project.stamps());
        if let (Some(before), Some(now)) = (&before, &now) {
            tell(&desk, &differing(before, now));
        }
        before = now;
    }
}

/// The files that are new, gone or other.
fn differing(before: &Stamps, now: &Stamps) -> Vec<String> {
    let gone = before.keys().filter(|path| !now.contains_key(*path));
    let other = now.iter().filter(|(path, stamp)| before.get(*path) != Some(*stamp));
    gone.chain(other.map(|(path, _)| path)).cloned().collect()
}

fn tell(desk: &Desk, paths: &[String]) {
    let changes: Vec<ChangeEntry> = match paths.len() {
        n if n > MOST_CHANGES => vec![ChangeEntry::default()],
        _ => paths.iter().filter_map(|path| change(desk, path)).collect(),
    };
    for change in changes {
        // It fails if the last window was closed meanwhile.
        let _ = desk.changed.send(change);
    }
}

/// None where the page itself has written what is there.
fn change(desk: &Desk, path: &str) -> Option<ChangeEntry> {
    let version = desk.project.version_of(path);
    let written = desk.written.lock().unwrap_or_else(PoisonError::into_inner);
    if version.is_some() && written.get(path) == version.as_ref() {
        return None;
    }
    Some(ChangeEntry { path: Some(path.to_owned()), version, window: None })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn new_gone_and_other_files_differ() {
        let stamps = |list: &[(&str, u64)]| -> Stamps {
            list.iter().map(|(path, stamp)| ((*path).to_owned(), *stamp)).collect()
        };
        let before = stamps(&[("a", 1), ("b", 1), ("c", 1)]);
        let now = stamps(&[("b", 2), ("c", 1), ("d", 1)]);
        assert_eq!(differing(&before, &now), ["a", "b", "d"]);
        assert!(differing(&now, &now).is_empty());
    }
}
