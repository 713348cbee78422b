//! The time of one block in three phases with exact stop, Jiang et al..
//!
//! The text of the document has lost its equations; they are rebuilt here (errata 002-4 … 002-8).

/// How the velocity changes in the first and the last phase.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Shape {
    /// With the constant acceleration a.
    #[default]
    Constant,
    /// v₀ + Δv (3u² − 2u³) with u from 0 to 1: the same time and length, a at most 1.5 a.
    Smooth,
}

/// What a block asks for; lengths in mm, or in rad for a block that only turns (errata 002-8).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Block {
    /// Length of its path, > 0: of the tool tip, or the angle where the tip rests. Unit: that of the path.
    pub length: f64,
    /// Programmed velocity F per second, > 0. Unit: that of the path per s.
    pub feed: f64,
    /// Mean acceleration a, > 0. Unit: that of the path per s².
    pub acceleration: f64,
    /// Velocity v_s at its begin; 0 is the exact stop. Unit: that of the path per s.
    pub start: f64,
    /// Velocity v_e at its end. Unit: that of the path per s.
    pub end: f64,
    /// The form of the phases.
    pub shape: Shape,
}

/// The three phases of a block: speeding up, constant, slowing down.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ThreePhases {
    /// T₁, T₂, T₃.
    pub times_s: [f64; 3],
    /// S₁, S₂, S₃. Unit: that of the path.
    pub lengths: [f64; 3],
    /// The velocity between the phases: F, or less in a block that is too short. Unit: that of the path per s.
    pub top: f64,
    /// False if the block is too short even for the change from v_s to v_e; the acceleration is
    /// then as large as that needs.
    pub fits: bool,
    velocities: [f64; 4],
    shape: Shape,
}

impl Block {
    /// docs/model.md eq. 40; none if a number is not finite or of the wrong sign.
    pub fn phases(&self) -> Option<ThreePhases> {
        let Self { length, feed, acceleration, start, end, shape } = *self;
        let positive = [length, feed, acceleration].iter().all(|x| *x > 0.0 && x.is_finite());
        if !positive || ![start, end].iter().all(|x| *x >= 0.0 && x.is_finite()) {
            return None;
        }
        let least = (start * start - end * end).abs() / (2.0 * length);
        let fits = least <= acceleration * (1.0 + 1e-12);
        let a = acceleration.max(least);
        let change = |from: f64, to: f64| {
            let time_s = (to - from).abs() / a;
            (time_s, 0.5 * (from + to) * time_s)
        };
        let mut top = feed;
        let ((mut t1, mut s1), (mut t3, mut s3)) = (change(start, top), change(top, end));
        if s1 + s3 > length * (1.0 + 1e-12) {
            let mean = 0.5 * (start * start + end * end);
            // Too short for F: v² = a S + (v_s² + v_e²)/2; the other sign if F is below both ends.
            top = if feed >= start.max(end) {
                (mean + a * length).sqrt().max(start.max(end))
            } else {
                (mean - a * length).max(0.0).sqrt().min(start.min(end))
            };
            ((t1, s1), (t3, s3)) = (change(start, top), change(top, end));
        }
        let rest = length - s1 - s3;
        let (rest, t2) = if rest > 1e-12 * length { (rest, rest / top) } else { (0.0, 0.0) };
        Some(ThreePhases {
            times_s: [t1, t2, t3],
            lengths: [s1, rest, s3],
            top,
            fits,
            velocities: [start, top, top, end],
            shape,
        })
    }
}

impl ThreePhases {
    /// T₁ + T₂ + T₃.
    pub fn duration_s(&self) -> f64 {
        self.times_s.iter().sum()
    }

    /// When the block is at a length from its begin; its ends beyond them. docs/model.md eq. 41.
    pub fn time_at_s(&self, length: f64) -> f64 {
        let (mut rest, mut time_s) = (length.max(0.0), 0.0);
        for i in 0..3 {
            let (t, s) = (self.times_s[i], self.lengths[i]);
            if rest >= s {
                (rest, time_s) = (rest - s, time_s + t);
                continue;
            }
            if rest <= 0.0 {
                return time_s;
            }
            let (v0, v1) = (self.velocities[i], self.velocities[i + 1]);
            let within = match self.shape {
                Shape::Constant => {
                    2.0 * rest / (v0 + (v0 * v0 + 2.0 * rest * (v1 - v0) / t).max(0.0).sqrt())
                }
                Shape::Smooth => smooth_time_s(v0, v1, t, rest),
            };
            return time_s + within.min(t);
        }
        time_s
    }

    /// Stamps of the points t = 0 … q at equal distances along the block.
    pub fn stamps_s(&self, q: usize) -> impl Iterator<Item = f64> + '_ {
        let length: f64 = self.lengths.iter().sum();
        (0..=q).map(move |t| self.time_at_s(length * t as f64 / q.max(1) as f64))
    }

    /// The largest acceleration on the path: 1.5 times the mean with [`Shape::Smooth`].
    pub fn peak_acceleration(&self) -> f64 {
        let factor = if self.shape == Shape::Smooth { 1.5 } else { 1.0 };
        let mean = |i: usize| {
            let change = (self.velocities[i + 1] - self.velocities[i]).abs();
            if self.times_s[i] > 0.0 { change / self.times_s[i] } else { 0.0 }
        };
        factor * mean(0).max(mean(2))
    }
}

/// Inverse of s(u) = T (v₀ u + Δv (u³ − u⁴/2)), times T; s rises, so bisection always finds it.
fn smooth_time_s(v0: f64, v1: f64, t: f64, s: f64) -> f64 {
    let length = |u: f64| t * (v0 * u + (v1 - v0) * u * u * u * (1.0 - 0.5 * u));
    let (mut low, mut high) = (0.0, 1.0);
    while high - low > 1e-15 {
        let middle = 0.5 * (low + high);
        if length(middle) < s { low = middle } else { high = middle }
    }
    0.5 * (low + high) * t
}

#[cfg(test)]
mod tests {
    use super::*;

    fn block(length: f64) -> Block {
        let feed = 1000.0 / 60.0;
        Block { length, feed, acceleration: 500.0, start: 0.0, end: 0.0, shape: Shape::Constant }
    }

    /// 10 mm: T₂ = (10 − 5/9) / (50/3) = 17/30 s; 19/30 s in all.
    #[test]
    fn a_block_that_reaches_its_feed() {
        let phases = block(10.0).phases().expect("a block");
        assert!((phases.times_s[1] - 17.0 / 30.0).abs() < 1e-14);
        assert!((phases.duration_s() - 19.0 / 30.0).abs() < 1e-14);
    }

    /// 0.2 mm: v = √(500 · 0.2) = 10 mm/s, T₁ = 10/500 s, no second phase.
    #[test]
    fn a_block_too_short_for_its_feed() {
        let phases = block(0.2).phases().expect("a block");
        assert!((phases.top - 10.0).abs() < 1e-12 && phases.times_s[1] == 0.0);
        assert!((phases.duration_s() - 0.04).abs() < 1e-15);
    }

    /// 10 mm/s to rest needs 100/1000 = 0.1 mm: 0.05 mm does not fit, and takes 2 · 0.05/10 s.
    #[test]
    fn a_block_too_short_to_stop_in() {
        let short = Block { start: 10.0, ..block(0.05) };
        let phases = short.phases().expect("a block");
        assert!(!phases.fits && (phases.duration_s() - 0.01).abs() < 1e-14);
        assert!(Block { length: 0.1, ..short }.phases().is_some_and(|p| p.fits));
    }

    /// 20 mm/s at both ends, F = 10: slows down over (400 − 100)/1000 = 0.3 mm twice.
    #[test]
    fn a_block_slower_than_its_ends() {
        let slow = Block { feed: 10.0, start: 20.0, end: 20.0, ..block(1.0) };
        let phases = slow.phases().expect("a block");
        assert!(
            (phases.lengths[1] - 0.4).abs() < 1e-12 && (phases.times_s[0] - 0.02).abs() < 1e-15
        );
    }

    /// a = 500: 0.1 mm after √(2 · 0.1/500) = 0.02 s. Smooth: half of T₁ is at S₁ (1/8 − 1/32) · 2.
    #[test]
    fn stamps() {
        let (constant, smooth) = (block(10.0), Block { shape: Shape::Smooth, ..block(10.0) });
        let stamp = |b: Block, s: f64| b.phases().expect("a block").time_at_s(s);
        assert!((stamp(constant, 0.1) - 0.02).abs() < 1e-15);
        assert!((stamp(smooth, 5.0 / 18.0 * 3.0 / 16.0) - 1.0 / 60.0).abs() < 1e-14);
        // 0.3 of T₁: 2 · 0.3³ − 0.3⁴ of S₁.
        assert!((stamp(smooth, 5.0 / 18.0 * 0.0459) - 0.01).abs() < 1e-14);
        let peak = smooth.phases().expect("a block").peak_acceleration();
        assert!((peak - 750.0).abs() < 1e-9);
        // At F from the begin it only slows down, and the other way round.
        for (start, end) in [(smooth.feed, 0.0), (0.0, smooth.feed)] {
            let one = Block { start, end, ..smooth }.phases().expect("a block");
            assert!((one.peak_acceleration() - 750.0).abs() < 1e-9);
        }
        let all: Vec<f64> = constant.phases().expect("a block").stamps_s(4).collect();
        assert!(all.len() == 5 && (all[2] - 19.0 / 60.0).abs() < 1e-14);
    }

    /// What is not finite or has the wrong sign makes no block, each number by itself.
    #[test]
    fn what_is_no_block() {
        let good = block(10.0);
        assert!(good.phases().is_some());
        assert!(Block { start: 0.0, end: 0.0, ..good }.phases().is_some());
        for wrong in [f64::INFINITY, f64::NAN, -1.0] {
            assert!(Block { length: wrong, ..good }.phases().is_none(), "{wrong}");
            assert!(Block { feed: wrong, ..good }.phases().is_none(), "{wrong}");
            assert!(Block { acceleration: wrong, ..good }.phases().is_none(), "{wrong}");
            assert!(Block { start: wrong, ..good }.phases().is_none(), "{wrong}");
            assert!(Block { end: wrong, ..good }.phases().is_none(), "{wrong}");
        }
        assert!(Block { length: 0.0, ..good }.phases().is_none());
    }
}
