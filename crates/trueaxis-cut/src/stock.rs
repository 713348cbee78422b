//! Stock as dexels: what remains of a block while a cutter goes through it, along straight lines in three directions.
//!
//! ```text
//! closed mesh ──scan──> Stock: lines along X, Y and Z, each with the stretches that are material
//! Cutter, poses ──> each line loses what is inside of the cutter; the poses know how much they removed
//! ```
//!
//! Nails ([`crate::cut`]) say exactly what a surface is off; dexels say what is still there anywhere, to their resolution.

mod clear;
mod line;
mod scan;
mod surface;

use crate::Cutter;
use crate::motion::ToolPose;
use clear::{Clear, Travel};
use line::{Body, Material, Stretch};
use rayon::prelude::*;
use thiserror::Error;
use trueaxis_geometry::Vec3;

/// More lines than these are a slip of the unit.
const MOST_LINES: f64 = 3e7;
/// A line so far beside a cutter is asked whether it meets it. Unit: mm.
const SLACK_MM: f64 = 1e-6;
/// Poses that are cut together.
const CHUNK: usize = 512;

/// Why a mesh is no stock.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum StockError {
    /// A coordinate that is no number, no triangles, or no extent.
    #[error("the mesh has no volume")]
    Empty,
    /// A resolution that is none.
    #[error("a resolution of {0} mm is none")]
    Resolution(f64),
    /// Too many lines.
    #[error(
        "a resolution of {resolution_mm} mm makes {lines:.0} lines, at most {MOST_LINES:.0} are kept"
    )]
    TooFine {
        /// What was asked for.
        resolution_mm: f64,
        /// What it makes. Unit: 1.
        lines: f64,
    },
    /// A line enters the mesh and does not leave it.
    #[error("the mesh is not closed: the line through {0} enters it and does not leave it")]
    Open(String),
}

/// A body that comes to the stock.
#[derive(Debug, Clone, Copy)]
pub struct Step<'c> {
    /// Its shape: a cutter, or what is above it.
    pub cutter: &'c Cutter,
    /// Where it stands.
    pub pose: ToolPose,
    /// It counts as smaller by this on all sides, mm.
    pub inset_mm: f64,
    /// Whether it takes what is inside of it.
    pub takes: bool,
}

/// What a pose, or many, took.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Taken {
    /// The volume by the lines of each direction, mm³.
    pub volume_mm3: [f64; 3],
    /// The longest stretch that a line lost, mm.
    pub longest_mm: f64,
    /// Of that what belonged to the part, by the lines of each direction, mm³.
    pub gouged_mm3: [f64; 3],
    /// How far the surface that was made lies under that of the part: to the nearest wall of it along X, Y or Z, mm.
    pub gouge_mm: f64,
}

impl Taken {
    /// Mean of the three directions, mm³.
    pub fn mean_mm3(&self) -> f64 {
        self.volume_mm3.iter().sum::<f64>() / 3.0
    }
}

/// What remains of a block.
///
/// ```
/// use trueaxis_cut::{Cutter, ToolPose, stock::Stock};
/// use trueaxis_geometry::Vec3;
/// let cube = Stock::block(&Vec3::zeros(), &Vec3::new(20.0, 20.0, 10.0), 0.5)?;
/// assert!((cube.volume_mm3() - 4000.0).abs() < 1e-6);
/// // A flat cutter of 10 mm plunges 4 mm deep: π · 25 · 4 mm³ are gone.
/// let (mut left, cutter) = (cube.clone(), Cutter::flat(10.0, 30.0).unwrap());
/// let pose = ToolPose { tip_mm: Vec3::new(10.0, 10.0, 6.0), axis: Vec3::z() };
/// let taken = left.cut(&cutter, &[pose])[0];
/// assert!((taken.mean_mm3() - 314.16).abs() < 3.0);
/// assert!((cube.volume_mm3() - left.volume_mm3() - taken.mean_mm3()).abs() < 1e-6);
/// # Ok::<(), trueaxis_cut::stock::StockError>(())
/// ```
#[derive(Debug, Clone)]
pub struct Stock {
    grids: [Grid; 3],
    part: Option<Box<[Grid; 3]>>,
    resolution_mm: f64,
    low_mm: Vec3,
    high_mm: Vec3,
}

/// Parallel lines on a grid, with their material row by row of the first axis across them.
#[derive(Debug, Clone)]
struct Grid {
    lines: Lines,
    material: Vec<Material>,
}

/// Where parallel lines are.
#[derive(Debug, Clone, Copy)]
struct Lines {
    /// Along which axis they go.
    along: usize,
    /// The axes across them.
    across: [usize; 2],
    /// The middle of the first line across them.
    first_mm: [f64; 2],
    step_mm: [f64; 2],
    counts: [usize; 2],
}

impl Stock {
    /// A closed mesh of triangles; inside is what an odd number of walls encloses.
    ///
    /// # Errors
    /// A mesh with holes or without a volume, a resolution that is none.
    pub fn of_mesh(triangles: &[[Vec3; 3]], resolution_mm: f64) -> Result<Self, StockError> {
        let corners = || triangles.iter().flatten();
        if triangles.is_empty() || corners().any(|p| p.iter().any(|c| !c.is_finite())) {
            return Err(StockError::Empty);
        }
        let low_mm = corners().fold(Vec3::repeat(f64::MAX), |a, b| a.inf(b));
        let high_mm = corners().fold(Vec3::repeat(f64::MIN), |a, b| a.sup(b));
        let mut stock = Self::empty(low_mm, high_mm, resolution_mm)?;
        for grid in &mut stock.grids {
            grid.material = scan::scan(&grid.lines, triangles)?;
        }
        Ok(stock)
    }

    /// A block between two corners.
    ///
    /// # Errors
    /// Corners without a volume between them, a resolution that is none.
    pub fn block(low_mm: &Vec3, high_mm: &Vec3, resolution_mm: f64) -> Result<Self, StockError> {
        let mut stock = Self::empty(*low_mm, *high_mm, resolution_mm)?;
        for grid in &mut stock.grids {
            let Lines { along, .. } = grid.lines;
            grid.material = vec![vec![[low_mm[along], high_mm[along]]]; grid.lines.count()];
        }
        Ok(stock)
    }

    fn empty(low_mm: Vec3, high_mm: Vec3, resolution_mm: f64) -> Result<Self, StockError> {
        if !(resolution_mm.is_finite() && resolution_mm > 0.0) {
            return Err(StockError::Resolution(resolution_mm));
        }
        let size = high_mm - low_mm;
        if !size.iter().all(|s| s.is_finite() && *s > 0.0) {
            return Err(StockError::Empty);
        }
        let lines = (0..3)
            .map(|k| {
                (size[(k + 1) % 3] / resolution_mm).ceil()
                    * (size[(k + 2) % 3] / resolution_mm).ceil()
            })
            .sum::<f64>();
        if lines > MOST_LINES {
            return Err(StockError::TooFine { resolution_mm, lines });
        }
        let grids = [0, 1, 2].map(|along| {
            let lines = Lines::new(along, low_mm, size, resolution_mm);
            Grid { lines, material: Vec::new() }
        });
        Ok(Self { grids, part: None, resolution_mm, low_mm, high_mm })
    }

    /// With the part that shall remain: what is cut off it is a gouge.
    ///
    /// # Errors
    /// A mesh with holes.
    pub fn with_part(mut self, triangles: &[[Vec3; 3]]) -> Result<Self, StockError> {
        let mut grids = self.grids.clone();
        for grid in &mut grids {
            grid.material = scan::scan(&grid.lines, triangles)?;
        }
        self.part = Some(Box::new(grids));
        Ok(self)
    }

    /// What was asked for, mm.
    pub fn resolution_mm(&self) -> f64 {
        self.resolution_mm
    }

    /// The box that it was made from, mm.
    pub fn corners_mm(&self) -> [Vec3; 2] {
        [self.low_mm, self.high_mm]
    }

    /// How much remains, by the lines of each direction, mm³.
    pub fn volumes_mm3(&self) -> [f64; 3] {
        std::array::from_fn(|k| self.grids[k].volume_mm3())
    }

    /// How much remains, mm³.
    pub fn volume_mm3(&self) -> f64 {
        self.volumes_mm3().iter().sum::<f64>() / 3.0
    }

    /// The lines along an axis (0: X), each by the place where its coordinate along that axis is 0, and its material from low to high.
    pub fn lines(&self, along: usize) -> impl Iterator<Item = (Vec3, &[[f64; 2]])> {
        let Grid { lines, material } = &self.grids[along];
        material.iter().enumerate().map(move |(i, material)| (lines.place(i), material.as_slice()))
    }

    /// How much remains that is not of the part; none without a part. Unit: mm³.
    pub fn excess_mm3(&self) -> Option<f64> {
        let part = self.part.as_ref()?;
        let of = |(grid, part): (&Grid, &Grid)| {
            let lines = grid.material.iter().zip(&part.material);
            let excess = lines.flat_map(|(material, part)| {
                material.iter().map(|s| s[1] - s[0] - line::overlap(part, *s))
            });
            excess.sum::<f64>() * grid.lines.area_mm2()
        };
        Some(self.grids.iter().zip(part.iter()).map(of).sum::<f64>() / 3.0)
    }

    /// Removes what is inside of a cutter at each of these poses, one after the other; what each of them took.
    pub fn cut(&mut self, cutter: &Cutter, poses: &[ToolPose]) -> Vec<Taken> {
        let steps =
            poses.iter().map(|pose| Step { cutter, pose: *pose, inset_mm: 0.0, takes: true });
        self.work(&steps.collect::<Vec<_>>())
    }

    /// Bodies at poses, one after the other; what was inside of each of them when it came.
    pub fn work(&mut self, steps: &[Step<'_>]) -> Vec<Taken> {
        let bounds = [self.low_mm, self.high_mm];
        let mut all = Vec::with_capacity(steps.len());
        for steps in steps.chunks(CHUNK) {
            let (travels, cutters) = clear::travels(steps, &bounds);
            let come = |(i, step)| {
                Some(Coming { of: i, body: Body::of(step, &bounds)?, travel: travels[i] })
            };
            let bodies: Vec<Coming<'_>> = steps.iter().enumerate().filter_map(come).collect();
            let mut taken = vec![Taken::default(); steps.len()];
            for (k, grid) in self.grids.iter_mut().enumerate().filter(|_| !bodies.is_empty()) {
                let part = self.part.as_deref();
                let lines = grid.lines;
                let [in_row, _] = lines.counts;
                let row = |(j, row): (usize, &mut [Material])| {
                    let mut sums = Vec::new();
                    if row.iter().all(Vec::is_empty) {
                        return sums;
                    }
                    let mut clear = Clear::new(in_row, cutters);
                    lines.pass(&bodies, j, &mut sums, |i, Coming { body, travel, .. }, at| {
                        if clear.is(i, travel) {
                            return Stretch::default();
                        }
                        let part = part.map(|p| (&*p[k].material[j * in_row + i], p));
                        let (taken, distance_mm) = line::take(&mut row[i], part, body, (at, k));
                        clear.note(i, travel, distance_mm);
                        taken
                    });
                    sums
                };
                let rows = grid.material.par_chunks_mut(in_row).enumerate().map(row);
                collect(rows.collect(), (k, lines.area_mm2()), &mut taken);
            }
            all.extend(taken);
        }
        all
    }
}

/// A body that may meet the stock, the step that it is of, and how far its cutter came.
struct Coming<'c> {
    of: usize,
    body: Body<'c>,
    travel: Travel,
}

/// Sums of the rows in their order, so that they do not depend on the number of threads.
fn collect(rows: Vec<Vec<(usize, Stretch)>>, (k, area_mm2): (usize, f64), taken: &mut [Taken]) {
    for (pose, one) in rows.into_iter().flatten() {
        let sum = &mut taken[pose];
        sum.volume_mm3[k] += one.length_mm * area_mm2;
        sum.gouged_mm3[k] += one.gouged_mm * area_mm2;
        sum.longest_mm = sum.longest_mm.max(one.longest_mm);
        sum.gouge_mm = sum.gouge_mm.max(one.gouge_mm);
    }
}

impl Lines {
    /// Each line of a row that a body may meet, body after body.
    fn pass(
        &self,
        bodies: &[Coming<'_>],
        j: usize,
        sums: &mut Vec<(usize, Stretch)>,
        mut take: impl FnMut(usize, &Coming<'_>, &Vec3) -> Stretch,
    ) {
        let v = self.first_mm[1] + j as f64 * self.step_mm[1];
        let [a, b] = self.across;
        for coming in bodies {
            let body = &coming.body;
            if v < body.low_mm[b] || v > body.high_mm[b] {
                continue;
            }
            let Some([low, high]) = body.reach_at(self.across, v) else { continue };
            let cell = |at: f64| (at - self.first_mm[0]) / self.step_mm[0];
            let from = cell(low - SLACK_MM).ceil().max(0.0) as usize;
            let to = cell(high + SLACK_MM).floor();
            let to = if to < 0.0 { 0 } else { (to as usize + 1).min(self.counts[0]) };
            let mut sum = Stretch::default();
            for i in from..to {
                let mut at = Vec3::zeros();
                at[a] = self.first_mm[0] + i as f64 * self.step_mm[0];
                at[b] = v;
                sum.add(&take(i, coming, &at));
            }
            if sum.length_mm > 0.0 {
                sums.push((coming.of, sum));
            }
        }
    }
}

impl Lines {
    /// Cells that fill the box: as many as the resolution asks for.
    fn new(along: usize, low_mm: Vec3, size_mm: Vec3, resolution_mm: f64) -> Self {
        let across = [(along + 1) % 3, (along + 2) % 3];
        let counts = across.map(|a| (size_mm[a] / resolution_mm - 1e-9).ceil().max(1.0) as usize);
        let step_mm = [0, 1].map(|k: usize| size_mm[across[k]] / counts[k] as f64);
        let first_mm = [0, 1].map(|k: usize| low_mm[across[k]] + 0.5 * step_mm[k]);
        Self { along, across, first_mm, step_mm, counts }
    }

    fn count(&self) -> usize {
        self.counts[0] * self.counts[1]
    }

    /// The place of a line, in the order of the material; its coordinate along the line is 0.
    fn place(&self, i: usize) -> Vec3 {
        let mut at = Vec3::zeros();
        for (k, n) in [i % self.counts[0], i / self.counts[0]].into_iter().enumerate() {
            at[self.across[k]] = self.first_mm[k] + n as f64 * self.step_mm[k];
        }
        at
    }

    fn area_mm2(&self) -> f64 {
        self.step_mm[0] * self.step_mm[1]
    }
}

impl Grid {
    /// How far a place is from both ends of the material around it, along the nearest line; 0 outside of it.
    fn depth_mm(&self, at: &Vec3) -> f64 {
        let Lines { along, across, first_mm, step_mm, counts } = self.lines;
        let cell = [0, 1].map(|k: usize| {
            let place = ((at[across[k]] - first_mm[k]) / step_mm[k]).round();
            place.clamp(0.0, (counts[k] - 1) as f64) as usize
        });
        let place = at[along];
        let depth = |s: &[f64; 2]| (place - s[0]).min(s[1] - place);
        let line = &self.material[cell[1] * counts[0] + cell[0]];
        line.iter().map(depth).fold(0.0, f64::max)
    }

    fn volume_mm3(&self) -> f64 {
        self.lines.area_mm2() * self.material.iter().flatten().map(|s| s[1] - s[0]).sum::<f64>()
    }
}
