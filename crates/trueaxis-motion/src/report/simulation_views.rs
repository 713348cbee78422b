//! Pictures of a simulation: the path of the tool in three views and an oblique one.

use super::simulation_plots::{GRID, RIGHT, TITLE, WIDTH};
use crate::PathPoint;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use std::fmt::Write as _;
use trueaxis_geometry::Vec3;
use trueaxis_report::plots::{
    Area, DrawingError, FAINT, INK, SHARP, draw, drawing_error, ink, pen, px, tick,
};

/// Steps of the colour scale.
const LEVELS: usize = 12;

/// Light blue over violet to dark red: darker means worse, also in grey.
fn level_colour(level: usize) -> RGBColor {
    let stops = [(86.0, 180.0, 233.0), (150.0, 90.0, 190.0), (150.0, 0.0, 30.0)];
    let at = 2.0 * level as f64 / (LEVELS - 1) as f64;
    let (from, part) = if at < 1.0 { (0, at) } else { (1, at - 1.0) };
    let (a, b): ((f64, f64, f64), (f64, f64, f64)) = (stops[from], stops[from + 1]);
    let mix = |a: f64, b: f64| (a + part * (b - a)).round() as u8;
    RGBColor(mix(a.0, b.0), mix(a.1, b.1), mix(a.2, b.2))
}

/// What the colours stand for, mm.
struct Colours {
    low: f64,
    high: f64,
}

impl Colours {
    /// From the lowest to the highest; from 0 if all are nearly the same.
    fn over(values: impl Iterator<Item = f64>) -> Self {
        let none = (f64::INFINITY, 0.0_f64);
        let (low, high) = values.fold(none, |(l, h), v| (l.min(v), h.max(v)));
        Self { low: if high - low > 0.02 * high { low } else { 0.0 }, high }
    }

    fn level(&self, value: f64) -> usize {
        let part = (value - self.low) / (self.high - self.low);
        // The cast takes what is no number for 0.
        ((part * LEVELS as f64) as usize).min(LEVELS - 1)
    }
}

/// A view: what goes to the right and what goes up, from a place.
#[derive(Clone, Copy)]
struct View {
    title: &'static str,
    right: Vec3,
    up: Vec3,
    /// Names of the two axes; none for the oblique view.
    names: Option<[&'static str; 2]>,
}

const TOP: View = View {
    title: "from above",
    right: Vec3::new(1.0, 0.0, 0.0),
    up: Vec3::new(0.0, 1.0, 0.0),
    names: Some(["X, mm", "Y, mm"]),
};
const FRONT: View = View {
    title: "from the front",
    right: Vec3::new(1.0, 0.0, 0.0),
    up: Vec3::new(0.0, 0.0, 1.0),
    names: Some(["X, mm", "Z, mm"]),
};
const SIDE: View = View {
    title: "from the right",
    right: Vec3::new(0.0, 1.0, 0.0),
    up: Vec3::new(0.0, 0.0, 1.0),
    names: Some(["Y, mm", "Z, mm"]),
};
/// Isometric from the front right above: cos 30° and sin 30°.
const OBLIQUE: View = View {
    title: "from the front right above",
    right: Vec3::new(0.866_025_403_784_438_6, 0.866_025_403_784_438_6, 0.0),
    up: Vec3::new(-0.5, 0.5, 1.0),
    names: None,
};

/// A view in its place of the picture.
struct Panel {
    view: View,
    /// Upper left corner and size of the drawing, in pixels of the picture.
    corner: [i32; 2],
    size: [i32; 2],
    /// The coordinates in the upper left corner, mm.
    from_mm: [f64; 2],
    per_mm: f64,
}

/// Room left of and under a view for its numbers.
const BESIDE: i32 = 60;
const UNDER: i32 = 40;
/// Room for the colour bar.
const BAR: i32 = 52;
/// The views are together at most so high.
const MOST_HEIGHT: f64 = 620.0;

/// The path of the tip as a technical drawing: top view over front view, side view to the right, all of
/// one scale; an oblique view in the free corner. Feed in the colour of the deviation, rapid thin.
///
/// # Errors
/// What the drawing library reports.
pub fn tool_path(points: &[PathPoint]) -> Result<String, DrawingError> {
    let (panels, height) = arrange(feed_box(points));
    let feed = points.iter().filter(|p| !p.rapid && p.off_mm.is_finite());
    let colours = Colours::over(feed.map(|p| p.off_mm));
    let svg = draw((WIDTH as u32, (height + BAR) as u32), |area| {
        for panel in &panels {
            draw_frame(area, panel)?;
        }
        colour_bar(area, height, &colours)
    })?;
    let mut lines = String::new();
    for (i, panel) in panels.iter().enumerate() {
        write_lines(&mut lines, i, panel, points, &colours);
    }
    Ok(svg.replacen("</svg>", &format!("{lines}</svg>"), 1))
}

/// What the tool reaches with feed, or at all if it never feeds.
fn feed_box(points: &[PathPoint]) -> [Vec3; 2] {
    let around = |rapid_too: bool| {
        let used = points.iter().filter(|p| rapid_too || !p.rapid).map(|p| p.tip_mm);
        let mut found: Option<[Vec3; 2]> = None;
        for p in used.filter(|p| p.iter().all(|v| v.is_finite())) {
            let [low, high] = found.get_or_insert([p, p]);
            (*low, *high) = (low.inf(&p), high.sup(&p));
        }
        found
    };
    let [low, high] =
        around(false).or_else(|| around(true)).unwrap_or([Vec3::zeros(), Vec3::zeros()]);
    let most = (high - low).max().max(1e-3);
    let middle = 0.5 * (low + high);
    // Flat parts still get a view of some height, and all a margin.
    let half = (0.5 * (high - low)).map(|h| h.max(0.08 * most) + 0.05 * most);
    [middle - half, middle + half]
}

/// The views in their places, and the height that they take.
fn arrange([low, high]: [Vec3; 2]) -> (Vec<Panel>, i32) {
    let span = high - low;
    let wide = f64::from(WIDTH - 2 * BESIDE - RIGHT - 16);
    let per_mm = (wide / (span.x + span.y)).min(MOST_HEIGHT / (span.y + span.z));
    let pixels = |mm: f64| (mm * per_mm).round() as i32;
    let (x, y, z) = (pixels(span.x), pixels(span.y), pixels(span.z));
    let left = BESIDE + ((wide as i32) - x - y).max(0) / 2;
    let (second_left, second_top) = (left + x + 16 + BESIDE, TITLE + y + UNDER + TITLE);
    let panel = |view: View, corner: [i32; 2], size: [i32; 2], from_mm: [f64; 2]| Panel {
        view,
        corner,
        size,
        from_mm,
        per_mm,
    };
    let mut panels = vec![
        panel(TOP, [left, TITLE], [x, y], [low.x, high.y]),
        panel(FRONT, [left, second_top], [x, z], [low.x, high.z]),
        panel(SIDE, [second_left, second_top], [y, z], [low.y, high.z]),
    ];
    if y >= 150 {
        panels.push(oblique([low, high], [second_left, TITLE], [y, y]));
    }
    (panels, second_top + z + UNDER)
}

fn oblique([low, high]: [Vec3; 2], corner: [i32; 2], size: [i32; 2]) -> Panel {
    let corners = (0..8).map(|i| {
        let pick = |bit: i32, axis: usize| if i & bit == 0 { low[axis] } else { high[axis] };
        Vec3::new(pick(1, 0), pick(2, 1), pick(4, 2))
    });
    let none = [f64::INFINITY, f64::NEG_INFINITY];
    let [u, v] = corners.fold([none, none], |[u, v], p| {
        let (r, t) = (p.dot(&OBLIQUE.right), p.dot(&OBLIQUE.up));
        [[u[0].min(r), u[1].max(r)], [v[0].min(t), v[1].max(t)]]
    });
    let per_mm = (f64::from(size[0]) / (u[1] - u[0])).min(f64::from(size[1]) / (v[1] - v[0]));
    let from_mm = [
        0.5 * (u[0] + u[1] - f64::from(size[0]) / per_mm),
        0.5 * (v[0] + v[1] + f64::from(size[1]) / per_mm),
    ];
    Panel { view: OBLIQUE, corner, size, from_mm, per_mm }
}

impl Panel {
    /// Pixels of the drawing, four to one of the picture; far outside nothing need be exact.
    fn place(&self, p: &Vec3) -> (i32, i32) {
        let (u, v) = (p.dot(&self.view.right), p.dot(&self.view.up));
        let pixel = |mm: f64, corner: i32| {
            let offset = mm * self.per_mm * f64::from(SHARP);
            (f64::from(px(corner)) + offset.clamp(-1e5, 1e5)).round() as i32
        };
        (pixel(u - self.from_mm[0], self.corner[0]), pixel(self.from_mm[1] - v, self.corner[1]))
    }
}

fn draw_frame(area: &Area<'_>, panel: &Panel) -> Result<(), DrawingError> {
    let ([left, top], [wide, high]) = (panel.corner, panel.size);
    let title = Text::new(panel.view.title, (px(left), px(top - TITLE + 4)), ink(14));
    area.draw(&title).map_err(drawing_error)?;
    let Some([right_name, up_name]) = panel.view.names else { return draw_tripod(area, panel) };
    let size = (px(wide + BESIDE) as u32, px(high + UNDER) as u32);
    let part = area.clone().shrink((px(left - BESIDE), px(top)), size);
    let [u, v] = panel.from_mm;
    let (u_span, v_span) = (f64::from(wide) / panel.per_mm, f64::from(high) / panel.per_mm);
    let mut chart = ChartBuilder::on(&part)
        .x_label_area_size(px(UNDER))
        .y_label_area_size(px(BESIDE))
        .build_cartesian_2d(u..u + u_span, v - v_span..v)
        .map_err(drawing_error)?;
    chart
        .configure_mesh()
        .x_labels((wide / 60).clamp(2, 12) as usize)
        .y_labels((high / 36).clamp(2, 12) as usize)
        .x_desc(right_name)
        .y_desc(up_name)
        .light_line_style(WHITE)
        .axis_style(pen(FAINT, 1))
        .bold_line_style(pen(GRID, 1))
        .set_all_tick_mark_size(px(4))
        .x_label_formatter(&|x| tick(*x, u_span))
        .y_label_formatter(&|y| tick(*y, v_span))
        .label_style(ink(13))
        .draw()
        .map_err(drawing_error)
}

/// Where X, Y and Z point in the oblique view.
fn draw_tripod(area: &Area<'_>, panel: &Panel) -> Result<(), DrawingError> {
    let foot = (px(panel.corner[0] + 8), px(panel.corner[1] + panel.size[1] - 26));
    for (name, axis) in [("X", Vec3::x()), ("Y", Vec3::y()), ("Z", Vec3::z())] {
        let to = |length: f64| {
            let along = |direction: &Vec3| (length * f64::from(SHARP) * axis.dot(direction)) as i32;
            (foot.0 + along(&panel.view.right), foot.1 - along(&panel.view.up))
        };
        area.draw(&PathElement::new([foot, to(24.0)], pen(INK, 1))).map_err(drawing_error)?;
        let style = ink(11).pos(Pos::new(HPos::Center, VPos::Center));
        area.draw(&Text::new(name, to(33.0), style)).map_err(drawing_error)?;
    }
    Ok(())
}

/// The lines of one colour: as short as a path of SVG can be.
#[derive(Default)]
struct Line {
    path: String,
    end: Option<(i32, i32)>,
}

impl Line {
    fn add(&mut self, from: (i32, i32), to: (i32, i32)) {
        // Writing into a text cannot fail.
        let _ = match self.end == Some(from) {
            true => Ok(()),
            false => write!(self.path, "M{} {}", from.0, from.1),
        };
        let (dx, dy) = (to.0 - from.0, to.1 - from.1);
        let _ = write!(self.path, "l{dx}{}{dy}", if dy < 0 { "" } else { " " });
        self.end = Some(to);
    }
}

/// What has been painted, pixel by pixel: where a part is milled in a thousand passes, a line under
/// worse ones need not be in the file.
struct Ground {
    corner: (i32, i32),
    wide: usize,
    pixels: Vec<u8>,
}

impl Ground {
    fn under(panel: &Panel) -> Self {
        let [wide, high] = panel.size.map(|length| length.max(0) as usize + 1);
        let corner = (px(panel.corner[0]), px(panel.corner[1]));
        Self { corner, wide, pixels: vec![0; wide * high] }
    }

    /// Paints a line; `false` if nothing of it is seen.
    fn paint(&mut self, from: (i32, i32), to: (i32, i32), level: u8) -> bool {
        let steps = (to.0 - from.0).abs().max((to.1 - from.1).abs()) / SHARP as i32 + 1;
        let mut seen = false;
        for i in 0..=steps {
            let part = f64::from(i) / f64::from(steps);
            let between = |a: i32, b: i32| (f64::from(a) + part * f64::from(b - a)) as i32;
            let x = (between(from.0, to.0) - self.corner.0) / SHARP as i32;
            let y = (between(from.1, to.1) - self.corner.1) / SHARP as i32;
            // What is outside of the view is cut off.
            if x < 0 || y < 0 || x as usize >= self.wide {
                continue;
            }
            if let Some(pixel) = self.pixels.get_mut(y as usize * self.wide + x as usize)
                && *pixel < level
            {
                *pixel = level;
                seen = true;
            }
        }
        seen
    }
}

/// The path in one view: rapid below, then from good to bad, so that the worst is seen.
fn write_lines(
    out: &mut String,
    number: usize,
    panel: &Panel,
    points: &[PathPoint],
    colours: &Colours,
) {
    let mut rapid = Line::default();
    let mut levels: [Line; LEVELS] = Default::default();
    let mut ground = Ground::under(panel);
    let mut at: Option<((i32, i32), Vec3)> = None;
    for point in points.iter().filter(|p| p.tip_mm.iter().all(|v| v.is_finite())) {
        let to = panel.place(&point.tip_mm);
        let Some((from, tip)) = at else {
            at = Some((to, point.tip_mm));
            continue;
        };
        // Towards the eye a move is a dot; what is shorter than a pixel is not drawn at all.
        let dot = !point.rapid && (point.tip_mm - tip).norm() * panel.per_mm > 4.0;
        if from == to && !dot {
            continue;
        }
        let level = colours.level(point.off_mm);
        if point.rapid {
            rapid.add(from, to);
        } else if ground.paint(from, to, level as u8 + 1) {
            levels[level].add(from, to);
        }
        at = Some((to, point.tip_mm));
    }
    let ([left, top], [wide, high]) = (panel.corner.map(px), panel.size.map(px));
    let (dash, thin, thick) = (px(4), SHARP * 3 / 4, SHARP * 5 / 4);
    // Writing into a text cannot fail.
    let _ = write!(
        out,
        "<clipPath id=\"view{number}\"><rect x=\"{left}\" y=\"{top}\" width=\"{wide}\" \
         height=\"{high}\"/></clipPath><g clip-path=\"url(#view{number})\" fill=\"none\" \
         stroke-linecap=\"round\" stroke-linejoin=\"round\">\n\
         <path stroke=\"#8a939c\" stroke-width=\"{thin}\" stroke-dasharray=\"{dash}\" d=\"{}\"/>\n",
        rapid.path
    );
    for (i, line) in levels.iter().enumerate().filter(|(_, l)| !l.path.is_empty()) {
        let RGBColor(r, g, b) = level_colour(i);
        let _ = writeln!(
            out,
            "<path stroke=\"#{r:02x}{g:02x}{b:02x}\" stroke-width=\"{thick}\" d=\"{}\"/>",
            line.path
        );
    }
    out.push_str("</g>\n");
}

fn colour_bar(area: &Area<'_>, top: i32, colours: &Colours) -> Result<(), DrawingError> {
    let (left, wide, top) = (BESIDE, 32, top + 8);
    for level in 0..LEVELS {
        let x = left + wide * level as i32;
        let ends = [(px(x), px(top)), (px(x + wide), px(top + 12))];
        area.draw(&Rectangle::new(ends, level_colour(level).filled())).map_err(drawing_error)?;
    }
    let end = left + wide * LEVELS as i32;
    for i in 0..=4 {
        let span = colours.high - colours.low;
        let value = 1e3 * (colours.low + span * f64::from(i) / 4.0);
        let x = left + (end - left) * i / 4;
        let style = ink(13).pos(Pos::new(HPos::Center, VPos::Top));
        let text = Text::new(tick(value, 2e2 * span), (px(x), px(top + 16)), style);
        area.draw(&text).map_err(drawing_error)?;
    }
    let words = Text::new("µm, deviation of the tip with feed", (px(end + 14), px(top)), ink(14));
    area.draw(&words).map_err(drawing_error)?;
    let dash = end + 290;
    for x in (dash..dash + 36).step_by(8) {
        let ends = [(px(x), px(top + 7)), (px(x + 4), px(top + 7))];
        let grey = RGBColor(138, 147, 156);
        area.draw(&PathElement::new(ends, pen(grey, 1))).map_err(drawing_error)?;
    }
    area.draw(&Text::new("rapid", (px(dash + 44), px(top)), ink(14))).map_err(drawing_error)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn views_have_one_scale_and_fit() {
        for size in [[10.0, 10.0, 10.0], [900.0, 20.0, 1.0], [1.0, 2.0, 500.0], [0.0, 0.0, 0.0]] {
            let far = PathPoint { tip_mm: Vec3::from(size), off_mm: 0.0, rapid: false };
            let near = PathPoint { tip_mm: Vec3::zeros(), ..far };
            let (panels, height) = arrange(feed_box(&[near, far]));
            assert!(height < 800);
            for panel in panels.iter().filter(|p| p.view.names.is_some()) {
                assert_eq!(panel.per_mm, panels[0].per_mm);
                assert!(panel.corner[0] + panel.size[0] <= WIDTH && panel.corner[0] >= BESIDE);
                for p in [near, far] {
                    let (x, y) = panel.place(&p.tip_mm);
                    assert!(
                        (px(panel.corner[0])..px(panel.corner[0] + panel.size[0])).contains(&x)
                    );
                    assert!(
                        (px(panel.corner[1])..px(panel.corner[1] + panel.size[1])).contains(&y)
                    );
                }
            }
        }
    }
}
