//! Predict: the part that this machine will cut, before it is cut.
//!
//! ```text
//!     Study ──Cutting::new──> commands ──deviations──> [E_v] ──TestPiece::evaluate──> indices
//!       │                                     └─ errors changed: budget, sensitivity, Monte Carlo
//!       └─ tolerances ──judge──> verdict
//! ```

pub mod acted;
mod budget;
mod correction;
mod cutting;
pub mod drawing;
mod feed;
pub mod holes;
mod judge;
pub mod location;
mod monte_carlo;
mod program;
mod running;
mod sensitivity;
mod servo;
mod set_up;
mod study;
mod temperatures;
mod virtual_part;
mod what_if;

pub use budget::{ErrorBudget, Share, budget};
pub use correction::{Correction, corrections};
pub use cutting::{Cutting, DatumAxis, Reference};
pub use feed::ConditionResult;
pub use judge::{Bench, Judge};
pub use monte_carlo::{Sampling, Spread, draw, monte_carlo};
pub use program::CutProgram;
pub use sensitivity::{Sensitivity, propagate, sensitivities};
pub use servo::{AxisServo, Known, Servo};
pub use set_up::{MeasuredLength, SetUpReadings};
pub use study::{Decision, Published, PublishedRow, Study, Variant, parse_study, read_study};
pub use temperatures::{Pace, RunningTemperatures};
pub use virtual_part::{VirtualPart, cut_virtually};
pub use what_if::{ErrorChange, WhatIf};

use trueaxis_geometry::Vec3;
use trueaxis_machine::Machine;
use trueaxis_machine::axis::Command;
use trueaxis_machine::chain::CommandFault;
use trueaxis_machine::{FollowError, FollowFault, SolveError};
use trueaxis_part::testpiece::{IndexName, PartSection};
use trueaxis_part::tolerance::{Outcome, Verdict};

/// The pose of the tool when the part zero was found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Setting {
    /// The zero is where it should be: no error of the machine went into it.
    Perfect,
    /// Touched with the tip, the rotary axes standing at these positions (rad).
    Touched {
        /// Only the rotary entries count; the linear axes follow from the zero.
        rotary: Command,
    },
}

impl Default for Setting {
    /// C = A = 0, as in Wu et al. 2022.
    fn default() -> Self {
        Self::Touched { rotary: Command::default() }
    }
}

/// Why a part cannot be predicted.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// The path cannot be followed.
    #[error("{0}")]
    Path(#[source] FollowError),
    /// The setting point cannot be reached.
    #[error("the tool-setting point: {0}")]
    Setting(#[source] SolveError),
    /// The setting point lies outside the travel.
    #[error("the tool-setting point lies outside the travel with these rotary positions")]
    SettingOutOfTravel,
    /// The reference hole cannot be bored.
    #[error("the reference hole: {0}")]
    Hole(#[source] FollowError),
    /// A command lies where an error table says nothing.
    #[error("{}{source}", position.map_or(String::new(), |p| format!("tool position {p}: ")))]
    Table {
        /// The tool position, counted from 0; none for the setting point.
        position: Option<usize>,
        /// Which table.
        source: CommandFault,
    },
    /// The log of temperatures does not cover the cut.
    #[error(
        "tool position {position} is cut after {time_s:.1} s, the log ends after {lasts_s:.1} s"
    )]
    LogEnds {
        /// The tool position, counted from 0.
        position: usize,
        /// Its time, s.
        time_s: f64,
        /// How long the log goes on after the start, s.
        lasts_s: f64,
    },
    /// The program cuts something else.
    #[error(
        "the program comes no nearer than {by_mm:.3} mm to tool position {position} of the test piece"
    )]
    Program {
        /// The tool position, counted from 0.
        position: usize,
        /// How far it stays away, mm.
        by_mm: f64,
    },
    /// The points cannot be evaluated.
    #[error("{0}")]
    Evaluation(#[source] trueaxis_part::Error),
    /// A Monte Carlo run needs at least two samples.
    #[error("a Monte Carlo run needs at least 2 samples, not {0}")]
    TooFewSamples(usize),
}

impl Error {
    /// A stable name for programs.
    pub fn code(&self) -> &'static str {
        let solving = |error: &SolveError| match error {
            SolveError::Unreachable { .. } => "unreachable-direction",
            SolveError::TipUnreachable { .. } => "unreachable-tip",
            SolveError::NotFinite => "not-finite",
        };
        match self {
            Self::Path(e) | Self::Hole(e) => match &e.fault {
                FollowFault::Solve(fault) => solving(fault),
                FollowFault::LeavesTravel { .. } => "path-leaves-travel",
                FollowFault::Jump { .. } => "path-jumps",
            },
            Self::Setting(fault) => solving(fault),
            Self::SettingOutOfTravel => "path-leaves-travel",
            Self::Table { .. } => "outside-table",
            Self::LogEnds { .. } => "log-ends",
            Self::Program { .. } => "other-part",
            Self::Evaluation(_) => "not-evaluable",
            Self::TooFewSamples(_) => "too-few-samples",
        }
    }
}

/// One index of the part.
#[derive(Debug, Clone, PartialEq)]
pub struct Index {
    /// Which one.
    pub name: IndexName,
    /// Its value, mm.
    pub value_mm: f64,
    /// Its standard uncertainty by linear propagation, mm.
    pub u_mm: f64,
    /// What the Monte Carlo run says, if there was one.
    pub spread: Option<Spread>,
}

/// The same part under another setting point or datum.
#[derive(Debug, Clone, PartialEq)]
pub struct VariantResult {
    /// What is different.
    pub name: String,
    /// All indices, mm, in the order of [`Prediction::indices`].
    pub indices_mm: Vec<f64>,
}

/// One height of the part with the uncertainty of its indices.
#[derive(Debug, Clone)]
pub struct SectionResult {
    /// Profile, fitted circles, indices.
    pub section: PartSection,
    /// Standard uncertainty of each of its indices by linear propagation, mm.
    pub u_mm: Vec<f64>,
}

/// All that was found out about the part.
#[derive(Debug, Clone)]
pub struct Prediction {
    /// Every index of the test piece.
    pub indices: Vec<Index>,
    /// The indices against their tolerances.
    pub verdict: Verdict,
    /// The command at the tool-setting point.
    pub setting_command: Command,
    /// The commands of the path.
    pub commands: Vec<Command>,
    /// The deviation E_v at every contact point, mm, position after position.
    pub deviations_mm: Vec<Vec3>,
    /// The profiles, from the base upwards.
    pub sections: Vec<SectionResult>,
    /// The error budget.
    pub budget: ErrorBudget,
    /// What each location error does to each index.
    pub sensitivities: Vec<Sensitivity>,
    /// Single corrections that would make a failing part pass; empty if it passes.
    pub corrections: Vec<Correction>,
    /// Other setting points and datums.
    pub variants: Vec<VariantResult>,
    /// The part at the feed of every cutting condition, if the study states how the axes follow.
    pub conditions: Vec<ConditionResult>,
    /// What the reader of the numbers should know.
    pub warnings: Vec<String>,
}

impl Prediction {
    /// The verdict, that of every cutting condition with it.
    pub fn outcome(&self) -> Outcome {
        let all = self.conditions.iter().map(|c| c.verdict.outcome);
        all.fold(self.verdict.outcome, |all, one| match (all, one) {
            (Outcome::Fail, _) | (_, Outcome::Fail) => Outcome::Fail,
            (Outcome::Undecided, _) | (_, Outcome::Undecided) => Outcome::Undecided,
            (Outcome::Pass, Outcome::Pass) => Outcome::Pass,
        })
    }
}

/// Predicts the part of a study: the whole walk from machine to verdict.
///
/// `progress` is called with the number of Monte Carlo samples done.
///
/// # Errors
/// A path, setting point or reference hole that the machine cannot do, with its place.
///
/// # Source
/// Wu et al. 2022 with its errata; docs/model.md eq. 18 to 33.
pub fn predict(study: &Study, progress: &(dyn Fn(usize) + Sync)) -> Result<Prediction, Error> {
    let (machine, piece) = (&study.machine, study.piece());
    let (temperatures, program) = (study.temperatures.as_ref(), study.program.as_ref());
    let cutting = Cutting::along(machine, piece, &study.reference, temperatures, program)?;
    let judge = Judge { cutting: &cutting, piece };
    let mut prediction = predicted(study, &judge, progress)?;
    prediction.conditions = feed::conditions(study)?;
    prediction.warnings.extend(feed::remarks(study, &prediction.conditions));
    if prediction.verdict.outcome != Outcome::Pass {
        prediction.corrections = remedies(study, &judge, &prediction.indices)?;
    }
    Ok(prediction)
}

/// The same without the search for corrections: fast enough to follow a slider.
///
/// # Errors
/// As [`predict`].
pub fn preview(study: &Study) -> Result<Prediction, Error> {
    let (machine, piece) = (&study.machine, study.piece());
    let cutting = Cutting::over(machine, piece, &study.reference, study.temperatures.as_ref())?;
    predicted(study, &Judge { cutting: &cutting, piece }, &|_| ())
}

fn predicted(
    study: &Study,
    judge: &Judge<'_>,
    progress: &(dyn Fn(usize) + Sync),
) -> Result<Prediction, Error> {
    let machine = &study.machine;
    let (deviations_mm, sections) = sections(machine, judge)?;
    let indices = indices(study, judge, progress)?;
    let verdict = verdict(study, &indices)?;
    Ok(Prediction {
        warnings: warnings(study, &indices, &sections),
        setting_command: *judge.cutting.setting_command(),
        commands: judge.cutting.commands().copied().collect(),
        budget: budget(machine, judge)?,
        sensitivities: sensitivities(machine, judge)?,
        variants: variants(study)?,
        conditions: Vec::new(),
        indices,
        verdict,
        deviations_mm,
        sections,
        corrections: Vec::new(),
    })
}

fn verdict(study: &Study, indices: &[Index]) -> Result<Verdict, Error> {
    let values: Vec<f64> = indices.iter().map(|i| i.value_mm).collect();
    let expanded = study.expanded_mm(indices);
    study.judge(&values, expanded.as_deref()).map_err(Error::Evaluation)
}

/// Single corrections after which the part would pass by the study's own rule. They are searched for with
/// the uncertainties as they are; those after the correction then decide how much more it takes.
fn remedies(study: &Study, judge: &Judge<'_>, indices: &[Index]) -> Result<Vec<Correction>, Error> {
    let passes = |values: &[f64], expanded: Option<&[f64]>| {
        study.judge(values, expanded).is_ok_and(|v| v.outcome == Outcome::Pass)
    };
    let expanded = study.expanded_mm(indices);
    let found = corrections(&study.machine, judge, &|v| passes(v, expanded.as_deref()))?;
    if expanded.is_none() {
        return Ok(found);
    }
    let really = |values: &[f64], u_mm: &[f64]| {
        let corrected = indices.iter().zip(values).zip(u_mm);
        let corrected = corrected.map(|((i, value), u)| Index {
            value_mm: *value,
            u_mm: *u,
            spread: None,
            ..i.clone()
        });
        passes(values, study.expanded_mm(&corrected.collect::<Vec<_>>()).as_deref())
    };
    let mut all = Vec::new();
    for correction in found {
        all.extend(correction.enough(&study.machine, judge, &really)?);
    }
    all.sort_by(|a, b| a.effort().total_cmp(&b.effort()));
    Ok(all)
}

fn sections(
    machine: &Machine,
    judge: &Judge<'_>,
) -> Result<(Vec<Vec3>, Vec<SectionResult>), Error> {
    let (deviations_mm, sections) = judge.sections(&|errors, _| *errors)?;
    let count = judge.index_count();
    let u = propagate(machine, &|change| {
        let (_, sections) = judge.sections(change)?;
        let values = sections.iter().flat_map(|s| s.indices_mm.iter());
        Ok(values.map(|v| v.unwrap_or(0.0)).collect())
    })?;
    let u_of = |i: usize| u.get(i * count..(i + 1) * count).map_or(vec![0.0; count], <[_]>::to_vec);
    let results = sections.into_iter().enumerate();
    let results = results.map(|(i, section)| SectionResult { section, u_mm: u_of(i) }).collect();
    Ok((deviations_mm, results))
}

fn indices(
    study: &Study,
    judge: &Judge<'_>,
    progress: &(dyn Fn(usize) + Sync),
) -> Result<Vec<Index>, Error> {
    let values = judge.once(&|errors, _| *errors)?;
    let mut u = propagate(&study.machine, &|change| judge.once(change))?;
    u.resize(values.len(), 0.0); // no stated error: nothing was propagated
    let spreads = match study.sampling {
        Some(sampling) => Some(monte_carlo(&study.machine, judge, sampling, progress)?),
        None => None,
    };
    let names = judge.piece.index_names().iter();
    Ok(names
        .enumerate()
        .map(|(i, name)| Index {
            name: *name,
            value_mm: values[i],
            u_mm: u[i],
            spread: spreads.as_ref().map(|s| s[i]),
        })
        .collect())
}

fn variants(study: &Study) -> Result<Vec<VariantResult>, Error> {
    let (machine, piece) = (&study.machine, study.piece());
    let program = study.program.as_ref();
    let result = |name: &str, reference, temperatures, program| {
        let cutting = Cutting::along(machine, piece, reference, temperatures, program)?;
        let indices_mm = Judge { cutting: &cutting, piece }.once(&|errors, _| *errors)?;
        Ok(VariantResult { name: name.to_owned(), indices_mm })
    };
    let temperatures = study.temperatures.as_ref();
    let others =
        study.variants.iter().map(|v| result(&v.name, &v.reference, temperatures, program));
    let held = temperatures.map(|_| result(HELD, &study.reference, None, program));
    let ideal = program.map(|_| result(IDEAL, &study.reference, temperatures, None));
    ideal.into_iter().chain(others).chain(held).collect()
}

/// The variant beside a study over a log.
const HELD: &str = "the temperatures of the start, held";

/// The variant beside a study of a program.
const IDEAL: &str = "before: the path of the test piece itself, not compensated";

/// What a reader of the verdict alone would miss.
fn warnings(study: &Study, indices: &[Index], sections: &[SectionResult]) -> Vec<String> {
    let mut warnings = other_sections(study, indices, sections);
    let is_exact = study.machine.stated_errors().is_empty() && !study.machine.is_at_temperatures();
    if is_exact {
        warnings.push("the machine file states no errors: this is the nominal part".to_owned());
    }
    let missing = |i: &Index| i.u_mm == 0.0;
    if !is_exact && indices.iter().all(missing) {
        warnings.push("the machine file states no uncertainties: u is 0 throughout".to_owned());
    }
    if let Some([(x, u), (y, _)]) = study.set_up.and_then(|s| s.centre_mm) {
        let [x, y, u] = [x, y, u].map(|mm| mm * 1e3);
        warnings.push(format!(
            "the centre of the blank lies {x:+.2} {y:+.2} µm (u = {u:.2} µm) from the zero in x and y: the indices are \
             those against the zero or its reference hole, where it does not count"
        ));
    }
    if study.reference.datum == DatumAxis::BestFit {
        warnings.push(
            "in the best fit the part has no datum: coaxiality and angularity say nothing about its axis"
                .to_owned(),
        );
    }
    for index in indices {
        let Some(spread) = index.spread else { continue };
        let off_mm = (spread.u_mm - index.u_mm).abs();
        // Below 0.01 µm both are nothing.
        if off_mm > 0.15 * index.u_mm.max(spread.u_mm) && off_mm > 1e-5 {
            warnings.push(format!(
                "{}: u is {:.2} µm by linear propagation, {:.2} µm by Monte Carlo: the index has a \
                 kink here; with a guard band the larger one counts",
                index.name.title(),
                index.u_mm * 1e3,
                spread.u_mm * 1e3
            ));
        }
    }
    warnings
}

/// The verdict looks at one section; another one may be out of tolerance.
fn other_sections(study: &Study, indices: &[Index], sections: &[SectionResult]) -> Vec<String> {
    let mut warnings = Vec::new();
    for (i, index) in indices.iter().enumerate().filter(|(_, i)| i.name.decisive) {
        let Some(limit_mm) = study.tolerances.limit_mm(index.name.key) else { continue };
        for (number, result) in sections.iter().enumerate() {
            let Some(value) = result.section.indices_mm[i].filter(|v| *v > limit_mm) else {
                continue;
            };
            if index.value_mm <= limit_mm {
                warnings.push(format!(
                    "{} at position {} (z = {:.0} mm) is {:.2} µm and out of tolerance, but the \
                     verdict is on another position",
                    index.name.title(),
                    number + 1,
                    result.section.z_mm,
                    value * 1e3
                ));
            }
        }
    }
    warnings
}
