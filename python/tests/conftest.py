"""What tests share: the repository, and the command line that results are compared with."""

import os
import pathlib
import signal
import subprocess

import pytest

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]


@pytest.fixture(scope="session")
def repository():
    return REPOSITORY


@pytest.fixture(scope="session")
def stiffarm_program():
    """The command line: $STIFFARM, or what cargo built of it."""
    target = pathlib.Path(os.environ.get("CARGO_TARGET_DIR", REPOSITORY / "target"))
    built = [pathlib.Path(os.environ["STIFFARM"])] if "STIFFARM" in os.environ else []
    built += [target / kind / "stiffarm" for kind in ("release", "debug")]
    found = [path for path in built if path.exists()]
    if not found:
        pytest.skip("no command line: cargo build -p stiffarm-cli, or STIFFARM=…")
    return max(found, key=lambda path: path.stat().st_mtime)


@pytest.fixture
def cli(stiffarm_program, repository):
    """Runs the command line in the repository's root: what it printed, its exit status."""

    def run(*words, status=0):
        done = subprocess.run([stiffarm_program, *map(str, words)], capture_output=True, text=True, cwd=repository, check=False)
        assert done.returncode == status, done.stderr
        return done.stdout

    return run


@pytest.fixture
def at_root(repository, monkeypatch):
    """In the repository's root, where paths are those of the documentation."""
    monkeypatch.chdir(repository)


@pytest.fixture
def campaign():
    """A campaign of a KR 240-2 whose second joint is soft."""
    import stiffarm

    return stiffarm.simulate("kuka_kr240", effects=["joint_compliance@joint 2=1.5e-7"], poses=12, payload=200.0, seed=3)


@pytest.fixture
def interruptible():
    """Signals as at a terminal: what is started in the background has them ignored."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


@pytest.fixture
def said(monkeypatch):
    """What a progress bar would say, and that it is closed."""
    tqdm = pytest.importorskip("tqdm.auto")
    said = []

    class Bar:
        n = 0.0

        def __init__(self, **_):
            pass

        def set_description_str(self, what, refresh):
            said.append(what)

        def refresh(self):
            pass

        def close(self):
            said.append("closed")

    monkeypatch.setattr(tqdm, "tqdm", Bar)
    return said
