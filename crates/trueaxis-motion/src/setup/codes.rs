//! `[codes]`: what codes and programs of the machine builder do.

use std::collections::BTreeMap;

use trueaxis_input::{Place, Section};
use trueaxis_nc::{Control, OwnCode};

const HINT: &str = "M200 = \"ignore\", \"stop\" or { call = \"file\" }";

/// What each code does, and where it is stated.
type Codes = (BTreeMap<String, OwnCode>, BTreeMap<String, Place>);

/// `M200 = "ignore"`, `"stop"` or `{ call = "file" }`.
pub(super) fn read(section: &Section<'_>, control: Option<Control>) -> Codes {
    let (mut codes, mut places) = (BTreeMap::new(), BTreeMap::<String, Place>::new());
    for (key, place, item) in section.entries() {
        let own = match item.as_text() {
            Some("ignore") => Some(OwnCode::Ignore),
            Some("stop") => Some(OwnCode::Stop),
            Some(other) => {
                let message = format!("`{other}` is not what a code can do");
                item.error("bad-code", message, HINT);
                continue;
            }
            None => item
                .section(key, |s| s.text("call").map(str::to_owned))
                .flatten()
                .map(OwnCode::Call),
        };
        let Some(own) = own else {
            section.error_at(place, "bad-code", format!("`{key}` does nothing"), HINT);
            continue;
        };
        let name = plain(key);
        if let Err(hint) = check_name(&name, control) {
            section.error_at(place, "bad-code", not_a_name(key, control), hint);
        } else if let Some(first) = places.get(&name) {
            let message = format!("`{key}` is {name}, which line {} states already", first.line);
            section.error_at(place, "bad-code", message, "state each code once");
        } else {
            codes.insert(name.clone(), own);
            places.insert(name, place);
        }
    }
    (codes, places)
}

/// `m06` is `M6`; names of programs in capital letters.
fn plain(key: &str) -> String {
    let name = key.trim().to_ascii_uppercase();
    number_of(&name).map_or(name.clone(), |number| format!("{}{number}", &name[..1]))
}

/// The number of an M or G code: digits, and of a G code one decimal.
fn number_of(name: &str) -> Option<f64> {
    let digits = name.strip_prefix(['M', 'G'])?;
    let (whole, decimal) = digits.split_once('.').unwrap_or((digits, "0"));
    let plain = |text: &str, most: usize| {
        (1..=most).contains(&text.len()) && text.bytes().all(|b| b.is_ascii_digit())
    };
    let decimals = if name.starts_with('G') { 1 } else { 0 };
    if !plain(whole, 8) || digits.contains('.') && !plain(decimal, decimals) {
        return None;
    }
    digits.parse().ok()
}

/// Whether a control can have a code or program of this name; what it can have if not.
pub(super) fn check_name(name: &str, control: Option<Control>) -> Result<(), &'static str> {
    let code = number_of(name).is_some();
    let letter = |b: u8| b.is_ascii_uppercase() || b == b'_';
    let bytes = name.as_bytes();
    let word = bytes.len() >= 2
        && bytes[..2].iter().all(|b| letter(*b))
        && bytes.iter().all(|b| letter(*b) || b.is_ascii_digit());
    let numbered = name
        .strip_prefix('L')
        .is_some_and(|n| !n.is_empty() && n.len() <= 7 && n.bytes().all(|b| b.is_ascii_digit()));
    match control {
        Some(Control::Heidenhain) if code && name.starts_with('M') => Ok(()),
        Some(Control::Heidenhain) => Err("write the name of an M code: M200 = \"ignore\""),
        None | Some(Control::Sinumerik840d) if code || word || numbered => Ok(()),
        None | Some(Control::Sinumerik840d) => Err(
            "write an M code (M200), a G code (G120, \"G5.1\") or a program of SINUMERIK (TOOLIN)",
        ),
        Some(_) if code => Ok(()),
        Some(_) => Err(
            "write an M code (M200) or a G code (G120, \"G5.1\"); only SINUMERIK calls programs by name",
        ),
    }
}

pub(super) fn not_a_name(key: &str, control: Option<Control>) -> String {
    let whose = match control {
        None => "",
        Some(Control::Sinumerik840d) => " of SINUMERIK",
        Some(Control::Fanuc) => " of FANUC",
        Some(Control::Haas) => " of HAAS",
        Some(Control::LinuxCnc) => " of LinuxCNC",
        Some(Control::Heidenhain) => " of HEIDENHAIN",
    };
    format!("`{key}` is not the name of a code{whose}")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::setup::SetUp;
    use trueaxis_input::{Diagnostics, SourceText};
    use trueaxis_nc::Program;

    fn read_text(text: &str, control: Option<Control>) -> (BTreeMap<String, OwnCode>, Vec<String>) {
        let text = format!("[codes]\n{text}");
        let source = SourceText::new("setup.toml", &text);
        let codes = source.read(|root| root.section("codes", |s| read(s, control)));
        let problems = source.finish();
        let told = problems.iter().map(|p| format!("{}:{} {}", p.code, p.place.line, p.message));
        (codes.unwrap_or_default().0, told.collect())
    }

    #[test]
    fn codes_of_the_machine_builder() {
        let text = "M200 = \"ignore\"\nm06 = { call = \"CHANGE\" }\n\"G5.1\" = \"stop\"\nToolIn = \"ignore\"\nL12 = \"stop\"\n";
        let (codes, problems) = read_text(text, None);
        assert!(problems.is_empty(), "{problems:?}");
        assert_eq!(codes.keys().collect::<Vec<_>>(), ["G5.1", "L12", "M200", "M6", "TOOLIN"]);
        assert_eq!(codes["M6"], OwnCode::Call("CHANGE".to_owned()));
        let problems = |text: &str| read_text(text, None).1;
        assert_eq!(problems("M1 = \"off\"\n"), ["bad-code:2 `off` is not what a code can do"]);
        assert_eq!(problems("M1 = { }\n"), ["bad-code:2 `M1` does nothing"]);
        assert_eq!(problems("M1 = { cal = \"x\" }\n").len(), 2);
    }

    #[test]
    fn names_that_no_control_has() {
        for name in [
            "M-1", "M", "G", "M1.5", "G5.12", "G1e3", "M+3", "Minf", "M 3", "1", "X", "Ä", "M12A",
            "G.5",
        ] {
            let (codes, problems) = read_text(&format!("\"{name}\" = \"stop\"\n"), None);
            let told = format!("bad-code:2 `{name}` is not the name of a code");
            let text = ["Minf"].contains(&name);
            // A word of letters may be a program of SINUMERIK.
            assert_eq!(problems, if text { vec![] } else { vec![told] }, "{name}");
            assert_eq!(codes.len(), usize::from(text));
        }
        let told = |control| read_text("XYZ = \"stop\"\n", control).1.len();
        let all = [
            Control::Sinumerik840d,
            Control::Fanuc,
            Control::Haas,
            Control::LinuxCnc,
            Control::Heidenhain,
        ];
        assert_eq!(all.map(|c| told(Some(c))), [0, 1, 1, 1, 1]);
        assert_eq!(read_text("G7 = \"stop\"\n", Some(Control::Heidenhain)).1.len(), 1);
    }

    /// Without a control in the set-up file the program decides.
    #[test]
    fn names_that_the_control_of_the_program_cannot_have() {
        let mut place = Place::whole("setup.toml");
        place.line = 7;
        let code_places = BTreeMap::from([("XYZ".to_owned(), place)]);
        let setup = SetUp { given: true, code_places, ..SetUp::default() };
        for (control, count) in [(Control::Fanuc, 1), (Control::Sinumerik840d, 0)] {
            let mut problems = Diagnostics::new();
            setup.check_for(&Program::new("p", b"M30".to_vec(), control), &mut problems);
            let lines: Vec<_> = problems.iter().map(|p| (p.code, p.place.line)).collect();
            assert_eq!(lines, vec![("bad-code", 7); count]);
        }
    }

    #[test]
    fn one_code_in_two_notations() {
        let (codes, problems) = read_text("M8 = \"stop\"\nM08 = \"ignore\"\n", None);
        assert_eq!(problems, ["bad-code:3 `M08` is M8, which line 2 states already"]);
        assert_eq!(codes["M8"], OwnCode::Stop);
        assert_eq!(read_text("g12 = \"stop\"\n\"G12.0\" = \"stop\"\n", None).1.len(), 1);
        assert_eq!(read_text("ToolIn = \"stop\"\nTOOLIN = \"stop\"\n", None).1.len(), 1);
    }
}
