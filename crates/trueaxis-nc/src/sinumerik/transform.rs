//! Turns, scales and mirrors as frames.

use crate::execution::mistakes;
use crate::moves::turns::{about, cross, turns};
use crate::moves::{Axis, Frame, Position};
use crate::text::program::Fault;

use super::fault;

/// A turn about one axis.
pub(super) fn turned(axis: Axis, angle_deg: f64) -> Frame {
    about(axis as usize % 3, angle_deg)
}

/// Angles about X, Y and Z in the order of this control: Rz · Ry · Rx.
///
/// # Source
/// Function Manual "Axes, coordinate systems, frames (K2)": RPY angles turn in the order Z, Y', X''.
pub(super) fn rpy(angles_deg: [f64; 3]) -> Frame {
    let [x, y, z] = angles_deg;
    turns([(Axis::Z, z), (Axis::Y, y), (Axis::X, x)])
}

/// The RPY angles of a pure turn.
pub(super) fn rpy_of(frame: &Frame) -> [f64; 3] {
    let m = &frame.linear;
    let y = (-m[2][0]).atan2(m[0][0].hypot(m[1][0]));
    let (x, z) = if m[0][0].hypot(m[1][0]) > 1e-12 {
        (m[2][1].atan2(m[2][2]), m[1][0].atan2(m[0][0]))
    } else {
        // Y' at a quarter turn: only the difference of the others counts; X is 0 by convention.
        (0.0, (-m[0][1]).atan2(m[1][1]))
    };
    [x, y, z].map(f64::to_degrees)
}

/// The frame that undoes another.
pub(super) fn inverse(frame: &Frame) -> Option<Frame> {
    let shift = frame.inverse_place(&Position::default())?;
    let mut linear = [[0.0; 3]; 3];
    for j in 0..3 {
        let mut unit = frame.shift;
        unit.0[j] += 1.0;
        let column = frame.inverse_place(&unit)?;
        for (i, row) in linear.iter_mut().enumerate() {
            row[j] = column.0[i];
        }
    }
    Some(Frame { linear, shift })
}

/// The turn whose plane has given traces in the planes of two axes.
///
/// The angle about one axis turns the second basic direction: with X and Y the new X axis lies in
/// the old ZX plane, with X and Z the new Z axis in the old YZ plane, with Y and Z the new Y axis in
/// the old XY plane.
///
/// # Source
/// Operating Manual "Milling", swivel plane, swivelling by projection angles; the same holds for the
/// solid angles of ROTS.
pub(super) fn projected(angles_deg: [Option<f64>; 3]) -> Option<Frame> {
    let [x, y, z] = angles_deg;
    // The new axis that lies in the named plane, and a trace of the plane it spans.
    let (first, trace, index) = match (x, y, z) {
        (Some(x), Some(y), None) => (
            turned(Axis::Y, y).vector([1.0, 0.0, 0.0]),
            turned(Axis::X, x).vector([0.0, 1.0, 0.0]),
            0,
        ),
        (None, Some(y), Some(z)) => (
            turned(Axis::Z, z).vector([0.0, 1.0, 0.0]),
            turned(Axis::Y, y).vector([0.0, 0.0, 1.0]),
            1,
        ),
        (Some(x), None, Some(z)) => (
            turned(Axis::X, x).vector([0.0, 0.0, 1.0]),
            turned(Axis::Z, z).vector([1.0, 0.0, 0.0]),
            2,
        ),
        (Some(x), None, None) => return Some(turned(Axis::X, x)),
        (None, Some(y), None) => return Some(turned(Axis::Y, y)),
        (None, None, Some(z)) => return Some(turned(Axis::Z, z)),
        _ => return None,
    };
    let normal = cross(first, trace);
    let length = normal.iter().map(|v| v * v).sum::<f64>().sqrt();
    if length.is_nan() || length <= 1e-9 {
        return None;
    }
    let normal = normal.map(|v| v / length);
    let second = cross(normal, first);
    let columns = [first, second, normal];
    // The three directions follow each other from the axis that `first` is.
    let mut linear = [[0.0; 3]; 3];
    for (k, column) in columns.iter().enumerate() {
        for i in 0..3 {
            linear[i][(index + k) % 3] = column[i];
        }
    }
    Some(Frame { linear, ..Frame::IDENTITY })
}

/// The frame of CTRANS, CROT, CSCALE … or TRANS, ROT, SCALE … with its entries per axis.
pub(super) fn from_entries(word: &str, entries: &[(Axis, f64)], at: usize) -> Result<Frame, Fault> {
    let mut frame = Frame::IDENTITY;
    let value = |axis: Axis| entries.iter().find(|(a, _)| *a == axis).map(|(_, v)| *v);
    let spatial = [Axis::X, Axis::Y, Axis::Z].map(value);
    if let Some((_, bad)) = entries.iter().find(|(_, v)| v.is_nan() || v.abs() >= 1e12) {
        return Err(mistakes::too_large(*bad, "a frame", at));
    }
    match word {
        "TRANS" | "FINE" => {
            for (axis, value) in entries {
                frame.shift[*axis] = *value;
            }
        }
        "ROT" => frame = rpy(spatial.map(|v| v.unwrap_or(0.0))),
        "ROTS" => {
            frame = projected(spatial).ok_or_else(|| {
                let message = "solid angles need two axes and must define a plane";
                fault("bad-angles", at, message, "write ROTS X10 Y20")
            })?;
        }
        "SCALE" => {
            for (i, factor) in spatial.into_iter().enumerate() {
                frame.linear[i][i] = factor.unwrap_or(1.0);
                if frame.linear[i][i].abs() < 1e-6 {
                    return Err(mistakes::bad_scale(at));
                }
            }
        }
        _ => {
            for (i, mirrored) in spatial.into_iter().enumerate() {
                frame.linear[i][i] = if mirrored.is_some() { -1.0 } else { 1.0 };
            }
        }
    }
    Ok(frame)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn near(a: [f64; 3], b: [f64; 3]) -> bool {
        a.iter().zip(b).all(|(x, y)| (x - y).abs() < 1e-12)
    }

    #[test]
    fn rpy_turns_about_x_first_in_fixed_axes() {
        // X by 90 sends Y to Z, then Z by 90 leaves Z where it is.
        assert!(near(rpy([90.0, 0.0, 90.0]).vector([0.0, 1.0, 0.0]), [0.0, 0.0, 1.0]));
        let angles = [10.0, -20.0, 30.0];
        assert!(near(rpy_of(&rpy(angles)), angles));
    }

    #[test]
    fn projection_angles_leave_their_traces() {
        // A plane that rises by 45 degrees along X and along Y has the normal (-1, -1, 1).
        let frame = projected([Some(45.0), Some(-45.0), None]).unwrap();
        let s = 1.0 / 3.0_f64.sqrt();
        assert!(near(frame.vector([0.0, 0.0, 1.0]), [-s, -s, s]));
        let h = 0.5_f64.sqrt();
        assert!(near(frame.vector([1.0, 0.0, 0.0]), [h, 0.0, h]));
    }

    #[test]
    fn inverse_undoes() {
        let mut frame = rpy([10.0, 20.0, 30.0]);
        frame.shift = Position([1.0, 2.0, 3.0, 4.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
        let both = inverse(&frame).unwrap().after(&frame);
        assert!(near(both.vector([1.0, 2.0, 3.0]), [1.0, 2.0, 3.0]));
        assert!(both.shift.0.iter().all(|v| v.abs() < 1e-12));
    }
}
