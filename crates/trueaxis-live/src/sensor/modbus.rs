//! A register of a Modbus device over TCP as a sensor; a gateway hands the same frames on to RTU.

use super::inbox::{Delivery, Inbox, Received};
use super::{Sensor, Sent};
use std::net::ToSocketAddrs;
use std::time::Duration;
use tokio_modbus::Slave;
use tokio_modbus::client::sync::{Context, Reader, tcp};

/// How long an answer may take.
const TIMEOUT: Duration = Duration::from_millis(500);
/// After a failed connection.
const PAUSE: Duration = Duration::from_secs(1);

/// Which of the two tables of registers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Registers {
    /// Input registers, function 4.
    Input,
    /// Holding registers, function 3.
    Holding,
}

/// What stands in a register.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Word {
    /// 16 bits with a sign.
    I16,
    /// 16 bits without a sign.
    U16,
    /// Two registers, a number of IEEE 754, the high word first.
    F32,
}

/// Where a register is, and what it counts.
#[derive(Debug, Clone, PartialEq)]
pub struct ModbusSource {
    /// `host:port`; 502 is usual.
    pub address: String,
    /// The unit of a gateway.
    pub unit: u8,
    /// Which table.
    pub registers: Registers,
    /// From 0, as in the frame: "30001" in a manual is 0 here.
    pub register: u16,
    /// What stands there.
    pub word: Word,
    /// °C per unit of the register. Unit: °C.
    pub scale: f64,
    /// Added to that, °C. Unit: °C.
    pub offset: f64,
    /// How often it is read.
    pub period_s: f64,
}

/// Reads in a thread of its own.
pub fn read_register(source: &ModbusSource, sensor: usize) -> Box<dyn Sensor> {
    let (inbox, delivery) = Inbox::of(sensor);
    let source = source.clone();
    std::thread::spawn(move || ask(&source, &delivery));
    Box::new(inbox)
}

fn ask(source: &ModbusSource, delivery: &Delivery) {
    loop {
        if let Some(mut device) = connected(source) {
            while let Some(sent) = read(&mut device, source) {
                if !delivery.put(Received { sent, age_s: Some(0.0) }) {
                    return;
                }
                std::thread::sleep(Duration::from_secs_f64(source.period_s));
            }
        }
        std::thread::sleep(PAUSE);
    }
}

fn connected(source: &ModbusSource) -> Option<Context> {
    let address = source.address.to_socket_addrs().ok()?.next()?;
    tcp::connect_slave_with_timeout(address, Slave(source.unit), Some(TIMEOUT)).ok()
}

/// One reading; none where the connection has failed. A device that refuses says so in the place of a number.
fn read(device: &mut Context, source: &ModbusSource) -> Option<Sent> {
    let count = if source.word == Word::F32 { 2 } else { 1 };
    let answer = match source.registers {
        Registers::Input => device.read_input_registers(source.register, count),
        Registers::Holding => device.read_holding_registers(source.register, count),
    };
    Some(match answer.ok()? {
        Ok(words) => counted(source.word, &words).map_or_else(
            || Sent::Text("an answer without a register".to_owned()),
            |value| Sent::number(value * source.scale + source.offset),
        ),
        Err(refused) => Sent::Text(format!("the device refuses: {refused}")),
    })
}

fn counted(word: Word, words: &[u16]) -> Option<f64> {
    match (word, words) {
        (Word::U16, [one]) => Some(f64::from(*one)),
        (Word::I16, [one]) => Some(f64::from(one.cast_signed())),
        (Word::F32, [high, low]) => {
            Some(f64::from(f32::from_bits(u32::from(*high) << 16 | u32::from(*low))))
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn registers_are_counted_as_they_are_written() {
        assert_eq!(counted(Word::I16, &[0xffce]), Some(-50.0));
        assert_eq!(counted(Word::U16, &[0xffce]), Some(65486.0));
        // 21.5 in IEEE 754 is 0x41AC0000.
        assert_eq!(counted(Word::F32, &[0x41ac, 0]), Some(21.5));
        assert_eq!(counted(Word::F32, &[0x41ac]), None);
        assert_eq!(counted(Word::I16, &[]), None);
    }
}
