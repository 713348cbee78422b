//! Datums and the frames that they make.

use super::ids::{Ids, Of};
use super::xml::Xml;
use crate::part::Part;

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
        for (feature, precedence) in frame.iter().zip(PRECEDENCE) {
            xml.open("Datum", &[]);
            xml.open("SimpleDatum", &[]);
            xml.id("DatumDefinitionId", ids.datum(*feature));
            xml.leaf("MaterialModifier", &[], "NONE");
            xml.leaf("ReferencedComponent", &[], "ACTUAL");
            xml.close();
            xml.open("Precedence", &[]);
            xml.leaf("PrecedenceEnum", &[], precedence);
            xml.close();
            xml.close();
        }
        xml.close();
        let labels: Vec<&str> = frame.iter().map(|f| part.features[*f].label()).collect();
        xml.leaf("Name", &[], &labels.join("|"));
        xml.close();
    }
    xml.close();
}
