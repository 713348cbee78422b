//! `[control]` of a plan: which control, how it is reached, and what the builder of the machine has agreed with its ladder.

use super::axes::AxisPlan;
use super::opcua::{OpcUaPlan, read_opcua};
use super::{time, word};
use crate::control::Identity;
use crate::focas::{Lever, PmcAddress, PmcAreas, PmcBit};
use crate::mock::{LadderSettings, MockPath, Stop};
use crate::pose::World;
use std::path::Path;
use trueaxis::input::{Dimension, Item, Section};
use trueaxis::machine::Machine;
use trueaxis::machine::axis::AxisKind;

/// The control of a plan.
#[derive(Debug, Clone)]
pub enum ControlPlan {
    /// FANUC by FOCAS2 over Ethernet.
    Fanuc(Box<FanucPlan>),
    /// LinuxCNC on this computer, by its HAL.
    LinuxCnc(LinuxCncPlan),
    /// A server of OPC UA, such as that of SINUMERIK.
    OpcUa(Box<OpcUaPlan>),
}

impl ControlPlan {
    /// Whether something in the control takes the offsets back when nothing comes from here.
    pub fn has_watchdog(&self) -> bool {
        match self {
            Self::Fanuc(fanuc) => fanuc.lever == Lever::Pmc,
            Self::LinuxCnc(_) => true,
            Self::OpcUa(opcua) => opcua.nodes.heartbeat.is_some() && opcua.nodes.tripped.is_some(),
        }
    }

    /// Whether it takes offsets of tip and angles, so that all axes are corrected together.
    pub fn takes_pose(&self) -> bool {
        matches!(self, Self::LinuxCnc(_))
    }

    /// The ends of the travel of a live axis that it corrects along a line. Unit: mm.
    pub fn line(&self, live: usize) -> Option<[f64; 2]> {
        let Self::OpcUa(opcua) = self else { return None };
        opcua.nodes.lines.get(live)?.as_ref().map(|line| line.ends)
    }

    /// The time limit of one exchange.
    pub fn timeout_s(&self) -> f64 {
        match self {
            Self::Fanuc(fanuc) => fanuc.timeout_s,
            Self::LinuxCnc(linuxcnc) => linuxcnc.timeout_s,
            Self::OpcUa(opcua) => opcua.server.timeout_s,
        }
    }

    /// The FANUC control, if it is one.
    pub fn fanuc(&self) -> Option<&FanucPlan> {
        match self {
            Self::Fanuc(fanuc) => Some(fanuc),
            Self::LinuxCnc(_) | Self::OpcUa(_) => None,
        }
    }
}

/// LinuxCNC.
#[derive(Debug, Clone, Copy)]
pub struct LinuxCncPlan {
    /// A servo thread that does not go on for so long has ended.
    pub timeout_s: f64,
    /// The number of the setup stands in the signal `ta-setup`.
    pub has_setup: bool,
}

/// A FANUC control of a plan.
#[derive(Debug, Clone)]
pub struct FanucPlan {
    /// `host:port`; none for a mock of its own.
    pub address: Option<String>,
    /// How the offset gets in.
    pub lever: Lever,
    /// The time limit of one exchange.
    pub timeout_s: f64,
    /// The control that this plan is of.
    pub bound: Option<Bound>,
    /// The byte of the reference points.
    pub referenced: PmcAddress,
    /// The bit that forbids changes.
    pub inhibit: PmcBit,
    /// The byte with the number of the setup: of a pallet, a work offset, a clamping.
    pub setup: Option<PmcAddress>,
    /// Which options and parameters make the control add what the ladder gives it, and who has set them.
    pub enabled_by: Option<String>,
    /// The addresses of the lever PMC.
    pub pmc: Option<PmcAreas>,
    /// The mock, where there is no address.
    pub mock: Option<(MockPath, LadderSettings)>,
}

/// What a control must say of itself.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Bound {
    /// Kind, series, version.
    pub kind: String,
    /// Its series.
    pub series: String,
    /// The version of its software.
    pub version: String,
}

impl Bound {
    /// Whether this is the control.
    pub fn is(&self, found: &Identity) -> bool {
        (&self.kind, &self.series, &self.version) == (&found.kind, &found.series, &found.version)
    }
}

pub(super) fn read_control(
    root: &Section<'_>,
    folder: &Path,
    machine: &Machine,
    (axes, commissions): (&[AxisPlan], bool),
) -> Option<ControlPlan> {
    let mock = root.section("mock", |s| read_mock(s, machine, axes));
    let hint = "[control] kind = \"fanuc\", address = \"192.168.1.10:8193\", lever, referenced, inhibit; or kind = \"linuxcnc\"; or kind = \"opc-ua\"";
    let item = root.require("control", hint)?;
    let read = |section: &Section<'_>| match read_kind(section)? {
        Kind::Fanuc => read_fanuc(section).map(|fanuc| ControlPlan::Fanuc(Box::new(fanuc))),
        Kind::LinuxCnc => read_linuxcnc(section, machine, (axes, commissions)),
        Kind::OpcUa => read_opcua(section, folder, (machine, axes), commissions)
            .map(|opcua| ControlPlan::OpcUa(Box::new(opcua))),
    };
    let mut control = match item.section("control", read).flatten()? {
        ControlPlan::Fanuc(fanuc) => fanuc,
        other => return Some(other),
    };
    match (&control.address, mock) {
        (None, Some(mock)) => control.mock = Some(mock?),
        (None, None) => {
            let hint = "[mock] feed, dwell and stops: where its axes go";
            item.error(
                "live-no-mock",
                "the address is `mock`, and there is no [mock]".to_owned(),
                hint,
            );
        }
        (Some(_), Some(_)) => {
            let message = "[mock] is for address = \"mock\"".to_owned();
            item.error(
                "contradiction",
                message,
                "leave [mock] out, or set the address to \"mock\"",
            );
        }
        (Some(_), None) => check_real(&item, &control, (axes, commissions)),
    }
    Some(ControlPlan::Fanuc(control))
}

#[derive(Clone, Copy, PartialEq)]
enum Kind {
    Fanuc,
    LinuxCnc,
    OpcUa,
}

fn read_kind(section: &Section<'_>) -> Option<Kind> {
    let item = section.require("kind", "kind = \"fanuc\", \"linuxcnc\", or \"opc-ua\"")?;
    word(&item, &[("fanuc", Kind::Fanuc), ("linuxcnc", Kind::LinuxCnc), ("opc-ua", Kind::OpcUa)])
}

fn read_linuxcnc(
    section: &Section<'_>,
    machine: &Machine,
    (axes, commissions): (&[AxisPlan], bool),
) -> Option<ControlPlan> {
    let timeout_s = time(section, "timeout", 0.05);
    let simulated = section.get("simulated").and_then(|item| item.flag()).unwrap_or(false);
    if let Err(message) = World::of(machine) {
        section.error("live-no-pose", message, "a machine with X, Y and Z square to each other");
    }
    for axis in axes.iter().filter(|axis| axis.sign < 0.0) {
        let message = format!("LinuxCNC adds the offset of {} to its position", axis.name);
        section.error("live-commissioning", message, "leave `sign` out");
    }
    if !simulated && !commissions {
        check_commissioned(axes, |code, message, hint| section.error(code, message, hint));
    }
    let has_setup = section.get("setup").and_then(|item| item.flag()).unwrap_or(false);
    Some(ControlPlan::LinuxCnc(LinuxCncPlan { timeout_s, has_setup }))
}

/// Nothing is written to a machine before sign and scale of each axis were seen.
pub(super) fn check_commissioned(axes: &[AxisPlan], error: impl Fn(&'static str, String, &str)) {
    for axis in axes.iter().filter(|axis| axis.commissioned.is_none()) {
        let message = format!("axis {}: sign and scale of its offset were not measured", axis.name);
        let hint = "trueaxis live commission PLAN --axis X --by \"10 um\" writes it and takes the reading (docs/ladder-watchdog.md); a LinuxCNC without a machine: simulated = true";
        error("live-not-commissioned", message, hint);
    }
}

/// A real control is bound, and nothing is written to it before sign and scale of each axis were seen.
fn check_real(item: &Item<'_>, control: &FanucPlan, (axes, commissions): (&[AxisPlan], bool)) {
    if control.bound.is_none() {
        let message = "the plan does not say which control is at that address".to_owned();
        let hint = "identity = { kind = \"31\", series = \"G42A\", version = \"01.0\" }: where it differs, the refusal names what the control says of itself";
        item.error("live-not-bound", message, hint);
    }
    if control.lever == Lever::Pmc && control.enabled_by.is_none() {
        let message =
            "the plan does not say what makes the control add the offset of its ladder".to_owned();
        let hint = "enabled_by = \"options and parameters, by whom, when\": they are facts of this machine, known to its builder";
        item.error("live-not-enabled", message, hint);
    }
    if !commissions {
        check_commissioned(axes, |code, message, hint| item.error(code, message, hint));
    }
}

fn read_fanuc(section: &Section<'_>) -> Option<FanucPlan> {
    let address = section.require("address", "address = \"192.168.1.10:8193\", or \"mock\"");
    let address = address.and_then(|item| read_address(&item));
    let levers = [("ext", Lever::Ext), ("pmc", Lever::Pmc)];
    let lever =
        section.require("lever", "lever = \"pmc\", or \"ext\"").and_then(|i| word(&i, &levers));
    let timeout_s = time(section, "timeout", 0.3);
    let referenced =
        section.require("referenced", "referenced = \"F120\": a byte with one bit for each axis");
    let referenced = referenced.and_then(|item| read_byte(&item));
    let inhibit = section.require(
        "inhibit",
        "inhibit = \"R1044.0\": set by the ladder while probing, threading, setting tools",
    );
    let inhibit = inhibit.and_then(|item| read_bit(&item));
    let setup = section.get("setup").map(|item| read_byte(&item));
    let bound = section.section("identity", read_identity);
    let enabled_by = section.text("enabled_by").map(str::to_owned);
    let pmc = section.section("pmc", read_pmc);
    if lever == Some(Lever::Pmc) && pmc.is_none() {
        let hint = "pmc = { command, acting, heartbeat, ask_hold, tripped }: addresses of the builder of the machine";
        section.error("live-no-pmc", "the lever `pmc` has no addresses".to_owned(), hint);
    }
    Some(FanucPlan {
        address: address?,
        lever: lever?,
        timeout_s,
        bound: bound.flatten(),
        referenced: referenced?,
        inhibit: inhibit?,
        setup: setup.map_or(Some(None), |byte| byte.map(Some))?,
        enabled_by,
        pmc: pmc.flatten(),
        mock: None,
    })
}

pub(super) fn read_identity(section: &Section<'_>) -> Option<Bound> {
    let part = |key| {
        section.require(key, "as the control says it").and_then(|i| i.text()).map(str::to_owned)
    };
    let (kind, series, version) = (part("kind"), part("series"), part("version"));
    Some(Bound { kind: kind?, series: series?, version: version? })
}

/// None inside is a mock.
fn read_address(item: &Item<'_>) -> Option<Option<String>> {
    let text = item.text()?;
    if text == "mock" {
        return Some(None);
    }
    let port = text.rsplit_once(':').and_then(|(host, port)| {
        let port: u16 = port.parse().ok()?;
        (!host.is_empty() && port > 0).then_some(port)
    });
    if port.is_none() {
        let message = format!("`{text}` is no address with a port");
        item.error("bad-address", message, "\"192.168.1.10:8193\", or \"mock\"");
    }
    port.map(|_| Some(text.to_owned()))
}

fn read_byte(item: &Item<'_>) -> Option<PmcAddress> {
    let text = item.text()?;
    let found = PmcAddress::parse(text);
    if found.is_none() {
        item.error(
            "bad-pmc-address",
            format!("`{text}` is no byte of the PMC"),
            "such as \"R1000\"",
        );
    }
    found
}

fn read_bit(item: &Item<'_>) -> Option<PmcBit> {
    let text = item.text()?;
    let found = PmcBit::parse(text);
    if found.is_none() {
        item.error(
            "bad-pmc-address",
            format!("`{text}` is no bit of the PMC"),
            "such as \"R1044.0\"",
        );
    }
    found
}

fn read_pmc(section: &Section<'_>) -> Option<PmcAreas> {
    let hint = "an address of the builder of the machine, such as R1000 or R1040.0";
    let byte = |key| section.require(key, hint).and_then(|item| read_byte(&item));
    let bit = |key| section.require(key, hint).and_then(|item| read_bit(&item));
    let (command, acting, heartbeat) = (byte("command"), byte("acting"), byte("heartbeat"));
    let (ask_hold, tripped) = (bit("ask_hold"), bit("tripped"));
    Some(PmcAreas {
        command: command?,
        acting: acting?,
        heartbeat: heartbeat?,
        ask_hold: ask_hold?,
        tripped: tripped?,
    })
}

fn read_mock(
    section: &Section<'_>,
    machine: &Machine,
    axes: &[AxisPlan],
) -> Option<(MockPath, LadderSettings)> {
    let feed = section
        .require("feed", "feed = \"10 m/min\"")
        .and_then(|i| i.quantity(Dimension::Velocity));
    let dwell_s = time(section, "dwell", 2.0);
    let item = section.require(
        "stops",
        "stops = [[\"0 mm\", \"0 mm\", \"0 mm\"], …], one position for each axis of the machine",
    )?;
    let read = |stop: &Item<'_>| {
        let positions = stop.list()?;
        let pairs = positions.iter().zip(machine.axes());
        let one = |(item, axis): (&Item<'_>, &trueaxis::machine::axis::Axis)| match axis.kind {
            AxisKind::Linear => item.quantity(Dimension::Length),
            AxisKind::Rotary => item.unjudged(Dimension::Angle).map(f64::to_degrees),
        };
        let found = pairs.map(one).collect::<Option<Vec<f64>>>()?;
        if positions.len() != machine.axes().len() {
            let message =
                format!("{} positions for {} axes", positions.len(), machine.axes().len());
            stop.error("bad-list", message, &machine.chain_text());
            return None;
        }
        Some(Stop { positions: found, dwell_s })
    };
    let stops = item.list()?.iter().map(read).collect::<Option<Vec<Stop>>>()?;
    let ladder =
        section.section("ladder", |s| read_ladder(s, axes)).unwrap_or_else(|| usual_ladder(axes));
    let path = MockPath::new(stops, feed? * 60.0);
    if path.is_none() {
        item.error(
            "bad-list",
            "the axes have nowhere to go".to_owned(),
            "at least one stop, and a feed above zero",
        );
    }
    Some((path?, ladder))
}

/// Twice as fast as the fastest axis, twice the largest limit, one second.
fn usual_ladder(axes: &[AxisPlan]) -> LadderSettings {
    let limit = axes.iter().map(|axis| axis.limits.limit).max().unwrap_or(0).saturating_mul(2);
    let slew = axes.iter().map(|axis| axis.limits.slew_per_s).fold(1.0, f64::max);
    LadderSettings { timeout_s: 1.0, limit, ramp_per_s: 2.0 * slew }
}

fn read_ladder(section: &Section<'_>, axes: &[AxisPlan]) -> LadderSettings {
    let usual = usual_ladder(axes);
    LadderSettings { timeout_s: time(section, "timeout", usual.timeout_s), ..usual }
}
