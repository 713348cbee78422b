//! FANUC controls by FOCAS2 over Ethernet, without the library of the vendor.
//!
//! - [`codec`]: frames, pure;
//! - [`Fanuc`]: the calls of one run as a [`Control`](crate::control::Control), over any [`Wire`];
//! - [`TcpWire`]: the two connections of a client, each step with a time limit of its own.
//!
//! Written against published captures and an emulated control. It has not met a real control yet.

mod client;
pub mod codec;
mod pmc;
mod status;
mod wire;

pub use client::{Fanuc, FanucSettings, Lever};
pub use pmc::{PmcAddress, PmcAreas, PmcBit};
pub use status::refusal;
pub use wire::{TcpWire, Wire};

/// Calls that are used, by their numbers.
pub mod call {
    /// `cnc_rdzofs`: offset of a work coordinate system; number 0 is the external one (EXT).
    pub const READ_ZERO: u16 = 0x0b;
    /// `cnc_wrzofs`.
    pub const WRITE_ZERO: u16 = 0x0c;
    /// `cnc_rdmacro`.
    pub const READ_MACRO: u16 = 0x15;
    /// `cnc_sysinfo`.
    pub const SYSTEM: u16 = 0x18;
    /// `cnc_statinfo`.
    pub const STATUS: u16 = 0x19;
    /// `cnc_rdprgnum`: the program that runs, and the main program.
    pub const PROGRAM: u16 = 0x1c;
    /// `cnc_rdseqnum`: the last sequence number.
    pub const SEQUENCE: u16 = 0x1d;
    /// `cnc_actf`.
    pub const FEED: u16 = 0x24;
    /// Positions; the first argument 1 means machine coordinates.
    pub const POSITION: u16 = 0x26;
    /// Names of the axes.
    pub const AXIS_NAMES: u16 = 0x89;
    /// `cnc_wrmacror2`: a macro variable as a double.
    pub const WRITE_MACRO: u16 = 0xa8;
    /// `pmc_rdpmcrng`.
    pub const READ_PMC: u16 = 0x8001;
    /// `pmc_wrpmcrng`.
    pub const WRITE_PMC: u16 = 0x8002;
}
