//! Readings that were repeated in the same place, and how much they scatter.

use super::{Instrument, Readings};
use std::collections::BTreeMap;
use trueaxis_geometry::statistics::pooled_deviation;

/// The scatter of one channel in places with several readings.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Repeatability {
    /// Standard deviation of one reading, from all places together. Unit: mm or rad.
    pub s: f64,
    /// Its degrees of freedom: n − 1 of each place.
    pub degrees_of_freedom: usize,
    /// The largest difference of two readings in one place. Unit: mm or rad.
    pub largest_range: f64,
}

/// The rows of each place, of those that count: the same instrument, command, direction of probing, sides of approach and feed.
pub fn places(readings: &Readings, counts: impl Fn(usize) -> bool) -> Vec<Vec<usize>> {
    let mut places: BTreeMap<_, Vec<usize>> = BTreeMap::new();
    let fine = |v: f64| (v * 1e6).round() as i64;
    for i in (0..readings.len()).filter(|i| counts(*i)) {
        let n = readings.directions[i];
        let key = (
            readings.instruments[i],
            readings.commands[i].map(fine),
            [n.x, n.y, n.z].map(fine),
            readings.approaches[i].map(|a| a.signum() as i8),
            readings.motions[i].feed_mm_per_s.map(fine),
        );
        places.entry(key).or_default().push(i);
    }
    places.into_values().collect()
}

/// Each channel of an instrument; none where no place was read twice, and for a touch probe: its axes are the reading, so that no
/// two are the same.
pub fn repeatability(
    instrument: &Instrument,
    readings: &Readings,
    places: &[Vec<usize>],
) -> Vec<Repeatability> {
    if instrument.kind.triggers() {
        return Vec::new();
    }
    let channel = |c: usize| {
        let values = |rows: &Vec<usize>| rows.iter().map(|i| readings.values[*i][c]).collect();
        let groups: Vec<Vec<f64>> = places.iter().map(values).collect();
        let (s, freedom) = pooled_deviation(groups.iter().map(Vec::as_slice))?;
        let range = |group: &Vec<f64>| {
            let most = group.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            most - group.iter().copied().fold(f64::INFINITY, f64::min)
        };
        let largest_range = groups.iter().map(range).fold(0.0, f64::max);
        Some(Repeatability { s, degrees_of_freedom: freedom as usize, largest_range })
    };
    (0..instrument.kind.channels().len()).map_while(channel).collect()
}
