"""Shapes, types and strides of arrays, whatever they are."""

import numpy
import pytest
import stiffarm
from hypothesis import example, given, settings
from hypothesis import strategies as some
from hypothesis.extra import numpy as arrays

ARM = stiffarm.Arm.load("stanford")
N = ARM.dof
LEADS = arrays.array_shapes(min_dims=0, max_dims=3, min_side=0, max_side=5)
TYPES = some.sampled_from(["f8", "f4", "f2", ">f8", "i1", "i4", "u2", "<i8"])


@settings(max_examples=150, deadline=None)
@given(some.data())
def test_any_layout_gives_the_same(data):
    lead, dtype = data.draw(LEADS), data.draw(TYPES)
    unsigned = numpy.dtype(dtype).kind == "u"
    values = arrays.from_dtype(numpy.dtype(dtype), min_value=0 if unsigned else -3, max_value=3, allow_nan=False)
    q = data.draw(arrays.arrays(dtype, (*lead, N), elements=values))
    plain = numpy.ascontiguousarray(q, dtype=float).reshape(-1, N)
    want = numpy.array([ARM.jacobian(row) for row in plain]).reshape(*lead, 6, N)
    reversed_twice = q[..., ::-1].copy()[..., ::-1]
    every_other = numpy.repeat(q, 2, axis=-1)[..., ::2]
    for layout in (q, numpy.asfortranarray(q) if q.ndim else q, reversed_twice, every_other, q.tolist() if q.size else q):
        found = ARM.jacobian(layout)
        of_single = isinstance(layout, numpy.ndarray) and layout.dtype == numpy.float32
        kind = numpy.float32 if of_single else numpy.float64
        assert found.shape == (*lead, 6, N) and found.dtype == kind
        assert (found == want.astype(kind)).all()
    for kind in (numpy.float64, numpy.float32):
        out = numpy.full((*lead, 6, N), numpy.nan, kind)
        assert ARM.jacobian(q, out=out) is out
        assert (out == want.astype(kind)).all()


@settings(max_examples=60, deadline=None)
@given(some.data())
def test_what_is_not_finite_is_refused(data):
    count = data.draw(some.integers(1, 40))
    q = numpy.zeros((count, N))
    row, joint = data.draw(some.integers(0, count - 1)), data.draw(some.integers(0, N - 1))
    q[row, joint] = data.draw(some.sampled_from([numpy.inf, -numpy.inf]))
    with pytest.raises(ValueError, match=f"not finite, at pose {row} "):
        ARM.pose(q)


def test_one_pose_goes_where_it_is_asked_to():
    q, load = numpy.linspace(-1.0, 1.0, N), numpy.linspace(10.0, 60.0, 6)
    for call, given in ((ARM.jacobian, [q]), (ARM.pose, [q]), (ARM.frames, [q]), (ARM.hessian, [q]), (ARM.joint_torque, [q, load])):
        want = call(*(one[None] for one in given))[0]
        found = call(*given)
        assert found.shape == want.shape and (found == want).all()
        plain, wide = numpy.empty(want.shape), numpy.empty((2 * len(want), *want.shape[1:]))
        for out in (plain, numpy.empty(want.shape[::-1]).T, wide[::2], numpy.empty_like(plain, "f4")):
            assert call(*given, out=out) is out and (out == want.astype(out.dtype)).all()
        plain.flags.writeable = False
        with pytest.raises(ValueError, match="cannot be written"):
            call(*given, out=plain)
        with pytest.raises(ValueError, match="out: found the shape"):
            call(*given, out=numpy.empty((1, *want.shape)))
        for wrong in (numpy.nan, numpy.inf):
            with pytest.raises(ValueError, match="not finite, at pose 0"):
                call(*given[:-1], numpy.append(given[-1][1:], wrong))
        with pytest.raises(ValueError, match="found the shape"):
            call(*given[:-1], given[-1][1:])
        with pytest.raises(TypeError, match="expected real numbers"):
            call(*given[:-1], given[-1] > 0.0)


def test_missing_rows_are_missing():
    q = numpy.random.default_rng(1).uniform(-1, 1, (2, 3, N))
    whole = ARM.jacobian(q)
    q[1, 1, 2] = numpy.nan
    found = ARM.jacobian(q)
    assert numpy.isnan(found[1, 1]).all() and numpy.isnan(ARM.pose(q)[1, 1, :3]).all()
    there = ~numpy.isnan(q).any(axis=-1)
    assert (found[there] == whole[there]).all()
    assert numpy.isnan(ARM.joint_torque(numpy.full((2, N), numpy.nan), numpy.ones(6))).all()
    with pytest.raises(ValueError, match="not finite"):
        ARM.pose(q[1, 1])


@settings(max_examples=60, deadline=None)
@given(LEADS, some.integers(0, 9))
@example((3, 2, 0), N)
def test_a_wrong_last_dimension_is_refused(lead, size):
    q = numpy.zeros((*lead, size))
    if size == N:
        assert ARM.pose(q).shape == (*lead, 4, 4)
    else:
        with pytest.raises(ValueError, match="q: found the shape"):
            ARM.pose(q)


def test_no_poses():
    for empty in ((0, N), (3, 0, N)):
        assert ARM.jacobian(numpy.zeros(empty)).shape == (*empty[:-1], 6, N)
        assert ARM.deflection(numpy.zeros(empty), numpy.zeros(6)).shape == (*empty[:-1], 6)


@settings(max_examples=60, deadline=None)
@given(some.data())
def test_loads_go_with_poses(data):
    lead, of_pose, of_load = data.draw(LEADS), data.draw(some.booleans()), data.draw(some.booleans())
    numbers = some.floats(-1.0, 1.0, allow_subnormal=False)
    q = data.draw(arrays.arrays(float, (*(lead if of_pose else ()), N), elements=numbers))
    load = 50.0 * data.draw(arrays.arrays(float, (*(lead if of_load else ()), 6), elements=numbers))
    found = ARM.joint_torque(q, load)
    all_q, all_loads = (numpy.broadcast_to(one, (*found.shape[:-1], one.shape[-1])) for one in (q, load))
    assert found.shape == (*(lead if of_pose or of_load else ()), N)
    for at in numpy.ndindex(found.shape[:-1]):
        # Lanes and one pose at a time are the same bits; and it is J^T w but for what a hundred roundings of 300 N·m make.
        assert (found[at] == ARM.joint_torque(all_q[at], all_loads[at])).all()
        assert numpy.abs(found[at] - ARM.jacobian(all_q[at]).T @ all_loads[at]).max() <= 100 * 2.3e-16 * 300
    if load.size:
        load.flat[data.draw(some.integers(0, load.size - 1))] = numpy.nan
        if found.size:
            with pytest.raises(ValueError, match="not finite"):
                ARM.joint_torque(q, load)
