//! The tables and pictures of drift, diagonals and error motions of rotary axes.

use super::evaluation::{Sheets, figure};
use super::evaluation_positioning as positioning;
use crate::Standard;
use crate::iso230_2::Quantity;
use crate::iso230_3::{Channel, Drift};
use crate::iso230_6::Diagonals;
use crate::iso230_7::{ErrorMotion, Rotation};
use trueaxis_input::Dimension;
use trueaxis_report::Block;
use trueaxis_report::{Band, Picture, Polar, PolarLine, Scatter};

const UM: f64 = 1e3;
/// Finer than a picture can show.
const MOST_POINTS: usize = 2000;

/// Unit for people, unit in JSON, factor from the inner unit.
pub(super) fn unit(channel: &Channel) -> (&'static str, &'static str, f64) {
    match channel.dimension {
        Dimension::Length => ("µm", "um", 1e3),
        Dimension::Angle => ("µrad", "urad", 1e6),
        _ => ("°C", "degC", 1.0),
    }
}

pub(super) fn drift_sheets(d: &Drift) -> Sheets {
    let minutes = d.window_s / 60.0;
    let first = format!("first {minutes:.0} min");
    let window = format!("worst {minutes:.0} min");
    let headings = ["channel", "unit", "range", &first, &window, "from, min", "end − begin"];
    let mut block = Block::new("Range of every channel (ISO 230-3)", "", &headings);
    for c in &d.channels {
        let (unit, _, scale) = unit(c);
        block.rows.push(vec![
            c.name.clone(),
            unit.to_owned(),
            figure(Some(c.range), scale),
            figure(Some(c.first_window), scale),
            figure(Some(c.largest_window.0), scale),
            format!("{:.1}", c.largest_window.1 / 60.0),
            figure(Some(c.end), scale),
        ]);
    }
    let mut pictures = Vec::new();
    for wanted in ["µm", "µrad", "°C"] {
        let step = d.times_s.len().div_ceil(MOST_POINTS).max(1);
        let of_unit = d.channels.iter().filter(|c| unit(c).0 == wanted);
        let band = |(i, c): (usize, &Channel)| {
            let first = if wanted == "°C" { 0.0 } else { c.values[0] };
            let values = d.times_s.iter().zip(&c.values).step_by(step);
            let line = values.map(|(t, v)| (t / 60.0, (v - first) * unit(c).2, 0.0)).collect();
            Band { label: c.name.clone(), colour: i, line, points: Vec::new() }
        };
        let bands: Vec<Band> = of_unit.enumerate().map(band).collect();
        if !bands.is_empty() {
            pictures.push(Picture::Scatter(Scatter {
                title: if wanted == "°C" { "Temperatures" } else { "Drift from the beginning" }
                    .into(),
                note: String::new(),
                x: "time, min".to_owned(),
                y: wanted.to_owned(),
                from_zero: wanted != "°C",
                bands,
                dashed: Vec::new(),
            }));
        }
    }
    Sheets { figures: vec![block], details: Vec::new(), pictures }
}

/// The figures of ISO 230-6: the largest of all diagonals.
const OF_DIAGONALS: [(Quantity, &str, &str); 6] = [
    (Quantity::E, "E_d", "bidirectional systematic deviation"),
    (Quantity::EUp, "E_d_up", "systematic deviation, rising"),
    (Quantity::EDown, "E_d_down", "systematic deviation, falling"),
    (Quantity::R, "R_d", "bidirectional repeatability"),
    (Quantity::B, "B_d", "reversal value"),
    (Quantity::A, "A_d", "bidirectional accuracy"),
];

pub(super) fn diagonal_sheets(d: &Diagonals) -> Sheets {
    let headings = ["ISO 230-6", "largest of all diagonals", "µm"];
    let mut largest = Block::new("Figures of the volume", "", &headings);
    for (quantity, key, title) in OF_DIAGONALS {
        let value = figure(d.largest(quantity), UM);
        largest.rows.push(vec![key.to_owned(), title.to_owned(), value]);
    }
    let headings = ["diagonal", "A", "E", "E↑", "E↓", "M", "R", "B", "stretch, µm/m"];
    let mut each = Block::new("Every diagonal, µm", "", &headings);
    for one in &d.diagonals {
        let value = |q| figure(one.result.value(q), UM);
        use Quantity as Q;
        let mut row = vec![one.diagonal.name()];
        row.extend([Q::A, Q::E, Q::EUp, Q::EDown, Q::M, Q::R, Q::B].map(value));
        row.push(figure(one.stretch, 1e6));
        each.rows.push(row);
    }
    let mut figures = vec![largest, each];
    if !d.squareness.is_empty() {
        let note = "A hint: straightness, roll and pitch lengthen diagonals too.";
        let headings = ["axes", "from", "closer than 90°, µrad"];
        let mut block = Block::new("Squareness", note, &headings);
        for hint in &d.squareness {
            let from = if hint.of_body { "body diagonals" } else { "face diagonals" };
            let angle = figure(Some(hint.closer_rad), 1e6);
            block.rows.push(vec![hint.axes.clone(), from.to_owned(), angle]);
        }
        figures.push(block);
    }
    let mut pictures = Vec::new();
    for one in &d.diagonals {
        let mut sheets = positioning::sheets(Standard::Iso230_2, &one.measurement, &one.result);
        sheets.pictures.truncate(1);
        for picture in &mut sheets.pictures {
            picture.rename(&format!("Diagonal {}", one.diagonal.name()));
        }
        pictures.append(&mut sheets.pictures);
    }
    Sheets { figures, details: Vec::new(), pictures }
}

pub(super) fn rotation_sheets(r: &Rotation) -> Sheets {
    let title = format!("Error motions over {} revolutions", r.revolutions);
    let note = "radial: about the least-squares centre, without the once-per-revolution part; \
                axial: with it";
    let headings = ["ISO 230-7", "µm: total", "synchronous", "asynchronous", "once per revolution"];
    let mut block = Block::new(&title, note, &headings);
    for m in &r.motions {
        block.rows.push(vec![
            m.sensitive.name(),
            figure(Some(m.total_mm), UM),
            figure(Some(m.synchronous_mm), UM),
            figure(m.asynchronous_mm, UM),
            figure(Some(m.fundamental_mm), UM),
        ]);
    }
    let step = r.angles_rad.len().div_ceil(MOST_POINTS).max(1);
    let picture = |m: &ErrorMotion| {
        let line = |k: usize, label: &str, colour| {
            let points = r.angles_rad.iter().zip(&m.profile_mm).step_by(step);
            let mut points: Vec<_> = points.map(|(a, p)| (*a, p[k] * UM)).collect();
            points.extend(points.first().copied());
            PolarLine { label: label.to_owned(), colour, points }
        };
        Picture::Polar(Polar {
            title: format!("Error motion, {}", m.sensitive.name()),
            note: "Mean over the revolutions, and the least and largest reading at each angle."
                .to_owned(),
            lines: vec![
                line(1, "least", 5),
                line(2, "largest", 1),
                line(0, "mean (synchronous)", 0),
            ],
        })
    };
    let pictures = r.motions.iter().map(picture).collect();
    Sheets { figures: vec![block], details: Vec::new(), pictures }
}
