//! Ranges that quantities of machine tools and their measurements have: a value outside is probably a slip of the
//! unit or of the column.
//!
//! Outside the plausible range there is a warning, outside the possible range a refusal. A section `[plausible]` of
//! the file states another plausible range ([`Limits::read`]); docs/reference/plausible.md lists all.
//!
//! ```
//! use trueaxis_input::{SourceText, plausible::Quantity};
//! let text = "length = '160 m'\n[plausible]\nexpansion_um_per_m_k = [-5, 210]";
//! let source = SourceText::new("tool.toml", text);
//! source.read(|root| root.get("length").and_then(|i| i.quantity_of(Quantity::ToolLength)));
//! assert_eq!(source.finish().iter().next().unwrap().code, "impossible-value");
//! ```

use crate::{Diagnostics, Dimension, Place, Section, Severity, Unit};

/// What is measured or stated.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Quantity {
    /// Displacement of an error motion.
    PositionError,
    /// The same for every metre of travel, where this is more.
    PositionErrorPerMetre,
    /// Rotation of an error motion.
    AngleError,
    /// Displacement of a location error.
    LocationError,
    /// Rotation of a location error.
    LocationAngle,
    /// Coefficient of thermal expansion.
    Expansion,
    /// Temperature of a machine, a workpiece or the air.
    Temperature,
    /// Any length or position that has no range of its own.
    Length,
    /// Command or travel of a rotary axis.
    RotaryPosition,
    /// Length of a tool.
    ToolLength,
    /// Diameter of a tool, a ball or a ring.
    Diameter,
    /// Velocity of a linear axis, feed.
    Velocity,
    /// Acceleration of a linear axis.
    Acceleration,
    /// Jerk of a linear axis.
    Jerk,
    /// Speed of a spindle or a rotary axis.
    AngularVelocity,
    /// Time, period, time constant.
    Time,
    /// Standard uncertainty of a reading of length.
    Noise,
    /// Standard uncertainty of a reading of an angle.
    AngularNoise,
    /// Reading of a deviation.
    Deviation,
    /// Reading of an angular deviation.
    AngularDeviation,
    /// Reading of a distance against the nominal one.
    Distance,
}

/// The range of a quantity.
#[derive(Debug, Clone, Copy)]
pub struct Range {
    /// Of what.
    pub quantity: Quantity,
    /// The entry in `[plausible]`; ends with the unit.
    pub key: &'static str,
    /// In words.
    pub what: &'static str,
    /// The unit of the bounds.
    pub unit: &'static str,
    /// From inner unit to `unit`, as a factor. Unit: that of `unit` per inner unit.
    pub factor: f64,
    /// Outside there is a warning. Unit: that of `unit`.
    pub plausible: (f64, f64),
    /// Outside the value is refused. Unit: that of `unit`.
    pub possible: (f64, f64),
    /// Why.
    pub reason: &'static str,
    /// Where that comes from.
    pub source: &'static str,
}

const fn row(
    quantity: Quantity,
    (key, what): (&'static str, &'static str),
    (unit, factor): (&'static str, f64),
    [plausible, possible]: [(f64, f64); 2],
    (reason, source): (&'static str, &'static str),
) -> Range {
    Range { quantity, key, what, unit, factor, plausible, possible, reason, source }
}

/// `from` to `to` around zero.
const fn both(bound: f64) -> (f64, f64) {
    (-bound, bound)
}

const UM: (&str, f64) = ("µm", 1e3);
const URAD: (&str, f64) = ("µrad", 1e6);
const MM: (&str, f64) = ("mm", 1.0);

/// All ranges, in the order of [`Quantity`].
#[rustfmt::skip]
pub const RANGES: [Range; 21] = [
    row(Quantity::PositionError, ("position_error_um", "a displacement of an error motion"), UM,
        [both(2e3), both(1e4)],
        ("machining centres are accepted within some 10 µm, a large gantry without compensation has 0.5 mm",
         "ISO 10791-4 (tolerances of positioning), machines/gantry-001 (Zhang et al. 2019: 352 µm)")),
    row(Quantity::PositionErrorPerMetre, ("position_error_um_per_m", "a displacement of an error motion"), ("µm/m", 1e6),
        [both(1e3), both(3e3)],
        ("ball screws of the lowest accuracy grade deviate by 210 µm in 300 mm",
         "ISO 3408-3, grade T10")),
    row(Quantity::AngleError, ("angle_error_urad", "a rotation of an error motion"), URAD,
        [both(2e3), both(2e4)],
        ("guideways and rotary axes tilt by 5 µrad to 200 µrad; 20 mrad are more than one degree",
         "ISO 10791-1 and -6 (tolerances in mm/m: 0.02 to 0.06), machines/xkas2525 (400 µrad)")),
    row(Quantity::LocationError, ("location_error_um", "a displacement of a location error"), UM,
        [both(1e4), both(1e5)],
        ("a rotary centre from a drawing is some mm off before it is measured",
         "a choice of this project; before: the warning of location errors above 10 mm")),
    row(Quantity::LocationAngle, ("location_error_urad", "a rotation of a location error"), URAD,
        [both(1e4), both(1e5)],
        ("axes are square within 0.02 mm/m to 0.1 mm/m (20 µrad to 100 µrad); 0.1 rad is a design angle",
         "ISO 10791-1 (tolerances of squareness)")),
    row(Quantity::Expansion, ("expansion_um_per_m_k", "a coefficient of expansion"), ("µm/(m·K)", 1e6),
        [(-5.0, 40.0), both(300.0)],
        ("glass ceramic 0, steel 11.5, aluminium 24, zinc 30; plastics reach 205",
         "tables of materials, such as engineeringtoolbox.com/linear-expansion-coefficients-d_95.html")),
    row(Quantity::Temperature, ("temperature_celsius", "a temperature"), ("°C", 1.0),
        [(0.0, 45.0), (-40.0, 150.0)],
        ("workshops have 10 °C to 40 °C, spindles up to 70 °C; 68 °F is 20 °C",
         "ISO 1 (20 °C), ISO 230-3 (environment and warming)")),
    row(Quantity::Length, ("length_mm", "a length"), MM,
        [both(1e5), both(5e5)],
        ("the longest machine tools have beds of some 100 m",
         "data sheets of makers of portal and gantry milling machines")),
    row(Quantity::RotaryPosition, ("rotary_position_deg", "a position of a rotary axis"), ("°", 57.295_779_513_082_32),
        [both(3600.0), both(3.6e6)],
        ("rotary axes turn some times in a program; 120 rad are 6875°",
         "travel of rotary axes in the machine files of this project: at most 2 turns")),
    row(Quantity::ToolLength, ("tool_length_mm", "the length of a tool"), MM,
        [both(2e3), both(1e4)],
        ("tool magazines take 300 mm to 1 m; boring bars and extensions reach 2 m",
         "data sheets of machining centres (largest length of tool)")),
    row(Quantity::Diameter, ("diameter_mm", "a diameter"), MM,
        [(0.0, 1e3), (0.0, 1e4)],
        ("face mills reach 500 mm, balls and rings of measurement 10 mm to 300 mm",
         "ISO 6462 (face mills up to 500 mm)")),
    row(Quantity::Velocity, ("velocity_m_per_min", "a velocity"), ("m/min", 0.06),
        [both(240.0), both(6e3)],
        ("rapid traverse is 10 m/min to 120 m/min; linear motors reach 240 m/min",
         "data sheets of machines with linear motors")),
    row(Quantity::Acceleration, ("acceleration_m_per_s2", "an acceleration"), ("m/s²", 1e-3),
        [both(50.0), both(1e3)],
        ("axes accelerate with 1 m/s² to 30 m/s²",
         "data sheets of machines with linear motors (up to 3 g)")),
    row(Quantity::Jerk, ("jerk_m_per_s3", "a jerk"), ("m/s³", 1e-3),
        [both(5e3), both(1e6)],
        ("controls are set to 5 m/s³ to 1000 m/s³",
         "usual settings of machine data, such as SINUMERIK MD32431")),
    row(Quantity::AngularVelocity, ("speed_per_min", "a speed"), ("1/min", 9.549_296_585_513_72),
        [both(3e5), both(1e6)],
        ("the fastest spindles of machine tools turn with 300 000 1/min",
         "data sheets of spindles with air bearings")),
    row(Quantity::Time, ("time_s", "a time"), ("s", 1.0),
        [both(3.2e7), both(1e10)],
        ("a measurement takes hours or days, not more than a year",
         "a choice of this project; tests of ISO 230-3 take hours")),
    row(Quantity::Noise, ("noise_um", "a standard uncertainty of a reading"), UM,
        [(1e-3, 500.0), (0.0, 1e4)],
        ("lasers resolve 1 nm, touch probes repeat within 0.1 µm to 5 µm, laser trackers within 50 µm",
         "data sheets of instruments; ISO/TR 230-9, ISO/TR 230-11")),
    row(Quantity::AngularNoise, ("noise_urad", "a standard uncertainty of an angular reading"), URAD,
        [(1e-3, 500.0), (0.0, 2e4)],
        ("autocollimators resolve 0.01 µrad, electronic levels 1 µrad",
         "data sheets of instruments; ISO/TR 230-11")),
    row(Quantity::Deviation, ("reading_um", "a reading of a deviation"), UM,
        [both(2e3), both(1e4)],
        ("ball-bars and R-tests measure within ±1 mm, indicators within ±5 mm",
         "ISO/TR 230-11 (instruments and their ranges)")),
    row(Quantity::AngularDeviation, ("reading_urad", "a reading of an angle"), URAD,
        [both(5e3), both(5e4)],
        ("autocollimators and electronic levels measure within ±5 mrad to ±20 mrad",
         "ISO/TR 230-11 (instruments and their ranges)")),
    row(Quantity::Distance, ("distance_deviation_mm", "a distance against the nominal one"), MM,
        [both(100.0), both(5e3)],
        ("what a set-up is stated to be is right within some cm",
         "a choice of this project, without a source")),
];

/// Whether a value is within its ranges.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Standing {
    /// It is.
    Plausible,
    /// Outside the plausible range.
    Odd,
    /// Outside the possible range.
    Impossible,
}

/// The ranges of one file: the usual ones, or those of its section `[plausible]`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limits {
    plausible: [(f64, f64); RANGES.len()],
}

impl Default for Limits {
    fn default() -> Self {
        Self { plausible: RANGES.map(|r| r.plausible) }
    }
}

/// One value and where it stands.
#[derive(Debug, Clone, Copy)]
pub struct Seen<'a> {
    /// The name to show: a key, a heading.
    pub name: &'a str,
    /// The value. Unit: mm, rad … of the quantity.
    pub value: f64,
    /// How many further values of the same column are outside.
    pub more: usize,
    /// The largest of them, by its size. Unit: mm, rad … of the quantity.
    pub largest: f64,
}

impl<'a> Seen<'a> {
    /// A value that is no part of a column.
    pub fn one(name: &'a str, value: f64) -> Self {
        Self { name, value, more: 0, largest: value }
    }
}

impl Quantity {
    /// Its range.
    pub fn range(self) -> &'static Range {
        &RANGES[self as usize]
    }

    /// The range that every quantity of a dimension has, if it has one.
    pub fn of(dimension: Dimension) -> Option<Self> {
        Some(match dimension {
            Dimension::Length => Self::Length,
            Dimension::Expansion => Self::Expansion,
            Dimension::Velocity => Self::Velocity,
            Dimension::Acceleration => Self::Acceleration,
            Dimension::Jerk => Self::Jerk,
            Dimension::AngularVelocity => Self::AngularVelocity,
            Dimension::Time => Self::Time,
            _ => return None,
        })
    }

    /// The dimension of its values.
    pub fn dimension(self) -> Dimension {
        match self {
            Self::AngleError
            | Self::LocationAngle
            | Self::RotaryPosition
            | Self::AngularNoise
            | Self::AngularDeviation => Dimension::Angle,
            Self::PositionErrorPerMetre => Dimension::Ratio,
            Self::Expansion => Dimension::Expansion,
            Self::Temperature => Dimension::Temperature,
            Self::Velocity => Dimension::Velocity,
            Self::Acceleration => Dimension::Acceleration,
            Self::Jerk => Dimension::Jerk,
            Self::AngularVelocity => Dimension::AngularVelocity,
            Self::Time => Dimension::Time,
            _ => Dimension::Length,
        }
    }
}

impl Limits {
    /// Reads `[plausible]`: `position_error_um = 5000` (up to that, or from minus that), `temperature_celsius = [5, 60]`.
    pub fn read(section: &Section<'_>) -> Self {
        let mut limits = Self::default();
        for range in &RANGES {
            let Some(item) = section.get(range.key) else { continue };
            let stated = if item.is_list() {
                let ends: Option<Vec<f64>> =
                    item.list().and_then(|list| list.iter().map(crate::Item::number).collect());
                ends.and_then(|e| <[f64; 2]>::try_from(e).ok())
            } else {
                let low = |to: f64| if range.possible.0 < 0.0 { -to } else { range.plausible.0 };
                item.number().map(|to| [low(to), to])
            };
            match stated {
                Some([from, to]) if from < to => {
                    limits.plausible[range.quantity as usize] = (from, to);
                }
                _ => {
                    let message = format!("`{}` is no range", range.key);
                    let hint =
                        "write a number above zero, such as 5000, or both ends, such as [5, 60]";
                    item.error("bad-plausible", message, hint);
                }
            }
        }
        limits
    }

    /// Both ranges, in the unit of the table. A stated range widens the possible one.
    fn bounds(&self, quantity: Quantity) -> [(f64, f64); 2] {
        let (plausible, possible) = (self.plausible[quantity as usize], quantity.range().possible);
        [plausible, (possible.0.min(plausible.0), possible.1.max(plausible.1))]
    }

    /// Where a value stands, in its inner unit.
    pub fn standing(&self, quantity: Quantity, value: f64) -> Standing {
        standing(self.bounds(quantity), value * quantity.range().factor)
    }

    /// Reports a value that is outside; `false` if it is refused.
    pub fn judge(
        &self,
        quantity: Quantity,
        seen: &Seen<'_>,
        place: &Place,
        problems: &mut Diagnostics,
    ) -> bool {
        report(quantity, self.bounds(quantity), seen, place, problems)
    }

    /// As [`Limits::judge`] for the error motion of an axis with that travel, mm: its displacements may grow with it.
    pub fn judge_error(
        &self,
        travel_mm: f64,
        seen: &Seen<'_>,
        place: &Place,
        problems: &mut Diagnostics,
    ) -> bool {
        report(Quantity::PositionError, self.over(travel_mm), seen, place, problems)
    }

    fn over(&self, travel_mm: f64) -> [(f64, f64); 2] {
        let fixed = self.bounds(Quantity::PositionError);
        let per_m = self.bounds(Quantity::PositionErrorPerMetre);
        let travel_m = travel_mm.abs() / 1e3;
        [0, 1].map(|i| {
            let (low, high) = per_m[i];
            (fixed[i].0.min(low * travel_m), fixed[i].1.max(high * travel_m))
        })
    }

    /// Reports the worst kind of value of a column once, at its first row; `false` if it is refused.
    pub fn judge_column(
        &self,
        quantity: Quantity,
        column: (&str, &[f64]),
        place: impl Fn(usize) -> Place,
        problems: &mut Diagnostics,
    ) -> bool {
        judge_values(quantity, self.bounds(quantity), column, place, problems)
    }

    /// As [`Limits::judge_column`] for an error motion: [`Limits::judge_error`].
    pub fn judge_error_column(
        &self,
        travel_mm: f64,
        column: (&str, &[f64]),
        place: impl Fn(usize) -> Place,
        problems: &mut Diagnostics,
    ) -> bool {
        judge_values(Quantity::PositionError, self.over(travel_mm), column, place, problems)
    }
}

fn standing([plausible, possible]: [(f64, f64); 2], value: f64) -> Standing {
    // "10 mm" in µm may be a rounding above 10000.
    let within = |(low, high): (f64, f64)| {
        let slack = 1e-9 * low.abs().max(high.abs());
        (low - slack..=high + slack).contains(&value)
    };
    match (within(plausible), within(possible)) {
        (true, _) => Standing::Plausible,
        (_, true) => Standing::Odd,
        _ => Standing::Impossible,
    }
}

fn judge_values(
    quantity: Quantity,
    bounds: [(f64, f64); 2],
    (name, values): (&str, &[f64]),
    place: impl Fn(usize) -> Place,
    problems: &mut Diagnostics,
) -> bool {
    let factor = quantity.range().factor;
    // An empty cell is no value.
    let kind = |v: &f64| match v.is_nan() {
        true => Standing::Plausible,
        false => standing(bounds, v * factor),
    };
    let count = |wanted| values.iter().filter(|v| kind(v) == wanted).count();
    let (odd, impossible) = (count(Standing::Odd), count(Standing::Impossible));
    let wanted = if impossible > 0 { Standing::Impossible } else { Standing::Odd };
    let Some(row) = values.iter().position(|v| kind(v) == wanted) else { return true };
    let largest = values.iter().filter(|v| !v.is_nan()).fold(0.0, |a: f64, b| a.max(b.abs()));
    let seen = Seen { name, value: values[row], more: odd + impossible - 1, largest };
    report(quantity, bounds, &seen, &place(row), problems)
}

fn report(
    quantity: Quantity,
    bounds: [(f64, f64); 2],
    seen: &Seen<'_>,
    place: &Place,
    problems: &mut Diagnostics,
) -> bool {
    let range = quantity.range();
    let value = seen.value * range.factor;
    let standing = standing(bounds, value);
    let (word, severity, code, (low, high)) = match standing {
        Standing::Plausible => return true,
        Standing::Odd => ("plausible", Severity::Warning, "implausible-value", bounds[0]),
        Standing::Impossible => ("possible", Severity::Error, "impossible-value", bounds[1]),
    };
    let more = match seen.more {
        0 => String::new(),
        n => format!(", and {n} more such values"),
    };
    let message = format!(
        "`{}` is {} {unit}{more}: {} of {} {unit} to {} {unit} is {word} ({})",
        seen.name,
        shown(value),
        range.what,
        shown(low),
        shown(high),
        range.reason,
        unit = range.unit,
    );
    let hint = format!(
        "check unit, heading and exponent; if the value is right, state the range in [plausible]: {} = {}",
        range.key,
        shown(seen.largest.abs() * range.factor * 1.2)
    );
    let place = place.clone();
    problems.add(crate::Diagnostic { code, severity, place, message, hint });
    standing != Standing::Impossible
}

/// Four digits; large and small ones with an exponent.
fn shown(value: f64) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    let digits = format!("{value:.3e}").parse::<f64>().unwrap_or(value);
    match value.abs() {
        1e-3..1e7 => format!("{digits}"),
        _ => format!("{digits:e}"),
    }
}

/// The largest value that any reader accepts under a heading with this unit, in the inner unit, and how to say it;
/// none for a heading without unit. These bounds cannot be widened: products of larger numbers mean nothing.
pub(crate) fn largest_under(heading: &str) -> Option<(Unit, f64, &'static str)> {
    let (_, unit) = heading.rsplit_once('_')?;
    let (unit, dimension) = Unit::any(unit)?;
    // A small unit stands for small values: µm, nm, µrad, arcsec, mrad.
    let is_small = unit.to_inner(1.0) <= 1e-3;
    Some(match (dimension, is_small) {
        (Dimension::Length, true) => (unit, 1e5, "100 m"),
        (Dimension::Length, false) => (unit, 5e5, "500 m"),
        (Dimension::Angle, true) => (unit, 10.0, "10 rad"),
        _ => (unit, dimension.largest(), dimension.largest_in_words()),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::SourceText;

    #[test]
    fn the_table_is_in_the_order_of_the_quantities_and_sound() {
        for (i, range) in RANGES.iter().enumerate() {
            assert_eq!(range.quantity as usize, i, "{}", range.key);
            let ((low, high), (from, to)) = (range.plausible, range.possible);
            assert!(from <= low && low < high && high < to, "{}", range.key);
            assert!(!range.reason.is_empty() && !range.source.is_empty());
        }
    }

    /// 1 of each inner unit, by hand: 1 mm = 1000 µm, 1 rad = 57.29578°, 1 mm/s = 0.06 m/min, 1 rad/s = 9.5493 1/min.
    #[test]
    fn factors_follow_from_the_table_of_units() {
        for range in RANGES.iter().filter(|r| r.quantity != Quantity::PositionErrorPerMetre) {
            let unit = Unit::find(range.unit, range.quantity.dimension()).unwrap();
            assert!((unit.to_inner(range.factor) - 1.0).abs() < 1e-12, "{}", range.key);
        }
    }

    fn codes(text: &str, quantity: Quantity) -> Vec<&'static str> {
        let source = SourceText::new("t.toml", text);
        source.read(|root| root.get("v").and_then(|i| i.quantity_of(quantity)));
        source.finish().iter().map(|d| d.code).collect()
    }

    #[test]
    fn warned_refused_and_adjusted() {
        let tool = |text: &str| codes(text, Quantity::ToolLength);
        assert!(tool("v = '160 mm'").is_empty());
        assert!(tool("v = '2 m'").is_empty()); // the bound itself
        assert_eq!(tool("v = '2.1 m'"), ["implausible-value"]);
        assert_eq!(tool("v = '160 m'"), ["impossible-value"]);
        assert!(tool("v = '2.1 m'\n[plausible]\ntool_length_mm = 3000").is_empty());
        assert!(tool("v = '16 m'\n[plausible]\ntool_length_mm = [0, 20_000]").is_empty());
        // The section may stand anywhere, and one range does not change another.
        assert_eq!(tool("plausible = { diameter_mm = 5000 }\nv = '160 m'"), ["impossible-value"]);
        assert_eq!(tool("v = '1 mm'\n[plausible]\ntool_length_mm = [5, 2]"), ["bad-plausible"]);
        assert_eq!(tool("v = '1 mm'\n[plausible]\ntool_lenght_mm = 5"), ["unknown-key"]);
    }

    #[test]
    fn a_coefficient_in_the_wrong_power_is_refused() {
        let alpha = |text: &str| codes(&format!("v = '{text}'"), Quantity::Expansion);
        assert!(alpha("11.5 um/(m K)").is_empty() && alpha("11.5e-6 1/K").is_empty());
        assert_eq!(alpha("11.5e-3 1/K"), ["impossible-value"]);
        assert_eq!(alpha("115 um/(m K)"), ["implausible-value"]);
    }

    /// 3 m of travel allow 3 mm; a bound of 2 mm holds below 2 m.
    #[test]
    fn an_error_grows_with_the_travel() {
        let of = |travel_mm: f64, value: f64| {
            let mut problems = Diagnostics::new();
            let seen = Seen::one("EXX", value);
            Limits::default().judge_error(travel_mm, &seen, &Place::whole("m"), &mut problems);
            problems.iter().map(|d| d.code).collect::<Vec<_>>()
        };
        assert_eq!(of(500.0, 2.5), ["implausible-value"]);
        assert!(of(3000.0, 2.5).is_empty());
        assert_eq!(of(500.0, -100.0), ["impossible-value"]);
    }

    #[test]
    fn a_column_is_reported_once_at_its_worst_row() {
        let mut problems = Diagnostics::new();
        let rows = [0.5, 3.0, f64::NAN, -12.9, 9.0];
        let place = |row: usize| Place { file: "r.csv".to_owned(), line: row + 2, column: 1 };
        let sound = Limits::default().judge_column(
            Quantity::Deviation,
            ("x_mm", &rows),
            place,
            &mut problems,
        );
        let found: Vec<_> = problems.iter().collect();
        assert!(!sound && found.len() == 1);
        assert_eq!(found[0].place.line, 5);
        assert!(found[0].message.contains("-12900 µm, and 2 more"), "{}", found[0].message);
        // The range that is proposed covers all of them.
        assert!(found[0].hint.ends_with("reading_um = 15480"), "{}", found[0].hint);
    }
}
