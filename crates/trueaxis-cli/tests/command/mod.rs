//! The built command as a user runs it: from the root of the repository.

// Each test program uses a part of this file.
#![allow(dead_code)]

use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// What a run has written.
pub struct Ran {
    /// Exit status.
    pub status: i32,
    /// Standard output.
    pub out: String,
    /// Standard error.
    pub err: String,
}

impl Ran {
    /// The one JSON document on standard output.
    pub fn json(&self) -> Value {
        serde_json::from_str(&self.out).unwrap_or_else(|e| panic!("{e}:\n{}{}", self.out, self.err))
    }
}

impl Ran {
    /// There is no answer: nothing on standard output, or the document of a refusal.
    #[allow(dead_code, reason = "not every test file refuses")]
    pub fn has_no_answer(&self) -> bool {
        let document = serde_json::from_str::<Value>(&self.out);
        self.out.is_empty() || document.is_ok_and(|d| d["schema"] == "trueaxis/refused/1")
    }
}

/// The root of the repository.
pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// Runs the command; whatever happens, it never panics.
pub fn trueaxis(arguments: &[&str]) -> Ran {
    let mut command = Command::new(env!("CARGO_BIN_EXE_trueaxis"));
    let Output { status, stdout, stderr } =
        command.args(arguments).current_dir(root()).output().expect("the command starts");
    let text = |bytes| String::from_utf8(bytes).expect("UTF-8");
    let ran = Ran {
        status: status.code().unwrap_or_else(|| panic!("{arguments:?} was killed")),
        out: text(stdout),
        err: text(stderr),
    };
    assert!(!ran.err.contains("panicked at"), "{arguments:?}:\n{}", ran.err);
    assert!((0..=2).contains(&ran.status), "{arguments:?}: {}\n{}", ran.status, ran.err);
    ran
}

/// A folder that goes away with the test.
pub struct Folder(PathBuf);

impl Folder {
    /// An empty folder of that name, which no other test uses.
    pub fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("trueaxis-{name}-{}", std::process::id()));
        std::fs::create_dir_all(&path).expect("a folder");
        Self(path)
    }

    /// A path in it.
    pub fn path(&self, name: &str) -> String {
        self.0.join(name).display().to_string()
    }

    /// Writes a file and gives its path.
    pub fn file(&self, name: &str, content: impl AsRef<[u8]>) -> String {
        let path = self.path(name);
        std::fs::write(&path, content).expect("a written file");
        path
    }

    /// The names of what is in it, hidden files too, but for the list of what was written.
    pub fn names(&self) -> Vec<String> {
        let entries = std::fs::read_dir(&self.0).expect("a folder").flatten();
        let mut names: Vec<String> =
            entries.map(|e| e.file_name().to_string_lossy().into_owned()).collect();
        names.retain(|name| name != ".trueaxis-written");
        names.sort();
        names
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0); // a remaining folder is no failure
    }
}
