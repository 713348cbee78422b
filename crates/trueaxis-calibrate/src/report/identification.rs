//! An identification for people at the terminal, and for programs.

use crate::identify::convention::ConventionCheck;
use crate::identify::errors::{Found, Identification};
use crate::identify::records::{Options, Records};
use crate::identify::score::Rms;
use crate::measure::Campaign;
use crate::unknowns::fit::Model;
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
    pub(super) fn influential(&self) -> impl Iterator<Item = usize> {
        let rows = &self.found.influences.rows;
        let mut order: Vec<usize> = (0..rows.len()).collect();
        order.sort_by(|a, b| rows[*b].cook.total_cmp(&rows[*a].cook));
        order.into_iter().take(5)
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
