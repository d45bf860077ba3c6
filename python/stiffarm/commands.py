"""The commands of stiffarm as functions; each says what the command of its name says, on arrays and tables."""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import Optional, Union

from .arm import Arm
from .result import Identification, Result
from .run import AnyArm, robot, run
from .table import Frame, Table, held
from .words import Path, Quantity, each, numbers, option

#: A load: fx, fy, fz, mx, my, mz (N, N·m; base axes, at the tool's origin), or a text with units.
Wrench = Union[str, Sequence[float]]


def identify(
    arm: AnyArm,
    data: Frame,
    *,
    links: bool = False,
    base: bool = False,
    noise_position: Optional[Quantity] = None,
    noise_rotation: Optional[Quantity] = None,
    folds: Optional[int] = None,
    seed: int = 0,
    progress: bool = True,
) -> Identification:
    """Joint stiffnesses, and if asked those of links and base, from measurements under loads.

    data: loads with displacements ``dx dy dz …``, or poses ``x y z …`` under two loads or more each.
    noise_position, noise_rotation: standard deviations, m and rad, or ``"30um"``.
    """
    files: dict[str, bytes] = {}
    words = [
        "identify",
        robot(arm, files),
        held(data, files),
        *option("links", links),
        *option("base", base),
        *option("noise_position", noise_position, "m"),
        *option("noise_rotation", noise_rotation, "rad"),
        *option("folds", folds),
        *option("seed", seed),
        "--json=<json>",
        "--report=<page>",
        "--write-robot=<robot>",
    ]
    _, written = run(words, files, progress)
    corrected = Arm.from_toml(written["<robot>"], "<identified>")
    return Identification(written["<json>"], written["-"], written["<page>"], corrected)


def poses(
    arm: AnyArm,
    count: int,
    *,
    purpose: str = "identify",
    effects: Sequence[str] = (),
    nuisance: Sequence[str] = (),
    loads: Sequence[Wrench] = (),
    rotations: bool = False,
    noise_position: Quantity = "30um",
    noise_rotation: Quantity = "0.1mrad",
    seed: int = 0,
    progress: bool = True,
) -> Table:
    """Test postures and loads that say most, as a measurement file to fill in.

    purpose: ``identify``, ``diagnose``, or ``separate``, which two `effects` are to be told apart: ``effect@place`` each.
    loads: those to choose from [default: pulls of 100 N along ±x, ±y and −z].
    """
    files: dict[str, bytes] = {}
    words = [
        "poses",
        robot(arm, files),
        *effects,
        *option("count", count),
        *option("for", purpose),
        *option("nuisance", list(nuisance)),
        *(word for load in loads for word in numbers("load", load)),
        *option("rotations", rotations),
        *option("noise_position", noise_position, "m"),
        *option("noise_rotation", noise_rotation, "rad"),
        *option("seed", seed),
        "--csv=<csv>",
    ]
    return Table(run(words, files, progress)[1]["<csv>"])


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
    noise_position: Quantity = "30um",
    noise_rotation: Quantity = "0.005deg",
    seed: int = 0,
    frames: Optional[str] = None,
    first_order_sim: bool = False,
    withhold: bool = False,
) -> Table:
    """Measurements of an arm with chosen effects, exact at static equilibrium, with noise.

    plan: poses and loads as of a measurement file; without one they are drawn by `design` (``payload``, ``force``,
        ``narrow``, ``one-sided``), `poses`, `payload` (kg, or ``"500N"``), `repeats` and `measure` (``pose``,
        ``position``, ``displacement``, ``distance``).
    effects: ``"backlash@joint 2=0.3 mrad"`` each.
    """
    files: dict[str, bytes] = {}
    words = [
        "simulate",
        robot(arm, files),
        *([] if plan is None else [held(plan, files)]),
        *each("effect", effects),
        *option("design", design),
        *option("poses", poses),
        *option("payload", payload, "kg"),
        *option("repeats", repeats),
        *option("measure", measure),
        *option("noise_position", noise_position, "m"),
        *option("noise_rotation", noise_rotation, "rad"),
        *option("seed", seed),
        *option("frames", frames),
        *option("first_order_sim", first_order_sim),
        *option("withhold", withhold),
        "--csv=<csv>",
    ]
    return Table(run(words, files)[1]["<csv>"])


def withhold(
    arm: AnyArm,
    plan: Optional[Frame] = None,
    *,
    effects: Optional[Sequence[str]] = None,
    cases: int = 100,
    sizes: tuple[float, float] = (8.0, 20.0),
    design: Optional[str] = None,
    poses: Optional[int] = None,
    payload: Union[None, float, str] = None,
    repeats: Optional[int] = None,
    measure: Optional[str] = None,
    noise_position: Quantity = "30um",
    noise_rotation: Quantity = "0.005deg",
    seed: int = 0,
    progress: bool = True,
) -> Result:
    """What an experiment can find, before anyone runs it: effects are put into a plant, and the diagnosis is not told.

    cases: how many; sizes: the smallest and the largest gap of an effect, in multiples of the noise. The rest is that of
    :func:`simulate`.
    """
    files: dict[str, bytes] = {}
    words = [
        "withhold",
        robot(arm, files),
        *([] if plan is None else [held(plan, files)]),
        *option("effects", None if effects is None else list(effects)),
        *option("cases", cases),
        *numbers("sizes", sizes),
        *option("design", design),
        *option("poses", poses),
        *option("payload", payload, "kg"),
        *option("repeats", repeats),
        *option("measure", measure),
        *option("noise_position", noise_position, "m"),
        *option("noise_rotation", noise_rotation, "rad"),
        *option("seed", seed),
        "--json=<json>",
        "--report=<page>",
    ]
    _, written = run(words, files, progress)
    return Result(written["<json>"], written["-"], written["<page>"])


def compensate(
    arm: AnyArm,
    targets: Frame,
    *,
    wrench: Optional[Wrench] = None,
    tolerance: Quantity = "1um",
    tolerance_rotation: Quantity = "0.001mrad",
    starts: int = 24,
    seed: int = 0,
    progress: bool = True,
) -> Table:
    """Joint set-points at which the loaded arm stands at the targets.

    targets: ``x y z``, perhaps ``rx ry rz``, where the tool should be; perhaps ``q1 … qn``, from where to start, and loads.
    wrench: the load at all targets. The column ``status`` of the result says ``reached``, ``nearest`` or ``unstable``.
    """
    files: dict[str, bytes] = {}
    words = [
        "compensate",
        robot(arm, files),
        *option("targets", held(targets, files, "<targets>")),
        *numbers("wrench", wrench),
        *option("tolerance", tolerance, "m"),
        *option("tolerance_rotation", tolerance_rotation, "rad"),
        *option("starts", starts),
        *option("seed", seed),
        "--out=<csv>",
    ]
    return Table(run(words, files, progress)[1]["<csv>"])


def generate(
    arm: AnyArm,
    emit: str,
    *,
    outputs: Sequence[str] = (),
    precision: Optional[str] = None,
    sines: Optional[str] = None,
    name: Optional[str] = None,
    flexible: Optional[str] = None,
    kernels: Optional[str] = None,
    fused: bool = False,
) -> dict[str, str]:
    """The kernels as ``rust`` or ``c``, the closed form as ``latex`` or ``dot``, the arm as ``urdf`` or ``mjcf``: texts by
    the names of their files, of which C has two.

    outputs: some only; precision: ``f32`` or ``f64``, sines: ``polynomial``, ``math`` or ``given``, name: what names in C
    begin with.
    """
    files: dict[str, bytes] = {}
    word = robot(arm, files)
    stem = os.path.splitext(os.path.basename(word.strip("<>")))[0]
    folder = "<out>" if emit == "c" else f"<{stem}>"
    if emit == "c" and name is None:
        name = "".join(letter if letter.isalnum() else "_" for letter in stem.lower()) or "arm"
    words = [
        "generate",
        word,
        *option("emit", emit),
        *option("outputs", list(outputs)),
        *option("precision", precision),
        *option("sines", sines),
        *option("name", name),
        *option("flexible", flexible),
        *option("kernels", kernels),
        *option("fused", fused),
        *option("out", folder),
    ]
    written = run(words, files)[1]
    ends = {"rust": "rs", "latex": "tex", "dot": "dot", "urdf": "urdf", "mjcf": "xml"}
    plain = f"{stem}.{ends.get(emit, emit)}"
    return {plain if file == folder else os.path.basename(file): text for file, text in written.items()}


def papers(files: Sequence[Path] = ()) -> str:
    """The ledger of printed equations: which agree, which are misprints, and what they should say."""
    return run(["papers", *(os.fspath(file) for file in files)], {})[1]["-"]


def import_urdf(urdf: Path, *, base: Optional[str] = None, tip: Optional[str] = None, as_written: bool = False) -> Arm:
    """The arm of a URDF: a path, or its text. Any serial chain, exactly, between the links `base` [default: the root] and
    `tip` [default: the only one on which nothing hangs].

    as_written: keep 1.5708; by default a rounding of a simple multiple of π is that multiple.
    """
    name, files = os.fspath(urdf), {}
    if name.lstrip().startswith("<"):
        name, files = "<urdf>", {"<urdf>": name.encode()}
    words = ["import", name, *option("base", base), *option("tip", tip), *option("as_written", as_written), "--toml=<robot>"]
    text = run(words, files)[1]["<robot>"]
    stem = os.path.splitext(os.path.basename(name.strip("<>")))[0]
    return Arm.from_toml(text, f"<{stem}>")


def measurements(
    raw: Path, *, map: Optional[Path] = None, sheet: Optional[str] = None, arm: Optional[AnyArm] = None
) -> Table:
    """A measurement file from a table as a tracker or a controller wrote it: any separator, decimal commas, xlsx, ods.

    map: a file (TOML) that says what is not found by name; arm: read the result as this arm's, and refuse what could not be
    diagnosed. What was done goes to the log.
    """
    files: dict[str, bytes] = {}
    words = [
        "measurements",
        os.fspath(raw),
        *option("map", map),
        *option("sheet", sheet),
        *option("robot", None if arm is None else robot(arm, files)),
        "--csv=<csv>",
    ]
    return Table(run(words, files)[1]["<csv>"])
