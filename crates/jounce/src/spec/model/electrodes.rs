//! `electrodes` of a patch

/// Where the charge of a patch goes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Electrodes {
    /// `"circuit"`: into the one circuit that names the patch.
    #[default]
    Circuit,
    /// `"open"`: nowhere; what the patch does not leak it keeps.
    Open,
}
