//! Paths that keep the tool point on a ball while rotary axes turn: Lei and Hsu 2003, section 4.
//!
//! The radius of its sphere is the bar between programmed point and socket; the tool point of the
//! instrument is the socket, which stays on the ball, so that no radius is left here.

use super::placing::turns_about;
use super::{Placing, read_at, read_count, read_position, station};
use crate::instruments::instrument::Sight;
use crate::measure::{Campaign, Readings};
use trueaxis_geometry::Vec3;
use trueaxis_geometry::frame::{Direction, Point};
use trueaxis_input::{Dimension, Item, Section};
use trueaxis_machine::Target;
use trueaxis_machine::axis::{AxisKind, Command};
use trueaxis_machine::file::read_direction;

/// One rotary axis turns, all other rotary axes stand, linear axes follow: paths A and C of
/// Lei and Hsu 2003; a ball-bar lies along, across or next to the axis.
pub(super) fn read_rotary(
    section: &Section<'_>,
    kind: &Item<'_>,
    campaign: &Campaign,
    instrument: usize,
) -> Option<Readings> {
    let machine = &campaign.machine;
    let letter = kind.as_text()?;
    let is_it = |a: &trueaxis_machine::axis::Axis| {
        a.kind == AxisKind::Rotary && a.name.to_string() == letter
    };
    let Some(axis) = machine.axes().iter().position(is_it) else {
        let message = format!("{} has no rotary axis {letter}", machine.chain_text());
        kind.error("unknown-axis", message, "kind = the letter of a rotary axis of the machine");
        section.entries();
        return None;
    };
    let bar = section.text("bar").unwrap_or("radial");
    read_turning(section, (axis, bar), campaign, instrument)
}

/// The same for an axis by its number and a direction of the bar.
pub(super) fn read_turning(
    section: &Section<'_>,
    (axis, bar): (usize, &str),
    campaign: &Campaign,
    instrument: usize,
) -> Option<Readings> {
    let placing = Placing::for_path(section, campaign, instrument)?;
    let bound = |key: &str| {
        let item = section.require(key, "from = \"90 deg\" and to = \"0 deg\"")?;
        read_position(&item, AxisKind::Rotary)
    };
    let (from, to) = (bound("from"), bound("to"));
    let count = read_count(section, "count", 25);
    let back = section.get("back").map_or(Some(false), |i| i.flag());
    let start = read_at(section, campaign);
    let (from, to, count, back, mut rotary) = (from?, to?, count?, back?, start?);
    rotary[axis] = from;
    let at_ball = placing.place(placing.reference_point_mm, &rotary);
    let Some(at_ball) = at_ball else {
        return unreachable_station(section, 0);
    };
    let direction = match campaign.instruments[instrument].sight {
        Sight::Distance => bar_direction(section, bar, axis, &at_ball, &placing)?,
        _ => Vec3::zeros(),
    };
    let step = |k: usize| from + (to - from) * k as f64 / (count.max(2) - 1) as f64;
    let there = (0..count).map(step);
    let again = (0..if back { count } else { 0 }).rev().map(step);
    let mut stations = Readings::default();
    for (i, q) in there.chain(again).enumerate() {
        rotary[axis] = q;
        let Some(command) = placing.contact(direction, &rotary) else {
            return unreachable_station(section, i);
        };
        stations.push(station(command, campaign, instrument, i));
    }
    Some(stations)
}

/// The direction of a bar against the axis that turns.
fn bar_direction(
    section: &Section<'_>,
    bar: &str,
    axis: usize,
    at_ball: &Command,
    placing: &Placing,
) -> Option<Vec3> {
    let machine = placing.machine();
    let (moved, about) = turns_about(machine, axis, at_ball, placing.reference_point_mm);
    // A ball on the axis does not move: any direction across is sufficient.
    let across = [Vec3::x(), Vec3::y()].map(|v| about.cross(&v)).into_iter();
    let across = across.max_by(|a, b| a.norm().total_cmp(&b.norm())).unwrap_or_else(Vec3::x);
    let tangential = moved.try_normalize(1e-6).unwrap_or_else(|| across.normalize());
    match bar {
        "radial" => Some(tangential.cross(&about)),
        "tangential" => Some(tangential),
        // On the side of the tool, not of what holds the ball.
        "axial" if about.dot(&placing.tool_axis(at_ball)) < 0.0 => Some(-about),
        "axial" => Some(about),
        other => {
            let message = format!("a bar does not lie `{other}`");
            section.error("bad-bar", message, "bar = \"radial\", \"tangential\" or \"axial\"");
            None
        }
    }
}

/// Path F: `rise` over `turns` turns, from the latitude `lowest`.
pub(super) fn read_f(
    section: &Section<'_>,
    campaign: &Campaign,
    instrument: usize,
) -> Option<Readings> {
    let angle = |key: &str, usual: f64| match section.get(key) {
        None => Some(usual),
        Some(item) => item.quantity(Dimension::Angle),
    };
    let quarter = std::f64::consts::FRAC_PI_2;
    let (rise, lowest) = (angle("rise", quarter), angle("lowest", 0.0));
    let turns = section.get("turns").map_or(Some(1.0), |i| i.number());
    let count = read_count(section, "count", 37);
    let (rise, lowest, turns, count) = (rise?, lowest?, turns?, count?);
    if lowest < -quarter || lowest + rise > quarter + 1e-12 || rise < 0.0 {
        let message = "the path rises beyond the pole".to_owned();
        section.error(
            "bad-rise",
            message,
            "lowest + rise at most 90 deg, such as rise = \"90 deg\"",
        );
        section.entries();
        return None;
    }
    let normals = directions_f(lowest, rise, turns.clamp(-100.0, 100.0), count);
    read_followed(section, campaign, instrument, &along(&normals))
}

/// Path S: a circle that leans by `tilt` out of the equator.
pub(super) fn read_s(
    section: &Section<'_>,
    campaign: &Campaign,
    instrument: usize,
) -> Option<Readings> {
    let tilt = section.require("tilt", "tilt = \"30 deg\", the angle ψ of Lei and Hsu 2003");
    let count = read_count(section, "count", 37);
    let (tilt, count) = (tilt?.quantity(Dimension::Angle)?, count?);
    // At 45 deg the circle meets the pole.
    if tilt <= 0.0 || tilt >= std::f64::consts::FRAC_PI_4 {
        let message = format!("a circle with ψ = {:.3} deg goes round the pole", tilt.to_degrees());
        section.error("bad-tilt", message, "more than 0 and less than 45 deg");
        section.entries();
        return None;
    }
    read_followed(section, campaign, instrument, &along(&directions_s(tilt, count)))
}

/// A cone: the tool axis goes round the pole on it, a ball-bar stands square on its surface, as
/// where a frustum is milled by the side of the cutter.
pub(super) fn read_cone(
    section: &Section<'_>,
    campaign: &Campaign,
    instrument: usize,
) -> Option<Readings> {
    let half = section.require("half_angle", "half_angle = \"15 deg\", of the cone");
    let count = read_count(section, "count", 37);
    let (half, count) = (half?.quantity(Dimension::Angle)?, count?);
    if half <= 0.0 || half >= std::f64::consts::FRAC_PI_2 {
        let message = format!("{:.3} deg is no half angle of a cone", half.to_degrees());
        section.error("bad-cone", message, "more than 0 and less than 90 deg");
        section.entries();
        return None;
    }
    read_followed(section, campaign, instrument, &directions_cone(half, count))
}

/// The outward normals along path F.
///
/// ```text
///     u = (cos λ cos φ, cos λ sin φ, sin λ)      λ = λ₀ + rise φ/φ_end            docs/model.md eq. 109
/// ```
///
/// *Source:* Lei and Hsu 2003, Eq 14 (λ₀ = 0, rise 90°, one turn).
pub fn directions_f(lowest_rad: f64, rise_rad: f64, turns: f64, count: usize) -> Vec<Vec3> {
    let along = |k: usize| k as f64 / (count.max(2) - 1) as f64;
    let normal = |t: f64| {
        let (sin_phi, cos_phi) = (std::f64::consts::TAU * turns * t).sin_cos();
        let (sin, cos) = (lowest_rad + rise_rad * t).sin_cos();
        Vec3::new(cos * cos_phi, cos * sin_phi, sin)
    };
    (0..count).map(along).map(normal).collect()
}

/// The outward normals along path S.
///
/// ```text
///     u = (1 + sin²ψ (cos θ − 1), sin ψ sin θ, sin ψ cos ψ (1 − cos θ))          docs/model.md eq. 110
/// ```
///
/// *Source:* Lei and Hsu 2003, Eq 17 with Rp = Rw sin ψ. DIFFERENCE: (004-9) only with this Rp is the
/// circle on the sphere.
pub fn directions_s(tilt_rad: f64, count: usize) -> Vec<Vec3> {
    let (s, c) = tilt_rad.sin_cos();
    let normal = |k: usize| {
        let (sin, cos) = (std::f64::consts::TAU * k as f64 / (count.max(2) - 1) as f64).sin_cos();
        Vec3::new(1.0 + s * s * (cos - 1.0), s * sin, s * c * (1.0 - cos))
    };
    (0..count).map(normal).collect()
}

/// From the ball to the tool point, and the tool axis, round a cone of half angle α.
///
/// ```text
///     u = (cos α cos φ, cos α sin φ, sin α)     n = (−sin α cos φ, −sin α sin φ, cos α)     docs/model.md eq. 156
/// ```
///
/// u is the outward normal of the cone, n its generatrix from the base to the apex: u · n = 0.
pub fn directions_cone(half_angle_rad: f64, count: usize) -> Vec<[Vec3; 2]> {
    let (s, c) = half_angle_rad.sin_cos();
    let one = |k: usize| {
        let (sin, cos) = (std::f64::consts::TAU * k as f64 / (count.max(2) - 1) as f64).sin_cos();
        [Vec3::new(c * cos, c * sin, s), Vec3::new(-s * cos, -s * sin, c)]
    };
    (0..count).map(one).collect()
}

/// The tool axis along the outward normal.
fn along(normals: &[Vec3]) -> Vec<[Vec3; 2]> {
    normals.iter().map(|u| [*u, *u]).collect()
}

/// Commands for sides of the ball and tool axes; `pole` is where their z points.
fn read_followed(
    section: &Section<'_>,
    campaign: &Campaign,
    instrument: usize,
    sides: &[[Vec3; 2]],
) -> Option<Readings> {
    let placing = Placing::for_path(section, campaign, instrument)?;
    let pole = section.get("pole").map_or(Some(Vec3::z()), |i| read_direction(&i))?;
    let start = read_at(section, campaign)?;
    let along_x = (Vec3::x() - pole * pole.x).try_normalize(1e-6).unwrap_or_else(Vec3::y);
    let along_y = pole.cross(&along_x);
    let target = |side: &[Vec3; 2]| {
        let [side, axis] = side.map(|u| along_x * u.x + along_y * u.y + pole * u.z);
        let tip = placing.reference_point_mm + side * placing.reach_mm;
        Some(Target { tip: Point::from_vector(tip), axis: Direction::of(axis)? })
    };
    let targets: Vec<Target> = sides.iter().filter_map(target).collect();
    match placing.machine().follow(&targets, &start) {
        Ok(commands) => {
            let mut stations = Readings::default();
            for (i, command) in commands.into_iter().enumerate() {
                stations.push(station(command, campaign, instrument, i));
            }
            Some(stations)
        }
        Err(error) => {
            let message =
                format!("station {} of {}: {}", error.index + 1, targets.len(), error.fault);
            let hint =
                "a higher `lowest`, less `rise`, another `pole`, or another place of the ball";
            section.error("outside-travel", message, hint);
            None
        }
    }
}

pub(super) fn unreachable_station<T>(section: &Section<'_>, i: usize) -> Option<T> {
    let message = format!("station {}: the linear axes do not span the space there", i + 1);
    section.error("unreachable-station", message, "let the rotary axes stand otherwise (`at`)");
    None
}
