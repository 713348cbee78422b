//! The cutting part of a tool: `[tool.1.cutter]`, the seven parameters of APT with what is usual where they are silent.

use super::SetUpTool;
use std::f64::consts::PI;
use trueaxis_cut::{Apt, Cutter};
use trueaxis_input::{Dimension, Section};

/// The shape of a cutter, as far as diameter and corner radius do not say it.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct CutterShape {
    /// From the plane across the axis to the bottom.
    pub bottom_rad: f64,
    /// From the axis to the side; positive if it widens upwards.
    pub side_rad: f64,
    /// Centre of the corner: from the axis, and from the tip along it; none: where the corner touches bottom and side, mm.
    pub corner_at_mm: Option<[f64; 2]>,
    /// From the tip to the end of the cutting part, mm.
    pub height_mm: Option<f64>,
}

/// `[tool.1.cutter]`, or `cutter = { point = "118 deg" }`.
pub(super) fn read_cutter(section: &Section<'_>) -> Option<CutterShape> {
    let angle = |key: &str| section.quantity(key, Dimension::Angle);
    let bottom = match (section.get("point").is_some(), section.get("bottom").is_some()) {
        (true, true) => {
            let message = "`point` and `bottom` both state the angle of the end".to_owned();
            section.error("contradiction", message, "point = 180 deg − 2 · bottom");
            return None;
        }
        (true, false) => angle("point").map(|point| 0.5 * (PI - point)),
        _ => angle("bottom"),
    };
    let corner_at_mm = section.get("corner_at").map(|item| item.lengths::<2>());
    let corner_at_mm = match corner_at_mm {
        Some(stated) => Some(stated?),
        None => None,
    };
    Some(CutterShape {
        bottom_rad: bottom.unwrap_or(0.0),
        side_rad: angle("side").unwrap_or(0.0),
        corner_at_mm,
        height_mm: section.quantity("height", Dimension::Length),
    })
}

impl SetUpTool {
    /// Its cutting part.
    ///
    /// # Errors
    /// In words: no diameter, or parameters that do not fit together.
    pub fn cutter(&self) -> Result<Cutter, String> {
        let first = self.shape.first();
        let diameter_mm = self.diameter_mm.or(first.map(|s| s.diameter_mm));
        let diameter_mm = diameter_mm.ok_or("its diameter is not stated")?;
        let shape = self.cutter.unwrap_or_default();
        let length_mm = first.map_or(-self.tip_mm.z, |s| s.length_mm);
        let apt = shape.apt(diameter_mm, self.corner_radius_mm, length_mm);
        Cutter::new(&apt).map_err(|e| e.to_string())
    }

    /// How far above its tip it has its whole diameter, mm: where its corner ends. None without a diameter, and for a taper,
    /// which has another diameter everywhere.
    pub fn whole_from_mm(&self) -> Option<f64> {
        let shape = self.cutter.unwrap_or_default();
        let apt = shape.apt(self.diameter_mm?, self.corner_radius_mm, -self.tip_mm.z);
        (shape.side_rad == 0.0).then_some(apt.corner_axial_mm)
    }
}

impl CutterShape {
    fn apt(&self, diameter_mm: f64, corner_mm: f64, length_mm: f64) -> Apt {
        let (bottom, side) = (self.bottom_rad, self.side_rad);
        let touching = || {
            // From where bottom and side meet, a corner radius away from both:
            //     −sin α e + cos α f = r,   −cos β (e − d/2) + sin β (f − d/2 tan α) = r
            let meet = [0.5 * diameter_mm, 0.5 * diameter_mm * bottom.tan()];
            let first = [-bottom.sin(), bottom.cos()];
            let second = [-side.cos(), side.sin()];
            let right = [corner_mm, corner_mm + second[0] * meet[0] + second[1] * meet[1]];
            let determinant = first[0] * second[1] - first[1] * second[0];
            [
                (right[0] * second[1] - first[1] * right[1]) / determinant,
                (first[0] * right[1] - right[0] * second[0]) / determinant,
            ]
        };
        let [corner_radial_mm, corner_axial_mm] = self.corner_at_mm.unwrap_or_else(touching);
        Apt {
            diameter_mm,
            corner_mm,
            corner_radial_mm,
            corner_axial_mm,
            bottom_rad: bottom,
            side_rad: side,
            height_mm: self.height_mm.unwrap_or(length_mm),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn apt(shape: CutterShape, diameter_mm: f64, corner_mm: f64) -> Apt {
        shape.apt(diameter_mm, corner_mm, 40.0)
    }

    /// A bull nose: e = d/2 − r, f = r. A drill of 118°: its corner lies d/2 tan 31° above the tip. A taper of 10° with a corner: the corner touches
    /// the plane, and stands r / cos 10° − r tan 10° inside of where plane and side meet.
    #[test]
    fn corners_touch_bottom_and_side() {
        let near = |a: [f64; 2], b: [f64; 2]| {
            assert!((a[0] - b[0]).abs() < 1e-12 && (a[1] - b[1]).abs() < 1e-12, "{a:?} {b:?}");
        };
        let corner = |a: Apt| [a.corner_radial_mm, a.corner_axial_mm];
        near(corner(apt(CutterShape::default(), 20.0, 3.0)), [7.0, 3.0]);
        near(corner(apt(CutterShape::default(), 20.0, 10.0)), [0.0, 10.0]);
        let drill = CutterShape { bottom_rad: 31_f64.to_radians(), ..CutterShape::default() };
        near(corner(apt(drill, 10.0, 0.0)), [5.0, 5.0 * 31_f64.to_radians().tan()]);
        let side_rad = 10_f64.to_radians();
        let taper = CutterShape { side_rad, ..CutterShape::default() };
        let inside = 2.0 / side_rad.cos() - 2.0 * side_rad.tan();
        near(corner(apt(taper, 12.0, 2.0)), [6.0 - inside, 2.0]);
        for (shape, diameter, radius) in [(drill, 10.0, 0.0), (taper, 12.0, 2.0)] {
            Cutter::new(&apt(shape, diameter, radius)).expect("a cutter");
        }
    }
}
