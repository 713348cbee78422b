//! How frames get to a control and back.

use super::codec::{HEADER, Kind, close, header, hello};
use crate::control::LinkFault;
use std::io::{Read, Write};
use std::net::{SocketAddr, TcpStream, ToSocketAddrs};
use std::time::{Duration, Instant};

/// After a failure the next connection is tried so much later, s; twice as long each time, at most …
const FIRST_PAUSE_S: f64 = 0.5;
/// … this, s.
const LONGEST_PAUSE_S: f64 = 8.0;

/// Sends a frame and brings the one that answers it.
pub trait Wire {
    /// One exchange, with its connection opened where there is none. After any fault the connection is closed, so that a
    /// late answer is never taken for the next one.
    ///
    /// # Errors
    /// [`LinkFault`], within the time limit.
    fn exchange(&mut self, frame: &[u8], now_s: f64) -> Result<Vec<u8>, LinkFault>;

    /// Whether there is a connection.
    fn is_open(&self) -> bool;

    /// Closes the connection, after an answer that is none.
    fn reset(&mut self, now_s: f64);
}

/// Two connections: a greeting with counter 1, which stays idle, and one with counter 2 for the calls.
#[derive(Debug)]
pub struct TcpWire {
    address: String,
    timeout: Duration,
    open: Option<(TcpStream, TcpStream)>,
    /// Not tried before, s.
    next_s: f64,
    pause_s: f64,
}

impl TcpWire {
    /// To `host:port`, with a time limit for every exchange.
    pub fn new(address: &str, timeout_s: f64) -> Self {
        let timeout = Duration::from_secs_f64(timeout_s.clamp(0.001, 60.0));
        let address = address.to_owned();
        Self { address, timeout, open: None, next_s: 0.0, pause_s: FIRST_PAUSE_S }
    }

    fn silent(&self) -> LinkFault {
        LinkFault::Silent { millis: u32::try_from(self.timeout.as_millis()).unwrap_or(u32::MAX) }
    }

    fn open(&mut self, now_s: f64) -> Result<(), LinkFault> {
        if now_s < self.next_s {
            return Err(LinkFault::Down { reason: "waits before the next attempt".to_owned() });
        }
        let until = Instant::now() + self.timeout;
        let address = resolved(&self.address)?;
        let first = self.greeted(address, 1, until)?;
        let second = self.greeted(address, 2, until)?;
        self.open = Some((first, second));
        self.pause_s = FIRST_PAUSE_S;
        Ok(())
    }

    fn greeted(
        &self,
        to: SocketAddr,
        counter: u16,
        until: Instant,
    ) -> Result<TcpStream, LinkFault> {
        let mut stream = TcpStream::connect_timeout(&to, self.left(until)?).map_err(down)?;
        stream.set_nodelay(true).map_err(down)?;
        let answer = self.sent(&mut stream, &hello(counter), until)?;
        match header(&answer).map(|header| header.kind) {
            Ok(Kind::HelloBack) => Ok(stream),
            _ => {
                Err(LinkFault::Garbage { reason: "the greeting is not answered by one".to_owned() })
            }
        }
    }

    fn left(&self, until: Instant) -> Result<Duration, LinkFault> {
        until
            .checked_duration_since(Instant::now())
            .filter(|d| !d.is_zero())
            .ok_or_else(|| self.silent())
    }

    fn sent(
        &self,
        stream: &mut TcpStream,
        frame: &[u8],
        until: Instant,
    ) -> Result<Vec<u8>, LinkFault> {
        stream.set_write_timeout(Some(self.left(until)?)).map_err(down)?;
        stream.write_all(frame).map_err(|e| self.fault(&e))?;
        let mut bytes = self.received(stream, HEADER, until)?;
        let found =
            header(&bytes).map_err(|fault| LinkFault::Garbage { reason: fault.to_string() })?;
        bytes.extend(self.received(stream, found.length, until)?);
        Ok(bytes)
    }

    fn received(
        &self,
        stream: &mut TcpStream,
        length: usize,
        until: Instant,
    ) -> Result<Vec<u8>, LinkFault> {
        let (mut bytes, mut filled) = (vec![0; length], 0);
        // The limit is for all of it: one byte at a time does not stretch it.
        while filled < length {
            stream.set_read_timeout(Some(self.left(until)?)).map_err(down)?;
            match stream.read(&mut bytes[filled..]) {
                Ok(0) => {
                    return Err(LinkFault::Down { reason: "the control has closed it".to_owned() });
                }
                Ok(count) => filled += count,
                Err(e) if e.kind() == std::io::ErrorKind::Interrupted => {}
                Err(e) => return Err(self.fault(&e)),
            }
        }
        Ok(bytes)
    }

    fn fault(&self, error: &std::io::Error) -> LinkFault {
        use std::io::ErrorKind::{TimedOut, WouldBlock};
        match error.kind() {
            TimedOut | WouldBlock => self.silent(),
            _ => LinkFault::Down { reason: error.to_string() },
        }
    }
}

fn down(error: std::io::Error) -> LinkFault {
    LinkFault::Down { reason: error.to_string() }
}

fn resolved(address: &str) -> Result<SocketAddr, LinkFault> {
    let mut found = address.to_socket_addrs().map_err(down)?;
    found.next().ok_or_else(|| LinkFault::Down { reason: format!("`{address}` has no address") })
}

impl Wire for TcpWire {
    fn exchange(&mut self, frame: &[u8], now_s: f64) -> Result<Vec<u8>, LinkFault> {
        if self.open.is_none()
            && let Err(fault) = self.open(now_s)
        {
            self.reset(now_s);
            return Err(fault);
        }
        let until = Instant::now() + self.timeout;
        let Some((first, mut stream)) = self.open.take() else { return Err(self.silent()) };
        let answer = self.sent(&mut stream, frame, until);
        match answer {
            Ok(answer) => {
                self.open = Some((first, stream));
                Ok(answer)
            }
            Err(fault) => {
                self.reset(now_s);
                Err(fault)
            }
        }
    }

    fn is_open(&self) -> bool {
        self.open.is_some()
    }

    fn reset(&mut self, now_s: f64) {
        if let Some((_, mut stream)) = self.open.take() {
            let _ = stream.write_all(&close()); // it may be gone already
        }
        if now_s >= self.next_s {
            self.next_s = now_s + self.pause_s;
            self.pause_s = (2.0 * self.pause_s).min(LONGEST_PAUSE_S);
        }
    }
}

impl Drop for TcpWire {
    fn drop(&mut self) {
        if let Some((_, mut stream)) = self.open.take() {
            let _ = stream.write_all(&close()); // the control notices a broken connection, too
        }
    }
}
