//! Where a batch reads its commands and writes its deviations.

use super::{BatchError, Inputs};
use crate::Deviation;
use crate::axis::MAX_AXES;
use trueaxis_geometry::Vec3;
use trueaxis_geometry::frame::{Direction, Point};

/// The commands of a batch: one column per axis, in the order of [`crate::Machine::axes`], mm and
/// rad.
#[derive(Debug, Clone, Copy)]
pub struct Commands<'a> {
    positions: [&'a [f64]; MAX_AXES],
    columns: usize,
    approaches: [&'a [f64]; MAX_AXES],
    approach_columns: usize,
}

impl<'a> Commands<'a> {
    /// Positions without a known direction of approach.
    pub fn new(positions: &[&'a [f64]]) -> Self {
        Self {
            positions: first_six(positions),
            columns: positions.len(),
            approaches: [&[]; MAX_AXES],
            approach_columns: 0,
        }
    }

    /// From which side each position is reached: +1 rising, −1 falling, 0 not known; one column
    /// per axis, empty where it is not known for the whole batch.
    pub fn approached(self, approaches: &[&'a [f64]]) -> Self {
        Self { approaches: first_six(approaches), approach_columns: approaches.len(), ..self }
    }

    /// How many poses.
    pub fn len(&self) -> usize {
        self.positions[0].len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    pub(super) fn inputs(&self) -> Inputs<'a> {
        Inputs { positions: self.positions, approaches: self.approaches }
    }

    /// Whether the columns fit a machine and the lengths of an output.
    pub(super) fn fit(
        &self,
        axes: usize,
        out: impl Iterator<Item = usize>,
    ) -> Result<(), BatchError> {
        if self.columns != axes {
            return Err(BatchError::Columns { expected: axes, found: self.columns });
        }
        if self.approach_columns != 0 && self.approach_columns != axes {
            return Err(BatchError::Columns { expected: axes, found: self.approach_columns });
        }
        let expected = self.len();
        let known = self.approaches.iter().map(|a| a.len()).filter(|&length| length != 0);
        let lengths = self.positions[..axes].iter().map(|p| p.len());
        match lengths.chain(known).chain(out).find(|&length| length != expected) {
            Some(found) => Err(BatchError::Lengths { expected, found }),
            None => Ok(()),
        }
    }
}

fn first_six<'a>(columns: &[&'a [f64]]) -> [&'a [f64]; MAX_AXES] {
    std::array::from_fn(|i| columns.get(i).copied().unwrap_or(&[]))
}

/// Where a batch writes: twelve columns, x y z each.
#[derive(Debug)]
pub struct DeviationColumns<'a> {
    /// Nominal tip in the workpiece frame, mm.
    pub nominal_tip_mm: [&'a mut [f64]; 3],
    /// Nominal tool axis in the workpiece frame, from the tip to the spindle. Unit: 1.
    pub nominal_axis: [&'a mut [f64]; 3],
    /// Actual minus nominal tip, mm.
    pub tip_mm: [&'a mut [f64]; 3],
    /// Actual minus nominal unit vector of the tool axis. Unit: 1.
    pub axis: [&'a mut [f64]; 3],
}

impl DeviationColumns<'_> {
    /// How many poses.
    pub fn len(&self) -> usize {
        self.nominal_tip_mm[0].len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    pub(super) fn lengths(&self) -> impl Iterator<Item = usize> {
        let triples = [&self.nominal_tip_mm, &self.nominal_axis, &self.tip_mm, &self.axis];
        triples.into_iter().flatten().map(|column| column.len())
    }

    pub(super) fn reborrow(&mut self) -> DeviationColumns<'_> {
        DeviationColumns {
            nominal_tip_mm: self.nominal_tip_mm.each_mut().map(|c| &mut **c),
            nominal_axis: self.nominal_axis.each_mut().map(|c| &mut **c),
            tip_mm: self.tip_mm.each_mut().map(|c| &mut **c),
            axis: self.axis.each_mut().map(|c| &mut **c),
        }
    }

    pub(super) fn split_at(self, middle: usize) -> (Self, Self) {
        let (tip, tip2) = halves(self.nominal_tip_mm, middle);
        let (axis, axis2) = halves(self.nominal_axis, middle);
        let (tip_mm, tip_mm2) = halves(self.tip_mm, middle);
        let (turn, turn2) = halves(self.axis, middle);
        (
            Self { nominal_tip_mm: tip, nominal_axis: axis, tip_mm, axis: turn },
            Self { nominal_tip_mm: tip2, nominal_axis: axis2, tip_mm: tip_mm2, axis: turn2 },
        )
    }

    /// Without the first so many poses.
    #[must_use]
    pub fn skip(self, poses: usize) -> Self {
        self.split_at(poses).1
    }

    /// Writes one pose; false if a number of it is not finite.
    pub fn set(&mut self, i: usize, deviation: &Deviation) -> bool {
        let put = |columns: &mut [&mut [f64]; 3], vector: Vec3| {
            for (column, value) in columns.iter_mut().zip(vector.iter()) {
                column[i] = *value;
            }
            vector.iter().all(|v| v.is_finite())
        };
        put(&mut self.nominal_tip_mm, deviation.nominal_tip.vector())
            & put(&mut self.nominal_axis, deviation.nominal_axis.vector())
            & put(&mut self.tip_mm, deviation.tip_mm)
            & put(&mut self.axis, deviation.axis)
    }
}

type Triple<'a> = [&'a mut [f64]; 3];

fn halves(columns: Triple<'_>, middle: usize) -> (Triple<'_>, Triple<'_>) {
    let [(x, x2), (y, y2), (z, z2)] = columns.map(|c| c.split_at_mut(middle));
    ([x, y, z], [x2, y2, z2])
}

/// Owned columns for the results of a batch.
#[derive(Debug, Clone, PartialEq)]
pub struct DeviationTable {
    /// Nominal tip, nominal axis, deviation of the tip, of the axis; x y z each.
    columns: [[Vec<f64>; 3]; 4],
}

impl DeviationTable {
    /// Room for so many poses, all zero.
    pub fn zeros(length: usize) -> Self {
        let column = || vec![0.0; length];
        Self { columns: std::array::from_fn(|_| std::array::from_fn(|_| column())) }
    }

    /// The columns to write to.
    pub fn columns(&mut self) -> DeviationColumns<'_> {
        let [nominal_tip_mm, nominal_axis, tip_mm, axis] = &mut self.columns;
        DeviationColumns {
            nominal_tip_mm: nominal_tip_mm.each_mut().map(Vec::as_mut_slice),
            nominal_axis: nominal_axis.each_mut().map(Vec::as_mut_slice),
            tip_mm: tip_mm.each_mut().map(Vec::as_mut_slice),
            axis: axis.each_mut().map(Vec::as_mut_slice),
        }
    }

    /// How many poses.
    pub fn len(&self) -> usize {
        self.columns[0][0].len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// One pose.
    pub fn at(&self, i: usize) -> Deviation {
        let [nominal_tip, nominal_axis, tip_mm, axis] = self.vectors_at(i);
        Deviation {
            nominal_tip: Point::from_vector(nominal_tip),
            nominal_axis: Direction::of(nominal_axis).unwrap_or(Direction::Z),
            tip_mm,
            axis,
        }
    }

    /// The numbers of a pose as they stand in the columns: nominal tip (mm) and tool axis (unit vector to rounding), deviation of
    /// the tip (mm) and of the tool axis.
    pub fn vectors_at(&self, i: usize) -> [Vec3; 4] {
        self.columns.each_ref().map(|[x, y, z]| Vec3::new(x[i], y[i], z[i]))
    }
}
