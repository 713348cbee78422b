//! Numbers as they are printed, in every text and document.

/// The shortest text that reads back as the same double: `3000`, `-49.5`, `1.5e-17`.
pub fn exact(value: f64) -> String {
    // + 0.0: no minus before a zero.
    let text = format!("{:?}", value + 0.0);
    text.strip_suffix(".0").map_or_else(|| text.clone(), str::to_owned)
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
    fn zero_has_no_sign() {
        assert_eq!(fixed(-0.00004, 4), "0.0000");
        assert_eq!(fixed(-0.00005001, 4), "-0.0001");
        assert_eq!(fixed(-10.0, 0), "-10");
    }
}
