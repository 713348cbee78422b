//! A form evaluation as a report.

use crate::form::{Criterion, Decision, Element, FormEvaluation, across};
use trueaxis_form::{Proof, Source};
use trueaxis_geometry::Vec3;
use trueaxis_report::numbers::fixed;
use trueaxis_report::{Band, Picture, Polar, PolarLine, Report, Scatter, Section, Standing, Table};

const UM: f64 = 1e3;
/// Finer than a picture can show.
const MOST_POINTS: usize = 3600;
/// More rows make no table.
const MOST_ROWS: usize = 2000;

/// A form evaluation with the name of its file and the remarks on its points.
pub struct FormShown<'a> {
    /// The evaluation.
    pub found: &'a FormEvaluation,
    /// The file of the points.
    pub file: &'a str,
    /// Warnings and notes, each as one text.
    pub remarks: &'a [String],
}

/// A form evaluation as a report.
pub fn form_report(shown: &FormShown<'_>) -> Report<'static> {
    let FormShown { found, file, remarks } = *shown;
    let element = found.fitted.element;
    let mut report = Report::new(format!("{} of {file}", capital(element.deviation_name())))
        .line(format!("{} points, {}", found.points_read, what(found)));
    if let Some(filter) = found.filter {
        report = report.line(filter.text());
    }
    if let Some(decision) = found.decision() {
        report = decided(report, found, decision);
    }
    report
        .section(Section::new("Form deviation").table(references(found)))
        .section(Section::new(format!("The least-squares {}", element.key())).table(values(found)))
        .section(Section::from(picture(found)))
        .section(Section::new("Contact points").table(contacts(found)))
        .section(Section::new("Remarks on the points").on_page().list(remarks.iter().cloned()))
        .section(Section::new("Deviations of the points").on_page().table(rows(found)))
}

fn capital(text: &str) -> String {
    let mut letters = text.chars();
    let first = letters.next().map(|c| c.to_uppercase().to_string()).unwrap_or_default();
    first + letters.as_str()
}

fn what(found: &FormEvaluation) -> &'static str {
    match (found.fitted.element, found.normal) {
        (Element::Line, Some(_)) => "a profile in a plane",
        (Element::Line, None) => "a line in space",
        (Element::Circle, Some(_)) if found.filter.is_none() => "a circle in a known plane",
        (Element::Circle, _) => "a circle in its own plane",
        _ => "in space",
    }
}

fn um(mm: f64) -> String {
    fixed(mm * UM, 2)
}

fn decided<'a>(report: Report<'a>, found: &FormEvaluation, decision: Decision) -> Report<'a> {
    let (standing, word) = match decision {
        Decision::Pass => (Standing::Good, "PASS"),
        Decision::Fail => (Standing::Bad, "FAIL"),
        Decision::Undecided => (Standing::Open, "UNDECIDED"),
    };
    let criterion = found.deciding().criterion;
    let u = found.expanded_mm(criterion).map_or("unknown".to_owned(), |u| format!("{} µm", um(u)));
    let sentence = format!(
        "{} {} µm ({}), U = {u}, tolerance {} µm (ISO 14253-1)",
        found.fitted.element.deviation_name(),
        um(found.form_mm()),
        criterion.key(),
        um(found.tolerance_mm.unwrap_or(0.0))
    );
    report.verdict(standing, word, sentence)
}

/// Form deviation, radius and proof by every reference element.
fn references(found: &FormEvaluation) -> Table {
    let element = found.fitted.element;
    let has_radius = element.criteria().contains(&Criterion::MinimumCircumscribed);
    let mut headings =
        vec!["reference element", "", "form deviation, µm", "U, µm", "noise adds, µm"];
    if has_radius {
        headings.push("radius, mm");
    }
    headings.push("proof");
    let mut table = Table::new(headings).note(note(found));
    for r in &found.fitted.references {
        let noise = found.noise.iter().find(|(c, _)| *c == r.criterion).map(|(_, n)| *n);
        let dash = || "–".to_owned();
        let mut cells = vec![
            r.criterion.name().to_owned(),
            r.criterion.key().to_owned(),
            um(r.form_mm()),
            found.expanded_mm(r.criterion).map_or_else(dash, um),
            noise.map_or_else(dash, |n| um(n.bias_mm)),
        ];
        if has_radius {
            cells.push(fixed(r.shape.radius_mm, 5));
        }
        cells.push(r.proof.map_or(String::new(), proof));
        match r.criterion == found.deciding().criterion {
            true => table = table.bold_row(cells),
            false => table.push(cells),
        }
    }
    table
}

fn note(found: &FormEvaluation) -> String {
    let from = match found.of_point {
        None => return "No U: state the standard uncertainty of a point.".to_owned(),
        Some(u) if u.source == Source::Stated => {
            format!("u of a point {} µm as stated", fixed(u.u_mm * UM, 3))
        }
        Some(u) => format!("u of a point {} µm from neighbouring points", fixed(u.u_mm * UM, 3)),
    };
    let filter = if found.filter.is_some() { ", after the filter" } else { "" };
    format!(
        "U = k u + what noise adds at most, by 400 draws of noise about the contact points ({from}{filter}); the form \
         deviation is not corrected for noise."
    )
}

/// How a result is proved, in words.
pub(super) fn proof(proof: Proof) -> String {
    match proof {
        Proof::Global => "no other is better".to_owned(),
        Proof::Bound(mm) => format!("no other is beyond {} µm", fixed(mm * UM, 4)),
        Proof::Local { starts, agreed } => {
            format!("optimality verified nearby, {agreed} of {starts} starts")
        }
        Proof::None => "not proved".to_owned(),
    }
}

/// The values of the least-squares element with U.
fn values(found: &FormEvaluation) -> Table {
    let shape = found.fitted.shape();
    let u = found.uncertainty;
    let k = u.map_or(2.0, |u| u.of_point.coverage);
    let axial = u.and_then(|u| u.of_axial).map_or(k, |a| a.coverage);
    let mut table = Table::new(["", "value", "U"]);
    let expanded = |u: Option<f64>, k: f64, digits: usize| match u {
        Some(u) if u.is_finite() => fixed(k * u, digits),
        _ => "–".to_owned(),
    };
    let name = match found.fitted.element {
        Element::Circle | Element::Sphere => "centre",
        Element::Cylinder | Element::Cone => "point of the axis",
        _ => "point",
    };
    for (i, axis) in ["X", "Y", "Z"].into_iter().enumerate() {
        let point_u = u.map(|u| u.point_mm[i]);
        let value = fixed(shape.point_mm[i], 5);
        table.push([format!("{name} {axis}, mm"), value, expanded(point_u, k, 5)]);
    }
    if shape.direction.norm() > 0.5 {
        for (i, axis) in ["X", "Y", "Z"].into_iter().enumerate() {
            let direction_u = u.map(|u| u.direction[i]);
            let value = fixed(shape.direction[i], 7);
            table.push([format!("direction {axis}"), value, expanded(direction_u, axial, 7)]);
        }
    }
    if let Some((tilt, letter)) = found.tilt() {
        let tilt_u = expanded(found.tilt_u_rad().map(f64::to_degrees), axial, 5);
        table.push([format!("tilt to {letter}, deg"), fixed(tilt.to_degrees(), 5), tilt_u]);
    }
    if shape.radius_mm > 0.0 {
        let radius_u = expanded(u.map(|u| u.radius_mm), k, 5);
        table.push(["radius, mm".to_owned(), fixed(shape.radius_mm, 5), radius_u]);
    }
    if found.fitted.element == Element::Cone {
        let angle_u = expanded(u.map(|u| u.half_angle_rad.to_degrees()), k, 5);
        let angle = fixed(shape.half_angle_rad.to_degrees(), 5);
        table.push(["half angle, deg".to_owned(), angle, angle_u]);
    }
    table.note(spread(found))
}

/// The scatter, and where U comes from.
fn spread(found: &FormEvaluation) -> String {
    let f = &found.fitted;
    let mut text = format!(
        "Standard deviation of the residuals {} µm, {} degrees of freedom.",
        fixed(f.residual_deviation_mm * UM, 3),
        f.degrees_of_freedom
    );
    if let Some((s, _)) = f.axial_deviation_mm {
        text += &format!(" Along the normal {} µm.", fixed(s * UM, 3));
    }
    if let Some(u) = found.uncertainty {
        let from = match u.of_point.source {
            Source::Stated => "the stated u of a point",
            Source::Scatter | Source::Neighbours => "the scatter of the points",
            Source::LargerScatter => "the scatter of the points, which is larger than the stated u",
        };
        text += &format!(" U = {:.2} u, from {from}.", u.of_point.coverage);
    }
    text
}

fn contacts(found: &FormEvaluation) -> Table {
    let reference = found.deciding();
    let deviations = found.deviations_mm();
    let mut table = Table::new(["point", "x, mm", "y, mm", "z, mm", "µm", "side", "weight"]).note(
        "These points hold the element. Their weights balance; each is how much the form deviation changes with the \
         point.",
    );
    for c in &reference.contacts {
        let p = found.points_mm[c.index];
        table.push([
            row_name(found, c.index),
            fixed(p.x, 4),
            fixed(p.y, 4),
            fixed(p.z, 4),
            um(deviations[c.index]),
            if c.is_outer { "outer" } else { "inner" }.to_owned(),
            fixed(c.weight, 3),
        ]);
    }
    table
}

/// `12 (line 14)`.
fn row_name(found: &FormEvaluation, index: usize) -> String {
    match found.lines.as_ref().and_then(|l| l.get(index)) {
        Some(line) => format!("{} (line {line})", index + 1),
        None => format!("{}", index + 1),
    }
}

fn rows(found: &FormEvaluation) -> Table {
    let deviations = found.deviations_mm();
    let table = Table::new(["point", "x, mm", "y, mm", "z, mm", "µm"]);
    let note = match deviations.len() > MOST_ROWS {
        true => format!("The first {MOST_ROWS} of {} points.", deviations.len()),
        false => String::new(),
    };
    let row = |(i, (p, d)): (usize, (&Vec3, &f64))| {
        [row_name(found, i), fixed(p.x, 4), fixed(p.y, 4), fixed(p.z, 4), um(*d)]
    };
    let all = found.points_mm.iter().zip(&deviations).take(MOST_ROWS);
    table.rows(all.enumerate().map(row)).note(note)
}

fn picture(found: &FormEvaluation) -> Picture {
    let deviations = found.deviations_mm();
    let reference = found.deciding();
    let shape = reference.shape;
    let step = deviations.len().div_ceil(MOST_POINTS).max(1);
    let title =
        format!("Deviations from the {} {}", reference.criterion.name(), shape.element.key());
    let (x, y) = across(&shape.direction);
    let angle = |p: &Vec3| {
        let v = p - shape.point_mm;
        v.dot(&y).atan2(v.dot(&x))
    };
    let all = || found.points_mm.iter().zip(&deviations).step_by(step);
    if shape.element == Element::Circle {
        let mut points: Vec<(f64, f64)> = all().map(|(p, d)| (angle(p), d * UM)).collect();
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        points.extend(points.first().copied().map(|(a, d)| (a + std::f64::consts::TAU, d)));
        let label = format!("{} {} µm", reference.criterion.key(), um(reference.form_mm()));
        let note = format!(
            "Solid circle: the reference element, radius {} mm. The angle 0 is to the right.",
            fixed(shape.radius_mm, 4)
        );
        return Picture::Polar(Polar {
            title,
            note,
            lines: vec![PolarLine { label, colour: 0, points }],
        });
    }
    let name = match shape.element {
        Element::Line => "along the line, mm",
        Element::Cylinder | Element::Cone => "angle about the axis, deg",
        _ => "number of the point",
    };
    let place = |i: usize, p: &Vec3| match shape.element {
        Element::Line => (p - shape.point_mm).dot(&shape.direction),
        Element::Cylinder | Element::Cone => angle(p).to_degrees(),
        _ => i as f64 + 1.0,
    };
    let points: Vec<(f64, f64)> =
        all().enumerate().map(|(i, (p, d))| (place(i * step, p), d * UM)).collect();
    let [low, high] = [reference.low_mm * UM, reference.high_mm * UM];
    let ends = points.iter().fold((f64::MAX, f64::MIN), |(l, h), p| (l.min(p.0), h.max(p.0)));
    let middle = 0.5 * (low + high);
    let zone = [ends.0, ends.1].map(|x| (x, middle, 0.5 * (high - low)));
    let bands = vec![
        Band { label: "zone".into(), colour: 1, line: zone.to_vec(), points: Vec::new() },
        Band { label: "points".into(), colour: 0, line: Vec::new(), points },
    ];
    let note =
        "The band is the zone between the two parallel elements that hold all points.".to_owned();
    let y = "deviation, µm".to_owned();
    Picture::Scatter(Scatter {
        title,
        note,
        x: name.to_owned(),
        y,
        from_zero: true,
        bands,
        dashed: Vec::new(),
    })
}
