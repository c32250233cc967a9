/* The modal plant in vectors: its parameter file, its right-hand side, the clock. Shared by the compiled peers.
 *
 *   q_i'' = -2 zeta_i w_i q_i' - w_i^2 q_i + coupling_i V + tip_i F_c + table_i F sin(2 pi f t)
 *   V'    = -V / (R C) - sum_i coupling_i q_i' / C
 *   F_c   = -k max(0, sum_i tip_i q_i - gap)^1.5
 *
 * Four modes to a vector, VECTORS vectors (set by -D); modes that only pad are zero. The voltage stands in every lane
 * and sums leave their result in every lane, which shortens the chain from stage to stage; vectors of eight were slower
 * for that reason.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#ifndef VECTORS
#define VECTORS 2
#endif
#define LANES 4
#define INLINE static inline __attribute__((always_inline))

typedef double lanes __attribute__((vector_size(8 * LANES)));
typedef struct { lanes part[VECTORS]; } modal;

typedef struct {
    modal stiffness, damping, tip, table, coupling, coupling_per_c;
    double leak, gap_m, contact, amplitude_n, frequency_hz, resistance_ohm, duration_s, average_over_s;
    int modes;
} plant;

typedef struct { modal acceleration; lanes voltage; } rates;

INLINE lanes sum(lanes x) {
    x += __builtin_shufflevector(x, x, 2, 3, 0, 1);
    return x + __builtin_shufflevector(x, x, 1, 0, 3, 2);
}

INLINE lanes dot(const modal *a, const modal *b) {
    lanes total = a->part[0] * b->part[0];
    for (int i = 1; i < VECTORS; i++) total += a->part[i] * b->part[i];
    return sum(total);
}

INLINE modal along(const modal *x, double h, const modal *rate) {
    modal y;
    for (int i = 0; i < VECTORS; i++) y.part[i] = x->part[i] + h * rate->part[i];
    return y;
}

INLINE rates right_hand_side(const plant *p, const modal *q, const modal *v, lanes voltage, double force_n) {
    rates r;
    r.voltage = -p->leak * voltage - dot(&p->coupling_per_c, v);
    for (int i = 0; i < VECTORS; i++)
        r.acceleration.part[i] = p->table.part[i] * force_n - p->stiffness.part[i] * q->part[i]
                               - p->damping.part[i] * v->part[i] + p->coupling.part[i] * voltage;
    double depth = dot(&p->tip, q)[0] - p->gap_m;
    if (__builtin_expect(depth > 0.0, 0)) {
        double push = -p->contact * depth * sqrt(depth);
        for (int i = 0; i < VECTORS; i++) r.acceleration.part[i] += p->tip.part[i] * push;
    }
    return r;
}

static int modes_of(FILE *file) {
    int count;
    if (fscanf(file, " modes %d", &count) != 1 || count < 1 || count > LANES * VECTORS) {
        fprintf(stderr, "peer: the plant must have 1 to %d modes\n", LANES * VECTORS);
        exit(4);
    }
    return count;
}

static void read_row(FILE *file, const char *name, int count, double *row) {
    char key[64];
    int ok = fscanf(file, " %63s", key) == 1 && strcmp(key, name) == 0;
    for (int i = 0; i < count && ok; i++) ok = fscanf(file, " %lf", row + i) == 1;
    if (!ok) {
        fprintf(stderr, "peer: the plant file lacks '%s' with %d numbers at its place\n", name, count);
        exit(4);
    }
}

static plant read_plant(const char *path) {
    static plant p;
    double frequency[LANES * VECTORS], ratio[LANES * VECTORS], capacitance;
    FILE *file = fopen(path, "r");
    if (!file) {
        fprintf(stderr, "peer: cannot open %s\n", path);
        exit(4);
    }
    int count = p.modes = modes_of(file);
    read_row(file, "frequency_hz", count, frequency);
    read_row(file, "damping_ratio", count, ratio);
    read_row(file, "table", count, (double *)&p.table);
    read_row(file, "tip", count, (double *)&p.tip);
    read_row(file, "coupling_n_per_v", count, (double *)&p.coupling);
    read_row(file, "capacitance_f", 1, &capacitance);
    read_row(file, "resistance_ohm", 1, &p.resistance_ohm);
    read_row(file, "gap_m", 1, &p.gap_m);
    read_row(file, "contact_n_per_m15", 1, &p.contact);
    read_row(file, "amplitude_n", 1, &p.amplitude_n);
    read_row(file, "frequency_drive_hz", 1, &p.frequency_hz);
    read_row(file, "duration_s", 1, &p.duration_s);
    read_row(file, "average_over_s", 1, &p.average_over_s);
    fclose(file);
    p.leak = 1.0 / (p.resistance_ohm * capacitance);
    for (int i = 0; i < count; i++) {
        double w = 2 * M_PI * frequency[i];
        ((double *)&p.stiffness)[i] = w * w;
        ((double *)&p.damping)[i] = 2 * ratio[i] * w;
        ((double *)&p.coupling_per_c)[i] = ((double *)&p.coupling)[i] / capacitance;
    }
    return p;
}

static double cpu_s(void) {
    struct timespec now;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return now.tv_sec + 1e-9 * now.tv_nsec;
}
