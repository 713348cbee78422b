//! The dictionaries of this program: each can be read, and all languages have the same texts.

use std::collections::BTreeSet;
use trueaxis_report::Language;
use trueaxis_words::{REPORT_LANGUAGES, ReportLanguage};

fn texts(report_language: ReportLanguage) -> BTreeSet<&'static str> {
    let dictionary = report_language.dictionary().expect("a dictionary");
    // One that cannot be read is empty: the example `untranslated` says what is wrong with it.
    assert!(
        !dictionary.is_empty(),
        "{report_language:?}: cargo run -p trueaxis-words --example untranslated"
    );
    dictionary.english().collect()
}

#[test]
fn all_languages_have_the_same_texts() {
    let (german, chinese) = (texts(ReportLanguage::German), texts(ReportLanguage::Chinese));
    let only = |a: &BTreeSet<&'static str>, b: &BTreeSet<&'static str>| -> Vec<&'static str> {
        a.difference(b).copied().collect()
    };
    assert_eq!(only(&german, &chinese), Vec::<&str>::new(), "in German only");
    assert_eq!(only(&chinese, &german), Vec::<&str>::new(), "in Chinese only");
}

#[test]
fn names_and_numbers_stay() {
    for (_, report_language) in REPORT_LANGUAGES {
        let names = ["tool 5.nc", "part 4.toml", "line 2.csv", "examples/path 3.h"];
        for text in names {
            assert_eq!(report_language.text(text), text, "{report_language:?}");
        }
        for text in ["", "EXX", "2.50 µm", "examples/part.nc", "my machine", "A. Meyer", "G54 X10"]
        {
            assert_eq!(report_language.text(text), text, "{report_language:?}");
        }
    }
}

#[test]
fn a_name_in_a_sentence_stays() {
    let german = ReportLanguage::German;
    assert_eq!(german.text("tool 5.nc on mill"), "tool 5.nc auf mill");
    assert_eq!(german.text("part 4.nc compensated for mill"), "part 4.nc, kompensiert für mill");
}
