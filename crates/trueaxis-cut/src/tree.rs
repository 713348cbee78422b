//! A tree over the motions of a path, four children to a node, and how low the tools below a node could come on a nail.

use crate::Cutter;
use crate::motion::{Motion, Seen, seen};
use crate::nail::Line;
use trueaxis_geometry::{Mat3, Vec3};

/// What holds several tools: their pivots in a box, their axes within an angle of one.
#[derive(Debug, Clone, Copy)]
struct Node {
    centre_mm: Vec3,
    axis: Vec3,
    /// Rows: the directions of the edges of the box.
    edges: Mat3,
    half_mm: Vec3,
    sin: f64,
    /// 1 − cos.
    versin: f64,
    /// From the centre of the box to its corner.
    corner_mm: f64,
    /// The axis along the edges, and from the centre to the highest corner along the axis.
    upright: Vec3,
    height_mm: f64,
}

/// Levels of nodes; node i of a level has the nodes or motions 4i … 4i + 3 of the one below.
#[derive(Debug, Clone)]
pub(crate) struct Tree {
    levels: Vec<Vec<Node>>,
}

const CHILDREN: usize = 4;

impl Tree {
    /// Over motions that stand near each other in this order.
    pub fn over(motions: &[Motion], pivot_mm: f64) -> Self {
        let mut levels = Vec::new();
        let mut span = CHILDREN;
        loop {
            let nodes: Vec<Node> =
                motions.chunks(span).map(|p| Node::around(p, pivot_mm)).collect();
            let done = nodes.len() <= 1;
            levels.push(nodes);
            if done {
                return Self { levels };
            }
            span *= CHILDREN;
        }
    }

    /// Offers the motions that may enter the nail below `highest`, the most promising first; `offer` gives the new highest.
    pub fn visit(
        &self,
        (cutter, nail): (&Cutter, &Line),
        mut highest_mm: f64,
        count: usize,
        offer: &mut dyn FnMut(usize) -> f64,
    ) {
        let mut waiting: Vec<(f64, usize, usize)> = Vec::with_capacity(64);
        let top = self.levels.len() - 1;
        if let Some(root) = self.levels[top].first()
            && let Some(from) = root.lowest(cutter, nail, highest_mm)
        {
            waiting.push((from, top, 0));
        }
        while let Some((from, level, node)) = waiting.pop() {
            if from > highest_mm {
                continue;
            }
            let first = node * CHILDREN;
            if level == 0 {
                for motion in first..(first + CHILDREN).min(count) {
                    highest_mm = offer(motion);
                }
                continue;
            }
            let below = &self.levels[level - 1];
            let begin = waiting.len();
            for (child, node) in below.iter().enumerate().skip(first).take(CHILDREN) {
                if let Some(from) = node.lowest(cutter, nail, highest_mm) {
                    waiting.push((from, level - 1, child));
                }
            }
            // The lowest last, to be taken first.
            waiting[begin..].sort_unstable_by(|a, b| b.0.total_cmp(&a.0));
        }
    }
}

impl Node {
    fn around(motions: &[Motion], pivot_mm: f64) -> Self {
        let middles: Vec<(Vec3, Vec3)> = motions.iter().map(|p| p.middle(pivot_mm)).collect();
        let sum: Vec3 = middles.iter().map(|m| m.1).sum();
        let axis = sum.try_normalize(1e-9).unwrap_or(middles[0].1);
        let edges = edges(&middles);
        let ends = || motions.iter().flat_map(|p| p.ends(pivot_mm));
        let (mut low, mut high, mut cos) =
            (Vec3::repeat(f64::MAX), Vec3::repeat(f64::MIN), 1.0_f64);
        for (pivot, direction) in ends() {
            let place = edges * pivot;
            low = low.inf(&place);
            high = high.sup(&place);
            cos = cos.min(axis.dot(&direction));
        }
        let half_mm = (high - low) * 0.5;
        let centre_mm = edges.transpose() * ((low + high) * 0.5);
        // Within a piece the axis stays between its ends, and a pivot leaves its chord by less than a hair.
        let bow = motions.iter().map(|p| p.bow_mm(pivot_mm)).fold(0.0, f64::max);
        let half_mm = half_mm.add_scalar(bow + 1e-9);
        let sin = (1.0 - cos * cos).max(0.0).sqrt();
        let sin = if cos < 0.0 { 1.0 } else { sin };
        let upright = edges * axis;
        Self {
            centre_mm,
            axis,
            edges,
            half_mm,
            sin,
            versin: 1.0 - cos,
            corner_mm: half_mm.norm(),
            upright,
            height_mm: upright.abs().dot(&half_mm),
        }
    }

    /// The lowest place at which any tool of the node could enter the nail; none below `highest_mm`.
    ///
    /// The distance from a convex body is above all its tangents: first by that at the centre of the box, then by that at the place
    /// of the box towards which the point lies.
    #[inline]
    fn lowest(&self, cutter: &Cutter, nail: &Line, highest_mm: f64) -> Option<f64> {
        let point = nail.at(highest_mm);
        if let Some(answer) = self.lowest_of_ball(cutter, nail, &point, highest_mm) {
            return answer;
        }
        let (first, along, distance_mm) = self.tangent(cutter, &point, &nail.normal, Vec3::zeros());
        let first = first.lowest(nail, highest_mm)?;
        // From the nearest point of the cutter, or the centre of its corner, to the point.
        let arm = along * (distance_mm + cutter.corner_mm());
        let nearer = arm.sup(&-self.half_mm).inf(&self.half_mm);
        if nearer == arm {
            // A tool of the box may be around the point: nothing is known from there.
            return Some(first);
        }
        let (second, ..) = self.tangent(cutter, &point, &nail.normal, nearer);
        Some(first.max(second.lowest(nail, highest_mm)?))
    }

    /// The same of a ball about the pivot, where nothing else of the tool is seen: it does not mind being turned, and its nearest
    /// place in the box is that nearest to the point. None where the shank may be seen.
    #[inline]
    fn lowest_of_ball(
        &self,
        cutter: &Cutter,
        nail: &Line,
        point: &Vec3,
        highest_mm: f64,
    ) -> Option<Option<f64>> {
        cutter.ball_mm()?;
        let arm = self.edges * (point - self.centre_mm);
        // All the way down the nail and for all tools of the node the point is below the centre of the ball.
        let turned = self.sin + self.versin;
        let deep_mm = -arm.dot(&self.upright) - self.height_mm - turned * self.corner_mm;
        if nail.normal.dot(&self.axis) < self.sin
            || deep_mm < 0.0
            || turned * turned * arm.norm_squared() > deep_mm * deep_mm
        {
            return None;
        }
        let off = arm - arm.sup(&-self.half_mm).inf(&self.half_mm);
        let (square, fall) = (off.norm_squared(), off.dot(&(self.edges * nail.normal)));
        if fall < -1e-9 * cutter.corner_mm() && square > cutter.corner_mm() * cutter.corner_mm() {
            // Outside, and it only gets farther on the way down.
            return Some(None);
        }
        let far_mm = square.sqrt();
        let slope = fall / far_mm.max(1e-12);
        let tangent = Tangent { slope, turned: 0.0, least_mm: far_mm - cutter.corner_mm() };
        Some(tangent.lowest(nail, highest_mm))
    }

    /// With the pivot at a place of the box, along its edges; the gradient along them, too.
    #[inline]
    fn tangent(
        &self,
        cutter: &Cutter,
        point: &Vec3,
        normal: &Vec3,
        place: Vec3,
    ) -> (Tangent, Vec3, f64) {
        let pivot = self.centre_mm + self.edges.tr_mul(&place);
        let tip = pivot - self.axis * cutter.pivot_mm();
        let Seen { distance_mm, gradient: g } = seen(cutter, &tip, &self.axis, point);
        let along = self.edges * g;
        let boxed = along.abs().dot(&self.half_mm) - along.dot(&place);
        let (arm, corner_mm) = (point - pivot, self.corner_mm + place.norm());
        let turned =
            self.sin * (arm.cross(&g).norm() + corner_mm) + self.versin * (arm.norm() + corner_mm);
        let least_mm = distance_mm - boxed - turned;
        let tangent = Tangent { slope: g.dot(normal), turned: self.sin + self.versin, least_mm };
        (tangent, along, distance_mm)
    }
}

/// What the distance of a point from the cutter at one place of a box says of all its places.
struct Tangent {
    /// The gradient along the nail, and what the turn of a tool may change of it.
    slope: f64,
    turned: f64,
    /// No tool of the node is nearer.
    least_mm: f64,
}

impl Tangent {
    #[inline]
    fn lowest(&self, nail: &Line, highest_mm: f64) -> Option<f64> {
        if self.slope < 0.0 {
            // It rises downwards; but so may the turn with the arm.
            let rise = -self.slope - self.turned;
            return match rise > 1e-9 {
                true if self.least_mm > 0.0 => None,
                true => Some((highest_mm + self.least_mm / rise).max(nail.lowest_mm)),
                false => Some(nail.lowest_mm),
            };
        }
        let most = (self.slope + self.turned) * (highest_mm - nail.lowest_mm);
        (self.least_mm <= most).then_some(nail.lowest_mm)
    }
}

/// The box stands along the principal directions of the pivots: that of a piece of a surface is as thin as the surface is flat.
fn edges(middles: &[(Vec3, Vec3)]) -> Mat3 {
    let mean: Vec3 = middles.iter().map(|m| m.0).sum::<Vec3>() / middles.len() as f64;
    let spread: Mat3 = middles.iter().map(|m| (m.0 - mean) * (m.0 - mean).transpose()).sum();
    let directions = spread.symmetric_eigen().eigenvectors.transpose();
    // Without any spread, or with one that is not finite.
    if directions.iter().all(|c| c.is_finite()) { directions } else { Mat3::identity() }
}
