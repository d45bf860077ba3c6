"""Cameras against OpenCV: what it projects, we predict; what it calibrates, we calibrate.

    python -m venv .venv && .venv/bin/pip install "opencv-python-headless<5"
    cargo build --release -p stiffarm-cli
    .venv/bin/python tools/opencv.py [draws]

1. OpenCV draws a ChArUco board, projects the picture as a camera would show it, and detects the corners in it:
   the diagnosis of these pixels gives both frames.
2. Pixels: `predict` against `cv2.projectPoints`, 1e-9 px.
3. Hand-eye on clean pixels: both frames to 1e-9, m and rad.
4. Hand-eye on noisy pixels: the median error of the tool frame over `draws`, against the five methods of
   `cv2.calibrateHandEye`, each on OpenCV's own poses of the board.
5. A camera of which nothing is known: the median error of its matrix over `draws`, against `cv2.calibrateCamera` on the
   same pixels.
"""

import csv
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

import cv2
import numpy as np

STIFFARM = Path(os.environ.get("STIFFARM", Path(__file__).parent.parent / "target/release/stiffarm"))
ROBOT = "irb120"
MATRIX = np.array([[1210.0, 0.0, 640.0], [0.0, 1190.0, 355.0], [0.0, 0.0, 1.0]])
DISTORTION = np.array([-0.21, 0.07, 1e-3, -2e-3, 0.01])
SQUARES = (7, 5)
SQUARE = 0.03  # m
POSTURES = 20
METHODS = {
    "Tsai": cv2.CALIB_HAND_EYE_TSAI,
    "Park": cv2.CALIB_HAND_EYE_PARK,
    "Horaud": cv2.CALIB_HAND_EYE_HORAUD,
    "Andreff": cv2.CALIB_HAND_EYE_ANDREFF,
    "Daniilidis": cv2.CALIB_HAND_EYE_DANIILIDIS,
}

DICTIONARY = cv2.aruco.getPredefinedDictionary(cv2.aruco.DICT_4X4_50)
BOARD = cv2.aruco.CharucoBoard(SQUARES, SQUARE, 0.75 * SQUARE, DICTIONARY)
CORNERS = BOARD.getChessboardCorners().astype(float)


def pose(turn, place):
    whole = np.eye(4)
    whole[:3, :3] = cv2.Rodrigues(np.asarray(turn, float))[0]
    whole[:3, 3] = place
    return whole


def stiffarm(*words):
    done = subprocess.run([STIFFARM, "--quiet", *map(str, words)], capture_output=True, text=True)
    if done.returncode not in (0, 1):
        raise SystemExit(f"stiffarm {words}: {done.stderr}")
    return done.stdout


def tool_pose(q):
    told = json.loads(stiffarm("eval", ROBOT, "--q=" + ",".join(map(str, q)), "--json", "-"))
    whole = np.eye(4)
    whole[:3, :3], whole[:3, 3] = np.array(told["rotation"]).reshape(3, 3), told["position"]
    return whole


HAND = pose([0.2, -0.1, 0.4], [0.03, -0.05, 0.08])


def postures(rng):
    """Joint values at which a camera on the tool sees the board well, the tool's poses, and the board's."""
    home = np.array([0.2, 0.3, 0.1, 0.4, 0.9, 0.3])
    camera = tool_pose(home) @ HAND
    board = camera @ pose([0.1, 0.2, 0.3], [-0.1, -0.08, 0.5])
    all_q, tools = [], []
    while len(all_q) < POSTURES:
        q = home + rng.uniform(-0.5, 0.5, 6)
        tool = tool_pose(q)
        seen = project(tool, board)
        inside = (seen > 5).all() and (seen[:, 0] < 1275).all() and (seen[:, 1] < 715).all()
        facing = (np.linalg.inv(tool @ HAND) @ board)[2, 2] > 0.5
        if inside and facing:
            all_q.append(q)
            tools.append(tool)
    return all_q, tools, board


def project(tool, board):
    view = np.linalg.inv(tool @ HAND) @ board
    turn = cv2.Rodrigues(view[:3, :3])[0]
    return cv2.projectPoints(CORNERS.reshape(-1, 1, 3), turn, view[:3, 3], MATRIX, DISTORTION)[0].reshape(-1, 2)


def bench(path, lens=f"matrix = {MATRIX.tolist()}\ndistortion = {DISTORTION.tolist()}"):
    corners = ", ".join(f"c{k} = [{x!r}, {y!r}, {z!r}]" for k, (x, y, z) in enumerate(CORNERS.tolist()))
    path.write_text(
        f'[[camera]]\nname = "hand"\non = "tool"\n{lens}\n'
        f'[[board]]\nname = "charuco"\ncorners = {{ {corners} }}\n'
    )


def write(path, rows):
    with path.open("w", newline="") as file:
        out = csv.writer(file)
        out.writerow([f"q{k + 1}[rad]" for k in range(6)] + ["camera", "board", "marker", "u[px]", "v[px]"])
        for q, corner, (u, v) in rows:
            out.writerow([repr(float(x)) for x in q] + ["hand", "charuco", f"c{corner}", repr(float(u)), repr(float(v))])


def frames(folder, rows):
    """Base frame (the arm in the board's axes) and tool frame (the camera's) as they are co-estimated."""
    write(folder / "pixels.csv", rows)
    words = ["--bench", folder / "bench.toml", "--effects", "instrument_scale", "--json", "-"]
    told = json.loads(stiffarm("diagnose", ROBOT, folder / "pixels.csv", *words))
    return [pose(n["rotation"], n["translation"]) for n in told["nuisances"]], told["gap"]


def lenses(folder, noisy):
    """How far fx, fy, cx, cy are off, px, ours and OpenCV's, of a lens of which nothing is known."""
    bench(folder / "bench.toml", 'fit = ["distortion"]')
    write(folder / "pixels.csv", noisy)
    words = ["--bench", folder / "bench.toml", "--effects", "instrument_scale", "--json", "-"]
    told = json.loads(stiffarm("diagnose", ROBOT, folder / "pixels.csv", *words))
    constants = {c["name"]: c for c in told["bench"][0]["constants"]}
    true = dict(zip(("fx", "fy", "cx", "cy"), MATRIX[[0, 1, 0, 1], [0, 1, 2, 2]]))
    ours = [constants[name]["value"] - value for name, value in true.items()]
    covered = [low <= true[name] <= high for name in true for low, high in [constants[name]["ci95"]]]
    pixels = np.array([uv for _, _, uv in noisy], np.float32).reshape(POSTURES, -1, 1, 2)
    board = [CORNERS.astype(np.float32)] * POSTURES
    _, found, *_ = cv2.calibrateCamera(board, list(pixels), (1280, 720), None, None)
    theirs = [found[i, j] - value for (i, j), value in zip(((0, 0), (1, 1), (0, 2), (1, 2)), true.values())]
    return np.abs(ours), np.abs(theirs), covered


def off(found, true):
    left = np.linalg.inv(found) @ true
    return np.linalg.norm(left[:3, 3]), np.linalg.norm(cv2.Rodrigues(left[:3, :3])[0])


def drawn(folder, all_q, tools, board):
    """What OpenCV detects in pictures of a board that it draws."""
    picture = BOARD.generateImage((1400, 1000), marginSize=0)
    scale = 1400 / (SQUARES[0] * SQUARE)
    detector = cv2.aruco.CharucoDetector(BOARD)
    rows = []
    u, v = np.meshgrid(np.arange(1280.0), np.arange(720.0))
    rays = cv2.undistortPoints(np.stack([u, v], -1).reshape(-1, 1, 2), MATRIX, DISTORTION).reshape(-1, 2)
    rays = np.column_stack([rays, np.ones(len(rays))])
    for q, tool in zip(all_q, tools):
        view = np.linalg.inv(tool @ HAND) @ board
        back = np.linalg.inv(view)
        ends, eye = rays @ back[:3, :3].T, back[:3, 3]
        at = eye[:2] - ends[:, :2] * (eye[2] / ends[:, 2])[:, None]
        at = (at * scale - 0.5).astype(np.float32).reshape(720, 1280, 2)
        shown = cv2.remap(picture, at, None, cv2.INTER_AREA, borderValue=200)
        corners, ids, _, _ = detector.detectBoard(cv2.GaussianBlur(shown, (3, 3), 0))
        if ids is not None:
            rows += [(q, k, uv) for k, uv in zip(ids.ravel(), corners.reshape(-1, 2))]
    return rows


def main():
    draws = int(sys.argv[1]) if len(sys.argv) > 1 else 200
    rng = np.random.default_rng(1)
    all_q, tools, board = postures(rng)
    clean = [(q, k, uv) for q, tool in zip(all_q, tools) for k, uv in enumerate(project(tool, board))]
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        bench(folder / "bench.toml")
        true = [np.linalg.inv(board), HAND]

        (_, tool_frame), gap = frames(folder, rows := drawn(folder, all_q, tools, board))
        far, turned = off(tool_frame, tool_pose([0] * 6) * 0 + HAND)
        print(f"a drawn board: {len(rows)} corners detected, {gap['after']['kinds']['camera']['rms']:.3f} px left, "
              f"camera off by {far * 1e3:.3f} mm, {turned * 1e3:.3f} mrad")
        assert len(rows) > 10 * POSTURES and far < 1e-3 and turned < 2e-3

        found, gap = frames(folder, clean)
        errors = [off(f, t) for f, t in zip(found, true)]
        left = gap["after"]["kinds"]["camera"]["rms"]
        print(f"clean pixels: {left:.1e} px left, frames off by {max(map(max, errors)):.1e} m or rad")
        assert left < 1e-9 and max(map(max, errors)) < 1e-9

        ours, theirs = [], {name: [] for name in METHODS}
        for _ in range(draws):
            noisy = [(q, k, uv + 0.3 * rng.standard_normal(2)) for q, k, uv in clean]
            ours.append(off(frames(folder, noisy)[0][1], HAND))
            views = []
            for posture in range(POSTURES):
                part = np.array([uv for _, _, uv in noisy[posture * len(CORNERS):(posture + 1) * len(CORNERS)]])
                _, turn, place = cv2.solvePnP(CORNERS, part, MATRIX, DISTORTION)
                views.append((cv2.Rodrigues(turn)[0], place))
            for name, method in METHODS.items():
                turn, place = cv2.calibrateHandEye(
                    [t[:3, :3] for t in tools], [t[:3, 3] for t in tools],
                    [v[0] for v in views], [v[1] for v in views], method=method,
                )
                whole = np.eye(4)
                whole[:3, :3], whole[:3, 3] = turn, place.ravel()
                theirs[name].append(off(whole, HAND))
        mine = np.median(ours, axis=0)
        print(f"noisy pixels, median of {draws}: stiffarm {mine[0] * 1e3:.3f} mm, {mine[1] * 1e3:.3f} mrad")
        for name, errors in theirs.items():
            far, turned = np.median(errors, axis=0)
            print(f"  {name:10} {far * 1e3:.3f} mm, {turned * 1e3:.3f} mrad")
            assert mine[0] < far and mine[1] < turned

        found = lenses(folder, clean)[0]
        print(f"clean pixels, nothing known of the lens: matrix off by {max(found):.1e} px")
        assert max(found) < 1e-6
        off_by = [lenses(folder, [(q, k, uv + 0.3 * rng.standard_normal(2)) for q, k, uv in clean]) for _ in range(draws)]
        mine, theirs = (np.median([one[side] for one in off_by], axis=0) for side in (0, 1))
        covered = np.mean([one[2] for one in off_by])
        print(f"noisy pixels, nothing known of the lens, median of {draws}: fx fy cx cy off by {mine.round(2)} px, "
              f"cv2.calibrateCamera {theirs.round(2)} px; {covered:.1%} within our intervals of 95 %")
        assert (mine < theirs).all() and covered > 0.9


if __name__ == "__main__":
    main()
