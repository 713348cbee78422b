//! Where a compensated batch writes.

use crate::axis::{Command, MAX_AXES};

/// Where a compensated batch writes: one column per axis, mm and rad.
#[derive(Debug)]
pub struct CommandColumns<'a> {
    columns: [&'a mut [f64]; MAX_AXES],
    axes: usize,
}

impl<'a> CommandColumns<'a> {
    /// Of columns in the order of [`crate::Machine::axes`].
    pub fn new(columns: impl IntoIterator<Item = &'a mut [f64]>) -> Self {
        let mut columns = columns.into_iter();
        let (mut axes, mut first_six) = (0, std::array::from_fn(|_| <&mut [f64]>::default()));
        for slot in &mut first_six {
            let Some(column) = columns.next() else { break };
            (*slot, axes) = (column, axes + 1);
        }
        Self { columns: first_six, axes: axes + columns.count() }
    }

    /// How many poses.
    pub fn len(&self) -> usize {
        self.columns[0].len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// How many axes.
    pub(in crate::batch) fn axes(&self) -> usize {
        self.axes
    }

    pub(in crate::batch) fn lengths(&self) -> impl Iterator<Item = usize> {
        self.columns[..self.axes.min(MAX_AXES)].iter().map(|column| column.len())
    }

    pub(super) fn reborrow(&mut self) -> CommandColumns<'_> {
        CommandColumns { columns: self.columns.each_mut().map(|c| &mut **c), axes: self.axes }
    }

    pub(super) fn split_at(self, middle: usize) -> (Self, Self) {
        let axes = self.axes;
        let mut rest: [&'a mut [f64]; MAX_AXES] = std::array::from_fn(|_| <&mut [f64]>::default());
        let mut columns = self.columns;
        for (column, rest) in columns.iter_mut().zip(&mut rest).take(axes) {
            (*column, *rest) = std::mem::take(column).split_at_mut(middle);
        }
        (Self { columns, axes }, Self { columns: rest, axes })
    }

    /// Without the first so many poses.
    #[must_use]
    pub fn skip(self, poses: usize) -> Self {
        self.split_at(poses).1
    }

    /// The columns of the axes.
    pub(in crate::batch) fn each(&mut self) -> &mut [&'a mut [f64]] {
        &mut self.columns[..self.axes]
    }

    pub(super) fn set(&mut self, i: usize, command: &Command) {
        for (column, q) in self.columns[..self.axes].iter_mut().zip(command) {
            column[i] = *q;
        }
    }
}

/// Owned columns for the commands of a batch.
#[derive(Debug, Clone, PartialEq)]
pub struct CommandTable {
    columns: Vec<Vec<f64>>,
}

impl CommandTable {
    /// Room for so many poses of a machine with so many axes, all zero.
    pub fn zeros(axes: usize, length: usize) -> Self {
        Self { columns: vec![vec![0.0; length]; axes] }
    }

    /// The columns to write to.
    pub fn columns(&mut self) -> CommandColumns<'_> {
        CommandColumns::new(self.columns.iter_mut().map(Vec::as_mut_slice))
    }

    /// The columns to read, one per axis.
    pub fn axes(&self) -> impl Iterator<Item = &[f64]> {
        self.columns.iter().map(Vec::as_slice)
    }

    /// One pose.
    pub fn at(&self, i: usize) -> Command {
        std::array::from_fn(|axis| self.columns.get(axis).map_or(0.0, |column| column[i]))
    }
}
