//! The location errors that a machine needs: no two of them do the same.

use super::term::Term;
use nalgebra::DVector;
use trueaxis_geometry::Vec3;
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{AxisKind, Command, MAX_AXES, Travel};
use trueaxis_machine::errors::{Component, ErrorIndex, ErrorKind, ErrorName, ErrorValues};
use trueaxis_machine::twist::Reference;

/// How many commands are examined; the motion of six axes has far fewer parameters.
const COMMANDS: usize = 48;
/// What is seen less than this is rounding.
const NOTHING: f64 = 1e-9;

/// The smallest set of location errors that determines every constant deviation of tip and tool axis,
/// where the workpiece may sit anywhere and the tool is as it was measured.
///
/// The mounting of the workpiece takes six freedoms; of the remaining ones the rotary axes take first,
/// then the linear ones, each only what no error before it can do. Three linear and two rotary axes
/// leave thirteen: four for each rotary axis, three squarenesses, and two of the spindle.
///
/// # Source
/// A line in space has four freedoms, a direction two: 2·4 + 3·2 of the axes, 5 of tip and tool
/// axis, less the 6 of the workpiece: 13, the number of Inasaki, Kishinami, Sakamoto, Sugimura,
/// Takeuchi, Tanaka 1997.
pub fn minimal_location_errors(machine: &Machine) -> Vec<Term> {
    let mut basis: Vec<DVector<f64>> = Vec::new();
    for component in Component::ALL {
        let index = ErrorIndex { body: 0, kind: ErrorKind::Location, component };
        add(&mut basis, column(machine, index));
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

/// Rotary axes before linear ones and the spindle, from the bed outwards; errors along or about the
/// axis itself, which only move its zero, last.
fn candidates(machine: &Machine) -> Vec<ErrorIndex> {
    let mut bodies: Vec<(bool, usize, usize)> = Vec::new();
    for (i, body) in machine.bodies().iter().enumerate() {
        let Some(axis) = body.axis else { continue };
        let linear = machine.axes()[axis].kind == AxisKind::Linear;
        let side = machine.workpiece_side();
        let from_bed = if i < side { side - 1 - i } else { i - side };
        bodies.push((linear, from_bed, i));
    }
    bodies.sort_unstable();
    let mut across = Vec::new();
    let mut along = Vec::new();
    for (linear, _, body) in bodies {
        let axis = machine.bodies()[body].axis.map(|a| machine.axes()[a].direction);
        for component in Component::ALL {
            if linear && !component.is_rotation() {
                continue; // the zero of a linear axis, or what its neighbours do
            }
            let index = ErrorIndex { body, kind: ErrorKind::Location, component };
            let own = axis.is_some_and(|d| d[component as usize % 3].abs() > 0.5);
            if own { &mut along } else { &mut across }.push(index);
        }
    }
    let body = machine.bodies().len() - 1;
    // The tilt of the spindle; on a swivelling head also where it sits (the pivot length).
    let tool = [Component::A, Component::B, Component::X, Component::Y, Component::Z];
    let spindle = tool.map(|component| ErrorIndex { body, kind: ErrorKind::Location, component });
    across.into_iter().chain(spindle).chain(along).collect()
}

/// What an error does to tip and tool axis over many commands, as one long vector.
fn column(machine: &Machine, index: ErrorIndex) -> DVector<f64> {
    let mut values = Vec::with_capacity(6 * COMMANDS);
    for command in (0..COMMANDS).map(|k| spread(machine, k)) {
        let twist = machine.error_frames(&command, Reference::Workpiece).twist(index);
        let tool = machine.pose(&command, &ErrorValues::default());
        let tip = tool.linear() * machine.tip_mm() + tool.shift_mm();
        let moved = twist.shift_mm + twist.turn_rad.cross(&tip);
        let tilted = twist.turn_rad.cross(&(tool.linear() * Vec3::z()));
        // mm against rad: a metre makes them alike.
        values.extend(moved.iter().map(|v| v / 1e3).chain(tilted.iter().copied()));
    }
    let column = DVector::from_vec(values);
    let length = column.norm();
    // What remains of an error without effect is rounding, and must not be scaled to 1.
    if length > NOTHING { column / length } else { column }
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

#[cfg(test)]
mod tests {
    use super::*;
    use trueaxis_machine::file::NoTables;

    #[test]
    fn thirteen_for_five_axes_three_for_three() {
        let count = |chain: &str| {
            let text = format!(
                "[machine]\nname = \"mill\"\nchain = \"{chain}\"\n[tool]\nlength = \"100 mm\""
            );
            let machine = Machine::check("mill.toml", &text, &NoTables).0.expect("a machine");
            let names = minimal_location_errors(&machine);
            names.iter().map(|t| t.error.to_string()).collect::<Vec<_>>()
        };
        assert_eq!(count("w C' A' b X Y Z t").len(), 13, "{:?}", count("w C' A' b X Y Z t"));
        let head = count("w b X Y Z C A t");
        assert_eq!(head.len(), 13, "{head:?}");
        assert!(head.contains(&"EZ0t".to_owned()), "the pivot length is missing in {head:?}");
        // Three squarenesses and two tilts of the spindle.
        assert_eq!(count("w X' Y' b Z t").len(), 5, "{:?}", count("w X' Y' b Z t"));
    }
}
