//! A shorter cut for lines of straight moves, which most lines of long programs are.

use super::{Activation, Run};
use crate::moves::{Axis, AxisSet, FeedMode, Move, MoveKind, Origin, Position};
use crate::rs274::code::Motion;

/// What a letter is in a line of straight moves; axes are 0 to 8.
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
    (table[b'G' as usize], table[b'g' as usize]) = (CODE, CODE);
    (table[b'N' as usize], table[b'n' as usize]) = (NUMBER, NUMBER);
    (table[b' ' as usize], table[b'\n' as usize]) = (BLANK, END);
    table[b'\r' as usize] = END;
    table
};
const FEED: u8 = 9;
const CODE: u8 = 10;
const NUMBER: u8 = 11;
const BLANK: u8 = 12;
const END: u8 = 13;
const OTHER: u8 = 14;

const TENS: [f64; 8] = [1.0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7];
const WHOLE_TENS: [u64; 8] = [1, 10, 100, 1000, 10_000, 100_000, 1_000_000, 10_000_000];

/// The high bit of each byte that is no digit; digits come as their values.
#[inline(always)]
fn no_digits(digits: u64) -> u64 {
    const LOW: u64 = 0x7f7f_7f7f_7f7f_7f7f;
    // A byte above 9 carries into its own high bit, never into the next byte.
    (((digits & LOW) + 0x7676_7676_7676_7676) | digits) & !LOW
}

/// The value of the first `count` of eight digits: neighbours are put together as pairs, pairs of
/// pairs and halves.
#[inline(always)]
fn whole_number(digits: u64, count: u32) -> u64 {
    // Two shifts, since none may be by 64; the remaining bytes are at the end, with zeros before them.
    let half = 32 - 4 * count;
    let kept = (digits << half) << half;
    let pairs = kept.wrapping_mul(10).wrapping_add(kept >> 8) & 0x00ff_00ff_00ff_00ff;
    let fours = pairs.wrapping_mul(100).wrapping_add(pairs >> 16) & 0x0000_ffff_0000_ffff;
    fours.wrapping_mul(10_000).wrapping_add(fours >> 32) & 0xffff_ffff
}

/// Eight bytes, digits as their values.
#[inline(always)]
fn eight(source: &[u8], at: usize) -> Option<u64> {
    let bytes = u64::from_le_bytes(*source.get(at..)?.first_chunk()?);
    Some(bytes ^ 0x3030_3030_3030_3030)
}

/// A number of at most seven digits before and seven after its point, and where it ends. The value
/// is exact: digits and power of ten fit in a double, so one division rounds correctly.
///
/// Most numbers have no more than eight signs, the point among them: it is taken out, and the digits
/// are read at once, without a jump that depends on their number.
#[inline(always)]
fn short_number(source: &[u8], start: usize) -> Option<(f64, usize)> {
    let negative = *source.get(start)? == b'-';
    let at = start + usize::from(negative);
    let digits = eight(source, at)?;
    let others = no_digits(digits);
    let first = others & others.wrapping_neg();
    let point = first & !no_digits_but(digits, b'.' ^ b'0');
    let has_point = u32::from(point != 0);
    let signs = (others ^ point).trailing_zeros() / 8;
    let count = signs - has_point;
    let before = (first >> 7).wrapping_sub(1);
    let joined = (digits & before) | ((digits >> (8 * has_point)) & !before);
    let decimals = has_point * (signs.wrapping_sub(first.trailing_zeros() / 8 + 1) & 7);
    let after = at + signs as usize;
    let next = *source.get(after)?;
    if count == 0 || (signs == 8) & (next.is_ascii_digit() | (next == b'.')) {
        return long_number(source, at, negative);
    }
    let value = whole_number(joined, count) as i64 as f64 / TENS[decimals as usize & 7];
    Some((signed(value, negative), after))
}

/// The high bit of each byte that is not `digit` (below 128).
#[inline(always)]
fn no_digits_but(digits: u64, digit: u8) -> u64 {
    const LOW: u64 = 0x7f7f_7f7f_7f7f_7f7f;
    let same = digits ^ (0x0101_0101_0101_0101 * u64::from(digit));
    (((same & LOW) + LOW) | same) & !LOW
}

#[inline(always)]
fn signed(value: f64, negative: bool) -> f64 {
    f64::from_bits(value.to_bits() ^ u64::from(negative) << 63)
}

/// The same for more characters: the parts before and after the point separately.
#[inline(never)]
fn long_number(source: &[u8], at: usize, negative: bool) -> Option<(f64, usize)> {
    let part = |at: usize| -> Option<(u32, u64)> {
        let digits = eight(source, at)?;
        let count = no_digits(digits).trailing_zeros() / 8;
        (count < 8).then(|| (count, whole_number(digits, count)))
    };
    let (before, whole) = part(at)?;
    let end = at + before as usize;
    if source[end] != b'.' {
        return (before > 0).then(|| (signed(whole as f64, negative), end));
    }
    let (decimals, rest) = part(end + 1)?;
    if before + decimals == 0 {
        return None;
    }
    let power = decimals as usize;
    let value = (whole * WHOLE_TENS[power] + rest) as f64 / TENS[power];
    Some((signed(value, negative), end + 1 + power))
}

/// What is the same for all lines of straight moves until another kind of line comes.
struct Straight {
    unit_mm: f64,
    /// X counts half as much where it is a diameter.
    x_mm: f64,
    incremental: bool,
}

/// What a line says.
struct Line {
    target: [f64; 9],
    named: u16,
    motion: Option<Motion>,
    feed: Option<f64>,
    number: Option<f64>,
    end: usize,
}

impl Run<'_> {
    /// Executes the lines of straight moves that come next, and nothing else.
    ///
    /// Most lines of long programs hold G0 or G1 (or nothing, where that lasts), axis words with
    /// plain numbers, F and N. They are executed without the detour over words and actions. Every
    /// line in doubt is left to the others, before anything of it has had an effect, so the
    /// outcome is the same.
    pub(super) fn straight_lines(&mut self, source: &[u8]) {
        let Some(&Activation { program, mut at, mut line, .. }) = self.stack.last() else { return };
        let modes = &self.modes;
        let lasting = matches!(modes.motion, Some(Motion::Rapid | Motion::Linear));
        let special = modes.vectors
            || modes.data_input
            || !modes.macros.is_empty()
            || modes.transforms.polar.is_some()
            || modes.dynamic.is_on()
            || self.core.has_radius()
            || self.core.modes.feed.mode == FeedMode::InverseTime;
        if !lasting || special {
            return;
        }
        let unit_mm = self.core.modes.unit_mm();
        let x_mm = if self.core.modes.diameter { unit_mm / 2.0 } else { unit_mm };
        let common = Straight { unit_mm, x_mm, incremental: self.core.modes.incremental };
        let mut origin = Origin { program: program as u32, line };
        let stop = &self.core.settings.stop;
        while !stop.is_requested()
            && let Some(next) = self.straight_line(&common, source, at, origin)
        {
            // What comes may have to tell where this line was.
            (self.core.start, self.core.origin) = (at, origin);
            at = next;
            line += 1;
            origin.line = line;
        }
        if let Some(frame) = self.stack.last_mut() {
            (frame.at, frame.line) = (at, line);
        }
    }

    #[inline(always)]
    fn straight_line(
        &mut self,
        common: &Straight,
        source: &[u8],
        start: usize,
        origin: Origin,
    ) -> Option<usize> {
        let line = read_line(common, source, start, &self.frames.position)?;
        let motion = line.motion.or(self.modes.motion)?;
        let feed = line.feed.unwrap_or(self.core.modes.feed.value);
        let linear = motion == Motion::Linear;
        if linear && line.named != 0 && feed <= 0.0 {
            return None;
        }
        self.core.modes.feed.value = feed;
        if line.motion.is_some() {
            (self.modes.motion, self.modes.base) = (Some(motion), motion);
        }
        if let Some(number) = line.number {
            self.modes.last[1] = number;
        }
        if line.named != 0 {
            let kind = if linear { MoveKind::Linear } else { MoveKind::Rapid };
            let target = Position(line.target);
            self.frames.position = target;
            let named = AxisSet(line.named);
            let step = Move::plain(kind, target, named, self.core.modes.feed, origin);
            self.core.emit_move(step);
        }
        Some(line.end)
    }
}

#[inline(always)]
fn read_line(common: &Straight, source: &[u8], start: usize, from: &Position) -> Option<Line> {
    let mut line =
        Line { target: from.0, named: 0, motion: None, feed: None, number: None, end: start };
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
                    0 => common.x_mm,
                    3..=5 => 1.0,
                    _ => common.unit_mm,
                };
                let base = if common.incremental { line.target[index] } else { 0.0 };
                line.target[index] = base + value * scale;
                at = after;
            }
            BLANK => {}
            FEED => {
                let (value, after) = short_number(source, at)?;
                if line.feed.is_some() || value < 0.0 {
                    return None;
                }
                line.feed = Some(value * common.unit_mm);
                at = after;
            }
            CODE => {
                let (value, after) = short_number(source, at)?;
                let motion = if value == 1.0 { Motion::Linear } else { Motion::Rapid };
                if line.motion.is_some() || value != 0.0 && value != 1.0 {
                    return None;
                }
                line.motion = Some(motion);
                at = after;
            }
            NUMBER => {
                let (value, after) = short_number(source, at)?;
                line.number = Some(value);
                at = after;
            }
            END if byte == b'\n' => break,
            END if source.get(at) == Some(&b'\n') => {
                at += 1;
                break;
            }
            _ => return None,
        }
    }
    line.end = at;
    Some(line)
}

/// The nine axes have the places that [`LETTERS`] gives them.
const _: () = assert!(Axis::X as usize == 0 && Axis::C as usize == 5 && Axis::W as usize == 8);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_of_any_length_up_to_seven_digits_each_side() {
        let of = |text: &str| short_number(format!("{text} X1.000000000").as_bytes(), 0);
        for text in [
            "1",
            "-1",
            "12.5",
            ".5",
            "5.",
            "-0.001",
            "1234567.7654321",
            "007.50",
            "359.1234",
            "12345678",
            "1234567.",
        ] {
            assert_eq!(of(text), Some((text.parse().unwrap(), text.len())), "{text}");
        }
        for text in ["", "-", ".", "123456789", "1.12345678", "+1"] {
            assert_eq!(of(text), None, "{text}");
        }
    }
}
