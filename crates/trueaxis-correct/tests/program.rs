//! Laws of compensated programs on a machine without errors: nothing to correct, nothing that is missed.

use std::io;
use std::path::Path;
use trueaxis_correct::compensate::program::{
    ProgramOptions, Rewritten, compensate_program, compensate_program_with,
};
use trueaxis_input::{Content, Draft, Files, Kept, Source};
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

/// X is too long by 0.1 µm per mm: at 10, 20 and 30 mm the tip is off by 1, 2 and 3 µm, elsewhere the tool stands at zero.
/// The same blocks in increments, in another order of words and with empty lines between them give the same.
#[test]
fn law_the_root_mean_square_is_that_of_the_ends_of_blocks() {
    let text = "machine = { name = 'm', chain = 'w b X Y Z t' }\n[tool]\nlength = '100 mm'\n\
                [motion.X]\nEXX = { polynomial = ['0 um', '10 um'], scale = '100 mm' }\n";
    let machine = Machine::check("m.toml", text, &NoTables).0.expect("a machine");
    let found = |program: &str| {
        let program = Program::new("p.ngc", program.as_bytes().to_vec(), Control::LinuxCnc);
        let (set_up, options) = (SetUp::default(), ProgramOptions::default());
        let (done, problems) = compensate_program(&machine, &program, &set_up, &options);
        done.unwrap_or_else(|| panic!("{problems:?}")).proof
    };
    let absolute = found("G21 G90 G94 F500\nG1 X0\nG1 X10\nG1 X20\nG1 X30\nM2\n");
    let square = absolute.before.tip_end_rms_mm.powi(2) * absolute.compared as f64;
    assert!((square - 14e-6).abs() < 1e-12, "{square}");
    assert!((absolute.before.tip_end.value - 3e-3).abs() < 1e-9);
    assert!(absolute.after.tip_end_rms_mm < 1e-3 && absolute.before.axis_end_rms_rad == 0.0);
    let increments = found("G94 G21 F500 G91\n\nG1 X0\nX10 G1\n\nX10\nX10\nM2\n");
    assert_eq!(increments.compared, absolute.compared);
    let difference = increments.before.tip_end_rms_mm - absolute.before.tip_end_rms_mm;
    assert!(difference.abs() < 1e-12, "{difference}");
}

/// 20,000 moves: the part that is done only grows, stays below 1, and who looks at it
/// gets the same program.
#[test]
fn law_progress_grows_and_changes_nothing() {
    let text = "machine = { name = 'm', chain = 'w b X Y Z t' }\n[tool]\nlength = '100 mm'\n\
                [motion.X]\nEXX = { polynomial = ['0 um', '10 um'], scale = '100 mm' }\n";
    let machine = Machine::check("m.toml", text, &NoTables).0.expect("a machine");
    let moves: String = (0..20_000).map(|k| format!("G1 X{} Y{}\n", k % 7, k % 5)).collect();
    let source = format!("G21 G90 G94 F500\n{moves}M2\n").into_bytes();
    let program = Program::new("p.ngc", source, Control::LinuxCnc);
    let (set_up, options) = (SetUp::default(), ProgramOptions::default());
    let parts = std::sync::Mutex::new(Vec::new());
    let note = |part: f64| parts.lock().expect("parts").push(part);
    let (shown, _) = compensate_program_with(&machine, &program, &set_up, &options, &note);
    let (plain, _) = compensate_program(&machine, &program, &set_up, &options);
    let parts = parts.into_inner().expect("parts");
    assert!(parts.len() > 3 && parts.windows(2).all(|w| w[0] <= w[1]), "{parts:?}");
    assert!(parts.iter().all(|part| (0.0..1.0).contains(part)) && *parts.last().unwrap() > 0.7);
    assert_eq!(shown.expect("a program").text, plain.expect("a program").text);
}

/// Keeps texts in pieces elsewhere than in one list, as a disk does; or loses them.
struct Elsewhere {
    loses: bool,
}

#[derive(Default)]
struct Pieces {
    all: Vec<Box<[u8]>>,
    loses: bool,
}

struct Joined(Vec<u8>);

impl Kept for Joined {
    fn bytes(&self) -> &[u8] {
        &self.0
    }

    fn pass(&self, _: std::ops::Range<usize>) {}
}

impl Draft for Pieces {
    fn length(&self) -> usize {
        self.all.iter().map(|piece| piece.len()).sum()
    }

    fn put(&mut self, bytes: &[u8]) {
        self.all.push(bytes.into());
    }

    fn read(&self, range: std::ops::Range<usize>) -> Vec<u8> {
        self.all.concat()[range].to_vec()
    }

    fn finish(self: Box<Self>) -> io::Result<Content> {
        match self.loses {
            true => Err(io::ErrorKind::StorageFull.into()),
            false => Ok(Content::kept(Joined(self.all.concat()))),
        }
    }
}

impl Source for Elsewhere {
    fn read(&self, _: &Path) -> io::Result<Vec<u8>> {
        Err(io::ErrorKind::NotFound.into())
    }

    fn is_file(&self, _: &Path) -> bool {
        false
    }

    fn draft(&self, _: usize) -> Box<dyn Draft> {
        Box::new(Pieces { loses: self.loses, ..Pieces::default() })
    }
}

/// The text is the same wherever it is kept: lines in order, a part that is skipped and executed later, lines that are
/// executed again; and where it is lost there is no program.
#[test]
fn law_where_the_text_is_kept_does_not_matter() {
    let machine = "machine = { name = 'm', chain = 'w b X Y Z t' }\n[tool]\nlength = '100 mm'\n\
                   [motion.X]\nEXX = { polynomial = ['0 um', '30 um'], scale = '10 mm' }\n";
    let machine = Machine::check("m.toml", machine, &NoTables).0.expect("a machine");
    let in_order = "G710 G90 G94 F500\nG1 X10 Y10\nX20\nM30\n";
    let skipped = "G710 G90 G94 F500\nGOTOF MID\nPART: G1 X10 Y10\nX20\nGOTOF FIN\n\
                   MID: G1 X5 Y5\nX7 Y6\nGOTOB PART\nFIN: X0\nM30\n";
    let again = "G710 G90 G94 F500\nG1 X0 Y0\nAGAIN: G1 X10 Y10\nX20 Y0\nREPEAT AGAIN P=3\nM30\n";
    for text in [in_order, skipped, again] {
        let program = Program::new("p.mpf", text.as_bytes().to_vec(), Control::Sinumerik840d);
        let of = |files: Files| {
            let set_up = SetUp { files, ..SetUp::default() };
            compensate_program(&machine, &program, &set_up, &ProgramOptions::default())
        };
        let (plain, problems) = of(Files::none());
        let plain = plain.unwrap_or_else(|| panic!("{problems:?}"));
        let shown = String::from_utf8_lossy(&plain.text);
        assert!(plain.is_proved() && shown.contains("X9.9"), "{shown}");
        let kept = of(Files::new(Elsewhere { loses: false })).0.expect("a program");
        assert_eq!(String::from_utf8_lossy(&kept.text), String::from_utf8_lossy(&plain.text));
        let (none, problems) = of(Files::new(Elsewhere { loses: true }));
        assert!(none.is_none() && problems.iter().any(|p| p.code == "unwritable-file"));
    }
}
