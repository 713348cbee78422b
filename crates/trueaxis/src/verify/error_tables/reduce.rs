//! From readings to the error of the body: averages, arms, zero.

use super::means::Means;
use super::{ErrorReadings, ReferenceLine, TableStudy};
use nalgebra::{DMatrix, DVector};
use std::f64::consts::PI;
use trueaxis_geometry::frame::rotation;
use trueaxis_geometry::{Mat3, Vec3};
use trueaxis_input::{Diagnostics, Place};
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{Axis, AxisKind};
use trueaxis_machine::chain::ErrorFrame;
use trueaxis_machine::errors::{Component, ErrorIndex, ErrorName, Interpolation, Spline};

/// What an angle does over an arm is not listed below this, mm.
const SHOWN_MM: f64 = 5e-6;
/// An arm shorter than this does not matter, mm.
const SHORT_ARM_MM: f64 = 1.0;

/// What the set-up of the instrument hides, and was subtracted.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Removed {
    /// The zero.
    Zero,
    /// A straight line.
    Line(ReferenceLine),
    /// The mean and the eccentricity of the artefact.
    Eccentricity,
    /// The mean.
    Mean,
}

/// The table of one error motion.
#[derive(Debug, Clone)]
pub struct ErrorTable {
    /// The error.
    pub name: ErrorName,
    /// Where it stands in the chain.
    pub index: ErrorIndex,
    /// Its axis.
    pub axis: usize,
    /// The positions, rising. Unit: mm or rad.
    pub positions: Vec<f64>,
    /// The error of the body, reached upwards. Unit: mm or rad.
    pub up: Vec<f64>,
    /// Reached downwards; equal to `up` where only one direction was read. Unit: mm or rad.
    pub down: Vec<f64>,
    /// Whether both directions were read.
    pub both: bool,
    /// Standard uncertainty. Unit: mm or rad.
    pub u: Vec<f64>,
    /// How many runs in each direction, at least.
    pub runs: usize,
    /// Standard deviation of a single reading; `None` where each was taken once. Unit: mm or rad.
    pub scatter: Option<f64>,
    /// What was subtracted.
    pub removed: Removed,
    /// What the angles of the axis did over the arm, at most, with the standard uncertainty of that: by error, mm.
    pub arms: Vec<(ErrorName, f64)>,
    /// The instrument, in words.
    pub instrument: Option<String>,
    /// When.
    pub date: Option<String>,
    /// The temperature of the scale, °C.
    pub celsius: Option<f64>,
}

impl ErrorTable {
    /// The mean of both directions. Unit: mm or rad.
    pub fn mean(&self) -> Vec<f64> {
        self.up.iter().zip(&self.down).map(|(a, b)| 0.5 * (a + b)).collect()
    }

    /// Largest − least of the mean. Unit: mm or rad.
    pub fn range(&self) -> f64 {
        let mean = self.mean();
        let ends = mean
            .iter()
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(*v), h.max(*v)));
        (ends.1 - ends.0).max(0.0)
    }
}

/// The tables of all readings; angles first, because the others need them.
pub fn error_tables(study: &TableStudy, problems: &mut Diagnostics) -> Vec<ErrorTable> {
    let mut tables: Vec<ErrorTable> = Vec::new();
    for is_angle in [true, false] {
        let angles = Angles { machine: &study.machine, tables: &tables };
        let readings = study.readings.iter().filter(|r| r.name.component.is_rotation() == is_angle);
        let mut new: Vec<ErrorTable> =
            readings.filter_map(|r| reduce(&study.machine, r, &angles, problems)).collect();
        centre(&study.machine, &mut new, problems);
        turn_with_axes(&study.machine, &mut new, problems);
        tables.append(&mut new);
    }
    tables.sort_by_key(|t| (t.axis, t.name.component as usize));
    tables
}

/// The directions in which an instrument reads the errors of an axis, as columns, in the frame of the reference: fixed
/// in space, also where the errors of a rotary axis are stated in directions that turn with it.
pub(super) fn directions(machine: &Machine, readings: &ErrorReadings, q: f64) -> Mat3 {
    let mut command = readings.at;
    command[readings.axis] = q;
    let frames = machine.error_frames(&command, readings.stands_on);
    let side = side(machine, readings.index);
    let column =
        |component| frames.twist(ErrorIndex { component, ..readings.index }).shift_mm * side;
    let stated = Mat3::from_columns(&[Component::X, Component::Y, Component::Z].map(column));
    stated * turn(machine, readings.index.body, q).transpose()
}

/// How far the directions of its errors have turned with an axis.
fn turn(machine: &Machine, body: usize, q: f64) -> Mat3 {
    let body = &machine.bodies()[body];
    match body.axis.map(|axis| &machine.axes()[axis]) {
        Some(axis) if turns(axis, body.error_frame) => rotation(axis.direction, axis.sense * q),
        _ => Mat3::identity(),
    }
}

fn turns(axis: &Axis, frame: ErrorFrame) -> bool {
    axis.kind == AxisKind::Rotary && frame == ErrorFrame::Moving
}

/// +1 for a body on the side of the tool, −1 on that of the workpiece.
pub(super) fn side(machine: &Machine, index: ErrorIndex) -> f64 {
    if index.body < machine.workpiece_side() { -1.0 } else { 1.0 }
}

/// Errors that are stated in directions that turn with their axis: from those fixed in space, docs/model.md eq. 183.
fn turn_with_axes(machine: &Machine, tables: &mut [ErrorTable], problems: &mut Diagnostics) {
    for (body, b) in machine.bodies().iter().enumerate() {
        let Some(i) = b.axis.filter(|i| turns(&machine.axes()[*i], b.error_frame)) else {
            continue;
        };
        let axis = &machine.axes()[i];
        let of_axis: Vec<usize> = (0..tables.len()).filter(|t| tables[*t].axis == i).collect();
        let at = |c: usize| {
            of_axis.iter().copied().find(|t| tables[*t].name.component as usize % 3 == c)
        };
        // What lies along the axis does not turn.
        let across: Vec<usize> = (0..3).filter(|c| axis.direction[*c].abs() < 1.0 - 1e-9).collect();
        let found: Vec<usize> = across.iter().filter_map(|c| at(*c)).collect();
        let Some(first) = found.first().copied() else { continue };
        let same = found.iter().all(|t| tables[*t].positions == tables[first].positions);
        if found.len() < across.len() || !same {
            let message = format!(
                "{}: the errors across {} turn with it in this machine file (error_frame = \"moving\")",
                tables[first].name, axis.name
            );
            let hint = "read all of them at the same targets: EXC and EYC, EAC and EBC";
            problems.error(
                "needs-partner",
                Place::whole(&tables[first].name.to_string()),
                message,
                hint,
            );
            continue;
        }
        for row in 0..tables[first].positions.len() {
            let back = turn(machine, body, tables[first].positions[row]).transpose();
            let sides: [fn(&mut ErrorTable) -> &mut Vec<f64>; 2] = [|t| &mut t.up, |t| &mut t.down];
            for values in sides {
                let mut fixed = Vec3::zeros();
                for (c, t) in across.iter().zip(&found) {
                    fixed[*c] = values(&mut tables[*t])[row];
                }
                let turned = back * fixed;
                for (c, t) in across.iter().zip(&found) {
                    values(&mut tables[*t])[row] = turned[*c];
                }
            }
            let largest = found.iter().map(|t| tables[*t].u[row]).fold(0.0, f64::max);
            found.iter().for_each(|t| tables[*t].u[row] = largest);
        }
    }
}

/// The angular error motions: those that were read, else those of the machine file.
struct Angles<'a> {
    machine: &'a Machine,
    tables: &'a [ErrorTable],
}

/// An angle at a position: rising, falling, standard uncertainty, rad.
struct Angle {
    up_rad: f64,
    down_rad: f64,
    u_rad: f64,
}

impl Angles<'_> {
    /// `None` where it is not known.
    fn at(&self, index: ErrorIndex, q: f64) -> Option<Angle> {
        if let Some(table) = self.tables.iter().find(|t| t.index == index) {
            let between = |values: &[f64]| {
                let spline = Spline::new(&table.positions, values, Interpolation::NotAKnot).ok()?;
                let (from, to) = spline.range();
                Some(spline.at(q.clamp(from, to)))
            };
            let u_rad = table.u.iter().copied().fold(0.0, f64::max);
            return Some(Angle {
                up_rad: between(&table.up)?,
                down_rad: between(&table.down)?,
                u_rad,
            });
        }
        let stated = self.machine.bodies()[index.body].stated(index.kind, index.component)?;
        let side = |approach: f64| stated.at(q, approach).ok();
        Some(Angle { up_rad: side(1.0)?, down_rad: side(-1.0)?, u_rad: stated.u_at(q) })
    }
}

/// How a reading depends on the errors of its axis.
///
/// ```text
///     r = σ (κ E + Σ_c d·(v_c + ω_c × p) E_c)        E = κ (σ r − Σ_c d·(v_c + ω_c × p) E_c)
///                                                                            docs/model.md eq. 181
/// ```
///
/// d the direction of the reading, fixed in space, κ = ±1 on the side of tool or workpiece, (v, ω) the twist of an error (103), p the
/// point that the instrument sees. σ = 1; for the error along or about the axis itself σ = κ·sense, because
/// its readings count with the command; −σ where the workpiece is read against the tool.
struct Sight<'a> {
    machine: &'a Machine,
    readings: &'a ErrorReadings,
    /// κ.
    side: f64,
    /// σ.
    sign: f64,
}

impl<'a> Sight<'a> {
    fn of(machine: &'a Machine, readings: &'a ErrorReadings) -> Self {
        let side = side(machine, readings.index);
        let axis = &machine.axes()[readings.axis];
        let is_own = role(axis, readings.name.component) == Role::Positioning;
        let own = if is_own { side * axis.sense } else { 1.0 };
        let sign = if readings.of_workpiece { -own } else { own };
        Self { machine, readings, side, sign }
    }

    /// What an angular error of the same body does to a reading of length, mm per rad.
    fn arm_mm(&self, other: ErrorIndex, q: f64) -> f64 {
        let readings = self.readings;
        let mut command = readings.at;
        command[readings.axis] = q;
        let frames = self.machine.error_frames(&command, readings.stands_on);
        let directions = directions(self.machine, readings, q);
        let direction: Vec3 = directions.column(readings.name.component as usize % 3).into();
        let tool = frames.reference_from_tool();
        let point = tool.linear() * readings.optics_mm + tool.shift_mm();
        let twist = frames.twist(other);
        direction.dot(&(twist.shift_mm + twist.turn_rad.cross(&point)))
    }
}

/// What an error motion is to its axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Role {
    /// Along a linear axis, about a rotary one: its readings count with the command.
    Positioning,
    /// A tilt of a linear axis.
    Angle,
    /// Across a linear axis.
    Straightness,
    /// Along a rotary axis.
    Axial,
    /// Across a rotary axis: its run-out, or its tilt.
    RunOut,
}

/// The role of a component.
pub(super) fn role(axis: &Axis, component: Component) -> Role {
    let along = axis.direction[component as usize % 3].abs() > 1.0 - 1e-9;
    match (axis.kind, component.is_rotation()) {
        (AxisKind::Linear, true) => Role::Angle,
        (AxisKind::Linear, false) if along => Role::Positioning,
        (AxisKind::Linear, false) => Role::Straightness,
        (AxisKind::Rotary, true) if along || component.letter() == axis.name.letter() => {
            Role::Positioning
        }
        (AxisKind::Rotary, false) if along => Role::Axial,
        (AxisKind::Rotary, _) => Role::RunOut,
    }
}

fn reduce(
    machine: &Machine,
    readings: &ErrorReadings,
    angles: &Angles<'_>,
    problems: &mut Diagnostics,
) -> Option<ErrorTable> {
    let sight = Sight::of(machine, readings);
    let mut means = Means::of(&readings.measurement.targets, &readings.file, problems)?;
    let mut arms = Vec::new();
    for values in [&mut means.up, &mut means.down] {
        values.iter_mut().for_each(|r| *r *= sight.side * sight.sign);
    }
    if !readings.name.component.is_rotation() {
        arms = take_off_arms(&sight, &mut means, angles, problems);
    }
    let off_axis = off_axis_mm(&sight, &means) > SHORT_ARM_MM;
    let role = role(&machine.axes()[readings.axis], readings.name.component);
    let removed = removed_of(readings, role, off_axis);
    take_off_set_up(readings, removed, &mut means, problems)?;
    let zero = zero_of(readings, &means.positions);
    let u = means
        .positions
        .iter()
        .zip(&means.u_arms)
        .map(|(q, u_arm)| {
            let scale = readings.u_ratio * (q - zero);
            readings.u.hypot(means.u_mean()).hypot(scale).hypot(*u_arm)
        })
        .collect();
    Some(ErrorTable {
        name: readings.name,
        index: readings.index,
        axis: readings.axis,
        positions: means.positions,
        both: means.both,
        up: means.up,
        down: means.down,
        u,
        runs: means.runs,
        scatter: means.scatter,
        removed,
        arms,
        instrument: readings.instrument.clone(),
        date: readings.date.clone(),
        celsius: readings.celsius,
    })
}

/// Subtracts what the angles do over the arm, and names the angles that are not known.
fn take_off_arms(
    sight: &Sight<'_>,
    means: &mut Means,
    angles: &Angles<'_>,
    problems: &mut Diagnostics,
) -> Vec<(ErrorName, f64)> {
    let (readings, mut arms) = (sight.readings, Vec::new());
    for component in [Component::A, Component::B, Component::C] {
        let index = ErrorIndex { component, ..readings.index };
        let name = ErrorName { component, ..readings.name };
        let (mut largest_mm, mut unknown_mm) = (0.0_f64, 0.0_f64);
        for (i, q) in means.positions.iter().enumerate() {
            let arm_mm = sight.arm_mm(index, *q);
            match angles.at(index, *q) {
                Some(angle) => {
                    let (up, down) = (arm_mm * angle.up_rad, arm_mm * angle.down_rad);
                    means.up[i] -= sight.side * up;
                    means.down[i] -= sight.side * down;
                    means.u_arms[i] = means.u_arms[i].hypot(arm_mm * angle.u_rad);
                    largest_mm = largest_mm.max(up.abs()).max(down.abs());
                }
                None => unknown_mm = unknown_mm.max(arm_mm.abs()),
            }
        }
        if largest_mm > SHOWN_MM {
            arms.push((name, largest_mm));
        }
        if unknown_mm > SHORT_ARM_MM {
            let message = format!(
                "{} was read {unknown_mm:.0} mm away from where it acts, and {name} is not known: \
                 {:.2} µm for each µrad of it are in the table",
                readings.name,
                unknown_mm * 1e-3
            );
            let hint = format!("read {name}, too, or state where the optics were: at, optics");
            problems.warn("unknown-angle", Place::whole(&readings.file), message, &hint);
        }
    }
    arms
}

fn zero_of(readings: &ErrorReadings, positions: &[f64]) -> f64 {
    let (first, last) = (positions[0], positions[positions.len() - 1]);
    let usual = if (first..=last).contains(&0.0) { 0.0 } else { first };
    readings.zero.unwrap_or(usual)
}

/// How far from a rotary axis it was read along it: there the inclination of the axis, which is a location error, shows
/// once in a turn.
fn off_axis_mm(sight: &Sight<'_>, means: &Means) -> f64 {
    let arm = |component: Component| {
        sight.arm_mm(ErrorIndex { component, ..sight.readings.index }, means.positions[0])
    };
    [Component::A, Component::B, Component::C].map(arm).iter().map(|a| a * a).sum::<f64>().sqrt()
}

/// What the set-up hides.
fn removed_of(readings: &ErrorReadings, role: Role, off_axis: bool) -> Removed {
    match role {
        Role::Positioning | Role::Angle => Removed::Zero,
        Role::Straightness => Removed::Line(readings.line),
        Role::RunOut if readings.centred => Removed::Eccentricity,
        Role::Axial if readings.centred && off_axis => Removed::Eccentricity,
        Role::RunOut | Role::Axial => Removed::Mean,
    }
}

/// Subtracts it; the eccentricity later, with its partner.
fn take_off_set_up(
    readings: &ErrorReadings,
    removed: Removed,
    means: &mut Means,
    problems: &mut Diagnostics,
) -> Option<()> {
    match removed {
        Removed::Line(ReferenceLine::LeastSquares) => {
            let middle = 0.5 * (means.positions[0] + means.positions[means.positions.len() - 1]);
            let rows: Vec<Vec<f64>> =
                means.positions.iter().map(|q| vec![1.0, q - middle]).collect();
            let mean: Vec<f64> =
                means.up.iter().zip(&means.down).map(|(a, b)| 0.5 * (a + b)).collect();
            let off = fitted(&rows, &mean)?;
            for (i, off) in off.iter().enumerate() {
                means.up[i] -= off;
                means.down[i] -= off;
            }
        }
        Removed::Line(ReferenceLine::Ends) => {
            let last = means.positions.len() - 1;
            let mean = |i: usize| 0.5 * (means.up[i] + means.down[i]);
            let (from, to) = (means.positions[0], means.positions[last]);
            let (first, slope) = (mean(0), (mean(last) - mean(0)) / (to - from));
            subtract(means, |q| first + slope * (q - from));
        }
        Removed::Eccentricity => {}
        Removed::Mean => {
            let mean: f64 =
                means.up.iter().chain(&means.down).sum::<f64>() / (2.0 * means.up.len() as f64);
            subtract(means, |_| mean);
        }
        Removed::Zero | Removed::Line(ReferenceLine::None) => take_zero(readings, means, problems)?,
    }
    Some(())
}

fn take_zero(
    readings: &ErrorReadings,
    means: &mut Means,
    problems: &mut Diagnostics,
) -> Option<()> {
    let zero = zero_of(readings, &means.positions);
    let (first, last) = (means.positions[0], means.positions[means.positions.len() - 1]);
    if !(first..=last).contains(&zero) {
        let message = format!("{}: its zero is outside the targets", readings.name);
        let hint = "zero = a position between the first and the last target";
        problems.error("zero-outside", Place::whole(&readings.file), message, hint);
        return None;
    }
    let mean: Vec<f64> = means.up.iter().zip(&means.down).map(|(a, b)| 0.5 * (a + b)).collect();
    let spline = Spline::new(&means.positions, &mean, Interpolation::NotAKnot).ok()?;
    let there = spline.at(zero);
    subtract(means, |_| there);
    Some(())
}

fn subtract(means: &mut Means, of: impl Fn(f64) -> f64) {
    for (i, q) in means.positions.iter().enumerate() {
        means.up[i] -= of(*q);
        means.down[i] -= of(*q);
    }
}

/// The least-squares fit of values by rows of functions.
fn fitted(rows: &[Vec<f64>], values: &[f64]) -> Option<Vec<f64>> {
    let a = DMatrix::from_fn(rows.len(), rows.first()?.len(), |i, j| rows[i][j]);
    let b = DVector::from_column_slice(values);
    let x = a.clone().svd(true, true).solve(&b, 1e-12).ok()?;
    Some((a * x).as_slice().to_vec())
}

/// Subtracts the means and the eccentricity of the artefact of run-out and tilt of rotary axes.
///
/// ```text
///     u = a + e₁ cos θ − e₂ sin θ        v = b + e₁ sin θ + e₂ cos θ        docs/model.md eq. 182
/// ```
///
/// θ how far the axis has turned in space, (u, v) across it. An eccentricity goes round with the axis: with both directions
/// read at the same targets what goes round the other way stays in the tables. One direction alone loses its
/// whole first harmonic.
fn centre(machine: &Machine, tables: &mut [ErrorTable], problems: &mut Diagnostics) {
    for (i, axis) in machine.axes().iter().enumerate() {
        let mut found: Vec<usize> = (0..tables.len())
            .filter(|t| tables[*t].axis == i && tables[*t].removed == Removed::Eccentricity)
            .collect();
        for t in &found {
            let positions = &tables[*t].positions;
            let span = positions[positions.len() - 1] - positions[0];
            if span < PI {
                let message = format!(
                    "{}: over {:.0} deg the eccentricity of the artefact cannot be separated from the error",
                    tables[*t].name,
                    span.to_degrees()
                );
                let hint = "eccentricity = \"kept\" leaves it in the table: centre the artefact";
                problems.error(
                    "short-arc",
                    Place::whole(&tables[*t].name.to_string()),
                    message,
                    hint,
                );
                return;
            }
        }
        // What lies along the axis has no partner; (u, v) in the order in which u × v is along the axis.
        let along = (0..3).find(|c| axis.direction[*c].abs() > 1.0 - 1e-9);
        let order = |t: &usize| match along {
            Some(along) => (tables[*t].name.component as usize % 3 + 2 - along) % 3,
            None => 0,
        };
        found.sort_by_key(|t| (tables[*t].name.component.is_rotation(), order(t)));
        let pair: Vec<usize> = found.iter().copied().filter(|t| order(t) < 2).collect();
        let alone: Vec<usize> = found.iter().copied().filter(|t| order(t) == 2).collect();
        let same = pair.len() == 2 && tables[pair[0]].positions == tables[pair[1]].positions;
        alone.iter().for_each(|t| centre_one(&mut tables[*t]));
        if let (true, Some(along)) = (same, along) {
            centre_both(tables, [pair[0], pair[1]], axis.sense * axis.direction[along]);
        } else {
            pair.iter().for_each(|t| centre_one(&mut tables[*t]));
        }
    }
}

fn centre_one(table: &mut ErrorTable) {
    let rows: Vec<Vec<f64>> = table.positions.iter().map(|q| vec![1.0, q.cos(), q.sin()]).collect();
    if let Some(off) = fitted(&rows, &table.mean()) {
        take_off(table, &off);
    }
}

fn centre_both(tables: &mut [ErrorTable], [u, v]: [usize; 2], sense: f64) {
    let angles: Vec<f64> = tables[u].positions.iter().map(|q| sense * q).collect();
    let of_u = angles.iter().map(|t| vec![1.0, 0.0, t.cos(), -t.sin()]);
    let of_v = angles.iter().map(|t| vec![0.0, 1.0, t.sin(), t.cos()]);
    let rows: Vec<Vec<f64>> = of_u.chain(of_v).collect();
    let values = [tables[u].mean(), tables[v].mean()].concat();
    if let Some(off) = fitted(&rows, &values) {
        let (first, second) = off.split_at(angles.len());
        take_off(&mut tables[u], first);
        take_off(&mut tables[v], second);
    }
}

fn take_off(table: &mut ErrorTable, off: &[f64]) {
    for (i, off) in off.iter().enumerate() {
        table.up[i] -= off;
        table.down[i] -= off;
    }
}
