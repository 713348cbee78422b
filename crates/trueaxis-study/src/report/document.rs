//! The document of a study.

use crate::distribution::Distribution;
use crate::findings::{CombinationFindings, Findings, Good, OutputFindings};
use crate::inputs::Input;
use crate::sensitivity::{GroupShares, Share};
use crate::study::Study;
use crate::table::input_unit;
use serde::Serialize;
use trueaxis_report::JsonSchema;

/// Many machines on many days: `trueaxis/study/1`.
#[derive(Debug, Serialize, JsonSchema)]
pub struct StudyDocument<'a> {
    /// Which document this is.
    #[schemars(extend("const" = "trueaxis/study/1"))]
    pub schema: &'static str,
    /// The name of the study.
    pub name: &'a str,
    /// Which samples there are.
    pub design: DesignEntry,
    /// What is varied.
    pub inputs: Vec<InputEntry<'a>>,
    /// What every machine makes.
    pub cases: Vec<CaseEntry<'a>>,
    /// What is asked of the machines; null if nothing is.
    pub requirement: Option<RequirementEntry>,
    /// `pass`, `fail` or `undecided`: whether it is met, at one combination if there are several; null if nothing is asked.
    pub outcome: Option<&'static str>,
    /// The combinations of levels of a factorial design; else one.
    pub combinations: Vec<CombinationEntry<'a>>,
    /// What makes the variance of each output; empty without a sensitivity analysis.
    pub sensitivities: Vec<SensitivityEntry<'a>>,
}

/// Which samples there are.
#[derive(Debug, Serialize, JsonSchema)]
pub struct DesignEntry {
    /// `monte-carlo`, `latin-hypercube`, `sobol` or `factorial`.
    pub kind: &'static str,
    /// Machines, of each combination.
    pub machines: usize,
    /// Days of each machine.
    pub days: usize,
    /// The random seed.
    pub seed: u64,
    /// Combinations of levels.
    pub combinations: usize,
    /// Rows of the sensitivity analysis.
    pub sensitivity_rows: usize,
    /// All samples.
    pub samples: usize,
}

/// One input.
#[derive(Debug, Serialize, JsonSchema)]
pub struct InputEntry<'a> {
    /// Its name.
    pub name: &'a str,
    /// The inputs whose effect is found together.
    pub group: &'a str,
    /// `machine`, `day` or `hall`: how often it is drawn.
    pub per: &'static str,
    /// `normal`, `uniform`, `triangular`, `arcsine` or `values`.
    pub distribution: &'static str,
    /// The unit of mean and u: mm, rad, degC, s or 1.
    pub unit: &'static str,
    /// Its mean. Unit: that of `unit`.
    pub mean: f64,
    /// Its standard deviation. Unit: that of `unit`.
    pub u: f64,
}

/// What every machine makes.
#[derive(Debug, Serialize, JsonSchema)]
pub struct CaseEntry<'a> {
    /// Its name in the study.
    pub name: &'a str,
    /// Its study file.
    pub study: &'a str,
    /// The machine.
    pub machine: &'a str,
}

/// What is asked of the machines.
#[derive(Debug, Serialize, JsonSchema)]
pub struct RequirementEntry {
    /// The share of machines that hold their tolerances. Unit: 1.
    pub machines_ratio: f64,
    /// On this share of days. Unit: 1.
    pub days_ratio: f64,
}

/// One combination of levels.
#[derive(Debug, Serialize, JsonSchema)]
pub struct CombinationEntry<'a> {
    /// The value of each factorial input.
    pub levels: Vec<LevelEntry<'a>>,
    /// The outputs, case after case.
    pub outputs: Vec<OutputEntry<'a>>,
    /// Machines and parts that hold all tolerances of each case; null for a case without any.
    pub cases: Vec<Option<GoodEntry>>,
    /// Those that hold all of them; null if there are none.
    pub good: Option<GoodEntry>,
    /// `pass`, `fail` or `undecided`; null if nothing is asked.
    pub outcome: Option<&'static str>,
}

/// The value of a factorial input.
#[derive(Debug, Serialize, JsonSchema)]
pub struct LevelEntry<'a> {
    /// The input.
    pub input: &'a str,
    /// Its unit: mm, rad, degC, s or 1.
    pub unit: &'static str,
    /// Its value. Unit: that of `unit`.
    pub value: f64,
}

/// The spread of one output.
#[derive(Debug, Serialize, JsonSchema)]
pub struct OutputEntry<'a> {
    /// Its case.
    pub case: &'a str,
    /// Its key.
    pub key: &'a str,
    /// The least value allowed; null without one, mm.
    pub low_limit_mm: Option<f64>,
    /// The largest value allowed; null without one, mm.
    pub high_limit_mm: Option<f64>,
    /// Mean of all machines and days, mm.
    pub mean_mm: f64,
    /// Standard deviation; null of a single part, mm.
    pub u_mm: Option<f64>,
    /// 2.5 % quantile, mm.
    pub low_mm: f64,
    /// 97.5 % quantile, mm.
    pub high_mm: f64,
    /// The smallest value, mm.
    pub least_mm: f64,
    /// The largest value, mm.
    pub largest_mm: f64,
    /// The share of parts on which it is in tolerance; null without a limit. Unit: 1.
    pub good_ratio: Option<f64>,
    /// Standard deviation from machine to machine; null for one machine or one day, mm.
    pub machines_u_mm: Option<f64>,
    /// From day to day, the same for all machines; null for one machine or one day, mm.
    pub days_u_mm: Option<f64>,
    /// Of a machine on a day alone; null for one machine or one day, mm.
    pub rest_u_mm: Option<f64>,
    /// Where the first cell of the histogram begins, mm.
    pub histogram_from_mm: f64,
    /// The width of its cells, mm.
    pub histogram_width_mm: f64,
    /// How many values each cell has.
    pub histogram: &'a [usize],
}

/// Machines and parts that hold their tolerances.
#[derive(Debug, Serialize, JsonSchema)]
pub struct GoodEntry {
    /// The share of parts. Unit: 1.
    pub parts_ratio: f64,
    /// Its standard uncertainty; null where all machines have the same share. Unit: 1.
    pub u_parts_ratio: Option<f64>,
    /// How many machines.
    pub machines: usize,
    /// The share of machines. Unit: 1.
    pub machines_ratio: f64,
    /// The ends of its interval of 95 %. Unit: 1.
    pub machines_interval_ratio: [f64; 2],
}

/// What makes the variance of one output.
#[derive(Debug, Serialize, JsonSchema)]
pub struct SensitivityEntry<'a> {
    /// Its case.
    pub case: &'a str,
    /// Its key.
    pub key: &'a str,
    /// The groups of inputs; null if the output does not vary.
    pub groups: Option<Vec<GroupEntry<'a>>>,
}

/// The indices of Sobol' of one group.
#[derive(Debug, Serialize, JsonSchema)]
pub struct GroupEntry<'a> {
    /// The group.
    pub group: &'a str,
    /// First index: of the group alone. Unit: 1.
    pub first_ratio: f64,
    /// Its standard uncertainty. Unit: 1.
    pub u_first_ratio: f64,
    /// Total index: with all interactions. Unit: 1.
    pub total_ratio: f64,
    /// Its standard uncertainty. Unit: 1.
    pub u_total_ratio: f64,
}

impl<'a> StudyDocument<'a> {
    /// The document of a study.
    pub fn of(study: &'a Study, findings: &'a Findings) -> Self {
        let design = &study.design;
        Self {
            schema: "trueaxis/study/1",
            name: &study.name,
            design: DesignEntry {
                kind: design.word(),
                machines: design.machines,
                days: design.days,
                seed: design.seed,
                combinations: design.combinations(),
                sensitivity_rows: design.sensitivity,
                samples: design.samples(),
            },
            inputs: study.inputs.iter().map(InputEntry::of).collect(),
            cases: study
                .cases
                .iter()
                .map(|c| CaseEntry { name: &c.name, study: &c.file, machine: c.machine().name() })
                .collect(),
            requirement: study.requirement.map(|r| RequirementEntry {
                machines_ratio: r.machines_ratio,
                days_ratio: r.days_ratio,
            }),
            outcome: findings.outcome().map(|o| o.word()),
            combinations: findings
                .combinations
                .iter()
                .map(|one| CombinationEntry::of(study, one))
                .collect(),
            sensitivities: named_outputs(study)
                .zip(&findings.shares)
                .map(|((case, output), shares)| SensitivityEntry {
                    case: &case.name,
                    key: &output.key,
                    groups: shares.as_ref().map(|shares| group_entries(study, shares)),
                })
                .collect(),
        }
    }
}

/// Every output with its case.
pub(super) fn named_outputs(study: &Study) -> impl Iterator<Item = (&crate::Case, &crate::Output)> {
    study.cases.iter().flat_map(|case| case.outputs.iter().map(move |output| (case, output)))
}

fn group_entries<'a>(study: &'a Study, shares: &[GroupShares]) -> Vec<GroupEntry<'a>> {
    let entry = |(group, shares): (&'a String, &GroupShares)| {
        let GroupShares { first, total } = *shares;
        let (Share { ratio: first_ratio, u_ratio: u_first_ratio }, total) = (first, total);
        GroupEntry {
            group,
            first_ratio,
            u_first_ratio,
            total_ratio: total.ratio,
            u_total_ratio: total.u_ratio,
        }
    };
    study.groups.iter().zip(shares).map(entry).collect()
}

impl<'a> InputEntry<'a> {
    fn of(input: &'a Input) -> Self {
        Self {
            name: &input.name,
            group: &input.group,
            per: input.level.word(),
            distribution: input.distribution.word(),
            unit: input_unit(&input.varied),
            mean: Distribution::mean(&input.distribution),
            u: input.distribution.u(),
        }
    }
}

impl<'a> LevelEntry<'a> {
    fn of(input: &'a Input, value: f64) -> Self {
        Self { input: &input.name, unit: input_unit(&input.varied), value }
    }
}

impl<'a> CombinationEntry<'a> {
    fn of(study: &'a Study, one: &'a CombinationFindings) -> Self {
        let levels = study.design.levels.iter().zip(&one.levels);
        Self {
            levels: levels
                .map(|((input, _), value)| LevelEntry::of(&study.inputs[*input], *value))
                .collect(),
            outputs: named_outputs(study)
                .zip(&one.outputs)
                .map(|((case, output), found)| OutputEntry::of(case, output, found))
                .collect(),
            cases: one.cases.iter().map(|good| good.as_ref().map(GoodEntry::of)).collect(),
            good: one.good.as_ref().map(GoodEntry::of),
            outcome: one.outcome.map(|o| o.word()),
        }
    }
}

impl<'a> OutputEntry<'a> {
    fn of(case: &'a crate::Case, output: &'a crate::Output, found: &'a OutputFindings) -> Self {
        let (spread, components) = (&found.spread, found.components);
        Self {
            case: &case.name,
            key: &output.key,
            low_limit_mm: output.low_mm,
            high_limit_mm: output.high_mm,
            mean_mm: spread.mean_mm,
            u_mm: spread.u_mm,
            low_mm: spread.low_mm,
            high_mm: spread.high_mm,
            least_mm: spread.least_mm,
            largest_mm: spread.largest_mm,
            good_ratio: found.good_ratio,
            machines_u_mm: components.map(|c| c.machines_mm),
            days_u_mm: components.map(|c| c.days_mm),
            rest_u_mm: components.map(|c| c.rest_mm),
            histogram_from_mm: spread.histogram.from_mm,
            histogram_width_mm: spread.histogram.width_mm,
            histogram: &spread.histogram.counts,
        }
    }
}

impl GoodEntry {
    fn of(good: &Good) -> Self {
        Self {
            parts_ratio: good.parts_ratio,
            u_parts_ratio: good.u_parts_ratio,
            machines: good.machines,
            machines_ratio: good.machines_ratio,
            machines_interval_ratio: good.interval_ratio,
        }
    }
}
