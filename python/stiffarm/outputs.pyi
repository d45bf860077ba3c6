"""An arm's outputs, a method each. Written by tools/outputs.py."""

from typing import Any, Optional

import numpy
from numpy.typing import ArrayLike, NDArray

Reals = NDArray[numpy.floating[Any]]

class Outputs:
    """What an arm computes.

    Joint values and what else is said of joints are (n,) or (batch, n), wrenches (6,) or (batch, 6), results as each method says,
    with the batch in front: float64, or float32 (worked out in double, and rounded) of joint values that are. What is told of the
    tool is told of a ``[[frame]]`` or a ``[[marker]]`` of the robot file `at` its name, wrenches and all: ``arm.places`` lists
    them. `sides` (n,), from which side each joint came to rest, and `warming`, K, are for a corrected arm that depends on them.
    """

    def pose(
        self, q: ArrayLike, *,
        out: Optional[Reals] = None, sides: Optional[ArrayLike] = None, warming: Optional[float] = None, at: Optional[str] = None,
    ) -> Reals:
        """Pose of the tool in base axes. Result: (4, 4), in m (axes: 1)."""

    def frames(
        self, q: ArrayLike, *,
        out: Optional[Reals] = None, sides: Optional[ArrayLike] = None, warming: Optional[float] = None, at: Optional[str] = None,
    ) -> Reals:
        """Poses of frames 1 to n in base axes. Result: (n, 4, 4), in m (axes: 1)."""

    def jacobian(
        self, q: ArrayLike, *,
        out: Optional[Reals] = None, sides: Optional[ArrayLike] = None, warming: Optional[float] = None, at: Optional[str] = None,
    ) -> Reals:
        """Geometric Jacobian, base axes, at the tool origin. Result: (6, n), in m/rad (prismatic joint: 1), rad/rad (prismatic joint: 0)."""

    def jacobian_tool(
        self, q: ArrayLike, *,
        out: Optional[Reals] = None, sides: Optional[ArrayLike] = None, warming: Optional[float] = None, at: Optional[str] = None,
    ) -> Reals:
        """Geometric Jacobian, tool axes, at the tool origin: Paul's differential Jacobian. Result: (6, n), in m/rad (prismatic joint: 1), rad/rad (prismatic joint: 0)."""

    def jacobian_spatial(
        self, q: ArrayLike, *,
        out: Optional[Reals] = None, sides: Optional[ArrayLike] = None, warming: Optional[float] = None, at: Optional[str] = None,
    ) -> Reals:
        """Geometric Jacobian, base axes, at the base's origin (of the world, in which the base stands): the spatial Jacobian. Result: (6, n), in m/rad (prismatic joint: 1), rad/rad (prismatic joint: 0)."""

    def complementary_stiffness(
        self, q: ArrayLike, wrench: ArrayLike, *,
        out: Optional[Reals] = None, sides: Optional[ArrayLike] = None, warming: Optional[float] = None, at: Optional[str] = None,
    ) -> Reals:
        """K_C: how the joint torques of a wrench that is constant in base axes change with the posture. Result: (n, n), in N·m/rad (prismatic joint: N, two of them: N/m)."""

    def joint_torque(
        self, q: ArrayLike, wrench: ArrayLike, *,
        out: Optional[Reals] = None, sides: Optional[ArrayLike] = None, warming: Optional[float] = None, at: Optional[str] = None,
    ) -> Reals:
        """Joint torques of the wrench. Result: (n,), in N·m (prismatic joint: N)."""

    def weight_torque(
        self, q: ArrayLike, *,
        out: Optional[Reals] = None, sides: Optional[ArrayLike] = None, warming: Optional[float] = None, at: Optional[str] = None,
    ) -> Reals:
        """Joint torques of the links' weights, positive like Jᵀ w: what the weights do to the joints, −g(q) of the equations of motion. The motors hold the opposite, g(q). Result: (n,), in N·m (prismatic joint: N)."""

    def weight_stiffness(
        self, q: ArrayLike, *,
        out: Optional[Reals] = None, sides: Optional[ArrayLike] = None, warming: Optional[float] = None, at: Optional[str] = None,
    ) -> Reals:
        """K_G: how the torques of the links' weights change with the posture, the weights' part of K_C. Result: (n, n), in N·m/rad (prismatic joint: N, two of them: N/m)."""

    def compliance(
        self, q: ArrayLike, *,
        out: Optional[Reals] = None, sides: Optional[ArrayLike] = None, warming: Optional[float] = None, at: Optional[str] = None,
    ) -> Reals:
        """Compliance of the tool, base axes, at the tool origin; links as Euler-Bernoulli beams. Result: (6, 6), in m/N and m/(N·m), rad/N and rad/(N·m)."""

    def deflection_first_order(
        self, q: ArrayLike, wrench: ArrayLike, *,
        out: Optional[Reals] = None, sides: Optional[ArrayLike] = None, warming: Optional[float] = None, at: Optional[str] = None,
    ) -> Reals:
        """Displacement of the tool under the wrench, base axes, at the tool origin, to first order in the load. Result: (6,), in m, rad."""

    def deflection(
        self, q: ArrayLike, wrench: ArrayLike, *,
        out: Optional[Reals] = None, sides: Optional[ArrayLike] = None, warming: Optional[float] = None, at: Optional[str] = None,
    ) -> Reals:
        """Displacement of the tool under the wrench, base axes, at the tool origin, with the stiffness of the loaded geometry. Result: (6,), in m, rad."""

    def deflection_with_gravity(
        self, q: ArrayLike, wrench: ArrayLike, *,
        out: Optional[Reals] = None, sides: Optional[ArrayLike] = None, warming: Optional[float] = None, at: Optional[str] = None,
    ) -> Reals:
        """Displacement of the tool under the wrench and the links' weights, base axes, at the tool origin. Result: (6,), in m, rad."""

    def parameter_jacobian(
        self, q: ArrayLike, *,
        out: Optional[Reals] = None, sides: Optional[ArrayLike] = None, warming: Optional[float] = None, at: Optional[str] = None,
    ) -> Reals:
        """Twist of the tool per unit of each entry of the table, base axes, at the tool origin. Result: (6, 4 n + 6), in m/rad (length: 1), rad/rad (length: 0)."""

    def compliance_regressor(
        self, q: ArrayLike, wrench: ArrayLike, *,
        out: Optional[Reals] = None, sides: Optional[ArrayLike] = None, warming: Optional[float] = None, at: Optional[str] = None,
    ) -> Reals:
        """Displacement of the tool per unit of each joint's compliance under the wrench, base axes, at the tool origin: the regressor of joint springs. Result: (6, n), in N·m²/rad (prismatic joint: N), N·m (prismatic joint: 0)."""

    def inverse_dynamics(
        self, q: ArrayLike, qd: ArrayLike, qdd: ArrayLike, *,
        out: Optional[Reals] = None, sides: Optional[ArrayLike] = None, warming: Optional[float] = None, at: Optional[str] = None,
    ) -> Reals:
        """Torques of the joints' motors for a motion, at the joints. Result: (n,), in N·m (prismatic joint: N)."""

    def bias(
        self, q: ArrayLike, qd: ArrayLike, *,
        out: Optional[Reals] = None, sides: Optional[ArrayLike] = None, warming: Optional[float] = None, at: Optional[str] = None,
    ) -> Reals:
        """Torques of the joints' motors where no joint accelerates: weights, centrifugal and Coriolis forces, friction; at rest g(q), the opposite of the weight torque. Result: (n,), in N·m (prismatic joint: N)."""

    def mass_matrix(
        self, q: ArrayLike, *,
        out: Optional[Reals] = None, sides: Optional[ArrayLike] = None, warming: Optional[float] = None, at: Optional[str] = None,
    ) -> Reals:
        """Mass matrix: torques of the joints' motors per unit of each joint's acceleration. Result: (n, n), in kg·m² (prismatic joint: kg·m, two of them: kg)."""

    def hessian(
        self, q: ArrayLike, *,
        out: Optional[Reals] = None, sides: Optional[ArrayLike] = None, warming: Optional[float] = None, at: Optional[str] = None,
    ) -> Reals:
        """Kinematic Hessian: how the geometric Jacobian, base axes, at the tool origin, changes by each joint. Result: (n, 6, n), in m/rad² (a prismatic joint: m/rad), rad/rad²."""

    def jacobian_rate(
        self, q: ArrayLike, qd: ArrayLike, *,
        out: Optional[Reals] = None, sides: Optional[ArrayLike] = None, warming: Optional[float] = None, at: Optional[str] = None,
    ) -> Reals:
        """Rate of the geometric Jacobian, base axes, at the tool origin: the tool accelerates by J q̈ + J̇ q̇. Result: (6, n), in m/(rad s) (prismatic joint: 1/s), 1/s."""

    def compliance_by_joints(
        self, q: ArrayLike, *,
        out: Optional[Reals] = None, sides: Optional[ArrayLike] = None, warming: Optional[float] = None, at: Optional[str] = None,
    ) -> Reals:
        """How the compliance of the tool, base axes, at the tool origin, changes by each joint. Result: (n, 6, 6), in m/N and m/(N·m), per rad (prismatic joint: m), rad/N and rad/(N·m), per rad (m)."""

    def deflection_by_joints(
        self, q: ArrayLike, wrench: ArrayLike, *,
        out: Optional[Reals] = None, sides: Optional[ArrayLike] = None, warming: Optional[float] = None, at: Optional[str] = None,
    ) -> Reals:
        """How the displacement of the tool under the wrench, base axes, at the tool origin, changes by each joint, with the stiffness of the loaded geometry. Result: (6, n), in m/rad (prismatic joint: 1), rad/rad (prismatic joint: rad/m)."""

    def manipulability(
        self, q: ArrayLike, *,
        out: Optional[Reals] = None, sides: Optional[ArrayLike] = None, warming: Optional[float] = None, at: Optional[str] = None,
    ) -> Reals:
        """Manipulability at the tool origin: the product of the Jacobian's singular values, zero where the tool cannot move in some direction. Result: (), in m per rad for each singular value of a translation."""

    def manipulability_by_joints(
        self, q: ArrayLike, *,
        out: Optional[Reals] = None, sides: Optional[ArrayLike] = None, warming: Optional[float] = None, at: Optional[str] = None,
    ) -> Reals:
        """Gradient of the manipulability by the joints; zero at a singular posture, where there is none. Result: (n,), in that of the manipulability, per rad (prismatic joint: m)."""

    def inverse_dynamics_by_joints(
        self, q: ArrayLike, qd: ArrayLike, qdd: ArrayLike, *,
        out: Optional[Reals] = None, sides: Optional[ArrayLike] = None, warming: Optional[float] = None, at: Optional[str] = None,
    ) -> Reals:
        """How the torques of the joints' motors for a motion change by each joint value. Result: (n, n), in N·m/rad (prismatic joint: N, two of them: N/m)."""

    def inverse_dynamics_by_rates(
        self, q: ArrayLike, qd: ArrayLike, *,
        out: Optional[Reals] = None, sides: Optional[ArrayLike] = None, warming: Optional[float] = None, at: Optional[str] = None,
    ) -> Reals:
        """How the torques of the joints' motors for a motion change by each joint's rate, whatever the accelerations; dry friction's step at rest apart. Result: (n, n), in N·m·s/rad (prismatic joint: N·s, two of them: N·s/m)."""

    def forward_dynamics(
        self, q: ArrayLike, qd: ArrayLike, tau: ArrayLike, *,
        out: Optional[Reals] = None, sides: Optional[ArrayLike] = None, warming: Optional[float] = None, at: Optional[str] = None,
    ) -> Reals:
        """Accelerations of the joints under their motors' torques. Result: (n,), in rad/s² (prismatic joint: m/s²)."""

    def torque_regressor(
        self, q: ArrayLike, qd: ArrayLike, qdd: ArrayLike, *,
        out: Optional[Reals] = None, sides: Optional[ArrayLike] = None, warming: Optional[float] = None, at: Optional[str] = None,
    ) -> Reals:
        """Torques of the joints' motors for a motion per unit of each link's moments of mass; rotors and friction apart. Result: (n, 10 n), in m/s² (first moments: m/s²·m, tensor: 1/s²; times m of a revolute joint)."""
