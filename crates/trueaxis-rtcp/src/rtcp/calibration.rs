//! What came out of the readings.

use super::angles::AngleError;
use super::control::Slot;
use nalgebra::DMatrix;
use serde::Serialize;
use trueaxis_calibrate::identify::verdict::{BELOW_NOISE, LEAST_FREEDOM};
use trueaxis_input::Place;
use trueaxis_report::JsonSchema;

/// A combination of offsets that changes no reading.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct Unseen {
    /// As a sum.
    pub combination: String,
    /// What that means.
    pub words: String,
}

/// One offset.
#[derive(Debug, Clone, PartialEq)]
pub struct Offset {
    /// Its ISO 230-1 name.
    pub name: String,
    /// In the words of the shop.
    pub words: String,
    /// True − machine file and its standard uncertainty, mm; `None` where not observable.
    pub found_mm: Option<(f64, f64)>,
}

/// A number of the control, old and new.
#[derive(Debug, Clone, PartialEq)]
pub struct NewSlot {
    /// Which.
    pub slot: Slot,
    /// What stands there, mm.
    pub old_mm: f64,
    /// What shall stand there and its standard uncertainty, mm; `None` where not observable.
    pub new_mm: Option<(f64, f64)>,
}

/// The reading that fits worst.
#[derive(Debug, Clone, PartialEq)]
pub struct WorstReading {
    /// Where it stands.
    pub place: Place,
    /// Along which direction: x, y or z.
    pub channel: char,
    /// Reading − model, mm.
    pub residual_mm: f64,
    /// The same in its standard uncertainty. Unit: 1.
    pub standardised: f64,
    /// Beyond what one of so many readings may be off (Bonferroni, 5 %).
    pub is_outlier: bool,
}

/// What came out.
#[derive(Debug, Clone)]
pub struct Calibration {
    /// The offsets in chain order.
    pub offsets: Vec<Offset>,
    /// The angle errors of the rotary axes, from the bed outwards.
    pub angles: Vec<AngleError>,
    /// Whether they were unknowns beside the offsets.
    pub angles_wanted: bool,
    /// The offsets found, mm; of unobservable combinations the shortest.
    pub values_mm: Vec<f64>,
    /// Their covariance, mm²: noise (as large as the residuals say) and tool.
    pub covariance: DMatrix<f64>,
    /// Offsets that change no reading, one combination with balls each, of length 1 as a whole.
    pub null_space: DMatrix<f64>,
    /// The numbers of the control.
    pub new: Vec<NewSlot>,
    /// Unobservable combinations.
    pub unseen: Vec<Unseen>,
    /// χ² of the readings. Unit: 1.
    pub chi_square: f64,
    /// Numbers read less unknowns found.
    pub degrees_of_freedom: usize,
    /// How many numbers were read.
    pub numbers: usize,
    /// √(χ²/ν) where χ² is beyond its 99 % quantile, else 1. Unit: 1.
    pub birge: f64,
    /// The spread of reading − model, mm.
    pub rms_residual_mm: f64,
    /// The reading that fits worst.
    pub worst: Option<WorstReading>,
    /// Slips that would explain what does not fit, in words.
    pub suspicions: Vec<String>,
    /// Passes of the fit; one finds the answer, one more sees that it stands.
    pub passes: usize,
}

impl Calibration {
    /// Whether the readings fit the machine, and determine an offset.
    pub fn is_good(&self) -> bool {
        self.birge == 1.0 && self.offsets.iter().any(|o| o.found_mm.is_some())
    }

    /// The residual as a part of the noise, √(χ²/ν), where it is far smaller: then the unit or the noise is wrong.
    pub fn below_noise(&self) -> Option<f64> {
        let freedom = self.degrees_of_freedom as f64;
        let part = (self.chi_square / freedom.max(1.0)).sqrt();
        (freedom >= LEAST_FREEDOM && part < BELOW_NOISE).then_some(part)
    }

    /// Whether every offset was found.
    pub fn is_complete(&self) -> bool {
        self.offsets.iter().all(|o| o.found_mm.is_some())
    }

    /// In one sentence.
    pub fn verdict(&self) -> String {
        let (all, found) =
            (self.offsets.len(), self.offsets.iter().filter(|o| o.found_mm.is_some()).count());
        if found == 0 {
            return "no: the readings determine none of the centres".to_owned();
        }
        if self.birge > 1.0 {
            return format!(
                "no: the readings differ from the model by {:.1} times their noise",
                self.birge
            );
        }
        let angles = self.angles.len();
        let inclined = self.angles.iter().filter(|a| a.found_rad.is_some()).count();
        let also = match self.angles_wanted {
            true => format!(" and {inclined} of {angles} angles"),
            false => String::new(),
        };
        match found == all && (!self.angles_wanted || inclined == angles) {
            true => format!("yes: all {all} offsets{also} found, the readings fit"),
            false => format!("in part: {found} of {all} offsets{also} found, the readings fit"),
        }
    }
}
