//! The nodes of a QIF document, their places and their references.

use roxmltree::{Document, Node, ParsingOptions};
use std::cell::Cell;
use std::collections::BTreeMap;
use std::collections::btree_map::Entry;
use trueaxis_geometry::Vec3;
use trueaxis_input::{Diagnostics, Place};

/// A tree of more nodes than this is no drawing.
const MOST_NODES: u32 = 20_000_000;

/// Edges and points of all features together.
const MOST_POINTS: usize = 5_000_000;

/// Why something is left out.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Reason {
    pub text: String,
    /// Where the file contradicts itself or the schema: the code of the problem and the byte where it is.
    pub fault: Option<(&'static str, usize)>,
}

impl Reason {
    /// What the file asks soundly, and a part file cannot say.
    pub fn plain(text: impl Into<String>) -> Self {
        Self { text: text.into(), fault: None }
    }

    pub fn fault(code: &'static str, node: Node<'_, '_>, text: impl Into<String>) -> Self {
        Self { text: text.into(), fault: Some((code, node.range().start)) }
    }
}

/// A document with its nodes by their ids.
pub(super) struct Reader<'d, 't> {
    pub file: &'d str,
    pub document: &'d Document<'t>,
    ids: BTreeMap<&'d str, Node<'d, 't>>,
    line_starts: Vec<usize>,
    /// How many edges and points of faces may still be read.
    budget: Cell<usize>,
}

/// The XML tree of a text.
pub(super) fn parse<'t>(
    file: &str,
    text: &'t str,
    problems: &mut Diagnostics,
) -> Option<Document<'t>> {
    let options = ParsingOptions { nodes_limit: MOST_NODES, ..ParsingOptions::default() };
    match Document::parse_with_options(text, options) {
        Ok(document) => Some(document),
        Err(e) => {
            let at = e.pos();
            let place =
                Place { file: file.to_owned(), line: at.row as usize, column: at.col as usize };
            problems.error("bad-xml", place, e.to_string(), "a QIF file is XML as UTF-8");
            None
        }
    }
}

impl<'d, 't> Reader<'d, 't> {
    pub fn new(
        document: &'d Document<'t>,
        file: &'d str,
        problems: &mut Diagnostics,
    ) -> Option<Self> {
        let text = document.input_text();
        let line_starts =
            std::iter::once(0).chain(text.match_indices('\n').map(|(i, _)| i + 1)).collect();
        let budget = Cell::new(MOST_POINTS);
        let mut reader = Self { file, document, ids: BTreeMap::new(), line_starts, budget };
        let root = document.root_element();
        if root.tag_name().name() != "QIFDocument" {
            let message = format!("`{}` is no QIF document", root.tag_name().name());
            problems.error("not-qif", reader.place(root), message, "it begins with <QIFDocument>");
            return None;
        }
        for node in document.descendants() {
            let Some(id) = node.attribute("id") else { continue };
            let id = id.trim();
            if let Entry::Vacant(entry) = reader.ids.entry(id) {
                entry.insert(node);
                continue;
            }
            let message = format!("the id {id} is given twice");
            let hint = "each id of a QIF document names one element; export the file again";
            problems.error("duplicate-id", reader.place(node), message, hint);
            return None;
        }
        Some(reader)
    }

    /// Counts edges or points of faces that are read for features; a face may be named again and again.
    pub fn spend(&self, node: Node<'_, '_>, count: usize) -> Result<(), Reason> {
        match self.budget.get().checked_sub(count) {
            Some(rest) => {
                self.budget.set(rest);
                Ok(())
            }
            None => {
                let message = format!("the features have more than {MOST_POINTS} edges and points");
                Err(Reason::fault("too-large", node, message))
            }
        }
    }

    pub fn place(&self, node: Node<'_, '_>) -> Place {
        self.place_at(node.range().start)
    }

    /// The place of a byte; one pass over its line only.
    pub fn place_at(&self, offset: usize) -> Place {
        let line = self.line_starts.partition_point(|start| *start <= offset);
        let start = self.line_starts[line.saturating_sub(1)];
        let before = self.document.input_text().get(start..offset).unwrap_or_default();
        Place { file: self.file.to_owned(), line, column: before.chars().count() + 1 }
    }

    /// All elements whose name ends so, in the order of the file.
    pub fn ending<'a>(&'a self, ending: &'a str) -> impl Iterator<Item = Node<'d, 't>> + 'a {
        let is_meant = move |n: &Node<'_, '_>| n.is_element() && name(*n).ends_with(ending);
        self.document.descendants().filter(is_meant)
    }

    /// What the content of an element refers to: an element whose name ends so.
    pub fn target(&self, reference: Node<'d, 't>, ending: &str) -> Result<Node<'d, 't>, Reason> {
        let fault = |text: String| Err(Reason::fault("bad-reference", reference, text));
        let id = content(reference);
        let id = id.trim();
        let is_elsewhere = |a: &str| a.starts_with("asmPath") || a == "xId";
        if reference.attributes().any(|a| is_elsewhere(a.name())) {
            return fault(format!("id {id} lies in another document or assembly"));
        }
        match self.ids.get(id) {
            None => fault(format!("the file has no element with the id `{}`", shown(id))),
            Some(found) if !name(*found).ends_with(ending) => {
                fault(format!("id {id} is a {}, expected a {ending}", name(*found)))
            }
            Some(found) => Ok(*found),
        }
    }

    /// What a child refers to, directly or by an `Id` in it; none without that child.
    pub fn follow(
        &self,
        node: Node<'d, 't>,
        key: &str,
        ending: &str,
    ) -> Result<Option<Node<'d, 't>>, Reason> {
        let Some(reference) = child(node, key) else { return Ok(None) };
        self.target(child(reference, "Id").unwrap_or(reference), ending).map(Some)
    }

    /// As [`Reader::follow`], of a child that must be there.
    pub fn needed(
        &self,
        node: Node<'d, 't>,
        key: &str,
        ending: &str,
    ) -> Result<Node<'d, 't>, Reason> {
        let missing = || Reason::fault("bad-reference", node, format!("it has no {key}"));
        self.follow(node, key, ending)?.ok_or_else(missing)
    }
}

/// The name of an element without its namespace.
pub(super) fn name<'d>(node: Node<'d, '_>) -> &'d str {
    node.tag_name().name()
}

pub(super) fn child<'d, 't>(node: Node<'d, 't>, key: &str) -> Option<Node<'d, 't>> {
    node.children().find(|n| n.is_element() && name(*n) == key)
}

/// The elements in an element.
pub(super) fn elements<'d, 't>(node: Node<'d, 't>) -> impl Iterator<Item = Node<'d, 't>> {
    node.children().filter(Node::is_element)
}

/// The references in a list such as `FeatureNominalIds`.
pub(super) fn listed<'d, 't>(node: Node<'d, 't>, key: &str) -> Vec<Node<'d, 't>> {
    let lists = node.children().filter(|n| n.is_element() && name(*n) == key);
    lists.flat_map(elements).filter(|n| name(*n) == "Id").collect()
}

/// The text of an element, in one piece where comments divide it.
pub(super) fn content(node: Node<'_, '_>) -> String {
    node.children().filter(Node::is_text).filter_map(|n| n.text()).collect()
}

/// The text of a child, its words with one space between them as in a token of XML; none if it is empty.
pub(super) fn text_of(node: Node<'_, '_>, key: &str) -> Option<String> {
    let text = content(child(node, key)?);
    let words: Vec<&str> = text.split_whitespace().collect();
    (!words.is_empty()).then(|| words.join(" "))
}

/// Whether an attribute is set.
pub(super) fn is_set(node: Node<'_, '_>, attribute: &str) -> bool {
    matches!(node.attribute(attribute).map(str::trim), Some("1" | "true"))
}

/// Finite numbers of a text.
pub(super) fn numbers(node: Node<'_, '_>) -> Result<Vec<f64>, Reason> {
    let text = content(node);
    let one = |word: &str| {
        let wrong = || {
            let message = format!("`{}` in {} is not a finite number", shown(word), name(node));
            Reason::fault("not-a-number", node, message)
        };
        word.parse::<f64>().ok().filter(|v| v.is_finite()).ok_or_else(wrong)
    };
    text.split_whitespace().map(one).collect()
}

/// As many numbers as expected.
pub(super) fn fixed<const N: usize>(node: Node<'_, '_>) -> Result<[f64; N], Reason> {
    let found = numbers(node)?;
    <[f64; N]>::try_from(found).map_err(|found| {
        let message = format!("{} has {} numbers, expected {N}", name(node), found.len());
        Reason::fault("not-a-number", node, message)
    })
}

/// A direction in a child.
pub(super) fn direction(node: Node<'_, '_>, key: &str) -> Result<Vec3, Reason> {
    let missing = || Reason::fault("missing-value", node, format!("it has no {key}"));
    let found = child(node, key).ok_or_else(missing)?;
    let vector = Vec3::from(fixed::<3>(found)?);
    vector
        .try_normalize(1e-9)
        .ok_or_else(|| Reason::fault("bad-direction", found, format!("{key} has the length zero")))
}

/// The beginning of a text from the file, on one line.
pub(super) fn shown(text: &str) -> String {
    let clean = |c: char| if c.is_control() { ' ' } else { c };
    let short: String = text.chars().take(60).map(clean).collect();
    if text.chars().nth(60).is_some() { short + "…" } else { short }
}

/// `OppositeParallelPlanes` as `opposite parallel planes`.
pub(super) fn in_words(stem: &str) -> String {
    let mut words = String::new();
    for letter in stem.chars() {
        if letter.is_uppercase() && !words.is_empty() {
            words.push(' ');
        }
        words.extend(letter.to_lowercase());
    }
    shown(&words)
}
