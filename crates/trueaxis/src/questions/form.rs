//! What is the form of points?

use super::evaluate::positive;
use super::{Answer, Question, ReadingsFile, Tell, with_diagnostics};
use crate::report;
use serde_json::Value;
use trueaxis_input::{Diagnostics, Dimension, Files, Place};
use trueaxis_report::Report;
use trueaxis_standards::form::{
    Criterion, Decision, Element, Filter, FormEvaluation, FormRequest, evaluate_form, filter_named,
    reference_named,
};
use trueaxis_standards::report::{FormDocument, FormShown, form_report};

/// An element through points with its form deviation.
#[derive(Debug, Clone)]
pub struct EvaluateForm {
    /// The points.
    pub data: ReadingsFile,
    /// The element.
    pub element: Element,
    /// The reference element that decides, as typed; the minimum zone if none is named.
    pub reference: Option<String>,
    /// A filter, as typed: `gauss 50 upr`.
    pub filter: Option<String>,
    /// The tolerance, as typed, with its unit.
    pub tolerance: Option<String>,
    /// The standard uncertainty of a point, as typed, with its unit.
    pub u: Option<String>,
}

/// The points and what the options say.
#[derive(Debug)]
pub struct FormInput {
    name: String,
    text: String,
    reference: Criterion,
    filter: Option<Filter>,
    tolerance_mm: Option<f64>,
    u_mm: Option<f64>,
}

/// The points, evaluated.
#[derive(Debug)]
pub struct FormAnswer {
    /// The file of the points.
    pub name: String,
    /// The result.
    pub found: FormEvaluation,
    /// Warnings and notes, each as one text.
    pub remarks: Vec<String>,
}

impl FormAnswer {
    /// What a report shows.
    pub fn shown(&self) -> FormShown<'_> {
        FormShown { found: &self.found, file: &self.name, remarks: &self.remarks }
    }
}

impl Question for EvaluateForm {
    type Input = FormInput;
    type Answer = FormAnswer;

    fn read(&self, files: &Files, problems: &mut Diagnostics) -> Option<FormInput> {
        let reference = match &self.reference {
            None => Some(Criterion::MinimumZone),
            Some(text) => reference_named(text).or_else(|| {
                let message = format!("`{text}` is no reference element");
                let hint = "LSC, MZC, MCC or MIC, also as LSCI, MZLI, MZPL, MICY …";
                problems.error(
                    "unknown-reference-element",
                    Place::whole("--reference"),
                    message,
                    hint,
                );
                None
            }),
        };
        let mut filter = None;
        if let Some(text) = &self.filter {
            match filter_named(text) {
                Ok(found) => filter = Some(found),
                Err(message) => problems.error("bad-filter", Place::whole("--filter"), message, ""),
            }
        }
        let mut length = |name: &str, text: &Option<String>| {
            positive(name, text.as_ref()?, Dimension::Length, problems)
        };
        let tolerance_mm = length("--tolerance", &self.tolerance);
        let u_mm = length("--u", &self.u);
        let (name, text) = self.data.text(files, "a table of points (CSV)", problems);
        let text = text.filter(|_| !problems.has_errors())?;
        let reference = reference?;
        Some(FormInput { name, text, reference, filter, tolerance_mm, u_mm })
    }

    fn answer(
        &self,
        input: FormInput,
        _: Tell<'_>,
        problems: &mut Diagnostics,
    ) -> Option<FormAnswer> {
        let request = FormRequest {
            reference: input.reference,
            filter: input.filter,
            tolerance_mm: input.tolerance_mm,
            u_mm: input.u_mm,
            ..FormRequest::new(self.element, &input.name, &input.text)
        };
        let found = evaluate_form(&request, problems)?;
        let remarks = report::remarks(problems);
        Some(FormAnswer { name: input.name, found, remarks })
    }
}

impl Answer for FormAnswer {
    fn document(&self, problems: &Diagnostics) -> Value {
        with_diagnostics(&FormDocument::of(&self.shown()), problems)
    }

    fn report(&self) -> Report<'_> {
        form_report(&self.shown())
    }

    fn is_yes(&self) -> bool {
        self.found.decision().is_none_or(|d| d == Decision::Pass)
    }
}
