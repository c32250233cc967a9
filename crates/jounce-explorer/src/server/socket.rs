//! Connection of one page: its socket from opening to close.

use super::Host;
use crate::session::Session;
use crate::session::frame::Frame;
use crate::session::request::{MAX_OVERRIDES, Request};
use axum::extract::ws::{Message, WebSocket};
use futures_util::{SinkExt, StreamExt};
use std::sync::Arc;
use tokio::sync::{mpsc, watch};

/// Largest number of responses that wait for a slow page.
const MAX_QUEUED_RESPONSES: usize = 64;

/// Serves a page until it closes or the server stops; then cancels all its requests.
pub async fn serve_page(socket: WebSocket, host: Arc<Host>) {
    let (mut sink, mut stream) = socket.split();
    let (sender, mut queue) = mpsc::channel::<Vec<u8>>(MAX_QUEUED_RESPONSES);
    let writer = tokio::spawn(async move {
        while let Some(bytes) = queue.recv().await {
            if sink.send(Message::Binary(bytes.into())).await.is_err() {
                return;
            }
        }
        let _ = sink.close().await;
    });
    let (mut versions, mut stop_signal) = (host.versions.clone(), host.stop_signal.clone());
    let session = Arc::new(Session::new(Arc::clone(&host), sender));
    session.send_hello().await;
    loop {
        tokio::select! {
            message = stream.next() => match message {
                Some(Ok(Message::Text(text))) => handle_message(&session, text.as_str()).await,
                Some(Ok(Message::Ping(_) | Message::Pong(_))) => {}
                Some(Ok(Message::Binary(_) | Message::Close(_)) | Err(_)) | None => break,
            },
            change = versions.changed() => match change {
                Ok(()) => {
                    let version = *versions.borrow_and_update();
                    let mut frame = Frame::new(0, "file", "done");
                    frame.put("version", version);
                    session.send_async(frame).await;
                }
                Err(_) => break,
            },
            () = server_stopped(&mut stop_signal) => break,
        }
    }
    session.cancel_all();
    drop(session);
    // Computations that are ending still hold a sender each.
    let _ = tokio::time::timeout(std::time::Duration::from_secs(1), writer).await;
}

/// Waits until the server stops.
async fn server_stopped(stop_signal: &mut watch::Receiver<bool>) {
    let _ = stop_signal.wait_for(|stop_signal| *stop_signal).await;
}

async fn handle_message(session: &Arc<Session>, text: &str) {
    match serde_json::from_str::<Request>(text) {
        Ok(request) if request.set.len() <= MAX_OVERRIDES => session.handle_request(request),
        Ok(request) => {
            let mut frame = Frame::new(request.id, request.kind.name(), "fault");
            frame.put(
                "message",
                format!(
                    "{} overrides are too many; at most {MAX_OVERRIDES} are allowed",
                    request.set.len()
                ),
            );
            session.send_async(frame).await;
        }
        Err(error) => {
            let mut frame = Frame::new(0, "request", "fault");
            frame.put("message", format!("the request cannot be read: {error}"));
            session.send_async(frame).await;
        }
    }
}
