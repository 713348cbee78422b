//! The connections of a server: so many of each stage, and the oldest goes where there are too many.
//!
//! ```text
//!     Strange ──head that may ask──> Working <──> Sending (its body comes)
//!                                       └──answered──> Idle ──next head──> Working
//! ```
//!
//! No connection waits for a place: whoever comes gets one, and a connection that has held its own longest without
//! being of use loses it. So sockets that say nothing, and bodies that trickle, cost each other their places, not the
//! page. A window (WebSocket) has left this table; its number is limited where it is opened.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use tokio::sync::Notify;

/// What a connection is doing.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Stage {
    /// It has not shown yet that it may ask.
    Strange,
    /// Its body is on the way.
    Sending,
    /// It was answered, and may ask again.
    Idle,
    /// Its request is being answered.
    Working,
}

impl Stage {
    /// How many connections of this stage there may be.
    const fn most(self) -> usize {
        match self {
            // A head comes within milliseconds of its connection.
            Self::Strange => 64,
            // Each may hold as many bytes as the longest body has.
            Self::Sending => 16,
            // A browser keeps six for a window.
            Self::Idle => 128,
            // None of them is ended: further requests are refused.
            Self::Working => 256,
        }
    }
}

/// All connections of a server.
#[derive(Debug, Clone, Default)]
pub(crate) struct Places(Arc<Mutex<Table>>);

#[derive(Debug, Default)]
struct Table {
    /// Counts every change of a stage: the smaller, the older.
    last: u64,
    open: BTreeMap<u64, Entry>,
    connections: u64,
}

#[derive(Debug)]
struct Entry {
    stage: Stage,
    since: u64,
    end: Arc<Notify>,
}

impl Places {
    fn lock(&self) -> MutexGuard<'_, Table> {
        // Every change of the table is whole.
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// A place for a connection that has just come.
    pub(crate) fn enter(&self) -> Place {
        let mut table = self.lock();
        table.connections += 1;
        let number = table.connections;
        let end = Arc::new(Notify::new());
        let entry = Entry { stage: Stage::Strange, since: 0, end: end.clone() };
        table.open.insert(number, entry);
        let place = Place { places: self.clone(), number, end };
        table.change(number, Stage::Strange);
        drop(table);
        place
    }
}

impl Table {
    /// Puts a connection into a stage; the oldest one of that stage ends if they are too many. `false` if it has ended
    /// itself.
    fn change(&mut self, number: u64, stage: Stage) -> bool {
        self.last += 1;
        let since = self.last;
        let Some(entry) = self.open.get_mut(&number) else { return false };
        (entry.stage, entry.since) = (stage, since);
        let of_stage = || self.open.iter().filter(|(_, e)| e.stage == stage);
        if stage != Stage::Working && of_stage().count() > stage.most() {
            let oldest = of_stage().min_by_key(|(_, e)| e.since).map(|(number, _)| *number);
            if let Some(entry) = oldest.and_then(|number| self.open.remove(&number)) {
                entry.end.notify_one();
            }
        }
        true
    }
}

/// The place of one connection; it is free when this is dropped.
#[derive(Debug)]
pub(crate) struct Place {
    places: Places,
    number: u64,
    end: Arc<Notify>,
}

impl Place {
    /// Goes on to another stage. `false` if too many are at work, or if this one has had to go.
    #[must_use]
    pub(crate) fn go_on(&self, stage: Stage) -> bool {
        let mut table = self.places.lock();
        let working = || table.open.values().filter(|e| e.stage == Stage::Working).count();
        if stage == Stage::Working && working() >= stage.most() {
            return false;
        }
        table.change(self.number, stage)
    }

    /// Waits until another connection needs this place.
    pub(crate) async fn ended(&self) {
        self.end.notified().await;
    }
}

impl Drop for Place {
    fn drop(&mut self) {
        self.places.lock().open.remove(&self.number);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::time::Duration;

    async fn has_ended(place: &Place) -> bool {
        tokio::time::timeout(Duration::from_millis(1), place.ended()).await.is_ok()
    }

    fn wait<T>(work: impl Future<Output = T>) -> T {
        tokio::runtime::Builder::new_current_thread().enable_time().build().unwrap().block_on(work)
    }

    #[test]
    fn the_oldest_of_a_stage_ends_and_no_other() {
        wait(async {
            let places = Places::default();
            let known = places.enter();
            assert!(known.go_on(Stage::Working) && known.go_on(Stage::Idle));
            let crowd: Vec<Place> =
                (0..Stage::Strange.most() + 2).map(|_| places.enter()).collect();
            for (i, place) in crowd.iter().enumerate() {
                assert_eq!(has_ended(place).await, i < 2, "{i}");
            }
            assert!(!has_ended(&known).await);
            // Who asks again is young again.
            assert!(crowd[2].go_on(Stage::Working));
            let _next = places.enter();
            assert!(!has_ended(&crowd[2]).await && !has_ended(&crowd[3]).await);
            let _one_more = places.enter();
            assert!(!has_ended(&crowd[2]).await && has_ended(&crowd[3]).await);
        });
    }

    #[test]
    fn a_place_comes_back() {
        let places = Places::default();
        let all: Vec<Place> = (0..Stage::Working.most()).map(|_| places.enter()).collect();
        let at_work = all.iter().filter(|place| place.go_on(Stage::Working)).count();
        // Those that had to go as strangers have no place to work from.
        assert_eq!(at_work, Stage::Strange.most());
        drop(all);
        assert!(places.lock().open.is_empty());
        let working: Vec<Place> = (0..Stage::Working.most())
            .map(|_| {
                let place = places.enter();
                assert!(place.go_on(Stage::Working));
                place
            })
            .collect();
        let further = places.enter();
        assert!(!further.go_on(Stage::Working));
        drop(working);
        assert!(further.go_on(Stage::Working));
    }
}
