//! At which feeds was it read, and what do lag and geometry have in common at them?
//!
//! ```text
//!     R² = gᵀ G⁺ g/(jᵀj)      g = Gᵀ-column products of the lag j           docs/model.md eq. 334
//! ```

use super::records::Records;
use nalgebra::DVector;
use serde::Serialize;
use std::collections::BTreeMap;
use trueaxis_input::Diagnostics;
use trueaxis_measure::measure::{Campaign, Readings};
use trueaxis_measure::unknowns::design::Design;
use trueaxis_measure::unknowns::fit::{Observability, normal_matrix};
use trueaxis_measure::unknowns::term::{Basis, Term};

/// From this share on a lag cannot be separated: its variance is ten times as large (VIF > 10).
const SHARED: f64 = 0.9;
/// Repeats that differ by so many times their noise, in the median, were not read alike.
const FAR: f64 = 8.0;
/// A steady rate that leaves less than this share of the repeats' differences explains them.
const STEADY: f64 = 0.25;
/// From so many repeats on.
const LEAST_REPEATS: usize = 10;
/// So many errors are named for one lag.
const MOST_NAMED: usize = 3;

/// Readings at one feed.
#[derive(Debug, Clone, PartialEq, Serialize, trueaxis_report::JsonSchema)]
pub struct FeedCount {
    /// Feed of the tool against the workpiece, mm/min; 0 standing.
    pub feed_mm_per_min: f64,
    /// How many readings.
    pub readings: usize,
}

/// What lag of one axis cannot be separated from.
#[derive(Debug, Clone, PartialEq, Serialize, trueaxis_report::JsonSchema)]
pub struct SharedLag {
    /// `lag Y`.
    pub name: String,
    /// The share of its effect on the readings that other errors have too, 0 to 1. Unit: 1.
    pub share: f64,
    /// The errors for which it passes, the largest first.
    pub passes_for: Vec<PassesFor>,
}

/// An error for which lag passes.
#[derive(Debug, Clone, PartialEq, Serialize, trueaxis_report::JsonSchema)]
pub struct PassesFor {
    /// Its name.
    pub name: String,
    /// How much of it 1 ms of lag pretends. Unit: that of `unit`.
    pub per_ms: f64,
    /// `um` or `urad`.
    pub unit: &'static str,
}

/// The feeds of a campaign; empty if none is stated.
#[derive(Debug, Clone, PartialEq, Default, Serialize, trueaxis_report::JsonSchema)]
pub struct Feeds {
    /// Every feed, the slowest first.
    pub counts: Vec<FeedCount>,
    /// Lags that these readings cannot separate from errors of the machine or the set-up.
    pub not_separable: Vec<SharedLag>,
}

impl SharedLag {
    /// In words.
    pub fn words(&self) -> String {
        let unit = |p: &PassesFor| if p.unit == "urad" { "µrad" } else { "µm" };
        let all = self.passes_for.iter().map(|p| {
            let sign = if p.per_ms < 0.0 { "−" } else { "" };
            format!("{sign}{:.3} {} of {}", p.per_ms.abs(), unit(p), p.name)
        });
        format!(
            "{} cannot be separated by feed ({:.1} % of it looks like other errors): 1 ms passes for {}; \
             measure standing or at two feeds",
            self.name,
            100.0 * self.share,
            all.collect::<Vec<_>>().join(", ")
        )
    }
}

/// Readings whose feeds are missing or mixed; errors where no answer could be trusted.
pub(super) fn check_feeds(design: &Design, records: &Records, problems: &mut Diagnostics) {
    let readings = &records.readings;
    let feed = |i: usize| readings.motions[i].feed_mm_per_s;
    let hint = "add a column feed_mm_per_min: 0 standing, else the feed of the tool";
    if let Some(row) = (0..readings.len()).find(|i| feed(*i).is_none()) {
        let stated = (0..readings.len()).any(|i| feed(i).is_some());
        let sought = design.terms.iter().any(|t| t.basis.is_servo());
        if sought || stated {
            let message = match sought {
                true => "[unknown.servo] needs the feed of every reading, and here is none",
                false => "other readings state their feed, and this one does not",
            };
            return problems.error("feed-missing", records.place(row), message.to_owned(), hint);
        }
    }
    if let Some((row, off, first)) = mixed(design, readings) {
        let message = format!(
            "the pose of line {} again, but it reads {off:.0} times the noise apart, and so do most \
             repeats: two feeds in one file?",
            readings.lines[first]
        );
        let hint =
            format!("{hint}; or, if it drifted in between, unknown = {{ drift = \"free\", … }}");
        problems.error("mixed-feeds", records.place(row), message, &hint);
    }
}

/// The row whose repeat without feed is furthest away, by how many times the noise, and the first row
/// of that pose, if most repeats are far away and not by a steady rate in time.
fn mixed(design: &Design, readings: &Readings) -> Option<(usize, f64, usize)> {
    let mut first: BTreeMap<_, usize> = BTreeMap::new();
    let mut pairs: Vec<Repeat> = Vec::new();
    for i in 0..readings.len() {
        let of = readings.instruments[i];
        let instrument = &design.instruments[of as usize];
        let is_stated = readings.motions[i].feed_mm_per_s.is_some();
        // What drifts does not come back to what it was.
        if instrument.kind.triggers() || is_stated || instrument.needs_time() {
            continue;
        }
        let command = readings.commands[i].map(|q| (q * 1e6).round() as i64);
        let n = readings.directions[i];
        let direction = [n.x, n.y, n.z].map(|v| (v * 1e6).round() as i64);
        let side = readings.approaches[i].map(|a| a.signum() as i8);
        let before = *first.entry((of, command, direction, side)).or_insert(i);
        if before != i {
            pairs.push(Repeat::between(design, readings, before, i));
        }
    }
    let median = median(pairs.iter().map(Repeat::off)).filter(|_| pairs.len() >= LEAST_REPEATS)?;
    let most = pairs.iter().max_by(|a, b| a.off().total_cmp(&b.off()))?;
    (median > FAR && !is_drift(&pairs, median)).then(|| (most.row, most.off(), most.before))
}

/// A row, the first of its pose, and how far apart they read, in parts of the noise of a difference.
struct Repeat {
    before: usize,
    row: usize,
    apart: Vec<f64>,
    /// s; 0 without a time.
    time_between_s: f64,
}

impl Repeat {
    fn between(design: &Design, readings: &Readings, before: usize, row: usize) -> Self {
        let instrument = &design.instruments[readings.instruments[row] as usize];
        let apart = (0..instrument.sight.channels()).map(|c| {
            let apart = readings.values[row][c] - readings.values[before][c];
            apart / (instrument.noise[c] * 2f64.sqrt())
        });
        let time = |i: usize| readings.times_s.get(i).copied().unwrap_or(0.0);
        let time_between_s = time(row) - time(before);
        Repeat { before, row, apart: apart.collect(), time_between_s }
    }

    fn off(&self) -> f64 {
        self.apart.iter().fold(0.0, |a: f64, d| a.max(d.abs()))
    }
}

/// Whether a steady rate explains most of it: then it is evaluated, and called a drift, not two feeds.
fn is_drift(pairs: &[Repeat], raw_median: f64) -> bool {
    let channels = pairs.iter().map(|p| p.apart.len()).max().unwrap_or(0);
    let rate = |c: usize| {
        let of = |p: &Repeat| p.apart.get(c).map(|d| d / p.time_between_s);
        median(pairs.iter().filter(|p| p.time_between_s != 0.0).filter_map(of)).unwrap_or(0.0)
    };
    let rates: Vec<f64> = (0..channels).map(rate).collect();
    let rest = |p: &Repeat| {
        let of = p.apart.iter().zip(&rates).map(|(d, r)| (d - r * p.time_between_s).abs());
        of.fold(0.0, f64::max)
    };
    median(pairs.iter().map(rest)).is_some_and(|rest| rest < STEADY * raw_median)
}

fn median(values: impl Iterator<Item = f64>) -> Option<f64> {
    let mut all: Vec<f64> = values.collect();
    all.sort_by(f64::total_cmp);
    all.get(all.len() / 2).copied()
}

/// Which lags these readings cannot separate, among the unknowns or not.
pub(super) fn feeds(campaign: &Campaign, readings: &Readings) -> Feeds {
    let mut counts: BTreeMap<i64, usize> = BTreeMap::new();
    for motion in &readings.motions {
        if let Some(feed) = motion.feed_mm_per_s {
            *counts.entry((feed * 6e4).round() as i64).or_default() += 1;
        }
    }
    let count = |(feed, readings): (&i64, &usize)| FeedCount {
        feed_mm_per_min: *feed as f64 / 1e3,
        readings: *readings,
    };
    let counts: Vec<FeedCount> = counts.iter().map(count).collect();
    let not_separable = match readings.motions.iter().any(|m| m.is_moving()) {
        true => shared_lags(campaign, readings),
        false => Vec::new(),
    };
    Feeds { counts, not_separable }
}

/// Whether all was read at one feed. A row that stands where a pass begins is not a measurement standing: it
/// has one after it that moves, and none before it that stands.
fn is_one_feed(readings: &Readings) -> bool {
    let motions = &readings.motions;
    let stands = |i: usize| motions.get(i).is_some_and(|m| m.feed_mm_per_s == Some(0.0));
    let begins = |i: usize| !(i > 0 && stands(i - 1)) && i + 1 < motions.len() && !stands(i + 1);
    let mut feeds = (0..motions.len()).filter(|i| !begins(*i) || !stands(*i));
    let first = feeds.next().map(|i| motions[i].feed_mm_per_s);
    feeds.all(|i| Some(motions[i].feed_mm_per_s) == first)
}

fn shared_lags(campaign: &Campaign, readings: &Readings) -> Vec<SharedLag> {
    let made: Vec<Term> = campaign.terms.iter().filter(|t| !t.basis.is_servo()).copied().collect();
    // At one feed only the shape of the path separates a lag: all are named.
    let one_feed = is_one_feed(readings);
    let mut shared = Vec::new();
    for lag in lags(campaign, readings) {
        let mut terms = made.clone();
        terms.push(lag);
        terms.sort_by_key(|t| t.index);
        let of = |t: &Term| t.basis.is_lag();
        let Some(k) = terms.iter().position(of) else { continue };
        let design = Design::new(&campaign.machine, terms, campaign.instruments.clone());
        let normal = normal_matrix(&design, readings, &[]);
        let square = normal[(k, k)];
        if square <= 0.0 {
            continue;
        }
        let others = normal.clone().remove_row(k).remove_column(k);
        let column: Vec<f64> =
            (0..normal.nrows()).filter(|i| *i != k).map(|i| normal[(i, k)]).collect();
        let column = DVector::from_vec(column);
        let pretended = Observability::with_threshold(&others, 1e-4).solve(&column);
        let share = (pretended.dot(&column) / square).clamp(0.0, 1.0);
        if share < SHARED && !one_feed {
            continue;
        }
        // By what the readings show of each.
        let size = |i: usize| pretended[i].abs() * others[(i, i)].max(0.0).sqrt();
        let mut order: Vec<usize> = (0..pretended.len()).collect();
        order.sort_by(|a, b| size(*b).total_cmp(&size(*a)));
        let named = order.into_iter().filter(|i| size(*i) > 0.0).take(MOST_NAMED);
        let passes_for = named.filter_map(|i| {
            let unknown = design.unknown(if i < k { i } else { i + 1 })?;
            let (scale, unit) = if unknown.is_angle() { (1e3, "urad") } else { (1.0, "um") };
            Some(PassesFor { name: unknown.name(), per_ms: pretended[i] * scale, unit })
        });
        shared.push(SharedLag { name: lag.name(), share, passes_for: passes_for.collect() });
    }
    shared
}

/// The lags among the unknowns; of all axes that moved, if none is.
fn lags(campaign: &Campaign, readings: &Readings) -> Vec<Term> {
    let sought: Vec<Term> = campaign.terms.iter().filter(|t| t.basis.is_lag()).copied().collect();
    if !sought.is_empty() {
        return sought;
    }
    let moved = |i: usize| readings.motions.iter().any(|m| m.speed[i] != 0.0);
    (0..campaign.machine.axes().len())
        .filter(|i| moved(*i))
        .filter_map(|i| Term::servo(&campaign.machine, i, |sense| Basis::Lag { sense }))
        .collect()
}
