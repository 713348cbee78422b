//! The prediction by all errors as a machine file with its covariance: for compensation, where no single error can be
//! named.
//!
//! ```text
//!     C = σ² (N + σ² Λ)⁻¹      E(q) = Σ_k x̂_k φ_k(q),   u²(pose) = Σ_j |∂pose/∂E Σ_k L_kj φ_k(q)|²,   L Lᵀ = C
//!                                                                                  docs/model.md eq. 310
//! ```

use super::covariance_file::head;
use super::errors::Identification;
use super::machine_file::{MachineFile, largest_u, measured_of, one_line, origin, stated_in};
use super::predictor::Predictor;
use super::records::Records;
use super::score::Rms;
use std::collections::BTreeMap;
use std::fmt::Write as _;
use trueaxis_input::{Diagnostics, Place};
use trueaxis_machine::Machine;
use trueaxis_machine::axis::AxisKind;
use trueaxis_machine::describe::lines::Lines;
use trueaxis_machine::describe::replacement::{
    Entry, NewTables, curve_text_by, keep_table_temperatures, machine_of_text, put, quoted,
    take_out_of_table,
};
use trueaxis_machine::errors::{Curve, ErrorKind, ErrorName, Harmonic, StatedError};
use trueaxis_machine::file::Tables;
use trueaxis_measure::measure::Campaign;
use trueaxis_measure::unknowns::term::{Basis, Term, stated};

/// What is written on every line of it.
const NOT_ALONE: &str = "single values are not identified";

/// A machine file and the file of its covariance.
#[derive(Debug, Clone, PartialEq)]
pub struct PredictorFile {
    /// The machine file, and tables that it names.
    pub machine: MachineFile,
    /// The covariance.
    pub covariance: String,
}

/// A prediction that was made for one error, with what the machine file stated of it before.
struct Predicted {
    terms: Vec<(usize, Term)>,
    before: Option<StatedError>,
}

/// Whether the prediction may be used: it must be better than none on places that were held out.
pub fn judge(found: &Identification, campaign: &Place, problems: &mut Diagnostics) {
    let Some(predictor) = &found.adequacy.predictor else {
        let message = "there is no prediction by all errors".to_owned();
        let hint = "the readings say too little: measure at more poses";
        problems.error("prediction-worse", campaign.clone(), message, hint);
        return;
    };
    let before = &found.score.before;
    let axes = found.design.machine.axes();
    for held in &predictor.held_out {
        if held.predicted.noise < before.noise {
            continue;
        }
        let where_it_is = match held.axis {
            None => "places that were held out".to_owned(),
            Some(axis) => format!("angles of {} that were held out", axes[axis].name),
        };
        let message = format!(
            "{where_it_is} are predicted to {}, and without any compensation the readings differ by {}",
            words(&held.predicted),
            words(before)
        );
        let place = campaign.clone();
        match held.axis {
            None => {
                let hint = "compensation by this prediction would make the machine worse; measure at more places";
                problems.error("prediction-worse", place, message, hint);
            }
            Some(_) => {
                let hint =
                    "use it between the angles that were measured only, or measure at more of them";
                problems.warn("prediction-worse", place, message, hint);
            }
        }
    }
    if predictor.held_out.iter().all(|held| held.axis.is_some()) {
        let message = "no places were held out: it is not known how well others are predicted";
        let hint = "the score needs two places or more, and 3000 readings or fewer";
        problems.warn("prediction-not-scored", campaign.clone(), message.to_owned(), hint);
    }
}

fn words(rms: &Rms) -> String {
    let length = rms.length_mm.map(|v| format!("{:.1} um", v * 1e3));
    let angle = rms.angle_rad.map(|v| format!("{:.1} urad", v * 1e6));
    length.into_iter().chain(angle).collect::<Vec<_>>().join(", ")
}

/// Puts all errors of the prediction into the text of the machine file, and names the file of their covariance.
///
/// # Errors
/// In words, why the file cannot be edited.
pub fn predictor_file(
    (campaign, found): (&Campaign, &Identification),
    (records, date): (&Records, Option<&str>),
    (old, covariance_name): (&str, &str),
    beside: &dyn Tables,
) -> Result<PredictorFile, String> {
    let none = || "there is no prediction by all errors".to_owned();
    let predictor = found.adequacy.predictor.as_ref().ok_or_else(none)?;
    let origin = format!("prediction by all errors, {NOT_ALONE}; {}", origin(campaign, date));
    let errors = errors(campaign, predictor);
    let (mut file, mut tables) = (Lines::of(old), Vec::new());
    for (name, predicted) in &errors {
        let measured = measured_of(&campaign.machine, *name, &origin);
        let entry = entry((found, predictor), (*name, predicted), &measured, &mut tables)?;
        take_out_of_table(&mut file, *name, &origin, &mut tables, beside);
        put(&mut file, *name, &entry, &origin);
    }
    name_covariance(&mut file, &origin, &scored_words(found, predictor), covariance_name);
    let covariance = covariance_text((campaign, found, predictor), (records, date), &errors);
    let made = [&tables[..], &[(covariance_name.to_owned(), covariance.clone())]].concat();
    keep_table_temperatures(&mut file, old, &made, beside, &origin)?;
    let text = file.text();
    let read = machine_of_text(&text, &NewTables::of(&made, beside))?;
    if read.joint().is_none() {
        return Err("its covariance would not be read".to_owned());
    }
    Ok(PredictorFile { machine: MachineFile { text, tables }, covariance })
}

/// Every error with its terms; those that were unknown and have none are in it without any.
fn errors(campaign: &Campaign, predictor: &Predictor) -> BTreeMap<ErrorName, Predicted> {
    let design = &predictor.design;
    let before = |error: ErrorName| stated_in(&design.machine, error).cloned();
    let new = |error| Predicted { terms: Vec::new(), before: before(error) };
    let mut all: BTreeMap<ErrorName, Predicted> = BTreeMap::new();
    for term in campaign.terms.iter().filter(|t| is_made(t)) {
        all.entry(term.error).or_insert_with(|| new(term.error));
    }
    for (k, term) in design.terms.iter().enumerate() {
        if is_made(term) && predictor.covariance[(k, k)] > 0.0 {
            all.entry(term.error).or_insert_with(|| new(term.error)).terms.push((k, *term));
        }
    }
    all
}

/// Whether a machine file can state it: neither the servo nor a drift in time.
fn is_made(term: &Term) -> bool {
    !term.basis.is_servo() && !matches!(term.basis, Basis::Ramp { .. })
}

fn entry(
    (found, predictor): (&Identification, &Predictor),
    (name, predicted): (ErrorName, &Predicted),
    measured: &str,
    tables: &mut Vec<(String, String)>,
) -> Result<Entry, String> {
    let terms = &predicted.terms;
    if terms.is_empty() {
        return Ok(Entry::Nothing("its size is 0 in the prediction".to_owned()));
    }
    let values: Vec<(Term, f64)> = terms.iter().map(|(k, t)| (*t, predictor.values[*k])).collect();
    let families = values.iter().map(|(t, _)| family(t.basis)).filter(|f| *f > 0);
    let of_one = families.clone().max() == families.min();
    let sum = match &predicted.before {
        None => of_one.then(|| stated(&values, None)),
        Some(before) => of_one.then(|| stated(&values, None)).and_then(|own| sum(before, own)),
    };
    let sum = sum.ok_or_else(|| {
        format!(
            "{name} is a table or a curve of another family, to which the prediction adds: one curve cannot state both; \
             list {name} among the unknown errors as a polynomial (linear axis) or fourier (rotary axis)"
        )
    })?;
    let u = largest_u(found.reach, &predictor.covariance, terms);
    if name.kind == ErrorKind::Location {
        let (scale, unit) = if name.component.is_rotation() { (1e6, "urad") } else { (1e3, "um") };
        let value = sum.at(0.0, 0.0).unwrap_or(0.0) * scale;
        return Ok(Entry::Value(format!("\"{value} ± {} {unit}\"", u * scale)));
    }
    let is_rotary = name.body.is_rotary();
    let exact = |v: f64| v.to_string();
    let curve = curve_text_by(exact, (name, is_rotary), &sum, u, tables);
    Ok(Entry::Value(curve + measured))
}

/// Functions that one curve can state together; 0: with all.
fn family(basis: Basis) -> u8 {
    match basis {
        Basis::Legendre { .. } => 1,
        Basis::Cosine(_) | Basis::Sine(_) => 2,
        Basis::Hat { .. } => 3,
        _ => 0,
    }
}

/// What was stated and what comes in addition, if one curve can state both.
fn sum(before: &StatedError, more: StatedError) -> Option<StatedError> {
    let mean = match (&before.mean, more.mean) {
        (Curve::Constant(c), Curve::Constant(more)) => Curve::Constant(c + more),
        (Curve::Constant(c), Curve::Polynomial { mut coefficients, origin, scale }) => {
            *coefficients.first_mut()? += c;
            Curve::Polynomial { coefficients, origin, scale }
        }
        (
            Curve::Polynomial { coefficients: old, origin: o, scale: s },
            Curve::Polynomial { coefficients, origin, scale },
        ) => {
            let old = in_other_argument(old, (origin - o) / s, scale / s);
            let n = old.len().max(coefficients.len());
            let at = |list: &[f64], k: usize| list.get(k).copied().unwrap_or(0.0);
            let coefficients = (0..n).map(|k| at(&old, k) + at(&coefficients, k)).collect();
            Curve::Polynomial { coefficients, origin, scale }
        }
        (Curve::Constant(c), Curve::Fourier { mean, terms }) => {
            Curve::Fourier { mean: mean + c, terms }
        }
        (Curve::Fourier { mean: old, terms: before }, Curve::Fourier { mean, mut terms }) => {
            for own in before {
                match terms.iter_mut().find(|h| h.order == own.order) {
                    Some(h) => {
                        h.cosine += own.cosine;
                        h.sine += own.sine;
                    }
                    None => terms.push(*own),
                }
            }
            Curve::Fourier { mean: mean + old, terms }
        }
        _ => return None,
    };
    let reversal = match (&before.reversal, more.reversal) {
        (Some(Curve::Constant(a)), Some(Curve::Constant(b))) => Some(Curve::Constant(a + b)),
        (None, reversal) => reversal,
        (Some(Curve::Constant(a)), None) => Some(Curve::Constant(*a)),
        _ => return None,
    };
    Some(StatedError { mean, reversal, ..StatedError::constant(0.0, None) })
}

/// The coefficients of Σ cₖ (a + b x)ᵏ in powers of x (Horner).
fn in_other_argument(coefficients: &[f64], a: f64, b: f64) -> Vec<f64> {
    coefficients.iter().rev().fold(Vec::new(), |sum: Vec<f64>, c| {
        let mut next = vec![0.0; sum.len() + 1];
        for (k, s) in sum.iter().enumerate() {
            next[k] += a * s;
            next[k + 1] += b * s;
        }
        next[0] += c;
        next
    })
}

/// Over which positions it was scored, and how well, one sentence each.
fn scored_words(found: &Identification, predictor: &Predictor) -> Vec<String> {
    let axes = found.design.machine.axes();
    let range = |i: usize| {
        let [low, high] = found.reach[i];
        let (by, unit) = shown(axes[i].kind);
        format!("{} {:.3} .. {:.3} {unit}", axes[i].name, low * by, high * by)
    };
    let ranges: Vec<String> = (0..axes.len()).map(range).collect();
    let mut lines = vec![format!("scored over {}", ranges.join(", "))];
    for held in &predictor.held_out {
        let what = match held.axis {
            None => format!("a part of the places, {} times", held.parts),
            Some(axis) => format!("one angle of {}, {} times", axes[axis].name, held.parts),
        };
        lines.push(format!("held out ({what}): predicted to {} rms", words(&held.predicted)));
    }
    lines.push(format!("without compensation: {} rms", words(&found.score.before)));
    lines
}

fn shown(kind: AxisKind) -> (f64, &'static str) {
    match kind {
        AxisKind::Linear => (1.0, "mm"),
        AxisKind::Rotary => (1f64.to_degrees(), "deg"),
    }
}

/// `[uncertainty] covariance = "FILE"`, with what is to be known of it.
fn name_covariance(file: &mut Lines, origin: &str, scored: &[String], name: &str) {
    let mut text = format!("# {}\n", one_line(origin));
    // Writing to a String cannot fail.
    for line in scored {
        let _ = writeln!(text, "# {line}");
    }
    let _ = write!(text, "covariance = {}", quoted(name));
    match file.key("uncertainty", "covariance") {
        Some(at) => file.replace(at, &text),
        None => file.add("uncertainty", &text),
    }
}

fn covariance_text(
    (campaign, found, predictor): (&Campaign, &Identification, &Predictor),
    (records, date): (&Records, Option<&str>),
    errors: &BTreeMap<ErrorName, Predicted>,
) -> String {
    let design = &predictor.design;
    let mut text = head(campaign, records, (&design.instruments, date));
    text += &scored_text(found, predictor);
    let terms = design.terms.len();
    let is_known = |k: &usize| {
        let is_drift = design.terms.get(*k).is_some_and(|t| matches!(t.basis, Basis::Ramp { .. }));
        predictor.covariance[(*k, *k)] > 0.0 && !is_drift
    };
    let rows: Vec<usize> = (0..design.unknowns()).filter(is_known).collect();
    let names = design.names();
    for (i, k) in rows.iter().enumerate() {
        let with = rows[..=i].iter().map(|j| format!("{:e}", predictor.covariance[(*k, *j)]));
        let _ = writeln!(
            text,
            "\n[[known]]\nof = {{ {} = 1.0 }}\nvalue = {:e}\nu = {:e}\ncovariance = [{}]",
            quoted(&names[*k]),
            predictor.values[*k],
            predictor.covariance[(*k, *k)].sqrt(),
            with.collect::<Vec<_>>().join(", ")
        );
    }
    text += "\n[function] # what each factor of an error is multiplied by\n";
    for (error, predicted) in errors {
        let functions = predicted.terms.iter().filter(|(k, _)| *k < terms);
        for (k, term) in functions {
            if let Some(function) = function_text(term, &design.machine) {
                let _ =
                    writeln!(text, "{} = {{ error = \"{error}\"{function} }}", quoted(&names[*k]));
            }
        }
        if let Some(before) = predicted.before.as_ref().filter(|_| !predicted.terms.is_empty()) {
            text += &before_text(*error, &before.mean);
        }
    }
    text
}

fn scored_text(found: &Identification, predictor: &Predictor) -> String {
    let mut text = "\n[scored] # residuals that remain, root mean square\n".to_owned();
    let number = |rms: &Rms| {
        let length = rms.length_mm.map(|v| format!("um = {}", v * 1e3));
        let angle = rms.angle_rad.map(|v| format!("urad = {}", v * 1e6));
        length.into_iter().chain(angle).collect::<Vec<_>>().join(", ")
    };
    let _ = writeln!(text, "without = {{ {} }}", number(&found.score.before));
    let axes = found.design.machine.axes();
    for held in &predictor.held_out {
        let what = held.axis.map_or("places".to_owned(), |axis| axes[axis].name.to_string());
        let rms = number(&held.predicted);
        let _ = writeln!(text, "held_out_{what} = {{ parts = {}, {rms} }}", held.parts);
    }
    for (i, axis) in axes.iter().enumerate() {
        let (by, unit) = shown(axis.kind);
        let [low, high] = found.reach[i].map(|q| q * by);
        let _ = writeln!(text, "{} = [\"{low} {unit}\", \"{high} {unit}\"]", axis.name);
    }
    text
}

/// The function of a term as keys; none if it has no part in the mean of the directions of approach.
fn function_text(term: &Term, machine: &Machine) -> Option<String> {
    let (by, unit) = term.axis.map_or((1.0, "mm"), |i| shown(machine.axes()[i].kind));
    match (term.basis, stated(&[(*term, 1.0)], None).mean) {
        (Basis::Constant, _) => Some(String::new()),
        (Basis::Cosine(order), _) => Some(format!(", cosine = {order}")),
        (Basis::Sine(order), _) => Some(format!(", sine = {order}")),
        (Basis::Hat { at, step }, _) => {
            Some(format!(", hat = \"{} {unit}\", step = \"{} {unit}\"", at * by, step * by))
        }
        (Basis::Legendre { .. }, Curve::Polynomial { coefficients, origin, scale }) => {
            Some(polynomial_text(&coefficients, [origin * by, scale * by], unit))
        }
        _ => None,
    }
}

fn polynomial_text(coefficients: &[f64], [origin, scale]: [f64; 2], unit: &str) -> String {
    format!(
        ", polynomial = {coefficients:?}, origin = \"{origin} {unit}\", scale = \"{scale} {unit}\""
    )
}

/// What the machine file stated before, which counts as known.
fn before_text(error: ErrorName, mean: &Curve) -> String {
    let (by, unit) = match error.body.is_rotary() {
        true => shown(AxisKind::Rotary),
        false => shown(AxisKind::Linear),
    };
    let line = |part: &str, keys: String| {
        format!("\"{error} as stated before{part}\" = {{ error = \"{error}\"{keys} }}\n")
    };
    match mean {
        Curve::Constant(c) => line("", format!(", value = {c:?}")),
        Curve::Polynomial { coefficients, origin, scale } => {
            let keys = polynomial_text(coefficients, [origin * by, scale * by], unit);
            line("", format!("{keys}, value = 1.0"))
        }
        Curve::Fourier { mean, terms } => {
            let harmonic = |h: &Harmonic| {
                let of = |key: &str, value: f64| {
                    let keys = format!(", {key} = {}, value = {value:?}", h.order);
                    line(&format!(", {key} {}", h.order), keys)
                };
                of("cosine", h.cosine) + &of("sine", h.sine)
            };
            line("", format!(", value = {mean:?}"))
                + &terms.iter().map(harmonic).collect::<String>()
        }
        Curve::Table { .. } => String::new(),
    }
}
