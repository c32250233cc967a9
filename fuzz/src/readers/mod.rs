//! Readers by name. Each takes the bytes of one input.

#[cfg(feature = "library")]
mod library;
mod matrices;
#[cfg(feature = "library")]
mod page;
pub mod quantities;
mod recordings;
mod specs;
mod tables;

/// Name and function of a reader.
pub type Reader = (&'static str, fn(&[u8]));

/// Readers of short texts.
pub const QUICK: &[Reader] = &[
    ("quantity", quantities::quantity),
    ("range", quantities::range),
    ("market", matrices::market),
    #[cfg(feature = "library")]
    ("link", page::link),
    #[cfg(feature = "library")]
    ("names", library::names),
    #[cfg(feature = "library")]
    ("shard", library::shard),
];

/// All other readers.
pub const OTHER: &[Reader] = &[
    ("spec", specs::spec),
    ("override", specs::overrides),
    ("sweep-range", specs::sweep_range),
    ("force-table", specs::force_table),
    ("notes", recordings::notes),
    ("text", recordings::text),
    ("uff", recordings::uff),
    ("wav", recordings::wav),
    ("mat", recordings::mat),
    ("npy", recordings::npy),
    ("npz", recordings::npz),
    ("hdf5", recordings::hdf5),
    ("parquet", recordings::parquet),
    ("tdms", recordings::tdms),
    ("lvm", recordings::lvm),
    ("table-csv", tables::csv),
    ("table-html", tables::html),
    ("table-json", tables::json),
    ("table-parquet", tables::parquet),
    #[cfg(feature = "library")]
    ("study", library::study),
    #[cfg(feature = "library")]
    ("design", library::design),
    #[cfg(feature = "library")]
    ("features", library::features),
    #[cfg(feature = "library")]
    ("start-state", library::start_state),
    #[cfg(feature = "library")]
    ("journal", library::journal),
    #[cfg(feature = "library")]
    ("import", library::import),
    #[cfg(feature = "library")]
    ("request", page::request),
];

/// Returns the text of an input; bytes that are not UTF-8 become U+FFFD.
pub fn text_of(data: &[u8]) -> String {
    String::from_utf8_lossy(data).into_owned()
}

/// Splits off the first byte, which selects one of several cases.
pub fn choice(data: &[u8], cases: usize) -> Option<(usize, &[u8])> {
    let (first, rest) = data.split_first()?;
    Some((usize::from(first.wrapping_sub(b'0')) % cases, rest))
}
