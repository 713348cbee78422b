//! Circles: C, CR, CT, CP, CTP; approach and departure.

use trueaxis_contour::lead::Lead;

use super::words::Words;
use super::{Run, fault};
use crate::execution::radius::Approach;
use crate::execution::{arcs, mistakes};
use crate::moves::turns::unit;
use crate::moves::{Arc, Axis, CompensationSide, MoveKind, Position};
use crate::text::program::Fault;

/// How far the radius at the end may differ from that at the start: the tolerance that the manual
/// names for C blocks (iTNC 530, "Circular path C around circle center CC").
const TOLERANCE_MM: f64 = 0.016;

/// Turns of one helix: more than any program means.
const MOST_TURNS: f64 = 1e6;

/// A circle in the plane, ready to be moved.
struct Circle {
    center: [f64; 2],
    ccw: bool,
    turns: u32,
    target: Position,
}

impl Run<'_> {
    /// C (3), CP (4), CR (5), CT (6) and CTP (7).
    pub(super) fn circle(&mut self, kind: usize, words: &Words, rapid: bool) -> Result<(), Fault> {
        if rapid {
            let message = "a circle with FMAX: the previous feed is used";
            self.core.warn("rapid-circle", "", words.at, message, "write F");
        }
        self.core.modes.check_feed(words.at)?;
        let circle = match kind {
            3 => self.circle_about_pole(words)?,
            4 => self.polar_circle(words)?,
            5 => self.circle_by_radius(words)?,
            _ => {
                let target = if kind == 7 {
                    self.polar_target(words)?
                } else {
                    words.target(&self.frames.position)
                };
                match self.tangential(target, words.at)? {
                    Some(circle) => circle,
                    None => return self.step(MoveKind::Linear, target, words.at),
                }
            }
        };
        self.turn_along(circle, words)
    }

    fn turn_along(&mut self, circle: Circle, words: &Words) -> Result<(), Fault> {
        let plane = self.core.modes.plane;
        let [first, second, _] = plane.axes();
        let arc = Arc { plane, center_mm: circle.center, turns: circle.turns, ccw: circle.ccw };
        let named = words.named().with(first).with(second);
        let target = circle.target;
        let kind = MoveKind::Arc(arc);
        self.emit_move(self.core.plain_move(kind, target, named), words.at)?;
        self.tangent = unit(arcs::end_tangent(&arc, &target));
        Ok(())
    }

    fn in_plane(&self, place: &Position) -> [f64; 2] {
        let [first, second, _] = self.core.modes.plane.axes();
        [place[first], place[second]]
    }

    fn sense(words: &Words) -> Result<bool, Fault> {
        words.ccw.ok_or_else(|| {
            let message = "the sense of the circle is missing";
            fault("missing-direction", words.at, message, "write DR+ or DR-")
        })
    }

    /// C X Y DR: about CC; without coordinates, or at the place where it begins, a full circle.
    fn circle_about_pole(&mut self, words: &Words) -> Result<Circle, Fault> {
        let ccw = Self::sense(words)?;
        let center = self.pole(words.at)?;
        let target = words.target(&self.frames.position);
        let ends = [self.in_plane(&self.frames.position), self.in_plane(&target)];
        arcs::check_radii(ends, center, |_| TOLERANCE_MM, words.at)?;
        Ok(Circle { center, ccw, turns: 1, target })
    }

    /// CP PA or IPA DR, with Z a helix of any number of turns.
    fn polar_circle(&mut self, words: &Words) -> Result<Circle, Fault> {
        let ccw = Self::sense(words)?;
        let center = self.pole(words.at)?;
        let (radius, angle) = self.polar_place(center);
        if radius <= 0.0 {
            let message = "the radius of the circle is zero";
            return Err(fault("arc-does-not-fit", words.at, message, "check CC"));
        }
        let target = self.polar_target(words)?;
        let mut turns = 1;
        if let Some(sweep) = words.angle {
            let swept = if sweep.incremental { sweep.value } else { sweep.value - angle };
            if sweep.incremental && swept != 0.0 && (swept > 0.0) != ccw {
                let message = "IPA and DR have different signs: DR is used";
                self.core.warn("contrary-signs", "IPA", words.at, message, "write the same sign");
            }
            if sweep.incremental {
                let count = (swept.abs() / 360.0 - 1e-9).ceil().max(1.0);
                if count > MOST_TURNS {
                    return Err(mistakes::bad_turns(count, words.at));
                }
                turns = count as u32;
            }
        }
        Ok(Circle { center, ccw, turns, target })
    }

    /// CR X Y R DR: R+ less than half a turn, R- more.
    fn circle_by_radius(&mut self, words: &Words) -> Result<Circle, Fault> {
        let ccw = Self::sense(words)?;
        let Some(radius) = words.arc_radius else {
            return Err(mistakes::arc_without_centre("write R+10 or R-10", words.at));
        };
        let target = words.target(&self.frames.position);
        let ends = [self.in_plane(&self.frames.position), self.in_plane(&target)];
        let center = arcs::by_radius(ends, radius, ccw, TOLERANCE_MM, words.at)?;
        Ok(Circle { center, ccw, turns: 1, target })
    }

    /// CT: the circle that leaves the last element without a corner; `None` if it is a line.
    fn tangential(&mut self, target: Position, at: usize) -> Result<Option<Circle>, Fault> {
        let [first, second, _] = self.core.modes.plane.axes();
        let along = arcs::direction_before(self.tangent, [first as usize, second as usize], at)?;
        let (start, end) = (self.in_plane(&self.frames.position), self.in_plane(&target));
        let Some((center, ccw)) = arcs::tangential([start, end], along) else {
            if (end[0] - start[0]) * along[0] + (end[1] - start[1]) * along[1] > 0.0 {
                return Ok(None);
            }
            let message = "the target lies in the direction opposite to the motion: no tangential \
                circle leads to it";
            return Err(fault("arc-does-not-fit", at, message, "check the target"));
        };
        Ok(Some(Circle { center, ccw, turns: 1, target }))
    }

    /// APPR LT LEN, LN LEN, CT CCA R and LCT R: the way depends on the element that follows.
    ///
    /// DIFFERENCE: the manuals do not state whether LEN and R count on the contour or for the centre of the
    /// tool. Here they count for the centre: R5 with a tool of radius 10 would not be possible otherwise.
    pub(super) fn approach(
        &mut self,
        form: usize,
        words: &Words,
        rapid: bool,
    ) -> Result<(), Fault> {
        let name = ["LT", "LN", "CT", "LCT", "PLT", "PLN", "PCT", "PLCT", "L"][form];
        let target = if (4..8).contains(&form) {
            self.polar_target(words)?
        } else {
            words.target(&self.frames.position)
        };
        if !rapid {
            self.core.modes.check_feed(words.at)?;
        }
        let kind = if rapid { MoveKind::Rapid } else { MoveKind::Linear };
        let feed = self.core.modes.feed;
        let lead = match (form % 4, words.length, words.sweep.zip(words.arc_radius)) {
            _ if form == 8 => None,
            (0, Some(length_mm), _) => Some(Lead::Tangent { length_mm }),
            (1, Some(length_mm), _) => Some(Lead::Normal { length_mm }),
            (2, _, Some((sweep, radius_mm))) if radius_mm != 0.0 => {
                Some(Lead::Arc { radius_mm, sweep_rad: sweep.to_radians() })
            }
            (3, ..) => {
                words.arc_radius.filter(|r| *r > 0.0).map(|r| Lead::LineAndArc { radius_mm: r })
            }
            _ => None,
        };
        if let Some(lead) = lead {
            self.approach_next(Approach { lead, kind, feed, name }, words.at);
        } else if form < 8 {
            let message = format!("APPR {name} needs LEN, or CCA and R");
            let hint = "write APPR LT … LEN5, APPR LN … LEN5, APPR CT … CCA90 R5 or APPR LCT … R5";
            return Err(fault("missing-value", words.at, message, hint));
        }
        self.step(kind, target, words.at)?;
        self.tangent = None;
        Ok(())
    }

    /// DEP LT LEN, LN LEN, CT CCA R and LCT X Y R go on from the last element.
    pub(super) fn depart(&mut self, form: usize, words: &Words, rapid: bool) -> Result<(), Fault> {
        if !rapid {
            self.core.modes.check_feed(words.at)?;
        }
        let [first, second, _] = self.core.modes.plane.axes();
        let flat = self.tangent.map(|t| [t[first as usize], t[second as usize]]);
        let along = flat.and_then(|t| unit([t[0], t[1], 0.0]));
        // Away from the workpiece: to the left with RL.
        let left = if self.modes.side == CompensationSide::Left { 1.0 } else { -1.0 };
        if let Some(centre) = self.core.leave_contour() {
            self.frames.position = centre;
        }
        let now = self.frames.position;
        let mut target = words.target(&now);
        match (form, along, words.length, words.sweep.zip(words.arc_radius)) {
            (0 | 1, Some(t), Some(length), _) => {
                let to = if form == 0 { [t[0], t[1]] } else { [-left * t[1], left * t[0]] };
                target[first] = now[first] + to[0] * length;
                target[second] = now[second] + to[1] * length;
                let kind = if rapid { MoveKind::Rapid } else { MoveKind::Linear };
                self.step(kind, target, words.at)
            }
            (2, Some(t), _, Some((sweep, radius))) if radius != 0.0 => {
                self.core.modes.check_feed(words.at)?;
                let side = left * radius.signum();
                let r = radius.abs();
                let center = [now[first] - side * t[1] * r, now[second] + side * t[0] * r];
                let (sin, cos) = (side * sweep).to_radians().sin_cos();
                let arm = [now[first] - center[0], now[second] - center[1]];
                target[first] = center[0] + cos * arm[0] - sin * arm[1];
                target[second] = center[1] + sin * arm[0] + cos * arm[1];
                let circle = Circle { center, ccw: side > 0.0, turns: 1, target };
                self.turn_along(circle, words)
            }
            (3 | 7, Some(t), ..) if words.arc_radius.is_some_and(|r| r > 0.0) => {
                if form == 7 {
                    target = self.polar_target(words)?;
                }
                self.depart_by_circle_and_line(t, target, words)
            }
            _ => {
                let message = "DEP needs a previous contour element, and LEN, or CCA and R";
                let hint = "write DEP LT LEN5, DEP LN LEN5, DEP CT CCA90 R5 or DEP LCT X… Y… R5";
                Err(fault("missing-value", words.at, message, hint))
            }
        }
    }

    /// DEP LCT: a circle that leaves the last element without a corner, then a line to the target.
    ///
    /// With the centre c on the side of the target e, d = e − c and s = ±1 for the sense, the line
    /// touches the circle at the angle of d less s · acos(R / |d|) (the radius stands square on it).
    fn depart_by_circle_and_line(
        &mut self,
        along: [f64; 3],
        target: Position,
        words: &Words,
    ) -> Result<(), Fault> {
        self.core.modes.check_feed(words.at)?;
        let [first, second, _] = self.core.modes.plane.axes();
        let radius = words.arc_radius.unwrap_or(0.0);
        let (start, end) = (self.in_plane(&self.frames.position), self.in_plane(&target));
        let side = along[0] * (end[1] - start[1]) - along[1] * (end[0] - start[0]);
        let sense = if side < 0.0 { -1.0 } else { 1.0 };
        let center = [start[0] - sense * along[1] * radius, start[1] + sense * along[0] * radius];
        let d = [end[0] - center[0], end[1] - center[1]];
        let distance = d[0].hypot(d[1]);
        if distance <= radius {
            let message = "the target of DEP LCT lies within its circle";
            return Err(fault("arc-does-not-fit", words.at, message, "check R and the target"));
        }
        let angle = d[1].atan2(d[0]) - sense * (radius / distance).acos();
        let mut touch = self.frames.position;
        touch[first] = center[0] + radius * angle.cos();
        touch[second] = center[1] + radius * angle.sin();
        let ccw = sense > 0.0;
        self.turn_along(Circle { center, ccw, turns: 1, target: touch }, words)?;
        self.step(MoveKind::Linear, target, words.at)
    }

    /// The axis along which the tool stands.
    pub(super) fn along(&self) -> Axis {
        self.core.modes.plane.axes()[2]
    }
}
