//! The centres in the names of each control.
//!
//! Every name is a distance in the machine at rotary zero: between the gauge point of the spindle and
//! a rotary axis, or between two rotary axes. It is linear in the offsets, with slopes that are read
//! from the chain itself: from the distance with an offset of 1 mm less the distance without.

use super::centres::{Centres, Topology};
use nalgebra::{DMatrix, DVector};
use trueaxis_geometry::{Mat3, Vec3};
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{AxisKind, Command};
use trueaxis_machine::errors::ErrorValues;

/// Whose names.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Names {
    /// The Chinese i5 control of Zhang et al. 2023: RTCP_OFFSET1, RTCP_OFFSET2.
    I5,
    /// SINUMERIK 840D sl: machine data of the five-axis transformation TRAFO5.
    Sinumerik,
    /// FANUC 30i: parameters from 19700 on.
    Fanuc,
    /// HEIDENHAIN: translations of the kinematics table.
    Heidenhain,
    /// LinuxCNC: pins of its kinematics.
    LinuxCnc,
}

/// All with their names in files.
const ALL: [(Names, &str, &str); 5] = [
    (Names::I5, "i5", "i5"),
    (Names::Sinumerik, "sinumerik", "SINUMERIK 840D sl"),
    (Names::Fanuc, "fanuc", "FANUC"),
    (Names::Heidenhain, "heidenhain", "HEIDENHAIN"),
    (Names::LinuxCnc, "linuxcnc", "LinuxCNC"),
];

impl Names {
    /// What may stand in a file.
    pub const KNOWN: &'static str = "i5, sinumerik, fanuc, heidenhain or linuxcnc";

    /// By the name in files.
    pub fn find(name: &str) -> Option<Self> {
        ALL.into_iter().find(|(_, n, _)| *n == name).map(|(names, ..)| names)
    }

    /// All of them.
    pub fn all() -> impl Iterator<Item = Self> {
        ALL.into_iter().map(|(names, ..)| names)
    }

    /// The name in files.
    pub fn key(self) -> &'static str {
        // why: every one stands in the table
        ALL.into_iter().find(|(n, ..)| *n == self).map_or("", |(_, key, _)| key)
    }

    /// The name in text output.
    pub fn title(self) -> &'static str {
        // why: every one stands in the table
        ALL.into_iter().find(|(n, ..)| *n == self).map_or("", |(.., title)| title)
    }
}

/// One number of a control, mm.
#[derive(Debug, Clone, PartialEq)]
pub struct Slot {
    /// Its name.
    pub name: String,
    /// What it is.
    pub words: String,
    /// What the machine file says, mm.
    pub nominal_mm: f64,
    /// How it grows with each offset, mm/mm. Unit: 1.
    pub slopes: Vec<f64>,
    /// It closes a chain of vectors and follows from the others.
    pub closes: bool,
}

/// All numbers of a control that belong to the centres of a machine.
#[derive(Debug, Clone, PartialEq)]
pub struct Slots {
    /// Whose.
    pub names: Names,
    /// The numbers in the order of the control.
    pub slots: Vec<Slot>,
    /// The offsets that no number of the control takes in.
    pub without_slot: Vec<usize>,
}

/// Where the points are that the names speak of, machine coordinates with all axes at 0, mm.
struct Geometry {
    /// From the gauge point of the spindle to each table axis, bed outwards.
    table: Vec<Vec3>,
    /// From the gauge point of the spindle to each head axis, bed outwards.
    head: Vec<Vec3>,
}

/// What counts as the position of the spindle.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum MachineZero {
    /// The gauge line of the spindle, without a tool.
    #[default]
    GaugeLine,
    /// The tip of the tool of the machine file.
    Tip,
}

fn geometry(
    machine: &Machine,
    centres: &Centres,
    zero: MachineZero,
    errors: &ErrorValues,
) -> Option<Geometry> {
    let poses = machine.body_poses(&Command::default(), errors);
    let tool = poses.last()?;
    let spindle = match zero {
        MachineZero::GaugeLine => *tool.shift_mm(),
        MachineZero::Tip => tool.linear() * machine.tip_mm() + tool.shift_mm(),
    };
    let coordinates = coordinates_of(machine)?;
    let from_spindle = |body: &usize| coordinates * (poses[*body].shift_mm() - spindle);
    Some(Geometry {
        table: centres.table.iter().map(from_spindle).collect(),
        head: centres.head.iter().map(from_spindle).collect(),
    })
}

/// From a way of the spindle against the table (bed) to machine coordinates X, Y, Z.
fn coordinates_of(machine: &Machine) -> Option<Mat3> {
    let nominal = machine.body_poses(&Command::default(), &ErrorValues::default());
    let mut ways = Vec::new();
    for (i, body) in machine.bodies().iter().enumerate() {
        let Some(axis) = body.axis.map(|a| &machine.axes()[a]) else { continue };
        if axis.kind != AxisKind::Linear || !matches!(axis.name.letter(), 'X' | 'Y' | 'Z') {
            continue;
        }
        let side = if i < machine.workpiece_side() { -1.0 } else { 1.0 };
        // A linear axis turns nothing: its own frame has the attitude of its parent.
        let along = nominal[i].linear() * (axis.direction * (axis.sense * side));
        ways.push((axis.name.letter(), along));
    }
    ways.sort_by_key(|(letter, _)| *letter);
    let [(_, x), (_, y), (_, z)] = ways[..] else { return None };
    Mat3::from_columns(&[x, y, z]).try_inverse()
}

impl Slots {
    /// The numbers of a control for a machine.
    ///
    /// # Errors
    /// In words: its kinematics does not fit the machine.
    pub fn of(
        names: Names,
        machine: &Machine,
        centres: &Centres,
        zero: MachineZero,
    ) -> Result<Self, String> {
        let at = |offsets: &[f64]| {
            geometry(machine, centres, zero, &centres.errors(offsets))
                .ok_or_else(|| "X, Y and Z do not span the space".to_owned())
        };
        let n = centres.terms.len();
        let letters = Letters::of(machine, centres);
        let values = |g: &Geometry| named(names, centres.topology, &letters, g);
        let nominal = values(&at(&vec![0.0; n])?)?;
        let mut slots: Vec<Slot> = nominal
            .into_iter()
            .map(|v| Slot {
                name: v.name,
                words: v.words,
                nominal_mm: v.mm,
                slopes: Vec::with_capacity(n),
                closes: v.closes,
            })
            .collect();
        for k in 0..n {
            let mut one = vec![0.0; n];
            one[k] = 1.0;
            for (slot, value) in slots.iter_mut().zip(values(&at(&one)?)?) {
                // Slopes are 0, 1, −1 or the cosines of a tilted axis; the rest is rounding.
                let slope = value.mm - slot.nominal_mm;
                slot.slopes.push((slope * 1e9).round() / 1e9);
            }
        }
        let without_slot =
            (0..n).filter(|k| slots.iter().all(|s| s.slopes[*k].abs() < 1e-6)).collect();
        Ok(Self { names, slots, without_slot })
    }

    /// The offsets (mm) for which the control was set, from what stands in it, the shortest.
    pub fn offsets_of(&self, now: &[(usize, f64)]) -> Vec<f64> {
        let free: Vec<&Slot> = self.slots.iter().filter(|s| !s.closes).collect();
        let n = self.slots.first().map_or(0, |s| s.slopes.len());
        let slopes = DMatrix::from_fn(free.len(), n, |i, j| free[i].slopes[j]);
        let off = DVector::from_iterator(
            free.len(),
            self.slots.iter().enumerate().filter(|(_, s)| !s.closes).map(|(i, slot)| {
                let stated = now.iter().find(|(k, _)| *k == i);
                stated.map_or(0.0, |(_, mm)| mm - slot.nominal_mm)
            }),
        );
        let inverse = slopes.pseudo_inverse(1e-9).ok();
        inverse.map_or_else(|| vec![0.0; n], |p| (p * off).as_slice().to_vec())
    }
}

/// The letters of the rotary axes.
struct Letters {
    table: Vec<char>,
    head: Vec<char>,
}

impl Letters {
    fn of(machine: &Machine, centres: &Centres) -> Self {
        let letter = |body: &usize| {
            machine.bodies()[*body].axis.map_or(' ', |a| machine.axes()[a].name.letter())
        };
        Self {
            table: centres.table.iter().map(letter).collect(),
            head: centres.head.iter().map(letter).collect(),
        }
    }
}

struct Value {
    name: String,
    words: String,
    mm: f64,
    closes: bool,
}

fn value(name: impl Into<String>, words: impl Into<String>, mm: f64) -> Value {
    Value { name: name.into(), words: words.into(), mm, closes: false }
}

const XYZ: [char; 3] = ['X', 'Y', 'Z'];

/// Three values of a vector.
fn vector(name: impl Fn(usize) -> String, words: &str, v: Vec3) -> Vec<Value> {
    (0..3).map(|i| value(name(i), format!("{words}, {}", XYZ[i]), v[i])).collect()
}

fn closing(values: Vec<Value>) -> Vec<Value> {
    values.into_iter().map(|v| Value { closes: true, ..v }).collect()
}

/// The first table axis as a point: along itself it stands where the second one does.
fn first_table(letters: &Letters, g: &Geometry) -> Vec3 {
    let mut point = g.table[0];
    if let (Some(second), Some(along)) =
        (g.table.get(1), ['A', 'B', 'C'].iter().position(|l| Some(l) == letters.table.first()))
    {
        point[along] = second[along];
    }
    point
}

fn named(
    names: Names,
    topology: Topology,
    letters: &Letters,
    g: &Geometry,
) -> Result<Vec<Value>, String> {
    match names {
        Names::I5 => i5(topology, letters, g),
        Names::Sinumerik => Ok(sinumerik(topology, letters, g)),
        Names::Fanuc => Ok(fanuc(topology, letters, g)),
        Names::Heidenhain => Ok(heidenhain(letters, g)),
        Names::LinuxCnc => linuxcnc(topology, letters, g),
    }
}

/// Zhang et al. 2023, 2.1.2, and errata 003-10.
fn i5(topology: Topology, letters: &Letters, g: &Geometry) -> Result<Vec<Value>, String> {
    if topology != Topology::TableTable || letters.table != ['A', 'C'] {
        return Err("RTCP_OFFSET1 and 2 of the i5 control are known for a C table on an A table \
                    (w C' A' b … t) only"
            .to_owned());
    }
    let (first, second) = (first_table(letters, g), g.table[1]);
    Ok(vec![
        value("RTCP_OFFSET1_X", "X of the C axis", second.x),
        value("RTCP_OFFSET1_Y", "Y of the A axis", first.y),
        value("RTCP_OFFSET1_Z", "Z of the A axis", first.z),
        value("RTCP_OFFSET2_Y", "Y of the C axis less Y of the A axis", second.y - first.y),
    ])
}

/// SINUMERIK Operate, commissioning manual 12/2017 (6FC5397-1DP40-6BA1), 21.7 Swiveling: vectors I1
/// to I4 of transformer types 24, 40, 56.
fn sinumerik(topology: Topology, letters: &Letters, g: &Geometry) -> Vec<Value> {
    let data = |number: u32, name: &'static str| {
        move |i: usize| format!("MD{number} $MC_TRAFO5_{name}_1[{i}]")
    };
    let part = data(24500, "PART_OFFSET");
    let base = data(24550, "BASE_TOOL");
    let joint = data(24560, "JOINT_OFFSET");
    let in_part = data(24558, "JOINT_OFFSET_PART");
    match topology {
        Topology::TableTable => {
            let first = first_table(letters, g);
            let between = g.table[1] - first;
            let [a, b] = [letters.table[0], letters.table[1]];
            let mut all = vector(base, &format!("I2: machine zero to the {a} axis"), first);
            all.extend(vector(joint, &format!("I3: {a} axis to {b} axis"), between));
            all.extend(closing(vector(part, "I4 = −(I2 + I3)", -(first + between))));
            all
        }
        Topology::HeadHead => {
            let (to_second, to_first) = (g.head[1], g.head[0]);
            let between = to_first - to_second;
            let [a, b] = [letters.head[0], letters.head[1]];
            let mut all = vector(base, &format!("I3: spindle to the {b} axis"), to_second);
            all.extend(vector(joint, &format!("I2: {b} axis to {a} axis"), between));
            all.extend(closing(vector(part, "I1 = −(I2 + I3)", -to_first)));
            all
        }
        Topology::Mixed => {
            let (head, table) = (g.head[0], g.table[0]);
            let [h, t] = [letters.head[0], letters.table[0]];
            let mut all = vector(base, &format!("I2: spindle to the {h} axis"), head);
            all.extend(vector(in_part, &format!("I3: machine zero to the {t} axis"), table));
            all.extend(closing(vector(joint, "I1 = −I2", -head)));
            all.extend(closing(vector(part, "I4 = −I3", -table)));
            all
        }
    }
}

/// FANUC 30i-A, tool center point control for 5-axis machining (A-79348E), parameters 19700 ff.
fn fanuc(topology: Topology, letters: &Letters, g: &Geometry) -> Vec<Value> {
    let numbered = |first: usize| move |i: usize| (first + i).to_string();
    match topology {
        Topology::TableTable => {
            let first = first_table(letters, g);
            let [a, b] = [letters.table[0], letters.table[1]];
            let words = format!("rotary table position (a point of the {a} axis)");
            let mut all = vector(numbered(19700), &words, first);
            let words = format!("from the {a} axis to the {b} axis");
            all.extend(vector(numbered(19703), &words, g.table[1] - first));
            all
        }
        Topology::HeadHead => {
            let [a, b] = [letters.head[0], letters.head[1]];
            let words = format!("from the tool axis to the {b} axis");
            let mut all = vector(numbered(19709), &words, g.head[1]);
            let words = format!("from the {b} axis to the {a} axis");
            all.extend(vector(numbered(19712), &words, g.head[0] - g.head[1]));
            all
        }
        Topology::Mixed => {
            let [h, t] = [letters.head[0], letters.table[0]];
            let words = format!("rotary table position (a point of the {t} axis)");
            let mut all = vector(numbered(19700), &words, g.table[0]);
            let words = format!("from the tool axis to the {h} axis");
            all.extend(vector(numbered(19709), &words, g.head[0]));
            all
        }
    }
}

/// The kinematics table begins at the tool reference point (iTNC 530 HSCI, technical manual, KEY
/// Trans and MachAxis; in the manner of CfgKinSimpleTrans of the TNC 640).
fn heidenhain(letters: &Letters, g: &Geometry) -> Vec<Value> {
    let lines = |axis: char, v: Vec3| {
        (0..3).map(move |i| {
            let words = format!("translation before MachAxis {axis}");
            value(format!("Trans_{axis}_{}", XYZ[i]), format!("{words}, {}", XYZ[i]), v[i])
        })
    };
    let mut all = Vec::new();
    let mut at = Vec3::zeros();
    for (letter, point) in letters.head.iter().zip(&g.head).rev() {
        all.extend(lines(*letter, point - at));
        at = *point;
    }
    let mut at = Vec3::zeros();
    for (i, (letter, point)) in letters.table.iter().zip(&g.table).enumerate() {
        let point = if i == 0 { first_table(letters, g) } else { *point };
        all.extend(lines(*letter, point - at));
        at = point;
    }
    all
}

/// src/emc/kinematics of LinuxCNC: trtfuncs.c, 5axiskins.c, maxkins.c (commit 5c41560, 2026-08-22).
fn linuxcnc(topology: Topology, letters: &Letters, g: &Geometry) -> Result<Vec<Value>, String> {
    match (topology, &letters.table[..], &letters.head[..]) {
        (Topology::TableTable, ['A', 'C'], _) => {
            let (first, second) = (first_table(letters, g), g.table[1]);
            Ok(vec![
                value("xyzac-trt-kins.x-rot-point", "X of the C axis", second.x),
                value("xyzac-trt-kins.y-rot-point", "Y of the C axis", second.y),
                value("xyzac-trt-kins.y-offset", "Y of the A axis less Y of C", first.y - second.y),
                value("xyzac-trt-kins.z-rot-point+z-offset", "Z of the A axis (sum)", first.z),
            ])
        }
        (Topology::TableTable, ['B', 'C'], _) => {
            let (first, second) = (first_table(letters, g), g.table[1]);
            Ok(vec![
                value("xyzbc-trt-kins.x-rot-point", "X of the C axis", second.x),
                value("xyzbc-trt-kins.y-rot-point", "Y of the C axis", second.y),
                value("xyzbc-trt-kins.x-offset", "X of the B axis less X of C", first.x - second.x),
                value("xyzbc-trt-kins.z-rot-point+z-offset", "Z of the B axis (sum)", first.z),
            ])
        }
        (Topology::HeadHead, _, ['C', 'B']) => {
            Ok(vec![value("5axiskins.pivot-length", "gauge line to the B axis", g.head[1].z)])
        }
        (Topology::Mixed, ['C'], ['B']) => {
            Ok(vec![value("maxkins.pivot-length", "gauge line to the B axis", g.head[0].z)])
        }
        _ => Err("LinuxCNC has kinematics with centres for A' C' and B' C' tables \
                  (xyzac-trt-kins, xyzbc-trt-kins), a C B head (5axiskins) and a C' table with a B \
                  head (maxkins) only"
            .to_owned()),
    }
}
