//! Places in machine coordinates: G53.

use super::{Run, fault};
use crate::moves::{Axis, AxisSet, Coordinates, Event, Move, MoveKind, Position};
use crate::rs274::code::Motion;
use crate::text::program::Fault;

impl Run<'_> {
    /// How a block with G53 moves: on FANUC always with rapid.
    ///
    /// # Source
    /// FANUC: "Fanuc G52 Local Coordinate System vs G53 Machine Coordinate System" (cncmakers.com): rapid is selected and
    /// used for G53. LinuxCNC, `interp_check.cc`: NCE_CANNOT_USE_G53_INCREMENTAL. G53 after G91: Mitsubishi
    /// Electric, M700V programming manual, 14.4, is incremental; a FANUC manual that says what it does could not be
    /// read, and posts write G53 for an absolute place.
    pub(super) fn machine_motion(&mut self, motion: Motion, at: usize) -> Result<Motion, Fault> {
        if self.core.modes.incremental {
            let (code, hint) = ("incremental-machine-place", "write G90 before G53");
            if !self.is_fanuc() {
                let message = "G53 while G91 is on: the control refuses it";
                return Err(fault(code, at, message, hint));
            }
            let message =
                "G53 while G91 is on: its words are read as places of the machine; controls \
                 differ: some move by them, some ignore the block"
                    .to_owned();
            self.core.warn(code, 0, at, message, hint);
        }
        use Motion::{ArcClockwise, ArcCounterClockwise, Linear};
        let feeds = matches!(motion, Linear | ArcClockwise | ArcCounterClockwise);
        if !feeds || !self.is_fanuc() || self.is_haas() {
            return Ok(motion);
        }
        self.core.emit(Event::Note("G53 moves with rapid"));
        Ok(Motion::Rapid)
    }

    /// A rapid of the named axes in machine coordinates, whatever the frames are. Where that is in
    /// the program frame only the machine knows; here it is as if all rotary axes stood at zero.
    pub(super) fn machine_move(&mut self, machine: Position, named: AxisSet) {
        self.modes.length_due = Position::default();
        let (feed, origin) = (self.core.modes.feed, self.core.origin);
        let coordinates = Coordinates::Machine;
        let rapid = Move::plain(MoveKind::Rapid, machine, named, feed, origin);
        self.emit_move(Move { coordinates, ..rapid });
        self.frames.position = self.frames.program_at(&machine);
    }

    /// The program coordinates of a place given in machine coordinates.
    pub(super) fn machine_target(&mut self) -> Position {
        self.modes.length_due = Position::default();
        let mut machine = self.frames.machine();
        let mut named = [false; 9];
        for axis in Axis::ALL {
            if let Some(value) = self.axis_word(axis) {
                machine[axis] = value;
                named[axis as usize] = true;
            }
        }
        let target = self.frames.program_at(&machine);
        let turned = self.frames.work().rotation_deg != 0.0 && (named[0] || named[1]);
        let spatial = self.frames.program.is_some() || self.frames.work().linear.is_some();
        let old = self.frames.position;
        Position(std::array::from_fn(|i| {
            let mixed = turned && i < 2 || spatial && i < 3;
            if named[i] || mixed { target.0[i] } else { old.0[i] }
        }))
    }
}
