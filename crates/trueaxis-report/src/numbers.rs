//! Numbers as they are printed, in every text and document.

use std::fmt::Write;

/// The shortest text that reads back as the same double: `3000`, `-49.5`, `1.5e-17`.
pub fn exact(value: f64) -> String {
    let mut text = String::new();
    push_exact(&mut text, value);
    text
}

/// The same at the end of a text.
pub fn push_exact(text: &mut String, value: f64) {
    // + 0.0: no minus before a zero.
    let value = value + 0.0;
    // Without an exponent JSON writes the same text, four times as fast; of large ones another of two digits that are as near.
    let mut bytes = [0; 32];
    let mut rest = &mut bytes[..];
    let is_plain = value == 0.0 || (1e-4..1e12).contains(&value.abs());
    if is_plain && serde_json::to_writer(&mut rest, &value).is_ok() {
        let left = rest.len();
        text.push_str(str::from_utf8(&bytes[..bytes.len() - left]).unwrap_or_default());
    } else {
        // A text takes everything.
        let _ = write!(text, "{value:?}");
    }
    if text.ends_with(".0") {
        text.truncate(text.len() - 2);
    }
}

/// A fixed number of digits after the point; no minus before what rounds to zero.
pub fn fixed(value: f64, digits: usize) -> String {
    let text = format!("{value:.digits$}");
    match text.strip_prefix('-') {
        Some(zero) if zero.chars().all(|c| matches!(c, '0' | '.')) => zero.to_owned(),
        _ => text,
    }
}

/// Twelve significant digits: hides the rounding of degrees to radians and back.
pub fn rounded(value: f64) -> f64 {
    format!("{value:.11e}").parse().unwrap_or(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_numbers_are_short_and_read_back() {
        for (value, text) in [
            (3000.0, "3000"),
            (-0.0, "0"),
            (-49.5043592817106, "-49.5043592817106"),
            (-1.5848095757158828e-17, "-1.5848095757158828e-17"),
            (1e300, "1e300"),
            (f64::MIN_POSITIVE, "2.2250738585072014e-308"),
        ] {
            assert_eq!(exact(value), text);
            assert_eq!(text.parse::<f64>(), Ok(value));
        }
    }

    #[test]
    fn law_exact_numbers_are_those_of_the_standard_library() {
        let mut bits = 0x9e37_79b9_7f4a_7c15_u64;
        let edges = [1e-4, 9.999e-5, 1e-5, 1e15, 1e16, 0.1, 123.0, 5e-324, f64::MAX, 1e-7];
        let drawn = (0..200_000).map(|i| {
            bits = bits
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            let any = f64::from_bits(bits);
            // Every second one of the size of positions.
            if i % 2 == 0 { any } else { (bits >> 11) as f64 * 1e-12 - 4000.0 }
        });
        for value in edges.into_iter().flat_map(|v| [v, -v]).chain(drawn).filter(|v| v.is_finite())
        {
            let plain = format!("{value:?}");
            assert_eq!(exact(value), plain.strip_suffix(".0").unwrap_or(&plain));
        }
    }

    #[test]
    fn zero_has_no_sign() {
        assert_eq!(fixed(-0.00004, 4), "0.0000");
        assert_eq!(fixed(-0.00005001, 4), "-0.0001");
        assert_eq!(fixed(-10.0, 0), "-10");
    }
}
