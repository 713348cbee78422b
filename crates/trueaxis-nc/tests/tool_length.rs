//! Tool lengths and work offsets: what moves, and what is not stated.

use trueaxis_nc::Control::{self, Fanuc, Haas, LinuxCnc, Sinumerik840d};
use trueaxis_nc::moves::{Axis, Frame, Position};
use trueaxis_nc::{Event, NoLibrary, Program, Settings, Step, interpret};

fn length(mm: f64) -> Position {
    let mut length = Position::default();
    length[Axis::Z] = mm;
    length
}

/// Where the Z axis goes, move by move, and the codes of what was said.
fn run(text: &str, control: Control, settings: &Settings) -> (Vec<f64>, Vec<&'static str>) {
    let program = Program::new("p", text.as_bytes().to_vec(), control);
    let (mut places, mut on) = (Vec::new(), 0.0);
    let outcome = interpret(&program, &NoLibrary, settings, &mut |step| match step {
        Step::Event(event, _) => {
            if let Event::ToolLength(length) = event {
                on = length[Axis::Z];
            }
        }
        Step::Move(m) => places.push(m.target[Axis::Z] + on),
    });
    (places, outcome.problems.iter().map(|d| d.code).collect())
}

fn tools() -> Settings {
    let mut settings = Settings::default();
    settings.tools.insert(1, length(100.0));
    settings.tools.insert(2, length(-4.0));
    settings
}

/// G43 adds the length to the end point of its block, whether Z is absolute or incremental (LS Electric XGT series manual).
/// LinuxCNC recalculates its position instead.
#[test]
fn law_an_incremental_end_point_is_longer_by_the_tool() {
    let fanuc = |text: &str| run(text, Fanuc, &tools()).0;
    // With H of −4 mm Z−32 goes to −36, and 32 mm with H0 back to where it was.
    assert_eq!(fanuc("G91\nG43 Z-32. H2\nG0 Z32. H0\nM30\n"), [-36.0, 0.0]);
    let in_one_block = [
        "G0 Z300.\nG91 G43 H1 Z50.\nZ-10.\nG49 Z20.\nM30\n",
        "G0 Z300.\nG91\nG43 X1. Z50. H1\nX1. Z-10.\nX2. G49 Z20.\nM30\n",
        "G0 Z300.\nG91 H1 G43 Z25.\nZ25.\nG90 Z340.\nG91 G49 Z20.\nM30\n",
    ];
    for text in in_one_block {
        let (heights, codes) = run(text, Fanuc, &tools());
        assert!(heights.contains(&450.0) && heights.last() == Some(&360.0), "{text}{heights:?}");
        assert!(codes.is_empty(), "{codes:?}");
    }
    // In a later block it counts from where the axis stands, and that is said; not where G90 comes first.
    let (heights, codes) = run("G0 Z300.\nG43 H1\nX1.\nG91 X1.\nZ50.\nZ1.\nM30\n", Fanuc, &tools());
    assert_eq!(heights, [300.0, 300.0, 300.0, 350.0, 351.0]);
    assert_eq!(codes, ["incremental-after-length"]);
    let (heights, codes) = run("G0 Z300.\nG43 H1\nG90 Z50.\nG91 Z1.\nM30\n", Fanuc, &tools());
    assert_eq!((heights, codes), (vec![300.0, 150.0, 151.0], vec![]));
    assert_eq!(run("G0 Z300.\nG91 G43 H1 Z50.\nM30\n", Haas, &tools()).0, [300.0, 450.0]);
    assert_eq!(run("G0 Z300\nG91 G43 H1 Z50\nM2\n", LinuxCnc, &tools()).0, [300.0, 350.0]);
    // Absolute words, G53 and reference points owe nothing to a length.
    assert_eq!(fanuc("G0 Z300.\nG43 H1 Z50.\nG91 Z-10.\nM30\n"), [300.0, 150.0, 140.0]);
    assert_eq!(fanuc("G0 Z300.\nG43 H1\nG53 Z0.\nG91 Z-10.\nM30\n"), [300.0, 0.0, -10.0]);
    assert_eq!(fanuc("G0 Z300.\nG43 H1\nG91 G28 Z0.\nZ-10.\nM30\n"), [300.0, 300.0, 0.0, -10.0]);
    let drilled = fanuc("G0 Z300.\nG43 H1\nG81 X1. Z10. R20. F100\nG80\nG91 G0 Z-1.\nM30\n");
    assert_eq!(drilled.last(), Some(&(drilled[drilled.len() - 2] - 1.0)), "{drilled:?}");
}

/// Without H the last one holds; where there was none, H0: no length. The number of the tool is not taken for it.
#[test]
fn a_length_without_its_number_is_none() {
    let (heights, codes) = run("T1 M6\nG43 Z50.\nM30\n", Fanuc, &tools());
    assert_eq!((heights, codes), (vec![50.0], vec!["no-length-number"]));
    let (heights, codes) = run("T1 M6\nG43 H1 Z50.\nG49\nG43 Z60.\nM30\n", Fanuc, &tools());
    assert_eq!((heights, codes), (vec![150.0, 160.0], vec![]));
    assert_eq!(run("T1 M6\nG43 G0 Z50\nM2\n", LinuxCnc, &tools()).0, [150.0]);
    assert_eq!(run("G49 G0 Z5.\nM30\n", Fanuc, &tools()).1, Vec::<&str>::new());
}

/// A work offset that is missing among those of a set-up is said; not where the program sets it, nor without a set-up.
#[test]
fn a_work_offset_that_is_not_stated_is_named() {
    let mut settings = tools();
    let at = |mm: f64| Frame { shift: length(mm), ..Frame::IDENTITY };
    settings.work_offsets.insert(1, at(-300.0));
    let said = |text: &str, control: Control, settings: &Settings| {
        run(text, control, settings).1.contains(&"unknown-work-offset")
    };
    for (text, control) in [
        ("G55\nG0 Z1.\nM30\n", Fanuc),
        ("G54.1 P7\nG0 Z1.\nM30\n", Fanuc),
        ("G59.2\nG0 Z1\nM2\n", LinuxCnc),
        ("G55\nG0 Z1\nM30\n", Sinumerik840d),
        ("G507\nG0 Z1\nM30\n", Sinumerik840d),
        ("BEGIN PGM P MM\nCYCL DEF 247 Q339=+2\nL Z+1 FMAX\nEND PGM P MM\n", Control::Heidenhain),
    ] {
        assert!(said(text, control, &settings), "{text}");
        assert!(!said(text, control, &Settings::default()), "{text}");
    }
    for (text, control) in [
        ("G54\nG0 Z1.\nM30\n", Fanuc),
        ("G10 L2 P2 Z-5.\nG55\nG0 Z1.\nM30\n", Fanuc),
        ("G10 L2 P2 Z-5\nG55\nG0 Z1\nM2\n", LinuxCnc),
        ("G54\nG0 Z1\nG500\nM30\n", Sinumerik840d),
        ("$P_UIFR[2]=CTRANS(Z,-5)\nG55\nG0 Z1\nM30\n", Sinumerik840d),
    ] {
        assert!(!said(text, control, &settings), "{text}");
    }
    // The offset that is active at first is one of those that may be missing.
    settings.work_offsets.clear();
    settings.work_offsets.insert(2, at(-300.0));
    assert!(said("G54\nG0 Z1.\nM30\n", Fanuc, &settings));
}
