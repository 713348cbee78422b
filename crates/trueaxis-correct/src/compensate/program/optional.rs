//! Optional blocks, `/`: what is written must fit without them, too.
//!
//! ```text
//!     program ──compensated with its optional blocks──> A       program without them ──compensated──> B
//!     A without its optional blocks must go as B
//! ```
//!
//! Words that blocks do not have are added where the program stands then: after an optional block that is left
//! out it stands elsewhere, and a loop or a call that was optional is unrolled.

use super::flat::{is_same, plain};
use super::{ProgramOptions, Rewritten, residual_with_rounding};
use trueaxis_input::Place;
use trueaxis_machine::Machine;
use trueaxis_motion::{SetUp, execute};
use trueaxis_nc::moves::{MoveKind, Step};
use trueaxis_nc::{Control, Program};

/// The first line that begins with `/`, from 1.
pub(super) fn first(program: &Program) -> Option<u32> {
    let is_klartext = program.dialect().control == Control::Heidenhain;
    let begins = |line: &[u8]| {
        let text = line.trim_ascii_start();
        let numbered = match text.first() {
            Some(b'N' | b'n') => &text[1..],
            _ if is_klartext => text,
            _ => &text[..0],
        };
        let digits = numbered.iter().take_while(|b| b.is_ascii_digit()).count();
        let after = numbered[digits..].trim_ascii_start();
        text.first() == Some(&b'/') || digits > 0 && after.first() == Some(&b'/')
    };
    // Most programs have none.
    let source = Some(program.source()).filter(|source| source.contains(&b'/'))?;
    let mut lines = source.split(|b| *b == b'\n');
    lines.position(begins).map(|line| line as u32 + 1)
}

/// Adds an objection if the written program goes elsewhere without its optional blocks. `other` is the program
/// compensated without them.
pub(super) fn check(
    (machine, setup): (&Machine, &SetUp),
    program: &Program,
    options: &ProgramOptions,
    (done, other): (&mut Rewritten, Option<&Rewritten>),
    line: u32,
) {
    let mounted = setup.mounted(machine);
    let steps = |text: &Program| -> Option<Vec<Step>> {
        let mut steps = Vec::new();
        let outcome = execute(&mounted, text, setup, &setup.settings(false), &mut |step| {
            steps.extend(plain(step, None).map(|(step, _)| step));
        });
        // What stands after the last move is not written.
        let end = steps.iter().rposition(|step| matches!(step, Step::Move(_))).map_or(0, |k| k + 1);
        steps.truncate(end);
        (!outcome.problems.has_errors()).then_some(steps)
    };
    if steps(program).is_none() {
        // It is not meant to run without them.
        return;
    }
    let read = |of: &Rewritten| {
        steps(&Program::of(program.file(), of.text.clone(), program.dialect().control))
    };
    let is_same = other.and_then(read).zip(read(done)).is_some_and(|(wanted, written)| {
        let mut both = wanted.iter().zip(&written).enumerate();
        let tolerance = |k: usize| match begins_no_cut(&wanted[k..]) {
            // Whether it is corrected is all the same.
            true => options.limit.tip_mm,
            false => residual_with_rounding(options),
        };
        wanted.len() == written.len() && both.all(|(k, (a, b))| is_same(a, b, tolerance(k)))
    });
    if !is_same {
        let place = Place { file: program.file().to_owned(), line: line as usize, column: 1 };
        let message = "without its optional blocks (/) the written program would go elsewhere than the program";
        let hint = "it is written for their being executed; delete them, or their marks, and compensate the rest";
        done.unproved.warn("optional-blocks", place, message.to_owned(), hint);
    }
}

/// Whether the first step is a rapid that no cut follows.
fn begins_no_cut(steps: &[Step]) -> bool {
    let is_rapid = |step: &Step| match step {
        Step::Move(m) => Some(m.kind == MoveKind::Rapid),
        Step::Event(..) => None,
    };
    let mut moves = steps.iter().filter_map(is_rapid);
    steps.first().and_then(is_rapid) == Some(true) && moves.nth(1).unwrap_or(true)
}
