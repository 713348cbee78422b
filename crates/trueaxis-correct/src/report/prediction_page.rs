//! One self-contained page: opens offline, no script, no file from elsewhere.

use crate::predict::{DatumAxis, Decision, Prediction, SectionResult, Sensitivity, Study};
use crate::report::decisive;
use crate::report::feature;
use crate::report::ranked;
use crate::report::relief;
use maud::{Markup, PreEscaped, html};
use trueaxis_machine::describe::{command_words, shown, unit};
use trueaxis_part::Shape;
use trueaxis_part::tolerance::Outcome;
use trueaxis_report::page::document;
use trueaxis_report::plots::{
    Bar, COLOURS, ConeMap, Curve, DrawingError, FittedCircle, Labels, Profile, bars, cone_map,
    curves, polar,
};

/// Bars per index.
const BARS: usize = 10;

/// The report as the text of an HTML file.
///
/// # Errors
/// A picture that the drawing library refuses.
pub fn html(study: &Study, prediction: &Prediction) -> Result<String, DrawingError> {
    let content = html! {
        h1 { (study.name) }
        p.soft {
            (study.machine.name()) " · " code { (study.machine.chain_text()) } " · "
            (study.test_piece.name)
        }
        p.soft { "Numbers of the machine: " (study.machine.source()) }
        (verdict(prediction))
        (index_section(study, prediction))
        (section_pictures(prediction)?)
        (map_section(study, prediction)?)
        (motion_section(study, prediction)?)
        (blame_section(prediction)?)
        (correction_section(prediction))
        (sensitivity_section(prediction))
        (variant_section(prediction))
        (published_section(study, prediction))
        (input_section(study, prediction))
    };
    Ok(document(&study.name, &content))
}

fn um(mm: f64) -> String {
    format!("{:.2}", mm * 1e3)
}

fn class(outcome: Outcome) -> &'static str {
    match outcome {
        Outcome::Pass => "pass",
        Outcome::Fail => "fail",
        Outcome::Undecided => "undecided",
    }
}

fn verdict(prediction: &Prediction) -> Markup {
    let outcome = prediction.verdict.outcome;
    let words = match outcome {
        Outcome::Pass => "the part will be in tolerance",
        Outcome::Fail => "the part will be out of tolerance",
        Outcome::Undecided => "the tolerance lies within the uncertainty",
    };
    html! {
        section class={ "verdict " (class(outcome)) } {
            strong { (class(outcome).to_uppercase()) }
            span { (words) }
        }
        @for warning in &prediction.warnings { section { "Warning: " (warning) } }
    }
}

fn index_section(study: &Study, prediction: &Prediction) -> Markup {
    let judged = |key: &str| prediction.verdict.judgements.iter().find(|j| j.index.key == key);
    html! {
        section {
            h2 { "Indices" }
            p.soft { "All in µm; u is a standard uncertainty. The bold indices decide, after ISO; \
                      those of the paper are for comparison. Rule: " (rule(study)) "." }
            div.scroll { table {
                thead { tr {
                    th { "index" } th { "value" } th { "u, linear" } th { "u, Monte Carlo" }
                    th { "95 % interval" } th { "U" } th { "allowed" } th { "used" } th { "" }
                } }
                tbody { @for index in &prediction.indices {
                    tr.decisive[index.name.decisive] {
                        td { (index.name.title()) }
                        td { (um(index.value_mm)) }
                        td { (um(index.u_mm)) }
                        @if let Some(s) = index.spread {
                            td { (um(s.u_mm)) } td { (um(s.low_mm)) " … " (um(s.high_mm)) }
                        } @else { td {} td {} }
                        @if let Some(j) = judged(index.name.key) {
                            td { @if let Some(u) = j.expanded_mm { (um(u)) } }
                            td { (um(j.limit_mm)) }
                            td { (format!("{:.0} %", j.used_ratio * 100.0)) }
                            td class=(class(j.outcome)) { (class(j.outcome)) }
                        } @else { td {} td {} td {} td {} }
                    }
                } }
            } }
            h2 style="margin-top:1rem" { "At every position" }
            div.scroll { table.small {
                thead { tr {
                    th { "position" } th { "z, mm" }
                    @for index in &prediction.indices {
                        @if index.name.key.starts_with("roundness") || index.name.key.starts_with("coaxiality") {
                            th { (index.name.title()) }
                        }
                    }
                } }
                tbody { @for (i, result) in prediction.sections.iter().enumerate() { tr {
                    td { (i + 1) } td { (format!("{:.0}", result.section.z_mm)) }
                    @for (index, value) in prediction.indices.iter().zip(&result.section.indices_mm) {
                        @if index.name.key.starts_with("roundness") || index.name.key.starts_with("coaxiality") {
                            td { @if let Some(value) = value { (um(*value)) } }
                        }
                    }
                } } }
            } }
        }
    }
}

fn rule(study: &Study) -> String {
    match study.decision {
        Decision::Simple => "simple acceptance, value against limit".to_owned(),
        Decision::Guarded { coverage } => format!("ISO 14253-1 with U = {coverage} u"),
    }
}

fn section_pictures(prediction: &Prediction) -> Result<Markup, DrawingError> {
    let lines: Vec<Curve> = prediction
        .sections
        .iter()
        .enumerate()
        .map(|(i, result)| {
            let section = &result.section;
            let points = section.azimuth_rad.iter().zip(&section.deviation_mm);
            Curve {
                label: format!("position {}, z = {:.0} mm", i + 1, section.z_mm),
                points: points.map(|(a, e)| (a.to_degrees(), e * 1e3)).collect(),
            }
        })
        .collect();
    let labels = Labels { x: "azimuth, deg", y: "E, µm (positive: material left)" };
    let chart = curves((1000, 340), &labels, &lines)?;
    let pictures: Vec<String> =
        prediction.sections.iter().map(polar_picture).collect::<Result<_, _>>()?;
    Ok(html! {
        section {
            h2 { "Error along the azimuth" }
            (PreEscaped(chart))
        }
        section {
            h2 { "Sections, magnified" }
            p.soft { "Blue: the profile; black: the nominal circle; the fitted circles with the \
                      roundness about their centre. Only the deviations are magnified, so that a \
                      circle beside the centre does not look round." }
            div.grid {
                @for (i, picture) in pictures.iter().enumerate() {
                    figure {
                        (PreEscaped(picture))
                        figcaption {
                            "Position " (i + 1) ", z = "
                            (format!("{:.0}", prediction.sections[i].section.z_mm)) " mm; nominal radius "
                            (format!("{:.3}", prediction.sections[i].section.radius_mm)) " mm"
                        }
                    }
                }
            }
        }
    })
}

fn polar_picture(result: &SectionResult) -> Result<String, DrawingError> {
    let section = &result.section;
    let points: Vec<(f64, f64)> = section
        .azimuth_rad
        .iter()
        .zip(&section.profile_mm)
        .map(|(azimuth, p)| (*azimuth, p[0].hypot(p[1]) - section.radius_mm))
        .collect();
    let c = &section.circles;
    let zone =
        |label: &str, zone: &trueaxis_part::fit::circle::Zone, radius: f64, dashed| FittedCircle {
            label: label.to_owned(),
            centre_mm: zone.center_mm,
            excess_mm: radius - section.radius_mm,
            dashed,
            colour: if dashed { COLOURS[1] } else { COLOURS[2] },
        };
    let width = um(c.mzc.width_mm());
    let thin = |name: &str, zone: &trueaxis_part::fit::circle::Zone, radius, colour| FittedCircle {
        label: format!("{name}, {} µm", um(zone.width_mm())),
        centre_mm: zone.center_mm,
        excess_mm: radius - section.radius_mm,
        dashed: true,
        colour,
    };
    let circles = [
        thin("maximum inscribed", &c.mic, c.mic.inner_mm, COLOURS[3]),
        thin("minimum circumscribed", &c.mcc, c.mcc.outer_mm, COLOURS[5]),
        zone(&format!("least squares, {} µm", um(c.lsc.width_mm())), &c.lsc, c.lsc.radius_mm, true),
        zone("", &c.mzc, c.mzc.inner_mm, false),
        zone(&format!("minimum zone, {width} µm"), &c.mzc, c.mzc.outer_mm, false),
    ];
    polar(460, &Profile { points: &points, circles: &circles })
}

fn map_section(study: &Study, prediction: &Prediction) -> Result<Markup, DrawingError> {
    let Shape::Cone(cone) = &study.test_piece.shape;
    let Some(first) = prediction.sections.first() else { return Ok(html! {}) };
    let heights: Vec<f64> = prediction.sections.iter().map(|s| s.section.height_mm).collect();
    let errors: Vec<Vec<f64>> =
        prediction.sections.iter().map(|s| s.section.deviation_mm.clone()).collect();
    let picture = cone_map(
        (1000, 430),
        &ConeMap {
            half_angle_rad: cone.size().half_angle_rad,
            base_radius_mm: 0.5 * cone.size().base_diameter_mm,
            azimuths_rad: &first.section.azimuth_rad,
            heights_mm: &heights,
            error_mm: &errors,
        },
    )?;
    Ok(html! {
        section {
            h2 { "Error on the cone, unrolled" }
            (PreEscaped(picture))
        }
    })
}

fn motion_section(study: &Study, prediction: &Prediction) -> Result<Markup, DrawingError> {
    let axes = study.machine.axes();
    let mut pictures = Vec::new();
    for (i, axis) in axes.iter().enumerate() {
        let azimuths = prediction.sections.first().map_or(&[][..], |s| &s.section.azimuth_rad);
        let commands = azimuths.iter().zip(&prediction.commands);
        let points = commands.map(|(a, c)| (a.to_degrees(), shown(axis, c[i]))).collect();
        let y = format!("{}, {}", axis.name, unit(axis));
        let labels = Labels { x: "azimuth, deg", y: &y };
        let line = Curve { label: axis.name.to_string(), points };
        pictures.push(curves((480, 260), &labels, &[line])?);
    }
    Ok(html! {
        section {
            h2 { "Axis motions" }
            p.soft { "Zero set at " (command_words(axes, &prediction.setting_command)) "." }
            div.grid { @for picture in &pictures { (PreEscaped(picture)) } }
        }
    })
}

fn blame_section(prediction: &Prediction) -> Result<Markup, DrawingError> {
    if prediction.blame.errors.is_empty() {
        return Ok(html! {});
    }
    let mut pictures = Vec::new();
    for (i, index) in decisive(prediction) {
        let mut rows = Vec::new();
        for share in ranked(prediction, i, &prediction.blame.errors, BARS) {
            rows.push(Bar {
                label: share.of.to_string(),
                alone_mm: share.alone_mm[i],
                relief_mm: relief(prediction, i, share),
            });
        }
        pictures.push((index.name.title(), bars(500, &rows)?));
    }
    let groups = group_table(prediction);
    Ok(html! {
        section {
            h2 { "Error budget" }
            p.soft { "Alone: the index if there were only this error. Gain: what the index loses if \
                      the error is removed; a negative gain means that it compensates others." }
            div.grid { @for (name, picture) in &pictures {
                figure { figcaption { (name) } (PreEscaped(picture)) }
            } }
            (groups)
        }
    })
}

fn group_table(prediction: &Prediction) -> Markup {
    let kinds = prediction.blame.kinds.iter().map(|s| {
        let word = match s.of {
            trueaxis_machine::errors::ErrorKind::Location => "all location errors",
            trueaxis_machine::errors::ErrorKind::Motion => "all error motions",
        };
        (word.to_owned(), &s.alone_mm, &s.without_mm)
    });
    let bodies = prediction.blame.bodies.iter();
    let bodies = bodies.map(|s| (format!("all errors of {}", s.of), &s.alone_mm, &s.without_mm));
    let rows: Vec<_> = kinds.chain(bodies).collect();
    html! {
        div.scroll { table {
            thead { tr {
                th { "group, µm: alone / gain" }
                @for (_, index) in decisive(prediction) { th { (index.name.title()) } }
            } }
            tbody { @for (name, alone, without) in &rows { tr {
                td { (name) }
                @for (i, index) in decisive(prediction) {
                    td { (um(alone[i])) " / " (format!("{:+.2}", (index.value_mm - without[i]) * 1e3)) }
                }
            } } }
        } }
    }
}

fn correction_section(prediction: &Prediction) -> Markup {
    if prediction.corrections.is_empty() {
        return html! {};
    }
    html! {
        section {
            h2 { "One correction that would do" }
            p.soft { "The smallest first; a microradian counts as a micrometre." }
            div.scroll { table {
                thead { tr { th { "location error" } th { "change" }
                    @for (_, index) in decisive(prediction) { th { (index.name.title()) ", µm" } } } }
                tbody { @for correction in prediction.corrections.iter().take(8) { tr {
                    td { code { (correction.error) } }
                    td { @if correction.error.component.is_rotation() {
                        (format!("{:+.1} µrad", correction.change * 1e6))
                    } @else { (format!("{:+.1} µm", correction.change * 1e3)) } }
                    @for (i, _) in decisive(prediction) { td { (um(correction.indices_mm[i])) } }
                } } }
            } }
        }
    }
}

fn sensitivity_section(prediction: &Prediction) -> Markup {
    let scale = |s: &Sensitivity| if s.error.component.is_rotation() { 1e-3 } else { 1.0 };
    let most = |s: &Sensitivity| {
        let slopes = decisive(prediction).map(|(i, _)| s.slope[i].abs() * scale(s));
        slopes.fold(0.0_f64, f64::max)
    };
    let mut felt: Vec<&Sensitivity> =
        prediction.sensitivities.iter().filter(|s| most(s) > 5e-5).collect();
    felt.sort_by(|a, b| most(b).total_cmp(&most(a)));
    html! {
        section {
            h2 { "Sensitivity to location errors" }
            p.soft { "µm of the index per µm (shifts) or per µrad (rotations)." }
            div.scroll { table {
                thead { tr { th { "location error" }
                    @for (_, index) in decisive(prediction) { th { (index.name.title()) } } } }
                tbody { @for s in &felt { tr {
                    td { code { (s.error) } }
                    @for (i, _) in decisive(prediction) {
                        td { (slope_cell(s.slope[i] * scale(s))) }
                    }
                } } }
            } }
        }
    }
}

/// Four decimals; a plain 0 where they are all zero.
fn slope_cell(slope: f64) -> String {
    if slope.abs() < 5e-5 { "0".to_owned() } else { format!("{slope:+.4}") }
}

fn variant_section(prediction: &Prediction) -> Markup {
    if prediction.variants.is_empty() {
        return html! {};
    }
    html! {
        section {
            h2 { "Setting point and datum" }
            div.scroll { table {
                thead { tr { th { "the same part, µm" }
                    @for (_, index) in decisive(prediction) { th { (feature(&index.name)) } } } }
                tbody {
                    tr { td { "as studied" }
                        @for (_, index) in decisive(prediction) { td { (um(index.value_mm)) } } }
                    @for variant in &prediction.variants { tr {
                        td { (variant.name) }
                        @for (i, _) in decisive(prediction) { td { (um(variant.indices_mm[i])) } }
                    } }
                }
            } }
        }
    }
}

fn published_section(study: &Study, prediction: &Prediction) -> Markup {
    let Some(published) = &study.published else { return html! {} };
    let ours = |key: &str| prediction.indices.iter().find(|i| i.name.key == key);
    html! {
        section {
            h2 { "Beside published figures" }
            p.soft { (published.source) }
            div.scroll { table {
                thead { tr { th { "index, µm" } th { "here" } th { "published prediction" }
                    th { "measured" } th { "mean of the measured" } th { "" } } }
                tbody { @for row in &published.rows { tr {
                    td { (ours(&row.key).map_or(row.key.as_str(), |i| i.name.title())) }
                    td { @if let Some(index) = ours(&row.key) { (um(index.value_mm)) } }
                    td { @if let Some(value) = row.predicted_mm { (um(value)) } }
                    td { (row.measured_mm.iter().map(|m| um(*m)).collect::<Vec<_>>().join(", ")) }
                    td { @if !row.measured_mm.is_empty() {
                        (um(row.measured_mm.iter().sum::<f64>() / row.measured_mm.len() as f64))
                    } }
                    td { (row.note) }
                } } }
            } }
        }
    }
}

fn input_section(study: &Study, prediction: &Prediction) -> Markup {
    let stated = study.machine.stated_errors().len();
    let tip = study.machine.tip_mm();
    let datum = match study.reference.datum {
        DatumAxis::Ideal => "ideal axis through the set zero".to_owned(),
        DatumAxis::ReferenceHole { depth_mm } => format!("reference hole, {depth_mm} mm deep"),
    };
    html! {
        section {
            h2 { "Inputs" }
            div.scroll { table { tbody {
                tr { td { "study" } td { code { (study.path.display()) } } }
                tr { td { "machine" } td { code { (study.machine_path.display()) } } }
                tr { td { "source of the machine" } td { (study.machine.source()) } }
                tr { td { "stated errors" } td { (stated) } }
                @if !study.what_if.is_empty() {
                    tr { td { "replaced in this study" } td { (study.what_if.join(", ")) } }
                }
                tr { td { "tool tip in the holder, mm" }
                    td { (format!("{} {} {}", tip.x + 0.0, tip.y + 0.0, tip.z + 0.0)) } }
                tr { td { "zero set at" }
                    td { (command_words(study.machine.axes(), &prediction.setting_command)) } }
                tr { td { "datum" } td { (datum) } }
                tr { td { "rule" } td { (rule(study)) } }
                @for t in &study.tolerances.0 {
                    tr { td { (t.index.title()) } td { "at most " (um(t.limit_mm)) " µm; " (t.source) } }
                }
                tr { td { "test piece" } td { (study.test_piece.name) } }
                tr { td { "source of the test piece" } td { (study.test_piece.source) } }
                tr { td { "tool positions × heights" }
                    td { (prediction.commands.len()) " × " (prediction.sections.len()) } }
                @if let Some(s) = study.sampling {
                    tr { td { "Monte Carlo" } td { (s.samples) " samples, seed " (s.seed) } }
                }
                tr { td { "made by" } td { "trueaxis " (trueaxis_report::VERSION) } }
            } } }
        }
    }
}
