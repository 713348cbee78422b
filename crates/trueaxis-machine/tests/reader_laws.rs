//! Properties that hold for every text given as a machine file.

mod library;

use library::{Random, SHIPPED, Texts, check, command_within_travel};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use std::path::Path;
use std::time::{Duration, Instant};
use trueaxis_input::Severity;
use trueaxis_machine::Machine;
use trueaxis_machine::file::Tables;

/// What must hold whatever was read: a machine or an error, every place inside its file, hints.
fn survives(text: &str, tables: &dyn Tables) {
    let (machine, problems) = Machine::check("m.toml", text, tables);
    assert_eq!(machine.is_some(), !problems.has_errors());
    let lines: Vec<&str> = text.split('\n').collect();
    for d in problems.iter() {
        assert!(!d.place.file.is_empty() && !d.message.is_empty() && !d.hint.is_empty(), "{d}");
        assert!(d.severity != Severity::Error || d.place.file != "m.toml" || d.place.line > 0);
        if d.place.file == "m.toml" && d.place.line > 0 {
            assert!(d.place.line <= lines.len(), "{d}");
            assert!(d.place.column <= lines[d.place.line - 1].chars().count() + 1, "{d}");
        }
    }
    let Some(machine) = machine else { return };
    for t in [0.0, 0.3, 1.0] {
        let command = command_within_travel(&machine, [t; 6]);
        let Ok(errors) = machine.errors_at(&command, &[0.0; 6]) else { continue };
        let at = machine.deviation(&command, &errors);
        let all = [at.nominal_tip.vector(), at.nominal_axis.vector(), at.tip_mm, at.axis];
        assert!(all.iter().flatten().all(|v| v.is_finite()), "{text}\n{at:?}");
    }
}

/// A shipped machine file and its tables.
struct Shipped {
    text: String,
    tables: Vec<(String, String)>,
}

impl Tables for Shipped {
    fn text(&self, name: &str) -> Result<String, String> {
        let found = self.tables.iter().find(|(n, _)| n == name);
        found.map(|(_, text)| text.clone()).ok_or_else(|| "not here".to_owned())
    }
}

fn shipped() -> Vec<Shipped> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../machines");
    let read = |path: &Path| std::fs::read_to_string(path).expect("a shipped file");
    let of_machine = |name: &&str| {
        let folder = folder.join(name);
        let tables = ["X.csv", "Y.csv", "Z.csv", "A.csv", "C.csv"]
            .iter()
            .filter(|t| folder.join(t).exists())
            .map(|t| ((*t).to_owned(), read(&folder.join(t))))
            .collect();
        Shipped { text: read(&folder.join("machine.toml")), tables }
    };
    SHIPPED.iter().map(of_machine).collect()
}

#[test]
fn law_the_reader_survives_truncation_at_every_character() {
    for file in shipped() {
        for (end, _) in file.text.char_indices() {
            survives(&file.text[..end], &file);
        }
    }
}

#[test]
fn law_the_reader_survives_truncated_and_broken_tables() {
    let mut random = Random(12);
    let mut file = shipped().swap_remove(0);
    let whole = file.tables[0].1.clone();
    let broken = ["", "nan", "1e400", ",", "\u{feff}", "µ", "\r", "#", "-", "1e308", "position_mm"];
    for (end, _) in whole.char_indices().filter(|(i, _)| i % 3 == 0) {
        file.tables[0].1 = whole[..end].to_owned();
        survives(&file.text, &file);
        let cut = end + (random.unit() * (whole.len() - end) as f64) as usize;
        let word = broken[(random.unit() * broken.len() as f64) as usize];
        file.tables[0].1 = format!("{}{word}{}", &whole[..end], &whole[cut..]);
        survives(&file.text, &file);
    }
}

#[test]
fn law_the_reader_keeps_its_speed_in_long_files() {
    let head = "[machine]\nname = \"m\"\nchain = \"w b X Y Z t\"\n[location]\n";
    let many_lines: String =
        (0..15_000).map(|i| format!("Q{i} = \"1 um\" # not an error\n")).collect();
    let one_line: String = (0..15_000).map(|i| format!("Q{i} = \"1 um\", ")).collect();
    let one_line = format!("EC0Y = {{ {one_line} }}\n[axis]\nX = {{ {one_line} }}\n");
    for text in [many_lines, one_line] {
        let begun = Instant::now();
        let (machine, problems) = check(&format!("{head}{text}"), "");
        assert!(machine.is_none() && problems.iter().count() >= 15_000 || problems.has_errors());
        // It takes a tenth of a second; a reader that counts the lines again for every key, half a minute.
        assert!(begun.elapsed() < Duration::from_secs(6), "{:?}", begun.elapsed());
    }
}

/// Words that mean something to the reader, and words that break things.
const WORDS: &[&str] = &[
    "[machine]",
    "[axis.X]",
    "[[axis.X]]",
    "[motion.C]",
    "[location]",
    "[tool]",
    "chain",
    "name",
    "placement",
    "mounting",
    "direction",
    "travel",
    "sense",
    "polynomial",
    "fourier",
    "terms",
    "scale",
    "table",
    "outside",
    "reversal",
    "u",
    "EXX",
    "EC0Y",
    "C0Y",
    "EX0w",
    "=",
    "{",
    "}",
    "[",
    "]",
    ",",
    ".",
    "\"",
    "'",
    "'''",
    "\"\"\"",
    "\n",
    "\r\n",
    "\r",
    "#",
    " ",
    "\t",
    "\\",
    "\u{0}",
    "\u{feff}",
    "µ",
    "μ",
    "±",
    "°",
    "′",
    "’",
    "🦀",
    "nan",
    "inf",
    "-inf",
    "1e308",
    "-1e308",
    "1e999",
    "1e-320",
    "-0.0",
    "0x7fffffffffffffff",
    "99999999999999999999999",
    "2021-03-28",
    "true",
    "\"1e308 m\"",
    "\"1e-320 mm\"",
    "\"-0 mm\"",
    "\"nan mm\"",
    "\"5 deg\"",
    "\"5 mm\"",
    "\"0 0 0\"",
    "\"0 1 1\"",
    "\"w b X Y Z t\"",
    "\"WYXZCAT\"",
    "\"unlimited\"",
    "\"t.csv\"",
    "\"turn Z 10 deg\"",
    "-1",
    "1",
    "0",
    "1_000",
    "1e12",
    "\"1e12 mm\"",
    "\"1e12 rad\"",
    "\"1e-9 mm\"",
];

fn words() -> impl Strategy<Value = String> {
    let word = prop_oneof![
        8 => proptest::sample::select(WORDS).prop_map(str::to_owned),
        1 => any::<char>().prop_map(|c| c.to_string()),
    ];
    proptest::collection::vec(word, 0..60).prop_map(|words| words.concat())
}

/// A change of a text: from, to (as shares of its length), and what stands there instead.
fn edits() -> impl Strategy<Value = Vec<(f64, usize, String)>> {
    let new = prop_oneof![proptest::sample::select(WORDS).prop_map(str::to_owned), words()];
    proptest::collection::vec((0.0..1.0, 0..40usize, new), 1..4)
}

fn edited(text: &str, edits: &[(f64, usize, String)]) -> String {
    let mut text: Vec<char> = text.chars().collect();
    for (at, length, new) in edits {
        let from = (*at * text.len() as f64) as usize;
        let to = (from + length).min(text.len());
        text.splice(from..to, new.chars());
    }
    text.into_iter().collect()
}

/// Every value of a machine file replaced by another one that looks alike.
fn swapped_values(text: &str, which: usize, word: &str) -> String {
    let values: Vec<usize> = text.match_indices(" = ").map(|(i, _)| i + 3).collect();
    let from = values[which % values.len()];
    let to = from + text[from..].find('\n').unwrap_or(text.len() - from);
    format!("{}{word}{}", &text[..from], &text[to..])
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 3000, rng_seed: RngSeed::Fixed(230), failure_persistence: None, ..Default::default() })]

    #[test]
    fn law_the_reader_survives_any_text(text in any::<String>(), words in words()) {
        let tables = Texts(&[("t.csv", &text)]);
        survives(&text, &tables);
        survives(&words, &tables);
        let head = "[machine]\nname = \"m\"\nchain = \"w C' b X Y Z A t\"\n";
        survives(&format!("{head}{words}"), &tables);
        survives(&format!("{head}[motion.X]\ntable = \"t.csv\"\n"), &Texts(&[("t.csv", &words)]));
    }

    #[test]
    fn law_the_reader_survives_mutated_machines(
        which in 0..SHIPPED.len(),
        edits in edits(),
        value in 0..1000usize,
        word in proptest::sample::select(WORDS),
    ) {
        thread_local!(static FILES: Vec<Shipped> = shipped());
        FILES.with(|files| {
            let file = &files[which];
            survives(&edited(&file.text, &edits), file);
            survives(&swapped_values(&file.text, value, word), file);
        });
    }
}
