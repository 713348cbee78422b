//! The document `trueaxis/verify/1`.

use super::comparison::rule;
use crate::verify::compare::{
    Comparison, ComparisonBasis, ComparisonResult, Coverage, Deviation, Summary,
};
use serde::Serialize;
use trueaxis_measure::instruments::instrument::Instrument;
use trueaxis_measure::measure::virtual_campaign::shown_unit;
use trueaxis_report::JsonSchema;
use trueaxis_report::Keyed;

/// Readings compared with a prediction, or with other readings.
#[derive(Debug, Serialize, JsonSchema)]
pub struct VerifyDocument<'a> {
    /// Which document this is.
    #[schemars(extend("const" = "trueaxis/verify/1"))]
    pub schema: &'static str,
    /// The name of the comparison.
    pub name: &'a str,
    /// What the readings are compared with: `prediction` or `readings`.
    pub against: &'static str,
    /// How many readings.
    pub readings: usize,
    /// The coverage factor k of U = k·u. Unit: 1.
    pub coverage_factor: f64,
    /// The decision rule in words.
    pub rule: String,
    /// `pass`, `fail` or `undecided`.
    pub verdict: &'static str,
    /// How many numbers pass.
    pub pass: usize,
    /// How many fail.
    pub fail: usize,
    /// How many are neither.
    pub undecided: usize,
    /// The share of all numbers within U.
    pub coverage: CoverageEntry,
    /// By instrument.
    pub instruments: Vec<PartEntry<'a>>,
    /// By place, the worst first.
    pub places: Vec<PlacePartEntry<'a>>,
    /// What the readings make of what is stated of the set-up with an uncertainty.
    pub set_up: Vec<SetUpEntry<'a>>,
    /// Every number.
    pub deviations: Vec<DifferenceEntry<'a>>,
}

/// An unknown of the set-up: `deviation_um`, fitted − stated, and `u_um`, its standard uncertainty where machine file and statement are
/// right; `…_urad`, `…_um_per_m`, `…_um_per_h` or `…_urad_per_h` by the kind of the unknown.
#[derive(Debug, Serialize, JsonSchema)]
pub struct SetUpEntry<'a> {
    /// The name of the instrument.
    pub instrument: &'a str,
    /// The unknown.
    pub unknown: &'a str,
    /// Whether the readings contradict machine file and statement together: the verdict is `fail` then.
    pub is_contradicted: bool,
    /// Deviation and uncertainty.
    #[serde(flatten)]
    pub values: Keyed<f64>,
}

/// A share of numbers within U.
#[derive(Debug, Serialize, JsonSchema)]
pub struct CoverageEntry {
    /// How many numbers.
    pub numbers: usize,
    /// How many of them are within U.
    pub inside: usize,
    /// The number of independent ones: errors of the machine shift many readings at once. Unit: 1.
    pub independent: f64,
    /// `inside` over `numbers`. Unit: 1.
    pub share: f64,
    /// The 95 % interval of the share (Wilson). Unit: 1.
    pub interval_95: [f64; 2],
    /// The share that is expected. Unit: 1.
    pub expected: f64,
}

/// The numbers of an instrument or a place. Its root mean squares are `rms_nominal_um` (nominal machine; null
/// against readings) and `rms_um` (machine file, or between the two sets of readings), µm; `…_urad`, µrad, of an
/// instrument that measures angles.
#[derive(Debug, Serialize, JsonSchema)]
pub struct PartEntry<'a> {
    /// The name of the instrument.
    pub instrument: &'a str,
    /// The share within U.
    pub coverage: CoverageEntry,
    /// The root mean squares.
    #[serde(flatten)]
    pub rms: Keyed<Option<f64>>,
    /// The largest |deviation| / U; null where U is 0. Unit: 1.
    pub largest_ratio: Option<f64>,
}

/// The numbers of a place.
#[derive(Debug, Serialize, JsonSchema)]
pub struct PlacePartEntry<'a> {
    /// Its figures.
    #[serde(flatten)]
    pub part: PartEntry<'a>,
    /// The number of the place.
    pub group: u32,
    /// A line of the readings there.
    pub line: u32,
}

/// One number: `deviation_um`, measured − expected, and `expanded_um`, its U, in µm; `…_urad` in µrad.
#[derive(Debug, Serialize, JsonSchema)]
pub struct DifferenceEntry<'a> {
    /// The name of the instrument.
    pub instrument: &'a str,
    /// The line of its reading.
    pub line: u32,
    /// The channel of the instrument, from 0.
    pub channel: usize,
    /// Deviation and U.
    #[serde(flatten)]
    pub values: Keyed<f64>,
}

impl<'a> VerifyDocument<'a> {
    /// The document of a comparison.
    pub fn of(task: &'a Comparison, verified: &'a ComparisonResult) -> Self {
        let part = |p: &Summary, instrument: u32| {
            PartEntry::of(&task.campaign.instruments[instrument as usize], p)
        };
        let places = verified.places.iter().map(|place| PlacePartEntry {
            part: part(&place.part, place.instrument),
            group: place.part.index,
            line: verified.readings.lines[place.row],
        });
        let deviations = verified.deviations.iter().map(|d| {
            let instrument = verified.readings.instruments[d.row] as usize;
            let line = verified.readings.lines[d.row];
            DifferenceEntry::of(&task.campaign.instruments[instrument], line, d)
        });
        let set_up = verified.set_up.iter().map(|d| {
            let unit = d.unit.replace('µ', "u").replace('/', "_per_");
            let values = [(format!("deviation_{unit}"), d.value), (format!("u_{unit}"), d.u)];
            SetUpEntry {
                instrument: &task.campaign.instruments[d.instrument].name,
                unknown: &d.unknown,
                is_contradicted: d.is_contradicted(),
                values: values.into_iter().collect(),
            }
        });
        let [pass, fail, undecided] = verified.counts;
        Self {
            schema: "trueaxis/verify/1",
            name: &task.name,
            against: match task.against {
                ComparisonBasis::Prediction(_) => "prediction",
                ComparisonBasis::Readings(_) => "readings",
            },
            readings: verified.readings.len(),
            coverage_factor: task.decision.coverage_factor,
            rule: rule(task),
            verdict: verified.outcome.word(),
            pass,
            fail,
            undecided,
            coverage: CoverageEntry::from(&verified.coverage),
            instruments: verified.instruments.iter().map(|p| part(p, p.index)).collect(),
            places: places.collect(),
            set_up: set_up.collect(),
            deviations: deviations.collect(),
        }
    }
}

impl From<&Coverage> for CoverageEntry {
    fn from(c: &Coverage) -> Self {
        Self {
            numbers: c.count,
            inside: c.inside,
            independent: c.independent,
            share: c.share(),
            interval_95: c.interval,
            expected: c.expected,
        }
    }
}

fn key_unit(instrument: &Instrument) -> &'static str {
    if instrument.sight.is_angle() { "urad" } else { "um" }
}

impl<'a> PartEntry<'a> {
    fn of(instrument: &'a Instrument, part: &Summary) -> Self {
        let (unit, (_, scale)) = (key_unit(instrument), shown_unit(instrument));
        let rms = [
            (format!("rms_nominal_{unit}"), part.rms_before.map(|v| v * scale)),
            (format!("rms_{unit}"), Some(part.rms_after * scale)),
        ];
        Self {
            instrument: &instrument.name,
            coverage: CoverageEntry::from(&part.coverage),
            rms: rms.into_iter().collect(),
            largest_ratio: part.worst.is_finite().then_some(part.worst),
        }
    }
}

impl<'a> DifferenceEntry<'a> {
    fn of(instrument: &'a Instrument, line: u32, d: &Deviation) -> Self {
        let (unit, (_, scale)) = (key_unit(instrument), shown_unit(instrument));
        let values = [
            (format!("deviation_{unit}"), d.value * scale),
            (format!("expanded_{unit}"), d.expanded * scale),
        ];
        Self {
            instrument: &instrument.name,
            line,
            channel: d.channel,
            values: values.into_iter().collect(),
        }
    }
}
