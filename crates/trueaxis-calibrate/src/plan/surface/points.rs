//! Points of cutter locations, and the table of the points to measure.

use std::fmt::Write;
use trueaxis_cl::ClFile;
use trueaxis_geometry::Vec3;
use trueaxis_geometry::surface::{Candidates, SurfacePoint};
use trueaxis_input::sheet::{Cells, Sheet, heading};
use trueaxis_input::{Diagnostics, Dimension};

/// The points of cutter locations, without those in rapid; the tool axis shows the outer side.
pub(super) fn points_of(file: &ClFile, are_normals: bool) -> Candidates {
    let points = file.points().filter(|(_, p)| !p.rapid).map(|(line, p)| SurfacePoint {
        point_mm: Vec3::from(p.tip_mm),
        normal: Vec3::from(p.axis),
        axis: Vec3::from(p.axis),
        line,
    });
    Candidates::Points { points: points.collect(), are_normals }
}

/// A normal whose length is off by more is none.
const NORM_ERROR: f64 = 0.05;
const FORM: &str = "point,x_mm,y_mm,z_mm,i,j,k: nominal points and outward unit normals";

/// Points and normals of a table such as `surface.csv`; a column of deviations is left alone.
pub fn points_of_table(
    file: &str,
    text: &str,
    problems: &mut Diagnostics,
) -> Option<Vec<SurfacePoint>> {
    let cells = |name: &str| {
        let known = ["x", "y", "z"].contains(&heading(name).0) || ["i", "j", "k"].contains(&name);
        if known { Cells::Numbers } else { Cells::Unused }
    };
    let sheet = Sheet::parse(file, text, cells, problems)?;
    let mut columns = Vec::new();
    for name in ["x", "y", "z", "i", "j", "k"] {
        let Some(column) = sheet.about(name) else {
            let message = format!("the table has no column `{name}`");
            problems.error("missing-column", sheet.headings_place(), message, FORM);
            return None;
        };
        columns.push(match name {
            "x" | "y" | "z" => sheet.inner(column, Dimension::Length, problems)?,
            _ => column.values.clone(),
        });
    }
    let mut points = Vec::with_capacity(sheet.rows());
    for row in 0..sheet.rows() {
        let cell = |k: usize| columns.get(k).and_then(|c| c.get(row)).copied().unwrap_or(f64::NAN);
        let [point_mm, raw] = [0, 3].map(|k| Vec3::new(cell(k), cell(k + 1), cell(k + 2)));
        let place = sheet.row_place(row);
        if point_mm.iter().any(|v| !v.is_finite()) {
            let message = "a coordinate of the point is empty".to_owned();
            problems.error("not-a-number", place, message, FORM);
            return None;
        }
        if (raw.norm() - 1.0).abs().le(&NORM_ERROR) {
            let normal = raw.normalize();
            let line = u32::try_from(place.line).unwrap_or(u32::MAX);
            points.push(SurfacePoint { point_mm, normal, axis: normal, line });
        } else {
            let message = format!("the normal has the length {:.4}, not 1", raw.norm());
            problems.error("bad-normal", place, message, FORM);
            return None;
        }
    }
    Some(points)
}

/// The table that is measured: `deviation` is empty until then.
pub fn nominal_table(points: &[SurfacePoint]) -> String {
    let mut text = "# nominal contact points (mm) and outward unit normals in the workpiece frame; deviation: \
                    measured offset along the normal, um, positive outside\n\
                    point,x_mm,y_mm,z_mm,i,j,k,deviation_um\n"
        .to_owned();
    for (i, p) in points.iter().enumerate() {
        let (x, n) = (p.point_mm, p.normal);
        // Writing to a String cannot fail.
        let _ = writeln!(
            text,
            "{},{:.6},{:.6},{:.6},{:.9},{:.9},{:.9},",
            i + 1,
            x.x,
            x.y,
            x.z,
            n.x,
            n.y,
            n.z
        );
    }
    text
}
