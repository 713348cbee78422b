//! The location errors that a machine needs: no two of them do the same.

use super::term::Term;
use nalgebra::DVector;
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{AxisKind, Command, MAX_AXES, Travel};
use trueaxis_machine::errors::{Component, ErrorIndex, ErrorKind, ErrorName};
use trueaxis_machine::twist::Reference;

/// How many commands are looked at; the motion of six axes has far fewer parameters.
const COMMANDS: usize = 48;
/// A direction that is seen less than this is rounding.
const NOTHING: f64 = 1e-9;

/// The smallest set of location errors with which every deviation that is constant in the axes can
/// be told, where workpiece and tool may sit anywhere.
///
/// The mounting of the workpiece and of the tool take six freedoms each; of what is left rotary
/// axes take first, then linear axes, each only what no error before it can do. On a machine with
/// three linear and two rotary axes eleven errors are left, of which ISO 230-7 and ISO 10791-6
/// name eight for the rotary axes and three squarenesses.
pub fn minimal_location_errors(machine: &Machine) -> Vec<Term> {
    let mut basis: Vec<DVector<f64>> = Vec::new();
    for body in [0, machine.bodies().len() - 1] {
        for component in Component::ALL {
            let index = ErrorIndex { body, kind: ErrorKind::Location, component };
            add(&mut basis, column(machine, index));
        }
    }
    let mut chosen = Vec::new();
    for index in candidates(machine) {
        if add(&mut basis, column(machine, index)) {
            let body = machine.bodies()[index.body].name;
            let error = ErrorName { body, kind: ErrorKind::Location, component: index.component };
            chosen.extend(Term::location(machine, error));
        }
    }
    chosen.sort_by_key(|t| t.index);
    chosen
}

/// Rotary axes before linear ones, from the bed outwards; tilts before offsets.
fn candidates(machine: &Machine) -> Vec<ErrorIndex> {
    let mut bodies: Vec<(usize, usize, bool)> = machine
        .bodies()
        .iter()
        .enumerate()
        .filter_map(|(i, b)| {
            let linear = machine.axes()[b.axis?].kind == AxisKind::Linear;
            let side = machine.workpiece_side();
            let from_bed = if i < side { side - 1 - i } else { i - side };
            Some((i, from_bed, linear))
        })
        .collect();
    bodies.sort_by_key(|(i, from_bed, linear)| (*linear, *from_bed, *i));
    let of = |body: usize, component| ErrorIndex { body, kind: ErrorKind::Location, component };
    let tilts = [Component::A, Component::B, Component::C];
    let offsets = [Component::X, Component::Y, Component::Z];
    let turned = bodies.iter().flat_map(|(i, ..)| tilts.map(|c| of(*i, c)));
    let shifted = bodies.iter().filter(|b| !b.2).flat_map(|(i, ..)| offsets.map(|c| of(*i, c)));
    turned.chain(shifted).collect()
}

/// The twist of an error over many commands, as one long vector.
fn column(machine: &Machine, index: ErrorIndex) -> DVector<f64> {
    let mut values = Vec::with_capacity(6 * COMMANDS);
    for command in (0..COMMANDS).map(|k| spread(machine, k)) {
        let twist = machine.error_frames(&command, Reference::Workpiece).twist(index);
        // mm against rad: a metre makes them alike.
        values.extend(twist.shift_mm.iter().map(|v| v / 1e3));
        values.extend(twist.turn_rad.iter());
    }
    let column = DVector::from_vec(values);
    let length = column.norm();
    if length > 0.0 { column / length } else { column }
}

/// Commands that fill the travel evenly (Kronecker's sequence).
fn spread(machine: &Machine, k: usize) -> Command {
    const STEPS: [f64; MAX_AXES] =
        [0.414_213_56, 0.732_050_8, 0.236_068, 0.645_751_3, 0.316_624_8, 0.605_551_3];
    std::array::from_fn(|i| {
        let Some(axis) = machine.axes().get(i) else { return 0.0 };
        let (from, to) = match (axis.travel, axis.kind) {
            (Travel::Between(from, to), _) => (from, to),
            (_, AxisKind::Linear) => (-300.0, 300.0),
            (_, AxisKind::Rotary) => (-1.5, 1.5),
        };
        from + (to - from) * (((k + 1) as f64) * STEPS[i]).fract()
    })
}

/// Adds a vector to an orthonormal basis if it is not in its span.
fn add(basis: &mut Vec<DVector<f64>>, mut vector: DVector<f64>) -> bool {
    // Twice, so that rounding of the first time is taken away too.
    for _ in 0..2 {
        for b in basis.iter() {
            let along = b.dot(&vector);
            vector -= b * along;
        }
    }
    let left = vector.norm();
    if left < NOTHING {
        return false;
    }
    basis.push(vector / left);
    true
}
