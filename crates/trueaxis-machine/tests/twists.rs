//! The derivative of the chain against the chain itself.

mod library;

use library::{Random, SHIPPED, machine};
use trueaxis_geometry::Vec3;
use trueaxis_geometry::frame::Pose;
use trueaxis_machine::errors::{ErrorIndex, ErrorKind, ErrorValues};
use trueaxis_machine::twist::Reference;
use trueaxis_machine::{ErrorModel, Machine, Squareness};

fn indices(machine: &Machine) -> Vec<ErrorIndex> {
    let moves = |i: &ErrorIndex| {
        machine
            .bodies()
            .get(i.body)
            .is_some_and(|b| b.axis.is_some() || i.kind == ErrorKind::Location)
    };
    ErrorIndex::all().filter(moves).collect()
}

/// Where two points of the tool are in the reference.
fn seen(machine: &Machine, command: &[f64; 6], errors: &ErrorValues, of: Reference) -> [Vec3; 2] {
    let points = [machine.tip_mm(), machine.tip_mm() + Vec3::new(30.0, -20.0, 90.0)];
    let place = |linear: &trueaxis_geometry::Mat3, shift: &Vec3| points.map(|p| linear * p + shift);
    match of {
        Reference::Workpiece => {
            let pose = machine.pose(command, errors);
            place(pose.linear(), pose.shift_mm())
        }
        Reference::Bed => {
            let pose: Pose<_, _> = machine.tool_on_bed(command, errors);
            place(pose.linear(), pose.shift_mm())
        }
    }
}

#[test]
fn law_the_twist_of_an_error_is_the_slope_of_the_chain() {
    let mut random = Random(7);
    for name in SHIPPED {
        for squareness in [Squareness::Carried, Squareness::Direction] {
            let machine = machine(name);
            let model = ErrorModel { squareness, ..machine.model() };
            let machine = machine.with_model(model);
            for reference in [Reference::Workpiece, Reference::Bed] {
                for _ in 0..20 {
                    let command = random.command(&machine);
                    let frames = machine.error_frames(&command, reference);
                    let at_zero = seen(&machine, &command, &ErrorValues::default(), reference);
                    for index in indices(&machine) {
                        let h = if index.component.is_rotation() { 1e-6 } else { 1e-2 };
                        let [plus, minus] = [h, -h].map(|h| {
                            let mut errors = ErrorValues::default();
                            errors.add(index, h);
                            seen(&machine, &command, &errors, reference)
                        });
                        let twist = frames.twist(index);
                        for k in 0..2 {
                            let slope = (plus[k] - minus[k]) / (2.0 * h);
                            let moved = twist.shift_mm + twist.turn_rad.cross(&at_zero[k]);
                            // A rounding of 1e-12 mm over 2e-6 rad; lengths up to 6 m.
                            let allowed = if index.component.is_rotation() { 5e-6 } else { 1e-9 };
                            let off = (slope - moved).norm();
                            assert!(off < allowed, "{name} {index:?} {reference:?}: {off:.2e}");
                        }
                    }
                }
            }
        }
    }
}

#[test]
fn what_the_reference_carries_is_not_seen() {
    let machine = machine("i5-engraver");
    let frames = machine.error_frames(&[0.0; 6], Reference::Bed);
    let mut table = indices(&machine).into_iter().filter(|i| i.body < machine.workpiece_side());
    assert!(table.all(|i| frames.twist(i).shift_mm == Vec3::zeros()));
}
