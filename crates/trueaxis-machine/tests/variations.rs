//! One error at a time, against the chain walked again.

mod library;

use library::{Random, SHIPPED, machine, machine_of, warm};
use trueaxis_geometry::Vec3;
use trueaxis_machine::batch::{InstructionSet, LARGEST_TURN_RAD};
use trueaxis_machine::errors::{ErrorIndex, ErrorKind, ErrorValues, Rotation};
use trueaxis_machine::variations::DrawnCommand;
use trueaxis_machine::{ErrorModel, Machine, Squareness};

/// Errors of all bodies, as large as those of no machine.
fn errors(machine: &Machine, random: &mut Random) -> ErrorValues {
    let mut errors = ErrorValues::default();
    for index in indices(machine) {
        let most = if index.component.is_rotation() { 1e-3 } else { 0.3 };
        errors.set(index, random.within(most));
    }
    errors.workpiece_mm = Vec3::new(0.01, -0.02, 0.03);
    errors
}

fn indices(machine: &Machine) -> Vec<ErrorIndex> {
    let moves = |i: &ErrorIndex| {
        let body = machine.bodies().get(i.body);
        body.is_some_and(|b| b.axis.is_some() || i.kind == ErrorKind::Location)
    };
    ErrorIndex::all().filter(moves).collect()
}

fn changed(machine: &Machine, command: &[f64; 6], [from, to]: [&ErrorValues; 2]) -> [Vec3; 2] {
    let [from, to] = [from, to].map(|e| machine.deviation(command, e));
    [to.tip_mm - from.tip_mm, to.axis - from.axis]
}

fn assert_same(name: &str, found: &[Vec3; 2], expected: &[Vec3; 2]) {
    let off = [0, 1].map(|k| (found[k] - expected[k]).norm());
    assert!(off[0] < 3e-12 && off[1] < 1e-15, "{name}: off by {} mm, {} rad", off[0], off[1]);
}

/// The machines under each rule of the error model.
fn under_each_model() -> impl Iterator<Item = (String, Machine)> {
    let models = [Rotation::Exact, Rotation::SmallAngle].into_iter().flat_map(|rotation| {
        [Squareness::Carried, Squareness::Direction]
            .map(|squareness| ErrorModel { rotation, squareness })
    });
    models.flat_map(|model| {
        SHIPPED.map(|name| (format!("{name} {model:?}"), machine(name).with_model(model)))
    })
}

#[test]
fn law_another_value_of_one_error_is_that_of_the_whole_chain() {
    let mut random = Random(3);
    let mut checked = 0;
    for (name, machine) in under_each_model() {
        for _ in 0..5 {
            let (command, errors) = (random.command(&machine), errors(&machine, &mut random));
            let variations = machine.variations(&command, &errors);
            for index in indices(&machine) {
                for factor in [0.0, 1.0, -0.7] {
                    let value = factor * errors.get(index);
                    let mut other = errors;
                    other.set(index, value);
                    let expected = changed(&machine, &command, [&errors, &other]);
                    let found = variations.by(index, value);
                    assert_same(&format!("{name} {index:?}"), &found, &expected);
                    checked += usize::from(expected[0].norm() > 1e-6);
                }
            }
        }
    }
    assert!(checked > 5_000, "{checked}");
}

#[test]
fn law_an_uncertain_quantity_moves_the_tool_as_the_whole_chain_says() {
    let mut random = Random(5);
    let mut moved = 0;
    // Its sensors and the expansion of the workpiece move several errors at once, and the workpiece.
    let uncertain = |text: String| text.replace("\"13.2 um/(m K)\"", "\"13.2 ± 1 um/(m K)\"");
    let hot = machine_of("gantry-001", uncertain);
    let hot = warm(&hot, "scale_x=25 scale_y=24 workpiece=28");
    assert!(hot.uncertain_quantities().iter().any(|q| q.contains("workpiece")));
    let models = under_each_model().chain([("hot".to_owned(), hot)]);
    for (name, machine) in models {
        let quantities = machine.uncertain_quantities();
        for _ in 0..5 {
            let (command, errors) = (random.command(&machine), errors(&machine, &mut random));
            let known = machine.uncertainties_at(&command, &quantities);
            let variations = machine.variations(&command, &errors);
            let found = variations.by_uncertainties(&known, quantities.len());
            assert_eq!(found.len(), quantities.len());
            for (quantity, found) in found.iter().enumerate() {
                let [low, high] = [-1.0, 1.0].map(|z| known.displaced_by(&errors, quantity, z));
                let expected = changed(&machine, &command, [&low, &high]);
                assert_same(&format!("{name} {}", quantities[quantity]), found, &expected);
                moved += usize::from(expected[0].norm() > 1e-6);
            }
        }
    }
    assert!(moved > 1_000, "{moved}");
}

#[test]
fn law_a_fixed_command_is_the_whole_chain() {
    let mut random = Random(11);
    for (name, machine) in under_each_model() {
        for _ in 0..5 {
            let command = random.command(&machine);
            let fixed = machine.fixed_command(&command);
            for few in [true, false] {
                let mut errors = errors(&machine, &mut random);
                if few {
                    errors = errors.only(indices(&machine)[random.unit().to_bits() as usize % 9]);
                }
                let (found, due) = (fixed.deviation(&errors), machine.deviation(&command, &errors));
                assert_same(&name, &[found.tip_mm, found.axis], &[due.tip_mm, due.axis]);
                assert!((found.nominal_tip - due.nominal_tip).norm() < 1e-9);
                assert_eq!(found.nominal_axis, due.nominal_axis);
            }
        }
    }
}

#[test]
fn law_drawn_machines_are_each_the_whole_chain() {
    let mut random = Random(12);
    let (mut moved, mut turned) = (0, 0);
    let hot = warm(
        &machine_of("gantry-001", |text| {
            text.replace("\"13.2 um/(m K)\"", "\"13.2 ± 1 um/(m K)\"")
        }),
        "scale_x=25 scale_y=24 workpiece=28",
    );
    for (name, machine) in under_each_model().chain([("hot".to_owned(), hot)]) {
        let quantities = machine.uncertain_quantities();
        for size in [1.0, 1.0, 1e5] {
            let (command, errors) = (random.command(&machine), errors(&machine, &mut random));
            let known = machine.uncertainties_at(&command, &quantities);
            let drawn = DrawnCommand::of(&machine.fixed_command(&command), &errors, &known);
            // The last quantity may have no factors: it keeps its value. Large turns in some lanes only.
            let row =
                |_| std::array::from_fn(|k| (random.unit() - 0.5) * if k < 3 { size } else { 4.0 });
            let factors: Vec<[f64; 8]> = (1..quantities.len()).map(row).collect();
            for set in InstructionSet::ALL.into_iter().filter(|set| set.is_available()) {
                let mut found = [[0.0; 8]; 6];
                drawn.deviations_by(set, &factors, &mut found);
                for k in 0..8 {
                    let own: Vec<f64> = factors.iter().map(|row| row[k]).collect();
                    let other = known.displaced(&errors, &own);
                    let due = machine.deviation(&command, &other);
                    let [x, y, z, i, j, l] = found.each_ref().map(|row| row[k]);
                    let off = (Vec3::new(x, y, z) - due.tip_mm).norm();
                    assert!(
                        off < 1e-11 + 1e-14 * due.tip_mm.norm(),
                        "{name} {set:?} {k}: {off} mm"
                    );
                    let off = (Vec3::new(i, j, l) - due.axis).norm();
                    assert!(off < 1e-15 + 1e-14 * due.axis.norm(), "{name} {set:?} {k}: {off} rad");
                    moved += usize::from(due.tip_mm.norm() > 1e-6);
                    turned += usize::from(due.axis.norm() > LARGEST_TURN_RAD);
                }
            }
        }
    }
    assert!(moved > 500 && turned > 20, "{moved} {turned}");
}
