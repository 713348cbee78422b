//! What the residual follows: places of the linear axes (volumetric) or a rotary axis (head, table).
//!
//! A smooth field of the machine frame in X, Y, Z, and error motions of each rotary axis in harmonics,
//! are fitted to residuals and judged on places that were held out. docs/model.md eq. 130

use super::selection::Sums;
use nalgebra::{DMatrix, DVector};
use trueaxis_machine::axis::AxisKind;
use trueaxis_machine::errors::{Component, ErrorIndex, ErrorKind, ErrorValues};
use trueaxis_machine::twist::Reference;
use trueaxis_measure::measure::Readings;
use trueaxis_measure::unknowns::design::Design;

/// More rows than this say nothing more.
const MOST_ROWS: usize = 20_000;
/// Against fields that the poses do not separate.
const RIDGE: f64 = 1e-6;

/// How much of the residual a field explains.
#[derive(Debug, Clone, PartialEq)]
pub struct Field {
    /// `None`: places in X, Y, Z; else the number of a rotary axis.
    pub axis: Option<usize>,
    /// The share of the squares that it explains on places that were held out. Unit: 1.
    pub share: f64,
}

/// The fields that were tried; `residuals` in mm or rad.
pub fn leftover_fields(
    design: &Design,
    readings: &Readings,
    residuals: &[[f64; 3]],
    part: &[usize],
) -> Vec<Field> {
    let axes = design.machine.axes();
    let parts = part.iter().max().map_or(0, |p| p + 1);
    let step = readings.len().div_ceil(MOST_ROWS).max(1);
    let rotary = axes.iter().enumerate().filter(|(_, a)| a.kind == AxisKind::Rotary);
    let tried = std::iter::once(None).chain(rotary.map(|(i, _)| Some(i)));
    let moves = |axis: usize| {
        let first = readings.commands.first().map_or(0.0, |c| c[axis]);
        readings.commands.iter().any(|c| (c[axis] - first).abs() > 1e-3)
    };
    tried
        .filter(|axis| axis.is_none_or(moves))
        .map(|axis| {
            let mut sums: Vec<Sums> = Vec::new();
            for i in (0..readings.len()).step_by(step) {
                let rows = rows(design, readings, i, axis);
                if sums.is_empty() {
                    sums = vec![Sums::zero(rows[0].len()); parts];
                }
                let instrument = &design.instruments[readings.instruments[i] as usize];
                for c in 0..instrument.sight.channels() {
                    sums[part[i]].add_row(&rows[c], residuals[i][c] / instrument.noise[c]);
                }
            }
            Field { axis, share: share(&sums) }
        })
        .collect()
}

/// 1, and monomials of the linear axes up to the second degree and cubes, or harmonics.
fn functions(design: &Design, readings: &Readings, i: usize, axis: Option<usize>) -> Vec<f64> {
    let command = &readings.commands[i];
    let mut values = vec![1.0];
    match axis {
        Some(axis) => {
            for order in [1.0, 2.0, 3.0] {
                let (sine, cosine) = (order * command[axis]).sin_cos();
                values.extend([cosine, sine]);
            }
        }
        None => {
            let axes = design.machine.axes().iter().zip(command);
            let linear = axes.filter(|(a, _)| a.kind == AxisKind::Linear);
            let places: Vec<f64> = linear.map(|(_, q)| q / 500.0).collect();
            for (k, a) in places.iter().enumerate() {
                values.extend([*a, a * a * a]);
                values.extend(places[k..].iter().map(|b| a * b));
            }
        }
    }
    values
}

/// How each channel follows every direction: those of the machine frame for a field of places, the
/// six error motions for a rotary axis.
fn along(design: &Design, readings: &Readings, i: usize, axis: Option<usize>) -> [Vec<f64>; 3] {
    let instrument = &design.instruments[readings.instruments[i] as usize];
    let none = ErrorValues::default();
    let (machine, command) = (&design.machine, &readings.commands[i]);
    let view = instrument.view(machine, command, &none, readings.directions[i]);
    let wrenches = instrument.wrenches(&view);
    let body = machine.bodies().iter().position(|b| axis.is_some() && b.axis == axis);
    if let Some(body) = body {
        let frames = machine.error_frames(command, instrument.reference);
        let twists = Component::ALL.map(|component| {
            let index = ErrorIndex { body, kind: ErrorKind::Motion, component };
            // 100 mm away a turn and a shift weigh alike.
            (frames.twist(index), if component.is_rotation() { 0.01 } else { 1.0 })
        });
        return wrenches.map(|w| twists.iter().map(|(twist, by)| w.on(twist) * by).collect());
    }
    let bed_from_reference = match instrument.reference {
        Reference::Bed => trueaxis_geometry::Mat3::identity(),
        Reference::Workpiece => {
            machine.tool_on_bed(command, &none).linear() * view.nominal.linear().transpose()
        }
    };
    wrenches.map(|w| {
        let seen = if instrument.sight.is_angle() { w.moment } else { w.force };
        (bed_from_reference * seen).iter().copied().collect()
    })
}

/// A row of each channel: every direction times every function.
fn rows(design: &Design, readings: &Readings, i: usize, axis: Option<usize>) -> [DVector<f64>; 3] {
    let functions = functions(design, readings, i, axis);
    along(design, readings, i, axis).map(|along| {
        let products = functions.iter().flat_map(|f| along.iter().map(move |a| a * f));
        DVector::from_vec(products.collect())
    })
}

fn share(parts: &[Sums]) -> f64 {
    let Some(first) = parts.first() else { return 0.0 };
    let n = first.gradient.len();
    let mut all = Sums::zero(n);
    parts.iter().for_each(|part| all.add(part, 1.0));
    if all.square <= 0.0 {
        return 0.0;
    }
    let mut error = 0.0;
    for part in parts {
        let mut others = all.clone();
        others.add(part, -1.0);
        let ridge = RIDGE * others.normal.diagonal().max().max(1e-12);
        let regular = &others.normal + DMatrix::identity(n, n) * ridge;
        let values = match regular.cholesky() {
            Some(cholesky) => cholesky.solve(&others.gradient),
            None => DVector::zeros(n),
        };
        error += part.error(&values);
    }
    1.0 - error / all.square
}
