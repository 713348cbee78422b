//! The conditions of the readings: a small TOML file next to the data.

pub mod geometry;
pub mod probing;

use geometry::Geometry;
use probing::ProbingTest;
use std::path::Path;
use trueaxis_geometry::Vec3;
use trueaxis_input::plausible::{Limits, Quantity, Standing};
use trueaxis_input::{Diagnostics, Dimension, Files, Item, MeasuredValue, Section, SourceText};

/// Limits for temperatures of air and machine, °C; a value outside is in another unit.
pub const SOUND_TEMPERATURES_C: std::ops::RangeInclusive<f64> = -10.0..=60.0;

/// A length or an angle, as the instrument needs it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Extent {
    /// mm.
    Length(f64),
    /// rad; for a length of 1 mm this is the ratio mm/mm.
    Angle(f64),
}

/// What is known of the instrument and its set-up, for the measurement uncertainty.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Instrument {
    /// Expanded uncertainty (k = 2) of its calibration: absolute, or in proportion to the length.
    pub device_expanded: Option<Extent>,
    /// Range of the lateral offset of the beam over the measuring length, mm.
    pub misalignment_range_mm: Option<f64>,
    /// Coefficient of expansion that the correction used, 1/K, with its standard uncertainty.
    pub expansion_per_k: Option<MeasuredValue>,
    /// Range of the drift during a test: the environmental variation E_VE.
    pub eve_range: Option<Extent>,
}

/// The nominal circle of a circular test.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Circle {
    /// Centre, mm, in the two axes of the data.
    pub centre_mm: Option<[f64; 2]>,
    /// Radius, mm.
    pub radius_mm: Option<f64>,
    /// The two axes, where the columns do not name them: the angle counts from the first to the second.
    pub plane: Option<[char; 2]>,
    /// Standard uncertainty of the length of the instrument, if it is calibrated, mm.
    pub length_u_mm: Option<f64>,
    /// Pitch of the screws or scales of the two axes, for errors that repeat with it, mm.
    pub pitch_mm: [Option<f64>; 2],
    /// Feed along the circle, mm/s.
    pub feed_mm_s: Option<f64>,
}

/// The conditions of the readings.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Conditions {
    /// What was measured, in words.
    pub name: Option<String>,
    /// The machine, in words.
    pub machine: Option<String>,
    /// The axis that was measured.
    pub axis: Option<String>,
    /// When.
    pub date: Option<String>,
    /// With what.
    pub instrument_name: Option<String>,
    /// Temperature of the machine at the scale, °C, with its standard uncertainty.
    pub temperature_c: Option<MeasuredValue>,
    /// For the measurement uncertainty.
    pub instrument: Option<Instrument>,
    /// For circular tests.
    pub circle: Circle,
    /// Where the other axes stood during a circular test: `Z=-200 C=90`.
    pub circle_at: Option<String>,
    /// Edges of the volume whose diagonals were measured, mm.
    pub edges_mm: Option<Vec3>,
    /// The geometric test (ISO 230-1).
    pub test: Option<Geometry>,
    /// The probing test (ISO 230-10).
    pub probing: Option<ProbingTest>,
    /// What readings may be.
    pub limits: Limits,
}

/// Reads a file of conditions; without one, or if it cannot be read, nothing is known.
pub fn read_conditions(
    files: &Files,
    path: Option<&Path>,
    problems: &mut Diagnostics,
) -> Conditions {
    let what = "a file of conditions (TOML)";
    let Some((path, text)) = path.and_then(|p| Some((p, files.text(p, what, problems)?))) else {
        return Conditions::default();
    };
    problems.keep(Conditions::read(&path.display().to_string(), &text))
}

impl Conditions {
    /// Reads a text; what is wrong comes with its place.
    pub fn read(file: &str, text: &str) -> (Self, Diagnostics) {
        let source = SourceText::new(file, text);
        let conditions = source.read(read_root);
        (conditions, source.finish())
    }
}

fn read_root(root: &Section<'_>) -> Conditions {
    let text = |key: &str| root.text(key).map(str::to_owned);
    let temperature = root.get("temperature");
    let measured = temperature.and_then(|item| item.measured(Dimension::Temperature));
    if let (Some(item), Some(value)) = (temperature, measured)
        && item.limits().standing(Quantity::Temperature, value.value) != Standing::Plausible
        && let Some(hint) = unsound_temperature(value.value)
    {
        let message = format!("{} °C is not a possible temperature of a machine", value.value);
        item.error("temperature-range", message, &hint);
    }
    let circle = root.section("circle", read_circle).unwrap_or_default();
    let edges = root.section("volume", |s| s.get("edges").and_then(|item| edges(&item)));
    Conditions {
        name: text("name"),
        machine: text("machine"),
        axis: text("axis"),
        date: root.get("date").and_then(|item| item.date_or_text()),
        instrument_name: text("instrument"),
        temperature_c: measured,
        instrument: root.section("uncertainty", read_instrument),
        circle: circle.0,
        circle_at: circle.1,
        test: root.section("test", geometry::read).flatten(),
        probing: root.section("probing", probing::read),
        limits: root.limits(),
        edges_mm: edges.flatten().map(|[x, y, z]| Vec3::new(x, y, z)),
    }
}

fn read_circle(s: &Section<'_>) -> (Circle, Option<String>) {
    let plane = s.get("plane").and_then(|item| {
        let found = match item.text()? {
            "XY" => Some(['X', 'Y']),
            "YZ" => Some(['Y', 'Z']),
            "ZX" => Some(['Z', 'X']),
            _ => None,
        };
        if found.is_none() {
            let message = "no such plane".to_owned();
            item.error("bad-plane", message, "\"XY\", \"YZ\" or \"ZX\"; or columns x_mm, z_mm …");
        }
        found
    });
    let pitch = |key: &str| s.get(key).and_then(|item| positive(&item, Dimension::Length));
    let circle = Circle {
        centre_mm: s.get("centre").and_then(|item| lengths::<2>(&item)),
        radius_mm: s.get("radius").and_then(|item| positive(&item, Dimension::Length)),
        plane,
        length_u_mm: s.get("length_u").and_then(|item| positive(&item, Dimension::Length)),
        pitch_mm: [pitch("pitch_first"), pitch("pitch_second")],
        feed_mm_s: s.get("feed").and_then(|item| positive(&item, Dimension::Velocity)),
    };
    (circle, s.text("at").map(str::to_owned))
}

fn read_instrument(section: &Section<'_>) -> Instrument {
    let extent = |key: &str| section.get(key).and_then(|item| extent(&item, UNCERTAINTY));
    let expansion = section.get("expansion");
    let expansion_per_k = expansion.and_then(|item| item.measured(Dimension::Expansion));
    if let (Some(item), Some(MeasuredValue { u: None, .. })) = (expansion, expansion_per_k) {
        let message = "the coefficient of expansion has no uncertainty".to_owned();
        let hint = "write \"11.5 ± 1 um/(m·K)\"; without it the coefficient counts as exact";
        item.warn("missing-uncertainty", message, hint);
    }
    Instrument {
        device_expanded: extent("device_expanded"),
        misalignment_range_mm: section
            .get("misalignment_range")
            .and_then(|item| positive(&item, Dimension::Length)),
        expansion_per_k,
        eve_range: extent("eve_range"),
    }
}

/// What a length and an angle are that state how well something is known.
const UNCERTAINTY: [Quantity; 2] = [Quantity::Noise, Quantity::AngularNoise];
/// The same of a limit.
const LIMIT: [Quantity; 2] = [Quantity::Deviation, Quantity::AngularDeviation];

/// A length (`0.5 um`), an angle (`0.2 arcsec`) or a ratio (`0.5 um/m`, which is an angle too).
fn extent(item: &Item<'_>, [of_length, of_angle]: [Quantity; 2]) -> Option<Extent> {
    use trueaxis_input::parse_quantity;
    let text = item.text()?;
    let length = parse_quantity(text, Dimension::Length).map(Extent::Length);
    let read = length.or_else(|_| parse_quantity(text, Dimension::Angle).map(Extent::Angle));
    match read {
        Ok(Extent::Length(v) | Extent::Angle(v)) if v < 0.0 => {
            let message = format!("`{text}` is negative");
            item.error("negative-uncertainty", message, "it is zero or positive");
            None
        }
        // Nothing at all is no slip of the unit.
        Ok(extent @ (Extent::Length(0.0) | Extent::Angle(0.0))) => Some(extent),
        Ok(extent) => {
            let (quantity, value) = match extent {
                Extent::Length(v) => (of_length, v),
                Extent::Angle(v) => (of_angle, v),
            };
            item.is_possible(quantity, value).then_some(extent)
        }
        Err(e) => {
            item.error(e.code(), e.to_string(), "such as \"0.5 um\", \"0.5 um/m\", \"0.2 arcsec\"");
            None
        }
    }
}

fn positive(item: &Item<'_>, dimension: Dimension) -> Option<f64> {
    let value = item.quantity(dimension)?;
    if value <= 0.0 {
        item.error("not-positive", format!("{value} is not positive"), "write a positive value");
        return None;
    }
    Some(value)
}

/// The edges of a volume.
fn edges(item: &Item<'_>) -> Option<[f64; 3]> {
    let edges = lengths::<3>(item)?;
    if let Some(edge) = edges.into_iter().find(|edge| *edge <= 0.0) {
        let hint = "the lengths of the edges along X, Y and Z, such as \"500 400 300 mm\"";
        item.error("not-positive", format!("an edge of {edge} mm is not positive"), hint);
        return None;
    }
    Some(edges)
}

/// `"500 400 300 mm"`.
fn lengths<const N: usize>(item: &Item<'_>) -> Option<[f64; N]> {
    use trueaxis_input::parse_quantity;
    let text = item.text()?;
    let mut words: Vec<&str> = text.split_whitespace().collect();
    let unit = words.pop().unwrap_or_default();
    let read = |word: &&str| parse_quantity(&format!("{word} {unit}"), Dimension::Length);
    let values: Result<Vec<f64>, _> = words.iter().map(read).collect();
    let values = values.ok().and_then(|v| <[f64; N]>::try_from(v).ok());
    if values.is_none() {
        let message = format!("`{text}` is not {N} lengths");
        item.error("bad-vector", message, "numbers, then the unit, such as \"0 0 mm\"");
    }
    values
}

/// The hint for a temperature that no machine can have.
pub fn unsound_temperature(value_c: f64) -> Option<String> {
    if SOUND_TEMPERATURES_C.contains(&value_c) {
        return None;
    }
    let celsius = (value_c - 32.0) / 1.8;
    Some(match () {
        () if (250.0..=340.0).contains(&value_c) => {
            format!(
                "is it kelvin? that would be {:.1} °C; or are columns swapped?",
                value_c - 273.15
            )
        }
        () if SOUND_TEMPERATURES_C.contains(&celsius) => {
            format!("is it Fahrenheit? that would be {celsius:.1} °C; or are columns swapped?")
        }
        () => "temperatures are written in °C; are columns swapped?".to_owned(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fahrenheit_is_seen() {
        assert_eq!(unsound_temperature(20.0), None);
        assert!(unsound_temperature(68.0).unwrap().contains("20.0 °C"));
        assert!(unsound_temperature(293.15).unwrap().contains("kelvin"));
        let (_, problems) = Conditions::read("x.toml", "temperature = '72 degC'");
        assert_eq!(problems.iter().next().unwrap().code, "temperature-range");
    }

    #[test]
    fn instrument_data_are_read_with_their_units() {
        let text = "temperature = '22 ± 0.2 degC'\n[uncertainty]\ndevice_expanded = '0.5 um/m'\n\
                    eve_range = '1.2 um'\nexpansion = '11.5 ± 1 um/(m·K)'\n[circle]\n\
                    radius = '150 mm'\ncentre = '1 2 mm'\n[volume]\nedges = '500 400 300 mm'";
        let (read, problems) = Conditions::read("x.toml", text);
        assert!(problems.iter().next().is_none(), "{problems:?}");
        let instrument = read.instrument.unwrap();
        assert_eq!(instrument.device_expanded, Some(Extent::Angle(0.5e-6)));
        assert_eq!(instrument.eve_range, Some(Extent::Length(0.0012)));
        assert_eq!(read.circle.centre_mm, Some([1.0, 2.0]));
        assert_eq!(read.edges_mm.unwrap().y, 400.0);
    }
}
