//! One self-contained page: opens offline, no script, no file from elsewhere.

use crate::{Labels, filled};
use maud::{DOCTYPE, Markup, PreEscaped, html};

/// A page with its head, around what it shows.
pub(crate) fn document(title: &str, labels: &Labels, content: &Markup) -> String {
    let page = html! {
        (DOCTYPE)
        html lang=(labels.language) {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                title { (title) }
                style { (PreEscaped(STYLE)) (PreEscaped(page_numbers(&labels.page))) }
            }
            body { main { (content) } }
        }
    };
    page.into_string()
}

/// `page {0} of {1}` at the foot of each sheet.
fn page_numbers(label: &str) -> String {
    let quoted = label.replace(['\\', '\'', '\n', '<'], "");
    let content = filled(&quoted, &["' counter(page) '", "' counter(pages) '"]);
    format!("@page {{ @bottom-right {{ content:'{content}'; }} }}\n")
}

/// Three views beside each other, as the style of a grid.
pub(crate) const THREE: &str = "grid-template-columns:repeat(3, minmax(0, 1fr))";

/// Everything that styles the report.
const STYLE: &str = "\
:root { --ink:#1f2933; --soft:#5b6773; --line:#d8dee4; --paper:#ffffff; --bg:#f4f6f8;
  --pass:#0b7a4b; --fail:#b3261e; --open:#8a5a00; --accent:#0072b2; }
* { box-sizing:border-box; }
body { margin:0; background:var(--bg); color:var(--ink);
  font:16px/1.5 system-ui, 'Segoe UI', 'Noto Sans', sans-serif; }
main { max-width:1080px; margin:0 auto; padding:24px 20px 60px; }
h1 { font-size:1.6rem; margin:0 0 .2rem; } h2 { font-size:1.15rem; margin:0 0 .6rem; }
p { margin:.3rem 0 .7rem; } .soft { color:var(--soft); }
section { background:var(--paper); border:1px solid var(--line); border-radius:10px;
  padding:18px 20px; margin:16px 0; }
.verdict { display:flex; gap:16px; align-items:baseline; border-left:8px solid; }
.verdict strong { font-size:1.5rem; }
.verdict.pass { border-color:var(--pass); } .pass strong, td.pass { color:var(--pass); }
.verdict.fail { border-color:var(--fail); } .fail strong, td.fail { color:var(--fail); }
.verdict.undecided { border-color:var(--open); } .undecided strong, td.undecided { color:var(--open); }
.grid { display:grid; grid-template-columns:repeat(auto-fit, minmax(330px, 1fr)); gap:16px; }
.scroll { overflow-x:auto; }
table { border-collapse:collapse; width:100%; font-variant-numeric:tabular-nums; font-size:.93rem; }
th, td { text-align:right; padding:4px 10px; border-bottom:1px solid var(--line); }
th:first-child, td:first-child { text-align:left; }
table.small { font-size:.82rem; } table.small th, table.small td { padding:4px 6px; }
thead th { color:var(--soft); font-weight:600; border-bottom:2px solid var(--line); }
tr.decisive td:first-child { font-weight:600; }
td.pass, td.fail, td.undecided { font-weight:600; }
svg { width:100%; height:auto; display:block; }
code { font-family:ui-monospace, 'DejaVu Sans Mono', monospace; font-size:.9em; }
pre { overflow-x:auto; font-size:.85rem; }
figure { margin:0; } figcaption { color:var(--soft); font-size:.9rem; padding-top:4px; }
table.words th, table.words td { text-align:left; vertical-align:top; }
table.words td:first-child { white-space:nowrap; }
img.logo { float:right; height:56px; max-width:30%; }
.signatures { display:grid; grid-template-columns:repeat(auto-fit, minmax(220px, 1fr)); gap:48px 24px; margin-top:72px; }
.signatures div { border-top:1px solid var(--ink); padding-top:4px; color:var(--soft); font-size:.9rem; break-inside:avoid; }
@page { size:A4; margin:16mm 14mm 18mm; }
@media print { html, body { font-size:12px; background:#fff; } main { padding:0; }
  section { break-inside:avoid; border:none; padding:6px 0; margin:8px 0; }
  section.verdict { border-left:8px solid; padding:6px 16px; }
  section.long { break-inside:auto; } figure, tr { break-inside:avoid; } h2 { break-after:avoid; }
  .scroll { overflow:visible; } * { print-color-adjust:exact; -webkit-print-color-adjust:exact; } }
";
