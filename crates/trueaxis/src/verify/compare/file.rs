//! The file of a comparison.

use super::{Comparison, ComparisonBasis, Decision, Rule, pair};
use std::path::{Path, PathBuf};
use trueaxis_input::{Diagnostics, Dimension, Files, Item, Section, SourceText};
use trueaxis_machine::Machine;
use trueaxis_machine::heat::Conditions;
use trueaxis_measure::measure::{Campaign, Readings, read_campaign};

/// Reads a comparison with all that it names.
pub fn read_comparison(files: &Files, path: &Path) -> (Option<Comparison>, Diagnostics) {
    let mut problems = Diagnostics::new();
    let Some(text) = files.text(path, "a file of a comparison (TOML)", &mut problems) else {
        return (None, problems);
    };
    let file = path.display().to_string();
    let source = SourceText::from(files, &file, &text);
    let folder = path.parent().unwrap_or(Path::new(""));
    let read = source.read(|root| read(root, folder));
    problems.append(source.finish());
    (read.filter(|_| !problems.has_errors()), problems)
}

fn read(root: &Section<'_>, folder: &Path) -> Option<Comparison> {
    let name = root.require("name", "say what is verified").and_then(|i| i.text());
    let hint = "[compare] campaign = \"campaign.toml\": which instruments read where";
    let compare = root.require("compare", hint);
    let decision = root.get("decision");
    let found = compare?.section("compare", |s| read_compare(s, folder)).flatten();
    let Some((campaign, measured, against)) = found else {
        decision.and_then(|d| d.section("decision", |s| s.entries().len()));
        return None;
    };
    let decision = match decision {
        None => Decision {
            rule: Rule::Coverage,
            coverage_factor: 2.0,
            tolerance: vec![None; campaign.instruments.len()],
        },
        Some(item) => item.section("decision", |s| read_decision(s, &campaign)).flatten()?,
    };
    Some(Comparison { name: name?.to_owned(), campaign, measured, against, decision })
}

fn read_compare(
    section: &Section<'_>,
    folder: &Path,
) -> Option<(Campaign, Readings, ComparisonBasis)> {
    let hint = "the campaign file, relative to this one";
    let item = section.require("campaign", hint);
    let [machine, readings, with] = ["machine", "readings", "with"].map(|key| section.get(key));
    let path = folder.join(item?.text()?);
    let temperature = |root: &Section<'_>, _: &Campaign| {
        Some(
            root.get("temperature")
                .is_some()
                .then(|| root.section("temperature", Conditions::read)),
        )
    };
    let (read, problems) = read_campaign(section.files(), &path, temperature);
    section.take_over(problems);
    let (mut campaign, conditions) = read?;
    let conditions = conditions.flatten();
    if let Some(item) = &readings {
        campaign.tables = read_tables(item, &campaign, folder)?;
    }
    let measured = load(section, &campaign)?;
    if measured.is_empty() {
        let message = "there are no readings to compare".to_owned();
        let hint = "readings = { probe = \"readings.csv\" }, by instrument";
        section.error("no-readings", message, hint);
        return None;
    }
    if let (Some(item), Some(_)) = (&machine, &with) {
        let message = "either a prediction or other readings".to_owned();
        item.error("two-comparisons", message, "leave `machine` or `with` out");
        return None;
    }
    let against = match (machine, with) {
        (_, Some(item)) => {
            let mut other = campaign.clone();
            other.tables = read_tables(&item, &campaign, folder)?;
            let second = load(section, &other)?;
            against_readings(&item, &campaign, &measured, &second)?
        }
        (Some(item), None) => {
            let machine = read_machine(&item, section, &campaign, conditions.as_ref(), folder)?;
            ComparisonBasis::Prediction(Box::new(machine))
        }
        (None, None) => ComparisonBasis::Prediction(Box::new(campaign.machine.clone())),
    };
    Some((campaign, measured, against))
}

fn load(section: &Section<'_>, campaign: &Campaign) -> Option<Readings> {
    let mut problems = Diagnostics::new();
    let readings = campaign.readings(&mut problems);
    section.take_over(problems);
    readings
}

fn against_readings(
    item: &Item<'_>,
    campaign: &Campaign,
    first: &Readings,
    second: &Readings,
) -> Option<ComparisonBasis> {
    let pairs = pair(campaign, first, second);
    if pairs.differences.is_empty() {
        let message = "no reading of one set stands where one of the other does".to_owned();
        item.error("no-pairs", message, "are these the same places, in the same units?");
        return None;
    }
    if pairs.alone_in_first + pairs.alone_in_second > 0 {
        let message = format!(
            "{} rows of the first set and {} of the second have no partner",
            pairs.alone_in_first, pairs.alone_in_second
        );
        item.warn("unpaired", message, "they are left out");
    }
    Some(ComparisonBasis::Readings(Box::new(pairs)))
}

fn read_machine(
    item: &Item<'_>,
    section: &Section<'_>,
    campaign: &Campaign,
    conditions: Option<&Conditions>,
    folder: &Path,
) -> Option<Machine> {
    let (machine, problems) = Machine::read(section.files(), &folder.join(item.text()?));
    section.take_over(problems);
    let machine = machine?;
    if machine.chain_text() != campaign.machine.chain_text() {
        let message = format!(
            "this machine is {}, that of the campaign {}",
            machine.chain_text(),
            campaign.machine.chain_text()
        );
        item.error("other-chain", message, "both describe the same machine");
        return None;
    }
    let mut problems = Diagnostics::new();
    let machine = machine.running("predicted", item.place(), &mut problems);
    section.take_over(problems);
    let Some(conditions) = conditions else { return Some(machine) };
    let mut problems = Diagnostics::new();
    let warm = machine.at(conditions, &mut problems);
    section.take_over(problems);
    warm
}

/// `{ probe = "a.csv", bar = ["b.csv", "c.csv"] }`; with one instrument the file alone.
fn read_tables(item: &Item<'_>, campaign: &Campaign, folder: &Path) -> Option<Vec<Vec<PathBuf>>> {
    let mut tables = vec![Vec::new(); campaign.instruments.len()];
    let paths = |item: &Item<'_>| -> Option<Vec<PathBuf>> {
        let items = if item.is_list() { item.list()? } else { vec![*item] };
        items.iter().map(|i| Some(folder.join(i.text()?))).collect()
    };
    if !item.is_table() {
        if campaign.instruments.len() != 1 {
            let message = "which instrument read this?".to_owned();
            item.error("which-instrument", message, "{ NAME = \"readings.csv\" }");
            return None;
        }
        tables[0] = paths(item)?;
        return Some(tables);
    }
    item.section("readings", |s| {
        for (key, _, item) in s.entries() {
            match (campaign.instrument(key), paths(&item)) {
                (Some(of), Some(found)) => tables[of] = found,
                (None, _) => {
                    let message = format!("unknown instrument `{key}`");
                    item.error("unknown-instrument", message, "as in the campaign file");
                }
                _ => {}
            }
        }
    });
    Some(tables)
}

/// `rule`, `tolerance`, `coverage_factor`.
fn read_decision(section: &Section<'_>, campaign: &Campaign) -> Option<Decision> {
    let mut tolerance = vec![None; campaign.instruments.len()];
    let limit = |item: &Item<'_>, of: usize| {
        let angle = campaign.instruments[of].sight.is_angle();
        let value = item.quantity(if angle { Dimension::Angle } else { Dimension::Length })?;
        if value <= 0.0 {
            let message = "a tolerance is positive".to_owned();
            item.error("bad-tolerance", message, "the largest deviation, such as \"10 um\"");
        }
        Some(value).filter(|v| *v > 0.0)
    };
    if let Some(item) = section.get("tolerance") {
        if item.is_table() {
            item.section("decision.tolerance", |s| {
                for (key, _, item) in s.entries() {
                    match campaign.instrument(key) {
                        Some(of) => tolerance[of] = limit(&item, of),
                        None => {
                            let message = format!("unknown instrument `{key}`");
                            item.error("unknown-instrument", message, "as in the campaign file");
                        }
                    }
                }
            });
        } else {
            for (of, slot) in tolerance.iter_mut().enumerate() {
                *slot = limit(&item, of);
            }
        }
    }
    let stated = tolerance.iter().any(Option::is_some);
    let rule = match section.get("rule") {
        None if stated => Rule::Simple,
        None => Rule::Coverage,
        Some(item) => match item.text()? {
            "simple" => Rule::Simple,
            "ISO 14253-1" => Rule::GuardBand,
            "coverage" => Rule::Coverage,
            other => {
                let message = format!("unknown decision rule `{other}`");
                item.error("unknown-rule", message, "\"simple\", \"ISO 14253-1\" or \"coverage\"");
                return None;
            }
        },
    };
    if rule != Rule::Coverage && !stated {
        let message = "there is nothing to decide by".to_owned();
        section.error("missing-key", message, "tolerance = \"10 um\", or rule = \"coverage\"");
        return None;
    }
    let mut coverage_factor = 2.0;
    if let Some(item) = section.get("coverage_factor") {
        coverage_factor = item.number()?;
        if !(0.1..=10.0).contains(&coverage_factor) {
            let message = "k lies from 0.1 to 10".to_owned();
            item.error("bad-factor", message, "2: about 95 %");
        }
    }
    Some(Decision { rule, coverage_factor, tolerance })
}
