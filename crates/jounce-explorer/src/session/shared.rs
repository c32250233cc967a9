//! Computations that several pages share.
//!
//! Pages that request the same wait for one computation. It continues as long as one of them waits
//! or shows its result, and then stops.

use super::blocking::Share;
use super::cancellation::Cancellation;
use super::fault::RequestFault;
use crate::handlers::progress::PROGRESS_INTERVAL;
use jounce::Control;
use std::sync::{Arc, Mutex, PoisonError, Weak};
use tokio::sync::watch;

/// Result of a computation; `None` until it ends.
type Outcome<T> = Option<Result<Arc<T>, RequestFault>>;

/// Computations in use, by what they depend on.
#[derive(Debug)]
pub struct SharedComputations<K, T>(Mutex<Vec<(K, Weak<Computation<T>>)>>);

impl<K, T> Default for SharedComputations<K, T> {
    fn default() -> Self {
        Self(Mutex::default())
    }
}

/// Computation with its result. It is cancelled when nothing refers to it any more.
#[derive(Debug)]
pub struct Computation<T> {
    cancellation: Cancellation,
    outcome: watch::Receiver<Outcome<T>>,
}

impl<T> Drop for Computation<T> {
    fn drop(&mut self) {
        self.cancellation.stop();
    }
}

impl<K: PartialEq, T: Send + Sync + 'static> SharedComputations<K, T> {
    /// Returns the computation of a key; starts it unless it is in use. One that has failed is
    /// started again.
    pub fn find_or_start(
        &self,
        key: K,
        share: Share,
        work: impl FnOnce(&Control) -> Result<T, RequestFault> + Send + 'static,
    ) -> Arc<Computation<T>> {
        let mut computations = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        computations.retain(|(_, computation)| computation.strong_count() > 0);
        let mut same = computations.iter().filter(|(other, _)| *other == key);
        let found = same.find_map(|(_, computation)| {
            let computation = computation.upgrade()?;
            let is_usable = !matches!(*computation.outcome.borrow(), Some(Err(_)));
            is_usable.then_some(computation)
        });
        found.unwrap_or_else(|| {
            let started = Arc::new(Computation::start(share, work));
            computations.push((key, Arc::downgrade(&started)));
            started
        })
    }
}

impl<T: Send + Sync + 'static> Computation<T> {
    fn start(
        share: Share,
        work: impl FnOnce(&Control) -> Result<T, RequestFault> + Send + 'static,
    ) -> Self {
        let (sender, outcome) = watch::channel(None);
        let cancellation = Cancellation::default();
        let working = cancellation.clone();
        tokio::spawn(async move {
            let compute = |own: &Cancellation| work(own.control());
            let computed = share.compute(&working, compute).await;
            sender.send_replace(computed.map(|result| result.map(Arc::new)));
        });
        Self {
            cancellation,
            outcome,
        }
    }

    /// Waits for the result, and reports the progress at regular times; `None` where the request
    /// is cancelled first.
    pub async fn result(
        &self,
        request: &Cancellation,
        mut report: impl FnMut(&Control),
    ) -> Option<Result<Arc<T>, RequestFault>> {
        let mut outcome = self.outcome.clone();
        loop {
            tokio::select! {
                biased;
                () = request.stopped() => return None,
                finished = outcome.wait_for(Option::is_some) => {
                    return finished.ok().and_then(|outcome| outcome.clone());
                }
                () = tokio::time::sleep(PROGRESS_INTERVAL) => report(self.cancellation.control()),
            }
        }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;
    use std::sync::atomic::{AtomicUsize, Ordering};
    use std::time::Duration;
    use tokio::sync::Semaphore;

    fn share() -> Share {
        Share {
            permits: Arc::new(Semaphore::new(2)),
            max_time: Duration::from_secs(60),
        }
    }

    /// Work that ends when it is released or stopped, and counts its runs.
    fn work(
        runs: &Arc<AtomicUsize>,
        release: &Arc<Semaphore>,
    ) -> impl FnOnce(&Control) -> Result<usize, RequestFault> + Send + 'static {
        let (runs, release) = (Arc::clone(runs), Arc::clone(release));
        move |control| {
            let run = runs.fetch_add(1, Ordering::SeqCst);
            while release.available_permits() == 0 && !control.is_stopped() {
                std::thread::sleep(Duration::from_millis(1));
            }
            Ok(run)
        }
    }

    #[tokio::test]
    async fn two_requests_share_one_computation_and_one_that_leaves_does_not_stop_it() {
        let computations = SharedComputations::default();
        let (runs, release) = (Arc::default(), Arc::new(Semaphore::new(0)));
        let [one, two, other] = ["a", "a", "b"]
            .map(|key| computations.find_or_start(key, share(), work(&runs, &release)));
        let (leaving, waiting) = (Cancellation::default(), Cancellation::default());
        leaving.stop();
        assert!(one.result(&leaving, |_| ()).await.is_none());
        drop(one);
        release.add_permits(1);
        let result = two.result(&waiting, |_| ()).await.unwrap().unwrap();
        other.result(&waiting, |_| ()).await.unwrap().unwrap();
        assert_eq!(runs.load(Ordering::SeqCst), 2);
        // A third one has the result as long as a page holds it.
        let third = computations.find_or_start("a", share(), work(&runs, &release));
        let found = third.result(&waiting, |_| ()).await.unwrap().unwrap();
        assert!(Arc::ptr_eq(&result, &found));
        drop((two, third, other));
        let again = computations.find_or_start("a", share(), work(&runs, &release));
        again.result(&waiting, |_| ()).await.unwrap().unwrap();
        assert_eq!(runs.load(Ordering::SeqCst), 3);
    }

    #[tokio::test]
    async fn a_computation_for_which_nobody_waits_stops() {
        let computations = SharedComputations::<&str, ()>::default();
        let (sender, stopped) = std::sync::mpsc::channel();
        let computation = computations.find_or_start("a", share(), move |control| {
            while !control.is_stopped() {
                std::thread::sleep(Duration::from_millis(1));
            }
            sender.send(()).unwrap();
            Ok(())
        });
        drop(computation);
        let _ = tokio::task::spawn_blocking(move || stopped.recv_timeout(Duration::from_secs(60)))
            .await
            .unwrap();
    }

    #[tokio::test]
    async fn a_computation_that_has_failed_is_started_again() {
        let computations = SharedComputations::<&str, usize>::default();
        let request = Cancellation::default();
        let failed = computations.find_or_start("a", share(), |_| {
            Err(RequestFault::Text("no orbit".to_owned()))
        });
        assert!(failed.result(&request, |_| ()).await.unwrap().is_err());
        let again = computations.find_or_start("a", share(), |_| Ok(1));
        assert_eq!(*again.result(&request, |_| ()).await.unwrap().unwrap(), 1);
    }
}
