/* Fixed-step Runge-Kutta 4 on the modal plant: the bar to beat.
 *
 * The energy in the resistor, E' = V^2 / R over the averaging window, is a state of its own. The drive is a phasor turned
 * by half a step at a time, set afresh from sin and cos every 512 steps.
 * Usage: rk4 PLANT STEPS_PER_SECOND.  Prints one JSON line; cpu_s is the integration alone.
 */
#include "plant.h"

#define RESET 512

typedef struct { modal q, v; lanes voltage, energy_j; } state;

INLINE void step(const plant *p, state *s, double h, double start_n, double middle_n, double end_n) {
    rates a = right_hand_side(p, &s->q, &s->v, s->voltage, start_n);
    modal q2 = along(&s->q, h / 2, &s->v), v2 = along(&s->v, h / 2, &a.acceleration);
    lanes voltage2 = s->voltage + h / 2 * a.voltage;
    rates b = right_hand_side(p, &q2, &v2, voltage2, middle_n);
    modal q3 = along(&s->q, h / 2, &v2), v3 = along(&s->v, h / 2, &b.acceleration);
    lanes voltage3 = s->voltage + h / 2 * b.voltage;
    rates c = right_hand_side(p, &q3, &v3, voltage3, middle_n);
    modal q4 = along(&s->q, h, &v3), v4 = along(&s->v, h, &c.acceleration);
    lanes voltage4 = s->voltage + h * c.voltage;
    rates d = right_hand_side(p, &q4, &v4, voltage4, end_n);
    lanes powers = s->voltage * s->voltage + 2 * voltage2 * voltage2 + 2 * voltage3 * voltage3 + voltage4 * voltage4;
    s->energy_j += h / 6 * powers / p->resistance_ohm;
    for (int i = 0; i < VECTORS; i++) {
        s->q.part[i] += h * s->v.part[i] + h * h / 6 * (a.acceleration.part[i] + b.acceleration.part[i] + c.acceleration.part[i]);
        s->v.part[i] += h / 6 * (a.acceleration.part[i] + 2 * (b.acceleration.part[i] + c.acceleration.part[i]))
                      + h / 6 * d.acceleration.part[i];
    }
    s->voltage += h / 6 * (a.voltage + 2 * (b.voltage + c.voltage)) + h / 6 * d.voltage;
}

static void march(const plant *kept, state *carried, double per_second, long first, long last) {
    plant local = *kept, *p = &local; /* copies, so that the compiler may hold everything in registers */
    state s = *carried;
    double turn = M_PI * p->frequency_hz / per_second, c = cos(turn), si = sin(turn), h = 1.0 / per_second;
    for (long n = first; n < last;) {
        double x = p->amplitude_n * cos(2 * turn * n), y = p->amplitude_n * sin(2 * turn * n);
        long stop = n + RESET < last ? n + RESET : last;
        for (; n < stop; n++) {
            double xm = c * x - si * y, ym = si * x + c * y;
            double xe = c * xm - si * ym, ye = si * xm + c * ym;
            step(p, &s, h, y, ym, ye);
            x = xe;
            y = ye;
        }
    }
    *carried = s;
}

static double mean_power_w(const plant *p, double per_second) {
    state s;
    memset(&s, 0, sizeof s);
    long last = lround(p->duration_s * per_second), window = lround((p->duration_s - p->average_over_s) * per_second);
    march(p, &s, per_second, 0, window);
    s.energy_j = (lanes){0};
    march(p, &s, per_second, window, last);
    return s.energy_j[0] / p->average_over_s;
}

int main(int argc, char **argv) {
    double per_second = argc == 3 ? atof(argv[2]) : 0.0;
    if (!(per_second >= 1.0)) {
        fprintf(stderr, "usage: rk4 PLANT STEPS_PER_SECOND (at least 1)\n");
        return 2;
    }
    plant p = read_plant(argv[1]), warm = p;
    warm.duration_s = warm.average_over_s = 0.05 * p.duration_s;
    volatile double warmed = mean_power_w(&warm, per_second);
    (void)warmed;
    double start = cpu_s(), power = mean_power_w(&p, per_second), taken = cpu_s() - start;
    double evaluations = 4.0 * p.duration_s * per_second;
    if (!isfinite(power)) {
        printf("{\"failed\": \"unstable\"}\n");
        return 0;
    }
    printf("{\"mean_power_w\": %.17g, \"cpu_s\": %.9g, \"evaluations\": %.17g}\n", power, taken, evaluations);
    return 0;
}
