//! One command of many machines whose errors are drawn.

use super::{FixedCommand, six_of};
use crate::batch::InstructionSet;
use crate::batch::drawn::{DRAWN, Drawable, Drawn, Factors};
use crate::errors::{Effect, ErrorValues, Rotation, Uncertainties};
use trueaxis_geometry::{Mat3, Vec3};

/// One command with the stated errors there and how well they are known, to put the tool there on eight drawn machines at a time.
///
/// # Example
/// ```
/// use trueaxis_machine::{Machine, file::NoTables, variations::DrawnCommand};
/// let text = "[machine]\nname = \"mill\"\nchain = \"w b Y X Z t\"\n[tool]\nlength = \"100 mm\"\n\
///             [location]\nEC0Y = \"10 ± 2 urad\"";
/// let machine = Machine::check("mill.toml", text, &NoTables).0.expect("a machine");
/// let command = [500.0, 0.0, 0.0, 0.0, 0.0, 0.0];
/// let errors = machine.errors_at(&command, &Default::default())?;
/// let known = machine.uncertainties_at(&command, &machine.uncertain_quantities());
/// let drawn = DrawnCommand::of(&machine.fixed_command(&command), &errors, &known);
/// // At Y = 500 mm 10 µrad of EC0Y move the tip by −5 µm in X, 12 µrad by −6 µm: a machine one standard uncertainty off.
/// let mut found = [[0.0; 8]; 6];
/// drawn.deviations(&[[0.0, 1.0, -1.0, 0.0, 0.0, 0.0, 0.0, 0.0]], &mut found);
/// for (x_mm, due_mm) in found[0].into_iter().zip([-0.005, -0.006, -0.004]) {
///     assert!((x_mm - due_mm).abs() < 1e-9);
/// }
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct DrawnCommand {
    /// `None` where the scalar form has to compute all.
    lanes: Option<Drawn>,
    fixed: FixedCommand,
    errors: ErrorValues,
    known: Uncertainties,
}

impl DrawnCommand {
    /// Of a command, the errors there, mm and rad, and what one standard uncertainty of each quantity adds to them.
    pub fn of(fixed: &FixedCommand, errors: &ErrorValues, known: &Uncertainties) -> Self {
        let lanes = (fixed.rotation == Rotation::Exact).then(|| compiled(fixed, errors, known));
        Self { lanes, fixed: fixed.clone(), errors: *errors, known: known.clone() }
    }

    /// The tip (three rows, mm) and the axis (three rows) less the nominal ones, a column for each machine whose quantities are so many
    /// standard uncertainties off: to 1e-12 mm what [`FixedCommand::deviation`] finds for each.
    pub fn deviations(&self, factors: &Factors, out: &mut [[f64; DRAWN]; 6]) {
        self.deviations_by(InstructionSet::best(), factors, out);
    }

    /// The same with given vector instructions, for tests.
    pub fn deviations_by(
        &self,
        set: InstructionSet,
        factors: &Factors,
        out: &mut [[f64; DRAWN]; 6],
    ) {
        let lanes = self.lanes.as_ref();
        let undecided = lanes.map_or(u32::MAX, |drawn| drawn.deviations(set, factors, out));
        for lane in (0..DRAWN).filter(|lane| undecided >> lane & 1 == 1) {
            let own: Vec<f64> = factors.iter().map(|column| column[lane]).collect();
            let found = self.fixed.deviation(&self.known.displaced(&self.errors, &own));
            for k in 0..3 {
                (out[k][lane], out[3 + k][lane]) = (found.tip_mm[k], found.axis[k]);
            }
        }
    }
}

fn compiled(fixed: &FixedCommand, errors: &ErrorValues, known: &Uncertainties) -> Drawn {
    let mut drawn = Drawn { workpiece_mm: errors.workpiece_mm.into(), ..Drawn::default() };
    for (quantity, effect) in known.effects() {
        if let Effect::Workpiece(u_mm) = effect {
            drawn.grown_mm.push((quantity, (*u_mm).into()));
        }
    }
    for (slot, station, onward) in &fixed.stations {
        let stated = six_of(errors, *slot).0;
        let ends = std::array::from_fn(|component| {
            for (quantity, effect) in known.effects() {
                if let Effect::Error(index, u) = effect
                    && (super::slot(*index), index.component as usize) == (*slot, component)
                {
                    drawn.effects.push((quantity, *u));
                }
            }
            drawn.effects.len()
        });
        drawn.stations.push(Drawable {
            tip_mm: station.tip_mm.into(),
            axis: station.axis.into(),
            is_back: station.is_back,
            tilted_mm: station.tilted_mm.map(Vec3::into),
            onward: onward.as_ref().map(rows),
            stated,
            ends,
        });
    }
    drawn
}

fn rows(m: &Mat3) -> [[f64; 3]; 3] {
    std::array::from_fn(|i| std::array::from_fn(|k| m[(i, k)]))
}
