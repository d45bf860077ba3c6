// The equations of motion of a UR10 and a Panda by stiffarm's C, CasADi's C, Pinocchio and the C that CppADCodeGen prints
// of Pinocchio: each result compared with the textbook's, then timed by turns, all of them in each of 41 rounds. Prints the median nanoseconds a call and, of
// the peers, how many times stiffarm's that is: the least, the median and the most over the rounds.
//
//   dynamics DIRECTORY
#include <functional>

#include "links.hpp"

extern "C" {
#include "panda.h"
#include "ur10.h"
#ifdef CASADI
#define CASADI_FUNCTION(name) int name(const double **, double **, long long *, double *, int);
#define CASADI_ARM(arm)                                                                                        \
    CASADI_FUNCTION(arm##_inverse_dynamics_casadi)                                                             \
    CASADI_FUNCTION(arm##_bias_casadi)                                                                         \
    CASADI_FUNCTION(arm##_mass_matrix_casadi)                                                                  \
    CASADI_FUNCTION(arm##_torque_regressor_casadi)                                                             \
    CASADI_FUNCTION(arm##_derivatives_casadi)
CASADI_ARM(ur10)
CASADI_ARM(panda)
#endif
#ifdef CPPADCG
#define CPPADCG_FUNCTION(name) void name(const double *, double *);
#define CPPADCG_ARM(arm)                                                                                       \
    CPPADCG_FUNCTION(arm##_inverse_dynamics_cppadcg)                                                           \
    CPPADCG_FUNCTION(arm##_bias_cppadcg)                                                                       \
    CPPADCG_FUNCTION(arm##_mass_matrix_cppadcg)                                                                \
    CPPADCG_FUNCTION(arm##_forward_dynamics_cppadcg)                                                           \
    CPPADCG_FUNCTION(arm##_torque_regressor_cppadcg)                                                           \
    CPPADCG_FUNCTION(arm##_derivatives_cppadcg)
CPPADCG_ARM(ur10)
CPPADCG_ARM(panda)
#endif
}

#ifdef PINOCCHIO
#include <pinocchio/algorithm/aba.hpp>
#include <pinocchio/algorithm/crba.hpp>
#include <pinocchio/algorithm/regressor.hpp>
#include <pinocchio/algorithm/rnea-derivatives.hpp>
#include <pinocchio/algorithm/rnea.hpp>
#endif

namespace {

constexpr int ROUNDS = 41;

// One way to an output: works through all states, and its time in each round.
struct Way {
    std::string peer;
    std::function<void()> run;
    std::vector<double> times;
};

// `call(state, out)` writes one result of `size` numbers. What is compared with the textbook's `expected` is what
// `shown` makes of it.
template <class Call, class Shown>
Way way(const Arm &arm, const char *output, const char *peer, size_t size, const std::vector<double> &expected,
        Call call, Shown shown) {
    double scale = 0;
    for (double x : expected) scale = std::max(scale, std::fabs(x));
    std::vector<double> one(size);
    const size_t entries = expected.size() / arm.calls();
    for (size_t i = 0; i < arm.calls(); ++i) {
        call(&arm.states[3 * arm.n * i], one.data());
        const std::vector<double> found = shown(one);
        for (size_t k = 0; k < entries; ++k) {
            const double wanted = expected[entries * i + k];
            // The condition of a mass matrix, some 10^3, times rounding.
            if (!(std::fabs(found[k] - wanted) <= 1e-11 * scale)) {
                std::fprintf(stderr, "%s %s %s: entry %zu of call %zu is %.17g, not %.17g\n", peer, arm.name.c_str(),
                             output, k, i, found[k], wanted);
                std::exit(1);
            }
        }
    }
    // The results of 64 states are written over and over, so that they stay in the first cache.
    auto run = [&arm, size, call, out = std::vector<double>(64 * size)]() mutable {
        for (size_t i = 0; i < arm.calls(); ++i) {
            call(&arm.states[3 * arm.n * i], &out[size * (i % 64)]);
            if (i % 64 == 63) asm volatile("" : : "r"(out.data()) : "memory");
        }
    };
    return {peer, run, {}};
}

const auto as_it_is = [](const std::vector<double> &found) { return found; };

void compete(const Arm &arm, const char *output, std::vector<Way> ways) {
    for (int round = 0; round <= ROUNDS; ++round) {
        for (Way &way : ways) {
            const double start = processor_time();
            way.run();
            const double time = processor_time() - start;
            // The first round warms up.
            if (round > 0) way.times.push_back(time / static_cast<double>(arm.calls()));
        }
    }
    std::printf("%s %s: %s %.1f", arm.name.c_str(), output, ways[0].peer.c_str(), median(ways[0].times));
    for (size_t k = 1; k < ways.size(); ++k) {
        std::vector<double> ratios;
        for (int round = 0; round < ROUNDS; ++round) ratios.push_back(ways[k].times[round] / ways[0].times[round]);
        const auto [least, most] = std::minmax_element(ratios.begin(), ratios.end());
        std::printf(", %s %.1f (%.2f %.2f %.2f)", ways[k].peer.c_str(), median(ways[k].times), *least,
                    median(ratios), *most);
    }
    std::printf("\n");
}

template <int N, class Kernels>
void all(const Arm &arm, const Kernels &kernels) {
    constexpr int COUNT = 6;
    const char *const names[COUNT] = {"inverse_dynamics", "bias", "mass_matrix", "forward_dynamics",
                                      "torque_regressor", "derivatives"};
    const size_t sizes[COUNT] = {N, N, N * N, N, 10 * N * N, 3 * N * N};
    std::vector<Way> ways[COUNT];
    std::vector<double> expected[COUNT];
    for (int k = 0; k < 5; ++k) expected[k] = arm.expected(names[k]);
    // By values, rates and accelerations: the last is the mass matrix.
    const std::vector<double> by[] = {arm.expected("inverse_dynamics_by_joints"),
                                      arm.expected("inverse_dynamics_by_rates"), expected[2]};
    for (size_t call = 0; call < arm.calls(); ++call)
        for (const auto &matrix : by)
            expected[5].insert(expected[5].end(), &matrix[N * N * call], &matrix[N * N * call] + N * N);
    const auto ours = [&](int k, auto call) {
        ways[k].push_back(way(arm, names[k], "stiffarm", sizes[k], expected[k], call, as_it_is));
    };
    ours(0, [=](const double *x, double *out) { kernels.inverse_dynamics(x, x + N, x + 2 * N, out); });
    ours(1, [=](const double *x, double *out) { kernels.bias(x, x + N, out); });
    ours(2, [=](const double *x, double *out) { kernels.mass_matrix(x, out); });
    ours(3, [=](const double *x, double *out) { (void)kernels.forward_dynamics(x, x + N, x + 2 * N, out); });
    ours(4, [=](const double *x, double *out) { kernels.torque_regressor(x, x + N, x + 2 * N, out); });

    ours(5, [=](const double *x, double *out) { kernels.derivatives(x, out); });

    // A peer's joint frames need not be the rows': its regressor is right if its product with the moments is.
    std::vector<double> moments;
    for (int i = 1; i <= N; ++i) {
        const double *x = arm.links[i].data(), m = x[4], cx = x[5], cy = x[6], cz = x[7];
        moments.insert(moments.end(),
                       {m, m * cx, m * cy, m * cz, x[8] + m * (cy * cy + cz * cz), x[9] - m * cx * cy,
                        x[11] + m * (cx * cx + cz * cz), x[10] - m * cx * cz, x[12] - m * cy * cz,
                        x[13] + m * (cx * cx + cy * cy)});
    }
    const auto product = [=](const std::vector<double> &regressor) {
        std::vector<double> torque(N, 0.0);
        for (size_t k = 0; k < regressor.size(); ++k) torque[k % N] += regressor[k] * moments[k / N];
        return torque;
    };
#ifdef CASADI
    const auto casadi = [&](int k, auto function) {
        const auto call = [function](const double *x, double *out) {
            static double work[65536];
            static long long integers[256];
            const double *arg[] = {x};
            double *res[] = {out};
            function(arg, res, integers, work, 0);
        };
        if (k == 4) {
            ways[k].push_back(way(arm, names[k], "casadi", sizes[k], expected[0], call, product));
        } else {
            ways[k].push_back(way(arm, names[k], "casadi", sizes[k], expected[k], call, as_it_is));
        }
    };
    casadi(0, kernels.casadi_inverse_dynamics);
    casadi(1, kernels.casadi_bias);
    casadi(2, kernels.casadi_mass_matrix);
    casadi(4, kernels.casadi_torque_regressor);
    casadi(5, kernels.casadi_derivatives);
#endif
#ifdef PINOCCHIO
    const pin::Model model = model_of(arm);
    pin::Data data(model);
    const auto vector = [](const double *x) { return Eigen::Map<const Eigen::VectorXd>(x, N); };
    const auto at = [](double *out, int columns = 1) { return Eigen::Map<Eigen::MatrixXd>(out, N, columns); };
    const auto pinocchio = [&](int k, auto call, auto shown) {
        const std::vector<double> &textbook = expected[k == 4 ? 0 : k];
        ways[k].push_back(way(arm, names[k], "pinocchio", sizes[k], textbook, call, shown));
    };
    pinocchio(0, [&](const double *x, double *out) {
        at(out) = pin::rnea(model, data, vector(x), vector(x + N), vector(x + 2 * N));
    }, as_it_is);
    pinocchio(1, [&](const double *x, double *out) {
        at(out) = pin::nonLinearEffects(model, data, vector(x), vector(x + N));
    }, as_it_is);
    // Only its upper triangle is the mass matrix.
    pinocchio(2, [&](const double *x, double *out) {
        at(out, N) = pin::crba(model, data, vector(x));
    }, [](const std::vector<double> &found) {
        std::vector<double> whole(found);
        for (int i = 0; i < N; ++i)
            for (int j = 0; j < i; ++j) whole[N * j + i] = found[N * i + j];
        return whole;
    });
    pinocchio(3, [&](const double *x, double *out) {
        at(out) = pin::aba(model, data, vector(x), vector(x + N), vector(x + 2 * N));
    }, as_it_is);
    pinocchio(4, [&](const double *x, double *out) {
        at(out, 10 * N) =
            pin::computeJointTorqueRegressor(model, data, vector(x), vector(x + N), vector(x + 2 * N));
    }, product);
    // Of the mass matrix, too, the upper triangle alone.
    pinocchio(5, [&](const double *x, double *out) {
        pin::computeRNEADerivatives(model, data, vector(x), vector(x + N), vector(x + 2 * N), at(out, N),
                                    at(out + N * N, N), at(out + 2 * N * N, N));
    }, [](const std::vector<double> &found) {
        std::vector<double> whole(found);
        double *mass = &whole[2 * N * N];
        for (int i = 0; i < N; ++i)
            for (int j = 0; j < i; ++j) mass[N * j + i] = mass[N * i + j];
        return whole;
    });
#endif
#ifdef CPPADCG
    for (int k = 0; k < COUNT; ++k) {
        const auto call = kernels.cppadcg[k];
        if (k == 4) {
            ways[k].push_back(way(arm, names[k], "pinocchio+cppadcg", sizes[k], expected[0], call, product));
        } else {
            ways[k].push_back(way(arm, names[k], "pinocchio+cppadcg", sizes[k], expected[k], call, as_it_is));
        }
    }
#endif
    for (int k = 0; k < COUNT; ++k) compete(arm, names[k], std::move(ways[k]));
}

#ifdef CASADI
#define CASADI_KERNELS(arm)                                                                                     \
    decltype(&arm##_inverse_dynamics_casadi) casadi_inverse_dynamics = arm##_inverse_dynamics_casadi;           \
    decltype(&arm##_bias_casadi) casadi_bias = arm##_bias_casadi;                                               \
    decltype(&arm##_mass_matrix_casadi) casadi_mass_matrix = arm##_mass_matrix_casadi;                          \
    decltype(&arm##_torque_regressor_casadi) casadi_torque_regressor = arm##_torque_regressor_casadi;           \
    decltype(&arm##_derivatives_casadi) casadi_derivatives = arm##_derivatives_casadi;
#else
#define CASADI_KERNELS(arm)
#endif
#ifdef CPPADCG
#define CPPADCG_KERNELS(arm)                                                                                    \
    void (*cppadcg[6])(const double *, double *) = {                                                            \
        arm##_inverse_dynamics_cppadcg, arm##_bias_cppadcg,             arm##_mass_matrix_cppadcg,              \
        arm##_forward_dynamics_cppadcg, arm##_torque_regressor_cppadcg, arm##_derivatives_cppadcg};
#else
#define CPPADCG_KERNELS(arm)
#endif
#define KERNELS(arm, joints)                                                                                    \
    struct {                                                                                                    \
        decltype(&arm##_inverse_dynamics) inverse_dynamics = arm##_inverse_dynamics;                            \
        decltype(&arm##_bias) bias = arm##_bias;                                                                \
        decltype(&arm##_mass_matrix) mass_matrix = arm##_mass_matrix;                                           \
        decltype(&arm##_forward_dynamics) forward_dynamics = arm##_forward_dynamics;                            \
        decltype(&arm##_torque_regressor) torque_regressor = arm##_torque_regressor;                            \
        static void derivatives(const double *x, double *out) {                                                 \
            arm##_torque_derivatives(x, x + joints, x + 2 * joints, (arm##_torque_derivatives_t *)out);         \
        }                                                                                                       \
        CASADI_KERNELS(arm)                                                                                     \
        CPPADCG_KERNELS(arm)                                                                                    \
    } arm##_kernels;

}  // namespace

int main(int, char **argv) {
    KERNELS(ur10, UR10_JOINTS)
    KERNELS(panda, PANDA_JOINTS)
    all<6>(Arm(argv[1], "ur10", 6), ur10_kernels);
    all<7>(Arm(argv[1], "panda", 7), panda_kernels);
    return 0;
}
