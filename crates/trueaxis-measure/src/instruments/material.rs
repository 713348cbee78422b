//! Material compensation of a laser: it shows the lengths that a workpiece will have at 20 °C.
//!
//! ```text
//!     r = n · (P − Q) − κ n · (P₀ − F)        κ = α (T − 20 °C)            docs/model.md eq. 185
//! ```
//!
//! P₀ is the nominal tool point, F the datum: the point of the material that stays where it is. Without
//! it the laser reads the machine alone, however warm the workpiece is; set to the coefficient of the
//! workpiece with its sensor on it, it reads machine − workpiece, the comprehensive error.

use trueaxis_geometry::Vec3;
use trueaxis_input::MeasuredValue;
use trueaxis_machine::heat::{Conditions, REFERENCE_CELSIUS};

/// The settings of a laser for the expansion of a material.
///
/// A laser divides the length that it counts by 1 + κ. Here κ is multiplied by the nominal length, as
/// eq. 86 does it for the workpiece: with an error of 0.4 mm and κ = 1.4·10⁻⁴ both differ by 0.06 µm, and
/// κ² · 3.5 m = 0.07 µm.
#[derive(Debug, Clone, PartialEq)]
pub struct MaterialCompensation {
    /// α, 1/K.
    pub expansion_per_k: MeasuredValue,
    /// T, °C.
    pub celsius: MeasuredValue,
    /// The sensor of the machine that T is read from; none: T is typed in.
    pub sensor: Option<String>,
    /// F, in the frame of the reference, mm.
    pub datum_mm: Vec3,
}

impl MaterialCompensation {
    /// κ: how much longer the material is than at 20 °C. Unit: 1.
    pub fn share(&self) -> f64 {
        self.expansion_per_k.value * (self.celsius.value - REFERENCE_CELSIUS)
    }

    /// The standard uncertainty of κ. Unit: 1.
    ///
    /// ```text
    ///     u(κ)² = ((T − 20 °C) u(α))² + (α u(T))²                          docs/model.md eq. 186
    /// ```
    ///
    /// # Source
    /// GUM (JCGM 100:2008), eq. 10.
    pub fn u_share(&self) -> f64 {
        let by_expansion =
            (self.celsius.value - REFERENCE_CELSIUS) * self.expansion_per_k.u.unwrap_or(0.0);
        by_expansion.hypot(self.expansion_per_k.value * self.celsius.u.unwrap_or(0.0))
    }

    /// The same while its sensor has another temperature; the sensor, if it has none.
    ///
    /// # Errors
    /// The name of the sensor of which the conditions say nothing.
    pub fn at(&self, conditions: &Conditions) -> Result<Self, String> {
        let Some(sensor) = &self.sensor else { return Ok(self.clone()) };
        let value = conditions.celsius(sensor).ok_or_else(|| sensor.clone())?;
        Ok(Self { celsius: MeasuredValue { value, ..self.celsius }, ..self.clone() })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 13.2 µm/(m·K) · 10.5 K = 138.6 µm/m; u: 10.5 · 0.3 = 3.15 and 13.2 · 0.1 = 1.32 µm/m.
    #[test]
    fn the_share_by_hand() {
        let measured = |value, u| MeasuredValue { value, u };
        let mut laser = MaterialCompensation {
            expansion_per_k: measured(13.2e-6, Some(0.3e-6)),
            celsius: measured(30.5, Some(0.1)),
            sensor: Some("workpiece".into()),
            datum_mm: Vec3::zeros(),
        };
        assert!((laser.share() - 138.6e-6).abs() < 1e-15);
        assert!((laser.u_share() - 3.15e-6f64.hypot(1.32e-6)).abs() < 1e-15);
        // At 20 °C nothing grows, and only the temperature is uncertain.
        laser.celsius.value = 20.0;
        assert_eq!(laser.share(), 0.0);
        assert!((laser.u_share() - 1.32e-6).abs() < 1e-15);
        let warm = Conditions::default().with_reading("workpiece", 25.0);
        assert_eq!(laser.at(&warm).map(|l| l.celsius.value), Ok(25.0));
        assert_eq!(laser.at(&Conditions::default()), Err("workpiece".to_owned()));
        laser.sensor = None;
        assert_eq!(laser.at(&warm).map(|l| l.celsius.value), Ok(20.0));
    }
}
