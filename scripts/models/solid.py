"""Closed surfaces of triangles with outward normals, the bricks of all meshes. Lengths in metres, angles in radians.

An outline is a function of an inset: outline(d) lists the points of a convex curve in the x-y plane, anticlockwise, its
edge moved inwards by d. That gives rounded edges for nothing.
"""

from math import asin, cos, pi, sin, tau

Z_TO_X = (0, pi / 2, 0)  # turns that lay a solid made along z down on another axis
Z_TO_Y = (-pi / 2, 0, 0)


def rotation(roll, pitch, yaw):
    """The matrix Rz(yaw) Ry(pitch) Rx(roll), by rows."""
    (a, b, c), (x, y, z) = (cos(roll), cos(pitch), cos(yaw)), (sin(roll), sin(pitch), sin(yaw))
    return ((b * c, x * y * c - a * z, a * y * c + x * z),
            (b * z, x * y * z + a * c, a * y * z - x * c),
            (-y, x * b, a * b))


class Solid:
    """Points and triangles, anticlockwise seen from outside."""

    def __init__(self, points, triangles):
        self.points, self.triangles = points, triangles
        if self.volume() < 0:
            self.triangles = [(a, c, b) for a, b, c in triangles]

    def moved(self, at=(0, 0, 0), turned=(0, 0, 0)):
        """The solid turned by roll, pitch and yaw, then moved."""
        rows = rotation(*turned)
        points = [tuple(o + sum(r * x for r, x in zip(row, p)) for row, o in zip(rows, at)) for p in self.points]
        return Solid(points, self.triangles)

    def volume(self):
        total = 0
        for a, b, c in ([self.points[i] for i in triangle] for triangle in self.triangles):
            total += (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2])
                      + a[2] * (b[0] * c[1] - b[1] * c[0])) / 6
        return total

    def is_closed(self):
        """Whether each edge belongs to two triangles that agree on the outside."""
        edges = [edge for a, b, c in self.triangles for edge in ((a, b), (b, c), (c, a))]
        return len(set(edges)) == len(edges) and set(edges) == {(b, a) for a, b in edges}



def circle(radius, count=32):
    return lambda inset: [((radius - inset) * cos(tau * k / count), (radius - inset) * sin(tau * k / count))
                          for k in range(count)]


def rectangle(x, y, corner, count=4):
    """Of edges x and y, with round corners."""
    def outline(inset):
        r = max(corner - inset, 4e-4)
        points = []
        for quarter, (i, k) in enumerate(((1, 1), (-1, 1), (-1, -1), (1, -1))):
            middle = i * (x / 2 - inset - r), k * (y / 2 - inset - r)
            for step in range(count + 1):
                angle = (quarter + step / count) * pi / 2
                points.append((middle[0] + r * cos(angle), middle[1] + r * sin(angle)))
        return points
    return outline


def taper(low, high, length, count=12):
    """Around a circle of radius `low` at the origin and one of radius `high` at y = length."""
    slope = asin((low - high) / length)
    def outline(inset):
        points = []
        for radius, y, start, end in ((low, 0, pi - slope, tau + slope), (high, length, slope, pi - slope)):
            for step in range(count + 1):
                angle = start + (end - start) * step / count
                points.append(((radius - inset) * cos(angle), y + (radius - inset) * sin(angle)))
        return points
    return outline


def loft(rings, closed=False):
    """The surface through rings of equally many points, with flat ends or closed to a loop."""
    count = len(rings[0])
    points = [p for ring in rings for p in ring]
    triangles = []
    for i in range(len(rings) if closed else len(rings) - 1):
        low, high = i * count, (i + 1) % len(rings) * count
        for k in range(count):
            n = (k + 1) % count
            triangles += [(low + k, low + n, high + n), (low + k, high + n, high + k)]
    if not closed:
        for ring, first, down in ((rings[0], 0, True), (rings[-1], len(points) - count, False)):
            middle = len(points)
            points.append(tuple(sum(axis) / count for axis in zip(*ring)))
            for k in range(count):
                a, b = first + k, first + (k + 1) % count
                triangles.append((middle, b, a) if down else (middle, a, b))
    return Solid(points, triangles)


def rounding(edge, steps):
    """Pairs (inset, height) up a quarter of a circle, from its flat end."""
    return [(edge * (1 - sin(pi / 2 * k / steps)), edge * (1 - cos(pi / 2 * k / steps))) for k in range(steps + 1)]


def slab(outline, height, edge, steps=2):
    """An outline made `height` thick, its middle at z = 0, the edges rounded."""
    levels = [(inset, up - height / 2) for inset, up in rounding(edge, steps)]
    levels += [(inset, -z) for inset, z in reversed(levels)]
    return loft([[(x, y, z) for x, y in outline(inset)] for inset, z in levels])


def box(x, y, z, corner, edge, count=3):
    return slab(rectangle(x, y, corner, count), z, edge)


def cylinder(radius, height, edge, count=28):
    return slab(circle(radius, count), height, edge, 1)


def bar(low, high, length, thickness, edge, count=10):
    """A tapered bar with round ends: along z from the origin, `thickness` along y."""
    return slab(taper(low, high, length, count), thickness, edge).moved(turned=(pi / 2, 0, 0))


def limb(sections, edge, count=4):
    """Through rounded rectangles (z, x, y, corner, shift along x), upwards; the ends rounded."""
    def ring(section, z, inset):
        _, x, y, corner, shift = section
        return [(px + shift, py, z) for px, py in rectangle(x, y, corner, count)(inset)]
    first, last = sections[0], sections[-1]
    ends = rounding(edge, 2)
    rings = [ring(first, first[0] + up, inset) for inset, up in ends]
    rings += [ring(section, section[0], 0) for section in sections[1:-1]]
    rings += [ring(last, last[0] - up, inset) for inset, up in reversed(ends)]
    return loft(rings)


def lathe(profile, count=32):
    """Turns pairs (radius, z), upwards, around the z axis."""
    return loft([[(x, y, z) for x, y in circle(radius, count)(0)] for radius, z in profile])


def ball(radius, count=24, rows=10):
    angles = [-pi / 2 + pi * (k + 0.5) / rows for k in range(rows)]
    return lathe([(radius * cos(a), radius * sin(a)) for a in angles], count)


def hoop(outline, radius, count=40):
    """A closed curve in the plane of radius and z, turned around the z axis at `radius`."""
    rings = []
    for k in range(count):
        angle = tau * k / count
        rings.append([((radius + x) * cos(angle), (radius + x) * sin(angle), z) for x, z in outline])
    return loft(rings, closed=True)


def around(solid, count, start=0):
    """Copies of a solid, turned around the z axis."""
    return [solid.moved(turned=(0, 0, start + tau * k / count)) for k in range(count)]
