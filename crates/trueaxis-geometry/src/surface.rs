//! Points of a surface, evenly spread, with their outward normals.

use crate::Vec3;
use std::collections::BTreeMap;

/// The normal at a point is that of the plane through so many neighbours.
const NEIGHBOURS: usize = 16;
/// Facets are not divided into more candidates.
const MOST_CANDIDATES: usize = 400_000;

/// A triangle by its corners, counter-clockwise seen from outside, mm.
pub type Facet = [Vec3; 3];

/// A point of a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SurfacePoint {
    /// Where it is, mm.
    pub point_mm: Vec3,
    /// Outward normal, a unit vector.
    pub normal: Vec3,
    /// From which side it was reached: a tool axis, or the normal.
    pub axis: Vec3,
    /// Its line in a file; 0 if it has none.
    pub line: u32,
}

/// The points to choose from.
#[derive(Debug, Clone, PartialEq)]
pub enum Candidates {
    /// Points with a direction that is the normal, or only on its side.
    Points {
        /// In the order of the file.
        points: Vec<SurfacePoint>,
        /// The directions are normals; else normals come from the points around.
        are_normals: bool,
    },
    /// Triangles.
    Facets(Vec<Facet>),
}

/// Points at least `spacing_mm` apart, in the order of the file.
///
/// # Errors
/// In words: more than `most` points, or too many candidates.
pub fn spread(
    candidates: &Candidates,
    spacing_mm: f64,
    most: usize,
) -> Result<Vec<SurfacePoint>, String> {
    let mut chosen = Chosen { spacing_mm, cells: BTreeMap::new(), points: Vec::new() };
    match candidates {
        Candidates::Points { points, are_normals } => {
            points.iter().for_each(|p| chosen.offer(*p));
            if !are_normals && chosen.points.len() <= most {
                let normal = |p: &SurfacePoint| normal_from_neighbours(p, points);
                let normals: Vec<Vec3> = chosen.points.iter().map(normal).collect();
                chosen.points.iter_mut().zip(normals).for_each(|(p, n)| p.normal = n);
            }
        }
        Candidates::Facets(facets) => {
            let mut count = 0_usize;
            for facet in facets {
                let steps = divisions(facet, spacing_mm);
                count = count.saturating_add(steps * (steps + 1) / 2);
                if count > MOST_CANDIDATES {
                    return Err(format!(
                        "a spacing of {spacing_mm} mm makes more than {MOST_CANDIDATES} places to look at"
                    ));
                }
                within(facet, steps).for_each(|p| chosen.offer(p));
            }
            chosen.points = shortest(std::mem::take(&mut chosen.points), most);
        }
    }
    match chosen.points.len() {
        count if count > most => Err(format!("{count} points are more than {most}")),
        _ => Ok(chosen.points),
    }
}

/// Points so far, by cubes of the spacing.
struct Chosen {
    spacing_mm: f64,
    cells: BTreeMap<[i64; 3], Vec<Vec3>>,
    points: Vec<SurfacePoint>,
}

impl Chosen {
    #[expect(clippy::cast_possible_truncation, reason = "cells of the grid are far below 2^63")]
    fn offer(&mut self, point: SurfacePoint) {
        let cell: [i64; 3] = point.point_mm.map(|v| (v / self.spacing_mm).floor() as i64).into();
        let near = |at: &[i64; 3]| {
            let points = self.cells.get(at);
            points.is_some_and(|all| {
                all.iter().any(|p| (p - point.point_mm).norm() < self.spacing_mm * (1.0 - 1e-9))
            })
        };
        // Saturating: a far point in tiny cells has no neighbour cell, and must not overflow.
        let around = (0..27).map(|i: i64| {
            let steps = [i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1];
            [0, 1, 2].map(|k: usize| cell[k].saturating_add(steps[k]))
        });
        if around.into_iter().any(|at| near(&at)) {
            return;
        }
        self.cells.entry(cell).or_default().push(point.point_mm);
        self.points.push(point);
    }
}

/// How often the edges of a facet are divided so that no place is far from a candidate.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the quotient is positive, and larger ones are limited to 1000"
)]
fn divisions(facet: &Facet, spacing_mm: f64) -> usize {
    let longest = (0..3).map(|i| (facet[i] - facet[(i + 1) % 3]).norm()).fold(0.0, f64::max);
    ((2.0 * longest / spacing_mm).ceil() as usize).clamp(1, 1000)
}

/// Centres of the small triangles of a divided facet that stand as it does.
fn within(facet: &Facet, steps: usize) -> impl Iterator<Item = SurfacePoint> + '_ {
    let (u, v) = (facet[1] - facet[0], facet[2] - facet[0]);
    let normal = u.cross(&v).try_normalize(0.0).unwrap_or_else(Vec3::z);
    let third = move |i: usize| (i as f64 + 1.0 / 3.0) / steps as f64;
    (0..steps).flat_map(move |i| (0..steps - i).map(move |j| (i, j))).map(move |(i, j)| {
        let point_mm = facet[0] + u * third(i) + v * third(j);
        SurfacePoint { point_mm, normal, axis: normal, line: 0 }
    })
}

/// From each point to the next one; a file of facets has no order of its own.
fn shortest(mut points: Vec<SurfacePoint>, most: usize) -> Vec<SurfacePoint> {
    if points.len() > most {
        return points;
    }
    for done in 1..points.len() {
        let here = points[done - 1].point_mm;
        let distance = |p: &SurfacePoint| (p.point_mm - here).norm_squared();
        let rest = points[done..].iter().enumerate();
        let next = rest.min_by(|a, b| distance(a.1).total_cmp(&distance(b.1)));
        if let Some((i, _)) = next {
            points.swap(done, done + i);
        }
    }
    points
}

/// The normal of the plane through the nearest points, on the side of the stated direction.
///
/// ```text
///     min Σ (n·(p_i − p̄))²        |n| = 1                                            docs/model.md eq. 145
/// ```
fn normal_from_neighbours(point: &SurfacePoint, all: &[SurfacePoint]) -> Vec3 {
    let mut near: Vec<(f64, Vec3)> =
        all.iter().map(|p| ((p.point_mm - point.point_mm).norm_squared(), p.point_mm)).collect();
    let count = NEIGHBOURS.min(near.len());
    if count < near.len() {
        near.select_nth_unstable_by(count, |a, b| a.0.total_cmp(&b.0));
    }
    let near = &near[..count];
    let mean = near.iter().map(|p| p.1).sum::<Vec3>() / count.max(1) as f64;
    let mut scatter = nalgebra::Matrix3::zeros();
    near.iter().for_each(|p| scatter += (p.1 - mean) * (p.1 - mean).transpose());
    let eigen = scatter.symmetric_eigen();
    let thinnest = eigen.eigenvalues.imin();
    let normal: Vec3 = eigen.eigenvectors.column(thinnest).into_owned();
    // Points on one line have no plane.
    let mut sizes: Vec<f64> = eigen.eigenvalues.iter().copied().collect();
    sizes.sort_by(f64::total_cmp);
    match sizes[1] > 1e-6 * sizes[2] {
        true if normal.dot(&point.normal) < 0.0 => -normal,
        true => normal,
        false => point.normal,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn facets_give_points_a_spacing_apart_with_their_normal() {
        let facet = [Vec3::zeros(), Vec3::new(20.0, 0.0, 0.0), Vec3::new(0.0, 20.0, 0.0)];
        let points = spread(&Candidates::Facets(vec![facet]), 5.0, 100).unwrap();
        assert!(points.len() > 5 && points.iter().all(|p| p.normal == Vec3::z()));
        for (i, a) in points.iter().enumerate() {
            assert!(points[..i].iter().all(|b| (a.point_mm - b.point_mm).norm() >= 5.0 - 1e-6));
        }
        assert!(spread(&Candidates::Facets(vec![facet]), 5.0, 3).is_err());
        assert!(spread(&Candidates::Facets(vec![facet]), 1e-9, 3).is_err());
    }

    #[test]
    fn a_normal_comes_from_the_points_around_and_its_side_from_the_tool_axis() {
        let at = |i: i32| Vec3::new(f64::from(i % 5), f64::from(i / 5), 0.5 * f64::from(i % 5));
        let axis = Vec3::new(0.0, 0.5, 0.8).normalize();
        let point = |i| SurfacePoint { point_mm: at(i), normal: axis, axis, line: 0 };
        let points = (0..25).map(point).collect();
        let found = spread(&Candidates::Points { points, are_normals: false }, 1.5, 100).unwrap();
        // The plane z = x/2.
        let normal = Vec3::new(-0.5, 0.0, 1.0).normalize();
        assert!(found.iter().all(|p| (p.normal - normal).norm() < 1e-9));
    }
}
