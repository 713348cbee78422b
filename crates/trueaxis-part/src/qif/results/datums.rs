//! Datums and the frames that they make.

use super::ids::{Ids, Of};
use super::xml::Xml;
use crate::part::{Datum, Part};

const PRECEDENCE: [&str; 3] = ["PRIMARY", "SECONDARY", "TERTIARY"];

pub(super) fn definitions(xml: &mut Xml, part: &Part, ids: &Ids<'_>) {
    if ids.datums.is_empty() {
        return;
    }
    xml.open("DatumDefinitions", &[("n", &ids.datums.len().to_string())]);
    for (feature, label) in &ids.datums {
        xml.open("DatumDefinition", &[("id", &ids.datum(*feature).to_string())]);
        // A label of QIF is a token of letters, digits and few signs.
        let own = part.features[*feature].label();
        if own != label {
            xml.attribute("label", own);
        }
        xml.leaf("DatumLabel", &[], label);
        xml.ids("FeatureNominalIds", &[ids.feature(*feature, Of::Nominal)]);
        xml.close();
    }
    xml.close();
}

pub(super) fn frames(xml: &mut Xml, part: &Part, ids: &Ids<'_>) {
    if ids.frames.is_empty() {
        return;
    }
    xml.open("DatumReferenceFrames", &[("n", &ids.frames.len().to_string())]);
    for (rank, frame) in ids.frames.iter().enumerate() {
        xml.open("DatumReferenceFrame", &[("id", &ids.frame(rank).to_string())]);
        xml.open("Datums", &[("n", &frame.len().to_string())]);
        for (datum, precedence) in frame.iter().zip(PRECEDENCE) {
            xml.open("Datum", &[]);
            match datum.single() {
                Some(feature) => simple(xml, ids.datum(feature)),
                None => compound(xml, datum, ids),
            }
            xml.open("Precedence", &[]);
            xml.leaf("PrecedenceEnum", &[], precedence);
            xml.close();
            xml.close();
        }
        xml.close();
        let labels: Vec<String> = frame.iter().map(|d| d.label(&part.features)).collect();
        xml.leaf("Name", &[], &labels.join("|"));
        xml.close();
    }
    xml.close();
}

fn simple(xml: &mut Xml, definition: usize) {
    xml.open("SimpleDatum", &[]);
    xml.id("DatumDefinitionId", definition);
    xml.leaf("MaterialModifier", &[], "NONE");
    xml.leaf("ReferencedComponent", &[], "ACTUAL");
    xml.close();
}

/// A common datum.
fn compound(xml: &mut Xml, datum: &Datum, ids: &Ids<'_>) {
    xml.open("CompoundDatum", &[("n", &datum.features.len().to_string())]);
    for (rank, feature) in datum.features.iter().enumerate() {
        xml.open("Datum", &[]);
        simple(xml, ids.datum(*feature));
        xml.leaf("SequenceNumber", &[], &(rank + 1).to_string());
        xml.close();
    }
    xml.close();
}
