//! A move, or a part of one, in which the tool turns little: where it first enters a nail.

use crate::Cutter;
use crate::nail::Line;
use trueaxis_geometry::Vec3;

/// Where the tool is: its tip and its axis, from the tip to the holder, in the workpiece frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ToolPose {
    /// The tip.
    pub tip_mm: Vec3,
    /// A unit vector.
    pub axis: Vec3,
}

impl ToolPose {
    /// Between two poses: the tip on a straight line, the axis at a constant rate on the shortest way.
    #[must_use]
    pub fn towards(&self, to: &Self, part: f64) -> Self {
        let tip_mm = self.tip_mm + (to.tip_mm - self.tip_mm) * part;
        let angle = trueaxis_geometry::angle(&self.axis, &to.axis);
        if angle < 1e-12 {
            return Self { tip_mm, axis: self.axis };
        }
        let across = (to.axis - self.axis * self.axis.dot(&to.axis)).normalize();
        let (sin, cos) = (angle * part).sin_cos();
        Self { tip_mm, axis: self.axis * cos + across * sin }
    }
}

/// What the cutter is to a point: how far from it, and how that changes.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Seen {
    pub distance_mm: f64,
    /// With the point, in the workpiece frame: the outward normal of the cutter there.
    pub gradient: Vec3,
}

/// How far a point is from a cutter in a pose.
#[inline]
pub(crate) fn seen(cutter: &Cutter, tip_mm: &Vec3, axis: &Vec3, point_mm: &Vec3) -> Seen {
    let arm = point_mm - tip_mm;
    let axial = arm.dot(axis);
    let across = arm - axis * axial;
    let radial = across.norm();
    let (distance_mm, [out, up]) = cutter.distance(radial, axial);
    // On the axis every direction across is as good: none is taken.
    let out = if radial > 1e-12 { out / radial } else { 0.0 };
    Seen { distance_mm, gradient: across * out + axis * up }
}

/// The motion: the tip goes straight, the axis is the direction of a straight change of its components.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Motion {
    tip_mm: Vec3,
    tip_change_mm: Vec3,
    axis: Vec3,
    axis_change: Vec3,
    /// By how much the distance may be less than a convex function of the place. Unit: mm.
    slack_mm: f32,
    /// In so many pieces it is convex but for the bound.
    pieces: u16,
    /// Of which move it is, and from where to where.
    pub of: u32,
    from: f32,
    to: f32,
}

/// A stretch of places.
type Stretch = [f64; 2];

/// Unit: mm.
pub(crate) fn slack_mm(cutter: &Cutter, [a, b]: &[ToolPose; 2]) -> f64 {
    let turn = trueaxis_geometry::angle(&a.axis, &b.axis);
    let way = (b.tip_mm - a.tip_mm).norm() + cutter.pivot_mm() * turn;
    0.5 * (turn * turn * cutter.reach_mm() + 2.0 * turn * way)
}

/// Where a motion enters a nail.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Entry {
    pub at_mm: f64,
    pub place: f64,
    /// Out of the cutter; at an edge the direction between both sides that the motion along the piece leaves alone.
    pub out: Vec3,
}

impl Motion {
    /// A point at r from the pivot, seen from a tool that turns by θ and moves by L, has the acceleration θ²r + 2θL per square of
    /// the place. A function whose second derivative is nowhere below −K has no end lower by more than K/2 than that towards which
    /// it falls.
    pub fn new(
        (cutter, bound_mm): (&Cutter, f64),
        poses: &[ToolPose; 2],
        (of, from, to): (u32, f32, f32),
    ) -> Self {
        let [a, b] = poses;
        let slack_mm = slack_mm(cutter, poses);
        let pieces = (slack_mm / bound_mm).sqrt().ceil().clamp(1.0, f64::from(u16::MAX));
        Self {
            slack_mm: slack_mm as f32,
            pieces: pieces as u16,
            tip_mm: a.tip_mm,
            tip_change_mm: b.tip_mm - a.tip_mm,
            axis: a.axis,
            axis_change: b.axis - a.axis,
            of,
            from,
            to,
        }
    }

    /// Where the tool is, and how its axis changes.
    #[inline]
    fn pose(&self, place: f64) -> (Vec3, Vec3, Vec3) {
        let tip = self.tip_mm + self.tip_change_mm * place;
        if self.axis_change == Vec3::zeros() {
            return (tip, self.axis, self.axis_change);
        }
        let long = self.axis + self.axis_change * place;
        let length = long.norm();
        let axis = long / length;
        (tip, axis, (self.axis_change - axis * axis.dot(&self.axis_change)) / length)
    }

    pub fn middle(&self, pivot_mm: f64) -> (Vec3, Vec3) {
        let (tip, axis, _) = self.pose(0.5);
        (tip + axis * pivot_mm, axis)
    }

    pub fn ends(&self, pivot_mm: f64) -> [(Vec3, Vec3); 2] {
        [0.0, 1.0].map(|place| {
            let (tip, axis, _) = self.pose(place);
            (tip + axis * pivot_mm, axis)
        })
    }

    /// By how much a pivot leaves its chord as the axis turns.
    pub fn bow_mm(&self, pivot_mm: f64) -> f64 {
        pivot_mm * self.axis_change.norm_squared() / 8.0
    }

    /// The place as a part of the whole move.
    pub fn place_of_move(&self, place: f64) -> f64 {
        f64::from(self.from) + (f64::from(self.to) - f64::from(self.from)) * place
    }

    pub fn pose_at(&self, place: f64) -> ToolPose {
        let (tip_mm, axis, _) = self.pose(place);
        ToolPose { tip_mm, axis }
    }

    /// How far a point is from the tool at a place, and how that changes with the place.
    #[inline]
    fn at(&self, cutter: &Cutter, point: &Vec3, place: f64) -> (Seen, f64) {
        let (tip, axis, turning) = self.pose(place);
        let seen = seen(cutter, &tip, &axis, point);
        // The point moves against the tip; where the axis turns the body turns with it about the tip:
        // d(arm · axis) = arm · axis', and what the arm gains along the axis it loses across.
        let arm = point - tip;
        let axial = arm.dot(&axis);
        let up = seen.gradient.dot(&axis);
        let out = seen.gradient - axis * up;
        let turn = up * arm.dot(&turning) - axial * out.dot(&turning);
        let change = turn - seen.gradient.dot(&self.tip_change_mm);
        (seen, change)
    }

    /// Where on the nail the cutter first arrives in this motion, if below `highest_mm`.
    pub fn entry(
        &self,
        cutter: &Cutter,
        nail: &Line,
        highest_mm: f64,
        bound_mm: f64,
    ) -> Option<Entry> {
        let whole = [0.0, 1.0];
        let slack_mm = f64::from(self.slack_mm).max(bound_mm);
        let middle = self.tangent(cutter, &nail.at(highest_mm), 0.5);
        // Most motions end here.
        if middle.stays_away(nail, highest_mm, (whole, slack_mm)) {
            return None;
        }
        if self.pieces == 1 || self.meets_a_ball(cutter, nail, highest_mm) {
            return self.search_from(middle, (cutter, nail, highest_mm), (whole, bound_mm));
        }
        let mut best: Option<Entry> = None;
        for k in 0..self.pieces {
            let stretch = [k, k + 1].map(|k| f64::from(k) / f64::from(self.pieces));
            let below = best.map_or(highest_mm, |b| b.at_mm);
            best = self.search(cutter, nail, below, (stretch, bound_mm)).or(best);
        }
        best
    }

    /// Whether the nail sees nothing but the ball of a ball-nosed cutter: from its centre, which goes straight but for a hair, the
    /// distance is convex however the tool turns.
    fn meets_a_ball(&self, cutter: &Cutter, nail: &Line, highest_mm: f64) -> bool {
        let Some(centre_mm) = cutter.ball_mm() else { return false };
        let (tip, axis, _) = self.pose(0.5);
        let height = |at: f64| (nail.at(at) - tip).dot(&axis);
        let most = height(nail.lowest_mm).max(height(highest_mm));
        let arm = (nail.at(highest_mm) - tip).norm().max((nail.at(nail.lowest_mm) - tip).norm());
        most + arm * self.axis_change.norm() + self.tip_change_mm.norm() <= centre_mm
    }

    /// Newton's steps along the nail on the least distance over a stretch. That is convex: a step from above the entry, where the
    /// cutter is, ends below it, and from there every step ends below it.
    fn search(
        &self,
        cutter: &Cutter,
        nail: &Line,
        highest_mm: f64,
        (stretch, slack_mm): (Stretch, f64),
    ) -> Option<Entry> {
        let middle = self.tangent(cutter, &nail.at(highest_mm), 0.5 * (stretch[0] + stretch[1]));
        self.search_from(middle, (cutter, nail, highest_mm), (stretch, slack_mm))
    }

    /// The same, by the tangent in the middle of the stretch at the highest place.
    fn search_from(
        &self,
        middle: Tangent,
        (cutter, nail, highest_mm): (&Cutter, &Line, f64),
        (stretch, slack_mm): (Stretch, f64),
    ) -> Option<Entry> {
        let mut at_mm = highest_mm;
        if middle.stays_away(nail, highest_mm, (stretch, slack_mm)) {
            return None;
        }
        let mut least = self.nearest(cutter, nail, at_mm, (middle, stretch, slack_mm));
        if least.distance_mm > 0.0 && least.slope(nail) <= 0.0 {
            return None;
        }
        // A place outside of the cutter and a higher one inside of it, as far as they are known.
        let (mut outside, mut inside) = (None, (least.distance_mm <= 0.0).then_some(at_mm));
        if least.slope(nail) >= 0.0 {
            at_mm = nail.lowest_mm;
            least = self.nearest_again(cutter, nail, at_mm, (&least, stretch));
        }
        for _ in 0..MOST_STEPS {
            let ended = at_mm <= nail.lowest_mm && least.distance_mm <= 0.0;
            if ended || least.distance_mm.abs() <= CLOSE_MM {
                return Some(least.entry(at_mm));
            }
            match least.distance_mm > 0.0 {
                true => outside = Some(at_mm),
                false => inside = Some(at_mm),
            }
            at_mm = next_place(nail, at_mm, &least, (outside, inside))?;
            if at_mm > highest_mm {
                return None;
            }
            least = self.nearest_again(cutter, nail, at_mm, (&least, stretch));
        }
        // It touches the nail without going in, or to within what it may be misjudged by.
        (least.distance_mm <= slack_mm).then(|| least.entry(at_mm))
    }

    /// The direction out of an edge that lies on the nail: as a place a hair below the entry sees it.
    pub fn out_of_edge(&self, cutter: &Cutter, nail: &Line, entry: &Entry) -> Vec3 {
        const HAIR_MM: f64 = 1e-6;
        let below = nail.at(entry.at_mm - HAIR_MM);
        self.at(cutter, &below, entry.place).0.gradient
    }

    #[inline]
    fn tangent(&self, cutter: &Cutter, point: &Vec3, place: f64) -> Tangent {
        let (seen, change) = self.at(cutter, point, place);
        Tangent { place, distance_mm: seen.distance_mm, change, gradient: seen.gradient }
    }

    /// The same at another place of the nail, where the least distance is not far from the place of the last one.
    fn nearest_again(
        &self,
        cutter: &Cutter,
        nail: &Line,
        at_mm: f64,
        (last, stretch): (&Least, Stretch),
    ) -> Least {
        let begin = self.tangent(cutter, &nail.at(at_mm), last.place);
        let never = f64::INFINITY;
        // Twice as far as the change would need to vanish.
        let ahead = begin.place - 2.0 * begin.change / last.bend;
        if last.bend > 0.0 && stretch[0] < ahead && ahead < stretch[1] {
            let end = self.tangent(cutter, &nail.at(at_mm), ahead);
            if end.change * begin.change < 0.0 {
                return self.between(cutter, nail, at_mm, (begin, end, never));
            }
        }
        self.nearest(cutter, nail, at_mm, (begin, stretch, never))
    }

    /// The least distance of a place of the nail over a stretch; only a bound of it where that is more than `slack_mm` and no lower
    /// place of the nail is nearer.
    fn nearest(
        &self,
        cutter: &Cutter,
        nail: &Line,
        at_mm: f64,
        (begin, [from, to], slack_mm): (Tangent, Stretch, f64),
    ) -> Least {
        if begin.change == 0.0 {
            return begin.alone();
        }
        // The end towards which it comes nearer.
        let end = if begin.change < 0.0 { to } else { from };
        let end = self.tangent(cutter, &nail.at(at_mm), end);
        if end.change * begin.change >= 0.0 {
            return end.alone();
        }
        self.between(cutter, nail, at_mm, (begin, end, slack_mm))
    }

    /// Two tangents on both sides of the least distance cross below it. Their weighted mean, in which the place drops out, is a
    /// tangent of the least distance along the nail, also where an edge of the cutter makes a corner.
    fn between(
        &self,
        cutter: &Cutter,
        nail: &Line,
        at_mm: f64,
        (begin, end, slack_mm): (Tangent, Tangent, f64),
    ) -> Least {
        let point = nail.at(at_mm);
        let (mut low, mut high) = if begin.change < 0.0 { (begin, end) } else { (end, begin) };
        let mut best = if low.distance_mm < high.distance_mm { low } else { high };
        for step in 0..MOST_STEPS {
            let (crossing, bound_mm) = low.crosses(&high);
            let decided = bound_mm > slack_mm && low.mean(&high).dot(&nail.normal) <= 0.0;
            let span = high.place - low.place;
            let gap_mm = best.distance_mm - bound_mm;
            if decided || gap_mm.abs() <= CLOSE_MM || span <= CLOSE_PLACE {
                break;
            }
            let place = match step % 2 {
                // Tangents that cross above: there is an edge between, and the rest is a hair hollow.
                _ if gap_mm < 0.0 => low.place + 0.5 * span,
                // Where the change would be nought: fast on what is round. Where tangents cross: at once at an edge.
                0 => low.level(&high),
                _ => crossing,
            };
            let next = self.tangent(cutter, &point, place);
            if next.distance_mm < best.distance_mm {
                best = next;
            }
            match next.change {
                0.0 => return next.alone(),
                change if change < 0.0 => low = next,
                _ => high = next,
            }
        }
        Least {
            place: best.place,
            distance_mm: best.distance_mm,
            gradient: low.mean(&high),
            bend: (high.change - low.change) / (high.place - low.place).max(1e-9),
        }
    }
}

/// Newton's step; where it leaves what is known the middle of that. None where the cutter only gets farther.
fn next_place(
    nail: &Line,
    at_mm: f64,
    least: &Least,
    (outside, inside): (Option<f64>, Option<f64>),
) -> Option<f64> {
    let slope = least.slope(nail);
    let step = (slope < 0.0).then(|| (at_mm - least.distance_mm / slope).max(nail.lowest_mm));
    let Some(inside) = inside else { return step };
    let low = outside.unwrap_or(nail.lowest_mm);
    match step {
        Some(step) if step < inside && (step > low || outside.is_none()) => Some(step),
        _ => Some(0.5 * (low + inside)),
    }
}

/// The least distance over a piece.
#[derive(Debug, Clone, Copy)]
struct Least {
    place: f64,
    distance_mm: f64,
    gradient: Vec3,
    /// The change of the change; 0 if unknown.
    bend: f64,
}

impl Least {
    fn slope(&self, nail: &Line) -> f64 {
        self.gradient.dot(&nail.normal)
    }

    fn entry(&self, at_mm: f64) -> Entry {
        Entry { at_mm, place: self.place, out: self.gradient.normalize() }
    }
}

/// The distance at a place, and how it changes along the piece and with the point.
#[derive(Debug, Clone, Copy)]
struct Tangent {
    place: f64,
    distance_mm: f64,
    change: f64,
    gradient: Vec3,
}

impl Tangent {
    fn alone(self) -> Least {
        let Self { place, distance_mm, gradient, .. } = self;
        Least { place, distance_mm, gradient, bend: 0.0 }
    }

    /// Nothing of the nail up to `highest_mm` is inside, by this tangent in the middle of a stretch.
    fn stays_away(
        &self,
        nail: &Line,
        highest_mm: f64,
        ([from, to], slack_mm): (Stretch, f64),
    ) -> bool {
        let down = self.gradient.dot(&nail.normal).max(0.0) * (highest_mm - nail.lowest_mm);
        self.distance_mm - 0.5 * (to - from) * self.change.abs() - down > slack_mm
    }

    /// The weighted mean of both gradients in which the change drops out.
    fn mean(&self, rising: &Self) -> Vec3 {
        let weight = rising.change / (rising.change - self.change);
        self.gradient * weight + rising.gradient * (1.0 - weight)
    }

    /// Where a falling tangent crosses a rising one, and how low.
    fn crosses(&self, rising: &Self) -> (f64, f64) {
        let gap = rising.distance_mm - self.distance_mm;
        let span = rising.place - self.place;
        let on = (gap - rising.change * span) / (self.change - rising.change);
        let on = on.clamp(0.0, span);
        (self.place + on, self.distance_mm + self.change * on)
    }

    /// Where a straight change between them would be nought.
    fn level(&self, rising: &Self) -> f64 {
        let weight = rising.change / (rising.change - self.change);
        self.place * weight + rising.place * (1.0 - weight)
    }
}

/// A distance that counts as none.
const CLOSE_MM: f64 = 1e-11;
/// Places that count as one.
const CLOSE_PLACE: f64 = 1e-10;
const MOST_STEPS: usize = 60;
