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
