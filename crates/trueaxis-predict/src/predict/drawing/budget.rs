//! Values of the characteristics, their uncertainty, and what each error does to them.

use super::many::{ManyParts, many};
use super::measured::measured;
use super::path::CutPath;
use super::{PartStudy, PartValue, combined_mm, outcome};
use rayon::prelude::*;
use trueaxis_cut::{Cut, Nail};
use trueaxis_geometry::Vec3;
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{Approach, Command};
use trueaxis_machine::errors::{ErrorIndex, ErrorName, ErrorValues};
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
    errors: ErrorValues,
    /// Deviation of tip and axis by these errors.
    there: [Vec3; 2],
    nail: &'a Nail,
    cut: &'a Cut,
}

/// Deviation of tip and axis.
fn deviation(machine: &Machine, command: &Command, errors: &ErrorValues) -> [Vec3; 2] {
    let there = machine.deviation(command, errors);
    [there.tip_mm, there.axis]
}

/// By how much tip and axis are elsewhere without one error.
fn without(
    (machine, command, errors): (&Machine, &Command, &ErrorValues),
    there: &[Vec3; 2],
    index: ErrorIndex,
) -> [Vec3; 2] {
    let mut left = *errors;
    left.set(index, 0.0);
    let [tip, axis] = deviation(machine, command, &left);
    [tip - there[0], axis - there[1]]
}

/// By how much tip and axis differ from one standard uncertainty of a quantity below to one above, for each quantity.
fn uncertain<'a>(
    (machine, command, errors): (&'a Machine, &'a Command, &'a ErrorValues),
    quantities: &[String],
) -> impl Iterator<Item = [Vec3; 2]> + use<'a> {
    let known = machine.uncertainties_at(command, quantities);
    (0..quantities.len()).map(move |quantity| {
        let [high, low] = [1.0, -1.0].map(|z| known.displaced_by(errors, quantity, z));
        if high == low {
            return [Vec3::zeros(); 2];
        }
        let [tip, axis] = deviation(machine, command, &high);
        let [low_tip, low_axis] = deviation(machine, command, &low);
        [tip - low_tip, axis - low_axis]
    })
}

/// The cuts of a part, and where its zero was set.
struct Cuts<'a> {
    places: Vec<Place<'a>>,
    zero: Option<(&'a Machine, Command, ErrorValues)>,
}

impl Cuts<'_> {
    /// By how much the absence of an error shifts each point along its normal, to first order: docs/model.md eq. 245.
    fn shifts_without(&self, index: ErrorIndex) -> Vec<f64> {
        let zero = self.zero.as_ref().map_or(Vec3::zeros(), |(machine, command, errors)| {
            let there = deviation(machine, command, errors);
            without((machine, command, errors), &there, index)[0]
        });
        let shift = |place: &Place<'_>| {
            let [tip, axis] = without(place.stand(), &place.there, index);
            place.cut.shift_mm(place.nail, &(tip - zero), &axis)
        };
        self.places.par_iter().map(shift).collect()
    }

    /// The same from one standard uncertainty of each quantity below to one above: quantity by quantity.
    fn uncertain_shifts(&self, quantities: &[String]) -> Vec<Vec<f64>> {
        let zeros: Vec<Vec3> = match &self.zero {
            None => vec![Vec3::zeros(); quantities.len()],
            Some((machine, command, errors)) => {
                uncertain((machine, command, errors), quantities).map(|[tip, _]| tip).collect()
            }
        };
        let shifts = |place: &Place<'_>| {
            let moved = uncertain(place.stand(), quantities).zip(&zeros);
            let shift = |([tip, axis], zero): ([Vec3; 2], &Vec3)| {
                place.cut.shift_mm(place.nail, &(tip - zero), &axis)
            };
            moved.map(shift).collect::<Vec<f64>>()
        };
        let by_place: Vec<Vec<f64>> = self.places.par_iter().map(shifts).collect();
        (0..quantities.len()).map(|q| by_place.iter().map(|of| of[q]).collect()).collect()
    }
}

impl Place<'_> {
    fn stand(&self) -> (&Machine, &Command, &ErrorValues) {
        (self.machine, &self.command, &self.errors)
    }
}

pub(super) fn values(
    (study, part): (&PartStudy, &part::Part),
    path: &CutPath<'_>,
    (nails, cuts): (&[Nail], &[Cut]),
    (deviations, by_program): (&[f64], &[f64]),
    progress: &(dyn Fn(f64) + Sync),
) -> Result<Judged, String> {
    let machines = path.machines(&study.mounted);
    let place = |(nail, cut)| place(path, &machines, nail, cut);
    let places = nails.iter().zip(cuts).map(place).collect::<Result<_, String>>()?;
    let zero = match study.setting {
        None => None,
        Some(command) => {
            let errors = study.mounted.errors_at(&command, &Approach::default());
            Some((&study.mounted, command, errors.map_err(|e| e.to_string())?))
        }
    };
    let all = Cuts { places, zero };
    let evaluate = |deviation_mm: &[f64]| part.evaluate(deviation_mm).map_err(|e| e.to_string());
    let actual = evaluate(deviations)?;
    let nominal = evaluate(by_program)?;
    let by_points = part.by_points_mm(deviations).map_err(|e| e.to_string())?;
    let by_measuring = study.point_u_mm.map(|u_mm| measured(part, deviations, u_mm)).transpose()?;
    let shifts = all.uncertain_shifts(&study.mounted.uncertain_quantities());
    let u_mm = propagated(part, deviations, &shifts)?;
    let drawn =
        study.sampling.map(|s| many(part, (deviations, &shifts), s, progress)).transpose()?;
    let stated = study.mounted.stated_errors();
    let absent: Vec<Vec<f64>> =
        stated.par_iter().map(|(index, _)| all.shifts_without(*index)).collect();
    let without: Vec<Vec<f64>> = absent
        .par_iter()
        .map(|shifts| evaluate(&added(deviations, shifts, 1.0)))
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

/// Standard uncertainties of the characteristics, by shifts from one standard uncertainty of each quantity below to one above.
fn propagated(
    part: &part::Part,
    deviations: &[f64],
    shifts: &[Vec<f64>],
) -> Result<Vec<f64>, String> {
    let evaluate = |shift: &[f64], half: f64| {
        part.evaluate(&added(deviations, shift, half)).map_err(|e| e.to_string())
    };
    let ends = |shift: &Vec<f64>| Ok([evaluate(shift, 0.5)?, evaluate(shift, -0.5)?]);
    let ends: Vec<[Vec<f64>; 2]> = shifts.par_iter().map(ends).collect::<Result<_, String>>()?;
    let variance = |i: usize| ends.iter().map(|[a, b]| (0.5 * (a[i] - b[i])).powi(2)).sum::<f64>();
    Ok((0..part.characteristics.len()).map(|i| variance(i).sqrt()).collect())
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
    let errors = machine.errors_at(&command, &approach).map_err(|e| e.to_string())?;
    let there = deviation(machine, &command, &errors);
    Ok(Place { machine, command, errors, there, nail, cut })
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
