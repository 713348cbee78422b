//! A server of its own for each test, and a plain client that may be as rude as it likes.

use serde_json::{Value, json};
use std::fs;
use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::Duration;

/// At any free port, without a token.
pub const OPEN: [&str; 3] = ["--port", "0", "--no-token"];

/// A running `trueaxis serve`; it ends with the test.
pub struct Served {
    pub child: Child,
    pub folder: PathBuf,
    pub host: String,
    /// The folder was made for the test and goes with it.
    made: bool,
}

impl Drop for Served {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
        if self.made {
            let _ = fs::remove_dir_all(&self.folder);
        }
    }
}

pub fn repository() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// What the command line says in JSON, asked in the repository.
pub fn cli(words: &[&str]) -> Value {
    let mut command = Command::new(env!("CARGO_BIN_EXE_trueaxis"));
    let done = command.args(words).args(["--format", "json"]).current_dir(repository()).output();
    serde_json::from_slice(&done.expect("the command").stdout).expect("JSON")
}

/// A project with one machine in it.
pub fn project(name: &str) -> PathBuf {
    let folder = std::env::temp_dir().join(format!("trueaxis-serve-{name}-{}", std::process::id()));
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(folder.join("mill")).expect("a folder for the test");
    let machine = repository().join("machines/three-axis-mill/machine.toml");
    fs::copy(machine, folder.join("mill/machine.toml")).expect("the shipped machine");
    folder
}

/// Serves a folder that [`project`] made.
pub fn serve(folder: PathBuf, arguments: &[&str]) -> Served {
    let mut served = serve_kept(folder, arguments);
    served.made = true;
    served
}

/// Serves a folder that stays.
pub fn serve_kept(folder: PathBuf, arguments: &[&str]) -> Served {
    let mut child = Command::new(env!("CARGO_BIN_EXE_trueaxis"))
        .arg("serve")
        .arg(&folder)
        .args(arguments)
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()
        .expect("the command");
    let mut line = String::new();
    let stdout = child.stdout.take().expect("its output");
    BufReader::new(stdout).read_line(&mut line).expect("the address");
    let host = line.trim().trim_start_matches("http://").trim_end_matches('/').to_owned();
    Served { child, folder, host, made: false }
}

/// What came back: status, head, body.
pub struct Answer {
    pub status: u16,
    pub head: String,
    pub body: Vec<u8>,
}

impl Answer {
    pub fn json(&self) -> Value {
        serde_json::from_slice(&self.body).expect("JSON")
    }

    /// The header of a binary answer.
    pub fn header(&self) -> Value {
        let (length, rest) = self.body.split_first_chunk().expect("a length");
        let length = u32::from_le_bytes(*length) as usize;
        serde_json::from_slice(&rest[..length]).expect("a JSON header")
    }
}

impl Served {
    pub fn connect(&self) -> TcpStream {
        let address = self.host.split('/').next().expect("host and port");
        let stream = TcpStream::connect(address).expect("a server");
        stream.set_read_timeout(Some(Duration::from_secs(30))).expect("a time limit");
        stream
    }

    /// Sends bytes as they are and reads until the server closes.
    pub fn raw(&self, request: &[u8]) -> Answer {
        let mut stream = self.connect();
        // A refused request may be closed before it is sent to its end.
        let _ = stream.write_all(request);
        let mut all = Vec::new();
        let _ = stream.read_to_end(&mut all);
        let end = all.windows(4).position(|w| w == b"\r\n\r\n").map_or(all.len(), |at| at + 4);
        let head = String::from_utf8_lossy(&all[..end]).into_owned();
        let status = head.split(' ').nth(1).and_then(|s| s.parse().ok()).unwrap_or(0);
        Answer { status, head, body: all[end..].to_vec() }
    }

    pub fn send(&self, first_line: &str, headers: &str, body: &[u8]) -> Answer {
        let host = if headers.contains("Host:") { "" } else { &format!("Host: {}\r\n", self.host) };
        let head = format!("{first_line} HTTP/1.1\r\n{host}Connection: close\r\n{headers}");
        let length = format!("Content-Length: {}\r\n\r\n", body.len());
        self.raw(&[head.as_bytes(), length.as_bytes(), body].concat())
    }

    pub fn ask(&self, name: &str, body: &Value) -> Answer {
        let headers = "Content-Type: application/json\r\n";
        self.send(&format!("POST /api/{name}"), headers, body.to_string().as_bytes())
    }

    /// It still answers.
    pub fn is_alive(&self) -> bool {
        self.ask("project", &json!({})).status == 200
    }

    /// Opens a socket; the status is 101 if it was accepted.
    pub fn socket(&self, headers: &str) -> (u16, TcpStream) {
        let mut stream = self.connect();
        let request = format!(
            "GET /api/socket HTTP/1.1\r\nHost: {}\r\nConnection: Upgrade\r\nUpgrade: websocket\r\n\
             Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n{headers}\r\n",
            self.host
        );
        stream.write_all(request.as_bytes()).expect("the server listens");
        let mut head = Vec::new();
        let mut byte = [0];
        while !head.ends_with(b"\r\n\r\n") && stream.read(&mut byte).is_ok_and(|n| n == 1) {
            head.push(byte[0]);
        }
        let head = String::from_utf8_lossy(&head);
        (head.split(' ').nth(1).and_then(|s| s.parse().ok()).unwrap_or(0), stream)
    }
}

/// A frame of a WebSocket from a client: masked, in one piece.
pub fn frame(opcode: u8, payload: &[u8]) -> Vec<u8> {
    let mut bytes = vec![0x80 | opcode];
    match payload.len() {
        n @ 0..126 => bytes.push(0x80 | n as u8),
        n @ 126..65536 => {
            bytes.push(0x80 | 126);
            bytes.extend((n as u16).to_be_bytes());
        }
        n => {
            bytes.push(0x80 | 127);
            bytes.extend((n as u64).to_be_bytes());
        }
    }
    // A mask of zeros leaves the payload as it is.
    bytes.extend([0; 4]);
    bytes.extend(payload);
    bytes
}

/// The next frame of the server: opcode and payload.
pub fn next(stream: &mut TcpStream) -> Option<(u8, Vec<u8>)> {
    let mut head = [0; 2];
    stream.read_exact(&mut head).ok()?;
    let length = match head[1] & 0x7f {
        126 => {
            let mut long = [0; 2];
            stream.read_exact(&mut long).ok()?;
            usize::from(u16::from_be_bytes(long))
        }
        127 => {
            let mut long = [0; 8];
            stream.read_exact(&mut long).ok()?;
            u64::from_be_bytes(long) as usize
        }
        short => usize::from(short),
    };
    let mut payload = vec![0; length];
    stream.read_exact(&mut payload).ok()?;
    Some((head[0] & 0x0f, payload))
}

/// Asks over a socket and waits for the answer of that number.
pub fn ask_socket(stream: &mut TcpStream, question: &Value) -> Value {
    stream.write_all(&frame(1, question.to_string().as_bytes())).expect("an open socket");
    loop {
        let (opcode, payload) = next(stream).expect("an answer");
        let Ok(value) = serde_json::from_slice::<Value>(&payload) else { continue };
        if opcode == 1 && value["id"] == question["id"] && value.get("progress").is_none() {
            return value;
        }
    }
}
