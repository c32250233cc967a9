//! Sums over the lines of a band that the equations of every order share.

use jounce_linalg::c64;
use rayon::prelude::*;

use crate::modal::Band;

/// Summed signals: the responses, their products over the outputs by pairs of inputs, and ones.
pub(super) fn signals(band: &Band) -> Vec<Vec<c64>> {
    let (inputs, outputs, lines) = (band.inputs, band.outputs(), band.frequency_hz.len());
    // In measured quantities: displacement would give the lowest lines all the weight. Responses
    // are scaled to equal size, so that the unit of a sensor has no effect. For several inputs, all
    // responses of an output share a factor, then all responses to an input, which does not change
    // the poles.
    let mut response: Vec<Vec<c64>> = (0..band.response.len()).map(|k| band.measured(k)).collect();
    (0..outputs).for_each(|o| normalise(response[o * inputs..(o + 1) * inputs].iter_mut()));
    if inputs > 1 {
        (0..inputs).for_each(|i| normalise(response.iter_mut().skip(i).step_by(inputs)));
    }
    let at = |o: usize, i: usize| &response[o * inputs + i];
    let product = |i: usize, j: usize| -> Vec<c64> {
        (0..lines)
            .map(|k| (0..outputs).map(|o| at(o, i)[k].conj() * at(o, j)[k]).sum())
            .collect()
    };
    let products = (0..inputs)
        .flat_map(|i| (0..inputs).map(move |j| (i, j)))
        .map(|(i, j)| product(i, j));
    let unit_signal = vec![c64::new(1.0, 0.0); lines];
    response
        .iter()
        .cloned()
        .chain(products)
        .chain([unit_signal])
        .collect()
}

/// Divides responses by the RMS of all of them.
fn normalise<'a>(responses: impl Iterator<Item = &'a mut Vec<c64>>) {
    let mut responses: Vec<&mut Vec<c64>> = responses.collect();
    let (sum, lines) = responses
        .iter()
        .flat_map(|h| h.iter())
        .fold((0.0, 0), |(sum, lines), x| (sum + x.norm_sqr(), lines + 1));
    let rms = (sum / f64::from(lines)).sqrt();
    if rms > 0.0 {
        responses
            .iter_mut()
            .flat_map(|h| h.iter_mut())
            .for_each(|x| *x /= rms);
    }
}

/// Lines summed at once; partial sums are added in order, so results are bitwise equal for any
/// number of threads.
const LINES_AT_ONCE: usize = 1024;
/// Numbers added in parallel.
const LANES: usize = 8;

/// `re sum z^k h` of each signal `h` for k from `-max_order` to `max_order`. With `a = sum re z^k re h`
/// and `b = sum im z^k im h` the sums of `k` and `-k` are `a - b` and `a + b`, and the powers of `z`
/// serve all signals.
pub(super) fn fourier_sums(
    phasors: &[c64],
    signals: &[Vec<c64>],
    max_order: usize,
) -> Vec<Vec<f64>> {
    let block_sums = |from: usize| -> Vec<[f64; 2]> {
        let lines = from..(from + LINES_AT_ONCE).min(phasors.len());
        let interleaved = |values: &[c64]| {
            values[lines.clone()]
                .iter()
                .flat_map(|x| [x.re, x.im])
                .collect::<Vec<f64>>()
        };
        let signals: Vec<Vec<f64>> = signals.iter().map(|h| interleaved(h)).collect();
        let mut power = [1.0, 0.0].repeat(lines.len());
        let mut sums = Vec::with_capacity(signals.len() * (max_order + 1));
        for _ in 0..=max_order {
            sums.extend(signals.iter().map(|h| products(&power, h)));
            for (power, z) in power
                .as_chunks_mut::<2>()
                .0
                .iter_mut()
                .zip(&phasors[lines.clone()])
            {
                *power = [
                    power[0] * z.re - power[1] * z.im,
                    power[0] * z.im + power[1] * z.re,
                ];
            }
        }
        sums
    };
    let blocks: Vec<Vec<[f64; 2]>> = (0..phasors.len())
        .into_par_iter()
        .step_by(LINES_AT_ONCE)
        .map(block_sums)
        .collect();
    let mut sums = vec![vec![0.0; 2 * max_order + 1]; signals.len()];
    for block in blocks {
        for (index, [a, b]) in block.into_iter().enumerate() {
            let (k, signal) = (index / signals.len(), &mut sums[index % signals.len()]);
            signal[max_order + k] += a - b;
            if k > 0 {
                signal[max_order - k] += a + b;
            }
        }
    }
    sums
}

/// Sums of the products of real parts and of imaginary parts, which are interleaved.
fn products(x: &[f64], y: &[f64]) -> [f64; 2] {
    let mut lanes = [0.0; LANES];
    let (x, y) = (x.chunks(LANES), y.chunks(LANES));
    for (x, y) in x.zip(y) {
        for (lane, (x, y)) in lanes.iter_mut().zip(x.iter().zip(y)) {
            *lane += x * y;
        }
    }
    let strided_sum = |from: usize| lanes.iter().skip(from).step_by(2).sum();
    [strided_sum(0), strided_sum(1)]
}
