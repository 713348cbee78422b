//! The error budget: every error alone, and the part without it.

use super::Error;
use super::judge::Judge;
use trueaxis_machine::Machine;
use trueaxis_machine::errors::{
    BodyErrors, BodyName, ErrorIndex, ErrorKind, ErrorName, ErrorValues,
};

/// What one error, or one group of errors, does to every index.
#[derive(Debug, Clone, PartialEq)]
pub struct Share<T> {
    /// The error or the group.
    pub of: T,
    /// Each index (mm) if there were nothing else.
    pub alone_mm: Vec<f64>,
    /// Each index (mm) if this were zero.
    pub without_mm: Vec<f64>,
}

/// The shares of single errors, of bodies, and of constants against error motions.
#[derive(Debug, Clone, PartialEq)]
pub struct ErrorBudget {
    /// Every stated error, in chain order.
    pub errors: Vec<Share<ErrorName>>,
    /// Every body with a stated error.
    pub bodies: Vec<Share<BodyName>>,
    /// Location errors and error motions.
    pub kinds: Vec<Share<ErrorKind>>,
}

/// Asks for every stated error.
///
/// # Errors
/// As [`Judge::indices`].
pub fn budget(machine: &Machine, judge: &Judge<'_>) -> Result<ErrorBudget, Error> {
    let stated = machine.stated_errors();
    let errors = stated.iter().map(|&(index, name)| {
        share(
            judge,
            name,
            |values| only(values, |i| i == index),
            |values| {
                let mut rest = *values;
                rest.set(index, 0.0);
                rest
            },
        )
    });
    let bodies = machine.bodies().iter().enumerate();
    let bodies = bodies.filter(|(i, _)| stated.iter().any(|(index, _)| index.body == *i));
    let bodies = bodies.map(|(body, b)| {
        share(
            judge,
            b.name,
            |values| only(values, |i| i.body == body),
            |values| {
                let mut rest = *values;
                rest.bodies[body] = BodyErrors::default();
                rest
            },
        )
    });
    let kinds = [ErrorKind::Location, ErrorKind::Motion];
    let kinds = kinds.into_iter().map(|kind| {
        share(judge, kind, |v| only(v, |i| i.kind == kind), |v| only(v, |i| i.kind != kind))
    });
    Ok(ErrorBudget {
        errors: errors.collect::<Result<_, _>>()?,
        bodies: bodies.collect::<Result<_, _>>()?,
        kinds: kinds.collect::<Result<_, _>>()?,
    })
}

fn share<T>(
    judge: &Judge<'_>,
    of: T,
    alone: impl Fn(&ErrorValues) -> ErrorValues + Sync,
    without: impl Fn(&ErrorValues) -> ErrorValues + Sync,
) -> Result<Share<T>, Error> {
    let alone_mm = judge.once(&|values, _| alone(values))?;
    let without_mm = judge.once(&|values, _| without(values))?;
    Ok(Share { of, alone_mm, without_mm })
}

/// The errors that pass the filter, the others zero.
fn only(values: &ErrorValues, keep: impl Fn(ErrorIndex) -> bool) -> ErrorValues {
    let mut kept = ErrorValues::default();
    for index in ErrorIndex::all() {
        if keep(index) {
            kept.set(index, values.get(index));
        }
    }
    kept
}
