//! The readings of a campaign with the file that each came from.

use super::stage_tables::{Calibrated, read_calibrations};
use std::collections::BTreeMap;
use trueaxis_input::{CsvTable, Diagnostics, Item, Place, Section};
use trueaxis_measure::measure::prior::mark;
use trueaxis_measure::measure::{Campaign, Readings, read_table};
use trueaxis_measure::unknowns::fit::{Model, Rule};

/// Readings, and where each stands.
#[derive(Debug, Clone, Default)]
pub struct Records {
    /// The rows of all tables, one table after the other.
    pub readings: Readings,
    /// What each stage knows without the axes of the machine.
    pub calibrated: Vec<Calibrated>,
    /// Every table with its mark.
    pub marks: Vec<(String, String)>,
    /// The first row of each table, and its file.
    tables: Vec<(usize, String)>,
}

impl Records {
    /// Readings that came from no file.
    pub fn bare(readings: Readings) -> Self {
        Self { readings, ..Self::default() }
    }

    /// File and line of a row.
    pub fn place(&self, row: usize) -> Place {
        let table = self.tables.iter().rev().find(|(first, _)| *first <= row);
        let mut place = Place::whole(table.map_or("", |(_, file)| file));
        place.line = self.readings.lines.get(row).map_or(0, |line| *line as usize);
        place
    }
}

/// A table of readings that stands in no file of the campaign.
#[derive(Debug, Clone, Copy)]
pub struct Dropped<'a> {
    /// The instrument of the campaign whose tables it replaces.
    pub instrument: usize,
    /// What messages call it.
    pub name: &'a str,
    /// The table (CSV).
    pub text: &'a str,
}

/// Reads all tables of a campaign; a table that is there twice is refused.
pub fn read_records(campaign: &Campaign, problems: &mut Diagnostics) -> Option<Records> {
    read_records_with(campaign, None, problems)
}

/// The same with a table in place of those of one instrument.
pub fn read_records_with(
    campaign: &Campaign,
    dropped: Option<Dropped<'_>>,
    problems: &mut Diagnostics,
) -> Option<Records> {
    let mut records = Records::default();
    let mut texts: Vec<(String, String)> = Vec::new();
    let mut sound = true;
    for (index, tables) in campaign.tables.iter().enumerate() {
        let read = match dropped.filter(|dropped| dropped.instrument == index) {
            Some(table) => vec![(table.name.to_owned(), Some(table.text.to_owned()))],
            None => tables
                .iter()
                .map(|path| {
                    let text = campaign.files.text(path, "a table of readings (CSV)", problems);
                    (path.display().to_string(), text)
                })
                .collect(),
        };
        if read.is_empty() {
            let message =
                format!("the instrument {} has no readings", campaign.instruments[index].name);
            let hint = "readings = \"FILE.csv\" in its section; it is left out";
            let place = Place::whole(&campaign.path.display().to_string());
            problems.warn("no-readings", place, message, hint);
        }
        for (file, text) in read {
            sound &= text.is_some_and(|text| {
                !is_twin(campaign, &file, &text, &texts, problems) && {
                    let table = CsvTable::parse(&file, &text, problems);
                    texts.push((file, table_mark(&text)));
                    records.add(campaign, index, &table, problems).is_some()
                }
            });
        }
    }
    records.calibrated = read_calibrations(campaign, &mut texts, problems).unwrap_or_default();
    records.marks = texts;
    check_copies(&records, problems);
    (sound && !problems.has_errors()).then_some(records)
}

/// The mark of a table: comments and ends of lines do not count.
pub(super) fn table_mark(text: &str) -> String {
    let lines = text.lines().map(str::trim).filter(|l| !l.is_empty() && !l.starts_with('#'));
    mark(&lines.collect::<Vec<_>>().join("\n"))
}

/// Rows that stand in two tables, digit for digit, are one reading.
fn check_copies(records: &Records, problems: &mut Diagnostics) {
    let readings = &records.readings;
    let mut first: BTreeMap<Vec<u64>, usize> = BTreeMap::new();
    let mut copies: BTreeMap<(usize, usize), Vec<(usize, usize)>> = BTreeMap::new();
    let table_of = |row: usize| records.tables.iter().rposition(|(start, _)| *start <= row);
    let rows_of = |table: usize| {
        let end = records.tables.get(table + 1).map_or(readings.len(), |(start, _)| *start);
        end - records.tables[table].0
    };
    for row in 0..readings.len() {
        let numbers = readings.commands[row].iter().chain(&readings.values[row]);
        let key: Vec<u64> = numbers.map(|v| (v + 0.0).to_bits()).collect();
        let Some(own) = table_of(row) else { continue };
        match first.get(&key).map(|old| (*old, table_of(*old))) {
            Some((old, Some(other))) if other != own => {
                copies.entry((other, own)).or_default().push((old, row));
            }
            Some(_) => {}
            None => {
                first.insert(key, row);
            }
        }
    }
    for ((other, own), rows) in copies {
        let least = rows_of(other).min(rows_of(own)).div_ceil(2).max(FEWEST_COPIES);
        let Some((old, new)) = rows.first().filter(|_| rows.len() >= least) else { continue };
        let there = records.place(*old);
        let message = format!(
            "{} rows stand in {} too, this one in line {}",
            rows.len(),
            there.file,
            there.line
        );
        let hint = "readings that count twice look too sure: delete them in one of the files";
        problems.error("duplicate-readings", records.place(*new), message, hint);
    }
}

/// Fewer equal rows in two tables are chance.
const FEWEST_COPIES: usize = 3;

/// Whether the same readings came before, which is an error.
pub(super) fn is_twin(
    campaign: &Campaign,
    file: &str,
    text: &str,
    known: &[(String, String)],
    problems: &mut Diagnostics,
) -> bool {
    let mark = table_mark(text);
    let prior = campaign.stages.prior.as_ref();
    if let Some((prior, (was, _))) =
        prior.and_then(|p| Some((p, p.readings.iter().find(|(_, known)| *known == mark)?)))
    {
        let message = format!("these readings are in {} already, as {was}", prior.path.display());
        let hint = "readings that count twice look too sure: leave out the table or the prior";
        problems.error("duplicate-file", Place::whole(file), message, hint);
        return true;
    }
    let twin = known.iter().find(|(_, known)| *known == mark);
    if let Some((twin, _)) = twin {
        let message = format!("the same readings as in {twin}");
        let hint = "name every table once: readings that count twice look too sure";
        problems.error("duplicate-file", Place::whole(file), message, hint);
    }
    twin.is_some()
}

impl Records {
    /// One table of one instrument.
    fn add(
        &mut self,
        campaign: &Campaign,
        index: usize,
        table: &CsvTable,
        problems: &mut Diagnostics,
    ) -> Option<()> {
        let of = (&campaign.instruments[..], index);
        let read = read_table(table, (&campaign.machine, &campaign.limits), of, problems)?;
        self.tables.push((self.readings.len(), table.file.clone()));
        self.readings.append(&read);
        Some(())
    }
}

/// Poses are written with four decimals: what is seen ten thousand times less than the best
/// combination may be rounding, and its uncertainty would be larger than any error.
const THRESHOLD: f64 = 1e-4;

/// How residuals count.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Loss {
    /// By their squares.
    #[default]
    Squares,
    /// By their squares up to 1.345 standard deviations, then by their size (Huber 1964).
    Huber,
}

/// `[fit]` of a campaign.
#[derive(Debug, Clone, PartialEq)]
pub struct Options {
    /// How residuals count.
    pub loss: Loss,
    /// Into how many parts the places are split for cross-validation.
    pub folds: usize,
    /// Whether cross-validation chooses among the terms of error motions.
    pub selection: bool,
    /// Singular values below this share of the greatest are not seen. Unit: 1.
    pub threshold: f64,
    /// The whole machine, or what is linear of it.
    pub model: Model,
    /// Whether readings are predicted by all errors, too.
    pub predicts: bool,
    /// Whether the prediction is scored on readings that were held out.
    pub scores: bool,
    /// When it was measured, as written.
    pub date: Option<String>,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            loss: Loss::Squares,
            folds: 10,
            selection: true,
            threshold: THRESHOLD,
            model: Model::Full,
            predicts: false,
            scores: true,
            date: None,
        }
    }
}

impl Options {
    /// How the fit goes about it.
    pub fn rule(&self) -> Rule {
        Rule { threshold: self.threshold, model: self.model }
    }
}

/// Reads `[fit]`.
pub fn read_options(root: &Section<'_>) -> Options {
    let mut options = Options { predicts: true, ..Options::default() };
    root.section("fit", |section| {
        if let Some(item) = section.get("loss") {
            options.loss = read_word(&item, LOSSES);
        }
        if let Some(item) = section.get("model") {
            options.model = read_word(&item, MODELS);
        }
        if let Some((item, folds)) = section.get("folds").and_then(|i| Some((i, i.count()?))) {
            match (2..=100).contains(&folds) {
                true => options.folds = folds,
                false => item.error("bad-folds", "2 to 100 parts make sense".into(), "folds = 10"),
            }
        }
        if let Some(selection) = section.get("selection").and_then(|i| i.flag()) {
            options.selection = selection;
        }
        if let Some(item) = section.get("threshold")
            && let Some(threshold) = item.number()
        {
            match (1e-6..=0.1).contains(&threshold) {
                true => options.threshold = threshold,
                false => {
                    let message = "the threshold of singular values is 1e-6 to 0.1".to_owned();
                    item.error("bad-threshold", message, "threshold = 1e-4");
                }
            }
        }
        options.date = section.get("date").and_then(|i| i.date_or_text());
    });
    options
}

const LOSSES: [(&str, Loss); 2] = [("squares", Loss::Squares), ("huber", Loss::Huber)];
const MODELS: [(&str, Model); 2] = [("full", Model::Full), ("linear", Model::Linear)];

/// One of two words; the first is usual.
fn read_word<T: Copy>(item: &Item<'_>, words: [(&str, T); 2]) -> T {
    let Some(text) = item.text() else { return words[0].1 };
    words.iter().find(|(word, _)| *word == text).map_or_else(
        || {
            let hint = format!("\"{}\" (usual) or \"{}\"", words[0].0, words[1].0);
            item.error("unknown-word", format!("`{text}` is none of the choices"), &hint);
            words[0].1
        },
        |(_, found)| *found,
    )
}
