//! Cutter-location files: those of others, bad ones, any bytes.

#![allow(clippy::print_stdout, reason = "says what was read and what is not here")]

mod support;

use proptest::prelude::*;
use std::collections::BTreeMap;
use std::fmt::Write;
use support::outside;
use trueaxis_nc::cl::{ClFile, Reading, Word};

fn read(text: &str) -> (ClFile, Vec<(usize, &'static str)>) {
    let (file, problems) = ClFile::read("a.cls", text.as_bytes().to_vec(), &Reading::default());
    let found = problems.iter().map(|p| (p.place.line, p.code)).collect();
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
        assert!(!problems.has_errors(), "{problems:?}");
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
