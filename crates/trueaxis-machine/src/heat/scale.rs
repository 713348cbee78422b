//! Scales and screws as positioning elements, and linear models of single errors.

use super::conditions::Conditions;
use super::expansion::{Anchor, Profile, growth_curve, sampled_curve};
use super::field::{HeatedAt, ScaleField, Source};
use super::{ErrorPart, Sensor, ThermalTerm, reach_of, with_u};
use crate::axis::Axis;
use crate::errors::{Component, Curve, ErrorIndex, ErrorKind};
use trueaxis_geometry::input::{Diagnostics, Measured};

/// The work for a changing flux grows with the square of the rows of its log.
const MOST_ROWS: usize = 5000;

/// Heat that comes into a scale at one place.
#[derive(Debug, Clone, PartialEq)]
pub struct HeatedPlace {
    /// Where, mm.
    pub place_mm: f64,
    /// The sensor there.
    pub near: String,
    /// The sensor that the heat has not reached.
    pub far: String,
    /// Thermal diffusivity of the scale, mm²/s.
    pub diffusivity_mm2_per_s: f64,
    /// Since when the flux has been constant, s; a log tells the flux itself.
    pub time_s: Option<f64>,
}

/// The scale or screw of a linear axis.
#[derive(Debug, Clone, PartialEq)]
pub struct Scale {
    /// Its axis in [`crate::Machine::axes`].
    pub axis: usize,
    /// α, 1/K.
    pub expansion_per_k: Measured,
    /// Where it is fixed, and the temperature of the error table of its axis.
    pub anchor: Anchor,
    /// Its sensors; with one it is uniform.
    pub sensors: Vec<Sensor>,
    /// Heat from a bearing or a motor instead.
    pub heated: Option<HeatedPlace>,
}

impl Scale {
    /// The names of its sensors.
    pub(super) fn sensors(&self) -> impl Iterator<Item = &str> + Clone {
        let heated = self.heated.iter().flat_map(|h| [h.near.as_str(), h.far.as_str()]);
        self.sensors.iter().map(|s| s.name.as_str()).chain(heated)
    }

    /// What it adds to the errors of its axis.
    ///
    /// A longer scale carries the *body* too far in its sense of motion: +E for an axis that
    /// carries the tool, −E for one that carries the workpiece (ISO 841), so that a laser reads
    /// +E on both.
    pub(super) fn terms(
        &self,
        axis: &Axis,
        conditions: &Conditions,
        problems: &mut Diagnostics,
    ) -> Vec<ThermalTerm> {
        let body = format!("scale {}", axis.name);
        let Some(celsius) = conditions.of(&body, self.sensors(), problems) else {
            return Vec::new();
        };
        let reach = reach_of(axis.travel);
        let mut terms = Vec::new();
        for component in [Component::X, Component::Y, Component::Z] {
            let along = axis.sense * axis.direction[component as usize];
            if along == 0.0 {
                continue;
            }
            let curve_of = |alpha: f64| match &self.heated {
                None => self.between_sensors(&celsius, along * alpha, reach),
                Some(heated) => self.heated_curve(heated, conditions, along * alpha, reach),
            };
            let (curve, u) = with_u(self.expansion_per_k, curve_of);
            let Some(curve) = curve else {
                let message = format!("{body}: the flux of its heat is not known");
                let hint =
                    "state its `time`, or give a log from the uniform state on, 5000 rows at most";
                problems.error("unknown-flux", conditions.place().clone(), message, hint);
                return Vec::new();
            };
            let (kind, part) = (ErrorKind::Motion, ErrorPart::Scale);
            terms.push(ThermalTerm { kind, component, part, curve, u: u.flatten() });
        }
        terms
    }

    fn between_sensors(&self, celsius: &[f64], alpha: f64, reach: (f64, f64)) -> Option<Curve> {
        let sensors = self.sensors.iter().zip(celsius).map(|(s, c)| (s.place_mm, *c)).collect();
        Some(growth_curve(&Profile::new(sensors)?, alpha, self.anchor, reach))
    }

    fn heated_curve(
        &self,
        heated: &HeatedPlace,
        conditions: &Conditions,
        alpha: f64,
        reach: (f64, f64),
    ) -> Option<Curve> {
        let Anchor { fixed_mm, table_celsius } = self.anchor;
        let place = [heated.place_mm];
        let constant = heated.time_s.map(|time_s| {
            Some(HeatedAt {
                place_mm: heated.place_mm,
                near_celsius: conditions.celsius(&heated.near)?,
                far_celsius: conditions.celsius(&heated.far)?,
                diffusivity_mm2_per_s: heated.diffusivity_mm2_per_s,
                time_s,
            })
        });
        if let (None, Some(field)) = (conditions.history(), constant) {
            let field = field?;
            let rise = |p: f64| field.celsius_at(p) - table_celsius;
            let integral = |p: f64| field.integral(fixed_mm, p, table_celsius);
            return Some(sampled_curve(rise, integral, alpha, &place, field.depth_mm(), reach));
        }
        let (log, now_s) = conditions.history()?;
        let (near, far) = (log.celsius(&heated.near)?, log.celsius(&heated.far)?);
        let rows = log.times_s().partition_point(|t| *t <= now_s);
        if rows > MOST_ROWS {
            return None;
        }
        let rise: Vec<f64> = near.iter().zip(far).map(|(n, f)| n - f).collect();
        let diffusivity_mm2_per_s = heated.diffusivity_mm2_per_s;
        let source = Source::from_rise(
            heated.place_mm,
            diffusivity_mm2_per_s,
            &log.times_s()[..rows],
            &rise[..rows],
        )?;
        let field = ScaleField {
            initial_celsius: conditions.celsius(&heated.far)?,
            diffusivity_mm2_per_s,
            sources: vec![source],
        };
        let depth = field.depth_mm(now_s);
        if depth == 0.0 {
            let profile = Profile::new(vec![(0.0, field.initial_celsius)])?;
            return Some(growth_curve(&profile, alpha, self.anchor, reach));
        }
        let rise = |p: f64| field.celsius_at(p, now_s) - table_celsius;
        let integral = |p: f64| field.integral(now_s, [fixed_mm, p], table_celsius);
        Some(sampled_curve(rise, integral, alpha, &place, depth, reach))
    }
}

/// One error of a body as a linear function of temperatures: a spindle that grows in Z, a column
/// that bends.
///
/// ```text
///     ΔE = Σ cᵢ (Tᵢ − T_ref)                                              docs/model.md eq. 80
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct StructureModel {
    /// Which error; an error motion changes by the same at every position.
    pub index: ErrorIndex,
    /// Its name, for messages.
    pub name: String,
    /// Sensors and coefficients, mm/K or rad/K.
    pub coefficients: Vec<(String, Measured)>,
    /// The temperature at which the stated error holds, °C.
    pub reference_celsius: f64,
}

impl StructureModel {
    pub(super) fn term(
        &self,
        conditions: &Conditions,
        problems: &mut Diagnostics,
    ) -> Option<ThermalTerm> {
        let sensors = self.coefficients.iter().map(|c| c.0.as_str());
        let celsius = conditions.of(&format!("{}(structure)", self.name), sensors, problems)?;
        let rises = celsius.iter().map(|c| c - self.reference_celsius);
        let (mut value, mut variance, mut known) = (0.0, 0.0, false);
        for ((_, c), rise) in self.coefficients.iter().zip(rises) {
            value += c.value * rise;
            known |= c.u.is_some();
            variance += (c.u.unwrap_or(0.0) * rise).powi(2);
        }
        Some(ThermalTerm {
            kind: self.index.kind,
            component: self.index.component,
            part: ErrorPart::Structure,
            curve: Curve::Constant(value),
            u: known.then(|| Curve::Constant(variance.sqrt())),
        })
    }
}
