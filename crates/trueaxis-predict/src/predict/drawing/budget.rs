//! Values of the characteristics, their uncertainty, and what each error does to them.

use super::super::Sampling;
use super::many::{ManyParts, many};
use super::measured::measured;
use super::path::CutPath;
use super::{PartStudy, PartValue, combined_mm, outcome};
use rayon::prelude::*;
use trueaxis_cut::{Cut, Nail};
use trueaxis_geometry::Vec3;
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{Approach, Command};
use trueaxis_machine::errors::{ErrorIndex, ErrorName};
use trueaxis_part::part;
use trueaxis_part::tolerance::Outcome;

/// What one error does to a characteristic.
#[derive(Debug, Clone, PartialEq)]
pub struct ErrorEffect {
    /// The error.
    pub error: ErrorName,
    /// The value without it, mm.
    pub without_mm: f64,
}

/// How many errors a point remembers.
const MOST_EFFECTS: usize = 4;

/// What one error does to a point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PointEffect {
    /// The error.
    pub error: ErrorName,
    /// How much of the deviation of the point it makes, to first order, mm.
    pub part_mm: f64,
}

/// What the budget says about a part.
pub(super) struct Judged {
    pub values: Vec<PartValue>,
    pub drawn: Option<ManyParts>,
    /// For each point the errors that displace it most, the largest first.
    pub effects: Vec<Vec<PointEffect>>,
}

/// A cut on its machine: that with the tool which made it.
struct Place<'a> {
    machine: &'a Machine,
    command: Command,
    approach: Approach,
    nail: &'a Nail,
    cut: &'a Cut,
}

/// The cuts of a part, and where its zero was set.
struct Cuts<'a> {
    places: Vec<Place<'a>>,
    zero: Option<(&'a Machine, Command)>,
    /// What is asked of each: the absence of these errors, and one standard uncertainty of these quantities.
    stated: &'a [(ErrorIndex, ErrorName)],
    quantities: &'a [String],
}

/// By how much each point shifts along its normal, mm.
pub(super) struct Shifts {
    /// Without each error.
    absent: Vec<Vec<f64>>,
    /// From one standard uncertainty of each quantity below its value to one above.
    pub uncertain: Vec<Vec<f64>>,
}

/// Places of one task of a thread.
const CHUNK: usize = 512;

impl Cuts<'_> {
    /// By how much tip and axis differ by each of what is asked, one after the other: docs/model.md eq. 335.
    fn moved(
        &self,
        (machine, command, approach): (&Machine, &Command, &Approach),
    ) -> Result<Vec<[Vec3; 2]>, String> {
        let errors = machine.errors_at(command, approach).map_err(|e| e.to_string())?;
        let variations = machine.variations(command, &errors);
        let known = machine.uncertainties_at(command, self.quantities);
        let mut moved: Vec<[Vec3; 2]> =
            self.stated.iter().map(|(index, _)| variations.by(*index, 0.0)).collect();
        moved.extend(variations.by_uncertainties(&known, self.quantities.len()));
        Ok(moved)
    }

    /// The shifts of all points, to first order: docs/model.md eq. 245.
    fn shifts(&self) -> Result<Shifts, String> {
        let count = self.stated.len() + self.quantities.len();
        let zeros = match &self.zero {
            None => vec![[Vec3::zeros(); 2]; count],
            Some((machine, command)) => self.moved((machine, command, &Approach::default()))?,
        };
        let mut columns = vec![vec![0.0; self.places.len()]; count];
        // Of each task the same stretch of all columns.
        let mut stretches: Vec<Vec<&mut [f64]>> = Vec::new();
        stretches.resize_with(self.places.len().div_ceil(CHUNK), || Vec::with_capacity(count));
        for column in &mut columns {
            for (stretch, own) in stretches.iter_mut().zip(column.chunks_mut(CHUNK)) {
                stretch.push(own);
            }
        }
        let fill = |(places, stretch): (&[Place<'_>], &mut Vec<&mut [f64]>)| {
            for (i, place) in places.iter().enumerate() {
                let moved = self.moved((place.machine, &place.command, &place.approach))?;
                for ((column, [tip, axis]), [zero, _]) in stretch.iter_mut().zip(moved).zip(&zeros)
                {
                    column[i] = place.cut.shift_mm(place.nail, &(tip - zero), &axis);
                }
            }
            Ok::<(), String>(())
        };
        self.places.par_chunks(CHUNK).zip(&mut stretches).try_for_each(fill)?;
        let uncertain = columns.split_off(self.stated.len());
        Ok(Shifts { absent: columns, uncertain })
    }
}

/// The shifts of the points of a study, as its program cut them.
pub(super) fn shifts(
    study: &PartStudy,
    path: &CutPath<'_>,
    (nails, cuts): (&[Nail], &[Cut]),
) -> Result<Shifts, String> {
    let machines = path.machines(&study.mounted);
    let place = |(nail, cut)| place(path, &machines, nail, cut);
    let places = nails.iter().zip(cuts).map(place).collect::<Result<_, String>>()?;
    let zero = study.setting.map(|command| (&study.mounted, command));
    let (stated, quantities) =
        (study.mounted.stated_errors(), study.mounted.uncertain_quantities());
    Cuts { places, zero, stated: &stated, quantities: &quantities }.shifts()
}

pub(super) fn values(
    (study, part): (&PartStudy, &part::Part),
    path: &CutPath<'_>,
    (nails, cuts): (&[Nail], &[Cut]),
    (deviations, by_program): (&[f64], &[f64]),
    progress: &(dyn Fn(f64) + Sync),
) -> Result<Judged, String> {
    let stated = study.mounted.stated_errors();
    let Shifts { absent, uncertain: shifts } = shifts(study, path, (nails, cuts))?;
    progress(0.0);
    let evaluate = |deviation_mm: &[f64]| part.evaluate(deviation_mm).map_err(|e| e.to_string());
    let actual = evaluate(deviations)?;
    let nominal = evaluate(by_program)?;
    let by_points = part.by_points_mm(deviations).map_err(|e| e.to_string())?;
    let by_measuring = study.measurement.map(|by| measured(part, deviations, &by)).transpose()?;
    let u_mm = propagated(part, (deviations, &actual), &shifts, progress)?;
    let drawn =
        study.sampling.map(|s| many(part, (deviations, &shifts), s, progress)).transpose()?;
    let without: Vec<Vec<f64>> = absent
        .par_iter()
        .map(|shifts| {
            progress(1.0);
            evaluate(&added(deviations, shifts, 1.0))
        })
        .collect::<Result<_, _>>()?;
    let value = |(i, asked): (usize, &part::Characteristic)| {
        let (value_mm, u_mm, points_mm) = (actual[i], u_mm[i], by_points[i]);
        let of = |((_, error), without): (&(ErrorIndex, ErrorName), &Vec<f64>)| ErrorEffect {
            error: *error,
            without_mm: without[i],
        };
        let mut errors: Vec<ErrorEffect> = stated.iter().zip(&without).map(of).collect();
        let change = |e: &ErrorEffect| (value_mm - e.without_mm).abs();
        errors.sort_by(|a, b| change(b).total_cmp(&change(a)));
        let measured = by_measuring.as_ref().map(|all| all[i]);
        let combined_mm = combined_mm(u_mm, points_mm, measured);
        PartValue {
            value_mm,
            u_mm,
            points_mm,
            measured,
            nominal_mm: nominal[i],
            used_ratio: asked.limits.used(value_mm),
            outcome: outcome(&asked.limits, value_mm, combined_mm, study.decision),
            errors,
        }
    };
    let values = part.characteristics.iter().enumerate().map(value).collect();
    let at = |point: usize| {
        largest(stated.iter().zip(&absent).map(|((_, name), shifts)| (*name, -shifts[point])))
    };
    let effects = (0..nails.len()).into_par_iter().map(at).collect();
    Ok(Judged { values, drawn, effects })
}

/// Machines that are drawn where a characteristic is not smooth: their root mean square to 4 %.
const DRAWN: Sampling = Sampling { samples: 300, seed: 1 };

/// Smaller changes are rounding, mm.
const LEAST_MM: f64 = 1e-7;

/// From this share of u² on a characteristic counts as not smooth. Unit: 1.
const KINK: f64 = 1e-3;

/// Standard uncertainties of the characteristics, by shifts from one standard uncertainty of each quantity below to one above:
/// docs/model.md eq. 339.
///
/// The width of a zone is least where nothing deviates: half of the difference between both ends would be 0 there, however uncertain
/// the machine is.
fn propagated(
    part: &part::Part,
    (deviations, actual): (&[f64], &[f64]),
    shifts: &[Vec<f64>],
    progress: &(dyn Fn(f64) + Sync),
) -> Result<Vec<f64>, String> {
    let evaluate = |shift: &[f64], half: f64| {
        progress(0.0);
        part.evaluate(&added(deviations, shift, half)).map_err(|e| e.to_string())
    };
    let ends = |shift: &Vec<f64>| Ok([evaluate(shift, 0.5)?, evaluate(shift, -0.5)?]);
    let ends: Vec<[Vec<f64>; 2]> = shifts.par_iter().map(ends).collect::<Result<_, String>>()?;
    let sum = |of: &dyn Fn(&[Vec<f64>; 2]) -> f64| ends.iter().map(|e| of(e).powi(2)).sum::<f64>();
    let odd = |i: usize| sum(&|[a, b]| 0.5 * (a[i] - b[i]));
    let even = |i: usize| sum(&|[a, b]| 0.5 * (a[i] + b[i]) - actual[i]);
    let all = 0..part.characteristics.len();
    let has_kink = |i: usize| even(i) > KINK * odd(i) && even(i) > LEAST_MM * LEAST_MM;
    let drawn = match all.clone().any(has_kink) {
        true => Some(many(part, (deviations, shifts), DRAWN, &|_| progress(0.0))?),
        false => None,
    };
    let u_mm = |i: usize| match drawn.as_ref().filter(|_| has_kink(i)) {
        None => odd(i).sqrt(),
        Some(drawn) => {
            let spread = drawn.characteristics[i].spread;
            (spread.mean_mm - actual[i]).hypot(spread.u_mm)
        }
    };
    Ok(all.map(u_mm).collect())
}

/// The errors that displace a point most; those below a thousandth of the largest are not named.
fn largest(parts: impl Iterator<Item = (ErrorName, f64)>) -> Vec<PointEffect> {
    let mut all: Vec<PointEffect> =
        parts.map(|(error, part_mm)| PointEffect { error, part_mm }).collect();
    all.sort_by(|a, b| b.part_mm.abs().total_cmp(&a.part_mm.abs()));
    let least_mm = 1e-3 * all.first().map_or(0.0, |e| e.part_mm.abs());
    all.truncate(MOST_EFFECTS);
    all.retain(|e| e.part_mm.abs() > least_mm);
    all
}

/// The errors without which every characteristic passes, that which leaves the most room first.
pub(super) fn sufficient(
    study: &PartStudy,
    part: &part::Part,
    values: &[PartValue],
) -> Vec<ErrorName> {
    let names = values.first().map_or(&[][..], |v| &v.errors).iter().map(|e| e.error);
    let worst = |error: &ErrorName| {
        let each = part.characteristics.iter().zip(values).map(|(asked, value)| {
            let effect = value.errors.iter().find(|e| e.error == *error)?;
            let without_mm = effect.without_mm;
            let outcome = outcome(&asked.limits, without_mm, value.combined_mm(), study.decision);
            (outcome == Outcome::Pass).then(|| asked.limits.used(without_mm))
        });
        each.collect::<Option<Vec<f64>>>().map(|used| used.into_iter().fold(0.0, f64::max))
    };
    let mut found: Vec<(ErrorName, f64)> =
        names.filter_map(|error| Some((error, worst(&error)?))).collect();
    found.sort_by(|a, b| a.1.total_cmp(&b.1));
    found.into_iter().map(|(error, _)| error).collect()
}

fn place<'a>(
    path: &CutPath<'_>,
    machines: &'a [Machine],
    nail: &'a Nail,
    cut: &'a Cut,
) -> Result<Place<'a>, String> {
    let (command, approach) = path.place(cut).ok_or("a cut without its step")?;
    let machine = machines.get(cut.sweep).ok_or("a cut without its tool")?;
    Ok(Place { machine, command, approach, nail, cut })
}

fn added(deviations: &[f64], shift: &[f64], factor: f64) -> Vec<f64> {
    deviations.iter().zip(shift).map(|(d, s)| d + factor * s).collect()
}

/// The errors that matter most for a characteristic: those whose absence changes it by more than a hundredth of the largest change.
pub fn effects(value: &PartValue, most: usize) -> impl Iterator<Item = &ErrorEffect> {
    let change = |e: &ErrorEffect| (value.value_mm - e.without_mm).abs();
    let largest = value.errors.first().map_or(0.0, change);
    value.errors.iter().take_while(move |e| change(e) > 0.01 * largest).take(most)
}
