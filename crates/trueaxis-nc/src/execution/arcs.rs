//! Circles and helices: what follows from radii, centres and tangents.

use crate::text::program::{Fault, fault};

/// The centre of an arc of given radius; a negative radius means more than half a turn.
pub(crate) fn by_radius(
    start: [f64; 2],
    end: [f64; 2],
    radius: f64,
    ccw: bool,
    at: usize,
) -> Result<[f64; 2], Fault> {
    let chord = [end[0] - start[0], end[1] - start[1]];
    let half = chord[0].hypot(chord[1]) / 2.0;
    if half == 0.0 {
        let message = "an arc by radius must end elsewhere than it begins".to_owned();
        return Err(fault("arc-does-not-fit", at, message, "a full circle needs I J K"));
    }
    // Half a chord may be longer than the radius by what rounding to 3 decimals makes of it.
    if half > radius.abs() * (1.0 + 1e-3) + 0.01 {
        let message = format!(
            "the arc does not fit: its ends are {:.4} mm apart, more than twice the radius {:.4} mm",
            2.0 * half,
            radius.abs()
        );
        return Err(fault("arc-does-not-fit", at, message, "check the radius and the target"));
    }
    let height = (radius * radius - half * half).max(0.0).sqrt();
    let side = if ccw == (radius > 0.0) { height } else { -height };
    let along = [chord[0] / (2.0 * half), chord[1] / (2.0 * half)];
    let middle = [0, 1].map(|i| f64::midpoint(start[i], end[i]));
    Ok([middle[0] - along[1] * side, middle[1] + along[0] * side])
}
