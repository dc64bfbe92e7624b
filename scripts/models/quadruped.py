"""A dog of twelve hinges."""

from math import pi

from solid import Z_TO_X, Z_TO_Y, ball, bar, box, cylinder, limb, rectangle, slab
from urdf import Box, Cylinder, Robot, Sphere, Visual

HIP = (0.20, 0.06)  # of the front left one: before and beside the middle
OFFSET, THIGH, SHANK, FOOT = 0.085, 0.22, 0.22, 0.024


def meshes(robot):
    def along(sections, edge):  # a limb along x, whose sections give z and y
        return limb([(x, z, y, corner, -shift) for x, z, y, corner, shift in sections], edge, 5).moved(turned=Z_TO_X)
    robot.mesh("torso", along([(-0.26, 0.07, 0.10, 0.03, 0), (-0.23, 0.105, 0.15, 0.04, 0.002),
                               (-0.10, 0.115, 0.18, 0.045, 0.006), (0.10, 0.12, 0.18, 0.045, 0.008),
                               (0.22, 0.11, 0.16, 0.04, 0.006), (0.265, 0.085, 0.12, 0.035, 0.004)], 0.016))
    robot.mesh("torso_trim", slab(rectangle(0.26, 0.11, 0.025, 4), 0.03, 0.006).moved((-0.01, 0, 0.066)),
               slab(rectangle(0.10, 0.05, 0.02, 4), 0.03, 0.006).moved((0.262, 0, 0.004), (pi / 2, 0, pi / 2)),
               *(cylinder(0.05, 0.07, 0.008, 20).moved((x, y, 0), Z_TO_X) for x in (-HIP[0], HIP[0])
                 for y in (-HIP[1], HIP[1])))
    robot.mesh("torso_lights", *(cylinder(0.009, 0.006, 0.002, 12).moved((0.279, y, 0.008), Z_TO_X)
                                 for y in (-0.028, 0.028)),
               *(box(0.12, 0.012, 0.004, 0.004, 0.001).moved((-0.01, y, 0.081)) for y in (-0.03, 0.03)))
    robot.mesh("hip", cylinder(0.046, 0.066, 0.01, 28).moved(turned=Z_TO_Y).moved((0, 0.016, 0)),
               cylinder(0.034, 0.05, 0.006, 24).moved((0, 0, 0), Z_TO_X))
    robot.mesh("thigh", bar(0.046, 0.03, THIGH, 0.036, 0.009, 12).moved(turned=(pi, 0, 0)))
    robot.mesh("thigh_caps", cylinder(0.034, 0.05, 0.006, 28).moved((0, 0.006, 0), Z_TO_Y),
               cylinder(0.022, 0.046, 0.004, 24).moved((0, 0, -THIGH), Z_TO_Y),
               bar(0.015, 0.012, 0.11, 0.042, 0.004, 6).moved((0, 0, -0.06), (pi, 0, 0)))
    robot.mesh("shank", limb([(-SHANK, 0.022, 0.022, 0.01, 0), (-0.16, 0.022, 0.022, 0.01, 0.0),
                              (-0.07, 0.032, 0.026, 0.012, -0.008), (0, 0.04, 0.03, 0.013, 0),
                              (0.018, 0.03, 0.028, 0.012, 0.002)], 0.006))
    robot.mesh("foot", ball(FOOT, 20, 10), cylinder(0.015, 0.03, 0.003, 20).moved((0, 0, 0.024)))


def leg(robot, name, front, left):
    def hinge(joint, parent, child, at, axis, limits, effort):
        robot.joint(f"{name}_{joint}", "revolute", parent, f"{name}_{child}", at, axis=axis, limits=limits,
                    effort=effort, velocity=21, damping=0.1, friction=0.2)
    # The hip is made for the left side.
    beside = (0, 0, 0) if left > 0 else (0, 0, pi)
    hinge("hip_roll", "torso", "hip", (front * HIP[0], left * HIP[1], 0), (1, 0, 0), (-0.85, 0.85), 24)
    robot.link(f"{name}_hip", 0.65, [Cylinder(0.046, 0.05, (0, left * 0.025, 0), Z_TO_Y)],
               [Visual("hip", "steel", turned=beside)])
    hinge("hip_pitch", f"{name}_hip", "thigh", (0, left * OFFSET, 0), (0, 1, 0), (-1.5, 3.4), 24)
    robot.link(f"{name}_thigh", 1.0, [Box(0.06, 0.036, 0.2, (0, 0, -0.11)), Cylinder(0.046, 0.04, turned=Z_TO_Y)],
               [Visual("thigh", "paint"), Visual("thigh_caps", "graphite", turned=beside)])
    hinge("knee", f"{name}_thigh", "shank", (0, 0, -THIGH), (0, 1, 0), (-2.75, -0.5), 36)
    robot.link(f"{name}_shank", 0.22, [Cylinder(0.013, 0.19, (0, 0, -0.1))], [Visual("shank", "steel")])
    robot.joint(f"{name}_foot_mount", "fixed", f"{name}_shank", f"{name}_foot", (0, 0, -SHANK))
    robot.link(f"{name}_foot", 0.06, [Sphere(FOOT)], [Visual("foot", "rubber")])


def robot():
    dog = Robot("quadruped", ["A dog of twelve hinges; x is forward, the root is the middle of the torso.",
                              "At zero the legs hang straight down, which no knee can: stand with hip_pitch 0.75,",
                              "knee -1.5."],
                {"paint": (0.96, 0.72, 0.10), "graphite": (0.19, 0.21, 0.24), "steel": (0.42, 0.45, 0.49),
                 "rubber": (0.10, 0.10, 0.11), "light": (0.55, 0.92, 0.98)}, "package://quadruped/meshes/")
    meshes(dog)
    dog.link("torso", 6.0, [Box(0.50, 0.17, 0.115)],
             [Visual("torso", "paint"), Visual("torso_trim", "graphite"), Visual("torso_lights", "light")])
    legs = (("front_left", 1, 1), ("front_right", 1, -1), ("rear_left", -1, 1), ("rear_right", -1, -1))
    for name, front, left in legs:
        leg(dog, name, front, left)
    dog.joint("imu_mount", "fixed", "torso", "imu", (0, 0, 0.02))
    dog.frame("imu")
    for state, pitch, knee in (("home", 0.75, -1.5), ("crouch", 1.2, -2.4)):
        bends = {"hip_pitch": pitch, "knee": knee}
        dog.state(state, **{f"{name}_{joint}": bend for name, _, _ in legs for joint, bend in bends.items()})
    return dog
