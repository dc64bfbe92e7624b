"""What `rex grade` leaves, without what may differ between two gradings of the same file."""

import json
import pathlib


def stable(results):
    """The text of a results.json without its fields called volatile and its seal, which is another for each student."""

    def strip(value):
        if isinstance(value, dict):
            return {name: strip(entry) for name, entry in value.items() if name not in ("volatile", "result_hmac")}
        return [strip(entry) for entry in value] if isinstance(value, list) else value

    return json.dumps(strip(json.loads(results.read_text())), indent=1)


def files(out):
    """All that a folder of results holds of the students: path to what must not differ."""
    out = pathlib.Path(out)
    found = {}
    for path in sorted(out.glob("*/*/*")):
        found[str(path.relative_to(out))] = stable(path) if path.name == "results.json" else path.read_bytes()
    return found


def differences(first, second):
    """The names of files that only one of two folders of results has, or that differ."""
    one, two = files(first), files(second)
    return sorted(name for name in one.keys() | two.keys() if one.get(name) != two.get(name))
