/* The functions of examples/program as stiffarm and CasADi print them, on the same inputs: compared, then timed in one
 * run, by turns; the median of 41 rounds, ns a call, with stiffarm's own sines and with those of math.h.
 *
 *   python3 benches/peers/program_peer.py DIR
 *   cargo run -p stiffarm-program --example c -- DIR
 *   cd DIR && gcc -O3 -march=native -I. .../benches/peers/program_drive.c kr240.c program_casadi.c -lm -o drive && ./drive
 */
#define _POSIX_C_SOURCE 200809L
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "kr240.h"

int hand_eye(const double **arg, double **res, long long int *iw, double *w, int mem);
int clearance(const double **arg, double **res, long long int *iw, double *w, int mem);

enum { CALLS = 2048, ROUNDS = 41, IN = 26, OUT = 21 };

static double in[CALLS][IN], out[2][CALLS][OUT], work[4096];
static long long int integers[256];

static void eye_by_stiffarm(const double *x, double *y) {
    kr240_hand_eye(x, x + 6, x + 9, x + 13, x + 15, x + 17, x + 20, (kr240_hand_eye_t *)y);
}

static void eye_by_casadi(const double *x, double *y) {
    const double *arg[] = {x, x + 6, x + 9, x + 13, x + 15, x + 17, x + 20};
    double *res[] = {y, y + 2};
    hand_eye(arg, res, integers, work, 0);
}

static void clear_by_stiffarm(const double *x, double *y) {
    kr240_clearance(x, x + 6, x + 22, x[25], (kr240_clearance_t *)(y + 14));
}

static void clear_by_casadi(const double *x, double *y) {
    const double *arg[] = {x, x + 6, x + 22, x + 25};
    double *res[] = {y + 14, y + 15};
    clearance(arg, res, integers, work, 0);
}

static int ascending(const void *a, const void *b) {
    const double difference = *(const double *)a - *(const double *)b;
    return (difference > 0) - (difference < 0);
}

int main(void) {
    void (*const each[4])(const double *, double *) = {eye_by_stiffarm, eye_by_casadi, clear_by_stiffarm,
                                                        clear_by_casadi};
    const char *const names[4] = {"stiffarm hand_eye", "CasADi hand_eye", "stiffarm clearance", "CasADi clearance"};
    double times[4][ROUNDS];
    srand(1);
    for (int k = 0; k < CALLS; k++) {
        for (int i = 0; i < IN; i++) {
            in[k][i] = (i < 6 ? 6.0 : 2.0) * rand() / RAND_MAX - (i < 6 ? 3.0 : 1.0);
        }
        for (int f = 0; f < 4; f++) {
            each[f](in[k], out[f % 2][k]);
        }
        double scale = 0.0;
        for (int i = 0; i < OUT; i++) {
            scale = fmax(scale, fabs(out[1][k][i]));
        }
        for (int i = 0; i < OUT; i++) {
            if (!(fabs(out[0][k][i] - out[1][k][i]) <= 1e-9 * scale)) {
                fprintf(stderr, "call %d, entry %d: %.17g, not %.17g\n", k, i, out[0][k][i], out[1][k][i]);
                return 1;
            }
        }
    }
    for (int round = 0; round < ROUNDS; round++) {
        for (int f = 0; f < 4; f++) {
            struct timespec begin, end;
            clock_gettime(CLOCK_MONOTONIC, &begin);
            for (int k = 0; k < CALLS; k++) {
                each[f](in[k], out[f % 2][k]);
            }
            clock_gettime(CLOCK_MONOTONIC, &end);
            times[f][round] = (1e9 * (double)(end.tv_sec - begin.tv_sec) + (double)(end.tv_nsec - begin.tv_nsec)) / CALLS;
        }
    }
    for (int f = 0; f < 4; f++) {
        qsort(times[f], ROUNDS, sizeof times[f][0], ascending);
        printf("%s %.1f\n", names[f], times[f][ROUNDS / 2]);
    }
    return 0;
}
