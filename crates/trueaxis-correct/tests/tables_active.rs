//! What a control holds already is not written over: its tables and parameters are absolute, and what is loaded goes in
//! their place.

use trueaxis_correct::compensate::tables::{Compiled, Order, TablesError, Target, compile};
use trueaxis_machine::Machine;
use trueaxis_machine::file::NoTables;

fn compiled(axes: &str, errors: &str, target: Target) -> Result<Compiled, TablesError> {
    let text = format!(
        "[machine]\nname = \"m\"\n{axes}\n[axis.X]\ntravel = [\"0 mm\", \"500 mm\"]\n\
         [axis.Y]\ntravel = [\"0 mm\", \"400 mm\"]\n[axis.Z]\ntravel = [\"-300 mm\", \"0 mm\"]\n\
         [tool]\nlength = \"100 mm\"\n{errors}"
    );
    let (machine, problems) = Machine::check("m.toml", &text, &NoTables);
    let machine = machine.unwrap_or_else(|| panic!("{problems:?}"));
    compile(&machine, &Order::of(target))
}

fn refused(axes: &str, errors: &str, target: Target) -> Option<(String, String)> {
    match compiled(axes, errors, target) {
        Err(TablesError::Active { error, written }) => Some((error.to_string(), written)),
        Err(other) => panic!("{other}"),
        Ok(_) => None,
    }
}

const THREE: &str = "chain = \"w X' b Y Z t\"";
const EXX: &str = "[motion.X]\nEXX = { polynomial = [\"0 um\", \"20 um\"], scale = \"500 mm\" }\n";
const EYY: &str = "[motion.Y]\nEYY = { polynomial = [\"0 um\", \"-20 um\"], scale = \"400 mm\" }\n";

fn because(error: &str, written: &str) -> Option<(String, String)> {
    Some((error.to_owned(), written.to_owned()))
}

/// A control has one table of X for X. Squareness puts a constant into it, so that a file for it would take the
/// 20 µm of EXX out; of another axis there is another table, but numbers of FANUC's data begin again in each file.
#[test]
fn a_table_of_an_active_error_is_not_written_over() {
    let square = "[location]\nEC0Y = \"50 urad\"\n";
    let active = "[compensation]\nactive = [\"EXX\"]";
    let errors = format!("{square}{EXX}{EYY}{active}");
    let targets = [Target::Csv, Target::LinuxCnc { trims: false }, Target::Sinumerik];
    for target in targets {
        assert_eq!(refused(THREE, &errors, target), because("EXX", "X moves X"), "{target:?}");
        let free = format!("{EXX}{EYY}{active}");
        assert_eq!(refused(THREE, &free, target), None, "{target:?}");
        assert_eq!(refused(THREE, &format!("{square}{EXX}{EYY}"), target), None, "{target:?}");
    }
    let free = format!("{EXX}{EYY}{active}");
    assert_eq!(refused(THREE, &free, Target::Fanuc), because("EXX", "Y moves Y"));
    // By direction, own tables of SINUMERIK are numbered, too.
    let turned = free.replace("mm\" }", "mm\", reversal = \"4 um\" }");
    assert_eq!(refused(THREE, &turned, Target::Sinumerik), because("EXX", "Y moves Y"));
}

/// Errors of a link stand in one file: of the link, or of all.
#[test]
fn a_file_of_links_with_an_active_error_is_not_written_over() {
    let errors = |other: &str| {
        format!(
            "[motion.X]\nEYX = {{ polynomial = [\"0 um\", \"10 um\"], scale = \"500 mm\" }}\n{other}\
             [compensation]\nactive = [\"EYX\"]"
        )
    };
    let of_x = errors("EZX = { polynomial = [\"0 um\", \"20 um\"], scale = \"500 mm\" }\n");
    let of_y =
        errors("[motion.Y]\nEZY = { polynomial = [\"0 um\", \"20 um\"], scale = \"500 mm\" }\n");
    assert_eq!(refused(THREE, &of_x, Target::Heidenhain), because("EYX", "the file of EZX"));
    assert_eq!(refused(THREE, &of_y, Target::Heidenhain), None);
    assert_eq!(refused(THREE, &of_y, Target::Isg), because("EYX", "the file of EZY"));
    assert_eq!(refused(THREE, &of_y, Target::Fanuc), because("EYX", "the grid"));
}

/// Pins and vectors are absolute: with the 30 µm of C in force, a file for its 20 µm in Y would put C back to 0 in X.
#[test]
fn a_centre_that_is_in_force_is_not_written_over() {
    let axes = "chain = \"w C' A' b X Y Z t\"\n[axis.C]\ntravel = \"unlimited\"\n\
                [axis.A]\ntravel = [\"-90 deg\", \"30 deg\"]";
    let errors = "[location]\nEX0C = \"30 um\"\nEY0C = \"20 um\"\n";
    let active = |names: &str| format!("{errors}[compensation]\nactive = [{names}]");
    let said = because("EX0C", "the kinematic parameters of the rotary axes");
    for target in [Target::LinuxCnc { trims: false }, Target::Csv, Target::Fanuc] {
        assert_eq!(refused(axes, &active("\"EX0C\""), target), said, "{target:?}");
    }
    let both = compiled(axes, &active("\"EX0C\", \"EY0C\""), Target::Csv);
    assert!(both.is_ok_and(|c| c.joints.is_none()));
    let whole = compiled(axes, errors, Target::Csv).expect("tables");
    let joints = whole.joints.expect("centres");
    assert_eq!(joints.0[0].point, [30_000, 20_000, 0]);
}
