//! An NC program so rewritten that the actual tool goes where the programmed one should.
//!
//! ```text
//!     program ──execute──> moves ──AxisPath──> commands, nominal stands    walk
//!     commands ──Compensator──> commands that lead the actual tool there   correct
//!     ──cut──> straight pieces within the residual                         stand
//!     ──words──> numbers in the text; everything else stays as it is       block, words, text
//!     text ──simulate on the actual machine──> residual error              verify
//! ```

mod ahead;
mod arcs;
mod block;
mod computed;
mod correct;
mod feed;
mod flat;
mod found;
mod guard;
mod length;
mod line_table;
mod lines;
mod number;
mod optional;
mod options;
mod radius;
mod ready;
mod refuse;
mod stand;
mod text;
mod turns;
mod verify;
mod walk;
mod words;

pub use computed::Expression;
pub use correct::CorrectionLimit;
pub use found::{Found, LargestCorrection};
pub use guard::{Confidence, Convention, MARK, Wrong, is_compensated};
pub use number::Increments;
pub use options::ProgramOptions;
pub use verify::{BlockResidual, Largest, Proof, Residual};

use ahead::{Gather, Stretches};
use line_table::LineTable;
use options::{residual_of_pieces, residual_share};
use ready::Preparer;
use std::ops::Range;
use std::sync::Mutex;
use trueaxis_input::{Content, Diagnostic, Diagnostics, Place};
use trueaxis_machine::Machine;
use trueaxis_motion::Densify;
use trueaxis_motion::SetUp;
use trueaxis_motion::axis_path::AxisPath;
use trueaxis_motion::axis_path::Fault;
use trueaxis_motion::execute_on;
use trueaxis_motion::place;
use trueaxis_nc::{Follower, Outcome, Program, Settings};
use walk::Walk;

/// Places of a circle on one piece of the length that its sagitta allows: n places between two ends
/// are 1/n² of that sagitta off their own chords.
const PLACES_OF_A_PIECE: f64 = 6.0;

/// A program that was compensated.
#[derive(Debug, Clone)]
pub struct Rewritten {
    /// The text; a long one where the files of the set-up keep it.
    pub text: Content,
    /// What was done.
    pub found: Found,
    /// What it does on the actual machine.
    pub proof: Proof,
    /// How well the corrections are known.
    pub confidence: Confidence,
    /// What no correction and wrong signs would leave.
    pub conventions: Vec<Convention>,
    /// What the proof holds against the program; empty if it is proved.
    pub unproved: Diagnostics,
    /// The first line that each line became.
    numbers: Vec<u32>,
    /// The program adds a radius that is not 0 to its contour.
    radius_added: bool,
}

/// Places are examined so finely; each further try halves it.
const SPACING_MM: f64 = 5.0;
const ANGLE_DEG: f64 = 0.6;
const TRIES: u32 = 6;
/// A try that leaves more than this share of what the one before left is of no use.
const IDLE: f64 = 0.95;
const ARCS: u32 = 2;

/// Receives the part that is done, 0 to 1.
pub type Progress<'p> = &'p (dyn Fn(f64) + Sync + 'p);

/// Rewrites a program so that the actual tool goes where it says, and proves it by simulating the
/// written text on the actual machine.
///
/// No text comes back where a block cannot be corrected; the block, the reason and what to do are
/// in the diagnostics. What the proof holds against a text is in [`Rewritten::unproved`].
pub fn compensate_program(
    machine: &Machine,
    program: &Program,
    setup: &SetUp,
    options: &ProgramOptions,
) -> (Option<Rewritten>, Diagnostics) {
    compensate_program_with(machine, program, setup, options, &|_| {})
}

/// The same, and says how far it is, by the lines that are corrected in the first try.
pub fn compensate_program_with(
    machine: &Machine,
    program: &Program,
    setup: &SetUp,
    options: &ProgramOptions,
    progress: Progress<'_>,
) -> (Option<Rewritten>, Diagnostics) {
    // A program that is unrolled is walked again: the part that is done does not go back.
    let most = Mutex::new(0.0);
    let grows = |part: f64| {
        let Ok(mut most) = most.lock() else { return };
        if part > *most {
            *most = part;
            progress(part);
        }
    };
    let (mut done, problems) = compensated(machine, program, setup, (options, &grows));
    let marked = optional::first(program).filter(|_| !setup.without_optional);
    if let (Some(done), Some(line)) = (done.as_mut().filter(|done| done.is_proved()), marked) {
        let without = &setup.without_optional();
        let (other, _) = compensated(machine, program, without, (options, &|_| {}));
        optional::check((machine, without), program, options, (done, other.as_ref()), line);
    }
    if let Some(done) = &mut done {
        done.found.forget();
    }
    (done, problems)
}

fn compensated(
    machine: &Machine,
    program: &Program,
    setup: &SetUp,
    task: Task<'_>,
) -> (Option<Rewritten>, Diagnostics) {
    let (options, _) = task;
    let mut problems = Diagnostics::new();
    if is_compensated(program.source()) {
        let message = "the program is compensated already, its heading says so".to_owned();
        let hint = "take the program as the postprocessor wrote it";
        problems.error("already-compensated", Place::whole(program.file()), message, hint);
        return (None, problems);
    }
    let machine = &super::not_twice(machine, Place::whole(program.file()), &mut problems);
    if !options.flat {
        let (done, found) = match on_contour(machine, program, setup, task) {
            OnContour::Done(done, found) => (*done, found),
            OnContour::Lost(why) => {
                return centre_path(machine, program, setup, task, why, problems);
            }
        };
        let Some(why) = reason_to_unroll(done.as_ref(), &found) else {
            problems.append(found);
            return (done, problems);
        };
        let message = format!("{}; the program is unrolled", why.message);
        let hint = "the lines of the report are those of the unrolled program; where the program computes, it \
                    has the numbers of this run";
        problems.note("unrolled", why.place, message, hint);
    }
    let mounted = setup.mounted(machine);
    let kept = &setup.on_contour();
    let Some(once) = flat::unrolled(&mounted, program, kept, flat::Contour::Kept, &mut problems)
    else {
        return (None, problems);
    };
    let mut answer = on_contour(machine, &once, setup, task);
    // A cycle with computed words has numbers now: the second time it becomes its moves.
    if matches!(&answer, OnContour::Done(done, found) if reason_to_unroll(done.as_ref().as_ref(), found).is_some())
    {
        let contour = flat::Contour::Kept;
        let twice = flat::unrolled(&mounted, &once, kept, contour, &mut Diagnostics::new());
        let twice = twice.map(|twice| on_contour(machine, &twice, setup, task));
        if let Some(better @ OnContour::Done(..)) = twice
            && better.is_written()
        {
            answer = better;
        }
    }
    match answer {
        OnContour::Done(done, found) => {
            // An approach has no words of its own, its path has.
            let no_words = found.iter().find(|d| ONLY_AS_PATH.contains(&d.code));
            if let Some(why) = no_words.filter(|_| radius::is_used(machine, program, setup)) {
                let (place, message) = (why.place.clone(), why.message.clone());
                let why = Lost { place, message };
                return centre_path(machine, program, setup, task, why, problems);
            }
            problems.append(found);
            (*done, problems)
        }
        OnContour::Lost(why) => centre_path(machine, program, setup, task, why, problems),
    }
}

/// What is wanted, and what receives the progress.
type Task<'t> = (&'t ProgramOptions, Progress<'t>);

/// Why the program has to be unrolled: a block that cannot be corrected where it stands, or a proof that does
/// not hold with corrected expressions.
fn reason_to_unroll(done: Option<&Rewritten>, found: &Diagnostics) -> Option<Lost> {
    let lost = |d: &Diagnostic| Lost { place: d.place.clone(), message: d.message.clone() };
    let refused = found.iter().find(|d| UNROLLED_FOR.contains(&d.code));
    let computes =
        done.filter(|done| done.found.expressions_corrected > 0 || done.found.led_elsewhere);
    let unproved = || computes.and_then(|done| done.unproved.iter().next());
    refused.or_else(unproved).map(lost)
}

/// The path of the centre of the tool, without radius compensation.
fn centre_path(
    machine: &Machine,
    program: &Program,
    setup: &SetUp,
    task: Task<'_>,
    why: Lost,
    mut problems: Diagnostics,
) -> (Option<Rewritten>, Diagnostics) {
    let hint = "the path of the centre is written, without G41, G42, RL and RR: the radius of the \
                set-up file is in it, and the control must not add it again";
    problems.note("radius-compensation-removed", why.place, why.message, hint);
    let mounted = setup.mounted(machine);
    match flat::unrolled(&mounted, program, setup, flat::Contour::Centre, &mut problems) {
        None => (None, problems),
        Some(unrolled) => {
            let (done, found) = tried(machine, &unrolled, &setup.on_contour(), task);
            problems.append(found);
            (done, problems)
        }
    }
}

/// What became of the words of a contour.
enum OnContour {
    /// They are corrected, or why not.
    Done(Box<Option<Rewritten>>, Diagnostics),
    /// The centre of the tool would not keep the residual.
    Lost(Lost),
}

impl OnContour {
    /// Whether there is a program.
    fn is_written(&self) -> bool {
        matches!(self, Self::Done(done, _) if done.is_some())
    }
}

/// Where the centre of the tool would miss its path.
struct Lost {
    place: Place,
    message: String,
}

/// What a flat program with numbers does not have.
const UNROLLED_FOR: [&str; 7] = [
    // The first move of a cycle.
    "no-axis-word",
    "computed-feed",
    "executed-again",
    "in-subprogram",
    "computed-coordinate",
    "several-moves",
    "other-coordinates",
];

/// Corrects the words of the contour; where the program adds the radius of a tool to it, the centre of the tool
/// must keep the residual, too.
fn on_contour(machine: &Machine, program: &Program, setup: &SetUp, task: Task<'_>) -> OnContour {
    let (options, _) = task;
    let (mut done, mut problems) = tried(machine, program, &setup.on_contour(), task);
    let Some(rewritten) = done.as_mut().filter(|done| done.radius_added) else {
        return OnContour::Done(Box::new(done), problems);
    };
    let written = Program::of(program.file(), rewritten.text.clone(), program.dialect().control);
    let places = densify(options, 1, 2);
    let mut ends: Vec<u32> =
        rewritten.found.wants.iter().filter(|w| w.is_end_only()).map(|w| w.line).collect();
    ends.sort_unstable();
    let lines = [&rewritten.numbers[..], &ends];
    let left = match radius::left(machine, [program, &written], setup, lines, places) {
        Ok(left) => left,
        Err(found) => {
            problems.append(found);
            return OnContour::Done(Box::new(None), problems);
        }
    };
    let place = Place { file: program.file().to_owned(), line: left.line as usize, column: 1 };
    let message = match left.value.is_nan() {
        true => "with the corrections the tool would not fit into the contour".to_owned(),
        false => format!(
            "with radius compensation the centre of the tool leaves its path by up to {:.3} µm",
            left.value * 1e3
        ),
    };
    if left.value.is_nan() || left.value > residual_with_rounding(options) {
        return OnContour::Lost(Lost { place, message });
    }
    let hint = "the words of the contour are corrected, its radius compensation stays";
    problems.note("radius-compensation-kept", place, message, hint);
    OnContour::Done(Box::new(done), problems)
}

/// What an unrolled program still has where the way to a contour and away from it is in one block.
const ONLY_AS_PATH: [&str; 3] = ["other-coordinates", "several-moves", "no-axis-word"];

/// Tries with finer and finer places until the program keeps the residual.
fn tried(
    machine: &Machine,
    program: &Program,
    setup: &SetUp,
    (options, progress): Task<'_>,
) -> (Option<Rewritten>, Diagnostics) {
    let mut problems = Diagnostics::new();
    let mut best: Option<Rewritten> = None;
    let mut attempt = 0;
    while attempt < TRIES {
        // How many tries follow is not known: a bar that goes back would say less.
        let shown: Progress<'_> = if attempt == 0 { progress } else { &|_| {} };
        let (rewritten, found) = once(machine, program, setup, (options, shown), attempt);
        problems = found;
        let Some(rewritten) = rewritten else { return (None, problems) };
        let done = rewritten.is_within(options);
        // Finer places help no more; once more, with lines for circles.
        let is_idle =
            best.as_ref().is_some_and(|b| rewritten.share(options) > IDLE * b.share(options));
        best = Some(rewritten);
        if done || is_idle && attempt >= ARCS {
            break;
        }
        attempt = if is_idle { ARCS } else { attempt + 1 };
    }
    if let Some(rewritten) = &mut best {
        rewritten.unproved = rewritten.objections(program, options);
    }
    (best.filter(|_| !problems.has_errors()), problems)
}

fn densify(options: &ProgramOptions, attempt: u32, least: u32) -> Densify {
    let part = 0.5_f64.powi(attempt as i32);
    Densify::Places {
        // A little less, so that what the machine does to the circle does not cost a place.
        chord_mm: 0.97 * residual_of_pieces(options)[0] / PLACES_OF_A_PIECE.powi(2),
        angle_rad: (ANGLE_DEG * part).to_radians(),
        spacing_mm: SPACING_MM * part,
        least,
    }
}

fn once(
    machine: &Machine,
    program: &Program,
    setup: &SetUp,
    (options, progress): Task<'_>,
    attempt: u32,
) -> (Option<Rewritten>, Diagnostics) {
    let mut problems = Diagnostics::new();
    let mounted = setup.mounted(machine);
    // Where a turn counts it has to be seen.
    let least = if correct::reverses(machine) { 2 << attempt } else { 1 };
    let refuse = |problems: &mut Diagnostics, programs: &[String], fault: &Fault| {
        let place = place(program, programs, fault);
        problems.error(fault.code, place, fault.message.clone(), fault.hint);
    };
    let table = LineTable::of(program);
    let walked = |report_blocks: bool| {
        let walk = Walk::new(&mounted, &table, setup, options)?;
        // The first tries keep circles; where the proof speaks against it, they become lines.
        let walk = if attempt < ARCS { walk } else { walk.without_arcs() };
        let nominal = AxisPath::new(&mounted, setup, densify(options, attempt, least), 0.01);
        let settings = Settings { report_blocks, ..setup.settings(false) };
        let preparer = Preparer::of(&mounted, setup, options);
        let gather = Gather::along((nominal, preparer), &table, progress);
        Ok(both(gather, walk, |ahead| execute_on(&mounted, program, setup, &settings, ahead)))
    };
    let reported = computed::may_compute(program);
    // Another program may compute, too.
    let alone = |outcome: &Outcome| reported || outcome.programs.len() < 2;
    let (outcome, walk) = match walked(reported) {
        Ok((outcome, walk)) if alone(&outcome) => (outcome, walk),
        done => match done.and_then(|_| walked(true)) {
            Ok(done) => done,
            Err(fault) => {
                refuse(&mut problems, &[], &fault);
                return (None, problems);
            }
        },
    };
    problems.append(outcome.problems);
    setup.check_for(program, &mut problems);
    if let Some(fault) = &walk.fault {
        refuse(&mut problems, &outcome.programs, fault);
    }
    if !problems.has_errors() {
        let wanted = (program.file(), setup, options.residual_mm);
        length::require(&mounted, &walk, wanted, &mut problems);
    }
    if problems.has_errors() {
        return (None, problems);
    }
    let tooled = walk.machine();
    let confidence = guard::confidence(tooled, &walk.found.places);
    let worst = walk.found.worst;
    let conventions = worst
        .map_or(Vec::new(), |(_, nominal, command)| guard::conventions(tooled, &nominal, &command));
    let control = program.dialect().control;
    let (text, numbers) = match walk.text.finish(&setup.files) {
        Ok(written) => written,
        Err(fault) => {
            let message = format!("the text of the new program cannot be kept: {fault}");
            let hint = "is there room in /var/tmp?";
            problems.error("unwritable-file", Place::whole(program.file()), message, hint);
            return (None, problems);
        }
    };
    let (mut found, radius_added) = (walk.found, walk.radius_added);
    found.end();
    drop(table);
    let written = Program::of(program.file(), text, control);
    // The middle of every block at least is examined.
    let finer = densify(options, attempt + 1, 2 * least);
    let by = (finer, options.limits_between());
    let proof = verify::prove(machine, [program, &written], setup, &found, &numbers, by);
    let rewritten = Rewritten {
        text: written.into_source(),
        found,
        proof,
        confidence,
        conventions,
        unproved: Diagnostics::new(),
        numbers,
        radius_added,
    };
    (Some(rewritten), problems)
}

/// Executes a program, and writes it in a thread of its own.
fn both<'w>(
    (mut ahead, stretches): (Gather<'_>, Stretches),
    mut walk: Walk<'w>,
    execute: impl FnOnce(&mut dyn Follower) -> Outcome,
) -> (Outcome, Walk<'w>) {
    std::thread::scope(|scope| {
        let writer = scope.spawn(move || {
            for mut stretch in stretches.next {
                walk.take(&mut stretch);
                if walk.fault.is_some() {
                    break;
                }
                // Of no use to one that has enough of them.
                let _ = stretches.written.try_send(stretch);
            }
            walk
        });
        let outcome = execute(&mut ahead);
        ahead.finish();
        match writer.join() {
            Ok(walk) => (outcome, walk),
            Err(panic) => std::panic::resume_unwind(panic),
        }
    })
}

impl Rewritten {
    /// What rounding and what cannot be corrected leave at the end of a block, mm.
    fn allowed_mm(options: &ProgramOptions) -> f64 {
        options.increments.map_or(1e-9, |i| i.linear_mm)
    }

    /// Whether the written program does what was asked for, on the way between the ends.
    fn is_within(&self, options: &ProgramOptions) -> bool {
        let after = &self.proof.after;
        let [tip_mm, turned] = options.limits_between();
        // A machine that cannot turn the tool is held to a residual of its axis only where one is asked.
        let is_free = !self.found.axis_left.is_empty() && !options.residual_axis_asked;
        // NaN is not within.
        (is_free || after.axis.value <= turned) && after.tip.value <= tip_mm
    }

    /// What remains between the ends of blocks as a share of what may remain; not a number is more than all.
    fn share(&self, options: &ProgramOptions) -> f64 {
        let after = &self.proof.after;
        let [tip_mm, turned] = options.limits_between();
        let is_free = !self.found.axis_left.is_empty() && !options.residual_axis_asked;
        let axis = if is_free { 0.0 } else { after.axis.value / turned };
        let share = (after.tip.value / tip_mm).max(axis);
        if after.tip.value.is_nan() || after.axis.value.is_nan() { f64::INFINITY } else { share }
    }

    /// The lines of the written program that a line of the program as it was became, counted from 1; the last one has
    /// no end. What stands before the block of the next line counts to it. Those of a program that was unrolled are
    /// lines of the unrolled one.
    pub fn lines_of(&self, line: u32) -> Option<Range<u32>> {
        let first = |line: u32| self.numbers.get(line as usize).copied();
        let before = line.checked_sub(1)?;
        Some(first(before)?..first(line).unwrap_or(u32::MAX))
    }

    /// Whether the written program was proved: only then it may go to the machine.
    pub fn is_proved(&self) -> bool {
        self.unproved.iter().next().is_none()
    }

    /// What the proof holds against the written program.
    fn objections(&self, program: &Program, options: &ProgramOptions) -> Diagnostics {
        let (proof, file) = (&self.proof, program.file());
        let mut found = Diagnostics::new();
        for problem in
            proof.problems.iter().filter(|p| p.severity == trueaxis_input::Severity::Error)
        {
            let message = format!("the compensated program cannot be read: {}", problem.message);
            found.warn("not-proved", problem.place.clone(), message, &problem.hint);
        }
        let mut off = |line: u32, message: String, hint: &str| {
            let place = Place { file: file.to_owned(), line: line as usize, column: 1 };
            found.warn("not-proved", place, message, hint);
        };
        let end = proof.after.tip_end;
        let (residual, [tip, axis]) =
            (residual_with_rounding(options), [proof.after.tip, proof.after.axis]);
        let reversal =
            "an axis reverses by less than its reversal error: accept a larger --residual";
        let hint = match self.found.undecided {
            0 => "accept a larger --residual, or write smaller --increment",
            _ => reversal,
        };
        let allowed_mm = match self.found.undecided {
            0 => Self::allowed_mm(options),
            _ => residual,
        };
        if end.value.is_nan() || end.value > allowed_mm {
            let left = end.value * 1e3;
            off(end.line, format!("read back, the tip ends {left:.6} µm from its place"), hint);
        }
        if !self.is_within(options) {
            let left =
                format!("{:.4} µm, the tool axis by {:.4}", tip.value * 1e3, axis.value * 1e6);
            let message = format!("read back, the tip leaves its path by {left} µrad");
            off(if tip.value > residual { tip.line } else { axis.line }, message, hint);
        }
        if let Some(other) = self.found.other_length.filter(|_| found.iter().next().is_some()) {
            other.tell(file, &mut found);
        }
        if proof.issues.is_critical() {
            let message = "in the compensated program an axis leaves its travel".to_owned();
            let hint = "move the part; simulate shows the block";
            found.warn("correction-leaves-travel", Place::whole(file), message, hint);
        }
        found
    }
}

/// The asked residual and what rounding to increments adds, mm.
fn residual_with_rounding(options: &ProgramOptions) -> f64 {
    options.residual_mm + options.increments.map_or(0.0, |i| i.linear_mm)
}
