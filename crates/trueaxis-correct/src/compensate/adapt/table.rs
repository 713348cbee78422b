//! Points of a surface with their normals and what was measured along them.

use std::cmp::Ordering;
use std::collections::BTreeMap;
use trueaxis_geometry::Vec3;
use trueaxis_input::{CsvTable, Diagnostics, Dimension, Place, Unit};

/// Fewer points tell nothing about a surface.
const LEAST_POINTS: usize = 12;
/// No wall is so uneven: such a deviation is a slip of the unit, mm.
const LARGEST_DEVIATION_MM: f64 = 5.0;
/// No probe is so uncertain: such an uncertainty is a slip of the unit, mm.
const LARGEST_U_MM: f64 = 0.5;
/// The factor of U_um.
const COVERAGE: f64 = 2.0;
/// No part of such a machine is larger, mm.
const LARGEST_COORDINATE_MM: f64 = 1e5;
/// A normal whose length is off by more is reported.
const NORM_WARNING: f64 = 1e-4;
/// A normal whose length is off by more is none.
const NORM_ERROR: f64 = 0.05;
/// So many copies of rows are named one by one.
const MOST_COPIES_NAMED: usize = 3;

/// One place of a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SurfacePoint {
    /// The line of the table.
    pub line: u32,
    /// The number of the point there. Unit: 1.
    pub number: f64,
    /// On the nominal surface, in the workpiece frame.
    pub at_mm: Vec3,
    /// Out of the material, length 1.
    pub normal: Vec3,
    /// The real surface along the normal; positive where there is more material.
    pub deviation_mm: f64,
    /// Standard uncertainty of the deviation, mm, if the table states it.
    pub u_mm: Option<f64>,
}

impl SurfacePoint {
    /// All that its row says. −0 is 0.
    fn key(&self) -> [f64; 9] {
        let (at, n, u) = (self.at_mm, self.normal, self.u_mm.unwrap_or(0.0));
        [self.number, at.x, at.y, at.z, n.x, n.y, n.z, self.deviation_mm, u].map(|v| v + 0.0)
    }
}

/// Reads a table `point,x_mm,y_mm,z_mm,i,j,k,deviation_um`, with `U_um` (k = 2) or `u_um` (k = 1) if it is there.
///
/// ```
/// use trueaxis_correct::compensate::adapt::read_points;
/// use trueaxis_input::Diagnostics;
/// let mut rows = "point,x_mm,y_mm,z_mm,i,j,k,deviation_um\n".to_owned();
/// for k in 0..12 {
///     rows += &format!("{k},{k},0,0,0,0,1,12.5\n");
/// }
/// let mut problems = Diagnostics::new();
/// let points = read_points("table.csv", &rows, &mut problems).unwrap();
/// assert_eq!((points[2].line, points[2].deviation_mm), (4, 0.0125));
/// ```
pub fn read_points(
    file: &str,
    text: &str,
    problems: &mut Diagnostics,
) -> Option<Vec<SurfacePoint>> {
    let mut found = Diagnostics::new();
    let table = CsvTable::parse(file, text, &mut found);
    let points = if found.has_errors() { None } else { points_of(&table, &mut found) };
    let sound = !found.has_errors();
    problems.append(found);
    points.filter(|_| sound)
}

fn points_of(table: &CsvTable, problems: &mut Diagnostics) -> Option<Vec<SurfacePoint>> {
    let number = plain(table, "point", problems);
    let at = ["x", "y", "z"].map(|name| length(table, name, problems));
    let normal = ["i", "j", "k"].map(|name| plain(table, name, problems));
    let deviation = length(table, "deviation", problems);
    let u_mm = uncertainties(table, problems)?;
    let (number, deviation) = (number?, deviation?);
    let [Some(x), Some(y), Some(z)] = at else { return None };
    let [Some(i), Some(j), Some(k)] = normal else { return None };
    let mut points = Vec::with_capacity(table.rows());
    for row in 0..table.rows() {
        let place = table.row_place(row);
        let raw = Vec3::new(i[row], j[row], k[row]);
        let Some(normal) = checked_normal(raw, &place, problems) else { continue };
        let point = SurfacePoint {
            line: u32::try_from(place.line).unwrap_or(u32::MAX),
            number: number[row],
            at_mm: Vec3::new(x[row], y[row], z[row]),
            normal,
            deviation_mm: deviation[row],
            u_mm: u_mm.as_ref().and_then(|u| u.get(row)).copied(),
        };
        check_size(&point, place, problems);
        points.push(point);
    }
    let rows = points.len();
    let points = copies_once(points, &table.file, problems);
    // Rows that are wrong have their own errors.
    let different = table.rows() - (rows - points.len());
    if different < LEAST_POINTS {
        let message = format!("{different} points are no surface");
        let hint = format!("probe at least {LEAST_POINTS} places, all over what is cut");
        problems.error("too-few-points", Place::whole(&table.file), message, &hint);
    }
    check_sides(&points, &table.file, problems);
    Some(points)
}

/// The points without rows that are equal to an earlier one to the last digit. They would foretell each other without
/// error: no outlier would be seen, and U would shrink without a reading.
fn copies_once(
    points: Vec<SurfacePoint>,
    file: &str,
    problems: &mut Diagnostics,
) -> Vec<SurfacePoint> {
    let (all, mut copies) = (points.len(), 0);
    let mut first: BTreeMap<[u64; 9], u32> = BTreeMap::new();
    let mut once = Vec::with_capacity(all);
    let hint = "a reading that was taken again has a number of its own; delete copies";
    for point in points {
        let of = *first.entry(point.key().map(f64::to_bits)).or_insert(point.line);
        if of == point.line {
            once.push(point);
            continue;
        }
        copies += 1;
        if copies <= MOST_COPIES_NAMED {
            let place = Place { file: file.to_owned(), line: point.line as usize, column: 1 };
            let message = format!(
                "this row is that of line {of} again, to the last digit: the two count once"
            );
            problems.warn("copied-rows", place, message, hint);
        }
    }
    if copies > MOST_COPIES_NAMED {
        let message = format!("{copies} of {all} rows are copies in all");
        problems.warn("copied-rows", Place::whole(file), message, hint);
    }
    once
}

/// The places of the rows in the order of the numbers of their points (and of all else that they say, where these are equal),
/// whatever the order of the rows: by it points are added and thinned, so that a sorted table has the same answer to the last
/// bit.
pub(super) fn order_of_points(points: &[SurfacePoint]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..points.len()).collect();
    order.sort_by(|a, b| {
        let mut pairs = points[*a].key().into_iter().zip(points[*b].key());
        pairs
            .find_map(|(a, b)| Some(a.total_cmp(&b)).filter(|o| o.is_ne()))
            .unwrap_or(Ordering::Equal)
    });
    order
}

fn check_size(point: &SurfacePoint, place: Place, problems: &mut Diagnostics) {
    if point.deviation_mm.abs() > LARGEST_DEVIATION_MM {
        let message = format!("a deviation of {} mm is no form error", point.deviation_mm);
        let hint = "is the unit of the heading right (deviation_um, deviation_mm)?";
        problems.error("large-deviation", place, message, hint);
    } else if point.at_mm.amax() > LARGEST_COORDINATE_MM {
        let message = format!("{} mm from part zero is on no such machine", point.at_mm.amax());
        problems.error("far-point", place, message, "is the unit of the heading right?");
    }
}

fn checked_normal(raw: Vec3, place: &Place, problems: &mut Diagnostics) -> Option<Vec3> {
    let norm = raw.norm();
    if !(norm.is_finite() && (norm - 1.0).abs() <= NORM_ERROR) {
        let message = format!("the normal has the length {norm:.4}, not 1");
        let hint = "i, j, k is the unit vector out of the material at the nominal point";
        problems.error("bad-normal", place.clone(), message, hint);
        return None;
    }
    if (norm - 1.0).abs() > NORM_WARNING {
        let message = format!("the normal has the length {norm:.5}; it is taken as a direction");
        problems.warn("normal-not-unit", place.clone(), message, "write more digits of i, j, k");
    }
    Some(raw / norm)
}

/// A normal against all of its neighbours is a hit from the other side.
fn check_sides(points: &[SurfacePoint], file: &str, problems: &mut Diagnostics) {
    // Quadratic; longer tables are refused by the field anyway.
    if points.len() > super::field::MOST_POINTS {
        return;
    }
    for (index, point) in points.iter().enumerate() {
        let mut near: Vec<(f64, Vec3)> = points
            .iter()
            .enumerate()
            .filter(|(other, _)| *other != index)
            .map(|(_, o)| ((o.at_mm - point.at_mm).norm_squared(), o.normal))
            .collect();
        if near.len() < 6 {
            return;
        }
        near.select_nth_unstable_by(5, |a, b| a.0.total_cmp(&b.0));
        let sum: Vec3 = near[..6].iter().map(|n| n.1).sum();
        if sum.norm() > 3.0 && sum.dot(&point.normal) < 0.0 {
            let place = Place { file: file.to_owned(), line: point.line as usize, column: 1 };
            let message = "the normal points to the other side than those around it".to_owned();
            let hint = "i, j, k points out of the material; was the hit from the inside?";
            problems.error("wrong-side", place, message, hint);
        }
    }
}

fn plain(table: &CsvTable, name: &str, problems: &mut Diagnostics) -> Option<Vec<f64>> {
    match table.column(name) {
        Some(column) => Some(column.values.clone()),
        None => {
            missing(table, name, problems);
            None
        }
    }
}

fn missing(table: &CsvTable, name: &str, problems: &mut Diagnostics) {
    let names: Vec<&str> = table.columns.iter().take(30).map(|c| c.name.as_str()).collect();
    let message = format!("the table has no column `{name}`");
    let hint =
        format!("due: point,x_mm,y_mm,z_mm,i,j,k,deviation_um; there are: {}", names.join(","));
    problems.error("missing-column", Place::whole(&table.file), message, &hint);
}

/// Standard uncertainties, mm, if the table has a column of them; `None` with errors among the problems.
fn uncertainties(table: &CsvTable, problems: &mut Diagnostics) -> Option<Option<Vec<f64>>> {
    let stem = |full: &str| full.rsplit_once('_').map_or(full, |(stem, _)| stem).to_owned();
    let [expanded, standard] =
        ["U", "u"].map(|name| table.columns.iter().find(|c| stem(&c.name) == name));
    let (name, factor, column) = match (expanded, standard) {
        (None, None) => return Some(None),
        (Some(column), None) => ("U", COVERAGE, column),
        (None, Some(column)) => ("u", 1.0, column),
        (Some(_), Some(column)) => {
            let message = "both U (k = 2) and u (k = 1) are stated".to_owned();
            let hint = "keep one of the two columns";
            problems.error("two-uncertainties", column.place.clone(), message, hint);
            return None;
        }
    };
    let values = length(table, name, problems)?;
    let mut sound = true;
    for (row, value) in values.iter().enumerate() {
        let u_mm = value / factor;
        // NaN is no uncertainty either.
        if !(u_mm > 0.0 && u_mm <= LARGEST_U_MM) {
            let message = format!("`{}` of {value} mm is no uncertainty of a hit", column.name);
            let hint =
                "more than 0; is the unit of the heading right (U_um with k = 2, u_um with k = 1)?";
            problems.error("absurd-uncertainty", table.row_place(row), message, hint);
            sound = false;
        }
    }
    sound.then(|| Some(values.iter().map(|v| v / factor).collect()))
}

/// A column of lengths by what stands before the unit, in mm.
fn length(table: &CsvTable, name: &str, problems: &mut Diagnostics) -> Option<Vec<f64>> {
    let stem = |full: &str| full.rsplit_once('_').map_or(full, |(stem, _)| stem).to_owned();
    let Some(column) = table.columns.iter().find(|c| stem(&c.name) == name) else {
        missing(table, name, problems);
        return None;
    };
    let unit = column.name.rsplit_once('_').map_or("", |(_, unit)| unit);
    match Unit::find(unit, Dimension::Length) {
        Ok(unit) => table.in_unit(column, unit, problems),
        Err(error) => {
            let message = format!("column `{}`: {error}", column.name);
            problems.error(error.code(), column.place.clone(), message, &error.hint());
            None
        }
    }
}
