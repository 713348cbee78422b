//! Names of bodies and errors by ISO 230-1, with the forms that are accepted on input.

use std::fmt;

/// The name of a body of the chain: an axis by its ISO 841 letter, the workpiece `w`, the tool `t`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct BodyName(char);

impl BodyName {
    /// The workpiece with its fixture on the last body of its side of the chain.
    pub const WORKPIECE: Self = Self('w');
    /// The tool with its holder in the spindle.
    pub const TOOL: Self = Self('t');

    /// The body of a letter: X Y Z U V W (linear), A B C (rotary), w, t.
    pub fn new(letter: char) -> Option<Self> {
        "XYZUVWABCwt".contains(letter).then_some(Self(letter))
    }

    /// The letter.
    pub fn letter(self) -> char {
        self.0
    }

    /// Whether an axis of this letter turns: A, B, C (ISO 841).
    pub fn is_rotary(self) -> bool {
        matches!(self.0, 'A' | 'B' | 'C')
    }

    /// Whether this is an axis, not the workpiece or the tool.
    pub fn is_axis(self) -> bool {
        self.0.is_ascii_uppercase()
    }
}

impl fmt::Display for BodyName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.0)
    }
}

/// In which direction an error shifts (X, Y, Z) or turns (A, B, C) its body.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Component {
    /// Shift along X.
    X,
    /// Shift along Y.
    Y,
    /// Shift along Z.
    Z,
    /// Rotation about X.
    A,
    /// Rotation about Y.
    B,
    /// Rotation about Z.
    C,
}

impl Component {
    /// All six, in the order of every array of six in this crate.
    pub const ALL: [Self; 6] = [Self::X, Self::Y, Self::Z, Self::A, Self::B, Self::C];

    /// The letter of ISO 230-1.
    pub fn letter(self) -> char {
        ['X', 'Y', 'Z', 'A', 'B', 'C'][self as usize]
    }

    /// Whether it turns rather than shifts.
    pub fn is_rotation(self) -> bool {
        self as usize >= 3
    }

    fn of_letter(letter: char) -> Option<Self> {
        Self::ALL.into_iter().find(|c| c.letter() == letter)
    }
}

/// Constant or function of the position.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum ErrorKind {
    /// A constant: where and how the body sits on its predecessor.
    Location,
    /// A function of the programmed position of the axis.
    Motion,
}

/// An error by its ISO 230-1 name: `EXX` (error motion of X), `EC0Y` (location error of Y).
///
/// ```
/// use trueaxis_machine::errors::ErrorName;
/// assert_eq!(ErrorName::parse("EC0Y").unwrap().to_string(), "EC0Y");
/// assert_eq!(ErrorName::parse("C0Y").unwrap().to_string(), "EC0Y"); // vendors leave the E out
/// assert_eq!(ErrorName::parse("XOC").unwrap().to_string(), "EX0C"); // and type the letter O
/// assert!(ErrorName::parse("EQX").is_none());
/// ```
///
/// # Source
/// ISO 230-1:2012, annex A: E, direction of the error, axis; a 0 between them marks a
/// location error. The errors of the mounting of the workpiece and of the tool holder have no
/// name there; here they are `EX0w … EC0w` and `EX0t … EC0t`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ErrorName {
    /// The body that is displaced.
    pub body: BodyName,
    /// Constant or function of position.
    pub kind: ErrorKind,
    /// The direction.
    pub component: Component,
}

impl ErrorName {
    /// Reads the ISO form or a vendor's alias; `None` if it is neither.
    pub fn parse(text: &str) -> Option<Self> {
        let letters: Vec<char> = text.chars().collect();
        let (component, zero, body) = match letters[..] {
            ['E', component, zero @ ('0' | 'O'), body] => (component, Some(zero), body),
            ['E', component, body] => (component, None, body),
            [component, zero @ ('0' | 'O'), body] => (component, Some(zero), body),
            _ => return None,
        };
        let kind = if zero.is_some() { ErrorKind::Location } else { ErrorKind::Motion };
        let body = BodyName::new(body)?;
        if kind == ErrorKind::Motion && !body.is_axis() {
            return None;
        }
        Some(Self { body, kind, component: Component::of_letter(component)? })
    }
}

impl fmt::Display for ErrorName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let zero = if self.kind == ErrorKind::Location { "0" } else { "" };
        write!(f, "E{}{zero}{}", self.component.letter(), self.body)
    }
}
