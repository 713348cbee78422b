//! Real answers fit the JSON Schemas in docs/schemas.

#[cfg(feature = "serve")]
#[path = "serve/client.rs"]
#[allow(dead_code)]
mod client;
#[path = "command/mod.rs"]
mod command;

use command::{Folder, root, trueaxis};
use jsonschema::Validator;
use serde_json::Value;
use std::collections::BTreeSet;
use std::fs;

/// The schema of a document.
fn validator(name: &str) -> Validator {
    let path = root().join(format!("docs/schemas/{name}.json"));
    let text = fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    let schema = serde_json::from_str(&text).expect("JSON");
    jsonschema::validator_for(&schema).unwrap_or_else(|e| panic!("{name}: {e}"))
}

/// The document fits its schema.
fn fits(name: &str, document: &Value) {
    let wrong: Vec<String> = validator(name)
        .iter_errors(document)
        .map(|e| format!("{}: {e}", e.instance_path()).chars().take(400).collect())
        .collect();
    assert!(wrong.is_empty(), "{name}:\n{}", wrong.join("\n"));
}

/// The names of the schemas with and without this beginning.
fn names(server: bool) -> BTreeSet<String> {
    let files = fs::read_dir(root().join("docs/schemas")).expect("docs/schemas").flatten();
    let files = files.map(|file| file.file_name().to_string_lossy().into_owned());
    let names = files.filter_map(|file| file.strip_suffix(".json").map(str::to_owned));
    names.filter(|name| name.starts_with("serve-") == server).collect()
}

/// Commands that answer in each document; `OUT` is a folder of the test, `~` a space.
const ANSWERS: &[(&str, &str)] = &[
    ("new", "new OUT/my-machine --kind table-table"),
    ("part", "part parts/housing.toml"),
    ("part", "part crates/trueaxis-cli/tests/import/plate.qif"),
    ("certificate", "verify --certificate examples/07_verify/certificate.toml"),
    ("check", "check machines/xkas2525/machine.toml"),
    ("compensate", "compensate values machines/xkas2525/machine.toml --axis C --step 30"),
    ("compensate-adapt", "compensate adapt examples/06_compensate/bangle-adapt.toml"),
    (
        "compensate-program",
        "compensate program machines/xkas2525/machine.toml examples/06_compensate/frustum.mpf -o OUT/f.mpf",
    ),
    (
        "diff",
        "verify --diff machines/xkas2525/machine.toml examples/07_verify/xkas2525-after-a-year.toml",
    ),
    ("evaluate", "evaluate iso230-1 examples/07_verify/moody-1955.csv"),
    ("evaluate", "evaluate iso230-1 examples/07_verify/squareness-xy.csv"),
    ("evaluate", "evaluate iso230-2 examples/07_verify/x-axis-laser.csv"),
    ("evaluate", "evaluate iso230-2 examples/07_verify/c-axis-polygon.csv"),
    ("evaluate", "evaluate iso230-3 examples/07_verify/spindle-drift.csv"),
    ("evaluate", "evaluate iso230-4 examples/07_verify/circle-xy.csv"),
    (
        "evaluate",
        "evaluate iso230-4 examples/07_verify/ball-bar-export.csv --machine machines/three-axis-mill/machine.toml \
         --tolerance G_b=20um",
    ),
    ("history", "verify --history examples/07_verify/history"),
    ("evaluate", "evaluate iso230-6 examples/07_verify/body-diagonals.csv"),
    ("evaluate", "evaluate iso230-10 examples/07_verify/probe-performance.csv"),
    ("evaluate", "evaluate iso230-7 examples/07_verify/spindle-motion.csv"),
    ("evaluate-form", "evaluate form examples/07_verify/cone-section.csv --element circle"),
    ("evaluate-form", "evaluate form examples/07_verify/cylinder-points.csv --element cylinder"),
    ("explain", "explain outlier"),
    ("explain-list", "explain"),
    ("identify-errors", "identify examples/05_identify/probe-ball.toml"),
    ("identify-expansion", "identify expansion examples/05_identify/y-axis-two-temperatures.toml"),
    (
        "identify-expansions",
        "identify expansion examples/05_identify/x-axis-two-temperatures.toml examples/05_identify/y-axis-two-temperatures.toml",
    ),
    ("identify-tables", "identify tables examples/05_identify/error-tables.toml"),
    ("identify-probe", "identify probe examples/05_identify/ring-60.toml"),
    (
        "identify-probe-programs",
        "identify probe examples/05_identify/ring-programs.toml --corrections OUT/ring",
    ),
    ("identify-rtcp", "identify rtcp examples/05_identify/rtcp-engraver.toml"),
    (
        "identify-rtcp-programs",
        "identify rtcp examples/05_identify/rtcp-engraver.toml --programs OUT/rtcp",
    ),
    ("identify-surface", "identify surface examples/05_identify/bangle-hits.toml"),
    ("identify-thermal", "identify thermal examples/05_identify/lathe-thermal.toml"),
    (
        "identify-thermal",
        "identify thermal examples/05_identify/lathe-thermal.toml --score examples/05_identify/lathe-new-day.csv",
    ),
    (
        "identify-tools",
        "identify tools machines/i5-engraver/machine.toml examples/04_plan/tool-setting.setup.toml examples/05_identify/tool-setting.log",
    ),
    (
        "live-expect",
        "live expect examples/08_live/gantry-mock.toml --temperature-log examples/03_predict/torque-arm-hall.csv",
    ),
    ("live-part", "live part examples/08_live/gantry-mock.toml"),
    ("live-status", "live status examples/08_live/gantry-mock.toml"),
    ("measure", "measure examples/07_verify/probe-ball-campaign.toml -o OUT/readings"),
    ("measure-part", "measure --part examples/03_predict/nas979-on-xkas2525.toml --draw"),
    ("plan", "plan examples/04_plan/probe-ball.toml"),
    ("plan", "plan examples/04_plan/ball-bar-10791-6.toml"),
    ("plan-probe-surface", "plan probe-surface examples/04_plan/probe-surface.toml"),
    (
        "plan-tool-setting",
        "plan tool-setting machines/i5-engraver/machine.toml examples/04_plan/tool-setting.setup.toml",
    ),
    ("study", "study examples/09_study/fleet.toml --machines 20 --days 3"),
    ("study", "study examples/09_study/guideways.toml --machines 2"),
    ("pose", "pose machines/xkas2525/machine.toml --at X=3000"),
    (
        "pose-rows",
        "pose machines/xkas2525/machine.toml --at-file examples/01_describe/positions.csv",
    ),
    (
        "post",
        "post machines/i5-engraver/machine.toml examples/06_compensate/bangle.cls --control fanuc -o OUT/b.nc",
    ),
    ("predict", "predict examples/03_predict/cone-on-i5.toml --no-report"),
    ("predict-holes", "predict examples/03_predict/torque-arm.toml --no-report"),
    ("predict-part", "predict examples/03_predict/housing.toml --no-report"),
    (
        "simulate",
        "simulate machines/i5-engraver/machine.toml examples/02_simulate/ring-fanuc.nc --no-report",
    ),
    ("solve", "solve machines/i5-engraver/machine.toml --tip 10~20~30 --axis 0.3~-0.2~0.93"),
    ("solve-path", "solve machines/i5-engraver/machine.toml --path examples/01_describe/path.csv"),
    (
        "compensate-tables",
        "compensate tables machines/three-axis-mill/machine.toml --target linuxcnc -o OUT/tables",
    ),
    (
        "trace",
        "trace machines/wyxzcat-gantry/machine.toml examples/02_simulate/impeller-840d.mpf --block 120",
    ),
    ("verify", "verify examples/07_verify/probe-ball.toml"),
    ("before-after", "verify --before-after examples/07_verify/laser-before-after-x.toml"),
    ("verify-part", "verify --part examples/07_verify/nas979-measured.toml"),
    ("verify-part", "verify --part examples/07_verify/nas979-points.toml"),
];

#[test]
fn answers_of_the_commands_fit_their_schemas() {
    let folder = Folder::new("schemas");
    let out = folder.path("");
    for (name, words) in ANSWERS {
        let words = words.replace("OUT/", &out);
        let arguments: Vec<String> = words.split(' ').map(|word| word.replace('~', " ")).collect();
        let mut arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
        arguments.extend(["--format", "json"]);
        let document = trueaxis(&arguments).json();
        fits(name, &document);
        is_plausible(&words, &document);
    }
}

/// Ranges that warn of the examples would be of no use.
fn is_plausible(command: &str, document: &Value) {
    let codes = ["implausible-value", "impossible-value", "too-large", "small-readings"];
    let found = document["diagnostics"].as_array().into_iter().flatten();
    let odd: Vec<&Value> = found.filter(|d| codes.iter().any(|code| d["code"] == *code)).collect();
    assert!(odd.is_empty(), "{command}: {odd:?}");
}

/// Scripts that read JSON need the reason, too.
#[test]
fn a_refusal_is_a_document() {
    let ran = trueaxis(&["predict", "no-such-study.toml", "--format", "json"]);
    assert_eq!(ran.status, 2);
    let document = ran.json();
    fits("refused", &document);
    assert_eq!(document["diagnostics"][0]["code"], "unreadable-file");
    assert_eq!(document["diagnostics"][0]["severity"], "error");
    assert!(trueaxis(&["predict", "no-such-study.toml"]).out.is_empty());
}

/// Requests with an answer each, in this order; `SIMULATION` is the number of the simulation before.
#[cfg(feature = "serve")]
const REQUESTS: &[(&str, &str)] = &[
    ("project", r#"{}"#),
    ("open", r#"{"path": "machines/xkas2525/machine.toml"}"#),
    ("describe", r#"{"machine": "machines/xkas2525/machine.toml"}"#),
    ("describe", r#"{"machine": "machines/xkas2525/machine.toml", "text": "[machine]"}"#),
    ("models", r#"{"machine": "machines/i5-engraver/machine.toml"}"#),
    ("pose", r#"{"machine": "machines/xkas2525/machine.toml", "at": {"X": 3000, "C": -90}}"#),
    (
        "set-error",
        r#"{"machine": "mill.toml", "text": "[machine]\nname = \"m\"\nchain = \"w b X Y Z t\"\n",
            "error": "EC0Y", "value": "10 urad"}"#,
    ),
    ("predict", r#"{"study": "examples/03_predict/cone-on-i5.toml"}"#),
    ("predict", r#"{"study": "examples/03_predict/torque-arm.toml"}"#),
    (
        "what-if",
        r#"{"study": "examples/03_predict/cone-on-i5.toml", "errors": {"EC0Y": {"add": "5 urad"}}}"#,
    ),
    ("plan", r#"{"campaign": "examples/04_plan/probe-ball.toml", "dialect": "fanuc"}"#),
    ("measure-sheet", r#"{"campaign": "examples/04_plan/probe-ball.toml"}"#),
    (
        "measure-check",
        r#"{"campaign": "examples/04_plan/probe-ball.toml", "instrument": "probe", "name": "typed.csv",
            "text": "A,C,x_um,y_um,z_um\n90,0,1,2,3\n90,0,1,2,4\n"}"#,
    ),
    ("measure", r#"{"campaign": "examples/04_plan/probe-ball.toml", "seed": 7}"#),
    ("identify", r#"{"campaign": "examples/05_identify/probe-ball.toml"}"#),
    (
        "compensate-program",
        r#"{"machine": "machines/xkas2525/machine.toml", "program": "examples/06_compensate/frustum.mpf"}"#,
    ),
    ("compensate-targets", r#"{}"#),
    (
        "compensate-tables",
        r#"{"machine": "machines/three-axis-mill/machine.toml", "target": "linuxcnc"}"#,
    ),
    (
        "compensate-values",
        r#"{"machine": "machines/xkas2525/machine.toml", "axis": "C", "step": "30"}"#,
    ),
    ("compensate-adapt", r#"{"study": "examples/06_compensate/bangle-adapt.toml"}"#),
    ("verify", r#"{"what": "readings", "file": "examples/07_verify/probe-ball.toml"}"#),
    (
        "verify",
        r#"{"what": "diff", "file": "machines/xkas2525/machine.toml",
            "new": "examples/07_verify/xkas2525-after-a-year.toml"}"#,
    ),
    (
        "verify",
        r#"{"what": "history", "file": "examples/07_verify/history", "limits": ["EC0X=40 urad"]}"#,
    ),
    ("verify", r#"{"what": "certificate", "file": "examples/07_verify/certificate.toml"}"#),
    ("verify", r#"{"what": "laser", "file": "examples/07_verify/laser-before-after-x.toml"}"#),
    ("verify", r#"{"what": "part", "file": "examples/07_verify/nas979-points.toml"}"#),
    ("live", r#"{"plan": "examples/08_live/gantry-mock.toml", "hours": 8}"#),
    ("standards", r#"{}"#),
    ("evaluate", r#"{"standard": "iso230-2", "path": "examples/07_verify/x-axis-laser.csv"}"#),
    ("evaluate", r#"{"standard": "iso230-4", "path": "examples/07_verify/circle-xy.csv"}"#),
    ("new-machine", r#"{"kind": "table-table", "name": "mill", "travels": {"C": null}}"#),
    ("readings-text", r#"{"base64": "QWJ3ZWljaHVuZyBbtW1d"}"#),
    ("readings-columns", r#"{"path": "examples/07_verify/x-axis-laser.csv"}"#),
    ("readings-columns", r#"{"text": "Pos;dx\n0,5;1,25\n"}"#),
    ("report", r#"{"verb": "plan", "file": "examples/04_plan/probe-ball.toml"}"#),
    (
        "simulate",
        r#"{"machine": "machines/i5-engraver/machine.toml", "program": "examples/02_simulate/ring-fanuc.nc"}"#,
    ),
    (
        "trace",
        r#"{"machine": "machines/i5-engraver/machine.toml", "program": "examples/02_simulate/ring-fanuc.nc", "line": 22}"#,
    ),
    ("simulation-at", r#"{"simulation": 1, "time_s": 1.5}"#),
    ("simulation-block", r#"{"simulation": 1, "from_s": 1, "step": "next"}"#),
    ("simulation-path", r#"{"simulation": 1, "points": 500, "colour": "feed"}"#),
    (
        "simulation-curves",
        r#"{"simulation": 1, "from_s": 0, "to_s": 5, "columns": 20, "quantities": ["X", "tip"]}"#,
    ),
    ("simulation-stock", r#"{"simulation": 1, "time_s": 2.5}"#),
    ("simulation-source", r#"{"simulation": 1, "program": 0}"#),
];

#[cfg(feature = "serve")]
#[test]
fn requests_and_answers_of_the_server_fit_their_schemas() {
    use serde_json::json;
    let served = client::serve_kept(client::repository(), &client::OPEN);
    let mut simulation = Value::Null;
    for (name, body) in REQUESTS {
        let mut body: Value = serde_json::from_str(body).expect("JSON");
        // Numbers begin anywhere.
        if body.get("simulation").is_some() {
            body["simulation"] = simulation.clone();
        }
        fits(&format!("serve-{name}-request"), &body);
        let answer = served.ask(name, &body);
        let text = || String::from_utf8_lossy(&answer.body).chars().take(400).collect::<String>();
        assert_eq!(answer.status, 200, "{name}: {}", text());
        let is_binary = answer.head.contains("application/octet-stream");
        let mut document = if is_binary { answer.header() } else { answer.json() };
        if is_binary {
            let header = document.as_object_mut().expect("a header");
            for array in header.remove("arrays").expect("arrays").as_array().expect("arrays") {
                fits("serve-array", array);
            }
        }
        fits(&format!("serve-{name}"), &document);
        if *name == "simulate" {
            simulation = document["simulation"].clone();
        }
    }
    let asked: BTreeSet<String> = REQUESTS
        .iter()
        .flat_map(|(n, _)| [format!("serve-{n}"), format!("serve-{n}-request")])
        .collect();
    let others = [
        "serve-array",
        "serve-refused",
        "serve-save",
        "serve-save-made",
        "serve-save-made-request",
        "serve-save-request",
        "serve-socket",
        "serve-socket-request",
    ];
    let others: BTreeSet<String> = others.map(str::to_owned).into();
    assert_eq!(names(true), &asked | &others);
    let refused = served.ask("open", &json!({ "path": 7 }));
    fits("serve-refused", &refused.json());
    let question = json!({ "id": 5, "ask": "standards" });
    fits("serve-socket-request", &question);
    fits("serve-socket", &client::ask_socket(&mut served.socket("").1, &question));
}

#[cfg(feature = "serve")]
#[test]
fn saved_files_fit_their_schemas() {
    use serde_json::json;
    let served = client::serve(client::project("schemas"), &client::OPEN);
    let body = json!({ "path": "mill/new.toml", "text": "", "version": null, "window": "a" });
    fits("serve-save-request", &body);
    let (_, mut other) = served.socket("");
    fits("serve-save", &served.ask("save", &body).json());
    let (_, news) = client::next(&mut other).expect("the other window hears of it");
    fits("serve-socket", &serde_json::from_slice(&news).expect("JSON"));
    let body = json!({ "machine": "mill/machine.toml", "axis": "X" });
    let made = served.ask("compensate-values", &body).json()["made"]["number"].clone();
    let body = json!({ "made": made, "file": 0, "path": "mill/x.csv", "window": "a" });
    fits("serve-save-made-request", &body);
    fits("serve-save-made", &served.ask("save-made", &body).json());
}

#[test]
fn every_document_has_an_example_here() {
    let mut tried: BTreeSet<String> = ANSWERS.iter().map(|(name, _)| (*name).to_owned()).collect();
    // A machine description is an answer of the server only; diagnostics stand in the other
    // documents; the refusal has a test of its own.
    tried.extend(["description", "diagnostic", "refused"].map(str::to_owned));
    assert_eq!(names(false), tried);
}
