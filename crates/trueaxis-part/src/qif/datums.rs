//! Datum definitions and datum reference frames.

use super::document::{
    Reader, Reason, child, content, elements, in_words, listed, name, shown, text_of,
};
use roxmltree::Node;

/// What a datum reference frame may contain without changing what the datums mean.
const FRAME: [&str; 5] = ["Attributes", "Datums", "Name", "Description", "CoordinateSystemId"];
/// The same of a datum in it.
const DATUM: [&str; 5] = [
    "Attributes",
    "DatumDefinitionId",
    "MaterialModifier",
    "ReferencedComponent",
    "SizeCharacteristicDefinitionId",
];
/// The same of its definition.
const DEFINITION: [&str; 4] = ["Attributes", "DatumLabel", "FeatureNominalIds", "Description"];

/// A datum of a frame: its letter and the references to its features.
pub(super) struct Datum<'d, 't> {
    pub letter: String,
    pub features: Vec<Node<'d, 't>>,
}

/// All letters of a file.
pub(super) fn letters(reader: &Reader<'_, '_>) -> Vec<String> {
    reader.ending("DatumDefinition").filter_map(|n| text_of(n, "DatumLabel")).collect()
}

/// The datums of a frame in their order of precedence, of a common datum each of its members; none where the definition of a characteristic names no frame.
pub(super) fn frame<'d, 't>(
    reader: &Reader<'d, 't>,
    definition: Node<'d, 't>,
) -> Result<Vec<Vec<Datum<'d, 't>>>, Reason> {
    let key = "DatumReferenceFrameId";
    let Some(frame) = reader.follow(definition, key, "DatumReferenceFrame")? else {
        return Ok(Vec::new());
    };
    only(frame, &FRAME, "the datum reference frame")?;
    let mut ranked = Vec::new();
    for datum in child(frame, "Datums").into_iter().flat_map(elements) {
        let rank = rank(datum)?;
        ranked.push((rank, members(reader, datum)?));
        if ranked.len() > 3 {
            return Err(Reason::plain("a datum reference frame of more than three datums"));
        }
    }
    ranked.sort_by_key(|(rank, _)| *rank);
    for (due, (rank, members)) in ranked.iter().enumerate() {
        if *rank != due {
            let letters: Vec<&str> = members.iter().map(|d| d.letter.as_str()).collect();
            let letter = letters.join("-");
            let message = format!("the precedence of datum {letter} leaves no order");
            return Err(Reason::fault("bad-datum", frame, message));
        }
    }
    Ok(ranked.into_iter().map(|(_, datum)| datum).collect())
}

/// A simple datum, or those of a compound one in their sequence.
fn members<'d, 't>(
    reader: &Reader<'d, 't>,
    datum: Node<'d, 't>,
) -> Result<Vec<Datum<'d, 't>>, Reason> {
    if let Some(simple) = child(datum, "SimpleDatum") {
        return Ok(vec![simple_datum(reader, simple)?]);
    }
    let Some(compound) = child(datum, "CompoundDatum") else {
        let is_order = |n: &&str| matches!(*n, "Precedence" | "SequenceNumber");
        let kind = elements(datum).map(name).find(|n| !is_order(n)).unwrap_or("Datum");
        return Err(Reason::plain(format!("a {} is not evaluated", in_words(kind))));
    };
    only(compound, &["Datum"], "the compound datum")?;
    let mut all = Vec::new();
    for member in elements(compound) {
        if child(member, "SimpleDatum").is_none() {
            return Err(Reason::plain("a compound datum in a compound datum is not evaluated"));
        }
        all.extend(members(reader, member)?);
    }
    Ok(all)
}

fn rank(datum: Node<'_, '_>) -> Result<usize, Reason> {
    let precedence = child(datum, "Precedence").and_then(|p| text_of(p, "PrecedenceEnum"));
    match precedence.as_deref() {
        Some("PRIMARY") => Ok(0),
        Some("SECONDARY") => Ok(1),
        Some("TERTIARY") => Ok(2),
        _ => Err(Reason::plain("a datum is neither primary, secondary nor tertiary")),
    }
}

fn simple_datum<'d, 't>(
    reader: &Reader<'d, 't>,
    simple: Node<'d, 't>,
) -> Result<Datum<'d, 't>, Reason> {
    only(simple, &DATUM, "the datum")?;
    let definition = reader.needed(simple, "DatumDefinitionId", "DatumDefinition")?;
    let letter = text_of(definition, "DatumLabel").unwrap_or_default();
    if let Some(text) = material(simple, "MaterialModifier") {
        return Err(Reason::plain(format!("datum {} at {text}", shown(&letter))));
    }
    only(definition, &DEFINITION, &format!("datum {}", shown(&letter)))?;
    let features = listed(definition, "FeatureNominalIds");
    if features.is_empty() {
        let message = format!("datum {} names no feature", shown(&letter));
        return Err(Reason::fault("bad-datum", definition, message));
    }
    Ok(Datum { letter, features })
}

/// A material condition that changes a zone.
pub(super) fn material(node: Node<'_, '_>, key: &str) -> Option<String> {
    match text_of(node, key).as_deref() {
        None | Some("NONE" | "REGARDLESS") => None,
        Some("MAXIMUM") => Some("maximum material condition".to_owned()),
        Some("LEAST") => Some("least material condition".to_owned()),
        Some(other) => Some(format!("material condition {}", shown(other))),
    }
}

/// Refuses what an element has beyond what is understood, unless it is a flag that is not set.
pub(super) fn only(node: Node<'_, '_>, known: &[&str], what: &str) -> Result<(), Reason> {
    for element in elements(node).filter(|n| !known.contains(&name(*n))) {
        let text = content(element);
        if elements(element).next().is_none() && matches!(text.trim(), "false" | "0") {
            continue;
        }
        let words = in_words(name(element));
        return Err(Reason::plain(format!("{what} has {words}, which is not evaluated")));
    }
    Ok(())
}
