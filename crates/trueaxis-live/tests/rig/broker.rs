//! A small MQTT broker that can be ended at any time.

use std::io::{Read, Write};
use std::net::{TcpListener, TcpStream};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::time::{Duration, Instant};
use trueaxis_live::clock::{Clock, RealClock};
use trueaxis_live::sensor::mqtt::{MqttSource, subscribe};
use trueaxis_live::sensor::{Sample, Sensor};

/// The topic of that broker.
pub fn topic(port: u16) -> MqttSource {
    MqttSource {
        host: "127.0.0.1".to_owned(),
        port,
        topic: "hall/scale_x".to_owned(),
        value: None,
        time: None,
        login: None,
    }
}

/// Samples until one fits, at most so long.
pub fn until(
    sensor: &mut dyn Sensor,
    clock: &RealClock,
    fits: impl Fn(&Sample) -> bool,
) -> Option<Sample> {
    let began = Instant::now();
    while began.elapsed() < Duration::from_secs(15) {
        if let Some(found) = sensor.poll(clock.now_s()).into_iter().find(&fits) {
            return Some(found);
        }
        std::thread::sleep(Duration::from_millis(10));
    }
    None
}

/// A broker of MQTT 3.1.1 that forgets who has subscribed when it starts again. It sends a number ten times a second to
/// who has subscribed on this connection, and once what it has kept.
pub struct Broker {
    pub up: Arc<AtomicBool>,
    pub subscribed: Arc<AtomicUsize>,
    /// Connections that are open.
    open: Arc<AtomicUsize>,
    pub port: u16,
}

impl Broker {
    pub fn start() -> Self {
        let listener = TcpListener::bind("127.0.0.1:0").expect("a port");
        let port = listener.local_addr().expect("an address").port();
        let (up, subscribed) = (Arc::new(AtomicBool::new(true)), Arc::new(AtomicUsize::new(0)));
        let (theirs, counted) = (Arc::clone(&up), Arc::clone(&subscribed));
        let open = Arc::new(AtomicUsize::new(0));
        let all = Arc::clone(&open);
        std::thread::spawn(move || {
            for stream in listener.incoming().flatten() {
                if theirs.load(Ordering::SeqCst) {
                    let (up, subscribed) = (Arc::clone(&theirs), Arc::clone(&counted));
                    let open = Arc::clone(&all);
                    open.fetch_add(1, Ordering::SeqCst);
                    std::thread::spawn(move || {
                        serve(stream, &up, &subscribed);
                        open.fetch_sub(1, Ordering::SeqCst);
                    });
                }
            }
        });
        Self { up, subscribed, open, port }
    }

    /// Ends all connections.
    fn end(&self) {
        self.up.store(false, Ordering::SeqCst);
        wait(|| self.open.load(Ordering::SeqCst) == 0, "the connections end");
    }
}

/// Waits until something is so, however busy the computer is.
fn wait(is_so: impl Fn() -> bool, what: &str) {
    let began = Instant::now();
    while !is_so() {
        assert!(began.elapsed() < Duration::from_secs(60), "{what}");
        std::thread::sleep(Duration::from_millis(10));
    }
}

fn publish(stream: &mut TcpStream, first: u8, payload: &str) -> std::io::Result<()> {
    let topic = b"hall/scale_x";
    let length = u8::try_from(2 + topic.len() + payload.len()).expect("short");
    let mut frame = vec![first, length, 0, u8::try_from(topic.len()).expect("short")];
    frame.extend(topic);
    frame.extend(payload.as_bytes());
    stream.write_all(&frame)
}

fn serve(mut stream: TcpStream, up: &AtomicBool, subscribed: &AtomicUsize) {
    stream.set_read_timeout(Some(Duration::from_millis(100))).expect("a time limit");
    let mut is_subscribed = false;
    while up.load(Ordering::SeqCst) {
        let mut head = [0; 2];
        match stream.read_exact(&mut head) {
            Ok(()) => {}
            Err(error)
                if matches!(
                    error.kind(),
                    std::io::ErrorKind::WouldBlock | std::io::ErrorKind::TimedOut
                ) =>
            {
                if is_subscribed && publish(&mut stream, 0x30, "21.5").is_err() {
                    return;
                }
                continue;
            }
            Err(_) => return,
        }
        let mut body = vec![0; usize::from(head[1])];
        if stream.read_exact(&mut body).is_err() {
            return;
        }
        let answered = match head[0] >> 4 {
            1 => stream.write_all(&[0x20, 2, 0, 0]),
            8 => {
                is_subscribed = true;
                subscribed.fetch_add(1, Ordering::SeqCst);
                let given = stream.write_all(&[0x90, 3, body[0], body[1], 0]);
                // Kept since yesterday.
                given.and_then(|()| publish(&mut stream, 0x31, "99.5"))
            }
            12 => stream.write_all(&[0xd0, 0]),
            _ => Ok(()),
        };
        if answered.is_err() {
            return;
        }
    }
}

/// All connections of a broker end, and it is there again: what was seen.
pub fn restart() -> String {
    let broker = Broker::start();
    let clock = RealClock::start();
    let mut sensor = subscribe(&topic(broker.port), 3);
    let kept =
        until(&mut *sensor, &clock, |s| s.sent.celsius() == Some(99.5)).expect("what was kept");
    assert_eq!((kept.sensor, kept.taken_s), (3, None), "no one knows how old that is");
    let fresh = until(&mut *sensor, &clock, |s| s.sent.celsius() == Some(21.5)).expect("a sample");
    assert!((clock.now_s() - fresh.taken_s.expect("a time")).abs() < 0.5);
    broker.end();
    std::thread::sleep(Duration::from_millis(500));
    sensor.poll(clock.now_s());
    broker.up.store(true, Ordering::SeqCst);
    wait(|| broker.subscribed.load(Ordering::SeqCst) == 2, "subscribed to again");
    // Samples of before that came late.
    sensor.poll(clock.now_s());
    let again =
        until(&mut *sensor, &clock, |s| s.sent.celsius() == Some(21.5)).expect("a sample after it");
    assert!(again.taken_s.is_some());
    let subscriptions = broker.subscribed.load(Ordering::SeqCst);
    assert_eq!(subscriptions, 2);
    "samples → none → samples, subscribed to again; what the broker had kept has no age".to_owned()
}
