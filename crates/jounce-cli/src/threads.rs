//! Number of threads of a command.

use crate::failure::Failure;
use clap::Args;

/// The number of threads.
#[derive(Debug, Args)]
pub struct ThreadsArgument {
    /// Number of threads; by default one per core. The result does not depend on it.
    #[arg(long, value_parser = clap::value_parser!(u16).range(1..))]
    threads: Option<u16>,
}

impl ThreadsArgument {
    /// Runs work on that many threads.
    pub fn run<T: Send>(&self, work: impl FnOnce() -> T + Send) -> Result<T, Failure> {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(self.threads.map_or(0, usize::from));
        let pool = pool
            .build()
            .map_err(|error| Failure::Input(format!("the threads cannot be started: {error}")))?;
        Ok(pool.install(work))
    }
}
