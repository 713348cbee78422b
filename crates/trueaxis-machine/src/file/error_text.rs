//! The errors of a machine file: location errors, and error motions as constants, polynomials,
//! Fourier series or tables.

use super::Tables;
use crate::axis::{Axis, AxisKind, Travel};
use crate::chain::ChainBody;
use crate::errors::{
    Component, Curve, ErrorKind, ErrorName, Harmonic, Interpolation, Measurement, Outside, Spline,
    SplineError, StatedError, Uncertainty,
};
use trueaxis_geometry::input::{CsvColumn, CsvTable, Diagnostics, Dimension, Item, Section, Unit};

fn dimension_of(component: Component) -> Dimension {
    if component.is_rotation() { Dimension::Angle } else { Dimension::Length }
}

fn position_dimension(kind: AxisKind) -> Dimension {
    match kind {
        AxisKind::Linear => Dimension::Length,
        AxisKind::Rotary => Dimension::Angle,
    }
}

/// `[location]`: `EC0Y = "12 ± 1 urad"`.
pub fn read_location(section: &Section<'_>, bodies: &mut [ChainBody]) {
    let measured = read_measurement(section);
    for (key, place, item) in section.entries() {
        if key == "measured" {
            continue;
        }
        let Some(name) = ErrorName::parse(key).filter(|n| n.kind == ErrorKind::Location) else {
            let hint = "location errors are E, direction X Y Z A B C, 0, body: EX0C, EC0Y, EA0t";
            let message = format!("`{key}` is no location error of ISO 230-1");
            section.error_at(place, "unknown-error-name", message, hint);
            continue;
        };
        let Some(body) = bodies.iter_mut().find(|b| b.name == name.body) else {
            let message = format!("{name}: the chain has no body {}", name.body);
            section.error_at(place, "unknown-body", message, "name a body of the chain, w or t");
            continue;
        };
        let slot = &mut body.location[name.component as usize];
        if slot.is_some() {
            let message = format!("{name} is stated twice");
            section.error_at(place, "duplicate-error", message, "keep one of the two spellings");
        }
        if let Some(value) = item.measured(dimension_of(name.component)) {
            let mut stated = StatedError::constant(value.value, value.u);
            stated.measured = measured.clone();
            *slot = Some(stated);
        }
    }
}

/// What holds for all error motions of one axis unless a curve says otherwise.
struct MotionReader<'a> {
    axis: &'a Axis,
    tables: &'a dyn Tables,
    interpolation: Interpolation,
    outside: Outside,
    u: [Option<f64>; 2],
    measured: Measurement,
}

/// `[motion.X]`: a table of several columns, single curves, or both.
pub fn read_motion(section: &Section<'_>, axis: &Axis, body: &mut ChainBody, tables: &dyn Tables) {
    let reader = MotionReader {
        axis,
        tables,
        interpolation: read_interpolation(section).unwrap_or(Interpolation::NotAKnot),
        outside: read_outside(section).unwrap_or(Outside::Error),
        u: read_uncertainties(section),
        measured: read_measurement(section),
    };
    if let Some(item) = section.get("table") {
        if let Some(table) = reader.load(section, &item) {
            reader.read_columns(section, &table, body);
        }
    }
    let general = ["table", "interpolation", "outside", "u", "measured"];
    for (key, place, item) in section.entries() {
        if general.contains(&key) {
            continue;
        }
        let name = ErrorName::parse(key).filter(|n| n.kind == ErrorKind::Motion);
        let Some(name) = name.filter(|n| n.body == axis.name) else {
            let message = format!("`{key}` is no error motion of {}", axis.name);
            let hint = format!(
                "its error motions are EX{0} EY{0} EZ{0} EA{0} EB{0} EC{0} (ISO 230-1)",
                axis.name
            );
            section.error_at(place, "unknown-error-name", message, &hint);
            continue;
        };
        if body.motion[name.component as usize].is_some() {
            let message = format!("{name} is stated twice");
            section.error_at(
                place,
                "duplicate-error",
                message,
                "table column or own entry, not both",
            );
        }
        body.motion[name.component as usize] = reader.read_curve(name, &item);
    }
}

impl MotionReader<'_> {
    fn general_u(&self, component: Component) -> Option<Uncertainty> {
        self.u[usize::from(component.is_rotation())].map(Uncertainty::Constant)
    }

    /// `EXX = "3 um"` or `EXX = { polynomial | fourier | table …, u, reversal }`.
    fn read_curve(&self, name: ErrorName, item: &Item<'_>) -> Option<StatedError> {
        let dimension = dimension_of(name.component);
        if !item.is_table() {
            let value = item.measured(dimension)?;
            let mut stated = StatedError::constant(value.value, value.u);
            stated.u = stated.u.or_else(|| self.general_u(name.component));
            stated.measured = self.measured.clone();
            return Some(stated);
        }
        item.section(&name.to_string(), |section| {
            let u = section.quantity("u", dimension).and_then(|u| not_negative(section, u));
            let u = u.map(Uncertainty::Constant).or_else(|| self.general_u(name.component));
            let reversal = section.quantity("reversal", dimension).map(Curve::Constant);
            let has_measurement = section.get("measured").is_some();
            let own = read_measurement(section);
            let measured = if has_measurement { own } else { self.measured.clone() };
            let mean = self.read_shape(section, name.component)?;
            Some(StatedError { mean, reversal, u, measured })
        })?
    }

    fn read_shape(&self, section: &Section<'_>, component: Component) -> Option<Curve> {
        let dimension = dimension_of(component);
        let shapes = ["constant", "polynomial", "fourier", "table"];
        let given: Vec<_> = shapes.iter().filter(|s| section.get(s).is_some()).collect();
        if given.len() != 1 {
            let message = format!("an error motion has one shape, here are {}", given.len());
            section.error("bad-curve", message, "give one of constant, polynomial, fourier, table");
            return None;
        }
        match *given[0] {
            "constant" => section.quantity("constant", dimension).map(Curve::Constant),
            "polynomial" => self.read_polynomial(section, dimension),
            "fourier" => self.read_fourier(section, dimension),
            _ => self.read_own_table(section, component),
        }
    }

    fn read_polynomial(&self, section: &Section<'_>, dimension: Dimension) -> Option<Curve> {
        let position = position_dimension(self.axis.kind);
        let items = section.get("polynomial")?.list()?;
        let coefficients: Vec<_> = items.iter().map(|i| i.quantity(dimension)).collect();
        let coefficients: Vec<f64> = coefficients.into_iter().collect::<Option<_>>()?;
        let origin = section.get("origin").map_or(Some(0.0), |i| i.quantity(position))?;
        let hint = "the position above the origin where the argument is 1, such as \"100 mm\"";
        let item = section.require("scale", hint)?;
        let scale = item.quantity(position)?;
        if scale == 0.0 {
            item.error("bad-curve", "the scale of a polynomial is not zero".into(), hint);
            return None;
        }
        Some(Curve::Polynomial { coefficients, origin, scale })
    }

    fn read_fourier(&self, section: &Section<'_>, dimension: Dimension) -> Option<Curve> {
        if self.axis.kind == AxisKind::Linear {
            let hint = "use a polynomial or a table";
            let message = format!("{} does not turn: no Fourier series", self.axis.name);
            section.error("bad-curve", message, hint);
            return None;
        }
        section.section("fourier", |series| {
            let mean = series.get("mean").map_or(Some(0.0), |i| i.quantity(dimension));
            let hint = "[[order, \"cosine\", \"sine\"], …], such as [[1, \"2 um\", \"1 um\"]]";
            let terms = series.require("terms", hint)?.list()?;
            let terms: Vec<_> = terms.iter().map(|t| harmonic(t, dimension, hint)).collect();
            let terms = terms.into_iter().collect::<Option<_>>()?;
            Some(Curve::Fourier { mean: mean?, terms })
        })?
    }

    fn read_own_table(&self, section: &Section<'_>, component: Component) -> Option<Curve> {
        let item = section.get("table")?;
        let interpolation = read_interpolation(section).unwrap_or(self.interpolation);
        let outside = read_outside(section).unwrap_or(self.outside);
        let table = self.load(section, &item)?;
        let mut problems = Diagnostics::new();
        let wanted = format!("E{}{}", component.letter(), self.axis.name);
        let curve = (|| {
            let positions = self.positions(&table, &mut problems)?;
            let column = table.columns.iter().find(|c| heading(&c.name).0 == wanted);
            let Some(column) = column else {
                let place = trueaxis_geometry::input::Place::whole(&table.file);
                let message = format!("the table has no column {wanted}_…");
                problems.error("missing-column", place, message, "such as EXX_um or EAX_urad");
                return None;
            };
            let values = in_inner_unit(column, dimension_of(component), &mut problems)?;
            let spline =
                self.spline(&table, (&positions, &values), interpolation, &mut problems)?;
            self.check_cover(&table, &spline, outside, &mut problems);
            Some(Curve::Table { spline, outside })
        })();
        section.take_over(problems);
        curve
    }

    fn load(&self, section: &Section<'_>, item: &Item<'_>) -> Option<CsvTable> {
        let name = item.text()?;
        let text = match self.tables.text(name) {
            Ok(text) => text,
            Err(reason) => {
                let message = format!("the table `{name}` cannot be read: {reason}");
                item.error("missing-table", message, "paths are relative to the machine file");
                return None;
            }
        };
        let mut problems = Diagnostics::new();
        let table = CsvTable::parse(&self.tables.display(name), &text, &mut problems);
        let usable = !problems.has_errors();
        section.take_over(problems);
        usable.then_some(table)
    }

    fn positions(&self, table: &CsvTable, problems: &mut Diagnostics) -> Option<Vec<f64>> {
        let column = table.columns.iter().find(|c| heading(&c.name).0 == "position");
        let Some(column) = column else {
            let place = trueaxis_geometry::input::Place::whole(&table.file);
            let message = "the table has no column of positions".to_owned();
            problems.error("missing-column", place, message, "name it position_mm or position_deg");
            return None;
        };
        in_inner_unit(column, position_dimension(self.axis.kind), problems)
    }

    fn spline(
        &self,
        table: &CsvTable,
        (positions, values): (&[f64], &[f64]),
        interpolation: Interpolation,
        problems: &mut Diagnostics,
    ) -> Option<Spline> {
        Spline::new(positions, values, interpolation)
            .map_err(|error| {
                let place = match error {
                    SplineError::NotIncreasing(row) => table.row_place(row),
                    _ => trueaxis_geometry::input::Place::whole(&table.file),
                };
                let hint = "sort the rows by position, each position once";
                problems.error("bad-table", place, error.to_string(), hint);
            })
            .ok()
    }

    /// A table that ends before the travel does would refuse commands in the middle of a job.
    fn check_cover(
        &self,
        table: &CsvTable,
        spline: &Spline,
        outside: Outside,
        problems: &mut Diagnostics,
    ) {
        let (from, to) = spline.range();
        let (low, high) = match self.axis.travel {
            Travel::Between(low, high) => (low, high),
            _ => return,
        };
        let slack = 1e-9 * low.abs().max(high.abs()).max(1.0);
        if from <= low + slack && to >= high - slack {
            return;
        }
        let unit = |v: f64| match self.axis.kind {
            AxisKind::Linear => format!("{v} mm"),
            AxisKind::Rotary => format!("{} deg", v.to_degrees()),
        };
        let message = format!(
            "the table covers {} .. {} of the travel {} .. {} of {}",
            unit(from),
            unit(to),
            unit(low),
            unit(high),
            self.axis.name
        );
        let place = trueaxis_geometry::input::Place::whole(&table.file);
        let hint = "measure the rest, shorten the travel, or say outside = \"clamp\" or \"extend\"";
        if outside == Outside::Error {
            problems.error("table-too-short", place, message, hint);
        } else {
            problems.warn("table-too-short", place, message, "the ends are extrapolated there");
        }
    }

    fn read_columns(&self, section: &Section<'_>, table: &CsvTable, body: &mut ChainBody) {
        let mut problems = Diagnostics::new();
        if let Some(positions) = self.positions(table, &mut problems) {
            let mut found = Columns::default();
            for column in table.columns.iter().filter(|c| heading(&c.name).0 != "position") {
                self.sort_column(column, &mut found, &mut problems);
            }
            for component in Component::ALL {
                let columns = &found.0[component as usize];
                let stated = self.state(table, &positions, (component, columns), &mut problems);
                body.motion[component as usize] = stated;
            }
        }
        section.take_over(problems);
    }

    fn sort_column(&self, column: &CsvColumn, found: &mut Columns, problems: &mut Diagnostics) {
        let (mut name, _) = heading(&column.name);
        let is_u = name.starts_with("u_");
        name = name.strip_prefix("u_").unwrap_or(name);
        let (name, role) = match (name.strip_suffix("_up"), name.strip_suffix("_down")) {
            _ if is_u => (name, Role::Uncertainty),
            (Some(up), _) => (up, Role::Up),
            (_, Some(down)) => (down, Role::Down),
            _ => (name, Role::Mean),
        };
        let parsed = ErrorName::parse(name)
            .filter(|n| n.kind == ErrorKind::Motion && n.body == self.axis.name);
        let Some(parsed) = parsed else {
            let message = format!("`{}` is no error motion of {}", column.name, self.axis.name);
            let hint = format!(
                "columns are EX{0}_um … EC{0}_urad, EX{0}_up_um and EX{0}_down_um, u_EX{0}_um",
                self.axis.name
            );
            problems.error("unknown-error-name", column.place.clone(), message, &hint);
            return;
        };
        let values = in_inner_unit(column, dimension_of(parsed.component), problems);
        found.0[parsed.component as usize][role as usize] = values;
    }

    fn state(
        &self,
        table: &CsvTable,
        positions: &[f64],
        (component, columns): (Component, &[Option<Vec<f64>>; 4]),
        problems: &mut Diagnostics,
    ) -> Option<StatedError> {
        let [mean, up, down, u] = columns;
        let (mean, reversal) = match (mean, up, down) {
            (Some(mean), None, None) => (mean.clone(), None),
            (None, Some(up), Some(down)) => {
                let mean = up.iter().zip(down).map(|(u, d)| 0.5 * (u + d)).collect();
                let reversal: Vec<f64> = up.iter().zip(down).map(|(u, d)| u - d).collect();
                (mean, Some(reversal))
            }
            (None, None, None) => return None,
            _ => {
                let place = trueaxis_geometry::input::Place::whole(&table.file);
                let message = format!(
                    "E{}{}: one column, or _up and _down",
                    component.letter(),
                    self.axis.name
                );
                problems.error("bad-table", place, message, "give the mean or both directions");
                return None;
            }
        };
        let outside = self.outside;
        let spline = self.spline(table, (positions, &mean), self.interpolation, problems)?;
        self.check_cover(table, &spline, outside, problems);
        let reversal = match reversal {
            None => None,
            Some(values) => {
                let spline =
                    self.spline(table, (positions, &values), self.interpolation, problems)?;
                Some(Curve::Table { spline, outside })
            }
        };
        let u = match u {
            Some(u) if u.iter().any(|u| *u < 0.0) => {
                let place = trueaxis_geometry::input::Place::whole(&table.file);
                let message = "a standard uncertainty is negative".to_owned();
                problems.error("negative-uncertainty", place, message, "it is zero or positive");
                None
            }
            Some(u) => {
                let line = self.spline(table, (positions, u), Interpolation::Linear, problems)?;
                Some(Uncertainty::Table(line))
            }
            None => self.general_u(component),
        };
        let mean = Curve::Table { spline, outside };
        Some(StatedError { mean, reversal, u, measured: self.measured.clone() })
    }
}

/// Per component: mean, rising, falling, uncertainty.
#[derive(Default)]
struct Columns([[Option<Vec<f64>>; 4]; 6]);

#[derive(Clone, Copy)]
enum Role {
    Mean,
    Up,
    Down,
    Uncertainty,
}

/// `EXX_um` is `EXX` in `um`.
fn heading(name: &str) -> (&str, &str) {
    name.rsplit_once('_').unwrap_or((name, ""))
}

fn in_inner_unit(
    column: &CsvColumn,
    dimension: Dimension,
    problems: &mut Diagnostics,
) -> Option<Vec<f64>> {
    match Unit::find(heading(&column.name).1, dimension) {
        Ok(unit) => Some(column.values.iter().map(|&v| unit.to_inner(v)).collect()),
        Err(e) => {
            let message = format!("column `{}`: {e}", column.name);
            problems.error(e.code(), column.place.clone(), message, &e.hint());
            None
        }
    }
}

fn harmonic(item: &Item<'_>, dimension: Dimension, hint: &str) -> Option<Harmonic> {
    let parts = item.list()?;
    let [order, cosine, sine] = &parts[..] else {
        item.error("bad-curve", "a harmonic is order, cosine and sine".into(), hint);
        return None;
    };
    let (order, cosine, sine) =
        (order.number()?, cosine.quantity(dimension)?, sine.quantity(dimension)?);
    if order < 1.0 || order.fract() != 0.0 {
        item.error("bad-curve", "the order is a whole number from 1 on".into(), hint);
        return None;
    }
    Some(Harmonic { order, cosine, sine })
}

fn read_interpolation(section: &Section<'_>) -> Option<Interpolation> {
    let item = section.get("interpolation")?;
    match item.text()? {
        "not-a-knot" => Some(Interpolation::NotAKnot),
        "periodic" => Some(Interpolation::Periodic),
        "linear" => Some(Interpolation::Linear),
        other => {
            let message = format!("`{other}` is no interpolation");
            item.error("unknown-word", message, "not-a-knot, periodic or linear");
            None
        }
    }
}

fn read_outside(section: &Section<'_>) -> Option<Outside> {
    let item = section.get("outside")?;
    match item.text()? {
        "error" => Some(Outside::Error),
        "clamp" => Some(Outside::Clamp),
        "extend" => Some(Outside::Extend),
        other => {
            let message = format!("`{other}` says not what holds outside the table");
            item.error("unknown-word", message, "error, clamp or extend");
            None
        }
    }
}

/// `u = ["0.5 um", "1 urad"]`: of every shift and of every rotation.
fn read_uncertainties(section: &Section<'_>) -> [Option<f64>; 2] {
    let Some(item) = section.get("u") else { return [None; 2] };
    let Some(items) = item.list() else { return [None; 2] };
    let [shift, turn] = &items[..] else {
        item.error("bad-uncertainty", "two values are due here".into(), "[\"0.5 um\", \"1 urad\"]");
        return [None; 2];
    };
    let shift = shift.quantity(Dimension::Length).and_then(|u| not_negative(section, u));
    let turn = turn.quantity(Dimension::Angle).and_then(|u| not_negative(section, u));
    [shift, turn]
}

fn not_negative(section: &Section<'_>, u: f64) -> Option<f64> {
    if u < 0.0 {
        let hint = "a standard uncertainty is zero or positive";
        section.error("negative-uncertainty", "the uncertainty is negative".into(), hint);
        return None;
    }
    Some(u)
}

/// `measured = { instrument = "XL-80", date = 2021-03-28, temperature = "20 degC" }`.
fn read_measurement(section: &Section<'_>) -> Measurement {
    let read = section.section("measured", |m| Measurement {
        instrument: m.text("instrument").map(str::to_owned),
        date: m.get("date").and_then(|d| d.date_or_text()),
        temperature_celsius: m.quantity("temperature", Dimension::Temperature),
    });
    read.unwrap_or_default()
}
