"""The package as a whole: what is generated, what it costs to import, what it keeps."""

import gc
import pathlib
import resource
import subprocess
import sys

import pytest
import stiffarm

PYTHON = pathlib.Path(__file__).parents[1]


def test_outputs_are_as_the_module_has_them():
    done = subprocess.run([sys.executable, PYTHON / "tools" / "outputs.py", "--check"], check=False)
    assert done.returncode == 0, "python tools/outputs.py writes them; build the wheel again"


def test_every_output_says_shape_and_unit():
    for name, sentence, *_ in stiffarm._native.outputs():
        about = getattr(stiffarm.Arm, name).__doc__
        assert sentence in about and "Result: (" in about and "q: joint values" in about


def test_what_import_takes_along(tmp_path):
    """Nothing is imported that is not needed yet: what takes time is NumPy, and who has no array has no need of it."""
    code = "import stiffarm, sys; print(*(m for m in ('numpy', 'tqdm', 'matplotlib', 'ctypes', 'pandas') if m in sys.modules))"
    # From another folder: in this one the package's source would be found before what is installed.
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True, cwd=tmp_path)
    assert done.stdout.split() == []


def test_a_typed_program():
    """Which type checkers read, too."""
    from typed import main

    main()


def memory():
    """Kilobytes that the process holds now."""
    gc.collect()
    with open("/proc/self/statm", encoding="ascii") as file:
        return int(file.read().split()[1]) * resource.getpagesize() // 1024


@pytest.mark.skipif(sys.platform != "linux", reason="reads /proc/self/statm")
@pytest.mark.parametrize("count", [300, pytest.param(10_000, marks=pytest.mark.slow)])
def test_diagnoses_keep_nothing(count):
    data = {"q1": [0.1, 0.5, 0.9, 1.3], "q2": [0.2] * 4, "fy": [-9.0] * 4, "dy": [-1e-4, -2e-4, -3e-4, -2e-4]}
    arm = stiffarm.Arm.load("lin_planar")

    def some(times):
        for _ in range(times):
            found = stiffarm.diagnose(arm, data, effects=["joint_compliance"], progress=False)
            found.to_dict(), found.corrected

    # Pools and caches are filled at first.
    some(100)
    before = memory()
    some(count)
    # A diagnosis that was kept would hold its rows, models and texts, above 20 kB; arenas may come and go.
    assert memory() - before < 4_000 + count // 2
