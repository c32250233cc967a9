//! `[mass.NAME]`

/// Word for a missing support.
pub const NO_SUPPORT: &str = "nothing";

/// A rigid mass. On a spring it moves along the drive direction and may carry beams; without a
/// spring it is fixed to its support.
#[derive(Debug, Clone, PartialEq)]
pub struct Mass {
    /// `on`: `"ground"` (default), another base, a mass, a point of a beam, or `"nothing"` for a
    /// free mass.
    pub on: String,
    /// `mass`
    pub mass_kg: f64,
    /// `rotary_inertia` about the point of attachment, kg m^2; default 0. For a mass without a
    /// spring on a beam.
    pub rotary_inertia_kg_m2: f64,
    /// `frequency` (of the mass alone on its spring) or `stiffness`, at most one of them; stored as
    /// stiffness, N/m. `None`: no spring.
    pub stiffness_n_m: Option<f64>,
    /// `damping_ratio` of the coupled mode in which this mass moves most; with a spring only.
    pub damping_ratio: Option<f64>,
    /// `velocity` at the start of a run, m/s, added to that of `run.start`; `None` if omitted.
    pub velocity_m_s: Option<f64>,
    /// `friction`: viscous friction of a free mass on its channel, which moves with the ground, N
    /// s/m; `None` if omitted.
    pub friction_n_s_m: Option<f64>,
}
