//! A certificate as text and JSON; the page is in `certificate_page`.

use super::certificate_blocks::{Chapter, chapters};
use crate::verify::certificate::applied::Applied;
use crate::verify::certificate::inputs::Input;
use crate::verify::certificate::{
    Agreement, Certificate, Circumstances, Determined, PoseResult, Rule, Study,
};
use serde_json::{Map, Value, json};
use std::fmt::Write as _;
use trueaxis_geometry::Vec3;
use trueaxis_machine::axis::{Axis, Command, Travel};
use trueaxis_machine::describe::{shown, unit};
use trueaxis_part::tolerance::Outcome;
use trueaxis_report::write_block;

/// A word for programs and people.
pub(super) fn word(outcome: Outcome) -> &'static str {
    match outcome {
        Outcome::Pass => "pass",
        Outcome::Fail => "fail",
        Outcome::Undecided => "undecided",
    }
}

/// The rule in words.
pub(super) fn rule(study: &Study) -> String {
    let (limit, k) = (study.decision.limit_mm * 1e3, study.decision.coverage_factor);
    let kept = match study.decision.rule {
        Rule::Simple => "d ≤ limit (simple acceptance)".to_owned(),
        Rule::GuardBand => format!("d + U ≤ limit, U = k·u with k = {k} (ISO 14253-1)"),
    };
    format!("at every pose {kept}; limit {limit:.1} µm, d the length of the measured tip deviation")
}

/// For the terminal: what a reader decides by; the page has the rest.
pub fn certificate_text(study: &Study, certificate: &Certificate) -> String {
    let mut out = format!("{}\n", study.name);
    for Chapter { number, title, lines, blocks } in chapters(study, certificate) {
        // Writing into a text cannot fail.
        let _ = writeln!(out, "\n{number}. {title}");
        for line in &lines {
            let _ = writeln!(out, "  {line}");
        }
        for block in &blocks {
            let _ = write_block(&mut out, block);
        }
    }
    let _ = writeln!(out, "\n{}: {}", word(certificate.outcome).to_uppercase(), certificate.reason);
    out
}

fn um(vector: &Vec3) -> [f64; 3] {
    (vector * 1e3).into()
}

fn command(axes: &[Axis], command: &Command) -> Value {
    let entries = axes.iter().zip(command);
    // + 0.0: no minus before a zero.
    entries.map(|(axis, q)| (axis.name.to_string(), json!(shown(axis, *q) + 0.0))).collect()
}

fn circumstances(c: &Circumstances) -> Value {
    json!({
        "method": c.method,
        "date": c.date,
        "by": c.by,
        "instrument": c.instrument,
        "calibration": c.calibration,
        "temperature_c": c.temperature_c.value,
        "u_temperature_c": c.temperature_c.u,
    })
}

fn files(files: &[Input]) -> Vec<Value> {
    let one = |i: &Input| json!({ "role": i.role, "name": i.name, "sha256": i.sha256 });
    files.iter().map(one).collect()
}

fn agreement(found: Option<Agreement>) -> Value {
    found.map_or(Value::Null, |a| {
        json!({ "chi_square": a.chi_square, "numbers": a.numbers, "limit": a.limit, "holds": a.holds() })
    })
}

/// The document `trueaxis/certificate/1`.
pub fn certificate_json(study: &Study, certificate: &Certificate) -> Value {
    let machine = &study.machine;
    let errors = machine.stated_errors().into_iter().filter_map(|(index, name)| {
        let stated = machine.bodies()[index.body].stated(index.kind, index.component)?;
        let u = stated.u.as_ref().map(super::certificate_blocks::largest);
        let (unit, scale) = if name.component.is_rotation() { ("urad", 1e6) } else { ("um", 1e3) };
        let value = stated.at(0.0, 0.0).ok();
        Some(json!({
            "error": name.to_string(),
            (format!("value_at_0_{unit}")): value.map(|v| v * scale),
            (format!("u_{unit}")): u.map(|u| u * scale),
        }))
    });
    let determined = match &study.determined {
        Determined::Stated => json!("machine file"),
        Determined::Campaign { name, readings, terms, left_out, verdict } => json!({
            "campaign": name,
            "readings": readings,
            "terms": terms,
            "left_out": left_out,
            "verdict": verdict,
        }),
    };
    let mut determination = circumstances(&study.determination);
    determination["uncertainties_from"] = determined;
    determination["poses_used"] = json!(study.used.len());
    let v = &study.validation;
    let mut validation = circumstances(&v.circumstances);
    validation["zero"] = v.zero.map_or(Value::Null, |zero| command(machine.axes(), &zero));
    validation["u_um"] = json!(v.u_mm * 1e3);
    validation["expanded_um"] = json!(certificate.expanded_mm * 1e3);
    let [before, after] = certificate.rms_mm.map(|v| v * 1e3);
    validation["rms_um"] = json!({ "before": before, "after": after });
    let [before, after] = certificate.largest_mm.map(|v| v * 1e3);
    validation["largest_um"] = json!({ "before": before, "after": after });
    validation["predicted"] = json!({
        "largest_within_um": certificate.lengths.largest_within_mm * 1e3,
        "rms_um": certificate.lengths.rms_mm * 1e3,
        "share": crate::verify::certificate::spread::SHARE,
        "samples": study.sampling.samples,
        "seed": study.sampling.seed,
    });
    let [before, after] = certificate.agreement.map(agreement);
    validation["agreement"] = json!({ "before": before, "after": after });
    validation["poses"] =
        certificate.poses.iter().map(|p| pose(study, machine.axes(), p)).collect();
    let volume = &certificate.volume;
    let ends = study.zone.iter().filter_map(|axis| match axis.travel {
        Travel::Between(from, to) => {
            Some((axis.name.to_string(), json!([shown(axis, from), shown(axis, to)])))
        }
        _ => None,
    });
    json!({
        "schema": "trueaxis/certificate/1",
        "version": trueaxis_report::VERSION,
        "name": study.name,
        "verdict": word(certificate.outcome),
        "reason": certificate.reason,
        "machine": { "name": machine.name(), "chain": machine.chain_text() },
        "errors": errors.collect::<Vec<_>>(),
        "determination": determination,
        "compensation": compensation(study),
        "application": {
            "method": study.application.method,
            "date": study.application.date,
            "by": study.application.by,
            "loaded": study.application.loaded,
        },
        "validation": validation,
        "zone": {
            "ends": ends.collect::<Map<String, Value>>(),
            "poses": volume.poses,
            "rms_before_um": volume.rms_mm[0] * 1e3,
            "rms_after_um": volume.rms_mm[1] * 1e3,
            "largest_um": volume.largest_mm * 1e3,
            "at": command(machine.axes(), &volume.at),
        },
        "decision": {
            "rule": rule(study),
            "limit_um": study.decision.limit_mm * 1e3,
            "coverage_factor": study.decision.coverage_factor,
            "pass": certificate.counts[0],
            "fail": certificate.counts[1],
            "undecided": certificate.counts[2],
        },
        "inputs": files(&study.inputs),
    })
}

fn compensation(study: &Study) -> Value {
    let own = files(&study.application.files);
    match &study.applied {
        Applied::Program(compensator) => json!({
            "kind": "program",
            "scope": super::certificate_blocks::scope(compensator.scope()),
            "files": own,
        }),
        Applied::Tables { compiled, control, .. } => json!({
            "kind": "tables",
            "target": control.key(),
            "tables": compiled.tables.len(),
            "files": own,
        }),
    }
}

fn pose(study: &Study, axes: &[Axis], p: &PoseResult) -> Value {
    let k = study.decision.coverage_factor;
    let [before, after] = p.lengths_mm().map(|d| d * 1e3);
    let approach: Map<String, Value> = axes
        .iter()
        .zip(p.measured.approach)
        .filter(|(_, side)| *side != 0.0)
        .map(|(axis, side)| (axis.name.to_string(), json!(side)))
        .collect();
    json!({
        "line": p.measured.place.line,
        "at": command(axes, &p.measured.command),
        "approach": approach,
        "before_um": um(&p.measured.before_mm),
        "after_um": um(&p.measured.after_mm),
        "predicted_before_um": um(&p.predicted.before.tip_mm),
        "predicted_after_um": um(&p.predicted.after.tip_mm),
        "expanded_predicted_um": um(&(p.predicted.u_mm() * k)),
        "predicted_axis_urad": <[f64; 3]>::from(p.predicted.after.axis * 1e6),
        "expanded_axis_urad": <[f64; 3]>::from(p.predicted.u_axis() * (k * 1e6)),
        "length_before_um": before,
        "length_after_um": after,
        "predicted_within_um": p.within_mm * 1e3,
        "E_n": { "before": p.e_n[0], "after": p.e_n[1] },
        "verdict": word(p.outcome),
    })
}

/// `X 3100 mm`: position and unit of an axis.
pub(super) fn place(axes: &[Axis], at: &Command) -> Vec<String> {
    let one = |(axis, q): (&Axis, &f64)| {
        let digits = if unit(axis) == "mm" { 1 } else { 2 };
        trueaxis_report::numbers::fixed(shown(axis, *q), digits)
    };
    axes.iter().zip(at).map(one).collect()
}
