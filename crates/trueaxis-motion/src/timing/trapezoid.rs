//! The same path with velocity and acceleration limits only.

use super::element::Segment;
use super::joint::{Passage, blend_without_jerk, passage};
use super::path::{Reciprocals, straight};
use super::scurve::Bounds;
use super::{AxisLimits, Node, TimingError};

/// One piece of the path: its length and limits; whether it ends with a stop and rests there.
struct Stretch {
    length: f64,
    bounds: Bounds,
    stop_s: Option<f64>,
}

/// The shortest time in which the velocity along the path keeps to the velocity and acceleration
/// limits of its pieces, with steps of acceleration: one pass backwards and one forwards.
///
/// On blends the axes spend their whole acceleration on the curvature and once more on the change of
/// velocity, so no jerk-limited motion of [`super::Planner`] is as fast: its price is the ratio.
pub fn without_jerk_s(limits: &AxisLimits, nodes: &[Node]) -> Result<f64, TimingError> {
    limits.check()?;
    let mut time_s = nodes.first().map_or(0.0, |n| n.dwell_s);
    let stretches = stretches(&Reciprocals::of(limits), nodes)?;
    // Squares of the velocities at the begin of each piece.
    let mut squares = vec![0.0_f64; stretches.len() + 1];
    for (i, s) in stretches.iter().enumerate().rev() {
        let end = if s.stop_s.is_some() { 0.0 } else { squares[i + 1] };
        squares[i + 1] = end;
        let most = s.bounds.v * s.bounds.v;
        squares[i] = (end.min(most) + 2.0 * s.bounds.a * s.length).min(most);
    }
    let mut square = 0.0_f64;
    for (i, s) in stretches.iter().enumerate() {
        let (v, a) = (s.bounds.v, s.bounds.a);
        let begin = square.min(v * v);
        let end = squares[i + 1].min(v * v).min(begin + 2.0 * a * s.length);
        let top = (0.5 * (begin + end) + a * s.length).sqrt().min(v);
        let changes = 2.0 * top - begin.sqrt() - end.sqrt();
        let on_the_way = (2.0 * top * top - begin - end) / (2.0 * a);
        time_s += changes / a + (s.length - on_the_way).max(0.0) / top + s.stop_s.unwrap_or(0.0);
        square = end;
    }
    Ok(time_s)
}

fn stretches(limits: &Reciprocals, nodes: &[Node]) -> Result<Vec<Stretch>, TimingError> {
    let mut list = Vec::with_capacity(2 * nodes.len());
    let mut entered = 0.0;
    for (i, node) in nodes.iter().enumerate() {
        node.check(i)?;
        let Some(from) = i.checked_sub(1) else { continue };
        let before = Segment::between(&nodes[from].command, node);
        let after = nodes.get(i + 1).map(|next| Segment::between(&node.command, next));
        let bounds = straight(limits, &before).bounds;
        let must_stop = node.stop || node.dwell_s > 0.0;
        let (d, stop_s) = match &after {
            Some(after) if !must_stop => match passage(limits, node, [&before, after], 0.0) {
                Passage::Round(d, _) => (d, None),
                Passage::Through => (0.0, None),
                Passage::Rest(_) => (0.0, Some(0.0)),
            },
            _ => (0.0, Some(node.dwell_s)),
        };
        let length = (before.length - entered - d).max(0.0);
        list.push(Stretch { length, bounds, stop_s });
        if let (Some(after), true) = (&after, d > 0.0) {
            let bounds = blend_without_jerk(limits, &before, after, d);
            list.push(Stretch { length: 2.0 * d, bounds, stop_s: None });
        }
        entered = d;
    }
    Ok(list)
}
