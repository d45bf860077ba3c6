#!/usr/bin/env python3
"""Writes tests/data/pinocchio/dynamics/*.json: the equations of motion of arms by Pinocchio
(https://github.com/stack-of-tasks/pinocchio), which shares no code with stiffarm. The tests compare the textbook and
the generated graphs with these numbers.

    python3 -m venv venv && venv/bin/pip install pin==4.1.0
    venv/bin/python tools/pinocchio_dynamics.py

The arms are those of robots/arms. Of links whose moments of inertia nobody published some body is drawn; so are the
rotors. What was drawn stands in the file beside the numbers.
"""

import tomllib

import numpy
import pinocchio
from fixture import ROOT, write
from pinocchio import SE3, Inertia

SAMPLES = 20
ARMS = ["panda", "ur10", "kuka_kr240", "iiwa14", "stanford", "puma560"]


def number(value):
    """A cell: a number, a multiple of pi, or a number with a unit."""
    if not isinstance(value, str):
        return float(value)
    words = value.split()
    units = {"mm": 1e-3, "deg": numpy.pi / 180.0}
    if len(words) == 2:
        return float(words[0]) * units[words[1]]
    return float(eval(value, {"pi": numpy.pi}))  # noqa: S307 - files of this repository


def turn(axis, angle):
    return SE3(pinocchio.AngleAxis(angle, axis).matrix(), numpy.zeros(3))


def move(x, y, z):
    return SE3(numpy.eye(3), numpy.array([x, y, z]))


X, Z = numpy.array([1.0, 0.0, 0.0]), numpy.array([0.0, 0.0, 1.0])


def drawn(generator):
    """Second moments of mass along three directions, as a tensor of inertia."""
    spread = generator.uniform(-0.2, 0.2, (3, 3))
    moments = spread @ spread.T
    return numpy.trace(moments) * numpy.eye(3) - moments


def complete(robot, generator):
    """The links' numbers, those that the file lacks drawn: mass, com, six moments; and the rotors."""
    links = []
    for joint in robot["joint"]:
        if "inertia" in joint:
            moments = [number(x) for x in joint["inertia"]]
        else:
            i = drawn(generator)
            moments = [i[0, 0], i[0, 1], i[0, 2], i[1, 1], i[1, 2], i[2, 2]]
        com = joint.get("com", generator.uniform(-0.2, 0.2, 3).tolist())
        links.append(
            {
                "mass": number(joint.get("mass", float(generator.uniform(1.0, 20.0)))),
                "com": [number(x) for x in com],
                "inertia": [float(x) for x in moments],
                "gear": float(generator.uniform(1.0, 100.0)),
                "rotor_inertia": float(generator.uniform(0.0, 1e-3)),
            }
        )
    return links


def model_of(robot, links):
    model = pinocchio.Model()
    gravity = robot.get("gravity", [0.0, 0.0, -9.80665])
    model.gravity.linear = numpy.array([number(g) for g in gravity])
    parent, behind = 0, SE3.Identity()
    standard = robot["convention"] == "standard"
    for k, (joint, link) in enumerate(zip(robot["joint"], links)):
        cell = {key: number(joint.get(key, 0.0)) for key in ("theta", "d", "a", "alpha")}
        lean = move(cell["a"], 0.0, 0.0) * turn(X, cell["alpha"])
        about = turn(Z, cell["theta"]) * move(0.0, 0.0, cell["d"])
        before = behind * about if standard else behind * lean * about
        kind = pinocchio.JointModelRZ if joint["type"] == "revolute" else pinocchio.JointModelPZ
        parent = model.addJoint(parent, kind(), before, f"joint_{k + 1}")
        xx, xy, xz, yy, yz, zz = link["inertia"]
        tensor = numpy.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
        body = Inertia(link["mass"], numpy.array(link["com"]), tensor)
        # The row's frame from the joint's, which moves with the link.
        model.appendBodyToJoint(parent, body, lean if standard else SE3.Identity())
        behind = lean if standard else SE3.Identity()
    armature = [link["gear"] ** 2 * link["rotor_inertia"] for link in links]
    model.armature = numpy.array(armature)
    return model


def sample(model, data, generator, regressor):
    q, v, a = (generator.uniform(-2.0, 2.0, model.nv) for _ in range(3))
    tau = generator.uniform(-50.0, 50.0, model.nv)
    torque = pinocchio.rnea(model, data, q, v, a)
    by_joints, by_rates, _ = pinocchio.computeRNEADerivatives(model, data, q, v, a)
    by_joints, by_rates = by_joints.copy(), by_rates.copy()
    mass = pinocchio.crba(model, data, q)
    mass = numpy.triu(mass) + numpy.triu(mass, 1).T
    found = {
        "q": q.tolist(),
        "qd": v.tolist(),
        "qdd": a.tolist(),
        "tau": tau.tolist(),
        "inverse_dynamics": torque.tolist(),
        "bias": pinocchio.nonLinearEffects(model, data, q, v).tolist(),
        "mass_matrix": mass.T.flatten().tolist(),
        "inverse_dynamics_by_joints": by_joints.T.flatten().tolist(),
        "inverse_dynamics_by_rates": by_rates.T.flatten().tolist(),
        "forward_dynamics": pinocchio.aba(model, data, q, v, tau).tolist(),
    }
    if regressor:
        columns = pinocchio.computeJointTorqueRegressor(model, data, q, v, a)
        found["torque_regressor"] = columns.T.flatten().tolist()
    return found


def main():
    generator = numpy.random.default_rng(21)
    for arm in ARMS:
        robot = tomllib.loads((ROOT / f"robots/arms/{arm}.toml").read_text())
        links = complete(robot, generator)
        model = model_of(robot, links)
        data = model.createData()
        # A row's frame is its joint's in the modified convention alone; two regressors are enough to read.
        modified = robot["convention"] == "modified"
        samples = [sample(model, data, generator, modified and k < 2) for k in range(SAMPLES)]
        write(f"dynamics/{arm}", __file__, {"arm": arm, "links": links}, samples)


if __name__ == "__main__":
    main()
