#include <pinocchio/algorithm/frames.hpp>
#include <pinocchio/algorithm/jacobian.hpp>
#include <pinocchio/algorithm/kinematics-derivatives.hpp>
#include <pinocchio/algorithm/kinematics.hpp>
#include <pinocchio/multibody.hpp>

#include "drive.hpp"

namespace pin = pinocchio;
using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

// K_C by the axis formula, from the columns of the Jacobian.
static Matrix6 by_axes(const Matrix6 &j, const Vector6 &w) {
    Matrix6 out;
    const Eigen::Vector3d f = w.head<3>(), m = w.tail<3>();
    for (int i = 0; i < 6; ++i) {
        const Eigen::Vector3d v = j.col(i).head<3>(), z = j.col(i).tail<3>();
        const Eigen::Vector3d fz = f.cross(z), mz = m.cross(z), vf = v.cross(f);
        for (int k = 0; k < 6; ++k) {
            out(k, i) = i <= k ? fz.dot(j.col(k).head<3>()) + mz.dot(j.col(k).tail<3>())
                               : vf.dot(j.col(k).tail<3>());
        }
    }
    return out;
}

int main(int, char **argv) {
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
    const auto vector = [](const double *q) { return Eigen::Map<const Vector6>(q); };
    const auto write_pose = [&](double *out) {
        const pin::SE3 &pose = data.oMi[6];
        Eigen::Map<Eigen::Matrix3d>{out} = pose.rotation();
        Eigen::Map<Eigen::Vector3d>{out + 9} = pose.translation();
    };
    pin::Data::Matrix6x columns(6, 6);
    const auto jacobian = [&](const double *q) -> Matrix6 {
        pin::computeJointJacobians(model, data, vector(q));
        columns.setZero();
        pin::getJointJacobian(model, data, 6, pin::LOCAL_WORLD_ALIGNED, columns);
        return columns;
    };
    Vector6 soft;
    for (int i = 0; i < 6; ++i) soft[i] = 1 / STIFFNESS[i];
    drive(argv[1], "pinocchio", "pose", 12, [&](const double *q, const double *, double *out) {
        pin::forwardKinematics(model, data, vector(q));
        write_pose(out);
    });
    drive(argv[1], "pinocchio", "jacobian", 36, [&](const double *q, const double *, double *out) {
        Eigen::Map<Matrix6>{out} = jacobian(q);
    });
    // By Pinocchio's own second derivatives, and by the axis formula, which costs less.
    const auto by_hessian = [&](const double *q, const double *w) -> Matrix6 {
        pin::computeJointKinematicHessians(model, data, vector(q));
        const auto hessian = pin::getJointKinematicHessian(model, data, 6, pin::LOCAL_WORLD_ALIGNED);
        Matrix6 out = Matrix6::Zero();
        for (int i = 0; i < 6; ++i)
            for (int k = 0; k < 6; ++k)
                for (int r = 0; r < 6; ++r) out(k, i) += w[r] * hessian(r, k, i);
        return out;
    };
    const auto turns = [](const Matrix6 &k_c, const Vector6 &torque) -> Vector6 {
        Matrix6 a = -k_c;
        for (int i = 0; i < 6; ++i) a(i, i) += STIFFNESS[i];
        return a.partialPivLu().solve(torque);
    };
    drive(argv[1], "pinocchio", "complementary_stiffness", 36,
          [&](const double *q, const double *w, double *out) {
              Eigen::Map<Matrix6>{out} = by_hessian(q, w);
          });
    drive(argv[1], "pinocchio+axes", "complementary_stiffness", 36,
          [&](const double *q, const double *w, double *out) {
              Eigen::Map<Matrix6>{out} = by_axes(jacobian(q), vector(w));
          });
    drive(argv[1], "pinocchio", "deflection_first_order", 6,
          [&](const double *q, const double *w, double *out) {
              const Matrix6 j = jacobian(q);
              const Vector6 torque = j.transpose() * vector(w);
              Eigen::Map<Vector6>{out} = j * soft.cwiseProduct(torque);
          });
    drive(argv[1], "pinocchio", "compliance", 36, [&](const double *q, const double *, double *out) {
        const Matrix6 j = jacobian(q);
        Eigen::Map<Matrix6>{out}.noalias() = j * soft.asDiagonal() * j.transpose();
    });
    const auto deflection = [&](const Matrix6 &j, const Matrix6 &k_c, const double *w) -> Vector6 {
        return j * turns(k_c, j.transpose() * vector(w));
    };
    drive(argv[1], "pinocchio", "deflection", 6, [&](const double *q, const double *w, double *out) {
        const Matrix6 j = jacobian(q);
        Eigen::Map<Vector6>{out} = deflection(j, by_hessian(q, w), w);
    });
    drive(argv[1], "pinocchio+axes", "deflection", 6,
          [&](const double *q, const double *w, double *out) {
              const Matrix6 j = jacobian(q);
              Eigen::Map<Vector6>{out} = deflection(j, by_axes(j, vector(w)), w);
          });
    const auto all = [&](const Matrix6 &j, const Matrix6 &k_c, const double *w, double *out) {
        write_pose(out);
        Eigen::Map<Matrix6>{out + 12} = j;
        Eigen::Map<Matrix6>{out + 48} = k_c;
        const Vector6 torque = j.transpose() * vector(w);
        Eigen::Map<Vector6>{out + 84} = torque;
        Eigen::Map<Matrix6>{out + 90}.noalias() = j * soft.asDiagonal() * j.transpose();
        Eigen::Map<Vector6>{out + 126} = j * turns(k_c, torque);
    };
    drive(argv[1], "pinocchio", "all", 132, [&](const double *q, const double *w, double *out) {
        const Matrix6 j = jacobian(q);
        all(j, by_hessian(q, w), w, out);
    });
    drive(argv[1], "pinocchio+axes", "all", 132, [&](const double *q, const double *w, double *out) {
        const Matrix6 j = jacobian(q);
        all(j, by_axes(j, vector(w)), w, out);
    });
}
