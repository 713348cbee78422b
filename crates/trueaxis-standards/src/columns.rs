//! The columns that a table of readings may have: for who maps a table of another program.

use crate::Standard;

/// A column of a table of readings.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Column {
    /// Its name without the unit, as in a mapping file.
    pub name: &'static str,
    /// What it holds, in words.
    pub title: &'static str,
    /// Units that are usual for it; none where it has no unit.
    pub units: &'static [&'static str],
    /// Several of them are numbered: `up_1`, `up_2`.
    pub is_numbered: bool,
    /// What its words mean; none where it has numbers or any words.
    pub words: &'static [&'static str],
}

const fn column(name: &'static str, title: &'static str, units: &'static [&'static str]) -> Column {
    Column { name, title, units, is_numbered: false, words: &[] }
}

const fn words(name: &'static str, title: &'static str, words: &'static [&'static str]) -> Column {
    Column { name, title, units: &[], is_numbered: false, words }
}

const fn numbered(
    name: &'static str,
    title: &'static str,
    units: &'static [&'static str],
) -> Column {
    Column { name, title, units, is_numbered: true, words: &[] }
}

const PLACE: &[&str] = &["mm", "um", "m", "in", "deg", "rad"];
const LENGTH: &[&str] = &["mm", "um", "m", "in"];
const SMALL: &[&str] = &["um", "mm", "nm", "in", "arcsec", "urad", "deg"];
const TILT: &[&str] = &["arcsec", "urad", "mrad", "deg"];
const ANGLE: &[&str] = &["deg", "rad"];
const TIME: &[&str] = &["s", "min", "h", "ms"];
const UP_DOWN: &[&str] = &["up", "down"];

const TIME_COLUMN: Column = column("time", "time of the reading", TIME);
const TEMPERATURE: Column = column("temperature", "temperature at the reading", &["degC"]);
const RUN: Column = column("run", "number of the run", &[]);

/// Of ISO 230-2 and its relatives.
const POSITIONING: &[Column] = &[
    column("target", "target position", PLACE),
    RUN,
    words("direction", "direction of approach", UP_DOWN),
    column("deviation", "deviation: actual less target", SMALL),
    column("actual", "actual position", PLACE),
    numbered("up", "deviation of one run, rising", SMALL),
    numbered("down", "deviation of one run, falling", SMALL),
    numbered("actual_up", "actual position of one run, rising", PLACE),
    numbered("actual_down", "actual position of one run, falling", PLACE),
    TIME_COLUMN,
    TEMPERATURE,
];

const DIAGONALS: &[Column] = &[
    words("diagonal", "which diagonal: +++, ++-, +-+, +-- or +X+Y …", &[]),
    column("target", "target position along the diagonal", LENGTH),
    RUN,
    words("direction", "direction of approach", UP_DOWN),
    column("deviation", "deviation: actual less target", SMALL),
    column("actual", "actual position along the diagonal", LENGTH),
    TIME_COLUMN,
    TEMPERATURE,
];

const CIRCLE: &[Column] = &[
    column("angle", "angle of the point", ANGLE),
    column("deviation", "radial deviation", &["um", "mm", "nm", "in"]),
    column("radius", "measured radius", LENGTH),
    column("x", "X of the point", LENGTH),
    column("y", "Y of the point", LENGTH),
    column("z", "Z of the point", LENGTH),
    words("direction", "sense of contouring", &["cw", "ccw"]),
    TIME_COLUMN,
    TEMPERATURE,
];

const DRIFT: &[Column] = &[
    TIME_COLUMN,
    column("x", "drift in X", SMALL),
    column("y", "drift in Y", SMALL),
    column("z", "drift in Z", SMALL),
    column("tilt_a", "tilt about X", TILT),
    column("tilt_b", "tilt about Y", TILT),
    column("spindle", "temperature of the spindle", &["degC"]),
    column("ambient", "temperature of the air", &["degC"]),
    numbered("sensor", "temperature of another sensor", &["degC"]),
];

const ROTATION: &[Column] = &[
    column("angle", "angle of the axis", ANGLE),
    column("radial", "radial reading of one sensor", &["um", "mm", "nm"]),
    column("x", "reading of the sensor along X", &["um", "mm", "nm"]),
    column("y", "reading of the sensor along Y", &["um", "mm", "nm"]),
    column("axial", "axial reading", &["um", "mm", "nm"]),
    TIME_COLUMN,
    TEMPERATURE,
];

const GEOMETRY: &[Column] = &[
    column("position", "position along the line; of a level, of its rear foot", LENGTH),
    column("deviation", "deviation from the line", &["um", "mm", "nm", "in"]),
    column("angle", "reading of a level or an autocollimator", TILT),
    words("setup", "set-up of the straightedge or square", &["normal", "reversed"]),
    words("axis", "the axis that moved: X, Y or Z", &[]),
    words("line", "name of the line", &[]),
    column("x", "X of a point of the plane", LENGTH),
    column("y", "Y of a point of the plane", LENGTH),
    column("z", "height of a point of the plane", &["um", "mm", "in"]),
    column("from_x", "X where the step begins", LENGTH),
    column("from_y", "Y where the step begins", LENGTH),
    column("to_x", "X where the step ends", LENGTH),
    column("to_y", "Y where the step ends", LENGTH),
    TEMPERATURE,
];

const PROBING: &[Column] = &[
    words("test", "kind of test", &["point", "tool", "ring", "sphere"]),
    column("x", "X at the trigger", LENGTH),
    column("y", "Y at the trigger", LENGTH),
    column("z", "Z at the trigger", LENGTH),
    words("direction", "direction of probing: +X, -X …", &[]),
    column("orientation", "orientation of the spindle", ANGLE),
    RUN,
];

impl Standard {
    /// The columns that its table may have.
    ///
    /// ```
    /// use trueaxis_standards::Standard;
    /// let first = Standard::Iso230_2.columns()[0];
    /// assert_eq!((first.name, first.units[0]), ("target", "mm"));
    /// ```
    pub fn columns(self) -> &'static [Column] {
        match self {
            Self::Iso230_1 => GEOMETRY,
            Self::Iso230_2 | Self::Gbt17421_2 | Self::Vdi3441 | Self::B5_54 => POSITIONING,
            Self::Iso230_3 => DRIFT,
            Self::Iso230_4 => CIRCLE,
            Self::Iso230_6 => DIAGONALS,
            Self::Iso230_7 => ROTATION,
            Self::Iso230_10 => PROBING,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use trueaxis_input::foreign::Mapping;

    #[test]
    fn a_mapping_file_takes_every_column_in_each_of_its_units() {
        for column in Standard::ALL.iter().flat_map(|standard| standard.columns()) {
            let name = match column.is_numbered {
                true => format!("{}_1", column.name),
                false => column.name.to_owned(),
            };
            let units = column.units.iter().map(|unit| format!("unit = '{unit}'\n"));
            let units = if column.units.is_empty() { vec![String::new()] } else { units.collect() };
            for unit in units {
                let text = format!("[columns.{name}]\ncolumn = 1\n{unit}");
                let (mapping, problems) = Mapping::parse("m.toml", &text);
                assert!(mapping.is_some(), "{text}{problems:?}");
            }
        }
    }
}
