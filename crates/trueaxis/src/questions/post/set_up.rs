//! The set-up of a test piece before it is cut: three paths and a file of readings.
//!
//! Wu et al. 2022, Fig 17: a) the tool inclined, a dial shows its length; b) a dial in the holder shows the centre of the
//! blank; c) a reference hole. The tool stands along the axis of the piece, which is inclined on the machine.

use std::f64::consts::PI;
use std::fmt::Write;
use trueaxis_part::{SetUp, Shape, TestPieceFile};

/// Where the tool stops above the top face, mm.
const ABOVE_MM: f64 = 100.0;
/// Clearance above the hole, mm.
const CLEAR_MM: f64 = 5.0;

/// The file of readings.
pub const READINGS: &str = "set-up.toml";

/// The paths of the set-up as APT files in the workpiece frame, by the names of their programs.
pub fn locations(piece: &TestPieceFile, set_up: &SetUp) -> [(&'static str, String); 3] {
    let Shape::Cone(cone) = &piece.shape;
    let head = |what: &str| {
        format!(
            "PARTNO/SET-UP, {what}\nUNITS/MM\nMULTAX/ON\nCUTTER/{}\nLOADTL/1\n",
            cone.size().tool_diameter_mm
        )
    };
    let go = |z_mm: f64| format!("GOTO/0.,0.,{z_mm:.9},0.,0.,1.\n");
    let stop = |what: &str| {
        // A way on after the stop: the tool must stand there, and not at the end of the program.
        let (there, on) = (go(ABOVE_MM), go(ABOVE_MM + CLEAR_MM));
        format!("{}PPRINT/{what}\nRAPID\n{there}STOP\nRAPID\n{on}FINI\n", head(what))
    };
    let mut hole = head("REFERENCE HOLE");
    let _ = writeln!(hole, "SPINDL/{},RPM,CLW", set_up.spindle_per_min);
    hole += &format!("RAPID\n{}RAPID\n{}", go(ABOVE_MM), go(CLEAR_MM));
    let _ = writeln!(hole, "FEDRAT/{},MMPM", set_up.feed_mm_per_min);
    hole += &go(-set_up.hole_depth_mm);
    hole += &format!("{}RAPID\n{}SPINDL/OFF\nFINI\n", go(CLEAR_MM), go(ABOVE_MM));
    [
        ("1-length", stop("LENGTH OF THE TOOL")),
        ("2-centre", stop("CENTRE OF THE BLANK")),
        ("3-hole", hole),
    ]
}

/// The file of readings, to be filled in.
pub fn readings(piece: &TestPieceFile) -> String {
    let inclination = piece.mounting.map_or(0.0, |m| m.inclination_rad) * 180.0 / PI;
    let Shape::Cone(cone) = &piece.shape;
    format!(
        r#"# Readings of the set-up of {name}.
# Fill in what is empty and name this file in the study: set_up = "{READINGS}". It is never overwritten.

# Program 1-length: the tool is inclined; a dial stands upright under it. Move the linear axes until the dial turns back
# on the face of the spindle, then on the end of the tool, and write Z of the machine where it shows the same.
[length]
entered = ""              # length of the tool in the control: "100 mm"
inclination = "{inclination} deg"
face = []                 # ["-512.404 mm", "-512.405 mm"]: once or more
face_radius = ""          # where the face was touched, from the axis of the spindle: "30 mm"
tip = []                  # the same on the end of the tool
tip_radius = "{radius} mm"
u = ""                    # standard uncertainty of one reading, the dial with it: "2 um"

# Program 2-centre: the dial in the holder, turned by hand round the outer circle; plunger in is positive.
[centre]
dial = []                 # at 0, 90, 180 and 270 deg (+x, +y, −x, −y of the workpiece): ["0 um", "3 um", "1 um", "-2 um"]
u = ""                    # "1 um"
"#,
        name = piece.name,
        radius = 0.5 * cone.size().tool_diameter_mm,
    )
}
