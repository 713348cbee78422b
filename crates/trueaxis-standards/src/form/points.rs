//! The table of points: two or three coordinates, or angles with radii.

use super::FormRequest;
use trueaxis_form::Element;
use trueaxis_geometry::Vec3;
use trueaxis_input::sheet::{Cells, Sheet, heading};
use trueaxis_input::{Diagnostics, Dimension};

pub(super) struct Points {
    pub points_mm: Vec<Vec3>,
    pub lines: Vec<usize>,
    /// The axis that has no column, or the constant one of a line.
    pub normal: Option<Vec3>,
}

const AXES: [&str; 3] = ["x", "y", "z"];
const FORM: &str =
    "x_mm,y_mm,z_mm (any unit of length; two of them lie in a plane), or angle_deg,radius_mm";

fn cells(name: &str) -> Cells {
    match heading(name).0 {
        "x" | "y" | "z" | "angle" | "radius" => Cells::Numbers,
        _ => Cells::Unused,
    }
}

pub(super) fn read(request: &FormRequest<'_>, problems: &mut Diagnostics) -> Option<Points> {
    let sheet = Sheet::parse(request.file, request.text, cells, problems)?;
    let sheet = sheet.with_copies_once(problems);
    let lines = (0..sheet.rows()).map(|row| sheet.row_place(row).line).collect();
    let mut points_mm = vec![Vec3::zeros(); sheet.rows()];
    let mut has = [false; 3];
    for (k, axis) in AXES.iter().enumerate() {
        let Some(column) = sheet.columns.iter().find(|c| c.role() == *axis || c.name == *axis)
        else {
            continue;
        };
        has[k] = true;
        let values = sheet.inner(column, Dimension::Length, problems)?;
        points_mm.iter_mut().zip(values).for_each(|(p, v)| p[k] = v);
    }
    let normal = |k: usize| Vec3::from_fn(|i, _| f64::from(u8::from(i == k)));
    let missing: Vec<usize> = (0..3).filter(|k| !has[*k]).collect();
    match missing[..] {
        [] => {
            let normal = constant(request, &points_mm, problems).map(normal);
            Some(Points { points_mm, lines, normal })
        }
        [k] => Some(Points { points_mm, lines, normal: Some(normal(k)) }),
        [_, _, _] => polar(&sheet, lines, problems),
        _ => {
            let message = "the points have one coordinate only".to_owned();
            let hint = format!("columns: {FORM}");
            problems.error("missing-column", sheet.headings_place(), message, &hint);
            None
        }
    }
}

/// The coordinate that is the same for all points of a line: it is a profile in a plane.
fn constant(
    request: &FormRequest<'_>,
    points_mm: &[Vec3],
    problems: &mut Diagnostics,
) -> Option<usize> {
    let first = points_mm.first().filter(|_| request.element == Element::Line)?;
    let same = |k: &usize| points_mm.iter().all(|p| p[*k] == first[*k]);
    let found: Vec<usize> = (0..3).filter(same).collect();
    let [k] = found[..] else { return None };
    let message = format!("{} is the same for all points: a profile in that plane", AXES[k]);
    let hint = "its form deviation is the distance of two lines, not the diameter of a cylinder";
    problems.note("form-plane", trueaxis_input::Place::whole(request.file), message, hint);
    Some(k)
}

/// Angles with radii, about the origin of the XY plane.
fn polar(sheet: &Sheet, lines: Vec<usize>, problems: &mut Diagnostics) -> Option<Points> {
    let column = |role: &str| sheet.columns.iter().find(|c| c.role() == role || c.name == role);
    let (Some(angle), Some(radius)) = (column("angle"), column("radius")) else {
        let message = "no coordinates of points".to_owned();
        let hint = format!("columns: {FORM}");
        problems.error("missing-column", sheet.headings_place(), message, &hint);
        return None;
    };
    let angles = sheet.inner(angle, Dimension::Angle, problems)?;
    let radii = sheet.inner(radius, Dimension::Length, problems)?;
    let point = |(a, r): (&f64, f64)| Vec3::new(r * a.cos(), r * a.sin(), 0.0);
    let points_mm = angles.iter().zip(radii).map(point).collect();
    Some(Points { points_mm, lines, normal: Some(Vec3::z()) })
}
