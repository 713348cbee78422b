//! Reports in German and Chinese: no English is left in those of the examples, values and verdicts are the same.

mod command;

use command::{Folder, root, trueaxis};
use std::collections::BTreeSet;
use trueaxis_words::ReportLanguage;

/// Words of the English texts that no text of the other language has.
fn english_words(language: ReportLanguage) -> BTreeSet<String> {
    let dictionary = language.dictionary().expect("a dictionary");
    let words = |text: &str| -> Vec<String> {
        let plain = |word: &&str| word.len() > 2 && word.chars().all(|c| c.is_ascii_lowercase());
        text.split(|c: char| !c.is_alphanumeric()).filter(plain).map(str::to_owned).collect()
    };
    let of_language: BTreeSet<String> =
        dictionary.english().flat_map(|text| words(&dictionary.text(text))).collect();
    let english = dictionary.english().flat_map(words);
    english.filter(|word| !of_language.contains(word)).collect()
}

/// What people write is in them.
const FOLDERS: [&str; 5] =
    ["examples", "machines", "testpieces", "parts", "crates/trueaxis-cli/tests/data"];

/// Reports of every kind, of the examples; `V/` stands for their folder of verification.
const ASKED: [&str; 34] = [
    "check machines/xkas2525/machine.toml",
    "pose machines/xkas2525/machine.toml --at X=3000,Y=1200,Z=-700,C=-90,A=15",
    "solve machines/i5-engraver/machine.toml --tip 10,20,30 --axis 0.3,-0.2,0.93",
    "part parts/housing.toml",
    "simulate machines/i5-engraver/machine.toml examples/02_simulate/ring-fanuc.nc",
    "simulate machines/i5-engraver/machine.toml examples/02_simulate/collision-fanuc.nc",
    "trace machines/i5-engraver/machine.toml examples/02_simulate/ring-fanuc.nc --block 25",
    "predict examples/03_predict/nas979-on-xkas2525.toml",
    "predict examples/03_predict/housing.toml",
    "predict examples/03_predict/torque-arm.toml",
    "plan examples/04_plan/probe-ball.toml",
    "plan examples/04_plan/touch-probe-5-minutes.toml",
    "measure examples/04_plan/probe-ball.toml",
    "identify examples/05_identify/mixed-instruments.toml",
    "identify rtcp examples/05_identify/rtcp-engraver.toml",
    "identify expansion examples/05_identify/y-axis-two-temperatures.toml",
    "compensate values machines/three-axis-mill/machine.toml --axis X --step 50",
    "evaluate iso230-1 V/squareness-xy.csv",
    "evaluate iso230-2 V/x-axis-laser.csv",
    "evaluate iso230-3 V/spindle-drift.csv",
    "evaluate iso230-4 V/circle-xy.csv",
    "evaluate iso230-6 V/body-diagonals.csv",
    "evaluate iso230-7 V/spindle-motion.csv",
    "evaluate iso230-10 V/probe-performance.csv",
    "evaluate vdi3441 V/x-axis-laser.csv",
    "evaluate form V/cylinder-points.csv --element cylinder --u 0.3um",
    "verify V/probe-ball.toml",
    "verify --diff machines/xkas2525/machine.toml V/xkas2525-after-a-year.toml",
    "verify --certificate V/certificate.toml",
    "verify --certificate V/certificate-program.toml",
    "verify --before-after V/laser-before-after-x.toml",
    "verify --history V/history --limit EC0X=40urad",
    "verify --part V/nas979-measured.toml",
    "verify --part V/nas979-points.toml",
];

/// Everything that people wrote into the files of the project, with single blanks.
fn written() -> String {
    let mut all = String::new();
    let mut folders: Vec<_> = FOLDERS.iter().map(|name| root().join(name)).collect();
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).expect("a folder").flatten() {
            let path = entry.path();
            let ending = path.extension().unwrap_or_default().to_string_lossy().into_owned();
            if path.is_dir() {
                folders.push(path);
            } else if ["toml", "csv", "nc", "mpf"].contains(&ending.as_str()) {
                all.push_str(&std::fs::read_to_string(path).unwrap_or_default());
            }
        }
    }
    all.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// The names in them: what stands between quotes, commas, brackets and the like.
fn names_of(written: &str) -> BTreeSet<&str> {
    written.split(['"', '[', ']', '.', '\'', ',', ';', ':', '(', ')', '_']).map(str::trim).collect()
}

/// Pieces of a line without a sign that English does not have, and without lines of files.
fn pieces(line: &str) -> Vec<String> {
    let is_end = |c: char| "()[]:;,<>".contains(c);
    let mut found = Vec::new();
    for part in line.split("  ").flat_map(|part| part.split(is_end)).filter(|p| !p.contains(" = "))
    {
        let words: Vec<&str> = part.split_whitespace().collect();
        found.extend(words.split(|word| !word.is_ascii()).map(|piece| piece.join(" ")));
    }
    found
}

/// The pieces with English words that stand in no file; a name may stand between words of the other language.
fn english_of(text: &str, written: &str, english: &BTreeSet<String>) -> Vec<String> {
    let names = names_of(written);
    let is_english = |word: &str| english.contains(word);
    let is_named = |piece: &String| {
        let words: Vec<&str> = piece.split(' ').collect();
        let first = words.iter().position(|word| is_english(word)).unwrap_or_default();
        let last = words.iter().rposition(|word| is_english(word)).unwrap_or_default();
        let is_written = |from: usize| {
            words.get(from..).is_some_and(|w| w.len() > 1 && written.contains(&w.join(" ")))
        };
        let is_name = (0..=first).any(|from| {
            let run = |to: usize| words.get(from..=to).unwrap_or_default().join(" ");
            (last..words.len()).any(|to| names.contains(run(to).as_str()))
        });
        is_name || (0..=first).any(is_written)
    };
    let found = text.lines().flat_map(pieces).filter(|piece| piece.split(' ').any(is_english));
    found.filter(|piece| !is_named(piece)).collect()
}

/// Words by words, with blanks where a value has them.
fn words_of(asked: &str) -> Vec<String> {
    let blank = |word: &str| match word {
        "V/history" => "examples/07_verify/history".to_owned(),
        _ if word.contains('=') || word.starts_with(|c: char| c.is_ascii_digit()) => {
            word.replace(',', " ").replace("um", " um").replace("urad", " urad")
        }
        _ => word.replace("V/", "examples/07_verify/"),
    };
    asked.split(' ').map(blank).collect()
}

/// The texts of the page, with those of its pictures; standard output where a command has no report.
fn told(asked: &str, language: &str, folder: &Folder) -> Vec<String> {
    let page = folder.path("report.html");
    let mut words = words_of(asked);
    words.extend(["--language", language].map(str::to_owned));
    let is_door = !["check", "compensate"].contains(&words[0].as_str());
    if is_door {
        words.extend(["--report", &page].map(str::to_owned));
    }
    let ran = trueaxis(&words.iter().map(String::as_str).collect::<Vec<_>>());
    assert!(!ran.out.is_empty(), "{asked}: {}", ran.err);
    if !is_door {
        return ran.out.lines().map(str::to_owned).collect();
    }
    let html = std::fs::read_to_string(&page).expect("the report");
    let (_, body) = html.split_once("<body>").expect("a body");
    let between = body.split('>').filter_map(|piece| piece.split('<').next());
    between.map(str::trim).filter(|text| !text.is_empty()).map(str::to_owned).collect()
}

#[test]
fn law_no_english_is_left_in_the_reports_of_the_examples() {
    let (folder, written) = (Folder::new("languages"), written());
    let languages = [("de", ReportLanguage::German), ("zh", ReportLanguage::Chinese)]
        .map(|(code, language)| (code, english_words(language)));
    let mut left = Vec::new();
    for asked in ASKED {
        for (language, english) in &languages {
            let texts = told(asked, language, &folder).join("\n");
            left.extend(
                english_of(&texts, &written, english)
                    .into_iter()
                    .map(|t| format!("{asked}: {language}: {t}")),
            );
        }
    }
    assert!(left.is_empty(), "{} texts:\n{}", left.len(), left.join("\n"));
}

/// Every number of a report, smallest first: a sentence of another language has them in another order.
fn numbers_of(texts: &[String]) -> Vec<String> {
    let text = texts.join("\n");
    let is_part = |c: char| c.is_ascii_digit() || c == '.';
    let mut numbers: Vec<String> = text
        .split(|c| !is_part(c))
        .map(|number| number.trim_matches('.').to_owned())
        .filter(|number| !number.is_empty())
        .collect();
    numbers.sort_unstable();
    numbers
}

#[test]
fn law_the_numbers_of_a_report_are_those_of_every_language() {
    let folder = Folder::new("numbers");
    for asked in ASKED.iter().step_by(3) {
        let english = numbers_of(&told(asked, "en", &folder));
        for language in ["de", "zh"] {
            assert_eq!(numbers_of(&told(asked, language, &folder)), english, "{asked}: {language}");
        }
    }
}

#[test]
fn json_is_that_of_every_language_and_another_language_is_refused() {
    let asked = ["evaluate", "iso230-2", "examples/07_verify/x-axis-laser.csv", "--format", "json"];
    let of = |language| trueaxis(&[&asked[..], &["--language", language]].concat());
    assert_eq!(of("de").out, of("en").out);
    let refused = of("fr");
    assert_eq!(refused.status, 2);
    assert!(refused.err.contains("the languages are en, de, zh"), "{}", refused.err);
}
