//! Features and characteristics as they are found, and the list of all others.

use super::characteristics::{self, Demand, Items};
use super::document::{Reader, Reason, in_words, shown, text_of};
use super::features::{self, Form};
use super::units::Units;
use super::{Asked, Draft, Drafted, LeftOut, datums, text};
use crate::part;
use roxmltree::Node;
use std::collections::{BTreeMap, BTreeSet};
use trueaxis_input::{Diagnostics, Place};

/// No drawing asks more than this.
const MOST_CHARACTERISTICS: usize = 5_000;

/// Everything of a file that was read so far.
pub(super) struct Collected<'r, 'd, 't> {
    reader: &'r Reader<'d, 't>,
    units: &'r Units,
    items: Items<'d, 't>,
    /// Names of features that a plan gives.
    names: BTreeMap<String, String>,
    taken: BTreeSet<String>,
    letters: BTreeSet<String>,
    by_id: BTreeMap<String, Result<usize, Reason>>,
    pub features: Vec<Drafted>,
    pub characteristics: Vec<Asked>,
    pub left_out: Vec<LeftOut>,
}

impl<'r, 'd, 't> Collected<'r, 'd, 't> {
    pub fn new(reader: &'r Reader<'d, 't>, units: &'r Units) -> Self {
        let named = reader
            .ending("FeatureItem")
            .filter_map(|n| Some((text_of(n, "FeatureNominalId")?, text_of(n, "FeatureName")?)));
        Self {
            reader,
            units,
            items: Items::of(reader),
            names: named.collect(),
            // A name that is the letter of a datum would mean two features.
            taken: datums::letters(reader).into_iter().collect(),
            letters: BTreeSet::new(),
            by_id: BTreeMap::new(),
            features: Vec::new(),
            characteristics: Vec::new(),
            left_out: Vec::new(),
        }
    }

    /// One characteristic, of each of its features; false where there are too many.
    pub fn characteristic(&mut self, nominal: Node<'d, 't>, problems: &mut Diagnostics) -> bool {
        if let Err(reason) = self.read(nominal, problems) {
            self.leave_out(nominal, &reason, None, problems);
        }
        let count = self.characteristics.len() + self.left_out.len();
        if count > MOST_CHARACTERISTICS {
            let message = format!("the file asks more than {MOST_CHARACTERISTICS} characteristics");
            let hint = "does a group of features name others again and again?";
            problems.error("too-large", self.reader.place(nominal), message, hint);
        }
        count <= MOST_CHARACTERISTICS
    }

    fn read(&mut self, nominal: Node<'d, 't>, problems: &mut Diagnostics) -> Result<(), Reason> {
        let definition = characteristics::definition(self.reader, nominal)?;
        let demand = characteristics::read(self.units, nominal, definition)?;
        let mut of = Vec::new();
        for reference in self.items.features(self.reader, nominal)? {
            features::extend(&mut of, self.reader, reference)?;
        }
        if of.is_empty() {
            return Err(Reason::plain("it names no feature"));
        }
        let datums = self.datums(definition)?;
        let name = self.items.name(nominal);
        let is_one = of.len() == 1;
        for (number, (node, group)) in of.into_iter().enumerate() {
            let asked = self
                .of_feature(node, group.map(|g| format!("{g}_{}", number + 1)))
                .and_then(|of| self.asked(&demand, of, &datums, nominal));
            match asked {
                Ok(mut asked) => {
                    let feature = &self.features[asked.of].name;
                    let each =
                        |n: &String| if is_one { n.clone() } else { format!("{n} of {feature}") };
                    asked.name = name.as_ref().map(each);
                    self.characteristics.push(asked);
                }
                Err(reason) => self.leave_out(nominal, &reason, Some(node), problems),
            }
        }
        Ok(())
    }

    fn asked(
        &self,
        demand: &Demand,
        of: usize,
        datums: &[part::Datum],
        nominal: Node<'d, 't>,
    ) -> Result<Asked, Reason> {
        let form = &self.features[of].form;
        let forms: Vec<&Form> = datums.iter().map(|d| &self.features[d.features[0]].form).collect();
        demand.check(form, &forms)?;
        let (limits, note) = demand.limits_of(form)?;
        Ok(Asked {
            id: id_of(nominal),
            name: None,
            kind: demand.kind,
            limits,
            note,
            of,
            datums: datums.to_vec(),
            place: self.reader.place(nominal),
        })
    }

    /// The datum features of a definition in their order, with their letters.
    fn datums(&mut self, definition: Node<'d, 't>) -> Result<Vec<part::Datum>, Reason> {
        let frame = datums::frame(self.reader, definition)?;
        frame.into_iter().map(|members| self.datum(members)).collect()
    }

    fn datum(&mut self, members: Vec<datums::Datum<'d, 't>>) -> Result<part::Datum, Reason> {
        let mut found = Vec::new();
        for datum in members {
            let mut all = Vec::new();
            for reference in &datum.features {
                features::extend(&mut all, self.reader, *reference)?;
            }
            let letter = shown(&datum.letter);
            let [(node, _)] = &all[..] else {
                let message =
                    format!("datum {letter} has {} features, one is evaluated", all.len());
                return Err(Reason::plain(message));
            };
            let index = self.of_feature(*node, None).map_err(|reason| Reason {
                text: format!("datum {letter}, feature {}: {}", id_of(*node), reason.text),
                ..reason
            })?;
            let feature = &mut self.features[index];
            let is_sign = |c: char| c.is_alphanumeric() || "_-.".contains(c);
            let is_letter = !datum.letter.is_empty() && datum.letter.chars().all(is_sign);
            let is_free = feature.letter.is_none() && is_letter;
            // One with two letters, or a letter of two or one that a part file would divide, is named by its name.
            if is_free && self.letters.insert(datum.letter.clone()) {
                feature.letter = Some(datum.letter);
            }
            found.push(index);
        }
        Ok(part::Datum { features: found })
    }

    /// The feature of a nominal, read once.
    fn of_feature(
        &mut self,
        node: Node<'d, 't>,
        of_group: Option<String>,
    ) -> Result<usize, Reason> {
        let id = id_of(node);
        if let Some(known) = self.by_id.get(&id) {
            return known.clone();
        }
        let read = features::read(self.reader, self.units, node);
        let index = read.map(|(form, notes)| {
            let kind = in_words(features::stem(node));
            let own = self.names.get(&id).cloned().or_else(|| text_of(node, "Name"));
            let own = own.or_else(|| node.attribute("label").map(str::to_owned)).or(of_group);
            let mut name = own.map(|n| text::key(&n)).unwrap_or_default();
            if name.is_empty() {
                name = text::key(&format!("{}_{id}", kind.replace(' ', "_")));
            }
            let name = self.unique(&name);
            let place = self.reader.place(node);
            let feature = Drafted { id: id.clone(), name, kind, letter: None, form, notes, place };
            self.features.push(feature);
            self.features.len() - 1
        });
        self.by_id.insert(id, index.clone());
        index
    }

    fn unique(&mut self, name: &str) -> String {
        let mut number = 1;
        let mut found = name.to_owned();
        while !self.taken.insert(found.clone()) {
            number += 1;
            found = format!("{name}_{number}");
        }
        found
    }

    fn leave_out(
        &mut self,
        nominal: Node<'d, 't>,
        reason: &Reason,
        feature: Option<Node<'d, 't>>,
        problems: &mut Diagnostics,
    ) {
        let mut what = in_words(characteristics::stem(nominal));
        if let Some(name) = self.items.name(nominal) {
            what += &format!(" \"{name}\"");
        }
        let id = id_of(nominal);
        let place = self.reader.place(nominal);
        let of = feature.map(|f| format!("of feature {}: ", id_of(f))).unwrap_or_default();
        let text = format!("{of}{}", reason.text);
        warn(self.reader, reason, &format!("{what} {id} is left out: {text}"), problems);
        self.left_out.push(LeftOut { id, what, reason: text, place });
    }

    /// Removes what no characteristic of the draft needs, and names all features that are not in it.
    pub fn unused(&mut self, draft: &mut Draft, problems: &mut Diagnostics) {
        let mut needed: Vec<bool> = vec![false; draft.features.len()];
        for asked in &draft.characteristics {
            for index in asked.datums.iter().flat_map(|d| &d.features).chain([&asked.of]) {
                needed[*index] = true;
            }
        }
        super::trial::keep(draft, &needed);
        let drafted: BTreeSet<&str> = draft.features.iter().map(|f| f.id.as_str()).collect();
        let mut left = Vec::new();
        for node in self.reader.ending("FeatureNominal") {
            let id = id_of(node);
            let is_group = !super::document::listed(node, "FeatureNominalIds").is_empty();
            if drafted.contains(id.as_str()) || is_group {
                continue;
            }
            let plain = || Reason::plain("no characteristic of this draft needs it");
            let reason = match self.by_id.remove(&id) {
                Some(Err(reason)) => reason,
                Some(Ok(_)) => plain(),
                None => features::unfit(node).unwrap_or_else(plain),
            };
            let what = format!("feature {}", in_words(features::stem(node)));
            let text = reason.text.clone();
            warn(self.reader, &reason, &format!("{what} {id} is left out: {text}"), problems);
            left.push(LeftOut { id, what, reason: text, place: self.reader.place(node) });
        }
        left.sort_by(|a, b| (&a.what, &a.reason).cmp(&(&b.what, &b.reason)));
        draft.left_out.extend(left);
    }
}

fn warn(reader: &Reader<'_, '_>, reason: &Reason, message: &str, problems: &mut Diagnostics) {
    let Some((code, at)) = reason.fault else { return };
    let place: Place = reader.place_at(at);
    // One fault of a feature concerns all its characteristics: it is reported once.
    if problems.iter().any(|p| p.code == code && p.place == place) {
        return;
    }
    let hint = "the draft is made without it; correct the export to have it";
    problems.warn(code, place, message.to_owned(), hint);
}

fn id_of(node: Node<'_, '_>) -> String {
    shown(node.attribute("id").unwrap_or("?").trim())
}
