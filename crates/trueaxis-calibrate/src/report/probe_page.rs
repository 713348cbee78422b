//! The calibration of a probe as one self-contained page.

use super::probe::{
    form_words, gauge_words, harmonics, is_chosen, offset_words, scatter_words, size_words, um,
    verdict,
};
use crate::identify::probe::{Calibration, GaugeKind, LobingModel, Study, Stylus};
use maud::{Markup, html};
use std::f64::consts::TAU;
use trueaxis_geometry::Vec3;
use trueaxis_report::picture_page::{PicturePage, picture_page};
use trueaxis_report::{Band, Picture, Polar, PolarLine, Scatter};
use trueaxis_report::{Block, DrawingError};

/// Points of a smooth curve around.
const AROUND: usize = 360;
/// Directions of the table on the page.
const SHOWN: usize = 12;

/// The report as the text of an HTML file.
///
/// # Errors
/// What the drawing library says.
pub fn probe_html(study: &Study, all: &[Calibration]) -> Result<String, DrawingError> {
    let mut lines = Vec::new();
    let (mut blocks, mut pictures) = (Vec::new(), Vec::new());
    for (found, stylus) in all.iter().zip(&study.styli) {
        lines.push(format!("stylus `{}`: {}", found.stylus, gauge_words(found)));
        lines.extend([offset_words(found), scatter_words(found)]);
        lines.extend(found.form.as_ref().map(|form| form_words(found, form)));
        blocks.push(spreads(found));
        blocks.push(harmonics_block(found));
        match found.gauge.kind {
            GaugeKind::Ring => pictures.push(hits_picture(found, stylus)),
            GaugeKind::Sphere => pictures.push(latitudes_picture(found)),
        }
        pictures.push(scores_picture(found));
        blocks.push(table_block(found));
    }
    picture_page(&PicturePage {
        title: &study.name,
        lines: &lines,
        verdict: Some(verdicts(all)),
        blocks: &blocks,
        pictures: &pictures,
    })
}

fn verdicts(all: &[Calibration]) -> Markup {
    html! {
        @for found in all {
            section class="verdict pass" {
                strong { (format!("{:.2}\u{a0}µm", um(found.held_out.range_mm))) }
                span { (verdict(found)) }
            }
        }
    }
}

fn cells<const N: usize>(row: [String; N]) -> Vec<String> {
    row.into()
}

fn headings(names: &[&str]) -> Vec<String> {
    names.iter().map(|n| (*n).to_owned()).collect()
}

fn spreads(found: &Calibration) -> Block {
    let mut rows = Vec::new();
    let mut line = |name: &str, spread: &crate::identify::probe::Spread| {
        let number = |v: f64| format!("{:.3}", um(v));
        rows.push(cells([name.to_owned(), number(spread.range_mm), number(spread.rms_mm)]));
    };
    line("as measured", &found.before);
    line("offset alone taken off", &found.offset_only);
    line("corrected, hits of the calibration", &found.after);
    line("corrected, directions held out", &found.held_out);
    if let Some(check) = &found.check {
        line("fresh hits, as measured", &check.before);
        line("fresh hits, corrected", &check.after);
    }
    Block {
        title: format!("Stylus `{}`: deviations of the radius", found.stylus),
        headings: headings(&["µm", "range", "rms"]),
        rows,
        note: "",
    }
}

fn harmonics_block(found: &Calibration) -> Block {
    let row = |h: super::probe::Harmonic| {
        let order = match h.axial {
            0 => h.order.to_string(),
            p => format!("{} · (sin λ)^{p}", h.order),
        };
        let phase = match h.order {
            0 => "–".to_owned(),
            _ => format!("{:.2}", h.phase_rad().to_degrees()),
        };
        cells([order, format!("{:.3}", um(h.amplitude_mm())), format!("{:.3}", um(h.u_mm)), phase])
    };
    Block {
        title: format!("Stylus `{}`: pre-travel by direction", found.stylus),
        headings: headings(&["order", "amplitude, µm", "u, µm", "first lobe, deg"]),
        rows: harmonics(found).into_iter().map(row).collect(),
        note: "Directions of motion as the probe sees them. The first harmonic is the offset: no hit can \
               tell the two apart.",
    }
}

fn table_block(found: &Calibration) -> Block {
    let orientation = found.orientations_rad.first().copied().unwrap_or(0.0);
    let row = |r: crate::identify::probe::TableRow| {
        let (s, c) = r.direction_rad.sin_cos();
        let d = um(r.deviation_mm);
        cells([
            format!("{:.1}", r.direction_rad.to_degrees()),
            format!("{d:.2}"),
            format!("{:.2}", no_minus(d * c)),
            format!("{:.2}", no_minus(d * s)),
            format!("{:.2}", um(r.u_mm)),
        ])
    };
    Block {
        title: format!(
            "Stylus `{}`: direction table, spindle at {:.0} deg",
            found.stylus,
            orientation.to_degrees()
        ),
        headings: headings(&["direction, deg", "dR, µm", "dX, µm", "dY, µm", "u, µm"]),
        rows: found.table(SHOWN, orientation).into_iter().map(row).collect(),
        note: "Corrected point = measured point − dR along the direction of motion. All directions: --table.",
    }
}

/// No minus before what rounds to zero.
fn no_minus(um: f64) -> f64 {
    if um.abs() < 0.005 { 0.0 } else { um }
}

/// Measured and corrected deviations around.
fn hits_picture(found: &Calibration, stylus: &Stylus) -> Picture {
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
fn latitudes_picture(found: &Calibration) -> Picture {
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

fn scores_picture(found: &Calibration) -> Picture {
    let band = |label: &str, colour, of: fn(&crate::identify::probe::Score) -> f64| {
        let asked = |s: &&crate::identify::probe::Score| s.model == found.fit.lobing.model;
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
            "Chosen: {}, the smallest that foretells directions it has not seen as well as the best.",
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
