//! A history as text, page and document `trueaxis/history/1`.

use crate::history::{History, Jump, Series};
use serde::Serialize;
use trueaxis_report::JsonSchema;
use trueaxis_report::numbers::fixed;
use trueaxis_report::{Band, Picture, Report, Scatter, Section, Standing, Table};

/// More charts than this are not shown.
const MOST_CHARTS: usize = 24;

/// Figures of one machine over its calibrations: `trueaxis/history/1`.
#[derive(Debug, Serialize, JsonSchema)]
pub struct HistoryDocument<'a> {
    /// Which document this is.
    #[schemars(extend("const" = "trueaxis/history/1"))]
    pub schema: &'static str,
    /// The version of the program.
    pub version: &'static str,
    /// The machine.
    pub machine: &'a str,
    /// Whether nothing needs attention: no jump, no point outside of the control limits, no limit exceeded.
    pub quiet: bool,
    /// Every figure with at least two dates.
    pub series: Vec<SeriesEntry<'a>>,
    /// Figures with one date only.
    pub single: &'a [String],
}

/// A figure over time.
#[derive(Debug, Serialize, JsonSchema)]
pub struct SeriesEntry<'a> {
    /// Its name.
    pub figure: &'a str,
    /// The unit of its numbers: `um`, `urad`, `arcsec`.
    pub unit: &'a str,
    /// Its points by date.
    pub points: Vec<PointEntry<'a>>,
    /// Change in a year. Unit: that of `unit`.
    pub slope_per_year: Option<f64>,
    /// Its expanded uncertainty (95.45 %); null where nothing is known of it. Unit: that of `unit`.
    #[serde(rename = "U_slope_per_year")]
    pub expanded_slope: Option<f64>,
    /// Its degrees of freedom; null for infinitely many. Unit: 1.
    pub degrees_of_freedom: Option<f64>,
    /// Its coverage factor. Unit: 1.
    pub k: Option<f64>,
    /// Lower limit, mean and upper limit of the chart of individuals; null below three points. Unit: that of `unit`.
    pub control_limits: Option<[f64; 3]>,
    /// The dates of points outside of them.
    pub outside: Vec<String>,
    /// Changes beyond U of both calibrations.
    pub jumps: Vec<JumpEntry>,
    /// The limit; null where none is stated. Unit: that of `unit`.
    pub limit: Option<f64>,
    /// Whether the last value is beyond the limit; null where none is stated.
    pub exceeded: Option<bool>,
    /// When the trend reaches the limit; null if not within a century.
    pub reached: Option<String>,
    /// The same as early as U of the slope allows.
    pub reached_earliest: Option<String>,
}

/// A figure on a day.
#[derive(Debug, Serialize, JsonSchema)]
pub struct PointEntry<'a> {
    /// The date.
    pub date: String,
    /// The value. Unit: that of `unit`.
    pub value: f64,
    /// Its standard uncertainty; null where none is stated. Unit: that of `unit`.
    pub u: Option<f64>,
    /// The file.
    pub file: &'a str,
}

/// A change from one calibration to the next.
#[derive(Debug, Serialize, JsonSchema)]
pub struct JumpEntry {
    /// From when.
    pub from: String,
    /// To when.
    pub to: String,
    /// The change. Unit: that of `unit`.
    pub change: f64,
    /// Its expanded uncertainty (k = 2). Unit: that of `unit`.
    #[serde(rename = "U")]
    pub expanded: f64,
}

impl<'a> From<&'a History> for HistoryDocument<'a> {
    fn from(history: &'a History) -> Self {
        let jump = |j: &Jump| JumpEntry {
            from: j.from.to_string(),
            to: j.to.to_string(),
            change: j.change,
            expanded: j.expanded,
        };
        let entry = |s: &'a Series| {
            let u = s.trend.map(|t| t.uncertainty).filter(|u| u.u.is_finite());
            let reached =
                |k: usize| s.limit.as_ref().and_then(|l| l.reached[k]).map(|d| d.to_string());
            let point = |p: &'a crate::history::Point| PointEntry {
                date: p.date.to_string(),
                value: p.value,
                u: p.u,
                file: &p.file,
            };
            SeriesEntry {
                figure: &s.name,
                unit: &s.unit,
                points: s.points.iter().map(point).collect(),
                slope_per_year: s.trend.map(|t| t.per_year),
                expanded_slope: u.map(|u| u.expanded()),
                degrees_of_freedom: u.and_then(|u| u.degrees_of_freedom),
                k: u.map(|u| u.coverage_factor),
                control_limits: s.control,
                outside: s.outside.iter().map(|i| s.points[*i].date.to_string()).collect(),
                jumps: s.jumps.iter().map(jump).collect(),
                limit: s.limit.as_ref().map(|l| l.size),
                exceeded: s.limit.as_ref().map(|l| l.is_exceeded),
                reached: reached(0),
                reached_earliest: reached(1),
            }
        };
        Self {
            schema: "trueaxis/history/1",
            version: trueaxis_report::VERSION,
            machine: &history.machine,
            quiet: history.series.iter().all(Series::is_quiet),
            series: history.series.iter().map(entry).collect(),
            single: &history.single,
        }
    }
}

/// A unit in words.
fn shown(unit: &str) -> &str {
    match unit {
        "um" => "µm",
        "urad" => "µrad",
        other => other,
    }
}

/// A history as text and page.
pub fn history_report(history: &History) -> Report<'static> {
    let loud: Vec<&Series> = history.series.iter().filter(|s| !s.is_quiet()).collect();
    let head = Report::new(format!("{}: figures over its calibrations", history.machine));
    let head = match loud.len() {
        0 => head.verdict(
            Standing::Good,
            "STEADY",
            "no figure has jumped, left its control limits or its limit",
        ),
        n => {
            let names: Vec<&str> = loud.iter().map(|s| s.name.as_str()).collect();
            let of = history.series.len();
            head.verdict(
                Standing::Bad,
                "CHANGED",
                format!("{n} of {of} figures: {}", names.join(", ")),
            )
        }
    };
    let single = Section::new("With one date only").list(history.single.iter().cloned());
    let charts = loud.iter().copied().chain(history.series.iter().filter(|s| s.is_quiet()));
    let charts = charts.take(MOST_CHARTS).map(|s| Section::from(chart(s)));
    head.section(Section::new("Trends").table(trends(history)))
        .section(Section::new("Jumps between two calibrations").table(jumps(history)))
        .sections(charts)
        .section(single)
}

fn trends(history: &History) -> Table {
    let rows = history.series.iter().map(|s| {
        let number = |v: f64| fixed(v, 2);
        let dash = || "–".to_owned();
        let first_last =
            |p: Option<&crate::history::Point>| p.map_or_else(dash, |p| number(p.value));
        let u = s.trend.map(|t| t.uncertainty.expanded()).filter(|u| u.is_finite());
        let limits = s
            .control
            .map_or_else(dash, |[low, _, high]| format!("{} … {}", number(low), number(high)));
        let outside: Vec<String> =
            s.outside.iter().map(|i| s.points[*i].date.to_string()).collect();
        let reached = s.limit.as_ref().map_or_else(dash, |l| match (l.is_exceeded, l.reached) {
            (true, _) => "exceeded".to_owned(),
            (_, [Some(at), Some(early)]) => format!("{at} (from {early})"),
            (_, [Some(at), None]) => at.to_string(),
            (_, [None, Some(early)]) => format!("not before {early}"),
            _ => "no".to_owned(),
        });
        [
            s.name.clone(),
            s.points.len().to_string(),
            first_last(s.points.first()),
            first_last(s.points.last()),
            s.trend.map_or_else(dash, |t| number(t.per_year)),
            u.map_or_else(dash, number),
            limits,
            if outside.is_empty() { dash() } else { outside.join(" ") },
            reached,
            shown(&s.unit).to_owned(),
        ]
    });
    Table::new(["figure", "n", "first", "last", "per year", "U", "control limits", "outside", "limit reached", ""])
        .rows(rows)
        .note(
            "Slope by least squares, weighted where every point has its u; U 95.45 %, with the scatter about the line where \
             that is more than u says. Control limits: mean ± 2.66 mean moving range (ISO 7870-2, individuals).",
        )
}

fn jumps(history: &History) -> Table {
    let rows = history.series.iter().flat_map(|s| {
        s.jumps.iter().map(|j| {
            [
                s.name.clone(),
                j.from.to_string(),
                j.to.to_string(),
                fixed(j.change, 2),
                fixed(j.expanded, 2),
                shown(&s.unit).to_owned(),
            ]
        })
    });
    Table::new(["figure", "from", "to", "change", "U (k = 2)", ""]).rows(rows)
}

fn chart(s: &Series) -> Picture {
    let first = s.points.first().map_or(0, |p| p.date.number());
    let year = |p: &crate::history::Point| {
        f64::from(p.date.number() - first) / crate::history::DAYS_PER_YEAR
    };
    let ends: Vec<f64> = s.points.first().into_iter().chain(s.points.last()).map(year).collect();
    let level = |v: f64| ends.iter().map(|t| (*t, v, 0.0)).collect::<Vec<_>>();
    let line = |label: &str, colour, line| Band {
        label: label.to_owned(),
        colour,
        line,
        points: Vec::new(),
    };
    let value = s.points.iter().map(|p| (year(p), p.value, 2.0 * p.u.unwrap_or(0.0)));
    let points = s.points.iter().map(|p| (year(p), p.value));
    let mut bands = vec![Band {
        label: "value ± U".to_owned(),
        colour: 0,
        line: value.collect(),
        points: points.collect(),
    }];
    if let Some([low, mean, high]) = s.control {
        for (label, v) in
            [("lower control limit", low), ("mean", mean), ("upper control limit", high)]
        {
            bands.push(line(label, 2, level(v)));
        }
    }
    if let Some(limit) = &s.limit {
        bands.push(line("limit", 1, level(limit.size)));
    }
    let trend = s.trend.map(|t| ends.iter().map(|x| (*x, t.at_first + t.per_year * x)).collect());
    let date = s.points.first().map_or(String::new(), |p| p.date.to_string());
    Picture::Scatter(Scatter {
        title: s.name.clone(),
        note: "Dashed: trend.".to_owned(),
        x: format!("years since {date}"),
        y: shown(&s.unit).to_owned(),
        from_zero: false,
        bands,
        dashed: trend.unwrap_or_default(),
    })
}
