//! The tables and pictures of drift, diagonals and error motions of rotary axes.

use super::evaluation::{Contents, cell};
use super::evaluation_positioning as positioning;
use crate::iso230_2::Quantity;
use crate::iso230_3::{Channel, Drift};
use crate::iso230_6::{DiagonalResult, Diagonals, SquarenessHint};
use crate::iso230_7::{ErrorMotion, Rotation};
use trueaxis_input::Dimension;
use trueaxis_report::{Band, Picture, Polar, PolarLine, Scatter, Table};

const UM: f64 = 1e3;
/// Finer than a picture can show.
const MOST_POINTS: usize = 2000;

/// Unit in text output, unit in JSON, factor from the inner unit.
pub(super) fn unit(channel: &Channel) -> (&'static str, &'static str, f64) {
    match channel.dimension {
        Dimension::Length => ("µm", "um", 1e3),
        Dimension::Angle => ("µrad", "urad", 1e6),
        _ => ("°C", "degC", 1.0),
    }
}

pub(super) fn drift(d: &Drift) -> Contents {
    let minutes = d.window_s / 60.0;
    let (first, largest) = (format!("first {minutes:.0} min"), format!("worst {minutes:.0} min"));
    let headings = ["channel", "unit", "range", &first, &largest, "from, min", "end − begin"];
    let table = Table::new(headings).rows(d.channels.iter().map(|c| {
        let (unit, _, scale) = unit(c);
        [
            c.name.clone(),
            unit.to_owned(),
            cell(Some(c.range), scale),
            cell(Some(c.first_window), scale),
            cell(Some(c.largest_window.0), scale),
            format!("{:.1}", c.largest_window.1 / 60.0),
            cell(Some(c.end), scale),
        ]
    }));
    let results = vec![("Range of every channel (ISO 230-3)".to_owned(), table)];
    let pictures = ["µm", "µrad", "°C"].into_iter().filter_map(|unit| drift_curves(d, unit));
    Contents { results, details: Vec::new(), pictures: pictures.collect() }
}

/// The channels of one unit over time; nothing if there is none.
fn drift_curves(d: &Drift, wanted: &str) -> Option<Picture> {
    let step = d.times_s.len().div_ceil(MOST_POINTS).max(1);
    let band = |(i, c): (usize, &Channel)| {
        let first = if wanted == "°C" { 0.0 } else { c.values[0] };
        let values = d.times_s.iter().zip(&c.values).step_by(step);
        let line = values.map(|(t, v)| (t / 60.0, (v - first) * unit(c).2, 0.0)).collect();
        Band { label: c.name.clone(), colour: i, line, points: Vec::new() }
    };
    let of_unit = d.channels.iter().filter(|c| unit(c).0 == wanted);
    let bands: Vec<Band> = of_unit.enumerate().map(band).collect();
    let title = if wanted == "°C" { "Temperatures" } else { "Drift from the beginning" };
    (!bands.is_empty()).then(|| {
        Picture::Scatter(Scatter {
            title: title.to_owned(),
            note: String::new(),
            x: "time, min".to_owned(),
            y: wanted.to_owned(),
            from_zero: wanted != "°C",
            bands,
            dashed: Vec::new(),
        })
    })
}

/// The quantities of ISO 230-6: the largest of all diagonals.
const OF_DIAGONALS: [(Quantity, &str, &str); 6] = [
    (Quantity::E, "E_d", "bidirectional systematic deviation"),
    (Quantity::EUp, "E_d_up", "systematic deviation, rising"),
    (Quantity::EDown, "E_d_down", "systematic deviation, falling"),
    (Quantity::R, "R_d", "bidirectional repeatability"),
    (Quantity::B, "B_d", "reversal value"),
    (Quantity::A, "A_d", "bidirectional accuracy"),
];

pub(super) fn diagonals(d: &Diagonals) -> Contents {
    use Quantity as Q;
    let largest = OF_DIAGONALS.map(|(quantity, key, title)| {
        [key.to_owned(), title.to_owned(), cell(d.largest(quantity), UM)]
    });
    let largest = Table::new(["ISO 230-6", "largest of all diagonals", "µm"]).rows(largest);
    let headings = ["diagonal", "A", "E", "E↑", "E↓", "M", "R", "B", "stretch, µm/m"];
    let each = Table::new(headings).rows(d.diagonals.iter().map(|one| {
        let values = [Q::A, Q::E, Q::EUp, Q::EDown, Q::M, Q::R, Q::B];
        let values = values.map(|q| cell(one.result.value(q), UM));
        let ends = (one.diagonal.name(), cell(one.stretch, 1e6));
        [ends.0].into_iter().chain(values).chain([ends.1]).collect::<Vec<_>>()
    }));
    let mut results = vec![
        ("Parameters of the volume".to_owned(), largest),
        ("Every diagonal, µm".to_owned(), each),
    ];
    if !d.squareness.is_empty() {
        let row = |hint: &SquarenessHint| {
            let from = if hint.of_body { "body diagonals" } else { "face diagonals" };
            [hint.axes.clone(), from.to_owned(), cell(Some(hint.closer_rad), 1e6)]
        };
        let table = Table::new(["axes", "from", "closer than 90°, µrad"])
            .rows(d.squareness.iter().map(row))
            .note(
                "An estimate: straightness, roll and pitch also change the length of a diagonal.",
            );
        results.push(("Squareness".to_owned(), table));
    }
    let picture = |one: &DiagonalResult| {
        let mut picture = positioning::scatter(&one.measurement, &one.result);
        picture.rename(&format!("Diagonal {}", one.diagonal.name()));
        picture
    };
    let pictures = d.diagonals.iter().map(picture).collect();
    Contents { results, details: Vec::new(), pictures }
}

pub(super) fn rotation(r: &Rotation) -> Contents {
    let title = format!("Error motions over {} revolutions", r.revolutions);
    let headings = ["ISO 230-7", "µm: total", "synchronous", "asynchronous", "once per revolution"];
    let row = |m: &ErrorMotion| {
        [
            m.sensitive.name(),
            cell(Some(m.total_mm), UM),
            cell(Some(m.synchronous_mm), UM),
            cell(m.asynchronous_mm, UM),
            cell(Some(m.fundamental_mm), UM),
        ]
    };
    let table = Table::new(headings).rows(r.motions.iter().map(row)).note(
        "radial: about the least-squares centre, without the once-per-revolution part; axial: with it",
    );
    let pictures = r.motions.iter().map(|m| error_motion(r, m)).collect();
    Contents { results: vec![(title, table)], details: Vec::new(), pictures }
}

fn error_motion(r: &Rotation, m: &ErrorMotion) -> Picture {
    let step = r.angles_rad.len().div_ceil(MOST_POINTS).max(1);
    let line = |k: usize, label: &str, colour| {
        let points = r.angles_rad.iter().zip(&m.profile_mm).step_by(step);
        let mut points: Vec<_> = points.map(|(a, p)| (*a, p[k] * UM)).collect();
        points.extend(points.first().copied());
        PolarLine { label: label.to_owned(), colour, points }
    };
    Picture::Polar(Polar {
        title: format!("Error motion, {}", m.sensitive.name()),
        note: "Mean over the revolutions, and the smallest and largest reading at each angle."
            .to_owned(),
        lines: vec![
            line(1, "smallest", 5),
            line(2, "largest", 1),
            line(0, "mean (synchronous)", 0),
        ],
    })
}
