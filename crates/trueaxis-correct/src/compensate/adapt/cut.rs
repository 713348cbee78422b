//! The virtual cut: what a path leaves of a blank. It knows the path, the cutter and the blank, and
//! nothing of how the path was adapted.

use super::cutter::Cutter;
use super::near::{Stand, Stands};
use super::study::{Inner, Wall};
use super::table::SurfacePoint;
use rayon::prelude::*;
use trueaxis_cl::ClFile;
use trueaxis_geometry::Vec3;

/// Between two places of the sweep so much of a ridge may stay, mm.
const RIDGE_MM: f64 = 5e-5;
/// The tool axis turns by no more between two places, rad.
const TURN_RAD: f64 = 0.01;
/// More places than this, and the sweep becomes coarser.
const MOST_PLACES: usize = 3_000_000;
/// How far below and above the nominal blank is looked, mm.
const DEPTH_MM: f64 = 1.5;
/// Steps of a ray.
const MOST_STEPS: usize = 200;

/// What remains at one place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cell {
    /// On the nominal blank.
    pub at_mm: Vec3,
    /// Out of the material.
    pub normal: Vec3,
    /// The blank there before the cut, along the normal.
    pub blank_mm: f64,
    /// The surface after the cut, along the normal from the nominal blank.
    pub surface_mm: f64,
    /// What remains of the wall; 0 or less: cut through.
    pub wall_mm: f64,
}

impl Cell {
    /// How much was removed.
    pub fn removed_mm(&self) -> f64 {
        self.blank_mm - self.surface_mm
    }
}

/// Cuts a blank along a path: at each place of the blank a ray along its normal against the swept
/// cutter.
///
/// s = min over the sweep {s : D(p + s·n) = 0}, w = min(d, s) − inner      docs/model.md eq. 155
pub fn virtual_cut(
    path: &ClFile,
    cutter: &Cutter,
    wall: &Wall,
    blank: &[SurfacePoint],
) -> Vec<Cell> {
    let stands = sweep(path, cutter);
    let reach = Stands::reach(cutter, 2.0 * DEPTH_MM);
    blank
        .par_iter()
        .map(|point| {
            let deepest = -DEPTH_MM.max(wall.thickness_mm * 2.0);
            let mut lowest = point.deviation_mm;
            for stand in stands.near(&point.at_mm, reach) {
                lowest = enters(cutter, stand, point, deepest, lowest);
            }
            let inner = match wall.inner {
                Inner::Follows => point.deviation_mm - wall.thickness_mm,
                Inner::Nominal => -wall.thickness_mm,
            };
            Cell {
                at_mm: point.at_mm,
                normal: point.normal,
                blank_mm: point.deviation_mm,
                surface_mm: lowest,
                wall_mm: lowest - inner,
            }
        })
        .collect()
}

/// Where the ray enters the cutter from below, if that is lower than what is known.
fn enters(cutter: &Cutter, stand: &Stand, point: &SurfacePoint, deepest: f64, lowest: f64) -> f64 {
    let mut s = deepest;
    for _ in 0..MOST_STEPS {
        let at = point.at_mm + point.normal * s;
        let free = cutter.distance(&stand.tip, &stand.axis, &at);
        if free < 1e-9 {
            return s.min(lowest);
        }
        s += free;
        if s >= lowest {
            return lowest;
        }
    }
    s.min(lowest)
}

/// The places of the tool from point to point: the tip goes straight, the axis on the great circle.
fn sweep(path: &ClFile, cutter: &Cutter) -> Stands {
    let points: Vec<(Vec3, Vec3)> =
        path.points().map(|(_, p)| (Vec3::from(p.tip_mm), Vec3::from(p.axis))).collect();
    let step = (8.0 * cutter.radius_mm * RIDGE_MM).sqrt();
    let pieces = |step: f64, pair: &[(Vec3, Vec3)]| {
        let length = (pair[1].0 - pair[0].0).norm();
        let turn = pair[0].1.cross(&pair[1].1).norm().atan2(pair[0].1.dot(&pair[1].1));
        ((length / step).max(turn / TURN_RAD).ceil() as usize).max(1)
    };
    let total: usize = points.windows(2).map(|pair| pieces(step, pair)).sum();
    let step = step * (total as f64 / MOST_PLACES as f64).max(1.0);
    let mut stands = Vec::with_capacity(total.min(MOST_PLACES) + points.len() + 1);
    let first = points.first().map(|p| Stand { tip: p.0, axis: p.1 });
    stands.extend(first);
    for pair in points.windows(2) {
        let [(tip, axis), (to, next)] = [pair[0], pair[1]];
        let count = pieces(step, pair).min(MOST_PLACES);
        let angle = axis.cross(&next).norm().atan2(axis.dot(&next));
        for k in 1..=count {
            let u = k as f64 / count as f64;
            let turned = match angle > 1e-9 {
                true => axis * ((1.0 - u) * angle).sin() + next * (u * angle).sin(),
                false => next,
            };
            let axis = turned.try_normalize(1e-12).unwrap_or(next);
            stands.push(Stand { tip: tip + (to - tip) * u, axis });
        }
    }
    Stands::of(stands)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compensate::adapt::study::PathAt;
    use trueaxis_cl::Reading;

    #[test]
    fn a_ball_leaves_a_round_groove() {
        let text = b"FEDRAT/100\nGOTO/-5,0,-0.1\nGOTO/5,0,-0.1\nFINI\n".to_vec();
        let (path, _) = ClFile::read("groove.cls", text, &Reading::default());
        let point = |y: f64, deviation_mm: f64| SurfacePoint {
            line: 1,
            number: 1.0,
            at_mm: Vec3::new(0.3, y, 0.0),
            normal: Vec3::z(),
            deviation_mm,
            u_mm: None,
        };
        let wall = Wall {
            layer_mm: 0.1,
            path_at: PathAt::Finished,
            thickness_mm: 0.25,
            u_thickness_mm: 0.0,
            least_mm: 0.05,
            inner: Inner::Follows,
        };
        let ball = Cutter { radius_mm: 1.0, corner_mm: 1.0 };
        let blank = [point(0.0, 0.0), point(0.3, 0.0), point(0.9, 0.0), point(0.0, 0.2)];
        let cells = virtual_cut(&path, &ball, &wall, &blank);
        // −0.1, then 1 − √(1 − 0.3²) higher, then untouched.
        assert!((cells[0].surface_mm + 0.1).abs() < 1e-6, "{:?}", cells[0]);
        let beside = 0.9 - (1.0 - 0.09_f64).sqrt();
        assert!((cells[1].surface_mm - beside).abs() < 1e-4, "{:?}", cells[1]);
        assert_eq!((cells[2].surface_mm, cells[2].wall_mm), (0.0, 0.25));
        // A blank 0.2 mm too high, its inner surface too: 0.3 mm off, 0.05 mm beyond the wall.
        assert!((cells[3].wall_mm + 0.05).abs() < 1e-6, "{:?}", cells[3]);
    }
}
