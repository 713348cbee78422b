//! The coefficient of expansion of a positioning element from laser runs at several temperatures.
//!
//! ```text
//!     e_ij = g_i + o_j + α (p_i − p̄)(T_j − T̄)                              docs/model.md eq. 88
//! ```
//!
//! g_i is the geometric error, free at every position and common to all runs; o_j the zero of run j.

mod file;
mod machine_file;
mod table;

pub use file::{parse_runs, read_runs};
pub use machine_file::{ScaleFiles, scale_files};
pub use table::{GeometricTable, SplinePiece, geometric_table};

use std::path::PathBuf;
use trueaxis_input::MeasuredValue;

/// No scale grows more, or shrinks, 1/K.
const POSSIBLE_PER_K: std::ops::RangeInclusive<f64> = -1e-6..=50e-6;
/// The uncertainty of a temperature where none is stated, K: a usual contact sensor.
const SENSOR_U_K: f64 = 0.1;
/// One strange run of m leaves (m − 1)² times as much in itself as, by the common geometry, in each
/// of the others; from this share of it on a run is named.
const OUTLIER_SHARE: f64 = 0.6;
/// Among fewer runs an inconsistent one cannot be identified.
const RUNS_TO_JUDGE: usize = 4;

/// One laser run.
#[derive(Debug, Clone, PartialEq)]
pub struct Run {
    /// Its name: the column of the table without its unit.
    pub name: String,
    /// The temperature of the scale, °C, with its standard uncertainty.
    pub celsius: MeasuredValue,
    /// The error at each position, mm.
    pub errors_mm: Vec<f64>,
}

/// Runs over the same positions at several temperatures.
#[derive(Debug, Clone, PartialEq)]
pub struct Runs {
    /// What is measured.
    pub name: String,
    /// The positions, mm.
    pub positions_mm: Vec<f64>,
    /// At least two.
    pub runs: Vec<Run>,
    /// What is known of the scale besides.
    pub scale: ScaleKeys,
    /// What is known of the laser.
    pub laser: LaserKeys,
}

/// What the file says of the scale, for a machine file.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ScaleKeys {
    /// The letter of its axis.
    pub axis: Option<String>,
    /// The machine file.
    pub machine: Option<PathBuf>,
    /// Where on the axis it is fixed, mm.
    pub fixed_mm: Option<f64>,
    /// The name of its temperature sensor.
    pub sensor: Option<String>,
    /// The temperature of the table to be made; without it the mean of the runs, °C.
    pub reference_celsius: Option<f64>,
    /// When it was measured.
    pub date: Option<String>,
}

/// What the file says of the laser.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct LaserKeys {
    /// Its name.
    pub instrument: Option<String>,
    /// The standard uncertainty of a reading beside its scatter, mm.
    pub u_mm: Option<f64>,
    /// What it had taken for the expansion of the material, 1/K, and has subtracted already.
    pub material_per_k: Option<f64>,
}

/// What materials scales are made of, with 10⁻⁶/K from and to.
const MATERIALS: [(&str, f64, f64); 3] =
    [("steel tape", 10.0, 12.0), ("glass", 7.8, 9.0), ("Zerodur", -0.5, 0.5)];

/// An identified coefficient.
#[derive(Debug, Clone, PartialEq)]
pub struct Expansion {
    /// α by least squares over all runs, 1/K.
    pub per_k: f64,
    /// Its standard uncertainty: scatter of the readings and uncertainty of the temperatures, 1/K.
    pub u_per_k: f64,
    /// From the two runs at the ends of the temperatures alone, by their slopes, 1/K.
    pub slope_difference_per_k: f64,
    /// The slope of each run's straight line, mm/mm. Unit: 1.
    pub slopes: Vec<f64>,
    /// The standard deviation of what the model leaves, mm.
    pub residual_mm: f64,
    /// The materials that the coefficient allows within ± 2 u.
    pub materials: Vec<&'static str>,
    /// What the reader should know.
    pub warnings: Vec<String>,
}

/// The coefficient from all runs.
///
/// With the same positions in all runs the least squares of equation 88 are the regression of the
/// slopes b_j on the temperatures; for two runs that is the slope difference of the source.
///
/// ```text
///     α = Σ (T_j − T̄) b_j / Σ (T_j − T̄)²                                  docs/model.md eq. 88
///     u² = s²/(Σ (p_i − p̄)² Σ (T_j − T̄)²) + α² Σ (T_j − T̄)² u_j² / (Σ (T_j − T̄)²)²
/// ```
///
/// # Source
/// Zhang et al. 2019, section 1.4.2 (two runs); the uncertainty by GUM, first order.
pub fn identify_expansion(data: &Runs) -> Expansion {
    let mean = |v: &[f64]| v.iter().sum::<f64>() / v.len() as f64;
    let p_mean = mean(&data.positions_mm);
    let p: Vec<f64> = data.positions_mm.iter().map(|v| v - p_mean).collect();
    let celsius: Vec<f64> = data.runs.iter().map(|r| r.celsius.value).collect();
    let t_mean = mean(&celsius);
    let t: Vec<f64> = celsius.iter().map(|v| v - t_mean).collect();
    let square = |v: &[f64]| v.iter().map(|x| x * x).sum::<f64>();
    let (p_square, t_square) = (square(&p), square(&t));
    let slope =
        |run: &Run| p.iter().zip(&run.errors_mm).map(|(p, e)| p * e).sum::<f64>() / p_square;
    let slopes: Vec<f64> = data.runs.iter().map(slope).collect();
    let per_k = t.iter().zip(&slopes).map(|(t, b)| t * b).sum::<f64>() / t_square;
    let by_run = residuals(data, &p, &t, per_k);
    let freedom = (p.len() - 1) * (t.len() - 1) - 1;
    let residual_mm = (by_run.iter().map(|r| square(r)).sum::<f64>() / freedom as f64).sqrt();
    let of_sensors = data.runs.iter().zip(&t).map(|(run, t)| {
        let u = run.celsius.u.unwrap_or(SENSOR_U_K);
        (per_k * t * u / t_square).powi(2)
    });
    let u_square = residual_mm.powi(2) / (p_square * t_square) + of_sensors.sum::<f64>();
    let u_per_k = u_square.sqrt();
    let (coldest, warmest) = ends(&celsius);
    Expansion {
        per_k,
        u_per_k,
        slope_difference_per_k: (slopes[warmest] - slopes[coldest])
            / (celsius[warmest] - celsius[coldest]),
        warnings: warnings(data, &by_run, (per_k, u_per_k)),
        slopes,
        residual_mm,
        materials: materials(per_k, u_per_k),
    }
}

fn ends(celsius: &[f64]) -> (usize, usize) {
    let (mut coldest, mut warmest) = (0, 0);
    for (i, c) in celsius.iter().enumerate() {
        if *c < celsius[coldest] {
            coldest = i;
        }
        if *c > celsius[warmest] {
            warmest = i;
        }
    }
    (coldest, warmest)
}

/// The residual of each run when geometry, zero and expansion are subtracted.
fn residuals(data: &Runs, p: &[f64], t: &[f64], per_k: f64) -> Vec<Vec<f64>> {
    let (n, m) = (p.len() as f64, t.len() as f64);
    let left: Vec<Vec<f64>> = data
        .runs
        .iter()
        .zip(t)
        .map(|(run, t)| run.errors_mm.iter().zip(p).map(|(e, p)| e - per_k * p * t).collect())
        .collect();
    let of_run: Vec<f64> = left.iter().map(|r: &Vec<f64>| r.iter().sum::<f64>() / n).collect();
    let of_place: Vec<f64> =
        (0..p.len()).map(|i| left.iter().map(|r| r[i]).sum::<f64>() / m).collect();
    let all = of_run.iter().sum::<f64>() / m;
    let centred = |(r, mean): (&Vec<f64>, &f64)| {
        r.iter().zip(&of_place).map(|(e, place)| e - mean - place + all).collect()
    };
    left.iter().zip(&of_run).map(centred).collect()
}

impl Runs {
    /// Where the laser was set to zero: the end of the travel, by its position and not by its row, at which the runs read
    /// less, mm. Of ends that read the same it is the lower one.
    pub fn zero_mm(&self) -> f64 {
        let Some(low) = self.positions_mm.iter().copied().reduce(f64::min) else { return 0.0 };
        let high = self.positions_mm.iter().copied().fold(low, f64::max);
        match self.mean_size_at(low) <= self.mean_size_at(high) {
            true => low,
            false => high,
        }
    }

    /// How much the runs read at a position in the mean of its rows, without the sign, mm.
    fn mean_size_at(&self, position_mm: f64) -> f64 {
        let rows = || (0..self.positions_mm.len()).filter(|i| self.positions_mm[*i] == position_mm);
        let size = |i: usize| self.runs.iter().map(|run| run.errors_mm[i].abs()).sum::<f64>();
        rows().map(size).sum::<f64>() / rows().count().max(1) as f64
    }
}

impl Expansion {
    /// Whether a scale can have this coefficient.
    pub fn is_possible(&self) -> bool {
        let (low, high) = (self.per_k - 2.0 * self.u_per_k, self.per_k + 2.0 * self.u_per_k);
        high >= *POSSIBLE_PER_K.start() && low <= *POSSIBLE_PER_K.end()
    }
}

fn warnings(data: &Runs, residuals: &[Vec<f64>], (per_k, u_per_k): (f64, f64)) -> Vec<String> {
    let mut warnings = Vec::new();
    if per_k - 2.0 * u_per_k > *POSSIBLE_PER_K.end()
        || per_k + 2.0 * u_per_k < *POSSIBLE_PER_K.start()
    {
        warnings.push(format!(
            "no scale has {:.3} µm/(m·K): are two temperatures or two columns swapped, a unit wrong, or \
             did the laser compensate a material ([laser] material_expansion)?",
            per_k * 1e6
        ));
    }
    if data.runs.iter().any(|r| r.celsius.u.is_none()) {
        warnings.push(format!(
            "no uncertainty of the temperature is stated for some runs: ± {SENSOR_U_K} K taken"
        ));
    }
    if data.runs.len() >= RUNS_TO_JUDGE {
        let size = |r: &Vec<f64>| r.iter().map(|v| v * v).sum::<f64>();
        let all: f64 = residuals.iter().map(size).sum();
        for (run, r) in data.runs.iter().zip(residuals) {
            let rest = (residuals.len() - 1) as f64;
            let others = (all - size(r)) / rest;
            if size(r) > OUTLIER_SHARE * rest * rest * others {
                warnings.push(format!("run `{}` does not go with the others", run.name));
            }
        }
    }
    warnings
}

fn materials(per_k: f64, u_per_k: f64) -> Vec<&'static str> {
    let (low, high) = ((per_k - 2.0 * u_per_k) * 1e6, (per_k + 2.0 * u_per_k) * 1e6);
    let fits = MATERIALS.iter().filter(|(_, from, to)| low <= *to && high >= *from);
    fits.map(|(name, ..)| *name).collect()
}
