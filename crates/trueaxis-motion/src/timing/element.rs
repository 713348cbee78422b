//! What the axes do between two nodes of the path: their derivatives by its length σ.

use super::Node;
use smallvec::{SmallVec, smallvec};
use trueaxis_machine::axis::{Command, MAX_AXES};

/// dq/dσ and d²q/dσ² of each axis at an end of an element.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Tangent {
    /// dq/dσ.
    pub slope: Command,
    /// d²q/dσ².
    pub bend: Command,
}

/// A stretch of an element and the largest derivatives of each axis on it, as magnitudes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Part {
    /// Along σ. Unit: that of the path.
    pub length: f64,
    /// The share of |q′| that keeps its direction: the rise of a helix.
    pub steady: Command,
    /// The rest of |q′|.
    pub slope: Command,
    /// |q″|.
    pub bend: Command,
    /// |q‴|.
    pub twist: Command,
    /// q′ (without its steady share), q″ and q‴ turn evenly: q″ is zero where the others are
    /// largest, as on a circle.
    pub circular: bool,
}

/// The parts of an element: mostly one, which needs no memory of its own. What one thread allocates here another
/// frees, and both wait for it.
pub type Parts = SmallVec<[Part; 1]>;

/// One element of the path: a line, an arc or a sampled curve.
#[derive(Debug, Clone, PartialEq)]
pub struct Element {
    /// At its begin.
    pub begin: Tangent,
    /// At its end.
    pub end: Tangent,
    /// From its begin to its end; none for a straight line, whose ends say all.
    pub parts: Parts,
}

/// An arc, or a helix, in the space of the axes, docs/model.md eq. 43.
///
/// ```text
///     q(σ) = q₀ + steady·σ + (1 + growth·σ)·(cos·cos ωσ + sin·sin ωσ) − cos
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Turn {
    /// Its length. Unit: that of the path.
    pub length: f64,
    /// ω. Unit: rad per that of the path.
    pub rate: f64,
    /// From its axis to its begin.
    pub cos: Command,
    /// A quarter of a turn farther.
    pub sin: Command,
    /// dq/dσ of a helix along its axis, and of axes that go along evenly.
    pub steady: Command,
    /// By how much the radius grows, as a part of it. Unit: 1 per that of the path.
    pub growth: f64,
}

impl Element {
    /// The straight line from one place to the next.
    pub fn straight(from: &Command, to: &Command, length: f64) -> Self {
        let slope = std::array::from_fn(|i| (to[i] - from[i]) / length);
        let tangent = Tangent { slope, bend: [0.0; MAX_AXES] };
        Self { begin: tangent, end: tangent, parts: Parts::new() }
    }

    /// Largest |q′| and |q″| within a distance of an end, and |q‴|.
    pub(super) fn near(&self, side: Side, distance: f64) -> [Command; 3] {
        let tangent = if side == Side::Begin { &self.begin } else { &self.end };
        let mut most = [tangent.slope.map(f64::abs), tangent.bend.map(f64::abs), [0.0; MAX_AXES]];
        if self.parts.is_empty() {
            return most;
        }
        let (mut covered, mut largest) = (0.0, [[0.0_f64; MAX_AXES]; 3]);
        for k in 0..self.parts.len() {
            let part = match side {
                Side::Begin => &self.parts[k],
                Side::End => &self.parts[self.parts.len() - 1 - k],
            };
            let slope: Command = std::array::from_fn(|i| part.steady[i] + part.slope[i]);
            for (row, values) in largest.iter_mut().zip([&slope, &part.bend, &part.twist]) {
                row.iter_mut().zip(values).for_each(|(most, x)| *most = most.max(*x));
            }
            covered += part.length;
            if covered >= distance {
                break;
            }
        }
        for i in 0..MAX_AXES {
            // No farther than the next higher derivative leads on this distance.
            most[1][i] = (most[1][i] + distance * largest[2][i]).min(largest[1][i]);
            most[0][i] = (most[0][i] + distance * most[1][i]).min(largest[0][i]);
            most[2][i] = largest[2][i];
        }
        most
    }
}

/// An end of an element.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Side {
    Begin,
    End,
}

impl Turn {
    /// q − q₀ and its first three derivatives by σ.
    pub fn derivatives(&self, sigma: f64) -> [Command; 4] {
        let (sin, cos) = (self.rate * sigma).sin_cos();
        let (w, g, k) = (self.rate, 1.0 + self.growth * sigma, self.growth);
        let of_axis = |i: usize| {
            // The arm and its derivative by angle.
            let arm = self.cos[i] * cos + self.sin[i] * sin;
            let on = self.sin[i] * cos - self.cos[i] * sin;
            [
                self.steady[i] * sigma + g * arm - self.cos[i],
                self.steady[i] + g * w * on + k * arm,
                -g * w * w * arm + 2.0 * k * w * on,
                -g * w * w * w * on - 3.0 * k * w * w * arm,
            ]
        };
        let columns: [[f64; 4]; MAX_AXES] = std::array::from_fn(of_axis);
        std::array::from_fn(|n| columns.map(|column| column[n]))
    }

    /// The arc as an element of the path.
    pub fn element(&self) -> Element {
        let tangent = |sigma: f64| {
            let [_, slope, bend, _] = self.derivatives(sigma);
            Tangent { slope, bend }
        };
        let (w, k) = (self.rate.abs(), self.growth.abs());
        let widest = 1.0_f64.max(1.0 + self.growth * self.length);
        let radius: Command = std::array::from_fn(|i| self.cos[i].hypot(self.sin[i]));
        let part = Part {
            length: self.length,
            steady: std::array::from_fn(|i| self.steady[i].abs() + k * radius[i]),
            slope: radius.map(|r| r * widest * w),
            bend: radius.map(|r| r * (widest * w * w + 2.0 * k * w)),
            twist: radius.map(|r| r * (widest * w * w * w + 3.0 * k * w * w)),
            circular: true,
        };
        Element { begin: tangent(0.0), end: tangent(self.length), parts: smallvec![part] }
    }
}

/// An element on its way to a node.
#[derive(Debug, Clone)]
pub(super) struct Segment {
    pub element: Element,
    pub length: f64,
    pub feed: f64,
}

impl Segment {
    pub(super) fn between(from: &Command, node: &Node) -> Self {
        let element = Element::straight(from, &node.command, node.length);
        Self { element, length: node.length, feed: node.feed }
    }

    pub(super) fn is_straight(&self) -> bool {
        self.element.parts.is_empty()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn circle(radius: f64) -> Turn {
        Turn {
            length: std::f64::consts::TAU * radius,
            rate: 1.0 / radius,
            cos: [radius, 0.0, 0.0, 0.0, 0.0, 0.0],
            sin: [0.0, radius, 0.0, 0.0, 0.0, 0.0],
            steady: [0.0; 6],
            growth: 0.0,
        }
    }

    /// A circle of radius 4: unit slope, curvature 1/4, its derivative 1/16; back at the end.
    #[test]
    fn a_circle_by_hand() {
        let circle = circle(4.0);
        let [q, slope, bend, twist] = circle.derivatives(0.0);
        assert_eq!((q[0], slope[1], bend[0], twist[1]), (0.0, 1.0, -0.25, -0.0625));
        let [q, ..] = circle.derivatives(circle.length);
        assert!(q[0].abs() < 1e-12 && q[1].abs() < 1e-12);
        let part = circle.element().parts[0];
        assert_eq!((part.slope[0], part.bend[1], part.twist[0]), (1.0, 0.25, 0.0625));
    }

    /// One unit from its begin the axis X has at most the slope 1 · 1/4 and the bend 1/4.
    #[test]
    fn near_an_end_the_derivatives_are_those_of_the_end_and_little_more() {
        let [slope, bend, _] = circle(4.0).element().near(Side::Begin, 1.0);
        assert!((slope[0] - 0.25).abs() < 1e-12 && (bend[0] - 0.25).abs() < 1e-12);
        assert!((bend[1] - 0.0625).abs() < 1e-12 && slope[1] == 1.0);
    }
}
