//! The spread of one output.

/// What the values of an output say.
#[derive(Debug, Clone, PartialEq)]
pub struct Spread {
    /// Mean, mm.
    pub mean_mm: f64,
    /// Standard deviation; none of a single part. Unit: mm.
    pub u_mm: Option<f64>,
    /// 2.5 % quantile, mm.
    pub low_mm: f64,
    /// 97.5 % quantile, mm.
    pub high_mm: f64,
    /// The smallest value, mm.
    pub least_mm: f64,
    /// The largest, mm.
    pub largest_mm: f64,
    /// How often which values occur.
    pub histogram: Histogram,
}

/// How often which values occur: counts in cells of one width between the smallest and the largest value.
#[derive(Debug, Clone, PartialEq)]
pub struct Histogram {
    /// Where the first cell begins, mm.
    pub from_mm: f64,
    /// The width of a cell, mm.
    pub width_mm: f64,
    /// How many values each cell has.
    pub counts: Vec<usize>,
}

/// Cells beyond these show noise.
const MOST_CELLS: usize = 60;

impl Spread {
    /// Of some values, at least one.
    pub fn of(mut values: Vec<f64>) -> Self {
        let n = values.len() as f64;
        let mean_mm = values.iter().sum::<f64>() / n;
        let squares = values.iter().map(|v| (v - mean_mm).powi(2)).sum::<f64>();
        values.sort_by(f64::total_cmp);
        let quantile = |q: f64| values[((n - 1.0) * q).round() as usize];
        Self {
            mean_mm,
            u_mm: (n > 1.0).then(|| (squares / (n - 1.0)).sqrt()),
            low_mm: quantile(0.025),
            high_mm: quantile(0.975),
            least_mm: values[0],
            largest_mm: values[values.len() - 1],
            histogram: Histogram::of(&values),
        }
    }
}

impl Histogram {
    /// Of sorted values: about √n cells.
    fn of(sorted: &[f64]) -> Self {
        let (from_mm, to) = (sorted[0], sorted[sorted.len() - 1]);
        let cells = ((sorted.len() as f64).sqrt() as usize).clamp(1, MOST_CELLS);
        let width_mm = (to - from_mm) / cells as f64;
        let mut counts = vec![0; cells];
        for value in sorted {
            let cell = ((value - from_mm) / width_mm) as usize;
            counts[cell.min(cells - 1)] += 1;
        }
        Self { from_mm, width_mm, counts }
    }
}
