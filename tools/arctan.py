#!/usr/bin/env python3
"""The constants of kernels/src/arctan.rs and of the same function in C.

    tools/arctan.py              # prints the constants, each with the error that it leaves
    tools/arctan.py --check      # compares: exit status 1 if a constant differs

The polynomials are those of `(arctan t - t)/t^3` in t^2 for |t| <= tan(pi/8), by the exchange of tools/sin_cos.py,
weighted for the error of the arctangent relative to t.
"""

import re
import sys
from decimal import Decimal

import sin_cos

# A little above tan(pi/8) = sqrt(2) - 1.
sin_cos.END = Decimal("0.41422")
TAYLOR = [Decimal((-1) ** (k + 1)) / (2 * k + 3) for k in range(60)]
PLACES = [sin_cos.KERNELS / "src/arctan.rs", sin_cos.KERNELS.parent / "codegen/src/emit/c/arctangent.rs"]


def constants():
    relative = lambda z: z
    for name, bits, count in (("DOUBLE", 53, 11), ("SINGLE", 24, 5)):
        values = [sin_cos.rounded(c, bits) for c in sin_cos.remez(TAYLOR, relative, [], count)]
        error = sin_cos.polynomial_error(TAYLOR, relative, values)
        yield name, values, max(abs(error(z)) for z in sin_cos.peaks(error, sin_cos.END**2))


def main(arguments):
    if arguments not in ([], ["--check"]):
        print(__doc__, file=sys.stderr)
        return 2
    differ = 0
    for name, values, error in constants():
        found = [float(value) for value in values]
        print(f"{name} = {found}  # {float(error):.2g}")
        for place in PLACES if arguments else []:
            there = {float(number) for number in re.findall(r"-?\d+\.\d+(?:e-?\d+)?", place.read_text())}
            if absent := [value for value in found if value not in there]:
                differ += 1
                print(f"  differs: {place.name} has no {absent}")
    return min(differ, 1)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
