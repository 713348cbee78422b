//! Reports of blocks as they are executed, for unrolling a program.

use super::execute::is_control;
use super::{Next, Passage, Run};
use crate::moves::Event;
use crate::text::program::{Block, Fault, Item, Keyword, Node, NodeId};

impl Run<'_> {
    /// Executes a block and reports the values that a flat program of the same path would state.
    pub(super) fn report_block(&mut self, passage: Passage<'_>) -> Result<Next, Fault> {
        self.core.emit(Event::Block { text: passage.block.span.clone() });
        for item in &passage.block.items {
            let end = end_of(item, passage.block);
            match item {
                Item::Word { value, offset, .. } if !is_number(passage.block, *value) => {
                    // Not yet executed: a block that assigns reads the values before it.
                    let value = self.value(passage, *value)?;
                    // A word of FANUC without a value is none.
                    let (from, value) = match value.is_nan() {
                        true => (*offset, None),
                        false => (offset + 1, Some(value)),
                    };
                    self.core.report_computed(from..end, value);
                }
                Item::Assign { offset, .. } => self.core.report_computed(*offset..end, None),
                _ => {}
            }
        }
        let next = self.sound_block(passage)?;
        let steers = passage.block.items.iter().any(|item| {
            let begins = matches!(item, Item::Control { keyword: Keyword::ProgramNumber, .. });
            is_control(item) && !begins
        });
        // The blocks of a profile move only where its cycle does.
        let profile = self.turning.is_some();
        if steers || profile || next == Next::Jumped {
            self.report_steering(passage, steers || profile);
        }
        Ok(next)
    }

    /// M98 and M99 go with their words and leave the others of their block; all else goes as a whole.
    fn report_steering(&mut self, passage: Passage<'_>, whole: bool) {
        let letter = |item: &Item, letters: &[u8]| match item {
            Item::Word { letter, .. } => letters.contains(letter),
            _ => false,
        };
        let calls = passage.block.items.iter().any(|item| match item {
            Item::Word { letter: b'M', value, .. } => {
                let value = self.value(passage, *value);
                value.is_ok_and(|m| [98.0, 99.0, 198.0].contains(&m))
            }
            _ => false,
        });
        if whole || !calls {
            self.core.report_computed(passage.block.span.clone(), None);
            return;
        }
        // The M function of the call stands alone: others share no block with it.
        for item in passage.block.items.iter().filter(|item| letter(item, b"MPLQ")) {
            self.core.report_computed(offset_of(item)..end_of(item, passage.block), None);
        }
    }
}

/// Where an item begins.
fn offset_of(item: &Item) -> usize {
    match item {
        Item::Word { offset, .. } | Item::Assign { offset, .. } | Item::Control { offset, .. } => {
            *offset
        }
        Item::Comment(range) => range.start,
        Item::Mark(at) | Item::LooseEnd(at) | Item::Optional(at) => *at,
    }
}

/// Where the next item begins; comments need not stand at their place among the items.
fn end_of(item: &Item, block: &Block) -> usize {
    let behind = block.items.iter().map(offset_of).filter(|at| *at > offset_of(item));
    behind.min().unwrap_or(block.span.end)
}

/// A plain number, with or without a sign.
fn is_number(block: &Block, node: NodeId) -> bool {
    match block.nodes[node as usize] {
        Node::Number(_) => true,
        Node::Negative(inner) => is_number(block, inner),
        _ => false,
    }
}
