//! The plain form of a point, `GOTO/x,y,z,i,j,k`, of which long files consist: found block by block, on any
//! thread, without what stands before it.

/// Files are looked through in blocks of so many bytes.
const BLOCK: usize = 1 << 18;

/// Whole numbers up to here are exact as doubles.
const EXACT: u64 = 1 << 53;

/// Powers of ten that are exact as doubles.
const POWERS: [f64; 23] = [
    1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16,
    1e17, 1e18, 1e19, 1e20, 1e21, 1e22,
];

/// A line that is such a point, if a statement begins with it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct PlainPoint {
    /// Where it begins, ends, and where the next line begins.
    pub span: [usize; 3],
    pub numbers: [f64; 6],
}

/// How many blocks a text has.
pub(super) fn blocks(source: &[u8]) -> usize {
    source.len().div_ceil(BLOCK)
}

/// The first line that begins at a place or after it.
fn line_from(source: &[u8], at: usize) -> usize {
    let Some(before) = at.checked_sub(1) else { return 0 };
    let rest = source.get(before..).unwrap_or_default();
    rest.iter().position(|b| *b == b'\n').map_or(source.len(), |i| before + i + 1)
}

/// The plain points of the lines that begin in a block.
pub(super) fn find(source: &[u8], block: usize, found: &mut Vec<PlainPoint>) {
    found.clear();
    let mut at = line_from(source, block * BLOCK);
    let end = (block + 1) * BLOCK;
    while at < end.min(source.len()) {
        match plain_point(source, at) {
            Some(point) => {
                at = point.span[2];
                found.push(point);
            }
            None => at = line_from(source, at + 1),
        }
    }
}

fn plain_point(source: &[u8], begin: usize) -> Option<PlainPoint> {
    let mut rest = source[begin..].strip_prefix(b"GOTO")?;
    rest = blanks(rest).strip_prefix(b"/")?;
    let mut numbers = [0.0; 6];
    for (i, number) in numbers.iter_mut().enumerate() {
        if i > 0 {
            rest = rest.strip_prefix(b",")?;
        }
        (*number, rest) = decimal(blanks(rest))?;
        rest = blanks(rest);
    }
    let end = source.len() - rest.len();
    rest = rest.strip_prefix(b"\r").unwrap_or(rest);
    let next = match rest {
        [] if source.len() == end => end,
        [b'\n', ..] => source.len() - rest.len() + 1,
        _ => return None,
    };
    Some(PlainPoint { span: [begin, end, next], numbers })
}

fn blanks(mut text: &[u8]) -> &[u8] {
    while let [b' ', rest @ ..] = text {
        text = rest;
    }
    text
}

/// A decimal number without an exponent and what follows it; none where its digits do not fit into a double
/// exactly, so that it needs more than one rounding.
///
/// m·10⁻ᵏ with m ≤ 2⁵³ and k ≤ 22 is one division of exact doubles, and so correctly rounded (Clinger 1990).
fn decimal(text: &[u8]) -> Option<(f64, &[u8])> {
    let (is_negative, mut text) = match text {
        [b'-', rest @ ..] => (true, rest),
        [b'+', rest @ ..] => (false, rest),
        _ => (false, text),
    };
    let (mut value, mut digits, mut decimals) = (0_u64, 0, None);
    loop {
        match text {
            [digit @ b'0'..=b'9', rest @ ..] => {
                // 19 digits fit; leading zeros count, and then cost the quick way only.
                if digits == 19 {
                    return None;
                }
                value = 10 * value + u64::from(digit - b'0');
                digits += 1;
                decimals = decimals.map(|k: usize| k + 1);
                text = rest;
            }
            [b'.', rest @ ..] if decimals.is_none() => {
                decimals = Some(0);
                text = rest;
            }
            _ => break,
        }
    }
    if digits == 0 || value > EXACT {
        return None;
    }
    let size = value as f64 / POWERS[decimals.unwrap_or(0)];
    Some((if is_negative { -size } else { size }, text))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn all(text: &str) -> Vec<PlainPoint> {
        let mut found = Vec::new();
        find(text.as_bytes(), 0, &mut found);
        found
    }

    #[test]
    fn plain_points_and_others() {
        let text = "GOTO/1,2.5,-3,0,0,1\r\nGOTO/1,2,3\nGOTO / +1. , .5,-0,0,0,1\nGOTO/1,2,3,0,0,1 $\n\
                    GOTO/1,2,3,0,0,1e0\n GOTO/1,2,3,0,0,1\nGOTO/1,2,3,0,0,.\nGOTO/7,2,3,0,0,1";
        let found = all(text);
        assert_eq!(found.len(), 3);
        assert_eq!(
            (found[0].span, found[0].numbers),
            ([0, 19, 21], [1.0, 2.5, -3.0, 0.0, 0.0, 1.0])
        );
        assert_eq!(found[1].numbers, [1.0, 0.5, 0.0, 0.0, 0.0, 1.0]);
        assert!(found[1].numbers[2].is_sign_negative());
        assert_eq!(found[2].span, [text.len() - 16, text.len(), text.len()]);
    }

    proptest! {
        /// The same double as the standard library reads.
        #[test]
        fn law_decimals_are_correctly_rounded(text in "[-+]?[0-9]{0,12}(\\.[0-9]{0,12})?") {
            if let Some((value, rest)) = decimal(text.as_bytes()) {
                prop_assert!(rest.is_empty());
                prop_assert_eq!(value.to_bits(), text.parse::<f64>().unwrap().to_bits());
            }
        }
    }
}
