//! A plan for programs: `trueaxis/plan/1`.

use super::stages::{PlannedStageEntry, planned_entries};
use crate::plan::program::ProgramCheck;
use crate::plan::{Chosen, Expectation, Expected, PlanReport, PlannedPath, Seen, Unobservable};
use serde::Serialize;
use trueaxis_measure::unknowns::design::Design;
use trueaxis_report::JsonSchema;

/// What a campaign will show before anybody measures.
#[derive(Debug, Serialize, JsonSchema)]
pub struct PlanDocument<'a> {
    /// Which document this is.
    #[schemars(extend("const" = "trueaxis/plan/1"))]
    pub schema: &'static str,
    /// Name of the campaign.
    pub name: &'a str,
    /// Name of the machine.
    pub machine: &'a str,
    /// The kinematic chain of the machine.
    pub chain: String,
    /// The paths and their programs.
    pub paths: Vec<PathEntry<'a>>,
    /// What each stage will determine; empty if the campaign has none.
    pub stages: Vec<PlannedStageEntry<'a>>,
    /// The uncertainty to expect of each unknown.
    pub expected: Vec<ExpectedEntry<'a>>,
    /// Combinations of unknowns that change no reading.
    pub unobservable: &'a [Unobservable],
    /// Number of combinations of unknowns that are observable.
    pub rank: usize,
    /// Condition number of the design matrix. Unit: 1.
    pub condition: f64,
    /// The choice of poses; null if none was asked for.
    pub chosen: Option<ChosenEntry<'a>>,
}

/// A path and its program.
#[derive(Debug, Serialize, JsonSchema)]
pub struct PathEntry<'a> {
    /// Its name.
    pub name: &'a str,
    /// Number of stations.
    pub stations: usize,
    /// Feed if it is read while moving, mm/min; else null.
    pub feed_mm_per_min: Option<f64>,
    /// Dwell at each station, s.
    pub dwell_s: f64,
    /// Channels of the instrument.
    pub channels: &'a [&'static str],
    /// Unit of the readings below: `um` or `urad`.
    pub unit: &'static str,
    /// The largest reading that 10 µm or 10 µrad of each error causes.
    pub seen_of_10_um_or_urad: Vec<SeenEntry<'a>>,
    /// The check of its program, or why there is none.
    pub program: ProgramEntry<'a>,
}

/// The readings that an error causes.
#[derive(Debug, Serialize, JsonSchema)]
pub struct SeenEntry<'a> {
    /// The error.
    pub error: &'a str,
    /// The largest reading of each channel. Unit: that of the path.
    pub largest: Vec<f64>,
}

/// The check of a program, or why there is none.
#[derive(Debug, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum ProgramEntry<'a> {
    /// There is no program.
    Missing {
        /// Why.
        missing: &'a str,
    },
    /// Its check.
    Checked {
        /// How long it runs, s.
        duration_s: f64,
        /// Whether it has neither errors nor critical issues.
        sound: bool,
        /// Errors of the program itself.
        errors: &'a [String],
        /// Critical issues, such as collisions.
        #[serde(rename = "grave")]
        critical: &'a [String],
        /// Minor issues, such as lost time.
        minor: &'a [String],
    },
}

/// The uncertainty to expect of an unknown.
#[derive(Debug, Serialize, JsonSchema)]
pub struct ExpectedEntry<'a> {
    /// Its name.
    pub name: &'a str,
    /// `um`, `urad`, or `um/m` for a scale.
    pub unit: String,
    /// Standard uncertainty; null if not observable. Unit: that of `unit`.
    pub u: Option<f64>,
    /// Expanded uncertainty (k = 2); null if not observable. Unit: that of `unit`.
    pub expanded_k2: Option<f64>,
}

/// The chosen poses.
#[derive(Debug, Serialize, JsonSchema)]
pub struct ChosenEntry<'a> {
    /// Number of poses.
    pub poses: usize,
    /// Number of poses to choose from.
    pub candidates: usize,
    /// Candidates left out because of collisions or travel limits.
    pub blocked: usize,
    /// Number of readings.
    pub readings: usize,
    /// Duration of the measurement, s.
    pub time_s: f64,
    /// The criterion at the start and after every exchange. Unit: 1.
    pub criterion: &'a [f64],
    /// The uncertainties to expect.
    pub expected: Vec<ExpectedEntry<'a>>,
    /// A plain grid of as many poses, to compare with; null if there is none.
    pub grid: Option<GridEntry<'a>>,
}

/// A plain grid of poses.
#[derive(Debug, Serialize, JsonSchema)]
pub struct GridEntry<'a> {
    /// Number of poses.
    pub poses: usize,
    /// The uncertainties to expect.
    pub expected: Vec<ExpectedEntry<'a>>,
}

impl<'a> PlanDocument<'a> {
    /// The document of a plan.
    pub fn of(report: &'a PlanReport) -> Self {
        let (campaign, design) = (&report.plan.campaign, &report.design);
        let expectation = &report.expectation;
        Self {
            schema: "trueaxis/plan/1",
            name: &campaign.name,
            machine: campaign.machine.name(),
            chain: campaign.machine.chain_text(),
            paths: report.paths.iter().map(PathEntry::from).collect(),
            stages: planned_entries(&report.design, &report.stages),
            expected: expected(design, expectation),
            unobservable: &expectation.unobservable,
            rank: expectation.rank,
            condition: expectation.condition,
            chosen: report.chosen.as_ref().map(|chosen| ChosenEntry::of(design, chosen)),
        }
    }
}

fn expected<'a>(design: &Design, expectation: &'a Expectation) -> Vec<ExpectedEntry<'a>> {
    let one = |expected: &'a Expected| {
        let (unit, scale) = design.shown_unit(expected.unknown);
        ExpectedEntry {
            name: &expected.name,
            unit: unit.replace('µ', "u"),
            u: expected.u.map(|u| u * scale),
            expanded_k2: expected.u.map(|u| 2.0 * u * scale),
        }
    };
    expectation.unknowns.iter().map(one).collect()
}

impl<'a> ChosenEntry<'a> {
    fn of(design: &Design, chosen: &'a Chosen) -> Self {
        Self {
            poses: chosen.poses,
            candidates: chosen.candidates,
            blocked: chosen.blocked,
            readings: chosen.stations.len(),
            time_s: chosen.time_s,
            criterion: &chosen.history,
            expected: expected(design, &chosen.expectation),
            grid: chosen
                .grid
                .as_ref()
                .map(|(poses, grid)| GridEntry { poses: *poses, expected: expected(design, grid) }),
        }
    }
}

impl<'a> From<&'a PlannedPath> for PathEntry<'a> {
    fn from(planned: &'a PlannedPath) -> Self {
        let path = &planned.path;
        let is_angle = planned.channels == ["angle"];
        let scale = if is_angle { 1e6 } else { 1e3 };
        let seen = |seen: &'a Seen| SeenEntry {
            error: &seen.name,
            largest: seen.largest.iter().map(|v| v * scale).collect(),
        };
        Self {
            name: &path.name,
            stations: path.stations.len(),
            feed_mm_per_min: path.feed_mm_per_s.map(|f| f * 60.0),
            dwell_s: path.dwell_s,
            channels: planned.channels,
            unit: if is_angle { "urad" } else { "um" },
            seen_of_10_um_or_urad: planned.seen.iter().map(seen).collect(),
            program: ProgramEntry::from(&planned.check),
        }
    }
}

impl<'a> From<&'a Result<ProgramCheck, String>> for ProgramEntry<'a> {
    fn from(check: &'a Result<ProgramCheck, String>) -> Self {
        match check {
            Err(missing) => Self::Missing { missing },
            Ok(check) => Self::Checked {
                duration_s: check.duration_s,
                sound: check.is_sound(),
                errors: &check.errors,
                critical: &check.critical,
                minor: &check.minor,
            },
        }
    }
}
