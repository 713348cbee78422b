//! Laws of compensation values and tables: what they may hold, what they leave, and which errors they name.

use trueaxis_correct::compensate::tables::{self, Compiled, Target, compile};
use trueaxis_correct::compensate::values::{
    MOST_POSITIONS, Order, ValueTable, ValuesError, compensation_values, travel_positions,
};
use trueaxis_machine::Machine;
use trueaxis_machine::axis::Command;
use trueaxis_machine::file::NoTables;
use trueaxis_predict::predict::holes::Compensation;

fn machine(errors: &str) -> Machine {
    let text = format!(
        "[machine]\nname = \"m\"\nchain = \"w b X Y Z t\"\n[axis.X]\ntravel = [\"0 mm\", \"1000 mm\"]\n\
         [axis.Y]\ntravel = [\"-200 mm\", \"300 mm\"]\n[axis.Z]\ntravel = [\"-400 mm\", \"0 mm\"]\n\
         [tool]\nlength = \"100 mm\"\n{errors}"
    );
    let (machine, problems) = Machine::check("m.toml", &text, &NoTables);
    machine.unwrap_or_else(|| panic!("{problems:?}"))
}

fn compiled(errors: &str, target: Target) -> Compiled {
    let order = tables::Order::of(target);
    compile(&machine(errors), &order).unwrap_or_else(|error| panic!("{error}"))
}

/// In increments of 1e-18 mm an error of 8 µm is 8e15, which a double counts one by one; 9.5 µm are more than 2⁵³ =
/// 9.007e15, and there is no value.
#[test]
fn a_value_has_no_more_increments_than_a_double_counts() {
    let tried = |um: f64| -> Result<ValueTable, ValuesError> {
        let machine = machine(&format!("[motion.X]\nEXX = \"{um} um\""));
        let order = Order {
            axis: 0,
            command: Command::default(),
            positions: vec![100.0],
            increment: 1e-18,
            of: Compensation::Machine,
        };
        compensation_values(&machine, &order)
    };
    assert!(tried(8.0).is_ok());
    assert_eq!(tried(9.5), Err(ValuesError::Unbounded { at: 100.0 }));
}

/// From end to end in steps that do not come out even there is one position more than whole steps and the rest: 9998.5
/// steps are 10,000 positions, as many as a table may have, and 9999.5 steps are one too many.
#[test]
fn a_travel_has_no_more_positions_than_a_table() {
    let machine = machine("");
    let count = |steps: f64| {
        travel_positions(&machine.axes()[0], 1000.0 / steps).map(|positions| positions.len())
    };
    assert_eq!(count(9998.5), Some(MOST_POSITIONS));
    assert_eq!(count(9999.5), None);
}

/// Everywhere 3 µm along X and 4 µm along Y: the tip is off by 5 µm wherever it is, at most and root mean square.
#[test]
fn law_of_an_even_error_the_largest_is_the_root_mean_square() {
    let errors = "[motion.X]\nEXX = \"3 um\"\nEYX = \"4 um\"";
    let left = compiled(errors, Target::Csv).before;
    let off = [left.max_mm, left.rms_mm].map(|mm| (mm - 0.005).abs());
    assert!(left.poses > 1000 && off.iter().all(|mm| *mm < 1e-9), "{left:?}");
}

/// The errors that move the tip are named with what they do alone; a turn of Z about the tool that stands on it moves
/// nothing, and is not.
#[test]
fn law_errors_that_move_the_tip_are_named() {
    let errors = "[motion.X]\nEXX = \"3 um\"\nEYX = \"4 um\"\n[motion.Z]\nECZ = \"50 urad\"";
    let found = compiled(errors, Target::Csv).errors;
    let before_um = |name: &str| {
        let named = found.iter().find(|e| e.error.to_string() == name);
        named.map(|e| (e.before_mm * 1e6).round() / 1e3)
    };
    let named = ["EXX", "EYX", "ECZ"].map(before_um);
    assert_eq!(named, [Some(3.0), Some(4.0), None], "{found:?}");
}

/// What the pitch errors of an axis take away is not for the grid: it adds nothing to an error that is a function of
/// its own axis alone.
#[test]
fn law_a_grid_leaves_to_tables_what_they_hold() {
    let errors = "[motion.Y]\nEYY = { polynomial = [\"0 um\", \"10 um\"], scale = \"1000 mm\", \
                  reversal = \"2 um\" }";
    let compiled = compiled(errors, Target::Fanuc);
    let outputs: Vec<usize> = compiled.tables.iter().map(|t| t.table.output).collect();
    assert_eq!(outputs, [1], "Y");
    let grid = compiled.grid.expect("a grid").grid;
    assert!(grid.values.iter().all(|value| *value == [0; 3]), "{:?}", grid.values);
}

/// The sentence about signs is that of the values, whatever carries the axis and in whichever sense it moves: the body of
/// an error of +10 µm gets −10 µm where a positive command moves it to plus, +10 µm where it moves it to minus.
#[test]
fn the_sentence_about_signs_is_that_of_the_values() {
    for (chain, sense, value) in [
        ("w b X Y Z t", 1, -10),
        ("w b X Y Z t", -1, 10),
        ("w X' b Y Z t", -1, 10),
        ("w X' b Y Z t", 1, -10),
    ] {
        let text = format!(
            "[machine]\nname = \"m\"\nchain = \"{chain}\"\n[axis.X]\ntravel = [\"0 mm\", \"100 mm\"]\nsense = {sense}\n\
             [motion.X]\nEXX = \"10 um\""
        );
        let machine = Machine::check("m.toml", &text, &NoTables).0.expect("a machine");
        let order = Order {
            axis: 0,
            command: Command::default(),
            positions: vec![50.0],
            increment: 1e-3,
            of: Compensation::Machine,
        };
        let table = compensation_values(&machine, &order).expect("values");
        assert_eq!(table.nodes[0].value.increments, value, "{chain} {sense}");
        let report = trueaxis_correct::report::compensation_report(&machine, &[table]);
        let said = format!("{report:?}");
        let opposite = said.contains("error and value have opposite signs");
        let positive = said
            .contains("too far in the positive direction of the machine, the value is positive");
        assert_eq!((opposite, positive), (value < 0, value > 0), "{chain} {sense}: {said}");
    }
}
