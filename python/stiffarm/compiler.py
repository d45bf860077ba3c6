"""C for an arm, compiled by the machine's compiler once, and kept."""

from __future__ import annotations

import hashlib
import os
import pathlib
import platform
import shlex
import shutil
import subprocess
import sys
import tempfile
from typing import TYPE_CHECKING, Optional

from .words import Path, log

if TYPE_CHECKING:
    from .arm import Arm

#: Products are not fused into sums: the bits are those of the Rust kernels.
_FLAGS = ["-std=c99", "-O2", "-ffp-contract=off", "-shared"] + ([] if os.name == "nt" else ["-fPIC"])

#: An output that says what is in use.
_SHOWN = "jacobian"


def compiled(arm: Arm, compiler: Optional[str], cache: Optional[Path]) -> str:
    """Compiles, compares and takes C for the arm; the engine that is in use then."""
    command = _command(compiler)
    if command is None:
        log.warning("found no C compiler: %s stays in use; $CC names one", arm.engine(_SHOWN))
        return arm.engine(_SHOWN)
    text = arm.c_source()
    about = "\0".join([text, *command, *_FLAGS, _version(command), platform.machine(), sys.platform])
    end = ".dll" if os.name == "nt" else ".so"
    library = pathlib.Path(cache or _cache()) / (hashlib.sha256(about.encode()).hexdigest() + end)
    if not library.exists():
        _make(command, text, library)
    arm.load_c(library)
    return arm.engine(_SHOWN)


def _command(compiler: Optional[str]) -> Optional[list[str]]:
    asked = compiler or os.environ.get("CC")
    if asked:
        words = shlex.split(asked)
        if shutil.which(words[0]) is None:
            raise ValueError(f"found no compiler {words[0]!r}, expected a command: gcc, clang")
        return words
    return next(([name] for name in ("cc", "gcc", "clang") if shutil.which(name)), None)


def _version(command: list[str]) -> str:
    return subprocess.run([*command, "--version"], capture_output=True, text=True, check=False).stdout


def _cache() -> pathlib.Path:
    base = os.environ.get("LOCALAPPDATA" if os.name == "nt" else "XDG_CACHE_HOME")
    return (pathlib.Path(base) if base else pathlib.Path.home() / ".cache") / "stiffarm"


def _make(command: list[str], text: str, library: pathlib.Path) -> None:
    library.parent.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(dir=library.parent) as folder:
        source, made = pathlib.Path(folder) / "arm.c", pathlib.Path(folder) / library.name
        source.write_text(text, encoding="utf-8")
        done = subprocess.run(
            [*command, *_FLAGS, "-o", str(made), str(source), *([] if os.name == "nt" else ["-lm"])],
            capture_output=True,
            text=True,
            check=False,
        )
        if done.returncode:
            raise ValueError(f"{shlex.join(command)} does not compile the arm's kernels:\n{done.stderr}")
        # In one step: another process finds the whole library, or none.
        os.replace(made, library)
