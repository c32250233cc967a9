//! Claims S2 to S9 of the paper, each tested with computed numbers only.

use super::impact::{Impact, LONG_RUN_S};
use super::{Claim, NamedTable, ReproduceError};
use crate::results::power_over_resistance::PowerOverResistance;
use crate::results::stepped::{DriveLevel, SteppedBranch};
use jounce_io::table::{Column, Table};

/// Returns all claims in order, tested with the stop on the ground. The evidence ends with the
/// verdict for the stop on the shaker table.
pub(super) fn claims(ground: &[Claim], on_table: &[Claim]) -> Vec<Claim> {
    let join = |(ground, on_table): (&Claim, &Claim)| {
        let words = match (ground.holds, on_table.holds) {
            (true, true) => "With the stop on the shaker table the claim holds too.",
            (true, false) => "With the stop on the shaker table the claim does not hold.",
            (false, true) => "With the stop on the shaker table the claim holds.",
            (false, false) => "With the stop on the shaker table it does not hold either.",
        };
        Claim {
            evidence: format!("{} {words}", ground.evidence),
            ..ground.clone()
        }
    };
    ground.iter().zip(on_table).map(join).collect()
}

/// Returns the table that compares both positions of the stop.
pub(super) fn table(ground: &[Claim], on_table: &[Claim]) -> Result<NamedTable, ReproduceError> {
    let texts = |claims: &[Claim], of: fn(&Claim) -> &String| {
        claims
            .iter()
            .map(|claim| of(claim).clone())
            .collect::<Vec<String>>()
    };
    let verdicts = |claims: &[Claim]| {
        claims
            .iter()
            .map(|claim| claim.holds)
            .collect::<Vec<bool>>()
    };
    let table = Table::new(vec![
        Column::new("claim", "", "Claim", texts(ground, |claim| &claim.claim)),
        Column::new("ground_holds", "", "Stop on the ground", verdicts(ground)),
        Column::new("table_holds", "", "Stop on the table", verdicts(on_table)),
        Column::new(
            "table_evidence",
            "",
            "Evidence with the stop on the table",
            texts(on_table, |claim| &claim.evidence),
        ),
    ])?;
    Ok(NamedTable::new(
        "claims",
        "The claims under both readings of where the stop stands.",
        4,
        table,
    ))
}

/// Tests all claims in order for one position of the stop.
pub(super) fn test_claims(computed: &Impact) -> Vec<Claim> {
    vec![
        linear_best_near_resonance(computed),
        second_mode_at_four_times(computed),
        impact_wins_above_resonance(computed),
        impact_loses_below_resonance(computed),
        smaller_optimal_load(computed),
        hardening(computed),
        similar_peak(computed),
        periodic(computed),
    ]
}

fn linear_best_near_resonance(computed: &Impact) -> Claim {
    let linear = &computed.frequency.linear;
    let peak_hz = linear.frequency_hz[linear.peak()];
    let coupling = &computed.first_mode;
    // The curve is sampled every 1 mHz.
    let holds =
        peak_hz > coupling.short_circuit_hz - 0.001 && peak_hz < coupling.open_circuit_hz + 0.001;
    let evidence = format!(
        "The linear power at 1 MΩ peaks at {peak_hz:.3} Hz with {:.3e} W/N²; the first bending mode lies at {:.3} Hz short-circuited and \
         {:.3} Hz open. Criterion: the peak lies between the two.",
        linear.power_w_n2[linear.peak()],
        coupling.short_circuit_hz,
        coupling.open_circuit_hz
    );
    Claim::new(
        "S2: The linear harvester performs best near its resonance.",
        holds,
        evidence,
    )
}

fn second_mode_at_four_times(computed: &Impact) -> Claim {
    let mut lines = computed.voltage.lines.clone();
    lines.sort_by(|a, b| b.amplitude_peak.total_cmp(&a.amplitude_peak));
    let nearest = (computed.second_mode_hz / computed.voltage.lines[1].frequency_hz).round();
    let holds = lines[0].order == 1.0 && lines[1].order == 4.0 && nearest == 4.0;
    let printed: Vec<String> = lines
        .iter()
        .take(4)
        .map(|line| {
            format!(
                "{:.2} V at {:.1} Hz ({}×)",
                line.amplitude_peak, line.frequency_hz, line.order
            )
        })
        .collect();
    let evidence = format!(
        "Highest lines of the voltage at 13 Hz and 200 N: {}. The second bending mode lies at {:.1} Hz, nearest to {nearest}× the drive. \
         Criterion: the second highest line is that at 4×.",
        printed.join(", "),
        computed.second_mode_hz
    );
    Claim::new(
        "S3: At 13 Hz and 200 N the second mode shows at four times the drive, as the second highest line.",
        holds,
        evidence,
    )
}

fn impact_wins_above_resonance(computed: &Impact) -> Claim {
    let (low, high) = computed.above.gain_range();
    let evidence = format!(
        "At 13 Hz and 200 N impact gives {low:.2} to {high:.2} times the linear power over 10 kΩ to 10 MΩ. Criterion: more than 1 at every load."
    );
    Claim::new(
        "S4: Close to the resonance with impact (13 Hz, 200 N) impact gives more power.",
        low > 1.0,
        evidence,
    )
}

fn impact_loses_below_resonance(computed: &Impact) -> Claim {
    let (low, high) = computed.below.gain_range();
    let evidence = format!(
        "At 6 Hz and 50 N impact gives {low:.2} to {high:.2} times the linear power over 10 kΩ to 10 MΩ. Criterion: less than 1 at every load."
    );
    Claim::new(
        "S5: Below the linear resonance (6 Hz, 50 N) the linear harvester gives more power.",
        high < 1.0,
        evidence,
    )
}

fn smaller_optimal_load(computed: &Impact) -> Claim {
    let printed = |figure: &PowerOverResistance| {
        let linear_ohm = figure.linear_best.resistance_ohm;
        format!(
            "{:.1} kΩ with impact and {:.1} kΩ without at {} Hz ({:+.1} %)",
            figure.impact_best_ohm / 1e3,
            linear_ohm / 1e3,
            figure.case.frequency_hz,
            100.0 * (figure.impact_best_ohm / linear_ohm - 1.0)
        )
    };
    let slightly = |figure: &PowerOverResistance| {
        (0.7..1.0).contains(&(figure.impact_best_ohm / figure.linear_best.resistance_ohm))
    };
    let (above, below) = (&computed.above, &computed.below);
    let evidence = format!(
        "Best loads: {}; {}. Criterion: smaller with impact, by less than 30 %.",
        printed(above),
        printed(below)
    );
    Claim::new(
        "S6: The optimal load is slightly smaller with impact, at both drives.",
        slightly(above) && slightly(below),
        evidence,
    )
}

fn hardening(computed: &Impact) -> Claim {
    let levels = &computed.frequency.levels;
    let linear = &computed.frequency.linear;
    let peaks_hz: Vec<f64> = levels
        .iter()
        .map(|level| level.up.frequency_hz[level.up.peak()])
        .collect();
    let rises = peaks_hz.windows(2).all(|pair| pair[1] > pair[0])
        && peaks_hz[0] > linear.frequency_hz[linear.peak()];
    let jumps = levels.iter().all(|level| level.up.steepest().1 >= 2.0);
    let hysteresis = levels.iter().any(|level| level.coexistence.factor() >= 1.5);
    let printed: Vec<String> = levels.iter().map(print_level).collect();
    let evidence = format!(
        "Stepped up, the peak lies at {}. Criterion: the peak rises with the force and lies above the linear one, at each level a step of \
         0.1 Hz changes the power at least twofold, and at one level or more the two directions still differ at least 1.5-fold after a further {LONG_RUN_S} s at the \
         frequency where they differ most.",
        printed.join("; ")
    );
    let claim = "S7: Impact hardens: the peak moves up with the force, with jumps, and near them several solutions exist.";
    Claim::new(claim, rises && jumps && hysteresis, evidence)
}

fn print_level(level: &DriveLevel) -> String {
    let (before, factor) = level.up.steepest();
    let both = &level.coexistence;
    format!(
        "{:.1} Hz at {} N (steepest step {factor:.1}-fold, {:.1} to {:.1} Hz; at {:.1} Hz the two ways end at {:.2e} and {:.2e} W/N²)",
        level.up.frequency_hz[level.up.peak()],
        level.amplitude_n,
        level.up.frequency_hz[before],
        level.up.frequency_hz[before + 1],
        both.frequency_hz,
        both.up_w_n2,
        both.down_w_n2
    )
}

fn similar_peak(computed: &Impact) -> Claim {
    let highest = |branch: &SteppedBranch| branch.power_w_n2[branch.peak()];
    let linear = highest(&computed.frequency.linear);
    let ratios: Vec<f64> = computed
        .frequency
        .levels
        .iter()
        .map(|level| highest(&level.up) / linear)
        .collect();
    let printed: Vec<String> = computed
        .frequency
        .levels
        .iter()
        .zip(&ratios)
        .map(|(level, ratio)| format!("{:.2} % at {} N", 100.0 * ratio, level.amplitude_n))
        .collect();
    let holds = ratios.iter().all(|ratio| (0.5..=2.0).contains(ratio));
    let evidence = format!(
        "Highest power per force squared on the way up over the linear peak ({linear:.3e} W/N²): {}. Criterion: within a factor of 2 at \
         each level.",
        printed.join(", ")
    );
    Claim::new(
        "S8: At its resonance the power with impact is similar to the linear case.",
        holds,
        evidence,
    )
}

fn periodic(computed: &Impact) -> Claim {
    let branches = || {
        computed
            .frequency
            .levels
            .iter()
            .flat_map(|level| [&level.up, &level.down])
    };
    let points = || branches().flat_map(|branch| branch.settled.iter().zip(&branch.period_cycles));
    let settled = points().filter(|(settled, _)| **settled).count();
    let longer = points()
        .filter(|(settled, period)| **settled && **period > 1)
        .count();
    let long = computed
        .long_run
        .settlement
        .filter(|settlement| settlement.settled);
    let orbit = long.map_or_else(
        || "no orbit of 1 to 4 periods".to_owned(),
        |settlement| format!("an orbit of {} drive period(s)", settlement.period_cycles),
    );
    let evidence = format!(
        "At 13 Hz and 200 N a run of {} s ends on {orbit}. Of the {} points of figure 6, {settled} end within 20 s on an orbit of 1 to 4 drive \
         periods, {longer} of them on a subharmonic one. Criterion: the first run is periodic, and subharmonic orbits occur.",
        LONG_RUN_S,
        points().count()
    );
    Claim::new(
        "S9: The response is periodic, often with the drive; subharmonics can be present.",
        long.is_some() && longer > 0,
        evidence,
    )
}
