//! What a server may read and write: below its folder, whatever links and names lead elsewhere.
#![cfg(unix)]

use std::fs;
use std::os::unix::fs::symlink;
use std::path::{Path, PathBuf};
use trueaxis::files::{self, read_bytes, within, write};
use trueaxis_input::Diagnostics;

/// `in/` is the project, with `sub/` and a machine; `out/` is next to it.
struct Tree(PathBuf);

const MACHINE: &str = "machine = { name = \"m\", chain = \"w b X Y Z t\" }\n";

impl Tree {
    fn new(name: &str) -> Self {
        let all = std::env::temp_dir();
        let root = all.join(format!("trueaxis-scope-{name}-{}", std::process::id()));
        for folder in ["in/sub", "in/machines/x", "out"] {
            fs::create_dir_all(root.join(folder)).unwrap();
        }
        for (file, text) in [
            ("in/a.txt", "in"),
            ("out/b.txt", "out"),
            ("out/e.csv", "position_mm,EXX_um\n0,1\n100,2\n"),
            ("in/machines/x/machine.toml", MACHINE),
        ] {
            fs::write(root.join(file), text).unwrap();
        }
        Self(root)
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.join(name)
    }

    /// Whether a file is read, in the scope `in/`.
    fn reads(&self, name: &str) -> Result<Vec<u8>, String> {
        within(&self.path("in"), || read_bytes(&self.path(name)).map_err(|e| e.to_string()))
    }
}

impl Drop for Tree {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

const OUTSIDE: &str = "lies outside the project folder";

#[test]
fn only_what_lies_below_the_folder_is_read() {
    let tree = Tree::new("read");
    symlink(tree.path("out/b.txt"), tree.path("in/link.txt")).unwrap();
    symlink(tree.path("out"), tree.path("in/door")).unwrap();
    symlink(tree.path("in/a.txt"), tree.path("in/sub/a.txt")).unwrap();
    for inner in ["in/a.txt", "in/sub/../a.txt", "in/sub/a.txt", "out/../in/a.txt"] {
        assert_eq!(tree.reads(inner).as_deref(), Ok(&b"in"[..]), "{inner}");
    }
    let outer = ["out/b.txt", "in/../out/b.txt", "in/sub/../../out/b.txt", "in/link.txt"];
    for outer in outer.iter().chain(&["in/door/b.txt", "in/sub/../door/../out/b.txt"]) {
        assert_eq!(tree.reads(outer).unwrap_err(), OUTSIDE, "{outer}");
    }
    // Nothing outside is disclosed, and what is missing inside is missing.
    assert_eq!(tree.reads("out/none.txt").unwrap_err(), OUTSIDE);
    assert_eq!(tree.reads("out/none/none.txt").unwrap_err(), OUTSIDE);
    assert!(tree.reads("in/none.txt").unwrap_err().contains("os error 2"));
    assert_eq!(tree.reads("in/sub").unwrap_err(), "is not an ordinary file");
    within(&tree.path("in"), || {
        assert!(!files::is_file(&tree.path("in/link.txt")));
        assert!(files::is_file(&tree.path("in/a.txt")));
    });
    assert_eq!(read_bytes(&tree.path("in/link.txt")).unwrap(), b"out"); // free again
}

#[test]
fn a_neighbour_whose_name_begins_alike_lies_outside() {
    let tree = Tree::new("alike");
    fs::create_dir_all(tree.path("inside")).unwrap();
    fs::write(tree.path("inside/c.txt"), "c").unwrap();
    assert_eq!(tree.reads("inside/c.txt").unwrap_err(), OUTSIDE);
}

#[test]
fn only_what_lies_below_the_folder_is_written() {
    let tree = Tree::new("write");
    symlink(tree.path("out/b.txt"), tree.path("in/link.txt")).unwrap();
    symlink(tree.path("out"), tree.path("in/door")).unwrap();
    symlink(tree.path("out/new.txt"), tree.path("in/loose.txt")).unwrap();
    let writes = |name: &str| within(&tree.path("in"), || write(&tree.path(name), b"x"));
    for outer in ["out/b.txt", "in/../out/n.txt", "in/link.txt", "in/door/n.txt"] {
        assert_eq!(writes(outer).unwrap_err().to_string(), OUTSIDE, "{outer}");
    }
    assert!(writes("in/loose.txt").is_err());
    assert_eq!(fs::read(tree.path("out/b.txt")).unwrap(), b"out");
    assert_eq!(fs::read_dir(tree.path("out")).unwrap().count(), 2);
    writes("in/sub/../new.txt").unwrap();
    writes("in/a.txt").unwrap();
    assert_eq!(fs::read(tree.path("in/a.txt")).unwrap(), b"x");
    write(&tree.path("out/n.txt"), b"x").unwrap(); // free again
}

#[test]
fn missing_folders_are_made_below_the_folder_only() {
    let tree = Tree::new("folders");
    symlink(tree.path("out"), tree.path("in/door")).unwrap();
    let writes =
        |name: &str| within(&tree.path("in"), || files::write_with_folder(&tree.path(name), b"x"));
    for outer in ["out/new/n.txt", "in/door/new/n.txt", "in/new/../../evil/n.txt", "evil/n.txt"] {
        assert_eq!(writes(outer).unwrap_err().to_string(), OUTSIDE, "{outer}");
    }
    assert!(!tree.path("evil").exists() && !tree.path("out/new").exists());
    writes("in/machines/mill-7/machine.toml").unwrap();
    assert_eq!(fs::read(tree.path("in/machines/mill-7/machine.toml")).unwrap(), b"x");
}

#[test]
fn what_files_name_lies_below_the_folder_too() {
    let tree = Tree::new("named");
    let study = tree.path("in/sub/campaign.toml");
    fs::write(&study, "name = \"c\"\nmachine = \"../machines/x/machine.toml\"\n").unwrap();
    let text = fs::read_to_string(&study).unwrap();
    let machine_of = |study: &Path, text: &str| {
        let source = trueaxis_input::SourceText::from(&files::disk(), "campaign.toml", text);
        let found = source.read(|root| {
            root.get("name");
            trueaxis_machine::file::machine_of(root, study)
        });
        (found, source.finish())
    };
    let (found, problems) = within(&tree.path("in"), || machine_of(&study, &text));
    assert!(found.is_some(), "{problems:?}");
    let (found, _) = within(&tree.path("in/sub"), || machine_of(&study, &text));
    assert!(found.is_none()); // the machine lies beside that folder
    // A machine that names a table outside.
    let bad = tree.path("in/machines/x/bad.toml");
    let table = "[motion.X]\ntable = \"../../../out/e.csv\"\n";
    fs::write(&bad, format!("{MACHINE}{table}")).unwrap();
    assert!(files::machine(&bad).0.is_some());
    let (machine, problems) = within(&tree.path("in"), || files::machine(&bad));
    assert!(machine.is_none());
    assert!(problems.iter().any(|d| d.message.contains(OUTSIDE)), "{problems:?}");
}

#[test]
fn scopes_end_and_only_narrow() {
    let tree = Tree::new("nested");
    let read = |name: &str| read_bytes(&tree.path(name)).is_ok();
    within(&tree.path("in"), || {
        within(&tree.path("in/sub"), || assert!(!read("in/a.txt")));
        // A wider one within changes nothing.
        within(&tree.0, || assert!(!read("out/b.txt") && read("in/a.txt")));
        assert!(read("in/a.txt") && !read("out/b.txt"));
        let panicked = std::panic::catch_unwind(|| within(&tree.path("in/sub"), || panic!()));
        assert!(panicked.is_err() && read("in/a.txt"));
        // Another thread is free.
        std::thread::scope(|s| s.spawn(|| assert!(read("out/b.txt"))).join().unwrap());
    });
    assert!(read("out/b.txt"));
    within(&tree.path("nowhere"), || assert!(!read("in/a.txt")));
    within(&tree.path("in/a.txt"), || assert!(!read("in/a.txt")));
    let mut problems = Diagnostics::new();
    within(&tree.path("in"), || {
        trueaxis_motion::read_temperature_log(
            &files::disk(),
            &tree.path("out/log.parquet"),
            &mut problems,
        )
    });
    assert!(problems.iter().any(|d| d.message.contains(OUTSIDE)));
}
