//! The texts of reports in German and Chinese.
//!
//! Reports are written in English, as sentences with values in them. A dictionary has each sentence once, with `{0}`, `{1}`
//! in the places of the values, and the same sentence in the other language. A value that is itself a text of the
//! dictionary (an index, an axis, a kind of error) is said in the other language too. What is not found stays English: names
//! of files, of errors and of people are never changed.
//!
//! - [`ReportLanguage`]: the languages, as a command or the page names them;
//! - [`Dictionary`]: the texts of one, found by the English text.
//!
//! ```
//! use trueaxis_report::Language;
//! use trueaxis_words::ReportLanguage;
//! let german = ReportLanguage::named("de").unwrap();
//! assert_eq!(german.text("Warnings"), "Warnungen");
//! assert_eq!(german.text("my machine"), "my machine");
//! ```

mod dictionary;
mod files;
mod pattern;

pub use dictionary::{Dictionary, DictionaryError};

use files::{CHINESE_FILES, GERMAN_FILES};
use std::sync::LazyLock;
use trueaxis_report::Language;

/// A language of reports.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum ReportLanguage {
    /// As the reports are written.
    #[default]
    English,
    /// German.
    German,
    /// Simplified Chinese.
    Chinese,
}

/// The languages with their codes, which HTML and the command line use.
pub const REPORT_LANGUAGES: [(&str, ReportLanguage); 3] = [
    ("en", ReportLanguage::English),
    ("de", ReportLanguage::German),
    ("zh", ReportLanguage::Chinese),
];

static GERMAN: LazyLock<Dictionary> = LazyLock::new(|| Dictionary::compiled(GERMAN_FILES));
static CHINESE: LazyLock<Dictionary> = LazyLock::new(|| Dictionary::compiled(CHINESE_FILES));

impl ReportLanguage {
    /// The language of a code; none for any other than `en`, `de` and `zh`.
    pub fn named(code: &str) -> Option<Self> {
        REPORT_LANGUAGES
            .iter()
            .find(|(known, _)| *known == code)
            .map(|(_, report_language)| *report_language)
    }

    /// As a report takes it.
    pub fn language(self) -> &'static dyn Language {
        match self {
            Self::English => &Self::English,
            Self::German => &Self::German,
            Self::Chinese => &Self::Chinese,
        }
    }

    /// Its texts; none of English.
    pub fn dictionary(self) -> Option<&'static Dictionary> {
        match self {
            Self::English => None,
            Self::German => Some(&GERMAN),
            Self::Chinese => Some(&CHINESE),
        }
    }
}

impl Language for ReportLanguage {
    fn code(&self) -> &str {
        match self {
            Self::English => "en",
            Self::German => "de",
            Self::Chinese => "zh",
        }
    }

    fn text(&self, english: &str) -> String {
        match self.dictionary() {
            None => english.to_owned(),
            Some(dictionary) => dictionary.text(english),
        }
    }
}
