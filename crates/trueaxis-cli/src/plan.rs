mod surface;

use crate::output::{Answer, Format, Outcome, report, show, tell};
use crate::report_file::{REPORT, may_write, unusable, write_report};
use clap::{Args, Subcommand};
use std::path::PathBuf;
use trueaxis::geometry::input::{Diagnostics, Place};
use trueaxis::identify::design::Design;
use trueaxis::measure::path::Path;
use trueaxis::nc::Control;
use trueaxis::plan::program::{check, program, write_files};
use trueaxis::plan::{Chosen, Plan, choose, expect, read_plan, seen};
use trueaxis::report::{PlanReport, PlannedPath, plan_html, plan_json, plan_text};
use trueaxis::simulate::{CONTROLS, control_named};

/// What to plan.
#[derive(Args)]
#[command(
    args_conflicts_with_subcommands = true,
    after_help = "\
Examples:
  trueaxis plan examples/04_plan/probe-ball.toml
  trueaxis plan examples/04_plan/touch-probe-5-minutes.toml --dialect fanuc -o programs
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
    #[arg(long, value_name = "NAME", default_value = "sinumerik")]
    dialect: String,
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
    let (plan, mut problems) = read_plan(file);
    let control = control_named(&arguments.dialect);
    if control.is_none() {
        let message = format!("`{}` is no control that is known", arguments.dialect);
        problems.error("unknown-control", Place::whole("--dialect"), message, CONTROLS);
    }
    if let Some(path) = &arguments.report {
        may_write(path, &REPORT, &mut problems);
    }
    let chosen = plan.as_ref().and_then(|plan| chosen(plan, file, &mut problems));
    if report(problems) {
        return Outcome::Unusable;
    }
    let (Some(plan), Some(control)) = (plan, control) else { return Outcome::Unusable };
    arguments.planned(&plan, chosen, control).unwrap_or_else(|outcome| outcome)
}

fn chosen(plan: &Plan, file: &std::path::Path, problems: &mut Diagnostics) -> Option<Chosen> {
    match choose(plan, plan.candidates.as_ref()?) {
        Ok(chosen) => Some(chosen),
        Err(why) => {
            let place = Place::whole(&file.display().to_string());
            let hint = "more candidates, a wider [limit], or other [want] errors";
            problems.error("no-choice", place, why, hint);
            None
        }
    }
}

impl CampaignArguments {
    fn planned(
        &self,
        plan: &Plan,
        chosen: Option<Chosen>,
        control: Control,
    ) -> Result<Outcome, Outcome> {
        let design = plan.campaign.design();
        let mut paths = plan.paths.clone();
        if let Some(chosen) = &chosen {
            paths.push(Path {
                name: "chosen".to_owned(),
                stations: chosen.stations.clone(),
                feed_mm_per_s: None,
                dwell_s: 1.0,
            });
        }
        let mut stations = trueaxis::measure::Readings::default();
        paths.iter().for_each(|path| stations.append(&path.stations));
        let mut files = Vec::new();
        let planned = paths
            .into_iter()
            .map(|path| self.planned_path(plan, &design, path, control, &mut files))
            .collect();
        let report = PlanReport {
            plan,
            design: &design,
            expectation: expect(&plan.campaign, &design, &stations),
            paths: planned,
            chosen,
        };
        if let Some(folder) = &self.output {
            written(folder, &files)?;
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

    fn planned_path(
        &self,
        plan: &Plan,
        design: &Design,
        path: Path,
        control: Control,
        files: &mut Vec<(String, Vec<u8>)>,
    ) -> PlannedPath {
        let (campaign, settings) = (&plan.campaign, &plan.program);
        let stem = file_name(&path.name, files.len() / 2 + 1);
        let index = path.stations.instruments.first().copied().unwrap_or(0);
        let instrument = &campaign.instruments[index as usize];
        let table = path.stations.poses(&campaign.machine);
        let text = program(campaign, &path, settings, control);
        let check = match &text {
            Ok(text) => Ok(check(campaign, &path, settings, text, control)),
            Err(error) => Err(error.to_string()),
        };
        if let Ok(text) = text {
            files.push((format!("{stem}.{}", extension(control)), text));
        }
        files.push((format!("{stem}.csv"), table.into_bytes()));
        let channels = instrument.kind.channels();
        PlannedPath { seen: seen(design, &path.stations), channels, path, check }
    }
}

pub fn extension(control: Control) -> &'static str {
    match control {
        Control::Fanuc => "nc",
        Control::LinuxCnc => "ngc",
        Control::Sinumerik840d => "mpf",
        Control::Heidenhain => "h",
    }
}

/// Letters and digits of a name of people; the number keeps two of one name apart.
pub fn file_name(name: &str, number: usize) -> String {
    let plain = |c: char| if c.is_ascii_alphanumeric() { c.to_ascii_lowercase() } else { '-' };
    format!("{number:02}-{}", name.chars().take(40).map(plain).collect::<String>())
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
