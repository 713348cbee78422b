//! What speaks against points and against a result.

use super::{FormEvaluation, FormRequest, place};
use trueaxis_form::checks::{Cover, SMALL_ARC_RAD, gross};
use trueaxis_form::{Criterion, Element, Error, Fitted, Proof, Source};
use trueaxis_geometry::Vec3;
use trueaxis_input::{Diagnostics, Place};

/// A plane or axis with less width or length than this part of its length or radius.
const NARROW: f64 = 0.1;
/// Points that deviate by more than this part of their size are not those of the element.
const NOT_THE_ELEMENT: f64 = 0.1;

pub(super) fn no_element(
    request: &FormRequest<'_>,
    error: &Error,
    lines: &[usize],
    problems: &mut Diagnostics,
) {
    let key = request.element.key();
    let message = format!("no {key} through the points: {error}");
    let at = match error {
        Error::NotFinite { index } => place(request.file, lines.get(*index).copied().unwrap_or(0)),
        _ => Place::whole(request.file),
    };
    let needed = request.element.unknowns();
    let hint =
        format!("a {key} needs at least {needed} different points, better 20 or more, all over it");
    problems.error("no-element", at, message, &hint);
}

pub(super) fn of_points(
    request: &FormRequest<'_>,
    fitted: &Fitted,
    points_mm: &[Vec3],
    lines: &[usize],
    cover: Cover,
    problems: &mut Diagnostics,
) {
    covered(request, fitted, cover, problems);
    let size = points_mm.iter().map(|p| (p - fitted.shape().point_mm).norm()).fold(0.0, f64::max);
    let form = fitted.references[0].form_mm();
    if form > NOT_THE_ELEMENT * size {
        let key = request.element.key();
        let message =
            format!("the points deviate by {form:.3} mm from a {key}, their size is {size:.3} mm");
        let hint = "is that the element, and are the units of all columns right?";
        problems.warn("form-wrong-element", Place::whole(request.file), message, hint);
    }
    if let Some(found) = gross(fitted, points_mm) {
        let line = lines.get(found.index).copied().unwrap_or(0);
        let message = format!(
            "this point deviates by {:.1} µm from the least-squares {}: {:.1} standard deviations of the others (limit \
             {:.1})",
            found.deviation_mm * 1e3,
            request.element.key(),
            found.size,
            found.limit
        );
        let hint = "dirt, a burr or a wrong touch? It counts; measure it again, or leave it out with a reason";
        problems.warn("form-gross-point", place(request.file, line), message, hint);
    }
}

/// Too little of the element has points.
fn covered(request: &FormRequest<'_>, fitted: &Fitted, cover: Cover, problems: &mut Diagnostics) {
    let mut warn = |message: String| {
        let hint =
            "what lies beyond is not known, and U of the values is large: measure more of it";
        problems.warn("form-cover", Place::whole(request.file), message, hint);
    };
    let key = request.element.key();
    if let Some(angle) = cover.angle_rad
        && angle < SMALL_ARC_RAD
    {
        warn(format!("the points cover {:.0}° of the {key} only", angle.to_degrees()));
    }
    if let Some(ratio) = cover.ratio
        && ratio < NARROW
    {
        warn(match request.element {
            Element::Plane => format!(
                "the points are {ratio:.3} times as wide as long: its tilt across is uncertain"
            ),
            _ => format!(
                "the points cover a length of {ratio:.3} radii: the direction of the {key} is uncertain"
            ),
        });
    }
    if !fitted.is_determined {
        warn(format!("the points do not determine all values of the {key}"));
    }
}

pub(super) fn of_result(
    request: &FormRequest<'_>,
    found: &FormEvaluation,
    problems: &mut Diagnostics,
) {
    let whole = || Place::whole(request.file);
    let wanted = request.reference;
    if found.fitted.reference(wanted).is_none() {
        let exists = request.element.criteria().contains(&wanted);
        let message = match exists {
            true => format!("the points have no {} {}", wanted.name(), request.element.key()),
            false => format!("a {} has no {} element", request.element.key(), wanted.name()),
        };
        let hint = "an inscribed element needs points all around; the other references are below";
        if exists {
            problems.warn("no-reference", whole(), message + ": least squares is used", hint);
        } else {
            problems.error("no-reference", Place::whole("--reference"), message, "take LSC or MZC");
        }
    }
    for reference in &found.fitted.references {
        if reference.proof == Some(Proof::None) {
            let message =
                format!("the {} element is not proved to be the best", reference.criterion.name());
            let hint =
                "its form deviation is that of an element near the best one; more points help";
            problems.warn("form-not-proved", whole(), message, hint);
        }
    }
    if found.of_point.is_none() {
        let message =
            "no U of the form deviation: nothing is known of the uncertainty of a point".to_owned();
        problems.warn("form-no-uncertainty", whole(), message, "state it: --u \"1 um\"");
    }
    match found.uncertainty.map(|u| u.of_point.source) {
        Some(Source::Scatter) => {
            let message =
                "no u of a point is stated: U of the values is from the scatter".to_owned();
            let hint = "form deviations are in the scatter; of a profile U of the form deviation is from \
                        neighbouring points. State u: --u \"1 um\"";
            problems.note("form-scatter", whole(), message, hint);
        }
        Some(Source::LargerScatter) => larger_scatter(request, found, problems),
        _ => {}
    }
    if found.fitted.degrees_of_freedom == 0 && wanted != Criterion::LeastSquares {
        let message = "as many points as unknowns: there is no form deviation to see".to_owned();
        problems.warn("form-few-points", whole(), message, "measure more points");
    }
}

fn larger_scatter(request: &FormRequest<'_>, found: &FormEvaluation, problems: &mut Diagnostics) {
    let (Some(stated), Some(u)) = (request.u_mm, found.uncertainty) else { return };
    let message = format!(
        "the points scatter by {:.2} µm about least squares, more than the stated u of {:.2} µm",
        u.of_point.u_mm * 1e3,
        stated * 1e3
    );
    let hint = "the form deviation is sampled by these points only: U of the values is from the scatter, \
                that of the form deviation from the stated u";
    problems.note("form-scatter", Place::whole(request.file), message, hint);
}
