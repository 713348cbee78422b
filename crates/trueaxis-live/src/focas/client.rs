//! The calls of one run.

use super::call;
use super::codec::{Call, Reply, Scaled, answers, ask, i32_at};
use super::pmc::{PmcAddress, PmcAreas, PmcBit};
use super::status::refusal;
use super::wire::Wire;
use crate::control::{Block, Control, Identity, LinkFault, Mode, Seen, Sent};
use crate::pose::Frame;

/// More axes no control has.
const MOST_AXES: usize = 32;

/// How the offset gets into the control.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Lever {
    /// The external work zero offset (EXT): nothing to install, no watchdog; one axis per write.
    Ext,
    /// Data of the PMC that the ladder of the builder turns into an external shift of the machine zero.
    Pmc,
}

/// One control.
#[derive(Debug, Clone, PartialEq)]
pub struct FanucSettings {
    /// How.
    pub lever: Lever,
    /// The number of each axis of the machine file in the control, from 1.
    pub numbers: Vec<u16>,
    /// The live axes, by their places in `numbers`.
    pub live: Vec<usize>,
    /// Which of the axes of the machine file are rotary: their numbers are degrees.
    pub rotary: Vec<bool>,
    /// Reference points of the axes: bit 0 of this byte is axis 1 of the control.
    pub referenced: PmcAddress,
    /// Set by the ladder while offsets must not change.
    pub inhibit: PmcBit,
    /// The byte with the number of the setup.
    pub setup: Option<PmcAddress>,
    /// The addresses of the lever [`Lever::Pmc`].
    pub pmc: Option<PmcAreas>,
}

/// A FANUC control as a [`Control`].
#[derive(Debug)]
pub struct Fanuc<W> {
    wire: W,
    settings: FanucSettings,
}

impl<W: Wire> Fanuc<W> {
    /// Over a wire.
    pub fn new(wire: W, settings: FanucSettings) -> Self {
        Self { wire, settings }
    }

    /// The same with other settings.
    #[must_use]
    pub fn with(mut self, settings: FanucSettings) -> Self {
        self.settings = settings;
        self
    }

    /// The wire.
    pub fn wire(&self) -> &W {
        &self.wire
    }

    fn ask(&mut self, calls: &[Call], now_s: f64) -> Result<Vec<Reply>, LinkFault> {
        let bytes = self.wire.exchange(&ask(calls), now_s)?;
        let replies = answers(&bytes, calls).map_err(|fault| {
            self.wire.reset(now_s);
            LinkFault::Garbage { reason: fault.to_string() }
        })?;
        // Which block runs is for the record only: a control that does not say is none that refuses.
        let counts = |asked: &Call| !matches!(asked.code, call::PROGRAM | call::SEQUENCE);
        let refused = |(reply, asked): &(&Reply, &Call)| reply.status != 0 && counts(asked);
        match replies.iter().zip(calls).find(refused) {
            None => Ok(replies),
            Some((reply, asked)) => Err(LinkFault::Refused {
                call: named(asked.code).to_owned(),
                reason: refusal(reply.status),
            }),
        }
    }

    fn offset_calls(&self) -> Vec<Call> {
        let settings = &self.settings;
        match (settings.lever, settings.pmc) {
            (Lever::Pmc, Some(pmc)) => {
                let words = settings.live.len();
                vec![
                    read_pmc(pmc.command, 4 * words, 2),
                    read_pmc(pmc.acting, 4 * words, 2),
                    read_pmc(pmc.tripped.byte, 1, 0),
                ]
            }
            _ => {
                let number = |live: &usize| i32::from(settings.numbers[*live]);
                let read = |live| Call::cnc(call::READ_ZERO, [0, 0, number(live), 0]);
                settings.live.iter().map(read).collect()
            }
        }
    }

    /// Double words of a range, as many as live axes.
    fn words(&self, reply: &Reply) -> Result<Vec<i32>, LinkFault> {
        let words = (0..self.settings.live.len()).map(|i| i32_at(&reply.data, 4 * i));
        words.collect::<Option<_>>().ok_or_else(|| unreadable(reply))
    }

    fn positions(&self, reply: &Reply) -> Result<Vec<f64>, LinkFault> {
        let all = self.settings.numbers.iter().zip(&self.settings.rotary);
        let one = |(number, rotary): (&u16, &bool)| {
            let at = Scaled::at(&reply.data, 8 * usize::from(number.saturating_sub(1)))?.value();
            Some(if *rotary { at.to_radians() } else { at })
        };
        all.map(one).collect::<Option<_>>().ok_or_else(|| unreadable(reply))
    }
}

/// A call by the name of the vendor.
fn named(code: u16) -> &'static str {
    match code {
        call::READ_ZERO => "cnc_rdzofs",
        call::WRITE_ZERO => "cnc_wrzofs",
        call::SYSTEM => "cnc_sysinfo",
        call::PROGRAM => "cnc_rdprgnum",
        call::SEQUENCE => "cnc_rdseqnum",
        call::STATUS => "cnc_statinfo",
        call::FEED => "cnc_actf",
        call::POSITION => "cnc_machine",
        call::AXIS_NAMES => "cnc_rdaxisname",
        call::READ_PMC => "pmc_rdpmcrng",
        call::WRITE_PMC => "pmc_wrpmcrng",
        _ => "a call",
    }
}

fn unreadable(reply: &Reply) -> LinkFault {
    LinkFault::Garbage { reason: format!("the data of {} do not have its form", named(reply.code)) }
}

/// first, last byte, area, width: 0 byte, 1 word, 2 double word.
fn range(from: PmcAddress, bytes: usize, width: i32) -> [i32; 4] {
    let first = i32::from(from.byte);
    let last = first + i32::try_from(bytes).unwrap_or(1) - 1;
    [first, last, from.area(), width]
}

fn read_pmc(from: PmcAddress, bytes: usize, width: i32) -> Call {
    Call::pmc(call::READ_PMC, range(from, bytes, width), Vec::new())
}

fn write_pmc(from: PmcAddress, data: Vec<u8>, width: i32) -> Call {
    Call::pmc(call::WRITE_PMC, range(from, data.len(), width), data)
}

/// The modes of `cnc_statinfo`.
fn mode_of(number: u16) -> Mode {
    match number {
        0 => Mode::Mdi,
        1 | 10 => Mode::Automatic,
        4..=8 => Mode::Manual,
        9 => Mode::Reference,
        _ => Mode::Other,
    }
}

/// Seven words: mode, run, motion, auxiliary functions, emergency, alarm, edit.
struct Status {
    mode: Mode,
    cutting: bool,
    emergency: bool,
    alarm: bool,
}

fn status(reply: &Reply) -> Result<Status, LinkFault> {
    let word =
        |i: usize| reply.data.get(2 * i..2 * i + 2).map(|b| u16::from_be_bytes([b[0], b[1]]));
    let words: Option<Vec<u16>> = (0..7).map(word).collect();
    let words = words.ok_or_else(|| unreadable(reply))?;
    Ok(Status {
        mode: mode_of(words[0]),
        cutting: matches!(words[1], 3 | 4),
        emergency: words[4] != 0,
        alarm: words[5] != 0,
    })
}

/// The block that runs; none where the control gives no sequence number.
fn block(program: &Reply, sequence: &Reply) -> Option<Block> {
    let number = |reply: &Reply| i32_at(&reply.data, 0).filter(|_| reply.status == 0);
    Some(Block { program: number(program).unwrap_or(0), number: number(sequence)? })
}

impl<W: Wire> Control for Fanuc<W> {
    fn identity(&mut self, now_s: f64) -> Result<Identity, LinkFault> {
        let calls = [
            Call::cnc(call::SYSTEM, [0; 4]),
            Call::cnc(call::AXIS_NAMES, [0; 4]),
            Call::cnc(call::POSITION, [1, -1, 0, 0]),
        ];
        let replies = self.ask(&calls, now_s)?;
        let [system, names, positions] = &replies[..] else { return Err(unreadable(&replies[0])) };
        let text = |from: usize, to: usize| {
            let bytes = system.data.get(from..to)?;
            let visible = bytes.iter().filter(|b| b.is_ascii_graphic());
            Some(visible.map(|b| char::from(*b)).collect::<String>())
        };
        let found = text(4, 6).zip(text(8, 12)).zip(text(12, 16)).zip(text(16, 18));
        let (((kind, series), version), count) = found.ok_or_else(|| unreadable(system))?;
        // Letter and, if any, index; the rest of the four bytes is of no use.
        let name = |bytes: &[u8]| {
            let visible = bytes[..2].iter().filter(|b| b.is_ascii_alphanumeric());
            visible.map(|b| char::from(*b)).collect::<String>()
        };
        let count = count.parse().unwrap_or(MOST_AXES).min(MOST_AXES);
        let axes = names.data.chunks_exact(4).take(count).map(name).filter(|n| !n.is_empty());
        let axes: Vec<String> = axes.collect();
        let decimals =
            (0..axes.len()).map(|i| Scaled::at(&positions.data, 8 * i).map(|s| s.exponent));
        let decimals = decimals.collect::<Option<_>>().ok_or_else(|| unreadable(positions))?;
        Ok(Identity { kind, series, version, axes, decimals })
    }

    fn read(&mut self, now_s: f64) -> Result<Seen, LinkFault> {
        let settings = self.settings.clone();
        let mut cnc = vec![
            Call::cnc(call::POSITION, [1, -1, 0, 0]),
            Call::cnc(call::FEED, [0; 4]),
            Call::cnc(call::STATUS, [0; 4]),
            Call::cnc(call::PROGRAM, [0; 4]),
            Call::cnc(call::SEQUENCE, [0; 4]),
        ];
        let mut pmc =
            vec![read_pmc(settings.referenced, 1, 0), read_pmc(settings.inhibit.byte, 1, 0)];
        match settings.lever {
            Lever::Ext => cnc.extend(self.offset_calls()),
            Lever::Pmc => pmc.extend(self.offset_calls()),
        }
        pmc.extend(settings.setup.map(|byte| read_pmc(byte, 1, 0)));
        let cnc = self.ask(&cnc, now_s)?;
        let pmc = self.ask(&pmc, now_s)?;
        let byte = |reply: &Reply| reply.data.first().copied().ok_or_else(|| unreadable(reply));
        let (referenced, inhibit) = (byte(&pmc[0])?, byte(&pmc[1])?);
        let setup = settings.setup.and(pmc.last()).map(byte).transpose()?.map(i32::from);
        let homed = settings.live.iter().all(|live| {
            let bit = settings.numbers[*live].saturating_sub(1);
            bit < 8 && referenced >> bit & 1 == 1
        });
        let (offsets, acting, tripped) = match (settings.lever, settings.pmc) {
            (Lever::Pmc, Some(areas)) => {
                let tripped = areas.tripped.is_set(byte(&pmc[4])?);
                (self.words(&pmc[2])?, Some(self.words(&pmc[3])?), tripped)
            }
            _ => {
                let one = |reply: &Reply| i32_at(&reply.data, 0).ok_or_else(|| unreadable(reply));
                let offsets = cnc[5..].iter().map(one).collect::<Result<Vec<i32>, _>>()?;
                (offsets, None, false)
            }
        };
        let Status { mode, cutting, emergency, alarm } = status(&cnc[2])?;
        let feed = Scaled::at(&cnc[1].data, 0).ok_or_else(|| unreadable(&cnc[1]))?;
        Ok(Seen {
            positions: self.positions(&cnc[0])?,
            offsets,
            acting,
            homed,
            emergency,
            alarm,
            mode,
            cutting,
            inhibited: settings.inhibit.is_set(inhibit),
            tripped,
            released: false,
            feed_mm_per_min: feed.value(),
            frame: Frame::Machine,
            tool_length_mm: None,
            standing_tip_mm: None,
            block: block(&cnc[3], &cnc[4]),
            setup,
        })
    }

    fn write(&mut self, sent: &Sent, now_s: f64) -> Result<(), LinkFault> {
        let mut calls = Vec::new();
        match (self.settings.lever, self.settings.pmc) {
            (Lever::Pmc, Some(pmc)) => {
                calls.push(write_pmc(pmc.heartbeat, vec![sent.beat], 0));
                let hold = u8::from(sent.ask_hold) << pmc.ask_hold.bit;
                calls.push(write_pmc(pmc.ask_hold.byte, vec![hold], 0));
                if let Some(offsets) = &sent.offsets {
                    let data = offsets.iter().flat_map(|offset| offset.to_be_bytes()).collect();
                    calls.push(write_pmc(pmc.command, data, 2));
                }
            }
            _ => {
                let Some(offsets) = &sent.offsets else { return Ok(()) };
                for (live, offset) in self.settings.live.iter().zip(offsets) {
                    let number = i32::from(self.settings.numbers[*live]);
                    // The number, and what marks it as whole increments.
                    let data = [&offset.to_be_bytes()[..], &[0, 0, 0xff, 0xff]].concat();
                    calls.push(Call::cnc(call::WRITE_ZERO, [0, 0, number, 0]).with(data));
                }
                // One axis per write, as the call of the vendor does it.
                return calls
                    .iter()
                    .try_for_each(|one| self.ask(std::slice::from_ref(one), now_s).map(drop));
            }
        }
        self.ask(&calls, now_s).map(drop)
    }
}
