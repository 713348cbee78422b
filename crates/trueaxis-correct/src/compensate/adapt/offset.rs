//! The path, moved onto the blank.

use super::field::Field;
use super::study::{AdaptStudy, Follow, PathAt};
use super::surface::{Foot, NominalSurface, tangent};
use rayon::prelude::*;
use trueaxis_cl::{ClPoint, Word};
use trueaxis_geometry::Vec3;
use trueaxis_input::{Diagnostics, Place};

/// For slopes of the field, mm.
const STEP_MM: f64 = 0.05;
/// More lines of one kind say nothing new.
pub(super) const MOST_NAMED: usize = 10;
/// A surface leaning away from the tool by more than this sine cannot be cut from above.
const UNDERCUT: f64 = 0.1;

/// Where the cutter touches, and how far the blank is off there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contact {
    /// The foot on the nominal blank.
    pub foot: Foot,
    /// The blank there along the normal, mm.
    pub deviation_mm: f64,
    /// Standard uncertainty.
    pub u_mm: f64,
    /// How far the cutter was moved along the normal, mm.
    pub moved_mm: f64,
    /// Where the surface is wanted: a layer below the blank.
    pub wanted_mm: Vec3,
}

/// One place of the tool, before and after.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MovedPlace {
    /// The line of the file.
    pub line: u32,
    /// As it was programmed.
    pub nominal: ClPoint,
    /// As it is to be cut.
    pub adapted: ClPoint,
    /// `None` where nothing is cut: rapid, or above the blank.
    pub contact: Option<Contact>,
}

/// Moves all places of the path; problems are named with the line of the path.
pub(super) fn move_path(
    study: &AdaptStudy,
    field: &Field,
    problems: &mut Diagnostics,
) -> Vec<MovedPlace> {
    refuse_curves(study, problems);
    let surface = NominalSurface::of(&study.points);
    let points: Vec<(u32, ClPoint)> = study.path.points().map(|(l, p)| (l, *p)).collect();
    let mut places: Vec<(MovedPlace, Option<Reach>)> = points
        .par_iter()
        .map(|(line, point)| {
            let (contact, fault) = match point.rapid {
                true => (None, None),
                false => contact(study, field, &surface, point),
            };
            let adapted = contact.map_or(*point, |c| moved(study, field, point, &c));
            (MovedPlace { line: *line, nominal: *point, adapted, contact }, fault)
        })
        .collect();
    name_faults(study, &places, problems);
    follow_in_air(study, field, &mut places);
    places.into_iter().map(|(place, _)| place).collect()
}

/// Why a place cannot be moved.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Reach {
    /// So far from any probed point, mm.
    Beyond(f64),
    /// The surface leans away from the tool.
    Away,
}

fn contact(
    study: &AdaptStudy,
    field: &Field,
    surface: &NominalSurface,
    point: &ClPoint,
) -> (Option<Contact>, Option<Reach>) {
    let (tip, axis) = (Vec3::from(point.tip_mm), Vec3::from(point.axis));
    // The normal is that next to the middle of the corner circle's ball, then next to the contact.
    let cutter = &study.cutter;
    let mut foot = surface.foot(&(tip + axis * cutter.corner_mm));
    for _ in 0..2 {
        foot = surface.foot(&(tip + cutter.contact(&axis, &foot.normal)));
    }
    if foot.from_nearest_mm > study.bounds.reach_mm || !foot.height_mm.is_finite() {
        return (None, Some(Reach::Beyond(foot.from_nearest_mm)));
    }
    if foot.height_mm > study.bounds.air_mm {
        return (None, None);
    }
    let away = foot.normal.dot(&axis) < -UNDERCUT;
    let estimate = field.at(&foot.at_mm, &foot.normal);
    let wall = &study.wall;
    let still = if wall.path_at == PathAt::Blank { wall.layer_mm } else { 0.0 };
    let along = match study.follow {
        Follow::Normals => estimate.deviation_mm,
        Follow::Blank => estimate.form_mm,
    };
    let moved_mm = along - still + raised_for_slope(study, field, &foot, &axis);
    // From the tool, not from the foot: points far apart tell normals better than heights.
    let touched = tip + cutter.contact(&axis, &foot.normal);
    let contact = Contact {
        foot,
        deviation_mm: estimate.deviation_mm,
        u_mm: estimate.u_mm,
        moved_mm,
        wanted_mm: touched + foot.normal * (estimate.deviation_mm - still),
    };
    (Some(contact), away.then_some(Reach::Away))
}

/// Where the offset changes along the surface, the moved surface is tilted; the cutter is raised so
/// that it touches the tilted surface instead of entering it.
///
/// δ = d + n'·(o(n) − o(n'))/(n'·n), n' ∥ n − ∇d                 docs/model.md eq. 152
fn raised_for_slope(study: &AdaptStudy, field: &Field, foot: &Foot, axis: &Vec3) -> f64 {
    let n = foot.normal;
    let e1 = tangent(&n);
    let e2 = n.cross(&e1);
    let value = |p: Vec3| match study.follow {
        Follow::Normals => field.deviation_mm(&p, &n),
        Follow::Blank => field.form_mm(&p, &n),
    };
    let slope = |e: &Vec3| {
        (value(foot.at_mm + e * STEP_MM) - value(foot.at_mm - e * STEP_MM)) / (2.0 * STEP_MM)
    };
    let gradient = e1 * slope(&e1) + e2 * slope(&e2);
    let tilted = (n - gradient).normalize();
    let cutter = &study.cutter;
    tilted.dot(&(cutter.contact(axis, &n) - cutter.contact(axis, &tilted))) / tilted.dot(&n)
}

fn moved(study: &AdaptStudy, field: &Field, point: &ClPoint, contact: &Contact) -> ClPoint {
    let tip = Vec3::from(point.tip_mm) + contact.foot.normal * contact.moved_mm;
    carried(study, field, point, tip)
}

/// With the blank, where the path follows it as a whole.
fn carried(study: &AdaptStudy, field: &Field, point: &ClPoint, tip: Vec3) -> ClPoint {
    let (tip, axis) = match study.follow {
        Follow::Normals => (tip, Vec3::from(point.axis)),
        Follow::Blank => {
            let turned = field.registration.rotation() * Vec3::from(point.axis);
            (field.registration.carry(&tip), turned.normalize())
        }
    };
    ClPoint { tip_mm: tip.into(), axis: axis.into(), ..*point }
}

/// Where nothing is cut, the tool goes as it does at the nearest place of the path that is cut, so
/// that approach and retraction stay what they were.
fn follow_in_air(study: &AdaptStudy, field: &Field, places: &mut [(MovedPlace, Option<Reach>)]) {
    let shifts: Vec<Option<Vec3>> =
        places.iter().map(|(p, _)| p.contact.map(|c| c.foot.normal * c.moved_mm)).collect();
    let mut next = vec![None; places.len()];
    let mut seen = None;
    for i in (0..places.len()).rev() {
        seen = shifts[i].map(|s| (i, s)).or(seen);
        next[i] = seen;
    }
    let mut before: Option<(usize, Vec3)> = None;
    for (i, (place, _)) in places.iter_mut().enumerate() {
        before = shifts[i].map(|s| (i, s)).or(before);
        if place.contact.is_some() {
            continue;
        }
        let shift = match (before, next[i]) {
            (Some((b, shift)), Some((n, _))) if i - b <= n - i => shift,
            (_, Some((_, shift))) | (Some((_, shift)), None) => shift,
            (None, None) => continue,
        };
        let tip = Vec3::from(place.nominal.tip_mm) + shift;
        place.adapted = carried(study, field, &place.nominal, tip);
    }
}

fn name_faults(
    study: &AdaptStudy,
    places: &[(MovedPlace, Option<Reach>)],
    problems: &mut Diagnostics,
) {
    let file = study.path.name();
    let place = |line: u32| Place { file: file.to_owned(), line: line as usize, column: 1 };
    let beyond: Vec<(u32, f64)> = places
        .iter()
        .filter_map(|(p, fault)| match fault {
            Some(Reach::Beyond(mm)) => Some((p.line, *mm)),
            _ => None,
        })
        .collect();
    let count = beyond.len();
    let most = study.bounds.reach_mm;
    let hint = "probe there too, make the motion RAPID if it cuts nothing, or check the units of \
                path and table (UNITS/MM or INCHES, x_mm)";
    for (line, mm) in beyond.iter().take(MOST_NAMED) {
        let message = format!(
            "the tool cuts {mm:.2} mm from the nearest probed point, farther than the field is \
             trusted ([field] reach = \"{most} mm\"); {count} of {} places of the path do",
            places.len()
        );
        problems.error("beyond-probed", place(*line), message, hint);
    }
    let away: Vec<u32> = places
        .iter()
        .filter(|(_, fault)| *fault == Some(Reach::Away))
        .map(|(p, _)| p.line)
        .collect();
    let cut = places.iter().filter(|(p, _)| p.contact.is_some()).count();
    for line in away.iter().take(MOST_NAMED) {
        let message = format!(
            "the surface there looks away from the tool, at {} of {cut} places that are cut",
            away.len()
        );
        let hint = format!(
            "i, j, k of {} point out of the material; were the hits taken from the other side?",
            study.table
        );
        problems.error("wrong-side", place(*line), message, &hint);
    }
    if cut == 0 && count == 0 {
        let message = "the path touches the probed surface nowhere".to_owned();
        let hint = "do path and table belong to one part and one part zero?";
        problems.error("nothing-cut", Place::whole(file), message, hint);
    }
}

/// A circle that is moved along normals is no circle any more.
fn refuse_curves(study: &AdaptStudy, problems: &mut Diagnostics) {
    let curves = study.path.records().iter().filter_map(|r| match r.word {
        Word::Circle(_) => Some((r.line, "CIRCLE")),
        Word::Arc(..) => Some((r.line, "TLON,GOFWD")),
        Word::Cycle(_) => Some((r.line, "CYCLE")),
        _ => None,
    });
    for (line, word) in curves.take(MOST_NAMED) {
        let place = Place { file: study.path.name().to_owned(), line: line as usize, column: 1 };
        let message = format!("{word} cannot be moved along normals");
        problems.error("curve", place, message, "let the CAM system write points");
    }
}
