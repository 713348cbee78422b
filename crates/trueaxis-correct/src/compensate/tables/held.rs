//! What the control holds already, of the errors that the machine file calls active: what is written is absolute and
//! goes in its place, so nothing may be written where one of them is.
//!
//! ```text
//!     own error of an axis          its own table
//!     other functions of an axis    the tables of that axis, or the grid
//!     errors of a link              the file of the link
//!     places of rotary axes         the kinematic parameters, all together
//! ```

use super::control::{Control, range};
use super::known::split;
use super::lever::{Lever, own_component};
use super::table::{Table, counts};
use super::{Compiled, Order, TablesError};
use trueaxis_machine::Machine;
use trueaxis_machine::axis::AxisKind;
use trueaxis_machine::errors::{BodyName, ErrorIndex, ErrorName};

/// A function is examined at so many places between the ends.
const GLANCES: i64 = 16;

/// Where a control holds something.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Place {
    /// A table.
    Table { input: usize, output: usize },
    /// The errors of one link.
    Link(BodyName),
    /// The places of the rotary axes.
    Kinematics,
    /// The grid.
    Grid,
}

/// Refuses what would go in the place of an active error.
///
/// # Errors
/// [`TablesError::Active`] by the first such place; a position that an error table does not cover.
pub fn nothing_overwritten(
    machine: &Machine,
    order: &Order,
    compiled: &Compiled,
) -> Result<(), TablesError> {
    let control = order.target.control();
    let stated = machine.stated_errors();
    let is_active = |name: &ErrorName| machine.active_compensation().contains(name);
    for (index, name) in stated.iter().filter(|(_, name)| is_active(name)) {
        for place in places(machine, order, control.as_ref(), (*index, *name))? {
            let directed = is_directional(machine, *index);
            if let Some(written) =
                written_over(machine, control.as_ref(), compiled, (place, directed))
            {
                return Err(TablesError::Active { error: *name, written });
            }
        }
    }
    Ok(())
}

fn is_directional(machine: &Machine, index: ErrorIndex) -> bool {
    let stated = machine.bodies()[index.body].stated(index.kind, index.component);
    stated.is_some_and(|s| s.reversal.is_some())
}

/// Where this control holds an error that it compensates.
fn places(
    machine: &Machine,
    order: &Order,
    control: &dyn Control,
    (index, name): (ErrorIndex, ErrorName),
) -> Result<Vec<Place>, TablesError> {
    let cold = machine.without_heat();
    let others = cold.stated_errors().into_iter().filter(|(_, other)| *other != name);
    let alone = others.fold(cold.clone(), |m, (other, _)| m.with_error(other, None));
    let (chain, rest) = split(&alone, control, order.kinematics);
    if !chain.stated_errors().is_empty() {
        return Ok(vec![match control.knows_links() {
            true => Place::Link(name.body),
            false => Place::Kinematics,
        }]);
    }
    if rest.stated_errors().is_empty() {
        return Ok(Vec::new());
    }
    let axis = machine.bodies()[index.body].axis;
    let own = axis.filter(|i| name.component == own_component(&machine.axes()[*i]));
    let lever =
        Lever::new(&rest, order.reference.unwrap_or_else(|| super::compile::middle(machine)))?;
    let mut places = Vec::new();
    for (input, output) in control.pairs(machine) {
        if own == Some(output) && input == output || varies(&lever, control, (input, output))? {
            places.push(Place::Table { input, output });
        }
    }
    let of_linear = axis.is_some_and(|i| machine.axes()[i].kind == AxisKind::Linear);
    if control.grid().is_some() && own.is_none() && of_linear {
        places.push(Place::Grid);
    }
    Ok(places)
}

/// Whether an axis adds different amounts at different positions of another; a constant may stand in any table.
fn varies(
    lever: &Lever<'_>,
    control: &dyn Control,
    (input, output): (usize, usize),
) -> Result<bool, TablesError> {
    let machine = lever.machine();
    let ((from, to), _) = range(&machine.axes()[input], control)?;
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    for i in 0..=GLANCES {
        let at = from + (i128::from(to - from) * i128::from(i) / i128::from(GLANCES)) as i64;
        let q = at as f64 * super::table::count_of(machine, input);
        let value = counts(machine, output, lever.functions(input, q, 0.0)?[output]);
        (low, high) = (low.min(value), high.max(value));
    }
    Ok(high - low > control.rule().increment)
}

/// What is written in a place, in words; nothing if it stays as it is.
fn written_over(
    machine: &Machine,
    control: &dyn Control,
    compiled: &Compiled,
    (place, directed): (Place, bool),
) -> Option<String> {
    let name = |axis: usize| machine.axes()[axis].name;
    let moves = |t: &Table| format!("{} moves {}", name(t.input), name(t.output));
    match place {
        Place::Table { input, output } => {
            let held = (input, output);
            let mut tables = compiled.tables.iter().map(|made| &made.table);
            let over = |t: &&Table| {
                (t.input, t.output) == held || control.shares_numbers(t, held, directed)
            };
            tables.find(over).map(moves)
        }
        Place::Link(body) => {
            let mut known = compiled.known.iter().map(|k| k.known.error);
            let over = |e: &ErrorName| e.body == body || control.has_one_file_of_links();
            known.find(over).map(|error| format!("the file of {error}"))
        }
        Place::Kinematics => compiled
            .joints
            .as_ref()
            .map(|_| "the kinematic parameters of the rotary axes".to_owned()),
        Place::Grid => compiled.grid.as_ref().map(|_| "the grid".to_owned()),
    }
}
