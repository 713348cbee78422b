//! What a page shows of a machine.

use super::lines::{Lines, header};
use super::set_error::own_text;
use crate::Machine;
use crate::axis::{Axis, AxisKind, AxisSide, Travel};
use crate::chain::{ChainBody, Link};
use crate::errors::{
    Component, Curve, ErrorIndex, ErrorKind, ErrorName, Extrapolation, StatedError,
};
use std::f64::consts::TAU;

/// A machine as data: the geometry of its chain, every error that it has or could have, and the
/// sensors of its temperatures. Tools and models are those of the machine.
#[derive(Debug, Clone)]
pub struct Description<'m> {
    /// The machine.
    pub machine: &'m Machine,
    /// Its bodies from the workpiece over the bed to the tool.
    pub links: Vec<DescribedLink<'m>>,
    /// Six location errors of every body and six error motions of every axis, stated or not, in chain
    /// order.
    pub errors: Vec<DescribedError<'m>>,
    /// Its temperature sensors.
    pub sensors: Vec<DescribedSensor<'m>>,
}

/// A body of the chain.
#[derive(Debug, Clone)]
pub struct DescribedLink<'m> {
    /// The body.
    pub body: &'m ChainBody,
    /// Its axis; `None` for the workpiece and the tool.
    pub axis: Option<&'m Axis>,
    /// The side of the bed on which it is.
    pub carries: AxisSide,
    /// Its parent, towards the bed; `None`: the bed.
    pub parent: Option<usize>,
    /// Its place there with all axes at zero, without errors; the mounting is in it.
    pub parent_from_link: Link,
}

/// An error that a machine has, or could have.
#[derive(Debug, Clone)]
pub struct DescribedError<'m> {
    /// Its name.
    pub name: ErrorName,
    /// Its index among all errors.
    pub index: ErrorIndex,
    /// What the machine file states.
    pub stated: Option<&'m StatedError>,
    /// Its entry in the machine file as written, if it has one.
    pub text: Option<String>,
    /// The line of that entry, or of the entry of the table that contains it; from 1.
    pub line: Option<usize>,
    /// The table of its axis, if it contains the error.
    pub table: Option<String>,
    /// An error motion over the travel of its axis.
    pub curve: Option<SampledError>,
}

/// An error motion at at most [`MOST_SAMPLES`] positions.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SampledError {
    /// Positions. Unit: mm or rad.
    pub at: Vec<f64>,
    /// The mean of both directions there. Unit: mm or rad.
    pub values: Vec<f64>,
    /// E↑ − E↓ there, if it is known. Unit: mm or rad.
    pub reversal: Option<Vec<f64>>,
    /// Its standard uncertainty there, if it is known. Unit: mm or rad.
    pub u: Option<Vec<f64>>,
}

/// A temperature sensor.
#[derive(Debug, Clone, PartialEq)]
pub struct DescribedSensor<'m> {
    /// Its name.
    pub name: &'m str,
    /// What it tells of, in words: `scale of X`, `EZ0t`, `workpiece`.
    pub drives: Vec<String>,
}

/// A small plot needs no more points.
pub const MOST_SAMPLES: usize = 101;

/// Describes a machine; `file` is the text of its machine file, for the words and lines of its errors.
pub fn describe<'m>(machine: &'m Machine, file: Option<&str>) -> Description<'m> {
    let links = links(machine);
    let lines = file.map(Lines::of);
    let errors = all_errors(machine).map(|index| error(machine, index, lines.as_ref()));
    Description { machine, links, errors: errors.collect(), sensors: sensors(machine) }
}

fn links(machine: &Machine) -> Vec<DescribedLink<'_>> {
    let bed = machine.workpiece_side();
    let all = machine.bodies().iter().enumerate().map(|(i, body)| {
        let (carries, parent) = match i < bed {
            true => (AxisSide::Workpiece, (i + 1 < bed).then_some(i + 1)),
            false => (AxisSide::Tool, (i > bed).then(|| i - 1)),
        };
        let axis = body.axis.map(|a| &machine.axes()[a]);
        let parent_from_link = body.placement * body.mounting;
        DescribedLink { body, axis, carries, parent, parent_from_link }
    });
    all.collect()
}

fn all_errors(machine: &Machine) -> impl Iterator<Item = ErrorIndex> {
    let bodies = machine.bodies().iter().map(|b| b.axis.is_some()).collect::<Vec<_>>();
    ErrorIndex::all().filter(move |i| match (bodies.get(i.body), i.kind) {
        (None, _) => false,
        (Some(_), ErrorKind::Location) => true,
        (Some(is_axis), ErrorKind::Motion) => *is_axis,
    })
}

fn error<'m>(machine: &'m Machine, index: ErrorIndex, file: Option<&Lines>) -> DescribedError<'m> {
    let body = &machine.bodies()[index.body];
    let name = ErrorName { body: body.name, kind: index.kind, component: index.component };
    let stated = body.stated(index.kind, index.component);
    let own = file.and_then(|file| file.error(name).map(|at| (file, at)));
    let table = file.filter(|_| own.is_none() && stated.is_some());
    let table = table.and_then(|file| Some((file, file.table_of(&header(name))?)));
    let line = own.map(|(file, at)| file.number(at));
    let axis = body.axis.map(|i| &machine.axes()[i]);
    let is_motion = index.kind == ErrorKind::Motion;
    DescribedError {
        name,
        index,
        stated,
        text: file.and_then(|file| own_text(file, name)),
        line: line.or_else(|| table.as_ref().map(|(file, (at, _))| file.number(*at))),
        table: table.map(|(_, (_, table))| table),
        curve: stated.zip(axis).filter(|_| is_motion).map(|(stated, axis)| sampled(stated, axis)),
    }
}

/// Over the travel; where none is stated over the table, twice the scale of a polynomial, or a turn.
fn range(stated: &StatedError, axis: &Axis) -> (f64, f64) {
    let travel = match axis.travel {
        Travel::Between(from, to) => Some((from, to)),
        Travel::Unlimited | Travel::Unknown => None,
    };
    match &stated.mean {
        Curve::Table { spline, outside } if !spline.is_periodic() => {
            let (first, last) = spline.range();
            match travel {
                Some((from, to)) if *outside != Extrapolation::Error => (from, to),
                Some((from, to)) => (from.clamp(first, last), to.clamp(first, last)),
                None => (first, last),
            }
        }
        Curve::Polynomial { origin, scale, .. } if axis.kind == AxisKind::Linear => {
            travel.unwrap_or((origin - scale.abs(), origin + scale.abs()))
        }
        _ => travel.unwrap_or(match axis.kind {
            AxisKind::Linear => (0.0, 1e3),
            AxisKind::Rotary => (0.0, TAU),
        }),
    }
}

fn sampled(stated: &StatedError, axis: &Axis) -> SampledError {
    let (from, to) = range(stated, axis);
    let flat = matches!(
        (&stated.mean, &stated.reversal),
        (Curve::Constant(_), None | Some(Curve::Constant(_)))
    );
    let steps = if flat { 1 } else { MOST_SAMPLES - 1 };
    let mut sampled = SampledError {
        reversal: stated.reversal.as_ref().map(|_| Vec::new()),
        u: stated.u.as_ref().map(|_| Vec::new()),
        ..SampledError::default()
    };
    for i in 0..=steps {
        let share = i as f64 / steps as f64;
        let q = from * (1.0 - share) + to * share;
        let reversal = stated.reversal.as_ref().map(|r| r.at(q));
        // Outside a table that is not extended there is a gap.
        let (Ok(value), None | Some(Ok(_))) = (stated.mean.at(q), &reversal) else { continue };
        if !value.is_finite() {
            continue;
        }
        sampled.at.push(q);
        sampled.values.push(value);
        if let (Some(all), Some(Ok(reversal))) = (&mut sampled.reversal, reversal) {
            all.push(reversal);
        }
        if let Some(all) = &mut sampled.u {
            all.push(stated.u_at(q));
        }
    }
    sampled
}

fn sensors(machine: &Machine) -> Vec<DescribedSensor<'_>> {
    let heat = machine.heat();
    let drives = |sensor: &str| {
        let mut drives = Vec::new();
        for scale in &heat.scales {
            let heated = scale.heated.iter();
            let heated = heated.flat_map(|h| h.places.iter().map(|p| &p.near).chain([&h.far]));
            let mut feels = scale.sensors.iter().map(|s| &s.name).chain(heated);
            if feels.any(|name| name == sensor) {
                drives.push(format!("scale of {}", machine.axes()[scale.axis].name));
            }
        }
        let of_sensor = heat.structure.iter();
        let of_sensor = of_sensor.filter(|s| s.coefficients.iter().any(|(name, _)| name == sensor));
        drives.extend(of_sensor.map(|s| s.name.clone()));
        if heat.workpiece.iter().flat_map(|w| &w.sensors).any(|s| s.name == sensor) {
            drives.push("workpiece".to_owned());
        }
        drives
    };
    let names = heat.sensors().into_iter();
    names.map(|name| DescribedSensor { name, drives: drives(name) }).collect()
}

impl DescribedError<'_> {
    /// The shape of its curve in one word.
    pub fn shape(&self) -> Option<&'static str> {
        Some(match &self.stated?.mean {
            Curve::Constant(_) => "constant",
            Curve::Polynomial { .. } => "polynomial",
            Curve::Fourier { .. } => "fourier",
            Curve::Table { .. } => "table",
        })
    }

    /// The value if it is the same everywhere, mm or rad.
    pub fn constant(&self) -> Option<f64> {
        match self.stated?.mean {
            Curve::Constant(value) => Some(value),
            _ => None,
        }
    }

    /// The standard uncertainty, mm or rad; the greatest of a curve.
    pub fn u(&self) -> Option<f64> {
        self.stated?.u.as_ref()?;
        match &self.curve {
            Some(curve) => curve.u.iter().flatten().copied().reduce(f64::max),
            None => Some(self.stated?.u_at(0.0)),
        }
    }

    /// The unit in which it is shown: µm or µrad, and its size in mm or rad.
    pub fn unit(&self) -> (&'static str, f64) {
        unit_of(self.index.component)
    }
}

fn unit_of(component: Component) -> (&'static str, f64) {
    if component.is_rotation() { ("urad", 1e-6) } else { ("um", 1e-3) }
}
