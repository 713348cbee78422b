//! Touches over a surface: where the ball really stands.

use proptest::prelude::*;
use std::path::Path;
use trueaxis::files::disk;
use trueaxis::geometry::Vec3;
use trueaxis::input::Diagnostics;
use trueaxis::machine::tcp::TipControl;
use trueaxis::plan::surface::{Candidates, SurfacePoint, SurfaceStudy, poses};

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
