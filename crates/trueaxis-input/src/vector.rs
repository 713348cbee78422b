//! Places and directions in text: `"0 0 -100 mm"`, `"0 1 1"`.

use crate::plausible::Quantity;
use crate::quantity::{Dimension, QuantityError, Unit, parse_quantity};
use crate::section::Item;

impl Item<'_> {
    /// So many lengths with one unit, in mm: `"0 0 -100 mm"`; `None` and a problem if they are none, or together longer than
    /// anything here is.
    pub fn lengths<const N: usize>(&self) -> Option<[f64; N]> {
        let words: Vec<&str> = self.text()?.split_whitespace().collect();
        let hint = "write \"x y z mm\", without a unit mm";
        let found =
            self.lengths_of::<N>(&words, if N == 3 { hint } else { "write \"80 60 mm\"" })?;
        let size = found.iter().map(|v| v * v).sum::<f64>().sqrt();
        self.is_possible(Quantity::Length, size).then_some(found)
    }

    /// The same of words of a text, of any size.
    pub fn lengths_of<const N: usize>(&self, words: &[&str], hint: &str) -> Option<[f64; N]> {
        let refuse = |message: String| {
            self.error("bad-place", message, hint);
            None
        };
        let is_number = |word: &&str| word.parse::<f64>().is_ok();
        let unit = match words.len().checked_sub(N) {
            // A unit in the place of a number: one number is missing.
            Some(0) if words.last().is_none_or(is_number) => "",
            Some(1) => words[N],
            _ => {
                let count = ["no", "one", "two", "three"].get(N).copied().unwrap_or("more");
                return refuse(format!("expected {count} lengths and their unit"));
            }
        };
        let unit = match Unit::find(unit, Dimension::Length) {
            Ok(unit) => unit,
            Err(e) => {
                self.error(e.code(), e.to_string(), &e.hint());
                return None;
            }
        };
        let mut lengths = [0.0; N];
        for (slot, number) in lengths.iter_mut().zip(words) {
            let value = parse_quantity(number, Dimension::Ratio).and_then(|v| unit.checked(v));
            match value {
                Ok(value) => *slot = value,
                Err(QuantityError::TooLarge(_, d)) => {
                    let e = QuantityError::TooLarge((*number).to_owned(), d);
                    self.error(e.code(), e.to_string(), &e.hint());
                    return None;
                }
                Err(_) => return refuse(format!("`{number}` is not a finite number")),
            }
        }
        Some(lengths)
    }

    /// A direction of any length, as a unit vector: `"0 1 1"`.
    pub fn direction(&self) -> Option<[f64; 3]> {
        let refuse = |message: &str| {
            self.error("bad-direction", message.to_owned(), "write a vector such as \"0 1 1\"");
            None
        };
        let words = self.text()?.split_whitespace();
        let numbers: Vec<Option<f64>> =
            words.map(|w| parse_quantity(w, Dimension::Ratio).ok()).collect();
        let [Some(x), Some(y), Some(z)] = numbers[..] else {
            return refuse("a direction needs three numbers");
        };
        let scale = x.abs().max(y.abs()).max(z.abs());
        if scale == 0.0 {
            return refuse("the direction has length zero");
        }
        let scaled = [x, y, z].map(|c| c / scale);
        let length = scaled.iter().map(|c| c * c).sum::<f64>().sqrt();
        Some(scaled.map(|c| c / length))
    }
}
