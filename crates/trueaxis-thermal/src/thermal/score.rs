//! Logs that came later, scored with a model: what it promised, what remains, and whether the sensors
//! moved as they did in the logs of the model.
//!
//! ```text
//!     D² = x (A + N)⁻¹ xᵀ          A = XᵀX/n,  N = diag τ²                              docs/model.md eq. 271
//!     U² = t² (x_m G V x_mᵀ + σ² (1 + (D² + L²)/G))                                    docs/model.md eq. 272
//! ```
//!
//! x: a row of all sensors and of the lags of the model, less its zero; x_m: of the terms of the model. Directions in
//! which the sensors of the logs moved by no more than they scatter are not determined: D² is large there. L: how
//! much warmer or colder the whole log is, by the differences between those of the model.

use super::design::{Design, Fit};
use super::{Cycle, Logs, Term, ThermalModel, Zero, jitter_square};
use nalgebra::{DMatrix, DVector};
use trueaxis_geometry::statistics::{chi_square_above, coverage_factor, student_above};

/// No sensor says less than this for certain, K.
const LEAST_K: f64 = 0.05;
/// Logs that differ by less than this as a whole are no warmer and no colder, K.
const LEAST_LEVEL_K: f64 = 0.5;
/// So many rows, and so many logs, of the same pattern count as outside by chance.
const BY_CHANCE: f64 = 0.01;
/// The rest that no slope explains is at least this share of the mean square residual.
const LEAST_REST: f64 = 0.25;
/// A sensor is outside its range by more than this share of it.
const BEYOND: f64 = 0.1;
/// A log with a larger share of rows outside is outside.
const OUTSIDE_SHARE: f64 = 0.25;

/// What later logs say about a model.
#[derive(Debug, Clone, PartialEq)]
pub struct Scoring {
    /// What the model left of whole cycles that it had not seen, rms, mm.
    pub promised_mm: f64,
    /// The expanded uncertainty of a row within the pattern, 95.45 %, mm: t times the above.
    pub promised_u_mm: f64,
    /// t. Unit: 1.
    pub coverage_factor: f64,
    /// Of t: cycles less one.
    pub degrees_of_freedom: usize,
    /// D² of a row within the pattern is below this, 99 %. Unit: 1.
    pub row_limit: f64,
    /// The mean D² of a log within the pattern is below this, 99 %. Unit: 1.
    pub log_limit: f64,
    /// The later logs.
    pub logs: Vec<ScoredLog>,
}

/// A later log.
#[derive(Debug, Clone, PartialEq)]
pub struct ScoredLog {
    /// Its name.
    pub name: String,
    /// When each row was taken, if that is known, s.
    pub times_s: Option<Vec<f64>>,
    /// Measured, less the zero of the log, mm.
    pub measured_mm: Vec<f64>,
    /// By the model, mm.
    pub predicted_mm: Vec<f64>,
    /// Expanded uncertainty of each row, 95.45 %, mm.
    pub u_mm: Vec<f64>,
    /// D² of each row. Unit: 1.
    pub distances: Vec<f64>,
    /// Rows beyond the limit.
    pub rows_outside: usize,
    /// Whether the log is outside the pattern as a whole.
    pub outside: bool,
    /// Mean of D². Unit: 1.
    pub mean_distance: f64,
    /// How much warmer all sensors together are than in the mean of the logs of the model, K.
    pub warmer_k: f64,
    /// Logs of the same pattern are within this, 99 %, K; infinite if one zero holds for all.
    pub warmer_limit_k: f64,
    /// Of the displacement without a model, rms, mm.
    pub no_model_mm: f64,
    /// Of the residual, rms, mm.
    pub left_mm: f64,
    /// The largest residual, with its sign, mm.
    pub largest_mm: f64,
    /// Of U over the rows, rms, mm.
    pub expected_u_mm: f64,
    /// Share of the rows whose residual is within U. Unit: 1.
    pub within: f64,
    /// Sensors that went beyond what they did in the logs of the model.
    pub sensors: Vec<SensorOutside>,
    /// What the farthest row has that the logs of the model have not; with rows outside only.
    pub combinations: Vec<Combination>,
}

/// A sensor beyond its range.
#[derive(Debug, Clone, PartialEq)]
pub struct SensorOutside {
    /// Its place among the sensors.
    pub sensor: usize,
    /// Here, °C.
    pub range_celsius: [f64; 2],
    /// In the logs of the model, °C.
    pub logged_celsius: [f64; 2],
    /// From its zero, here, K.
    pub moved_k: [f64; 2],
    /// From its zero in the logs of the model, K.
    pub logged_moved_k: [f64; 2],
}

/// A term that is not where the others say it should be.
#[derive(Debug, Clone, PartialEq)]
pub struct Combination {
    /// The term.
    pub term: Term,
    /// The row of the log.
    pub row: usize,
    /// How far it is from what the other sensors say, K.
    pub off_k: f64,
    /// The standard deviation of that in the logs of the model, K.
    pub usual_k: f64,
}

impl ScoredLog {
    /// Whether it leaves no more than the training promised for its own pattern.
    pub fn as_promised(&self, scoring: &Scoring) -> bool {
        self.left_mm <= scoring.promised_u_mm
    }

    /// Measured less predicted, mm.
    pub fn left_of_rows(&self) -> Vec<f64> {
        self.measured_mm.iter().zip(&self.predicted_mm).map(|(m, p)| m - p).collect()
    }
}

impl Scoring {
    /// Whether every log leaves no more than was promised.
    pub fn as_promised(&self) -> bool {
        self.logs.iter().all(|log| log.as_promised(self))
    }
}

/// What the sensors did in the logs of the model.
struct Pattern {
    columns: Vec<usize>,
    /// Of each column, squares, K².
    scatter: DVector<f64>,
    /// (A + N)⁻¹ of all cycles.
    inverse: DMatrix<f64>,
    x_mean: DVector<f64>,
    effective: f64,
    /// Mean D² of each cycle by the others. Unit: 1.
    left_out: Vec<f64>,
    level: Level,
}

/// The temperature of whole logs, which their own zero takes out of the rows.
struct Level {
    mean_celsius: f64,
    /// Between the logs; infinite if one zero holds for all, K.
    scatter_k: f64,
    logs: f64,
}

impl Level {
    fn of<'a>(cycles: impl Iterator<Item = &'a Cycle>, zero: Zero) -> Self {
        let levels: Vec<f64> = cycles.map(level_celsius).collect();
        let (mean, logs) = (mean_of(&levels), levels.len() as f64);
        let squares: f64 = levels.iter().map(|l| (l - mean).powi(2)).sum();
        let scatter_k = match zero {
            Zero::Common => f64::INFINITY,
            _ => (squares / (logs - 1.0).max(1.0)).sqrt().max(LEAST_LEVEL_K),
        };
        Self { mean_celsius: mean, scatter_k, logs }
    }

    fn distance(&self, log: &Cycle) -> f64 {
        ((level_celsius(log) - self.mean_celsius) / self.scatter_k).powi(2)
    }

    fn limit_k(&self) -> f64 {
        let t = student_above(0.5 * BY_CHANCE, self.logs - 1.0);
        t * self.scatter_k * (1.0 + 1.0 / self.logs).sqrt()
    }
}

/// The mean of all sensors.
fn level_celsius(log: &Cycle) -> f64 {
    let means: Vec<f64> = log.temperatures_celsius.iter().map(|t| mean_of(t)).collect();
    mean_of(&means)
}

impl Pattern {
    fn of(logs: &Logs, design: &Design, model: &ThermalModel) -> Option<Self> {
        let used = |t: &Term| model.coefficients.iter().any(|c| c.term == *t);
        let columns: Vec<usize> = (0..design.terms.len())
            .filter(|j| design.terms[*j].lag_s.is_none() || used(&design.terms[*j]))
            .collect();
        let scatter = columns.iter().map(|j| {
            let celsius =
                |c: &Cycle| jitter_square(&c.temperatures_celsius[design.terms[*j].sensor]);
            let mean = logs.cycles.iter().map(celsius).sum::<f64>() / logs.cycles.len() as f64;
            mean.max(LEAST_K * LEAST_K)
        });
        let scatter = DVector::from_vec(scatter.collect());
        let (gram, x_mean) = design.second_moments(None, &columns);
        let inverse = inverse(&gram, &scatter)?;
        let mut left_out = Vec::new();
        for g in 0..logs.cycles.len() {
            let (others, mean) = design.second_moments(Some(g), &columns);
            let by_others = self::inverse(&others, &scatter)?;
            let rows = design.rows(g, &columns, &mean);
            left_out
                .push(mean_of(&rows.iter().map(|x| x.dot(&(&by_others * x))).collect::<Vec<_>>()));
        }
        let effective = (&gram * &inverse).trace();
        let level = Level::of(logs.cycles.iter(), logs.zero);
        Some(Self { columns, scatter, inverse, x_mean, effective, left_out, level })
    }

    fn distance(&self, x: &DVector<f64>) -> f64 {
        x.dot(&(&self.inverse * x))
    }

    /// Beyond these a row, and the mean of a log, is outside.
    ///
    /// A cycle that was left out is farther from the others than χ² says, because few cycles do not show
    /// all that the sensors can do: its median widens the limit of rows. Logs are compared with the cycles that
    /// were left out, by the logarithm (the prediction interval of one more).
    fn limits(&self) -> [f64; 2] {
        let count = self.left_out.len() as f64;
        let mut sorted = self.left_out.clone();
        sorted.sort_by(f64::total_cmp);
        let middle = sorted[sorted.len() / 2];
        let wider = (middle / self.effective).max(1.0);
        let logs: Vec<f64> = self.left_out.iter().map(|d| d.max(1e-9).ln()).collect();
        let mean = mean_of(&logs);
        let scatter = logs.iter().map(|l| (l - mean).powi(2)).sum::<f64>() / (count - 1.0);
        let t = student_above(BY_CHANCE, count - 1.0);
        let log = mean + t * (scatter * (1.0 + 1.0 / count)).sqrt();
        [wider * chi_square_above(BY_CHANCE, self.effective), log.exp()]
    }
}

/// What a row of a later log scatters by.
struct Spread {
    fit: Fit,
    cycles: f64,
    /// Of the coefficients of one cycle, mm²/K².
    of_one_cycle: DMatrix<f64>,
    /// The rest, mm².
    rest_mm2: f64,
    /// Where one zero holds for all logs, no row is surer than the mean of the cycles, mm²: a log may be off as a whole.
    least_mm2: f64,
}

impl Spread {
    /// From the residuals of the cycles as the others predict them: those of a later log are like them.
    fn of(logs: &Logs, design: &Design, model: &ThermalModel, pattern: &Pattern, fit: Fit) -> Self {
        let (count, cycles) = (model.coefficients.len(), logs.cycles.len() as f64);
        let u = |i: usize| model.coefficients[i].u_mm_per_k;
        let of_one_cycle =
            DMatrix::from_fn(count, count, |i, k| cycles * model.correlation[i][k] * u(i) * u(k));
        let mut spread = Self { fit, cycles, of_one_cycle, rest_mm2: 0.0, least_mm2: 0.0 };
        let (mut rests, mut all) = (Vec::new(), Vec::new());
        for (g, left) in model.score().by_cycle_mm.iter().enumerate() {
            let rows = design.rows(g, &spread.fit.subset, &spread.fit.x_mean);
            let slopes = mean_of(&rows.iter().map(|x| spread.of_slopes(x)).collect::<Vec<_>>());
            let others = logs.cycles.iter().enumerate().filter(|(o, _)| *o != g).map(|(_, c)| c);
            let level = Level::of(others, logs.zero).distance(&logs.cycles[g]);
            let by_distance = 1.0 + (pattern.left_out[g] + level) / (cycles - 1.0);
            rests.push((left * left - slopes) / by_distance);
            all.push(left * left / by_distance);
        }
        if logs.zero == Zero::Common {
            spread.least_mm2 = model.score().held_out_mm.powi(2);
        }
        spread.rest_mm2 = mean_of(&rests).max(LEAST_REST * mean_of(&all));
        spread
    }

    fn of_slopes(&self, x: &DVector<f64>) -> f64 {
        x.dot(&(&self.of_one_cycle * x))
    }

    fn variance(&self, x: &DVector<f64>, distance: f64) -> f64 {
        let variance = self.of_slopes(x) + self.rest_mm2 * (1.0 + distance / self.cycles);
        variance.max(self.least_mm2)
    }
}

fn inverse(gram: &DMatrix<f64>, scatter: &DVector<f64>) -> Option<DMatrix<f64>> {
    let mut gram = gram.clone();
    for (i, s) in scatter.iter().enumerate() {
        gram[(i, i)] += s;
    }
    gram.cholesky().map(|c| c.inverse())
}

fn mean_of(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

fn rms(values: impl Iterator<Item = f64>) -> f64 {
    let (sum, count) = values.fold((0.0, 0), |(sum, count), v| (sum + v * v, count + 1));
    (sum / f64::from(count.max(1))).sqrt()
}

/// Scores the later logs of a study with its model; `None` without later logs or with a model that is refused.
///
/// # Source
/// Prediction variance s²(1 + x(XᵀX)⁻¹xᵀ) of a regression (Draper and Smith, *Applied Regression Analysis*), with
/// whole cycles as the witnesses in place of rows; Mahalanobis 1936 for D². docs/model.md (271), (272).
pub fn score_thermal(logs: &Logs, model: &ThermalModel) -> Option<Scoring> {
    if logs.later.is_empty() || model.refusal.is_some() {
        return None;
    }
    let design = Design::new(logs);
    let pattern = Pattern::of(logs, &design, model)?;
    let fit = design.fit_of_terms(&model.score().terms);
    let spread = Spread::of(logs, &design, model, &pattern, fit);
    let degrees_of_freedom = logs.cycles.len() - 1;
    let coverage_factor = coverage_factor(degrees_of_freedom as f64);
    let promised_mm = model.score().held_out_mm;
    let [row_limit, log_limit] = pattern.limits();
    let mut scoring = Scoring {
        promised_mm,
        promised_u_mm: coverage_factor * promised_mm,
        coverage_factor,
        degrees_of_freedom,
        row_limit,
        log_limit,
        logs: Vec::new(),
    };
    let one = |later: &Cycle| scored(logs, &design, &pattern, &spread, later, &scoring);
    scoring.logs = logs.later.iter().map(one).collect();
    Some(scoring)
}

fn scored(
    logs: &Logs,
    design: &Design,
    pattern: &Pattern,
    spread: &Spread,
    later: &Cycle,
    scoring: &Scoring,
) -> ScoredLog {
    let sample = design.sample(later);
    let rows = sample.rows(&pattern.columns, &pattern.x_mean);
    let distances: Vec<f64> = rows.iter().map(|x| pattern.distance(x)).collect();
    let of_terms = sample.rows(&spread.fit.subset, &spread.fit.x_mean);
    let level = pattern.level.distance(later);
    let u = |(x, d): (&DVector<f64>, &f64)| {
        scoring.coverage_factor * spread.variance(x, d + level).sqrt()
    };
    let u_mm: Vec<f64> = of_terms.iter().zip(&distances).map(u).collect();
    let (measured_mm, predicted_mm) = (sample.measured(), sample.predict(&spread.fit));
    // A first row that is zero by definition is no reading.
    let first = usize::from(logs.zero == Zero::Start);
    let left = measured_mm.iter().zip(&predicted_mm).map(|(m, p)| m - p);
    let left: Vec<f64> = left.skip(first).collect();
    let rows_outside = distances.iter().filter(|d| **d > scoring.row_limit).count();
    let mean_distance = mean_of(&distances);
    let warmer_k = level_celsius(later) - pattern.level.mean_celsius;
    let warmer_limit_k = pattern.level.limit_k();
    let within = left.iter().zip(&u_mm[first..]).filter(|(l, u)| l.abs() <= **u).count();
    let mut combinations = Vec::new();
    if rows_outside > 0 {
        combinations = farthest(design, pattern, &rows, &distances);
    }
    ScoredLog {
        name: later.name.clone(),
        times_s: later.times_s.clone(),
        no_model_mm: rms(measured_mm.iter().copied().skip(first)),
        left_mm: rms(left.iter().copied()),
        largest_mm: left.iter().fold(0.0, |m, l| if l.abs() > f64::abs(m) { *l } else { m }),
        expected_u_mm: rms(u_mm[first..].iter().copied()),
        within: within as f64 / left.len() as f64,
        warmer_k,
        warmer_limit_k,
        outside: mean_distance > scoring.log_limit
            || warmer_k.abs() > warmer_limit_k
            || rows_outside as f64 > OUTSIDE_SHARE * distances.len() as f64,
        sensors: sensors_outside(logs, later),
        measured_mm,
        predicted_mm,
        u_mm,
        rows_outside,
        mean_distance,
        distances,
        combinations,
    }
}

/// The terms of the farthest row that are least where the other sensors say.
///
/// ```text
///     z_j − E(z_j | others) = (B x)_j/B_jj,   its variance 1/B_jj,   B = (A + N)⁻¹
/// ```
fn farthest(
    design: &Design,
    pattern: &Pattern,
    rows: &[DVector<f64>],
    distances: &[f64],
) -> Vec<Combination> {
    let by_distance = |a: &usize, b: &usize| distances[*a].total_cmp(&distances[*b]);
    let Some(row) = (0..rows.len()).max_by(by_distance) else { return Vec::new() };
    let (b, pulled) = (&pattern.inverse, &pattern.inverse * &rows[row]);
    let mut all: Vec<Combination> = (0..pattern.columns.len())
        .map(|j| Combination {
            term: design.terms[pattern.columns[j]],
            row,
            off_k: pulled[j] / b[(j, j)],
            usual_k: b[(j, j)].sqrt().recip().max(pattern.scatter[j].sqrt()),
        })
        .collect();
    let far = |c: &Combination| (c.off_k / c.usual_k).abs();
    all.sort_by(|a, b| far(b).total_cmp(&far(a)));
    all.retain(|c| far(c) > 2.0);
    all.truncate(2);
    all
}

/// Sensors that are colder, warmer, or moved farther from their zero than in the logs of the model.
fn sensors_outside(logs: &Logs, later: &Cycle) -> Vec<SensorOutside> {
    let range = |values: &[f64]| {
        values.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |r, v| [r[0].min(*v), r[1].max(*v)])
    };
    let moved = |values: &[f64]| {
        let zero = match logs.zero {
            Zero::Cycle => mean_of(values),
            Zero::Start => values[0],
            Zero::Common => 0.0,
        };
        range(values).map(|v| v - zero)
    };
    let joined = |of: &dyn Fn(&[f64]) -> [f64; 2], sensor: usize| {
        let all = logs.cycles.iter().map(|c| of(&c.temperatures_celsius[sensor]));
        all.fold([f64::INFINITY, f64::NEG_INFINITY], |r, v| [r[0].min(v[0]), r[1].max(v[1])])
    };
    let beyond = |here: [f64; 2], there: [f64; 2]| {
        let allowed = (BEYOND * (there[1] - there[0])).max(2.0 * LEAST_K);
        here[0] < there[0] - allowed || here[1] > there[1] + allowed
    };
    let all = (0..logs.sensors.len()).map(|sensor| SensorOutside {
        sensor,
        range_celsius: range(&later.temperatures_celsius[sensor]),
        logged_celsius: joined(&range, sensor),
        moved_k: moved(&later.temperatures_celsius[sensor]),
        logged_moved_k: joined(&moved, sensor),
    });
    all.filter(|s| beyond(s.range_celsius, s.logged_celsius) || beyond(s.moved_k, s.logged_moved_k))
        .collect()
}
