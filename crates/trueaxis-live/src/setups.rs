//! Which zero of a part counts, where a control numbers its setups: pallets, work offsets, clampings.
//!
//! ```text
//!     number ──known──> its zero counts from now on      ──never touched──> the run holds until it is touched, or cleared
//! ```
//!
//! The first number that is seen has the zero of the plan, or that of an earlier run without numbers. What a number means, the
//! builder knows: whatever changes the zero, the workpiece or how it is clamped must change it.

use crate::datum::Datum;
use crate::governor::Reason;
use serde::{Deserialize, Serialize};

/// The zero of one setup.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SetupDatum {
    /// Its number; none of a control that does not say.
    pub setup: Option<i32>,
    /// What was missing when its zero was touched; none where nothing is subtracted.
    pub datum: Option<Datum>,
}

/// All zeros of a run, and which one counts.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Setups {
    known: Vec<SetupDatum>,
    now: Option<i32>,
    is_open: bool,
}

impl Setups {
    /// Of what an earlier run has left.
    pub fn of(known: Vec<SetupDatum>) -> Self {
        Self { known, ..Self::default() }
    }

    /// All that must be kept for the next run.
    pub fn known(&self) -> &[SetupDatum] {
        &self.known
    }

    /// The number that counts; none of a control that does not say.
    pub fn now(&self) -> Option<i32> {
        self.now
    }

    /// The zero that counts.
    pub fn datum(&self) -> Option<&Datum> {
        self.entry()?.datum.as_ref()
    }

    /// Why there is no target: the zero of this setup was never touched.
    pub fn fault(&self) -> Option<Reason> {
        let number = self.now.filter(|_| self.is_open)?;
        Some(Reason::Setup { number })
    }

    fn entry(&self) -> Option<&SetupDatum> {
        self.known.iter().find(|known| known.setup == self.now)
    }

    /// What the control says now; whether another zero counts from here on.
    pub fn show(&mut self, number: Option<i32>, planned: Option<&Datum>) -> bool {
        if number.is_none() || number == self.now {
            return false;
        }
        let is_first = self.known.iter().all(|known| known.setup.is_none());
        let before = self.entry().map_or(planned.cloned(), |entry| entry.datum.clone());
        self.now = number;
        if is_first {
            self.known = vec![SetupDatum { setup: number, datum: before }];
        }
        self.is_open = self.entry().is_none();
        !is_first && !self.is_open
    }

    /// The zero of this setup from now on.
    pub fn take(&mut self, datum: Option<Datum>) {
        self.clear();
        self.known.push(SetupDatum { setup: self.now, datum });
        self.is_open = false;
    }

    /// Nothing is known of this setup but what the plan says; of a numbered one that is known, too.
    pub fn clear_to(&mut self, planned: Option<Datum>) {
        match self.now {
            Some(_) => self.take(planned),
            None => self.clear(),
        }
    }

    fn clear(&mut self) {
        let now = self.now;
        self.known.retain(|known| known.setup != now);
    }
}
