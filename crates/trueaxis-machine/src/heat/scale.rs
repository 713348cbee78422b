//! Scales and screws as positioning elements, and linear models of single errors.

use super::conditions::{Conditions, TemperatureLog};
use super::expansion::{Anchor, Profile, growth_curve, sampled_curve};
use super::field::{ScaleField, Source};
use super::{ErrorPart, Sensor, ThermalTerm, ThermalUncertainty, reach_of};
use crate::axis::Axis;
use crate::errors::{Component, Curve, ErrorIndex, ErrorKind};
use trueaxis_input::{Diagnostics, MeasuredValue};

/// The work for a changing flux grows with the square of the rows of its log.
const MOST_ROWS: usize = 5000;

/// One place where heat comes into a scale.
#[derive(Debug, Clone, PartialEq)]
pub struct HeatedPlace {
    /// Where, mm.
    pub place_mm: f64,
    /// The sensor there.
    pub near: String,
    /// Duration of constant flux, s; not needed with a log, from which the flux is determined.
    pub time_s: Option<f64>,
}

/// A scale heated at some places, by bearings or motors, and uniform otherwise; the temperature
/// fields of the places are superposed.
#[derive(Debug, Clone, PartialEq)]
pub struct HeatedScale {
    /// The heated places, all different.
    pub places: Vec<HeatedPlace>,
    /// The name of a sensor that the heat does not reach.
    pub far: String,
    /// Thermal diffusivity of the scale, mm²/s.
    pub diffusivity_mm2_per_s: f64,
}

impl HeatedScale {
    pub(super) fn places_mm(&self) -> Vec<f64> {
        self.places.iter().map(|p| p.place_mm).collect()
    }

    /// The heat sources for typed temperatures: constant, at time 0.
    fn constant_sources(&self, conditions: &Conditions) -> Option<Vec<Source>> {
        let far = conditions.celsius(&self.far)?;
        let rise = |p: &HeatedPlace| Some(conditions.celsius(&p.near)? - far);
        let ages_s = self.places.iter().map(|p| p.time_s).collect::<Option<Vec<f64>>>()?;
        let rises_k = self.places.iter().map(rise).collect::<Option<Vec<f64>>>()?;
        Source::constant(&self.places_mm(), self.diffusivity_mm2_per_s, &ages_s, &rises_k)
    }

    /// The heat that enters over the rows of a log up to the first one at or after `until_s`; the
    /// first row is the uniform state.
    fn logged_sources(&self, log: &TemperatureLog, until_s: f64) -> Option<Vec<Source>> {
        let rows = log.times_s().partition_point(|t| *t < until_s) + 1;
        let rows = rows.min(log.times_s().len());
        if rows > MOST_ROWS {
            return None;
        }
        let far = log.celsius(&self.far)?;
        let rise = |p: &HeatedPlace| {
            let near = log.celsius(&p.near)?;
            Some(near[..rows].iter().zip(far).map(|(n, f)| n - f).collect())
        };
        let rises_k = self.places.iter().map(rise).collect::<Option<Vec<Vec<f64>>>>()?;
        let times_s = &log.times_s()[..rows];
        Source::from_rises(&self.places_mm(), self.diffusivity_mm2_per_s, times_s, &rises_k)
    }
}

/// The scale or screw of a linear axis.
#[derive(Debug, Clone, PartialEq)]
pub struct Scale {
    /// Its axis in [`crate::Machine::axes`].
    pub axis: usize,
    /// α, 1/K.
    pub expansion_per_k: MeasuredValue,
    /// Where it is fixed, and the temperature of the error table of its axis.
    pub anchor: Anchor,
    /// Its sensors; with one it is uniform.
    pub sensors: Vec<Sensor>,
    /// Heat from bearings or motors instead.
    pub heated: Option<HeatedScale>,
}

impl Scale {
    /// The names of its sensors, each once.
    pub fn sensors(&self) -> impl Iterator<Item = &str> + Clone {
        let near = self.heated.iter().flat_map(|h| h.places.iter().map(|p| p.near.as_str()));
        let far = self.heated.iter().map(|h| h.far.as_str());
        self.sensors.iter().map(|s| s.name.as_str()).chain(near).chain(far)
    }

    /// The heat that comes into it: over the log of the conditions up to a time, or constant.
    pub(super) fn sources(&self, conditions: &Conditions, until_s: f64) -> Option<Vec<Source>> {
        let heated = self.heated.as_ref()?;
        match conditions.history() {
            Some((log, _)) => heated.logged_sources(log, until_s),
            None => heated.constant_sources(conditions),
        }
    }

    /// Upper bound of its rate of expansion at a time, mm/s.
    ///
    /// ```text
    ///     dE/dt = α Σ 2 a |g|                                              docs/model.md eq. 98
    /// ```
    pub(super) fn growth_mm_per_s(&self, sources: &[Source], time_s: f64) -> f64 {
        let diffusivity = self.heated.as_ref().map_or(0.0, |h| h.diffusivity_mm2_per_s);
        let strengths = sources.iter().map(|s| s.strength_at(time_s).abs()).sum::<f64>();
        self.expansion_per_k.value.abs() * 2.0 * diffusivity * strengths
    }

    /// What it adds to the errors of its axis; `sources` as from [`Scale::sources`].
    ///
    /// A longer scale carries the *body* too far in its sense of motion: +E for an axis that
    /// carries the tool, −E for one that carries the workpiece (ISO 841), so that a laser reads
    /// +E on both.
    pub(super) fn terms(
        &self,
        axis: &Axis,
        conditions: &Conditions,
        sources: Option<&[Source]>,
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
                Some(heated) => {
                    self.heated_curve(heated, conditions, sources?, along * alpha, reach)
                }
            };
            let Some(curve) = curve_of(self.expansion_per_k.value) else {
                let message = format!("{body}: the heat flux cannot be determined");
                let hint = "state the `time` of each heated place, or give a log of at most 5000 \
                    rows that begins in the uniform state";
                problems.error("unknown-flux", conditions.place().clone(), message, hint);
                return Vec::new();
            };
            let u = self.expansion_per_k.u.and_then(curve_of);
            let u = u.map(|curve| ThermalUncertainty { of: format!("expansion of {body}"), curve });
            let (kind, part) = (ErrorKind::Motion, ErrorPart::Scale);
            terms.push(ThermalTerm { kind, component, part, curve, u: u.into_iter().collect() });
        }
        terms
    }

    fn between_sensors(&self, celsius: &[f64], alpha: f64, reach: (f64, f64)) -> Option<Curve> {
        let sensors = self.sensors.iter().zip(celsius).map(|(s, c)| (s.place_mm, *c)).collect();
        Some(growth_curve(&Profile::new(sensors)?, alpha, self.anchor, reach))
    }

    fn heated_curve(
        &self,
        heated: &HeatedScale,
        conditions: &Conditions,
        sources: &[Source],
        alpha: f64,
        reach: (f64, f64),
    ) -> Option<Curve> {
        let Anchor { fixed_mm, table_celsius } = self.anchor;
        let now_s = conditions.history().map_or(0.0, |(_, time_s)| time_s);
        let field = ScaleField {
            initial_celsius: conditions.celsius(&heated.far)?,
            diffusivity_mm2_per_s: heated.diffusivity_mm2_per_s,
            sources: sources.to_vec(),
        };
        let depth_mm = field.depth_mm(now_s);
        if depth_mm == 0.0 {
            let profile = Profile::new(vec![(0.0, field.initial_celsius)])?;
            return Some(growth_curve(&profile, alpha, self.anchor, reach));
        }
        let rise = |p: f64| field.celsius_at(p, now_s) - table_celsius;
        let integral = |p: f64| field.integral(now_s, [fixed_mm, p], table_celsius);
        Some(sampled_curve(rise, integral, alpha, &heated.places_mm(), depth_mm, reach))
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
    pub coefficients: Vec<(String, MeasuredValue)>,
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
        let (mut value, mut u) = (0.0, Vec::new());
        for ((sensor, c), rise) in self.coefficients.iter().zip(rises) {
            value += c.value * rise;
            let of = || format!("{} per K of {sensor}", self.name);
            u.extend(
                c.u.map(|u| ThermalUncertainty { of: of(), curve: Curve::Constant(u * rise) }),
            );
        }
        Some(ThermalTerm {
            kind: self.index.kind,
            component: self.index.component,
            part: ErrorPart::Structure,
            curve: Curve::Constant(value),
            u,
        })
    }
}
