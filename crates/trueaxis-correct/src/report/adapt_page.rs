//! A path moved onto a probed blank as one self-contained page.

use super::adapt::{AdaptReport, centre};
use super::adapt_maps::{Layout, Scale, heat_map};
use maud::{Markup, PreEscaped, html};
use trueaxis_report::DrawingError;
use trueaxis_report::page::document;
use trueaxis_report::plots::round_step;

/// The report as the text of an HTML file.
///
/// # Errors
/// What the drawing library says.
pub fn adapt_html(report: &AdaptReport<'_>) -> Result<String, DrawingError> {
    let maps = maps(report)?;
    let sound = report.is_sound();
    let kind = if sound { "verdict pass" } else { "verdict fail" };
    let content = html! {
        h1 { (report.study.name) }
        p.soft {
            (report.study.path.name()) " on " (report.study.machine.name()) ", moved onto the blank of "
            (report.study.table)
        }
        section class=(kind) {
            strong { (if sound { "GOOD" } else { "NOT TO BE CUT" }) }
            span { (report.verdict()) }
        }
        (findings(report))
        section {
            h2 { "Remaining wall" }
            div.grid style="grid-template-columns:repeat(auto-fit,minmax(440px,1fr))" {
                @for (title, svg) in &maps[..2] { (figure(title, svg)) }
            }
            p.soft {
                (report.map_source()) ". Vermilion: cut through. Least wall allowed "
                (report.study.wall.least_mm) " mm."
            }
            (walls(report))
        }
        section.long {
            h2 { "Registration, form and remaining wall" }
            div.grid style="grid-template-columns:repeat(auto-fit,minmax(440px,1fr))" {
                @for (title, svg) in &maps[2..] { (figure(title, svg)) }
            }
        }
        (registration(report))
        (field(report))
        p.soft { "made by trueaxis " (trueaxis_report::VERSION) }
    };
    Ok(document(&report.study.name, &content))
}

fn figure(title: &str, svg: &str) -> Markup {
    html! { figure { (PreEscaped(svg)) figcaption { (title) } } }
}

fn maps(report: &AdaptReport<'_>) -> Result<Vec<(&'static str, String)>, DrawingError> {
    let map = &report.adaptation.map;
    let layout = Layout::of(map);
    let most_mm = report.walls(false).max.max(report.walls(true).max).max(1e-3);
    let wall = Scale::Wall { most_mm: round_step(most_mm) };
    let largest = |value: &dyn Fn(usize) -> f64| {
        round_step((0..map.len()).fold(0.1_f64, |m, i| m.max(value(i).abs())))
    };
    let field = |i: usize| map[i].field.deviation_mm * 1e3;
    let u = |i: usize| 2e3 * map[i].field.u_mm;
    let off = |i: usize| report.off_mm(&map[i]) * 1e3;
    let missed = |i: usize| (map[i].field.deviation_mm - map[i].after.blank_mm) * 1e3;
    let mut maps = vec![
        ("as programmed: wall, mm", heat_map(&layout, wall, &|i| map[i].before.wall_mm)?),
        ("adapted: wall, mm", heat_map(&layout, wall, &|i| map[i].after.wall_mm)?),
        (
            "the field: how far the blank is off along the normals, µm",
            heat_map(&layout, Scale::About { most_um: largest(&field) }, &field)?,
        ),
        ("its U (k = 2), µm", heat_map(&layout, Scale::Up { most_um: largest(&u) }, &u)?),
        (
            "adapted: wall less the wanted wall, µm (ridges between the turns and chords included)",
            heat_map(&layout, Scale::About { most_um: largest(&off) }, &off)?,
        ),
    ];
    if report.study.blank.is_some() {
        let scale = Scale::About { most_um: largest(&missed) };
        maps.push(("the field less the true blank, µm", heat_map(&layout, scale, &missed)?));
    }
    Ok(maps)
}

fn findings(report: &AdaptReport<'_>) -> Markup {
    html! {
        @if !report.adaptation.findings.is_empty() {
            section {
                h2 { "Why it must not be cut" }
                table.words {
                    thead { tr { th { "what" } th { "places" } th { "line of the path" } th { "" } } }
                    tbody { @for f in &report.adaptation.findings {
                        tr { td { (f.code) } td { (f.places) } td { (f.line) } td { (f.message) } }
                    } }
                }
            }
        }
        @if let Some(program) = report.program {
            section {
                h2 { "Program" }
                p {
                    (program.file) ", " (program.blocks) " blocks, "
                    (if program.written { "written" } else { "not written" })
                    ": read back and simulated it is within "
                    (format!("{:.3} µm and {:.5} deg", program.tip_mm * 1e3, program.axis_rad.to_degrees()))
                    " of the adapted path."
                }
            }
        }
    }
}

fn walls(report: &AdaptReport<'_>) -> Markup {
    html! {
        table.small {
            thead { tr {
                th { "wall, mm" } th { "least" } th { "mean" } th { "most" } th { "cut through" }
            } }
            tbody { @for (after, name) in [(false, "as programmed"), (true, "adapted")] {
                @let s = report.walls(after);
                tr {
                    td { (name) }
                    td { (format!("{:.4}", s.min)) }
                    td { (format!("{:.4}", s.mean)) }
                    td { (format!("{:.4}", s.max)) }
                    td { (report.through(after)) " of " (report.adaptation.map.len()) }
                }
            } }
        }
    }
}

fn registration(report: &AdaptReport<'_>) -> Markup {
    let r = &report.adaptation.field.registration;
    let rows = [
        ("shift, µm", r.shift_mm() * 1e3, r.u_shift_mm() * 1e3),
        ("turn, µrad", r.turn_rad() * 1e6, r.u_turn_rad() * 1e6),
    ];
    let c = centre(&r.freedoms.center_mm);
    html! {
        section {
            h2 { "How the blank lies" }
            table.small {
                thead { tr { th { "± standard uncertainty" } th { "x" } th { "y" } th { "z" } } }
                tbody { @for (name, v, u) in &rows {
                    tr {
                        td { (name) }
                        @for i in 0..3 { td { (format!("{:.2} ± {:.2}", v[i], u[i])) } }
                    }
                } }
            }
            p.soft { "about (" (c) ") mm" }
            @for held in r.held_words() {
                p { "Held at zero, since no reading tells: " (held) }
            }
        }
    }
}

fn field(report: &AdaptReport<'_>) -> Markup {
    let (study, field) = (report.study, &report.adaptation.field);
    let moved = report.moved();
    html! {
        section {
            h2 { "The form of the blank" }
            p {
                (format!(
                    "{} points; the form has a standard deviation of {:.1} µm and stays alike over {:.1} mm. \
                     Each point foretold by all others: {:.2} µm rms, {:.1} % within U (k = 2). The path has {} \
                     places, {} of them cut, moved by {:+.1} to {:+.1} µm.",
                    study.points.len(),
                    field.covariance.form_mm * 1e3,
                    field.covariance.length_mm,
                    field.left_out_rms_mm * 1e3,
                    field.share_within(2.0) * 100.0,
                    report.adaptation.places.len(),
                    report.cut_places(),
                    moved.min * 1e3,
                    moved.max * 1e3
                ))
            }
            @if !field.outliers.is_empty() {
                table.small {
                    thead { tr { th { "outlier: point" } th { "line" } th { "off the others, µm" } } }
                    tbody { @for o in &field.outliers {
                        tr {
                            td { (study.points[o.index].number) }
                            td { (study.points[o.index].line) }
                            td { (format!("{:+.1}", o.residual_mm * 1e3)) }
                        }
                    } }
                }
            }
        }
    }
}
