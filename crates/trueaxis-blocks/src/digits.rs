//! Numbers of few digits, read eight bytes at once: those of lines of plain words.

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

/// A number of at most seven digits before and seven after its point, with or without a sign, and where it
/// ends. The value is exact: digits and power of ten fit in a double, so one division rounds correctly.
///
/// Most numbers have no more than eight signs, the point among them: it is taken out, and the digits
/// are read at once, without a jump that depends on their number.
#[inline(always)]
pub fn short_number(source: &[u8], start: usize) -> Option<(f64, usize)> {
    let sign = *source.get(start)?;
    let negative = sign == b'-';
    let at = start + usize::from(negative | (sign == b'+'));
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
            "+1",
            "+.25",
            "-0",
        ] {
            assert_eq!(of(text), Some((text.parse().unwrap(), text.len())), "{text}");
        }
        for text in ["", "-", ".", "123456789", "1.12345678", "+", "+-1"] {
            assert_eq!(of(text), None, "{text}");
        }
    }
}
