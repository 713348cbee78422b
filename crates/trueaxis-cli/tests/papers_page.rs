//! `docs/papers.md`: every command of the page runs.

mod command;

use command::{Folder, root, trueaxis};

/// The commands of the page: line, exit status, words.
fn commands(page: &str) -> Vec<(usize, i32, String)> {
    let rows = page.lines().enumerate().filter(|(_, line)| line.starts_with("| "));
    rows.filter_map(|(i, line)| {
        let (before, rest) = line.split_once("`trueaxis ")?;
        let (command, _) = rest.split_once('`').expect("an end of the command");
        // Words of prose such as `trueaxis serve` have no exit status.
        let status = before.trim_end().rsplit(' ').next()?.parse().ok()?;
        Some((i + 1, status, command.to_owned()))
    })
    .collect()
}

/// The words of a command; quotes keep spaces.
fn words(command: &str, folder: &str) -> Vec<String> {
    let mut quoted = false;
    let split = command.split(|c: char| {
        quoted ^= c == '"';
        c == ' ' && !quoted
    });
    split.map(|word| word.replace('"', "").replace("OUT", folder)).collect()
}

#[test]
fn every_command_of_the_page_runs() {
    let page = std::fs::read_to_string(root().join("docs/papers.md")).expect("the page");
    let all = commands(&page);
    assert!(all.len() >= 25, "{} commands", all.len());
    for (line, status, command) in all {
        let folder = Folder::new(&format!("papers-{line}"));
        let place = folder.path("");
        let words = words(&command, place.trim_end_matches('/'));
        let words: Vec<&str> = words.iter().map(String::as_str).collect();
        let ran = trueaxis(&words);
        assert_eq!(ran.status, status, "docs/papers.md:{line}: {command}\n{}", ran.err);
    }
}

#[test]
fn a_command_keeps_its_quoted_words() {
    assert_eq!(words("a --at \"X=1 Y=2\" -o OUT/x", "/t"), ["a", "--at", "X=1 Y=2", "-o", "/t/x"]);
    let page = "| x | 1 `trueaxis check a` |\n| y | `trueaxis serve`, tab |\n";
    assert_eq!(commands(page), [(1, 1, "check a".to_owned())]);
}
