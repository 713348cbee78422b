//! The last few results of one kind.

use std::collections::VecDeque;
use std::hash::{BuildHasher, RandomState};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// Results by number; the oldest goes when there are too many.
pub(crate) struct Kept<T> {
    most: usize,
    numbered: Mutex<Numbered<T>>,
}

/// Of the first number: it is written with all its digits in JSON, and in the numbers of a browser.
const BITS: u32 = 48;

struct Numbered<T> {
    last: u64,
    results: VecDeque<(u64, Arc<T>)>,
}

impl<T> Kept<T> {
    /// The numbers begin anywhere: a window that has seen a server end asks the next one for a result that is gone, not
    /// for that of another window.
    pub(crate) fn of(most: usize) -> Self {
        let last = RandomState::new().hash_one(()) >> (u64::BITS - BITS);
        Self { most, numbered: Mutex::new(Numbered { last, results: VecDeque::new() }) }
    }

    fn lock(&self) -> MutexGuard<'_, Numbered<T>> {
        // A list of finished results is sound whatever else happened.
        self.numbered.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Keeps a result; its number and the result.
    pub(crate) fn put(&self, value: T) -> (u64, Arc<T>) {
        let value = Arc::new(value);
        let mut kept = self.lock();
        kept.last += 1;
        let number = kept.last;
        kept.results.push_back((number, value.clone()));
        if kept.results.len() > self.most {
            kept.results.pop_front();
        }
        (number, value)
    }

    /// The result of a number, if it is still there.
    pub(crate) fn of_number(&self, number: u64) -> Option<Arc<T>> {
        let kept = self.lock();
        kept.results.iter().find(|(n, _)| *n == number).map(|(_, value)| value.clone())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_number_of_another_server_is_gone() {
        let before = Kept::of(2).put('a').0;
        let (now, _) = Kept::of(2).put('b');
        let later = Kept::of(2);
        let number = later.put('c').0;
        assert!(before != now && later.of_number(before).is_none());
        assert!([before, now, number].iter().all(|n| *n <= 1 << BITS));
    }

    #[test]
    fn the_oldest_goes() {
        let kept = Kept::of(2);
        let numbers = ['a', 'b', 'c'].map(|result| kept.put(result).0);
        let there = numbers.map(|n| kept.of_number(n).map(|v| *v));
        assert_eq!(there, [None, Some('b'), Some('c')]);
    }
}
