//! What a request may say, and how it is refused: as JSON, by the same rules as on the command line.

use serde_json::{Value, json};
use std::io::{Read, Write};
use std::net::{SocketAddr, TcpStream};
use std::path::{Path, PathBuf};
use std::sync::OnceLock;
use trueaxis::files::disk;
use trueaxis::input::Diagnostics;
use trueaxis::questions::MachineChoice;
use trueaxis_serve::{Options, Server};

const MILL: &str = "machines/three-axis-mill/machine.toml";

/// One server on the project for all tests: the working directory of the process is its folder.
fn server() -> SocketAddr {
    static SERVER: OnceLock<SocketAddr> = OnceLock::new();
    *SERVER.get_or_init(|| {
        let folder: PathBuf = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
        let options = Options { folder, port: Some(0), token: false, ..Options::default() };
        let server = Server::bind(&options).unwrap();
        let url = server.address().trim_start_matches("http://").trim_end_matches('/').to_owned();
        std::thread::spawn(move || server.run());
        url.parse().unwrap()
    })
}

/// Status, kind and body of an answer.
fn send(method: &str, path: &str, kind: &str, body: &str) -> (u16, Value) {
    let host = server();
    let mut stream = TcpStream::connect(host).unwrap();
    let head = format!(
        "{method} {path} HTTP/1.1\r\nHost: {host}\r\nConnection: close\r\nContent-Type: {kind}\r\nContent-Length: {}\r\n",
        body.len()
    );
    stream.write_all(format!("{head}\r\n{body}").as_bytes()).unwrap();
    let mut answer = Vec::new();
    stream.read_to_end(&mut answer).unwrap();
    let answer = String::from_utf8_lossy(&answer);
    let (head, body) = answer.split_once("\r\n\r\n").unwrap();
    let status = head.split(' ').nth(1).unwrap().parse().unwrap();
    (status, serde_json::from_str(body).unwrap_or_else(|_| json!(body)))
}

fn ask(name: &str, body: &str) -> (u16, Value) {
    send("POST", &format!("/api/{name}"), "application/json", body)
}

/// The code and the message of a refusal.
fn refused(answer: &Value) -> (&str, &str) {
    let text = |key| answer["error"][key].as_str().unwrap_or_else(|| panic!("{answer}"));
    (text("code"), text("message"))
}

#[test]
fn what_is_not_asked_rightly_is_refused_as_json() {
    let duplicate = format!(r#"{{"machine": "{MILL}", "at": {{"X": 1, "X": 500}}}}"#);
    let (status, answer) = ask("pose", &duplicate);
    assert_eq!(status, 400);
    assert!(refused(&answer).1.contains("`X` stands twice"), "{answer}");
    for (method, path, due) in [
        ("GET", "/api/project", (405, "other-method")),
        ("PUT", "/", (405, "other-method")),
        ("POST", "/report/1", (415, "not-json")),
        ("DELETE", "/made/1/0", (405, "other-method")),
        ("GET", "/api/socket", (400, "bad-request")),
        ("GET", "/report/x", (404, "not-found")),
        ("GET", "/made/-1/0", (404, "not-found")),
        ("GET", "/made/999999999999999999999/0", (404, "not-found")),
        ("GET", "/nothing", (404, "not-found")),
    ] {
        let (status, answer) = send(method, path, "text/plain", "");
        assert_eq!((status, refused(&answer).0), due, "{method} {path}");
    }
    let kinds = ["APPLICATION/JSON", "Application/Json; charset=utf-8"];
    for kind in kinds {
        assert_eq!(send("POST", "/api/compensate-targets", kind, "{}").0, 200, "{kind}");
    }
}

#[test]
fn a_program_is_a_file_or_a_text() {
    for more in [json!({ "name": "a.nc", "text": "G1 X1\n" }), json!({ "name": "a.nc" })] {
        let mut body = json!({ "machine": MILL, "program": "examples/02_simulate/square-g41.nc" });
        body.as_object_mut().unwrap().extend(more.as_object().unwrap().clone());
        for name in ["simulate", "trace"] {
            if name == "trace" {
                body["line"] = json!(1);
            }
            let (status, answer) = ask(name, &body.to_string());
            assert_eq!((status, refused(&answer).0), (400, "bad-request"), "{answer}");
        }
    }
}

#[test]
fn a_position_is_quoted_as_it_was_sent() {
    let (status, answer) =
        ask("pose", &format!(r#"{{"machine": "{MILL}", "at": {{"X": 1e300}}}}"#));
    let (code, message) = refused(&answer);
    assert_eq!((status, code), (422, "too-large"));
    assert!(message.contains("X: `1e300`") && message.len() < 200, "{message}");
}

/// The same check, the same message: `MachineChoice` is the machine of every command.
#[test]
fn lengths_of_tools_are_judged_as_on_the_command_line() {
    let study = "examples/03_predict/cone-on-i5.toml";
    server();
    for typed in ["160000", "1e300", "100"] {
        let choice = MachineChoice {
            file: MILL.into(),
            tool_length: Some(typed.to_owned()),
            ..MachineChoice::default()
        };
        let mut problems = Diagnostics::new();
        choice.read(&disk(), &mut problems);
        let due = problems.iter().find(|d| d.place.to_string().contains("--tool-length"));
        for (name, body) in [
            ("pose", format!(r#"{{"machine": "{MILL}", "tool_length_mm": {typed}}}"#)),
            ("what-if", format!(r#"{{"study": "{study}", "tool_length_mm": {typed}}}"#)),
        ] {
            let (status, answer) = ask(name, &body);
            match due {
                Some(due) if problems.has_errors() => {
                    assert_eq!(status, 422, "{name} {typed}");
                    let (code, message) = refused(&answer);
                    assert_eq!(code, due.code);
                    assert!(message.ends_with(&due.message), "{message}: {}", due.message);
                }
                _ => assert_eq!(status, 200, "{name} {typed}: {answer}"),
            }
        }
    }
}
