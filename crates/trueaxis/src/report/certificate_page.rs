//! A certificate as one self-contained page.

use super::certificate::word;
use super::certificate_blocks::{Chapter, chapters};
use crate::verify::certificate::{Certificate, Study};
use maud::{Markup, PreEscaped, html};
use plotters::prelude::*;
use trueaxis_report::Block;
use trueaxis_report::page::document;
use trueaxis_report::plots::{
    COLOURS, DrawingError, INK, Labels, axes, draw, drawing_error, legend, pen, px,
};

/// The page.
///
/// # Errors
/// What the drawing library says.
pub fn certificate_html(study: &Study, certificate: &Certificate) -> Result<String, DrawingError> {
    let pictures = html! {
        div {
            figure { (PreEscaped(picture(study, certificate, true)?))
                figcaption { "Measured tip deviation at the poses of the validation: before and after" } }
            figure { (PreEscaped(picture(study, certificate, false)?))
                figcaption { "After, with U of the reading, the predicted 95 % bound and the limit" } }
        }
    };
    let class = word(certificate.outcome);
    let content = html! {
        h1 { (study.name) }
        p.soft { "Certificate of a volumetric compensation, in the order of the topics of ISO/TR 16907" }
        section class=(format!("verdict {class}")) {
            strong { (class.to_uppercase()) }
            span { (certificate.reason) }
        }
        @for chapter in chapters(study, certificate) {
            (section(&chapter, (chapter.title == "Validation").then_some(&pictures)))
        }
    };
    Ok(document(&study.name, &content))
}

fn section(chapter: &Chapter, pictures: Option<&Markup>) -> Markup {
    html! {
        section.long {
            h2 { (chapter.number) ". " (chapter.title) }
            @for line in &chapter.lines { p { (line) } }
            @if let Some(pictures) = pictures { (pictures) }
            @for block in &chapter.blocks { (table(block)) }
        }
    }
}

fn table(block: &Block) -> Markup {
    let side = |i: usize| if block.has_words(i) { "text-align:left" } else { "" };
    let class = |cell: &str| match cell {
        "pass" | "fail" | "undecided" => Some(cell.to_owned()),
        _ => None,
    };
    html! {
        h3 { (block.title) }
        div.scroll { table.small {
            thead { tr { @for (i, h) in block.headings.iter().enumerate() { th style=(side(i)) { (h) } } } }
            tbody { @for row in &block.rows { tr {
                @for (i, cell) in row.iter().enumerate() {
                    td class=[class(cell)] style=(side(i)) {
                        @if cell.len() == 64 { code { (cell) } } @else { (cell) }
                    }
                }
            } } }
        } }
        @if !block.note.is_empty() { p.soft { (block.note) } }
    }
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
