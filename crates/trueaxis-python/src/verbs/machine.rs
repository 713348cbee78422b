//! Describe, simulate, predict.

use crate::answer::NativeAnswer;
use crate::door::Door;
use crate::options::Options;
use pyo3::prelude::*;
use trueaxis::questions::{
    AskPart, AskPose, Positions, Predict, ProgramChoice, Simulate, Solve, SolveTarget, TraceBlock,
};

/// Puts the question of a verb of this file; none if it is not one.
pub fn ask(verb: &str, o: &Options<'_, '_>, door: &Door<'_>) -> PyResult<Option<NativeAnswer>> {
    Ok(Some(match verb {
        "pose" => door.ask(&pose(o)?)?,
        "solve" => door.ask(&solve(o)?)?,
        "part" => door.ask(&AskPart { file: o.file("file")?, output: o.path("output")? })?,
        "simulate" => door.ask(&simulate(o)?)?,
        "trace" => {
            let block = o.count("block")?.and_then(|n| usize::try_from(n).ok()).unwrap_or(0);
            door.ask(&TraceBlock { machine: o.machine()?, program: program(o)?, block })?
        }
        "predict" => door.ask(&predict(o)?)?,
        "study" => door.ask(&crate::study::question(o)?)?,
        _ => return Ok(None),
    }))
}

fn pose(o: &Options<'_, '_>) -> PyResult<AskPose> {
    let at = match o.path("at_file")? {
        Some(path) => Positions::File(path),
        None => Positions::One(o.text_or("at", "")?),
    };
    Ok(AskPose {
        machine: o.machine()?,
        at,
        approach: o.text("approach")?,
        bodies: o.is("bodies")?,
    })
}

fn solve(o: &Options<'_, '_>) -> PyResult<Solve> {
    let target = match o.path("path")? {
        Some(path) => SolveTarget::Path(path),
        None => SolveTarget::Pose(o.text_or("tip", "")?, o.text_or("axis", "")?),
    };
    Ok(Solve { machine: o.machine()?, target, from: o.text("from")? })
}

fn simulate(o: &Options<'_, '_>) -> PyResult<Simulate> {
    Ok(Simulate {
        machine: o.machine()?,
        program: program(o)?,
        path: o.path("path")?,
        bodies: o.path("bodies")?,
        pictures: o.is("pictures")?,
        no_collisions: o.is("no_collisions")?,
        stock: o.is("stock")?,
    })
}

/// The program, its set-up, and the division of its moves.
fn program(o: &Options<'_, '_>) -> PyResult<ProgramChoice> {
    let usual = ProgramChoice::default();
    Ok(ProgramChoice {
        program: o.file("program")?,
        setup: o.path("setup")?,
        control: o.text("control")?,
        chord: o.text_or("chord", &usual.chord)?,
        spacing: o.text_or("spacing", &usual.spacing)?,
        angle: o.text_or("angle", &usual.angle)?,
        by_count: o.is("by_count")?,
        no_densify: o.is("no_densify")?,
        rounding: o.text_or("rounding", &usual.rounding)?,
        three_phase: o.text("three_phase")?,
        smooth: o.is("smooth")?,
        most_jumps: o.count("most_jumps")?.unwrap_or(usual.most_jumps),
        keep_going: o.is("keep_going")?,
        without_optional: o.is("without_optional")?,
        ..usual
    })
}

fn predict(o: &Options<'_, '_>) -> PyResult<Predict> {
    Ok(Predict {
        study: o.file("study")?,
        samples: o.text("samples")?,
        seed: o.count("seed")?,
        compensated: o.is("compensated")?,
        results: o.path("results")?,
    })
}
