//! Compensate: values, programs and tables; cutter locations to programs.

use super::choices::choice;
use crate::answer::NativeAnswer;
use crate::door::Door;
use crate::options::Options;
use pyo3::prelude::*;
use trueaxis::compensate::tables::Target;
use trueaxis::post::FeedRule;
use trueaxis::predict::holes::Compensation;
use trueaxis::questions::{
    Adapt, CompensateProgram, CompensateTables, CompensateValues, Post, ValuesForm,
};
use trueaxis::writer::TipWords;

/// Puts the question of a verb of this file; none if it is not one.
pub fn ask(verb: &str, o: &Options<'_, '_>, door: &Door<'_>) -> PyResult<Option<NativeAnswer>> {
    Ok(Some(match verb {
        "compensate_values" => door.ask(&values(o, door)?)?.by_report(),
        "compensate_program" => door.ask(&program(o)?)?,
        "compensate_tables" => door.ask(&tables(o, door)?)?,
        "compensate_adapt" => door.ask(&adapt(o, door)?)?,
        "post" => door.ask(&post(o, door)?)?,
        _ => return Ok(None),
    }))
}

fn values(o: &Options<'_, '_>, door: &Door<'_>) -> PyResult<CompensateValues> {
    let errors =
        [("comprehensive", Compensation::Comprehensive), ("machine", Compensation::Machine)];
    let forms = [("text", ValuesForm::Text), ("json", ValuesForm::Json), ("csv", ValuesForm::Csv)];
    let form = choice(door.py(), "format", o.text("format")?, &forms)?;
    let output = o.path("output")?;
    // Without a file the form is that of the document, which says all that was found.
    let form = form.filter(|_| output.is_some()).unwrap_or(ValuesForm::Json);
    Ok(CompensateValues {
        machine: o.machine()?,
        axis: o.text("axis")?,
        at: o.text("at")?,
        step: o.text("step")?,
        targets: o.text("targets")?,
        increment: o.text("increment")?,
        of: choice(door.py(), "of", o.text("of")?, &errors)?.unwrap_or(Compensation::Comprehensive),
        machine_only: o.is("machine_only")?,
        form,
        output,
    })
}

fn program(o: &Options<'_, '_>) -> PyResult<CompensateProgram> {
    Ok(CompensateProgram {
        machine: o.machine()?,
        program: o.file("program")?,
        output: o.file("output")?,
        setup: o.path("setup")?,
        control: o.text("control")?,
        flat: o.is("flat")?,
        position_only: o.is("position_only")?,
        residual: o.text_or("residual", "1 um")?,
        residual_axis: o.text("residual_axis")?,
        keep_unproved: o.is("keep_unproved")?,
        increment: o.text_or("increment", "1 um")?,
        increment_deg: o.text_or("increment_deg", "0.0001 deg")?,
        no_rounding: o.is("no_rounding")?,
        limit: o.text_or("limit", "1 mm")?,
        limit_axis: o.text_or("limit_axis", "1 mrad")?,
        machine_only: o.is("machine_only")?,
    })
}

fn tables(o: &Options<'_, '_>, door: &Door<'_>) -> PyResult<CompensateTables> {
    let types = [("0", false), ("1", true)];
    let trims =
        choice(door.py(), "comp_file_type", o.text("comp_file_type")?, &types)? == Some(true);
    let targets = [
        ("csv", Target::Csv),
        ("linuxcnc", Target::LinuxCnc { trims }),
        ("sinumerik", Target::Sinumerik),
        ("fanuc", Target::Fanuc),
        ("heidenhain", Target::Heidenhain),
        ("isg", Target::Isg),
    ];
    Ok(CompensateTables {
        machine: o.machine()?,
        target: choice(door.py(), "target", o.text("target")?, &targets)?.unwrap_or(Target::Csv),
        output: o.file("output")?,
        at: o.text("at")?,
        bound: o.text_or("bound", "1 um")?,
        bound_angle: o.text_or("bound_angle", "5 urad")?,
        limit: o.text_or("limit", "1 mm")?,
        limit_angle: o.text_or("limit_angle", "1000 urad")?,
        no_kinematics: o.is("no_kinematics")?,
        piece: o.path("piece")?,
        machine_only: o.is("machine_only")?,
    })
}

fn adapt(o: &Options<'_, '_>, door: &Door<'_>) -> PyResult<Adapt> {
    let tcp = [("on", true), ("off", false)];
    Ok(Adapt {
        study: o.file("file")?,
        output: o.path("output")?.zip(o.text("control")?),
        tcp: choice(door.py(), "tcp", o.text("tcp")?, &tcp)?.unwrap_or(true),
        tolerance: o.text_or("tolerance", "0.001")?,
        cl: o.path("cl")?,
    })
}

fn post(o: &Options<'_, '_>, door: &Door<'_>) -> PyResult<Post> {
    let py = door.py();
    let words = [("angles", TipWords::Angles), ("vectors", TipWords::Vectors)];
    let words = choice(py, "orientation", o.text("orientation")?, &words)?;
    let tcp = [("on", words), ("length", Some(TipWords::Length)), ("off", None)];
    let feeds = [
        ("tip", FeedRule::Tip),
        ("inverse-time", FeedRule::InverseTime),
        ("axis-limit", FeedRule::AxisLimit),
    ];
    let units = [("mm", false), ("inch", true)];
    let inches = match o.text("units")? {
        None => None,
        given => choice(py, "units", given, &units)?,
    };
    Ok(Post {
        machine: o.machine()?,
        file: o.file("file")?,
        control: o.text_or("control", "")?,
        tip_words: choice(py, "tcp", o.text("tcp")?, &tcp)?.flatten(),
        lines_only: o.is("lines_only")?,
        tolerance: o.text_or("tolerance", "0.01")?,
        axis_tolerance: o.text_or("axis_tolerance", "0.05")?,
        pole_tolerance: o.text_or("pole_tolerance", "0")?,
        feed_rule: choice(py, "feed_mode", o.text("feed_mode")?, &feeds)?.unwrap_or(FeedRule::Tip),
        feed: o.text("feed")?,
        retract: o.text_or("retract", "50")?,
        inches,
        decimals: o.text_or("decimals", "4,5")?,
        template: o.path("template")?,
        number: o.count("number")?.and_then(|n| u32::try_from(n).ok()).unwrap_or(1),
        output: o.file("output")?,
        verify: o.is("verify")?,
        set_up: o.path("set_up")?,
    })
}
