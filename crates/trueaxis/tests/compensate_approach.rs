//! Where a cut begins, however the tool is led to it.

mod library;

use library::{bare, machine};
use trueaxis::compensate::program::{ProgramOptions, compensate_program};
use trueaxis::geometry::Vec3;
use trueaxis::machine::Machine;
use trueaxis::nc::{Control, Program};
use trueaxis::simulate::{Batch, Densify, Observer, Options, SetUp, simulate};

/// The actual tips of the cuts, and where they begin after rapids.
#[derive(Default)]
struct FromBegin {
    before: Option<Vec3>,
    begins: Vec<Vec3>,
    tips: Vec<Vec3>,
}

impl Observer for FromBegin {
    fn path(&mut self, batch: &Batch<'_>) {
        for (i, node) in batch.nodes.iter().enumerate() {
            let pose = batch.deviation(i);
            let tip = pose.nominal_tip.vector() + pose.tip_mm;
            if node.is_rapid() {
                self.before = Some(tip);
            } else if node.dwell_s == 0.0 {
                let begin = self.before.take();
                self.begins.extend(begin);
                self.tips.extend(begin);
                self.tips.push(tip);
            }
        }
    }
}

fn cuts(machine: &Machine, text: &[u8], control: Control) -> FromBegin {
    let program = Program::new("p", text.to_vec(), control);
    let densify = Densify::Places { chord_mm: 1e-6, angle_rad: 0.01, spacing_mm: 1e9, least: 40 };
    let mut found = FromBegin::default();
    let options = Options { densify, ..Options::default() };
    let run = simulate(machine, &program, &SetUp::default(), &options, &mut [&mut found]);
    assert!(!run.problems.has_errors(), "{:?}", run.problems);
    found
}

fn off(tip: &Vec3, path: &[Vec3]) -> f64 {
    let each = path.windows(2).map(|w| {
        let way = w[1] - w[0];
        let u = (tip - w[0]).dot(&way) / way.norm_squared().max(1e-12);
        (tip - w[0] - way * u.clamp(0.0, 1.0)).norm()
    });
    each.fold(f64::INFINITY, f64::min)
}

/// The tip begins its cut where the program says, and stays on the cut, within the residual.
fn begins(name: &str, control: Control, text: &str) {
    let actual = machine(name);
    let wanted = cuts(&bare(name), text.as_bytes(), control);
    let program = Program::new("p", text.as_bytes().to_vec(), control);
    let options = ProgramOptions::default();
    let (written, problems) = compensate_program(&actual, &program, &SetUp::default(), &options);
    let written = written.unwrap_or_else(|| panic!("{problems:?}\n{text}"));
    let found = cuts(&actual, &written.text, control);
    let shown = String::from_utf8_lossy(&written.text);
    assert!(!found.begins.is_empty() && found.begins.len() == wanted.begins.len());
    for (found, wanted) in found.begins.iter().zip(&wanted.begins) {
        let begins = (found - wanted).norm();
        // Three decimals are 0.87 µm in space.
        assert!(begins < 1.2e-3, "{control:?} begins {begins} mm off\n{shown}");
    }
    for tip in &found.tips {
        let by = off(tip, &wanted.tips);
        assert!(by < 1.9e-3, "{control:?} leaves its way by {by} mm\n{shown}");
    }
    let before = cuts(&actual, text.as_bytes(), control);
    assert!((before.begins[0] - wanted.begins[0]).norm() > 3e-3, "the machine has no errors there");
    assert!(written.proof.after.tip.value < 1.5e-3, "{:?}", written.proof.after);
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
        begins(name, control, &format!("{start}{approach}{cut}"));
    }
}

/// Frames that begin or end between the rapids and the cut: the words of each block are those of its own frame.
#[test]
fn law_a_cut_begins_where_it_should_across_changes_of_the_frame() {
    let mill = "G21 G17 G90 G94\n";
    let table = "G21 G17 G90 G94\nG0 Z60.\n";
    let flat = "G1 X200. Y101. Z-390. F500.\nX220.\nM30\n";
    let tilted = "G1 X12. Y12. Z30. F800.\nX14. Y16.\nG69\nM30\n";
    let fanuc = [
        ("three-axis-mill", mill, "G0 G52 X5. Y2.\nX145. Y98.\nG52 X0 Y0\nZ-398.\n", flat),
        ("three-axis-mill", mill, "G0 X150. Y100.\nG52 X5. Y2. Z3.\nZ-398.\n", flat),
        (
            "three-axis-mill",
            mill,
            "G0 X150. Y100.\nG52 X5. Y2. Z3.\nZ-90.\nG52 X0 Y0 Z0\nZ-398.\n",
            flat,
        ),
        ("three-axis-mill", mill, "G68 X0 Y0 R5.\nG0 X150. Y90.\nZ-398.\n", flat),
        ("three-axis-mill", mill, "G0 X150. Y100.\nG68 X0 Y0 R5.\nZ-398.\n", flat),
        ("three-axis-mill", mill, "G68 X0 Y0 R5.\nG0 X150. Y90.\nG69\nZ-398.\n", flat),
        ("i5-engraver", table, "G68.2 X0 Y0 Z0 I0 J-30. K0\nG53.1\nG0 X10. Y10.\nZ40.\n", tilted),
        (
            "i5-engraver",
            table,
            "G68.2 X1. Y2. Z3. I45. J-30. K0\nG53.1\nG0 X10. Y10. Z40.\n",
            tilted,
        ),
        (
            "i5-engraver",
            table,
            "G0 X10. Y10.\nG68.2 X0 Y0 Z0 I45. J-30. K0\nG53.1\nG0 X10. Y10.\nZ40.\n",
            tilted,
        ),
        (
            "i5-engraver",
            table,
            "G0 A-30. C45.\nG68.2 X0 Y0 Z0 I45. J-30. K0\nG0 X10. Y10.\nG53.1\nZ40.\n",
            tilted,
        ),
        (
            "i5-engraver",
            table,
            "G68.2 X0 Y0 Z0 I45. J-30. K0\nG53.1\nG0 X10. Y10.\nG52 X1. Y1. Z1.\nZ40.\n",
            tilted,
        ),
        (
            "i5-engraver",
            table,
            "G68.2 X0 Y0 Z0 I45. J-30. K0\nG53.1\nG0 X10. Y10.\nG69\nZ40.\n",
            tilted,
        ),
    ];
    let fanuc_more = [
        (
            "i5-engraver",
            table,
            "G0 A-30. C45.\nG68.2 X0 Y0 Z0 I45. J-30. K0\nG0 X10. Y10.\nZ40.\n",
            tilted,
        ),
        (
            "i5-engraver",
            table,
            "G68.2 X0 Y0 Z0 I45. J-30. K0\nG0 A-30. C45.\nG0 X10. Y10.\nZ40.\n",
            tilted,
        ),
        (
            "i5-engraver",
            table,
            "G0 X10. Y10. A-30. C45.\nG68.2 X0 Y0 Z0 I45. J-30. K0\nZ40.\n",
            tilted,
        ),
        (
            "i5-engraver",
            table,
            "G0 A-30. C45. X10.\nY10.\nZ40.\n",
            "G1 X12. Y12. Z30. F800.\nX14. Y16.\nM30\n",
        ),
    ];
    for (name, start, approach, cut) in fanuc.into_iter().chain(fanuc_more) {
        begins(name, Control::Fanuc, &format!("{start}{approach}{cut}"));
    }
    let (start, end) = (
        "BEGIN PGM A MM\nTOOL CALL 1 Z S1000\nL Z+60 R0 FMAX\n",
        "L X+12 Y+12 Z+30 F800\nL X+14 Y+16\nM30\nEND PGM A MM\n",
    );
    let plane = "PLANE SPATIAL SPA+20 SPB+10 SPC+45";
    for approach in [
        format!("{plane} TURN FMAX\nL X+10 Y+10 FMAX\nL Z+40 FMAX\n"),
        format!("L X+10 Y+10 FMAX\n{plane} TURN FMAX\nL X+10 FMAX\nL Z+40 FMAX\n"),
        format!("{plane} MOVE DIST0 F9000\nL X+10 Y+10 FMAX\nL Z+40 FMAX\n"),
        format!("L A-20 C+30 FMAX\n{plane} TURN FMAX\nL X+10 Y+10 FMAX\nL Z+40 FMAX\n"),
        format!("{plane} STAY\nL A+Q120 C+Q122 FMAX\nL X+10 Y+10 FMAX\nL Z+40 FMAX\n"),
        format!("{plane} STAY\nL X+10 Y+10 FMAX\nL A+Q120 C+Q122 FMAX\nL X+10 Y+10 FMAX\nL Z+40 FMAX\n"),
        format!("{plane} TURN FMAX\nL X+10 Y+10 FMAX\nTRANS DATUM AXIS X1 Y1\nL Z+40 FMAX\n"),
        format!("{plane} TURN FMAX\nL X+10 Y+10 FMAX\nPLANE RESET STAY\nL Z+40 FMAX\n"),
        format!("{plane} TURN FMAX\nL X+10 Y+10 FMAX\nPLANE RESET TURN FMAX\nL X+10 Y+10 FMAX\nL Z+40 FMAX\n"),
        "CYCL DEF 7.0\nCYCL DEF 7.1 X+5\nL X+10 Y+10 FMAX\nCYCL DEF 7.0\nCYCL DEF 7.1 X+0\nL Z+40 FMAX\n".to_owned(),
        "L X+10 Y+10 FMAX\nCYCL DEF 10.0\nCYCL DEF 10.1 ROT+30\nL Z+40 FMAX\n".to_owned(),
        "CYCL DEF 10.0\nCYCL DEF 10.1 ROT+30\nL X+10 Y+10 FMAX\nL Z+40 FMAX\n".to_owned(),
    ] {
        begins("i5-engraver", Control::Heidenhain, &format!("{start}{approach}{end}"));
    }
    let (start, end) = ("G710 G90 G94\nG0 Z60\n", "G1 X12 Y12 Z30 F800\nX14 Y16\nM30\n");
    let swivel = r#"CYCLE800(1,"",0,57,0,0,0,20,10,45,0,0,0,-1)"#;
    for approach in [
        format!("{swivel}\nG0 X10 Y10\nZ40\n"),
        format!("G0 X10 Y10\n{swivel}\nG0 X10 Y10\nZ40\n"),
        format!("G0 A-20 C30\n{swivel}\nG0 X10 Y10\nZ40\n"),
        format!("{swivel}\nG0 X10 Y10\nTRANS X1 Y1 Z1\nZ40\n"),
        format!("{swivel}\nG0 X10 Y10\nCYCLE800()\nG0 X10 Y10\nZ40\n"),
        "TRAORI\nROT X20 Y10\nG0 X10 Y10\nZ40\n".to_owned(),
        "TRAORI\nG0 X10 Y10 A-30 C45\nROT X20 Y10\nZ40\n".to_owned(),
        "TRAORI\nG0 A-30 C45\nTRAFOOF\nG0 X10 Y10\nZ40\n".to_owned(),
        "G0 A-30 C45\nG0 X10 Y10\nTRAORI\nZ40\n".to_owned(),
        "G0 X10 Y10 A-30 C45\nTRAORI\nX10 Y10 A-30 C45\nZ40\n".to_owned(),
        "ROT Z30\nG0 X10 Y10\nROT\nZ40\n".to_owned(),
        "TRANS X5\nG0 X10 Y10\nATRANS X-5 Z2\nZ40\n".to_owned(),
    ] {
        begins("i5-engraver", Control::Sinumerik840d, &format!("{start}{approach}{end}"));
    }
}

/// Axes that no rapid names stand where the cut before needed them, and the next one begins elsewhere: the last rapid leads them, too.
#[test]
fn law_each_cut_begins_where_it_should_whichever_axes_are_named() {
    let mill = "G21 G17 G90 G94\nG0 X150. Y100. Z-390.\nG1 Z-398. F300.\nG0 Z-390.\n";
    let end = "G1 Z-398.\nX290.\nM30\n";
    for between in [
        "X280.\n",
        "X280. Y20.\n",
        "G91 X130.\nG90\n",
        "G91 X130.\nZ-1.\nG90\n",
        "Y20.\nX280.\nM8\n",
        "Z-60.\nX280.\nZ-390.\nG4 P500\n",
    ] {
        begins("three-axis-mill", Control::Fanuc, &format!("{mill}{between}{end}"));
    }
    // In increments, with retracts that stay as they are: they count from where the tool stands.
    let increments = "G21 G17 G90 G94\nG0 X150. Y100. Z-390.\nG91 G1 Z-8. F300.\nX9.\nG0 Z300.\n";
    for between in ["X100.\nZ-298.\n", "X100. Y-80.\nZ-200.\nZ-98.\n", "Z10.\nX100.\nZ-308.\n"] {
        let text =
            format!("{increments}{between}G1 Z-2.\nX5.\nG0 Z300.\nX20.\nZ-300.\nG1 Y5.\nM30\n");
        begins("three-axis-mill", Control::Fanuc, &text);
    }
    let table = "G21 G17 G90 G94\nG0 X10. Y10. Z40. A-30. C45.\nG1 Z30. F300.\nG0 Z40.\n";
    let end = "G1 Z30.\nX20. A-25.\nG49\nM30\n";
    for between in ["X60.\n", "A20.\n", "C-45.\n", "X60. C90.\nA-50.\n", "G91 C20.\nG90\n"] {
        for centre in ["", "G43.4 H1\n"] {
            let table = table.replace("G90 G94\n", &format!("G90 G94\n{centre}"));
            begins("i5-engraver", Control::Fanuc, &format!("{table}{between}{end}"));
        }
    }
}

/// Words to reference points and machine zero are places under G91, too; under SUPA they count from where the tool stands.
#[test]
fn law_a_cut_begins_where_it_should_after_reference_points_in_increments() {
    let head = "G21 G17 G90 G94\nG0 X20. Y-30. Z60.\nG1 Z52. F300\nG0 Z60.\n";
    let end = "G1 Z45. F500\nX12.\nM30\n";
    for (name, control, between) in [
        ("i5-engraver", Control::Fanuc, "G91 G28 A0 C0\nG90 G0 X10. Y-10.\nZ50.\n"),
        ("i5-engraver", Control::Fanuc, "G91 G28 Z0.\nG28 A0 C0\nG90 G0 X10. Y-10.\nZ50.\n"),
        ("i5-engraver", Control::Haas, "G91 G53 G0 A0 C0\nG90 G0 X10. Y-10.\nZ50.\n"),
        ("i5-engraver", Control::LinuxCnc, "G53 G0 A0 C0\nG91 G0 X-5.\nG90 Z50.\n"),
        ("i5-engraver", Control::Fanuc, "G91 G28 Z0.\nG91 G0 Z-30.\nX5.\nZ-10.\nG90\n"),
        ("three-axis-mill", Control::Fanuc, "G91 G28 Z0.\nG91 G0 Z-30.\nX5.\nZ-10.\nG90\n"),
        ("i5-engraver", Control::Sinumerik840d, "G91 G0 SUPA X1\nG0 X5\nZ-5\nG90\n"),
        ("i5-engraver", Control::Sinumerik840d, "G91\nG53 G0 A0 C0\nG0 X5\nZ-5\nG90\n"),
    ] {
        let (mut head, mut end) = (head.to_owned(), end.to_owned());
        if name == "three-axis-mill" {
            head = head.replace("Z60.", "Z-60.").replace("Z52.", "Z-62.").replace("Y-30.", "Y30.");
            end = end.replace("Z45.", "Z-45.");
        }
        if control == Control::Sinumerik840d {
            (head, end) = (head.replace("G21", "G710"), end.replace("G21", "G710"));
        }
        begins(name, control, &format!("{head}{between}{end}"));
    }
}

/// Where no word leads to the begin of a cut that could be corrected, the cut is listed, since its way is not part of the proof;
/// where the tool stands right there, it is not, and its way is.
#[test]
fn law_a_cut_that_begins_uncorrected_is_listed() {
    let head = "G21 G17 G90 G94\n";
    let cases = [
        ("G1 X150. Y100. Z-398. F500.\nX200.\n", vec![2]),
        ("G53 G0 X150. Y100. Z-398.\nG1 X200. F500.\nX250.\n", vec![3]),
        ("G0 X150. Y100. Z-398.\nG1 X200. F500.\nG28 G91 Z0\nG90 G1 Z-390.\nX250.\n", vec![5]),
        ("G53 G0 X150. Y100. Z-398.\nG0 X150.\nG1 X200. F500.\n", vec![]),
        ("G0 X150. Y100. Z-398.\nG4 P100\nG1 X200. F500.\n", vec![]),
    ];
    for (text, lines) in cases {
        let program = Program::new("p", format!("{head}{text}M30\n").into(), Control::Fanuc);
        let options = ProgramOptions::default();
        let mill = machine("three-axis-mill");
        let (written, problems) = compensate_program(&mill, &program, &SetUp::default(), &options);
        let written = written.unwrap_or_else(|| panic!("{problems:?}\n{text}"));
        assert_eq!(written.found.begins_elsewhere, lines, "{text}");
        // Without errors every place is right.
        let bare = bare("three-axis-mill");
        let (written, _) = compensate_program(&bare, &program, &SetUp::default(), &options);
        assert_eq!(written.expect("a program").found.begins_elsewhere, [0; 0], "{text}");
    }
}

/// A block with feed to machine coordinates stays as it is, however long it is, and what comes after it is right; M91 of Klartext is
/// corrected.
#[test]
fn law_a_feed_to_machine_coordinates_stays_as_it_is() {
    let iso =
        "G0 X150. Y100. Z-398.\nG1 X200. F500.\nLEAVES\nG0 X150. Y100. Z-398.\nG1 X200.\nM30\n";
    let klartext = "BEGIN PGM A MM\nTOOL CALL 1 Z S1000\nL X+150 Y+100 Z-398 R0 FMAX\nL X+200 R0 F500\nLEAVES\nL X+150 Y+100 Z-398 R0 FMAX\nL X+200 R0 F500\nEND PGM A MM\n";
    for (control, leaves) in [
        (Control::Haas, "G1 G53 Z-100."),
        (Control::Haas, "G53 X10. Y20. Z-100."),
        (Control::LinuxCnc, "G53 Z-100."),
        (Control::LinuxCnc, "G1 G53 X10. Z-100."),
        (Control::Fanuc, "G1 G53 Z-100."),
        (Control::Sinumerik840d, "G1 SUPA Z-100 D0"),
        (Control::Sinumerik840d, "G53 X10 Z-100"),
        (Control::Heidenhain, "L Z-100 R0 F500 M91"),
    ] {
        let klar = control == Control::Heidenhain;
        let mut text = if klar { klartext.to_owned() } else { format!("G21 G17 G90 G94\n{iso}") };
        if control == Control::Sinumerik840d {
            text = text.replace("G21", "G710").replace(".\n", "\n").replace(". ", " ");
        }
        let text = text.replace("LEAVES", leaves);
        let program = Program::new("p", text.clone().into_bytes(), control);
        let mill = machine("three-axis-mill");
        let options = ProgramOptions::default();
        let (written, problems) = compensate_program(&mill, &program, &SetUp::default(), &options);
        let written = written.unwrap_or_else(|| panic!("{problems:?}\n{text}"));
        let shown = String::from_utf8_lossy(&written.text);
        assert!(written.is_proved(), "{:?}\n{shown}", written.unproved);
        assert_eq!(shown.contains(leaves), !klar, "{shown}");
        assert!(written.proof.after.tip.value < 1.5e-3 && written.proof.compared >= 2, "{shown}");
    }
}
