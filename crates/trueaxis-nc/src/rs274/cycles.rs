use super::{Run, fault};
use crate::execution::mistakes;
use crate::moves::{Event, MoveKind, Position, Turning};
use crate::rs274::code::Cycle;
use crate::text::program::Fault;

/// Pecks and holes of one block: more than any program means.
const MOST_PECKS: f64 = 1e6;

/// What drilling cycles keep from block to block.
#[derive(Debug, Clone, Default)]
pub(super) struct CycleMemory {
    r_mm: Option<f64>,
    bottom_mm: Option<f64>,
    peck_mm: Option<f64>,
    dwell_s: f64,
    /// Where the drill stood when the cycles began.
    initial_mm: Option<f64>,
}

impl CycleMemory {
    pub fn forget(&mut self) {
        *self = Self::default();
    }
}

/// One hole along the axis that stands on the plane.
struct Hole {
    axis: usize,
    r: f64,
    bottom: f64,
    clear: f64,
    peck: f64,
    dwell_s: f64,
}

impl Run<'_> {
    /// A drilling cycle at the place of the axis words, once or L (K on FANUC) times.
    pub(super) fn cycle(&mut self, cycle: Cycle, at: usize) -> Result<(), Fault> {
        for letter in *b"ABC" {
            if self.words.look(letter).is_some() {
                let message = "rotary axes do not move in a drilling cycle";
                return Err(fault("rotary-in-cycle", at, message, "turn them in a block before"));
            }
        }
        self.core.modes.check_feed(at)?;
        let hole = self.hole(cycle, at)?;
        self.check_depth(hole.axis, at);
        let repeats = self.words.take(b'L').or_else(|| {
            let fanuc = self.is_fanuc();
            if fanuc { self.words.take(b'K') } else { None }
        });
        let repeats = repeats.unwrap_or(1.0);
        if !(0.0..1e5).contains(&repeats) {
            let message = format!("{repeats} is not a number of holes");
            return Err(fault("bad-repeats", at, message, "write L2"));
        }
        let pecks = if hole.peck > 0.0 { (hole.r - hole.bottom) / hole.peck } else { 1.0 };
        if pecks.max(1.0) * repeats > MOST_PECKS {
            let message = format!("the block drills more than {MOST_PECKS} times");
            return Err(fault("too-many-pecks", at, message, "check Q and L"));
        }
        let polar = self.modes.transforms.polar.is_some();
        let axes = self.core.modes.plane.axes();
        let steps = if polar { [None; 2] } else { [axes[0], axes[1]].map(|a| self.axis_word(a)) };
        if self.frames.position.0[hole.axis] < hole.r && cycle != Cycle::BackBore {
            let mut up = self.frames.position;
            up.0[hole.axis] = hole.r;
            self.step(MoveKind::Rapid, up);
        }
        for _ in 0..repeats as u32 {
            let mut over = self.frames.position;
            for (axis, step) in axes.iter().zip(steps) {
                let base = if self.core.modes.incremental { over[*axis] } else { 0.0 };
                over[*axis] = step.map_or(over[*axis], |s| base + s);
            }
            if let Some(place) = self.polar_place() {
                (over[axes[0]], over[axes[1]]) = (place[0], place[1]);
            }
            self.step(MoveKind::Rapid, over);
            if cycle == Cycle::BackBore {
                self.bore_back(&hole, over);
                continue;
            }
            if over.0[hole.axis] != hole.r {
                over.0[hole.axis] = hole.r;
                self.step(MoveKind::Rapid, over);
            }
            self.drill(cycle, &hole, over);
        }
        Ok(())
    }

    fn hole(&mut self, cycle: Cycle, at: usize) -> Result<Hole, Fault> {
        let axis = self.core.modes.plane.axes()[2];
        let now = self.frames.position[axis];
        if self.modes.cycle.initial_mm.is_none() {
            self.modes.cycle.initial_mm = Some(now);
        }
        let incremental = self.core.modes.incremental;
        let fanuc = self.is_fanuc();
        // FANUC counts R from where the cycles began, LinuxCNC from where the drill is.
        let base = self.modes.cycle.initial_mm.filter(|_| fanuc).unwrap_or(now);
        let r_word = self.length(b'R').map(|r| if incremental { r + base } else { r });
        let r = r_word.or(self.modes.cycle.r_mm);
        let Some(r) = r else {
            let message = "the cycle has no R";
            return Err(fault("cycle-without-r", at, message, "write R, the plane of retraction"));
        };
        let depth = self.axis_word(axis).map(|z| if incremental { z + r } else { z });
        let Some(bottom) = depth.or(self.modes.cycle.bottom_mm) else {
            return Err(mistakes::missing_depth(at));
        };
        if (r < bottom) != (cycle == Cycle::BackBore) {
            let message = "the plane of retraction R lies below the bottom of the hole";
            return Err(fault("cycle-r-below-bottom", at, message, "check R and the depth"));
        }
        let peck = self.length(b'Q').or(self.modes.cycle.peck_mm);
        let pecks = matches!(cycle, Cycle::Peck | Cycle::ChipBreaking);
        if pecks && !peck.is_some_and(|q| q > 0.0) {
            let message = "the cycle needs Q, the depth of each peck, above 0";
            return Err(fault("cycle-without-q", at, message, "write Q2"));
        }
        // FANUC counts P in milliseconds.
        let second = if fanuc { 1000.0 } else { 1.0 };
        let dwell_s = self.words.take(b'P').map_or(self.modes.cycle.dwell_s, |p| p / second);
        let memory = &mut self.modes.cycle;
        memory.r_mm = Some(r);
        memory.bottom_mm = Some(bottom);
        (memory.peck_mm, memory.dwell_s) = (peck, dwell_s);
        let initial = memory.initial_mm.unwrap_or(now);
        let top = if fanuc { initial } else { now };
        let clear = if self.modes.retract_to_r { r } else { r.max(top) };
        Ok(Hole { axis: axis as usize, r, bottom, clear, peck: peck.unwrap_or(0.0), dwell_s })
    }

    fn along(&mut self, kind: MoveKind, place: Position, hole: &Hole, depth: f64) {
        let mut target = place;
        target.0[hole.axis] = depth;
        self.step(kind, target);
    }

    fn drill(&mut self, cycle: Cycle, hole: &Hole, place: Position) {
        match cycle {
            Cycle::Peck | Cycle::ChipBreaking => self.peck(cycle, hole, place),
            _ => self.along(MoveKind::Linear, place, hole, hole.bottom),
        }
        let turning = self.core.modes.turning;
        match cycle {
            Cycle::TapLeft | Cycle::TapRight => {
                let back = match turning {
                    Turning::Clockwise => Turning::CounterClockwise,
                    Turning::CounterClockwise => Turning::Clockwise,
                    Turning::Stopped => Turning::Stopped,
                };
                self.core.emit(Event::Spindle(Turning::Stopped));
                self.core.emit(Event::Spindle(back));
                self.wait(hole);
                self.along(MoveKind::Linear, place, hole, hole.clear);
                self.core.emit(Event::Spindle(Turning::Stopped));
                self.core.emit(Event::Spindle(turning));
            }
            Cycle::Bore | Cycle::BoreDwell => {
                if cycle == Cycle::BoreDwell {
                    self.wait(hole);
                }
                self.along(MoveKind::Linear, place, hole, hole.r);
                if hole.clear != hole.r {
                    self.along(MoveKind::Rapid, place, hole, hole.clear);
                }
            }
            Cycle::BoreManual => {
                self.wait(hole);
                self.core.emit(Event::Spindle(Turning::Stopped));
                self.core.emit(Event::Stop { optional: false });
                self.along(MoveKind::Rapid, place, hole, hole.clear);
                self.core.emit(Event::Spindle(turning));
            }
            Cycle::BoreStop | Cycle::FineBore => {
                self.wait(hole);
                self.core.emit(Event::Spindle(Turning::Stopped));
                self.along(MoveKind::Rapid, place, hole, hole.clear);
                self.core.emit(Event::Spindle(turning));
            }
            _ => {
                if cycle == Cycle::DrillDwell {
                    self.wait(hole);
                }
                self.along(MoveKind::Rapid, place, hole, hole.clear);
            }
        }
    }

    /// G87: beside the hole by Q along the first axis of the plane, down to R, over the hole, up to Z
    /// with feed, and out the same way.
    fn bore_back(&mut self, hole: &Hole, place: Position) {
        let mut beside = place;
        beside[self.core.modes.plane.axes()[0]] += hole.peck;
        let turning = self.core.modes.turning;
        self.core.emit(Event::SpindleOrient { angle_deg: 0.0 });
        self.step(MoveKind::Rapid, beside);
        self.along(MoveKind::Rapid, beside, hole, hole.r);
        self.along(MoveKind::Rapid, place, hole, hole.r);
        self.core.emit(Event::Spindle(turning));
        self.along(MoveKind::Linear, place, hole, hole.bottom);
        self.wait(hole);
        self.core.emit(Event::SpindleOrient { angle_deg: 0.0 });
        self.along(MoveKind::Rapid, beside, hole, hole.bottom);
        self.step(MoveKind::Rapid, beside);
        self.step(MoveKind::Rapid, place);
        self.core.emit(Event::Spindle(turning));
    }

    fn wait(&mut self, hole: &Hole) {
        let place = self.frames.position;
        self.step(MoveKind::Dwell { seconds: hole.dwell_s }, place);
    }

    /// Down by Q at a time; a chip is broken by 0.010 inch, a deep hole is left to R each time.
    fn peck(&mut self, cycle: Cycle, hole: &Hole, place: Position) {
        const CLEARANCE_MM: f64 = 0.254;
        let mut count = 1.0;
        loop {
            let depth = hole.r - count * hole.peck;
            if depth <= hole.bottom {
                break;
            }
            self.along(MoveKind::Linear, place, hole, depth);
            if cycle == Cycle::Peck {
                self.along(MoveKind::Rapid, place, hole, hole.r);
            }
            self.along(MoveKind::Rapid, place, hole, depth + CLEARANCE_MM);
            count += 1.0;
        }
        self.along(MoveKind::Linear, place, hole, hole.bottom);
    }
}
