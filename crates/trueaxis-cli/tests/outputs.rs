//! What commands replace: their own files that were not edited, an input never, anything else by `--force`.

mod command;

use command::{Folder, trueaxis};
use std::fs;
use std::path::Path;
use std::process::Command;

/// A command, a file that it writes, and one that it reads. `OUT` stands for a place in an empty folder.
struct Case {
    words: &'static str,
    file: &'static str,
    input: &'static str,
}

const I5: &str = "machines/i5-engraver/machine.toml";

const CASES: [Case; 19] = [
    Case {
        words: "part crates/trueaxis-cli/tests/import/plate.qif -o OUT",
        file: "OUT",
        input: "crates/trueaxis-cli/tests/import/plate.qif",
    },
    Case {
        words: "predict examples/03_predict/s-shape.toml --results OUT.csv",
        file: "OUT.csv",
        input: "parts/s-shape.toml",
    },
    Case {
        words: "post machines/i5-engraver/machine.toml examples/06_compensate/bangle.cls --control fanuc -o OUT",
        file: "OUT",
        input: "examples/06_compensate/bangle.cls",
    },
    Case {
        words: "compensate adapt examples/06_compensate/bangle-adapt.toml --control fanuc -o OUT",
        file: "OUT",
        input: "examples/06_compensate/bangle-adapt.toml",
    },
    Case {
        words: "compensate adapt examples/06_compensate/bangle-adapt.toml --cl OUT",
        file: "OUT",
        input: "examples/06_compensate/bangle-adapt.cls",
    },
    Case {
        words: "compensate values machines/xkas2525/machine.toml --axis C --step 30 --format csv -o OUT",
        file: "OUT",
        input: "machines/xkas2525/machine.toml",
    },
    Case {
        words: "compensate program machines/i5-engraver/machine.toml examples/06_compensate/everyday-fanuc.nc -o OUT",
        file: "OUT",
        input: "examples/06_compensate/everyday-fanuc.nc",
    },
    Case {
        words: "identify examples/05_identify/probe-ball.toml -o OUT",
        file: "OUT",
        input: "examples/05_identify/probe-ball.toml",
    },
    Case {
        words: "identify rtcp examples/05_identify/rtcp-engraver.toml -o OUT",
        file: "OUT",
        input: I5,
    },
    Case {
        words: "identify surface examples/05_identify/bangle-hits.toml -o OUT",
        file: "OUT",
        input: "examples/05_identify/bangle-hits.toml",
    },
    Case {
        words: "identify probe examples/05_identify/ring-60.toml --table OUT",
        file: "OUT",
        input: "examples/05_identify/ring-60.toml",
    },
    Case {
        words: "simulate machines/i5-engraver/machine.toml examples/02_simulate/ring-fanuc.nc --path OUT",
        file: "OUT",
        input: "examples/02_simulate/ring-fanuc.nc",
    },
    Case {
        words: "evaluate iso230-2 examples/07_verify/x-axis-laser.csv --report OUT.html",
        file: "OUT.html",
        input: "examples/07_verify/x-axis-laser.csv",
    },
    Case {
        words: "evaluate iso230-4 examples/07_verify/ball-bar-export.csv --machine machines/three-axis-mill/machine.toml -o OUT",
        file: "OUT",
        input: "machines/three-axis-mill/machine.toml",
    },
    Case {
        words: "measure --part examples/03_predict/nas979-on-xkas2525.toml -o OUT",
        file: "OUT",
        input: "examples/03_predict/nas979-on-xkas2525.toml",
    },
    Case {
        words: "measure examples/07_verify/probe-ball-campaign.toml -o OUT",
        file: "OUT/probe.csv",
        input: "examples/07_verify/probe-ball-campaign.toml",
    },
    Case {
        words: "plan probe-surface examples/04_plan/probe-surface.toml -o OUT --control fanuc",
        file: "OUT/surface.csv",
        input: "examples/04_plan/probe-surface.toml",
    },
    Case {
        words: "plan examples/04_plan/ball-bar-10791-6.toml -o OUT",
        file: "OUT/01-bk1-radial.mpf",
        input: "examples/04_plan/ball-bar-10791-6.toml",
    },
    Case {
        words: "post machines/xkas2525/machine.toml testpieces/nas979-gbt33150.toml --control sinumerik -o OUT.mpf --set-up OUT",
        file: "OUT/set-up.toml",
        input: "testpieces/nas979-gbt33150.toml",
    },
];

impl Case {
    /// Runs it with outputs below a folder; the exit status and standard error.
    fn run(&self, folder: &Folder, force: bool) -> (i32, String) {
        let out = folder.path("out");
        let words: Vec<String> =
            self.words.split(' ').map(|word| word.replace("OUT", &out)).collect();
        let mut words: Vec<&str> = words.iter().map(String::as_str).collect();
        words.extend(force.then_some("--force"));
        let ran = trueaxis(&words);
        (ran.status, ran.err)
    }

    fn file(&self, folder: &Folder) -> String {
        folder.path(&self.file.replace("OUT", "out"))
    }

    /// Replaced where it is ours, kept where it was edited, replaced by force.
    fn check(&self, folder: &Folder) {
        let file = self.file(folder);
        let (status, err) = self.run(folder, false);
        assert!(status < 2, "{}\n{err}", self.words);
        let written = fs::read(&file).unwrap_or_else(|e| panic!("{}: {file}: {e}", self.words));
        let (again, err) = self.run(folder, false);
        assert_eq!((again, &fs::read(&file).unwrap()), (status, &written), "{}\n{err}", self.words);

        let edited = [&written[..], b"\n"].concat();
        for there in [&edited[..], b"my own work", &written[1..]] {
            fs::write(&file, there).unwrap();
            let before = everything(folder);
            let (refused, err) = self.run(folder, false);
            assert!(refused == 2 && err.contains("unwritable-file"), "{}\n{err}", self.words);
            assert!(err.contains("--force"), "{}\n{err}", self.words);
            assert_eq!(everything(folder), before, "{}: nothing is written", self.words);
        }
        let (forced, err) = self.run(folder, true);
        assert_eq!((forced, fs::read(&file).unwrap()), (status, written), "{}\n{err}", self.words);
    }

    /// An input is never replaced, through a link neither.
    #[cfg(unix)]
    fn check_input(&self, folder: &Folder) {
        let (file, input) = (self.file(folder), command::root().join(self.input));
        let input = input.canonicalize().unwrap();
        fs::remove_file(&file).unwrap();
        std::os::unix::fs::symlink(&input, &file).unwrap();
        for force in [false, true] {
            let (refused, err) = self.run(folder, force);
            assert!(
                refused == 2 && err.contains("is read by this command"),
                "{}\n{err}",
                self.words
            );
            assert_eq!(fs::read_link(&file).unwrap(), input, "{}", self.words);
        }
    }
}

/// The files of a folder and of those in it, with their content.
fn everything(folder: &Folder) -> Vec<(String, Vec<u8>)> {
    fn walk(folder: &Path, found: &mut Vec<(String, Vec<u8>)>) {
        for entry in fs::read_dir(folder).unwrap().flatten() {
            match entry.path() {
                path if path.is_dir() => walk(&path, found),
                path => found.push((path.display().to_string(), fs::read(&path).unwrap())),
            }
        }
    }
    let mut found = Vec::new();
    walk(Path::new(&folder.path("")), &mut found);
    found.sort();
    found
}

fn check(cases: std::ops::Range<usize>) {
    for i in cases {
        let folder = Folder::new(&format!("outputs-{i}"));
        CASES[i].check(&folder);
        #[cfg(unix)]
        CASES[i].check_input(&folder);
    }
}

#[test]
fn programs_and_values_are_replaced_by_one_rule() {
    check(0..7);
}

#[test]
fn machines_and_tables_are_replaced_by_one_rule() {
    check(7..14);
}

#[test]
fn readings_and_plans_are_replaced_by_one_rule() {
    check(14..CASES.len());
}

/// The case of a person who filled in the table of a plan, without the list of what was written and with it.
#[test]
fn a_plan_does_not_replace_readings() {
    let case = CASES.iter().find(|case| case.file == "OUT/surface.csv").unwrap();
    let folder = Folder::new("outputs-filled-in");
    assert_eq!(case.run(&folder, false).0, 0);
    let (table, list) = (case.file(&folder), folder.path("out/.trueaxis-written"));
    let lines = fs::read_to_string(&list).unwrap();
    assert!(lines.lines().any(|line| line.ends_with("  surface.csv")), "{lines}");
    // The same plan where the list was lost: its files are as they were, and nothing is lost.
    fs::remove_file(&list).unwrap();
    assert_eq!(case.run(&folder, false).0, 0);
    let filled = fs::read_to_string(&table).unwrap().replace("\n", ",1.5\n");
    fs::write(&table, &filled).unwrap();
    for list_is_there in [true, false] {
        if !list_is_there {
            fs::remove_file(&list).unwrap();
        }
        assert_eq!(case.run(&folder, false).0, 2);
        assert_eq!(fs::read_to_string(&table).unwrap(), filled);
    }
}

/// Through a hard link, a path with `..` and another name of the folder.
#[cfg(unix)]
#[test]
fn an_input_is_known_under_any_name() {
    let folder = Folder::new("outputs-names");
    let cl = fs::read(command::root().join("examples/06_compensate/bangle.cls")).unwrap();
    let input = folder.file("in.cls", &cl);
    fs::create_dir(folder.path("d")).unwrap();
    fs::hard_link(&input, folder.path("hard.cls")).unwrap();
    std::os::unix::fs::symlink(folder.path(""), folder.path("d/up")).unwrap();
    let names = ["in.cls", "hard.cls", "d/../in.cls", "d/up/in.cls"];
    for name in names.map(|name| folder.path(name)) {
        let ran = trueaxis(&["post", I5, &input, "--control", "fanuc", "-o", &name, "--force"]);
        assert!(ran.status == 2 && ran.err.contains("unwritable-file"), "{name}\n{}", ran.err);
        assert_eq!(fs::read(&input).unwrap(), cl, "{name}");
    }
    // A link that leads nowhere is not replaced by force either.
    std::os::unix::fs::symlink(folder.path("nowhere"), folder.path("dead")).unwrap();
    let dead = folder.path("dead");
    let ran = trueaxis(&["post", I5, &input, "--control", "fanuc", "-o", &dead, "--force"]);
    assert!(ran.status == 2 && ran.err.contains("leads nowhere"), "{}", ran.err);
}

/// `predict`, `simulate` and `compensate adapt` wrote a report unasked.
#[test]
fn reports_are_written_on_request_only() {
    let (folder, root) = (Folder::new("outputs-unasked"), command::root().canonicalize().unwrap());
    let at = |path: &str| root.join(path).display().to_string();
    let commands = [
        vec!["predict".to_owned(), at("examples/03_predict/cone-on-i5.toml")],
        vec!["simulate".into(), at(I5), at("examples/02_simulate/ring-fanuc.nc")],
        vec!["compensate".into(), "adapt".into(), at("examples/06_compensate/bangle-adapt.toml")],
    ];
    for words in &commands {
        for more in [&[][..], &["--format", "json"], &["--no-report"]] {
            let mut command = Command::new(env!("CARGO_BIN_EXE_trueaxis"));
            let ran = command.args(words).args(more).current_dir(folder.path("")).output().unwrap();
            assert!(ran.status.code().is_some_and(|code| code < 2), "{words:?}: {ran:?}");
            assert_eq!(everything(&folder), [], "{words:?} {more:?}");
        }
    }
}

/// What a killed run left is removed by the next one; what another run holds is not.
#[cfg(unix)]
#[test]
fn half_written_files_do_not_stay() {
    let folder = Folder::new("outputs-killed");
    folder.file(".trueaxis-1-0-old.csv.part", "half");
    fs::create_dir(folder.path(".trueaxis-2-nc.part")).unwrap();
    folder.file(".trueaxis-2-nc.part/a", "half");
    folder.file(".trueaxis-notes", "of a person");
    folder.file("x.part", "of a person");
    let held = folder.file(".trueaxis-3-0-held.csv.part", "being written");
    let held = fs::File::open(held).unwrap();
    held.lock().unwrap();
    let out = folder.path("c.csv");
    let words = ["compensate", "values", I5, "--axis", "X", "--format", "csv", "--step", "50"];
    let ran = trueaxis(&[&words[..], &["-o", &out]].concat());
    assert_eq!(ran.status, 0, "{}", ran.err);
    let kept = [".trueaxis-3-0-held.csv.part", ".trueaxis-notes", "c.csv", "x.part"];
    assert_eq!(folder.names(), kept);
}
