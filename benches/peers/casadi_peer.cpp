#include "drive.hpp"

#define OUTPUT(name) int name(const double **arg, double **res, long long *iw, double *w, int mem)
extern "C" {
OUTPUT(pose);
OUTPUT(jacobian);
OUTPUT(complementary_stiffness);
OUTPUT(deflection_first_order);
OUTPUT(compliance);
OUTPUT(deflection);
OUTPUT(all);
}

int main(int, char **argv) {
    static double work[4096];
    static long long iw[256];
    const auto call = [](auto function) {
        return [function](const double *q, const double *w, double *out) {
            const double *arg[] = {q, w};
            double *res[] = {out, out + 12, out + 48, out + 84, out + 90, out + 126};
            function(arg, res, iw, work, 0);
        };
    };
    drive(argv[1], "casadi", "pose", 12, call(pose));
    drive(argv[1], "casadi", "jacobian", 36, call(jacobian));
    drive(argv[1], "casadi", "complementary_stiffness", 36, call(complementary_stiffness));
    drive(argv[1], "casadi", "deflection_first_order", 6, call(deflection_first_order));
    drive(argv[1], "casadi", "compliance", 36, call(compliance));
    drive(argv[1], "casadi", "deflection", 6, call(deflection));
    drive(argv[1], "casadi", "all", 132, call(all));
}
