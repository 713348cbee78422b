//! Whether the listed errors explain the readings, what the rest looks like, and what that does to the uncertainties.
//!
//! ```text
//!     χ² of the residual against the noise, or F against the repeatability, at 4 %          docs/model.md eq. 305
//!     the largest studentised residual at 1 % (Bonferroni)                                  eq. 129
//! ```
//!
//! Together they call one good campaign in twenty bad. What the listed errors leave is shared out among those that
//! are not listed ([`Unlisted`]); their covariance becomes part of that of the listed ones.

use super::freedom::degrees_of_freedom;
use super::predictor::{Predictor, predictor};
use super::selection;
use nalgebra::{DMatrix, DVector};
use std::ops::Range;
use trueaxis_geometry::statistics::{chi_square_above, fisher_above};
use trueaxis_measure::measure::Readings;
use trueaxis_measure::unknowns::design::Design;
use trueaxis_measure::unknowns::determined::{Determined, all_before};
use trueaxis_measure::unknowns::fit::{Fit, FitError, Model, Rule, fit_by};
use trueaxis_measure::unknowns::mixed::{Rest, Sizes, Sums};
use trueaxis_measure::unknowns::stated::Stated;
use trueaxis_measure::unknowns::unlisted::{self, Follows, Unlisted};

/// How often the residual of a good campaign is called too large.
pub const LEVEL: f64 = 0.04;
/// How often one of its readings is called wrong.
pub const LEVEL_OF_READINGS: f64 = 0.01;
/// Fewer of a hundred numbers that check the model say nothing.
const LEAST_FREEDOM: f64 = 0.2;
/// −2 ln L falls by more than this once in a hundred times where there is nothing (χ² of one size that cannot be
/// negative).
const EVIDENCE: f64 = 5.41;

/// A fall of −2 ln L that is no more than a hint: there are several groups, and each may fit some noise.
const HINT: f64 = 4.0;

/// The scatter of repeated readings, in units of the stated noise.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scatter {
    /// The sum of squares about their means. Unit: 1.
    pub square: f64,
    /// Its degrees of freedom. Unit: 1.
    pub freedom: f64,
}

/// The residual against the noise.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LackOfFit {
    /// χ² or F. Unit: 1.
    pub statistic: f64,
    /// What it exceeds in four of a hundred good campaigns. Unit: 1.
    pub limit: f64,
    /// Degrees of freedom of the residual. Unit: 1.
    pub freedom: f64,
    /// Those of the repeatability, where it was measured. Unit: 1.
    pub of_repeats: Option<f64>,
}

impl LackOfFit {
    /// Of a fit; against repeated readings, if there are any.
    pub fn of(fit: &Fit, repeats: Option<Scatter>) -> Self {
        let freedom = fit.degrees_of_freedom as f64;
        match repeats.filter(|r| r.freedom < freedom && r.square > 0.0) {
            Some(repeats) => {
                let own = freedom - repeats.freedom;
                let of_model = (fit.chi_square - repeats.square).max(0.0) / own;
                Self {
                    statistic: of_model / (repeats.square / repeats.freedom),
                    limit: fisher_above(LEVEL, own, repeats.freedom),
                    freedom: own,
                    of_repeats: Some(repeats.freedom),
                }
            }
            None => Self {
                statistic: fit.chi_square,
                limit: if freedom > 0.0 { chi_square_above(LEVEL, freedom) } else { f64::INFINITY },
                freedom,
                of_repeats: None,
            },
        }
    }

    /// Whether the residual is larger than by chance.
    pub fn is_found(&self) -> bool {
        self.statistic > self.limit
    }
}

/// A kind of error that are not listed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Kind {
    /// What it follows.
    pub follows: Follows,
    /// Its size in units of 10 µm and 10 µrad, all kinds together. Unit: 1.
    pub times: f64,
    /// By how much −2 ln L falls with this kind alone. Unit: 1.
    pub evidence: f64,
    /// The share of the squares that it explains alone. Unit: 1.
    pub share: f64,
}

/// What the listed errors leave.
#[derive(Debug, Clone)]
pub struct Adequacy {
    /// The test of the residual.
    pub lack: LackOfFit,
    /// Whether too few numbers check the model.
    pub is_barely_checked: bool,
    /// The kinds, the most evident first.
    pub kinds: Vec<Kind>,
    /// The noise in units of that which is stated, 1 or more. Unit: 1.
    pub noise: f64,
    /// The listed unknowns with all that is not listed.
    pub explained: Explained,
    /// How well readings are predicted where no single error can be named.
    pub predictor: Option<Predictor>,
}

impl Adequacy {
    /// The kind that the residual looks like, if one is evident.
    pub fn evident(&self) -> Option<&Kind> {
        self.kinds.first().filter(|k| k.evidence > EVIDENCE)
    }
}

/// Further terms stand between those that are listed and the set-ups.
fn places(listed: &Design, further: usize) -> Vec<usize> {
    let terms = listed.terms.len();
    (0..listed.unknowns()).map(|k| if k < terms { k } else { k + further }).collect()
}

/// What is tested.
#[derive(Clone, Copy)]
pub struct Task<'a> {
    /// The listed unknowns.
    pub design: &'a Design,
    /// What was read.
    pub readings: &'a Readings,
    /// The weights of the rows; empty: all 1. Unit: 1.
    pub weights: &'a [f64],
    /// The fit of the listed unknowns alone.
    pub fit: &'a Fit,
    /// The scatter of repeated readings.
    pub repeats: Option<Scatter>,
    /// How the fit goes about it.
    pub rule: Rule,
    /// Whether readings are predicted by all errors, too.
    pub predicts: bool,
    /// Whether the prediction is scored on readings that were held out.
    pub scores: bool,
}

/// Tests the listed unknowns, and finds what the rest looks like.
///
/// # Errors
/// As [`fit_by`].
pub fn adequacy(task: Task<'_>) -> Result<Adequacy, FitError> {
    let fit = task.fit;
    let lack = LackOfFit::of(fit, task.repeats);
    let numbers = (fit.degrees_of_freedom + fit.sight.rank).max(1) as f64;
    let is_barely_checked = fit.degrees_of_freedom as f64 / numbers < LEAST_FREEDOM;
    let prepared = Prepared::of(task);
    let (unlisted, ranges) = (&prepared.unlisted, &prepared.ranges);
    let sums = prepared.sums(|_| true);
    let rest = prepared.rest(&sums);
    let mut explanations = rest.as_ref().map_or(Vec::new(), |rest| explanations(rest, ranges));
    if !lack.is_found() {
        explanations.truncate(1);
        let nothing = explanations.iter().all(|e| e.times.iter().all(|t| *t == 0.0));
        let wanted = unlisted.wanted.filter(|_| nothing);
        if let Some((rest, group)) = rest.as_ref().zip(wanted) {
            explanations = vec![only(rest, ranges, group)];
        }
    }
    if explanations.is_empty() {
        explanations.push(Sizes::none(ranges.len()));
    }
    let first = &explanations[0];
    let shows = rest.as_ref().filter(|_| lack.is_found() || task.predicts);
    let kinds = shows.map_or(Vec::new(), |rest| kinds(rest, unlisted, ranges, &first.times));
    let explained = |sizes: &Sizes| -> Result<Explained, FitError> {
        let freedom = rest.as_ref().map(|rest| degrees_of_freedom(&prepared, (&sums, rest), sizes));
        let freedom = freedom.unwrap_or_else(|| vec![None; task.design.unknowns()]);
        let mut explained = Explained::of(task, unlisted, sizes)?;
        explained.degrees_of_freedom = freedom;
        explained.add_stated(task);
        Ok(explained)
    };
    let mut explained_by = explained(first)?;
    for other in &explanations[1..] {
        explained_by.widen(&explained(other)?);
    }
    let predictor =
        task.predicts.then(|| predictor(&prepared, (&sums, &explanations), task)).flatten();
    Ok(Adequacy {
        lack,
        is_barely_checked,
        kinds,
        noise: first.noise,
        explained: explained_by,
        predictor,
    })
}

/// The listed unknowns with one explanation of what they leave.
#[derive(Debug, Clone)]
pub struct Explained {
    /// The design with the errors that are not listed.
    pub design: Design,
    /// The fit with them.
    pub fit: Fit,
    /// The listed unknowns.
    pub listed: Determined,
    /// Effective degrees of freedom of the uncertainty of each; `None`: infinitely many. Unit: 1.
    pub degrees_of_freedom: Vec<Option<f64>>,
    /// What the machine file states with an uncertainty: its name, and how one standard uncertainty moves each.
    pub stated: Vec<(String, Vec<f64>)>,
}

impl Explained {
    fn of(task: Task<'_>, unlisted: &Unlisted, sizes: &Sizes) -> Result<Self, FitError> {
        let Task { design: listed, readings, weights, .. } = task;
        // The covariance is multiplied by the noise as a whole: that of the priors must not be.
        let in_noise: Vec<f64> = sizes.times.iter().map(|t| t / sizes.noise).collect();
        let priors = unlisted.with_priors(&in_noise);
        let design = listed.with_more(&priors);
        let fit = match priors.is_empty() {
            true => task.fit.clone(),
            // With many unknowns the whole machine may not settle; about the fit of the listed ones it is linear enough.
            false => fit_by(task.rule, &design, readings, weights).or_else(|_| {
                let linear = Rule { model: Model::Linear, ..task.rule };
                fit_by(linear, &design, readings, weights)
            })?,
        };
        let all = Determined::of(&design, &fit);
        let places = places(listed, priors.len());
        let of =
            |c: &DMatrix<f64>| c.select_rows(&places).select_columns(&places) * sizes.noise.powi(2);
        let own = Determined {
            values: places.iter().map(|k| all.values[*k]).collect(),
            covariance: of(&all.covariance),
            seen: of(&all.seen),
            is_determined: places.iter().map(|k| all.is_determined[*k]).collect(),
        };
        Ok(Self { design, fit, listed: own, degrees_of_freedom: Vec::new(), stated: Vec::new() })
    }

    /// Adds what the machine file states with an uncertainty and is not to be determined (docs/model.md eq. 346); that is known exactly
    /// (GUM G.4.3), as G.4.2 counts its degrees of freedom.
    fn add_stated(&mut self, task: Task<'_>) {
        let Task { design: listed, readings, weights, .. } = task;
        let stated = Stated::of(&self.design, readings);
        if stated.names().is_empty() {
            return;
        }
        let moved = stated.moved((&self.design, &self.fit.sight), readings, weights);
        let further = self.design.terms.len() - listed.terms.len();
        let moved = moved.select_rows(&places(listed, further));
        let added = &moved * moved.transpose();
        for (k, freedom) in self.degrees_of_freedom.iter_mut().enumerate() {
            let before = self.listed.covariance[(k, k)];
            let times = if before > 0.0 { 1.0 + added[(k, k)] / before } else { 1.0 };
            *freedom = freedom.map(|count| count * times * times);
        }
        let columns = moved.column_iter().map(|column| column.iter().copied().collect());
        self.stated = stated.names().iter().cloned().zip(columns).collect();
        self.listed.covariance += &added;
        self.listed.seen += added;
    }

    /// The larger uncertainty of both with its degrees of freedom, unknown by unknown: which explanation is right is not
    /// known.
    fn widen(&mut self, other: &Self) {
        let n = self.listed.values.len();
        for k in 0..n {
            if other.listed.u(k) > self.listed.u(k) {
                self.degrees_of_freedom[k] = other.degrees_of_freedom[k];
            }
        }
        larger(&mut self.listed.covariance, &other.listed.covariance);
        let times = larger(&mut self.listed.seen, &other.listed.seen);
        for (_, moves) in &mut self.stated {
            moves.iter_mut().zip(&times).for_each(|(by, times)| *by *= times);
        }
    }
}

/// A covariance with the larger variance of two, unknown by unknown; the correlations stay. How many times each is larger.
fn larger(own: &mut DMatrix<f64>, other: &DMatrix<f64>) -> Vec<f64> {
    let n = own.nrows();
    let times = |k: usize| match own[(k, k)] {
        v if v > 0.0 => (other[(k, k)] / v).sqrt().max(1.0),
        _ => 1.0,
    };
    let times: Vec<f64> = (0..n).map(times).collect();
    own.iter_mut().enumerate().for_each(|(i, v)| *v *= times[i % n] * times[i / n]);
    times
}

/// The listed unknowns with all others, and readings that are linear about the fit of the listed ones.
pub(super) struct Prepared<'a> {
    task: Task<'a>,
    /// The errors that are not listed.
    pub(super) unlisted: Unlisted,
    /// Their groups.
    pub(super) ranges: Vec<Range<usize>>,
    /// The design with both.
    pub(super) all: Design,
    /// The numbers of the unknowns in it: the listed ones first, then the others.
    order: Vec<usize>,
    /// The readings. Unit: mm or rad.
    pub(super) z: Vec<[f64; 3]>,
}

impl<'a> Prepared<'a> {
    /// Of a task.
    pub(super) fn of(task: Task<'a>) -> Self {
        let unlisted = Unlisted::of(task.design, task.readings);
        let ranges = unlisted.groups.clone();
        let all = task.design.with_more(&unlisted.terms);
        let terms = task.design.terms.len();
        let further = terms..terms + unlisted.terms.len();
        let order = places(task.design, unlisted.terms.len()).into_iter().chain(further).collect();
        let z = super::robust::linearised(task.design, task.readings, task.fit);
        Self { task, unlisted, ranges, all, order, z }
    }

    /// The sums of the rows that are wanted, and of what was known before.
    pub(super) fn sums(&self, wanted: impl Fn(usize) -> bool) -> selection::Sums {
        let Task { readings, weights, .. } = self.task;
        let rows: Vec<usize> = (0..readings.len()).filter(|i| wanted(*i)).collect();
        let z: Vec<[f64; 3]> = rows.iter().map(|i| self.z[*i]).collect();
        let weights: Vec<f64> = rows.iter().filter_map(|i| weights.get(*i).copied()).collect();
        let mut sums = selection::Sums::of(&self.all, &readings.filtered(wanted), &z, &weights);
        sums.add(&selection::Sums::of_priors(&self.all), 1.0);
        let normal = sums.normal.select_rows(&self.order).select_columns(&self.order);
        let gradient = DVector::from_fn(self.order.len(), |k, _| sums.gradient[self.order[k]]);
        selection::Sums { normal, gradient, ..sums }
    }

    /// What the listed unknowns leave of these sums.
    pub(super) fn rest(&self, sums: &selection::Sums) -> Option<Rest> {
        let sums = Sums {
            normal: &sums.normal,
            gradient: &sums.gradient,
            square: sums.square,
            numbers: sums.numbers,
            listed: self.task.design.unknowns(),
        };
        Rest::of(sums, &all_before(self.task.design), &self.unlisted.sizes)
    }

    /// The best values of all unknowns for these sums and sizes, in the order of the design with all; 0 for groups of
    /// size 0.
    pub(super) fn values(&self, sums: &selection::Sums, sizes: &Sizes) -> Option<DVector<f64>> {
        let u = self.scale(sizes);
        let n = u.len();
        let right = DVector::from_fn(n, |k, _| sums.gradient[k] * u[k]);
        let solved = scaled(sums, &u).cholesky()?.solve(&right);
        let mut values = DVector::zeros(n);
        for (k, place) in self.order.iter().enumerate() {
            values[*place] = solved[k] * u[k];
        }
        Some(values)
    }

    /// What is not known of each unknown before, in units of the noise that was found: the listed ones first.
    pub(super) fn scale(&self, sizes: &Sizes) -> Vec<f64> {
        let mut u: Vec<f64> = all_before(self.task.design).iter().copied().collect();
        for (range, times) in self.ranges.iter().zip(&sizes.times) {
            u.extend(self.unlisted.sizes[range.clone()].iter().map(|s| s * times / sizes.noise));
        }
        u
    }

    /// How many unknowns are listed.
    pub(super) fn listed(&self) -> usize {
        self.task.design.unknowns()
    }

    /// (N + Λ)⁻¹ of these sums and sizes, in units of the noise that was found: the listed unknowns first.
    pub(super) fn inverse(&self, sums: &selection::Sums, sizes: &Sizes) -> Option<DMatrix<f64>> {
        let u = self.scale(sizes);
        let mut inverse = scaled(sums, &u).cholesky()?.inverse();
        inverse.iter_mut().enumerate().for_each(|(i, v)| *v *= u[i % u.len()] * u[i / u.len()]);
        Some(inverse)
    }

    /// The covariance of all unknowns, in the order of the design with all.
    pub(super) fn covariance(&self, sums: &selection::Sums, sizes: &Sizes) -> Option<DMatrix<f64>> {
        let inverse = self.inverse(sums, sizes)?;
        let mut covariance = inverse.clone();
        for (a, i) in self.order.iter().enumerate() {
            for (b, j) in self.order.iter().enumerate() {
                covariance[(*i, *j)] = inverse[(a, b)] * sizes.noise.powi(2);
            }
        }
        Some(covariance)
    }

    /// What was known before, as normal equations: the listed unknowns first.
    pub(super) fn known_before(&self) -> DMatrix<f64> {
        let known = selection::Sums::of_priors(&self.all).normal;
        known.select_rows(&self.order).select_columns(&self.order)
    }
}

/// The normal equations with what is not known of each before as its unit.
fn scaled(sums: &selection::Sums, u: &[f64]) -> DMatrix<f64> {
    DMatrix::from_fn(u.len(), u.len(), |i, j| {
        let own = if i == j { 1.0 } else { 0.0 };
        sums.normal[(i, j)] * u[i] * u[j] + own
    })
}

/// What could explain the rest, the most evident first: errors that are not listed, more noise, or both.
pub(super) fn explanations(rest: &Rest, ranges: &[Range<usize>]) -> Vec<Sizes> {
    if rest.square <= rest.freedom {
        return vec![Sizes::none(ranges.len())];
    }
    let as_stated = rest.sizes(ranges, false);
    let nothing = rest.deviance(ranges, &vec![0.0; ranges.len()], 1.0);
    if nothing < as_stated.deviance + HINT && rest.square <= chi_square_above(LEVEL, rest.freedom) {
        // By chance: to count it would make every good campaign look worse than it is.
        return vec![Sizes::none(ranges.len())];
    }
    let both = rest.sizes(ranges, true);
    let mut noise = rest.sizes(&[], true);
    noise.times = vec![0.0; ranges.len()];
    match both.deviance + EVIDENCE < as_stated.deviance {
        true => vec![both, as_stated, noise],
        false => vec![as_stated, both, noise],
    }
}

/// One group with the size that the readings show of it, and nothing else.
fn only(rest: &Rest, ranges: &[Range<usize>], group: usize) -> Sizes {
    let alone = rest.sizes(std::slice::from_ref(&ranges[group]), false);
    let mut times = vec![0.0; ranges.len()];
    times[group] = alone.times.first().copied().unwrap_or(0.0);
    Sizes { times, ..alone }
}

/// Each kind alone, the most evident first.
fn kinds(rest: &Rest, unlisted: &Unlisted, ranges: &[Range<usize>], times: &[f64]) -> Vec<Kind> {
    let none = rest.sizes(&[], true);
    let times_of = |range: &Range<usize>| {
        let group = ranges.iter().position(|g| g.contains(&range.start));
        group.map_or(0.0, |g| times[g])
    };
    let kind = |kind: &unlisted::Kind| {
        let alone = rest.sizes(std::slice::from_ref(&kind.range), true);
        let share = 1.0 - (alone.noise / none.noise.max(1.0)).powi(2);
        let evidence = (none.deviance - alone.deviance).max(0.0);
        Kind { follows: kind.follows, times: times_of(&kind.range), evidence, share }
    };
    let mut kinds: Vec<Kind> = unlisted.kinds.iter().map(kind).collect();
    kinds.sort_by(|a, b| b.evidence.total_cmp(&a.evidence));
    kinds
}
