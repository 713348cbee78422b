//! The proof: the written text, read back and simulated, against the cutter-location file.

use crate::path::{Event, Stand, Stroke};
use crate::tapped::Tapped;
use crate::{BlockPlace, PostOptions, Posted};
use trueaxis_geometry::{Vec3, angle};
use trueaxis_input::Diagnostics;
use trueaxis_machine::Machine;
use trueaxis_machine::axis::Command;
use trueaxis_machine::tcp::TipControl;
use trueaxis_motion::{
    AxisWatch, Batch, Densify, IssueList, Observer, Options, SetUp, SetUpTool, simulate,
};
use trueaxis_nc::Program;
use trueaxis_nc::moves::{Axis, Frame, Position};
use trueaxis_writer::TipWords;

/// The largest differences between program and file.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Verification {
    /// Blocks that were compared at their ends.
    pub compared: usize,
    /// Of the tip at the ends of blocks, mm.
    pub tip_at_ends: Largest,
    /// Of the tool axis at the ends of blocks, rad.
    pub axis_at_ends: Largest,
    /// Of the tip from the path, anywhere, mm.
    pub tip_between: Largest,
    /// Of the tool axis, anywhere, rad.
    pub axis_between: Largest,
    /// Of the lead of tapped threads over their depth, mm; infinite where one is not tapped, or has the other hand.
    pub lead: Largest,
    /// Axes that leave their travel, or go too fast.
    pub issues: IssueList,
    /// What was found in the program itself.
    pub problems: Diagnostics,
}

impl Verification {
    /// Whether the program is what was asked for: within the tolerances and one least increment,
    /// every axis within its travel, and no word that the control does not know.
    pub fn is_within(&self, options: &PostOptions) -> bool {
        let increment_mm = 10_f64.powi(-i32::from(options.decimals.linear));
        let increment_rad = 10_f64.powi(-i32::from(options.decimals.angle)).to_radians();
        self.compared > 0
            && !self.problems.has_errors()
            && !self.issues.is_critical()
            && self.lead.value <= options.tolerance_mm + increment_mm
            && self.tip_between.value <= options.tolerance_mm + increment_mm
            && self.axis_between.value
                <= options.axis_tolerance_rad + increment_rad + options.pole_rad
    }
}

/// A largest difference and where it is.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Largest {
    /// The value. Unit: mm or rad.
    pub value: f64,
    /// The line of the program.
    pub program_line: u32,
    /// The line of the file.
    pub file_line: u32,
}

impl Largest {
    pub(crate) fn take(&mut self, value: f64, program_line: u32, file_line: u32) {
        // NaN counts as the worst.
        if value > self.value || value.is_nan() {
            *self = Self { value, program_line, file_line };
        }
    }
}

/// Reads a written program back and states the largest differences from the file.
///
/// It goes through the interpreter of the control and the nominal machine as any program of a user
/// does; only which part of which stroke a block belongs to is kept from the writing. Between the ends
/// of a block the same part of the block and of the stroke are compared.
pub fn verify(machine: &Machine, posted: &Posted, options: &PostOptions) -> Verification {
    let program = Program::new(&options.name, posted.text.clone(), options.control);
    compare(machine, posted, &program, options)
}

/// The same without a second copy of the text.
pub fn verify_in_place(
    machine: &Machine,
    posted: &mut Posted,
    options: &PostOptions,
) -> Verification {
    let text = std::mem::take(&mut posted.text);
    let program = Program::new(&options.name, text, options.control);
    let verification = compare(machine, posted, &program, options);
    posted.text = program.into_source().into_vec();
    verification
}

fn compare(
    machine: &Machine,
    posted: &Posted,
    program: &Program,
    options: &PostOptions,
) -> Verification {
    let densify = Densify::Tolerance {
        chord_mm: 0.2 * options.tolerance_mm.clamp(1e-3, 0.1),
        angle_rad: 0.5_f64.to_radians(),
        spacing_mm: 5.0,
    };
    let simulation = Options { densify, ..Options::default() };
    let mut compare = Compare::with(posted);
    let mut watch = AxisWatch::on(machine);
    let setup = set_up(machine, posted, options);
    let mut tapped = Tapped::with(posted, options.control);
    let observers: &mut [&mut dyn Observer] = &mut [&mut compare, &mut watch, &mut tapped];
    let run = simulate(machine, program, &setup, &simulation, observers);
    compare.end_hole();
    compare.skip_to(posted.places.len());
    Verification {
        lead: tapped.end(),
        issues: IssueList::of([watch.log]),
        problems: run.problems,
        ..compare.found
    }
}

/// The set-up for which the program is: with tool length compensation alone its work offset is at the workpiece
/// zero, and the control knows the length of the tool.
fn set_up(machine: &Machine, posted: &Posted, options: &PostOptions) -> SetUp {
    let mut setup = SetUp::default();
    let Some(control) =
        TipControl::of(machine).filter(|_| options.tip_words == Some(TipWords::Length))
    else {
        return setup;
    };
    let mut command = Command::default();
    if !control.place(Vec3::zeros(), &mut command) {
        return setup;
    }
    let mut zero = Position::default();
    for (axis, q) in machine.axes().iter().zip(command) {
        let letter = axis.name.letter();
        if let Some(axis) =
            [Axis::X, Axis::Y, Axis::Z].into_iter().find(|a| char::from(a.letter()) == letter)
        {
            zero[axis] = q;
        }
    }
    let tip_mm = machine.tip_mm();
    zero[Axis::Z] += tip_mm.z;
    setup.given = true;
    setup.work_offsets.insert(1, Frame::shifted(zero));
    setup.workpiece_at = Some(1);
    let tools = posted.path.events.iter().flat_map(|(_, event)| match event {
        // The length that another number has in the control is that of this tool, too.
        Event::Tool(tool, _) => [Some(tool.number), tool.offset],
        _ => [None, None],
    });
    setup.tools = tools
        .flatten()
        .chain([1])
        .map(|n| (n, SetUpTool { tip_mm, ..SetUpTool::default() }))
        .collect();
    setup
}

pub(crate) struct Compare<'p> {
    pub posted: &'p Posted,
    /// The next block of the path.
    next: usize,
    /// Where the tool was last.
    pub at: Stand,
    /// The length of the present move so far. Unit: mm or deg.
    length: f64,
    /// Its places so far, each with the length up to there.
    way: Vec<(f64, Stand)>,
    /// The next hole of a cycle.
    pub next_hole: usize,
    /// Its places so far, and whether each is reached in rapid traverse.
    pub drilled: Vec<(Stand, bool)>,
    pub found: Verification,
}

impl<'p> Compare<'p> {
    fn with(posted: &'p Posted) -> Self {
        let at = Stand { tip: Vec3::repeat(f64::NAN), axis: Vec3::z() };
        let found = Verification::default();
        let (way, drilled) = (Vec::new(), Vec::new());
        Self { posted, next: 0, at, length: 0.0, way, next_hole: 0, drilled, found }
    }

    /// The tool is at the ends of all blocks up to one, without having moved since.
    fn skip_to(&mut self, index: usize) {
        for k in self.next..index {
            self.at_end(k, self.at);
        }
        self.next = self.next.max(index);
    }

    fn stroke(&self, place: &BlockPlace) -> (Stroke, Stand) {
        let index = place.stroke as usize;
        (self.posted.path.strokes.get(index), self.posted.path.before(index))
    }

    fn at_end(&mut self, index: usize, is: Stand) {
        let place = self.posted.places.get(index);
        let (stroke, from) = self.stroke(&place);
        let wanted = stroke.at(&from, place.until);
        let (line, file_line) = (place.line, stroke.line);
        let (tip, axis) = ((is.tip - wanted.tip).norm(), angle(&is.axis, &wanted.axis));
        self.found.tip_at_ends.take(tip, line, file_line);
        self.found.axis_at_ends.take(axis, line, file_line);
        self.found.tip_between.take(tip, line, file_line);
        self.found.axis_between.take(axis, line, file_line);
        self.found.compared += 1;
    }

    /// The places of a block that has come to its end, each against the same place of the path.
    ///
    /// A control goes through a block evenly: after a part of its length it belongs at the same part
    /// of the stroke. The nearest place would not do: where the tip hardly moves, or crosses its own
    /// path, another tool axis belongs to it.
    fn along(&mut self, index: usize, length: f64) {
        let place = self.posted.places.get(index);
        let (stroke, start) = self.stroke(&place);
        let (line, file_line) = (place.line, stroke.line);
        let Some(from) = place.from else { return self.way.clear() };
        for (so_far, is) in self.way.drain(..) {
            let wanted = stroke.at(&start, from + (place.until - from) * so_far / length);
            self.found.tip_between.take((is.tip - wanted.tip).norm(), line, file_line);
            self.found.axis_between.take(angle(&is.axis, &wanted.axis), line, file_line);
        }
    }
}

impl Observer for Compare<'_> {
    fn path(&mut self, batch: &Batch<'_>) {
        for (i, node) in batch.nodes.iter().enumerate() {
            let pose = batch.poses.at(i);
            let is = Stand { tip: pose.nominal_tip.vector(), axis: pose.nominal_axis.vector() };
            let line = node.origin.line;
            if self.take_drilled(line, is, !node.speed.is_finite()) {
                (self.at, self.length) = (is, 0.0);
                continue;
            }
            let places = &self.posted.places;
            let (index, on_path) = places.find(line, self.next);
            self.skip_to(index);
            self.length += node.length;
            if on_path && node.last {
                self.along(index, self.length);
                self.at_end(index, is);
                self.next = index + 1;
            } else if on_path {
                self.way.push((self.length, is));
            }
            if node.last {
                self.length = 0.0;
            }
            self.at = is;
        }
    }
}
