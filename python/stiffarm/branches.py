"""What an inverse kinematics returns."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import numpy
    from numpy.typing import ArrayLike, NDArray

    Reals = NDArray[numpy.float64]


@dataclass(frozen=True, eq=False)
class Branches:
    """Every branch of an inverse kinematics, reached or not; of many poses with the batch in front."""

    #: Readings, (k, n), rad (prismatic joint: m).
    q: Reals
    #: How far the tool's origin is from the pose's, (k,), m; infinite where the arm does not bear its load.
    distance: Reals
    #: How far the tool's axes are turned from the pose's, (k,): twice the sine of half the angle.
    angle: Reals
    #: Whether the readings are within the limits, (k,).
    within_limits: NDArray[numpy.bool_]
    #: What the bits of a branch's number choose, from the highest: of ``shoulder``, ``elbow``, ``wrist`` those that the arm has.
    bits: list[str]

    def reached(self, distance: float = 1e-6, angle: float = 1e-6) -> NDArray[numpy.bool_]:
        """Which branches are within the limits and miss the pose by no more than this, (k,), m and rad."""
        found: NDArray[numpy.bool_] = self.within_limits & (self.distance <= distance) & (self.angle <= angle)
        return found

    def nearest(self, near: ArrayLike, distance: float = 1e-6, angle: float = 1e-6) -> Reals:
        """Of the branches that are :meth:`reached` the readings with the least change from `near`, (n,); NaN where there is none."""
        import numpy

        change: NDArray[Any] = numpy.linalg.norm(self.q - numpy.asarray(near)[..., None, :], axis=-1)
        change = numpy.where(self.reached(distance, angle), change, numpy.inf)
        best = change.argmin(axis=-1)[..., None]
        q: Reals = numpy.take_along_axis(self.q, best[..., None], axis=-2)[..., 0, :]
        none = numpy.isinf(numpy.take_along_axis(change, best, axis=-1))
        return numpy.where(none, numpy.nan, q)
