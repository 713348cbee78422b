//! Lowest and highest values of 4, 16, 64 … consecutive nodes, so that the extent of any number of
//! nodes is found by looking at a few.

use std::ops::Range;

/// Nodes of a bucket, and buckets of the bucket above.
pub(super) const BUCKET: usize = 4;

const NONE: [f32; 2] = [f32::INFINITY, f32::NEG_INFINITY];

fn see([low, high]: &mut [f32; 2], other: [f32; 2]) {
    (*low, *high) = (low.min(other[0]), high.max(other[1]));
}

/// Extents of some quantities; those of a bucket are adjacent.
#[derive(Debug, Default)]
pub(super) struct Pyramid {
    quantities: usize,
    levels: Vec<Vec<[f32; 2]>>,
}

impl Pyramid {
    pub fn of(quantities: usize) -> Self {
        Self { quantities, levels: vec![Vec::new()] }
    }

    /// The values at a node of a bucket.
    pub fn see(&mut self, bucket: usize, values: impl Iterator<Item = f32>) {
        let (finest, from) = (&mut self.levels[0], bucket * self.quantities);
        if finest.len() < from + self.quantities {
            finest.resize(from + self.quantities, NONE);
        }
        finest[from..].iter_mut().zip(values).for_each(|(extent, v)| see(extent, [v, v]));
    }

    /// Every two buckets become one.
    pub fn halve(&mut self) {
        self.levels[0] = self.joined(&self.levels[0], 2);
    }

    fn joined(&self, level: &[[f32; 2]], count: usize) -> Vec<[f32; 2]> {
        let mut all = Vec::with_capacity(level.len() / count + self.quantities);
        for group in level.chunks(count * self.quantities) {
            let from = all.len();
            all.extend_from_slice(&group[..self.quantities]);
            for bucket in group.chunks(self.quantities).skip(1) {
                all[from..].iter_mut().zip(bucket).for_each(|(extent, other)| see(extent, *other));
            }
        }
        all
    }

    /// Builds the levels above the finest buckets.
    pub fn finish(&mut self) {
        self.levels[0].shrink_to_fit();
        while let Some(top) = self.levels.last().filter(|t| t.len() > BUCKET * self.quantities) {
            let above = self.joined(top, BUCKET);
            self.levels.push(above);
        }
    }

    /// The extent of a quantity over some nodes; `value` gives it at one node. Without nodes the
    /// lowest is above the highest.
    pub fn extent(
        &self,
        quantity: usize,
        nodes: Range<usize>,
        value: impl Fn(usize) -> f32,
    ) -> [f32; 2] {
        let (mut from, mut to) = (nodes.start, nodes.end);
        let mut extent = NONE;
        for level in 0..=self.levels.len() {
            let mut take = |i: usize| {
                let there = match level.checked_sub(1) {
                    None => [value(i); 2],
                    Some(level) => self.levels[level][i * self.quantities + quantity],
                };
                see(&mut extent, there);
            };
            let is_top = level == self.levels.len();
            while from < to && (is_top || from % BUCKET != 0) {
                take(from);
                from += 1;
            }
            while from < to && to % BUCKET != 0 {
                to -= 1;
                take(to);
            }
            (from, to) = (from / BUCKET, to / BUCKET);
        }
        extent
    }
}
