//! What a measuring machine would find: its points scatter, and have errors in common.

use super::super::monte_carlo::{Sampling, spreads};
use trueaxis_geometry::{Mat3, Vec3};
use trueaxis_input::{Dimension, Section, parse_quantity};
use trueaxis_part::part::Part;

/// No measuring machine is worse. Unit: mm.
const MOST_POINT_U_MM: f64 = 0.1;
/// A millimetre per metre. Unit: 1.
const MOST_COMMON_U: f64 = 1e-3;

/// How well the machine that will measure the part does it: standard uncertainties.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Measurement {
    /// Of each point along its normal, independent of the others, mm.
    pub point_u_mm: f64,
    /// Of all lengths alike, such as by the temperature of the part. Unit: 1.
    pub length_u: f64,
    /// Of lengths along each axis of the measuring machine by itself. Unit: 1.
    pub scale_u: f64,
    /// Of the squareness of each two of its axes, rad.
    pub squareness_u_rad: f64,
}

impl Measurement {
    /// `[measurement]` with `point_u = "1 um"`, `length_u`, `scale_u`, `squareness_u = "2 um/m"`.
    pub(super) fn read(section: &Section<'_>) -> Option<Self> {
        let value = |key: &str, dimension: Dimension, most: f64, words: &str| {
            let Some(item) = section.get(key) else { return Some(0.0) };
            let u = item.quantity(dimension)?;
            if u > 0.0 && u <= most {
                return Some(u);
            }
            let text = item.as_text().unwrap_or_default();
            let message = format!("`{key}` = {text}");
            item.error("impossible-value", message, words);
            None
        };
        let common = |key: &str| {
            let hint = "of each metre, above zero and at most 1000 um/m: \"2 um/m\"";
            let item = section.get(key);
            if let Some(text) = item.as_ref().and_then(|i| i.as_text())
                && parse_quantity(text, Dimension::Length).is_ok()
            {
                let message = format!("`{text}` is a length, expected a length of each metre");
                item.as_ref()?.error("wrong-unit", message, hint);
                return None;
            }
            value(key, Dimension::Angle, MOST_COMMON_U, hint)
        };
        let point =
            value("point_u", Dimension::Length, MOST_POINT_U_MM, "above zero and at most 0.1 mm");
        let (length, scale, squareness) =
            (common("length_u"), common("scale_u"), common("squareness_u"));
        let found = Self {
            point_u_mm: point?,
            length_u: length?,
            scale_u: scale?,
            squareness_u_rad: squareness?,
        };
        if found == Self::default() {
            let hint =
                "the standard uncertainty of a point of the measuring machine: point_u = \"1 um\"";
            section.error("missing-key", "[measurement] states no uncertainty".to_owned(), hint);
            return None;
        }
        Some(found)
    }

    fn has_common(&self) -> bool {
        self.length_u > 0.0 || self.scale_u > 0.0 || self.squareness_u_rad > 0.0
    }

    /// By how much a place is found elsewhere, per mm from the zero: a strain without a turn.
    fn strain(&self, factors: &[f64]) -> Mat3 {
        let [all, x, y, z, xy, yz, zx] = *factors else { return Mat3::zeros() };
        let along = |own: f64| self.length_u * all + self.scale_u * own;
        let [xy, yz, zx] = [xy, yz, zx].map(|own| 0.5 * self.squareness_u_rad * own);
        Mat3::new(along(x), xy, zx, xy, along(y), yz, zx, yz, along(z))
    }
}

/// Factors of what points have in common: all lengths, three scales, three squarenesses.
const COMMON: usize = 7;

/// Measurements that are drawn: the deviation of the values is known to 3.5 %.
const SAMPLES: usize = 400;
const SEED: u64 = 14_406;

/// A characteristic as it would be measured.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Measured {
    /// The mean of its values; a form is found larger than it is, mm.
    pub mean_mm: f64,
    /// Standard uncertainty by the measuring machine, mm.
    pub u_mm: f64,
}

/// The characteristics of a surface whose points are measured so. Docs/model.md eq. 325.
pub(super) fn measured(
    part: &Part,
    deviations: &[f64],
    by: &Measurement,
) -> Result<Vec<Measured>, String> {
    let places: Vec<(Vec3, Vec3)> =
        part.features.iter().flat_map(|f| &f.points).map(|p| (p.point_mm, p.normal)).collect();
    let count = deviations.len();
    let sample = |factors: &[f64], surface: &mut Vec<f64>, found: &mut [f64]| {
        let (own, common) = factors.split_at(count);
        surface.clear();
        surface.extend(deviations.iter().zip(own).map(|(d, z)| d + z * by.point_u_mm));
        if by.has_common() {
            let strain = by.strain(common);
            for (found, (place, normal)) in surface.iter_mut().zip(&places) {
                *found += normal.dot(&(strain * place));
            }
        }
        found.copy_from_slice(&part.evaluate(surface).map_err(|e| e.to_string())?);
        Ok::<(), String>(())
    };
    let sampling = Sampling { samples: SAMPLES, seed: SEED };
    let drawn = if by.has_common() { count + COMMON } else { count };
    let counts = [drawn, part.characteristics.len()];
    let found = spreads(sampling, counts, sample, &|_| {})?;
    Ok(found.iter().map(|s| Measured { mean_mm: s.mean_mm, u_mm: s.u_mm }).collect())
}
