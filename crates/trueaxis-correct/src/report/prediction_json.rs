//! The document `trueaxis/predict/1`; its keys are fixed in docs/reference/json.md.

use crate::predict::{Correction, Index, Prediction, SectionResult, Sensitivity, Share, Study};
use crate::report::family_key;
use crate::report::ranked;
use serde_json::{Map, Value, json};
use trueaxis_machine::axis::{Axis, Command};
use trueaxis_machine::describe::shown;
use trueaxis_machine::errors::ErrorKind;
use trueaxis_part::testpiece::IndexName;
use trueaxis_part::tolerance::Outcome;

/// A prediction as one JSON document, numbers in full double precision.
pub fn json(study: &Study, prediction: &Prediction) -> Value {
    let axes = study.machine.axes();
    let names: Vec<IndexName> = prediction.indices.iter().map(|i| i.name).collect();
    json!({
        "schema": "trueaxis/predict/1",
        "version": trueaxis_report::VERSION,
        "study": study.name,
        "machine": { "name": study.machine.name(), "chain": study.machine.chain_text() },
        "test_piece": study.test_piece.name,
        "verdict": outcome(prediction.verdict.outcome),
        "indices": indices(&prediction.indices),
        "judgements": judgements(prediction),
        "setting_command": command(axes, &prediction.setting_command),
        "positions": positions(prediction, &names),
        "blame": blame(prediction, &names),
        "blame_by_body": groups(prediction, &prediction.blame.bodies, &names, |b| b.to_string()),
        "blame_by_kind": groups(prediction, &prediction.blame.kinds, &names, |k| match k {
            ErrorKind::Location => "location errors".to_owned(),
            ErrorKind::Motion => "error motions".to_owned(),
        }),
        "sensitivity": prediction.sensitivities.iter().map(|s| sensitivity(s, &names)).collect::<Vec<_>>(),
        "corrections": prediction.corrections.iter().map(|c| correction(c, &names)).collect::<Vec<_>>(),
        "variants": prediction.variants.iter()
            .map(|v| json!({ "name": v.name, "indices_mm": named(&names, &v.indices_mm) }))
            .collect::<Vec<_>>(),
        "commands": prediction.commands.iter().map(|c| command(axes, c)).collect::<Vec<_>>(),
        "monte_carlo": study.sampling.map(|s| json!({ "samples": s.samples, "seed": s.seed })),
        "temperature_log": study.temperatures.as_ref().map(|t| t.run.log.file()),
        "warnings": prediction.warnings,
    })
}

fn outcome(outcome: Outcome) -> &'static str {
    match outcome {
        Outcome::Pass => "pass",
        Outcome::Fail => "fail",
        Outcome::Undecided => "undecided",
    }
}

/// `{"paper": {…}, "iso": {…}, "volumetric_max_mm": …}`.
fn grouped(entries: impl Iterator<Item = (IndexName, Value)>) -> Value {
    let mut groups = Map::new();
    for (name, value) in entries {
        match family_key(name.family) {
            None => {
                groups.insert(name.key.to_owned(), value);
            }
            Some(family) => {
                let group = groups.entry(family).or_insert_with(|| json!({}));
                if let Some(group) = group.as_object_mut() {
                    group.insert(name.key.to_owned(), value);
                }
            }
        }
    }
    Value::Object(groups)
}

fn indices(indices: &[Index]) -> Value {
    grouped(indices.iter().map(|index| {
        let mut entry = json!({ "value": index.value_mm, "u_mm": index.u_mm });
        if let Some(spread) = index.spread {
            entry["monte_carlo"] = json!({
                "mean_mm": spread.mean_mm,
                "u_mm": spread.u_mm,
                "interval_95_mm": [spread.low_mm, spread.high_mm],
            });
        }
        (index.name, entry)
    }))
}

fn judgements(prediction: &Prediction) -> Vec<Value> {
    let entry = |j: &trueaxis_part::tolerance::Judgement| {
        json!({
            "index": j.index.key,
            "value_mm": j.value_mm,
            "tolerance_mm": j.limit_mm,
            "expanded_mm": j.expanded_mm,
            "used_ratio": j.used_ratio,
            "decisive": j.index.decisive,
            "verdict": outcome(j.outcome),
        })
    };
    prediction.verdict.judgements.iter().map(entry).collect()
}

fn command(axes: &[Axis], command: &Command) -> Value {
    let entries = axes.iter().zip(command);
    // + 0.0: no minus before a zero.
    entries.map(|(axis, q)| (axis.name.to_string(), json!(shown(axis, *q) + 0.0))).collect()
}

fn positions(prediction: &Prediction, names: &[IndexName]) -> Vec<Value> {
    let sections = prediction.sections.iter().enumerate();
    sections.map(|(i, section)| position(i + 1, section, names)).collect()
}

fn position(number: usize, result: &SectionResult, names: &[IndexName]) -> Value {
    let section = &result.section;
    let values = names.iter().zip(&section.indices_mm).zip(&result.u_mm);
    let known = values.filter_map(|((name, value), u)| {
        value.map(|value| (*name, json!({ "value": value, "u_mm": u })))
    });
    let mut document = grouped(known);
    document["position"] = json!(number);
    document["z_mm"] = json!(section.z_mm);
    document["height_mm"] = json!(section.height_mm);
    document["nominal_radius_mm"] = json!(section.radius_mm);
    document["azimuth_deg"] =
        section.azimuth_rad.iter().map(|a| a.to_degrees()).collect::<Vec<f64>>().into();
    document["e_mm"] = json!(section.deviation_mm);
    document
}

fn blame(prediction: &Prediction, names: &[IndexName]) -> Vec<Value> {
    groups(prediction, &prediction.blame.errors, names, |e| e.to_string())
}

/// Index after index, the shares that matter most first.
fn groups<T>(
    prediction: &Prediction,
    shares: &[Share<T>],
    names: &[IndexName],
    word: impl Fn(&T) -> String,
) -> Vec<Value> {
    let mut entries = Vec::new();
    for (i, name) in names.iter().enumerate() {
        for share in ranked(prediction, i, shares, shares.len()) {
            entries.push(json!({
                "error": word(&share.of),
                "index": name.key,
                "alone_mm": share.alone_mm[i],
                "without_mm": share.without_mm[i],
            }));
        }
    }
    entries
}

fn named(names: &[IndexName], values: &[f64]) -> Map<String, Value> {
    names.iter().zip(values).map(|(n, v)| (n.key.to_owned(), json!(v))).collect()
}

fn sensitivity(sensitivity: &Sensitivity, names: &[IndexName]) -> Value {
    let rotation = sensitivity.error.component.is_rotation();
    // mm per rad is µm per µrad times 1: both sides of the quotient scale by 1e-6 or 1e-3.
    let (unit, scale) = if rotation { ("um_per_urad", 1e-3) } else { ("um_per_um", 1.0) };
    let slopes: Vec<f64> = sensitivity.slope.iter().map(|s| s * scale).collect();
    json!({ "error": sensitivity.error.to_string(), unit: named(names, &slopes) })
}

fn correction(correction: &Correction, names: &[IndexName]) -> Value {
    let rotation = correction.error.component.is_rotation();
    let (unit, scale) = if rotation { ("change_urad", 1e6) } else { ("change_um", 1e3) };
    json!({
        "error": correction.error.to_string(),
        unit: correction.change * scale,
        "indices_mm": named(names, &correction.indices_mm),
    })
}
