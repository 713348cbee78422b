//! Touches over a surface: where the ball really stands.

use proptest::prelude::*;
use std::path::Path;
use trueaxis::files::disk;
use trueaxis::geometry::Vec3;
use trueaxis::identify::surface::{deviations, parse_log, read_hits};
use trueaxis::input::Diagnostics;
use trueaxis::machine::tcp::TipControl;
use trueaxis::plan::surface::{
    Candidates, SurfacePoint, SurfaceStudy, TrueProbe, VirtualProbing, poses, virtual_log,
};

fn study() -> SurfaceStudy {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let path = root.join("machines/i5-engraver/machine.toml");
    let machine = trueaxis::files::machine(&path).0.expect("a machine");
    SurfaceStudy {
        files: disk(),
        file: "s.toml".to_owned(),
        name: "s".to_owned(),
        machine: machine.with_tip(Vec3::new(0.0, 0.0, -90.0)),
        machine_path: path,
        surface_file: "s.cls".to_owned(),
        candidates: Candidates::Facets(Vec::new()),
        part: None,
        spacing_mm: 4.0,
        most_points: 500,
        facing: None,
        probe_length_mm: 90.0,
        u_probe_length_mm: None,
        tool: 1,
        calibration: None,
        touches_again: true,
        real: None,
        ball_radius_mm: 1.0,
        shape: Vec::new(),
        stand_off_mm: 2.0,
        beyond_mm: 0.5,
        clearance_mm: 8.0,
        touch_feed_mm_per_min: 100.0,
        feed_mm_per_min: 1500.0,
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    /// Ball, nominal surface and normal lie on one line; the probe stands along the stated axis.
    #[test]
    fn law_the_ball_comes_along_the_normal(
        point in prop::array::uniform3(-20.0..20.0),
        normal in prop::array::uniform2(-0.6..0.6),
        lean in prop::array::uniform2(-0.3..0.3),
    ) {
        let study = study();
        let normal = Vec3::new(normal[0], normal[1], 1.0).normalize();
        let axis = (normal + Vec3::new(lean[0], lean[1], 0.0)).normalize();
        let point_mm = Vec3::from(point);
        let given = [SurfacePoint { point_mm, normal, axis, line: 1 }];
        let mut problems = Diagnostics::new();
        let found = poses(&study, &given, &mut problems);
        prop_assert_eq!(found.len(), 1, "{:?}", problems);
        let control = TipControl::of(&study.machine).expect("three linear axes");
        let stands = [(found[0].above, 8.0), (found[0].before, 2.0), (found[0].beyond, -0.5)];
        for (command, gap) in stands {
            let (ball, along) = control.tip_and_axis(&command);
            prop_assert!((ball - point_mm - normal * (1.0 + gap)).norm() < 1e-9);
            prop_assert!((along - axis).norm() < 1e-9);
        }
    }
}

/// A tip that rises by 0.1 mm from the first hit to the last makes the spindle go 0, 1/5 … 5/5 of that deeper along the
/// probe, which stands along each normal; what it drifts across the normal no hit sees.
#[test]
fn a_virtual_drift_grows_evenly_over_the_hits() {
    let study = study();
    let point = |k: u32| {
        let k = f64::from(k);
        let normal = Vec3::new(0.1 * (k + 1.0), -0.05 * (k + 1.0), 1.0).normalize();
        let point_mm = Vec3::new(8.0 * k - 16.0, 10.0 - 5.0 * k, 0.5 * k);
        SurfacePoint { point_mm, normal, axis: normal, line: 1 }
    };
    let given: Vec<SurfacePoint> = (0..5).map(point).collect();
    let mut problems = Diagnostics::new();
    let poses = poses(&study, &given, &mut problems);
    assert_eq!(poses.len(), 5, "{problems:?}");
    let control = TipControl::of(&study.machine).expect("three linear axes");
    let mut tips = |drift_mm: Vec3| {
        let real = VirtualProbing {
            machine: study.machine.clone(),
            drawn: false,
            probe: TrueProbe::default(),
            surface: Vec::new(),
            drift_mm,
            seed: 1,
        };
        let text = virtual_log(&study, &real, &poses, &mut problems).expect("a log");
        let log = parse_log("v.log", &text, &study.machine, &mut problems).expect("hits");
        log.hits.iter().map(|h| control.tip_and_axis(&h.command).0).collect::<Vec<Vec3>>()
    };
    let (still, drifts) = (tips(Vec3::zeros()), tips(Vec3::new(0.03, -0.02, 0.1)));
    // The first point again is the sixth hit.
    assert_eq!((still.len(), drifts.len()), (6, 6));
    for (i, (a, b)) in still.iter().zip(&drifts).enumerate() {
        let deeper_mm = (a - b).dot(&given[i % 5].normal);
        // The log has four decimals.
        assert!((deeper_mm - 0.02 * i as f64).abs() < 3e-4, "hit {i}: {deeper_mm}");
    }
}

/// A program stops 0.9 of the radius of its ball below the surface: down to there a hit is a deviation of the surface.
/// A ball with its centre inside of it touched something else.
#[test]
fn a_hit_lies_no_deeper_than_the_radius_of_its_ball() {
    let examples = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/05_identify");
    let (study, problems) = read_hits(&disk(), &examples.join("bangle-hits.toml"));
    let study = study.unwrap_or_else(|| panic!("{problems:?}"));
    let control = TipControl::of(&study.machine).expect("three linear axes");
    let radius = study.probe.calibration.ball_radius_mm;
    // The deviation where the ball stands so many radii above the place where it touches the nominal surface.
    let deviation = |radii: f64| {
        let mut moved = study.clone();
        let hit = &mut moved.log.hits[3];
        let (number, point) = (hit.point, study.points[hit.point - 1]);
        let ball = point.point_mm + point.normal * (radius * (1.0 + radii));
        assert!(control.place(ball, &mut hit.command));
        let all = deviations(&moved, &mut Diagnostics::new())?;
        all.points.iter().find(|p| p.number == number).map(|p| p.deviation_mm)
    };
    let [at, below] = [0.0, -0.9].map(|radii| deviation(radii).expect("a deviation"));
    assert!((at - below - 0.9 * radius).abs() < 1e-3, "{at} {below}");
    assert_eq!(deviation(-1.1), None);
}
