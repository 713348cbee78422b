//! Offsets of tip and angles, against LinuxCNC's own kinematics as its manual writes them.

mod rig;

use rig::root;
use rig::trt::Trt;
use trueaxis::files::disk;
use trueaxis::geometry::Vec3;
use trueaxis::machine::Machine;
use trueaxis::machine::axis::Command;
use trueaxis_live::pose::{Frame, PoseCorrection, World};

fn machine(name: &str) -> (Machine, Trt) {
    let path = root().join(format!("examples/08_live/linuxcnc/{name}.toml"));
    let (found, problems) = Machine::read(&disk(), &path);
    assert!(!problems.has_errors(), "{:?}", problems.sorted());
    let trt = Trt { tilts_about_x: name == "xyzac", offset: [20.0, 10.0], tool: 50.0 };
    (found.expect("a machine"), trt)
}

/// C, tilt, X, Y, Z; SplitMix64.
fn poses(count: usize) -> impl Iterator<Item = Command> {
    let mut state = 7u64;
    let mut next = move || {
        state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (state ^ (state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    };
    (0..count).map(move |_| {
        let mut between = |low: f64, high: f64| low + (high - low) * next();
        [
            between(-9.0, 9.0),
            between(-1.2, 1.2),
            between(-200.0, 200.0),
            between(-200.0, 200.0),
            between(-100.0, 200.0),
            0.0,
        ]
    })
}

/// What the actual machine does at joints, against the nominal one at a command.
fn missed(machine: &Machine, at: &Command, wanted: &Command) -> (f64, f64) {
    let (no, sides) = (Default::default(), Command::default());
    let nominal = machine.deviation(wanted, &no);
    let actual = machine.deviation(at, &machine.errors_at(at, &sides).expect("errors"));
    let tip = actual.nominal_tip.vector() + actual.tip_mm - nominal.nominal_tip.vector();
    let axis = actual.nominal_axis.vector() + actual.axis - nominal.nominal_axis.vector();
    (tip.norm(), axis.norm())
}

#[test]
fn law_a_control_that_adds_the_offset_brings_the_actual_tool_to_the_nominal_pose() {
    for name in ["xyzac", "xyzbc"] {
        let (machine, trt) = machine(name);
        let world = World::of(&machine).expect("X Y Z");
        let correction = PoseCorrection::of(&machine, true).expect("a correction");
        let (mut without, mut tilted) = (0.0f64, 0);
        for command in poses(3000) {
            without = without.max(missed(&machine, &command, &command).0);
            let corrected = correction.corrected(&command).expect("corrected");
            let by_axis = world.offset(Frame::Machine, &command, &corrected);
            let joints: Command = std::array::from_fn(|i| command[i] + by_axis[i]);
            // Near the pole, within 1/3 rad of it and what the errors add, C takes a part only.
            let limit = if command[1].abs() > 0.36 { 1e-12 } else { 1e-3 };
            tilted += usize::from(limit < 1.0);
            let (tip, axis) = missed(&machine, &joints, &command);
            assert!(tip < 2e-10 && axis < limit, "{name} {command:?}: {tip} mm, {axis}");

            // The same through the kinematics of the control: to its programmed tip and angles the offset is added.
            let by = world.offset(Frame::Workpiece, &command, &corrected);
            let [c, tilt] = [command[0], command[1]];
            let programmed = trt.forward(Vec3::new(command[2], command[3], command[4]), tilt, c);
            let (c, tilt) = (c + by[0], tilt + by[1]);
            let moved = trt.inverse(programmed + Vec3::new(by[2], by[3], by[4]), tilt, c);
            let joints = [c, tilt, moved.x, moved.y, moved.z, 0.0];
            let (tip, axis) = missed(&machine, &joints, &command);
            assert!(tip < 2e-9 && axis < limit, "{name} {command:?}: {tip} mm, {axis}");
        }
        assert!(without > 0.05 && tilted > 2000, "{without} {tilted}");
    }
}

#[test]
fn law_the_command_of_the_program_comes_back_from_positions_with_an_offset() {
    for name in ["xyzac", "xyzbc"] {
        let (machine, trt) = machine(name);
        let world = World::of(&machine).expect("X Y Z");
        for (command, by) in poses(500).zip(poses(1000).skip(500)) {
            let by = by.map(|v| v * 1e-3);
            let added = std::array::from_fn(|i| command[i] + by[i]);
            let back = world.without(Frame::Machine, &added, &by);
            assert!(command.iter().zip(back).all(|(a, b)| (a - b).abs() < 1e-12));

            let [c, tilt, x, y, z, _] = command;
            let programmed = trt.forward(Vec3::new(x, y, z), tilt, c);
            let with = programmed + Vec3::new(by[2], by[3], by[4]);
            let moved = trt.inverse(with, tilt + by[1], c + by[0]);
            let positions = [c + by[0], tilt + by[1], moved.x, moved.y, moved.z, 0.0];
            let back = world.without(Frame::Workpiece, &positions, &by);
            assert!(
                command.iter().zip(back).all(|(a, b)| (a - b).abs() < 1e-10),
                "{command:?} {back:?}"
            );
            // The control counts Z to the spindle.
            let tip = world.tip_xyz(&command) + Vec3::new(0.0, 0.0, trt.tool);
            assert!((tip - programmed).norm() < 1e-10, "{tip} {programmed}");
        }
    }
}

/// Between two servo cycles nothing of the correction may jump, least of all where the tool is upright: a tilt of 0.1 mrad
/// changes angles by less than a thousandth of it, and the tip by what the errors do.
#[test]
fn law_the_offset_has_no_step_where_the_tool_passes_the_pole() {
    let (machine, _) = machine("xyzac");
    let world = World::of(&machine).expect("X Y Z");
    let correction = PoseCorrection::of(&machine, true).expect("a correction");
    for c in [0.0, 0.7, 2.0, 4.0] {
        let mut last: Option<Command> = None;
        for step in -4000..4000 {
            // 90 deg/s in cycles of 1 ms are 1.6 mrad.
            let tilt = f64::from(step) * 1e-4;
            let command = [c, tilt, 10.0, 20.0, 30.0, 0.0];
            let corrected = correction.corrected(&command).expect("corrected");
            let by = world.offset(Frame::Workpiece, &command, &corrected);
            if let Some(last) = last {
                let moved = |i: usize| (by[i] - last[i]).abs();
                let turned = moved(0).max(moved(1));
                let shifted = moved(2).max(moved(3)).max(moved(4));
                assert!(
                    turned < 1e-6 && shifted < 1e-4,
                    "C {c}, tilt {tilt}: {turned} rad, {shifted} mm"
                );
            }
            last = Some(by);
        }
    }
}
