//! Points of a measuring machine give the indices that the cut has.

use proptest::prelude::*;
use std::f64::consts::TAU;
use trueaxis_geometry::Vec3;
use trueaxis_part::testpiece::cone::{Cone, ConeSize};
use trueaxis_part::testpiece::measured::{MeasuredFault, MeasuredPoint};
use trueaxis_part::testpiece::{CutSurface, TestPiece};

fn cone() -> Cone {
    Cone::new("NAS 979", ConeSize::nas979()).unwrap()
}

/// The cut surface as points: nominal point + E n_f.
fn points(cone: &Cone, deviation_mm: &[Vec3]) -> Vec<MeasuredPoint> {
    let contacts = cone.tool_positions();
    let contacts = contacts.iter().flat_map(|p| p.contacts.iter().map(move |c| (p, c)));
    contacts
        .zip(deviation_mm)
        .map(|((position, contact), deviation)| {
            let normal = contact.normal.vector();
            let axis = position.tip.along(position.axis, contact.along_axis_mm).vector();
            let radius_mm = 0.5 * cone.size().tool_diameter_mm;
            let place_mm = axis - normal * radius_mm + normal * normal.dot(deviation);
            MeasuredPoint { place_mm, section: contact.section }
        })
        .collect()
}

fn values(cone: &Cone, points: &[MeasuredPoint]) -> Vec<Option<f64>> {
    let found = cone.measured(points, 0.0).unwrap();
    found.iter().map(|i| i.map(|i| i.value_mm)).collect()
}

proptest! {
    /// Round trip: the indices of the cut come back from its points, in any order of the rows.
    #[test]
    fn law_points_of_a_cut_have_its_indices(
        parts in prop::collection::vec(prop::array::uniform3(-0.05..0.05f64), 6),
        shift in 0usize..288,
    ) {
        let cone = cone();
        let deviations: Vec<Vec3> = (0..288).map(|i| {
            let (azimuth, height) = (TAU * f64::from(i / 4) / 72.0, f64::from(i % 4));
            let vector = |k: usize| Vec3::from_row_slice(&parts[k]);
            vector(0) + vector(1) * azimuth.cos() + vector(2) * azimuth.sin()
                + (vector(3) + vector(4) * (2.0 * azimuth).cos()) * (0.2 * height)
                + vector(5) * (0.1 * (3.0 * azimuth).sin())
        }).collect();
        let mut cut = vec![0.0; 11];
        cone.evaluate(&CutSurface::about_ideal_axis(&deviations), &mut cone.scratch(), &mut cut).unwrap();
        let mut measured = points(&cone, &deviations);
        measured.rotate_left(shift);
        if shift % 2 == 1 {
            measured.reverse();
        }
        for (i, found) in values(&cone, &measured).into_iter().enumerate() {
            match found {
                Some(value) => prop_assert!((value - cut[i]).abs() < 1e-9, "{i}: {value} {}", cut[i]),
                None => prop_assert!([2, 3, 10].contains(&i)),
            }
        }
    }
}

#[test]
fn u_of_the_coaxiality_is_that_of_the_least_squares_centre() {
    // n points around a circle: u of a coordinate of the centre is √(2/n) u of a radius, and of the diameter
    // 2 e twice that. 72 points, u = 0.7 µm along the normal: 2 √(2/72) 0.7 / cos 15° = 0.2416 µm.
    let cone = cone();
    let off = vec![Vec3::new(0.030, 0.010, 0.0); 288];
    let found = cone.measured(&points(&cone, &off), 0.0007).unwrap();
    let u = found[8].unwrap().u_mm;
    assert!((u - 0.000_241_56).abs() < 1e-7, "{u}");
    assert!((found[8].unwrap().value_mm - 2.0 * 0.030f64.hypot(0.010)).abs() < 1e-5);
    // Two outer and two inner contacts: between u and √2 u of a radius.
    let mzc = found[5].unwrap().u_mm;
    assert!(mzc < 0.0007 * 2.0 / 15f64.to_radians().cos(), "{mzc}");
}

#[test]
fn points_that_cannot_be_of_this_part_are_named() {
    let cone = cone();
    let good = points(&cone, &cone.ideal_deviation_mm());
    let fault = |change: &dyn Fn(&mut Vec<MeasuredPoint>)| {
        let mut points = good.clone();
        change(&mut points);
        cone.measured(&points, 0.0).unwrap_err()
    };
    assert_eq!(fault(&|p| p[7].place_mm.x = f64::NAN), MeasuredFault::NotFinite { point: 7 });
    assert_eq!(fault(&|p| p[3].section = 4), MeasuredFault::NoSection { point: 3, section: 4 });
    assert_eq!(fault(&|p| p.push(good[12])), MeasuredFault::Duplicate { point: 288, first: 12 });
    let from_the_base = fault(&|p| p.iter_mut().for_each(|p| p.place_mm.z += 60.0));
    assert!(
        matches!(from_the_base, MeasuredFault::OtherHeight { point: 0, off_mm } if (off_mm - 60.0).abs() < 1e-9)
    );
    let beside = fault(&|p| p.iter_mut().for_each(|p| p.place_mm.x += 5.0));
    assert!(matches!(beside, MeasuredFault::OffSurface { point: 0, .. }));
    let few = fault(&|p| p.retain(|q| q.section != 1 || q.place_mm.x > 110.0));
    assert!(matches!(
        few,
        MeasuredFault::TooFew { section: 1, .. } | MeasuredFault::Arc { section: 1, .. }
    ));
    // A section without points is not an error; its indices are not known.
    let mut without = good.clone();
    without.retain(|p| p.section != 2);
    let found = values(&cone, &without);
    assert!(found[9].is_none() && found[5].is_some());
}

#[test]
fn centres_of_the_ball_are_moved_to_the_surface() {
    let cone = cone();
    let good = points(&cone, &vec![Vec3::new(0.02, 0.0, 0.01); 288]);
    let positions = cone.tool_positions();
    let normals = positions.iter().flat_map(|p| p.contacts.iter().map(|c| c.normal.vector()));
    let back = good.iter().zip(normals).map(|(p, n)| {
        let place_mm = cone.contact_mm(p.place_mm + n * 1.5, 1.5);
        MeasuredPoint { place_mm, ..*p }
    });
    for (a, b) in values(&cone, &good).into_iter().zip(values(&cone, &back.collect::<Vec<_>>())) {
        assert!((a.unwrap_or(0.0) - b.unwrap_or(0.0)).abs() < 1e-12);
    }
}
