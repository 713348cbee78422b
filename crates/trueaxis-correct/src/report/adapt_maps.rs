//! Maps of a surface: a ring unrolled to angle and height, anything else as seen along its thinnest side.

use super::adapt::AdaptReport;
use crate::compensate::adapt::MapCell;
use plotters::prelude::*;
use std::f64::consts::{PI, TAU};
use std::fmt::Write;
use trueaxis_geometry::Vec3;
use trueaxis_report::DrawingError;
use trueaxis_report::plots::{Area, INK, draw, drawing_error, ink, pen, px};

/// A gap of the azimuths above which a part is no ring, rad.
const RING_GAP: f64 = PI / 4.0;
/// Fields of a picture.
const COLUMNS: usize = 120;
const ROWS: usize = 22;
/// Shades.
const SHADES: f64 = 32.0;

/// Where the places of a map lie in the plane.
pub(super) struct Layout {
    /// mm; of a ring the arc at its mean radius.
    flat: Vec<[f64; 2]>,
    low: [f64; 2],
    high: [f64; 2],
    /// The way round, mm.
    round_mm: Option<f64>,
    pub labels: [&'static str; 2],
    /// The distance of neighbours, mm.
    spacing: f64,
}

impl Layout {
    pub fn of(map: &[MapCell]) -> Self {
        let places: Vec<Vec3> = map.iter().map(|c| c.after.at_mm).collect();
        let ring = ring_radius(&places);
        let (flat, labels): (Vec<[f64; 2]>, _) = match ring {
            Some(radius) => {
                let place = |p: &Vec3| [p.y.atan2(p.x).rem_euclid(TAU) * radius, p.z];
                (places.iter().map(place).collect(), ["angle about z, deg", "z, mm"])
            }
            None => {
                let [a, b] = widest(&places);
                let names = ["x, mm", "y, mm", "z, mm"];
                (places.iter().map(|p| [p[a], p[b]]).collect(), [names[a], names[b]])
            }
        };
        let bound = |k: usize, pick: fn(f64, f64) -> f64, from: f64| {
            flat.iter().fold(from, |m, p| pick(m, p[k]))
        };
        let mut low = [0, 1].map(|k| bound(k, f64::min, f64::INFINITY));
        let mut high = [0, 1].map(|k| bound(k, f64::max, f64::NEG_INFINITY));
        if let Some(radius) = ring {
            (low[0], high[0]) = (0.0, TAU * radius);
        }
        for k in 0..2 {
            if !(low[k].is_finite() && high[k] - low[k] > 1e-9) {
                (low[k], high[k]) = (low[k].min(0.0), low[k].max(0.0) + 1.0);
            }
        }
        let area = (high[0] - low[0]) * (high[1] - low[1]);
        let spacing = (area / flat.len().max(1) as f64).sqrt();
        Self { flat, low, high, round_mm: ring.map(|r| TAU * r), labels, spacing }
    }

    /// The nearest place of the map to a field of a grid; `None` where there is none.
    fn nearest(&self, column: usize, row: usize, grid: [usize; 2]) -> Option<usize> {
        let at = |k: usize, i: usize| {
            self.low[k] + (i as f64 + 0.5) / grid[k] as f64 * (self.high[k] - self.low[k])
        };
        let (x, y) = (at(0, column), at(1, row));
        let distance = |p: &[f64; 2]| {
            let along = (p[0] - x).abs();
            let along = self.round_mm.map_or(along, |round| along.min(round - along));
            along.hypot(p[1] - y)
        };
        let near = self.flat.iter().enumerate().map(|(i, p)| (i, distance(p)));
        let best = near.min_by(|a, b| a.1.total_cmp(&b.1))?;
        (best.1 < 2.5 * self.spacing).then_some(best.0)
    }

    fn tick(&self, k: usize, share: f64) -> String {
        match (k, self.round_mm) {
            (0, Some(_)) => format!("{:.0}", 360.0 * share),
            _ => format!("{:.1}", self.low[k] + share * (self.high[k] - self.low[k])),
        }
    }

    /// A coarse map in characters: the wall before and after in µm.
    pub fn characters(&self, text: &mut String, report: &AdaptReport<'_>) {
        let grid = [12, 5];
        for after in [false, true] {
            let name = if after { "adapted" } else { "as programmed" };
            // Writing to a String cannot fail.
            let _ = writeln!(
                text,
                "\n  remaining wall {name}, µm; across: {}, up: {}; * cut through",
                self.labels[0], self.labels[1]
            );
            for row in (0..grid[1]).rev() {
                let _ = write!(text, "  {:>7} ", self.tick(1, (row as f64 + 0.5) / 5.0));
                for column in 0..grid[0] {
                    let cell = self.nearest(column, row, grid).map(|i| &report.adaptation.map[i]);
                    let wall = cell.map(|c| if after { c.after.wall_mm } else { c.before.wall_mm });
                    let _ = match wall {
                        Some(mm) => {
                            let mark = if mm <= 0.0 { "*" } else { " " };
                            write!(text, "{:>6.0}{mark}", mm * 1e3)
                        }
                        None => write!(text, "{:>7}", "."),
                    };
                }
                text.push('\n');
            }
            let ticks: String = (0..grid[0])
                .map(|c| format!("{:>6} ", self.tick(0, (c as f64 + 0.5) / 12.0)))
                .collect();
            let _ = writeln!(text, "          {ticks}");
        }
    }
}

/// The mean radius about z, if the places go all the way round.
fn ring_radius(places: &[Vec3]) -> Option<f64> {
    let mut azimuths: Vec<f64> = places.iter().map(|p| p.y.atan2(p.x)).collect();
    azimuths.sort_by(f64::total_cmp);
    let (first, last) = (azimuths.first()?, azimuths.last()?);
    let around = TAU - (last - first);
    let gap = azimuths.windows(2).fold(around, |m, w| m.max(w[1] - w[0]));
    let radius = places.iter().map(|p| p.x.hypot(p.y)).sum::<f64>() / places.len() as f64;
    (gap < RING_GAP && radius > 1e-6).then_some(radius)
}

/// The two coordinates that go farthest.
fn widest(places: &[Vec3]) -> [usize; 2] {
    let span = |k: usize| {
        let values = places.iter().map(|p| p[k]);
        let (low, high) =
            values.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| (a.min(v), b.max(v)));
        high - low
    };
    let mut order = [0, 1, 2];
    order.sort_by(|a, b| span(*b).total_cmp(&span(*a)));
    let mut two = [order[0], order[1]];
    two.sort_unstable();
    two
}

/// The colours of a map.
#[derive(Clone, Copy)]
pub(super) enum Scale {
    /// From dark (thin) to bright (thick), with what is cut through in vermilion; mm.
    Wall { most_mm: f64 },
    /// Blue below, white at zero, red above; µm.
    About { most_um: f64 },
    /// From white up; µm.
    Up { most_um: f64 },
}

impl Scale {
    fn ends(self) -> (f64, f64, &'static str) {
        match self {
            Self::Wall { most_mm } => (0.0, most_mm, "mm"),
            Self::About { most_um } => (-most_um, most_um, "µm"),
            Self::Up { most_um } => (0.0, most_um, "µm"),
        }
    }

    fn colour(self, value: f64) -> RGBColor {
        let (low, high, _) = self.ends();
        let share = ((value - low) / (high - low).max(1e-12)).clamp(0.0, 1.0);
        let share = (share * SHADES).round() / SHADES;
        match self {
            Self::Wall { .. } if value <= 0.0 => RGBColor(213, 94, 0),
            // After cividis (Nuñez, Anderton, Renslow 2018): even for eyes of every kind.
            Self::Wall { .. } => {
                mix(&[(0, 34, 77), (87, 93, 109), (165, 155, 115), (254, 232, 56)], share)
            }
            Self::About { .. } => mix(&[(33, 102, 172), (247, 247, 247), (178, 24, 43)], share),
            Self::Up { .. } => mix(&[(247, 247, 247), (204, 121, 167), (90, 20, 90)], share),
        }
    }
}

fn mix(stops: &[(u8, u8, u8)], share: f64) -> RGBColor {
    let at = share * (stops.len() - 1) as f64;
    let i = (at.floor() as usize).min(stops.len() - 2);
    let t = at - i as f64;
    let between = |a: u8, b: u8| (f64::from(a) + (f64::from(b) - f64::from(a)) * t).round() as u8;
    let (a, b) = (stops[i], stops[i + 1]);
    RGBColor(between(a.0, b.0), between(a.1, b.1), between(a.2, b.2))
}

/// A map with its scale.
///
/// # Errors
/// What the drawing library says.
pub(super) fn heat_map(
    layout: &Layout,
    scale: Scale,
    value: &dyn Fn(usize) -> f64,
) -> Result<String, DrawingError> {
    let (width, height) = (540, 250);
    let (left, right, top, bottom) = (px(52), px(width - 12), px(10), px(height - 86));
    draw((width as u32, height as u32), |area| {
        let x = |column: usize| left + (right - left) * column as i32 / COLUMNS as i32;
        let y = |row: usize| bottom - (bottom - top) * row as i32 / ROWS as i32;
        for row in 0..ROWS {
            let colours: Vec<Option<RGBColor>> = (0..COLUMNS)
                .map(|column| layout.nearest(column, row, [COLUMNS, ROWS]))
                .map(|found| found.map(|i| scale.colour(value(i))))
                .collect();
            let mut begin = 0;
            while begin < COLUMNS {
                let same = colours[begin..].iter().take_while(|c| **c == colours[begin]).count();
                if let Some(colour) = colours[begin] {
                    // A little over the next field, or seams shine through.
                    let corners = [
                        (x(begin), y(row + 1) - px(1) / 2),
                        ((x(begin + same) + px(1) / 2).min(right), y(row)),
                    ];
                    let field = Rectangle::new(corners, colour.filled());
                    area.draw(&field).map_err(drawing_error)?;
                }
                begin += same;
            }
        }
        let frame = Rectangle::new([(left, top), (right, bottom)], pen(INK, 1));
        area.draw(&frame).map_err(drawing_error)?;
        scales(area, layout, scale, [left, right, top, bottom])
    })
}

/// Ticks, names and the bar of colours.
fn scales(
    area: &Area<'_>,
    layout: &Layout,
    scale: Scale,
    [left, right, top, bottom]: [i32; 4],
) -> Result<(), DrawingError> {
    let write = |text: String, at: (i32, i32)| {
        area.draw(&Text::new(text, at, ink(12))).map_err(drawing_error)
    };
    for i in 0..=4 {
        let share = f64::from(i) / 4.0;
        let across = left + (right - left) * i / 4 - px(10);
        write(layout.tick(0, share), (across, bottom + px(5)))?;
    }
    for i in [0, 2, 4] {
        let up = bottom - (bottom - top) * i / 4 - px(6);
        write(layout.tick(1, f64::from(i) / 4.0), (px(18), up))?;
    }
    write(layout.labels[0].to_owned(), (left + px(180), bottom + px(20)))?;
    write(layout.labels[1].to_owned(), (px(2), bottom + px(5)))?;
    let (low, high, unit) = scale.ends();
    let bar = bottom + px(44);
    let steps = 96;
    for i in 0..steps {
        let at = |i: i32| left + (right - left) * i / steps;
        let share = (f64::from(i) + 0.5) / f64::from(steps);
        let colour = scale.colour(low + share * (high - low) + 1e-12);
        let strip = Rectangle::new([(at(i), bar), (at(i + 1) + 2, bar + px(12))], colour.filled());
        area.draw(&strip).map_err(drawing_error)?;
    }
    for i in 0..=4 {
        let v = low + f64::from(i) / 4.0 * (high - low);
        let text = match scale {
            Scale::Wall { .. } => format!("{v:.3} {unit}"),
            _ => format!("{v:.1} {unit}"),
        };
        let at = left + (right - left - px(52)) * i / 4;
        write(text, (at, bar + px(16)))?;
    }
    Ok(())
}
