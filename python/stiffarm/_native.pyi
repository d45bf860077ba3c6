"""The extension module. What is for users is in the package's own modules."""

from collections.abc import Sequence
from typing import Any, Callable, Optional, Union, final

import numpy
from numpy.typing import ArrayLike, NDArray
from typing_extensions import Self

from .outputs import Outputs, Reals

__all__ = [
    "Arm",
    "Effect",
    "Error",
    "Found",
    "LogEffect",
    "Reading",
    "Row",
    "Samples",
    "Unstable",
    "VERSION",
    "diagnose",
    "outputs",
    "robots",
    "run",
    "settings",
]

VERSION: str

class Error(ValueError):
    """What stiffarm was given cannot be used; the message says what was found, where, and what was expected."""

    mistakes: list[tuple[str, Optional[str], Optional[str], Optional[int], Optional[int]]]

class Unstable(Error):
    """The arm has no stable equilibrium under its load."""

    first: int
    count: int

@final
class Row:
    """A joint and the link that it moves, as numbers of the table, SI: `com` and `inertia` (3, 3, about it) in the row's frame."""

    @property
    def stiffness(self) -> Optional[float]: ...
    @property
    def mass(self) -> float: ...
    @property
    def com(self) -> list[float]: ...
    @property
    def inertia(self) -> list[list[float]]: ...
    @property
    def armature(self) -> float: ...
    @property
    def coulomb(self) -> float: ...
    @property
    def viscous(self) -> float: ...

class Arm(Outputs):
    def __new__(cls, given: str, text: Optional[bytes], set: Sequence[str], hear: Callable[..., None]) -> Self: ...
    @property
    def name(self) -> str: ...
    @property
    def dof(self) -> int: ...
    @property
    def given(self) -> str: ...
    @property
    def built_in(self) -> bool: ...
    @property
    def toml(self) -> str: ...
    @property
    def joint_names(self) -> list[str]: ...
    @property
    def joint_types(self) -> list[str]: ...
    @property
    def rows(self) -> list[Row]: ...
    @property
    def limits(self) -> list[Optional[list[float]]]: ...
    @property
    def effects(self) -> list[tuple[str, str]]: ...
    @property
    def places(self) -> list[str]: ...
    def engine(self, output: str, at: Optional[str] = None) -> str: ...
    def c_source(self) -> str: ...
    def load_c(self, path: Any) -> None: ...
    def branches(
        self,
        pose: ArrayLike,
        near: Optional[ArrayLike] = None,
        wrench: Optional[Sequence[float]] = None,
        sides: Optional[ArrayLike] = None,
        warming: Optional[float] = None,
        kept: Optional[str] = None,
        elbow_angle: Optional[float] = None,
    ) -> tuple[NDArray[numpy.float64], NDArray[numpy.float64], NDArray[numpy.float64], NDArray[numpy.bool_], list[str]]: ...
    def evaluate(
        self,
        output: str,
        inputs: Sequence[ArrayLike],
        wrench: Optional[ArrayLike] = None,
        out: Optional[Reals] = None,
        sides: Optional[ArrayLike] = None,
        warming: Optional[float] = None,
        at: Optional[str] = None,
    ) -> Reals:
        """An output by its name."""

    def gravity(
        self, q: ArrayLike, *,
        out: Optional[Reals] = None, sides: Optional[ArrayLike] = None, warming: Optional[float] = None, at: Optional[str] = None,
    ) -> Reals:
        """Torques that hold the arm at rest under its weight, (n,): :meth:`inverse_dynamics` where nothing moves."""

@final
class Reading:
    """What an effect of one's own sees of a row."""

    @property
    def q(self) -> NDArray[numpy.float64]: ...
    @property
    def wrench(self) -> NDArray[numpy.float64]: ...
    @property
    def direction(self) -> Optional[list[int]]: ...
    @property
    def warming(self) -> float: ...
    @property
    def time(self) -> Optional[float]: ...
    @property
    def index(self) -> int: ...
    @property
    def number(self) -> int: ...

@final
class Effect:
    """An effect of one's own on measurements at rest."""

    @property
    def name(self) -> str: ...

    def __new__(
        cls,
        name: str,
        place: str,
        parameters: Sequence[tuple[str, str]],
        change: Callable[[Reading, NDArray[numpy.float64]], Any],
    ) -> Self: ...

@final
class Samples:
    """What an effect of one's own sees of a stretch of a log: m samples at even steps, low-passed."""

    @property
    def t(self) -> NDArray[numpy.float64]: ...
    @property
    def q(self) -> NDArray[numpy.float64]: ...
    @property
    def qd(self) -> NDArray[numpy.float64]: ...
    @property
    def qdd(self) -> NDArray[numpy.float64]: ...
    @property
    def load(self) -> NDArray[numpy.float64]: ...
    @property
    def number(self) -> int: ...

@final
class LogEffect:
    """An effect of one's own on a joint in motion."""

    @property
    def name(self) -> str: ...
    def __new__(
        cls,
        name: str,
        rows: str,
        parameters: Sequence[tuple[str, str]],
        change: Callable[[Samples, NDArray[numpy.float64]], ArrayLike],
        about: Sequence[Sequence[float]] = ...,
    ) -> Self: ...

@final
class Found:
    def json(self) -> str: ...
    def page(self) -> str: ...
    def text(self) -> str: ...
    def corrected(self) -> Optional[str]: ...
    def caveats(self) -> list[str]: ...
    def certificate(self) -> bytes: ...
    def exported(self, mjcf: bool) -> tuple[str, Optional[str]]: ...
    def predict(self, paths: list[str], files: dict[str, bytes], hear: Callable[..., None]) -> tuple[Any, ...]: ...

def diagnose(
    named: tuple[str, list[str]],
    data: list[str],
    settings: str,
    files: dict[str, bytes],
    own: list[Union[Effect, LogEffect]],
    hear: Callable[..., None],
) -> Found: ...
def settings() -> list[tuple[str, str, str]]: ...
def run(words: list[str], files: dict[str, bytes], hear: Callable[..., None]) -> tuple[bool, dict[str, bytes]]: ...
def outputs() -> list[tuple[str, str, str, list[tuple[str, str]], bool, str]]: ...
def robots() -> list[str]: ...
