//! Writes NC programs for the five controls.
//!
//! ```text
//!     Block (common to all controls)    ──Writer──> text of one control
//!                                   Templates: start, tool call, tool-centre point, end
//! ```
//!
//! [`interpret`](trueaxis_nc::interpret) reads the text back as the same moves to the least increment.
//! Modal words that do not change are omitted.
//!
//! ```
//! use trueaxis_nc::moves::{Axis, Feed, FeedMode};
//! use trueaxis_writer::{Block, Heading, Target, Writer};
//! use trueaxis_nc::Control;
//! let mut writer = Writer::new(Control::Fanuc);
//! let feed = Feed { mode: FeedMode::PerMinute, value: 500.0 };
//! for block in [
//!     Block::Start(&Heading { name: "DEMO", number: 7, ..Heading::default() }),
//!     Block::Rapid(Target::default().at(Axis::X, 10.0).at(Axis::A, -30.0)),
//!     Block::Line(Target::default().at(Axis::X, 12.5), feed),
//!     Block::Line(Target::default().at(Axis::X, 12.5).at(Axis::A, -30.5), feed),
//!     Block::End,
//! ] {
//!     writer.write(&block)?;
//! }
//! let text = String::from_utf8(writer.finish()).unwrap();
//! assert!(text.contains("\nG0 X10. A-30.\nG94 G1 X12.5 F500.\nA-30.5\nM9\n"));
//! # Ok::<(), trueaxis_writer::WriteError>(())
//! ```

mod arc;
mod fanuc;
mod heidenhain;
mod holes;
mod linuxcnc;
mod number;
mod sinumerik;
mod template;
mod words;

pub use arc::CircularArc;
pub use holes::{Hole, Thread};
pub use number::MOST_DECIMALS;
pub use template::{BUILT_IN, Templates};

use number::Form;
use trueaxis_nc::Control;
use trueaxis_nc::moves::{
    Axis, AxisSet, Coolant, Coordinates, Feed, FeedMode, Position, SpindleDirection,
};

/// The result of writing a block.
type WriteResult = Result<(), WriteError>;

/// One block of a program, independent of the control.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Block<'a> {
    /// The start of the program, by the template.
    Start(&'a Heading<'a>),
    /// A comment.
    Comment(&'a str),
    /// A tool change, by the template.
    Tool(&'a ToolCall<'a>),
    /// The spindle starts with a speed in 1/min, or stops.
    Spindle(SpindleDirection, f64),
    /// Coolant on or off.
    Coolant(Coolant),
    /// Tool-centre-point control on, by the template: the following targets are those of the tip.
    TipOn(TipWords),
    /// Tool-centre-point control off, by the template: the following targets are axis positions.
    TipOff,
    /// A move in rapid traverse.
    Rapid(Target),
    /// A straight line with feed.
    Line(Target, Feed),
    /// An arc or a turn of a helix about Z of the program, with feed.
    Arc(Target, CircularArc, Feed),
    /// A hole at the place where the tool stands, by the control's own cycle. Those that follow differ in their
    /// place alone: [`Block::NextHole`].
    Hole(&'a Hole),
    /// The same hole at another place of the plane, which is reached at the retract height.
    NextHole([f64; 2]),
    /// The last hole of the cycle is done.
    HolesEnd,
    /// A dwell, s.
    Dwell(f64),
    /// A message to the operator.
    Message(&'a str),
    /// A stop, with a text for the operator.
    Stop {
        /// Whether it is an optional stop (M1).
        optional: bool,
        /// The instruction for the operator.
        message: Option<&'a str>,
    },
    /// Lines in the language of the control, unchanged; after them all modal words are written again.
    Text(&'a str),
    /// The end, by the template.
    End,
}

/// The name of the program and the content of its first lines.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Heading<'a> {
    /// Its name; characters other than letters, digits and `_` are removed.
    pub name: &'a str,
    /// Its number, for controls with program numbers (the O word of FANUC).
    pub number: u32,
    /// Comments.
    pub comments: &'a [&'a str],
    /// Whether coordinates without tool-centre-point control are axis positions from machine zero,
    /// tool length included; see [`axis_coordinates`].
    pub machine_coordinates: bool,
    /// Tolerance for the rounding of corners, mm (if the template uses it).
    pub tolerance_mm: f64,
}

impl<'a> Heading<'a> {
    /// Of a program that measures: in axis positions, which it reaches within a micrometre.
    pub fn of_measuring(name: &'a str, comments: &'a [&'a str]) -> Self {
        Self { name, comments, machine_coordinates: true, tolerance_mm: 0.001, ..Self::default() }
    }
}

impl Default for Heading<'_> {
    fn default() -> Self {
        Self {
            name: "PROGRAM",
            number: 1,
            comments: &[],
            machine_coordinates: false,
            tolerance_mm: 0.005,
        }
    }
}

/// A tool and its spindle speed.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ToolCall<'a> {
    /// Its number.
    pub number: u32,
    /// The number under which the control keeps its length, if not the usual one: that of the tool, or D1.
    pub offset: Option<u32>,
    /// Its description, for a comment.
    pub text: &'a str,
    /// Spindle speed, for controls that state it with the tool. Unit: 1/min.
    pub speed_per_minute: Option<f64>,
}

/// The form of the tool axis while tool-centre-point control is on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TipWords {
    /// By the rotary axes: G43.4, TRAORI with A and C, TCPM AXIS POS.
    Angles,
    /// By a vector: G43.5 I J K, A3 B3 C3, LN TX TY TZ. LinuxCNC has none.
    Vectors,
    /// Not at all: the tool stands along Z with the rotary axes at 0, and its length is compensated (G43).
    Length,
}

/// The target of a block.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Target {
    /// The position, mm and degrees; used for the named axes only.
    pub place: Position,
    /// The axes that move.
    pub named: AxisSet,
    /// The tool axis, if it is written as a vector. Unit: 1.
    pub direction: Option<[f64; 3]>,
    /// The coordinates of the position.
    pub coordinates: Coordinates,
}

impl Target {
    /// The target with one more axis, mm or degrees.
    #[must_use]
    #[inline]
    pub fn at(mut self, axis: Axis, value: f64) -> Self {
        self.place[axis] = value;
        self.named = self.named.with(axis);
        self
    }

    /// The target with a tool axis.
    #[must_use]
    #[inline]
    pub fn along(self, direction: [f64; 3]) -> Self {
        Self { direction: Some(direction), ..self }
    }

    /// The target in machine coordinates.
    #[must_use]
    pub fn from_machine_zero(self) -> Self {
        Self { coordinates: Coordinates::Machine, ..self }
    }
}

/// The coordinates in which a program states axis positions without tool-centre-point control, work
/// offset and tool length.
///
/// HEIDENHAIN (M91) and LinuxCNC (G53) state this in each block. SINUMERIK switches offset and length
/// off (G500 D0); FANUC has neither, so that its G54 must be 0: the start templates write this with
/// [`Heading::machine_coordinates`].
pub fn axis_coordinates(control: Control) -> Coordinates {
    match control {
        Control::Heidenhain | Control::LinuxCnc => Coordinates::Machine,
        Control::Fanuc | Control::Haas | Control::Sinumerik840d => Coordinates::Program,
    }
}

/// The numbers of decimals.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Decimals {
    /// Decimals of mm: 4 is 0.1 µm.
    pub linear: u8,
    /// Decimals of degrees: 5 is a resolution of 0.2 µrad.
    pub angle: u8,
    /// Decimals of the components of a vector.
    pub vector: u8,
    /// Decimals of feeds, speeds and times.
    pub feed: u8,
}

impl Default for Decimals {
    fn default() -> Self {
        Self { linear: 4, angle: 5, vector: 7, feed: 3 }
    }
}

impl Decimals {
    fn of(self, axis: Axis) -> u8 {
        if axis.is_rotary() { self.angle } else { self.linear }
    }
}

/// The reason why a block cannot be written.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum WriteError {
    /// A number that is not finite or too large for a control.
    #[error("{word} = {value} cannot be written: it is not finite or too large for a machine")]
    Number {
        /// The word.
        word: &'static str,
        /// Its value.
        value: f64,
    },
    /// A feed that is not above zero after rounding.
    #[error("the feed {value} is not above zero with {decimals} decimals, as a feed move needs")]
    Feed {
        /// The feed.
        value: f64,
        /// The number of decimals.
        decimals: u8,
    },
    /// The control has no word for it.
    #[error("{control} cannot write {what}; {instead}")]
    NotInDialect {
        /// The control.
        control: &'static str,
        /// The function that cannot be written.
        what: &'static str,
        /// The action to take instead.
        instead: &'static str,
    },
    /// A template that cannot be rendered.
    #[error("the template of the program does not work: {0}")]
    Template(String),
}

/// The last written modal values, in least increments; `None`: not known.
#[derive(Debug, Clone, PartialEq, Default)]
struct Modal {
    rapid: Option<bool>,
    place: [Option<i64>; 9],
    direction: Option<[i64; 3]>,
    feed: Option<i64>,
    feed_mode: Option<FeedMode>,
    /// HEIDENHAIN: R0 has been written.
    side: bool,
}

/// Writes blocks as text of one control.
#[derive(Debug)]
pub struct Writer {
    control: Control,
    decimals: Decimals,
    templates: Templates,
    text: Vec<u8>,
    /// The number of the next block where blocks have numbers.
    number: u32,
    name: String,
    machine_coordinates: bool,
    words: TipWords,
    /// SINUMERIK: D0 is on.
    without_length: bool,
    tool: u32,
    /// The offset of the tool, where it is stated.
    offset: Option<u32>,
    modal: Modal,
    /// The cycle that is on.
    hole: Option<Hole>,
}

impl Writer {
    /// A writer with the usual numbers of decimals and the built-in templates.
    pub fn new(control: Control) -> Self {
        Self::with(control, Decimals::default(), Templates::of(control))
    }

    /// A writer with other decimals or templates.
    pub fn with(control: Control, decimals: Decimals, templates: Templates) -> Self {
        Self {
            control,
            decimals,
            templates,
            text: Vec::new(),
            number: 0,
            name: String::new(),
            machine_coordinates: false,
            words: TipWords::Angles,
            without_length: false,
            tool: 1,
            offset: None,
            modal: Modal::default(),
            hole: None,
        }
    }

    /// The numbers of decimals.
    pub fn decimals(&self) -> Decimals {
        self.decimals
    }

    /// The text so far.
    pub fn text(&self) -> &[u8] {
        &self.text
    }

    /// The number of the line on which the next block begins, from 1.
    pub fn next_line(&self) -> usize {
        self.text.iter().filter(|b| **b == b'\n').count() + 1
    }

    /// The complete text.
    pub fn finish(self) -> Vec<u8> {
        self.text
    }

    /// Takes the finished part of the text, for programs that are written in pieces.
    pub fn take_text(&mut self) -> Vec<u8> {
        std::mem::take(&mut self.text)
    }

    /// Writes a block; moves to the present position are omitted.
    ///
    /// # Errors
    /// [`WriteError`]; nothing of the block is written then.
    pub fn write(&mut self, block: &Block<'_>) -> Result<(), WriteError> {
        match block {
            Block::Rapid(target) => self.straight(target, None),
            Block::Line(target, feed) => self.straight(target, Some(feed)),
            Block::Arc(target, arc, feed) => arc::write(self, target, arc, feed),
            Block::Hole(hole) => holes::first(self, hole),
            Block::NextHole(place) => holes::next(self, *place),
            Block::HolesEnd => {
                holes::end(self);
                Ok(())
            }
            Block::Start(heading) => self.start(heading),
            Block::Tool(call) => self.tool(call),
            Block::TipOn(words) => self.tip_on(*words),
            Block::TipOff => self.tip_off(),
            Block::End => self.by_template("end", &self.values()),
            Block::Text(text) => {
                self.lines(text);
                self.modal = Modal::default();
                Ok(())
            }
            Block::Comment(text) => {
                self.comment(text);
                Ok(())
            }
            Block::Spindle(turning, speed) => self.spindle(*turning, *speed),
            Block::Coolant(coolant) => {
                let word: &[u8] = match coolant {
                    Coolant::Mist => b"M7",
                    Coolant::Flood => b"M8",
                    Coolant::Off => b"M9",
                };
                self.line(word);
                Ok(())
            }
            Block::Dwell(seconds) => self.dwell(*seconds),
            Block::Message(text) => {
                self.message(text);
                Ok(())
            }
            Block::Stop { optional, message } => {
                self.stop(*optional, *message);
                Ok(())
            }
        }
    }

    fn straight(&mut self, target: &Target, feed: Option<&Feed>) -> Result<(), WriteError> {
        match self.control {
            Control::Heidenhain => heidenhain::straight(self, target, feed),
            Control::Fanuc | Control::Haas => fanuc::straight(self, target, feed),
            Control::LinuxCnc => linuxcnc::straight(self, target, feed),
            Control::Sinumerik840d => sinumerik::straight(self, target, feed),
        }
    }

    /// Its name in messages.
    fn control_name(&self) -> &'static str {
        match self.control {
            Control::Fanuc => "FANUC",
            Control::Haas => "HAAS",
            Control::LinuxCnc => "LinuxCNC",
            Control::Sinumerik840d => "SINUMERIK",
            Control::Heidenhain => "HEIDENHAIN",
        }
    }

    fn form(&self) -> Form {
        match self.control {
            Control::Fanuc | Control::Haas => Form::Point,
            Control::Heidenhain => Form::Signed,
            Control::LinuxCnc | Control::Sinumerik840d => Form::Plain,
        }
    }
}
