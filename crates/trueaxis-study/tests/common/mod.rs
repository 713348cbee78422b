//! Studies from texts, beside the examples.
#![allow(dead_code)]

use std::path::{Path, PathBuf};
use trueaxis::files::disk;
use trueaxis::input::Diagnostics;
use trueaxis_study::{Changes, Study, read_study};

/// The folder of the repository.
pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").canonicalize().unwrap()
}

/// Writes a study into a folder of its own and reads it; `ROOT` in it is the repository.
pub fn read(name: &str, text: &str) -> (Option<Study>, Diagnostics) {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("study-{name}"));
    std::fs::create_dir_all(&folder).unwrap();
    let path = folder.join("study.toml");
    std::fs::write(&path, text.replace("ROOT", root().to_str().unwrap())).unwrap();
    read_study(&disk(), &path, Changes::default())
}

/// The same of a text that is sound.
pub fn sound(name: &str, text: &str) -> Study {
    let (study, problems) = read(name, text);
    let messages: Vec<String> = problems.iter().map(|d| d.message.clone()).collect();
    study.unwrap_or_else(|| panic!("{messages:?}"))
}

/// The outputs of some samples.
pub fn values(study: &Study, samples: std::ops::Range<usize>) -> Vec<f64> {
    study.evaluate(samples, &|_| {}).map_err(|fault| fault.message).unwrap()
}

/// The NAS979 frustum on the gantry, with `[design]` and what follows.
pub fn frustum(name: &str, rest: &str) -> Study {
    let head = "name = \"frustum\"\nstudy = \"ROOT/examples/03_predict/nas979-on-xkas2525.toml\"\n";
    sound(name, &format!("{head}{rest}"))
}
