//! Computation on a thread of its own, under permits and a time limit.

use super::cancellation::Cancellation;
use super::fault::RequestFault;
use std::sync::Arc;
use std::time::Duration;
use tokio::sync::Semaphore;

/// Share of the processors that a computation has.
#[derive(Debug, Clone)]
pub struct Share {
    /// Permits for which it waits.
    pub permits: Arc<Semaphore>,
    /// Its longest time.
    pub max_time: Duration,
}

impl Share {
    /// Computes on a thread of its own once a permit is free; `None` where the computation is
    /// cancelled before.
    pub async fn compute<T: Send + 'static>(
        self,
        cancellation: &Cancellation,
        work: impl FnOnce(&Cancellation) -> Result<T, RequestFault> + Send + 'static,
    ) -> Option<Result<T, RequestFault>> {
        let _permit = self.permits.acquire_owned().await.ok()?;
        if cancellation.is_stopped() {
            return None;
        }
        let (timed, working) = (cancellation.clone(), cancellation.clone());
        let timer = tokio::spawn(async move {
            tokio::time::sleep(self.max_time).await;
            timed.stop_on_timeout();
        });
        let outcome = tokio::task::spawn_blocking(move || work(&working)).await;
        timer.abort();
        Some(if cancellation.is_timed_out() {
            Err(RequestFault::Text(format!(
                "this took longer than {} s and was stopped; request less",
                self.max_time.as_secs()
            )))
        } else {
            let failed =
                "the computation failed unexpectedly; please report the spec that caused it";
            outcome.unwrap_or_else(|_| Err(RequestFault::Text(failed.to_owned())))
        })
    }
}
