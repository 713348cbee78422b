//! Errors that are not listed: what every machine also has, in groups by what they follow.
//!
//! No group is looked for term by term. Each is taken as a random deviation whose size the readings show
//! ([`super::mixed`]), so that what is not in the list of unknowns enlarges the uncertainty of what is.

use super::design::Design;
use super::minimal::minimal_location_errors;
use super::term::{Basis, Shape, Term};
use crate::instruments::Readings;
use crate::instruments::drift::Walk;
use std::ops::Range;
use trueaxis_machine::axis::AxisKind;
use trueaxis_machine::errors::{Component, ErrorKind, ErrorName};

/// The usual size of an error that is not listed: 10 µm and 10 µrad. Its multiple is found from the readings.
const LENGTH_MM: f64 = 0.01;
const ANGLE_RAD: f64 = 1e-5;
/// An axis that moves less than this is taken to stand, mm and rad.
const MOVES: [f64; 2] = [1.0, 0.01];
/// Into how many pieces the time of an instrument is divided for a drift.
const PIECES: u32 = 6;
/// Readings that are closer together in time than this do not drift, s.
const SHORTEST_S: f64 = 10.0;

/// What the terms of a group follow.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Follows {
    /// Nothing: how the axes are arranged.
    Arrangement,
    /// The position of this axis.
    Axis(usize),
    /// The direction from which the axes come.
    Approach,
    /// The time.
    Time,
}

/// Terms of one kind.
#[derive(Debug, Clone, PartialEq)]
pub struct Kind {
    /// What they follow.
    pub follows: Follows,
    /// Which of the terms.
    pub range: Range<usize>,
}

/// All terms that are not among the unknowns.
#[derive(Debug, Clone, Default)]
pub struct Unlisted {
    /// The terms, kind by kind.
    pub terms: Vec<Term>,
    /// The usual size of each. Unit: mm or rad.
    pub sizes: Vec<f64>,
    /// The kinds.
    pub kinds: Vec<Kind>,
    /// Terms whose sizes are found together: kinds, but those of all linear axes are one group, and those of all rotary
    /// axes: the axes of a machine are of one quality, and a campaign says little of each.
    pub groups: Vec<Range<usize>>,
    /// The group whose size is found even if the readings could do without: walks that a campaign asks for.
    pub wanted: Option<usize>,
}

impl Unlisted {
    /// Of a design and what was read.
    pub fn of(design: &Design, readings: &Readings) -> Self {
        let mut all = Self::default();
        let axes = design.machine.axes();
        let moving: Vec<usize> = (0..axes.len()).filter(|i| moves(design, readings, *i)).collect();
        for kind in [AxisKind::Linear, AxisKind::Rotary] {
            let start = all.terms.len();
            for axis in moving.iter().filter(|i| axes[**i].kind == kind) {
                all.add(design, Follows::Axis(*axis), motions(design, *axis));
            }
            all.group(start);
        }
        let others = [
            (Follows::Arrangement, arrangement(design)),
            (Follows::Approach, reversals(design, readings, &moving)),
            (Follows::Time, drifts(design, readings, Walk::IfNeeded)),
        ];
        for (follows, terms) in others {
            let start = all.terms.len();
            all.add(design, follows, terms);
            all.group(start);
        }
        let start = all.terms.len();
        all.add(design, Follows::Time, drifts(design, readings, Walk::Always));
        all.group(start);
        all.wanted = (all.terms.len() > start).then(|| all.groups.len() - 1);
        all
    }

    /// The terms with 0 ± `times` of their usual size as prior; groups of size 0 are left out.
    pub fn with_priors(&self, times: &[f64]) -> Vec<Term> {
        let mut terms = Vec::new();
        for (group, times) in self.groups.iter().zip(times).filter(|(_, times)| **times > 0.0) {
            terms.extend(group.clone().map(|k| {
                let prior = Some((0.0, times * self.sizes[k]));
                Term { prior, ..self.terms[k] }
            }));
        }
        terms
    }

    fn add(&mut self, design: &Design, follows: Follows, terms: Vec<(Term, f64)>) {
        let start = self.terms.len();
        let listed =
            |t: &Term| design.terms.iter().any(|own| own.index == t.index && own.basis == t.basis);
        for (term, share) in terms.into_iter().filter(|(t, _)| !listed(t)) {
            let angle = term.error.component.is_rotation();
            self.sizes.push(share * if angle { ANGLE_RAD } else { LENGTH_MM });
            self.terms.push(term);
        }
        if self.terms.len() > start {
            self.kinds.push(Kind { follows, range: start..self.terms.len() });
        }
    }

    /// All terms from `start` on are one group.
    fn group(&mut self, start: usize) {
        if self.terms.len() > start {
            self.groups.push(start..self.terms.len());
        }
    }
}

fn moves(design: &Design, readings: &Readings, axis: usize) -> bool {
    let positions = readings.commands.iter().map(|c| c[axis]);
    let (low, high) = positions.fold((f64::MAX, f64::MIN), |(l, h), q| (l.min(q), h.max(q)));
    high - low > MOVES[usize::from(design.machine.axes()[axis].kind == AxisKind::Rotary)]
}

/// All six error motions of an axis: powers up to the third, or three harmonics.
fn motions(design: &Design, axis: usize) -> Vec<(Term, f64)> {
    let of = &design.machine.axes()[axis];
    let shape = Shape::parse(match of.kind {
        AxisKind::Linear => "polynomial 3",
        AxisKind::Rotary => "fourier 3",
    });
    let errors = Component::ALL.map(|component| ErrorName {
        body: of.name,
        kind: ErrorKind::Motion,
        component,
    });
    let Some(shape) = shape else { return Vec::new() };
    let terms = errors.into_iter().flat_map(|e| shape.terms(&design.machine, e));
    // Higher harmonics are smaller.
    let share = |t: &Term| match t.basis {
        Basis::Cosine(order) | Basis::Sine(order) => 1.0 / f64::from(order),
        _ => 1.0,
    };
    terms.map(|t| (t, share(&t))).collect()
}

/// The location errors that a machine needs. All others do the same as these together, and would only blur which of
/// them is which.
fn arrangement(design: &Design) -> Vec<(Term, f64)> {
    minimal_location_errors(&design.machine).into_iter().map(|t| (t, 1.0)).collect()
}

/// The two directions of approach of every axis, in its own direction.
fn reversals(design: &Design, readings: &Readings, moving: &[usize]) -> Vec<(Term, f64)> {
    let differs = |axis: usize| {
        let came = |side: f64| readings.approaches.iter().any(|a| a[axis] * side > 0.5);
        came(1.0) && came(-1.0)
    };
    let axes = moving.iter().filter(|i| differs(**i));
    let term = |i: &usize| Term::servo(&design.machine, *i, |sense| Basis::LostMotion { sense });
    axes.filter_map(term).map(|t| (t, 1.0)).collect()
}

/// How tool and workpiece drift against each other along X, Y and Z of the machine while the instruments read of which
/// this is stated.
fn drifts(design: &Design, readings: &Readings, walk: Walk) -> Vec<(Term, f64)> {
    let machine = &design.machine;
    // The body next to the bed: what is displaced there is displaced along the machine axes.
    let beside = machine.workpiece_side().min(machine.bodies().len() - 1);
    let body = machine.bodies()[beside].name;
    let mut terms = Vec::new();
    for instrument in 0..u32::try_from(design.instruments.len()).unwrap_or(0) {
        if design.instruments[instrument as usize].drift.walk != walk {
            continue;
        }
        let mine = (0..readings.len()).filter(|i| readings.instruments[*i] == instrument);
        let (from, to) = mine
            .map(|i| readings.times_s[i])
            .fold((f64::MAX, f64::MIN), |(low, high), t| (low.min(t), high.max(t)));
        let over_s = (to - from) / f64::from(PIECES);
        if over_s.is_nan() || over_s < SHORTEST_S {
            continue;
        }
        for component in [Component::X, Component::Y, Component::Z] {
            let error = ErrorName { body, kind: ErrorKind::Location, component };
            let Some(term) = Term::location(machine, error) else { continue };
            terms.extend((0..PIECES).map(|k| {
                let from_s = from + f64::from(k) * over_s;
                let basis = Basis::Ramp { instrument, from_s, over_s };
                (Term { basis, ..term }, 1.0 / f64::from(PIECES).sqrt())
            }));
        }
    }
    terms
}
