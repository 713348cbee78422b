//! The chain against a second, plain version: products of 4×4 matrices, written from eq. 1 to 4 of
//! docs/model.md and from nothing else. It does not use the steps of the library, nor its poses.

mod library;

use library::{Random, SHIPPED, machine, machine_of};
use nalgebra::{Matrix3, Matrix4, Vector4};
use trueaxis_geometry::{Mat3, Vec3};
use trueaxis_machine::axis::{AxisKind, Command};
use trueaxis_machine::batch::{Commands, CompiledMachine, DeviationTable};
use trueaxis_machine::errors::{
    Component, ErrorIndex, ErrorKind, ErrorValues, Rotation, SixErrors,
};
use trueaxis_machine::{ErrorFrame, ErrorModel, Machine, Squareness};

type Matrix = Matrix4<f64>;

fn matrix(linear: &Mat3, shift_mm: &Vec3) -> Matrix {
    let mut all = Matrix::identity();
    all.fixed_view_mut::<3, 3>(0, 0).copy_from(linear);
    all.fixed_view_mut::<3, 1>(0, 3).copy_from(shift_mm);
    all
}

fn shift(by: Vec3) -> Matrix {
    matrix(&Mat3::identity(), &by)
}

/// A turn about a unit vector n: I + sin φ [n]× + (1 − cos φ) [n]×².
fn turn(about: Vec3, angle: f64) -> Matrix {
    let n = Matrix3::new(0.0, -about.z, about.y, about.z, 0.0, -about.x, -about.y, about.x, 0.0);
    let linear = Mat3::identity() + n * angle.sin() + n * n * (1.0 - angle.cos());
    matrix(&linear, &Vec3::zeros())
}

/// Eq. 3, or eq. 4 with small angles.
fn error(six: &SixErrors, rotation: Rotation) -> Matrix {
    let [x, y, z, a, b, c] = six.0;
    let shifted = shift(Vec3::new(x, y, z));
    match rotation {
        Rotation::Exact => shifted * turn(Vec3::z(), c) * turn(Vec3::y(), b) * turn(Vec3::x(), a),
        Rotation::SmallAngle => {
            let small = Mat3::new(1.0, -c, b, c, 1.0, -a, -b, a, 1.0);
            shifted * matrix(&small, &Vec3::zeros())
        }
    }
}

/// Eq. 1 and 4.
fn link(machine: &Machine, i: usize, command: &Command, errors: &ErrorValues) -> Matrix {
    let (body, model) = (&machine.bodies()[i], machine.model());
    let p = matrix(body.placement.linear(), body.placement.shift_mm());
    let m = matrix(body.mounting.linear(), body.mounting.shift_mm());
    let location = error(&errors.bodies[i].location, model.rotation);
    let e = error(&errors.bodies[i].motion, model.rotation);
    let Some(axis) = body.axis else { return p * location * m };
    let (axis, q) = (&machine.axes()[axis], machine.axes()[axis].sense * command[axis]);
    if axis.kind == AxisKind::Rotary {
        let j = turn(axis.direction, q);
        return match body.error_frame {
            ErrorFrame::Fixed => p * location * e * j * m,
            ErrorFrame::Moving => p * location * j * e * m,
        };
    }
    if model.squareness == Squareness::Direction {
        let mut along = axis.direction.push(0.0) * q;
        along = location * along;
        let still = shift(errors.bodies[i].location.shift_mm());
        return p * still * shift(along.xyz()) * e * m;
    }
    p * location * shift(axis.direction * q) * e * m
}

/// Eq. 2.
fn pose(machine: &Machine, command: &Command, errors: &ErrorValues) -> Matrix {
    let product = |acc: Matrix, i: usize| acc * link(machine, i, command, errors);
    let (side, count) = (machine.workpiece_side(), machine.bodies().len());
    let bed_from_workpiece = (0..side).rev().fold(Matrix::identity(), product);
    let bed_from_tool = (side..count).fold(Matrix::identity(), product);
    bed_from_workpiece.try_inverse().expect("a pose") * bed_from_tool
}

/// Tip in mm and unit vector of the tool axis.
fn tool(machine: &Machine, pose: &Matrix) -> (Vec3, Vec3) {
    let axis = pose * Vector4::new(0.0, 0.0, 1.0, 0.0);
    ((pose * machine.tip_mm().push(1.0)).xyz(), axis.xyz().normalize())
}

fn unit_vector(random: &mut Random) -> Vec3 {
    Vec3::new(random.within(1.0), random.within(1.0), 1.0).normalize()
}

fn random_errors(random: &mut Random, machine: &Machine) -> ErrorValues {
    let mut errors = ErrorValues::default();
    for (body, b) in machine.bodies().iter().enumerate() {
        for component in Component::ALL {
            let reach = if component.is_rotation() { 1e-3 } else { 0.05 };
            errors.set(
                ErrorIndex { body, kind: ErrorKind::Location, component },
                random.within(reach),
            );
            if b.axis.is_some() {
                let index = ErrorIndex { body, kind: ErrorKind::Motion, component };
                errors.set(index, random.within(reach));
            }
        }
    }
    errors
}

/// Every shipped machine unchanged, with errors that turn with the axes, and with a part that stands
/// askew on a tilted fixture; each with every error model.
fn machines(random: &mut Random) -> Vec<Machine> {
    let mut all: Vec<Machine> = Vec::new();
    for name in SHIPPED.into_iter().chain(["gantry-001"]) {
        let moving = |text: String| match text.contains("error_frame") {
            true => text.replace("\"fixed\"", "\"moving\""),
            false => text.replacen("chain =", "error_frame = \"moving\"\nchain =", 1),
        };
        for machine in [machine(name), machine_of(name, moving)] {
            let mut part = || {
                let linear =
                    turn(unit_vector(random), random.within(1.0)).fixed_view::<3, 3>(0, 0).into();
                let at =
                    Vec3::new(random.within(300.0), random.within(300.0), random.within(300.0));
                trueaxis_geometry::frame::Pose::new(linear, at)
            };
            let askew = machine.clone().with_workpiece(part(), part());
            all.extend([machine, askew]);
        }
    }
    let mut modelled = Vec::new();
    for rotation in [Rotation::Exact, Rotation::SmallAngle] {
        for squareness in [Squareness::Carried, Squareness::Direction] {
            let model = ErrorModel { rotation, squareness };
            modelled.extend(all.iter().map(|m| m.clone().with_model(model)));
        }
    }
    modelled
}

#[test]
fn law_pose_and_deviation_are_the_product_of_the_matrices() {
    let mut random = Random(16);
    for machine in machines(&mut random) {
        for _ in 0..50 {
            let command = random.command(&machine);
            let errors = random_errors(&mut random, &machine);
            let (actual, nominal) = (
                pose(&machine, &command, &errors),
                pose(&machine, &command, &ErrorValues::default()),
            );
            let what = format!("{} {:?}", machine.name(), machine.model());

            let library = machine.pose(&command, &errors);
            let library = matrix(library.linear(), library.shift_mm());
            assert!((library - actual).amax() < 1e-9, "{what}: {}", (library - actual).amax());

            let ((tip, axis), (tip_0, axis_0)) =
                (tool(&machine, &actual), tool(&machine, &nominal));
            let found = machine.deviation(&command, &errors);
            assert!((found.nominal_tip.vector() - tip_0).amax() < 1e-9, "{what}");
            assert!((found.tip_mm - (tip - tip_0)).amax() < 1e-9, "{what}");
            assert!((found.axis - (axis - axis_0)).amax() < 1e-12, "{what}");
        }
    }
}

#[test]
fn law_error_frames_are_the_slope_of_the_matrices() {
    use trueaxis_machine::twist::Reference;
    let mut random = Random(17);
    // The frames are exact to first order; half of the difference of both sides is to second.
    let h = 1e-4;
    for machine in machines(&mut random) {
        let command = random.command(&machine);
        let frames = machine.error_frames(&command, Reference::Workpiece);
        let (tip_0, _) = tool(&machine, &pose(&machine, &command, &ErrorValues::default()));
        for (body, b) in machine.bodies().iter().enumerate() {
            for kind in [ErrorKind::Location, ErrorKind::Motion] {
                if kind == ErrorKind::Motion && b.axis.is_none() {
                    continue;
                }
                for component in Component::ALL {
                    let index = ErrorIndex { body, kind, component };
                    let at = |value: f64| {
                        let mut errors = ErrorValues::default();
                        errors.set(index, value);
                        tool(&machine, &pose(&machine, &command, &errors)).0
                    };
                    let slope = (at(h) - at(-h)) / (2.0 * h);
                    let twist = frames.twist(index);
                    let found = twist.shift_mm + twist.turn_rad.cross(&tip_0);
                    let off = (found - slope).amax();
                    assert!(off < 1e-4, "{} {index:?}: {off}", machine.name());
                }
            }
        }
    }
}

#[test]
fn law_batches_are_the_product_of_the_matrices() {
    let mut random = Random(18);
    for machine in machines(&mut random) {
        let poses: Vec<Command> = (0..9).map(|_| random.command(&machine)).collect();
        let count = machine.axes().len();
        let columns: Vec<Vec<f64>> =
            (0..count).map(|k| poses.iter().map(|c| c[k]).collect()).collect();
        let slices: Vec<&[f64]> = columns.iter().map(Vec::as_slice).collect();
        let mut table = DeviationTable::zeros(poses.len());
        CompiledMachine::new(&machine)
            .deviations(&Commands::new(&slices), &mut table.columns())
            .expect("within the tables");
        for (i, command) in poses.iter().enumerate() {
            let errors = machine.errors_at(command, &[0.0; 6]).expect("within the tables");
            let actual = tool(&machine, &pose(&machine, command, &errors)).0;
            let nominal = tool(&machine, &pose(&machine, command, &ErrorValues::default())).0;
            let found = table.at(i);
            let off = (found.tip_mm - (actual - nominal)).amax();
            assert!(off < 1e-9, "{} {:?}: {off}", machine.name(), machine.model());
        }
    }
}
