//! Numbers as they are put into a program.

use trueaxis_nc::Control;

/// The least increments of the control.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Increments {
    /// Of linear axes, mm.
    pub linear_mm: f64,
    /// Of rotary axes, degrees.
    pub rotary_deg: f64,
}

impl Default for Increments {
    /// 1 µm and 0.0001°.
    fn default() -> Self {
        Self { linear_mm: 1e-3, rotary_deg: 1e-4 }
    }
}

/// Of directions of the tool: finer than any increment of a rotary axis.
const VECTOR: f64 = 1e-8;

/// How numbers are rounded and what is too little to be written.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Grid(pub Option<Increments>);

/// What a number says.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Of {
    /// mm.
    Linear,
    /// Degrees.
    Rotary,
    /// Part of a direction.
    Direction,
}

impl Grid {
    fn step(self, of: Of) -> Option<f64> {
        self.0.map(|i| match of {
            Of::Linear => i.linear_mm,
            Of::Rotary => i.rotary_deg,
            Of::Direction => VECTOR,
        })
    }

    /// The nearest number that is written.
    pub fn round(self, value: f64, of: Of) -> f64 {
        // `step` is 1/n or n: whole multiples come out as their nearest doubles.
        match self.step(of) {
            Some(step) if step < 1.0 => {
                let parts = (1.0 / step).round();
                if (parts * step - 1.0).abs() < 1e-9 {
                    (value * parts).round() / parts
                } else {
                    (value / step).round() * step
                }
            }
            Some(step) => (value / step).round() * step,
            None => value,
        }
    }

    /// Whether two numbers are one when written; without rounding their difference is that of
    /// double precision at the size of a machine.
    pub fn same(self, a: f64, b: f64, of: Of) -> bool {
        let least = match (self.step(of), of) {
            (Some(step), _) => 0.5 * step,
            (None, Of::Direction) => 2e-15,
            (None, Of::Linear | Of::Rotary) => 1e-11,
        };
        (a - b).abs() <= least
    }

    /// The text of a number, as long as it has to be.
    pub fn text(self, value: f64, of: Of, control: Control) -> String {
        let value = value + 0.0;
        let mut text = match self.step(of) {
            Some(step) => {
                let digits = (-step.log10()).ceil().clamp(0.0, 12.0) as usize;
                let mut text = format!("{value:.digits$}");
                if text.contains('.') {
                    text.truncate(text.trim_end_matches('0').trim_end_matches('.').len());
                }
                text
            }
            None => format!("{value}"),
        };
        if text == "-0" {
            text.remove(0);
        }
        match control {
            Control::Fanuc | Control::Haas if !text.contains('.') => text.push('.'),
            Control::Heidenhain if !text.starts_with('-') => text.insert(0, '+'),
            _ => {}
        }
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_whole_increments() {
        let grid = Grid(Some(Increments::default()));
        assert_eq!(
            grid.text(grid.round(12.3456, Of::Linear), Of::Linear, Control::Fanuc),
            "12.346"
        );
        assert_eq!(grid.text(-0.00001, Of::Linear, Control::Sinumerik840d), "0");
        assert_eq!(grid.text(5.0, Of::Rotary, Control::Heidenhain), "+5");
        assert_eq!(Grid(None).text(0.1 + 0.2, Of::Linear, Control::Fanuc), "0.30000000000000004");
        assert!(grid.same(1.0004, 1.0, Of::Linear) && !grid.same(1.0006, 1.0, Of::Linear));
    }
}
