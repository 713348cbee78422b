//! SINUMERIK: rotary axes as the vectors of an orientable tool carrier, `$TC_CARRn`.
//!
//! ```text
//!     head (T)     I2 axis 1 → axis 2        I3 axis 2 → tool        I1 = −(I2 + I3)
//!     table (P)    I2 tool → axis 1          I3 axis 1 → axis 2      I4 = −(I2 + I3)
//!     both (M)     I2 axis 1 → tool          I1 = −I2                I3 tool → axis 2       I4 = −I3
//!     V1, V2       direction about which a positive command turns
//! ```
//!
//! Axis 1 is the one nearer to the bed, of a machine with both that of the head. Commissioning Manual SINUMERIK
//! Operate, 12/2017, 6FC5397-1DP40-6BA1, p. 572.

use super::control::{File, ReadFault};
use super::joints::{Joint, Joints, moves_an_axis};
use super::joints_csv::{direction, parse_direction};
use super::table::{PER_UNIT, decimal, parse_decimal};
use std::collections::BTreeMap;
use std::fmt::Write;
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{AxisKind, AxisSide, Command};
use trueaxis_machine::errors::{BodyName, ErrorName, ErrorValues};

/// The file.
pub const NAME: &str = "TOOLCARRIER.SPF";
/// The number of the tool carrier.
pub const CARRIER: usize = 1;

/// What turns: both axes the tool, both the workpiece, one each.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// Both the tool.
    Head,
    /// Both the workpiece.
    Table,
    /// Axis 1 the tool, axis 2 the workpiece.
    Both,
}

impl Kind {
    fn letter(self) -> &'static str {
        match self {
            Self::Head => "T",
            Self::Table => "P",
            Self::Both => "M",
        }
    }
}

/// The two rotary axes in the order of the control, if there are two.
pub fn axes(machine: &Machine) -> Option<(Kind, [BodyName; 2])> {
    let side = machine.workpiece_side();
    let outwards = (0..side).rev().chain(side..machine.bodies().len());
    let rotary = outwards.filter_map(|i| machine.bodies()[i].axis).map(|i| &machine.axes()[i]);
    let rotary: Vec<_> = rotary.filter(|a| a.kind == AxisKind::Rotary).collect();
    let [first, second] = rotary[..] else { return None };
    Some(match (first.carries, second.carries) {
        (AxisSide::Tool, AxisSide::Tool) => (Kind::Head, [first.name, second.name]),
        (AxisSide::Workpiece, AxisSide::Workpiece) => (Kind::Table, [first.name, second.name]),
        // Those that carry the workpiece were treated first.
        _ => (Kind::Both, [second.name, first.name]),
    })
}

/// Whether the vectors hold this error: a shift of an axis that carries the tool and what follows it along closes
/// the chain and is lost.
pub fn knows(machine: &Machine, error: ErrorName) -> bool {
    let Some((kind, [first, _])) = axes(machine) else { return false };
    let shifts_all = kind != Kind::Table && error.body == first && !error.component.is_rotation();
    moves_an_axis(machine, error) && !shifts_all
}

/// A vector, counts of 10⁻⁶ mm.
pub type Counts = [i64; 3];

/// The difference of two points.
pub fn minus(a: Counts, b: Counts) -> Counts {
    std::array::from_fn(|i| a[i] - b[i])
}

/// A point and a way.
pub fn plus(a: Counts, b: Counts) -> Counts {
    std::array::from_fn(|i| a[i] + b[i])
}

/// Where the tool is taken, counts; with the axes placed so.
pub fn tool(machine: &Machine, joints: Option<&Joints>) -> Counts {
    let mut errors = ErrorValues::default();
    if let Some(joints) = joints {
        joints.place(machine, &mut errors);
    }
    let poses = machine.body_poses(&Command::default(), &errors);
    let origin = poses.last().map_or_else(Default::default, |p| *p.shift_mm());
    [origin.x, origin.y, origin.z].map(|c| (c * PER_UNIT).round() as i64)
}

fn sense(machine: &Machine, axis: BodyName) -> i64 {
    let axis = machine.axis_index(axis).map_or(1.0, |i| machine.axes()[i].sense);
    axis as i64
}

/// The vectors of a machine with two rotary axes.
pub fn write(machine: &Machine, joints: &Joints) -> Option<File> {
    let (kind, names) = axes(machine)?;
    let find = |name: BodyName| joints.0.iter().find(|j| j.axis == name);
    let (one, two) = (find(names[0])?, find(names[1])?);
    let (p1, p2) = (one.point, two.point);
    let offsets = match kind {
        Kind::Head => {
            let (i2, i3) = (minus(p2, p1), minus(tool(machine, Some(joints)), p2));
            vec![(1, minus([0; 3], plus(i2, i3))), (4, i2), (15, i3)]
        }
        Kind::Table => {
            let (i2, i3) = (minus(p1, tool(machine, None)), minus(p2, p1));
            vec![(4, i2), (15, i3), (18, minus([0; 3], plus(i2, i3)))]
        }
        Kind::Both => {
            let i2 = minus(tool(machine, Some(joints)), p1);
            let i3 = minus(p2, tool(machine, None));
            vec![(1, minus([0; 3], i2)), (4, i2), (15, i3), (18, minus([0; 3], i3))]
        }
    };
    let mut text = format!(
        ";TrueAxis: orientable tool carrier {CARRIER}; axis 1 is {}, axis 2 is {}; mm\n\
         $TC_CARR23[{CARRIER}]=\"{}\"\n",
        names[0],
        names[1],
        kind.letter()
    );
    let mut lines = |first: usize, values: [String; 3]| {
        for (i, value) in values.iter().enumerate() {
            // Writing to a String cannot fail.
            let _ = writeln!(text, "$TC_CARR{}[{CARRIER}]={value}", first + i);
        }
    };
    for (first, vector) in offsets {
        lines(first, vector.map(decimal));
    }
    for (first, joint) in [(7, one), (10, two)] {
        let turns = sense(machine, joint.axis);
        lines(first, joint.direction.map(|c| direction(turns * c)));
    }
    Some(File { name: NAME.to_owned(), text: text + "M17\n" })
}

/// The axes of those vectors.
///
/// # Errors
/// What was expected.
pub fn read(machine: &Machine, file: &File) -> Result<Joints, ReadFault> {
    let fault = |expected: &str| ReadFault::new(&file.name, expected);
    let (kind, names) = axes(machine).ok_or_else(|| fault("a machine with two rotary axes"))?;
    let mut values = BTreeMap::new();
    for line in file.text.lines().filter(|l| !l.starts_with(';') && *l != "M17") {
        let (name, value) = line.split_once('=').ok_or_else(|| fault("$TC_CARRn[…]=…"))?;
        values.insert(name.to_owned(), value.to_owned());
    }
    let letter = kind.letter();
    if values.get(&format!("$TC_CARR23[{CARRIER}]")).map(String::as_str)
        != Some(&format!("\"{letter}\""))
    {
        return Err(fault(&format!("$TC_CARR23 \"{letter}\" of such a machine")));
    }
    let one = |n: usize, parse: &dyn Fn(&str) -> Option<i64>| {
        let value = values.get(&format!("$TC_CARR{n}[{CARRIER}]"));
        value.and_then(|v| parse(v)).ok_or_else(|| fault(&format!("a number as $TC_CARR{n}")))
    };
    let three = |n: usize, parse: &dyn Fn(&str) -> Option<i64>| {
        Ok::<_, ReadFault>([one(n, parse)?, one(n + 1, parse)?, one(n + 2, parse)?])
    };
    let nominal = Joints::nominal(machine);
    let first = nominal.0.iter().find(|j| j.axis == names[0]).map_or([0; 3], |j| j.point);
    let (i2, i3) = (three(4, &parse_decimal)?, three(15, &parse_decimal)?);
    let closing = match kind {
        Kind::Head => vec![(1, plus(i2, i3))],
        Kind::Table => vec![(18, plus(i2, i3))],
        Kind::Both => vec![(1, i2), (18, i3)],
    };
    for (n, way) in closing {
        if three(n, &parse_decimal)? != minus([0; 3], way) {
            return Err(fault(&format!(
                "$TC_CARR{n} ff. that lead back to where the vectors began"
            )));
        }
    }
    let reference = tool(machine, None);
    let points = match kind {
        Kind::Head => [first, plus(first, i2)],
        Kind::Table => [plus(reference, i2), plus(plus(reference, i2), i3)],
        Kind::Both => [first, plus(reference, i3)],
    };
    let mut joints = Vec::new();
    for ((axis, point), n) in names.into_iter().zip(points).zip([7, 10]) {
        let turns = sense(machine, axis);
        let direction = three(n, &parse_direction)?.map(|c| turns * c);
        joints.push(Joint { axis, point, direction });
    }
    joints.sort_by_key(|j| machine.axis_index(j.axis));
    Ok(Joints(joints))
}
