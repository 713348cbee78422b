//! The state of a run as metrics of Prometheus, in its text format 0.0.4: a file that the textfile collector of its node exporter
//! reads.

use crate::governor::State;
use crate::status::LiveState;
use std::fmt::Write;

const STATES: [(State, &str); 6] = [
    (State::Off, "off"),
    (State::Arm, "arm"),
    (State::Run, "run"),
    (State::Hold, "hold"),
    (State::RampDown, "ramp-down"),
    (State::Latched, "latched"),
];

/// A label, as the format wants it.
fn label(text: &str) -> String {
    text.replace('\\', "\\\\").replace('"', "\\\"").replace('\n', "\\n")
}

struct Page {
    text: String,
    plan: String,
}

impl Page {
    fn metric(&mut self, name: &str, kind: &str, help: &str) {
        // A text in memory takes everything.
        let _ = writeln!(
            self.text,
            "# HELP trueaxis_live_{name} {help}\n# TYPE trueaxis_live_{name} {kind}"
        );
    }

    fn value(&mut self, name: &str, labels: &[(&str, &str)], value: f64) {
        let plan = label(&self.plan);
        let more: String = labels.iter().map(|(k, v)| format!(",{k}=\"{}\"", label(v))).collect();
        let _ = writeln!(self.text, "trueaxis_live_{name}{{plan=\"{plan}\"{more}}} {value}");
    }
}

/// The page of one state.
pub fn prometheus(plan: &str, state: &LiveState) -> String {
    let mut page = Page { text: String::new(), plan: plan.to_owned() };
    page.metric("state", "gauge", "1 for the state of the governor, 0 for the others");
    for (known, name) in STATES {
        page.value("state", &[("state", name)], f64::from(u8::from(known == state.state)));
    }
    let date = "seconds since 1970 of this state";
    page.metric("timestamp_seconds", "gauge", date);
    #[expect(clippy::cast_precision_loss, reason = "dates and counts below 2^53")]
    let counted = |number: u64| number as f64;
    page.value("timestamp_seconds", &[], counted(state.date_s));
    type Of = fn(&crate::status::LiveAxisEntry) -> Option<f64>;
    let of_axes: [(&str, &str, Of); 5] = [
        ("offset", "offset that the control holds, um or urad", |a| a.offset),
        ("own", "part of the offset that this program has written, um or urad", |a| Some(a.own)),
        ("target", "where the offset goes, um or urad", |a| a.target),
        ("lag", "how far the offset is late by the age of the position, um or urad", |a| a.lag),
        ("limit", "limit of the offset, um or urad", |a| Some(a.limit)),
    ];
    for (name, help, of) in of_axes {
        page.metric(name, "gauge", help);
        for axis in &state.axes {
            if let Some(value) = of(axis) {
                page.value(name, &[("axis", &axis.axis), ("unit", &axis.unit)], value);
            }
        }
    }
    page.metric("sensor_celsius", "gauge", "temperature of a sensor that can be used, degC");
    for sensor in &state.sensors {
        if let Some(celsius) = sensor.celsius {
            page.value("sensor_celsius", &[("sensor", &sensor.sensor)], celsius);
        }
    }
    page.metric("sensor_age_seconds", "gauge", "age of the last good sample, s");
    for sensor in &state.sensors {
        if let Some(age_s) = sensor.age_s {
            page.value("sensor_age_seconds", &[("sensor", &sensor.sensor)], age_s);
        }
    }
    for (name, help, value) in [
        ("cycles_total", "cycles", state.cycles),
        ("missed_total", "periods in which no cycle began", state.missed),
        ("writes_total", "writes of offsets", state.writes),
        ("failed_writes_total", "writes that failed", state.failed_writes),
    ] {
        page.metric(name, "counter", help);
        page.value(name, &[], counted(value));
    }
    page.text
}
