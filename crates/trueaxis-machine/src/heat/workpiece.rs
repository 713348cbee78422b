//! The workpiece: it grows from its fixed point, and the part is judged at 20 °C.

use super::conditions::Conditions;
use super::expansion::Profile;
use super::{REFERENCE_CELSIUS, Sensor};
use trueaxis_geometry::Vec3;
use trueaxis_input::{Diagnostics, MeasuredValue};

/// What is known of the growth of the workpiece.
#[derive(Debug, Clone, PartialEq)]
pub struct Workpiece {
    /// α_w, 1/K.
    pub expansion_per_k: MeasuredValue,
    /// Where it is fixed, in the workpiece frame, mm.
    pub fixed_mm: Vec3,
    /// Unit vector along which the sensors are placed.
    pub along: Vec3,
    /// Its sensors; with one it is uniform.
    pub sensors: Vec<Sensor>,
    /// How it approaches the temperature of the workshop, if stated.
    pub settling: Option<Settling>,
}

impl Workpiece {
    pub(super) fn growth(
        &self,
        conditions: &Conditions,
        problems: &mut Diagnostics,
    ) -> Option<WorkpieceGrowth> {
        let sensors = self.sensors.iter().map(|s| s.name.as_str());
        let celsius = conditions.of("workpiece", sensors, problems)?;
        let placed = self.sensors.iter().zip(&celsius).map(|(s, c)| (s.place_mm, *c)).collect();
        Some(WorkpieceGrowth {
            expansion_per_k: self.expansion_per_k,
            fixed_mm: self.fixed_mm,
            along: self.along,
            profile: Profile::new(placed)?,
        })
    }
}

/// How a workpiece has grown since 20 °C.
#[derive(Debug, Clone, PartialEq)]
pub struct WorkpieceGrowth {
    /// α_w, 1/K.
    pub expansion_per_k: MeasuredValue,
    /// Where it is fixed, in the workpiece frame, mm.
    pub fixed_mm: Vec3,
    /// Unit vector along which the temperature changes.
    pub along: Vec3,
    /// The temperature along it, the places counted from the workpiece zero.
    pub profile: Profile,
}

impl WorkpieceGrowth {
    /// E_w: where the material that belongs at a point has gone, mm.
    ///
    /// ```text
    ///     E_w = α_w (T_w − 20 °C) (p − f)                                  docs/model.md eq. 86
    /// ```
    ///
    /// With several sensors along d: by the integral along d, and across d freely with the
    /// temperature there; that a body bends under a gradient is left out.
    ///
    /// # Source
    /// Zhang et al. 2019, section 2; ISO 1 for 20 °C.
    pub fn at(&self, p_mm: Vec3) -> Vec3 {
        self.per_expansion(p_mm) * self.expansion_per_k.value
    }

    /// How much it grows per mm from its fixed point, in every direction; `None` if its temperature
    /// changes along it.
    pub(crate) fn per_mm(&self) -> Option<f64> {
        let celsius = self.profile.uniform()?;
        Some((celsius - REFERENCE_CELSIUS) * self.expansion_per_k.value)
    }

    /// What one standard uncertainty of α_w adds to it, mm.
    ///
    /// ```text
    ///     u(E_w) = u(α_w) (T_w − 20 °C) (p − f)                            docs/model.md eq. 86
    /// ```
    pub fn u_at(&self, p_mm: Vec3) -> Vec3 {
        self.per_expansion(p_mm) * self.expansion_per_k.u.unwrap_or(0.0)
    }

    /// ∂E_w/∂α_w, mm·K.
    fn per_expansion(&self, p_mm: Vec3) -> Vec3 {
        let from_fixed = p_mm - self.fixed_mm;
        if let Some(celsius) = self.profile.uniform() {
            return from_fixed * (celsius - REFERENCE_CELSIUS);
        }
        let (fixed, s) = (self.along.dot(&self.fixed_mm), self.along.dot(&p_mm));
        let across = from_fixed - self.along * (s - fixed);
        let along = self.profile.integral(fixed, s, REFERENCE_CELSIUS);
        let rise = self.profile.celsius_at(s) - REFERENCE_CELSIUS;
        self.along * along + across * rise
    }
}

/// How a plate takes the temperature of the air on both of its sides, its own being the same all
/// through (lumped).
///
/// ```text
///     T(t) − T_air = (T₀ − T_air) e^(−t/θ),   θ = c d/(2h)                 docs/model.md eq. 87
/// ```
///
/// Limits: Biot number h·d/(2λ) well below 1, true for metal in still air.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settling {
    /// θ, s.
    pub time_constant_s: f64,
}

impl Settling {
    /// From the thickness of the plate (mm), the film coefficient (W/(m²·K)) and the heat capacity
    /// of its volume (J/(m³·K)).
    pub fn of_plate(thickness_mm: f64, film_w_per_m2_k: f64, heat_j_per_m3_k: f64) -> Self {
        let half_m = 0.5 * thickness_mm * 1e-3;
        Self { time_constant_s: heat_j_per_m3_k * half_m / film_w_per_m2_k }
    }

    /// Until it is within a tolerance (K) of the air, from a difference (K) at first, s.
    pub fn time_to_s(&self, difference_k: f64, tolerance_k: f64) -> f64 {
        self.time_constant_s * (difference_k.abs() / tolerance_k.abs()).ln().max(0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn growth_along_and_across_sensors() {
        let profile = Profile::new(vec![(0.0, 20.0), (1000.0, 30.0)]).unwrap();
        let (fixed_mm, along) = (Vec3::zeros(), Vec3::x());
        let expansion_per_k = MeasuredValue { value: 1e-5, u: Some(1e-6) };
        let growth = WorkpieceGrowth { expansion_per_k, fixed_mm, along, profile };
        // along: 1e-5 · ½ · 10 K · 1000 mm = 0.05 mm; across: 1e-5 · 10 K · 200 mm = 0.02 mm
        let grown = growth.at(Vec3::new(1000.0, 200.0, 0.0));
        assert!((grown - Vec3::new(0.05, 0.02, 0.0)).norm() < 1e-15);
        // A tenth of α_w is a tenth of the growth.
        let u = growth.u_at(Vec3::new(1000.0, 200.0, 0.0));
        assert!((u - Vec3::new(0.005, 0.002, 0.0)).norm() < 1e-15);
        // Fixed at x500 y100: along 1e-5 · (1000² − 500²)/200 K·mm, across 1e-5 · 10 K · 200 mm
        let fixed = WorkpieceGrowth { fixed_mm: Vec3::new(500.0, 100.0, 0.0), ..growth };
        let grown = fixed.at(Vec3::new(1000.0, 300.0, 0.0));
        assert!((grown - Vec3::new(0.0375, 0.02, 0.0)).norm() < 1e-15);
    }

    #[test]
    fn a_plate_of_60_mm_iron_settles_in_hours() {
        // 3.6 MJ/(m³K) · 0.03 m / 8 W/(m²K) = 13500 s; from 10 K to 1 K: ln 10 of that
        let settling = Settling::of_plate(60.0, 8.0, 3.6e6);
        assert!((settling.time_constant_s - 13_500.0).abs() < 1e-9);
        assert!((settling.time_to_s(10.0, 1.0) - 13_500.0 * 10_f64.ln()).abs() < 1e-9);
    }
}
