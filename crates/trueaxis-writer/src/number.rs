//! Numbers as controls read them: whole least increments, printed without rounding twice.

use crate::WriteError;

/// How numbers look.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Form {
    /// `5`, `-0.25`.
    Plain,
    /// `5.`, `-0.25`: FANUC counts a number without point in least increments.
    Point,
    /// `+5`, `-0.25`.
    Signed,
}

/// The most decimals that a style may ask for.
pub const MOST_DECIMALS: u8 = 9;

const POWERS: [u64; MOST_DECIMALS as usize + 1] =
    [1, 10, 100, 1_000, 10_000, 100_000, 1_000_000, 10_000_000, 100_000_000, 1_000_000_000];

/// Two digits at once.
const PAIRS: &[u8; 200] = b"0001020304050607080910111213141516171819\
2021222324252627282930313233343536373839\
4041424344454647484950515253545556575859\
6061626364656667686970717273747576777879\
8081828384858687888990919293949596979899";

/// 1.5 · 2⁵²: added to a number below 2⁵¹, it leaves no room for a fraction.
const ROUND: f64 = 6_755_399_441_055_744.0;

/// A value in whole least increments, halves to even.
pub(super) fn increments(value: f64, decimals: u8, word: &'static str) -> Result<i64, WriteError> {
    let scaled = value * POWERS[usize::from(decimals.min(MOST_DECIMALS))] as f64;
    // NaN fails the comparison too.
    if scaled.abs() < (1_u64 << 50) as f64 {
        Ok((scaled + ROUND).to_bits() as i64 - ROUND.to_bits() as i64)
    } else {
        Err(WriteError::Number { word, value })
    }
}

/// Appends least increments as a decimal number without trailing zeros.
pub(super) fn push(text: &mut Vec<u8>, increments: i64, decimals: u8, form: Form) {
    let mut room = [0_u8; 24];
    let mut at = room.len();
    let mut digits = decimals.min(MOST_DECIMALS);
    let power = POWERS[usize::from(digits)];
    let size = increments.unsigned_abs();
    let (mut whole, mut fraction) = (size / power, size % power);
    if fraction != 0 {
        while fraction.is_multiple_of(10) {
            fraction /= 10;
            digits -= 1;
        }
        while digits >= 2 {
            at -= 2;
            pair(&mut room[at..at + 2], fraction % 100);
            fraction /= 100;
            digits -= 2;
        }
        if digits == 1 {
            at -= 1;
            room[at] = b'0' + (fraction % 10) as u8;
        }
        at -= 1;
        room[at] = b'.';
    } else if form == Form::Point {
        at -= 1;
        room[at] = b'.';
    }
    let below_one = whole == 0;
    while whole >= 10 {
        at -= 2;
        pair(&mut room[at..at + 2], whole % 100);
        whole /= 100;
    }
    if whole > 0 || below_one {
        at -= 1;
        room[at] = b'0' + whole as u8;
    }
    match (increments < 0, form) {
        (true, _) => {
            at -= 1;
            room[at] = b'-';
        }
        (false, Form::Signed) => {
            at -= 1;
            room[at] = b'+';
        }
        _ => {}
    }
    text.extend_from_slice(&room[at..]);
}

fn pair(room: &mut [u8], value: u64) {
    let at = 2 * value as usize;
    room.copy_from_slice(&PAIRS[at..at + 2]);
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shown(value: f64, decimals: u8, form: Form) -> String {
        let mut text = Vec::new();
        push(&mut text, increments(value, decimals, "X").unwrap(), decimals, form);
        String::from_utf8(text).unwrap()
    }

    #[test]
    fn numbers_as_each_control_writes_them() {
        assert_eq!(shown(5.0, 3, Form::Point), "5.");
        assert_eq!(shown(0.0, 3, Form::Point), "0.");
        assert_eq!(shown(-0.0, 3, Form::Signed), "+0");
        assert_eq!(shown(-0.25, 4, Form::Plain), "-0.25");
        assert_eq!(shown(0.00004, 4, Form::Plain), "0");
        assert_eq!(shown(123_456.789, 3, Form::Signed), "+123456.789");
        assert_eq!(shown(100.05, 3, Form::Plain), "100.05");
        assert_eq!(shown(7.0, 0, Form::Plain), "7");
        assert_eq!(shown(10.0, 0, Form::Plain), "10");
        assert_eq!(shown(0.123_456_789, 9, Form::Plain), "0.123456789");
        assert!(increments(f64::NAN, 3, "X").is_err());
        assert!(increments(1e15, 3, "X").is_err());
    }

    #[test]
    fn printed_numbers_read_back_as_the_nearest_double() {
        for i in -20_000_i64..20_000 {
            let value = i * 7_919;
            let mut text = Vec::new();
            push(&mut text, value, 5, Form::Plain);
            let read: f64 = String::from_utf8(text).unwrap().parse().unwrap();
            assert_eq!(read, value as f64 / 1e5);
        }
    }
}
