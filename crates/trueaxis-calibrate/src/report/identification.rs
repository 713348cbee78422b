//! An identification in text and on a page.

use super::adequacy::{adequacy_remarks, kinds_words, predictor_section};
use super::identification_arrows::{Arrow, arrow_picture, longest, magnification};
use super::identification_pictures::{Bar, bars, correlation_map};
use super::stages::stage_sections;
use crate::identify::convention::ConventionCheck;
use crate::identify::errors::{Found, Identification};
use crate::identify::records::{Options, Records};
use crate::identify::score::Rms;
use crate::plan::Unobservable;
use std::rc::Rc;
use trueaxis_measure::measure::Campaign;
use trueaxis_measure::unknowns::fit::Model;
use trueaxis_report::{Columns, Figure, Report, Section, Standing, Table};

/// What a report of an identification shows.
#[derive(Clone, Copy)]
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

/// How many outliers are shown.
const MOST_REPORTED: usize = 10;
/// Most unknowns of the correlation map.
const MOST_MAPPED: usize = 60;
/// Correlations from here on are reported.
const STRONG: f64 = 0.9;

/// µm, µrad, ms or µm/m of mm, rad, s or 1; rates are by the hour.
pub(super) fn shown(found: &Found, value: f64) -> f64 {
    if found.is_angle || found.is_share { value * 1e6 } else { value * 1e3 }
}

fn unit(found: &Found) -> &'static str {
    match (found.is_time, found.is_angle) {
        _ if found.is_share => "µm/m",
        (_, true) if found.is_rate => "µrad/h",
        _ if found.is_rate => "µm/h",
        (true, _) => "ms",
        (_, true) => "µrad",
        _ => "µm",
    }
}

/// `1.02 µm, 3.1 µrad`.
pub(super) fn rms_words(rms: &Rms) -> String {
    let length = rms.length_mm.map(|v| format!("{:.3} µm", v * 1e3));
    let angle = rms.angle_rad.map(|v| format!("{:.3} µrad", v * 1e6));
    length.into_iter().chain(angle).collect::<Vec<_>>().join(", ")
}

impl IdentificationReport<'_> {
    /// The side-by-side rows: words, rms.
    fn scores(&self) -> Vec<(&'static str, Rms)> {
        let score = &self.found.score;
        let floor = match score.floor_is_measured {
            true => "repeatability, from repeated readings",
            false => "noise as stated (nothing was repeated)",
        };
        vec![
            ("without the unknown errors, set-up only", score.before),
            ("in sample", score.in_sample),
            ("held out, by place", score.held_out),
            (floor, score.floor),
        ]
    }

    /// What to know of the result, in sentences.
    fn remarks(&self) -> Vec<String> {
        let found = self.found;
        let mut remarks = Vec::new();
        remarks.extend(adequacy_remarks(&found.adequacy));
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
        pairs.truncate(MOST_REPORTED);
        pairs
    }

    /// The rows that move the result most.
    pub(super) fn influential(&self) -> impl Iterator<Item = usize> {
        let rows = &self.found.influences.rows;
        let mut order: Vec<usize> = (0..rows.len()).collect();
        order.sort_by(|a, b| rows[*b].cook.total_cmp(&rows[*a].cook));
        order.into_iter().take(5)
    }

    fn place(&self, row: usize) -> String {
        let place = self.records.place(row);
        format!("{}:{}", place.file, place.line)
    }
}

/// The result in text and on a page.
pub fn identification_report(answer: IdentificationReport<'_>) -> Report<'_> {
    let (found, records, campaign) = (answer.found, answer.records, answer.campaign);
    let linear = if answer.options.model == Model::Linear { ", linear model" } else { "" };
    let date = answer.options.date.as_ref().map_or(String::new(), |date| format!(", {date}"));
    let standing = if found.verdict.is_good() { Standing::Good } else { Standing::Bad };
    Report::new(&campaign.name)
        .line(format!("{}{date}", campaign.machine.name()))
        .line(format!(
            "{} readings in {} places, {} unknowns, rank {}, condition {:.3e}{linear}",
            records.readings.len(),
            found.places,
            found.found.len(),
            found.fit.sight.rank,
            found.fit.sight.condition(),
        ))
        .verdict(standing, found.verdict.words(), "")
        .sections(found.sequence.iter().flat_map(|s| stage_sections(&found.design, s)))
        .section(score_section(&answer))
        .sections(predictor_section(&found.design, &found.adequacy))
        .sections(answer.conventions.map(conventions_section))
        .section(arrow_section(&answer))
        .section(error_section(&answer))
        .sections(feed_section(&answer))
        .section(unobservable_section("Not observable with these readings", &found.unobservable))
        .section(correlation_section(answer))
        .section(outlier_section(&answer))
        .section(influence_section(&answer))
}

fn score_section<'a>(answer: &IdentificationReport<'_>) -> Section<'a> {
    let found = answer.found;
    let table = Table::new(["root mean square of the residual", "", "times the noise"]).rows(
        answer
            .scores()
            .iter()
            .map(|(words, rms)| [(*words).to_owned(), rms_words(rms), format!("{:.2}", rms.noise)]),
    );
    let choice = if found.candidates > 0 { ", the choice of its terms included" } else { "" };
    Section::new("How well the model explains the readings")
        .table(table.note(format!(
            "Held out: every place was predicted by a model that had not seen it{choice}."
        )))
        .paragraph(kinds_words(&found.design, &found.adequacy))
        .list(answer.remarks())
}

fn conventions_section<'a>(check: &ConventionCheck) -> Section<'a> {
    let section = Section::new("Conventions").paragraph(format!(
        "{} changes tried; as it is, the residual is {:.2} times the noise",
        check.tried, check.residual
    ));
    let none = "no change of sign, order, sense or side fits far better";
    let better: Vec<String> = match check.better.is_empty() {
        true => vec![none.to_owned()],
        false => check.better.iter().map(|c| c.words()).collect(),
    };
    section.list(better.into_iter().chain(check.remarks.iter().cloned()))
}

fn arrow_section<'a>(answer: &IdentificationReport<'_>) -> Section<'a> {
    let section =
        Section::new("Residuals where the linear axes stand, in the frame of the machine")
            .on_page();
    let arrows = Rc::new(answer.arrows());
    let (before, after) = (|a: &Arrow| a.before_mm, |a: &Arrow| a.after_mm);
    let sizes = [longest(&arrows, before), longest(&arrows, after)];
    if sizes[0] <= 0.0 {
        return section;
    }
    let [large, small] = sizes.map(|size| magnification(&arrows, size));
    let views = |of: fn(&Arrow) -> _, by: f64| {
        [(0, 1, "X, mm", "Y, mm"), (0, 2, "X, mm", "Z, mm"), (1, 2, "Y, mm", "Z, mm")].map(|view| {
            let arrows = Rc::clone(&arrows);
            Figure::new("", move || Ok(arrow_picture(&arrows, of, by, view)))
        })
    };
    let words = |what: &str, by: f64, longest_mm: f64| {
        format!("{what}, enlarged {by} times; the longest is {:.2} µm.", longest_mm * 1e3)
    };
    section
        .paragraph(words("Without the unknown errors", large, sizes[0]))
        .grid(Columns::Three, views(before, large))
        .paragraph(words("After identification", small, sizes[1]))
        .grid(Columns::Three, views(after, small))
        .paragraph("The same at the exaggeration of the first row.")
        .grid(Columns::Three, views(after, large))
}

fn error_section<'a>(answer: &IdentificationReport<'a>) -> Section<'a> {
    let found = &answer.found.found;
    let figure = |angle: bool| {
        let machine =
            found.iter().filter(move |f| !f.is_setup && !f.is_time && f.is_angle == angle);
        let all: Vec<Bar<'_>> = machine.filter_map(bar).collect();
        let caption = format!("{}, bars with 95 % intervals", if angle { "µrad" } else { "µm" });
        (!all.is_empty()).then(|| Figure::new(caption, move || Ok(bars(&all))))
    };
    let row = |f: &Found| {
        let number = |v: f64| format!("{:.3}", shown(f, v));
        let [value, u, unit] = match f.value {
            Some((value, u)) => [number(value), number(u), unit(f).to_owned()],
            None => ["not observable", "", ""].map(str::to_owned),
        };
        let z = f.z().map_or(String::new(), |z| format!("{z:.1}"));
        let [freedom, expanded] = match f.expanded() {
            Some(expanded) => [freedom_words(f.degrees_of_freedom), number(expanded)],
            None => [const { String::new() }; 2],
        };
        [f.name.clone(), value, u, unit, z, freedom, expanded]
    };
    let left_out = &answer.found.left_out;
    let mut note = "U: 95.45 %, k by Student's t with ν effective degrees of freedom (Welch and Satterthwaite); ν = ∞ where \
                    noise and sizes are as stated."
        .to_owned();
    if !left_out.is_empty() {
        note += &format!(" Not supported by the readings: {}.", left_out.join(", "));
    }
    let head = ["error", "value", "standard uncertainty", "", "z", "ν", "U"];
    let table = Table::new(head).note(note);
    Section::new("The errors")
        .grid(Columns::AsFit, [false, true].into_iter().filter_map(figure))
        .table(table.rows(found.iter().map(row)).most_on_terminal(usize::MAX))
}

/// ν; beyond a thousand it makes no difference.
fn freedom_words(freedom: Option<f64>) -> String {
    freedom.map_or_else(|| "∞".to_owned(), |freedom| format!("{freedom:.1}"))
}

/// At which feeds it was read, the gain mismatch of the axes, and what cannot be separated.
fn feed_section<'a>(answer: &IdentificationReport<'_>) -> Option<Section<'a>> {
    let found = answer.found;
    if found.feeds.counts.is_empty() {
        return None;
    }
    let counts = found.feeds.counts.iter().map(|c| match c.feed_mm_per_min {
        0.0 => format!("{} standing", c.readings),
        feed => format!("{} at {feed} mm/min", c.readings),
    });
    let counts = counts.collect::<Vec<_>>().join(", ");
    let lags: Vec<&Found> = found.found.iter().filter(|f| f.is_time && f.value.is_some()).collect();
    let rows = lags.iter().filter_map(|f| {
        let (first, (value, u)) = (lags.first()?, f.value?);
        let gain = match value > 2.0 * u {
            true => format!("{:.2}", 1.0 / value),
            false => "not known".to_owned(),
        };
        let (a, b) = (first.number, f.number);
        let c = &found.fit.covariance;
        let apart = value - first.value?.0;
        let variance = c[(a, a)] + c[(b, b)] - 2.0 * c[(a, b)];
        let mismatch = match a == b {
            true => ["reference".to_owned(), String::new()],
            false => [apart * 1e3, variance.max(0.0).sqrt() * 1e3].map(|v| format!("{v:.3}")),
        };
        let [mismatch, u_mismatch] = mismatch;
        Some([f.name.clone(), gain, mismatch, u_mismatch])
    });
    let head = ["axis", "velocity gain, 1/s", "gain mismatch, ms", "standard uncertainty, ms"];
    let table = Table::new(head).rows(rows).note(
        "Mismatch: the lag of the axis less that of the first. An instrument that follows the path \
         sees it far better than a lag that all axes share.",
    );
    let section = Section::new("Feeds").paragraph(format!("Readings: {counts}."));
    let section = if lags.is_empty() { section } else { section.table(table) };
    Some(section.list(found.feeds.not_separable.iter().map(|s| s.words())))
}

fn bar(found: &Found) -> Option<Bar<'_>> {
    let (value, u) = found.value?;
    let (value, half) = (shown(found, value), shown(found, found.coverage_factor() * u));
    Some(Bar { name: &found.name, value, half, text: format!("{value:.2} {}", unit(found)) })
}

/// Combinations that change no reading.
pub(super) fn unobservable_section<'a>(title: &str, list: &[Unobservable]) -> Section<'a> {
    let line = |u: &Unobservable| {
        let with = u.resolve_with.as_deref().unwrap_or("none of the set-ups that were tried");
        format!("{}: {} = ?; resolved by: {with}", u.words, u.combination)
    };
    Section::new(title).list(list.iter().map(line))
}

fn correlation_section(answer: IdentificationReport<'_>) -> Section<'_> {
    let seen = answer.found.found.iter().filter(|f| f.value.is_some());
    let seen: Vec<&Found> = seen.take(MOST_MAPPED).collect();
    let caption =
        "Red +1, white 0, blue −1. Strongly correlated errors are known together better than each.";
    let figures = (seen.len() > 1).then(|| {
        let mut figure = Figure::new(caption, move || Ok(correlation_map(&answer, &seen)));
        figure.round = true;
        figure
    });
    Section::new("Correlation").on_page().grid(Columns::One, figures)
}

fn outlier_section<'a>(answer: &IdentificationReport<'_>) -> Section<'a> {
    let (outliers, limit) = (&answer.found.influences.outliers, answer.found.influences.limit);
    let section = Section::new("Readings that do not fit");
    if outliers.is_empty() {
        return section.paragraph(format!(
            "No reading lies beyond the limit of studentised residuals, {limit:.2} (1 % for all together, \
             Bonferroni)."
        ));
    }
    let rows = outliers.iter().take(MOST_REPORTED).map(|o| {
        [answer.place(o.row), (o.channel + 1).to_string(), format!("{:+.1}", o.studentised)]
    });
    section
        .paragraph(format!(
            "{} numbers lie beyond the limit of studentised residuals, {limit:.2} (1 % for all together, \
             Bonferroni); {}. The first are:",
            outliers.len(),
            if answer.found.weights.contains(&0.0) { "their rows are left out" } else { "they count all the same" }
        ))
        .table(Table::new(["reading", "channel", "studentised residual"]).rows(rows))
}

fn influence_section<'a>(answer: &IdentificationReport<'_>) -> Section<'a> {
    let rows = answer.influential().map(|row| {
        let influence = &answer.found.influences.rows[row];
        let (leverage, cook) = (influence.leverage, influence.cook);
        [answer.place(row), format!("{leverage:.3}"), format!("{cook:.4}")]
    });
    Section::new("Readings that move the result most if they are left out")
        .table(Table::new(["reading", "leverage", "Cook's distance"]).rows(rows))
}
