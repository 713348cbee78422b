//! What holds for every probe.

use crate::calibrated;
use crate::virtual_probe::{VirtualProbe, even};
use proptest::prelude::*;
use std::f64::consts::{PI, TAU};
use trueaxis::geometry::Vec3;
use trueaxis::identify::probe::{Calibration, GaugeKind, LobingModel, Side, turned};

fn angle(u: Vec3) -> f64 {
    u.y.atan2(u.x)
}

/// What the correction leaves at most in fresh directions, mm.
fn worst(found: &Calibration, probe: &VirtualProbe<'_>, orientation: f64) -> f64 {
    let left = |u: Vec3| {
        // The corrected ball centre, against the gauge.
        let hit = probe.hit(u, orientation);
        let centre = found.contact_point(&hit) - u * found.ball_radius_mm - probe.centre_mm;
        (centre.norm() - found.gauge.contact_mm(found.ball_radius_mm)).abs()
    };
    even(997, 0.011).into_iter().map(left).fold(0.0, f64::max)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(if cfg!(debug_assertions) { 24 } else { 200 }))]

    /// Three lobes of 10 µm, 60 directions, no noise: 0.01 µm is left at most, anywhere between.
    #[test]
    fn law_three_lobes_are_gone_without_noise(
        phase in 0.0..TAU,
        offset in prop::array::uniform2(-0.05..0.05),
        from in 0.0..0.1,
        spline in any::<bool>(),
    ) {
        let travel = move |u: Vec3| 0.012 + 0.010 * (3.0 * angle(u) + phase).cos();
        let offset_mm = Vec3::new(offset[0], offset[1], 0.0);
        let centre_mm = Vec3::new(300.0, -200.0, 0.0);
        let probe = VirtualProbe { travel: &travel, offset_mm, centre_mm, ..VirtualProbe::default() };
        let mut study = probe.study(even(60, from));
        study.model = if spline { LobingModel::Spline } else { LobingModel::Fourier };
        let found = &calibrated(&study)[0];
        let left = worst(found, &probe, 0.0);
        prop_assert!(left <= 1e-5, "{left} mm");
        let off = (found.fit.offset_mm - offset_mm).norm();
        prop_assert!(off < if spline { 1e-5 } else { 1e-9 }, "{off}");
    }

    /// Who turns the probe turns its table: the same pre-travel, seen from the probe.
    #[test]
    fn law_turning_the_probe_turns_the_table(
        turn in 0.0..TAU,
        a in prop::array::uniform6(-0.01..0.01),
        outside in any::<bool>(),
    ) {
        let travel = move |u: Vec3| {
            let w = angle(u);
            0.02 + a[0] * (2.0 * w).cos() + a[1] * (2.0 * w).sin() + a[2] * (3.0 * w).cos()
                + a[3] * (3.0 * w).sin()
        };
        let offset_mm = Vec3::new(a[4], a[5], 0.0);
        let side = if outside { Side::Outside } else { Side::Inside };
        let probe = VirtualProbe { travel: &travel, offset_mm, side, ..VirtualProbe::default() };
        let still = &calibrated(&probe.study(even(36, 0.0)))[0];
        let turned_by = &calibrated(&probe.study_turned(even(36, 0.0), &[turn]))[0];
        prop_assert!((still.fit.offset_mm - turned_by.fit.offset_mm).norm() < 1e-9);
        for u in even(17, 0.3) {
            let here = still.deviation(u, 0.0).deviation_mm;
            let there = turned_by.deviation(turned(u, turn), turn).deviation_mm;
            prop_assert!((here - there).abs() < 1e-9);
        }
    }

    /// Two orientations tell the offset from an unknown centre; one does not, and says so.
    #[test]
    fn law_offset_and_centre_are_told_apart_by_turning(
        offset in prop::array::uniform2(-0.1..0.1),
        centre in prop::array::uniform2(-500.0..500.0),
        other in 0.5..PI,
    ) {
        let travel = |u: Vec3| 0.015 + 0.008 * (3.0 * angle(u)).cos();
        let offset_mm = Vec3::new(offset[0], offset[1], 0.0);
        let centre_mm = Vec3::new(centre[0], centre[1], 0.0);
        let probe = VirtualProbe { travel: &travel, offset_mm, centre_mm, ..VirtualProbe::default() };
        let mut study = probe.study_turned(even(24, 0.0), &[0.0, other]);
        study.gauge.centre_mm = None;
        let found = &calibrated(&study)[0];
        prop_assert!((found.fit.offset_mm - offset_mm).norm() < 1e-8);
        prop_assert!((found.fit.centre_mm - centre_mm).norm() < 1e-8);
        let mut study = probe.study(even(24, 0.0));
        study.gauge.centre_mm = None;
        prop_assert!(calibrated(&study)[0].offset.is_none());
    }

    /// On a sphere: hits from above at several latitudes, judged in other directions.
    #[test]
    fn law_a_sphere_tells_the_pre_travel_in_three_dimensions(
        a in prop::array::uniform5(-0.01..0.01),
        phase in 0.0..TAU,
    ) {
        let travel = move |u: Vec3| {
            let level = u.x.hypot(u.y);
            0.02 + a[0] * u.z * u.z + a[1] * level.powi(3) * (3.0 * angle(u) + phase).cos()
                + a[2] * u.z * level * angle(u).cos()
        };
        let offset_mm = Vec3::new(a[3], a[4], 0.3);
        let probe = VirtualProbe {
            travel: &travel,
            offset_mm,
            kind: GaugeKind::Sphere,
            side: Side::Outside,
            ..VirtualProbe::default()
        };
        let at = |u: &Vec3, latitude: f64| {
            let (s, c) = latitude.to_radians().sin_cos();
            Vec3::new(u.x * c, u.y * c, -s)
        };
        let rings = [0.0, 22.0, 45.0, 68.0];
        let mut directions: Vec<Vec3> =
            rings.iter().flat_map(|l| even(12, l * 0.01).iter().map(|u| at(u, *l)).collect::<Vec<_>>()).collect();
        directions.push(-Vec3::z());
        let found = &calibrated(&probe.study(directions))[0];
        prop_assert!((found.fit.offset_mm - offset_mm).norm() < 1e-8);
        for u in even(40, 0.2).iter().zip(0..).map(|(u, i)| at(u, 2.0 * f64::from(i))) {
            let left = found.deviation(u, 0.0).deviation_mm - probe.deviation(u, 0.0);
            // The table is linear in the offset: 0.3² / (2 · 33) mm and less are not in it.
            let across = offset_mm - u * offset_mm.dot(&u);
            let bent = across.norm_squared() / 66.0;
            prop_assert!((left.abs() - bent).abs() < 1e-6 + 0.01 * bent, "{left} {bent}");
        }
    }
}

/// The share of campaigns whose true value lies within U (95 %).
#[test]
fn law_uncertainties_cover_what_they_claim() {
    let travel = |u: Vec3| {
        let w = angle(u);
        0.018 + 0.010 * (3.0 * w).cos() + 0.003 * (2.0 * w).sin() + 0.002 * (6.0 * w).cos()
    };
    let offset_mm = Vec3::new(0.004, -0.003, 0.0);
    let campaigns = if cfg!(debug_assertions) { 300 } else { 2000 };
    let (mut table, mut offset, mut counted) = (0, 0, 0);
    for seed in 0..campaigns {
        let probe = VirtualProbe {
            travel: &travel,
            offset_mm,
            noise_mm: 1e-3,
            seed,
            ..VirtualProbe::default()
        };
        let mut study = probe.study(even(60, 0.0));
        study.most_harmonics = 8;
        let found = &calibrated(&study)[0];
        for (k, u) in even(3, seed as f64).into_iter().enumerate() {
            let row = found.deviation(u, 0.0);
            let off = row.deviation_mm - probe.deviation(u, 0.0);
            table += usize::from(off.abs() <= found.coverage_factor * row.u_mm);
            counted += 1;
            if k < 2 {
                let off = found.fit.offset_mm[k] - offset_mm[k];
                let u_mm = found.offset.expect("an offset").u_mm[k];
                offset += usize::from(off.abs() <= found.coverage_factor * u_mm);
            }
        }
    }
    let table = table as f64 / f64::from(counted);
    let offset = offset as f64 / (2 * campaigns) as f64;
    assert!((0.93..=0.97).contains(&table), "table: {table}");
    assert!((0.93..=0.97).contains(&offset), "offset: {offset}");
}
