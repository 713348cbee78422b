//! `prior = "FILE"`: values and covariance that an earlier campaign left.
//!
//! ```toml
//! [covariance]
//! machine = "mill"                # its name
//! nominal = "0123456789abcdef"    # mark of its nominal chain and travels
//!
//! [[known]]
//! of = { EX0C = 1.0 }             # an unknown, or a combination of several
//! value = 0.012                   # mm, rad, s or 1
//! u = 0.0004
//! covariance = [1.6e-7]           # with all before it, and its own variance
//! stated = { "expansion of scale X" = 3e-4 }   # how one standard uncertainty of what the machine file states moves it
//! ```

use crate::instruments::Instrument;
use crate::unknowns::design::Design;
use crate::unknowns::known::Known;
use nalgebra::{DMatrix, DVector};
use std::path::{Path, PathBuf};
use trueaxis_input::{Item, Place, Section, SourceText};
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{Command, Travel};
use trueaxis_machine::errors::ErrorValues;
use trueaxis_machine::file::KnownRow;

/// What an earlier campaign left.
#[derive(Debug, Clone)]
pub struct Prior {
    /// The file.
    pub path: PathBuf,
    /// The campaign that it came from.
    pub campaign: String,
    /// What is known of the unknowns of this campaign.
    pub known: Known,
    /// The tables of readings that are in it: name and mark.
    pub readings: Vec<(String, String)>,
}

/// A number that changes with a text (FNV-1a; Fowler, Noll, Vo 1991).
pub fn mark(text: &str) -> String {
    let step = |hash: u64, byte: u8| (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3);
    format!("{:016x}", text.bytes().fold(0xcbf2_9ce4_8422_2325, step))
}

/// The mark of a machine without its errors: where the tool is at some commands, and the travels, to 1 nm.
pub fn nominal_mark(machine: &Machine) -> String {
    let none = ErrorValues::default();
    let mut text = machine.chain_text();
    let whole = |v: f64| format!(" {}", (v * 1e6).round() as i64);
    for k in 0..4 {
        let at = |i: usize| 0.1 + 0.2 * i as f64 + 0.3 * f64::from(k) * (1.0 + i as f64);
        let command: Command = std::array::from_fn(at);
        let pose = machine.pose(&command, &none);
        let tip = pose.linear() * machine.tip_mm() + pose.shift_mm();
        text.extend(tip.iter().chain(pose.linear().iter()).map(|v| whole(*v)));
    }
    for axis in machine.axes() {
        if let Travel::Between(from, to) = axis.travel {
            text += &(whole(from) + &whole(to));
        }
    }
    mark(&text)
}

/// How an instrument stands, as keys of a file: all on which its unknowns depend.
pub fn set_up(instrument: &Instrument) -> Vec<(String, String)> {
    let Instrument { kind, tool_point_mm: p, reference_point_mm: q, length_mm, reference, .. } =
        instrument;
    let place = |v: &trueaxis_geometry::Vec3| format!("{} {} {} mm", v.x, v.y, v.z);
    vec![
        ("kind".to_owned(), kind.name().to_owned()),
        (kind.tool_point().to_owned(), place(p)),
        (kind.reference_point().to_owned(), place(q)),
        ("length".to_owned(), format!("{length_mm} mm")),
        ("stands_on".to_owned(), format!("{reference:?}").to_lowercase()),
    ]
}

/// Reads `prior`.
pub(super) fn read_prior_file(root: &Section<'_>, design: &Design, folder: &Path) -> Option<Prior> {
    let item = root.get("prior")?;
    let path = folder.join(item.text()?);
    let file = path.display().to_string();
    let text = match root.files().read_text(&path) {
        Ok(text) => text,
        Err(error) => {
            let message = format!("{file} cannot be read: {error}");
            item.error("unreadable-file", message, "the covariance that `identify -o` wrote");
            return None;
        }
    };
    let source = SourceText::from(root.files(), &file, &text);
    let read = source.read(|s| read_file(s, design, &path));
    let problems = source.finish();
    let sound = !problems.has_errors();
    root.take_over(problems);
    read.filter(|_| sound)
}

fn read_file(root: &Section<'_>, design: &Design, path: &Path) -> Option<Prior> {
    let hint = "this is no covariance that `identify -o` wrote";
    let head = root.require("covariance", hint)?;
    let campaign = head.section("covariance", |s| {
        check_machine(s, &design.machine);
        s.get("date");
        s.text("campaign").unwrap_or_default().to_owned()
    });
    let mut readings = Vec::new();
    for item in root.get("readings").and_then(|i| i.list()).unwrap_or_default() {
        item.section("readings", |s| {
            let (file, mark) = (s.text("file"), s.text("mark"));
            readings.extend(file.zip(mark).map(|(f, m)| (f.to_owned(), m.to_owned())));
        });
    }
    // Asked for before a bad row ends the reading.
    let set_ups = root.get("setup");
    let mut rows: Vec<(KnownRow, Place)> = Vec::new();
    for item in root.require("known", hint)?.list()? {
        let row = item.section("known", |s| KnownRow::read(s, rows.len())).flatten()?;
        rows.push((row, item.place()));
    }
    let used = |instrument: &str| {
        let begins = |name: &String| name.split_once('.').is_some_and(|(i, _)| i == instrument);
        rows.iter().any(|(row, _)| row.of.iter().any(|(name, _)| begins(name)))
    };
    set_ups.and_then(|item| {
        item.section("setup", |s| {
            for (name, _, item) in s.entries() {
                check_set_up(s, &item, name, design, used(name));
            }
        })
    });
    let known = known(root, &rows, design)?;
    Some(Prior { path: path.to_owned(), campaign: campaign?, known, readings })
}

fn check_machine(section: &Section<'_>, machine: &Machine) {
    let hint = "values of one machine say nothing of another: measure this one";
    let code = "prior-of-another-machine";
    let name = section.require("machine", "the name of the machine");
    let nominal = section.require("nominal", "the mark of its nominal chain");
    if let Some((item, name)) = name.and_then(|i| Some((i, i.text()?)))
        && name != machine.name()
    {
        let message =
            format!("these values are of `{name}`, the campaign is on `{}`", machine.name());
        item.error(code, message, hint);
    }
    if let Some((item, found)) = nominal.and_then(|i| Some((i, i.text()?)))
        && found != nominal_mark(machine)
    {
        let message = format!(
            "the nominal chain or the travels of `{}` have changed since: mark {found}, now {}",
            machine.name(),
            nominal_mark(machine)
        );
        item.error(code, message, hint);
    }
}

/// The set-up of an instrument then and now.
fn check_set_up(section: &Section<'_>, item: &Item<'_>, name: &str, design: &Design, used: bool) {
    let now = design.instruments.iter().find(|i| i.name == name).map(set_up);
    item.section(&section.path(name), |s| {
        for (key, place, then) in s.entries() {
            let Some(then) = then.text() else { continue };
            let now = now.as_ref().filter(|_| used).and_then(|n| n.iter().find(|(k, _)| k == key));
            if let Some((_, now)) = now.filter(|(_, now)| now != then) {
                let message = format!("{name} was set up with {key} = \"{then}\", now it is \"{now}\"");
                let hint = "what is known of its set-up holds for the old one: rename the instrument, or \
                            delete its [[known]]";
                s.error_at(place, "prior-of-another-set-up", message, hint);
            }
        }
    });
}

/// What the rows say of the unknowns of the campaign; rows with others are left out, which is what
/// remains of a normal distribution for the rest.
fn known(root: &Section<'_>, rows: &[(KnownRow, Place)], design: &Design) -> Option<Known> {
    let names = design.names();
    let is_ours = |row: &KnownRow| row.of.iter().all(|(name, _)| names.contains(name));
    for (row, place) in rows.iter().filter(|(row, _)| !is_ours(row)) {
        let strange = |name: &&String| !names.contains(name);
        let Some(name) = row.of.iter().map(|(name, _)| name).find(strange) else { continue };
        // Of an instrument that is not used any more nothing need be known.
        let instrument = name.split_once('.').map(|(i, _)| i);
        let is_gone =
            instrument.is_some_and(|i| design.instruments.iter().all(|own| own.name != i));
        if !is_gone {
            let message = format!(
                "{name} is known from before, but is not among the unknowns: it is left out"
            );
            let hint = "name it in [unknown] or the unknowns of the instrument; else the value of the \
                        machine file holds";
            let mut problems = trueaxis_input::Diagnostics::new();
            problems.warn("prior-unused", place.clone(), message, hint);
            root.take_over(problems);
        }
    }
    let kept: Vec<usize> = (0..rows.len()).filter(|k| is_ours(&rows[*k].0)).collect();
    let m = kept.len();
    if m == 0 {
        root.error(
            "prior-unused",
            "nothing of it is among the unknowns".into(),
            "is it the right file?",
        );
        return None;
    }
    let mut factors = DMatrix::zeros(m, names.len());
    for (i, k) in kept.iter().enumerate() {
        for (name, share) in &rows[*k].0.of {
            // why: only rows whose names are all known were kept
            let Some(at) = names.iter().position(|n| n == name) else { continue };
            factors[(i, at)] = *share;
        }
    }
    let covariance = DMatrix::from_fn(m, m, |i, j| {
        let (low, high) = (kept[i.min(j)], kept[i.max(j)]);
        rows[high].0.covariance[low]
    });
    let values = DVector::from_fn(m, |i, _| rows[kept[i]].0.value);
    let moves = moves(rows, &kept);
    // What is stated is the same in the next campaign: it is no part of what is independent.
    let own = moves.iter().fold(covariance, |c, (_, m)| c - m * m.transpose());
    let known = Known::of_rows(names, &factors, &values, &own, &moves);
    if known.is_none() {
        let message =
            "this is no covariance: a correlation is 1 or more, or `stated` alone is more than u"
                .to_owned();
        root.error("bad-covariance", message, "take the file as `identify -o` wrote it");
    }
    known
}

/// How one standard uncertainty of each thing that a machine file states moves the rows that are kept.
fn moves(rows: &[(KnownRow, Place)], kept: &[usize]) -> Vec<(String, DVector<f64>)> {
    let mut moves: Vec<(String, DVector<f64>)> = Vec::new();
    for (i, k) in kept.iter().enumerate() {
        for (name, by) in &rows[*k].0.stated {
            let at = moves.iter().position(|(own, _)| own == name).unwrap_or_else(|| {
                moves.push((name.clone(), DVector::zeros(kept.len())));
                moves.len() - 1
            });
            moves[at].1[i] = *by;
        }
    }
    moves
}
