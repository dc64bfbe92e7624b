"""A robot that balances on two wheels."""

from math import cos, pi, sin, tau

from solid import Z_TO_X, Z_TO_Y, around, bar, cylinder, hoop, lathe, limb, rectangle, slab
from urdf import Box, Cylinder, Robot, Visual

WHEEL, TRACK = 0.10, 0.30  # radius; distance between the wheels' middles


def chassis():
    hull = limb([(-0.055, 0.13, 0.17, 0.05, 0), (-0.02, 0.16, 0.20, 0.05, 0), (0.08, 0.165, 0.205, 0.05, 0),
                 (0.13, 0.14, 0.18, 0.05, 0)], 0.02, 4)
    axle = cylinder(0.035, 0.22, 0.004, 20).moved(turned=Z_TO_Y)
    mast = [slab(rectangle(0.03, 0.03, 0.01), 0.30, 0.003).moved((0, y, 0.27)) for y in (-0.045, 0.045)]
    tray = [slab(rectangle(0.11, 0.15, 0.03, 4), 0.016, 0.004).moved((0, 0, 0.22))]
    head = limb([(0.40, 0.09, 0.15, 0.035, 0), (0.42, 0.11, 0.19, 0.045, 0), (0.49, 0.115, 0.195, 0.045, 0),
                 (0.52, 0.09, 0.17, 0.04, 0)], 0.014, 4)
    visor = slab(rectangle(0.16, 0.055, 0.025, 4), 0.02, 0.005).moved((0.052, 0, 0.457), (pi / 2, 0, pi / 2))
    eyes = [cylinder(0.014, 0.006, 0.002, 12).moved((0.0625, y, 0.457), Z_TO_X) for y in (-0.04, 0.04)]
    belt = limb([(0.02, 0.169, 0.209, 0.052, 0), (0.045, 0.169, 0.209, 0.052, 0)], 0.003, 3)
    return [("white", [hull, head]), ("graphite", [axle, visor] + mast), ("blue", tray + [belt]), ("light", eyes)]


def meshes(robot):
    robot.painted_mesh("chassis", chassis())
    section = [(0.018 * cos(a) * (0.55 if cos(a) < 0 else 1), 0.026 * sin(a)) for a in
               (tau * k / 10 for k in range(10))]
    robot.mesh("tyre", hoop(section, WHEEL - 0.018, 44).moved(turned=Z_TO_Y))
    rim = hoop([(0.006, -0.022), (0.006, 0.022), (-0.004, 0.02), (-0.004, -0.02)], 0.075, 36)
    spoke = bar(0.013, 0.008, 0.06, 0.014, 0.003, 4).moved((0.012, 0, 0), (0, pi / 2, 0)).moved(turned=(pi / 2, 0, 0))
    hub = lathe([(0.024, -0.026), (0.026, -0.02), (0.026, 0.02), (0.02, 0.028), (0.008, 0.031)], 28)
    robot.mesh("rim", *(part.moved(turned=Z_TO_Y) for part in [rim, hub] + around(spoke, 5)))


def robot():
    machine = Robot("balancer", ["A robot that balances on two wheels; x is forward, the wheels turn about y.",
                                 "The root stands on the axle. Read it with a free base to let it fall."],
                    {"white": (0.93, 0.94, 0.95), "graphite": (0.20, 0.22, 0.25), "blue": (0.10, 0.42, 0.72),
                     "light": (0.45, 0.90, 0.95), "rubber": (0.13, 0.13, 0.14), "metal": (0.93, 0.66, 0.15)},
                    "package://balancer/meshes/")
    meshes(machine)
    machine.link("chassis", 6.2, [Box(0.165, 0.205, 0.185, (0, 0, 0.0375)), Box(0.03, 0.12, 0.27, (0, 0, 0.265)),
                                  Box(0.115, 0.195, 0.12, (0, 0, 0.46))], [Visual("chassis")])
    for side, sign in (("left", 1), ("right", -1)):
        machine.joint(f"{side}_wheel_drive", "continuous", "chassis", f"{side}_wheel", (0, sign * TRACK / 2, 0),
                      axis=(0, 1, 0), effort=6, velocity=25, damping=0.01, friction=0.02)
        turned = (0, 0, 0 if sign > 0 else pi)
        machine.link(f"{side}_wheel", 0.7, [Cylinder(WHEEL, 0.05, turned=Z_TO_Y)],
                     [Visual("tyre", "rubber"), Visual("rim", "metal", turned=turned)])
    machine.joint("imu_mount", "fixed", "chassis", "imu", (0, 0, 0.1))
    machine.frame("imu")
    machine.joint("camera_mount", "fixed", "chassis", "camera", (0.063, 0, 0.457))
    machine.frame("camera")
    return machine
