//! Patterns of holes: rows, circles and grids, each hole after the other.

use trueaxis_contour::plane::{along, length, minus};

use crate::Point;

/// Holes of one pattern: more than any program means.
pub const MOST_HOLES: u32 = 100_000;

fn direction(angle_deg: f64) -> Point {
    let (sin, cos) = angle_deg.to_radians().sin_cos();
    [cos, sin]
}

/// Holes on a straight line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Row {
    /// The reference point, mm.
    pub from: Point,
    /// The direction against the first axis, degrees.
    pub angle_deg: f64,
    /// The distance of the first hole from the reference point, mm.
    pub first_mm: f64,
    /// The distance from hole to hole, mm.
    pub spacing_mm: f64,
    /// How many.
    pub count: u32,
}

impl Row {
    /// The holes, from the first one on.
    pub fn holes(&self) -> Vec<Point> {
        let d = direction(self.angle_deg);
        let far = |i: u32| self.first_mm + f64::from(i) * self.spacing_mm;
        (0..self.count.min(MOST_HOLES)).map(|i| along(self.from, d, far(i))).collect()
    }
}

/// The holes in their order, or backwards where the last one is nearer to a place.
pub fn from_nearer_end(mut holes: Vec<Point>, place: Point) -> Vec<Point> {
    let away = |hole: Option<&Point>| hole.map_or(0.0, |h| length(minus(*h, place)));
    if away(holes.last()) < away(holes.first()) {
        holes.reverse();
    }
    holes
}

/// Holes on a circle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Circle {
    /// Its centre, mm.
    pub center: Point,
    /// Its radius, mm.
    pub radius_mm: f64,
    /// The direction of the first hole from the centre, degrees.
    pub start_deg: f64,
    /// The angle from hole to hole, counter-clockwise positive, degrees.
    pub step_deg: f64,
    /// How many.
    pub count: u32,
}

impl Circle {
    /// The holes, from the first one on.
    pub fn holes(&self) -> Vec<Point> {
        let at = |i: u32| direction(self.start_deg + f64::from(i) * self.step_deg);
        (0..self.count.min(MOST_HOLES)).map(|i| along(self.center, at(i), self.radius_mm)).collect()
    }
}

/// Holes in rows, every second row backwards.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Grid {
    /// The first hole, mm.
    pub from: Point,
    /// The direction of the rows against the first axis, degrees.
    pub angle_deg: f64,
    /// The distances within a row and from row to row, mm.
    pub spacing_mm: [f64; 2],
    /// Holes in a row, and rows.
    pub counts: [u32; 2],
}

impl Grid {
    /// The holes, row by row.
    pub fn holes(&self) -> Vec<Point> {
        let (d, across) = (direction(self.angle_deg), direction(self.angle_deg + 90.0));
        let [columns, rows] = self.counts.map(|n| n.min(MOST_HOLES));
        let mut holes = Vec::new();
        for row in 0..rows {
            let begin = along(self.from, across, f64::from(row) * self.spacing_mm[1]);
            for i in 0..columns {
                let column = if row % 2 == 0 { i } else { columns - 1 - i };
                holes.push(along(begin, d, f64::from(column) * self.spacing_mm[0]));
                if holes.len() >= MOST_HOLES as usize {
                    return holes;
                }
            }
        }
        holes
    }
}

/// Places on two families of parallel lines, which need not be perpendicular.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Lattice {
    /// The first place, mm.
    pub from: Point,
    /// The directions within a row and from row to row, degrees.
    pub angles_deg: [f64; 2],
    /// The distances within a row and from row to row, mm.
    pub spacing_mm: [f64; 2],
    /// Places in a row, and rows.
    pub counts: [u32; 2],
}

impl Lattice {
    fn place(&self, column: u32, row: u32) -> Point {
        let [a, b] = self.angles_deg.map(direction);
        let begin = along(self.from, b, f64::from(row) * self.spacing_mm[1]);
        along(begin, a, f64::from(column) * self.spacing_mm[0])
    }

    /// All places, every second row backwards.
    pub fn places(&self) -> Vec<Point> {
        let [columns, rows] = self.counts.map(|n| n.min(MOST_HOLES));
        let mut places = Vec::new();
        for row in 0..rows {
            for i in 0..columns {
                let column = if row % 2 == 0 { i } else { columns - 1 - i };
                places.push(self.place(column, row));
                if places.len() >= MOST_HOLES as usize {
                    return places;
                }
            }
        }
        places
    }

    /// The outermost places, once around.
    pub fn frame(&self) -> Vec<Point> {
        let [columns, rows] = self.counts.map(|n| n.clamp(1, MOST_HOLES));
        let (right, top) = (columns - 1, rows - 1);
        let mut places: Vec<_> = (0..columns).map(|i| self.place(i, 0)).collect();
        places.extend((1..rows).map(|i| self.place(right, i)));
        if top > 0 {
            places.extend((0..right).rev().map(|i| self.place(i, top)));
        }
        if right > 0 {
            places.extend((1..top).rev().map(|i| self.place(0, i)));
        }
        places.truncate(MOST_HOLES as usize);
        places
    }
}

/// The depths of pecks whose strokes become shorter, as positive distances from the surface; the last one is
/// the whole depth.
///
/// Each stroke is `next` of the stroke before, until the whole depth; `None` where a stroke is 0 or there are
/// more than `most`.
pub fn peck_depths(
    depth_mm: f64,
    first_mm: f64,
    most: usize,
    mut next: impl FnMut(f64) -> f64,
) -> Option<Vec<f64>> {
    let (mut stroke, mut depth, mut depths) = (first_mm, 0.0, Vec::new());
    while depths.len() < most {
        if stroke.is_nan() || stroke <= 0.0 {
            return None;
        }
        depth += stroke;
        if depth >= depth_mm - 1e-9 {
            depths.push(depth_mm);
            return Some(depths);
        }
        depths.push(depth);
        stroke = next(stroke);
    }
    None
}

/// The same where each stroke is shorter than the one before by an amount: once it would be smaller than that,
/// the strokes have the amount, and the last two share what remains.
pub fn pecks_less_by(
    depth_mm: f64,
    first_mm: f64,
    amount_mm: f64,
    most: usize,
) -> Option<Vec<f64>> {
    if amount_mm.is_nan() || amount_mm <= 0.0 {
        return None;
    }
    let (mut depths, mut depth) = (vec![first_mm.min(depth_mm)], first_mm);
    let mut stroke = first_mm;
    while depth < depth_mm - 1e-9 {
        let remaining = depth_mm - depth;
        stroke = (stroke - amount_mm).max(amount_mm);
        if stroke <= amount_mm && remaining < 2.0 * amount_mm {
            depths.extend((remaining > amount_mm).then_some(depth + remaining / 2.0));
            depths.push(depth_mm);
            return Some(depths);
        }
        depth = (depth + stroke).min(depth_mm);
        depths.push(depth);
        if depths.len() > most {
            return None;
        }
    }
    Some(depths)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn close(found: &[Point], wanted: &[Point]) -> bool {
        found.len() == wanted.len()
            && found.iter().zip(wanted).all(|(a, b)| length(minus(*a, *b)) < 1e-9)
    }

    #[test]
    fn rows_circles_and_grids_by_hand() {
        let row =
            Row { from: [20.0, 30.0], angle_deg: 90.0, first_mm: 10.0, spacing_mm: 20.0, count: 3 };
        assert!(close(&row.holes(), &[[20.0, 40.0], [20.0, 60.0], [20.0, 80.0]]));
        assert!(close(&from_nearer_end(row.holes(), [0.0, 99.0])[..1], &[[20.0, 80.0]]));
        let circle = Circle {
            center: [70.0, 60.0],
            radius_mm: 42.0,
            start_deg: 0.0,
            step_deg: 90.0,
            count: 4,
        };
        let holes = [[112.0, 60.0], [70.0, 102.0], [28.0, 60.0], [70.0, 18.0]];
        assert!(close(&circle.holes(), &holes));
        let grid =
            Grid { from: [1.0, 2.0], angle_deg: 0.0, spacing_mm: [10.0, 5.0], counts: [2, 3] };
        let rows = [[1.0, 2.0], [11.0, 2.0], [11.0, 7.0], [1.0, 7.0], [1.0, 12.0], [11.0, 12.0]];
        assert!(close(&grid.holes(), &rows));
        let lattice = Lattice {
            from: [1.0, 2.0],
            angles_deg: [0.0, 90.0],
            spacing_mm: [10.0, 5.0],
            counts: [3, 3],
        };
        assert_eq!(lattice.places().len(), 9);
        let frame = [(0, 0), (1, 0), (2, 0), (2, 1), (2, 2), (1, 2), (0, 2), (0, 1)];
        let frame = frame.map(|(i, j)| [1.0 + 10.0 * f64::from(i), 2.0 + 5.0 * f64::from(j)]);
        assert!(close(&lattice.frame(), &frame));
        let line = Lattice { counts: [1, 3], ..lattice };
        assert!(close(&line.frame(), &line.places()));
    }

    #[test]
    fn pecks_become_shorter() {
        // 10, 9, 8.1 … to 0.9 of the one before, none below 8.5.
        let depths = peck_depths(40.0, 10.0, 99, |s| (0.9 * s).max(8.5)).unwrap();
        assert_eq!(depths, [10.0, 19.0, 27.5, 36.0, 40.0]);
        // 20, then 20 - 8 = 12, then 8 as long as more than 16 remain; the remaining 10 in halves.
        let depths = pecks_less_by(50.0, 20.0, 8.0, 99).unwrap();
        assert_eq!(depths, [20.0, 32.0, 40.0, 45.0, 50.0]);
        assert_eq!(peck_depths(10.0, 1.0, 5, |s| s), None);
        assert_eq!(peck_depths(10.0, 1.0, 50, |_| 0.0), None);
    }
}
