//! Comparison of readings with a machine file, or with other readings.
//!
//! ```text
//!     verify.toml ──read_comparison──> Comparison {campaign, measured, against, decision}
//!                 ──compare──> Verified {deviations with U, coverage, places, verdict}
//! ```
//!
//! ```text
//!     r = y − f(machine file, x̂)      x̂ the set-up that fits best               docs/model.md eq. 117
//!     u² = u_noise² − j C jᵀ + Σ_e (s_e − j C JᵀW S_e)²         E_n = |r|/(k u)
//! ```
//!
//! The set-up of an instrument is not known to a micrometre, so it is fitted on both sides; the uncertainty
//! of the residuals is reduced accordingly.

mod file;
mod pairs;

pub use file::read_comparison;
pub use pairs::{Pairs, pair};
pub use trueaxis_measure::unknowns::set_up::SetUpDeviation;
use trueaxis_measure::unknowns::set_up::deviations;

use nalgebra::DMatrix;
use std::collections::BTreeMap;
use trueaxis_machine::Machine;
use trueaxis_measure::measure::Campaign;
use trueaxis_measure::measure::Instrument;
use trueaxis_measure::measure::Readings;
use trueaxis_measure::unknowns::design::Design;
use trueaxis_measure::unknowns::fit::FitError;
use trueaxis_measure::unknowns::fit::fit;
use trueaxis_measure::unknowns::stated::Stated;
use trueaxis_part::tolerance::Outcome;

/// Quantile of the normal distribution for 95 %, two-sided.
const NORMAL_95: f64 = 1.959_963_985;

/// So many numbers beyond those that the fitted set-up takes compare something. Unit: 1.
pub const LEAST_REDUNDANCY: f64 = 0.5;
/// Of a number of which the fitted set-up leaves less than this part, nothing is compared. Unit: 1.
const ABSORBED: f64 = 1e-6;

/// A comparison to be made.
#[derive(Debug, Clone)]
pub struct Comparison {
    /// Its name.
    pub name: String,
    /// The instruments, and the machine of the machine file.
    pub campaign: Campaign,
    /// What was measured.
    pub measured: Readings,
    /// The reference.
    pub against: ComparisonBasis,
    /// The decision rule with its figures.
    pub decision: Decision,
}

/// The reference that readings are compared with.
#[derive(Debug, Clone)]
pub enum ComparisonBasis {
    /// The readings that this machine predicts.
    Prediction(Box<Machine>),
    /// Other readings of the same places, as differences: the places of the second set, less the
    /// first.
    Readings(Box<Pairs>),
}

/// The decision rule with its figures.
#[derive(Debug, Clone, PartialEq)]
pub struct Decision {
    /// The rule.
    pub rule: Rule,
    /// k in U = k·u. Unit: 1.
    pub coverage_factor: f64,
    /// The largest deviation that is allowed, per instrument. Unit: mm or rad.
    pub tolerance: Vec<Option<f64>>,
}

/// The decision rule.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Rule {
    /// |r| ≤ tolerance.
    Simple,
    /// ISO 14253-1: |r| + U ≤ tolerance passes, |r| − U > tolerance fails.
    GuardBand,
    /// Not significantly fewer readings lie within U than should.
    Coverage,
}

/// One number of one reading against the expected one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Deviation {
    /// The row of the readings.
    pub row: usize,
    /// The channel.
    pub channel: usize,
    /// Measured less expected. Unit: mm or rad.
    pub value: f64,
    /// U = k·u. Unit: mm or rad.
    pub expanded: f64,
    /// What the fitted set-up leaves of it: 1 of a number that it does not depend on, 0 of one that it is made of.
    /// Unit: 1.
    pub redundancy: f64,
}

impl Deviation {
    /// |r|/U.
    pub fn normalised(&self) -> f64 {
        match (self.value, self.expanded > 0.0) {
            (_, true) => self.value.abs() / self.expanded,
            (0.0, _) => 0.0,
            _ => f64::INFINITY,
        }
    }
}

/// A share of readings with its 95 % interval.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Coverage {
    /// How many numbers.
    pub count: usize,
    /// How many of them lie within U.
    pub inside: usize,
    /// The equivalent number of independent ones: errors of the machine change many readings at once. Unit: 1.
    pub independent: f64,
    /// The expected share. Unit: 1.
    pub expected: f64,
    /// Where the true share lies, by Wilson's interval for the independent numbers. Unit: 1.
    pub interval: [f64; 2],
}

impl Coverage {
    /// The share.
    pub fn share(&self) -> f64 {
        self.inside as f64 / self.count.max(1) as f64
    }

    /// Whether not significantly fewer lie within U than should.
    pub fn is_enough(&self) -> bool {
        self.interval[1] >= self.expected
    }
}

/// The deviations of one instrument or one place.
#[derive(Debug, Clone, PartialEq)]
pub struct Summary {
    /// Which instrument or group.
    pub index: u32,
    /// How many numbers.
    pub count: usize,
    /// Root mean square with the nominal machine; of two sets of readings none. Unit: mm or rad.
    pub rms_before: Option<f64>,
    /// The same with the machine file, or between both sets. Unit: mm or rad.
    pub rms_after: f64,
    /// Largest |r|/U. Unit: 1.
    pub worst: f64,
    /// The share within U.
    pub coverage: Coverage,
}

/// A place with its instrument.
#[derive(Debug, Clone, PartialEq)]
pub struct PlaceSummary {
    /// The instrument.
    pub instrument: u32,
    /// A row of that place.
    pub row: usize,
    /// Its figures; `index` is the group.
    pub part: Summary,
}

/// The result of a comparison.
#[derive(Debug, Clone)]
pub struct ComparisonResult {
    /// The rows that were compared.
    pub readings: Readings,
    /// Row after row, channel after channel.
    pub deviations: Vec<Deviation>,
    /// All of them.
    pub coverage: Coverage,
    /// By instrument.
    pub instruments: Vec<Summary>,
    /// By place, the worst first.
    pub places: Vec<PlaceSummary>,
    /// How many numbers pass, fail, or are undecided.
    pub counts: [usize; 3],
    /// What the readings make of what is stated of the set-up.
    pub set_up: Vec<SetUpDeviation>,
    /// How many numbers are left to compare when the set-up is fitted. Unit: 1.
    pub redundancy: f64,
    /// The verdict.
    pub outcome: Outcome,
}

/// Compares the readings with their reference.
///
/// # Errors
/// No readings, readings outside the tables of the machine, readings of another set-up.
pub fn compare(task: &Comparison) -> Result<ComparisonResult, FitError> {
    let k = task.decision.coverage_factor;
    let (readings, after, before, spread) = match &task.against {
        ComparisonBasis::Prediction(machine) => {
            let instruments = &task.campaign.instruments;
            let after = Fitted::new(machine, instruments, &task.measured)?;
            let before = Fitted::new(&nominal(machine), instruments, &task.measured)?;
            let spread = after.spread(machine, &task.measured);
            (&task.measured, after, Some(before), spread)
        }
        ComparisonBasis::Readings(pairs) => {
            let machine = nominal(&task.campaign.machine);
            // Both sets have noise, and each its own set-up.
            let doubled: Vec<Instrument> = task.campaign.instruments.iter().map(twice).collect();
            let after = Fitted::new(&machine, &doubled, &pairs.differences)?;
            let spread = after.spread(&machine, &pairs.differences);
            (&pairs.differences, after, None, spread)
        }
    };
    let mut deviations = Vec::new();
    for (row, (residual, u)) in after.residuals.iter().zip(&spread.u).enumerate() {
        let of = readings.instruments[row] as usize;
        for channel in 0..task.campaign.instruments[of].sight.channels() {
            let (value, expanded) = (residual[channel], k * u[channel]);
            let redundancy = spread.redundancy[row][channel];
            deviations.push(Deviation { row, channel, value, expanded, redundancy });
        }
    }
    let before = before.map(|b| b.residuals);
    let (independent, before) = (spread.independent, before.as_deref());
    let judged = Judged { k, independent, before, set_up: spread.set_up };
    Ok(ComparisonResult::new(task, readings.clone(), deviations, &judged))
}

/// The basis on which all summaries are evaluated.
struct Judged<'a> {
    k: f64,
    /// The equivalent share of independent numbers.
    independent: f64,
    /// Residuals with the nominal machine.
    before: Option<&'a [[f64; 3]]>,
    set_up: Vec<SetUpDeviation>,
}

impl ComparisonResult {
    fn new(
        task: &Comparison,
        readings: Readings,
        deviations: Vec<Deviation>,
        judged: &Judged<'_>,
    ) -> Self {
        let mut by_instrument: BTreeMap<u32, Vec<Deviation>> = BTreeMap::new();
        let mut by_place: BTreeMap<(u32, u32), Vec<Deviation>> = BTreeMap::new();
        for deviation in &deviations {
            let of = readings.instruments[deviation.row];
            by_instrument.entry(of).or_default().push(*deviation);
            by_place.entry((of, readings.groups[deviation.row])).or_default().push(*deviation);
        }
        let instruments: Vec<Summary> =
            by_instrument.iter().map(|(of, some)| part(*of, some, judged)).collect();
        let mut places: Vec<PlaceSummary> = by_place
            .iter()
            .filter_map(|((of, group), some)| {
                let part = part(*group, some, judged);
                Some(PlaceSummary { instrument: *of, row: some.first()?.row, part })
            })
            .collect();
        places.sort_by(|a, b| b.part.worst.total_cmp(&a.part.worst));
        let coverage = coverage(&deviations, judged);
        let mut counts = [0; 3];
        for deviation in &deviations {
            let of = readings.instruments[deviation.row] as usize;
            let judged = judge(&task.decision, of, deviation);
            counts[match judged {
                Outcome::Pass => 0,
                Outcome::Fail => 1,
                Outcome::Undecided => 2,
            }] += 1;
        }
        let set_up = judged.set_up.clone();
        let redundancy: f64 = deviations.iter().map(|d| d.redundancy).sum();
        let outcome = match (task.decision.rule, counts) {
            _ if deviations.is_empty() => Outcome::Undecided,
            // What agrees only with another set-up than the stated one does not agree.
            _ if set_up.iter().any(SetUpDeviation::is_contradicted) => Outcome::Fail,
            // Numbers that the set-up was fitted to agree with any machine.
            _ if redundancy < LEAST_REDUNDANCY => Outcome::Undecided,
            (Rule::Coverage, _) if coverage.is_enough() => Outcome::Pass,
            (Rule::Coverage, _) => Outcome::Fail,
            (_, [_, 0, 0]) => Outcome::Pass,
            (_, [_, 0, _]) => Outcome::Undecided,
            _ => Outcome::Fail,
        };
        Self {
            readings,
            deviations,
            coverage,
            instruments,
            places,
            counts,
            set_up,
            redundancy,
            outcome,
        }
    }
}

fn judge(decision: &Decision, of: usize, deviation: &Deviation) -> Outcome {
    let (size, expanded) = (deviation.value.abs(), deviation.expanded);
    let tolerance = decision.tolerance.get(of).copied().flatten();
    if deviation.redundancy < ABSORBED {
        return Outcome::Undecided;
    }
    match (decision.rule, tolerance) {
        (Rule::Simple, Some(t)) if size <= t => Outcome::Pass,
        (Rule::GuardBand, Some(t)) if size + expanded <= t => Outcome::Pass,
        (Rule::GuardBand, Some(t)) if size - expanded <= t => Outcome::Undecided,
        (Rule::Simple | Rule::GuardBand, Some(_)) => Outcome::Fail,
        _ if size <= expanded => Outcome::Pass,
        _ => Outcome::Fail,
    }
}

fn part(index: u32, some: &[Deviation], judged: &Judged<'_>) -> Summary {
    let mean = |square: &dyn Fn(&Deviation) -> f64| {
        (some.iter().map(square).sum::<f64>() / some.len().max(1) as f64).sqrt()
    };
    Summary {
        index,
        count: some.len(),
        rms_before: judged.before.map(|b| mean(&|d| b[d.row][d.channel].powi(2))),
        rms_after: mean(&|d| d.value * d.value),
        worst: some.iter().map(Deviation::normalised).fold(0.0, f64::max),
        coverage: coverage(some, judged),
    }
}

/// Wilson's interval for the share within U; the share to expect of a normal distribution.
///
/// *Source:* Wilson 1927, J. Am. Stat. Assoc. 22, 209–212.
fn coverage(some: &[Deviation], judged: &Judged<'_>) -> Coverage {
    let inside = some.iter().filter(|d| d.value.abs() <= d.expanded).count();
    let p = inside as f64 / some.len().max(1) as f64;
    let n = (some.len() as f64 * judged.independent).max(1.0);
    let z2 = NORMAL_95 * NORMAL_95;
    let middle = (p + z2 / (2.0 * n)) / (1.0 + z2 / n);
    let half = NORMAL_95 / (1.0 + z2 / n) * (p * (1.0 - p) / n + z2 / (4.0 * n * n)).sqrt();
    let interval = [(middle - half).max(0.0), (middle + half).min(1.0)];
    let expected = normal_share(judged.k);
    Coverage { count: some.len(), inside, independent: n, expected, interval }
}

/// The share of a normal distribution within ±k standard deviations: erf(k/√2).
fn normal_share(k: f64) -> f64 {
    if k > 8.0 {
        return 1.0;
    }
    // φ(k) · 2 Σ k^(2n+1)/(1·3·5…(2n+1)): all terms are positive.
    let (mut term, mut sum, mut n) = (k, k, 1.0);
    while term > 1e-17 * sum {
        n += 2.0;
        term *= k * k / n;
        sum += term;
    }
    sum * (2.0 / std::f64::consts::PI).sqrt() * (-0.5 * k * k).exp()
}

/// The machine without errors.
fn nominal(machine: &Machine) -> Machine {
    let bare = machine.without_heat();
    let stated = bare.stated_errors();
    stated.iter().fold(bare, |m, (index, _)| m.with_error(*index, None))
}

/// The difference of two readings: √2 as uncertain.
fn twice(instrument: &Instrument) -> Instrument {
    let mut twice = instrument.clone();
    let root = std::f64::consts::SQRT_2;
    twice.noise = twice.noise.map(|u| u * root);
    for unknown in &mut twice.unknowns {
        unknown.prior_u = unknown.prior_u.map(|u| u * root);
    }
    twice
}

/// Readings minus the prediction of a machine with the best-fitting set-up.
struct Fitted {
    residuals: Vec<[f64; 3]>,
    /// The set-up.
    values: Vec<f64>,
    /// Of the set-up.
    covariance: DMatrix<f64>,
    instruments: Vec<Instrument>,
}

impl Fitted {
    fn new(
        machine: &Machine,
        instruments: &[Instrument],
        readings: &Readings,
    ) -> Result<Self, FitError> {
        let design = Design::new(machine, Vec::new(), instruments.to_vec());
        let design = design.from_first_readings(readings);
        let instruments = design.instruments.clone();
        if design.unknowns() > 0 {
            let found = fit(&design, readings, &[])?;
            let (residuals, values) = (found.residuals, found.values);
            return Ok(Self { residuals, values, covariance: found.covariance, instruments });
        }
        if readings.is_empty() {
            return Err(FitError::NoReadings);
        }
        let residual = |row: usize| {
            let outside = |fault| FitError::Outside { row, fault };
            let read = design.read(readings, row, &[]).map_err(outside)?;
            Ok(std::array::from_fn(|c| readings.values[row][c] - read[c]))
        };
        let residuals: Result<Vec<[f64; 3]>, FitError> =
            (0..readings.len()).map(residual).collect();
        let (values, covariance) = (Vec::new(), DMatrix::zeros(0, 0));
        Ok(Self { residuals: residuals?, values, covariance, instruments })
    }

    /// The standard uncertainty of every residual: noise, and the stated errors of the machine,
    /// each reduced by the part that the fitted set-up absorbs.
    fn spread(&self, machine: &Machine, readings: &Readings) -> Spread {
        let design = Design::new(machine, Vec::new(), self.instruments.clone());
        let stated = Stated::of(&design, readings);
        // The effect of each uncertain quantity on the fitted set-up.
        let taken = &self.covariance * stated.pull(readings, &[]);
        let mut found = vec![[0.0; 3]; readings.len()];
        let mut redundancy = vec![[1.0; 3]; readings.len()];
        let q = stated.names().len();
        // GᵀG of the shares g = s/u of the quantities, and Σ|g|⁴: Σ ρ² over all pairs of numbers.
        let (mut gram, mut own, mut count) = (DMatrix::<f64>::zeros(q, q), 0.0, 0.0);
        for (row, found) in found.iter_mut().enumerate() {
            let noise = self.instruments[readings.instruments[row] as usize].noise;
            for (c, number) in stated.effects(readings, row).iter().enumerate() {
                let fitted = number.slopes.dot(&(&self.covariance * &number.slopes));
                let left = &number.stated - taken.tr_mul(&number.slopes);
                // What is used up by the fit cannot be more than there is.
                let (all, noise) = (noise[c] * noise[c], (noise[c] * noise[c] - fitted).max(0.0));
                redundancy[row][c] = if all > 0.0 { noise / all } else { 1.0 };
                found[c] = (noise + left.norm_squared()).sqrt();
                let share = if found[c] > 0.0 { left / found[c] } else { left };
                gram.ger(1.0, &share, &share, 1.0);
                own += share.norm_squared().powi(2);
                count += 1.0;
            }
        }
        let pairs = (gram.norm_squared() - own).max(0.0);
        let further = |k: usize| taken.row(k).norm_squared();
        let set_up = deviations(&self.instruments, &self.values, &self.covariance, further);
        let independent = 1.0 / (1.0 + pairs / f64::max(count, 1.0));
        Spread { u: found, redundancy, independent, set_up }
    }
}

/// The uncertainty of residuals.
struct Spread {
    /// Of each, mm or rad.
    u: Vec<[f64; 3]>,
    /// What the set-up leaves of each. Unit: 1.
    redundancy: Vec<[f64; 3]>,
    /// The equivalent share of independent ones.
    independent: f64,
    set_up: Vec<SetUpDeviation>,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_standard_deviations_hold_95_45_percent() {
        assert!((normal_share(2.0) - 0.954_499_736).abs() < 1e-9);
        assert!((normal_share(1.0) - 0.682_689_492).abs() < 1e-9);
    }

    #[test]
    fn a_guard_band_leaves_the_edge_undecided() {
        let decision =
            Decision { rule: Rule::GuardBand, coverage_factor: 2.0, tolerance: vec![Some(10.0)] };
        let judged = |value| {
            judge(
                &decision,
                0,
                &Deviation { row: 0, channel: 0, value, expanded: 2.0, redundancy: 1.0 },
            )
        };
        assert_eq!(judged(8.0), Outcome::Pass);
        assert_eq!(judged(-9.0), Outcome::Undecided);
        assert_eq!(judged(12.5), Outcome::Fail);
    }

    #[test]
    fn wilson_of_95_of_100() {
        // (0.95 + 0.0192)/1.0384 ± 1.887 √(0.000475 + 0.000096) = 0.9333 ± 0.0451
        let deviation = |k: usize| Deviation {
            row: k,
            channel: 0,
            value: if k < 95 { 0.0 } else { 3.0 },
            expanded: 1.0,
            redundancy: 1.0,
        };
        let some: Vec<Deviation> = (0..100).map(deviation).collect();
        let alone = Judged { k: 2.0, independent: 1.0, before: None, set_up: Vec::new() };
        let interval = coverage(&some, &alone).interval;
        assert!((interval[0] - 0.8882).abs() < 1e-3 && (interval[1] - 0.9785).abs() < 1e-3);
    }
}
