//! What a machine has for its tools: the spindle and the magazine.

use std::f64::consts::PI;

/// The limits of spindle and magazine, as far as the machine file states them.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Equipment {
    /// Highest speed of the spindle, rad/s.
    pub max_spindle_rad_per_s: Option<f64>,
    /// Lowest speed at which the spindle may turn, rad/s.
    pub min_spindle_rad_per_s: Option<f64>,
    /// Power of its motor. Unit: W.
    pub spindle_power_w: Option<f64>,
    /// Places of the tool magazine.
    pub magazine_places: Option<u32>,
}

impl Equipment {
    /// Whether the machine file states any of it.
    pub fn is_stated(&self) -> bool {
        *self != Self::default()
    }

    /// The limit that a programmed speed of the spindle, 1/min, is beyond; 1/min. A spindle may stand.
    pub fn speed_limit_passed(&self, per_minute: f64) -> Option<f64> {
        let per_rad_per_s = 30.0 / PI;
        let [max, min] = [self.max_spindle_rad_per_s, self.min_spindle_rad_per_s]
            .map(|limit| limit.map(|rad_per_s| rad_per_s * per_rad_per_s));
        let asked = per_minute.abs();
        // The rounding of 1/min to rad/s and back is no issue.
        let above = max.filter(|max| asked > max * (1.0 + 1e-9));
        above.or_else(|| min.filter(|min| asked > 0.0 && asked < min * (1.0 - 1e-9)))
    }
}
