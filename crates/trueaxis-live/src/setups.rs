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
    /// The zero of the plan, where none was touched.
    planned: Option<Datum>,
    known: Vec<SetupDatum>,
    now: Option<i32>,
}

impl Setups {
    /// Of a plan, with what an earlier run has left.
    pub fn new(planned: Option<Datum>, known: Vec<SetupDatum>) -> Self {
        Self { planned, known, now: None }
    }

    /// The same with what an earlier run has left.
    pub fn keep(&mut self, known: Vec<SetupDatum>) {
        *self = Self::new(self.planned.take(), known);
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
        match self.entry() {
            Some(entry) => entry.datum.as_ref(),
            None => self.planned.as_ref().filter(|_| self.now.is_none()),
        }
    }

    /// Why there is no target: the zero of this setup was never touched.
    pub fn fault(&self) -> Option<Reason> {
        let number = self.now.filter(|_| self.entry().is_none())?;
        Some(Reason::Setup { number })
    }

    fn entry(&self) -> Option<&SetupDatum> {
        self.known.iter().find(|known| known.setup == self.now)
    }

    /// What the control says now; whether it says another number than before.
    pub fn show(&mut self, number: Option<i32>) -> bool {
        if number.is_none() || number == self.now {
            return false;
        }
        let before = self.datum().cloned();
        self.now = number;
        if self.known.iter().all(|known| known.setup.is_none()) {
            self.known = vec![SetupDatum { setup: number, datum: before }];
        }
        true
    }

    /// The zero of this setup from now on.
    pub fn take(&mut self, datum: Option<Datum>) {
        self.forget();
        self.known.push(SetupDatum { setup: self.now, datum });
    }

    /// The zero of this setup is that of the plan again.
    pub fn clear(&mut self) {
        match self.now {
            Some(_) => self.take(self.planned.clone()),
            None => self.forget(),
        }
    }

    fn forget(&mut self) {
        let now = self.now;
        self.known.retain(|known| known.setup != now);
    }
}
