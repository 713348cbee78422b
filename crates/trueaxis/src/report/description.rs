//! A machine as a page needs it: chain, errors, sensors, tools, models.

use super::array;
use serde_json::{Value, json};
use trueaxis_geometry::Vec3;
use trueaxis_machine::ToolAssembly;
use trueaxis_machine::axis::{Axis, AxisKind, AxisSide, Travel};
use trueaxis_machine::chain::Link;
use trueaxis_machine::describe::{DescribedError, DescribedLink, Description, shown};
use trueaxis_machine::errors::ErrorKind;
use trueaxis_machine::models::{Model, Shape};
use trueaxis_report::numbers::rounded;

/// The links, errors, sensors, tools and models of a machine. A pose is 12 numbers: its rotation row by
/// row, then its origin in mm; bodies are named by their place among the links, the bed is null.
pub fn description_json(description: &Description<'_>) -> Value {
    let machine = description.machine;
    let errors = description.errors.iter().map(|e| {
        let body = &description.links[e.index.body];
        error_json(e, body.axis)
    });
    let sensors = description.sensors.iter();
    json!({
        "links": description.links.iter().map(link_json).collect::<Vec<_>>(),
        "errors": errors.collect::<Vec<_>>(),
        "sensors": sensors
            .map(|s| json!({ "name": s.name, "drives": s.drives }))
            .collect::<Vec<_>>(),
        "tool": {
            "tip_mm": array(machine.tip_mm()),
            "length_mm": -machine.tip_mm().z + 0.0,
            // Which of its tools stands in the spindle is not said, but one of that length may.
            "diameter_mm": machine
                .tools()
                .iter()
                .find(|t| Vec3::new(0.0, 0.0, -t.length_mm) == machine.tip_mm())
                .and_then(|t| t.diameter_mm),
        },
        "tools": machine.tools().iter().map(tool_json).collect::<Vec<_>>(),
        "models": machine.models().iter().map(model_json).collect::<Vec<_>>(),
    })
}

fn link_json(link: &DescribedLink<'_>) -> Value {
    let kind = match link.axis.map(|a| a.kind) {
        Some(AxisKind::Linear) => "linear",
        Some(AxisKind::Rotary) => "rotary",
        None if link.carries == AxisSide::Workpiece => "workpiece",
        None => "tool",
    };
    let carries = if link.carries == AxisSide::Workpiece { "workpiece" } else { "tool" };
    // The workpiece and the tool do not move; a direction they have all the same: that of the tool.
    let direction = link.axis.map_or(Vec3::z(), |a| a.direction);
    let limit = |value: Option<f64>| link.axis.zip(value).map(|(a, v)| rounded(shown(a, v)));
    let limits = link.axis.map(|a| a.limits).unwrap_or_default();
    let unit = link.axis.map(trueaxis_machine::describe::unit);
    let mut document = json!({
        "name": link.body.name.to_string(),
        "kind": kind,
        "carries": carries,
        "direction": array(direction),
        "sense": link.axis.map(|a| a.sense),
        "parent": link.parent,
        "placement": pose(&link.parent_from_link),
        "mounting": pose(&link.body.mounting),
        "unit": unit,
        "travel": link.axis.map_or(Value::Null, travel),
    });
    if let Some(unit) = unit {
        document[format!("max_velocity_{unit}_per_s")] = limit(limits.velocity).into();
        document[format!("max_acceleration_{unit}_per_s2")] = limit(limits.acceleration).into();
        document[format!("max_jerk_{unit}_per_s3")] = limit(limits.jerk).into();
    }
    document
}

fn travel(axis: &Axis) -> Value {
    match axis.travel {
        Travel::Between(from, to) => {
            json!([rounded(shown(axis, from)), rounded(shown(axis, to))])
        }
        Travel::Unlimited => json!("unlimited"),
        Travel::Unknown => Value::Null,
    }
}

fn pose(pose: &Link) -> Vec<f64> {
    let rows = (0..3).flat_map(|i| array(pose.linear().row(i).transpose()));
    rows.chain(array(*pose.shift_mm())).collect()
}

fn error_json(error: &DescribedError<'_>, axis: Option<&Axis>) -> Value {
    let (unit, size) = error.unit();
    let scaled = |value: f64| rounded(value / size) + 0.0;
    let all = |values: &Vec<f64>| values.iter().map(|v| scaled(*v)).collect::<Vec<_>>();
    let curve = error.curve.as_ref().zip(axis).map(|(curve, axis)| {
        json!({
            "at": curve.at.iter().map(|q| rounded(shown(axis, *q)) + 0.0).collect::<Vec<_>>(),
            "at_unit": trueaxis_machine::describe::unit(axis),
            "values": all(&curve.values),
            "reversal": curve.reversal.as_ref().map(all),
            "u": curve.u.as_ref().map(all),
        })
    });
    let measured = error.stated.map(|stated| {
        let m = &stated.measured;
        json!({
            "instrument": m.instrument,
            "date": m.date,
            "temperature_celsius": m.temperature_celsius,
        })
    });
    json!({
        "name": error.name.to_string(),
        "body": error.index.body,
        "kind": if error.name.kind == ErrorKind::Location { "location" } else { "motion" },
        "unit": unit,
        "stated": error.stated.is_some(),
        "shape": error.shape(),
        "text": error.text,
        "line": error.line,
        "table": error.table,
        "value": error.constant().map(scaled),
        "u": error.u().map(scaled),
        "curve": curve,
        "measured": measured,
    })
}

fn tool_json(tool: &ToolAssembly) -> Value {
    let segments = tool.shape.iter().map(|s| [s.diameter_mm, s.length_mm]);
    json!({
        "name": tool.name,
        "length_mm": tool.length_mm,
        "diameter_mm": tool.diameter_mm,
        "corner_radius_mm": tool.corner_radius_mm,
        "holder": tool.holder,
        // From the tip upwards: diameter and length of each cylinder.
        "segments_mm": segments.collect::<Vec<_>>(),
    })
}

fn model_json(model: &Model) -> Value {
    let shape = match &model.shape {
        Shape::Stl { path, unit_mm } => json!({ "stl": { "path": path, "unit_mm": unit_mm } }),
        Shape::Box { size_mm } => json!({ "box": array(*size_mm) }),
        Shape::Cone { base_diameter_mm, top_diameter_mm, length_mm } => json!({ "cone": {
            "base_diameter_mm": base_diameter_mm,
            "top_diameter_mm": top_diameter_mm,
            "length_mm": length_mm,
        } }),
        Shape::Prism { outline_mm, length_mm } => {
            json!({ "prism": { "outline_mm": outline_mm, "length_mm": length_mm } })
        }
    };
    json!({
        "name": model.name,
        "body": model.body,
        "placement": pose(&model.placement),
        "shape": shape,
    })
}
