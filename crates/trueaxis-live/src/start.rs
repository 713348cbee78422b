//! From a plan to a run: the control is opened and compared with the plan before anything is written.

use crate::control::{Control, Identity, LinkFault};
use crate::file::{Bound, FanucPlan, OpcUaPlan, Plan, Source};
use crate::focas::{Fanuc, FanucSettings, Wire};
use crate::linuxcnc::{HalPins, Joint, LinuxCnc, LinuxCncSettings, LiveJoint};
use crate::mock::{FanucMock, MockPlan};
use crate::opcua::{Nodes, OpcUa, OpcUaSettings};
use crate::sensor::{LogSensor, Sample, Sensor, Sent, modbus, mqtt, opcua};
use crate::store::Owner;
use trueaxis::input::{Diagnostics, Place};
use trueaxis::machine::axis::AxisKind;

/// The mock of a plan whose address is `mock`.
pub fn mock_of(plan: &Plan) -> Option<FanucMock> {
    let fanuc = plan.control.fanuc()?;
    let (path, ladder) = fanuc.mock.clone()?;
    let areas = fanuc.pmc.unwrap_or(UNUSED);
    Some(FanucMock::new(MockPlan {
        axes: plan.machine.axes().iter().map(|axis| axis.name.to_string()).collect(),
        live: plan.axes.iter().map(|axis| axis.axis).collect(),
        decimals: decimals(plan.axes.first().map_or(1e-3, |axis| axis.increment)).unwrap_or(3),
        path,
        areas,
        referenced: fanuc.referenced,
        inhibit: fanuc.inhibit,
        ladder,
    }))
}

/// Where a ladder that is not used would be.
const UNUSED: crate::focas::PmcAreas = {
    use crate::focas::{PmcAddress, PmcAreas, PmcBit};
    const fn byte(byte: u16) -> PmcAddress {
        PmcAddress { letter: 'D', byte }
    }
    PmcAreas {
        command: byte(0),
        acting: byte(64),
        heartbeat: byte(128),
        ask_hold: PmcBit { byte: byte(129), bit: 0 },
        tripped: PmcBit { byte: byte(130), bit: 0 },
    }
};

/// Digits after the decimal point of an increment that is a power of ten, in mm or deg.
fn decimals(increment: f64) -> Option<u16> {
    (0..=9).find(|digits| (increment * 10f64.powi(i32::from(*digits)) - 1.0).abs() < 1e-6)
}

/// Opens the control of a plan and compares it; nothing is written.
///
/// # Errors
/// What differs, each with its place and its cure.
pub fn connect<W: Wire>(
    (plan, fanuc): (&Plan, &FanucPlan),
    wire: W,
    now_s: f64,
) -> Result<(Fanuc<W>, Identity), Diagnostics> {
    let all = (1..).take(plan.machine.axes().len()).collect();
    let mut control = Fanuc::new(wire, settings(plan, fanuc, all));
    let place = Place::whole(&plan.path.display().to_string());
    let mut problems = Diagnostics::new();
    let identity = match control.identity(now_s) {
        Ok(identity) => identity,
        Err(fault) => {
            problems.error(
                "live-no-link",
                place,
                format!("the control cannot be asked: {fault}"),
                cure(&fault),
            );
            return Err(problems);
        }
    };
    let numbers = compare(plan, fanuc, &identity, &mut problems);
    if problems.has_errors() {
        return Err(problems);
    }
    Ok((control.with(settings(plan, fanuc, numbers)), identity))
}

/// The kinds of control whose answers to these calls are published (docs/ladder-watchdog.md).
const KNOWN_KINDS: [&str; 5] = ["0", "30", "31", "32", "35"];

/// What is not known of a FANUC control, in words.
pub fn doubt(plan: &Plan, found: &Identity) -> Option<String> {
    let is_new = plan.control.fanuc().is_some() && !KNOWN_KINDS.contains(&found.kind.as_str());
    is_new.then(|| {
        format!(
            "the control is a FANUC {}: the calls of this program are published for 0i and 30i to 35i only; compare \
             positions, feed, mode and offset with its screen in a --dry-run before anything is cut",
            found.kind
        )
    })
}

/// Which joints of LinuxCNC belong to a plan.
pub fn linuxcnc_settings(plan: &Plan) -> LinuxCncSettings {
    let joint = |axis: &trueaxis::machine::axis::Axis| Joint {
        name: axis.name.to_string(),
        is_rotary: axis.kind == AxisKind::Rotary,
    };
    let live =
        |axis: &crate::file::AxisPlan| LiveJoint { joint: axis.axis, increment: axis.increment };
    LinuxCncSettings {
        joints: plan.machine.axes().iter().map(joint).collect(),
        live: plan.axes.iter().map(live).collect(),
        timeout_s: plan.control.timeout_s(),
        has_setup: matches!(plan.control, crate::file::ControlPlan::LinuxCnc(own) if own.has_setup),
    }
}

/// Opens LinuxCNC on this computer; nothing is written but what it holds already.
///
/// # Errors
/// What is missing, with its cure.
pub fn connect_linuxcnc(plan: &Plan) -> Result<(LinuxCnc<HalPins>, Identity), Diagnostics> {
    let settings = linuxcnc_settings(plan);
    let hint = "start LinuxCNC with examples/08_live/linuxcnc/trueaxis.hal among its HALFILEs, then this as the same user";
    let pins = HalPins::open(&settings.layout())
        .map_err(|fault| no_link(plan, fault.to_string(), hint))?;
    let mut control = LinuxCnc::new(pins, settings);
    let identity = control.identity(0.0).map_err(|fault| no_link(plan, fault.to_string(), hint))?;
    Ok((control, identity))
}

/// Which nodes of a server belong to a plan.
pub fn opcua_settings(plan: &Plan, opcua: &OpcUaPlan) -> OpcUaSettings {
    let kind = |axis: usize| plan.machine.axes()[axis].kind;
    let increment = |axis: &crate::file::AxisPlan| match kind(axis.axis) {
        AxisKind::Rotary => axis.increment.to_degrees(),
        AxisKind::Linear => axis.increment,
    };
    OpcUaSettings {
        nodes: opcua.nodes.clone(),
        axes: plan.machine.axes().iter().map(|axis| axis.name.to_string()).collect(),
        rotary: plan.machine.axes().iter().map(|axis| axis.kind == AxisKind::Rotary).collect(),
        live: plan.axes.iter().map(|axis| axis.axis).collect(),
        increments: plan.axes.iter().map(increment).collect(),
        positions_have_offset: opcua.positions_have_offset,
        modes: opcua.modes.clone(),
    }
}

/// Opens a server of OPC UA and compares it; nothing is written.
///
/// # Errors
/// What differs, each with its cure; without the feature `opcua` that it is missing.
pub fn connect_opcua(
    plan: &Plan,
    opcua: &OpcUaPlan,
    now_s: f64,
) -> Result<(Box<dyn Control>, Identity), Diagnostics> {
    #[cfg(feature = "opcua")]
    {
        let client = crate::opcua::Client::of(&opcua.server).map_err(|error| {
            let message = format!("the connection cannot be opened: {error}");
            no_link(plan, message, "let the program have one more thread")
        })?;
        let mut control = OpcUa::new(client, opcua_settings(plan, opcua));
        let identity = compared(plan, opcua, &mut control, now_s)?;
        Ok((Box::new(control), identity))
    }
    #[cfg(not(feature = "opcua"))]
    {
        let _ = (opcua, now_s);
        Err(without_opcua(plan))
    }
}

fn no_link(plan: &Plan, message: String, hint: &str) -> Diagnostics {
    let mut problems = Diagnostics::new();
    let place = Place::whole(&plan.path.display().to_string());
    problems.error("live-no-link", place, message, hint);
    problems
}

/// A control of OPC UA is the one of the plan, and every node of it can be read.
///
/// # Errors
/// What differs, with its cure.
pub fn compared<N: Nodes>(
    plan: &Plan,
    opcua: &OpcUaPlan,
    control: &mut OpcUa<N>,
    now_s: f64,
) -> Result<Identity, Diagnostics> {
    let hint =
        "check the endpoint, security and user of the plan, and the nodes as the server shows them";
    let asked =
        |fault: LinkFault| no_link(plan, format!("the control cannot be asked: {fault}"), hint);
    let found = control.identity(now_s).map_err(asked)?;
    let mut problems = Diagnostics::new();
    check_bound(plan, opcua.bound.as_ref(), &found, &mut problems);
    if problems.has_errors() {
        return Err(problems);
    }
    control.read(now_s).map_err(asked)?;
    Ok(found)
}

fn cure(fault: &LinkFault) -> &'static str {
    match fault {
        LinkFault::Refused { .. } => "the reason names what to switch on in the control",
        LinkFault::Garbage { .. } => {
            "is it a FANUC control with FOCAS2 over Ethernet at that port (8193)?"
        }
        LinkFault::Down { .. } | LinkFault::Silent { .. } => {
            "check address and port, the Ethernet parameters of the control, and whether other clients use up its connections"
        }
    }
}

fn settings(plan: &Plan, fanuc: &FanucPlan, numbers: Vec<u16>) -> FanucSettings {
    FanucSettings {
        lever: fanuc.lever,
        numbers,
        live: plan.axes.iter().map(|axis| axis.axis).collect(),
        rotary: plan.machine.axes().iter().map(|axis| axis.kind == AxisKind::Rotary).collect(),
        referenced: fanuc.referenced,
        inhibit: fanuc.inhibit,
        setup: fanuc.setup,
        pmc: fanuc.pmc,
    }
}

/// Whether the control is the one that the plan is of.
fn check_bound(plan: &Plan, bound: Option<&Bound>, found: &Identity, problems: &mut Diagnostics) {
    let Some(bound) = bound.filter(|bound| !bound.is(found)) else { return };
    let Identity { kind, series, version, .. } = found;
    let message = format!(
        "the control at that address is {kind} {series} {version}, the plan is of {} {} {}",
        bound.kind, bound.series, bound.version
    );
    problems.error(
        "live-other-control",
        Place::whole(&plan.path.display().to_string()),
        message,
        "correct the address; after an update of the control, its identity",
    );
}

/// The numbers of the axes of the machine in the control; what differs goes to `problems`.
fn compare(
    plan: &Plan,
    fanuc: &FanucPlan,
    found: &Identity,
    problems: &mut Diagnostics,
) -> Vec<u16> {
    let place = || Place::whole(&plan.path.display().to_string());
    check_bound(plan, fanuc.bound.as_ref(), found, problems);
    let mut numbers = Vec::new();
    for (i, axis) in plan.machine.axes().iter().enumerate() {
        let name = axis.name.to_string();
        let Some(at) = found.axes.iter().position(|known| *known == name) else {
            let message =
                format!("the control has no axis {name}; it has {}", found.axes.join(" "));
            problems.error(
                "live-axis-missing",
                place(),
                message,
                "is it the machine of the machine file, and the right path of the control?",
            );
            continue;
        };
        numbers.push(u16::try_from(at + 1).unwrap_or(u16::MAX));
        let Some(live) = plan.axes.iter().find(|live| live.axis == i) else { continue };
        let increment = if axis.kind == AxisKind::Rotary {
            live.increment.to_degrees()
        } else {
            live.increment
        };
        if decimals(increment) != found.decimals.get(at).copied() {
            let digits = found.decimals.get(at).copied().unwrap_or(0);
            let message = format!(
                "the control counts axis {name} with {digits} digits, the plan with an increment of {increment} mm or deg"
            );
            let hint = "increment is the least input increment of the control (IS-B: 1 um, IS-C: 0.1 um) in mm, not in inches";
            problems.error("live-increment", place(), message, hint);
        }
    }
    numbers
}

/// Whose offsets they are.
pub fn owner(plan: &Plan, control: &Identity) -> Owner {
    // Offsets at the ends of a travel are others than those at the position.
    let name = |axis: &crate::file::AxisPlan| match axis.line {
        Some([from, to]) => format!("{} at {from} and {to} mm", axis.name),
        None => axis.name.clone(),
    };
    let axes = plan.axes.iter().map(name).collect();
    Owner { machine: plan.machine.name().to_owned(), control: control.clone(), axes }
}

/// Whether this program has what the plan needs.
///
/// # Errors
/// What it was built without.
pub fn check_built(plan: &Plan) -> Result<(), Diagnostics> {
    let asked = plan.sensors.iter().any(|sensor| matches!(sensor.source, Source::OpcUa(_)));
    if asked && cfg!(not(feature = "opcua")) { Err(without_opcua(plan)) } else { Ok(()) }
}

fn without_opcua(plan: &Plan) -> Diagnostics {
    let message = "this program was built without OPC UA".to_owned();
    no_link(plan, message, "build it with it: cargo build --release --features opcua")
}

/// The sensors of a plan.
pub fn sensors_of(plan: &Plan) -> Vec<Box<dyn Sensor>> {
    let (mut sensors, mut nodes): (Vec<Box<dyn Sensor>>, Vec<_>) = (Vec::new(), Vec::new());
    for (i, sensor) in plan.sensors.iter().enumerate() {
        sensors.push(match &sensor.source {
            Source::Log { log, column, start_s, speed } => {
                Box::new(LogSensor::new(log.clone(), column, i, *start_s).at_speed(*speed))
            }
            Source::Mqtt(source) => mqtt::subscribe(source, i),
            Source::Modbus(source) => modbus::read_register(source, i),
            Source::OpcUa(source) => {
                nodes.push((i, source.as_ref()));
                continue;
            }
            Source::Constant { celsius } => {
                Box::new(ConstantSensor { sensor: i, celsius: *celsius, next_s: 0.0 })
            }
        });
    }
    sensors.extend(opcua::read_nodes(&nodes));
    sensors
}

/// One value, every second.
struct ConstantSensor {
    sensor: usize,
    celsius: f64,
    next_s: f64,
}

impl Sensor for ConstantSensor {
    fn poll(&mut self, now_s: f64) -> Vec<Sample> {
        if now_s < self.next_s {
            return Vec::new();
        }
        self.next_s = now_s + 1.0;
        vec![Sample { sensor: self.sensor, sent: Sent::number(self.celsius), taken_s: Some(now_s) }]
    }
}
