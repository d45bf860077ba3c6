// The arms of dynamics: what the command dynamics of stiffarm-bench wrote of each, and Pinocchio's model of it.
#include <iterator>
#include <sstream>

#include "drive.hpp"

#ifdef PINOCCHIO
#include <pinocchio/multibody.hpp>
namespace pin = pinocchio;
#endif

struct Arm {
    std::string name;
    int n;
    std::string directory;
    std::vector<double> states;
    std::vector<std::vector<double>> links;

    Arm(const std::string &directory, const std::string &name, int n)
        : name(name), n(n), directory(directory), states(read(directory + "/" + name + ".states")) {
        std::ifstream file(directory + "/" + name + ".links");
        for (std::string line; std::getline(file, line);) {
            std::istringstream words(line);
            links.emplace_back(std::istream_iterator<double>(words), std::istream_iterator<double>());
        }
    }
    size_t calls() const { return states.size() / (3 * n); }
    std::vector<double> expected(const std::string &output) const { return read(directory + "/" + name + "." + output); }
};

#ifdef PINOCCHIO
inline pin::Model model_of(const Arm &arm) {
    pin::Model model;
    // Of quarter turns zeros are zeros.
    const auto about_x = [](double angle) -> Eigen::Matrix3d {
        return Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitX()).toRotationMatrix().unaryExpr([](double x) {
            return std::fabs(x - std::round(x)) < 1e-12 ? std::round(x) : x;
        });
    };
    model.gravity.linear() << arm.links[0][0], arm.links[0][1], arm.links[0][2];
    pin::JointIndex parent = 0;
    for (int i = 1; i <= arm.n; ++i) {
        const double *x = arm.links[i].data();
        const pin::SE3 place(about_x(x[3]), Eigen::Vector3d(x[0], x[1], x[2]));
        parent = model.addJoint(parent, pin::JointModelRZ(), place, "joint" + std::to_string(i));
        Eigen::Matrix3d tensor;
        tensor << x[8], x[9], x[10], x[9], x[11], x[12], x[10], x[12], x[13];
        model.appendBodyToJoint(parent, pin::Inertia(x[4], Eigen::Vector3d(x[5], x[6], x[7]), tensor),
                                pin::SE3::Identity());
    }
    return model;
}
#endif
