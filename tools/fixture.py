"""Writes the numbers of another program for the tests to read."""

import json
from pathlib import Path

import pinocchio

ROOT = Path(__file__).resolve().parent.parent


def write(name, script, head, samples):
    """tests/data/pinocchio/<name>.json: what the samples are of, and one of them a line."""
    made_by = f"tools/{Path(script).name} with Pinocchio {pinocchio.__version__}"
    lines = ",\n".join(json.dumps(each, separators=(",", ":")) for each in samples)
    text = json.dumps({"made_by": made_by} | head)[:-1] + f',\n"samples": [\n{lines}\n]}}\n'
    json.loads(text)
    path = ROOT / f"tests/data/pinocchio/{name}.json"
    path.parent.mkdir(exist_ok=True)
    path.write_text(text)
