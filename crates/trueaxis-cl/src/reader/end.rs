//! Whether a file is whole: APT ends with FINI.

use super::super::scan::Scanner;
use super::Reader;
use trueaxis_input::Place;

impl Reader<'_> {
    /// A file that was cut may end within a number: a hole of `-10` that ends as `-1` is another hole. Where nothing
    /// more can be missing than FINI, that is said.
    pub(super) fn check_end(&mut self, scanner: &Scanner<'_>, source: &[u8]) {
        if !self.has_words || self.ended.is_some() || self.path_ended {
            return;
        }
        let is_within_line = source.last().is_some_and(|byte| !matches!(byte, b'\n' | b'\r'));
        let hint = "let the CAM system write it again; if it is whole, end it with FINI";
        let place =
            Place { file: self.name.to_owned(), line: scanner.last_line() as usize, column: 1 };
        let message = match self.cycle_on {
            _ if is_within_line => "the file ends here within a line, without FINI".to_owned(),
            _ if scanner.is_cut() => {
                "the file ends here within a statement, without FINI".to_owned()
            }
            Some(line) => {
                format!("the file ends here without FINI, and the CYCLE of line {line} is still on")
            }
            None => {
                let hint = "is the file whole? APT ends with FINI";
                let message = "the file has no FINI".to_owned();
                self.problems.warn("no-end", place, message, hint);
                return;
            }
        };
        self.problems.error("cut-file", place, message, hint);
    }
}
