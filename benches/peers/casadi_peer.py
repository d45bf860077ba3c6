"""The KUKA KR 240-2 in CasADi, as C: given the axis formulas of the Jacobian and of K_C."""

import sys

import casadi as ca

PI_2 = ca.pi / 2
STIFFNESS = [3.8e6, 6.6e6, 3.9e6, 5.6e5, 6.6e5, 4.7e5]
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

w = ca.SX.sym("w", 6)
force, moment = w[:3], w[3:]
geometric = ca.horzcat(*columns)
stiffness = ca.SX(6, 6)
for i in range(6):
    for j in range(6):
        v, z = columns[j][:3], axes[j]
        if i <= j:
            entry = ca.dot(force, ca.cross(axes[i], v)) + ca.dot(moment, ca.cross(axes[i], z))
        else:
            entry = ca.dot(force, ca.cross(z, columns[i][:3]))
        stiffness[j, i] = entry
soft = ca.diag(ca.SX([1 / k for k in STIFFNESS]))
compliance = geometric @ soft @ geometric.T
torque = geometric.T @ w
first_order = geometric @ (soft @ torque)

# (K_theta - K_C) x = torque by elimination without pivoting, as the kernels do it.
a, x = ca.diag(ca.SX(STIFFNESS)) - stiffness, ca.SX(torque)
for k in range(6):
    for i in range(k + 1, 6):
        factor = a[i, k] / a[k, k]
        a[i, k + 1:] = a[i, k + 1:] - factor * a[k, k + 1:]
        x[i] = x[i] - factor * x[k]
for k in reversed(range(6)):
    for i in range(k + 1, 6):
        x[k] = x[k] - a[k, i] * x[i]
    x[k] = x[k] / a[k, k]
deflection = geometric @ x


def dense(m):
    return ca.densify(ca.vec(m))


outputs = {
    "pose": ca.horzcat(rotation, origin),
    "jacobian": geometric,
    "complementary_stiffness": stiffness,
    "joint_torque": torque,
    "compliance": compliance,
    "deflection": deflection,
    "deflection_first_order": first_order,
}
dense_outputs = [dense(m) for m in outputs.values()]
generator = ca.CodeGenerator(sys.argv[1])
for name, m in zip(outputs, dense_outputs):
    generator.add(ca.Function(name, [q, w], [ca.cse(m)]))
generator.add(ca.Function("all", [q, w], ca.cse(dense_outputs[:6])))
generator.generate()
