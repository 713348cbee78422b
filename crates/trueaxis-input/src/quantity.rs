//! Quantities with units in text: `"12 urad"`, `"10 ± 1 um"`.

use std::f64::consts::PI;
use std::fmt;

/// The dimension of a quantity, with the inner unit in brackets: the unit of all numbers in the
/// program.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Dimension {
    /// \[mm\]
    Length,
    /// \[rad\]
    Angle,
    /// \[s\]
    Time,
    /// \[°C\]
    Temperature,
    /// \[mm/s\]
    Velocity,
    /// \[mm/s²\]
    Acceleration,
    /// \[mm/s³\]
    Jerk,
    /// \[rad/s\]
    AngularVelocity,
    /// \[rad/s²\]
    AngularAcceleration,
    /// \[rad/s³\]
    AngularJerk,
    /// \[1/K\]
    Expansion,
    /// Change of a length with temperature \[mm/K\]
    LengthPerKelvin,
    /// Change of an angle with temperature \[rad/K\]
    AnglePerKelvin,
    /// Thermal diffusivity \[mm²/s\]
    Diffusivity,
    /// Heat transfer between a surface and the air \[W/(m²·K)\]
    FilmCoefficient,
    /// Volumetric heat capacity \[J/(m³·K)\]
    HeatCapacity,
    /// \[W\]
    Power,
    /// A plain number \[1\]
    Ratio,
}

/// All known units: dimension, spellings, and value in the inner unit as a quotient, so that
/// "12 um" is the double nearest to 0.012 and "30 m/min" is 500 mm/s exactly.
const UNITS: &[(Dimension, &[&str], (f64, f64))] = &[
    (Dimension::Length, &["mm"], (1.0, 1.0)),
    (Dimension::Length, &["um", "µm", "μm"], (1.0, 1e3)),
    (Dimension::Length, &["nm"], (1.0, 1e6)),
    (Dimension::Length, &["cm"], (10.0, 1.0)),
    (Dimension::Length, &["m"], (1e3, 1.0)),
    (Dimension::Length, &["in"], (25.4, 1.0)),
    (Dimension::Angle, &["rad"], (1.0, 1.0)),
    (Dimension::Angle, &["mrad", "mm/m"], (1.0, 1e3)),
    (Dimension::Angle, &["urad", "µrad", "μrad", "um/m", "µm/m", "μm/m"], (1.0, 1e6)),
    (Dimension::Angle, &["deg", "°"], (PI, 180.0)),
    (Dimension::Angle, &["arcmin", "′"], (PI, 10_800.0)),
    (Dimension::Angle, &["arcsec", "″"], (PI, 648_000.0)),
    (Dimension::Time, &["s"], (1.0, 1.0)),
    (Dimension::Time, &["ms"], (1.0, 1e3)),
    (Dimension::Time, &["min"], (60.0, 1.0)),
    (Dimension::Time, &["h"], (3600.0, 1.0)),
    (Dimension::Temperature, &["degC", "°C", "celsius"], (1.0, 1.0)),
    (Dimension::Velocity, &["mm/s"], (1.0, 1.0)),
    (Dimension::Velocity, &["mm/min"], (1.0, 60.0)),
    (Dimension::Velocity, &["m/min"], (1e3, 60.0)),
    (Dimension::Velocity, &["m/s"], (1e3, 1.0)),
    (Dimension::Velocity, &["um/s", "µm/s", "μm/s"], (1.0, 1e3)),
    (Dimension::Velocity, &["mm/h"], (1.0, 3600.0)),
    (Dimension::Velocity, &["um/h", "µm/h", "μm/h"], (1.0, 3.6e6)),
    (Dimension::Acceleration, &["mm/s^2", "mm/s²"], (1.0, 1.0)),
    (Dimension::Acceleration, &["m/s^2", "m/s²"], (1e3, 1.0)),
    (Dimension::Jerk, &["mm/s^3", "mm/s³"], (1.0, 1.0)),
    (Dimension::Jerk, &["m/s^3", "m/s³"], (1e3, 1.0)),
    (Dimension::AngularVelocity, &["rad/s"], (1.0, 1.0)),
    (Dimension::AngularVelocity, &["deg/s", "°/s"], (PI, 180.0)),
    (Dimension::AngularVelocity, &["deg/min", "°/min"], (PI, 10_800.0)),
    (Dimension::AngularVelocity, &["rpm", "1/min"], (PI, 30.0)),
    (Dimension::AngularVelocity, &["urad/h", "µrad/h", "μrad/h"], (1.0, 3.6e9)),
    (Dimension::AngularAcceleration, &["rad/s^2", "rad/s²"], (1.0, 1.0)),
    (Dimension::AngularAcceleration, &["deg/s^2", "deg/s²", "°/s^2", "°/s²"], (PI, 180.0)),
    (Dimension::AngularJerk, &["rad/s^3", "rad/s³"], (1.0, 1.0)),
    (Dimension::AngularJerk, &["deg/s^3", "deg/s³", "°/s^3", "°/s³"], (PI, 180.0)),
    (Dimension::Expansion, &["1/K"], (1.0, 1.0)),
    (
        Dimension::Expansion,
        &[
            "um/(m·K)",
            "µm/(m·K)",
            "μm/(m·K)",
            "um/(m K)",
            "µm/(m K)",
            "μm/(m K)",
            "um/m/K",
            "ppm/K",
        ],
        (1.0, 1e6),
    ),
    (Dimension::LengthPerKelvin, &["mm/K"], (1.0, 1.0)),
    (Dimension::LengthPerKelvin, &["um/K", "µm/K", "μm/K"], (1.0, 1e3)),
    (Dimension::AnglePerKelvin, &["rad/K"], (1.0, 1.0)),
    (Dimension::AnglePerKelvin, &["urad/K", "µrad/K", "μrad/K"], (1.0, 1e6)),
    (Dimension::AnglePerKelvin, &["arcsec/K"], (PI, 648_000.0)),
    (Dimension::Diffusivity, &["mm^2/s", "mm²/s"], (1.0, 1.0)),
    (Dimension::Diffusivity, &["m^2/s", "m²/s"], (1e6, 1.0)),
    (Dimension::FilmCoefficient, &["W/(m^2 K)", "W/(m²·K)", "W/m^2/K"], (1.0, 1.0)),
    (Dimension::HeatCapacity, &["J/(m^3 K)", "J/(m³·K)"], (1.0, 1.0)),
    (Dimension::HeatCapacity, &["MJ/(m^3 K)", "MJ/(m³·K)"], (1e6, 1.0)),
    (Dimension::Power, &["W"], (1.0, 1.0)),
    (Dimension::Power, &["kW"], (1e3, 1.0)),
    (Dimension::Ratio, &[""], (1.0, 1.0)),
    (Dimension::Ratio, &["%"], (1.0, 100.0)),
];

/// A unit of measurement: the factor from a number in this unit to the inner unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Unit {
    numerator: f64,
    denominator: f64,
    dimension: Dimension,
}

impl Unit {
    /// Finds a unit of a dimension.
    ///
    /// ```
    /// use trueaxis_input::{Dimension, Unit};
    /// assert_eq!(Unit::find("um", Dimension::Length)?.to_inner(250.0), 0.25);
    /// # Ok::<(), trueaxis_input::QuantityError>(())
    /// ```
    ///
    /// # Errors
    /// The name is empty, unknown, or a unit of another dimension.
    pub fn find(name: &str, dimension: Dimension) -> Result<Self, QuantityError> {
        let mut other = None;
        for &(found, names, (numerator, denominator)) in UNITS {
            if names.contains(&name) {
                if found == dimension {
                    return Ok(Self { numerator, denominator, dimension });
                }
                other = Some(found);
            }
        }
        Err(match other {
            _ if name.is_empty() => QuantityError::NoUnit(dimension),
            Some(found) => {
                QuantityError::WrongDimension { unit: name.to_owned(), found, expected: dimension }
            }
            None => QuantityError::UnknownUnit(name.to_owned(), dimension),
        })
    }

    /// The unit of that name, of whatever dimension.
    pub(crate) fn any(name: &str) -> Option<(Self, Dimension)> {
        let found = UNITS.iter().find(|(_, names, _)| !name.is_empty() && names.contains(&name))?;
        let (dimension, _, (numerator, denominator)) = *found;
        Some((Self { numerator, denominator, dimension }, dimension))
    }

    /// A number of this unit in the inner unit (mm, rad, s, °C).
    pub fn to_inner(self, number: f64) -> f64 {
        number * self.numerator / self.denominator
    }

    /// A number from user input in the inner unit, checked against the largest accepted value.
    ///
    /// ```
    /// use trueaxis_input::{Dimension, Unit};
    /// let metre = Unit::find("m", Dimension::Length)?;
    /// assert_eq!(metre.checked(2.0), Ok(2000.0));
    /// assert!(metre.checked(1e308).is_err()); // 1e311 mm is no double
    /// # Ok::<(), trueaxis_input::QuantityError>(())
    /// ```
    ///
    /// # Errors
    /// The number is not finite, or larger than any of a machine: 1000 km, 10⁵ rad, 10¹² of other inner units.
    pub fn checked(self, number: f64) -> Result<f64, QuantityError> {
        let inner = self.to_inner(number);
        if !number.is_finite() {
            return Err(QuantityError::NotFinite(number.to_string()));
        }
        if inner.abs() > self.dimension.largest() {
            return Err(QuantityError::TooLarge(format!("{number:e}"), self.dimension));
        }
        Ok(inner)
    }
}

impl Dimension {
    /// Upper limit of a quantity in its inner unit. Larger numbers are typing errors, and products of them would
    /// overflow.
    pub(crate) fn largest(self) -> f64 {
        match self {
            Self::Length => 1e9,
            Self::Angle => 1e5,
            Self::Time => 1e11,
            Self::Temperature | Self::LengthPerKelvin | Self::AnglePerKelvin => 1e4,
            Self::Expansion => 1e2,
            _ => 1e12,
        }
    }

    /// The same for messages.
    pub(crate) fn largest_in_words(self) -> &'static str {
        match self {
            Self::Length => "1000 km",
            Self::Angle => "10^5 rad",
            Self::Time => "10^11 s",
            Self::Temperature => "10^4 °C",
            Self::LengthPerKelvin => "10^4 mm/K",
            Self::AnglePerKelvin => "10^4 rad/K",
            Self::Expansion => "100 1/K",
            _ => "10^12 of the inner unit",
        }
    }

    /// The accepted units, the inner unit first, separated by commas: for hints.
    pub fn units(self) -> String {
        let names: Vec<_> =
            UNITS.iter().filter(|(d, ..)| *d == self).map(|(_, names, _)| names[0]).collect();
        names.join(", ")
    }
}

impl fmt::Display for Dimension {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Length => "a length",
            Self::Angle => "an angle",
            Self::Time => "a time",
            Self::Temperature => "a temperature",
            Self::Velocity => "a velocity",
            Self::Acceleration => "an acceleration",
            Self::Jerk => "a jerk",
            Self::AngularVelocity => "an angular velocity",
            Self::AngularAcceleration => "an angular acceleration",
            Self::AngularJerk => "an angular jerk",
            Self::Expansion => "a coefficient of expansion",
            Self::LengthPerKelvin => "a length per temperature",
            Self::AnglePerKelvin => "an angle per temperature",
            Self::Diffusivity => "a thermal diffusivity",
            Self::FilmCoefficient => "a film coefficient",
            Self::HeatCapacity => "a volumetric heat capacity",
            Self::Power => "a power",
            Self::Ratio => "a plain number",
        })
    }
}

/// A value and, if stated, its standard uncertainty, both in the inner unit.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct MeasuredValue {
    /// The value. Unit: that of the dimension.
    pub value: f64,
    /// The standard uncertainty u (GUM), `None` if none was stated. Unit: that of the dimension.
    pub u: Option<f64>,
}

/// The reason why a text is not a quantity of the expected dimension.
#[derive(Debug, Clone, PartialEq)]
pub enum QuantityError {
    /// The text does not begin with a number.
    NotANumber(String),
    /// NaN, infinite, or too large for a double.
    NotFinite(String),
    /// Finite, but larger than any quantity of this dimension.
    TooLarge(String, Dimension),
    /// A number without a unit.
    NoUnit(Dimension),
    /// A unit of unknown name.
    UnknownUnit(String, Dimension),
    /// A unit of another dimension, such as degrees where a length is expected.
    WrongDimension {
        /// The unit as written.
        unit: String,
        /// The dimension of that unit.
        found: Dimension,
        /// The expected dimension.
        expected: Dimension,
    },
    /// An uncertainty below zero.
    NegativeUncertainty,
}

impl QuantityError {
    /// The code of the diagnostic, stable for programs.
    pub fn code(&self) -> &'static str {
        match self {
            Self::NotANumber(_) => "not-a-number",
            Self::NotFinite(_) => "not-finite",
            Self::TooLarge(..) => "too-large",
            Self::NoUnit(_) => "missing-unit",
            Self::UnknownUnit(..) => "unknown-unit",
            Self::WrongDimension { .. } => "wrong-unit",
            Self::NegativeUncertainty => "negative-uncertainty",
        }
    }

    /// What to write instead.
    pub fn hint(&self) -> String {
        match self {
            Self::NotANumber(_) | Self::NotFinite(_) => {
                "write a finite number and its unit, such as \"12.5 mm\"".to_owned()
            }
            Self::TooLarge(..) => "check the exponent and the unit".to_owned(),
            // A temperature is not a difference: 30 °C is not 30 K, and 86 °F is 30 °C.
            Self::UnknownUnit(_, Dimension::Temperature) => {
                "write °C (\"30.5 degC\"): °C = (°F − 32)/1.8 = K − 273.15".to_owned()
            }
            Self::NoUnit(d) | Self::UnknownUnit(_, d) => format!("units of {d}: {}", d.units()),
            Self::WrongDimension { expected, .. } => {
                format!("units of {expected}: {}", expected.units())
            }
            Self::NegativeUncertainty => "a standard uncertainty is zero or positive".to_owned(),
        }
    }
}

impl fmt::Display for QuantityError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotANumber(text) => write!(f, "`{text}` is not a number"),
            Self::NotFinite(text) => write!(f, "`{text}` is not a finite number"),
            Self::TooLarge(text, d) => {
                let largest = d.largest_in_words();
                write!(f, "`{text}` exceeds {largest}, the largest accepted value of {d}")
            }
            Self::NoUnit(d) => write!(f, "{d} needs a unit"),
            Self::UnknownUnit(unit, d) => write!(f, "unknown unit `{unit}` for {d}"),
            Self::WrongDimension { unit, found, expected } => {
                write!(f, "`{unit}` is a unit of {found}, but {expected} is expected here")
            }
            Self::NegativeUncertainty => f.write_str("the uncertainty is negative"),
        }
    }
}

impl std::error::Error for QuantityError {}

/// Reads one quantity such as `"12 urad"` and returns it in the inner unit.
///
/// ```
/// use trueaxis_input::{Dimension, parse_quantity};
/// assert_eq!(parse_quantity("30 m/min", Dimension::Velocity), Ok(500.0));
/// assert!(parse_quantity("30", Dimension::Length).is_err());
/// assert!(parse_quantity("30 deg", Dimension::Length).is_err());
/// ```
///
/// # Errors
/// The text is not one finite number followed by a unit of that dimension.
pub fn parse_quantity(text: &str, dimension: Dimension) -> Result<f64, QuantityError> {
    let text = text.trim();
    let (number, unit) = split_number(text);
    let value = parse_number(number, text)?;
    Unit::find(unit.trim(), dimension)?.checked(value)
}

/// Reads a quantity that may carry a standard uncertainty: `"12 urad ± 1 urad"`, `"12 ± 1 urad"`.
///
/// ```
/// use trueaxis_input::{Dimension, parse_measured};
/// let squareness = parse_measured("12 ± 1 mrad", Dimension::Angle)?;
/// assert_eq!((squareness.value, squareness.u), (0.012, Some(0.001)));
/// # Ok::<(), trueaxis_input::QuantityError>(())
/// ```
///
/// # Errors
/// As [`parse_quantity`], and a negative uncertainty.
pub fn parse_measured(text: &str, dimension: Dimension) -> Result<MeasuredValue, QuantityError> {
    let Some((left, right)) = text.split_once('±').or_else(|| text.split_once("+-")) else {
        return Ok(MeasuredValue { value: parse_quantity(text, dimension)?, u: None });
    };
    let u = parse_quantity(right, dimension)?;
    if u < 0.0 {
        return Err(QuantityError::NegativeUncertainty);
    }
    // "12 ± 1 urad": the unit after the uncertainty applies to both.
    let left = left.trim();
    let value = match split_number(left) {
        (number, "") => {
            let (_, unit) = split_number(right.trim());
            Unit::find(unit.trim(), dimension)?.checked(parse_number(number, left)?)?
        }
        _ => parse_quantity(left, dimension)?,
    };
    Ok(MeasuredValue { value, u: Some(u) })
}

/// The longest leading part that looks like a number, and the rest.
fn split_number(text: &str) -> (&str, &str) {
    let mut end = 0;
    let mut previous = ' ';
    for (i, c) in text.char_indices() {
        let sign_of_exponent = matches!(c, '+' | '-') && matches!(previous, 'e' | 'E');
        let leading_sign = matches!(c, '+' | '-') && i == 0;
        let exponent = matches!(c, 'e' | 'E')
            && previous.is_ascii_digit()
            && text[i + 1..].starts_with(|n: char| n.is_ascii_digit() || n == '+' || n == '-');
        if !(c.is_ascii_digit() || c == '.' || leading_sign || exponent || sign_of_exponent) {
            break;
        }
        previous = c;
        end = i + c.len_utf8();
    }
    text.split_at(end)
}

fn parse_number(number: &str, whole: &str) -> Result<f64, QuantityError> {
    let word = whole.trim_start_matches(['+', '-']).to_ascii_lowercase();
    if ["nan", "inf"].iter().any(|w| word.starts_with(w)) {
        return Err(QuantityError::NotFinite(whole.to_owned()));
    }
    let value: f64 = number.parse().map_err(|_| QuantityError::NotANumber(whole.to_owned()))?;
    if value.is_finite() { Ok(value) } else { Err(QuantityError::NotFinite(whole.to_owned())) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_and_units() {
        assert_eq!(parse_quantity("-1.5e3 um", Dimension::Length), Ok(-1.5));
        assert_eq!(parse_quantity("3mm", Dimension::Length), Ok(3.0));
        assert_eq!(parse_quantity("180°", Dimension::Angle), Ok(std::f64::consts::PI));
        assert_eq!(parse_quantity("10.8 um/(m·K)", Dimension::Expansion), Ok(10.8e-6));
        assert_eq!(parse_quantity("6 1/min", Dimension::AngularVelocity), Ok(PI / 5.0));
    }

    #[test]
    fn refusals_say_what_is_wrong() {
        use QuantityError as E;
        assert!(matches!(parse_quantity("nan mm", Dimension::Length), Err(E::NotFinite(_))));
        assert!(matches!(parse_quantity("1e999 mm", Dimension::Length), Err(E::NotFinite(_))));
        assert!(matches!(parse_quantity("1e308 m", Dimension::Length), Err(E::TooLarge(..))));
        assert!(matches!(parse_quantity("mm", Dimension::Length), Err(E::NotANumber(_))));
        assert!(matches!(parse_quantity("1", Dimension::Angle), Err(E::NoUnit(_))));
        assert!(matches!(parse_quantity("1 furlong", Dimension::Length), Err(E::UnknownUnit(..))));
        assert!(matches!(
            parse_quantity("1 deg", Dimension::Length),
            Err(E::WrongDimension { found: Dimension::Angle, .. })
        ));
        assert_eq!(parse_measured("1 ± -2 mm", Dimension::Length), Err(E::NegativeUncertainty));
    }
}
