//! Programs that are longer than what is held in the memory.

mod library;

use std::fs::File;
use std::io::Write;
use std::path::PathBuf;
use trueaxis::files;
use trueaxis_input::Diagnostics;

/// A file of this test that vanishes with it.
struct Scratch(PathBuf);

impl Scratch {
    fn new(name: &str) -> Self {
        Self(std::env::temp_dir().join(format!("trueaxis-long-{}-{name}", std::process::id())))
    }

    fn create(&self) -> File {
        File::create(&self.0).expect("a file")
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        let _ = std::fs::remove_file(&self.0);
    }
}

/// What a problem of a file says.
fn refusal(path: &std::path::Path, long: bool) -> String {
    let mut problems = Diagnostics::new();
    let disk = files::disk();
    let is_read = match long {
        true => disk.content(path, "an NC program", &mut problems).is_some(),
        false => disk.bytes(path, "a table", &mut problems).is_some(),
    };
    assert!(!is_read);
    problems.iter().map(|d| format!("{}: {}", d.code, d.message)).collect()
}

#[test]
fn a_program_on_the_disk_is_the_same_as_in_the_memory() {
    let scratch = Scratch::new("same.nc");
    // Remarks of 100 characters make it long, not slow; a mark of UTF-8 stands before it.
    let remark = format!("({})\n", "-".repeat(100));
    let mut text = b"\xEF\xBB\xBF%\nO1\nG0 X1. Y2. Z3.\n".to_vec();
    while text.len() < 40 << 20 {
        text.extend_from_slice(remark.as_bytes());
    }
    text.extend_from_slice(b"G1 X100. F1000.\nM30\n%\n");
    scratch.create().write_all(&text).expect("room on the disk");
    let mut problems = Diagnostics::new();
    let kept = files::disk().content(&scratch.0, "an NC program", &mut problems).expect("a text");
    assert!(*kept == text[..]);
    let machine = library::machine("three-axis-mill");
    let run = |text: Option<&[u8]>| {
        let disk = files::disk();
        let files = trueaxis_motion::ProgramFiles {
            files: &disk,
            program: &scratch.0,
            text,
            setup: None,
            control: None,
        };
        let mut problems = Diagnostics::new();
        let options = trueaxis_motion::Options::default();
        let job = trueaxis_motion::Job::read(machine.clone(), &files, options, &mut problems);
        let found = job.expect("a job").run(None, &mut []);
        format!("{:?} {:?}", found.run.problems, found.summary)
    };
    assert_eq!(run(None), run(Some(&text)));
}

#[test]
fn what_is_too_long_is_refused_before_it_is_read() {
    let scratch = Scratch::new("long.nc");
    let file = scratch.create();
    // No disk is filled: what was never written takes no room.
    for (length, long, limit) in [
        ((1 << 30) + 1, true, 1 << 30),
        (1 << 33, true, 1 << 30),
        ((256 << 20) + 1, false, 256 << 20),
    ] {
        file.set_len(length).expect("a file with a hole");
        let due = format!(
            "unreadable-file: the file cannot be read: files of more than {limit} bytes are not read"
        );
        assert_eq!(refusal(&scratch.0, long), due);
    }
    #[cfg(unix)]
    assert!(refusal("/dev/zero".as_ref(), true).contains("more than 268435456 bytes"));
}
