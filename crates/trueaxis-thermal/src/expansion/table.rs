//! The geometric error of a positioning element as a table at one temperature, and its spline.

use super::{Expansion, Runs, SENSOR_U_K};
use std::fmt::Write as _;
use trueaxis_machine::errors::{Interpolation, Spline};

/// The geometric error at one temperature.
#[derive(Debug, Clone, PartialEq)]
pub struct GeometricTable {
    /// The temperature of the scale for which it holds, °C.
    pub reference_celsius: f64,
    /// The positions, rising, mm.
    pub positions_mm: Vec<f64>,
    /// The error there, as the laser reads it, mm.
    pub errors_mm: Vec<f64>,
    /// Its standard uncertainty, mm.
    pub u_mm: Vec<f64>,
    /// The cubic spline through it, mm.
    pub spline: Spline,
}

/// The table from all runs, each brought to one temperature.
///
/// ```text
///     g_i(T) = mean over j of e_ij + α (p_i − p_0)(T − T̄)                   docs/model.md eq. 178
///     u² = s²/m + u_L² + (p_i − p_0)² ((T − T̄)² u_α² + α² Σ u_j²/m²)
/// ```
///
/// p_0 is the end of the table at which the laser was set to zero: where the runs read less. At T̄, the mean temperature of
/// the runs, table and coefficient are independent of each other. Rows at one position are averaged.
///
/// # Errors
/// In words, why there is no spline through these positions.
pub fn geometric_table(data: &Runs, found: &Expansion) -> Result<GeometricTable, String> {
    let m = data.runs.len() as f64;
    let mean_celsius = data.runs.iter().map(|r| r.celsius.value).sum::<f64>() / m;
    let reference_celsius = data.scale.reference_celsius.unwrap_or(mean_celsius);
    let moved_k = reference_celsius - mean_celsius;
    let of_sensors = data.runs.iter().map(|r| r.celsius.u.unwrap_or(SENSOR_U_K).powi(2));
    let u_mean_k = of_sensors.sum::<f64>().sqrt() / m;
    let u_laser = data.laser.u_mm.unwrap_or(0.0);
    let mean_of_row = |i: usize| data.runs.iter().map(|run| run.errors_mm[i]).sum::<f64>() / m;
    let mut rows: Vec<(f64, f64)> =
        data.positions_mm.iter().enumerate().map(|(i, p)| (*p, mean_of_row(i))).collect();
    rows.sort_by(|a, b| a.0.total_cmp(&b.0));
    let zero_mm = data.zero_mm();
    let (mut positions_mm, mut errors_mm, mut u_mm) = (Vec::new(), Vec::new(), Vec::new());
    let widest = rows.windows(2).map(|w| w[1].0 - w[0].0).fold(0.0, f64::max);
    let close = rows.windows(2).find(|w| w[1].0 > w[0].0 && w[1].0 - w[0].0 < 1e-3 * widest);
    if let Some(pair) = close {
        let (a, b) = (pair[0].0, pair[1].0);
        return Err(format!(
            "the positions {a} and {b} mm are so close that a curve between them would be noise"
        ));
    }
    for same in rows.chunk_by(|a, b| a.0 == b.0) {
        let (p, count) = (same[0].0, same.len() as f64);
        let along = p - zero_mm;
        let mean = same.iter().map(|(_, e)| e).sum::<f64>() / count;
        let scatter = found.residual_mm / (m * count).sqrt();
        let heat = along * (moved_k * found.u_per_k).hypot(found.per_k * u_mean_k);
        positions_mm.push(p);
        errors_mm.push(mean + found.per_k * along * moved_k);
        u_mm.push(scatter.hypot(u_laser).hypot(heat));
    }
    let spline = Spline::new(&positions_mm, &errors_mm, Interpolation::NotAKnot)
        .map_err(|error| error.to_string())?;
    Ok(GeometricTable { reference_celsius, positions_mm, errors_mm, u_mm, spline })
}

/// A piece of the spline as a control can evaluate it: with h = p − from, in mm,
///
/// ```text
///     e = ((a h + b) h + c) h + d, in µm                                     docs/model.md eq. 179
/// ```
///
/// # Source
/// Zhang et al. 2019, Table 1 and the equation before it (our pieces are counted from 0: errata 001-4).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SplinePiece {
    /// Where it begins, mm.
    pub from_mm: f64,
    /// Where it ends, mm.
    pub to_mm: f64,
    /// a, its coefficient of h³.
    pub a_um_per_mm3: f64,
    /// b, its coefficient of h².
    pub b_um_per_mm2: f64,
    /// c, its coefficient of h.
    pub c_um_per_mm: f64,
    /// The error where it begins, µm.
    pub d_um: f64,
}

impl GeometricTable {
    /// The pieces of the spline, from the first position to the last.
    pub fn pieces(&self) -> Vec<SplinePiece> {
        let ends = self.spline.knots().windows(2);
        let piece = |(ends, [d, c, b, a]): (&[f64], &[f64; 4])| SplinePiece {
            from_mm: ends[0],
            to_mm: ends[1],
            a_um_per_mm3: a * 1e3,
            b_um_per_mm2: b * 1e3,
            c_um_per_mm: c * 1e3,
            d_um: d * 1e3,
        };
        ends.zip(self.spline.pieces()).map(piece).collect()
    }

    /// The pieces as a CSV table; ten digits, of which a control with single precision keeps seven.
    pub fn pieces_csv(&self, name: &str) -> String {
        let mut text = format!(
            "# Positioning error of {name} at {} degC as the laser reads it: actual - nominal\n\
             # e = ((a h + b) h + c) h + d in um, h = position - from_mm\n\
             from_mm,to_mm,a_um_per_mm3,b_um_per_mm2,c_um_per_mm,d_um\n",
            self.reference_celsius
        );
        for p in self.pieces() {
            let (from, to) = (p.from_mm, p.to_mm);
            let (a, b, c) = (p.a_um_per_mm3, p.b_um_per_mm2, p.c_um_per_mm);
            // Writing into a text cannot fail.
            let _ = writeln!(text, "{from},{to},{a:.9e},{b:.9e},{c:.9e},{:.9e}", p.d_um);
        }
        text
    }
}
