//! Who may ask: the right host, the own page, the token where the network can reach the server.
//!
//! - The name by which the server is called must be one of its own: a foreign page whose name was
//!   bent to 127.0.0.1 (DNS rebinding) has another.
//! - A browser names the origin of a request; only the page that came from here may ask.
//! - Every request needs the token, as `Authorization: Bearer`, or as the cookie that the address `/?token=…` sets:
//!   on loopback, too, as every user of this computer can reach it. `--no-token` gives it up, on loopback only.
//! - A proxy with TLS gives the page another origin, such as `https://mill.example`. It is accepted where it was stated
//!   (`--origin`); headers in which a request says where it comes from (`Forwarded`) are not read, as anyone can
//!   write them.

use crate::body::short;
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

/// The origin of a page: scheme, name and, if it is not the usual one, port.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Origin {
    /// All of it, as a browser writes it.
    pub(crate) text: String,
    is_https: bool,
}

impl Origin {
    /// # Errors
    /// What is wrong with it.
    pub(crate) fn parse(text: &str) -> Result<Self, String> {
        let lower = text.to_ascii_lowercase();
        let bare = lower.strip_suffix('/').unwrap_or(&lower);
        let (is_https, rest) = match bare.split_once("://") {
            Some(("https", rest)) => (true, rest),
            Some(("http", rest)) => (false, rest),
            _ => return Err(format!("`{}` does not begin with https://", short(text))),
        };
        // Browsers leave out the usual port.
        let usual = if is_https { ":443" } else { ":80" };
        let host = rest.strip_suffix(usual).unwrap_or(rest);
        let is_plain = |c: char| c.is_ascii_alphanumeric() || ".-:[]".contains(c);
        if host.is_empty() || !host.chars().all(is_plain) {
            let form = "an origin is scheme and name, such as https://mill.example, without a path";
            return Err(format!("`{}`: {form}", short(text)));
        }
        let scheme = if is_https { "https" } else { "http" };
        Ok(Self { text: format!("{scheme}://{host}"), is_https })
    }

    /// Name and port, as a browser calls the server.
    fn host(&self) -> &str {
        self.text.split_once("://").map_or("", |(_, host)| host)
    }
}

/// The rules of one server.
#[derive(Debug, Clone)]
pub(crate) struct Guard {
    /// Beyond loopback the names by which a server is reached are many.
    pub(crate) loopback: bool,
    pub(crate) port: u16,
    pub(crate) token: Option<String>,
    /// Further origins of the page, those of proxies.
    pub(crate) origins: Vec<Origin>,
}

impl Guard {
    /// # Errors
    /// 403 for a foreign host or origin, 401 without the token.
    pub(crate) fn check(&self, method: &Method, headers: &HeaderMap) -> Result<(), Refusal> {
        let host = text(headers, header::HOST).unwrap_or("");
        let is_stated = self.origins.iter().any(|o| o.host().eq_ignore_ascii_case(host));
        if self.loopback && !is_stated && !self.is_own(host) {
            let message = "this server is called by another name";
            return Err(Refusal::new(
                403,
                "foreign-host",
                message,
                "use the address that was printed; for a proxy start with --origin https://its-name",
            ));
        }
        if let Some(origin) = text(headers, header::ORIGIN)
            && origin.strip_prefix("http://") != Some(host)
            && !self.origins.iter().any(|o| o.text == origin)
        {
            let message = "another page asks";
            let hint = "open the page from here; for a proxy start with --origin https://its-name";
            return Err(Refusal::new(403, "foreign-origin", message, hint));
        }
        if method == Method::POST && !is_json(headers) {
            let hint = "Content-Type: application/json";
            return Err(Refusal::new(415, "not-json", "the body is not sent as JSON", hint));
        }
        match &self.token {
            Some(token) if !self.given(headers).is_some_and(|g| same(g, token)) => {
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

    /// The name of the cookie: cookies do not know ports, and a computer may have several servers.
    fn cookie_name(&self) -> String {
        format!("trueaxis_token_{}", self.port)
    }

    /// `/?token=…`: the cookie to set, if the token is right. From a page by https it is sent by https only.
    pub(crate) fn cookie(&self, uri: &Uri, headers: &HeaderMap) -> Option<HeaderValue> {
        let given = uri.query()?.split('&').find_map(|part| part.strip_prefix("token="))?;
        let token = self.token.as_deref().filter(|token| same(given, token))?;
        let host = text(headers, header::HOST).unwrap_or("");
        let by_https = self.origins.iter().any(|o| o.is_https && o.host() == host);
        let secure = if by_https { "; Secure" } else { "" };
        let name = self.cookie_name();
        let cookie = format!("{name}={token}; Path=/; HttpOnly; SameSite=Strict{secure}");
        HeaderValue::from_str(&cookie).ok()
    }

    /// The token of a request.
    fn given<'h>(&self, headers: &'h HeaderMap) -> Option<&'h str> {
        let name = self.cookie_name();
        let bearer = text(headers, header::AUTHORIZATION).and_then(|a| a.strip_prefix("Bearer "));
        let cookies = text(headers, header::COOKIE).unwrap_or("").split(';');
        let mut pairs = cookies.filter_map(|part| part.trim().split_once('='));
        bearer.or_else(|| pairs.find(|(n, _)| *n == name).map(|(_, value)| value))
    }
}

fn text(headers: &HeaderMap, name: header::HeaderName) -> Option<&str> {
    headers.get(name).and_then(|value| value.to_str().ok())
}

fn is_json(headers: &HeaderMap) -> bool {
    // RFC 9110, 8.3.1: in any case of letters.
    text(headers, header::CONTENT_TYPE).is_some_and(|kind| {
        kind.split(';').next().unwrap_or("").trim().eq_ignore_ascii_case("application/json")
    })
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

    fn guard(loopback: bool, token: Option<&str>, origins: &[&str]) -> Guard {
        let origins = origins.iter().map(|o| Origin::parse(o).unwrap()).collect();
        Guard { loopback, port: 7841, token: token.map(str::to_owned), origins }
    }

    #[test]
    fn only_the_own_page_asks() {
        let guard = guard(true, None, &[]);
        let own = ("host", "127.0.0.1:7841");
        assert_eq!(status(&guard, Method::GET, &[own]), 200);
        assert_eq!(status(&guard, Method::GET, &[("host", "localhost:7841")]), 200);
        assert_eq!(status(&guard, Method::GET, &[("host", "[::1]:7841")]), 200);
        for foreign in ["evil.example:7841", "127.0.0.1:80", "", "127.0.0.1.evil.example:7841"] {
            assert_eq!(status(&guard, Method::GET, &[("host", foreign)]), 403, "{foreign}");
        }
        let asks = |origin| status(&guard, Method::GET, &[own, ("origin", origin)]);
        assert_eq!(asks("http://127.0.0.1:7841"), 200);
        assert_eq!(asks("https://127.0.0.1:7841"), 403);
        assert_eq!(asks("http://localhost:7841"), 403);
        assert_eq!(asks("null"), 403);
        assert_eq!(status(&guard, Method::POST, &[own, ("content-type", "text/plain")]), 415);
    }

    #[test]
    fn everyone_needs_the_token() {
        for loopback in [true, false] {
            let guard = guard(loopback, Some("a1b2"), &[]);
            let host = ("host", if loopback { "localhost:7841" } else { "shop:7841" });
            let asks = |more: &[_]| status(&guard, Method::GET, &[&[host], more].concat());
            assert_eq!(asks(&[]), 401);
            assert_eq!(asks(&[("authorization", "Bearer a1b2")]), 200);
            assert_eq!(asks(&[("authorization", "Bearer a1b")]), 401);
            assert_eq!(asks(&[("cookie", "x=1; trueaxis_token_7841=a1b2")]), 200);
            // That of another server on this computer.
            assert_eq!(asks(&[("cookie", "trueaxis_token_7842=a1b2")]), 401);
            let cookie = |uri: &str| guard.cookie(&uri.parse().unwrap(), &headers(&[host]));
            let set = cookie("/?token=a1b2").unwrap();
            assert!(
                set.to_str().unwrap().ends_with("Path=/; HttpOnly; SameSite=Strict"),
                "{set:?}"
            );
            assert!(cookie("/?token=a1").is_none());
        }
    }

    #[test]
    fn a_proxy_is_accepted_where_its_origin_is_stated() {
        let proxy = ("origin", "https://mill.example");
        for (loopback, host) in [(true, "mill.example"), (true, "127.0.0.1:7841"), (false, "x")] {
            let asks = |guard: &Guard, more: &[_]| {
                status(guard, Method::GET, &[&[("host", host)], more].concat())
            };
            let stated = guard(loopback, None, &["https://mill.example"]);
            assert_eq!(asks(&stated, &[proxy]), 200, "{host}");
            assert_eq!(asks(&guard(loopback, None, &[]), &[proxy]), 403, "{host}");
            for foreign in ["https://mill.example.evil", "http://mill.example:80", "null"] {
                assert_eq!(asks(&stated, &[("origin", foreign)]), 403, "{foreign}");
            }
            // What a request says of itself does not count.
            let says = [("x-forwarded-proto", "https"), ("forwarded", "proto=https;host=evil")];
            let foreign = [&[("origin", "https://evil")], &says[..]].concat();
            assert_eq!(asks(&stated, &foreign), 403);
        }
        // Its cookie is sent by https only.
        let guard = guard(true, Some("a1b2"), &["https://mill.example"]);
        let uri = "/?token=a1b2".parse().unwrap();
        let secure = |host| {
            let set = guard.cookie(&uri, &headers(&[("host", host)])).unwrap();
            set.to_str().unwrap().ends_with("; Secure")
        };
        assert!(secure("mill.example") && !secure("127.0.0.1:7841"));
    }

    #[test]
    fn origins_are_written_as_a_browser_does() {
        for (given, known) in [
            ("https://mill.example", "https://mill.example"),
            ("HTTPS://Mill.Example:443/", "https://mill.example"),
            ("http://mill:8080", "http://mill:8080"),
            ("https://[fd00::1]:8443", "https://[fd00::1]:8443"),
        ] {
            assert_eq!(Origin::parse(given).unwrap().text, known);
        }
        for bad in ["mill.example", "ftp://mill", "https://", "https://mill/page", "https://a b"] {
            assert!(Origin::parse(bad).is_err(), "{bad}");
        }
    }
}
