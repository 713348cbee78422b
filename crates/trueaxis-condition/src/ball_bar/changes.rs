//! Which errors of the machine file state which cause, and the machine with them changed.

use super::{BallBar, Left, location_error};
use trueaxis_machine::Machine;
use trueaxis_machine::axis::Axis;
use trueaxis_machine::errors::{
    Component, Curve, ErrorIndex, ErrorKind, ErrorName, Interpolation, Spline, StatedError,
};
use trueaxis_standards::iso230_4::Cause;

/// What a change does to an error over its axis, where x = (q − centre)/radius.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Part {
    /// The value of a location error.
    Constant,
    /// E += Δ x
    Slope,
    /// E += Δ x²
    Bow,
    /// E↑ − E↓ += Δ
    Reversal,
}

/// A part of an error that changes with a factor.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Share {
    /// The error.
    pub name: ErrorName,
    pub(super) index: ErrorIndex,
    /// Its axis, by number.
    pub(super) axis: Option<usize>,
    pub(super) part: Part,
    /// Of a change of 1 mm over the radius. Unit: 1.
    pub(super) factor: f64,
}

/// A change that states a cause.
#[derive(Debug, Clone, PartialEq)]
pub struct Change {
    /// The cause.
    pub cause: Cause,
    /// What changes.
    pub shares: Vec<Share>,
}

impl Change {
    /// The unit of the cause for 1 mm over the radius.
    pub(super) fn per_mm(&self, radius_mm: f64) -> f64 {
        if self.cause == Cause::Squareness { 1.0 / radius_mm } else { 1.0 }
    }
}

/// The changes that a circle can ask for, and the causes that no error of the file states.
pub(super) fn changes_of(machine: &Machine, bar: &BallBar<'_>) -> (Vec<Change>, Vec<Left>) {
    let (mut changes, mut left) = (Vec::new(), Vec::new());
    let axes = bar.place.axes;
    let mut put = |cause: Cause, shares: Option<Vec<Share>>, why: &str| match shares {
        Some(shares) => {
            let active = machine.active_compensation();
            match shares.iter().find(|s| active.contains(&s.name)) {
                None => changes.push(Change { cause, shares }),
                Some(share) => {
                    let why = format!(
                        "the control compensates {}: see [compensation] active",
                        share.name
                    );
                    left.push(Left { cause, why });
                }
            }
        }
        None => left.push(Left { cause, why: why.to_owned() }),
    };
    let location = location_error(machine, axes).and_then(|name| {
        let index = machine.error_index(name)?;
        let factor = 1.0 / bar.place.radius_mm;
        Some(vec![Share { name, index, axis: None, part: Part::Constant, factor }])
    });
    put(Cause::Squareness, location, "no location error of the machine states it");
    let motion = |axis: usize, of: usize, part: Part, factor: f64| {
        let component = along(&machine.axes()[axes[of]])?;
        let name =
            ErrorName { body: machine.axes()[axes[axis]].name, kind: ErrorKind::Motion, component };
        let index = machine.error_index(name)?;
        Some(Share { name, index, axis: Some(axes[axis]), part, factor })
    };
    let slanted = "its axis does not move along X, Y or Z of the machine";
    let scales = |factors: [f64; 2]| {
        let first = motion(0, 0, Part::Slope, factors[0]);
        first.zip(motion(1, 1, Part::Slope, factors[1])).map(|(a, b)| vec![a, b])
    };
    // Half to either side: what makes one axis longer than the other does not change the mean.
    put(Cause::ScaleMismatch, scales([0.25, -0.25]), slanted);
    if bar.diagnosis.is_calibrated {
        put(Cause::Size, scales([1.0, 1.0]), slanted);
    } else {
        let why = "the length of the instrument is not calibrated ([circle] length_u): only the difference of the \
                   scales is known, half of it is given to each axis";
        put(Cause::Size, None, why);
    }
    for axis in 0..2 {
        let other = 1 - axis;
        let one = |share: Option<Share>| share.map(|s| vec![s]);
        put(Cause::Backlash(axis), one(motion(axis, axis, Part::Reversal, 1.0)), slanted);
        put(Cause::LateralPlay(axis), one(motion(axis, other, Part::Reversal, 1.0)), slanted);
        put(Cause::Straightness(axis), one(motion(axis, other, Part::Bow, 1.0)), slanted);
    }
    for f in &bar.diagnosis.found {
        let why = match f.cause {
            Cause::ServoMismatch => {
                "the lag of a servo is no error of ISO 230-1: equalise the gains of the axes"
            }
            Cause::Spike(_) => {
                "sticking is no error of ISO 230-1: friction compensation of the control"
            }
            Cause::Cyclic(_) => {
                "the file has no form for an error that repeats along a linear axis but a table"
            }
            _ => continue,
        };
        left.push(Left { cause: f.cause, why: why.to_owned() });
    }
    (changes, left)
}

/// The component along a linear axis; none of one that is slanted.
fn along(axis: &Axis) -> Option<Component> {
    let is_along = |c: &Component| axis.direction[*c as usize % 3].abs() > 1.0 - 1e-9;
    [Component::X, Component::Y, Component::Z].into_iter().find(is_along)
}

/// The machine with changes in mm over the radius.
pub(super) fn apply(
    machine: &Machine,
    changes: &[Change],
    values: &[f64],
    bar: &BallBar<'_>,
) -> Machine {
    let mut machine = machine.clone();
    for (change, value) in changes.iter().zip(values) {
        for share in &change.shares {
            let old = machine.bodies()[share.index.body]
                .stated(share.index.kind, share.index.component)
                .cloned()
                .unwrap_or_else(|| StatedError::constant(0.0, None));
            let new = changed(old, share, value * share.factor, bar);
            machine = machine.with_error(share.index, Some(new));
        }
    }
    machine
}

fn changed(old: StatedError, share: &Share, value: f64, bar: &BallBar<'_>) -> StatedError {
    let (centre, radius) = (share.axis.map_or(0.0, |i| bar.place.centre[i]), bar.place.radius_mm);
    match share.part {
        Part::Constant => old.changed(1.0, value),
        Part::Reversal => {
            let reversal = match &old.reversal {
                Some(reversal) => add(reversal, &[value], 0.0, 1.0),
                None => Curve::Constant(value),
            };
            StatedError { reversal: Some(reversal), ..old }
        }
        // Nothing changes at the zero of the axis.
        Part::Slope => {
            StatedError { mean: add(&old.mean, &[0.0, value / radius], 0.0, 1.0), ..old }
        }
        Part::Bow => {
            // ((q − c)/r)² less its value at q = 0.
            let (linear, square) =
                (-2.0 * centre * value / (radius * radius), value / (radius * radius));
            StatedError { mean: add(&old.mean, &[0.0, linear, square], 0.0, 1.0), ..old }
        }
    }
}

/// A curve plus a polynomial in (q − origin)/scale.
fn add(curve: &Curve, more: &[f64], origin: f64, scale: f64) -> Curve {
    let at = |q: f64| {
        let x = (q - origin) / scale;
        more.iter().rev().fold(0.0, |sum, c| sum * x + c)
    };
    match curve {
        Curve::Constant(c) if more.len() == 1 => Curve::Constant(c + more[0]),
        Curve::Constant(c) => {
            let mut coefficients = more.to_vec();
            coefficients[0] += c;
            Curve::Polynomial { coefficients, origin, scale }
        }
        Curve::Polynomial { coefficients, origin: from, scale: by } => {
            // (q − origin)/scale = α + β z, z the argument of the curve.
            let (alpha, beta) = ((from - origin) / scale, by / scale);
            let mut sum = coefficients.clone();
            sum.resize(sum.len().max(more.len()), 0.0);
            let mut power = vec![1.0];
            for c in more {
                for (k, p) in power.iter().enumerate() {
                    sum[k] += c * p;
                }
                let mut next = vec![0.0; power.len() + 1];
                for (k, p) in power.iter().enumerate() {
                    next[k] += alpha * p;
                    next[k + 1] += beta * p;
                }
                power = next;
            }
            Curve::Polynomial { coefficients: sum, origin: *from, scale: *by }
        }
        Curve::Table { spline, outside } => {
            let values: Vec<f64> = spline.knots().iter().map(|q| spline.at(*q) + at(*q)).collect();
            let straight = is_straight(spline);
            let form = if straight { Interpolation::Linear } else { Interpolation::NotAKnot };
            match Spline::new(spline.knots(), &values, form) {
                Ok(spline) => Curve::Table { spline, outside: *outside },
                Err(_) => curve.clone(),
            }
        }
        Curve::Fourier { .. } => curve.clone(),
    }
}

/// Whether a table is read by straight lines between its rows.
pub(super) fn is_straight(spline: &Spline) -> bool {
    spline.knots().windows(2).all(|w| {
        let (from, to) = (spline.at(w[0]), spline.at(w[1]));
        let quarter = spline.at(w[0] + 0.25 * (w[1] - w[0]));
        (quarter - (from + 0.25 * (to - from))).abs() < 1e-12
    })
}
