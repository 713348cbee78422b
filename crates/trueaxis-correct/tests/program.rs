//! Laws of compensated programs on a machine without errors: nothing to correct, nothing that is missed.

use trueaxis_correct::compensate::program::{ProgramOptions, Rewritten, compensate_program};
use trueaxis_machine::Machine;
use trueaxis_machine::file::NoTables;
use trueaxis_motion::SetUp;
use trueaxis_nc::{Control, Program};

/// Of a program on a machine without errors whose table turns and whose head tilts.
fn compensated(name: &str, text: &str, control: Control) -> Rewritten {
    let text_of_machine =
        "machine = { name = 'm', chain = \"w C' b X Y Z B t\" }\n[tool]\nlength = '100 mm'";
    let (machine, problems) = Machine::check("m.toml", text_of_machine, &NoTables);
    let machine = machine.unwrap_or_else(|| panic!("{problems:?}"));
    let program = Program::new(name, text.as_bytes().to_vec(), control);
    let options = ProgramOptions::default();
    let (done, problems) = compensate_program(&machine, &program, &SetUp::default(), &options);
    done.unwrap_or_else(|| panic!("{problems:?}"))
}

/// The tool axis swings by 15° on a great circle while the tip goes straight, as under ORIVECT: one block leads
/// the control there, and it needs no further points.
#[test]
fn law_a_swing_needs_no_further_points() {
    let text = "G17 G710 G90 G94 F500\nG0 X100 Y100 Z150 B5 C0\nTRAORI\nORIWKS ORIVECT\n\
                G1 X12 Y1 Z120 A3=0.1 B3=0 C3=1\nX30 Y10 Z110 A3=0.3 B3=0.2 C3=1\nTRAFOOF\nM30\n";
    let found = compensated("swing.mpf", text, Control::Sinumerik840d).found;
    assert!(found.blocks >= 2, "{} blocks", found.blocks);
    assert_eq!((found.split, found.pieces), (0, found.blocks));
}

/// The table turns by 40° under a tip that is r = 180 to 220 mm from its axis: between places θ = 0.6° apart the way
/// bends by rθ²/8 = 2.5 to 3 µm, and along the bend the tip misses no more than the share θ/2 of it, 0.016 µm.
#[test]
fn law_a_bent_way_is_not_missed() {
    let text = "G21 G90 G94 F500\nG0 X200 Y0 Z-30 B10 C0\nG1 X201\nG1 C40 F1000\nM2\n";
    let proof = compensated("turn.ngc", text, Control::LinuxCnc).proof;
    assert!(proof.compared >= 2, "{} places", proof.compared);
    for residual in [proof.before, proof.after] {
        assert!(residual.tip.value < 1e-4, "{residual:?}");
    }
}
