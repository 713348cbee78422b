//! A part on many machines whose errors are drawn within their uncertainties.
//!
//! ```text
//! factors z of a machine ──Σ z × shift of each point by one u──> its surface ──Part::evaluate──> its values ──limits──> in tolerance?
//! ```
//!
//! The surface follows the errors to first order, docs/model.md eq. 245 and 321; the values are those of that surface, without another
//! approximation. [`cut_with`] cuts again instead.

use super::super::monte_carlo::{Sampling, Spread, spreads};
use super::linear::displace;
use super::path::CutPath;
use super::{PartStudy, nails};
use trueaxis_cut::cut;
use trueaxis_input::Diagnostics;
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{Approach, Command};
use trueaxis_motion::Observer;
use trueaxis_part::part::Part;

/// What many machines make of one characteristic.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Drawn {
    /// Its values.
    pub spread: Spread,
    /// The share of machines on which it is in tolerance. Unit: 1.
    pub good_ratio: f64,
}

/// What many machines make of the part.
#[derive(Debug, Clone, PartialEq)]
pub struct ManyParts {
    /// In the order of the part file.
    pub characteristics: Vec<Drawn>,
    /// The share of machines on which all characteristics are in tolerance. Unit: 1.
    pub good_ratio: f64,
}

/// The characteristics on many machines: deviations of the points, and by how much they shift from one standard uncertainty of each
/// quantity below to one above.
pub(super) fn many(
    part: &Part,
    (deviations, shifts): (&[f64], &[Vec<f64>]),
    sampling: Sampling,
    progress: &(dyn Fn(f64) + Sync),
) -> Result<ManyParts, String> {
    let count = part.characteristics.len();
    // After the values of a sample: 1 for each that is in tolerance, and 1 if all are.
    let sample = |factors: &[f64], surface: &mut Vec<f64>, found: &mut [f64]| {
        displace((deviations, shifts), factors, surface);
        let values = part.evaluate(surface).map_err(|e| e.to_string())?;
        let mut all = 1.0;
        for (i, (value, asked)) in values.iter().zip(&part.characteristics).enumerate() {
            let is_good = asked.limits.room_mm(*value) >= 0.0;
            found[i] = *value;
            found[count + i] = f64::from(u8::from(is_good));
            all *= found[count + i];
        }
        found[2 * count] = all;
        Ok::<(), String>(())
    };
    let told = |done: usize| progress(done as f64 / sampling.samples as f64);
    let found = spreads(sampling, [shifts.len(), 2 * count + 1], sample, &told)?;
    let (values, good) = found.split_at(count);
    let drawn =
        |(value, good): (&Spread, &Spread)| Drawn { spread: *value, good_ratio: good.mean_mm };
    Ok(ManyParts {
        characteristics: values.iter().zip(good).map(drawn).collect(),
        good_ratio: found[2 * count].mean_mm,
    })
}

/// The values of the part cut again, by a machine each of whose uncertain quantities is so many standard uncertainties off, in the order
/// of [`Machine::uncertain_quantities`], mm.
///
/// # Errors
/// In words: points that no cutter reaches, errors that are not known where it cuts.
pub fn cut_with(study: &PartStudy, factors: &[f64]) -> Result<Vec<f64>, String> {
    let mounted = &study.mounted;
    let quantities = mounted.uncertain_quantities();
    let tip = |machine: &Machine, command: &Command, approach: &Approach| {
        let errors = machine.errors_at(command, approach).map_err(|e| e.to_string())?;
        let drawn = machine.uncertainties_at(command, &quantities).displaced(&errors, factors);
        let there = machine.deviation(command, &drawn);
        Ok::<_, String>([there.tip_mm, there.axis])
    };
    let zero_mm = match &study.setting {
        None => Default::default(),
        Some(command) => tip(mounted, command, &Approach::default())?[0],
    };
    let mut path = CutPath::new(&study.job, &zero_mm);
    study.job.run(None, &mut [&mut path as &mut dyn Observer]);
    let machines = path.machines(mounted);
    path.displace(&machines, |machine| {
        move |command: &Command, approach: &Approach| tip(machine, command, approach)
    })?;
    let (actual, nominal) = path.sweeps()?;
    let mut problems = Diagnostics::new();
    let part = super::programmed::completed(study, &nominal, &mut problems);
    let (part, _) = part.ok_or("a surface of the program without points")?;
    let cuts = super::reached(study, &part, &cut(&actual, &nails(&part)), &mut problems);
    let cuts = cuts.ok_or("points that are not cut, or cut away")?;
    let deviations: Vec<f64> = cuts.iter().map(|c| c.deviation_mm).collect();
    part.evaluate(&deviations).map_err(|e| e.to_string())
}
