//! A node of an OPC UA server as a sensor.
//!
//! The age of a value is the time of the server, read with it, less the time of the source: the clocks of this computer
//! and of the server need not agree. All nodes of one server are read over one session; servers in controls
//! allow few of them.

use super::Sent;
use super::inbox::Received;
use crate::file::OpcUaServer;
use crate::opcua::{Said, Value};

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

#[cfg(feature = "opcua")]
mod thread {
    use super::super::Sensor;
    use super::super::inbox::{Delivery, Inbox};
    use super::OpcUaSource;
    use crate::clock::{Clock, RealClock};
    use crate::opcua::Client;
    use std::time::Duration;

    /// Reads the nodes of one server in a thread of its own, as often as the most frequent of them.
    ///
    /// # Errors
    /// What the system says.
    pub fn read_nodes(sources: &[(usize, &OpcUaSource)]) -> std::io::Result<Vec<Box<dyn Sensor>>> {
        let Some((_, first)) = sources.first() else { return Ok(Vec::new()) };
        let client = Client::of(&first.server)?;
        let mut inboxes: Vec<Box<dyn Sensor>> = Vec::new();
        let mut asked = Vec::new();
        for (sensor, source) in sources {
            let (inbox, delivery) = Inbox::of(*sensor);
            inboxes.push(Box::new(inbox));
            asked.push(((*source).clone(), delivery));
        }
        std::thread::spawn(move || ask(client, &asked));
        Ok(inboxes)
    }

    fn ask(mut client: Client, asked: &[(OpcUaSource, Delivery)]) {
        let clock = RealClock::start();
        let nodes: Vec<&str> = asked.iter().map(|(source, _)| source.node.as_str()).collect();
        let period_s =
            asked.iter().map(|(source, _)| source.period_s).fold(f64::INFINITY, f64::min);
        loop {
            // A server that is away is asked again; what it does not say grows old.
            if let Ok(said) = client.timed(&nodes, clock.now_s()) {
                for ((source, delivery), said) in asked.iter().zip(said) {
                    if !delivery.put(source.received(said)) {
                        return;
                    }
                }
            }
            std::thread::sleep(Duration::from_secs_f64(period_s));
        }
    }
}

#[cfg(feature = "opcua")]
pub use thread::read_nodes;

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
