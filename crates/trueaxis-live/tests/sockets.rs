//! The client against the mock over real sockets of this computer.

mod rig;

use rig::standing;
use std::io::{Read, Write};
use std::net::{TcpListener, TcpStream};
use std::thread;
use std::time::{Duration, Instant};
use trueaxis_live::control::{Control, LinkFault, Sent};
use trueaxis_live::focas::{Fanuc, TcpWire, codec};
use trueaxis_live::mock::MockServer;
use trueaxis_live::start::{connect, mock_of};

fn served() -> (trueaxis_live::file::Plan, MockServer) {
    let plan = standing(&[]);
    let server = MockServer::start(mock_of(&plan).unwrap(), "127.0.0.1:0").unwrap();
    (plan, server)
}

fn connected(timeout_s: f64) -> (MockServer, Fanuc<TcpWire>) {
    let (plan, server) = served();
    let wire = TcpWire::new(&server.address().to_string(), timeout_s);
    let (control, identity) = connect((&plan, plan.control.fanuc().unwrap()), wire, 0.0)
        .unwrap_or_else(|e| panic!("{:?}", e.sorted()));
    assert_eq!((identity.series.as_str(), identity.axes.join("")), ("G42A", "XYZ".to_owned()));
    (server, control)
}

#[test]
fn offsets_are_written_and_read_back() {
    let (server, mut control) = connected(2.0);
    // Until the first heartbeat the watchdog has tripped.
    assert!(control.read(0.0).unwrap().tripped);
    control.write(&Sent { offsets: None, beat: 1, ask_hold: false }, 0.0).unwrap();
    thread::sleep(Duration::from_millis(30));
    assert!(!control.read(0.0).unwrap().tripped);
    control.write(&Sent { offsets: Some(vec![-7, 12]), beat: 2, ask_hold: true }, 0.0).unwrap();
    thread::sleep(Duration::from_millis(200));
    let seen = control.read(0.0).unwrap();
    assert_eq!((seen.offsets, seen.acting), (vec![-7, 12], Some(vec![-7, 12])));
    // 3500 mm and −7 µm.
    assert!((seen.positions[0] - 3499.993).abs() < 1e-9 && seen.homed && !seen.cutting);
    // The cable: nothing for more than a second.
    thread::sleep(Duration::from_millis(1500));
    let seen = control.read(0.0).unwrap();
    assert!(seen.tripped && seen.offsets == [0, 0], "{seen:?}");
    assert!(server.mock().lock().unwrap().tripped());
}

#[test]
fn a_frozen_control_blocks_no_longer_than_its_limit() {
    let (server, mut control) = connected(0.2);
    server.mock().lock().unwrap().faults.frozen = true;
    let start = Instant::now();
    assert_eq!(control.read(0.0), Err(LinkFault::Silent { millis: 200 }));
    assert!(start.elapsed() < Duration::from_millis(1500), "{:?}", start.elapsed());
    // Not tried again before its pause is over, and then it works.
    server.mock().lock().unwrap().faults.frozen = false;
    assert!(matches!(control.read(0.1), Err(LinkFault::Down { .. })));
    control.read(10.0).unwrap();
}

#[test]
fn a_peer_that_is_no_control_is_no_control() {
    let listener = TcpListener::bind("127.0.0.1:0").unwrap();
    let address = listener.local_addr().unwrap();
    thread::spawn(move || {
        for stream in listener.incoming().flatten() {
            let mut stream: TcpStream = stream;
            let _ = stream.write_all(b"HTTP/1.1 400 Bad Request\r\n\r\n");
            let _ = stream.read(&mut [0; 64]);
        }
    });
    let plan = standing(&[]);
    let refused = connect(
        (&plan, plan.control.fanuc().unwrap()),
        TcpWire::new(&address.to_string(), 1.0),
        0.0,
    )
    .err()
    .unwrap();
    let first = refused.iter().next().unwrap();
    assert_eq!(first.code, "live-no-link");
    assert!(first.message.contains("does not begin with a0 a0 a0 a0"), "{}", first.message);
}

#[test]
fn calls_on_the_connection_of_files_are_hung_up_on() {
    let (_, server) = served();
    let ask = codec::ask(&[codec::Call::cnc(0x18, [0; 4])]);
    for (counter, answered) in [(1, false), (2, true)] {
        let mut stream = TcpStream::connect(server.address()).unwrap();
        stream.set_read_timeout(Some(Duration::from_secs(5))).unwrap();
        stream.write_all(&codec::hello(counter)).unwrap();
        stream.read_exact(&mut [0; 34]).unwrap();
        stream.write_all(&ask).unwrap();
        let mut head = [0; 10];
        assert_eq!(stream.read_exact(&mut head).is_ok(), answered, "counter {counter}");
    }
}
