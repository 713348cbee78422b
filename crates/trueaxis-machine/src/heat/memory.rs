//! The heat that has come into heated scales, while time goes on without end: as many numbers after a month as after an hour.
//!
//! ```text
//!     rows (time, readings) ──ThermalMemory::take──> changes of flux ──merged as they age──> ThermalMemory::machine_at
//! ```
//!
//! Each row gives the change of the flux for which the sensors at the heated places read what they read, as eq. 97 of
//! docs/model.md does over a whole log. An old change is moved onto its two neighbours, with the same sum and the same first
//! moment, once they are closer together than a part of their age: docs/model.md eq. 243.

use super::conditions::Conditions;
use super::field::{Source, strength_to_rise};
use super::scale::HeatedScale;
use crate::chain::Machine;
use nalgebra::{DMatrix, DVector};
use trueaxis_input::Diagnostics;

/// Rows that follow sooner are left out: heat takes longer. Unit: s.
pub const ROW_S: f64 = 10.0;
/// A change is merged once its neighbours are apart by this part of their age.
const PART_OF_AGE: f64 = 0.1;
/// A scale whose sensors differ by less is uniform, K.
const UNIFORM_K: f64 = 0.5;

/// Why heat is not known.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum MemoryFault {
    /// It is warm already, and nothing says since when.
    #[error(
        "the scale of {axis} is {rise_k:.1} K warmer at its bearing, and nothing is known of how that came: begin while it is uniform, or state `time` at its heated places"
    )]
    NotUniform {
        /// Its axis.
        axis: String,
        /// How much warmer, K.
        rise_k: f64,
    },
    /// A sensor has no reading.
    #[error("the scale of {axis} needs `{sensor}`")]
    NoReading {
        /// Its axis.
        axis: String,
        /// The sensor.
        sensor: String,
    },
    /// The flux cannot be determined.
    #[error("the heat flux of the scale of {axis} cannot be determined")]
    NoFlux {
        /// Its axis.
        axis: String,
    },
}

/// The heat in one scale.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ScaleHeat {
    /// When the flux has changed, rising. Unit: s.
    pub times_s: Vec<f64>,
    /// By how much, of each heated place, K/mm.
    pub changes_k_per_mm: Vec<Vec<f64>>,
}

/// The heat in all heated scales of a machine.
///
/// ```
/// use trueaxis_input::Diagnostics;
/// use trueaxis_machine::{Machine, file::NoTables, heat::{Conditions, ThermalMemory}};
/// let text = r#"
///     machine = { name = "one axis", chain = "w b X Y Z t" }
///     axis.X = { travel = ["0 mm", "2000 mm"] }
///     [scale.X]
///     expansion = "10 um/(m K)"
///     table_temperature = "20 degC"
///     heated = { at = "0 mm", near = "bearing", far = "scale", diffusivity = "4 mm^2/s" }
/// "#;
/// let machine = Machine::check("machine.toml", text, &NoTables).0.unwrap();
/// let mut memory = ThermalMemory::default();
/// // Constant flux for 900 s reaches √(4·4·900) = 120 mm deep.
/// for time_s in [0.0, 900.0] {
///     let bearing = if time_s > 0.0 { 28.0 } else { 20.0 };
///     memory.take(&machine, time_s, &|sensor| Some(if sensor == "bearing" { bearing } else { 20.0 })).unwrap();
/// }
/// let now = Conditions::default().with_reading("bearing", 28.0).with_reading("scale", 20.0);
/// let warm = memory.machine_at(&machine, &now, 900.0, &mut Diagnostics::new()).unwrap();
/// let command = [2000.0, 0.0, 0.0, 0.0, 0.0, 0.0];
/// let errors = warm.errors_at(&command, &[0.0; 6]).unwrap();
/// // 8 K/ierfc 0 · 120 mm · i²erfc 0 = 240·√π mm·K, times 10⁻⁵/K: 4.254 µm
/// assert!((warm.deviation(&command, &errors).tip_mm.x - 4.254e-3).abs() < 1e-6);
/// ```
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ThermalMemory {
    /// Of each scale of [`super::HeatModel::scales`]; empty for one that no bearing heats.
    pub scales: Vec<ScaleHeat>,
    /// The last row. Unit: s.
    pub last_s: Option<f64>,
}

impl ThermalMemory {
    /// Whether a machine has a scale that needs it.
    pub fn is_needed(machine: &Machine) -> bool {
        machine.heat().scales.iter().any(|scale| scale.heated.is_some())
    }

    /// Whether it can be that of a machine: as many scales, places and changes.
    pub fn fits(&self, machine: &Machine) -> bool {
        let scales = &machine.heat().scales;
        let same = self.scales.iter().zip(scales).all(|(heat, scale)| {
            let places = scale.heated.as_ref().map_or(0, |heated| heated.places.len());
            let whole = |changes: &Vec<f64>| changes.len() == heat.times_s.len();
            let rises = heat.times_s.windows(2).all(|w| w[0] < w[1]);
            heat.changes_k_per_mm.len() == places
                && heat.changes_k_per_mm.iter().all(whole)
                && rises
        });
        let finite = |heat: &ScaleHeat| {
            let all = heat.times_s.iter().chain(heat.changes_k_per_mm.iter().flatten());
            all.into_iter().all(|v| v.is_finite())
        };
        self.scales.len() == scales.len() && same && self.scales.iter().all(finite)
    }

    /// The same on another clock: what was at 0 is at `by_s`.
    #[must_use]
    pub fn shifted(mut self, by_s: f64) -> Self {
        self.last_s = self.last_s.map(|last_s| last_s + by_s);
        for heat in &mut self.scales {
            heat.times_s.iter_mut().for_each(|t| *t += by_s);
        }
        self
    }

    /// Takes the readings of a time, °C; a row sooner than [`ROW_S`] after the last one is left out. Between two rows the flux
    /// counts as constant, however far they are apart.
    ///
    /// # Errors
    /// [`MemoryFault`]; nothing is taken then.
    pub fn take(
        &mut self,
        machine: &Machine,
        now_s: f64,
        celsius: &dyn Fn(&str) -> Option<f64>,
    ) -> Result<(), MemoryFault> {
        if self.last_s.is_some_and(|last_s| now_s - last_s < ROW_S) {
            return Ok(());
        }
        let mut scales = self.scales.clone();
        scales.resize(machine.heat().scales.len(), ScaleHeat::default());
        for (heat, scale) in scales.iter_mut().zip(&machine.heat().scales) {
            let Some(heated) = &scale.heated else { continue };
            heat.changes_k_per_mm.resize(heated.places.len(), Vec::new());
            if scale.sensors().all(|sensor| celsius(sensor).is_none()) {
                // At the temperature of its table, as in a machine at readings.
                continue;
            }
            let axis = || machine.axes()[scale.axis].name.to_string();
            let read = |sensor: &String| {
                let lost = || MemoryFault::NoReading { axis: axis(), sensor: sensor.clone() };
                celsius(sensor).ok_or_else(lost)
            };
            let far = read(&heated.far)?;
            let near =
                heated.places.iter().map(|p| read(&p.near)).collect::<Result<Vec<_>, _>>()?;
            let rises_k: Vec<f64> = near.iter().map(|near| near - far).collect();
            match self.last_s {
                None => heat.begin(heated, now_s, &rises_k, &axis)?,
                Some(last_s) => {
                    let found = heat.add(heated, [last_s, now_s], &rises_k);
                    found.ok_or_else(|| MemoryFault::NoFlux { axis: axis() })?;
                }
            }
        }
        (self.scales, self.last_s) = (scales, Some(now_s));
        Ok(())
    }

    /// The machine at readings of now, with this heat in its scales; as [`Machine::at`].
    pub fn machine_at(
        &self,
        machine: &Machine,
        conditions: &Conditions,
        now_s: f64,
        problems: &mut Diagnostics,
    ) -> Option<Machine> {
        let scales = machine.heat().scales.iter().enumerate();
        let sources: Vec<Option<Vec<Source>>> = scales
            .map(|(i, scale)| {
                let (heated, heat) = (scale.heated.as_ref()?, self.scales.get(i)?);
                Some(heat.sources(heated, now_s))
            })
            .collect();
        machine.heated_by(conditions, &sources, problems)
    }

    /// How many numbers it keeps.
    pub fn size(&self) -> usize {
        self.scales.iter().map(|heat| heat.times_s.len() * (1 + heat.changes_k_per_mm.len())).sum()
    }
}

impl ScaleHeat {
    /// Uniform, or with a constant flux since a stated time.
    fn begin(
        &mut self,
        heated: &HeatedScale,
        now_s: f64,
        rises_k: &[f64],
        axis: &dyn Fn() -> String,
    ) -> Result<(), MemoryFault> {
        let most = rises_k
            .iter()
            .fold(0.0_f64, |most, rise| if rise.abs() > most.abs() { *rise } else { most });
        if most.abs() <= UNIFORM_K {
            return Ok(());
        }
        let ages = heated.places.iter().map(|p| p.time_s).collect::<Option<Vec<f64>>>();
        let ages_s = ages.ok_or_else(|| MemoryFault::NotUniform { axis: axis(), rise_k: most })?;
        let (places, diffusivity) = (heated.places_mm(), heated.diffusivity_mm2_per_s);
        let sources = Source::constant(&places, diffusivity, &ages_s, rises_k);
        let sources = sources.ok_or_else(|| MemoryFault::NoFlux { axis: axis() })?;
        let mut since: Vec<(f64, usize, f64)> = Vec::new();
        for (place, source) in sources.iter().enumerate() {
            since.extend(source.steps.iter().map(|(t, g)| (now_s + t, place, *g)));
        }
        since.sort_by(|a, b| a.0.total_cmp(&b.0));
        for (time_s, place, change) in since {
            if self.times_s.last() != Some(&time_s) {
                self.times_s.push(time_s);
                self.changes_k_per_mm.iter_mut().for_each(|changes| changes.push(0.0));
            }
            if let Some(last) = self.changes_k_per_mm[place].last_mut() {
                *last += change;
            }
        }
        Ok(())
    }

    /// The change at the last row for which the rises of now are right; none where there is no such change.
    fn add(
        &mut self,
        heated: &HeatedScale,
        [last_s, now_s]: [f64; 2],
        rises_k: &[f64],
    ) -> Option<()> {
        let (places, diffusivity) = (heated.places_mm(), heated.diffusivity_mm2_per_s);
        let shape = |i: usize, j: usize, age_s: f64| {
            strength_to_rise(places[i] - places[j], diffusivity, age_s)
        };
        let count = places.len();
        let missing = DVector::from_fn(count, |i, _| {
            let past = self.changes_k_per_mm.iter().enumerate().map(|(j, changes)| {
                let all = self.times_s.iter().zip(changes);
                all.map(|(t, g)| g * shape(i, j, now_s - t)).sum::<f64>()
            });
            rises_k[i] - past.sum::<f64>()
        });
        let coupling = DMatrix::from_fn(count, count, |i, j| shape(i, j, now_s - last_s));
        let found = coupling.lu().solve(&missing).filter(|f| f.iter().all(|g| g.is_finite()))?;
        self.times_s.push(last_s);
        for (changes, g) in self.changes_k_per_mm.iter_mut().zip(found.iter()) {
            changes.push(*g);
        }
        self.merge(now_s);
        Some(())
    }

    /// Moves old changes onto their neighbours.
    ///
    /// ```text
    ///     g at t between t₀ and t₁:  g (t₁ − t)/(t₁ − t₀) to t₀,  g (t − t₀)/(t₁ − t₀) to t₁     docs/model.md eq. 243
    /// ```
    fn merge(&mut self, now_s: f64) {
        let mut k = 1;
        while k + 1 < self.times_s.len() {
            let [before, at, after] = [self.times_s[k - 1], self.times_s[k], self.times_s[k + 1]];
            if after - before > PART_OF_AGE * (now_s - after) {
                k += 1;
                continue;
            }
            let later = (at - before) / (after - before);
            self.times_s.remove(k);
            for changes in &mut self.changes_k_per_mm {
                let g = changes.remove(k);
                changes[k - 1] += g * (1.0 - later);
                changes[k] += g * later;
            }
        }
    }

    /// As sources on a clock that is 0 now.
    fn sources(&self, heated: &HeatedScale, now_s: f64) -> Vec<Source> {
        let places = heated.places.iter().zip(&self.changes_k_per_mm);
        let source = |(place, changes): (&super::HeatedPlace, &Vec<f64>)| {
            let mut strength = 0.0;
            let steps = self.times_s.iter().zip(changes).map(|(t, g)| {
                strength += g;
                (t - now_s, strength)
            });
            Source { place_mm: place.place_mm, steps: steps.collect() }
        };
        places.map(source).collect()
    }
}
