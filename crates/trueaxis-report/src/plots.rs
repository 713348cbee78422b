//! Pictures as SVG text, for a page that opens offline.

use plotters::coord::types::RangedCoordf64;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use std::f64::consts::{PI, TAU};
use std::ops::Range;

/// A picture that could not be drawn.
#[derive(Debug, thiserror::Error)]
#[error("a picture could not be drawn: {0}")]
pub struct DrawingError(String);

/// What a drawing library said.
pub fn drawing_error(error: impl std::fmt::Display) -> DrawingError {
    DrawingError(error.to_string())
}

/// A picture that is drawn.
pub type Area<'a> = DrawingArea<SVGBackend<'a>, plotters::coord::Shift>;
/// A picture with axes.
pub type Chart<'a, 'b> =
    ChartContext<'a, SVGBackend<'b>, Cartesian2d<RangedCoordf64, RangedCoordf64>>;
/// A picture with coordinates of its own.
pub type Flat<'a> = DrawingArea<SVGBackend<'a>, Cartesian2d<RangedCoordf64, RangedCoordf64>>;

/// Colours that stay distinct for colour-blind readers (Okabe and Ito).
pub const COLOURS: [RGBColor; 7] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(230, 159, 0),
    RGBColor(86, 180, 233),
    RGBColor(90, 90, 90),
];
/// Text and axes.
pub const INK: RGBColor = RGBColor(40, 46, 54);
/// Grids and what is beside the matter.
pub const FAINT: RGBColor = RGBColor(200, 206, 212);
const FONT: &str = "sans-serif";
/// The library rounds to whole pixels: draw this much larger and let the view box scale it back.
pub const SHARP: u32 = 4;

/// A length of the picture in the pixels of the drawing.
pub const fn px(length: i32) -> i32 {
    length * SHARP as i32
}

/// A line of a colour and width.
pub fn pen(colour: RGBColor, width: u32) -> ShapeStyle {
    colour.stroke_width(width * SHARP)
}

/// Text of a size.
pub fn ink(size: i32) -> TextStyle<'static> {
    (FONT, px(size)).into_font().color(&INK)
}

/// A named curve.
pub struct Curve {
    /// Shown in the legend.
    pub label: String,
    /// x and y.
    pub points: Vec<(f64, f64)>,
}

/// Words around a chart of curves.
pub struct Labels<'a> {
    /// Under the x axis, with unit.
    pub x: &'a str,
    /// Beside the y axis, with unit.
    pub y: &'a str,
}

/// Draws a picture of a size and hands out its SVG text.
pub fn draw(
    size: (u32, u32),
    paint: impl FnOnce(&Area<'_>) -> Result<(), DrawingError>,
) -> Result<String, DrawingError> {
    let mut svg = String::new();
    let size = (size.0 * SHARP, size.1 * SHARP);
    {
        let area = SVGBackend::with_string(&mut svg, size).into_drawing_area();
        area.fill(&WHITE).map_err(drawing_error)?;
        paint(&area)?;
        area.present().map_err(drawing_error)?;
    }
    Ok(scalable(svg, size))
}

/// Lets the page scale the picture: a view box instead of fixed width and height.
fn scalable(svg: String, (width, height): (u32, u32)) -> String {
    let fixed = format!("width=\"{width}\" height=\"{height}\" viewBox");
    svg.replacen(&fixed, "viewBox", 1)
}

fn range(values: impl Iterator<Item = f64>, margin: f64) -> std::ops::Range<f64> {
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    for v in values {
        (low, high) = (low.min(v), high.max(v));
    }
    if !low.is_finite() || !high.is_finite() {
        return -1.0..1.0;
    }
    let gap = ((high - low) * margin).max(1e-9 * high.abs().max(1.0));
    low - gap..high + gap
}

/// The two axes with their words and ticks; the chart to draw on.
pub fn axes<'a, 'b>(
    area: &'a Area<'b>,
    labels: &Labels<'_>,
    (xs, ys): (Range<f64>, Range<f64>),
) -> Result<Chart<'a, 'b>, DrawingError> {
    let (x_span, y_span) = (xs.end - xs.start, ys.end - ys.start);
    let mut chart = ChartBuilder::on(area)
        .margin(px(12))
        .x_label_area_size(px(40))
        .y_label_area_size(px(66))
        .build_cartesian_2d(xs, ys)
        .map_err(drawing_error)?;
    chart
        .configure_mesh()
        .x_desc(labels.x)
        .y_desc(labels.y)
        .light_line_style(WHITE)
        .axis_style(pen(INK, 1))
        .bold_line_style(pen(FAINT, 1))
        .set_all_tick_mark_size(px(4))
        .x_label_formatter(&|x| tick(*x, x_span))
        .y_label_formatter(&|y| tick(*y, y_span))
        .label_style(ink(13))
        .draw()
        .map_err(drawing_error)?;
    Ok(chart)
}

/// The box that says which line is which.
pub fn legend<'a, 'b: 'a>(
    chart: &mut Chart<'a, 'b>,
    position: SeriesLabelPosition,
) -> Result<(), DrawingError> {
    chart
        .configure_series_labels()
        .position(position)
        .background_style(WHITE.mix(0.85))
        .border_style(FAINT)
        .margin(px(6))
        .legend_area_size(px(22))
        .label_font(ink(13))
        .draw()
        .map_err(drawing_error)
}

/// Curves over a common x axis.
///
/// # Errors
/// What the drawing library says.
pub fn curves(
    size: (u32, u32),
    labels: &Labels<'_>,
    curves: &[Curve],
) -> Result<String, DrawingError> {
    draw(size, |area| {
        let xs = range(curves.iter().flat_map(|c| c.points.iter().map(|p| p.0)), 0.0);
        let ys = range(curves.iter().flat_map(|c| c.points.iter().map(|p| p.1)), 0.08);
        let mut chart = axes(area, labels, (xs, ys))?;
        for (i, curve) in curves.iter().enumerate() {
            let colour = COLOURS[i % COLOURS.len()];
            let line = LineSeries::new(curve.points.iter().copied(), pen(colour, 2));
            chart
                .draw_series(line)
                .map_err(drawing_error)?
                .label(&curve.label)
                .legend(move |(x, y)| PathElement::new([(x, y), (x + px(16), y)], pen(colour, 3)));
        }
        if curves.len() > 1 {
            legend(&mut chart, SeriesLabelPosition::UpperRight)?;
        }
        Ok(())
    })
}

/// A number on an axis, with as many digits as its span needs.
pub fn tick(value: f64, span: f64) -> String {
    let digits = (1.0 - span.max(1e-9).log10()).ceil().clamp(0.0, 6.0) as usize;
    let text = format!("{value:.digits$}");
    if text.trim_start_matches(['-', '0', '.']).is_empty() { "0".to_owned() } else { text }
}

/// A circle that was fitted to a profile.
pub struct FittedCircle {
    /// Shown in the legend; empty: not shown.
    pub label: String,
    /// Centre, mm.
    pub centre_mm: [f64; 2],
    /// Radius minus the nominal radius of the section, mm.
    pub excess_mm: f64,
    /// Drawn dashed.
    pub dashed: bool,
    /// Its colour.
    pub colour: RGBColor,
}

/// The profile of a section, its deviations magnified, with fitted circles.
pub struct Profile<'a> {
    /// Azimuth (rad) and radial deviation (mm) of every point.
    pub points: &'a [(f64, f64)],
    /// The fits to show.
    pub circles: &'a [FittedCircle],
}

/// Height of a line of the legend.
const LEGEND_ROW: u32 = 18;

/// A polar picture; a ring of the grid is a round number of micrometres, given in the text.
///
/// # Errors
/// What the drawing library says.
pub fn polar(size: u32, profile: &Profile<'_>) -> Result<String, DrawingError> {
    let most = profile.points.iter().fold(1e-9_f64, |m, p| m.max(p.1.abs()));
    // Deviations take a third of the radius; the ring distance is 1, 2 or 5 times a power of ten.
    let per_mm = 0.34 / most;
    let ring_mm = round_step(most / 2.5);
    let named = profile.circles.iter().filter(|c| !c.label.is_empty()).count() as u32;
    draw((size, size + LEGEND_ROW * named + 8), |area| {
        let flat = plane(area, size * SHARP);
        let base = 0.53;
        let place = |azimuth: f64, radial_mm: f64| {
            let r = base + radial_mm * per_mm;
            (r * azimuth.cos(), r * azimuth.sin())
        };
        let ring = |radial_mm: f64| -> Vec<(f64, f64)> {
            (0..=180).map(|i| place(TAU * f64::from(i) / 180.0, radial_mm)).collect()
        };
        let rings = (most / ring_mm).ceil() as i32 + 1;
        for i in -rings..=rings {
            let radial = f64::from(i) * ring_mm;
            if base + radial * per_mm > 0.02 && radial * per_mm < 0.36 {
                let style = if i == 0 { pen(INK, 1) } else { pen(FAINT, 1) };
                flat.draw(&PathElement::new(ring(radial), style)).map_err(drawing_error)?;
            }
        }
        azimuth_ticks(&flat)?;
        for circle in profile.circles {
            let [cx, cy] = circle.centre_mm;
            let points: Vec<_> = (0..=360)
                .map(|k| {
                    let azimuth = TAU * f64::from(k) / 360.0;
                    let shift = cx * azimuth.cos() + cy * azimuth.sin();
                    place(azimuth, shift + circle.excess_mm)
                })
                .collect();
            for piece in pieces(&points, circle.dashed) {
                let path = PathElement::new(piece, pen(circle.colour, 2));
                flat.draw(&path).map_err(drawing_error)?;
            }
        }
        let mut outline: Vec<_> = profile.points.iter().map(|p| place(p.0, p.1)).collect();
        outline.extend(outline.first().copied());
        let path = PathElement::new(outline, pen(COLOURS[0], 3));
        flat.draw(&path).map_err(drawing_error)?;
        polar_legend(area, size, ring_mm, profile.circles)
    })
}

fn plane<'a>(area: &Area<'a>, size: u32) -> Flat<'a> {
    let pixels = (0..size as i32, 0..size as i32);
    area.apply_coord_spec(Cartesian2d::<RangedCoordf64, RangedCoordf64>::new(
        -1.0..1.0,
        1.0..-1.0,
        pixels,
    ))
}

/// The whole path, or every second piece of it for a dashed line.
fn pieces(points: &[(f64, f64)], dashed: bool) -> Vec<Vec<(f64, f64)>> {
    if !dashed {
        return vec![points.to_vec()];
    }
    points.chunks(5).step_by(2).map(<[_]>::to_vec).collect()
}

fn azimuth_ticks(flat: &Flat<'_>) -> Result<(), DrawingError> {
    for i in 0..12 {
        let azimuth = TAU * f64::from(i) / 12.0;
        let at = |r: f64| (r * azimuth.cos(), r * azimuth.sin());
        let tick = PathElement::new([at(0.10), at(0.88)], pen(FAINT, 1));
        flat.draw(&tick).map_err(drawing_error)?;
        let style = ink(12).pos(Pos::new(HPos::Center, VPos::Center));
        let text = Text::new(format!("{}°", i * 30), at(0.93), style);
        flat.draw(&text).map_err(drawing_error)?;
    }
    Ok(())
}

fn polar_legend(
    area: &Area<'_>,
    size: u32,
    ring_mm: f64,
    circles: &[FittedCircle],
) -> Result<(), DrawingError> {
    let font = ink(13);
    let ring = format!("ring: {} µm", shown(ring_mm * 1e3));
    area.draw(&Text::new(ring, (px(8), px(8)), font.clone())).map_err(drawing_error)?;
    let named: Vec<_> = circles.iter().filter(|c| !c.label.is_empty()).collect();
    for (i, circle) in named.iter().enumerate() {
        let y = px((size + LEGEND_ROW * i as u32) as i32);
        let ends = [(px(8), y + px(6)), (px(26), y + px(6))];
        area.draw(&PathElement::new(ends, pen(circle.colour, 3))).map_err(drawing_error)?;
        let text = Text::new(circle.label.clone(), (px(32), y), font.clone());
        area.draw(&text).map_err(drawing_error)?;
    }
    Ok(())
}

/// 1, 2 or 5 times a power of ten, near the value.
pub fn round_step(value: f64) -> f64 {
    let power = 10_f64.powf(value.max(1e-12).log10().floor());
    let steps = [1.0, 2.0, 5.0, 10.0];
    let step = steps.iter().find(|s| **s * power >= value).unwrap_or(&10.0);
    step * power
}

fn shown(value: f64) -> String {
    format!("{}", (value * 1e6).round() / 1e6)
}

/// The error on the cone, unrolled into the plane: exact, since a cone can be unrolled.
pub struct ConeMap<'a> {
    /// Half angle, rad.
    pub half_angle_rad: f64,
    /// Base radius, mm.
    pub base_radius_mm: f64,
    /// Azimuths of the tool positions, rad.
    pub azimuths_rad: &'a [f64],
    /// Heights above the base, mm.
    pub heights_mm: &'a [f64],
    /// E in mm, height after height.
    pub error_mm: &'a [Vec<f64>],
}

/// The unrolled cone with its error in colours: blue material taken too much, red left standing.
///
/// # Errors
/// What the drawing library says.
pub fn cone_map(size: (u32, u32), map: &ConeMap<'_>) -> Result<String, DrawingError> {
    let most = map.error_mm.iter().flatten().fold(1e-9_f64, |m, e| m.max(e.abs()));
    draw(size, |area| {
        let count = map.azimuths_rad.len();
        let fields = (0..count).flat_map(|j| (1..map.heights_mm.len()).map(move |k| (j, k)));
        let unrolled = Unrolled::new(map, (size.0 * SHARP, size.1 * SHARP));
        for (j, k) in fields {
            let next = map.azimuths_rad.get(j + 1).copied().unwrap_or(TAU);
            let corners = [
                unrolled.place(map.azimuths_rad[j], map.heights_mm[k - 1]),
                unrolled.place(next, map.heights_mm[k - 1]),
                unrolled.place(next, map.heights_mm[k]),
                unrolled.place(map.azimuths_rad[j], map.heights_mm[k]),
            ];
            let around = (j + 1) % count;
            let mean = 0.25
                * (map.error_mm[k - 1][j]
                    + map.error_mm[k - 1][around]
                    + map.error_mm[k][j]
                    + map.error_mm[k][around]);
            let field = Polygon::new(corners, heat(mean / most).filled());
            area.draw(&field).map_err(drawing_error)?;
        }
        let font = ink(13);
        for i in 0..4 {
            let azimuth = TAU * f64::from(i) / 4.0;
            let (x, y) = unrolled.place(azimuth, map.heights_mm.first().copied().unwrap_or(0.0));
            let text = Text::new(format!("{}°", i * 90), (x - px(10), y + px(4)), font.clone());
            area.draw(&text).map_err(drawing_error)?;
        }
        for height in map.heights_mm.first().into_iter().chain(map.heights_mm.last()) {
            let (x, y) = unrolled.place(TAU, *height);
            let text = Text::new(format!("H {height:.0} mm"), (x + px(8), y - px(8)), font.clone());
            area.draw(&text).map_err(drawing_error)?;
        }
        colour_bar(area, size, most)
    })
}

/// Where a point of the cone lies in the unrolled picture.
struct Unrolled {
    half_angle: f64,
    base: f64,
    shift: (f64, f64),
    scale: f64,
}

impl Unrolled {
    fn new(map: &ConeMap<'_>, (width, height): (u32, u32)) -> Self {
        let mut unrolled = Self {
            half_angle: map.half_angle_rad,
            base: map.base_radius_mm,
            shift: (0.0, 0.0),
            scale: 1.0,
        };
        let heights = [map.heights_mm.first(), map.heights_mm.last()];
        let corners: Vec<(f64, f64)> = (0..=72)
            .flat_map(|i| {
                heights.into_iter().flatten().map(move |h| (TAU * f64::from(i) / 72.0, *h))
            })
            .map(|(azimuth, h)| unrolled.flat(azimuth, h))
            .collect();
        let (xs, ys) =
            (range(corners.iter().map(|c| c.0), 0.0), range(corners.iter().map(|c| c.1), 0.0));
        let (width, height) =
            (f64::from(width) - f64::from(px(130)), f64::from(height) - f64::from(px(90)));
        unrolled.scale = (width / (xs.end - xs.start)).min(height / (ys.end - ys.start));
        let middle = 0.5 * (xs.start + xs.end) * unrolled.scale;
        unrolled.shift = (
            f64::from(px(30)) + 0.5 * width - middle,
            f64::from(px(20)) - ys.start * unrolled.scale,
        );
        unrolled
    }

    /// mm in the plane, y downwards; a cylinder unrolls into a strip.
    fn flat(&self, azimuth: f64, height: f64) -> (f64, f64) {
        let sine = self.half_angle.sin();
        if sine < 1e-3 {
            return (self.base * (azimuth - PI), -height);
        }
        let along = (self.base - height * self.half_angle.tan()) / sine;
        let angle = (azimuth - PI) * sine;
        (along * angle.sin(), along * angle.cos())
    }

    fn place(&self, azimuth: f64, height: f64) -> (i32, i32) {
        let (x, y) = self.flat(azimuth, height);
        let pixel = |v: f64, shift: f64| (v * self.scale + shift).round() as i32;
        (pixel(x, self.shift.0), pixel(y, self.shift.1))
    }
}

/// Blue over white to red for −1 … 1.
pub fn heat(t: f64) -> RGBColor {
    let t = t.clamp(-1.0, 1.0);
    let end = if t < 0.0 { (33.0, 102.0, 172.0) } else { (178.0, 24.0, 43.0) };
    let mix = |c: f64| (247.0 + (c - 247.0) * t.abs()) as u8;
    RGBColor(mix(end.0), mix(end.1), mix(end.2))
}

/// The scale of [`heat`] at the lower edge of a picture of this size, up to the largest deviation in mm.
pub fn colour_bar(
    area: &Area<'_>,
    (width, height): (u32, u32),
    most: f64,
) -> Result<(), DrawingError> {
    let (left, right) = (px(width as i32 / 4), px(width as i32 * 3 / 4));
    let y = px(height as i32 - 40);
    for x in (left..right).step_by(SHARP as usize) {
        let t = 2.0 * f64::from(x - left) / f64::from(right - left) - 1.0;
        let strip = Rectangle::new([(x, y), (x + px(2), y + px(12))], heat(t).filled());
        area.draw(&strip).map_err(drawing_error)?;
    }
    let font = ink(13);
    let ends = [(left - px(20), -most, " cut too deep"), (right - px(40), most, " left standing")];
    for (x, value, words) in ends {
        let text = format!("{:+.1} µm{words}", value * 1e3);
        area.draw(&Text::new(text, (x, y + px(16)), font.clone())).map_err(drawing_error)?;
    }
    Ok(())
}

/// One bar of an error budget.
pub struct Bar {
    /// The error.
    pub label: String,
    /// The index if there were only this error, mm.
    pub alone_mm: f64,
    /// How much the index falls if this error is removed, mm; negative: it rises.
    pub relief_mm: f64,
}

/// Horizontal bars: alone (blue) and relief when removed (orange), the greatest first.
///
/// # Errors
/// What the drawing library says.
pub fn bars(width: u32, bars: &[Bar]) -> Result<String, DrawingError> {
    let row = 26;
    let height = bars.len() as i32 * row + 44;
    let all = bars.iter().flat_map(|b| [b.alone_mm * 1e3, b.relief_mm * 1e3, 0.0]);
    let span = range(all, 0.02);
    draw((width, height as u32), |area| {
        let (left, right) = (f64::from(px(64)), f64::from(px(width as i32 - 84)));
        let x = |um: f64| {
            (left + (um - span.start) / (span.end - span.start) * (right - left)).round() as i32
        };
        let font = ink(13);
        let zero = [(x(0.0), px(4)), (x(0.0), px(height - 36))];
        area.draw(&PathElement::new(zero, pen(INK, 1))).map_err(drawing_error)?;
        for (i, bar) in bars.iter().enumerate() {
            let y = px(6 + row * i as i32);
            area.draw(&Text::new(bar.label.clone(), (px(8), y + px(3)), font.clone()))
                .map_err(drawing_error)?;
            let values = [(bar.alone_mm, COLOURS[0], 0), (bar.relief_mm, COLOURS[4], 10)];
            for (value, colour, drop) in values {
                let ends = [(x(0.0), y + px(drop)), (x(value * 1e3), y + px(drop + 9))];
                area.draw(&Rectangle::new(ends, colour.filled())).map_err(drawing_error)?;
            }
            let most = bar.alone_mm.max(bar.relief_mm).max(0.0) * 1e3;
            let text = format!("{:.1} / {:+.1}", bar.alone_mm * 1e3, bar.relief_mm * 1e3);
            area.draw(&Text::new(text, (x(most) + px(6), y + px(3)), font.clone()))
                .map_err(drawing_error)?;
        }
        let legend = "µm: blue, this error alone; orange, what the index loses without it";
        area.draw(&Text::new(legend, (px(8), px(height - 24)), font)).map_err(drawing_error)
    })
}
