"""Texts that students could hand in, made from an exercise's solution and its wrong variants."""

import re

_REGION = re.compile(r"^[ \t]*// <solution (\w[\w-]*)>\n(.*?)^[ \t]*// </solution>\n", re.MULTILINE | re.DOTALL)
_TODO = re.compile(r"^[ \t]*// <todo>\n", re.MULTILINE)
_PASSAGE = re.compile(r"^[ \t]*// in place of: (.*?)(?: \.\.\. (.*))?\n", re.MULTILINE)
_SECTION = re.compile(r"^// <(variant|solution) (\w[\w-]*)>.*\n", re.MULTILINE)


def variant(solution, mistakes):
    """The solution with the text of some of its regions replaced: name of a region to text."""
    known = {name for name, _ in _REGION.findall(solution)}
    if not mistakes or not mistakes.keys() <= known:
        raise ValueError(f"regions: found {sorted(mistakes)}, wanted some of {sorted(known)}")
    return _REGION.sub(lambda found: mistakes.get(found[1], found[0]), solution)


def reference(exercise):
    return (exercise / "solution.cpp").read_text()


def with_passages(region, text):
    """The region of a solution with the passages replaced that `// in place of: BEGIN ... END` names in the text."""
    first, *parts = _PASSAGE.split(text)
    if not parts:
        return first
    lines, done = [], 0
    old = region.splitlines(keepends=True)
    for begin, end, new in zip(parts[::3], parts[1::3], parts[2::3]):
        at = next(i for i, line in enumerate(old) if line.strip().startswith(begin))
        last = next(i for i, line in enumerate(old) if i > at and line.strip().startswith(end)) if end else at
        lines += old[done:at] + [new.rstrip("\n") + "\n" if new.strip() else ""]
        done = last + 1
    return "".join(lines + old[done:])


def wrong_variants(exercise):
    """Name to text, of each variant in wrong.cpp of an exercise, in the order of their names."""
    _, *parts = _SECTION.split((exercise / "wrong.cpp").read_text())
    known = {name: _TODO.split(text)[0] for name, text in _REGION.findall(reference(exercise))}
    mistakes = {}
    for word, name, text in zip(parts[::3], parts[1::3], parts[2::3]):
        if word == "variant":
            regions = mistakes[name] = {}
        else:
            regions[name] = with_passages(known.get(name, ""), text.rstrip("\n") + "\n" if text.strip() else "")
    return {name: variant(reference(exercise), regions) for name, regions in sorted(mistakes.items())}
