//! A sentence with values: `{0}` is any text, `{0n}` a text that begins with a number.

use std::fmt;

/// What a place of a sentence takes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Hole {
    number: usize,
    is_numeric: bool,
}

/// Texts with holes between them: one text more than holes.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Pattern {
    texts: Vec<String>,
    holes: Vec<Hole>,
}

/// Braces that are no place of a value.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct NoPattern(String);

impl fmt::Display for NoPattern {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "`{{{}}}` is not a place such as {{0}} or {{0n}}", self.0)
    }
}

impl Pattern {
    pub(crate) fn of(sentence: &str) -> Result<Self, NoPattern> {
        let mut pieces = sentence.split('{');
        let mut pattern =
            Self { texts: vec![pieces.next().unwrap_or_default().to_owned()], holes: Vec::new() };
        for piece in pieces {
            let (hole, text) = piece.split_once('}').ok_or_else(|| NoPattern(piece.to_owned()))?;
            let digits = hole.strip_suffix('n').unwrap_or(hole);
            let number = digits.parse().map_err(|_| NoPattern(hole.to_owned()))?;
            pattern.holes.push(Hole { number, is_numeric: hole.ends_with('n') });
            pattern.texts.push(text.to_owned());
        }
        Ok(pattern)
    }

    pub(crate) fn has_holes(&self) -> bool {
        !self.holes.is_empty()
    }

    /// Letters outside the holes: of two sentences that fit, the one with more says more.
    pub(crate) fn weight(&self) -> usize {
        self.texts.iter().map(|text| text.chars().count()).sum()
    }

    /// Which values it has, in order.
    pub(crate) fn values(&self) -> Vec<usize> {
        let mut numbers: Vec<usize> = self.holes.iter().map(|hole| hole.number).collect();
        numbers.sort_unstable();
        numbers.dedup();
        numbers
    }

    /// The values of a text that fits, by their numbers.
    pub(crate) fn fits<'t>(&self, text: &'t str) -> Option<Vec<&'t str>> {
        let (first, texts) = self.texts.split_first()?;
        let rest = text.strip_prefix(first.as_str())?;
        let mut values = vec![""; self.values().last().map_or(0, |last| last + 1)];
        self.fill(texts, &self.holes, rest, &mut values).then_some(values)
    }

    /// The shortest value first that lets the rest fit.
    fn fill<'t>(
        &self,
        texts: &[String],
        holes: &[Hole],
        rest: &'t str,
        values: &mut [&'t str],
    ) -> bool {
        let (Some((hole, holes)), Some((text, texts))) = (holes.split_first(), texts.split_first())
        else {
            return rest.is_empty();
        };
        let ends: Vec<usize> = if holes.is_empty() {
            rest.strip_suffix(text.as_str()).map(str::len).into_iter().collect()
        } else {
            rest.match_indices(text.as_str()).map(|(at, _)| at).collect()
        };
        for end in ends {
            let (Some(value), Some(after)) = (rest.get(..end), rest.get(end + text.len()..)) else {
                continue;
            };
            if !hole.takes(value) {
                continue;
            }
            if let Some(place) = values.get_mut(hole.number) {
                *place = value;
            }
            if self.fill(texts, holes, after, values) {
                return true;
            }
        }
        false
    }

    /// Whether the text after the hole of a value is the ending of a file's name, as in `{0}.nc on {1}`.
    pub(crate) fn ends_a_name(&self, number: usize) -> bool {
        let texts = self.texts.iter().skip(1).zip(&self.holes);
        texts.filter(|(_, hole)| hole.number == number).any(|(text, _)| {
            let mut signs = text.chars();
            signs.next() == Some('.') && signs.next().is_some_and(char::is_alphabetic)
        })
    }

    /// The sentence with values in its holes.
    pub(crate) fn with(&self, values: &[String]) -> String {
        let mut said = String::new();
        for (i, text) in self.texts.iter().enumerate() {
            said.push_str(text);
            let value = self.holes.get(i).and_then(|hole| values.get(hole.number));
            said.push_str(value.map_or("", String::as_str));
        }
        said
    }
}

impl Hole {
    fn takes(self, value: &str) -> bool {
        let first = value.trim_start().chars().next();
        match first {
            None => false,
            Some(_) if !self.is_numeric => true,
            Some(sign) => (sign.is_ascii_digit() || "+-−–±".contains(sign)) && !names_a_file(value),
        }
    }
}

/// Whether a letter follows a point, as in `part 5.nc`: a name, of which no word is said in another language.
pub(crate) fn names_a_file(text: &str) -> bool {
    let mut characters = text.chars().peekable();
    let mut before = ' ';
    while let Some(c) = characters.next() {
        let after = characters.peek().copied().unwrap_or(' ');
        if c == '.' && before.is_alphanumeric() && after.is_ascii_alphabetic() {
            return true;
        }
        before = c;
    }
    false
}

#[cfg(test)]
mod tests {
    use super::*;

    fn values<'t>(sentence: &str, text: &'t str) -> Option<Vec<&'t str>> {
        Pattern::of(sentence).unwrap().fits(text)
    }

    #[test]
    fn values_are_found_between_the_texts() {
        assert_eq!(values("{0} of {1}", "3 of 5"), Some(vec!["3", "5"]));
        assert_eq!(values("{1} of {0}", "3 of 5"), Some(vec!["5", "3"]));
        assert_eq!(values("worst: {0} µm", "worst: 2.5 µm"), Some(vec!["2.5"]));
        assert_eq!(values("worst: {0} µm", "worst: 2.5 mm"), None);
        assert_eq!(values("{0n} lines", "all lines"), None);
        assert_eq!(values("{0n} lines", "−3 lines"), Some(vec!["−3"]));
        // The first " of " does not let the rest fit.
        assert_eq!(values("{0} of {1n}", "end of part of 5"), Some(vec!["end of part", "5"]));
        assert_eq!(values("{0}.", "."), None);
        assert_eq!(values("a{0}", "b1"), None);
        assert_eq!(values("tool {0n}", "tool 5.nc"), None);
    }

    #[test]
    fn other_braces_are_said() {
        assert!(Pattern::of("{x}").is_err() && Pattern::of("{0").is_err());
    }
}
