//! Does the machine agree with its file, have its errors changed, is a compensation valid?

use super::{Answer, Question, Tell, with_diagnostics};
use crate::report::{self, CalibrationsReport};
use crate::verify::calibrations::{Calibrations, TwoTemperatures, calibrations};
use crate::verify::certificate::{Certificate, PoseFault, Study, certify, read_certificate};
use crate::verify::compare::{
    Comparison, ComparisonResult, LEAST_REDUNDANCY, compare, read_comparison,
};
use serde_json::Value;
use std::path::{Path, PathBuf};
use trueaxis_input::{Date, Diagnostics, Files, Place};
use trueaxis_machine::Machine;
use trueaxis_machine::errors::ErrorName;
use trueaxis_part::tolerance::Outcome;
use trueaxis_report::Report;

fn whole(path: &Path) -> Place {
    Place::whole(&path.display().to_string())
}

/// Readings against what a machine file predicts, or against other readings.
#[derive(Debug, Clone, Default)]
pub struct VerifyReadings {
    /// What is compared with what, and how it is decided.
    pub file: PathBuf,
}

/// A comparison with its result.
#[derive(Debug)]
pub struct VerifyAnswer {
    task: Comparison,
    verified: ComparisonResult,
}

impl Question for VerifyReadings {
    type Input = Comparison;
    type Answer = VerifyAnswer;

    fn read(&self, files: &Files, problems: &mut Diagnostics) -> Option<Comparison> {
        problems.keep(read_comparison(files, &self.file))
    }

    fn answer(
        &self,
        task: Comparison,
        _: Tell<'_>,
        problems: &mut Diagnostics,
    ) -> Option<VerifyAnswer> {
        match compare(&task) {
            Ok(verified) => {
                if verified.redundancy < LEAST_REDUNDANCY {
                    let message = format!(
                        "{} numbers cannot carry the set-up of the instruments, which is fitted to them, and a comparison",
                        verified.deviations.len()
                    );
                    let hint =
                        "they agree with any machine: measure at more poses, or state the set-up";
                    problems.warn("too-few-readings", whole(&self.file), message, hint);
                }
                Some(VerifyAnswer { task, verified })
            }
            Err(error) => {
                let hint =
                    "do the readings belong to this campaign: columns, units, order of channels?";
                problems.error("cannot-compare", whole(&self.file), error.to_string(), hint);
                None
            }
        }
    }
}

impl Answer for VerifyAnswer {
    fn document(&self, problems: &Diagnostics) -> Value {
        with_diagnostics(&report::VerifyDocument::of(&self.task, &self.verified), problems)
    }

    fn report(&self) -> Report<'_> {
        report::comparison_report(&self.task, &self.verified)
    }

    fn is_yes(&self) -> bool {
        self.verified.outcome == Outcome::Pass
    }
}

/// Two calibrations of one machine: significant changes.
#[derive(Debug, Clone, Default)]
pub struct CompareCalibrations {
    /// The older machine file.
    pub old: PathBuf,
    /// The newer one.
    pub new: PathBuf,
}

/// Two calibrations with what moved between them.
#[derive(Debug)]
pub struct CalibrationsAnswer {
    new: Machine,
    names: [String; 2],
    found: Calibrations,
}

impl CalibrationsAnswer {
    fn shown(&self) -> CalibrationsReport<'_> {
        let [old, new] = &self.names;
        CalibrationsReport {
            old: &self.found.older,
            new: &self.new,
            files: [old, new],
            found: &self.found,
        }
    }
}

impl CompareCalibrations {
    /// What may not be two calibrations of one machine in their order, or not of the same state of its control.
    fn doubts(&self, [old, new]: [&Machine; 2], problems: &mut Diagnostics) {
        let place = || whole(&self.new);
        let older = self.old.display();
        if old.name() != new.name() {
            let message =
                format!("the machine is `{}`, that of {older} is `{}`", new.name(), old.name());
            let hint = "two calibrations are those of one machine: is it the right file? then give it one name";
            problems.warn("other-machine", place(), message, hint);
        }
        if let Some((name, [first, second])) = wrong_order(old, new) {
            let message = format!("{name} is of {second} here, and of {first}, later, in {older}");
            let hint = "name the older file first; or is one of the dates wrong?";
            problems.warn("date-order", place(), message, hint);
        }
        let active = [old, new].map(Machine::active_compensation);
        let alone = |a: usize, b: usize| {
            let names = active[a].iter().filter(|name| !active[b].contains(name));
            names.map(ToString::to_string).collect::<Vec<_>>()
        };
        let alone: Vec<String> = alone(0, 1).into_iter().chain(alone(1, 0)).collect();
        if !alone.is_empty() {
            let message = format!(
                "the control compensates {} in one of the files alone: what is compared is the errors that the files state, \
                 not the tool as it runs",
                alone.join(" ")
            );
            let hint = "were both measured with the same tables switched on, or off?";
            problems.note("already-active", place(), message, hint);
        }
    }
}

/// The first error that is of a later day in the older file, with both days as they are written.
fn wrong_order(old: &Machine, new: &Machine) -> Option<(ErrorName, [String; 2])> {
    let day = |machine: &Machine, name: ErrorName| {
        let index = machine.error_index(name)?;
        let stated = machine.bodies()[index.body].stated(index.kind, index.component)?;
        stated.measured.date.clone()
    };
    let mut names = old.stated_errors().into_iter().map(|(_, name)| name);
    names.find_map(|name| {
        let days = [day(old, name)?, day(new, name)?];
        let [first, second] = [Date::parse(&days[0])?, Date::parse(&days[1])?];
        (first > second).then_some((name, days))
    })
}

impl Question for CompareCalibrations {
    type Input = [Machine; 2];
    type Answer = CalibrationsAnswer;

    fn read(&self, files: &Files, problems: &mut Diagnostics) -> Option<[Machine; 2]> {
        let mut read = |path| problems.keep(Machine::read(files, path));
        let (old, new) = (read(&self.old), read(&self.new));
        Some([old?, new?])
    }

    fn answer(
        &self,
        [old, new]: [Machine; 2],
        _: Tell<'_>,
        problems: &mut Diagnostics,
    ) -> Option<CalibrationsAnswer> {
        let names = [&self.old, &self.new].map(|path| path.display().to_string());
        self.doubts([&old, &new], problems);
        match calibrations(&old, &new) {
            Ok(found) => {
                for two in found.temperatures.iter().filter(|two| two.expansion_per_k.is_none()) {
                    let TwoTemperatures { error, old_celsius, new_celsius, .. } = two;
                    let message = format!(
                        "the tables of {error} hold at {old_celsius} °C and {new_celsius} °C, and are compared as they are"
                    );
                    let hint =
                        "[scale.X] expansion = \"10.8 um/(m K)\" refers them to one temperature";
                    problems.note("two-temperatures", whole(&self.new), message, hint);
                }
                Some(CalibrationsAnswer { new, names, found })
            }
            Err(reason) => {
                let hint = "name two machine files of one machine, the older first";
                problems.error("other-machine", whole(&self.new), reason, hint);
                None
            }
        }
    }
}

impl Answer for CalibrationsAnswer {
    fn document(&self, problems: &Diagnostics) -> Value {
        with_diagnostics(&report::DiffDocument::from(&self.shown()), problems)
    }

    fn report(&self) -> Report<'_> {
        report::calibrations_report(&self.shown())
    }

    fn is_yes(&self) -> bool {
        self.found.moved().next().is_none()
    }
}

/// The residual errors of a compensation at poses that the identification has not used.
#[derive(Debug, Clone, Default)]
pub struct Certify {
    /// The study: machine, poses, limit.
    pub study: PathBuf,
}

/// A study with its certificate.
pub struct CertificateAnswer {
    study: Study,
    certificate: Certificate,
}

impl Question for Certify {
    type Input = Study;
    type Answer = CertificateAnswer;

    fn read(&self, files: &Files, problems: &mut Diagnostics) -> Option<Study> {
        problems.keep(read_certificate(files, &self.study))
    }

    fn answer(
        &self,
        study: Study,
        _: Tell<'_>,
        problems: &mut Diagnostics,
    ) -> Option<CertificateAnswer> {
        match certify(&study) {
            Ok(certificate) => {
                remark(&study, &certificate, &self.study, problems);
                Some(CertificateAnswer { study, certificate })
            }
            Err(PoseFault { place, fault }) => {
                let place = place.unwrap_or_else(|| whole(&self.study));
                let hint = "leave the pose out, or extend the tables of the machine file";
                problems.error("pose-not-certified", place, fault.to_string(), hint);
                None
            }
        }
    }
}

/// What the verdict about the poses does not show.
fn remark(study: &Study, found: &Certificate, path: &Path, problems: &mut Diagnostics) {
    let barely: Vec<String> = study
        .barely_reached()
        .iter()
        .map(|(name, share)| format!("{name} {:.0} %", share * 100.0))
        .collect();
    if !barely.is_empty() {
        let message = format!(
            "the poses of the validation cover only a part of the zone: {}",
            barely.join(", ")
        );
        let hint = "validate over the zone, or state the smaller one in [zone]";
        problems.warn("zone-not-covered", whole(path), message, hint);
    }
    if let Some(before) = found.agreement[0].filter(|a| !a.holds()) {
        let message = format!(
            "the readings before the compensation are not as predicted: χ² = {:.1}, at most {:.1} once in a hundred",
            before.chi_square, before.limit
        );
        let hint = "the machine was not the identified one, or it was measured with a compensation switched on";
        problems.warn("not-as-predicted", whole(path), message, hint);
    }
}

impl Answer for CertificateAnswer {
    fn document(&self, problems: &Diagnostics) -> Value {
        with_diagnostics(&report::CertificateDocument::of(&self.study, &self.certificate), problems)
    }

    fn report(&self) -> Report<'_> {
        report::certificate_report(&self.study, &self.certificate)
    }

    fn is_yes(&self) -> bool {
        self.certificate.outcome == Outcome::Pass
    }
}
