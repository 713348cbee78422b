//! The errors of a machine from a campaign: checks, fit, selection, score, verdict.
//!
//! ```text
//!     readings ──check──> fit of all candidates ──parts──> selection ──fit──> values, uncertainties
//!                                             held-out residuals ──> score, verdict
//! ```

use super::adequacy::{Adequacy, Task, adequacy};
use super::another_machine::tell_mixed;
use super::assumptions::{check_assumed, check_result, check_times};
use super::checks::{check_records, tell_fault};
use super::conflict::check_conflicts;
use super::convention::{ConventionCheck, check_conventions};
use super::feeds::{Feeds, check_feeds, feeds};
use super::freedom::coverage_factor;
use super::gross::without_gross;
use super::influence::{Influences, influences};
use super::records::{Loss, Options, Records};
use super::robust::{huber, linearised};
use super::score::{Residuals, Score, repeatability};
use super::selection;
use super::selection::{Candidates, Selection, Sums, parts_by_place, select};
use super::stages::{Sequence, Value, compare, go_through};
use super::verdict::{Verdict, below_noise, set_up};
use crate::plan::Unobservable;
use nalgebra::DVector;
use trueaxis_geometry::statistics::chi_square_above;
use trueaxis_input::{Diagnostics, Place};
use trueaxis_machine::axis::{AxisKind, MAX_AXES};
use trueaxis_machine::errors::ErrorKind;
use trueaxis_measure::measure::{Campaign, Readings};
use trueaxis_measure::unknowns::confusion::Confusion;
use trueaxis_measure::unknowns::design::{Design, Unknown};
use trueaxis_measure::unknowns::determined::Determined;
use trueaxis_measure::unknowns::fit::{Fit, FitError, fit_by, linear_residuals};
use trueaxis_measure::unknowns::set_up::SetUpDeviation;
use trueaxis_measure::unknowns::unlisted::Follows;

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
    /// Whether it is a rate by the hour: the drift of a set-up.
    pub is_rate: bool,
    /// Whether it belongs to a set-up and not to the machine.
    pub is_setup: bool,
    /// Value and standard uncertainty, mm, rad, 1 or by the hour; none if it is not observable.
    pub value: Option<(f64, f64)>,
    /// Effective degrees of freedom of the uncertainty; `None`: infinitely many. Unit: 1.
    pub degrees_of_freedom: Option<f64>,
}

impl Found {
    /// Value over uncertainty.
    pub fn z(&self) -> Option<f64> {
        self.value.filter(|(_, u)| *u > 0.0).map(|(value, u)| value / u)
    }

    /// How many standard uncertainties contain the value with 95.45 %.
    pub fn coverage_factor(&self) -> f64 {
        coverage_factor(self.degrees_of_freedom)
    }

    /// U = k u, mm, rad or 1; none if it is not observable.
    pub fn expanded(&self) -> Option<f64> {
        self.value.map(|(_, u)| self.coverage_factor() * u)
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
    /// What is stated of the set-up against what the readings make of it.
    pub set_up: Vec<SetUpDeviation>,
    /// In words what they mean.
    pub verdict: Verdict,
    /// Whether the listed errors explain the readings, and what the rest looks like.
    pub adequacy: Adequacy,
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

impl Identification {
    /// The largest coverage factor of the values. Unit: 1.
    pub fn coverage_factor(&self) -> f64 {
        self.found
            .iter()
            .filter(|f| f.value.is_some())
            .map(Found::coverage_factor)
            .fold(2.0, f64::max)
    }
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
    let whole = campaign.design().from_first_readings(readings);
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
    check_assumed(&whole, &place, problems);
    check_times(records, problems);
    if problems.has_errors() {
        return None;
    }
    let (sequence, whole, options) = through_stages(campaign, whole, options, records, problems)?;
    let identified = Work::of(whole, records, &options, parts).and_then(|work| {
        let other = check_conflicts(&work.whole, readings, &work.z, &place, problems);
        Ok((work.identification(campaign, &options, places)?, other))
    });
    match identified {
        Ok((mut found, other)) => {
            found.verdict = found.doubted(other);
            found.sequence = sequence.map(|mut sequence| {
                let values: Vec<Value> = found.found.iter().map(|f| f.value).collect();
                compare(&mut sequence, &values, &place, problems);
                if let Some(stage) = sequence.contradicting() {
                    found.verdict = Verdict::StagesContradict(stage.to_owned());
                }
                sequence
            });
            check_result(&found, records, &place, problems);
            let mixed = found.conventions.as_ref().map_or(&[][..], |check| &check.mixed);
            tell_mixed(mixed, records, problems);
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
        let confusions = Determined::of(&whole, &first).confusions(&whole, &first.sight);
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

    fn identification(
        self,
        campaign: &Campaign,
        options: &Options,
        places: usize,
    ) -> Result<Identification, FitError> {
        let (design, readings) = (&self.design, self.readings);
        let residuals = self.residuals();
        let (floor, repeats) = repeatability(design, readings, &self.weights, &self.fit.residuals);
        let score = Score::of(design, readings, &residuals, floor);
        let adequacy = adequacy(Task {
            design,
            readings,
            weights: &self.weights,
            fit: &self.fit,
            repeats,
            rule: options.rule(),
            predicts: options.predicts,
            scores: options.scores,
        })?;
        let determined = adequacy.explained.listed.clone();
        let influences = influences(design, readings, &self.weights, &self.fit);
        let left_out = self.candidates.maybe.iter().filter(|k| !self.numbers.contains(k));
        let suspicious =
            score.in_sample.noise > SUSPICIOUS || below_noise(design, &self.fit, &score).is_some();
        let unobservable = |c: &Confusion| Unobservable::of(campaign, &self.whole, c);
        let set_up = set_up(design, &self.fit, &determined);
        Ok(Identification {
            found: found(design, &determined, &adequacy.explained.degrees_of_freedom),
            left_out: left_out.filter_map(|k| self.whole.unknown(*k)).map(|u| u.name()).collect(),
            unobservable: self.confusions.iter().map(unobservable).collect(),
            candidates: self.candidates.maybe.len(),
            verdict: verdict(design, &adequacy, influences.outliers.len()),
            set_up,
            influences,
            conventions: suspicious.then(|| check_conventions(&self.whole, readings)),
            feeds: feeds(campaign, readings),
            sequence: None,
            reach: reach(readings),
            selection: self.selection,
            score,
            residuals,
            adequacy,
            weights: self.weights,
            places,
            fit: Fit { values: determined.values, covariance: determined.seen, ..self.fit },
            design: self.design,
        })
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
    let found = fit(&[])?;
    if options.loss == Loss::Squares {
        let without = without_gross(options.rule(), design, readings, &found)?;
        return Ok(without.unwrap_or((found, Vec::new())));
    }
    huber(found, design, readings, fit)
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

fn found(design: &Design, determined: &Determined, freedom: &[Option<f64>]) -> Vec<Found> {
    (0..design.unknowns())
        .filter_map(|k| Some((k, design.unknown(k)?)))
        .map(|(k, unknown)| {
            let value = (determined.values[k], determined.u(k));
            Found {
                name: unknown.name(),
                number: k,
                is_angle: unknown.is_angle(),
                is_time: unknown.is_time(),
                is_share: unknown.is_share(),
                is_rate: unknown.is_rate(),
                is_setup: matches!(unknown, Unknown::Setup(..)),
                value: determined.is_determined[k].then_some(value),
                degrees_of_freedom: freedom.get(k).copied().flatten(),
            }
        })
        .collect()
}

fn verdict(design: &Design, adequacy: &Adequacy, outliers: usize) -> Verdict {
    if !adequacy.lack.is_found() {
        return match adequacy.is_barely_checked {
            _ if outliers > 0 => Verdict::GrossReadings(outliers),
            true => Verdict::OverFitted,
            false => Verdict::Explained,
        };
    }
    let Some(kind) = adequacy.evident() else { return Verdict::Unexplained };
    let axes = design.machine.axes();
    match kind.follows {
        Follows::Axis(axis) if axes[axis].kind == AxisKind::Linear => {
            Verdict::FollowsPlaces(kind.share)
        }
        Follows::Axis(axis) => Verdict::TurnsWith(axes[axis].name.to_string(), kind.share),
        Follows::Arrangement => Verdict::Arrangement(kind.share),
        Follows::Approach => Verdict::Reverses(kind.share),
        Follows::Time => Verdict::Drifts(kind.share),
    }
}
