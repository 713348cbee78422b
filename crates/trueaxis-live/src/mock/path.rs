//! Axes that go from one stop to the next, round and round.

/// A place where the axes stop.
#[derive(Debug, Clone, PartialEq)]
pub struct Stop {
    /// One position for each axis, mm or deg. Unit: mm or deg.
    pub positions: Vec<f64>,
    /// How long they stay.
    pub dwell_s: f64,
}

/// Stops and the feed between them; all axes arrive together, at constant speed.
#[derive(Debug, Clone, PartialEq)]
pub struct MockPath {
    stops: Vec<Stop>,
    feed_mm_per_min: f64,
    /// The stop that is left, or stayed at.
    from: usize,
    /// How long ago it was reached, s.
    since_s: f64,
}

impl MockPath {
    /// From the first stop on; none without a stop, with stops of different numbers of axes, or with a feed that is none.
    pub fn new(stops: Vec<Stop>, feed_mm_per_min: f64) -> Option<Self> {
        let axes = stops.first()?.positions.len();
        let same = stops.iter().all(|stop| stop.positions.len() == axes && stop.dwell_s >= 0.0);
        let sound = same && feed_mm_per_min > 0.0 && feed_mm_per_min.is_finite();
        sound.then_some(Self { stops, feed_mm_per_min, from: 0, since_s: 0.0 })
    }

    fn next(&self) -> &Stop {
        &self.stops[(self.from + 1) % self.stops.len()]
    }

    fn distance(&self) -> f64 {
        let pairs = self.stops[self.from].positions.iter().zip(&self.next().positions);
        pairs.map(|(a, b)| (b - a).powi(2)).sum::<f64>().sqrt()
    }

    fn travel_s(&self) -> f64 {
        self.distance() * 60.0 / self.feed_mm_per_min
    }

    /// Goes on.
    pub fn advance(&mut self, dt_s: f64) {
        self.since_s += dt_s;
        loop {
            let whole_s = self.stops[self.from].dwell_s + self.travel_s();
            if self.since_s < whole_s || whole_s <= 0.0 {
                return;
            }
            self.since_s -= whole_s;
            self.from = (self.from + 1) % self.stops.len();
        }
    }

    /// Part of the way to the next stop, 0 to 1.
    fn part(&self) -> f64 {
        let moving_s = self.since_s - self.stops[self.from].dwell_s;
        let travel_s = self.travel_s();
        if moving_s <= 0.0 || travel_s <= 0.0 { 0.0 } else { (moving_s / travel_s).min(1.0) }
    }

    /// Where the axes are, mm or deg.
    pub fn positions(&self) -> Vec<f64> {
        let part = self.part();
        let pairs = self.stops[self.from].positions.iter().zip(&self.next().positions);
        pairs.map(|(a, b)| a + (b - a) * part).collect()
    }

    /// The stop that is stayed at, or gone to.
    pub fn block(&self) -> usize {
        let stays = self.since_s < self.stops[self.from].dwell_s;
        if stays { self.from } else { (self.from + 1) % self.stops.len() }
    }

    /// The feed now.
    pub fn feed_mm_per_min(&self) -> f64 {
        if self.part() > 0.0 { self.feed_mm_per_min } else { 0.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 2 s at X0, 60 mm at 600 mm/min in 6 s, 1 s at X60, back.
    #[test]
    fn the_block_is_the_stop_that_is_stayed_at_or_gone_to() {
        let stop = |x: f64, dwell_s| Stop { positions: vec![x], dwell_s };
        let mut path = MockPath::new(vec![stop(0.0, 2.0), stop(60.0, 1.0)], 600.0).expect("a path");
        let mut seen = Vec::new();
        for _ in 0..16 {
            path.advance(1.0);
            seen.push((path.block(), path.positions()[0], path.feed_mm_per_min() > 0.0));
        }
        let due: [(usize, f64, bool); 16] = [
            (0, 0.0, false),
            (1, 0.0, false),
            (1, 10.0, true),
            (1, 20.0, true),
            (1, 30.0, true),
            (1, 40.0, true),
            (1, 50.0, true),
            (1, 60.0, false),
            (0, 60.0, false),
            (0, 50.0, true),
            (0, 40.0, true),
            (0, 30.0, true),
            (0, 20.0, true),
            (0, 10.0, true),
            (0, 0.0, false),
            (0, 0.0, false),
        ];
        for ((block, x, moves), (due_block, due_x, due_moves)) in seen.into_iter().zip(due) {
            assert_eq!((block, moves), (due_block, due_moves), "{x} {due_x}");
            assert!((x - due_x).abs() < 1e-9, "{x} {due_x}");
        }
    }
}
