"""Experiments: what to measure, what would be measured, and what a diagnosis would find of it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Optional, Union

from .result import Result
from .run import AnyArm, robot, run, tabled
from .table import Frame, Table, held
from .words import Quantity, Wrench, options

#: A number for all joints, or one for each.
PerJoint = Union[None, float, Sequence[float]]


@dataclass(frozen=True)
class Motion:
    """How an arm may move. What is None is as the command line has it."""

    #: Largest rate of the joints, rad/s or m/s [default: 1 rad/s, 0.25 m/s].
    max_rate: PerJoint = None
    #: Largest acceleration, rad/s² or m/s² [default: 3 rad/s², 0.75 m/s²].
    max_acceleration: PerJoint = None
    #: Time of a motion that is drawn or chosen, s [default: 20].
    period: Optional[Quantity] = None
    #: Terms of its Fourier series [default: 10].
    harmonics: Optional[int] = None

    def words(self) -> list[str]:
        """Those of the command line."""
        return options(**vars(self))


@dataclass(frozen=True)
class Log(Motion):
    """How a motion is logged."""

    #: ``motor`` or ``link``, torques on that side of the gears, ``commanded`` ones, ``current`` of the motors, or ``position``, of
    #: position servos [default: motor].
    logged: Optional[str] = None
    #: Motions that are drawn, a run of the log each [default: 3].
    runs: Optional[int] = None
    #: Samples a second [default: 250].
    rate: Optional[Quantity] = None
    #: Step of the encoders at the joints, rad or m [default: 1e-5].
    encoder: Optional[float] = None
    #: Standard deviation of a reading beyond that, rad or m [default: 0; of positions 0.0005].
    noise_reading: Optional[float] = None
    #: Standard deviation of a torque, as a part of its spread [default: 0.02], and how long it keeps, s [default: 0, white].
    noise_torque: Optional[Quantity] = None
    colour: Optional[Quantity] = None
    #: Standard deviation of the clock, s [default: 5e-5], and the part of the samples that is lost [default: 0.001].
    jitter: Optional[Quantity] = None
    lost: Optional[Quantity] = None


def poses(
    arm: AnyArm,
    count: Optional[int] = None,
    *,
    purpose: str = "identify",
    effects: Sequence[str] = (),
    nuisance: Sequence[str] = (),
    loads: Sequence[Wrench] = (),
    rotations: bool = False,
    noise_position: Optional[Quantity] = None,
    noise_rotation: Optional[Quantity] = None,
    motion: Optional[Motion] = None,
    seed: int = 0,
    progress: bool = True,
) -> Table:
    """Test postures and loads that say most, as a measurement file to fill in; of a `motion` the joints' commands.

    count: how many, but of a motion. purpose: ``identify``, ``diagnose``, or ``separate``, which two `effects` are to be told
        apart: ``effect@place`` each. motion: within which limits; its log says most of friction, rotors and the like, or of the
        `effects`.
    loads: those to choose from [default: pulls of 100 N along ±x, ±y and −z].
    noise_position, noise_rotation: of a coordinate, m [default: 30 µm], and of a rotation, rad [default: 0.1 mrad].
    """
    files: dict[str, bytes] = {}
    words = [
        "poses",
        robot(arm, files),
        *effects,
        *options(count=count, for_=purpose if motion is None else "motion", nuisance=nuisance),
        *(word for load in loads for word in options(load=load)),
        *options(rotations=rotations, noise_position=noise_position, noise_rotation=noise_rotation, seed=seed),
        *([] if motion is None else motion.words()),
    ]
    return tabled(words, files, progress)


def simulate(
    arm: AnyArm,
    plan: Optional[Frame] = None,
    *,
    effects: Sequence[str] = (),
    design: Optional[str] = None,
    poses: Optional[int] = None,
    payload: Union[None, float, str] = None,
    repeats: Optional[int] = None,
    measure: Optional[str] = None,
    noise_position: Optional[Quantity] = None,
    noise_rotation: Optional[Quantity] = None,
    seed: int = 0,
    frames: Optional[str] = None,
    first_order_sim: bool = False,
    withhold: bool = False,
    log: Optional[Log] = None,
) -> Table:
    """Measurements of an arm with chosen effects, exact at static equilibrium, with noise; or a joint `log` of it in motion.

    plan: poses and loads as of a measurement file, of a log the joints' commands; without one they are drawn, poses by `design`
        (``payload``, ``force``, ``narrow``, ``one-sided``), `poses`, `payload` (kg, or ``"500N"``), `repeats` and `measure`
        (``pose``, ``position``, ``displacement``, ``distance``).
    effects: ``"backlash@joint 2=0.3 mrad"`` each.
    noise_position, noise_rotation: of a coordinate, m [default: 30 µm], and of a rotation, rad [default: 0.005°].
    """
    files: dict[str, bytes] = {}
    words = [
        "simulate",
        robot(arm, files),
        *([] if plan is None else [held(plan, files)]),
        *(word for effect in effects for word in options(effect=effect)),
        *_experiment(design, poses, payload, repeats, measure, noise_position, noise_rotation, seed),
        *options(frames=frames, first_order_sim=first_order_sim, withhold=withhold),
        *([] if log is None else log.words()),
    ]
    return tabled(words, files, out="csv" if log is None else "log")


def withhold(
    arm: AnyArm,
    plan: Optional[Frame] = None,
    *,
    effects: Optional[Sequence[str]] = None,
    cases: int = 100,
    sizes: Optional[tuple[float, float]] = None,
    design: Optional[str] = None,
    poses: Optional[int] = None,
    payload: Union[None, float, str] = None,
    repeats: Optional[int] = None,
    measure: Optional[str] = None,
    noise_position: Optional[Quantity] = None,
    noise_rotation: Optional[Quantity] = None,
    seed: int = 0,
    log: Optional[Log] = None,
    progress: bool = True,
) -> Result:
    """What an experiment can find, before anyone runs it: effects are put into a plant, and the diagnosis is not told.

    cases: how many; sizes: the smallest and the largest gap of an effect, in multiples of the noise [default: 8 to 20; of a log 1
    to 3]. The rest is that of :func:`simulate`.
    """
    files: dict[str, bytes] = {}
    words = [
        "withhold",
        robot(arm, files),
        *([] if plan is None else [held(plan, files)]),
        *options(effects=effects, cases=cases, sizes=sizes),
        *_experiment(design, poses, payload, repeats, measure, noise_position, noise_rotation, seed),
        *(["--report=<page>"] if log is None else ["--motion", *log.words()]),
        "--json=<json>",
    ]
    _, written = run(words, files, progress)
    return Result(written["<json>"], written["-"], written.get("<page>"))


def _experiment(
    design: Optional[str],
    poses: Optional[int],
    payload: Union[None, float, str],
    repeats: Optional[int],
    measure: Optional[str],
    noise_position: Optional[Quantity],
    noise_rotation: Optional[Quantity],
    seed: int,
) -> list[str]:
    return [
        *options(
            design=design, poses=poses, payload=payload, repeats=repeats, measure=measure, noise_position=noise_position,
            noise_rotation=noise_rotation, seed=seed,
        ),
    ]
