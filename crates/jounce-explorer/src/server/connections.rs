//! Connections of the server: one that sends no complete request in time is closed.

use axum::Router;
use hyper::server::conn::http1;
use hyper_util::rt::{TokioIo, TokioTimer};
use hyper_util::service::TowerToHyperService;
use std::time::Duration;
use tokio::net::TcpListener;

/// Pause after a connection that the system could not accept, such as for lack of files.
const RETRY_INTERVAL: Duration = Duration::from_millis(100);

/// Serves all connections. Each must send the headers of its next request within a time.
pub async fn serve(listener: TcpListener, router: Router, max_header_time: Duration) {
    loop {
        let Ok((stream, _)) = listener.accept().await else {
            tokio::time::sleep(RETRY_INTERVAL).await;
            continue;
        };
        // Without this option a response waits about 40 ms for the receipt of the previous one.
        let _ = stream.set_nodelay(true);
        let service = TowerToHyperService::new(router.clone());
        let connection = http1::Builder::new()
            .timer(TokioTimer::new())
            .header_read_timeout(max_header_time)
            .serve_connection(TokioIo::new(stream), service)
            .with_upgrades();
        tokio::spawn(async move {
            // A connection that breaks concerns its page only.
            let _ = connection.await;
        });
    }
}
