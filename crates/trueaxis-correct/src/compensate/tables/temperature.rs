//! What an axis has to add because of the temperature: a straight line beside its table.
//!
//! ```text
//!     c(q; T) − c(q; cold) ≈ offset + slope·(q − reference)        least squares over the travel
//! ```
//!
//! docs/model.md eq. 331. The tables stay those of the temperatures at which the machine was measured.

use super::TablesError;
use super::content::{Content, Line};
use super::control::{Control, range};
use super::lever::Lever;
use super::table::{count_of, counts};
use trueaxis_machine::Machine;
use trueaxis_machine::axis::Command;

/// A count of a slope.
const SLOPE: f64 = 1e-9;
/// Places over the travel.
const LOOKS: i64 = 64;
/// The least increment of an offset, counts: 0.1 µm.
const INCREMENT: f64 = 100.0;

impl Line {
    /// What is added at a position, counts.
    pub fn at(&self, position: f64) -> f64 {
        self.offset as f64 + self.slope as f64 * SLOPE * (position - self.reference as f64)
    }

    /// The same with the other sign.
    pub fn negated(&self) -> Self {
        Self { offset: -self.offset, slope: -self.slope, ..*self }
    }
}

/// A line for each axis that grows, from the machine at its temperatures and without them.
///
/// # Errors
/// A position that an error table does not cover, or an axis without travel.
pub fn lines(
    (warm, cold): (&Machine, &Machine),
    reference: &Command,
    control: &dyn Control,
) -> Result<Vec<Line>, TablesError> {
    let (hot, still) = (Lever::new(warm, *reference)?, Lever::new(cold, *reference)?);
    let mut lines = Vec::new();
    for axis in 0..warm.axes().len() {
        let ((from, to), _) = range(&warm.axes()[axis], control)?;
        let mut looks = Vec::new();
        for i in 0..=LOOKS {
            let at = from + (i128::from(to - from) * i128::from(i) / i128::from(LOOKS)) as i64;
            let q = at as f64 * count_of(warm, axis);
            let grown = hot.functions(axis, q, 0.0)?[axis] - still.functions(axis, q, 0.0)?[axis];
            looks.push((at as f64, counts(warm, axis, grown)));
        }
        lines.extend(fitted(axis, &looks));
    }
    Ok(lines)
}

/// The least-squares line; none where it is below half an increment everywhere.
fn fitted(axis: usize, looks: &[(f64, f64)]) -> Option<Line> {
    let n = looks.len() as f64;
    let [x, y] = looks.iter().fold([0.0; 2], |[a, b], (x, y)| [a + x / n, b + y / n]);
    let xx: f64 = looks.iter().map(|(a, _)| (a - x).powi(2)).sum();
    let xy: f64 = looks.iter().map(|(a, b)| (a - x) * (b - y)).sum();
    let slope = (xy / xx / SLOPE).round();
    let reference = x.round();
    let offset = ((y + slope * SLOPE * (reference - x)) / INCREMENT).round() * INCREMENT;
    let line =
        Line { axis, reference: reference as i64, offset: offset as i64, slope: slope as i64 };
    let ends = [looks.first()?.0, looks.last()?.0];
    ends.iter().any(|at| line.at(*at).abs() >= 0.5 * INCREMENT).then_some(line)
}

/// Adds what all lines add, mm or rad.
pub fn add(machine: &Machine, content: &Content, command: &Command, added: &mut Command) {
    for line in &content.lines {
        let value = line.at(counts(machine, line.axis, command[line.axis]));
        added[line.axis] += value * count_of(machine, line.axis);
    }
}
