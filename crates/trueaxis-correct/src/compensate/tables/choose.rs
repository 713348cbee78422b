//! Which tables make the volume better: one that is right where the other axes stand at the reference may do harm
//! elsewhere, such as that of a head's tilt axis after half a turn of the axis that carries it.

use super::content::Content;
use super::control::Control;
use super::emulation::Emulation;
use super::lever::{errors_near, sum};
use super::{LeftOut, Made, What};
use trueaxis_geometry::Vec3;
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{Approach, AxisKind, Command};
use trueaxis_machine::volume::commands;

/// A table that could be written.
pub type Candidate = Made;

/// Poses beside the corners.
const POSES: u32 = 512;
/// An error of the tool axis counts as much as it moves a point so far up the tool, mm.
const ARM_MM: f64 = 100.0;
/// Without a table the rms must be larger by this share of it.
const GAIN: f64 = 1e-3;

/// The tables without which the rms over the volume would be larger; and those that do harm.
///
/// From all of them the one that does most harm goes, again and again. A table of a rotary axis for itself stays, and
/// where the control's chain knows the links every own table: it is right everywhere, and what it seems to spoil is the
/// error of another axis that it hid.
///
/// `already`: what the control adds without any table.
pub fn choose(
    machine: &Machine,
    control: &dyn Control,
    already: &Emulation<'_>,
    candidates: Vec<Candidate>,
) -> (Vec<Made>, Vec<LeftOut>) {
    let poses = commands(machine.axes(), POSES);
    let still = Approach::default();
    let alone = |made: &Made| -> Vec<Command> {
        let tables = vec![made.table.clone()];
        let content = Content { tables, ..Content::default() };
        let one = Emulation::new(machine, control, &content);
        poses.iter().map(|q| one.added(q, &still)).collect()
    };
    let mut kept: Vec<(Made, Vec<Command>)> =
        candidates.into_iter().map(|m| (alone(&m), m)).map(|(c, m)| (m, c)).collect();
    let mut all: Vec<Command> = poses.iter().map(|q| already.added(q, &still)).collect();
    for (_, added) in &kept {
        all = all.iter().zip(added).map(|(a, b)| sum(a, b)).collect();
    }
    let mut rms = size(machine, &poses, &all);
    let mut worse = Vec::new();
    loop {
        let may_go = kept.iter().enumerate().filter(|(_, (m, _))| !stays(machine, control, m));
        let without = may_go.map(|(i, (_, added))| {
            let without: Vec<Command> = all.iter().zip(added).map(|(a, b)| less(a, b)).collect();
            (i, size(machine, &poses, &without), without)
        });
        let Some((i, new, without)) = without.min_by(|a, b| a.1.total_cmp(&b.1)) else { break };
        if new > rms * (1.0 + GAIN) {
            break;
        }
        (rms, all) = (new, without);
        worse.push(kept.remove(i).0);
    }
    let reason = "it would not make the tool better over the volume";
    let worse = worse.into_iter().map(|Made { table, largest, .. }| {
        let what = What::Table { input: table.input, output: table.output };
        LeftOut { what, largest, reason }
    });
    let mut kept: Vec<Made> = kept.into_iter().map(|(made, _)| made).collect();
    kept.sort_by_key(|m| (m.table.input != m.table.output, m.table.input, m.table.output));
    (kept, worse.collect())
}

fn stays(machine: &Machine, control: &dyn Control, made: &Made) -> bool {
    let own = made.table.input == made.table.output;
    let rotary = machine.axes()[made.table.output].kind == AxisKind::Rotary;
    own && (rotary || control.knows_links())
}

fn less(command: &Command, added: &Command) -> Command {
    let mut less = *command;
    less.iter_mut().zip(added).for_each(|(q, c)| *q -= c);
    less
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
