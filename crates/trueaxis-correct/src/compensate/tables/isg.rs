//! ISG kernel and Beckhoff TwinCAT CNC: volumetric compensation (`ISG_CSV`) of the tip, and leadscrew lists of the
//! rotary axes.
//!
//! ```text
//!     volcomp.csv      argument (mm, deg) and errors of one axis (mm, rad), blocks ended by `#`
//!     achskw_C.lis     kw.ssfk.table[i]: actual − setpoint, 0.0001 deg
//! ```
//!
//! The control moves the tip back with its own chain and leaves the tool axis alone. docs/compensation-tables.md has
//! the pages.

use super::content::{Content, Known};
use super::control::{Control, File, ReadFault, checked};
use super::place::{Rule, Spacing};
use super::table::{Node, Table, axis_order, decimal, parse_decimal};
use std::collections::BTreeMap;
use std::fmt::Write;
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{AxisKind, Travel};
use trueaxis_machine::chain::ErrorFrame;
use trueaxis_machine::errors::ErrorName;

/// A control with the ISG kernel.
pub struct Isg;

const VOLUME: &str = "volcomp.csv";
const LIST: &str = "vol_comp_0.lis";
/// Records of the example of the manual; the start-up list can allow more.
const MOST_RECORDS: usize = 2000;
/// Entries of a leadscrew list without another setting.
const MOST_NODES: usize = 1500;
/// 0.0001 deg in counts.
const UNIT: i64 = 100;

impl Control for Isg {
    fn key(&self) -> &'static str {
        "isg"
    }

    fn letters(&self) -> &'static str {
        "XYZABC"
    }

    /// The tip is left to the volumetric compensation; only rotary axes have lists of their own.
    fn pairs(&self, machine: &Machine) -> Vec<(usize, usize)> {
        let rotary = machine.axes().iter().enumerate().filter(|(_, a)| a.kind == AxisKind::Rotary);
        rotary.map(|(i, _)| (i, i)).collect()
    }

    fn knows_links(&self) -> bool {
        true
    }

    fn has_one_file_of_links(&self) -> bool {
        true
    }

    fn link_frame(&self, machine: &Machine, body: usize) -> ErrorFrame {
        match machine.bodies()[body].axis.map(|i| machine.axes()[i].kind) {
            Some(AxisKind::Rotary) => ErrorFrame::Fixed,
            _ => ErrorFrame::Moving,
        }
    }

    fn rule(&self) -> Rule {
        Rule { most_nodes: MOST_NODES, increment: UNIT as f64, position: UNIT, ..Rule::FREE }
    }

    fn known_rule(&self) -> Rule {
        Rule { spacing: Spacing::Equal, most_nodes: MOST_RECORDS, ..self.rule() }
    }

    fn write(&self, machine: &Machine, content: &Content) -> Vec<File> {
        let order = axis_order(machine);
        let mut files = vec![
            File { name: LIST.to_owned(), text: list(machine, &order, content) },
            File { name: VOLUME.to_owned(), text: volume(machine, content) },
        ];
        for table in &content.tables {
            let number = order.iter().position(|a| *a == table.input).map_or(0, |n| n + 1);
            let letter = machine.axes()[table.input].name;
            let name = format!("achskw_{letter}.lis");
            files.push(File { name, text: leadscrew(table, number, letter.letter()) });
        }
        files
    }

    fn read(&self, machine: &Machine, files: &[File]) -> Result<Content, ReadFault> {
        let mut content = Content::default();
        for file in files {
            match file.name.as_str() {
                LIST => {}
                VOLUME => content.known = blocks(machine, file)?,
                _ => content.tables.push(read_leadscrew(machine, file)?),
            }
        }
        Ok(content)
    }

    fn advice(&self) -> &'static [&'static str] {
        &[
            "the two lines of hochlauf.lis stand as comments at the head of vol_comp_0.lis; logical axis numbers there are 1, 2, … : put in those of the machine",
            "leadscrew lists: kopf.achs_nr is to be the logical axis number; lr_param.ssfk 1; no other backlash compensation",
            "check the sign with one axis and a dial before all is switched on: if the tip moves the other way, name the axis in `negate`",
            "location errors stand in the functions of their axis, so X0X … C0C are not to be entered a second time",
        ]
    }
}

fn list(machine: &Machine, order: &[usize], content: &Content) -> String {
    let records: usize = content.known.iter().map(|k| k.nodes.len()).sum();
    let mut text = format!(
        "# TrueAxis: configuration of the volumetric compensation; in hochlauf.lis:\n\
         # vol_comp[0].max_records {records}\n# vol_comp[0].file_name {LIST}\n"
    );
    for (n, axis) in order.iter().enumerate() {
        // Writing to a String cannot fail.
        let _ = writeln!(text, "{} {}", machine.axes()[*axis].name, n + 1);
    }
    let chain: String = machine.axes().iter().map(|a| a.name.letter()).collect();
    let carrying = machine.bodies()[..machine.workpiece_side()].iter().filter(|b| b.axis.is_some());
    let _ = writeln!(text, "chain {chain}\nworkpiece_axes {}", carrying.count());
    text + &format!("file[0] {VOLUME}\nfile_format[0] ISG_CSV\n")
}

/// One block for each axis, its errors as columns.
fn volume(machine: &Machine, content: &Content) -> String {
    let mut text =
        "// TrueAxis: actual minus nominal, mm and rad; arguments mm and deg\n".to_owned();
    for body in machine.bodies() {
        let of: Vec<&Known> = content.known.iter().filter(|k| k.error.body == body.name).collect();
        let Some(first) = of.first() else { continue };
        let names: Vec<String> = of.iter().map(|k| k.error.to_string()).collect();
        let _ = writeln!(text, "{} {}", body.name, names.join(" "));
        for (row, node) in first.nodes.iter().enumerate() {
            let values: Vec<String> = of.iter().map(|k| value_text(k, k.nodes[row].up)).collect();
            let _ = writeln!(text, "{} {}", decimal(node.at), values.join(" "));
        }
        text += "#\n";
    }
    text
}

fn value_text(known: &Known, counts: i64) -> String {
    match known.error.component.is_rotation() {
        false => decimal(counts),
        // 10⁻⁹ rad: three digits more than a decimal of counts has.
        true => format!("{}e-3", decimal(counts)),
    }
}

fn blocks(machine: &Machine, file: &File) -> Result<Vec<Known>, ReadFault> {
    let mut known = Vec::new();
    let mut block: Vec<Known> = Vec::new();
    for (i, line) in file.text.lines().enumerate() {
        let fault =
            |expected: &str| ReadFault::new(&file.name, format!("line {}: {expected}", i + 1));
        let cells: Vec<&str> = line.split_whitespace().collect();
        match cells[..] {
            [] => {}
            [first, ..] if first.starts_with("//") => {}
            ["#"] => known.append(&mut block),
            [argument, ref errors @ ..] if block.is_empty() => {
                for error in errors {
                    let error = ErrorName::parse(error).filter(|e| e.body.to_string() == argument);
                    let error =
                        error.ok_or_else(|| fault("errors of the axis in front of them"))?;
                    let axis = machine.axis_index(error.body);
                    let axis = axis.ok_or_else(|| fault("an axis of the machine"))?;
                    let modulo = machine.axes()[axis].travel == Travel::Unlimited;
                    block.push(Known { error, modulo, nodes: Vec::new() });
                }
            }
            [at, ref values @ ..] if values.len() == block.len() => {
                let at = parse_decimal(at).ok_or_else(|| fault("a position"))?;
                for (known, value) in block.iter_mut().zip(values) {
                    let number = value.parse::<f64>().ok().map(|v| (v / known.count()).round());
                    let number = number.filter(|v| v.abs() < 1e15);
                    let up = number.ok_or_else(|| fault("numbers"))? as i64;
                    if known.nodes.last().is_some_and(|n| n.at >= at) {
                        return Err(fault("rising positions"));
                    }
                    known.nodes.push(Node { at, up, down: up });
                }
            }
            _ => return Err(fault("as many values as the head of the block has errors")),
        }
    }
    match block.is_empty() {
        true => Ok(known),
        false => Err(ReadFault::new(&file.name, "`#` after the last block")),
    }
}

/// A leadscrew list: the errors, not what is added.
fn leadscrew(table: &Table, number: usize, letter: char) -> String {
    let mut text = format!(
        "# TrueAxis: actual minus setpoint, unit 1: 0.0001 deg\nkopf.achs_nr {number}\n\
         kopf.log_achs_name {letter}\nkw.ssfk.interval 0\nkw.ssfk.kw_nr_max {}\nkw.ssfk.unit 1\n\
         kw.ssfk.bilateral {}\nkw.ssfk.modulo {}\n",
        table.nodes.len(),
        u8::from(table.is_directional()),
        u8::from(table.modulo)
    );
    for (i, n) in table.nodes.iter().enumerate() {
        // Writing to a String cannot fail.
        let _ = writeln!(text, "kw.ssfk.table[{i}].setpoint {}", units(n.at));
        let _ = writeln!(text, "kw.ssfk.table[{i}].pos {}", units(-n.up));
        let _ = writeln!(text, "kw.ssfk.table[{i}].neg {}", units(-n.down));
    }
    text
}

/// Counts in 0.0001 deg.
fn units(counts: i64) -> i64 {
    counts / UNIT
}

fn read_leadscrew(machine: &Machine, file: &File) -> Result<Table, ReadFault> {
    let fault = |expected: &str| ReadFault::new(&file.name, expected);
    let lines = file.text.lines().filter(|l| !l.starts_with('#'));
    let pairs: BTreeMap<&str, &str> = lines.filter_map(|l| l.split_once(' ')).collect();
    let text = |key: &str| {
        let found = pairs.get(key).copied();
        found.ok_or_else(|| fault(&format!("a line `{key}`")))
    };
    let letter = text("kopf.log_achs_name")?;
    let axis = machine.axes().iter().position(|a| a.name.to_string() == letter);
    let axis = axis.ok_or_else(|| fault("an axis of the machine"))?;
    let counts = |key: String| {
        let value = text(&key)?.parse::<f64>().ok().map(|v| (v * UNIT as f64).round());
        let value = value.filter(|v| v.abs() < 1e15);
        value.map(|v| v as i64).ok_or_else(|| fault(&format!("a number as {key}")))
    };
    for (key, value) in [("kw.ssfk.interval", "0"), ("kw.ssfk.unit", "1")] {
        if text(key)? != value {
            return Err(fault(&format!("{key} {value}")));
        }
    }
    let rows = text("kw.ssfk.kw_nr_max")?.parse::<usize>().ok().filter(|n| *n <= MOST_NODES);
    let rows = rows.ok_or_else(|| fault(&format!("at most {MOST_NODES} rows")))?;
    let mut nodes = Vec::new();
    for i in 0..rows {
        let of = |key: &str| counts(format!("kw.ssfk.table[{i}].{key}"));
        nodes.push(Node { at: of("setpoint")?, up: -of("pos")?, down: -of("neg")? });
    }
    let modulo = text("kw.ssfk.modulo")? == "1";
    checked(&file.name, Table { input: axis, output: axis, modulo, nodes }, MOST_NODES)
}
