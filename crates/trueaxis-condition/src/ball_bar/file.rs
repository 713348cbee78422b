//! The text of the machine file with the changes of a circle.

use super::changes::{Change, Part, Share, apply, is_straight};
use super::{BallBar, Written};
use std::collections::BTreeMap;
use std::fmt::Write as _;
use trueaxis_machine::Machine;
use trueaxis_machine::describe::lines::Lines;
use trueaxis_machine::describe::replacement::{
    Entry, NewTables, curve_text, machine_of_text, measured_and_closed, measured_in_place_of,
    plain, put, take_out_of_table,
};
use trueaxis_machine::errors::{
    Curve, ErrorIndex, ErrorName, Extrapolation, StatedError, Uncertainty,
};
use trueaxis_machine::file::Tables;
use trueaxis_standards::iso230_4::Cause;

/// A machine file that was made.
pub(super) struct Made {
    pub text: String,
    pub tables: Vec<(String, String)>,
    pub machine: Machine,
    pub written: Vec<Written>,
}

/// What an error of the file is changed by.
#[derive(Default)]
struct Of<'a> {
    index: Option<ErrorIndex>,
    /// Share, cause and value of the change.
    parts: Vec<(&'a Share, Cause)>,
}

pub(super) fn edit(
    machine: &Machine,
    (changes, values): (&[Change], &[f64]),
    unknown_mm: f64,
    bar: &BallBar<'_>,
    (old, beside): (&str, &dyn Tables),
    origin: &str,
) -> Result<Made, String> {
    let new = apply(machine, changes, values, bar);
    let mut by_name: BTreeMap<ErrorName, Of<'_>> = BTreeMap::new();
    for change in changes {
        for share in &change.shares {
            let of = by_name.entry(share.name).or_default();
            of.index = Some(share.index);
            of.parts.push((share, change.cause));
        }
    }
    let mut file = Lines::of(old);
    let mut tables = Vec::new();
    let mut written = Vec::new();
    for (name, of) in &by_name {
        let Some(index) = of.index else { continue };
        let stated =
            |m: &Machine| m.bodies()[index.body].stated(index.kind, index.component).cloned();
        let Some(now) = stated(&new) else { continue };
        let u = u_of(of, stated(machine).as_ref(), unknown_mm, bar);
        let text = match of.parts[0].0.part {
            Part::Constant => {
                let q = |v: f64| plain(v * 1e6);
                let value = now.at(0.0, 0.0).map_err(|fault| fault.to_string())?;
                format!("\"{} ± {} urad\"", q(value), q(u))
            }
            _ => motion_text(*name, &now, u, origin, &mut tables)?,
        };
        take_out_of_table(&mut file, *name, origin, &mut tables, beside);
        put(&mut file, *name, &Entry::Value(text.clone()), origin);
        let mut causes: Vec<Cause> = of.parts.iter().map(|(_, cause)| *cause).collect();
        causes.dedup();
        // Where it was measured is the same for all.
        let text = match text.split_once(", measured = ") {
            Some((value, _)) => format!("{value} }}"),
            None => text,
        };
        written.push(Written { name: *name, text, causes });
    }
    let text = file.text();
    let machine = machine_of_text(&text, &NewTables::of(&tables, beside))?;
    Ok(Made { text, tables, machine, written })
}

/// The standard uncertainty of an error with what a circle changed of it. Unit: mm or rad.
fn u_of(of: &Of<'_>, old: Option<&StatedError>, unknown_mm: f64, bar: &BallBar<'_>) -> f64 {
    let of_part = |(share, cause): &(&Share, Cause)| {
        let u = bar.u(*cause);
        match share.part {
            Part::Constant => u,
            // Of the slope at the end of the circle; a quarter of the mismatch over the diameter belongs to each radius.
            Part::Slope => (u * share.factor.abs()).hypot(unknown_mm),
            Part::Bow => u,
            Part::Reversal => 0.5 * u,
        }
    };
    let new = of.parts.iter().map(|p| of_part(p).powi(2)).sum::<f64>().sqrt();
    if of.parts.iter().any(|(share, _)| share.part == Part::Constant) {
        return new;
    }
    // What a circle does not see of a curve keeps the uncertainty that it had.
    let is_curved = |c: &Curve| match c {
        Curve::Constant(_) => false,
        Curve::Polynomial { coefficients, .. } => coefficients.len() > 2,
        _ => true,
    };
    let is_mean_kept = unknown_mm > 0.0 && of.parts.iter().any(|(s, _)| s.part == Part::Slope);
    let kept = old.filter(|o| is_mean_kept || is_curved(&o.mean)).map_or(0.0, |o| match &o.u {
        Some(Uncertainty::Constant(u)) => *u,
        Some(Uncertainty::Table(table)) => {
            table.knots().iter().map(|q| table.at(*q)).fold(0.0, f64::max)
        }
        None => 0.0,
    });
    new.hypot(kept)
}

/// An error motion in the form of the file, which holds at the temperature of the one that was changed; a table goes
/// into `tables`.
fn motion_text(
    name: ErrorName,
    stated: &StatedError,
    u: f64,
    origin: &str,
    tables: &mut Vec<(String, String)>,
) -> Result<String, String> {
    let measured = measured_and_closed(&measured_in_place_of(Some(stated), origin));
    let Curve::Table { spline, outside } = &stated.mean else {
        if matches!(stated.mean, Curve::Fourier { .. }) {
            return Err(format!(
                "{name} is a series of harmonics, which a linear axis does not have"
            ));
        }
        // Powers of the position in mm: a scale of 100 mm keeps their digits.
        let scaled = StatedError { mean: rescaled(&stated.mean, 100.0), ..stated.clone() };
        return Ok(curve_text(name, false, &scaled, u, tables) + &measured);
    };
    let file = format!("{name}-ball-bar.csv");
    let um = |v: f64| plain(v * 1e3);
    let both = stated.reversal.is_some();
    let mut table = format!("# {name}, {origin}\n");
    let _ = match both {
        true => writeln!(table, "position_mm,{name}_up_um,{name}_down_um"),
        false => writeln!(table, "position_mm,{name}_um"),
    };
    for q in spline.knots() {
        let at = |approach| stated.at(*q, approach).map_err(|fault| fault.to_string());
        // Writing into a text cannot fail.
        let _ = match both {
            true => writeln!(table, "{q},{},{}", um(at(1.0)?), um(at(-1.0)?)),
            false => writeln!(table, "{q},{}", um(at(0.0)?)),
        };
    }
    tables.push((file.clone(), table));
    let form = if is_straight(spline) { "linear" } else { "not-a-knot" };
    let outside = match outside {
        Extrapolation::Error => "error",
        Extrapolation::Clamp => "clamp",
        Extrapolation::Extend => "extend",
    };
    let u = plain(u * 1e3);
    Ok(format!(
        "{{ table = \"{file}\", interpolation = \"{form}\", outside = \"{outside}\", u = \"{u} um\"{measured}"
    ))
}

/// A polynomial about the same origin with another scale, where its own is that of a power of 1 mm.
fn rescaled(curve: &Curve, to: f64) -> Curve {
    match curve {
        Curve::Polynomial { coefficients, origin, scale } if *scale == 1.0 => {
            let mut power = 1.0;
            let mut scaled = Vec::new();
            for c in coefficients {
                scaled.push(c * power);
                power *= to;
            }
            Curve::Polynomial { coefficients: scaled, origin: *origin, scale: to }
        }
        other => other.clone(),
    }
}
