//! Errors that a control's own chain knows: of every link six functions of its axis, or location errors. The
//! control moves the linear axes so that the tip of that chain is right.

use super::content::{Known, count_of_error};
use super::control::{Control, range};
use super::lever::own_component;
use super::link::link_errors;
use super::place::{PlaceFault, Placed, Rule, Spacing};
use super::table::count_of;
use super::{Order, TablesError, place};
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{Approach, Command};
use trueaxis_machine::chain::{CommandFault, ErrorFrame};
use trueaxis_machine::errors::{Component, ErrorIndex, ErrorKind, ErrorName, ErrorValues};
use trueaxis_machine::volume::commands;

/// Poses at which the reach of a rotation is examined, besides the corners.
const POSES: u32 = 32;
/// An error is evaluated so often before it is placed.
const GLANCES: i64 = 32;
/// A rotation for the reach, rad.
const SMALL_RAD: f64 = 1e-6;

/// An error that is written.
#[derive(Debug, Clone, PartialEq)]
pub struct MadeKnown {
    /// The error.
    pub known: Known,
    /// The most that interpolation and rounding lose of it. Unit: mm or rad.
    pub loss: f64,
    /// Its largest value. Unit: mm or rad.
    pub largest: f64,
    /// Whether it is somewhere larger than its own standard uncertainty.
    pub certain: bool,
}

/// What a control can know of a machine, with the errors that are written and those left out.
pub struct Knowledge {
    /// The errors.
    pub made: Vec<MadeKnown>,
    /// Errors that are not known well enough.
    pub left_out: Vec<(ErrorName, f64)>,
}

/// The machine with the errors that the control's chain can know, and that with those which are left to tables and
/// grid.
///
/// Where the chain knows whole links, the errors of workpiece and tool are neither: they belong into the work offset
/// and the tool.
pub fn split(machine: &Machine, control: &dyn Control, kinematics: bool) -> (Machine, Machine) {
    let pairs = control.pairs(machine);
    let links = control.knows_links();
    let mut parts = (machine.clone(), machine.clone());
    for (index, name) in machine.stated_errors() {
        let axis = machine.bodies()[index.body].axis;
        let own = axis.is_some_and(|i| is_own(machine, i, name) && pairs.contains(&(i, i)));
        let known = match links {
            true => axis.is_some() && !own,
            false => kinematics && control.knows_location(machine, name),
        };
        if !known {
            parts.0 = parts.0.with_error(index, None);
        }
        if known || links && !own {
            parts.1 = parts.1.with_error(index, None);
        }
    }
    match links {
        true => (parts.0, parts.1.without_heat()),
        false => (parts.0.without_heat(), parts.1),
    }
}

/// Whether an error is the positioning error of an axis or its zero, which that axis takes back itself.
fn is_own(machine: &Machine, axis: usize, error: ErrorName) -> bool {
    error.component == own_component(&machine.axes()[axis])
}

/// The errors that a control can know, with the fewest nodes that keep the bound at the tip.
///
/// # Errors
/// [`TablesError`]
pub fn compile(
    machine: &Machine,
    order: &Order,
    control: &dyn Control,
) -> Result<Knowledge, TablesError> {
    let mut knowledge = Knowledge { made: Vec::new(), left_out: Vec::new() };
    for body in 0..machine.bodies().len() {
        for one in of_body(machine, order, control, body)? {
            let error = one.known.error;
            let increment = control.known_increment(error) as f64 * one.known.count();
            if one.largest < 0.5 * increment {
                continue;
            }
            match one.certain {
                true => knowledge.made.push(one),
                false => knowledge.left_out.push((error, one.largest)),
            }
        }
    }
    Ok(knowledge)
}

/// The errors of one body; they stand in one file, all with as many nodes as the one that needs most.
fn of_body(
    machine: &Machine,
    order: &Order,
    control: &dyn Control,
    body: usize,
) -> Result<Vec<MadeKnown>, TablesError> {
    let chain = &machine.bodies()[body];
    let Some(axis) = chain.axis.filter(|_| control.knows_links()) else {
        return Ok(Vec::new());
    };
    let mut fewest = 2;
    loop {
        let rule = Rule { spacing: Spacing::Equal, fewest_nodes: fewest, ..control.known_rule() };
        let one = |c| {
            let name = ErrorName { body: chain.name, kind: ErrorKind::Motion, component: c };
            function(machine, (order, rule), control, (body, axis, name))
        };
        let all = Component::ALL.into_iter().map(one).collect::<Result<Vec<_>, _>>()?;
        let of_use = all.into_iter().filter(|m| m.largest > 0.0).collect::<Vec<_>>();
        let most = of_use.iter().map(|m| m.known.nodes.len()).max().unwrap_or(fewest);
        if of_use.iter().all(|m| m.known.nodes.len() == most) {
            return Ok(of_use);
        }
        fewest = most;
    }
}

/// One standard uncertainty of an error of a link with its location errors in it, to first order.
fn u_of_link(
    machine: &Machine,
    (body, component): (usize, Component),
    command: &Command,
    frame: ErrorFrame,
) -> Result<f64, CommandFault> {
    let errors = machine.errors_at(command, &Approach::default())?;
    let quantities = machine.uncertain_quantities();
    let known = machine.uncertainties_at(command, &quantities);
    let of = |errors: &ErrorValues| {
        link_errors(machine, body, command, (&errors.bodies[body], frame)).0[component as usize]
    };
    let moved =
        (0..quantities.len()).map(|k| of(&known.displaced_by(&errors, k, 1.0)) - of(&errors));
    Ok(moved.map(|d| d * d).sum::<f64>().sqrt())
}

fn function(
    machine: &Machine,
    (order, mut rule): (&Order, Rule),
    control: &dyn Control,
    (body, axis, error): (usize, usize, ErrorName),
) -> Result<MadeKnown, TablesError> {
    let (ends, modulo) = range(&machine.axes()[axis], control)?;
    let (count_in, count) = (count_of(machine, axis), count_of_error(error));
    let frame = control.link_frame(machine, body);
    let command = |at: i64| {
        let mut command = Command::default();
        command[axis] = at as f64 * count_in;
        command
    };
    let value = |at: i64| {
        let command = command(at);
        let of = machine.errors_at(&command, &Approach::default())?.bodies[body];
        let six = link_errors(machine, body, &command, (&of, frame));
        Ok::<_, CommandFault>(six.0[error.component as usize] / count)
    };
    // Such a chain has one value for both directions.
    let function = |at: i64| Ok([value(at)?; 2]);
    // Of errors that are known together the u of one says nothing.
    let (mut largest, mut certain) = (0.0_f64, machine.joint().is_some());
    for i in 0..=GLANCES {
        let at =
            ends.0 + (i128::from(ends.1 - ends.0) * i128::from(i) / i128::from(GLANCES)) as i64;
        let size = value(at)?.abs() * count;
        largest = largest.max(size);
        certain |= size > u_of_link(machine, (body, error.component), &command(at), frame)?;
    }
    let rotation = error.component.is_rotation();
    let limit = if rotation { order.limit_rad } else { order.limit_mm };
    if largest > limit {
        return Err(TablesError::ErrorTooLarge {
            error,
            value: shown(error, largest),
            limit: shown(error, limit),
        });
    }
    let bound = order.bound_mm / if rotation { reach(machine, body, error.component) } else { 1.0 };
    rule.increment = control.known_increment(error) as f64;
    let placed = place::place(&function, ends, (rule, modulo), bound / count);
    let Placed { nodes, loss } = placed.map_err(|fault| match fault {
        PlaceFault::Machine(fault) => TablesError::Position(fault),
        PlaceFault::Increment => {
            TablesError::ErrorIncrement { target: control.key(), error, bound: shown(error, bound) }
        }
        PlaceFault::TooMany(loss) | PlaceFault::Turns(loss) => TablesError::ErrorNodes {
            error,
            most: rule.most_nodes,
            loss: shown(error, loss * count),
            bound: shown(error, bound),
        },
    })?;
    let known = Known { error, modulo, nodes };
    Ok(MadeKnown { known, loss: loss * count, largest, certain })
}

/// How far the tip moves per rad of a rotation of a link, at most over the volume, mm per rad; 1 mm at least.
fn reach(machine: &Machine, body: usize, component: Component) -> f64 {
    let mut errors = ErrorValues::default();
    errors.set(ErrorIndex { body, kind: ErrorKind::Motion, component }, SMALL_RAD);
    let poses = commands(machine.axes(), POSES);
    let moved = poses.iter().map(|q| machine.deviation(q, &errors).tip_mm.norm() / SMALL_RAD);
    moved.fold(1.0, f64::max)
}

/// An error as people write it.
pub fn shown(error: ErrorName, value: f64) -> String {
    match error.component.is_rotation() {
        true => format!("{:.2} µrad", value * 1e6),
        false => format!("{:.2} µm", value * 1e3),
    }
}
