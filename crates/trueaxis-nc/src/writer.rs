//! Writes NC programs for the four controls.
//!
//! ```text
//!     Block (what every control can do) ──Writer──> text of one control
//!                                   Templates: start, tool call, tool-centre point, end
//! ```
//!
//! What is written reads back, by [`interpret`](crate::interpret), as the same moves to the least
//! increment. Words that would say nothing new are left out.
//!
//! ```
//! use trueaxis_nc::moves::{Axis, Feed, FeedMode};
//! use trueaxis_nc::writer::{Block, Heading, Target, Writer};
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
//! # Ok::<(), trueaxis_nc::writer::WriteError>(())
//! ```

mod fanuc;
mod heidenhain;
mod linuxcnc;
mod number;
mod sinumerik;
mod template;
mod words;

pub use number::MOST_DECIMALS;
pub use template::{BUILT_IN, Templates};

use crate::dialect::Control;
use crate::moves::{Axis, AxisSet, Coolant, Coordinates, Feed, FeedMode, Position, Turning};
use number::Form;

/// A block was written, or why not.
type Written = Result<(), WriteError>;

/// One block of a program, in words that all controls share.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Block<'a> {
    /// The beginning, by the template.
    Start(&'a Heading<'a>),
    /// A remark for people.
    Comment(&'a str),
    /// A tool comes into the spindle, by the template.
    Tool(&'a ToolCall<'a>),
    /// The spindle turns at a speed in revolutions per minute, or stops.
    Spindle(Turning, f64),
    /// Coolant on or off.
    Coolant(Coolant),
    /// From here on the tip of the tool is programmed (TCP), by the template.
    TipOn(TipWords),
    /// From here on axes are programmed again, by the template.
    TipOff,
    /// As fast as the machine can.
    Rapid(Target),
    /// A straight line with feed.
    Line(Target, Feed),
    /// Nothing moves for some seconds.
    Dwell(f64),
    /// A text on the screen.
    Message(&'a str),
    /// A stop, with a text for the operator.
    Stop {
        /// Only if the operator wished so.
        optional: bool,
        /// What the operator shall do.
        message: Option<&'a str>,
    },
    /// Lines of the control's own language, as they are; nothing is known to be modal behind them.
    Text(&'a str),
    /// The end, by the template.
    End,
}

/// What the program is called and what its first lines say.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Heading<'a> {
    /// Its name; letters, digits and `_` remain of it.
    pub name: &'a str,
    /// Its number where programs have one (FANUC's O word).
    pub number: u32,
    /// Remarks.
    pub comments: &'a [&'a str],
    /// Coordinates without tool-centre point are positions of the axes from the machine zero, tool
    /// length included; see [`axis_coordinates`].
    pub machine_coordinates: bool,
    /// How far corners may be rounded, mm (where the template asks for it).
    pub tolerance_mm: f64,
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

/// A tool and its speed.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ToolCall<'a> {
    /// Its number.
    pub number: u32,
    /// What it is, for people.
    pub text: &'a str,
    /// Revolutions per minute, for controls that name them with the tool.
    pub speed_per_minute: Option<f64>,
}

/// How the tool axis is written while the tip is programmed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TipWords {
    /// By the rotary axes: G43.4, TRAORI with A and C, TCPM AXIS POS.
    Angles,
    /// By a vector: G43.5 I J K, A3 B3 C3, LN TX TY TZ. LinuxCNC has none.
    Vectors,
}

/// Where a block leads.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Target {
    /// mm and degrees; of meaning for the named axes.
    pub place: Position,
    /// The axes that move.
    pub named: AxisSet,
    /// The tool axis, where it is written as a vector.
    pub direction: Option<[f64; 3]>,
    /// What the numbers count from.
    pub coordinates: Coordinates,
}

impl Target {
    /// With one more axis, mm or degrees.
    #[must_use]
    pub fn at(mut self, axis: Axis, value: f64) -> Self {
        self.place[axis] = value;
        self.named = self.named.with(axis);
        self
    }

    /// With a tool axis.
    #[must_use]
    pub fn along(self, direction: [f64; 3]) -> Self {
        Self { direction: Some(direction), ..self }
    }

    /// Counted from the machine zero.
    #[must_use]
    pub fn from_machine_zero(self) -> Self {
        Self { coordinates: Coordinates::Machine, ..self }
    }
}

/// What a program must have its axis positions counted from, if tool-centre point is not to be used
/// and no offset or tool length is to count.
///
/// HEIDENHAIN (M91) and LinuxCNC (G53) say so in each block. SINUMERIK switches offset and length
/// off (G500 D0); FANUC has neither, so that its G54 must be 0: the start templates do and say so
/// with [`Heading::machine_coordinates`].
pub fn axis_coordinates(control: Control) -> Coordinates {
    match control {
        Control::Heidenhain | Control::LinuxCnc => Coordinates::Machine,
        Control::Fanuc | Control::Sinumerik840d => Coordinates::Program,
    }
}

/// How many digits numbers have.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Decimals {
    /// Of mm: 4 is 0.1 µm.
    pub linear: u8,
    /// Of degrees: 5 turns a tool axis by less than 1e-7.
    pub angle: u8,
    /// Of the parts of a vector.
    pub vector: u8,
    /// Of feeds, speeds and times.
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

/// Why a block cannot be written.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum WriteError {
    /// A number that no control reads.
    #[error("{word} = {value} cannot be written: it is not finite or too large for a machine")]
    Number {
        /// The word.
        word: &'static str,
        /// Its value.
        value: f64,
    },
    /// A feed that is 0 to the least increment.
    #[error("the feed {value} is not above zero with {decimals} decimals, as a feed move needs")]
    Feed {
        /// What was asked for.
        value: f64,
        /// The decimals of the style.
        decimals: u8,
    },
    /// The control has no such word.
    #[error("{control} cannot write {what}; {instead}")]
    NotInDialect {
        /// Whose dialect.
        control: &'static str,
        /// What was asked for.
        what: &'static str,
        /// What to do.
        instead: &'static str,
    },
    /// A template that cannot be filled in.
    #[error("the template of the program does not work: {0}")]
    Template(String),
}

/// What the control was told last, in least increments; `None`: not known.
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
    vectors: bool,
    tool: u32,
    modal: Modal,
}

impl Writer {
    /// With the usual number of decimals and the built-in templates.
    pub fn new(control: Control) -> Self {
        Self::with(control, Decimals::default(), Templates::of(control))
    }

    /// With other decimals or templates.
    pub fn with(control: Control, decimals: Decimals, templates: Templates) -> Self {
        Self {
            control,
            decimals,
            templates,
            text: Vec::new(),
            number: 0,
            name: String::new(),
            machine_coordinates: false,
            vectors: false,
            tool: 1,
            modal: Modal::default(),
        }
    }

    /// How many digits numbers have.
    pub fn decimals(&self) -> Decimals {
        self.decimals
    }

    /// The text so far.
    pub fn text(&self) -> &[u8] {
        &self.text
    }

    /// The line that the next block begins, from 1.
    pub fn next_line(&self) -> usize {
        self.text.iter().filter(|b| **b == b'\n').count() + 1
    }

    /// The text.
    pub fn finish(self) -> Vec<u8> {
        self.text
    }

    /// Takes the text that is ready out, for programs that are written in pieces.
    pub fn take_text(&mut self) -> Vec<u8> {
        std::mem::take(&mut self.text)
    }

    /// Writes a block; moves that lead nowhere new are left out.
    ///
    /// # Errors
    /// [`WriteError`]; nothing of the block is written then.
    pub fn write(&mut self, block: &Block<'_>) -> Result<(), WriteError> {
        match block {
            Block::Rapid(target) => self.straight(target, None),
            Block::Line(target, feed) => self.straight(target, Some(feed)),
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
            Control::Fanuc => fanuc::straight(self, target, feed),
            Control::LinuxCnc => linuxcnc::straight(self, target, feed),
            Control::Sinumerik840d => sinumerik::straight(self, target, feed),
        }
    }

    fn form(&self) -> Form {
        match self.control {
            Control::Fanuc => Form::Point,
            Control::Heidenhain => Form::Signed,
            Control::LinuxCnc | Control::Sinumerik840d => Form::Plain,
        }
    }
}
