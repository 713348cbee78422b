//! docs/reference/plausible.md lists the ranges of the code; `TRUEAXIS_WRITE_PLAUSIBLE=1` writes its table.

use std::fmt::Write as _;
use std::fs;
use trueaxis_input::plausible::{RANGES, Range};

const PAGE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/reference/plausible.md");
const HEAD: &str =
    "| entry | what | plausible | possible | reason | source |\n|---|---|---|---|---|---|\n";

fn range((low, high): (f64, f64)) -> String {
    let shown = |v: f64| match v.abs() {
        1e6.. => format!("{v:e}"),
        _ => format!("{v}"),
    };
    if low == -high {
        format!("±{}", shown(high))
    } else {
        format!("{} … {}", shown(low), shown(high))
    }
}

fn row(r: &Range) -> String {
    let (plausible, possible) = (range(r.plausible), range(r.possible));
    let what = ["a ", "an ", "the "].iter().find_map(|a| r.what.strip_prefix(a)).unwrap_or(r.what);
    format!(
        "| `{}` | {what}, {} | {plausible} | {possible} | {} | {} |\n",
        r.key, r.unit, r.reason, r.source
    )
}

#[test]
fn the_page_lists_the_ranges_of_the_code() {
    let table = RANGES.iter().fold(HEAD.to_owned(), |mut text, r| {
        let _ = write!(text, "{}", row(r)); // a String takes everything
        text
    });
    let page = fs::read_to_string(PAGE).expect("docs/reference/plausible.md");
    let (before, rest) = page.split_once(HEAD).expect("the head of the table");
    let end = rest.find("\n\n").expect("text after the table") + 1;
    if std::env::var_os("TRUEAXIS_WRITE_PLAUSIBLE").is_some() {
        fs::write(PAGE, format!("{before}{table}{}", &rest[end..])).expect("written");
        return;
    }
    assert_eq!(&rest[..end], &table[HEAD.len()..], "TRUEAXIS_WRITE_PLAUSIBLE=1 writes it");
}
