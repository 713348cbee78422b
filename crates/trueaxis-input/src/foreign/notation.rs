//! Numbers as they are written: decimal sign, separators of thousands, powers of ten.

use crate::{Diagnostics, Place};

/// How the numbers of a table are written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Notation {
    /// The decimal sign, `.` or `,`.
    pub decimal: char,
    /// What separates thousands, besides spaces and apostrophes; `None` where nothing does.
    pub thousands: Option<char>,
}

impl Default for Notation {
    fn default() -> Self {
        Self { decimal: '.', thousands: None }
    }
}

/// What one number tells about `.` and `,`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Evidence {
    /// It is the decimal sign.
    Decimal(char),
    /// It separates thousands, so it is not the decimal sign.
    Thousands(char),
    /// `1,234`: either.
    Either(char),
    /// No sign at all, or no number.
    Nothing,
}

fn evidence(cell: &str) -> Evidence {
    let body = cell.trim().trim_start_matches(['+', '-', '−']);
    let body = body.split(['e', 'E']).next().unwrap_or("");
    let is_number = body.chars().any(|c| c.is_ascii_digit())
        && body.chars().all(|c| c.is_ascii_digit() || matches!(c, '.' | ',') || is_gap(c));
    if !is_number {
        return Evidence::Nothing;
    }
    let count = |sign: char| body.matches(sign).count();
    match (count('.'), count(',')) {
        (0, 0) => Evidence::Nothing,
        (points, commas) if points > 0 && commas > 0 => {
            // The last one is the decimal sign.
            let last = body.rfind(['.', ',']).and_then(|at| body[at..].chars().next());
            last.map_or(Evidence::Nothing, Evidence::Decimal)
        }
        (points, commas) => {
            let sign = if points > 0 { '.' } else { ',' };
            let mut groups = body.split(sign);
            let first = groups.next().unwrap_or("");
            let rest: Vec<&str> = groups.collect();
            if points.max(commas) > 1 {
                return Evidence::Thousands(sign);
            }
            let grouped = rest.iter().all(|g| g.len() == 3)
                && (1..=3).contains(&first.len())
                && !first.starts_with('0');
            if grouped { Evidence::Either(sign) } else { Evidence::Decimal(sign) }
        }
    }
}

fn is_gap(c: char) -> bool {
    matches!(c, ' ' | '\u{a0}' | '\u{202f}' | '\u{2009}' | '\'' | '’')
}

/// Cells with the places where they stand.
pub(super) struct Numbers<'a> {
    pub cells: Vec<(Place, &'a str)>,
    /// Whether columns are separated by commas, so that a comma in a number stands between quotes.
    pub separated_by_commas: bool,
}

/// How the numbers of a table are written, from all of them together; `None` with an error where they do not prove it.
pub(super) fn notation_of(numbers: &Numbers<'_>, problems: &mut Diagnostics) -> Option<Notation> {
    let mut decimal: Option<(char, usize)> = None;
    let mut either: Option<(char, usize)> = None;
    let mut thousands: Option<(char, usize)> = None;
    for (i, (place, cell)) in numbers.cells.iter().enumerate() {
        match evidence(cell) {
            Evidence::Decimal(sign) => match decimal {
                Some((other, at)) if other != sign => {
                    let first = numbers.cells[at].1.trim();
                    return mixed(place, cell.trim(), first, problems);
                }
                Some(_) => {}
                None => decimal = Some((sign, i)),
            },
            Evidence::Thousands(sign) => {
                thousands.get_or_insert((sign, i));
            }
            Evidence::Either(sign) => {
                either.get_or_insert((sign, i));
            }
            Evidence::Nothing => {}
        }
    }
    let other = |sign: char| if sign == '.' { ',' } else { '.' };
    let known = decimal.map(|(sign, _)| sign).or(thousands.map(|(sign, _)| other(sign)));
    if let (Some(known), Some((sign, at))) = (known, thousands)
        && sign == known
    {
        let first = decimal.map_or("", |(_, i)| numbers.cells[i].1.trim());
        return mixed(&numbers.cells[at].0, numbers.cells[at].1.trim(), first, problems);
    }
    match (known, either) {
        // `1,234` beside `0.5`: only a separator of thousands.
        (Some(known), _) => Some(Notation { decimal: known, thousands: Some(other(known)) }),
        (None, Some(('.', _))) if numbers.separated_by_commas => Some(Notation::default()),
        (None, Some((_, at))) => {
            ambiguous(&numbers.cells[at].0, numbers.cells[at].1.trim(), problems);
            None
        }
        (None, None) => Some(Notation::default()),
    }
}

fn mixed(place: &Place, cell: &str, first: &str, problems: &mut Diagnostics) -> Option<Notation> {
    let message = format!("`{cell}` and `{first}` do not have the same decimal sign");
    let hint =
        "write all numbers of a file alike, or state decimal = \",\" in a mapping file (--map)";
    problems.error("mixed-decimals", place.clone(), message, hint);
    None
}

fn ambiguous(place: &Place, cell: &str, problems: &mut Diagnostics) {
    let bare: String = cell.chars().filter(|c| !matches!(c, '.' | ',')).collect();
    let with_point = cell.replace(',', ".");
    let message = format!(
        "`{cell}` is {with_point} if the sign is a decimal sign, or {bare} if it separates thousands; no number \
         of this file tells which"
    );
    let hint = "state it in a mapping file (--map): decimal = \",\" or decimal = \".\", or write another digit";
    problems.error("ambiguous-number", place.clone(), message, hint);
}

impl Notation {
    /// A number as we write it, times a power of ten: digits with a point, then the exponent; `None` if it is none.
    pub(super) fn canonical(&self, cell: &str, shift: i32, negate: bool) -> Option<String> {
        let cell = cell.trim();
        let (mut negative, body) = match cell.chars().next()? {
            '-' | '−' => (true, &cell[cell.chars().next()?.len_utf8()..]),
            '+' => (false, &cell[1..]),
            _ => (false, cell),
        };
        let (digits, exponent) = match body.split_once(['e', 'E']) {
            Some((digits, exponent)) => (digits, exponent.replace('−', "-").parse::<i32>().ok()?),
            None => (body, 0),
        };
        let (whole, fraction) = match digits.split_once(self.decimal) {
            Some((whole, fraction)) => (whole, fraction),
            None => (digits, ""),
        };
        let whole = self.ungrouped(whole)?;
        if !fraction.chars().all(|c| c.is_ascii_digit()) || whole.is_empty() && fraction.is_empty()
        {
            return None;
        }
        negative ^= negate;
        let whole = if whole.is_empty() { "0" } else { &whole };
        let is_zero = whole.chars().chain(fraction.chars()).all(|c| c == '0');
        let sign = if negative && !is_zero { "-" } else { "" };
        let point = if fraction.is_empty() { "" } else { "." };
        let exponent = exponent.checked_add(shift)?;
        Some(format!("{sign}{whole}{point}{fraction}e{exponent}"))
    }

    /// The digits before the decimal sign without what separates thousands, which must stand before three digits.
    fn ungrouped(&self, whole: &str) -> Option<String> {
        let separates = |c: char| Some(c) == self.thousands || is_gap(c);
        if !whole.contains(separates) {
            return whole.chars().all(|c| c.is_ascii_digit()).then(|| whole.to_owned());
        }
        let groups: Vec<&str> = whole.split(separates).collect();
        let sound = |(i, g): (usize, &&str)| {
            let of_three = if i == 0 { (1..=3).contains(&g.len()) } else { g.len() == 3 };
            of_three && g.chars().all(|c| c.is_ascii_digit())
        };
        groups.iter().enumerate().all(sound).then(|| groups.concat())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(cells: &[&str], separated_by_commas: bool) -> Result<Notation, &'static str> {
        let mut problems = Diagnostics::new();
        let cells = cells.iter().map(|c| (Place::whole("t.csv"), *c)).collect();
        let found = notation_of(&Numbers { cells, separated_by_commas }, &mut problems);
        found.ok_or_else(|| problems.iter().next().map_or("", |d| d.code))
    }

    #[test]
    fn the_file_as_a_whole_tells_the_decimal_sign() {
        let decimal = |cells: &[&str]| of(cells, false).map(|n| n.decimal);
        assert_eq!(decimal(&["100", "1,5"]), Ok(','));
        assert_eq!(decimal(&["100", "0,125"]), Ok(',')); // no group begins with 0
        assert_eq!(decimal(&["1.234,5", "1,234"]), Ok(','));
        assert_eq!(decimal(&["1,234.5", "1,234"]), Ok('.'));
        assert_eq!(decimal(&["1,234,567"]), Ok('.'));
        assert_eq!(decimal(&["1,234", "0.5"]), Ok('.'));
        assert_eq!(decimal(&["1", "2"]), Ok('.'));
        assert_eq!(decimal(&["1,234"]), Err("ambiguous-number"));
        assert_eq!(decimal(&["1.234", "100.000"]), Err("ambiguous-number"));
        assert_eq!(of(&["1.234"], true).map(|n| n.decimal), Ok('.'));
        assert_eq!(decimal(&["1,5", "1.5"]), Err("mixed-decimals"));
        assert_eq!(decimal(&["1.5", "1.234.567"]), Err("mixed-decimals"));
    }

    #[test]
    fn numbers_keep_their_digits() {
        let comma = Notation { decimal: ',', thousands: Some('.') };
        let is = |cell, shift, ours: &str| {
            assert_eq!(comma.canonical(cell, shift, false).as_deref(), Some(ours), "{cell}");
        };
        is("1.234,50", 0, "1234.50e0");
        is("−0,0017", 3, "-0.0017e3");
        is("+,5", -3, "0.5e-3");
        is("1 234", 0, "1234e0");
        is("1,7E−3", 3, "1.7e0");
        is("-0", 0, "0e0");
        assert_eq!(comma.canonical("2", 0, true).as_deref(), Some("-2e0"));
        for bad in ["", "-", "1.23,5", "x", "1,2,3", "1e", "e5", "--1", "1e99999999999", "nan"] {
            assert_eq!(comma.canonical(bad, 0, false), None, "{bad}");
        }
        // The same decimal number is the same double.
        let value = |text: String| text.parse::<f64>().unwrap();
        let (um, mm) = (comma.canonical("1,7", 0, false), comma.canonical("0,0017", 3, false));
        assert_eq!(um.map(value), mm.map(value));
    }
}
