//! The head of a certificate as data: number, customer, machine, place, instruments with their certificates.

use serde::Serialize;
use trueaxis_input::{Date, Item, Section};
use trueaxis_report::JsonSchema;
use trueaxis_report::Table;

/// The head of a certificate.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize, JsonSchema)]
pub struct CertificateHead {
    /// Its number.
    pub number: String,
    /// For whom; null if it is not stated.
    pub customer: Option<String>,
    /// The serial number of the machine; null if it is not stated.
    pub machine_serial: Option<String>,
    /// Who measured; null if it is not stated.
    pub operator: Option<String>,
    /// Where; null if it is not stated.
    pub place: Option<String>,
    /// The date of the certificate, as written.
    pub date: String,
    /// The instruments.
    pub instruments: Vec<InstrumentUsed>,
}

/// An instrument with its certificate.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, JsonSchema)]
pub struct InstrumentUsed {
    /// Its name.
    pub name: String,
    /// Its serial number; null if it is not stated.
    pub serial: Option<String>,
    /// The number of its certificate.
    pub certificate: String,
    /// When it was calibrated, as written.
    pub calibrated: String,
    /// Until when that is valid, as written; null if it is not stated.
    pub valid_until: Option<String>,
    /// Whether it is valid on the date of the certificate; null if no end is stated.
    pub is_valid: Option<bool>,
}

/// Reads `[certificate]` with its `[[certificate.instrument]]`; an instrument out of date is a warning.
pub fn read_head(section: &Section<'_>) -> Option<CertificateHead> {
    let text = |key: &str| section.text(key).map(str::to_owned);
    let number = section.require("number", "number = \"2026-117\"").and_then(|i| i.text());
    let date = section.require("date", "date = 2026-03-05").and_then(|item| dated(&item));
    let (customer, machine_serial) = (text("customer"), text("machine_serial"));
    let (operator, place) = (text("operator"), text("place"));
    let mut instruments = Vec::new();
    let list = section.get("instrument").and_then(|item| item.list()).unwrap_or_default();
    for (i, item) in list.iter().enumerate() {
        let name = section.path(&format!("instrument.{}", i + 1));
        let of = date.as_ref().map(|(_, day)| *day);
        instruments.extend(item.section(&name, |s| read_instrument(s, of)).flatten());
    }
    let (date, _) = date?;
    let number = number?.to_owned();
    Some(CertificateHead { number, customer, machine_serial, operator, place, date, instruments })
}

/// A date as written, and the day that it is.
fn dated(item: &Item<'_>) -> Option<(String, Date)> {
    let text = item.date_or_text()?;
    let day = Date::parse(&text);
    if day.is_none() {
        let message = format!("`{text}` is not a date");
        item.error("bad-date", message, "2026-03-14, or \"14.03.2026\"");
    }
    Some((text, day?))
}

fn read_instrument(section: &Section<'_>, on: Option<Date>) -> Option<InstrumentUsed> {
    let text = |key: &str, hint: &str| Some(section.require(key, hint)?.text()?.to_owned());
    let name = text("name", "name = \"laser interferometer\"");
    let certificate = text("certificate", "certificate = \"number of its certificate\"");
    let calibrated =
        section.require("calibrated", "calibrated = 2025-06-01").and_then(|item| dated(&item));
    let until = section.get("valid_until");
    let valid_until = until.as_ref().and_then(dated);
    let serial = section.text("serial").map(str::to_owned);
    let late = |item: &Item<'_>, message: String, hint: &str| {
        item.warn("calibration-expired", message, hint);
    };
    if let (Some(item), Some((text, end)), Some(on)) = (&until, &valid_until, on)
        && *end < on
    {
        let message = format!(
            "the calibration of this instrument ended on {text}, the certificate is of {on}"
        );
        late(item, message, "have it calibrated, or state its new certificate");
    }
    if let (Some((text, begin)), Some(on)) = (&calibrated, on)
        && *begin > on
    {
        let message =
            format!("this instrument was calibrated on {text}, after the certificate of {on}");
        section.warn("calibration-expired", message, "state the calibration that was valid then");
    }
    let is_valid = valid_until.as_ref().zip(on).map(|((_, end), on)| *end >= on);
    Some(InstrumentUsed {
        name: name?,
        serial,
        certificate: certificate?,
        calibrated: calibrated?.0,
        valid_until: valid_until.map(|(text, _)| text),
        is_valid,
    })
}

impl CertificateHead {
    /// What is stated, under its name.
    pub fn entries(&self) -> impl Iterator<Item = (&'static str, &str)> {
        let stated = [
            ("number", Some(&self.number)),
            ("customer", self.customer.as_ref()),
            ("serial number of the machine", self.machine_serial.as_ref()),
            ("operator", self.operator.as_ref()),
            ("place", self.place.as_ref()),
            ("date", Some(&self.date)),
        ];
        stated.into_iter().filter_map(|(name, value)| Some((name, value?.as_str())))
    }

    /// The instruments with their certificates.
    pub fn instrument_table(&self) -> Table {
        let dash = || "–".to_owned();
        let row = |i: &InstrumentUsed| {
            let validity = match i.is_valid {
                Some(true) => "valid",
                Some(false) => "out of date",
                None => "not stated",
            };
            [
                i.name.clone(),
                i.serial.clone().unwrap_or_else(dash),
                i.certificate.clone(),
                i.calibrated.clone(),
                i.valid_until.clone().unwrap_or_else(dash),
                validity.to_owned(),
            ]
        };
        let heads = ["instrument", "serial number", "certificate", "calibrated", "valid until", ""];
        Table::new(heads).rows(self.instruments.iter().map(row))
    }

    /// What stands at the top of the certificate: lines, and the table of instruments.
    pub fn shown(&self) -> (Vec<String>, Table) {
        let line = |(name, value)| match name {
            "number" => format!("certificate: {value}"),
            _ => format!("{name}: {value}"),
        };
        (self.entries().map(line).collect(), self.instrument_table())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use trueaxis_input::SourceText;

    fn codes(until: &str) -> (Option<CertificateHead>, Vec<&'static str>) {
        let text = format!(
            "[certificate]\nnumber = '1'\ndate = 2026-03-05\n[[certificate.instrument]]\nname = 'laser'\n\
             certificate = 'C1'\ncalibrated = 2025-03-01\nvalid_until = {until}\n"
        );
        let source = SourceText::new("c.toml", &text);
        let head = source.read(|root| root.section("certificate", read_head)).flatten();
        (head, source.finish().iter().map(|d| d.code).collect())
    }

    #[test]
    fn an_instrument_out_of_date_is_a_warning() {
        let (head, found) = codes("2026-03-05");
        assert_eq!((head.unwrap().instruments[0].is_valid, found.len()), (Some(true), 0));
        let (head, found) = codes("2026-03-04");
        assert_eq!(head.unwrap().instruments[0].is_valid, Some(false));
        assert_eq!(found, ["calibration-expired"]);
        assert_eq!(codes("'soon'").1, ["bad-date"]);
    }
}
