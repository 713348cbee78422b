//! A three-axis mill with a squareness error of 10 µrad between Y and X: the deviation of the tool tip
//! and the compensated command. `cargo run -p trueaxis-machine --example squareness`.
#![allow(clippy::print_stdout)]

use trueaxis_machine::compensate::{Compensator, Scope};
use trueaxis_machine::{Machine, file::NoTables};

const MILL: &str = r#"
[machine]
name = "three-axis mill"
chain = "w b Y X Z t"
[tool]
length = "100 mm"
[location]
EC0Y = "10 ± 1 urad"
"#;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let (machine, problems) = Machine::check("mill.toml", MILL, &NoTables);
    for problem in problems.iter() {
        println!("{problem}");
    }
    let machine = machine.ok_or("the machine file has errors")?;

    // Axis positions in mm, in the order of the chain: Y = 500, X = 0, Z = 0.
    let command = [500.0, 0.0, 0.0, 0.0, 0.0, 0.0];
    let errors = machine.errors_at(&command, &[0.0; 6])?;
    let deviation = machine.deviation(&command, &errors);
    // By hand: −10 µrad · 500 mm = −0.005 mm in X.
    println!("deviation of the tip in X: {:.6} mm", deviation.tip_mm.x);

    // The compensated command moves X by +0.005 mm.
    let compensated = Compensator::of(&machine, Scope::Position)?.at(&command, &[0.0; 6])?;
    println!("compensated command of X: {:.6} mm", compensated.command[1]);
    Ok(())
}
