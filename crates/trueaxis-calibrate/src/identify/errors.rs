//! The errors of a machine from a campaign: checks, fit, selection, score, verdict.
//!
//! ```text
//!     readings ──check──> fit of all candidates ──parts──> selection ──fit──> values, uncertainties
//!                                             held-out residuals ──> score, verdict
//! ```

use super::checks::check_records;
use super::conflict::check_conflicts;
use super::convention::{ConventionCheck, check_conventions};
use super::feeds::{Feeds, check_feeds, feeds};
use super::influence::{Influences, influences};
use super::leftover::{Field, leftover_fields};
use super::records::{Loss, Options, Records};
use super::score::{Residuals, Score, repeatability};
use super::selection;
use super::selection::{Candidates, Selection, Sums, parts_by_place, select};
use super::stages::{Sequence, Value, compare, go_through};
use crate::plan::Unobservable;
use nalgebra::DVector;
use trueaxis_geometry::statistics::{chi_square_above, normal_quantile_above, robust_deviation};
use trueaxis_input::{Diagnostics, Place};
use trueaxis_machine::axis::MAX_AXES;
use trueaxis_machine::errors::ErrorKind;
use trueaxis_measure::measure::{Campaign, Readings};
use trueaxis_measure::unknowns::confusion::{Confusion, confusions};
use trueaxis_measure::unknowns::design::{Design, Unknown};
use trueaxis_measure::unknowns::fit::{Fit, FitError, by_rows, fit_by, linear_residuals};

/// The residual may be that many times the floor and still be explained.
const EXPLAINED: f64 = 1.25;
/// Held-out errors this many times those in sample mean that the model learnt the noise.
const OVER_FITTED: f64 = 1.5;
/// A field that explains less of the residual than this is none.
const LEAST_SHARE: f64 = 0.15;
/// Fits with new weights of a robust loss.
const ROBUST_PASSES: usize = 12;
/// Huber's bound: 82.14 % of normal numbers are within 1.345 standard deviations.
const HUBER_TAIL: f64 = 0.1786;
/// The residual from which on the conventions are checked unasked, in units of the noise.
const SUSPICIOUS: f64 = 5.0;

/// An unknown and what was found of it.
#[derive(Debug, Clone, PartialEq)]
pub struct Found {
    /// Its name: `EC0Y`, `EXX P2`, `probe.ball_x`.
    pub name: String,
    /// Its number in the design of the result.
    pub number: usize,
    /// Whether it is an angle (rad); otherwise mm, or 1 for scales.
    pub is_angle: bool,
    /// Whether it is a time (s): a lag.
    pub is_time: bool,
    /// Whether it is a share of a length: a scale, the expansion of a material.
    pub is_share: bool,
    /// Whether it belongs to a set-up and not to the machine.
    pub is_setup: bool,
    /// Value and standard uncertainty, mm, rad or 1; none if it is not observable.
    pub value: Option<(f64, f64)>,
}

impl Found {
    /// Value over uncertainty.
    pub fn z(&self) -> Option<f64> {
        self.value.filter(|(_, u)| *u > 0.0).map(|(value, u)| value / u)
    }
}

/// What became of it.
#[derive(Debug, Clone, PartialEq)]
pub enum Verdict {
    /// The residual on places that were held out is what the instrument repeats to.
    Explained,
    /// It is better on its own readings than on others.
    OverFitted,
    /// The residual is a smooth function of X, Y, Z; the share of its squares.
    FollowsPlaces(f64),
    /// The residual turns with a rotary axis: its letter and the share of the squares.
    TurnsWith(String, f64),
    /// The residual follows neither.
    Unexplained,
    /// A stage contradicts the stages before it; its name.
    StagesContradict(String),
}

impl Verdict {
    /// Whether the model may be trusted.
    pub fn is_good(&self) -> bool {
        *self == Self::Explained
    }

    /// In words.
    pub fn words(&self) -> String {
        match self {
            Self::Explained => "this model explains what can be explained".to_owned(),
            Self::OverFitted => "this model is over-fitted: measure at more places, or seek less"
                .to_owned(),
            Self::FollowsPlaces(share) => format!(
                "the residual follows machine XYZ (volumetric): {:.0} % of it, on places held out",
                share * 100.0
            ),
            Self::TurnsWith(axis, share) => format!(
                "the residual turns with {axis}: {:.0} % of it, on places held out",
                share * 100.0
            ),
            Self::Unexplained => "more is left than the instrument's noise, and it follows neither \
                                  the linear nor the rotary axes: look at the instrument, at drift, \
                                  at conventions"
                .to_owned(),
            Self::StagesContradict(stage) => format!(
                "stage `{stage}` contradicts what was known before: the result is a mean of two set-ups"
            ),
        }
    }

    /// A word for programs.
    pub fn key(&self) -> &'static str {
        match self {
            Self::Explained => "explained",
            Self::OverFitted => "over-fitted",
            Self::FollowsPlaces(_) => "follows-xyz",
            Self::TurnsWith(..) => "turns-with-axis",
            Self::Unexplained => "unexplained",
            Self::StagesContradict(_) => "stages-contradict",
        }
    }
}

/// What was identified.
#[derive(Debug, Clone)]
pub struct Identification {
    /// The design with the terms that were chosen.
    pub design: Design,
    /// The fit of it.
    pub fit: Fit,
    /// All unknowns of it.
    pub found: Vec<Found>,
    /// Candidates that the readings do not support.
    pub left_out: Vec<String>,
    /// Combinations of all candidates that are not observable.
    pub unobservable: Vec<Unobservable>,
    /// How the terms were chosen.
    pub selection: Selection,
    /// How many terms of error motions were candidates.
    pub candidates: usize,
    /// The residuals side by side.
    pub score: Score,
    /// The numbers themselves.
    pub residuals: Residuals,
    /// In words what they mean.
    pub verdict: Verdict,
    /// What the residual follows.
    pub fields: Vec<Field>,
    /// Uncertainties were enlarged by this (1: not at all). Unit: 1.
    pub birge: f64,
    /// What each row does.
    pub influences: Influences,
    /// The weights of the rows; empty: all 1. Unit: 1.
    pub weights: Vec<f64>,
    /// How many places.
    pub places: usize,
    /// From where to where each axis went. Unit: mm or rad.
    pub reach: [[f64; 2]; MAX_AXES],
    /// The conventions, if they were checked.
    pub conventions: Option<ConventionCheck>,
    /// At which feeds it was read, and what cannot be separated at them.
    pub feeds: Feeds,
    /// The stages one after the other, if the campaign has any.
    pub sequence: Option<Sequence>,
}

/// Identifies; `None` with errors in `problems`.
pub fn identify(
    campaign: &Campaign,
    options: &Options,
    records: &Records,
    problems: &mut Diagnostics,
) -> Option<Identification> {
    let place = Place::whole(&campaign.path.display().to_string());
    let readings = &records.readings;
    let whole = campaign.design();
    if readings.is_empty() || whole.unknowns() == 0 {
        let message = match readings.is_empty() {
            true => "there are no readings",
            false => "there are no unknowns",
        };
        let hint = "[instrument.NAME] readings = \"FILE.csv\"; [unknown] location = \"minimal\"";
        problems.error("nothing-to-identify", place, message.to_owned(), hint);
        return None;
    }
    let (parts, places) = parts_by_place(readings, options.folds);
    check_records(&whole, records, places, &place, problems);
    check_feeds(&whole, records, problems);
    if problems.has_errors() {
        return None;
    }
    let (sequence, whole, options) = through_stages(campaign, whole, options, records, problems)?;
    match Work::of(whole, records, &options, parts) {
        Ok(work) => {
            check_conflicts(&work.whole, readings, &work.z, &place, problems);
            let mut found = work.identification(campaign, places);
            found.sequence = sequence.map(|mut sequence| {
                let values: Vec<Value> = found.found.iter().map(|f| f.value).collect();
                compare(&mut sequence, &values, &place, problems);
                if let Some(stage) = sequence.contradicting() {
                    found.verdict = Verdict::StagesContradict(stage.to_owned());
                }
                sequence
            });
            Some(found)
        }
        Err(fault) => {
            tell_fault(&fault, records, &place, problems);
            None
        }
    }
}

/// The stages, what all readings at once start from, and how they are evaluated.
fn through_stages(
    campaign: &Campaign,
    whole: Design,
    options: &Options,
    records: &Records,
    problems: &mut Diagnostics,
) -> Option<(Option<Sequence>, Design, Options)> {
    if campaign.stages.list.is_empty() {
        return Some((None, whole, options.clone()));
    }
    if options.loss != Loss::Squares {
        let place = Place::whole(&campaign.path.display().to_string());
        let message =
            "what stages hand on are sums of squares; loss = \"huber\" has none".to_owned();
        problems.error(
            "stages-need-squares",
            place,
            message,
            "loss = \"squares\"; delete wrong rows",
        );
        return None;
    }
    // What one stage leaves out would be missing in the next: all unknowns stay in.
    let options = Options { selection: false, ..options.clone() };
    let (sequence, whole) = go_through(campaign, &whole, &options, records, problems)?;
    Some((Some(sequence), whole, options))
}

/// The fit of all candidates, the choice among them, and the fit of what was chosen.
struct Work<'a> {
    whole: Design,
    readings: &'a Readings,
    parts: Vec<usize>,
    weights: Vec<f64>,
    confusions: Vec<Confusion>,
    /// The readings, linear about the fit of all candidates.
    z: Vec<[f64; 3]>,
    candidates: Candidates,
    selection: Selection,
    setup_only: DVector<f64>,
    design: Design,
    /// The numbers of its unknowns in the whole design.
    numbers: Vec<usize>,
    fit: Fit,
}

impl<'a> Work<'a> {
    fn of(
        whole: Design,
        records: &'a Records,
        options: &Options,
        parts: Vec<usize>,
    ) -> Result<Self, FitError> {
        let readings = &records.readings;
        let (first, weights) = robust(&whole, readings, options)?;
        let confusions = confusions(&first.sight);
        let z = linearised(&whole, readings, &first);
        let sums = sums_of_parts(&whole, readings, &z, &weights, &parts);
        let candidates = candidates(&whole);
        let priors = Sums::of_priors(&whole);
        let selection = select(&sums, &priors, &candidates, options.selection);
        let chosen = |k: &usize| !candidates.maybe.contains(k) || selection.chosen.members[*k];
        let numbers: Vec<usize> = (0..whole.unknowns()).filter(chosen).collect();
        let terms = numbers.iter().filter_map(|k| whole.terms.get(*k).copied()).collect();
        let design = Design::new(&whole.machine, terms, whole.instruments.clone());
        let design = design.with_known(whole.known());
        let fit = fit_by(options.rule(), &design, readings, &weights)?;
        let setup_only = setup_only(&whole, &sums, &priors);
        Ok(Self {
            whole,
            readings,
            parts,
            weights,
            confusions,
            z,
            candidates,
            selection,
            setup_only,
            design,
            numbers,
            fit,
        })
    }

    fn residuals(&self) -> Residuals {
        let (whole, readings, z) = (&self.whole, self.readings, &self.z);
        let without_place = |i: usize| &self.selection.without_part[self.parts[i]];
        Residuals {
            before: linear_residuals(whole, readings, z, |_| &self.setup_only),
            after: self.fit.residuals.clone(),
            held_out: linear_residuals(whole, readings, z, without_place),
        }
    }

    fn identification(self, campaign: &Campaign, places: usize) -> Identification {
        let (design, readings) = (&self.design, self.readings);
        let residuals = self.residuals();
        let score = Score::of(design, readings, &residuals, repeatability(design, readings));
        let fields = leftover_fields(design, readings, &residuals.held_out, &self.parts);
        let birge = birge(&self.fit);
        let mut unseen = vec![false; self.whole.unknowns()];
        self.confusions.iter().flat_map(|c| &c.members).for_each(|(k, _)| unseen[*k] = true);
        let left_out = self.candidates.maybe.iter().filter(|k| !self.numbers.contains(k));
        let suspicious = score.in_sample.noise > SUSPICIOUS;
        let unobservable = |c: &Confusion| Unobservable::of(campaign, &self.whole, c);
        Identification {
            found: found(design, &self.fit, birge, |k| unseen[self.numbers[k]]),
            left_out: left_out.filter_map(|k| self.whole.unknown(*k)).map(|u| u.name()).collect(),
            unobservable: self.confusions.iter().map(unobservable).collect(),
            candidates: self.candidates.maybe.len(),
            verdict: verdict(design, &score, &fields),
            influences: influences(design, readings, &self.weights, &self.fit),
            conventions: suspicious.then(|| check_conventions(&self.whole, readings)),
            feeds: feeds(campaign, readings),
            sequence: None,
            reach: reach(readings),
            selection: self.selection,
            score,
            residuals,
            fields,
            birge,
            weights: self.weights,
            places,
            fit: self.fit,
            design: self.design,
        }
    }
}

fn reach(readings: &Readings) -> [[f64; 2]; MAX_AXES] {
    std::array::from_fn(|axis| {
        let positions = readings.commands.iter().map(|c| c[axis]);
        positions.fold([f64::MAX, f64::MIN], |[low, high], q| [low.min(q), high.max(q)])
    })
}

/// The fit of all candidates with the weights of the loss.
fn robust(
    design: &Design,
    readings: &Readings,
    options: &Options,
) -> Result<(Fit, Vec<f64>), FitError> {
    let fit = |weights: &[f64]| fit_by(options.rule(), design, readings, weights);
    let mut found = fit(&[])?;
    if options.loss == Loss::Squares {
        return Ok((found, Vec::new()));
    }
    let mut weights = Vec::new();
    for _ in 0..ROBUST_PASSES {
        let next = huber_weights(design, readings, &found);
        let changed = |(a, b): (&f64, &f64)| (a - b).abs() > 1e-3;
        let settled = !weights.is_empty() && !weights.iter().zip(&next).any(changed);
        weights = next;
        if settled {
            break;
        }
        found = fit(&weights)?;
    }
    Ok((found, weights))
}

/// Huber's weights: bound/|r| beyond the bound. A row counts as a whole, by the length of its
/// residual in units of the noise.
pub fn huber_weights(design: &Design, readings: &Readings, found: &Fit) -> Vec<f64> {
    let instrument = |i: usize| &design.instruments[readings.instruments[i] as usize];
    let in_noise = |i: usize, c: usize| found.residuals[i][c] / instrument(i).noise[c];
    let channels = |i: usize| instrument(i).sight.channels();
    let all = (0..readings.len()).flat_map(|i| (0..channels(i)).map(move |c| (i, c)));
    let scale = robust_deviation(all.map(|(i, c)| in_noise(i, c))).max(1e-12);
    (0..readings.len())
        .map(|i| {
            let size: f64 = (0..channels(i)).map(|c| in_noise(i, c).powi(2)).sum();
            let bound = match channels(i) {
                1 => normal_quantile_above(0.5 * HUBER_TAIL),
                n => chi_square_above(HUBER_TAIL, n as f64).sqrt(),
            };
            (bound * scale / size.sqrt().max(1e-300)).min(1.0)
        })
        .collect()
}

pub(super) fn tell_fault(
    fault: &FitError,
    records: &Records,
    place: &Place,
    problems: &mut Diagnostics,
) {
    let (place, hint) = match fault {
        FitError::Outside { row, .. } => {
            (records.place(*row), "correct the pose, or extend the table of the machine file")
        }
        _ => (place.clone(), "trueaxis identify --check-conventions tries signs, orders and sides"),
    };
    problems.error("no-fit", place, fault.to_string(), hint);
}

/// Residual plus model, linear about the solution, mm or rad.
pub(super) fn linearised(design: &Design, readings: &Readings, first: &Fit) -> Vec<[f64; 3]> {
    let values = DVector::from_column_slice(&first.values);
    by_rows(design, readings, |i, c, slopes| {
        first.residuals[i][c] + slopes.iter().zip(values.iter()).map(|(a, b)| a * b).sum::<f64>()
    })
}

fn sums_of_parts(
    design: &Design,
    readings: &Readings,
    z: &[[f64; 3]],
    weights: &[f64],
    parts: &[usize],
) -> Vec<Sums> {
    let count = parts.iter().max().map_or(0, |p| p + 1);
    (0..count)
        .map(|part| {
            let mine = |i: &usize| parts[*i] == part;
            let rows: Vec<usize> = (0..readings.len()).filter(mine).collect();
            let z: Vec<[f64; 3]> = rows.iter().map(|i| z[*i]).collect();
            let weights: Vec<f64> = match weights.is_empty() {
                true => Vec::new(),
                false => rows.iter().map(|i| weights[*i]).collect(),
            };
            Sums::of(design, &readings.filtered(|i| parts[i] == part), &z, &weights)
        })
        .collect()
}

/// Error motions may be in; everything else is, the servo too.
fn candidates(design: &Design) -> Candidates {
    let is_known = |k: usize| design.known().is_some_and(|known| known.normal[(k, k)] > 0.0);
    let is_motion = |k: &usize| matches!(design.unknown(*k), Some(Unknown::Term(t)) if t.error.kind == ErrorKind::Motion && !t.basis.is_servo() && !is_known(*k));
    let (maybe, always) = (0..design.unknowns()).partition(is_motion);
    Candidates { always, maybe }
}

/// The unknowns of the set-ups alone: the machine without errors.
fn setup_only(design: &Design, sums: &[Sums], priors: &Sums) -> DVector<f64> {
    let setups = (design.terms.len()..design.unknowns()).collect();
    let none = Candidates { always: setups, maybe: Vec::new() };
    selection::select(sums, priors, &none, false).chosen.values
}

/// χ² beyond its 99 % quantile: the noise is larger than stated, by this factor (Birge 1932).
pub fn birge(fit: &Fit) -> f64 {
    let free = fit.degrees_of_freedom as f64;
    if free < 1.0 || fit.chi_square <= chi_square_above(0.01, free) {
        return 1.0;
    }
    (fit.chi_square / free).sqrt()
}

fn found(
    design: &Design,
    fit: &Fit,
    birge: f64,
    is_confused: impl Fn(usize) -> bool,
) -> Vec<Found> {
    (0..design.unknowns())
        .filter_map(|k| Some((k, design.unknown(k)?)))
        .map(|(k, unknown)| {
            let seen = fit.sight.is_seen[k] && !is_confused(k);
            let u = fit.covariance[(k, k)].max(0.0).sqrt() * birge;
            Found {
                name: unknown.name(),
                number: k,
                is_angle: unknown.is_angle(),
                is_time: unknown.is_time(),
                is_share: unknown.is_share(),
                is_setup: matches!(unknown, Unknown::Setup(..)),
                value: seen.then_some((fit.values[k], u)),
            }
        })
        .collect()
}

fn verdict(design: &Design, score: &Score, fields: &[Field]) -> Verdict {
    let held_out = score.held_out.noise;
    let floor = score.floor.noise.max(1e-12);
    if held_out <= EXPLAINED * floor {
        return Verdict::Explained;
    }
    let in_sample = score.in_sample.noise.max(1e-12);
    if held_out > OVER_FITTED * in_sample {
        return Verdict::OverFitted;
    }
    let strongest = fields.iter().max_by(|a, b| a.share.total_cmp(&b.share));
    match strongest.filter(|f| f.share > LEAST_SHARE) {
        Some(Field { axis: None, share }) => Verdict::FollowsPlaces(*share),
        Some(Field { axis: Some(axis), share }) => {
            Verdict::TurnsWith(design.machine.axes()[*axis].name.to_string(), *share)
        }
        // Worse than no model at all.
        None if held_out > score.before.noise => Verdict::OverFitted,
        None => Verdict::Unexplained,
    }
}
