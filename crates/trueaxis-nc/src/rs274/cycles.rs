//! Drilling cycles: G73 to G89.

use super::{Run, fault};
use crate::execution::drilling::{Drill, MOST_PECKS, Stroke, check_pecks, pecks, reversed};
use crate::execution::mistakes;
use crate::moves::{Axis, Event, Feed, FeedMode, MoveKind, Position, SpindleDirection};
use crate::rs274::code::{Cycle, Motion};
use crate::text::program::Fault;
use trueaxis_cycles::pattern::{Circle, MOST_HOLES, Row, peck_depths};

/// What drilling cycles keep from block to block.
#[derive(Debug, Clone, Default)]
pub(super) struct CycleMemory {
    /// R and the depth: LinuxCNC keeps them as they were written, FANUC their places.
    r_mm: Option<f64>,
    depth_mm: Option<f64>,
    /// LinuxCNC keeps R and depth for the same cycle only.
    last: Option<Cycle>,
    peck_mm: Option<f64>,
    /// HAAS: the first peck and by how much each is less; the peck is then the least.
    shrink_mm: Option<[f64; 2]>,
    dwell_s: f64,
    /// HAAS: how much faster a tap goes out than in.
    faster: Option<f64>,
    /// Where the drill stood when the cycles began.
    initial_mm: Option<f64>,
    /// The block itself writes the G code of its cycle.
    pub written: bool,
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
    /// Where the cycles began.
    begin: f64,
    bottom: f64,
    clear: f64,
    peck: f64,
    shrink: Option<[f64; 2]>,
    dwell_s: f64,
}

impl Hole {
    /// The depths of the pecks: by Q at a time, or each shorter than the one before.
    fn depths(&self) -> Vec<f64> {
        let Some([first, less]) = self.shrink else {
            let depths = (1..).map(|n| self.r - f64::from(n) * self.peck);
            return depths.take_while(|d| *d > self.bottom).chain([self.bottom]).collect();
        };
        let shorter = |stroke: f64| (stroke - less).max(self.peck);
        // Each is `self.peck` at least, by which their number was checked.
        let depths = peck_depths(self.r - self.bottom, first, usize::MAX, shorter);
        depths.unwrap_or_default().iter().map(|d| self.r - d).collect()
    }
}

impl Run<'_> {
    /// A drilling cycle at the place of the axis words, once or L (K on FANUC) times.
    pub(super) fn cycle(&mut self, cycle: Cycle, at: usize) -> Result<(), Fault> {
        self.modes.length_due = Position::default();
        for letter in *b"ABC" {
            if self.words.look(letter).is_some() {
                let message = "a rotary axis is programmed in a drilling cycle";
                return Err(fault("rotary-in-cycle", at, message, "turn it in a previous block"));
            }
        }
        self.core.modes.check_feed(at)?;
        self.shorter_pecks(cycle, at)?;
        self.faster_out(cycle);
        let hole = self.hole(cycle, at)?;
        self.check_depth(hole.axis, at);
        let repeats = self.words.take(b'L').or_else(|| {
            let fanuc = self.is_fanuc();
            if fanuc { self.words.take(b'K') } else { None }
        });
        let repeats = repeats.unwrap_or(1.0);
        if !(0.0..1e5).contains(&repeats) {
            let message = format!("expected a whole number of holes, found {repeats}");
            return Err(fault("bad-repeats", at, message, "write L2"));
        }
        let pecks = if hole.peck > 0.0 { (hole.r - hole.bottom) / hole.peck } else { 1.0 };
        check_pecks(pecks.max(1.0) * repeats, MOST_PECKS, at)?;
        let polar = self.modes.transforms.polar.is_some();
        let axes = self.core.modes.plane.axes();
        let steps = if polar { [None; 2] } else { [axes[0], axes[1]].map(|a| self.axis_word(a)) };
        if repeats == 0.0 && !self.modes.cycle.written && self.is_haas() {
            // Haas, "Mill Operator's Manual", G81: L0 in a later block moves X and Y without the cycle.
            let over = self.over_hole(steps)?;
            self.step(MoveKind::Rapid, over);
            return Ok(());
        }
        // FANUC looks at where the drill is, LinuxCNC at where the cycles began.
        let height = if self.is_fanuc() { self.frames.position.0[hole.axis] } else { hole.begin };
        if height < hole.r && cycle != Cycle::BackBore {
            let mut up = self.frames.position;
            up.0[hole.axis] = hole.r;
            self.step(MoveKind::Rapid, up);
        }
        for n in 0..repeats as u32 {
            let mut over = self.over_hole(steps)?;
            // LinuxCNC goes on at the height to which its last hole has returned, or as high as this one
            // will.
            if !self.is_fanuc() && (n > 0 || over.0[hole.axis] <= hole.r) {
                over.0[hole.axis] = hole.clear;
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
            let strokes = self.strokes(cycle, &hole);
            self.drill(strokes, at)?;
        }
        self.words.polar = [None; 2];
        Ok(())
    }

    /// The place of the next hole, at the height at which the drill is.
    fn over_hole(&mut self, steps: [Option<f64>; 2]) -> Result<Position, Fault> {
        let [first, second, _] = self.core.modes.plane.axes();
        let mut over = self.frames.position;
        for (axis, step) in [first, second].into_iter().zip(steps) {
            let base = if self.core.modes.incremental { over[axis] } else { 0.0 };
            over[axis] = step.map_or(over[axis], |s| base + s);
        }
        if let Some(place) = self.polar_place() {
            (over[first], over[second]) = (place[0], place[1]);
        }
        if let Some(place) = self.polar_target(false)? {
            (over[Axis::X], over[Axis::Y]) = (place[0], place[1]);
        }
        Ok(over)
    }

    /// G70, G71 and G72 of HAAS: the drilling cycle that is on, at holes about or from the place of the tool.
    ///
    /// # Source
    /// Haas Automation, "Mill Operator's Manual": G70 I radius, J angle of the first hole, L number; G71 with K
    /// the angle from hole to hole; G72 I distance, J angle, L number. Angles are counter-clockwise from +X.
    pub(super) fn hole_pattern(&mut self, code: u8, at: usize) -> Result<(), Fault> {
        let size = self.length(b'I').unwrap_or(0.0);
        let start_deg = self.words.take(b'J').unwrap_or(0.0);
        let step_deg = self.words.take(b'K');
        let count = self.words.take(b'L').unwrap_or(0.0);
        let Some(Motion::Cycle(cycle)) = self.modes.motion else {
            let message = format!("G{code} needs a drilling cycle that is on");
            return Err(fault("missing-cycle", at, message, "write G81 Z R F L0 before it"));
        };
        if !(1.0..=f64::from(MOST_HOLES)).contains(&count) {
            let message = format!("expected the number of holes in L, found {count}");
            return Err(fault("bad-repeats", at, message, "write L6"));
        }
        let [first, second, _] = self.core.modes.plane.axes();
        let (now, count) = (self.frames.position, count as u32);
        let center = [now[first], now[second]];
        let step_deg = step_deg.unwrap_or(360.0 / f64::from(count));
        let holes = match code {
            72 => {
                let row = Row {
                    from: center,
                    angle_deg: start_deg,
                    first_mm: 0.0,
                    spacing_mm: size,
                    count,
                };
                row.holes()
            }
            _ => Circle { center, radius_mm: size.abs(), start_deg, step_deg, count }.holes(),
        };
        let hole = self.hole(cycle, at)?;
        for place in holes {
            let mut over = self.frames.position;
            (over[first], over[second]) = (place[0], place[1]);
            self.step(MoveKind::Rapid, over);
            if over.0[hole.axis] != hole.r {
                over.0[hole.axis] = hole.r;
                self.step(MoveKind::Rapid, over);
            }
            let strokes = self.strokes(cycle, &hole);
            self.drill(strokes, at)?;
        }
        Ok(())
    }

    /// I, J and K of G73 and G83 of HAAS: the first peck, by how much each next is less, and the least.
    ///
    /// # Source
    /// Haas Automation, "Mill Operator's Manual" (96-8000), G73 and G83. What I, J or K mean beside Q differs between the
    /// two cycles and is left out.
    fn shorter_pecks(&mut self, cycle: Cycle, at: usize) -> Result<(), Fault> {
        let pecks = matches!(cycle, Cycle::Peck | Cycle::ChipBreaking);
        if !pecks || !self.is_haas() {
            return Ok(());
        }
        let unit = self.core.modes.unit_mm();
        let words = b"IJK".map(|l| self.words.take_away(l).map(|value| value * unit));
        if self.words.look(b'Q').is_some() {
            self.modes.cycle.shrink_mm = None;
            if words != [None; 3] {
                self.core.left_out("I, J or K beside Q in G73 or G83", at);
            }
            return Ok(());
        }
        match words {
            [None, None, None] => {}
            [Some(first), Some(less), Some(least)] if first > 0.0 && less >= 0.0 && least > 0.0 => {
                let memory = &mut self.modes.cycle;
                (memory.shrink_mm, memory.peck_mm) = (Some([first, less]), Some(least));
            }
            _ => {
                let message = "the cycle needs I, J and K, or Q alone";
                return Err(fault("cycle-without-q", at, message, "write I10. J2. K3."));
            }
        }
        Ok(())
    }

    /// J of G74 and G84 of HAAS ("Mill Operator's Manual"): J2 goes out twice as fast as in.
    fn faster_out(&mut self, cycle: Cycle) {
        let taps = matches!(cycle, Cycle::TapLeft | Cycle::TapRight) && self.is_haas();
        if taps && self.words.look(b'J').is_some_and(|j| (0.1..=100.0).contains(&j)) {
            self.modes.cycle.faster = self.words.take(b'J');
        }
    }

    fn hole(&mut self, cycle: Cycle, at: usize) -> Result<Hole, Fault> {
        let axis = self.core.modes.plane.axes()[2];
        let now = self.frames.position[axis];
        if self.modes.cycle.initial_mm.is_none() {
            self.modes.cycle.initial_mm = Some(now);
        }
        let incremental = self.core.modes.incremental;
        let fanuc = self.is_fanuc();
        let memory = &self.modes.cycle;
        let keeps = fanuc || memory.last == Some(cycle);
        let (kept_r, kept_depth) =
            if keeps { (memory.r_mm, memory.depth_mm) } else { (None, None) };
        let begin = memory.initial_mm.unwrap_or(now);
        // G91: R counts from where the cycles began, the depth from R. LinuxCNC reads kept words again by
        // G90 and G91, FANUC keeps their places.
        let place = |word: Option<f64>, kept: Option<f64>, base: f64| match (word, kept) {
            (Some(word), _) => Some(if incremental { word + base } else { word }),
            (None, Some(kept)) if incremental && !fanuc => Some(kept + base),
            (None, kept) => kept,
        };
        let r_word = self.length(b'R');
        let Some(r) = place(r_word, kept_r, begin) else {
            let message = "the cycle has no R";
            return Err(fault("cycle-without-r", at, message, "write R, the retraction plane"));
        };
        let depth = self.axis_word(axis);
        let Some(bottom) = place(depth, kept_depth, r) else {
            return Err(mistakes::missing_depth(at));
        };
        let keep = |word: Option<f64>, kept, place| if fanuc { Some(place) } else { word.or(kept) };
        let (kept_r, kept_depth) = (keep(r_word, kept_r, r), keep(depth, kept_depth, bottom));
        if (r < bottom) != (cycle == Cycle::BackBore) {
            let message = "the retraction plane R is below the bottom of the hole";
            return Err(fault("cycle-r-below-bottom", at, message, "check R and the depth"));
        }
        let peck = self.length(b'Q').or(self.modes.cycle.peck_mm);
        let pecks = matches!(cycle, Cycle::Peck | Cycle::ChipBreaking);
        if pecks && !peck.is_some_and(|q| q > 0.0) {
            let message = "the cycle needs Q, the depth of each peck, above 0";
            return Err(fault("cycle-without-q", at, message, "write Q2"));
        }
        let dwell_s = self.seconds_by_p()?.unwrap_or(self.modes.cycle.dwell_s);
        let memory = &mut self.modes.cycle;
        (memory.r_mm, memory.depth_mm, memory.last) = (kept_r, kept_depth, Some(cycle));
        (memory.peck_mm, memory.dwell_s) = (peck, dwell_s);
        let shrink = memory.shrink_mm;
        let clear = if self.modes.retract_to_r { r } else { r.max(begin) };
        let peck = peck.unwrap_or(0.0);
        Ok(Hole { axis: axis as usize, r, begin, bottom, clear, peck, shrink, dwell_s })
    }

    /// What the drill does from R on.
    fn strokes(&self, cycle: Cycle, hole: &Hole) -> Vec<Stroke> {
        const CLEARANCE_MM: f64 = 0.254;
        let turning = self.core.modes.turning;
        // FANUC and Haas turn the spindle into the thread themselves.
        let into = match cycle {
            Cycle::TapRight if self.is_fanuc() => SpindleDirection::Clockwise,
            Cycle::TapLeft if self.is_fanuc() => SpindleDirection::CounterClockwise,
            _ => turning,
        };
        let turn = |turning| Stroke::Event(Event::Spindle(turning));
        let (wait, out) = (Stroke::Dwell(hole.dwell_s), Stroke::Rapid(hole.clear));
        let mut strokes = match cycle {
            // A chip is broken by 0.010 inch, a deep hole is left to R each time.
            Cycle::Peck | Cycle::ChipBreaking => pecks(hole.depths(), |depth, strokes| {
                strokes.extend((cycle == Cycle::Peck).then_some(Stroke::Rapid(hole.r)));
                strokes.push(Stroke::Rapid(depth + CLEARANCE_MM));
            }),
            _ if into != turning => vec![turn(into), Stroke::Linear(hole.bottom)],
            _ => vec![Stroke::Linear(hole.bottom)],
        };
        match cycle {
            Cycle::TapLeft | Cycle::TapRight => {
                strokes.extend([turn(SpindleDirection::Stopped), turn(reversed(into)), wait]);
                // FANUC feeds out to R and goes on with rapid, LinuxCNC feeds all the way.
                let out_of = if self.is_fanuc() { hole.r } else { hole.clear };
                let speed =
                    |times: f64| Stroke::Event(Event::SpindleSpeed(times * self.core.modes.speed));
                let faster = self.modes.cycle.faster;
                if let Some(times) = faster {
                    let feed = self.core.modes.feed;
                    let value = if feed.mode == FeedMode::PerMinute { times } else { 1.0 };
                    strokes.push(Stroke::Feed(Feed { value: value * feed.value, ..feed }));
                    strokes.push(speed(times));
                }
                strokes.extend([Stroke::Linear(out_of), turn(SpindleDirection::Stopped)]);
                strokes.extend(faster.map(|_| speed(1.0)));
                strokes.push(turn(turning));
                strokes.extend((out_of != hole.clear).then_some(out));
            }
            Cycle::Bore | Cycle::BoreDwell => {
                strokes.extend((cycle == Cycle::BoreDwell).then_some(wait));
                strokes.push(Stroke::Linear(hole.r));
                strokes.extend((hole.clear != hole.r).then_some(out));
            }
            Cycle::BoreManual => {
                let stop = Stroke::Event(Event::Stop { optional: false });
                strokes.extend([wait, turn(SpindleDirection::Stopped), stop, out, turn(turning)]);
            }
            Cycle::BoreStop | Cycle::FineBore => {
                strokes.extend([wait, turn(SpindleDirection::Stopped), out, turn(turning)]);
            }
            Cycle::DrillDwell => strokes.extend([wait, out]),
            _ => strokes.push(out),
        }
        strokes
    }

    /// G87: beside the hole by Q along the first axis of the plane, down to R, over the hole, up to Z
    /// with feed, and out the same way.
    fn bore_back(&mut self, hole: &Hole, over: Position) {
        let turn = Event::Spindle(self.core.modes.turning);
        let at_height = |place: &Position, height| {
            let mut there = *place;
            there.0[hole.axis] = height;
            there
        };
        let mut beside = over;
        beside[self.core.modes.plane.axes()[0]] += hole.peck;
        self.core.emit(Event::SpindleOrient { angle_deg: 0.0 });
        self.step(MoveKind::Rapid, beside);
        self.step(MoveKind::Rapid, at_height(&beside, hole.r));
        self.step(MoveKind::Rapid, at_height(&over, hole.r));
        self.core.emit(turn.clone());
        self.step(MoveKind::Linear, at_height(&over, hole.bottom));
        self.step(MoveKind::Dwell { seconds: hole.dwell_s }, self.frames.position);
        self.core.emit(Event::SpindleOrient { angle_deg: 0.0 });
        self.step(MoveKind::Rapid, at_height(&beside, hole.bottom));
        self.step(MoveKind::Rapid, beside);
        self.step(MoveKind::Rapid, over);
        self.core.emit(turn);
    }
}

impl<'r> Drill<'r> for Run<'r> {
    fn place(&mut self) -> &mut Position {
        &mut self.frames.position
    }

    fn move_drill(&mut self, kind: MoveKind, to: Position, _at: usize) -> Result<(), Fault> {
        self.step(kind, to);
        Ok(())
    }
}
