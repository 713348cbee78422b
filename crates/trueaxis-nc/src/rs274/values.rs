//! Values of expressions.

use super::parameters::Parameter;
use super::{Passage, Run};
use crate::execution::mistakes;
use crate::execution::values::{self, finite};
use crate::text::program::{Fault, Function, Node, NodeId, Operator, Program};
use trueaxis_blocks::Control;

impl Run<'_> {
    /// The value of an expression. A FANUC parameter without a value is NaN in here; it counts as
    /// 0 in sums and as itself in comparisons, and never leaves the interpreter.
    pub(super) fn value(&self, passage: Passage<'_>, node: NodeId) -> Result<f64, Fault> {
        let of = |node: NodeId| self.value(passage, node);
        match &passage.block.nodes[node as usize] {
            Node::Number(value) => Ok(*value),
            Node::Parameter(_) | Node::Named(_) => self.parameter_value(passage, node),
            Node::Negative(x) => Ok(-of(*x)?),
            Node::Function(function, x, at) => {
                self.function(passage.program, *function, vacant(of(*x)?), *at)
            }
            Node::ArcTangent(y, x) => {
                let (y, other) = (vacant(of(*y)?), x.map(of).transpose()?.map_or(1.0, vacant));
                let angle_deg = y.atan2(other).to_degrees();
                let program = passage.program;
                Ok(if x.is_some() { from_zero(program, angle_deg) } else { angle_deg })
            }
            Node::Exists(parameter) => {
                let found = match self.parameter(passage, *parameter)? {
                    Parameter::Number(n) => n > 0 && self.is_in_range(n),
                    name => self.read(&name).is_some(),
                };
                Ok(f64::from(u8::from(found)))
            }
            Node::Binary(operator, a, b, at) => {
                let (a, b) = (of(*a)?, of(*b)?);
                if passage.program.dialect().macro_words
                    && let Some(value) = whole_numbers(*operator, vacant(a), vacant(b))
                {
                    return Ok(value);
                }
                binary(*operator, a, b, *at)
            }
        }
    }

    fn parameter_value(&self, passage: Passage<'_>, node: NodeId) -> Result<f64, Fault> {
        let parameter = self.parameter(passage, node)?;
        if let Some(value) = self.read(&parameter) {
            return Ok(value);
        }
        let at = passage.block.span.start;
        match parameter {
            Parameter::Number(_) if passage.program.dialect().macro_words => Ok(f64::NAN),
            Parameter::Number(number) if number > 0 && self.is_in_range(number) => Ok(0.0),
            Parameter::Number(number) => Err(out_of_range(number, at)),
            Parameter::Name(name) => Err(mistakes::no_value_yet(format_args!("#<{name}>"), at)),
        }
    }

    fn function(
        &self,
        program: &Program,
        function: Function,
        x: f64,
        at: usize,
    ) -> Result<f64, Fault> {
        let towards_zero = program.dialect().fix_towards_zero;
        let coded = |from, to| coded(x, from, to);
        let of = |name| values::function(name, x, at).map(|value| value.unwrap_or(x));
        let result = match function {
            Function::Abs => return of("ABS"),
            Function::Bcd => coded(10, 16).ok_or_else(|| values::out_of_domain("BCD", x, at))?,
            Function::Bin => coded(16, 10).ok_or_else(|| values::out_of_domain("BIN", x, at))?,
            Function::Acos => return of("ACOS"),
            Function::Asin => return of("ASIN").map(|deg| from_zero(program, deg)),
            Function::Cos => return of("COS"),
            Function::Exp => return of("EXP"),
            Function::Fix if towards_zero => x.trunc(),
            Function::Fix => x.floor(),
            Function::Fup if towards_zero => x.abs().ceil().copysign(x),
            Function::Fup => x.ceil(),
            Function::Ln => return of("LN"),
            Function::Round => x.round(),
            Function::Sin => return of("SIN"),
            Function::Sqrt => return of("SQRT"),
            Function::Tan => return of("TAN"),
        };
        finite(result, at)
    }
}

/// FANUC gives the angles of ATAN[y]/[x] from 0 to 360 and those of ASIN from 270 to 90.
///
/// # Source
/// FANUC Series 30i operator's manual, "Custom macro", arithmetic and logic operations: parameter 6004, bit 0 (NAT) = 0.
fn from_zero(program: &Program, angle_deg: f64) -> f64 {
    let whole = program.dialect().control == Control::Fanuc && angle_deg < 0.0;
    if whole { angle_deg + 360.0 } else { angle_deg }
}

/// The digits of a whole number in one base, read in another: BCD and BIN.
fn coded(x: f64, from: u64, to: u64) -> Option<f64> {
    let mut rest = Some(x.round()).filter(|x| (0.0..1e8).contains(x))? as u64;
    let (mut value, mut place) = (0, 1);
    while rest > 0 {
        let digit = rest % from;
        if digit > 9 {
            return None;
        }
        (value, place, rest) = (value + digit * place, place * to, rest / from);
    }
    Some(value as f64)
}

/// AND, OR, XOR and MOD of FANUC work on whole numbers, bit by bit; MOD has the sign of the
/// dividend. `None` leaves it to the others.
fn whole_numbers(operator: Operator, a: f64, b: f64) -> Option<f64> {
    let bits = |of: fn(i64, i64) -> i64| {
        let fits = |x: f64| x.abs() < 1e15;
        (fits(a) && fits(b)).then(|| of(a.round() as i64, b.round() as i64) as f64)
    };
    match operator {
        Operator::And => bits(|a, b| a & b),
        Operator::Or => bits(|a, b| a | b),
        Operator::Xor => bits(|a, b| a ^ b),
        Operator::Modulo if b.round() != 0.0 => Some(a.round() % b.round()),
        _ => None,
    }
}

/// A parameter without a value counts as 0 in sums.
fn vacant(value: f64) -> f64 {
    if value.is_nan() { 0.0 } else { value }
}

fn binary(operator: Operator, a: f64, b: f64, at: usize) -> Result<f64, Fault> {
    let same = |x: f64, y: f64| x.is_nan() == y.is_nan() && (x.is_nan() || (x - y).abs() < 1e-6);
    let (x, y) = (vacant(a), vacant(b));
    let truth = |condition: bool| Ok(f64::from(u8::from(condition)));
    let divisor = || values::not_zero(y, at);
    match operator {
        Operator::Power => finite(x.powf(y), at),
        Operator::Times => finite(x * y, at),
        Operator::Divide => finite(x / divisor()?, at),
        Operator::Modulo => finite(x.rem_euclid(divisor()?), at),
        Operator::Plus => finite(x + y, at),
        Operator::Minus => finite(x - y, at),
        Operator::Equal => truth(same(a, b)),
        Operator::NotEqual => truth(!same(a, b)),
        Operator::Greater => truth(x > y),
        Operator::GreaterEqual => truth(x >= y),
        Operator::Less => truth(x < y),
        Operator::LessEqual => truth(x <= y),
        Operator::And => truth(x != 0.0 && y != 0.0),
        Operator::Or => truth(x != 0.0 || y != 0.0),
        Operator::Xor => truth((x != 0.0) != (y != 0.0)),
    }
}

pub(super) fn out_of_range(number: u32, at: usize) -> Fault {
    let hint = "see the manual of the control for the range of parameters";
    mistakes::no_parameter(format_args!("#{number}"), hint, at)
}
