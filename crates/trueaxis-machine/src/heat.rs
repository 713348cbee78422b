//! Thermal errors: the effect of temperatures on scales, structure and workpiece.
//!
//! ```text
//!     machine.toml ──> HeatModel (which body expands, by how much, its sensor)
//!     "scale_x=30.5 workpiece=31", CSV log ──> Conditions (the reading of every sensor)
//!     Machine::at(conditions) ──> Machine whose errors contain the thermal parts
//!     WarmingMachine::at(time) ──> the same while the conditions follow a log
//!     ThermalMemory::take(readings) ──> the same while readings come in without end
//! ```
//!
//! A machine without conditions has no thermal part: every body is at the temperature of its
//! error table and the workpiece at 20 °C, the reference temperature of ISO 1.

pub mod conditions;
pub mod expansion;
pub mod field;
mod memory;
mod scale;
mod unknown;
mod warming;
mod workpiece;

pub use conditions::{Conditions, TemperatureLog, check_range};
pub use memory::{MemoryFault, ROW_S, ScaleHeat, ThermalMemory};
pub use scale::{HeatedPlace, HeatedScale, Scale, StructureModel};
pub use unknown::UnknownGrowth;
pub use warming::{TemperatureRun, WarmingMachine};
pub use workpiece::{Settling, Workpiece, WorkpieceGrowth};

use crate::axis::{Command, Travel};
use crate::chain::Machine;
use crate::errors::{Component, Curve, ErrorIndex, ErrorKind, ErrorName, ErrorValues, StatedError};
use field::Source;
use trueaxis_input::Diagnostics;

/// The reference temperature of lengths, ISO 1.
pub const REFERENCE_CELSIUS: f64 = 20.0;

/// A temperature sensor and where along a body it sits.
#[derive(Debug, Clone, PartialEq)]
pub struct Sensor {
    /// Its name in conditions and logs.
    pub name: String,
    /// Its place along the axis, or along the direction of the workpiece, mm.
    pub place_mm: f64,
}

/// Who of a machine grows with temperature.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct HeatModel {
    /// Scales and screws as positioning elements.
    pub scales: Vec<Scale>,
    /// Linear models of single errors.
    pub structure: Vec<StructureModel>,
    /// The workpiece.
    pub workpiece: Option<Workpiece>,
}

impl HeatModel {
    /// The names of all sensors, each once.
    pub fn sensors(&self) -> Vec<&str> {
        let scales = self.scales.iter().flat_map(Scale::sensors);
        let structure = self.structure.iter().flat_map(|s| s.coefficients.iter().map(|c| &*c.0));
        let workpiece = self.workpiece.iter().flat_map(|w| &w.sensors).map(|s| &*s.name);
        let mut names: Vec<&str> = Vec::new();
        for name in scales.chain(structure).chain(workpiece) {
            if !names.contains(&name) {
                names.push(name);
            }
        }
        names
    }
}

/// Which body an error comes from: the split of the total.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum ErrorPart {
    /// Stated in the machine file, at the temperature of its measurement.
    Geometric,
    /// The positioning elements are warmer or colder than then.
    Scale,
    /// The structure is.
    Structure,
    /// The workpiece is not at 20 °C.
    Workpiece,
}

impl ErrorPart {
    /// All four, in the order of reports.
    pub const ALL: [Self; 4] = [Self::Geometric, Self::Scale, Self::Structure, Self::Workpiece];

    /// Its name in reports and JSON.
    pub fn name(self) -> &'static str {
        match self {
            Self::Geometric => "geometric",
            Self::Scale => "scale",
            Self::Structure => "structure",
            Self::Workpiece => "workpiece",
        }
    }
}

/// A thermal part of one error, at conditions.
#[derive(Debug, Clone, PartialEq)]
pub struct ThermalTerm {
    /// Constant or function of position.
    pub kind: ErrorKind,
    /// The direction.
    pub component: Component,
    /// Scale or structure.
    pub part: ErrorPart,
    /// What it adds to the error, mm or rad.
    pub curve: Curve,
    /// What one standard uncertainty of each coefficient in it adds, with its sign.
    pub u: Vec<ThermalUncertainty>,
}

/// What an uncertain coefficient does to a thermal part.
#[derive(Debug, Clone, PartialEq)]
pub struct ThermalUncertainty {
    /// The coefficient, such as `expansion of scale X`; the same name is the same coefficient.
    pub of: String,
    /// What one standard uncertainty of it adds to the error, mm or rad.
    pub curve: Curve,
}

impl ThermalTerm {
    /// What it adds at a position; its curves have a value everywhere.
    pub fn at(&self, q: f64) -> f64 {
        self.curve.at(q).unwrap_or(0.0)
    }

    /// Its standard uncertainty at a position; the coefficients are independent.
    pub fn u_at(&self, q: f64) -> f64 {
        self.u.iter().map(|u| u.at(q)).fold(0.0, f64::hypot)
    }
}

impl ThermalUncertainty {
    /// What one standard uncertainty adds at a position; its curves have a value everywhere.
    pub fn at(&self, q: f64) -> f64 {
        self.curve.at(q).unwrap_or(0.0)
    }
}

/// One error alone, for budgets.
#[derive(Debug, Clone, PartialEq)]
pub struct Share {
    /// `EXX`, `EXX(scale)`, `workpiece`.
    pub name: String,
    /// Where it comes from.
    pub part: ErrorPart,
    /// Only this error.
    pub errors: ErrorValues,
}

impl Machine {
    /// Who of this machine grows with temperature.
    pub fn heat(&self) -> &HeatModel {
        &self.heat
    }

    /// The same machine at temperatures: its errors contain the thermal parts, and its workpiece
    /// is warm, so that every pose, batch, prediction and simulation runs at them.
    ///
    /// ```text
    ///     E(q) = E_table(q) + α ∫_f^q (T(s) − T_table) ds + Σ cᵢ (Tᵢ − T_ref)     docs/model.md eq. 80
    /// ```
    ///
    /// Unknown sensors and bodies of which only some sensors are given are reported; a body without
    /// any given sensor is at the temperature of its table. `None` if there was an error.
    ///
    /// ```
    /// use trueaxis_machine::{Machine, file::NoTables, heat::Conditions};
    /// use trueaxis_input::Diagnostics;
    /// let text = r#"
    ///     machine = { name = "one axis", chain = "w b X Y Z t" }
    ///     [scale.X]
    ///     expansion = "10 um/(m K)"
    ///     table_temperature = "20 degC"
    ///     sensors = { scale_x = "0 mm" }
    /// "#;
    /// let machine = Machine::check("machine.toml", text, &NoTables).0.unwrap();
    /// let mut problems = Diagnostics::new();
    /// let conditions = Conditions::typed("--temperature", "scale_x=25", &mut problems).unwrap();
    /// let warm = machine.at(&conditions, &mut problems).unwrap();
    ///
    /// // 10 µm/(m·K) · 2 m · 5 K = 100 µm
    /// let command = [2000.0, 0.0, 0.0, 0.0, 0.0, 0.0];
    /// let errors = warm.errors_at(&command, &[0.0; 6]).unwrap();
    /// assert!((warm.deviation(&command, &errors).tip_mm.x - 0.1).abs() < 1e-12);
    /// ```
    pub fn at(&self, conditions: &Conditions, problems: &mut Diagnostics) -> Option<Self> {
        let now_s = conditions.history().map_or(0.0, |(_, time_s)| time_s);
        let scales = self.heat.scales.iter();
        let sources: Vec<_> = scales.map(|scale| scale.sources(conditions, now_s)).collect();
        self.heated_by(conditions, &sources, problems)
    }

    /// The same with the heat of each scale known already.
    fn heated_by(
        &self,
        conditions: &Conditions,
        sources: &[Option<Vec<Source>>],
        problems: &mut Diagnostics,
    ) -> Option<Self> {
        let before = problems.iter().count();
        conditions.check_names(&self.heat.sensors(), problems);
        let mut warm = self.without_heat();
        for (scale, sources) in self.heat.scales.iter().zip(sources) {
            let axis = &self.axes[scale.axis];
            let terms = scale.terms(axis, conditions, sources.as_deref(), problems);
            // Axes follow the workpiece in the chain, in their own order.
            warm.bodies[scale.axis + 1].thermal.extend(terms);
        }
        for model in &self.heat.structure {
            let term = model.term(conditions, problems);
            warm.bodies[model.index.body].thermal.extend(term);
        }
        let workpiece = self.heat.workpiece.as_ref();
        warm.growth = workpiece.and_then(|w| w.growth(conditions, problems));
        let sound = problems.iter().skip(before);
        let mut sound = sound.map(|d| d.severity);
        sound.all(|s| s != trueaxis_input::Severity::Error).then_some(warm)
    }

    /// The same machine with every body at the temperature of its table.
    pub fn without_heat(&self) -> Self {
        let mut cold = self.clone();
        cold.growth = None;
        cold.bodies.iter_mut().for_each(|b| b.thermal.clear());
        cold
    }

    /// The same machine with its workpiece at 20 °C.
    pub fn without_growth(&self) -> Self {
        let mut cold = self.clone();
        cold.growth = None;
        cold
    }

    /// How the workpiece has grown, if it is not at 20 °C.
    pub fn growth(&self) -> Option<&WorkpieceGrowth> {
        self.growth.as_ref()
    }

    /// Whether there is a thermal part at all.
    pub fn is_at_temperatures(&self) -> bool {
        self.growth.is_some() || self.bodies.iter().any(|b| !b.thermal.is_empty())
    }

    /// Each error alone, of those that [`Machine::errors_at`] gave at this command.
    pub fn shares(&self, command: &Command, errors: &ErrorValues) -> Vec<Share> {
        let mut shares = Vec::new();
        let mut geometric = *errors;
        for (body, b) in self.bodies.iter().enumerate() {
            let q = b.axis.map_or(0.0, |i| command[i]);
            for term in &b.thermal {
                let index = ErrorIndex { body, kind: term.kind, component: term.component };
                geometric.set(index, geometric.get(index) - term.at(q));
                let mut alone = ErrorValues::default();
                alone.set(index, term.at(q));
                let error = ErrorName { body: b.name, kind: term.kind, component: term.component };
                let name = format!("{error}({})", term.part.name());
                shares.push(Share { name, part: term.part, errors: alone });
            }
        }
        let stated = self.stated_errors().into_iter().map(|(index, name)| Share {
            name: name.to_string(),
            part: ErrorPart::Geometric,
            errors: geometric.only(index),
        });
        let mut all: Vec<Share> = stated.collect();
        all.append(&mut shares);
        if self.growth.is_some() {
            let alone = ErrorValues { workpiece_mm: errors.workpiece_mm, ..Default::default() };
            let name = ErrorPart::Workpiece.name().to_owned();
            all.push(Share { name, part: ErrorPart::Workpiece, errors: alone });
        }
        all
    }

    /// The errors of one part of the split, of those that [`Machine::errors_at`] gave.
    pub fn part(&self, command: &Command, errors: &ErrorValues, part: ErrorPart) -> ErrorValues {
        let mut sum = ErrorValues::default();
        for share in self.shares(command, errors).iter().filter(|s| s.part == part) {
            for index in ErrorIndex::all() {
                sum.set(index, sum.get(index) + share.errors.get(index));
            }
            sum.workpiece_mm += share.errors.workpiece_mm;
        }
        sum
    }
}

/// The two ends between which a curve of an axis must be good, mm.
pub(crate) fn reach_of(travel: Travel) -> (f64, f64) {
    match travel {
        Travel::Between(from, to) => (from, to),
        Travel::Unlimited | Travel::Unknown => (-1e3, 1e3),
    }
}

/// The temperature of the error table of a positioning error, if its measurement states it.
pub(crate) fn measured_celsius(stated: Option<&StatedError>) -> Option<f64> {
    stated.and_then(|s| s.measured.temperature_celsius)
}
