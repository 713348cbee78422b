//! Curves over any stretch of time: the lowest and the highest value in each column of a picture.

use super::super::series::Quantity;
use super::Recording;
use super::pyramid::BUCKET;
use std::ops::Range;

/// The quantity of a curve, with its name and its limits.
#[derive(Debug, Clone, PartialEq)]
pub struct QuantityRange {
    /// Its kind.
    pub quantity: Quantity,
    /// Its short name: `X`, `X.speed`, `path.speed`, `tip`, `feed`, `normal`, `binormal`, `axis`.
    pub key: String,
    /// Its name in text output.
    pub title: String,
    /// Its unit.
    pub unit: String,
    /// The ends of the travel, or the highest velocity in both directions, where stated. Unit: that of `unit`.
    pub limits: Option<[f64; 2]>,
}

/// Extents of quantities over columns of equal time.
#[derive(Debug, Clone, PartialEq)]
pub struct Curves {
    /// Where the first column begins, s.
    pub from_s: f64,
    /// Where the last one ends, s.
    pub to_s: f64,
    /// Columns.
    pub columns: usize,
    /// The lowest values: all columns of the first quantity, then those of the next; not a number
    /// where nothing is.
    pub low: Vec<f32>,
    /// The highest values.
    pub high: Vec<f32>,
}

impl Recording {
    /// All quantities that have a curve.
    pub fn quantities(&self) -> Vec<QuantityRange> {
        let axes = self.axes();
        let range = |quantity: Quantity| {
            let (key, title, unit, limits) = match quantity {
                Quantity::Position(i) => {
                    let axis = &axes[i];
                    let title = format!("Position of {}", axis.name);
                    (axis.name.clone(), title, axis.unit.to_owned(), axis.travel)
                }
                Quantity::AxisSpeed(i) => {
                    let axis = &axes[i];
                    let title = format!("Speed of {}", axis.name);
                    let limits = axis.velocity.map(|v| [-v, v]);
                    (format!("{}.speed", axis.name), title, format!("{}/s", axis.unit), limits)
                }
                other => {
                    let (key, title, unit) = plain_names(other);
                    (key.to_owned(), title.to_owned(), unit.to_owned(), None)
                }
            };
            QuantityRange { quantity, key, title, unit, limits }
        };
        self.columns.quantities().map(range).collect()
    }

    /// The lowest and the highest value of quantities in each of some columns of equal time between
    /// two times. Positions, speed of the path and deviations go straight between two nodes, an axis
    /// keeps its mean speed.
    pub fn curves(&self, from_s: f64, to_s: f64, columns: usize, of: &[Quantity]) -> Curves {
        let (mut low, mut high) = (Vec::new(), Vec::new());
        let width_s = (to_s - from_s) / columns as f64;
        for quantity in of {
            for column in 0..columns {
                let begin_s = from_s + width_s * column as f64;
                let [l, h] = self.extent(*quantity, begin_s, begin_s + width_s);
                // Where nothing is, the lowest is above the highest.
                low.push(if l <= h { l } else { f32::NAN });
                high.push(if l <= h { h } else { f32::NAN });
            }
        }
        Curves { from_s, to_s, columns, low, high }
    }

    /// The extent of a quantity between two times.
    fn extent(&self, of: Quantity, from_s: f64, to_s: f64) -> [f32; 2] {
        let times = &self.columns.time_s;
        let none = [f32::INFINITY, f32::NEG_INFINITY];
        let (Some(first_s), last_s) = (times.first(), self.end_s()) else { return none };
        if !(from_s <= last_s && to_s >= *first_s) {
            return none;
        }
        let (from_s, to_s) = (from_s.max(*first_s), to_s.min(last_s));
        let value = |i: usize| self.columns.value(of, i);
        let column = self.columns.column(of);
        let begin = times.partition_point(|t| *t < from_s);
        if let Quantity::AxisSpeed(_) = of {
            // The move to a node has its speed.
            let begin = times.partition_point(|t| *t <= from_s).min(times.len() - 1);
            let end = times.partition_point(|t| *t < to_s).max(begin);
            return self.pyramid.extent(column, self.whole(begin..end + 1), value);
        }
        let end = times.partition_point(|t| *t <= to_s).max(begin);
        let [low, high] = self.pyramid.extent(column, self.whole(begin..end), value);
        let edges = [from_s, to_s].map(|t| self.straight(of, t));
        [low.min(edges[0]).min(edges[1]), high.max(edges[0]).max(edges[1])]
    }

    /// Where nodes were left out, whole buckets, which contain them, too: a stretch of time then has the
    /// extremes of a little more than itself, and none is lost.
    fn whole(&self, nodes: Range<usize>) -> Range<usize> {
        if !self.is_thinned() {
            return nodes;
        }
        let (from, to) = (nodes.start.saturating_sub(1), (nodes.end + 1).min(self.kept()));
        from / BUCKET * BUCKET..to.next_multiple_of(BUCKET)
    }

    /// A quantity on the straight line between two nodes.
    fn straight(&self, of: Quantity, time_s: f64) -> f32 {
        let times = &self.columns.time_s;
        let i = times.partition_point(|t| *t < time_s).min(times.len() - 1);
        let (before, part) = self.part(i, time_s);
        let [a, b] = [before, i].map(|k| f64::from(self.columns.value(of, k)));
        (a + (b - a) * part.min(1.0)) as f32
    }
}

/// Key, title and unit of a quantity that is not of one axis.
fn plain_names(of: Quantity) -> (&'static str, &'static str, &'static str) {
    match of {
        Quantity::Tip => ("tip", "Deviation of the tip", "µm"),
        Quantity::Feed => ("feed", "Deviation of the tip along the feed", "µm"),
        Quantity::Normal => ("normal", "Deviation of the tip along the normal", "µm"),
        Quantity::Binormal => ("binormal", "Deviation of the tip along the binormal", "µm"),
        Quantity::ToolAxis => ("axis", "Deviation of the tool axis", "µrad"),
        Quantity::Position(_) | Quantity::AxisSpeed(_) | Quantity::PathSpeed => {
            ("path.speed", "Speed along the path", "mm/min")
        }
    }
}
