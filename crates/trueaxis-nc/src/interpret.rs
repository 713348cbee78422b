//! The common entry point for all controls: a program is executed by the rules of its control.

use crate::dialect::Control;
use crate::execution::{Alone, Core, Follower, Library, Outcome, Settings};
use crate::moves::Step;
use crate::text::program::Program;
use crate::{heidenhain, rs274, sinumerik};

/// Executes a program without a machine. Each move and event is passed to `take` in the order of execution; the outcome
/// has the problems.
///
/// ```
/// use trueaxis_nc::{Control, NoLibrary, Program, Settings, Step, interpret};
/// let text = b"G21 G90 F100\nG1 X10 Y#1\no1 repeat [2]\nG91 G1 X1\no1 endrepeat\nM2\n";
/// let program = Program::new("demo.ngc", text.to_vec(), Control::LinuxCnc);
/// let mut x_mm = Vec::new();
/// let outcome = interpret(&program, &NoLibrary, &Settings::default(), &mut |step| {
///     if let Step::Move(m) = step {
///         x_mm.push(m.target.0[0]);
///     }
/// });
/// assert!(outcome.finished);
/// assert_eq!(x_mm, [10.0, 11.0, 12.0]);
/// ```
pub fn interpret(
    program: &Program,
    library: &dyn Library,
    settings: &Settings,
    take: &mut dyn FnMut(Step),
) -> Outcome {
    interpret_on(program, library, settings, &mut Alone { take, steps: 0 })
}

/// Executes a program on a machine that follows it: incremental words and axes that a block does not name
/// count from where the machine is.
pub fn interpret_on(
    program: &Program,
    library: &dyn Library,
    settings: &Settings,
    follower: &mut dyn Follower,
) -> Outcome {
    let core = Core::new(program, library, settings, follower);
    match program.dialect().control {
        Control::Fanuc | Control::Haas | Control::LinuxCnc => rs274::interpret(program, core),
        Control::Sinumerik840d => sinumerik::interpret(program, core),
        Control::Heidenhain => heidenhain::interpret(core),
    }
}
