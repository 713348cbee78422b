//! What lasts from block to block in every language: units, plane, feed, spindle, tool.

use super::radius::Behaviour;
use super::{Core, Settings, mistakes};
use crate::moves::{
    Axis, AxisSet, CompensationSide, Event, Feed, FeedMode, Move, MoveKind, Plane, Position,
    SpindleDirection,
};
use crate::text::program::Fault;

#[derive(Debug, Clone)]
pub(crate) struct Modes {
    pub inches: bool,
    /// X words are diameters.
    pub diameter: bool,
    pub incremental: bool,
    pub plane: Plane,
    pub feed: Feed,
    pub speed: f64,
    pub turning: SpindleDirection,
    /// The tool that is prepared.
    pub selected: u32,
    /// The tool in the spindle.
    pub tool: u32,
    /// The tip of the tool is programmed.
    pub tool_centre: bool,
}

impl Modes {
    pub fn new(settings: &Settings) -> Self {
        Self {
            inches: settings.inches,
            diameter: settings.diameters,
            incremental: false,
            plane: settings.plane,
            feed: Feed { mode: FeedMode::PerMinute, value: 0.0 },
            speed: 0.0,
            turning: SpindleDirection::Stopped,
            selected: 0,
            tool: 0,
            tool_centre: false,
        }
    }

    #[inline]
    pub fn unit_mm(&self) -> f64 {
        if self.inches { 25.4 } else { 1.0 }
    }

    /// The factor of F in Klartext to mm/min: in inches it counts tenths of an inch.
    #[inline]
    pub fn unit_of_klartext_feed(&self) -> f64 {
        if self.inches { 2.54 } else { 1.0 }
    }

    /// The factor of a word of an axis to mm or degrees.
    #[inline]
    pub fn scale(&self, axis: Axis) -> f64 {
        match axis {
            _ if axis.is_rotary() => 1.0,
            Axis::X if self.diameter => self.unit_mm() / 2.0,
            _ => self.unit_mm(),
        }
    }

    /// A feed of another kind begins without a value.
    pub fn change_feed_mode(&mut self, mode: FeedMode) {
        if mode != self.feed.mode {
            self.feed = Feed { mode, value: 0.0 };
        }
    }

    /// The feed of a block: F if it has one. Inverse time lasts for its block only.
    #[inline]
    pub fn set_feed(&mut self, word: Option<f64>, unit_mm: f64) {
        let inverse = self.feed.mode == FeedMode::InverseTime;
        match word {
            Some(feed) => self.feed.value = if inverse { feed } else { feed * unit_mm },
            None if inverse => self.feed.value = 0.0,
            None => {}
        }
    }

    #[inline]
    pub fn check_feed(&self, at: usize) -> Result<(), Fault> {
        check_feed(&self.feed, at)
    }
}

/// A move needs a feed.
#[inline]
pub(crate) fn check_feed(feed: &Feed, at: usize) -> Result<(), Fault> {
    if feed.value > 0.0 { Ok(()) } else { Err(mistakes::zero_feed(feed.mode, at)) }
}

impl Core<'_> {
    /// A move with the feed that is on.
    #[inline]
    pub fn plain_move(&self, kind: MoveKind, target: Position, named: AxisSet) -> Move {
        Move::plain(kind, target, named, self.modes.feed, self.origin)
    }

    pub fn select_plane(&mut self, plane: Plane) {
        self.modes.plane = plane;
        self.emit(Event::Plane(plane));
    }

    pub fn turn_spindle(&mut self, turning: SpindleDirection) {
        self.modes.turning = turning;
        self.emit(Event::Spindle(turning));
    }

    #[inline]
    pub fn set_speed(&mut self, speed: Option<f64>) {
        if let Some(speed) = speed {
            self.modes.speed = speed;
            self.emit(Event::SpindleSpeed(speed));
        }
    }

    /// S is a surface speed, or no longer.
    pub fn surface_speed(&mut self, on: bool) {
        let name = if on { "G96 constant surface speed" } else { "G97 revolutions per minute" };
        self.emit(Event::Note(name));
    }

    pub fn select_tool(&mut self, tool: u32) {
        self.modes.selected = tool;
        self.emit(Event::ToolSelect(tool));
    }

    /// The tool that is prepared comes into the spindle, which stops.
    pub fn change_tool(&mut self) {
        self.modes.tool = self.modes.selected;
        self.modes.turning = SpindleDirection::Stopped;
        self.emit(Event::ToolChange(self.modes.tool));
    }

    /// The tip of the tool is programmed, or the axes.
    pub fn tool_centre(&mut self, on: bool) {
        self.modes.tool_centre = on;
        self.emit(Event::ToolCentre(on));
    }

    /// Radius compensation with a radius, mm, from a place; a negative radius changes the side.
    pub fn compensate(
        &mut self,
        side: CompensationSide,
        radius: Option<f64>,
        behaviour: Behaviour,
        place: Position,
        at: usize,
    ) {
        let radius_mm = radius.filter(|_| side != CompensationSide::Off).unwrap_or(0.0);
        self.emit(Event::Compensation { side, radius_mm });
        let left_mm = match side {
            CompensationSide::Left => radius_mm,
            CompensationSide::Right => -radius_mm,
            CompensationSide::Off => 0.0,
        };
        if left_mm == 0.0 || self.settings.on_contour {
            self.end_radius();
        } else {
            self.begin_radius(left_mm, behaviour, place, at);
        }
    }

    /// Warns that a radius is not stated anywhere.
    pub fn unknown_radius(&mut self, whose: impl std::fmt::Display, at: usize) {
        let message = format!(
            "radius compensation: the radius {whose} is not stated, 0 is taken; the path is the written one"
        );
        let hint = "state diameter, or radius_offset, of the tool in a set-up file (--setup); radius_offset = \"0 mm\" \
                    if the program has the path of the centre";
        self.warn("unknown-tool-radius", whose, at, message, hint);
    }

    /// Warns that the end of an element was not cut short before an inside corner.
    pub fn interrupted_inside(&mut self) {
        let line = self.origin.line;
        let message = "the radius compensation is interrupted before an inside corner (a change of frame, tool \
                       length or direction): the tool cuts into the contour there";
        let hint = "change it where the contour does not turn towards the tool, or end the compensation before";
        self.warn("not-applied", format!("inside corner {line}"), self.start, message, hint);
    }

    /// Warns that the tool table does not have a tool.
    pub fn unknown_length(&mut self, tool: u32, at: usize) {
        let taken = match self.settings.unlisted_length_mm {
            Some(length_mm) => format!(
                "0 is taken, and with tool-centre-point control the {length_mm} mm of the machine file"
            ),
            None => "0 is taken".to_owned(),
        };
        let message = format!("the length of tool {tool} is not stated: {taken}");
        let hint = "list the tools with their lengths in a set-up file: --setup";
        self.warn("unknown-tool-length", tool, at, message, hint);
    }

    /// Warns of a work offset that the set-up file leaves out although it states others.
    pub fn unknown_offset(&mut self, number: u32, name: impl std::fmt::Display, at: usize) {
        let stated = &self.settings.work_offsets;
        if stated.is_empty() || stated.contains_key(&number) {
            return;
        }
        let message = format!("the work offset {name} is not stated: 0 is taken");
        let hint =
            "the set-up file states other work offsets: add this one, or correct its name there";
        self.warn("unknown-work-offset", number, at, message, hint);
    }

    /// Warns that the length of another tool is compensated than of that in the spindle.
    pub fn other_length(&mut self, [offset, length]: [Position; 2], number: u32, at: usize) {
        let tool = self.modes.tool;
        let [offset, length] = [offset, length].map(|length| length[Axis::Z]);
        let message = format!(
            "H{number} compensates {offset:.4} mm, and tool {tool} in the spindle is {length:.4} mm long"
        );
        let hint = "write the offset of the tool, or check its length in the set-up file";
        self.warn("offset-of-other-tool", format!("{tool} {number}"), at, message, hint);
    }

    /// Warns of an M function that is not known.
    pub fn unknown_m_code(&mut self, number: f64, at: usize) {
        let message = format!("unknown M function M{number} for this control");
        let hint = "if the machine builder defined it, its effect is missing here: state it in [codes] of the \
                    set-up file, such as M200 = \"ignore\"";
        self.warn("unknown-m-code", number, at, message, hint);
    }
}
