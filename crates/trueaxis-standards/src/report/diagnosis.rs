//! The causes of a circle, the largest share first: as a table and for programs.

use super::evaluation::cell;
use crate::coverage::Expanded;
use crate::iso230_4::{Cause, Circular, Diagnosis, Found};
use serde::Serialize;
use trueaxis_report::JsonSchema;
use trueaxis_report::Table;

const UM: f64 = 1e3;

/// The causes of a circle with their uncertainties and shares.
#[derive(Debug, Serialize, JsonSchema)]
pub struct DiagnosisEntry<'a> {
    /// The causes, the largest share first.
    pub causes: Vec<CauseEntry<'a>>,
    /// Standard deviation of the residuals, µm.
    pub residual_um: f64,
    /// Degrees of freedom of the residuals, which follow each other closely. Unit: 1.
    pub degrees_of_freedom: f64,
    /// By how much the axes lag one another, s; null where no feed is stated.
    pub servo_lag_s: Option<f64>,
}

/// One cause: its value with U, in µm or µrad, and what it does to the circle.
#[derive(Debug, Serialize, JsonSchema)]
pub struct CauseEntry<'a> {
    /// `squareness`, `scale-mismatch`, `size`, `servo-mismatch`, `backlash`, `lateral-play`, `straightness`,
    /// `cyclic-error`, `reversal-spike` or `unexplained`.
    pub cause: &'static str,
    /// The axis that it belongs to; null where it belongs to both.
    pub axis: Option<&'a str>,
    /// Its value, µm; null for an angle.
    pub value_um: Option<f64>,
    /// Its expanded uncertainty (95.45 %), µm; null for an angle.
    #[serde(rename = "U_um")]
    pub expanded_um: Option<f64>,
    /// Its value, µrad; null for a length.
    pub value_urad: Option<f64>,
    /// Its expanded uncertainty (95.45 %), µrad; null for a length.
    #[serde(rename = "U_urad")]
    pub expanded_urad: Option<f64>,
    /// Effective degrees of freedom (Welch-Satterthwaite); null for infinitely many. Unit: 1.
    pub degrees_of_freedom: Option<f64>,
    /// The coverage factor of U. Unit: 1.
    pub k: f64,
    /// A backlash where the axis reverses at its positive and its negative end, µm; null for others.
    pub ends_um: Option<[f64; 2]>,
    /// The bidirectional circular deviation that it makes alone, µm.
    pub alone_um: f64,
    /// Its part of the sum of all these, percent.
    pub share_percent: f64,
}

impl<'a> DiagnosisEntry<'a> {
    pub(super) fn of(circle: &'a Circular, diagnosis: &Diagnosis) -> Self {
        let entry = |f: &Found| {
            let (value, expanded) = (f.value, f.uncertainty.expanded());
            let is_angle = f.cause == Cause::Squareness;
            let (length, angle) =
                (|v: f64| (!is_angle).then_some(v * UM), |v: f64| is_angle.then_some(v * 1e6));
            CauseEntry {
                cause: f.cause.key(),
                axis: f.cause.axis().map(|i| circle.axes[i].as_str()),
                value_um: length(value),
                expanded_um: length(expanded),
                value_urad: angle(value),
                expanded_urad: angle(expanded),
                degrees_of_freedom: f.uncertainty.degrees_of_freedom,
                k: f.uncertainty.coverage_factor,
                ends_um: f.ends_mm.map(|ends| ends.map(|v| v * UM)),
                alone_um: f.alone_mm * UM,
                share_percent: f.share * 100.0,
            }
        };
        Self {
            causes: diagnosis.found.iter().map(entry).collect(),
            residual_um: diagnosis.residual_mm * UM,
            degrees_of_freedom: diagnosis.degrees_of_freedom,
            servo_lag_s: diagnosis.servo_lag_s,
        }
    }
}

/// A cause in words.
pub fn cause_in_words(cause: Cause, axes: &[String; 2]) -> String {
    let [a, b] = axes;
    let of = |axis: usize| &axes[axis.min(1)];
    match cause {
        Cause::Squareness => format!("squareness {a}{b}, closer than 90°"),
        Cause::ScaleMismatch => format!("scale mismatch {a} − {b}, over the diameter"),
        Cause::Size => "size: mean radius − nominal".to_owned(),
        Cause::ServoMismatch => "servo mismatch, ccw along +45°".to_owned(),
        Cause::Backlash(axis) => format!("backlash {} (B = E↑ − E↓)", of(axis)),
        Cause::LateralPlay(axis) => {
            format!("lateral play {}, along {}", of(axis), of(1 - axis.min(1)))
        }
        Cause::Straightness(axis) => format!("straightness {}, bow over the radius", of(axis)),
        Cause::Cyclic(axis) => format!("cyclic error {}, crest to trough", of(axis)),
        Cause::Spike(axis) => format!("reversal spike {}", of(axis)),
        Cause::Unexplained => "unexplained (standard deviation)".to_owned(),
    }
}

/// ν; beyond a thousand it makes no difference.
pub(super) fn freedom_in_words(uncertainty: Option<Expanded>) -> String {
    match uncertainty.map(|u| u.degrees_of_freedom) {
        None => "–".to_owned(),
        Some(Some(n)) if n < 1000.0 => format!("{n:.0}"),
        Some(_) => "∞".to_owned(),
    }
}

pub(super) fn table(circle: &Circular, diagnosis: &Diagnosis) -> Table {
    let row = |f: &Found| {
        let (scale, unit) = if f.cause == Cause::Squareness { (1e6, "µrad") } else { (UM, "µm") };
        let has_u = f.cause != Cause::Unexplained;
        [
            cause_in_words(f.cause, &circle.axes),
            cell(Some(f.value), scale),
            cell(has_u.then(|| f.uncertainty.expanded()), scale),
            unit.to_owned(),
            format!("{:.1}", f.share * 100.0),
            cell(Some(f.alone_mm), UM),
            freedom_in_words(has_u.then_some(f.uncertainty)),
            if has_u { format!("{:.2}", f.uncertainty.coverage_factor) } else { "–".to_owned() },
        ]
    };
    let mut note = "Share: of the sum of what each cause makes alone (G(b), µm). U: 95.45 %, ν and k by Welch and \
                    Satterthwaite (GUM G.4)."
        .to_owned();
    if let Some(lag) = diagnosis.servo_lag_s {
        note += &format!(" Servo mismatch at this feed: {:+.3} ms.", lag * 1e3);
    }
    Table::new(["cause", "value", "U", "", "share, %", "alone, µm", "ν", "k"])
        .rows(diagnosis.found.iter().map(row))
        .note(note)
}
