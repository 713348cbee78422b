//! Numbers of expressions: none that is not finite goes on; angles are degrees.

use crate::text::program::{Fault, fault};

/// No word is larger, so that no sum of words leaves the range of numbers.
pub(crate) const LARGEST: f64 = 1e12;

pub(crate) fn finite(value: f64, at: usize) -> Result<f64, Fault> {
    if value.is_finite() {
        return Ok(value);
    }
    Err(fault("not-finite", at, "the result is not a finite number", "check the values"))
}

pub(crate) fn not_zero(divisor: f64, at: usize) -> Result<f64, Fault> {
    if divisor != 0.0 {
        return Ok(divisor);
    }
    Err(fault("division-by-zero", at, "division by zero", "check the divisor"))
}

pub(crate) fn out_of_domain(name: &str, x: f64, at: usize) -> Fault {
    fault("out-of-domain", at, format!("{name} of {x} is not defined"), "check the argument")
}

/// The functions that every language knows, by their name.
pub(crate) fn function(name: &str, x: f64, at: usize) -> Result<Option<f64>, Fault> {
    let value = match name {
        "SIN" => x.to_radians().sin(),
        "COS" => x.to_radians().cos(),
        "TAN" => x.to_radians().tan(),
        "ASIN" => x.asin().to_degrees(),
        "ACOS" => x.acos().to_degrees(),
        "SQRT" => x.sqrt(),
        "ABS" => x.abs(),
        "EXP" => x.exp(),
        "LN" if x > 0.0 => x.ln(),
        "LN" => f64::NAN,
        _ => return Ok(None),
    };
    if value.is_nan() && !x.is_nan() {
        return Err(out_of_domain(name, x, at));
    }
    finite(value, at).map(Some)
}
