//! The plan views of holes.

use super::holes::um;
use crate::predict::holes::{HolePrediction, HoleSet, HoleStudy};
use plotters::prelude::*;
use std::f64::consts::TAU;
use trueaxis_report::Figure;
use trueaxis_report::plots::{
    Area, COLOURS, DrawingError, FAINT, INK, draw, drawing_error, ink, pen, px, round_step,
};

/// The colour of each compensation.
const SET_COLOURS: [RGBColor; 4] = [COLOURS[0], COLOURS[1], COLOURS[2], COLOURS[3]];

/// One plan view for each compensation.
pub(super) fn plans<'a>(
    study: &'a HoleStudy,
    prediction: &'a HolePrediction,
    names: [&'a str; 4],
) -> impl Iterator<Item = Figure<'a>> {
    let sets = prediction.sets.iter().zip(SET_COLOURS).zip(names);
    sets.map(move |((set, colour), name)| {
        let plan = Plan::of(study, set, colour);
        let (magnified, worst) = (plan.magnified, um(set.worst_mm));
        let caption =
            format!("{name}: arrows magnified {magnified:.0} times; worst hole {worst} µm");
        Figure::new(caption, move || draw((SIZE, SIZE), |area| plan.paint(area, study, set)))
    })
}

/// Width and height of a plan.
const SIZE: u32 = 480;
/// Room around the holes, and for the bar on top.
const EDGE: i32 = 84;
/// The longest arrow.
const LONGEST: f64 = 60.0;

/// Where things lie in the picture.
struct Plan {
    colour: RGBColor,
    middle_mm: [f64; 2],
    /// Pixels of the drawing per mm of the part.
    per_mm: f64,
    /// How much longer arrows are than the part is drawn.
    magnified: f64,
    /// The length of the bar, mm of deviation.
    bar_mm: f64,
}

impl Plan {
    fn of(study: &HoleStudy, set: &HoleSet, colour: RGBColor) -> Self {
        let ends = |axis: usize| {
            let values = study.holes_mm.iter().map(|p| p[axis]);
            values.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(v), h.max(v)))
        };
        let ends = [ends(0), ends(1)];
        let span_mm = ends.iter().map(|(l, h)| h - l).fold(1e-3, f64::max);
        let per_mm = f64::from(px(SIZE as i32 - 2 * EDGE)) / span_mm;
        let worst_mm = set.worst_mm.max(1e-6);
        let longest = LONGEST * f64::from(px(1));
        // A round factor, so that a reader can divide by it; rounded up it makes them 2.5 times
        // longer at the most.
        let magnified = round_step(longest / (worst_mm * per_mm) / 2.5).max(1.0);
        let middle_mm = ends.map(|(l, h)| 0.5 * (l + h));
        Self { colour, middle_mm, per_mm, magnified, bar_mm: round_step(0.5 * worst_mm) }
    }

    fn place(&self, x_mm: f64, y_mm: f64) -> (i32, i32) {
        let middle = 0.5 * f64::from(px(SIZE as i32));
        let pixel = |v: f64| v.round() as i32;
        (
            pixel(middle + (x_mm - self.middle_mm[0]) * self.per_mm),
            pixel(middle - (y_mm - self.middle_mm[1]) * self.per_mm),
        )
    }

    fn paint(&self, area: &Area<'_>, study: &HoleStudy, set: &HoleSet) -> Result<(), DrawingError> {
        let holes = &study.holes_mm;
        let mut round: Vec<_> = holes.iter().map(|p| self.place(p.x, p.y)).collect();
        round.extend(round.first().copied());
        area.draw(&PathElement::new(round, pen(FAINT, 1))).map_err(drawing_error)?;
        // All of them only where they can be distinguished, and every quarter of them with its number.
        let every = holes.len().div_ceil(MOST_ARROWS).max(1);
        let numbered = holes.len().div_ceil(4).max(1);
        for (i, hole) in holes.iter().enumerate() {
            let from = self.place(hole.x, hole.y);
            if i % every == 0 {
                area.draw(&Circle::new(from, px(3), pen(INK, 1))).map_err(drawing_error)?;
                let off = set.holes[i].error_mm * self.magnified;
                self.arrow(area, from, self.place(hole.x + off.x, hole.y + off.y))?;
            }
            if i % numbered == 0 {
                let inwards = |at: i32| px(SIZE as i32 / 2) + (at - px(SIZE as i32 / 2)) * 3 / 5;
                let at = (inwards(from.0) - px(16), inwards(from.1) - px(6));
                let text = Text::new(format!("hole {}", i + 1), at, ink(12));
                area.draw(&text).map_err(drawing_error)?;
            }
        }
        self.bar(area)
    }

    fn arrow(&self, area: &Area<'_>, from: (i32, i32), to: (i32, i32)) -> Result<(), DrawingError> {
        let line = PathElement::new(vec![from, to], pen(self.colour, 2));
        area.draw(&line).map_err(drawing_error)?;
        let (dx, dy) = (f64::from(to.0 - from.0), f64::from(to.1 - from.1));
        let head = f64::from(px(8)).min(dx.hypot(dy));
        let angle = dy.atan2(dx);
        let barb = |turn: f64| {
            let a = angle + 0.5 * TAU + turn;
            (to.0 + (head * a.cos()) as i32, to.1 + (head * a.sin()) as i32)
        };
        let points = vec![to, barb(0.4), barb(-0.4)];
        area.draw(&Polygon::new(points, self.colour.filled())).map_err(drawing_error)
    }

    /// How long a deviation is drawn.
    fn bar(&self, area: &Area<'_>) -> Result<(), DrawingError> {
        let length = (self.bar_mm * self.magnified * self.per_mm).round() as i32;
        let (left, y) = (px(12), px(16));
        let bar = vec![(left, y), (left + length, y)];
        area.draw(&PathElement::new(bar, pen(INK, 3))).map_err(drawing_error)?;
        let words = format!("{} µm", um(self.bar_mm));
        let text = Text::new(words, (left + length + px(8), y - px(7)), ink(13));
        area.draw(&text).map_err(drawing_error)
    }
}

/// More arrows than this cannot be distinguished.
const MOST_ARROWS: usize = 96;
