//! Which tables make the volume better: one that is right where the other axes stand at the reference may do harm
//! elsewhere, such as that of a head's tilt axis after half a turn of the axis that carries it.

use super::content::Content;
use super::control::Control;
use super::emulation::Emulation;
use super::lever::{errors_near, sum};
use super::{LeftOut, Made, What};
use crate::volume::commands;
use trueaxis_geometry::Vec3;
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{Approach, Command};

/// A table that could be written.
pub type Candidate = Made;

/// Poses beside the corners.
const POSES: u32 = 512;
/// An error of the tool axis counts as much as it moves a point so far up the tool, mm.
const ARM_MM: f64 = 100.0;
/// A table must make the rms smaller by this share of it.
const GAIN: f64 = 1e-3;

/// The tables that make the rms over the volume smaller, the largest corrections first; and those that do not.
///
/// `already`: what the control adds without any table.
pub fn choose(
    machine: &Machine,
    control: &dyn Control,
    already: &Emulation<'_>,
    mut candidates: Vec<Candidate>,
) -> (Vec<Made>, Vec<LeftOut>) {
    let poses = commands(machine.axes(), POSES);
    // Own tables first: cross tables are what they leave.
    candidates.sort_by(|a, b| {
        let own = |m: &Made| m.table.input != m.table.output;
        own(a).cmp(&own(b)).then(b.largest.total_cmp(&a.largest))
    });
    let still = Approach::default();
    let mut so_far: Vec<Command> = poses.iter().map(|q| already.added(q, &still)).collect();
    let mut rms = size(machine, &poses, &so_far);
    let (mut kept, mut open) = (Vec::new(), candidates);
    // What does harm alone may help beside another table: as long as one has been taken, look again.
    loop {
        let (taken, mut again) = (kept.len(), Vec::new());
        for made in open {
            let tables = vec![made.table.clone()];
            let one = Emulation::new(machine, control, Content { tables, ..Content::default() });
            let with: Vec<Command> =
                poses.iter().zip(&so_far).map(|(q, c)| sum(c, &one.added(q, &still))).collect();
            let new = size(machine, &poses, &with);
            if new < rms * (1.0 - GAIN) {
                (rms, so_far) = (new, with);
                kept.push(made);
            } else {
                again.push(made);
            }
        }
        open = again;
        if kept.len() == taken {
            break;
        }
    }
    let reason = "it would not make the tool better over the volume";
    let worse = open.into_iter().map(|Made { table, largest, .. }| {
        let what = What::Table { input: table.input, output: table.output };
        LeftOut { what, largest, reason }
    });
    let worse = worse.collect();
    kept.sort_by_key(|m| (m.table.input != m.table.output, m.table.input, m.table.output));
    (kept, worse)
}

fn size(machine: &Machine, poses: &[Command], so_far: &[Command]) -> f64 {
    let still = Approach::default();
    let (mut squares, mut count) = (0.0, 0.0);
    for (q, c) in poses.iter().zip(so_far) {
        let Some([tip, axis]) = off(machine, q, c, &still) else { continue };
        squares += tip.norm_squared() + (ARM_MM * axis).norm_squared();
        count += 1.0;
    }
    (squares / f64::max(count, 1.0)).sqrt()
}

/// Actual minus programmed tip (mm) and axis with something added to the command; none where the errors are
/// not known.
pub fn off(
    machine: &Machine,
    command: &Command,
    added: &Command,
    approach: &Approach,
) -> Option<[Vec3; 2]> {
    let at = sum(command, added);
    let errors = errors_near(machine, &at, command, approach).ok()?;
    let there = machine.deviation(&at, &errors);
    let wanted = machine.deviation(command, &Default::default());
    let tip = there.nominal_tip.vector() - wanted.nominal_tip.vector() + there.tip_mm;
    let axis = there.nominal_axis.vector() - wanted.nominal_axis.vector() + there.axis;
    Some([tip, axis])
}
