//! Lines of plain words.

use super::{MOST_ITEMS, Parser};
use crate::lexer::TokenKind;
use crate::program::{Item, Node};

impl Parser<'_, '_> {
    /// The words of a line that are a letter and a plain number, such as N10 and.
    ///
    /// Blocks of SINUMERIK programs have expressions, key words and calls besides; these are left
    /// out here: what they mean is known when they are executed.
    pub(super) fn plain_words(&mut self) {
        while self.token.is_some() {
            let letter = self.letter();
            let offset = self.here();
            self.advance();
            let Some(letter) = letter else { continue };
            let mut negative = false;
            while let Some(sign @ (b'-' | b'+')) = self.symbol() {
                negative ^= sign == b'-';
                self.advance();
            }
            let Some(token) = self.token.filter(|t| t.kind == TokenKind::Number) else { continue };
            let faults = self.block.faults.len();
            let value = self.number(token);
            // What the number is good for is said when the block is executed.
            let bad = self.block.faults.len() > faults;
            self.block.faults.truncate(faults);
            if bad || self.symbol() == Some(b'=') || self.block.items.len() >= MOST_ITEMS {
                continue;
            }
            if negative && let Some(Node::Number(number)) = self.block.nodes.get_mut(value as usize)
            {
                *number = -*number;
            }
            self.block.items.push(Item::Word { letter, value, offset });
        }
    }
}
