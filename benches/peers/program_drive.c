/* The functions of examples/program as stiffarm and its peers print them, on the same inputs: compared, then timed in one
 * run, by turns; the median of 41 rounds, ns a call, and how many times stiffarm's it is, the least, the median and the
 * most over the rounds. The processor's time is taken, which other programs do not disturb as much. stiffarm has its own sines, the others those of math.h. The peers are chosen by CASADI, SYMFORCE
 * and WRENFOLD; benches/peers/run.sh has the commands.
 */
#define _POSIX_C_SOURCE 200809L
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "kr240.h"

#ifdef CASADI
int hand_eye(const double **arg, double **res, long long int *iw, double *w, int mem);
int clearance(const double **arg, double **res, long long int *iw, double *w, int mem);
#endif
#ifdef SYMFORCE
void hand_eye_symforce(const double *x, double *y);
void clearance_symforce(const double *x, double *y);
#endif
#ifdef WRENFOLD
void hand_eye_wrenfold(const double *x, double *y);
void clearance_wrenfold(const double *x, double *y);
#endif

enum { CALLS = 2048, ROUNDS = 41, IN = 22, OUT = 14 };

static double in[CALLS][IN], wanted[CALLS][OUT], out[OUT];

static void eye_by_stiffarm(const double *x, double *y) {
    kr240_hand_eye(x, x + 6, x + 9, x + 13, x + 15, x + 17, x + 20, (kr240_hand_eye_t *)y);
}

static void clear_by_stiffarm(const double *x, double *y) {
    kr240_clearance(x, x + 6, x + 9, x[12], (kr240_clearance_t *)y);
}

#ifdef CASADI
static double work[4096];
static long long int integers[256];

static void eye_by_casadi(const double *x, double *y) {
    const double *arg[] = {x, x + 6, x + 9, x + 13, x + 15, x + 17, x + 20};
    double *res[] = {y, y + 2};
    hand_eye(arg, res, integers, work, 0);
}

static void clear_by_casadi(const double *x, double *y) {
    const double *arg[] = {x, x + 6, x + 9, x + 12};
    double *res[] = {y, y + 1};
    clearance(arg, res, integers, work, 0);
}
#endif

/* The first of each function is the one that the others are compared with. */
static const struct {
    const char *name;
    void (*run)(const double *, double *);
    int results;
} WAYS[] = {
    {"hand-eye, stiffarm", eye_by_stiffarm, 14},
#ifdef CASADI
    {"hand-eye, CasADi", eye_by_casadi, 14},
#endif
#ifdef SYMFORCE
    {"hand-eye, SymForce", hand_eye_symforce, 14},
#endif
#ifdef WRENFOLD
    {"hand-eye, wrenfold", hand_eye_wrenfold, 14},
#endif
    {"clearance, stiffarm", clear_by_stiffarm, 7},
#ifdef CASADI
    {"clearance, CasADi", clear_by_casadi, 7},
#endif
#ifdef SYMFORCE
    {"clearance, SymForce", clearance_symforce, 7},
#endif
#ifdef WRENFOLD
    {"clearance, wrenfold", clearance_wrenfold, 7},
#endif
};

enum { COUNT = sizeof WAYS / sizeof WAYS[0] };

static int ascending(const void *a, const void *b) {
    const double difference = *(const double *)a - *(const double *)b;
    return (difference > 0) - (difference < 0);
}

int main(void) {
    static double times[COUNT][ROUNDS], ratios[ROUNDS];
    srand(1);
    for (int k = 0; k < CALLS; k++) {
        for (int i = 0; i < IN; i++) {
            in[k][i] = (i < 6 ? 6.0 : 2.0) * rand() / RAND_MAX - (i < 6 ? 3.0 : 1.0);
        }
    }
    for (int f = 0, first = 0; f < COUNT; f++) {
        first = WAYS[f].results == WAYS[first].results ? first : f;
        for (int k = 0; k < CALLS; k++) {
            double scale = 0.0;
            WAYS[f].run(in[k], f == first ? wanted[k] : out);
            for (int i = 0; i < WAYS[f].results; i++) {
                scale = fmax(scale, fabs(wanted[k][i]));
            }
            for (int i = 0; f != first && i < WAYS[f].results; i++) {
                if (!(fabs(out[i] - wanted[k][i]) <= 1e-9 * scale)) {
                    fprintf(stderr, "%s, call %d, entry %d: %.17g, not %.17g\n", WAYS[f].name, k, i, out[i], wanted[k][i]);
                    return 1;
                }
            }
        }
    }
    for (int round = 0; round < ROUNDS; round++) {
        for (int f = 0; f < COUNT; f++) {
            struct timespec begin, end;
            clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &begin);
            for (int k = 0; k < CALLS; k++) {
                WAYS[f].run(in[k], wanted[k]);
            }
            clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &end);
            times[f][round] = (1e9 * (double)(end.tv_sec - begin.tv_sec) + (double)(end.tv_nsec - begin.tv_nsec)) / CALLS;
        }
    }
    /* The last first: a function's own times stay in their order until all of its peers have been told. */
    for (int f = COUNT - 1; f >= 0; f--) {
        int first = 0;
        while (WAYS[first].results != WAYS[f].results) {
            first++;
        }
        for (int round = 0; round < ROUNDS; round++) {
            ratios[round] = times[f][round] / times[first][round];
        }
        qsort(times[f], ROUNDS, sizeof times[f][0], ascending);
        qsort(ratios, ROUNDS, sizeof ratios[0], ascending);
        printf("%s %.1f (%.2f %.2f %.2f)\n", WAYS[f].name, times[f][ROUNDS / 2], ratios[0], ratios[ROUNDS / 2],
               ratios[ROUNDS - 1]);
    }
    return 0;
}
