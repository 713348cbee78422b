//! What a FANUC program does to its own coordinates: polar coordinates, mirror, scale, rotation,
//! tilted plane.
//!
//! # Source
//! FANUC Series 30i/31i/32i operator's manual, chapters "Coordinate value and dimension" and
//! "Functions to simplify programming": mirror is applied to the written place first, then scale,
//! then rotation; the tilted plane holds all of them.

use crate::execution::mistakes;
use crate::moves::turns::{about, cross, from_axes, point, turns};
use crate::moves::{Axis, Branch, Event, Frame, MoveKind, Plane, Position};
use crate::rs274::code::Action;
use crate::rs274::{Language, Run, fault};
use crate::text::program::Fault;

/// The frames that a program sets up, from the outside to the inside.
#[derive(Debug, Clone, Default)]
pub(in crate::rs274) struct Transforms {
    /// G68.2 and 3-D G68.
    tilt: Option<Frame>,
    /// The plane is swivelled: G68.2.
    pub tilted: bool,
    /// How many 3-D G68 are within each other.
    nested: u8,
    rotation: Option<Frame>,
    scale: Option<Frame>,
    /// Mirror planes X, Y and Z.
    mirror: [Option<f64>; 3],
    /// Points or vectors of G68.2 P2 and P3 that came so far.
    pieces: [Option<[f64; 3]>; 4],
    /// The turn of G68.2 P2 Q0 in its plane and its shift.
    extra: Option<([f64; 3], f64)>,
    pub polar: Option<Polar>,
}

/// Polar coordinates that are on.
#[derive(Debug, Clone, Copy)]
pub(in crate::rs274) struct Polar {
    center_mm: [f64; 2],
    radius_mm: f64,
    angle_deg: f64,
}

impl Transforms {
    /// All of them as one; `None` if there is none.
    fn whole(&self) -> Option<Frame> {
        let mirror = self.mirror.iter().any(Option::is_some).then(|| {
            let mut frame = Frame::IDENTITY;
            for (i, at) in self.mirror.iter().enumerate() {
                if let Some(at) = at {
                    frame.linear[i][i] = -1.0;
                    frame.shift.0[i] = 2.0 * at;
                }
            }
            frame
        });
        let parts = [self.tilt, self.rotation, self.scale, mirror];
        parts.into_iter().flatten().reduce(|outer, inner| outer.after(&inner))
    }

    /// Which codes are on, for #4011, #4016, #4017 and #4022.
    pub fn codes(&self) -> [f64; 4] {
        let rotated = match (self.tilted, self.rotation.is_some() || self.tilt.is_some()) {
            (true, _) => 68.2,
            (false, true) => 68.0,
            _ => 69.0,
        };
        let mirrored = self.mirror.iter().any(Option::is_some);
        [
            if self.scale.is_some() { 51.0 } else { 50.0 },
            rotated,
            if self.polar.is_some() { 16.0 } else { 15.0 },
            if mirrored { 51.1 } else { 50.1 },
        ]
    }
}

/// A frame applied about a centre.
fn centred(frame: &Frame, center: [f64; 3]) -> Frame {
    let back = Frame::shifted(point(center.map(|c| -c)));
    Frame::shifted(point(center)).after(&frame.after(&back))
}

fn unit(v: [f64; 3]) -> Option<[f64; 3]> {
    let length = v.iter().map(|x| x * x).sum::<f64>().sqrt();
    (length > 1e-9).then(|| v.map(|x| x / length))
}

/// A turn about any axis through the origin.
///
/// # Source
/// Rodrigues: v′ = v cos φ + (k × v) sin φ + k (k·v)(1 − cos φ).
fn about_vector(axis: [f64; 3], angle_deg: f64) -> Frame {
    let (sin, cos) = angle_deg.to_radians().sin_cos();
    let mut frame = Frame::IDENTITY;
    for column in 0..3 {
        let e: [f64; 3] = std::array::from_fn(|i| f64::from(u8::from(i == column)));
        let turned = cross(axis, e);
        for row in 0..3 {
            let along = axis[row] * axis[column] * (1.0 - cos);
            frame.linear[row][column] = e[row] * cos + turned[row] * sin + along;
        }
    }
    frame
}

impl Run<'_> {
    /// Puts the frames together; the machine stays where it is.
    fn apply_transforms(&mut self) {
        let whole = self.modes.transforms.whole();
        self.frames.change(|f| f.program = whole);
        self.emit_frame();
    }

    /// Whether the tool stands in the workpiece whatever the rotary axes do.
    pub(in crate::rs274) fn follows_workpiece(&self) -> bool {
        self.core.modes.tool_centre || self.modes.transforms.tilted
    }

    /// G15 to G69: true if the action was one of these.
    pub(in crate::rs274) fn transform(&mut self, action: Action, at: usize) -> Result<bool, Fault> {
        match action {
            Action::Polar(on) => self.polar_mode(on),
            Action::Scale => self.scale(at)?,
            Action::ScaleOff => {
                self.modes.transforms.scale = None;
                self.apply_transforms();
            }
            Action::Mirror(on) => self.mirror(on),
            Action::Rotation => self.rotation(at)?,
            Action::TiltedPlane { further } => self.tilted_plane(further, at)?,
            Action::RotationOff => {
                let transforms = &mut self.modes.transforms;
                let was = std::mem::take(&mut transforms.tilted);
                (transforms.tilt, transforms.rotation, transforms.nested) = (None, None, 0);
                (transforms.pieces, transforms.extra) = ([None; 4], None);
                if was {
                    self.core.emit(Event::TiltedPlane(false));
                }
                self.apply_transforms();
            }
            Action::Align { keep_tip } => self.align(keep_tip, at)?,
            Action::DynamicOffset(on) => self.dynamic_offset(on, at)?,
            _ => return Ok(false),
        }
        Ok(true)
    }

    fn polar_mode(&mut self, on: bool) {
        let [a, b, _] = self.core.modes.plane.axes();
        let place = [self.frames.position[a], self.frames.position[b]];
        self.modes.transforms.polar = on.then(|| Polar {
            center_mm: [0.0; 2],
            radius_mm: place[0].hypot(place[1]),
            angle_deg: place[1].atan2(place[0]).to_degrees(),
        });
    }

    /// The place in the plane from radius and angle words; they count as used.
    ///
    /// With G91 a radius counts from the present place, an angle from the angle before.
    pub(in crate::rs274) fn polar_place(&mut self) -> Option<[f64; 2]> {
        let mut polar = self.modes.transforms.polar?;
        let [a, b, _] = self.core.modes.plane.axes();
        let (radius, angle) = (self.axis_word(a), self.words.take(b.letter()));
        if radius.is_none() && angle.is_none() {
            return None;
        }
        if let Some(radius) = radius {
            polar.center_mm = match self.core.modes.incremental {
                true => [self.frames.position[a], self.frames.position[b]],
                false => [0.0; 2],
            };
            polar.radius_mm = radius;
        }
        if let Some(angle) = angle {
            let base = if self.core.modes.incremental { polar.angle_deg } else { 0.0 };
            polar.angle_deg = base + angle;
        }
        self.modes.transforms.polar = Some(polar);
        let turned = about(2, polar.angle_deg).vector([polar.radius_mm, 0.0, 0.0]);
        Some([polar.center_mm[0] + turned[0], polar.center_mm[1] + turned[1]])
    }

    /// X, Y and Z as written, the present place for those that are not.
    fn center(&mut self) -> [f64; 3] {
        [Axis::X, Axis::Y, Axis::Z].map(|a| self.axis_word(a).unwrap_or(self.frames.position[a]))
    }

    /// G51: by P or by I, J and K about X, Y and Z.
    fn scale(&mut self, at: usize) -> Result<(), Fault> {
        self.modes.transforms.scale = None;
        self.apply_transforms();
        let center = self.center();
        let all = self.factor(b'P');
        let each = b"IJK".map(|l| self.factor(l));
        let mut frame = Frame::IDENTITY;
        for (i, own) in each.iter().enumerate() {
            let factor = own.or(all).unwrap_or(1.0);
            if !(1e-3..=1e3).contains(&factor.abs()) {
                return Err(mistakes::bad_scale(at));
            }
            frame.linear[i][i] = factor;
        }
        self.modes.transforms.scale = Some(centred(&frame, center));
        self.apply_transforms();
        Ok(())
    }

    /// A factor: with a decimal point as it is, without one in thousandths.
    fn factor(&mut self, letter: u8) -> Option<f64> {
        let thousandths = if self.has_point(letter) { 1.0 } else { 1000.0 };
        self.words.take(letter).map(|value| value / thousandths)
    }

    /// G51.1 mirrors at the planes of its words; G50.1 takes the planes of its words away.
    fn mirror(&mut self, on: bool) {
        let words = [Axis::X, Axis::Y, Axis::Z].map(|a| self.axis_word(a));
        let none = words.iter().all(Option::is_none);
        for (plane, word) in self.modes.transforms.mirror.iter_mut().zip(words) {
            match (on, word) {
                (true, Some(at)) => *plane = Some(at),
                (false, word) if none || word.is_some() => *plane = None,
                _ => {}
            }
        }
        self.apply_transforms();
    }

    /// G68: in the plane by R, in space by an axis I J K and R.
    fn rotation(&mut self, at: usize) -> Result<(), Fault> {
        let spatial = b"IJK".iter().any(|l| self.words.look(*l).is_some());
        if !spatial {
            self.modes.transforms.rotation = None;
            self.apply_transforms();
        }
        let center = self.center();
        let angle_deg = self.words.take(b'R').unwrap_or(0.0);
        if !spatial {
            let normal = self.core.modes.plane.axes()[2] as usize;
            let mut center = center;
            center[normal] = 0.0;
            self.modes.transforms.rotation = Some(centred(&about(normal, angle_deg), center));
            self.apply_transforms();
            return Ok(());
        }
        let Some(axis) = unit(b"IJK".map(|l| self.words.take(l).unwrap_or(0.0))) else {
            return Err(mistakes::zero_direction(at));
        };
        if self.modes.transforms.nested >= 2 {
            let message = "more than two nested rotations in space";
            return Err(fault("too-many-rotations", at, message, "end the rotations by G69"));
        }
        let turn = Frame::shifted(point(center)).after(&about_vector(axis, angle_deg));
        let transforms = &mut self.modes.transforms;
        transforms.nested += 1;
        transforms.tilt = Some(transforms.tilt.map_or(turn, |outer| outer.after(&turn)));
        if self.frames.tool != Position::default() {
            let message = "the tool length remains along the axes of the machine".to_owned();
            let hint = "use G68.2 with G53.1 where the tool is swivelled";
            self.core.warn("length-not-rotated", 0, at, message, hint);
        }
        self.apply_transforms();
        Ok(())
    }

    /// G68.2: a plane by Euler angles, P1 by turns in an order, P2 by points, P3 by vectors; G68.4
    /// builds on the plane that is there.
    fn tilted_plane(&mut self, further: bool, at: usize) -> Result<(), Fault> {
        let kind = self.words.take(b'P').unwrap_or(0.0);
        let place = [Axis::X, Axis::Y, Axis::Z].map(|a| self.axis_word(a));
        let origin = place.map(|v| v.unwrap_or(0.0));
        let frame = match kind {
            0.0 => {
                let [i, j, k] = b"IJK".map(|l| self.words.take(l).unwrap_or(0.0));
                // Z, then the new X, then the new Z.
                let turned = turns([(Axis::Z, i), (Axis::X, j), (Axis::Z, k)]);
                Some(Frame { shift: point(origin), ..turned })
            }
            1.0 => Some(self.plane_by_turns(origin, at)?),
            2.0 | 3.0 => self.plane_by_pieces(kind == 3.0, origin, at)?,
            _ => {
                let _ = self.words.take_all();
                let message = format!("G68.2 P{kind} is not applied");
                let hint = "use P0 to P3; the following moves are computed without it";
                self.core.warn("not-applied", 682, at, message, hint);
                return Ok(());
            }
        };
        let Some(frame) = frame else { return Ok(()) };
        self.refuse_with_dynamic_offset("a tilted plane", at)?;
        let transforms = &mut self.modes.transforms;
        (transforms.rotation, transforms.nested) = (None, 0);
        let outer = transforms.tilt.filter(|_| further && transforms.tilted);
        transforms.tilt = Some(outer.map_or(frame, |outer| outer.after(&frame)));
        if !std::mem::replace(&mut transforms.tilted, true) {
            self.core.emit(Event::TiltedPlane(true));
        }
        self.apply_transforms();
        Ok(())
    }

    /// Turns about the fixed X, Y and Z by I, J and K in the order of Q.
    fn plane_by_turns(&mut self, origin: [f64; 3], at: usize) -> Result<Frame, Fault> {
        let order = self.words.take(b'Q').unwrap_or(123.0);
        let angles = b"IJK".map(|l| self.words.take(l).unwrap_or(0.0));
        if ![123.0, 132.0, 213.0, 231.0, 312.0, 321.0].contains(&order) {
            let message = format!("Q{order} is not an order of three rotations");
            return Err(fault(
                "bad-tilted-plane",
                at,
                message,
                "write for example Q123: X, then Y, then Z",
            ));
        }
        let order = order as usize;
        let mut frame = Frame::IDENTITY;
        for digit in [order / 100, order / 10 % 10, order % 10] {
            frame = about(digit - 1, angles[digit - 1]).after(&frame);
        }
        Ok(Frame { shift: point(origin), ..frame })
    }

    /// P2 Q1 origin, Q2 a point on X, Q3 a point on the side of Y, Q0 a shift and turn in the plane;
    /// P3 Q1 the X axis I J K with the origin, Q2 the Z axis I J K. `None` until all are there.
    fn plane_by_pieces(
        &mut self,
        vectors: bool,
        place: [f64; 3],
        at: usize,
    ) -> Result<Option<Frame>, Fault> {
        let most = if vectors { 2 } else { 3 };
        let index = match self.words.take(b'Q') {
            Some(q) if q.fract() == 0.0 && (0.0..=f64::from(most)).contains(&q) => q as usize,
            _ => {
                let message = "Q, the number of the point or vector, is missing".to_owned();
                return Err(fault(
                    "bad-tilted-plane",
                    at,
                    message,
                    "write Q1, Q2 (and Q3 with P2)",
                ));
            }
        };
        let ijk = b"IJK".map(|l| self.words.take(l).unwrap_or(0.0));
        let turn_deg = self.words.take(b'R').unwrap_or(0.0);
        let transforms = &mut self.modes.transforms;
        match (vectors, index) {
            (false, 0) => transforms.extra = Some((place, turn_deg)),
            (false, _) => transforms.pieces[index] = Some(place),
            (true, 1) => (transforms.pieces[1], transforms.pieces[0]) = (Some(ijk), Some(place)),
            (true, _) => transforms.pieces[2] = Some(ijk),
        }
        let pieces = transforms.pieces;
        let frame = if vectors {
            let [Some(origin), Some(x), Some(z), _] = pieces else { return Ok(None) };
            let x = unit(x);
            let z = x.and_then(|x| unit(cross(cross(x, z), x)).filter(|_| unit(z).is_some()));
            x.zip(z).map(|(x, z)| from_axes([x, cross(z, x), z], origin))
        } else {
            let [_, Some(origin), Some(on_x), Some(on_y)] = pieces else { return Ok(None) };
            let to = |p: [f64; 3]| [0, 1, 2].map(|i| p[i] - origin[i]);
            let x = unit(to(on_x));
            let z = x.and_then(|x| unit(cross(x, to(on_y))));
            x.zip(z).map(|(x, z)| from_axes([x, cross(z, x), z], origin))
        };
        let extra = transforms.extra.take().filter(|_| !vectors);
        transforms.pieces = [None; 4];
        let Some(mut frame) = frame else {
            let message = "the points or vectors of the plane lie on one line";
            return Err(fault(
                "bad-tilted-plane",
                at,
                message,
                "state three points that form a triangle",
            ));
        };
        if let Some((shift, turn_deg)) = extra {
            frame = frame.after(&Frame::shifted(point(shift))).after(&about(2, turn_deg));
        }
        Ok(Some(frame))
    }

    /// G53.1 and G53.6.
    fn align(&mut self, keep_tip: bool, at: usize) -> Result<(), Fault> {
        if !self.modes.transforms.tilted {
            let message = "G53.1 without an active tilted plane";
            return Err(fault("no-tilted-plane", at, message, "write G68.2 before it"));
        }
        let branch = match self.words.take(b'P') {
            Some(1.0) => Branch::Positive,
            Some(2.0) => Branch::Negative,
            _ => Branch::Nearest,
        };
        self.step(MoveKind::Align { keep_tip, branch }, self.frames.position);
        Ok(())
    }

    /// Warns where a scale along the drill changes what the control leaves as it is.
    pub(in crate::rs274) fn check_depth(&mut self, axis: usize, at: usize) {
        let Some(scale) = self.modes.transforms.scale else { return };
        if scale.linear[axis][axis] != 1.0 {
            let message = "Q and the clearances of the cycle are scaled with its axis".to_owned();
            let hint = "FANUC does not scale them: scale only the plane, by I and J";
            self.core.warn("cycle-scaled", 0, at, message, hint);
        }
    }

    /// Warns where a circle becomes an ellipse: different scales in its plane.
    pub(in crate::rs274) fn check_round(&mut self, plane: Plane, at: usize) {
        let Some(scale) = self.modes.transforms.scale else { return };
        let [a, b, _] = plane.axes().map(|a| scale.linear[a as usize][a as usize].abs());
        if (a - b).abs() > 1e-9 * a.max(b) {
            let message = "this circle is scaled to an ellipse".to_owned();
            let hint = "FANUC moves a circle: use the same scale for both axes of the plane";
            self.core.warn("circle-not-round", 0, at, message, hint);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_third_turn_about_the_diagonal_leads_from_x_to_y() {
        let d = 3.0_f64.sqrt().recip();
        let y = about_vector([d, d, d], 120.0).vector([1.0, 0.0, 0.0]);
        assert!((y[1] - 1.0).abs() < 1e-15 && y[0].abs() < 1e-15 && y[2].abs() < 1e-15);
    }
}
