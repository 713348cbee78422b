//! Plain CSV: every table of one axis acting on one axis, for controls and programs that have no format of
//! their own here. Straight lines between the nodes, the end values held beyond.

use super::content::Content;
use super::control::{Control, File, ReadFault, checked};
use super::joints::moves_an_axis;
use super::joints_csv;
use super::place::Rule;
use super::table::{Node, Table, decimal, parse_decimal};
use trueaxis_machine::Machine;
use trueaxis_machine::errors::ErrorName;

/// The plain format of this project.
pub struct Csv;

const NAME: &str = "compensation.csv";
const HEADINGS: [&str; 6] = ["input", "output", "modulo", "position", "added_up", "added_down"];
const MOST_NODES: usize = 10_000;

impl Control for Csv {
    fn key(&self) -> &'static str {
        "csv"
    }

    fn has_cross_tables(&self) -> bool {
        true
    }

    fn knows_location(&self, machine: &Machine, error: ErrorName) -> bool {
        moves_an_axis(machine, error)
    }

    fn rule(&self) -> Rule {
        Rule { most_nodes: MOST_NODES, ..Rule::FREE }
    }

    fn write(&self, machine: &Machine, content: &Content) -> Vec<File> {
        let letter = |axis: usize| machine.axes()[axis].name.letter();
        let mut text = "# TrueAxis compensation tables: mm and deg, added to the command of the output axis\n\
                        # while the input axis rises (up) or falls (down); straight lines, held at the ends\n"
            .to_owned();
        text += &HEADINGS.join(",");
        text.push('\n');
        for table in &content.tables {
            let (input, output) = (letter(table.input), letter(table.output));
            for n in &table.nodes {
                let [at, up, down] = [n.at, n.up, n.down].map(decimal);
                let modulo = u8::from(table.modulo);
                text += &format!("{input},{output},{modulo},{at},{up},{down}\n");
            }
        }
        let kinematics = content.joints.as_ref().map(joints_csv::write);
        [File { name: NAME.to_owned(), text }].into_iter().chain(kinematics).collect()
    }

    fn read(&self, machine: &Machine, files: &[File]) -> Result<Content, ReadFault> {
        let find = |name: &str| files.iter().find(|f| f.name == name);
        let file = find(NAME).ok_or_else(|| ReadFault::new(NAME, "this file"))?;
        let kinematics = find(joints_csv::NAME).map(|file| joints_csv::read(machine, file));
        let joints = kinematics.transpose()?;
        let fault = |expected: String| ReadFault::new(&file.name, expected);
        let mut lines = file.text.lines().filter(|l| !l.starts_with('#'));
        if lines.next() != Some(&HEADINGS.join(",")) {
            return Err(fault(format!("the headings {}", HEADINGS.join(","))));
        }
        let mut tables: Vec<Table> = Vec::new();
        for (i, line) in lines.enumerate() {
            let cells: Vec<&str> = line.split(',').map(str::trim).collect();
            let [input, output, modulo, at, up, down] = cells[..] else {
                return Err(fault(format!("row {}: {} cells", i + 1, HEADINGS.len())));
            };
            let axis = |name: &str| {
                let found = machine.axes().iter().position(|a| a.name.to_string() == name);
                found.ok_or_else(|| fault(format!("row {}: an axis of the machine", i + 1)))
            };
            let number = |text: &str| {
                parse_decimal(text).ok_or_else(|| fault(format!("row {}: decimal numbers", i + 1)))
            };
            let modulo = match modulo {
                "0" => false,
                "1" => true,
                _ => return Err(fault(format!("row {}: modulo 0 or 1", i + 1))),
            };
            let (input, output) = (axis(input)?, axis(output)?);
            let node = Node { at: number(at)?, up: number(up)?, down: number(down)? };
            match tables.iter_mut().find(|t| (t.input, t.output) == (input, output)) {
                Some(table) => table.nodes.push(node),
                None => tables.push(Table { input, output, modulo, nodes: vec![node] }),
            }
        }
        let tables = tables.into_iter().map(|t| checked(&file.name, t, MOST_NODES));
        Ok(Content { tables: tables.collect::<Result<_, _>>()?, joints, ..Content::default() })
    }

    fn advice(&self) -> &'static [&'static str] {
        &[]
    }
}
