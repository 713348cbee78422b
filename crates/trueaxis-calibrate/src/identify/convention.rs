//! Which convention the readings follow: sign, order, side, unit, sense.
//!
//! A wrong convention leaves a residual that no error of a machine explains. Every change that people
//! make by mistake is tried on a sample of the readings with the linear model, and the one is named
//! that fits far better. One instrument alone does not determine the common sign of all its channels: the
//! errors would only change theirs.

use super::checks::deviations;
use super::mixed_signs::mixed_rows;
use nalgebra::DVector;
use serde::Serialize;
use trueaxis_machine::axis::AxisKind;
use trueaxis_machine::twist::Reference;
use trueaxis_measure::instruments::instrument::Sight;
use trueaxis_measure::measure::Readings;
use trueaxis_measure::unknowns::design::Design;
use trueaxis_measure::unknowns::fit::Observability;
use trueaxis_report::JsonSchema;

/// Rows that are tried.
const SAMPLE: usize = 600;
/// "Far better": the residual falls to less than this share.
const FAR_BETTER: f64 = 0.4;
/// How a change ends that turns part of the rows.
const MIXED: &str = "rows with the opposite sign";
/// Below this, in units of the noise, there is nothing to explain.
const FITS: f64 = 3.0;

/// A change of convention that fits far better.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct Convention {
    /// What to change, in words.
    pub change: String,
    /// The residual without the change, in units of the noise. Unit: 1.
    #[serde(rename = "before_times_noise")]
    pub before: f64,
    /// The residual with the change, in units of the noise. Unit: 1.
    #[serde(rename = "after_times_noise")]
    pub after: f64,
    /// How many changes this is of.
    #[serde(skip)]
    changes: usize,
}

impl Convention {
    /// What flipping would do, in a sentence.
    pub fn words(&self) -> String {
        format!(
            "{}: the residual would fall from {:.1} to {:.1} times the noise",
            self.change, self.before, self.after
        )
    }
}

/// The conventions that were tried.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct ConventionCheck {
    /// Number of changes tried.
    pub tried: usize,
    /// The residual as the readings are, in units of the noise. Unit: 1.
    #[serde(rename = "residual_times_noise")]
    pub residual: f64,
    /// Changes that fit far better, the best first.
    pub better: Vec<Convention>,
    /// What cannot be checked, or what to look at.
    pub remarks: Vec<String>,
    /// Rows that fit the others with the opposite sign, if part of them does.
    #[serde(skip)]
    pub mixed: Vec<usize>,
}

/// What is changed of one instrument's readings.
#[derive(Debug, Clone)]
enum Change {
    /// Channel c is `sign[c]` times channel `from[c]`.
    Channels { from: [usize; 3], sign: [f64; 3] },
    /// The probe stands on the table and the ball in the spindle, or the other way.
    Sides,
    /// The instrument stands on the other of table and floor.
    Reference,
    /// A command has the other sign.
    Sense(usize),
    /// Two columns of commands are swapped.
    Swap(usize, usize),
    /// Angles were written in radians under a heading of degrees.
    Radians,
    /// The rows go backwards.
    Order,
}

/// Tries the conventions on readings.
pub fn check_conventions(design: &Design, readings: &Readings) -> ConventionCheck {
    let design = &design.clone().from_first_readings(readings);
    let step = readings.len().div_ceil(SAMPLE).max(1);
    let sample = readings.filtered(|i| i % step == 0);
    let deviations = deviations(design, &sample);
    let residual = misfit(design, &sample, &deviations, &deviations);
    let several = design.instruments.len() > 1;
    let mut found: Vec<Convention> = Vec::new();
    let mut tried = 0;
    for k in 0..design.instruments.len() {
        for (change, words, changes) in changes(design, &sample, k, several) {
            tried += 1;
            let after = tried_on(design, &sample, &deviations, k, &change);
            if residual > FITS && after < FAR_BETTER * residual {
                let change = format!("{}: {words}", design.instruments[k].name);
                found.push(Convention { change, before: residual, after, changes });
            }
        }
    }
    let mut mixed: Vec<usize> = Vec::new();
    for k in 0..design.instruments.len() {
        tried += 1;
        let rows = mixed_rows(design, &sample, &deviations, k);
        let mut values = deviations.clone();
        rows.iter().for_each(|i| values[*i].iter_mut().for_each(|v| *v = -*v));
        let after = misfit(design, &sample, &deviations, &values);
        if !rows.is_empty() && residual > FITS && after < FAR_BETTER * residual && after < FITS {
            let own = sample.instruments.iter().filter(|i| **i as usize == k).count();
            let change = format!("{}: {} of {own} {MIXED}", design.instruments[k].name, rows.len());
            found.push(Convention { change, before: residual, after, changes: 2 });
            mixed.extend(rows.iter().map(|i| i * step));
        }
    }
    // Of changes that fit alike the smallest one.
    found.sort_by(|a, b| {
        let rough = |c: &Convention| (4.0 * c.after.max(1e-3).ln()).round() as i64;
        rough(a).cmp(&rough(b)).then(a.changes.cmp(&b.changes))
    });
    found.truncate(3);
    let mut remarks = unit_remarks(design, &sample, &deviations, residual);
    if !several {
        remarks.push(
            "the sign of all channels at once cannot be checked with one instrument: the errors \
             would only change theirs (ball − socket or socket − ball)"
                .to_owned(),
        );
    }
    // Another change that fits as well makes all rows fit: then their signs are not mixed.
    let is_best = found.first().is_some_and(|c| c.change.ends_with(MIXED));
    mixed.retain(|_| is_best);
    ConventionCheck { tried, residual, better: found, remarks, mixed }
}

/// A residual far from the noise by a factor that a wrong unit makes.
fn unit_remarks(
    design: &Design,
    sample: &Readings,
    deviations: &[[f64; 3]],
    residual: f64,
) -> Vec<String> {
    let raw = (0..sample.len()).flat_map(|i| {
        let instrument = &design.instruments[sample.instruments[i] as usize];
        (0..instrument.sight.channels()).map(move |c| deviations[i][c] / instrument.noise[c])
    });
    let (sum, count) = raw.fold((0.0, 0.0_f64), |(s, n), v| (s + v * v, n + 1.0));
    let size = (sum / count.max(1.0)).sqrt();
    if size <= 0.0 || (0.1..=30.0).contains(&residual) {
        return Vec::new();
    }
    let factors = [
        (1000.0, "µm written as mm", "mm written as µm"),
        (25.4, "mm written as inch", "inch written as mm"),
        (25_400.0, "µm written as inch", "inch written as µm"),
    ];
    // The model must explain most of what there is: else the unit is not the cause.
    let explained = residual < 0.3 * size;
    factors
        .iter()
        .filter_map(|(factor, large, small)| {
            let fits = |r: f64| (0.4..2.5).contains(&r);
            let words = if fits(residual / factor) {
                large
            } else if fits(residual * factor) {
                small
            } else {
                return None;
            };
            explained.then(|| {
                format!(
                    "the residual is {residual:.3} times the noise; divided by a unit it would fit: \
                     are the readings {words}?"
                )
            })
        })
        .collect()
}

fn changes(
    design: &Design,
    sample: &Readings,
    k: usize,
    several: bool,
) -> Vec<(Change, String, usize)> {
    let instrument = &design.instruments[k];
    let mut list = Vec::new();
    if !instrument.kind.triggers() {
        list.extend(channel_changes(design, k, several));
        list.push((Change::Order, "rows in the opposite order".to_owned(), 1));
    }
    if matches!(instrument.sight, Sight::ProbeOffset | Sight::Place) {
        let words = match instrument.sight {
            Sight::Place => "readings in the frame of the probe (ball − socket)",
            _ => "the probe on the table and the ball in the spindle (R-test)",
        };
        list.push((Change::Sides, words.to_owned(), 2));
    }
    let words = match instrument.reference {
        Reference::Bed => "it stands on the table (stands_on = \"workpiece\")",
        Reference::Workpiece => "it stands on the floor (stands_on = \"bed\")",
    };
    list.push((Change::Reference, words.to_owned(), 2));
    let axes = design.machine.axes();
    let moves = |a: usize| {
        let first = sample.commands.first().map_or(0.0, |c| c[a]);
        sample.commands.iter().any(|c| (c[a] - first).abs() > 1e-9)
    };
    let moving: Vec<usize> = (0..axes.len()).filter(|a| moves(*a)).collect();
    for a in &moving {
        if axes[*a].kind == AxisKind::Rotary {
            let words = format!("{} turns in the other sense", axes[*a].name);
            list.push((Change::Sense(*a), words, 1));
        }
        for b in moving.iter().filter(|b| *b > a && axes[**b].kind == axes[*a].kind) {
            let words = format!("columns {} and {} swapped", axes[*a].name, axes[*b].name);
            list.push((Change::Swap(*a, *b), words, 1));
        }
    }
    let rotary = || moving.iter().filter(|a| axes[**a].kind == AxisKind::Rotary);
    let turn = std::f64::consts::TAU.to_radians() + 1e-9;
    if rotary().next().is_some()
        && rotary().all(|a| sample.commands.iter().all(|c| c[*a].abs() <= turn))
    {
        list.push((Change::Radians, "angles of the axes are in rad, not deg".to_owned(), 1));
    }
    list
}

/// Every order and sign of three channels; of one channel the sign.
fn channel_changes(design: &Design, k: usize, several: bool) -> Vec<(Change, String, usize)> {
    let instrument = &design.instruments[k];
    let names = instrument.kind.channels();
    if instrument.sight.channels() == 1 {
        let change = Change::Channels { from: [0, 1, 2], sign: [-1.0, 1.0, 1.0] };
        let words = format!("{} with the opposite sign", names[0]);
        return if several { vec![(change, words, 1)] } else { Vec::new() };
    }
    let orders = [[0, 1, 2], [1, 0, 2], [2, 1, 0], [0, 2, 1], [1, 2, 0], [2, 0, 1]];
    let mut list = Vec::new();
    for from in orders {
        for bits in 0..8_u32 {
            let sign = [0, 1, 2].map(|c| if bits & (1 << c) == 0 { 1.0 } else { -1.0 });
            let turned = bits.count_ones() as usize;
            let moved = (0..3).filter(|c| from[*c] != *c).count();
            // All signs at once change nothing with one instrument: the smaller change stands.
            if turned + moved == 0 || (!several && turned > 1) {
                continue;
            }
            let mut words = Vec::new();
            if moved > 0 {
                let order: Vec<&str> = from.iter().map(|c| names[*c]).collect();
                words.push(format!("columns in the order {}", order.join(", ")));
            }
            if turned > 0 {
                let turned: Vec<&str> =
                    (0..3).filter(|c| sign[*c] < 0.0).map(|c| names[c]).collect();
                words.push(format!("{} with the opposite sign", turned.join(" and ")));
            }
            list.push((Change::Channels { from, sign }, words.join(" and "), turned + moved));
        }
    }
    list
}

/// The residual with a change, in units of the noise.
fn tried_on(
    design: &Design,
    sample: &Readings,
    deviations: &[[f64; 3]],
    k: usize,
    change: &Change,
) -> f64 {
    let mine: Vec<usize> =
        (0..sample.len()).filter(|i| sample.instruments[*i] as usize == k).collect();
    let mut values = deviations.to_vec();
    match change {
        Change::Channels { from, sign } => {
            for i in &mine {
                values[*i] = std::array::from_fn(|c| sign[c] * deviations[*i][from[c]]);
            }
            return misfit(design, sample, deviations, &values);
        }
        Change::Order => {
            for (i, j) in mine.iter().zip(mine.iter().rev()) {
                values[*i] = deviations[*j];
            }
            return misfit(design, sample, deviations, &values);
        }
        _ => {}
    }
    let (design, mut sample) = changed(design, sample, &mine, k, change);
    let own = &design.instruments[k];
    if own.sight != Sight::Distance && !own.kind.triggers() {
        // What was read whole stays what was read; a deviation stays a deviation.
        let now = self::deviations(&design, &sample);
        for i in &mine {
            for c in 0..3 {
                sample.values[*i][c] += deviations[*i][c] - now[*i][c];
            }
        }
    }
    misfit(&design, &sample, &values, &values)
}

/// The set-up and the commands of an instrument with a change.
fn changed(
    design: &Design,
    sample: &Readings,
    mine: &[usize],
    k: usize,
    change: &Change,
) -> (Design, Readings) {
    let (mut design, mut sample) = (design.clone(), sample.clone());
    let instrument = &mut design.instruments[k];
    match change {
        Change::Sides if instrument.sight == Sight::Place => instrument.sight = Sight::ProbeOffset,
        Change::Sides => instrument.sight = Sight::Place,
        Change::Reference => {
            instrument.reference = match instrument.reference {
                Reference::Bed => Reference::Workpiece,
                Reference::Workpiece => Reference::Bed,
            }
        }
        Change::Sense(a) => mine.iter().for_each(|i| sample.commands[*i][*a] *= -1.0),
        Change::Swap(a, b) => mine.iter().for_each(|i| sample.commands[*i].swap(*a, *b)),
        Change::Radians => {
            let rotary: Vec<usize> = (0..design.machine.axes().len())
                .filter(|a| design.machine.axes()[*a].kind == AxisKind::Rotary)
                .collect();
            for i in mine {
                for a in &rotary {
                    sample.commands[*i][*a] = sample.commands[*i][*a].to_degrees();
                }
            }
        }
        Change::Channels { .. } | Change::Order => {}
    }
    (design, sample)
}

/// The residual of deviations after a linear fit, root mean square in units of the noise.
///
/// `with` are the deviations that the other errors of the machine file are taken from.
fn misfit(design: &Design, sample: &Readings, with: &[[f64; 3]], values: &[[f64; 3]]) -> f64 {
    let n = design.unknowns();
    let columns = design.columns(sample, 0..sample.len());
    let zero = vec![0.0; n];
    let mut right = Vec::with_capacity(columns.ncols());
    for i in 0..sample.len() {
        let instrument = &design.instruments[sample.instruments[i] as usize];
        // Reading minus what the machine file explains, with the deviation replaced.
        let Ok(read) = design.read(sample, i, &zero) else { return f64::INFINITY };
        for c in 0..instrument.sight.channels() {
            let left = sample.values[i][c] - read[c] - with[i][c] + values[i][c];
            right.push(left / instrument.noise[c]);
        }
    }
    let right = DVector::from_vec(right);
    let sight = Observability::of(&(&columns * columns.transpose()));
    let found = sight.solve(&(&columns * &right));
    let left = &right - columns.transpose() * found;
    let free = left.len().saturating_sub(sight.rank).max(1);
    left.norm() / (free as f64).sqrt()
}
