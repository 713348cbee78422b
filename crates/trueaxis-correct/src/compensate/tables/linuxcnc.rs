//! LinuxCNC: `COMP_FILE` of a joint, types 0 and 1; rotary centres in `linuxcnc_kinematics`.
//!
//! ```text
//!     type 0:  nominal  actual(forward)  actual(reverse)      trim = nominal − actual
//!     type 1:  nominal  trim(forward)    trim(reverse)
//!     motor position = commanded position + trim              straight between the rows, held beyond
//! ```
//!
//! As in the source: `usrmotLoadComp` (src/emc/motion/usrmotintf.cc) reads triplets until the first
//! line that is none, so there can be no comment; `EMCMOT_SET_JOINT_COMP` (command.c) refuses the 257th and
//! positions that do not rise, and keeps trims and slopes in single precision; `compute_screw_comp` (control.c)
//! takes the forward trim while the joint rises and the reverse one while it falls.

use super::content::Content;
use super::control::{Control, File, ReadFault, checked};
use super::linuxcnc_kinematics as kinematics;
use super::place::Rule;
use super::table::{Node, PER_UNIT, Table, axis_order, decimal, parse_decimal};
use std::fmt::Write;
use trueaxis_machine::Machine;
use trueaxis_machine::errors::ErrorName;

/// The largest table: EMCMOT_COMP_SIZE of motion.h.
const MOST_NODES: usize = 256;
const INI: &str = "compensation.ini";

/// LinuxCNC with trivial kinematics or a kinematics module whose joints are the axes in order.
pub struct LinuxCnc {
    /// Type 1 instead of type 0.
    pub trims: bool,
}

impl Control for LinuxCnc {
    fn key(&self) -> &'static str {
        "linuxcnc"
    }

    fn knows_location(&self, machine: &Machine, error: ErrorName) -> bool {
        kinematics::knows(machine, error)
    }

    fn has_modulo(&self) -> bool {
        false
    }

    fn rule(&self) -> Rule {
        Rule { most_nodes: MOST_NODES, ..Rule::FREE }
    }

    fn write(&self, machine: &Machine, content: &Content) -> Vec<File> {
        let order = axis_order(machine);
        let letters: Vec<String> =
            order.iter().map(|i| machine.axes()[*i].name.to_string()).collect();
        let mut ini = format!(
            "# TrueAxis: put these lines into the sections that the INI file has already;\n\
             # joints in the order of\n[TRAJ]\nCOORDINATES = {}\n",
            letters.join(" ")
        );
        let mut files = Vec::new();
        for (joint, axis) in order.iter().enumerate() {
            let Some(table) = content.tables.iter().find(|t| t.output == *axis) else { continue };
            let name = format!("joint_{joint}_{}.comp", letters[joint]);
            // Writing to a String cannot fail.
            let _ = write!(
                ini,
                "\n[JOINT_{joint}]\nCOMP_FILE = {name}\nCOMP_FILE_TYPE = {}\n",
                u8::from(self.trims)
            );
            let row = |n: &Node| {
                let shown = |trim: i64| decimal(if self.trims { trim } else { n.at - trim });
                format!("{} {} {}\n", decimal(n.at), shown(n.up), shown(n.down))
            };
            files.push(File { name, text: table.nodes.iter().map(row).collect() });
        }
        files.push(File { name: INI.to_owned(), text: ini });
        files.extend(content.joints.as_ref().and_then(|j| kinematics::write(machine, j)));
        files
    }

    fn read(&self, machine: &Machine, files: &[File]) -> Result<Content, ReadFault> {
        let find = |name: &str| {
            let found = files.iter().find(|f| f.name == name);
            found.ok_or_else(|| ReadFault::new(name, "this file"))
        };
        let order = axis_order(machine);
        let mut tables = Vec::new();
        for joint in joints(find(INI)?)? {
            let fault = || ReadFault::new(INI, "joints of the machine only");
            let axis = *order.get(joint.number).ok_or_else(fault)?;
            let nodes = rows(find(&joint.file)?, joint.trims)?;
            let table = Table { input: axis, output: axis, modulo: false, nodes };
            tables.push(checked(&joint.file, table, MOST_NODES)?);
        }
        let pins = files.iter().find(|f| f.name == kinematics::NAME);
        let joints = pins.map(|f| kinematics::read(machine, f)).transpose()?;
        Ok(Content { tables, joints, ..Content::default() })
    }

    /// Trims and slopes are single precision in the motion controller.
    fn value(&self, table: &Table, position: f64, side: f64) -> f64 {
        let after = table.nodes.partition_point(|n| n.at as f64 <= position);
        let one = |trim: &dyn Fn(&Node) -> i64| {
            let unit = |counts: i64| (counts as f64 / PER_UNIT) as f32;
            let Some(before) = after.checked_sub(1).and_then(|i| table.nodes.get(i)) else {
                return table.nodes.first().map_or(0.0, |n| f64::from(unit(trim(n))));
            };
            let Some(next) = table.nodes.get(after) else { return f64::from(unit(trim(before))) };
            let span = (next.at - before.at) as f64 / PER_UNIT;
            let slope = (f64::from(unit(trim(next)) - unit(trim(before))) / span) as f32;
            let off = (position - before.at as f64) / PER_UNIT;
            f64::from(unit(trim(before))) + f64::from(slope) * off
        };
        let (up, down) = (one(&|n| n.up), one(&|n| n.down));
        let value = match side {
            s if s > 0.0 => up,
            s if s < 0.0 => down,
            _ => 0.5 * (up + down),
        };
        value * PER_UNIT
    }

    fn advice(&self) -> &'static [&'static str] {
        &[
            "COMP_FILE takes the place of BACKLASH of the joint",
            "positions are machine coordinates after homing; a rotary joint that wraps is compensated within its table only",
            "kinematics.hal, where there is one, after the module of KINEMATICS is loaded and instead of the setp lines of its centres; the part zero is set with it on",
        ]
    }
}

struct Joint {
    number: usize,
    file: String,
    trims: bool,
}

fn joints(ini: &File) -> Result<Vec<Joint>, ReadFault> {
    let mut joints: Vec<Joint> = Vec::new();
    let mut number = None;
    for line in ini.text.lines().map(str::trim).filter(|l| !l.starts_with(['#', ';'])) {
        if let Some(section) = line.strip_prefix('[').and_then(|l| l.strip_suffix(']')) {
            number = section.strip_prefix("JOINT_").and_then(|n| n.parse().ok());
            continue;
        }
        let (Some(number), Some((key, value))) = (number, line.split_once('=')) else { continue };
        match (key.trim(), value.trim(), joints.last_mut()) {
            ("COMP_FILE", file, _) => {
                joints.push(Joint { number, file: file.to_owned(), trims: false });
            }
            ("COMP_FILE_TYPE", kind @ ("0" | "1"), Some(joint)) => joint.trims = kind == "1",
            ("COMP_FILE_TYPE", _, _) => {
                return Err(ReadFault::new(INI, "COMP_FILE_TYPE 0 or 1 after COMP_FILE"));
            }
            _ => {}
        }
    }
    Ok(joints)
}

fn rows(file: &File, trims: bool) -> Result<Vec<Node>, ReadFault> {
    let mut nodes: Vec<Node> = Vec::new();
    for (i, line) in file.text.lines().enumerate() {
        let numbers: Option<Vec<i64>> = line.split_whitespace().map(parse_decimal).collect();
        let Some([at, forward, reverse]) = numbers.as_deref() else {
            // LinuxCNC would end here without a word.
            return Err(ReadFault::new(&file.name, format!("line {}: three numbers", i + 1)));
        };
        if nodes.last().is_some_and(|n| n.at >= *at) {
            return Err(ReadFault::new(&file.name, format!("line {}: rising positions", i + 1)));
        }
        let trim = |v: i64| if trims { v } else { at - v };
        nodes.push(Node { at: *at, up: trim(*forward), down: trim(*reverse) });
    }
    Ok(nodes)
}
