//! `trueaxis evaluate`: readings by ISO 230 and its relatives.

use crate::output::{Answer, Format, Outcome, diagnostic_json, report, show, tell};
use clap::{Args, ValueEnum};
use std::path::{Path, PathBuf};
use trueaxis::files;
use trueaxis::files::disk;
use trueaxis::input::{Diagnostics, Dimension, Place, parse_quantity};
use trueaxis::report::{Evaluation, evaluation_html, evaluation_json, evaluation_text, remarks};
use trueaxis::verify::conditions::{Conditions, read_conditions};
use trueaxis::verify::import::Import;
use trueaxis::verify::write_back::{FIRST_LINE, write_back};
use trueaxis::verify::{Evaluated, Readings, Standard, evaluate_text, iso230_3};

/// The readings to evaluate.
#[derive(Args)]
#[command(after_help = "\
Examples:
  trueaxis evaluate iso230-2 examples/07_verify/x-axis-laser.csv --report x.html
  trueaxis evaluate iso230-2 examples/07_verify/x-axis-laser.csv --format json
  trueaxis evaluate iso230-4 examples/07_verify/circle-xy.csv
  trueaxis evaluate iso230-4 PART.qif --feature \"Circle 1\"
  trueaxis evaluate iso230-2 REPORT.md --import ecmc-md

What is known beside the readings (instrument, temperature, nominal circle) stands in a TOML file of
the same name beside the data, or in the one that --conditions names.

Exit status: 0 done, 2 unusable input; then no report is written.")]
pub struct Arguments {
    /// The standard
    #[arg(value_name = "STANDARD")]
    standard: Name,
    /// The readings: CSV with one line of headings, each with its unit; or a form of --import
    #[arg(value_name = "DATA.csv")]
    data: PathBuf,
    /// The form of the readings; without it by the ending: .qif and .md, else csv
    #[arg(long, value_name = "FORM")]
    import: Option<Form>,
    /// Which feature of a QIF file: its name or its id
    #[arg(long, value_name = "NAME")]
    feature: Option<String>,
    /// Instrument, temperature, nominal circle …, instead of the TOML file beside the data
    #[arg(long, value_name = "FILE.toml")]
    conditions: Option<PathBuf>,
    /// Radius of the nominal circle (iso230-4), mm, instead of that of the conditions
    #[arg(long, value_name = "MM", allow_negative_numbers = true)]
    radius: Option<String>,
    /// Length of the windows of iso230-3, such as "30 min"
    #[arg(long, value_name = "TIME", default_value = "60 min")]
    window: String,
    /// Write the error motion (iso230-2) as a table beside the machine file, for one of its axes
    #[arg(long, num_args = 2, value_names = ["MACHINE.toml", "AXIS"])]
    write_back: Option<Vec<String>>,
    /// Where an HTML report goes
    #[arg(long, value_name = "FILE")]
    report: Option<PathBuf>,
    /// For people or for programs
    #[arg(long, value_enum, default_value = "text")]
    format: Format,
}

/// The forms by their names.
#[derive(Clone, Copy)]
struct Form(Import);

impl ValueEnum for Form {
    fn value_variants<'a>() -> &'a [Self] {
        const { &[Form(Import::ALL[0]), Form(Import::ALL[1]), Form(Import::ALL[2])] }
    }

    fn to_possible_value(&self) -> Option<clap::builder::PossibleValue> {
        Some(clap::builder::PossibleValue::new(self.0.key()).help(self.0.title()))
    }
}

/// The standards by their names.
#[derive(Clone, Copy)]
struct Name(Standard);

impl ValueEnum for Name {
    fn value_variants<'a>() -> &'a [Self] {
        static ALL: [Name; Standard::ALL.len()] = {
            let mut names = [Name(Standard::ALL[0]); Standard::ALL.len()];
            let mut i = 0;
            while i < names.len() {
                names[i] = Name(Standard::ALL[i]);
                i += 1;
            }
            names
        };
        &ALL
    }

    fn to_possible_value(&self) -> Option<clap::builder::PossibleValue> {
        Some(clap::builder::PossibleValue::new(self.0.key()).help(self.0.title()))
    }
}

pub fn run(arguments: &Arguments) -> Outcome {
    let mut problems = Diagnostics::new();
    let (mut conditions, conditions_file) = conditions(arguments, &mut problems);
    if let Some(text) = &arguments.radius {
        let in_mm = format!("{text} mm");
        conditions.circle.radius_mm =
            positive("--radius", &in_mm, Dimension::Length, &mut problems);
    }
    let window_s = positive("--window", &arguments.window, Dimension::Time, &mut problems);
    if let Some(path) = &arguments.report {
        // Before the work, not after it.
        crate::report_file::may_write(path, &crate::report_file::REPORT, &mut problems);
    }
    let file = arguments.data.display().to_string();
    let text = disk().text(&arguments.data, "a table of readings (CSV)", &mut problems);
    let standard = arguments.standard.0;
    let import = arguments.import.map_or_else(|| Import::of(&arguments.data), |form| form.0);
    let evaluated = text.and_then(|text| {
        let readings = Readings {
            standard,
            file: &file,
            text: &text,
            import,
            feature: arguments.feature.as_deref(),
            conditions: &conditions,
            conditions_file: &conditions_file,
            window_s: window_s.unwrap_or(iso230_3::HOUR_S),
        };
        let (evaluated, known) = evaluate_text(&readings, &mut problems);
        conditions = known;
        evaluated
    });
    let table = table(arguments, &file, &conditions, evaluated.as_ref(), &mut problems);
    let list = problems.clone();
    let failed = report(problems);
    let (Some(evaluated), false) = (evaluated, failed) else { return Outcome::Unusable };
    if let Some(table) = &table
        && let Err(outcome) = table.write()
    {
        return outcome;
    }
    answer(arguments, &file, &conditions, &evaluated, &list)
}

/// A table that is to be written beside a machine file.
struct Table {
    path: PathBuf,
    text: String,
    told: String,
}

impl Table {
    fn write(&self) -> Result<(), Outcome> {
        let shown = self.path.display().to_string();
        files::write(&self.path, self.text.as_bytes()).map_err(|e| {
            refuse("unwritable-file", &shown, format!("cannot be written: {e}"), "")
        })?;
        tell(&format!("table: {shown}\n{}", self.told));
        Ok(())
    }
}

/// The table that `--write-back` asks for.
fn table(
    arguments: &Arguments,
    file: &str,
    conditions: &Conditions,
    evaluated: Option<&Evaluated>,
    problems: &mut Diagnostics,
) -> Option<Table> {
    let [machine, letter] = &arguments.write_back.as_ref()?[..] else { return None };
    let Evaluated::Positioning(_, result) = evaluated? else {
        let message = "only a positioning test makes a table".to_owned();
        problems.error("no-table", Place::whole("--write-back"), message, "use iso230-2");
        return None;
    };
    let machine_path = Path::new(machine);
    let (machine, found) = files::machine(machine_path);
    problems.append(found);
    let machine = machine?;
    let Some(index) = crate::arguments::axis_index(&machine, letter) else {
        let message = format!("the machine has no axis `{letter}`");
        let hint = format!("its chain: {}", machine.chain_text());
        problems.error("unknown-axis", Place::whole("--write-back"), message, &hint);
        return None;
    };
    let axis = &machine.axes()[index];
    let back = write_back(axis, result, conditions, file, problems)?;
    let stem = arguments.data.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let name = format!("{stem}-{}.csv", back.error);
    let path = machine_path.with_file_name(&name);
    let ours = |text: String| text.is_empty() || text.starts_with(FIRST_LINE);
    if path.exists() && !std::fs::read_to_string(&path).is_ok_and(ours) {
        let message = "is there, and was not written by this command".to_owned();
        let place = Place::whole(&path.display().to_string());
        problems.error("unwritable-file", place, message, "it is not overwritten; move it away");
        return None;
    }
    let sign = match back.negated {
        true => "sign changed: this body moves against its command (ISO 841)\n",
        false => "",
    };
    let section = back.section(axis, &name, conditions);
    let told = format!(
        "{sign}for the machine file, in place of what it says of {}:\n{section}",
        back.error
    );
    Some(Table { path, text: back.table, told })
}

fn refuse(code: &'static str, place: &str, message: String, hint: &str) -> Outcome {
    let mut problems = Diagnostics::new();
    problems.error(code, Place::whole(place), message, hint);
    report(problems);
    Outcome::Unusable
}

/// A positive quantity of an argument.
fn positive(
    name: &str,
    text: &str,
    dimension: Dimension,
    problems: &mut Diagnostics,
) -> Option<f64> {
    let (code, message, hint) = match parse_quantity(text, dimension) {
        Ok(value) if value > 0.0 => return Some(value),
        Ok(_) => ("not-positive", format!("`{text}` is not positive"), String::new()),
        Err(e) => (e.code(), e.to_string(), e.hint()),
    };
    problems.error(code, Place::whole(name), message, &hint);
    None
}

/// The conditions that were named, or those beside the data.
fn conditions(arguments: &Arguments, problems: &mut Diagnostics) -> (Conditions, String) {
    let beside = arguments.data.with_extension("toml");
    let there = beside.is_file().then_some(&beside);
    let path = arguments.conditions.as_ref().or(there);
    let name = path.unwrap_or(&beside).display().to_string();
    (read_conditions(&disk(), path.map(PathBuf::as_path), problems), name)
}

fn answer(
    arguments: &Arguments,
    file: &str,
    conditions: &Conditions,
    evaluated: &Evaluated,
    problems: &Diagnostics,
) -> Outcome {
    let remarks = remarks(problems);
    let evaluation = Evaluation {
        standard: arguments.standard.0,
        file,
        conditions,
        evaluated,
        remarks: &remarks,
    };
    if let Some(path) = &arguments.report
        && let Err(outcome) = write_page(path, &evaluation)
    {
        return outcome;
    }
    show(&match arguments.format {
        Format::Text => Answer::Text(evaluation_text(&evaluation)),
        Format::Json => {
            let mut document = evaluation_json(&evaluation);
            document["diagnostics"] = problems.iter().map(diagnostic_json).collect();
            Answer::Json(document)
        }
    })
}

fn write_page(path: &Path, evaluation: &Evaluation<'_>) -> Result<(), Outcome> {
    let shown = path.display().to_string();
    let page = evaluation_html(evaluation)
        .map_err(|e| refuse("no-report", &shown, e.to_string(), "leave --report out"))?;
    files::write(path, page.as_bytes()).map_err(|e| {
        let message = format!("cannot be written: {e}");
        refuse("unwritable-file", &shown, message, "name another --report")
    })?;
    tell(&format!("report: {shown}"));
    Ok(())
}
