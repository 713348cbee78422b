//! Programs with radius compensation: their words are those of the contour, the tool runs along it at a distance.
//! The residual error is therefore examined once more where the centre of the tool is.

use std::collections::HashMap;

use super::stand::Stand;
use super::verify::Largest;
use trueaxis_geometry::Vec3;
use trueaxis_input::Diagnostics;
use trueaxis_machine::Machine;
use trueaxis_motion::{Batch, Densify, Observer, Options, SetUp, execute, simulate};
use trueaxis_nc::Program;
use trueaxis_nc::moves::{CompensationSide, Event, Step};

/// Whether the program adds a radius that is not 0 to its contour.
pub(super) fn is_used(machine: &Machine, program: &Program, setup: &SetUp) -> bool {
    let mut used = false;
    execute(machine, program, setup, &setup.settings(false), &mut |step| {
        let Step::Event(Event::Compensation { side, radius_mm }, _) = step else { return };
        used |= side != CompensationSide::Off && radius_mm != 0.0;
    });
    used
}

/// How far the tip leaves its path in the written program at most, with the line of the program as it was;
/// `numbers` are the lines that its lines became. Blocks that count at their ends alone do so here, too.
///
/// Not a number if the tool does not fit into the written contour any more.
///
/// # Errors
/// What is wrong with the program as it was, such as a tool that does not fit into the contour.
pub(super) fn left(
    machine: &Machine,
    [was, is]: [&Program; 2],
    setup: &SetUp,
    [numbers, ends]: [&[u32]; 2],
    densify: Densify,
) -> Result<Largest, Diagnostics> {
    let options = Options { densify, ..Options::default() };
    let mut path = Path::default();
    let run = simulate(machine, was, setup, &options, &mut [&mut path]);
    if run.problems.has_errors() {
        return Err(run.problems);
    }
    let mut compare = Compare { path: &path, numbers, ends, left: Largest::default() };
    let run = simulate(machine, is, setup, &options, &mut [&mut compare]);
    if run.problems.has_errors() {
        compare.left.value = f64::NAN;
    }
    Ok(compare.left)
}

/// Where the tool shall be: the pieces of each line that have feed.
#[derive(Default)]
struct Path {
    before: Option<Stand>,
    of_line: HashMap<u32, Vec<[Stand; 2]>>,
}

impl Observer for Path {
    fn path(&mut self, batch: &Batch<'_>) {
        for (i, node) in batch.nodes.iter().enumerate() {
            let pose = batch.poses.at(i);
            let tip = pose.nominal_tip.vector();
            let here = Stand { tip, axis: pose.nominal_axis.vector() };
            if let Some(before) = self.before.filter(|_| node.speed.is_finite()) {
                self.of_line.entry(node.origin.line).or_default().push([before, here]);
            }
            self.before = Some(here);
        }
    }
}

struct Compare<'p> {
    path: &'p Path,
    numbers: &'p [u32],
    ends: &'p [u32],
    left: Largest,
}

impl Observer for Compare<'_> {
    fn path(&mut self, batch: &Batch<'_>) {
        for (i, node) in batch.nodes.iter().enumerate() {
            if !node.speed.is_finite() || node.origin.program != 0 {
                continue;
            }
            let line = self.numbers.partition_point(|number| *number <= node.origin.line) as u32;
            let Some(pieces) = self.path.of_line.get(&line) else { continue };
            if !node.last && self.ends.binary_search(&line).is_ok() {
                continue;
            }
            let pose = batch.poses.at(i);
            let tip = pose.nominal_tip.vector() + pose.tip_mm;
            let is = Stand { tip, axis: pose.nominal_axis.vector() + pose.axis };
            let off = pieces.iter().map(|[a, b]| is.off_segment(a, b, &Vec3::zeros())[0]);
            self.left.take(off.fold(f64::INFINITY, f64::min), line);
        }
    }
}
