//! What is said of a part that was made, and of a run, from the files that runs have left.

mod rig;

use rig::{Rig, root, standing};
use std::fs;
use std::path::PathBuf;
use trueaxis::files::disk;
use trueaxis::input::Diagnostics;
use trueaxis::questions::{Answer, Question};
use trueaxis_live::file::{Plan, read_plan};
use trueaxis_live::governor::State;
use trueaxis_live::part::{PartRecorder, part_heading};
use trueaxis_live::parts::LivePart;
use trueaxis_live::start::owner;
use trueaxis_live::status::{LiveState, LiveStatus, live_state, status_json};
use trueaxis_live::store::{DiskStore, StoreFault, ask_datum, begin_part, part_path};

/// A plan whose journal is in a folder of the test.
struct Place {
    folder: PathBuf,
    text: String,
    changes: Vec<(String, String)>,
}

impl Drop for Place {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.folder);
    }
}

impl Place {
    fn new(name: &str) -> Self {
        let folder = std::env::temp_dir().join(format!("trueaxis-{name}-{}", std::process::id()));
        let _ = fs::remove_dir_all(&folder);
        fs::create_dir_all(&folder).expect("a folder");
        let text = fs::read_to_string(root().join("examples/08_live/gantry-mock.toml"));
        let text = text.expect("the example") + &format!("\n[journal]\nfolder = {folder:?}\n");
        Self { folder, text, changes: Vec::new() }
    }

    fn edited(&mut self, old: &str, new: &str) {
        assert!(self.text.contains(old), "{old}");
        self.changes.push((old.to_owned(), new.to_owned()));
    }

    fn files(&self) -> (trueaxis::input::Files, PathBuf) {
        let own = root().join("examples/08_live/changed.toml");
        let text = self.changes.iter().fold(self.text.clone(), |t, (old, new)| t.replace(old, new));
        (disk().with_texts([(own.clone(), text)]), own)
    }

    fn plan(&self) -> Plan {
        let (files, own) = self.files();
        let (plan, problems) = read_plan(&files, &own);
        plan.unwrap_or_else(|| panic!("{:?}", problems.sorted()))
    }

    /// What is said, and what it is warned of or refused with.
    fn ask(&self, question: impl FnOnce(PathBuf) -> Asked) -> (String, Vec<String>) {
        let (files, own) = self.files();
        let mut problems = Diagnostics::new();
        let text = match question(own) {
            Asked::Part(q) => q
                .read(&files, &mut problems)
                .and_then(|input| q.answer(input, &|_| {}, &mut problems))
                .map(|answer| answer.report().text()),
            Asked::Status(q) => q
                .read(&files, &mut problems)
                .and_then(|input| q.answer(input, &|_| {}, &mut problems))
                .map(|answer| answer.report().text()),
        };
        let said = problems.iter().map(|d| format!("{:?} {}: {}", d.severity, d.code, d.message));
        (text.unwrap_or_default(), said.collect())
    }

    fn show(&self) -> (String, Vec<String>) {
        self.ask(|plan| Asked::Part(LivePart { plan, part: Some("P".to_owned()) }))
    }

    fn status(&self, hours: Option<f64>) -> (String, Vec<String>) {
        self.ask(|plan| Asked::Status(LiveStatus { plan, hours }))
    }
}

enum Asked {
    Part(LivePart),
    Status(LiveStatus),
}

/// The column `followed` of a row that is made while the run stands in a state, after its first cycles.
fn followed(changes: &[(&str, &str)]) -> (State, String) {
    let mut rig = Rig::new(standing(changes));
    rig.pass(20.0);
    let mut recorder = PartRecorder::default();
    for _ in 0..10 {
        rig.cycle();
        let cycle = rig.last.as_ref().expect("a cycle");
        recorder.add(&rig.plan, cycle, (rig.run.correction(), false));
    }
    let line = recorder.end().expect("a row");
    (rig.state(), line.split(',').nth(4).expect("followed").to_owned())
}

/// At its limit, or on its way there by a slow slew, the run is in Run and has not its target: by hand 54 and 66 µm are needed.
#[test]
fn law_a_row_has_followed_only_where_the_target_was_reached() {
    assert_eq!(followed(&[]), (State::Run, "1".to_owned()));
    let limit = ("limit = \"600 um\"", "limit = \"60 um\"");
    assert_eq!(followed(&[limit]), (State::Run, "0".to_owned()));
    let slew = ("slew = \"100 um/s\"", "slew = \"1 um/s\"");
    assert_eq!(followed(&[slew]), (State::Run, "0".to_owned()));
}

/// Nothing, a second run, a block of which nothing was known: none of it is "throughout".
#[test]
fn a_record_with_gaps_does_not_say_throughout() {
    const WHOLE: &str = "the correction followed its target throughout";
    let place = Place::new("records-gaps");
    let plan = place.plan();
    begin_part(&place.folder, &plan, "P").expect("begun");
    let (text, said) = place.show();
    assert!(text.contains("nothing is recorded yet") && !text.contains(WHOLE), "{text}");
    assert!(said.is_empty(), "{said:?}");
    let row = |time_s: f64| format!("{time_s:.3},1000,0,1,1,1,0,0,0,0,1,1,0,0,1,1,0,0,20,20,20\n");
    let write = |rows: &str| {
        let text = format!("{}\n{rows}", part_heading(&plan, "P"));
        fs::write(part_path(&place.folder, "P"), text).expect("written");
    };
    write(&[row(1.0), row(2.0)].concat());
    assert!(place.show().0.contains(WHOLE), "{}", place.show().0);
    write(&[row(8.0), row(9.0), row(0.5), row(1.0)].concat());
    let (text, _) = place.show();
    assert!(
        text.contains("1 times another run went on with it") && !text.contains(WHOLE),
        "{text}"
    );
    // The second run has gone on for longer before its first row.
    let later = row(10.0).replace(",1000,", ",1030,");
    write(&[row(8.0), row(9.0), later].concat());
    assert!(place.show().0.contains("1 times another run went on with it"));
    write(&[row(1.0), "# program 0, block 7: no target\n".to_owned(), row(2.0)].concat());
    let (text, _) = place.show();
    assert!(
        text.contains("1 blocks of which nothing was known") && !text.contains(WHOLE),
        "{text}"
    );
}

/// A record of another plan: with other axes or sensors it is refused, edited it is warned of.
#[test]
fn a_record_of_another_plan_is_not_shown_as_one_of_this() {
    let mut place = Place::new("records-plan");
    begin_part(&place.folder, &place.plan(), "P").expect("begun");
    assert_eq!(place.show().1, Vec::<String>::new());
    place.edited("step = \"10 um\"", "step = \"5 um\"");
    let (text, said) = place.show();
    assert!(
        !text.is_empty() && said.len() == 1 && said[0].starts_with("Warning live-part"),
        "{said:?}"
    );
    let from = place.text.find("[axis.Y]").expect("Y");
    let to = place.text.find("[cycle]").expect("what follows");
    let axis = place.text[from..to].to_owned().replace("step = \"10 um\"", "step = \"5 um\"");
    place.changes.push((axis, String::new()));
    let (text, said) = place.show();
    assert!(
        text.is_empty() && said.len() == 1 && said[0].starts_with("Error live-part"),
        "{said:?}"
    );
}

fn state(rig: &Rig, date_s: u64) -> LiveState {
    let (cycle, correction) = (rig.last.as_ref().expect("a cycle"), rig.run.correction());
    let state = live_state(&rig.plan, &rig.identity, cycle, correction, rig.run.counts());
    LiveState { date_s, ..state }
}

/// A run that stands still, a state of another plan, a state that is cut: said, not shown as of now.
#[test]
fn a_state_that_is_not_of_now_says_so() {
    let mut place = Place::new("records-status");
    let mut rig = Rig::new(place.plan());
    rig.pass(3.0);
    let now_s = trueaxis_live::clock::date_s();
    let file = place.folder.join("state.json");
    let write = |date_s: u64| {
        let state = status_json(&rig.plan, true, Some(state(&rig, date_s)));
        fs::write(&file, state.to_string()).expect("written");
    };
    assert!(place.status(None).0.contains("it has not run here"));
    let (_store, _) = {
        let owner = owner(&rig.plan, &rig.identity);
        DiskStore::open_beside(None, &place.folder, &owner).expect("a run")
    };
    write(now_s);
    let (text, said) = place.status(None);
    assert!(text.contains("running") && said.is_empty(), "{text} {said:?}");
    write(now_s - 40);
    let (text, said) = place.status(Some(1.0 / 60.0));
    assert!(
        said.len() == 1 && said[0].contains("for 4") && said[0].starts_with("Warning"),
        "{said:?}"
    );
    assert!(text.contains("its state of 4") && text.contains("The last 1.0 min"), "{text}");
    assert!(text.contains("Nothing was recorded in that time."), "{text}");
    write(now_s);
    place.edited("step = \"10 um\"", "step = \"5 um\"");
    let (_, said) = place.status(None);
    assert!(said.len() == 1 && said[0].contains("another plan"), "{said:?}");
    fs::write(&file, "{\"schema\": \"trueaxis/live-sta").expect("written");
    let (text, said) = place.status(None);
    assert!(text.is_empty() && said[0].starts_with("Error live-state"), "{text} {said:?}");
}

/// A run writes over nothing and removes nothing that a person has made.
#[test]
fn law_a_folder_of_a_person_is_refused() {
    let rig = Rig::new(standing(&[]));
    let owner = owner(&rig.plan, &rig.identity);
    for name in [
        "state.json",
        "metrics.prom",
        "stop",
        "datum-asked",
        "history.csv",
        "history-before.csv",
        "owned",
        "heat.json",
    ] {
        let place = Place::new(&format!("records-own-{name}"));
        fs::write(place.folder.join(name), "a person's").expect("written");
        let opened = DiskStore::open_beside(None, &place.folder, &owner);
        assert!(matches!(opened, Err(StoreFault::Foreign(found)) if found.0 == name), "{name}");
        let text = fs::read_to_string(place.folder.join(name)).expect("it is there");
        let files = fs::read_dir(&place.folder).expect("a folder").count();
        assert_eq!((text.as_str(), files), ("a person's", 1), "{name}");
    }
    let place = Place::new("records-own-datum");
    fs::write(place.folder.join("datum.json"), "a person's").expect("written");
    assert!(ask_datum(&place.folder, true, false).is_err());
    assert!(place.folder.join("datum.json").exists());
    // What a run has made, the next one goes on with.
    let place = Place::new("records-own");
    drop(DiskStore::open_beside(None, &place.folder, &owner).expect("opened"));
    fs::write(place.folder.join("stop"), "").expect("written");
    assert!(DiskStore::open_beside(None, &place.folder, &owner).is_ok());
    assert!(!place.folder.join("stop").exists());
}
