//! The deviations of a part in two views.

use super::drawing_document::spacing_mm;
use crate::predict::drawing::{CutFeature, CutPoint, PartPrediction};
use plotters::prelude::*;
use trueaxis_geometry::Vec3;
use trueaxis_report::Figure;
use trueaxis_report::plots::{
    Area, COLOURS, DrawingError, INK, SHARP, colour_bar, draw, drawing_error, heat, ink, px,
};

/// More marks than this are not drawn in one view; an even choice of the points stands for all.
const MOST_MARKS: usize = 4000;
const WIDTH: u32 = 1000;
const HEIGHT: u32 = 470;

/// A point of a surface, and half of the distance from its neighbours.
struct Mark<'a> {
    point: &'a CutPoint,
    radius_mm: f64,
}

/// The part from above, from the front and from the back: red where material is left, blue where it is missing. Surfaces that face away
/// from the eye are not drawn.
pub(super) fn deviation_map(prediction: &PartPrediction) -> Figure<'_> {
    let caption = "Deviations along the normals. Nearer points cover farther ones.";
    Figure::new(caption, || map(&prediction.features))
}

fn map(features: &[CutFeature]) -> Result<String, DrawingError> {
    let mut marks = Vec::new();
    for feature in features {
        let radius_mm = 0.5 * spacing_mm(&feature.points);
        marks.extend(feature.points.iter().map(|point| Mark { point, radius_mm }));
    }
    let most = marks.iter().fold(1e-9_f64, |m, p| m.max(p.point.deviation_mm.abs()));
    let every = marks.len().div_ceil(MOST_MARKS).max(1);
    let chosen: Vec<Mark<'_>> = marks.into_iter().step_by(every).collect();
    // Fewer marks are larger ones.
    let grown = (every as f64).sqrt();
    draw((WIDTH, HEIGHT), |area| {
        let half = px(WIDTH as i32 / 2);
        for (left, words, eye) in [
            (0, "from the front", Vec3::new(-0.45, -0.75, 0.6)),
            (half, "from the back", Vec3::new(0.45, 0.75, 0.6)),
        ] {
            let view = View::of(&chosen, &eye, left);
            view.paint(area, &chosen, (most, grown))?;
            let at = (left + px(14), px(8));
            area.draw(&Text::new(words, at, ink(13))).map_err(drawing_error)?;
            view.triad(area, left)?;
        }
        colour_bar(area, (WIDTH, HEIGHT), most)
    })
}

/// How the part lies in one half of the picture.
struct View {
    right: Vec3,
    up: Vec3,
    eye: Vec3,
    per_mm: f64,
    middle: [f64; 2],
    centre: [f64; 2],
}

impl View {
    fn of(marks: &[Mark<'_>], eye: &Vec3, left: i32) -> Self {
        let eye = eye.normalize();
        let right = Vec3::z().cross(&eye).normalize();
        let up = eye.cross(&right);
        let ends = |along: &Vec3| {
            let all = marks.iter().map(|m| m.point.nominal_mm.dot(along));
            all.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(v), h.max(v)))
        };
        let ends = [ends(&right), ends(&up)];
        let room = [f64::from(px(WIDTH as i32 / 2 - 60)), f64::from(px(HEIGHT as i32 - 120))];
        let fits = |k: usize| room[k] / (ends[k].1 - ends[k].0).max(1e-3);
        Self {
            right,
            up,
            eye,
            per_mm: fits(0).min(fits(1)),
            middle: ends.map(|(l, h)| 0.5 * (l + h)),
            centre: [
                f64::from(left) + f64::from(px(WIDTH as i32 / 4)),
                f64::from(px(HEIGHT as i32 / 2 - 20)),
            ],
        }
    }

    fn place(&self, point: &Vec3) -> (i32, i32) {
        let x = (point.dot(&self.right) - self.middle[0]) * self.per_mm;
        let y = (point.dot(&self.up) - self.middle[1]) * self.per_mm;
        ((self.centre[0] + x).round() as i32, (self.centre[1] - y).round() as i32)
    }

    /// From the farthest mark to the nearest.
    fn paint(
        &self,
        area: &Area<'_>,
        marks: &[Mark<'_>],
        (most, grown): (f64, f64),
    ) -> Result<(), DrawingError> {
        let depth = |m: &Mark<'_>| m.point.nominal_mm.dot(&self.eye);
        let mut seen: Vec<&Mark<'_>> =
            marks.iter().filter(|m| m.point.normal.dot(&self.eye) > 0.0).collect();
        seen.sort_by(|a, b| depth(a).total_cmp(&depth(b)));
        for Mark { point, radius_mm } in seen {
            let any = if point.normal.z.abs() < 0.9 { Vec3::z() } else { Vec3::x() };
            let across = point.normal.cross(&any).normalize();
            let along = point.normal.cross(&across);
            // A square of the distance between points, so that planes are filled.
            let edge = radius_mm * grown * 1.04;
            let corner = |[a, b]: [f64; 2]| {
                self.place(&(point.nominal_mm + (across * a + along * b) * edge))
            };
            let corners = [[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]].map(corner);
            let field = Polygon::new(corners, heat(point.deviation_mm / most).filled());
            area.draw(&field).map_err(drawing_error)?;
        }
        Ok(())
    }

    /// The directions of the workpiece frame.
    fn triad(&self, area: &Area<'_>, left: i32) -> Result<(), DrawingError> {
        let from = (left + px(44), px(HEIGHT as i32 - 60));
        let length = f64::from(px(30));
        for (k, name) in ["X", "Y", "Z"].into_iter().enumerate() {
            let axis = Vec3::from_fn(|i, _| if i == k { 1.0 } else { 0.0 });
            let (x, y) = (axis.dot(&self.right) * length, axis.dot(&self.up) * length);
            let to = (from.0 + x.round() as i32, from.1 - y.round() as i32);
            let line = PathElement::new(vec![from, to], COLOURS[k].stroke_width(SHARP));
            area.draw(&line).map_err(drawing_error)?;
            let at = (to.0 + px(2), to.1 - px(6));
            area.draw(&Text::new(name, at, ink(11).color(&INK))).map_err(drawing_error)?;
        }
        Ok(())
    }
}
