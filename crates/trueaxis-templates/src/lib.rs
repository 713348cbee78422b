//! What does a folder of my own begin with? Machine, part, program, set-up, study and campaign as texts with comments.
//!
//! ```
//! use trueaxis_templates::{Kind, texts};
//! let files = texts(Kind::TableTable, "engraver");
//! let machine = files.iter().find(|file| file.name == "machine.toml").expect("a machine");
//! assert!(machine.text.contains("chain = \"w C' A' b X Y Z t\""));
//! assert!(machine.text.contains("name = \"engraver\""));
//! ```

mod answers;

pub use answers::{Answers, Travel, WrongAnswer, machine_file};

use serde::Serialize;
use trueaxis_report::JsonSchema;

/// The kind of machine, by what its rotary axes carry.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// X Y Z alone.
    ThreeAxis,
    /// Both carry the workpiece.
    TableTable,
    /// Both carry the tool.
    HeadHead,
    /// One carries the workpiece, one the tool.
    HeadTable,
}

impl Kind {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::ThreeAxis, Self::TableTable, Self::HeadHead, Self::HeadTable];

    /// Its name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::ThreeAxis => "three-axis",
            Self::TableTable => "table-table",
            Self::HeadHead => "head-head",
            Self::HeadTable => "head-table",
        }
    }

    fn machine(self) -> &'static str {
        match self {
            Self::ThreeAxis => include_str!("texts/machine-three-axis.toml"),
            Self::TableTable => include_str!("texts/machine-table-table.toml"),
            Self::HeadHead => include_str!("texts/machine-head-head.toml"),
            Self::HeadTable => include_str!("texts/machine-head-table.toml"),
        }
    }

    /// The rotary axis of its template that tilts.
    fn tilting(self) -> Option<char> {
        self.ball().and_then(|(_, tilts)| tilts.chars().next())
    }

    /// What a ball on the table is asked for: the unknown location errors, and the rotary axis that tilts; nothing without rotary axes.
    fn ball(self) -> Option<(&'static str, &'static str)> {
        match self {
            Self::ThreeAxis => None,
            Self::TableTable => {
                Some(("EX0C EY0C EA0C EB0C EY0A EZ0A EB0A EC0A EC0Y EA0Z EB0Z", "A"))
            }
            Self::HeadHead => Some(("EA0C EB0C EY0A EB0A EC0A EX0t EY0t EC0Y EA0Z EB0Z", "A")),
            Self::HeadTable => Some(("EX0C EY0C EA0C EB0C EX0t EA0B EC0B EC0Y EA0Z EB0Z", "B")),
        }
    }

    fn campaign(self) -> String {
        let Some((errors, tilts)) = self.ball() else {
            return include_str!("texts/campaign-ball-bar.toml").to_owned();
        };
        let errors: Vec<String> = errors.split(' ').map(|e| format!("\"{e}\"")).collect();
        let poses =
            format!("{tilts} = [\"-60 deg\", \"60 deg\", 7]\nC = [\"-180 deg\", \"150 deg\", 12]");
        include_str!("texts/campaign-ball.toml")
            .replace("LOCATIONS", &errors.join(", "))
            .replace("CANDIDATES", &poses)
    }
}

/// A file of the new folder.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct NewText {
    /// Its name in the folder.
    pub name: &'static str,
    /// Its text.
    pub text: String,
}

/// The files of a new folder for a machine of this kind and name.
pub fn texts(kind: Kind, name: &str) -> Vec<NewText> {
    let all = [
        ("README.md", include_str!("texts/README.md").replace("NAME", name)),
        ("machine.toml", kind.machine().replace("NAME", name)),
        ("part.toml", include_str!("texts/part.toml").to_owned()),
        ("part.nc", include_str!("texts/part.nc").to_owned()),
        ("part.setup.toml", include_str!("texts/part.setup.toml").to_owned()),
        ("study.toml", include_str!("texts/study.toml").to_owned()),
        ("campaign.toml", kind.campaign()),
    ];
    all.into_iter().map(|(name, text)| NewText { name, text }).collect()
}

/// The commands to try in a new folder, in their order.
pub const FIRST_COMMANDS: [&str; 4] = [
    "trueaxis check machine.toml",
    "trueaxis simulate machine.toml part.nc",
    "trueaxis predict study.toml --report predict.html",
    "trueaxis plan campaign.toml",
];

/// A new folder.
#[derive(Debug, Serialize, JsonSchema)]
pub struct NewFolderDocument<'a> {
    /// Which document this is.
    #[schemars(extend("const" = "trueaxis/new/1"))]
    pub schema: &'static str,
    /// The folder.
    pub folder: &'a str,
    /// The kind of machine.
    pub kind: &'static str,
    /// The names of its files.
    pub files: Vec<&'static str>,
    /// The commands to try there, in their order.
    pub commands: [&'static str; 4],
}

/// The JSON Schemas of the documents of this crate, by name.
#[cfg(feature = "schemas")]
pub fn schemas() -> Vec<trueaxis_report::NamedSchema> {
    use trueaxis_report::named_schema;
    vec![named_schema::<NewFolderDocument<'_>>("new")]
}
