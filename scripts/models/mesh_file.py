"""Solids as files: binary STL, and OBJ with a colour for each part."""

import struct


def _snapped(solid):
    """Corners on a grid of a micrometre, so that every machine writes the same bytes."""
    if not solid.is_closed() or solid.volume() <= 0:
        raise ValueError("a surface is not closed")
    return [tuple(round(x, 6) + 0.0 for x in p) for p in solid.points]


def _normal(a, b, c):
    u, v = [y - x for x, y in zip(a, b)], [y - x for x, y in zip(a, c)]
    n = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
    length = sum(x * x for x in n) ** 0.5
    return tuple(round(x / length, 4) + 0.0 for x in n) if length > 0 else (0.0, 0.0, 0.0)


def stl(solids):
    facets = []
    for solid in solids:
        points = _snapped(solid)
        for corners in ([points[i] for i in triangle] for triangle in solid.triangles):
            facets.append(struct.pack("<12fH", *_normal(*corners), *(x for p in corners for x in p), 0))
    return b"binary STL, metres".ljust(80) + struct.pack("<I", len(facets)) + b"".join(facets)


def obj(parts, library):
    """Parts are pairs (material, solids); `library` is the file that describes the materials."""
    lines, before = [f"# metres\nmtllib {library}"], 1
    for material, solids in parts:
        lines.append(f"usemtl {material}")
        for solid in solids:
            lines += ["v " + " ".join(f"{x:.5g}" for x in p) for p in _snapped(solid)]
            lines += [f"f {a + before} {b + before} {c + before}" for a, b, c in solid.triangles]
            before += len(solid.points)
    return ("\n".join(lines) + "\n").encode()


def mtl(colors):
    lines = [f"newmtl {name}\nKd {red} {green} {blue}" for name, (red, green, blue) in colors.items()]
    return ("\n".join(lines) + "\n").encode()
