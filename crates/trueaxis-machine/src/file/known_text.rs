//! `[[known]]`: what is known of a combination of unknowns, with its covariance with all before it.

use trueaxis_input::{Item, Section};

/// u and the variance of a file agree to this share of it.
const SAME_U: f64 = 1e-6;

/// One `[[known]]` of a file of values and covariance.
#[derive(Debug, Clone)]
pub struct KnownRow {
    /// Names and shares of what is known.
    pub of: Vec<(String, f64)>,
    /// Its value. Unit: mm, rad, s or 1.
    pub value: f64,
    /// Its covariance with each row before it, its own variance last. Unit: that of the two values, multiplied.
    pub covariance: Vec<f64>,
    /// What of it is that of something that a machine file states with an uncertainty: its name, and how one standard uncertainty
    /// moves the value. Unit: that of the value.
    pub stated: Vec<(String, f64)>,
}

impl KnownRow {
    /// Reads the row that has so many before it.
    pub fn read(section: &Section<'_>, before: usize) -> Option<Self> {
        let numbers = |item: Item<'_>, name| {
            item.section(name, |s| {
                let entries = s.entries().into_iter();
                entries.map(|(key, _, item)| Some((key.to_owned(), item.number()?))).collect()
            })?
        };
        let of = section.require("of", "{ EX0C = 1.0 }").and_then(|i| numbers(i, "known.of"));
        let stated = section.get("stated").map_or(Some(Vec::new()), |i| numbers(i, "known.stated"));
        let number =
            |key| section.require(key, "in mm, rad, s or 1").and_then(|i: Item<'_>| i.number());
        let (value, u) = (number("value"), number("u"));
        let item = section.require("covariance", "with all before it, and its own variance")?;
        let covariance: Vec<f64> = item.list()?.iter().map(Item::number).collect::<Option<_>>()?;
        let (of, value, u): (Vec<(String, f64)>, _, _) = (of?, value?, u?);
        let stated: Vec<(String, f64)> = stated?;
        let variance = covariance.last().copied().unwrap_or(0.0);
        if covariance.len() != before + 1 {
            let message = format!("{} covariances, expected {}", covariance.len(), before + 1);
            item.error(
                "bad-covariance",
                message,
                "one with each [[known]] before it, its own variance last",
            );
            return None;
        }
        if u <= 0.0 || (variance - u * u).abs() > SAME_U * u * u {
            let message = format!("u is {u:e}, but the variance is {variance:e}");
            item.error("bad-covariance", message, "the last number is u², greater than 0");
            return None;
        }
        if of.iter().all(|(_, share)| *share == 0.0) {
            section.error(
                "bad-covariance",
                "this is known of nothing".into(),
                "of = { EX0C = 1.0 }",
            );
            return None;
        }
        Some(Self { of, value, covariance, stated })
    }
}
