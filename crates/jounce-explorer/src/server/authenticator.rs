//! Authentication of requests by token, host and origin.

use super::ProxyOrigin;
use axum::http::HeaderMap;
use axum::http::header::{HOST, ORIGIN};
use sha2::{Digest, Sha256};
use std::fmt::Write as _;
use std::net::SocketAddr;

/// Random bytes of a token.
const TOKEN_BYTES: usize = 16;

/// Authentication data of one server.
#[derive(Debug, Clone)]
pub struct Authenticator {
    token: String,
    digest: [u8; 32],
    hosts: Vec<String>,
    proxy: Option<ProxyOrigin>,
    /// True where the server listens on all addresses of this machine, so that any of them is
    /// accepted.
    any_address: bool,
    port: u16,
}

/// Reason of a refusal.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RequestRefusal {
    /// Wrong token.
    Token,
    /// The host is not this server, as in an attack by DNS rebinding.
    Host,
    /// The origin is the page of another server.
    Origin,
}

impl Authenticator {
    /// Creates the authenticator of a server at an address, and behind a proxy, with the token of
    /// the previous server or a new one.
    ///
    /// # Errors
    /// The system provides no random numbers.
    pub fn new(
        address: SocketAddr,
        proxy: Option<ProxyOrigin>,
        previous_token: Option<String>,
    ) -> Result<Self, getrandom::Error> {
        let token = previous_token.map_or_else(random_token, Ok)?;
        let port = address.port();
        let mut hosts = vec![address.to_string()];
        if address.ip().is_loopback() || address.ip().is_unspecified() {
            hosts.extend(["127.0.0.1", "localhost", "[::1]"].map(|name| format!("{name}:{port}")));
        }
        Ok(Self {
            digest: Sha256::digest(token.as_bytes()).into(),
            token,
            hosts,
            proxy,
            any_address: address.ip().is_unspecified(),
            port,
        })
    }

    /// Returns the token.
    pub fn token(&self) -> &str {
        &self.token
    }

    /// Checks a request; `needs_origin` holds for a socket, which every browser opens with its
    /// origin.
    ///
    /// # Errors
    /// [`RequestRefusal`].
    pub fn check(
        &self,
        token: &str,
        headers: &HeaderMap,
        needs_origin: bool,
    ) -> Result<(), RequestRefusal> {
        let mut hosts = headers.get_all(HOST).iter();
        let (Some(host), None) = (hosts.next(), hosts.next()) else {
            return Err(RequestRefusal::Host);
        };
        let host = host.to_str().unwrap_or_default();
        // An attack by rebinding needs a host name; a request by address is safe.
        let by_address = self.any_address
            && host
                .parse::<SocketAddr>()
                .is_ok_and(|address| address.port() == self.port);
        let by_proxy = self.proxy.as_ref().is_some_and(|proxy| proxy.is_host(host));
        if !by_address
            && !by_proxy
            && !self
                .hosts
                .iter()
                .any(|host_name| host_name.eq_ignore_ascii_case(host))
        {
            return Err(RequestRefusal::Host);
        }
        let origins: Vec<_> = headers.get_all(ORIGIN).iter().collect();
        let own_origin = (!by_proxy).then(|| format!("http://{host}"));
        let is_own = |origin: &[u8]| {
            let own_origin = own_origin.as_ref().map(String::as_bytes);
            own_origin.is_some_and(|own_origin| own_origin.eq_ignore_ascii_case(origin))
        };
        let is_proxy = |origin: &[u8]| {
            let proxy = self.proxy.as_ref();
            proxy.is_some_and(|proxy| proxy.is_origin(origin))
        };
        if origins
            .iter()
            .map(|origin| origin.as_bytes())
            .any(|origin| !is_own(origin) && !is_proxy(origin))
            || (needs_origin && origins.is_empty())
        {
            return Err(RequestRefusal::Origin);
        }
        // Digests are compared, so that the duration reveals nothing about the token.
        let token_matches = <[u8; 32]>::from(Sha256::digest(token.as_bytes())) == self.digest;
        if token_matches {
            Ok(())
        } else {
            Err(RequestRefusal::Token)
        }
    }
}

/// Returns a random token.
fn random_token() -> Result<String, getrandom::Error> {
    let mut bytes = [0; TOKEN_BYTES];
    getrandom::fill(&mut bytes)?;
    Ok(bytes.iter().fold(String::new(), |mut text, byte| {
        let _ = write!(text, "{byte:02x}");
        text
    }))
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;
    use axum::http::HeaderValue;

    fn request_headers(host: &str, origin: Option<&str>) -> HeaderMap {
        let mut headers = HeaderMap::new();
        headers.insert(HOST, HeaderValue::from_str(host).unwrap());
        origin.iter().for_each(|origin| {
            drop(headers.insert(ORIGIN, HeaderValue::from_str(origin).unwrap()))
        });
        headers
    }

    #[test]
    fn only_requests_of_the_page_with_the_token_are_accepted() {
        let address = "127.0.0.1:4321".parse().unwrap();
        let authenticator = Authenticator::new(address, None, None).unwrap();
        let token = authenticator.token().to_owned();
        assert_eq!(token.len(), 32);
        assert_ne!(
            token,
            Authenticator::new(address, None, None).unwrap().token()
        );
        let own = "127.0.0.1:4321";
        let [host, origin, refused_token] = [
            RequestRefusal::Host,
            RequestRefusal::Origin,
            RequestRefusal::Token,
        ]
        .map(Err);
        let cases = [
            (
                &*token,
                "localhost:4321",
                "http://localhost:4321",
                true,
                Ok(()),
            ),
            (&*token, own, "", false, Ok(())),
            (&*token, own, "", true, origin),
            (&*token, own, "http://evil.example", false, origin),
            (&*token, own, "null", true, origin),
            (
                &*token,
                "evil.example:4321",
                "http://evil.example:4321",
                true,
                host,
            ),
            (&*token, "127.0.0.1:9", "", false, host),
            (&token[1..], own, "", false, refused_token),
            ("", own, "", false, refused_token),
        ];
        for (token, host, origin, socket, expected) in cases {
            let headers = request_headers(host, Some(origin).filter(|origin| !origin.is_empty()));
            let result = authenticator.check(token, &headers, socket);
            assert_eq!(result, expected, "{token} {host} {origin} {socket}");
        }
    }

    #[test]
    fn behind_a_proxy_its_host_and_origin_are_accepted_and_no_others() {
        let address = "127.0.0.1:4321".parse().unwrap();
        let proxy = ProxyOrigin::parse("https://hub.example").unwrap();
        let authenticator = Authenticator::new(address, Some(proxy), None).unwrap();
        let [host, origin] = [RequestRefusal::Host, RequestRefusal::Origin].map(Err);
        for (request_host, request_origin, expected) in [
            ("hub.example", "https://hub.example", Ok(())),
            ("127.0.0.1:4321", "https://hub.example", Ok(())),
            ("127.0.0.1:4321", "http://127.0.0.1:4321", Ok(())),
            ("hub.example", "http://hub.example", origin),
            ("hub.example", "https://evil.example", origin),
            ("127.0.0.1:4321", "https://evil.example", origin),
            ("hub.example:4321", "https://hub.example", host),
            ("evil.example", "https://hub.example", host),
        ] {
            let headers = request_headers(request_host, Some(request_origin));
            let result = authenticator.check(authenticator.token(), &headers, true);
            assert_eq!(result, expected, "{request_host} {request_origin}");
        }
        let headers = request_headers("hub.example", Some("https://hub.example"));
        assert_eq!(
            authenticator.check("0", &headers, true),
            Err(RequestRefusal::Token)
        );
    }

    #[test]
    fn a_server_on_all_addresses_accepts_addresses_and_no_names() {
        let unspecified = Authenticator::new("0.0.0.0:4321".parse().unwrap(), None, None).unwrap();
        let check = |host: &str| {
            unspecified.check(unspecified.token(), &request_headers(host, None), false)
        };
        assert_eq!(check("192.168.1.7:4321"), Ok(()));
        assert_eq!(check("evil.example:4321"), Err(RequestRefusal::Host));
    }
}
