//! Cutter-location files: those of others, bad ones, any bytes.

#![allow(clippy::print_stdout, reason = "says what was read and what is not here")]

use proptest::prelude::*;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use trueaxis_cl::{ClCircle, ClFile, ClPath, ClTool, Reading, Word};
use trueaxis_input::Severity;
use trueaxis_nc::moves::SpindleDirection;

/// A folder or file of the outside data, or `None` with a message.
fn outside(path: &str) -> Option<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).ancestors().nth(3)?;
    let found = Some(root.join("shared/data/outside").join(path)).filter(|p| p.exists());
    if found.is_none() {
        println!("skipped: {path} of the outside data is not here");
    }
    found
}

fn read(text: &str) -> (ClFile, Vec<(usize, &'static str)>) {
    let (file, problems) = ClFile::read("a.cls", text.as_bytes().to_vec(), &Reading::default());
    let mut found: Vec<_> = problems.iter().map(|p| (p.place.line, p.code)).collect();
    found.sort_unstable();
    (file, found)
}

/// Every byte that is no blank belongs to exactly one record, in order.
fn assert_lossless(file: &ClFile) {
    let (mut end, mut line) = (0, 0);
    let blank = |b: &[u8]| b.iter().all(|b| b.is_ascii_whitespace() || b"\xEF\xBB\xBF".contains(b));
    for record in file.records() {
        assert!(record.span.start >= end && record.line > line, "{record:?}");
        assert!(blank(&file.source()[end..record.span.start]), "lost before {record:?}");
        (end, line) = (record.span.end, record.line);
    }
    assert!(blank(&file.source()[end..]));
}

#[test]
fn oracle_cutter_locations_of_others_are_read() {
    let Some(folder) = outside("cl") else { return };
    let sets = [
        // file, points, circles, extents in mm as the file's own numbers say
        ("4r19415__5-axis-Rotation-tool-center-point-RTCP-/finition.ncl", 35_418, 0),
        ("aamorim1913__AptPostProcessor/parts-2021_Sacrifice-Board.apt", 494, 70),
        ("aamorim1913__AptPostProcessor/parts-2021_Teste-Metrologia.apt", 454, 65),
        ("aamorim1913__AptPostProcessor/parts-tools_boss.apt", 9814, 1026),
        ("aamorim1913__AptPostProcessor/parts-tools_wall-holes.apt", 1864, 336),
        ("karlo-c277__CATIAV5-Post-Processor-/DEMO1.txt", 11, 0),
        ("karlo-c277__CATIAV5-Post-Processor-/DEMO2.txt", 2, 0),
        ("karlo-c277__CATIAV5-Post-Processor-/DEMO3.txt", 198, 0),
        ("karlo-c277__CATIAV5-Post-Processor-/DEMO4.txt", 22, 0),
        ("sashainna__NCL_in_VisualStudio/pmill_fromB.as", 2094, 0),
        ("zhxinhust__virtualfiveaxisCNCmachining/PathPointsFile.cls", 39, 0),
        ("zhxinhust__virtualfiveaxisCNCmachining/pathdata2.txt", 395, 0),
    ];
    for (name, points, circles) in sets {
        let text = std::fs::read(folder.join(name)).unwrap();
        let (file, problems) = ClFile::read(name, text, &Reading::default());
        let mut codes = BTreeMap::new();
        for problem in problems.iter() {
            *codes.entry(problem.code).or_insert(0) += 1;
        }
        let extent = file.extent().unwrap();
        println!("{name}: {} records, {extent:?}, {codes:?}", file.records().len());
        let errors = problems.iter().filter(|p| p.severity == Severity::Error).map(|p| p.code);
        let wanted: &[&str] = match name.rsplit('/').next() {
            // CYCLE/TAP with two numbers: no word says what the second is, nor is there a pitch.
            Some("DEMO2.txt") => &["bad-cycle"],
            // ROTABL: a table turns between the points.
            Some("DEMO3.txt") => &["motion-not-read"],
            // The last line has no end, and there is no FINI: a cut file would look the same.
            Some("pathdata2.txt") => &["cut-file"],
            _ => &[],
        };
        assert!(errors.eq(wanted.iter().copied()), "{problems:?}");
        assert_lossless(&file);
        assert_eq!(extent.points, points, "{name}");
        let found = file.records().iter().filter(|r| matches!(r.word, Word::Circle(_))).count();
        assert_eq!(found, circles, "{name}");
    }
    let mut all = 0;
    for i in 0..20 {
        let name = format!("zhangty019__MultiAxis_3DP_MotionPlanning/simple_curve/{i}.txt");
        let text = std::fs::read(folder.join(&name)).unwrap();
        let lines = text.split(|b| *b == b'\n').filter(|l| !l.trim_ascii().is_empty()).count();
        let (file, problems) = ClFile::read(&name, text, &Reading::default());
        assert!(!problems.has_errors(), "{problems:?}");
        assert_lossless(&file);
        assert_eq!(file.points().count(), lines);
        all += lines;
    }
    println!("simple_curve: {all} points");
}

#[test]
fn a_file_by_hand() {
    let (file, found) = read(
        "$$ demo\nPARTNO A $ B\nUNITS/MM\nLOADTL/7\nCUTTER/10.,2.\nSPINDL/RPM,1000,CCLW\n\
         TLAXIS/0,0.6,0.8\nRAPID\nGOTO/1,2,3\nFEDRAT/100,MMPM\nGOTO/4,5, $\n 6\n\
         CIRCLE/0,0,6,0,0,2\nGOTO/5,4,6\nGODLTA/0,0,1\nDELAY/2\nCOOLNT/OFF\nFINI\n",
    );
    assert!(found.is_empty(), "{found:?}");
    assert_lossless(&file);
    let points: Vec<_> = file.points().map(|(line, p)| (line, p.tip_mm, p.rapid)).collect();
    let wanted = [
        (9, [1.0, 2.0, 3.0], true),
        (11, [4.0, 5.0, 6.0], false),
        (14, [5.0, 4.0, 6.0], false),
        (15, [5.0, 4.0, 7.0], false),
    ];
    assert_eq!(points, wanted);
    assert!(file.points().all(|(_, p)| p.axis == [0.0, 0.6, 0.8]));
    let has = |word: Word| file.records().iter().any(|r| r.word == word);
    assert!(
        has(Word::Tool(ClTool { number: 7, ..ClTool::default() }))
            && has(Word::Delay(2.0))
            && has(Word::End)
    );
    assert!(has(Word::Cutter { diameter_mm: 10.0, corner_radius_mm: Some(2.0) }));
    assert!(has(Word::Spindle(SpindleDirection::CounterClockwise, Some(1000.0))));
    assert!(has(Word::Comment("A $ B".to_owned())));
    let circle = ClCircle { center_mm: [0.0, 0.0, 6.0], normal: [0.0, 0.0, 1.0], turn_rad: None };
    assert!(has(Word::Circle(circle)));
}

/// Creo writes records for itself after `$$->`, in several lines: they are no points.
#[test]
fn records_of_creo_are_no_points() {
    let text = "$$-> MFGNO / PLATE\nPARTNO / PLATE\n$$-> FEATNO / 39\nUNITS / MM\nLOADTL / 1\n$$-> CUTTER / 10.0\n\
                $$-> CSYS / 1.0, 0.0, 0.0, 0.0, $\n            0.0, 1.0, 0.0, 0.0, $\n            0.0, 0.0, 1.0, 0.0\n\
                SPINDL / RPM, 1000.0, CLW\nFEDRAT / 100.0, MMPM\nGOTO / 1.0, 2.0, 3.0\n$$-> END /\nFINI\n";
    let (file, found) = read(text);
    assert_lossless(&file);
    assert_eq!(found, [(12, "no-tool-axis")]);
    let points: Vec<_> = file.points().map(|(line, p)| (line, p.tip_mm)).collect();
    assert_eq!(points, [(12, [1.0, 2.0, 3.0])]);
    let cutter = |w: &Word| matches!(w, Word::Cutter { diameter_mm, .. } if *diameter_mm == 10.0);
    assert!(file.records().iter().any(|r| cutter(&r.word)));
    // Another coordinate system on the way is a warning.
    let two = text.replace("$$-> END /", "$$-> CSYS / 1.0, 0.0, 0.0, 50.0\nGOTO / 1.0, 2.0, 3.0");
    assert_eq!(read(&two).1, [(12, "no-tool-axis"), (13, "not-applied")]);
}

#[test]
fn tables_and_inches() {
    let (file, found) = read("x,y,z,i,j,k\n1,2,3,0,0,1\n4 5 6 0 1 0\n7;8;9;1;0;0\n");
    assert_eq!(found, [(0, "no-units")]);
    assert_eq!(file.points().count(), 3);
    let inches = Reading { inches: Some(true) };
    let (file, _) = ClFile::read("a", b"UNITS/MM\nGOTO/1,0,0\n".to_vec(), &inches);
    assert_eq!(file.points().next().map(|(_, p)| p.tip_mm[0]), Some(25.4));
    let (file, _) = read("UNITS/INCHES\nFEDRAT/100,MMPM\nGOTO/1,0,0\nFEDRAT/10\nGOTO/2,0,0\n");
    let feeds: Vec<_> = file.points().map(|(_, p)| p.feed.unwrap().value).collect();
    assert_eq!(feeds, [100.0, 254.0]);
}

#[test]
fn what_is_wrong_is_told_with_its_line() {
    let reported = |text: &str| read(&format!("{text}FINI\n")).1;
    assert_eq!(
        reported("UNITS/MM\nMULTAX/ON\nGOTO/1,2,3\n"),
        [(3, "no-tool-axis"), (3, "no-tool-axis")]
    );
    assert_eq!(reported("UNITS/MM\nGOTO/1,2,3\n"), [(2, "no-tool-axis")]);
    assert_eq!(reported("UNITS/MM\nGOTO/1,2,3,0,0,0\nGOTO/0,0,0,0,0,1\n"), [(2, "zero-tool-axis")]);
    assert_eq!(reported("UNITS/MM\nGOTO/1,2,3,0,0,1.00011\n"), [(2, "axis-not-unit")]);
    assert_eq!(reported("UNITS/MM\nGOTO/1,2,3,0,0,1.00009\n"), []);
    assert_eq!(reported("UNITS/MM\nGOTO/1,nan,3\nGOTO/0,0,0,0,0,1\n"), [(2, "bad-number")]);
    assert_eq!(reported("UNITS/MM\nGOTO/1,2\nGOTO/0,0,0,0,0,1\n"), [(2, "bad-number")]);
    assert_eq!(reported("UNITS/MM\nGOTO/1,2,3,4\nGOTO/0,0,0,0,0,1\n"), [(2, "bad-point")]);
    assert_eq!(reported("UNITS/MM\nGOTO/1e9,2,3\nGOTO/0,0,0,0,0,1\n"), [(2, "too-far")]);
    assert_eq!(
        reported("UNITS/FURLONG\nGOTO/0,0,0,0,0,1\n"),
        [(0, "no-units"), (1, "unknown-unit")]
    );
    assert_eq!(reported("UNITS/MM\nGOFWD/C1\nGOTO/0,0,0,0,0,1\n"), [(2, "motion-not-read")]);
    assert_eq!(reported("UNITS/MM\nABRACA/1\nGOTO/0,0,0,0,0,1\n"), [(2, "unknown-word")]);
    assert_eq!(reported("UNITS/MM\nROTABL/90\nGOTO/0,0,0,0,0,1\n"), [(2, "motion-not-read")]);
    assert_eq!(reported("UNITS/MM\nFEDRAT/-5\nGOTO/0,0,0,0,0,1\n"), [(2, "bad-feed")]);
    assert_eq!(reported("UNITS/MM\n"), [(0, "no-points")]);
    let endless = "GOTO/x\n".repeat(10_000);
    assert!(reported(&endless).len() < 110);
}

const WHOLE: &str = "PARTNO PLATE\nUNITS/MM\nLOADTL/1\nSPINDL/RPM,1000,CLW\nFEDRAT/100,MMPM\nTLAXIS/0,0,1\n\
    GOTO/0,0,30\nGOTO/0,1, $\n 30\nCYCLE/DRILL,FEDTO,8,MMPM,200,RAPTO,3\nGOTO/0,30,-10\nGOTO/10,30, $\n -10\nCYCLE/OFF\n\
    RAPID\nGOTO/0,0,30,0,0,1\nFINI\n";

/// A file that was cut at any byte is never read without a word; where it may have lost more than FINI it is an error.
#[test]
fn law_a_file_that_was_cut_is_not_read_in_silence() {
    assert_eq!(read(WHOLE).1, []);
    assert_eq!(read(WHOLE.trim_end()).1, []);
    for length in 0..WHOLE.len() - 5 {
        let text = &WHOLE[..length];
        let found = read(text).1;
        let ends_line = text.is_empty() || text.ends_with('\n');
        let whole = text.lines().next_back().is_none_or(|line| !line.ends_with('$'));
        let drills =
            text.contains("CYCLE/DRILL,FEDTO,8,MMPM,200,RAPTO,3\n") && !text.contains("CYCLE/OFF");
        let line = text.lines().count().max(1);
        let wanted = if ends_line && whole && !drills { "no-end" } else { "cut-file" };
        let has_points = text.contains("GOTO/0,0,30");
        assert!(!has_points || found.contains(&(line, wanted)), "{text:?} {found:?}");
        let (other, said) = if wanted == "no-end" { ("cut-file", 1) } else { ("no-end", 1) };
        let count = found.iter().filter(|(_, code)| [wanted, other].contains(code)).count();
        assert!(
            count <= said && found.iter().all(|(_, code)| *code != other),
            "{text:?} {found:?}"
        );
    }
    // A part of an NX file ends with its path; a table has no word for its end.
    assert_eq!(read("UNITS/MM\nMULTAX/ON\nGOTO/0,0,1,0,0,1\nEND-OF-PATH\n").1, []);
    let again = "UNITS/MM\nMULTAX/ON\nGOTO/0,0,1,0,0,1\nEND-OF-PATH\nGOTO/0,0,2,0,0,1\n";
    assert_eq!(read(again).1, [(5, "no-end")]);
    assert_eq!(read("1 2 3 0 0 1\n4 5 6 0 0 1").1, [(0, "no-units")]);
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    /// Any bytes are read without panic and without loss, and no number that comes out is infinite.
    #[test]
    fn law_cutter_location_files_survive_any_bytes(
        bytes in prop::collection::vec(any::<u8>(), 0..200),
        pieces in prop::collection::vec(0..PIECES.len(), 0..40),
    ) {
        let mut text: Vec<u8> = pieces.iter().flat_map(|i| PIECES[*i].bytes()).collect();
        for source in [bytes.clone(), { text.extend(bytes); text }] {
            let (file, _) = ClFile::read("a.cls", source, &Reading::default());
            assert_lossless(&file);
            for (_, p) in file.points() {
                prop_assert!(p.tip_mm.iter().chain(&p.axis).all(|v| v.is_finite()));
                let norm = p.axis.iter().map(|v| v * v).sum::<f64>().sqrt();
                prop_assert!((norm - 1.0).abs() < 1e-12);
            }
        }
    }
}

/// Pieces that such files are made of.
const PIECES: [&str; 24] = [
    "GOTO/",
    "1,2,3",
    ",0,0,1",
    "\n",
    "\n",
    "$\n",
    "$$ note\n",
    "RAPID\n",
    "FEDRAT/100,IPM\n",
    "CIRCLE/0,0,0,0,0,1,5\n",
    "MULTAX/ON\n",
    "UNITS/INCHES\n",
    "CYCLE/DRILL,FEDTO,5\n",
    "CYCLE/OFF\n",
    "SPINDL/",
    "TLAXIS/0,1,0\n",
    "1 2 3 0 0 1\n",
    "(",
    ")",
    "'",
    "PARTNO x\n",
    "GODLTA/1\n",
    "SYN/'TLAXIS','$$*'\n",
    "nan",
];

/// Lines of a file, some of which go on in the next one.
const LINES: [&str; 12] = [
    "GOTO/1.5,-2,3.25,0,0,1",
    "GOTO/1.5,-2,4.25,0,0.6,0.8",
    "GOTO / 1, 2, 3, 0, 0, 1",
    "GOTO/1,2,3,0,0,1 $$ note",
    "GOTO/1,2,3, $\n0,0,1",
    "CYCLE/DRILL,FEDTO,3,MMPM,50,RAPTO,1 $\nGOTO/9,9,9,0,0,1",
    "PPRINT $\nGOTO/9,9,8,0,0,1",
    "RAPID",
    "FEDRAT/250",
    "\n  \nGOTO/0,0,0,0,0,2",
    "GOTO/1e3,2,3,0,0,1",
    "GOTO/1,2,3,0,0,0",
];

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, failure_persistence: None, ..ProptestConfig::default() })]

    /// Points in their plain form are what the same lines with a blank before them are, which are read as any
    /// other statement; over several blocks of a long file. And the path has the words of the file.
    #[test]
    fn law_plain_points_are_read_as_other_statements(
        lines in proptest::collection::vec(0..LINES.len(), 50..400), crlf in any::<bool>(),
    ) {
        let mut text = String::new();
        let times = 700_000 / (20 * lines.len());
        for line in lines.iter().cycle().take(times * lines.len()) {
            text.push_str(LINES[*line]);
            text.push('\n');
        }
        let text = if crlf { text.replace('\n', "\r\n") } else { text };
        let spaced = text.replace("GOTO", " GOTO");
        let reading = Reading::default();
        let (file, problems) = ClFile::read("a.cls", text.clone().into_bytes(), &reading);
        let (wanted, wanted_problems) = ClFile::read("a.cls", spaced.into_bytes(), &reading);
        let same = file.records().iter().zip(wanted.records()).all(|(a, b)| {
            (a.line, &a.word) == (b.line, &b.word)
        });
        prop_assert!(same && file.records().len() == wanted.records().len());
        prop_assert!(problems.iter().eq(wanted_problems.iter()));
        assert_lossless(&file);

        let (path, path_problems) = ClPath::read("a.cls", text.as_bytes(), &reading);
        prop_assert!(path_problems.iter().eq(problems.iter()));
        prop_assert_eq!(path.points(), file.points().count());
        prop_assert!(path == ClPath::from(&file));
        let has_effect = |word: &Word| {
            matches!(word, Word::Goto(_) | Word::Cycle(_) | Word::Insert(_) | Word::Stop { .. })
        };
        let words = file.records().iter().filter(|r| has_effect(&r.word));
        prop_assert!(path.into_words().eq(words.map(|r| (r.line, r.word.clone()))));
    }
}
