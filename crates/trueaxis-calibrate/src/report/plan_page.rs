//! The page of a plan: bars of the uncertainty to expect, what stays hidden, the poses in three
//! views.

use super::plan::{figure, plan_text, shown_unit};
use crate::plan::PlanReport;
use crate::plan::{Expectation, Expected, tools};
use maud::{Markup, html};
use trueaxis_geometry::Vec3;
use trueaxis_motion::report::clock;
use trueaxis_report::page::{THREE, document};

/// Width of the longest bar and of a view, pixels.
const BAR_PX: f64 = 360.0;
const VIEW_PX: f64 = 240.0;
/// How long the tool axis is drawn, mm.
const STROKE_MM: f64 = 40.0;

/// The plan as one page that opens offline.
pub fn plan_html(report: &PlanReport<'_>) -> String {
    let campaign = &report.plan.campaign;
    let content = html! {
        h1 { (campaign.name) }
        p.soft { (campaign.machine.name()) " · " code { (campaign.machine.chain_text()) } }
        section {
            h2 { "Uncertainty to expect, U (k = 2)" }
            (bars(report))
            @if let Some(chosen) = &report.chosen {
                p { (chosen.poses) " of " (chosen.candidates) " poses, "
                    (clock(chosen.time_s)) }
            }
        }
        (hidden(&report.expectation))
        @for planned in &report.paths {
            section { h2 { "Path " (planned.path.name) } (views(&tools(campaign, &planned.path.stations))) }
        }
        section { h2 { "All figures" } pre { (plan_text(report)) } }
    };
    document(&campaign.name, &content)
}

fn hidden(expectation: &Expectation) -> Markup {
    html! {
        section {
            h2 { "What cannot be told" }
            @if expectation.unobservable.is_empty() {
                p { "Everything that is sought can be told." }
            }
            ul {
                @for hidden in &expectation.unobservable {
                    li {
                        (hidden.words)
                        br;
                        code { (hidden.combination) }
                        @if let Some(set_up) = &hidden.resolve_with {
                            br;
                            "Would tell: " (set_up)
                        }
                    }
                }
            }
        }
    }
}

/// One bar for each unknown; lengths and angles have scales of their own.
fn bars(report: &PlanReport<'_>) -> Markup {
    let expanded = |e: &Expected| {
        let (unit, scale) = shown_unit(report.design, e);
        (unit, e.u.map(|u| 2.0 * u * scale))
    };
    let unknowns = &report.expectation.unknowns;
    let greatest = |unit: &str| {
        let same = unknowns.iter().map(expanded).filter(|(u, _)| *u == unit);
        same.filter_map(|(_, v)| v).fold(0.0, f64::max)
    };
    html! {
        table {
            @for (unknown, (unit, value)) in unknowns.iter().map(|e| (e, expanded(e))) {
                tr {
                    td { (unknown.name) }
                    @match value {
                        Some(value) => {
                            td { (figure(value)) " " (unit) }
                            td { (bar(value / greatest(unit).max(1e-300))) }
                        }
                        None => { td { "hidden" } td {} }
                    }
                }
            }
        }
    }
}

fn bar(share: f64) -> Markup {
    let width = format!("{:.1}", BAR_PX * share);
    html! {
        svg width=(BAR_PX) height="12" role="img" {
            rect width=(width) height="12" fill="#0072b2" {}
        }
    }
}

/// The stations from above, from the front and from the right: the tool point, and the tool axis as
/// a stroke.
fn views(tools: &[(Vec3, Vec3)]) -> Markup {
    let points = || tools.iter().flat_map(|(p, u)| [*p, p + u * STROKE_MM]);
    let low = points().fold(Vec3::repeat(f64::INFINITY), |a, b| a.inf(&b));
    let high = points().fold(Vec3::repeat(f64::NEG_INFINITY), |a, b| a.sup(&b));
    let middle = (low + high) * 0.5;
    let scale = 0.9 * VIEW_PX / (high - low).max().max(1.0);
    let panels = [
        ("from above: X, Y", 0, 1),
        ("from the front: X, Z", 0, 2),
        ("from the right: Y, Z", 1, 2),
    ];
    let place = |p: &Vec3, right: usize, up: usize| {
        let of = |i: usize, sign: f64| 0.5 * VIEW_PX + sign * (p[i] - middle[i]) * scale;
        (format!("{:.1}", of(right, 1.0)), format!("{:.1}", of(up, -1.0)))
    };
    html! {
        p.soft { "Tool point and tool axis on the workpiece; the frame is "
            (figure(VIEW_PX / scale)) " mm wide." }
        div.grid style=(THREE) {
            @for (title, right, up) in panels {
                svg viewBox={ "0 0 " (VIEW_PX) " " (VIEW_PX + 20.0) } role="img" {
                    rect width=(VIEW_PX) height=(VIEW_PX) fill="none" stroke="#bbb" {}
                    @for (p, u) in tools {
                        @let (x1, y1) = place(p, right, up);
                        @let (x2, y2) = place(&(p + u * STROKE_MM), right, up);
                        line x1=(x1) y1=(y1) x2=(x2) y2=(y2) stroke="#0072b2" stroke-width="0.8" {}
                        circle cx=(x1) cy=(y1) r="1.8" fill="#d55e00" {}
                    }
                    text x="4" y=(VIEW_PX + 15.0) font-size="12" { (title) }
                }
            }
        }
    }
}
