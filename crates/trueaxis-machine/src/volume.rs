//! Poses over the travel of all axes: the volume in which machines are compared.

use crate::Machine;
use crate::axis::{Approach, Axis, AxisKind, Command, Travel};

/// Range on both sides of zero for an axis without stated ends, mm.
const FREE_MM: f64 = 250.0;

/// Poses that fill the travel of all axes evenly: all corners, then `count` multiples of irrational numbers.
///
/// The numbers are 1/g, 1/g², … of the root g of gⁿ⁺¹ = g + 1, which leave no direction sparse
/// (Roberts 2018, after Kronecker).
#[expect(clippy::cast_possible_truncation, reason = "a machine has at most six axes")]
pub fn commands(axes: &[Axis], count: u32) -> Vec<Command> {
    let n = axes.len() as i32;
    let g = (0..60).fold(2.0_f64, |g, _| (1.0 + g).powf(1.0 / f64::from(n + 1)));
    let ends: Vec<(f64, f64)> = axes.iter().map(ends).collect();
    let at = |share: &dyn Fn(usize) -> f64| {
        let mut command = Command::default();
        for (i, (from, to)) in ends.iter().enumerate() {
            command[i] = from + (to - from) * share(i);
        }
        command
    };
    let corners = (0..1_u32 << n).map(|bits| at(&|i| f64::from(bits >> i & 1)));
    let inside =
        (1..=count).map(|k| at(&|i| (0.5 + f64::from(k) * g.powi(-(i as i32) - 1)).fract()));
    corners.chain(inside).collect()
}

/// Every combination of directions of the axes of which one of these machines states a reversal; one without a direction if
/// there is none.
///
/// ```
/// use trueaxis_machine::{Machine, file::NoTables, volume::approaches};
/// let text = "[machine]\nname = \"m\"\nchain = \"w b X Y Z t\"\n[motion.Y]\n\
///             EXY = { constant = \"1 um\", reversal = \"2 um\" }";
/// let machine = Machine::check("m.toml", text, &NoTables).0.unwrap();
/// assert_eq!(approaches(&[&machine]).len(), 2);
/// assert_eq!(approaches(&[&machine])[1][1], 1.0);
/// ```
pub fn approaches(machines: &[&Machine]) -> Vec<Approach> {
    let mut axes: Vec<usize> = Vec::new();
    for machine in machines {
        for (index, _) in machine.stated_errors() {
            let body = &machine.bodies()[index.body];
            let stated = body.stated(index.kind, index.component);
            let directed = stated.is_some_and(|s| s.reversal.is_some());
            axes.extend(body.axis.filter(|axis| directed && !axes.contains(axis)));
        }
    }
    let all = 0..1_u32 << axes.len();
    all.map(|bits| {
        let mut approach = Approach::default();
        for (bit, axis) in axes.iter().enumerate() {
            approach[*axis] = if bits >> bit & 1 == 1 { 1.0 } else { -1.0 };
        }
        approach
    })
    .collect()
}

fn ends(axis: &Axis) -> (f64, f64) {
    match (axis.travel, axis.kind) {
        (Travel::Between(from, to), _) => (from, to),
        (_, AxisKind::Rotary) => (-std::f64::consts::PI, std::f64::consts::PI),
        (_, AxisKind::Linear) => (-FREE_MM, FREE_MM),
    }
}
