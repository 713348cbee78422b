//! A comparison of readings with a prediction, as text and page.

use super::certificate::standing;
use crate::verify::compare::{
    Comparison, ComparisonBasis, ComparisonResult, Coverage, Rule, SetUpDeviation, Summary,
};
use trueaxis_measure::measure::virtual_campaign::shown_unit;
use trueaxis_report::{Band, Picture, Report, Scatter, Section, Table};

/// Places that the terminal and the page show.
const WORST_PLACES: usize = 10;
/// More points say nothing new to the eye.
const MOST_POINTS: usize = 4000;

pub(super) fn rule(task: &Comparison) -> String {
    let k = task.decision.coverage_factor;
    match task.decision.rule {
        Rule::Simple => "every deviation within the tolerance (simple acceptance)".to_owned(),
        Rule::GuardBand => {
            format!("every deviation + U (k = {k}) within the tolerance, ISO 14253-1")
        }
        Rule::Coverage => format!("as many deviations within U (k = {k}) as should be"),
    }
}

fn percent(share: f64) -> String {
    format!("{:.1} %", share * 100.0)
}

fn coverage_words(coverage: &Coverage) -> String {
    format!(
        "{} of {} numbers within U: {} (95 % interval {} to {}), expected {}",
        coverage.inside,
        coverage.count,
        percent(coverage.share()),
        percent(coverage.interval[0]),
        percent(coverage.interval[1]),
        percent(coverage.expected)
    )
}

fn reason(task: &Comparison, verified: &ComparisonResult) -> String {
    if verified.set_up.iter().any(SetUpDeviation::is_contradicted) {
        return "the readings agree with the machine file only in another set-up than the stated one".to_owned();
    }
    let [pass, fail, open] = verified.counts;
    match task.decision.rule {
        Rule::Coverage => coverage_words(&verified.coverage),
        _ => format!("{pass} numbers pass, {fail} fail, {open} are undecided"),
    }
}

/// A comparison as text and page.
pub fn comparison_report<'a>(task: &'a Comparison, verified: &'a ComparisonResult) -> Report<'a> {
    let against = match &task.against {
        ComparisonBasis::Prediction(machine) => {
            format!("against the prediction of {}", machine.name())
        }
        ComparisonBasis::Readings(_) => "against other readings of the same places".to_owned(),
    };
    let channels = verified.instruments.iter().flat_map(|part| {
        let instrument = &task.campaign.instruments[part.index as usize];
        (0..instrument.sight.channels()).map(|channel| (part.index, channel))
    });
    let pictures = channels.map(|(of, channel)| picture(task, verified, of, channel));
    let word = verified.outcome.word().to_uppercase();
    Report::new(&task.name)
        .line(format!("{} readings {against}", verified.readings.len()))
        .line(format!("rule: {}", rule(task)))
        .line(coverage_words(&verified.coverage))
        .verdict(standing(verified.outcome), word, reason(task, verified))
        .sections(set_up(task, verified))
        .section(Section::new("By instrument").table(instruments(task, verified)))
        .section(Section::new("The worst places").table(places(task, verified)))
        .sections(pictures.map(|p| Section::from(Picture::Scatter(p))))
}

/// What is stated of the set-up against what fits; nothing where nothing is stated.
fn set_up<'a>(task: &'a Comparison, verified: &'a ComparisonResult) -> Option<Section<'a>> {
    let headings = ["instrument", "unknown", "fitted − stated", "u", "unit", "agrees"];
    let rows = verified.set_up.iter().map(|d| {
        let agrees = if d.is_contradicted() { "no" } else { "yes" };
        let instrument = task.campaign.instruments[d.instrument].name.clone();
        let [value, u] = [d.value, d.u].map(|v| format!("{v:.2}"));
        [instrument, d.unknown.clone(), value, u, d.unit.to_owned(), agrees.to_owned()]
    });
    let note = "u: of the difference where machine file and statement are right";
    let section = || Section::new("Set-up").table(Table::new(headings).rows(rows).note(note));
    (!verified.set_up.is_empty()).then(section)
}

fn instruments(task: &Comparison, verified: &ComparisonResult) -> Table {
    let headings =
        ["instrument", "numbers", "rms nominal", "rms", "unit", "within U", "largest |r|/U"];
    let rows = verified.instruments.iter().map(|part| {
        let instrument = &task.campaign.instruments[part.index as usize];
        let scale = shown_unit(instrument).1;
        let nominal = part.rms_before.map_or("–".to_owned(), |v| format!("{:.2}", v * scale));
        let [count, rest @ ..] = figures(part, shown_unit(instrument));
        [instrument.name.clone(), count, nominal].into_iter().chain(rest)
    });
    let note = "rms nominal: with a machine without errors; the set-up is fitted to both";
    Table::new(headings).rows(rows).note(note)
}

fn places(task: &Comparison, verified: &ComparisonResult) -> Table {
    let headings =
        ["place", "instrument", "line", "numbers", "rms", "unit", "within U", "largest |r|/U"];
    let rows = verified.places.iter().take(WORST_PLACES).map(|place| {
        let instrument = &task.campaign.instruments[place.instrument as usize];
        let line = verified.readings.lines[place.row].to_string();
        let names = [place.part.index.to_string(), instrument.name.clone(), line];
        names.into_iter().chain(figures(&place.part, shown_unit(instrument)))
    });
    Table::new(headings).rows(rows)
}

/// Numbers, rms with its unit, share within U, largest ratio.
fn figures(part: &Summary, (unit, scale): (&str, f64)) -> [String; 5] {
    [
        part.count.to_string(),
        format!("{:.2}", part.rms_after * scale),
        unit.to_owned(),
        percent(part.coverage.share()),
        format!("{:.2}", part.worst),
    ]
}

/// Deviations of one channel as dots, in the band of U.
fn picture(task: &Comparison, verified: &ComparisonResult, of: u32, channel: usize) -> Scatter {
    let instrument = &task.campaign.instruments[of as usize];
    let (unit, scale) = shown_unit(instrument);
    let mine: Vec<_> = verified
        .deviations
        .iter()
        .filter(|d| d.channel == channel && verified.readings.instruments[d.row] == of)
        .collect();
    let stride = mine.len().div_ceil(MOST_POINTS).max(1);
    let shown = || mine.iter().enumerate().step_by(stride).map(|(k, d)| ((k + 1) as f64, *d));
    let name = if instrument.kind.triggers() { "hit" } else { instrument.kind.channels()[channel] };
    Scatter {
        title: format!("{}, {name}", instrument.name),
        note: String::new(),
        x: "reading".to_owned(),
        y: format!("measured less expected, {unit}"),
        from_zero: true,
        bands: vec![Band {
            label: String::new(),
            colour: channel,
            line: shown().map(|(x, d)| (x, 0.0, d.expanded * scale)).collect(),
            points: shown().map(|(x, d)| (x, d.value * scale)).collect(),
        }],
        dashed: Vec::new(),
    }
}
