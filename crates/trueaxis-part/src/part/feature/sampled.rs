//! Points of a nominal surface, row by row.

use super::{Geometry, MOST_POINTS, across};
use std::f64::consts::TAU;
use std::ops::Range;
use trueaxis_geometry::Vec3;
use trueaxis_geometry::surface::SurfacePoint;

impl Geometry {
    /// Points no farther apart than `spacing_mm`, and which of them make a section; half a step from edges, where two surfaces
    /// meet.
    ///
    /// # Errors
    /// In words: too many points.
    pub fn sampled(
        &self,
        spacing_mm: f64,
    ) -> Result<(Vec<SurfacePoint>, Vec<Range<usize>>), String> {
        let rows = self.rows(spacing_mm);
        let count: usize = rows.iter().map(|row| row.count).fold(0, usize::saturating_add);
        if count > MOST_POINTS {
            return Err(format!(
                "a spacing of {spacing_mm} mm makes {count} points, at most {MOST_POINTS} are checked"
            ));
        }
        let (mut points, mut sections) = (Vec::with_capacity(count), Vec::new());
        for row in rows {
            let from = points.len();
            points.extend((0..row.count).map(|k| (row.at)(k)));
            sections.push(from..points.len());
        }
        if self.axis().is_none() {
            sections.clear();
        }
        Ok((points, sections))
    }

    fn rows(&self, spacing_mm: f64) -> Vec<Row> {
        match *self {
            Self::Plane { at_mm, normal, along, size_mm }
            | Self::Programmed { at_mm, normal, along, size_mm, .. } => {
                rectangle(at_mm, (normal, along), size_mm, spacing_mm).collect()
            }
            Self::Cylinder { at_mm, axis, radius_mm, length_mm, is_hole } => {
                round(at_mm, axis, [radius_mm; 2], length_mm, (is_hole, spacing_mm))
            }
            Self::Cone { at_mm, axis, radii_mm, length_mm, is_hole } => {
                round(at_mm, axis, radii_mm, length_mm, (is_hole, spacing_mm))
            }
            Self::Sphere { at_mm, axis, radius_mm, opening_rad, is_hole } => {
                let [x, y] = across(&axis);
                let sign = if is_hole { -1.0 } else { 1.0 };
                let count = steps(radius_mm * opening_rad, spacing_mm);
                let row = |j: usize| {
                    let (sin, cos) = (opening_rad * middle(j, count)).sin_cos();
                    let around = turns(radius_mm * sin, spacing_mm);
                    Row::new(around, move |k| {
                        let (s, c) = turn(k, around).sin_cos();
                        let out = axis * cos + (x * c + y * s) * sin;
                        point(at_mm + out * radius_mm, out * sign)
                    })
                };
                (0..count).map(row).collect()
            }
            Self::Torus { at_mm, axis, ring_mm, radius_mm, section_rad: [from, to], is_hole } => {
                let [x, y] = across(&axis);
                let sign = if is_hole { -1.0 } else { 1.0 };
                let count = steps(radius_mm * (to - from), spacing_mm);
                let row = |j: usize| {
                    let (sin, cos) = (from + (to - from) * middle(j, count)).sin_cos();
                    let ring = ring_mm + radius_mm * cos;
                    let around = turns(ring, spacing_mm);
                    Row::new(around, move |k| {
                        let (s, c) = turn(k, around).sin_cos();
                        let out = x * c + y * s;
                        let normal = out * cos + axis * sin;
                        point(at_mm + out * ring_mm + normal * radius_mm, normal * sign)
                    })
                };
                (0..count).map(row).collect()
            }
            Self::Slot { at_mm, across, along, size_mm, width_mm, is_hole } => {
                // Both faces in the same order, so that points that face each other make pairs.
                let face = |side: f64| {
                    let normal = across * if is_hole { -side } else { side };
                    let at_mm = at_mm + across * (0.5 * side * width_mm);
                    let rows = rectangle(at_mm, (across, along), size_mm, spacing_mm);
                    rows.map(move |row| row.with_normal(normal))
                };
                face(1.0).chain(face(-1.0)).collect()
            }
            Self::Points => Vec::new(),
        }
    }
}

/// Points of a row, made one by one so that too many are never made.
struct Row {
    count: usize,
    at: Box<dyn Fn(usize) -> SurfacePoint>,
}

impl Row {
    fn new(count: usize, at: impl Fn(usize) -> SurfacePoint + 'static) -> Self {
        Self { count, at: Box::new(at) }
    }

    fn with_normal(self, normal: Vec3) -> Self {
        Self::new(self.count, move |k| point((self.at)(k).point_mm, normal))
    }
}

/// Rows of a rectangle about its middle.
fn rectangle(
    at_mm: Vec3,
    (normal, along): (Vec3, Vec3),
    size_mm: [f64; 2],
    spacing_mm: f64,
) -> impl Iterator<Item = Row> {
    let across = normal.cross(&along);
    // A single row would be a line, through which no plane is laid.
    let counts = size_mm.map(|size| steps(size, spacing_mm).max(2));
    let offset = move |i: usize, k: usize| size_mm[i] * (middle(k, counts[i]) - 0.5);
    (0..counts[1]).map(move |j| {
        let from = at_mm + across * offset(1, j);
        Row::new(counts[0], move |i| point(from + along * offset(0, i), normal))
    })
}

/// Sections of a cylinder or cone.
fn round(
    at_mm: Vec3,
    axis: Vec3,
    radii_mm: [f64; 2],
    length_mm: f64,
    (is_hole, spacing_mm): (bool, f64),
) -> Vec<Row> {
    let [x, y] = across(&axis);
    let sign = if is_hole { -1.0 } else { 1.0 };
    let rise = radii_mm[1] - radii_mm[0];
    let slant = length_mm.hypot(rise);
    let count = steps(slant, spacing_mm).max(2);
    let around = turns(radii_mm[0].max(radii_mm[1]), spacing_mm);
    let row = |j: usize| {
        let along = middle(j, count);
        let radius = radii_mm[0] + rise * along;
        let from = at_mm + axis * (length_mm * along);
        Row::new(around, move |k| {
            let (s, c) = turn(k, around).sin_cos();
            let out = x * c + y * s;
            let normal = (out * length_mm - axis * rise) / slant;
            point(from + out * radius, normal * sign)
        })
    };
    (0..count).map(row).collect()
}

fn point(point_mm: Vec3, normal: Vec3) -> SurfacePoint {
    SurfacePoint { point_mm, normal, axis: normal, line: 0 }
}

/// As many steps of at most the spacing as a length has.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the quotient is positive, and larger ones are limited"
)]
fn steps(length_mm: f64, spacing_mm: f64) -> usize {
    ((length_mm / spacing_mm).ceil() as usize).clamp(1, MOST_POINTS)
}

/// Points around a circle: no fewer than show its form.
fn turns(radius_mm: f64, spacing_mm: f64) -> usize {
    steps(TAU * radius_mm, spacing_mm).max(24)
}

fn middle(step: usize, count: usize) -> f64 {
    (step as f64 + 0.5) / count as f64
}

fn turn(step: usize, count: usize) -> f64 {
    TAU * step as f64 / count as f64
}
