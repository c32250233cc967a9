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

/// The spec under noise, whose patch has a strain limit.
pub fn random_base() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/random-base/harvester.toml")
}

/// A running server; it ends with its value.
pub struct TestServer {
    pub host: String,
    pub token: String,
    stop: Option<Box<dyn FnOnce()>>,
}

impl TestServer {
    /// Serves a spec with some limits.
    pub fn new(spec: &Path, limits: ServerLimits) -> Self {
        Self::with_state_folder(spec, limits, None)
    }

    /// Serves a spec and saves its address in a folder.
    pub fn with_state_folder(
        spec: &Path,
        limits: ServerLimits,
        state_folder: Option<PathBuf>,
    ) -> Self {
        Self::from_source(Source::File(spec.to_path_buf()), limits, state_folder)
    }

    /// Serves a spec from any source.
    pub fn from_source(spec: Source, limits: ServerLimits, state_folder: Option<PathBuf>) -> Self {
        Self::with_options(ServerOptions {
            spec,
            set: Vec::new(),
            view: None,
            page: Vec::new(),
            listen: None,
            proxy: None,
            frames: false,
            state_folder,
            limits,
        })
    }

    /// Serves with any options.
    pub fn with_options(options: ServerOptions) -> Self {
        let explorer = Explorer::bind(options).unwrap();
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

    /// Sends raw bytes; returns the first line of the response and the rest.
    pub fn raw(&self, request: &str) -> (String, String) {
        let mut stream = TcpStream::connect(&self.host).unwrap();
        stream
            .set_read_timeout(Some(Duration::from_secs(10)))
            .unwrap();
        stream.write_all(request.as_bytes()).unwrap();
        let mut bytes = Vec::new();
        let _ = stream.read_to_end(&mut bytes);
        let text = String::from_utf8_lossy(&bytes).into_owned();
        let (status_line, rest) = text.split_once("\r\n").unwrap_or((&text, ""));
        (status_line.to_owned(), rest.to_owned())
    }

    /// Requests a path; returns the status and the rest of the response.
    pub fn get(&self, path: &str, headers: &str) -> (u16, String) {
        let host = if headers.to_lowercase().contains("host:") {
            String::new()
        } else {
            format!("Host: {}\r\n", self.host)
        };
        let (status_line, rest) = self.raw(&format!(
            "GET {path} HTTP/1.1\r\n{host}{headers}Connection: close\r\n\r\n"
        ));
        (
            status_line
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
            Ok((socket, _)) => Ok(Page { socket, last_id: 0 }),
            Err(Error::Http(response)) => Err(response.status().as_u16()),
            Err(error) => panic!("{error}"),
        }
    }

    /// Opens the socket as the page does.
    pub async fn page(&self) -> Page {
        let mut page = self
            .open(&self.token, Some(&format!("http://{}", self.host)))
            .await
            .unwrap();
        assert_eq!(page.receive().await.unwrap().head["ask"], "hello");
        page
    }
}

impl Drop for TestServer {
    fn drop(&mut self) {
        self.stop.take().map(|stop| stop()).unwrap_or_default();
    }
}

/// One open page.
pub struct Page {
    pub socket: tokio_tungstenite::WebSocketStream<
        tokio_tungstenite::MaybeTlsStream<tokio::net::TcpStream>,
    >,
    last_id: u64,
}

/// Decoded response.
#[derive(Debug)]
pub struct Response {
    pub head: Value,
    numbers: Vec<f64>,
}

impl Response {
    /// Returns an array of the response.
    pub fn array(&self, name: &str) -> &[f64] {
        let arrays = self.head["arrays"].as_array().unwrap();
        let array = arrays
            .iter()
            .find(|array| array[0] == name)
            .unwrap_or_else(|| panic!("no array {name}"));
        let (first, count) = (
            array[1].as_u64().unwrap() as usize,
            array[2].as_u64().unwrap() as usize,
        );
        &self.numbers[first..first + count]
    }
}

impl Page {
    /// Sends a request and returns its number.
    pub async fn send_request(&mut self, kind: &str, mut body: Value) -> u64 {
        self.last_id += 1;
        body["id"] = self.last_id.into();
        body["ask"] = kind.into();
        self.socket
            .send(Message::Text(body.to_string().into()))
            .await
            .unwrap();
        self.last_id
    }

    /// Returns the next response; `None` if the socket is closed.
    pub async fn receive(&mut self) -> Option<Response> {
        let limit = Duration::from_secs(300);
        loop {
            match tokio::time::timeout(limit, self.socket.next())
                .await
                .expect("a response within five minutes")?
            {
                Ok(Message::Binary(bytes)) => {
                    let length = u32::from_le_bytes(bytes[..4].try_into().unwrap()) as usize;
                    let head = serde_json::from_slice(&bytes[4..4 + length]).unwrap();
                    let numbers = bytes[4 + length..]
                        .chunks_exact(8)
                        .map(|chunk| f64::from_le_bytes(chunk.try_into().unwrap()))
                        .collect();
                    return Some(Response { head, numbers });
                }
                Ok(Message::Close(_)) | Err(_) => return None,
                Ok(_) => {}
            }
        }
    }

    /// Returns the next response of a kind and a stage.
    pub async fn receive_until(&mut self, kind: &str, stage: &str) -> Response {
        loop {
            let response = self.receive().await.expect("the socket is open");
            if response.head["ask"] == kind && response.head["stage"] == stage {
                return response;
            }
            assert!(
                response.head["stage"] != "fault" || stage == "fault",
                "{}",
                response.head
            );
        }
    }
}
