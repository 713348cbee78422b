//! Is enough wall left, and does the cutter touch only where it should?

use super::near::{Stand, Stands};
use super::offset::MovedPlace;
use super::study::{AdaptStudy, Follow, Inner};
use rayon::prelude::*;
use trueaxis_geometry::Vec3;

/// Why the adapted path may not be cut, and where.
#[derive(Debug, Clone, PartialEq)]
pub struct Finding {
    /// A name for programs: `thin-wall`, `gouge`, `folded-path`.
    pub code: &'static str,
    /// The line of the path.
    pub line: u32,
    /// At how many places it is so; this is the worst.
    pub places: usize,
    /// In words.
    pub message: String,
}

/// The wall that is expected at a place of the path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Remaining {
    /// mm.
    pub wall_mm: f64,
    /// Standard uncertainty.
    pub u_mm: f64,
}

/// What should remain of the wall where the tool touches.
///
/// w = t − a (+ d where the inner surface stands), u² = u_t² + u_d²     docs/model.md eq. 153
pub fn remaining_wall(study: &AdaptStudy, deviation_mm: f64, u_mm: f64) -> Remaining {
    let wall = &study.wall;
    let moved = if wall.inner == Inner::Nominal { deviation_mm } else { 0.0 };
    Remaining {
        wall_mm: wall.thickness_mm - wall.layer_mm + moved,
        u_mm: wall.u_thickness_mm.hypot(u_mm),
    }
}

pub(super) fn check(study: &AdaptStudy, places: &[MovedPlace]) -> Vec<Finding> {
    let mut findings = Vec::new();
    findings.extend(thin_walls(study, places));
    findings.extend(folds(places));
    findings.extend(gouges(study, places));
    findings
}

/// The worst of several, with their number.
fn worst(
    code: &'static str,
    found: Vec<(u32, f64)>,
    words: impl Fn(f64) -> String,
) -> Option<Finding> {
    let places = found.len();
    let (line, value) = found.into_iter().max_by(|a, b| a.1.total_cmp(&b.1))?;
    Some(Finding { code, line, places, message: words(value) })
}

fn thin_walls(study: &AdaptStudy, places: &[MovedPlace]) -> Option<Finding> {
    let least = study.wall.least_mm;
    let thin = places.iter().filter_map(|p| {
        let c = p.contact?;
        let r = remaining_wall(study, c.deviation_mm, c.u_mm);
        let lower = r.wall_mm - 2.0 * r.u_mm;
        (lower < least).then_some((p.line, -lower))
    });
    worst("thin-wall", thin.collect(), |lower| {
        format!(
            "the wall may be as thin as {:.4} mm (expected less U, k = 2), less than the least {least} mm",
            -lower
        )
    })
}

/// Where the offset turns the path back on itself: the surface bends more sharply than the offset
/// allows.
fn folds(places: &[MovedPlace]) -> Option<Finding> {
    let folded = places.windows(2).filter_map(|pair| {
        pair[0].contact?;
        pair[1].contact?;
        let way =
            |f: &dyn Fn(&MovedPlace) -> [f64; 3]| Vec3::from(f(&pair[1])) - Vec3::from(f(&pair[0]));
        let (before, after) = (way(&|p| p.nominal.tip_mm), way(&|p| p.adapted.tip_mm));
        let back = before.norm() > 1e-6 && before.dot(&after) <= 0.0;
        back.then_some((pair[1].line, before.norm()))
    });
    worst("folded-path", folded.collect(), |_| {
        "the moved path runs backwards: the surface bends more sharply than the offset allows"
            .into()
    })
}

/// How deep the cutter enters the wanted surface at the places that other parts of the path cut.
///
/// g = −min D(x_j) over the wanted places within the cutter's reach       docs/model.md eq. 154
fn gouges(study: &AdaptStudy, places: &[MovedPlace]) -> Option<Finding> {
    let cutter = &study.cutter;
    // The wanted places as "stands" whose tips are points of the surface.
    let wanted: Vec<Stand> = places
        .iter()
        .filter_map(|p| p.contact.map(|c| Stand { tip: c.wanted_mm, axis: c.foot.normal }))
        .collect();
    let wanted = Stands::of(wanted);
    let reach = Stands::reach(cutter, 0.0);
    let deep: Vec<(u32, f64)> = places
        .par_iter()
        .filter_map(|p| {
            p.contact?;
            let (tip, axis) = surface_side(study, p);
            let depth = wanted
                .near(&(tip + axis * cutter.corner_mm), reach)
                .map(|w| -cutter.distance(&tip, &axis, &w.tip))
                .fold(0.0, f64::max);
            (depth > study.bounds.gouge_mm).then_some((p.line, depth))
        })
        .collect();
    worst("gouge", deep, |depth| {
        format!(
            "the cutter enters the wanted surface next to it by {:.1} µm (allowed {:.1} µm): it is too \
             large for this hollow, or the path jumps",
            depth * 1e3,
            study.bounds.gouge_mm * 1e3
        )
    })
}

/// The tool against the wanted surface, both where the nominal part is.
fn surface_side(study: &AdaptStudy, p: &MovedPlace) -> (Vec3, Vec3) {
    match (study.follow, p.contact) {
        (Follow::Blank, Some(c)) => {
            // The wanted places have the whole deviation along the normals, so the tool has, too.
            let (axis, normal) = (Vec3::from(p.nominal.axis), c.foot.normal);
            (c.wanted_mm - study.cutter.contact(&axis, &normal), axis)
        }
        _ => (Vec3::from(p.adapted.tip_mm), Vec3::from(p.adapted.axis)),
    }
}
