//! Pictures of a thermal model.

use crate::thermal::{Cycle, Score, ThermalModel};
use trueaxis_report::DrawingError;
use trueaxis_report::plots::{Curve, Labels, curves};

/// A curve of more points shows no more.
const MOST_POINTS: usize = 600;

/// The scores over the number of terms.
pub(super) fn scores_picture(model: &ThermalModel) -> Result<String, DrawingError> {
    let point = |s: &Score, of: fn(&Score) -> f64| (s.terms.len() as f64, of(s) * 1e3);
    let curve = |label: &str, of: fn(&Score) -> f64| Curve {
        label: label.to_owned(),
        // Without any term all three are the same, and so much that nothing else would be seen.
        points: model
            .scores
            .iter()
            .skip(1)
            .chain([&model.all_terms])
            .map(|s| point(s, of))
            .collect(),
    };
    let lines = [
        curve("in sample", |s| s.in_sample_mm),
        curve("single rows out", |s| s.row_wise_mm),
        curve("whole cycles out", |s| s.held_out_mm),
    ];
    curves(
        (1000, 320),
        &Labels { x: "number of terms, from 1; at the end all", y: "rms, µm" },
        &lines,
    )
}

/// The drift of a cycle, measured and predicted.
pub(super) fn cycle_picture(
    cycle: &Cycle,
    g: usize,
    model: &ThermalModel,
) -> Result<String, DrawingError> {
    let (x, scale) = match &cycle.times_s {
        Some(_) => ("time, min", 60.0),
        None => ("row", 1.0),
    };
    let at = |i: usize| cycle.times_s.as_ref().map_or(i as f64, |t| t[i]) / scale;
    let curve = |label: &str, values: &[f64]| Curve {
        label: label.to_owned(),
        points: (0..values.len())
            .step_by(values.len().div_ceil(MOST_POINTS).max(1))
            .map(|i| (at(i), values[i] * 1e3))
            .collect(),
    };
    let (measured, predicted) = (&model.measured_mm[g], &model.predicted_mm[g]);
    let left: Vec<f64> = measured.iter().zip(predicted).map(|(m, p)| m - p).collect();
    let lines =
        [curve("measured", measured), curve("predicted", predicted), curve("residual", &left)];
    curves((500, 300), &Labels { x, y: "µm" }, &lines)
}
