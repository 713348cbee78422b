//! Measure, plan, identify, verify.

use super::choices::choice;
use crate::answer::NativeAnswer;
use crate::door::Door;
use crate::options::Options;
use pyo3::prelude::*;
use std::path::PathBuf;
use trueaxis::form::Element;
use trueaxis::questions::{
    Certify, CompareCalibrations, Evaluate, EvaluateForm, Identify, IdentifyExpansion,
    IdentifyProbe, IdentifyRtcp, IdentifySurface, IdentifyTables, IdentifyThermal, IdentifyTools,
    LaserBeforeAfter, Measure, MeasurePart, PlanMeasurement, PlanSurface, PlanToolSetting,
    ProbePrograms, ReadingsFile, RtcpPrograms, ToolChoice, VerifyHistory, VerifyPart,
    VerifyReadings,
};
use trueaxis::verify::Standard;
use trueaxis::verify::import::Import;

/// The control of programs that were not asked for by name, as in the command.
const CONTROL: &str = "sinumerik";

/// Puts the question of a verb of this file; none if it is not one.
pub fn ask(verb: &str, o: &Options<'_, '_>, door: &Door<'_>) -> PyResult<Option<NativeAnswer>> {
    Ok(Some(match verb {
        "measure" => measure(o, door)?,
        "plan" => door.ask(&PlanMeasurement {
            campaign: o.file("campaign")?,
            control: o.text_or("control", CONTROL)?,
            output: o.path("output")?,
            write_unsafe: o.is("write_unsafe")?,
        })?,
        "plan_probe_surface" => door.ask(&PlanSurface {
            study: o.file("file")?,
            control: o.text_or("control", CONTROL)?,
            output: o.path("output")?,
            write_unsafe: o.is("write_unsafe")?,
        })?,
        "plan_tool_setting" => door.ask(&PlanToolSetting {
            choice: tools(o)?,
            control: o.text_or("control", CONTROL)?,
            output: o.path("output")?,
            write_unsafe: o.is("write_unsafe")?,
        })?,
        "identify" => door.ask(&Identify {
            campaign: o.file("campaign")?,
            table: None,
            output: o.path("output")?,
            predictor: o.path("predictor")?,
            check_conventions: o.is("check_conventions")?,
        })?,
        "evaluate" => door.ask(&evaluate(o, door)?)?,
        "evaluate_form" => door.ask(&form(o, door)?)?,
        "verify" => verify(o, door)?,
        _ => return identify(verb, o, door),
    }))
}

fn identify(verb: &str, o: &Options<'_, '_>, door: &Door<'_>) -> PyResult<Option<NativeAnswer>> {
    let study = || o.file("file");
    Ok(Some(match verb {
        "identify_expansion" => {
            door.ask(&IdentifyExpansion { runs: o.paths("files")?, output: o.path("output")? })?
        }
        "identify_tables" => {
            door.ask(&IdentifyTables { study: study()?, output: o.path("output")? })?
        }
        "identify_thermal" => {
            door.ask(&IdentifyThermal { study: study()?, score: o.paths("score")? })?
        }
        "identify_surface" => {
            door.ask(&IdentifySurface { study: study()?, output: o.path("output")? })?
        }
        "identify_rtcp" => match o.path("programs")? {
            Some(output) => door.ask(&RtcpPrograms {
                study: study()?,
                control: o.text_or("control", CONTROL)?,
                output,
            })?,
            None => door.ask(&IdentifyRtcp { study: study()?, output: o.path("output")? })?,
        },
        "identify_probe" => probe(study()?, o, door)?,
        "identify_tools" => door.ask(&IdentifyTools {
            choice: tools(o)?,
            log: o.file("log")?,
            date: o.text("date")?,
            output: o.path("output")?,
        })?,
        _ => return Ok(None),
    }))
}

fn measure(o: &Options<'_, '_>, door: &Door<'_>) -> PyResult<NativeAnswer> {
    let (output, seed) = (o.path("output")?, o.count("seed")?);
    match o.path("part")? {
        Some(study) => door.ask(&MeasurePart {
            study,
            output,
            seed: seed.unwrap_or(1),
            draw: o.is("draw")?,
            point_u: o.text_or("point_u", "0 um")?,
        }),
        None => door.ask(&Measure {
            campaign: o.file("campaign")?,
            output,
            truth: o.path("truth")?,
            seed,
        }),
    }
}

fn tools(o: &Options<'_, '_>) -> PyResult<ToolChoice> {
    Ok(ToolChoice { machine: o.file("machine")?, setup: o.file("setup")?, tools: o.text("tools")? })
}

fn probe(study: PathBuf, o: &Options<'_, '_>, door: &Door<'_>) -> PyResult<NativeAnswer> {
    let (stylus, orientation) = (o.text("stylus")?, o.text("orientation")?);
    let corrections = o.path("corrections")?;
    let corrected = corrections.is_some();
    match o.path("programs")?.or(corrections) {
        Some(output) => door.ask(&ProbePrograms {
            study,
            control: o.text_or("control", CONTROL)?,
            output,
            corrected,
            stylus,
            orientation,
        }),
        None => door.ask(&IdentifyProbe {
            study,
            correct: o.path("correct")?.zip(o.path("output")?),
            table: o.path("table")?,
            stylus,
            orientation,
        }),
    }
}

fn evaluate(o: &Options<'_, '_>, door: &Door<'_>) -> PyResult<Evaluate> {
    let standards: Vec<_> = Standard::ALL.iter().map(|s| (s.key(), *s)).collect();
    let imports: Vec<_> = Import::ALL.iter().map(|i| (i.key(), *i)).collect();
    let rules = [("iso14253-1", false), ("simple", true)];
    let standard = choice(door.py(), "standard", o.text("standard")?, &standards)?;
    let import = o.text("import")?;
    let import = match import {
        Some(_) => choice(door.py(), "import", import, &imports)?,
        None => None,
    };
    let write_back = o.texts("write_back")?;
    Ok(Evaluate {
        standard: standard.unwrap_or(Standard::ALL[0]),
        data: ReadingsFile::Path(o.file("data")?),
        import,
        feature: o.text("feature")?,
        map: o.path("map")?,
        conditions: o.path("conditions")?,
        radius: o.text("radius")?.map(|mm| format!("{mm} mm")),
        window: Some(o.text_or("window", "60 min")?),
        write_back: match write_back.as_slice() {
            [machine, axis] => Some((PathBuf::from(machine), axis.clone())),
            _ => None,
        },
        machine: o.path("machine")?,
        output: o.path("output")?,
        tolerances: o.texts("tolerance")?,
        tolerance_file: o.path("tolerances")?,
        is_simple: choice(door.py(), "rule", o.text("rule")?, &rules)? == Some(true),
    })
}

fn form(o: &Options<'_, '_>, door: &Door<'_>) -> PyResult<EvaluateForm> {
    let elements: Vec<_> = Element::ALL.iter().map(|e| (e.key(), *e)).collect();
    let element = choice(door.py(), "element", o.text("element")?, &elements)?;
    Ok(EvaluateForm {
        data: ReadingsFile::Path(o.file("points")?),
        element: element.unwrap_or(Element::ALL[0]),
        reference: o.text("reference")?,
        filter: o.text("filter")?,
        tolerance: o.text("tolerance")?,
        u: o.text("u")?,
    })
}

fn verify(o: &Options<'_, '_>, door: &Door<'_>) -> PyResult<NativeAnswer> {
    if let Some(campaign) = o.path("before_after")? {
        return door.ask(&LaserBeforeAfter { campaign, output: o.path("output")? });
    }
    if let Some(study) = o.path("certificate")? {
        return door.ask(&Certify { study });
    }
    if let Some(file) = o.path("part")? {
        return door.ask(&VerifyPart { file });
    }
    let history = o.paths("history")?;
    if !history.is_empty() {
        return door.ask(&VerifyHistory { files: history, limits: o.texts("limit")? });
    }
    match o.paths("diff")?.as_slice() {
        [old, new] => door.ask(&CompareCalibrations { old: old.clone(), new: new.clone() }),
        _ => door.ask(&VerifyReadings { file: o.file("file")? }),
    }
}
