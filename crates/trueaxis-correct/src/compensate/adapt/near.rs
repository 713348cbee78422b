//! Places of a tool in runs with a ball around each, so that most of them need not be examined.

use super::cutter::Cutter;
use std::collections::HashSet;
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
    pub fn of(mut all: Vec<Stand>) -> Self {
        // A place that is stood at again cuts nothing more: a path of 20,000 equal lines is one place.
        let mut seen = HashSet::with_capacity(all.len());
        all.retain(|s| seen.insert([s.tip, s.axis].map(|v| v.data.0[0].map(f64::to_bits))));
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

#[cfg(test)]
mod tests {
    use super::*;

    /// Twice at the same place is once: equal lines make a check no longer, and no other.
    #[test]
    fn law_equal_places_count_once() {
        let stand = |i: usize| Stand { tip: Vec3::new(i as f64, 0.5, 0.0), axis: Vec3::z() };
        let once: Vec<_> = (0..100).map(stand).collect();
        let (single, repeated) = (Stands::of(once.clone()), Stands::of(once.repeat(200)));
        for at in [Vec3::zeros(), Vec3::new(40.3, 0.0, 1.0), Vec3::new(99.0, 0.5, 0.0)] {
            let tips = |stands: &Stands| -> Vec<Vec3> {
                stands.near(&at, 3.0).map(|stand| stand.tip).collect()
            };
            assert_eq!(tips(&single), tips(&repeated));
            assert!(!tips(&single).is_empty());
        }
        // Another direction of the tool is another place.
        let tilted = Stand { axis: Vec3::x(), ..stand(0) };
        assert_eq!(Stands::of(vec![stand(0), tilted, stand(0)]).all.len(), 2);
    }
}
