//! Hits as tables: x, y, z and a direction, or the paper's angle and radius.

use super::check::MOST_HITS;
use super::fit::rough_centre;
use super::hit::{Gauge, GaugeKind, Hit, Side};
use trueaxis_geometry::Vec3;
use trueaxis_input::sheet::{Cells, Column, Sheet, heading};
use trueaxis_input::{Diagnostics, Dimension};

/// What the control writes down.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Reading {
    /// The spindle at the trigger.
    Spindle,
    /// The point that the control takes for touched: the ball radius is in it.
    Point,
}

impl Reading {
    /// All with their names in files.
    pub const ALL: [(Self, &'static str); 2] = [(Self::Spindle, "spindle"), (Self::Point, "point")];
}

/// What is known about the rows of a table.
#[derive(Debug, Clone, Copy)]
pub struct Setup<'a> {
    /// What was touched.
    pub gauge: &'a Gauge,
    /// Of the stylus ball, mm.
    pub ball_radius_mm: f64,
    /// What the control writes down.
    pub reading: Reading,
    /// How far the spindle is turned unless the table says so, rad.
    pub orientation_rad: f64,
    /// Whether directions may be taken from the positions: only on the gauge itself.
    pub on_gauge: bool,
}

const COLUMNS: [&str; 9] = ["angle", "radius", "x", "y", "z", "i", "j", "k", "orientation"];
const FORMS: &str = "x_mm,y_mm (z_mm on a sphere) with angle_deg or i,j,k, or angle_deg,radius_mm; \
                     orientation_deg where the spindle turns";

/// Reads a table of hits; `None` with errors among the problems.
pub fn parse_hits(
    file: &str,
    text: &str,
    setup: &Setup<'_>,
    problems: &mut Diagnostics,
) -> Option<Vec<Hit>> {
    let known = |name: &str| {
        let known = COLUMNS.contains(&name) || COLUMNS.contains(&heading(name).0);
        if known { Cells::Numbers } else { Cells::Unused }
    };
    let sheet = Sheet::parse(file, text, known, problems)?;
    for column in sheet.columns.iter().filter(|c| c.cells == Cells::Unused) {
        let message = format!("`{}` is not used", column.name);
        problems.warn("unused-column", column.place.clone(), message, FORMS);
    }
    if sheet.rows() > MOST_HITS {
        let message = format!("{} hits are more than {MOST_HITS}", sheet.rows());
        problems.error("too-many-hits", sheet.headings_place(), message, "thin them");
        return None;
    }
    let orientations = match sheet.about("orientation") {
        Some(column) => sheet.inner(column, Dimension::Angle, problems)?,
        None => vec![setup.orientation_rad; sheet.rows()],
    };
    let places = match sheet.about("radius") {
        Some(column) => radial(&sheet, column, setup, problems)?,
        None => spatial(&sheet, setup, problems)?,
    };
    let rows = places.into_iter().zip(orientations).enumerate();
    let hits = rows.map(|(row, ((spindle_mm, direction), orientation_rad))| Hit {
        spindle_mm,
        direction,
        orientation_rad,
        place: sheet.row_place(row),
    });
    Some(hits.collect())
}

fn missing(sheet: &Sheet, what: &str, problems: &mut Diagnostics) {
    let message = format!("the table has no column `{what}`");
    problems.error("missing-column", sheet.headings_place(), message, FORMS);
}

/// Angle and measured radius: the control has put the ball radius on, and counts from the centre.
fn radial(
    sheet: &Sheet,
    radius: &Column,
    setup: &Setup<'_>,
    problems: &mut Diagnostics,
) -> Option<Vec<(Vec3, Vec3)>> {
    if setup.gauge.kind == GaugeKind::Sphere || !setup.on_gauge {
        let message = "a radius is no place in space".to_owned();
        problems.error("missing-column", radius.place.clone(), message, FORMS);
        return None;
    }
    let Some(angle) = sheet.about("angle") else {
        missing(sheet, "angle_deg", problems);
        return None;
    };
    let near = |values: &[f64]| {
        let count = values.iter().filter(|v| (**v - setup.gauge.radius_mm).abs() < 1.0).count();
        2 * count > values.len()
    };
    if near(&angle.values) && !near(&radius.values) {
        let message = format!(
            "the numbers under `{}` are as large as the radius of the gauge, those under `{}` are not",
            angle.name, radius.name
        );
        let hint = "are these two columns swapped?";
        problems.error("swapped-columns", angle.place.clone(), message, hint);
        return None;
    }
    let radii = sheet.inner(radius, Dimension::Length, problems)?;
    let angles = sheet.inner(angle, Dimension::Angle, problems)?;
    let negative: Vec<usize> = (0..radii.len()).filter(|i| radii[*i] <= 0.0).collect();
    for row in negative.iter().take(20) {
        let message = format!("the measured radius {:.4} mm is not positive", radii[*row]);
        let hint = "a radius counts outwards from the centre in every direction; the sign belongs to \
                    the angle";
        problems.error("negative-radius", sheet.row_place(*row), message, hint);
    }
    let centre = setup.gauge.centre_mm.unwrap_or_default();
    let place = |(angle, radius): (&f64, &f64)| {
        let direction = Vec3::new(angle.cos(), angle.sin(), 0.0);
        let point = centre + direction * (radius * setup.gauge.side.sign());
        (point - direction * setup.ball_radius_mm, direction)
    };
    negative.is_empty().then(|| angles.iter().zip(&radii).map(place).collect())
}

fn spatial(
    sheet: &Sheet,
    setup: &Setup<'_>,
    problems: &mut Diagnostics,
) -> Option<Vec<(Vec3, Vec3)>> {
    let solid = setup.gauge.kind == GaugeKind::Sphere;
    let mut positions = vec![Vec3::zeros(); sheet.rows()];
    for (axis, name) in ["x", "y", "z"].into_iter().enumerate() {
        match sheet.about(name) {
            Some(column) => {
                let values = sheet.inner(column, Dimension::Length, problems)?;
                // A ring says nothing along its axis.
                let counts = axis < 2 || solid || !setup.on_gauge;
                let set = |(p, v): (&mut Vec3, f64)| p[axis] = if counts { v } else { 0.0 };
                positions.iter_mut().zip(values).for_each(set);
            }
            None if axis == 2 && !solid => {}
            None => {
                missing(sheet, &format!("{name}_mm"), problems);
                return None;
            }
        }
    }
    let directions = match directions(sheet, problems) {
        Some(Stated::Directions(all)) => all,
        Some(Stated::None) if setup.on_gauge => from_centre(&positions, setup, sheet, problems)?,
        Some(Stated::None) => {
            let message = "the directions of motion are missing".to_owned();
            let hint =
                "angle_deg or i,j,k: the surface is not known, so the direction is not either";
            problems.error("missing-column", sheet.headings_place(), message, hint);
            return None;
        }
        None => return None,
    };
    let back = match setup.reading {
        Reading::Spindle => 0.0,
        Reading::Point => setup.ball_radius_mm,
    };
    Some(positions.iter().zip(directions).map(|(p, u)| (p - u * back, u)).collect())
}

enum Stated {
    Directions(Vec<Vec3>),
    None,
}

fn directions(sheet: &Sheet, problems: &mut Diagnostics) -> Option<Stated> {
    if let Some(angle) = sheet.about("angle") {
        let angles = sheet.inner(angle, Dimension::Angle, problems)?;
        let all = angles.iter().map(|a| Vec3::new(a.cos(), a.sin(), 0.0));
        return Some(Stated::Directions(all.collect()));
    }
    let parts = ["i", "j", "k"].map(|name| sheet.columns.iter().find(|c| c.name == name));
    let [Some(i), Some(j), Some(k)] = parts else {
        if parts.iter().any(Option::is_some) {
            missing(sheet, "i`, `j` or `k", problems);
            return None;
        }
        return Some(Stated::None);
    };
    let mut all = Vec::with_capacity(sheet.rows());
    for row in 0..sheet.rows() {
        let u = Vec3::new(i.values[row], j.values[row], k.values[row]);
        let norm = u.norm();
        if !(norm - 1.0).abs().le(&1e-3) {
            let message = format!("the direction has length {norm:.4}, not 1");
            let hint = "i, j, k is the unit vector of the motion towards the surface";
            problems.error("not-a-direction", sheet.row_place(row), message, hint);
            return None;
        }
        all.push(u / norm);
    }
    Some(Stated::Directions(all))
}

/// Hits go through the centre unless they say otherwise.
fn from_centre(
    positions: &[Vec3],
    setup: &Setup<'_>,
    sheet: &Sheet,
    problems: &mut Diagnostics,
) -> Option<Vec<Vec3>> {
    let gauge = setup.gauge;
    let centre = gauge.centre_mm.or_else(|| rough_centre(positions, gauge.dimensions()));
    let outwards = match gauge.side {
        Side::Inside => 1.0,
        Side::Outside => -1.0,
    };
    let direction = |p: &Vec3| centre.and_then(|c| (p - c).try_normalize(1e-6));
    let all: Option<Vec<Vec3>> =
        positions.iter().map(|p| direction(p).map(|u| u * outwards)).collect();
    if all.is_none() {
        let message = "the directions of motion cannot be derived from the positions".to_owned();
        let hint = "add a column angle_deg (or i,j,k), or hits all around";
        problems.error("missing-column", sheet.headings_place(), message, hint);
    }
    all
}
