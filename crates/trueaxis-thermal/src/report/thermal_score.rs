//! Later logs scored with a thermal model, as text, picture and document.

use super::thermal_document::TermEntry;
use crate::thermal::{Logs, ScoredLog, Scoring};
use serde::Serialize;
use trueaxis_report::JsonSchema;
use trueaxis_report::plots::{Curve, Labels, curves};
use trueaxis_report::{Columns, DrawingError, Figure, Section, Table};

/// A curve of more points shows no more.
const MOST_POINTS: usize = 600;
/// More logs are not drawn one by one.
const MOST_DRAWN: usize = 24;

/// How later logs agree with the model.
#[derive(Debug, Serialize, JsonSchema)]
pub struct ScoringEntry<'a> {
    /// `as promised` or `worse than promised`.
    pub verdict: &'static str,
    /// What the model left of whole cycles that it had not seen, rms, µm.
    pub promised_um: f64,
    /// Expanded uncertainty of a row within the pattern of the sensors, 95.45 %, µm.
    pub promised_u_um: f64,
    /// The factor of U (Student's t). Unit: 1.
    pub coverage_factor: f64,
    /// Degrees of freedom of the factor: cycles less one.
    pub degrees_of_freedom: usize,
    /// A row with a larger squared distance is outside the pattern. Unit: 1.
    pub row_limit: f64,
    /// A log with a larger mean of it is outside the pattern. Unit: 1.
    pub log_limit: f64,
    /// The later logs.
    pub logs: Vec<ScoredLogEntry<'a>>,
}

/// A later log.
#[derive(Debug, Serialize, JsonSchema)]
pub struct ScoredLogEntry<'a> {
    /// Its name.
    pub name: &'a str,
    /// `as promised` or `worse than promised`.
    pub verdict: &'static str,
    /// Number of its rows.
    pub rows: usize,
    /// Of the displacement without a model, rms, µm.
    pub no_model_um: f64,
    /// Of the residual after its zero is removed, rms, µm.
    pub left_um: f64,
    /// The largest residual with its sign, µm.
    pub largest_um: f64,
    /// Of the expanded uncertainty of the rows, which grows outside the pattern, rms, µm.
    pub u_um: f64,
    /// Share of the rows whose residual is within their U. Unit: 1.
    pub within_u: f64,
    /// Whether the sensors moved as in the logs of the model: `inside`, `partly outside` or `outside`.
    pub pattern: &'static str,
    /// Rows outside the pattern.
    pub rows_outside: usize,
    /// Mean squared distance of the rows from the pattern (Mahalanobis). Unit: 1.
    pub mean_distance: f64,
    /// How much warmer all sensors together are than in the mean of the logs of the model, K.
    pub warmer_k: f64,
    /// Logs of the same pattern are within this, K; null if one zero holds for all logs.
    pub warmer_limit_k: Option<f64>,
    /// Squared distance of each row. Unit: 1.
    pub distances: &'a [f64],
    /// Expanded uncertainty of each row, µm.
    pub row_u_um: Vec<f64>,
    /// Residual of each row, µm.
    pub row_left_um: Vec<f64>,
    /// Sensors beyond their range.
    pub sensors_outside: Vec<SensorOutsideEntry<'a>>,
    /// Sensors that are not where the others say, in the farthest row.
    pub combinations: Vec<CombinationEntry<'a>>,
}

/// A sensor beyond its range.
#[derive(Debug, Serialize, JsonSchema)]
pub struct SensorOutsideEntry<'a> {
    /// The sensor.
    pub sensor: &'a str,
    /// Here, °C.
    pub range_celsius: [f64; 2],
    /// In the logs of the model, °C.
    pub logged_celsius: [f64; 2],
    /// From its zero, K.
    pub moved_k: [f64; 2],
    /// From its zero in the logs of the model, K.
    pub logged_moved_k: [f64; 2],
}

/// A sensor that is not where the others say.
#[derive(Debug, Serialize, JsonSchema)]
pub struct CombinationEntry<'a> {
    /// The sensor and its lag.
    #[serde(flatten)]
    pub term: TermEntry<'a>,
    /// Number of the row, from 1.
    pub row: usize,
    /// How far it is from what the others say, K.
    pub off_k: f64,
    /// Standard deviation of that in the logs of the model, K.
    pub usual_k: f64,
}

fn verdict(good: bool) -> &'static str {
    if good { "as promised" } else { "worse than promised" }
}

fn pattern(log: &ScoredLog) -> &'static str {
    match (log.outside, log.rows_outside) {
        (true, _) => "outside",
        (false, 0) => "inside",
        (false, _) => "partly outside",
    }
}

impl<'a> ScoringEntry<'a> {
    /// The entry of a scoring.
    pub fn of(logs: &'a Logs, scoring: &'a Scoring) -> Self {
        Self {
            verdict: verdict(scoring.as_promised()),
            promised_um: scoring.promised_mm * 1e3,
            promised_u_um: scoring.promised_u_mm * 1e3,
            coverage_factor: scoring.coverage_factor,
            degrees_of_freedom: scoring.degrees_of_freedom,
            row_limit: scoring.row_limit,
            log_limit: scoring.log_limit,
            logs: scoring.logs.iter().map(|log| log_entry(logs, log, scoring)).collect(),
        }
    }
}

fn log_entry<'a>(logs: &'a Logs, log: &'a ScoredLog, scoring: &Scoring) -> ScoredLogEntry<'a> {
    let um = |values: &[f64]| values.iter().map(|v| v * 1e3).collect();
    let sensors_outside = log.sensors.iter().map(|s| SensorOutsideEntry {
        sensor: &logs.sensors[s.sensor],
        range_celsius: s.range_celsius,
        logged_celsius: s.logged_celsius,
        moved_k: s.moved_k,
        logged_moved_k: s.logged_moved_k,
    });
    let combinations = log.combinations.iter().map(|c| CombinationEntry {
        term: TermEntry { sensor: &logs.sensors[c.term.sensor], lag_s: c.term.lag_s },
        row: c.row + 1,
        off_k: c.off_k,
        usual_k: c.usual_k,
    });
    ScoredLogEntry {
        name: &log.name,
        verdict: verdict(log.as_promised(scoring)),
        rows: log.u_mm.len(),
        no_model_um: log.no_model_mm * 1e3,
        left_um: log.left_mm * 1e3,
        largest_um: log.largest_mm * 1e3,
        u_um: log.expected_u_mm * 1e3,
        within_u: log.within,
        pattern: pattern(log),
        rows_outside: log.rows_outside,
        mean_distance: log.mean_distance,
        warmer_k: log.warmer_k,
        warmer_limit_k: log.warmer_limit_k.is_finite().then_some(log.warmer_limit_k),
        distances: &log.distances,
        row_u_um: um(&log.u_mm),
        row_left_um: um(&log.left_of_rows()),
        sensors_outside: sensors_outside.collect(),
        combinations: combinations.collect(),
    }
}

/// What the sensors of a log did that those of the model had not done, in one sentence; `None` if nothing.
pub fn outside_pattern(logs: &Logs, log: &ScoredLog) -> Option<String> {
    if !log.outside {
        return None;
    }
    let signed = |[low, high]: [f64; 2]| format!("{low:+.1} … {high:+.1} K");
    let warmer = format!(
        "all sensors together are {:+.1} K from the mean of the logs, where ±{:.1} K is usual",
        log.warmer_k, log.warmer_limit_k
    );
    let whole = (log.warmer_k.abs() > log.warmer_limit_k).then_some(warmer);
    let sensors = log
        .sensors
        .iter()
        .map(|s| {
            let name = &logs.sensors[s.sensor];
            let ([low, high], [from, to]) = (s.range_celsius, s.logged_celsius);
            format!(
                "`{name}` moved by {} from its zero (in the logs of the model {}), {low:.1} … {high:.1} °C \
                 ({from:.1} … {to:.1} °C)",
                signed(s.moved_k),
                signed(s.logged_moved_k)
            )
        });
    let mut said: Vec<String> = whole.into_iter().chain(sensors).collect();
    said.extend(log.combinations.iter().map(|c| {
        format!(
            "in row {} `{}` is {:+.2} K from what the other sensors say, where {:.2} K is usual",
            c.row + 1,
            c.term.name(logs),
            c.off_k,
            c.usual_k
        )
    }));
    Some(format!(
        "`{}` is outside the pattern of the logs of the model in {} of {} rows, and U is {:.1} µm there in \
         place of the promised one: {}",
        log.name,
        log.rows_outside,
        log.u_mm.len(),
        log.expected_u_mm * 1e3,
        if said.is_empty() { "all sensors together".to_owned() } else { said.join("; ") }
    ))
}

/// What the later logs say, in one sentence.
pub(super) fn sentence(scoring: &Scoring) -> String {
    let worst = scoring.logs.iter().max_by(|a, b| a.left_mm.total_cmp(&b.left_mm));
    let worst = worst.map_or_else(String::new, |log| {
        format!(
            "; `{}` leaves {:.2} µm rms, {:+.2} µm at most",
            log.name,
            log.left_mm * 1e3,
            log.largest_mm * 1e3
        )
    });
    let kept = scoring.logs.iter().filter(|log| log.as_promised(scoring)).count();
    format!(
        "{kept} of {} later logs leave no more than U = {:.2} µm, which {:.2} µm rms in held-out cycles \
         promised{worst}",
        scoring.logs.len(),
        scoring.promised_u_mm * 1e3,
        scoring.promised_mm * 1e3
    )
}

pub(super) fn score_section<'a>(logs: &'a Logs, scoring: &'a Scoring) -> Section<'a> {
    let headings = [
        "log",
        "without a model",
        "left, rms",
        "largest",
        "promised U",
        "U of its rows",
        "within U",
        "pattern of the sensors",
        "verdict",
    ];
    let rows = scoring.logs.iter().map(|log| {
        let um = |mm: f64| format!("{:.2}", mm * 1e3);
        [
            log.name.clone(),
            um(log.no_model_mm),
            um(log.left_mm),
            format!("{:+.2}", log.largest_mm * 1e3),
            um(scoring.promised_u_mm),
            um(log.expected_u_mm),
            format!("{:.0} %", log.within * 100.0),
            match log.rows_outside {
                0 => pattern(log).to_owned(),
                n => format!("{}, {n} of {} rows", pattern(log), log.u_mm.len()),
            },
            verdict(log.as_promised(scoring)).to_owned(),
        ]
    });
    let figures = scoring.logs.iter().take(MOST_DRAWN).map(|log| {
        let caption = format!("{}: {:.2} µm left", log.name, log.left_mm * 1e3);
        Figure::new(caption, move || picture(log))
    });
    Section::new("Later logs, which the model has not seen, µm")
        .table(Table::new(headings).rows(rows).note(format!(
            "Promised: rms of whole cycles out, times t = {:.2} ({} degrees of freedom). U of its rows grows with \
             the distance of the sensors from what they did in the logs of the model; a row is outside from a \
             squared distance of {:.1} on, a log from a mean of {:.1} on or with a quarter of its rows outside.",
            scoring.coverage_factor, scoring.degrees_of_freedom, scoring.row_limit, scoring.log_limit
        )))
        .list(scoring.logs.iter().filter_map(|log| outside_pattern(logs, log)))
        .grid(Columns::AsFit, figures)
}

/// The residual of a log between its U.
fn picture(log: &ScoredLog) -> Result<String, DrawingError> {
    let (x, scale) = match &log.times_s {
        Some(_) => ("time, min", 60.0),
        None => ("row", 1.0),
    };
    let at = |i: usize| log.times_s.as_ref().map_or(i as f64, |t| t[i]) / scale;
    let curve = |label: &str, values: &[f64], sign: f64| Curve {
        label: label.to_owned(),
        points: (0..values.len())
            .step_by(values.len().div_ceil(MOST_POINTS).max(1))
            .map(|i| (at(i), sign * values[i] * 1e3))
            .collect(),
    };
    let lines = [
        curve("measured", &log.measured_mm, 1.0),
        curve("predicted", &log.predicted_mm, 1.0),
        curve("residual", &log.left_of_rows(), 1.0),
        curve("+U", &log.u_mm, 1.0),
        curve("−U", &log.u_mm, -1.0),
    ];
    curves((500, 300), &Labels { x, y: "µm" }, &lines)
}
