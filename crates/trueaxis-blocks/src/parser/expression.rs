//! Expressions in brackets.

use super::{DEEPEST, Parser};
use crate::dialect::Control;
use crate::lexer::{Token, TokenKind, number_value};
use crate::program::{Function, Node, NodeId, Operator};

const FUNCTIONS: [(&[u8], Function); 16] = [
    (b"ABS", Function::Abs),
    (b"BCD", Function::Bcd),
    (b"BIN", Function::Bin),
    (b"ACOS", Function::Acos),
    (b"ASIN", Function::Asin),
    (b"COS", Function::Cos),
    (b"EXP", Function::Exp),
    (b"FIX", Function::Fix),
    (b"FUP", Function::Fup),
    (b"LN", Function::Ln),
    (b"ROUND", Function::Round),
    (b"SIN", Function::Sin),
    (b"SQRT", Function::Sqrt),
    (b"TAN", Function::Tan),
    (b"SQR", Function::Sqrt),
    (b"RND", Function::Round),
];

/// Operators with their strength; longer names first where one begins another.
const WORD_OPERATORS: [(&[u8], Operator, u8); 10] = [
    (b"MOD", Operator::Modulo, 4),
    (b"AND", Operator::And, 1),
    (b"XOR", Operator::Xor, 1),
    (b"OR", Operator::Or, 1),
    (b"EQ", Operator::Equal, 2),
    (b"NE", Operator::NotEqual, 2),
    (b"GT", Operator::Greater, 2),
    (b"GE", Operator::GreaterEqual, 2),
    (b"LT", Operator::Less, 2),
    (b"LE", Operator::LessEqual, 2),
];

impl Parser<'_, '_> {
    pub(super) fn number(&mut self, token: Token) -> NodeId {
        let value = number_value(&self.source[token.start..token.end]);
        if value.is_none() {
            let message = "expected a number".to_owned();
            self.fault("bad-number", token.start, message, "write a number such as 1.5");
        }
        self.advance();
        self.node(Node::Number(value.unwrap_or_default()))
    }

    /// A number, parameter, function or bracket, with signs before it.
    pub(super) fn value(&mut self) -> Option<NodeId> {
        let mut negative = false;
        loop {
            match self.symbol() {
                Some(b'-') => negative = !negative,
                Some(b'+') => {}
                _ => break,
            }
            self.advance();
        }
        let value = self.deeper(Self::unsigned)?;
        if !negative {
            return Some(value);
        }
        if let Node::Number(number) = self.block.nodes[value as usize] {
            self.block.nodes[value as usize] = Node::Number(-number);
            return Some(value);
        }
        Some(self.node(Node::Negative(value)))
    }

    fn deeper(&mut self, read: fn(&mut Self) -> Option<NodeId>) -> Option<NodeId> {
        if self.depth >= DEEPEST {
            let message = "brackets are nested too deeply".to_owned();
            self.fault(
                "too-deep",
                self.here(),
                message,
                "use parameters for parts of the expression",
            );
            return None;
        }
        self.depth += 1;
        let value = read(self);
        self.depth -= 1;
        value
    }

    fn unsigned(&mut self) -> Option<NodeId> {
        let Some(token) = self.token else {
            self.missing_value();
            return None;
        };
        match token.kind {
            TokenKind::Number => Some(self.number(token)),
            TokenKind::Letter => self.function(),
            TokenKind::Symbol if self.source[token.start] == b'#' => self.parameter(),
            TokenKind::Symbol if self.source[token.start] == b'[' => self.bracket(),
            _ => {
                self.missing_value();
                None
            }
        }
    }

    fn missing_value(&mut self) {
        let message = "a value is missing here".to_owned();
        let hint = "write a number, a parameter such as #1, or an expression in [brackets]";
        self.fault("missing-value", self.here(), message, hint);
    }

    fn parameter(&mut self) -> Option<NodeId> {
        self.advance();
        let named = self.dialect.o_words;
        if let Some(name) = self.token.filter(|t| named && t.kind == TokenKind::Name) {
            if self.source[name.end - 1] != b'>' {
                let message = "the name of the parameter is not closed".to_owned();
                self.fault("unclosed-name", name.start, message, "close it with >");
                return None;
            }
            self.advance();
            return Some(self.node(Node::Named(name.start + 1..name.end - 1)));
        }
        let number = self.value()?;
        Some(self.node(Node::Parameter(number)))
    }

    /// `[ … ]`
    pub(super) fn bracket(&mut self) -> Option<NodeId> {
        self.arguments(false).map(|(value, _)| value)
    }

    /// `[ … ]`, or `[ … , … ]` where two arguments are possible.
    fn arguments(&mut self, two: bool) -> Option<(NodeId, Option<NodeId>)> {
        let open = self.here();
        if !self.accept(b'[') {
            self.missing_value();
            return None;
        }
        let value = self.deeper(|p| p.chain(0))?;
        let second =
            if two && self.accept(b',') { Some(self.deeper(|p| p.chain(0))?) } else { None };
        if !self.accept(b']') {
            let message = "this bracket is not closed".to_owned();
            self.fault("unbalanced-brackets", open, message, "write one ] for each [");
            return None;
        }
        Some((value, second))
    }

    /// Values with operators between them that bind stronger than `least`.
    pub(super) fn chain(&mut self, least: u8) -> Option<NodeId> {
        let mut left = self.value()?;
        loop {
            let before = (self.token, self.lexer.clone(), self.end);
            let comments = self.block.items.len();
            let offset = self.here();
            let Some((operator, strength)) = self.operator() else { return Some(left) };
            if strength <= least {
                (self.token, self.lexer, self.end) = before;
                self.block.items.truncate(comments);
                return Some(left);
            }
            // The depth is bounded: there are five strengths.
            let right = self.chain(strength)?;
            left = self.node(Node::Binary(operator, left, right, offset));
        }
    }

    fn operator(&mut self) -> Option<(Operator, u8)> {
        if let Some(symbol) = self.symbol() {
            let (operator, strength) = match symbol {
                b'+' => (Operator::Plus, 3),
                b'-' => (Operator::Minus, 3),
                b'/' => (Operator::Divide, 4),
                b'*' => (Operator::Times, 4),
                _ => return None,
            };
            self.advance();
            if operator == Operator::Times && !self.dialect.macro_words && self.accept(b'*') {
                return Some((Operator::Power, 5));
            }
            return Some((operator, strength));
        }
        WORD_OPERATORS
            .iter()
            .find(|(word, ..)| self.accept_short(word))
            .map(|(_, operator, strength)| (*operator, *strength))
    }

    fn function(&mut self) -> Option<NodeId> {
        let offset = self.here();
        if self.accept_short(b"ATAN") {
            return self.arc_tangent();
        }
        if self.dialect.control == Control::Fanuc && self.accept_word(b"POW") {
            return self.power(offset);
        }
        if self.accept_word(b"EXISTS") {
            return self.exists();
        }
        let known =
            |f: Function| self.dialect.macro_words || !matches!(f, Function::Bcd | Function::Bin);
        let known: Vec<_> = FUNCTIONS.iter().filter(|(_, f)| known(*f)).collect();
        let Some((_, function)) = known.into_iter().find(|(name, _)| self.accept_short(name))
        else {
            let hint = "write a number, a parameter, [ ], or SIN COS TAN ASIN ACOS ATAN SQRT ABS \
                ROUND \
                        FIX FUP LN EXP EXISTS";
            self.fault("missing-value", offset, "expected a value or a function".into(), hint);
            return None;
        };
        let argument = self.bracket()?;
        Some(self.node(Node::Function(*function, argument, offset)))
    }

    /// `POW[x, y]`: x to the power of y.
    ///
    /// # Source
    /// FANUC Series 30i operator's manual, "Custom macro", arithmetic and logic operations.
    fn power(&mut self, offset: usize) -> Option<NodeId> {
        let (base, Some(exponent)) = self.arguments(true)? else {
            let message = "POW needs two arguments".to_owned();
            self.fault("missing-value", offset, message, "write POW[#1,2]");
            return None;
        };
        Some(self.node(Node::Binary(Operator::Power, base, exponent, offset)))
    }

    /// `ATAN[y]/[x]`; on FANUC also `ATAN[y, x]`, or one argument.
    fn arc_tangent(&mut self) -> Option<NodeId> {
        let (y, second) = self.arguments(self.dialect.control == Control::Fanuc)?;
        let x = if second.is_some() {
            second
        } else if self.accept(b'/') {
            Some(self.bracket()?)
        } else if self.dialect.macro_words {
            None
        } else {
            let message = "ATAN needs two arguments".to_owned();
            self.fault("missing-value", self.here(), message, "write ATAN[y]/[x]");
            return None;
        };
        Some(self.node(Node::ArcTangent(y, x)))
    }

    fn exists(&mut self) -> Option<NodeId> {
        let at = self.here();
        let inner = self.bracket()?;
        if !matches!(self.block.nodes[inner as usize], Node::Parameter(_) | Node::Named(_)) {
            let message = "EXISTS needs exactly one parameter".to_owned();
            self.fault("bad-exists", at, message, "write EXISTS[#1] or EXISTS[#<name>]");
            return None;
        }
        Some(self.node(Node::Exists(inner)))
    }
}
