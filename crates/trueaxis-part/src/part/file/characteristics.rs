//! Characteristics of the part file: what is asked of which feature, to which datums.

use super::asked::Asked;
use crate::part::{Characteristic, Datum, Feature, Kind, Limits};
use trueaxis_input::plausible::Quantity;
use trueaxis_input::{Dimension, Item, Section};

pub(super) fn read_characteristic(
    section: &Section<'_>,
    features: &[Feature],
    complete: bool,
) -> Option<Characteristic> {
    let stated: Vec<(Kind, Item<'_>)> = Kind::ALL
        .into_iter()
        .filter_map(|kind| section.get(kind.key()).map(|i| (kind, i)))
        .collect();
    for word in ["maximum_material", "least_material", "envelope"] {
        if section.get(word).is_some() {
            material_condition(section, &format!("`{word}`"));
        }
    }
    let named = |key: &str, word: &str| {
        let is_meant = |f: &Feature| f.name == word || f.letter.as_deref() == Some(word);
        let found = features.iter().position(is_meant);
        // A feature with a mistake of its own is not called unknown.
        if found.is_none() && complete {
            let known: Vec<&str> = features.iter().map(|f| f.name.as_str()).collect();
            let message = format!("`{key}`: the part has no feature `{word}`");
            let hint = format!("its features: {}", known.join(", "));
            section.error("unknown-feature", message, &hint);
        }
        found
    };
    let feature = section
        .require("of", "the name of a feature: of = \"top\"")
        .and_then(|item| item.text())
        .and_then(|word| {
            let is_member = |f: &Feature| f.pattern.as_deref() == Some(word);
            let members: Vec<usize> =
                (0..features.len()).filter(|i| is_member(&features[*i])).collect();
            match members.is_empty() {
                true => named("of", word).map(|one| (features[one].name.as_str(), vec![one])),
                false => Some((word, members)),
            }
        });
    let datums: Option<Vec<Datum>> = match section.get("datum") {
        None => Some(Vec::new()),
        Some(item) => datum_words(&item).and_then(|words| {
            let datum = |word: &String| {
                let parts = parts_of(word, features);
                let all: Vec<Option<usize>> = parts.iter().map(|w| named("datum", w)).collect();
                all.into_iter().collect::<Option<Vec<usize>>>().map(|features| Datum { features })
            };
            let all: Vec<Option<Datum>> = words.iter().map(datum).collect();
            all.into_iter().collect()
        }),
    };
    let projected =
        section.get("projected").map(|item| item.quantity(Dimension::Length).map(|mm| (item, mm)));
    let name = section.text("name").map(str::to_owned);
    let [(kind, item)] = stated[..] else {
        let known: Vec<&str> = Kind::ALL.iter().map(|k| k.key()).collect();
        let message = format!("{} characteristics are stated, expected one", stated.len());
        section.error("one-characteristic", message, &format!("one of {}", known.join(", ")));
        return None;
    };
    let limits = read_limits(&item, kind);
    let ((of, members), datums) = (feature?, datums?);
    let projected = match projected {
        None => None,
        Some(stated) => Some(stated?),
    };
    for member in &members {
        let is_pattern = members.len() > 1;
        let asked = Asked { section, features, kind, of: &features[*member], is_pattern };
        asked.check(&datums)?;
        if let Some((item, mm)) = &projected {
            asked.check_projected(item, *mm)?;
        }
    }
    let projected_mm = projected.map(|(_, mm)| mm);
    let name = name.unwrap_or_else(|| {
        let labels: Vec<String> = datums.iter().map(|d| d.label(features)).collect();
        let zone = projected_mm.map_or(String::new(), |mm| format!(", projected {mm} mm"));
        match labels[..] {
            [] => format!("{} of {of}{zone}", kind.name()),
            _ => format!("{} of {of} to {}{zone}", kind.name(), labels.join("|")),
        }
    });
    let of = of.to_owned();
    Some(Characteristic {
        name,
        kind,
        of,
        features: members,
        datums,
        projected_mm,
        limits: limits?,
    })
}

/// The names that a datum is made of: itself, the members of a pattern, or what dashes divide, `A-B`.
fn parts_of<'w>(word: &'w str, features: &'w [Feature]) -> Vec<&'w str> {
    let is_one = |f: &Feature| f.name == word || f.letter.as_deref() == Some(word);
    if features.iter().any(is_one) || word.split('-').any(str::is_empty) {
        return vec![word];
    }
    let is_member = |f: &&Feature| f.pattern.as_deref() == Some(word);
    let members: Vec<&str> = features.iter().filter(is_member).map(|f| f.name.as_str()).collect();
    match members.is_empty() {
        false => members,
        true if word.contains('-') => {
            word.split('-').map(str::trim).flat_map(|part| parts_of(part, features)).collect()
        }
        true => vec![word],
    }
}

fn material_condition(section: &Section<'_>, what: &str) {
    let message = format!("{what}: zones with material conditions are not judged");
    section.error("material-condition", message, "leave it out and judge the zone without it");
}

/// `"A|B|C"`, or a list of names.
fn datum_words(item: &Item<'_>) -> Option<Vec<String>> {
    let words: Vec<String> = match item.is_list() {
        true => {
            let list = item.list()?;
            let words: Option<Vec<String>> =
                list.iter().map(|i| i.text().map(str::to_owned)).collect();
            words?
        }
        false => item.text()?.split('|').map(|w| w.trim().to_owned()).collect(),
    };
    for word in &words {
        let is_material = ["Ⓜ", "Ⓛ", "(M)", "(L)"].iter().any(|sign| word.contains(sign));
        if is_material {
            let message =
                format!("datum `{word}`: datums with material conditions are not evaluated");
            item.error("material-condition", message, "name the datum without it");
            return None;
        }
    }
    if words.is_empty() || words.len() > 3 || words.iter().any(String::is_empty) {
        let message = format!("a datum system has one to three datums, not {}", words.len());
        item.error(
            "bad-datum",
            message,
            "datum = \"A\", of a system \"A|B|C\", of a common datum \"A-B\"",
        );
        return None;
    }
    Some(words)
}

/// `"20 um"`, for a size `"±20 um"` or `["-10 um", "25 um"]`.
fn read_limits(item: &Item<'_>, kind: Kind) -> Option<Limits> {
    if !kind.is_size() {
        let tolerance_mm = item.quantity_of(Quantity::Deviation)?;
        if tolerance_mm <= 0.0 {
            let message = format!("`{}` must be positive", kind.key());
            item.error("not-positive", message, "a tolerance such as \"20 um\"");
            return None;
        }
        return Some(Limits::Zone { tolerance_mm });
    }
    let limits = match item.is_list() {
        true => {
            let list = item.list()?;
            let both: Vec<Option<f64>> =
                list.iter().map(|i| i.quantity_of(Quantity::Deviation)).collect();
            match both[..] {
                [Some(low_mm), Some(high_mm)] => Some((low_mm, high_mm)),
                _ => None,
            }
        }
        false => item.quantity_of(Quantity::Deviation).map(|v| (-v, v)),
    };
    match limits {
        Some((low_mm, high_mm)) if low_mm < high_mm => Some(Limits::Size { low_mm, high_mm }),
        _ => {
            let hint = "\"20 um\" for either way, or [\"-10 um\", \"25 um\"]";
            let message = "limits of a size are a lower and an upper deviation".to_owned();
            item.error("bad-limits", message, hint);
            None
        }
    }
}
