//! The document `trueaxis/evaluate/1`; its keys are fixed in docs/reference/json.md.

use super::evaluation::Evaluation;
use crate::Evaluated;
use serde_json::{Map, Value, json};

/// An evaluation as one JSON document, numbers in full double precision.
pub fn evaluation_json(evaluation: &Evaluation<'_>) -> Value {
    let c = evaluation.conditions;
    let mut map = Map::new();
    let mut put = |key: &str, value: Value| {
        map.insert(key.to_owned(), value);
    };
    put("schema", "trueaxis/evaluate/1".into());
    put("version", trueaxis_report::VERSION.into());
    put("standard", evaluation.standard.key().into());
    put("file", evaluation.file.into());
    put("name", json!(c.name));
    put("machine", json!(c.machine));
    put("axis", json!(c.axis));
    put("instrument", json!(c.instrument_name));
    put("date", json!(c.date));
    put("temperature_degC", json!(c.temperature_c.map(|t| t.value)));
    match evaluation.evaluated {
        Evaluated::Positioning(measurement, result) => {
            super::evaluation_positioning::json(measurement, result, &mut map);
        }
        Evaluated::Circular(circle) => super::evaluation_circular::json(circle, &mut map),
        Evaluated::Drift(drift) => super::evaluation_others::drift_json(drift, &mut map),
        Evaluated::Diagonals(d) => super::evaluation_others::diagonal_json(d, &mut map),
        Evaluated::Rotation(r) => super::evaluation_others::rotation_json(r, &mut map),
    }
    Value::Object(map)
}
