//! One folder, and nothing outside it: for a program that reads and writes on behalf of others.

use std::borrow::Cow;
use std::cell::RefCell;
use std::collections::BTreeSet;
use std::path::{Component, Path, PathBuf};
use std::{fs, io};

thread_local! {
    /// The folders of the scopes that this thread is in, without links; `None` for one that is not there.
    static ROOTS: RefCell<Vec<Option<PathBuf>>> = const { RefCell::new(Vec::new()) };
    /// What was looked for in the scopes of this thread, where that is noted.
    static NOTED: RefCell<Option<BTreeSet<PathBuf>>> = const { RefCell::new(None) };
}

/// While `work` runs, every file that this crate reads, writes or looks for on this thread must lie below
/// `root`, after all links and `..` are followed; anything else is an error "lies outside the project
/// folder". Only ordinary files are opened, so that no pipe or device can stop the work. A scope within a
/// scope can only be narrower: a file must lie below both folders. Where `root` is no folder, nothing
/// can be read or written.
///
/// The scope ends when `work` returns or panics.
///
/// It does not guard
/// - *other threads*, those of rayon among them: none of this crate's parallel work opens files, so it is
///   enough to call this where the work is asked for; but not within a job of a rayon pool, which may
///   take up other work meanwhile;
/// - *races*: between the check of a path and its use another process that may write below `root` can put a
///   link there that leads outside; hard links, which have no outside, are files like others;
/// - *other crates*: what does not go through this crate is not seen.
///
/// ```
/// use trueaxis_files as files;
/// let folder = std::env::temp_dir();
/// let outside = files::within(&folder, || files::read_bytes("/etc/passwd".as_ref()));
/// assert!(outside.is_err());
/// ```
pub fn within<T>(root: &Path, work: impl FnOnce() -> T) -> T {
    /// Leaves the scope, on a panic too.
    struct Leave;
    impl Drop for Leave {
        fn drop(&mut self) {
            ROOTS.with_borrow_mut(Vec::pop);
        }
    }
    let real = root.canonicalize().ok().filter(|folder| folder.is_dir());
    ROOTS.with_borrow_mut(|roots| roots.push(real));
    let _leave = Leave;
    work()
}

/// The same, and the files below `root` that were read or looked for, by their way from there: those that are missing, too, as
/// an answer changes where one of them comes.
///
/// ```
/// use trueaxis_files as files;
/// let folder = std::env::temp_dir();
/// let (_, asked) = files::noted_within(&folder, || files::is_file(&folder.join("part.setup.toml")));
/// assert_eq!(asked, ["part.setup.toml"]);
/// ```
pub fn noted_within<T>(root: &Path, work: impl FnOnce() -> T) -> (T, Vec<String>) {
    /// What was noted before is noted again, after a panic too.
    struct Before(Option<BTreeSet<PathBuf>>);
    impl Drop for Before {
        fn drop(&mut self) {
            NOTED.set(self.0.take());
        }
    }
    let _before = Before(NOTED.replace(Some(BTreeSet::new())));
    let done = within(root, work);
    let noted = NOTED.take().unwrap_or_default();
    let real = root.canonicalize().unwrap_or_default();
    let named = |path: &PathBuf| {
        let below = path.strip_prefix(&real).ok()?;
        Some(below.to_string_lossy().replace('\\', "/"))
    };
    let mut names: Vec<String> = noted.iter().filter_map(named).collect();
    names.retain(|name| !name.is_empty());
    (done, names)
}

/// Notes a file by the path that it is called by, without `.` and `..`, and without links if it is there.
fn note(path: &Path) {
    NOTED.with_borrow_mut(|noted| {
        let Some(noted) = noted else { return };
        let here = Path::new(".").canonicalize().unwrap_or_default();
        let mut plain = PathBuf::new();
        for part in here.join(path).components() {
            match part {
                Component::ParentDir => drop(plain.pop()),
                Component::CurDir => {}
                part => plain.push(part),
            }
        }
        noted.extend(path.canonicalize().ok());
        noted.insert(plain);
    });
}

/// The path under which a file may be read: as it is, or without links in a scope.
///
/// # Errors
/// It lies outside the folder of the scope, or cannot be found there.
pub(crate) fn readable(path: &Path) -> io::Result<Cow<'_, Path>> {
    if is_free() {
        return Ok(Cow::Borrowed(path));
    }
    note(path);
    let real = path.canonicalize().map_err(|error| unless_outside(path, error))?;
    inside(&real)?;
    match fs::metadata(&real)?.is_file() {
        true => Ok(Cow::Owned(real)),
        false => Err(io::Error::new(io::ErrorKind::InvalidInput, "is not an ordinary file")),
    }
}

/// The path under which a file may be written: its folder stands there already.
///
/// # Errors
/// Its folder, or what stands at its place, lies outside the folder of the scope.
pub(crate) fn writable(path: &Path) -> io::Result<Cow<'_, Path>> {
    if is_free() {
        return Ok(Cow::Borrowed(path));
    }
    let Some(name) = path.file_name() else {
        return Err(io::Error::new(io::ErrorKind::InvalidInput, "the path does not name a file"));
    };
    let folder = match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    let real = folder.canonicalize().map_err(|error| unless_outside(folder, error))?;
    inside(&real)?;
    let mut place = real.join(name);
    if fs::symlink_metadata(&place).is_ok() {
        // Where a link leads, so that it stays a link.
        place = place.canonicalize()?;
        inside(&place)?;
    }
    Ok(Cow::Owned(place))
}

/// Makes the folder of a file where it is missing, if the deepest folder that is there may be written.
pub(crate) fn make_folder_of(path: &Path) -> io::Result<()> {
    let Some(folder) = path.parent().filter(|folder| !folder.as_os_str().is_empty()) else {
        return Ok(());
    };
    let there = folder.ancestors().find(|f| f.as_os_str().is_empty() || f.is_dir());
    let there = there.filter(|f| !f.as_os_str().is_empty()).unwrap_or(Path::new("."));
    if !is_free() {
        inside(&there.canonicalize().map_err(|error| unless_outside(there, error))?)?;
        // A missing folder leads down only.
        let missing = folder.strip_prefix(there).unwrap_or(folder);
        let is_plain =
            |part: Component<'_>| matches!(part, Component::Normal(_) | Component::CurDir);
        if !missing.components().all(is_plain) {
            return Err(outside());
        }
    }
    fs::create_dir_all(folder)
}

/// No scope: a command of its own user.
fn is_free() -> bool {
    ROOTS.with_borrow(Vec::is_empty)
}

fn inside(real: &Path) -> io::Result<()> {
    let below = |root: &Option<PathBuf>| root.as_ref().is_some_and(|root| real.starts_with(root));
    match ROOTS.with_borrow(|roots| roots.iter().all(below)) {
        true => Ok(()),
        false => Err(outside()),
    }
}

fn outside() -> io::Error {
    io::Error::new(io::ErrorKind::PermissionDenied, "lies outside the project folder")
}

/// A missing file is reported only inside; nothing is disclosed about places outside.
fn unless_outside(path: &Path, error: io::Error) -> io::Error {
    let here = Path::new(".").canonicalize().unwrap_or_default();
    let absolute = here.join(path);
    let nearest = absolute.ancestors().find_map(|folder| folder.canonicalize().ok());
    match nearest.is_some_and(|folder| inside(&folder).is_ok()) {
        true => error,
        false => outside(),
    }
}
