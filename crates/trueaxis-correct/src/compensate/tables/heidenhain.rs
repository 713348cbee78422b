//! HEIDENHAIN: axis-error compensation (`.COM`, `.CMA`) and KinematicsComp.
//!
//! ```text
//!     AXIS_X.COM     AXISPOS BACKLASH X     positioning error of the axis, rising in X, falling in BACKLASH
//!     AXIS_XC.COM    AXISPOS C1 … C6        EXX EYX EZX EAX EBX ECX as the kinematics table refers to them
//!     COMPTAB.TXT    Trans rows in front of each MachAxis of the kinematics table
//!     CONFIG.CMA     which .COM belongs to which axis
//! ```
//!
//! docs/compensation-tables.md has the pages, and what they do not say.

use super::content::{Content, Known};
use super::control::{Control, File, ReadFault, checked};
use super::place::Rule;
use super::table::{Node, PER_UNIT, Table, decimal};
use std::fmt::Write;
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{AxisKind, AxisSide, Travel};
use trueaxis_machine::chain::ErrorFrame;
use trueaxis_machine::errors::{BodyName, Component, ErrorKind, ErrorName};

/// A control with KinematicsComp, such as iTNC 530 HSCI.
pub struct Heidenhain;

/// Entries of a .COM.
const MOST_NODES: usize = 256;
/// 0.1 µm and 0.0001 deg in counts.
const INCREMENT: f64 = 100.0;

impl Control for Heidenhain {
    fn key(&self) -> &'static str {
        "heidenhain"
    }

    fn knows_links(&self) -> bool {
        true
    }

    /// Errors stand in front of the axis on the way from the tool to the table.
    fn link_frame(&self, machine: &Machine, body: usize) -> ErrorFrame {
        match machine.bodies()[body].axis.map(|i| machine.axes()[i].carries) {
            Some(AxisSide::Workpiece) => ErrorFrame::Fixed,
            _ => ErrorFrame::Moving,
        }
    }

    fn rule(&self) -> Rule {
        Rule { most_nodes: MOST_NODES, increment: INCREMENT, position: 100, ..Rule::FREE }
    }

    fn write(&self, machine: &Machine, content: &Content) -> Vec<File> {
        let mut files = Vec::new();
        for table in &content.tables {
            let letter = machine.axes()[table.input].name;
            files.push(File { name: format!("AXIS_{letter}.COM"), text: own_text(table, letter) });
        }
        for body in machine.bodies() {
            let of: Vec<&Known> =
                content.known.iter().filter(|k| k.error.body == body.name).collect();
            if !of.is_empty() {
                let name = format!("AXIS_{}C.COM", body.name);
                files.push(File { name, text: link_text(body.name, &of) });
            }
        }
        files.push(File { name: "CONFIG.CMA".to_owned(), text: assignment(machine, content) });
        files.push(File { name: "COMPTAB.TXT".to_owned(), text: rows(machine, content) });
        files
    }

    fn read(&self, machine: &Machine, files: &[File]) -> Result<Content, ReadFault> {
        let mut content = Content::default();
        for file in files.iter().filter(|f| f.name.ends_with(".COM")) {
            let stem = file.name.trim_start_matches("AXIS_").trim_end_matches(".COM");
            let (letter, links) = match stem.strip_suffix('C') {
                Some(letter) if !letter.is_empty() => (letter, true),
                _ => (stem, false),
            };
            let axis = machine.axes().iter().position(|a| a.name.to_string() == letter);
            let fault = || ReadFault::new(&file.name, "an axis of the machine as its name");
            let axis = axis.ok_or_else(fault)?;
            match links {
                true => content.known.extend(read_links(machine, axis, file)?),
                false => content.tables.push(read_own(machine, axis, file)?),
            }
        }
        Ok(content)
    }

    fn advice(&self) -> &'static [&'static str] {
        &[
            "head and columns of .COM are those of a TNC 640 as a program of practice writes them; .CMA and COMPTAB have no public form: enter their rows with the table editor of the control",
            "BACKLASH holds the values of the negative direction, as in the manual of the MANUALplus 620",
            "values are actual minus nominal, mm and deg; check the sign with one table and a dial before all are switched on",
            "COMPTAB.TXT has the rows that stand in front of each MachAxis of the kinematics table, which has to be in the form with KEY, AXIS, COORD; KinematicsComp is an option",
            "positions are machine positions; location errors stand in the functions of their axis",
        ]
    }
}

fn own_text(table: &Table, letter: BodyName) -> String {
    let mut text = format!("BEGIN AXIS_{letter}.COM MM\n");
    text += &row("NR", &["AXISPOS".to_owned(), "BACKLASH".to_owned(), letter.to_string()]);
    for (i, n) in table.nodes.iter().enumerate() {
        text += &row(&i.to_string(), &[n.at, -n.down, -n.up].map(|c| signed(&decimal(c))));
    }
    text + "[END]\n"
}

/// A number of 5 columns and cells of 14.
fn row(number: &str, cells: &[String]) -> String {
    let cells: String = cells.iter().map(|c| format!("{c:<14}")).collect();
    format!("{}\n", format!("{number:<5}{cells}").trim_end())
}

fn signed(number: &str) -> String {
    if number.starts_with('-') { number.to_owned() } else { format!("+{number}") }
}

fn link_text(letter: BodyName, of: &[&Known]) -> String {
    let column = |k: &&Known| format!("C{}", k.error.component as usize + 1);
    let mut head = vec!["AXISPOS".to_owned()];
    head.extend(of.iter().map(column));
    let mut text = format!("BEGIN AXIS_{letter}C.COM MM\n{}", row("NR", &head));
    for (i, node) in of[0].nodes.iter().enumerate() {
        let mut cells = vec![signed(&decimal(node.at))];
        cells.extend(of.iter().map(|k| signed(&value_text(k, k.nodes[i].up))));
        text += &row(&i.to_string(), &cells);
    }
    text + "[END]\n"
}

/// mm, or degrees with so many digits that no count is lost.
fn value_text(known: &Known, counts: i64) -> String {
    match known.error.component.is_rotation() {
        false => decimal(counts),
        true => format!("{:.9}", (counts as f64 * Known::COUNT_RAD).to_degrees()),
    }
}

fn assignment(machine: &Machine, content: &Content) -> String {
    let own = |axis: &usize| content.tables.iter().any(|t| t.input == *axis);
    let axes: Vec<usize> = (0..machine.axes().len()).filter(own).collect();
    let names: Vec<String> = axes.iter().map(|i| machine.axes()[*i].name.to_string()).collect();
    let names = names.join(" ");
    format!("NR ACTIVE {names}\n0 * {names}\n[END]\n")
}

/// From the tool to the table: the errors of each axis in front of it.
fn rows(machine: &Machine, content: &Content) -> String {
    let mut text = "NR DOC KEY AXIS COORD COMPTAB\n".to_owned();
    let axes = machine.bodies().iter().rev().filter(|b| b.axis.is_some());
    for body in axes {
        for known in content.known.iter().filter(|k| k.error.body == body.name) {
            let (letter, column) =
                (known.error.component.letter(), known.error.component as usize + 1);
            let _ = writeln!(text, "{} Trans {letter} {}C..C{column}", known.error, body.name);
        }
        let _ = writeln!(text, "MachAxis {}", body.name);
    }
    text + "[END]\n"
}

/// Rows of numbers after a head that begins with NR AXISPOS.
fn cells(file: &File) -> Result<(Vec<&str>, Vec<Vec<f64>>), ReadFault> {
    let fault = |line: usize, expected: &str| {
        ReadFault::new(&file.name, format!("line {}: {expected}", line + 1))
    };
    let mut lines = file.text.lines().enumerate();
    let begins = lines.next().is_some_and(|(_, l)| l == format!("BEGIN {} MM", file.name));
    if !begins {
        return Err(fault(0, "BEGIN, the name of the file, MM"));
    }
    let head: Vec<&str> = lines.next().map_or(Vec::new(), |(_, l)| l.split_whitespace().collect());
    let ["NR", "AXISPOS", ..] = head[..] else { return Err(fault(1, "NR AXISPOS …")) };
    let mut rows = Vec::new();
    for (i, line) in lines {
        if line == "[END]" {
            return Ok((head, rows));
        }
        let row: Option<Vec<f64>> = line
            .split_whitespace()
            .map(|c| c.parse().ok().filter(|v: &f64| v.abs() < 1e9))
            .collect();
        let row = row.filter(|r| r.len() == head.len());
        rows.push(row.ok_or_else(|| fault(i, "one number for each column"))?);
    }
    Err(ReadFault::new(&file.name, "[END] after the last row"))
}

fn whole(value: f64) -> i64 {
    (value * PER_UNIT).round() as i64
}

fn read_own(machine: &Machine, axis: usize, file: &File) -> Result<Table, ReadFault> {
    let (head, rows) = cells(file)?;
    let [_, _, "BACKLASH", _] = head[..] else {
        return Err(ReadFault::new(&file.name, "line 2: NR AXISPOS BACKLASH and the axis"));
    };
    let node = |r: &Vec<f64>| Node { at: whole(r[1]), up: -whole(r[3]), down: -whole(r[2]) };
    let modulo = endless(machine, axis);
    let nodes = rows.iter().map(node).collect();
    checked(&file.name, Table { input: axis, output: axis, modulo, nodes }, MOST_NODES)
}

fn read_links(machine: &Machine, axis: usize, file: &File) -> Result<Vec<Known>, ReadFault> {
    let (head, rows) = cells(file)?;
    let body = machine.axes()[axis].name;
    let modulo = endless(machine, axis);
    let mut known = Vec::new();
    for (column, name) in head.iter().enumerate().skip(2) {
        let component = name.strip_prefix('C').and_then(|n| n.parse::<usize>().ok());
        let component = component.and_then(|n| Component::ALL.get(n.wrapping_sub(1)).copied());
        let fault = || ReadFault::new(&file.name, "line 2: columns C1 to C6");
        let component = component.ok_or_else(fault)?;
        let error = ErrorName { body, kind: ErrorKind::Motion, component };
        let node = |r: &Vec<f64>| {
            let value = match component.is_rotation() {
                true => (r[column].to_radians() / Known::COUNT_RAD).round() as i64,
                false => whole(r[column]),
            };
            Node { at: whole(r[1]), up: value, down: value }
        };
        known.push(Known { error, modulo, nodes: rows.iter().map(node).collect() });
    }
    match rows.len() <= MOST_NODES {
        true => Ok(known),
        false => Err(ReadFault::new(&file.name, format!("at most {MOST_NODES} rows"))),
    }
}

fn endless(machine: &Machine, axis: usize) -> bool {
    let axis = &machine.axes()[axis];
    axis.kind == AxisKind::Rotary && axis.travel == Travel::Unlimited
}
