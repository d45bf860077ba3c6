#!/usr/bin/env python3
"""Tests the page in a headless Chromium: its answers are the command's, and it asks nothing of a network.

    web/test.py PAGE       $STIFFARM is the command [default: target/release/stiffarm, else target/debug/stiffarm]

Screenshots at 400 and 1,400 pixels, light and dark, stay beside the page.
"""

import gzip
import json
import os
import re
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from browser import Browser

ROOT = Path(__file__).resolve().parent.parent
LIN = ROOT / "robots/data/lin1991_table3.csv"
WORKBENCH = ROOT / "docs/workbench"


def command(words, folder):
    """What the command line writes to standard output, or the error that it prints; and the seconds that it took."""
    built = [ROOT / "target" / profile / "stiffarm" for profile in ("release", "debug")]
    program = os.environ.get("STIFFARM") or next((str(path) for path in built if path.exists()), None)
    if not program:
        sys.exit("error: found no stiffarm\n       help: cargo build --release, or set $STIFFARM")
    begun = time.monotonic()
    ran = subprocess.run([program, *words], cwd=folder, capture_output=True, text=True)
    return (ran.stdout if ran.returncode in (0, 1) else ran.stderr), time.monotonic() - begun


class Page:
    """The page as a reader uses it."""

    def __init__(self, browser, page):
        self.browser, self.url = browser, page.resolve().as_uri()

    def fresh(self):
        self.browser.open(self.url, "document.documentElement?.dataset.ready === 'yes'")

    def choose(self, id, value):
        self.browser.evaluate(f"at('{id}').value = {value!r}; at('{id}').dispatchEvent(new Event('change'))")

    def robot(self, robot):
        if isinstance(robot, Path):
            self.browser.files("#robot-file", robot)
            self.browser.wait("chosen.robot?.bytes && !end")
        else:
            self.choose("built-in", robot)

    def data(self, path):
        self.browser.files("#data-file", path)
        self.browser.wait(f"chosen.data?.name === {path.name!r} && !end")
        # Its columns are read by a command.
        self.browser.wait("!at('columns').hidden || at('state').textContent")

    def bench(self, path):
        self.browser.files("#bench-file", path)
        self.browser.wait(f"chosen.bench?.name === {path.name!r}")

    def diagnose(self, options="", patience=300):
        self.browser.evaluate(f"at('options').value = {options!r}; at('state').textContent = ''; at('diagnose').focus()")
        begun = time.monotonic()
        self.browser.press("Enter", "\r")
        self.browser.wait("at('state').textContent && at('work').hidden", patience)
        return time.monotonic() - begun

    def state(self):
        return self.browser.evaluate("at('state').textContent")

    def written(self, name):
        return self.browser.evaluate(f"shown.answer.written.get({name!r})")


# Sines, logarithms and products of matrices are the processor's in the command, and WebAssembly's here. They round
# differently in their last bits, and fits carry that on: findings agree to six digits. Shares of what is small, and the
# order of explanations that are equally good, are left to the last bits.
CLOSE, SHARES = 1e-6, 1e-4
EXACT = re.compile(r"^\.(gap|findings\[\d+\]\.(parameters|held_out|p_value|effect|place))")


def by_name(values):
    """Entries that name an effect and a place, by these names."""
    named = all(isinstance(value, dict) and "effect" in value and "place" in value for value in values)
    key = lambda value: json.dumps([value[name] for name in ("effect", "place", "form") if name in value])
    return sorted(values, key=key) if named else values


def differences(got, told, path=""):
    """Where two answers differ by more than rounding does."""
    if isinstance(told, dict) and isinstance(got, dict) and list(got) == list(told):
        for key in told:
            yield from differences(got[key], told[key], f"{path}.{key}")
    elif isinstance(told, list) and isinstance(got, list) and len(got) == len(told):
        ordered = path == ".findings"
        for k, pair in enumerate(zip(*(value if ordered else by_name(value) for value in (got, told)))):
            yield from differences(*pair, f"{path}[{k}]")
    elif isinstance(told, float) and isinstance(got, float):
        apart, size = abs(got - told), max(abs(got), abs(told))
        if apart > CLOSE * size and (EXACT.match(path) or apart > SHARES):
            yield f"{path}: {got} for {told}"
    elif path == ".corrected":
        yield from robots(got, told)
    elif got != told:
        yield f"{path}: {got!r} for {told!r}"


def robots(got, told):
    """The same of robot files: the words between numbers, and the numbers of an entry, measured by the largest of them: a
    product of inertia is what is left of a rotated tensor, and rounded as that is."""
    number = re.compile(r"-?\d+\.?\d*(?:[eE][+-]?\d+)?")
    if number.split(got) != number.split(told):
        yield "the robot file has other words"
    for ours, theirs in zip(got.splitlines(), told.splitlines()):
        pairs = [(float(a), float(b)) for a, b in zip(number.findall(ours), number.findall(theirs))]
        for a, b in pairs:
            size = abs(b) if theirs.startswith("#") else max(abs(value) for _, value in pairs)
            if abs(a - b) > CLOSE * size:
                yield f"the robot file: {ours} for {theirs}"


def same(page, folder, robot, data, options="", bench=None):
    """The page and the command write the same JSON and robot file; returns both times."""
    page.fresh()
    page.robot(robot)
    page.data(data)
    if bench:
        page.bench(bench)
    seconds = page.diagnose(options)
    assert page.state().startswith("Done"), page.state()
    name = robot.name if isinstance(robot, Path) else robot
    words = ["diagnose", name, data.name, *options.split(), "--json", "json", "--write-robot", "robot"]
    words += ["--bench", bench.name] if bench else []
    _, spent = command(words, folder)
    told, got = (folder / "json").read_text(), page.written("<json")
    found = list(differences(json.loads(got), json.loads(told)))
    found += robots(page.written("<robot"), (folder / "robot").read_text())
    assert not found, f"{data.name}: {len(found)} differences: {found[:5]}"
    answer = "bytes" if got == told else "answer"
    print(f"{data.name}: the command's {answer}; {seconds:.2f} s here, {spent:.2f} s there")
    return seconds, spent


def refused(page, folder, robot, data, words):
    """What cannot be read is said as the command says it."""
    page.fresh()
    page.robot(robot)
    page.data(data)
    wrong = "at('state').classList.contains('wrong')"
    if not page.browser.evaluate(wrong):
        page.diagnose()
    told, _ = command(words, folder)
    first = next(line for line in told.splitlines() if line.startswith("error"))
    assert first in page.state(), f"expected {first!r}, found {page.state()!r}"
    assert page.browser.evaluate(wrong)


def main():
    if len(sys.argv) != 2:
        sys.exit("error: found other arguments, expected PAGE")
    file = Path(sys.argv[1])
    loaded = len(gzip.compress(file.read_bytes(), 9))
    assert loaded <= 3_000_000, f"{loaded:,} bytes are loaded over a network, 3,000,000 are allowed"
    with tempfile.TemporaryDirectory() as folder, Browser() as browser:
        folder = Path(folder)
        for path in (LIN, *(WORKBENCH / name for name in ("arm.toml", "check.csv", "raw.txt", "readings.csv"))):
            (folder / path.name).write_bytes(path.read_bytes())
        page = Page(browser, file)

        # By keyboard alone: the first example is the first thing that Tab reaches.
        browser.size(1400, 900)
        page.fresh()
        browser.press("Tab")
        assert browser.evaluate("document.activeElement.dataset.example") == "lin"
        browser.press("Enter", "\r")
        browser.wait("at('state').textContent.startsWith('Done')")
        told, _ = command(["diagnose", "lin_planar", LIN.name, "--rival", "ycd", "--rival", "ytd", "--json", "-"], folder)
        assert page.written("<json") == told
        browser.screenshot(file.with_name("lin.png"))

        same(page, folder, "lin_planar", folder / LIN.name, "--rival ycd --rival ytd")
        browser.evaluate("window.saved = []; download = (name, text) => window.saved.push([name, text])")
        for what, name, holds in (("c", "corrected.c", "void"), ("urdf", "corrected.urdf", "<robot"), ("report", "report.html", "</html>")):
            browser.evaluate(f"document.querySelector('[data-save={what}]').click()")
            browser.wait(f"window.saved.some(([name]) => name === {name!r})")
            assert browser.evaluate(f"window.saved.find(([n]) => n === {name!r})[1].includes({holds!r})"), name
        same(page, folder, folder / "arm.toml", folder / "check.csv")

        # A campaign of 300 rows, and a log.
        words = ["simulate", "kuka_kr240", "--poses", "100", "--payload", "200kg", "--effect", "joint_compliance@joint 2=1.5e-7"]
        command([*words, "--noise-position", "30um", "--seed", "1", "--withhold", "--csv", "campaign.csv"], folder)
        here, there = same(page, folder, "kuka_kr240", folder / "campaign.csv", "--noise-position 30um")
        print(f"300 rows: {here / there:.1f} times the command's time")
        (folder / "kr240.urdf").write_bytes((ROOT / "tests/data/urdf/kr240.urdf").read_bytes())
        command(["simulate", "kr240.urdf", *words[2:-1], "transmission_error@joint 3:cos 2=0.2mrad", "--csv", "urdf.csv"], folder)
        same(page, folder, folder / "kr240.urdf", folder / "urdf.csv")
        command(["simulate", "panda", "--log", "log.csv", "--runs", "1", "--effect", "coulomb_friction@joint 1=5"], folder)
        same(page, folder, "panda", folder / "log.csv", "--torque-side motor")

        # Sockets whose distance a bench file says; a file that is none is refused.
        words = ["simulate", "irb120", "--measure", "point", "--poses", "24", "--payload", "0kg"]
        command([*words, "--effect", "joint_offset@joint 3=4e-3", "--csv", "sockets.csv"], folder)
        pair = '[[pair]]\npoints = ["socket 0.1", "socket 0.2"]\ndistance = "1 m"\nsigma = "1 m"\n'
        (folder / "bench.toml").write_text(pair)
        same(page, folder, "irb120", folder / "sockets.csv", bench=folder / "bench.toml")
        assert "--bench bench.toml" in browser.evaluate("at('command').textContent")
        browser.evaluate("at('no-bench').click()")
        browser.wait("!chosen.bench && at('no-bench').hidden")
        (folder / "bench.toml").write_text('[[socket]]\nname = "a"\n')
        page.bench(folder / "bench.toml")
        page.diagnose()
        assert "found no bench" in page.state(), page.state()

        # A table of another program: a changed column becomes a map.
        page.fresh()
        page.robot(folder / "arm.toml")
        page.data(folder / "raw.txt")
        browser.evaluate("""(() => {
            const row = [...at('rows').rows].find((row) => row.cells[0].textContent.startsWith('T_Halle'));
            row.querySelector('input').value = 'temperature';
            row.querySelector('input').dispatchEvent(new Event('change'));
        })()""")
        browser.wait("at('map').textContent.includes('temperature = { column = \"T_Halle\" }') && !end")

        # Wrong files.
        (folder / "wrong.toml").write_text('name = "x"\n[[joint]]\ntype = "bent"\n')
        refused(page, folder, folder / "wrong.toml", folder / "check.csv", ["diagnose", "wrong.toml", "check.csv"])
        (folder / "ragged.csv").write_text("q1,q2,dy\n0.1,0.2\n")
        refused(page, folder, "lin_planar", folder / "ragged.csv", ["measurements", "ragged.csv"])

        # The other examples are simulated in the page.
        named = {"kr240": "transmission_error", "sockets": "joint_offset", "panda": "viscous_friction"}
        for example, finding in named.items():
            page.fresh()
            browser.evaluate(f"document.querySelector('[data-example={example}]').click()")
            browser.wait("at('state').textContent && !end && at('work').hidden", 120)
            assert page.state().startswith("Done"), page.state()
            assert finding in [found["effect"] for found in json.loads(page.written("<json"))["findings"]], example

        # A long search can be ended.
        page.fresh()
        browser.evaluate("document.querySelector('[data-example=kr240]').click()")
        browser.wait("!at('work').hidden && at('doing').textContent", 120)
        browser.evaluate("at('cancel').click()")
        browser.wait("at('state').textContent === 'Cancelled.' && at('work').hidden")

        # Narrow and wide, light and dark: nothing is cut.
        for width in (400, 1400):
            for scheme in ("light", "dark"):
                browser.size(width, 900, scheme)
                page.fresh()
                page.robot(folder / "arm.toml")
                page.data(folder / "raw.txt")
                wide = browser.evaluate("document.scrollingElement.scrollWidth")
                assert wide <= width, f"{wide} pixels at a width of {width}"
                browser.screenshot(file.with_name(f"{width}_{scheme}.png"))

        assert not browser.requested(), browser.requested()
        assert not browser.problems(), browser.problems()
    print("the page answers as the command does")


if __name__ == "__main__":
    main()
