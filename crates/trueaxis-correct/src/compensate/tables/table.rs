//! One table of a control: what the position of one axis adds to the command of another.

use trueaxis_machine::Machine;
use trueaxis_machine::axis::AxisKind;

/// Counts per mm or degree: numbers in files are whole millionths, so that what is written is what is
/// read, to the last bit.
pub const PER_UNIT: f64 = 1e6;
/// Larger numbers no axis and no correction has: 1 km, in counts.
const MOST_COUNTS: f64 = 1e12;

/// One row, in counts of mm or degrees.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Node {
    /// Position of the input axis.
    pub at: i64,
    /// What is added to the command of the output axis where the input axis rises.
    pub up: i64,
    /// The same where it falls.
    pub down: i64,
}

impl Node {
    /// The same with the other sign.
    pub fn negated(&self) -> Self {
        Self { at: self.at, up: -self.up, down: -self.down }
    }
}

/// A function of one axis that is added to the command of one axis, by straight lines between nodes.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Table {
    /// The axis whose position is looked up, by its place in [`Machine::axes`].
    pub input: usize,
    /// The axis whose command is changed.
    pub output: usize,
    /// Whether the table repeats itself after a turn of the input axis.
    pub modulo: bool,
    /// At rising positions, two at least.
    pub nodes: Vec<Node>,
}

impl Table {
    /// Whether rising and falling differ.
    pub fn is_directional(&self) -> bool {
        self.nodes.iter().any(|n| n.up != n.down)
    }

    /// The node that adds most, rising: for a look at the control whether the sign is right.
    pub fn largest(&self) -> Option<&Node> {
        self.nodes.iter().max_by_key(|n| n.up.abs())
    }

    /// The same with the other sign.
    pub fn negated(&self) -> Self {
        Self { nodes: self.nodes.iter().map(Node::negated).collect(), ..self.clone() }
    }

    /// Whether it has as many counts from each node to the next.
    pub fn step(&self) -> Option<i64> {
        let mut steps = self.nodes.windows(2).map(|n| n[1].at - n[0].at);
        let first = steps.next()?;
        steps.all(|s| s == first).then_some(first)
    }

    /// The value at a position, counts of the output axis: straight between the nodes, held beyond
    /// the first and the last. `side`: +1 rising, −1 falling, 0 the mean.
    pub fn at(&self, position: f64, side: f64) -> f64 {
        interpolated(&self.nodes, self.modulo, position, side)
    }
}

/// The value between nodes as in [`Table::at`].
pub fn interpolated(nodes: &[Node], modulo: bool, position: f64, side: f64) -> f64 {
    let Some((first, last)) = nodes.first().zip(nodes.last()) else { return 0.0 };
    let position = match modulo {
        true => (position - first.at as f64).rem_euclid(360.0 * PER_UNIT) + first.at as f64,
        false => position,
    };
    let after = nodes.partition_point(|n| n.at as f64 <= position);
    let of = |n: &Node| match side {
        s if s > 0.0 => n.up as f64,
        s if s < 0.0 => n.down as f64,
        _ => 0.5 * (n.up + n.down) as f64,
    };
    if after == 0 {
        return of(first);
    }
    let Some(next) = nodes.get(after) else { return of(last) };
    let before = &nodes[after - 1];
    let share = (position - before.at as f64) / (next.at - before.at) as f64;
    of(before) + share * (of(next) - of(before))
}

/// What a count is of an axis, mm or rad.
pub fn count_of(machine: &Machine, axis: usize) -> f64 {
    match machine.axes()[axis].kind {
        AxisKind::Linear => 1.0 / PER_UNIT,
        AxisKind::Rotary => (1.0 / PER_UNIT).to_radians(),
    }
}

/// A value of an axis (mm or rad) in counts, not yet whole.
pub fn counts(machine: &Machine, axis: usize, value: f64) -> f64 {
    match machine.axes()[axis].kind {
        AxisKind::Linear => value * PER_UNIT,
        AxisKind::Rotary => value.to_degrees() * PER_UNIT,
    }
}

/// Counts as people and controls write them: `-0.001250` is −1250 counts.
pub fn decimal(counts: i64) -> String {
    let sign = if counts < 0 { "-" } else { "" };
    let size = counts.unsigned_abs();
    format!("{sign}{}.{:06}", size / 1_000_000, size % 1_000_000)
}

/// The counts of a decimal number; `None` if it is none, too large or finer than a count.
pub fn parse_decimal(text: &str) -> Option<i64> {
    let counts = text.trim().parse::<f64>().ok()? * PER_UNIT;
    let whole = counts.round();
    ((counts - whole).abs() < 1e-3 && whole.abs() <= MOST_COUNTS).then_some(whole as i64)
}

/// The axes as controls count them: X Y Z A B C U V W, those that the machine has.
pub fn axis_order(machine: &Machine) -> Vec<usize> {
    let named = |letter| machine.axes().iter().position(|a| a.name.letter() == letter);
    "XYZABCUVW".chars().filter_map(named).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decimals_keep_every_count() {
        for counts in [0, 1, -1, 999_999, -1_000_000, 6_200_000_000, -123_456_789] {
            assert_eq!(parse_decimal(&decimal(counts)), Some(counts));
        }
        assert_eq!(decimal(-1250), "-0.001250");
        for bad in ["", "nan", "inf", "1e30", "0.0000001", "1,5"] {
            assert_eq!(parse_decimal(bad), None, "{bad}");
        }
    }

    #[test]
    fn straight_between_held_beyond_and_around() {
        let node = |at, up, down| Node { at, up, down };
        let mut table = Table {
            input: 0,
            output: 0,
            modulo: false,
            nodes: vec![node(0, 0, 10), node(100, 50, 20)],
        };
        assert_eq!(table.at(50.0, 1.0), 25.0);
        assert_eq!(table.at(50.0, -1.0), 15.0);
        assert_eq!(table.at(50.0, 0.0), 20.0);
        assert_eq!((table.at(-7.0, 1.0), table.at(400.0, -1.0)), (0.0, 20.0));
        table.nodes = vec![node(0, 0, 0), node(180_000_000, 40, 40), node(360_000_000, 0, 0)];
        table.modulo = true;
        assert_eq!(table.at(-90_000_000.0, 0.0), 20.0);
        assert_eq!(table.at(450_000_000.0, 0.0), 20.0);
    }
}
