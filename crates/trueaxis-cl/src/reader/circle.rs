//! CIRCLE, and whether it leads from where the tool stands to where it goes.

use super::super::ClCircle;
use super::super::numbers::{Fault, is_direction, norm, number};
use super::super::scan::Statement;
use super::Reader;
use std::f64::consts::TAU;

/// A circle whose points are farther than this from it is another one, mm.
const OFF_CIRCLE_MM: f64 = 0.02;

/// The same as a part of its radius: files round.
const OFF_CIRCLE_PART: f64 = 1e-3;

/// Nearer than this two places of a file are one, mm.
const SAME_MM: f64 = 1e-6;

/// Angles of files are rounded, rad: 0.05 deg.
const OFF_ANGLE_RAD: f64 = 0.05 * TAU / 360.0;

/// A hundred turns are more than any helix has.
const MOST_TURN_DEG: f64 = 36_000.0;

impl Reader<'_> {
    /// CIRCLE/x,y,z,i,j,k,radius; NX adds tolerances and the cutter, Autodesk (MOVARC) ANGLE and how far it goes, in degrees.
    pub(super) fn circle(&mut self, s: &Statement) -> Result<ClCircle, Fault> {
        let center_mm = self.displaced(self.place_mm(s)?);
        let turns = s.count() == 9 && s.argument(7).eq_ignore_ascii_case("ANGLE");
        let normal = match s.count() {
            9 if turns => self.numbers::<3>(s, 3)?,
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
        let turn_rad = if turns { Some(angle(s.argument(8))?) } else { None };
        let circle = ClCircle { center_mm, normal: normal.map(|v| v / norm), turn_rad };
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

/// ANGLE of a circle, rad.
fn angle(text: &str) -> Result<f64, Fault> {
    match number(text)? {
        degrees if degrees > 0.0 && degrees <= MOST_TURN_DEG => Ok(degrees.to_radians()),
        degrees => {
            let message =
                format!("ANGLE {degrees} of a circle is not above 0 and up to {MOST_TURN_DEG} deg");
            let hint = "the sense is that of the normal: counter-clockwise about i,j,k";
            Err(("bad-circle", message, hint))
        }
    }
}

impl ClCircle {
    /// How far the tool goes from one place to another, counter-clockwise about the normal, rad: the way that ANGLE states, or up
    /// to one turn. The angle between the places where ANGLE leads elsewhere.
    pub fn turn_rad(&self, from_mm: &[f64; 3], to_mm: &[f64; 3]) -> Result<f64, f64> {
        let arm = |p: &[f64; 3]| -> [f64; 3] { std::array::from_fn(|i| p[i] - self.center_mm[i]) };
        let ([a, b], n) = ([arm(from_mm), arm(to_mm)], self.normal);
        let dot = |a: &[f64; 3], b: &[f64; 3]| -> f64 { a.iter().zip(b).map(|(a, b)| a * b).sum() };
        let flat = |v: &[f64; 3]| -> [f64; 3] { std::array::from_fn(|i| v[i] - dot(v, &n) * n[i]) };
        let (a, b) = (flat(&a), flat(&b));
        let cross =
            [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
        let shortest = dot(&n, &cross).atan2(dot(&a, &b));
        let Some(stated) = self.turn_rad else {
            let same = norm(&std::array::from_fn(|i| b[i] - a[i])) <= SAME_MM;
            return Ok(if same { TAU } else { shortest.rem_euclid(TAU) });
        };
        let turn = shortest + TAU * ((stated - shortest) / TAU).round();
        let allowed = OFF_ANGLE_RAD + off_circle_mm(norm(&a)) / norm(&a);
        match turn > 0.0 && (turn - stated).abs() <= allowed {
            true => Ok(turn),
            false => Err(shortest.rem_euclid(TAU)),
        }
    }

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
pub(super) fn off_circle_mm(radius_mm: f64) -> f64 {
    OFF_CIRCLE_MM + OFF_CIRCLE_PART * radius_mm
}
