//! Addresses in the PMC.

use std::fmt;

/// Areas with their numbers in the calls.
const AREAS: [(char, i32); 9] =
    [('G', 0), ('F', 1), ('Y', 2), ('X', 3), ('A', 4), ('R', 5), ('T', 6), ('K', 7), ('D', 9)];

/// A byte of the PMC, such as `R1000`.
///
/// ```
/// use trueaxis_live::focas::{PmcAddress, PmcBit};
/// let address = PmcAddress::parse("R1000").unwrap();
/// assert_eq!((address.area(), address.byte), (5, 1000));
/// assert_eq!(address.to_string(), "R1000");
/// assert_eq!(PmcBit::parse("F120.3").unwrap().bit, 3);
/// assert_eq!(PmcAddress::parse("Q1"), None);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PmcAddress {
    /// The letter of the area.
    pub letter: char,
    /// The byte.
    pub byte: u16,
}

impl PmcAddress {
    /// Reads it; none if it is none.
    pub fn parse(text: &str) -> Option<Self> {
        let letter = text.chars().next()?;
        let byte = text.get(1..)?.parse().ok().filter(|byte| *byte < 60_000)?;
        AREAS.iter().any(|(known, _)| *known == letter).then_some(Self { letter, byte })
    }

    /// The number of its area.
    pub fn area(self) -> i32 {
        AREAS.iter().find(|(letter, _)| *letter == self.letter).map_or(0, |(_, number)| *number)
    }
}

impl fmt::Display for PmcAddress {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}{}", self.letter, self.byte)
    }
}

/// One bit of a byte, such as `R1040.0`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PmcBit {
    /// Its byte.
    pub byte: PmcAddress,
    /// 0 to 7.
    pub bit: u8,
}

impl PmcBit {
    /// Reads it; none if it is none.
    pub fn parse(text: &str) -> Option<Self> {
        let (byte, bit) = text.split_once('.')?;
        let bit = bit.parse().ok().filter(|bit| *bit < 8)?;
        Some(Self { byte: PmcAddress::parse(byte)?, bit })
    }

    /// Whether it is set in its byte.
    pub fn is_set(self, byte: u8) -> bool {
        byte >> self.bit & 1 == 1
    }
}

/// What the builder of the machine has agreed with the ladder; all of it facts of one machine.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PmcAreas {
    /// Double words, one for each live axis: the offsets that are commanded.
    pub command: PmcAddress,
    /// Double words: the offsets that act, after the limits and the ramp of the ladder.
    pub acting: PmcAddress,
    /// The byte that changes with every cycle.
    pub heartbeat: PmcAddress,
    /// Set here: feed hold with the alarm.
    pub ask_hold: PmcBit,
    /// Set by the ladder: its watchdog has tripped.
    pub tripped: PmcBit,
}
