//! Where a cut begins, however the tool is led to it.

mod library;

use library::{bare, machine};
use trueaxis::compensate::program::{ProgramOptions, compensate_program};
use trueaxis::geometry::Vec3;
use trueaxis::machine::Machine;
use trueaxis::nc::{Control, Program};
use trueaxis::simulate::{Batch, Densify, Observer, Options, SetUp, simulate};

/// The actual tips from the place on where the first cut begins.
#[derive(Default)]
struct FromBegin {
    before: Option<Vec3>,
    tips: Vec<Vec3>,
}

impl Observer for FromBegin {
    fn path(&mut self, batch: &Batch<'_>) {
        for (i, node) in batch.nodes.iter().enumerate() {
            let pose = batch.deviation(i);
            let tip = pose.nominal_tip.vector() + pose.tip_mm;
            if node.is_rapid() {
                self.before = Some(tip).filter(|_| self.tips.is_empty());
            } else if node.dwell_s == 0.0 {
                self.tips.extend(self.before.take());
                self.tips.push(tip);
            }
        }
    }
}

fn tips(machine: &Machine, text: &[u8], control: Control) -> Vec<Vec3> {
    let program = Program::new("p", text.to_vec(), control);
    let densify = Densify::Places { chord_mm: 1e-6, angle_rad: 0.01, spacing_mm: 1e9, least: 40 };
    let mut found = FromBegin::default();
    let options = Options { densify, ..Options::default() };
    let run = simulate(machine, &program, &SetUp::default(), &options, &mut [&mut found]);
    assert!(!run.problems.has_errors(), "{:?}", run.problems);
    found.tips
}

fn off(tip: &Vec3, path: &[Vec3]) -> f64 {
    let each = path.windows(2).map(|w| {
        let way = w[1] - w[0];
        let u = (tip - w[0]).dot(&way) / way.norm_squared().max(1e-12);
        (tip - w[0] - way * u.clamp(0.0, 1.0)).norm()
    });
    each.fold(f64::INFINITY, f64::min)
}

/// Words of rapids that hold where a cut begins are those of that place: in one block or in several, in any order, by
/// increments and by vectors, with the length of the tool switched on between them. The tip begins its cut where the program
/// says, and stays on the cut, within the residual.
#[test]
fn law_a_cut_begins_where_it_should_however_it_is_approached() {
    let mill = [
        "G0 X150. Y100. Z-398.\n",
        "G0 X150. Y100.\nZ-398.\n",
        "G0 Z-398.\nX150. Y100.\n",
        "G0 X150.\nY100.\nZ-60.\nZ-398.\n",
        "G0 X10. Y10. Z-10.\nG91 X140. Y90.\nZ-388.\nG90\n",
        "G0 X150. Y-20.\nZ-50.\nX150. Y100.\nZ-390.\nG1 Z-398. F300.\n",
        "G28 G91 Z0\nG90 G0 X150. Y100.\nM8\nZ-398.\n",
    ]
    .map(|approach| ("three-axis-mill", Control::Fanuc, "G21 G17 G90 G94\n", approach));
    let table = [
        "G0 X10. Y10. Z40. A-30. C45.\n",
        "G0 X10. Y10. A-30. C45.\nG0 Z40.\n",
        "G0 A-30. C45.\nX10. Y10.\nZ60.\nZ40.\n",
        "G0 C45.\nX10.\nA-30. Z60.\nY10.\nZ40.\n",
        "G0 X10. Y10. A-30. C45.\nG91 Z-5.\nZ-10.\nG90 Z40.\n",
    ]
    .map(|approach| ("i5-engraver", Control::Fanuc, "G21 G90 G94\nG43.4 H1\nG0 Z60.\n", approach));
    let other = [
        (Control::Sinumerik840d, "G710 G90 G94\nTRAORI\nG0 Z60\n", "G0 X10 Y10 A-30 C45\nZ40\n"),
        (
            Control::Sinumerik840d,
            "G710 G90 G94\nTRAORI\nG0 Z60\n",
            "G0 X10 Y10 A3=0.3535534 B3=0.3535534 C3=0.8660254\nZ40\n",
        ),
        (
            Control::Heidenhain,
            "BEGIN PGM A MM\nTOOL CALL 1 Z S1000\nM128\nL Z+60 R0 FMAX\n",
            "L X+10 Y+10 A-30 C+45 FMAX\nL Z+40 FMAX\n",
        ),
    ]
    .map(|(control, start, approach)| ("i5-engraver", control, start, approach));
    for (name, control, start, approach) in mill.into_iter().chain(table).chain(other) {
        let cut = match (name, control) {
            ("three-axis-mill", _) => "G1 X200. Y101. Z-390. F500.\nX220.\nM30\n",
            (_, Control::Fanuc) => "G1 X12. Y12. Z30. F800.\nX14. Y16. A-25. C50.\nG49\nM30\n",
            (_, Control::Heidenhain) => {
                "L X+12 Y+12 Z+30 F800\nL X+14 Y+16 A-25 C+50\nM129\nM30\nEND PGM A MM\n"
            }
            _ => "G1 X12 Y12 Z30 F800\nX14 Y16 A-25 C50\nTRAFOOF\nM30\n",
        };
        let (actual, text) = (machine(name), format!("{start}{approach}{cut}"));
        let wanted = tips(&bare(name), text.as_bytes(), control);
        let program = Program::new("p", text.as_bytes().to_vec(), control);
        let options = ProgramOptions::default();
        let (written, problems) =
            compensate_program(&actual, &program, &SetUp::default(), &options);
        let written = written.unwrap_or_else(|| panic!("{problems:?}\n{text}"));
        let found = tips(&actual, &written.text, control);
        let shown = String::from_utf8_lossy(&written.text);
        let begins = (found[0] - wanted[0]).norm();
        // Three decimals are 0.87 µm in space.
        assert!(begins < 1.2e-3, "{control:?} begins {begins} mm off\n{shown}");
        for tip in &found {
            let by = off(tip, &wanted);
            assert!(by < 1.5e-3, "{control:?} leaves its way by {by} mm\n{shown}");
        }
        let before = tips(&actual, text.as_bytes(), control);
        assert!((before[0] - wanted[0]).norm() > 3e-3, "the machine has no errors there");
        assert!(written.proof.after.tip.value < 1.5e-3, "{:?}", written.proof.after);
    }
}
