//! What every machine of a study makes: test pieces, holes, parts.
//!
//! ```text
//! Case ──at a state──> Prepared: commands, errors ──factors of the quantities──> indices
//! ```

use crate::inputs::{Input, influence_name};
use trueaxis::geometry::Vec3;
use trueaxis::geometry::frame::Pose;
use trueaxis::input::Diagnostics;
use trueaxis::machine::Machine;
use trueaxis::machine::axis::AxisKind;
use trueaxis::machine::errors::{BodyName, StatedError, Uncertainty};
use trueaxis::machine::heat::Conditions;
use trueaxis::predict::drawing::{LinearPart, PartStudy};
use trueaxis::predict::holes::{CommandedHoles, HoleStudy};
use trueaxis::predict::{Bench, Cutting, Judge, Setting, Study};

/// What is made.
pub enum Product {
    /// A test piece.
    Piece(Box<Study>),
    /// Holes on a circle.
    Holes(Box<HoleStudy>),
    /// A part of any shape; its surface follows the errors to first order.
    Part(Box<(PartStudy, LinearPart)>),
}

/// One thing that every machine makes.
pub struct Case {
    /// Its name in the study.
    pub name: String,
    /// Its study file.
    pub file: String,
    /// What it is.
    pub product: Product,
    /// Its machine as in its study, without the inputs: that is what a control compensates.
    pub known: Machine,
    /// Which input moves each uncertain quantity of its machine, at any temperatures of the sensors that are varied.
    pub input_of: Vec<Option<usize>>,
    /// What is found of it.
    pub outputs: Vec<Output>,
}

/// A number that a study finds of every sample.
#[derive(Debug, Clone, PartialEq)]
pub struct Output {
    /// Its key, with its unit.
    pub key: String,
    /// In words.
    pub title: String,
    /// The least value allowed, mm.
    pub low_mm: Option<f64>,
    /// The largest value allowed, mm.
    pub high_mm: Option<f64>,
    /// Its place among the values of the case.
    pub(crate) at: usize,
}

impl Output {
    /// Whether a value is allowed; where nothing is stated, it is.
    pub fn allows(&self, value_mm: f64) -> bool {
        self.low_mm.is_none_or(|low| low <= value_mm)
            && self.high_mm.is_none_or(|high| value_mm <= high)
    }

    /// Whether it has a limit.
    pub fn is_judged(&self) -> bool {
        self.low_mm.is_some() || self.high_mm.is_some()
    }
}

/// What holds while a sample is made, besides errors; the default is what the study of the case says.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct State {
    /// What sensors say.
    pub conditions: Option<Conditions>,
    /// Where the workpiece stands, beside its place, mm.
    pub workpiece_mm: Vec3,
    /// Rotary axes while the zero is touched, rad.
    pub setting_rad: Vec<(BodyName, f64)>,
    /// Of the tool.
    pub tool_length_mm: Option<f64>,
}

/// A case at a state, ready for any errors.
pub struct Prepared<'a> {
    case: &'a Case,
    ready: Ready<'a>,
    bench: Bench,
    surface: Vec<f64>,
    values: Vec<f64>,
    factors: Vec<f64>,
}

enum Ready<'a> {
    Piece(Box<Cutting<'a>>, &'a Study),
    Holes(CommandedHoles<'a>),
    Part(&'a LinearPart),
}

impl Case {
    /// Its machine, with the inputs in it.
    pub fn machine(&self) -> &Machine {
        match &self.product {
            Product::Piece(study) => &study.machine,
            Product::Holes(study) => &study.machine,
            Product::Part(part) => &part.0.mounted,
        }
    }

    /// Its machine at a state.
    ///
    /// # Errors
    /// In words: sensors that the machine does not have, a tool without length.
    pub fn machine_at(&self, state: &State) -> Result<Machine, String> {
        at(self.machine(), state)
    }

    /// The machine that its control knows at a state.
    fn known_at(&self, state: &State) -> Result<Machine, String> {
        at(&self.known, state)
    }

    /// The case ready to be made by `machine`, its own or the same at a state.
    ///
    /// # Errors
    /// In words: a path that this machine cannot follow at this state.
    pub fn prepare<'a>(
        &'a self,
        machine: &'a Machine,
        state: &State,
    ) -> Result<Prepared<'a>, String> {
        let ready = match &self.product {
            Product::Piece(study) => {
                let mut reference = study.reference.clone();
                for (axis, angle_rad) in &state.setting_rad {
                    let rotary_axis = machine.axis_index(*axis);
                    let rotary_axis =
                        rotary_axis.filter(|i| machine.axes()[*i].kind == AxisKind::Rotary);
                    let Some(index) = rotary_axis else {
                        return Err(format!("the machine has no rotary axis {axis}"));
                    };
                    if let Setting::Touched { rotary } = &mut reference.setting {
                        rotary[index] = *angle_rad;
                    }
                }
                let (log, program) = (study.temperatures.as_ref(), study.program.as_ref());
                let cutting = Cutting::along(machine, study.piece(), &reference, log, program);
                Ready::Piece(Box::new(cutting.map_err(|e| e.to_string())?), study)
            }
            Product::Holes(study) => {
                let known = self.known_at(state)?;
                Ready::Holes(CommandedHoles::new(study, &known, machine)?)
            }
            Product::Part(part) => Ready::Part(&part.1),
        };
        let factors = vec![0.0; self.input_of.len()];
        let values = match &self.product {
            Product::Piece(study) => vec![0.0; study.piece().index_names().len()],
            _ => Vec::new(),
        };
        Ok(Prepared {
            case: self,
            ready,
            bench: Bench::default(),
            surface: Vec::new(),
            values,
            factors,
        })
    }
}

/// A machine at a state.
fn at(machine: &Machine, state: &State) -> Result<Machine, String> {
    let mut machine = machine.clone();
    if let Some(conditions) = &state.conditions {
        let mut problems = Diagnostics::new();
        let warm = machine.at(conditions, &mut problems);
        let first = problems.iter().map(|d| d.message.clone()).next();
        machine = warm.ok_or_else(|| first.unwrap_or_default())?;
        if machine.unknown_growth(conditions).is_some() {
            return Err("the workpiece grows, and none of its temperatures is given".to_owned());
        }
    }
    if state.workpiece_mm != Vec3::zeros() {
        let body = &machine.bodies()[0];
        let (placement, mounting) = (body.placement, body.mounting);
        machine = machine.with_workpiece(Pose::shift(state.workpiece_mm) * placement, mounting);
    }
    if let Some(length_mm) = state.tool_length_mm {
        if length_mm < 0.0 {
            return Err(format!("{length_mm} mm is no length of a tool"));
        }
        machine = machine.with_tip(Vec3::new(0.0, 0.0, -length_mm));
    }
    Ok(machine)
}

impl Prepared<'_> {
    /// The outputs of a sample.
    ///
    /// # Errors
    /// In words: points that cannot be evaluated.
    pub fn outputs(
        &mut self,
        inputs: &[Input],
        drawn: &[f64],
        out: &mut [f64],
    ) -> Result<(), String> {
        for (factor, input) in self.factors.iter_mut().zip(&self.case.input_of) {
            *factor = input.map_or(0.0, |i| inputs[i].factor(drawn[i]));
        }
        let factors = &self.factors;
        match &self.ready {
            Ready::Piece(cutting, study) => {
                let judge = Judge { cutting, piece: study.piece() };
                judge
                    .indices(
                        &|errors, u| u.displaced(errors, factors),
                        &mut self.bench,
                        &mut self.values,
                    )
                    .map_err(|e| e.to_string())?;
            }
            Ready::Holes(holes) => {
                let found = holes.of_machine(factors);
                self.values.clear();
                self.values.push(found.worst_mm);
                self.values.extend(found.diameter_mm);
            }
            Ready::Part(part) => self.values = part.values_mm(factors, &mut self.surface)?,
        }
        for (out, output) in out.iter_mut().zip(&self.case.outputs) {
            *out = self.values[output.at];
        }
        Ok(())
    }
}

/// The uncertain quantities of a machine that have a stated uncertainty of their own, each with the body that it
/// belongs to, if it is an error.
pub fn stated_quantities(machine: &Machine) -> Vec<(String, Option<BodyName>)> {
    let errors = machine.stated_errors();
    let is_known = |stated: &StatedError| match &stated.u {
        None => false,
        Some(Uncertainty::Constant(u)) => *u > 0.0,
        Some(Uncertainty::Table(_)) => true,
    };
    let own = errors.iter().filter(|(index, name)| {
        let stated = machine.bodies()[index.body].stated(name.kind, name.component);
        let joint = machine.joint().is_some_and(|joint| joint.has(*index));
        stated.is_some_and(is_known) && !joint
    });
    let mut all: Vec<_> = own.map(|(_, name)| (name.to_string(), Some(name.body))).collect();
    let others = machine.uncertain_quantities().into_iter().skip(errors.len());
    all.extend(
        others.filter(|name| !name.starts_with(&influence_name(""))).map(|name| (name, None)),
    );
    all
}
