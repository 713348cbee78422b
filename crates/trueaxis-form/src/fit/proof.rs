//! What is proved of the elements of contact points (docs/model.md eq. 229 and 230).

use super::{Cloud, Minimax, Proof};
use crate::{Criterion, Element, profile};
use trueaxis_geometry::Vec3;

/// A slope that rounding leaves.
const NO_SLOPE: f64 = 1e-5;

pub(super) fn of(
    element: Element,
    criterion: Criterion,
    cloud: &Cloud,
    found: &Minimax,
    [starts, agreed]: [usize; 2],
) -> Proof {
    let form = found.high - found.low;
    if form < 1e-14 {
        return Proof::Global;
    }
    // A slope acts over lengths of the order of the form deviation.
    if found.slope > NO_SLOPE {
        return Proof::None;
    }
    let local = Proof::Local { starts, agreed };
    match (element, criterion) {
        (Element::Plane, _) => plane(cloud, found).unwrap_or(local),
        (Element::Sphere, Criterion::MinimumCircumscribed) => Proof::Global,
        (Element::Sphere, criterion) => sphere(criterion, cloud, found).unwrap_or(local),
        _ => local,
    }
}

/// A plane that is tilted by θ has a zone of at least D sin θ − w cos θ, D the least width of the points in the plane;
/// below that angle at least w cos θ.
fn plane(cloud: &Cloud, found: &Minimax) -> Option<Proof> {
    let flat: Vec<[f64; 2]> =
        cloud.points.iter().map(|p| found.frame.local(p).xy().into()).collect();
    let across = profile::narrowest(&flat)?.width;
    let form = found.high - found.low;
    let tilt = 2.0 * (form / across).atan();
    (tilt < 1.0).then(|| Proof::Bound(form * tilt.cos() * cloud.size))
}

/// Centres that are not worse are near, as far as the points surround the sphere; within that distance the sum of the
/// contact points with their multipliers changes by its square only.
fn sphere(criterion: Criterion, cloud: &Cloud, found: &Minimax) -> Option<Proof> {
    let cos = covering_cosine(cloud, &found.frame.origin);
    let (low, form) = (found.low, found.high - found.low);
    if cos < 0.5 {
        return None;
    }
    let inside = |worse: f64| {
        let root = cos * cos - worse / low;
        (root > 0.0).then(|| low * (cos - root.sqrt()))
    };
    let (reach, value) = match criterion {
        Criterion::MaximumInscribed => (inside(2.0 * form)?, low),
        _ => (2.0 * inside(form)?, form),
    };
    let change = 0.5 * reach * reach / (low - reach).max(1e-9);
    let bound =
        if criterion == Criterion::MaximumInscribed { value + change } else { value - change };
    (bound > 0.0).then_some(Proof::Bound(bound * cloud.size))
}

/// The cosine of an angle within which every direction has a point.
fn covering_cosine(cloud: &Cloud, centre: &Vec3) -> f64 {
    const COUNT: u32 = 600;
    const MOST_POINTS: usize = 3000;
    /// No direction is farther from one of these than this, rad.
    const SPACING: f64 = 0.11;
    let step = cloud.points.len().div_ceil(MOST_POINTS);
    let thin = cloud.points.iter().step_by(step).map(|p| (p - centre).normalize());
    let units: Vec<Vec3> = thin.collect();
    let golden = std::f64::consts::PI * (3.0 - 5.0_f64.sqrt());
    let mut least = 1.0_f64;
    for k in 0..COUNT {
        let z = 1.0 - (2.0 * f64::from(k) + 1.0) / f64::from(COUNT);
        let (sin, cos) = (golden * f64::from(k)).sin_cos();
        let r = (1.0 - z * z).sqrt();
        let v = Vec3::new(r * cos, r * sin, z);
        let nearest = units.iter().map(|u| u.dot(&v)).fold(-1.0, f64::max);
        least = least.min(nearest);
    }
    (least.clamp(-1.0, 1.0).acos() + SPACING).cos()
}
