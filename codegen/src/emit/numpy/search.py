

def _turn(line, angle):
    """The displacements by angles about a line, which is a direction and a point."""
    cos, sin = np.cos(angle)[..., None, None], np.sin(angle)[..., None, None]
    turn = cos * np.eye(3) + sin * np.cross(line[0], np.eye(3)).T + (1.0 - cos) * np.outer(line[0], line[0])
    out = np.broadcast_to(np.eye(4), (*turn.shape[:-2], 4, 4)).copy()
    out[..., :3, :3], out[..., :3, 3] = turn, line[1] - turn @ line[1]
    return out


def _moved(by, line):
    out = line @ by[..., :3, :3].swapaxes(-1, -2)
    out[..., 1, :] += by[..., :3, 3]
    return out


def _numbers(lines):
    """l, p, p x l, (p.p) l - 2 (p.l) p, p.l, p.p of each line."""
    l, p = lines[..., 0, :], lines[..., 1, :]
    pl, pp = (p * l).sum(axis=-1, keepdims=True), (p * p).sum(axis=-1, keepdims=True)
    return np.concatenate([l, p, np.cross(p, l), pp * l - 2.0 * pl * p, pl, pp], axis=-1)


# What is 1, cos, sin of three angles.
_SAMPLES = 2.0 * np.pi / 3.0 * np.arange(3)
_PARTS = np.linalg.inv(np.stack([np.ones(3), np.cos(_SAMPLES), np.sin(_SAMPLES)], axis=-1))
# From these to powers of the half angle's tangent.
_TANGENTS = np.array([[1.0, 1.0, 0.0], [0.0, 0.0, 2.0], [1.0, -1.0, 0.0]])


def _circle(angle):
    return np.stack([np.ones_like(angle), np.cos(angle), np.sin(angle)], axis=-1)


def _twelve(six, angle):
    """At angles of the third joint: the matrix that is singular where it is one of a solution."""
    values = np.einsum("rijk,ak->arji", six, _circle(angle)).reshape(-1, 6, 9)
    out = np.zeros((len(values), 12, 12))
    out[:, :6, :9] = out[:, 6:, 3:] = values
    return out


def _begin(lines, home, target, third, near):
    """Joint values by each root this near the circle (Raghavan & Roth 1993), and how many are most likely angles."""
    displacement = target @ np.linalg.inv(home)
    first, back = (third + 4) % 6, np.linalg.inv(displacement)
    lines = np.stack([lines[k] if k < 6 else _moved(back, lines[k - 6]) for k in range(first, first + 6)])
    left, right = _moved(displacement, lines[5]), lines[5]
    for k in (0, 1):
        left = _moved(_turn(lines[k], -_SAMPLES), left[..., None, :, :])
    for k in (4, 3, 2):
        right = _moved(_turn(lines[k], _SAMPLES), right[..., None, :, :])
    left = np.einsum("jx,ky,xyr->rjk", _PARTS, _PARTS, _numbers(left)).reshape(14, 9)
    right = np.einsum("ix,jy,kz,xyzr->rijk", _PARTS, _PARTS, _PARTS, _numbers(right)).reshape(14, 27)
    right[:, 0] -= left[:, 0]
    own, triangle = np.linalg.qr(left[:, 1:], mode="complete")
    right = (own.T @ right).reshape(14, 3, 3, 3)
    six = np.einsum("ix,jy,rxyk->rijk", _TANGENTS, _TANGENTS, right[8:])
    c = np.fft.fft(np.linalg.det(_twelve(six, 2.0 * np.pi / 24.0 * np.arange(24))))[:9]
    z = np.roots(np.concatenate([c[::-1], c[1:].conj()]))
    with np.errstate(all="ignore"):
        beside = np.abs(np.log(np.abs(z)))
    on_circle, at = np.count_nonzero(beside < 0.01), np.angle(z[beside < near])
    x = np.linalg.svd(_twelve(six, at))[2][:, -1]
    row = np.arange(len(at))

    def half(low, apart):
        most = low[np.argmax(x[:, low] ** 2 + x[:, low + apart] ** 2, axis=-1)]
        return 2.0 * np.arctan2(x[row, most + apart], x[row, most])

    fourth, fifth = half(np.arange(9), 3), half(np.array([0, 1, 3, 4, 6, 7, 9, 10]), 1)
    known = np.einsum("rijk,ai,aj,ak->ra", right[:8], _circle(fifth), _circle(fourth), _circle(at))
    x = np.linalg.lstsq(triangle[:8], known, rcond=1e-12)[0]
    q = np.stack([np.arctan2(x[5], x[2]), np.arctan2(x[1], x[0]), at, fourth, fifth], axis=-1)
    so_far = np.broadcast_to(np.eye(4), (len(at), 4, 4))
    for k in range(5):
        so_far = so_far @ _turn(lines[k], q[:, k])
    axis = lines[5, 0]
    across = np.cross(axis, np.eye(3)[np.argmin(np.abs(axis))])
    to = (displacement[:3, :3] @ across) @ so_far[:, :3, :3]
    sixth = np.arctan2(np.cross(across, to) @ axis, to @ across)
    return np.roll(np.column_stack([q, sixth]), first, axis=-1), on_circle


def _six(lines, home, q):
    """The tool at joint values, as a displacement, and the Jacobian."""
    so_far, axes = np.broadcast_to(np.eye(4), (len(q), 4, 4)), []
    for k in range(6):
        axes.append(_moved(so_far, lines[k]))
        so_far = so_far @ _turn(lines[k], q[:, k])
    pose, axes = so_far @ home, np.stack(axes, axis=1)
    lever = pose[:, None, :3, 3] - axes[:, :, 1]
    return pose, np.concatenate([np.cross(axes[:, :, 0], lever), axes[:, :, 0]], axis=-1).swapaxes(-1, -2)


def _off(pose, target):
    """Distance, and twice the sine of half the angle."""
    square = ((pose - target)[:, :3] ** 2).sum(axis=1)
    return np.sqrt(square[:, 3]), np.sqrt(0.5 * square[:, :3].sum(axis=-1))


def _polished(lines, home, target, q):
    """Newton's method; the joint values that reach the target."""
    for _ in range(20):
        pose, jacobian = _six(lines, home, q)
        by = _step(pose[:, :3], jacobian, target[:3])
        q = q + by / np.maximum(np.abs(by).max(axis=-1, keepdims=True), 1.0)
    return q[np.maximum(*_off(_six(lines, home, q)[0], target)) < 1e-9]


def _nearest(lines, home, target, size, q):
    """The joint values with the least distance^2 + tilt^2, m and rad, that damped Newton steps lead to."""
    def off(pose):
        distance, tilt = _off(pose, target)
        return 0.5 * ((size * distance) ** 2 + tilt**2)

    damping = np.full(len(q), 1e-2)
    (pose, jacobian), weight = _six(lines, home, q), size * size
    least = off(pose)
    for _ in range(40):
        moves, axes = jacobian[:, :3].swapaxes(-1, -2), jacobian[:, 3:].swapaxes(-1, -2)
        to = target[:3, 3] - pose[:, :3, 3]
        turn = 0.5 * np.cross(pose[:, :3, :3], target[:3, :3], axis=-2).sum(axis=-1)
        aligned = 0.5 * (pose[:, :3, :3] * target[:3, :3]).sum(axis=(-1, -2))[:, None, None]
        along = 0.5 * (axes @ target[:3, :3]) @ (axes @ pose[:, :3, :3]).swapaxes(-1, -2)
        bent = np.cross(axes[:, None], moves[:, :, None]) @ to[:, None, :, None]
        moved, turned = moves @ moves.swapaxes(-1, -2), axes @ axes.swapaxes(-1, -2)
        second = np.tril(weight * (moved - bent[..., 0]) + turned * aligned - along)
        second = second + np.tril(second, -1).swapaxes(-1, -2)
        first = weight * (moves @ to[..., None]) + axes @ turn[..., None]
        values, vectors = np.linalg.eigh(second)
        scale = np.abs(np.diagonal(second, axis1=-2, axis2=-1)).sum(axis=-1)
        values = values + (damping * scale)[:, None]
        by = (vectors @ ((vectors.swapaxes(-1, -2) @ first)[..., 0] / values)[..., None])[..., 0]
        by = np.where((values > 0.0).all(axis=-1, keepdims=True), by, np.nan)
        then = q + by / np.maximum(np.abs(by).max(axis=-1, keepdims=True), 1.0)
        there, slopes = _six(lines, home, then)
        better = off(there) < least
        q, pose = np.where(better[:, None], then, q), np.where(better[:, None, None], there, pose)
        jacobian = np.where(better[:, None, None], slopes, jacobian)
        least, damping = np.where(better, off(there), least), damping * np.where(better, 0.05, 8.0)
    return q[np.argmin(least)]


def _searched(near, target, given, third):
    """At most sixteen solutions of one pose, as rows; nan where there is none."""
    target = np.vstack([target.reshape(4, 3).T, [0.0, 0.0, 0.0, 1.0]])
    out = np.full((16, N), np.nan)
    if not np.isfinite(target).all() or not np.isfinite(near).all():
        return out
    lines, home, kept = _AXES, _HOME, np.arange(N)
    if given is not None:
        by, kept = _turn(lines[given], near[given]), np.delete(kept, given)
        moved = [_moved(by, line) if k > given else line for k, line in enumerate(lines)]
        lines, home = np.stack(moved)[kept], by @ home
    origin = lines[2, 1]
    size = np.linalg.norm(np.vstack([lines[:, 1], home[:3, 3]]) - origin, axis=-1).max()
    lines = np.stack([lines[:, 0], (lines[:, 1] - origin) / size], axis=1)
    home, target = home.copy(), target.copy()
    for pose in (home, target):
        pose[:3, 3] = (pose[:3, 3] - origin) / size
    # Solutions come and go in pairs, and each is a root: where one is missing, other equations may find it.
    others, found = [(third + by) % 6 for by in (0, 3, 4, 1)], []
    for middle in others:
        begin, roots = _begin(lines, home, target, middle, 0.2)
        for q in _polished(lines, home, target, begin):
            if np.all([np.abs(np.angle(np.exp(1j * (q - known)))).max() > 1e-6 for known in found]):
                found.append(q)
        if found and len(found) % 2 == 0 and len(found) >= roots:
            break
    if not found:
        starts = [_begin(lines, home, target, middle, np.inf)[0] for middle in others]
        found = [_nearest(lines, home, target, size, np.concatenate([near[kept][None], *starts]))]
    found = np.array(found[:16])
    out[: len(found)] = near
    out[: len(found), kept] = np.angle(np.exp(1j * found))
    return out


def _search(q, target, given, third):
    """Every solution by the arm's axes: a search, not a closed form."""
    shape = np.broadcast_shapes(q.shape[:-1], target.shape[:-1])
    each = zip(np.broadcast_to(q, (*shape, N)).reshape(-1, N), np.broadcast_to(target, (*shape, 12)).reshape(-1, 12))
    found = np.array([_searched(near, pose, given, third) for near, pose in each])
    return found.reshape(*shape, 16, N).swapaxes(-1, -2)
