//! Numbers as they are put into a program.

use std::fmt::Write;
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

/// A correction that is added to a computed value leads to the number that would be written without
/// variables, within this: mm or degrees.
const SUM: f64 = 1e-9;

/// The same of directions. Unit: 1.
const SUM_OF_DIRECTION: f64 = 1e-12;

/// Of directions of the tool: finer than any increment of a rotary axis.
const VECTOR: f64 = 1e-8;

/// How numbers are rounded and what is too little to be written. Values are in mm and degrees, whatever
/// the unit of the program.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Grid {
    pub increments: Option<Increments>,
    pub unit: Unit,
    /// The digits after the point of numbers of each kind that are written on the grid.
    digits: [usize; 3],
}

/// The unit of lengths in a block.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) enum Unit {
    #[default]
    Millimetre,
    Inch,
}

impl Unit {
    /// The factor of a written length to mm.
    pub fn mm(self) -> f64 {
        match self {
            Self::Millimetre => 1.0,
            Self::Inch => 25.4,
        }
    }
}

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
    /// By the increments of the control; without them numbers are written in full.
    pub fn of(increments: Option<Increments>, unit: Unit) -> Self {
        let mut grid = Self { increments, unit, digits: [0; 3] };
        for of in [Of::Linear, Of::Rotary, Of::Direction] {
            grid.digits[of as usize] =
                grid.step(of).map_or(0, |step| (-step.log10()).ceil().clamp(0.0, 12.0) as usize);
        }
        grid
    }

    /// The factor of a written number to mm or degrees.
    fn scale(self, of: Of) -> f64 {
        match of {
            Of::Linear => self.unit.mm(),
            Of::Rotary | Of::Direction => 1.0,
        }
    }

    /// The step of written numbers. Numbers in inches have as many decimals as bring them to the increment in
    /// mm or below: 0.00001 in for 1 µm.
    fn step(self, of: Of) -> Option<f64> {
        self.increments.map(|i| match of {
            Of::Linear if self.unit == Unit::Inch => {
                10.0_f64.powf((i.linear_mm / 25.4 * (1.0 + 1e-9)).log10().floor())
            }
            Of::Linear => i.linear_mm,
            Of::Rotary => i.rotary_deg,
            Of::Direction => VECTOR,
        })
    }

    /// The nearest number that is written.
    pub fn round(self, value: f64, of: Of) -> f64 {
        let scale = self.scale(of);
        self.round_written(value / scale, of) * scale
    }

    fn round_written(self, value: f64, of: Of) -> f64 {
        let Some(step) = self.step(of) else { return value };
        // 1/n or n: whole multiples come out as their nearest doubles.
        let parts = (1.0 / step).round();
        let is_part = step < 1.0 && (parts * step - 1.0).abs() < 1e-9;
        if is_part { (value * parts).round() / parts } else { (value / step).round() * step }
    }

    /// Whether two numbers are one when written; without rounding their difference is that of
    /// double precision at the size of a machine.
    pub fn same(self, a: f64, b: f64, of: Of) -> bool {
        let least = match (self.step(of), of) {
            (Some(step), _) => 0.5 * step * self.scale(of),
            (None, Of::Direction) => 2e-15,
            (None, Of::Linear | Of::Rotary) => 1e-11,
        };
        (a - b).abs() <= least
    }

    /// The digits of what is added to a computed value: as many as lead to the written number; `None`
    /// if nothing is to be added.
    pub fn difference(self, by: f64, of: Of) -> Option<String> {
        let near = if of == Of::Direction { SUM_OF_DIRECTION } else { SUM } / self.scale(of);
        let size = (by / self.scale(of)).abs();
        let least = match self.step(of) {
            Some(_) if size <= near => return None,
            Some(_) => self.digits[of as usize],
            None => return (size > 0.0).then(|| format!("{size}")),
        };
        let written = |digits: usize| (10_f64.powi(digits as i32), digits);
        let is_near =
            |(scale, _): &(f64, usize)| ((size * scale).round() / scale - size).abs() <= near;
        let digits = (least..15).map(written).find(is_near).map_or(15, |(_, digits)| digits);
        let text = format!("{size:.digits$}");
        Some(match text.contains('.') {
            true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
            false => text,
        })
    }

    /// The text of a number, as long as it has to be.
    pub fn text(self, value: f64, of: Of, control: Control) -> String {
        let mut text = String::new();
        self.write(&mut text, value, of, control);
        text
    }

    /// Puts the text of a number after another text.
    pub fn write(self, text: &mut String, value: f64, of: Of, control: Control) {
        let from = text.len();
        let value = value / self.scale(of) + 0.0;
        let digits = match self.step(of) {
            Some(_) => Some(self.digits[of as usize]),
            // 3 in are 76.2 mm, and 76.2 / 25.4 is 2.9999999999999996.
            None if self.scale(of) != 1.0 => Some(12),
            None => None,
        };
        match digits {
            Some(digits) => decimal(text, value, digits),
            None => put(text, format_args!("{value}")),
        }
        if digits.is_some() && text[from..].contains('.') {
            let kept = text[from..].trim_end_matches('0').trim_end_matches('.').len();
            text.truncate(from + kept);
        }
        if &text[from..] == "-0" {
            text.remove(from);
        }
        match control {
            Control::Fanuc | Control::Haas if !text[from..].contains('.') => text.push('.'),
            Control::Heidenhain if !text[from..].starts_with('-') => text.insert(from, '+'),
            _ => {}
        }
    }
}

/// The largest number of least digits that [`decimal`] counts: one more or less of them is more than rounding.
const COUNTED: f64 = 1e15;

/// A value with so many digits after the point. Values on the grid are whole multiples of the last digit, and the long way to
/// digits, which is right for any value, is not needed.
fn decimal(text: &mut String, value: f64, digits: usize) {
    let size = value.abs() * 10_f64.powi(digits as i32);
    let whole = size.round();
    // Not a number and halves go the long way.
    if digits == 0 || !(whole < COUNTED && (size - whole).abs() < 0.25) {
        return put(text, format_args!("{value:.digits$}"));
    }
    let mut bytes = [b'0'; 32];
    let (mut rest, mut at) = (whole as u64, bytes.len());
    let point = bytes.len() - digits - 1;
    while rest > 0 || at > point - 1 {
        at -= 1;
        if at == point {
            bytes[at] = b'.';
            continue;
        }
        bytes[at] = b'0' + (rest % 10) as u8;
        rest /= 10;
    }
    if value.is_sign_negative() {
        at -= 1;
        bytes[at] = b'-';
    }
    text.push_str(std::str::from_utf8(&bytes[at..]).unwrap_or_default());
}

fn put(text: &mut String, words: std::fmt::Arguments<'_>) {
    // A text takes everything.
    let _ = text.write_fmt(words);
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The library of the language is the judge: on the grid, near it, at halves, and where nothing is counted.
    #[test]
    fn law_digits_are_those_of_the_long_way() {
        let mut random = 88_172_645_463_325_252_u64;
        for k in 0..200_000 {
            random ^= random << 13;
            random ^= random >> 7;
            random ^= random << 17;
            let digits = k % 13;
            let scale = 10_f64.powi(digits as i32);
            let whole = (random >> (11 + k % 47)) as f64;
            let part = [0.0, 0.5, 0.2, 0.3][k % 4];
            let value = (whole + part) / scale * if random & 1 == 0 { 1.0 } else { -1.0 };
            let mut text = String::new();
            decimal(&mut text, value, digits);
            assert_eq!(text, format!("{value:.digits$}"), "{value:e} {digits}");
        }
        for value in [0.0, -0.0, f64::NAN, f64::INFINITY, 1e15, 1e300, -1e-9, 0.05, 0.15] {
            let mut text = String::new();
            decimal(&mut text, value, 1);
            assert_eq!(text, format!("{value:.1}"));
        }
    }

    #[test]
    fn numbers_are_whole_increments() {
        let grid = Grid::of(Some(Increments::default()), Unit::Millimetre);
        assert_eq!(
            grid.text(grid.round(12.3456, Of::Linear), Of::Linear, Control::Fanuc),
            "12.346"
        );
        assert_eq!(grid.text(-0.00001, Of::Linear, Control::Sinumerik840d), "0");
        assert_eq!(grid.text(5.0, Of::Rotary, Control::Heidenhain), "+5");
        let full = Grid::of(None, Unit::Millimetre);
        assert_eq!(full.text(0.1 + 0.2, Of::Linear, Control::Fanuc), "0.30000000000000004");
        assert!(grid.same(1.0004, 1.0, Of::Linear) && !grid.same(1.0006, 1.0, Of::Linear));
    }

    /// 33.333333… + d = 33.313, in mm and in inches; 10 + 0.012 needs no more than its three decimals.
    #[test]
    fn differences_lead_to_whole_increments() {
        let grid = Grid::of(Some(Increments::default()), Unit::Millimetre);
        let text = |by: f64| grid.difference(by, Of::Linear);
        assert_eq!(text(33.313 - 100.0 / 3.0).as_deref(), Some("0.020333333"));
        assert_eq!(text(10.012 - 10.0).as_deref(), Some("0.012"));
        assert_eq!(text(-2.0).as_deref(), Some("2"));
        assert_eq!(text(1e-12), None);
        let inch = Grid::of(Some(Increments::default()), Unit::Inch);
        assert_eq!(inch.difference(25.4 * 0.00012, Of::Linear).as_deref(), Some("0.00012"));
        let full = Grid::of(None, Unit::Millimetre);
        assert_eq!(full.difference(0.25, Of::Linear).as_deref(), Some("0.25"));
    }

    /// 1 µm is 0.0000394 in: five decimals; 2.54 µm is 0.0001 in: four.
    #[test]
    fn inches_have_decimals_for_the_increment() {
        let inch = |um: f64| {
            Grid::of(Some(Increments { linear_mm: um * 1e-3, rotary_deg: 1e-4 }), Unit::Inch)
        };
        let shown =
            |grid: Grid| grid.text(grid.round(31.4159, Of::Linear), Of::Linear, Control::LinuxCnc);
        assert_eq!(shown(inch(1.0)), "1.23685");
        assert_eq!(shown(inch(2.54)), "1.2368");
        let full = Grid::of(None, Unit::Inch);
        assert_eq!(full.text(76.2, Of::Linear, Control::LinuxCnc), "3");
        assert_eq!(inch(1.0).round(31.4159, Of::Rotary), 31.4159);
        assert!(
            inch(2.54).same(25.4, 25.4012, Of::Linear)
                && !inch(2.54).same(25.4, 25.4013, Of::Linear)
        );
    }
}
