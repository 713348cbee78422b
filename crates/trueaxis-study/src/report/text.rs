//! A study in text and on a page.

use super::document::named_outputs;
use super::pictures::{histogram, shares};
use crate::distribution::Distribution;
use crate::findings::{CombinationFindings, Findings, Good};
use crate::inputs::{Input, Level};
use crate::points::Spreading;
use crate::study::Study;
use crate::table::input_unit;
use trueaxis::part::tolerance::Outcome;
use trueaxis_report::{Columns, Report, Section, Standing, Table};

/// Rows of a table on the terminal.
const MOST_ROWS: usize = 40;

/// The report of a study.
pub fn study_report<'a>(study: &'a Study, findings: &'a Findings) -> Report<'a> {
    let (standing, word, sentence) = verdict(study, findings);
    let several = findings.combinations.len() > 1;
    let report = Report::new(&study.name).line(samples(study)).verdict(standing, word, sentence);
    let report = match (several, findings.combinations.first()) {
        (true, _) => report.section(combinations(study, findings)),
        (false, Some(one)) => report
            .section(spreads(study, one))
            .section(good(study, one))
            .section(components(study, one))
            .section(pictures(study, one)),
        _ => report,
    };
    report.sections(sensitivities(study, findings)).section(inputs(study))
}

fn samples(study: &Study) -> String {
    let design = &study.design;
    let of = match design.combinations() {
        1 => String::new(),
        count => format!("{count} combinations of levels, each with "),
    };
    let spread = match design.spreading {
        Spreading::Random => "drawn at random",
        Spreading::LatinHypercube => "drawn as a Latin hypercube",
        Spreading::Sobol => "by the sequence of Sobol', shifted at random",
    };
    let machines =
        if design.machines == 1 { "1 machine" } else { &format!("{} machines", design.machines) };
    let days = if design.days == 1 { "1 day" } else { &format!("{} days", design.days) };
    format!("{of}{machines}, {days} each, {spread}, seed {}", design.seed)
}

fn verdict(study: &Study, findings: &Findings) -> (Standing, &'static str, String) {
    let Some((asked, outcome)) = study.requirement.zip(findings.outcome()) else {
        return (
            Standing::Open,
            "NO VERDICT",
            "the study asks for no share of machines".to_owned(),
        );
    };
    let on = match asked.days_ratio {
        1.0 => "on every day".to_owned(),
        ratio => format!("on {} of their days", percent(ratio)),
    };
    let wanted =
        format!("{} of the machines hold all tolerances {on}", percent(asked.machines_ratio));
    let found = match &findings.combinations[..] {
        [one] => one.good.map_or(String::new(), |good| {
            let [low, high] = good.interval_ratio;
            format!(
                ": found {} of {} machines, {} (95 %: {} to {})",
                good.machines,
                study.design.machines,
                percent(good.machines_ratio),
                percent(low),
                percent(high)
            )
        }),
        all => {
            let pass = all.iter().filter(|c| c.outcome == Some(Outcome::Pass)).count();
            format!(": so it is at {pass} of {} combinations", all.len())
        }
    };
    match outcome {
        Outcome::Pass => (Standing::Good, "PASS", format!("{wanted}{found}")),
        Outcome::Fail => (Standing::Bad, "FAIL", format!("fewer than {wanted}{found}")),
        Outcome::Undecided => {
            let more = "more machines in the study decide it";
            (Standing::Open, "UNDECIDED", format!("whether {wanted}{found}; {more}"))
        }
    }
}

fn percent(ratio: f64) -> String {
    let text = format!("{:.2}", ratio * 100.0);
    format!("{} %", text.trim_end_matches('0').trim_end_matches('.'))
}

fn um(mm: f64) -> String {
    // No minus before a zero.
    format!("{:.2}", (mm * 1e5).round() / 100.0 + 0.0)
}

fn limit(low_mm: Option<f64>, high_mm: Option<f64>) -> String {
    match (low_mm, high_mm) {
        (None, None) => "–".to_owned(),
        (None, Some(high)) => format!("≤ {}", um(high)),
        (Some(low), Some(high)) => format!("{} to {}", um(low), um(high)),
        (Some(low), None) => format!("≥ {}", um(low)),
    }
}

/// The name of an output, with its case where there are several.
fn named(study: &Study, case: &crate::Case, output: &crate::Output) -> String {
    match study.cases.len() {
        1 => output.title.clone(),
        _ => format!("{}: {}", case.name, output.title),
    }
}

fn spreads<'a>(study: &Study, one: &CombinationFindings) -> Section<'a> {
    let headings =
        ["output", "mean, µm", "u, µm", "95 % of parts, µm", "largest, µm", "allowed, µm", "good"];
    let note = "Of all machines on all days; u is the standard deviation of one part.";
    let mut table = Table::new(headings).note(note);
    for ((case, output), found) in named_outputs(study).zip(&one.outputs) {
        let spread = &found.spread;
        table.push([
            named(study, case, output),
            um(spread.mean_mm),
            spread.u_mm.map_or("–".to_owned(), um),
            format!("{} to {}", um(spread.low_mm), um(spread.high_mm)),
            um(spread.largest_mm),
            limit(output.low_mm, output.high_mm),
            found.good_ratio.map_or("–".to_owned(), percent),
        ]);
    }
    Section::new("Parts").table(table)
}

fn good<'a>(study: &Study, one: &CombinationFindings) -> Section<'a> {
    let headings = ["", "good parts", "u", "machines", "share of machines", "95 %"];
    let row = |name: String, good: &Good| {
        let [low, high] = good.interval_ratio;
        [
            name,
            percent(good.parts_ratio),
            good.u_parts_ratio.map_or("–".to_owned(), percent),
            format!("{} of {}", good.machines, study.design.machines),
            percent(good.machines_ratio),
            format!("{} to {}", percent(low), percent(high)),
        ]
    };
    let days = study.requirement.unwrap_or_default().days_ratio;
    let on = if days == 1.0 {
        "on every day".to_owned()
    } else {
        format!("on at least {} of the days", percent(days))
    };
    let hall = study.inputs.iter().any(|i| i.level == Level::Hall);
    let hall = match hall {
        true => {
            " The days of the hall are those that were drawn: the interval is that of other machines on the same days."
        }
        false => "",
    };
    let note = format!(
        "Parts whose outputs all are in tolerance, and machines that make such parts {on}; the interval is that of Clopper and Pearson.{hall}"
    );
    let mut table = Table::new(headings).note(note);
    if study.cases.len() > 1 {
        for (case, found) in study.cases.iter().zip(&one.cases) {
            if let Some(found) = found {
                table.push(row(case.name.clone(), found));
            }
        }
    }
    match &one.good {
        Some(found) => {
            let all = if study.cases.len() > 1 { "all together" } else { "all outputs" };
            Section::new("Good machines").table(table.bold_row(row(all.to_owned(), found)))
        }
        None => Section::new("Good machines").paragraph("No output has a tolerance."),
    }
}

fn components<'a>(study: &Study, one: &CombinationFindings) -> Section<'a> {
    let rows: Vec<[String; 4]> = named_outputs(study)
        .zip(&one.outputs)
        .filter_map(|((case, output), found)| {
            let c = found.components?;
            Some([named(study, case, output), um(c.machines_mm), um(c.days_mm), um(c.rest_mm)])
        })
        .collect();
    if rows.is_empty() {
        return Section::new("");
    }
    let headings = ["output", "machine to machine, µm", "day to day, µm", "rest, µm"];
    let note = "Standard deviations: of the mean of a machine, of a day that all machines share, and of what is of one machine on \
                one day alone (analysis of variance).";
    Section::new("Machines and days").table(Table::new(headings).note(note).rows(rows))
}

fn pictures<'a>(study: &'a Study, one: &'a CombinationFindings) -> Section<'a> {
    let all = named_outputs(study).zip(&one.outputs);
    let figures = all.map(|((case, output), found)| {
        histogram(named(study, case, output), output, &found.spread)
    });
    Section::new("Distributions")
        .on_page()
        .note("How many parts have which value; the red lines are the limits.")
        .grid(Columns::AsFit, figures)
}

fn combinations<'a>(study: &Study, findings: &Findings) -> Section<'a> {
    let inputs = study.design.levels.iter().map(|(i, _)| &study.inputs[*i]);
    let mut headings: Vec<String> = inputs.clone().map(heading).collect();
    let outputs: Vec<_> = named_outputs(study).collect();
    headings
        .extend(outputs.iter().map(|(case, output)| format!("{}, µm", named(study, case, output))));
    headings.extend(["good parts".to_owned(), "good machines".to_owned()]);
    if study.requirement.is_some() {
        headings.push("verdict".to_owned());
    }
    let mut table = Table::new(headings)
        .note(
            "Each row is a combination of levels, with the same drawn machines; outputs are means.",
        )
        .most_on_terminal(MOST_ROWS);
    for one in &findings.combinations {
        let mut cells: Vec<String> =
            inputs.clone().zip(&one.levels).map(|(input, value)| level(input, *value)).collect();
        cells.extend(one.outputs.iter().map(|o| um(o.spread.mean_mm)));
        let share = |f: &dyn Fn(&Good) -> f64| {
            one.good.as_ref().map_or("–".to_owned(), |g| percent(f(g)))
        };
        cells.push(share(&|g| g.parts_ratio));
        cells.push(share(&|g| g.machines_ratio));
        cells.extend(one.outcome.map(|o| o.word().to_owned()));
        table.push(cells);
    }
    Section::new("Combinations").table(table)
}

/// The unit of an input in words, and how many of it are one inner unit.
fn shown(input: &Input) -> (&'static str, f64) {
    use crate::inputs::Varied;
    match (&input.varied, input_unit(&input.varied)) {
        (Varied::Value(_) | Varied::Added(_), "mm") => ("µm", 1e3),
        (Varied::Value(_) | Varied::Added(_), _) => ("µrad", 1e6),
        (_, "rad") => ("°", 180.0 / std::f64::consts::PI),
        (_, "degC") => ("°C", 1.0),
        (_, "1") => ("", 1.0),
        (_, unit) => (unit, 1.0),
    }
}

fn heading(input: &Input) -> String {
    match shown(input).0 {
        "" => input.name.clone(),
        unit => format!("{}, {unit}", input.name),
    }
}

fn level(input: &Input, value: f64) -> String {
    let text = format!("{:.4}", value * shown(input).1);
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

fn sensitivities<'a>(study: &'a Study, findings: &'a Findings) -> Vec<Section<'a>> {
    let mut sections = Vec::new();
    // On the terminal those that decide, if any does.
    let some_judged = named_outputs(study).any(|(_, output)| output.is_judged());
    for ((case, output), found) in named_outputs(study).zip(&findings.shares) {
        let title = format!("What makes the variance of {}", named(study, case, output));
        let Some(found) = found else {
            sections.push(Section::new(title).paragraph("It does not vary."));
            continue;
        };
        let mut order: Vec<usize> = (0..found.len()).collect();
        order.sort_by(|a, b| found[*b].total.ratio.total_cmp(&found[*a].total.ratio));
        let headings = ["group of inputs", "first index", "u", "total index", "u"];
        let mut table = Table::new(headings).most_on_terminal(12).note(
            "Indices of Sobol': the share of the variance that falls away on average when the group is known (first), and that \
             remains when only the group varies (total: with all interactions); u is their standard uncertainty.",
        );
        for &group in &order {
            let (first, total) = (found[group].first, found[group].total);
            let ratio = |v: f64| format!("{:.3}", (v * 1e3).round() / 1e3 + 0.0);
            let [a, b, c, d] = [first.ratio, first.u_ratio, total.ratio, total.u_ratio].map(ratio);
            table.push([study.groups[group].clone(), a, b, c, d]);
        }
        let bars = order.iter().map(|g| (study.groups[*g].as_str(), found[*g])).collect();
        let section = Section::new(title).table(table).figure(shares(bars));
        sections.push(if some_judged && !output.is_judged() { section.on_page() } else { section });
    }
    sections
}

fn inputs<'a>(study: &Study) -> Section<'a> {
    let headings = ["input", "group", "drawn per", "distribution", "mean", "u"];
    let mut table = Table::new(headings).most_on_terminal(MOST_ROWS);
    for input in &study.inputs {
        let (unit, factor) = shown(input);
        let with_unit = |value: f64| match unit {
            "" => format!("{value:.4}"),
            _ => format!("{:.3} {unit}", value * factor + 0.0),
        };
        table.push([
            input.name.clone(),
            input.group.clone(),
            input.level.word().to_owned(),
            input.distribution.word().to_owned(),
            with_unit(Distribution::mean(&input.distribution)),
            with_unit(input.distribution.u()),
        ]);
    }
    Section::new("Inputs").table(table)
}
