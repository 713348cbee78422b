//! Reports as PDF: the same bytes, text that is no markup, headings, glyphs.

#![cfg(feature = "pdf")]

use trueaxis_paper::{Form, print};
use trueaxis_report::{
    Columns, Figure, Heading, Item, Logo, LogoKind, Report, Section, Standing, Table,
};

const PICTURE: &str =
    "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 40 10'><text y='9'>axis</text></svg>";

fn report(rows: usize) -> Report<'static> {
    let table = Table::new(["position mm", "deviation µm"]);
    let table = table.rows((0..rows).map(|i| [format!("{i}"), format!("{}.5", i % 7)]));
    let figure = || Figure::new("", || Ok(PICTURE.to_owned()));
    Report::new("Axis X #[= 5 $")
        .line("*not bold* `x`")
        .verdict(Standing::Good, "PASS", "within 6 µm")
        .section(Section::new("Readings").table(table))
        .section(Section::new("Picture").grid(Columns::AsFit, [figure(), figure(), figure()]))
        .section(
            Section::new("All")
                .note("a note")
                .list(["a".to_owned()])
                .code("G1 X1\n")
                .paragraph("p"),
        )
}

fn bytes(report: &Report<'_>) -> Vec<u8> {
    let printed = print(report, Form::Pdf).unwrap();
    assert_eq!(printed.missing, "");
    printed.bytes
}

#[test]
fn the_same_report_gives_the_same_bytes() {
    let first = bytes(&report(3));
    assert!(first.starts_with(b"%PDF-1."));
    assert_eq!(first, bytes(&report(3)));
}

#[test]
fn rows_of_unequal_length_keep_their_columns() {
    let table = Table::new(["a", "b", "c"]).row(["1"]).row(["2", "3", "4"]);
    bytes(&Report::new("T").section(Section::new("s").table(table)));
    bytes(&Report::new("").section(Section::new("s").item(Item::Table(Table::default()))));
}

/// Typesetting takes about 0.1 ms a cell: a table of a million rows would take minutes and gigabytes.
#[test]
fn a_long_table_ends_with_what_is_not_printed() {
    let size = |rows| bytes(&report(rows)).len();
    let (most, more, many) = (size(2000), size(2001), size(300_000));
    assert!(most < more && many.abs_diff(more) < 2000, "{most} {more} {many}");
}

#[test]
fn a_heading_and_a_logo_are_set() {
    let heading = Heading {
        number: "7".into(),
        entries: vec![("customer".into(), "#panic()".into())],
        table: Some(Table::new(["instrument"]).row(["laser"])),
        logo: Some(Logo { bytes: PICTURE.into(), kind: LogoKind::of(PICTURE.as_bytes()).unwrap() }),
        signatures: vec!["measured".into(), "approved".into()],
    };
    let report = Report { heading: Some(heading), ..report(100) };
    assert!(bytes(&report).len() > bytes(&self::report(100)).len());
}

#[test]
fn a_logo_that_is_broken_is_an_error() {
    let bytes = b"\x89PNG\r\n\x1a\n with the right ends IEND\xaeB`\x82".to_vec();
    let logo = Some(Logo { bytes, kind: LogoKind::Png });
    let heading = Some(Heading { logo, ..Heading::default() });
    let why = print(&Report { heading, ..report(1) }, Form::Pdf).unwrap_err();
    assert!(why.to_string().starts_with("the report cannot be typeset"), "{why}");
}

#[test]
fn a_character_without_a_glyph_is_named() {
    let missing = print(&Report::new("\u{10fff0}x"), Form::Pdf).unwrap().missing;
    assert_eq!(missing, "\u{10fff0}");
}
