//! The customary charts of the standards as SVG text.

use super::plots::{
    Area, COLOURS, Chart, DrawingError, FAINT, Flat, INK, Labels, SHARP, axes, drawing_error, ink,
    legend, pen, px,
};
use plotters::coord::types::RangedCoordf64;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use std::f64::consts::TAU;

type Done = Result<(), DrawingError>;
const HEIGHT: u32 = 380;
const WIDTH: u32 = 1000;
const ROUND: u32 = 640;

fn colour(i: usize) -> RGBColor {
    COLOURS[i % COLOURS.len()]
}

/// One series of a chart.
pub struct Band {
    /// For the legend.
    pub label: String,
    /// Which of the seven colours of series, from 0.
    pub colour: usize,
    /// x, y and half the width of the band around it.
    pub line: Vec<(f64, f64, f64)>,
    /// Single readings.
    pub points: Vec<(f64, f64)>,
}

/// Readings, means and bands over a common x.
pub struct Scatter {
    /// Above it.
    pub title: String,
    /// Below it.
    pub note: String,
    /// Under the x axis, with unit.
    pub x: String,
    /// Beside the y axis, with unit.
    pub y: String,
    /// Whether 0 belongs on the y axis.
    pub from_zero: bool,
    /// The series.
    pub bands: Vec<Band>,
    /// A dashed line.
    pub dashed: Vec<(f64, f64)>,
}

/// A closed or open curve around.
pub struct PolarLine {
    /// For the legend.
    pub label: String,
    /// Which of the seven colours of series, from 0.
    pub colour: usize,
    /// Angle in rad and radial deviation in µm.
    pub points: Vec<(f64, f64)>,
}

/// Radial deviations, magnified, about a nominal circle.
pub struct Polar {
    /// Above it.
    pub title: String,
    /// Below it.
    pub note: String,
    /// The curves.
    pub lines: Vec<PolarLine>,
}

/// A picture of a report.
pub enum Picture {
    /// Over a straight axis.
    Scatter(Scatter),
    /// Around a circle.
    Polar(Polar),
}

impl Picture {
    /// What stands above it.
    pub fn title(&self) -> &str {
        match self {
            Self::Scatter(s) => &s.title,
            Self::Polar(p) => &p.title,
        }
    }

    /// Gives it another title.
    pub fn rename(&mut self, title: &str) {
        match self {
            Self::Scatter(s) => s.title = title.to_owned(),
            Self::Polar(p) => p.title = title.to_owned(),
        }
    }

    /// What stands below it.
    pub fn note(&self) -> &str {
        match self {
            Self::Scatter(s) => &s.note,
            Self::Polar(p) => &p.note,
        }
    }

    /// As high as wide.
    pub fn is_round(&self) -> bool {
        matches!(self, Self::Polar(_))
    }

    /// The picture.
    ///
    /// # Errors
    /// What the drawing library says.
    pub fn svg(&self) -> Result<String, DrawingError> {
        match self {
            Self::Scatter(s) => draw((WIDTH, HEIGHT), |area| scatter(area, s)),
            Self::Polar(p) => draw((ROUND, ROUND), |area| polar(area, p)),
        }
    }
}

fn draw(size: (u32, u32), paint: impl FnOnce(&Area<'_>) -> Done) -> Result<String, DrawingError> {
    let mut svg = String::new();
    let (width, height) = (size.0 * SHARP, size.1 * SHARP);
    {
        let area = SVGBackend::with_string(&mut svg, (width, height)).into_drawing_area();
        area.fill(&WHITE).map_err(drawing_error)?;
        paint(&area)?;
        area.present().map_err(drawing_error)?;
    }
    // The page scales the picture: a view box instead of a fixed size.
    Ok(svg.replacen(&format!("width=\"{width}\" height=\"{height}\" viewBox"), "viewBox", 1))
}

fn range(values: impl Iterator<Item = f64>, margin: f64) -> std::ops::Range<f64> {
    let ends = values.filter(|v| v.is_finite());
    let start = (f64::INFINITY, f64::NEG_INFINITY);
    let (low, high) = ends.fold(start, |(low, high), v| (low.min(v), high.max(v)));
    if low > high {
        return -1.0..1.0;
    }
    let gap = ((high - low) * margin).max(1e-3 * high.abs().max(low.abs()).max(1e-3));
    low - gap..high + gap
}

fn scatter(area: &Area<'_>, s: &Scatter) -> Done {
    let line = || s.bands.iter().flat_map(|b| &b.line);
    let points = || s.bands.iter().flat_map(|b| &b.points).chain(&s.dashed);
    let xs = range(line().map(|p| p.0).chain(points().map(|p| p.0)), 0.02);
    let bands = line().flat_map(|p| [p.1 - p.2, p.1 + p.2]);
    let ys = range(bands.chain(points().map(|p| p.1)).chain(s.from_zero.then_some(0.0)), 0.12);
    let ends = [xs.start, xs.end];
    let mut chart = axes(area, &Labels { x: &s.x, y: &s.y }, (xs, ys))?;
    if s.from_zero {
        let zero = LineSeries::new(ends.map(|x| (x, 0.0)), pen(INK, 1));
        chart.draw_series(zero).map_err(drawing_error)?;
    }
    for band in &s.bands {
        draw_band(&mut chart, band)?;
    }
    for piece in s.dashed.windows(2) {
        // Each piece with a gap in its middle and at its ends.
        let at = |t: f64| {
            (piece[0].0 + t * (piece[1].0 - piece[0].0), piece[0].1 + t * (piece[1].1 - piece[0].1))
        };
        for k in 0..4 {
            let from = f64::from(k) * 0.25;
            let dash = PathElement::new([at(from), at(from + 0.14)], pen(INK, 2));
            chart.plotting_area().draw(&dash).map_err(drawing_error)?;
        }
    }
    if s.bands.len() > 1 {
        legend(&mut chart, SeriesLabelPosition::UpperLeft)?;
    }
    Ok(())
}

fn draw_band(chart: &mut Chart<'_, '_>, band: &Band) -> Done {
    let paint = colour(band.colour);
    if band.line.iter().any(|p| p.2 > 0.0) {
        let upper = band.line.iter().map(|p| (p.0, p.1 + p.2));
        let lower = band.line.iter().rev().map(|p| (p.0, p.1 - p.2));
        let outline: Vec<_> = upper.chain(lower).collect();
        let area = Polygon::new(outline, paint.mix(0.16).filled());
        chart.plotting_area().draw(&area).map_err(drawing_error)?;
    }
    let dots = band.points.iter().map(|p| Circle::new(*p, px(2), paint.mix(0.55).filled()));
    chart.draw_series(dots).map_err(drawing_error)?;
    let line = LineSeries::new(band.line.iter().map(|p| (p.0, p.1)), pen(paint, 2));
    chart
        .draw_series(line)
        .map_err(drawing_error)?
        .label(&band.label)
        .legend(move |(x, y)| PathElement::new([(x, y), (x + px(16), y)], pen(paint, 3)));
    Ok(())
}

/// 1, 2 or 5 times a power of ten, not below the value.
fn round_step(value: f64) -> f64 {
    let power = 10_f64.powf(value.max(1e-9).log10().floor());
    let step = [1.0, 2.0, 5.0, 10.0].into_iter().find(|s| s * power >= value).unwrap_or(10.0);
    step * power
}

fn polar(area: &Area<'_>, p: &Polar) -> Done {
    let most = p.lines.iter().flat_map(|l| &l.points).fold(1e-3_f64, |m, q| m.max(q.1.abs()));
    let ring_um = round_step(most / 3.0);
    // The nominal circle and as much to either side as the largest deviation needs.
    let (base, per_um) = (0.52, 0.32 / most);
    let side = 0..(ROUND * SHARP) as i32;
    let flat: Flat<'_> = area.apply_coord_spec(Cartesian2d::<RangedCoordf64, RangedCoordf64>::new(
        -1.0..1.0,
        1.0..-1.0,
        (side.clone(), side),
    ));
    let place = |angle: f64, um: f64| {
        let r = base + um * per_um;
        (r * angle.cos(), r * angle.sin())
    };
    let rings = (0.34 / (ring_um * per_um)).floor() as i32;
    for k in -rings..=rings {
        let um = f64::from(k) * ring_um;
        let ring: Vec<_> = (0..=240).map(|i| place(TAU * f64::from(i) / 240.0, um)).collect();
        let style = if k == 0 { pen(INK, 2) } else { pen(FAINT, 1) };
        flat.draw(&PathElement::new(ring, style)).map_err(drawing_error)?;
    }
    for i in 0..8 {
        let angle = TAU * f64::from(i) / 8.0;
        let at = |r: f64| (r * angle.cos(), r * angle.sin());
        flat.draw(&PathElement::new([at(0.16), at(0.88)], pen(FAINT, 1))).map_err(drawing_error)?;
        let style = ink(13).pos(Pos::new(HPos::Center, VPos::Center));
        flat.draw(&Text::new(format!("{}°", i * 45), at(0.94), style)).map_err(drawing_error)?;
    }
    for line in &p.lines {
        let outline: Vec<_> = line.points.iter().map(|q| place(q.0, q.1)).collect();
        flat.draw(&PathElement::new(outline, pen(colour(line.colour), 2)))
            .map_err(drawing_error)?;
    }
    let digits = if ring_um < 1.0 { 2 } else { 0 };
    let ring = format!("one ring: {ring_um:.digits$} µm");
    area.draw(&Text::new(ring, (px(8), px(8)), ink(13))).map_err(drawing_error)?;
    for (i, line) in p.lines.iter().enumerate().take(6) {
        let y = px(30 + 18 * i as i32);
        let dash = PathElement::new(
            [(px(8), y + px(6)), (px(26), y + px(6))],
            pen(colour(line.colour), 3),
        );
        area.draw(&dash).map_err(drawing_error)?;
        area.draw(&Text::new(line.label.clone(), (px(32), y), ink(13))).map_err(drawing_error)?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_are_round() {
        assert_eq!([0.3, 1.0, 2.1, 7.0].map(round_step), [0.5, 1.0, 5.0, 10.0]);
    }

    #[test]
    fn a_chart_of_one_point_is_drawn() {
        let band =
            Band { label: "a".into(), colour: 0, line: vec![(0.0, 0.0, 0.0)], points: Vec::new() };
        let words = || String::new();
        let chart = Scatter {
            title: words(),
            note: words(),
            x: words(),
            y: words(),
            from_zero: true,
            bands: vec![band],
            dashed: Vec::new(),
        };
        assert!(Picture::Scatter(chart).svg().unwrap().starts_with("<svg viewBox"));
    }
}
