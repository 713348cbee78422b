//! Numbers of all elements: small, and the same for the same part.

use crate::part::{Characteristic, Datum, Geometry, Part};

const STANDARD: usize = 1;
const SOFTWARE: usize = 2;
const PART: usize = 3;
const RESULTS: usize = 4;

/// One of the three elements that a feature has, or of the first three that a characteristic has.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Of {
    Definition,
    Nominal,
    Item,
    /// Of characteristics only.
    Measurement,
}

/// The numbers of a part, by its features, datums, frames and characteristics in their order.
pub(super) struct Ids<'p> {
    features: usize,
    /// Features that are datums, in the order of the part, each with its label.
    pub datums: Vec<(usize, String)>,
    /// Datum systems, each once, in the order of the characteristics.
    pub frames: Vec<&'p [Datum]>,
    characteristics: usize,
    /// How many points of tables stand before those of a feature, and at the end of all.
    points: Vec<usize>,
}

impl<'p> Ids<'p> {
    pub fn of(part: &'p Part) -> Self {
        let mut frames: Vec<&[Datum]> = Vec::new();
        for asked in &part.characteristics {
            let datums = &asked.datums[..];
            if !datums.is_empty() && !frames.contains(&datums) {
                frames.push(datums);
            }
        }
        let mut points = vec![0];
        for feature in &part.features {
            let own = match feature.geometry {
                Geometry::Points => feature.points.len(),
                _ => 0,
            };
            points.push(points.last().copied().unwrap_or(0) + own);
        }
        Self {
            features: part.features.len(),
            datums: labels(part, &frames),
            frames,
            characteristics: part.characteristics.len(),
            points,
        }
    }

    pub fn standard(&self) -> usize {
        STANDARD
    }

    pub fn software(&self) -> usize {
        SOFTWARE
    }

    pub fn part(&self) -> usize {
        PART
    }

    pub fn results(&self) -> usize {
        RESULTS
    }

    pub fn feature(&self, index: usize, of: Of) -> usize {
        RESULTS + 1 + 3 * index + of as usize
    }

    /// Of a feature that is one.
    pub fn datum(&self, feature: usize) -> usize {
        let rank = self.datums.iter().position(|(index, _)| *index == feature);
        self.feature(self.features, Of::Definition) + rank.unwrap_or(0)
    }

    pub fn frame(&self, rank: usize) -> usize {
        self.feature(self.features, Of::Definition) + self.datums.len() + rank
    }

    /// Of a characteristic that names datums.
    pub fn frame_of(&self, asked: &Characteristic) -> Option<usize> {
        let rank = self.frames.iter().position(|frame| *frame == asked.datums)?;
        Some(self.frame(rank))
    }

    pub fn characteristic(&self, index: usize, of: Of) -> usize {
        self.frame(self.frames.len()) + 4 * index + of as usize
    }

    /// Of a point of a table; they come last, as there may be many.
    pub fn point(&self, feature: usize, row: usize) -> usize {
        self.characteristic(self.characteristics, Of::Definition) + self.points[feature] + row
    }

    /// The largest of all.
    pub fn last(&self) -> usize {
        self.point(self.features, 0) - 1
    }
}

/// The features that have a letter or are named as datums, with labels that are tokens of XML and differ.
fn labels(part: &Part, frames: &[&[Datum]]) -> Vec<(usize, String)> {
    let is_datum = |index: usize| {
        part.features[index].letter.is_some()
            || frames.iter().copied().flatten().any(|d| d.features.contains(&index))
    };
    let mut found: Vec<(usize, String)> = Vec::new();
    for index in (0..part.features.len()).filter(|i| is_datum(*i)) {
        let is_sign = |c: char| c.is_ascii_alphanumeric() || "_-.".contains(c);
        let token: String = part.features[index]
            .label()
            .trim()
            .chars()
            .map(|c| if is_sign(c) { c } else { '_' })
            .collect();
        let token = if token.is_empty() { "_".to_owned() } else { token };
        let mut label = token.clone();
        let mut number = 1;
        while found.iter().any(|(_, other)| *other == label) {
            number += 1;
            label = format!("{token}_{number}");
        }
        found.push((index, label));
    }
    found
}
