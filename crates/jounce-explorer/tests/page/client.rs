//! A page without a browser: a running server, raw requests, and its socket.

use futures_util::{SinkExt, StreamExt};
use jounce_explorer::{Explorer, ServerLimits, ServerOptions, Source};
use serde_json::Value;
use std::io::{Read, Write};
use std::net::TcpStream;
use std::path::{Path, PathBuf};
use std::time::Duration;
use tokio_tungstenite::tungstenite::{Error, Message, client::IntoClientRequest};

/// The spec of the paper.
pub fn paper() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../../examples/impact-harvester-2019/harvester.toml")
}

/// A running server; it ends with its value.
pub struct Served {
    pub host: String,
    pub token: String,
    stop: Option<Box<dyn FnOnce()>>,
}

impl Served {
    /// Serves a spec with some limits.
    pub fn new(spec: &Path, limits: ServerLimits) -> Self {
        Self::kept(spec, limits, None)
    }

    /// The same, its address kept in a folder.
    pub fn kept(spec: &Path, limits: ServerLimits, keep: Option<PathBuf>) -> Self {
        Self::of(Source::File(spec.to_path_buf()), limits, keep)
    }

    /// Serves a spec, wherever it comes from.
    pub fn of(spec: Source, limits: ServerLimits, keep: Option<PathBuf>) -> Self {
        let explorer = Explorer::bind(ServerOptions {
            spec,
            set: Vec::new(),
            listen: None,
            keep,
            limits,
        })
        .unwrap();
        let page = explorer.page();
        let (host, token) = page
            .strip_prefix("http://")
            .unwrap()
            .trim_end_matches('/')
            .split_once('/')
            .unwrap();
        let (host, token) = (host.to_owned(), token.to_owned());
        let stopper = explorer.stopper();
        let thread = std::thread::spawn(move || explorer.run().unwrap());
        let stop = Box::new(move || {
            stopper.stop();
            thread.join().unwrap();
        });
        Self {
            host,
            token,
            stop: Some(stop),
        }
    }

    /// Sends bytes as they are; the first line of the answer and the rest.
    pub fn raw(&self, request: &str) -> (String, String) {
        let mut stream = TcpStream::connect(&self.host).unwrap();
        stream
            .set_read_timeout(Some(Duration::from_secs(10)))
            .unwrap();
        stream.write_all(request.as_bytes()).unwrap();
        let mut bytes = Vec::new();
        let _ = stream.read_to_end(&mut bytes);
        let text = String::from_utf8_lossy(&bytes).into_owned();
        let (first, rest) = text.split_once("\r\n").unwrap_or((&text, ""));
        (first.to_owned(), rest.to_owned())
    }

    /// Asks for a path; the status and the rest of the answer.
    pub fn get(&self, path: &str, headers: &str) -> (u16, String) {
        let host = if headers.to_lowercase().contains("host:") {
            String::new()
        } else {
            format!("Host: {}\r\n", self.host)
        };
        let (first, rest) = self.raw(&format!(
            "GET {path} HTTP/1.1\r\n{host}{headers}Connection: close\r\n\r\n"
        ));
        (
            first
                .split(' ')
                .nth(1)
                .and_then(|code| code.parse().ok())
                .unwrap_or(0),
            rest,
        )
    }

    /// Opens the socket with an origin.
    pub async fn open(&self, token: &str, origin: Option<&str>) -> Result<Page, u16> {
        let mut request = format!("ws://{}/{token}/socket", self.host)
            .into_client_request()
            .unwrap();
        origin.iter().for_each(|origin| {
            drop(
                request
                    .headers_mut()
                    .insert("Origin", origin.parse().unwrap()),
            )
        });
        match tokio_tungstenite::connect_async(request).await {
            Ok((socket, _)) => Ok(Page { socket, next: 0 }),
            Err(Error::Http(answer)) => Err(answer.status().as_u16()),
            Err(error) => panic!("{error}"),
        }
    }

    /// Opens the socket as the page does.
    pub async fn page(&self) -> Page {
        let mut page = self
            .open(&self.token, Some(&format!("http://{}", self.host)))
            .await
            .unwrap();
        assert_eq!(page.hear().await.unwrap().head["ask"], "hello");
        page
    }
}

impl Drop for Served {
    fn drop(&mut self) {
        self.stop.take().map(|stop| stop()).unwrap_or_default();
    }
}

/// One open page.
pub struct Page {
    pub socket: tokio_tungstenite::WebSocketStream<
        tokio_tungstenite::MaybeTlsStream<tokio::net::TcpStream>,
    >,
    next: u64,
}

/// One answer.
#[derive(Debug)]
pub struct Heard {
    pub head: Value,
    numbers: Vec<f64>,
}

impl Heard {
    /// An array of the answer.
    pub fn array(&self, name: &str) -> &[f64] {
        let places = self.head["arrays"].as_array().unwrap();
        let place = places
            .iter()
            .find(|place| place[0] == name)
            .unwrap_or_else(|| panic!("no array {name}"));
        let (first, count) = (
            place[1].as_u64().unwrap() as usize,
            place[2].as_u64().unwrap() as usize,
        );
        &self.numbers[first..first + count]
    }
}

impl Page {
    /// Asks; the number of the request.
    pub async fn ask(&mut self, ask: &str, mut body: Value) -> u64 {
        self.next += 1;
        body["id"] = self.next.into();
        body["ask"] = ask.into();
        self.socket
            .send(Message::Text(body.to_string().into()))
            .await
            .unwrap();
        self.next
    }

    /// The next answer; nothing when the socket has been closed.
    pub async fn hear(&mut self) -> Option<Heard> {
        let wait = Duration::from_secs(300);
        loop {
            match tokio::time::timeout(wait, self.socket.next())
                .await
                .expect("an answer within five minutes")?
            {
                Ok(Message::Binary(bytes)) => {
                    let length = u32::from_le_bytes(bytes[..4].try_into().unwrap()) as usize;
                    let head = serde_json::from_slice(&bytes[4..4 + length]).unwrap();
                    let numbers = bytes[4 + length..]
                        .chunks_exact(8)
                        .map(|eight| f64::from_le_bytes(eight.try_into().unwrap()))
                        .collect();
                    return Some(Heard { head, numbers });
                }
                Ok(Message::Close(_)) | Err(_) => return None,
                Ok(_) => {}
            }
        }
    }

    /// The next answer of a kind and a stage.
    pub async fn until(&mut self, ask: &str, stage: &str) -> Heard {
        loop {
            let heard = self.hear().await.expect("the socket is open");
            if heard.head["ask"] == ask && heard.head["stage"] == stage {
                return heard;
            }
            assert!(
                heard.head["stage"] != "fault" || stage == "fault",
                "{}",
                heard.head
            );
        }
    }
}
