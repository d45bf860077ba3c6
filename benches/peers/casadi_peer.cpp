#include "drive.hpp"

extern "C" {
int pose(const double **arg, double **res, long long *iw, double *w, int mem);
int jacobian(const double **arg, double **res, long long *iw, double *w, int mem);
}

int main(int, char **argv) {
    static double w[4096];
    static long long iw[256];
    const auto call = [](auto function) {
        return [function](const double *q, double *out) {
            const double *arg[] = {q};
            double *res[] = {out};
            function(arg, res, iw, w, 0);
        };
    };
    drive(argv[1], "casadi", "pose", 12, call(pose));
    drive(argv[1], "casadi", "jacobian", 36, call(jacobian));
}
