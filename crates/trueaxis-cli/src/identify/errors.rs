//! `trueaxis identify CAMPAIGN.toml`: the errors of the machine.

use crate::output::{Answer, Format, Outcome, diagnostic_json, report, show, tell};
use crate::report_file::{REPORT, may_write};
use clap::Args;
use std::path::{Path, PathBuf};
use trueaxis::files;
use trueaxis::files::disk;
use trueaxis::identify::convention::{ConventionCheck, check_conventions};
use trueaxis::identify::errors::{Identification, identify};
use trueaxis::identify::machine_file::machine_file;
use trueaxis::identify::records::{Options, Records, read_options, read_records};
use trueaxis::input::{Diagnostics, Place};
use trueaxis::measure::{Campaign, read_campaign};
use trueaxis::report::{
    IdentificationReport, conventions_json, conventions_text, identification_html,
    identification_json, identification_text,
};

/// What to identify the errors from.
#[derive(Args)]
pub struct CampaignArguments {
    /// The campaign file: machine, instruments with their readings, what is sought
    #[arg(value_name = "CAMPAIGN.toml", required = true)]
    file: Option<PathBuf>,
    /// A machine file with the errors that were found, their uncertainties and where they come from
    #[arg(short, long, value_name = "MACHINE.toml")]
    output: Option<PathBuf>,
    /// Where an HTML report goes
    #[arg(long, value_name = "FILE")]
    report: Option<PathBuf>,
    /// Try sign, order, sense, side and unit of the readings, and name what fits far better
    #[arg(long)]
    check_conventions: bool,
    /// For people or for programs
    #[arg(long, value_enum, default_value = "text")]
    format: Format,
}

pub fn run(arguments: &CampaignArguments) -> Outcome {
    let Some(file) = &arguments.file else { return Outcome::Unusable };
    let mut problems = Diagnostics::new();
    let (read, found) = read_campaign(&disk(), file, |root, _| Some(read_options(root)));
    problems.append(found);
    if let Some(path) = &arguments.report {
        may_write(path, &REPORT, &mut problems);
    }
    let Some((campaign, options)) = read else {
        report(problems);
        return Outcome::Unusable;
    };
    if let Some(output) = &arguments.output {
        check_output(output, &campaign, &mut problems);
    }
    let Some(records) = read_records(&campaign, &mut problems) else {
        report(problems);
        return Outcome::Unusable;
    };
    let found = match problems.has_errors() {
        true => None,
        false => identify(&campaign, &options, &records, &mut problems),
    };
    let asked = arguments.check_conventions && !records.readings.is_empty();
    let asked = asked.then(|| check_conventions(&campaign.design(), &records.readings));
    match found.filter(|_| !problems.has_errors()) {
        Some(found) => {
            let work = Work { arguments, campaign, options, records, found, asked };
            work.answer(problems)
        }
        None => {
            if let (Some(check), Format::Text) = (&asked, arguments.format) {
                tell(&conventions_text(check));
            } else if let Some(check) = &asked {
                tell(&conventions_json(check).to_string());
            }
            report(problems);
            Outcome::Unusable
        }
    }
}

/// The input is never overwritten, nor anything that is no machine file.
fn check_output(output: &Path, campaign: &Campaign, problems: &mut Diagnostics) {
    let same = |a: &Path, b: &Path| match (a.canonicalize(), b.canonicalize()) {
        (Ok(a), Ok(b)) => a == b,
        _ => a == b,
    };
    let place = Place::whole(&output.display().to_string());
    if same(output, &campaign.machine_path) || same(output, &campaign.path) {
        let message = "is the input, which is not overwritten".to_owned();
        problems.error("unwritable-file", place, message, "name another file: -o identified.toml");
        return;
    }
    let ours = |text: String| text.is_empty() || text.contains("[machine]");
    if output.is_dir() || output.exists() && !std::fs::read_to_string(output).is_ok_and(ours) {
        let message = "is there, and is no machine file".to_owned();
        problems.error("unwritable-file", place, message, "it is not overwritten; name another -o");
    }
}

struct Work<'a> {
    arguments: &'a CampaignArguments,
    campaign: Campaign,
    options: Options,
    records: Records,
    found: Identification,
    asked: Option<ConventionCheck>,
}

impl Work<'_> {
    fn answer(&self, mut problems: Diagnostics) -> Outcome {
        let written = self.arguments.output.as_deref().map(|path| self.write(path, &mut problems));
        let list = problems.clone();
        if report(problems) || written == Some(None) {
            return Outcome::Unusable;
        }
        let told = IdentificationReport {
            campaign: &self.campaign,
            options: &self.options,
            records: &self.records,
            found: &self.found,
            conventions: self.asked.as_ref().or(self.found.conventions.as_ref()),
        };
        if let Some(path) = &self.arguments.report {
            let page = Ok(identification_html(&told));
            if let Err(outcome) = crate::report_file::write_report(path, page) {
                return outcome;
            }
        }
        let shown = show(&match self.arguments.format {
            Format::Text => Answer::Text(identification_text(&told)),
            Format::Json => {
                let mut document = identification_json(&told);
                document["diagnostics"] = list.iter().map(diagnostic_json).collect();
                Answer::Json(document)
            }
        });
        match shown {
            Outcome::Done if !self.found.verdict.is_good() => Outcome::No,
            shown => shown,
        }
    }

    /// Writes the machine file and the tables that it names.
    fn write(&self, output: &Path, problems: &mut Diagnostics) -> Option<()> {
        let old = disk().text(&self.campaign.machine_path, "the machine file", problems)?;
        let shown = output.display().to_string();
        let beside = trueaxis::machine::file::Folder::of(&disk(), output);
        let date = self.options.date.as_deref();
        let made = machine_file(&self.campaign, &self.found, date, &old, &beside);
        let refuse = |message: String, hint: &str, problems: &mut Diagnostics| {
            problems.error("unwritable-file", Place::whole(&shown), message, hint);
        };
        let made = match made {
            Ok(made) => made,
            Err(reason) => {
                let message = format!("the machine file cannot be edited: {reason}");
                let hint = "put it beside the machine file if that names tables";
                refuse(message, hint, problems);
                return None;
            }
        };
        for (name, text) in &made.tables {
            if let Err(e) = files::write(&output.with_file_name(name), text.as_bytes()) {
                refuse(format!("{name} cannot be written: {e}"), "", problems);
                return None;
            }
        }
        match files::write(output, made.text.as_bytes()) {
            Ok(()) => tell(&format!("machine file: {shown}")),
            Err(e) => {
                refuse(format!("cannot be written: {e}"), "name another -o", problems);
                return None;
            }
        }
        Some(())
    }
}
