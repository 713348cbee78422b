//! ISO 230-2:2014: accuracy and repeatability of positioning of one axis.
//!
//! [`read`] turns a table into a [`Measurement`], [`evaluate`] that into a [`Positioning`]:
//! docs/model.md eq. 60 to 66.
//!
//! GB/T 17421.2 is the same standard; [`Others`] has the results of VDI/DGQ 3441 and of the form of
//! ASME B5.54 from the same readings.
//!
//! ```
//! use trueaxis_input::Diagnostics;
//! use trueaxis_standards::iso230_2::{Quantity, evaluate, read};
//! let table = "target_mm,run,direction,deviation_um\n0,1,up,0\n0,2,up,2\n9,1,up,4\n9,2,up,6\n";
//! let mut problems = Diagnostics::new();
//! let measured = read("x.csv", table, &mut problems).unwrap();
//! let result = evaluate(&measured, None);
//! // x̄ = 1 and 5 µm: E↑ = 4 µm
//! assert!((result.value(Quantity::EUp).unwrap() - 0.004).abs() < 1e-15);
//! ```

mod checks;
mod data;
mod others;
mod uncertainty;

pub use checks::check;
pub use data::{Direction, Measurement, Reading, Target, read, read_deviations, role_cells};
pub(super) use data::{from_sheet, warn_of_unused};
pub use others::{B554, Others, Vdi3441};
pub use uncertainty::{Budget, Share};

use trueaxis_geometry::AxisKind;

/// A figure of the axis; the clauses are those of ISO 230-2:2014.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Quantity {
    /// Bidirectional accuracy.
    A,
    /// Unidirectional accuracy, rising.
    AUp,
    /// Unidirectional accuracy, falling.
    ADown,
    /// Bidirectional repeatability.
    R,
    /// Unidirectional repeatability, rising.
    RUp,
    /// Unidirectional repeatability, falling.
    RDown,
    /// Bidirectional systematic positioning error.
    E,
    /// Unidirectional systematic positioning error, rising.
    EUp,
    /// Unidirectional systematic positioning error, falling.
    EDown,
    /// Mean bidirectional positioning error.
    M,
    /// Reversal error.
    B,
    /// Mean reversal error, signed.
    BMean,
}

impl Quantity {
    /// All of them, in the order of their places.
    pub const ALL: [Self; 12] = [
        Self::A,
        Self::AUp,
        Self::ADown,
        Self::R,
        Self::RUp,
        Self::RDown,
        Self::E,
        Self::EUp,
        Self::EDown,
        Self::M,
        Self::B,
        Self::BMean,
    ];

    /// The key in JSON, without its unit.
    pub fn key(self) -> &'static str {
        ["A", "A_up", "A_down", "R", "R_up", "R_down", "E", "E_up", "E_down", "M", "B", "B_mean"]
            [self as usize]
    }

    /// The symbol of the standard.
    pub fn symbol(self) -> &'static str {
        ["A", "A↑", "A↓", "R", "R↑", "R↓", "E", "E↑", "E↓", "M", "B", "B̄"][self as usize]
    }

    /// The name of the standard.
    pub fn title(self) -> &'static str {
        [
            "bidirectional accuracy",
            "accuracy, rising",
            "accuracy, falling",
            "bidirectional repeatability",
            "repeatability, rising",
            "repeatability, falling",
            "bidirectional systematic error",
            "systematic error, rising",
            "systematic error, falling",
            "mean bidirectional error",
            "reversal error",
            "mean reversal error",
        ][self as usize]
    }
}

/// The results of one direction at one target, mm or rad.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Approached {
    /// How many readings.
    pub count: usize,
    /// x̄, the mean deviation. Unit: mm or rad.
    pub mean: f64,
    /// s, the estimator of repeatability with n − 1; `None` for one reading. Unit: mm or rad.
    pub s: Option<f64>,
    /// The least and the largest deviation. Unit: mm or rad.
    pub extremes: [f64; 2],
}

impl Approached {
    /// docs/model.md eq. 60.
    fn of(readings: &[Reading]) -> Option<Self> {
        let count = readings.len();
        let n = count as f64;
        let deviations = || readings.iter().map(|r| r.deviation);
        if count == 0 {
            return None;
        }
        let mean = deviations().sum::<f64>() / n;
        let squares: f64 = deviations().map(|x| (x - mean) * (x - mean)).sum();
        let s = (count > 1).then(|| (squares / (n - 1.0)).sqrt());
        let low = deviations().fold(f64::INFINITY, f64::min);
        let high = deviations().fold(f64::NEG_INFINITY, f64::max);
        Some(Self { count, mean, s, extremes: [low, high] })
    }

    /// x̄ + 2s and x̄ − 2s.
    fn band(&self) -> Option<[f64; 2]> {
        self.s.map(|s| [self.mean - 2.0 * s, self.mean + 2.0 * s])
    }
}

/// The results at one target, mm or rad.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Position {
    /// The target position. Unit: mm or rad.
    pub target: f64,
    /// Rising.
    pub up: Option<Approached>,
    /// Falling.
    pub down: Option<Approached>,
}

impl Position {
    fn both(&self) -> Option<(Approached, Approached)> {
        self.up.zip(self.down)
    }

    /// Mean of both directions.
    pub fn mean(&self) -> Option<f64> {
        self.both().map(|(up, down)| 0.5 * (up.mean + down.mean))
    }

    /// B_i = x̄↑ − x̄↓; docs/model.md eq. 61.
    pub fn reversal(&self) -> Option<f64> {
        self.both().map(|(up, down)| up.mean - down.mean)
    }

    /// R_i; docs/model.md eq. 62.
    pub fn repeatability(&self) -> Option<f64> {
        let (up, down) = self.both()?;
        let (s_up, s_down) = (up.s?, down.s?);
        let spread = 2.0 * s_up + 2.0 * s_down + (up.mean - down.mean).abs();
        Some(spread.max(4.0 * s_up).max(4.0 * s_down))
    }

    /// R_i of one direction.
    pub fn repeatability_of(&self, direction: Direction) -> Option<f64> {
        Some(4.0 * self.of(direction)?.s?)
    }

    /// The results of one direction.
    pub fn of(&self, direction: Direction) -> Option<Approached> {
        match direction {
            Direction::Up => self.up,
            Direction::Down => self.down,
        }
    }
}

/// The evaluation of an axis.
#[derive(Debug, Clone, PartialEq)]
pub struct Positioning {
    /// Whether positions and deviations are mm or rad.
    pub kind: AxisKind,
    /// At every target, rising.
    pub positions: Vec<Position>,
    /// In the order of [`Quantity::ALL`]; `None` where the readings do not allow it. Unit: mm or rad.
    pub values: [Option<f64>; 12],
    /// Expanded uncertainty, k = 2. Unit: mm or rad.
    pub expanded: [Option<f64>; 12],
    /// Where the uncertainty comes from.
    pub budget: Option<Budget>,
    /// The results of other standards.
    pub others: Others,
}

impl Positioning {
    /// A figure of the axis, mm or rad.
    pub fn value(&self, quantity: Quantity) -> Option<f64> {
        self.values[quantity as usize]
    }

    /// Its expanded uncertainty (k = 2).
    pub fn expanded_of(&self, quantity: Quantity) -> Option<f64> {
        self.expanded[quantity as usize]
    }
}

/// Largest − least of what there is.
fn range(values: impl Iterator<Item = f64>) -> Option<f64> {
    let mut ends: Option<[f64; 2]> = None;
    for v in values {
        ends = Some(ends.map_or([v, v], |[low, high]| [low.min(v), high.max(v)]));
    }
    ends.map(|[low, high]| high - low)
}

fn largest(values: impl Iterator<Item = f64>) -> Option<f64> {
    values.reduce(f64::max)
}

/// The results of the axis; docs/model.md eq. 63.
fn figures(positions: &[Position]) -> [Option<f64>; 12] {
    use Direction::{Down, Up};
    let of = |d: Direction| positions.iter().filter_map(move |p| p.of(d));
    let means = |d| of(d).map(|a| a.mean);
    let bands = |d| of(d).filter_map(|a| a.band()).flatten();
    let has = |d| of(d).next().is_some();
    let spreads = |d| of(d).any(|a| a.s.is_some());
    let both = |value: Option<f64>, there: bool| value.filter(|_| there);
    let reversals = || positions.iter().filter_map(Position::reversal);
    let count = reversals().count();
    [
        both(range(bands(Up).chain(bands(Down))), spreads(Up) && spreads(Down)),
        range(bands(Up)),
        range(bands(Down)),
        largest(positions.iter().filter_map(Position::repeatability)),
        largest(positions.iter().filter_map(|p| p.repeatability_of(Up))),
        largest(positions.iter().filter_map(|p| p.repeatability_of(Down))),
        both(range(means(Up).chain(means(Down))), has(Up) && has(Down)),
        range(means(Up)),
        range(means(Down)),
        range(positions.iter().filter_map(Position::mean)),
        largest(reversals().map(f64::abs)),
        (count > 0).then(|| reversals().sum::<f64>() / count as f64),
    ]
}

/// Evaluates the readings of an axis; with `budget` also the uncertainty of every figure.
pub fn evaluate(measurement: &Measurement, budget: Option<Budget>) -> Positioning {
    let position = |t: &Target| Position {
        target: t.position,
        up: Approached::of(&t.up),
        down: Approached::of(&t.down),
    };
    let positions: Vec<Position> = measurement.targets.iter().map(position).collect();
    let values = figures(&positions);
    let expanded = match &budget {
        Some(budget) => budget.expanded(&positions, &values),
        None => [None; 12],
    };
    let others = Others::of(&positions);
    Positioning { kind: measurement.kind, positions, values, expanded, budget, others }
}

#[cfg(test)]
mod tests {
    use super::*;
    use trueaxis_input::Diagnostics;

    fn result(table: &str) -> Positioning {
        let mut problems = Diagnostics::new();
        let measured = read("t.csv", table, &mut problems).unwrap();
        evaluate(&measured, None)
    }

    #[track_caller]
    fn is(result: &Positioning, quantity: Quantity, um: Option<f64>) {
        let found = result.value(quantity).map(|v| v * 1e3);
        match (found, um) {
            (Some(a), Some(b)) if (a - b).abs() < 1e-9 => {}
            (None, None) => {}
            _ => panic!("{quantity:?}: {found:?}, not {um:?}"),
        }
    }

    const TWO: &str = "target_mm,run,direction,deviation_um\n\
        0,1,up,0\n0,2,up,2\n0,1,down,-3\n0,2,down,-3\n9,1,up,4\n9,2,up,4\n9,1,down,3\n9,2,down,1\n";

    #[test]
    fn two_targets_by_hand() {
        let r = result(TWO);
        let s = 2.0_f64.sqrt(); // of 0, 2 and of 3, 1: √((1 + 1)/1)
        // x̄↑ = 1, 4; x̄↓ = −3, 2; s↑ = √2, 0; s↓ = 0, √2; B = 4, 2
        is(&r, Quantity::A, Some((2.0 + 2.0 * s).max(4.0) + 3.0)); // top 2 + 2√2, bottom −3
        is(&r, Quantity::AUp, Some(4.0 - (1.0 - 2.0 * s)));
        is(&r, Quantity::ADown, Some(2.0 + 2.0 * s + 3.0));
        is(&r, Quantity::R, Some(2.0 * s + 4.0));
        is(&r, Quantity::RUp, Some(4.0 * s));
        is(&r, Quantity::E, Some(7.0));
        is(&r, Quantity::EUp, Some(3.0));
        is(&r, Quantity::EDown, Some(5.0));
        is(&r, Quantity::M, Some(4.0)); // (1 − 3)/2 = −1 and (4 + 2)/2 = 3
        is(&r, Quantity::B, Some(4.0));
        is(&r, Quantity::BMean, Some(3.0));
    }

    #[test]
    fn one_run_leaves_the_systematic_figures() {
        let r = result("target_mm,direction,deviation_um\n0,up,1\n0,down,0\n9,up,4\n9,down,2\n");
        is(&r, Quantity::E, Some(4.0));
        is(&r, Quantity::B, Some(2.0));
        is(&r, Quantity::A, None);
        is(&r, Quantity::R, None);
    }

    #[test]
    fn one_direction_leaves_the_unidirectional_figures() {
        let r = result("target_mm,direction,deviation_um\n0,up,1\n0,up,3\n9,up,4\n9,up,4\n");
        is(&r, Quantity::EUp, Some(2.0));
        is(&r, Quantity::RUp, Some(4.0 * 2.0_f64.sqrt()));
        for quantity in [Quantity::A, Quantity::E, Quantity::R, Quantity::M, Quantity::B] {
            is(&r, quantity, None);
        }
        is(&r, Quantity::RDown, None);
    }

    #[test]
    fn the_wide_and_the_long_table_say_the_same() {
        let wide = "target_mm,up_1_um,up_2_um,down_1_um,down_2_um\n0,0,2,-3,-3\n9,4,4,3,1\n";
        assert_eq!(result(wide), result(TWO));
    }

    /// Each figure has a key, a symbol and a name of its own; the key is the symbol in letters that a program takes.
    #[test]
    fn figures_have_names_of_their_own() {
        for of in [Quantity::key, Quantity::symbol, Quantity::title] {
            let all: std::collections::BTreeSet<&str> = Quantity::ALL.into_iter().map(of).collect();
            assert!(all.len() == 12 && !all.contains(""), "{all:?}");
        }
        for quantity in Quantity::ALL {
            let letters = quantity.symbol().replace('↑', "_up").replace('↓', "_down");
            assert_eq!(quantity.key(), letters.replace("B\u{304}", "B_mean"));
        }
    }
}
