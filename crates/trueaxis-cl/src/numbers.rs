//! The numbers of a file, and which of them it can mean.

/// The reason why a statement cannot be used: code, message, hint.
pub(super) type Fault = (&'static str, String, &'static str);

/// Largest accepted coordinate.
const MAX_COORDINATE_MM: f64 = 1e7;

/// Whether a place is one that a file means.
pub(super) fn is_near(place_mm: &[f64; 3]) -> bool {
    place_mm.iter().all(|v| v.abs() < MAX_COORDINATE_MM)
}

pub(super) fn norm(vector: &[f64; 3]) -> f64 {
    vector.iter().map(|v| v * v).sum::<f64>().sqrt()
}

pub(super) fn is_direction(norm: f64) -> bool {
    norm > 1e-3 && norm < 1e9
}

/// The number of a tool or of an offset.
pub(super) fn whole_number(text: &str) -> Result<u32, Fault> {
    match number(text)? {
        n if (0.0..1e8).contains(&n) && n.fract() == 0.0 => Ok(n as u32),
        n => Err(("bad-tool", format!("{n} is not the number of a tool"), "write LOADTL/1")),
    }
}

pub(super) fn number(text: &str) -> Result<f64, Fault> {
    match text.parse::<f64>() {
        Ok(value) if value.is_finite() => Ok(value),
        _ => {
            let words: Vec<&str> = text.split_whitespace().collect();
            let shown: String = words.join(" ").chars().take(40).collect();
            let message = match text.is_empty() {
                true => "a number is missing".to_owned(),
                false => format!("`{shown}` is not a number"),
            };
            Err(("bad-number", message, "write a number such as 12.5 or -3"))
        }
    }
}
