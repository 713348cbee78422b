//! `trueaxis live part`: which part is being made, and what acted while it was.

use super::refuse;
use crate::door::DoorArguments;
use crate::output::{Answer, Format, Outcome, show};
use clap::Args;
use std::path::{Path, PathBuf};
use trueaxis::files::disk;
use trueaxis::input::Place;
use trueaxis_live::file::read_plan;
use trueaxis_live::parts::LivePart;
use trueaxis_live::status::folder_of;
use trueaxis_live::store::{PartFault, begin_part, end_part, is_running};

/// The plan, and what is asked of its parts.
#[derive(Args)]
#[command(after_help = "\
Examples:
  trueaxis live part examples/08_live/gantry-mock.toml --begin ARM-0417
  trueaxis live part examples/08_live/gantry-mock.toml --end
  trueaxis live part examples/08_live/gantry-mock.toml --show ARM-0417

From --begin to --end the run writes a row at the end of each block, and wherever X and Y have stood: position, what
acted, what was missing, temperatures. trueaxis predict reads it ([compensation] acted = \"…/parts/ARM-0417.csv\") and says
where the holes are. Without any of the three: which parts there are. Exit status: 0 done, 2 unusable input.")]
pub struct PartArguments {
    /// The plan
    #[arg(value_name = "LIVE.toml")]
    plan: PathBuf,
    /// This part is made from now on
    #[arg(long, value_name = "NAME", conflicts_with_all = ["end", "show"])]
    begin: Option<String>,
    /// The part is finished
    #[arg(long, conflicts_with = "show")]
    end: bool,
    /// What acted while this part was made
    #[arg(long, value_name = "NAME")]
    show: Option<String>,
    #[command(flatten)]
    door: DoorArguments,
}

pub fn run(arguments: &PartArguments) -> Outcome {
    match (&arguments.begin, arguments.end) {
        (None, false) => {
            let (plan, part) = (arguments.plan.clone(), arguments.show.clone());
            arguments.door.door().ask(&LivePart { plan, part })
        }
        (begin, _) => order(&arguments.plan, begin.as_deref()),
    }
}

/// A part begins, or the one that is made ends.
fn order(plan: &Path, begin: Option<&str>) -> Outcome {
    let (read, mut problems) = read_plan(&disk(), plan);
    let folder = read.as_ref().and_then(|plan| folder_of(plan, &mut problems));
    let (Some(read), Some(folder)) = (read, folder) else { return refuse(problems, Format::Text) };
    let done = match begin {
        Some(name) => begin_part(&folder, &read, name).map(|()| {
            let when = if is_running(&folder) { "" } else { " when a run of this plan begins" };
            format!("the record of {name} begins{when}\n")
        }),
        None => end_part(&folder).map_err(PartFault::Disk).map(|name| match name {
            Some(name) => format!("the record of {name} ends\n"),
            None => "no part was recorded\n".to_owned(),
        }),
    };
    match done {
        Ok(text) => show(&Answer::Text(text)),
        Err(fault) => {
            let place = Place::whole(&plan.display().to_string());
            problems.error(
                "live-part",
                place,
                fault.to_string(),
                "give another name, as the user who has started the run",
            );
            refuse(problems, Format::Text)
        }
    }
}
