//! The pictures of a certificate.

use crate::verify::certificate::{Certificate, Study};
use plotters::prelude::*;
use trueaxis_report::Figure;
use trueaxis_report::plots::{
    COLOURS, DrawingError, INK, Labels, axes, draw, drawing_error, legend, pen, px,
};

/// Measured tip deviations without and with the compensation.
pub(super) fn before_and_after_figure<'a>(
    study: &'a Study,
    certificate: &'a Certificate,
) -> Figure<'a> {
    let caption = "Measured tip deviation at the poses of the validation: before and after";
    Figure::new(caption, move || picture(study, certificate, true))
}

/// Those with the compensation against their prediction.
pub(super) fn after_figure<'a>(study: &'a Study, certificate: &'a Certificate) -> Figure<'a> {
    let caption = "After, with U of the reading, the predicted 95 % bound and the limit";
    Figure::new(caption, move || picture(study, certificate, false))
}

type Points = Vec<(f64, f64)>;

/// Lengths over the number of the pose.
fn picture(
    study: &Study,
    certificate: &Certificate,
    with_before: bool,
) -> Result<String, DrawingError> {
    let numbered = || certificate.poses.iter().enumerate().map(|(i, p)| ((i + 1) as f64, p));
    let [before, after] = [0, 1].map(|state| -> Points {
        numbered().map(|(x, p)| (x, p.lengths_mm()[state] * 1e3)).collect()
    });
    let bound: Points = numbered().map(|(x, p)| (x, p.within_mm * 1e3)).collect();
    let limit = study.decision.limit_mm * 1e3;
    let expanded = certificate.expanded_mm * 1e3;
    let shown = if with_before { &before } else { &bound };
    let highest = shown.iter().chain(&after).map(|p| p.1 + expanded).fold(limit, f64::max);
    let last = certificate.poses.len() as f64 + 0.5;
    draw((1000, 320), |area| {
        let labels = Labels { x: "pose", y: "tip, µm" };
        let mut chart = axes(area, &labels, (0.5..last, 0.0..highest * 1.08))?;
        let line = LineSeries::new([(0.5, limit), (last, limit)], pen(INK, 2));
        chart
            .draw_series(line)
            .map_err(drawing_error)?
            .label("limit")
            .legend(|(x, y)| PathElement::new([(x, y), (x + px(16), y)], pen(INK, 2)));
        let colours = [COLOURS[1], COLOURS[0], COLOURS[2]];
        let bars = after.iter().map(|(x, y)| {
            let ends = [(*x, (y - expanded).max(0.0)), (*x, y + expanded)];
            PathElement::new(ends, pen(colours[1], 1))
        });
        if with_before {
            dots(&mut chart, &before, "before", colours[0])?;
        } else {
            chart.draw_series(bars).map_err(drawing_error)?;
            let steps = bound
                .iter()
                .map(|(x, y)| PathElement::new([(x - 0.4, *y), (x + 0.4, *y)], pen(colours[2], 2)));
            chart.draw_series(steps).map_err(drawing_error)?.label("predicted, 95 %").legend(
                move |(x, y)| PathElement::new([(x, y), (x + px(16), y)], pen(colours[2], 2)),
            );
        }
        dots(&mut chart, &after, "after", colours[1])?;
        legend(&mut chart, SeriesLabelPosition::UpperRight)
    })
}

fn dots<'a, 'b: 'a>(
    chart: &mut trueaxis_report::plots::Chart<'a, 'b>,
    points: &Points,
    label: &str,
    colour: RGBColor,
) -> Result<(), DrawingError> {
    let series = points.iter().map(|p| Circle::new(*p, px(3), colour.filled()));
    chart
        .draw_series(series)
        .map_err(drawing_error)?
        .label(label)
        .legend(move |(x, y)| Circle::new((x + px(8), y), px(3), colour.filled()));
    Ok(())
}
