//! Reports as files: their forms, and the heading of one that is signed.

mod command;

use command::{Folder, Ran, trueaxis};

const HEADING: &str = "examples/07_verify/report-heading.toml";

fn evaluated(more: &[&str]) -> Ran {
    let file = "examples/07_verify/x-axis-laser.csv";
    trueaxis(&[&["evaluate", "iso230-2", file], more].concat())
}

fn refused(ran: &Ran, code: &str) {
    assert_eq!(ran.status, 2, "{}{}", ran.out, ran.err);
    assert!(ran.err.contains(&format!("error[{code}]")), "{}", ran.err);
    assert!(ran.has_no_answer(), "{}", ran.out);
}

#[test]
fn the_ending_says_what_is_written() {
    let folder = Folder::new("report-ending");
    for name in ["x.docx", "x", "x.html.txt"] {
        let path = folder.path(name);
        refused(&evaluated(&["--report", &path]), "unknown-report-form");
        assert!(!std::path::Path::new(&path).exists());
    }
    let page = folder.path("x.HTM");
    assert_eq!(evaluated(&["--report", &page]).status, 0);
    assert!(std::fs::read_to_string(page).expect("a page").starts_with("<!DOCTYPE html>"));
}

#[test]
fn a_heading_stands_above_and_its_signatures_below() {
    let folder = Folder::new("report-heading");
    let page = folder.path("x.html");
    let ran = evaluated(&["--report", &page, "--heading", HEADING]);
    assert_eq!(ran.status, 0, "{}", ran.err);
    let page = std::fs::read_to_string(page).expect("a page");
    let at = |words: &str| page.find(words).unwrap_or_else(|| panic!("no {words}:\n{page}"));
    let order = [
        "<h1>",
        "2026-117",
        "Example Turbines",
        "K 2026-0042",
        "<svg",
        "measured: name",
        "made by",
    ];
    assert!(order.map(at).is_sorted(), "{:?}", order.map(at));
    assert!(page.contains("data:image/svg+xml;base64,"));
}

#[test]
fn mistakes_in_a_heading_write_nothing() {
    let folder = Folder::new("report-mistakes");
    let page = folder.path("x.html");
    let with = |text: &str| {
        let heading = folder.file("h.toml", text);
        let ran = evaluated(&["--report", &page, "--heading", &heading]);
        assert!(!std::path::Path::new(&page).exists());
        ran
    };
    refused(&with("[report]\nnumber = '1'\n"), "missing-key");
    refused(&with("[report]\nnumber = '1'\ndate = 'soon'\n"), "bad-date");
    refused(&with("[report]\nnumber = '1'\ndate = 2026-01-01\nlogo = 'h.toml'\n"), "bad-logo");
    refused(&with("[report]\nnumber = '1'\ndate = 2026-01-01\noperater = 'h'\n"), "unknown-key");
    refused(&evaluated(&["--report", &page, "--heading", "no.toml"]), "unreadable-file");
    // The report must not replace its own heading.
    let heading = folder.file("h.html", "[report]\nnumber = '1'\ndate = 2026-01-01\n");
    refused(
        &evaluated(&["--report", &heading, "--heading", &heading, "--force"]),
        "unwritable-file",
    );
}

#[cfg(not(feature = "pdf"))]
#[test]
fn a_build_without_typesetting_says_so() {
    let folder = Folder::new("report-no-pdf");
    refused(&evaluated(&["--report", &folder.path("x.pdf")]), "no-pdf");
}

/// The words of the page stand in the PDF, as another program reads it.
#[cfg(feature = "pdf")]
#[test]
fn oracle_poppler_reads_the_words_of_the_page() {
    use std::process::Command;
    let folder = Folder::new("report-pdf");
    let (pdf, again) = (folder.path("x.pdf"), folder.path("y.pdf"));
    let ran = evaluated(&["--report", &pdf, "--heading", HEADING]);
    assert_eq!(ran.status, 0, "{}", ran.err);
    evaluated(&["--report", &again, "--heading", HEADING]);
    let read = |path: &str| std::fs::read(path).expect("a file");
    assert!(read(&pdf) == read(&again), "the same report gives other bytes");
    let Ok(output) = Command::new("pdftotext").args(["-layout", &pdf, "-"]).output() else {
        eprintln!("skipped: there is no pdftotext (poppler-utils)");
        return;
    };
    let text = String::from_utf8(output.stdout).expect("UTF-8");
    let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
    let words = [
        "number 2026-117",
        "customer Example Turbines",
        "K 2026-0042",
        "11.26",
        "3.66",
        "page 1 of",
    ];
    for words in words {
        assert!(text.contains(words), "no `{words}` in {text}");
    }
    assert!(text.contains("measured: name, date, signature"), "{text}");
}
