//! What mathematics demands of indices and files, whatever the numbers.

use proptest::prelude::*;
use std::f64::consts::TAU;
use trueaxis_geometry::Vec3;
use trueaxis_geometry::frame::rotation;
use trueaxis_input::SourceText;
use trueaxis_part::TestPieceFile;
use trueaxis_part::testpiece::cone::{Cone, ConeSize};
use trueaxis_part::testpiece::{CutSurface, Datum, TestPiece};

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, failure_persistence: None, ..Default::default() })]

    #[test]
    fn law_a_pure_shift_is_out_of_place_but_round(
        e in 1e-4..0.1f64, towards in 0.0..TAU, half_angle in 0.0..0.9f64,
    ) {
        let size = ConeSize {
            half_angle_rad: half_angle, positions: 360, height_mm: 60.0, ..ConeSize::nas979()
        };
        let cone = Cone::new("cone", size).map_err(|e| TestCaseError::fail(e.to_string()))?;
        let shift = Vec3::new(e * towards.cos(), e * towards.sin(), 0.0);
        let cut = vec![shift; 360 * 4];
        let mut v = [0.0; 11];
        cone.evaluate(&CutSurface::about_ideal_axis(&cut), &mut cone.scratch(), &mut v)?;
        // Eq 18 samples the cosine every degree.
        prop_assert!((v[0] - e * half_angle.cos()).abs() < e * 1e-4);
        prop_assert!(v[1].abs() < 1e-12 && v[9].abs() < 1e-12);
        prop_assert!((v[2] - e).abs() < 1e-12 && (v[3] - 2.0 * e).abs() < 1e-12);
        let second_order = e * e / cone.radius_mm(25.0);
        for roundness in &v[4..8] {
            prop_assert!(*roundness < second_order + 1e-12, "{} {}", roundness, second_order);
        }
        prop_assert!((v[8] - 2.0 * e).abs() < second_order + 1e-12);
        prop_assert!((v[10] - e).abs() < 1e-12);
    }

    #[test]
    fn law_a_datum_takes_its_own_motion_off(
        shift in prop::array::uniform3(-0.1..0.1f64), tilt in prop::array::uniform3(-1e-4..1e-4f64),
    ) {
        let cone = Cone::new("cone", ConeSize::nas979())?;
        let datum = Datum { shift_mm: shift.into(), tilt_rad: tilt.into() };
        let mut cut = Vec::new();
        for position in cone.tool_positions() {
            for contact in &position.contacts {
                let place = position.tip.along(position.axis, contact.along_axis_mm).vector();
                let turn = rotation(datum.tilt_rad.normalize(), datum.tilt_rad.norm());
                cut.push(turn * place - place + datum.shift_mm);
            }
        }
        let mut v = [0.0; 11];
        let cut = CutSurface { deviation_mm: &cut, datum };
        cone.evaluate(&cut, &mut cone.scratch(), &mut v)?;
        // What stays is the second order of the tilt: (1.7e-4)² · 150 mm.
        prop_assert!(v[..10].iter().all(|i| i.abs() < 1e-5), "{:?}", v);
    }

    #[test]
    fn law_sections_and_indices_say_the_same(
        deviations in prop::collection::vec(prop::array::uniform3(-0.05..0.05f64), 288),
    ) {
        let cone = Cone::new("cone", ConeSize::nas979())?;
        let cut: Vec<Vec3> = deviations.into_iter().map(Into::into).collect();
        let cut = CutSurface::about_ideal_axis(&cut);
        let mut v = [0.0; 11];
        cone.evaluate(&cut, &mut cone.scratch(), &mut v)?;
        let sections = cone.sections(&cut)?;
        for (k, value) in v.iter().enumerate() {
            let source = match k { 1 => 2, 10 => 0, _ => 1 };
            if let Some(there) = sections[source].indices_mm[k] {
                prop_assert_eq!(*value, there, "index {}", k);
            }
        }
        let zone = (0..72).map(|i| {
            let e = [0, 1, 2].map(|s| sections[s].deviation_mm[i]);
            e.iter().fold(f64::MIN, |m, x| m.max(*x)) - e.iter().fold(f64::MAX, |m, x| m.min(*x))
        }).fold(0.0, f64::max);
        prop_assert!((v[9] - zone).abs() < 1e-15);
    }

    #[test]
    fn law_no_error_no_index(half_angle in 0.0..0.9f64, tool in 1.0..60.0f64, m in 8usize..100) {
        let size = ConeSize {
            half_angle_rad: half_angle, tool_diameter_mm: tool, positions: m, ..ConeSize::nas979()
        };
        let cone = Cone::new("cone", size)?;
        let mut v = [1.0; 11];
        let ideal = cone.ideal_deviation_mm();
        cone.evaluate(&CutSurface::about_ideal_axis(&ideal), &mut cone.scratch(), &mut v)?;
        prop_assert!(v.iter().all(|i| i.abs() < 1e-12), "{:?}", v);
    }

    #[test]
    fn law_the_file_parser_survives_any_text(text in "(?s).{0,200}") {
        let source = SourceText::new("any.toml", &text);
        let file = source.read(TestPieceFile::read);
        prop_assert!(file.is_none() && source.finish().has_errors());
    }

    #[test]
    fn law_a_damaged_file_is_read_or_reported(at in 0usize..3000, byte in " -~") {
        let mut text = NAS979.to_owned();
        let at = at.min(text.len() - 1);
        if text.is_char_boundary(at) && text.is_char_boundary(at + 1) {
            text.replace_range(at..=at, &byte);
        }
        let source = SourceText::new("damaged.toml", &text);
        let file = source.read(TestPieceFile::read);
        prop_assert!(file.is_some() || source.finish().has_errors());
    }
}

const NAS979: &str = include_str!("../../../testpieces/nas979-gbt33150.toml");
const ISO10791: &str = include_str!("../../../testpieces/iso10791-7-cone.toml");

fn codes(text: &str) -> (bool, Vec<&'static str>) {
    let source = SourceText::new("piece.toml", text);
    let read = source.read(TestPieceFile::read).is_some();
    (read, source.finish().iter().map(|d| d.code).collect())
}

#[test]
fn shipped_files_have_no_problems() {
    assert_eq!(codes(NAS979), (true, vec![]));
    assert_eq!(codes(ISO10791), (true, vec![]));
}

#[test]
fn every_wrong_tolerance_is_named() {
    let with = |from: &str, to: &str| {
        assert!(NAS979.contains(from));
        codes(&NAS979.replace(from, to))
    };
    assert_eq!(with("\"0.030 mm\"", "0.030"), (false, vec!["missing-unit"]));
    assert_eq!(with("\"0.030 mm\"", "\"0.030 deg\""), (false, vec!["wrong-unit"]));
    assert_eq!(with("\"0.030 mm\"", "\"nan mm\""), (false, vec!["not-finite"]));
    assert_eq!(with("\"0.030 mm\"", "\"-1 mm\""), (false, vec!["tolerance-not-positive"]));
    assert_eq!(with("angularity_zone =", "slope ="), (false, vec!["unknown-index"]));
    assert_eq!(with("angularity_zone =", "roundness_mzc_mm ="), (false, vec!["duplicate-index"]));
    assert_eq!(with("angularity_zone =", "roundness_eq18 ="), (true, vec!["missing-tolerance"]));
    assert_eq!(
        with("half_angle = \"15 deg\"", "half_angle = \"80 deg\""),
        (false, vec!["impossible-shape"])
    );
    assert!(!with("height = \"60 mm\"", "hight = \"60 mm\"").0);
}
