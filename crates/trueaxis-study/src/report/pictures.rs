//! Pictures of a study: how an output is distributed, and what makes its variance.

use crate::Output;
use crate::findings::Spread;
use crate::sensitivity::GroupShares;
use plotters::prelude::*;
use trueaxis_report::Figure;
use trueaxis_report::plots::{COLOURS, INK, Labels, axes, draw, drawing_error, ink, pen, px};

const WIDTH: u32 = 500;
const HEIGHT: u32 = 300;
/// Groups beyond these are too small to see.
const MOST_BARS: usize = 14;

/// How many parts have which value, with the limits.
pub(super) fn histogram<'a>(name: String, output: &'a Output, spread: &'a Spread) -> Figure<'a> {
    Figure::new(name, move || {
        let cells = &spread.histogram;
        let limits: Vec<f64> =
            [output.low_mm, output.high_mm].into_iter().flatten().map(|mm| mm * 1e3).collect();
        let width = (cells.width_mm * 1e3).max(1e-6);
        let from = cells.from_mm * 1e3;
        let to = from + width * cells.counts.len() as f64;
        let ends = limits.iter().fold((from, to), |(a, b), l| (a.min(*l), b.max(*l)));
        let gap = 0.04 * (ends.1 - ends.0);
        let most = cells.counts.iter().copied().max().unwrap_or(1) as f64;
        draw((WIDTH, HEIGHT), |area| {
            let labels = Labels { x: "µm", y: "parts" };
            let mut chart = axes(area, &labels, (ends.0 - gap..ends.1 + gap, 0.0..1.08 * most))?;
            let bars = cells.counts.iter().enumerate().map(|(i, count)| {
                let left = from + i as f64 * width;
                Rectangle::new([(left, 0.0), (left + width, *count as f64)], COLOURS[0].filled())
            });
            chart.draw_series(bars).map_err(drawing_error)?;
            for limit in limits {
                let line = PathElement::new([(limit, 0.0), (limit, 1.08 * most)], pen(RED, 2));
                chart.draw_series([line]).map_err(drawing_error)?;
            }
            Ok(())
        })
    })
}

/// First and total indices of the groups, the largest first, with twice their standard uncertainty.
pub(super) fn shares<'a>(bars: Vec<(&'a str, GroupShares)>) -> Figure<'a> {
    let caption = "Blue: first index; orange: total index; lines: ± 2 u.";
    Figure::new(caption, move || {
        let bars = &bars[..bars.len().min(MOST_BARS)];
        let row = 30;
        let height = bars.len() as i32 * row + 24;
        let wide = WIDTH as i32 * 2;
        draw((wide as u32, height as u32), |area| {
            let (left, right) = (f64::from(px(300)), f64::from(px(wide - 30)));
            let x = |ratio: f64| (left + ratio.clamp(-0.1, 1.1) * (right - left)).round() as i32;
            for (i, (name, shares)) in bars.iter().enumerate() {
                let y = px(8 + row * i as i32);
                area.draw(&Text::new((*name).to_owned(), (px(8), y + px(4)), ink(13)))
                    .map_err(drawing_error)?;
                for (share, colour, drop) in
                    [(shares.first, COLOURS[0], 0), (shares.total, COLOURS[4], 12)]
                {
                    let ends =
                        [(x(0.0), y + px(drop)), (x(share.ratio.max(0.0)), y + px(drop + 10))];
                    area.draw(&Rectangle::new(ends, colour.filled())).map_err(drawing_error)?;
                    let middle = y + px(drop + 5);
                    let spread = [
                        (x(share.ratio - 2.0 * share.u_ratio), middle),
                        (x(share.ratio + 2.0 * share.u_ratio), middle),
                    ];
                    area.draw(&PathElement::new(spread, pen(INK, 1))).map_err(drawing_error)?;
                }
            }
            let zero = [(x(0.0), px(4)), (x(0.0), px(height - 20))];
            area.draw(&PathElement::new(zero, pen(INK, 1))).map_err(drawing_error)?;
            for tick in [0.0, 0.25, 0.5, 0.75, 1.0] {
                let at = (x(tick) - px(10), px(height - 16));
                area.draw(&Text::new(format!("{tick}"), at, ink(12))).map_err(drawing_error)?;
            }
            Ok(())
        })
    })
}
