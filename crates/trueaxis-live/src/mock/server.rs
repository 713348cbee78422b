//! A mock on a socket.

use super::fanuc::FanucMock;
use crate::focas::codec::{HEADER, Kind, header};
use std::io::{self, Read, Write};
use std::net::{SocketAddr, TcpListener, TcpStream};
use std::sync::{Arc, Mutex};
use std::thread;
use std::time::{Duration, Instant};

/// A client that says nothing for so long is gone.
const IDLE: Duration = Duration::from_secs(600);

/// A mock that answers clients until the program ends; it goes on by the clock of the computer.
#[derive(Debug)]
pub struct MockServer {
    mock: Arc<Mutex<FanucMock>>,
    address: SocketAddr,
}

impl MockServer {
    /// Listens at an address such as `127.0.0.1:8193`; port 0 takes any that is free.
    ///
    /// # Errors
    /// What the system says.
    pub fn start(mock: FanucMock, address: &str) -> io::Result<Self> {
        let listener = TcpListener::bind(address)?;
        let address = listener.local_addr()?;
        let mock = Arc::new(Mutex::new(mock));
        let (shared, start) = (Arc::clone(&mock), Instant::now());
        thread::spawn(move || {
            for stream in listener.incoming().flatten() {
                let mock = Arc::clone(&shared);
                thread::spawn(move || serve(stream, &mock, start));
            }
        });
        Ok(Self { mock, address })
    }

    /// Where it listens.
    pub fn address(&self) -> SocketAddr {
        self.address
    }

    /// Waits: so long, or until the program ends.
    pub fn wait(&self, for_s: Option<f64>) {
        match for_s {
            Some(for_s) => thread::sleep(Duration::from_secs_f64(for_s.clamp(0.0, 1e9))),
            None => loop {
                thread::park();
            },
        }
    }

    /// The mock itself.
    pub fn mock(&self) -> &Mutex<FanucMock> {
        &self.mock
    }
}

/// Until the client leaves, or sends what no control understands.
fn serve(mut stream: TcpStream, mock: &Mutex<FanucMock>, start: Instant) {
    let _ = stream.set_read_timeout(Some(IDLE));
    let _ = stream.set_nodelay(true);
    let mut counter = 0;
    while let Some(frame) = received(&mut stream) {
        let Ok(kind) = header(&frame).map(|header| header.kind) else { return };
        if kind == Kind::Hello {
            counter = frame.last().copied().unwrap_or(0);
        } else if kind == Kind::Asked && counter != 2 {
            // Calls on the connection for files: a control hangs up.
            return;
        }
        let Ok(mut mock) = mock.lock() else { return };
        mock.advance(start.elapsed().as_secs_f64());
        let faults = mock.faults.clone();
        if faults.cut {
            return;
        }
        let Some(answer) = mock.answer(&frame).filter(|_| !faults.frozen) else {
            if faults.frozen {
                continue;
            }
            return;
        };
        drop(mock);
        if faults.latency_s > 0.0 {
            thread::sleep(Duration::from_secs_f64(faults.latency_s.min(10.0)));
        }
        if stream.write_all(&answer).is_err() || kind == Kind::Close {
            return;
        }
    }
}

fn received(stream: &mut TcpStream) -> Option<Vec<u8>> {
    let mut bytes = vec![0; HEADER];
    stream.read_exact(&mut bytes).ok()?;
    let length = header(&bytes).ok()?.length;
    bytes.resize(HEADER + length, 0);
    stream.read_exact(&mut bytes[HEADER..]).ok()?;
    Some(bytes)
}
