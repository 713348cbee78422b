//! A store in a folder of its own: `lock`, `owned`, `journal.jsonl`, `state.json`, `metrics.prom`, `history.csv`,
//! `datum.json`, `heat.json`, `parts/`, `part`, `stop`.
//!
//! The journal only grows by events, never by cycles.

use super::datum::{KeptDatums, asked, keep};
use super::foreign::{Foreign, foreign_file};
use super::heat::{KEPT, KeptHeat};
use super::history::history_file;
use super::kept::kept;
use super::latest::Latest;
use super::lines::Lines;
use super::owned::{OWNED, OwnedFile, checksum, left_elsewhere};
use super::part::{part_file, part_now};
use super::{Event, Owner, Store};
use crate::clock::date_s;
use crate::control::Identity;
use crate::cycle::CycleInput;
use crate::datum::DatumOrder;
use crate::governor::{Earlier, Order, Owned, STATES, State};
use crate::memory::HeatOfRun;
use crate::setups::SetupDatum;
use serde_json::Value;
use std::fs::{self, File, OpenOptions};
use std::io::{self, BufWriter, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

const STATE: &str = "state.json";
/// Its presence asks a run for its end.
const STOP: &str = "stop";
/// Why a store cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum StoreFault {
    /// Another run holds it.
    #[error("another run holds this folder")]
    Held,
    /// It is of another machine, control or set of axes.
    #[error("it is of {0}")]
    Other(String),
    /// No run has made it, and a file in it has a name that runs write over or remove.
    #[error("{0}")]
    Foreign(Foreign),
    /// The disk.
    #[error("it cannot be opened: {0}")]
    Disk(#[from] io::Error),
}

/// The journal of one machine on the disk.
#[derive(Debug)]
pub struct DiskStore {
    folder: PathBuf,
    owner: Owner,
    owned: OwnedFile,
    journal: File,
    record: Option<BufWriter<File>>,
    state: Latest,
    metrics: Latest,
    heat: Latest,
    history: Option<Lines>,
    part: Option<Lines>,
    /// The plan that a zero of the part belongs to.
    plan_hash: String,
    /// Held as long as the run lasts.
    _lock: File,
}

/// The folder of a plan where none is stated: that of the user for such files, by the name of the machine and the place of
/// the plan; none where the system names no such folder.
pub fn own_folder(plan: &Path, machine: &str) -> Option<PathBuf> {
    let whole = fs::canonicalize(plan).or_else(|_| std::path::absolute(plan)).ok()?;
    let sum = checksum(whole.as_os_str().as_encoded_bytes());
    let safe = |c: char| if c.is_ascii_alphanumeric() { c } else { '-' };
    let name: String = machine.chars().map(safe).take(40).collect();
    Some(own_root()?.join(format!("{name}-{sum:08x}")))
}

/// Where the folders of all plans are that state none.
fn own_root() -> Option<PathBuf> {
    let variable = |name| std::env::var_os(name).filter(|v| !v.is_empty()).map(PathBuf::from);
    let state =
        variable("XDG_STATE_HOME").or_else(|| Some(variable("HOME")?.join(".local/state")))?;
    Some(state.join("trueaxis/live"))
}

/// Whether the last run that has written this journal did not come to its end.
fn was_running(folder: &Path) -> bool {
    let states = STATES.map(|state| state.to_string());
    let events = last_events(folder, usize::MAX);
    let last = events.iter().rev().find(|event| states.contains(&event.event));
    last.is_some_and(|event| event.event != State::Off.to_string())
}

/// Whether a run holds this folder.
pub fn is_running(folder: &Path) -> bool {
    let lock = File::open(folder.join("lock"));
    lock.is_ok_and(|file| matches!(file.try_lock(), Err(fs::TryLockError::WouldBlock)))
}

/// Asks a run for its end: it looks once a second.
///
/// # Errors
/// What the disk says.
pub fn ask_stop(folder: &Path) -> io::Result<()> {
    File::create(folder.join(STOP)).map(drop)
}

/// The state that the last run has left.
///
/// # Errors
/// A file that cannot be read.
pub fn last_state(folder: &Path) -> Result<Option<Value>, String> {
    kept(folder, STATE)
}

/// Bytes at the end of the journal that its last events are looked for in.
const TAIL: u64 = 1 << 16;

/// The last events of the journal, the oldest first.
pub fn last_events(folder: &Path, most: usize) -> Vec<Event> {
    let mut bytes = Vec::new();
    let Ok(mut file) = File::open(folder.join("journal.jsonl")) else { return Vec::new() };
    let size = file.metadata().map_or(0, |known| known.len());
    let placed = file.seek(SeekFrom::Start(size.saturating_sub(TAIL)));
    if placed.and_then(|_| file.take(TAIL).read_to_end(&mut bytes)).is_err() {
        return Vec::new();
    }
    // The first line may be cut, and is then no event.
    let text = String::from_utf8_lossy(&bytes);
    let events: Vec<Event> = text.lines().filter_map(|l| serde_json::from_str(l).ok()).collect();
    events[events.len().saturating_sub(most)..].to_vec()
}

#[cfg(unix)]
fn make(folder: &Path) -> io::Result<()> {
    use std::os::unix::fs::DirBuilderExt;
    // For its owner only.
    fs::DirBuilder::new().recursive(true).mode(0o700).create(folder)
}

#[cfg(not(unix))]
fn make(folder: &Path) -> io::Result<()> {
    fs::create_dir_all(folder)
}

impl DiskStore {
    /// Opens the folder for one run, and gives what an earlier one has left in the control.
    ///
    /// # Errors
    /// [`StoreFault`].
    pub fn open(folder: &Path, owner: &Owner) -> Result<(Self, Earlier), StoreFault> {
        Self::open_beside(own_root().as_deref(), folder, owner)
    }

    /// The same; where the folders of other plans are, it looks for what a run of one of them has left in this control.
    ///
    /// # Errors
    /// [`StoreFault`].
    pub fn open_beside(
        others: Option<&Path>,
        folder: &Path,
        owner: &Owner,
    ) -> Result<(Self, Earlier), StoreFault> {
        make(folder)?;
        if let Some(name) = foreign_file(folder) {
            return Err(StoreFault::Foreign(name));
        }
        let open = |name: &str| {
            OpenOptions::new()
                .read(true)
                .write(true)
                .create(true)
                .truncate(false)
                .open(folder.join(name))
        };
        let lock = open("lock")?;
        match lock.try_lock() {
            Ok(()) => {}
            Err(fs::TryLockError::WouldBlock) => return Err(StoreFault::Held),
            Err(fs::TryLockError::Error(error)) => return Err(error.into()),
        }
        // What was asked of an earlier run.
        let _ = asked(folder);
        match fs::remove_file(folder.join(STOP)) {
            Err(error) if error.kind() != io::ErrorKind::NotFound => return Err(error.into()),
            _ => {}
        }
        let (owned, left) = OwnedFile::open(open(OWNED)?)?;
        if let Some((other, _)) = left.as_ref().filter(|(other, _)| other != owner) {
            let Owner { machine, control, axes } = other;
            let Identity { kind, series, version, .. } = control;
            let axes = axes.join(" ");
            return Err(StoreFault::Other(format!(
                "{machine}, control {kind} {series} {version}, axes {axes}"
            )));
        }
        let earlier = match left {
            Some((_, left)) => Earlier::Owned(left),
            None if owned.is_damaged() || was_running(folder) => Earlier::Lost,
            // A plan that was renamed or moved has another folder.
            None => others.map_or(Earlier::Nothing, |root| left_elsewhere(root, folder, owner)),
        };
        let journal =
            OpenOptions::new().append(true).create(true).open(folder.join("journal.jsonl"))?;
        let store = Self {
            folder: folder.to_owned(),
            owner: owner.clone(),
            owned,
            journal,
            record: None,
            state: Latest::of(folder.join(STATE)),
            metrics: Latest::of(folder.join("metrics.prom")),
            heat: Latest::of(folder.join(KEPT)),
            history: None,
            part: None,
            plan_hash: String::new(),
            _lock: lock,
        };
        Ok((store, earlier))
    }

    /// The same for a plan: a zero of the part belongs to it.
    #[must_use]
    pub fn of_plan(mut self, hash: &str) -> Self {
        self.plan_hash = hash.to_owned();
        self
    }

    /// Records every cycle into this new file: a record that is there already stays.
    ///
    /// # Errors
    /// What the disk says.
    pub fn record_into(&mut self, path: &Path) -> io::Result<()> {
        self.record = Some(BufWriter::new(File::create_new(path)?));
        Ok(())
    }

    /// Where it is.
    pub fn folder(&self) -> &Path {
        &self.folder
    }
}

impl Store for DiskStore {
    fn own(&mut self, owned: &Owned) -> Result<(), String> {
        self.owned.add(&self.owner, owned)
    }

    fn event(&mut self, event: &Event) -> Result<(), String> {
        let line = serde_json::to_string(event).map_err(|e| e.to_string())? + "\n";
        self.journal.write_all(line.as_bytes()).map_err(|e| e.to_string())
    }

    fn state(&mut self, document: &Value) -> Result<(), String> {
        self.state.put(format!("{document:#}\n"))
    }

    fn metrics(&mut self, text: String) -> Result<(), String> {
        self.metrics.put(text)
    }

    fn datums(&mut self, all: &[SetupDatum]) -> Result<(), String> {
        let kept = (!all.is_empty()).then(|| KeptDatums {
            plan_hash: self.plan_hash.clone(),
            date_s: date_s(),
            zeros: all.to_vec(),
        });
        keep(&self.folder, kept.as_ref())
    }

    fn datum_order(&mut self) -> Option<DatumOrder> {
        asked(&self.folder)
    }

    fn history(&mut self, heading: &str, line: String) {
        let new = || history_file(self.folder.clone(), heading.to_owned());
        self.history.get_or_insert_with(new).add(line);
    }

    fn heat(&mut self, heat: HeatOfRun) -> Result<(), String> {
        let kept = KeptHeat { machine: self.owner.machine.clone(), date_s: date_s(), heat };
        self.heat.put(serde_json::to_string(&kept).map_err(|error| error.to_string())?)
    }

    fn part(&mut self) -> Option<String> {
        part_now(&self.folder)
    }

    fn open_part(&mut self, part: Option<&str>, heading: &str) -> Result<(), String> {
        self.part = None;
        self.part = part.map(|name| part_file(&self.folder, name, heading)).transpose()?;
        Ok(())
    }

    fn part_line(&mut self, line: String) -> Result<(), String> {
        match self.part.as_ref().is_none_or(|part| part.add(line)) {
            true => Ok(()),
            false => Err("the disk took no line more, or the record is full".to_owned()),
        }
    }

    fn is_stop_asked(&mut self) -> bool {
        self.folder.join(STOP).exists()
    }

    fn record(&mut self, input: &CycleInput, order: &Order) -> Result<(), String> {
        let Some(file) = &mut self.record else { return Ok(()) };
        let line = serde_json::to_string(&(input, order)).map_err(|e| e.to_string())? + "\n";
        file.write_all(line.as_bytes()).map_err(|e| e.to_string())
    }
}
