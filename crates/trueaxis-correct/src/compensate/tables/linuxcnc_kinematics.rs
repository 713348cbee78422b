//! LinuxCNC: centres of tilting rotary tables as pins of `xyzac-trt-kins` and `xyzbc-trt-kins`.
//!
//! ```text
//!     P = p + Rz(s·C)·(Rt(s·T)·(J − d − p) + d)        T: A about x, or B about y
//!     p = point of C, d = point of T − p               where X, Y, Z stand with a tool of no length there
//!     s = −1: LinuxCNC's usual directions, +1: `conventional-directions`
//! ```
//!
//! J are the joints X, Y, Z; P is the position for the table at its zero. src/emc/kinematics/trtfuncs.c of LinuxCNC,
//! docs/model.md eq. 332. d has no component along T, and z-rot-point and z-offset act as their sum; here the first
//! is the z of the point of C, so that both points can be read back.

use super::control::{File, ReadFault};
use super::joints::{Joint, Joints, moves_an_axis};
use super::table::{decimal, parse_decimal};
use super::tool_carrier::{minus, plus, tool};
use std::collections::BTreeMap;
use trueaxis_geometry::Vec3;
use trueaxis_geometry::frame::rotation;
use trueaxis_machine::Machine;
use trueaxis_machine::axis::Command;
use trueaxis_machine::errors::{Component, ErrorName, ErrorValues};

/// The file.
pub const NAME: &str = "kinematics.hal";

/// A kinematics module.
#[derive(Debug, PartialEq)]
struct Module {
    name: &'static str,
    /// The axis that tilts the table.
    tilt: char,
    /// The place of the pin of d beside z-offset among x, y, z.
    across: usize,
}

const MODULES: [Module; 2] = [
    Module { name: "xyzac-trt-kins", tilt: 'A', across: 1 },
    Module { name: "xyzbc-trt-kins", tilt: 'B', across: 0 },
];

/// Places at which the machine's chain is compared with that of a module: X Y Z, tilt and C, mm and rad.
const PLACES: [[f64; 5]; 3] = [
    [130.0, -70.0, 40.0, 0.6, 1.1],
    [-20.0, 90.0, -150.0, -0.9, 2.3],
    [60.0, 10.0, 80.0, 1.3, -0.4],
];
/// Chains that differ by more are two, mm.
const SAME_MM: f64 = 1e-5;

impl Module {
    /// The module whose kinematics are those of the machine, and s.
    fn of(machine: &Machine) -> Option<(&'static Self, f64)> {
        let all = MODULES.iter().flat_map(|module| [(module, -1.0), (module, 1.0)]);
        all.into_iter().find(|(module, sense)| module.is_of(machine, *sense) == Some(true))
    }

    /// The axes of the machine in the order of the module, if these are all that there are.
    fn axes(&self, machine: &Machine) -> Option<[usize; 5]> {
        let axes = machine.axes();
        let mut found = [0; 5];
        for (place, letter) in found.iter_mut().zip(['X', 'Y', 'Z', self.tilt, 'C']) {
            *place = axes.iter().position(|a| a.name.letter() == letter)?;
        }
        (axes.len() == found.len()).then_some(found)
    }

    /// The C axis and the one that tilts.
    fn pair(&self, joints: &Joints) -> Option<[Joint; 2]> {
        let find = |letter| joints.0.iter().copied().find(|j| j.axis.letter() == letter);
        Some([find('C')?, find(self.tilt)?])
    }

    /// Whether tool and table of the machine stand to each other as in this module, and the tool along Z.
    fn is_of(&self, machine: &Machine, sense: f64) -> Option<bool> {
        let axes = self.axes(machine)?;
        let [p, t] = self.pair(&Joints::nominal(machine))?.map(|j| j.point_mm());
        let about = if self.tilt == 'A' { Vec3::x() } else { Vec3::y() };
        let exact = ErrorValues::default();
        let zero = machine.body_poses(&Command::default(), &exact);
        let (workpiece, tool) = (zero.first()?, zero.last()?);
        let same = |look: &[f64; 5]| {
            let mut command = Command::default();
            for (axis, q) in axes.into_iter().zip(look) {
                command[axis] = *q;
            }
            let stands: Vec3 = workpiece.shift_mm()
                + workpiece.linear() * machine.pose(&command, &exact).shift_mm();
            let [x, y, z, tilt, c] = *look;
            let joints = tool.shift_mm() + Vec3::new(x, y, z);
            let tilted = rotation(about, sense * tilt) * (joints - t) + (t - p);
            let wanted: Vec3 = p + rotation(Vec3::z(), sense * c) * tilted;
            (stands - wanted).norm() < SAME_MM
        };
        let tip: Vec3 = tool.linear() * machine.tip_mm();
        Some(tip.xy().norm() < SAME_MM && PLACES.iter().all(same))
    }

    fn offset_pin(&self) -> String {
        format!("{}-offset", ['x', 'y'][self.across])
    }
}

/// Whether the pins hold this error: where C lies in X and Y, and where the tilting axis lies across itself.
///
/// A shift of C along itself is none of the kinematics but of the part, one of the tilting axis along itself
/// the zero of X or Y. Directions LinuxCNC takes as exact.
pub fn knows(machine: &Machine, error: ErrorName) -> bool {
    let Some((module, _)) = Module::of(machine).filter(|_| moves_an_axis(machine, error)) else {
        return false;
    };
    match (error.body.letter(), error.component) {
        ('C', Component::X | Component::Y) | ('A' | 'B', Component::Z) => true,
        ('A' | 'B', component) => component as usize == module.across,
        _ => false,
    }
}

/// The pins of a machine that has the kinematics of one of the modules.
pub fn write(machine: &Machine, joints: &Joints) -> Option<File> {
    let (module, sense) = Module::of(machine)?;
    let reference = tool(machine, None);
    let [p, t] = module.pair(joints)?.map(|j| minus(j.point, reference));
    let (d, across) = (minus(t, p), module.across);
    let Module { name, tilt, .. } = module;
    let mut text = format!(
        "# TrueAxis: where X, Y and Z stand with a tool of no length in the centres of {tilt} and C, mm\n\
         # [KINS] KINEMATICS = {name} (loadrt {name}), JOINTS = 5; [TRAJ] COORDINATES = X Y Z {tilt} C\n\
         # net tool-length motion.tooloffset.z => {name}.tool-offset\n"
    );
    if sense > 0.0 {
        text += &format!(
            "# {tilt} and C turn as in ISO 841: LinuxCNC before 2.10 cannot, from then on it needs this line\n\
             # setp {name}.conventional-directions 1\n"
        );
    }
    let offset = module.offset_pin();
    for (pin, value) in [
        ("x-rot-point", p[0]),
        ("y-rot-point", p[1]),
        ("z-rot-point", p[2]),
        (&offset, d[across]),
        ("z-offset", d[2]),
    ] {
        text += &format!("setp {name}.{pin} {}\n", decimal(value));
    }
    Some(File { name: NAME.to_owned(), text })
}

/// The axes of those pins; along themselves where the machine has them.
///
/// # Errors
/// What was expected, by line.
pub fn read(machine: &Machine, file: &File) -> Result<Joints, ReadFault> {
    let fault = |expected: String| ReadFault::new(&file.name, expected);
    let kinds = || fault("a machine with the kinematics of xyzac- or xyzbc-trt-kins".to_owned());
    let (module, _) = Module::of(machine).ok_or_else(kinds)?;
    let mut joints = Joints::nominal(machine);
    let [mut c, mut t] = module.pair(&joints).ok_or_else(kinds)?;
    let mut values = pins(module, file)?;
    let mut pin = |name: &str| {
        let value = values.remove(name);
        value.ok_or_else(|| fault(format!("setp {}.{name}", module.name)))
    };
    let p = [pin("x-rot-point")?, pin("y-rot-point")?, pin("z-rot-point")?];
    let (across, z) = (pin(&module.offset_pin())?, pin("z-offset")?);
    if let Some(name) = values.keys().next() {
        return Err(fault(format!("no pin {name}")));
    }
    c.point = plus(tool(machine, None), p);
    t.point[module.across] = c.point[module.across] + across;
    t.point[2] = c.point[2] + z;
    for joint in &mut joints.0 {
        *joint = if joint.axis == c.axis { c } else { t };
    }
    Ok(joints)
}

/// What the lines set, each pin once.
fn pins(module: &Module, file: &File) -> Result<BTreeMap<String, i64>, ReadFault> {
    let mut values = BTreeMap::new();
    for (n, line) in file.text.lines().enumerate().filter(|(_, l)| !l.starts_with('#')) {
        let fault = || {
            let expected =
                format!("line {}: setp {}.PIN NUMBER, each pin once", n + 1, module.name);
            ReadFault::new(&file.name, expected)
        };
        let words: Vec<&str> = line.split_whitespace().collect();
        let ["setp", pin, value] = words[..] else { return Err(fault()) };
        let pin = pin.strip_prefix(module.name).and_then(|p| p.strip_prefix('.'));
        let (pin, value) = pin.zip(parse_decimal(value)).ok_or_else(fault)?;
        if values.insert(pin.to_owned(), value).is_some() {
            return Err(fault());
        }
    }
    Ok(values)
}

#[cfg(test)]
mod tests {
    use super::*;
    use trueaxis_machine::file::NoTables;

    fn machine(chain: &str, more: &str) -> Machine {
        let text = format!("[machine]\nname = \"m\"\nchain = \"{chain}\"\n{more}");
        let (machine, problems) = Machine::check("m.toml", &text, &NoTables);
        machine.unwrap_or_else(|| panic!("{problems:?}"))
    }

    /// The tool stands 250 mm above the table whose C axis lies 10 µm too far in x and whose A axis, 20 mm below and
    /// 15 mm further back, 4 µm too high: so x-rot-point is 0.010, z-rot-point −250 + 0.004 because C lies on A, and from C
    /// to A it is as it was.
    #[test]
    fn a_centre_moved_by_ten_micrometres() {
        let more = "[axis.A]\nplacement = \"0 15 -20 mm\"\n[axis.C]\nplacement = \"0 -15 20 mm\"\n\
            [tool]\nplacement = \"0 0 250 mm\"\nlength = \"80 mm\"\n\
            [location]\nEX0C = \"10 um\"\nEZ0A = \"4 um\"";
        let machine = machine("w C' A' b X Y Z t", more);
        let joints = Joints::actual(&machine);
        let file = write(&machine, &joints).unwrap();
        let pins: Vec<&str> = file.text.lines().filter(|l| !l.starts_with('#')).collect();
        assert_eq!(
            pins,
            [
                "setp xyzac-trt-kins.x-rot-point 0.010000",
                "setp xyzac-trt-kins.y-rot-point 0.000000",
                "setp xyzac-trt-kins.z-rot-point -249.996000",
                "setp xyzac-trt-kins.y-offset 15.000000",
                "setp xyzac-trt-kins.z-offset -20.000000",
            ]
        );
        assert_eq!(read(&machine, &file).unwrap(), joints);
        for (from, to) in [
            ("z-offset", "w-offset"),
            ("0.010000", "0,010"),
            ("y-rot", "x-rot"),
            ("setp xyzac-trt-kins.z-offset -20.000000\n", ""),
            ("z-offset -20.000000", "z-offset -20.000000\nsetp xyzac-trt-kins.x-offset 0.0"),
        ] {
            let text = file.text.replace(from, to);
            assert!(read(&machine, &File { text, ..file.clone() }).is_err(), "{from} {to}");
        }
    }

    #[test]
    fn which_machines_and_which_errors() {
        let module = |chain: &str, more: &str| {
            Module::of(&machine(chain, more)).map(|(module, sense)| (module.name, sense))
        };
        let (ac, bc) = ("xyzac-trt-kins", "xyzbc-trt-kins");
        assert_eq!(module("w C' A' b X Y Z t", ""), Some((ac, 1.0)));
        assert_eq!(module("w C' B' X' b Y Z t", ""), Some((bc, 1.0)));
        // Along x, about x: in either order the same.
        assert_eq!(module("w C' X' A' b Y Z t", ""), Some((ac, 1.0)));
        let usual = "[axis.A]\nsense = 1\n[axis.C]\nsense = 1";
        assert_eq!(module("w C' A' Y' X' b Z t", usual), Some((ac, -1.0)));
        let mixed = "[axis.A]\nsense = 1";
        let back = "[axis.X]\nsense = -1";
        let aside = "[tool]\ntip = \"1 0 -90 mm\"";
        for (chain, more) in [
            ("w C' A' b X Y Z t", mixed),
            ("w C' A' b X Y Z t", back),
            ("w C' A' b X Y Z t", aside),
            ("w A' C' b X Y Z t", ""),
            ("w C' Y' A' b X Z t", ""),
            ("w C' b X Y Z A t", ""),
            ("w X' b Y Z C A t", ""),
            ("w b X Y Z t", ""),
        ] {
            assert_eq!(module(chain, more), None, "{chain} {more}");
        }
        let known = |chain: &str| {
            let machine = machine(chain, "");
            let bodies = machine.bodies().iter().filter(|b| b.name.is_rotary());
            let kind = trueaxis_machine::errors::ErrorKind::Location;
            let all = bodies.flat_map(|b| {
                Component::ALL.map(|component| ErrorName { body: b.name, kind, component })
            });
            let known = all.filter(|e| knows(&machine, *e)).map(|e| e.to_string());
            known.collect::<Vec<_>>()
        };
        assert_eq!(known("w C' A' b X Y Z t"), ["EX0C", "EY0C", "EY0A", "EZ0A"]);
        assert_eq!(known("w C' B' b X Y Z t"), ["EX0C", "EY0C", "EX0B", "EZ0B"]);
        assert!(known("w X' b Y Z C A t").is_empty());
    }
}
