//! Results as QIF 3.0 (ISO 23952:2020): what a part asks, and the values that a virtual cut and a virtual measurement predict.
//!
//! ```text
//! Part, Found of each characteristic ──results──> QIFDocument
//!                                     │  units, datums, frames, features, characteristics   (what is asked)
//!                                     └  MeasurementResults: Value, combinedUncertainty, Status   (what is found)
//!                                    ──results_csv──> one row for each characteristic
//! ```
//!
//! The document says in its header and in its results that nothing was measured. It depends on its arguments only: the same part and
//! the same values give the same text. Ids depend on the part alone.
//!
//! # Source
//! ISO 23952:2020, QIF 3.0.0.

mod characteristics;
mod csv;
mod datums;
mod features;
mod ids;
mod xml;

use crate::Error;
use crate::part::Part;
use crate::tolerance::Outcome;
use ids::Ids;
use xml::Xml;

pub use csv::results_csv;

/// Values beyond this are refused, as in the evaluation. Unit: mm.
const LARGEST_MM: f64 = 1e100;

/// A characteristic with what was found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Found {
    /// Its value as [`Part::evaluate`] gives it: the width or diameter of a zone; of a size the deviation from the nominal one.
    pub value_mm: f64,
    /// The standard uncertainty of the value.
    pub u_mm: f64,
    /// The verdict.
    pub outcome: Outcome,
}

/// A QIF document of a part with what was found of each characteristic, in their order; `made_by` names the program and its version.
///
/// # Errors
/// Another number of values than of characteristics; a value or a standard uncertainty that is not finite, an uncertainty that is
/// negative, or limits of which no share can be used: nothing of this could be written.
///
/// # Example
/// ```
/// use std::path::Path;
/// use trueaxis_input::SourceText;
/// use trueaxis_part::part::Part;
/// use trueaxis_part::qif::results::{Found, results};
/// use trueaxis_part::tolerance::Outcome;
///
/// let text = include_str!("../../../../parts/housing.toml");
/// let source = SourceText::new("housing.toml", text);
/// let part = source.read(|root| Part::read(root, Path::new(""))).expect("the shipped part is good");
/// let found = Found { value_mm: 0.0042, u_mm: 0.0006, outcome: Outcome::Pass };
/// let document = results(&part, &vec![found; part.characteristics.len()], "a program 1.0")?;
/// assert!(document.contains("<Value combinedUncertainty=\"0.0006\" meanError=\"0\">0.0042</Value>"));
/// # Ok::<(), trueaxis_part::Error>(())
/// ```
pub fn results(part: &Part, found: &[Found], made_by: &str) -> Result<String, Error> {
    check(part, found)?;
    let mut body = Xml::new();
    let ids = Ids::of(part);
    header(&mut body, part, made_by);
    standard(&mut body, &ids);
    software(&mut body, &ids, made_by);
    units(&mut body);
    datums::definitions(&mut body, part, &ids);
    datums::frames(&mut body, part, &ids);
    product(&mut body, part, &ids);
    features::write(&mut body, part, &ids);
    characteristics::write(&mut body, part, &ids);
    measured(&mut body, part, found, &ids);
    let body = body.text;
    let (id, last) = (persistent_id(&body), ids.last());
    Ok(format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n\
         <QIFDocument xmlns=\"http://qifstandards.org/xsd/qif3\" versionQIF=\"3.0.0\" idMax=\"{last}\">\n  \
         <QPId>{id}</QPId>\n{body}</QIFDocument>\n"
    ))
}

/// Whether each characteristic has a value that can be written.
fn check(part: &Part, found: &[Found]) -> Result<(), Error> {
    let (count, expected) = (found.len(), part.characteristics.len());
    if count != expected {
        return Err(Error::WrongLength { what: "found values", found: count, expected });
    }
    let is_good = |(asked, found): (&crate::part::Characteristic, &Found)| {
        found.value_mm.abs() <= LARGEST_MM
            && (0.0..=LARGEST_MM).contains(&found.u_mm)
            && asked.limits.used(found.value_mm).is_finite()
    };
    match part.characteristics.iter().zip(found).position(|pair| !is_good(pair)) {
        Some(index) => Err(Error::NotFinite { index }),
        None => Ok(()),
    }
}

fn header(xml: &mut Xml, part: &Part, made_by: &str) {
    let source = match part.source.is_empty() {
        true => String::new(),
        false => format!(" Dimensions of the part: {}.", part.source),
    };
    let description = format!(
        "Predicted, not measured: the values are those of a virtual cut and a virtual measurement by {made_by}. \
         combinedUncertainty is the combined standard uncertainty, k = 1; no mean error is known. \
         Coordinates are those of the workpiece frame of the NC program.{source}"
    );
    xml.open("Header", &[]);
    xml.open("Application", &[]);
    xml.leaf("Name", &[], made_by);
    xml.close();
    xml.leaf("Description", &[], &description);
    xml.leaf("Scope", &[], "Results");
    xml.close();
}

/// The standard by which characteristics are meant.
fn standard(xml: &mut Xml, ids: &Ids<'_>) {
    xml.open("StandardsDefinitions", &[("n", "1")]);
    xml.open("Standard", &[("id", &ids.standard().to_string())]);
    xml.open("Organization", &[]);
    xml.leaf("StandardsOrganizationEnum", &[], "ISO");
    xml.close();
    xml.leaf("Designator", &[], "1101");
    xml.close();
    xml.close();
}

/// The program to which the results refer as the one that found them.
fn software(xml: &mut Xml, ids: &Ids<'_>, made_by: &str) {
    xml.open("SoftwareDefinitions", &[("n", "1")]);
    xml.open("Software", &[("id", &ids.software().to_string())]);
    xml.leaf("VendorName", &[], "TrueAxis");
    xml.leaf("ApplicationName", &[], made_by);
    xml.close();
    xml.close();
}

fn units(xml: &mut Xml) {
    xml.open("FileUnits", &[]);
    xml.open("PrimaryUnits", &[]);
    xml.open("AngularUnit", &[]);
    xml.leaf("SIUnitName", &[], "radian");
    xml.leaf("UnitName", &[], "rad");
    xml.close();
    xml.open("LinearUnit", &[]);
    xml.leaf("SIUnitName", &[], "meter");
    xml.leaf("UnitName", &[], "mm");
    xml.open("UnitConversion", &[]);
    xml.leaf("Factor", &[], "0.001");
    xml.close();
    xml.close();
    xml.close();
    xml.close();
}

/// The name of the part; its model is not in the document.
fn product(xml: &mut Xml, part: &Part, ids: &Ids<'_>) {
    xml.open("Product", &[]);
    xml.open("PartSet", &[("n", "1")]);
    xml.leaf("Part", &[("label", &part.name), ("id", &ids.part().to_string())], "");
    xml.close();
    xml.close();
}

fn measured(xml: &mut Xml, part: &Part, found: &[Found], ids: &Ids<'_>) {
    xml.open("Results", &[]);
    xml.open("MeasurementResultsSet", &[("n", "1")]);
    xml.open("MeasurementResults", &[("id", &ids.results().to_string())]);
    xml.open("InspectionTraceability", &[]);
    xml.open("InspectionSoftwareItems", &[]);
    xml.ids("AnalysisSoftware", &[ids.software()]);
    xml.close();
    xml.leaf("ReportType", &[], "prediction, not a measurement");
    xml.close();
    xml.open("MeasuredCharacteristics", &[]);
    characteristics::measurements(xml, part, found, ids);
    xml.close();
    xml.open("InspectionStatus", &[]);
    xml.leaf("InspectionStatusEnum", &[], status_of_all(found));
    xml.close();
    xml.close();
    xml.close();
    xml.close();
}

/// A part fails with one characteristic, and passes with all of them.
fn status_of_all(found: &[Found]) -> &'static str {
    if found.iter().any(|f| f.outcome == Outcome::Fail) {
        return "FAIL";
    }
    match found.iter().all(|f| f.outcome == Outcome::Pass) {
        true => "PASS",
        false => "UNKNOWN",
    }
}

/// A UUID of version 8 (RFC 9562) by the content, as the same document must not get another one: FNV-1a with 128 bits.
fn persistent_id(text: &str) -> String {
    let mut bits = fnv_1a(text.as_bytes());
    bits = bits & !(0xf << 76) | 0x8 << 76;
    bits = bits & !(0x3 << 62) | 0x2 << 62;
    let hex = format!("{bits:032x}");
    let groups = [0..8, 8..12, 12..16, 16..20, 20..32].map(|group| &hex[group]);
    groups.join("-")
}

/// # Source
/// Fowler, Noll and Vo, FNV-1a of 128 bits.
fn fnv_1a(bytes: &[u8]) -> u128 {
    let (basis, prime) = (0x6c62_272e_07bb_0142_62b8_2175_6295_c58d, (1 << 88) + 0x13b);
    bytes.iter().fold(basis, |hash: u128, byte| (hash ^ u128::from(*byte)).wrapping_mul(prime))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The value that its authors publish for one letter; version and variant of the UUID at their places.
    #[test]
    fn an_id_of_the_content() {
        assert_eq!(fnv_1a(b"a"), 0xd228_cb69_6f1a_8caf_7891_2b70_4e4a_8964);
        assert_eq!(persistent_id("a"), "d228cb69-6f1a-8caf-b891-2b704e4a8964");
        assert_ne!(persistent_id("a"), persistent_id("b"));
    }
}
