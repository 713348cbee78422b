//! Reads the length of a tool from a TOML text and shows the problems with their places:
//! `cargo run -p trueaxis-input --example tool_file`.
#![allow(clippy::print_stdout)]

use trueaxis_input::{CsvTable, Diagnostics, Dimension, SourceText, Unit};

fn main() {
    // 4 in = 4 · 25.4 mm = 101.6 mm.
    let text = "length = '4 ± 0.001 in'\nwidht = '3 mm'\n";
    let source = SourceText::new("tool.toml", text);
    let length = source.read(|root| root.get("length")?.measured(Dimension::Length));
    if let Some(length) = length {
        println!("length {} mm, u = {} mm", length.value, length.u.unwrap_or(0.0));
    }
    // The misspelt entry is reported at line 2, column 1.
    for problem in source.finish().sorted() {
        println!("{problem}");
    }

    // Headings carry the unit: 1500 µm = 1.5 mm.
    let mut problems = Diagnostics::new();
    let table = CsvTable::parse("x.csv", "position_mm,EXX_um\n0,0\n10,1500\n", &mut problems);
    if let (Some(column), Ok(unit)) = (table.column("EXX_um"), Unit::find("um", Dimension::Length))
        && let Some(values) = table.in_unit(column, unit, &mut problems)
    {
        println!("EXX at 10 mm: {} mm", values[1]);
    }
}
