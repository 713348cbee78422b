//! Tolerances and the verdict of a part.

use crate::Error;
use crate::testpiece::IndexName;

/// The tolerance of one index.
#[derive(Debug, Clone, PartialEq)]
pub struct Tolerance {
    /// The index.
    pub index: IndexName,
    /// The largest permitted value, mm.
    pub limit_mm: f64,
    /// The source of the limit.
    pub source: String,
}

/// The tolerances of a test piece.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Tolerances(pub Vec<Tolerance>);

/// The decision rule: how an uncertainty U enters the decision.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Acceptance<'a> {
    /// Value ≤ tolerance passes; U is not considered.
    Simple,
    /// ISO 14253-1: passes if value + U ≤ tolerance, fails if value − U > tolerance.
    GuardBand {
        /// U = k·u of every index, in the order of the piece's index names.
        expanded_mm: &'a [f64],
    },
}

/// The outcome of a comparison with a tolerance.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Outcome {
    /// In tolerance.
    Pass,
    /// Out of tolerance.
    Fail,
    /// Nearer to the limit than the uncertainty, or without tolerance.
    Undecided,
}

impl Outcome {
    /// In one word, as in reports and JSON.
    pub fn word(self) -> &'static str {
        match self {
            Self::Pass => "pass",
            Self::Fail => "fail",
            Self::Undecided => "undecided",
        }
    }
}

/// One index against its tolerance.
#[derive(Debug, Clone, PartialEq)]
pub struct Judgement {
    /// The index.
    pub index: IndexName,
    /// The value of the index, mm.
    pub value_mm: f64,
    /// The expanded uncertainty U that was taken into account, mm.
    pub expanded_mm: Option<f64>,
    /// The tolerance, mm.
    pub limit_mm: f64,
    /// Value / tolerance: 0.25 means that a quarter of the tolerance is used up. Unit: 1.
    pub used_ratio: f64,
    /// Whether this index is in tolerance.
    pub outcome: Outcome,
}

/// All indices against their tolerances.
#[derive(Debug, Clone, PartialEq)]
pub struct Verdict {
    /// Every index that has a tolerance.
    pub judgements: Vec<Judgement>,
    /// Of the decisive ones: fail if one fails, pass if all pass.
    pub outcome: Outcome,
}

impl Tolerances {
    /// The limit of an index, if it has one.
    pub fn limit_mm(&self, key: &str) -> Option<f64> {
        self.0.iter().find(|t| t.index.key == key).map(|t| t.limit_mm)
    }

    /// Compares values with the tolerances.
    ///
    /// ```text
    /// used = value / tolerance
    /// simple:      pass ⇔ value ≤ tolerance
    /// guard band:  pass ⇔ value + U ≤ tolerance,  fail ⇔ value − U > tolerance
    /// ```
    ///
    /// Indices without a tolerance are not judged; if no decisive index has one, the verdict is
    /// undecided.
    ///
    /// # Errors
    /// Lists of different lengths; a value or uncertainty that is not finite, or is negative where
    /// it must not be.
    ///
    /// # Example
    /// ```
    /// use trueaxis_part::testpiece::cone::INDICES;
    /// use trueaxis_part::tolerance::{Acceptance, Outcome, Tolerance, Tolerances};
    /// let allowed = Tolerances(vec![Tolerance {
    ///     index: INDICES[5], limit_mm: 0.100, source: "drawing".into(),
    /// }]);
    /// let verdict = allowed.judge(&INDICES, &[0.025; 11], Acceptance::Simple)?;
    /// assert_eq!((verdict.judgements[0].used_ratio, verdict.outcome), (0.25, Outcome::Pass));
    /// let doubtful = Acceptance::GuardBand { expanded_mm: &[0.080; 11] };
    /// assert_eq!(allowed.judge(&INDICES, &[0.025; 11], doubtful)?.outcome, Outcome::Undecided);
    /// # Ok::<(), trueaxis_part::Error>(())
    /// ```
    /// # Source
    /// ISO 14253-1 (guard band); simple acceptance as in docs/conventions.md.
    pub fn judge(
        &self,
        names: &[IndexName],
        values_mm: &[f64],
        acceptance: Acceptance<'_>,
    ) -> Result<Verdict, Error> {
        same_length("values", values_mm.len(), names.len())?;
        if let Some(index) = values_mm.iter().position(|v| !v.is_finite()) {
            return Err(Error::NotFinite { index });
        }
        if let Acceptance::GuardBand { expanded_mm } = acceptance {
            same_length("expanded uncertainties", expanded_mm.len(), names.len())?;
            if let Some(index) = expanded_mm.iter().position(|u| !(u.is_finite() && *u >= 0.0)) {
                return Err(Error::NotFinite { index });
            }
        }
        let judgements: Vec<_> = self
            .0
            .iter()
            .filter_map(|tolerance| {
                let at = names.iter().position(|name| name.key == tolerance.index.key)?;
                let expanded_mm = match acceptance {
                    Acceptance::Simple => None,
                    Acceptance::GuardBand { expanded_mm } => Some(expanded_mm[at]),
                };
                Some(Judgement::new(tolerance, values_mm[at], expanded_mm))
            })
            .collect();
        let outcome = overall(&judgements);
        Ok(Verdict { judgements, outcome })
    }
}

impl Judgement {
    fn new(tolerance: &Tolerance, value_mm: f64, expanded_mm: Option<f64>) -> Self {
        let limit_mm = tolerance.limit_mm;
        let u = expanded_mm.unwrap_or(0.0);
        let outcome = if value_mm + u <= limit_mm {
            Outcome::Pass
        } else if value_mm - u > limit_mm {
            Outcome::Fail
        } else {
            Outcome::Undecided
        };
        let used_ratio = value_mm / limit_mm;
        Self { index: tolerance.index, value_mm, expanded_mm, limit_mm, used_ratio, outcome }
    }
}

fn overall(judgements: &[Judgement]) -> Outcome {
    let mut decisive = judgements.iter().filter(|j| j.index.decisive).map(|j| j.outcome).peekable();
    if decisive.peek().is_none() {
        return Outcome::Undecided;
    }
    decisive.fold(Outcome::Pass, |all, one| match (all, one) {
        (Outcome::Fail, _) | (_, Outcome::Fail) => Outcome::Fail,
        (Outcome::Undecided, _) | (_, Outcome::Undecided) => Outcome::Undecided,
        (Outcome::Pass, Outcome::Pass) => Outcome::Pass,
    })
}

fn same_length(what: &'static str, found: usize, expected: usize) -> Result<(), Error> {
    if found == expected { Ok(()) } else { Err(Error::WrongLength { what, found, expected }) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testpiece::cone::INDICES;

    fn allowed(limit_mm: f64) -> Tolerances {
        Tolerances(vec![Tolerance { index: INDICES[5], limit_mm, source: String::new() }])
    }

    #[test]
    fn guard_band_has_three_outcomes() {
        let judge = |value: f64| {
            let u = [0.010; 11];
            let acceptance = Acceptance::GuardBand { expanded_mm: &u };
            allowed(0.100).judge(&INDICES, &[value; 11], acceptance).unwrap().outcome
        };
        assert_eq!(judge(0.089), Outcome::Pass);
        assert_eq!(judge(0.091), Outcome::Undecided);
        assert_eq!(judge(0.111), Outcome::Fail);
    }

    #[test]
    fn only_decisive_indices_decide() {
        let mut paper_only = allowed(0.001);
        paper_only.0[0].index = INDICES[0];
        let verdict = paper_only.judge(&INDICES, &[1.0; 11], Acceptance::Simple).unwrap();
        assert_eq!(verdict.judgements[0].outcome, Outcome::Fail);
        assert_eq!(verdict.outcome, Outcome::Undecided);
    }
}
