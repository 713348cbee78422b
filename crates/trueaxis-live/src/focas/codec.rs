//! Frames of FOCAS2 over Ethernet: bytes to values and back, without a socket.
//!
//! ```text
//!     frame    a0a0a0a0 | version u16 | type u16 | length u16 | body            all big-endian
//!     body     number of blocks u16 | blocks
//!     asked    length u16 | device u16 | path u16 | code u16 | 4 × i32 | 0 u16 | data length u16 | data
//!     answered length u16 | device u16 | path u16 | code u16 | status i16 | 2 × detail u16 | data length u16 | data
//! ```
//!
//! # Source
//! The layout is that of public clients (pyfanuc, Unlicense; pyfocas, MIT); the frames of the tests are captures that were
//! published.

/// Frames that are longer are of no call used here, and no control sends them.
pub const LONGEST_BODY: usize = 3470;
/// Of the header of a frame.
pub const HEADER: usize = 10;
const MAGIC: [u8; 4] = [0xa0; 4];
/// Of a block that is asked, before its data.
const ASKED: usize = 28;
/// Of a block that is answered, before its data.
const ANSWERED: usize = 16;

/// What a frame is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// A client greets.
    Hello,
    /// The control greets.
    HelloBack,
    /// A client leaves.
    Close,
    /// The control lets it go.
    CloseBack,
    /// Blocks that are asked.
    Asked,
    /// Blocks that are answered.
    Answered,
}

const KINDS: [(u16, Kind); 6] = [
    (0x0101, Kind::Hello),
    (0x0102, Kind::HelloBack),
    (0x0201, Kind::Close),
    (0x0202, Kind::CloseBack),
    (0x2101, Kind::Asked),
    (0x2102, Kind::Answered),
];

impl Kind {
    fn number(self) -> u16 {
        KINDS.iter().find(|(_, kind)| *kind == self).map_or(0, |(number, _)| *number)
    }
}

/// What is wrong with bytes that came in.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum FrameFault {
    /// The first four bytes.
    #[error("the frame does not begin with a0 a0 a0 a0")]
    Magic,
    /// A version that no control answers in.
    #[error("version {0} of the frame is not known")]
    Version(u16),
    /// The type.
    #[error("type {0:#06x} of the frame is not known")]
    Type(u16),
    /// Another type than the one expected.
    #[error("the frame is of another type than the one that answers")]
    OtherType,
    /// A length that no frame has.
    #[error("the frame states {0} bytes")]
    Length(usize),
    /// The bytes end before the frame does.
    #[error("the frame ends after {0} bytes")]
    Short(usize),
    /// The number of blocks.
    #[error("{found} blocks answer {asked}")]
    Blocks {
        /// That were asked.
        asked: usize,
        /// That came.
        found: usize,
    },
    /// The answer to another question.
    #[error("block {0} answers another question")]
    Echo(usize),
    /// Data that do not have the form of their call.
    #[error("the data of call {0:#x} do not have its form")]
    Data(u16),
}

/// A header that was read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Header {
    /// What the frame is.
    pub kind: Kind,
    /// Bytes of its body.
    pub length: usize,
}

/// One call.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Call {
    /// 1 is the CNC, 2 the PMC.
    pub device: u16,
    /// The path of the control, from 1.
    pub path: u16,
    /// Its number.
    pub code: u16,
    /// Its arguments.
    pub arguments: [i32; 4],
    /// What it writes.
    pub data: Vec<u8>,
}

impl Call {
    /// A call of the CNC.
    pub fn cnc(code: u16, arguments: [i32; 4]) -> Self {
        Self { device: 1, path: 1, code, arguments, data: Vec::new() }
    }

    /// A call of the PMC.
    pub fn pmc(code: u16, arguments: [i32; 4], data: Vec<u8>) -> Self {
        Self { device: 2, path: 1, code, arguments, data }
    }

    /// The same with data.
    #[must_use]
    pub fn with(mut self, data: Vec<u8>) -> Self {
        self.data = data;
        self
    }
}

/// What one call is answered.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Reply {
    /// As asked.
    pub device: u16,
    /// As asked.
    pub path: u16,
    /// As asked.
    pub code: u16,
    /// 0, or why not (EW_…).
    pub status: i16,
    /// More about it.
    pub detail: [u16; 2],
    /// What was asked.
    pub data: Vec<u8>,
}

impl Reply {
    /// The answer to a call.
    pub fn to(call: &Call, status: i16, data: Vec<u8>) -> Self {
        let Call { device, path, code, .. } = *call;
        Self { device, path, code, status, detail: [0; 2], data }
    }
}

fn u16_at(bytes: &[u8], at: usize) -> Option<u16> {
    Some(u16::from_be_bytes(bytes.get(at..at + 2)?.try_into().ok()?))
}

/// A number of four bytes, big-endian.
pub fn i32_at(bytes: &[u8], at: usize) -> Option<i32> {
    Some(i32::from_be_bytes(bytes.get(at..at + 4)?.try_into().ok()?))
}

fn frame(kind: Kind, body: &[u8]) -> Vec<u8> {
    let length = u16::try_from(body.len()).unwrap_or(u16::MAX);
    let mut bytes = MAGIC.to_vec();
    for word in [1, kind.number(), length] {
        bytes.extend(word.to_be_bytes());
    }
    bytes.extend(body);
    bytes
}

/// A client greets; counter 1 is the connection of files, counter 2 that of calls.
pub fn hello(counter: u16) -> Vec<u8> {
    frame(Kind::Hello, &counter.to_be_bytes())
}

/// A client leaves.
pub fn close() -> Vec<u8> {
    frame(Kind::Close, &[])
}

/// The control lets a client go.
pub fn close_back() -> Vec<u8> {
    frame(Kind::CloseBack, &[])
}

/// The control greets: eight words, and one record of a path with its number of axes.
pub fn hello_back(axes: u16) -> Vec<u8> {
    let words = [32, 0, 32, 32, 1, 32, 32, 32, 1, 1, axes, 0];
    let body: Vec<u8> = words.iter().flat_map(|word: &u16| word.to_be_bytes()).collect();
    frame(Kind::HelloBack, &body)
}

/// Calls as one frame.
pub fn ask(calls: &[Call]) -> Vec<u8> {
    let mut body = count(calls.len());
    for call in calls {
        let mut block = Vec::with_capacity(ASKED + call.data.len());
        block.extend(count(ASKED + call.data.len()));
        for word in [call.device, call.path, call.code] {
            block.extend(word.to_be_bytes());
        }
        call.arguments.iter().for_each(|argument| block.extend(argument.to_be_bytes()));
        block.extend([0, 0]);
        block.extend(count(call.data.len()));
        block.extend(&call.data);
        body.extend(block);
    }
    frame(Kind::Asked, &body)
}

/// Answers as one frame.
pub fn answer(replies: &[Reply]) -> Vec<u8> {
    let mut body = count(replies.len());
    for reply in replies {
        body.extend(count(ANSWERED + reply.data.len()));
        for word in [reply.device, reply.path, reply.code] {
            body.extend(word.to_be_bytes());
        }
        body.extend(reply.status.to_be_bytes());
        reply.detail.iter().for_each(|word| body.extend(word.to_be_bytes()));
        body.extend(count(reply.data.len()));
        body.extend(&reply.data);
    }
    frame(Kind::Answered, &body)
}

fn count(length: usize) -> Vec<u8> {
    u16::try_from(length).unwrap_or(u16::MAX).to_be_bytes().to_vec()
}

/// Reads the ten bytes of a header.
///
/// # Errors
/// [`FrameFault`].
pub fn header(bytes: &[u8]) -> Result<Header, FrameFault> {
    if !bytes.starts_with(&MAGIC) {
        return Err(if bytes.len() < 4 {
            FrameFault::Short(bytes.len())
        } else {
            FrameFault::Magic
        });
    }
    let word = |at| u16_at(bytes, at).ok_or(FrameFault::Short(bytes.len()));
    let (version, kind, length) = (word(4)?, word(6)?, usize::from(word(8)?));
    if !(1..=4).contains(&version) {
        return Err(FrameFault::Version(version));
    }
    let known = KINDS.iter().find(|(number, _)| *number == kind);
    let kind = known.map(|(_, kind)| *kind).ok_or(FrameFault::Type(kind))?;
    if length > LONGEST_BODY {
        return Err(FrameFault::Length(length));
    }
    Ok(Header { kind, length })
}

/// The body of a whole frame of this kind.
fn body(bytes: &[u8], kind: Kind) -> Result<&[u8], FrameFault> {
    let found = header(bytes)?;
    if found.kind != kind {
        return Err(FrameFault::OtherType);
    }
    let body = bytes.get(HEADER..).unwrap_or_default();
    match body.len() == found.length {
        true => Ok(body),
        false => Err(FrameFault::Short(bytes.len())),
    }
}

/// The blocks of a body, each without its length.
fn blocks(body: &[u8], least: usize) -> Result<Vec<&[u8]>, FrameFault> {
    let short = FrameFault::Short(body.len());
    let number = usize::from(u16_at(body, 0).ok_or(short.clone())?);
    let (mut found, mut rest) = (Vec::new(), &body[2..]);
    for _ in 0..number {
        let length = usize::from(u16_at(rest, 0).ok_or(short.clone())?);
        if length < least {
            return Err(FrameFault::Length(length));
        }
        found.push(rest.get(2..length).ok_or(short.clone())?);
        rest = &rest[length..];
    }
    match rest.is_empty() {
        true => Ok(found),
        false => Err(FrameFault::Length(body.len())),
    }
}

/// Reads the frame that answers calls: as many blocks, each the echo of its call. Statuses are left to the caller.
///
/// # Errors
/// [`FrameFault`].
pub fn answers(bytes: &[u8], asked: &[Call]) -> Result<Vec<Reply>, FrameFault> {
    let found = blocks(body(bytes, Kind::Answered)?, ANSWERED)?;
    if found.len() != asked.len() {
        return Err(FrameFault::Blocks { asked: asked.len(), found: found.len() });
    }
    let read = |(i, (block, call)): (usize, (&&[u8], &Call))| {
        let word = |at| u16_at(block, at).ok_or(FrameFault::Short(block.len()));
        let (device, path, code) = (word(0)?, word(2)?, word(4)?);
        if (device, path, code) != (call.device, call.path, call.code) {
            return Err(FrameFault::Echo(i + 1));
        }
        let status = i16::from_be_bytes(word(6)?.to_be_bytes());
        let length = usize::from(word(12)?);
        let data = block.get(14..14 + length).ok_or(FrameFault::Data(code))?.to_vec();
        Ok(Reply { device, path, code, status, detail: [word(8)?, word(10)?], data })
    };
    found.iter().zip(asked).enumerate().map(read).collect()
}

/// Reads the frame of a client: the calls.
///
/// # Errors
/// [`FrameFault`].
pub fn calls(bytes: &[u8]) -> Result<Vec<Call>, FrameFault> {
    let found = blocks(body(bytes, Kind::Asked)?, ASKED)?;
    let read = |block: &&[u8]| {
        let word = |at| u16_at(block, at).ok_or(FrameFault::Short(block.len()));
        let argument = |i: usize| i32_at(block, 6 + 4 * i).ok_or(FrameFault::Short(block.len()));
        let arguments = [argument(0)?, argument(1)?, argument(2)?, argument(3)?];
        let (device, path, code) = (word(0)?, word(2)?, word(4)?);
        let length = usize::from(word(24)?);
        let data = block.get(26..26 + length).ok_or(FrameFault::Data(code))?.to_vec();
        Ok(Call { device, path, code, arguments, data })
    };
    found.iter().map(read).collect()
}

/// A number of the CNC: eight bytes, a whole number, a base and an exponent.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Scaled {
    /// The whole number.
    pub number: i32,
    /// 2 or 10.
    pub base: u16,
    /// What it is divided by is the base to this power.
    pub exponent: u16,
}

impl Scaled {
    /// Its bytes.
    pub fn bytes(self) -> [u8; 8] {
        let mut bytes = [0; 8];
        bytes[..4].copy_from_slice(&self.number.to_be_bytes());
        bytes[4..6].copy_from_slice(&self.base.to_be_bytes());
        bytes[6..].copy_from_slice(&self.exponent.to_be_bytes());
        bytes
    }

    /// Reads eight bytes at a place; `None` where they are no number, or vacant (exponent ffff).
    pub fn at(bytes: &[u8], at: usize) -> Option<Self> {
        let (number, base) = (i32_at(bytes, at)?, u16_at(bytes, at + 4)?);
        let exponent = u16_at(bytes, at + 6)?;
        (matches!(base, 2 | 10) && exponent <= 30).then_some(Self { number, base, exponent })
    }

    /// As a number.
    pub fn value(self) -> f64 {
        f64::from(self.number) / f64::from(self.base).powi(i32::from(self.exponent))
    }
}
