//! The finished part as the cutter leaves it, against the way by contact points.

mod library;

use library::root;
use trueaxis::cut::{Cutter, Nail, Reach, Sweep, ToolPose, cut};
use trueaxis::files::disk;
use trueaxis::geometry::Vec3;
use trueaxis::part::Shape;
use trueaxis::part::testpiece::cone::{Cone, ConeSize};
use trueaxis::part::testpiece::{CutSurface, Datum, Family, Feature, TestPiece};
use trueaxis::predict::{Cutting, Judge, Study, read_study};

/// The mill of the study reaches this far beyond the end of the flank that the frustum needs.
const LONGER_MM: f64 = 5.0;

fn study(positions: usize) -> Study {
    let path = root().join("examples/03_predict/nas979-on-xkas2525.toml");
    let (study, problems) = read_study(&disk(), &path);
    assert!(!problems.has_errors());
    let mut study = study.expect("a study");
    let Shape::Cone(cone) = &study.test_piece.shape;
    let size = ConeSize { positions, ..cone.size().clone() };
    study.test_piece.shape = Shape::Cone(Cone::new("frustum", size).expect("a cone"));
    study
}

/// The deviation of the surface at each contact, by the mill going round the frustum with these errors or without any.
fn left(study: &Study, cutting: &Cutting<'_>, actual: bool) -> Vec<f64> {
    let Shape::Cone(cone) = &study.test_piece.shape;
    let diameter_mm = cone.size().tool_diameter_mm;
    let machine = &study.machine;
    let deviation = |command: &_| {
        let errors = machine.errors_at(command, &[0.0; 6]).expect("errors");
        machine.deviation(command, &errors)
    };
    let zero = deviation(cutting.setting_command()).tip_mm;
    let mut poses = Vec::new();
    let mut nails = Vec::new();
    for (position, command) in cutting.positions().iter().zip(cutting.commands()) {
        let (mut tip, mut axis) = (position.tip.vector(), position.axis.vector());
        for contact in &position.contacts {
            let normal = contact.normal.vector();
            let foot_mm = tip + axis * contact.along_axis_mm - normal * (0.5 * diameter_mm);
            nails.push(Nail { foot_mm, normal, below_mm: 1.0, above_mm: 1.0 });
        }
        if actual {
            let off = deviation(command);
            tip += off.tip_mm - zero;
            axis += off.axis;
        }
        poses.push(ToolPose { tip_mm: tip - axis * LONGER_MM, axis: axis.normalize() });
    }
    let round = poses.iter().zip(poses.iter().cycle().skip(1)).map(|(a, b)| [*a, *b]);
    let mill = Cutter::flat(diameter_mm, 120.0).expect("a mill");
    let sweep = Sweep::new(mill, round).expect("a path");
    let found = cut(&[sweep], &nails);
    let value = |reach: &Reach| match reach {
        Reach::Cut(cut) => cut.deviation_mm,
        other => panic!("{other:?}"),
    };
    found.iter().map(value).collect()
}

/// The frustum of NAS 979 as it stands after the mill went round it gives the indices that the errors at the contact points give, to
/// 0.05 µm; what straight steps between the positions cut deeper is the same with errors and without.
#[test]
fn law_the_frustum_that_is_left_is_that_of_its_contact_points() {
    let study = study(7200);
    let piece: &dyn TestPiece = study.piece();
    let cutting = Cutting::new(&study.machine, piece, &study.reference).expect("reachable");
    let judge = Judge { cutting: &cutting, piece };
    let expected = judge.once(&|e, _| *e).expect("indices");
    let normals = cutting.positions().iter().flat_map(|p| &p.contacts).map(|c| c.normal.vector());
    let [nominal, actual] = [false, true].map(|actual| left(&study, &cutting, actual));
    assert!(nominal.iter().all(|d| (-1e-3..1e-9).contains(d)), "straight steps cut some nm");
    let deviation_mm: Vec<Vec3> =
        normals.zip(nominal.iter().zip(&actual)).map(|(n, (a, b))| n * (b - a)).collect();
    let surface = CutSurface { deviation_mm: &deviation_mm, datum: Datum::IDEAL };
    let mut found = vec![0.0; expected.len()];
    piece.evaluate(&surface, &mut piece.scratch(), &mut found).expect("indices");
    for ((name, expected), found) in piece.index_names().iter().zip(&expected).zip(&found) {
        // These two speak of the tool itself, not of the surface.
        let of_tool = name.family == Family::Spatial
            || name.feature == Feature::Coaxiality && name.family == Family::Paper;
        if !of_tool {
            assert!((expected - found).abs() < 5e-5, "{}: {expected} {found}", name.key);
        }
    }
    assert!(expected[8] > 0.05, "the part is off");
}
