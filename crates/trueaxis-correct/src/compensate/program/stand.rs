//! Where the tool stands at axis positions, and how far two stands are from each other.

use trueaxis_geometry::{Vec3, angle};
use trueaxis_machine::axis::{Approach, Command};
use trueaxis_machine::tcp::TipControl;
use trueaxis_motion::axis_path::Straight;

/// Tip, mm, and tool axis in the workpiece frame.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Stand {
    pub tip: Vec3,
    pub axis: Vec3,
}

impl Stand {
    /// Of the nominal machine.
    pub fn of(control: &TipControl, command: &Command) -> Self {
        let (tip, axis) = control.tip_and_axis(command);
        Self { tip, axis }
    }

    /// The distance of the tips, mm, and the angle of the axes, rad.
    pub fn from(&self, other: &Self) -> [f64; 2] {
        [(self.tip - other.tip).norm(), angle(&self.axis, &other.axis)]
    }

    /// The distance of the tip from the way between two stands, which bends by `bend`, the second
    /// difference of the tips, and the angle of the axis to that at the nearest place.
    pub fn off_segment(&self, a: &Self, b: &Self, bend: &Vec3) -> [f64; 2] {
        let way = b.tip - a.tip;
        let length = way.norm_squared();
        let u = if length > 1e-12 {
            (self.tip - a.tip).dot(&way) / length
        } else {
            match angle(&a.axis, &b.axis) {
                whole if whole > 0.0 => angle(&a.axis, &self.axis) / whole,
                _ => 1.0,
            }
        };
        let u = u.clamp(0.0, 1.0);
        let chord = a.between(b, u);
        self.from(&Self { tip: chord.tip - bend * (0.5 * u * (1.0 - u)), ..chord })
    }

    /// How little the axis differs from that of a place of the way whose tip is within `limit_mm`, rad; none if there is no such place.
    ///
    /// ```text
    ///     a(u) = a₀ + u g,   u = −(a₀·g)/|g|² nearest to it within  |u − u_nearest| ≤ √(limit² − d²)/length      docs/model.md eq. 336
    /// ```
    pub fn axis_off_segment(&self, a: &Self, b: &Self, bend: &Vec3, limit_mm: f64) -> Option<f64> {
        let way = b.tip - a.tip;
        let length = way.norm();
        let [tip_mm, axis_rad] = self.off_segment(a, b, bend);
        if tip_mm > limit_mm || length < 1e-6 {
            return (tip_mm <= limit_mm).then_some(axis_rad);
        }
        let nearest = ((self.tip - a.tip).dot(&way) / (length * length)).clamp(0.0, 1.0);
        let reach = (limit_mm * limit_mm - tip_mm * tip_mm).sqrt() / length;
        let turn = b.axis - a.axis;
        let best = (self.axis - a.axis).dot(&turn) / turn.norm_squared().max(f64::MIN_POSITIVE);
        let u = best.clamp((nearest - reach).max(0.0), (nearest + reach).min(1.0));
        Some(angle(&self.axis, &a.between(b, u).axis))
    }

    fn between(&self, to: &Self, u: f64) -> Self {
        let axis = self.axis + (to.axis - self.axis) * u;
        Self {
            tip: self.tip + (to.tip - self.tip) * u,
            axis: axis.try_normalize(1e-9).unwrap_or(self.axis),
        }
    }
}

/// A place of a move: what the program says, and what is to be commanded for it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Sample {
    /// From 0 at the beginning to 1 at the end of the move.
    pub u: f64,
    /// Where the tool shall stand.
    pub wanted: Stand,
    /// The axis positions for it.
    pub command: Command,
    /// Where the nominal machine stands with them: what the control believes.
    pub believed: Stand,
    /// From where the axes are taken to come.
    pub side: Approach,
    /// The place before, from the other side: an axis reverses here.
    pub turns: bool,
}

/// Where moves are to be cut: docs/model.md eq. 164.
#[derive(Debug, Clone, Copy)]
pub(super) struct Cut<'c> {
    pub control: &'c TipControl,
    pub straight: Straight,
    pub residual_mm: f64,
    pub residual_rad: f64,
}

impl Cut<'_> {
    /// The samples at which straight pieces end so that no place between them is missed by more
    /// than the residual; the first one is where the move begins.
    pub fn ends(&self, samples: &[Sample]) -> Vec<usize> {
        // Nothing lies between two samples.
        if samples.len() == 2 {
            return vec![1];
        }
        let mut ends = Vec::new();
        for (from, to) in self.stretches(samples).into_iter().rev() {
            let longest = self.longest(samples, (from, to));
            // As many of the same length are smoother, where they keep the residual too.
            let count = longest.len();
            let even = (1..=count).map(|k| from + (to - from) * k / count).collect::<Vec<_>>();
            let mut begins = std::iter::once(from).chain(even.iter().copied());
            let fit = even.iter().zip(&mut begins).all(|(end, at)| self.fits(samples, (at, *end)));
            ends.extend(if fit { even } else { longest });
        }
        ends
    }

    /// Ends of pieces, each as long as the residual allows.
    fn longest(&self, samples: &[Sample], (from, to): (usize, usize)) -> Vec<usize> {
        let mut ends = Vec::new();
        let mut at = from;
        while at < to {
            at = self.farthest(samples, (at, to));
            ends.push(at);
        }
        ends
    }

    /// The farthest end of a piece: twice as far as long as it fits, then by halves.
    fn farthest(&self, samples: &[Sample], (from, to): (usize, usize)) -> usize {
        if self.fits(samples, (from, to)) {
            return to;
        }
        let (mut good, mut step) = (from + 1, 1);
        while good + step < to && self.fits(samples, (from, good + step)) {
            good += step;
            step *= 2;
        }
        let mut bad = (good + step).min(to);
        while bad - good > 1 {
            let middle = good + (bad - good) / 2;
            match self.fits(samples, (from, middle)) {
                true => good = middle,
                false => bad = middle,
            }
        }
        good
    }

    fn fits(&self, samples: &[Sample], (from, to): (usize, usize)) -> bool {
        to - from < 2 || self.is_straight(&samples[from..=to])
    }

    /// From turning point to turning point, the last stretch first; what an axis makes up there is a
    /// piece of its own where it is more than may be missed.
    fn stretches(&self, samples: &[Sample]) -> Vec<(usize, usize)> {
        let mut stretches = Vec::new();
        let mut to = samples.len() - 1;
        for k in (1..samples.len()).rev().filter(|k| samples[*k].turns) {
            let [tip_mm, axis_rad] = samples[k - 1].believed.from(&samples[k].believed);
            if tip_mm > self.residual_mm || axis_rad > self.residual_rad {
                stretches.extend((k < to).then_some((k, to)));
                stretches.push((k - 1, k));
                to = k - 1;
            }
        }
        stretches.extend((to > 0).then_some((0, to)));
        stretches
    }

    /// Whether the largest distance from the straight piece is within the residual: at the samples, and
    /// in the middle between two of them, on the parabola through the distances.
    ///
    ///   e(k + ½) = (e_k + e_{k+1})/2 − (e_{k−1} − 2 e_k + e_{k+1})/8
    fn is_straight(&self, samples: &[Sample]) -> bool {
        let (first, last) = (&samples[0], &samples[samples.len() - 1]);
        let within =
            |off: &Off| off.0.norm() <= self.residual_mm && off.1.norm() <= self.residual_rad;
        let (mut before, mut here) = (Off::default(), Off::default());
        for (k, s) in samples.iter().enumerate().skip(1) {
            let next = match k + 1 == samples.len() {
                true => Off::default(),
                false => {
                    let u = (s.u - first.u) / (last.u - first.u).max(f64::MIN_POSITIVE);
                    self.missed(first, last, u, s)
                }
            };
            if !within(&next) {
                return false;
            }
            if k >= 2 {
                let bend = before.minus(&here).minus(&here.minus(&next)).scaled(0.125);
                let middle = |a: &Off, b: &Off| a.plus(b).scaled(0.5).minus(&bend);
                if !within(&middle(&before, &here)) || !within(&middle(&here, &next)) {
                    return false;
                }
            }
            (before, here) = (here, next);
        }
        true
    }

    /// How far the control is from a sample on its straight way between two others.
    fn missed(&self, first: &Sample, last: &Sample, u: f64, at: &Sample) -> Off {
        let (from, to) = (&first.command, &last.command);
        let even: Command = std::array::from_fn(|i| from[i] + (to[i] - from[i]) * u);
        let there = match self.straight {
            Straight::Axes => Stand::of(self.control, &even),
            Straight::TipAndAngles => Stand {
                axis: Stand::of(self.control, &even).axis,
                ..first.believed.between(&last.believed, u)
            },
            Straight::TipAndSwing => Stand {
                axis: swung(&first.believed.axis, &last.believed.axis, u),
                ..first.believed.between(&last.believed, u)
            },
        };
        Off(there.tip - at.believed.tip, there.axis - at.believed.axis)
    }
}

/// How far the tip, mm, and the tool axis are off, by small angles in rad.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
struct Off(Vec3, Vec3);

impl Off {
    fn plus(&self, other: &Self) -> Self {
        Self(self.0 + other.0, self.1 + other.1)
    }

    fn minus(&self, other: &Self) -> Self {
        Self(self.0 - other.0, self.1 - other.1)
    }

    fn scaled(&self, by: f64) -> Self {
        Self(self.0 * by, self.1 * by)
    }
}

/// Part of the turn between two directions.
fn swung(from: &Vec3, to: &Vec3, u: f64) -> Vec3 {
    let whole = angle(from, to);
    if whole < 1e-9 {
        return (from + (to - from) * u).normalize();
    }
    (from * ((1.0 - u) * whole).sin() + to * (u * whole).sin()) / whole.sin()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 0.3 mm of a path on which the axis turns by 9 mrad: 30 µrad in each µm.
    fn way() -> [Stand; 2] {
        let at = |tip: f64, turn: f64| Stand {
            tip: Vec3::new(tip, 0.0, 0.0),
            axis: Vec3::new(turn.sin(), 0.0, turn.cos()),
        };
        [at(0.0, 0.0), at(0.3, 9e-3)]
    }

    fn off(is: &Stand, limit_mm: f64) -> Option<f64> {
        let [a, b] = way();
        is.axis_off_segment(&a, &b, &Vec3::zeros(), limit_mm)
    }

    /// In the middle of the way, the tip shifted along it by so much and across it, the axis turned by so much and across that.
    fn shifted(along: f64, across: f64, turn: f64, lean: f64) -> Stand {
        let [a, b] = way();
        let middle = a.between(&b, 0.5);
        let axis = middle.axis + Vec3::new(turn, lean, 0.0);
        Stand { tip: middle.tip + Vec3::new(along, across, 0.0), axis: axis.normalize() }
    }

    #[test]
    fn law_a_tip_that_is_late_is_no_wrong_axis() {
        // 0.8 µm along the path are 24 µrad at the nearest place, and nothing within 1 µm of the tip.
        let late = shifted(8e-4, 0.0, 0.0, 0.0);
        let [a, b] = way();
        let nearest = late.off_segment(&a, &b, &Vec3::zeros());
        assert!(nearest[0] < 1e-12 && (nearest[1] - 24e-6).abs() < 1e-7, "{nearest:?}");
        assert!(off(&late, 1e-3).is_some_and(|axis| axis < 1e-9));
        // Within 0.5 µm 9 µrad of them remain; 0.6 µm across the path leave 0.8 µm along it.
        assert!(off(&late, 5e-4).is_some_and(|axis| (axis - 9e-6).abs() < 1e-7));
        let both = shifted(8e-4, 6e-4, 0.0, 0.0);
        assert!(off(&both, 1e-3).is_some_and(|axis| axis < 1e-7));
        assert!(off(&both, 6.5e-4).is_some_and(|axis| (axis - 16.5e-6).abs() < 1e-7));
        assert_eq!(off(&both, 5e-4), None);
    }

    #[test]
    fn law_a_wrong_axis_stays_wrong() {
        // 100 µrad in the sense of the turn: 30 of them are within 1 µm of the tip. Across the turn all of them stay.
        assert!(
            off(&shifted(0.0, 0.0, 1e-4, 0.0), 1e-3).is_some_and(|axis| (axis - 7e-5).abs() < 1e-6)
        );
        assert!(
            off(&shifted(0.0, 0.0, 0.0, 1e-4), 1e-3).is_some_and(|axis| (axis - 1e-4).abs() < 1e-8)
        );
    }
}
