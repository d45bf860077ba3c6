"""The diagnosis of an arm: why it is not where its model says, and how far the gap shrinks."""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any, Optional, Union

from . import _native
from .arm import Arm
from .prediction import Prediction, prediction
from .record import Record, read
from .result import framed
from .run import AnyArm, robot
from .settings import Settings
from .table import NAME, Frame, held
from .words import Path, Progress, log, plain, signed

if TYPE_CHECKING:
    from matplotlib.figure import Figure
    from typing_extensions import Unpack

#: An effect of one's own, at rest or in motion.
Own = Union[_native.Effect, _native.LogEffect]


class Kept:
    """What of a diagnosis is kept by a pickle or a copy: everything that is told, without the data and the search.

    It predicts no other rows: ``found.corrected`` does, as an arm (:func:`stiffarm.predict`).
    """

    def __init__(self, told: dict[str, Any]) -> None:
        self._told = told

    @classmethod
    def of(cls, found: _native.Found) -> Kept:
        """Everything that is told of a diagnosis; what cannot be is kept as its error."""
        each: dict[str, Callable[[], Any]] = {
            "json": found.json,
            "page": found.page,
            "text": found.text,
            "corrected": found.corrected,
            "caveats": found.caveats,
            "certificate": found.certificate,
            "mjcf": lambda: found.exported(True),
            "urdf": lambda: found.exported(False),
        }
        told: dict[str, Any] = {}
        for name, tell in each.items():
            try:
                told[name] = tell()
            except _native.Error as error:
                told[name] = ValueError(str(error))
        return cls(told)

    def _get(self, name: str) -> Any:
        if isinstance(self._told[name], Exception):
            raise self._told[name]
        return self._told[name]

    def json(self) -> str:
        return str(self._get("json"))

    def page(self) -> str:
        return str(self._get("page"))

    def text(self) -> str:
        return str(self._get("text"))

    def corrected(self) -> Optional[str]:
        text: Optional[str] = self._get("corrected")
        return text

    def caveats(self) -> list[str]:
        return list(self._get("caveats"))

    def certificate(self) -> bytes:
        return bytes(self._get("certificate"))

    def exported(self, mjcf: bool) -> tuple[str, Optional[str]]:
        text, lost = self._get("mjcf" if mjcf else "urdf")
        return text, lost

    def predict(self, *_: Any) -> Any:
        raise ValueError("a diagnosis that was pickled or copied has no data to predict with: use stiffarm.predict(found.corrected, ...)")


class Diagnosis:
    """What a diagnosis found; ``str`` of it is the command line's screen, and a notebook shows its page.

    The keys of the command line's JSON are attributes: ``findings``, ``gap``, ``where``, ``cannot_see``, ``unexplained``,
    ``stopped`` of a campaign; ``findings``, ``gap`` joint by joint, ``evidence`` and more of a log. Of a campaign and a log
    together both stand in ``campaign`` and ``log``, what they say of the springs that both see in ``together``, and ``findings``
    are the campaign's, then the log's.
    """

    def __init__(self, found: Union[_native.Found, Kept]) -> None:
        self._found = found
        self._dict: Optional[Record] = None

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        return getattr(self.to_dict(), name)

    def __reduce__(self) -> tuple[Any, ...]:
        return Diagnosis, (self._found if isinstance(self._found, Kept) else Kept.of(self._found),)

    def __str__(self) -> str:
        return self._found.text()

    __repr__ = __str__

    def to_json(self) -> str:
        """The JSON, to the byte as the command line writes it."""
        return self._found.json()

    def to_dict(self) -> Record:
        """The same as dictionaries and lists, whose keys are attributes too."""
        if self._dict is None:
            self._dict = read(self.to_json())
        return self._dict

    @property
    def parts(self) -> list[Record]:
        """The diagnosis itself; of a campaign and a log together that of each."""
        told = self.to_dict()
        return [told.campaign, told.log] if "together" in told else [told]

    @property
    def findings(self) -> list[Record]:
        """What was found, in the order in which it was added."""
        return [finding for part in self.parts for finding in part.findings]

    @property
    def base_parameters(self) -> list[Record]:
        """Of a log of torques the links' base parameters as they are fitted: ``name``, ``sum``, ``value``, ``unit``, ``ci95`` and
        ``in_file`` of each; their covariance is ``rigid.covariance``. Empty where none are fitted."""
        return [one for part in self.parts if "rigid" in part for one in part.rigid.parameters]

    @property
    def stopped(self) -> bool:
        """Whether the search was told to stop before its end."""
        return any(part.get("stopped", False) for part in self.parts)

    @property
    def sets(self) -> list[frozenset[tuple[str, str]]]:
        """For each finding the effects and places that this data cannot tell from it, itself among them."""

        def names(finding: Record) -> frozenset[tuple[str, str]]:
            others = [a for a in finding.get("alternatives", []) if not a.get("separable", False)]
            return frozenset((str(one["effect"]), str(one["place"])) for one in [finding, *others])

        return [names(finding) for finding in self.findings]

    @property
    def shrink(self) -> tuple[float, tuple[float, float]]:
        """The part of the gap that the findings remove on rows that no fit has seen, and its 95 % interval.

        Of a log the mean of the joints, each in its own size; of a campaign and a log together that of the campaign.
        """
        part = self.parts[0]
        told = part["shrink"] if "shrink" in part else part["gap"]["shrink"]
        low, high = told["shrink_ci95"]
        return told["shrink"], (low, high)

    @property
    def corrected(self) -> Arm:
        """The arm with all that was found; what has to be known of it goes to the log."""
        text = self._found.corrected()
        if text is None:
            raise ValueError("a log of currents corrects no robot file: it tells no newton-metres")
        self._warn()
        return Arm.from_toml(text, "<corrected>")

    def to_mjcf(self, path: Optional[Path] = None) -> str:
        """The corrected arm for MuJoCo, as ``--write-mjcf`` writes it; what it has no place for goes to the log."""
        return self._exported(True, path)

    def to_urdf(self, path: Optional[Path] = None) -> str:
        """The corrected arm as a URDF, as ``--write-urdf`` writes it; what it has no place for goes to the log."""
        return self._exported(False, path)

    def _exported(self, mjcf: bool, path: Optional[Path]) -> str:
        text, lost = self._found.exported(mjcf)
        if lost is not None:
            log.warning("%s", lost)
        self._warn()
        if path is not None:
            with open(path, "w", encoding="utf-8") as file:
                file.write(text)
        return text

    def _warn(self) -> None:
        for caveat in self._found.caveats():
            log.warning("%s", caveat)

    def predict(self, data: Union[Frame, Sequence[Frame]]) -> Prediction:
        """The gaps of other measurements of the arm, or of another log, before and after; nothing is fitted to it.

        Of a log, or a list of its runs, it is a :class:`LogPrediction`.
        """
        files: dict[str, bytes] = {}
        names = _named(data, files)
        with Progress(False) as hear:
            return prediction(self._found.predict(names, files, hear))

    def to_html(self, path: Optional[Path] = None) -> str:
        """The page that the command line writes with ``--report``; written to `path` too, if there is one."""
        page = self._found.page()
        if path is not None:
            with open(path, "w", encoding="utf-8") as file:
                file.write(page)
        return page

    def to_pdf(self, path: Optional[Path] = None) -> bytes:
        """The certificate that the command line writes with ``--certificate``: one sheet; written to `path` too, if there is one."""
        sheet = self._found.certificate()
        if path is not None:
            with open(path, "wb") as file:
                file.write(sheet)
        return sheet

    def _repr_html_(self) -> str:
        return framed(self._found.page(), str(self))

    def plot(self) -> Figure:
        """The gap of every row before and after, and each finding with its interval (``pip install stiffarm[plot]``)."""
        from .plot import diagnosis

        return diagnosis(self)


@signed(Settings)
def diagnose(
    arm: AnyArm,
    data: Union[Frame, Sequence[Frame]],
    *,
    own: Sequence[Own] = (),
    check: Optional[Frame] = None,
    compare: Union[None, Path, Diagnosis] = None,
    set: Sequence[str] = (),
    progress: bool = True,
    **settings: Unpack[Settings],
) -> Diagnosis:
    """Why the real arm is not where the model says, at rest or in motion.

    data: measurements or a joint log: a path, a dictionary of arrays, or a table of pandas, polars or pyarrow; or a
        list of these, the runs of one log, with measurements of the same arm among them or not. Columns are those of the command line: readings ``q1 … qn`` (or ``q``, (m, n)), the wrench ``fx … mz``
        (or ``wrench``, (m, 6)), and what was measured, ``x y z rx ry rz`` or ``dx …``; units in brackets, ``x[mm]``.
    own: effects of one's own, tried beside the others: ``Effect`` of measurements, ``LogEffect`` of logs.
    check: another campaign or log to predict; compare: an earlier diagnosis.
    The other keywords are :class:`stiffarm.settings.Settings`, options of ``stiffarm diagnose``: a length is in m or ``"30um"``,
        an angle in rad or ``"0.02deg"``, a frequency in Hz or ``"50Hz"``.

    Ctrl-C ends it. Raises Error, with the place, of what cannot be used.
    """
    files: dict[str, bytes] = {}
    chosen = {name: value for name, value in settings.items() if value is not None}
    if "effects" in chosen:
        chosen["effects"] = [*(settings["effects"] or ()), *(effect.name for effect in own)]
    if check is not None:
        chosen["check"] = held(check, files, "<check>")
    if compare is not None:
        chosen["compare"] = _last(compare, files)
    named = (robot(arm, files), list(set))
    with Progress(progress) as hear:
        return Diagnosis(_native.diagnose(named, _named(data, files), json.dumps(chosen, default=plain), files, list(own), hear))


def _named(data: Union[Frame, Sequence[Frame]], files: dict[str, bytes]) -> list[str]:
    """The words for one frame or several."""
    frames = data if isinstance(data, (list, tuple)) else [data]
    return [held(frame, files, f"<data {k + 1}>" if len(frames) > 1 else NAME) for k, frame in enumerate(frames)]


def _last(compare: Union[Path, Diagnosis], files: dict[str, bytes]) -> Path:
    if not isinstance(compare, Diagnosis):
        return compare
    files["<last>"] = compare.to_json().encode()
    return "<last>"
