//! The part cut along an NC program instead of the ideal path.

use super::Error;
use std::path::{Path, PathBuf};
use trueaxis_geometry::Vec3;
use trueaxis_input::{Diagnostics, Files, Place};
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{Approach, Command, MAX_AXES};
use trueaxis_machine::tcp::TipControl;
use trueaxis_motion::axis_path::AxisPath;
use trueaxis_motion::{Densify, PathStep, ProgramFiles, execute};
use trueaxis_nc::moves::Step;
use trueaxis_part::testpiece::ToolPosition;

/// What a program commands while it cuts.
#[derive(Debug, Clone, PartialEq)]
pub struct CutProgram {
    /// The program.
    pub path: PathBuf,
    /// Ends of straight pieces of the axes with feed, in order.
    places: Vec<PathPlace>,
}

#[derive(Debug, Clone, Copy, PartialEq)]
struct PathPlace {
    command: Command,
    approach: Approach,
    /// Of the nominal machine.
    tip: Vec3,
    /// The piece that ends here is cut with feed.
    cuts: bool,
}

/// The program must come as near to every tool position as this, mm.
const NEAR_MM: f64 = 2.0;

/// Where the control is when the actual tool passes a tool position.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Passing {
    pub command: Command,
    pub approach: Approach,
}

impl CutProgram {
    /// Reads a program and what it commands on a machine; a set-up file next to it is read.
    pub fn read(
        files: &Files,
        path: &Path,
        machine: &Machine,
        problems: &mut Diagnostics,
    ) -> Option<Self> {
        let files = ProgramFiles { files, program: path, text: None, setup: None, control: None };
        let setup = files.setup(machine, problems)?;
        let program = files.program(&setup, problems)?;
        let mut places = Vec::new();
        let machine = setup.mounted(machine);
        let control = TipControl::of(&machine)?;
        let mut axes = AxisPath::new(&machine, &setup, Densify::default(), 0.01);
        let (mut last, mut approach) = (*axes.command(), Approach::default());
        let settings = setup.settings(false);
        let outcome = execute(&machine, &program, &setup, &settings, &mut |step: Step| {
            axes.take(&step, &mut |step| {
                let PathStep::Node(node) = step else { return };
                for i in 0..MAX_AXES {
                    let by = node.command[i] - last[i];
                    approach[i] = if by.abs() > 1e-13 { by.signum() } else { approach[i] };
                }
                last = node.command;
                let tip = control.tip_and_axis(&node.command).0;
                let cuts = !node.is_rapid();
                places.push(PathPlace { command: node.command, approach, tip, cuts });
            });
        });
        // What the machine makes of the words is reported by simulate; here only what stops it.
        for problem in outcome.problems.iter().filter(|p| is_error(p)) {
            let (message, place) = (problem.message.clone(), problem.place.clone());
            problems.error(problem.code, place, message, &problem.hint);
        }
        if let Some(fault) = axes.faults.first() {
            let file = program.file().to_owned();
            let place = Place { file, line: fault.origin.line as usize, column: 1 };
            problems.error(fault.code, place, fault.message.clone(), fault.hint);
        }
        (!problems.has_errors()).then(|| Self { path: path.to_owned(), places })
    }

    /// Where the control is when the actual tool passes each tool position.
    pub(super) fn passings(
        &self,
        machine: &Machine,
        positions: &[ToolPosition],
    ) -> Result<Vec<Passing>, Error> {
        let passing = |(i, position): (usize, &ToolPosition)| {
            let tip = position.tip.vector();
            self.passing(machine, tip).map_err(|by_mm| Error::Program { position: i, by_mm })
        };
        positions.iter().enumerate().map(passing).collect()
    }

    /// The place nearest to a tip; how far it is if that is too far.
    fn passing(&self, machine: &Machine, tip: Vec3) -> Result<Passing, f64> {
        let pieces = self.places.windows(2).filter(|w| w[1].cuts);
        let distance = |w: &[PathPlace]| {
            let u = along(w[0].tip, w[1].tip, tip);
            (w[0].tip + (w[1].tip - w[0].tip) * u - tip).norm()
        };
        let nearest = pieces.map(|w| (distance(w), w)).min_by(|a, b| a.0.total_cmp(&b.0));
        let (by_mm, piece) = nearest.ok_or(f64::INFINITY)?;
        if by_mm.is_nan() || by_mm > NEAR_MM {
            return Err(by_mm);
        }
        // On the way of the actual tool, which is where the part is cut.
        let actual = |command: &Command| {
            let errors = machine.errors_at(command, &piece[1].approach).unwrap_or_default();
            let there = machine.deviation(command, &errors);
            there.nominal_tip.vector() + there.tip_mm
        };
        let (from, to) = (&piece[0].command, &piece[1].command);
        let u = along(actual(from), actual(to), tip);
        let command = std::array::from_fn(|i| from[i] + (to[i] - from[i]) * u);
        Ok(Passing { command, approach: piece[1].approach })
    }
}

fn is_error(problem: &trueaxis_input::Diagnostic) -> bool {
    problem.severity == trueaxis_input::Severity::Error
}

/// The part of the way from a to b that is nearest to a point.
fn along(a: Vec3, b: Vec3, point: Vec3) -> f64 {
    let way = b - a;
    let length = way.norm_squared();
    if length > 1e-18 { ((point - a).dot(&way) / length).clamp(0.0, 1.0) } else { 1.0 }
}
