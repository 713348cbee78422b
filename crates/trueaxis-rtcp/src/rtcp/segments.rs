//! Into which segments a control has to cut a path with tool-centre point, so that no chord leaves it.
//!
//! Between two points of the path every axis goes straight. Where a rotary axis turns by φ meanwhile and the tip
//! shall stand still at the distance R from it, the linear axes cut the arc by its chord:
//!
//! ```text
//!     e = R (1 − cos(φ/2))          φ ≤ 2 arccos(1 − e/R)                  docs/model.md eq. 196
//! ```
//!
//! Where several rotary axes turn by φ together, the tip going on by ℓ meanwhile, the place in machine coordinates
//! is x(t) = R(φt)·p(t), and the chord of t from 0 to 1 is nearer than max|x″|/8:
//!
//! ```text
//!     e ≤ (R φ² + 2 φ ℓ)/8          ρ = φ/ℓ:  ℓ ≤ √(8e/(Rρ² + 2ρ)),  ρ ≤ (√(1 + 8eR/ℓ²) − 1)/R      eq. 197
//! ```

use trueaxis_input::{Dimension, Section};

/// What the segments shall keep.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Segments {
    /// The largest chord error, mm.
    pub chord_error_mm: f64,
    /// The largest distance of the path from a rotary axis, mm.
    pub distance_mm: f64,
    /// The shortest segment that the control makes, mm, if stated.
    pub shortest_mm: Option<f64>,
    /// The segment that it begins with, mm, if stated.
    pub first_mm: Option<f64>,
    /// By how much the rotary axes together turn for each mm where the path turns most, if stated. Unit: rad/mm.
    pub sharpest_rad_per_mm: Option<f64>,
}

impl Segments {
    /// The chord error of one rotary axis that turns by this angle while the tip stands still, mm.
    pub fn sagitta_mm(&self, turned_rad: f64) -> f64 {
        self.distance_mm * (1.0 - (0.5 * turned_rad).cos())
    }

    /// The largest step of a rotary axis while the tip stands still, rad; half a turn at most.
    pub fn largest_step_rad(&self) -> f64 {
        2.0 * (1.0 - self.chord_error_mm / self.distance_mm).max(0.0).acos()
    }

    /// The longest segment of a path on which the rotary axes together turn by so much for each mm, mm.
    pub fn longest_mm(&self, turned_rad_per_mm: f64) -> f64 {
        let rho = turned_rad_per_mm;
        (8.0 * self.chord_error_mm / (self.distance_mm * rho * rho + 2.0 * rho)).sqrt()
    }

    /// By how much the rotary axes together may turn for each mm of a path with segments of this length, rad/mm.
    pub fn largest_turn_rad_per_mm(&self, segment_mm: f64) -> f64 {
        let (e, r, l) = (self.chord_error_mm, self.distance_mm, segment_mm);
        // why: √(1 + s) − 1 loses its digits for small s
        let s = 8.0 * e * r / (l * l);
        s / ((1.0 + s).sqrt() + 1.0) / r
    }
}

/// `[segments]` of the file.
pub(super) fn read_segments(section: &Section<'_>) -> Option<Segments> {
    let length = |key: &str, hint: &str, must: bool| {
        let item = if must { section.require(key, hint) } else { section.get(key) };
        let Some(item) = item else { return if must { None } else { Some(None) } };
        let mm = item.quantity(Dimension::Length)?;
        if mm <= 0.0 {
            item.error("bad-size", format!("`{key}` must be more than 0"), hint);
            return None;
        }
        Some(Some(mm))
    };
    let chord = length("chord_error", "the largest chord error, such as \"1 um\"", true);
    let hint = "the largest distance of the path from a rotary axis, such as \"80 mm\"";
    let distance = length("distance", hint, true);
    let shortest = length("shortest", "such as \"0.1 mm\"", false);
    let first = length("first", "such as \"0.9 mm\"", false);
    let along = length("along", "the length of path in which the axes turn by `turned`", false);
    let turned = match section.get("turned") {
        Some(item) => {
            let rad = item.quantity(Dimension::Angle)?;
            if rad <= 0.0 {
                item.error("bad-size", "`turned` must be more than 0".to_owned(), "\"10 deg\"");
                return None;
            }
            Some(rad)
        }
        None => None,
    };
    let sharpest = match (turned, along?) {
        (Some(rad), Some(mm)) => Some(rad / mm),
        (None, None) => None,
        _ => {
            let message = "`turned` and `along` belong together".to_owned();
            let hint = "where the path turns most: turned = \"10 deg\", along = \"5 mm\"";
            section.error("missing-key", message, hint);
            return None;
        }
    };
    let segments = Segments {
        sharpest_rad_per_mm: sharpest,
        chord_error_mm: chord??,
        distance_mm: distance??,
        shortest_mm: shortest?,
        first_mm: first?,
    };
    if segments.chord_error_mm >= segments.distance_mm {
        let message = "the chord error is not smaller than the distance".to_owned();
        section.error("bad-size", message, "chord_error = \"1 um\", distance = \"80 mm\"");
        return None;
    }
    Some(segments)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn by_hand() {
        let of = |e, r| Segments {
            chord_error_mm: e,
            distance_mm: r,
            shortest_mm: None,
            first_mm: None,
            sharpest_rad_per_mm: None,
        };
        // A chord of 60° in a circle of 100 mm is 100·(1 − cos 30°) = 13.397 mm from it.
        assert!((of(0.001, 100.0).sagitta_mm(60_f64.to_radians()) - 13.397_459_6).abs() < 1e-6);
        // 1 µm at 80 mm: √(8·0.001/80) = 0.01 rad.
        assert!((of(0.001, 80.0).largest_step_rad() - 0.01).abs() < 1e-6);
        // 1 µm at 80 mm, 0.1 rad/mm: √(0.008/(80·0.01 + 0.2)) = 0.0894 mm; and back again.
        let s = of(0.001, 80.0);
        assert!((s.longest_mm(0.1) - 0.008_f64.sqrt()).abs() < 1e-12);
        assert!((s.largest_turn_rad_per_mm(s.longest_mm(0.1)) - 0.1).abs() < 1e-12);
    }
}
