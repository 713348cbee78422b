//! The requests by name: one file for each tab of the page.

mod compensate;
mod describe;
mod evaluate;
mod identify;
mod live;
mod machine;
mod measure;
mod new_machine;
mod plan;
mod predict;
mod project;
mod readings;
mod report;
mod settings;
mod shown;
mod simulate;
mod simulate_document;
mod trace;
mod verify;

use crate::request::{Pace, Question, work};
#[cfg(feature = "schemas")]
use {crate::request::Request, crate::schemas::request_schema, trueaxis::report::named_schema};

macro_rules! questions {
    ($($pace:ident $name:literal => $request:ty,)*) => {
        &[$(Question {
            name: $name,
            pace: Pace::$pace,
            work: work::<$request>,
            #[cfg(feature = "schemas")]
            schemas: || [
                named_schema::<<$request as Request>::Answer<'static>>(concat!("serve-", $name)),
                request_schema::<$request>(concat!("serve-", $name, "-request")),
            ],
        }),*]
    };
}

/// All of them.
pub(crate) const QUESTIONS: &[Question] = questions! {
    Quick "project" => project::ProjectRequest,
    Quick "open" => project::OpenRequest,
    Quick "save" => project::SaveRequest,
    Quick "save-made" => project::SaveMadeRequest,
    Quick "describe" => describe::DescribeRequest,
    Quick "new-machine" => new_machine::NewMachineRequest,
    Quick "models" => describe::ModelsRequest,
    Quick "pose" => describe::PoseRequest,
    Quick "set-error" => describe::SetErrorRequest,
    Long "predict" => predict::PredictRequest,
    Quick "what-if" => predict::WhatIfRequest,
    Long "plan" => plan::PlanRequest,
    Long "measure-sheet" => measure::MeasureSheetRequest,
    Quick "measure-check" => measure::MeasureCheckRequest,
    Long "measure" => measure::MeasureRequest,
    Long "identify" => identify::IdentifyRequest,
    Long "compensate-program" => compensate::CompensateProgramRequest,
    Quick "compensate-targets" => compensate::TargetsRequest,
    Long "compensate-tables" => compensate::CompensateTablesRequest,
    Long "compensate-values" => compensate::CompensateValuesRequest,
    Long "compensate-adapt" => compensate::CompensateAdaptRequest,
    Long "verify" => verify::VerifyRequest,
    Quick "live" => live::LiveRequest,
    Quick "standards" => evaluate::StandardsRequest,
    Quick "evaluate" => evaluate::EvaluateRequest,
    Quick "readings-text" => readings::ReadingsTextRequest,
    Quick "readings-columns" => readings::ReadingsColumnsRequest,
    Long "report" => report::ReportRequest,
    Long "simulate" => simulate_document::SimulateRequest,
    Long "trace" => trace::TraceRequest,
    Quick "simulation-at" => simulate_document::SimulationAtRequest,
    Long "simulation-stock" => simulate_document::SimulationStockRequest,
    Quick "simulation-block" => simulate_document::SimulationBlockRequest,
    Quick "simulation-path" => simulate_document::SimulationPathRequest,
    Quick "simulation-curves" => simulate_document::SimulationCurvesRequest,
    Quick "simulation-source" => simulate_document::SimulationSourceRequest,
};
