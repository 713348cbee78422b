//! Holes on a circle as one page that opens offline.

use crate::predict::holes::{HolePrediction, HoleSet, HoleStudy};
use maud::{Markup, PreEscaped, html};
use plotters::prelude::*;
use std::f64::consts::TAU;
use trueaxis_report::page::document;
use trueaxis_report::plots::{
    Area, COLOURS, DrawingError, FAINT, INK, draw, drawing_error, ink, pen, px, round_step,
};

/// The report as the text of an HTML file.
///
/// # Errors
/// A picture that the drawing library refuses.
pub fn holes_html(study: &HoleStudy, prediction: &HolePrediction) -> Result<String, DrawingError> {
    let content = html! {
        h1 { (study.name) }
        p.soft { (study.machine.name()) " · " code { (study.machine.chain_text()) } }
        p.soft { "Numbers of the machine: " (study.machine.source()) }
        (verdict(study, prediction))
        (set_section(study, prediction))
        (plan_section(study, prediction)?)
        (hole_section(study, prediction))
        (input_section(study, prediction))
    };
    Ok(document(&study.name, &content))
}

fn um(mm: f64) -> String {
    // No minus before a zero.
    format!("{:.1}", (mm * 1e4).round() / 10.0 + 0.0)
}

fn verdict(study: &HoleStudy, prediction: &HolePrediction) -> Markup {
    let applied = prediction.sets.iter().find(|s| s.compensation == study.applied);
    let (class, word, sentence) = match applied.and_then(|s| s.in_tolerance) {
        Some(true) => ("pass", "PASS", "every hole will be in tolerance"),
        Some(false) => ("fail", "FAIL", "a hole will be out of tolerance"),
        None => ("undecided", "NO VERDICT", "the study states no tolerance"),
    };
    html! {
        section class={ "verdict " (class) } {
            strong { (word) }
            span { (sentence) ", with compensation: " (study.applied.name()) }
        }
        @for warning in &prediction.warnings {
            section class="verdict fail" { strong { "WARNING" } span { (warning) } }
        }
    }
}

fn set_section(study: &HoleStudy, prediction: &HolePrediction) -> Markup {
    let row = |set: &HoleSet, when: &str| {
        let (class, word) = match set.in_tolerance {
            Some(true) => ("pass", "in tolerance"),
            Some(false) => ("fail", "out of tolerance"),
            None => ("", ""),
        };
        html! { tr.decisive[set.compensation == study.applied && when.is_empty()] {
            td { (set.compensation.name()) (when) }
            td { (um(set.worst_mm)) } td { (um(set.u_worst_mm)) }
            td { (study.tolerance_mm.map_or(String::new(), um)) }
            td class=(class) { (word) }
        } }
    };
    html! { section {
        h2 { "Worst hole" }
        p.soft { "Distance of a hole from its place in X and Y at 20 °C, in µm, with its standard \
                  uncertainty u. The bold compensation is the one that is on." }
        div.scroll { table {
            thead { tr {
                th { "compensation" } th { "worst hole, µm" } th { "u, µm" } th { "allowed, µm" }
                th { "" }
            } }
            tbody {
                @for set in &prediction.sets { (row(set, "")) }
                @for set in prediction.held.iter().flatten() {
                    (row(set, ", temperatures of the start held"))
                }
            }
        } }
    } }
}

/// Each compensation by its colour.
const NAMES: [(&str, RGBColor); 3] = [
    ("without compensation", COLOURS[0]),
    ("machine only", COLOURS[1]),
    ("comprehensive", COLOURS[2]),
];

fn plan_section(study: &HoleStudy, prediction: &HolePrediction) -> Result<Markup, DrawingError> {
    let mut figures = Vec::new();
    for (set, (name, colour)) in prediction.sets.iter().zip(NAMES) {
        let plan = Plan::of(study, set, colour);
        let picture = draw((SIZE, SIZE), |area| plan.paint(area, study, set))?;
        figures.push((name, plan.magnified, um(set.worst_mm), picture));
    }
    Ok(html! { section.long {
        h2 { "Plan view" }
        p.soft { "Seen along the tool, X to the right, Y upwards, in the workpiece frame. Each arrow \
                  goes from where a hole should be to where it will be; arrows are magnified, each \
                  picture by its own factor." }
        div.grid { @for (name, magnified, worst, picture) in &figures {
            figure {
                (PreEscaped(picture))
                figcaption {
                    strong { (name) } ": arrows magnified " strong { (format!("{magnified:.0}")) }
                    " times; worst hole " (worst) " µm"
                }
            }
        } }
    } })
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
/// Holes that the table lists, the first ones.
const MOST_ROWS: usize = 1000;

fn hole_section(study: &HoleStudy, prediction: &HolePrediction) -> Markup {
    let holes = study.holes_mm.iter().enumerate().take(MOST_ROWS);
    html! { section.long {
        h2 { "Holes" }
        p.soft { "Places in mm, in the workpiece frame; what a hole is off, in µm at 20 °C; u is a \
                  standard uncertainty, without compensation." }
        div.scroll { table.small {
            thead {
                tr {
                    th { "hole" } th { "x, mm" } th { "y, mm" }
                    @if study.temperatures.is_some() { th { "after, s" } }
                    @for (name, _) in NAMES { th colspan="2" { (name) } }
                    th colspan="2" { "u" }
                }
                tr {
                    th {} th {} th {}
                    @if study.temperatures.is_some() { th {} }
                    @for _ in NAMES { th { "dx, µm" } th { "dy, µm" } }
                    th { "dx, µm" } th { "dy, µm" }
                }
            }
            tbody { @for (i, place) in holes { tr {
                td { (i + 1) }
                td { (format!("{:.3}", place.x)) } td { (format!("{:.3}", place.y)) }
                @if study.temperatures.is_some() {
                    td { (format!("{:.0}", prediction.times_s[i])) }
                }
                @for set in &prediction.sets {
                    td { (um(set.holes[i].error_mm.x)) } td { (um(set.holes[i].error_mm.y)) }
                }
                td { (um(prediction.sets[0].holes[i].u_mm.x)) }
                td { (um(prediction.sets[0].holes[i].u_mm.y)) }
            } } }
        } }
        @if study.holes_mm.len() > MOST_ROWS {
            p.soft { "The first " (MOST_ROWS) " of " (study.holes_mm.len()) " holes." }
        }
    } }
}

fn input_section(study: &HoleStudy, prediction: &HolePrediction) -> Markup {
    html! { section {
        h2 { "Input" }
        div.scroll { table.words { tbody {
            tr { td { "machine" } td { (study.machine.name()) } }
            tr { td { "increment of a compensation" } td { (um(study.increment_mm)) " µm" } }
            @if let Some(running) = &study.temperatures {
                tr { td { "temperatures" } td {
                    (running.run.log.file()) ", from " (format!("{:.1}", running.run.start_s))
                    " s of its time, within 0.01 K"
                } }
            }
            @if !prediction.without_u.is_empty() {
                tr { td { "u lacks" } td { (prediction.without_u.join(", ")) " (none stated)" } }
            }
            tr { td { "made by" } td { "trueaxis " (trueaxis_report::VERSION) } }
        } } }
    } }
}
