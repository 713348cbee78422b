//! The effect of a change of errors on the tool over the travel of all axes.

use crate::Machine;
use crate::axis::{Approach, Command};
use crate::errors::{ErrorIndex, ErrorName};
use crate::volume::{approaches, commands};
use trueaxis_geometry::Vec3;

/// Poses over the travel of all axes.
const POSES: u32 = 4096;

/// The contribution of one error to the change.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Share {
    /// Which.
    pub error: ErrorName,
    /// How far its change alone moves the tip at most, mm.
    pub largest_mm: f64,
}

/// The change of the actual tool from the old calibration to the new one.
#[derive(Debug, Clone, PartialEq)]
pub struct TipChange {
    /// Poses that were evaluated, each from every side from which an axis with reversal comes; those that a table does not
    /// cover are left out.
    pub poses: usize,
    /// The largest distance of the two tips, mm.
    pub largest_mm: f64,
    /// Its standard uncertainty along the change, mm.
    pub u_mm: f64,
    /// Where it is.
    pub at: Command,
    /// From which side the axes with reversal came there.
    pub approach: Approach,
    /// Root mean square over all poses, mm.
    pub rms_mm: f64,
    /// The largest angle between the two tool axes, rad.
    pub axis_rad: f64,
    /// How far the nominal tips of the two files lie apart at most: other placements, another tool, mm.
    pub nominal_mm: f64,
    /// The errors by the effect of their change alone, the largest first; those without a change left out.
    pub shares: Vec<Share>,
}

pub(super) fn tip_change(old: &Machine, new: &Machine) -> TipChange {
    let mut change = TipChange {
        poses: 0,
        largest_mm: 0.0,
        u_mm: 0.0,
        at: Command::default(),
        approach: Approach::default(),
        rms_mm: 0.0,
        axis_rad: 0.0,
        nominal_mm: 0.0,
        shares: Vec::new(),
    };
    let indices = indices(old, new);
    let mut alone = vec![0.0_f64; indices.len()];
    let approaches = approaches(&[old, new]);
    // An error alone goes with the side of its own axis: all axes from one side, then from the other.
    let ends = [0, approaches.len() - 1];
    let mut sides = 0.0;
    for command in commands(old.axes(), POSES) {
        let mut seen = false;
        for (side, approach) in approaches.iter().enumerate() {
            let [a, b] = [old, new].map(|machine| machine.errors_at(&command, approach));
            let (Ok(a), Ok(b)) = (a, b) else { continue };
            let (before, after) = (old.deviation(&command, &a), new.deviation(&command, &b));
            let off = after.tip_mm - before.tip_mm;
            seen = true;
            sides += 1.0;
            change.rms_mm += off.norm_squared();
            change.axis_rad = change.axis_rad.max((after.axis - before.axis).norm());
            let nominal = after.nominal_tip.vector() - before.nominal_tip.vector();
            change.nominal_mm = change.nominal_mm.max(nominal.norm());
            if off.norm() > change.largest_mm {
                change.largest_mm = off.norm();
                (change.at, change.approach) = (command, *approach);
            }
            for ((index, _), most) in indices.iter().zip(&mut alone) {
                let mut one = a;
                one.set(*index, b.get(*index));
                if ends.contains(&side) && one.get(*index) != a.get(*index) {
                    let off = old.deviation(&command, &one).tip_mm - before.tip_mm;
                    *most = most.max(off.norm());
                }
            }
        }
        change.poses += usize::from(seen);
    }
    change.rms_mm = (change.rms_mm / f64::max(sides, 1.0)).sqrt();
    change.u_mm = uncertainty(old, new, (&change.at, &change.approach));
    let moved = indices.iter().zip(alone).filter(|(_, largest_mm)| *largest_mm > 0.0);
    change.shares =
        moved.map(|((_, error), largest_mm)| Share { error: *error, largest_mm }).collect();
    change.shares.sort_by(|a, b| b.largest_mm.total_cmp(&a.largest_mm));
    change
}

/// The errors that one of them states.
fn indices(old: &Machine, new: &Machine) -> Vec<(ErrorIndex, ErrorName)> {
    let mut all = old.stated_errors();
    all.extend(new.stated_errors().into_iter().filter(|(_, name)| {
        old.error_index(*name).is_none_or(|index| {
            let body = &old.bodies()[index.body];
            body.stated(index.kind, index.component).is_none()
        })
    }));
    all
}

/// The standard uncertainty of the change along itself, by linear propagation of both calibrations.
fn uncertainty(old: &Machine, new: &Machine, (at, approach): (&Command, &Approach)) -> f64 {
    let tip = |machine: &Machine, quantity: Option<(usize, f64)>| {
        let errors = machine.errors_at(at, approach).unwrap_or_default();
        let known = machine.uncertainties_at(at, &machine.uncertain_quantities());
        let errors = quantity.map_or(errors, |(i, z)| known.displaced_by(&errors, i, z));
        machine.deviation(at, &errors).tip_mm
    };
    let along = (tip(new, None) - tip(old, None)).try_normalize(0.0).unwrap_or_else(Vec3::x);
    let mut variance = 0.0;
    for machine in [old, new] {
        for quantity in 0..machine.uncertain_quantities().len() {
            let slope = tip(machine, Some((quantity, 1.0))) - tip(machine, Some((quantity, -1.0)));
            variance += (0.5 * slope.dot(&along)).powi(2);
        }
    }
    variance.sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::file::NoTables;

    /// Errors that stay are no change; the tip of an axis that is 10 µrad squarer lies 8 µm elsewhere at Y = 800 mm.
    #[test]
    fn the_change_is_that_from_the_old_to_the_new() {
        let machine = |squareness: &str| {
            let text = format!(
                "[machine]\nname = \"mill\"\nchain = \"w b X Y Z t\"\n[axis.X]\ntravel = [\"0 mm\", \"500 mm\"]\n[axis.Y]\n\
                 travel = [\"0 mm\", \"800 mm\"]\n[location]\nEC0Y = \"{squareness}\"\n"
            );
            Machine::check("mill.toml", &text, &NoTables).0.expect("a machine")
        };
        let (old, new) = (machine("30 urad"), machine("20 urad"));
        assert_eq!(tip_change(&old, &old).largest_mm, 0.0);
        let change = tip_change(&old, &new);
        assert!((change.largest_mm - 8e-3).abs() < 1e-9, "{}", change.largest_mm);
        assert!((change.at[1] - 800.0).abs() < 1e-9);
    }

    /// Backlash that grows from 4 to 14 µm displaces the tip by 5 µm from either side, wherever it is; that of a second axis
    /// at right angles to it makes √2 of that.
    #[test]
    fn backlash_that_grows_is_a_change() {
        let machine = |um: f64, more: &str| {
            let text = format!(
                "[machine]\nname = \"mill\"\nchain = \"w b X Y Z t\"\n[motion.X]\n\
                 EXX = {{ constant = \"0 um\", reversal = \"{um} um\" }}\n{more}"
            );
            Machine::check("mill.toml", &text, &NoTables).0.expect("a machine")
        };
        let y = "[motion.Y]\nEYY = { constant = \"0 um\", reversal = \"10 um\" }";
        for (new, due_mm, errors) in
            [(machine(14.0, ""), 5e-3, 1), (machine(14.0, y), 50_f64.sqrt() * 1e-3, 2)]
        {
            let change = tip_change(&machine(4.0, ""), &new);
            assert!((change.largest_mm - due_mm).abs() < 1e-9, "{change:?}");
            assert!((change.rms_mm - due_mm).abs() < 1e-9, "{change:?}");
            assert_eq!(change.shares.len(), errors);
            assert!(change.shares.iter().all(|s| (s.largest_mm - 5e-3).abs() < 1e-9), "{change:?}");
            assert!(change.approach[0] != 0.0);
        }
    }
}
