"""The two functions of examples/program, a hand-eye residual and a distance to a plane, by CasADi, SymForce and wrenfold.

All are given the same formulas on the KUKA KR 240-2: exact quarter turns, the camera's coordinates of the marker,
Jacobians by their own derivatives, each library's own elimination of common subexpressions. What each takes is counted
in its own result: additions and multiplications, divisions, sine-cosine pairs. The three texts are written to the folder
that is named, if one is: CasADi's C, wrenfold's C++, and SymForce's expressions as C, a line for each.

    python3 benches/peers/program_peer.py [DIRECTORY]
"""

import inspect
import re
import sys
from collections import Counter

TABLE = [(0, 0, 0), (0.35, 1, 0), (1.25, 0, 0), (0.055, -1, 1.1), (0, 1, 0), (0, -1, 0.23)]
INPUTS = {
    "hand_eye": {"q": 6, "mount": 3, "turned": 4, "focal": 2, "centre": 2, "marker": 3, "seen": 2},
    "clearance": {"q": 6, "corner": 3, "normal": 3, "height": 1},
}


def product(a, b):
    return [[sum(a[i][k] * b[k][j] for k in range(3)) for j in range(3)] for i in range(3)]


def applied(a, v):
    return [sum(a[i][k] * v[k] for k in range(3)) for i in range(3)]


def transposed(a):
    return [list(column) for column in zip(*a)]


def tool(q, sin, cos):
    """Rotation and origin of the tool: alpha as quarter turns, a, theta, d (modified convention)."""
    rotation, origin = [[1, 0, 0], [0, 1, 0], [0, 0, 1]], [0, 0, 0]
    for (a, quarter, d), angle in zip(TABLE, q):
        origin = [o + r[0] * a for o, r in zip(origin, rotation)]
        c, s = (1, 0) if quarter == 0 else (0, quarter)
        rotation = product(rotation, [[1, 0, 0], [0, c, -s], [0, s, c]])
        s, c = sin(angle), cos(angle)
        rotation = product(rotation, [[c, -s, 0], [s, c, 0], [0, 0, 1]])
        origin = [o + r[2] * d for o, r in zip(origin, rotation)]
    return rotation, origin


def quaternion(w, x, y, z):
    s = 2 / (w * w + x * x + y * y + z * z)
    return [
        [1 - s * (y * y + z * z), s * (x * y - w * z), s * (x * z + w * y)],
        [s * (x * y + w * z), 1 - s * (x * x + z * z), s * (y * z - w * x)],
        [s * (x * z - w * y), s * (y * z + w * x), 1 - s * (x * x + y * y)],
    ]


def hand_eye(sin, cos, v, w, q, mount, turned, focal, centre, marker, seen):
    """The residual with the camera displaced by v and turned by w about its own axes, to first order."""
    rotation, origin = tool(q, sin, cos)
    inside = applied(transposed(rotation), [m - o for m, o in zip(marker, origin)])
    camera = applied(transposed(quaternion(*turned)), [i - m for i, m in zip(inside, mount)])
    p = [c - d for c, d in zip(camera, v)]
    p = [p[0] + p[1] * w[2] - p[2] * w[1], p[1] + p[2] * w[0] - p[0] * w[2], p[2] + p[0] * w[1] - p[1] * w[0]]
    return [focal[k] * (p[k] / p[2]) + centre[k] - seen[k] for k in range(2)]


def clearance(sin, cos, q, corner, normal, height):
    rotation, origin = tool(q, sin, cos)
    place = [o + p for o, p in zip(origin, applied(rotation, corner))]
    return sum(n * p for n, p in zip(normal, place)) - height[0]


def casadi():
    import casadi as ca

    kinds = {
        "flops": [ca.OP_ADD, ca.OP_SUB, ca.OP_MUL, ca.OP_SQ, ca.OP_TWICE],
        "negations": [ca.OP_NEG],
        "divisions": [ca.OP_DIV, ca.OP_INV, ca.OP_SQRT],
        "sines": [ca.OP_SIN],
        "cosines": [ca.OP_COS],
    }
    functions = []
    for name, inputs in INPUTS.items():
        symbols = {key: ca.SX.sym(key, size) for key, size in inputs.items()}
        split = [ca.vertsplit(s) for s in symbols.values()]
        if name == "hand_eye":
            tangent = ca.SX.sym("tangent", 6)
            v = ca.vertsplit(tangent)
            residual = ca.vertcat(*hand_eye(ca.sin, ca.cos, v[:3], v[3:], *split))
            both = [residual, ca.jacobian(residual, tangent)]
            results = [ca.substitute(ca.densify(ca.vec(r)), tangent, ca.SX.zeros(6)) for r in both]
        else:
            distance = clearance(ca.sin, ca.cos, *split)
            results = [distance, ca.densify(ca.gradient(distance, symbols["q"]))]
        function = ca.Function(name, list(symbols.values()), ca.cse([ca.simplify(r) for r in results]))
        functions.append(function)
        count = Counter(function.instruction_id(k) for k in range(function.n_instructions()))
        found = {kind: sum(count[op] for op in ops) for kind, ops in kinds.items()}
        known = {op for ops in kinds.values() for op in ops} | {ca.OP_INPUT, ca.OP_OUTPUT, ca.OP_CONST}
        assert set(count) <= known, set(count) - known
        print("CasADi", ca.__version__, name, found)
    if len(sys.argv) > 1:
        generator = ca.CodeGenerator("program_casadi.c")
        for function in functions:
            generator.add(function)
        generator.generate(sys.argv[1] + "/")


def symforce():
    import symforce

    symforce.set_symbolic_api("symengine")
    import symforce.symbolic as sf

    for name, inputs in INPUTS.items():
        symbols = {key: [sf.Symbol(f"{key}_{k}") for k in range(size)] for key, size in inputs.items()}
        if name == "hand_eye":
            tangent = [sf.Symbol(f"tangent_{k}") for k in range(6)]
            residual = hand_eye(sf.sin, sf.cos, tangent[:3], tangent[3:], *symbols.values())
            slopes = [sf.S(r).diff(t) for t in tangent for r in residual]
            results = [sf.S(e).subs({t: 0 for t in tangent}) for e in residual + slopes]
        else:
            distance = sf.S(clearance(sf.sin, sf.cos, *symbols.values()))
            results = [distance] + [distance.diff(q) for q in symbols["q"]]
        temporaries, simplified = sf.cse(results)
        trees = [e for _, e in temporaries] + list(simplified)
        print("SymForce", symforce.__version__, name, counted(sf, trees))
        if len(sys.argv) > 1:
            lines = [f"const double {key}_{k} = *x++;" for key, size in inputs.items() for k in range(size)]
            lines += [f"const double {symbol} = {printed(sf, tree)};" for symbol, tree in temporaries]
            lines += [f"*y++ = {printed(sf, tree)};" for tree in simplified]
            body = "\n    ".join(lines)
            with open(f"{sys.argv[1]}/program_symforce_{name}.c", "w") as file:
                head = f"void {name}_symforce(const double *x, double *y)"
                file.write(f"#include <math.h>\n{head};\n{head} {{\n    {body}\n}}\n")


def printed(sf, tree):
    """C of an expression after the elimination; small powers as products."""
    e = sf.S(tree)
    kind, parts = type(e).__name__, [printed(sf, a) for a in e.args]
    if kind == "Add":
        return "(" + " + ".join(parts) + ")"
    if kind == "Mul":
        return "(" + " * ".join(parts) + ")"
    if kind == "Pow":
        power = int(e.args[1])
        product = "(" + " * ".join([parts[0]] * abs(power)) + ")"
        return product if power > 0 else f"(1.0 / {product})"
    if kind in ("Sin", "sin", "Cos", "cos"):
        return f"{kind.lower()}({parts[0]})"
    return str(e) if "Symbol" in kind else repr(float(e))


def wrenfold():
    import importlib.metadata

    from wrenfold import code_generation, sym
    from wrenfold.type_annotations import FloatScalar

    for name, inputs in INPUTS.items():
        arguments = [f"{key}_{k}" for key, size in inputs.items() for k in range(size)]

        def results(**values):
            symbols = [[values[f"{key}_{k}"] for k in range(size)] for key, size in inputs.items()]
            if name == "hand_eye":
                tangent = sym.make_symbols(*(f"tangent_{k}" for k in range(6)))
                residual = hand_eye(sym.sin, sym.cos, tangent[:3], tangent[3:], *symbols)
                slopes = [r.diff(t) for t in tangent for r in residual]
                pairs = [(t, sym.integer(0)) for t in tangent]
                found = [sym.subs(e, pairs) for e in residual + slopes]
            else:
                distance = clearance(sym.sin, sym.cos, *symbols)
                found = [distance] + [distance.diff(q) for q in symbols[0]]
            return [code_generation.OutputArg(e, f"y{k}") for k, e in enumerate(found)]

        kind = inspect.Parameter.POSITIONAL_OR_KEYWORD
        parameters = [inspect.Parameter(a, kind, annotation=FloatScalar) for a in arguments]
        results.__signature__ = inspect.Signature(parameters)
        results.__annotations__ = dict.fromkeys(arguments, FloatScalar)
        text = code_generation.generate_function(results, code_generation.CppGenerator(), name=f"{name}_of")
        counts = dict(re.findall(r"// (\w+): (\d+)", text))
        print("wrenfold", importlib.metadata.version("wrenfold"), name, counts)
        if len(sys.argv) > 1:
            outputs = text.split(")")[0].count("Scalar& ")
            given = [f"x[{k}]" for k in range(len(arguments))] + [f"y[{k}]" for k in range(outputs)]
            with open(f"{sys.argv[1]}/program_wrenfold_{name}.cpp", "w") as file:
                call = f"{name}_of<double>({', '.join(given)});"
                head = f'extern "C" void {name}_wrenfold(const double *x, double *y)'
                file.write(f"#include <cmath>\n#include <cstdint>\n{text}\n{head} {{ {call} }}\n")


def counted(sf, trees):
    """Operations in expressions after the elimination: n-ary sums and products as pairs, small powers as products."""
    found = Counter()
    for tree in trees:
        stack = [sf.S(tree)]
        while stack:
            e = stack.pop()
            arguments = list(e.args)
            stack.extend(arguments)
            kind = type(e).__name__
            if kind == "Add":
                found["flops"] += len(arguments) - 1
            elif kind == "Mul":
                signs = sum(1 for a in arguments if a == -1)
                found["negations"] += signs
                found["flops"] += len(arguments) - 1 - signs
            elif kind == "Pow":
                power = int(arguments[1])
                found["divisions"] += power < 0
                found["flops"] += abs(power) - 1
            elif kind in ("Sin", "sin"):
                found["sines"] += 1
            elif kind in ("Cos", "cos"):
                found["cosines"] += 1
            elif arguments:
                raise ValueError(kind)
    return dict(found)


for library in (casadi, symforce, wrenfold):
    try:
        library()
    except ImportError as missing:
        print(f"{library.__name__} is skipped: {missing}", file=sys.stderr)
