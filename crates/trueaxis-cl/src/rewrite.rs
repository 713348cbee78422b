//! The same file with other points.

use super::{ClFile, ClPoint, Word};
use std::io::Write;

const INCH_MM: f64 = 25.4;

impl ClFile {
    /// The same statements with other points: the first for the first GOTO, and so on. Lines, feeds
    /// and all other words stay; [`Self::rewritten`] is its text.
    pub fn with_points(&self, points: &[ClPoint]) -> Self {
        let mut file = self.clone();
        let mut next = points.iter();
        for record in &mut file.records {
            if let Word::Goto(point) = &mut record.word
                && let Some(new) = next.next()
            {
                *point = *new;
            }
        }
        file
    }

    /// Whether the points are rows of a table, without APT words.
    pub fn is_table(&self) -> bool {
        self.records.iter().all(|r| match r.word {
            Word::Goto(_) => !self.statement(r).iter().any(u8::is_ascii_uppercase),
            Word::Comment(_) | Word::Noted => true,
            _ => false,
        })
    }

    fn statement(&self, record: &super::Record) -> &[u8] {
        self.source.get(record.span.clone()).unwrap_or_default()
    }

    /// The text with every point as it is in the records, in the units of the file with nine
    /// decimals; everything else byte for byte. GODLTA becomes GOTO.
    ///
    /// ```
    /// use trueaxis_cl::{ClFile, ClPoint, Reading};
    /// let text = b"UNITS/MM\nMULTAX/ON\nFEDRAT/100\nGOTO/1,2,3, $\n0,0,1\nFINI\n".to_vec();
    /// let (file, _) = ClFile::read("a.cls", text, &Reading::default());
    /// let mut point = *file.points().next().unwrap().1;
    /// point.tip_mm[0] = 1.5;
    /// let text = file.with_points(&[point]).rewritten();
    /// assert!(String::from_utf8(text).unwrap().contains("GOTO/1.5,2,3, $\n0,0,1\nFINI"));
    /// ```
    pub fn rewritten(&self) -> Vec<u8> {
        let mut text = Vec::with_capacity(self.source.len() + self.source.len() / 4);
        let mut done = 0;
        let (mut unit_mm, mut translation) = (1.0, [0.0; 3]);
        for record in &self.records {
            match &record.word {
                Word::Inches(inches) => unit_mm = if *inches { INCH_MM } else { 1.0 },
                Word::Translation(by) => translation = *by,
                Word::Goto(point) => {
                    let tip_mm = std::array::from_fn(|i| point.tip_mm[i] - translation[i]);
                    let point = &ClPoint { tip_mm, ..*point };
                    let span = record.span.clone();
                    text.extend_from_slice(self.source.get(done..span.start).unwrap_or_default());
                    write_point(&mut text, self.statement(record), point, unit_mm);
                    done = span.end;
                }
                _ => {}
            }
        }
        text.extend_from_slice(self.source.get(done..).unwrap_or_default());
        text
    }
}

/// A point as its statement was: as a row or a GOTO, on one line or two, with its end of line.
fn write_point(text: &mut Vec<u8>, old: &[u8], point: &ClPoint, unit_mm: f64) {
    let row = !old.iter().any(u8::is_ascii_alphabetic) || !old.contains(&b'/');
    let continued = old.contains(&b'$');
    let (comma, fold) = match (row, continued) {
        (true, _) => (" ", " "),
        (false, true) => (",", ", $\n"),
        (false, false) => (",", ","),
    };
    let number = |v: f64, digits: usize| {
        let written = format!("{v:.digits$}");
        let short = written.trim_end_matches('0').trim_end_matches('.');
        if short.is_empty() || short == "-0" { "0".to_owned() } else { short.to_owned() }
    };
    let join = |values: [f64; 3], digits: usize| values.map(|v| number(v, digits)).join(comma);
    let word = if row { "" } else { "GOTO/" };
    // Writing to a Vec cannot fail.
    let _ = write!(
        text,
        "{word}{}{fold}{}",
        join(point.tip_mm.map(|v| v / unit_mm), 9),
        join(point.axis, 12)
    );
    let end = old.iter().rposition(|b| !b"\r\n".contains(b)).map_or(0, |i| i + 1);
    text.extend_from_slice(&old[end..]);
}
