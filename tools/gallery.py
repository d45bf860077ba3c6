#!/usr/bin/env python3
"""Draws docs/gallery: the tops of reports of real diagnoses, by Chromium.

    tools/gallery.py             all that can be drawn here
    tools/gallery.py lin ur10    these

The campaigns and logs of docs/gallery.md are not part of the repository: $STIFFARM_DATA is the folder that holds them, as in
the tests that use them [default: ../shared/data]. $STIFFARM is the command [default: target/release/stiffarm].
"""

import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "web"))
from browser import Browser  # noqa: E402

DATA = Path(os.environ.get("STIFFARM_DATA", ROOT / "../shared/data")).resolve()
STIFFARM = os.environ.get("STIFFARM", str(ROOT / "target/release/stiffarm"))

# The robot and the words behind it.
REPORTS = {
    "lin": ["lin_planar", ROOT / "robots/data/lin1991_table3.csv", "--rival", "ycd", "--rival", "ytd"],
    "ur10": [DATA / "ur10/robot.toml", DATA / "ur10/campaign_c.csv", "--nuisance", "base_frame,tool_frame"],
    "sockets": [
        "panda", DATA / "sockets/panda_1/front.csv", "--bench", DATA / "sockets/panda_1/bench.toml",
        "--nuisance", "tool_frame", "--check", DATA / "sockets/panda_1/right.csv",
    ],
    "tx40": [DATA / "logs/tx40.urdf", DATA / "logs/tx40.csv"],
    "so101": [ROOT / "cli/tests/cli/log/so101.toml", DATA / "logs/so101.csv"],
}
WIDTH, HEIGHT = 1000, 1040


def main():
    wanted = sys.argv[1:] or list(REPORTS)
    if unknown := set(wanted) - REPORTS.keys():
        sys.exit(f"error: found {', '.join(sorted(unknown))}, expected some of {', '.join(REPORTS)}")
    folder = ROOT / "docs/gallery"
    folder.mkdir(exist_ok=True)
    with tempfile.TemporaryDirectory() as made, Browser() as browser:
        browser.size(WIDTH, HEIGHT)
        browser.call("Emulation.setScrollbarsHidden", hidden=True)
        for name in wanted:
            if missing := [path for path in REPORTS[name] if isinstance(path, Path) and not path.exists()]:
                print(f"{name}: no {missing[0]}, set STIFFARM_DATA")
                continue
            # Beside each other, so that a report names no folder.
            for path in REPORTS[name]:
                if isinstance(path, Path):
                    shutil.copy(path, made)
            words = [word.name if isinstance(word, Path) else word for word in REPORTS[name]]
            report = Path(made) / f"{name}.html"
            command = [STIFFARM, "--quiet", "diagnose", *words, "--report", report.name]
            subprocess.run(command, check=True, stdout=subprocess.DEVNULL, cwd=made)
            browser.open(report.as_uri(), "document.readyState === 'complete'")
            browser.screenshot(folder / f"{name}.png")
            print(f"{name}: {(folder / f'{name}.png').stat().st_size:,} bytes")


if __name__ == "__main__":
    main()
