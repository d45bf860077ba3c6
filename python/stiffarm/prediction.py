"""What a diagnosis makes of other data of the arm, to which nothing is fitted."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

from .record import Record, read

if TYPE_CHECKING:
    import numpy
    from numpy.typing import NDArray

    Reals = NDArray[numpy.float64]


class Prediction(NamedTuple):
    """What a diagnosis makes of other rows; of a log it is a :class:`LogPrediction`, with (m, n) in place of (m, 6)."""

    #: Measured minus predicted without the findings, (m, 6): m and rad; 0 where nothing is measured.
    before: Reals
    #: The same with them.
    after: Reals
    #: Whether the row lies within the joint ranges and loads that were diagnosed, (m,).
    inside: NDArray[numpy.bool_]


class LogPrediction(Prediction):
    """What a diagnosis makes of another log: `before` and `after` are what drove each joint, or where it was, minus what is
    predicted of it, (m, n); `inside` (m, n) are the rows that count, in which the joint moves and no filter's end is felt. Rows
    are the even, low-passed samples that a diagnosis makes of a log.
    """

    #: s, since the first sample of the row's run, (m,).
    t: Reals
    #: The row's run, from 0, (m,).
    run: NDArray[numpy.uintp]
    #: What drove the joints, N·m (N, A), or where they were, rad (m), (m, n).
    measured: Reals
    #: Joint values and their rates, (m, n).
    q: Reals
    qd: Reals
    #: What ``--check`` tells of the files: the gap of each joint among it.
    check: Record

    @property
    def predicted(self) -> Reals:
        """What drives the joints, or where they are, by the model with the findings, (m, n)."""
        return self.measured - self.after


def prediction(found: tuple[Any, ...]) -> Prediction:
    """Of what the extension module returns."""
    if len(found) == 3:
        return Prediction(*found)
    before, after, inside, t, run, measured, q, qd, json = found
    log = LogPrediction(before, after, inside)
    log.t, log.run, log.measured, log.q, log.qd = t, run, measured, q, qd
    log.check = read(json)["check"]
    return log
