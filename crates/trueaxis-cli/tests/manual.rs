//! Pages for man and completions of shells: all commands, as `--help` has them.

mod command;

use command::{Folder, trueaxis};
use std::fs;

/// The commands that `--help` lists.
fn listed() -> Vec<String> {
    let help = trueaxis(&["--help"]).out;
    let commands = help.split("Commands:\n").nth(1).expect("commands").split("\n\n").next();
    let lines =
        commands.expect("a list").lines().filter(|l| l.starts_with("  ") && !l.starts_with("   "));
    let names = lines.filter_map(|l| l.split_whitespace().next()).filter(|name| *name != "help");
    names.map(str::to_owned).collect()
}

#[test]
fn every_command_has_a_page_with_its_examples() {
    let temporary = Folder::new("manual");
    let folder = temporary.path("man1");
    let ran = trueaxis(&["manual", "-o", &folder]);
    assert_eq!((ran.status, ran.out.as_str()), (0, ""));
    let all = listed();
    assert!(all.len() > 20, "{all:?}");
    for name in &all {
        let page = fs::read_to_string(format!("{folder}/trueaxis-{name}.1")).expect(name);
        assert!(page.contains(".SH SYNOPSIS"), "{name}");
        assert_eq!(page, trueaxis(&["manual", name]).out, "{name}");
    }
    let page = trueaxis(&["manual", "compensate", "program"]).out;
    assert!(page.contains("\n.SH EXAMPLES\n.nf\n"), "{page}");
    assert!(page.contains("\n  trueaxis compensate program machines/"), "{page}");
    // Nothing is written over.
    let again = trueaxis(&["manual", "-o", &folder]);
    assert_eq!(again.status, 2);
    assert!(again.err.contains("is no new or empty folder"), "{}", again.err);
}

#[test]
fn a_command_that_is_not_there_is_named() {
    let ran = trueaxis(&["manual", "compensate", "programme"]);
    assert_eq!(ran.status, 2);
    assert!(ran.err.contains("there is no command `compensate programme`"), "{}", ran.err);
}

#[test]
fn every_shell_knows_every_command() {
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        let ran = trueaxis(&["completions", shell]);
        assert_eq!((ran.status, ran.err.as_str()), (0, ""), "{shell}");
        for name in listed() {
            assert!(ran.out.contains(&name), "{shell}: {name}");
        }
    }
    assert_eq!(trueaxis(&["completions", "tcsh"]).status, 2);
}
