

def _solve(batch, matrix, right, leading):
    """The solution of a linear system by elimination, matrix column by column; nan where the symmetric part of the
    matrix is not positive definite. Nothing depends on the unknowns from number leading on."""
    n = len(right)
    a = [np.broadcast_to(x, batch) for x in matrix]
    a = np.stack(a, axis=-1).reshape(*batch, n, n).swapaxes(-1, -2).copy()
    b = np.stack([np.broadcast_to(x, batch) for x in right], axis=-1)
    twice = a + a.swapaxes(-1, -2)
    definite = np.ones(batch, dtype=bool)
    with np.errstate(all="ignore"):
        for k in range(n):
            definite &= twice[..., k, k] > 0.0
            column = twice[..., k + 1 :, k] / twice[..., k, k, None]
            twice[..., k + 1 :, k + 1 :] -= column[..., :, None] * twice[..., None, k, k + 1 :]
        for k in range(leading):
            factor = a[..., k + 1 : leading, k] / a[..., k, k, None]
            a[..., k + 1 : leading, k + 1 :] -= factor[..., :, None] * a[..., None, k, k + 1 :]
            b[..., k + 1 : leading] -= factor * b[..., k, None]
        for k in reversed(range(leading)):
            b[..., k] /= a[..., k, k]
            b[..., :k] -= a[..., :k, k] * b[..., k, None]
        for k in range(leading, n):
            b[..., k] -= np.sum(a[..., k, :leading] * b[..., :leading], axis=-1)
            b[..., k] /= a[..., k, k]
    b[~definite] = np.nan
    return np.moveaxis(b, -1, 0)
