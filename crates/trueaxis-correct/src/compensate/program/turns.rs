//! Where axes turn round within a move: errors depend on the side from which an axis comes
//! (docs/model.md eq. 165).
//!
//! ```text
//!     places   q0 ── q1 ── q2 ── q3        q rises, then falls: it turned near q2
//!     parabola through q1 q2 q3 -> u*      one stop at u* from below, one from above
//! ```

use trueaxis_machine::axis::{Approach, Command, MAX_AXES};

/// A place that is to be corrected.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Stop {
    /// From 0 at the beginning to 1 at the end of the move.
    pub u: f64,
    pub nominal: Command,
    /// From where each axis comes by the program.
    pub side: Approach,
    /// The number of its correction that was made ahead.
    pub prepared: Option<usize>,
    /// An axis reverses here: the same place again, from the other side.
    pub turns: bool,
}

/// Turns nearer to each other are at one place.
const SAME: f64 = 1e-9;

/// A place of the path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct At {
    pub u: f64,
    pub nominal: Command,
    /// What is commanded for it in the mean of both sides: where that reverses, the axis does.
    pub mean: Command,
    /// The number of its correction.
    pub prepared: Option<usize>,
}

/// The places of a move from `begin` with the sides of their axes, and two stops where an axis
/// reverses: one from each side. Motions up to `least` have no direction.
/// `mean_of` tells the mean command of a place between.
pub(super) fn stops(
    begin: &At,
    side: &Approach,
    places: &[At],
    (least, mean_of): (&Command, &dyn Fn(&Command) -> Command),
) -> Vec<Stop> {
    let mut side = *side;
    let mut stops = Vec::with_capacity(places.len());
    let mut last_u = 0.0;
    let mut turns: Vec<Turn> = (0..MAX_AXES)
        .flat_map(|axis| turning_points(begin, (axis, side[axis]), places, (least[axis], mean_of)))
        .collect();
    turns.sort_by(|a, b| a.u.total_cmp(&b.u));
    let mut turns = turns.into_iter().peekable();
    for (k, place) in places.iter().enumerate() {
        let (u, nominal) = (place.u, place.nominal);
        let is_end = k + 1 == places.len();
        while let Some(turn) = turns.next_if(|t| t.u < u || (is_end && t.u <= u)) {
            if turn.from_unknown {
                side[turn.axis] = turn.to;
                continue;
            }
            let before = Stop { u: turn.u, nominal: turn.at, side, prepared: None, turns: false };
            if turn.u > last_u {
                stops.push(before);
            }
            side[turn.axis] = turn.to;
            // Axes that turn at one place take up their play together.
            while let Some(other) = turns.next_if(|t| t.u <= turn.u + SAME) {
                side[other.axis] = other.to;
            }
            last_u = turn.u;
            stops.push(Stop { side, turns: true, ..before });
        }
        stops.push(Stop { u, nominal, side, prepared: place.prepared, turns: false });
        last_u = u;
    }
    stops
}

struct Turn {
    u: f64,
    axis: usize,
    /// The side from which the axis comes after it.
    to: f64,
    /// It was not known before it.
    from_unknown: bool,
    at: Command,
}

/// Where one axis turns: at its farthest place, as soon as it has come back by more than `least`.
fn turning_points(
    begin: &At,
    (axis, mut to): (usize, f64),
    places: &[At],
    (least, mean_of): (f64, &dyn Fn(&Command) -> Command),
) -> Vec<Turn> {
    let place = |k: usize| if k == 0 { begin } else { &places[k - 1] };
    let mut turns = Vec::new();
    let mut farthest = 0;
    for k in 1..=places.len() {
        let by = place(k).mean[axis] - place(farthest).mean[axis];
        if by * to > 0.0 || by == 0.0 {
            farthest = k;
        } else if by.abs() > least {
            let inside = farthest > 0 && to != 0.0;
            let three = inside.then(|| [farthest - 1, farthest, farthest + 1].map(place));
            let known = place(farthest);
            // No nearer than the farthest place that is known.
            let is_farther = |at: &Command| (mean_of(at)[axis] - known.mean[axis]) * to > 0.0;
            let found = three.and_then(|p| vertex(p, axis)).filter(|(_, at)| is_farther(at));
            let (u, at) = found.unwrap_or((known.u, known.nominal));
            turns.push(Turn { u, axis, to: by.signum(), from_unknown: to == 0.0, at });
            (to, farthest) = (by.signum(), k);
        }
    }
    turns
}

/// Where the parabola of one axis through three places turns, and all axes there.
fn vertex([a, b, c]: [&At; 3], axis: usize) -> Option<(f64, Command)> {
    let slope = |from: &At, to: &At| (to.mean[axis] - from.mean[axis]) / (to.u - from.u);
    let (first, second) = (slope(a, b), slope(b, c));
    // The slope of the parabola is the mean one in the middle of each piece.
    let (from, to) = (0.5 * (a.u + b.u), 0.5 * (b.u + c.u));
    let u = from + (to - from) * first / (first - second);
    if !(u > a.u && u < c.u) {
        return None;
    }
    let weight = |i: usize| {
        let all = [a.u, b.u, c.u];
        let others = (0..3).filter(|j| *j != i);
        others.map(|j| (u - all[j]) / (all[i] - all[j])).product::<f64>()
    };
    let w = [weight(0), weight(1), weight(2)];
    let (a, b, c) = (&a.nominal, &b.nominal, &c.nominal);
    Some((u, std::array::from_fn(|i| w[0] * a[i] + w[1] * b[i] + w[2] * c[i])))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_parabola_turns_at_its_vertex() {
        // q = (u − 0.4)² on the first axis, q = u on the second.
        let at = |u: f64| {
            let q = [(u - 0.4) * (u - 0.4), u, 0.0, 0.0, 0.0, 0.0];
            At { u, nominal: q, mean: q, prepared: None }
        };
        let places = [at(0.25), at(0.5), at(1.0)];
        let found =
            stops(&at(0.0), &[-1.0, 1.0, 0.0, 0.0, 0.0, 0.0], &places, (&[1e-9; 6], &|q| *q));
        let shown: Vec<_> = found.iter().map(|s| (s.u, s.side[0], s.turns)).collect();
        let turn = shown[1].0;
        assert!((turn - 0.4).abs() < 1e-12 && found[1].nominal[0].abs() < 1e-12, "{found:?}");
        let expected = [
            (0.25, -1.0, false),
            (turn, -1.0, false),
            (turn, 1.0, true),
            (0.5, 1.0, false),
            (1.0, 1.0, false),
        ];
        assert_eq!(shown, expected);
    }

    #[test]
    fn a_corner_turns_where_the_move_begins() {
        let at = |u: f64| {
            let q = [-u, 0.0, 0.0, 0.0, 0.0, 0.0];
            At { u, nominal: q, mean: q, prepared: Some(7) }
        };
        let sides = [1.0, 1.0, 0.0, 0.0, 0.0, 0.0];
        let found = stops(&at(0.0), &sides, &[at(1.0)], (&[1e-9; 6], &|q| *q));
        assert_eq!(found.len(), 2);
        assert!(found[0].turns && found[0].u == 0.0 && found[0].side[0] == -1.0);
        assert_eq!((found[1].prepared, found[1].side[1]), (Some(7), 1.0));
    }
}
