//! Places of a tool in runs with a ball around each, so that most of them need not be examined.

use super::cutter::Cutter;
use trueaxis_geometry::Vec3;

const RUN: usize = 32;

/// Where a tool stands.
#[derive(Debug, Clone, Copy)]
pub(super) struct Stand {
    pub tip: Vec3,
    pub axis: Vec3,
}

/// Many of them.
pub(super) struct Stands {
    all: Vec<Stand>,
    balls: Vec<(Vec3, f64)>,
}

impl Stands {
    pub fn of(all: Vec<Stand>) -> Self {
        let balls = all.chunks(RUN).map(|run| {
            let middle = run.iter().map(|s| s.tip).sum::<Vec3>() / run.len() as f64;
            (middle, run.iter().fold(0.0_f64, |m, s| m.max((s.tip - middle).norm())))
        });
        let balls = balls.collect();
        Self { all, balls }
    }

    /// Those whose tip is within a distance of a point.
    pub fn near<'s>(&'s self, point: &Vec3, distance: f64) -> impl Iterator<Item = &'s Stand> {
        let point = *point;
        let runs = self.all.chunks(RUN).zip(&self.balls);
        let near = runs.filter(move |(_, (middle, radius))| {
            (middle - point).norm_squared() <= (radius + distance).powi(2)
        });
        near.flat_map(|(run, _)| run)
            .filter(move |s| (s.tip - point).norm_squared() <= distance * distance)
    }

    /// A point farther from the tip than this is outside of the lower part of the cutter, up to a
    /// height over the tip.
    pub fn reach(cutter: &Cutter, height: f64) -> f64 {
        cutter.radius_mm.hypot(cutter.radius_mm.max(cutter.corner_mm) + height)
    }
}
