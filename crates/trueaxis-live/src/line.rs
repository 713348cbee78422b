//! A control that corrects an axis along a straight line of its position, such as SINUMERIK: SD43900 + SD43910 · (x − SD43920).
//!
//! ```text
//!     v(x) = v₀ · (x₁ − x) / (x₁ − x₀)  +  v₁ · (x − x₀) / (x₁ − x₀)      x₀, x₁: ends of the travel
//! ```
//!
//! The run governs v₀ and v₁ as two offsets: between the ends v(x) is a mean of them with weights from 0 to 1, so limit, slew,
//! step and jump of the axis hold wherever it stands, whatever the slope is. docs/model.md eq. 244.

/// A straight line by its values at both ends of a travel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Line {
    /// Where it is stated. Unit: mm.
    pub ends: [f64; 2],
    /// What it is there. Unit: that of the values.
    pub values: [f64; 2],
}

impl Line {
    /// The line that is closest to values by their squares.
    ///
    /// # Examples
    /// By hand: 0, 1, 2 at 0, 10, 20 mm lie on one line, which is −1 at −10 and 3 at 30 mm.
    /// ```
    /// use trueaxis_live::line::Line;
    /// let line = Line::through(&[0.0, 10.0, 20.0], &[0.0, 1.0, 2.0], [-10.0, 30.0]);
    /// assert!((line.values[0] + 1.0).abs() < 1e-12 && (line.values[1] - 3.0).abs() < 1e-12);
    /// ```
    #[must_use]
    #[expect(clippy::cast_precision_loss, reason = "some tens of places")]
    pub fn through(places_mm: &[f64], values: &[f64], ends: [f64; 2]) -> Self {
        let count = places_mm.len().max(1) as f64;
        let middle = places_mm.iter().sum::<f64>() / count;
        let mean = values.iter().sum::<f64>() / count;
        let (mut products, mut squares) = (0.0, 0.0);
        for (place, value) in places_mm.iter().zip(values) {
            products += (place - middle) * (value - mean);
            squares += (place - middle) * (place - middle);
        }
        let slope = if squares > 0.0 { products / squares } else { 0.0 };
        Self { ends, values: ends.map(|end| mean + slope * (end - middle)) }
    }

    /// Its value at a position; beyond the ends it goes on, as the control does.
    #[must_use]
    pub fn at(&self, position_mm: f64) -> f64 {
        let [from, to] = self.ends;
        let part = (position_mm - from) / (to - from);
        self.values[0] * (1.0 - part) + self.values[1] * part
    }

    /// Change of the value for each mm. Unit: 1/mm of the values.
    #[must_use]
    pub fn slope(&self) -> f64 {
        (self.values[1] - self.values[0]) / (self.ends[1] - self.ends[0])
    }
}

/// Evenly spaced positions between the ends, both included. Unit: mm.
pub fn places(ends: [f64; 2]) -> [f64; PLACES] {
    #[expect(clippy::cast_precision_loss, reason = "below ten")]
    std::array::from_fn(|i| ends[0] + (ends[1] - ends[0]) * i as f64 / (PLACES - 1) as f64)
}

/// So many show the bow of a ball screw or a scale.
const PLACES: usize = 9;

/// One value for each axis from a list that has two, those of the ends, for an axis with a line.
pub fn at_positions(
    axes: impl Iterator<Item = (Option<[f64; 2]>, f64)>,
    mut values: impl Iterator<Item = f64>,
) -> impl Iterator<Item = f64> {
    axes.map_while(move |(ends, position)| {
        let first = values.next()?;
        let Some(ends) = ends else { return Some(first) };
        Some(Line { ends, values: [first, values.next()?] }.at(position))
    })
}
