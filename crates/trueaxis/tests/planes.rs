//! Planes that only the machine knows: PLANE AXIAL and TOROT. Z is along the tool as it stands.

use proptest::prelude::*;
use trueaxis::geometry::Vec3;
use trueaxis::machine::Machine;
use trueaxis::machine::file::NoTables;
use trueaxis::nc::moves::Step;
use trueaxis::nc::{Control, Program};
use trueaxis::simulate::{Batch, Densify, Observer, Options, SetUp, simulate};

const HEAD: &str = "[machine]\nname = \"head\"\nchain = \"w b X Y Z C A t\"\n\
                    [axis.C]\ntravel = \"unlimited\"\n[tool]\nlength = \"100 mm\"\n";
const TABLE: &str = "[machine]\nname = \"table\"\nchain = \"w C' A' b X Y Z t\"\n\
                     [axis.C]\ntravel = \"unlimited\"\n[tool]\nlength = \"100 mm\"\n";

/// Line, axis positions, tip and tool axis in the workpiece at each end of a move.
#[derive(Default)]
struct Ends(Vec<(u32, [f64; 6], Vec3, Vec3)>);

impl Observer for Ends {
    fn step(&mut self, _step: &Step) {}

    fn path(&mut self, batch: &Batch<'_>) {
        for (i, node) in batch.nodes.iter().enumerate() {
            let pose = batch.deviation(i);
            let (tip, axis) = (pose.nominal_tip.vector(), pose.nominal_axis.vector());
            self.0.push((node.origin.line, node.command, tip, axis));
        }
    }
}

impl Ends {
    fn of(machine: &Machine, control: Control, text: &str) -> Self {
        let program = Program::new("program", text.as_bytes().to_vec(), control);
        let options = Options { densify: Densify::Off, ..Options::default() };
        let setup = SetUp { given: true, ..SetUp::default() };
        let mut ends = Self::default();
        let run = simulate(machine, &program, &setup, &options, &mut [&mut ends]);
        let known = ["assumed-limits", "assumed-tool-length"];
        let other: Vec<_> = run.problems.iter().filter(|p| !known.contains(&p.code)).collect();
        assert!(other.is_empty(), "{text}\n{other:?}");
        ends
    }

    /// The state at the end of a line.
    fn at(&self, line: u32) -> &(u32, [f64; 6], Vec3, Vec3) {
        self.0.iter().rfind(|e| e.0 <= line).unwrap()
    }
}

/// The axis of a machine by its letter.
fn axis(machine: &Machine, letter: char) -> usize {
    machine.axes().iter().position(|a| a.name.letter() == letter).unwrap()
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn law_plane_axial_stands_at_its_angles(a in 5.0..80.0_f64, c in -170.0..170.0_f64, table in any::<bool>()) {
        let machine = Machine::check("m", if table { TABLE } else { HEAD }, &NoTables).0.unwrap();
        let text = format!(
            "BEGIN PGM p MM\nPLANE AXIAL A{a:+.4} C{c:+.4} TURN FMAX\nL X+1 Y+2 Z+3 FMAX\nL IX+10 FMAX\nL IZ+10 FMAX\nEND PGM p MM\n",
        );
        let ends = Ends::of(&machine, Control::Heidenhain, &text);
        let (at, after_x, after_z) = (ends.at(3), ends.at(4), ends.at(5));
        prop_assert!((at.1[axis(&machine, 'A')].to_degrees() - a).abs() < 1e-3);
        prop_assert!((at.1[axis(&machine, 'C')].to_degrees() - c).abs() < 1e-3);
        prop_assert!((after_z.2 - after_x.2 - after_x.3 * 10.0).norm() < 1e-6);
        prop_assert!((after_x.2 - at.2).dot(&at.3).abs() < 1e-6);
        if table {
            // The plane is turned as the table is: X of the plane is X of the machine.
            let x = axis(&machine, 'X');
            for (i, (to, from)) in after_x.1.iter().zip(&at.1).enumerate() {
                let by = if i == x { 10.0 } else { 0.0 };
                prop_assert!((to - from - by).abs() < 1e-6, "{:?}", after_x);
            }
        }
    }

    #[test]
    fn law_torot_puts_z_along_the_tool(a in -80.0..80.0_f64, c in -170.0..170.0_f64, table in any::<bool>()) {
        let machine = Machine::check("m", if table { TABLE } else { HEAD }, &NoTables).0.unwrap();
        let text = format!(
            "TRAORI\nG0 G90 A{a:.4} C{c:.4} X1 Y2 Z3\nTOROT\nG91 Z10\nX10\nTOROTOF\nZ10\nM30\n",
        );
        let ends = Ends::of(&machine, Control::Sinumerik840d, &text);
        let [before, z, x, off] = [ends.at(2), ends.at(4), ends.at(5), ends.at(7)];
        prop_assert!((z.2 - before.2 - before.3 * 10.0).norm() < 1e-6);
        prop_assert!((x.2 - z.2).dot(&z.3).abs() < 1e-6);
        // X of the frame lies in the plane of X and Z before; the basic frame is that of the workpiece.
        prop_assert!((x.2 - z.2).y.abs() < 1e-6);
        prop_assert!((off.2 - x.2 - Vec3::new(0.0, 0.0, 10.0)).norm() < 1e-6);
    }

    /// On a swivelled plane without tool-centre point rotary words turn the rotary axes alone: the linear axes stand. What comes
    /// after counts in the plane as it lies then: words are places, increments count from where the tool stands.
    #[test]
    fn law_rotary_axes_turn_alone_on_a_swivelled_plane(a in 5.0..60.0_f64, c in -90.0..90.0_f64, table in any::<bool>()) {
        let machine = Machine::check("m", if table { TABLE } else { HEAD }, &NoTables).0.unwrap();
        let programs = [
            (Control::Heidenhain, format!(
                "BEGIN PGM p MM\nL X+7 Y-60 Z+50 FMAX\nPLANE SPATIAL SPA+20 SPB+10 SPC+45 STAY\nL A{a:+.4} C{c:+.4} R0 FMAX\nL IX+10 FMAX\n\
                 L X+1 Y+2 Z+3 FMAX\nL A+0 FMAX\nL IX+10 FMAX\nEND PGM p MM\n")),
            (Control::Fanuc, format!(
                "G90 G21\nG0 X7. Y-60. Z50.\nG68.2 X0 Y0 Z0 I45. J20. K10.\nG0 A{a:.4} C{c:.4}\nG91 X10.\n\
                 G90 X1. Y2. Z3.\nA0.\nG91 X10.\nM30\n")),
            (Control::Sinumerik840d, format!(
                "G90 G710\nG0 X7 Y-60 Z50\nCYCLE800(0,\"\",0,57,0,0,0,20,10,45,0,0,0,0)\nG0 A{a:.4} C{c:.4}\nG91 X10\n\
                 G90 X1 Y2 Z3\nA0\nG91 X10\nM30\n")),
        ];
        for (control, text) in programs {
            let ends = Ends::of(&machine, control, &text);
            let linear = |line: u32| ['X', 'Y', 'Z'].map(|letter| ends.at(line).1[axis(&machine, letter)]);
            let apart = |a: [f64; 3], b: [f64; 3]| (0..3).map(|i| (a[i] - b[i]).abs()).fold(0.0, f64::max);
            prop_assert!(apart(linear(4), linear(2)) < 1e-9, "{text}{:?}", ends.0);
            prop_assert!((ends.at(4).1[axis(&machine, 'A')].to_degrees() - a).abs() < 1e-3);
            prop_assert!(apart(linear(7), linear(6)) < 1e-9, "{text}{:?}", ends.0);
            // One axis of the plane moves, by its increment.
            for (line, before) in [(5, 4), (8, 7)] {
                let by = ends.at(line).2 - ends.at(before).2;
                prop_assert!((by.norm() - 10.0).abs() < 1e-6, "{text}{:?}", ends.0);
            }
            prop_assert!((ends.at(8).2 - ends.at(7).2 - (ends.at(5).2 - ends.at(4).2)).norm() < 1e-6);
        }
    }
}
