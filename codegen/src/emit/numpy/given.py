

def _given(**arrays):
    """The inputs as arrays of doubles, each a pair with its number of entries, and the shape of the batch."""
    found = {name: np.asarray(array, dtype=float) for name, (array, _) in arrays.items()}
    for name, (_, size) in arrays.items():
        if size and found[name].shape[-1:] != (size,):
            raise ValueError(f"{name}: found the shape {found[name].shape}, expected (..., {size})")
    shapes = [x.shape[:-1] if arrays[name][1] else x.shape for name, x in found.items()]
    return [*found.values(), np.broadcast_shapes(*shapes)]
