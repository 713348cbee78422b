//! Figures of one machine over its calibrations: trend, control limits, jumps. docs/model.md eq. 261 to 264.
//!
//! ```text
//!     machine files, documents of evaluate ──add──> points by figure and date
//!                                          ──history──> slope ± U, limits of an individuals chart, jumps, when a limit is reached
//! ```

mod read;

pub use read::{Calibration, read_document, read_limits, read_machine};

use std::collections::BTreeMap;
use trueaxis_input::{Date, Diagnostics, Place};
use trueaxis_standards::coverage::{Contribution, Expanded, combine};

/// Limits of a chart of individuals: so many mean moving ranges from the mean (ISO 7870-2, 3/d₂ with d₂ = 1.128).
pub const MOVING_RANGES: f64 = 2.66;
/// Fewer points have no limits.
const LEAST_FOR_LIMITS: usize = 3;
/// Days of a year.
pub const DAYS_PER_YEAR: f64 = 365.25;

/// A figure on one day.
#[derive(Debug, Clone, PartialEq)]
pub struct Point {
    /// When.
    pub date: Date,
    /// Its value. Unit: that of `unit`.
    pub value: f64,
    /// Its standard uncertainty; `None` where none is stated. Unit: that of `unit`.
    pub u: Option<f64>,
    /// The file that it comes from.
    pub file: String,
}

/// The value beyond which a figure shall not go.
#[derive(Debug, Clone, PartialEq)]
pub struct Limit {
    /// Its largest size. Unit: that of `unit`.
    pub size: f64,
    /// The days on which the trend reaches it: at the slope, and as early as U of the slope allows; `None` where it
    /// does not within a century.
    pub reached: [Option<Date>; 2],
    /// Whether the last value is beyond it.
    pub is_exceeded: bool,
}

/// The trend of a figure, per year.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Trend {
    /// Change of the value in a year. Unit: that of `unit`.
    pub per_year: f64,
    /// Its uncertainty. Unit: that of `unit`.
    pub uncertainty: Expanded,
    /// The line on the day of the first point. Unit: that of `unit`.
    pub at_first: f64,
}

/// A change from one calibration to the next.
#[derive(Debug, Clone, PartialEq)]
pub struct Jump {
    /// From when.
    pub from: Date,
    /// To when.
    pub to: Date,
    /// The change. Unit: that of `unit`.
    pub change: f64,
    /// U of the change (k = 2). Unit: that of `unit`.
    pub expanded: f64,
}

/// A figure over time.
#[derive(Debug, Clone, PartialEq)]
pub struct Series {
    /// Its name.
    pub name: String,
    /// `um`, `urad`, `arcsec`, `degC` …
    pub unit: String,
    /// By date.
    pub points: Vec<Point>,
    /// From two different days on.
    pub trend: Option<Trend>,
    /// Lower limit, mean and upper limit of the chart, from three points on. Unit: that of `unit`.
    pub control: Option<[f64; 3]>,
    /// The points that lie outside of the control limits, by number.
    pub outside: Vec<usize>,
    /// Changes that are larger than their U.
    pub jumps: Vec<Jump>,
    /// Its limit.
    pub limit: Option<Limit>,
}

impl Series {
    /// Whether nothing needs attention: no jump, no point outside, no limit exceeded.
    pub fn is_quiet(&self) -> bool {
        let kept = self.limit.as_ref().is_none_or(|l| !l.is_exceeded);
        self.jumps.is_empty() && self.outside.is_empty() && kept
    }
}

/// A machine over its calibrations.
#[derive(Debug, Clone, PartialEq)]
pub struct History {
    /// The machine.
    pub machine: String,
    /// Every figure with at least two dates.
    pub series: Vec<Series>,
    /// Figures with one date only.
    pub single: Vec<String>,
}

/// Limits by the name of a figure, each with its unit.
pub type Limits = BTreeMap<String, (f64, String)>;

/// Names the figures whose tables hold at several temperatures: the expansion of the scale is part of their change.
fn check_temperatures(calibrations: &[Calibration], problems: &mut Diagnostics) {
    let mut by_figure: BTreeMap<&str, Vec<(f64, &str)>> = BTreeMap::new();
    for calibration in calibrations {
        for (figure, celsius) in &calibration.tables_celsius {
            by_figure.entry(figure).or_default().push((*celsius, &calibration.file));
        }
    }
    for (figure, mut tables) in by_figure {
        tables.sort_by(|a, b| a.0.total_cmp(&b.0));
        let ends = tables.first().zip(tables.last()).filter(|(cold, warm)| cold.0 < warm.0);
        let Some(((cold, at_cold), (warm, at_warm))) = ends else { continue };
        let message = format!(
            "`{figure}`: the tables hold at several temperatures, {cold} °C in {at_cold} to {warm} °C in {at_warm}, and are compared \
             as they are"
        );
        let hint =
            "verify --diff OLD NEW refers the older table to the temperature of the newer one";
        problems.note("two-temperatures", Place::whole(at_warm), message, hint);
    }
}

/// The figures of calibrations of one machine over time; `None` with errors in `problems`.
pub fn history(
    calibrations: &[Calibration],
    limits: &Limits,
    problems: &mut Diagnostics,
) -> Option<History> {
    let first = calibrations.first()?;
    if let Some(other) = calibrations.iter().find(|c| c.machine != first.machine) {
        let message = format!(
            "the machine is `{}`, that of {} is `{}`",
            other.machine, first.file, first.machine
        );
        let hint = "a history is that of one machine: name its files, or give it one name in them";
        problems.error("other-machine", Place::whole(&other.file), message, hint);
        return None;
    }
    let with_chain = || calibrations.iter().filter_map(|c| Some((c, c.chain.as_ref()?)));
    if let Some((known, chain)) = with_chain().next()
        && let Some((other, its)) = with_chain().find(|(_, other)| *other != chain)
    {
        let message = format!("the chain is `{its}`, that of {} is `{chain}`", known.file);
        let hint =
            "errors of two chains are not the same quantities: a history is that of one machine";
        problems.error("other-machine", Place::whole(&other.file), message, hint);
        return None;
    }
    check_temperatures(calibrations, problems);
    let mut by_name: BTreeMap<(String, String), Vec<Point>> = BTreeMap::new();
    for calibration in calibrations {
        for (name, unit, point) in &calibration.figures {
            by_name.entry((name.clone(), unit.clone())).or_default().push(point.clone());
        }
    }
    let (mut series, mut single) = (Vec::new(), Vec::new());
    for ((name, unit), mut points) in by_name {
        points.sort_by(|a, b| a.date.cmp(&b.date).then(a.file.cmp(&b.file)));
        count_copies_once(&name, &mut points, problems);
        if let Some(twice) = points.windows(2).find(|w| w[0].date == w[1].date) {
            let message = format!("`{name}` of {} is also in {}", twice[1].date, twice[0].file);
            let hint = "both count; is one of them a copy, or is its date wrong?";
            problems.warn("same-date", Place::whole(&twice[1].file), message, hint);
        }
        match points.first().zip(points.last()) {
            Some((a, b)) if a.date < b.date => series.push(of_points(name, unit, points, limits)),
            _ => single.push(name),
        }
    }
    check_units(&series, limits, problems);
    for name in limits.keys().filter(|n| series.iter().all(|s| s.name != **n)) {
        let names: Vec<&str> = series.iter().map(|s| s.name.as_str()).collect();
        let message = format!("no figure with two dates is named `{name}`");
        let hint = format!("the figures are {}", names.join(", "));
        problems.error("unknown-figure", Place::whole("--limit"), message, &hint);
    }
    if series.is_empty() {
        let message = "no figure has two different dates".to_owned();
        let hint = "name at least two calibrations of one machine, each with its date";
        problems.error("no-history", Place::whole(&first.file), message, hint);
        return None;
    }
    (!problems.has_errors()).then(|| History { machine: first.machine.clone(), series, single })
}

/// A measurement that stands in several files, as one that was not repeated does in the machine file of the next year.
fn count_copies_once(name: &str, points: &mut Vec<Point>, problems: &mut Diagnostics) {
    let mut kept: Vec<Point> = Vec::new();
    let mut copy: Option<(Point, String)> = None;
    for point in points.drain(..) {
        let same = |p: &&Point| (p.date, p.value, p.u) == (point.date, point.value, point.u);
        match kept.iter().find(same) {
            Some(first) => copy = copy.or(Some((point, first.file.clone()))),
            None => kept.push(point),
        }
    }
    *points = kept;
    if let Some((twice, first)) = copy {
        let message = format!(
            "`{name}` of {} is the same in {first}, to the last digit: the two count once",
            twice.date
        );
        let hint = "a measurement counts once, in however many files it stands";
        problems.note("same-date", Place::whole(&twice.file), message, hint);
    }
}

/// A limit of another dimension than its figure would be left out.
fn check_units(series: &[Series], limits: &Limits, problems: &mut Diagnostics) {
    for (name, (_, unit)) in limits {
        let of_name = || series.iter().filter(|s| s.name == *name);
        let Some(other) =
            of_name().next().filter(|_| of_name().all(|s| factor(unit, &s.unit).is_none()))
        else {
            continue;
        };
        let kind = |unit: &str| match unit {
            "um" => "a length",
            "urad" | "arcsec" => "an angle",
            _ => "neither a length nor an angle",
        };
        let message =
            format!("the limit of `{name}` is {}, the figure is {}", kind(unit), kind(&other.unit));
        problems.error(
            "wrong-unit",
            Place::whole("--limit"),
            message,
            "a limit in a unit of the figure",
        );
    }
}

fn of_points(name: String, unit: String, points: Vec<Point>, limits: &Limits) -> Series {
    let trend = trend(&points);
    let control = control_limits(&points);
    let outside = match control {
        Some([low, _, high]) => {
            let is_outside = |p: &Point| p.value < low || p.value > high;
            points.iter().enumerate().filter(|(_, p)| is_outside(p)).map(|(i, _)| i).collect()
        }
        None => Vec::new(),
    };
    let jumps = points.windows(2).filter_map(|w| jump(&w[0], &w[1])).collect();
    let limit = limits
        .get(&name)
        .and_then(|(value, of)| Some(value * factor(of, &unit)?))
        .map(|size| limit(&points, trend, size));
    Series { name, unit, points, trend, control, outside, jumps, limit }
}

/// From one unit to another of the same dimension.
fn factor(from: &str, to: &str) -> Option<f64> {
    let per_arcsec = std::f64::consts::PI / 648_000.0 * 1e6;
    match (from, to) {
        _ if from == to => Some(1.0),
        ("arcsec", "urad") => Some(per_arcsec),
        ("urad", "arcsec") => Some(1.0 / per_arcsec),
        _ => None,
    }
}

/// The line of least squares over the days, weighted where every point has its u.
///
/// ```text
///     b = Σ w (t − t̄)(y − ȳ)/Σ w (t − t̄)²    u² = max(1, χ²/(n − 2))/Σ w (t − t̄)²         docs/model.md eq. 261
/// ```
fn trend(points: &[Point]) -> Option<Trend> {
    let known: Option<Vec<f64>> = points.iter().map(|p| p.u.filter(|u| *u > 0.0)).collect();
    let is_known = known.is_some();
    let weights: Vec<f64> = match known {
        Some(us) => us.iter().map(|u| 1.0 / (u * u)).collect(),
        None => vec![1.0; points.len()],
    };
    let first = points.first()?.date.number();
    let time: Vec<f64> =
        points.iter().map(|p| f64::from(p.date.number() - first) / DAYS_PER_YEAR).collect();
    let sum: f64 = weights.iter().sum();
    let mean = |values: &mut dyn Iterator<Item = f64>| {
        values.zip(&weights).map(|(v, w)| v * w).sum::<f64>() / sum
    };
    let (t, y) = (mean(&mut time.iter().copied()), mean(&mut points.iter().map(|p| p.value)));
    let rows = || time.iter().zip(points).zip(&weights);
    let squares: f64 = rows().map(|((a, _), w)| w * (a - t) * (a - t)).sum();
    if squares <= 0.0 {
        return None;
    }
    let per_year = rows().map(|((a, p), w)| w * (a - t) * (p.value - y)).sum::<f64>() / squares;
    let chi_square: f64 = rows()
        .map(|((a, p), w)| {
            let rest = p.value - y - per_year * (a - t);
            w * rest * rest
        })
        .sum();
    let free = points.len() as f64 - 2.0;
    let scatter = if free > 0.0 { chi_square / free } else { 0.0 };
    // What the points scatter about the line counts where it is more than their u says.
    let contribution = match is_known && scatter <= 1.0 {
        true => Contribution { u: (1.0 / squares).sqrt(), degrees_of_freedom: None },
        false => Contribution { u: (scatter / squares).sqrt(), degrees_of_freedom: Some(free) },
    };
    let uncertainty = combine(&[contribution]);
    // Two points without u, or on one line, say nothing of the uncertainty of the slope.
    let is_open = !is_known && free < 1.0;
    let uncertainty =
        if is_open { Expanded { u: f64::INFINITY, ..uncertainty } } else { uncertainty };
    Some(Trend { per_year, uncertainty, at_first: y - per_year * t })
}

/// Mean ± 2.66 mean moving range: docs/model.md eq. 262.
fn control_limits(points: &[Point]) -> Option<[f64; 3]> {
    if points.len() < LEAST_FOR_LIMITS {
        return None;
    }
    // From the first point on: of equal values the mean is that value, to the last bit.
    let first = points[0].value;
    let beyond = points.iter().map(|p| p.value - first).sum::<f64>();
    let mean = first + beyond / points.len() as f64;
    let ranges = points.windows(2).map(|w| (w[1].value - w[0].value).abs());
    let moving = ranges.sum::<f64>() / (points.len() - 1) as f64;
    Some([mean - MOVING_RANGES * moving, mean, mean + MOVING_RANGES * moving])
}

/// A change beyond U of both: docs/model.md eq. 263.
fn jump(from: &Point, to: &Point) -> Option<Jump> {
    let expanded = 2.0 * from.u?.hypot(to.u?);
    let change = to.value - from.value;
    let (from, to) = (from.date, to.date);
    (change.abs() > expanded).then_some(Jump { from, to, change, expanded })
}

/// When the trend reaches a limit: docs/model.md eq. 264.
fn limit(points: &[Point], trend: Option<Trend>, size: f64) -> Limit {
    let last = points.last().map_or(0.0, |p| p.value);
    let first = points.first().map_or(0, |p| p.date.number());
    let now = points.last().map_or(0, |p| p.date.number());
    let reached = |trend: Trend, slope: f64| {
        let target = if slope > 0.0 { size } else { -size };
        let years = f64::from(now - first) / DAYS_PER_YEAR;
        let line = trend.at_first + trend.per_year * years;
        let left = (target - line) / slope;
        let soon = slope.is_finite() && slope != 0.0 && (0.0..=100.0).contains(&left);
        soon.then(|| Date::of_number(now + (left * DAYS_PER_YEAR) as i32))
    };
    let at = trend.and_then(|t| reached(t, t.per_year));
    let early = trend.and_then(|t| {
        let u = t.uncertainty.expanded();
        let ends = [t.per_year - u, t.per_year + u].map(|slope| reached(t, slope));
        ends.into_iter().flatten().min()
    });
    Limit { size, reached: [at, early], is_exceeded: last.abs() > size }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points(values: &[(&str, f64)], u: Option<f64>) -> Vec<Point> {
        let point = |(date, value): &(&str, f64)| Point {
            date: Date::parse(date).unwrap(),
            value: *value,
            u,
            file: (*date).to_owned(),
        };
        values.iter().map(point).collect()
    }

    /// Three years of 4 days more than 365: slopes by hand.
    #[test]
    fn a_trend_by_hand() {
        let years =
            [("2020-01-01", 0.0), ("2021-01-01", 2.0), ("2022-01-01", 1.0), ("2023-01-01", 5.0)];
        let found = trend(&points(&years, None)).unwrap();
        // t = 0, 366, 731, 1096 days: Σ(t − t̄)(y − ȳ)/Σ(t − t̄)² = 2553/667022.75 per day
        let t = [0.0, 366.0, 731.0, 1096.0];
        let (tm, ym) = (t.iter().sum::<f64>() / 4.0, 2.0);
        let sxx: f64 = t.iter().map(|a| (a - tm) * (a - tm)).sum();
        let sxy: f64 = t.iter().zip(years).map(|(a, (_, y))| (a - tm) * (y - ym)).sum();
        assert!((found.per_year - sxy / sxx * DAYS_PER_YEAR).abs() < 1e-12);
        assert_eq!(found.uncertainty.degrees_of_freedom, Some(2.0));
        assert!((found.uncertainty.coverage_factor - 4.53).abs() < 0.01);
        // With u the scatter of 1.6 is more than 0.1 says, and less than 5 says.
        let large = trend(&points(&years, Some(5.0))).unwrap().uncertainty;
        assert_eq!((large.degrees_of_freedom, large.coverage_factor), (None, 2.0));
        assert!((large.u - 5.0 / (sxx.sqrt() / DAYS_PER_YEAR)).abs() < 1e-9);
        assert!(
            trend(&points(&years, Some(0.1))).unwrap().uncertainty.degrees_of_freedom.is_some()
        );
    }

    #[test]
    fn limits_and_jumps_by_hand() {
        let years = [
            ("2020-01-01", 10.0),
            ("2021-01-01", 11.0),
            ("2022-01-01", 10.0),
            ("2023-01-01", 15.0),
        ];
        let all = points(&years, Some(1.0));
        // Mean 11.5, moving ranges 1, 1, 5: 2.66 · 7/3
        let [low, mean, high] = control_limits(&all).unwrap();
        assert!((mean - 11.5).abs() < 1e-12 && (high - 11.5 - 2.66 * 7.0 / 3.0).abs() < 1e-12);
        assert!((mean - low - (high - mean)).abs() < 1e-12);
        // U = 2 √2 = 2.83: only the last change is larger.
        let jumps: Vec<f64> =
            all.windows(2).filter_map(|w| jump(&w[0], &w[1])).map(|j| j.change).collect();
        assert_eq!(jumps, [5.0]);
    }

    /// 1 µm a year from 0: 10 µm after ten years.
    #[test]
    fn a_limit_is_reached_where_the_line_meets_it() {
        let years: Vec<(String, f64)> =
            (0..5).map(|k| (format!("{}-01-01", 2010 + k), f64::from(k))).collect();
        let years: Vec<(&str, f64)> = years.iter().map(|(d, v)| (d.as_str(), *v)).collect();
        let all = points(&years, Some(0.1));
        let found = limit(&all, trend(&all), 10.0);
        let [at, early] = found.reached.map(Option::unwrap);
        assert!((at.number() - Date::parse("2020-01-01").unwrap().number()).abs() <= 2, "{at}");
        assert!(early < at && !found.is_exceeded);
        assert!(limit(&all, trend(&all), 3.5).is_exceeded);
        // Downwards the lower limit counts.
        let falling: Vec<(&str, f64)> = years.iter().map(|(d, v)| (*d, -v)).collect();
        let all = points(&falling, Some(0.1));
        assert_eq!(limit(&all, trend(&all), 10.0).reached[0], Some(at));
    }
}
