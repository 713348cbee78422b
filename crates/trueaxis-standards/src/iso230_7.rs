//! ISO 230-7: error motion of a rotary axis: total, synchronous, asynchronous; docs/model.md eq. 74, 75.
//!
//! Readings at the same angles of every revolution. `radial` is one probe in a fixed sensitive
//! direction; `x` and `y` are two probes, which give the rotating sensitive direction as well as both
//! fixed ones; `axial` is along the axis. Radial motions are taken about the least-squares centre: the
//! once-per-revolution part is the eccentricity of the artefact, not of the axis. Along the axis it
//! belongs to the motion.

use super::least_squares::LeastSquares;
use super::{check_temperatures, check_times};
use std::f64::consts::{PI, TAU};
use trueaxis_input::sheet::{Cells, Sheet, heading};
use trueaxis_input::{Diagnostics, Dimension, Place};

/// Revolutions that make an asynchronous error motion reliable (from memory of the standard).
pub const REVOLUTIONS: usize = 20;

/// The direction in which a motion is measured.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sensitive {
    /// Radial, one direction of the stator: turned parts, or one axis of a table.
    Fixed(&'static str),
    /// Radial, turning with the spindle: bored holes.
    Rotating,
    /// Along the axis.
    Axial,
}

impl Sensitive {
    /// `radial fixed x`, `radial rotating`, `axial`.
    pub fn name(self) -> String {
        match self {
            Self::Fixed(axis) => format!("radial fixed {axis}"),
            Self::Rotating => "radial rotating".to_owned(),
            Self::Axial => "axial".to_owned(),
        }
    }
}

/// An error motion, evaluated; mm.
#[derive(Debug, Clone, PartialEq)]
pub struct ErrorMotion {
    /// Where it is measured.
    pub sensitive: Sensitive,
    /// Range of all readings about the least-squares centre.
    pub total_mm: f64,
    /// Range of the mean over the revolutions.
    pub synchronous_mm: f64,
    /// Largest range at one angle; `None` from one revolution.
    pub asynchronous_mm: Option<f64>,
    /// Amplitude of the once-per-revolution part that was taken out (left in, along the axis).
    pub fundamental_mm: f64,
    /// Per angle: mean, least and largest.
    pub profile_mm: Vec<[f64; 3]>,
}

/// A test, evaluated.
#[derive(Debug, Clone, PartialEq)]
pub struct Rotation {
    /// Whole revolutions; those readings that make no whole one are left out.
    pub revolutions: usize,
    /// The angles of a revolution, rad.
    pub angles_rad: Vec<f64>,
    /// How many readings after the last whole revolution were left out.
    pub left_out: usize,
    /// Every motion.
    pub motions: Vec<ErrorMotion>,
}

fn cells(name: &str) -> Cells {
    match heading(name).0 {
        "angle" | "radial" | "x" | "y" | "axial" | "time" | "temperature" => Cells::Numbers,
        _ => Cells::Unused,
    }
}

/// Reads and evaluates the readings; `None` with errors in `problems`.
pub fn evaluate(file: &str, text: &str, problems: &mut Diagnostics) -> Option<Rotation> {
    let sheet = Sheet::parse(file, text, cells, problems)?;
    check_temperatures(&sheet, problems);
    check_times(&sheet, false, problems);
    let hint = "angle_deg and radial_um, or x_um and y_um, or axial_um";
    for column in sheet.columns.iter().filter(|c| c.cells == Cells::Unused) {
        let message = format!("column `{}` is not used", column.name);
        problems.warn("unused-column", column.place.clone(), message, hint);
    }
    let Some(column) = sheet.about("angle") else {
        let message = "the table has no column of angles".to_owned();
        problems.error("missing-column", sheet.headings_place(), message, hint);
        return None;
    };
    let angles = sheet.inner(column, Dimension::Angle, problems)?;
    let (angles_rad, revolutions) = indexed(&angles, &sheet, problems)?;
    let used = angles_rad.len() * revolutions;
    let mut read = |role: &str| match sheet.about(role) {
        Some(column) => sheet.inner(column, Dimension::Length, problems).map(Some),
        None => Some(None),
    };
    let (radial, x, y, axial) = (read("radial")?, read("x")?, read("y")?, read("axial")?);
    let mut motions = Vec::new();
    let mut add = |sensitive, values: &[f64]| {
        motions.push(motion(sensitive, &angles_rad, &values[..used]));
    };
    if let Some(values) = &radial {
        add(Sensitive::Fixed("radial"), values);
    }
    if let Some(values) = &x {
        add(Sensitive::Fixed("x"), values);
    }
    if let Some(values) = &y {
        add(Sensitive::Fixed("y"), values);
    }
    if let (Some(x), Some(y)) = (&x, &y) {
        let towards = |((a, x), y): ((&f64, &f64), &f64)| x * a.cos() + y * a.sin();
        let turning: Vec<f64> = angles.iter().zip(x).zip(y).map(towards).collect();
        add(Sensitive::Rotating, &turning);
    }
    if let Some(values) = &axial {
        add(Sensitive::Axial, values);
    }
    if motions.is_empty() {
        let message = "the table has no readings".to_owned();
        problems.error("missing-column", sheet.headings_place(), message, hint);
        return None;
    }
    if revolutions < REVOLUTIONS {
        let message =
            format!("{revolutions} whole revolution{}", if revolutions == 1 { "" } else { "s" });
        let hint = "the asynchronous error motion grows with their number; 20 are usual, one does not show it";
        problems.warn("few-revolutions", Place::whole(file), message, hint);
    }
    let left_out = angles.len() - used;
    Some(Rotation { revolutions, angles_rad, left_out, motions })
}

/// The angles of one revolution and the number of whole revolutions.
fn indexed(angles: &[f64], sheet: &Sheet, problems: &mut Diagnostics) -> Option<(Vec<f64>, usize)> {
    // Angles may continue beyond 360° or start again.
    let mut turned = vec![0.0];
    for pair in angles.windows(2) {
        let step = (pair[1] - pair[0] + PI).rem_euclid(TAU) - PI;
        turned.push(turned[turned.len() - 1] + step);
    }
    let swept = turned[turned.len() - 1];
    let step = swept / (angles.len().max(2) - 1) as f64;
    let count = (TAU / step.abs()).round();
    let mut refuse = |row: usize, message: String| {
        let hint =
            "readings at the same angles of every revolution, such as those an encoder triggers";
        problems.error("angles-not-indexed", sheet.row_place(row), message, hint);
        None
    };
    if !(4.0..=1e7).contains(&count) {
        return refuse(0, format!("{count} readings a revolution"));
    }
    let even = step.signum() * TAU / count;
    let off = |(i, t): (usize, &f64)| (t - i as f64 * even).abs() > 0.25 * even.abs();
    if let Some(row) = turned.iter().enumerate().position(off) {
        let shown = angles[row].to_degrees();
        return refuse(
            row,
            format!("the angles are not evenly spaced: {shown:.4} deg is out of step"),
        );
    }
    let count = count as usize;
    if angles.len() < count {
        let degrees = swept.abs().to_degrees();
        return refuse(angles.len() - 1, format!("only {degrees:.1} deg, no whole revolution"));
    }
    Some((angles[..count].to_vec(), angles.len() / count))
}

fn motion(sensitive: Sensitive, angles: &[f64], values: &[f64]) -> ErrorMotion {
    let mut fit = LeastSquares::<3>::default();
    let row = |a: f64| [1.0, a.cos(), a.sin()];
    for (i, value) in values.iter().enumerate() {
        fit.add(&row(angles[i % angles.len()]), *value);
    }
    // Evenly spaced angles: the three columns are orthogonal, the solution is there.
    let part = fit.solve().unwrap_or_default();
    let taken = match sensitive {
        Sensitive::Axial => [part[0], 0.0, 0.0],
        _ => part,
    };
    let empty = [0.0, f64::INFINITY, f64::NEG_INFINITY];
    let mut profile = vec![empty; angles.len()];
    for (i, value) in values.iter().enumerate() {
        let k = i % angles.len();
        let out: f64 = row(angles[k]).iter().zip(&taken).map(|(a, b)| a * b).sum();
        let rest = value - out;
        let [sum, low, high] = &mut profile[k];
        *sum += rest;
        (*low, *high) = (low.min(rest), high.max(rest));
    }
    let turns = values.len() / angles.len();
    for p in &mut profile {
        p[0] /= turns as f64;
    }
    let most =
        |f: &dyn Fn(&[f64; 3]) -> f64| profile.iter().map(f).fold(f64::NEG_INFINITY, f64::max);
    ErrorMotion {
        sensitive,
        total_mm: most(&|p| p[2]) + most(&|p| -p[1]),
        synchronous_mm: most(&|p| p[0]) + most(&|p| -p[0]),
        asynchronous_mm: (turns > 1).then(|| most(&|p| p[2] - p[1])),
        fundamental_mm: part[1].hypot(part[2]),
        profile_mm: profile,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table(heads: &str, row: impl Fn(f64, usize) -> String) -> Rotation {
        let mut text = format!("angle_deg,{heads}\n");
        for i in 0..=(72 * 20) {
            let degrees = 5.0 * i as f64;
            text += &format!("{degrees},{}\n", row(degrees.to_radians(), i / 72));
        }
        let mut problems = Diagnostics::new();
        let result = evaluate("s.csv", &text, &mut problems).unwrap();
        assert!(problems.iter().next().is_none(), "{problems:?}");
        result
    }

    #[track_caller]
    fn near(mm: f64, um: f64) {
        assert!((mm * 1e3 - um).abs() < 1e-6, "{} µm, not {um}", mm * 1e3);
    }

    #[test]
    fn a_fixed_direction_by_hand() {
        // Eccentricity 10, two lobes of 1.5, every second revolution 0.5 higher; 5° divide 90°.
        let r = table("radial_um", |a, turn| {
            let jump = if turn % 2 == 0 { 0.0 } else { 0.5 };
            format!("{}", 10.0 * (a + 0.3).cos() + 1.5 * (2.0 * a).cos() + jump)
        });
        assert_eq!((r.revolutions, r.left_out), (20, 1));
        let m = &r.motions[0];
        near(m.fundamental_mm, 10.0);
        near(m.synchronous_mm, 3.0);
        near(m.asynchronous_mm.unwrap(), 0.5);
        near(m.total_mm, 3.5);
    }

    #[test]
    fn a_fine_encoder_divides_a_revolution() {
        // 720 readings a turn, two turns: three lobes of 2 µm have a synchronous error motion of 4 µm.
        let mut text = "angle_deg,radial_um\n".to_owned();
        for i in 0..1440 {
            let degrees = 0.5 * f64::from(i);
            text += &format!("{degrees},{}\n", 2.0 * (3.0 * degrees.to_radians()).cos());
        }
        let mut problems = Diagnostics::new();
        let r = evaluate("s.csv", &text, &mut problems).unwrap();
        assert_eq!((r.revolutions, r.left_out), (2, 0));
        near(r.motions[0].synchronous_mm, 4.0);
        near(r.motions[0].asynchronous_mm.unwrap(), 0.0);
    }

    #[test]
    fn the_rotating_direction_does_not_contain_the_eccentricity() {
        // A ball 8 µm off turns with the spindle; the probes are 3 and −2 µm off; the axis itself
        // moves 1 µm along x twice a turn.
        let r = table("x_um,y_um", |a, _| {
            let x = 8.0 * (a + 1.0).cos() + 3.0 + (2.0 * a).cos();
            format!("{x},{}", 8.0 * (a + 1.0).sin() - 2.0)
        });
        let rotating = &r.motions[2];
        assert_eq!(rotating.sensitive, Sensitive::Rotating);
        // cos 2θ · cos θ = ½ cos θ + ½ cos 3θ: the first part goes with the centre.
        near(rotating.synchronous_mm, 1.0);
        near(rotating.fundamental_mm, (3.5_f64).hypot(2.0));
    }

    #[test]
    fn the_axial_motion_keeps_its_fundamental() {
        let r = table("axial_um", |a, _| format!("{}", 5.0 + 2.0 * a.cos()));
        near(r.motions[0].synchronous_mm, 4.0);
        near(r.motions[0].asynchronous_mm.unwrap(), 0.0);
    }
}
