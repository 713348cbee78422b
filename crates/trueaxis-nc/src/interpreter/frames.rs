use std::collections::BTreeMap;

use crate::moves::{Frame, Position};

/// One work offset: origin and turn about Z.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct WorkOffset {
    pub offset: Position,
    pub rotation_deg: f64,
}

impl WorkOffset {
    /// These controls turn work offsets about Z only; other turns are left out.
    fn of(frame: &Frame) -> Self {
        let rotation_deg = frame.linear[1][0].atan2(frame.linear[0][0]).to_degrees();
        Self { offset: frame.shift, rotation_deg }
    }
}

/// Where the program frame lies in the machine.
///
/// ```text
/// machine = turn(position + shift) + offset + tool
/// ```
#[derive(Debug, Clone)]
pub(super) struct Frames {
    /// The present place in the program frame, mm and degrees.
    pub position: Position,
    pub offsets: Vec<WorkOffset>,
    /// Index into `offsets`.
    pub active: usize,
    /// The shift by G92 or G52, whether it is on or not.
    pub shift: Position,
    pub shift_on: bool,
    /// The tool length that is on.
    pub tool: Position,
    /// The tool table.
    pub tools: BTreeMap<u32, Position>,
    /// Reference points 1 and 2, machine coordinates.
    pub references: [Position; 2],
}

impl Frames {
    pub fn new(tools: BTreeMap<u32, Position>, work: &BTreeMap<u32, Frame>) -> Self {
        let most = work.keys().max().map_or(0, |n| *n as usize);
        let mut offsets = vec![WorkOffset::default(); most.max(9)];
        for (number, frame) in work {
            if let Some(entry) = offsets.get_mut((*number as usize).wrapping_sub(1)) {
                *entry = WorkOffset::of(frame);
            }
        }
        Self {
            position: Position::default(),
            offsets,
            active: 0,
            shift: Position::default(),
            shift_on: false,
            tool: Position::default(),
            tools,
            references: [Position::default(); 2],
        }
    }

    pub fn work(&self) -> WorkOffset {
        self.offsets[self.active]
    }

    pub fn live_shift(&self) -> Position {
        if self.shift_on { self.shift } else { Position::default() }
    }

    /// The place of the program frame, without the tool.
    pub fn frame(&self) -> Frame {
        let work = self.work();
        let (sin, cos) = work.rotation_deg.to_radians().sin_cos();
        let linear = match work.rotation_deg {
            0.0 => Frame::IDENTITY.linear,
            _ => [[cos, -sin, 0.0], [sin, cos, 0.0], [0.0, 0.0, 1.0]],
        };
        let shift = self.live_shift().turned(work.rotation_deg).plus(&work.offset);
        Frame { linear, shift }
    }

    pub fn tool_length(&self, tool: u32) -> Position {
        self.tools.get(&tool).copied().unwrap_or_default()
    }

    pub fn machine(&self) -> Position {
        self.machine_at(&self.position)
    }

    pub fn machine_at(&self, position: &Position) -> Position {
        let work = self.work();
        let turned = position.plus(&self.live_shift()).turned(work.rotation_deg);
        turned.plus(&work.offset).plus(&self.tool)
    }

    pub fn program_at(&self, machine: &Position) -> Position {
        let work = self.work();
        let from_origin = machine.minus(&self.tool).minus(&work.offset);
        from_origin.turned(-work.rotation_deg).minus(&self.live_shift())
    }

    /// Changes the frames; the machine stays where it is.
    pub fn change(&mut self, change: impl FnOnce(&mut Self)) {
        let machine = self.machine();
        change(self);
        self.position = self.program_at(&machine);
    }
}
