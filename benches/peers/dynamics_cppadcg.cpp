// Pinocchio's code generation: its algorithms are run once on CppADCodeGen's numbers, which write down what was computed,
// and that is printed as C. One file, dynamics_cppadcg.c, of a UR10 and a Panda.
//
//   dynamics_cppadcg DIRECTORY
#include <pinocchio/codegen/cppadcg.hpp>

#include <pinocchio/algorithm/aba.hpp>
#include <pinocchio/algorithm/crba.hpp>
#include <pinocchio/algorithm/regressor.hpp>
#include <pinocchio/algorithm/rnea-derivatives.hpp>
#include <pinocchio/algorithm/rnea.hpp>

#include "links.hpp"

namespace {

using Traced = CppAD::cg::CG<double>;
using Number = CppAD::AD<Traced>;
using Vector = Eigen::Matrix<Number, Eigen::Dynamic, 1>;
using Matrix = Eigen::Matrix<Number, Eigen::Dynamic, Eigen::Dynamic>;

// `of` makes a matrix of the joint values, rates, and accelerations or torques.
template <class Of>
void print(std::ofstream &file, const Arm &arm, const char *output, Of of) {
    Vector x = Vector::Zero(3 * arm.n);
    CppAD::Independent(x);
    const Matrix found = of(x.head(arm.n), x.segment(arm.n, arm.n), x.tail(arm.n));
    const Vector y = Eigen::Map<const Vector>(found.data(), found.size());
    CppAD::ADFun<Traced> function(x, y);
    function.optimize();
    CppAD::cg::CodeHandler<double> handler;
    std::vector<Traced> variables(x.size());
    handler.makeVariables(variables);
    std::vector<Traced> results = function.Forward(0, variables);
    CppAD::cg::LanguageC<double> language("double");
    CppAD::cg::LangCDefaultVariableNameGenerator<double> names;
    std::ostringstream body;
    handler.generateCode(body, language, results, names);
    file << "void " << arm.name << "_" << output << "_cppadcg(const double *x, double *y) {\n    double v["
         << handler.getTemporaryVariableCount() + 1 << "];\n"
         << body.str() << "}\n";
}

void all(std::ofstream &file, const Arm &arm) {
    const auto model = model_of(arm).cast<Number>();
    using Data = pin::DataTpl<Number>;
    const int n = arm.n;
    print(file, arm, "inverse_dynamics", [&](const Vector &q, const Vector &v, const Vector &a) -> Matrix {
        Data data(model);
        return pin::rnea(model, data, q, v, a);
    });
    print(file, arm, "bias", [&](const Vector &q, const Vector &v, const Vector &) -> Matrix {
        Data data(model);
        return pin::nonLinearEffects(model, data, q, v);
    });
    print(file, arm, "mass_matrix", [&](const Vector &q, const Vector &, const Vector &) -> Matrix {
        Data data(model);
        pin::crba(model, data, q);
        return Matrix(data.M.template selfadjointView<Eigen::Upper>());
    });
    print(file, arm, "forward_dynamics", [&](const Vector &q, const Vector &v, const Vector &tau) -> Matrix {
        Data data(model);
        return pin::aba(model, data, q, v, tau);
    });
    print(file, arm, "torque_regressor", [&](const Vector &q, const Vector &v, const Vector &a) -> Matrix {
        Data data(model);
        return pin::computeJointTorqueRegressor(model, data, q, v, a);
    });
    print(file, arm, "derivatives", [&](const Vector &q, const Vector &v, const Vector &a) -> Matrix {
        Data data(model);
        Matrix by_q = Matrix::Zero(n, n), by_v = by_q, by_a = by_q, whole(n, 3 * n);
        pin::computeRNEADerivatives(model, data, q, v, a, by_q, by_v, by_a);
        whole << by_q, by_v, Matrix(by_a.template selfadjointView<Eigen::Upper>());
        return whole;
    });
}

}  // namespace

int main(int, char **argv) {
    const std::string directory = argv[1];
    std::ofstream file(directory + "/dynamics_cppadcg.c");
    file << "#include <math.h>\n";
    all(file, Arm(directory, "ur10", 6));
    all(file, Arm(directory, "panda", 7));
    return file.good() ? 0 : 1;
}
