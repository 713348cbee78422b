//! A crowd of connections that are of no use does not keep the page from anyone.

use std::io::{Read, Write};
use std::net::{SocketAddr, TcpStream};
use std::path::{Path, PathBuf};
use std::time::Duration;
use trueaxis_serve::{Options, Server};

/// How long a page may take.
const PATIENCE: Duration = Duration::from_secs(2);

/// A server on a folder of its own, in a thread that ends with the test.
struct Served {
    folder: PathBuf,
    address: SocketAddr,
    token: String,
}

impl Served {
    fn new(name: &str, token: bool) -> Self {
        let folder =
            std::env::temp_dir().join(format!("trueaxis-crowd-{name}-{}", std::process::id()));
        std::fs::create_dir_all(folder.join("examples")).unwrap();
        let options =
            Options { folder: folder.clone(), port: Some(0), token, ..Options::default() };
        let server = Server::bind(&options).unwrap();
        let url = server.address().trim_start_matches("http://").to_owned();
        let (host, query) = url.split_once('/').unwrap();
        let token = query.trim_start_matches("?token=").to_owned();
        std::thread::spawn(move || server.run());
        Self { folder, address: host.parse().unwrap(), token }
    }

    fn connect(&self) -> TcpStream {
        let stream = TcpStream::connect_timeout(&self.address, PATIENCE).unwrap();
        stream.set_read_timeout(Some(PATIENCE)).unwrap();
        stream
    }

    fn head(&self, first_line: &str, more: &str) -> String {
        let (host, token) = (self.address, &self.token);
        format!(
            "{first_line} HTTP/1.1\r\nHost: {host}\r\nAuthorization: Bearer {token}\r\n{more}\r\n"
        )
    }

    /// The status of an answer within the time that a page may take.
    fn status(&self, request: &str) -> Option<u16> {
        let mut stream = self.connect();
        stream.write_all(request.as_bytes()).ok()?;
        let mut start = [0; 12];
        stream.read_exact(&mut start).ok()?;
        String::from_utf8_lossy(&start).rsplit(' ').next()?.parse().ok()
    }

    fn page(&self) -> Option<u16> {
        self.status(&self.head("GET /", ""))
    }

    fn question(&self) -> Option<u16> {
        let kind = "Content-Type: application/json\r\nContent-Length: 2\r\n";
        self.status(&format!("{}{{}}", self.head("POST /api/project", kind)))
    }

    /// So many bodies that begin and do not go on.
    fn slow_bodies(&self, number: usize) -> Vec<TcpStream> {
        let kind = "Content-Type: application/json\r\nContent-Length: 1000\r\n";
        let head = self.head("POST /api/project", kind);
        let slow = |_| {
            let mut stream = self.connect();
            // One that has to go may be closed already.
            let _ = stream.write_all(format!("{head}{{").as_bytes());
            stream
        };
        (0..number).map(slow).collect()
    }

    fn silent(&self, number: usize) -> Vec<TcpStream> {
        (0..number).map(|_| self.connect()).collect()
    }
}

impl Drop for Served {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.folder);
    }
}

/// How many of some connections the server has not closed.
fn open(streams: &mut [TcpStream]) -> usize {
    let is_open = |stream: &mut TcpStream| {
        stream.set_nonblocking(true).unwrap();
        match stream.peek(&mut [0]) {
            Err(error) => error.kind() == std::io::ErrorKind::WouldBlock,
            Ok(_) => false,
        }
    };
    streams.iter_mut().map(is_open).filter(|open| *open).count()
}

#[test]
fn slow_bodies_and_silent_sockets_do_not_keep_the_page_from_anyone() {
    let served = Served::new("both", false);
    assert_eq!((served.page(), served.question()), (Some(200), Some(200)));
    let mut slow = served.slow_bodies(300);
    let mut silent = served.silent(256);
    for _ in 0..3 {
        assert_eq!((served.page(), served.question()), (Some(200), Some(200)));
    }
    // The youngest of each kind are still served: up to 16 bodies and 64 heads.
    let (slow_left, silent_left) = (open(&mut slow), open(&mut silent));
    assert!((1..=16).contains(&slow_left), "{slow_left}");
    assert!((32..=64).contains(&silent_left), "{silent_left}");
    // A body that stands still is refused after 5 s, not after 60.
    std::thread::sleep(Duration::from_millis(5_500));
    assert_eq!(open(&mut slow), 0);
    assert_eq!((served.page(), served.question()), (Some(200), Some(200)));
}

#[test]
fn those_without_the_token_cost_each_other_their_places() {
    let served = Served::new("token", true);
    let silent = served.silent(256);
    let wrong = served.head("GET /", "").replace(&served.token, "0");
    for _ in 0..100 {
        assert_eq!(served.status(&wrong), Some(401));
    }
    assert_eq!((served.page(), served.question()), (Some(200), Some(200)));
    drop(silent);
}

/// A page by `GET`, in whole.
fn whole(served: &Served, request: &str) -> String {
    let mut stream = served.connect();
    stream
        .write_all(request.replace("\r\n\r\n", "\r\nConnection: close\r\n\r\n").as_bytes())
        .unwrap();
    let mut all = String::new();
    stream.read_to_string(&mut all).unwrap();
    all
}

#[test]
fn the_link_opens_the_page_and_the_page_without_it_says_so() {
    let served = Served::new("link", true);
    let bare = format!("GET / HTTP/1.1\r\nHost: {}\r\n\r\n", served.address);
    let said = whole(&served, &bare);
    assert!(said.starts_with("HTTP/1.1 401") && said.contains("the whole link"), "{said}");
    let entered = whole(&served, &bare.replace("GET /", &format!("GET /?token={}", served.token)));
    assert!(entered.starts_with("HTTP/1.1 303"), "{entered}");
    let cookie = entered.lines().find_map(|l| l.strip_prefix("set-cookie: ")).unwrap();
    assert!(cookie.ends_with("Path=/; HttpOnly; SameSite=Strict"), "{cookie}");
    let pair = cookie.split(';').next().unwrap();
    let with = bare.replace("\r\n\r\n", &format!("\r\nCookie: {pair}\r\n\r\n"));
    assert!(whole(&served, &with).starts_with("HTTP/1.1 200"));
}

#[cfg(unix)]
#[test]
fn a_pipe_in_the_folder_is_not_waited_for() {
    let served = Served::new("pipe", false);
    for name in ["machine.toml", "log.csv", "examples/index.toml"] {
        let made = std::process::Command::new("mkfifo").arg(served.folder.join(name)).status();
        assert!(made.unwrap().success());
    }
    std::fs::write(served.folder.join("other.toml"), "a = 1\n").unwrap();
    let kind = "Content-Type: application/json\r\nContent-Length: 2\r\n";
    let request = format!("{}{{}}", served.head("POST /api/project", kind));
    let listed = whole(&served, &request);
    assert!(listed.contains("other.toml") && !listed.contains("log.csv"), "{listed}");
    assert!(listed.starts_with("HTTP/1.1 200"), "{listed}");
}

#[test]
fn without_a_token_it_listens_on_this_computer_only() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).to_owned();
    let ip = std::net::Ipv4Addr::UNSPECIFIED.into();
    let options = Options { folder, ip, port: Some(0), token: false, origins: Vec::new() };
    let refused = Server::bind(&options).err().unwrap();
    assert_eq!(refused.kind(), std::io::ErrorKind::InvalidInput);
    let origins = vec!["https://mill.example/page".to_owned()];
    let refused = Server::bind(&Options { origins, token: true, ..options }).err().unwrap();
    assert_eq!(refused.kind(), std::io::ErrorKind::InvalidInput);
}
