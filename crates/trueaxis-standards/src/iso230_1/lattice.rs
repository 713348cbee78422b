//! Heights of a surface from the angles of lines over it, with the closure errors shared out by least squares.
//!
//! ```text
//!     β = (h_to − h_from)/b + t_line + ε        unknown: the heights, and the tilt of each line        docs/model.md eq. 275
//! ```
//!
//! The zero of an autocollimator is another in each line. A level counts from gravity: one zero for all.

use super::profile::words;
use nalgebra::{Cholesky, DMatrix, DVector, Dyn};
use trueaxis_input::sheet::Sheet;
use trueaxis_input::{Diagnostics, Dimension, Place};

/// More nodes are not solved.
const MOST_NODES: usize = 1000;
/// Nodes closer than this are one, mm.
const SAME_MM: f64 = 0.01;

/// The part of the closure errors that went to a line.
#[derive(Debug, Clone, PartialEq)]
pub struct Closure {
    /// The line.
    pub line: String,
    /// How far its own profile, added up from its readings, is from the heights, at most, mm.
    pub largest_mm: f64,
}

/// The heights of a surface.
pub struct Lattice {
    /// Where, mm.
    pub at_mm: Vec<[f64; 2]>,
    /// Heights, mm.
    pub heights_mm: Vec<f64>,
    /// Of each line.
    pub closures: Vec<Closure>,
    /// The nodes of each line, in its order.
    pub lines: Vec<(String, Vec<usize>)>,
    /// Standard deviation of a reading from the closure, and its degrees of freedom. Unit: rad.
    pub scatter: Option<(f64, f64)>,
    normal: Cholesky<f64, Dyn>,
}

impl Lattice {
    /// w N⁻¹ wᵀ: the variance of a sum over the heights by readings of variance 1, mm².
    pub fn variance(&self, weights: &[f64]) -> f64 {
        let size = self.normal.l().nrows();
        let w = DVector::from_fn(size, |i, _| weights.get(i).copied().unwrap_or(0.0));
        w.dot(&self.normal.solve(&w))
    }
}

/// The end of a line with the smallest x, or y.
pub fn end_of(at_mm: &[[f64; 2]], nodes: &[usize]) -> [f64; 2] {
    let all = nodes.iter().map(|i| at_mm[*i]);
    let first = |a: &[f64; 2], b: &[f64; 2]| match (a[0] - b[0]).abs() < SAME_MM {
        true => a[1].total_cmp(&b[1]),
        false => a[0].total_cmp(&b[0]),
    };
    all.min_by(first).unwrap_or_default()
}

struct Row {
    from: usize,
    to: usize,
    base_mm: f64,
    tilt: usize,
    angle_rad: f64,
}

/// Reads `line`, `from_x`, `from_y`, `to_x`, `to_y`, `angle` and solves; `None` with errors in `problems`.
pub fn read(
    sheet: &Sheet,
    base_mm: Option<f64>,
    gravity: bool,
    problems: &mut Diagnostics,
) -> Option<Lattice> {
    let mut column = |role: &str, dimension| {
        let Some(column) = sheet.about(role) else {
            let message = format!("the table has no column `{role}`");
            let hint = "x_mm, y_mm, z_um of points; or line, from_x_mm, from_y_mm, to_x_mm, to_y_mm, angle_urad";
            problems.error("missing-column", sheet.headings_place(), message, hint);
            return None;
        };
        sheet.inner(column, dimension, problems)
    };
    let [from_x, from_y, to_x, to_y] =
        ["from_x", "from_y", "to_x", "to_y"].map(|role| column(role, Dimension::Length));
    let angles = column("angle", Dimension::Angle)?;
    let (from_x, from_y, to_x, to_y) = (from_x?, from_y?, to_x?, to_y?);
    let names = words(sheet, "line");
    if !gravity && names.iter().all(String::is_empty) {
        let message = "the table does not say which line a step belongs to".to_owned();
        let hint = "a column `line`: each line of an autocollimator has its own zero; of a level that counts from \
                    gravity state [test] angles_from = \"gravity\"";
        problems.error("missing-column", sheet.headings_place(), message, hint);
        return None;
    }
    let mut at_mm: Vec<[f64; 2]> = Vec::new();
    let mut node = |p: [f64; 2]| {
        let same = |q: &[f64; 2]| (q[0] - p[0]).hypot(q[1] - p[1]) < SAME_MM;
        at_mm.iter().position(same).unwrap_or_else(|| {
            at_mm.push(p);
            at_mm.len() - 1
        })
    };
    let mut lines: Vec<(String, Vec<usize>)> = Vec::new();
    let mut rows = Vec::new();
    for i in 0..sheet.rows() {
        let (from, to) = (node([from_x[i], from_y[i]]), node([to_x[i], to_y[i]]));
        let line = lines.iter().position(|(n, _)| *n == names[i]).unwrap_or_else(|| {
            lines.push((names[i].clone(), Vec::new()));
            lines.len() - 1
        });
        for foot in [from, to] {
            if !lines[line].1.contains(&foot) {
                lines[line].1.push(foot);
            }
        }
        if from == to {
            let message = "this step begins where it ends".to_owned();
            problems.error("base-gap", sheet.row_place(i), message, "from and to are the two feet");
            return None;
        }
        let distance = (to_x[i] - from_x[i]).hypot(to_y[i] - from_y[i]);
        let tilt = if gravity { 0 } else { line };
        let base_mm = base_mm.unwrap_or(distance);
        rows.push(Row { from, to, base_mm, tilt, angle_rad: angles[i] });
    }
    if at_mm.len() > MOST_NODES {
        let message = format!("{} points are too many", at_mm.len());
        let hint = format!("at most {MOST_NODES}");
        problems.error("too-many-readings", Place::whole(&sheet.file), message, &hint);
        return None;
    }
    let network = Network { at_mm, lines, rows, names };
    let solved = match gravity {
        false => {
            network.solve(&[Gauge::Height, Gauge::Slope(0), Gauge::Slope(1)], network.lines.len())
        }
        // Where all lines run one way, the zero of the level cannot be separated from a tilt of the surface.
        true => network
            .solve(&[Gauge::Height], 1)
            .or_else(|| network.solve(&[Gauge::Height, Gauge::Zero], 1)),
    };
    if solved.is_none() {
        let message = "the lines do not determine one surface".to_owned();
        let hint = "every line crosses others at two points at least, and a grid needs diagonals (a twist would not \
                    show), as the Union Jack has: two diagonals, four sides, two centre lines; of a level state \
                    [test] angles_from = \"gravity\"";
        problems.error("lines-not-connected", Place::whole(&sheet.file), message, hint);
    }
    solved
}

struct Network {
    at_mm: Vec<[f64; 2]>,
    lines: Vec<(String, Vec<usize>)>,
    rows: Vec<Row>,
    names: Vec<String>,
}

/// What no reading changes with, and is therefore set.
#[derive(Clone, Copy, PartialEq)]
enum Gauge {
    /// The mean height is 0.
    Height,
    /// So is the slope of the whole, if each line has its own zero.
    Slope(usize),
    /// So is the zero of the level.
    Zero,
}

impl Network {
    fn solve(&self, gauges: &[Gauge], tilts: usize) -> Option<Lattice> {
        let Self { at_mm, lines, rows, names } = self;
        let nodes = at_mm.len();
        let mut normal = DMatrix::<f64>::zeros(nodes + tilts, nodes + tilts);
        let mut right = DVector::<f64>::zeros(nodes + tilts);
        for row in rows {
            let entries = [
                (row.from, -1.0 / row.base_mm),
                (row.to, 1.0 / row.base_mm),
                (nodes + row.tilt, 1.0),
            ];
            for (i, a) in entries {
                for (k, b) in entries {
                    normal[(i, k)] += a * b;
                }
                right[i] += a * row.angle_rad;
            }
        }
        let centre = [0, 1].map(|k| at_mm.iter().map(|p| p[k]).sum::<f64>() / nodes as f64);
        let away = |i: usize, k: usize| at_mm[i][k] - centre[k];
        let size = (0..nodes).fold(1e-9_f64, |m, i| m.max(away(i, 0).abs()).max(away(i, 1).abs()));
        let weight = normal.diagonal().rows(0, nodes).mean();
        for gauge in gauges {
            let value = |i: usize| match gauge {
                Gauge::Height => 1.0,
                Gauge::Slope(k) => away(i, *k) / size,
                Gauge::Zero => 0.0,
            };
            for i in 0..nodes {
                for k in 0..nodes {
                    normal[(i, k)] += weight * value(i) * value(k) / nodes as f64;
                }
            }
            if *gauge == Gauge::Zero {
                normal[(nodes, nodes)] += 1.0;
            }
        }
        // Scaled to a diagonal of 1, so that a pivot says whether something is determined.
        let scale = normal.diagonal().map(f64::sqrt);
        let scaled = DMatrix::from_fn(normal.nrows(), normal.ncols(), |i, k| {
            normal[(i, k)] / (scale[i] * scale[k])
        });
        let pivots = Cholesky::new(scaled)?;
        if pivots.l().diagonal().iter().any(|p| p * p < 1e-10) {
            return None;
        }
        let normal = Cholesky::new(normal)?;
        let solution = normal.solve(&right);
        let heights_mm: Vec<f64> = solution.rows(0, nodes).iter().copied().collect();
        let residual = |row: &Row| {
            row.angle_rad
                - (heights_mm[row.to] - heights_mm[row.from]) / row.base_mm
                - solution[nodes + row.tilt]
        };
        let closures = lines
            .iter()
            .map(|(line, nodes)| {
                // From one end to the other, whatever the order and the direction of the steps.
                let end = end_of(at_mm, nodes);
                let away = |i: usize| (at_mm[i][0] - end[0]).hypot(at_mm[i][1] - end[1]);
                let own = rows.iter().zip(names).filter(|(_, name)| *name == line);
                let mut steps: Vec<(f64, f64)> = own
                    .map(|(row, _)| {
                        let (from, to) = (away(row.from), away(row.to));
                        let sign = if to > from { 1.0 } else { -1.0 };
                        (from.min(to), sign * residual(row) * row.base_mm)
                    })
                    .collect();
                steps.sort_by(|a, b| a.0.total_cmp(&b.0));
                let (mut sum, mut largest_mm) = (0.0_f64, 0.0_f64);
                for (_, step) in steps {
                    sum += step;
                    largest_mm = largest_mm.max(sum.abs());
                }
                Closure { line: line.clone(), largest_mm }
            })
            .collect();
        let redundant = (rows.len() + gauges.len()) as f64 - (nodes + tilts) as f64;
        let squares: f64 = rows.iter().map(|row| residual(row).powi(2)).sum();
        let scatter = (redundant > 0.0).then(|| ((squares / redundant).sqrt(), redundant));
        let (at_mm, lines) = (at_mm.clone(), lines.clone());
        Some(Lattice { at_mm, heights_mm, closures, lines, scatter, normal })
    }
}
