"""A mug that stands at the origin, its handle towards x."""

from math import cos, pi, sin, tau

import mesh_file
from solid import lathe, loft

RADIUS, HEIGHT, WALL = 0.04, 0.095, 0.004


def handle():
    rings = []
    for k in range(13):
        along = -pi / 2 + pi * k / 12
        x, z = RADIUS - 0.002 + 0.027 * cos(along), 0.048 + 0.03 * sin(along)
        rings.append([(x + 0.005 * cos(a) * cos(along), 0.007 * sin(a), z + 0.005 * cos(a) * sin(along))
                      for a in (tau * i / 12 for i in range(12))])
    return loft(rings)


def files():
    outside = [(RADIUS - 0.004, 0), (RADIUS, 0.004), (RADIUS, HEIGHT - 0.0015), (RADIUS - 0.0015, HEIGHT)]
    inside = [(RADIUS - WALL + 0.0015, HEIGHT), (RADIUS - WALL, HEIGHT - 0.0015), (RADIUS - WALL, 0.01),
              (RADIUS - 0.01, WALL)]
    return {"mug.stl": mesh_file.stl([lathe(outside + inside, 36), handle()])}
