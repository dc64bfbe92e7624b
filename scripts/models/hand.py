"""A hand: four fingers and a thumb, whose last joints follow the ones before."""

from math import pi

from solid import Z_TO_Y, bar, cylinder, lathe, limb, rectangle, slab
from urdf import Box, Cylinder, Robot, Visual

# Of each finger: where it leaves the palm, how it fans out, its size. Lengths of the phalanges at size 1.
FINGERS = (("index", (0, 0.033, 0.098), 0.06, 0.95), ("middle", (0, 0.011, 0.102), 0.0, 1.0),
           ("ring", (0, -0.011, 0.099), -0.06, 0.94), ("little", (0, -0.032, 0.091), -0.13, 0.78))
PROXIMAL, MIDDLE, DISTAL = 0.045, 0.029, 0.022


def phalanx(length, width):
    return [bar(0.0085, 0.0075, length, width, 0.0025),
            limb([(0.008, 0.0165, width + 0.0025, 0.006, 0), (0.5 * length, 0.0175, width + 0.003, 0.0065, 0.0005),
                  (length - 0.0075, 0.015, width + 0.001, 0.006, 0)], 0.002)]


def meshes(robot):
    robot.mesh("palm", limb([(0.004, 0.03, 0.052, 0.014, 0), (0.02, 0.032, 0.066, 0.015, 0),
                             (0.06, 0.032, 0.086, 0.015, 0), (0.092, 0.025, 0.088, 0.012, 0)], 0.005, 5))
    cushions = [slab(rectangle(y, z, 0.014, 4), 0.006, 0.002, 1).moved((x, shift, 0.05), (pi / 2, 0, pi / 2))
                for x, y, z, shift in ((-0.0155, 0.056, 0.05, -0.002), (0.0155, 0.058, 0.056, -0.006))]
    robot.mesh("palm_trim", *cushions,
               *(bar(0.009, 0.0075, 0.012, 0.017 * size, 0.002, 5).moved((0, at[1], at[2] - 0.012))
                 for _, at, _, size in FINGERS),
               limb([(0.012, 0.026, 0.024, 0.009, 0), (0.045, 0.024, 0.022, 0.009, 0)], 0.004)
               .moved((0.004, 0.034, 0.0)))
    robot.mesh("wrist", lathe([(0.028, -0.045), (0.03, -0.042), (0.03, -0.03), (0.024, -0.026), (0.022, 0.008)], 32))
    robot.mesh("wrist_ring", lathe([(0.029, -0.029), (0.0315, -0.0275), (0.0315, -0.022), (0.026, -0.02)], 32))
    robot.mesh("proximal", *phalanx(PROXIMAL, 0.014))
    robot.mesh("middle", *phalanx(MIDDLE, 0.013))
    robot.mesh("distal", bar(0.008, 0.0058, 0.0095, 0.0125, 0.003, 10))
    robot.mesh("tip", limb([(0.0065, 0.0162, 0.0145, 0.006, 0), (0.012, 0.0165, 0.015, 0.0062, 0.0006),
                            (0.0185, 0.0145, 0.0132, 0.0055, 0.001), (0.0235, 0.0085, 0.008, 0.0035, 0.0005)],
                           0.0014, 5))
    robot.mesh("pin", cylinder(0.0052, 0.0185, 0.0008, 20).moved(turned=Z_TO_Y))


def finger(robot, name, up, size, last_ratio):
    """The three phalanges, from `up` above the link NAME_base; they bend towards x."""
    parent = f"{name}_base"
    for part, length, limits, effort in (("proximal", PROXIMAL, (-0.2, 1.6), 1.2), ("middle", MIDDLE, (0, 1.75), 0.8),
                                         ("distal", DISTAL, (0, 1.4), 0.4)):
        joint = {"proximal": "knuckle", "middle": "middle_bend", "distal": "distal_bend"}[part]
        follows = (f"{name}_middle_bend", last_ratio, 0) if part == "distal" else None
        robot.joint(f"{name}_{joint}", "revolute", parent, f"{name}_{part}", (0, 0, up), axis=(0, 1, 0), limits=limits,
                    effort=effort, velocity=6, damping=0.01, friction=0.005, mimic=follows)
        looks = [Visual(part, "shell", scale=size), Visual("pin", "graphite", scale=size)]
        if part == "distal":
            looks.append(Visual("tip", "blue", scale=size))
        mass = {"proximal": 0.022, "middle": 0.014, "distal": 0.009}[part] * size
        robot.link(f"{name}_{part}", mass, [Box(0.016 * size, 0.015 * size, length * size, (0, 0, length * size / 2))],
                   looks)
        parent, up = f"{name}_{part}", length * size
    robot.joint(f"{name}_tip_mount", "fixed", parent, f"{name}_tip", (0, 0, up))
    robot.frame(f"{name}_tip")


def attach(robot, palm="palm", side="", sign=1):
    """The whole hand, its palm called `palm` and all else with the prefix `side`; a left one with a sign of -1."""
    flipped = (1, sign, 1)
    robot.link(palm, 0.38, [Box(0.032, 0.086, 0.08, (0, 0, 0.05)), Cylinder(0.028, 0.045, (0, 0, -0.02))],
               [Visual("palm", "shell", scale=flipped), Visual("palm_trim", "graphite", scale=flipped),
                Visual("wrist", "graphite"), Visual("wrist_ring", "accent")])
    for finger_name, (x, y, z), fan, size in FINGERS:
        name = side + finger_name
        robot.joint(f"{name}_spread", "revolute", palm, f"{name}_base", (x, sign * y, z), (-sign * fan, 0, 0),
                    (sign, 0, 0), (-0.3, 0.3), effort=0.6, velocity=6, damping=0.01, friction=0.005)
        robot.link(f"{name}_base", 0.006, [Cylinder(0.008 * size, 0.016 * size, turned=Z_TO_Y)],
                   [Visual("pin", "graphite", scale=size)])
        finger(robot, name, 0, size, 0.75)
    thumb = side + "thumb"
    robot.joint(f"{thumb}_opposition", "revolute", palm, f"{thumb}_base", (0.006, sign * 0.036, 0.028),
                (-sign * 0.75, 0, sign * 0.5), (0, 0, sign), (-0.3, 1.4), effort=1.2, velocity=6, damping=0.01,
                friction=0.005)
    robot.link(f"{thumb}_base", 0.015, [Cylinder(0.008, 0.026, (0, 0, 0.013))],
               [Visual("pin", "graphite", scale=1.2), Visual("middle", "graphite", scale=0.95)])
    finger(robot, thumb, 0.026, 1.05, 0.7)
    for name in ("index", "middle", "ring", "little", "thumb"):
        robot.overlap(palm, f"{side}{name}_proximal")


def robot():
    hand = Robot("hand", ["A right hand: fingers point along z and bend towards x, the thumb is on the side of y.",
                          "Fifteen hinges move it; the last joint of each finger follows the one before."],
                 {"shell": (0.90, 0.91, 0.92), "graphite": (0.22, 0.24, 0.27), "blue": (0.12, 0.45, 0.75),
                  "accent": (0.95, 0.49, 0.10)})
    meshes(hand)
    attach(hand)
    for name, knuckle, bend, thumb in (("home", 0, 0, 0), ("half_closed", 0.7, 0.7, 0.9)):
        bends = {f"{finger}_knuckle": knuckle for finger, *_ in FINGERS}
        bends |= {f"{finger}_middle_bend": bend for finger, *_ in FINGERS}
        hand.state(name, **bends, thumb_opposition=thumb, thumb_knuckle=knuckle / 2, thumb_middle_bend=bend / 2)
    return hand
