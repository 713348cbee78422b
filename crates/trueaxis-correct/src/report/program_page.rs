//! A compensated program as one self-contained page.

use super::program::{ProgramReport, number};
use maud::{Markup, html};
use trueaxis_report::page::document;

/// The report as the text of an HTML file.
pub fn program_html(r: &ProgramReport<'_>) -> String {
    let title = format!("{} compensated for {}", r.program, r.machine.name());
    let found = &r.rewritten.found;
    let content = html! {
        h1 { (title) }
        p.soft { code { (r.machine.chain_text()) } " · written to " (r.output) " · " (r.rounding()) }
        (verdict(r))
        section {
            h2 { "What the actual tool misses, before and after" }
            div.scroll { table {
                thead { tr { th { "largest deviation" } th { "before" } th { "line" } th { "after" }
                    th { "line" } th { "unit" } } }
                tbody { @for row in r.rows() { tr {
                    td { (row.name) }
                    td { (number(row.before)) } td { (row.lines[0]) }
                    td { (number(row.after)) } td { (row.lines[1]) }
                    td { (row.unit) }
                } } }
            } }
            p.soft {
                "The written program, read back and simulated on the actual machine, against the \
                 program as it was on the nominal machine. Lines are those of the program as it was."
                @if r.rewritten.confidence.largest_u_mm > 0.0 {
                    " The model itself is known to u = "
                    (number(r.rewritten.confidence.largest_u_mm * 1e3))
                    " µm (k = 1) at the worst of " (r.rewritten.confidence.looked_at) " places."
                }
            }
        }
        section {
            h2 { "What was done" }
            div.scroll { table { tbody {
                (count("blocks that move the tool", found.blocks))
                (count("of these cut into several", found.split))
                (count("blocks written for them", found.pieces))
                (count("circles that became straight pieces", found.circles))
                (count("words added", found.words_added))
                (count("feeds changed where only rotary axes turn", found.feeds_changed))
            } } }
            p.soft {
                "The feed is kept; the way of the tip in a block changes by up to "
                (format!("{:+.1}", found.length_change * 1e6)) " µm/m."
            }
            @for remark in r.remarks() { p { (remark) "." } }
        }
        (corrections(r))
        (worst(r))
        (conventions(r))
        p.soft { "made by trueaxis " (trueaxis_report::VERSION) }
    };
    document(&title, &content)
}

fn verdict(r: &ProgramReport<'_>) -> Markup {
    let proof = &r.rewritten.proof;
    let (before, after) = (proof.before.tip_end.value * 1e3, proof.after.tip_end.value * 1e3);
    html! {
        section class="verdict pass" {
            strong { "WRITTEN" }
            span {
                "The tip misses its block ends by up to " (number(after)) " µm instead of "
                (number(before)) " µm, and is within " (number(proof.after.tip.value * 1e3))
                " µm of its path between them."
            }
        }
    }
}

fn count(name: &str, n: u64) -> Markup {
    html! { tr { td { (name) } td { (n) } } }
}

fn corrections(r: &ProgramReport<'_>) -> Markup {
    html! {
        section {
            h2 { "Largest correction of each axis" }
            div.scroll { table {
                thead { tr { th { "axis" } th { "correction" } th { "unit" } th { "line" } } }
                tbody { @for (i, largest) in r.rewritten.found.largest.iter().enumerate() {
                    @let (scale, unit) = r.unit(i);
                    tr {
                        td { b { (r.axis_name(i)) } }
                        td { (format!("{:+.3}", largest.value * scale)) }
                        td { (unit) }
                        td { (largest.line) }
                    }
                } }
            } }
        }
    }
}

fn worst(r: &ProgramReport<'_>) -> Markup {
    html! {
        section.long {
            h2 { "The blocks that keep most" }
            div.scroll { table {
                thead { tr { th { "line" } th { "tip before, µm" } th { "tip after, µm" }
                    th { "tool axis before, µrad" } th { "tool axis after, µrad" } } }
                tbody { @for block in &r.rewritten.proof.worst { tr {
                    td { (block.line) }
                    td { (number(block.tip_before_mm * 1e3)) }
                    td { (number(block.tip_after_mm * 1e3)) }
                    td { (number(block.axis_before_rad * 1e6)) }
                    td { (number(block.axis_after_rad * 1e6)) }
                } } }
            } }
        }
    }
}

fn conventions(r: &ProgramReport<'_>) -> Markup {
    html! {
        section {
            h2 { "Convention check" }
            p.soft { "What would be left at the block with the largest correction without any, and if the \
                control took it with a wrong sign: a wrong sign makes it about twice as bad as no \
                correction. Try one pose on the machine before the first part." }
            div.scroll { table {
                thead { tr { th {} th { "tip, µm" } th { "tool axis, µrad" } } }
                tbody { @for (name, tip, axis) in r.conventions() { tr {
                    td { (name) } td { (number(tip)) } td { (number(axis)) }
                } } }
            } }
        }
    }
}
