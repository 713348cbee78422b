//! `trueaxis new`: a folder with a machine, a part, a program, a study and a campaign to begin with.

use crate::output::{Answer, Format, Outcome, report, show, tell};
use clap::{Args, ValueEnum};
use std::path::PathBuf;
use trueaxis::files::output::may_fill;
use trueaxis::files::write_folder;
use trueaxis::input::Diagnostics;
use trueaxis_templates::{FIRST_COMMANDS, Kind, NewFolderDocument, texts};

/// Which folder, and for which machine.
#[derive(Args)]
#[command(after_help = "\
Examples:
  trueaxis new my-machine
  trueaxis new gantry --kind head-head --name \"gantry in hall 3\"

Writes machine.toml, part.toml, part.nc, part.setup.toml, study.toml, campaign.toml and README.md, which says
what to do with them. Numbers of your machine are marked with CHANGE; every command runs before you change them.
The folder must be new or empty.
Exit status: 0 written, 2 the folder is not empty or cannot be written.")]
pub struct Arguments {
    /// The new folder
    folder: PathBuf,
    /// What carries the rotary axes
    #[arg(long, value_enum, default_value = "three-axis")]
    kind: KindName,
    /// The name of the machine [default: that of the folder]
    #[arg(long)]
    name: Option<String>,
    /// Output as text or as one JSON document
    #[arg(long, value_enum, default_value = "text")]
    format: Format,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum KindName {
    /// X, Y and Z alone
    ThreeAxis,
    /// Both rotary axes carry the workpiece: a tilting rotary table
    TableTable,
    /// Both carry the tool: a fork head
    HeadHead,
    /// One carries the workpiece, one the tool: a rotary table and a swivelling head
    HeadTable,
}

impl KindName {
    fn kind(self) -> Kind {
        match self {
            Self::ThreeAxis => Kind::ThreeAxis,
            Self::TableTable => Kind::TableTable,
            Self::HeadHead => Kind::HeadHead,
            Self::HeadTable => Kind::HeadTable,
        }
    }
}

pub fn run(arguments: &Arguments) -> Outcome {
    let folder = &arguments.folder;
    let shown = folder.display().to_string();
    let of_folder = || folder.file_name().map(|name| name.to_string_lossy().into_owned());
    let name = arguments.name.clone().or_else(of_folder).unwrap_or_else(|| "machine".to_owned());
    if let Some(wrong) = name.chars().find(|c| c.is_control() || matches!(c, '"' | '\\')) {
        tell(&format!(
            "error: the name of a machine cannot contain {wrong:?}\n  hint: --name \"my machine\""
        ));
        return Outcome::Unusable;
    }
    let kind = arguments.kind.kind();
    let files = texts(kind, &name);
    let mut problems = Diagnostics::new();
    may_fill(folder, &mut problems);
    if report(problems) {
        return Outcome::Unusable;
    }
    let texts: Vec<(String, String)> =
        files.iter().map(|file| (file.name.to_owned(), file.text.clone())).collect();
    if let Err(why) = write_folder(folder, &texts) {
        tell(&format!("error[unwritable-folder]: {shown}: cannot be written: {why}"));
        return Outcome::Unusable;
    }
    let files: Vec<&str> = files.iter().map(|file| file.name).collect();
    show(&match arguments.format {
        Format::Json => {
            let (schema, commands) = ("trueaxis/new/1", FIRST_COMMANDS);
            let document =
                NewFolderDocument { schema, folder: &shown, kind: kind.name(), files, commands };
            Answer::Json(serde_json::to_value(&document).unwrap_or_default())
        }
        Format::Text => Answer::Text(format!(
            "{shown}\n  {}\n\nNext\n  cd {shown}\n  {}\n  README.md there says what each file is for.\n",
            files.join("  "),
            FIRST_COMMANDS.join("\n  ")
        )),
    })
}
