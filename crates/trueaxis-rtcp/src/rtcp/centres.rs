//! The rotary centres of a machine: which offsets there are to find, and what they move.
//!
//! ```text
//!     tip(q) = tip₀(q) + Σ x_j v_j(q)          v_j: twist of a shift, eq. 103      docs/model.md eq. 131
//! ```
//!
//! A shift turns nothing, so that the tip is linear in all offsets together, without any remainder.

use nalgebra::DVector;
use trueaxis_geometry::Vec3;
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{AxisKind, Command, Travel};
use trueaxis_machine::errors::{Component, ErrorIndex, ErrorKind, ErrorName, ErrorValues};
use trueaxis_machine::twist::Reference;
use trueaxis_measure::unknowns::term::Term;

/// An offset that is seen less than this beside those before it does what they do.
const NOTHING: f64 = 1e-9;
/// How many poses are used to separate offsets.
const POSES: usize = 48;
/// A component of an offset that lies along its own axis by more than this only slides on it.
const ALONG: f64 = 0.9;

/// Where the two rotary axes stand.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Topology {
    /// Both carry the workpiece: `w C' A' b X Y Z t`.
    TableTable,
    /// Both carry the tool: `w b X Y Z C A t`.
    HeadHead,
    /// One each: `w C' b X Y Z B t`.
    Mixed,
}

impl Topology {
    /// In text output.
    pub fn words(self) -> &'static str {
        match self {
            Self::TableTable => "two rotary axes in the table",
            Self::HeadHead => "two rotary axes in the head",
            Self::Mixed => "one rotary axis in the table, one in the head",
        }
    }

    /// For programs.
    pub fn key(self) -> &'static str {
        match self {
            Self::TableTable => "table-table",
            Self::HeadHead => "head-head",
            Self::Mixed => "mixed",
        }
    }
}

/// The unknown centres of a machine with two rotary axes.
#[derive(Debug, Clone, PartialEq)]
pub struct Centres {
    /// Where the rotary axes stand.
    pub topology: Topology,
    /// The bodies of the rotary axes of the table, from the bed outwards.
    pub table: Vec<usize>,
    /// The bodies of the rotary axes of the head, from the bed outwards.
    pub head: Vec<usize>,
    /// The offsets, true − nominal, as location errors of ISO 230-1; no two do the same.
    pub terms: Vec<Term>,
}

/// Why a machine has no centres to find.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum NoCentres {
    /// Too few or too many rotary axes.
    #[error(
        "{name} has {found} rotary {}: RTCP centres are those of two",
        if *.found == 1 { "axis" } else { "axes" }
    )]
    RotaryAxes {
        /// The machine.
        name: String,
        /// How many it has.
        found: usize,
    },
    /// The tip cannot be held while the rotary axes turn.
    #[error("{name} has fewer than three linear axes, so that no control can hold its tip")]
    LinearAxes {
        /// The machine.
        name: String,
    },
}

impl Centres {
    /// The offsets of a machine.
    ///
    /// Of the shifts of the rotary axes (from the bed outwards, not along themselves) and of the
    /// tool, each that does something which no place of the workpiece and no offset before it does:
    /// four with two rotary axes that are not parallel.
    ///
    /// # Errors
    /// [`NoCentres`].
    pub fn of(machine: &Machine) -> Result<Self, NoCentres> {
        let name = machine.name().to_owned();
        let kind = |body: usize| machine.bodies()[body].axis.map(|a| machine.axes()[a].kind);
        let side = machine.workpiece_side();
        let rotary = |body: &usize| kind(*body) == Some(AxisKind::Rotary);
        let table: Vec<usize> = (0..side).rev().filter(rotary).collect();
        let head: Vec<usize> = (side..machine.bodies().len()).filter(rotary).collect();
        let topology = match (table.len(), head.len()) {
            (2, 0) => Topology::TableTable,
            (0, 2) => Topology::HeadHead,
            (1, 1) => Topology::Mixed,
            (a, b) => return Err(NoCentres::RotaryAxes { name, found: a + b }),
        };
        if machine.axes().iter().filter(|a| a.kind == AxisKind::Linear).count() < 3 {
            return Err(NoCentres::LinearAxes { name });
        }
        let mut basis: Vec<DVector<f64>> = Vec::new();
        for component in SHIFTS {
            add(&mut basis, column(machine, shift(0, component)));
        }
        let mut terms = Vec::new();
        for index in candidates(machine, &table, &head) {
            if add(&mut basis, column(machine, index)) {
                let body = machine.bodies()[index.body].name;
                let error = ErrorName { body, kind: index.kind, component: index.component };
                terms.extend(Term::location(machine, error));
            }
        }
        terms.sort_by_key(|t| t.index);
        Ok(Self { topology, table, head, terms })
    }

    /// How the tip moves in the workpiece per mm of each offset.
    pub fn slopes(&self, machine: &Machine, command: &Command) -> Vec<Vec3> {
        let frames = machine.error_frames(command, Reference::Workpiece);
        self.terms.iter().map(|t| frames.twist(t.index).shift_mm).collect()
    }

    /// How far these offsets (mm) move the tip at a command, in the workpiece, mm.
    pub fn moved_mm(&self, machine: &Machine, command: &Command, offsets_mm: &[f64]) -> Vec3 {
        let slopes = self.slopes(machine, command);
        slopes.iter().zip(offsets_mm).fold(Vec3::zeros(), |sum, (v, x)| sum + v * *x)
    }

    /// The errors of the machine that these offsets are, mm.
    pub fn errors(&self, offsets_mm: &[f64]) -> ErrorValues {
        let mut errors = ErrorValues::default();
        for (term, x) in self.terms.iter().zip(offsets_mm) {
            errors.set(term.index, *x);
        }
        errors
    }

    /// What an offset is, in the words of the shop.
    pub fn words(&self, machine: &Machine, k: usize) -> String {
        let Some(term) = self.terms.get(k) else { return String::new() };
        let component = term.index.component as usize % 3;
        let along = ["X", "Y", "Z"][component];
        let name = |body: &usize| machine.bodies()[*body].name.to_string();
        // An axis has no place along itself, so that nothing counts from there.
        let slides = |body: &usize| {
            let axis = machine.bodies()[*body].axis.map(|a| machine.axes()[a].direction);
            axis.is_some_and(|d| d[component].abs() > ALONG)
        };
        let body = machine.bodies()[term.index.body].name;
        let place = |list: &[usize]| list.iter().position(|b| *b == term.index.body);
        let side = if place(&self.table).is_some() { &self.table } else { &self.head };
        let before = match place(side) {
            Some(i) => side[..i].last(),
            None => side.last(),
        };
        let from = before.filter(|b| !slides(b)).map(|b| format!(" from the {} axis", name(b)));
        let from = from.unwrap_or_default();
        match place(side) {
            Some(_) => format!("{along} of the {body} axis{from}"),
            None if along == "Z" => format!("{along} of the spindle{from} (pivot length)"),
            None => format!("{along} of the spindle{from}"),
        }
    }
}

/// The three shifts of a body.
pub(super) const SHIFTS: [Component; 3] = [Component::X, Component::Y, Component::Z];

/// A location error of a body.
pub(super) fn shift(body: usize, component: Component) -> ErrorIndex {
    ErrorIndex { body, kind: ErrorKind::Location, component }
}

/// Table axes, head axes, and where there is a head the spindle: its pivot length first.
fn candidates(machine: &Machine, table: &[usize], head: &[usize]) -> Vec<ErrorIndex> {
    let across = |body: usize| {
        let axis = machine.bodies()[body].axis.map(|a| machine.axes()[a].direction);
        let slides = move |c: &Component| axis.is_some_and(|d| d[*c as usize % 3].abs() > ALONG);
        SHIFTS.into_iter().filter(move |c| !slides(c)).map(move |c| shift(body, c))
    };
    let mut all: Vec<ErrorIndex> = table.iter().chain(head).flat_map(|b| across(*b)).collect();
    if !head.is_empty() {
        let tool = machine.bodies().len() - 1;
        all.extend([Component::Z, Component::X, Component::Y].map(|c| shift(tool, c)));
    }
    all
}

/// What a shift does to the tip over many poses, as one long vector.
fn column(machine: &Machine, index: ErrorIndex) -> DVector<f64> {
    let mut values = Vec::with_capacity(3 * POSES);
    for k in 0..POSES {
        let frames = machine.error_frames(&pose(machine, k), Reference::Workpiece);
        values.extend(frames.twist(index).shift_mm.iter().copied());
    }
    let column = DVector::from_vec(values);
    let length = column.norm();
    if length > NOTHING { column / length } else { column }
}

/// Rotary axes over their travel (Kronecker's sequence); linear ones turn nothing.
fn pose(machine: &Machine, k: usize) -> Command {
    const STEPS: [f64; 6] =
        [0.754_877_666, 0.569_840_291, 0.819_172_513, 0.671_043_606, 0.55, 0.45];
    let mut command = Command::default();
    for ((q, axis), step) in command.iter_mut().zip(machine.axes()).zip(STEPS) {
        if axis.kind == AxisKind::Rotary {
            let (from, to) = rotary_range(axis.travel);
            *q = from + (to - from) * (step * (k as f64 + 0.5)).fract();
        }
    }
    command
}

/// The travel of a rotary axis, a turn at most, rad.
pub(super) fn rotary_range(travel: Travel) -> (f64, f64) {
    let pi = std::f64::consts::PI;
    match travel {
        Travel::Between(from, to) if to > from => match (from.max(-pi), to.min(pi)) {
            (low, high) if high > low => (low, high),
            _ => (from, to.min(from + 2.0 * pi)),
        },
        _ => (-pi, pi),
    }
}

/// Takes a column in if it is no combination of those before.
pub(super) fn add(basis: &mut Vec<DVector<f64>>, column: DVector<f64>) -> bool {
    let mut left = column;
    // Twice, so that rounding does not count.
    for _ in 0..2 {
        for b in basis.iter() {
            let along = b.dot(&left);
            left -= b * along;
        }
    }
    let length = left.norm();
    if length < 1e-6 {
        return false;
    }
    basis.push(left / length);
    true
}
