//! Where the program frame lies: settable offset, swivelled plane, programmable frame.

use std::collections::BTreeMap;

use super::transform;
use crate::execution::Settings;
use crate::moves::{Axis, Frame, Plane, Position};

/// The chain of frames and the place of the tool.
///
/// ```text
/// machine = settable · swivel · programmable (position) + tool length
/// ```
///
/// # Source
/// Function Manual "Axes, coordinate systems, frames (K2)", frame chain. Frames that only the
/// machine knows (base frames, preset, handwheel) are identities here.
#[derive(Debug, Clone)]
pub(super) struct Chain {
    /// The present place in the program frame, mm and degrees.
    pub position: Position,
    /// $P_UIFR by number; 0 is G500.
    pub offsets: BTreeMap<u32, Frame>,
    /// The number of the active one.
    pub active: u32,
    /// $P_IFRAME.
    pub settable: Frame,
    /// What CYCLE800 made.
    pub swivel: Frame,
    /// $P_PFRAME.
    pub programmable: Frame,
    /// The part of its shift that G59 set.
    pub fine: Position,
    /// Lengths of the tools: length 1 as Z, 2 as Y, 3 as X.
    pub tools: BTreeMap<u32, Position>,
    /// The tool length that is on, along the axes.
    pub tool: Position,
}

impl Chain {
    pub fn new(settings: &Settings) -> Self {
        Self {
            position: Position::default(),
            offsets: settings.work_offsets.clone(),
            active: 0,
            settable: settings.work_offsets.get(&0).copied().unwrap_or(Frame::IDENTITY),
            swivel: Frame::IDENTITY,
            programmable: Frame::IDENTITY,
            fine: Position::default(),
            tools: settings.tools.clone(),
            tool: Position::default(),
        }
    }

    pub fn frame(&self) -> Frame {
        self.settable.after(&self.swivel).after(&self.programmable)
    }

    pub fn machine(&self) -> Position {
        self.frame().place(&self.position).plus(&self.tool)
    }

    /// The place in the program frame; `None` if a frame is flat.
    pub fn program_at(&self, machine: &Position) -> Option<Position> {
        self.frame().inverse_place(&machine.minus(&self.tool))
    }

    /// Changes the frames; the machine stays where it is. `false` if the new frame is flat or
    /// leaves the range of numbers: then all is as before.
    pub fn change(&mut self, change: impl FnOnce(&mut Self)) -> bool {
        let before = self.clone_state();
        let machine = self.machine();
        change(self);
        let frame = self.frame();
        let entries = frame.linear.iter().flatten().chain(&frame.shift.0);
        let sane = entries.into_iter().all(|v| v.abs() < 1e15);
        match self.program_at(&machine) {
            Some(position) if sane && position.0.iter().all(|v| v.abs() < 1e15) => {
                self.position = position;
                true
            }
            _ => {
                (self.settable, self.swivel, self.programmable, self.tool) = before;
                false
            }
        }
    }

    fn clone_state(&self) -> (Frame, Frame, Frame, Position) {
        (self.settable, self.swivel, self.programmable, self.tool)
    }

    /// The length of a tool along the axes of a plane.
    ///
    /// # Source
    /// Function Manual "Tool offset (W1)": lengths 1, 2, 3 of a milling tool lie along Z Y X in G17,
    /// Y X Z in G18 and X Z Y in G19.
    pub fn tool_length(&self, tool: u32, plane: Plane) -> Position {
        let stored = self.tools.get(&tool).copied().unwrap_or_default();
        let lengths = [stored[Axis::Z], stored[Axis::Y], stored[Axis::X]];
        let axes = match plane {
            Plane::Xy => [Axis::Z, Axis::Y, Axis::X],
            Plane::Zx => [Axis::Y, Axis::X, Axis::Z],
            Plane::Yz => [Axis::X, Axis::Z, Axis::Y],
        };
        let mut out = stored;
        for (axis, length) in axes.into_iter().zip(lengths) {
            out[axis] = length;
        }
        out
    }

    pub fn offset(&self, number: u32) -> Frame {
        self.offsets.get(&number).copied().unwrap_or(Frame::IDENTITY)
    }
}

/// One entry of a frame: `[X,TR]`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Part {
    Shift,
    Fine,
    Turn,
    Scale,
    Mirror,
}

impl Part {
    pub fn of(word: &str) -> Option<Self> {
        Some(match word {
            "TR" => Self::Shift,
            "FI" => Self::Fine,
            "RT" => Self::Turn,
            "SC" => Self::Scale,
            "MI" => Self::Mirror,
            _ => return None,
        })
    }

    pub fn read(self, frame: &Frame, axis: Axis) -> f64 {
        let index = axis as usize;
        match self {
            Self::Shift => frame.shift[axis],
            Self::Turn if index < 3 => transform::rpy_of(frame)[index],
            Self::Scale => 1.0,
            _ => 0.0,
        }
    }

    /// `false` if this part cannot be set in a frame that is kept as a whole.
    pub fn write(self, frame: &mut Frame, axis: Axis, value: f64) -> bool {
        let index = axis as usize;
        match self {
            Self::Shift => frame.shift[axis] = value,
            // The fine shift is not kept apart: it starts at 0.
            Self::Fine => frame.shift[axis] += value,
            Self::Turn if index < 3 => {
                let mut angles = transform::rpy_of(frame);
                angles[index] = value;
                frame.linear = transform::rpy(angles).linear;
            }
            Self::Scale if value == 1.0 => {}
            Self::Mirror if value == 0.0 => {}
            _ => return false,
        }
        true
    }
}
