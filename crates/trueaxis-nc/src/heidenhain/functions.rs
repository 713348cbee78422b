//! The M functions: a table of what each does and when.

use super::words::{FunctionCall, Words};
use super::{Run, fault};
use crate::moves::turns::unit;
use crate::moves::{
    Axis, AxisSet, Coolant, Coordinates, Event, Feed, FeedMode, Move, MoveKind, OrientationPath,
    Position, SpindleDirection,
};
use crate::text::program::Fault;

/// What an M function does.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Effect {
    Stop(bool),
    End,
    Spindle(SpindleDirection),
    Coolant(Coolant),
    SpindleAndCoolant(SpindleDirection),
    /// Read with the axis words: M91, M92, M98, M99, M130 …
    WithBlock,
    ReduceRotary,
    ShortestWay(bool),
    ToolCentre(bool),
    PerRevolution(bool),
    Retract,
    CycleEverywhere,
    /// Of no effect on the path.
    Note(&'static str),
    /// It changes the path, but is left out.
    NotApplied(&'static str),
}

/// Number, whether it takes effect at the end of the block, effect.
static FUNCTIONS: &[(u32, bool, Effect)] = &[
    (0, true, Effect::Stop(false)),
    (1, true, Effect::Stop(true)),
    (2, true, Effect::End),
    (3, false, Effect::Spindle(SpindleDirection::Clockwise)),
    (4, false, Effect::Spindle(SpindleDirection::CounterClockwise)),
    (5, true, Effect::Spindle(SpindleDirection::Stopped)),
    (6, true, Effect::Note("M6 tool change")),
    (7, false, Effect::Coolant(Coolant::Mist)),
    (8, false, Effect::Coolant(Coolant::Flood)),
    (9, true, Effect::Coolant(Coolant::Off)),
    (13, false, Effect::SpindleAndCoolant(SpindleDirection::Clockwise)),
    (14, false, Effect::SpindleAndCoolant(SpindleDirection::CounterClockwise)),
    (19, true, Effect::Note("M19 oriented stop of the spindle")),
    (30, true, Effect::End),
    (89, true, Effect::CycleEverywhere),
    (90, false, Effect::Note("M90 constant path speed at corners")),
    (91, false, Effect::WithBlock),
    (92, false, Effect::WithBlock),
    (94, false, Effect::ReduceRotary),
    (97, true, Effect::NotApplied("M97 machining of small contour steps")),
    (98, true, Effect::NotApplied("M98 complete machining of open corners")),
    (99, true, Effect::WithBlock),
    (101, true, Effect::Note("M101 change to a sister tool")),
    (102, true, Effect::Note("M102 no change to a sister tool")),
    (103, false, Effect::NotApplied("M103 feed factor when plunging")),
    (104, true, Effect::NotApplied("M104 last preset again")),
    (105, true, Effect::Note("M105 second set of controller gains")),
    (106, true, Effect::Note("M106 first set of controller gains")),
    (107, true, Effect::Note("M107 no message at tool oversize")),
    (108, true, Effect::Note("M108 message at tool oversize")),
    (109, false, Effect::NotApplied("M109 constant speed of the cutting edge on arcs")),
    (110, false, Effect::NotApplied("M110 constant speed of the edge on inner arcs")),
    (111, true, Effect::Note("M111 feed of the tool centre on arcs")),
    (114, false, Effect::NotApplied("M114 correction of the machine geometry")),
    (115, true, Effect::Note("M115 end of M114")),
    (116, false, Effect::Note("M116 feed of rotary axes in mm/min")),
    (117, true, Effect::Note("M117 end of M116")),
    (118, false, Effect::Note("M118 handwheel in addition")),
    (120, false, Effect::Note("M120 look-ahead of the compensation")),
    (124, false, Effect::NotApplied("M124 points closer than T are omitted")),
    (126, false, Effect::ShortestWay(true)),
    (127, true, Effect::ShortestWay(false)),
    (128, false, Effect::ToolCentre(true)),
    (129, true, Effect::ToolCentre(false)),
    (130, false, Effect::WithBlock),
    (134, false, Effect::Note("M134 exact stop with rotary axes")),
    (135, true, Effect::Note("M135 end of M134")),
    (136, false, Effect::PerRevolution(true)),
    (137, true, Effect::PerRevolution(false)),
    (138, false, Effect::NotApplied("M138 choice of rotary axes")),
    (140, false, Effect::Retract),
    (141, false, Effect::Note("M141 no probe supervision")),
    (142, false, Effect::NotApplied("M142 modal program data deleted")),
    (143, false, Effect::NotApplied("M143 basic rotation deleted")),
    (144, false, Effect::NotApplied("M144 kinematics in actual positions")),
    (145, true, Effect::Note("M145 end of M144")),
    (148, false, Effect::Note("M148 lift-off at a stop")),
    (149, true, Effect::Note("M149 end of M148")),
    (150, false, Effect::Note("M150 no limit switch message")),
    (197, false, Effect::NotApplied("M197 rounding of corners")),
    (200, false, Effect::Note("M200 laser power")),
    (201, false, Effect::Note("M201 laser power by distance")),
    (202, false, Effect::Note("M202 laser power by speed")),
    (203, false, Effect::Note("M203 laser power by time")),
    (204, false, Effect::Note("M204 laser pulse")),
];

impl Run<'_> {
    /// The M functions of a block that act before (`late` false) or after its move; `true` at the
    /// end of the program.
    pub(super) fn functions(&mut self, words: &Words, late: bool) -> Result<bool, Fault> {
        for called in &words.functions {
            if self.core.settings.codes.contains_key(&format!("M{}", called.number)) {
                if !late {
                    self.core.own_number('M', f64::from(called.number), called.at);
                }
                continue;
            }
            let known = FUNCTIONS.iter().find(|(number, ..)| *number == called.number);
            let Some((_, at_end, effect)) = known else {
                if !late {
                    self.core.unknown_m_code(f64::from(called.number), called.at);
                }
                continue;
            };
            if *at_end == late && self.effect(*effect, called, words)? {
                return Ok(true);
            }
        }
        Ok(false)
    }

    fn effect(
        &mut self,
        effect: Effect,
        called: &FunctionCall,
        words: &Words,
    ) -> Result<bool, Fault> {
        match effect {
            Effect::Stop(optional) => self.core.emit(Event::Stop { optional }),
            Effect::End => {
                self.core.emit(Event::End);
                return Ok(true);
            }
            Effect::Spindle(turning) => self.core.turn_spindle(turning),
            Effect::Coolant(coolant) => self.coolant(coolant),
            Effect::SpindleAndCoolant(turning) => {
                self.core.turn_spindle(turning);
                self.coolant(Coolant::Flood);
            }
            Effect::ReduceRotary => self.reduce_rotary(called),
            Effect::ShortestWay(on) => self.modes.shortest = on,
            Effect::ToolCentre(on) => self.tool_centre(on, None),
            Effect::PerRevolution(on) => self.per_revolution(on, words),
            Effect::Retract => self.retract(called.value, called.feed, called.at)?,
            Effect::CycleEverywhere => self.modes.cycle_everywhere = true,
            Effect::Note(name) => self.core.emit(Event::Note(name)),
            Effect::NotApplied(name) => self.core.left_out(name, called.at),
            Effect::WithBlock => {}
        }
        Ok(false)
    }

    fn coolant(&mut self, coolant: Coolant) {
        self.modes.coolant = coolant != Coolant::Off;
        self.core.emit(Event::Coolant(coolant));
    }

    /// M128, FUNCTION TCPM, and their ends; TCPM also says how the tool turns.
    pub(super) fn tool_centre(&mut self, on: bool, path: Option<OrientationPath>) {
        self.tangent = None;
        if !on {
            self.modes.space_angles = false;
            self.direction = None;
        }
        self.core.tool_centre(on);
        let path = path.unwrap_or(OrientationPath::Axes);
        if on && path != self.modes.orientation {
            self.modes.orientation = path;
            self.core.emit(Event::Orientation(path));
        }
    }

    fn per_revolution(&mut self, on: bool, words: &Words) {
        self.modes.per_revolution = on;
        let mode = if on { FeedMode::PerRevolution } else { FeedMode::PerMinute };
        if mode == self.core.modes.feed.mode {
            return;
        }
        // F of this block was read before M136 was known.
        let value = match (on, words.feed) {
            (true, Some(super::words::FeedWord::PerMinute(f))) if self.core.modes.inches => {
                f * 10.0
            }
            (true, Some(super::words::FeedWord::PerMinute(f))) => f,
            _ => 0.0,
        };
        self.core.modes.feed = Feed { mode, value };
    }

    /// M94: the display of rotary axes is brought below a full turn; nothing moves.
    fn reduce_rotary(&mut self, called: &FunctionCall) {
        for axis in [Axis::A, Axis::B, Axis::C] {
            if called.axes.0 != 0 && !called.axes.contains(axis) {
                continue;
            }
            let angle = self.frames.position[axis];
            let reduced = angle.rem_euclid(360.0);
            self.turned[axis as usize - 3] += angle - reduced;
            self.frames.position[axis] = reduced;
        }
    }

    /// M140 MB: away from the workpiece along the tool axis.
    pub(super) fn retract(
        &mut self,
        length_mm: Option<f64>,
        feed: Option<f64>,
        at: usize,
    ) -> Result<(), Fault> {
        let Some(length_mm) = length_mm.filter(|v| v.is_finite()) else {
            return self.retract_to_the_end(feed, at);
        };
        let rotary = self.frames.position.0[3..6].iter().any(|v| *v != 0.0);
        let along = match self.direction {
            Some(direction) if self.core.modes.tool_centre => unit(direction).unwrap_or([0.0; 3]),
            _ if rotary && !self.frames.is_tilted() => {
                let message = "M140 with turned axes: the tool axis is not known here";
                let hint = "the retraction is missing from the path";
                self.core.warn("not-applied", "M140 turned", at, message, hint);
                return Ok(());
            }
            _ => {
                let mut along = [0.0; 3];
                along[self.core.modes.plane.axes()[2] as usize] = 1.0;
                along
            }
        };
        let mut target = self.frames.position;
        for (i, part) in along.iter().enumerate() {
            target.0[i] += part * length_mm;
        }
        self.emit_retraction(feed, at, target, AxisSet::XYZ, Coordinates::Program)
    }

    /// M140 MB MAX: to the end of the travel.
    fn retract_to_the_end(&mut self, feed: Option<f64>, at: usize) -> Result<(), Fault> {
        let Some(end) = self.core.retracted() else {
            let message = "M140 MB MAX moves to the end of the travel, which is not known here";
            let hint = "the retraction is missing from the path; state the travel in the machine file, or write MB with \
                        a length";
            self.core.warn("not-applied", "M140", at, message, hint);
            return Ok(());
        };
        self.emit_retraction(feed, at, end.position, end.axes, Coordinates::Machine)?;
        let mut place = end.position;
        place[self.core.modes.plane.axes()[2]] -= self.modes.tool_length_mm;
        if let Some(position) = self.frames.frame().inverse_place(&place) {
            self.frames.position = position;
        }
        self.tangent = None;
        Ok(())
    }

    fn emit_retraction(
        &mut self,
        feed: Option<f64>,
        at: usize,
        target: Position,
        named: AxisSet,
        coordinates: Coordinates,
    ) -> Result<(), Fault> {
        let kind = if feed.is_some() { MoveKind::Linear } else { MoveKind::Rapid };
        let mut step = Move { coordinates, ..self.core.plain_move(kind, target, named) };
        if let Some(value) = feed {
            if value <= 0.0 {
                return Err(fault("zero-feed", at, "the feed is zero", "write F100"));
            }
            let scale = self.core.modes.unit_of_klartext_feed();
            step.feed = Feed { mode: FeedMode::PerMinute, value: value * scale };
        }
        self.emit_move(step, at)
    }
}
