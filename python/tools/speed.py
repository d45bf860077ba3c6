"""How fast arms are in Python, in one run: a million Jacobians beside Rust's batch, round by round; the call of one pose
beside Pinocchio's and CasADi's; and the import.

    cargo build --release -p stiffarm-bench --features dispatch --bin batch
    python python/tools/speed.py target/release/batch
"""

import statistics
import subprocess
import sys
import time

import numpy
import stiffarm

ROUNDS = 15


def least(works, rounds=60, repeat=500):
    """Microseconds of the processor that each takes: the least of rounds in turn, since others may want the machine too."""
    taken = dict.fromkeys(works, float("inf"))
    for _ in range(rounds):
        for name, work in works.items():
            begun = time.process_time()
            for _ in range(repeat):
                work()
            taken[name] = min(taken[name], 1e6 * (time.process_time() - begun) / repeat)
    return taken


def batches(program):
    arm = stiffarm.Arm.load("kuka_kr240")
    q = numpy.random.default_rng(0).uniform(-1.0, 1.0, (1_000_000, 6))
    out = numpy.empty((1_000_000, 6, 6)).transpose(0, 2, 1)
    with subprocess.Popen([program], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as rust:
        ours, theirs = [], []
        # The first round of each touches its memory.
        for _ in range(1 + ROUNDS):
            begun = time.perf_counter()
            arm.jacobian(q, out=out)
            ours.append(1e3 * (time.perf_counter() - begun))
            rust.stdin.write("\n")
            rust.stdin.flush()
            theirs.append(float(rust.stdout.readline()))
    ours, theirs = ours[1:], theirs[1:]
    print(f"10^6 Jacobians of the KR 240-2 by {arm.engine('jacobian')}, ms: median (least)")
    for name, rounds in (("Python", ours), ("Rust", theirs)):
        print(f"  {name:<18} {statistics.median(rounds):.1f} ({min(rounds):.1f})")
    print(f"  {'ratio':<18} {statistics.median(a / b for a, b in zip(ours, theirs)):.2f} ({min(ours) / min(theirs):.2f})")


def imports():
    """Of a new interpreter, and of one that has NumPy already."""
    for what, before in (("import stiffarm", "pass"), ("the same behind NumPy", "import numpy")):
        code = f"import time\n{before}\nt = time.process_time()\nimport stiffarm\nprint(time.process_time() - t)"
        run = [sys.executable, "-c", code]
        rounds = [float(subprocess.run(run, capture_output=True, text=True, check=True, cwd="/").stdout) for _ in range(ROUNDS)]
        print(f"{what}, ms of the processor: {1e3 * statistics.median(rounds):.1f} ({1e3 * min(rounds):.1f})")


def calls():
    arm = stiffarm.Arm.load("kuka_kr240")
    q, out = numpy.full(6, 0.3), numpy.empty((6, 6)).T
    works = {
        "Jacobian": lambda: arm.jacobian(q),
        "Jacobian, out=": lambda: arm.jacobian(q, out=out),
        "pose": lambda: arm.pose(q),
    }
    urdf = stiffarm.generate(arm, "urdf")["kuka_kr240.urdf"]
    try:
        import pinocchio
    except ImportError:
        print("Pinocchio is not installed: pip install pin")
    else:
        model = pinocchio.buildModelFromXML(urdf)
        data, tip = model.createData(), model.nframes - 1
        mixed = pinocchio.LOCAL_WORLD_ALIGNED

        def pose():
            pinocchio.forwardKinematics(model, data, q)
            return pinocchio.updateFramePlacement(model, data, tip)

        assert numpy.abs(pose().homogeneous - arm.pose(q)).max() < 1e-9
        works["Pinocchio, Jacobian"] = lambda: pinocchio.computeFrameJacobian(model, data, q, tip, mixed)
        works["Pinocchio, pose"] = pose
    try:
        import casadi
    except ImportError:
        print("CasADi is not installed: pip install casadi")
    else:
        jacobian = by_casadi(casadi, arm)
        assert numpy.abs(numpy.array(jacobian(q))[:3] - arm.jacobian(q)[:3]).max() < 1e-12
        works["CasADi, 3 rows"] = lambda: jacobian(q)
    print("one call, µs of the processor:")
    for name, taken in least(works).items():
        print(f"  {name:<20} {taken:.2f}")


def by_casadi(casadi, arm):
    """The Jacobian of the tool's position, of the same table."""
    rows = [row.split("\n") for row in arm.toml.split("[[joint]]")[1:]]
    q, place = casadi.SX.sym("q", 6), casadi.SX.eye(4)

    def entry(row, name):
        line = next((line for line in row if line.split("=")[0].strip() == name), f"{name} = 0")
        text = line.split("=")[1].split("#")[0].strip().strip('"').replace("pi", "3.141592653589793")
        scale = 1e-3 if text.endswith("mm") else 1.0
        return scale * eval(text.removesuffix("mm").removesuffix("m").strip())

    def turn(axis, angle):
        c, s, t = casadi.cos(angle), casadi.sin(angle), casadi.SX.eye(4)
        a, b = (axis + 1) % 3, (axis + 2) % 3
        t[a, a], t[a, b], t[b, a], t[b, b] = c, -s, s, c
        return t

    def move(axis, length):
        t = casadi.SX.eye(4)
        t[axis, 3] = length
        return t

    for k, row in enumerate(rows):
        alpha, a, theta, d = (entry(row, name) for name in ("alpha", "a", "theta", "d"))
        place = place @ turn(0, alpha) @ move(0, a) @ turn(2, theta + q[k]) @ move(2, d)
    return casadi.Function("jacobian", [q], [casadi.jacobian(place[:3, 3], q)])


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    batches(sys.argv[1])
    calls()
    imports()
