//! The errors of a machine file: location errors, and error motions as constants, polynomials,
//! Fourier series or tables.

use super::Tables;
use super::table_text::{
    ErrorTable, TableCurves, TableHabits, error_of, headings_place, position_dimension,
};
use crate::axis::{Axis, AxisKind, Travel};
use crate::chain::ChainBody;
use crate::errors::{
    Component, Curve, ErrorKind, ErrorName, Extrapolation, Harmonic, Interpolation, Measurement,
    StatedError, Uncertainty,
};
use std::cell::{Cell, RefCell};
use trueaxis_input::plausible::{Limits, Quantity};
use trueaxis_input::{CsvTable, Date, Diagnostics, Dimension, Item, Place, Section};

/// Highest accepted order of a Fourier series; harmonics of higher order are noise.
const HIGHEST_ORDER: f64 = 1e4;
/// No error polynomial reaches this within the travel, mm or rad.
const HIGHEST_ERROR: f64 = 1e12;

/// What an error is measured in.
pub fn dimension_of(component: Component) -> Dimension {
    if component.is_rotation() { Dimension::Angle } else { Dimension::Length }
}

/// `[location]`: `EC0Y = "12 ± 1 urad"`.
pub fn read_location(section: &Section<'_>, bodies: &mut [ChainBody]) {
    let measured = read_measurement(section);
    for (key, place, item) in section.entries() {
        if key == "measured" {
            continue;
        }
        let Some(name) = ErrorName::parse(key).filter(|n| n.kind == ErrorKind::Location) else {
            let hint = match ErrorName::parse(key) {
                Some(motion) => {
                    format!("this is an error motion: write it in [motion.{}]", motion.body)
                }
                None => {
                    "location errors are E, direction X Y Z A B C, 0, body, such as EX0C, EC0Y, \
                     EA0t"
                        .into()
                }
            };
            let message = format!("`{key}` is not a location error of ISO 230-1");
            section.error_at(place, "unknown-error-name", message, &hint);
            continue;
        };
        let Some(body) = bodies.iter_mut().find(|b| b.name == name.body) else {
            let message = format!("{name}: the chain has no body {}", name.body);
            section.error_at(place, "unknown-body", message, "write a body of the chain, w or t");
            continue;
        };
        let slot = &mut body.location[name.component as usize];
        if slot.is_some() {
            let message = format!("{name} is stated twice");
            section.error_at(place, "duplicate-error", message, "keep one of the two spellings");
        }
        let quantity = match name.component.is_rotation() {
            true => Quantity::LocationAngle,
            false => Quantity::LocationError,
        };
        if let Some(value) = item.measured_of(quantity) {
            let mut stated = StatedError::constant(value.value, value.u);
            stated.measured = measured.clone();
            *slot = Some(stated);
        }
    }
}

/// Settings for all error motions of one axis unless a curve states others.
struct MotionReader<'a> {
    axis: &'a Axis,
    tables: &'a dyn Tables,
    habits: TableHabits,
    u: [Option<f64>; 2],
    measured: Measurement,
    /// How many tables were read.
    tables_read: Cell<usize>,
    /// Columns of the axis in tables of single errors, about another of its errors.
    passed_over: RefCell<Vec<(Component, Place)>>,
}

/// `[motion.X]`: a table of several columns, single curves, or both.
pub fn read_motion(section: &Section<'_>, axis: &Axis, body: &mut ChainBody, tables: &dyn Tables) {
    let (interpolation, outside) = (read_interpolation(section), read_outside(section));
    let reader = MotionReader {
        axis,
        tables,
        habits: TableHabits {
            interpolation: interpolation.unwrap_or(Interpolation::NotAKnot),
            outside: outside.unwrap_or(Extrapolation::Error),
            limits: section.limits(),
        },
        u: read_uncertainties(section),
        measured: read_measurement(section),
        tables_read: Cell::new(0),
        passed_over: RefCell::new(Vec::new()),
    };
    if let Some(table) = section.get("table").and_then(|item| reader.load(section, &item)) {
        reader.read_columns(section, &table, body);
    }
    let general = ["table", "interpolation", "outside", "u", "measured"];
    for (key, place, item) in section.entries() {
        if general.contains(&key) {
            continue;
        }
        let name = ErrorName::parse(key).filter(|n| n.kind == ErrorKind::Motion);
        let Some(name) = name.filter(|n| n.body == axis.name) else {
            let message = format!("`{key}` is not an error motion of {}", axis.name);
            let hint =
                format!("write EX{0}, EY{0}, EZ{0}, EA{0}, EB{0} or EC{0} (ISO 230-1)", axis.name);
            section.error_at(place, "unknown-error-name", message, &hint);
            continue;
        };
        if body.motion[name.component as usize].is_some() {
            let message = format!("{name} is stated twice");
            section.error_at(
                place,
                "duplicate-error",
                message,
                "keep either the column of the table or the entry",
            );
        }
        let read = reader.read_curve(name, &item);
        if let Some(stated) = &read {
            section.take_over(reader.judge(name, stated, &item));
        }
        body.motion[name.component as usize] = read;
    }
    reader.warn_of_columns(section, body);
    let rules = [("interpolation", interpolation.is_some()), ("outside", outside.is_some())];
    for (key, _) in rules.into_iter().filter(|(_, stated)| *stated && reader.tables_read.get() == 0)
    {
        if let Some(item) = section.get(key) {
            let message = format!("`{key}` is a rule for tables, and there is none");
            item.warn("no-effect", message, "leave it out, or state the table");
        }
    }
}

impl MotionReader<'_> {
    /// Names columns of tables of one error that are about an error of the axis that nothing else states.
    fn warn_of_columns(&self, section: &Section<'_>, body: &ChainBody) {
        let mut problems = Diagnostics::new();
        let mut passed_over = self.passed_over.borrow_mut();
        passed_over.sort_by_key(|(component, _)| *component as usize);
        passed_over.dedup_by_key(|(component, _)| *component);
        for (component, place) in passed_over.drain(..) {
            if body.motion[component as usize].is_none() {
                let name = format!("E{}{}", component.letter(), self.axis.name);
                let message =
                    format!("the column of {name} is not used: the table is that of one error");
                let hint =
                    format!("`table = …` for all columns, or an entry {name} = {{ table = … }}");
                problems.warn("unused-column", place, message, &hint);
            }
        }
        section.take_over(problems);
    }

    fn general_u(&self, component: Component) -> Option<Uncertainty> {
        self.u[usize::from(component.is_rotation())].map(Uncertainty::Constant)
    }

    /// What is wrong with the size of an error motion over the travel of its axis; tables are judged by row.
    fn judge(&self, name: ErrorName, stated: &StatedError, item: &Item<'_>) -> Diagnostics {
        const STATIONS: u32 = 64;
        let mut problems = Diagnostics::new();
        if matches!(stated.mean, Curve::Table { .. }) {
            return problems;
        }
        let (low, high) = match self.axis.travel {
            Travel::Between(low, high) => (low, high),
            _ => (0.0, self.furthest_from(0.0)),
        };
        let at = |i: u32| low + (high - low) * f64::from(i) / f64::from(STATIONS);
        let values = (0..=STATIONS).filter_map(|i| stated.at(at(i), 1.0).ok());
        let largest = values.fold(0.0, |a: f64, b| if b.abs() > a.abs() { b } else { a });
        let name = name.to_string();
        let column = (name.as_str(), &[largest][..]);
        judge_error(&self.habits.limits, self.axis, column, |_| item.place(), &mut problems);
        problems
    }

    /// `EXX = "3 um"` or `EXX = { polynomial | fourier | table …, u, reversal }`.
    fn read_curve(&self, name: ErrorName, item: &Item<'_>) -> Option<StatedError> {
        let dimension = dimension_of(name.component);
        if !item.is_table() {
            let value = item.measured_unjudged(dimension)?;
            let mut stated = StatedError::constant(value.value, value.u);
            stated.u = stated.u.or_else(|| self.general_u(name.component));
            stated.measured = self.measured.clone();
            return Some(stated);
        }
        item.section(&name.to_string(), |section| {
            let u = section.get("u").and_then(|item| not_negative(&item, dimension));
            let mut u = u.map(Uncertainty::Constant);
            let mut reversal = section.quantity("reversal", dimension).map(Curve::Constant);
            let has_measurement = section.get("measured").is_some();
            let own = read_measurement(section);
            let measured = if has_measurement { own } else { self.measured.clone() };
            let shape = self.read_shape(section, name.component)?;
            for (what, twice) in [
                ("uncertainty", u.is_some() && shape.u.is_some()),
                ("reversal", reversal.is_some() && shape.reversal.is_some()),
            ] {
                if twice {
                    let message = format!("{name}: its {what} is stated twice");
                    section.error(
                        "duplicate-error",
                        message,
                        "keep either the columns of the table or this entry",
                    );
                }
            }
            u = u.or(shape.u).or_else(|| self.general_u(name.component));
            reversal = reversal.or(shape.reversal);
            Some(StatedError { mean: shape.mean, reversal, u, measured })
        })?
    }

    fn read_shape(&self, section: &Section<'_>, component: Component) -> Option<TableCurves> {
        let dimension = dimension_of(component);
        let shapes = ["constant", "polynomial", "fourier", "table"];
        let given: Vec<_> = shapes.iter().filter(|s| section.get(s).is_some()).collect();
        if given.len() != 1 {
            // Which of them belong here is not known: do not report them as unknown too.
            for key in ["scale", "origin", "interpolation", "outside"] {
                section.get(key);
            }
            let message = format!("an error motion needs exactly one shape, found {}", given.len());
            section.error(
                "bad-curve",
                message,
                "write one of constant, polynomial, fourier, table",
            );
            return None;
        }
        let mean = match *given[0] {
            "constant" => section.quantity("constant", dimension).map(Curve::Constant),
            "polynomial" => self.read_polynomial(section, dimension),
            "fourier" => self.read_fourier(section, dimension),
            _ => return self.read_own_table(section, component),
        };
        Some(TableCurves { mean: mean?, reversal: None, u: None })
    }

    /// The greatest distance of a position from the origin, mm or rad; 1 m or a turn if no travel
    /// is stated.
    fn furthest_from(&self, origin: f64) -> f64 {
        let (low, high) = match (self.axis.travel, self.axis.kind) {
            (Travel::Between(low, high), _) => (low, high),
            (_, AxisKind::Linear) => (-1e3, 1e3),
            (_, AxisKind::Rotary) => (-std::f64::consts::TAU, std::f64::consts::TAU),
        };
        (low - origin).abs().max((high - origin).abs())
    }

    fn read_polynomial(&self, section: &Section<'_>, dimension: Dimension) -> Option<Curve> {
        let position = position_dimension(self.axis.kind);
        let origin = section.get("origin").map_or(Some(0.0), |i| i.quantity(position));
        let hint =
            "write the distance from the origin at which the argument is 1, such as \"100 mm\"";
        let item = section.require("scale", hint);
        let items = section.get("polynomial")?.list()?;
        let coefficients: Vec<_> = items.iter().map(|i| i.quantity(dimension)).collect();
        let coefficients: Option<Vec<f64>> = coefficients.into_iter().collect();
        let (origin, item) = (origin?, item?);
        let scale = item.quantity(position)?;
        if scale == 0.0 {
            item.error("bad-curve", "the scale of a polynomial must not be zero".into(), hint);
            return None;
        }
        let coefficients = coefficients?;
        if coefficients.is_empty() {
            let hint = "write the coefficients in rising order: [\"0 um\", \"3 um\"] is 3 um \
                times the argument";
            section.error("bad-curve", "the polynomial has no coefficients".into(), hint);
            return None;
        }
        // Σ |cₖ| |x|ᵏ at the far end of the travel: no value in it is larger.
        let x = self.furthest_from(origin) / scale.abs();
        let highest = coefficients.iter().rev().fold(0.0, |sum, c| sum * x + c.abs());
        // Not a number, too, is refused: 0 · ∞ where the scale is next to nothing.
        if highest.is_nan() || highest > HIGHEST_ERROR {
            let message = format!("the polynomial reaches {highest:.0e} within the travel");
            section.error("too-large", message, "check its scale and its coefficients");
            return None;
        }
        Some(Curve::Polynomial { coefficients, origin, scale })
    }

    fn read_fourier(&self, section: &Section<'_>, dimension: Dimension) -> Option<Curve> {
        if self.axis.kind == AxisKind::Linear {
            let hint = "use a polynomial or a table";
            let message = format!(
                "{} is not a rotary axis: a Fourier series is not possible",
                self.axis.name
            );
            section.error("bad-curve", message, hint);
            return None;
        }
        section.section("fourier", |series| {
            let mean = series.get("mean").map_or(Some(0.0), |i| i.quantity(dimension));
            let hint =
                "write [[order, \"cosine\", \"sine\"], …], such as [[1, \"2 um\", \"1 um\"]]";
            let terms = series.require("terms", hint)?.list()?;
            let terms: Vec<_> = terms.iter().map(|t| harmonic(t, dimension, hint)).collect();
            let terms: Vec<Harmonic> = terms.into_iter().collect::<Option<_>>()?;
            let twice = |i: &usize| terms[..*i].iter().any(|t| t.order == terms[*i].order);
            if let Some(i) = (0..terms.len()).find(twice) {
                let message = format!("the order {} is stated twice", terms[i].order);
                series.error("bad-curve", message, "keep one of the two, or their sum");
                return None;
            }
            Some(Curve::Fourier { mean: mean?, terms })
        })?
    }

    fn read_own_table(&self, section: &Section<'_>, component: Component) -> Option<TableCurves> {
        let item = section.get("table")?;
        let habits = TableHabits {
            interpolation: read_interpolation(section).unwrap_or(self.habits.interpolation),
            outside: read_outside(section).unwrap_or(self.habits.outside),
            ..self.habits
        };
        let table = self.load(section, &item)?;
        let mut problems = Diagnostics::new();
        let read = ErrorTable::read(self.axis, &table, habits, Some(component), &mut problems);
        if read.as_ref().is_some_and(|r| r.lacks(component)) {
            let place = headings_place(&table);
            let message =
                format!("the table has no column E{}{}_…", component.letter(), self.axis.name);
            problems.error(
                "missing-column",
                place,
                message,
                "name it by error and unit, such as EXX_um or EAX_urad",
            );
        }
        let lacks = read.as_ref().is_none_or(|r| r.lacks(component));
        let others = table.columns.iter().filter_map(|c| Some((error_of(&c.name, self.axis)?, c)));
        let others = others.filter(|(other, _)| !lacks && *other != component);
        self.passed_over.borrow_mut().extend(others.map(|(other, c)| (other, c.place.clone())));
        let curves = read.and_then(|r| r.curves(component, &mut problems));
        section.take_over(problems);
        curves
    }

    fn read_columns(&self, section: &Section<'_>, table: &CsvTable, body: &mut ChainBody) {
        let mut problems = Diagnostics::new();
        let read = ErrorTable::read(self.axis, table, self.habits, None, &mut problems);
        for component in Component::ALL {
            let curves = read.as_ref().and_then(|r| r.curves(component, &mut problems));
            body.motion[component as usize] = curves.map(|c| StatedError {
                mean: c.mean,
                reversal: c.reversal,
                u: c.u.or_else(|| self.general_u(component)),
                measured: self.measured.clone(),
            });
        }
        section.take_over(problems);
    }

    fn load(&self, section: &Section<'_>, item: &Item<'_>) -> Option<CsvTable> {
        self.tables_read.set(self.tables_read.get() + 1);
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
}

/// Reports values of an error motion of that axis that are no errors of a machine; those in radians are rotations.
pub fn judge_error(
    limits: &Limits,
    axis: &Axis,
    (name, values): (&str, &[f64]),
    place: impl Fn(usize) -> Place,
    problems: &mut Diagnostics,
) -> bool {
    let error = name.trim_start_matches("u_").get(..3).and_then(ErrorName::parse);
    let travel_mm = match axis.travel {
        Travel::Between(low, high) if axis.kind == AxisKind::Linear => high - low,
        _ => 0.0,
    };
    match error.is_some_and(|e| e.component.is_rotation()) {
        true => limits.judge_column(Quantity::AngleError, (name, values), place, problems),
        false => limits.judge_error_column(travel_mm, (name, values), place, problems),
    }
}

fn harmonic(item: &Item<'_>, dimension: Dimension, hint: &str) -> Option<Harmonic> {
    let parts = item.list()?;
    let [order, cosine, sine] = &parts[..] else {
        item.error(
            "bad-curve",
            "a harmonic needs three values: order, cosine and sine".into(),
            hint,
        );
        return None;
    };
    let (order, cosine, sine) =
        (order.number()?, cosine.quantity(dimension)?, sine.quantity(dimension)?);
    if !(1.0..=HIGHEST_ORDER).contains(&order) || order.fract() != 0.0 {
        let message = format!("the order must be a whole number from 1 to {HIGHEST_ORDER}");
        item.error("bad-curve", message, hint);
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
            let message = format!("unknown interpolation `{other}`");
            item.error("unknown-word", message, "write not-a-knot, periodic or linear");
            None
        }
    }
}

fn read_outside(section: &Section<'_>) -> Option<Extrapolation> {
    let item = section.get("outside")?;
    match item.text()? {
        "error" => Some(Extrapolation::Error),
        "clamp" => Some(Extrapolation::Clamp),
        "extend" => Some(Extrapolation::Extend),
        other => {
            let message = format!("unknown rule `{other}` for positions outside the table");
            item.error("unknown-word", message, "write error, clamp or extend");
            None
        }
    }
}

/// `u = ["0.5 um", "1 urad"]`: of every shift and of every rotation.
fn read_uncertainties(section: &Section<'_>) -> [Option<f64>; 2] {
    let Some(item) = section.get("u") else { return [None; 2] };
    let Some(items) = item.list() else { return [None; 2] };
    let [shift, turn] = &items[..] else {
        item.error(
            "bad-uncertainty",
            "expected two values here".into(),
            "write u of displacements and of angles, such as [\"0.5 um\", \"1 urad\"]",
        );
        return [None; 2];
    };
    [not_negative(shift, Dimension::Length), not_negative(turn, Dimension::Angle)]
}

fn not_negative(item: &Item<'_>, dimension: Dimension) -> Option<f64> {
    let u = item.quantity(dimension)?;
    if u < 0.0 {
        let hint = "a standard uncertainty is zero or positive";
        item.error("negative-uncertainty", "the uncertainty is negative".into(), hint);
        return None;
    }
    Some(u)
}

fn read_date(item: &Item<'_>) -> Option<String> {
    let text = item.date_or_text()?;
    if Date::parse(&text).is_none() {
        let message = format!("`{text}` is not a date");
        item.error("bad-date", message, "write it as 2026-03-14");
        return None;
    }
    Some(text)
}

/// `measured = { instrument = "XL-80", date = 2021-03-28, temperature = "20 degC" }`.
fn read_measurement(section: &Section<'_>) -> Measurement {
    let read = section.section("measured", |m| Measurement {
        instrument: m.text("instrument").map(str::to_owned),
        date: m.get("date").and_then(|d| read_date(&d)),
        temperature_celsius: m.quantity_of("temperature", Quantity::Temperature),
    });
    read.unwrap_or_default()
}
