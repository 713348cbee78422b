//! Sensors on a network: a small broker and a small device of their own, which can be ended at any time, and a real mosquitto where
//! it is installed.

mod rig;

use rig::broker::{topic, until};
use rig::plan_with;
use std::io::{Read, Write};
use std::net::{TcpListener, TcpStream};
use std::process::{Child, Command, Stdio};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU16, Ordering};
use std::time::{Duration, Instant};
use trueaxis_live::clock::{Clock, RealClock};
use trueaxis_live::sensor::Sample;
use trueaxis_live::sensor::modbus::{ModbusSource, Registers, Word, read_register};
use trueaxis_live::sensor::mqtt::subscribe;

#[test]
fn a_broker_that_starts_again_is_subscribed_to_again() {
    rig::broker::restart();
}

/// A device with one register; refuses another one.
fn device(value: &Arc<AtomicU16>, up: &Arc<AtomicBool>) -> u16 {
    let listener = TcpListener::bind("127.0.0.1:0").expect("a port");
    let port = listener.local_addr().expect("an address").port();
    let (value, up) = (Arc::clone(value), Arc::clone(up));
    std::thread::spawn(move || {
        for mut stream in listener.incoming().flatten() {
            let (value, up) = (Arc::clone(&value), Arc::clone(&up));
            std::thread::spawn(move || {
                let mut frame = [0; 12];
                while stream.read_exact(&mut frame).is_ok() && up.load(Ordering::SeqCst) {
                    let [high, low] = value.load(Ordering::SeqCst).to_be_bytes();
                    let known = frame[7] == 4 && frame[8..12] == [0, 7, 0, 1];
                    let body =
                        if known { vec![1, 4, 2, high, low] } else { vec![1, frame[7] | 0x80, 2] };
                    let mut answer =
                        vec![frame[0], frame[1], 0, 0, 0, u8::try_from(body.len()).expect("short")];
                    answer.extend(body);
                    if stream.write_all(&answer).is_err() {
                        return;
                    }
                }
            });
        }
    });
    port
}

#[test]
fn a_register_is_read_and_a_device_that_ends_is_asked_again() {
    let (value, up) = (Arc::new(AtomicU16::new(305)), Arc::new(AtomicBool::new(true)));
    let port = device(&value, &up);
    let source = |register| ModbusSource {
        address: format!("127.0.0.1:{port}"),
        unit: 1,
        registers: Registers::Input,
        register,
        word: Word::I16,
        scale: 0.1,
        offset: 0.0,
        period_s: 0.05,
    };
    let clock = RealClock::start();
    let mut sensor = read_register(&source(7), 1);
    let celsius =
        |wanted: f64| move |s: &Sample| s.sent.celsius().is_some_and(|c| (c - wanted).abs() < 1e-9);
    assert!(until(&mut *sensor, &clock, celsius(30.5)).is_some_and(|s| s.taken_s.is_some()));
    // −5.0 °C, in two's complement.
    value.store(0xffce, Ordering::SeqCst);
    assert!(until(&mut *sensor, &clock, celsius(-5.0)).is_some());
    up.store(false, Ordering::SeqCst);
    std::thread::sleep(Duration::from_millis(300));
    sensor.poll(clock.now_s());
    up.store(true, Ordering::SeqCst);
    assert!(until(&mut *sensor, &clock, celsius(-5.0)).is_some(), "after its restart");
    // A register that it does not have.
    let mut other = read_register(&source(8), 1);
    let refused = until(&mut *other, &clock, |_| true).expect("what it says");
    assert!(
        refused.sent.celsius().is_none() && refused.sent.shown().contains("refuses"),
        "{refused:?}"
    );
}

struct Ended(Child);

impl Drop for Ended {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

fn mosquitto(port: u16) -> Ended {
    let quiet = Command::new("mosquitto")
        .args(["-p", &port.to_string()])
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn();
    let broker = Ended(quiet.expect("mosquitto starts"));
    let began = Instant::now();
    while TcpStream::connect(("127.0.0.1", port)).is_err()
        && began.elapsed() < Duration::from_secs(10)
    {
        std::thread::sleep(Duration::from_millis(20));
    }
    broker
}

fn send(port: u16, payload: &str, more: &[&str]) {
    let port = port.to_string();
    let words = ["-p", &port, "-t", "hall/scale_x", "-m", payload];
    let done =
        Command::new("mosquitto_pub").args(words).args(more).status().expect("mosquitto_pub");
    assert!(done.success());
}

#[test]
#[expect(clippy::print_stderr, reason = "a test that is skipped says so")]
fn oracle_a_real_mosquitto_that_is_killed_and_starts_again() {
    if Command::new("mosquitto").arg("-h").output().is_err()
        || Command::new("mosquitto_pub").arg("--help").output().is_err()
    {
        eprintln!("skipped: no mosquitto (Debian: apt-get install mosquitto mosquitto-clients)");
        return;
    }
    let port = TcpListener::bind("127.0.0.1:0").unwrap().local_addr().unwrap().port();
    let mut broker = mosquitto(port);
    send(port, "17.0", &["-r"]);
    let clock = RealClock::start();
    let mut sensor = subscribe(&topic(port), 0);
    let kept = until(&mut *sensor, &clock, |s| s.sent.celsius() == Some(17.0)).expect("kept");
    assert_eq!(kept.taken_s, None);
    for round in 0..2 {
        let wanted = 21.0 + f64::from(round);
        let began = Instant::now();
        let found = loop {
            send(port, &wanted.to_string(), &[]);
            let all = sensor.poll(clock.now_s());
            if let Some(found) = all.into_iter().find(|s| s.sent.celsius() == Some(wanted)) {
                break found;
            }
            assert!(began.elapsed() < Duration::from_secs(20), "round {round}: nothing comes");
            std::thread::sleep(Duration::from_millis(100));
        };
        assert!(found.taken_s.is_some_and(|t| (clock.now_s() - t).abs() < 1.0));
        send(port, "nan", &[]);
        let text = until(&mut *sensor, &clock, |s| s.sent.celsius().is_none()).expect("the text");
        assert_eq!(text.sent.shown(), "nan");
        drop(broker);
        broker = mosquitto(port);
    }
}

#[test]
fn plans_name_brokers_and_devices() {
    let log = "source = { log = \"../03_predict/torque-arm-hall.csv\", start = \"200 min\", speed = 10 }\n\n[sensor.workpiece]";
    let with =
        |source: &str| plan_with(&[(log, &format!("source = {source}\n\n[sensor.workpiece]"))]);
    for good in [
        "{ mqtt = \"broker.local:1883\", topic = \"hall/y\" }",
        "{ mqtt = \"10.0.0.1:1883\", topic = \"hall/y\", value = \"/t/c\", time = \"/at\" }",
        "{ modbus = \"10.0.0.2:502\", register = 7, scale = 0.1 }",
        "{ modbus = \"10.0.0.2:502\", unit = 3, table = \"holding\", register = 0, as = \"f32\", offset = -273.15, period = \"500 ms\" }",
        "{ opc_ua = \"opc.tcp://10.0.0.3:4840\", node = \"ns=2;s=hall.y\", security = \"none\", scale = 0.1 }",
        "{ opc_ua = \"opc.tcp://plc:4840\", node = \"ns=4;i=7\", security = \"sign-and-encrypt\", time = \"read\", period = \"2 s\" }",
    ] {
        assert!(with(good).is_ok(), "{good}: {:?}", with(good).err());
    }
    for (bad, code) in [
        ("{ mqtt = \"broker.local\", topic = \"hall/y\" }", "bad-address"),
        ("{ mqtt = \"broker.local:1883\", topic = \"hall/#\" }", "live-source"),
        ("{ mqtt = \"broker.local:1883\", topic = \"t\", value = \"t.c\" }", "live-source"),
        (
            "{ mqtt = \"broker.local:1883\", topic = \"t\", password_file = \"none.secret\" }",
            "unreadable-file",
        ),
        ("{ modbus = \"10.0.0.2:502\", register = 70000 }", "live-source"),
        ("{ modbus = \"10.0.0.2:502\", register = 1.5 }", "live-source"),
        ("{ modbus = \"10.0.0.2:502\", register = 1, scale = 0 }", "not-positive"),
        ("{ modbus = \"10.0.0.2:502\", register = 1, as = \"i8\" }", "unknown-word"),
        ("{ opc_ua = \"10.0.0.3:4840\", node = \"ns=2;s=y\", security = \"none\" }", "bad-address"),
        (
            "{ opc_ua = \"opc.tcp://plc:4840\", node = \"hall.y\", security = \"none\" }",
            "live-node",
        ),
        ("{ opc_ua = \"opc.tcp://plc:4840\", security = \"none\" }", "missing-key"),
        ("{ opc_ua = \"opc.tcp://plc:4840\", node = \"ns=2;s=y\" }", "missing-key"),
        (
            "{ opc_ua = \"opc.tcp://plc:4840\", node = \"i=1\", security = \"none\", period = \"2 h\" }",
            "not-positive",
        ),
        (
            "{ opc_ua = \"opc.tcp://plc:4840\", node = \"i=1\", security = \"none\", time = \"server\" }",
            "unknown-word",
        ),
    ] {
        let said = with(bad).err().unwrap_or_default();
        assert!(said.iter().any(|s| s.starts_with(code)), "{bad}: {said:?}");
    }
}
