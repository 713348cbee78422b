//! A linear thermal model of one error from logs of displacement and temperatures.
//!
//! ```text
//!     d_gi = o_g + Σ k_j (T_j,gi − T_ref) + ε_gi      g: cycle, i: row        docs/model.md eq. 89
//! ```
//!
//! The rows of a cycle are no independent witnesses: neighbours are minutes apart and err together,
//! so a model that has seen a cycle knows its other rows as well. The quality of a model is shown by
//! whole cycles that it has not seen.
//!
//! ```text
//!     study.toml, CSV ──read_logs──> Logs                  all problems of the logs are named
//!     Logs ──Design──> columns of all terms, per cycle     lags; the zero of each cycle taken out
//!     Design, cycles but one ──best_subsets──> terms       for each number of terms, by least squares
//!     the cycle left out ──> its score                     the search is repeated without each cycle
//!     scores ──one standard error──> number of terms       or none: refusal
//!     later logs ──score_thermal──> what was promised, what remains, what the sensors did not do before
//! ```

mod check;
mod design;
mod score;
mod study;
mod subsets;

pub use design::lagged;
pub use score::{Combination, ScoredLog, Scoring, SensorOutside, score_thermal};
pub use study::{Later, Tables, parse_logs, read_logs, read_logs_and};

use design::{Design, Fit};
use nalgebra::DMatrix;
use subsets::best_subsets;
use trueaxis_geometry::statistics::coverage_factor;

/// Fewer cycles say nothing about a cycle that comes next.
pub const FEWEST_CYCLES: usize = 3;
/// Less than this is rounding, mm.
const NOTHING_MM: f64 = 1e-12;
/// From here on two coefficients are not usable without the correlation of both.
const CORRELATED: f64 = 0.5;

/// What is free in every cycle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Zero {
    /// The zero of the probe is unknown in each cycle: an intercept per cycle.
    Cycle,
    /// The first reading of each cycle is the zero: all are differences to it.
    Start,
    /// One zero for all cycles: the probe was never reset.
    Common,
}

impl Zero {
    /// All three with their names in studies.
    pub const ALL: [(Self, &'static str); 3] =
        [(Self::Cycle, "cycle"), (Self::Start, "start"), (Self::Common, "common")];

    /// Its name in studies.
    pub fn name(self) -> &'static str {
        Self::ALL[self as usize].1
    }
}

/// One log from a start to its end: a warm-up, a day.
#[derive(Debug, Clone, PartialEq)]
pub struct Cycle {
    /// The file, or the file and the value of the cycle column.
    pub name: String,
    /// When each row was taken, if that is known, s.
    pub times_s: Option<Vec<f64>>,
    /// The measured displacement, mm.
    pub displacement_mm: Vec<f64>,
    /// What each sensor said, °C.
    pub temperatures_celsius: Vec<Vec<f64>>,
}

/// The logs of a study and what is asked of them.
#[derive(Debug, Clone, PartialEq)]
pub struct Logs {
    /// What is measured.
    pub name: String,
    /// The error of the machine file that the displacement stands for, or a free name.
    pub error: String,
    /// The candidate sensors.
    pub sensors: Vec<String>,
    /// The cycles.
    pub cycles: Vec<Cycle>,
    /// Logs that came later: the model has not seen them and is scored with them.
    pub later: Vec<Cycle>,
    /// What is free in every cycle.
    pub zero: Zero,
    /// Candidate time constants of first-order lags, s.
    pub lags_s: Vec<f64>,
    /// No model has more terms.
    pub most_terms: usize,
    /// Where the model is zero, for the machine file, °C.
    pub reference_celsius: f64,
    /// The stated standard uncertainty of one reading, mm.
    pub repeatability_mm: Option<f64>,
}

/// A candidate: a sensor, or what it said a while ago.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Term {
    /// Its place among the sensors.
    pub sensor: usize,
    /// The time constant of the lag, s.
    pub lag_s: Option<f64>,
}

impl Term {
    /// `spindle_front`, `spindle_front after 10 min`.
    pub fn name(&self, logs: &Logs) -> String {
        let sensor = &logs.sensors[self.sensor];
        match self.lag_s {
            None => sensor.clone(),
            Some(s) if s < 120.0 => format!("{sensor} after {s} s"),
            Some(s) => format!("{sensor} after {} min", s / 60.0),
        }
    }
}

/// How well a number of terms does.
#[derive(Debug, Clone, PartialEq)]
pub struct Score {
    /// Those that fit all cycles best.
    pub terms: Vec<Term>,
    /// On the rows that the coefficients come from, rms, mm.
    pub in_sample_mm: f64,
    /// What leaving out single rows claims, rms, mm.
    pub row_wise_mm: f64,
    /// On whole cycles that neither the choice of the sensors nor the coefficients had seen, rms, mm.
    pub held_out_mm: f64,
    /// The standard error of its square, mm².
    pub u_held_out_mm2: f64,
    /// The same for each cycle, rms, mm.
    pub by_cycle_mm: Vec<f64>,
    /// Without how many of the cycles the same terms were chosen.
    pub chosen_again: usize,
    /// Condition number of the columns at equal length. Unit: 1.
    pub condition: f64,
}

/// A coefficient of the chosen model.
#[derive(Debug, Clone, PartialEq)]
pub struct Coefficient {
    /// Of which term.
    pub term: Term,
    /// mm/K.
    pub mm_per_k: f64,
    /// Its standard uncertainty from what the coefficients do without each cycle, mm/K.
    pub u_mm_per_k: f64,
    /// The lowest and highest temperature of the term in the logs, °C.
    pub range_celsius: [f64; 2],
}

/// What was found.
#[derive(Debug, Clone, PartialEq)]
pub struct ThermalModel {
    /// By number of terms, from none.
    pub scores: Vec<Score>,
    /// All terms at once, for comparison: over-fitted.
    pub all_terms: Score,
    /// The number of terms by the rule of one standard error.
    pub chosen: usize,
    /// Why there is no model, in words.
    pub refusal: Option<String>,
    /// The coefficients of the chosen number of terms, also if they are refused.
    pub coefficients: Vec<Coefficient>,
    /// Between the coefficients, row by row. Unit: 1.
    pub correlation: Vec<Vec<f64>>,
    /// The displacement at which all sensors read the reference temperature, if one zero holds for all, mm.
    pub intercept_mm: Option<f64>,
    /// Held out, counted from the first row of each cycle: if the zero is set at its start, rms, mm.
    pub since_start_mm: f64,
    /// Of one reading, mm.
    pub repeatability_mm: f64,
    /// Whether the study says so; else it is estimated from neighbouring readings.
    pub repeatability_stated: bool,
    /// Per cycle and row: measured, less the zero of the cycle, mm.
    pub measured_mm: Vec<Vec<f64>>,
    /// Per cycle and row: by the chosen model of the other cycles, mm.
    pub predicted_mm: Vec<Vec<f64>>,
    /// What the reader should know.
    pub warnings: Vec<String>,
}

impl ThermalModel {
    /// The score of the chosen number of terms.
    pub fn score(&self) -> &Score {
        &self.scores[self.chosen]
    }

    /// The share of the mean square displacement of unseen cycles that the model takes away.
    pub fn explained(&self) -> f64 {
        1.0 - (self.score().held_out_mm / self.scores[0].held_out_mm).powi(2)
    }
}

/// Fits models of 0, 1, 2 … terms, scores each on whole cycles that it has not seen, and chooses.
///
/// With G cycles: for every g the best terms and their coefficients are searched without g, and
///
/// ```text
///     s_g = mean over its rows of (measured − predicted)²    S = mean s_g         docs/model.md eq. 92
///     u(S) = standard deviation of the s_g / √G
/// ```
///
/// The fewest terms with S ≤ min S + u(min S) are chosen (one standard error).
///
/// # Source
/// Stone 1974 (cross-validation), Breiman et al. 1984 (one standard error); groups left out as a
/// whole because rows within one are dependent.
pub fn identify_thermal(logs: &Logs) -> ThermalModel {
    let design = Design::new(logs);
    let everything = design.train(None);
    let most = logs.most_terms.min(design.terms.len()).min(logs.cycles.len().saturating_sub(2));
    let most = most.max(1);
    let subsets = best_subsets(&everything, most);
    let by_cycle: Vec<_> = (0..logs.cycles.len())
        .map(|g| {
            let others = design.train(Some(g));
            let subsets = best_subsets(&others, most);
            (others, subsets)
        })
        .collect();
    let mut scores = Vec::new();
    for (size, subset) in subsets.iter().enumerate() {
        let fits: Option<Vec<_>> =
            by_cycle.iter().map(|(others, found)| found.get(size).map(|s| others.fit(s))).collect();
        // Without some cycle fewer terms are separable: no score, no candidate.
        let Some(fits) = fits else { break };
        scores.push(score(&design, &everything.fit(subset), &fits));
    }
    let all: Vec<usize> = everything.moving();
    let fits: Vec<_> = by_cycle.iter().map(|(others, _)| others.fit(&all)).collect();
    let all_terms = score(&design, &everything.fit(&all), &fits);
    let chosen = fewest_within_one_error(&scores);
    let fit = everything.fit(&subsets[chosen]);
    let fits: Vec<_> = by_cycle.iter().map(|(o, found)| o.fit(&found[chosen])).collect();
    let same: Vec<_> = by_cycle.iter().map(|(others, _)| others.fit(&fit.subset)).collect();
    let (coefficients, correlation) = coefficients(&design, &fit, &same);
    let predicted_mm: Vec<Vec<f64>> =
        fits.iter().enumerate().map(|(g, fit)| design.predict(g, fit)).collect();
    let repeatability = logs.repeatability_mm;
    let mut model = ThermalModel {
        chosen,
        refusal: None,
        since_start_mm: since_start(&design, &predicted_mm),
        measured_mm: (0..fits.len()).map(|g| design.measured(g)).collect(),
        intercept_mm: (logs.zero == Zero::Common)
            .then(|| design.intercept(&fit, logs.reference_celsius)),
        repeatability_mm: repeatability.unwrap_or_else(|| estimated_repeatability(logs)),
        repeatability_stated: repeatability.is_some(),
        warnings: Vec::new(),
        scores,
        all_terms,
        coefficients,
        correlation,
        predicted_mm,
    };
    model.refusal = refusal(logs, &model);
    model.warnings = warnings(logs, &design, &model);
    model
}

/// The three scores of one set of terms; `fits` are without each cycle.
fn score(design: &Design, fit: &Fit, fits: &[Fit]) -> Score {
    let squares: Vec<f64> =
        fits.iter().enumerate().map(|(g, fit)| mean_square(&design.residuals(g, fit))).collect();
    let count = squares.len() as f64;
    let mean = squares.iter().sum::<f64>() / count;
    let scatter = squares.iter().map(|s| (s - mean).powi(2)).sum::<f64>() / (count - 1.0);
    let root_of_mean =
        |of: &dyn Fn(usize) -> f64| ((0..fits.len()).map(of).sum::<f64>() / count).sqrt();
    Score {
        terms: fit.subset.iter().map(|j| design.terms[*j]).collect(),
        in_sample_mm: root_of_mean(&|g| mean_square(&design.residuals(g, fit))),
        row_wise_mm: root_of_mean(&|g| mean_square(&design.row_wise_residuals(g, fit))),
        held_out_mm: mean.sqrt(),
        u_held_out_mm2: (scatter / count).sqrt(),
        by_cycle_mm: squares.iter().map(|s| s.sqrt()).collect(),
        chosen_again: fits.iter().filter(|f| f.subset == fit.subset).count(),
        condition: fit.condition,
    }
}

fn mean_square(values: &[f64]) -> f64 {
    values.iter().map(|v| v * v).sum::<f64>() / values.len() as f64
}

fn fewest_within_one_error(scores: &[Score]) -> usize {
    let square = |s: &Score| s.held_out_mm.powi(2);
    let best = scores.iter().min_by(|a, b| a.held_out_mm.total_cmp(&b.held_out_mm));
    let limit = best.map_or(0.0, |b| square(b) + b.u_held_out_mm2);
    // Among models that leave nothing but rounding, too, the fewest terms.
    scores.iter().position(|s| square(s) <= limit.max(NOTHING_MM * NOTHING_MM)).unwrap_or(0)
}

/// The coefficients with their jackknife over whole cycles.
///
/// ```text
///     V = (G − 1)/G Σ_g (k₍g₎ − k)(k₍g₎ − k)ᵀ                                   docs/model.md eq. 94
/// ```
///
/// k₍g₎ are the coefficients of the same terms without cycle g; no assumption about what happens
/// within a cycle is made.
///
/// # Source
/// Bell & McCaffrey 2002 and MacKinnon, Nielsen & Webb 2023 (CV3): with few clusters nearer to the
/// truth than the sandwich of Liang & Zeger 1986, which is too small then.
fn coefficients(design: &Design, fit: &Fit, fits: &[Fit]) -> (Vec<Coefficient>, Vec<Vec<f64>>) {
    let (count, cycles) = (fit.subset.len(), fits.len() as f64);
    let mut covariance = DMatrix::<f64>::zeros(count, count);
    for other in fits {
        let moved = &other.mm_per_k - &fit.mm_per_k;
        covariance += &moved * moved.transpose() * ((cycles - 1.0) / cycles);
    }
    let u = |i: usize| covariance[(i, i)].sqrt();
    let correlation = |i: usize, k: usize| match u(i) * u(k) {
        _ if i == k => 1.0,
        product if product > 0.0 => covariance[(i, k)] / product,
        _ => 0.0,
    };
    let found = fit.subset.iter().enumerate().map(|(i, j)| Coefficient {
        term: design.terms[*j],
        mm_per_k: fit.mm_per_k[i],
        u_mm_per_k: u(i),
        range_celsius: design.range_celsius(*j),
    });
    let rows = (0..count).map(|i| (0..count).map(|k| correlation(i, k)).collect());
    (found.collect(), rows.collect())
}

/// Of residuals less that of the first row.
fn since_start(design: &Design, predicted_mm: &[Vec<f64>]) -> f64 {
    let squares = predicted_mm.iter().enumerate().map(|(g, predicted)| {
        let measured = design.measured(g);
        let left: Vec<f64> = measured.iter().zip(predicted).map(|(m, p)| m - p).collect();
        let first = left[0];
        mean_square(&left.iter().map(|r| r - first).collect::<Vec<_>>())
    });
    (squares.sum::<f64>() / predicted_mm.len() as f64).sqrt()
}

/// Of one reading, from second differences, which a slow drift does not reach.
///
/// ```text
///     s² = median over the cycles of mean (d_i−1 − 2 d_i + d_i+1)² / 6            docs/model.md eq. 95
/// ```
fn estimated_repeatability(logs: &Logs) -> f64 {
    let mut squares: Vec<f64> =
        logs.cycles.iter().map(|c| jitter_square(&c.displacement_mm)).collect();
    squares.sort_by(f64::total_cmp);
    squares.get(squares.len() / 2).copied().unwrap_or(0.0).sqrt()
}

/// The square of the scatter of single readings about their neighbours.
fn jitter_square(values: &[f64]) -> f64 {
    let second: Vec<f64> = values.windows(3).map(|w| w[0] - 2.0 * w[1] + w[2]).collect();
    if second.is_empty() { 0.0 } else { mean_square(&second) / 6.0 }
}

/// Why the chosen model must not be used.
fn refusal(logs: &Logs, model: &ThermalModel) -> Option<String> {
    let (cycles, um) = (logs.cycles.len(), |mm: f64| mm * 1e3);
    if cycles < FEWEST_CYCLES {
        return Some(format!(
            "{cycles} cycles cannot separate a model from chance: what fits one is judged by one other; \
             measure {FEWEST_CYCLES} or more, at different speeds and on different days"
        ));
    }
    let none = &model.scores[0];
    if model.chosen == 0 {
        let best = model.scores.iter().skip(1).map(|s| s.held_out_mm).fold(f64::INFINITY, f64::min);
        let (best, none) = match best.is_finite() {
            true => (format!("{:.2} µm", um(best)), um(none.held_out_mm)),
            false => ("no sensor that moves".to_owned(), um(none.held_out_mm)),
        };
        return Some(format!(
            "no sensor predicts a held-out cycle by more than chance: {none:.2} µm \
             without a model, at best {best} with one"
        ));
    }
    // As ratios: a cycle that drifts far would otherwise outweigh all others.
    let ratios = none.by_cycle_mm.iter().zip(&model.score().by_cycle_mm);
    let ratios: Vec<f64> = ratios
        .map(|(none, with)| 2.0 * (with.max(NOTHING_MM) / none.max(NOTHING_MM)).ln())
        .collect();
    let mean = ratios.iter().sum::<f64>() / cycles as f64;
    let scatter = ratios.iter().map(|r| (r - mean).powi(2)).sum::<f64>() / (cycles - 1) as f64;
    let doubt = coverage_factor((cycles - 1) as f64) * (scatter / cycles as f64).sqrt();
    (mean + doubt >= 0.0).then(|| {
        format!(
            "what the model leaves of the mean square drift of a cycle that it has not seen is {:.0} %, \
             but it may be {:.0} %: not significant; more cycles may show more",
            mean.exp() * 100.0,
            (mean + doubt).exp() * 100.0
        )
    })
}

fn warnings(logs: &Logs, design: &Design, model: &ThermalModel) -> Vec<String> {
    let mut warnings = Vec::new();
    for (a, b) in design.twins() {
        warnings.push(format!(
            "`{}` and `{}` move together in all cycles: one of them stands for both, and the logs \
             cannot show which",
            a.name(logs),
            b.name(logs)
        ));
    }
    let score = model.score();
    if model.chosen > 0 && 2 * score.chosen_again < logs.cycles.len() {
        warnings.push(format!(
            "the choice of the sensors hangs on single cycles: the same ones were found without only \
             {} of {} cycles",
            score.chosen_again,
            logs.cycles.len()
        ));
    }
    let sure = coverage_factor((logs.cycles.len() - 1) as f64);
    for c in model.coefficients.iter().filter(|c| c.mm_per_k.abs() < sure * c.u_mm_per_k) {
        let name = c.term.name(logs);
        warnings.push(format!("the coefficient of `{name}` is hardly surer than its sign"));
    }
    let pairs = (0..model.coefficients.len()).flat_map(|i| (0..i).map(move |k| (k, i)));
    let strength = |(k, i): &(usize, usize)| model.correlation[*i][*k].abs();
    let strongest = pairs.max_by(|a, b| strength(a).total_cmp(&strength(b)));
    if let Some((k, i)) = strongest.filter(|pair| strength(pair) > CORRELATED) {
        warnings.push(format!(
            "the coefficients are correlated ({:.2} between `{}` and `{}`); the machine file takes them \
             as independent, so there u of their sum is not that of this model",
            model.correlation[i][k],
            model.coefficients[k].term.name(logs),
            model.coefficients[i].term.name(logs)
        ));
    }
    let below = model.score().held_out_mm < 0.7 * model.repeatability_mm;
    if below && model.repeatability_stated {
        let message = "less is left than the stated repeatability: that is stated too large";
        warnings.push(message.to_owned());
    }
    warnings
}
