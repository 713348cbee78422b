//! PLANE and cycle 19: the tilted working plane.

use super::line::Cursor;
use super::variables::{StoredValue, Variable};
use super::words::{FeedWord, split_address};
use super::{Language, Run, fault};
use crate::moves::chain::Transformation;
use crate::moves::turns::{about, cross, dot, from_axes, minus, unit};
use crate::moves::{Axis, Branch, Event, Frame, MoveKind};
use crate::text::program::Fault;

/// The turn of space angles: R = Rz(SPC) · Ry(SPB) · Rx(SPA).
///
/// The manuals say it in two ways that are the same matrix: "rotations around the fixed machine
/// coordinate system, first around the A axis, then B, and then C" (iTNC 530, PLANE SPATIAL), where
/// each later turn about a fixed axis stands further left; and the sequence C-B-A about the axes
/// that turn along (TNC 620). A+90 C+180 puts the tool along +Y, so A−90 C0 of a table machine
/// reaches it; the opposite order would give −Y.
pub(super) fn spatial(a_deg: f64, b_deg: f64, c_deg: f64) -> Frame {
    about(2, c_deg).after(&about(1, b_deg).after(&about(0, a_deg)))
}

/// Euler angles about the axes that turn along: Rz(precession) · Rx(nutation) · Rz(rotation).
fn euler(precession_deg: f64, nutation_deg: f64, rotation_deg: f64) -> Frame {
    about(2, precession_deg).after(&about(0, nutation_deg).after(&about(2, rotation_deg)))
}

/// The frame with Z along `normal` and X in the plane of `base` and Z.
fn from_vectors(base: [f64; 3], normal: [f64; 3]) -> Option<Frame> {
    let z = unit(normal)?;
    let base = unit(base)?;
    let along = dot(base, z);
    let across: [f64; 3] = std::array::from_fn(|i| base[i] - along * z[i]);
    if across.iter().all(|v| v.abs() < 1e-9) {
        return None;
    }
    let x = unit(across)?;
    Some(from_axes([x, cross(z, x), z], [0.0; 3]))
}

/// What the rotary axes do once the plane is tilted.
#[derive(Debug, Clone, Copy, Default)]
struct Behaviour {
    /// MOVE (the tip stays) or TURN; `None` is STAY.
    keep_tip: Option<bool>,
    /// MB: how far the tool goes back along its axis before the axes turn.
    retract_mm: Option<f64>,
    branch: Branch,
}

impl Run<'_> {
    pub(super) fn plane(&mut self, c: &mut Cursor<'_>) -> Result<(), Fault> {
        const KINDS: [&str; 9] = [
            "SPATIAL",
            "VECTOR",
            "EULER",
            "POINTS",
            "RELATIVE",
            "RELATIV",
            "RESET",
            "PROJECTED",
            "AXIAL",
        ];
        let at = c.start;
        let Some(kind) = c.accept_any(&KINDS) else { return Err(c.unknown()) };
        let turn = match kind {
            0 => {
                let [a, b, s] = self.named_values(c, ["SPA", "SPB", "SPC"])?;
                Some(spatial(a, b, s))
            }
            1 => {
                let base = self.named_values(c, ["BX", "BY", "BZ"])?;
                let normal = self.named_values(c, ["NX", "NY", "NZ"])?;
                Some(from_vectors(base, normal).ok_or_else(|| no_plane(at))?)
            }
            2 => {
                let [p, n, r] = self.named_values(c, ["EULPR", "EULNU", "EULROT"])?;
                Some(euler(p, n, r))
            }
            3 => Some(self.points(c, at)?),
            4 | 5 => {
                let [a, b, s] = self.named_values(c, ["SPA", "SPB", "SPC"])?;
                Some(self.frames.tilt().after(&spatial(a, b, s)))
            }
            6 => None,
            7 => Some(self.projected(c, at)?),
            _ => return self.axial(c, at),
        };
        let behaviour = self.behaviour(c)?;
        c.finish()?;
        self.tilt(turn, behaviour, at)
    }

    /// Words with numbers in any order; what is not given is zero.
    fn named_values(&mut self, c: &mut Cursor<'_>, names: [&str; 3]) -> Result<[f64; 3], Fault> {
        let mut values = [0.0; 3];
        loop {
            let letters = c.letters();
            let found = names.iter().position(|name| {
                let count = name.len();
                letters.len() >= count
                    && letters[..count].eq_ignore_ascii_case(name.as_bytes())
                    && matches!(&letters[count..], b"" | b"Q" | b"QL" | b"QR")
            });
            let Some(index) = found else { return Ok(values) };
            c.take_letters(names[index].len());
            values[index] = self.value(c)?;
        }
    }

    /// PROPR and PROMIN: the angles of the traces of the plane in Z/X and in Y/Z, positive as SPB and SPA are;
    /// X lies in Z/X. PROROT turns the plane about its own Z.
    ///
    /// # Source
    /// User's manual iTNC 530 and TNC 640, PLANE PROJECTED: the two angles, from the principal axis X and from
    /// the minor axis Y. The traces are ex turned by PROPR about Y, and ey turned by PROMIN about X.
    fn projected(&mut self, c: &mut Cursor<'_>, at: usize) -> Result<Frame, Fault> {
        let mut values = self.named_values(c, ["PROPR", "PROMIN", "PROROT"])?;
        if c.accept("ROT") {
            values[2] = self.value(c)?;
        }
        let [principal, minor, turn] = values;
        if principal.abs() >= 90.0 || minor.abs() >= 90.0 {
            return Err(no_plane(at));
        }
        let x = about(1, principal).vector([1.0, 0.0, 0.0]);
        let y = about(0, minor).vector([0.0, 1.0, 0.0]);
        let plane = from_vectors(x, cross(x, y)).ok_or_else(|| no_plane(at))?;
        Ok(plane.after(&about(2, turn)))
    }

    /// PLANE AXIAL A B C: the plane on which the tool stands square at these angles of the rotary axes, turned
    /// as the tool is; an axis that is not named keeps its angle.
    fn axial(&mut self, c: &mut Cursor<'_>, at: usize) -> Result<(), Fault> {
        let now = self.machine_place();
        let mut angles = [Axis::A, Axis::B, Axis::C].map(|axis| now[axis]);
        while let Some(index) = c.accept_any(&["A", "B", "C", "IA", "IB", "IC"]) {
            let value = self.value(c)?;
            angles[index % 3] = if index < 3 { value } else { angles[index % 3] + value };
        }
        let behaviour = self.behaviour(c)?;
        c.finish()?;
        let Some(linear) = self.core.library.tool_turn(angles) else {
            let message = "PLANE AXIAL needs the kinematics of the machine";
            let hint = "state the machine, or write PLANE SPATIAL or PLANE VECTOR";
            return Err(fault("not-interpreted", at, message, hint));
        };
        if self.frames.untilted().linear != Frame::IDENTITY.linear {
            let message = "PLANE AXIAL after a rotation, mirror or scale is not interpreted";
            let hint = "write PLANE SPATIAL or PLANE VECTOR";
            return Err(fault("not-interpreted", at, message, hint));
        }
        // The angles are those of the block, not the ones that SEQ would choose.
        let direction = linear.map(|row| row[2]);
        let fits = |branch: &Branch| {
            let found = self.core.library.rotary_angles(direction, *branch, &now);
            found.is_some_and(|f| f.iter().zip(&angles).all(|(f, a)| (f - a).abs() < 1e-6))
        };
        let found = [Branch::Nearest, Branch::Positive, Branch::Negative].into_iter().find(fits);
        if found.is_none() && behaviour.keep_tip.is_some() {
            self.core.left_out("the choice of the angles in PLANE AXIAL", at);
        }
        let branch = found.unwrap_or_default();
        let turn = Frame { linear, ..Frame::IDENTITY };
        self.tilt(Some(turn), Behaviour { branch, ..behaviour }, at)
    }

    /// P1 and P2 give the direction of X, P3 lies on the side of positive Y.
    fn points(&mut self, c: &mut Cursor<'_>, at: usize) -> Result<Frame, Fault> {
        let mut points = [[0.0; 3]; 3];
        while c.accept("P") {
            let number = c.whole()?.unwrap_or(0) as usize;
            let axis = c.accept_any(&["X", "Y", "Z"]);
            let Some((axis, point)) = axis.zip(points.get_mut(number.wrapping_sub(1))) else {
                return Err(c.unknown());
            };
            point[axis] = self.value(c)?;
        }
        let along = minus(points[1], points[0]);
        let across = minus(points[2], points[0]);
        from_vectors(along, cross(along, across)).ok_or_else(|| no_plane(at))
    }

    /// MOVE, TURN or STAY and what stands with them.
    fn behaviour(&mut self, c: &mut Cursor<'_>) -> Result<Behaviour, Fault> {
        let mut behaviour = Behaviour::default();
        while !c.done() {
            let at = c.offset();
            if let Some(index) = c.accept_any(&["MOVE", "TURN", "STAY"]) {
                behaviour.keep_tip = [Some(true), Some(false), None][index];
            } else if c.accept_any(&["SEQ", "SYM"]).is_some() {
                behaviour.branch = match c.symbol() {
                    Some(b'+') => Branch::Positive,
                    Some(b'-') => Branch::Negative,
                    _ => return Err(c.unknown()),
                };
                c.accept_symbol(b'+');
                c.accept_symbol(b'-');
            } else if c.accept_any(&["TABLE", "COORD"]).is_some() {
                if !c.accept("ROT") {
                    return Err(c.unknown());
                }
                self.core.emit(Event::Note("choice of TABLE ROT or COORD ROT"));
            } else if c.accept_any(&["DIST", "ABST"]).is_some() {
                if self.value(c)? != 0.0 {
                    self.core.left_out("DIST of PLANE", at);
                }
            } else if c.accept("MB") {
                let length = if c.accept("MAX") { f64::INFINITY } else { self.value(c)? };
                behaviour.retract_mm = Some(length * self.core.modes.unit_mm());
            } else if c.accept_any(&["FMAX", "FAUTO"]).is_none() {
                match split_address(c) {
                    Some("F") => {
                        let _: FeedWord = self.feed_word(c, Some("F"))?;
                    }
                    _ => return Err(c.unknown()),
                }
            }
        }
        Ok(behaviour)
    }

    /// Tilts the plane (`None` ends it), tells it, and lets the rotary axes follow.
    fn tilt(&mut self, turn: Option<Frame>, behaviour: Behaviour, at: usize) -> Result<(), Fault> {
        if let Some(length_mm) = behaviour.retract_mm.filter(|_| behaviour.keep_tip.is_some()) {
            self.retract(Some(length_mm), None, at)?;
        }
        let set = match turn {
            Some(turn) => self.frames.set(Transformation::Tilt(turn), false),
            None => self.frames.untilt(),
        };
        set.ok_or_else(|| no_plane(at))?;
        self.tangent = None;
        self.core.emit(Event::TiltedPlane(turn.is_some()));
        self.emit_frame();
        self.settle();
        let frame = self.frames.frame();
        let axis = frame.vector([0.0, 0.0, 1.0]);
        let now = frame.place(&self.frames.position);
        let angles = match unit(axis) {
            Some(axis) => self.core.library.rotary_angles(axis, behaviour.branch, &now),
            None => None,
        };
        let angles = if turn.is_none() { angles.or(Some([0.0; 3])) } else { angles };
        for i in 0..3 {
            let variable = Variable::Global(120 + i as u32);
            match angles {
                Some(angles) => self.variables.store(variable, StoredValue::Number(angles[i])),
                None => self.undefine(variable),
            }
        }
        let Some(keep_tip) = behaviour.keep_tip else { return Ok(()) };
        let kind = MoveKind::Align { keep_tip, branch: behaviour.branch };
        self.step(kind, self.frames.position, at)?;
        if let Some(angles) = angles {
            for (i, axis) in [Axis::A, Axis::B, Axis::C].into_iter().enumerate() {
                self.turned[i] = 0.0;
                self.frames.position[axis] = angles[i] - frame.shift[axis];
            }
        }
        Ok(())
    }

    /// CYCL DEF 19.1 A B C; without angles the plane is no longer tilted. No axis moves.
    pub(super) fn cycle_19(&mut self, c: &mut Cursor<'_>) -> Result<(), Fault> {
        let at = c.start;
        if c.done() {
            return self.tilt(None, Behaviour::default(), at);
        }
        let [a, b, s] = self.named_values(c, ["A", "B", "C"])?;
        self.behaviour(c)?;
        self.tilt(Some(spatial(a, b, s)), Behaviour::default(), at)
    }
}

fn no_plane(at: usize) -> Fault {
    let message = "the vectors or points do not define a plane";
    fault("zero-direction", at, message, "they must not be zero or lie on one line")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn space_angles_turn_about_fixed_axes_in_the_order_a_b_c() {
        // Z turned by A+90 about X is -Y; by C+180 about the fixed Z it is +Y.
        let m = spatial(90.0, 0.0, 180.0).linear;
        assert_eq!([m[0][2], m[1][2], m[2][2]], [0.0, 1.0, 0.0]);
        // X keeps to A, and C turns it over.
        assert_eq!([m[0][0], m[1][0], m[2][0]], [-1.0, 0.0, 0.0]);
    }

    #[test]
    fn euler_angles_turn_about_axes_that_turn_along() {
        // Precession 90 puts X along Y; nutation 90 about it puts Z along X.
        let m = euler(90.0, 90.0, 0.0).linear;
        assert_eq!([m[0][2], m[1][2], m[2][2]], [1.0, 0.0, 0.0]);
    }

    #[test]
    fn projection_angles_are_traces_of_the_plane() {
        // With PROPR alone the plane is that of SPB, with PROMIN alone that of SPA.
        let of = |text: &str| {
            let source = format!("PLANE PROJECTED {text} STAY\nL X+1 Y+2 Z+3 FMAX\n");
            let program = crate::Program::new("p", source.into_bytes(), crate::Control::Heidenhain);
            let mut frame = Frame::IDENTITY;
            let settings = crate::Settings::default();
            let outcome = crate::interpret(&program, &crate::NoLibrary, &settings, &mut |s| {
                if let crate::Step::Event(Event::Frame(f), _) = s {
                    frame = f;
                }
            });
            assert!(!outcome.problems.has_errors());
            frame.linear
        };
        let near = |a: [[f64; 3]; 3], b: [[f64; 3]; 3]| {
            a.iter().flatten().zip(b.iter().flatten()).all(|(a, b)| (a - b).abs() < 1e-12)
        };
        assert!(near(of("PROPR+24 PROMIN+0 PROROT+0"), spatial(0.0, 24.0, 0.0).linear));
        assert!(near(of("PROPR+0 PROMIN-24 ROT+0"), spatial(-24.0, 0.0, 0.0).linear));
        // The normal is square to both traces: (tan PROPR, -tan PROMIN, 1), of any length.
        let both = of("PROPR+24 PROMIN+15 PROROT+30");
        let (p, m) = (24.0_f64.to_radians().tan(), 15.0_f64.to_radians().tan());
        let length = (1.0 + p * p + m * m).sqrt();
        let normal = [p / length, -m / length, 1.0 / length];
        assert!((0..3).all(|i| (both[i][2] - normal[i]).abs() < 1e-12));
    }

    #[test]
    fn a_base_vector_is_made_square_to_the_normal() {
        let m = from_vectors([1.0, 0.0, 5.0], [0.0, 0.0, 2.0]).unwrap();
        assert_eq!(m.linear, Frame::IDENTITY.linear);
        assert!(from_vectors([0.0, 0.0, 1.0], [0.0, 0.0, 2.0]).is_none());
    }
}
