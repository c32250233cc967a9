//! Memory allocator of a program that links this crate: `use jounce_allocator as _;`.
//!
//! Branches allocate and free many small matrices; with the allocator of the system they took a third
//! more time. The calls of an allocator are compiled with the crate that selects it, so this crate has
//! level 3, while the program itself has level 0.

use mimalloc::MiMalloc;

#[global_allocator]
static ALLOCATOR: MiMalloc = MiMalloc;
