//! Executes SINUMERIK programs.

use trueaxis_geometry::input::{Diagnostics, Place};

use crate::interpreter::{Outcome, Settings};
use crate::library::Library;
use crate::moves::Step;
use crate::program::Program;

pub(crate) fn interpret(
    program: &Program,
    _library: &dyn Library,
    _settings: &Settings,
    _take: &mut dyn FnMut(Step),
) -> Outcome {
    let mut problems = Diagnostics::new();
    let message = "programs of this control are not interpreted yet".to_owned();
    problems.error("control-not-interpreted", Place::whole(program.file()), message, "");
    Outcome { problems, finished: false, programs: vec![program.file().to_owned()] }
}
