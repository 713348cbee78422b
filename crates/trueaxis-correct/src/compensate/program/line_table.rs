//! Where the lines of a program begin, and what their words are.

use super::words::Words;
use rayon::prelude::*;
use std::ops::Range;
use trueaxis_nc::Program;
use trueaxis_nc::lexer::Token;

/// Bytes that are searched for line ends by one task.
const BLOCK: usize = 1 << 20;

/// The lines of a program.
pub(super) struct LineTable<'p> {
    program: &'p Program,
    starts: Vec<usize>,
}

impl<'p> LineTable<'p> {
    pub fn of(program: &'p Program) -> Self {
        let source = program.source();
        let blocks = source.par_chunks(BLOCK).enumerate();
        let begun: Vec<Vec<usize>> =
            blocks.map(|(k, block)| begun_in(source, k * BLOCK, block)).collect();
        let starts = std::iter::once(0).chain(begun.into_iter().flatten()).collect();
        Self { program, starts }
    }

    pub fn program(&self) -> &'p Program {
        self.program
    }

    pub fn source(&self) -> &'p [u8] {
        self.program.source()
    }

    /// How many there are.
    pub fn count(&self) -> usize {
        self.starts.len()
    }

    /// The bytes of the line with an index, with its end.
    pub fn whole(&self, index: usize) -> Range<usize> {
        let at = |index: usize| self.starts.get(index).copied().unwrap_or(self.source().len());
        at(index)..at(index + 1)
    }

    /// The bytes of a line from 1, without its end.
    pub fn line(&self, line: u32) -> Range<usize> {
        let Range { start, mut end } = self.whole(line as usize - 1);
        while end > start && matches!(self.source()[end - 1], b'\n' | b'\r') {
            end -= 1;
        }
        start..end
    }

    /// The end of a line from 1.
    pub fn ending(&self, line: u32) -> &'p [u8] {
        &self.source()[self.line(line).end..self.whole(line as usize - 1).end]
    }

    /// The words of a line from 1, as they are written.
    pub fn words(&self, line: u32) -> Words {
        self.words_with(line, &mut Vec::new())
    }

    /// The same with room for its tokens that is used again.
    pub fn words_with(&self, line: u32, tokens: &mut Vec<Token>) -> Words {
        Words::read_with(self.source(), self.program.dialect(), self.line(line), tokens)
    }
}

/// The lines that begin after a line end of a block.
fn begun_in(source: &[u8], from: usize, block: &[u8]) -> Vec<usize> {
    let ends = |(i, byte): &(usize, &u8)| match byte {
        b'\n' => true,
        b'\r' => source.get(i + 1) != Some(&b'\n'),
        _ => false,
    };
    let bytes = (from..).zip(block);
    bytes.filter(ends).map(|(i, _)| i + 1).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use trueaxis_nc::Control;

    /// Two line ends of two bytes on both sides of a border of blocks, and one of one byte after it.
    #[test]
    fn lines_begin_after_any_line_end() {
        let mut source = vec![b'X'; 2 * BLOCK];
        source[BLOCK - 1] = b'\r';
        source[BLOCK] = b'\n';
        source[BLOCK + 5] = b'\r';
        source[2 * BLOCK - 1] = b'\n';
        let program = Program::new("a.nc", source, Control::Fanuc);
        let table = LineTable::of(&program);
        assert_eq!(table.starts, [0, BLOCK + 1, BLOCK + 6, 2 * BLOCK]);
        assert_eq!(table.line(1), 0..BLOCK - 1);
        assert_eq!(table.ending(1), b"\r\n");
        assert_eq!(table.ending(2), b"\r");
        assert_eq!(table.whole(3), 2 * BLOCK..2 * BLOCK);
    }
}
