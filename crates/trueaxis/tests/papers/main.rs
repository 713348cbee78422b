//! The validation: every published number, every result of another program and every hand
//! calculation that we answer for, with the difference that we allow and why.
//!
//! ```text
//!     *.toml: claims ──┐
//!                      ├─ |ours − theirs| ≤ allowed ──> docs/validation.md
//!     *.rs: ours ──────┘
//! ```
//!
//! A claim without a function, or a function without a claim, fails. docs/validation.md is written
//! by `TRUEAXIS_WRITE_VALIDATION=1 cargo test -p trueaxis --test papers`; otherwise it is compared.

mod claim;
mod document_000;
mod document_001;
mod document_002;
mod document_003;
mod document_003_rest;
mod document_004;
mod hand;
mod oracles;
mod page;
mod probe_table;
mod scan;
mod shop;
mod stages;
mod zhang_2019_laser;

use claim::{Claim, Record, records};
use std::collections::BTreeSet;
use std::fs;

/// Computes our side of a claim through the public interface of the library.
type Ours = fn() -> Vec<f64>;

fn functions() -> Vec<(&'static str, Ours)> {
    let lists: [&[(&str, Ours)]; 11] = [
        document_000::CLAIMS,
        document_001::CLAIMS,
        document_002::CLAIMS,
        document_003::CLAIMS,
        document_003_rest::CLAIMS,
        document_004::CLAIMS,
        hand::CLAIMS,
        oracles::CLAIMS,
        probe_table::CLAIMS,
        stages::CLAIMS,
        zhang_2019_laser::CLAIMS,
    ];
    lists.concat()
}

fn ours(claim: &Claim) -> Vec<f64> {
    let found = functions().into_iter().find(|(id, _)| *id == claim.id);
    let (_, compute) = found.unwrap_or_else(|| panic!("claim {} has no function", claim.id));
    compute()
}

fn claims(records: &[Record]) -> impl Iterator<Item = &Claim> {
    records.iter().flat_map(|r| &r.claims)
}

/// Erratum numbers such as 000-21 in a text.
fn errata_in(text: &str) -> Vec<String> {
    let words = text.split(|c: char| !c.is_ascii_digit() && c != '-');
    let is_number = |part: &str| !part.is_empty() && part.chars().all(|c| c.is_ascii_digit());
    let is_erratum = |word: &&str| {
        word.split_once('-').is_some_and(|(d, n)| {
            d.starts_with("00") && d.len() == 3 && is_number(d) && is_number(n)
        })
    };
    words.filter(is_erratum).map(str::to_owned).collect()
}

#[test]
fn paper_every_claim_has_one_function_and_every_function_a_claim() {
    let records = records();
    let claimed: Vec<&str> = claims(&records).map(|c| c.id.as_str()).collect();
    let computed: Vec<&str> = functions().iter().map(|(id, _)| *id).collect();
    let set = |list: &[&str]| list.iter().map(|id| (*id).to_owned()).collect::<BTreeSet<_>>();
    let alone: Vec<_> = set(&claimed).symmetric_difference(&set(&computed)).cloned().collect();
    assert!(alone.is_empty(), "in *.toml or in *.rs, but not in both: {alone:?}");
    assert_eq!(claimed.len(), set(&claimed).len(), "an id is used twice in *.toml");
    assert_eq!(computed.len(), set(&computed).len(), "an id is used twice in *.rs");
}

#[test]
fn paper_every_claim_holds() {
    let mut wrong = Vec::new();
    for claim in claims(&records()) {
        let ours = ours(claim);
        let off = ours.iter().zip(&claim.theirs).map(|(o, t)| (o - t).abs());
        let worst = off.fold(0.0_f64, |w, d| if d.is_nan() { d } else { w.max(d) });
        let holds = ours.len() == claim.theirs.len() && worst <= claim.allowed;
        if !holds {
            wrong.push(format!(
                "{}: ours {ours:?}, theirs {:?} {}, allowed {:e}",
                claim.id, claim.theirs, claim.unit, claim.allowed
            ));
        }
    }
    assert!(wrong.is_empty(), "\n{}", wrong.join("\n"));
}

/// A `DIFFERENCE:` in the sources or in docs/model.md, and an erratum that a claim cites, must
/// stand in differences.toml, so that the page tells it.
#[test]
fn paper_every_difference_is_told() {
    let records = records();
    let reported: BTreeSet<&str> =
        records.iter().flat_map(|r| &r.differences).map(|d| d.id.as_str()).collect();
    let mut cited: Vec<String> = scan::differences();
    for claim in claims(&records) {
        cited.extend(errata_in(&format!("{} {} {}", claim.what, claim.source, claim.why)));
    }
    let untold: BTreeSet<_> = cited.iter().filter(|id| !reported.contains(id.as_str())).collect();
    assert!(cited.len() > 10, "the scan found next to nothing");
    assert!(untold.is_empty(), "not in differences.toml: {untold:?}");
}

#[test]
fn paper_the_validation_page_is_fresh() {
    let page = page::written(&records(), &scan::judged_tests(), &ours);
    let path = shop::root().join("docs/validation.md");
    if std::env::var_os("TRUEAXIS_WRITE_VALIDATION").is_some() {
        fs::write(&path, page).expect("docs is there");
        return;
    }
    let committed = fs::read_to_string(&path).unwrap_or_default().replace("\r\n", "\n");
    let differs = page.lines().zip(committed.lines()).find(|(new, old)| new != old);
    assert!(
        page == committed,
        "docs/validation.md is not what the tests say now; first difference: {differs:?}\n\
         run TRUEAXIS_WRITE_VALIDATION=1 cargo test -p trueaxis --test papers, and read the diff"
    );
}
