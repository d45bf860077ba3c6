#!/usr/bin/env python3
"""The constants of kernels/src/sin_cos, of the same functions in C, and the table that tests hold
them against.

    tools/sin_cos.py              # prints the constants, each with the error that it leaves
    tools/sin_cos.py --check      # compares: exit status 1 if a constant or a line differs
    tools/sin_cos.py --table      # writes the values of kernels/tests/sin_cos/double.csv anew

Python's own decimals, of 140 digits, and nothing else. A polynomial is a minimax one by Remez'
exchange over every reduced angle, |r| <= END. Its coefficients are rounded from the lowest on, and
after each the others are fitted anew with those before held: what a rounding takes away, the rest
gives back. The weight turns the error of the polynomial into that of the value: `r^3` or `r^4`, and
in double precision, where the sine of a small angle is to be right to its last bit, divided by r.
"""

import math
import re
import struct
import sys
from decimal import ROUND_DOWN, ROUND_HALF_EVEN, Decimal, getcontext
from pathlib import Path

getcontext().prec = 140
KERNELS = Path(__file__).resolve().parent.parent / "kernels"
C = KERNELS.parent / "codegen/src/emit/c/trigonometry.rs"
TABLE = KERNELS / "tests/sin_cos/double.csv"
# A little above pi/4: the multiple of pi/2 is rounded to the nearest in the angle's own precision.
END = Decimal("0.7855")
GOLDEN = (Decimal(5).sqrt() - 1) / 2


def pi():
    """Machin's formula."""

    def arctan_of_inverse(x):
        total, power, k = Decimal(0), 1 / Decimal(x), 0
        while power > Decimal(10) ** -150:
            total += (-1) ** k * power / (2 * k + 1)
            power /= x * x
            k += 1
        return total

    return 4 * (4 * arctan_of_inverse(5) - arctan_of_inverse(239))


PI = pi()


def horner(coefficients, z):
    total = Decimal(0)
    for c in reversed(coefficients):
        total = total * z + c
    return total


def series(first, terms):
    """Taylor's coefficients of the sine or cosine in r^2, from `r^first/first!` on."""
    return [Decimal((-1) ** ((first + 2 * k) // 2)) / math.factorial(first + 2 * k) for k in range(terms)]


def rounded(x, bits, how=ROUND_HALF_EVEN):
    """The nearest number of so many bits; or the next towards zero."""
    unit = Decimal(2) ** (math.frexp(float(x))[1] - bits)
    return (x / unit).to_integral_value(how) * unit


def solve(rows):
    """Gauss' elimination with pivots; the last column is the right-hand side."""
    for i in range(len(rows)):
        pivot = max(range(i, len(rows)), key=lambda r: abs(rows[r][i]))
        rows[i], rows[pivot] = rows[pivot], rows[i]
        rows[i] = [x / rows[i][i] for x in rows[i]]
        for r, row in enumerate(rows):
            if r != i:
                rows[r] = [x - row[i] * y for x, y in zip(row, rows[i])]
    return [row[-1] for row in rows]


def peaks(error, top, steps=160):
    """Where |error| is largest between two changes of its sign, over (0, top]."""
    grid = [top * Decimal(0.5 - 0.5 * math.cos(math.pi * i / steps)) for i in range(1, steps)] + [top]
    values = [error(z) for z in grid]
    spans = [[0]]
    for i in range(1, steps):
        if values[i] * values[i - 1] < 0:
            spans.append([])
        spans[-1].append(i)
    found = []
    for span in spans:
        i = max(span, key=lambda i: abs(values[i]))
        low, high = grid[max(i - 1, 0)], grid[min(i + 1, steps - 1)]
        for _ in range(50):
            inner, outer = high - GOLDEN * (high - low), low + GOLDEN * (high - low)
            low, high = (low, outer) if abs(error(inner)) > abs(error(outer)) else (inner, high)
        found.append(max((low, grid[i], high), key=lambda z: abs(error(z))))
    return found


def remez(taylor, weight, held, count):
    """The best coefficients from `len(held)` to `count`, where those below are held."""
    free = range(len(held), count)
    points = len(free) + 1
    top = END * END
    left = [t - (held[k] if k < len(held) else 0) for k, t in enumerate(taylor)]
    at = [top * Decimal(0.5 - 0.5 * math.cos(math.pi * (i + 0.5) / points)) for i in range(points)]
    for _ in range(30):
        rows = [[z**k for k in free] + [(-1) ** i / weight(z), horner(left, z)] for i, z in enumerate(at)]
        *best, level = solve(rows)
        error = polynomial_error(taylor, weight, held + best)
        at = peaks(error, top)
        while len(at) > points:
            del at[0 if abs(error(at[0])) < abs(error(at[-1])) else -1]
        if len(at) < points:
            raise ArithmeticError("fewer extrema than coefficients")
        if max(abs(error(z)) for z in at) <= abs(level) * (1 + Decimal("1e-12")):
            return best
    raise ArithmeticError("the exchange does not come to its end")


def polynomial_error(taylor, weight, coefficients):
    rest = [t - c for t, c in zip(taylor, coefficients)] + taylor[len(coefficients) :]
    return lambda z: weight(z) * horner(rest, z)


def coefficients(taylor, weight, count, bits):
    """The coefficients, and the largest error that they leave."""
    held = []
    while len(held) < count:
        held.append(rounded(remez(taylor, weight, held, count)[0], bits))
    error = polynomial_error(taylor, weight, held)
    return held, max(abs(error(z)) for z in peaks(error, END * END))


def parts_of_half_pi(short, bits):
    """pi/2 in three parts, the first two cut short, so that their products with a multiple are exact."""
    first = rounded(PI / 2, short, ROUND_DOWN)
    second = rounded(PI / 2 - first, short, ROUND_DOWN)
    return [first, second, rounded(PI / 2 - first - second, bits)]


def constants():
    """Everything: file, name, values, and the error that polynomials leave."""
    cube = lambda z: z * z.sqrt()
    relative = lambda z: z
    fourth = lambda z: z * z
    sine, cosine = series(3, 24), series(4, 24)
    for file, bits, short, count, weight in (("double", 53, 35, 6, relative), ("single", 24, 16, 3, cube)):
        yield file, "HALF_PI", parts_of_half_pi(short, bits), None
        yield file, "SINE", *coefficients(sine, weight, count, bits)
        yield file, "COSINE", *coefficients(cosine, fourth, count, bits)


def in_rust(file, name):
    text = (KERNELS / f"src/sin_cos/{file}.rs").read_text()
    values = re.search(rf"const {name}: \[f64; \d\] = \[(.*?)\];", text, re.DOTALL)
    return [float(value) for value in values[1].split(",") if value.strip()]


def missing_in_c(file, values):
    """Those that the text of the same function in C does not have, with the sign that it needs there."""
    text = re.search(rf'const {file.upper()}: &str = "(.*?)\n";', C.read_text(), re.DOTALL)[1]
    there = {float(number) for number in re.findall(r"-?\d+\.\d+(?:e-?\d+)?", text)}
    return [value for value in values if value not in there]


def sine_and_cosine(x):
    """By Taylor's series of what is left of a multiple of pi/2."""
    multiple = (x / (PI / 2)).to_integral_value(ROUND_HALF_EVEN)
    r = x - multiple * PI / 2
    s, c = r * horner(series(1, 50), r * r), horner(series(0, 50), r * r)
    return [(s, c), (c, -s), (-s, -c), (-c, s)][int(multiple) % 4]


def table():
    """The table's lines, for the angles that it has: the values are those of the angles' bits."""
    bits = lambda x: struct.pack(">d", x).hex()
    for line in TABLE.read_text().splitlines():
        if line.startswith("#"):
            yield line
            continue
        (angle,) = struct.unpack(">d", bytes.fromhex(line.split(",")[0]))
        cells = [bits(angle)]
        for value in sine_and_cosine(Decimal(angle)):
            nearest = float(value)
            cells += [bits(nearest), bits(float(value - Decimal(nearest)))]
        yield ",".join(cells)


def main(arguments):
    if arguments == ["--table"]:
        TABLE.write_text("\n".join(table()) + "\n")
        return 0
    if arguments not in ([], ["--check"]):
        print(__doc__, file=sys.stderr)
        return 2
    differ = 0
    for file, name, values, error in constants():
        found = [float(value) for value in values]
        print(f"{file}.rs {name} = {found}" + (f"  # {float(error):.2g}" if error else ""))
        if arguments and found != in_rust(file, name):
            differ += 1
            print(f"  differs: the source has {in_rust(file, name)}")
        # What is subtracted stands there with a minus.
        absent = missing_in_c(file, [-value for value in found] if name == "HALF_PI" else found)
        if arguments and absent:
            differ += 1
            print(f"  differs: the kernels in C have no {absent}")
    if arguments:
        lines = list(zip(table(), TABLE.read_text().splitlines(), strict=True))
        wrong = [number for number, (a, b) in enumerate(lines, 1) if a != b]
        differ += len(wrong)
        print(f"double.csv: {len(lines)} lines, {len(wrong)} differ" + f" {wrong[:9]}" * bool(wrong))
    return min(differ, 1)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
