//! Compensated programs on every machine, for every control: the actual tool goes where the
//! programmed one should.

#![allow(clippy::print_stdout, reason = "the whole set says what it found")]

mod library;

use library::paths::{cl, free_form, ways};
use library::{MACHINES, machine};
use trueaxis::compensate::post::{PostOptions, post};
use trueaxis::compensate::program::{
    Increments, MARK, ProgramOptions, Rewritten, compensate_program,
};
use trueaxis::geometry::input::Diagnostics;
use trueaxis::machine::Machine;
use trueaxis::nc::{Control, Program};
use trueaxis::simulate::SetUp;

fn name(control: Control) -> &'static str {
    match control {
        Control::Fanuc => "a.nc",
        Control::Sinumerik840d => "a.mpf",
        Control::Heidenhain => "a.h",
        Control::LinuxCnc => "a.ngc",
    }
}

fn compensated(
    machine: &Machine,
    text: &[u8],
    control: Control,
    options: &ProgramOptions,
) -> (Option<Rewritten>, Diagnostics) {
    let program = Program::new(name(control), text.to_vec(), control);
    compensate_program(machine, &program, &SetUp::default(), options)
}

fn codes(problems: &Diagnostics) -> Vec<String> {
    let errors = problems.iter().filter(|d| d.code != "no-set-up" && d.code != "assumed-limits");
    errors.map(ToString::to_string).collect()
}

/// All machines and all ways to write a program; what is left in the worst case, mm and rad.
fn prove_all(increments: Option<Increments>, points: usize) -> [f64; 4] {
    let options = ProgramOptions { increments, ..ProgramOptions::default() };
    let mut worst = [0.0_f64; 4];
    let mut faults = Vec::new();
    for name in MACHINES {
        let machine = machine(name);
        for (i, way) in ways().iter().enumerate() {
            let path = free_form(&machine, 7 * i as u64 + name.len() as u64, points);
            let (posted, problems) = post(&machine, &cl(&path), way);
            let posted = posted.unwrap_or_else(|| panic!("{problems:?}"));
            let (done, problems) = compensated(&machine, &posted.text, way.control, &options);
            let Some(done) = done else {
                faults.push(format!("{name} {:?} {:?}: {:?}", way.control, way.tip_words, codes(&problems)));
                continue;
            };
            let after = done.proof.after;
            let five = machine.axes().len() == 5 && done.found.axis_left.is_empty();
            let decided = done.found.undecided == 0;
            let found = [
                if decided { after.tip_end.value } else { 0.0 },
                if five && decided { after.axis_end.value } else { 0.0 },
                if decided { after.tip.value } else { 0.0 },
                if five && decided { after.axis.value } else { 0.0 },
            ];
            println!(
                "{name:15} {:?} {:?} {} blocks {} pieces, {} undecided, {:?}: {found:?} before {:?}",
                way.control, way.tip_words, done.found.blocks, done.found.pieces,
                done.found.undecided, done.found.axis_left, done.proof.before.tip_end
            );
            worst = std::array::from_fn(|k| worst[k].max(found[k]));
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
    worst
}

#[test]
fn law_without_rounding_every_block_end_is_met() {
    let worst = prove_all(None, 40);
    println!("without rounding: {worst:?}");
    assert!(worst[0] <= 1e-9 && worst[1] <= 1e-12, "{worst:?}");
    assert!(worst[2] <= 1e-3 && worst[3] <= 1e-5, "{worst:?}");
}

#[test]
fn law_with_rounding_every_block_end_is_met_within_an_increment() {
    let worst = prove_all(Some(Increments::default()), 40);
    println!("with increments: {worst:?}");
    assert!(worst[0] <= 1e-3, "{worst:?}");
    assert!(worst[2] <= 2e-3, "{worst:?}");
}
