//! Lines of straight moves, which most lines of long programs are: axis words with plain numbers and F.
//!
//! A language executes such lines one after the other, without the detour over tokens and words. What only
//! it knows (codes, block numbers) it reads itself. Every line in doubt is left to the general way, before
//! anything of it has had an effect, so the outcome is the same.

use trueaxis_blocks::digits::short_number;

use super::{Core, Language};
use crate::moves::{Axis, Origin, Position};

/// What a letter is in a line of straight moves; axes are 0 to 8, small letters are as large ones.
const LETTERS: [u8; 256] = {
    let mut table = [OTHER; 256];
    let mut index = 0;
    while index < 9 {
        let letter = b"XYZABCUVW"[index];
        table[letter as usize] = index as u8;
        table[letter.to_ascii_lowercase() as usize] = index as u8;
        index += 1;
    }
    (table[b'F' as usize], table[b'f' as usize]) = (FEED, FEED);
    (table[b' ' as usize], table[b'\n' as usize], table[b'\r' as usize]) = (BLANK, END, END);
    table
};
const FEED: u8 = 9;
const BLANK: u8 = 10;
const END: u8 = 11;
const OTHER: u8 = 12;

/// The nine axes have the places that [`LETTERS`] gives them.
const _: () = assert!(Axis::X as usize == 0 && Axis::C as usize == 5 && Axis::W as usize == 8);

/// What is the same for all lines of straight moves until another kind of line comes.
pub(crate) struct Measure {
    /// Millimetres of one unit of length.
    pub unit_mm: f64,
    /// X counts half as much where it is a diameter.
    pub x_mm: f64,
    /// The unit of F in that of the feed.
    pub feed: f64,
    pub incremental: bool,
    /// What an absolute coordinate is added to: 0, or −0 where a written −0 remains −0.
    pub zero: f64,
}

/// What a line says.
pub(crate) struct Line {
    /// Where it leads, mm and degrees.
    pub target: [f64; 9],
    /// The axes that it names.
    pub named: u16,
    pub feed: Option<f64>,
    /// The byte after it.
    pub end: usize,
}

/// Reads the words of a line from a byte on. What is neither an axis word nor F with a number goes to
/// `other`, which tells the byte after it.
#[inline(always)]
pub(crate) fn read_line(
    measure: &Measure,
    source: &[u8],
    start: usize,
    from: &Position,
    mut other: impl FnMut(u8, usize) -> Option<usize>,
) -> Option<Line> {
    let mut line = Line { target: from.0, named: 0, feed: None, end: start };
    let mut at = start;
    loop {
        let byte = *source.get(at)?;
        let kind = LETTERS[usize::from(byte)];
        at += 1;
        match kind {
            0..=8 => {
                let index = usize::from(kind);
                let (value, after) = short_number(source, at)?;
                let bit = 1 << index;
                if line.named & bit != 0 {
                    return None;
                }
                line.named |= bit;
                let scale = match index {
                    0 => measure.x_mm,
                    3..=5 => 1.0,
                    _ => measure.unit_mm,
                };
                let base = if measure.incremental { line.target[index] } else { measure.zero };
                line.target[index] = base + value * scale;
                at = after;
            }
            BLANK => {}
            FEED => match short_number(source, at) {
                Some((value, after)) => {
                    if line.feed.is_some() || value < 0.0 {
                        return None;
                    }
                    line.feed = Some(value * measure.feed);
                    at = after;
                }
                None => at = other(byte, at)?,
            },
            END if byte == b'\n' => break,
            END if source.get(at) == Some(&b'\n') => {
                at += 1;
                break;
            }
            _ => at = other(byte, at)?,
        }
    }
    line.end = at;
    Some(line)
}

impl Core<'_> {
    /// Whether steps go to the machine as they come: neither a corner nor a compensated path waits for the
    /// next one, and no fault for the end of its block.
    pub fn is_direct(&self) -> bool {
        self.corners.are_off() && !self.has_radius() && !self.has_fault()
    }
}

/// Executes line after line from a byte on, as long as `one` executes it and tells where it ends; where the
/// next one begins, and its number.
#[inline(always)]
pub(crate) fn line_after_line<'r, L: Language<'r>>(
    run: &mut L,
    mut at: usize,
    mut origin: Origin,
    mut one: impl FnMut(&mut L, usize, Origin) -> Option<usize>,
) -> (usize, u32) {
    let settings = run.core().settings;
    while !settings.stop.is_requested()
        && let Some(next) = one(run, at, origin)
    {
        // What comes may have to tell where this line was.
        run.core().begin(origin.program as usize, at, origin.line);
        at = next;
        origin.line = origin.line.saturating_add(1);
    }
    (at, origin.line)
}
