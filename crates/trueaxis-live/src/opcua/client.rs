//! The connection to an OPC UA server: one session, each step with a time limit of its own.

use super::{Nodes, Said, Value};
use crate::control::LinkFault;
use crate::file::{OpcUaServer, Security};
use crate::sensor::opcua::{Timed, age_s};
use opcua::client::{ClientBuilder, IdentityToken, Password, Session};
use opcua::crypto::SecurityPolicy;
use opcua::types::{
    DataValue, DateTime, MessageSecurityMode, NodeId, ReadValueId, TimestampsToReturn,
    UserTokenPolicy, Variant, WriteValue,
};
use std::collections::BTreeMap;
use std::str::FromStr;
use std::sync::Arc;
use std::time::Duration;
use tokio::runtime::Runtime;
use tokio::time::error::Elapsed;
use tokio::time::timeout;

/// After a connection that has failed, s.
const PAUSE_S: f64 = 1.0;
/// To open one takes some exchanges, with encryption some of arithmetic: so many time limits.
const OPENING: u32 = 10;
/// The time of every server. The time that it gives to a value need not be that at which it was asked.
const CURRENT_TIME: &str = "i=2258";
/// Manufacturer, product and software version of every server (OPC 10000-5).
const BUILD_INFO: [&str; 3] = ["i=2263", "i=2261", "i=2264"];

/// One server.
pub struct Client {
    server: OpcUaServer,
    runtime: Runtime,
    session: Option<Arc<Session>>,
    /// Not before, s.
    again_s: f64,
    /// The type of each node that was written.
    kinds: BTreeMap<String, Variant>,
}

impl std::fmt::Debug for Client {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Client").field("endpoint", &self.server.endpoint).finish_non_exhaustive()
    }
}

fn down(reason: impl std::fmt::Display) -> LinkFault {
    LinkFault::Down { reason: reason.to_string() }
}

impl Client {
    /// Of a server; it connects when it is asked first.
    ///
    /// # Errors
    /// What the system says.
    pub fn of(server: &OpcUaServer) -> std::io::Result<Self> {
        let runtime =
            tokio::runtime::Builder::new_multi_thread().worker_threads(1).enable_all().build()?;
        let (session, kinds) = (None, BTreeMap::new());
        Ok(Self { server: server.clone(), runtime, session, again_s: f64::NEG_INFINITY, kinds })
    }

    fn limit(&self) -> Duration {
        Duration::from_secs_f64(self.server.timeout_s)
    }

    /// Waits so long at most; a limit counts within a runtime only.
    fn within<T>(&self, limit: Duration, work: impl Future<Output = T>) -> Result<T, Elapsed> {
        self.runtime.block_on(async { timeout(limit, work).await })
    }

    fn silent(&self) -> LinkFault {
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "ms of a limit"
        )]
        let millis = (self.server.timeout_s * 1e3) as u32;
        LinkFault::Silent { millis }
    }

    /// The session, opened if there is none.
    fn session(&mut self, now_s: f64) -> Result<Arc<Session>, LinkFault> {
        if let Some(session) = &self.session {
            return Ok(Arc::clone(session));
        }
        if now_s < self.again_s {
            return Err(down("no session; it is opened again in a moment"));
        }
        self.again_s = now_s + PAUSE_S;
        let opened = self.within(OPENING * self.limit(), open(&self.server));
        let session = opened.map_err(|_| self.silent())??;
        self.session = Some(Arc::clone(&session));
        Ok(session)
    }

    /// The session is given up: what comes late is not taken for an answer to what is asked next.
    fn give_up(&mut self, now_s: f64) {
        self.again_s = now_s + PAUSE_S;
        if let Some(session) = self.session.take() {
            self.runtime.spawn(async move {
                // It may be gone already.
                let _ = timeout(Duration::from_secs(1), session.disconnect()).await;
            });
        }
    }

    /// What the server says of nodes, each with the times that it has.
    fn answers(&mut self, nodes: &[&str], now_s: f64) -> Result<Vec<DataValue>, LinkFault> {
        let ids = nodes.iter().map(|node| id(node)).collect::<Result<Vec<_>, _>>()?;
        let session = self.session(now_s)?;
        let asked: Vec<ReadValueId> = ids.into_iter().map(ReadValueId::from).collect();
        let work = session.read(&asked, TimestampsToReturn::Both, 0.0);
        let answered = match self.within(self.limit(), work) {
            Ok(Ok(answered)) => answered,
            Ok(Err(fault)) => {
                self.give_up(now_s);
                return Err(down(fault));
            }
            Err(_) => {
                self.give_up(now_s);
                return Err(self.silent());
            }
        };
        if answered.len() != nodes.len() {
            let reason = format!("{} values answer {}", answered.len(), nodes.len());
            return Err(LinkFault::Garbage { reason });
        }
        Ok(answered)
    }

    fn values(&mut self, nodes: &[&str], now_s: f64) -> Result<Vec<Said<Variant>>, LinkFault> {
        Ok(self.answers(nodes, now_s)?.into_iter().map(good).collect())
    }

    /// Values with their ages: the time of the server less that of the source.
    ///
    /// # Errors
    /// [`LinkFault`] where the server was not reached.
    pub fn timed(&mut self, nodes: &[&str], now_s: f64) -> Result<Vec<Said<Timed>>, LinkFault> {
        let all: Vec<&str> = nodes.iter().copied().chain([CURRENT_TIME]).collect();
        let mut answers = self.answers(&all, now_s)?;
        let server = match answers.pop().map(good) {
            Some(Ok(Variant::DateTime(time))) => Some(time),
            _ => None,
        };
        let one = |answer: DataValue| {
            let times = server.as_deref().copied().zip(answer.source_timestamp);
            let age_s = times.map(|(server, source)| age_s(seconds(server), seconds(source)));
            good(answer).and_then(number_or_bit).map(|value| Timed { value, age_s })
        };
        Ok(answers.into_iter().map(one).collect())
    }

    /// A value in the type that its node has.
    fn in_kind(
        &mut self,
        node: &str,
        value: &Value,
        now_s: f64,
    ) -> Result<Said<Variant>, LinkFault> {
        if !self.kinds.contains_key(node) {
            let found = self.values(&[node], now_s)?.pop();
            match found.unwrap_or_else(|| Err("no value".to_owned())) {
                Ok(kind) => self.kinds.insert(node.to_owned(), kind),
                Err(reason) => return Ok(Err(reason)),
            };
        }
        let kind = self.kinds.get(node);
        Ok(kind.and_then(|kind| converted(kind, value)).ok_or_else(|| "another type".to_owned()))
    }
}

/// Since 1601, s; two microseconds are nothing of an age.
#[expect(clippy::cast_precision_loss, reason = "a time of today has 57 bits: rounded to 1.6 us")]
fn seconds(time: DateTime) -> f64 {
    time.ticks() as f64 * 1e-7
}

/// The value of a node, or its status; no status means good.
fn good(answer: DataValue) -> Said<Variant> {
    match answer.status.filter(|status| !status.is_good()) {
        Some(status) => Err(status.to_string()),
        None => answer.value.ok_or_else(|| "no value".to_owned()),
    }
}

fn number_or_bit(variant: Variant) -> Said<Value> {
    value_of(&variant).ok_or_else(|| "neither number nor bit".to_owned())
}

/// The server is opened: its endpoint with this security, this user.
async fn open(server: &OpcUaServer) -> Result<Arc<Session>, LinkFault> {
    let (policy, mode) = match server.security {
        Security::None => (SecurityPolicy::None, MessageSecurityMode::None),
        Security::Sign => (SecurityPolicy::Basic256Sha256, MessageSecurityMode::Sign),
        Security::SignAndEncrypt => {
            (SecurityPolicy::Basic256Sha256, MessageSecurityMode::SignAndEncrypt)
        }
    };
    let builder = ClientBuilder::new()
        .application_name("TrueAxis")
        .application_uri("urn:TrueAxis")
        .pki_dir(&server.pki)
        .create_sample_keypair(server.security != Security::None)
        .trust_server_certs(false)
        .session_retry_limit(0)
        .request_timeout(Duration::from_secs_f64(server.timeout_s));
    let mut client = builder.client().map_err(|faults| down(faults.join("; ")))?;
    let token = match &server.login {
        Some((user, password)) => IdentityToken::UserName(user.clone(), Password::new(password)),
        None => IdentityToken::Anonymous,
    };
    let endpoint = (server.endpoint.as_str(), policy.to_str(), mode, UserTokenPolicy::anonymous());
    let (session, events) =
        client.connect_to_matching_endpoint(endpoint, token).await.map_err(down)?;
    let ended = events.spawn();
    tokio::select! {
        connected = session.wait_for_connection() => match connected {
            true => Ok(session),
            false => Err(down("the session was refused")),
        },
        status = ended => Err(down(refusal(status.ok().map(|s| s.to_string()), server))),
    }
}

/// Why no session came about, with what to do.
fn refusal(status: Option<String>, server: &OpcUaServer) -> String {
    let status = status.unwrap_or_else(|| "the connection has ended".to_owned());
    if status.contains("UserAccess") || status.contains("IdentityToken") {
        return format!("{status}: the server refuses this user or password");
    }
    match server.security {
        Security::None => status,
        _ => format!(
            "{status}; certificates: move that of the server from rejected to trusted in {}, and trust own/cert.der of it in the server",
            server.pki.display()
        ),
    }
}

fn id(node: &str) -> Result<NodeId, LinkFault> {
    let fault = |_| LinkFault::Refused {
        call: node.to_owned(),
        reason: "it is no node: ns=2;s=name, or ns=2;i=number".to_owned(),
    };
    NodeId::from_str(node).map_err(fault)
}

/// A scalar of a server as a value; none of any other type.
fn value_of(variant: &Variant) -> Option<Value> {
    Some(Value::Number(match variant {
        Variant::Boolean(flag) => return Some(Value::Flag(*flag)),
        Variant::SByte(n) => f64::from(*n),
        Variant::Byte(n) => f64::from(*n),
        Variant::Int16(n) => f64::from(*n),
        Variant::UInt16(n) => f64::from(*n),
        Variant::Int32(n) => f64::from(*n),
        Variant::UInt32(n) => f64::from(*n),
        Variant::Float(n) => f64::from(*n),
        Variant::Double(n) => *n,
        _ => return None,
    }))
}

/// A value in the type of a scalar; none where it has no such value.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "checked: what does not come back is refused"
)]
fn converted(kind: &Variant, value: &Value) -> Option<Variant> {
    let n = value.number();
    let made = match kind {
        Variant::Boolean(_) => Variant::Boolean(value.flag()),
        Variant::SByte(_) => Variant::SByte(n as i8),
        Variant::Byte(_) => Variant::Byte(n as u8),
        Variant::Int16(_) => Variant::Int16(n as i16),
        Variant::UInt16(_) => Variant::UInt16(n as u16),
        Variant::Int32(_) => Variant::Int32(n as i32),
        Variant::UInt32(_) => Variant::UInt32(n as u32),
        Variant::Float(_) => return Some(Variant::Float(n as f32)),
        Variant::Double(_) => return Some(Variant::Double(n)),
        _ => return None,
    };
    value_of(&made).filter(|back| back.number() == n).map(|_| made)
}

impl Nodes for Client {
    fn read(&mut self, nodes: &[&str], now_s: f64) -> Result<Vec<Said<Value>>, LinkFault> {
        let said = self.values(nodes, now_s)?.into_iter();
        Ok(said.map(|said| said.and_then(number_or_bit)).collect())
    }

    fn write(&mut self, nodes: &[(&str, Value)], now_s: f64) -> Result<Vec<Said<()>>, LinkFault> {
        let mut writes = Vec::with_capacity(nodes.len());
        for (node, value) in nodes {
            match self.in_kind(node, value, now_s)? {
                Ok(variant) => writes.push(WriteValue::value_attr(id(node)?, variant)),
                // Nothing is written where one of them cannot be.
                Err(reason) => {
                    return Err(LinkFault::Refused { call: (*node).to_owned(), reason });
                }
            }
        }
        let session = self.session(now_s)?;
        match self.within(self.limit(), session.write(&writes)) {
            Ok(Ok(said)) => Ok(said
                .into_iter()
                .map(|status| if status.is_good() { Ok(()) } else { Err(status.to_string()) })
                .collect()),
            Ok(Err(fault)) => {
                self.give_up(now_s);
                Err(down(fault))
            }
            Err(_) => {
                self.give_up(now_s);
                Err(self.silent())
            }
        }
    }

    fn server(&mut self, now_s: f64) -> Result<[String; 3], LinkFault> {
        let said = self.values(&BUILD_INFO, now_s)?;
        let texts = said.into_iter().map(|said| match said {
            Ok(Variant::String(text)) => text.to_string(),
            _ => String::new(),
        });
        texts.collect::<Vec<_>>().try_into().map_err(|_| down("no build info"))
    }
}
