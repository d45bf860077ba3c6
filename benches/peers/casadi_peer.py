"""The KUKA KR 240-2 in CasADi, given the axis formula of the Jacobian, as C."""

import sys

import casadi as ca

PI_2 = ca.pi / 2
TABLE = [(0, 0, 0), (0.35, PI_2, 0), (1.25, 0, 0), (0.055, -PI_2, 1.1), (0, PI_2, 0), (0, -PI_2, 0.23)]


def exact(x):
    """Cosines and sines of quarter turns, so that zeros are zeros."""
    return round(x) if abs(x - round(x)) < 1e-12 else x


q = ca.SX.sym("q", 6)
rotation, origin = ca.SX.eye(3), ca.SX.zeros(3)
axes, origins = [], []
for i, (a, alpha, d) in enumerate(TABLE):
    c, s = exact(ca.cos(alpha)), exact(ca.sin(alpha))
    twist = ca.SX(3, 3)
    twist[0, 0], twist[1, 1], twist[2, 2] = 1, c, c
    if s != 0:
        twist[1, 2], twist[2, 1] = -s, s
    origin = origin + a * rotation[:, 0]
    rotation = rotation @ twist
    turn = ca.SX(3, 3)
    turn[0, 0], turn[1, 1], turn[0, 1], turn[1, 0] = ca.cos(q[i]), ca.cos(q[i]), -ca.sin(q[i]), ca.sin(q[i])
    turn[2, 2] = 1
    rotation = rotation @ turn
    origin = origin + d * rotation[:, 2]
    axes.append(rotation[:, 2])
    origins.append(origin)
columns = [ca.vertcat(ca.cross(z, origin - p), z) for z, p in zip(axes, origins)]


def dense(m):
    return ca.densify(ca.vec(m))


pose = ca.Function("pose", [q], [ca.cse(dense(ca.horzcat(rotation, origin)))])
jacobian = ca.Function("jacobian", [q], [ca.cse(dense(ca.horzcat(*columns)))])
generator = ca.CodeGenerator(sys.argv[1])
generator.add(pose)
generator.add(jacobian)
generator.generate()
