//! The last few results of one kind.

use std::collections::VecDeque;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// Results by number; the oldest goes when there are too many.
pub(crate) struct Kept<T> {
    most: usize,
    numbered: Mutex<Numbered<T>>,
}

struct Numbered<T> {
    last: u64,
    results: VecDeque<(u64, Arc<T>)>,
}

impl<T> Kept<T> {
    pub(crate) fn of(most: usize) -> Self {
        Self { most, numbered: Mutex::new(Numbered { last: 0, results: VecDeque::new() }) }
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
    fn the_oldest_goes() {
        let kept = Kept::of(2);
        let numbers = ['a', 'b', 'c'].map(|result| kept.put(result).0);
        let there = numbers.map(|n| kept.of_number(n).map(|v| *v));
        assert_eq!(there, [None, Some('b'), Some('c')]);
    }
}
