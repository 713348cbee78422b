//! Which location error states the squareness of two linear axes.

use trueaxis_machine::Machine;
use trueaxis_machine::errors::{Component, ErrorKind, ErrorName};
use trueaxis_measure::unknowns::minimal::minimal_location_errors;

/// The location error that states the squareness of two linear axes: of those that are independent.
pub fn location_error(machine: &Machine, axes: [usize; 2]) -> Option<ErrorName> {
    let [first, second] = axes.map(|i| &machine.axes()[i]);
    let normal = first.direction.cross(&second.direction);
    let component = [Component::A, Component::B, Component::C]
        .into_iter()
        .find(|c| normal[*c as usize % 3].abs() > 0.5)?;
    let names = [first.name, second.name];
    let is_theirs = |name: &ErrorName| name.component == component && names.contains(&name.body);
    // The one that the machine file states is replaced; a second one would add to it.
    let stated = machine.stated_errors().into_iter().map(|(_, name)| name);
    let location = |name: &ErrorName| name.kind == ErrorKind::Location && is_theirs(name);
    let of_machine: Vec<ErrorName> = stated.filter(location).collect();
    let terms = minimal_location_errors(machine);
    let minimal = terms.iter().map(|t| t.error).find(is_theirs);
    match minimal {
        Some(name) if of_machine.is_empty() || of_machine.contains(&name) => Some(name),
        _ => of_machine.first().copied().or(minimal),
    }
}
