//! Velocities and reversals of the axes at every reading, from the poses in order and their feed.
//!
//! ```text
//!     v_i = (q_i − q_i,before)/Δt    Δt = max(|ΔP|/F, |Δq_i|/v_i,max)       docs/model.md eq. 193
//! ```
//!
//! The control goes straight in the axes from one pose to the next. A reading at feed 0 stands, and
//! is where a pass begins.

use super::{Instrument, Kind, Readings};
use trueaxis_geometry::Vec3;
use trueaxis_machine::Machine;
use trueaxis_machine::axis::Command;
use trueaxis_machine::chain::Link;
use trueaxis_machine::errors::ErrorValues;
use trueaxis_machine::twist::Reference;
use trueaxis_motion::limits;

/// The rounding of an inverse is no motion, mm or rad.
pub(super) const REST: f64 = 1e-9;
/// Axes are written with four decimals of mm or deg: less is no motion.
const WRITTEN_REST: f64 = 2e-6;

/// Fills speeds and reversals of all readings that state a feed; sides of approach too, if no row of
/// the instrument states one.
pub fn fill_motion(readings: &mut Readings, machine: &Machine, instruments: &[Instrument]) {
    for (of, instrument) in instruments.iter().enumerate() {
        let mut rows: Vec<usize> =
            (0..readings.len()).filter(|i| readings.instruments[*i] as usize == of).collect();
        // Where the times are stated they are the order; if not, they are all 0.
        rows.sort_by(|a, b| readings.times_s[*a].total_cmp(&readings.times_s[*b]));
        fill_rows(readings, &rows, machine, instrument);
    }
}

/// The same for rows of one instrument in the order in which they were read.
fn fill_rows(readings: &mut Readings, rows: &[usize], machine: &Machine, instrument: &Instrument) {
    if rows.iter().all(|i| readings.motions[*i].feed_mm_per_s.is_none()) {
        return;
    }
    let sided = rows.iter().any(|i| readings.approaches[*i] != [0.0; 6]);
    let axes = machine.axes().len();
    let velocity = limits(machine).velocity;
    let (mut turned, mut ago) = ([0.0; 6], [0.0; 6]);
    for (n, i) in rows.iter().enumerate() {
        let here = readings.commands[*i];
        let mut motion = readings.motions[*i];
        motion.speed = [0.0; 6];
        let before = n.checked_sub(1).map(|n| rows[n]);
        let came = before.map_or([0.0; 6], |b| readings.approaches[b]);
        if !sided {
            readings.approaches[*i] = came;
        }
        if let (Some(b), true) = (before, motion.is_moving()) {
            let from = readings.commands[b];
            let feed = motion.feed_mm_per_s.unwrap_or(0.0);
            let mut time_s = length_mm(machine, instrument, &from, &here) / feed;
            for axis in 0..axes {
                time_s = time_s.max((here[axis] - from[axis]).abs() / velocity[axis]);
            }
            for axis in 0..axes {
                ago[axis] += time_s;
                if (here[axis] - from[axis]).abs() > WRITTEN_REST && time_s > 0.0 {
                    motion.speed[axis] = (here[axis] - from[axis]) / time_s;
                }
            }
        } else {
            (turned, ago) = ([0.0; 6], [0.0; 6]);
            if let (Some(b), false) = (before, sided) {
                motion_side(readings, *i, &readings.commands[b].clone(), axes);
            }
        }
        if !sided {
            for axis in (0..axes).filter(|a| motion.speed[*a] != 0.0) {
                readings.approaches[*i][axis] = motion.speed[axis].signum();
            }
        }
        let next = rows.get(n + 1).filter(|next| readings.motions[**next].is_moving());
        if let Some(next) = next {
            let to = readings.commands[*next];
            for axis in 0..axes {
                let way = to[axis] - here[axis];
                if way.abs() > WRITTEN_REST && way * readings.approaches[*i][axis] < 0.0 {
                    (turned[axis], ago[axis]) = (way.signum(), 0.0);
                }
            }
        }
        (motion.turned, motion.turned_ago_s) = (turned, ago);
        readings.motions[*i] = motion;
    }
}

/// The side from which a standing axis came.
fn motion_side(readings: &mut Readings, row: usize, from: &Command, axes: usize) {
    for (axis, q) in from.iter().enumerate().take(axes) {
        let way = readings.commands[row][axis] - q;
        if way.abs() > WRITTEN_REST {
            readings.approaches[row][axis] = way.signum();
        }
    }
}

/// How far the tool goes against the reference: the probe of a probe-ball, which turns about its
/// ball; of others the tool point. Where that stands still, the origin of the tool.
pub(super) fn length_mm(
    machine: &Machine,
    instrument: &Instrument,
    from: &Command,
    to: &Command,
) -> f64 {
    let none = ErrorValues::default();
    let moved = |point: Vec3| {
        let at = |command: &Command| {
            let pose = reference_from_tool(machine, instrument.reference, command, &none);
            pose.linear() * point + pose.shift_mm()
        };
        (at(to) - at(from)).norm()
    };
    let up = match instrument.kind {
        Kind::ProbeBall => Vec3::new(0.0, 0.0, instrument.length_mm),
        _ => Vec3::zeros(),
    };
    let length = moved(instrument.tool_point_mm + up);
    if length > 1e-9 { length } else { moved(Vec3::zeros()) }
}

pub(super) fn reference_from_tool(
    machine: &Machine,
    reference: Reference,
    command: &Command,
    errors: &ErrorValues,
) -> Link {
    match reference {
        Reference::Workpiece => machine.pose(command, errors).relabel(),
        Reference::Bed => machine.tool_on_bed(command, errors).relabel(),
    }
}
