//! `trueaxis serve`: the page on this computer.

use crate::output::{Outcome, tell};
use crate::report_file::unusable;
use clap::Args;
use std::io::{ErrorKind, Write};
use std::net::IpAddr;
use std::path::PathBuf;
use std::process::{Command, Stdio};
use trueaxis_serve::{Options, Server};

/// The project to show.
#[derive(Args)]
#[command(after_help = "\
Examples:
  trueaxis serve                        the current folder
  trueaxis serve ~/my-machine --open
  trueaxis serve --listen 0.0.0.0 --port 8080
  trueaxis serve --origin https://mill.example    with a proxy for TLS

Prints the link and serves until Ctrl-C. The link ends in a token, another one at every start;
requests without it are refused, so that other users of this computer do not read or save your
files. Open the whole link; a script sends `Authorization: Bearer TOKEN`. --no-token gives the token
up where you are the only user. Nothing outside the folder is read or written.

Only this computer has access, unless --listen is given. There is no encryption: outside a trusted
network use a proxy with TLS on this computer that passes https://mill.example on to the port, and
name that address by --origin; the page is refused under any other. Exit status: 2 if the folder,
the port or an option cannot be used.")]
pub struct Arguments {
    /// The project folder: machine files, programs, studies, readings
    #[arg(value_name = "FOLDER", default_value = ".")]
    folder: PathBuf,
    /// Also accept connections from other computers: an address of this computer, or 0.0.0.0 for all of them
    #[arg(long, value_name = "ADDRESS", default_value = "127.0.0.1")]
    listen: IpAddr,
    /// The port; without it 7841, or any that is free
    #[arg(long, value_name = "N")]
    port: Option<u16>,
    /// The address of a proxy by which the page is reached, such as https://mill.example; may be repeated
    #[arg(long, value_name = "URL")]
    origin: Vec<String>,
    /// Let every user of this computer read and save without a token; not with an address of the network
    #[arg(long)]
    no_token: bool,
    /// Start the browser
    #[arg(long)]
    open: bool,
}

pub fn run(arguments: &Arguments) -> Outcome {
    let folder = arguments.folder.display().to_string();
    let options = Options {
        folder: arguments.folder.clone(),
        ip: arguments.listen,
        port: arguments.port,
        token: !arguments.no_token,
        origins: arguments.origin.clone(),
    };
    let server = match Server::bind(&options) {
        Ok(server) => server,
        Err(error) => {
            let hint = match error.kind() {
                ErrorKind::InvalidInput => "see trueaxis serve --help",
                _ => "name a folder that exists, and a --port that no other program uses",
            };
            return unusable("cannot-serve", &folder, &format!("cannot be served: {error}"), hint);
        }
    };
    let address = server.address();
    let mut stdout = std::io::stdout().lock();
    // The output may not be read by anyone; the server runs all the same.
    let _ = writeln!(stdout, "{address}").and_then(|()| stdout.flush());
    drop(stdout);
    let further = server.links().iter().skip(1);
    further.for_each(|link| tell(&format!("{}: {}", link.from, link.url)));
    tell(&format!("serving {folder}; Ctrl-C ends it"));
    if arguments.open && !opened(address) {
        tell("no browser could be started: open the address above");
    }
    match server.run() {
        Ok(()) => Outcome::Done,
        Err(error) => {
            let message = format!("the server stopped: {error}");
            unusable("cannot-serve", &folder, &message, "start it again")
        }
    }
}

/// Starts the browser of the desktop.
fn opened(address: &str) -> bool {
    let starters: &[&[&str]] = match std::env::consts::OS {
        "windows" => &[&["rundll32", "url.dll,FileProtocolHandler"]],
        "macos" => &[&["open"]],
        _ => &[&["xdg-open"], &["x-www-browser"], &["firefox"], &["chromium"]],
    };
    starters.iter().any(|words| {
        let mut command = Command::new(words[0]);
        command.args(&words[1..]).arg(address);
        command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null()).spawn().is_ok()
    })
}
