//! Directions of the tool axis and how it gets there.

use super::Run;
use super::tables::{Angles, Name, OrientationMode};
use super::words::Words;
use crate::execution::mistakes;
use crate::moves::turns::turns;
use crate::moves::{Axis, Cone, Event, OrientationPath};
use crate::text::program::Fault;

impl Run<'_> {
    /// The direction that a block programs, in the program frame; a cone is reported before it.
    pub(super) fn take_direction(&mut self, words: &mut Words) -> Result<Option<[f64; 3]>, Fault> {
        if words.vector_bits == 0 && !words.has(Name::ConeAngle) && !words.has(Name::ConeOpening) {
            return Ok(None);
        }
        let at = words.vector_place;
        for (number, subject) in
            [(4, "the surface normal A4 B4 C4"), (5, "the surface normal A5 B5 C5")]
        {
            if words.vector(number).is_some() {
                self.core.not_applied(subject, at, "write the tool direction as A3 B3 C3");
            }
        }
        let direction = match (words.vector(3), words.vector(2)) {
            (Some(vector), _) => Some(self.unit_vector(vector, at)?),
            (None, Some(angles)) => Some(self.by_angles(angles.map(|a| a.unwrap_or(0.0)))),
            _ => None,
        };
        if direction.is_some() && !self.core.modes.tool_centre {
            let message = "a tool direction without TRAORI".to_owned();
            let hint = "write TRAORI before it";
            self.core.warn("direction-without-traori", "", at, message, hint);
        }
        self.report_cone(direction.is_some(), words, at)?;
        Ok(direction)
    }

    fn unit_vector(&self, vector: [Option<f64>; 3], at: usize) -> Result<[f64; 3], Fault> {
        // What is not written is zero.
        let vector = vector.map(|v| v.unwrap_or(0.0));
        let length = vector.iter().fold(0.0_f64, |a, v| a.max(v.abs()));
        if !(1e-12..1e12).contains(&length) {
            return Err(mistakes::zero_direction(at));
        }
        Ok(vector)
    }

    /// The direction that angles mean.
    ///
    /// # Source
    /// Programming Manual "Job Planning", ORIEULER and ORIRPY: Z is turned by A2 about Z and B2 about
    /// X', or by C2 about Z, B2 about Y' and A2 about X''. The order of ORIRPY2 (A2 about X, B2 about
    /// Y', C2 about Z'') is taken from its name in the list of G codes; no figure was found.
    fn by_angles(&self, angles_deg: [f64; 3]) -> [f64; 3] {
        let [a, b, c] = angles_deg;
        let turned = match self.modes.angles {
            Angles::Euler => [(Axis::Z, a), (Axis::X, b), (Axis::Z, c)],
            Angles::Rpy => [(Axis::Z, c), (Axis::Y, b), (Axis::X, a)],
            Angles::RpyReversed => [(Axis::X, a), (Axis::Y, b), (Axis::Z, c)],
        };
        turns(turned).vector([0.0, 0.0, 1.0])
    }

    /// Tells the cone of a block in which the tool axis moves.
    ///
    /// # Source
    /// Programming Manual "Job Planning", ORICONCW and its relatives: A6 B6 C6 is the axis, NUT half
    /// the opening (not verified), A7 B7 C7 a direction on the way. The angle about the axis as PSI is the wish of
    /// this project; in the manual it is a polynomial.
    fn report_cone(&mut self, turns: bool, words: &mut Words, at: usize) -> Result<(), Fault> {
        let opening = words.take(Name::ConeOpening).map(|(v, ..)| v);
        let angle_deg = words.take(Name::ConeAngle).map(|(v, ..)| v);
        let axis = words.vector(6).map(|v| self.unit_vector(v, at)).transpose()?;
        let through = words.vector(7).map(|v| self.unit_vector(v, at)).transpose()?;
        let Some(way) = self.modes.cone else {
            if opening.is_some() || angle_deg.is_some() || axis.is_some() || through.is_some() {
                let message = "words of a cone without ORICONCW, ORICONCCW, ORICONIO or ORICONTO";
                let hint = "write the code before them";
                self.core.warn("unused-word", "cone", at, message, hint);
            }
            return Ok(());
        };
        let kept = std::mem::take(&mut self.modes.next_cone);
        let axis = axis.or(kept.axis);
        let through = through.or(kept.through);
        let opening = opening.or(kept.half_opening_deg);
        if opening.is_some_and(|o| o < 0.0) {
            self.core.not_applied(
                "a negative NUT",
                at,
                "choose the direction by ORICONCW or ORICONCCW",
            );
        }
        let ccw = match way {
            // The manual's example turns from (0,1,1) to (1,0,1) about (0,0,1) by 270 deg: its
            // clockwise is right-handed about the axis, seen along it.
            OrientationMode::ConeClockwise => Some(true),
            OrientationMode::ConeCounterClockwise => Some(false),
            _ => None,
        };
        let cone = Cone {
            axis,
            through,
            half_opening_deg: opening.map(f64::abs),
            angle_deg,
            ccw,
            tangential: way == OrientationMode::ConeTangential,
        };
        if turns || angle_deg.is_some() {
            self.core.emit(Event::Orientation(OrientationPath::Cone(cone)));
        } else {
            // The words of a block in which the tool axis stands are for the next in which it turns.
            self.modes.next_cone = cone;
        }
        Ok(())
    }
}
