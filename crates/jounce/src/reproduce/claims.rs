//! Claims S2 to S9 of the paper, each judged on computed numbers only.

use super::Claim;
use super::computed::Computed;
use super::power_over_resistance::PowerOverResistance;
use super::stepped::{Branch, Level};

/// All claims in order.
pub(super) fn claims(computed: &Computed) -> Vec<Claim> {
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

fn linear_best_near_resonance(computed: &Computed) -> Claim {
    let linear = &computed.frequency.linear;
    let peak_hz = linear.frequency_hz[linear.peak()];
    let coupling = &computed.first_mode;
    // The curve is sampled every 5 mHz.
    let holds = peak_hz > coupling.short_circuit_hz - 0.005 && peak_hz < coupling.open_circuit_hz + 0.005;
    let evidence = format!(
        "The linear power at 1 MΩ peaks at {peak_hz:.3} Hz with {:.3e} W/N²; the first bending mode lies at {:.3} Hz short-circuited and \
         {:.3} Hz open. Criterion: the peak lies between the two.",
        linear.power_w_n2[linear.peak()],
        coupling.short_circuit_hz,
        coupling.open_circuit_hz
    );
    Claim::new("S2: The linear harvester performs best near its resonance.", holds, evidence)
}

fn second_mode_at_four_times(computed: &Computed) -> Claim {
    let mut lines = computed.voltage.lines.clone();
    lines.sort_by(|a, b| b.amplitude_peak.total_cmp(&a.amplitude_peak));
    let nearest = (computed.second_mode_hz / computed.voltage.lines[1].frequency_hz).round();
    let holds = lines[0].order == 1.0 && lines[1].order == 4.0 && nearest == 4.0;
    let told: Vec<String> =
        lines.iter().take(4).map(|line| format!("{:.2} V at {:.1} Hz ({}×)", line.amplitude_peak, line.frequency_hz, line.order)).collect();
    let evidence = format!(
        "Highest lines of the voltage at 13 Hz and 200 N: {}. The second bending mode lies at {:.1} Hz, nearest to {nearest}× the drive. \
         Criterion: the second highest line is that at 4×.",
        told.join(", "),
        computed.second_mode_hz
    );
    Claim::new("S3: At 13 Hz and 200 N the second mode shows at four times the drive, as the second highest line.", holds, evidence)
}

fn impact_wins_above_resonance(computed: &Computed) -> Claim {
    let (low, high) = computed.above.gain_range();
    let evidence = format!(
        "At 13 Hz and 200 N impact gives {low:.2} to {high:.2} times the linear power over 10 kΩ to 10 MΩ. Criterion: more than 1 at every load."
    );
    Claim::new("S4: Close to the resonance with impact (13 Hz, 200 N) impact gives more power.", low > 1.0, evidence)
}

fn impact_loses_below_resonance(computed: &Computed) -> Claim {
    let (low, high) = computed.below.gain_range();
    let evidence = format!(
        "At 6 Hz and 50 N impact gives {low:.2} to {high:.2} times the linear power over 10 kΩ to 10 MΩ. Criterion: less than 1 at every load."
    );
    Claim::new("S5: Below the linear resonance (6 Hz, 50 N) the linear harvester gives more power.", high < 1.0, evidence)
}

fn smaller_optimal_load(computed: &Computed) -> Claim {
    let told = |figure: &PowerOverResistance| {
        let linear_ohm = figure.linear_best.resistance_ohm;
        format!(
            "{:.1} kΩ with impact and {:.1} kΩ without at {} Hz ({:+.1} %)",
            figure.impact_best_ohm / 1e3,
            linear_ohm / 1e3,
            figure.case.frequency_hz,
            100.0 * (figure.impact_best_ohm / linear_ohm - 1.0)
        )
    };
    let slightly = |figure: &PowerOverResistance| (0.7..1.0).contains(&(figure.impact_best_ohm / figure.linear_best.resistance_ohm));
    let (above, below) = (&computed.above, &computed.below);
    let evidence = format!("Best loads: {}; {}. Criterion: smaller with impact, by less than 30 %.", told(above), told(below));
    Claim::new("S6: The optimal load is slightly smaller with impact, at both drives.", slightly(above) && slightly(below), evidence)
}

fn hardening(computed: &Computed) -> Claim {
    let levels = &computed.frequency.levels;
    let linear = &computed.frequency.linear;
    let peaks_hz: Vec<f64> = levels.iter().map(|level| level.up.frequency_hz[level.up.peak()]).collect();
    let rises = peaks_hz.windows(2).all(|pair| pair[1] > pair[0]) && peaks_hz[0] > linear.frequency_hz[linear.peak()];
    let jumps = levels.iter().all(|level| level.up.steepest().1 >= 2.0);
    let hysteresis = levels.iter().all(|level| widest_gap(level).is_some_and(|(_, factor)| factor >= 1.5));
    let told: Vec<String> = levels.iter().map(told_level).collect();
    let evidence = format!(
        "Stepped up, the peak lies at {}. Criterion: the peak rises with the force and lies above the linear one, a step of 0.1 Hz changes the \
         power at least twofold, and where both ways have settled they differ at least 1.5-fold somewhere.",
        told.join("; ")
    );
    let claim = "S7: Impact hardens: the peak moves up with the force, with a jump, and up and down sweeps differ.";
    Claim::new(claim, rises && jumps && hysteresis, evidence)
}

fn told_level(level: &Level) -> String {
    let (before, factor) = level.up.steepest();
    let gap = widest_gap(level).map_or("up and down agree wherever both have settled".to_owned(), |(frequency_hz, factor)| {
        format!("up and down differ up to {factor:.1}-fold (at {frequency_hz:.1} Hz)")
    });
    format!(
        "{:.1} Hz at {} N (steepest step {factor:.1}-fold, {:.1} to {:.1} Hz; {gap})",
        level.up.frequency_hz[level.up.peak()],
        level.amplitude_n,
        level.up.frequency_hz[before],
        level.up.frequency_hz[before + 1]
    )
}

/// Frequency and factor of the largest difference between both ways where both have settled, if any is above 1 %.
fn widest_gap(level: &Level) -> Option<(f64, f64)> {
    let count = level.up.frequency_hz.len();
    let factors = (0..count).filter_map(|up| {
        let down = count - 1 - up;
        let factor = level.up.power_w_n2[up] / level.down.power_w_n2[down];
        (level.up.settled[up] && level.down.settled[down]).then_some((level.up.frequency_hz[up], factor.max(1.0 / factor)))
    });
    factors.max_by(|a, b| a.1.total_cmp(&b.1)).filter(|(_, factor)| *factor > 1.01)
}

fn similar_peak(computed: &Computed) -> Claim {
    let highest = |branch: &Branch| branch.power_w_n2[branch.peak()];
    let linear = highest(&computed.frequency.linear);
    let ratios: Vec<f64> = computed.frequency.levels.iter().map(|level| highest(&level.up) / linear).collect();
    let told: Vec<String> =
        computed.frequency.levels.iter().zip(&ratios).map(|(level, ratio)| format!("{ratio:.2} at {} N", level.amplitude_n)).collect();
    let holds = ratios.iter().all(|ratio| (0.5..=2.0).contains(ratio));
    let evidence = format!(
        "Highest power per force squared on the way up over the linear peak ({linear:.3e} W/N²): {}. Criterion: within a factor of 2 at \
         each level.",
        told.join(", ")
    );
    Claim::new("S8: At its resonance the power with impact is similar to the linear case.", holds, evidence)
}

fn periodic(computed: &Computed) -> Claim {
    let branches = || computed.frequency.levels.iter().flat_map(|level| [&level.up, &level.down]);
    let points = || branches().flat_map(|branch| branch.settled.iter().zip(&branch.period_cycles));
    let settled = points().filter(|(settled, _)| **settled).count();
    let longer = points().filter(|(settled, period)| **settled && **period > 1).count();
    let long = &computed.long_run.settlement;
    let orbit =
        if long.settled { format!("an orbit of {} drive period(s)", long.period_cycles) } else { "no orbit of 1 to 4 periods".to_owned() };
    let evidence = format!(
        "At 13 Hz and 200 N a run of {} s ends on {orbit}. Of the {} points of figure 6, {settled} end within 20 s on an orbit of 1 to 4 drive \
         periods, {longer} of them on a subharmonic one. Criterion: the first run is periodic, and subharmonic orbits occur.",
        super::computed::LONG_RUN_S,
        points().count()
    );
    Claim::new("S9: The response is periodic, often with the drive; subharmonics can be present.", long.settled && longer > 0, evidence)
}
