//! The texts of one language, found by the English text.

use crate::pattern::Pattern;
use std::collections::HashMap;
use std::fmt;
use toml::de::DeTable;

/// A value inside a value inside a value: deeper, texts stay English.
const DEEPEST: usize = 4;

/// The texts of one language.
#[derive(Debug, Default)]
pub struct Dictionary {
    /// Texts without values, and sentences as they stand in the files.
    texts: HashMap<String, String>,
    /// Sentences with values: English and the other, those that say most first.
    sentences: Vec<(Pattern, Pattern)>,
}

/// A line of a dictionary that cannot be used.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct DictionaryError(String);

impl fmt::Display for DictionaryError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for DictionaryError {}

impl Dictionary {
    /// From TOML files of `"English" = "other"`.
    ///
    /// ```
    /// use trueaxis_words::Dictionary;
    /// let file = "\"{0n} of {1n} points\" = \"{0} von {1} Punkten\"\n\"{0} of {1}\" = \"{0} von {1}\"\nerror = \"Fehler\"";
    /// let german = Dictionary::read(&[("de.toml", file)]).unwrap();
    /// assert_eq!(german.text("3 of 5 points"), "3 von 5 Punkten");
    /// assert_eq!(german.text("error of EXX"), "Fehler von EXX");
    /// assert_eq!(german.text("EXX"), "EXX");
    /// // Of several sentences each is looked up; one that is not known leaves all of them English.
    /// let file = "\"All is well.\" = \"Alles ist gut.\"\n\"There remain {0n}.\" = \"Es bleiben {0}.\"";
    /// let german = Dictionary::read(&[("de.toml", file)]).unwrap();
    /// assert_eq!(german.text("All is well. There remain 5 µm."), "Alles ist gut. Es bleiben 5 µm.");
    /// assert_eq!(german.text("All is well. Who knows."), "All is well. Who knows.");
    /// ```
    ///
    /// # Errors
    /// Names the file and the line: not TOML, a text that another file says otherwise, other values than the English sentence.
    pub fn read(files: &[(&str, &str)]) -> Result<Self, DictionaryError> {
        let mut dictionary = Self::default();
        for (name, content) in files {
            let wrong = |said: String| DictionaryError(format!("{name}: {said}"));
            let table = DeTable::parse(content).map_err(|e| wrong(format!("{e}")))?;
            for (english, other) in table.get_ref() {
                let english = english.get_ref().as_ref();
                let other = other.get_ref().as_str();
                let other = other.ok_or_else(|| wrong(format!("`{english}` has no text")))?;
                dictionary.add(english, other).map_err(wrong)?;
            }
        }
        // The order of equal ones is that of the files.
        dictionary.sentences.sort_by_key(|(english, _)| std::cmp::Reverse(english.weight()));
        Ok(dictionary)
    }

    /// Those that stand in this program: a test reads them.
    pub(crate) fn compiled(files: &[(&str, &str)]) -> Self {
        Self::read(files).unwrap_or_default()
    }

    fn add(&mut self, english: &str, other: &str) -> Result<(), String> {
        let pattern = |text: &str| Pattern::of(text).map_err(|e| format!("`{text}`: {e}"));
        let (sentence, said) = (pattern(english)?, pattern(other)?);
        if sentence.values() != said.values() {
            return Err(format!("`{english}` has other values than `{other}`"));
        }
        if sentence.has_holes() {
            self.sentences.push((sentence, said));
        }
        match self.texts.insert(english.to_owned(), other.to_owned()) {
            Some(before) if before != other => {
                Err(format!("`{english}` is `{before}` in another file, and `{other}` here"))
            }
            _ => Ok(()),
        }
    }

    /// A text in this language; the same text where nothing fits.
    pub fn text(&self, english: &str) -> String {
        self.deep(english, 0)
    }

    fn deep(&self, english: &str, depth: usize) -> String {
        let is_number = !english.chars().any(char::is_alphabetic);
        if is_number || depth > DEEPEST {
            return english.to_owned();
        }
        if let Some(text) = self.texts.get(english) {
            return text.clone();
        }
        let fitting = self.sentences.iter().find_map(|(sentence, said)| {
            let values = sentence.fits(english)?;
            let said_of = |(number, value): (usize, &str)| match sentence.ends_a_name(number) {
                true => value.to_owned(),
                false => self.deep(value, depth + 1),
            };
            let values: Vec<String> = values.into_iter().enumerate().map(said_of).collect();
            Some(said.with(&values))
        });
        fitting.or_else(|| self.in_sentences(english, depth)).unwrap_or_else(|| english.to_owned())
    }

    /// Sentences one after the other; none if one of them is not known.
    fn in_sentences(&self, english: &str, depth: usize) -> Option<String> {
        let ends = english.match_indices(". ").map(|(at, _)| at + 1);
        let begins_one = |at: &usize| {
            let rest = english.get(*at..).unwrap_or_default();
            rest.trim_start().chars().next().is_some_and(char::is_uppercase)
        };
        let ends: Vec<usize> = ends.filter(begins_one).collect();
        if ends.is_empty() {
            return None;
        }
        let mut said = Vec::new();
        let mut from = 0;
        for end in ends.into_iter().chain([english.len()]) {
            let sentence = english.get(from..end)?.trim();
            let other = self.deep(sentence, depth + 1);
            if other == sentence {
                return None;
            }
            said.push(other);
            from = end;
        }
        Some(said.join(" "))
    }

    /// How many texts it has.
    pub fn len(&self) -> usize {
        self.texts.len()
    }

    /// Whether it has none.
    pub fn is_empty(&self) -> bool {
        self.texts.is_empty()
    }

    /// Its English texts, as they stand in the files.
    pub fn english(&self) -> impl Iterator<Item = &str> {
        self.texts.keys().map(String::as_str)
    }
}
