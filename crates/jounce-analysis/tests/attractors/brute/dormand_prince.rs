//! Step of the explicit Runge-Kutta method of order 8 of Dormand and Prince with its error
//! estimate.
//!
//! Source: E. Hairer, S. P. Norsett and G. Wanner, *Solving Ordinary Differential Equations I* (2nd
//! ed., Springer, 1993), section II.5 and appendix (DOP853). The error is
//! `h |e5|^2 / sqrt(|e5|^2 + 0.01 |e3|^2)` with the differences to methods of orders 5 and 3.

use super::scales::Weights;

const C2: f64 = 5.260_015_195_876_773e-2;
const C3: f64 = 7.890_022_793_815_16e-2;
const C4: f64 = 1.183_503_419_072_274e-1;
const C5: f64 = 2.816_496_580_927_726e-1;
const C6: f64 = 1.0 / 3.0;
const C7: f64 = 0.25;
const C8: f64 = 4.0 / 13.0;
const C9: f64 = 127.0 / 195.0;
const C10: f64 = 0.6;
const C11: f64 = 6.0 / 7.0;

/// Weights of the rates at the stages 1 to 12 in the state after a step.
pub const WEIGHTS: [f64; 12] = [
    5.429_373_411_656_876_5e-2,
    0.0,
    0.0,
    0.0,
    0.0,
    4.450_312_892_752_409,
    1.891_517_899_314_500_3,
    -5.801_203_960_010_585,
    3.111_643_669_578_199e-1,
    -1.521_609_496_625_161e-1,
    2.013_654_008_040_303_4e-1,
    4.471_061_572_777_259e-2,
];

/// State after a step, and its error estimate relative to `weights`.
pub struct Stepped<const D: usize> {
    pub state: [f64; D],
    pub error: f64,
}

/// `y + h sum_j a_j k_j`.
#[inline(always)]
fn stage_state<const D: usize, const S: usize>(
    y: &[f64; D],
    h: f64,
    terms: [(f64, &[f64; D]); S],
) -> [f64; D] {
    std::array::from_fn(|i| y[i] + h * terms.iter().map(|(a, k)| a * k[i]).sum::<f64>())
}

/// Rates at the stages 2 to 8.
#[inline(always)]
fn first_stages<const D: usize>(
    rate: &impl Fn(f64, &[f64; D]) -> [f64; D],
    (t, h): (f64, f64),
    y: &[f64; D],
    k1: &[f64; D],
) -> [[f64; D]; 7] {
    let k2 = rate(
        t + C2 * h,
        &stage_state(y, h, [(5.260_015_195_876_773e-2, k1)]),
    );
    let terms = [
        (1.972_505_698_453_79e-2, k1),
        (5.917_517_095_361_37e-2, &k2),
    ];
    let k3 = rate(t + C3 * h, &stage_state(y, h, terms));
    let terms = [
        (2.958_758_547_680_685e-2, k1),
        (8.876_275_643_042_054e-2, &k3),
    ];
    let k4 = rate(t + C4 * h, &stage_state(y, h, terms));
    let terms = [
        (2.413_651_341_592_667e-1, k1),
        (-8.845_494_793_282_861e-1, &k3),
        (9.248_340_032_617_92e-1, &k4),
    ];
    let k5 = rate(t + C5 * h, &stage_state(y, h, terms));
    let terms = [
        (1.0 / 27.0, k1),
        (1.708_286_087_294_738_6e-1, &k4),
        (1.254_676_875_668_224_2e-1, &k5),
    ];
    let k6 = rate(t + C6 * h, &stage_state(y, h, terms));
    let terms = [
        (3.710_937_5e-2, k1),
        (1.702_522_110_195_440_4e-1, &k4),
        (6.021_653_898_045_596e-2, &k5),
        (-1.757_812_5e-2, &k6),
    ];
    let k7 = rate(t + C7 * h, &stage_state(y, h, terms));
    let terms = [
        (3.709_200_011_850_479e-2, k1),
        (1.703_839_257_122_399_8e-1, &k4),
        (1.072_620_304_463_732_8e-1, &k5),
        (-1.531_943_774_862_440_2e-2, &k6),
        (8.273_789_163_814_023e-3, &k7),
    ];
    let k8 = rate(t + C8 * h, &stage_state(y, h, terms));
    [k2, k3, k4, k5, k6, k7, k8]
}

/// Rates at the stages 9 to 12.
#[inline(always)]
fn last_stages<const D: usize>(
    rate: &impl Fn(f64, &[f64; D]) -> [f64; D],
    (t, h): (f64, f64),
    y: &[f64; D],
    [k1, k4, k5, k6, k7, k8]: [&[f64; D]; 6],
) -> [[f64; D]; 4] {
    let terms = [
        (6.241_109_587_160_757e-1, k1),
        (-3.360_892_629_446_941_4, k4),
        (-8.682_193_468_417_26e-1, k5),
        (2.759_209_969_944_671e1, k6),
        (2.015_406_755_047_789_4e1, k7),
        (-4.348_988_418_106_996e1, k8),
    ];
    let k9 = rate(t + C9 * h, &stage_state(y, h, terms));
    let terms = [
        (4.776_625_364_382_643_4e-1, k1),
        (-2.488_114_619_971_667_7, k4),
        (-5.902_908_268_368_43e-1, k5),
        (2.123_005_144_818_119_3e1, k6),
        (1.527_923_363_288_242_3e1, k7),
        (-3.328_821_096_898_486e1, k8),
        (-2.033_120_170_850_862_7e-2, &k9),
    ];
    let k10 = rate(t + C10 * h, &stage_state(y, h, terms));
    let terms = [
        (-9.371_424_300_859_873e-1, k1),
        (5.186_372_428_844_064, k4),
        (1.091_437_348_996_729_5, k5),
        (-8.149_787_010_746_927, k6),
        (-1.852_006_565_999_696e1, k7),
        (2.273_948_709_935_050_5e1, k8),
        (2.493_605_552_679_652_3, &k9),
        (-3.046_764_471_898_219_6, &k10),
    ];
    let k11 = rate(t + C11 * h, &stage_state(y, h, terms));
    let terms = [
        (2.273_310_147_516_538, k1),
        (-1.053_449_546_673_725e1, k4),
        (-2.000_872_058_224_862_5, k5),
        (-1.795_893_186_311_88e1, k6),
        (2.794_888_452_941_996e1, k7),
        (-2.858_998_277_135_023_5, k8),
        (-8.872_856_933_530_63, &k9),
        (1.236_056_717_579_430_3e1, &k10),
        (6.433_927_460_157_636e-1, &k11),
    ];
    let k12 = rate(t + h, &stage_state(y, h, terms));
    [k9, k10, k11, k12]
}

/// Takes a step of length `h` from `y` at `t`, where the rate is `k1`.
#[inline(always)]
pub fn step<const D: usize>(
    rate: impl Fn(f64, &[f64; D]) -> [f64; D],
    (t, h): (f64, f64),
    (y, k1): (&[f64; D], &[f64; D]),
    weights: &Weights<D>,
) -> Stepped<D> {
    let [_, _, k4, k5, k6, k7, k8] = first_stages(&rate, (t, h), y, k1);
    let [k9, k10, k11, k12] = last_stages(&rate, (t, h), y, [k1, &k4, &k5, &k6, &k7, &k8]);
    let terms = [
        (WEIGHTS[0], k1),
        (WEIGHTS[5], &k6),
        (WEIGHTS[6], &k7),
        (WEIGHTS[7], &k8),
        (WEIGHTS[8], &k9),
        (WEIGHTS[9], &k10),
        (WEIGHTS[10], &k11),
        (WEIGHTS[11], &k12),
    ];
    let state = stage_state(y, h, terms);
    let fifth = [
        (1.312_004_499_419_488e-2, k1),
        (-1.225_156_446_376_204_4, &k6),
        (-4.957_589_496_572_502e-1, &k7),
        (1.664_377_182_454_986_4, &k8),
        (-3.503_288_487_499_736_6e-1, &k9),
        (3.341_791_187_130_175e-1, &k10),
        (8.192_320_648_511_571e-2, &k11),
        (-2.235_530_786_388_629_4e-2, &k12),
    ];
    let by_fifth = weights.square(&stage_state(&[0.0; D], h, fifth));
    let third = [
        (-2.440_944_881_889_764e-1, k1),
        (-7.338_466_882_816_118e-1, &k9),
        (-2.205_882_352_941_176_6e-2, &k12),
    ];
    let gained: [f64; D] = std::array::from_fn(|i| state[i] - y[i]);
    let by_third = weights.square(&stage_state(&gained, h, third));
    let both = by_fifth + 0.01 * by_third;
    Stepped {
        state,
        error: if both == 0.0 {
            0.0
        } else {
            by_fifth / both.sqrt()
        },
    }
}
