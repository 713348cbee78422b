//! Texts of standard input, one in a line, that a language does not have: `untranslated de < texts.txt`.
//!
//! The dictionaries are read from the sources, so that they need not be compiled for it; an error in one is said.

use std::io::{Read, Write};
use trueaxis_words::Dictionary;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let language = std::env::args().nth(1).unwrap_or_else(|| "de".to_owned());
    let all = std::env::args().nth(2).is_some_and(|word| word == "--all");
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("src").join(&language);
    let mut files = Vec::new();
    for entry in std::fs::read_dir(folder)? {
        let path = entry?.path();
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        files.push((name, std::fs::read_to_string(path)?));
    }
    files.sort();
    let borrowed: Vec<(&str, &str)> = files.iter().map(|(n, c)| (&**n, &**c)).collect();
    let dictionary = Dictionary::read(&borrowed)?;
    let mut texts = String::new();
    std::io::stdin().read_to_string(&mut texts)?;
    let mut out = std::io::stdout().lock();
    for text in texts.lines() {
        let said = dictionary.text(text);
        if all {
            writeln!(out, "{text}\t{said}")?;
        } else if said == text {
            writeln!(out, "{text}")?;
        }
    }
    Ok(())
}
