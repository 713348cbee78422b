//! Bars and the map of correlations of an identification.

use super::identification::IdentificationReport;
use crate::identify::errors::Found;
use maud::html;
use std::fmt::Write as _;

/// A bar with its interval.
pub(super) struct Bar<'a> {
    pub name: &'a str,
    pub value: f64,
    /// Half the interval.
    pub half: f64,
    /// Next to it.
    pub text: String,
}

/// Bars below each other, on one scale, as SVG.
pub(super) fn bars(bars: &[Bar<'_>]) -> String {
    let (row, left, wide) = (20.0, 110.0, 460.0);
    let (mut low, mut high) = (0.0_f64, 0.0_f64);
    for Bar { value, half, .. } in bars {
        low = low.min(value - half);
        high = high.max(value + half);
    }
    let per = (wide - left - 90.0) / (high - low).max(1e-9);
    let x = |v: f64| left + (v - low) * per;
    let height = row * bars.len() as f64 + 8.0;
    let mut svg = format!("<svg viewBox=\"0 0 {wide} {height}\" role=\"img\">");
    for (i, Bar { name, value, half, text }) in bars.iter().enumerate() {
        let y = 4.0 + row * i as f64;
        let (from, to) = (x(value.min(0.0)), x(value.max(0.0)));
        let name = html! { (name) }.into_string();
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

/// The correlations of the errors as SVG.
pub(super) fn correlation_map(report: &IdentificationReport<'_>, seen: &[&Found]) -> String {
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
    svg + "</svg>"
}
