//! Surfaces that the drawing leaves to the program: their points lie where the nominal cut ends.

use super::{PartStudy, nails_of};
use trueaxis_cut::{Cut, Nail, Reach, Sweep, cut};
use trueaxis_geometry::surface::SurfacePoint;
use trueaxis_input::{Diagnostics, Place};
use trueaxis_part::part::{Feature, Geometry, Part};

/// A surface seen at a flatter angle than this gives no point. Unit: 1.
const FLATTEST_COS: f64 = 0.1;
/// A point is on the surface if the nail along its normal ends there, too; at the crest of a cusp another track ends it. Unit: mm.
const SAME_MM: f64 = 1e-5;

/// The part with the points of its programmed surfaces, and for each feature, where that was found on the way, what the nominal cut leaves
/// of its nails.
///
/// # Errors
/// A surface without points.
pub(super) fn completed(
    study: &PartStudy,
    nominal: &[Sweep],
    problems: &mut Diagnostics,
) -> Option<(Part, Vec<Option<Vec<Reach>>>)> {
    let mut part = study.part.clone();
    let mut known = vec![None; part.features.len()];
    let mut sound = true;
    for (feature, known) in part.features.iter_mut().zip(&mut known) {
        let Geometry::Programmed { normal, depth_mm, .. } = feature.geometry else { continue };
        let seen = feature.points.len();
        let nail = |p: &SurfacePoint| Nail {
            foot_mm: p.point_mm - normal * depth_mm,
            normal,
            below_mm: 0.0,
            above_mm: depth_mm,
        };
        let nails: Vec<Nail> = feature.points.iter().map(nail).collect();
        let reaches = cut(nominal, &nails);
        let point = |(nail, reach): (&Nail, &Reach)| match reach {
            Reach::Cut(cut) => surface_point(nail, cut),
            Reach::Deeper(_) | Reach::NotCut => None,
        };
        let points: Vec<Option<SurfacePoint>> = nails.iter().zip(&reaches).map(point).collect();
        feature.keep(&points.iter().map(Option::is_some).collect::<Vec<_>>());
        feature.points = points.into_iter().flatten().collect();
        *known = Some(keep_smooth(feature, nominal));
        let (count, name) = (feature.points.len(), &feature.name);
        let place = Place::whole(&study.part_file);
        if count == 0 {
            sound = false;
            let message = format!(
                "`{name}`: none of {seen} lines of sight ends on a surface that the program cuts"
            );
            let hint = "within `depth` beyond the rectangle: another place, normal or depth";
            problems.error("not-cut", place, message, hint);
        } else if count < seen {
            let message = format!(
                "`{name}`: {count} of {seen} lines of sight end on a smooth surface that the program cuts; the others are not checked"
            );
            let hint = "beside the cut, through it, at its edges and along it there is none";
            problems.note("points-left-out", place, message, hint);
        }
    }
    sound.then_some((part, known))
}

fn surface_point(nail: &Nail, cut: &Cut) -> Option<SurfacePoint> {
    let point_mm = nail.foot_mm + nail.normal * cut.deviation_mm;
    let normal = -cut.out;
    let is_seen = normal.dot(&nail.normal) > FLATTEST_COS;
    is_seen.then_some(SurfacePoint { point_mm, normal, axis: normal, line: 0 })
}

/// Without the points where the nail along the normal ends elsewhere; the ends of the nails of the others.
fn keep_smooth(feature: &mut Feature, nominal: &[Sweep]) -> Vec<Reach> {
    let ends = cut(nominal, &nails_of(feature));
    let is_smooth =
        |reach: &Reach| matches!(reach, Reach::Cut(cut) if cut.deviation_mm.abs() < SAME_MM);
    feature.keep(&ends.iter().map(is_smooth).collect::<Vec<_>>());
    ends.into_iter().filter(is_smooth).collect()
}
