//! What a control does with the vectors of an orientable tool carrier: those that stand in the file, and no others.
//!
//! ```text
//!     x = L·q + I1 + R1·(I2 + R2·(I3 + t))        head (T)      the tool, from where it is with all axes at 0
//!     x = L·q + I1 + R1·(I2 + t)                  both (M)
//!     y = R2ᵀ·(R1ᵀ·(x − I2) − I3) − I4            table (P)     the same point in the turning workpiece
//!     y = R2ᵀ·(x − I3) − I4                       both (M)
//! ```
//!
//! L·q are the linear axes, t the tool, R1 and R2 turns about V1 and V2. With the closing vectors nothing is added at
//! zero angles, whatever the others are: docs/model.md eq. 333.

use super::control::File;
use super::lever::sum;
use super::nominal::LinearInverse;
use super::tool_carrier::{CARRIER, Kind, axes};
use trueaxis_geometry::frame::rotation;
use trueaxis_geometry::{Mat3, Vec3};
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{AxisKind, Command, MAX_AXES};
use trueaxis_machine::errors::ErrorValues;

/// The vectors of one file.
struct Vectors {
    offsets: [Vec3; 4],
    directions: [Vec3; 2],
}

impl Vectors {
    /// The numbers as they stand in the text; what is not there is 0.
    fn of(file: &File) -> Option<Self> {
        let number = |n: usize| {
            let name = format!("$TC_CARR{n}[{CARRIER}]=");
            let text = file.text.lines().find_map(|line| line.strip_prefix(&name));
            text.map_or(Some(0.0), |text| text.trim().parse::<f64>().ok())
        };
        let three = |n: usize| Some(Vec3::new(number(n)?, number(n + 1)?, number(n + 2)?));
        let direction = |n: usize| three(n)?.try_normalize(1e-9);
        Some(Self {
            offsets: [three(1)?, three(4)?, three(15)?, three(18)?],
            directions: [direction(7)?, direction(10)?],
        })
    }
}

/// The control's transformation with the vectors of a file, beside the one with nominal vectors.
pub struct CarrierChain {
    kind: Kind,
    rotary: [usize; 2],
    /// What each linear axis does to the tool at zero angles, in directions of the bed.
    linear: [Vec3; MAX_AXES],
    tool: Vec3,
    workpiece_from_bed: Mat3,
    written: Vectors,
    nominal: Vectors,
}

impl CarrierChain {
    /// Of a file, and of the file that a machine without errors would have.
    pub fn of(machine: &Machine, written: &File, nominal: &File) -> Option<Self> {
        let (kind, names) = axes(machine)?;
        let [one, two] = names.map(|name| machine.axis_index(name));
        let zero = Command::default();
        let poses = machine.body_poses(&zero, &ErrorValues::default());
        let bed_from_workpiece = poses.first()?.linear();
        let tip = |command: &Command| {
            let there = machine.deviation(command, &ErrorValues::default());
            bed_from_workpiece * there.nominal_tip.vector()
        };
        let mut linear = [Vec3::zeros(); MAX_AXES];
        for (i, axis) in machine.axes().iter().enumerate() {
            if axis.kind == AxisKind::Linear {
                let mut more = zero;
                more[i] = 1.0;
                linear[i] = tip(&more) - tip(&zero);
            }
        }
        Some(Self {
            kind,
            rotary: [one?, two?],
            linear,
            tool: poses.last()?.linear() * machine.tip_mm(),
            workpiece_from_bed: bed_from_workpiece.transpose(),
            written: Vectors::of(written)?,
            nominal: Vectors::of(nominal)?,
        })
    }

    /// Where the control has the tool in the workpiece, in directions of the bed at zero angles.
    fn place(&self, vectors: &Vectors, command: &Command) -> Vec3 {
        let [i1, i2, i3, i4] = vectors.offsets;
        let [r1, r2] = [0, 1].map(|i| rotation(vectors.directions[i], command[self.rotary[i]]));
        let moved: Vec3 = self.linear.iter().zip(command).map(|(d, q)| d * *q).sum();
        match self.kind {
            Kind::Head => moved + i1 + r1 * (i2 + r2 * (i3 + self.tool)),
            Kind::Table => {
                let x = moved + self.tool;
                r2.transpose() * (r1.transpose() * (x - i2) - i3) - i4
            }
            Kind::Both => {
                let x = moved + i1 + r1 * (i2 + self.tool);
                r2.transpose() * (x - i3) - i4
            }
        }
    }

    /// What the control adds to the linear axes of a command.
    pub fn added(&self, machine: &Machine, command: &Command) -> Command {
        let wanted = self.place(&self.nominal, command);
        let inverse = LinearInverse::of(machine, command);
        let mut added = Command::default();
        // The linear axes are straight: the second step is left to rounding.
        for _ in 0..2 {
            let off = self.place(&self.written, &sum(command, &added)) - wanted;
            for (axis, step) in inverse.steps(&(self.workpiece_from_bed * off)) {
                added[axis] -= step;
            }
        }
        added
    }
}

#[cfg(test)]
mod tests {
    use super::super::joints::Joints;
    use super::super::tool_carrier::write;
    use super::*;
    use trueaxis_machine::file::NoTables;

    /// With nominal vectors the file describes the machine: head, table, and one of each.
    #[test]
    fn nominal_vectors_are_the_machine() {
        for chain in ["w b X Y Z C A t", "w C' A' b X Y Z t", "w C' X' b Y Z A t"] {
            let text = format!(
                "[machine]\nname = \"m\"\nchain = \"{chain}\"\n[axis.A]\nplacement = \"3 -7 -200 mm\"\n\
                 [axis.C]\nplacement = \"40 10 5 mm\"\n[workpiece]\nplacement = \"1 2 30 mm\"\n\
                 [tool]\nlength = \"110 mm\""
            );
            let machine = Machine::check("m.toml", &text, &NoTables).0.unwrap();
            let file = write(&machine, &Joints::nominal(&machine)).unwrap();
            let chain = CarrierChain::of(&machine, &file, &file).unwrap();
            let apart = |k: f64| {
                let command: Command = std::array::from_fn(|i| {
                    let size = match machine.axes().get(i).map(|a| a.kind) {
                        Some(AxisKind::Linear) => 100.0,
                        _ => 1.5,
                    };
                    size * (k * (i + 1) as f64).sin()
                });
                let tip = machine.deviation(&command, &ErrorValues::default()).nominal_tip;
                chain.workpiece_from_bed * chain.place(&chain.nominal, &command) - tip.vector()
            };
            let constant = apart(0.0);
            for k in 1..20 {
                assert!((apart(f64::from(k)) - constant).norm() < 1e-6, "{text} {k}");
            }
        }
    }

    /// Whatever the vectors: at zero angles a file that closes adds nothing.
    #[test]
    fn nothing_is_added_at_zero_angles() {
        let text = "[machine]\nname = \"m\"\nchain = \"w b X Y Z C A t\"\n\
            [axis.A]\nplacement = \"0 0 -200 mm\"\n[location]\nEB0C = \"100 urad\"\n\
            EX0C = \"5 um\"\nEY0A = \"-7 um\"\nEC0A = \"30 urad\"\n[tool]\nlength = \"100 mm\"";
        let machine = Machine::check("m.toml", text, &NoTables).0.unwrap();
        let [written, nominal] = [Joints::actual(&machine), Joints::nominal(&machine)]
            .map(|joints| write(&machine, &joints).unwrap());
        let chain = CarrierChain::of(&machine, &written, &nominal).unwrap();
        let mut command = [10.0, 20.0, -30.0, 0.0, 0.0, 0.0];
        assert!(chain.added(&machine, &command).iter().all(|q| q.abs() < 1e-9));
        // A quarter of a turn of A with a tool of 100 mm: C has tilted A by 100 µrad, 10 µm in x, and A's own 30 µrad
        // are −3 µm.
        command[4] = std::f64::consts::FRAC_PI_2;
        let added = chain.added(&machine, &command);
        assert!((added[0] + 7e-3).abs() < 2e-6 && added[1].hypot(added[2]) < 2e-6, "{added:?}");
        // The same of C: A hangs (−20, −7) µm from it, closed by the first vector: (27, −13) µm; its tilt over
        // 300 mm adds (−30, 30) µm.
        (command[3], command[4]) = (std::f64::consts::FRAC_PI_2, 0.0);
        let added = chain.added(&machine, &command);
        assert!((added[0] - 3e-3).hypot(added[1] + 17e-3) < 5e-6, "{added:?}");
    }
}
