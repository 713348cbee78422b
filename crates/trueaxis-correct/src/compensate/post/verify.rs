//! The proof: the written text, read back and simulated, against the cutter-location file.

use super::path::{Stand, Stroke, Way};
use super::{BlockPlace, PostOptions, Posted, angle};
use trueaxis_geometry::Vec3;
use trueaxis_input::Diagnostics;
use trueaxis_machine::Machine;
use trueaxis_motion::{AxisWatch, Batch, Densify, IssueList, Observer, Options, SetUp, simulate};
use trueaxis_nc::Program;

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
    fn take(&mut self, value: f64, program_line: u32, file_line: u32) {
        // NaN counts as the worst.
        if value > self.value || value.is_nan() {
            *self = Self { value, program_line, file_line };
        }
    }
}

/// Reads a written program back and states the largest differences from the file.
///
/// It goes through the interpreter of the control and the nominal machine as any program of a user
/// does; only which stroke a block belongs to is kept from the writing.
pub fn verify(machine: &Machine, posted: &Posted, options: &PostOptions) -> Verification {
    let program = Program::new(&options.name, posted.text.clone(), options.control);
    let densify = Densify::Tolerance {
        chord_mm: 0.2 * options.tolerance_mm.clamp(1e-3, 0.1),
        angle_rad: 0.5_f64.to_radians(),
        spacing_mm: 5.0,
    };
    let simulation = Options { densify, ..Options::default() };
    let mut compare = Compare::with(posted);
    let mut watch = AxisWatch::on(machine);
    let run = simulate(
        machine,
        &program,
        &SetUp::default(),
        &simulation,
        &mut [&mut compare, &mut watch],
    );
    compare.skip_to(posted.places.len());
    Verification { issues: IssueList::of([watch.log]), problems: run.problems, ..compare.found }
}

struct Compare<'p> {
    posted: &'p Posted,
    /// The next block of the path.
    next: usize,
    /// Where the tool was last.
    at: Stand,
    found: Verification,
}

impl<'p> Compare<'p> {
    fn with(posted: &'p Posted) -> Self {
        let at = Stand { tip: Vec3::repeat(f64::NAN), axis: Vec3::z() };
        Self { posted, next: 0, at, found: Verification::default() }
    }

    /// The tool is at the ends of all blocks up to one, without having moved since.
    fn skip_to(&mut self, index: usize) {
        for k in self.next..index {
            self.at_end(k, self.at);
        }
        self.next = self.next.max(index);
    }

    fn stroke(&self, place: &BlockPlace) -> (&'p Stroke, Stand) {
        let index = place.stroke as usize;
        (&self.posted.path.strokes[index], self.posted.path.before(index))
    }

    fn at_end(&mut self, index: usize, is: Stand) {
        let place = self.posted.places[index];
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

    fn on_the_way(&mut self, index: usize, is: Stand) {
        let place = self.posted.places[index];
        let (stroke, from) = self.stroke(&place);
        // The way to the first place of all is not on the path.
        if place.stroke == 0 {
            return;
        }
        let begins = match index.checked_sub(1).map(|i| self.posted.places[i]) {
            Some(before) if before.stroke == place.stroke => before.until,
            _ => 0.0,
        };
        let wanted = stroke.at(&from, nearest(stroke, &from, &is, begins, place.until));
        let (line, file_line) = (place.line, stroke.line);
        self.found.tip_between.take((is.tip - wanted.tip).norm(), line, file_line);
        self.found.axis_between.take(angle(&is.axis, &wanted.axis), line, file_line);
    }
}

/// The place of a stroke next to where the tool is.
fn nearest(stroke: &Stroke, from: &Stand, is: &Stand, begins: f64, ends: f64) -> f64 {
    let way = stroke.to.tip - from.tip;
    let u = match stroke.way {
        Way::Arc { center, normal, angle_rad } => {
            let flat = |p: Vec3| {
                let arm = p - center;
                arm - normal * normal.dot(&arm)
            };
            let (a, b) = (flat(from.tip), flat(is.tip));
            let turned = normal.dot(&a.cross(&b)).atan2(a.dot(&b));
            let full = std::f64::consts::TAU;
            let middle = 0.5 * (begins + ends) * angle_rad;
            let turned = turned + full * ((middle - turned) / full).round();
            turned / angle_rad
        }
        Way::Line if way.norm() > 1e-9 => (is.tip - from.tip).dot(&way) / way.norm_squared(),
        Way::Line => {
            let whole = angle(&from.axis, &stroke.to.axis);
            if whole > 0.0 { angle(&from.axis, &is.axis) / whole } else { ends }
        }
    };
    u.clamp(begins, ends)
}

impl Observer for Compare<'_> {
    fn path(&mut self, batch: &Batch<'_>) {
        for (i, node) in batch.nodes.iter().enumerate() {
            let pose = batch.poses.at(i);
            let is = Stand { tip: pose.nominal_tip.vector(), axis: pose.nominal_axis.vector() };
            let line = node.origin.line;
            let places = &self.posted.places;
            let index = places.partition_point(|p| p.line < line);
            let on_path = places.get(index).is_some_and(|p| p.line == line);
            self.skip_to(index);
            if on_path && node.last {
                self.at_end(index, is);
                self.next = index + 1;
            } else if on_path {
                self.on_the_way(index, is);
            }
            self.at = is;
        }
    }
}
