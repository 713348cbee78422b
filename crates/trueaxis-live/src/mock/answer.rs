//! What the mock answers to the calls of a client.

use super::fanuc::{Change, FanucMock};
use crate::control::Mode;
use crate::focas::PmcAddress;
use crate::focas::call;
use crate::focas::codec::{
    Call, Kind, Reply, Scaled, answer, calls, close_back, header, hello_back, i32_at,
};
use crate::governor::increments_of;

/// Statuses of the vendor.
const NO_FUNCTION: i16 = 1;
const LENGTH: i16 = 2;
const NUMBER: i16 = 3;
const ATTRIBUTE: i16 = 4;
/// The program that runs.
const MOCK_PROGRAM: i32 = 1;
/// No client reads a longer range at once.
const LONGEST_RANGE: usize = 1024;

/// Letters of the areas by their numbers.
const AREAS: [(i32, char); 9] =
    [(0, 'G'), (1, 'F'), (2, 'Y'), (3, 'X'), (4, 'A'), (5, 'R'), (6, 'T'), (7, 'K'), (9, 'D')];

impl FanucMock {
    /// The frame that answers a frame; none where a control would close the connection.
    pub fn answer(&mut self, frame: &[u8]) -> Option<Vec<u8>> {
        let bytes = match header(frame).ok()?.kind {
            Kind::Hello => hello_back(u16::try_from(self.plan.axes.len()).unwrap_or(u16::MAX)),
            Kind::Close => close_back(),
            Kind::Asked => {
                let replies: Vec<Reply> =
                    calls(frame).ok()?.iter().map(|c| self.reply(c)).collect();
                answer(&replies)
            }
            Kind::HelloBack | Kind::CloseBack | Kind::Answered => return None,
        };
        Some(self.faults.garble.map_or(bytes.clone(), |garble| garble(bytes)))
    }

    fn reply(&mut self, asked: &Call) -> Reply {
        let result = match (asked.device, asked.code) {
            (1, call::SYSTEM) => Ok(self.system()),
            (1, call::AXIS_NAMES) => Ok(self.axis_names()),
            (1, call::STATUS) => Ok(self.status()),
            (1, call::PROGRAM | call::SEQUENCE) if self.faults.without_blocks => Err(NO_FUNCTION),
            (1, call::PROGRAM) => Ok([MOCK_PROGRAM.to_be_bytes(); 2].concat()),
            (1, call::SEQUENCE) => Ok(self.sequence().to_be_bytes().to_vec()),
            (1, call::FEED) => Ok(scaled(self.feed(), 0).bytes().to_vec()),
            (1, call::POSITION) => self.positions(asked.arguments),
            (1, call::READ_ZERO) => self.read_ext(asked.arguments),
            (1, call::WRITE_ZERO) => self.write_ext(asked),
            (1, call::READ_MACRO) => Ok(self.macros(asked.arguments)),
            (1, call::WRITE_MACRO) => self.write_macro(asked),
            (2, call::READ_PMC) => self.read_pmc(asked.arguments),
            (2, call::WRITE_PMC) => self.write_pmc(asked),
            // Two more questions of the same status call, which are answered by zeros.
            (1, 0xe1 | 0x98) => Ok(vec![0; 18]),
            _ => Err(NO_FUNCTION),
        };
        match result {
            Ok(data) => Reply::to(asked, 0, data),
            Err(status) => Reply::to(asked, status, Vec::new()),
        }
    }

    fn system(&self) -> Vec<u8> {
        let axes = format!("{:02}", self.plan.axes.len().min(99));
        let mut data = vec![0, 2, 0, 32];
        for text in ["31", " M", "G42A", "01.0", axes.as_str()] {
            data.extend(text.as_bytes());
        }
        data
    }

    fn axis_names(&self) -> Vec<u8> {
        let name = |name: &String| {
            let mut bytes = [0; 4];
            bytes.iter_mut().zip(name.bytes()).take(2).for_each(|(to, from)| *to = from);
            bytes
        };
        self.plan.axes.iter().flat_map(name).collect()
    }

    fn status(&self) -> Vec<u8> {
        let mode = match self.faults.mode {
            Mode::Mdi => 0,
            Mode::Automatic => 1,
            Mode::Other => 3,
            Mode::Manual => 5,
            Mode::Reference => 9,
        };
        let run = match (self.moves(), self.hold_is_asked()) {
            (true, _) => 3,
            (false, true) => 2,
            (false, false) => 0,
        };
        let motion = u16::from(self.feed() > 0.0);
        let words = [mode, run, motion, 0, u16::from(self.faults.emergency), 0, 0];
        words.iter().flat_map(|word: &u16| word.to_be_bytes()).collect()
    }

    fn positions(&self, [which, axis, ..]: [i32; 4]) -> Result<Vec<u8>, i16> {
        let positions = match which {
            1 => self.machine_positions(),
            4 | 6 => self.programmed(),
            7 => vec![0.0; self.plan.axes.len()],
            _ => return Err(ATTRIBUTE),
        };
        let bytes = |at: &f64| scaled(*at, self.plan.decimals).bytes();
        match usize::try_from(axis) {
            Err(_) => Ok(positions.iter().flat_map(bytes).collect()),
            Ok(axis) => {
                let one = axis.checked_sub(1).and_then(|i| positions.get(i));
                one.map(|at| bytes(at).to_vec()).ok_or(ATTRIBUTE)
            }
        }
    }

    fn read_ext(&self, [number, _, axis, _]: [i32; 4]) -> Result<Vec<u8>, i16> {
        let axis = self.axis(number, axis)?;
        let (number, exponent) = (self.ext[axis], self.plan.decimals);
        Ok(Scaled { number, base: 10, exponent }.bytes().to_vec())
    }

    /// The place of an axis from 1; only the external offset is known.
    fn axis(&self, number: i32, axis: i32) -> Result<usize, i16> {
        if number != 0 {
            return Err(NUMBER);
        }
        let place = usize::try_from(axis - 1).ok().filter(|i| *i < self.plan.axes.len());
        place.ok_or(ATTRIBUTE)
    }

    fn write_ext(&mut self, asked: &Call) -> Result<Vec<u8>, i16> {
        let [number, _, axis, _] = asked.arguments;
        let place = self.axis(number, axis)?;
        let refused = self.faults.refuse_axis.filter(|(of, _)| i32::from(*of) == axis);
        self.refused(refused.map_or(0, |(_, status)| status))?;
        let value = i32_at(&asked.data, 0).filter(|_| asked.data.len() == 8).ok_or(LENGTH)?;
        self.change(Change::Ext(place, value));
        let mut offsets: Vec<i32> = self.plan.live.iter().map(|axis| self.ext[*axis]).collect();
        if let Some(live) = self.plan.live.iter().position(|axis| *axis == place) {
            offsets[live] = value;
            self.note_write(offsets);
        }
        Ok(Vec::new())
    }

    fn refused(&self, also: i16) -> Result<(), i16> {
        [self.faults.refuse_writes, also]
            .into_iter()
            .find(|status| *status != 0)
            .map_or(Ok(()), Err)
    }

    /// Now, or when it becomes visible.
    fn change(&mut self, change: Change) {
        match self.faults.visible_after_s {
            after_s if after_s > 0.0 => self.later.push((self.now_s() + after_s, change)),
            _ => self.apply(change),
        }
    }

    fn macros(&self, [first, last, ..]: [i32; 4]) -> Vec<u8> {
        let numbers = first..=last.clamp(first, first.saturating_add(99));
        let value = |number| self.macros.get(&number).copied().unwrap_or(0.0);
        numbers.flat_map(|number| scaled(value(number), 6).bytes()).collect()
    }

    fn write_macro(&mut self, asked: &Call) -> Result<Vec<u8>, i16> {
        let bytes = asked.data.as_slice().try_into().map_err(|_| LENGTH)?;
        self.macros.insert(asked.arguments[0], f64::from_be_bytes(bytes));
        Ok(Vec::new())
    }

    /// The addresses of a range.
    fn range([first, last, area, _]: [i32; 4]) -> Result<Vec<PmcAddress>, i16> {
        let letter = AREAS.iter().find(|(number, _)| *number == area).map(|(_, letter)| *letter);
        let letter = letter.ok_or(ATTRIBUTE)?;
        let (first, last) = (u16::try_from(first), u16::try_from(last));
        let (Ok(first), Ok(last)) = (first, last) else { return Err(NUMBER) };
        let range: Vec<PmcAddress> =
            (first..=last).take(LONGEST_RANGE).map(|byte| PmcAddress { letter, byte }).collect();
        if range.is_empty() { Err(NUMBER) } else { Ok(range) }
    }

    fn read_pmc(&self, arguments: [i32; 4]) -> Result<Vec<u8>, i16> {
        Ok(Self::range(arguments)?.into_iter().map(|at| self.byte(at)).collect())
    }

    fn write_pmc(&mut self, asked: &Call) -> Result<Vec<u8>, i16> {
        let range = Self::range(asked.arguments)?;
        if range.len() != asked.data.len() {
            return Err(LENGTH);
        }
        let areas = self.plan.areas;
        let is_offset = range[0] == areas.command && range.len() == 4 * self.plan.live.len();
        // A key that protects data does not stop the heartbeat.
        self.refused(0).or_else(|status| if is_offset { Err(status) } else { Ok(()) })?;
        for (at, byte) in range.iter().zip(&asked.data) {
            if is_offset {
                self.change(Change::Byte(*at, *byte));
            } else {
                self.apply(Change::Byte(*at, *byte));
            }
        }
        if is_offset {
            let words = asked.data.chunks_exact(4).filter_map(|word| i32_at(word, 0));
            self.note_write(words.collect());
        }
        Ok(Vec::new())
    }
}

fn scaled(value: f64, decimals: u16) -> Scaled {
    let number = increments_of(value * 10f64.powi(i32::from(decimals))).unwrap_or(i32::MAX);
    Scaled { number, base: 10, exponent: decimals }
}
