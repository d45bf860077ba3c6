

def _step(stands, jacobian, target):
    """(J'J + damping)^-1 J'e, e from where the tool stands to the target."""
    turn = np.cross(stands[..., :3], target[..., :3], axis=-2).sum(axis=-1) / 2.0
    error = np.concatenate([target[..., 3] - stands[..., 3], turn], axis=-1)
    across = jacobian.swapaxes(-1, -2)
    normal = across @ jacobian
    rounding = 8.0 * np.finfo(float).eps * np.trace(normal, axis1=-2, axis2=-1)
    damping = (error * error).sum(axis=-1) + rounding
    one = np.eye(normal.shape[-1])
    normal = normal + damping[..., None, None] * one
    known = np.isfinite(normal).all(axis=(-1, -2))[..., None, None]
    return np.linalg.solve(np.where(known, normal, one), across @ error[..., None])[..., 0]


def _displaced(pose, by):
    """A pose moved by a small translation and a rotation vector."""
    angle = np.linalg.norm(by[..., 3:], axis=-1)[..., None, None]
    first, second = np.sinc(angle / np.pi), 0.5 * np.sinc(angle / (2.0 * np.pi)) ** 2
    once = np.cross(by[..., 3:, None], pose[..., :3, :3], axis=-2)
    axes = pose[..., :3, :3] + first * once + second * np.cross(by[..., 3:, None], once, axis=-2)
    return np.concatenate([axes, (pose[..., :3, 3] + by[..., :3])[..., None]], axis=-1)


def _follow(begin, target, steps, readings, held, stands, jacobian, gives, joints):
    """Branches as readings, from their joint values: steps to those at which the tool stands at the target, then what gives,
    then readings. A branch in which the arm does not bear its load stays, and misses the target by inf."""
    begin = begin.swapaxes(-1, -2)
    target = target.reshape(*target.shape[:-1], 1, 4, 3).swapaxes(-1, -2)
    at = begin
    with np.errstate(all="ignore"):
        for _ in range(steps):
            moves = jacobian(at) * (np.arange(N) != held)
            at = at + _step(stands(at)[..., :3, :], moves, target)
        give = gives(at)
        meant = q = at - give
        for _ in range(readings):
            q = q + (meant - joints(q))
        off = (stands(joints(q) + give)[..., :3, :] - target) ** 2
        distance = np.sqrt(off[..., 3].sum(axis=-1))
        tilt = np.sqrt(0.5 * off[..., :3].sum(axis=(-1, -2)))
    lost = ~np.isfinite(q).all(axis=-1)
    q = np.where(lost[..., None], begin, q).swapaxes(-1, -2)
    return {"q": q, "distance": np.where(lost, np.inf, distance), "tilt": np.where(lost, np.inf, tilt)}
