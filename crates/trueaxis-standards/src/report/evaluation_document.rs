//! An evaluation for programs: the document `trueaxis/evaluate/1`; its keys are fixed in docs/reference/json.md.

use super::circular_document::CircularEntry;
use super::decisions::DecisionsEntry;
use super::evaluation::Evaluation;
use super::evaluation_geometric::GeometricEntry;
use super::evaluation_positioning::{json_units, place};
use super::evaluation_probing::ProbingEntry;
use crate::Evaluated;
use crate::iso230_2::{
    Approached, Budget, Direction, Measurement, Position, Positioning, Quantity,
};
use crate::iso230_3::{Channel, Drift};
use crate::iso230_6::{DiagonalResult, Diagonals, SquarenessHint};
use crate::iso230_7::{ErrorMotion, Rotation};
use serde::Serialize;
use trueaxis_geometry::AxisKind;
use trueaxis_report::JsonSchema;
use trueaxis_report::Keyed;

const UM: f64 = 1e3;

/// An evaluation of readings by a standard: `trueaxis/evaluate/1`.
#[derive(Debug, Serialize, JsonSchema)]
pub struct EvaluationDocument<'a> {
    /// Which document this is.
    #[schemars(extend("const" = "trueaxis/evaluate/1"))]
    pub schema: &'static str,
    /// The version of the program.
    pub version: &'static str,
    /// The standard, such as `iso230-2`.
    pub standard: &'static str,
    /// The file of the readings.
    pub file: &'a str,
    /// The name of the measurement; null if none is stated.
    pub name: Option<&'a str>,
    /// The machine; null if none is stated.
    pub machine: Option<&'a str>,
    /// The axis; null if none is stated.
    pub axis: Option<&'a str>,
    /// The instrument; null if none is stated.
    pub instrument: Option<&'a str>,
    /// The date of the measurement; null if none is stated.
    pub date: Option<&'a str>,
    /// The temperature; null if none is stated. Unit: °C.
    #[serde(rename = "temperature_degC")]
    pub temperature: Option<f64>,
    /// Figures against their tolerances; null where none has one.
    pub decisions: Option<DecisionsEntry>,
    /// The quantities of the standard.
    #[serde(flatten)]
    pub result: ResultEntry<'a>,
}

/// The quantities of one standard.
#[derive(Debug, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum ResultEntry<'a> {
    /// ISO 230-2, GB/T 17421.2, VDI/DGQ 3441, ASME B5.54.
    Positioning(PositioningEntry),
    /// ISO 230-1.
    Geometric(GeometricEntry<'a>),
    /// ISO 230-4.
    Circular(CircularEntry<'a>),
    /// ISO 230-3.
    Drift(DriftEntry<'a>),
    /// ISO 230-6.
    Diagonals(DiagonalsEntry<'a>),
    /// ISO 230-7.
    Rotation(RotationEntry),
    /// ISO 230-10.
    Probing(ProbingEntry<'a>),
}

/// Positioning of an axis. Deviations of linear axes end in `_um` (µm), those of rotary axes are given twice, in
/// `_urad` (µrad) and `_arcsec` (arcseconds). For each unit there are the quantities `A`, `A_up`, `A_down`, `R`,
/// `R_up`, `R_down`, `E`, `E_up`, `E_down`, `M`, `B` and `B_mean` of ISO 230-2, then an object `U` with their
/// expanded uncertainties (k = 2).
#[derive(Debug, Serialize, JsonSchema)]
pub struct PositioningEntry {
    /// `linear` or `rotary`.
    pub kind: &'static str,
    /// The quantities of ISO 230-2 and their expanded uncertainties.
    #[serde(flatten)]
    pub quantities: Keyed<QuantityEntry>,
    /// The measured length of a linear axis, mm.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub travel_mm: Option<f64>,
    /// The measured angle of a rotary axis, degrees.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub travel_deg: Option<f64>,
    /// Every target position.
    pub positions: Vec<PositionEntry>,
    /// Standard uncertainties by ISO/TR 230-9, each key with its unit; null if nothing is known of the
    /// instrument. An entry is null where it does not apply.
    pub budget: Option<Keyed<Option<f64>>>,
    /// `P`, `Pa`, `Ps` and `U` of VDI/DGQ 3441, each key with its unit; null where the readings do not allow it.
    pub vdi3441: Keyed<Option<f64>>,
    /// The quantities in the form of ASME B5.54, each key with its unit; null where the readings do not allow it.
    pub b5_54_form: Keyed<Option<f64>>,
}

/// A quantity of ISO 230-2, or the expanded uncertainties of all of them.
#[derive(Debug, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum QuantityEntry {
    /// The value, in the unit at the end of its key; null if the readings do not allow it.
    Value(Option<f64>),
    /// Expanded uncertainties (k = 2) by the name of the quantity; null if nothing is known of the instrument.
    Uncertainties(Keyed<Option<f64>>),
}

/// One target position. For each unit there are the means `mean_up`, `mean_down` and `mean`, the standard
/// deviations `s_up` and `s_down`, the reversal value `B` and the repeatabilities `R_up`, `R_down` and `R`.
#[derive(Debug, Serialize, JsonSchema)]
pub struct PositionEntry {
    /// The target of a linear axis, mm.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub target_mm: Option<f64>,
    /// The target of a rotary axis, degrees.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub target_deg: Option<f64>,
    /// How many readings were approached in the positive direction.
    pub n_up: usize,
    /// How many readings were approached in the negative direction.
    pub n_down: usize,
    /// The statistics, each key with its unit; null where the readings do not allow it.
    #[serde(flatten)]
    pub statistics: Keyed<Option<f64>>,
}

/// Drift by ISO 230-3.
#[derive(Debug, Serialize, JsonSchema)]
pub struct DriftEntry<'a> {
    /// Length of the windows, s.
    pub window_s: f64,
    /// How long the test lasts, s.
    pub duration_s: Option<f64>,
    /// Every channel.
    pub channels: Vec<ChannelEntry<'a>>,
}

/// One channel: `range`, `first_window`, `largest_window`, `largest_window_at_most` (if it changes within gaps of the record at the worst
/// moment) and `end`, each with the unit `_um`, `_urad` or `_degC`.
#[derive(Debug, Serialize, JsonSchema)]
pub struct ChannelEntry<'a> {
    /// Its name.
    pub name: &'a str,
    /// Its ranges and its end − begin, each key with its unit.
    #[serde(flatten)]
    pub ranges: Keyed<f64>,
    /// Where the window of the largest range begins, s.
    pub largest_window_from_s: f64,
}

/// Diagonals by ISO 230-6: the largest of all, then each. A value is null if the readings do not allow it.
#[derive(Debug, Serialize, JsonSchema)]
pub struct DiagonalsEntry<'a> {
    /// Bidirectional systematic deviation, µm.
    #[serde(rename = "E_d_um")]
    pub systematic_um: Option<f64>,
    /// Systematic deviation in the positive direction, µm.
    #[serde(rename = "E_d_up_um")]
    pub systematic_up_um: Option<f64>,
    /// Systematic deviation in the negative direction, µm.
    #[serde(rename = "E_d_down_um")]
    pub systematic_down_um: Option<f64>,
    /// Bidirectional repeatability, µm.
    #[serde(rename = "R_d_um")]
    pub repeatability_um: Option<f64>,
    /// Reversal value, µm.
    #[serde(rename = "B_d_um")]
    pub reversal_um: Option<f64>,
    /// Bidirectional accuracy, µm.
    #[serde(rename = "A_d_um")]
    pub accuracy_um: Option<f64>,
    /// Every diagonal.
    pub diagonals: Vec<DiagonalEntry>,
    /// Squareness from pairs of diagonals.
    pub squareness: Vec<SquarenessEntry<'a>>,
}

/// One diagonal.
#[derive(Debug, Serialize, JsonSchema)]
pub struct DiagonalEntry {
    /// Its name by the signs of the axes.
    pub diagonal: String,
    /// Its elongation, µm/m; null if the readings do not allow it.
    pub stretch_um_per_m: Option<f64>,
    /// Its quantities of ISO 230-2.
    #[serde(flatten)]
    pub positioning: PositioningEntry,
}

/// Squareness of two axes, as their diagonals suggest it.
#[derive(Debug, Serialize, JsonSchema)]
pub struct SquarenessEntry<'a> {
    /// The two axes.
    pub axes: &'a str,
    /// By how much they are closer than 90°, µrad.
    pub closer_urad: f64,
    /// `body` or `face` diagonals.
    pub from: &'static str,
}

/// Error motions of a rotary axis by ISO 230-7.
#[derive(Debug, Serialize, JsonSchema)]
pub struct RotationEntry {
    /// How many full revolutions were evaluated.
    pub revolutions: usize,
    /// Readings in each revolution.
    pub readings_per_revolution: usize,
    /// Readings outside the full revolutions.
    pub readings_left_out: usize,
    /// The error motions.
    pub motions: Vec<MotionEntry>,
}

/// One error motion.
#[derive(Debug, Serialize, JsonSchema)]
pub struct MotionEntry {
    /// The sensitive direction.
    pub sensitive: String,
    /// Total error motion, µm.
    pub total_um: f64,
    /// Synchronous error motion, µm.
    pub synchronous_um: f64,
    /// Asynchronous error motion, µm; null for one revolution.
    pub asynchronous_um: Option<f64>,
    /// The part once per revolution, µm.
    pub fundamental_um: f64,
}

impl<'a> EvaluationDocument<'a> {
    /// The document of an evaluation.
    pub fn of(evaluation: &Evaluation<'a>) -> Self {
        let c = evaluation.conditions;
        Self {
            schema: "trueaxis/evaluate/1",
            version: trueaxis_report::VERSION,
            standard: evaluation.standard.key(),
            file: evaluation.file,
            name: c.name.as_deref(),
            machine: c.machine.as_deref(),
            axis: c.axis.as_deref(),
            instrument: c.instrument_name.as_deref(),
            date: c.date.as_deref(),
            temperature: c.temperature_c.map(|t| t.value),
            decisions: DecisionsEntry::of(evaluation.judged),
            result: ResultEntry::from(evaluation.evaluated),
        }
    }
}

impl<'a> From<&'a Evaluated> for ResultEntry<'a> {
    fn from(evaluated: &'a Evaluated) -> Self {
        match evaluated {
            Evaluated::Positioning(m, r) => Self::Positioning(PositioningEntry::of(m, r)),
            Evaluated::Geometric(test) => Self::Geometric(test.as_ref().into()),
            Evaluated::Circular(circle) => Self::Circular(CircularEntry::from(&**circle)),
            Evaluated::Drift(drift) => Self::Drift(DriftEntry::from(drift)),
            Evaluated::Diagonals(d) => Self::Diagonals(DiagonalsEntry::from(d)),
            Evaluated::Rotation(r) => Self::Rotation(RotationEntry::from(r)),
            Evaluated::Probing(p) => Self::Probing(p.into()),
        }
    }
}

/// Every value in every unit of the axis.
fn keyed(kind: AxisKind, values: &[(&str, Option<f64>)]) -> Keyed<Option<f64>> {
    let in_unit = |(unit, scale): &(&str, f64)| {
        let entry =
            |(key, v): &(&str, Option<f64>)| (format!("{key}_{unit}"), v.map(|v| v * scale));
        values.iter().map(entry).collect::<Vec<_>>()
    };
    json_units(kind).iter().flat_map(in_unit).collect()
}

/// A position of a linear axis in mm, or of a rotary one in degrees.
fn placed(kind: AxisKind, position: f64) -> (Option<f64>, Option<f64>) {
    let value = place(kind, position);
    match kind {
        AxisKind::Linear => (Some(value), None),
        AxisKind::Rotary => (None, Some(value)),
    }
}

impl PositioningEntry {
    fn of(m: &Measurement, r: &Positioning) -> Self {
        let values = Quantity::ALL.map(|q| (q.key(), r.value(q)));
        let values = keyed(r.kind, &values).0.into_iter();
        let values = values.map(|(key, value)| (key, QuantityEntry::Value(value)));
        let uncertainties = json_units(r.kind).iter().map(|(unit, scale)| {
            let of = |q: Quantity| (q.key(), r.expanded_of(q).map(|v| v * scale));
            let all = Quantity::ALL.map(of).into_iter().collect();
            (format!("U_{unit}"), QuantityEntry::Uncertainties(all))
        });
        let (travel_mm, travel_deg) = placed(r.kind, m.length());
        let (v, b) = (&r.others.vdi3441, &r.others.b554);
        let b = [
            ("accuracy", b.accuracy),
            ("accuracy_up", b.accuracy_up),
            ("accuracy_down", b.accuracy_down),
            ("repeatability", b.repeatability),
            ("reversal", b.reversal),
        ];
        Self {
            kind: if r.kind == AxisKind::Linear { "linear" } else { "rotary" },
            quantities: values.chain(uncertainties).collect(),
            travel_mm,
            travel_deg,
            positions: r.positions.iter().map(|p| PositionEntry::of(r.kind, p)).collect(),
            budget: r.budget.as_ref().map(|budget| shares(r.kind, budget)),
            vdi3441: keyed(r.kind, &[("P", v.p), ("Pa", v.pa), ("Ps", v.ps), ("U", v.u)]),
            b5_54_form: keyed(r.kind, &b),
        }
    }
}

fn shares(kind: AxisKind, budget: &Budget) -> Keyed<Option<f64>> {
    let (unit, scale) = json_units(kind)[0];
    let shares = budget.shares.iter();
    let shares =
        shares.map(|s| (format!("{}_u_{unit}", s.name.replace(' ', "_")), Some(s.u * scale)));
    let drift = (format!("drift_u_{unit}"), budget.drift_u.map(|u| u * scale));
    shares.chain([drift]).collect()
}

impl PositionEntry {
    fn of(kind: AxisKind, p: &Position) -> Self {
        let (target_mm, target_deg) = placed(kind, p.target);
        let count = |a: Option<Approached>| a.map_or(0, |a| a.count);
        let statistics = [
            ("mean_up", p.up.map(|a| a.mean)),
            ("mean_down", p.down.map(|a| a.mean)),
            ("mean", p.mean()),
            ("s_up", p.up.and_then(|a| a.s)),
            ("s_down", p.down.and_then(|a| a.s)),
            ("B", p.reversal()),
            ("R_up", p.repeatability_of(Direction::Up)),
            ("R_down", p.repeatability_of(Direction::Down)),
            ("R", p.repeatability()),
        ];
        Self {
            target_mm,
            target_deg,
            n_up: count(p.up),
            n_down: count(p.down),
            statistics: keyed(kind, &statistics),
        }
    }
}

impl<'a> From<&'a Drift> for DriftEntry<'a> {
    fn from(d: &'a Drift) -> Self {
        Self {
            window_s: d.window_s,
            duration_s: d.times_s.last().copied(),
            channels: d.channels.iter().map(ChannelEntry::from).collect(),
        }
    }
}

impl<'a> From<&'a Channel> for ChannelEntry<'a> {
    fn from(c: &'a Channel) -> Self {
        let (_, unit, scale) = super::evaluation_others::unit(c);
        let ranges = [
            ("range", c.range),
            ("first_window", c.first_window),
            ("largest_window", c.largest_window.0),
            ("largest_window_at_most", c.at_most[1]),
            ("end", c.end),
        ];
        let ranges = ranges.map(|(key, value)| (format!("{key}_{unit}"), value * scale));
        Self {
            name: &c.name,
            ranges: ranges.into_iter().collect(),
            largest_window_from_s: c.largest_window.1,
        }
    }
}

impl<'a> From<&'a Diagonals> for DiagonalsEntry<'a> {
    fn from(d: &'a Diagonals) -> Self {
        let largest = |quantity| d.largest(quantity).map(|v| v * UM);
        Self {
            systematic_um: largest(Quantity::E),
            systematic_up_um: largest(Quantity::EUp),
            systematic_down_um: largest(Quantity::EDown),
            repeatability_um: largest(Quantity::R),
            reversal_um: largest(Quantity::B),
            accuracy_um: largest(Quantity::A),
            diagonals: d.diagonals.iter().map(DiagonalEntry::from).collect(),
            squareness: d.squareness.iter().map(SquarenessEntry::from).collect(),
        }
    }
}

impl From<&DiagonalResult> for DiagonalEntry {
    fn from(d: &DiagonalResult) -> Self {
        Self {
            diagonal: d.diagonal.name(),
            stretch_um_per_m: d.stretch.map(|v| v * 1e6),
            positioning: PositioningEntry::of(&d.measurement, &d.result),
        }
    }
}

impl<'a> From<&'a SquarenessHint> for SquarenessEntry<'a> {
    fn from(h: &'a SquarenessHint) -> Self {
        Self {
            axes: &h.axes,
            closer_urad: h.closer_rad * 1e6,
            from: if h.of_body { "body" } else { "face" },
        }
    }
}

impl From<&Rotation> for RotationEntry {
    fn from(r: &Rotation) -> Self {
        Self {
            revolutions: r.revolutions,
            readings_per_revolution: r.angles_rad.len(),
            readings_left_out: r.left_out,
            motions: r.motions.iter().map(MotionEntry::from).collect(),
        }
    }
}

impl From<&ErrorMotion> for MotionEntry {
    fn from(m: &ErrorMotion) -> Self {
        Self {
            sensitive: m.sensitive.name(),
            total_um: m.total_mm * UM,
            synchronous_um: m.synchronous_mm * UM,
            asynchronous_um: m.asynchronous_mm.map(|v| v * UM),
            fundamental_um: m.fundamental_mm * UM,
        }
    }
}
