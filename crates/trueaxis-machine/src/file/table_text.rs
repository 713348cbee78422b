//! Tables of error motions: columns of a CSV file to curves.

use super::error_text::{dimension_of, judge_error};
use crate::axis::{Axis, AxisKind, Travel};
use crate::errors::{
    Component, Curve, ErrorKind, ErrorName, Extrapolation, Interpolation, Spline, SplineError,
    Uncertainty,
};
use std::f64::consts::TAU;
use trueaxis_input::plausible::Limits;
use trueaxis_input::{CsvColumn, CsvTable, Diagnostics, Dimension, Place, Unit};

/// Two positions closer than this, in mm or rad, are one position with two values.
const CLOSEST: f64 = 1e-9;

/// What a command on this axis is measured in.
pub fn position_dimension(kind: AxisKind) -> Dimension {
    match kind {
        AxisKind::Linear => Dimension::Length,
        AxisKind::Rotary => Dimension::Angle,
    }
}

/// Interpolation of a table, its continuation outside, and what its values may be.
#[derive(Clone, Copy)]
pub struct TableHabits {
    pub interpolation: Interpolation,
    pub outside: Extrapolation,
    pub limits: Limits,
}

/// The error motions of one axis over checked positions.
pub struct ErrorTable<'a> {
    axis: &'a Axis,
    table: &'a CsvTable,
    habits: TableHabits,
    positions: Vec<f64>,
    columns: [Columns<'a>; 6],
}

/// The curves of one error motion in a table.
pub struct TableCurves {
    pub mean: Curve,
    pub reversal: Option<Curve>,
    pub u: Option<Uncertainty>,
}

/// What a table holds of one error motion: mean, rising, falling, uncertainty.
#[derive(Default)]
struct Columns<'a> {
    of_role: [Option<Column<'a>>; 4],
    /// One of them could not be read, which has been reported; the others are not reported again.
    broken: bool,
}

struct Column<'a> {
    place: &'a Place,
    values: Vec<f64>,
}

#[derive(Clone, Copy)]
enum Role {
    Mean,
    Up,
    Down,
    Uncertainty,
}

impl<'a> ErrorTable<'a> {
    /// Reads the columns of an axis; with `only`, those of one error motion, and the others may be
    /// about anything.
    pub fn read(
        axis: &'a Axis,
        table: &'a CsvTable,
        habits: TableHabits,
        only: Option<Component>,
        problems: &mut Diagnostics,
    ) -> Option<Self> {
        let positions = positions(axis, table, problems);
        let mut read =
            Self { axis, table, habits, positions: Vec::new(), columns: Default::default() };
        for column in table.columns.iter().filter(|c| heading(&c.name).0 != "position") {
            read.sort(column, only, problems);
        }
        read.positions = positions?;
        read.positions_are_sound(problems).then(|| {
            read.check_cover(problems);
            read
        })
    }

    /// Whether no column is about this error motion.
    pub fn lacks(&self, component: Component) -> bool {
        let columns = &self.columns[component as usize];
        !columns.broken && columns.of_role.iter().all(Option::is_none)
    }

    /// The curves of an error motion; `None` if the table has none, or with problems.
    pub fn curves(&self, component: Component, problems: &mut Diagnostics) -> Option<TableCurves> {
        let Columns { of_role: [mean, up, down, u], broken } = &self.columns[component as usize];
        if *broken || self.lacks(component) {
            return None;
        }
        let name = format!("E{}{}", component.letter(), self.axis.name);
        let u = match u {
            Some(u) => Some(Uncertainty::Table(self.uncertainty(u, problems)?)),
            None => None,
        };
        match (mean, up, down) {
            (Some(mean), None, None) => {
                let mean = self.curve(mean.place, &mean.values, problems)?;
                Some(TableCurves { mean, reversal: None, u })
            }
            (None, Some(up), Some(down)) => {
                let of_both = |f: fn(f64, f64) -> f64| -> Vec<f64> {
                    up.values.iter().zip(&down.values).map(|(u, d)| f(*u, *d)).collect()
                };
                let mean = self.curve(up.place, &of_both(|u, d| 0.5 * (u + d)), problems)?;
                let reversal = self.curve(up.place, &of_both(|u, d| u - d), problems)?;
                Some(TableCurves { mean, reversal: Some(reversal), u })
            }
            _ => {
                let of_role = &self.columns[component as usize].of_role;
                let place = of_role.iter().flatten().next()?.place.clone();
                let message =
                    format!("{name} needs either one column or two columns _up and _down");
                problems.error("bad-table", place, message, "keep the mean or both directions");
                None
            }
        }
    }

    fn curve(&self, place: &Place, values: &[f64], problems: &mut Diagnostics) -> Option<Curve> {
        let TableHabits { interpolation, outside, .. } = self.habits;
        match Spline::new(&self.positions, values, interpolation) {
            Ok(spline) => Some(Curve::Table { spline, outside }),
            Err(error) => {
                let hint = match error {
                    SplineError::NotPeriodic { .. } => "repeat the first value in the last row",
                    _ => "sort the rows by position, each position once",
                };
                problems.error("bad-table", place.clone(), error.to_string(), hint);
                None
            }
        }
    }

    fn uncertainty(&self, u: &Column<'_>, problems: &mut Diagnostics) -> Option<Spline> {
        if let Some(row) = u.values.iter().position(|u| *u < 0.0) {
            let place = self.table.row_place(row);
            let message = "a standard uncertainty is negative".to_owned();
            problems.error(
                "negative-uncertainty",
                place,
                message,
                "write zero or a positive number",
            );
            return None;
        }
        Spline::new(&self.positions, &u.values, Interpolation::Linear).ok()
    }

    /// A table that ends before the travel does would refuse commands in the middle of a job.
    fn check_cover(&self, problems: &mut Diagnostics) {
        let (from, to) = (self.positions[0], self.positions[self.positions.len() - 1]);
        if self.habits.interpolation == Interpolation::Periodic {
            return;
        }
        let travel = match self.axis.travel {
            Travel::Between(low, high) => {
                let slack = 1e-9 * low.abs().max(high.abs()).max(1.0);
                if from <= low + slack && to >= high - slack {
                    return;
                }
                format!("{} .. {}", self.in_words(low), self.in_words(high))
            }
            Travel::Unlimited => "without end".to_owned(),
            Travel::Unknown => return,
        };
        let message = format!(
            "the table covers {} .. {} of the travel {travel} of {}",
            self.in_words(from),
            self.in_words(to),
            self.axis.name
        );
        let starts_late = matches!(self.axis.travel, Travel::Between(low, _) if from > low);
        let place = self.table.row_place(if starts_late { 0 } else { self.positions.len() - 1 });
        if self.habits.outside == Extrapolation::Error {
            let hint = match self.axis.travel {
                Travel::Unlimited => {
                    "write interpolation = \"periodic\", outside = \"clamp\" or \"extend\""
                }
                _ => {
                    "measure the rest, shorten the travel, or write outside = \"clamp\" or \
                     \"extend\""
                }
            };
            problems.error("table-too-short", place, message, hint);
        } else {
            let hint = match self.habits.outside {
                Extrapolation::Extend => "outside the table the error is extrapolated linearly",
                _ => "outside the table the last value is used",
            };
            problems.warn("table-too-short", place, message, hint);
        }
    }

    fn in_words(&self, position: f64) -> String {
        match self.axis.kind {
            AxisKind::Linear => format!("{position} mm"),
            AxisKind::Rotary => format!("{} deg", in_degrees(position)),
        }
    }

    fn positions_are_sound(&self, problems: &mut Diagnostics) -> bool {
        let positions = &self.positions;
        let whole = headings_place(self.table);
        if positions.len() < 2 {
            let message = SplineError::TooFewKnots(positions.len()).to_string();
            problems.error("bad-table", whole, message, "write one row for each measured position");
            return false;
        }
        if let Some(row) = positions.windows(2).position(|w| w[1] - w[0] < CLOSEST) {
            let message = SplineError::NotIncreasing(row + 1).to_string();
            let hint = "sort the rows by position, each position once";
            problems.error("bad-table", self.table.row_place(row + 1), message, hint);
            return false;
        }
        let turns = (positions[positions.len() - 1] - positions[0]) / TAU;
        let whole_turns = [turns, turns.recip()].iter().any(|t| (t - t.round()).abs() < 1e-9);
        let must_close = self.habits.interpolation == Interpolation::Periodic
            && self.axis.kind == AxisKind::Rotary;
        if must_close && !whole_turns {
            let span = in_degrees(turns * TAU);
            let message =
                format!("a periodic table must cover whole turns, this one covers {span} deg");
            let hint = "write rows from 0 to 360 deg, the last with the values of the first";
            problems.error("bad-table", whole, message, hint);
            return false;
        }
        true
    }

    fn sort(&mut self, column: &'a CsvColumn, only: Option<Component>, problems: &mut Diagnostics) {
        let axis = self.axis.name;
        let (name, role) = error_and_role(heading(&column.name).0);
        let parsed =
            ErrorName::parse(name).filter(|n| n.kind == ErrorKind::Motion && n.body == axis);
        if only.is_some() && parsed.map(|n| n.component) != only {
            return;
        }
        let Some(parsed) = parsed else {
            let message = format!("`{}` is not an error motion of {axis}", column.name);
            let hint = format!(
                "columns are EX{axis}_um … EC{axis}_urad, EX{axis}_up_um and EX{axis}_down_um, \
                 u_EX{axis}_um"
            );
            problems.error("unknown-error-name", column.place.clone(), message, &hint);
            return;
        };
        let dimension = dimension_of(parsed.component);
        let values = in_inner_unit(self.table, column, dimension, problems);
        let (limits, table) = (self.habits.limits, self.table);
        let values = values.filter(|values| {
            let place = |row| table.row_place(row);
            judge_error(&limits, self.axis, (&column.name, values), place, problems)
        });
        let columns = &mut self.columns[parsed.component as usize];
        let slot = &mut columns.of_role[role as usize];
        if slot.is_some() {
            let message = format!(
                "`{}`: the table has another column of {parsed} in another unit",
                column.name
            );
            problems.error("duplicate-column", column.place.clone(), message, "keep one of them");
        }
        columns.broken |= values.is_none();
        *slot = values.map(|values| Column { place: &column.place, values });
    }
}

fn positions(axis: &Axis, table: &CsvTable, problems: &mut Diagnostics) -> Option<Vec<f64>> {
    let mut columns = table.columns.iter().filter(|c| heading(&c.name).0 == "position");
    let Some(column) = columns.next() else {
        let place = headings_place(table);
        let message = "the table has no column of positions".to_owned();
        problems.error("missing-column", place, message, "name it position_mm or position_deg");
        return None;
    };
    if let Some(second) = columns.next() {
        let message = "the table has two columns of positions".to_owned();
        problems.error("duplicate-column", second.place.clone(), message, "keep one of them");
    }
    in_inner_unit(table, column, position_dimension(axis.kind), problems)
}

/// The error motion of an axis that a column is about; none for positions and what is no error of it.
pub fn error_of(column: &str, axis: &Axis) -> Option<Component> {
    let name = ErrorName::parse(error_and_role(heading(column).0).0)?;
    (name.kind == ErrorKind::Motion && name.body == axis.name).then_some(name.component)
}

/// Where the columns have their names.
pub fn headings_place(table: &CsvTable) -> Place {
    table
        .columns
        .first()
        .map_or(Place::whole(&table.file), |c| Place { column: 1, ..c.place.clone() })
}

/// For messages: 350, not 349.99999999999994.
fn in_degrees(angle_rad: f64) -> f64 {
    (angle_rad.to_degrees() * 1e9).round() / 1e9
}

/// `EXX_um` is `EXX` in `um`.
fn heading(name: &str) -> (&str, &str) {
    name.rsplit_once('_').unwrap_or((name, ""))
}

/// `EXX_up` is the rising side of `EXX`, `u_EXX` its uncertainty.
fn error_and_role(name: &str) -> (&str, Role) {
    if let Some(name) = name.strip_prefix("u_") {
        (name, Role::Uncertainty)
    } else if let Some(name) = name.strip_suffix("_up") {
        (name, Role::Up)
    } else if let Some(name) = name.strip_suffix("_down") {
        (name, Role::Down)
    } else {
        (name, Role::Mean)
    }
}

fn in_inner_unit(
    table: &CsvTable,
    column: &CsvColumn,
    dimension: Dimension,
    problems: &mut Diagnostics,
) -> Option<Vec<f64>> {
    match Unit::find(heading(&column.name).1, dimension) {
        Ok(unit) => table.in_unit(column, unit, problems),
        Err(e) => {
            let message = format!("column `{}`: {e}", column.name);
            problems.error(e.code(), column.place.clone(), message, &e.hint());
            None
        }
    }
}
