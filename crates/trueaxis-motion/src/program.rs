//! The NC program and the subprograms that it calls.

use super::basic::{rotary_angles, tool_turn};
use super::setup::{CONTROLS, SetUp};
use std::path::{Path, PathBuf};
use trueaxis_geometry::{Mat3, Vec3};
use trueaxis_input::{Content, Diagnostics, Files, Place};
use trueaxis_machine::tcp::TipControl;
use trueaxis_nc::moves::{Branch, Position};
use trueaxis_nc::{Control, Library, Program};

/// Reads an NC program; its control comes from the caller, the set-up, the file's extension or its
/// first lines, in this order.
pub fn read_program(
    files: &Files,
    path: &Path,
    control: Option<Control>,
    setup: &SetUp,
    problems: &mut Diagnostics,
) -> Option<Program> {
    let bytes = files.content(path, "an NC program", problems)?;
    program_of(path, bytes, control.or(setup.control), problems)
}

/// The program of a text as if it were in a file at a path.
pub(super) fn program_of(
    path: &Path,
    bytes: Content,
    control: Option<Control>,
    problems: &mut Diagnostics,
) -> Option<Program> {
    let file = path.display().to_string();
    // Editors put this mark before UTF-8 text; no control reads it.
    let mark = if bytes.starts_with(b"\xEF\xBB\xBF") { 3 } else { 0 };
    let bytes = bytes.without(mark);
    if bytes.starts_with(b"\xFF\xFE") || bytes.starts_with(b"\xFE\xFF") {
        let message = "the program is UTF-16 text".to_owned();
        let hint = "save it as plain text (ASCII, Latin-1 or UTF-8)";
        problems.error("utf-16", Place::whole(&file), message, hint);
        return None;
    }
    if bytes.iter().all(u8::is_ascii_whitespace) {
        let message = "the program is empty".to_owned();
        problems.error(
            "empty-program",
            Place::whole(&file),
            message,
            "expected an NC program here",
        );
        return None;
    }
    let control = control.or_else(|| by_extension(path)).or_else(|| sniff(&bytes));
    let Some(control) = control else {
        let message =
            "neither its name nor its first lines show which control it is for".to_owned();
        let hint = format!("give --control {CONTROLS}");
        problems.error("unknown-control", Place::whole(&file), message, &hint);
        return None;
    };
    Some(Program::of(&file, bytes, control))
}

fn by_extension(path: &Path) -> Option<Control> {
    let extension = path.extension()?.to_str()?.to_ascii_lowercase();
    match extension.as_str() {
        "mpf" | "spf" => Some(Control::Sinumerik840d),
        "h" => Some(Control::Heidenhain),
        "ngc" => Some(Control::LinuxCnc),
        "nc" | "cnc" | "tap" | "eia" | "fan" => Some(Control::Fanuc),
        _ => None,
    }
}

/// Words in the first lines that only one of the controls uses.
fn sniff(bytes: &[u8]) -> Option<Control> {
    let head = &bytes[..bytes.len().min(4096)];
    let text = String::from_utf8_lossy(head).to_ascii_uppercase();
    let any = |marks: &[&str]| marks.iter().any(|mark| text.contains(mark));
    if any(&["BEGIN PGM"]) {
        return Some(Control::Heidenhain);
    }
    if any(&["%_N_", "TRAORI", "CYCLE8", "ORIWKS", "WORKPIECE(", "A3=", "MSG(", "SUPA", "T=\""]) {
        return Some(Control::Sinumerik840d);
    }
    if text.lines().any(|l| l.starts_with("O<") || l.contains(" SUB") || l.contains("M428")) {
        return Some(Control::LinuxCnc);
    }
    let tape = text.trim_start().starts_with('%');
    let number = |l: &str| l.starts_with('O') && l[1..].starts_with(|c: char| c.is_ascii_digit());
    (tape || text.lines().any(number)).then_some(Control::Fanuc)
}

/// The folder of the main program as a library of subprograms, and the angles of the machine.
pub(super) struct Folder<'m> {
    files: Files,
    path: PathBuf,
    control: Option<&'m TipControl>,
    /// From the directions of the basic frame to those of the workpiece.
    turn: Mat3,
}

impl<'m> Folder<'m> {
    pub fn beside(
        files: &Files,
        program: &Path,
        control: Option<&'m TipControl>,
        turn: Mat3,
    ) -> Self {
        let path = program.parent().unwrap_or(Path::new("")).to_owned();
        Self { files: files.clone(), path, control, turn }
    }

    /// The file of a subprogram: the name as it is, in upper and lower case, with the usual
    /// extensions; never outside the folder.
    fn find(&self, name: &str) -> Option<PathBuf> {
        let plain = !name.contains(['/', '\\', ':']) && !name.is_empty() && name != "..";
        let cases = [name.to_owned(), name.to_ascii_lowercase(), name.to_ascii_uppercase()];
        let endings = [
            "", ".ngc", ".nc", ".NC", ".spf", ".SPF", ".mpf", ".MPF", ".h", ".H", ".cnc", ".CNC",
            ".tap", ".TAP", ".eia", ".EIA",
        ];
        let mut all = cases.iter().flat_map(|c| endings.iter().map(move |e| format!("{c}{e}")));
        plain
            .then(|| all.find(|n| self.files.is_file(&self.path.join(n))))
            .flatten()
            .map(|n| self.path.join(n))
    }
}

impl Library for Folder<'_> {
    fn text(&self, name: &str) -> Result<Vec<u8>, String> {
        self.content(name).map(Content::into_vec)
    }

    fn content(&self, name: &str) -> Result<Content, String> {
        let path =
            self.find(name).ok_or("there is no such file in the folder of the main program")?;
        self.files.read_long(&path).map_err(|e| e.to_string())
    }

    fn display(&self, name: &str) -> String {
        self.find(name).unwrap_or_else(|| self.path.join(name)).display().to_string()
    }

    fn rotary_angles(
        &self,
        direction: [f64; 3],
        branch: Branch,
        now: &Position,
    ) -> Option<[f64; 3]> {
        let direction = (self.turn * Vec3::from(direction)).into();
        rotary_angles(self.control?, direction, branch, now)
    }

    fn tool_turn(&self, angles_deg: [f64; 3]) -> Option<[[f64; 3]; 3]> {
        let turn = tool_turn(self.control?, angles_deg);
        let turn = self.turn.transpose() * turn * self.turn;
        Some([0, 1, 2].map(|i| [0, 1, 2].map(|j| turn[(i, j)])))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_control_is_told_by_extension_or_text() {
        assert_eq!(by_extension(Path::new("a/B.MPF")), Some(Control::Sinumerik840d));
        assert_eq!(by_extension(Path::new("a.txt")), None);
        assert_eq!(sniff(b"0 BEGIN PGM 11 MM\n"), Some(Control::Heidenhain));
        assert_eq!(sniff(b"%\nO0001 (X)\n"), Some(Control::Fanuc));
        assert_eq!(sniff(b"N10 G0 X0\nN20 TRAORI\n"), Some(Control::Sinumerik840d));
        assert_eq!(sniff(b"G0 X0\n"), None);
    }
}
