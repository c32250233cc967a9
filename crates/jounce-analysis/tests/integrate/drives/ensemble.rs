//! Random responses: an ensemble without contact against the closed form, and identical bits for
//! any number of threads.

use jounce_analysis::{AnalysisError, Ensemble, EnsembleResult, IntervalOver, Model};
use jounce_model::linear::Random;
use jounce_spec::Spec;
use std::f64::consts::{PI, TAU};
use std::path::Path;

/// Mass, stiffness, dashpot, coupling, capacitance and load of S. Adhikari, M. Friswell, D. Inman,
/// Smart Mater. Struct. 18 (2009) 115005.
const MASS_KG: f64 = 9.12e-3;
const STIFFNESS_N_M: f64 = 4.1e3;
const DASHPOT_N_S_M: f64 = 0.218;
const COUPLING_N_V: f64 = 4.57e-3;
const CAPACITANCE_F: f64 = 4.3e-8;
const LOAD_OHM: f64 = 3e4;

fn spec(more: &str) -> Model {
    let w = (STIFFNESS_N_M / MASS_KG).sqrt();
    let zeta = DASHPOT_N_S_M / (2.0 * MASS_KG * w);
    let root = MASS_KG.sqrt();
    let text = format!(
        "[modal.cell]\nfrequency_hz = [{}]\ndamping_ratio = [{zeta}]\nparticipation_sqrt_kg = [{root}]\n\
         [modal.cell.point]\nmass = [{}]\n[modal.cell.patch.pzt]\ncoupling_n_per_v = [{}]\ncapacitance = \"{CAPACITANCE_F} F\"\n\
         [circuit.load]\npatch = \"cell.pzt\"\nresistance = \"{LOAD_OHM} ohm\"\n\
         [drive.floor]\nkind = \"base-acceleration\"\nsignal = \"noise\"\npsd = \"0.5 (m/s^2)^2/Hz\"\nhigh = \"1 kHz\"\n\
         [reduction]\nmodes = 1\n[run]\nduration = \"2.2 s\"\naverage_over = \"2 s\"\ntolerance = 1e-8\n{more}",
        w / TAU,
        1.0 / root,
        COUPLING_N_V / root
    );
    Model::new(Spec::from_toml(&text).unwrap()).unwrap()
}

fn run(
    base: &Model,
    members: usize,
    relative_width: Option<f64>,
) -> Result<EnsembleResult, AnalysisError> {
    run_with(base, members, relative_width, false)
}

fn run_with(
    base: &Model,
    members: usize,
    relative_width: Option<f64>,
    with_spectrum: bool,
) -> Result<EnsembleResult, AnalysisError> {
    let start = base.start(Path::new("")).unwrap();
    let most_rounds = if relative_width.is_some() { 50 } else { 1 };
    let study = Ensemble {
        base,
        start,
        members,
        seed: 5,
        relative_width,
        most_rounds,
        with_spectrum,
    };
    study.run()
}

/// No realisations are computed for members that will not run: 100,000 of them would take minutes.
#[test]
fn a_stopped_ensemble_makes_no_more_realisations() {
    let base = spec("");
    base.kernel.control.stop();
    let begin = std::time::Instant::now();
    let result = run(&base, 100_000, None).unwrap();
    assert!(result.members.is_empty() && !result.reached);
    assert!(
        begin.elapsed().as_secs_f64() < 10.0,
        "{:?}",
        begin.elapsed()
    );
}

/// Mean power `pi m a k^2 S / ((2 z a^2 + a) k^2 + 4 z^2 a + 2 (a^2 + 1) z)`, `a = w C R`,
/// `k^2 = theta^2 / (K C)`, `S` two-sided per rad/s (Adhikari, Friswell, Inman 2009). The band
/// excludes 0.3 % of it.
#[test]
fn mean_power_under_white_noise_is_that_of_the_closed_form() {
    let result = run(&spec(""), 24, None).unwrap();
    let w = (STIFFNESS_N_M / MASS_KG).sqrt();
    let (zeta, a) = (
        DASHPOT_N_S_M / (2.0 * MASS_KG * w),
        w * CAPACITANCE_F * LOAD_OHM,
    );
    let k2 = COUPLING_N_V.powi(2) / (STIFFNESS_N_M * CAPACITANCE_F);
    let density = 0.5 / (4.0 * PI);
    let exact = PI * MASS_KG * a * k2 * density
        / ((2.0 * zeta * a * a + a) * k2 + 4.0 * zeta * zeta * a + 2.0 * (a * a + 1.0) * zeta);
    let power = result.power_w;
    let residual = result.members.iter().fold(0.0_f64, |max, member| {
        max.max(member.energy_residual_relative.abs())
    });
    eprintln!(
        "{:.4e} +- {:.1e} W, exact {exact:.4e} W, energy {residual:.1e}",
        power.mean, power.half_width
    );
    assert_eq!(
        (power.interval, result.reached, result.contact_rate_hz.mean),
        (IntervalOver::Members, true, 0.0)
    );
    // 2.07 is Student's quantile for 23 degrees of freedom; the limit is three standard deviations.
    assert!(
        (power.mean - exact).abs() < 3.0 * power.half_width / 2.07 + 0.005 * exact,
        "{} {exact}",
        power.mean
    );
    assert!(power.half_width < 0.2 * exact && residual < 1e-11);
}

#[test]
fn members_come_until_the_interval_is_narrow_and_threads_change_nothing() {
    let base = spec(
        "[stop.wall]\nat = \"cell.mass\"\nlaw = \"hertz\"\nstiffness = \"1e6 N/m^1.5\"\ngap = \"20 um\"\n",
    );
    let run_on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        pool.install(|| run(&base, 4, Some(0.15))).unwrap()
    };
    let (one, three) = (run_on(1), run_on(3));
    assert_eq!(one, three);
    assert!(
        one.reached && one.power_w.relative_width() <= 0.15 && one.members.len().is_multiple_of(4),
        "{:?}",
        one.power_w
    );
    assert!(
        one.contact_rate_hz.mean > 1.0
            && one.mean_contact_duration_s > 0.0
            && one.max_impact_velocity_m_s >= one.mean_impact_velocity_m_s
    );
    assert!(
        one.members
            .iter()
            .all(|member| member.energy_residual_relative.abs() < 1e-6),
        "{:?}",
        one.members
    );
}

#[test]
fn an_ensemble_needs_noise_and_orbits_refuse_it() {
    let mut quiet = spec("").spec;
    quiet.drive.clear();
    let refusal = run(&Model::new(quiet).unwrap(), 2, None).unwrap_err();
    assert!(
        refusal.to_string().contains("signal = \"noise\""),
        "{refusal}"
    );
}

/// A very soft stop follows Rice's formula for the linear response: rate, fraction of the time in
/// contact, and mean approach speed `sqrt(pi / 2) s_v`, with `s_v` the rms of the velocity. The
/// voltage has the statistical bandwidth of its exact density, except for the resolution. The limit
/// is three standard deviations, 2 % with 24 members.
#[test]
fn a_soft_stop_is_struck_at_the_rate_of_rice() {
    let base = spec(
        "[stop.wall]\nat = \"cell.mass\"\nlaw = \"spring\"\nstiffness = \"1e-6 N/m\"\ngap = \"120 um\"\n",
    );
    let exact = Random::new(&base.spec).unwrap().response().unwrap();
    let result = run_with(&base, 24, None, true).unwrap();
    let (stop, rice) = (&result.stops[0], &exact.stops[0]);
    let (rice_hz, rice_share) = rice.reached_hz.zip(rice.share_beyond).unwrap();
    let speed = (PI / 2.0).sqrt()
        * exact
            .points
            .iter()
            .find(|point| point.name == "cell.mass")
            .unwrap()
            .velocity_rms_m_s;
    let rows = [
        ("rate", stop.contact_rate_hz, rice_hz),
        ("speed", stop.mean_impact_velocity_m_s, speed),
        ("duty", stop.contact_duty, rice_share),
        ("dwell", stop.mean_contact_duration_s, rice_share / rice_hz),
        ("power", result.power_w, exact.mean_power_w),
    ];
    for (name, value, exact) in rows {
        eprintln!(
            "{name}: {:.4e} +- {:.1e}, exact {exact:.4e}",
            value.mean, value.half_width
        );
        assert!(
            (value.mean - exact).abs() < 3.0 * value.half_width / 2.07,
            "{name}: {value:?} {exact}"
        );
        assert!(value.half_width < 0.2 * exact, "{name}");
    }
    let (mean_w, width) = (
        result.spectra[0].bandwidth_hz,
        exact.loads[0].statistical_bandwidth_hz,
    );
    let spectrum = &result.spectra[0];
    let sum = spectrum.density.iter().map(|bin| bin.mean).sum::<f64>()
        * (spectrum.frequency_hz[1] - spectrum.frequency_hz[0]);
    eprintln!(
        "bandwidth {:.3} +- {:.2} Hz, exact {width:.3} Hz; mean square {sum:.4e}",
        mean_w.mean, mean_w.half_width
    );
    assert!(
        (mean_w.mean - width).abs() < 3.0 * mean_w.half_width / 2.13 + 0.03 * width
            && mean_w.half_width < 0.3 * width
    );
    assert!(
        (sum / (LOAD_OHM * result.power_w.mean) - 1.0).abs() < 0.05,
        "{sum}"
    );
}

/// The longest contact and the largest speed are no smaller than their means; the counts of the
/// members sum to those of the stops.
#[test]
fn counts_of_stops_add_up() {
    let base = spec(
        "[stop.wall]\nat = \"cell.mass\"\nlaw = \"hertz\"\nstiffness = \"1e6 N/m^1.5\"\ngap = \"20 um\"\n",
    );
    let result = run(&base, 3, None).unwrap();
    let stop = &result.stops[0];
    let contacts: u64 = result.members.iter().map(|member| member.contacts).sum();
    assert_eq!(stop.contact_rate_hz.interval, IntervalOver::Batches);
    assert!((stop.contact_rate_hz.mean / (contacts as f64 / 6.0) - 1.0).abs() < 1e-12);
    assert!(
        (stop.mean_impact_velocity_m_s.mean / result.mean_impact_velocity_m_s - 1.0).abs() < 1e-12
    );
    assert!(
        stop.max_impact_velocity_m_s >= stop.mean_impact_velocity_m_s.mean
            && stop.max_contact_duration_s >= stop.mean_contact_duration_s.mean
    );
    assert!(stop.max_contact_force_n > 0.0 && result.spectra.is_empty());
}
