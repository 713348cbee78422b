//! Lines of a surface, each judged by itself in a plane that holds it: straightness of lines and line profile, ISO 1101.

use super::Geometry;
use super::datum::{DatumFrame, held};
use super::values::{Surface, element, unfit};
use crate::Error;
use std::ops::Range;
use trueaxis_form::placed::place;
use trueaxis_form::{Criterion, Element, Known};
use trueaxis_geometry::Vec3;
use trueaxis_geometry::surface::SurfacePoint;

impl Surface<'_> {
    /// The least straight of the lines of a plane along its first edge, of those of a cylinder or cone along its axis.
    pub(super) fn line_straightness(&self) -> Result<f64, Error> {
        let rows = &self.feature.sections;
        let lines: Vec<(Vec<usize>, Vec3)> = match self.feature.geometry.axis() {
            None => {
                let normal = self.across_rows()?;
                rows.iter().map(|row| (row.clone().collect(), normal)).collect()
            }
            // The points that stand at one angle of all sections; their plane holds the axis and the normals.
            Some((_, axis)) => {
                let around = rows.iter().map(Range::len).min().unwrap_or(0);
                let line = |k: usize| {
                    let out = self.feature.points[rows[0].start + k].normal;
                    (rows.iter().map(|row| row.start + k).collect(), axis.cross(&out).normalize())
                };
                (0..around).map(line).collect()
            }
        };
        // What an opening leaves of a line may be two points, which are straight.
        let whole = || lines.iter().filter(|(line, _)| line.len() > 2);
        if whole().next().is_none() {
            return Err(unfit("no line of it has three points"));
        }
        whole().try_fold(0.0, |most: f64, (line, normal)| {
            let places: Vec<Vec3> = line.iter().map(|i| self.places_mm[*i]).collect();
            let known = Known { normal: Some(*normal), ..Known::default() };
            let found = element(Element::Line, Criterion::MinimumZone, &places, &known)?;
            Ok(most.max(found.form_mm()))
        })
    }

    /// Twice the largest distance of a line from its nominal one in its plane, each where what the datums leave free makes that least.
    pub(super) fn line_profile(&self, frame: &DatumFrame) -> Result<f64, Error> {
        let across = self.across_rows()?;
        let free = frame.free.moving(&held(self.feature));
        let seen = frame.seen(&self.in_rows(&across));
        let rows = &self.feature.sections;
        rows.iter().try_fold(0.0, |most: f64, row| {
            // Outside and inside of the nominal line: twice the same points.
            let places: Vec<Vec3> = [&seen[row.clone()], &seen[row.clone()]].concat();
            let distance = |i: usize, place: &Vec3| {
                let (value, gradient) = self.off_line(row.start + i % row.len(), place, &across);
                if i < row.len() { (value, gradient) } else { (-value, -gradient) }
            };
            let placed = place(&places, &free, &distance, Criterion::MinimumCircumscribed)?;
            Ok(most.max(2.0 * placed.high_mm))
        })
    }

    fn across_rows(&self) -> Result<Vec3, Error> {
        self.feature.geometry.across_rows().ok_or_else(|| unfit("lines of what has no rows"))
    }

    /// The places of the cut surface in the planes of their rows: material along a normal that leans out of its plane by β is 1/cos β of it
    /// there, as in docs/model.md eq. 21.
    pub(super) fn in_rows(&self, across: &Vec3) -> Vec<Vec3> {
        let place = |(point, off): (&SurfacePoint, &f64)| {
            let out = point.normal - across * point.normal.dot(across);
            point.point_mm + out * (off / out.norm_squared())
        };
        self.feature.points.iter().zip(self.deviation_mm).map(place).collect()
    }

    /// How far a place is outside of the nominal line on which point `i` lies, in the plane of that, and where that grows.
    fn off_line(&self, i: usize, place: &Vec3, across: &Vec3) -> (f64, Vec3) {
        let point = &self.feature.points[i];
        let (value, gradient) = match self.feature.geometry {
            // To first order: it is not known how the surface bends.
            Geometry::Points | Geometry::Programmed { .. } => {
                (point.normal.dot(&(place - point.point_mm)), point.normal)
            }
            shape => shape.outside(place).unwrap_or((f64::NAN, Vec3::zeros())),
        };
        let within = (point.normal - across * point.normal.dot(across)).norm();
        (value / within, gradient / within)
    }
}
