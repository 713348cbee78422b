//! Reports in German and Chinese: no English is left in those of the examples, values and verdicts are the same.

mod command;

use command::{Folder, root, trueaxis};

/// Words of English sentences.
const ENGLISH: [&str; 19] = [
    "the", "of", "and", "with", "without", "from", "which", "are", "is", "by", "than", "each",
    "every", "between", "largest", "at", "not", "no", "to",
];

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

/// Pieces of a line in which only English words stand.
fn pieces(line: &str) -> impl Iterator<Item = String> {
    let is_end = |c: char| !c.is_ascii() || "()[]:;,".contains(c);
    let words = line.split("  ").flat_map(move |part| part.split(is_end).map(str::to_owned));
    words.map(|piece| piece.split_whitespace().collect::<Vec<_>>().join(" "))
}

/// The pieces with English words that stand in no file; a name may follow a word of the other language.
fn english_of(text: &str, written: &str) -> Vec<String> {
    let is_english = |word: &str| ENGLISH.contains(&word);
    let is_named = |piece: &String| {
        let words: Vec<&str> = piece.split(' ').collect();
        let first = words.iter().position(|word| is_english(word)).unwrap_or_default();
        (0..=first).any(|from| words.get(from..).is_some_and(|w| written.contains(&w.join(" "))))
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

/// Standard output and, one in a line, the texts of the page, with those of its pictures.
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
    let mut texts: Vec<String> = ran.out.lines().map(str::to_owned).collect();
    if is_door {
        let html = std::fs::read_to_string(&page).expect("the report");
        let (_, body) = html.split_once("<body>").expect("a body");
        let between = body.split('>').filter_map(|piece| piece.split('<').next());
        texts.extend(between.map(str::trim).filter(|text| !text.is_empty()).map(str::to_owned));
    }
    texts
}

#[test]
fn law_no_english_is_left_in_the_reports_of_the_examples() {
    let (folder, written) = (Folder::new("languages"), written());
    let mut left = Vec::new();
    for asked in ASKED {
        for language in ["de", "zh"] {
            let texts = told(asked, language, &folder).join("\n");
            left.extend(
                english_of(&texts, &written)
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
