//! The addresses by which the page is reached: those that can be typed, not that of the listener.

use crate::guard::Origin;
use std::net::{IpAddr, Ipv4Addr, Ipv6Addr, SocketAddr, UdpSocket};

/// One address of the page.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Link {
    /// The whole address, with the token if one is needed.
    pub url: String,
    /// From where it can be used, such as "on this computer".
    pub from: String,
}

/// All of them; the first is the one to open.
pub(crate) fn links(own: SocketAddr, token: Option<&str>, origins: &[Origin]) -> Vec<Link> {
    let with_token = |origin: &str| match token {
        Some(token) => format!("{origin}/?token={token}"),
        None => format!("{origin}/"),
    };
    let at = |ip: IpAddr| with_token(&format!("http://{}", SocketAddr::new(ip, own.port())));
    let link = |url: String, from: &str| Link { url, from: from.to_owned() };
    let mut links = match own.ip() {
        ip if ip.is_loopback() => vec![link(at(ip), "on this computer")],
        ip if ip.is_unspecified() => {
            let this: IpAddr = match ip {
                IpAddr::V4(_) => Ipv4Addr::LOCALHOST.into(),
                IpAddr::V6(_) => Ipv6Addr::LOCALHOST.into(),
            };
            let here = link(at(this), "on this computer");
            match outward(ip) {
                Some(ip) => vec![link(at(ip), "in the network"), here],
                None => {
                    let named = format!("http://NAME-OF-THIS-COMPUTER:{}", own.port());
                    let from = "in the network, with its name or address put in";
                    vec![here, link(with_token(&named), from)]
                }
            }
        }
        ip => vec![link(at(ip), "in the network")],
    };
    links.extend(origins.iter().map(|o| link(with_token(&o.text), "through the proxy")));
    links
}

/// The address by which this computer reaches others, and is reached. To connect a datagram socket sends nothing: it
/// only looks up the way; the other end is an address that is reserved for documents (RFC 5737, RFC 3849).
fn outward(unspecified: IpAddr) -> Option<IpAddr> {
    let v4 = (IpAddr::V4(Ipv4Addr::UNSPECIFIED), IpAddr::V4(Ipv4Addr::new(192, 0, 2, 1)));
    let v6 = (
        IpAddr::V6(Ipv6Addr::UNSPECIFIED),
        IpAddr::V6(Ipv6Addr::new(0x2001, 0xdb8, 0, 0, 0, 0, 0, 1)),
    );
    // A listener on `::` takes both.
    let ways = if unspecified.is_ipv4() { vec![v4] } else { vec![v6, v4] };
    let found = |(from, to): (IpAddr, IpAddr)| {
        let socket = UdpSocket::bind((from, 0)).ok()?;
        socket.connect((to, 9)).ok()?;
        let ip = socket.local_addr().ok()?.ip();
        (!ip.is_unspecified() && !ip.is_loopback()).then_some(ip)
    };
    ways.into_iter().find_map(found)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn urls(own: &str, token: Option<&str>, origins: &[&str]) -> Vec<String> {
        let origins: Vec<Origin> = origins.iter().map(|o| Origin::parse(o).unwrap()).collect();
        links(own.parse().unwrap(), token, &origins).into_iter().map(|link| link.url).collect()
    }

    #[test]
    fn every_address_can_be_typed() {
        assert_eq!(urls("127.0.0.1:7841", None, &[]), ["http://127.0.0.1:7841/"]);
        assert_eq!(
            urls("[::1]:7841", Some("a1"), &["https://mill.example"]),
            ["http://[::1]:7841/?token=a1", "https://mill.example/?token=a1"]
        );
        assert_eq!(urls("192.0.2.7:80", Some("a1"), &[]), ["http://192.0.2.7:80/?token=a1"]);
        for (all, this) in [("0.0.0.0:7841", "127.0.0.1"), ("[::]:7841", "[::1]")] {
            let urls = urls(all, Some("a1"), &[]);
            assert!(urls.contains(&format!("http://{this}:7841/?token=a1")), "{urls:?}");
            assert_eq!(urls.len(), 2);
            assert!(
                !urls.iter().any(|u| u.contains("//0.0.0.0") || u.contains("//[::]")),
                "{urls:?}"
            );
        }
    }
}
