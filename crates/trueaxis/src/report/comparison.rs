//! A comparison of readings with a prediction, as text, JSON and a page.

use crate::verify::compare::{Against, Comparison, Coverage, Part, Rule, Verified};
use maud::html;
use serde_json::{Value, json};
use std::fmt::Write as _;
use trueaxis_calibrate::measure::virtual_campaign::shown_unit;
use trueaxis_part::tolerance::Outcome;
use trueaxis_report::picture_page::{PicturePage, picture_page};
use trueaxis_report::{Band, Picture, Scatter};
use trueaxis_report::{Block, DrawingError, write_block};

/// Places that the terminal and the page show.
const WORST_PLACES: usize = 10;
/// More points say nothing new to the eye.
const MOST_POINTS: usize = 4000;

fn word(outcome: Outcome) -> &'static str {
    match outcome {
        Outcome::Pass => "pass",
        Outcome::Fail => "fail",
        Outcome::Undecided => "undecided",
    }
}

fn rule(task: &Comparison) -> String {
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

fn reason(task: &Comparison, verified: &Verified) -> String {
    let [pass, fail, open] = verified.counts;
    match task.decision.rule {
        Rule::Coverage => coverage_words(&verified.coverage),
        _ => format!("{pass} numbers pass, {fail} fail, {open} are undecided"),
    }
}

fn lines(task: &Comparison, verified: &Verified) -> Vec<String> {
    let against = match &task.against {
        Against::Prediction(machine) => format!("against the prediction of {}", machine.name()),
        Against::Readings(_) => "against other readings of the same places".to_owned(),
    };
    vec![
        format!("{} readings {against}", verified.readings.len()),
        format!("rule: {}", rule(task)),
        coverage_words(&verified.coverage),
    ]
}

fn blocks(task: &Comparison, verified: &Verified) -> [Block; 2] {
    let headings =
        ["instrument", "numbers", "rms nominal", "rms", "unit", "within U", "largest |r|/U"];
    let note = "rms nominal: with a machine without errors; the set-up is fitted to both";
    let mut by_instrument = Block::new("By instrument", note, &headings);
    for part in &verified.instruments {
        let instrument = &task.campaign.instruments[part.index as usize];
        let (unit, scale) = shown_unit(instrument);
        by_instrument.rows.push(row(&instrument.name, part, unit, scale));
    }
    let headings =
        ["place", "instrument", "line", "numbers", "rms", "unit", "within U", "largest |r|/U"];
    let mut places = Block::new("The worst places", "", &headings);
    for place in verified.places.iter().take(WORST_PLACES) {
        let instrument = &task.campaign.instruments[place.instrument as usize];
        let (unit, scale) = shown_unit(instrument);
        let part = &place.part;
        places.rows.push(vec![
            part.index.to_string(),
            instrument.name.clone(),
            verified.readings.lines[place.row].to_string(),
            part.count.to_string(),
            format!("{:.2}", part.rms_after * scale),
            unit.to_owned(),
            percent(part.coverage.share()),
            format!("{:.2}", part.worst),
        ]);
    }
    [by_instrument, places]
}

fn row(name: &str, part: &Part, unit: &str, scale: f64) -> Vec<String> {
    let before = part.rms_before.map_or("–".to_owned(), |v| format!("{:.2}", v * scale));
    vec![
        name.to_owned(),
        part.count.to_string(),
        before,
        format!("{:.2}", part.rms_after * scale),
        unit.to_owned(),
        percent(part.coverage.share()),
        format!("{:.2}", part.worst),
    ]
}

/// For the terminal.
pub fn comparison_text(task: &Comparison, verified: &Verified) -> String {
    let mut out = format!("{}\n", task.name);
    // Writing into a text cannot fail.
    for line in lines(task, verified) {
        let _ = writeln!(out, "  {line}");
    }
    for block in &blocks(task, verified) {
        let _ = write_block(&mut out, block);
    }
    let verdict = word(verified.outcome).to_uppercase();
    let _ = writeln!(out, "\n{verdict}: {}", reason(task, verified));
    out
}

/// The document `trueaxis/verify/1`.
pub fn comparison_json(task: &Comparison, verified: &Verified) -> Value {
    let coverage = |c: &Coverage| {
        json!({
            "numbers": c.count,
            "inside": c.inside,
            "independent": c.independent,
            "share": c.share(),
            "interval_95": c.interval,
            "expected": c.expected,
        })
    };
    let part = |part: &Part, of: u32| {
        let instrument = &task.campaign.instruments[of as usize];
        let (unit, (_, scale)) =
            (if instrument.sight.is_angle() { "urad" } else { "um" }, shown_unit(instrument));
        let worst = if part.worst.is_finite() { json!(part.worst) } else { Value::Null };
        json!({
            "instrument": instrument.name,
            "coverage": coverage(&part.coverage),
            (format!("rms_nominal_{unit}")): part.rms_before.map(|v| v * scale),
            (format!("rms_{unit}")): part.rms_after * scale,
            "largest_ratio": worst,
        })
    };
    let places = verified.places.iter().map(|place| {
        let mut document = part(&place.part, place.instrument);
        document["group"] = json!(place.part.index);
        document["line"] = json!(verified.readings.lines[place.row]);
        document
    });
    let deviations = verified.deviations.iter().map(|d| {
        let of = verified.readings.instruments[d.row];
        let instrument = &task.campaign.instruments[of as usize];
        let unit = if instrument.sight.is_angle() { "urad" } else { "um" };
        let (_, scale) = shown_unit(instrument);
        json!({
            "instrument": instrument.name,
            "line": verified.readings.lines[d.row],
            "channel": d.channel,
            (format!("deviation_{unit}")): d.value * scale,
            (format!("expanded_{unit}")): d.expanded * scale,
        })
    });
    json!({
        "schema": "trueaxis/verify/1",
        "name": task.name,
        "against": match task.against {
            Against::Prediction(_) => "prediction",
            Against::Readings(_) => "readings",
        },
        "readings": verified.readings.len(),
        "coverage_factor": task.decision.coverage_factor,
        "rule": rule(task),
        "verdict": word(verified.outcome),
        "pass": verified.counts[0],
        "fail": verified.counts[1],
        "undecided": verified.counts[2],
        "coverage": coverage(&verified.coverage),
        "instruments": verified.instruments.iter().map(|p| part(p, p.index)).collect::<Vec<_>>(),
        "places": places.collect::<Vec<_>>(),
        "deviations": deviations.collect::<Vec<_>>(),
    })
}

/// The page.
///
/// # Errors
/// What the drawing library says.
pub fn comparison_html(task: &Comparison, verified: &Verified) -> Result<String, DrawingError> {
    let mut pictures = Vec::new();
    for part in &verified.instruments {
        let instrument = &task.campaign.instruments[part.index as usize];
        for channel in 0..instrument.sight.channels() {
            pictures.push(picture(task, verified, part.index, channel));
        }
    }
    let class = word(verified.outcome);
    let verdict = html! {
        section class=(format!("verdict {class}")) {
            strong { (class.to_uppercase()) }
            span { (reason(task, verified)) }
        }
    };
    picture_page(&PicturePage {
        title: &task.name,
        lines: &lines(task, verified),
        verdict: Some(verdict),
        blocks: &blocks(task, verified),
        pictures: &pictures,
    })
}

/// Deviations of one channel as dots, in the band of U.
fn picture(task: &Comparison, verified: &Verified, of: u32, channel: usize) -> Picture {
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
    Picture::Scatter(Scatter {
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
    })
}
