//! Our side of hand.toml: signs and units on machines of a few lines.

use crate::Ours;
use crate::shop::{command, list};
use trueaxis::machine::Machine;
use trueaxis::machine::file::NoTables;

pub const CLAIMS: &[(&str, Ours)] = &[
    ("hand-squareness", || deviation_um("w b X Y Z t", "EC0Y = \"10 urad\"", "Y=500")),
    ("hand-squareness-of-z", || deviation_um("w b X Y Z t", "EB0Z = \"10 urad\"", "Z=-400")),
    ("hand-table-axis", || deviation_um("w X' Y' b Z t", "EX0X = \"7 um\"", "X=100")),
    ("hand-turned-table", || deviation_um("w C' b X Y Z t", "EX0C = \"10 um\"", "C=90")),
    ("hand-tool-holder", || deviation_um("w b X Y Z C A t", "EX0t = \"10 um\"", "C=90")),
    ("hand-abbe", || deviation_um("w b X Y Z A t", "EB0A = \"20 urad\"", "A=0")),
];

/// Deviation of the tip in the workpiece, µm, of a machine with a tool of 100 mm and one error.
fn deviation_um(chain: &str, error: &str, at: &str) -> Vec<f64> {
    let text = format!(
        "[machine]\nname = \"by hand\"\nchain = \"{chain}\"\nsource = \"a test\"\n\
         [tool]\nlength = \"100 mm\"\n[location]\n{error}\n"
    );
    let (machine, problems) = Machine::check("hand.toml", &text, &NoTables);
    let list_of: Vec<String> = problems.iter().map(ToString::to_string).collect();
    let machine = machine.unwrap_or_else(|| panic!("{}", list_of.join("\n")));
    let command = command(&machine, at);
    let errors = machine.errors_at(&command, &[0.0; 6]).expect("no tables");
    list(machine.deviation(&command, &errors).tip_mm * 1e3)
}
