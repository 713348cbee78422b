//! Where the nodes of a table stand: the fewest that keep the loss of interpolation below a bound.

use super::table::{Node, PER_UNIT, interpolated};
use trueaxis_machine::chain::CommandFault;

/// The function is evaluated at so many places between the ends.
const LOOKS: i64 = 1024;
/// Above this many nodes the search goes on in steps of a 32nd, not one by one.
const ONE_BY_ONE: usize = 64;

/// Where nodes may stand, and what holds between them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Spacing {
    /// Anywhere; straight lines.
    Free,
    /// At equal distances from the first end; straight lines.
    Equal,
    /// At equal distances from the position 0; the value of the nearest node. A table that repeats itself has a whole turn
    /// from 0 on, and the distances divide it.
    Stepped {
        /// Distances are whole multiples of this, counts.
        unit: i64,
    },
}

/// What a control allows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rule {
    /// Where nodes may stand.
    pub spacing: Spacing,
    /// The fewest nodes of one table with equal distances.
    pub fewest_nodes: usize,
    /// The most nodes of one table.
    pub most_nodes: usize,
    /// The least increment of a value. Unit: counts.
    pub increment: f64,
    /// The least increment of a position, counts.
    pub position: i64,
}

impl Rule {
    /// Nodes anywhere, as many as wanted, every count.
    pub const FREE: Self = Self {
        spacing: Spacing::Free,
        fewest_nodes: 2,
        most_nodes: usize::MAX,
        increment: 1.0,
        position: 1,
    };
}

/// Nodes and what is lost between them.
#[derive(Debug, Clone, PartialEq)]
pub struct Placed {
    /// In rising order.
    pub nodes: Vec<Node>,
    /// The largest difference from the function. Unit: counts of the output axis.
    pub loss: f64,
}

/// Why there are no nodes.
#[derive(Debug, Clone, PartialEq)]
pub enum PlaceFault {
    /// Even the control's most nodes lose more than the bound; the loss in counts.
    TooMany(f64),
    /// Half an increment is more than the bound.
    Increment,
    /// The function is another one after a turn, and the table repeats itself; half the difference in counts.
    Turns(f64),
    /// The machine's errors are not known there.
    Machine(CommandFault),
}

impl From<CommandFault> for PlaceFault {
    fn from(fault: CommandFault) -> Self {
        Self::Machine(fault)
    }
}

/// A function of a position in counts: what is added rising and falling, in counts.
pub type Function<'a> = dyn Fn(i64) -> Result<[f64; 2], CommandFault> + 'a;

/// Places nodes from one end to the other.
///
/// Free nodes: from each the farthest next one of the looks with which the straight line still holds.
/// Equal distances: the first number that holds, one by one up
/// to 64, beyond that within 3 % of the fewest. Stepped: the same, outwards from 0.
///
/// # Errors
/// [`PlaceFault`]
pub fn place(
    function: &Function<'_>,
    (from, to): (i64, i64),
    (rule, modulo): (Rule, bool),
    bound: f64,
) -> Result<Placed, PlaceFault> {
    if 0.5 * rule.increment > bound {
        return Err(PlaceFault::Increment);
    }
    let place = |i: i64| from + (i128::from(to - from) * i128::from(i) / i128::from(LOOKS)) as i64;
    // What lies between the ends, where the control can have a node.
    let places = (0..=LOOKS).map(|i| match i {
        0 | LOOKS => place(i),
        _ => place(i).div_euclid(rule.position) * rule.position,
    });
    let mut looks =
        places.map(|at| Ok((at, function(at)?))).collect::<Result<Vec<_>, CommandFault>>()?;
    looks.dedup_by_key(|(at, _)| *at);
    match rule.spacing {
        Spacing::Equal => equal(function, &looks, (rule, modulo), bound),
        Spacing::Free => free(&looks, rule, bound),
        Spacing::Stepped { unit } if modulo => around(function, &looks, (rule, unit), bound),
        Spacing::Stepped { unit } => stepped(function, &looks, (rule, unit), bound),
    }
}

type Look = (i64, [f64; 2]);

fn node((at, [up, down]): &Look, increment: f64) -> Node {
    let whole = |v: f64| ((v / increment).round() * increment).round() as i64;
    Node { at: *at, up: whole(*up), down: whole(*down) }
}

/// The largest difference of a table from the looks.
fn loss(nodes: &[Node], looks: &[Look], stop_at: f64) -> f64 {
    lost(&|at, side| interpolated(nodes, false, at, side), looks, stop_at)
}

fn lost(table: &dyn Fn(f64, f64) -> f64, looks: &[Look], stop_at: f64) -> f64 {
    let mut most = 0.0_f64;
    for (at, [up, down]) in looks {
        let place = *at as f64;
        let off = (table(place, 1.0) - up).abs().max((table(place, -1.0) - down).abs());
        most = most.max(off);
        if most > stop_at {
            break;
        }
    }
    most
}

fn free(looks: &[Look], rule: Rule, bound: f64) -> Result<Placed, PlaceFault> {
    let mut nodes = vec![node(&looks[0], rule.increment)];
    let mut start = 0;
    while start + 1 < looks.len() {
        let holds = |end: &usize| {
            let pair = [node(&looks[start], rule.increment), node(&looks[*end], rule.increment)];
            loss(&pair, &looks[start..=*end], bound) <= bound
        };
        // A longer line may hold where a shorter one does not.
        let end = (start + 1..looks.len()).rev().find(holds).unwrap_or(start + 1);
        nodes.push(node(&looks[end], rule.increment));
        start = end;
    }
    let lost = loss(&nodes, looks, f64::INFINITY);
    match nodes.len() > rule.most_nodes || lost > bound {
        true => Err(PlaceFault::TooMany(lost)),
        false => Ok(Placed { nodes, loss: lost }),
    }
}

/// The nodes of a function at these places.
fn nodes_at(
    at: impl Iterator<Item = i64>,
    value: impl Fn(i64) -> Result<[f64; 2], CommandFault>,
    increment: f64,
) -> Result<Vec<Node>, CommandFault> {
    at.map(|at| Ok(node(&(at, value(at)?), increment))).collect()
}

fn equal(
    function: &Function<'_>,
    looks: &[Look],
    (rule, modulo): (Rule, bool),
    bound: f64,
) -> Result<Placed, PlaceFault> {
    let (from, to) = (looks[0].0, looks[looks.len() - 1].0);
    let mut count = rule.fewest_nodes.max(2);
    let mut best = f64::INFINITY;
    while count <= rule.most_nodes {
        let steps = count as i64 - 1;
        // A turn closes only if the steps divide it.
        if !modulo || TURN % steps == 0 {
            let step = ((to - from) / steps).div_euclid(rule.position).max(1) * rule.position;
            let at = (0..count as i64).map(|i| from + i * step);
            let nodes = nodes_at(at, function, rule.increment)?;
            let lost = loss(&nodes, looks, best.max(bound));
            if lost <= bound {
                return Ok(Placed { loss: loss(&nodes, looks, f64::INFINITY), nodes });
            }
            best = best.min(lost);
        }
        count += if count < ONE_BY_ONE || modulo { 1 } else { count / 32 };
    }
    Err(PlaceFault::TooMany(best))
}

fn stepped(
    function: &Function<'_>,
    looks: &[Look],
    (rule, unit): (Rule, i64),
    bound: f64,
) -> Result<Placed, PlaceFault> {
    let (from, to) = (looks[0].0, looks[looks.len() - 1].0);
    let (low, high) = (from.min(0), to.max(0));
    let mut best = f64::INFINITY;
    let mut count = rule.fewest_nodes.max(2);
    while count <= rule.most_nodes {
        // The ends may cost one more interval on either side of zero.
        let step = (high - low).div_euclid((count as i64 - 2).max(1) * unit).max(1) * unit;
        let first = low.div_euclid(step);
        let last = -(-high).div_euclid(step);
        let at = (first..=last).map(|i| i * step);
        let nodes = nodes_at(at, |at| function(at.clamp(from, to)), rule.increment)?;
        let nearest = |at, side| stepwise(&nodes, at, side);
        let lost_now = lost(&nearest, looks, best.max(bound));
        if nodes.len() <= rule.most_nodes {
            if lost_now <= bound {
                return Ok(Placed { loss: lost_now, nodes });
            }
            best = best.min(lost_now);
        }
        count += if count < ONE_BY_ONE { 1 } else { count / 32 };
    }
    Err(PlaceFault::TooMany(best))
}

/// A turn, counts.
const TURN: i64 = 360 * PER_UNIT as i64;

/// Stepped, all around: from 0 to a turn, the last node the same as the first.
fn around(
    function: &Function<'_>,
    looks: &[Look],
    (rule, unit): (Rule, i64),
    bound: f64,
) -> Result<Placed, PlaceFault> {
    let (from, to) = (looks[0].0, looks[looks.len() - 1].0);
    let mut turns = 0.0_f64;
    for (at, [up, down]) in looks.iter().take_while(|(at, _)| at + TURN <= to) {
        let [later_up, later_down] = function(at + TURN)?;
        turns = turns.max((later_up - up).abs().max((later_down - down).abs()));
    }
    if 0.5 * turns > bound {
        return Err(PlaceFault::Turns(0.5 * turns));
    }
    let mut best = f64::INFINITY;
    let steps = 1..=rule.most_nodes as i64 - 1;
    for steps in steps.filter(|steps| TURN % (steps * unit) == 0) {
        let step = TURN / steps;
        let value = |at: i64| around_value(function, at.rem_euclid(TURN), (from, to), step);
        let nodes = nodes_at((0..=steps).map(|i| i * step), value, rule.increment)?;
        let nearest = |at: f64, side| stepwise(&nodes, at.rem_euclid(TURN as f64), side);
        let lost_now = lost(&nearest, looks, best.max(bound));
        if lost_now <= bound {
            return Ok(Placed { loss: lost_now, nodes });
        }
        best = best.min(lost_now);
    }
    Err(PlaceFault::TooMany(best))
}

/// The function at a place of a turn. Where the travel does not come, the ends hold for one step, and a straight line leads
/// from the upper one to the lower one.
fn around_value(
    function: &Function<'_>,
    at: i64,
    (from, to): (i64, i64),
    step: i64,
) -> Result<[f64; 2], CommandFault> {
    // The same place of another turn, the one nearest to 0 that the travel has.
    let first = at + (from - at).div_euclid(TURN) * TURN;
    let same = (0..=1 + (to - from) / TURN + 1).map(|turn| first + turn * TURN);
    if let Some(at) = same.filter(|q| (from..=to).contains(q)).min_by_key(|q| q.abs()) {
        return function(at);
    }
    let beyond = (at - to).rem_euclid(TURN);
    let gap = TURN - (to - from);
    let share = ((beyond - step) as f64 / f64::max((gap - 2 * step) as f64, 1.0)).clamp(0.0, 1.0);
    let (high, low) = (function(to)?, function(from)?);
    Ok([0, 1].map(|side| high[side] + share * (low[side] - high[side])))
}

/// The value of the nearest node.
pub fn stepwise(nodes: &[Node], position: f64, side: f64) -> f64 {
    let after = nodes.partition_point(|n| (n.at as f64) <= position);
    let (before, next) = (after.saturating_sub(1), after.min(nodes.len().saturating_sub(1)));
    let (Some(a), Some(b)) = (nodes.get(before), nodes.get(next)) else { return 0.0 };
    let nearest = if position - (a.at as f64) < b.at as f64 - position { a } else { b };
    interpolated(std::slice::from_ref(nearest), false, position, side)
}

#[cfg(test)]
mod tests {
    use super::*;

    const RULE: Rule = Rule { most_nodes: 256, ..Rule::FREE };

    /// 10 µm/m over 1 m is one straight line; the parabola 90 µm·(x/m)² sags 22.5 µm·h², so that 1 µm needs 4.7 pieces.
    #[test]
    fn as_few_as_the_curvature_asks() {
        let line = |at: i64| Ok([-1e-5 * at as f64; 2]);
        let bow = |at: i64| Ok([9e4 * (at as f64 / 1e9).powi(2); 2]);
        for spacing in [Spacing::Free, Spacing::Equal] {
            let rule = (Rule { spacing, ..RULE }, false);
            let placed = place(&line, (0, 1_000_000_000), rule, 1000.0).unwrap();
            assert_eq!(placed.nodes.len(), 2);
            assert_eq!(placed.nodes[1].up, -10_000);
            let placed = place(&bow, (0, 1_000_000_000), rule, 1000.0).unwrap();
            assert_eq!(placed.nodes.len(), 6, "{placed:?}");
            assert!(placed.loss <= 1000.0 && placed.loss > 500.0);
        }
    }

    #[test]
    fn what_cannot_be() {
        let wild = |at: i64| Ok([1e5 * (at as f64 / 1e6).sin(); 2]);
        let few = (Rule { most_nodes: 10, ..RULE }, false);
        let fault = place(&wild, (0, 1_000_000_000), few, 1000.0);
        assert!(matches!(fault, Err(PlaceFault::TooMany(_))), "{fault:?}");
        let coarse = (Rule { increment: 3000.0, ..RULE }, false);
        assert_eq!(place(&wild, (0, 1000), coarse, 1000.0), Err(PlaceFault::Increment));
    }
}
