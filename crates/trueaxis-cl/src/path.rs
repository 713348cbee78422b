//! The words of a file that make a path, in little memory.

use super::{ClFile, ClPoint, Reading, Word, reader};
use std::collections::VecDeque;
use trueaxis_input::Diagnostics;
use trueaxis_nc::moves::Feed;

/// Points stand together in lists of this length.
const LIST: usize = 1 << 14;

/// What changes from point to point seldom.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Mode {
    rapid: bool,
    feed: Option<Feed>,
    /// The line of a point less its number.
    line: i64,
}

/// The path of a cutter-location file: its points and the words that have an effect on them, without its text.
/// A file of many points needs 48 bytes for each.
///
/// ```
/// use trueaxis_cl::{ClPath, Reading, Word};
/// let text = b"FEDRAT/100\nGOTO/1,2,3,0,0,1\nCOOLNT/ON\nGOTO/1,2,4,0,0,1\nFINI\n";
/// let (path, _) = ClPath::read("a.cls", text, &Reading::default());
/// assert_eq!(path.points(), 2);
/// let lines: Vec<u32> = path.into_words().map(|(line, _)| line).collect();
/// assert_eq!(lines, [2, 3, 4]);
/// ```
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ClPath {
    name: String,
    points: usize,
    lists: VecDeque<Vec<[f64; 6]>>,
    /// Each from a point on.
    modes: Vec<(usize, Mode)>,
    /// Words other than points: before which point, the line, the word.
    words: Vec<(usize, u32, Word)>,
}

impl ClPath {
    /// Reads a file and reports all problems. With errors the path must not be machined.
    pub fn read(name: &str, source: &[u8], reading: &Reading) -> (Self, Diagnostics) {
        let mut path = Self { name: name.to_owned(), ..Self::default() };
        let problems =
            reader::read(name, source, reading, &mut |line, _, word| path.take(line, word));
        (path, problems)
    }

    /// The file as the user named it.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The number of points (GOTO).
    pub fn points(&self) -> usize {
        self.points
    }

    /// All points and the words that have an effect on the path, in order, each with its line. The memory of
    /// points that were handed out is given back.
    pub fn into_words(self) -> impl Iterator<Item = (u32, Word)> {
        let Self { mut lists, modes, words, .. } = self;
        let mut modes = modes.into_iter().peekable();
        let mut words = words.into_iter().peekable();
        let (mut point, mut mode) = (0_usize, None);
        std::iter::from_fn(move || {
            if let Some((_, line, word)) = words.next_if(|(before, ..)| *before == point) {
                return Some((line, word));
            }
            if let Some((_, new)) = modes.next_if(|(from, _)| *from == point) {
                mode = Some(new);
            }
            let numbers = *lists.front()?.get(point % LIST)?;
            let Mode { rapid, feed, line } = mode?;
            let line = (line + point as i64) as u32;
            point += 1;
            if point.is_multiple_of(LIST) {
                lists.pop_front();
            }
            let [x, y, z, i, j, k] = numbers;
            let (tip_mm, axis) = ([x, y, z], [i, j, k]);
            Some((line, Word::Goto(ClPoint { tip_mm, axis, rapid, feed })))
        })
    }

    fn take(&mut self, line: u32, word: Word) {
        match word {
            Word::Goto(point) => self.push(line, &point),
            Word::Arc(circle, point) => {
                self.words.push((self.points, line, Word::Circle(circle)));
                self.push(line, &point);
            }
            Word::Circle(_)
            | Word::Spindle(..)
            | Word::Coolant(_)
            | Word::Tool(_)
            | Word::Cycle(_)
            | Word::CycleOff
            | Word::Delay(_)
            | Word::Stop { .. }
            | Word::Insert(_) => self.words.push((self.points, line, word)),
            _ => {}
        }
    }

    fn push(&mut self, line: u32, point: &ClPoint) {
        let ClPoint { tip_mm: [x, y, z], axis: [i, j, k], rapid, feed } = *point;
        let mode = Mode { rapid, feed, line: i64::from(line) - self.points as i64 };
        if self.modes.last().is_none_or(|(_, last)| *last != mode) {
            self.modes.push((self.points, mode));
        }
        if self.points.is_multiple_of(LIST) {
            self.lists.push_back(Vec::with_capacity(LIST));
        }
        if let Some(list) = self.lists.back_mut() {
            list.push([x, y, z, i, j, k]);
        }
        self.points += 1;
    }
}

impl From<&ClFile> for ClPath {
    fn from(file: &ClFile) -> Self {
        let mut path = Self { name: file.name.clone(), ..Self::default() };
        for record in &file.records {
            path.take(record.line, record.word.clone());
        }
        path
    }
}
