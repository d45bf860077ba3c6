#!/usr/bin/env python3
"""Writes tests/data/pinocchio/*.json: poses, Jacobians and weights' torques of the URDFs of
tests/data/urdf by Pinocchio (https://github.com/stack-of-tasks/pinocchio), which shares no code
with stiffarm. The tests compare our kernels with these numbers.

    python3 -m venv venv && venv/bin/pip install pin==4.1.0
    venv/bin/python tools/pinocchio_kinematics.py
"""

import numpy
import pinocchio
from fixture import ROOT, write

SAMPLES = 50
# Robot, link at the foot, link at the end.
CHAINS = [
    ("ur5", "base_link_inertia", "tool0"),
    ("kr240", "base_link", "tool0"),
    ("panda", "panda_link0", "panda_link8"),
    ("oblique", "floor", "needle"),
]


def configuration(model, values):
    """Joint values as Pinocchio has them: cosine and sine of a continuous joint."""
    q = pinocchio.neutral(model)
    for joint, value in zip(model.joints[1:], values):
        if joint.nq == 2:
            q[joint.idx_q : joint.idx_q + 2] = [numpy.cos(value), numpy.sin(value)]
        else:
            q[joint.idx_q] = value
    return q


def moving(model, base, tip):
    """The joints between two links, as numbers of velocities."""
    support = list(model.supports[model.frames[model.getFrameId(tip)].parentJoint])
    below = set(model.supports[model.frames[model.getFrameId(base)].parentJoint])
    return [joint for joint in support if joint not in below]


def sample(model, data, base, tip, joints, values):
    whole = numpy.zeros(model.njoints - 1)
    for joint, value in zip(joints, values):
        whole[joint - 1] = value
    q = configuration(model, whole)
    pinocchio.framesForwardKinematics(model, data, q)
    foot = data.oMf[model.getFrameId(base)]
    pose = foot.actInv(data.oMf[model.getFrameId(tip)])
    jacobian = pinocchio.computeFrameJacobian(
        model, data, q, model.getFrameId(tip), pinocchio.ReferenceFrame.LOCAL_WORLD_ALIGNED
    )
    turned = numpy.vstack([foot.rotation.T @ jacobian[:3], foot.rotation.T @ jacobian[3:]])
    columns = [model.joints[joint].idx_v for joint in joints]
    # Torques that hold the weights; ours are those that the weights exert.
    weights = -pinocchio.computeGeneralizedGravity(model, data, q)
    return {
        "q": list(values),
        "position": pose.translation.tolist(),
        "rotation": pose.rotation.tolist(),
        "jacobian": turned[:, columns].tolist(),
        "weight_torque": weights[columns].tolist(),
    }


def main():
    generator = numpy.random.default_rng(20)
    for robot, base, tip in CHAINS:
        model = pinocchio.buildModelFromUrdf(str(ROOT / f"tests/data/urdf/{robot}.urdf"))
        model.gravity.linear = numpy.array([0.0, 0.0, -9.80665])
        joints = moving(model, base, tip)
        # An import leaves out what moves beside the chain.
        for joint in set(range(1, model.njoints)) - set(joints):
            model.inertias[joint] = pinocchio.Inertia.Zero()
        data = model.createData()
        draws = generator.uniform(-1.5, 1.5, (SAMPLES, len(joints)))
        samples = [sample(model, data, base, tip, joints, values) for values in draws]
        head = {"urdf": f"tests/data/urdf/{robot}.urdf", "base": base, "tip": tip}
        write(robot, __file__, head, samples)


if __name__ == "__main__":
    main()
