//! Placements in the machine file: `"0 -1500 300 mm"`, `["shift …", "turn Y 10 deg"]`.

use crate::chain::Link;
use trueaxis_geometry::Vec3;
use trueaxis_geometry::frame::{Pose, rotation};
use trueaxis_input::plausible::Quantity;
use trueaxis_input::{Dimension, Item, QuantityError, Unit, parse_quantity};

const HINT: &str = "write \"x y z mm\", \"shift x y z mm\" or \"turn Z 15 deg\", or a list of \
    these, applied from left to right";

/// A pose from one step or a list of steps, applied from left to right in the moved frame.
pub fn read_pose(item: &Item<'_>) -> Option<Link> {
    let steps = if item.is_list() { item.list()? } else { vec![*item] };
    // All steps are read before giving up, so that every fault among them is reported.
    let poses: Vec<_> = steps.iter().map(read_step).collect();
    poses.into_iter().try_fold(Link::identity(), |acc, step| Some(acc * step?))
}

/// Three lengths with one unit: `"0 0 -100 mm"`.
pub fn read_vector_mm(item: &Item<'_>) -> Option<Vec3> {
    let words: Vec<&str> = item.text()?.split_whitespace().collect();
    vector(item, &words).filter(|v| item.is_possible(Quantity::Length, v.norm()))
}

/// The tip of a tool, as far from the gauge line as a tool is long.
pub fn read_tip(item: &Item<'_>) -> Option<Vec3> {
    read_vector_mm(item).filter(|v| item.is_possible(Quantity::ToolLength, v.norm()))
}

/// A direction of any length: `"0 1 1"`; returned as a unit vector.
pub fn read_direction(item: &Item<'_>) -> Option<Vec3> {
    let numbers: Vec<Option<f64>> =
        item.text()?.split_whitespace().map(|w| parse_quantity(w, Dimension::Ratio).ok()).collect();
    let [Some(x), Some(y), Some(z)] = numbers[..] else {
        item.error(
            "bad-direction",
            "a direction needs three numbers".into(),
            "write a vector such as \"0 1 1\"",
        );
        return None;
    };
    let scale = x.abs().max(y.abs()).max(z.abs());
    if scale == 0.0 {
        item.error(
            "bad-direction",
            "the direction has length zero".into(),
            "write a vector such as \"0 1 1\"",
        );
        return None;
    }
    Some((Vec3::new(x, y, z) / scale).normalize())
}

fn read_step(item: &Item<'_>) -> Option<Link> {
    let words: Vec<&str> = item.text()?.split_whitespace().collect();
    match words[..] {
        ["turn", about, ..] => {
            let direction = match about {
                "X" => Vec3::x(),
                "Y" => Vec3::y(),
                "Z" => Vec3::z(),
                _ => return refuse(item, format!("`{about}` is not a direction to turn about")),
            };
            match parse_quantity(&words[2..].join(" "), Dimension::Angle) {
                Ok(angle) => Some(Pose::new(rotation(direction, angle), Vec3::zeros())),
                Err(e) => {
                    item.error(e.code(), e.to_string(), &e.hint());
                    None
                }
            }
        }
        ["shift", ..] => vector(item, &words[1..]).map(Pose::shift),
        _ => vector(item, &words).map(Pose::shift),
    }
}

fn vector(item: &Item<'_>, words: &[&str]) -> Option<Vec3> {
    let (numbers, unit) = match words {
        [x, y, z] => ([*x, *y, *z], ""),
        [x, y, z, unit] => ([*x, *y, *z], *unit),
        _ => return refuse(item, "expected three lengths and their unit".into()),
    };
    let unit = match Unit::find(unit, Dimension::Length) {
        Ok(unit) => unit,
        Err(e) => {
            item.error(e.code(), e.to_string(), &e.hint());
            return None;
        }
    };
    let mut vector = Vec3::zeros();
    for (slot, number) in vector.iter_mut().zip(numbers) {
        let value = parse_quantity(number, Dimension::Ratio).and_then(|v| unit.checked(v));
        match value {
            Ok(value) => *slot = value,
            Err(QuantityError::TooLarge(_, d)) => {
                let e = QuantityError::TooLarge(number.to_owned(), d);
                item.error(e.code(), e.to_string(), &e.hint());
                return None;
            }
            Err(_) => return refuse(item, format!("`{number}` is not a finite number")),
        }
    }
    Some(vector)
}

fn refuse<T>(item: &Item<'_>, message: String) -> Option<T> {
    item.error("bad-place", message, HINT);
    None
}
