//! Values of the characteristics, their uncertainty, and what each error does to them.

use super::path::CutPath;
use super::{PartStudy, PartValue, outcome};
use trueaxis_cut::{Cut, Nail};
use trueaxis_geometry::Vec3;
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{Approach, Command};
use trueaxis_machine::errors::{ErrorName, ErrorValues};
use trueaxis_part::part;

/// What one error does to a characteristic.
#[derive(Debug, Clone, PartialEq)]
pub struct ErrorEffect {
    /// The error.
    pub error: ErrorName,
    /// The value without it, mm.
    pub without_mm: f64,
}

/// A cut on its machine: that with the tool which made it.
struct Place<'a> {
    machine: &'a Machine,
    command: Command,
    errors: ErrorValues,
    nail: &'a Nail,
    cut: &'a Cut,
}

/// Values of the errors at a command before and after a change.
type Change<'a> = dyn Fn(&Machine, &Command, &ErrorValues) -> [ErrorValues; 2] + 'a;

/// By how much tip and axis are elsewhere after a change.
fn moved(
    machine: &Machine,
    command: &Command,
    errors: &ErrorValues,
    change: &Change<'_>,
) -> [Vec3; 2] {
    let [a, b] = change(machine, command, errors).map(|e| machine.deviation(command, &e));
    [b.tip_mm - a.tip_mm, b.axis - a.axis]
}

/// The cuts of a part, and where its zero was set.
struct Cuts<'a> {
    places: Vec<Place<'a>>,
    zero: Option<(&'a Machine, Command, ErrorValues)>,
}

impl Cuts<'_> {
    /// By how much a change of the errors shifts each point along its normal, to first order: docs/model.md eq. 245.
    fn shifts(&self, change: &Change<'_>) -> Vec<f64> {
        let zero = self.zero.as_ref().map_or(Vec3::zeros(), |(machine, command, errors)| {
            moved(machine, command, errors, change)[0]
        });
        let shift = |place: &Place<'_>| {
            let [tip, axis] = moved(place.machine, &place.command, &place.errors, change);
            place.cut.shift_mm(place.nail, &(tip - zero), &axis)
        };
        self.places.iter().map(shift).collect()
    }
}

pub(super) fn values(
    (study, part): (&PartStudy, &part::Part),
    path: &CutPath<'_>,
    (nails, cuts): (&[Nail], &[Cut]),
    (deviations, by_program): (&[f64], &[f64]),
) -> Result<Vec<PartValue>, String> {
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
    let mut variance = vec![0.0; actual.len()];
    let quantities = study.mounted.uncertain_quantities();
    for quantity in 0..quantities.len() {
        let change = |machine: &Machine, command: &Command, errors: &ErrorValues| {
            let known = machine.uncertainties_at(command, &quantities);
            [-1.0, 1.0].map(|z| known.displaced_by(errors, quantity, z))
        };
        // From one standard uncertainty below to one above.
        let shift = all.shifts(&change);
        let [above, below] = [0.5, -0.5].map(|half| added(deviations, &shift, half));
        for ((sum, a), b) in variance.iter_mut().zip(evaluate(&above)?).zip(evaluate(&below)?) {
            *sum += (0.5 * (a - b)).powi(2);
        }
    }
    let mut effects: Vec<Vec<ErrorEffect>> = vec![Vec::new(); actual.len()];
    for (index, error) in study.mounted.stated_errors() {
        let change = |_: &Machine, _: &Command, errors: &ErrorValues| {
            let mut without = *errors;
            without.set(index, 0.0);
            [*errors, without]
        };
        let without = evaluate(&added(deviations, &all.shifts(&change), 1.0))?;
        for (list, without_mm) in effects.iter_mut().zip(without) {
            list.push(ErrorEffect { error, without_mm });
        }
    }
    let value = |(i, asked): (usize, &part::Characteristic)| {
        let (value_mm, u_mm) = (actual[i], variance[i].sqrt());
        let effect = |e: &ErrorEffect| (value_mm - e.without_mm).abs();
        let mut errors = effects[i].clone();
        errors.sort_by(|a, b| effect(b).total_cmp(&effect(a)));
        PartValue {
            value_mm,
            u_mm,
            nominal_mm: nominal[i],
            used_ratio: asked.limits.used(value_mm),
            outcome: outcome(&asked.limits, value_mm, u_mm, study.decision),
            errors,
        }
    };
    Ok(part.characteristics.iter().enumerate().map(value).collect())
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
    Ok(Place { machine, command, errors, nail, cut })
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
