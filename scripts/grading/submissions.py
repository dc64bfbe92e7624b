"""Texts that students could hand in, made from an exercise's solution and its wrong variants."""

import re

_REGION = re.compile(r"^[ \t]*// <solution (\w[\w-]*)>\n(.*?)^[ \t]*// </solution>\n", re.MULTILINE | re.DOTALL)


def variant(solution, mistakes):
    """The solution with the text of some of its regions replaced: name of a region to text."""
    known = {name for name, _ in _REGION.findall(solution)}
    if not mistakes or not mistakes.keys() <= known:
        raise ValueError(f"regions: found {sorted(mistakes)}, wanted some of {sorted(known)}")
    return _REGION.sub(lambda found: mistakes.get(found[1], found[0]), solution)


def reference(exercise):
    return (exercise / "solution.cpp").read_text()


def wrong_variants(exercise):
    """Name to text, of each file in the folder `wrong` of an exercise."""
    solution = reference(exercise)
    return {path.stem: variant(solution, dict(_REGION.findall(path.read_text())))
            for path in sorted((exercise / "wrong").glob("*.cpp"))}
