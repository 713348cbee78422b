//! Values and covariance of an identification as a file: a later campaign starts from it (`prior = "FILE"`).
//!
//! ```text
//!     g = F x̂,  V = b² F Λ⁺ Fᵀ     rows of F: unknowns that are seen alone, then combinations   docs/model.md eq. 206
//!     with F M Mᵀ Fᵀ for what the machine file states with an uncertainty, and F M alone        eq. 346
//! ```

use super::errors::Identification;
use super::records::Records;
use nalgebra::{DMatrix, DVector};
use std::fmt::Write as _;
use trueaxis_measure::instruments::Instrument;
use trueaxis_measure::instruments::instrument::SetupError;
use trueaxis_measure::measure::Campaign;
use trueaxis_measure::measure::prior::{nominal_mark, set_up};
use trueaxis_measure::unknowns::design::Unknown;

/// A share of a combination that is rounding, against its greatest.
const NOTHING: f64 = 1e-7;

/// The first words of the file.
pub const BEGINS: &str = "# values and covariance of trueaxis identify";

/// The file as text.
pub fn covariance_file(
    campaign: &Campaign,
    found: &Identification,
    records: &Records,
    date: Option<&str>,
) -> String {
    let mut text = head(campaign, records, (&found.design.instruments, date));
    let rows = lasting(found, rows(found));
    let values = &rows * DVector::from_column_slice(&found.fit.values);
    let covariance = &rows * &found.fit.covariance * rows.transpose();
    let stated = &found.adequacy.explained.stated;
    let moves: Vec<(&String, DVector<f64>)> =
        stated.iter().map(|(name, by)| (name, &rows * DVector::from_column_slice(by))).collect();
    let names = found.design.names();
    for (i, row) in rows.row_iter().enumerate() {
        let members = row.iter().zip(&names).filter(|(share, _)| **share != 0.0);
        let of: Vec<String> =
            members.map(|(share, name)| format!("{name:?} = {share:e}")).collect();
        let variances: Vec<String> = (0..=i).map(|j| format!("{:e}", covariance[(i, j)])).collect();
        let _ = writeln!(
            text,
            "\n[[known]]\nof = {{ {} }}\nvalue = {:e}\nu = {:e}\ncovariance = [{}]",
            of.join(", "),
            values[i],
            covariance[(i, i)].max(0.0).sqrt(),
            variances.join(", ")
        );
        let least = NOTHING * covariance[(i, i)].max(0.0).sqrt();
        let by = moves.iter().filter(|(_, by)| by[i].abs() > least);
        let by: Vec<String> = by.map(|(name, by)| format!("{name:?} = {:e}", by[i])).collect();
        if !by.is_empty() {
            let _ = writeln!(text, "stated = {{ {} }}", by.join(", "));
        }
    }
    text
}

/// Whose values they are, how the instruments stood, and which readings are in them.
pub(super) fn head(
    campaign: &Campaign,
    records: &Records,
    (instruments, date): (&[Instrument], Option<&str>),
) -> String {
    let machine = &campaign.machine;
    let mut text =
        format!("{BEGINS}: a later campaign starts from it with prior = \"THIS FILE\"\n");
    text += "# in mm, rad and s; `covariance`: with all before it, its own variance last\n\n";
    // Writing to a String cannot fail.
    let _ = writeln!(text, "[covariance]\nmachine = {:?}", machine.name());
    let _ =
        writeln!(text, "nominal = \"{}\"\ncampaign = {:?}", nominal_mark(machine), campaign.name);
    if let Some(date) = date {
        let _ = writeln!(text, "date = {date:?}");
    }
    for instrument in instruments {
        let _ = writeln!(text, "\n[setup.{:?}]", instrument.name);
        for (key, value) in set_up(instrument) {
            let _ = writeln!(text, "{key} = {value:?}");
        }
    }
    let before = campaign.stages.prior.iter().flat_map(|prior| &prior.readings);
    for (file, mark) in before.chain(&records.marks) {
        let _ = writeln!(text, "\n[[readings]]\nfile = {file:?}\nmark = \"{mark}\"");
    }
    text
}

/// Without what ends with the campaign: drifts, and the places that drifted. What remains of a normal distribution
/// needs nothing else than to leave their rows out.
fn lasting(found: &Identification, rows: DMatrix<f64>) -> DMatrix<f64> {
    let ends = |k: &usize| match found.design.unknown(*k) {
        Some(Unknown::Setup(instrument, unknown)) => {
            let drifts =
                |rate: fn(SetupError) -> bool| instrument.unknowns.iter().any(|u| rate(u.error));
            match unknown.error {
                SetupError::ReferencePoint(_) => drifts(|e| matches!(e, SetupError::Drift(_))),
                SetupError::Zero(_) => drifts(|e| e == SetupError::ZeroDrift),
                SetupError::ToolPoint(2) => drifts(|e| e == SetupError::ToolDrift),
                error => error.is_rate(),
            }
        }
        _ => false,
    };
    let ending: Vec<usize> = (0..rows.ncols()).filter(ends).collect();
    let lasts = |i: &usize| ending.iter().all(|k| rows[(*i, *k)] == 0.0);
    let kept: Vec<usize> = (0..rows.nrows()).filter(lasts).collect();
    rows.select_rows(&kept)
}

/// What is known: one row for each unknown that is seen alone, then combinations with few members.
fn rows(found: &Identification) -> DMatrix<f64> {
    let sight = &found.fit.sight;
    let mut rows = sight.scaled_seen_space().transpose();
    let n = rows.ncols();
    let alone = |k: &usize| sight.is_seen[*k];
    let order: Vec<usize> =
        (0..n).filter(alone).chain((0..n).filter(|k| !sight.is_seen[*k])).collect();
    let pivots = reduce(&mut rows, &order);
    for (mut row, pivot) in rows.row_iter_mut().zip(pivots) {
        let greatest = row.amax();
        for k in 0..n {
            let alone = sight.is_seen[pivot] && k != pivot;
            let share = row[k] * sight.column_length(k) / sight.column_length(pivot);
            row[k] = if alone || row[k].abs() < NOTHING * greatest { 0.0 } else { share };
        }
    }
    rows
}

/// Gauss and Jordan with the greatest pivot of each column in this order; the pivot of each row.
fn reduce(rows: &mut DMatrix<f64>, order: &[usize]) -> Vec<usize> {
    let mut pivots = Vec::new();
    for &k in order {
        let next = pivots.len();
        if next == rows.nrows() {
            break;
        }
        let size = |row: usize| rows[(row, k)].abs();
        let best = (next..rows.nrows()).max_by(|a, b| size(*a).total_cmp(&size(*b)));
        let Some(best) = best.filter(|b| size(*b) > 1e-4) else { continue };
        rows.swap_rows(next, best);
        let by = rows[(next, k)];
        rows.row_mut(next).unscale_mut(by);
        let own = rows.row(next).into_owned();
        for other in (0..rows.nrows()).filter(|r| *r != next) {
            let factor = rows[(other, k)];
            let mut target = rows.row_mut(other);
            target -= &own * factor;
        }
        pivots.push(k);
    }
    pivots
}
