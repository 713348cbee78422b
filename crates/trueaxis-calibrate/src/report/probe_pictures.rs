//! Pictures of the calibration of a probe.

use super::probe::{is_chosen, size_words, um};
use crate::identify::probe::{Calibration, LobingModel, Score, Stylus};
use std::f64::consts::TAU;
use trueaxis_geometry::Vec3;
use trueaxis_report::{Band, Picture, Polar, PolarLine, Scatter};

/// Points of a smooth curve around.
const AROUND: usize = 360;

/// Measured and corrected deviations around.
pub(super) fn hits_picture(found: &Calibration, stylus: &Stylus) -> Picture {
    let around = |deviations: &dyn Fn(usize) -> f64| {
        let angle = |i: usize| stylus.hits[i].direction.y.atan2(stylus.hits[i].direction.x);
        let mut points: Vec<(f64, f64)> =
            (0..stylus.hits.len()).map(|i| (angle(i).rem_euclid(TAU), deviations(i))).collect();
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        points.extend(points.first().copied());
        points
    };
    let mean = found.before.mean_mm;
    let turned = found.orientations_rad.first().copied().unwrap_or(0.0);
    let model = (0..=AROUND).map(|i| {
        let angle = TAU * i as f64 / AROUND as f64;
        let direction = Vec3::new(angle.cos(), angle.sin(), 0.0);
        let row = found.deviation(direction, turned);
        (angle, um(row.deviation_mm - mean))
    });
    let line = |label: &str, colour, points| PolarLine { label: label.to_owned(), colour, points };
    Picture::Polar(Polar {
        title: format!("Stylus `{}`: before and after", found.stylus),
        note: format!(
            "Deviation along the direction of motion. The mean of {:.2} µm is left out of measured hits \
             and model.",
            um(mean)
        ),
        lines: vec![
            line("measured", 1, around(&|i| um(found.before_mm[i] - mean))),
            line("model", 0, model.collect()),
            line("corrected, held out", 2, around(&|i| um(found.fit.held_out_mm[i]))),
        ],
    })
}

/// The pre-travel at some latitudes.
pub(super) fn latitudes_picture(found: &Calibration) -> Picture {
    let mean = found.fit.coefficients_mm.first().copied().unwrap_or(0.0);
    let lines = [0.0_f64, -30.0, -60.0].into_iter().enumerate().filter_map(|(colour, latitude)| {
        let (s, c) = latitude.to_radians().sin_cos();
        let at = |angle: f64| Vec3::new(c * angle.cos(), c * angle.sin(), s);
        if !found.reaches(at(0.0)) {
            return None;
        }
        let points = (0..=AROUND).map(|i| {
            let angle = TAU * i as f64 / AROUND as f64;
            (angle, um(found.fit.travel_mm(at(angle)) - mean))
        });
        let label = format!("motion rises by {latitude:.0}°");
        Some(PolarLine { label, colour, points: points.collect() })
    });
    Picture::Polar(Polar {
        title: format!("Stylus `{}`: pre-travel by direction", found.stylus),
        note: format!("As the probe sees it; the constant of {:.2} µm is left out.", um(mean)),
        lines: lines.collect(),
    })
}

pub(super) fn scores_picture(found: &Calibration) -> Picture {
    let band = |label: &str, colour, of: fn(&Score) -> f64| {
        let asked = |s: &&Score| s.model == found.fit.lobing.model;
        let points = found.scores.iter().filter(asked).map(|s| (s.size as f64, um(of(s))));
        let points: Vec<(f64, f64)> = points.collect();
        let line = points.iter().map(|p| (p.0, p.1, 0.0)).collect();
        Band { label: label.to_owned(), colour, line, points }
    };
    let chosen = found.scores.iter().find(|s| is_chosen(found, s)).map(size_words);
    let size = match found.fit.lobing.model {
        LobingModel::Fourier => "highest harmonic",
        LobingModel::Spline => "knots",
    };
    Picture::Scatter(Scatter {
        title: format!("Stylus `{}`: how large a model the hits support", found.stylus),
        note: format!(
            "Chosen: {}, the smallest that predicts directions it has not seen as well as the best.",
            chosen.unwrap_or_default()
        ),
        x: size.to_owned(),
        y: "rms, µm".to_owned(),
        from_zero: true,
        bands: vec![
            band("in sample", 0, |s| s.in_sample_mm),
            band("held out", 1, |s| s.held_out_mm),
        ],
        dashed: Vec::new(),
    })
}
