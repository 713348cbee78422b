//! Lines that are written beside the loop, which must not wait for a disk.

use std::io;
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::thread::JoinHandle;

/// A file that lines go into; the last one is in it once this is dropped.
#[derive(Debug)]
pub(super) struct Lines {
    lines: Option<SyncSender<String>>,
    writer: Option<JoinHandle<()>>,
}

impl Lines {
    /// Written by a thread of their own; so many may wait while the disk is busy.
    pub fn by(
        write: impl FnOnce(&Receiver<String>) -> io::Result<()> + Send + 'static,
        most_waiting: usize,
    ) -> Self {
        let (lines, waiting) = sync_channel(most_waiting);
        let writer = std::thread::spawn(move || {
            // A file that takes no more does not end a run: the next line is not taken either.
            let _ = write(&waiting);
        });
        Self { lines: Some(lines), writer: Some(writer) }
    }

    /// One line more; whether it was taken.
    pub fn add(&self, line: String) -> bool {
        self.lines.as_ref().is_some_and(|lines| lines.try_send(line).is_ok())
    }
}

impl Drop for Lines {
    fn drop(&mut self) {
        self.lines = None;
        if let Some(writer) = self.writer.take() {
            // A writer that has panicked has nothing more to say.
            let _ = writer.join();
        }
    }
}
