/* DOP853, the adaptive Runge-Kutta pair of order 8 by Hairer, Norsett and Wanner, on the modal plant.
 *
 * dop853_coefficients.h is written at build time from the table that SciPy carries. Error norm and step control are those of
 * the book (Solving Ordinary Differential Equations I, II.10); no dense output, so 12 right-hand sides a step.
 * Usage: dop853 PLANT RELATIVE ABSOLUTE.  Prints one JSON line; cpu_s is the integration alone.
 */
#include "plant.h"
#include "dop853_coefficients.h"

typedef union {
    struct { modal q, v; lanes voltage, energy_j; };
    lanes all[2 * VECTORS + 2];
    double each[LANES * (2 * VECTORS + 2)];
} state;

typedef struct { double relative, absolute; int components; long evaluations; } control;

INLINE state rate(const plant *p, double t, const state *y) {
    state d;
    rates r = right_hand_side(p, &y->q, &y->v, y->voltage, p->amplitude_n * sin(2 * M_PI * p->frequency_hz * t));
    d.q = y->v;
    d.v = r.acceleration;
    d.voltage = r.voltage;
    d.energy_j = y->voltage * y->voltage / p->resistance_ohm;
    return d;
}

INLINE state combine(const state *y, double h, const double *weights, const state *k, int count) {
    state out;
    for (int i = 0; i < 2 * VECTORS + 2; i++) {
        lanes total = weights[0] * k[0].all[i];
        for (int j = 1; j < count; j++)
            if (weights[j] != 0.0) total += weights[j] * k[j].all[i];
        out.all[i] = y->all[i] + h * total;
    }
    return out;
}

/* Sum of squares of the weighted rates over the allowed error; a value that stands in every lane counts once. */
INLINE double squares(const double *weights, const state *k, const state *allowed) {
    static const state nothing;
    state e = combine(&nothing, 1.0, weights, k, 13);
    lanes modes = {0};
    for (int i = 0; i < 2 * VECTORS; i++) modes += (e.all[i] / allowed->all[i]) * (e.all[i] / allowed->all[i]);
    double voltage = e.voltage[0] / allowed->voltage[0], energy = e.energy_j[0] / allowed->energy_j[0];
    return sum(modes)[0] + voltage * voltage + energy * energy;
}

INLINE state larger(const state *a, const state *b, const control *c) {
    state out;
    for (int i = 0; i < LANES * (2 * VECTORS + 2); i++) {
        double x = fabs(a->each[i]), y = fabs(b->each[i]);
        out.each[i] = c->absolute + c->relative * (x > y ? x : y);
    }
    return out;
}

/* One trial step from y with k[0] known; returns the error in units of the allowed one and leaves the new rate in k[12]. */
static double attempt(const plant *p, double t, double h, const state *y, state *k, state *fresh, const control *c) {
#pragma GCC unroll 12
    for (int i = 1; i < 12; i++) {
        state stage = combine(y, h, DOP853_A[i], k, i);
        k[i] = rate(p, t + DOP853_C[i] * h, &stage);
    }
    *fresh = combine(y, h, DOP853_B, k, 12);
    k[12] = rate(p, t + h, fresh);
    state allowed = larger(y, fresh, c);
    double fifth = squares(DOP853_E5, k, &allowed), third = squares(DOP853_E3, k, &allowed);
    return fifth == 0.0 ? 0.0 : h * fifth / sqrt((fifth + 0.01 * third) * c->components);
}

static void march(const plant *p, state *y, double t, double end, control *c) {
    state k[13], fresh;
    double h = 1e-5, widest = 6.0;
    k[0] = rate(p, t, y);
    while (t < end) {
        int last = t + h >= end;
        if (last) h = end - t;
        double error = attempt(p, t, h, y, k, &fresh, c);
        c->evaluations += 12;
        double factor = fmin(widest, fmax(1.0 / 3.0, 0.9 * pow(error, -1.0 / 8.0)));
        if (error <= 1.0) {
            t = last ? end : t + h;
            *y = fresh;
            k[0] = k[12];
            widest = 6.0;
        } else if (isfinite(error)) {
            widest = 1.0;
        } else {
            factor = 1.0 / 3.0;
        }
        h *= factor;
    }
}

static double mean_power_w(const plant *p, control *c) {
    state y;
    memset(&y, 0, sizeof y);
    double window = p->duration_s - p->average_over_s;
    c->evaluations = 0;
    march(p, &y, 0.0, window, c);
    y.energy_j = (lanes){0};
    march(p, &y, window, p->duration_s, c);
    return y.energy_j[0] / p->average_over_s;
}

int main(int argc, char **argv) {
    control c = {argc == 4 ? atof(argv[2]) : 0.0, argc == 4 ? atof(argv[3]) : 0.0, 0, 0};
    if (!(c.relative > 0.0 && c.absolute > 0.0)) {
        fprintf(stderr, "usage: dop853 PLANT RELATIVE ABSOLUTE (both above 0)\n");
        return 2;
    }
    plant p = read_plant(argv[1]), warm = p;
    c.components = 2 * p.modes + 2;
    warm.duration_s = warm.average_over_s = 0.05 * p.duration_s;
    volatile double warmed = mean_power_w(&warm, &c);
    (void)warmed;
    double start = cpu_s(), power = mean_power_w(&p, &c), taken = cpu_s() - start;
    printf("{\"mean_power_w\": %.17g, \"cpu_s\": %.9g, \"evaluations\": %ld}\n", power, taken, c.evaluations);
    return 0;
}
