//! A node of an OPC UA server as a sensor.
//!
//! The age of a value is the time of the server, read with it, less the time of the source: the clocks of this computer
//! and of the server need not agree. All nodes of one server are read over one session; servers in controls
//! allow few of them.

use super::inbox::Received;
use super::{Sensor, Sent};
use crate::file::OpcUaServer;
use crate::opcua::{Said, Value};

/// How often a server counts its time at least, s.
const TICK_S: f64 = 2.0;

/// What the time of a value is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ValueTime {
    /// That of the source, as the server states it.
    Source,
    /// When it was read: for servers that renew the time of the source only where the value changes.
    Read,
}

/// Where a node is, and what it counts.
#[derive(Debug, Clone, PartialEq)]
pub struct OpcUaSource {
    /// Its server.
    pub server: OpcUaServer,
    /// `ns=2;s=name`.
    pub node: String,
    /// What its time is.
    pub time: ValueTime,
    /// °C per unit of the node. Unit: °C.
    pub scale: f64,
    /// Added to that, °C. Unit: °C.
    pub offset: f64,
    /// How often it is read.
    pub period_s: f64,
}

/// A value with its age by the clock of the server.
#[derive(Debug, Clone, PartialEq)]
pub struct Timed {
    /// The value.
    pub value: Value,
    /// None where the server says no time. Unit: s.
    pub age_s: Option<f64>,
}

impl OpcUaSource {
    /// What a server said of the node, in °C; a status that is not good, or a text, is no number.
    pub fn received(&self, said: Said<Timed>) -> Received {
        let (sent, age_s) = match said {
            Ok(Timed { value: Value::Number(number), age_s }) => {
                (Sent::number(number * self.scale + self.offset), age_s)
            }
            Ok(Timed { value: Value::Flag(_), age_s }) => {
                (Sent::Text("a bit, not a number".to_owned()), age_s)
            }
            Err(status) => (Sent::Text(format!("the server says: {status}")), Some(0.0)),
        };
        let age_s = if self.time == ValueTime::Read { Some(0.0) } else { age_s };
        Received { sent, age_s }
    }
}

/// How old a value is by the times of its server and of its source, s.
///
/// A server may count whole seconds, so that its time is late by less than 2 s; any more is a fault of a clock.
pub fn age_s(server_s: f64, source_s: f64) -> f64 {
    let age_s = server_s - source_s;
    if age_s > -TICK_S { age_s.max(0.0) } else { age_s }
}

/// One sensor for each node; all nodes of one server are read in one thread, as often as the most frequent of them.
/// A program without the feature has refused such a plan.
#[cfg(not(feature = "opcua"))]
pub fn read_nodes(_: &[(usize, &OpcUaSource)]) -> Vec<Box<dyn Sensor>> {
    Vec::new()
}

#[cfg(feature = "opcua")]
pub use thread::read_nodes;

#[cfg(feature = "opcua")]
mod thread {
    use super::{OpcUaSource, Sensor};
    use crate::clock::{Clock, RealClock};
    use crate::opcua::Client;
    use crate::sensor::inbox::{Delivery, Inbox};
    use std::time::Duration;

    /// One sensor for each node; all nodes of one server are read in one thread, as often as the most frequent of them.
    pub fn read_nodes(sources: &[(usize, &OpcUaSource)]) -> Vec<Box<dyn Sensor>> {
        let mut servers: Vec<Vec<(OpcUaSource, Delivery)>> = Vec::new();
        let mut sensors: Vec<Box<dyn Sensor>> = Vec::new();
        for (sensor, source) in sources {
            let (inbox, delivery) = Inbox::of(*sensor);
            let asked = ((*source).clone(), delivery);
            sensors.push(Box::new(inbox));
            match servers.iter_mut().find(|nodes| nodes[0].0.server == source.server) {
                Some(nodes) => nodes.push(asked),
                None => servers.push(vec![asked]),
            }
        }
        for nodes in servers {
            std::thread::spawn(move || ask(&nodes));
        }
        sensors
    }

    fn ask(nodes: &[(OpcUaSource, Delivery)]) {
        // Without a thread of its own the client has no session, and the sensors have no samples, which the governor sees.
        let Ok(mut client) = Client::of(&nodes[0].0.server) else { return };
        let clock = RealClock::start();
        let names: Vec<&str> = nodes.iter().map(|(source, _)| source.node.as_str()).collect();
        let period_s =
            nodes.iter().map(|(source, _)| source.period_s).fold(f64::INFINITY, f64::min);
        loop {
            // A server that is away is asked again; what it does not say grows old.
            if let Ok(said) = client.timed(&names, clock.now_s()) {
                for ((source, delivery), said) in nodes.iter().zip(said) {
                    if !delivery.put(source.received(said)) {
                        return;
                    }
                }
            }
            std::thread::sleep(Duration::from_secs_f64(period_s));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::file::Security;

    fn source(time: ValueTime) -> OpcUaSource {
        let server = OpcUaServer {
            endpoint: "opc.tcp://10.0.0.3:4840".to_owned(),
            security: Security::None,
            login: None,
            pki: "pki".into(),
            timeout_s: 0.5,
        };
        let node = "ns=2;s=hall".to_owned();
        OpcUaSource { server, node, time, scale: 0.1, offset: -10.0, period_s: 1.0 }
    }

    #[test]
    fn the_age_is_that_of_the_source() {
        let of =
            |time, age_s| source(time).received(Ok(Timed { value: Value::Number(405.0), age_s }));
        let due = |age_s| Received { sent: Sent::Number(30.5), age_s };
        assert_eq!(of(ValueTime::Source, Some(7.0)), due(Some(7.0)));
        assert_eq!(of(ValueTime::Source, None), due(None));
        assert_eq!(of(ValueTime::Read, Some(7.0)), due(Some(0.0)));
    }

    /// Servers whose time is that of an hour or of a century ago: only the difference counts.
    #[test]
    fn law_the_clocks_of_server_and_computer_need_not_agree() {
        for server_s in [0.0, 3600.0, 3.1e9] {
            assert_eq!(age_s(server_s, server_s - 7.0), 7.0);
            // Whole seconds: it reads 0.9 s less than it is.
            assert_eq!(age_s(server_s, server_s + 0.9), 0.0);
            // A source of tomorrow is no fresh one.
            assert_eq!(age_s(server_s, server_s + 86_400.0), -86_400.0);
        }
    }

    #[test]
    fn what_is_no_number_is_no_temperature() {
        let bit = source(ValueTime::Source)
            .received(Ok(Timed { value: Value::Flag(true), age_s: Some(0.0) }));
        assert_eq!(bit.sent.celsius(), None);
        let bad = source(ValueTime::Source).received(Err("BadSensorFailure".to_owned()));
        assert_eq!(bad.sent.shown(), "the server says: BadSensorFailure");
        // It counts at once, not only when the last good value has grown old.
        assert_eq!(bad.age_s, Some(0.0));
    }
}
