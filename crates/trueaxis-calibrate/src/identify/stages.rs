//! Stages one after the other: each starts from the values and the covariance of the stages before it.
//!
//! ```text
//!     Λ_k = Λ_{k−1} + J_kᵀ W_k J_k / b_k²,   η_k = η_{k−1} + J_kᵀ W_k z_k / b_k²,   x̂_k = Λ_k⁺ η_k
//!     b_k Birge's factor of the readings of the stage alone                               docs/model.md eq. 201
//!     T = χ²(both) − χ²(before) − χ²(stage) ~ χ²(rank(before) + rank(stage) − rank(both)) docs/model.md eq. 202
//! ```
//!
//! Sums do not depend on their order: the result is that of all readings at once.

use super::checks::tell_fault;
use super::conflict::chi_square_tail;
use super::records::{Options, Records};
use super::robust::linearised;
use super::selection::Sums;
use super::stage_tables::Calibrated;
use nalgebra::DVector;
use trueaxis_geometry::statistics::chi_square_above;
use trueaxis_input::{Diagnostics, Place};
use trueaxis_measure::instruments::instrument::SetupError;
use trueaxis_measure::measure::Campaign;
use trueaxis_measure::measure::stages::Stage;
use trueaxis_measure::unknowns::design::{Design, Unknown};
use trueaxis_measure::unknowns::fit::{FitError, Observability, fit_by};
use trueaxis_measure::unknowns::known::Known;

/// Stages that agree are reported to disagree once in a hundred campaigns.
const UNLIKELY: f64 = 0.01;
/// Below this the result is no result.
const NO_CHANCE: f64 = 1e-3;
/// A value that loses less than this share of its variance says nothing of a stage.
const NOTHING: f64 = 1e-6;
/// Stages and all readings at once may differ by that many standard uncertainties: products of errors.
const SAME: f64 = 0.1;
/// Unknowns that are named in one message.
const MOST_NAMED: usize = 4;

/// What is known of one unknown: value and standard uncertainty. Unit: mm, rad, s or 1.
pub type Value = Option<(f64, f64)>;

/// A stage and what it found.
#[derive(Debug, Clone)]
pub struct StageResult {
    /// Its name.
    pub name: String,
    /// When, as written.
    pub date: Option<String>,
    /// How many numbers were read.
    pub numbers: usize,
    /// What it found without the axes of the machine, in words.
    pub lines: Vec<String>,
    /// Each unknown before this stage.
    pub before: Vec<Value>,
    /// Each unknown after it.
    pub after: Vec<Value>,
    /// By how much the noise of its readings is larger than stated. Unit: 1.
    pub birge: f64,
    /// The test of its readings against what was known before; none if nothing was.
    pub test: Option<Test>,
}

/// Whether a stage agrees with what was known before.
#[derive(Debug, Clone)]
pub struct Test {
    /// χ². Unit: 1.
    pub chi_square: f64,
    /// Its degrees of freedom.
    pub degrees_of_freedom: usize,
    /// The probability of a larger χ² by chance. Unit: 1.
    pub p: f64,
    /// The unknown that differs most; none if none can be compared alone.
    pub worst: Option<Contrast>,
}

/// An unknown by two sources, each with its value and standard uncertainty.
#[derive(Debug, Clone, Copy)]
pub struct Contrast {
    /// Its number.
    pub unknown: usize,
    /// By the stages before. Unit: mm, rad, s or 1.
    pub before: (f64, f64),
    /// By this stage. Unit: mm, rad, s or 1.
    pub here: (f64, f64),
}

impl Contrast {
    /// The difference in its standard uncertainties.
    fn off(&self) -> f64 {
        (self.before.0 - self.here.0).abs() / self.before.1.hypot(self.here.1)
    }
}

impl Test {
    /// Whether they contradict each other.
    pub fn is_conflict(&self) -> bool {
        self.p < UNLIKELY
    }
}

/// All stages.
#[derive(Debug, Clone)]
pub struct Sequence {
    /// The unknowns.
    pub names: Vec<String>,
    /// One after the other.
    pub results: Vec<StageResult>,
    /// The largest difference to all readings at once, in standard uncertainties. Unit: 1.
    pub difference: f64,
}

impl Sequence {
    /// The first stage whose contradiction is no chance.
    pub fn contradicting(&self) -> Option<&str> {
        let bad = |r: &&StageResult| r.test.as_ref().is_some_and(|t| t.p < NO_CHANCE);
        self.results.iter().find(bad).map(|r| r.name.as_str())
    }
}

/// A stage while the sequence is worked out.
struct Step {
    /// What its readings and tables say.
    own: Known,
    /// What was known after it.
    after: Known,
    /// Whether its readings depend on an unknown.
    touched: Vec<bool>,
}

/// The values of what is known.
fn values(known: &Known, threshold: f64) -> (Observability, Vec<Value>) {
    let sight = Observability::with_threshold(&known.normal, threshold);
    let (x, c) = (sight.solve(&known.gradient), sight.covariance());
    let value = |k: usize| sight.is_seen[k].then(|| (x[k], c[(k, k)].max(0.0).sqrt()));
    let all = (0..x.len()).map(value).collect();
    (sight, all)
}

/// Goes through the stages; the design that is returned knows what they know without the axes of the machine,
/// and the noise of its instruments is that which they have shown.
pub(super) fn go_through(
    campaign: &Campaign,
    whole: &Design,
    options: &Options,
    records: &Records,
    problems: &mut Diagnostics,
) -> Option<(Sequence, Design)> {
    let plain = without_priors(whole);
    let mut state = whole.prior();
    let mut results = Vec::new();
    let mut steps: Vec<Step> = Vec::new();
    let mut at_once = whole.clone();
    let mut known = whole.known().cloned().unwrap_or_else(|| Known::nothing(whole.names()));
    for (stage, calibrated) in campaign.stages.list.iter().zip(&records.calibrated) {
        known.add(&calibrated.known, 1.0);
        let step = measured(&plain, (stage, calibrated), &state, options, records);
        let (own, touched, numbers, birge) = match step {
            Ok(step) => step,
            Err(fault) => {
                tell_fault(&fault, records, &stage.place, problems);
                return None;
            }
        };
        for k in &stage.instruments {
            at_once.instruments[*k].noise.iter_mut().for_each(|u| *u *= birge);
        }
        let test = tested(&state, &own, options.threshold);
        let before = values(&state, options.threshold).1;
        state.add(&own, 1.0);
        results.push(StageResult {
            name: stage.name.clone(),
            date: stage.date.clone(),
            numbers,
            lines: calibrated.lines.clone(),
            before,
            after: values(&state, options.threshold).1,
            birge,
            test,
        });
        steps.push(Step { own, after: state.clone(), touched });
    }
    let sequence = Sequence { names: whole.names(), results, difference: 0.0 };
    tell_conflicts(campaign, whole, &sequence, problems);
    tell_order(campaign, &sequence, &steps, options.threshold, problems);
    tell_missing(campaign, whole, &sequence, &steps, problems);
    Some((sequence, at_once.with_known(Some(&known))))
}

/// The same unknowns, of each of which nothing is known.
fn without_priors(whole: &Design) -> Design {
    let mut terms = whole.terms.clone();
    terms.iter_mut().for_each(|t| t.prior = None);
    let mut instruments = whole.instruments.clone();
    instruments.iter_mut().flat_map(|i| &mut i.unknowns).for_each(|u| u.prior_u = None);
    Design::new(&whole.machine, terms, instruments)
}

/// What a stage says, which unknowns its readings depend on, how many numbers, Birge's factor.
fn measured(
    plain: &Design,
    (stage, calibrated): (&Stage, &Calibrated),
    state: &Known,
    options: &Options,
    records: &Records,
) -> Result<(Known, Vec<bool>, usize, f64), FitError> {
    let mut own = Known::nothing(plain.names());
    own.add(&calibrated.known, 1.0);
    let all = &records.readings;
    let readings = all.filtered(|i| stage.instruments.contains(&(all.instruments[i] as usize)));
    if readings.is_empty() {
        return Ok((own, vec![false; plain.unknowns()], calibrated.numbers, 1.0));
    }
    let mut before = state.clone();
    before.add(&own, 1.0);
    let design = plain.clone().with_known(Some(&before));
    let fit = fit_by(options.rule(), &design, &readings, &[])?;
    let z = linearised(plain, &readings, &fit);
    let sums = Sums::of(plain, &readings, &z, &[]);
    let alone = Observability::of(&sums.normal);
    let scatter = sums.error(&alone.solve(&sums.gradient));
    let free = sums.numbers.saturating_sub(alone.rank) as f64;
    let birge = match free >= 1.0 && scatter > chi_square_above(UNLIKELY, free) {
        true => (scatter / free).sqrt(),
        false => 1.0,
    };
    let touched = sums.normal.diagonal().iter().map(|d| *d > 0.0).collect();
    let numbers = sums.numbers + calibrated.numbers;
    let names = plain.names();
    let Sums { normal, gradient, square, .. } = sums;
    let read = Known { normal, gradient, square, ..Known::nothing(names) };
    own.add(&read, birge.powi(-2));
    Ok((own, touched, numbers, birge))
}

/// Compares what a stage says with what was known before.
fn tested(before: &Known, own: &Known, threshold: f64) -> Option<Test> {
    let mut both = before.clone();
    both.add(own, 1.0);
    let solved = |known: &Known| {
        let (sight, all) = values(known, threshold);
        let x: DVector<f64> = sight.solve(&known.gradient);
        (sight.rank, known.error(&x), all)
    };
    let [(rank_a, a, old), (rank_b, b, _), (rank, together, new)] =
        [before, own, &both].map(solved);
    let degrees_of_freedom = (rank_a + rank_b).saturating_sub(rank);
    if degrees_of_freedom == 0 {
        return None;
    }
    let chi_square = (together - a - b).max(0.0);
    // Of one unknown: what the stage adds to the value before, with the variance that it takes away.
    let by_stage = |k: usize| {
        let ((x, u), (after, u_after)) = (old[k]?, new[k]?);
        let (p, q) = (u.powi(-2), u_after.powi(-2));
        let own = q - p;
        let here = || ((after * q - x * p) / own, own.powf(-0.5));
        (own > NOTHING * q).then(|| Contrast { unknown: k, before: (x, u), here: here() })
    };
    let all = (0..old.len()).filter_map(by_stage);
    let worst = all.max_by(|a, b| a.off().total_cmp(&b.off()));
    let p = chi_square_tail(chi_square, degrees_of_freedom);
    Some(Test { chi_square, degrees_of_freedom, p, worst })
}

fn tell_conflicts(
    campaign: &Campaign,
    design: &Design,
    sequence: &Sequence,
    problems: &mut Diagnostics,
) {
    for (stage, result) in campaign.stages.list.iter().zip(&sequence.results) {
        let Some(test) = result.test.as_ref().filter(|t| t.is_conflict()) else { continue };
        let worst = test.worst.map_or(String::new(), |Contrast { unknown: k, before, here }| {
            let (unit, scale) = design.shown_unit(k);
            let [a, b] = [before, here]
                .map(|(v, u)| format!("{:.2} {unit} (U {:.2} {unit})", v * scale, 2.0 * u * scale));
            format!("; {} is {a} before and {b} by this stage", sequence.names[k])
        });
        let message = format!(
            "stage `{}` contradicts what was known before: χ² = {:.1} with {} degrees of freedom, p = {}{worst}",
            result.name,
            test.chi_square,
            test.degrees_of_freedom,
            probability(test.p)
        );
        let hint = "another tool, bar, ball, set-up or temperature in one of them? measure the stage again";
        problems.warn("conflicting-stages", stage.place.clone(), message, hint);
    }
}

/// A probability in words.
pub fn probability(p: f64) -> String {
    match p {
        p if p < 1e-6 => "less than 1e-6".to_owned(),
        p if p < 1e-3 => format!("{p:.1e}"),
        p => format!("{p:.3}"),
    }
}

/// A stage of the machine that a later calibration would have helped.
fn tell_order(
    campaign: &Campaign,
    sequence: &Sequence,
    steps: &[Step],
    threshold: f64,
    problems: &mut Diagnostics,
) {
    let list = &campaign.stages.list;
    for (k, step) in steps.iter().enumerate() {
        let unseen = |j: &usize| step.touched[*j] && sequence.results[k].after[*j].is_none();
        let unseen: Vec<usize> = (0..sequence.names.len()).filter(unseen).collect();
        let later = (k + 1..list.len()).filter(|j| list[*j].is_calibration());
        for j in later {
            let mut with = step.after.clone();
            with.add(&steps[j].own, 1.0);
            let seen = values(&with, threshold).1;
            let gained: Vec<usize> =
                unseen.iter().copied().filter(|n| seen[*n].is_some()).collect();
            if gained.is_empty()
                || list[j].instruments.iter().any(|i| list[k].instruments.contains(i))
            {
                continue;
            }
            let message = format!(
                "stage `{}` needs stage `{}` (line {}), which comes after it: only then {} can be determined",
                list[k].name,
                list[j].name,
                list[j].place.line,
                some_names(sequence, &gained)
            );
            let hint = "calibrate first; the result of all stages is the same, the results on the way are not";
            problems.warn("stage-order", list[k].place.clone(), message, hint);
            break;
        }
    }
}

fn some_names(sequence: &Sequence, numbers: &[usize]) -> String {
    let names: Vec<&str> =
        numbers.iter().take(MOST_NAMED).map(|k| sequence.names[*k].as_str()).collect();
    let more = numbers.len().saturating_sub(MOST_NAMED);
    match more {
        0 => names.join(", "),
        more => format!("{} and {more} more", names.join(", ")),
    }
}

/// What no stage determines of a set-up, where errors of the machine cannot be separated from it.
fn tell_missing(
    campaign: &Campaign,
    design: &Design,
    sequence: &Sequence,
    steps: &[Step],
    problems: &mut Diagnostics,
) {
    let Some(last) = sequence.results.last() else { return };
    let open = |k: &usize| last.after[*k].is_none() && steps.iter().any(|s| s.touched[*k]);
    let terms: Vec<usize> = (0..design.terms.len()).filter(open).collect();
    let setups = (design.terms.len()..design.unknowns()).filter(open);
    let calibrated = |k: usize| steps.iter().any(|s| !s.touched[k] && s.own.normal[(k, k)] > 0.0);
    let missing: Vec<usize> = setups.filter(|k| !calibrated(*k)).collect();
    let (Some(first), false) = (missing.first(), terms.is_empty()) else { return };
    let Some(Unknown::Setup(instrument, unknown)) = design.unknown(*first) else { return };
    let key = match unknown.error {
        SetupError::Zero(_) => format!("zero = {{ of = {:?}, … }}", instrument.name),
        SetupError::ReferencePoint(_) => format!("ball = {{ of = {:?}, … }}", instrument.name),
        error if error.is_rate() => {
            format!("values = {{ {:?} = \"0 ± 1 um/h\" }}", sequence.names[*first])
        }
        _ => format!("values = {{ {:?} = \"0 ± 1 um\" }}", sequence.names[*first]),
    };
    let message = format!(
        "no stage determines {}: {} cannot be separated from it",
        some_names(sequence, &missing),
        some_names(sequence, &terms)
    );
    let place = Place::whole(&campaign.path.display().to_string());
    problems.warn("stage-missing", place, message, &format!("a [[stage]] with {key}"));
}

/// Compares the last stage with all readings at once.
pub(super) fn compare(
    sequence: &mut Sequence,
    at_once: &[Value],
    place: &Place,
    problems: &mut Diagnostics,
) {
    let Some(last) = sequence.results.last() else { return };
    let off = |(k, (a, b)): (usize, (&Value, &Value))| {
        let ((x, _), (y, u)) = ((*a)?, (*b)?);
        Some((k, (x - y).abs() / u.max(1e-300)))
    };
    let pairs = last.after.iter().zip(at_once).enumerate();
    let worst = pairs.filter_map(off).max_by(|a, b| a.1.total_cmp(&b.1));
    let Some((k, difference)) = worst else { return };
    sequence.difference = difference;
    if difference > SAME {
        let message = format!(
            "{} differs by {difference:.2} standard uncertainties between the stages and all readings at once",
            sequence.names[k]
        );
        let hint = "errors or set-ups are so large that their products count: state the set-up more closely";
        problems.warn("stages-differ", place.clone(), message, hint);
    }
}
