//! Link to a view of the page that opens on any machine: the changed keys, the axis, what the page
//! shows, the spec.
//!
//! ```text
//! jounce:?set=stop.tip.gap%3D0.9%20mm&over=drive.shaker.frequency&from=12&to=14&spec=TEXT
//! ```
//!
//! The fields are those of the fragment in the address of the page, so an address is a link too, but
//! without a spec. The page alone reads the fields of [`PAGE_FIELDS`]. `spec` is the text of the spec,
//! compressed (RFC 1951), in base64 for addresses (RFC 4648, section 5). A link holds no address and no
//! token of a server.

use base64::Engine;
use base64::engine::general_purpose::URL_SAFE_NO_PAD;
use flate2::Compression;
use flate2::read::{DeflateDecoder, DeflateEncoder};
use jounce::live::KeySpan;
use percent_encoding::{AsciiSet, NON_ALPHANUMERIC, percent_decode_str, utf8_percent_encode};
use std::fmt;
use std::io::Read;

/// Begin of a link.
const SCHEME: &str = "jounce:?";

/// Letters that are encoded: what remains is safe in addresses and in quotes of every shell.
const ENCODED: &AsciiSet = &NON_ALPHANUMERIC.remove(b'.').remove(b'-').remove(b'_');

/// Largest spec in a link, bytes.
const MAX_SPEC_BYTES: u64 = 4 << 20;

/// Fields that the page writes and reads: the open tab, the quantity of the vertical axis, the toggles,
/// the magnified part of the chart, the selected orbit and the plane of the basins. Each has a default.
pub const PAGE_FIELDS: [&str; 10] = [
    "tab",
    "show",
    "log",
    "grazings",
    "long_periods",
    "zoom",
    "orbit",
    "starts",
    "displacement",
    "velocity",
];

/// View of a page.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Link {
    /// Changed keys, as in `--set`.
    pub set: Vec<(String, String)>,
    /// Range of the axis; `None` for that of a new page.
    pub view: Option<KeySpan>,
    /// Values of the fields of `PAGE_FIELDS`; the page reports a value that it does not know.
    pub page: Vec<(String, String)>,
    /// Text of the spec; `None` in an address of a page.
    pub spec: Option<String>,
}

/// Fault of a link.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum LinkError {
    /// The text is no link.
    #[error(
        "it is no link of the page; copy it with Copy link: it begins with {SCHEME} and is one word, in quotes"
    )]
    NoLink,
    /// A field that cannot be read.
    #[error("its field `{field}` is damaged: {reason}; copy the link again, completely")]
    Field {
        /// Name of the field.
        field: String,
        /// Reason.
        reason: String,
    },
}

impl Link {
    /// Parses a link, or an address of a page with its fragment.
    ///
    /// # Errors
    /// [`LinkError`].
    pub fn parse(text: &str) -> Result<Self, LinkError> {
        let text = text.trim();
        let is_address = text.starts_with("http://") || text.starts_with("https://");
        let fields = match text.strip_prefix(SCHEME) {
            Some(fields) => Some(fields),
            None if is_address => text.split_once('#').map(|(_, fields)| fields),
            None => None,
        };
        let fields = fields.ok_or(LinkError::NoLink)?;
        let mut link = Self::default();
        let (mut over, mut ends) = (None, [None, None]);
        for field in fields.split('&').filter(|field| !field.is_empty()) {
            let (name, value) = field.split_once('=').unwrap_or((field, ""));
            let value = decoded(name, value)?;
            match name {
                "set" => link.set.push(assignment(&value)?),
                "over" => over = Some(value),
                "from" => ends[0] = Some(number(name, &value)?),
                "to" => ends[1] = Some(number(name, &value)?),
                "spec" => link.spec = Some(spec(&value)?),
                _ if PAGE_FIELDS.contains(&name) => link.page.push((name.to_owned(), value)),
                _ => return Err(fault(name, "a link has no such field")),
            }
        }
        link.view = match (over, ends) {
            (Some(over), [Some(from), Some(to)]) if from < to => Some(KeySpan { over, from, to }),
            (None, [None, None]) => None,
            _ => {
                return Err(fault(
                    "over",
                    "a range needs over, from and to, with from < to",
                ));
            }
        };
        Ok(link)
    }
}

impl fmt::Display for Link {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut fields: Vec<String> = Vec::new();
        let mut add = |name: &str, value: &str| {
            fields.push(format!("{name}={}", utf8_percent_encode(value, ENCODED)));
        };
        for (key, value) in &self.set {
            add("set", &format!("{key}={value}"));
        }
        if let Some(KeySpan { over, from, to }) = &self.view {
            add("over", over);
            add("from", &from.to_string());
            add("to", &to.to_string());
        }
        for (name, value) in &self.page {
            add(name, value);
        }
        if let Some(spec) = &self.spec {
            let mut compressed = Vec::new();
            DeflateEncoder::new(spec.as_bytes(), Compression::best())
                .read_to_end(&mut compressed)
                .map_err(|_| fmt::Error)?;
            // Its letters need no encoding.
            fields.push(format!("spec={}", URL_SAFE_NO_PAD.encode(compressed)));
        }
        write!(f, "{SCHEME}{}", fields.join("&"))
    }
}

fn fault(field: &str, reason: impl fmt::Display) -> LinkError {
    LinkError::Field {
        field: field.to_owned(),
        reason: reason.to_string(),
    }
}

/// Decodes the value of a field; browsers write a space as `+`.
fn decoded(name: &str, value: &str) -> Result<String, LinkError> {
    let value = value.replace('+', " ");
    let text = percent_decode_str(&value).decode_utf8();
    text.map(std::borrow::Cow::into_owned)
        .map_err(|error| fault(name, error))
}

fn assignment(text: &str) -> Result<(String, String), LinkError> {
    match text.split_once('=') {
        Some((key, value)) if !key.is_empty() => Ok((key.to_owned(), value.to_owned())),
        _ => Err(fault("set", format!("\"{text}\" is not KEY=VALUE"))),
    }
}

fn number(name: &str, text: &str) -> Result<f64, LinkError> {
    let value = text.parse::<f64>().ok().filter(|value| value.is_finite());
    value.ok_or_else(|| fault(name, format!("\"{text}\" is not a number")))
}

fn spec(text: &str) -> Result<String, LinkError> {
    let incomplete = || fault("spec", "its text is incomplete or changed");
    let compressed = URL_SAFE_NO_PAD.decode(text).map_err(|_| incomplete())?;
    let mut bytes = Vec::new();
    DeflateDecoder::new(&*compressed)
        .take(MAX_SPEC_BYTES + 1)
        .read_to_end(&mut bytes)
        .map_err(|_| incomplete())?;
    if bytes.len() as u64 > MAX_SPEC_BYTES {
        return Err(fault("spec", "it is larger than 4 MiB"));
    }
    String::from_utf8(bytes).map_err(|_| incomplete())
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    fn link() -> Link {
        Link {
            set: vec![
                ("stop.tip.gap".to_owned(), "0.9 mm".to_owned()),
                ("mode.1+2.name".to_owned(), "a&b='c' µ%".to_owned()),
            ],
            view: Some(KeySpan {
                over: "drive.shaker.frequency".to_owned(),
                from: 0.1 + 0.2,
                to: 1e300,
            }),
            page: vec![
                ("tab".to_owned(), "basins".to_owned()),
                ("orbit".to_owned(), "12.5:1:4e-3:-0.1:20:fold".to_owned()),
            ],
            spec: Some("# Balken µm\n[mass.a]\nmass = \"1 kg\"\n".repeat(50)),
        }
    }

    #[test]
    fn a_link_reads_back_to_the_same_design() {
        let text = link().to_string();
        assert_eq!(Link::parse(&text).unwrap(), link());
        assert_eq!(Link::parse(&format!(" {text}\n")).unwrap(), link());
        // One word in quotes for every shell.
        assert!(text.starts_with(SCHEME) && !text.contains(['\'', '"', ' ', '$', '\\']));
        assert!(text.len() < 700, "{}", text.len());
        let nothing = Link::default();
        assert_eq!(Link::parse(&nothing.to_string()).unwrap(), nothing);
    }

    #[test]
    fn an_address_of_the_page_is_a_link_without_a_spec() {
        // As `URLSearchParams` of the browser writes it.
        let address = "http://127.0.0.1:4321/0123abcd/#set=stop.tip.gap%3D0.9+mm&over=drive.shaker.frequency&from=12&to=14.5";
        let read = Link::parse(address).unwrap();
        assert_eq!(read.set, [("stop.tip.gap".to_owned(), "0.9 mm".to_owned())]);
        let view = read.view.unwrap();
        assert_eq!((view.from, view.to), (12.0, 14.5));
        assert_eq!(read.spec, None);
        let read = Link::parse(&format!("{address}&tab=load&zoom=1%3A2%3A3%3A4")).unwrap();
        let expected = [("tab", "load"), ("zoom", "1:2:3:4")];
        assert_eq!(
            read.page,
            expected.map(|(name, value)| (name.to_owned(), value.to_owned()))
        );
    }

    #[test]
    fn damaged_links_are_refused_with_the_field() {
        let text = link().to_string();
        for other in ["", "harvester.toml", "http://127.0.0.1:1/0/", "jounce"] {
            assert_eq!(Link::parse(other), Err(LinkError::NoLink), "{other}");
        }
        for (other, field) in [
            ("jounce:?set=gap", "set"),
            ("jounce:?set=%FF%3D1", "set"),
            ("jounce:?over=a&from=1", "over"),
            ("jounce:?over=a&from=2&to=1", "over"),
            ("jounce:?over=a&from=x&to=1", "from"),
            ("jounce:?over=a&from=1&to=inf", "to"),
            ("jounce:?sets=a%3D1", "sets"),
            ("jounce:?spec=%21", "spec"),
            (&text[..text.len() - 7], "spec"),
        ] {
            let Err(LinkError::Field { field: found, .. }) = Link::parse(other) else {
                panic!("{other}");
            };
            assert_eq!(found, field, "{other}");
        }
    }

    #[test]
    fn a_spec_that_grows_without_end_is_refused() {
        let mut compressed = Vec::new();
        DeflateEncoder::new(std::io::repeat(0x20).take(1 << 26), Compression::best())
            .read_to_end(&mut compressed)
            .unwrap();
        let text = format!("jounce:?spec={}", URL_SAFE_NO_PAD.encode(compressed));
        assert!(
            Link::parse(&text)
                .unwrap_err()
                .to_string()
                .contains("4 MiB")
        );
    }
}
