//! What a file contains: in the memory, or where its source keeps it.

use std::fmt;
use std::ops::{Deref, Range};
use std::sync::Arc;

/// Bytes that a source keeps elsewhere than in the memory.
pub trait Kept: Send + Sync {
    /// All of them.
    fn bytes(&self) -> &[u8];

    /// These are not needed for now; they are the same when they are read again.
    fn pass(&self, range: Range<usize>);
}

/// The bytes of a file; cheap to clone.
///
/// ```
/// use trueaxis_input::Content;
/// let content = Content::from(b"%\nG0 X1\nM30\n".to_vec());
/// assert_eq!((content.len(), content.without(2).starts_with(b"G0")), (12, true));
/// ```
#[derive(Clone)]
pub struct Content {
    bytes: Bytes,
    /// So many bytes at the beginning do not count.
    from: usize,
}

#[derive(Clone)]
enum Bytes {
    Own(Arc<Vec<u8>>),
    Kept(Arc<dyn Kept>),
}

impl Content {
    /// Bytes that are kept elsewhere.
    pub fn kept(bytes: impl Kept + 'static) -> Self {
        Self { bytes: Bytes::Kept(Arc::new(bytes)), from: 0 }
    }

    /// The same without its first bytes.
    #[must_use]
    pub fn without(self, count: usize) -> Self {
        Self { from: self.from + count.min(self.len()), ..self }
    }

    /// These bytes are not needed for now: what keeps them elsewhere may free its memory. They can be read as before.
    pub fn pass(&self, range: Range<usize>) {
        if let Bytes::Kept(kept) = &self.bytes {
            kept.pass(range.start + self.from..range.end + self.from);
        }
    }

    /// The bytes, in the memory.
    pub fn into_vec(self) -> Vec<u8> {
        match (self.bytes, self.from) {
            (Bytes::Own(own), 0) => Arc::try_unwrap(own).unwrap_or_else(|own| own.to_vec()),
            (Bytes::Own(own), from) => own[from..].to_vec(),
            (Bytes::Kept(kept), from) => kept.bytes()[from..].to_vec(),
        }
    }
}

impl From<Vec<u8>> for Content {
    fn from(bytes: Vec<u8>) -> Self {
        Self { bytes: Bytes::Own(Arc::new(bytes)), from: 0 }
    }
}

impl Default for Content {
    fn default() -> Self {
        Vec::new().into()
    }
}

impl PartialEq for Content {
    fn eq(&self, other: &Self) -> bool {
        **self == **other
    }
}

impl Deref for Content {
    type Target = [u8];

    #[inline]
    fn deref(&self) -> &[u8] {
        let all = match &self.bytes {
            Bytes::Own(own) => own,
            Bytes::Kept(kept) => kept.bytes(),
        };
        &all[self.from..]
    }
}

impl fmt::Debug for Content {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} bytes", self.len())
    }
}
