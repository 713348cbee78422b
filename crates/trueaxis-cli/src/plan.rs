//! `trueaxis plan`: what a measurement will show, and its programs.

mod surface;

use crate::arguments::control;
use crate::output::{Answer, Format, Outcome, report, show, tell};
use crate::report_file::{REPORT, may_write, unusable, write_report};
use clap::{Args, Subcommand};
use std::path::PathBuf;
use trueaxis::files::disk;
use trueaxis::files::write_files;
use trueaxis::nc::Control;
use trueaxis::plan::{Chosen, Plan, chosen, planned, read_plan};
use trueaxis::report::{plan_html, plan_json, plan_text};

/// What to plan.
#[derive(Args)]
#[command(
    args_conflicts_with_subcommands = true,
    after_help = "\
Examples:
  trueaxis plan examples/04_plan/probe-ball.toml
  trueaxis plan examples/04_plan/touch-probe-5-minutes.toml --control fanuc -o programs
  trueaxis plan CAMPAIGN.toml --format json
  trueaxis plan probe-surface examples/04_plan/probe-surface.toml -o programs

Says before anybody measures what each path sees, how well every error will be known, what cannot be
told apart and what would tell it. Exit status: 0 done, 1 a program would run into something or leave
the travel, 2 unusable input."
)]
pub struct Arguments {
    #[command(subcommand)]
    what: Option<What>,
    #[command(flatten)]
    campaign: CampaignArguments,
}

#[derive(Subcommand)]
enum What {
    /// A probing path over a surface, from cutter locations or an STL file
    ProbeSurface(surface::Arguments),
}

/// The campaign.
#[derive(Args)]
struct CampaignArguments {
    /// The campaign: machine, unknowns, instruments, paths
    #[arg(value_name = "CAMPAIGN.toml", required = true)]
    file: Option<PathBuf>,
    /// Whose NC programs: sinumerik, fanuc, linuxcnc or heidenhain
    #[arg(long, alias = "dialect", value_name = "NAME", default_value = "sinumerik")]
    control: String,
    /// Write one program and one table of poses per path into this folder
    #[arg(short, long, value_name = "FOLDER")]
    output: Option<PathBuf>,
    /// Write a report
    #[arg(long, value_name = "FILE.html")]
    report: Option<PathBuf>,
    /// For people or for programs
    #[arg(long, value_enum, default_value = "text")]
    format: Format,
}

pub fn run(arguments: &Arguments) -> Outcome {
    match &arguments.what {
        Some(What::ProbeSurface(arguments)) => surface::run(arguments),
        None => run_campaign(&arguments.campaign),
    }
}

fn run_campaign(arguments: &CampaignArguments) -> Outcome {
    let Some(file) = &arguments.file else { return Outcome::Unusable };
    let (plan, mut problems) = read_plan(&disk(), file);
    let control = control(&arguments.control, &mut problems);
    if let Some(path) = &arguments.report {
        may_write(path, &REPORT, &mut problems);
    }
    let chosen = plan.as_ref().and_then(|plan| chosen(plan, &mut problems));
    if report(problems) {
        return Outcome::Unusable;
    }
    let (Some(plan), Some(control)) = (plan, control) else { return Outcome::Unusable };
    arguments.planned(&plan, chosen, control).unwrap_or_else(|outcome| outcome)
}

impl CampaignArguments {
    fn planned(
        &self,
        plan: &Plan,
        chosen: Option<Chosen>,
        control: Control,
    ) -> Result<Outcome, Outcome> {
        let design = plan.campaign.design();
        let report = planned(plan, &design, chosen, control);
        if let Some(folder) = &self.output {
            let files = report.paths.iter().flat_map(|path| path.files.iter().cloned());
            written(folder, &files.collect::<Vec<_>>())?;
        }
        if let Some(path) = &self.report {
            write_report(path, Ok(plan_html(&report)))?;
        }
        let outcome = show(&match self.format {
            Format::Json => Answer::Json(plan_json(&report)),
            Format::Text => Answer::Text(plan_text(&report)),
        });
        let sound = report.paths.iter().all(|p| p.check.as_ref().is_ok_and(|c| c.is_sound()));
        Ok(if outcome == Outcome::Done && !sound { Outcome::No } else { outcome })
    }
}

pub fn written(folder: &std::path::Path, files: &[(String, Vec<u8>)]) -> Result<(), Outcome> {
    let shown = folder.display().to_string();
    let refuse = |error: std::io::Error| {
        let message = format!("cannot be written: {error}");
        unusable("unwritable-file", &shown, &message, "name another folder with -o")
    };
    std::fs::create_dir_all(folder).map_err(refuse)?;
    for path in write_files(folder, files).map_err(refuse)? {
        tell(&format!("written: {}", path.display()));
    }
    Ok(())
}
