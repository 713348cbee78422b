//! Evaluation of readings of instruments by ISO 230 and related standards, each result with its clause;
//! docs/model.md eq. 60 on.
//!
//! - [`iso230_1`]: straightness, flatness, squareness and parallelism;
//! - [`iso230_2`]: positioning of linear and rotary axes (also GB/T 17421.2, VDI/DGQ 3441 and the form
//!   of ASME B5.54);
//! - [`iso230_3`]: drift; [`iso230_4`]: circular tests; [`iso230_6`]: diagonals; [`iso230_7`]: error
//!   motion of rotary axes;
//! - [`iso230_10`]: touch probes;
//! - [`form`]: elements through points, their form deviation (ISO 1101, ISO 12181, ISO 12780);
//! - [`import`]: files of other programs are converted to tables; [`report`]: an evaluation as text, JSON and a page.
//!
//! ```
//! use trueaxis_input::Diagnostics;
//! use trueaxis_standards::conditions::Conditions;
//! use trueaxis_standards::{Evaluated, Request, Standard, evaluate};
//! // Two targets, five runs up and five down; all readings are 0 up and 3 µm down.
//! let mut text = "target_mm,run,direction,deviation_um\n".to_owned();
//! for (run, target) in (1..=5).flat_map(|run| [0, 100, 200, 300, 400].map(|target| (run, target))) {
//!     text += &format!("{target},{run},up,0\n{target},{run},down,3\n");
//! }
//! let conditions = Conditions::default();
//! let request = Request {
//!     standard: Standard::Iso230_2,
//!     file: "x.csv",
//!     text: &text,
//!     conditions: &conditions,
//!     conditions_file: "",
//!     window_s: 900.0,
//! };
//! let evaluated = evaluate(&request, &mut Diagnostics::new());
//! let Some(Evaluated::Positioning(_, parameters)) = evaluated else { panic!() };
//! let reversal_mm = parameters.value(trueaxis_standards::iso230_2::Quantity::B).unwrap();
//! assert!((reversal_mm - 0.003).abs() < 1e-12);
//! ```
//!
//! Every standard reads a table of named columns ([`trueaxis_input::sheet`]) and what is known in addition
//! ([`conditions`]). What is missing in a test is a diagnostic with the clause; what can be evaluated is. It knows no
//! machine file.

pub mod columns;
pub mod conditions;
pub mod coverage;
mod deviations;
pub mod form;
pub mod import;
pub mod iso230_1;
pub mod iso230_10;
pub mod iso230_2;
pub mod iso230_3;
pub mod iso230_4;
pub mod iso230_6;
pub mod iso230_7;
pub mod judge;
mod least_squares;
pub mod report;

use conditions::{Conditions, unsound_temperature};
use import::{From, Import};
use iso230_1::Geometric;
use iso230_2::{Budget, Measurement, Positioning};
use iso230_3::Drift;
use iso230_4::Circular;
use iso230_6::Diagonals;
use iso230_7::Rotation;
use iso230_10::Probing;
use judge::Decision;
use trueaxis_input::foreign::Mapping;
use trueaxis_input::sheet::{self, Cells, Sheet};
use trueaxis_input::{Diagnostics, Dimension, Place, Unit};

/// The JSON Schemas of the documents of this crate, by name; `evaluate`, which has the errors of a machine file as
/// well, is one of `trueaxis-condition`.
#[cfg(feature = "schemas")]
pub fn schemas() -> Vec<trueaxis_report::NamedSchema> {
    use trueaxis_report::named_schema;
    vec![named_schema::<report::FormDocument<'_>>("evaluate-form")]
}

/// A standard that readings can be evaluated by.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Standard {
    /// Straightness, flatness, squareness and parallelism.
    Iso230_1,
    /// Positioning of one axis.
    Iso230_2,
    /// The same in China.
    Gbt17421_2,
    /// Positioning as VDI/DGQ 3441 states it.
    Vdi3441,
    /// Positioning in the form of ASME B5.54.
    B5_54,
    /// Drift and environmental temperature variation error.
    Iso230_3,
    /// Circular tests.
    Iso230_4,
    /// Body and face diagonals.
    Iso230_6,
    /// Error motion of rotary axes.
    Iso230_7,
    /// Probing performance.
    Iso230_10,
}

impl Standard {
    /// All of them.
    pub const ALL: [Self; 10] = [
        Self::Iso230_1,
        Self::Iso230_2,
        Self::Gbt17421_2,
        Self::Vdi3441,
        Self::B5_54,
        Self::Iso230_3,
        Self::Iso230_4,
        Self::Iso230_6,
        Self::Iso230_7,
        Self::Iso230_10,
    ];

    /// The name on the command line and in JSON.
    pub fn key(self) -> &'static str {
        match self {
            Self::Iso230_1 => "iso230-1",
            Self::Iso230_2 => "iso230-2",
            Self::Gbt17421_2 => "gbt17421-2",
            Self::Vdi3441 => "vdi3441",
            Self::B5_54 => "b5.54",
            Self::Iso230_3 => "iso230-3",
            Self::Iso230_4 => "iso230-4",
            Self::Iso230_6 => "iso230-6",
            Self::Iso230_7 => "iso230-7",
            Self::Iso230_10 => "iso230-10",
        }
    }

    /// The name in text output.
    pub fn title(self) -> &'static str {
        match self {
            Self::Iso230_1 => "ISO 230-1, straightness, flatness, squareness, parallelism",
            Self::Iso230_2 => "ISO 230-2:2014, positioning",
            Self::Gbt17421_2 => "GB/T 17421.2 (the parameters of ISO 230-2:2014), positioning",
            Self::Vdi3441 => "VDI/DGQ 3441, positioning",
            Self::B5_54 => "in the form of ASME B5.54, positioning",
            Self::Iso230_3 => "ISO 230-3, drift and environmental temperature variation error",
            Self::Iso230_4 => "ISO 230-4, circular test",
            Self::Iso230_6 => "ISO 230-6, diagonals",
            Self::Iso230_7 => "ISO 230-7, error motion of a rotary axis",
            Self::Iso230_10 => "after ISO 230-10, probing performance",
        }
    }
}

/// What to evaluate.
#[derive(Debug, Clone, Copy)]
pub struct Request<'a> {
    /// By which standard.
    pub standard: Standard,
    /// The file of the readings, as the user named it.
    pub file: &'a str,
    /// Its text.
    pub text: &'a str,
    /// The conditions of the readings.
    pub conditions: &'a Conditions,
    /// The file that states them.
    pub conditions_file: &'a str,
    /// Length of the windows of ISO 230-3, s.
    pub window_s: f64,
}

/// The readings, evaluated.
#[derive(Debug, Clone, PartialEq)]
pub enum Evaluated {
    /// ISO 230-2 and its relatives: the readings and the parameters.
    Positioning(Measurement, Box<Positioning>),
    /// ISO 230-1.
    Geometric(Box<Geometric>),
    /// ISO 230-3.
    Drift(Drift),
    /// ISO 230-4.
    Circular(Box<Circular>),
    /// ISO 230-6.
    Diagonals(Diagonals),
    /// ISO 230-7.
    Rotation(Rotation),
    /// ISO 230-10.
    Probing(Probing),
}

impl Evaluated {
    /// Whether it is within its tolerance, where the test has one.
    pub fn is_yes(&self) -> bool {
        match self {
            Self::Geometric(test) => test.outcome.is_none_or(|o| o == Decision::Conforming),
            Self::Probing(test) => test.is_yes(),
            _ => true,
        }
    }
}

/// Evaluates readings by a standard; `None` with errors in `problems`.
pub fn evaluate(request: &Request<'_>, problems: &mut Diagnostics) -> Option<Evaluated> {
    let Request { file, text, conditions, .. } = *request;
    if !deviations::are_possible(request, problems) {
        return None;
    }
    match request.standard {
        Standard::Iso230_2 | Standard::Gbt17421_2 | Standard::Vdi3441 | Standard::B5_54 => {
            let measurement = iso230_2::read(file, text, problems)?;
            compare_temperatures(request, problems);
            iso230_2::check(&measurement, file, problems);
            let place = Place::whole(request.conditions_file);
            let (kind, length) = (measurement.kind, measurement.length());
            let budget = Budget::new(conditions, kind, length, &place, problems);
            let result = iso230_2::evaluate(&measurement, budget);
            Some(Evaluated::Positioning(measurement, Box::new(result)))
        }
        Standard::Iso230_1 => {
            let test = iso230_1::evaluate(file, text, conditions, problems)?;
            Some(Evaluated::Geometric(Box::new(test)))
        }
        Standard::Iso230_3 => {
            iso230_3::evaluate(file, text, request.window_s, problems).map(Evaluated::Drift)
        }
        Standard::Iso230_6 => {
            compare_temperatures(request, problems);
            iso230_6::evaluate(file, text, conditions, problems).map(Evaluated::Diagonals)
        }
        Standard::Iso230_10 => {
            iso230_10::evaluate(file, text, conditions, problems).map(Evaluated::Probing)
        }
        Standard::Iso230_7 => iso230_7::evaluate(file, text, problems).map(Evaluated::Rotation),
        Standard::Iso230_4 => {
            let mut circle = iso230_4::evaluate(file, text, conditions.circle, problems)?;
            let place = Place::whole(request.conditions_file);
            circle.diagnosis = iso230_4::diagnose(&circle, conditions, &place, problems);
            Some(Evaluated::Circular(Box::new(circle)))
        }
    }
}

/// Readings as a user provides them.
#[derive(Debug, Clone, Copy)]
pub struct Readings<'a> {
    /// By which standard.
    pub standard: Standard,
    /// The file, as the user named it.
    pub file: &'a str,
    /// Its text.
    pub text: &'a str,
    /// Its form.
    pub import: Import,
    /// Which feature of a form that holds several.
    pub feature: Option<&'a str>,
    /// Which column is what, where the headings do not say it.
    pub mapping: Option<&'a Mapping>,
    /// The conditions of the readings.
    pub conditions: &'a Conditions,
    /// The file that states them.
    pub conditions_file: &'a str,
    /// Length of the windows of ISO 230-3, s.
    pub window_s: f64,
}

/// Reads a text of any form and evaluates it; also returns the conditions of the readings: those that were given
/// and those in the text. No result with errors in `problems`.
pub fn evaluate_text(
    readings: &Readings<'_>,
    problems: &mut Diagnostics,
) -> (Option<Evaluated>, Conditions) {
    let Readings { standard, file, text, feature, mapping, conditions, .. } = *readings;
    let Readings { conditions_file, window_s, .. } = *readings;
    let read = readings.import.read(&From { standard, file, text, feature, mapping }, problems);
    let Some(read) = read else { return (None, conditions.clone()) };
    let conditions = read.conditions(conditions);
    let text = read.table();
    let request =
        Request { standard, file, text, conditions: &conditions, conditions_file, window_s };
    let mut evaluated = evaluate(&request, problems);
    if let Some(evaluated) = &mut evaluated {
        read.finish(evaluated, file, problems);
    }
    (evaluated, conditions)
}

/// Temperatures in other units than stated, or under the wrong heading.
fn check_temperatures(sheet: &Sheet, problems: &mut Diagnostics) {
    let about =
        |c: &&sheet::Column| c.role() == "temperature" || c.role().ends_with("_temperature");
    for column in sheet.columns.iter().filter(about) {
        if let Err(e) = Unit::find(column.unit(), Dimension::Temperature) {
            let message = format!("column `{}`: {e}", column.name);
            problems.error(e.code(), column.place.clone(), message, &e.hint());
            continue;
        }
        let unsound = column.values.iter().enumerate();
        let mut unsound = unsound.filter_map(|(i, v)| Some((i, *v, unsound_temperature(*v)?)));
        if let Some((row, value, hint)) = unsound.next() {
            let more = unsound.count();
            let message = match more {
                0 => format!("`{}` is {value} °C", column.name),
                n => format!("`{}` is {value} °C, and {n} more such readings", column.name),
            };
            problems.error("temperature-range", sheet.row_place(row), message, &hint);
        }
    }
}

/// The temperature that is stated enters U; one that was recorded beside the readings and contradicts it is named.
fn compare_temperatures(request: &Request<'_>, problems: &mut Diagnostics) {
    /// Recorded temperatures may be those of the air: less in the mean is not remarked on, K.
    const SMALL_K: f64 = 1.0;
    /// So far off a single one is remarked on, K.
    const LARGE_K: f64 = 5.0;
    let Some(stated) = request.conditions.temperature_c else { return };
    // What is wrong with the table is reported where it is evaluated.
    let mut none = Diagnostics::new();
    let cells = iso230_2::role_cells;
    let Some(sheet) = Sheet::parse(request.file, request.text, cells, &mut none) else { return };
    let Some(column) = sheet.columns.iter().find(|c| c.role() == "temperature") else { return };
    let of_unit = Unit::find(column.unit(), Dimension::Temperature).is_ok();
    let [low, high] = [f64::min, f64::max].map(|f| column.values.iter().copied().reduce(f));
    let (Some(low), Some(high), true) = (low, high, of_unit) else { return };
    let (value, u) = (stated.value, stated.u.unwrap_or(0.0));
    let mean = column.values.iter().sum::<f64>() / column.values.len() as f64;
    let farthest = (high - value).max(value - low);
    if (mean - value).abs() > SMALL_K.max(3.0 * u) || farthest > LARGE_K.max(3.0 * u) {
        let message = format!(
            "`{}` is {low:.1} to {high:.1} °C, the conditions state {value:.1} °C: U is that of the stated one",
            column.name
        );
        let hint = "temperature = \"… ± … degC\" in the conditions: that of the scale during the test; or is the column \
                    that of another sensor?";
        problems.warn("other-temperature", column.place.clone(), message, hint);
    }
}

/// Times that run backwards: an error where they matter. `false` if they do.
fn check_times(sheet: &Sheet, matter: bool, problems: &mut Diagnostics) -> bool {
    let Some(column) = sheet.columns.iter().find(|c| sheet::heading(&c.name).0 == "time") else {
        return true;
    };
    if column.cells == Cells::Unused {
        return true;
    }
    if let Err(e) = Unit::find(column.unit(), Dimension::Time) {
        let message = format!("column `{}`: {e}", column.name);
        problems.error(e.code(), column.place.clone(), message, &e.hint());
        return false;
    }
    let Some(row) = column.values.windows(2).position(|w| w[1] < w[0]) else { return true };
    let message = format!(
        "`{}` runs backwards, from {} to {}",
        column.name,
        column.values[row],
        column.values[row + 1]
    );
    let hint = "are two logs joined, or the clock put back? sort or split the file";
    let place = sheet.row_place(row + 1);
    match matter {
        true => problems.error("time-backwards", place, message, hint),
        false => problems.warn("time-backwards", place, message, hint),
    }
    false
}
