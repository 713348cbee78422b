//! What a certificate was made from: every file with its SHA-256, so that anybody can make it again.

use sha2::{Digest, Sha256};
use std::cell::RefCell;
use std::path::{Path, PathBuf};
use trueaxis_input::plausible::Limits;
use trueaxis_input::{Diagnostics, Files};
use trueaxis_machine::Machine;
use trueaxis_machine::file::{Folder, Tables};

/// A file that went into a certificate.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Input {
    /// What it is.
    pub role: &'static str,
    /// Its name as the study gives it, without the folders of this machine.
    pub name: String,
    /// SHA-256 of its bytes, 64 hexadecimal digits.
    pub sha256: String,
}

/// The files of a study, in the order in which they were read.
#[derive(Debug)]
pub struct Inputs {
    files: Files,
    /// Names are relative to this folder.
    folder: PathBuf,
    list: Vec<Input>,
    /// What readings may be.
    pub limits: Limits,
}

impl Inputs {
    /// Of a study that stands in this folder.
    pub fn beside(files: &Files, folder: &Path) -> Self {
        let (list, limits) = (Vec::new(), Limits::default());
        Self { files: files.clone(), folder: folder.to_owned(), list, limits }
    }

    /// Takes a file into the list; each only once.
    pub fn add(&mut self, role: &'static str, name: &str, content: &[u8]) {
        let input = Input { role, name: name.to_owned(), sha256: sha256(content) };
        if !self.list.iter().any(|i| i.name == input.name) {
            self.list.push(input);
        }
    }

    /// Reads a text that the study names.
    pub fn text(
        &mut self,
        role: &'static str,
        name: &str,
        problems: &mut Diagnostics,
    ) -> Option<(PathBuf, String)> {
        let path = self.folder.join(name);
        let text = self.files.text(&path, role, problems)?;
        self.add(role, name, text.as_bytes());
        Some((path, text))
    }

    /// Reads any file that the study names.
    pub fn bytes(
        &mut self,
        role: &'static str,
        name: &str,
        problems: &mut Diagnostics,
    ) -> Option<Input> {
        let content = self.files.bytes(&self.folder.join(name), role, problems)?;
        self.add(role, name, &content);
        Some(Input { role, name: name.to_owned(), sha256: sha256(&content) })
    }

    /// Reads a machine file and the tables that it names.
    pub fn machine(
        &mut self,
        role: &'static str,
        name: &str,
        problems: &mut Diagnostics,
    ) -> Option<Machine> {
        let (path, text) = self.text(role, name, problems)?;
        let seen = Seen { folder: Folder::of(&self.files, &path), texts: RefCell::default() };
        let machine = problems.keep(Machine::check(&path.display().to_string(), &text, &seen));
        let beside = Path::new(name).parent().unwrap_or(Path::new(""));
        for (table, text) in seen.texts.into_inner() {
            let name = beside.join(table).display().to_string();
            self.add("error table of the machine", &name, text.as_bytes());
        }
        machine
    }

    /// All of them.
    pub fn finish(self) -> Vec<Input> {
        self.list
    }
}

/// The tables beside a machine file, and which of them were read.
struct Seen {
    folder: Folder,
    texts: RefCell<Vec<(String, String)>>,
}

impl Tables for Seen {
    fn text(&self, name: &str) -> Result<String, String> {
        let text = self.folder.text(name)?;
        self.texts.borrow_mut().push((name.to_owned(), text.clone()));
        Ok(text)
    }

    fn display(&self, name: &str) -> String {
        self.folder.display(name)
    }
}

/// SHA-256 as 64 hexadecimal digits.
///
/// ```
/// // FIPS 180-4, the example of one block.
/// let abc = trueaxis::verify::certificate::inputs::sha256(b"abc");
/// assert_eq!(abc, "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
/// ```
pub fn sha256(content: &[u8]) -> String {
    Sha256::digest(content).iter().map(|byte| format!("{byte:02x}")).collect()
}
