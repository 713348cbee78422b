//! What stages know that measure without the axes of the machine: the zero of a probe, the ball, values of
//! certificates.
//!
//! ```text
//!     zero_c = mean of the readings,   u² = s²/n + u(centring)²                           docs/model.md eq. 203
//!     |p − c| = d/2,   V(c) = u² (JᵀJ)⁻¹ + u(seat)² I,   J = [−n, −½]                     docs/model.md eq. 204
//! ```

use super::records::{is_twin, table_mark};
use nalgebra::{Matrix4, Vector4};
use std::path::Path;
use trueaxis_geometry::Vec3;
use trueaxis_input::{CsvTable, Diagnostics, Dimension, Place, Unit};
use trueaxis_measure::measure::Campaign;
use trueaxis_measure::measure::calibration::{add_centre, normal_of_sphere, stated_values, zeros};
use trueaxis_measure::measure::stages::{BallStage, Stage, ZeroStage};
use trueaxis_measure::unknowns::design::Design;
use trueaxis_measure::unknowns::known::Known;

/// Fewer points leave nothing to check a sphere with.
const LEAST_POINTS: usize = 6;
/// A centre that is less sure than this many times a point is none: the points are on a cap.
const LEAST_SURE: f64 = 20.0;
/// A ball or a zero that is so far from what the campaign states is another one, mm.
const FAR_MM: f64 = 2.0;
/// A standard deviation this many times what is stated is no chance.
const SCATTER: f64 = 2.0;
/// A standard deviation this many times what is stated is none: a copy, or another unit.
const QUIET: f64 = 0.02;
/// Passes of the fit of a sphere.
const PASSES: usize = 30;

/// What a stage knows without the axes of the machine.
#[derive(Debug, Clone)]
pub struct Calibrated {
    /// Of the unknowns of the campaign.
    pub known: Known,
    /// How many numbers were read.
    pub numbers: usize,
    /// What was found, in words.
    pub lines: Vec<String>,
}

/// Reads the tables of all stages; `texts` are those that were read before.
pub(super) fn read_calibrations(
    campaign: &Campaign,
    texts: &mut Vec<(String, String)>,
    problems: &mut Diagnostics,
) -> Option<Vec<Calibrated>> {
    let design = campaign.design();
    let read = |stage: &Stage| {
        let known = stated_values(&design, stage);
        let mut found = Calibrated { known, numbers: stage.values.len(), lines: Vec::new() };
        if let Some(zero) = &stage.zero {
            let table = table(campaign, &zero.table, texts, problems)?;
            read_zero(&design, zero, &table, &mut found, problems)?;
        }
        if let Some(ball) = &stage.ball {
            let table = table(campaign, &ball.table, texts, problems)?;
            read_ball(&design, ball, &table, &mut found, problems)?;
        }
        Some(found)
    };
    let all: Vec<Option<Calibrated>> = campaign.stages.list.iter().map(read).collect();
    all.into_iter().collect()
}

fn table(
    campaign: &Campaign,
    path: &Path,
    texts: &mut Vec<(String, String)>,
    problems: &mut Diagnostics,
) -> Option<CsvTable> {
    let text = campaign.files.text(path, "the table of a stage (CSV)", problems)?;
    let file = path.display().to_string();
    if is_twin(campaign, &file, &text, texts, problems) {
        return None;
    }
    let before = problems.iter().count();
    let table = CsvTable::parse(&file, &text, problems);
    texts.push((file, table_mark(&text)));
    (problems.iter().count() == before).then_some(table)
}

/// A column `NAME_unit` in its inner unit.
fn column(
    table: &CsvTable,
    name: &str,
    dimension: Dimension,
    problems: &mut Diagnostics,
) -> Option<Vec<f64>> {
    let found = table.columns.iter().find_map(|c| {
        let unit = c.name.strip_prefix(name)?.strip_prefix('_')?;
        Some((c, Unit::find(unit, dimension).ok()?))
    });
    let Some((column, unit)) = found else {
        let message = format!("the table has no column for {name}");
        let hint = format!("head it by its name and unit, such as {name}_um or {name}_mm");
        problems.error("missing-column", Place::whole(&table.file), message, &hint);
        return None;
    };
    table.in_unit(column, unit, problems)
}

fn read_zero(
    design: &Design,
    stage: &ZeroStage,
    table: &CsvTable,
    found: &mut Calibrated,
    problems: &mut Diagnostics,
) -> Option<()> {
    let instrument = &design.instruments[stage.instrument];
    let angle = instrument.sight.is_angle();
    let dimension = if angle { Dimension::Angle } else { Dimension::Length };
    let (scale, unit) = if angle { (1e6, "µrad") } else { (1e3, "µm") };
    for (k, c) in zeros(design, stage.instrument) {
        let name = instrument.kind.channels()[c];
        let values = column(table, name, dimension, problems)?;
        let n = values.len() as f64;
        if values.is_empty() {
            let message = "the table of the zero has no rows".to_owned();
            problems.error(
                "too-few-readings",
                Place::whole(&table.file),
                message,
                "one row a reading",
            );
            return None;
        }
        let mean = values.iter().sum::<f64>() / n;
        let square: f64 = values.iter().map(|v| (v - mean).powi(2)).sum();
        let s = (square / (n - 1.0).max(1.0)).sqrt();
        if mean.abs() > FAR_MM && !angle {
            let message = format!("{name}: the zero is {mean:.3} mm away, more than {FAR_MM} mm");
            let hint = "is it the table of this probe, in the unit of its heading?";
            problems.error("stage-set-up", table.row_place(0), message, hint);
            return None;
        }
        if s > SCATTER * instrument.noise[c] && values.len() > 4 {
            let message = format!(
                "{name} scatters by {:.3} {unit}, the noise of {} is {:.3} {unit}: the scatter counts",
                s * scale,
                instrument.name,
                instrument.noise[c] * scale
            );
            let hint = "dirt, drift, another probe, or a unit? see the rows";
            problems.warn("zero-scatters", worst_row(table, &values, mean), message, hint);
        }
        if s < QUIET * instrument.noise[c] && values.len() > 4 {
            let message = format!(
                "{name} scatters by {:.4} {unit} only, the noise of {} is {:.3} {unit}",
                s * scale,
                instrument.name,
                instrument.noise[c] * scale
            );
            let hint = "one reading copied, or another unit? x_um is not x_mm";
            problems.warn("zero-scatters", table.row_place(0), message, hint);
        }
        let a = s.max(instrument.noise[c]) / n.sqrt();
        let u = a.hypot(stage.u);
        found.known.add_value(k, mean, u);
        found.numbers += values.len();
        found.lines.push(format!(
            "zero of {}, {name}: {:.3} {unit}, u {:.3} {unit} from {} readings that scatter by {:.3} {unit}",
            instrument.name,
            mean * scale,
            u * scale,
            values.len(),
            s * scale
        ));
    }
    Some(())
}

fn worst_row(table: &CsvTable, values: &[f64], middle: f64) -> Place {
    let off = |k: &usize| (values[*k] - middle).abs();
    let worst = (0..values.len()).max_by(|a, b| off(a).total_cmp(&off(b)));
    table.row_place(worst.unwrap_or(0))
}

/// A sphere by least squares.
struct Sphere {
    centre: Vec3,
    diameter: f64,
    /// (JᵀJ)⁻¹ of centre and diameter.
    inverse: Matrix4<f64>,
    residuals: Vec<f64>,
}

fn fit_sphere(points: &[Vec3]) -> Option<Sphere> {
    let n = points.len() as f64;
    let mut centre = points.iter().sum::<Vec3>() / n;
    let mut diameter = 2.0 * points.iter().map(|p| (p - centre).norm()).sum::<f64>() / n;
    for _ in 0..PASSES {
        let directions: Option<Vec<Vec3>> =
            points.iter().map(|p| (p - centre).try_normalize(1e-9)).collect();
        let directions = directions?;
        let residuals: Vec<f64> =
            points.iter().map(|p| (p - centre).norm() - 0.5 * diameter).collect();
        let inverse = normal_of_sphere(&directions).try_inverse()?;
        let gradient = directions
            .iter()
            .zip(&residuals)
            .fold(Vector4::zeros(), |sum, (n, r)| sum + Vector4::new(-n.x, -n.y, -n.z, -0.5) * *r);
        let step = inverse * gradient;
        centre -= step.fixed_rows::<3>(0).into_owned();
        diameter -= step[3];
        if !step.norm().is_finite() {
            return None;
        }
        if step.norm() < 1e-12 * diameter.abs() {
            return Some(Sphere { centre, diameter, inverse, residuals });
        }
    }
    None
}

fn read_ball(
    design: &Design,
    stage: &BallStage,
    table: &CsvTable,
    found: &mut Calibrated,
    problems: &mut Diagnostics,
) -> Option<()> {
    let [x, y, z] = ["x", "y", "z"].map(|name| column(table, name, Dimension::Length, problems));
    let (x, y, z) = (x?, y?, z?);
    let points: Vec<Vec3> = (0..x.len()).map(|i| Vec3::new(x[i], y[i], z[i])).collect();
    let whole = Place::whole(&table.file);
    if points.len() < LEAST_POINTS {
        let message = format!("{} points on the ball, {LEAST_POINTS} are the fewest", points.len());
        problems.error(
            "too-few-readings",
            whole,
            message,
            "touch it all over, also near its equator",
        );
        return None;
    }
    let hint = "touch the ball all over, also near its equator; one row a point, in one frame";
    let Some(sphere) = fit_sphere(&points) else {
        problems.error("no-sphere", whole, "no sphere goes through these points".into(), hint);
        return None;
    };
    let free = (points.len() - 4) as f64;
    let s = (sphere.residuals.iter().map(|r| r * r).sum::<f64>() / free).sqrt();
    let u_point = s.max(stage.u_mm);
    let least = (0..3).map(|i| sphere.inverse[(i, i)]).fold(0.0, f64::max).sqrt();
    if least > LEAST_SURE {
        let message = format!(
            "the centre is {least:.0} times less sure than a point: the points lie on a cap of the ball"
        );
        problems.error("no-sphere", whole, message, hint);
        return None;
    }
    let off = sphere.centre - design.instruments[stage.instrument].reference_point_mm;
    check_ball(design, stage, (&sphere, s), off, table, problems)?;
    add_centre(design, stage, off, (sphere.inverse, u_point), &mut found.known);
    found.numbers += points.len();
    found.lines.push(format!(
        "ball of {}: centre {:.4} {:.4} {:.4} mm, diameter {:.4} ± {:.4} mm (k = 2), {} points scatter \
         by {:.2} µm",
        design.instruments[stage.instrument].name,
        sphere.centre.x,
        sphere.centre.y,
        sphere.centre.z,
        sphere.diameter,
        2.0 * u_point * sphere.inverse[(3, 3)].sqrt(),
        points.len(),
        s * 1e3
    ));
    Some(())
}

/// Whether it is the ball that the campaign states, where it states it.
fn check_ball(
    design: &Design,
    stage: &BallStage,
    (sphere, s): (&Sphere, f64),
    off: Vec3,
    table: &CsvTable,
    problems: &mut Diagnostics,
) -> Option<()> {
    let name = &design.instruments[stage.instrument].name;
    let whole = Place::whole(&table.file);
    if off.norm() > FAR_MM {
        let message = format!(
            "the centre of the ball is {:.3} mm from the `ball` of {name}, more than {FAR_MM} mm",
            off.norm()
        );
        let hint =
            "another ball, another place, or another frame: points are in that of the workpiece";
        problems.error("stage-set-up", whole, message, hint);
        return None;
    }
    let u_point = s.max(stage.u_mm);
    if let Some((certified, u)) = stage.diameter_mm {
        let (apart, both) =
            (sphere.diameter - certified, u.hypot(u_point * sphere.inverse[(3, 3)].sqrt()));
        if apart.abs() > 2.0 * both {
            let message = format!(
                "the diameter is {:.4} mm, its certificate states {certified} mm; they differ by {:.1} µm, \
                 U {:.1} µm",
                sphere.diameter,
                apart * 1e3,
                2.0 * both * 1e3
            );
            let hint = "another ball, or points that are not corrected for the stylus?";
            problems.error("stage-set-up", whole, message, hint);
            return None;
        }
    }
    if s > SCATTER * stage.u_mm && stage.u_mm > 0.0 {
        let message = format!(
            "the points scatter by {:.2} µm about the sphere, u of a point is {:.2} µm: the scatter counts",
            s * 1e3,
            stage.u_mm * 1e3
        );
        let place = worst_row(table, &sphere.residuals, 0.0);
        problems.warn(
            "ball-scatters",
            place,
            message,
            "dirt, a wrong point, or the form of the ball?",
        );
    }
    Some(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sphere_through_six_points() {
        // ±x, ±y, ±z of a sphere of 10 mm about (1 2 3)
        let centre = Vec3::new(1.0, 2.0, 3.0);
        let points: Vec<Vec3> = (0..6)
            .map(|k| centre + Vec3::ith(k / 2, if k % 2 == 0 { 5.0 } else { -5.0 }))
            .collect();
        let sphere = fit_sphere(&points).expect("a sphere");
        assert!((sphere.centre - centre).norm() < 1e-12 && (sphere.diameter - 10.0).abs() < 1e-12);
        // Two points look along each coordinate: the variance of the centre is u²/2, of the diameter
        // 4u²/6.
        assert!((sphere.inverse[(0, 0)] - 0.5).abs() < 1e-12);
        assert!((sphere.inverse[(3, 3)] - 2.0 / 3.0).abs() < 1e-12);
    }
}
