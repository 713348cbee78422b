//! The last few results of one kind.

use std::collections::VecDeque;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// Results by number; the oldest goes when there are too many.
pub(crate) struct Kept<T> {
    most: usize,
    inner: Mutex<(u64, VecDeque<(u64, Arc<T>)>)>,
}

impl<T> Kept<T> {
    pub(crate) fn of(most: usize) -> Self {
        Self { most, inner: Mutex::new((0, VecDeque::new())) }
    }

    fn lock(&self) -> MutexGuard<'_, (u64, VecDeque<(u64, Arc<T>)>)> {
        // A list of finished results is sound whatever happened beside it.
        self.inner.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Keeps a result; its number.
    pub(crate) fn put(&self, value: T) -> u64 {
        let mut inner = self.lock();
        inner.0 += 1;
        let number = inner.0;
        inner.1.push_back((number, Arc::new(value)));
        if inner.1.len() > self.most {
            inner.1.pop_front();
        }
        number
    }

    /// The result of a number, if it is still there.
    pub(crate) fn of_number(&self, number: u64) -> Option<Arc<T>> {
        self.lock().1.iter().find(|(n, _)| *n == number).map(|(_, value)| value.clone())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_oldest_goes() {
        let kept = Kept::of(2);
        let numbers = [kept.put('a'), kept.put('b'), kept.put('c')];
        let there = numbers.map(|n| kept.of_number(n).map(|v| *v));
        assert_eq!(there, [None, Some('b'), Some('c')]);
    }
}
