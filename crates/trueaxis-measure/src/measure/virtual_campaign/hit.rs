//! Where a touch probe triggers on the true machine.

use super::TrueTool;
use super::follow::Stand;
use crate::instruments::instrument::{Sight, View};
use crate::measure::Campaign;
use crate::measure::motion::reference_from_tool;
use nalgebra::{DMatrix, DVector};
use trueaxis_geometry::Vec3;
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{AxisKind, Command};
use trueaxis_machine::chain::CommandFault;
use trueaxis_machine::errors::ErrorValues;

/// The probe triggers when the surfaces are so close, mm: far below any reading.
const CLOSE_MM: f64 = 1e-11;
/// More steps than this do not help: the line of approach passes the ball.
const MOST_STEPS: usize = 60;

/// Why there is no hit.
pub enum Miss {
    /// Outside the tables of the machine.
    Outside(CommandFault),
    /// For another reason.
    No(&'static str),
}

/// The command at which the true stylus touches: through the station, in the direction of
/// approach, with linear axes only.
///
/// ```text
///     q(t) = q₀ + t A⁺u      r(q(t)) = R        u = (Q − P)/|Q − P|, or n of a face
///                                                                          docs/model.md eq. 115
/// ```
pub fn hit(
    campaign: &Campaign,
    tool: &TrueTool<'_>,
    stand: &Stand,
    reach_mm: f64,
) -> Result<Command, Miss> {
    let from = stand.reading.command;
    let own = &campaign.instruments[stand.reading.instrument as usize];
    let nominal = |command: &Command| {
        let none = ErrorValues::default();
        let pose = reference_from_tool(&campaign.machine, own.reference, command, &none);
        pose.linear() * own.tool_point_mm + pose.shift_mm()
    };
    let (towards, mut slope) = match own.sight {
        Sight::Distance => ((own.reference_point_mm - nominal(&from)).try_normalize(1e-6), -1.0),
        _ => (Some(stand.reading.direction), 1.0),
    };
    let centre = "the station is the centre of the ball: no direction leads to it";
    let towards = towards.ok_or(Miss::No(centre))?;
    let along = linear_axes(&campaign.machine, &from, nominal, towards)
        .ok_or(Miss::No("the linear axes cannot go that way"))?;
    let at = |t: f64| {
        let mut command = from;
        for (q, by) in command.iter_mut().zip(along) {
            *q += t * by;
        }
        command
    };
    let gap = |t: f64| {
        let actual = tool.pose(&at(t), stand).map_err(Miss::Outside)?;
        let time_s = stand.reading.time_s;
        let drifted = tool.instrument.drifted(&campaign.machine, &from, time_s);
        let direction = stand.reading.direction;
        let view = View { nominal: actual, actual, direction, drifted };
        Ok(tool.instrument.read(&view, tool.setup)[0] - reach_mm)
    };
    let (mut t, mut g) = (0.0, gap(0.0)?);
    for _ in 0..MOST_STEPS {
        if g.abs() < CLOSE_MM {
            return Ok(at(t));
        }
        let next = t - g / slope;
        if !next.is_finite() || (next - t).abs() > 1e4 {
            break;
        }
        let there = gap(next)?;
        // The secant; where two steps fall together the last slope holds.
        if next != t && there != g {
            slope = (there - g) / (next - t);
        }
        (t, g) = (next, there);
    }
    // The last digits of large coordinates.
    if g.abs() < 10.0 * CLOSE_MM {
        return Ok(at(t));
    }
    Err(Miss::No("its way leads past the true ball or face"))
}

/// How the linear axes move so that the tool point moves by a unit vector of the reference.
fn linear_axes(
    machine: &Machine,
    from: &Command,
    point: impl Fn(&Command) -> Vec3,
    towards: Vec3,
) -> Option<Command> {
    let linear: Vec<usize> =
        (0..machine.axes().len()).filter(|i| machine.axes()[*i].kind == AxisKind::Linear).collect();
    let here = point(from);
    let mut moves = DMatrix::zeros(3, linear.len());
    for (column, i) in linear.iter().enumerate() {
        let mut command = *from;
        command[*i] += 100.0;
        moves.set_column(column, &((point(&command) - here) / 100.0));
    }
    let wanted = DVector::from_column_slice(towards.as_slice());
    let solved = moves.clone().svd(true, true).solve(&wanted, 1e-9).ok()?;
    if (&moves * &solved - wanted).norm() > 1e-6 {
        return None;
    }
    let mut along = Command::default();
    for (column, i) in linear.iter().enumerate() {
        along[*i] = solved[column];
    }
    Some(along)
}
