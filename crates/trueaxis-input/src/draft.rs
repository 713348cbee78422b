//! A text that grows at its end.

use super::Content;
use std::io;
use std::ops::Range;

/// Bytes that are put one after the other: in the memory, or where who takes them keeps them.
///
/// ```
/// use trueaxis_input::{Draft, Files};
/// let mut draft = Files::none().draft(100);
/// draft.put(b"G0 X1\n");
/// draft.put(b"M30\n");
/// assert_eq!((draft.length(), draft.read(3..5)), (10, b"X1".to_vec()));
/// assert!(draft.finish()?.ends_with(b"M30\n"));
/// # Ok::<(), std::io::Error>(())
/// ```
pub trait Draft: Send {
    /// How many bytes it has.
    fn length(&self) -> usize;

    /// Puts bytes at its end. What the disk has against that is said at the end.
    fn put(&mut self, bytes: &[u8]);

    /// Some of its bytes.
    fn read(&self, range: Range<usize>) -> Vec<u8>;

    /// All of it.
    ///
    /// # Errors
    /// What the disk says.
    fn finish(self: Box<Self>) -> io::Result<Content>;
}

impl Draft for Vec<u8> {
    fn length(&self) -> usize {
        self.len()
    }

    fn put(&mut self, bytes: &[u8]) {
        self.extend_from_slice(bytes);
    }

    fn read(&self, range: Range<usize>) -> Vec<u8> {
        self.get(range).unwrap_or_default().to_vec()
    }

    fn finish(self: Box<Self>) -> io::Result<Content> {
        Ok((*self).into())
    }
}
