"""A program that is typed, as type checkers see the package: `python/tools/test` has it checked, and it runs as well."""

from __future__ import annotations

import numpy
from numpy.typing import NDArray

import stiffarm


def reach(arm: stiffarm.Arm, q: NDArray[numpy.float64]) -> float:
    jacobian: NDArray[numpy.floating] = arm.jacobian(q, at=None)
    row: stiffarm.Row = arm.rows[0]
    stiffness: float | None = row.stiffness
    assert jacobian.shape[-2:] == (6, arm.dof) and stiffness is not None
    return float(numpy.linalg.norm(arm.pose(q)[..., :3, 3]))


def findings(data: stiffarm.Table) -> tuple[list[frozenset[tuple[str, str]]], float]:
    hose = stiffarm.Effect("taut_hose", "joint", [("lag", "1")], lambda reading, values: float(-values[0] * reading.q[reading.number - 1]))
    found: stiffarm.Diagnosis = stiffarm.diagnose("kuka_kr240", data, own=[hose], effects=["joint_compliance"], progress=False)
    prediction: stiffarm.Prediction = found.predict(data)
    corrected: stiffarm.Arm = found.corrected
    part, (low, high) = found.shrink
    assert low <= part <= high and prediction.after.shape == (data.rows, 6) and corrected.dof == 6
    return found.sets, part


def in_motion(log: stiffarm.Table) -> float:
    def brake(samples: stiffarm.Samples, values: NDArray[numpy.float64]) -> NDArray[numpy.float64]:
        q, rate = samples.q[:, samples.number - 1], samples.qd[:, samples.number - 1]
        torque: NDArray[numpy.float64] = values[0] * abs(q) * numpy.sign(rate)
        return torque

    own = stiffarm.LogEffect("widening_brake", "torque", [("brake", "N·m/rad")], brake)
    found = stiffarm.diagnose("ur10", log, own=[own], effects=["coulomb_friction"], progress=False)
    prediction = found.predict([log])
    assert isinstance(prediction, stiffarm.LogPrediction)
    torque: NDArray[numpy.float64] = prediction.predicted
    return float(torque.std())


def main() -> None:
    arm = stiffarm.Arm.load("kuka_kr240")
    assert reach(arm, numpy.zeros(6)) > 1.0
    plan: stiffarm.Table = stiffarm.simulate(arm, effects=["joint_compliance@joint 2=1.5e-7"], poses=12, payload=200.0)
    sets, part = findings(plan)
    assert sets and part > 0.5
    log = stiffarm.Log(runs=1, rate="100Hz", period=20.0)
    motion: stiffarm.Table = stiffarm.simulate("ur10", log=log)
    checked: stiffarm.Result = stiffarm.check(arm, count=5)
    chart: stiffarm.Map = stiffarm.map(arm, ("q2", "q3"), "condition", steps=3)
    assert in_motion(motion) > 0.0 and motion.rows and checked.to_dict()["agrees"] and chart.svg
    try:
        arm.pose([0.0] * 5)
    except ValueError:
        pass
    limits: bytes = stiffarm.controller(arm, "joint-limits")
    assert limits.startswith(b"joint_limits:")
    springs: stiffarm.Record = stiffarm.eval(arm, [0.0] * 6).to_dict()
    assert springs["position"]


if __name__ == "__main__":
    main()
