//! Points of a nominal surface, row by row.

use super::{Feature, Geometry, MOST_POINTS, across};
use std::f64::consts::TAU;
use std::ops::Range;
use trueaxis_geometry::Vec3;
use trueaxis_geometry::surface::SurfacePoint;

/// How far the outermost points are from the edges, where two surfaces meet. Unit: mm.
const EDGE_MM: f64 = 0.25;

/// How points are chosen on a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Extraction {
    /// No farther apart than so much, mm.
    Spacing(f64),
    /// As a measuring machine does: so many rows or sections, with so many points each.
    Grid {
        /// Rows, or sections across the axis.
        rows: usize,
        /// Points of each.
        points: usize,
    },
    /// So many points along a helix with so many turns, from end to end of a cylinder or a hole.
    Helix {
        /// Turns. Unit: 1.
        turns: f64,
        /// Points.
        points: usize,
    },
}

impl Extraction {
    fn around(self, radius_mm: f64) -> usize {
        match self {
            Self::Spacing(spacing_mm) => turns(radius_mm, spacing_mm),
            Self::Grid { points, .. } | Self::Helix { points, .. } => points,
        }
    }

    /// Rows or sections along a length, at least so many steps.
    fn rows(self, least: usize, length_mm: f64) -> Along {
        match self {
            Self::Spacing(spacing_mm) => Along::of_at_least(least, length_mm, spacing_mm),
            Self::Grid { rows, .. } => Along::of(rows, length_mm),
            Self::Helix { .. } => Along::of(1, length_mm),
        }
    }

    /// Points of a row.
    fn row(self, least: usize, length_mm: f64) -> Along {
        match self {
            Self::Spacing(spacing_mm) => Along::of_at_least(least, length_mm, spacing_mm),
            Self::Grid { points, .. } | Self::Helix { points, .. } => Along::of(points, length_mm),
        }
    }
}

/// Points of a surface.
#[derive(Debug, Clone, Default)]
pub struct Sampled {
    /// Row after row.
    pub points: Vec<SurfacePoint>,
    /// Which remain with every second row, with the other rows, with every second point of each row, and with the others.
    pub is_kept: Vec<[bool; 4]>,
    /// Which points make a row, of what has an axis a section across it.
    pub sections: Vec<Range<usize>>,
}

impl Sampled {
    /// Points in an order of their own.
    pub fn of_table(points: Vec<SurfacePoint>) -> Self {
        let is_kept = every_second(points.len());
        Self { points, is_kept, sections: Vec::new() }
    }

    /// Without the points that are not there.
    pub fn keep(&mut self, is_there: &[bool]) {
        self.sections = kept_rows(&self.sections, is_there);
        retain(&mut self.points, is_there);
        retain(&mut self.is_kept, is_there);
    }
}

impl Feature {
    /// Without the points that are not there; halves of its points are those of a table then.
    pub fn keep(&mut self, is_there: &[bool]) {
        self.sections = kept_rows(&self.sections, is_there);
        retain(&mut self.points, is_there);
        self.is_kept = every_second(self.points.len());
    }
}

fn retain<T>(items: &mut Vec<T>, is_there: &[bool]) {
    let mut each = is_there.iter();
    items.retain(|_| each.next().is_some_and(|is| *is));
}

/// Rows of points of which some are not there; none is empty.
pub(super) fn kept_rows(rows: &[Range<usize>], is_there: &[bool]) -> Vec<Range<usize>> {
    let mut from = 0;
    let row = |range: &Range<usize>| {
        let count = is_there[range.clone()].iter().filter(|is| **is).count();
        from += count;
        from - count..from
    };
    rows.iter().map(row).filter(|row| !row.is_empty()).collect()
}

impl Geometry {
    /// Points, and which of them make a row; they reach to 0.25 mm from the edges, however many there are.
    ///
    /// # Errors
    /// In words: too many points.
    pub fn sampled(&self, extraction: Extraction) -> Result<Sampled, String> {
        if let Extraction::Helix { turns, points } = extraction
            && (2..=MOST_POINTS).contains(&points)
        {
            let points = self.helix(turns, points);
            return points
                .map(Sampled::of_table)
                .ok_or_else(|| format!("a {} has no helix", self.name()));
        }
        let rows = self.rows(extraction);
        let count: usize = rows.iter().map(|row| row.count).fold(0, usize::saturating_add);
        if count > MOST_POINTS {
            return Err(match extraction {
                Extraction::Spacing(spacing_mm) => format!(
                    "a spacing of {spacing_mm} mm makes {count} points, at most {MOST_POINTS} are checked"
                ),
                Extraction::Grid { .. } | Extraction::Helix { .. } => {
                    format!("{count} points are asked for, at most {MOST_POINTS} are checked")
                }
            });
        }
        let mut sampled = Sampled::default();
        // Points of a slot that face each other are kept together.
        let face = if self.median().is_some() { rows.len() / 2 } else { rows.len() };
        for (j, row) in rows.into_iter().enumerate() {
            let from = sampled.points.len();
            sampled.points.extend((0..row.count).map(|k| (row.at)(k)));
            let rows = alternate(j % face, face);
            let points = (0..row.count).map(|k| alternate(k, row.count));
            sampled.is_kept.extend(points.map(|[a, b]| [rows[0], rows[1], a, b]));
            sampled.sections.push(from..sampled.points.len());
        }
        Ok(sampled)
    }

    /// Points along a helix; they make no sections.
    fn helix(&self, turns: f64, points: usize) -> Option<Vec<SurfacePoint>> {
        let Self::Cylinder { at_mm, axis, radius_mm, length_mm, is_hole } = *self else {
            return None;
        };
        let [x, y] = across(&axis);
        let sign = if is_hole { -1.0 } else { 1.0 };
        let along = Along::of(points, length_mm);
        let place = |k: usize| {
            let (s, c) = (TAU * turns * k as f64 / (points - 1) as f64).sin_cos();
            let out = x * c + y * s;
            point(at_mm + axis * (length_mm * along.share(k)) + out * radius_mm, out * sign)
        };
        Some((0..points).map(place).collect())
    }

    fn rows(&self, extraction: Extraction) -> Vec<Row> {
        match *self {
            Self::Plane { at_mm, normal, along, size_mm }
            | Self::Programmed { at_mm, normal, along, size_mm, .. } => {
                rectangle(at_mm, (normal, along), size_mm, extraction).collect()
            }
            Self::Cylinder { at_mm, axis, radius_mm, length_mm, is_hole } => {
                round(at_mm, axis, [radius_mm; 2], length_mm, (is_hole, extraction))
            }
            Self::Cone { at_mm, axis, radii_mm, length_mm, is_hole } => {
                round(at_mm, axis, radii_mm, length_mm, (is_hole, extraction))
            }
            Self::Sphere { at_mm, axis, radius_mm, opening_rad, is_hole } => {
                let [x, y] = across(&axis);
                let sign = if is_hole { -1.0 } else { 1.0 };
                let rows = extraction.rows(4, radius_mm * opening_rad);
                let row = |share: f64| {
                    let (sin, cos) = (opening_rad * share).sin_cos();
                    let around = extraction.around(radius_mm * sin);
                    Row::new(around, move |k| {
                        let (s, c) = turn(k, around).sin_cos();
                        let out = axis * cos + (x * c + y * s) * sin;
                        point(at_mm + out * radius_mm, out * sign)
                    })
                };
                rows.shares().map(row).collect()
            }
            Self::Torus { at_mm, axis, ring_mm, radius_mm, section_rad: [from, to], is_hole } => {
                let [x, y] = across(&axis);
                let sign = if is_hole { -1.0 } else { 1.0 };
                let rows = extraction.rows(4, radius_mm * (to - from));
                let row = |share: f64| {
                    let (sin, cos) = (from + (to - from) * share).sin_cos();
                    let ring = ring_mm + radius_mm * cos;
                    let around = extraction.around(ring);
                    Row::new(around, move |k| {
                        let (s, c) = turn(k, around).sin_cos();
                        let out = x * c + y * s;
                        let normal = out * cos + axis * sin;
                        point(at_mm + out * ring_mm + normal * radius_mm, normal * sign)
                    })
                };
                rows.shares().map(row).collect()
            }
            Self::Slot { at_mm, across, along, size_mm, width_mm, is_hole } => {
                // Both faces in the same order, so that points that face each other make pairs.
                let face = |side: f64| {
                    let normal = across * if is_hole { -side } else { side };
                    let at_mm = at_mm + across * (0.5 * side * width_mm);
                    let rows = rectangle(at_mm, (across, along), size_mm, extraction);
                    rows.map(move |row| row.with_normal(normal))
                };
                face(1.0).chain(face(-1.0)).collect()
            }
            Self::Points => Vec::new(),
        }
    }
}

/// Whether one of many belongs to every second one, and to the others with both ends.
fn alternate(step: usize, count: usize) -> [bool; 2] {
    [step.is_multiple_of(2), step % 2 == 1 || step == 0 || step + 1 == count]
}

/// The same for points without rows.
fn every_second(count: usize) -> Vec<[bool; 4]> {
    let of = |i| {
        let [one, other] = alternate(i, count);
        [one, other, one, other]
    };
    (0..count).map(of).collect()
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
    extraction: Extraction,
) -> impl Iterator<Item = Row> {
    let across = normal.cross(&along);
    // Fewer could all lie at the same side of the tool's rows.
    let row = extraction.row(8, size_mm[0]);
    let rows = extraction.rows(8, size_mm[1]);
    rows.shares().map(move |share| {
        let from = at_mm + across * (size_mm[1] * (share - 0.5));
        let at = move |i| point(from + along * (size_mm[0] * (row.share(i) - 0.5)), normal);
        Row::new(row.count, at)
    })
}

/// Sections of a cylinder or cone.
fn round(
    at_mm: Vec3,
    axis: Vec3,
    radii_mm: [f64; 2],
    length_mm: f64,
    (is_hole, extraction): (bool, Extraction),
) -> Vec<Row> {
    let [x, y] = across(&axis);
    let sign = if is_hole { -1.0 } else { 1.0 };
    let rise = radii_mm[1] - radii_mm[0];
    let slant = length_mm.hypot(rise);
    let around = extraction.around(radii_mm[0].max(radii_mm[1]));
    let row = |along: f64| {
        let radius = radii_mm[0] + rise * along;
        let from = at_mm + axis * (length_mm * along);
        Row::new(around, move |k| {
            let (s, c) = turn(k, around).sin_cos();
            let out = x * c + y * s;
            let normal = (out * length_mm - axis * rise) / slant;
            point(from + out * radius, normal * sign)
        })
    };
    extraction.rows(4, slant).shares().map(row).collect()
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
    steps(TAU * radius_mm, spacing_mm).next_multiple_of(2).max(48)
}

/// Points along a length: two of them near its ends, so that what leans is seen as a whole, and others between.
#[derive(Clone, Copy)]
struct Along {
    count: usize,
    /// Share of the length from an end to the first point.
    edge: f64,
}

impl Along {
    fn of_at_least(least: usize, length_mm: f64, spacing_mm: f64) -> Self {
        let edge_mm = EDGE_MM.min(0.1 * length_mm);
        // An even number of steps, so that every second point reaches to both ends, too.
        let count = steps(length_mm - 2.0 * edge_mm, spacing_mm).next_multiple_of(2).max(least);
        Self::of(count + 1, length_mm)
    }

    fn of(count: usize, length_mm: f64) -> Self {
        let edge_mm = EDGE_MM.min(0.1 * length_mm);
        Self { count, edge: edge_mm / length_mm }
    }

    fn share(self, step: usize) -> f64 {
        self.edge + (1.0 - 2.0 * self.edge) * step as f64 / (self.count - 1) as f64
    }

    fn shares(self) -> impl Iterator<Item = f64> {
        (0..self.count).map(move |step| self.share(step))
    }
}

fn turn(step: usize, count: usize) -> f64 {
    TAU * step as f64 / count as f64
}
