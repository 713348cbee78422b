//! Changes of velocity with limited acceleration and jerk that begin and end without acceleration.

use super::Phase;

/// Velocity, acceleration and jerk that a stretch of the path allows, all positive and finite.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Bounds {
    pub v: f64,
    pub a: f64,
    pub j: f64,
}

/// Time for a change of velocity Δv ≥ 0, docs/model.md eq. 44.
pub(super) fn ramp_time(dv: f64, a: f64, j: f64) -> f64 {
    if dv * j >= a * a { dv / a + a / j } else { 2.0 * (dv / j).sqrt() }
}

/// Length of the change from one velocity to the other, docs/model.md eq. 44.
pub(super) fn ramp_length(v0: f64, v1: f64, bounds: &Bounds) -> f64 {
    0.5 * (v0 + v1) * ramp_time((v1 - v0).abs(), bounds.a, bounds.j)
}

/// The largest velocity ≤ V to which v0 ≤ V can be raised (or from which it can be lowered) on a
/// length: the inverse of [`ramp_length`], rounded down.
pub(super) fn reach(v0: f64, length: f64, bounds: &Bounds) -> f64 {
    let Bounds { v, a, j } = *bounds;
    let w = a * a / j;
    let low = v0 - 0.5 * w;
    let v1 = (low * low + 2.0 * a * length).sqrt() - 0.5 * w;
    if v1 - v0 >= w {
        return (v1 * ROUND_DOWN).max(v0).min(v);
    }
    // Without constant acceleration, x = √Δv: x³ + 2 v0 x = L √j. Both parts alone give an upper
    // bound, from which Newton's method falls onto the root of this convex function.
    let c = length * j.sqrt();
    let mut x = c.cbrt();
    if 2.0 * v0 * x > c {
        x = c / (2.0 * v0);
    }
    for _ in 0..8 {
        let step = (x * (x * x + 2.0 * v0) - c) / (3.0 * x * x + 2.0 * v0);
        x -= step;
        if step <= 1e-9 * x {
            break;
        }
    }
    (v0 + x * x * ROUND_DOWN).min(v).max(v0)
}

const ROUND_DOWN: f64 = 1.0 - 1e-13;

/// The velocity in the middle of a run that begins and ends with given velocities.
pub(super) fn top_velocity(v0: f64, v1: f64, length: f64, bounds: &Bounds) -> f64 {
    let need = |top: f64| ramp_length(v0, top, bounds) + ramp_length(top, v1, bounds);
    if need(bounds.v) <= length {
        return bounds.v;
    }
    let Bounds { a, j, .. } = *bounds;
    let w = a * a / j;
    let mut low = v0.max(v1);
    let root = 0.25 * w * w + 0.5 * (v0 * v0 + v1 * v1 - w * (v0 + v1)) + a * length;
    let top = (root.max(0.0).sqrt() - 0.5 * w) * ROUND_DOWN;
    if top - v0.min(v1) >= w && top - low >= w {
        return top;
    }
    // The rest of the bracket becomes a stretch of constant velocity: never too fast.
    let mut high = bounds.v;
    let [below, above] = bracket(&need, length, [low, high]);
    while high - low > 1e-7 * high {
        let middle = 0.5 * (low + high);
        let fits = if middle <= below { true } else { middle < above && need(middle) <= length };
        if fits { low = middle } else { high = middle }
    }
    low
}

/// A velocity that needs less than the length and one that needs more, close together or not: those of a few steps of the secant.
/// They only spare questions of a bisection: it ends at the same bits without them.
fn bracket(need: &impl Fn(f64) -> f64, length: f64, [mut low, mut high]: [f64; 2]) -> [f64; 2] {
    let (mut under, mut over) = (need(low) - length, need(high) - length);
    for _ in 0..6 {
        let width = high - low;
        if width <= 1e-9 * high || !(under < 0.0 && over > 0.0) {
            break;
        }
        // A little beyond the secant's root, on the side that moved less, so that both ends come near.
        let at = low + width * (-under / (over - under));
        let miss = need(at) - length;
        if miss <= 0.0 {
            (low, under) = (at, miss);
            over *= 0.5;
        } else {
            (high, over) = (at, miss);
            under *= 0.5;
        }
    }
    [low, high]
}

/// The at most seven phases of one run, and their number.
#[derive(Debug, Clone)]
pub(super) struct Phases {
    list: [Phase; 7],
    count: usize,
}

impl Phases {
    /// From velocity v0 to v1 over a length, starting at a time and a place.
    pub(super) fn of_run(start: [f64; 2], v: [f64; 2], length: f64, bounds: &Bounds) -> Self {
        let [t_s, sigma] = start;
        let first =
            Phase { t_s, duration_s: 0.0, sigma, velocity: v[0], acceleration: 0.0, jerk: 0.0 };
        let mut phases = Self { list: [first; 7], count: 0 };
        let top = top_velocity(v[0], v[1], length, bounds);
        let (up, down) = (ramp_length(v[0], top, bounds), ramp_length(top, v[1], bounds));
        let mut at = first;
        phases.ramp(&mut at, top, bounds);
        let rest = length - up - down;
        if rest > 0.0 && top > 0.0 {
            phases.push(&mut at, rest / top, 0.0);
        }
        phases.ramp(&mut at, v[1], bounds);
        phases
    }

    pub(super) fn list(&self) -> &[Phase] {
        &self.list[..self.count]
    }

    fn push(&mut self, at: &mut Phase, duration_s: f64, jerk: f64) {
        if duration_s <= 0.0 {
            return;
        }
        let phase = Phase { duration_s, jerk, ..*at };
        self.list[self.count] = phase;
        self.count += 1;
        let [sigma, velocity, acceleration] = phase.after(duration_s);
        let t_s = at.t_s + duration_s;
        *at = Phase { t_s, sigma, velocity, acceleration, duration_s: 0.0, jerk: 0.0 };
    }

    fn ramp(&mut self, at: &mut Phase, to: f64, bounds: &Bounds) {
        let dv = (to - at.velocity).abs();
        if dv <= 0.0 {
            return;
        }
        let sign = if to > at.velocity { 1.0 } else { -1.0 };
        let Bounds { a, j, .. } = *bounds;
        let flat = dv * j >= a * a;
        let t1 = if flat { a / j } else { (dv / j).sqrt() };
        let peak = sign * if flat { a } else { t1 * j };
        self.push(at, t1, sign * j);
        at.acceleration = peak;
        if flat {
            self.push(at, dv / a - a / j, 0.0);
        }
        self.push(at, t1, -sign * j);
        // Exactly there: rounding is not carried on.
        (at.velocity, at.acceleration) = (to, 0.0);
    }
}

/// When a phase is at a position on its path: a safeguarded Newton iteration.
pub(super) fn time_at(phase: &Phase, sigma: f64) -> f64 {
    let distance = sigma - phase.sigma;
    if distance <= 0.0 {
        return 0.0;
    }
    if phase.jerk == 0.0 && phase.acceleration == 0.0 {
        return (distance / phase.velocity).min(phase.duration_s);
    }
    let (mut low, mut high) = (0.0, phase.duration_s);
    let [end, ..] = phase.after(high);
    let mut tau = high * (distance / (end - phase.sigma)).clamp(0.0, 1.0);
    let enough = 1e-15 * high;
    for _ in 0..60 {
        let [at, velocity, _] = phase.after(tau);
        let miss = at - sigma;
        if miss > 0.0 {
            high = tau;
        } else {
            low = tau;
        }
        let next = tau - miss / velocity;
        let next = if next >= low && next <= high { next } else { 0.5 * (low + high) };
        let done = (next - tau).abs() <= enough;
        tau = next;
        if done {
            break;
        }
    }
    tau
}

#[cfg(test)]
mod tests {
    use super::*;

    const BOUNDS: Bounds = Bounds { v: 100.0, a: 1000.0, j: 20_000.0 };

    /// 0 to 100: 100/1000 + 1000/20000 = 0.15 s at 50 on average: 7.5.
    #[test]
    fn a_ramp_with_constant_acceleration() {
        assert!((ramp_length(0.0, 100.0, &BOUNDS) - 7.5).abs() < 1e-12);
        assert!((reach(0.0, 7.5, &BOUNDS) - 100.0).abs() < 1e-9);
    }

    /// 10 to 18: 2 √(8/20000) = 0.04 s at 14: 0.56.
    #[test]
    fn a_ramp_of_two_phases() {
        assert!((ramp_length(18.0, 10.0, &BOUNDS) - 0.56).abs() < 1e-12);
        assert!((reach(10.0, 0.56, &BOUNDS) - 18.0).abs() < 1e-9);
    }

    /// 40 mm at 100 mm/s: 2 · 0.15 s of ramps over 15 mm and 0.25 s for the other 25 mm.
    #[test]
    fn seven_phases() {
        let phases = Phases::of_run([1.0, 2.0], [0.0, 0.0], 40.0, &BOUNDS);
        let last = phases.list()[6];
        assert!((last.t_s + last.duration_s - 1.55).abs() < 1e-12);
        assert!((last.after(last.duration_s)[0] - 42.0).abs() < 1e-12);
    }

    /// Jerk alone: x = j t³ / 6 = 20000 · 0.03³ / 6 = 0.09 after 0.03 s.
    #[test]
    fn the_time_at_a_place() {
        let phases = Phases::of_run([0.0, 0.0], [0.0, 0.0], 40.0, &BOUNDS);
        assert!((time_at(&phases.list()[0], 0.09) - 0.03).abs() < 1e-14);
    }

    const OTHERS: [Bounds; 3] =
        [BOUNDS, Bounds { v: 3.0, a: 0.5, j: 200.0 }, Bounds { v: 800.0, a: 9_000.0, j: 40.0 }];
    const SHARES: [f64; 7] = [0.0, 1e-6, 0.01, 0.3, 0.7, 0.99, 1.0];

    /// Lengths from far too short to far longer than the change to the largest velocity.
    fn lengths(bounds: &Bounds) -> impl Iterator<Item = f64> {
        let whole = ramp_length(0.0, bounds.v, bounds);
        (-30..=4).map(move |k| whole * 1.7_f64.powi(k))
    }

    /// The velocity that is reached fits into the length, and one that is a millionth larger does not; neither from zero nor near the limit.
    #[test]
    fn law_what_is_reached_just_fits() {
        for bounds in &OTHERS {
            for v0 in SHARES.map(|share| share * bounds.v) {
                for length in lengths(bounds) {
                    let v1 = reach(v0, length, bounds);
                    assert!((v0..=bounds.v).contains(&v1), "{bounds:?} {v0} {length}: {v1}");
                    // But for the last digit of the velocity itself.
                    let rounded = (v1 * (1.0 - f64::EPSILON)).max(v0);
                    let fits = ramp_length(v0, rounded, bounds) <= length;
                    assert!(fits, "{bounds:?} {v0} {length}: {v1}");
                    let more = v1 + 1e-6 * bounds.v;
                    let fits = more > bounds.v || ramp_length(v0, more, bounds) <= length;
                    assert!(
                        !fits || v1 >= bounds.v * (1.0 - 1e-6),
                        "{bounds:?} {v0} {length}: {v1}"
                    );
                }
            }
        }
    }

    /// The bisection without the bracket ends at the same bits.
    #[test]
    fn law_the_bracket_changes_no_bit() {
        let mut bisected = 0;
        for bounds in &OTHERS {
            for ends in SHARES.iter().flat_map(|a| SHARES.map(|b| [a * bounds.v, b * bounds.v])) {
                let [v0, v1] = ends;
                let need = |top: f64| ramp_length(v0, top, bounds) + ramp_length(top, v1, bounds);
                for length in lengths(bounds).filter(|l| need(bounds.v) > *l) {
                    let [mut low, mut high] = [v0.max(v1), bounds.v];
                    while high - low > 1e-7 * high {
                        let middle = 0.5 * (low + high);
                        if need(middle) <= length { low = middle } else { high = middle }
                    }
                    let top = top_velocity(v0, v1, length, bounds);
                    // Where both ramps have constant acceleration the root is closed.
                    let is_bisected = top.to_bits() == low.to_bits();
                    bisected += u32::from(is_bisected);
                    let close = (top - low).abs() <= 2e-7 * bounds.v;
                    let is_flat = top - v0.min(v1) >= bounds.a * bounds.a / bounds.j;
                    assert!(is_bisected || (is_flat && close), "{bounds:?} {ends:?} {length}");
                }
            }
        }
        assert!(bisected > 1000, "{bisected}");
    }

    /// The same of the velocity between two others.
    #[test]
    fn law_the_top_just_fits() {
        for bounds in &OTHERS {
            for ends in SHARES.iter().flat_map(|a| SHARES.map(|b| [a * bounds.v, b * bounds.v])) {
                let [v0, v1] = ends;
                let need = |top: f64| ramp_length(v0, top, bounds) + ramp_length(top, v1, bounds);
                for length in lengths(bounds).filter(|l| ramp_length(v0, v1, bounds) <= *l) {
                    let top = top_velocity(v0, v1, length, bounds);
                    assert!((v0.max(v1)..=bounds.v).contains(&top), "{bounds:?} {ends:?} {length}");
                    assert!(
                        need(top) <= length * (1.0 + 1e-12),
                        "{bounds:?} {ends:?} {length}: {top}"
                    );
                    let is_all = top >= bounds.v * (1.0 - 2e-6);
                    assert!(
                        is_all || need(top + 1e-6 * bounds.v) > length,
                        "{bounds:?} {ends:?} {length}: {top}"
                    );
                }
            }
        }
    }
}
