//! Blocks of long work, prepared on several threads and taken in order.
//!
//! ```text
//!     prepare(0) prepare(1) prepare(2) …        any thread, any order, a few blocks ahead
//!          └──────────┴──────────┴──> take(0), take(1), take(2) …      one thread, in order
//! ```
//!
//! What is taken is the same for any number of threads: a block depends on its number alone.

use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};

/// So many blocks wait at most, beside those that are being prepared.
const AHEAD: usize = 16;

/// How many threads share the work: as many as there are processors, and not more than that is of use.
pub fn usual_threads() -> usize {
    std::thread::available_parallelism().map_or(1, std::num::NonZero::get).min(8)
}

struct State<T> {
    /// The next block that no thread prepares yet.
    next: usize,
    /// The block that is taken next.
    taken: usize,
    /// Blocks that are prepared, each at its number modulo [`AHEAD`].
    ready: Vec<Option<T>>,
    /// Blocks that were taken, to be filled again.
    free: Vec<T>,
    /// No more blocks are wanted, or one could not be prepared.
    stopped: bool,
}

struct Shared<'p, T> {
    state: Mutex<State<T>>,
    changed: Condvar,
    blocks: usize,
    prepare: &'p (dyn Fn(usize, &mut T) + Sync),
}

/// Stops the others if its owner ends early, even by a panic.
struct Stopping<'s, 'p, T>(&'s Shared<'p, T>);

impl<T> Drop for Stopping<'_, '_, T> {
    fn drop(&mut self) {
        self.0.lock().stopped = true;
        self.0.changed.notify_all();
    }
}

impl<T: Default> Shared<'_, T> {
    fn wait<'g>(&self, state: MutexGuard<'g, State<T>>) -> MutexGuard<'g, State<T>> {
        self.changed.wait(state).unwrap_or_else(PoisonError::into_inner)
    }

    /// The number of a block that this thread shall prepare, with the room for it.
    fn claim(&self, state: &mut State<T>) -> Option<(usize, T)> {
        let block = state.next;
        (block < self.blocks && block < state.taken + AHEAD).then(|| {
            state.next += 1;
            (block, state.free.pop().unwrap_or_default())
        })
    }

    fn prepare(&self, (block, mut item): (usize, T)) {
        (self.prepare)(block, &mut item);
        self.lock().ready[block % AHEAD] = Some(item);
        self.changed.notify_all();
    }

    fn work(&self) {
        let stopping = Stopping(self);
        let mut state = self.lock();
        while !state.stopped && state.next < self.blocks {
            match self.claim(&mut state) {
                None => state = self.wait(state),
                Some(claimed) => {
                    drop(state);
                    self.prepare(claimed);
                    state = self.lock();
                }
            }
        }
        drop(state);
        std::mem::forget(stopping);
    }

    /// The next block in order; this thread prepares blocks, too, while it is not ready.
    fn next_ready(&self) -> Option<T> {
        let mut state = self.lock();
        loop {
            let place = state.taken % AHEAD;
            if let Some(item) = state.ready[place].take() {
                return Some(item);
            }
            if state.stopped {
                return None;
            }
            state = match self.claim(&mut state) {
                None => self.wait(state),
                Some(claimed) => {
                    drop(state);
                    self.prepare(claimed);
                    self.lock()
                }
            };
        }
    }
}

impl<T> Shared<'_, T> {
    fn lock(&self) -> MutexGuard<'_, State<T>> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Prepares so many blocks on so many threads, this one included, and takes them in order on this one
/// until `take` says `false`.
///
/// `prepare` gets the number of a block and one that was taken before, to be filled again.
///
/// ```
/// use trueaxis_input::in_order;
/// let mut squares = Vec::new();
/// let square = |block: usize, room: &mut usize| *room = block * block;
/// in_order(5, 2, &square, &mut |room| {
///     squares.push(*room);
///     true
/// });
/// assert_eq!(squares, [0, 1, 4, 9, 16]);
/// ```
pub fn in_order<T: Default + Send>(
    blocks: usize,
    threads: usize,
    prepare: &(dyn Fn(usize, &mut T) + Sync),
    take: &mut dyn FnMut(&mut T) -> bool,
) {
    let ready = (0..AHEAD).map(|_| None).collect();
    let state = State { next: 0, taken: 0, ready, free: Vec::new(), stopped: false };
    let shared = Shared { state: Mutex::new(state), changed: Condvar::new(), blocks, prepare };
    std::thread::scope(|scope| {
        // Where the system gives no further thread, this one does all.
        for _ in 1..threads.min(blocks) {
            let _ = std::thread::Builder::new().spawn_scoped(scope, || shared.work());
        }
        let _stopping = Stopping(&shared);
        for _ in 0..blocks {
            let Some(mut item) = shared.next_ready() else { return };
            let goes_on = take(&mut item);
            let mut state = shared.lock();
            state.taken += 1;
            state.free.push(item);
            drop(state);
            shared.changed.notify_all();
            if !goes_on {
                return;
            }
        }
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn law_blocks_come_in_order_on_any_number_of_threads() {
        for threads in [1, 2, 3, 8] {
            for blocks in [0, 1, AHEAD, 3 * AHEAD + 1] {
                let mut taken = Vec::new();
                let prepare = |block: usize, room: &mut Vec<usize>| {
                    room.clear();
                    room.extend([block, 7 * block]);
                };
                in_order(blocks, threads, &prepare, &mut |room: &mut Vec<usize>| {
                    taken.push(room.clone());
                    true
                });
                let wanted: Vec<Vec<usize>> = (0..blocks).map(|b| vec![b, 7 * b]).collect();
                assert_eq!(taken, wanted);
            }
        }
    }

    #[test]
    fn nothing_is_taken_after_the_last_wanted_block() {
        let mut taken = 0;
        in_order(100, 3, &|block, room: &mut usize| *room = block, &mut |room| {
            taken += 1;
            *room < 10
        });
        assert_eq!(taken, 11);
    }
}
