//! Sources of samples on a network, in a plan.

use super::{opcua, word};
use crate::sensor::modbus::{ModbusSource, Registers, Word};
use crate::sensor::mqtt::MqttSource;
use crate::sensor::opcua::{OpcUaSource, ValueTime};
use std::path::Path;
use trueaxis::input::{Dimension, Item, Section};

/// `host:port`.
fn address(item: &Item<'_>, usual: &str) -> Option<(String, u16)> {
    let text = item.text()?;
    let found = text.rsplit_once(':').and_then(|(host, port)| {
        let port: u16 = port.parse().ok()?;
        (!host.is_empty() && port > 0).then(|| (host.to_owned(), port))
    });
    if found.is_none() {
        let message = format!("`{text}` is no address with a port");
        item.error("bad-address", message, &format!("\"192.168.1.20:{usual}\""));
    }
    found
}

/// A place in JSON.
fn pointer(section: &Section<'_>, key: &str) -> Result<Option<String>, ()> {
    let Some(item) = section.get(key) else { return Ok(None) };
    match item.text() {
        Some(text) if text.starts_with('/') => Ok(Some(text.to_owned())),
        Some(text) => {
            let message = format!("`{text}` is no place in a JSON document");
            item.error("live-source", message, "\"/temperature/value\"");
            Err(())
        }
        None => Err(()),
    }
}

/// The password in a file: it does not belong into a plan, which is copied and shown.
pub(super) fn read_password(
    section: &Section<'_>,
    item: &Item<'_>,
    folder: &Path,
) -> Option<String> {
    let name = item.text()?;
    let read = section.files().read(&folder.join(name));
    let text = read.ok().and_then(|bytes| String::from_utf8(bytes).ok());
    if text.is_none() {
        let message = format!("`{name}` cannot be read");
        item.error("unreadable-file", message, "a file with the password in one line");
    }
    text.map(|text| text.trim_end().to_owned())
}

pub(super) fn read_mqtt(
    section: &Section<'_>,
    item: &Item<'_>,
    folder: &Path,
) -> Option<MqttSource> {
    let at = address(item, "1883");
    let topic = section.require("topic", "topic = \"hall/scale_x\"")?;
    let topic = topic.text().map(str::to_owned);
    if topic.as_ref().is_some_and(|t| t.is_empty() || t.contains(['#', '+'])) {
        let message = "a sensor has one topic, without # and +".to_owned();
        item.error("live-source", message, "topic = \"hall/scale_x\"");
        return None;
    }
    let (value, time) = (pointer(section, "value"), pointer(section, "time"));
    let user = section.text("user").map(str::to_owned);
    let password = match section.get("password_file") {
        None => Some(None),
        Some(item) => read_password(section, &item, folder).map(Some),
    };
    let password = password?;
    let login = match (user, password) {
        (Some(user), password) => Some((user, password.unwrap_or_default())),
        (None, Some(_)) => {
            item.error("contradiction", "a password without a user".to_owned(), "user = \"…\"");
            return None;
        }
        (None, None) => None,
    };
    let (host, port) = at?;
    Some(MqttSource { host, port, topic: topic?, value: value.ok()?, time: time.ok()?, login })
}

pub(super) fn read_modbus(section: &Section<'_>, item: &Item<'_>) -> Option<ModbusSource> {
    let at = address(item, "502");
    let tables = [("input", Registers::Input), ("holding", Registers::Holding)];
    let words = [("i16", Word::I16), ("u16", Word::U16), ("f32", Word::F32)];
    let registers = section.get("table").map_or(Some(Registers::Input), |i| word(&i, &tables));
    let kind = section.get("as").map_or(Some(Word::I16), |i| word(&i, &words));
    let unit = whole(section, "unit", Some(255), f64::from(u8::MAX));
    let register = whole(section, "register", None, f64::from(u16::MAX));
    let [scale, offset, period_s] = read_counting(section, item)?;
    let (host, port) = at?;
    Some(ModbusSource {
        address: format!("{host}:{port}"),
        unit: u8::try_from(unit?).ok()?,
        registers: registers?,
        register: register?,
        word: kind?,
        scale,
        offset,
        period_s,
    })
}

pub(super) fn read_opcua(
    section: &Section<'_>,
    item: &Item<'_>,
    folder: &Path,
) -> Option<OpcUaSource> {
    let server = opcua::read_server(section, "opc_ua", folder);
    let node = opcua::needed(section, "node");
    let times = [("source", ValueTime::Source), ("read", ValueTime::Read)];
    let time = section.get("time").map_or(Some(ValueTime::Source), |i| word(&i, &times));
    let [scale, offset, period_s] = read_counting(section, item)?;
    Some(OpcUaSource { server: server?, node: node?, time: time?, scale, offset, period_s })
}

/// °C per unit, °C at 0, and the period, s.
fn read_counting(section: &Section<'_>, item: &Item<'_>) -> Option<[f64; 3]> {
    let number = |key: &str, usual: f64| match section.get(key) {
        None => Some(usual),
        Some(item) => item.number(),
    };
    let (scale, offset) = (number("scale", 1.0), number("offset", 0.0));
    let period_s = section.get("period").map_or(Some(1.0), |i| i.unjudged(Dimension::Time));
    if scale == Some(0.0) || period_s.is_some_and(|s| !(0.01..=3600.0).contains(&s)) {
        let message = "a scale of 0, or a period that is not between 10 ms and an hour".to_owned();
        item.error("not-positive", message, "scale = 0.1, period = \"1 s\"");
        return None;
    }
    Some([scale?, offset?, period_s?])
}

/// A whole number from 0.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "checked: whole, and within 16 bits"
)]
fn whole(section: &Section<'_>, key: &str, usual: Option<u16>, most: f64) -> Option<u16> {
    let item = match (section.get(key), usual) {
        (Some(item), _) => item,
        (None, Some(usual)) => return Some(usual),
        (None, None) => section.require(key, &format!("{key} = 0"))?,
    };
    let number = item.number()?;
    if number.fract() != 0.0 || !(0.0..=most).contains(&number) {
        let message = format!("`{key}` is a whole number from 0 to {most}");
        item.error("live-source", message, &format!("{key} = 0"));
        return None;
    }
    Some(number as u16)
}
