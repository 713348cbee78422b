//! A profile through a Gaussian filter, as points again.

use super::{Filter, FormEvaluation, FormRequest, across};
use std::f64::consts::TAU;
use trueaxis_form::filter::{POINTS_PER_UNDULATION, closed, even, open, transmission};
use trueaxis_form::{Element, Fitted, Known, fit};
use trueaxis_geometry::Vec3;
use trueaxis_input::{Diagnostics, Place};

pub(super) struct Filtered {
    pub fitted: Fitted,
    pub points_mm: Vec<Vec3>,
    pub normal: Vec3,
    /// By how much the filter makes the noise of a point smaller.
    pub gain: f64,
}

/// The gap that a filter cannot bridge: beyond this part of a turn a circle is no closed profile.
const LARGEST_GAP: f64 = TAU / 12.0;

pub(super) fn apply(
    request: &FormRequest<'_>,
    filter: Filter,
    read: &FormEvaluation,
    problems: &mut Diagnostics,
) -> Option<Filtered> {
    match (request.element, filter) {
        (Element::Circle, Filter::Undulations(n)) => round(request, n, read, problems),
        (Element::Line, Filter::CutOff(mm)) => straight(request, mm, read, problems),
        (Element::Circle, _) => refuse(request, "a circle is filtered by undulations", problems),
        (Element::Line, _) => refuse(request, "a line is filtered by a length", problems),
        _ => refuse(request, "only profiles are filtered", problems),
    }
}

fn refuse<T>(request: &FormRequest<'_>, why: &str, problems: &mut Diagnostics) -> Option<T> {
    let message = format!("{why}, not a {}", request.element.key());
    let message = if why.starts_with("only") { message } else { why.to_owned() };
    let hint = "--filter \"gauss 50 upr\" for a circle, --filter \"gauss 0.8 mm\" for a line";
    problems.error("filter-element", Place::whole("--filter"), message, hint);
    None
}

/// Too few points for the filter: an error where waves that pass cannot be seen at all.
fn enough(
    request: &FormRequest<'_>,
    points_per_wave: f64,
    what: &str,
    problems: &mut Diagnostics,
) -> Option<()> {
    let message = format!("{points_per_wave:.1} points for each {what} at the cut-off");
    let place = Place::whole(request.file);
    // Fewer undulations, longer waves.
    let other = if what == "wave" { "longer" } else { "lower" };
    let hint =
        format!("7 are recommended (ISO 12181-2): measure more points, or take a {other} cut-off");
    if points_per_wave < 2.0 {
        problems.error("filter-points", place, message, &hint);
        return None;
    }
    if points_per_wave < POINTS_PER_UNDULATION {
        problems.warn("filter-points", place, message, &hint);
    }
    Some(())
}

fn uneven(request: &FormRequest<'_>, problems: &mut Diagnostics) {
    let message =
        "the points are unevenly spaced: the filter works on values between them".to_owned();
    let hint = "straight lines between neighbours lower short waves; measure at even steps";
    problems.warn("filter-uneven", Place::whole(request.file), message, hint);
}

fn too_many<T>(request: &FormRequest<'_>, problems: &mut Diagnostics) -> Option<T> {
    let message = "the points are far more than the filter needs".to_owned();
    let hint = "keep every tenth point: 7 for each undulation at the cut-off are enough";
    problems.error("filter-points", Place::whole(request.file), message, hint);
    None
}

fn round(
    request: &FormRequest<'_>,
    undulations: f64,
    read: &FormEvaluation,
    problems: &mut Diagnostics,
) -> Option<Filtered> {
    let shape = *read.fitted.shape();
    let normal = shape.direction;
    let (x, y) = across(&normal);
    let polar: Vec<(f64, f64)> = read
        .points_mm
        .iter()
        .map(|p| {
            let v = p - shape.point_mm;
            (v.dot(&y).atan2(v.dot(&x)), shape.deviation_mm(p))
        })
        .collect();
    if read.cover.angle_rad.is_some_and(|a| TAU - a > LARGEST_GAP) {
        let message = "the profile is not closed: a gap of more than 30°".to_owned();
        let hint = "a filter in undulations per revolution needs the whole circumference";
        problems.error("filter-element", Place::whole(request.file), message, hint);
        return None;
    }
    enough(request, polar.len() as f64 / undulations, "undulation", problems)?;
    let profile = even(&polar, Some(TAU))?;
    if profile.is_interpolated {
        uneven(request, problems);
    }
    let Some(values) = closed(&profile.values, undulations) else {
        return too_many(request, problems);
    };
    let n = values.len() as f64;
    let point = |(k, v): (usize, f64)| {
        let (sin, cos) = (profile.first + profile.step * k as f64).sin_cos();
        shape.point_mm + (x * cos + y * sin) * (shape.radius_mm + v)
    };
    let points_mm: Vec<Vec3> = values.into_iter().enumerate().map(point).collect();
    let mut passed = 1.0;
    let mut harmonic = 1.0;
    while 2.0 * harmonic < n && harmonic < 7.0 * undulations {
        passed += 2.0 * transmission(harmonic / undulations).powi(2);
        harmonic += 1.0;
    }
    let fitted =
        fit(Element::Circle, &points_mm, &Known { normal: Some(normal), ..Known::default() })
            .ok()?;
    Some(Filtered { fitted, points_mm, normal, gain: (passed / n).sqrt().min(1.0) })
}

fn straight(
    request: &FormRequest<'_>,
    cut_off_mm: f64,
    read: &FormEvaluation,
    problems: &mut Diagnostics,
) -> Option<Filtered> {
    let Some(normal) = read.normal else {
        return refuse(request, "a line in space has no profile: give two coordinates", problems);
    };
    let shape = *read.fitted.shape();
    let side = normal.cross(&shape.direction);
    let along = |p: &Vec3| (p - shape.point_mm).dot(&shape.direction);
    let profile: Vec<(f64, f64)> =
        read.points_mm.iter().map(|p| (along(p), (p - shape.point_mm).dot(&side))).collect();
    let profile = even(&profile, None)?;
    enough(request, cut_off_mm / profile.step, "wave", problems)?;
    if profile.is_interpolated {
        uneven(request, problems);
    }
    let length = profile.step * (profile.values.len() as f64 - 1.0);
    let Some((first, values)) = open(&profile.values, profile.step, cut_off_mm) else {
        if length > cut_off_mm {
            return too_many(request, problems);
        }
        let message = format!("the profile of {length:.3} mm is not longer than the cut-off");
        let hint = "half a cut-off at either end is left out: take a shorter one";
        problems.error("filter-points", Place::whole("--filter"), message, hint);
        return None;
    };
    let point = |(k, v): (usize, f64)| {
        let t = profile.first + profile.step * (first + k) as f64;
        shape.point_mm + shape.direction * t + side * v
    };
    let points_mm: Vec<Vec3> = values.into_iter().enumerate().map(point).collect();
    let fitted =
        fit(Element::Line, &points_mm, &Known { normal: Some(normal), ..Known::default() }).ok()?;
    // ∫ s² dx of the weights is 1/(√2 α λc), α = 0.4697.
    let gain = (profile.step / (std::f64::consts::SQRT_2 * 0.4697 * cut_off_mm)).sqrt().min(1.0);
    Some(Filtered { fitted, points_mm, normal, gain })
}
