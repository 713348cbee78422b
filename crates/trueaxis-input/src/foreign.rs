//! Tables as instruments and spreadsheets write them: other encodings, separators, decimal signs, languages and units.
//!
//! [`decode`] turns bytes into text and says which encoding it took for granted; [`read`] turns such a table into ours
//! (`target_mm,run,direction,deviation_um`), every row on its own line of the source, so that each later problem
//! names that line. What the headings do not tell is stated in a mapping file, [`Mapping`]; [`look`] shows a table before it is
//! read, so that one can be written.
//!
//! ```
//! use trueaxis_input::{Diagnostics, foreign};
//! let german = "Sollposition [mm];Richtung;Abweichung [µm]\n100,0;vorwärts;-1,25\n";
//! let mut problems = Diagnostics::new();
//! let ours = foreign::read("x.csv", german, &mut problems).unwrap();
//! assert_eq!(ours, "target_mm,direction,deviation_um\n100.0e0,up,-1.25e0\n");
//! assert_eq!(problems.iter().next().unwrap().code, "read-as"); // says what it has assumed
//! ```
//!
//! A number that can be read in two ways is refused, with both readings. Units are changed by powers of ten in the text of
//! a number, before it is rounded to a double: the same readings give the same figures in µm, in mm and in m.

mod encoding;
mod headings;
mod look;
mod mapped;
mod mapping;
mod notation;
mod table;

pub use encoding::{Decoded, decode, decode_as, encoding_named};

use crate::{Diagnostics, Files, Place};
pub use look::{Look, LookAs, LookColumn, look};
pub use mapping::{Mapping, read_mapping};
use std::path::Path;
pub use table::{Beside, is_ours, read};

/// The text of a file in any usual encoding, with a note where that was assumed; `None` and the problem
/// `unreadable-file`. `what` as for [`Files::text`].
pub fn text(
    files: &Files,
    path: &Path,
    what: &str,
    mapping: Option<&Mapping>,
    problems: &mut Diagnostics,
) -> Option<String> {
    let bytes = files.bytes(path, what, problems)?;
    let decoded = mapping.map_or_else(|| decode(&bytes), |mapping| mapping.decode(&bytes));
    if decoded.is_assumed {
        let message = format!("the file is not UTF-8: it was read as {}", decoded.encoding);
        let hint = "state encoding = \"…\" in a mapping file (--map) if words of it look wrong";
        problems.note("assumed-encoding", Place::whole(&path.display().to_string()), message, hint);
    }
    Some(decoded.text)
}

/// The text of a table in our own form: read by its mapping file `NAME.map.toml` if there is one, else as it is.
pub fn mapped_text(
    files: &Files,
    path: &Path,
    what: &str,
    problems: &mut Diagnostics,
) -> Option<String> {
    let before = problems.has_errors();
    let mapping = read_mapping(files, None, path, problems);
    let text = text(files, path, what, mapping.as_ref(), problems)?;
    match mapping {
        Some(mapping) => mapping.read(&path.display().to_string(), &text, problems),
        // A mapping file that cannot be used has said why.
        None if problems.has_errors() && !before => None,
        None => Some(text),
    }
}
