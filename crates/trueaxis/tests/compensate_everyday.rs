//! What stands in the programs of every day is compensated and proved: cycles from above their clearance and under a modal
//! feed, retractions in swivels, rotary axes across 0° by the shortest way.

mod library;

use library::{bare, machine};
use trueaxis::compensate::program::{ProgramOptions, Rewritten, compensate_program};
use trueaxis::geometry::Vec3;
use trueaxis::machine::Machine;
use trueaxis::nc::Control::{self, Heidenhain, Sinumerik840d};
use trueaxis::nc::Program;
use trueaxis::simulate::{SetUp, SetUpTool};

fn written(machine: &Machine, control: Control, text: &str) -> Rewritten {
    let tool = SetUpTool { tip_mm: Vec3::new(0.0, 0.0, -50.0), ..SetUpTool::default() };
    let setup = SetUp { given: true, tools: [(1, tool)].into(), ..SetUp::default() };
    let program = Program::new("p", text.as_bytes().to_vec(), control);
    let (written, problems) =
        compensate_program(machine, &program, &setup, &ProgramOptions::default());
    written.unwrap_or_else(|| panic!("{problems:?}\n{text}"))
}

/// With the errors of the machine every place is met; without them no number changes.
fn proved(name: &str, control: Control, text: &str) {
    let found = written(&machine(name), control, text);
    let shown = String::from_utf8_lossy(&found.text);
    let after = found.proof.after;
    assert!(found.proof.compared > 0 && after.tip_end.value < 1.5e-3, "{after:?}\n{shown}");
    assert!(after.tip.value < 1.5e-3, "{after:?}\n{shown}");
    let found = written(&bare(name), control, text);
    let after = found.proof.after;
    assert!(after.tip.value < 1e-9 && after.tip_end.value < 1e-9, "{after:?}");
}

/// Whatever the height from which it is called and the feed that is modal, a cycle is written move by move, and proved.
#[test]
fn law_cycles_begin_from_any_height_under_any_feed() {
    for feed in ["", " F200", " F777"] {
        for cycle in [
            "CYCL DEF 200 DRILLING Q200=2 Q201=-10 Q206=200 Q202=10 Q210=0 Q203=-200 Q204=50 Q211=0",
            "CYCL DEF 200 DRILLING Q200=2 Q201=-9 Q206=150 Q202=4 Q210=0 Q203=-200 Q204=20 Q211=0.5",
            "CYCL DEF 203 UNIVERSAL DRILLING Q200=2 Q201=-9 Q206=150 Q202=4 Q210=0 Q203=-200 Q204=20 Q212=0 Q213=0 Q205=0 Q211=0 Q208=500 Q256=0.2",
        ] {
            for height in [-60, -150, -198] {
                let text = format!(
                    "BEGIN PGM P MM\nTOOL CALL 1 Z S1000{feed}\nL Z{height} R0 FMAX M3\nL X+0 Y+0 R0 FMAX\n{cycle}\n\
                     L X+10 R0 FMAX M99\nL X+60 Y-30 R0 FMAX M99\nL Z-60 R0 FMAX\nL X+50 F300\nL X+55\nM30\nEND PGM P MM\n"
                );
                proved("three-axis-mill", Heidenhain, &text);
            }
        }
    }
}

/// The positions of MCALL under G0 and under G1.
#[test]
fn law_positions_of_a_modal_cycle_have_any_motion_code() {
    for code in ["G0", "G1"] {
        let text = format!(
            "G40 G17 G710 G94 G90\nT1 M6\nD1 S1000 M3\nG0 X0 Y0 Z-60\nG1 Z-80 F200\n{code} X1\n\
             MCALL CYCLE81(-100,-198,2,-210)\nX0 Y0\nX10 Y0\nN70 X10 Y20\nMCALL\nX30 Y5\nG1 X40\nM30\n"
        );
        proved("three-axis-mill", Sinumerik840d, &text);
    }
}

/// PLANE with and without MB, by TURN and MOVE, and M140 before a cut.
#[test]
fn law_a_retraction_of_a_swivel_stays() {
    for turn in ["TURN MB50", "TURN", "MOVE DIST20", "TURN MB 5"] {
        let text = format!(
            "BEGIN PGM P MM\nTOOL CALL 1 Z S1000 F1000\nL Z-20 R0 FMAX M3\nPLANE SPATIAL SPA+0 SPB+20 SPC+45 {turn} F2000 \
             SEQ- TABLE ROT\nL X+0 Y+0 R0 FMAX\nL Z-40 F500\nL X+10\nL M140 MB 20 FMAX\nL Y+10 FMAX\nL Z-39 F500\nL X+3\n\
             PLANE RESET STAY\nM30\nEND PGM P MM\n"
        );
        proved("i5-engraver", Heidenhain, &text);
    }
}

/// 350° and 10°, 10° and 350°, with angles below 0°.
#[test]
fn law_rotary_axes_pass_zero_by_the_shortest_way() {
    for (from, to) in [("+350", "+10"), ("+10", "+350"), ("-10", "+10"), ("+350", "-350")] {
        let text = format!(
            "BEGIN PGM P MM\nTOOL CALL 1 Z S1000\nL M126\nFUNCTION TCPM F TCP AXIS POS PATHCTRL AXIS\n\
             L X+10 Y+10 Z+40 A-30 C{from} R0 FMAX\nL X+12 Y+12 Z+30 A-25 C{to} F800\nL C{from} X+14\n\
             FUNCTION RESET TCPM\nM30\nEND PGM P MM\n"
        );
        proved("i5-engraver", Heidenhain, &text);
    }
}
