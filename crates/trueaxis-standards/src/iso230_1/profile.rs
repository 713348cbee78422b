//! Profiles of lines: readings of an indicator or a laser, or steps of a level or a mirror added up.

use std::collections::BTreeMap;
use trueaxis_geometry::statistics::pooled_deviation;
use trueaxis_input::sheet::{Cells, Sheet, heading};
use trueaxis_input::{Diagnostics, Dimension};

/// Positions closer than this are the same, mm.
const SAME_MM: f64 = 1e-6;
/// A step may differ from the base by this share of it.
const STEP_SHARE: f64 = 1e-3;

/// Heights along a line.
#[derive(Debug, Clone, PartialEq)]
pub struct Profile {
    /// The axis or line, if the table names it.
    pub name: String,
    /// Positions, mm.
    pub x_mm: Vec<f64>,
    /// Heights, mm.
    pub heights_mm: Vec<f64>,
    /// Readings in each height, or in each step. Unit: 1.
    pub counts: Vec<f64>,
    /// Length of the steps whose angles were added up, mm; `None` for heights that were read.
    pub step_mm: Option<f64>,
}

impl Profile {
    /// Σ w² by readings of variance 1 (mm² or rad²) for a sum over the heights. Unit: mm² or 1.
    pub fn variance(&self, weights: &[f64]) -> f64 {
        match self.step_mm {
            None => weights.iter().zip(&self.counts).map(|(w, n)| w * w / n).sum(),
            Some(step) => {
                // A step lifts all that come after it.
                let (mut after, mut sum) = (0.0, 0.0);
                for (w, n) in weights.iter().skip(1).zip(&self.counts).rev() {
                    after += w;
                    sum += (after * step).powi(2) / n;
                }
                sum
            }
        }
    }

    /// Half the sum, or half the difference, of two set-ups.
    pub fn combined(&self, other: &Self, sign: f64) -> Self {
        let heights = self.heights_mm.iter().zip(&other.heights_mm);
        let counts = self.counts.iter().zip(&other.counts);
        Self {
            heights_mm: heights.map(|(a, b)| 0.5 * (a + sign * b)).collect(),
            // The variance of half a sum is (1/m + 1/n)/4.
            counts: counts.map(|(m, n)| 4.0 / (1.0 / m + 1.0 / n)).collect(),
            ..self.clone()
        }
    }
}

/// The profiles of a table and how far its readings scatter.
pub struct Profiles {
    /// In the order of the table: name, first set-up, reversed set-up.
    pub lines: Vec<(String, Profile, Option<Profile>)>,
    /// Standard deviation of a reading between runs and its degrees of freedom. Unit: mm or rad.
    pub scatter: Option<(f64, f64)>,
    /// Whether angles were read.
    pub of_angles: bool,
}

impl Profiles {
    /// How readings scatter, and whether they are angles.
    pub fn seen(&self) -> (Option<(f64, f64)>, bool) {
        (self.scatter, self.of_angles)
    }
}

/// What the columns hold.
pub fn cells(name: &str) -> Cells {
    match heading(name).0 {
        "position" | "deviation" | "angle" | "x" | "y" | "z" | "from_x" | "from_y" | "to_x"
        | "to_y" | "time" | "temperature" => Cells::Numbers,
        "axis" | "line" | "setup" | "run" => Cells::Words,
        _ => Cells::Unused,
    }
}

/// The words of a column, row by row; empty words where there is none.
pub fn words(sheet: &Sheet, name: &str) -> Vec<String> {
    let column = sheet.columns.iter().find(|c| c.name == name && c.cells == Cells::Words);
    match column {
        Some(column) => column.values.iter().map(|w| sheet.words[*w as usize].clone()).collect(),
        None => vec![String::new(); sheet.rows()],
    }
}

/// Reads the profiles of a table; `None` with errors in `problems`.
pub fn read(sheet: &Sheet, base_mm: Option<f64>, problems: &mut Diagnostics) -> Option<Profiles> {
    let hint = "position_mm and deviation_um, or position_mm (of the rear foot) and angle_urad";
    let (position, angle) = (sheet.about("position"), sheet.about("angle"));
    let reading = angle.or(sheet.about("deviation"));
    let (Some(position), Some(reading)) = (position, reading) else {
        let message = "the table has no column of positions, or none of readings".to_owned();
        problems.error("missing-column", sheet.headings_place(), message, hint);
        return None;
    };
    let dimension = if angle.is_some() { Dimension::Angle } else { Dimension::Length };
    let at = sheet.inner(position, Dimension::Length, problems)?;
    let values = sheet.inner(reading, dimension, problems)?;
    let (axis, line, setup) = (words(sheet, "axis"), words(sheet, "line"), words(sheet, "setup"));
    let mut groups: Vec<(String, [Grouped; 2])> = Vec::new();
    for row in 0..sheet.rows() {
        let name = format!("{}{}", axis[row], line[row]);
        let side = match setup[row].as_str() {
            "" | "normal" => 0,
            "reversed" => 1,
            other => {
                let message = format!("`{other}` is no set-up");
                let hint = "normal or reversed: the straightedge or square was reversed";
                problems.error("unknown-word", sheet.row_place(row), message, hint);
                return None;
            }
        };
        let place = groups.iter().position(|(n, _)| *n == name).unwrap_or_else(|| {
            groups.push((name, [Grouped::new(), Grouped::new()]));
            groups.len() - 1
        });
        // why: positions are finite numbers of a file; in units of a thousandth of a micrometre they fit.
        let key = (at[row] / SAME_MM).round() as i64;
        groups[place].1[side].entry(key).or_default().push(values[row]);
    }
    let mut lines = Vec::new();
    for (name, [normal, reversed]) in &groups {
        let (one, other) = match (normal.is_empty(), reversed.is_empty()) {
            (false, false) => (normal, Some(reversed)),
            (true, _) => (reversed, None),
            (false, true) => (normal, None),
        };
        let of = |g: &Grouped, problems: &mut Diagnostics| {
            profile(name, g, angle.is_some(), base_mm, sheet, problems)
        };
        let first = of(one, problems)?;
        let second = match other {
            Some(g) => Some(of(g, problems)?),
            None => None,
        };
        if second.as_ref().is_some_and(|s| s.x_mm != first.x_mm) {
            let message = format!("the two set-ups of `{name}` have other positions");
            let hint = "read both at the same positions: the reversal compares them point by point";
            problems.error("setups-differ", sheet.headings_place(), message, hint);
            return None;
        }
        lines.push((name.clone(), first, second));
    }
    let all = groups.iter().flat_map(|(_, sides)| sides.iter().flat_map(BTreeMap::values));
    Some(Profiles {
        lines,
        scatter: pooled_deviation(all.map(Vec::as_slice)),
        of_angles: angle.is_some(),
    })
}

type Grouped = BTreeMap<i64, Vec<f64>>;

fn profile(
    name: &str,
    grouped: &Grouped,
    of_angles: bool,
    base_mm: Option<f64>,
    sheet: &Sheet,
    problems: &mut Diagnostics,
) -> Option<Profile> {
    let mut x_mm: Vec<f64> = grouped.keys().map(|k| *k as f64 * SAME_MM).collect();
    let counts: Vec<f64> = grouped.values().map(|v| v.len() as f64).collect();
    let means = grouped.values().map(|v| v.iter().sum::<f64>() / v.len() as f64);
    let fewest = if of_angles { 2 } else { 3 };
    if x_mm.len() < fewest {
        let message = format!("line `{name}` has {} positions", x_mm.len());
        let hint = "a line needs three points at least";
        problems.error("few-positions", sheet.headings_place(), message, hint);
        return None;
    }
    let name = name.to_owned();
    if !of_angles {
        return Some(Profile { name, x_mm, heights_mm: means.collect(), counts, step_mm: None });
    }
    let step = base_mm.unwrap_or(x_mm[1] - x_mm[0]);
    if let Some(pair) = x_mm.windows(2).find(|p| (p[1] - p[0] - step).abs() > STEP_SHARE * step) {
        let message = format!(
            "the steps of line `{name}` are not the base: from {} to {} mm, base {step} mm",
            pair[0], pair[1]
        );
        let hint = "each step begins where the one before it ends: the rear foot stands where the front foot \
                    stood; state [test] base = \"100 mm\" as it is";
        problems.error("base-gap", sheet.headings_place(), message, hint);
        return None;
    }
    let mut heights_mm = vec![0.0];
    for angle in means {
        heights_mm.push(heights_mm[heights_mm.len() - 1] + angle * step);
    }
    x_mm.push(x_mm[x_mm.len() - 1] + step);
    Some(Profile { name, x_mm, heights_mm, counts, step_mm: Some(step) })
}
