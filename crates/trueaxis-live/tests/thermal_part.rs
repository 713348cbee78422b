//! Only what temperatures add goes live where tables in the control have the rest.

mod rig;

use rig::root;
use trueaxis::files::disk;
use trueaxis::machine::Machine;
use trueaxis::predict::holes::Compensation;
use trueaxis_live::model::{LiveAxis, Model, Part};
use trueaxis_live::pose::Frame;

/// At 20 °C nothing is asked for, although the machine has errors of tens of µm; at 30 °C the spindle has grown by
/// 1.5 µm/K · 10 K, and Z goes back by that, 15 000 increments of 1 nm, and no other axis.
#[test]
fn law_the_thermal_part_of_a_pose_is_nothing_at_20_degrees() {
    let path = root().join("examples/08_live/linuxcnc/xyzac.toml");
    let (machine, problems) = Machine::read(&disk(), &path);
    let machine = machine.unwrap_or_else(|| panic!("{:?}", problems.sorted()));
    let axes: Vec<LiveAxis> =
        (0..5).map(|axis| LiveAxis { axis, increment: 1e-6, sign: 1.0, line: None }).collect();
    let asked = |part: Part, celsius: f64| -> Vec<Vec<f64>> {
        let model = Model::new(machine.clone(), Compensation::Machine, part, axes.clone());
        let mut model = model.with_pose().expect("X Y Z");
        model.set_readings(&[("spindle", celsius)]).expect("a warm machine");
        // C, A, X, Y, Z.
        let places = [[0.3, 0.6, 40.0, 30.0, 60.0, 0.0], [2.0, -0.8, -80.0, 120.0, -20.0, 0.0]];
        let target = |place| model.target(Frame::Machine, &place).expect("a target").offsets;
        places.map(target).to_vec()
    };
    for whole in asked(Part::Whole, 20.0) {
        assert!(whole[2..].iter().any(|counts| counts.abs() > 1000.0), "{whole:?}");
    }
    for cold in asked(Part::Thermal, 20.0) {
        assert!(cold.iter().all(|counts| counts.abs() < 0.01), "{cold:?}");
    }
    for warm in asked(Part::Thermal, 30.0) {
        let off = [0.0, 0.0, 0.0, 0.0, 15_000.0];
        let near = warm.iter().zip(off).all(|(counts, due)| (counts - due).abs() < 20.0);
        assert!(near, "{warm:?}");
    }
}
