//! System variables: those that the program itself decides.

use super::archive;
use super::chain::Part;
use super::reader::Reader;
use super::values::Value;
use super::{Language, Run, fault};
use crate::execution::mistakes;
use crate::execution::values::finite;
use crate::moves::turns;
use crate::moves::{Axis, Event, Frame};
use crate::text::program::Fault;

/// Tools that a program may define; more are a loop that has gone wrong.
const MOST_TOOLS: usize = 100_000;

/// What stands in the brackets of a system variable.
#[derive(Debug, Clone, Default)]
struct Indices {
    numbers: Vec<f64>,
    axis: Option<Axis>,
    part: Option<Part>,
}

impl Run<'_> {
    /// `$NAME[…]`: the name and what stands in its brackets; `$` comes next.
    fn system_name(&mut self, reader: &mut Reader<'_>) -> Result<(String, Indices), Fault> {
        let at = reader.here();
        reader.advance();
        // $$ asks at block change; to us it is the same.
        reader.accept(b'$');
        let Some((name, length)) = reader.name() else {
            let hint = "write $P_EP[X]";
            return Err(fault(
                "missing-value",
                at,
                "the name of a system variable is missing",
                hint,
            ));
        };
        reader.at += length;
        let mut indices = Indices::default();
        if reader.accept(b'[') {
            loop {
                self.system_index(reader, &mut indices)?;
                if !reader.accept(b',') {
                    break;
                }
            }
            reader.require(b']', "write one ] for each [")?;
        }
        Ok((name, indices))
    }

    fn system_index(&mut self, reader: &mut Reader<'_>, into: &mut Indices) -> Result<(), Fault> {
        if let Some(part) = reader.word().as_deref().and_then(Part::of) {
            reader.advance();
            into.part = Some(part);
            return Ok(());
        }
        let at = reader.here();
        match self.expression(reader) {
            Ok(Value::Axis(axis)) => into.axis = Some(axis),
            Ok(value) => into.numbers.push(value.number(at)?),
            Err(fault) => return Err(fault),
        }
        Ok(())
    }

    pub(super) fn system_value(&mut self, reader: &mut Reader<'_>) -> Result<Value, Fault> {
        let at = reader.here();
        let (name, indices) = self.system_name(reader)?;
        let number = indices.numbers.first().copied().unwrap_or(1.0);
        if name == "R" {
            return Ok(Value::Number(self.r_value(number.clamp(0.0, 32_767.0) as usize, at)));
        }
        if let Some(frame) = self.frame_variable(&name, number) {
            return Ok(match (indices.axis, indices.part) {
                (Some(axis), Some(part)) => Value::Number(part.read(&frame, axis)),
                _ => Value::frame(frame),
            });
        }
        let axis = indices.axis.unwrap_or(Axis::X);
        let value = match name.as_str() {
            "PI" => std::f64::consts::PI,
            "P_EP" | "P_EPM" | "AA_IW" | "P_APR" => self.chain.position[axis],
            "AA_IM" | "AA_MM" | "AA_MW" | "AA_IB" => self.axis_positions()[axis],
            "P_TOOLNO" => f64::from(self.core.modes.tool),
            "P_TOOLP" => f64::from(self.core.modes.selected),
            "P_TOOL" => f64::from(self.modes.edge),
            "P_TOOLL" => {
                let stored =
                    self.chain.tools.get(&self.core.modes.tool).copied().unwrap_or_default();
                match number as i64 {
                    2 => stored[Axis::Y],
                    3 => stored[Axis::X],
                    _ => stored[Axis::Z],
                }
            }
            // No workpiece is simulated: every touch is taken as made.
            "AC_MEA" => 1.0,
            "P_F" => self.core.modes.feed.value,
            "P_S" => self.core.modes.speed,
            "P_UIFRNUM" => f64::from(self.chain.active),
            // A run of this program is a run on the machine.
            "P_SEARCH" | "P_ISTEST" | "P_SIM" | "P_DRYRUN" | "P_PROG_EVENT" => 0.0,
            "TC_DP3" => self.chain.tools.get(&(number as u32)).map_or(0.0, |t| t[Axis::Z]),
            "TC_DP6" => self.radius_of(number as u32, at).unwrap_or(0.0),
            "P_TOOLR" => self.radius_of(self.core.modes.tool, at).unwrap_or(0.0),
            _ => {
                let message = format!("the value of ${name} is not known here");
                let hint = "write the value itself";
                return Err(fault("unknown-system-variable", at, message, hint));
            }
        };
        finite(value, at).map(Value::Number)
    }

    fn frame_variable(&self, name: &str, number: f64) -> Option<Frame> {
        Some(match name {
            "P_UIFR" => self.chain.offset(number.max(0.0) as u32),
            "P_IFRAME" => self.chain.settable,
            "P_PFRAME" => self.chain.programmable,
            "P_ACTFRAME" => self.chain.frame(),
            "P_WPFRAME" | "P_WPFR" | "P_TOOLFRAME" | "P_TOOLFR" => self.chain.swivel,
            "P_BFRAME" | "P_CHBFRAME" | "P_NCBFRAME" | "P_CHBFR" | "P_NCBFR" => Frame::IDENTITY,
            _ => return None,
        })
    }

    /// `$NAME[…] = …`; `$` comes next.
    pub(super) fn system_assignment(&mut self, reader: &mut Reader<'_>) -> Result<(), Fault> {
        let at = reader.here();
        let (name, indices) = self.system_name(reader)?;
        reader.require(b'=', "write $P_UIFR[1,X,TR]=100")?;
        let value = self.expression(reader)?;
        let number = indices.numbers.first().copied().unwrap_or(1.0).clamp(0.0, 1e6) as u32;
        if name.starts_with("TC_") {
            return self.write_tool(&name, &indices.numbers, &value, at);
        }
        let frame = match (indices.axis, indices.part) {
            (Some(axis), Some(part)) if self.frame_variable(&name, f64::from(number)).is_some() => {
                let mut frame =
                    self.frame_variable(&name, f64::from(number)).unwrap_or(Frame::IDENTITY);
                if !part.write(&mut frame, axis, value.number(at)?) {
                    self.core.not_applied(
                        &format!("this part of ${name}"),
                        at,
                        "assign a whole frame",
                    );
                }
                frame
            }
            _ => match &value {
                Value::Frame(frame) => **frame,
                _ => {
                    let hint = "the following moves are computed without it";
                    self.core.not_applied(&format!("${name}="), at, hint);
                    return Ok(());
                }
            },
        };
        self.write_frame(&name, number, frame, at)
    }

    fn write_frame(
        &mut self,
        name: &str,
        number: u32,
        frame: Frame,
        at: usize,
    ) -> Result<(), Fault> {
        let kept = match name {
            "P_UIFR" => {
                if number > 999 {
                    return Err(mistakes::bad_work_offset(
                        number,
                        "write 1 for G54, 5 for G505",
                        at,
                    ));
                }
                self.chain.offsets.insert(number, frame);
                if let Some(archive) = &mut self.archive {
                    archive.work_offsets.insert(number, frame);
                }
                true
            }
            "P_IFRAME" => {
                let kept = self.chain.change(|c| c.settable = frame);
                self.emit_offset();
                kept
            }
            "P_PFRAME" => self.chain.change(|c| c.programmable = frame),
            "P_WPFRAME" | "P_TOOLFRAME" => self.chain.change(|c| c.swivel = frame),
            _ if frame == Frame::IDENTITY => true,
            _ => {
                let hint = "the following moves are computed without it";
                self.core.not_applied(&format!("${name}="), at, hint);
                true
            }
        };
        if !kept {
            return Err(mistakes::flat_frame(at));
        }
        self.emit_frame();
        Ok(())
    }

    /// Tells the work offset that is active now.
    pub(super) fn emit_offset(&mut self) {
        let frame = self.chain.settable;
        let rotation_deg = turns::rotation_deg(&frame);
        let (index, offset) = (self.chain.active, frame.shift);
        self.core.emit(Event::WorkOffset { index, offset, rotation_deg });
    }

    /// $TC_DP3[t,d] and its like.
    fn write_tool(
        &mut self,
        name: &str,
        numbers: &[f64],
        value: &Value,
        at: usize,
    ) -> Result<(), Fault> {
        let tool = numbers.first().copied().unwrap_or(0.0).clamp(0.0, 1e9) as u32;
        let edge = numbers.get(1).copied().unwrap_or(1.0);
        if let Some(archive) = &mut self.archive {
            return archive::write_tool(
                archive,
                name,
                [tool, edge.clamp(0.0, 1e6) as u32],
                value,
                at,
            );
        }
        if edge != 1.0 {
            self.core.not_applied("a cutting edge other than 1", at, "only D1 is applied");
            return Ok(());
        }
        let axis = match name {
            "TC_DP3" => Axis::Z,
            "TC_DP4" => Axis::Y,
            "TC_DP5" => Axis::X,
            "TC_DP6" => {
                // As with the lengths, the control takes it with the next T or D.
                if self.core.radii.len() < MOST_TOOLS {
                    self.core.radii.insert(tool, value.number(at)?);
                }
                return Ok(());
            }
            _ => {
                let applied = "only the lengths and radii of tools are applied";
                self.core.not_applied(&format!("${name}="), at, applied);
                return Ok(());
            }
        };
        if self.chain.tools.len() < MOST_TOOLS {
            self.chain.tools.entry(tool).or_default()[axis] = value.number(at)?;
        }
        Ok(())
    }
}
