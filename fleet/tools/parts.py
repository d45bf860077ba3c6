"""What `proof` and `measure` are made of: programs, campaigns, clusters."""

import os
import pathlib
import random
import socket
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent.parent
ROBOTS = {"kuka_kr240": "200kg", "ur10": "10kg", "irb120": "3kg"}
OPTIONS = "--noise-position 30um --noise-rotation 0.005deg"


def called(words, **more):
    """What a program prints."""
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True, **more)
    if done.returncode:
        sys.exit(f"{' '.join(map(str, words))}\n{done.stderr}")
    return done.stdout


def built(package, name, *more):
    """A program of a package, built for release."""
    called(["cargo", "build", "--release", "--manifest-path", package / "Cargo.toml", *more])
    target = pathlib.Path(os.environ.get("CARGO_TARGET_DIR", package / "target"))
    return (target / "release" / name).resolve()


def effects(draw):
    """One to three effects."""
    kinds = [
        lambda: f"joint_offset@joint {draw.randint(2, 5)}={draw.uniform(0.1, 0.5):.3f} mrad",
        lambda: f"backlash@joint {draw.randint(1, 6)}={draw.uniform(0.1, 0.4):.3f} mrad",
        lambda: f"joint_compliance@joint {draw.randint(2, 3)}={draw.uniform(0.5, 3):.3f}e-7",
        lambda: f"joint_ratio@joint {draw.randint(2, 5)}={draw.uniform(1, 4):.3f}e-4",
    ]
    return [kind() for kind in draw.sample(kinds, draw.randint(1, 3))]


def simulated(stiffarm, number):
    """A campaign of 120 rows: its robot and its file."""
    draw = random.Random(number)
    robot = list(ROBOTS)[number % len(ROBOTS)]
    words = [stiffarm, "simulate", robot, "--poses", 40, "--payload", ROBOTS[robot], "--seed", number, "--quiet"]
    words += [word for effect in effects(draw) for word in ("--effect", effect)]
    text = called([*words, "--noise-position", "30um", "--withhold", "--csv", "-"])
    return robot, "".join(line for line in text.splitlines(True) if not line.startswith("#"))


def tabled(folder, number, robot, text):
    """A campaign's file among those of a table of runs, in a folder of its arm; the names of its columns."""
    head, *rows = text.splitlines()
    own = folder / "runs" / f"arm={number:04}"
    own.mkdir(parents=True, exist_ok=True)
    # Where rows stand in a table is nobody's promise.
    random.Random(number).shuffle(numbered := list(enumerate(rows)))
    lines = [f"robot,row,{head}", *(f"{robot},{row},{line}" for row, line in numbered)]
    (own / "run.csv").write_text("\n".join(lines) + "\n")
    return head.split(",")


def query(columns):
    """Every campaign's diagnosis."""
    given = ", ".join(["row", *(f'"{name}"' for name in columns)])
    return (
        f"SELECT arm, found['json'] AS json, found['error'] AS error FROM (SELECT arm, diagnose(robot || ' {OPTIONS}', "
        f"{given}) AS found FROM runs GROUP BY arm)"
    )


def asked(fleet, sql, *more):
    """A query that is being answered."""
    words = [fleet, "sql", sql, "--format", "json", *more]
    return subprocess.Popen([str(word) for word in words], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


def answered(process):
    """Its answer."""
    out, err = process.communicate()
    if process.returncode:
        sys.exit(err)
    return out


def room(words):
    """The processor's seconds that a program took, and the most memory that it had, MiB."""
    process = subprocess.Popen([str(word) for word in words], stdout=subprocess.DEVNULL)
    _, status, used = os.wait4(process.pid, 0)
    if status:
        sys.exit(f"{words}: {status}")
    return used.ru_utime + used.ru_stime, used.ru_maxrss / 1024


def free():
    """A port that nobody has."""
    with socket.socket() as first:
        first.bind(("127.0.0.1", 0))
        return first.getsockname()[1]


class Cluster:
    """A scheduler and executors of one core each; ends with its block."""

    def __init__(self, fleet, folder, executors, **more):
        self.port = free()
        self.work = [folder / f"work{k}" for k in range(executors)]
        quiet = {"stderr": subprocess.DEVNULL, **more}
        self.parts = [subprocess.Popen([fleet, "scheduler", "--port", str(self.port)], **quiet)]
        for work in self.work:
            work.mkdir(exist_ok=True)
            words = [fleet, "executor", "--scheduler", f"127.0.0.1:{self.port}", "--port", str(free()), "--cores", "1"]
            self.parts.append(subprocess.Popen([*words, "--work-dir", str(work)], **quiet))

    def __enter__(self):
        return self

    def __exit__(self, *_):
        for part in self.parts:
            part.kill()
            part.wait()

    def on(self):
        """The option that asks this cluster."""
        return ["--cluster", f"df://127.0.0.1:{self.port}"]
