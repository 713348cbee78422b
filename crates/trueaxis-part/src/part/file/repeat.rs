//! Patterns: the same feature at several places.

use super::super::feature::MOST_POINTS;
use super::super::{Feature, Geometry};
use std::f64::consts::TAU;
use trueaxis_form::placed::Motion;
use trueaxis_geometry::Vec3;
use trueaxis_geometry::frame::{Pose, rotation};
use trueaxis_input::{Dimension, Item, Section};

/// The feature at each place of its `repeat`, numbered from 1; alone if it has none.
pub(super) fn repeated(section: &Section<'_>, feature: Feature) -> Option<Vec<Feature>> {
    let Some(item) = section.get("repeat") else { return Some(vec![feature]) };
    let is_fixed = matches!(feature.geometry, Geometry::Points | Geometry::Programmed { .. });
    if is_fixed || feature.letter.is_some() {
        let message = match is_fixed {
            true => {
                format!("a table of points or of a program is not repeated: `{}`", feature.name)
            }
            false => format!("a pattern is no datum: `{}`", feature.name),
        };
        item.error("wrong-feature", message, "write its features one by one");
        return None;
    }
    let steps = match item.is_list() {
        true => item.list()?,
        false => vec![item],
    };
    let mut places = vec![Motion::identity()];
    for step in &steps {
        let motions = step.section("repeat", |s| read_step(s)).flatten()?;
        if places.len() * motions.len() * feature.points.len() > MOST_POINTS {
            let message = "a pattern of so many points".to_owned();
            step.error("too-many-points", message, "fewer features, or a larger `spacing`");
            return None;
        }
        places = motions.iter().flat_map(|m| places.iter().map(|p| *m * *p)).collect();
    }
    let member = |(i, motion): (usize, &Motion)| Feature {
        name: format!("{}_{}", feature.name, i + 1),
        pattern: Some(feature.name.clone()),
        ..feature.moved(motion)
    };
    Some(places.iter().enumerate().map(member).collect())
}

/// `{ count = 4, step = "40 0 0 mm" }`, or `{ count = 6, about = "0 0 0 mm", axis = "0 0 1" }` with `angle` from one to the next.
fn read_step(section: &Section<'_>) -> Option<Vec<Motion>> {
    let count = section.require("count", "how many: count = 6").and_then(|i| i.count());
    let (step, about) = (section.get("step"), section.get("about"));
    let of_index: Box<dyn Fn(f64) -> Motion> = match (step, about) {
        (Some(step), None) => {
            let way = Vec3::from(step.lengths()?);
            if way.norm() < 1e-9 {
                step.error("not-positive", "`step` leads nowhere".into(), "step = \"40 0 0 mm\"");
                return None;
            }
            Box::new(move |k| Pose::shift(way * k))
        }
        (None, Some(about)) => turned(section, &about, count?)?,
        _ => {
            let message = "a pattern goes along a step or about an axis".to_owned();
            let hint = "step = \"40 0 0 mm\", or about = \"0 0 0 mm\" with axis = \"0 0 1\"";
            section.error("contradiction", message, hint);
            return None;
        }
    };
    let count = count?;
    if !(2..=MOST_POINTS).contains(&count) {
        section.error("bad-count", format!("a pattern of {count}"), "2 and more");
        return None;
    }
    Some((0..count).map(|k| of_index(k as f64)).collect())
}

fn turned(
    section: &Section<'_>,
    about: &Item<'_>,
    count: usize,
) -> Option<Box<dyn Fn(f64) -> Motion>> {
    let at = about.lengths().map(Vec3::from);
    let axis = section.require("axis", "axis = \"0 0 1\"").and_then(|i| i.direction());
    let angle = match section.get("angle") {
        Some(item) => item.quantity(Dimension::Angle),
        None => Some(TAU / count.max(1) as f64),
    };
    let (at, axis, angle) = (at?, Vec3::from(axis?), angle?);
    if angle.abs() < 1e-9 || angle.abs() * (count as f64 - 1.0) > TAU * (1.0 - 1e-9) {
        let message = "the last of the pattern lies on the first, or beyond it".to_owned();
        section.error(
            "bad-angle",
            message,
            "a smaller `angle`; left out: the whole turn in equal steps",
        );
        return None;
    }
    Some(Box::new(move |k| {
        let turn = rotation(axis, angle * k);
        Pose::new(turn, at - turn * at)
    }))
}
