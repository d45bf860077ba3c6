#include <kdl/chain.hpp>
#include <kdl/chainfksolverpos_recursive.hpp>
#include <kdl/chainjnttojacsolver.hpp>

#include "drive.hpp"

int main(int, char **argv) {
    KDL::Chain chain;
    for (int i = 0; i < 6; ++i) {
        // A segment turns and then moves on to the next joint: the twist and length of the row after.
        const bool last = i == 5;
        const KDL::Frame along(KDL::Vector(0, 0, TABLE[i][2]));
        const KDL::Frame next =
            last ? KDL::Frame::Identity()
                 : KDL::Frame(KDL::Rotation::RotX(TABLE[i + 1][1]), KDL::Vector(TABLE[i + 1][0], 0, 0));
        chain.addSegment(KDL::Segment(KDL::Joint(KDL::Joint::RotZ), along * next));
    }
    KDL::ChainFkSolverPos_recursive forward(chain);
    KDL::ChainJntToJacSolver solver(chain);
    KDL::JntArray joints(6);
    KDL::Jacobian columns(6);
    drive(argv[1], "kdl", "pose", 12, [&](const double *q, const double *, double *out) {
        for (int i = 0; i < 6; ++i) joints(i) = q[i];
        KDL::Frame frame;
        forward.JntToCart(joints, frame);
        for (int c = 0; c < 3; ++c)
            for (int r = 0; r < 3; ++r) out[3 * c + r] = frame.M(r, c);
        for (int r = 0; r < 3; ++r) out[9 + r] = frame.p(r);
    });
    drive(argv[1], "kdl", "jacobian", 36, [&](const double *q, const double *, double *out) {
        for (int i = 0; i < 6; ++i) joints(i) = q[i];
        solver.JntToJac(joints, columns);
        Eigen::Map<Eigen::Matrix<double, 6, 6>>{out} = columns.data;
    });
}
