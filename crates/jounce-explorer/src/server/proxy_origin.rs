//! Proxies in front of the server.

/// Origin of a proxy through which browsers reach the server, `https://hub.example.org`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ProxyOrigin {
    origin: String,
    host: String,
}

impl ProxyOrigin {
    /// Reads an origin as browsers write it: scheme, host and, unless it is the default, port.
    /// Returns `None` for any other text.
    pub fn parse(origin: &str) -> Option<Self> {
        let (scheme, host) = origin.split_once("://")?;
        let is_host = |byte: u8| byte.is_ascii_alphanumeric() || b"-._:[]".contains(&byte);
        let is_origin =
            ["http", "https"].contains(&scheme) && !host.is_empty() && host.bytes().all(is_host);
        is_origin.then(|| Self {
            origin: origin.to_owned(),
            host: host.to_owned(),
        })
    }

    /// True where a request names the proxy as its host.
    pub fn is_host(&self, host: &str) -> bool {
        self.host.eq_ignore_ascii_case(host)
    }

    /// True for a page of the proxy.
    pub fn is_origin(&self, origin: &[u8]) -> bool {
        self.origin.as_bytes().eq_ignore_ascii_case(origin)
    }
}

#[cfg(test)]
mod tests {
    use super::ProxyOrigin;

    #[test]
    fn origins_have_a_scheme_and_a_host_and_nothing_else() {
        for valid in [
            "https://hub.example.org",
            "http://localhost:8888",
            "http://[::1]:8888",
        ] {
            assert!(ProxyOrigin::parse(valid).is_some(), "{valid}");
        }
        for invalid in [
            "",
            "hub.example.org",
            "ftp://hub",
            "https://",
            "https://hub/",
            "https://user@hub",
            "https://hub *",
            "*",
        ] {
            assert_eq!(ProxyOrigin::parse(invalid), None, "{invalid}");
        }
    }
}
