//! Are the tables in the control those of this machine? By SHA-256, file by file.

use super::applied::AppliedCompensation;
use super::inputs::{Input, Inputs, sha256};
use trueaxis_input::{Diagnostics, Section};

/// The compiled files with their hashes, and the folder they were compared with: `loaded = "FOLDER"` holds
/// what the control has loaded. A file that is missing or has another content is an error.
pub fn check_loaded(
    section: &Section<'_>,
    applied: &AppliedCompensation,
    inputs: &mut Inputs,
) -> Option<(Vec<Input>, Option<String>)> {
    let AppliedCompensation::Tables { compiled, .. } = applied else {
        return Some((Vec::new(), None));
    };
    let made: Vec<Input> = compiled
        .files
        .iter()
        .map(|file| Input {
            role: "compensation table",
            name: file.name.clone(),
            sha256: sha256(file.text.as_bytes()),
        })
        .collect();
    let Some(item) = section.get("loaded") else { return Some((made, None)) };
    let folder = item.text()?;
    let mut sound = true;
    for file in &made {
        let mut problems = Diagnostics::new();
        let name = format!("{}/{}", folder.trim_end_matches('/'), file.name);
        let read = inputs.bytes("loaded compensation table", &name, &mut problems);
        section.take_over(problems);
        let Some(read) = read else {
            sound = false;
            continue;
        };
        if read.sha256 != file.sha256 {
            let message = format!(
                "{name} is not what this machine file compiles to: SHA-256 {}, expected {}",
                read.sha256, file.sha256
            );
            let hint =
                "compile and load the tables again, or name the machine file they were made from";
            item.error("other-table", message, hint);
            sound = false;
        }
    }
    sound.then(|| (made, Some(folder.to_owned())))
}
