//! A machine file with the tables that it names, as a new folder.

use super::{Content, NewFile};
use std::path::Path;
use trueaxis_input::{Diagnostics, Place};

/// A machine file that was made.
pub(super) struct MadeMachine {
    /// Its text.
    pub text: String,
    /// Name and text of the tables that it names.
    pub tables: Vec<(String, String)>,
    /// The files of solid models that it names.
    pub models: Vec<String>,
}

/// The folder with the machine file under its old name, its tables and some more files; and what to say of it.
pub(super) fn machine_folder(
    folder: &Path,
    machine_path: &Path,
    made: MadeMachine,
    more: Vec<(String, String)>,
    problems: &mut Diagnostics,
) -> Option<(NewFile, Vec<String>)> {
    if let Some((table, _)) = made.tables.iter().find(|(name, _)| name.contains(['/', '\\'])) {
        let place = Place::whole(&machine_path.display().to_string());
        let message = format!("its table `{table}` stands in another folder and cannot be copied");
        let hint = "put the tables beside the machine file";
        problems.error("unwritable-folder", place, message, hint);
        return None;
    }
    let name = machine_path.file_name().map_or("machine.toml".into(), |n| n.to_string_lossy());
    let mut written = vec![(name.into_owned(), made.text)];
    written.extend(made.tables);
    written.extend(more);
    let notes = match made.models.is_empty() {
        true => Vec::new(),
        false => {
            vec![format!("copy the models into the folder yourself: {}", made.models.join(", "))]
        }
    };
    let file = NewFile {
        name: "machine file with its tables",
        path: folder.to_owned(),
        content: Content::Folder(written),
    };
    Some((file, notes))
}
