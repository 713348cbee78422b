//! QIF product definition files (ISO 23952:2020, and 2.1) as drafts of part files.
//!
//! ```text
//! QIF file ──draft──> Draft { features, characteristics, a list of all others } ──text──> part file (TOML)
//!            │   │
//!            │   └ faces of the model: the rectangle of a plane, the length of a bore
//!            └ a value that the file does not state is written as "?"
//! ```
//!
//! [`results`] writes QIF files: a part with what was found of it.
//!
//! Nothing is weakened: what a drawing asks beyond what a part file can say is left out by name.

mod characteristics;
mod collect;
mod datums;
mod document;
mod features;
pub mod results;
mod text;
mod topology;
mod trial;
mod units;

use crate::part::{Datum, Kind};
use characteristics::Limits;
use collect::Collected;
use document::{Reader, text_of};
use features::Form;
use text::{Unknown, Writer};
use trueaxis_input::{Diagnostics, Place};
use units::Units;

/// A part file as far as a QIF file states it.
#[derive(Debug, Clone, PartialEq)]
pub struct Draft {
    name: String,
    source: String,
    features: Vec<Drafted>,
    characteristics: Vec<Asked>,
    left_out: Vec<LeftOut>,
}

/// Something of the QIF file that is not in the draft.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LeftOut {
    /// Its id in the QIF file.
    pub id: String,
    /// What it is, such as `position "Position.1"`.
    pub what: String,
    /// Why it is not in the draft.
    pub reason: String,
    /// Where it is in the QIF file.
    pub place: Place,
}

/// A feature of the draft.
#[derive(Debug, Clone, PartialEq)]
struct Drafted {
    id: String,
    name: String,
    /// Of the QIF file, in words.
    kind: String,
    letter: Option<String>,
    form: Form,
    notes: Vec<String>,
    place: Place,
}

/// A characteristic of the draft.
#[derive(Debug, Clone, PartialEq)]
struct Asked {
    id: String,
    name: Option<String>,
    kind: Kind,
    limits: Limits,
    note: Option<String>,
    of: usize,
    datums: Vec<Datum>,
    place: Place,
}

impl Drafted {
    fn label(&self) -> &str {
        self.letter.as_deref().unwrap_or(&self.name)
    }
}

impl Draft {
    /// The part file: TOML that the reader of part files accepts once each `"?"` is replaced. Comments at its
    /// end name what is not in it.
    pub fn text(&self) -> String {
        Writer::write(self, Unknown::Marked).text
    }

    /// How many values are written as `"?"`.
    pub fn unknown(&self) -> usize {
        Writer::write(self, Unknown::Marked).unknown
    }

    /// How many features it has.
    pub fn features(&self) -> usize {
        self.features.len()
    }

    /// How many characteristics it has.
    pub fn characteristics(&self) -> usize {
        self.characteristics.len()
    }

    /// What of the QIF file is not in the draft, and why.
    pub fn left_out(&self) -> &[LeftOut] {
        &self.left_out
    }
}

/// Drafts a part file from the text of a QIF file; `file` is its name, for messages and as the source of the part.
///
/// Contradictions of the file are warnings with their places, and what they concern is left out. `None` with an error where
/// there is nothing to draft from.
pub fn draft(file: &str, text: &str, problems: &mut Diagnostics) -> Option<Draft> {
    let document = document::parse(file, text, problems)?;
    let reader = Reader::new(&document, file, problems)?;
    let units = Units::read(&reader, problems)?;
    if reader.ending("CharacteristicNominal").next().is_none() {
        let message = "the file has no characteristics of a product".to_owned();
        let hint = "expected <CharacteristicNominals> with <CharacteristicDefinitions>; results alone have none";
        problems.error("no-characteristic", Place::whole(file), message, hint);
        return None;
    }
    let mut collected = Collected::new(&reader, &units);
    for nominal in reader.ending("CharacteristicNominal") {
        if !collected.characteristic(nominal, problems) {
            return None;
        }
    }
    let base = file.rsplit(['/', '\\']).next().unwrap_or(file);
    let version = reader.document.root_element().attribute("versionQIF").unwrap_or("?");
    let mut draft = Draft {
        name: part_name(&reader).unwrap_or_else(|| base.to_owned()),
        source: format!("{base} (QIF {})", document::shown(version)),
        features: std::mem::take(&mut collected.features),
        characteristics: std::mem::take(&mut collected.characteristics),
        left_out: std::mem::take(&mut collected.left_out),
    };
    trial::judge(&mut draft);
    collected.unused(&mut draft, problems);
    report(&draft, file, problems);
    Some(draft)
}

/// The name of the only part of the product.
fn part_name(reader: &Reader<'_, '_>) -> Option<String> {
    let mut parts = reader.ending("Part").filter(|n| document::name(*n) == "Part");
    let part = parts.next().filter(|_| parts.next().is_none())?;
    let name = text_of(part, "Name").or_else(|| text_of(part, "ModelNumber"));
    let name = name.or_else(|| part.attribute("label").map(str::to_owned));
    name.map(|n| document::shown(n.trim())).filter(|n| !n.is_empty())
}

fn report(draft: &Draft, file: &str, problems: &mut Diagnostics) {
    let place = Place::whole(file);
    if draft.characteristics.is_empty() {
        let message = "no characteristic of the file can be evaluated".to_owned();
        let hint = "the end of the draft names each of them with its reason";
        problems.warn("nothing-drafted", place.clone(), message, hint);
    }
    if !draft.left_out.is_empty() {
        let message = format!(
            "{} features and {} characteristics are drafted, {} of the file are left out",
            draft.features.len(),
            draft.characteristics.len(),
            draft.left_out.len()
        );
        let hint = "the end of the draft names each of them with its reason";
        problems.note("left-out", place, message, hint);
    }
}
