//! A part file, or a draft of one, as a document and as a report.

use super::drawing::allowed;
use serde::Serialize;
use trueaxis_part::part::{Characteristic, Feature, Part};
use trueaxis_part::qif;
use trueaxis_report::JsonSchema;
use trueaxis_report::{Report, Section, Standing, Table};

/// A part file or a draft of one: `trueaxis/part/1`.
#[derive(Debug, Serialize, JsonSchema)]
pub struct PartFileDocument<'a> {
    /// Which document this is.
    #[schemars(extend("const" = "trueaxis/part/1"))]
    pub schema: &'static str,
    /// The name of the part; null for a draft.
    pub name: Option<&'a str>,
    /// The features of a part file.
    pub features: Vec<PartFeatureEntry<'a>>,
    /// Its characteristics.
    pub characteristics: Vec<PartCharacteristicEntry<'a>>,
    /// The draft of a QIF file; null for a part file.
    pub draft: Option<DraftEntry<'a>>,
}

/// A feature of a part file.
#[derive(Debug, Serialize, JsonSchema)]
pub struct PartFeatureEntry<'a> {
    /// Its name.
    pub name: &'a str,
    /// `plane`, `cylinder`, `cone`, `sphere`, `torus`, `slot`, `tongue`, `thread`, `points` or `programmed surface`.
    pub shape: &'static str,
    /// Its letter as a datum.
    pub datum: Option<&'a str>,
    /// How many points are checked; of a surface of the program, lines of sight.
    pub points: usize,
}

/// A characteristic of a part file.
#[derive(Debug, Serialize, JsonSchema)]
pub struct PartCharacteristicEntry<'a> {
    /// Its name.
    pub name: &'a str,
    /// What is asked, such as `flatness`.
    pub kind: &'static str,
    /// Of which feature or pattern.
    pub feature: &'a str,
    /// To which features, the first datum first.
    pub datums: Vec<String>,
    /// How far its zone reaches beyond the end of the axis, below 0 beyond its beginning; absent without a projected zone, mm.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub projected_mm: Option<f64>,
    /// The least value allowed; null for a zone, mm.
    pub low_mm: Option<f64>,
    /// The largest value allowed, mm.
    pub high_mm: f64,
}

/// A draft of a part file.
#[derive(Debug, Serialize, JsonSchema)]
pub struct DraftEntry<'a> {
    /// The text of the part file.
    pub text: String,
    /// How many features it has.
    pub features: usize,
    /// How many characteristics.
    pub characteristics: usize,
    /// How many values the file does not state; they are written as `"?"`.
    pub unknown: usize,
    /// What of the QIF file is not in it.
    pub left_out: Vec<LeftOutEntry<'a>>,
}

/// Something that is not in a draft.
#[derive(Debug, Serialize, JsonSchema)]
pub struct LeftOutEntry<'a> {
    /// Its id in the QIF file.
    pub id: &'a str,
    /// What it is.
    pub what: &'a str,
    /// Why it is not in the draft.
    pub reason: &'a str,
    /// Its line in the QIF file.
    pub line: usize,
}

impl<'a> PartFileDocument<'a> {
    /// Of a part file.
    pub fn of_part(part: &'a Part) -> Self {
        let feature = |f: &'a Feature| PartFeatureEntry {
            name: &f.name,
            shape: f.shape_name(),
            datum: f.letter.as_deref(),
            points: f.points.len(),
        };
        let characteristic = |c: &'a Characteristic| {
            let (low_mm, high_mm) = c.limits.ends_mm();
            PartCharacteristicEntry {
                name: &c.name,
                kind: c.kind.key(),
                feature: &c.of,
                datums: c.datums.iter().map(|d| d.name(&part.features)).collect(),
                projected_mm: c.projected_mm,
                low_mm,
                high_mm,
            }
        };
        Self {
            schema: "trueaxis/part/1",
            name: Some(&part.name),
            features: part.features.iter().map(feature).collect(),
            characteristics: part.characteristics.iter().map(characteristic).collect(),
            draft: None,
        }
    }

    /// Of a draft.
    pub fn of_draft(draft: &'a qif::Draft) -> Self {
        let left_out = |l: &'a qif::LeftOut| LeftOutEntry {
            id: &l.id,
            what: &l.what,
            reason: &l.reason,
            line: l.place.line,
        };
        Self {
            schema: "trueaxis/part/1",
            name: None,
            features: Vec::new(),
            characteristics: Vec::new(),
            draft: Some(DraftEntry {
                text: draft.text(),
                features: draft.features(),
                characteristics: draft.characteristics(),
                unknown: draft.unknown(),
                left_out: draft.left_out().iter().map(left_out).collect(),
            }),
        }
    }
}

/// A part file.
pub fn part_report(part: &Part) -> Report<'_> {
    let feature = |f: &Feature| {
        let letter = f.letter.clone().unwrap_or_default();
        [f.name.clone(), f.shape_name().to_owned(), letter, f.points.len().to_string()]
    };
    let features =
        Table::new(["feature", "shape", "datum", "points"]).rows(part.features.iter().map(feature));
    let characteristic = |c: &Characteristic| [c.name.clone(), allowed(&c.limits)];
    let asked = Table::new(["characteristic", "allowed, µm"])
        .rows(part.characteristics.iter().map(characteristic));
    Report::new(&part.name)
        .line(part.source.clone())
        .section(Section::new("Features").table(features))
        .section(Section::new("Characteristics").table(asked))
}

/// A draft, with its text where it is shown.
pub fn draft_report(draft: &qif::Draft, is_shown: bool) -> Report<'_> {
    let (features, asked) = (draft.features(), draft.characteristics());
    let counts = format!("{features} features, {asked} characteristics");
    let report = Report::new("Draft of a part file");
    let report = match (asked, draft.unknown()) {
        (0, _) => report.verdict(Standing::Bad, "EMPTY", "no characteristic can be evaluated"),
        (_, 0) => report.verdict(Standing::Good, "COMPLETE", counts),
        (_, 1) => report.verdict(
            Standing::Open,
            "TO FILL IN",
            format!("{counts}; one value, written as \"?\""),
        ),
        (_, many) => report.verdict(
            Standing::Open,
            "TO FILL IN",
            format!("{counts}; {many} values, written as \"?\""),
        ),
    };
    let left_out = draft
        .left_out()
        .iter()
        .map(|l| [l.id.clone(), l.what.clone(), l.reason.clone(), l.place.line.to_string()]);
    let table = Table::new(["QIF id", "left out", "reason", "line"]).rows(left_out);
    let report = match draft.left_out().is_empty() {
        true => report,
        false => report.section(Section::new("Left out").table(table.most_on_terminal(20))),
    };
    match is_shown {
        true => report.section(Section::new("Draft").code(draft.text())),
        false => report,
    }
}
