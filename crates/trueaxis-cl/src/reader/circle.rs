//! CIRCLE, and whether it leads from where the tool stands to where it goes.

use super::super::ClCircle;
use super::super::numbers::{Fault, is_direction, norm, number};
use super::super::scan::Statement;
use super::Reader;

/// A circle whose points are farther than this from it is another one, mm.
const OFF_CIRCLE_MM: f64 = 0.02;

/// The same as a part of its radius: files round.
const OFF_CIRCLE_PART: f64 = 1e-3;

impl Reader<'_> {
    /// CIRCLE/x,y,z,i,j,k,radius; NX adds tolerances and the cutter.
    pub(super) fn circle(&mut self, s: &Statement) -> Result<ClCircle, Fault> {
        let center_mm = self.displaced(self.place_mm(s)?);
        let normal = match s.count() {
            6 | 7 | 11 => self.numbers::<3>(s, 3)?,
            count => {
                let message = format!("a circle has 6 or 7 numbers, not {count}");
                return Err(("bad-circle", message, "write CIRCLE/x,y,z,i,j,k,radius"));
            }
        };
        let norm = norm(&normal);
        if !is_direction(norm) {
            let message = "the normal of the circle has length zero".to_owned();
            return Err(("bad-circle", message, "write CIRCLE/x,y,z,i,j,k,radius"));
        }
        let circle = ClCircle { center_mm, normal: normal.map(|v| v / norm) };
        let radius_mm = match s.count() {
            6 => None,
            _ => Some(number(s.argument(6))? * self.unit_mm).filter(|r| *r > 0.0),
        };
        let Some((from, radius_mm)) = self.tip_mm.zip(radius_mm) else { return Ok(circle) };
        let is_mm = circle.radius_mm(&from);
        if (is_mm - radius_mm).abs() > off_circle_mm(radius_mm) {
            let message = format!(
                "the circle states the radius {radius_mm:.4} mm, and the tool stands {is_mm:.4} mm from its axis"
            );
            return Err((
                "bad-circle",
                message,
                "check the point before, the centre and the units",
            ));
        }
        Ok(circle)
    }
}

impl ClCircle {
    /// How far a place is from its axis, mm.
    pub fn radius_mm(&self, place_mm: &[f64; 3]) -> f64 {
        let arm: [f64; 3] = std::array::from_fn(|i| place_mm[i] - self.center_mm[i]);
        let along: f64 = arm.iter().zip(self.normal).map(|(a, n)| a * n).sum();
        let flat: [f64; 3] = std::array::from_fn(|i| arm[i] - along * self.normal[i]);
        norm(&flat)
    }

    /// Whether a place that the tool comes to lies on the circle that begins at another, as far as files round.
    pub fn leads(&self, from_mm: &[f64; 3], to_mm: &[f64; 3]) -> bool {
        let [from, to] = [from_mm, to_mm].map(|place| self.radius_mm(place));
        (from - to).abs() <= off_circle_mm(from)
    }
}

/// What files round a radius by, mm.
fn off_circle_mm(radius_mm: f64) -> f64 {
    OFF_CIRCLE_MM + OFF_CIRCLE_PART * radius_mm
}
