//! A topic of an MQTT broker as a sensor.
//!
//! A payload is a number, or JSON with the number and its time inside. A message without a time of its own was taken when it
//! came, unless the broker had kept it (retained): no one knows how old that is. A broker that starts again has forgotten
//! who has subscribed, although the connection is there: every greeting is answered by a subscription.

use super::inbox::{Delivery, Inbox, Received};
use super::{Sensor, Sent};
use crate::clock::date_now_s;
use rumqttc::{Client, Event, MqttOptions, Packet, Publish, QoS};
use std::time::Duration;

/// After a failed connection.
const PAUSE: Duration = Duration::from_secs(1);
/// Larger times are milliseconds: as seconds they would be beyond the year 5000.
const LARGEST_SECONDS: f64 = 1e11;
/// Of a payload that is no number, for its message.
const SHOWN: usize = 200;

/// Where a topic is, and what of its payload counts.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct MqttSource {
    /// The broker.
    pub host: String,
    /// Its port; 1883 is usual.
    pub port: u16,
    /// The topic.
    pub topic: String,
    /// Where the number is in JSON, such as `/value`; none for a payload that is the number.
    pub value: Option<String>,
    /// Where the time is in JSON, seconds or milliseconds since 1970.
    pub time: Option<String>,
    /// User and password.
    pub login: Option<(String, String)>,
}

/// Subscribes in a thread of its own.
pub fn subscribe(source: &MqttSource, sensor: usize) -> Box<dyn Sensor> {
    let (inbox, delivery) = Inbox::of(sensor);
    let source = source.clone();
    std::thread::spawn(move || listen(&source, sensor, &delivery));
    Box::new(inbox)
}

fn listen(source: &MqttSource, sensor: usize, delivery: &Delivery) {
    let id = format!("trueaxis-{}-{sensor}", std::process::id());
    let mut options = MqttOptions::new(id, &source.host, source.port);
    options.set_keep_alive(Duration::from_secs(5)).set_clean_session(true);
    if let Some((user, password)) = &source.login {
        options.set_credentials(user, password);
    }
    let (client, mut connection) = Client::new(options, 10);
    for event in connection.iter() {
        match event {
            Ok(Event::Incoming(Packet::ConnAck(_))) => {
                if client.try_subscribe(&source.topic, QoS::AtMostOnce).is_err() {
                    return;
                }
            }
            Ok(Event::Incoming(Packet::Publish(message))) => {
                if !delivery.put(received(source, &message, date_now_s())) {
                    return;
                }
            }
            Ok(_) => {}
            // The next turn connects again.
            Err(_) => std::thread::sleep(PAUSE),
        }
    }
}

/// What a message says, at a date.
fn received(source: &MqttSource, message: &Publish, date_s: f64) -> Received {
    read(source, &message.payload, (message.retain, date_s))
}

fn read(source: &MqttSource, payload: &[u8], (retained, date_s): (bool, f64)) -> Received {
    let text = String::from_utf8_lossy(payload);
    let json = || serde_json::from_str::<serde_json::Value>(&text).ok();
    let cut = || Sent::Text(text.chars().take(SHOWN).collect());
    let sent = match &source.value {
        None => cut(),
        Some(at) => match json().as_ref().and_then(|json| json.pointer(at)) {
            Some(serde_json::Value::Number(number)) => {
                number.as_f64().map_or_else(cut, Sent::number)
            }
            Some(serde_json::Value::String(text)) => Sent::Text(text.chars().take(SHOWN).collect()),
            _ => cut(),
        },
    };
    let age_s = match &source.time {
        None => (!retained).then_some(0.0),
        Some(at) => json()
            .and_then(|json| json.pointer(at)?.as_f64())
            .map(|time| date_s - if time > LARGEST_SECONDS { time / 1e3 } else { time }),
    };
    Received { sent, age_s }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(value: Option<&str>, time: Option<&str>) -> MqttSource {
        MqttSource {
            host: "localhost".to_owned(),
            port: 1883,
            topic: "t".to_owned(),
            value: value.map(str::to_owned),
            time: time.map(str::to_owned),
            login: None,
        }
    }

    #[test]
    fn payloads_are_read_as_they_are_meant() {
        let plain = of(None, None);
        let kept = |retained| read(&plain, b" 21.5\n", (retained, 1e9));
        assert_eq!((kept(false).sent.celsius(), kept(false).age_s), (Some(21.5), Some(0.0)));
        // The broker has kept it no one knows since when.
        assert_eq!((kept(true).sent.celsius(), kept(true).age_s), (Some(21.5), None));

        let inside = of(Some("/t/c"), Some("/at"));
        let json = |text: &str| read(&inside, text.as_bytes(), (true, 1_700_000_010.0));
        let found = json(r#"{"t": {"c": 30.25}, "at": 1700000000}"#);
        assert_eq!((found.sent, found.age_s), (Sent::Number(30.25), Some(10.0)));
        assert_eq!(json(r#"{"t": {"c": "30.25"}, "at": 1700000000000}"#).age_s, Some(10.0));
        for broken in ["", "30.25", "{", r#"{"t": 4}"#, r#"{"t": {"c": null}}"#, "\u{1}"] {
            assert_eq!(
                (json(broken).sent.celsius().is_some(), json(broken).age_s),
                (broken == "30.25", None),
                "{broken}"
            );
        }
        // No number of a sensor: its text is refused later.
        assert_eq!(read(&plain, b"NaN", (false, 0.0)).sent.celsius(), None);
        assert_eq!(read(&plain, &[0xff; 5000], (false, 0.0)).sent.shown().chars().count(), 40);
    }
}
