//! Our side of probe-table.toml: the table inside a control, and readings with uncertainties of their own.

use crate::Ours;
use std::f64::consts::TAU;
use trueaxis::compensate::adapt::{Field, FieldOptions, SurfacePoint};
use trueaxis::geometry::Vec3;
use trueaxis::identify::probe::program::Correction;

pub const CLAIMS: &[(&str, Ours)] = &[("probe-table-chord", chord), ("blank-common-u", common)];

fn chord() -> Vec<f64> {
    let lobes = |angle: f64| 0.010 * (3.0 * angle).cos();
    let at = |i: usize, n: usize| TAU * i as f64 / n as f64;
    let dr_mm = (0..60).map(|i| lobes(at(i, 60))).collect();
    let table = Correction { dr_mm, length_mm: None, about: String::new() };
    let off = (0..6000).map(|i| (table.dr_at(at(i, 6000)) - lobes(at(i, 6000))).abs());
    vec![1e3 * off.fold(0.0, f64::max)]
}

fn common() -> Vec<f64> {
    let point = |k: u32| SurfacePoint {
        line: k + 2,
        number: f64::from(k),
        at_mm: Vec3::new(f64::from(k % 5), f64::from(k / 5), 0.0),
        normal: Vec3::z(),
        deviation_mm: 0.0,
        u_mm: Some(if k.is_multiple_of(3) { 0.0065 } else { 0.0025 }),
    };
    let points: Vec<SurfacePoint> = (0..25).map(point).collect();
    let options = FieldOptions { noise_mm: 0.0015, length_mm: Some(5.0), form_mm: Some(0.01) };
    vec![1e3 * Field::fit(&points, &options).expect("a field").common_mm]
}
