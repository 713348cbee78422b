//! The inverse of the nominal chain in closed form, chosen once for a machine, for W poses side by side.
//!
//! ```text
//!     chain from the workpiece:   A · (linear axes, no rotary axis between) · B · tip
//!     A⁻¹(tip wanted) − B(tip) = D q      q = D⁻¹ (A⁻¹(tip wanted) − B(tip))           docs/model.md eq. 337
//! ```
//!
//! The columns of D are the directions of the three linear axes that place the tip. They are the same at
//! every pose, because no rotary axis stands between them; where one does, [`super::Placer`] has to be asked.

mod aim;

use super::serial::Serial;
use crate::Machine;
use crate::axis::{AxisKind, Command, MAX_AXES};
use crate::chain::Link;
use crate::lanes::vectors::{
    difference, dot, product, rotation, slide, splat3, splat33, sum, turn_pair_about,
};
use crate::lanes::{Lanes, sine_cosine};
pub(crate) use aim::Aim;
use trueaxis_geometry::{Mat3, Vec3};

/// Below this volume the three linear axes do not span the space, as in [`super::Placer`].
const FLAT: f64 = 1e-3;

/// Sines of larger angles are left to the library, rad.
pub(crate) const LARGEST_ANGLE_RAD: f64 = 1e6;

/// A step of the chain that a place or a direction goes through.
#[derive(Debug, Clone)]
enum Step {
    Place {
        linear: Option<[[f64; 3]; 3]>,
        shift_mm: [f64; 3],
    },
    /// About x, y or z (0, 1, 2).
    TurnAbout {
        turn: usize,
        about: usize,
        sense: f64,
    },
    Turn {
        turn: usize,
        direction: [f64; 3],
        sense: f64,
    },
    Slide {
        axis: usize,
        per_unit: [f64; 3],
    },
}

/// The linear axes for a tip, and the tool at axis positions.
#[derive(Debug, Clone)]
pub(crate) struct ClosedForm {
    /// The rotary axes, in the order of the sines of a pose.
    rotary: Vec<usize>,
    tip_mm: [f64; 3],
    tool_axis: [f64; 3],
    /// From the tool to the linear axes at zero.
    from_tool: Vec<Step>,
    /// From the workpiece to the linear axes, and back.
    from_workpiece: Vec<Step>,
    to_workpiece: Vec<Step>,
    /// The linear axes that place the tip: X Y Z before U V W.
    pub placing: [usize; 3],
    /// The rows of D, and those of D⁻¹.
    directions: [[f64; 3]; 3],
    inverse: [[f64; 3]; 3],
}

/// Sine and cosine of every rotary axis at W poses.
pub(crate) type Sines<L> = [[L; 2]; MAX_AXES];

impl ClosedForm {
    /// `None` where a rotary axis stands between the three linear axes, or these do not span the space.
    pub fn of(machine: &Machine, serial: &Serial, placing: [usize; 3]) -> Option<Self> {
        let [first, last] = [*placing.iter().min()?, *placing.iter().max()?];
        if (first..=last).any(|i| serial.joints[i].kind == AxisKind::Rotary) {
            return None;
        }
        let rotary: Vec<usize> = serial.rotary().collect();
        let chain = Chain { serial, rotary: &rotary };
        let mut from_tool = Vec::new();
        for i in (first..serial.fixed.len()).rev() {
            if i < serial.joints.len() && !placing.contains(&i) {
                from_tool.push(chain.joint(i, 1.0));
            }
            place(&mut from_tool, &serial.fixed[i]);
        }
        let (mut from_workpiece, mut to_workpiece) = (Vec::new(), Vec::new());
        for i in 0..first {
            place(&mut from_workpiece, &serial.fixed[i].inverse());
            from_workpiece.push(chain.joint(i, -1.0));
        }
        for i in (0..first).rev() {
            to_workpiece.push(chain.joint(i, 1.0));
            place(&mut to_workpiece, &serial.fixed[i]);
        }
        let directions = chain.directions(placing, first);
        let volume = directions.determinant();
        if volume.is_nan() || volume.abs() <= FLAT {
            return None;
        }
        let (mut tip, mut tool_axis) = (machine.tip_mm(), Vec3::z());
        // What does not turn before the first joint is the same at every pose.
        if let Some(Step::Place { linear, shift_mm }) = from_tool.first() {
            if let Some(rows) = linear {
                let linear = Mat3::from_fn(|i, k| rows[i][k]);
                (tip, tool_axis) = (linear * tip, linear * tool_axis);
            }
            tip += Vec3::from(*shift_mm);
            from_tool.remove(0);
        }
        Some(Self {
            rotary,
            tip_mm: tip.into(),
            tool_axis: tool_axis.into(),
            from_tool,
            from_workpiece,
            to_workpiece,
            placing,
            directions: rows(&directions),
            inverse: rows(&directions.try_inverse()?),
        })
    }

    /// Whether every rotary axis is within the angles that the sines hold for; NaN is not.
    pub fn holds_for(&self, command: &Command) -> bool {
        self.rotary.iter().all(|i| command[*i].abs() <= LARGEST_ANGLE_RAD)
    }

    /// The same of columns of commands.
    pub fn holds<const N: usize>(&self, commands: &[[f64; N]; MAX_AXES]) -> bool {
        let small = |axis: &usize| commands[*axis].iter().all(|q| q.abs() <= LARGEST_ANGLE_RAD);
        self.rotary.iter().all(small)
    }

    /// Sine and cosine of the rotary axes.
    #[inline(always)]
    pub fn sines<const W: usize, L: Lanes<W>>(&self, q: &[L; MAX_AXES]) -> Sines<L> {
        let mut sines = [[L::splat(0.0); 2]; MAX_AXES];
        for (k, axis) in self.rotary.iter().enumerate() {
            let (sin, cos) = sine_cosine(q[*axis]);
            sines[k] = [sin, cos];
        }
        sines
    }

    /// The axes of [`ClosedForm::placing`] that bring the tip there.
    #[inline(always)]
    pub fn place<const W: usize, L: Lanes<W>>(
        &self,
        tip_mm: [L; 3],
        q: &[L; MAX_AXES],
        sines: &Sines<L>,
    ) -> [L; 3] {
        let wanted = through(&self.from_workpiece, tip_mm, q, sines);
        let at_zero = through(&self.from_tool, splat3(&self.tip_mm), q, sines);
        product(&splat33(&self.inverse), &difference(wanted, at_zero))
    }

    /// Tip (mm) and tool axis (unit vector).
    #[inline(always)]
    pub fn tool<const W: usize, L: Lanes<W>>(
        &self,
        q: &[L; MAX_AXES],
        sines: &Sines<L>,
    ) -> [[L; 3]; 2] {
        let at_zero = through(&self.from_tool, splat3(&self.tip_mm), q, sines);
        let [i, j, k] = self.placing;
        let linear = [q[i], q[j], q[k]];
        let moved = sum(at_zero, product(&splat33(&self.directions), &linear));
        let axis = directed(&self.from_tool, splat3(&self.tool_axis), sines);
        let axis = directed(&self.to_workpiece, axis, sines);
        let shorter = L::splat(1.0) / dot(&axis, &axis).square_root();
        let axis = [axis[0] * shorter, axis[1] * shorter, axis[2] * shorter];
        [through(&self.to_workpiece, moved, q, sines), axis]
    }
}

/// A place through steps.
#[inline(always)]
fn through<const W: usize, L: Lanes<W>>(
    steps: &[Step],
    mut v: [L; 3],
    q: &[L; MAX_AXES],
    sines: &Sines<L>,
) -> [L; 3] {
    for step in steps {
        match step {
            Step::Place { linear, shift_mm } => {
                if let Some(linear) = linear {
                    v = product(&splat33(linear), &v);
                }
                v = sum(v, splat3(shift_mm));
            }
            Step::Slide { axis, per_unit } => slide(&mut v, &splat3(per_unit), q[*axis]),
            turn => turned(turn, &mut v, sines),
        }
    }
    v
}

/// A direction through steps.
#[inline(always)]
fn directed<const W: usize, L: Lanes<W>>(
    steps: &[Step],
    mut v: [L; 3],
    sines: &Sines<L>,
) -> [L; 3] {
    for step in steps {
        match step {
            Step::Place { linear: Some(linear), .. } => v = product(&splat33(linear), &v),
            Step::Place { linear: None, .. } | Step::Slide { .. } => {}
            turn => turned(turn, &mut v, sines),
        }
    }
    v
}

#[inline(always)]
fn turned<const W: usize, L: Lanes<W>>(step: &Step, v: &mut [L; 3], sines: &Sines<L>) {
    match step {
        Step::TurnAbout { turn, about, sense } => {
            let [sin, cos] = sines[*turn];
            turn_pair_about(v, *about, sin * L::splat(*sense), cos);
        }
        Step::Turn { turn, direction, sense } => {
            let [sin, cos] = sines[*turn];
            *v = product(&rotation(splat3(direction), sin * L::splat(*sense), cos), v);
        }
        Step::Place { .. } | Step::Slide { .. } => {}
    }
}

/// The joints of a chain as steps.
struct Chain<'s> {
    serial: &'s Serial,
    rotary: &'s [usize],
}

impl Chain<'_> {
    /// A joint, or with −1 the way back through it.
    fn joint(&self, axis: usize, way: f64) -> Step {
        let joint = &self.serial.joints[axis];
        let sense = way * joint.sense;
        match self.rotary.iter().position(|i| *i == axis) {
            None => Step::Slide { axis, per_unit: (joint.direction * sense).into() },
            Some(turn) => match along_an_axis(&joint.direction) {
                Some((about, sign)) => Step::TurnAbout { turn, about, sense: sign * sense },
                None => Step::Turn { turn, direction: joint.direction.into(), sense },
            },
        }
    }

    /// The directions of the linear axes as columns, in front of the joint `first`.
    fn directions(&self, placing: [usize; 3], first: usize) -> Mat3 {
        let columns = placing.map(|axis| {
            let joint = &self.serial.joints[axis];
            let fixed = self.serial.fixed[first..=axis].iter().rev();
            fixed.fold(joint.direction * joint.sense, |v, link| link.linear() * v)
        });
        Mat3::from_columns(&columns)
    }
}

/// The index of the axis that a unit vector is, and its sign.
fn along_an_axis(direction: &Vec3) -> Option<(usize, f64)> {
    let about = direction.iamax();
    let others = (0..3).filter(|i| *i != about).all(|i| direction[i] == 0.0);
    (others && direction[about].abs() == 1.0).then_some((about, direction[about]))
}

/// Appends a fixed step; what does nothing is left out.
fn place(steps: &mut Vec<Step>, link: &Link) {
    let turns = *link.linear() != Mat3::identity();
    if !turns && *link.shift_mm() == Vec3::zeros() {
        return;
    }
    let linear = turns.then(|| rows(link.linear()));
    steps.push(Step::Place { linear, shift_mm: (*link.shift_mm()).into() });
}

fn rows(m: &Mat3) -> [[f64; 3]; 3] {
    std::array::from_fn(|i| std::array::from_fn(|k| m[(i, k)]))
}

#[cfg(test)]
mod tests {
    use super::super::{DirectionSolver, Placer, turns};
    use super::*;
    use crate::file::NoTables;
    use crate::lanes::Plain;

    /// Heads, tables and mixtures; placements, slanting axes, redundant axes, more and fewer rotary ones.
    const MACHINES: [&str; 8] = [
        "chain = \"w b X Y Z C A t\"\n[tool]\nplacement = \"1 2 -200 mm\"\nlength = \"100 mm\"",
        "chain = \"w C' A' b X Y Z t\"\n[axis.A]\nplacement = \"1 -20 30 mm\"",
        "chain = \"w C' X' b Y Z B t\"\n[tool]\nlength = \"80 mm\"",
        "chain = \"w X' Y' b Z B A t\"",
        "chain = \"w b X Y Z t\"",
        "chain = \"w C' b X Y Z t\"",
        "chain = \"w b X Y Z C B t\"\n[axis.B]\ndirection = \"0 1 1\"\nplacement = \"3 4 5 mm\"",
        "chain = \"w C' X' b Z Y W A t\"",
    ];

    fn machine(text: &str) -> Machine {
        let text = format!("[machine]\nname = \"m\"\n{text}\n");
        let (machine, problems) = Machine::check("m.toml", &text, &NoTables);
        machine.unwrap_or_else(|| panic!("{text}{:?}", problems.iter().collect::<Vec<_>>()))
    }

    fn random(state: &mut u64) -> f64 {
        *state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        2.0 * (*state >> 11) as f64 / (1_u64 << 53) as f64 - 1.0
    }

    fn plain(v: Vec3) -> [Plain<1>; 3] {
        [v.x, v.y, v.z].map(|x| Plain([x]))
    }

    /// The tool by the closed form is the tool by the chain, and the linear axes come back.
    #[test]
    fn law_the_closed_form_is_the_chain() {
        for text in MACHINES {
            let machine = machine(text);
            let serial = Serial::of(&machine);
            let placer = Placer::of(&machine, &serial).expect("three linear axes");
            let form = ClosedForm::of(&machine, &serial, placer.placing).expect(text);
            let mut state = 3;
            for _ in 0..2000 {
                let mut command = Command::default();
                for (q, axis) in command.iter_mut().zip(machine.axes()) {
                    let most = if axis.kind == AxisKind::Linear { 1000.0 } else { 7.0 };
                    *q = most * random(&mut state);
                }
                let q = command.map(|q| Plain([q]));
                let sines = form.sines(&q);
                let [tip, axis] = form.tool(&q, &sines).map(|v| Vec3::from(v.map(|x| x.0[0])));
                let (there, along) = placer.tip_and_axis(&command);
                assert!((tip - there).norm() < 1e-11, "{text} {:e}", (tip - there).norm());
                assert!((axis - along).norm() < 1e-14, "{text} {:e}", (axis - along).norm());
                for (axis, q) in form.placing.into_iter().zip(form.place(plain(there), &q, &sines))
                {
                    assert!((q.0[0] - command[axis]).abs() < 1e-11, "{text} {command:?}");
                }
            }
        }
    }

    /// Both branches are those of the triangle, close to the poles too; what the scalar form has to decide is near one.
    #[test]
    fn law_the_branches_are_those_of_the_triangle() {
        for text in MACHINES {
            let machine = machine(text);
            let serial = Serial::of(&machine);
            let solver = DirectionSolver::of(&serial, &Command::default());
            let Some(aim) = Aim::of(&solver) else { continue };
            let (mut state, mut decided) = (5, 0);
            for i in 0..4000 {
                let near = 10_f64.powf(-10.0 * random(&mut state).abs());
                let mut command = Command::default();
                for axis in aim.axes {
                    let size = if i % 2 == 0 { 3.1 } else { near };
                    command[axis] = size * random(&mut state);
                }
                let u = serial.tool_axis(&command);
                let (both, undecided) = aim.branches(plain(u));
                let Ok(wanted) = solver.at(u) else { panic!("{text} {command:?}") };
                if undecided != 0 {
                    continue;
                }
                decided += 1;
                for found in both.map(|angles| angles.map(|q| turns::principal(q.0[0]))) {
                    let mut turned = command;
                    for (axis, q) in aim.axes.into_iter().zip(found) {
                        turned[axis] = q;
                    }
                    let off = (serial.tool_axis(&turned) - u).norm();
                    assert!(off < 2e-15, "{text} {command:?} {off:e}");
                    let apart = |angles: [Option<f64>; 2]| {
                        let turns = solver.turning.iter().zip(angles).zip(found);
                        let each = turns.map(|((turn, q), found)| {
                            let by = q.map_or(0.0, |q| turn.sense * q - found);
                            (by - std::f64::consts::TAU * (by / std::f64::consts::TAU).round())
                                .abs()
                        });
                        each.fold(0.0, f64::max)
                    };
                    let nearest = wanted.branches().map(apart).fold(f64::INFINITY, f64::min);
                    // The nearer the pole, the less the direction says about the first angle; the nearer the
                    // branches are to each other, the less it says about the second.
                    let seconds: Vec<f64> = wanted.branches().filter_map(|q| q[1]).collect();
                    let gap = (0.5 * (seconds[0] - seconds[1])).sin().abs();
                    let sine = gap * solver.pair.map_or(1.0, |pair| pair.a.cross(&u).norm());
                    assert!(nearest < 1e-14 / sine, "{text} {command:?} {nearest:e}");
                }
            }
            assert!(decided > 3500, "{text}: {decided}");
        }
    }
}
