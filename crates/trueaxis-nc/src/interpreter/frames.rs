use std::collections::BTreeMap;

use crate::moves::Position;

/// One work offset: origin and turn about Z.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct WorkOffset {
    pub offset: Position,
    pub rotation_deg: f64,
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
    pub fn new(tools: BTreeMap<u32, Position>) -> Self {
        Self {
            position: Position::default(),
            offsets: vec![WorkOffset::default(); 9],
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
