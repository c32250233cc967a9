//! Files that appear whole or not at all, and tables.
//!
//! [`store`] writes a temporary file in the same folder and renames it when it is complete. [`table`] holds
//! named columns with units and writes them as CSV, Parquet and JSON.

pub mod parquet_check;
pub mod store;
pub mod table;
