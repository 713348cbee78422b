//! One comprehensive compensation vector: five axes, ten sensors, splines and integrals.
//!
//! Target (issue 4): under 1 µs on one core. The yardstick of the same run is the machine without
//! heat; making the machine for new temperatures is shown too, since a control does that when the
//! temperatures change, not at every position.
//!
//! ```text
//!     cargo bench -p trueaxis-machine --bench heat
//! ```

#![allow(clippy::print_stdout, reason = "the table is what this program is for")]

use std::hint::black_box;
use std::time::Instant;
use trueaxis_input::Diagnostics;
use trueaxis_machine::Machine;
use trueaxis_machine::batch::{Commands, CompiledMachine, DeviationTable};
use trueaxis_machine::file::Tables;
use trueaxis_machine::heat::Conditions;

const CALLS: usize = 200_000;
/// So many stay in the second-level cache.
const BATCH: usize = 2000;
const ROUNDS: usize = 11;

struct Memory;

impl Tables for Memory {
    fn text(&self, name: &str) -> Result<String, String> {
        let letter = name.chars().next().ok_or("no name")?;
        let mut text = format!("position_mm,E{letter}{letter}_um\n");
        for i in 0..=20 {
            let t = f64::from(i);
            text += &format!("{},{:.3}\n", 100.0 * t, 5.0 * t + 7.0 * (0.8 * t).sin());
        }
        Ok(text)
    }
}

fn machine() -> Machine {
    let mut text = String::from(
        "[machine]\nname = \"bench\"\nchain = \"w C' A' b X Y Z t\"\nsource = \"a bench\"\n\
         [workpiece]\nexpansion = \"13 um/(m K)\"\n[tool]\nlength = \"150 mm\"\n\
         [location]\nEC0Y = \"12 urad\"\nEA0Z = \"7 urad\"\n",
    );
    for axis in ['X', 'Y', 'Z'] {
        let low = axis.to_ascii_lowercase();
        text += &format!(
            "[axis.{axis}]\ntravel = [\"0 mm\", \"2000 mm\"]\n\
             [motion.{axis}]\ntable = \"{axis}.csv\"\nmeasured = {{ temperature = \"20 degC\" }}\n\
             [scale.{axis}]\nexpansion = \"10 um/(m K)\"\n\
             sensors = {{ {low}0 = \"0 mm\", {low}1 = \"1000 mm\", {low}2 = \"2000 mm\" }}\n"
        );
    }
    let (machine, problems) = Machine::check("bench.toml", &text, &Memory);
    machine.unwrap_or_else(|| panic!("{:?}", problems.sorted()))
}

/// Median time of a call, ns.
fn time(mut call: impl FnMut(usize) -> f64, calls: usize) -> f64 {
    let mut times: Vec<f64> = (0..ROUNDS)
        .map(|_| {
            let start = Instant::now();
            for i in 0..calls {
                black_box(call(i));
            }
            start.elapsed().as_secs_f64() * 1e9 / calls as f64
        })
        .collect();
    times.sort_by(f64::total_cmp);
    times[ROUNDS / 2]
}

fn main() {
    let cold = machine();
    let text = "x0=24 x1=27 x2=25 y0=22 y1=23 y2=26 z0=30 z1=28 z2=25 workpiece=29";
    let conditions = || {
        let mut problems = Diagnostics::new();
        let conditions = Conditions::typed("bench", text, &mut problems);
        (conditions.unwrap_or_default(), problems)
    };
    let (ten, mut problems) = conditions();
    let Some(warm) = cold.at(&ten, &mut problems) else { return };
    let vector = |machine: &Machine, i: usize| {
        let q = (i % 1999) as f64;
        let command = [0.3, -0.2, q, 1999.0 - q, 0.5 * q, 0.0];
        let errors = machine.errors_at(&command, &[0.0; 6]);
        errors.map_or(0.0, |e| -machine.deviation(&command, &e).tip_mm.x)
    };
    let without = time(|i| vector(&cold, i), CALLS);
    let with = time(|i| vector(&warm, i), CALLS);
    let compiled = CompiledMachine::new(&warm);
    let columns: [Vec<f64>; 5] = std::array::from_fn(|axis| {
        let q = |i: usize| if axis < 2 { 0.2 } else { (i * (axis + 1) % 1999) as f64 };
        (0..BATCH).map(q).collect()
    });
    let borrowed = columns.each_ref().map(Vec::as_slice);
    let mut table = DeviationTable::zeros(BATCH);
    let together = |_| {
        let commands = Commands::new(&borrowed);
        let done = compiled.deviations(&commands, &mut table.columns());
        done.map_or(0.0, |()| table.at(0).tip_mm.x)
    };
    let batched = time(together, CALLS / BATCH) / BATCH as f64;
    let anew = |_| {
        let made = cold.at(&ten, &mut Diagnostics::new());
        made.map_or(0.0, |m| m.tip_mm().z)
    };
    let making = time(anew, CALLS / 100);
    println!("compensation vector, five axes, ten sensors (target: under 1000 ns)");
    println!("  without heat        {without:8.0} ns");
    println!("  comprehensive       {with:8.0} ns   {:.2} times", with / without);
    println!("  the same in a batch {batched:8.0} ns");
    println!("  new temperatures    {making:8.0} ns   once per change");
}
