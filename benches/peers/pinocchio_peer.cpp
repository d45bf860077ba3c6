#include <pinocchio/algorithm/frames.hpp>
#include <pinocchio/algorithm/jacobian.hpp>
#include <pinocchio/algorithm/kinematics.hpp>
#include <pinocchio/multibody.hpp>

#include "drive.hpp"

int main(int, char **argv) {
    namespace pin = pinocchio;
    pin::Model model;
    pin::JointIndex parent = 0;
    for (int i = 0; i < 6; ++i) {
        // Rx(alpha) Tx(a), then the turn; the length along z commutes with it.
        const Eigen::Matrix3d twist =
            Eigen::AngleAxisd(TABLE[i][1], Eigen::Vector3d::UnitX()).toRotationMatrix();
        const Eigen::Vector3d offset =
            Eigen::Vector3d(TABLE[i][0], 0, 0) + twist * Eigen::Vector3d(0, 0, TABLE[i][2]);
        parent = model.addJoint(parent, pin::JointModelRZ(), pin::SE3(twist, offset),
                                "j" + std::to_string(i + 1));
    }
    pin::Data data(model);
    const auto vector = [](const double *q) { return Eigen::Map<const Eigen::Matrix<double, 6, 1>>(q); };
    drive(argv[1], "pinocchio", "pose", 12, [&](const double *q, double *out) {
        pin::forwardKinematics(model, data, vector(q));
        const pin::SE3 &pose = data.oMi[6];
        Eigen::Map<Eigen::Matrix3d>{out} = pose.rotation();
        Eigen::Map<Eigen::Vector3d>{out + 9} = pose.translation();
    });
    pin::Data::Matrix6x columns(6, 6);
    drive(argv[1], "pinocchio", "jacobian", 36, [&](const double *q, double *out) {
        pin::computeJointJacobians(model, data, vector(q));
        columns.setZero();
        pin::getJointJacobian(model, data, 6, pin::LOCAL_WORLD_ALIGNED, columns);
        Eigen::Map<Eigen::Matrix<double, 6, 6>>{out} = columns;
    });
}
