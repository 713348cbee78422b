//! SINUMERIK: `$AA_ENC_COMP` (measuring-system error of one axis) and `$AN_CEC` (one axis on any axis).
//!
//! ```text
//!     value = −what is added to the command: a positive value moves the axis in the negative direction
//! ```
//!
//! Equal distances, straight lines, end values held beyond the table, repeated with the modulo function. Own
//! tables without reversal go into `$AA_ENC_COMP`; with reversal into two `$AN_CEC` tables of one direction
//! each, as the manual does it. docs/compensation-tables.md has the pages.

use super::carrier_chain::CarrierChain;
use super::content::Content;
use super::control::{Control, File, ReadFault, checked, ended};
use super::joints::Joints;
use super::place::{Rule, Spacing};
use super::table::{Node, Table, axis_order, decimal, parse_decimal};
use super::{temp_comp, tool_carrier};
use std::collections::BTreeMap;
use std::fmt::Write;
use trueaxis_machine::Machine;
use trueaxis_machine::errors::ErrorName;

/// Interpolatory compensation of a SINUMERIK 840D sl or 828D.
pub struct Sinumerik {
    /// The least increment of a value. Unit: counts.
    pub increment: f64,
}

const ENCODER: &str = "AX_EEC.INI";
const CROSS: &str = "NC_CEC.INI";
/// What MD38000 and MD18342 can be set to at most.
const MOST_NODES: usize = 2000;
/// $AN_CEC tables: two for each of 31 axes.
const MOST_TABLES: usize = 62;

impl Control for Sinumerik {
    fn key(&self) -> &'static str {
        "sinumerik"
    }

    fn has_cross_tables(&self) -> bool {
        true
    }

    fn knows_location(&self, machine: &Machine, error: ErrorName) -> bool {
        tool_carrier::knows(machine, error)
    }

    fn has_temperature_lines(&self) -> bool {
        true
    }

    fn rule(&self) -> Rule {
        Rule {
            spacing: Spacing::Equal,
            most_nodes: MOST_NODES,
            increment: self.increment,
            ..Rule::FREE
        }
    }

    /// `$AN_CEC` tables are numbered from 0 in every file; `$AA_ENC_COMP` has one for each axis.
    fn shares_numbers(
        &self,
        written: &Table,
        (input, output): (usize, usize),
        directed: bool,
    ) -> bool {
        let in_cross = |own: bool, directed: bool| !own || directed;
        in_cross(written.input == written.output, written.is_directional())
            && in_cross(input == output, directed)
    }

    fn most_tables(&self) -> usize {
        MOST_TABLES / 2
    }

    fn write(&self, machine: &Machine, content: &Content) -> Vec<File> {
        let order = axis_order(machine);
        let names: Vec<String> = order
            .iter()
            .enumerate()
            .map(|(n, axis)| format!("AX{} = {}", n + 1, machine.axes()[*axis].name))
            .collect();
        let head = |program: &str| {
            format!(
                "%_N_{program}_INI\n;TrueAxis; {}\n;mm and deg; a positive value moves the axis in the \
                 negative direction\nCHANDATA(1)\n",
                names.join(", ")
            )
        };
        let number = |axis: usize| order.iter().position(|a| *a == axis).map_or(0, |n| n + 1);
        let (mut encoder, mut cross) = (head("AX_EEC"), head("NC_CEC"));
        let mut count = 0;
        for table in &content.tables {
            if table.input == table.output && !table.is_directional() {
                encoder += &encoder_text(table, number(table.input));
                continue;
            }
            let directions: &[i8] = if table.is_directional() { &[1, -1] } else { &[0] };
            for direction in directions {
                let axes = (number(table.input), number(table.output));
                cross += &cross_text(table, axes, (count, *direction));
                count += 1;
            }
        }
        let tables = [(ENCODER, encoder), (CROSS, cross)]
            .map(|(name, text)| File { name: name.to_owned(), text: text + "M17\n" });
        let carrier = content.joints.as_ref().and_then(|j| tool_carrier::write(machine, j));
        let warm = (!content.lines.is_empty()).then(|| temp_comp::write(machine, &content.lines));
        tables.into_iter().chain(carrier).chain(warm).collect()
    }

    fn read(&self, machine: &Machine, files: &[File]) -> Result<Content, ReadFault> {
        let (mut tables, mut lines, mut joints) = (Vec::new(), Vec::new(), None);
        for file in files {
            ended(file, "M17")?;
            match file.name.as_str() {
                tool_carrier::NAME => joints = Some(tool_carrier::read(machine, file)?),
                temp_comp::NAME => lines = temp_comp::read(machine, file)?,
                _ => read_tables(machine, file, &mut tables)?,
            }
        }
        Ok(Content { tables, lines, joints, ..Content::default() })
    }

    fn carrier_chain(&self, machine: &Machine, joints: &Joints) -> Option<CarrierChain> {
        let written = tool_carrier::write(machine, joints)?;
        let nominal = tool_carrier::write(machine, &Joints::nominal(machine))?;
        CarrierChain::of(machine, &written, &nominal)
    }

    fn advice(&self) -> &'static [&'static str] {
        &[
            "MD38000 and MD18342 at least the number of points; they re-format the memory: save the data first",
            "before loading: MD32700 $MA_ENC_COMP_ENABLE and MD32710 $MA_CEC_ENABLE 0, after it 1; SD41300 $SN_CEC_TABLE_ENABLE[t] = 1",
            "MD10200 and MD10210 at least 10 000 increments per mm and degree; MD32720 $MA_CEC_MAX_SUM above the largest value",
            "TEMP_COMP.SPF (with --temperature): SD43900, SD43910, SD43920 for those temperatures; MD32750 $MA_TEMP_COMP_TYPE = 3; the PLC is to write them as the temperatures change",
            "TOOLCARRIER.SPF adds nothing at zero angles, whatever its vectors are: set the part zero with the vectors in force, where `zero set` counts",
            "TOOLCARRIER.SPF: the vectors of the rotary axes, for CYCLE800 and for TRAORI of type 72; for types 24, 40 and 56 they are MD24500 ff. (Commissioning Manual SINUMERIK Operate)",
            "check the sign with one table and a dial: switched on at the place that is named, the axis must move by what the table adds; if it moves the other way, do not use the tables",
        ]
    }
}

fn read_tables(machine: &Machine, file: &File, tables: &mut Vec<Table>) -> Result<(), ReadFault> {
    let order = axis_order(machine);
    let axis = |name: &str| {
        let number = name.strip_prefix("AX").and_then(|n| n.parse::<usize>().ok());
        let axis = number.and_then(|n| order.get(n.checked_sub(1)?));
        axis.copied().ok_or_else(|| ReadFault::new(&file.name, format!("no axis `{name}`")))
    };
    for one in assignments(file)?.into_values() {
        let (input, output) =
            (axis(one.text(file, "INPUT_AXIS")?)?, axis(one.text(file, "OUTPUT_AXIS")?)?);
        join(file, tables, one.table(file, (input, output))?)?;
    }
    Ok(())
}

fn encoder_text(table: &Table, axis: usize) -> String {
    let mut text = String::new();
    for (i, n) in table.nodes.iter().enumerate() {
        // Writing to a String cannot fail.
        let _ = writeln!(text, "$AA_ENC_COMP[0,{i},AX{axis}]={}", decimal(-n.up));
    }
    for (key, value) in ends(table) {
        let _ = writeln!(text, "$AA_ENC_COMP_{key}[0,AX{axis}]={value}");
    }
    text
}

fn cross_text(
    table: &Table,
    (input, output): (usize, usize),
    (t, direction): (usize, i8),
) -> String {
    let mut text = String::new();
    for (i, n) in table.nodes.iter().enumerate() {
        let added = if direction < 0 { n.down } else { n.up };
        let _ = writeln!(text, "$AN_CEC[{t},{i}]={}", decimal(-added));
    }
    let _ = writeln!(text, "$AN_CEC_INPUT_AXIS[{t}]=(AX{input})");
    let _ = writeln!(text, "$AN_CEC_OUTPUT_AXIS[{t}]=(AX{output})");
    let _ = writeln!(text, "$AN_CEC_DIRECTION[{t}]={direction}");
    let _ = writeln!(text, "$AN_CEC_MULT_BY_TABLE[{t}]=0");
    for (key, value) in ends(table) {
        let _ = writeln!(text, "$AN_CEC_{key}[{t}]={value}");
    }
    text
}

fn ends(table: &Table) -> [(&'static str, String); 4] {
    let (first, last) = (table.nodes[0].at, table.nodes[table.nodes.len() - 1].at);
    [
        ("STEP", decimal(table.step().unwrap_or(0))),
        ("MIN", decimal(first)),
        ("MAX", decimal(last)),
        ("IS_MODULO", u8::from(table.modulo).to_string()),
    ]
}

/// What a file assigns to one table.
#[derive(Default)]
struct Assigned {
    keys: BTreeMap<String, String>,
    values: BTreeMap<usize, i64>,
}

impl Assigned {
    fn text(&self, file: &File, key: &str) -> Result<&str, ReadFault> {
        let found = self.keys.get(key).map(String::as_str);
        found.ok_or_else(|| ReadFault::new(&file.name, format!("a {key} for each table")))
    }

    fn number(&self, file: &File, key: &str) -> Result<i64, ReadFault> {
        let number = parse_decimal(self.text(file, key)?);
        number.ok_or_else(|| ReadFault::new(&file.name, format!("a number as {key}")))
    }

    /// The table and the direction in which it acts.
    fn table(&self, file: &File, axes: (usize, usize)) -> Result<(Table, i64), ReadFault> {
        let (min, max) = (self.number(file, "MIN")?, self.number(file, "MAX")?);
        let step = self.number(file, "STEP")?;
        let whole = step > 0 && max > min && (max - min) % step == 0;
        let count = if whole { (max - min) / step + 1 } else { 0 };
        if count != self.values.len() as i64 {
            return Err(ReadFault::new(&file.name, "one value for each STEP from MIN to MAX"));
        }
        let nodes = self.values.iter().map(|(i, value)| Node {
            at: min + *i as i64 * step,
            up: -value,
            down: -value,
        });
        let (input, output) = axes;
        let modulo = match self.text(file, "IS_MODULO")? {
            "0" => false,
            "1" => true,
            _ => return Err(ReadFault::new(&file.name, "IS_MODULO 0 or 1")),
        };
        let table = Table { input, output, modulo, nodes: nodes.collect() };
        let direction = self.keys.get("DIRECTION").map_or(Some(0), |d| d.parse().ok());
        let direction = direction.filter(|d| (-1..=1).contains(d));
        let fault = || ReadFault::new(&file.name, "DIRECTION −1, 0 or 1");
        Ok((checked(&file.name, table, MOST_NODES)?, direction.ok_or_else(fault)?))
    }
}

/// Tables by their number or axis, in the order of the file.
fn assignments(file: &File) -> Result<BTreeMap<(usize, String), Assigned>, ReadFault> {
    let mut tables: BTreeMap<(usize, String), Assigned> = BTreeMap::new();
    for (i, line) in file.text.lines().enumerate() {
        let line = line.split(';').next().unwrap_or("").trim();
        if line.is_empty() || line.starts_with('%') || line == "CHANDATA(1)" || line == "M17" {
            continue;
        }
        let fault =
            || ReadFault::new(&file.name, format!("line {}: $AA_ENC_COMP… or $AN_CEC…", i + 1));
        let (name, value) = line.split_once('=').ok_or_else(fault)?;
        let (name, index) = name.trim().split_once('[').ok_or_else(fault)?;
        let index: Vec<&str> = index.trim_end_matches(']').split(',').map(str::trim).collect();
        let value = value.trim().trim_matches(['(', ')']);
        let (name, index, point) = match (name.strip_prefix("$AA_ENC_COMP"), &index[..]) {
            (Some(name), ["0", axis]) => (name, *axis, None),
            (Some(""), ["0", point, axis]) => ("", *axis, Some(*point)),
            (None, [t]) => (name.strip_prefix("$AN_CEC").ok_or_else(fault)?, *t, None),
            (None, [t, point]) if name == "$AN_CEC" => ("", *t, Some(*point)),
            _ => return Err(fault()),
        };
        let number = index.trim_start_matches("AX").parse::<usize>().map_err(|_| fault())?;
        let table = tables.entry((number, index.to_owned())).or_default();
        if index.starts_with("AX") {
            for key in ["INPUT_AXIS", "OUTPUT_AXIS"] {
                table.keys.insert(key.to_owned(), index.to_owned());
            }
        }
        match point {
            Some(point) => {
                let point = point.parse().map_err(|_| fault())?;
                table.values.insert(point, parse_decimal(value).ok_or_else(fault)?);
            }
            None => {
                let key = name.strip_prefix('_').ok_or_else(fault)?;
                table.keys.insert(key.to_owned(), value.to_owned());
            }
        }
    }
    Ok(tables)
}

/// Puts a table to the others; the two of one pair of axes that act in one direction each are one.
fn join(
    file: &File,
    tables: &mut Vec<Table>,
    (table, direction): (Table, i64),
) -> Result<(), ReadFault> {
    let same = |t: &&mut Table| (t.input, t.output) == (table.input, table.output);
    match (direction, tables.iter_mut().find(same)) {
        (-1, Some(rising)) if rising.nodes.len() == table.nodes.len() => {
            for (n, falling) in rising.nodes.iter_mut().zip(&table.nodes) {
                n.down = falling.down;
            }
        }
        (0 | 1, None) => tables.push(table),
        _ => {
            return Err(ReadFault::new(
                &file.name,
                "each pair of axes once, DIRECTION 1 before −1",
            ));
        }
    }
    Ok(())
}
