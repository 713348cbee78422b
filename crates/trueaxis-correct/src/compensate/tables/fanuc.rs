//! FANUC: stored pitch error compensation in both directions, and the grid of 3-D error compensation.
//!
//! ```text
//!     pitch    number n: what the compensation grows by from point n − 1 to point n, in whole increments;
//!              at the reference position it is the grid shift (1850); given out half way between two points
//!     rotary   from the reference position (3620 = 3621) one turn on (3622 = 3620 + 3625/3624); the first number has the
//!              value of the last, and those after the first have the sum 0
//!     grid     trilinear between points of equal distances
//! ```
//!
//! docs/compensation-tables.md has the pages, and what they do not say.

use super::content::Content;
use super::control::{Control, File, ReadFault, checked};
use super::grid::{Grid, GridRule, Side};
use super::joints::moves_an_axis;
use super::joints_csv;
use super::place::{Rule, Spacing, stepwise};
use super::table::{Node, PER_UNIT, Table, axis_order, decimal, parse_decimal};
use std::collections::BTreeMap;
use std::fmt::Write;
use trueaxis_machine::Machine;
use trueaxis_machine::axis::AxisKind;
use trueaxis_machine::errors::ErrorName;

/// A FANUC 30i.
pub struct Fanuc;

/// 0.1 µm and 0.0001 deg, the detection unit of an IS-C control, in counts.
const UNIT: i64 = 100;
/// Points of one axis; six axes stay below the numbers 0 to 1023.
const MOST_NODES: usize = 128;
/// The number of a falling value is so much higher than that of the rising one.
const FALLING: i64 = 3000;
/// In the file a number is so much higher than on the screen.
const IN_FILE: i64 = 10_000;
/// Points of the grid.
const MOST_POINTS: usize = 15_625;

const PITCH: &str = "PITCH.TXT";
const PARAMETERS: &str = "PARAM.TXT";
const GRID: &str = "GRID3D.CSV";

impl Control for Fanuc {
    fn key(&self) -> &'static str {
        "fanuc"
    }

    /// Centres; directions are nominal.
    fn knows_location(&self, machine: &Machine, error: ErrorName) -> bool {
        moves_an_axis(machine, error) && !error.component.is_rotation()
    }

    fn rule(&self) -> Rule {
        Rule {
            spacing: Spacing::Stepped { unit: UNIT },
            most_nodes: MOST_NODES,
            increment: UNIT as f64,
            position: UNIT,
            ..Rule::FREE
        }
    }

    fn has_whole_turns(&self) -> bool {
        true
    }

    fn value(&self, table: &Table, position: f64, side: f64) -> f64 {
        let position = match table.modulo {
            true => position.rem_euclid(360.0 * PER_UNIT),
            false => position,
        };
        stepwise(&table.nodes, position, side)
    }

    /// The numbers of pitch data begin with 0 in every file.
    fn shares_numbers(&self, _written: &Table, _held: (usize, usize), _directed: bool) -> bool {
        true
    }

    fn grid(&self) -> Option<GridRule> {
        Some(GridRule {
            most_points: MOST_POINTS,
            most_along: MOST_NODES,
            increment: UNIT,
            largest: i64::from(i16::MAX) * UNIT,
            interval: UNIT,
        })
    }

    fn write(&self, machine: &Machine, content: &Content) -> Vec<File> {
        let (mut pitch, mut parameters) = ("%\n".to_owned(), "%\n".to_owned());
        let mut first = 0;
        for (number, axis) in axis_order(machine).into_iter().enumerate() {
            let Some(table) = content.tables.iter().find(|t| t.input == axis) else { continue };
            let rotary = machine.axes()[axis].kind == AxisKind::Rotary;
            parameters += &parameters_of(table, number + 1, first, rotary);
            pitch += &values_of(table, first);
            first += table.nodes.len() as i64;
        }
        // Blocks of a file that a control punches end with LF CR CR.
        let ended = |text: String| text.replace('\n', "\n\r\r");
        let file = |name: &str, text: String| File { name: name.to_owned(), text };
        let mut files =
            vec![file(PITCH, ended(pitch + "%\n")), file(PARAMETERS, ended(parameters + "%\n"))];
        if let Some(grid) = &content.grid {
            files.push(file(GRID, grid_text(machine, grid)));
        }
        files.extend(content.joints.as_ref().map(joints_csv::write));
        files
    }

    fn read(&self, machine: &Machine, files: &[File]) -> Result<Content, ReadFault> {
        let find = |name: &str| files.iter().find(|f| f.name == name);
        let needed = |name| find(name).ok_or_else(|| ReadFault::new(name, "this file"));
        let (pitch, parameters) = (numbers(needed(PITCH)?)?, numbers(needed(PARAMETERS)?)?);
        let mut tables = Vec::new();
        for (number, axis) in axis_order(machine).into_iter().enumerate() {
            let of = |n: i64| parameters.get(&(n, number + 1)).copied();
            if let Some(reference) = of(3620) {
                let modulo = machine.axes()[axis].kind == AxisKind::Rotary;
                let nodes = nodes(&pitch, (reference / COUNTS, modulo), &of)?;
                tables.push(checked(
                    PITCH,
                    Table { input: axis, output: axis, modulo, nodes },
                    MOST_NODES,
                )?);
            }
        }
        let grid = find(GRID).map(|file| read_grid(machine, file)).transpose()?;
        let joints =
            find(joints_csv::NAME).map(|file| joints_csv::read(machine, file)).transpose()?;
        Ok(Content { tables, grid, joints, ..Content::default() })
    }

    fn advice(&self) -> &'static [&'static str] {
        &[
            "detection unit 0.1 um and 0.0001 deg (increment system IS-C), magnification 1; the reference position is machine position 0",
            "N01850 is what is added at the reference position; with an absolute encoder shift the reference position by it instead",
            "check the sign with one table and a dial before all are loaded; power off and on, then reference return, before it acts",
            "compare PITCH.TXT and PARAM.TXT with files that the control has punched: lines and parameter numbers are those of 16i manuals and of backups of 31i controls, N10000Q0 is not proved",
            "GRID3D.CSV lists the points of 3-D error compensation (option); its file form is not public: enter the grid with the parameters of the function",
            "straightness compensation is off: the grid contains it",
            "kinematics.csv: the centres belong into the parameters of the 5-axis machine (19700 ff.); their directions stay nominal",
        ]
    }
}

/// Parameters 1850, 3605 and 3620 to 3627 of an axis.
fn parameters_of(table: &Table, axis: usize, first: i64, rotary: bool) -> String {
    let last = first + table.nodes.len() as i64 - 1;
    let step = table.step().unwrap_or(UNIT);
    let reference = first - table.nodes[0].at / step;
    let mut text = String::new();
    let mut line = |number: i64, value: String| {
        // Writing to a String cannot fail.
        let _ = writeln!(text, "N{number:05}Q1A{axis}P{value}");
    };
    let both = table.is_directional();
    let (up, down) = at_zero(table);
    line(1850, (up / UNIT).to_string());
    line(3605, format!("0000000{}", u8::from(both)));
    line(3620, reference.to_string());
    line(3621, first.to_string());
    line(3622, last.to_string());
    line(3623, "1".to_owned());
    line(3624, decimal(step));
    if rotary {
        line(3625, "360.".to_owned());
    }
    if both {
        line(3626, (first + FALLING).to_string());
        line(3627, ((down - up) / UNIT).to_string());
    }
    text
}

/// What is added at the reference position, rising and falling.
fn at_zero(table: &Table) -> (i64, i64) {
    table.nodes.iter().find(|n| n.at == 0).map_or((0, 0), |n| (n.up, n.down))
}

/// What the compensation grows by up to each number.
fn values_of(table: &Table, first: i64) -> String {
    let mut text = String::new();
    let mut growth = |from: i64, value: &dyn Fn(&Node) -> i64| {
        // All around the first number is the last one again.
        let around = table.nodes.len().checked_sub(2).filter(|_| table.modulo).unwrap_or(0);
        let mut before = value(&table.nodes[around]);
        for (i, node) in table.nodes.iter().enumerate() {
            let grown = (value(node) - before) / UNIT;
            before = value(node);
            let _ = writeln!(text, "N{:05}Q0P{grown}", IN_FILE + from + i as i64);
        }
    };
    growth(first, &|n| n.up);
    if table.is_directional() {
        growth(first + FALLING, &|n| n.down);
    }
    text
}

/// A number of a file, and of an axis (0: none), with its value in counts.
type Numbers = BTreeMap<(i64, usize), i64>;
/// Counts of 1.
const COUNTS: i64 = PER_UNIT as i64;

fn numbers(file: &File) -> Result<Numbers, ReadFault> {
    let mut numbers = BTreeMap::new();
    let text = file.text.trim_matches(['\n', '\r']);
    if text.len() < 3
        || !text.starts_with("%\n")
        || !text.ends_with("\n%") && !text.ends_with("\r%")
    {
        return Err(ReadFault::new(&file.name, "% as its first and its last line"));
    }
    let lines = file.text.lines().map(|l| l.trim_matches('\r')).enumerate();
    for (i, line) in lines.filter(|(_, l)| !matches!(*l, "%" | "")) {
        let fault = || ReadFault::new(&file.name, format!("line {}: N…Q0P… or N…Q1A…P…", i + 1));
        let (key, value) = line.split_once('P').ok_or_else(fault)?;
        let key = key.strip_prefix('N').ok_or_else(fault)?;
        let (number, axis) = match key.split_once('Q').ok_or_else(fault)? {
            (number, "0") => (number, "0"),
            (number, kind) => (number, kind.strip_prefix("1A").ok_or_else(fault)?),
        };
        let key = (number.parse().map_err(|_| fault())?, axis.parse().map_err(|_| fault())?);
        let value = parse_decimal(value).ok_or_else(fault)?;
        if numbers.insert(key, value).is_some() {
            return Err(ReadFault::new(&file.name, format!("line {}: each number once", i + 1)));
        }
    }
    Ok(numbers)
}

/// A turn of a rotary axis, counts.
const TURN: i64 = 360 * COUNTS;

/// Where the points of an axis stand.
struct Points {
    first: i64,
    last: i64,
    reference: i64,
    step: i64,
}

impl Points {
    fn read(reference: i64, rotary: bool, get: &Get<'_>) -> Result<Self, ReadFault> {
        let fault = |expected| Err(ReadFault::new(PARAMETERS, expected));
        let (first, last, step) = (get(3621)? / COUNTS, get(3622)? / COUNTS, get(3624)?);
        let inside = (0..MOST_NODES as i64).contains(&(last - first));
        if !inside || !(first..=last).contains(&reference) || step <= 0 {
            return fault("3621 below 3620 below 3622, and 3624 above 0");
        }
        let is_turn = || Ok::<_, ReadFault>(get(3625)? == TURN && step * (last - first) == TURN);
        if rotary && (first != reference || !is_turn()?) {
            return fault("of a rotary axis 3621 = 3620, 3625 = 360, and 3622 = 3620 + 3625/3624");
        }
        Ok(Self { first, last, reference, step })
    }

    /// The compensation at each point from the data that begin with this number.
    fn absolute(
        &self,
        pitch: &Numbers,
        (number, at_reference): (i64, i64),
        rotary: bool,
    ) -> Result<Vec<i64>, ReadFault> {
        let numbers = (0..=self.last - self.first).map(|n| IN_FILE + number + n);
        let grown = numbers.clone().map(|n| {
            let value = pitch.get(&(n, 0)).map(|v| v / COUNTS * UNIT);
            value.ok_or_else(|| ReadFault::new(PITCH, format!("N{n}")))
        });
        let grown = grown.collect::<Result<Vec<i64>, _>>()?;
        if rotary && (grown.first() != grown.last() || grown[1..].iter().sum::<i64>() != 0) {
            let expected = "of a rotary axis the first value that of the last, and the sum of those after it 0";
            return Err(ReadFault::new(PITCH, expected));
        }
        let mut sum = 0;
        let sums = grown.iter().enumerate().map(|(i, g)| {
            sum += if i == 0 { 0 } else { *g };
            sum
        });
        let sums: Vec<i64> = sums.collect();
        let there = sums[(self.reference - self.first) as usize];
        Ok(sums.into_iter().map(|s| s - there + at_reference).collect())
    }
}

type Get<'a> = dyn Fn(i64) -> Result<i64, ReadFault> + 'a;

fn nodes(
    pitch: &Numbers,
    (reference, rotary): (i64, bool),
    of: &dyn Fn(i64) -> Option<i64>,
) -> Result<Vec<Node>, ReadFault> {
    let missing = |n: i64| ReadFault::new(PARAMETERS, format!("parameter {n} of each axis"));
    let get = |n: i64| of(n).ok_or_else(|| missing(n));
    let points = Points::read(reference, rotary, &get)?;
    let zero = get(1850)? / COUNTS * UNIT;
    let up = points.absolute(pitch, (points.first, zero), rotary)?;
    let down = match of(3627) {
        Some(at_reference) => {
            let falling = get(3626)? / COUNTS;
            let at_reference = zero + at_reference / COUNTS * UNIT;
            points.absolute(pitch, (falling, at_reference), rotary)?
        }
        None => up.clone(),
    };
    let pairs = up.into_iter().zip(down).zip(points.first..);
    let node = |((up, down), n)| Node { at: (n - reference) * points.step, up, down };
    Ok(pairs.map(node).collect())
}

fn grid_text(machine: &Machine, grid: &Grid) -> String {
    let names = grid.sides.map(|s| machine.axes()[s.axis].name.to_string());
    let counts = grid.sides.map(|s| s.count.to_string()).join(" x ");
    let mut text = format!(
        "# TrueAxis: {counts} points; positions and what is added to the command, mm\n\
         point,{},added_{}\n",
        names.join(","),
        names.join(",added_")
    );
    for (i, (place, value)) in grid.places().zip(&grid.values).enumerate() {
        let numbers = place.iter().chain(value).map(|c| decimal(*c)).collect::<Vec<_>>();
        let _ = writeln!(text, "{},{}", i + 1, numbers.join(","));
    }
    text
}

fn read_grid(machine: &Machine, file: &File) -> Result<Grid, ReadFault> {
    let fault = |line: usize, expected: &str| {
        ReadFault::new(&file.name, format!("line {}: {expected}", line + 1))
    };
    let mut lines = file.text.lines().enumerate().filter(|(_, l)| !l.starts_with('#'));
    let head = lines.next().map_or("", |(_, l)| l);
    let axes: Vec<usize> = head
        .split(',')
        .filter_map(|h| machine.axes().iter().position(|a| a.name.to_string() == h))
        .collect();
    let axes = axes.first_chunk::<3>().ok_or_else(|| fault(1, "three axes of the machine"))?;
    let mut rows: Vec<[i64; 6]> = Vec::new();
    for (i, line) in lines {
        let numbers: Option<Vec<i64>> = line.split(',').skip(1).map(parse_decimal).collect();
        let row = numbers.and_then(|n| <[i64; 6]>::try_from(n).ok());
        rows.push(row.ok_or_else(|| fault(i, "a point, three positions, three values"))?);
    }
    let side = |i: usize| {
        let mut at: Vec<i64> = rows.iter().map(|r| r[i]).collect();
        at.sort_unstable();
        at.dedup();
        let step = at.get(1).map_or(1, |b| b - at[0]);
        Side { axis: axes[i], from: at.first().copied().unwrap_or(0), step, count: at.len() }
    };
    let grid = Grid {
        sides: [side(0), side(1), side(2)],
        values: rows.iter().map(|r| [r[3], r[4], r[5]]).collect(),
    };
    let points = grid.sides.iter().map(|s| s.count).product::<usize>();
    let right = points == rows.len()
        && points > 0
        && grid.places().zip(&rows).all(|(p, r)| p == [r[0], r[1], r[2]]);
    match right {
        true => Ok(grid),
        false => Err(fault(1, "a full grid of equal distances, the first axis fastest")),
    }
}
