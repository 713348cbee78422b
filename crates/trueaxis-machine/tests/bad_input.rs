//! Machine files with mistakes: each is found, named, placed, and comes with a way out.
//!
//! One file per mistake in `tests/bad/`; its first lines say what must be found, and nothing else
//! may be: `# expect: wrong-unit 3:8`, `# expect: bad-table t.csv:4:1` in a table,
//! `# expect: warning …` where the machine can still be used.

use std::path::{Path, PathBuf};
use trueaxis_input::{Diagnostic, Severity};
use trueaxis_machine::Machine;
use trueaxis_machine::file::{NoTables, Tables};

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/bad")
}

struct Folder;

impl Tables for Folder {
    fn text(&self, name: &str) -> Result<String, String> {
        std::fs::read_to_string(folder().join(name)).map_err(|e| e.to_string())
    }
}

fn problems(text: &str) -> (Option<Machine>, Vec<Diagnostic>) {
    let (machine, problems) = Machine::check("m.toml", text, &Folder);
    (machine, problems.sorted())
}

/// As the header of a file of `tests/bad` says it.
fn in_words(d: &Diagnostic) -> String {
    let severity = if d.severity == Severity::Error { "" } else { "warning " };
    let place = d.place.to_string();
    format!("{severity}{} {}", d.code, place.strip_prefix("m.toml:").unwrap_or(&place))
}

#[test]
fn every_mistake_is_named_and_placed() {
    let mut wrong = Vec::new();
    let mut count = 0;
    for entry in std::fs::read_dir(folder()).expect("tests/bad") {
        let path = entry.expect("an entry").path();
        if path.extension().is_none_or(|e| e != "toml") {
            continue;
        }
        count += 1;
        let text = std::fs::read_to_string(&path).expect("a text");
        let expected: Vec<&str> =
            text.lines().map_while(|l| l.strip_prefix("# expect: ")).collect();
        assert!(!expected.is_empty(), "{path:?} does not say what is wrong with it");
        let (machine, found) = problems(&text);
        let mut said: Vec<String> = found.iter().map(in_words).collect();
        let mut wanted = expected.clone();
        said.sort();
        wanted.sort_unstable();
        let usable = expected.iter().all(|e| e.starts_with("warning "));
        if said != wanted || machine.is_some() != usable {
            wrong.push(format!("{path:?}:\n    wanted {wanted:?}\n    found  {said:?}"));
        }
        for d in &found {
            assert!(!d.hint.is_empty() && !d.message.is_empty(), "{path:?}: no way out of {d}");
            assert!(!d.message.contains('\n'), "{path:?}: one sentence, not {d}");
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert!(count > 110, "only {count} files");
}

#[test]
fn many_mistakes_come_at_once() {
    let text = std::fs::read_to_string(folder().join("many.toml")).expect("many.toml");
    let (machine, found) = problems(&text);
    assert!(machine.is_none() && found.len() >= 18, "{}", found.len());
    let places: std::collections::BTreeSet<_> = found.iter().map(|d| &d.place).collect();
    assert_eq!(places.len(), found.len(), "each in its own place");
}

const MILL: &str = "[machine]\nname = \"m\"\nchain = \"w b X Y Z t\"\n[location]\n";

#[test]
fn nothing_at_all() {
    for text in ["", "\u{feff}", "\n\n", "\r\n", "# only a comment", " \t "] {
        let (machine, found) = problems(text);
        assert!(machine.is_none());
        let said: Vec<String> = found.iter().map(in_words).collect();
        assert_eq!(said, ["missing-key 1:1"], "{text:?}");
    }
}

/// What editors on Windows add changes neither the machine nor the places.
#[test]
fn byte_order_mark_and_carriage_returns() {
    let bad = format!("{MILL}EC0Y = \"12 mm\"\n");
    for text in [bad.clone(), bad.replace('\n', "\r\n"), format!("\u{feff}{bad}")] {
        let said: Vec<String> = problems(&text).1.iter().map(in_words).collect();
        assert_eq!(said, ["wrong-unit 5:8"], "{text:?}");
    }
    let good = format!("{MILL}EC0Y = \"12 urad\"\n[motion.X]\ntable = \"t.csv\"\n");
    struct One(String);
    impl Tables for One {
        fn text(&self, _: &str) -> Result<String, String> {
            Ok(self.0.clone())
        }
    }
    let csv = "# measured\nposition_mm,EXX_um\n0,1\n10,2\n20,-1\n";
    let of = |text: &str, csv: &str| {
        let (machine, found) = Machine::check("m.toml", text, &One(csv.to_owned()));
        assert_eq!(found.iter().count(), 0, "{found:?}");
        machine.expect("a machine")
    };
    let plain = of(&good, csv);
    assert_eq!(of(&good.replace('\n', "\r\n"), &csv.replace('\n', "\r\n")), plain);
    assert_eq!(of(&format!("\u{feff}{good}"), &format!("\u{feff}{csv}")), plain);
}

/// Every spelling of a unit is the same number: both code points of µ, with and without a space.
#[test]
fn spellings_of_units() {
    let value = |text: &str| {
        let (machine, found) = Machine::check("m.toml", &format!("{MILL}{text}\n"), &NoTables);
        let errors = machine.unwrap_or_else(|| panic!("{text}: {found:?}"));
        errors.errors_at(&[0.0; 6], &[0.0; 6]).expect("constants").bodies[2].location.0
    };
    let squareness = value("EC0Y = \"12 urad\"")[5];
    assert_eq!(squareness, 12e-6);
    for same in ["12 \u{b5}rad", "12 \u{3bc}rad", "12urad", "+1.2e1 urad", "0.012 mrad", "12 um/m"]
    {
        assert!((value(&format!("EC0Y = \"{same}\""))[5] - squareness).abs() < 1e-20, "{same}");
    }
    for same in ["12 \u{b5}m", "12 \u{3bc}m", " 12\u{a0}um ", "0.012mm", "12000 nm", "1.2e-5 m"] {
        assert!((value(&format!("EX0Y = \"{same}\""))[0] - 0.012).abs() < 1e-17, "{same}");
    }
    // The alias of vendors, with the digit and with the letter.
    for name in ["C0Y", "COY"] {
        assert_eq!(value(&format!("{name} = \"12 urad\""))[5], squareness);
    }
    assert_eq!(value("EX0Y = \"-0 um\"")[0], 0.0);
}

/// TOML has several ways to write the same table.
#[test]
fn other_ways_to_write_the_same_toml() {
    let of = |text: &str| {
        let (machine, found) = Machine::check("m.toml", text, &NoTables);
        assert_eq!(found.iter().count(), 0, "{found:?}");
        machine.expect("a machine")
    };
    let sections = of("[machine]\nname = \"m\"\nchain = \"w b X Y Z t\"\n[axis.X]\n\
                       travel = [\"0 mm\", \"5 mm\"]\n[motion.X]\nEXX = { constant = \"1 um\" }\n");
    let dotted = of("machine.name = 'm'\nmachine.chain = '''w b X Y Z t'''\n\
                     axis.X.travel = [ '0 mm' ,\n # far end\n '5 mm', ]\n\
                     motion.\"X\".EXX.constant = \"1 \\u0075m\"\n");
    let inline = of("machine = { name = \"m\", chain = \"w  b\\tX Y Z t\" }\n\
                     axis = { X = { travel = [\"0 mm\", \"5 mm\"] } }\n\
                     motion = { X = { EXX = { constant = \"1 um\" } } }\n");
    let deep = of("[motion.X.EXX]\nconstant = \"1 um\"\n[axis]\n[axis.X]\n\
                   travel = [\"0 mm\", \"5 mm\"]\n[machine]\nname = \"m\"\nchain = \"w X Y Z t\"\n\
                   "
    .replace("w X", "w b X")
    .as_str());
    assert_eq!(sections, dotted);
    assert_eq!(sections, inline);
    assert_eq!(sections, deep);
}

#[test]
fn nesting_without_end_is_refused_and_not_followed() {
    let deep = |open: &str, close: &str| {
        format!("{MILL}EC0Y = {}{}\n", open.repeat(50_000), close.repeat(50_000))
    };
    let dotted = format!("{MILL}{} = 1\n", vec!["a"; 50_000].join("."));
    let header = format!("{MILL}[{}]\n", vec!["a"; 50_000].join("."));
    for text in [deep("[", "]"), deep("{ a = ", "}"), deep("[", ""), dotted, header] {
        let (machine, found) = problems(&text);
        assert!(machine.is_none());
        assert!(found.iter().any(|d| ["toml-syntax", "over-limit"].contains(&d.code)), "{found:?}");
    }
}

#[test]
fn ten_thousand_coefficients() {
    let coefficients = vec!["\"1 nm\""; 10_000].join(", ");
    let text = |scale: &str| {
        format!(
            "[machine]\nname = \"m\"\nchain = \"w b X Y Z t\"\n[axis.X]\n\
             travel = [\"0 mm\", \"500 mm\"]\n\
             [motion.X]\nEXX = {{ polynomial = [{coefficients}], scale = \"{scale}\" }}\n"
        )
    };
    // At the end of the travel each of the 10⁴ terms is 1 nm.
    let (machine, _) = problems(&text("500 mm"));
    let machine = machine.expect("small enough");
    let errors = machine.errors_at(&[500.0, 0.0, 0.0, 0.0, 0.0, 0.0], &[0.0; 6]).expect("defined");
    assert!((errors.bodies[1].motion.0[0] - 0.01).abs() < 1e-14);
    // 10⁴ terms that grow to 5^9999.
    let said: Vec<String> = problems(&text("100 mm")).1.iter().map(in_words).collect();
    assert_eq!(said, ["too-large 7:7"]);
}

/// Values at the edge of what is accepted give finite poses, however they are combined.
#[test]
fn largest_values_stay_finite() {
    for rotation in ["exact", "small-angle"] {
        let mut text = format!(
            "[machine]\nname = \"m\"\nchain = \"w C' A' b X Y Z t\"\nrotation = \"{rotation}\"\n\
             [plausible]\nlength_mm = 1e9\ntool_length_mm = 1e9\nlocation_error_um = 1e12\n\
             location_error_urad = 1e11\n\
             [tool]\ntip = \"5e8 5e8 5e8 mm\"\n[workpiece]\nplacement = \"5e8 0 -5e8 mm\"\n\
             [location]\n"
        );
        for body in ["w", "C", "A", "X", "Y", "Z", "t"] {
            for component in ["X", "Y", "Z"] {
                text += &format!("E{component}0{body} = \"1e9 mm\"\n");
            }
            for component in ["A", "B", "C"] {
                text += &format!("E{component}0{body} = \"1e5 rad\"\n");
            }
        }
        let (machine, found) = problems(&text);
        let machine = machine.unwrap_or_else(|| panic!("{found:?}"));
        let at = [1.0, 1.0, 1e9, -1e9, 1e9, 0.0];
        let errors = machine.errors_at(&at, &[0.0; 6]).expect("constants");
        let deviation = machine.deviation(&at, &errors);
        assert!(deviation.tip_mm.iter().chain(&deviation.axis).all(|v| v.is_finite()));
    }
}
