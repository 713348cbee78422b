//! An identification for people at the terminal, and for programs.

use crate::identify::convention::ConventionCheck;
use crate::identify::errors::{Found, Identification, Unobservable};
use crate::identify::records::{Options, Records};
use crate::identify::score::Rms;
use crate::measure::Campaign;
use crate::unknowns::fit::Model;
use serde_json::{Value, json};
use std::fmt::Write as _;

/// Everything of an identification that is told.
pub struct IdentificationReport<'a> {
    /// The campaign.
    pub campaign: &'a Campaign,
    /// Its `[fit]`.
    pub options: &'a Options,
    /// The readings with their places.
    pub records: &'a Records,
    /// The result.
    pub found: &'a Identification,
    /// The conventions, if they were asked for.
    pub conventions: Option<&'a ConventionCheck>,
}

/// How many outliers and influential poses are told.
pub(super) const MOST_TOLD: usize = 10;
/// Correlations from here on are told.
const STRONG: f64 = 0.9;

/// µm or µrad of mm or rad.
pub(super) fn shown(found: &Found, value: f64) -> f64 {
    if found.is_angle { value * 1e6 } else { value * 1e3 }
}

pub(super) fn unit(found: &Found) -> &'static str {
    if found.is_angle { "µrad" } else { "µm" }
}

/// `1.02 µm, 3.1 µrad`.
pub(super) fn rms_words(rms: &Rms) -> String {
    let length = rms.length_mm.map(|v| format!("{:.3} µm", v * 1e3));
    let angle = rms.angle_rad.map(|v| format!("{:.3} µrad", v * 1e6));
    length.into_iter().chain(angle).collect::<Vec<_>>().join(", ")
}

/// Name, value and u as text.
pub(super) fn value_words(found: &Found) -> String {
    match found.value {
        Some((value, u)) => {
            format!("{:>10.3} ± {:.3} {}", shown(found, value), shown(found, u), unit(found))
        }
        None => "cannot be told from others".to_owned(),
    }
}

impl IdentificationReport<'_> {
    /// The side-by-side rows: words, rms.
    pub(super) fn scores(&self) -> Vec<(&'static str, Rms)> {
        let score = &self.found.score;
        let floor = match score.floor_is_measured {
            true => "repeatability, from repeated readings",
            false => "noise as stated (nothing was repeated)",
        };
        vec![
            ("without the errors sought, set-up only", score.before),
            ("in sample", score.in_sample),
            ("held out, by place", score.held_out),
            (floor, score.floor),
        ]
    }

    /// What to know of the result, in sentences.
    pub(super) fn remarks(&self) -> Vec<String> {
        let found = self.found;
        let mut remarks = Vec::new();
        if found.birge > 1.0 {
            let fit = &found.fit;
            remarks.push(format!(
                "χ² = {:.0} with {} degrees of freedom is beyond its 99 % quantile: the \
                 uncertainties are enlarged by the Birge ratio {:.2}",
                fit.chi_square, fit.degrees_of_freedom, found.birge
            ));
        }
        if !found.left_out.is_empty() {
            remarks.push(format!(
                "{} of {} candidate terms are not supported by the readings (|z| below {:.1}, chosen \
                 by cross-validation) and are left out",
                found.left_out.len(),
                found.candidates,
                found.selection.threshold.min(99.0)
            ));
        }
        for [a, b] in self.strong_pairs() {
            remarks.push(format!(
                "{} and {} are correlated by {:+.3}: their {} is better known than each",
                found.found[a].name,
                found.found[b].name,
                self.correlation(a, b),
                if self.correlation(a, b) < 0.0 { "sum" } else { "difference" }
            ));
        }
        remarks
    }

    /// The correlation of two unknowns by their numbers, −1 to 1.
    pub fn correlation(&self, a: usize, b: usize) -> f64 {
        let c = &self.found.fit.covariance;
        c[(a, b)] / (c[(a, a)] * c[(b, b)]).sqrt().max(1e-300)
    }

    fn strong_pairs(&self) -> Vec<[usize; 2]> {
        let seen: Vec<usize> =
            self.found.found.iter().filter(|f| f.value.is_some()).map(|f| f.number).collect();
        let mut pairs = Vec::new();
        for (i, a) in seen.iter().enumerate() {
            pairs.extend(seen[i + 1..].iter().map(|b| [*a, *b]));
        }
        let size = |p: &[usize; 2]| self.correlation(p[0], p[1]).abs();
        pairs.retain(|p| size(p) > STRONG);
        pairs.sort_by(|a, b| size(b).total_cmp(&size(a)));
        pairs.truncate(MOST_TOLD);
        pairs
    }

    /// The rows that move the result most.
    pub(super) fn influential(&self) -> Vec<usize> {
        let rows = &self.found.influences.rows;
        let mut order: Vec<usize> = (0..rows.len()).collect();
        order.sort_by(|a, b| rows[*b].cook.total_cmp(&rows[*a].cook));
        order.truncate(5);
        order
    }

    pub(super) fn place(&self, row: usize) -> String {
        let place = self.records.place(row);
        format!("{}:{}", place.file, place.line)
    }
}

/// The result as text.
pub fn identification_text(report: &IdentificationReport<'_>) -> String {
    let found = report.found;
    let mut text = format!("{}\n{}\n\n", report.campaign.name, report.campaign.machine.name());
    // Writing to a String cannot fail.
    let _ = writeln!(text, "  {}\n", found.verdict.words());
    let _ = writeln!(
        text,
        "  {} readings in {} places, {} unknowns, rank {}, condition {:.3e}{}\n",
        report.records.readings.len(),
        found.places,
        found.found.len(),
        found.fit.sight.rank,
        found.fit.sight.condition(),
        if report.options.model == Model::Linear { ", linear model" } else { "" },
    );
    text += "  root mean square of the residual\n";
    for (words, rms) in report.scores() {
        let _ = writeln!(text, "    {words:<42} {}", rms_words(&rms));
    }
    text += "\n  error                              value ± standard uncertainty        z\n";
    for f in &found.found {
        let z = f.z().map_or(String::new(), |z| format!("{z:>8.1}"));
        let _ = writeln!(text, "    {:<26} {:<34} {z}", f.name, value_words(f));
    }
    if !found.unobservable.is_empty() {
        text += "\n  what these readings cannot tell apart\n";
        for u in &found.unobservable {
            let _ = writeln!(text, "    {}", u.words);
            let _ = writeln!(text, "        {}", u.combination);
            if let Some(with) = &u.resolve_with {
                let _ = writeln!(text, "        resolved by: {with}");
            }
        }
    }
    text += &outliers_text(report);
    for remark in report.remarks() {
        let _ = writeln!(text, "\n  {remark}");
    }
    if let Some(check) = report.conventions {
        text += &conventions_text(check);
    }
    text
}

fn outliers_text(report: &IdentificationReport<'_>) -> String {
    let found = report.found;
    let outliers = &found.influences.outliers;
    let mut text = String::new();
    if !outliers.is_empty() {
        // Writing to a String cannot fail.
        let _ = writeln!(
            text,
            "\n  readings that do not fit (|t| above {:.2}); they count all the same",
            found.influences.limit
        );
        for o in outliers.iter().take(MOST_TOLD) {
            let _ = writeln!(
                text,
                "    {}: channel {} is {:+.1} standard deviations off",
                report.place(o.row),
                o.channel + 1,
                o.studentised
            );
        }
        if outliers.len() > MOST_TOLD {
            let _ = writeln!(text, "    … and {} more", outliers.len() - MOST_TOLD);
        }
    }
    text
}

/// The conventions as text.
pub fn conventions_text(check: &ConventionCheck) -> String {
    let mut text = format!(
        "\n  conventions: {} changes tried; as it is, the residual is {:.2} times the noise\n",
        check.tried, check.residual
    );
    match check.better.is_empty() {
        true => text += "    no change of sign, order, sense or side fits far better\n",
        false => {
            for c in &check.better {
                let _ = writeln!(text, "    {}", c.words());
            }
        }
    }
    for remark in &check.remarks {
        let _ = writeln!(text, "    {remark}");
    }
    text
}

fn rms_json(rms: &Rms) -> Value {
    json!({
        "um": rms.length_mm.map(|v| v * 1e3),
        "urad": rms.angle_rad.map(|v| v * 1e6),
        "times_noise": rms.noise,
    })
}

/// The document `trueaxis/identify/1`.
pub fn identification_json(report: &IdentificationReport<'_>) -> Value {
    let found = report.found;
    let one = |f: &Found| {
        let (value_key, u_key) = match f.is_angle {
            true => ("value_urad", "u_urad"),
            false => ("value_um", "u_um"),
        };
        let mut entry = json!({ "name": f.name });
        entry[value_key] = json!(f.value.map(|(v, _)| shown(f, v)));
        entry[u_key] = json!(f.value.map(|(_, u)| shown(f, u)));
        entry["u"] = entry[u_key].clone();
        entry["z"] = json!(f.z());
        entry
    };
    let of = |setup: bool| -> Vec<Value> {
        found.found.iter().filter(|f| f.is_setup == setup).map(one).collect()
    };
    let um = |rms: &Rms| rms.length_mm.map(|v| v * 1e3);
    let score = &found.score;
    json!({
        "schema": "trueaxis/identify/1",
        "name": report.campaign.name,
        "machine": report.campaign.machine.name(),
        "date": report.options.date,
        "verdict": { "key": found.verdict.key(), "words": found.verdict.words(),
                     "good": found.verdict.is_good() },
        "errors": of(false),
        "setup": of(true),
        "unobservable": unobservable_json(report),
        "left_out": found.left_out,
        "rms_in_um": um(&score.in_sample),
        "rms_held_out_um": um(&score.held_out),
        "repeatability_um": um(&score.floor),
        "repeatability_is_measured": score.floor_is_measured,
        "rms_without_model_um": um(&score.before),
        "rms": {
            "in_sample": rms_json(&score.in_sample),
            "held_out": rms_json(&score.held_out),
            "repeatability": rms_json(&score.floor),
            "without_model": rms_json(&score.before),
        },
        "readings": report.records.readings.len(),
        "places": found.places,
        "rank": found.fit.sight.rank,
        "condition": found.fit.sight.condition(),
        "threshold": report.options.threshold,
        "model": match report.options.model {
            Model::Full => "full",
            Model::Linear => "linear",
        },
        "chi_square": found.fit.chi_square,
        "degrees_of_freedom": found.fit.degrees_of_freedom,
        "birge_ratio": found.birge,
        "residual_follows": fields_json(report),
        "selection": selection_json(report),
        "outliers": outliers_json(report),
        "outlier_limit": found.influences.limit,
        "most_influential": influence_json(report),
        "conventions": report.conventions.map(conventions_json),
    })
}

fn unobservable_json(report: &IdentificationReport<'_>) -> Value {
    let one = |u: &Unobservable| {
        json!({
            "combination": u.combination,
            "words": u.words,
            "resolve_with": u.resolve_with,
        })
    };
    report.found.unobservable.iter().map(one).collect()
}

fn outliers_json(report: &IdentificationReport<'_>) -> Value {
    let outliers = report.found.influences.outliers.iter().map(|o| {
        let place = report.records.place(o.row);
        json!({
            "file": place.file, "line": place.line, "channel": o.channel + 1,
            "studentised": o.studentised,
        })
    });
    outliers.collect()
}

fn influence_json(report: &IdentificationReport<'_>) -> Value {
    let rows = report.influential().into_iter().map(|row| {
        let place = report.records.place(row);
        let i = &report.found.influences.rows[row];
        json!({ "file": place.file, "line": place.line, "leverage": i.leverage,
                "cook": i.cook.is_finite().then_some(i.cook) })
    });
    rows.collect()
}

fn fields_json(report: &IdentificationReport<'_>) -> Value {
    let axes = report.found.design.machine.axes();
    let fields = report.found.fields.iter().map(|f| {
        let what = f.axis.map_or("XYZ".to_owned(), |a| axes[a].name.to_string());
        json!({ "what": what, "share": f.share })
    });
    fields.collect()
}

fn selection_json(report: &IdentificationReport<'_>) -> Value {
    let selection = &report.found.selection;
    let scores = selection.scores.iter().map(|s| {
        json!({
            "least_z": s.threshold.is_finite().then_some(s.threshold),
            "terms": s.terms,
            "held_out_times_noise": s.held_out,
            "in_sample_times_noise": s.in_sample,
        })
    });
    json!({
        "candidates": report.found.candidates,
        "least_z": selection.threshold.is_finite().then_some(selection.threshold),
        "scores": scores.collect::<Vec<_>>(),
    })
}

/// The conventions for programs.
pub fn conventions_json(check: &ConventionCheck) -> Value {
    let better = check.better.iter().map(|c| {
        json!({ "change": c.change, "before_times_noise": c.before, "after_times_noise": c.after })
    });
    json!({
        "tried": check.tried,
        "residual_times_noise": check.residual,
        "better": better.collect::<Vec<_>>(),
        "remarks": check.remarks,
    })
}
