//! Who may ask: the right host, the own page, the token where the network can reach the server.
//!
//! - The name by which the server is called must be one of its own: a foreign page whose name was
//!   bent to 127.0.0.1 (DNS rebinding) has another.
//! - A browser names the origin of a request; only the page that came from here may ask.
//! - Beyond loopback every request needs the token, as `Authorization: Bearer`, or as the cookie
//!   that the address `/?token=…` sets.

use crate::refusal::Refusal;
use axum::http::{HeaderMap, HeaderValue, Method, Uri, header};
use std::net::IpAddr;

/// What the page may load: only what came with it.
const CONTENT_SECURITY_POLICY: &str = "default-src 'none'; script-src 'self'; style-src 'self'; \
    img-src 'self' data: blob:; connect-src 'self'; font-src 'self'; frame-src 'self'; \
    worker-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

/// A report is one page without scripts; its styles stand in it.
const REPORT_POLICY: &str = "default-src 'none'; style-src 'unsafe-inline'; img-src data:; \
    base-uri 'none'; form-action 'none'; frame-ancestors 'self'; \
    sandbox allow-modals allow-same-origin";

/// The name of the cookie.
const COOKIE: &str = "trueaxis_token";

/// The rules of one server.
#[derive(Debug, Clone)]
pub(crate) struct Guard {
    /// Beyond loopback the names by which a server is reached are many.
    pub(crate) loopback: bool,
    pub(crate) port: u16,
    pub(crate) token: Option<String>,
}

impl Guard {
    /// # Errors
    /// 403 for a foreign host or origin, 401 without the token.
    pub(crate) fn check(&self, method: &Method, headers: &HeaderMap) -> Result<(), Refusal> {
        let host = text(headers, header::HOST).unwrap_or("");
        if self.loopback && !self.is_own(host) {
            let message = "this server is called by another name";
            return Err(Refusal::new(
                403,
                "foreign-host",
                message,
                "use the address that was printed",
            ));
        }
        if let Some(origin) = text(headers, header::ORIGIN)
            && origin.strip_prefix("http://") != Some(host)
        {
            let message = "another page asks";
            return Err(Refusal::new(403, "foreign-origin", message, "open the page from here"));
        }
        if method == Method::POST && !is_json(headers) {
            let hint = "Content-Type: application/json";
            return Err(Refusal::new(415, "not-json", "the body is not sent as JSON", hint));
        }
        match &self.token {
            Some(token) if !given(headers).is_some_and(|g| same(g, token)) => {
                let hint = "open the address that was printed, with its token";
                Err(Refusal::new(401, "no-token", "this server needs its token", hint))
            }
            _ => Ok(()),
        }
    }

    fn is_own(&self, host: &str) -> bool {
        let name = match host.strip_suffix(&format!(":{}", self.port)) {
            Some(name) => name,
            // Browsers leave out the usual port.
            None if self.port == 80 => host,
            None => return false,
        };
        let bare = name.trim_start_matches('[').trim_end_matches(']');
        name == "localhost" || bare.parse::<IpAddr>().is_ok_and(|ip| ip.is_loopback())
    }

    /// `/?token=…`: the cookie to set, if the token is right.
    pub(crate) fn cookie(&self, uri: &Uri) -> Option<HeaderValue> {
        let given = uri.query()?.split('&').find_map(|part| part.strip_prefix("token="))?;
        let token = self.token.as_deref().filter(|token| same(given, token))?;
        let cookie = format!("{COOKIE}={token}; Path=/; HttpOnly; SameSite=Strict");
        HeaderValue::from_str(&cookie).ok()
    }
}

fn text(headers: &HeaderMap, name: header::HeaderName) -> Option<&str> {
    headers.get(name).and_then(|value| value.to_str().ok())
}

fn is_json(headers: &HeaderMap) -> bool {
    text(headers, header::CONTENT_TYPE)
        .is_some_and(|kind| kind.split(';').next().unwrap_or("").trim() == "application/json")
}

/// The token of a request.
fn given(headers: &HeaderMap) -> Option<&str> {
    let bearer = text(headers, header::AUTHORIZATION).and_then(|a| a.strip_prefix("Bearer "));
    let cookies = text(headers, header::COOKIE).unwrap_or("").split(';');
    let cookie = |part: &&str| part.trim().split_once('=').is_some_and(|(name, _)| name == COOKIE);
    bearer.or_else(|| cookies.into_iter().find(cookie)?.trim().split_once('=').map(|(_, v)| v))
}

/// Compares in a time that does not tell how much of it is right.
fn same(given: &str, token: &str) -> bool {
    let differences = given.bytes().zip(token.bytes()).fold(0, |d, (a, b)| d | (a ^ b));
    given.len() == token.len() && differences == 0
}

/// The headers of every answer.
pub(crate) fn add_headers(headers: &mut HeaderMap, report: bool) {
    let policy = if report { REPORT_POLICY } else { CONTENT_SECURITY_POLICY };
    let fixed = [
        ("content-security-policy", policy),
        ("x-content-type-options", "nosniff"),
        ("referrer-policy", "no-referrer"),
        ("cross-origin-opener-policy", "same-origin"),
        ("cross-origin-resource-policy", "same-origin"),
        ("cache-control", "no-store"),
    ];
    for (name, value) in fixed {
        headers.insert(name, HeaderValue::from_static(value));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn headers(list: &[(&'static str, &'static str)]) -> HeaderMap {
        list.iter().map(|(n, v)| (n.parse().unwrap(), HeaderValue::from_static(v))).collect()
    }

    fn status(guard: &Guard, method: Method, list: &[(&'static str, &'static str)]) -> u16 {
        guard.check(&method, &headers(list)).map_or_else(|refusal| refusal.status, |()| 200)
    }

    #[test]
    fn only_the_own_page_asks() {
        let guard = Guard { loopback: true, port: 7841, token: None };
        let own = ("host", "127.0.0.1:7841");
        assert_eq!(status(&guard, Method::GET, &[own]), 200);
        assert_eq!(status(&guard, Method::GET, &[("host", "localhost:7841")]), 200);
        assert_eq!(status(&guard, Method::GET, &[("host", "[::1]:7841")]), 200);
        for foreign in ["evil.example:7841", "127.0.0.1:80", "", "127.0.0.1.evil.example:7841"] {
            assert_eq!(status(&guard, Method::GET, &[("host", foreign)]), 403, "{foreign}");
        }
        let asks = |origin| status(&guard, Method::GET, &[own, ("origin", origin)]);
        assert_eq!(asks("http://127.0.0.1:7841"), 200);
        assert_eq!(asks("http://localhost:7841"), 403);
        assert_eq!(asks("null"), 403);
        assert_eq!(status(&guard, Method::POST, &[own, ("content-type", "text/plain")]), 415);
    }

    #[test]
    fn beyond_loopback_the_token_counts() {
        let guard = Guard { loopback: false, port: 7841, token: Some("a1b2".to_owned()) };
        let asks = |list: &[_]| status(&guard, Method::GET, list);
        assert_eq!(asks(&[("host", "shop:7841")]), 401);
        assert_eq!(asks(&[("host", "shop:7841"), ("authorization", "Bearer a1b2")]), 200);
        assert_eq!(asks(&[("host", "shop:7841"), ("authorization", "Bearer a1b")]), 401);
        assert_eq!(asks(&[("host", "shop:7841"), ("cookie", "x=1; trueaxis_token=a1b2")]), 200);
        assert!(guard.cookie(&"/?token=a1b2".parse().unwrap()).is_some());
        assert!(guard.cookie(&"/?token=a1".parse().unwrap()).is_none());
    }
}
