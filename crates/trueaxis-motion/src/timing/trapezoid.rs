//! The same path with velocity and acceleration limits only.

use super::element::Segment;
use super::joint::{Passage, blend_without_jerk, passage};
use super::path::{Reciprocals, straight};
use super::scurve::Bounds;
use super::{AxisLimits, Node, TimingError};

/// One piece of the path: its length and limits.
struct Stretch {
    length: f64,
    bounds: Bounds,
}

/// The path between two stops: with its blends, and the lines alone, for a stop at every node.
#[derive(Default)]
struct Section {
    blended: Vec<Stretch>,
    lines: Vec<Stretch>,
}

/// The shortest time in which the velocity along the path keeps to the velocity and acceleration
/// limits of its pieces, with steps of acceleration: one pass backwards and one forwards; between two
/// stops with blends or with stops, whichever takes less.
///
/// On blends the axes spend their whole acceleration on the curvature and once more on the change of
/// velocity, so no jerk-limited motion of [`super::Planner`] is as fast: its price is the ratio.
pub fn without_jerk_s(limits: &AxisLimits, nodes: &[Node]) -> Result<f64, TimingError> {
    limits.check()?;
    let limits = Reciprocals::of(limits);
    let mut time_s = nodes.first().map_or(0.0, |n| n.dwell_s);
    let mut section = Section::default();
    let (mut entered, mut before) = (0.0, None);
    for (i, node) in nodes.iter().enumerate() {
        node.check(i)?;
        let after = nodes.get(i + 1).map(|next| Segment::between(&node.command, next));
        let Some(before) = std::mem::replace(&mut before, after.clone()) else { continue };
        let bounds = straight(&limits, &before).bounds;
        let must_stop = node.stop || node.dwell_s > 0.0;
        let round = match after.as_ref().filter(|_| !must_stop) {
            Some(after) => match passage(&limits, node, [&before, after], 0.0) {
                Passage::Round(d, _) => Some(Some((d, after))),
                Passage::Through => Some(None),
                Passage::Rest(_) => None,
            },
            None => None,
        };
        let d = round.flatten().map_or(0.0, |(d, _)| d);
        let length = (before.length - entered - d).max(0.0);
        section.blended.push(Stretch { length, bounds });
        section.lines.push(Stretch { length: before.length, bounds });
        if let Some((d, after)) = round.flatten() {
            let bounds = blend_without_jerk(&limits, &before, after, d);
            section.blended.push(Stretch { length: 2.0 * d, bounds });
        }
        entered = d;
        if round.is_none() {
            time_s += section.time_s() + node.dwell_s;
            section = Section::default();
        }
    }
    Ok(time_s)
}

impl Section {
    fn time_s(&self) -> f64 {
        let stops: f64 = self.lines.iter().map(|line| time_s(std::slice::from_ref(line))).sum();
        stops.min(time_s(&self.blended))
    }
}

/// From rest to rest.
fn time_s(stretches: &[Stretch]) -> f64 {
    // Squares of the velocities at the begin of each piece.
    let mut squares = vec![0.0_f64; stretches.len() + 1];
    for (i, s) in stretches.iter().enumerate().rev() {
        let most = s.bounds.v * s.bounds.v;
        squares[i] = (squares[i + 1].min(most) + 2.0 * s.bounds.a * s.length).min(most);
    }
    let (mut square, mut time_s) = (0.0_f64, 0.0);
    for (i, s) in stretches.iter().enumerate() {
        let (v, a) = (s.bounds.v, s.bounds.a);
        let begin = square.min(v * v);
        let end = squares[i + 1].min(v * v).min(begin + 2.0 * a * s.length);
        let top = (0.5 * (begin + end) + a * s.length).sqrt().min(v);
        let changes = 2.0 * top - begin.sqrt() - end.sqrt();
        let on_the_way = (2.0 * top * top - begin - end) / (2.0 * a);
        time_s += changes / a + (s.length - on_the_way).max(0.0) / top;
        square = end;
    }
    time_s
}

#[cfg(test)]
mod tests {
    use super::*;
    use trueaxis_machine::axis::{Command, MAX_AXES};

    /// From rest to rest over 4 mm with 1 mm/s²: 2 √(4/1) = 4 s, wherever it is cut.
    #[test]
    fn law_a_stretch_in_two_takes_as_long() {
        let bounds = Bounds { v: 100.0, a: 1.0, j: 1.0 };
        for cut in [0.5, 1.0, 2.0, 3.0, 3.9] {
            let parts = [cut, 4.0 - cut].map(|length| Stretch { length, bounds });
            assert!((time_s(&parts) - 4.0).abs() < 1e-12, "{cut}: {}", time_s(&parts));
        }
    }

    /// 40 mm of an axis with 5 mm/s and 2 mm/s², from rest to rest: 2.5 s to speed up and as long to slow down over 12.5 mm in all, 27.5 mm at 5 mm/s;
    /// and half a second of dwell.
    #[test]
    fn law_a_move_from_rest_to_rest() {
        let mut limits = AxisLimits::UNLIMITED;
        limits.velocity[0] = 5.0;
        limits.acceleration[0] = 2.0;
        let there = |x: f64, dwell_s: f64| {
            let mut command = Command::default();
            command[0] = x;
            let (length, feed, tolerance) = (40.0, f64::INFINITY, [0.0; MAX_AXES]);
            Node { command, length, feed, stop: true, tolerance, dwell_s }
        };
        let nodes = [there(0.0, 0.0), there(40.0, 0.5)];
        let found = without_jerk_s(&limits, &nodes).expect("a time");
        assert!((found - (5.0 + 27.5 / 5.0 + 0.5)).abs() < 1e-12, "{found}");
    }
}
