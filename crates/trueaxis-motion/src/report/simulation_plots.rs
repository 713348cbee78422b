//! Pictures of a simulation: curves over time, with issues as marks.

use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use std::ops::Range;
use trueaxis_report::plots::{
    Area, COLOURS, DrawingError, FAINT, SHARP, draw, drawing_error, ink, pen, px, tick,
};

/// Colour of what endangers part or machine.
const CRITICAL: RGBColor = RGBColor(179, 38, 30);
/// Colour of what costs time only.
const SLOW: RGBColor = RGBColor(230, 159, 0);

/// One curve over time with its own scale.
pub struct Strip {
    /// What it is, with its unit.
    pub title: String,
    /// Small, at the right end of the title.
    pub note: String,
    /// Time, s, lowest and highest value.
    pub band: Vec<(f64, f64, f64)>,
    /// Values that must not be exceeded: lines where they come into view. Unit: that of the title.
    pub limits: Vec<f64>,
    /// The scale shows at least this much. Unit: that of the title.
    pub least_span: f64,
}

/// A stretch of time in which something is wrong.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mark {
    /// Begin, s.
    pub from_s: f64,
    /// End, s.
    pub to_s: f64,
    /// Part or machine are in danger.
    pub critical: bool,
}

/// The common axis of the strips.
#[derive(Debug, Clone, Copy, PartialEq)]
struct TimeAxis {
    end_s: f64,
    unit_s: f64,
    unit: &'static str,
}

impl TimeAxis {
    fn until(end_s: f64) -> Self {
        let (unit_s, unit) = match end_s {
            t if t > 10_800.0 => (3600.0, "h"),
            t if t > 300.0 => (60.0, "min"),
            _ => (1.0, "s"),
        };
        Self { end_s: end_s.max(1e-3), unit_s, unit }
    }

    fn shown(&self, time_s: f64) -> f64 {
        time_s / self.unit_s
    }
}

/// Lines of the grid.
pub(super) const GRID: RGBColor = RGBColor(222, 226, 229);

/// Width of the pictures.
pub(super) const WIDTH: i32 = 1000;
/// Room for the numbers left of a strip.
const LEFT: i32 = 66;
pub(super) const RIGHT: i32 = 12;
/// Room for the title over a strip or a view.
pub(super) const TITLE: i32 = 22;
const STRIP: i32 = 92;
/// Room for the numbers under the last strip.
const FOOT: i32 = 38;
/// More columns than this cannot be seen.
const MOST_COLUMNS: usize = 920;
/// More marks than this cannot be distinguished.
const MOST_MARKS: usize = 150;

/// Curves under each other over the same time, with what went wrong as vertical marks.
///
/// # Errors
/// What the drawing library reports.
pub fn strips(strips: &[Strip], end_s: f64, marks: &[Mark]) -> Result<String, DrawingError> {
    let time = TimeAxis::until(end_s);
    let height = strips.len() as i32 * (TITLE + STRIP) + FOOT;
    let shown = [joined(marks, false, time.end_s), joined(marks, true, time.end_s)];
    draw((WIDTH as u32, height as u32), |area| {
        for (i, strip) in strips.iter().enumerate() {
            let top = i as i32 * (TITLE + STRIP);
            let title = Text::new(strip.title.clone(), (px(LEFT), px(top + 4)), ink(14));
            area.draw(&title).map_err(drawing_error)?;
            let right = ink(13).color(&COLOURS[6]).pos(Pos::new(HPos::Right, VPos::Top));
            let note = Text::new(strip.note.clone(), (px(WIDTH - RIGHT), px(top + 5)), right);
            area.draw(&note).map_err(drawing_error)?;
            let foot = if i + 1 == strips.len() { FOOT } else { 0 };
            let size = (px(WIDTH) as u32, px(STRIP + foot) as u32);
            let part = area.clone().shrink((0, px(top + TITLE)), size);
            draw_strip(&part, strip, &time, foot, &shown)?;
        }
        Ok(())
    })
}

fn draw_strip(
    area: &Area<'_>,
    strip: &Strip,
    time: &TimeAxis,
    foot: i32,
    marks: &[Vec<Mark>; 2],
) -> Result<(), DrawingError> {
    let ys = scale(strip);
    let (low, high) = (ys.start, ys.end);
    let end = time.shown(time.end_s);
    let words = format!("time, {}", time.unit);
    let mut chart = ChartBuilder::on(area)
        .margin_right(px(RIGHT))
        .x_label_area_size(px(foot))
        .y_label_area_size(px(LEFT))
        .build_cartesian_2d(0.0..end, ys)
        .map_err(drawing_error)?;
    let (x_text, y_text) = (|x: &f64| tick(*x, end), |y: &f64| tick(*y, high - low));
    let mut mesh = chart.configure_mesh();
    mesh.x_labels(12)
        .y_labels(5)
        .light_line_style(WHITE)
        .axis_style(pen(FAINT, 1))
        .bold_line_style(pen(GRID, 1))
        .set_all_tick_mark_size(px(4))
        .x_label_formatter(&x_text)
        .y_label_formatter(&y_text)
        .label_style(ink(13));
    if foot > 0 {
        mesh.x_desc(words);
    }
    mesh.draw().map_err(drawing_error)?;
    let least = end * 1.5 / f64::from(WIDTH);
    for (marks, colour) in marks.iter().zip([SLOW, CRITICAL]) {
        for mark in marks {
            let from = time.shown(mark.from_s).min(end - least);
            let to = time.shown(mark.to_s).min(end);
            let over = Rectangle::new([(from, low), (to, high)], colour.mix(0.2).filled());
            let begin = Rectangle::new([(from, low), (from + least, high)], colour.filled());
            chart.draw_series([over, begin]).map_err(drawing_error)?;
        }
    }
    for limit in strip.limits.iter().filter(|v| (low..=high).contains(*v)) {
        let line = PathElement::new([(0.0, *limit), (end, *limit)], pen(CRITICAL, 1));
        chart.draw_series([line]).map_err(drawing_error)?;
    }
    for piece in outlines(&strip.band) {
        let piece = piece.into_iter().map(|(t, y)| (time.shown(t).clamp(0.0, end), y));
        chart.draw_series(LineSeries::new(piece, fine(COLOURS[0]))).map_err(drawing_error)?;
    }
    Ok(())
}

/// A pen of one and a quarter pixel.
fn fine(colour: RGBColor) -> ShapeStyle {
    colour.stroke_width(SHARP + SHARP / 4)
}

/// The values with a margin; never so fine that rounding errors fill the strip.
fn scale(strip: &Strip) -> Range<f64> {
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    for (_, l, h) in &strip.band {
        (low, high) = (low.min(*l), high.max(*h));
    }
    if !low.is_finite() || !high.is_finite() {
        return -1.0..1.0;
    }
    let gap = (0.08 * (high - low)).max(0.5 * (strip.least_span - (high - low)));
    low - gap..high + gap
}

/// Lines through the lowest and the highest value of each column: a curve where it goes one way,
/// a filled band where it swings. Where columns are missing the line breaks.
fn outlines(band: &[(f64, f64, f64)]) -> Vec<Vec<(f64, f64)>> {
    let together = band.len().div_ceil(MOST_COLUMNS).max(1);
    let width_s = band.windows(2).map(|w| w[1].0 - w[0].0).fold(f64::INFINITY, f64::min);
    let half_s = if width_s.is_finite() { 0.5 * width_s } else { 0.0 };
    let runs = band.chunk_by(|a, b| b.0 - a.0 < 3.0 * half_s);
    runs.map(|run| outline(run.chunks(together), half_s)).collect()
}

fn outline<'a>(
    columns: impl Iterator<Item = &'a [(f64, f64, f64)]>,
    half_s: f64,
) -> Vec<(f64, f64)> {
    let mut line: Vec<(f64, f64)> = Vec::new();
    for column in columns {
        let (from_s, to_s) = (column[0].0 - half_s, column[column.len() - 1].0 + half_s);
        let low = column.iter().map(|c| c.1).fold(f64::INFINITY, f64::min);
        let high = column.iter().map(|c| c.2).fold(f64::NEG_INFINITY, f64::max);
        if let ([.., before, last], true) = (&mut line[..], low == high)
            && (before.1, last.1) == (low, low)
        {
            last.0 = to_s;
            continue;
        }
        let near_high = line.last().is_some_and(|(_, y)| (y - high).abs() < (y - low).abs());
        let ends = if near_high { [high, low] } else { [low, high] };
        line.extend([(from_s, ends[0]), (to_s, ends[1])]);
    }
    line
}

/// Marks of one kind, those that run together in the picture as one.
fn joined(marks: &[Mark], critical: bool, end_s: f64) -> Vec<Mark> {
    let mut sorted: Vec<Mark> = marks.iter().filter(|m| m.critical == critical).copied().collect();
    sorted.sort_by(|a, b| a.from_s.total_cmp(&b.from_s));
    let mut gap_s = 2.0 * end_s / f64::from(WIDTH);
    loop {
        let mut out: Vec<Mark> = Vec::new();
        for mark in &sorted {
            match out.last_mut() {
                Some(last) if mark.from_s - last.to_s <= gap_s => {
                    last.to_s = last.to_s.max(mark.to_s);
                }
                _ => out.push(*mark),
            }
        }
        // Past the end of time all are one.
        if out.len() <= MOST_MARKS || gap_s > end_s {
            return out;
        }
        gap_s *= 1.5;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_short_peak_is_in_the_outline() {
        let mut band: Vec<_> = (0..2048).map(|i| (f64::from(i), 1.0, 1.0)).collect();
        band[777].2 = 9.0;
        let pieces = outlines(&band);
        assert_eq!(pieces.len(), 1);
        assert!(pieces[0].len() <= 8 && pieces[0].iter().any(|p| p.1 == 9.0));
        band.drain(100..110);
        assert_eq!(outlines(&band).len(), 2); // a gap is a gap
    }

    #[test]
    fn marks_that_run_together_are_one() {
        let mark = |from_s, to_s| Mark { from_s, to_s, critical: true };
        let marks = [mark(50.0, 60.0), mark(1.0, 2.0), mark(59.0, 70.0)];
        assert_eq!(joined(&marks, true, 100.0), [mark(1.0, 2.0), mark(50.0, 70.0)]);
        assert!(joined(&marks, false, 100.0).is_empty());
        let many: Vec<_> = (0..5000).map(|i| mark(f64::from(i), f64::from(i))).collect();
        assert!(joined(&many, true, 5000.0).len() <= MOST_MARKS);
    }
}
