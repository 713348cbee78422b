//! Whole turns, and which solution is best.

use super::Solution;
use crate::Machine;
use crate::axis::{Command, Travel};
use std::f64::consts::{PI, TAU};

/// Angles that differ by less count as equal, in rad.
pub(super) const TIE_RAD: f64 = 1e-9;

/// Closer than this to −180° is 180°, in rad.
const SEAM_RAD: f64 = 1e-13;

/// More than any tolerance of a travel, in rad.
const ROOM_RAD: f64 = 1e-6;

/// The same angle in (−π, π]; what rounding leaves beside −π is π, −0 is 0.
#[inline]
pub(crate) fn principal(q: f64) -> f64 {
    if q.abs() < PI - SEAM_RAD {
        return q + 0.0;
    }
    let turned = q - TAU * (q / TAU).round();
    if turned <= -PI + SEAM_RAD { PI } else { turned.min(PI) + 0.0 }
}

/// The turn of `q` nearest to `near`; `q` itself if two are equally near.
pub(crate) fn nearest(q: f64, near: f64) -> f64 {
    if (near - q).abs() <= PI {
        return q;
    }
    let turns = (near - q) / TAU;
    let whole = (turns.abs() - 0.5 - TIE_RAD).ceil().max(0.0);
    q + TAU * whole.copysign(turns)
}

/// The turn of an angle nearest to where its axis is, within the travel if any is.
pub(crate) fn nearest_inside(travel: Travel, q: f64, from: f64) -> f64 {
    let near = nearest(q, from);
    if travel.contains(near) {
        return near;
    }
    let own = Some(q).filter(|&q| travel.contains(q));
    let all = others(travel, q, from).chain(own);
    let distance = |q: &f64| (q - from).abs();
    all.min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap_or(near)
}

/// The two rotary axes of a machine that has no others.
#[derive(Debug, Clone, Copy)]
pub(crate) struct RotaryPair {
    /// In chain order.
    pub axes: [usize; 2],
    travels: [Travel; 2],
    /// Least and largest angle that the travel contains.
    ends: [[f64; 2]; 2],
}

impl RotaryPair {
    pub fn of(machine: &Machine, axes: [usize; 2]) -> Self {
        let travels = axes.map(|axis| machine.axes[axis].travel);
        Self { axes, travels, ends: travels.map(|travel| travel.ends()) }
    }

    /// Of two branches with angles in [−π, π] the one that comes first in the order of [`in_order`]; and whether it is within the
    /// travel.
    #[inline]
    pub fn nearer(&self, branches: [[f64; 2]; 2], from: &Command) -> ([f64; 2], bool) {
        let from = self.axes.map(|axis| from[axis]);
        let one = self.turned(branches[0], from);
        let other = self.turned(branches[1], from);
        let within = [self.is_within(one), self.is_within(other)];
        if within[0] != within[1] {
            return if within[0] { (one, true) } else { (other, true) };
        }
        let way = |q: [f64; 2]| {
            let [first, second] = [q[0] - from[0], q[1] - from[1]];
            (first * first + second * second).sqrt()
        };
        let ways = [way(other), way(one)];
        (if comes_first(ways, other, one, from) { other } else { one }, within[0])
    }

    #[inline]
    fn is_within(&self, q: [f64; 2]) -> bool {
        let inside = |k: usize| self.ends[k][0] <= q[k] && q[k] <= self.ends[k][1];
        inside(0) & inside(1)
    }

    /// The angles of a branch in the turns nearest to where the axes are.
    #[inline]
    fn turned(&self, angles: [f64; 2], from: [f64; 2]) -> [f64; 2] {
        let q = [principal(angles[0]), principal(angles[1])];
        let is_near = (q[0] - from[0]).abs() <= PI && (q[1] - from[1]).abs() <= PI;
        if is_near && self.is_within(q) {
            return q;
        }
        std::array::from_fn(|k| nearest_inside(self.travels[k], q[k], from[k]))
    }
}

/// Whether the angles `a` of the first two axes come before `b`: the shorter way of all axes, the shorter way of the first axis, then a second angle that is
/// not negative, then the smaller angles.
#[inline]
fn comes_first(ways: [f64; 2], a: [f64; 2], b: [f64; 2], from: [f64; 2]) -> bool {
    let differs = |a: f64, b: f64| (a - b).abs() > TIE_RAD;
    if differs(ways[0], ways[1]) {
        return ways[0] < ways[1];
    }
    breaks_tie(a, b, from)
}

#[cold]
fn breaks_tie(a: [f64; 2], b: [f64; 2], from: [f64; 2]) -> bool {
    let differs = |a: f64, b: f64| (a - b).abs() > TIE_RAD;
    let below = |q: [f64; 2]| f64::from(u8::from(q[1] < -TIE_RAD));
    let keys: [&dyn Fn([f64; 2]) -> f64; 4] =
        [&|q| (q[0] - from[0]).abs(), &below, &|q| q[0], &|q| q[1]];
    let key = keys.into_iter().find(|key| differs(key(a), key(b)));
    key.is_some_and(|key| key(a) < key(b))
}

/// The other turns of `q` to offer: all inside a travel, the nearest one of an endless axis.
#[expect(clippy::cast_possible_truncation, reason = "numbers of turns; a cast limits larger ones")]
pub(crate) fn others(travel: Travel, q: f64, from: f64) -> impl Iterator<Item = f64> + Clone {
    let (first, last) = match travel {
        Travel::Unknown => (0, 0),
        Travel::Unlimited => {
            let turns = ((nearest(q, from) - q) / TAU).round() as i64;
            (turns, turns)
        }
        // Most axes have no room for another turn.
        Travel::Between(low, high) if q - TAU < low - ROOM_RAD && high + ROOM_RAD < q + TAU => {
            (0, 0)
        }
        Travel::Between(low, high) => {
            let first = ((low - q) / TAU - TIE_RAD).ceil();
            (first as i64, ((high - q) / TAU + TIE_RAD).floor() as i64)
        }
    };
    let turned = (first..=last).filter(|k| *k != 0).map(move |k| q + TAU * k as f64);
    turned.filter(move |q| travel.contains(*q))
}

/// Solutions with their marks, best first, those outside the travel last.
pub(crate) fn in_order(machine: &Machine, commands: Vec<Command>, from: &Command) -> Vec<Solution> {
    let rotary: Vec<usize> = machine.rotary_axes().collect();
    let solution = |command: Command| Solution {
        command,
        within_travel: machine.within_travel(&command),
        rotary_travel_rad: rotary
            .iter()
            .map(|&i| (command[i] - from[i]).powi(2))
            .sum::<f64>()
            .sqrt(),
    };
    let mut rest: Vec<Solution> = commands.into_iter().map(solution).collect();
    let mut ordered = Vec::with_capacity(rest.len());
    // Comparing within a tolerance is no order to sort by; taking the best again and again is one.
    while let Some(best) = best(&rest, &rotary, from) {
        ordered.push(rest.remove(best));
    }
    ordered
}

/// Whether `a` comes before `b` in the order of [`in_order`], where neither is better by its travel.
pub(crate) fn is_nearer(machine: &Machine, a: &Command, b: &Command, from: &Command) -> bool {
    let mut rotary = machine.rotary_axes();
    let two = [rotary.next(), rotary.next()];
    let pair = |c: &Command| two.map(|axis| axis.map_or(0.0, |i| c[i]));
    let way = |c: &Command| -> f64 {
        machine.rotary_axes().map(|i| (c[i] - from[i]).powi(2)).sum::<f64>().sqrt()
    };
    comes_first([way(a), way(b)], pair(a), pair(b), pair(from))
}

fn best(solutions: &[Solution], rotary: &[usize], from: &Command) -> Option<usize> {
    let first = |s: &Solution| rotary.first().map_or(0.0, |&i| s.command[i]);
    let second = |s: &Solution| rotary.get(1).map_or(0.0, |&i| s.command[i]);
    let first_from = rotary.first().map_or(0.0, |&i| from[i]);
    let keys: [&dyn Fn(&Solution) -> f64; 6] = [
        &|s| f64::from(u8::from(!s.within_travel)),
        &|s| s.rotary_travel_rad,
        &|s| (first(s) - first_from).abs(),
        &|s| f64::from(u8::from(second(s) < -TIE_RAD)),
        &|s| first(s),
        &|s| second(s),
    ];
    let mut left: Vec<usize> = (0..solutions.len()).collect();
    for key in keys {
        let least = left.iter().map(|&i| key(&solutions[i])).fold(f64::INFINITY, f64::min);
        left.retain(|&i| key(&solutions[i]) <= least + TIE_RAD);
    }
    left.first().copied()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::file::NoTables;

    #[test]
    fn principal_angles_have_one_seam() {
        assert_eq!(principal(-PI), PI);
        assert_eq!(principal(-PI + 1e-15), PI);
        assert_eq!(principal(PI), PI);
        assert_eq!(principal(-0.0).to_bits(), 0.0_f64.to_bits());
        assert!((principal(3.5 * PI) + 0.5 * PI).abs() < 1e-15);
    }

    #[test]
    fn turns_inside_a_travel() {
        let degrees = |travel: Travel, q: f64, from: f64| -> Vec<f64> {
            let turned = others(travel, q.to_radians(), from.to_radians());
            turned.map(|q| q.to_degrees().round()).collect()
        };
        let twice = Travel::Between(-TAU, TAU);
        assert_eq!(degrees(twice, 90.0, 0.0), [-270.0]);
        assert_eq!(degrees(twice, 0.0, 0.0), [-360.0, 360.0]);
        assert_eq!(degrees(Travel::Between(-PI, PI), 180.0, 0.0), [-180.0]);
        assert_eq!(degrees(Travel::Unlimited, 90.0, 700.0), [810.0]);
        assert_eq!(degrees(Travel::Unlimited, 90.0, 270.0), []);
        assert_eq!(degrees(Travel::Unlimited, -90.0, 90.0), []);
        assert_eq!(degrees(Travel::Unknown, 90.0, 700.0), []);
    }

    /// Of two solutions within the travel the nearer one is that which comes first in the order of all: near ways, equal ways, equal ways of the
    /// first axis, and one that is the same.
    #[test]
    fn law_the_nearer_of_two_is_the_first_of_two() {
        let text = "[machine]\nname = \"m\"\nchain = \"w C' A' b X Y Z t\"\n";
        let machine = Machine::check("m.toml", text, &NoTables).0.expect("a machine");
        let rotary: Vec<usize> = machine.rotary_axes().collect();
        let angles = [-2.5, -0.75, -0.5, 0.0, 0.5, 0.75, 2.0];
        let command = |q: [f64; 2]| {
            let mut command = Command::default();
            for (axis, angle) in rotary.iter().zip(q) {
                command[*axis] = angle;
            }
            command
        };
        let all: Vec<[f64; 2]> =
            angles.iter().flat_map(|a| angles.iter().map(|b| [*a, *b])).collect();
        for from in [[0.0, 0.0], [0.5, -0.75], [2.0, 0.25]].map(command) {
            for a in all.iter().map(|q| command(*q)) {
                for b in all.iter().map(|q| command(*q)).filter(|b| *b != a) {
                    let first = in_order(&machine, vec![a, b], &from)[0].command;
                    assert_eq!(
                        is_nearer(&machine, &a, &b, &from),
                        first == a,
                        "{a:?} {b:?} {from:?}"
                    );
                }
                assert!(!is_nearer(&machine, &a, &a, &from));
            }
        }
    }
}
