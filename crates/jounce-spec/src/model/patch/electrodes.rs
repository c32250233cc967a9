//! `electrodes` of a patch

/// Connection of the electrodes of a patch.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Electrodes {
    /// `"circuit"`: connected to the one circuit that names the patch.
    #[default]
    Circuit,
    /// `"open"`: open circuit; the patch loses charge only through its leakage resistance.
    Open,
}
