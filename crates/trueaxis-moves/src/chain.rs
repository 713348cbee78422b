//! Where the program frame lies: preset, then shifts, mirrors, turns, scales and the tilted plane, in the order of their
//! programming. The names are those of HEIDENHAIN.

use crate::{Frame, Position};

/// One transformation; what was programmed first lies outermost.
#[derive(Debug, Clone, PartialEq)]
pub enum Transformation {
    /// Cycle 7, TRANS DATUM.
    Shift(Position),
    /// Cycle 8, TRANS MIRROR: which axes.
    Mirror([bool; 3]),
    /// Cycle 10, TRANS ROTATION: a turn in the plane.
    Rotation(Frame),
    /// Cycles 11 and 26, TRANS SCALE: factors and the point that stays.
    Scale([f64; 3], [f64; 3]),
    /// PLANE, cycle 19.
    Tilt(Frame),
}

impl Transformation {
    fn frame(&self) -> Frame {
        let mut frame = Frame::IDENTITY;
        match self {
            Self::Shift(shift) => frame.shift = *shift,
            Self::Mirror(axes) => {
                for (i, mirrored) in axes.iter().enumerate() {
                    frame.linear[i][i] = if *mirrored { -1.0 } else { 1.0 };
                }
            }
            Self::Rotation(turn) | Self::Tilt(turn) => frame = *turn,
            Self::Scale(factors, fixed) => {
                for i in 0..3 {
                    frame.linear[i][i] = factors[i];
                    frame.shift.0[i] = fixed[i] * (1.0 - factors[i]);
                }
            }
        }
        frame
    }

    fn same_kind(&self, other: &Self) -> bool {
        std::mem::discriminant(self) == std::mem::discriminant(other)
    }
}

/// The transformations that are on.
///
/// The manual (TNC 620, working plane coordinate system): "the result of transformations built up
/// on each other depends on the programming sequence". So they are kept in the order in which they
/// were switched on; a new value of one that is on takes the place of the old value, but only
/// after the tilt if it was programmed after the tilt.
#[derive(Debug, Clone)]
pub struct TransformationChain {
    /// The present place in the program frame, mm and degrees.
    pub position: Position,
    /// The preset: where the workpiece is.
    pub preset: Frame,
    chain: Vec<Transformation>,
    /// The product, kept because every move asks for it.
    whole: Frame,
}

impl TransformationChain {
    /// With a preset, the machine at its zero.
    pub fn new(preset: Option<&Frame>) -> Self {
        let preset = preset.copied().unwrap_or(Frame::IDENTITY);
        let mut frames =
            Self { position: Position::default(), preset, chain: Vec::new(), whole: preset };
        // The machine stands at its zero.
        if let Some(position) = preset.inverse_place(&Position::default()) {
            frames.position = position;
        }
        frames
    }

    /// From the program frame to the basic frame.
    pub fn frame(&self) -> Frame {
        self.whole
    }

    /// The frame without the tilted plane: M130.
    pub fn untilted(&self) -> Frame {
        let flat = self.chain.iter().filter(|t| !matches!(t, Transformation::Tilt(_)));
        flat.fold(self.preset, |f, t| f.after(&t.frame()))
    }

    /// Whether a plane is tilted.
    pub fn is_tilted(&self) -> bool {
        self.chain.iter().any(|t| matches!(t, Transformation::Tilt(_)))
    }

    /// The turn of the tilted plane.
    pub fn tilt(&self) -> Frame {
        let tilt =
            |t: &Transformation| if let Transformation::Tilt(m) = t { Some(*m) } else { None };
        self.chain.iter().find_map(tilt).unwrap_or(Frame::IDENTITY)
    }

    /// The shift of cycle 7 that a new cycle 7 would change.
    pub fn shift(&self) -> Position {
        let shifts = self.chain[self.reach(true)..].iter();
        shifts.fold(Position::default(), |sum, t| match t {
            Transformation::Shift(shift) => sum.plus(shift),
            _ => sum,
        })
    }

    /// The turn of cycle 10 in the plane of the first two given axes, degrees.
    pub fn rotation_deg(&self, first: usize, second: usize) -> f64 {
        self.found(&Transformation::Rotation(Frame::IDENTITY))
            .and_then(
                |i| if let Transformation::Rotation(m) = self.chain[i] { Some(m) } else { None },
            )
            .map_or(0.0, |m| m.linear[second][first].atan2(m.linear[first][first]).to_degrees())
    }

    /// From where on transformations can be changed: those before the tilt belong to it.
    fn reach(&self, tied_to_tilt: bool) -> usize {
        let tilt = self.chain.iter().position(|t| matches!(t, Transformation::Tilt(_)));
        tilt.filter(|_| tied_to_tilt).unwrap_or(0)
    }

    fn found(&self, new: &Transformation) -> Option<usize> {
        let tied = matches!(new, Transformation::Shift(_) | Transformation::Mirror(_));
        (self.reach(tied)..self.chain.len()).find(|i| self.chain[*i].same_kind(new))
    }

    /// Switches a transformation on or changes it; `None` where the new frame would squeeze space
    /// flat. The axes stay where they are.
    pub fn set(&mut self, new: Transformation, neutral: bool) -> Option<()> {
        let mut chain = self.chain.clone();
        match self.found(&new) {
            Some(index) if neutral => {
                chain.remove(index);
            }
            Some(index) => chain[index] = new.clone(),
            None if neutral => {}
            None => chain.push(new.clone()),
        }
        // Of a kind that was on before and after a tilt, one remains when the tilt has ended.
        if let Some(index) = self.found(&new) {
            let kept = index + usize::from(!neutral);
            let mut place = 0;
            chain.retain(|t| {
                place += 1;
                place <= kept || !t.same_kind(&new)
            });
        }
        self.replace(chain)
    }

    /// Ends the tilted plane.
    pub fn untilt(&mut self) -> Option<()> {
        let mut chain = self.chain.clone();
        chain.retain(|t| !matches!(t, Transformation::Tilt(_)));
        self.replace(chain)
    }

    /// Ends every transformation of a kind.
    pub fn forget(&mut self, like: &Transformation) -> Option<()> {
        let mut chain = self.chain.clone();
        chain.retain(|t| !t.same_kind(like));
        self.replace(chain)
    }

    /// Another preset: it ends shifts, mirrors, turns and scales (cycle 247).
    pub fn set_preset(&mut self, preset: Frame) -> Option<()> {
        let before = std::mem::replace(&mut self.preset, preset);
        let tilt = self.chain.iter().filter(|t| matches!(t, Transformation::Tilt(_)));
        let done = self.replace(tilt.cloned().collect());
        if done.is_none() {
            self.preset = before;
        }
        done
    }

    fn replace(&mut self, chain: Vec<Transformation>) -> Option<()> {
        let whole = chain.iter().fold(self.preset, |f, t| f.after(&t.frame()));
        let place = self.whole.place(&self.position);
        let position = whole.inverse_place(&place)?;
        if !position.0.iter().all(|v| v.is_finite()) {
            return None;
        }
        (self.chain, self.whole, self.position) = (chain, whole, position);
        Some(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::turns::about;

    #[test]
    fn what_is_programmed_first_lies_outside() {
        let mut shift = Position::default();
        shift.0[0] = 10.0;
        let turn = Transformation::Rotation(about(2, 90.0));
        let mut frames = TransformationChain::new(None);
        frames.set(Transformation::Shift(shift), false).unwrap();
        frames.set(turn.clone(), false).unwrap();
        // Shift, then turn: (1, 0) lies at (10, 0) + (0, 1).
        let mut one = Position::default();
        one.0[0] = 1.0;
        assert_eq!(frames.frame().place(&one).0[..2], [10.0, 1.0]);
        let mut other = TransformationChain::new(None);
        other.set(turn, false).unwrap();
        other.set(Transformation::Shift(shift), false).unwrap();
        // Turn, then shift: (11, 0) turned is (0, 11).
        assert_eq!(other.frame().place(&one).0[..2], [0.0, 11.0]);
    }

    #[test]
    fn the_axes_stay_when_frames_change() {
        let mut frames = TransformationChain::new(None);
        frames.position.0[..3].copy_from_slice(&[3.0, 4.0, 5.0]);
        frames.set(Transformation::Tilt(about(0, 90.0)), false).unwrap();
        // Rx(90)·p = (3, 4, 5): p = (3, 5, -4).
        assert_eq!(frames.position.0[..3], [3.0, 5.0, -4.0]);
    }
}
