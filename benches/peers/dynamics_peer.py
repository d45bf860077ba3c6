"""The equations of motion in CasADi, as C: Newton and Euler link by link in the links' axes, exact quarter turns, the
mass matrix and the regressor by CasADi's own derivatives, common subexpressions eliminated. The links are those that
the command dynamics of stiffarm-bench wrote.

    python3 benches/peers/dynamics_peer.py DIRECTORY
"""

import sys
from pathlib import Path

import casadi as ca

FOLDER = Path(sys.argv[1])


def exact(x):
    """Cosines and sines of quarter turns, so that zeros are zeros."""
    return round(x) if abs(x - round(x)) < 1e-12 else x


def column(numbers):
    """A vector whose zeros are structural."""
    return ca.sparsify(ca.SX(ca.DM(numbers)))


def turn(alpha, q):
    """The next joint's axes in those of the one before: about x, then about z."""
    c, s = exact(ca.cos(alpha)), exact(ca.sin(alpha))
    about_x = ca.sparsify(ca.SX(ca.DM([[1, 0, 0], [0, c, -s], [0, s, c]])))
    about_z = ca.SX(3, 3)
    about_z[0, 0], about_z[1, 1], about_z[0, 1], about_z[1, 0] = ca.cos(q), ca.cos(q), -ca.sin(q), ca.sin(q)
    about_z[2, 2] = 1
    return about_x @ about_z


def moments(mass, centre, tensor):
    """Mass, first moments and tensor about the joint's origin, ten numbers."""
    x, y, z = centre
    xx, xy, xz, yy, yz, zz = tensor
    return [
        mass, mass * x, mass * y, mass * z,
        xx + mass * (y * y + z * z), xy - mass * x * y, yy + mass * (x * x + z * z),
        xz - mass * x * z, yz - mass * y * z, zz + mass * (x * x + y * y),
    ]  # fmt: skip


def torques(gravity, links, bodies, q, qd, qdd):
    n = len(links)
    z = ca.SX(3, 1)
    z[2] = 1
    spin, spin_rate, acceleration = ca.SX(3, 1), ca.SX(3, 1), -column(gravity)
    turns, arms, loads = [], [], []
    for i, link in enumerate(links):
        r, p = turn(link[3], q[i]), column(link[:3])
        acceleration = r.T @ (acceleration + ca.cross(spin_rate, p) + ca.cross(spin, ca.cross(spin, p)))
        before = r.T @ spin
        spin_rate = r.T @ spin_rate + ca.cross(before, qd[i] * z) + qdd[i] * z
        spin = before + qd[i] * z
        m, h = bodies[i][0], ca.vertcat(*bodies[i][1:4])
        xx, xy, yy, xz, yz, zz = (bodies[i][k] for k in range(4, 10))
        inertia = ca.vertcat(ca.horzcat(xx, xy, xz), ca.horzcat(xy, yy, yz), ca.horzcat(xz, yz, zz))
        force = m * acceleration + ca.cross(spin_rate, h) + ca.cross(spin, ca.cross(spin, h))
        moment = inertia @ spin_rate + ca.cross(spin, inertia @ spin) + ca.cross(h, acceleration)
        turns.append(r)
        arms.append(p)
        loads.append((force, moment))
    force, moment, found = ca.SX(3, 1), ca.SX(3, 1), [None] * n
    for i in reversed(range(n)):
        force, moment = force + loads[i][0], moment + loads[i][1]
        found[i] = moment[2]
        force = turns[i] @ force
        moment = turns[i] @ moment + ca.cross(arms[i], force)
    return ca.vertcat(*found)


generator = ca.CodeGenerator("dynamics_casadi.c")
for path in sorted(FOLDER.glob("*.links")):
    gravity, *links = [[float(x) for x in line.split()] for line in path.read_text().splitlines()]
    n = len(links)
    state = ca.SX.sym("state", 3 * n)
    q, qd, qdd = state[:n], state[n : 2 * n], state[2 * n :]
    ten = ca.SX.sym("ten", 10 * n)
    known = [moments(link[4], link[5:8], link[8:]) for link in links]
    numbers = [[ca.SX(x) if x else ca.SX(1, 1) for x in body] for body in known]
    torque = torques(gravity, links, numbers, q, qd, qdd)
    split = [ca.vertsplit(body) for body in ca.vertsplit(ten, 10)]
    of_moments = torques(gravity, links, split, q, qd, qdd)
    results = {
        "inverse_dynamics": torque,
        "bias": torques(gravity, links, numbers, q, qd, ca.SX(n, 1)),
        "mass_matrix": ca.jacobian(torques([0, 0, 0], links, numbers, q, ca.SX(n, 1), qdd), qdd),
        "torque_regressor": ca.jacobian(of_moments, ten),
        "derivatives": ca.jacobian(torque, state),
    }
    for name, result in results.items():
        dense = ca.cse(ca.simplify(ca.densify(ca.vec(result))))
        generator.add(ca.Function(f"{path.stem}_{name}_casadi", [state], [dense]))
generator.generate(str(FOLDER) + "/")
