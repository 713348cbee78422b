//! Journals that are lost: damaged, removed, or of a plan that has another name now. The correction is never added to itself.

mod rig;

use rig::{Rig, standing};
use std::fs;
use std::path::{Path, PathBuf};
use trueaxis_live::governor::{Earlier, Owned, State};
use trueaxis_live::start::owner;
use trueaxis_live::store::{DiskStore, Event, Owner, Store};

/// Without a watchdog: what a killed run has written stays.
const EXT: (&str, &str) = ("lever = \"pmc\"", "lever = \"ext\"");

struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("trueaxis-{name}-{}", std::process::id()));
        let _ = fs::remove_dir_all(&path);
        fs::create_dir_all(&path).expect("a folder");
        Self(path)
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

/// What happens to a file.
type Damage = fn(&Path);

/// The journal of a run that was killed while it followed.
fn killed(folder: &Path, owner: &Owner, owned: &Owned) {
    let (mut store, earlier) = DiskStore::open_beside(None, folder, owner).expect("opened");
    assert_eq!(earlier, Earlier::Nothing);
    for _ in 0..3 {
        store.own(owned).expect("kept");
    }
    let (event, what) = (State::Run.to_string(), "follows its target".to_owned());
    let event = Event { at_s: 1.0, date_s: 1, event, what, offsets: owned.last.clone() };
    store.event(&event).expect("kept");
}

/// A run that has settled on EXT, and what it owns.
fn settled() -> (Rig, Owner, Owned) {
    let rig = Rig::settled(standing(&[EXT]));
    let owned = rig.store.0.borrow().owned.clone().expect("something is owned");
    let owner = owner(&rig.plan, &rig.identity);
    (rig, owner, owned)
}

/// The next run on the same control.
fn again(rig: Rig, earlier: Earlier) -> Rig {
    let Rig { plan, clock, mock, .. } = rig;
    let mut rig = Rig::on(plan, mock, clock, earlier);
    rig.pass(10.0);
    rig
}

/// Zeros after a power cut, nothing at all, another text: a run that has not ended has left something, and what of the offset is
/// its own is not known. It latches; confirmed, what stands there counts as ours, and the offset is not doubled.
#[test]
fn law_a_journal_that_is_lost_never_doubles_the_correction() {
    let (mut rig, owner, owned) = settled();
    let there = rig.acting();
    assert!(there[0] > 50, "{there:?}");
    let damages: [(&str, Damage); 5] = [
        ("none", |_| {}),
        ("zeros", |file| fs::write(file, [0; 4096]).expect("written")),
        ("empty", |file| fs::write(file, "").expect("written")),
        ("removed", |file| fs::remove_file(file).expect("removed")),
        ("text", |file| fs::write(file, "00000000 {}").expect("written")),
    ];
    for (name, damage) in damages {
        let folder = Folder::new(&format!("journal-{name}"));
        killed(&folder.0, &owner, &owned);
        damage(&folder.0.join("owned"));
        let (_, earlier) = DiskStore::open_beside(None, &folder.0, &owner).expect("opened");
        rig = again(rig, earlier.clone());
        assert_eq!(rig.acting(), there, "{name}: {}", rig.story());
        if name == "none" {
            assert_eq!((&earlier, rig.state()), (&Earlier::Owned(owned.clone()), State::Run));
            continue;
        }
        assert_eq!((&earlier, rig.state()), (&Earlier::Lost, State::Latched), "{name}");
        rig.wish.confirmed = true;
        rig.pass(10.0);
        assert_eq!((rig.state(), rig.acting()), (State::Run, there.clone()), "{name}");
    }
}

/// A run that has come to its end has left nothing: what stands there is another's, and is the base.
#[test]
fn a_run_that_has_ended_has_left_nothing() {
    let (rig, owner, owned) = settled();
    let folder = Folder::new("journal-ended");
    killed(&folder.0, &owner, &owned);
    fs::remove_file(folder.0.join("owned")).expect("removed");
    let (mut store, _) = DiskStore::open_beside(None, &folder.0, &owner).expect("opened");
    let (event, what) = (State::Off.to_string(), "not asked for".to_owned());
    let offsets = vec![0, 0];
    store.event(&Event { at_s: 9.0, date_s: 9, event, what, offsets }).expect("kept");
    // What is said of a part afterwards is no state.
    let (event, what) = ("part".to_owned(), "the record of P ends".to_owned());
    store.event(&Event { at_s: 9.0, date_s: 9, event, what, offsets: vec![] }).expect("kept");
    drop(store);
    let (_, earlier) = DiskStore::open_beside(None, &folder.0, &owner).expect("opened");
    assert_eq!(earlier, Earlier::Nothing);
    drop(rig);
}

/// A plan that was renamed has another folder: what the run of the old one has left is taken over.
#[test]
fn law_a_plan_that_is_renamed_never_doubles_the_correction() {
    let (rig, owner, owned) = settled();
    let there = rig.acting();
    let root = Folder::new("journal-root");
    let [old, new, third] = ["a", "b", "c"].map(|name| root.0.join(name));
    killed(&old, &owner, &owned);
    let open = |folder: &Path, owner: &Owner| {
        DiskStore::open_beside(Some(&root.0), folder, owner).expect("opened").1
    };
    // Of another machine, or another control, it is nothing.
    let mut other = owner.clone();
    other.machine = "another".to_owned();
    assert_eq!(open(&third, &other), Earlier::Nothing);
    let mut other = owner.clone();
    other.control.version = "02.0".to_owned();
    assert_eq!(open(&third, &other), Earlier::Nothing);
    // Of other axes no one knows which offset is whose.
    let mut other = owner.clone();
    other.axes.pop();
    assert_eq!(open(&third, &other), Earlier::Lost);
    let earlier = open(&new, &owner);
    assert_eq!(earlier, Earlier::Owned(owned));
    let rig = again(rig, earlier);
    assert_eq!((rig.state(), rig.acting()), (State::Run, there));
    // Its own folder is not that of another plan, and one that has ended has left nothing.
    let (mut store, _) = DiskStore::open_beside(None, &old, &owner).expect("opened");
    store.own(&Owned { base: vec![0; 2], last: vec![0; 2], before: vec![0; 2] }).expect("kept");
    drop(store);
    assert_eq!(open(&third, &owner), Earlier::Nothing);
}
