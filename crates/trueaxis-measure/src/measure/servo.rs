//! `[unknown.servo]`: how the axes follow, as unknowns.
//!
//! ```text
//!     δ = −τ v − (b/2) sign(v) − h d e^{−(t − t_r)/t_s}                      docs/model.md eq. 194
//! ```

use crate::unknowns::term::{Basis, Term};
use trueaxis_input::{Dimension, Item, Section};
use trueaxis_machine::Machine;
use trueaxis_machine::axis::Axis;

/// `lag = ["X", "Y"]` or `"all"`, `lost_motion = …`, `friction = …` with `friction_time = "30 ms"`.
pub(super) fn read_servo(section: &Section<'_>, machine: &Machine) -> Vec<Term> {
    let mut terms = Vec::new();
    if let Some(item) = section.get("lag") {
        terms.extend(read_axes(&item, machine, |sense| Basis::Lag { sense }));
    }
    if let Some(item) = section.get("lost_motion") {
        terms.extend(read_axes(&item, machine, |sense| Basis::LostMotion { sense }));
    }
    let free_s = section.get("friction_time").and_then(|i| {
        let time_s = i.quantity(Dimension::Time)?;
        if time_s <= 0.0 {
            let message = "an axis comes free in a time that is positive".to_owned();
            i.error("bad-time", message, "friction_time = \"30 ms\"");
        }
        Some(time_s).filter(|t| *t > 0.0)
    });
    if let Some(item) = section.get("friction") {
        if section.get("friction_time").is_none() {
            let message = "how fast does an axis come free after it turned?".to_owned();
            item.error("missing-key", message, "friction_time = \"30 ms\"");
        }
        let free_s = free_s.unwrap_or(1.0);
        terms.extend(read_axes(&item, machine, |sense| Basis::Friction { free_s, sense }));
    }
    terms
}

fn read_axes(item: &Item<'_>, machine: &Machine, basis: impl Fn(f64) -> Basis) -> Vec<Term> {
    if !item.is_list() && item.as_text() == Some("all") {
        let every = machine.axes().iter().enumerate();
        return every.filter_map(|(i, axis)| term(item, machine, i, axis, &basis)).collect();
    }
    let Some(list) = item.is_list().then(|| item.list()).flatten() else {
        let message = "which axes?".to_owned();
        item.error("bad-list", message, "\"all\", or a list [\"X\", \"Y\", \"C\"]");
        return Vec::new();
    };
    let mut terms: Vec<Term> = Vec::new();
    for item in &list {
        let Some(name) = item.text() else { continue };
        let found = machine.axes().iter().enumerate().find(|(_, a)| a.name.to_string() == name);
        let Some((i, axis)) = found else {
            let message = format!("the machine has no axis `{name}`");
            item.error("unknown-axis", message, &machine.chain_text());
            continue;
        };
        if terms.iter().any(|t| t.axis == Some(i)) {
            item.error("duplicate-name", format!("{name} is named twice"), "name each axis once");
            continue;
        }
        terms.extend(term(item, machine, i, axis, &basis));
    }
    terms
}

/// The unknown of one axis.
fn term(
    item: &Item<'_>,
    machine: &Machine,
    i: usize,
    axis: &Axis,
    basis: &impl Fn(f64) -> Basis,
) -> Option<Term> {
    let term = Term::servo(machine, i, basis);
    if term.is_none() {
        let message = format!("{} is inclined: its servo errors cannot be determined", axis.name);
        item.error("inclined-axis", message, "name axes that lie along X, Y or Z of the machine");
    }
    term
}
