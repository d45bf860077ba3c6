"""The commands of stiffarm as functions; each says what the command of its name says, on arrays and tables."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from typing import Optional, Union

from .arm import Arm
from .record import Record, read_all
from .result import Identification, Predicted, Result
from .run import AnyArm, robot, run, tabled
from .table import Frame, Map, Table, held
from .words import Path, Quantity, Wrench, options


def eval(
    arm: AnyArm,
    q: Union[str, Sequence[float]],
    wrench: Optional[Wrench] = None,
    *,
    sides: Optional[Sequence[int]] = None,
    warming: Optional[float] = None,
    gravity: bool = False,
) -> Result:
    """One posture under one load: ``position``, ``rotation``, ``jacobian``, ``k_c``, ``compliance``, ``deflection`` and
    ``joint_torque``, lists of rows. The methods of an :class:`Arm` give arrays, of many postures.

    q: joint values, rad (m), or a text with units: ``"30deg,45deg"``. sides, warming: what a corrected arm may depend on.
    gravity: let the links' weights count, in deflection, joint torque and K_C.
    """
    files: dict[str, bytes] = {}
    words = [
        "eval",
        robot(arm, files),
        *options(q=q, wrench=wrench, sides=sides, warming=warming, gravity=gravity),
    ]
    text = run(words, files)[1]["-"]
    return Result(run([*words, "--json=<json>"], files)[1]["<json>"], text)


def check(arm: Optional[AnyArm] = None, *, count: int = 10_000, seed: int = 0, progress: bool = True) -> Result:
    """Whether what is generated of an arm, or of every built-in one, is right: against the textbook, central differences and
    dual numbers, at `count` random postures and loads. ``agrees`` of the result says so, ``robots`` how well each output does.
    """
    files: dict[str, bytes] = {}
    words = ["check", "--all" if arm is None else robot(arm, files), *options(count=count, seed=seed), "--json=<json>"]
    _, written = run(words, files, progress)
    return Result(written["<json>"], written["-"])


def map(
    arm: AnyArm,
    over: tuple[str, str],
    of: str,
    *,
    at: Optional[Mapping[str, Quantity]] = None,
    wrench: Optional[Wrench] = None,
    length: Optional[Quantity] = None,
    data: Optional[Frame] = None,
    nuisance: Sequence[str] = (),
    noise_position: Optional[Quantity] = None,
    steps: Optional[int] = None,
    progress: bool = True,
) -> Map:
    """A quantity over two joints: numbers, and a picture (``svg``), which a notebook shows.

    over: ``("q2", "q3")``. of: ``condition``, ``nu_p``, ``nu_r``, ``deflection``, ``stiffness``, or ``shrink``, of a diagnosis of
        `data` (with `nuisance` and `noise_position`). at: where the other joints stand, ``{"q4": 0.8, "q5": "45deg"}``.
    length: m, what makes translations and rotations comparable in ``condition``. steps: values of each joint [default: 100].
    """
    files: dict[str, bytes] = {}
    words = [
        "map",
        robot(arm, files),
        *options(
            over=over, of=of, at=[f"{joint}={value}" for joint, value in (at or {}).items()], wrench=wrench, length=length,
            data=None if data is None else held(data, files), nuisance=nuisance, noise_position=noise_position, steps=steps,
        ),
        "--csv=<csv>",
        "--svg=<svg>",
    ]
    _, written = run(words, files, progress)
    return Map(written["<csv>"], written["<svg>"])


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
        *options(links=links, base=base, noise_position=noise_position, noise_rotation=noise_rotation, folds=folds, seed=seed),
        "--json=<json>",
        "--report=<page>",
        "--write-robot=<robot>",
    ]
    _, written = run(words, files, progress)
    corrected = Arm.from_toml(written["<robot>"], "<identified>")
    return Identification(written["<json>"], written["-"], written["<page>"], corrected)


def predict(arm: AnyArm, data: Frame) -> Predicted:
    """What an arm with all its effects does on the rows of a campaign or a plan: ``table``, the same rows with what is predicted
    in the place of what is measured; and where something is, how large the ``gap`` is that is left, m and rad.
    """
    files: dict[str, bytes] = {}
    words = ["predict", robot(arm, files), held(data, files), "--csv=<csv>", "--json=<json>"]
    _, written = run(words, files)
    return Predicted(written["<json>"], written["-"], Table(written["<csv>"]))


def effects(*names: str) -> list[Record]:
    """The catalogue, or some of it: of each effect what it is, its places and numbers, how it shows, what it is confused with and
    which measurement separates them.
    """
    return read_all(run(["effects", *names, "--json=<json>"], {})[1]["<json>"])


def compensate(
    arm: AnyArm,
    targets: Frame,
    *,
    wrench: Optional[Wrench] = None,
    tolerance: Optional[Quantity] = None,
    tolerance_rotation: Optional[Quantity] = None,
    starts: Optional[int] = None,
    seed: int = 0,
    progress: bool = True,
) -> Table:
    """Joint set-points at which the loaded arm stands at the targets.

    targets: ``x y z``, perhaps ``rx ry rz``, where the tool should be; perhaps ``q1 … qn``, from where to start, and loads.
    wrench: the load at all targets. tolerance, tolerance_rotation: how far from a target it may stand, m and rad [default: 1 µm and
    1 µrad]. starts: postures to start from where the first does not lead there [default: 24]. The column ``status`` of the result says ``reached``, ``nearest`` or ``unstable``.
    """
    files: dict[str, bytes] = {}
    words = [
        "compensate",
        robot(arm, files),
        *options(
            targets=held(targets, files, "<targets>"), wrench=wrench, tolerance=tolerance,
            tolerance_rotation=tolerance_rotation, starts=starts, seed=seed,
        ),
    ]
    return tabled(words, files, progress, out="out")


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
        *options(
            emit=emit, outputs=outputs, precision=precision, sines=sines, name=name, flexible=flexible, kernels=kernels,
            fused=fused, out=folder,
        ),
    ]
    written = run(words, files)[1]
    ends = {"rust": "rs", "latex": "tex", "dot": "dot", "urdf": "urdf", "mjcf": "xml"}
    plain = f"{stem}.{ends.get(emit, emit)}"
    return {plain if file == folder else os.path.basename(file): text for file, text in written.items()}


def papers(files: Sequence[Path] = ()) -> list[Record]:
    """The ledger of printed equations, an entry each: which agree, which are misprints, and what they should say."""
    return read_all(run(["papers", *(os.fspath(file) for file in files), "--json=<json>"], {})[1]["<json>"])


def import_urdf(urdf: Path, *, base: Optional[str] = None, tip: Optional[str] = None, as_written: bool = False) -> Arm:
    """The arm of a URDF: a path, or its text. Any serial chain, exactly, between the links `base` [default: the root] and
    `tip` [default: the only one on which nothing hangs].

    as_written: keep 1.5708; by default a rounding of a simple multiple of π is that multiple.
    """
    name, files = os.fspath(urdf), {}
    if name.lstrip().startswith("<"):
        name, files = "<urdf>", {"<urdf>": name.encode()}
    words = ["import", name, *options(base=base, tip=tip, as_written=as_written), "--toml=<robot>"]
    text = run(words, files)[1]["<robot>"]
    stem = os.path.splitext(os.path.basename(name.strip("<>")))[0]
    return Arm.from_toml(text, f"<{stem}>")


def measurements(
    raw: Path,
    *,
    map: Optional[Path] = None,
    sheet: Optional[str] = None,
    join: Optional[Path] = None,
    by: Optional[str] = None,
    arm: Optional[AnyArm] = None,
) -> Table:
    """A measurement file from a table as a tracker or a controller wrote it: any separator, decimal commas, xlsx, ods.

    map: a file (TOML) that says what is not found by name; join: a second table, a controller's, whose columns stand beside,
    by ``"row"``, ``"time"`` or the name of a column that both have; arm: read the result as this arm's, and refuse what could not be
    diagnosed. What was done goes to the log.
    """
    files: dict[str, bytes] = {}
    words = [
        "measurements",
        os.fspath(raw),
        *options(map=map, sheet=sheet, join=join, by=by, robot=None if arm is None else robot(arm, files)),
    ]
    return tabled(words, files)
