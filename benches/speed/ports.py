#!/usr/bin/env python3
"""Cycles that the vector ports of an Intel core need at least for functions of a program or an object, taken together:

    gcc -O3 -march=sapphirerapids -c kr240.c
    benches/speed/ports.py kr240.o kr240_compliance kr240_given_compliance

and, wherever a load spans several stores of the same function, its line: such a load waits until they are in the cache.

Ports of Golden Cove and its forebears from Skylake's server on (uops.info; Intel's Optimization Reference Manual): 0, 1 and 5
take vectors. While an instruction on 512 bits waits, 0 and 1 work as one and 1 takes no other vectors; 5 multiplies 512 bits
alone. The text is read as a straight line up to its first return.
"""

import itertools
import re
import subprocess
import sys

# What begins an instruction's name, the ports that take it, and those that take it on 512 bits.
PORTS = [
    (r"vdiv|vsqrt", "0", "0"),
    (r"vfn?m|vmul", "01", "05"),
    (r"vadd|vsub", "15", "05"),
    (r"vcmp|vptest|kmov|vextract|vperm", "5", "5"),
    (r"vucomi|vmov[qd]$", "0", "0"),
    (r"vunpck|vshuf|vpshuf|vpunpck|vinsert|vp?broadcast|vmovddup|vmov[lh]", "15", "5"),
    (r"vps[lr]l", "01", "0"),
    (r"v", "015", "05"),
]
# A division keeps its port for so many cycles.
DIVISION = 4
BYTES = {"xmm": 16, "ymm": 32, "zmm": 64}


def instructions(program, function):
    """Name and operands of each instruction up to the first return."""
    command = ["objdump", "-d", "--no-show-raw-insn", f"--disassemble={function}", program]
    lines = subprocess.run(command, capture_output=True, text=True, check=True).stdout.splitlines()
    found = [line.split("\t")[1] for line in lines if line.startswith(" ")]
    if not found:
        sys.exit(f"{program}: found no function {function}; nm lists the names")
    for text in found:
        name, _, operands = text.partition(" ")
        yield name, operands.split("#")[0].strip()
        if name == "ret":
            return


def moves(name, operands):
    """Whether it only loads, stores or renames, which takes no vector port."""
    memory = "(" in operands or "mova" in name or "movu" in name or "movdq" in name
    return memory and re.match(r"v(mov|p?broadcast)", name) and "{%k" not in operands


def width(name, operands):
    """Bytes that it loads or stores."""
    if re.search(r"s[dq]$|movq$|mov[lh]p[ds]$", name) or "{1to" in operands:
        return 8
    return max((BYTES[kind] for kind in BYTES if "%" + kind in operands), default=8)


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    program, functions = sys.argv[1], sys.argv[2:]
    taken, wide, spanning = [], False, []
    for function in functions:
        stored = {}
        for name, operands in instructions(program, function):
            wide |= "%zmm" in operands
            if re.match(r"[vk]", name) and not moves(name, operands):
                ports = next(p for begin, *p in PORTS if re.match(begin, name))
                taken.append((ports["%zmm" in operands], DIVISION if re.match("vdiv|vsqrt", name) else 1))
            place = re.search(r"(-?0x[0-9a-f]+)?\((%r\w+)\)", operands)
            if place is None or not name.startswith("v") or place[2] == "%rip":
                continue
            first = int(place[1] or "0", 16)
            touched = [(place[2], first + byte) for byte in range(width(name, operands))]
            if operands.endswith(")"):
                stored |= dict.fromkeys(touched, (name, operands))
            elif len({stored.get(byte) for byte in touched}) > 1:
                spanning.append(f"{function}: {name} {operands}")
    open_ports = "05" if wide else "015"
    sets = [set(s) for n in (1, 2, 3) for s in itertools.combinations(open_ports, n)]
    cycles = max(sum(c for p, c in taken if set(p) & set(open_ports) <= s) / len(s) for s in sets)
    print(f"{cycles:.0f} cycles{', port 1 closed' if wide else ''}; loads over several stores: {len(spanning)}")
    print(*spanning, sep="\n", end="\n" if spanning else "")


if __name__ == "__main__":
    main()
