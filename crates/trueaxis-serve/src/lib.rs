//! The loop in a browser: a local server with the page in it.
//!
//! ```text
//!     page ──POST /api/<name>──┐
//!          ──socket────────────┴─> web ──guard──> desk::answer ──> answers/<tab>.rs ──> trueaxis
//!                                                   └─ in turn, in time, within the project folder
//! ```
//!
//! All computing is done by the crates below; here requests become calls, and results become JSON
//! (the documents of the command line) or binary pieces ([decision 13]). The server listens on loopback
//! only, unless an address is given; every request needs the token of the printed link.
//!
//! ```no_run
//! let server = trueaxis_serve::Server::bind(&trueaxis_serve::Options {
//!     folder: ".".into(),
//!     ..trueaxis_serve::Options::default()
//! })?;
//! println!("{}", server.address());
//! server.run()?;
//! # Ok::<(), std::io::Error>(())
//! ```
//!
//! What it does not do: it is no server for the internet (no TLS, one token for all), and it does not
//! guard against a change of links inside the project folder while it reads.
//!
//! [decision 13]: https://github.com/

mod addresses;
mod answers;
mod body;
mod change;
mod desk;
mod frame;
mod guard;
mod kept;
mod made;
mod page;
mod places;
mod project;
mod refusal;
mod request;
#[cfg(feature = "schemas")]
mod schemas;
mod sending;
mod simulated;
mod socket;
mod turn;
mod watch;
mod web;

#[cfg(feature = "schemas")]
pub use schemas::schemas;

pub use addresses::Link;
use desk::Desk;
use guard::{Guard, Origin};
use hyper_util::rt::{TokioIo, TokioTimer};
use hyper_util::service::TowerToHyperService;
use places::Places;
use project::Project;
use std::io;
use std::net::{IpAddr, Ipv4Addr, SocketAddr, TcpListener};
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;

/// The port where one looks first.
pub const USUAL_PORT: u16 = 7841;

/// How long the head of a request may take.
const HEAD: Duration = Duration::from_secs(10);

/// How long a reader may take none of what was sent.
const UNREAD: Duration = Duration::from_secs(30);

/// What is shown, and where.
#[derive(Debug, Clone)]
pub struct Options {
    /// The project folder; nothing outside it is read or written.
    pub folder: PathBuf,
    /// Where to listen.
    pub ip: IpAddr,
    /// At which port; without one the usual one, or any that is free.
    pub port: Option<u16>,
    /// Whether every request needs a token; without one, every user of this computer may read and save. Beyond loopback
    /// there must be one.
    pub token: bool,
    /// The origins of proxies by which the page is reached, such as `https://mill.example`.
    pub origins: Vec<String>,
}

impl Default for Options {
    fn default() -> Self {
        let ip = Ipv4Addr::LOCALHOST.into();
        Self { folder: ".".into(), ip, port: None, token: true, origins: Vec::new() }
    }
}

/// A server that is ready to run.
pub struct Server {
    listener: TcpListener,
    links: Vec<Link>,
    router: axum::Router,
}

impl Server {
    /// Takes the port and the folder; the working directory becomes the folder, so that files are
    /// called by the same names here and in the page.
    ///
    /// # Errors
    /// If the folder is none, or the port is taken; `InvalidInput` for an origin that is none, and beyond loopback
    /// without a token.
    pub fn bind(options: &Options) -> io::Result<Self> {
        let invalid = |message: String| io::Error::new(io::ErrorKind::InvalidInput, message);
        let loopback = options.ip.is_loopback();
        if !loopback && !options.token {
            let message = "--no-token is for this computer only: from others everyone could read and save the files";
            return Err(invalid(message.to_owned()));
        }
        let origins: Result<Vec<Origin>, String> =
            options.origins.iter().map(|origin| Origin::parse(origin)).collect();
        let origins = origins.map_err(invalid)?;
        let project = Project::of(&options.folder)?;
        std::env::set_current_dir(project.root())?;
        let listener = listen(options)?;
        listener.set_nonblocking(true)?;
        let own = listener.local_addr()?;
        let token = if options.token { Some(token()?) } else { None };
        let links = addresses::links(own, token.as_deref(), &origins);
        let guard = Guard { loopback, port: own.port(), token, origins };
        let desk = Arc::new(Desk::of(project));
        watch::watch(&desk);
        Ok(Self { listener, links, router: web::router(desk, guard) })
    }

    /// The address to open, with the token if one is needed.
    pub fn address(&self) -> &str {
        self.links.first().map_or("", |link| &link.url)
    }

    /// All addresses by which the page is reached, that of [`Server::address`] first.
    pub fn links(&self) -> &[Link] {
        &self.links
    }

    /// Serves until the program ends.
    ///
    /// # Errors
    /// If the system gives no threads or takes the listener away.
    pub fn run(self) -> io::Result<()> {
        let runtime = tokio::runtime::Builder::new_multi_thread().enable_all().build()?;
        runtime.block_on(accept(self.listener, self.router))
    }
}

fn listen(options: &Options) -> io::Result<TcpListener> {
    let at = |port| TcpListener::bind(SocketAddr::new(options.ip, port));
    match options.port {
        Some(port) => at(port),
        None => at(USUAL_PORT).or_else(|_| at(0)),
    }
}

/// 128 bits that cannot be guessed.
fn token() -> io::Result<String> {
    let mut bytes = [0; 16];
    getrandom::fill(&mut bytes).map_err(|e| io::Error::other(e.to_string()))?;
    Ok(bytes.iter().map(|b| format!("{b:02x}")).collect())
}

async fn accept(listener: TcpListener, router: axum::Router) -> io::Result<()> {
    let listener = tokio::net::TcpListener::from_std(listener)?;
    let places = Places::default();
    loop {
        let Ok((stream, _)) = listener.accept().await else {
            // Out of file handles, say: others must go first.
            tokio::time::sleep(Duration::from_millis(50)).await;
            continue;
        };
        let place = Arc::new(places.enter());
        let service = TowerToHyperService::new(web::at_place(&router, place.clone()));
        tokio::spawn(async move {
            let _ = stream.set_nodelay(true);
            let mut stream = tokio_io_timeout::TimeoutStream::new(stream);
            stream.set_write_timeout(Some(UNREAD));
            let mut http = hyper::server::conn::http1::Builder::new();
            http.timer(TokioTimer::new()).header_read_timeout(HEAD);
            let connection = http.serve_connection(TokioIo::new(Box::pin(stream)), service);
            tokio::select! {
                // A connection that breaks off is no fault of the server.
                _ = connection.with_upgrades() => {}
                () = place.ended() => {}
            }
        });
    }
}
