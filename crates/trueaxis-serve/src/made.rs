//! Files that an answer made: kept for download and for saving, byte for byte as the command line writes them.

use crate::body::short;
use crate::desk::Desk;
use crate::project::version;
use crate::refusal::Refusal;
use serde::Serialize;
use std::path::Path;
use trueaxis::JsonSchema;
use trueaxis::files;
use trueaxis::files::output::{Guard, same_file};
use trueaxis::input::Diagnostics;
use trueaxis::questions::{Content, NewFile};

/// Characters of a file that go to the page with the answer.
const SHOWN: usize = 16_000;

/// The files of one answer.
pub(crate) struct Made {
    pub(crate) files: Vec<MadeFile>,
    /// What they were made from, each with its version at that time.
    from: Vec<(String, String)>,
}

/// One file, on no disk yet.
pub(crate) struct MadeFile {
    /// Its place below the project folder.
    pub(crate) name: String,
    pub(crate) content: Vec<u8>,
}

/// The files that an answer made.
#[derive(Debug, Serialize, JsonSchema)]
pub(crate) struct MadeEntry {
    /// Their number on the server, for `save-made` and the address `/made/NUMBER/FILE`; only the last few are kept.
    number: u64,
    /// The files.
    files: Vec<MadeFileEntry>,
}

/// A file that can be downloaded or saved.
#[derive(Debug, Serialize, JsonSchema)]
pub(crate) struct MadeFileEntry {
    /// Where it would go, below the project folder.
    name: String,
    /// Its size in bytes.
    bytes: usize,
    /// Its beginning; what is not UTF-8 is shown as replacement characters.
    beginning: String,
    /// Whether that is all of it.
    whole: bool,
}

impl MadeFileEntry {
    fn of(file: &MadeFile) -> Self {
        let whole = file.content.len() <= SHOWN;
        let shown = &file.content[..file.content.len().min(SHOWN)];
        let mut beginning = String::from_utf8_lossy(shown).into_owned();
        if !whole {
            // Whole lines only.
            beginning.truncate(beginning.rfind('\n').map_or(beginning.len(), |at| at + 1));
        }
        Self { name: file.name.clone(), bytes: file.content.len(), beginning, whole }
    }
}

/// The versions of files that are read for an answer, before it is made.
pub(crate) fn versions<'n>(
    desk: &Desk,
    names: impl IntoIterator<Item = &'n String>,
) -> Vec<(String, String)> {
    let one = |name: &String| {
        let content = files::read_bytes(&desk.project.path(name).ok()?).ok()?;
        Some((name.clone(), version(&content)))
    };
    names.into_iter().filter_map(one).collect()
}

impl Desk {
    /// Keeps the files of an answer.
    pub(crate) fn keep(&self, new: Vec<NewFile>, from: Vec<(String, String)>) -> MadeEntry {
        let each = new.into_iter().flat_map(|file| {
            let name = shown(&file.path);
            match file.content {
                Content::Bytes(content) => vec![MadeFile { name, content: content.into_vec() }],
                Content::Folder(all) => {
                    let inside = |(file, text): (String, String)| MadeFile {
                        name: format!("{name}/{file}"),
                        content: text.into_bytes(),
                    };
                    all.into_iter().map(inside).collect()
                }
                // Written beside its place: no question of the page asks for one.
                Content::Part(_) => Vec::new(),
            }
        });
        let files: Vec<MadeFile> = each.collect();
        let entries = files.iter().map(MadeFileEntry::of).collect();
        let (number, _) = self.made.put(Made { files, from });
        MadeEntry { number, files: entries }
    }

    /// A file that is kept.
    pub(crate) fn made_file<T>(
        &self,
        number: u64,
        file: usize,
        take: impl FnOnce(&Made, &MadeFile) -> T,
    ) -> Result<T, Refusal> {
        let made = self.made.of_number(number);
        made.as_ref().and_then(|made| Some(take(made, made.files.get(file)?))).ok_or_else(|| {
            let message = "this file is gone: only the last few are kept";
            Refusal::new(404, "gone", message, "make it again")
        })
    }
}

/// The name of a path with `/`.
fn shown(path: &Path) -> String {
    path.display().to_string().replace('\\', "/")
}

impl Made {
    /// Puts a file into the project by the rule of all commands: what stands there is replaced only if this program wrote
    /// it and it was not edited since; a file that was read for it never. The new version.
    pub(crate) fn save(&self, desk: &Desk, file: &MadeFile, name: &str) -> Result<String, Refusal> {
        let path = desk.project.path(name)?;
        if path.extension() != Path::new(&file.name).extension() {
            let message = format!("`{}` has another ending than {}", short(name), file.name);
            return Err(Refusal::new(403, "not-written", message, "keep the ending of its name"));
        }
        let conflict =
            |message: String, hint: &str| Err(Refusal::new(409, "conflict", message, hint));
        for (read, old) in &self.from {
            let from = desk.project.path(read)?;
            if same_file(&path, &from) {
                let message = format!("{name} is what it was made from");
                return conflict(message, "save under another name");
            }
            if files::read_bytes(&from).is_ok_and(|content| version(&content) != *old) {
                let message = format!("{read} was changed since this was made from it");
                return conflict(message, "make it again");
            }
        }
        let mut problems = Diagnostics::new();
        Guard::default().may_put(&path, Some(&file.content), &mut problems);
        if let Some(kept) = problems.iter().next() {
            let message = format!("{name} {}", kept.message);
            return conflict(message, "save under another name: nothing is replaced");
        }
        let content = Content::Bytes(file.content.clone().into());
        NewFile { name: "", path, content }.write().map_err(|e| {
            Refusal::new(422, "unwritable-file", format!("{name} cannot be written: {e}"), "")
        })?;
        Ok(version(&file.content))
    }
}
