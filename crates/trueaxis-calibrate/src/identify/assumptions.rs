//! What a result rests on that was not stated, and rows that do not belong to the others: named, with what to do.

use super::checks::deviations;
use super::errors::Identification;
use super::records::Records;
use std::collections::BTreeMap;
use trueaxis_input::{Diagnostics, Place};
use trueaxis_measure::instruments::Kind;
use trueaxis_measure::instruments::instrument::SetupError;
use trueaxis_measure::unknowns::design::{Design, Unknown};

/// Rows that are named one by one.
const MOST_NAMED: usize = 10;
/// A length that keeps this share of what was not known of it was not found from the readings. Unit: 1.
const NOT_FOUND: f64 = 0.5;
/// An error that follows a length by this correlation rests on it. Unit: 1.
const RESTS_ON: f64 = 0.5;
/// More than this share of a variance is most of it; less than the other is not named. Unit: 1.
const MOSTLY: f64 = 0.5;
const NAMED: f64 = 0.1;
/// Readings that are predicted by less than this share of the residual of their own fit contain the answer.
const TOO_GOOD: f64 = 0.7;
/// Farther from the ball than this it is not a matter of decimals, mm.
const ROUNDED_MM: f64 = 0.05;
/// A row fits the other way round if it is off by less than so many times the noise.
const FITS: f64 = 5.0;

/// Warns of what was assumed, before anything is fitted.
pub(super) fn check_assumed(design: &Design, campaign: &Place, problems: &mut Diagnostics) {
    for instrument in design.instruments.iter().filter(|i| i.assumed.reads) {
        let (taken, hint) = match instrument.kind {
            Kind::ProbeBall | Kind::BallCentre => (
                "\"ball\": where the ball was seen (ball − socket)",
                "reads = \"ball\", or \"tool\" for the opposite: where the tool stood against the ball. The wrong one \
                 turns the sign of every error",
            ),
            Kind::LaserLine | Kind::LaserAngle | Kind::Artefact | Kind::CutPiece => (
                "\"deviation\": true − commanded",
                "reads = \"deviation\", or \"correction\" for the opposite: what must be added to the command. The wrong \
                 one turns the sign of every error",
            ),
            // A length has no sign, and neither has a place where a probe triggered or a point was seen.
            Kind::BallBar
            | Kind::LengthTracker
            | Kind::TouchProbeBall
            | Kind::TouchProbeFace
            | Kind::Points(_) => {
                continue;
            }
        };
        let message = format!(
            "{}: which way its numbers count is not stated; taken is {taken}",
            instrument.name
        );
        problems.warn("reads-not-stated", campaign.clone(), message, hint);
    }
}

/// A time that runs backwards in a table.
pub(super) fn check_times(records: &Records, problems: &mut Diagnostics) {
    let times = &records.readings.times_s;
    let same_table = |i: usize| records.place(i).file == records.place(i - 1).file;
    let back = |i: &usize| times[*i] < times[i - 1] && same_table(*i);
    if let Some(row) = (1..times.len()).find(back) {
        let message = format!("time runs backwards: {} s after {} s", times[row], times[row - 1]);
        let hint = "put the rows in the order in which they were measured: drift and the direction of approach follow it";
        problems.warn("time-backwards", records.place(row), message, hint);
    }
}

/// Warns of what the result shows.
pub(super) fn check_result(
    found: &Identification,
    records: &Records,
    campaign: &Place,
    problems: &mut Diagnostics,
) {
    tell_lengths(found, campaign, problems);
    tell_stated(found, campaign, problems);
    tell_gross(found, records, problems);
    tell_closure(found, records, problems);
    tell_rounded(found, records, campaign, problems);
    let (held_out, in_sample) = (found.score.held_out.noise, found.score.in_sample.noise);
    if held_out < TOO_GOOD * in_sample {
        let message = format!(
            "places that were held out are predicted better ({held_out:.1} times the noise) than those of the fit are \
             explained ({in_sample:.1})"
        );
        let hint = "that is no merit: poses given by measured positions contain the answer; give the commanded ones";
        problems.warn("held-out-better", campaign.clone(), message, hint);
    }
}

/// Poses of a probe-ball that stand beside the ball by their decimals, where the residual is too large.
fn tell_rounded(
    found: &Identification,
    records: &Records,
    campaign: &Place,
    problems: &mut Diagnostics,
) {
    let (design, readings) = (&found.design, &records.readings);
    if !found.adequacy.lack.is_found() {
        return;
    }
    for (k, instrument) in design.instruments.iter().enumerate() {
        let mine = (0..readings.len()).filter(|i| readings.instruments[*i] as usize == k);
        let squares = mine.map(|i| {
            let (command, direction) = (&readings.commands[i], readings.directions[i]);
            let beside = instrument.nominal_reading(&design.machine, command, direction);
            beside.iter().map(|v| v * v).sum::<f64>() / 3.0
        });
        let squares: Vec<f64> = squares.collect();
        let rms_mm = (squares.iter().sum::<f64>() / squares.len().max(1) as f64).sqrt();
        let noise = instrument.noise.iter().copied().fold(f64::INFINITY, f64::min);
        if instrument.kind != Kind::ProbeBall || rms_mm < 0.5 * noise || rms_mm > ROUNDED_MM {
            continue;
        }
        let message = format!(
            "{}: the poses as they are written stand {:.1} µm (rms) beside the ball, and readings are taken to contain that",
            instrument.name,
            rms_mm * 1e3
        );
        let hint = "if the machine stood where more decimals say, write them: the difference passes for noise";
        problems.warn("rounded-poses", campaign.clone(), message, hint);
    }
}

/// Lengths whose uncertainty is not stated, where errors rest on them.
fn tell_lengths(found: &Identification, campaign: &Place, problems: &mut Diagnostics) {
    let (design, covariance) = (&found.design, &found.adequacy.explained.listed.covariance);
    for (k, unknown) in (0..design.unknowns()).filter_map(|k| Some((k, design.unknown(k)?))) {
        let Unknown::Setup(instrument, setup) = unknown else { continue };
        let (SetupError::ToolPoint(2), true, Some(before)) =
            (setup.error, instrument.assumed.length, setup.prior_u)
        else {
            continue;
        };
        let u = covariance[(k, k)].max(0.0).sqrt();
        let rests = |i: &usize| {
            let both = covariance[(*i, k)] / (covariance[(*i, *i)].max(0.0).sqrt() * u).max(1e-300);
            both.abs() > RESTS_ON && found.found[*i].value.is_some()
        };
        let names: Vec<&str> =
            (0..design.terms.len()).filter(rests).map(|i| found.found[i].name.as_str()).collect();
        if u < NOT_FOUND * before || names.is_empty() {
            continue;
        }
        let message = format!(
            "how well the length of {} is known is not stated; assumed is u = {:.0} µm, and {} rest on it",
            instrument.name,
            before * 1e3,
            names.join(", ")
        );
        let hint = format!(
            "unknown = {{ {} = \"5 um\", … }}, or measure with a second length: the readings do not show it",
            instrument.kind.tool_point()
        );
        problems.warn("length-assumed", campaign.clone(), message, &hint);
    }
}

/// Errors whose uncertainty is mostly that of what the machine file states.
fn tell_stated(found: &Identification, campaign: &Place, problems: &mut Diagnostics) {
    let stated = &found.adequacy.explained.stated;
    let share = |i: usize, moves: &[f64]| {
        found.found[i].value.map_or(0.0, |(_, u)| (moves[i] / u.max(1e-300)).powi(2))
    };
    let rests = |i: &usize| stated.iter().map(|(_, moves)| share(*i, moves)).sum::<f64>() > MOSTLY;
    let terms: Vec<usize> = (0..found.design.terms.len()).filter(rests).collect();
    if terms.is_empty() {
        return;
    }
    let matters = |moves: &[f64]| terms.iter().any(|i| share(*i, moves) > NAMED);
    let of: Vec<&str> =
        stated.iter().filter(|(_, m)| matters(m)).map(|(name, _)| name.as_str()).collect();
    let names: Vec<&str> = terms.iter().map(|i| found.found[*i].name.as_str()).collect();
    let message = format!(
        "U of {} is mostly that of {}, which the machine file states: no further reading makes it smaller",
        names.join(", "),
        of.join(", ")
    );
    let hint = match of.iter().any(|name| name.starts_with("expansion")) {
        true => {
            "measure at the temperature of the error table, or find the coefficient: trueaxis identify expansion"
        }
        false => "state it better, or list it among the unknowns",
    };
    problems.note("rests-on-stated", campaign.clone(), message, hint);
}

/// Rows that do not belong to the others, and whether they would the other way round.
fn tell_gross(found: &Identification, records: &Records, problems: &mut Diagnostics) {
    let readings = &records.readings;
    let mut rows: BTreeMap<usize, f64> = BTreeMap::new();
    for outlier in &found.influences.outliers {
        let worst = rows.entry(outlier.row).or_default();
        *worst = worst.max(outlier.studentised.abs());
    }
    if rows.is_empty() {
        return;
    }
    let deviations = deviations(&found.design, readings);
    for (row, studentised) in rows.iter().take(MOST_NAMED) {
        let left_out = found.weights.get(*row) == Some(&0.0);
        let message = format!(
            "this reading is {studentised:.0} standard deviations from the others{}{}",
            if left_out { "; it is left out" } else { "" },
            other_way(found, *row, &deviations[*row], readings.instruments[*row] as usize)
        );
        let hint = "a slip, a wrong pose, a wrong unit? correct the row or delete it";
        problems.warn("gross-reading", records.place(*row), message, hint);
    }
    if let Some((row, _)) = rows.iter().nth(MOST_NAMED) {
        let message = format!("{} more like these", rows.len() - MOST_NAMED);
        problems.note("gross-reading", records.place(*row), message, "");
    }
}

/// Whether a row fits with the opposite sign or with its first two columns exchanged.
fn other_way(found: &Identification, row: usize, deviation: &[f64; 3], of: usize) -> &'static str {
    let instrument = &found.design.instruments[of];
    let channels = instrument.sight.channels();
    let residual = &found.fit.residuals[row];
    let fits = |changed: [f64; 3]| {
        (0..channels).all(|c| {
            let model = deviation[c] - residual[c];
            (changed[c] - model).abs() < FITS * found.adequacy.noise * instrument.noise[c]
        })
    };
    let [x, y, z] = *deviation;
    match () {
        () if fits([-x, -y, -z]) => "; with the opposite sign it fits",
        () if channels == 3 && fits([y, x, z]) => "; with x and y exchanged it fits",
        () => "",
    }
}

/// Places that were read again later: by how much they changed.
fn tell_closure(found: &Identification, records: &Records, problems: &mut Diagnostics) {
    let readings = &records.readings;
    let mut first: BTreeMap<(u32, [i64; 6]), usize> = BTreeMap::new();
    let mut worst: Option<(f64, usize, usize)> = None;
    for i in 0..readings.len() {
        let instrument = &found.design.instruments[readings.instruments[i] as usize];
        let command = readings.commands[i].map(|q| (q * 1e6).round() as i64);
        let start = *first.entry((readings.instruments[i], command)).or_insert(i);
        let later = readings.times_s[i] - readings.times_s[start];
        if start == i || later <= 0.0 || instrument.kind.triggers() {
            continue;
        }
        // A drift that is listed explains what changed.
        let left = |i: usize, c: usize| match instrument.has_rate() {
            true => found.fit.residuals[i][c],
            false => readings.values[i][c],
        };
        let off = (0..instrument.sight.channels())
            .map(|c| (left(i, c) - left(start, c)).abs() / instrument.noise[c])
            .fold(0.0, f64::max);
        if worst.is_none_or(|w| off > w.0) {
            worst = Some((off, start, i));
        }
    }
    let Some((off, start, row)) = worst.filter(|w| w.0 > FITS) else { return };
    let message = format!(
        "the place of line {} again {:.0} min later reads {off:.0} times the noise apart",
        readings.lines[start],
        (readings.times_s[row] - readings.times_s[start]) / 60.0
    );
    let hint = "drift, play, or a touch that was not clean: its size is part of the uncertainties where rows have time_s";
    problems.warn("closure", records.place(row), message, hint);
}
