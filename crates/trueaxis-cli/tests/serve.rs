//! `trueaxis serve` as a rude world meets it: who may ask, which files it touches, what it survives.

#![cfg(feature = "serve")]

#[path = "serve/client.rs"]
mod client;

use client::{ask_socket, cli, frame, next, project, repository, serve, serve_kept};
use serde_json::{Value, json};
use std::fs;
use std::io::{Read, Write};
use std::time::Duration;

#[test]
fn a_file_is_opened_and_saved_and_no_edit_of_another_window_is_lost() {
    let served = serve(project("save"), &client::OPEN);
    let opened = served.ask("open", &json!({ "path": "mill/machine.toml" })).json();
    let (text, version) = (opened["text"].as_str().expect("text"), &opened["version"]);
    let save = |text: &str, version: &Value| {
        let body = json!({ "path": "mill/machine.toml", "text": text, "version": version });
        served.ask("save", &body)
    };
    let (_, mut other) = served.socket("");
    let first = save(&format!("{text}# first window\n"), version);
    assert_eq!(first.status, 200);
    let (_, news) = next(&mut other).expect("the other window hears of it");
    let news: Value = serde_json::from_slice(&news).expect("JSON");
    assert_eq!(news["changed"]["path"], "mill/machine.toml");
    // The second window opened the file before the first one saved it.
    let second = save(&format!("{text}# second window\n"), version);
    assert_eq!((second.status, &second.json()["error"]["code"]), (409, &json!("conflict")));
    let there = fs::read_to_string(served.folder.join("mill/machine.toml")).expect("the file");
    assert!(there.ends_with("# first window\n"));
    let again = save(&format!("{there}# second window\n"), &first.json()["version"]);
    assert_eq!(again.status, 200);
}

/// A window listens from the moment that it is answered, so that no save between this and its first message is lost.
#[test]
fn a_window_hears_of_what_is_saved_at_once_after_it_was_answered() {
    let served = serve(project("at-once"), &client::OPEN);
    for n in 0..40 {
        let path = format!("mill/new-{n}.toml");
        let (_, mut window) = served.socket("");
        assert_eq!(served.ask("save", &json!({ "path": path, "text": "" })).status, 200);
        let (_, news) = next(&mut window).expect("it hears of it");
        let news: Value = serde_json::from_slice(&news).expect("JSON");
        assert_eq!(news["changed"]["path"], path.as_str());
    }
}

#[test]
fn what_an_answer_made_is_saved_and_no_file_of_a_person_is_replaced() {
    let served = serve(project("made"), &client::OPEN);
    let body = json!({ "machine": "mill/machine.toml", "axis": "X" });
    let answer = served.ask("compensate-values", &body).json();
    let made = &answer["made"]["number"];
    assert_eq!(answer["made"]["files"][0]["name"], "mill/values-X.csv");
    let save = |path: &str| {
        let answer = served.ask("save-made", &json!({ "made": made, "file": 0, "path": path }));
        (answer.status, answer.json()["error"]["code"].as_str().unwrap_or("").to_owned())
    };
    let refused = |status, code: &str| (status, code.to_owned());
    // Nothing was written before; what this program wrote may be replaced by it.
    assert!(!served.folder.join("mill/values-X.csv").exists());
    assert_eq!([save("mill/x.csv").0, save("mill/x.csv").0], [200, 200]);
    let written = fs::read(served.folder.join("mill/x.csv")).expect("the file");
    let download = served.send(&format!("GET /made/{made}/0"), "", b"");
    assert_eq!((download.status, &download.body), (200, &written));
    assert_eq!(served.send(&format!("GET /made/{made}/7"), "", b"").status, 404);
    fs::write(served.folder.join("mill/mine.csv"), "mine\n").expect("a file of a person");
    assert_eq!(save("mill/mine.csv"), refused(409, "conflict"));
    fs::write(served.folder.join("mill/x.csv"), "edited\n").expect("an edit");
    assert_eq!(save("mill/x.csv"), refused(409, "conflict"));
    assert_eq!(save("mill/x.toml"), refused(403, "not-written"));
    assert_eq!(save("../x.csv"), refused(403, "outside-project"));
    // What it was made from has changed.
    let machine = served.folder.join("mill/machine.toml");
    let text = fs::read_to_string(&machine).expect("the machine") + "# edited\n";
    fs::write(&machine, text).expect("an edit");
    assert_eq!(save("mill/late.csv"), refused(409, "conflict"));
    assert!(!served.folder.join("mill/late.csv").exists());
    for name in ["mill/mine.csv", "mill/x.csv"] {
        let there = fs::read_to_string(served.folder.join(name)).expect("the file");
        assert!(["mine\n", "edited\n"].contains(&&*there), "{name}: {there}");
    }
}

/// Two places: 1 and 3, then 10, 10 and 13 µm, and one that was read once: s = √((2 + 6) / (1 + 2)) with 3 degrees of freedom,
/// whatever the order of the rows and of the columns.
#[test]
fn law_repeatability_is_that_of_the_readings_by_hand_in_any_order() {
    let served = serve_kept(repository(), &client::OPEN);
    let checked = |text: &str| {
        let body = json!({ "campaign": "examples/04_plan/probe-ball.toml", "instrument": "probe", "name": "r.csv", "text": text });
        let answer = served.ask("measure-check", &body);
        (answer.status, answer.json())
    };
    let (place, second) = ("90,90,210,80,-140", "90,85,210,85.686,-129.7696");
    let rows = [
        format!("{place},1,0,5"),
        format!("{second},10,0,5"),
        format!("{place},3,0,5"),
        format!("{second},13,0,5"),
        format!("{second},10,0,5"),
        "0,90,310,80,-160,7,7,7".to_owned(),
    ];
    let head = "C,A,X,Y,Z,x_um,y_um,z_um\n";
    let (status, found) = checked(&(head.to_owned() + &rows.join("\n")));
    assert_eq!(status, 200, "{found}");
    assert_eq!((&found["places"], &found["repeated"]), (&json!(3), &json!(2)));
    let x = &found["channels"][0];
    let s = x["s"].as_f64().expect("s");
    assert!((s - (8.0_f64 / 3.0).sqrt()).abs() < 1e-9, "{found}");
    assert_eq!((&x["degrees_of_freedom"], &x["unit"]), (&json!(3), &json!("um")));
    assert!((x["largest_range"].as_f64().expect("a range") - 3.0).abs() < 1e-9);
    assert_eq!(found["channels"][1]["s"], json!(0.0));
    let mut turned = rows.clone();
    turned.reverse();
    // The columns the other way round, too.
    let backwards = |row: &str| row.trim().rsplit(',').collect::<Vec<_>>().join(",");
    let turned: Vec<String> = turned.iter().map(|row| backwards(row)).collect();
    let (status, other) = checked(&(backwards(head) + "\n" + &turned.join("\n")));
    assert_eq!(status, 200, "{other}");
    let difference = other["channels"][0]["s"].as_f64().expect("s") - s;
    assert!(difference.abs() < 1e-12, "{other}");
    // What is no reading is named with its line; so are semicolons, which the page replaces before it asks.
    let (status, refused) = checked(&head.replace(',', ";"));
    assert_eq!((status, &refused["error"]["code"]), (422, &json!("bad-separator")), "{refused}");
    for (bad, code) in [("nan", "not-a-number"), ("", "not-a-number"), ("12 um", "not-a-number")] {
        let (status, refused) = checked(&format!("{head}{place},1,0,5\n{place},{bad},0,5\n"));
        assert_eq!(status, 422, "{bad}: {refused}");
        let first = &refused["error"]["diagnostics"][0];
        assert_eq!((&first["code"], &first["line"]), (&json!(code), &json!(3)), "{bad}: {refused}");
    }
}

#[test]
fn a_history_is_that_of_the_files_of_a_folder() {
    let served = serve_kept(repository(), &client::OPEN);
    let folder = "examples/07_verify/history";
    let body = json!({ "what": "history", "file": folder, "limits": ["EC0X=40 urad"] });
    let answer = served.ask("verify", &body).json();
    let expected = cli(&["verify", "--history", folder, "--limit", "EC0X=40 urad"]);
    assert_eq!(answer["document"], expected);
    for (file, status) in [("examples", 422), ("../history", 403)] {
        assert_eq!(
            served.ask("verify", &json!({ "what": "history", "file": file })).status,
            status
        );
    }
}

#[test]
fn nothing_outside_the_folder_is_read_or_written() {
    let folder = project("outside");
    let secret = folder.with_extension("secret.toml");
    fs::write(&secret, "secret = \"word\"\n").expect("a file outside");
    std::os::unix::fs::symlink(&secret, folder.join("mill/link.toml")).expect("a link");
    std::os::unix::fs::symlink("/etc", folder.join("etc")).expect("a link");
    fs::create_dir(folder.join(".git")).expect("a folder");
    fs::write(folder.join(".git/config.toml"), "secret").expect("a hidden file");
    let served = serve(folder, &client::OPEN);
    let secret_name = secret.file_name().expect("a name").to_string_lossy().into_owned();
    let absolute = secret.display().to_string();
    let names = [
        format!("../{secret_name}"),
        format!("mill/../../{secret_name}"),
        absolute,
        "mill/link.toml".to_owned(),
        "etc/passwd".to_owned(),
        "/etc/passwd".to_owned(),
        ".git/config.toml".to_owned(),
        "mill/..\\..\\x.toml".to_owned(),
        "mill/machine.toml\0.csv".to_owned(),
        "%2e%2e/x.toml".to_owned(),
        String::new(),
        "a/".repeat(5000),
    ];
    for name in &names {
        let answer = served.ask("open", &json!({ "path": name }));
        assert!(matches!(answer.status, 403 | 404 | 422), "{name}: {}", answer.status);
        assert!(!String::from_utf8_lossy(&answer.body).contains("word"), "{name}");
        let save = json!({ "path": name, "text": "taken", "version": null });
        let answer = served.ask("save", &save);
        assert!(matches!(answer.status, 403 | 409 | 422), "{name}: {}", answer.status);
    }
    assert_eq!(fs::read_to_string(&secret).expect("it"), "secret = \"word\"\n");
    // A machine file may not fetch a table from elsewhere either.
    let own = format!(
        "[machine]\nname = \"m\"\nchain = \"w b X Y Z t\"\n[motion.X]\ntable = \"../../{secret_name}\"\n"
    );
    let body = json!({ "path": "mill/own.toml", "text": own, "version": null });
    assert_eq!(served.ask("save", &body).status, 200);
    let answer = served.ask("describe", &json!({ "machine": "mill/own.toml" }));
    let said = String::from_utf8_lossy(&answer.body).into_owned();
    assert!(said.contains("outside the project folder") && !said.contains("word"), "{said}");
    for path in ["/../Cargo.toml", "/%2e%2e/%2e%2e/etc/passwd", "/mill/machine.toml", "/report/9"] {
        assert_eq!(served.send(&format!("GET {path}"), "", b"").status, 404, "{path}");
    }
    let _ = fs::remove_file(secret);
    assert!(served.is_alive());
}

#[test]
fn only_the_own_page_may_ask() {
    let served = serve(project("origin"), &client::OPEN);
    let host = &served.host;
    let json_type = "Content-Type: application/json\r\n";
    let own = format!("{json_type}Origin: http://{host}\r\n");
    assert_eq!(served.send("POST /api/project", &own, b"{}").status, 200);
    let foreign = format!("{json_type}Origin: http://evil.example\r\n");
    assert_eq!(served.send("POST /api/project", &foreign, b"{}").status, 403);
    // A form of another page cannot send JSON without asking first.
    let form = "Content-Type: text/plain\r\n";
    assert_eq!(served.send("POST /api/project", form, b"{}").status, 415);
    let rebound = format!("{json_type}Host: evil.example\r\n");
    assert_eq!(served.send("POST /api/project", &rebound, b"{}").status, 403);
    assert_eq!(served.socket(&format!("Origin: http://{host}\r\n")).0, 101);
    assert_eq!(served.socket("Origin: http://evil.example\r\n").0, 403);
    assert_eq!(served.socket("Origin: null\r\n").0, 403);
    let page = served.send("GET /", "", b"");
    let head = page.head.to_ascii_lowercase();
    assert!(head.contains("content-security-policy: default-src 'none'"), "{head}");
    assert!(head.contains("x-content-type-options: nosniff"), "{head}");
}

#[test]
fn the_token_is_needed_here_and_beyond() {
    for arguments in [&["--port", "0"][..], &["--port", "0", "--listen", "0.0.0.0"]] {
        let served = serve(project("token"), arguments);
        let (host, token) = served.host.split_once("/?token=").expect("an address with a token");
        // It can be typed: 0.0.0.0 is no address of a computer.
        assert!(!host.starts_with("0.0.0.0"), "{host}");
        let (_, port) = host.rsplit_once(':').expect("a port");
        let named = format!("Content-Type: application/json\r\nHost: {host}\r\n");
        assert_eq!(served.send("POST /api/project", &named, b"{}").status, 401);
        let bearer = format!("{named}Authorization: Bearer {token}\r\n");
        assert_eq!(served.send("POST /api/project", &bearer, b"{}").status, 200);
        let entry = format!("Host: {host}\r\n");
        assert_eq!(served.send("GET /", &entry, b"").status, 401);
        let entered = served.send(&format!("GET /?token={token}"), &entry, b"");
        assert_eq!(entered.status, 303);
        assert!(entered.head.contains("HttpOnly") && entered.head.contains("SameSite=Strict"));
        let cookie = format!("{named}Cookie: trueaxis_token_{port}={token}\r\n");
        assert_eq!(served.send("POST /api/project", &cookie, b"{}").status, 200);
    }
}

#[test]
fn a_proxy_with_tls_is_accepted_where_it_is_named() {
    let arguments = [&client::OPEN[..], &["--origin", "https://mill.example"]].concat();
    let served = serve(project("proxy"), &arguments);
    let json_type = "Content-Type: application/json\r\n";
    for host in ["mill.example", &served.host] {
        let asks = |origin: &str| {
            let headers = format!("{json_type}Host: {host}\r\nOrigin: {origin}\r\n");
            served.send("POST /api/project", &headers, b"{}").status
        };
        assert_eq!(asks("https://mill.example"), 200, "{host}");
        assert_eq!(asks("https://other.example"), 403, "{host}");
    }
    assert_eq!(served.socket("Origin: https://mill.example\r\n").0, 101);
}

#[test]
fn options_that_give_the_files_away_are_refused() {
    for words in [["--listen", "0.0.0.0", "--no-token"], ["--origin", "mill.example", "--port=0"]] {
        let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_trueaxis"));
        let done = command.arg("serve").args(words).output().expect("the command");
        let said = String::from_utf8_lossy(&done.stderr).into_owned();
        assert_eq!(done.status.code(), Some(2), "{said}");
        assert!(said.contains("cannot-serve") && said.contains("serve --help"), "{said}");
    }
}

#[test]
fn malformed_requests_are_answered_and_the_server_goes_on() {
    let served = serve(project("malformed"), &client::OPEN);
    let host = &served.host;
    let json_type = "Content-Type: application/json\r\n";
    for body in ["", "{", "[]", "7", "{\"path\": 7}", "{\"nothing\": 1}", "\u{0}"] {
        let answer = served.send("POST /api/open", json_type, body.as_bytes());
        assert_eq!(answer.status, 400, "{body}");
        assert!(answer.json()["error"]["message"].is_string(), "{body}");
    }
    let deep = "[".repeat(200_000);
    assert_eq!(served.send("POST /api/open", json_type, deep.as_bytes()).status, 400);
    assert_eq!(served.ask("nonsense", &json!({})).status, 404);
    assert_eq!(served.send("DELETE /api/open", "", b"").status, 405);
    // More is announced than is allowed: refused before it is sent.
    let long = format!(
        "POST /api/open HTTP/1.1\r\nHost: {host}\r\n{json_type}Content-Length: 99999999999\r\n\r\n"
    );
    assert_eq!(served.raw(long.as_bytes()).status, 413);
    let garbage: Vec<u8> =
        (0..4096_u32).map(|i| (i.wrapping_mul(2_654_435_761) >> 13) as u8).collect();
    let _ = served.raw(&garbage);
    let _ = served.raw(format!("GET / HTTP/1.1\r\nX: {}\r\n\r\n", "x".repeat(1 << 20)).as_bytes());
    let (_, mut socket) = served.socket("");
    for words in ["", "{", "[]", "{\"id\": -1}", "{\"id\": 1}", "{\"ask\": \"project\"}"] {
        socket.write_all(&frame(1, words.as_bytes())).expect("open");
        let (_, said) = next(&mut socket).expect("an answer");
        assert!(String::from_utf8_lossy(&said).contains("\"error\""), "{words}");
    }
    socket.write_all(&frame(2, &garbage)).expect("open");
    assert!(String::from_utf8_lossy(&next(&mut socket).expect("an answer").1).contains("error"));
    let answer = ask_socket(&mut socket, &json!({ "id": 5, "ask": "project" }));
    assert!(answer["reply"]["files"].is_array());
    // No frame of a WebSocket at all: the socket is closed, the server stays.
    socket.write_all(&[0xff; 64]).expect("open");
    let mut rest = Vec::new();
    let _ = socket.read_to_end(&mut rest);
    assert!(served.is_alive());
}

#[test]
fn a_hundred_sockets_and_slow_ones_do_not_stop_it() {
    let served = serve(project("many"), &client::OPEN);
    let sockets: Vec<_> = (0..100).map(|_| served.socket("")).collect();
    let accepted = sockets.iter().filter(|(status, _)| *status == 101).count();
    let refused = sockets.iter().filter(|(status, _)| *status == 503).count();
    assert_eq!((accepted, refused), (64, 36));
    assert!(served.is_alive());
    drop(sockets);
    // A head that never ends is closed after 10 s; meanwhile others are answered.
    let mut slow = served.connect();
    slow.write_all(b"GET / HTTP/1.1\r\nHost:").expect("open");
    // A window that asks for much and reads nothing.
    let mut deaf = loop {
        let (status, socket) = served.socket("");
        if status == 101 {
            break socket;
        }
        std::thread::sleep(Duration::from_millis(50));
    };
    for id in 0..200 {
        let question = json!({ "id": id, "ask": "open", "body": { "path": "mill/machine.toml" } });
        deaf.write_all(&frame(1, question.to_string().as_bytes())).expect("open");
    }
    assert!(served.is_alive());
    let mut rest = Vec::new();
    slow.read_to_end(&mut rest).expect("the server ends it");
    assert!(served.is_alive());
}

#[test]
fn killed_while_saving_it_leaves_the_old_file_or_the_new_one() {
    let folder = project("killed");
    let path = folder.join("mill/machine.toml");
    let old = fs::read_to_string(&path).expect("the machine");
    let new = format!("{old}{}", "# a long comment\n".repeat(200_000));
    for delay_ms in [0, 1, 2, 4, 8, 16] {
        fs::write(&path, &old).expect("the old file");
        let mut served = serve_kept(folder.clone(), &client::OPEN);
        let opened = served.ask("open", &json!({ "path": "mill/machine.toml" })).json();
        let body =
            json!({ "path": "mill/machine.toml", "text": new, "version": opened["version"] });
        let body = body.to_string();
        let mut stream = served.connect();
        let head = format!(
            "POST /api/save HTTP/1.1\r\nHost: {}\r\nContent-Type: application/json\r\nContent-Length: {}\r\n\r\n",
            served.host,
            body.len()
        );
        stream.write_all(head.as_bytes()).expect("open");
        stream.write_all(body.as_bytes()).expect("open");
        std::thread::sleep(Duration::from_millis(delay_ms));
        served.child.kill().expect("a running server");
        served.child.wait().expect("it ended");
        let there = fs::read_to_string(&path).expect("a file is there");
        assert!(there == old || there == new, "{delay_ms} ms: {} bytes", there.len());
    }
    let _ = fs::remove_dir_all(folder);
}

#[test]
fn every_shipped_example_is_listed_and_is_there() {
    let served = serve_kept(repository(), &client::OPEN);
    let listed = served.ask("project", &json!({})).json();
    let examples = listed["examples"].as_array().expect("examples").clone();
    assert!(examples.len() >= 15 && listed["diagnostics"] == json!([]), "{listed:#}");
    let files = listed["files"].as_array().expect("files");
    for example in &examples {
        for key in ["path", "machine"] {
            let Some(path) = example[key].as_str() else { continue };
            assert!(files.iter().any(|f| f["path"] == path), "{path}");
        }
    }
}

#[test]
fn answers_are_the_documents_of_the_command_line() {
    let served = serve_kept(repository(), &client::OPEN);
    let study = "examples/03_predict/nas979-on-xkas2525.toml";
    let holes = "examples/03_predict/torque-arm.toml";
    let plan = "examples/04_plan/probe-ball.toml";
    let campaign = "examples/05_identify/mixed-instruments.toml";
    let readings = "examples/07_verify/x-axis-laser.csv";
    let circle = "examples/07_verify/circle-xy.csv";
    let predict = |file| ["predict", file, "--no-report"];
    let unsampled = ["predict", study, "--no-report", "--samples", "0"];
    for (name, body, words) in [
        ("predict", json!({ "study": study }), &predict(study)[..]),
        ("what-if", json!({ "study": study }), &unsampled),
        ("predict", json!({ "study": holes }), &predict(holes)),
        (
            "plan",
            json!({ "campaign": plan, "dialect": "fanuc" }),
            &["plan", plan, "--control", "fanuc"],
        ),
        ("identify", json!({ "campaign": campaign }), &["identify", campaign]),
        (
            "evaluate",
            json!({ "standard": "iso230-2", "path": readings }),
            &["evaluate", "iso230-2", readings],
        ),
        (
            "evaluate",
            json!({ "standard": "iso230-4", "path": circle, "radius": "150 mm" }),
            &["evaluate", "iso230-4", circle, "--radius", "150"],
        ),
    ] {
        let answer = served.ask(name, &body);
        assert_eq!(answer.status, 200, "{name}: {}", String::from_utf8_lossy(&answer.body));
        let (header, mut expected) = (answer.header(), cli(words));
        // The server states the problems of the input beside the document.
        if header["document"].get("diagnostics").is_none() {
            expected.as_object_mut().map(|entries| entries.remove("diagnostics"));
        }
        assert_eq!(header["document"], expected, "{name}");
    }
}

#[test]
fn dropped_readings_count_as_those_of_the_file() {
    let served = serve_kept(repository(), &client::OPEN);
    let text = |path| fs::read_to_string(repository().join(path)).expect("readings");
    let campaign = "examples/05_identify/probe-ball.toml";
    let csv = text("examples/05_identify/probe-ball.csv");
    let body = json!({ "campaign": campaign, "name": "mine.csv", "text": csv });
    let found = served.ask("identify", &body).header();
    assert_eq!(found["document"]["errors"], cli(&["identify", campaign])["errors"]);
    let bad = format!("{csv}nonsense,1\n");
    let line = bad.lines().count();
    let body = json!({ "campaign": campaign, "name": "mine.csv", "text": bad });
    let refused = served.ask("identify", &body);
    assert_eq!(refused.status, 422);
    let first = &refused.json()["error"]["diagnostics"][0];
    assert_eq!((&first["file"], &first["line"]), (&json!("mine.csv"), &json!(line)), "{first}");
    // Two instruments: whose readings are they?
    let body = json!({ "campaign": "examples/05_identify/mixed-instruments.toml", "text": csv });
    let refused = served.ask("identify", &body);
    assert_eq!(
        (refused.status, &refused.json()["error"]["code"]),
        (422, &json!("unknown-instrument"))
    );
    let csv = text("examples/07_verify/x-axis-laser.csv");
    let body = json!({ "standard": "iso230-2", "name": "mine.csv", "text": csv,
        "conditions": "examples/07_verify/x-axis-laser.toml" });
    let judged = served.ask("evaluate", &body).header();
    let known = cli(&["evaluate", "iso230-2", "examples/07_verify/x-axis-laser.csv"]);
    assert_eq!(judged["document"]["A_um"], known["A_um"]);
}

#[test]
fn reports_are_the_pages_of_the_command_line() {
    let served = serve_kept(repository(), &client::OPEN);
    let body = json!({ "verb": "predict", "file": "examples/03_predict/cone-on-i5.toml" });
    let made = served.ask("report", &body).json();
    let url = made["url"].as_str().expect("an address");
    let page = served.send(&format!("GET {url}"), "", b"");
    assert_eq!(page.status, 200);
    assert!(page.body.starts_with(b"<!DOCTYPE html>"));
    // Its own style is allowed to it, and nothing else.
    assert!(page.head.to_ascii_lowercase().contains("style-src 'unsafe-inline'"), "{}", page.head);
    let body = json!({ "verb": "compensate", "file": "examples/03_predict/cone-on-i5.toml" });
    assert_eq!(served.ask("report", &body).status, 400);
}
