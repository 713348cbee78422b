//! Circles and helices: what follows from radii, centres and tangents.

use crate::moves::{Arc, Position};
use crate::text::program::{Fault, fault};

/// The centre of an arc of given radius; a negative radius means more than half a turn. Half the
/// chord may be longer than the radius by what rounding makes of it.
pub(crate) fn by_radius(
    [start, end]: [[f64; 2]; 2],
    radius: f64,
    ccw: bool,
    rounding_mm: f64,
    at: usize,
) -> Result<[f64; 2], Fault> {
    let half = half_chord([start, end]);
    if half > radius.abs() + rounding_mm {
        let message = format!(
            "the arc does not fit: its ends are {:.4} mm apart, more than twice the radius {:.4} \
             mm",
            2.0 * half,
            radius.abs()
        );
        return Err(fault("arc-does-not-fit", at, message, "check the radius and the target"));
    }
    let height = (radius * radius - half * half).max(0.0).sqrt();
    on_bisector([start, end], half, if ccw == (radius > 0.0) { height } else { -height }, at)
}

/// By how much half a chord may be longer than a radius of three decimals.
pub(crate) fn rounding_mm(radius: f64) -> f64 {
    1e-3 * radius.abs() + 0.01
}

/// The centre of an arc that sweeps a signed angle between two points.
pub(crate) fn by_opening(
    ends: [[f64; 2]; 2],
    angle_deg: f64,
    at: usize,
) -> Result<[f64; 2], Fault> {
    let half = half_chord(ends);
    // The height of the triangle of chord and centre: h = (chord / 2) / tan(angle / 2).
    on_bisector(ends, half, half / (angle_deg.to_radians() / 2.0).tan(), at)
}

fn half_chord([start, end]: [[f64; 2]; 2]) -> f64 {
    (end[0] - start[0]).hypot(end[1] - start[1]) / 2.0
}

/// The point that lies left of the middle of a chord.
fn on_bisector(
    [start, end]: [[f64; 2]; 2],
    half: f64,
    left: f64,
    at: usize,
) -> Result<[f64; 2], Fault> {
    if half == 0.0 {
        let message = "an arc with a radius must not end at its start";
        return Err(fault("arc-does-not-fit", at, message, "write the centre of a full circle"));
    }
    let along = [(end[0] - start[0]) / (2.0 * half), (end[1] - start[1]) / (2.0 * half)];
    let middle = [0, 1].map(|i| f64::midpoint(start[i], end[i]));
    Ok([middle[0] - along[1] * left, middle[1] + along[0] * left])
}

/// Looks whether both ends of an arc lie on it: its radii there may differ by what `allowed_mm`
/// makes of the larger one.
pub(crate) fn check_radii(
    [start, end]: [[f64; 2]; 2],
    center: [f64; 2],
    allowed_mm: impl Fn(f64) -> f64,
    at: usize,
) -> Result<(), Fault> {
    let radius = |p: [f64; 2]| (p[0] - center[0]).hypot(p[1] - center[1]);
    let (from, to) = (radius(start), radius(end));
    let hint = "check the centre and the target, and whether the centre is relative to the start";
    if from <= 0.0 || to <= 0.0 {
        return Err(fault("arc-does-not-fit", at, "the radius of the arc is zero", hint));
    }
    if (from - to).abs() > allowed_mm(from.max(to)) {
        let message = format!(
            "the arc does not fit: radius {from:.4} mm at its start, {to:.4} mm at its end"
        );
        return Err(fault("arc-does-not-fit", at, message, hint));
    }
    Ok(())
}

/// Centre and sense of the arc that leaves a direction without a corner; `None` if it is a line.
///
/// With the left normal n of the direction and the chord d the radius is ρ = d² / (2 n·d), from
/// |d − ρ n| = |ρ| (derived here).
pub(crate) fn tangential([start, end]: [[f64; 2]; 2], along: [f64; 2]) -> Option<([f64; 2], bool)> {
    let length = along[0].hypot(along[1]);
    let normal = [-along[1] / length, along[0] / length];
    let d = [end[0] - start[0], end[1] - start[1]];
    let (square, across) = (d[0] * d[0] + d[1] * d[1], normal[0] * d[0] + normal[1] * d[1]);
    if across.abs() <= 1e-9 * square.sqrt() {
        return None;
    }
    let radius = square / (2.0 * across);
    Some(([start[0] + radius * normal[0], start[1] + radius * normal[1]], radius > 0.0))
}

/// The direction in the plane in which the path before an arc ended.
pub(crate) fn direction_before(
    tangent: Option<[f64; 3]>,
    [first, second]: [usize; 2],
    at: usize,
) -> Result<[f64; 2], Fault> {
    let along = tangent.map(|t| [t[first], t[second]]).filter(|t| t[0].hypot(t[1]) > 1e-9);
    along.ok_or_else(|| {
        let message = "no previous move in this plane that the arc could continue";
        fault("missing-tangent", at, message, "write a line or an arc in this plane before it")
    })
}

/// Where an arc goes at its end.
pub(crate) fn end_tangent(arc: &Arc, target: &Position) -> [f64; 3] {
    let [first, second, _] = arc.plane.axes();
    let out = [target[first] - arc.center_mm[0], target[second] - arc.center_mm[1]];
    let sign = if arc.ccw { 1.0 } else { -1.0 };
    let mut tangent = [0.0; 3];
    tangent[first as usize] = -out[1] * sign;
    tangent[second as usize] = out[0] * sign;
    tangent
}
