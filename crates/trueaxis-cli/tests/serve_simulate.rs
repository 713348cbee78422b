//! The simulation in the browser view is that of the command line, at every time.

#![cfg(feature = "serve")]

#[allow(dead_code, reason = "each test program uses a part of this file")]
#[path = "serve/client.rs"]
mod client;
mod command;

use client::{Answer, OPEN, Served, ask_socket, frame, next, repository, serve_kept};
use command::trueaxis;
use serde_json::{Value, json};
use std::io::Write as _;

const I5: &str = "machines/i5-engraver/machine.toml";
const COLLISION: &str = "examples/02_simulate/collision-fanuc.nc";

/// The header of a binary answer and its arrays of doubles, floats and whole numbers.
struct Piece {
    header: Value,
    bytes: Vec<u8>,
}

impl Piece {
    fn of(answer: &Answer) -> Self {
        assert_eq!(answer.status, 200, "{}", String::from_utf8_lossy(&answer.body));
        let length = u32::from_le_bytes(answer.body[..4].try_into().expect("4 bytes")) as usize;
        let header = serde_json::from_slice(&answer.body[4..4 + length]).expect("JSON");
        Self { header, bytes: answer.body[(4 + length).next_multiple_of(8)..].to_vec() }
    }

    fn array(&self, name: &str) -> Vec<f64> {
        let mut at = 0;
        for array in self.header["arrays"].as_array().expect("arrays") {
            let count = array["count"].as_u64().expect("a count") as usize;
            let size = match array["type"].as_str() {
                Some("f64") => 8,
                Some("u8") => 1,
                _ => 4,
            };
            if array["name"] == name {
                let all = self.bytes[at..at + count * size].chunks(size);
                return all.map(|b| number(b, array["type"] == "f32")).collect();
            }
            at += (count * size).next_multiple_of(8);
        }
        panic!("no array {name}");
    }
}

fn number(bytes: &[u8], is_float: bool) -> f64 {
    match (bytes.len(), is_float) {
        (8, _) => f64::from_le_bytes(bytes.try_into().expect("8 bytes")),
        (4, true) => f64::from(f32::from_le_bytes(bytes.try_into().expect("4 bytes"))),
        (4, false) => f64::from(u32::from_le_bytes(bytes.try_into().expect("4 bytes"))),
        _ => f64::from(bytes[0]),
    }
}

fn ask(served: &Served, name: &str, body: &Value) -> Piece {
    Piece::of(&served.ask(name, body))
}

#[test]
fn it_is_the_simulation_of_the_command_line() {
    let served = serve_kept(repository(), &OPEN);
    let whole = ask(&served, "simulate", &json!({ "machine": I5, "program": COLLISION }));
    let header = &whole.header;
    let ran = trueaxis(&["simulate", I5, COLLISION, "--no-report", "--format", "json"]);
    let mut document = ran.json();
    // The server states the problems of the input beside the document.
    document.as_object_mut().map(|entries| entries.remove("diagnostics"));
    assert_eq!((ran.status, &header["document"]), (1, &document));
    let duration_s = header["duration_s"].as_f64().expect("a time");
    assert_eq!(header["document"]["time_s"], header["duration_s"]);
    assert_eq!((&header["nodes"], &header["thinned"]), (&header["kept"], &json!(false)));
    let mark = &header["marks"].as_array().expect("marks")[0];
    let issue = &header["document"]["troubles"][0];
    assert_eq!((&mark["kind"], &mark["grave"]), (&json!("collision"), &json!(true)));
    assert_eq!((&mark["text"], &mark["time_s"]), (&issue["text"], &issue["from_s"]));
    let number = &header["simulation"];
    for part in [0.3, 0.5, 0.9] {
        let body = json!({ "simulation": number, "time_s": part * duration_s });
        let at = ask(&served, "simulation-at", &body);
        is_the_pose(&at, header["bodies"].as_array().expect("bodies"));
    }
    the_other_answers_agree(&served, header, duration_s);
}

/// `trueaxis pose` at the command of a moment.
fn is_the_pose(at: &Piece, bodies: &[Value]) {
    let moment = &at.header["moment"];
    let words = |key: &str, show: &dyn Fn(f64) -> String| {
        let axes = moment[key].as_object().expect("axes").iter();
        let word = |(name, q): (&String, &Value)| {
            format!("{name}={}", show(q.as_f64().expect("a number")))
        };
        axes.map(word).filter(|word| !word.ends_with('=')).collect::<Vec<_>>().join(" ")
    };
    let side = |q: f64| {
        if q > 0.0 {
            "+"
        } else if q < 0.0 {
            "-"
        } else {
            ""
        }
    };
    let (to, from) = (words("axes", &|q| q.to_string()), words("approach", &|q| side(q).into()));
    let place = ["pose", I5, "--at", &to, "--approach", &from];
    let pose =
        trueaxis(&[&place[..], &["--tool-length", "90", "--bodies", "--format", "json"]].concat())
            .json();
    let near = |a: &[f64], b: &[Value], most: f64| {
        let far = a.iter().zip(b).map(|(a, b)| (a - b.as_f64().expect("a number")).abs());
        assert!(a.len() == b.len() && far.fold(0.0, f64::max) < most, "{a:?} {b:?}");
    };
    for which in ["nominal", "actual"] {
        let all = at.array(which);
        for (i, body) in pose["bodies"].as_array().expect("bodies").iter().enumerate() {
            assert_eq!(body["body"], bodies[i]);
            let origin = body[which]["origin_mm"].as_array().expect("three");
            near(&all[12 * i + 9..12 * i + 12], origin, 1e-6);
            for (row, numbers) in
                body[which]["rotation"].as_array().expect("rows").iter().enumerate()
            {
                let row = 12 * i + 3 * row;
                near(&all[row..row + 3], numbers.as_array().expect("three"), 1e-9);
            }
        }
    }
    let three = |v: &Value| -> Vec<f64> {
        v.as_array().expect("three").iter().map(|x| x.as_f64().expect("a number")).collect()
    };
    near(&three(&moment["tip_mm"]), pose["nominal"]["tip_mm"].as_array().expect("three"), 1e-6);
    let off = pose["deviation"]["tip_um"].as_array().expect("three");
    near(&three(&moment["off_tip_um"]), off, 1e-6);
}

/// Curves, path, blocks and sources against the document.
fn the_other_answers_agree(served: &Served, header: &Value, duration_s: f64) {
    let number = &header["simulation"];
    let body = json!({
        "simulation": number, "from_s": 0.0, "to_s": duration_s, "columns": 7,
        "quantities": ["Z", "tip"],
    });
    let curves = ask(served, "simulation-curves", &body);
    let (low, high) = (curves.array("low"), curves.array("high"));
    let lowest = low[..7].iter().copied().fold(f64::INFINITY, f64::min);
    let used = &header["document"]["axes"]["Z"];
    assert!((lowest - used["lowest"].as_f64().expect("a place")).abs() < 1e-3 && high.len() == 14);
    let body = json!({ "simulation": number, "points": 1000, "colour": "load" });
    let path = ask(served, "simulation-path", &body);
    let (value, times) = (path.array("value"), path.array("time_s"));
    assert_eq!(path.array("tip_mm").len(), 3 * times.len());
    assert_eq!(times.last(), Some(&duration_s));
    assert!(value.iter().all(|v| (0.0..=100.5).contains(v)), "{value:?}");
    let line = header["document"]["troubles"][0]["line"].as_u64().expect("a line");
    let body = json!({ "simulation": number, "program": 0, "line": line });
    let there = served.ask("simulation-block", &body).json();
    let body = json!({ "simulation": number, "time_s": there["time_s"] });
    let at = ask(served, "simulation-at", &body);
    assert_eq!(at.header["moment"]["line"], json!(line));
    let body = json!({ "simulation": number, "from_s": there["time_s"], "step": "previous" });
    let before = served.ask("simulation-block", &body).json();
    assert!(before["time_s"].as_f64() < there["time_s"].as_f64());
    let source = served.ask("simulation-source", &json!({ "simulation": number, "program": 0 }));
    let text = std::fs::read_to_string(repository().join(COLLISION)).expect("the program");
    assert_eq!(source.json(), json!({ "name": COLLISION, "text": text }));
}

/// The stock at a time is that of the program as it was simulated: a subprogram that is gone or another one now changes nothing.
#[test]
fn the_stock_at_a_time_is_that_of_the_program_that_was_simulated() {
    let folder = client::project("stock");
    let ring = std::fs::read_to_string(repository().join("examples/02_simulate/ring-fanuc.nc"));
    let ring = ring.expect("the program");
    let at = |word: &str| ring.find(word).expect("a block");
    let (head, body, tail) =
        (&ring[..at("N90 ")], &ring[at("N90 ")..at("N2500 ")], &ring[at("N2500 ")..]);
    let sub = folder.join("O0007.nc");
    let write = |path: &std::path::Path, text: &str| std::fs::write(path, text).expect("a file");
    write(&folder.join("main.nc"), &format!("{head}M98 P0007\n{tail}"));
    write(&sub, &format!("%\nO0007\n{body}M99\n%\n"));
    let copy = |from: &str, to: &str| {
        std::fs::copy(repository().join(from), folder.join(to)).expect("a copy");
    };
    copy("examples/02_simulate/ring-fanuc.setup.toml", "main.setup.toml");
    copy(I5, "machine.toml");
    let served = client::serve(folder, &OPEN);
    let body = json!({ "machine": "machine.toml", "program": "main.nc" });
    let simulated = ask(&served, "simulate", &body).header;
    let removed = &simulated["document"]["stock"]["removed_mm3"];
    assert!(removed.as_f64() > Some(400.0), "{removed}");
    let number = &simulated["simulation"];
    let end = json!({ "simulation": number, "time_s": simulated["duration_s"] });
    for change in [None, Some("%\nO0007\nG1 X50. F100.\nM99\n%\n"), Some("")] {
        match change {
            Some("") => std::fs::remove_file(&sub).expect("it was there"),
            Some(text) => write(&sub, text),
            None => {}
        }
        assert_eq!(&ask(&served, "simulation-stock", &end).header["removed_mm3"], removed);
    }
    let early = json!({ "simulation": number, "time_s": -1.0 });
    assert_eq!(ask(&served, "simulation-stock", &early).header["removed_mm3"], json!(0.0));
}

#[test]
fn what_cannot_be_simulated_is_refused_by_name() {
    let served = serve_kept(repository(), &OPEN);
    let dropped = |text: &str| json!({ "machine": I5, "name": "part.nc", "text": text });
    let bad = served.ask("simulate", &dropped("G21 G90 G94\nG0 X0\nG1 X[5 F600\nM30\n"));
    let error = &bad.json()["error"];
    let all = error["diagnostics"].as_array().expect("diagnostics");
    let first = all.iter().find(|d| d["severity"] == "error").expect("an error");
    let place = (&first["file"], &first["line"], &first["column"]);
    assert_eq!((bad.status, place), (422, (&json!("part.nc"), &json!(3), &json!(5))), "{error}");
    for (name, body, status, code) in [
        ("simulate", json!({ "machine": I5, "program": "../x.nc" }), 403, "outside-project"),
        ("simulate", json!({ "machine": I5, "program": "none.nc" }), 422, "unreadable-file"),
        ("simulate", json!({ "machine": I5, "name": "a.nc", "text": "" }), 422, "empty-program"),
        ("simulation-at", json!({ "simulation": 99, "time_s": 1 }), 404, "gone"),
        ("simulation-block", json!({ "simulation": 99, "from_s": 1, "step": "next" }), 404, "gone"),
        ("simulation-curves", json!({ "simulation": 99, "from_s": 1 }), 400, "bad-request"),
    ] {
        let answer = served.ask(name, &body);
        assert_eq!(
            (answer.status, &answer.json()["error"]["code"]),
            (status, &json!(code)),
            "{body}"
        );
    }
    let kept = ask(&served, "simulate", &dropped("G21 G90 G94\nG0 X1\nG1 X5 F600\nM30\n"));
    assert_eq!(kept.header["programs"][0], json!({ "name": "part.nc", "path": null, "lines": 4 }));
    let body = |key: &str, value: Value| {
        let mut body = json!({ "simulation": kept.header["simulation"], "from_s": 0, "to_s": 1, "columns": 9, "quantities": ["X"] });
        body[key] = value;
        body
    };
    for (key, value) in [
        ("quantities", json!(["Q"])),
        ("quantities", json!("X")),
        ("columns", json!(0)),
        ("columns", json!(1e9)),
        ("to_s", json!(0)),
        ("from_s", json!(null)),
    ] {
        assert_eq!(served.ask("simulation-curves", &body(key, value)).status, 400, "{key}");
    }
    assert!(served.is_alive());
}

#[test]
fn nobody_waits_for_a_simulation_that_is_stopped() {
    let served = serve_kept(repository(), &OPEN);
    let (_, mut socket) = served.socket("");
    let text = "O1\nG21 G90 G94\nN1 G1 X1 F900\nX2\nGOTO 1\n";
    let body = json!({ "machine": I5, "name": "endless.nc", "text": text, "collisions": false });
    let question = json!({ "id": 1, "ask": "simulate", "body": body });
    socket.write_all(&frame(1, question.to_string().as_bytes())).expect("open");
    let (_, reported) = next(&mut socket).expect("its progress");
    assert!(String::from_utf8_lossy(&reported).contains("progress"));
    let stopped = ask_socket(&mut socket, &json!({ "id": 1, "stop": true }));
    assert_eq!(stopped["error"]["code"], "stopped");
}
