//! The causes of a circle as errors of the machine file: docs/model.md eq. 256 to 258.
//!
//! ```text
//!     causes(readings) − causes(virtual ball-bar of the machine file)  ──solve──>  changes of its errors
//!     machine file with these changes  ──read back──>  virtual ball-bar: causes(readings)
//! ```
//!
//! The virtual ball-bar goes through the whole chain of the machine: sides, senses and errors that the file states already
//! count in it.

mod changes;
mod file;
mod location;

pub use changes::Change;
pub use location::location_error;

use crate::virtual_circle::VirtualCircle;
use changes::{apply, changes_of};
use file::edit;
use nalgebra::{DMatrix, DVector};
use trueaxis_input::{Diagnostics, Place};
use trueaxis_machine::Machine;
use trueaxis_machine::axis::Command;
use trueaxis_machine::errors::ErrorName;
use trueaxis_machine::file::Tables;
use trueaxis_standards::conditions::Conditions;
use trueaxis_standards::iso230_4::{Cause, Circular, Diagnosis, Sense, diagnose};

/// What a step of an error changes is taken from such a step: mm over the radius, or rad.
const STEP: f64 = 1e-3;
/// What rounding of the written numbers may change of a cause, in mm over the radius.
const ROUNDING_MM: f64 = 2e-6;

/// A circle, its causes, and where on the machine it was.
#[derive(Debug, Clone)]
pub struct BallBar<'a> {
    /// The readings.
    pub circle: &'a Circular,
    /// Their causes.
    pub diagnosis: &'a Diagnosis,
    /// Their conditions.
    pub conditions: &'a Conditions,
    /// Where it was.
    pub place: VirtualCircle,
}

/// An error of the machine file that changes.
#[derive(Debug, Clone, PartialEq)]
pub struct Written {
    /// Its name.
    pub name: ErrorName,
    /// Its value as it stands in the file now.
    pub text: String,
    /// The causes that it states.
    pub causes: Vec<Cause>,
}

/// A cause that changes nothing in the file, and why.
#[derive(Debug, Clone, PartialEq)]
pub struct Left {
    /// Which.
    pub cause: Cause,
    /// Why, in words.
    pub why: String,
}

/// One cause: what was read, what the machine file showed before, and what it shows now. Unit: mm or rad.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Compared {
    /// Which.
    pub cause: Cause,
    /// From the readings. Unit: mm or rad.
    pub read: f64,
    /// From the virtual ball-bar of the machine file as it was. Unit: mm or rad.
    pub before: f64,
    /// From that of the new machine file. Unit: mm or rad.
    pub after: f64,
}

/// A machine file with the errors of a circle.
#[derive(Debug, Clone)]
pub struct MachineErrors {
    /// Its text.
    pub text: String,
    /// Tables that it names and that were made for it, by name and text.
    pub tables: Vec<(String, String)>,
    /// What changes.
    pub written: Vec<Written>,
    /// What does not.
    pub left: Vec<Left>,
    /// Every cause, before and after.
    pub compared: Vec<Compared>,
    /// Standard deviation of reading − virtual ball-bar, centre and radii fitted, before and after, mm.
    pub residual_mm: [f64; 2],
}

impl<'a> BallBar<'a> {
    /// The circle on a machine: its axes by their names, the centre and the other axes as the conditions state them.
    pub fn on(
        machine: &Machine,
        circle: &'a Circular,
        conditions: &'a Conditions,
        place: &Place,
        problems: &mut Diagnostics,
    ) -> Option<Self> {
        let mut refuse = |code, message: String, hint: &str| {
            problems.error(code, place.clone(), message, hint);
            None::<()>
        };
        let Some(diagnosis) = &circle.diagnosis else {
            let hint =
                "a whole circle in both directions, with its nominal radius ([circle] radius)";
            refuse("no-diagnosis", "the causes cannot be separated".to_owned(), hint)?;
            return None;
        };
        let find =
            |name: &String| trueaxis_machine::describe::axis_index(machine, &name.to_uppercase());
        let [first, second] = &circle.axes;
        let Some((a, b)) = find(first).zip(find(second)) else {
            let message = format!("the machine has no axes {first} and {second}");
            let hint = "[circle] plane = \"XY\", \"YZ\" or \"ZX\", or columns headed by the axes";
            refuse("unknown-axis", message, hint)?;
            return None;
        };
        let mut centre = match &conditions.circle_at {
            Some(text) => stand(machine, text, place, problems)?,
            None => Command::default(),
        };
        if conditions.circle.centre_mm.is_none() {
            let message = format!("the centre of the circle is taken to be {first}0 {second}0");
            let hint = "[circle] centre = \"100 50 mm\", at = \"Z=-200\", as commanded";
            problems.note("missing-centre", place.clone(), message, hint);
        }
        let [x, y] = conditions.circle.centre_mm.unwrap_or_default();
        (centre[a], centre[b]) = (centre[a] + x, centre[b] + y);
        let (radius_mm, ball_mm) = (diagnosis.radius_mm, machine.tip_mm());
        let stands = VirtualCircle { axes: [a, b], centre, radius_mm, ball_mm };
        if let Err(message) = stands.directions(machine) {
            let hint = "two linear axes along X, Y, Z of the machine";
            problems.error("slanted-axis", place.clone(), message, hint);
            return None;
        }
        Some(Self { circle, diagnosis, conditions, place: stands })
    }

    /// Angles and senses of the readings.
    fn points(&self) -> Vec<(f64, Sense)> {
        let [x, y] = self.circle.points_centre_mm();
        let paths = self.circle.paths.iter();
        paths
            .flat_map(|r| r.path.points_mm.iter().map(move |p| (r.path.sense, p)))
            .map(|(sense, p)| ((p[1] - y).atan2(p[0] - x), sense))
            .collect()
    }

    /// The circle as the virtual ball-bar of a machine reads it.
    fn seen_on(&self, machine: &Machine) -> Result<Circular, String> {
        let points = self.points();
        let mut radial = self.place.read(machine, &points)?.into_iter().zip(points);
        let mut circle = self.circle.clone();
        let [x, y] = self.circle.points_centre_mm();
        for result in &mut circle.paths {
            for p in &mut result.path.points_mm {
                let Some((more, (angle, _))) = radial.next() else { break };
                let r = self.place.radius_mm + more;
                *p = [x + r * angle.cos(), y + r * angle.sin()];
            }
        }
        Ok(circle)
    }

    /// Its causes.
    fn causes_on(&self, machine: &Machine) -> Result<Diagnosis, String> {
        let circle = self.seen_on(machine)?;
        let (place, mut problems) = (Place::default(), Diagnostics::new());
        diagnose(&circle, self.conditions, &place, &mut problems)
            .ok_or_else(|| "the virtual circle of this machine cannot be evaluated".to_owned())
    }

    /// Standard deviation of what a machine does not explain of the readings, mm.
    fn residual_mm(&self, machine: &Machine) -> Result<f64, String> {
        let points = self.points();
        let seen = self.place.read(machine, &points)?;
        let [x, y] = self.circle.points_centre_mm();
        let all = self.circle.paths.iter().flat_map(|r| &r.path.points_mm);
        let read = all.map(|p| (p[0] - x).hypot(p[1] - y) - self.place.radius_mm);
        let rest: Vec<f64> = read.zip(seen).map(|(a, b)| a - b).collect();
        let row = |(angle, sense): &(f64, Sense)| {
            let ccw = f64::from(*sense == Sense::CounterClockwise);
            [ccw, 1.0 - ccw, angle.cos(), angle.sin()]
        };
        let rows: Vec<[f64; 4]> = points.iter().map(row).collect();
        let a = DMatrix::from_fn(rows.len(), 4, |i, k| rows[i][k]);
        let b = DVector::from_column_slice(&rest);
        let x = a.clone().svd(true, true).solve(&b, 1e-12).map_err(str::to_owned)?;
        let left = b - a * x;
        Ok((left.norm_squared() / (rest.len().saturating_sub(4)).max(1) as f64).sqrt())
    }

    /// The machine file with what the circle shows.
    ///
    /// # Errors
    /// In words, why it cannot be.
    pub fn machine_errors(
        &self,
        machine: &Machine,
        (old, beside): (&str, &dyn Tables),
        origin: &str,
    ) -> Result<MachineErrors, String> {
        let (changes, mut left) = changes_of(machine, self);
        let before = self.causes_on(machine)?;
        let (wanted, within): (Vec<Change>, Vec<Change>) =
            changes.into_iter().partition(|c| self.is_significant(c.cause, &before));
        left.extend(
            within.iter().map(|c| Left { cause: c.cause, why: self.within(c.cause, &before) }),
        );
        let values = self.solve(machine, &wanted)?;
        // Without a calibrated length the mean of the two scales is known no better than the size of the circle suggests.
        let size = Self::value(self.diagnosis, Cause::Size) - Self::value(&before, Cause::Size);
        let unknown_mm = if self.diagnosis.is_calibrated { 0.0 } else { size.abs() };
        let made = edit(machine, (&wanted, &values), unknown_mm, self, (old, beside), origin)?;
        let after = self.causes_on(&made.machine)?;
        let compared = self.compared(&before, &after);
        for change in &wanted {
            let [read, now] = [self.diagnosis, &after].map(|d| Self::value(d, change.cause));
            let allowed = ROUNDING_MM * change.per_mm(self.place.radius_mm) + 1e-3 * read.abs();
            if (read - now).abs() > allowed {
                return Err(format!(
                    "the virtual ball-bar of the new file would not show the {} of the readings: are errors of its \
                     axes in tables that end within the circle?",
                    change.cause.key()
                ));
            }
        }
        let residual_mm = [self.residual_mm(machine)?, self.residual_mm(&made.machine)?];
        let (text, tables, written) = (made.text, made.tables, made.written);
        Ok(MachineErrors { text, tables, written, left, compared, residual_mm })
    }

    /// The value of a cause. Unit: mm or rad.
    fn value(diagnosis: &Diagnosis, cause: Cause) -> f64 {
        diagnosis.of(cause).map_or(0.0, |f| f.value)
    }

    fn expanded(&self, cause: Cause) -> f64 {
        self.diagnosis.of(cause).map_or(0.0, |f| f.uncertainty.expanded())
    }

    /// Its standard uncertainty. Unit: mm or rad.
    fn u(&self, cause: Cause) -> f64 {
        self.diagnosis.of(cause).map_or(0.0, |f| f.uncertainty.u)
    }

    fn is_significant(&self, cause: Cause, before: &Diagnosis) -> bool {
        let change = Self::value(self.diagnosis, cause) - Self::value(before, cause);
        let rounding = if cause == Cause::Squareness {
            ROUNDING_MM / self.place.radius_mm
        } else {
            ROUNDING_MM
        };
        change.abs() > self.expanded(cause).max(rounding)
    }

    fn within(&self, cause: Cause, before: &Diagnosis) -> String {
        let change = Self::value(self.diagnosis, cause) - Self::value(before, cause);
        let (scale, unit) = if cause == Cause::Squareness { (1e6, "µrad") } else { (1e3, "µm") };
        format!(
            "read {:+.2} {unit} more than the machine file shows, U = {:.2} {unit}",
            change * scale,
            self.expanded(cause) * scale
        )
    }

    /// The changes with which the virtual ball-bar shows the causes of the readings.
    ///
    /// ```text
    ///     J Δ = c(readings) − c(machine), twice, J by differences                    docs/model.md eq. 256
    /// ```
    fn solve(&self, machine: &Machine, wanted: &[Change]) -> Result<Vec<f64>, String> {
        let count = wanted.len();
        if count == 0 {
            return Ok(Vec::new());
        }
        let mut values = DVector::zeros(count);
        let causes = |values: &DVector<f64>| {
            let seen = self.causes_on(&apply(machine, wanted, values.as_slice(), self))?;
            Ok::<_, String>(DVector::from_iterator(
                count,
                wanted.iter().map(|c| Self::value(&seen, c.cause) / c.per_mm(self.place.radius_mm)),
            ))
        };
        let read = DVector::from_iterator(
            count,
            wanted
                .iter()
                .map(|c| Self::value(self.diagnosis, c.cause) / c.per_mm(self.place.radius_mm)),
        );
        for _ in 0..2 {
            let now = causes(&values)?;
            let mut slopes = DMatrix::zeros(count, count);
            for k in 0..count {
                let mut moved = values.clone();
                moved[k] += STEP;
                slopes.set_column(k, &((causes(&moved)? - &now) / STEP));
            }
            let step = slopes.lu().solve(&(&read - now));
            let step = step.ok_or("the errors of the machine file do not change this circle")?;
            values += step;
        }
        match values.iter().all(|v| v.is_finite()) {
            true => Ok(values.as_slice().to_vec()),
            false => Err("the errors of the machine file do not change this circle".to_owned()),
        }
    }

    fn compared(&self, before: &Diagnosis, after: &Diagnosis) -> Vec<Compared> {
        let causes = self.diagnosis.found.iter().map(|f| f.cause);
        let is_geometric = |c: &Cause| !matches!(c, Cause::Unexplained | Cause::Spike(_));
        causes
            .filter(is_geometric)
            .map(|cause| Compared {
                cause,
                read: Self::value(self.diagnosis, cause),
                before: Self::value(before, cause),
                after: Self::value(after, cause),
            })
            .collect()
    }
}

/// Where the other axes stood: `Z=-200 C=90`, mm and degrees.
fn stand(
    machine: &Machine,
    text: &str,
    place: &Place,
    problems: &mut Diagnostics,
) -> Option<Command> {
    let mut positions = Vec::new();
    for word in text.split_whitespace() {
        let pair = word.split_once('=');
        let Some(pair) = pair.and_then(|(axis, q)| Some((axis, q.parse::<f64>().ok()?))) else {
            let message = format!("[circle] at: `{word}` is not an axis, =, and a number");
            problems.error(
                "bad-position",
                place.clone(),
                message,
                "at = \"Z=-200 C=90\", mm and degrees",
            );
            return None;
        };
        positions.push(pair);
    }
    trueaxis_machine::describe::command(machine, positions, place, problems)
}
