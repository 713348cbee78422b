//! What the typesetter sees: the layout, the content, the fonts; no disk and no clock.

use std::collections::HashMap;
use std::sync::OnceLock;
use typst::diag::{FileError, FileResult};
use typst::foundations::{Bytes, Datetime, Duration};
use typst::syntax::{FileId, RootedPath, Source, VirtualPath, VirtualRoot};
use typst::text::{Font, FontBook};
use typst::utils::LazyHash;
use typst::{Library, LibraryExt, World};

/// The look of a report.
const LAYOUT: &str = include_str!("report.typ");

pub(super) struct Sheet {
    library: LazyHash<Library>,
    book: LazyHash<FontBook>,
    fonts: Vec<Font>,
    layout: Source,
    files: HashMap<FileId, Bytes>,
}

impl Sheet {
    /// The layout with its files by name.
    pub(super) fn new(files: Vec<(String, Vec<u8>)>, fonts: Vec<Font>) -> Self {
        let files =
            files.into_iter().filter_map(|(name, bytes)| Some((id(&name)?, Bytes::new(bytes))));
        let layout = Source::detached(LAYOUT);
        Self {
            library: LazyHash::new(Library::default()),
            book: LazyHash::new(FontBook::from_fonts(&fonts)),
            fonts,
            layout,
            files: files.collect(),
        }
    }

    /// The same with more fonts after its own.
    pub(super) fn with_fonts(mut self, more: Vec<Font>) -> Self {
        self.fonts.extend(more);
        self.book = LazyHash::new(FontBook::from_fonts(&self.fonts));
        self
    }
}

fn id(name: &str) -> Option<FileId> {
    Some(RootedPath::new(VirtualRoot::Project, VirtualPath::new(name).ok()?).intern())
}

impl World for Sheet {
    fn library(&self) -> &LazyHash<Library> {
        &self.library
    }

    fn book(&self) -> &LazyHash<FontBook> {
        &self.book
    }

    fn main(&self) -> FileId {
        self.layout.id()
    }

    fn source(&self, id: FileId) -> FileResult<Source> {
        if id == self.layout.id() { Ok(self.layout.clone()) } else { Err(FileError::NotSource) }
    }

    fn file(&self, id: FileId) -> FileResult<Bytes> {
        self.files.get(&id).cloned().ok_or(FileError::AccessDenied)
    }

    fn font(&self, index: usize) -> Option<Font> {
        self.fonts.get(index).cloned()
    }

    fn today(&self, _offset: Option<Duration>) -> Option<Datetime> {
        None
    }
}

/// The fonts in this program.
pub(super) fn own_fonts() -> &'static Vec<Font> {
    static FONTS: OnceLock<Vec<Font>> = OnceLock::new();
    FONTS.get_or_init(|| {
        typst_assets::fonts().flat_map(|data| Font::iter(Bytes::new(data))).collect()
    })
}

/// The fonts of this computer.
pub(super) fn fonts_of_system() -> Vec<Font> {
    let mut found = fontdb::Database::new();
    found.load_system_fonts();
    let font = |face: &fontdb::FaceInfo| {
        let load = |data: &[u8], index| Font::new(Bytes::new(data.to_vec()), index);
        found.with_face_data(face.id, load).flatten()
    };
    found.faces().filter_map(font).collect()
}
