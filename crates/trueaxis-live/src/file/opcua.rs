//! `[control] kind = "opc-ua"` of a plan.

use super::axes::AxisPlan;
use super::control::{Bound, check_commissioned, read_identity};
use super::sources::read_password;
use super::{time, word};
use crate::control::Mode;
use crate::opcua::{LineNodes, NodeNames};
use std::path::{Path, PathBuf};
use trueaxis::input::Section;
use trueaxis::machine::Machine;
use trueaxis::machine::axis::{AxisKind, Travel};

/// How messages are protected.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Security {
    /// Not at all.
    None,
    /// Signed.
    Sign,
    /// Signed and encrypted (Basic256Sha256).
    SignAndEncrypt,
}

/// How a server is reached.
#[derive(Debug, Clone, PartialEq)]
pub struct OpcUaServer {
    /// `opc.tcp://host:4840`.
    pub endpoint: String,
    /// How messages are protected.
    pub security: Security,
    /// User and password.
    pub login: Option<(String, String)>,
    /// The folder of certificates: `own`, `trusted`, `rejected`.
    pub pki: PathBuf,
    /// The time limit of one exchange.
    pub timeout_s: f64,
}

/// A control with an OPC UA server.
#[derive(Debug, Clone, PartialEq)]
pub struct OpcUaPlan {
    /// Its server.
    pub server: OpcUaServer,
    /// The server that this plan is of.
    pub bound: Option<Bound>,
    /// Which node is what.
    pub nodes: NodeNames,
    /// Positions have the offset in them.
    pub positions_have_offset: bool,
    /// What the numbers of the mode mean.
    pub modes: Vec<(i32, Mode)>,
}

/// A node is named as `ns=2;s=name` or `ns=2;i=number`.
fn is_node(text: &str) -> bool {
    let rest = match text.strip_prefix("ns=") {
        Some(rest) => match rest.split_once(';') {
            Some((space, rest)) if space.parse::<u16>().is_ok() => rest,
            _ => return false,
        },
        None => text,
    };
    match rest.split_once('=') {
        Some(("i", number)) => number.parse::<u32>().is_ok(),
        Some(("s" | "g" | "b", name)) => !name.is_empty(),
        _ => false,
    }
}

const NODE_HINT: &str =
    "\"ns=2;s=/Channel/MachineAxis/actToolBasePos[u1,1]\", as the server names it";

fn node(section: &Section<'_>, key: &str) -> Option<String> {
    let item = section.get(key)?;
    let text = item.text()?;
    if is_node(text) {
        return Some(text.to_owned());
    }
    item.error("live-node", format!("`{text}` is no node"), NODE_HINT);
    None
}

pub(super) fn needed(section: &Section<'_>, key: &str) -> Option<String> {
    section.require(key, &format!("{key} = {NODE_HINT}"))?;
    node(section, key)
}

/// One node for each axis, such as `position = { X = …, Y = … }`.
fn of_axes(section: &Section<'_>, key: &str, axes: &[String]) -> Option<Vec<String>> {
    let read =
        |s: &Section<'_>| axes.iter().map(|axis| needed(s, axis)).collect::<Option<Vec<_>>>();
    section.section(key, read).flatten()
}

/// The server that a key names, and what else is said of the way to it.
pub(super) fn read_server(section: &Section<'_>, key: &str, folder: &Path) -> Option<OpcUaServer> {
    let endpoint = section.require(key, &format!("{key} = \"opc.tcp://192.168.1.30:4840\""));
    let endpoint = endpoint.and_then(|item| {
        let text = item.text()?;
        if !text.starts_with("opc.tcp://") {
            let message = format!("`{text}` is no endpoint");
            item.error("bad-address", message, "\"opc.tcp://192.168.1.30:4840\"");
            return None;
        }
        Some(text.to_owned())
    });
    let kinds = [
        ("none", Security::None),
        ("sign", Security::Sign),
        ("sign-and-encrypt", Security::SignAndEncrypt),
    ];
    let hint = "security = \"sign-and-encrypt\", \"sign\", or \"none\"";
    let security = section.require("security", hint).and_then(|item| word(&item, &kinds));
    let login = read_login(section, folder);
    let timeout_s = time(section, "timeout", 0.5);
    Some(OpcUaServer {
        endpoint: endpoint?,
        security: security?,
        login: login?,
        pki: section.text("pki").map_or_else(|| folder.join("pki"), |name| folder.join(name)),
        timeout_s,
    })
}

pub(super) fn read_opcua(
    section: &Section<'_>,
    folder: &Path,
    (machine, axes): (&Machine, &[AxisPlan]),
    commissions: bool,
) -> Option<OpcUaPlan> {
    let server = read_server(section, "endpoint", folder);
    let bound = section.section("identity", read_identity).flatten();
    let hint = "positions_have_offset = true where the position that is read has the offset in it";
    let have = section.require("positions_have_offset", hint).and_then(|item| item.flag());
    let modes = section.section("modes", read_modes).unwrap_or_else(usual_modes);
    let all: Vec<String> = machine.axes().iter().map(|axis| axis.name.to_string()).collect();
    let hint = "[control.nodes] position = { X = … }, offset = { X = … }, referenced, inhibit, running, mode, emergency; if there are such: acting, slope, reference, heartbeat, tripped, ask_hold, alarm, feed, setup";
    let nodes = section.require("nodes", hint);
    let nodes = nodes
        .and_then(|item| item.section("nodes", |s| read_nodes(s, &all, (machine, axes))).flatten());
    if bound.is_none() {
        let message = "the plan does not say which control is at that address".to_owned();
        let hint = "identity = { kind = …, series = …, version = … }: where it differs, the refusal names what the server says of itself";
        section.error("live-not-bound", message, hint);
    }
    if !commissions {
        check_commissioned(axes, |code, message, hint| section.error(code, message, hint));
    }
    Some(OpcUaPlan { server: server?, bound, nodes: nodes?, positions_have_offset: have?, modes })
}

/// None inside is no login.
fn read_login(section: &Section<'_>, folder: &Path) -> Option<Option<(String, String)>> {
    let Some(user) = section.text("user").map(str::to_owned) else { return Some(None) };
    let hint = "password_file = \"opcua.secret\": a file with the password in one line";
    let item = section.require("password_file", hint)?;
    Some(Some((user, read_password(section, &item, folder)?)))
}

/// Those of SINUMERIK's operating mode.
fn usual_modes() -> Vec<(i32, Mode)> {
    vec![(0, Mode::Manual), (1, Mode::Mdi), (2, Mode::Automatic)]
}

#[expect(clippy::cast_possible_truncation, reason = "checked: whole, and of a few digits")]
fn read_modes(section: &Section<'_>) -> Vec<(i32, Mode)> {
    let mut found = Vec::new();
    for (name, mode) in Mode::NAMED {
        let Some(item) = section.get(name) else { continue };
        match item.number().filter(|n| n.fract() == 0.0 && n.abs() < 1e6) {
            Some(number) => found.push((number as i32, mode)),
            None => item.error("live-node", "a mode is a whole number".to_owned(), "automatic = 2"),
        }
    }
    found
}

/// `slope` and `reference`, each with the axes along which the control corrects; of any other axis none.
fn read_lines(
    section: &Section<'_>,
    (machine, axes): (&Machine, &[AxisPlan]),
) -> Option<Vec<Option<LineNodes>>> {
    let [slopes, references] = ["slope", "reference"].map(|key| {
        let named = |s: &Section<'_>| {
            let read = |axis: &AxisPlan| {
                let stated = s.get(&axis.name).is_some();
                if stated { node(s, &axis.name).map(Some) } else { Some(None) }
            };
            axes.iter().map(read).collect::<Option<Vec<_>>>()
        };
        section.section(key, named).unwrap_or_else(|| Some(vec![None; axes.len()]))
    });
    let mut lines = Vec::new();
    for (axis, (slope, reference)) in axes.iter().zip(slopes?.into_iter().zip(references?)) {
        let fault = |message: String, hint: &str| section.error("live-line", message, hint);
        let own = &machine.axes()[axis.axis];
        lines.push(match (slope, reference, own.travel) {
            (None, None, _) => None,
            (Some(slope), Some(reference), Travel::Between(from, to))
                if own.kind == AxisKind::Linear =>
            {
                Some(LineNodes { slope, reference, ends: [from, to] })
            }
            (Some(_), Some(_), _) => {
                let message = format!("axis {} has no two ends to draw a line between", axis.name);
                fault(message, "slope is of a linear axis with its travel in the machine file");
                return None;
            }
            _ => {
                let message = format!("axis {} has one of slope and reference", axis.name);
                fault(
                    message,
                    "both: slope = { X = … } (SD43910), reference = { X = … } (SD43920)",
                );
                return None;
            }
        });
    }
    Some(lines)
}

fn read_nodes(
    section: &Section<'_>,
    all: &[String],
    (machine, axes): (&Machine, &[AxisPlan]),
) -> Option<NodeNames> {
    let live: Vec<String> = axes.iter().map(|axis| axis.name.clone()).collect();
    let live = live.as_slice();
    let (positions, offsets) =
        (of_axes(section, "position", all), of_axes(section, "offset", live));
    let lines = read_lines(section, (machine, axes))?;
    let acting = section.get("acting").map(|_| of_axes(section, "acting", live));
    if acting.is_some() && lines.iter().any(Option::is_some) {
        let message = "`acting` is one number, and a line has two".to_owned();
        let hint = "leave `acting` out: with slope and reference what acts is computed from them";
        section.error("live-line", message, hint);
    }
    let [referenced, inhibit, running, mode, emergency] =
        ["referenced", "inhibit", "running", "mode", "emergency"].map(|key| needed(section, key));
    let [alarm, feed, heartbeat, ask_hold, tripped, setup] =
        ["alarm", "feed", "heartbeat", "ask_hold", "tripped", "setup"]
            .map(|key| node(section, key));
    Some(NodeNames {
        positions: positions?,
        offsets: offsets?,
        lines,
        acting: acting.map_or(Some(None), |found| found.map(Some))?,
        referenced: referenced?,
        inhibit: inhibit?,
        running: running?,
        mode: mode?,
        emergency: emergency?,
        alarm,
        feed,
        heartbeat,
        ask_hold,
        tripped,
        setup,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nodes_are_named_as_servers_name_them() {
        for good in ["i=2258", "ns=2;s=/Channel/Spindle[u1,2]", "ns=65535;i=1", "ns=3;g=x", "s=a=b"]
        {
            assert!(is_node(good), "{good}");
        }
        for bad in ["", "ns=2", "ns=x;i=1", "ns=70000;i=1", "i=-1", "ns=2;s=", "x=1", "2258"] {
            assert!(!is_node(bad), "{bad}");
        }
    }
}
