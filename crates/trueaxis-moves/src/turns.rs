//! Turns and other frames, and the vectors they are made of.

use crate::{Axis, Frame, Position};

/// A turn about X, Y or Z (0, 1, 2), by the right-hand rule; quarter turns are exact.
pub fn about(axis: usize, angle_deg: f64) -> Frame {
    let (sin, cos) = match angle_deg.rem_euclid(360.0) {
        0.0 => (0.0, 1.0),
        90.0 => (1.0, 0.0),
        180.0 => (0.0, -1.0),
        270.0 => (-1.0, 0.0),
        _ => angle_deg.to_radians().sin_cos(),
    };
    let (i, j) = ((axis + 1) % 3, (axis + 2) % 3);
    let mut frame = Frame::IDENTITY;
    (frame.linear[i][i], frame.linear[j][j]) = (cos, cos);
    (frame.linear[i][j], frame.linear[j][i]) = (-sin, sin);
    frame
}

/// Turns one after the other, each about an axis that has turned along.
pub fn turns<const N: usize>(turns: [(Axis, f64); N]) -> Frame {
    let turned = turns.map(|(axis, angle_deg)| about(axis as usize, angle_deg));
    turned.into_iter().reduce(|outer, inner| outer.after(&inner)).unwrap_or(Frame::IDENTITY)
}

/// The frame with given directions of its axes.
pub fn from_axes([x, y, z]: [[f64; 3]; 3], origin: [f64; 3]) -> Frame {
    Frame { linear: [0, 1, 2].map(|row| [x[row], y[row], z[row]]), shift: point(origin) }
}

/// The turn of a frame about Z, degrees.
pub fn rotation_deg(frame: &Frame) -> f64 {
    frame.linear[1][0].atan2(frame.linear[0][0]).to_degrees()
}

/// X, Y and Z with the other axes at zero.
pub fn point([x, y, z]: [f64; 3]) -> Position {
    Position([x, y, z, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0])
}

/// X, Y and Z of a place.
pub fn xyz(place: &Position) -> [f64; 3] {
    [place.0[0], place.0[1], place.0[2]]
}

/// a − b.
pub fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|i| a[i] - b[i])
}

/// a · b.
pub fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

/// a × b.
pub fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// The vector with length one; `None` if it has no length.
pub fn unit(v: [f64; 3]) -> Option<[f64; 3]> {
    let largest = v.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    if largest == 0.0 || !largest.is_finite() {
        return None;
    }
    let scaled = v.map(|x| x / largest);
    let length = scaled.iter().map(|x| x * x).sum::<f64>().sqrt();
    Some(scaled.map(|x| x / length))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn turns_follow_the_right_hand() {
        assert_eq!(about(2, 90.0).vector([1.0, 0.0, 0.0]), [0.0, 1.0, 0.0]);
        assert_eq!(about(0, 90.0).vector([0.0, 1.0, 0.0]), [0.0, 0.0, 1.0]);
        assert_eq!(about(1, 90.0).vector([0.0, 0.0, 1.0]), [1.0, 0.0, 0.0]);
    }
}
