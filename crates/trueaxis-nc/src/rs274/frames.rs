//! Where the program frame lies: work offsets, shift, tool length, frames of the program.

use std::collections::BTreeMap;

use crate::moves::turns::rotation_deg;
use crate::moves::{Axis, Frame, Position};

/// One work offset: origin and turn, as a rule about Z.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct WorkOffset {
    pub offset: Position,
    pub rotation_deg: f64,
    /// Set where the turn is more than one about Z; it then holds the whole of it.
    pub linear: Option<[[f64; 3]; 3]>,
}

impl WorkOffset {
    fn of(frame: &Frame) -> Self {
        let rotation_deg = rotation_deg(frame);
        let flat = Self { offset: frame.shift, rotation_deg, linear: None };
        let about_z = flat.frame().linear;
        let near = |(a, b): (&f64, &f64)| (a - b).abs() < 1e-9;
        let same = frame.linear.as_flattened().iter().zip(about_z.as_flattened()).all(near);
        Self { linear: (!same).then_some(frame.linear), ..flat }
    }

    /// As a frame.
    pub fn frame(&self) -> Frame {
        let (sin, cos) = self.rotation_deg.to_radians().sin_cos();
        let linear = match (self.linear, self.rotation_deg) {
            (Some(linear), _) => linear,
            (None, 0.0) => Frame::IDENTITY.linear,
            (None, _) => [[cos, -sin, 0.0], [sin, cos, 0.0], [0.0, 0.0, 1.0]],
        };
        Frame { linear, shift: self.offset }
    }
}

/// The code of a work offset by its index.
pub(super) fn offset_name(index: usize) -> String {
    match index {
        0..6 => format!("G{}", 54 + index),
        6..9 => format!("G59.{}", index - 5),
        _ => format!("G54.1 P{}", index - 8),
    }
}

/// Where the program frame lies in the machine.
///
/// ```text
/// machine = turn(program frames(position) + shift) + offset + external + tool
/// ```
///
/// The program frames are those that the program itself sets up: tilted plane, rotation, scale and
/// mirror; LinuxCNC has none.
#[derive(Debug, Clone)]
pub(super) struct Frames {
    /// The present place in the program frame, mm and degrees.
    pub position: Position,
    pub offsets: Vec<WorkOffset>,
    /// Index into `offsets`.
    pub active: usize,
    /// Added to every work offset: G10 L2 P0 of FANUC.
    pub external: Position,
    /// The shift by G92, and by G52 of LinuxCNC, whether it is on or not.
    pub shift: Position,
    /// G52 of FANUC and HAAS: on top of that of G92.
    pub local: Position,
    pub shift_on: bool,
    /// Tilted plane, rotation, scale and mirror, as one.
    pub program: Option<Frame>,
    /// The tool length that is on.
    pub tool: Position,
    /// The tool table.
    pub tools: BTreeMap<u32, Position>,
    /// What is added to the lengths along Z for wear: G10 L11 of FANUC.
    pub wear: BTreeMap<u32, f64>,
    /// Reference points 1 and 2, machine coordinates.
    pub references: [Position; 2],
}

impl Frames {
    pub fn new(tools: BTreeMap<u32, Position>, work: &BTreeMap<u32, Frame>) -> Self {
        let most = work.keys().copied().filter(|n| *n < 1000).max().map_or(0, |n| n as usize);
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
            external: Position::default(),
            shift: Position::default(),
            local: Position::default(),
            shift_on: false,
            program: None,
            tool: Position::default(),
            tools,
            wear: BTreeMap::new(),
            references: [Position::default(); 2],
        }
    }

    pub fn work(&self) -> WorkOffset {
        self.offsets[self.active]
    }

    pub fn live_shift(&self) -> Position {
        if self.shift_on { self.shift.plus(&self.local) } else { self.local }
    }

    /// The place of the program frame, without the tool.
    pub fn frame(&self) -> Frame {
        let outer = self.outer();
        match &self.program {
            Some(program) => outer.after(program),
            None => outer,
        }
    }

    /// Work offset and shift, without the frames of the program.
    pub fn outer(&self) -> Frame {
        let work = self.work();
        let frame = work.frame();
        let shift = match work.linear {
            Some(_) => frame.place(&self.live_shift()),
            None => self.live_shift().turned(work.rotation_deg).plus(&work.offset),
        };
        Frame { linear: frame.linear, shift: shift.plus(&self.external) }
    }

    /// Length in the table and wear.
    pub fn tool_length(&self, tool: u32) -> Position {
        let mut length = self.tools.get(&tool).copied().unwrap_or_default();
        length[Axis::Z] += self.wear.get(&tool).copied().unwrap_or_default();
        length
    }

    pub fn machine(&self) -> Position {
        self.machine_at(&self.position)
    }

    pub fn machine_at(&self, position: &Position) -> Position {
        let work = self.work();
        if self.program.is_some() || work.linear.is_some() {
            return self.frame().place(position).plus(&self.tool);
        }
        let turned = position.plus(&self.live_shift()).turned(work.rotation_deg);
        turned.plus(&work.offset).plus(&self.external).plus(&self.tool)
    }

    pub fn program_at(&self, machine: &Position) -> Position {
        let work = self.work();
        if self.program.is_some() || work.linear.is_some() {
            let place = self.frame().inverse_place(&machine.minus(&self.tool));
            // The frames of the program are never flat; a flat work offset keeps the place.
            return place.unwrap_or(self.position);
        }
        let from_origin = machine.minus(&self.tool).minus(&work.offset).minus(&self.external);
        from_origin.turned(-work.rotation_deg).minus(&self.live_shift())
    }

    /// Changes the frames; the machine stays where it is.
    pub fn change(&mut self, change: impl FnOnce(&mut Self)) {
        let machine = self.machine();
        change(self);
        self.position = self.program_at(&machine);
    }
}
