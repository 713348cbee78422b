//! `study.toml` of many machines.

mod case;
mod input;

use crate::correlation::Correlation;
use crate::design::Design;
use crate::distribution::Distribution;
use crate::inputs::{Input, Level, Varied};
use crate::points::{Spreading, sobol_dimensions};
use crate::study::{Requirement, Study};
use case::{Named, named_cases};
use input::Reader;
use std::path::Path;
use trueaxis::input::{Diagnostics, Files, Item, Section, SourceText};
use trueaxis::machine::errors::BodyName;

/// More are a slip of the pen.
const MOST_MACHINES: usize = 100_000_000;
const MOST_DAYS: usize = 100_000;
const MOST_COMBINATIONS: usize = 100_000;

/// What the command may change.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Changes {
    /// Machines instead of those of the file.
    pub machines: Option<usize>,
    /// Days instead of those of the file.
    pub days: Option<usize>,
    /// The seed instead of that of the file.
    pub seed: Option<u64>,
    /// Rows of the sensitivity analysis instead of those of the file; 0: none.
    pub sensitivity: Option<usize>,
}

/// Reads a study with all that it names; all problems at once.
pub fn read_study(files: &Files, path: &Path, changes: Changes) -> (Option<Study>, Diagnostics) {
    let mut problems = Diagnostics::new();
    let Some(text) = files.text(path, "a study of many machines (TOML)", &mut problems) else {
        return (None, problems);
    };
    let file = path.display().to_string();
    let source = SourceText::from(files, &file, &text);
    let study = source.read(|root| read(root, path, changes));
    problems.append(source.finish());
    (study.filter(|_| !problems.has_errors()), problems)
}

fn read(root: &Section<'_>, path: &Path, changes: Changes) -> Option<Study> {
    let folder = path.parent().unwrap_or(Path::new(""));
    let name = root.require("name", "give the study a name").and_then(|i| i.text());
    let named = named_cases(root, folder);
    let machine = named.as_ref().and_then(|all| all.first()).map(Named::machine);
    let reader = Reader { folder, machine };
    let inputs = root.get("input").map_or(Some(Vec::new()), |item| {
        let all: Vec<Option<Vec<Input>>> = item.list()?.iter().map(|i| reader.read(i)).collect();
        Some(all.into_iter().collect::<Option<Vec<_>>>()?.concat())
    });
    let draws_stated = root.get("stated").map_or(Some(false), |i| i.flag());
    let wanted = root.get("outputs").map(|item| (item.list(), item));
    let design = root.section("design", |s| read_design(s, changes)).unwrap_or_else(|| {
        let hint = "[design] kind = \"monte-carlo\", machines = 10000";
        root.error("missing-key", "the study says not how many machines there are".into(), hint);
        None
    });
    let requirement =
        root.section("requirement", read_requirement).map_or(Some(None), |r| r.map(Some));
    let correlations = root.get("correlation");
    let (Some(named), Some(mut inputs), Some(draws_stated), Some(mut design)) =
        (named, inputs, draws_stated, design)
    else {
        // What needs the rest is not called unknown.
        root.entries();
        return None;
    };
    check_names(root, &inputs)?;
    let mut cases =
        named.into_iter().map(|one| one.with(root, &inputs)).collect::<Option<Vec<_>>>()?;
    if draws_stated {
        let stated = stated_inputs(&cases, &inputs);
        inputs.extend(stated);
    }
    if inputs.is_empty() {
        let message = "nothing is varied".to_owned();
        root.error(
            "no-input",
            message,
            "[[input]] error = \"EC0Y\", value = \"0 ± 20 urad\"; or stated = true",
        );
        return None;
    }
    cases.iter_mut().for_each(|case| case.connect(&inputs));
    if let Some((list, item)) = wanted {
        keep_outputs(&list?, &item, &mut cases)?;
    }
    let correlation = match correlations {
        None => None,
        Some(item) => Some(read_correlations(&item, &inputs)?),
    };
    let mut groups: Vec<String> = Vec::new();
    let group_of = inputs.iter().map(|input| {
        groups.iter().position(|g| *g == input.group).unwrap_or_else(|| {
            groups.push(input.group.clone());
            groups.len() - 1
        })
    });
    let group_of: Vec<usize> = group_of.collect();
    design.groups = groups.len();
    if design.factorial {
        let levels = |(i, input): (usize, &Input)| match &input.distribution {
            Distribution::Values(values) => Some((i, values.len())),
            _ => None,
        };
        design.levels = inputs.iter().enumerate().filter_map(levels).collect();
    }
    let study = Study {
        name: name?.to_owned(),
        path: path.to_owned(),
        design,
        inputs,
        correlation,
        groups,
        group_of,
        cases,
        requirement: requirement?,
    };
    check_design(root, &study)?;
    check_correlation(root, &study)?;
    check_requirement(root, &study)?;
    Some(study)
}

fn read_design(s: &Section<'_>, changes: Changes) -> Option<Design> {
    let kinds = ["monte-carlo", "latin-hypercube", "sobol", "factorial"];
    let kind = s.get("kind").map_or(Some("monte-carlo"), |item| {
        let word = item.text()?;
        let found = kinds.into_iter().find(|k| *k == word);
        if found.is_none() {
            item.error("unknown-word", format!("`{word}` is no design"), &kinds.join(", "));
        }
        found
    });
    let count = |key: &str, usual: Option<usize>, most: usize| {
        let Some(item) = s.get(key) else {
            if usual.is_none() {
                let hint = "how many machines, such as 10000";
                s.error("missing-key", format!("missing entry `{key}` in [design]"), hint);
            }
            return usual;
        };
        let count = item.count()?;
        if !(1..=most).contains(&count) {
            item.error("bad-count", format!("{key} = {count}"), &format!("1 to {most}"));
            return None;
        }
        Some(count)
    };
    let usual_machines = match (kind, changes.machines) {
        (_, Some(machines)) => Some(machines),
        (Some("factorial"), None) => Some(1),
        _ => None,
    };
    let machines = count("machines", usual_machines, MOST_MACHINES);
    let days = count("days", Some(1), MOST_DAYS);
    let seed = s.get("seed").map_or(Some(1), |i| i.count());
    let sensitivity = s.get("sensitivity").map_or(Some(0), |item| {
        let rows = item.count()?;
        if rows != 0 && rows < 16 {
            let hint = "0, or 16 and more; some thousands give intervals of a few hundredths";
            item.error("bad-count", format!("{rows} rows of a sensitivity analysis"), hint);
            return None;
        }
        Some(rows)
    });
    let kind = kind?;
    let spreading = match kind {
        "latin-hypercube" => Spreading::LatinHypercube,
        "sobol" => Spreading::Sobol,
        _ => Spreading::Random,
    };
    Some(Design {
        factorial: kind == "factorial",
        spreading,
        machines: changes.machines.unwrap_or(machines?),
        days: changes.days.unwrap_or(days?),
        seed: changes.seed.unwrap_or(seed? as u64),
        sensitivity: changes.sensitivity.unwrap_or(sensitivity?),
        levels: Vec::new(),
        groups: 0,
    })
}

fn read_requirement(s: &Section<'_>) -> Option<Requirement> {
    let ratio = |item: &Item<'_>| {
        let ratio = item.number()?;
        if !(ratio > 0.0 && ratio <= 1.0) {
            item.error("bad-range", format!("{ratio} is no share"), "above 0, up to 1");
            return None;
        }
        Some(ratio)
    };
    let hint = "the share of machines that must hold their tolerances, such as 0.95";
    let machines = s.require("machines", hint).and_then(|i| ratio(&i));
    let days = s.get("days").map_or(Some(1.0), |i| ratio(&i));
    Some(Requirement { machines_ratio: machines?, days_ratio: days? })
}

/// Two inputs of one name would be drawn alike.
fn check_names(root: &Section<'_>, inputs: &[Input]) -> Option<()> {
    let twice =
        inputs.iter().enumerate().find(|(i, a)| inputs[..*i].iter().any(|b| b.name == a.name));
    if let Some((_, input)) = twice {
        let message = format!("two inputs are called `{}`", input.name);
        root.error("duplicate-input", message, "leave one out, or give it another `name`");
        return None;
    }
    let valued = |input: &Input| match &input.varied {
        Varied::Value(errors) => errors.clone(),
        _ => Vec::new(),
    };
    let all: Vec<_> = inputs.iter().flat_map(valued).collect();
    if let Some((_, error)) = all.iter().enumerate().find(|(i, e)| all[..*i].contains(e)) {
        let message = format!("two inputs state the value of {error}");
        root.error("contradiction", message, "leave one out, or use `added` for it");
        return None;
    }
    let logs = inputs.iter().filter(|i| matches!(i.varied, Varied::Log(_))).count();
    let sensors = |input: &Input| match &input.varied {
        Varied::Temperatures(sensors) => sensors.clone(),
        _ => Vec::new(),
    };
    let sensors: Vec<String> = inputs.iter().flat_map(sensors).collect();
    let twice = sensors.iter().enumerate().find(|(i, s)| sensors[..*i].contains(s));
    if let Some((_, sensor)) = twice {
        let message = format!("two inputs state the temperature of `{sensor}`");
        root.error("contradiction", message, "leave one out");
        return None;
    }
    if logs > 1 {
        let message = format!("{logs} logs of temperatures: only one can hold");
        root.error("contradiction", message, "keep one; other sensors as `temperature`");
        return None;
    }
    Some(())
}

/// An input for each uncertain quantity of the machines; of one name in two cases it is the same quantity.
fn stated_inputs(cases: &[crate::cases::Case], inputs: &[Input]) -> Vec<Input> {
    let mut all: Vec<(String, Option<BodyName>)> = Vec::new();
    for case in cases {
        for quantity in crate::cases::stated_quantities(&case.warm(inputs)) {
            if !all.iter().any(|(name, _)| *name == quantity.0) {
                all.push(quantity);
            }
        }
    }
    let input = |(quantity, body): (String, Option<BodyName>)| Input {
        name: format!("stated: {quantity}"),
        group: body.map_or("stated: others".to_owned(), |body| format!("stated: errors of {body}")),
        level: Level::Machine,
        varied: Varied::Stated(quantity),
        distribution: Distribution::Normal { mean: 0.0, u: 1.0 },
    };
    all.into_iter().map(input).collect()
}

/// Only the outputs that are asked for.
fn keep_outputs(
    wanted: &[Item<'_>],
    item: &Item<'_>,
    cases: &mut [crate::cases::Case],
) -> Option<()> {
    let mut keys = Vec::new();
    let mut sound = true;
    for item in wanted {
        let key = item.text()?;
        if !cases.iter().any(|c| c.outputs.iter().any(|o| o.key == key)) {
            let mut known: Vec<&str> =
                cases.iter().flat_map(|c| c.outputs.iter().map(|o| o.key.as_str())).collect();
            known.dedup();
            item.error(
                "unknown-output",
                format!("no case has the output `{key}`"),
                &known.join(", "),
            );
            sound = false;
        }
        keys.push(key.to_owned());
    }
    if keys.is_empty() {
        item.error(
            "bad-count",
            "no output is asked for".to_owned(),
            "leave it out for all of them",
        );
        return None;
    }
    for case in cases.iter_mut() {
        case.outputs.retain(|o| keys.contains(&o.key));
    }
    sound.then_some(())
}

fn read_correlations(item: &Item<'_>, inputs: &[Input]) -> Option<Correlation> {
    let mut pairs: Vec<(usize, usize, f64)> = Vec::new();
    for one in &item.list()? {
        let pair = one.section("correlation", |s| {
            let of = s.require("of", "the names of two inputs").and_then(|i| Some((i.list()?, i)));
            let coefficient = s.require("coefficient", "between -1 and 1, such as 0.6");
            let number = coefficient.as_ref().and_then(|i| i.number());
            let (names, of) = of?;
            let input = |i: &Item<'_>| {
                let name = i.text()?;
                let found = inputs.iter().position(|input| input.name == name);
                if found.is_none() {
                    let known: Vec<&str> =
                        inputs.iter().map(|i| i.name.as_str()).take(20).collect();
                    i.error(
                        "unknown-input",
                        format!("no input is called `{name}`"),
                        &known.join(", "),
                    );
                }
                found
            };
            let found: Vec<usize> = names.iter().map(input).collect::<Option<_>>()?;
            let [a, b] = found[..] else {
                of.error("bad-count", format!("a correlation of {} inputs", found.len()), "two");
                return None;
            };
            let number = number?;
            if a == b || number.abs() >= 1.0 {
                let message = "this is no correlation of two inputs".to_owned();
                of.error("bad-range", message, "two different inputs, between -1 and 1");
                return None;
            }
            Some((a, b, number))
        });
        let (a, b, number) = pair??;
        if pairs.iter().any(|(c, d, _)| (*c, *d) == (a, b) || (*c, *d) == (b, a)) {
            one.error(
                "duplicate-input",
                "the correlation of these inputs is stated twice".into(),
                "leave one out",
            );
            return None;
        }
        pairs.push((a, b, number));
    }
    let correlation = Correlation::new(&pairs);
    if correlation.is_none() {
        let message =
            "no distribution has these coefficients: their matrix is not positive definite"
                .to_owned();
        let hint = "two inputs that both follow a third one follow each other; state this coefficient too, or smaller ones";
        item.error("not-positive-definite", message, hint);
    }
    correlation
}

fn check_correlation(root: &Section<'_>, study: &Study) -> Option<()> {
    let Some(correlation) = &study.correlation else { return Some(()) };
    let first = *correlation.inputs().first()?;
    for &i in correlation.inputs() {
        let (input, other) = (&study.inputs[i], &study.inputs[first]);
        if study.design.levels.iter().any(|(level, _)| *level == i) {
            let message =
                format!("`{}` has levels of a factorial design: it has no correlation", input.name);
            root.error("contradiction", message, "leave the correlation out, or another design");
            return None;
        }
        if study.design.set(input.level) != study.design.set(other.level) {
            let message =
                format!("`{}` and `{}` are drawn at different times", input.name, other.name);
            root.error("contradiction", message, "the same `per` for both");
            return None;
        }
        if study.design.sensitivity > 0 && input.group != other.group {
            let message = format!(
                "`{}` and `{}` are correlated: their shares of the variance cannot be separated",
                input.name, other.name
            );
            root.error("contradiction", message, "the same `group` for both");
            return None;
        }
    }
    Some(())
}

fn check_design(root: &Section<'_>, study: &Study) -> Option<()> {
    let design = &study.design;
    let refuse = |code, message: String, hint: &str| {
        root.error(code, message, hint);
        None
    };
    if design.factorial && design.levels.is_empty() {
        let hint =
            "value = { values = [\"-20 urad\", \"0 urad\", \"20 urad\"] } for one input or more";
        return refuse("bad-design", "a factorial design has no levels".into(), hint);
    }
    if design.factorial && design.sensitivity > 0 {
        let hint = "leave `sensitivity` out: its table shows the effects; or another design";
        return refuse("bad-design", "a factorial design has no sensitivity analysis".into(), hint);
    }
    if design.combinations() > MOST_COMBINATIONS {
        let message = format!("{} combinations of levels", design.combinations());
        return refuse("bad-design", message, &format!("at most {MOST_COMBINATIONS}"));
    }
    let dimensions =
        if design.sensitivity > 0 { 2 * study.inputs.len() } else { study.inputs.len() };
    if design.spreading == Spreading::Sobol && dimensions > sobol_dimensions() {
        let message = format!("the sequence of Sobol' would need {dimensions} dimensions");
        return refuse(
            "bad-design",
            message,
            &format!("at most {}; or latin-hypercube", sobol_dimensions()),
        );
    }
    let numbers = (design.main_samples() as u128
        + design.sensitivity as u128 * design.row_samples() as u128)
        * study.output_count().max(1) as u128;
    if numbers > Study::MOST_NUMBERS as u128 {
        let message =
            format!("{} samples with {} outputs each", design.samples(), study.output_count());
        let hint = format!(
            "at most {} numbers in all: fewer machines, days or outputs",
            Study::MOST_NUMBERS
        );
        return refuse("bad-design", message, &hint);
    }
    let powers = [("machines", design.machines), ("sensitivity", design.sensitivity)];
    for (what, count) in powers {
        if design.spreading == Spreading::Sobol && count > 0 && !count.is_power_of_two() {
            let message =
                format!("{what} = {count}: the points of Sobol' are even only for powers of two");
            root.warn(
                "bad-design",
                message,
                &format!("{} or {}", count.next_power_of_two() / 2, count.next_power_of_two()),
            );
        }
    }
    Some(())
}

fn check_requirement(root: &Section<'_>, study: &Study) -> Option<()> {
    let judged = study.cases.iter().any(|c| c.outputs.iter().any(|o| o.is_judged()));
    if study.requirement.is_some() && !judged {
        let message = "machines cannot hold tolerances that are not stated".to_owned();
        root.error(
            "no-tolerance",
            message,
            "state them in the test piece or part, or leave [requirement] out",
        );
        return None;
    }
    Some(())
}
