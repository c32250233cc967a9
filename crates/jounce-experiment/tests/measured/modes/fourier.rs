//! Periodic signals by their Fourier transform.

use jounce_fft::Complex;

/// Transform of a signal.
pub fn spectrum(signal: &[f64]) -> Vec<Complex<f64>> {
    let plan = jounce_fft::forward(signal.len());
    let (mut input, mut bins) = (signal.to_vec(), plan.make_output_vec());
    plan.process(&mut input, &mut bins)
        .expect("the plan made the length");
    bins
}

/// Steady response to a signal with this transform, by the response function at its lines.
pub fn steady_response(
    spectrum: &[Complex<f64>],
    response: &[Complex<f64>],
    samples: usize,
) -> Vec<f64> {
    let mut bins: Vec<_> = spectrum
        .iter()
        .zip(response)
        .map(|(f, h)| f * h / samples as f64)
        .collect();
    let last = bins.len() - 1;
    (bins[0].im, bins[last].im) = (0.0, 0.0);
    let plan = jounce_fft::inverse(samples);
    let mut values = plan.make_output_vec();
    plan.process(&mut bins, &mut values)
        .expect("the plan made the length");
    values
}
