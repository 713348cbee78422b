//! The residual error of a compensation at a pose, and its uncertainty.
//!
//! ```text
//!     l(q) = pose(q_c, E) − nominal pose(q)                     q_c: the axis positions with the compensation
//!     l̂ = l(E = Ê)        s_j = ½ (l(z_j = +1) − l(z_j = −1))        V = Σ s_j s_jᵀ      docs/model.md eq. 173
//! ```
//!
//! Both are relative to the pose where the instrument was set to zero, if there is one: l̂(q) − l̂(q₀) and
//! s_j(q) − s_j(q₀), so that an error that both poses share adds nothing.

use super::applied::AppliedCompensation;
use super::uncertainties::UncertaintyFactors;
use std::ops::Sub;
use trueaxis_geometry::{Mat3, Vec3};
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{Approach, Command};
use trueaxis_machine::compensate::Fault;
use trueaxis_machine::errors::ErrorValues;

/// A deviation of the tool in the workpiece frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ToolDeviation {
    /// Of the tip, mm.
    pub tip_mm: Vec3,
    /// Of the unit vector of the tool axis.
    pub axis: Vec3,
}

impl ToolDeviation {
    /// The tool at `at` with these errors against the nominal one at `programmed`.
    pub fn of(machine: &Machine, at: &Command, errors: &ErrorValues, programmed: &Command) -> Self {
        let there = machine.deviation(at, errors);
        let wanted = machine.deviation(programmed, &ErrorValues::default());
        let tip = there.nominal_tip.vector() - wanted.nominal_tip.vector();
        let axis = there.nominal_axis.vector() - wanted.nominal_axis.vector();
        Self { tip_mm: tip + there.tip_mm, axis: axis + there.axis }
    }
}

impl Sub for ToolDeviation {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        Self { tip_mm: self.tip_mm - other.tip_mm, axis: self.axis - other.axis }
    }
}

/// The prediction of the identified machine at a pose.
#[derive(Debug, Clone, PartialEq)]
pub struct Residual {
    /// Without the compensation.
    pub before: ToolDeviation,
    /// With it.
    pub after: ToolDeviation,
    /// The effect of one standard uncertainty of each factor of [`UncertaintyFactors`].
    pub slopes: Vec<ToolDeviation>,
}

impl Residual {
    /// At a programmed command.
    ///
    /// # Errors
    /// A pose that cannot be compensated, or at which the errors are not known.
    ///
    /// # Example
    /// ```
    /// use trueaxis::machine::compensate::{Compensator, Scope};
    /// use trueaxis::machine::{Machine, file::NoTables};
    /// use trueaxis::verify::certificate::{applied::AppliedCompensation, uncertainties::UncertaintyFactors, residual::Residual};
    /// let text = "[machine]\nname = \"m\"\nchain = \"w b X Y Z t\"\n[location]\nEC0Y = \"20 ± 3 urad\"";
    /// let mill = Machine::check("m.toml", text, &NoTables).0.unwrap();
    /// let program = AppliedCompensation::Program(Box::new(Compensator::of(&mill, Scope::Pose)?));
    /// let y500 = [0.0, 500.0, 0.0, 0.0, 0.0, 0.0];
    /// let left = Residual::at(&mill, (&UncertaintyFactors::stated(&mill), &program), &y500, &[0.0; 6])?;
    /// // 500 mm · 20 µrad before, nothing after; 500 mm · 3 µrad uncertain.
    /// assert!((left.before.tip_mm.x + 0.010).abs() < 1e-8);
    /// assert!(left.after.tip_mm.norm() < 1e-9);
    /// assert!((left.u_mm().x - 0.0015).abs() < 1e-9);
    /// # Ok::<(), trueaxis::machine::compensate::Fault>(())
    /// ```
    pub fn at(
        machine: &Machine,
        (known, applied): (&UncertaintyFactors, &AppliedCompensation),
        command: &Command,
        approach: &Approach,
    ) -> Result<Self, Fault> {
        let [before, after] = Self::tools(machine, applied, command, approach)?;
        let (at, errors) = applied.go(machine, command, approach)?;
        let here = known.at(machine, &at, approach);
        let slope = |factor| {
            let off =
                |z| ToolDeviation::of(machine, &at, &here.displaced(&errors, factor, z), command);
            let twice = off(1.0) - off(-1.0);
            ToolDeviation { tip_mm: twice.tip_mm * 0.5, axis: twice.axis * 0.5 }
        };
        Ok(Self { before, after, slopes: (0..known.factors()).map(slope).collect() })
    }

    /// The tool alone, without and with the compensation.
    ///
    /// # Errors
    /// As [`Residual::at`].
    pub fn tools(
        machine: &Machine,
        applied: &AppliedCompensation,
        command: &Command,
        approach: &Approach,
    ) -> Result<[ToolDeviation; 2], Fault> {
        let plain = machine.errors_at(command, approach)?;
        let (at, errors) = applied.go(machine, command, approach)?;
        let before = ToolDeviation::of(machine, command, &plain, command);
        Ok([before, ToolDeviation::of(machine, &at, &errors, command)])
    }

    /// The same relative to another pose, where the instrument was set to zero.
    pub fn against(&self, zero: &Self) -> Self {
        Self {
            before: self.before - zero.before,
            after: self.after - zero.after,
            slopes: self.slopes.iter().zip(&zero.slopes).map(|(a, b)| *a - *b).collect(),
        }
    }

    /// V of the tip, mm².
    pub fn covariance_mm2(&self) -> Mat3 {
        self.slopes.iter().map(|s| s.tip_mm * s.tip_mm.transpose()).sum()
    }

    /// One standard uncertainty of each coordinate of the tip, mm.
    pub fn u_mm(&self) -> Vec3 {
        self.covariance_mm2().diagonal().map(f64::sqrt)
    }

    /// The same of the tool axis.
    pub fn u_axis(&self) -> Vec3 {
        let squares: Vec3 = self.slopes.iter().map(|s| s.axis.component_mul(&s.axis)).sum();
        squares.map(f64::sqrt)
    }
}
