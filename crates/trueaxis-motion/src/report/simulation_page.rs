//! The page of a simulation: opens offline, no script, no file from elsewhere.

use super::simulation::{Simulation, blocks, clock, control_name, trouble_text};
use super::simulation_plots::{Mark, Strip, strips};
use super::simulation_views::tool_path;
use crate::{AxisUse, Quantity, Series, Trouble, Worst, shown, unit};
use maud::{Markup, PreEscaped, html};
use std::path::Path;
use trueaxis_input::Severity;
use trueaxis_machine::axis::{AxisKind, Travel};
use trueaxis_report::page::document;
use trueaxis_report::plots::DrawingError;

/// Rows of the table of troubles, and of other lists that a program can make long.
const MOST_ROWS: usize = 1000;

/// The report of a simulation as the text of an HTML file.
///
/// # Errors
/// A picture that the drawing library refuses.
pub fn simulation_html(s: &Simulation<'_>, series: &Series) -> Result<String, DrawingError> {
    let name = Path::new(s.program).file_name().map_or(s.program.into(), |n| n.to_string_lossy());
    let title = format!("{name} on {}", s.machine.name());
    let content = html! {
        h1 { (title) }
        p.soft {
            (control_name(s.control)) " · " code { (s.machine.chain_text()) } " · "
            (clock(s.summary.time_s))
        }
        (verdict(s))
        (summary_section(s))
        (path_section(s, series)?)
        (deviation_section(s, series)?)
        (axis_section(s, series)?)
        (trouble_section(s))
        (tool_section(s))
        (message_section(s))
        (input_section(s))
    };
    Ok(document(&title, &content))
}

fn verdict(s: &Simulation<'_>) -> Markup {
    let list = &s.troubles.list;
    let grave = list.iter().filter(|t| t.grave).count();
    let all = list.len() as u64 + s.troubles.left_out;
    let plural = |n: u64| if n == 1 { "" } else { "s" };
    let errors = s.run.problems.iter().filter(|d| d.severity == Severity::Error).count();
    let slow = all - grave as u64;
    let (class, word, words) = match (grave, all) {
        _ if errors > 0 => {
            let words = format!("{errors} error{} in the program", plural(errors as u64));
            ("fail", "NOT COMPLETE", words)
        }
        (0, 0) => ("pass", "NO TROUBLE", "nothing was found that endangers part or machine".into()),
        (0, _) => {
            ("undecided", "SLOWER", format!("{all} trouble{} that cost time only", plural(all)))
        }
        (grave, _) => {
            let also = match slow {
                0 => String::new(),
                n => format!(", and {n} more"),
            };
            let words = format!("{grave} grave trouble{}{also}", plural(grave as u64));
            ("fail", "TROUBLE", words)
        }
    };
    let first = list.iter().filter(|t| t.grave).chain(list.iter().filter(|t| !t.grave));
    html! {
        section class={ "verdict " (class) } {
            strong { (word) }
            span {
                (words)
                @for trouble in first.take(3) {
                    br;
                    span.soft {
                        (blocks(s, trouble)) ", " (clock(trouble.from_s)) ": "
                        (trouble_text(s.machine, trouble))
                    }
                }
            }
        }
    }
}

fn um(mm: f64) -> String {
    format!("{:.2}", mm * 1e3 + 0.0)
}

fn summary_section(s: &Simulation<'_>) -> Markup {
    let summary = s.summary;
    let feed_s = summary.time_s - summary.rapid_s - summary.dwell_s;
    let worst = |name: &str, text: String, w: &Worst| {
        html! { tr { td { (name) } td { (text) } td { (s.block(w.origin)) } td { (clock(w.time_s)) } } }
    };
    html! {
        section {
            h2 { "Summary" }
            div.scroll { table {
                thead { tr { th {} th { "with feed" } th { "rapid" } th { "waiting" } th { "whole" } } }
                tbody {
                    tr { td { "time" } td { (clock(feed_s)) } td { (clock(summary.rapid_s)) }
                        td { (clock(summary.dwell_s)) } td { (clock(summary.time_s)) } }
                    tr { td { "way of the tip, mm" } td { (format!("{:.1}", summary.feed_mm)) }
                        td { (format!("{:.1}", summary.rapid_mm)) } td {}
                        td { (format!("{:.1}", summary.feed_mm + summary.rapid_mm)) } }
                }
            } }
            p.soft {
                (summary.moves) " moves, " (summary.nodes) " places"
                @if let Some([low, high]) = summary.cut_box_mm {
                    "; with feed the tip reaches "
                    @for (i, axis) in ["X", "Y", "Z"].into_iter().enumerate() {
                        (axis) " " (format!("{:.3} … {:.3}", low[i] + 0.0, high[i] + 0.0))
                        @if i < 2 { ", " }
                    }
                    " mm"
                }
                @if summary.stops > 0 { "; " (summary.stops) " stops" }
                "."
            }
            h2 { "Worst deviation of the actual tool from the nominal one, with feed" }
            div.scroll { table {
                thead { tr { th { "in the workpiece" } th { "value" } th { "at" } th { "when" } } }
                tbody {
                    (worst("tip, µm", um(summary.feed_tip.value), &summary.feed_tip))
                    tr { td { "tip, root mean square, µm" } td { (um(summary.feed_tip_rms_mm)) }
                        td {} td {} }
                    (worst("along the feed, µm", um(summary.along_path[0].value),
                        &summary.along_path[0]))
                    (worst("along the normal, µm", um(summary.along_path[1].value),
                        &summary.along_path[1]))
                    (worst("along the binormal, µm", um(summary.along_path[2].value),
                        &summary.along_path[2]))
                    (worst("tool axis, µrad", format!("{:.2}", summary.feed_axis.value * 1e6),
                        &summary.feed_axis))
                }
            } }
            p.soft { "The normal lies across the feed on the side of the tool axis, the binormal across \
                both: for an upright tool they are the height and the side of the cut." }
        }
    }
}

fn path_section(s: &Simulation<'_>, series: &Series) -> Result<Markup, DrawingError> {
    if series.points().len() < 2 {
        return Ok(html! {});
    }
    let picture = tool_path(series.points())?;
    Ok(html! {
        section {
            h2 { "The way of the tip in the workpiece" }
            (PreEscaped(picture))
            p.soft {
                "Nominal way in the workpiece frame, all views of one scale. What goes rapid may leave \
                 the picture."
                @if s.summary.feed_tip.value > 0.0 { " The worst lies on top." }
            }
        }
    })
}

fn marks(s: &Simulation<'_>) -> Vec<Mark> {
    let mark = |t: &Trouble| Mark { from_s: t.from_s, to_s: t.to_s, grave: t.grave };
    s.troubles.list.iter().map(mark).collect()
}

/// What the coloured stretches mean, if there are any.
fn legend(s: &Simulation<'_>) -> Markup {
    let grave = s.troubles.list.iter().any(|t| t.grave);
    let slow = s.troubles.list.iter().any(|t| !t.grave);
    html! {
        @if grave { " Red stretches: part or machine are in danger." }
        @if slow { " Yellow stretches: other troubles." }
    }
}

fn strip(
    series: &Series,
    of: Quantity,
    title: &str,
    note: String,
    limits: Vec<f64>,
    least_span: f64,
) -> Strip {
    Strip { title: title.to_owned(), note, band: series.curve(of).collect(), limits, least_span }
}

fn deviation_section(s: &Simulation<'_>, series: &Series) -> Result<Markup, DrawingError> {
    if s.summary.nodes == 0 {
        return Ok(html! {});
    }
    let rows = [
        (Quantity::Tip, "deviation of the tip, µm", 0.1),
        (Quantity::Feed, "along the feed, µm", 0.1),
        (Quantity::Normal, "along the normal, µm", 0.1),
        (Quantity::Binormal, "along the binormal, µm", 0.1),
        (Quantity::ToolAxis, "deviation of the tool axis, µrad", 0.1),
        (Quantity::PathSpeed, "speed along the path, mm/min", 1.0),
    ];
    let all: Vec<Strip> = rows
        .into_iter()
        .map(|(of, title, least)| strip(series, of, title, String::new(), Vec::new(), least))
        .collect();
    let picture = strips(&all, s.summary.time_s, &marks(s))?;
    Ok(html! {
        section.long {
            h2 { "Deviation and speed over time" }
            p.soft {
                "Of the actual tool from the nominal one, in the workpiece, rapid too. Each column shows \
                 the lowest and the highest value in its stretch of time. The speed is in deg/min where \
                 only rotary axes move." (legend(s))
            }
            (PreEscaped(picture))
        }
    })
}

fn axis_section(s: &Simulation<'_>, series: &Series) -> Result<Markup, DrawingError> {
    let mut all = Vec::new();
    for (i, axis) in s.machine.axes().iter().enumerate() {
        let unit = unit(s.machine, i);
        let ends = match axis.travel {
            Travel::Between(a, b) => vec![shown(s.machine, i, a), shown(s.machine, i, b)],
            Travel::Unlimited | Travel::Unknown => Vec::new(),
        };
        let note = format!("travel {}", travel(s, i));
        let title = format!("{}, {unit}", axis.name);
        all.push(strip(series, Quantity::Position(i), &title, note, ends, 0.01));
        let (note, ends) = match axis.limits.velocity.map(|v| shown(s.machine, i, v)) {
            Some(v) => (format!("at most {v:.0} {unit}/s"), vec![-v, v]),
            None => ("limit not stated".to_owned(), Vec::new()),
        };
        let title = format!("speed of {}, {unit}/s", axis.name);
        all.push(strip(series, Quantity::AxisSpeed(i), &title, note, ends, 0.1));
    }
    if s.summary.nodes == 0 {
        all.clear();
    }
    let marks = marks(s);
    let mut pictures = Vec::new();
    // Two axes to a picture, so that a page break does not tear a strip.
    for pair in all.chunks(4) {
        pictures.push(strips(pair, s.summary.time_s, &marks)?);
    }
    Ok(html! {
        section.long {
            h2 { "Axes" }
            (axis_table(s))
            @if !pictures.is_empty() {
                p.soft { "Positions and speeds over time; ends of travel and speed limits are red lines \
                    where they come into view." (legend(s)) }
            }
            @for picture in &pictures { figure { (PreEscaped(picture)) } }
        }
    })
}

fn travel(s: &Simulation<'_>, axis: usize) -> String {
    match s.machine.axes()[axis].travel {
        Travel::Between(a, b) => {
            let of = |v: f64| shown(s.machine, axis, v);
            format!("{:.0} … {:.0} {}", of(a), of(b), unit(s.machine, axis))
        }
        Travel::Unlimited => "without end".to_owned(),
        Travel::Unknown => "not stated".to_owned(),
    }
}

fn axis_table(s: &Simulation<'_>) -> Markup {
    let digits = |i: usize, v: f64| format!("{:.3}", shown(s.machine, i, v));
    html! {
        div.scroll { table.small {
            thead { tr {
                th { "axis" } th { "lowest" } th { "highest" } th { "travel" } th { "way" }
                th { "reversals" } th { "fastest" } th { "limit" } th { "used" } th { "fastest at" }
            } }
            tbody { @for (i, of) in s.summary.axes.iter().enumerate() { tr {
                td { b { (s.machine.axes()[i].name) } }
                @if of.lowest <= of.highest {
                    td class=[beyond(s, i, of.lowest)] { (digits(i, of.lowest)) }
                    td class=[beyond(s, i, of.highest)] { (digits(i, of.highest)) " " (unit(s.machine, i)) }
                    td { (travel(s, i)) }
                    td { (format!("{:.1}", shown(s.machine, i, of.travelled))) " " (unit(s.machine, i)) }
                    td { (of.reversals) }
                    (fastest_cells(s, i, of))
                } @else {
                    td colspan="9" { "does not move" }
                }
            } } }
        } }
    }
}

fn beyond(s: &Simulation<'_>, axis: usize, position: f64) -> Option<&'static str> {
    (!s.machine.axes()[axis].travel.contains(position)).then_some("fail")
}

fn fastest_cells(s: &Simulation<'_>, axis: usize, of: &AxisUse) -> Markup {
    let fastest = of.fastest.value.abs();
    let limit = s.machine.axes()[axis].limits.velocity;
    // Linear axes in m/min as on their plates.
    let text = |v: f64| match s.machine.axes()[axis].kind {
        AxisKind::Linear => format!("{:.2} m/min", v * 0.06),
        AxisKind::Rotary => format!("{:.1} deg/s", v.to_degrees()),
    };
    html! {
        td { (text(fastest)) }
        @match limit {
            Some(limit) => {
                td { (text(limit)) }
                td class=[(fastest > limit * (1.0 + 1e-6)).then_some("fail")] {
                    (format!("{:.0} %", 100.0 * fastest / limit))
                }
            }
            None => { td { "not stated" } td {} }
        }
        td { @if fastest > 0.0 { (s.block(of.fastest.origin)) } }
    }
}

fn trouble_section(s: &Simulation<'_>) -> Markup {
    let mut ordered: Vec<&Trouble> = s.troubles.list.iter().collect();
    ordered.sort_by_key(|t| !t.grave);
    let left_out = s.troubles.left_out + ordered.len().saturating_sub(MOST_ROWS) as u64;
    html! {
        section.long {
            h2 { "Troubles" }
            @if ordered.is_empty() {
                p { "None found." }
            } @else {
                p.soft { "Those that endanger part or machine first." }
                div.scroll { table.small.words {
                    thead { tr { th { "block" } th { "from" } th { "for" } th { "" } th { "what" } } }
                    tbody { @for trouble in ordered.iter().take(MOST_ROWS) { tr {
                        td { (blocks(s, trouble)) }
                        td { (clock(trouble.from_s)) }
                        td { (clock(trouble.to_s - trouble.from_s)) }
                        td class=(if trouble.grave { "fail" } else { "undecided" }) {
                            (if trouble.grave { "grave" } else { "time" })
                        }
                        td { (trouble_text(s.machine, trouble)) }
                    } } }
                } }
                @if left_out > 0 { p { "… and " (left_out) " more of the same kinds." } }
            }
        }
    }
}

fn tool_section(s: &Simulation<'_>) -> Markup {
    if s.summary.tools.is_empty() {
        return html! {};
    }
    let mm = |v: f64| format!("{:.3}", v + 0.0);
    html! {
        section {
            h2 { "Tools" }
            div.scroll { table {
                thead { tr { th { "tool" } th { "name" } th { "length, mm" } th { "diameter, mm" }
                    th { "moves" } } }
                tbody { @for (number, moves) in s.summary.tools.iter().take(MOST_ROWS) { tr {
                    td { @if *number == 0 { "none yet" } @else { "T" (number) } }
                    @match s.setup.tools.get(number) {
                        Some(tool) => {
                            td { (tool.name) } td { (mm(-tool.tip_mm.z)) }
                            td { @if let Some(d) = tool.diameter_mm { (mm(d)) } }
                        }
                        None => {
                            td { "as in the machine file" } td { (mm(-s.machine.tip_mm().z)) } td {}
                        }
                    }
                    td { (moves) }
                } } }
            } }
        }
    }
}

fn message_section(s: &Simulation<'_>) -> Markup {
    let found: Vec<_> = s.run.problems.iter().take(MOST_ROWS).collect();
    let messages = &s.summary.messages;
    html! {
        @if !messages.is_empty() {
            section {
                h2 { "Messages of the program" }
                @for message in messages { p { code { (message) } } }
            }
        }
        @if !found.is_empty() {
            section.long {
                h2 { "Notes on the program" }
                div.scroll { table.small.words {
                    thead { tr { th { "place" } th { "" } th { "what" } th { "hint" } } }
                    tbody { @for d in &found { tr {
                        td { @if d.place.line > 0 { (d.place.line) ":" (d.place.column) }
                            @else { "whole" } }
                        td class=[(d.severity == Severity::Error).then_some("fail")] {
                            (d.severity)
                        }
                        td { (d.message) } td { (d.hint) }
                    } } }
                } }
            }
        }
    }
}

fn input_section(s: &Simulation<'_>) -> Markup {
    let offsets: Vec<String> = s.setup.work_offsets.keys().map(ToString::to_string).collect();
    let called: Vec<&String> = s.run.programs.iter().skip(1).take(MOST_ROWS).collect();
    html! {
        section {
            h2 { "Inputs" }
            div.scroll { table.words { tbody {
                tr { td { "program" } td { code { (s.program) } } }
                @for program in called { tr { td { "subprogram" } td { code { (program) } } } }
                tr { td { "control" } td { (control_name(s.control)) } }
                tr { td { "set-up" } td {
                    @if s.setup.given {
                        "given: " (s.setup.tools.len()) " tools; work offsets "
                        @if offsets.is_empty() { "none" } @else { (offsets.join(", ")) }
                    } @else {
                        "none: work offsets and tool lengths are 0"
                    }
                } }
                tr { td { "machine" } td { (s.machine.name()) " " code { (s.machine.chain_text()) } } }
                tr { td { "source of the machine" } td { (s.machine.source()) } }
                tr { td { "stated errors" } td { (s.machine.stated_errors().len()) } }
                @if let Some(drift) = s.drift {
                    tr { td { "temperatures" } td {
                        (drift.run().log.file()) ", from " (format!("{:.1}", drift.run().start_s))
                        " s of its time"
                    } }
                    @for sensor in drift.sensors() { tr {
                        td { (sensor.sensor) }
                        td { (format!("{:.2} … {:.2} °C", sensor.lowest_celsius, sensor.highest_celsius)) }
                    } }
                    tr { td { "drift" } td {
                        (um(drift.tip.value)) " µm at the most, at " (s.block(drift.tip.origin)) "; "
                        (um(drift.last_mm)) " µm at the end: how far the deviation of the tip has \
                        moved since the start, with feed"
                    } }
                }
                @if let Some(path) = s.path_file { tr { td { "path" } td { code { (path) } } } }
                tr { td { "made by" } td { "trueaxis " (trueaxis_report::VERSION) } }
            } } }
        }
    }
}
