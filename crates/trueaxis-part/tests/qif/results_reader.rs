//! A small reader of results in QIF, for tests.

use roxmltree::{Document, Node};
use std::collections::BTreeMap;

/// A document with its elements by their ids.
struct Reader<'d> {
    root: Node<'d, 'd>,
    ids: BTreeMap<usize, Node<'d, 'd>>,
}

fn child<'d>(node: Node<'d, 'd>, path: &str) -> Option<Node<'d, 'd>> {
    path.split('/').try_fold(node, |n, key| n.children().find(|c| c.has_tag_name(key_of(key))))
}

pub fn key_of(key: &str) -> (&'static str, &str) {
    ("http://qifstandards.org/xsd/qif3", key)
}

fn text<'d>(node: Node<'d, 'd>, path: &str) -> &'d str {
    child(node, path).and_then(|n| n.text()).unwrap_or_else(|| panic!("no {path}"))
}

fn number(node: Node<'_, '_>, key: &str) -> f64 {
    let found = node.children().find(|c| c.has_tag_name(key_of(key)));
    found.and_then(|n| n.text()).and_then(|t| t.parse().ok()).unwrap_or(f64::NAN)
}

impl<'d> Reader<'d> {
    fn of(document: &'d Document<'d>) -> Self {
        let mut ids = BTreeMap::new();
        for node in document.descendants() {
            if let Some(id) = node.attribute("id") {
                assert!(ids.insert(id.parse().unwrap(), node).is_none(), "{id} is given twice");
            }
        }
        let root = document.root_element();
        let most: usize = root.attribute("idMax").unwrap().parse().unwrap();
        assert_eq!((ids.len(), *ids.keys().last().unwrap()), (most, most), "ids have no gaps");
        for node in document.descendants().filter(|n| n.has_attribute("n")) {
            let count = node.children().filter(Node::is_element).count();
            assert_eq!(node.attribute("n"), Some(&count.to_string()[..]), "{node:?}");
        }
        Self { root, ids }
    }

    fn follow(&self, node: Node<'d, 'd>, path: &str) -> Node<'d, 'd> {
        self.ids[&text(node, path).parse().unwrap()]
    }

    fn list(&self, node: Node<'d, 'd>, path: &str) -> Vec<Node<'d, 'd>> {
        let of = |n: Node<'d, 'd>| self.ids[&n.text().unwrap().parse().unwrap()];
        child(node, path).unwrap().children().filter(Node::is_element).map(of).collect()
    }

    /// What the document says of each characteristic.
    fn lines(&self) -> Vec<Line> {
        let results = "Results/MeasurementResultsSet/MeasurementResults";
        let set = "MeasuredCharacteristics/CharacteristicMeasurements";
        let all = child(self.root, results).and_then(|n| child(n, set)).unwrap();
        all.children().filter(Node::is_element).map(|n| self.line(n)).collect()
    }

    fn line(&self, measurement: Node<'d, 'd>) -> Line {
        let item = self.follow(measurement, "CharacteristicItemId");
        let nominal = self.follow(item, "CharacteristicNominalId");
        let definition = self.follow(nominal, "CharacteristicDefinitionId");
        let stem = |n: Node<'d, 'd>, end: &str| {
            n.tag_name().name().strip_suffix(&format!("Characteristic{end}")).unwrap().to_owned()
        };
        let kind = stem(measurement, "Measurement");
        assert_eq!(kind, stem(item, "Item"));
        assert_eq!(kind, stem(nominal, "Nominal"));
        assert_eq!(kind, stem(definition, "Definition"));
        let of_items: Vec<_> = self.list(item, "FeatureItemIds");
        let nominals: Vec<_> =
            of_items.iter().map(|n| self.follow(*n, "FeatureNominalId").id()).collect();
        let listed: Vec<_> = self.list(nominal, "FeatureNominalIds").iter().map(Node::id).collect();
        assert_eq!(listed, nominals);
        let datums = match child(definition, "DatumReferenceFrameId") {
            None => Vec::new(),
            Some(_) => self.datums(self.follow(definition, "DatumReferenceFrameId")),
        };
        let limits_mm = match child(definition, "Tolerance") {
            None => vec![number(definition, "ToleranceValue")],
            Some(limits) => {
                assert_eq!(text(limits, "DefinedAsLimit"), "false");
                vec![number(limits, "MinValue"), number(limits, "MaxValue")]
            }
        };
        let value = child(measurement, "Value").unwrap();
        let nominal_mm =
            child(nominal, "TargetValue").map(|n| number(n.parent().unwrap(), "TargetValue"));
        Line {
            name: text(item, "Name").to_owned(),
            kind,
            features: of_items.iter().map(|n| text(*n, "FeatureName").to_owned()).collect(),
            datums,
            nominal_mm,
            limits_mm,
            value_mm: value.text().unwrap().parse().unwrap(),
            u_mm: value.attribute("combinedUncertainty").unwrap().parse().unwrap(),
            status: text(measurement, "Status/CharacteristicStatusEnum").to_owned(),
        }
    }

    /// Names of the features that are the datums of a frame, in their precedence; of a common datum with dashes between.
    fn datums(&self, frame: Node<'d, 'd>) -> Vec<String> {
        let datums = child(frame, "Datums").unwrap().children().filter(Node::is_element);
        let one = |(rank, datum): (usize, Node<'d, 'd>)| {
            let due = ["PRIMARY", "SECONDARY", "TERTIARY"][rank];
            assert_eq!(text(datum, "Precedence/PrecedenceEnum"), due);
            let Some(compound) = child(datum, "CompoundDatum") else { return self.datum(datum) };
            let members: Vec<Node<'_, '_>> = compound.children().filter(Node::is_element).collect();
            assert_eq!(compound.attribute("n"), Some(members.len().to_string().as_str()));
            for (number, member) in members.iter().enumerate() {
                assert_eq!(text(*member, "SequenceNumber"), (number + 1).to_string());
            }
            let names: Vec<String> = members.iter().map(|m| self.datum(*m)).collect();
            names.join("-")
        };
        datums.enumerate().map(one).collect()
    }

    fn datum(&self, datum: Node<'d, 'd>) -> String {
        let definition = self.follow(datum, "SimpleDatum/DatumDefinitionId");
        let features = self.list(definition, "FeatureNominalIds");
        assert_eq!(features.len(), 1);
        text(features[0], "Name").to_owned()
    }
}

/// What a document says of one characteristic.
#[derive(Debug, Clone, PartialEq)]
pub struct Line {
    pub name: String,
    pub kind: String,
    pub features: Vec<String>,
    pub datums: Vec<String>,
    pub nominal_mm: Option<f64>,
    pub limits_mm: Vec<f64>,
    pub value_mm: f64,
    pub u_mm: f64,
    pub status: String,
}

/// What a document says of each characteristic.
pub fn lines(document: &str) -> Vec<Line> {
    let document = Document::parse(document).unwrap();
    Reader::of(&document).lines()
}
