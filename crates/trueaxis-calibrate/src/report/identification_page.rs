//! An identification as one self-contained page: opens offline, no script, no file from elsewhere.

use super::identification::{
    IdentificationReport, MOST_TOLD, conventions_text, rms_words, shown, unit, value_words,
};
use super::identification_arrows::Arrow;
use crate::identify::errors::Found;
use maud::{Markup, PreEscaped, html};
use std::fmt::Write as _;
use trueaxis_geometry::Vec3;
use trueaxis_report::page::{THREE, document};

/// Most unknowns of the correlation map.
const MOST_MAPPED: usize = 60;

/// The report as the text of an HTML file.
pub fn identification_html(report: &IdentificationReport<'_>) -> String {
    let found = report.found;
    let class = if found.verdict.is_good() { "pass" } else { "fail" };
    let content = html! {
        h1 { (report.campaign.name) }
        p.soft { (report.campaign.machine.name()) " · "
            (report.records.readings.len()) " readings in " (found.places) " places"
            @if let Some(date) = &report.options.date { " · " (date) } }
        section class=(format!("verdict {class}")) { strong { (found.verdict.words()) } }
        (score_section(report))
        (arrow_section(report))
        (error_section(report))
        (unobservable_section(report))
        (correlation_section(report))
        (reading_section(report))
        p.soft { "made by trueaxis " (trueaxis_report::VERSION) }
    };
    document(&format!("Identified: {}", report.campaign.name), &content)
}

fn score_section(report: &IdentificationReport<'_>) -> Markup {
    let found = report.found;
    let axes = found.design.machine.axes();
    html! {
        section {
            h2 { "How well it explains the readings" }
            div.scroll { table {
                thead { tr { th { "residual, root mean square" } th { "" } th { "times the noise" } } }
                tbody { @for (words, rms) in report.scores() { tr {
                    td { (words) } td { (rms_words(&rms)) } td { (format!("{:.2}", rms.noise)) }
                } } }
            } }
            p.soft { "Held out: every place was predicted by a model that had not seen it"
                @if found.candidates > 0 { ", the choice of its terms included" } "." }
            p { "The residual that is held out follows "
                @for (i, f) in found.fields.iter().enumerate() {
                    @if i > 0 { ", " }
                    (f.axis.map_or("X Y Z".to_owned(), |a| axes[a].name.to_string()))
                    " by " (format!("{:.0} %", 100.0 * f.share.max(0.0)))
                } " of its squares." }
            @for remark in report.remarks() { p { (remark) "." } }
            @if let Some(check) = report.conventions { pre { (conventions_text(check)) } }
        }
    }
}

fn arrow_section(report: &IdentificationReport<'_>) -> Markup {
    let arrows = report.arrows();
    let longest =
        |of: fn(&Arrow) -> Vec3| arrows.iter().map(of).map(|v| v.norm()).fold(0.0, f64::max);
    let (before, after) = (longest(|a| a.before_mm), longest(|a| a.after_mm));
    if arrows.is_empty() || before <= 0.0 {
        return html! {};
    }
    let span = span(&arrows);
    let scale = |longest: f64| round_down(0.12 * span / longest.max(1e-9));
    let (large, small) = (scale(before), scale(after));
    let row = |of: fn(&Arrow) -> Vec3, by: f64| {
        [(0, 1, "X, mm", "Y, mm"), (0, 2, "X, mm", "Z, mm"), (1, 2, "Y, mm", "Z, mm")]
            .map(|view| picture(&arrows, of, by, view))
    };
    html! {
        section {
            h2 { "Residuals where the linear axes stand, in the frame of the machine" }
            p { "Without the errors sought, enlarged " (large) " times; the longest is "
                (format!("{:.2} µm", before * 1e3)) "." }
            div.grid style=(THREE) { @for p in row(|a| a.before_mm, large) { (PreEscaped(p)) } }
            p { "After identification, enlarged " (small) " times; the longest is "
                (format!("{:.2} µm", after * 1e3)) "." }
            div.grid style=(THREE) { @for p in row(|a| a.after_mm, small) { (PreEscaped(p)) } }
            p { "The same at the exaggeration of the first row." }
            div.grid style=(THREE) { @for p in row(|a| a.after_mm, large) { (PreEscaped(p)) } }
        }
    }
}

/// 1, 2 or 5 times a power of ten.
fn round_down(value: f64) -> f64 {
    let power = 10f64.powf(value.max(1e-12).log10().floor());
    [5.0, 2.0, 1.0].iter().map(|s| s * power).find(|v| *v <= value * 1.0001).unwrap_or(power)
}

fn span(arrows: &[Arrow]) -> f64 {
    let range = |i: usize| {
        let all = arrows.iter().map(|a| a.at_mm[i]);
        let (low, high) = all.fold((f64::MAX, f64::MIN), |(l, h), v| (l.min(v), h.max(v)));
        high - low
    };
    (0..3).map(range).fold(1.0, f64::max)
}

fn picture(
    arrows: &[Arrow],
    of: fn(&Arrow) -> Vec3,
    by: f64,
    (u, v, right, up): (usize, usize, &str, &str),
) -> String {
    let side = 330.0;
    let room = 54.0;
    let span = 1.35 * span(arrows);
    let middle = |i: usize| {
        let all = arrows.iter().map(|a| a.at_mm[i]);
        let (low, high) = all.fold((f64::MAX, f64::MIN), |(l, h), v| (l.min(v), h.max(v)));
        0.5 * (low + high)
    };
    let (u0, v0) = (middle(u), middle(v));
    let pixel = (side - room) / span;
    let x = |q: f64| room + 0.5 * (side - room) + (q - u0) * pixel;
    let y = |q: f64| 0.5 * (side - room) - (q - v0) * pixel;
    let mut svg = format!("<svg viewBox=\"0 0 {side} {side}\" role=\"img\">");
    let end = side - room;
    // Writing to a String cannot fail.
    let _ = write!(
        svg,
        "<rect x=\"{room}\" y=\"0\" width=\"{end}\" height=\"{end}\" fill=\"none\" stroke=\"#c8ced4\"/>\
         <text x=\"{:.0}\" y=\"{:.0}\" font-size=\"12\" text-anchor=\"middle\">{right}</text>\
         <text x=\"12\" y=\"{:.0}\" font-size=\"12\" text-anchor=\"middle\" \
         transform=\"rotate(-90 12 {:.0})\">{up}</text>",
        room + 0.5 * end,
        side - 8.0,
        0.5 * end,
        0.5 * end
    );
    for part in [-0.4, 0.0, 0.4] {
        let (a, b) = (u0 + part * span, v0 + part * span);
        let _ = write!(
            svg,
            "<text x=\"{:.1}\" y=\"{:.0}\" font-size=\"11\" text-anchor=\"middle\">{a:.0}</text>\
             <text x=\"{:.0}\" y=\"{:.1}\" font-size=\"11\" text-anchor=\"end\">{b:.0}</text>",
            x(a),
            end + 15.0,
            room - 4.0,
            y(b) + 4.0
        );
    }
    for arrow in arrows {
        let to = arrow.at_mm + of(arrow) * by;
        let _ = write!(
            svg,
            "<path d=\"M{:.1} {:.1}L{:.1} {:.1}\" stroke=\"#d55e00\" stroke-width=\"1.2\"/>\
             <circle cx=\"{:.1}\" cy=\"{:.1}\" r=\"1.6\" fill=\"#0072b2\"/>",
            x(arrow.at_mm[u]),
            y(arrow.at_mm[v]),
            x(to[u]),
            y(to[v]),
            x(arrow.at_mm[u]),
            y(arrow.at_mm[v])
        );
    }
    svg + "</svg>"
}

fn error_section(report: &IdentificationReport<'_>) -> Markup {
    let found = &report.found.found;
    let bars = |angle: bool| -> Vec<&Found> {
        let machine = found.iter().filter(|f| !f.is_setup && f.value.is_some());
        machine.filter(|f| f.is_angle == angle).collect()
    };
    html! {
        section {
            h2 { "The errors" }
            div.grid {
                @for angle in [false, true] { @if !bars(angle).is_empty() {
                    figure { figcaption { (if angle { "µrad" } else { "µm" })
                        ", bars with 95 % intervals" }
                        (PreEscaped(bar_picture(&bars(angle)))) }
                } }
            }
            div.scroll { table {
                thead { tr { th { "error" } th { "value ± standard uncertainty" } th { "z" } } }
                tbody { @for f in found { tr {
                    td { code { (f.name) } } td { (value_words(f)) }
                    td { @if let Some(z) = f.z() { (format!("{z:.1}")) } }
                } } }
            } }
            @if !report.found.left_out.is_empty() {
                p.soft { "Not supported by the readings: " (report.found.left_out.join(", ")) "." }
            }
        }
    }
}

fn bar_picture(found: &[&Found]) -> String {
    let (row, left, wide) = (20.0, 110.0, 460.0);
    let ends = |f: &Found| {
        let (value, u) = f.value.unwrap_or((0.0, 0.0));
        (shown(f, value), 1.96 * shown(f, u))
    };
    let (mut low, mut high) = (0.0_f64, 0.0_f64);
    for f in found {
        let (value, half) = ends(f);
        low = low.min(value - half);
        high = high.max(value + half);
    }
    let per = (wide - left - 90.0) / (high - low).max(1e-9);
    let x = |v: f64| left + (v - low) * per;
    let height = row * found.len() as f64 + 8.0;
    let mut svg = format!("<svg viewBox=\"0 0 {wide} {height}\" role=\"img\">");
    for (i, f) in found.iter().enumerate() {
        let (value, half) = ends(f);
        let y = 4.0 + row * i as f64;
        let (from, to) = (x(value.min(0.0)), x(value.max(0.0)));
        let name = html! { (f.name) }.into_string();
        let text = format!("{value:.2} {}", unit(f));
        // Writing to a String cannot fail.
        let _ = write!(
            svg,
            "<text x=\"4\" y=\"{:.1}\" font-size=\"12\">{name}</text>\
             <rect x=\"{from:.1}\" y=\"{:.1}\" width=\"{:.1}\" height=\"10\" fill=\"#56b4e9\"/>\
             <path d=\"M{:.1} {:.1}H{:.1}\" stroke=\"#1f2933\" stroke-width=\"1.6\"/>\
             <text x=\"{:.1}\" y=\"{:.1}\" font-size=\"11\">{text}</text>",
            y + 13.0,
            y + 4.0,
            to - from,
            x(value - half),
            y + 9.0,
            x(value + half),
            x((value + half).max(0.0)) + 6.0,
            y + 13.0
        );
    }
    let _ = write!(svg, "<path d=\"M{0:.1} 0V{height}\" stroke=\"#5b6773\"/></svg>", x(0.0));
    svg
}

fn unobservable_section(report: &IdentificationReport<'_>) -> Markup {
    let list = &report.found.unobservable;
    if list.is_empty() {
        return html! {};
    }
    html! {
        section {
            h2 { "What these readings cannot tell apart" }
            div.scroll { table.words {
                thead { tr { th { "combination" } th { "in words" } th { "resolved by" } } }
                tbody { @for u in list { tr {
                    td style="white-space:normal" { (u.combination) }
                    td { (u.words) } td { (u.resolve_with.as_deref().unwrap_or("")) }
                } } }
            } }
        }
    }
}

fn correlation_section(report: &IdentificationReport<'_>) -> Markup {
    let seen: Vec<&Found> =
        report.found.found.iter().filter(|f| f.value.is_some()).take(MOST_MAPPED).collect();
    if seen.len() < 2 {
        return html! {};
    }
    let (cell, room) = (18.0, 110.0);
    let side = room + cell * seen.len() as f64;
    let mut svg = format!("<svg viewBox=\"0 0 {side} {side}\" role=\"img\">");
    for (i, a) in seen.iter().enumerate() {
        let at = room + cell * i as f64;
        let name = html! { (a.name) }.into_string();
        let _ = write!(
            svg,
            "<text x=\"{:.1}\" y=\"{:.1}\" font-size=\"11\" text-anchor=\"end\">{name}</text>\
             <text font-size=\"11\" transform=\"translate({:.1} {:.1}) rotate(-90)\">{name}</text>",
            room - 4.0,
            at + 13.0,
            at + 13.0,
            room - 4.0
        );
        for (j, b) in seen.iter().enumerate() {
            let r = report.correlation(a.number, b.number);
            let shade = |end: f64| (247.0 + (end - 247.0) * r.abs().min(1.0)) as u8;
            let end = if r < 0.0 { [33.0, 102.0, 172.0] } else { [178.0, 24.0, 43.0] };
            let [red, green, blue] = end.map(shade);
            let _ = write!(
                svg,
                "<rect x=\"{:.1}\" y=\"{at:.1}\" width=\"{cell}\" height=\"{cell}\" \
                 fill=\"#{red:02x}{green:02x}{blue:02x}\"><title>{r:+.2}</title></rect>",
                room + cell * j as f64
            );
        }
    }
    svg += "</svg>";
    let wide = format!("max-width:{:.0}px;margin:0 auto", (1.2 * side).min(900.0));
    html! {
        section {
            h2 { "Correlation" }
            div style=(wide) { (PreEscaped(svg)) }
            p.soft { "Red +1, white 0, blue −1. Strongly correlated errors are known together better \
                      than each." }
        }
    }
}

fn reading_section(report: &IdentificationReport<'_>) -> Markup {
    let influences = &report.found.influences;
    html! {
        section {
            h2 { "Single readings" }
            @if influences.outliers.is_empty() {
                p { "No reading lies beyond the limit of studentised residuals, "
                    (format!("{:.2}", influences.limit)) " (5 % for all together, Bonferroni)." }
            } @else {
                p { (influences.outliers.len()) " numbers lie beyond the limit of studentised residuals, "
                    (format!("{:.2}", influences.limit)) "; they count all the same." }
                div.scroll { table {
                    thead { tr { th { "reading" } th { "channel" } th { "studentised" } } }
                    tbody { @for o in influences.outliers.iter().take(MOST_TOLD) { tr {
                        td { code { (report.place(o.row)) } } td { (o.channel + 1) }
                        td { (format!("{:+.1}", o.studentised)) }
                    } } }
                } }
            }
            p { "What moves the result most if it is left out:" }
            div.scroll { table {
                thead { tr { th { "reading" } th { "leverage" } th { "Cook's distance" } } }
                tbody { @for row in report.influential() { tr {
                    td { code { (report.place(row)) } }
                    td { (format!("{:.3}", influences.rows[row].leverage)) }
                    td { (format!("{:.4}", influences.rows[row].cook)) }
                } } }
            } }
        }
    }
}
