"""A humanoid of 25 hinges, or 55 with the fingers of two hands, built to walk: flat feet, and the three axes of each hip and the two of each ankle cross."""

from math import pi

import hand
from solid import Z_TO_X, Z_TO_Y, ball, bar, box, cylinder, limb, rectangle, slab
from urdf import Box, Cylinder, Robot, Sphere, Visual

HIP = (0, 0.095, -0.09)  # of the left one, from the middle of the pelvis
THIGH, SHANK, ANKLE = 0.36, 0.36, 0.075  # hip to knee to ankle to sole
SHOULDER = (0, 0.185, 0.34)  # of the left one, from the waist
UPPER_ARM, FOREARM = 0.25, 0.22


def torso():
    chest = limb([(0.03, 0.13, 0.17, 0.05, 0), (0.10, 0.14, 0.19, 0.06, 0), (0.20, 0.18, 0.27, 0.07, 0.005),
                  (0.32, 0.20, 0.31, 0.08, 0.005), (0.39, 0.16, 0.26, 0.07, 0), (0.415, 0.11, 0.16, 0.05, 0)], 0.012, 5)
    plate = limb([(0.20, 0.03, 0.20, 0.012, 0.086), (0.24, 0.04, 0.23, 0.018, 0.091), (0.33, 0.04, 0.24, 0.018, 0.092),
                  (0.365, 0.03, 0.18, 0.012, 0.085)], 0.008)
    pack = box(0.07, 0.20, 0.22, 0.025, 0.012).moved((-0.10, 0, 0.27))
    lamp = cylinder(0.028, 0.012, 0.003, 28).moved((0.112, 0, 0.285), Z_TO_X)
    waist = cylinder(0.07, 0.07, 0.006, 28).moved((0, 0, 0.015))
    return [("white", [chest]), ("teal", [plate]), ("graphite", [pack, waist]), ("light", [lamp])]


def trunk_meshes(robot):
    robot.painted_mesh("torso", torso())
    robot.mesh("pelvis", limb([(-0.075, 0.11, 0.14, 0.04, 0), (-0.03, 0.15, 0.25, 0.05, 0),
                               (0.025, 0.15, 0.25, 0.05, 0), (0.06, 0.12, 0.18, 0.05, 0)], 0.012, 5))
    robot.mesh("neck", cylinder(0.035, 0.09, 0.004, 24).moved((0, 0, 0.02)))
    robot.mesh("head", limb([(-0.02, 0.10, 0.10, 0.04, 0), (0.02, 0.145, 0.125, 0.055, 0.008),
                             (0.08, 0.18, 0.15, 0.065, 0.006), (0.14, 0.175, 0.15, 0.065, 0),
                             (0.19, 0.14, 0.12, 0.055, -0.004)], 0.022, 6))
    robot.mesh("visor", limb([(0.045, 0.06, 0.11, 0.02, 0.058), (0.07, 0.07, 0.14, 0.03, 0.068),
                              (0.115, 0.07, 0.142, 0.03, 0.066), (0.14, 0.06, 0.115, 0.02, 0.055)], 0.008))
    robot.mesh("eyes", *(cylinder(0.011, 0.008, 0.002, 18).moved((0.103, y, 0.093), Z_TO_X) for y in (-0.03, 0.03)))


def arm_meshes(robot):
    robot.mesh("shoulder_bracket", cylinder(0.045, 0.06, 0.006, 28).moved((0, -0.005, 0), Z_TO_Y))
    robot.mesh("shoulder", ball(0.062, 28, 12))
    robot.mesh("upper_arm", limb([(-0.20, 0.062, 0.062, 0.028, 0), (-0.15, 0.075, 0.072, 0.03, 0),
                                  (-0.05, 0.08, 0.08, 0.035, 0), (0.01, 0.07, 0.07, 0.034, 0)], 0.008))
    robot.mesh("elbow", cylinder(0.036, 0.075, 0.006, 28).moved(turned=Z_TO_Y))
    robot.mesh("forearm", bar(0.034, 0.028, 0.06, 0.05, 0.006).moved(turned=(pi, 0, 0)),
               limb([(-0.19, 0.046, 0.046, 0.02, 0), (-0.14, 0.062, 0.06, 0.026, 0), (-0.07, 0.07, 0.068, 0.03, 0),
                     (-0.035, 0.055, 0.052, 0.022, 0)], 0.008))
    fingers = [limb([(-0.155, 0.018, 0.022, 0.008, 0.0), (-0.09, 0.024, 0.024, 0.009, 0)], 0.006, 2)
               .moved((x, 0, 0)) for x in (-0.03, 0, 0.03)]
    thumb = limb([(-0.075, 0.02, 0.02, 0.008, 0), (0, 0.024, 0.024, 0.009, 0)], 0.006, 3)
    robot.mesh("hand", cylinder(0.026, 0.03, 0.004, 24).moved((0, 0, -0.01)),
               limb([(-0.105, 0.085, 0.03, 0.012, 0), (-0.05, 0.088, 0.036, 0.015, 0), (-0.02, 0.05, 0.036, 0.015, 0)],
                    0.006), thumb.moved((0.042, 0, -0.035), (0, -0.6, 0)), *fingers)


def leg_meshes(robot):
    robot.mesh("hip_bracket", cylinder(0.05, 0.075, 0.006, 28).moved((0, 0, 0.045)))
    robot.mesh("hip", cylinder(0.052, 0.13, 0.008, 28).moved(turned=Z_TO_X))
    robot.mesh("thigh", limb([(-0.33, 0.085, 0.08, 0.03, 0.0), (-0.25, 0.10, 0.09, 0.04, 0.006),
                              (-0.12, 0.125, 0.11, 0.05, 0.008), (0.0, 0.12, 0.11, 0.05, 0),
                              (0.045, 0.09, 0.09, 0.04, 0)], 0.014, 5))
    robot.mesh("knee", cylinder(0.048, 0.105, 0.008, 28).moved(turned=Z_TO_Y))
    robot.mesh("shank", bar(0.046, 0.036, 0.09, 0.07, 0.008).moved(turned=(pi, 0, 0)),
               limb([(-0.325, 0.06, 0.06, 0.025, 0.0), (-0.26, 0.07, 0.066, 0.03, -0.004),
                     (-0.15, 0.10, 0.085, 0.038, -0.012), (-0.06, 0.085, 0.075, 0.032, 0)], 0.01, 5))
    robot.mesh("knee_cap", limb([(-0.075, 0.03, 0.06, 0.01, 0.044), (-0.02, 0.04, 0.078, 0.015, 0.047),
                                 (0.03, 0.03, 0.066, 0.012, 0.044)], 0.008))
    robot.mesh("ankle", cylinder(0.032, 0.085, 0.005, 24).moved(turned=Z_TO_Y),
               cylinder(0.026, 0.10, 0.004, 24).moved(turned=Z_TO_X))
    robot.mesh("foot", limb([(-0.062, 0.235, 0.105, 0.035, 0.03), (-0.04, 0.235, 0.105, 0.035, 0.03),
                             (-0.015, 0.12, 0.085, 0.03, 0.0), (0.015, 0.075, 0.06, 0.025, -0.005)], 0.01, 5))
    robot.mesh("sole", slab(rectangle(0.24, 0.11, 0.035, 5), 0.016, 0.003).moved((0.03, 0, -ANKLE + 0.008)))


def arm(robot, side, sign, has_fingers):
    def hinge(joint, parent, child, at, axis, limits, effort, turned=(0, 0, 0)):
        robot.joint(f"{side}_{joint}", "revolute", parent, f"{side}_{child}", at, turned, axis, limits, effort=effort,
                    velocity=8, damping=0.3, friction=0.1)
    outward = (-0.35, 2.6) if sign > 0 else (-2.6, 0.35)
    hinge("shoulder_pitch", "torso", "shoulder_bracket", (0, sign * (SHOULDER[1] - 0.02), SHOULDER[2]), (0, 1, 0),
          (-3.0, 1.5), 50)
    robot.link(f"{side}_shoulder_bracket", 0.8, [Cylinder(0.045, 0.06, turned=Z_TO_Y)],
               [Visual("shoulder_bracket", "graphite")])
    hinge("shoulder_roll", f"{side}_shoulder_bracket", "shoulder", (0, sign * 0.055, 0), (1, 0, 0), outward, 50)
    robot.link(f"{side}_shoulder", 0.8, [Sphere(0.062)], [Visual("shoulder", "teal")])
    hinge("shoulder_yaw", f"{side}_shoulder", "upper_arm", (0, 0, -0.06), (0, 0, 1), (-1.6, 1.6), 35)
    robot.link(f"{side}_upper_arm", 1.5, [Cylinder(0.038, 0.2, (0, 0, -0.09))],
               [Visual("upper_arm", "white"), Visual("elbow", "graphite", (0, 0, 0.06 - UPPER_ARM))])
    hinge("elbow", f"{side}_upper_arm", "forearm", (0, 0, 0.06 - UPPER_ARM), (0, 1, 0), (-2.4, 0), 35)
    robot.link(f"{side}_forearm", 1.1, [Cylinder(0.034, 0.18, (0, 0, -0.1))], [Visual("forearm", "white")])
    if has_fingers:  # its fingers point down and its thumb forward
        hinge("wrist_yaw", f"{side}_forearm", "hand", (0, 0, -FOREARM - 0.02), (0, 0, -1), (-1.6, 1.6), 10,
              (pi, 0, -sign * pi / 2))
        hand.attach(robot, f"{side}_hand", f"{side}_", -sign)
        return
    hinge("wrist_yaw", f"{side}_forearm", "hand", (0, 0, -FOREARM + 0.02), (0, 0, 1), (-1.6, 1.6), 10)
    robot.link(f"{side}_hand", 0.45, [Box(0.088, 0.036, 0.13, (0, 0, -0.085))], [Visual("hand", "graphite")])


def leg(robot, side, sign):
    def hinge(joint, parent, child, at, axis, limits, effort, velocity):
        robot.joint(f"{side}_{joint}", "revolute", parent, f"{side}_{child}", at, axis=axis, limits=limits,
                    effort=effort, velocity=velocity, damping=0.5, friction=0.2)
    inward = (-0.5, 0.8) if sign > 0 else (-0.8, 0.5)
    hinge("hip_yaw", "pelvis", "hip_bracket", (0, sign * HIP[1], HIP[2]), (0, 0, 1), (-0.8, 0.8), 100, 10)
    robot.link(f"{side}_hip_bracket", 1.0, [Cylinder(0.05, 0.06, (0, 0, 0.04))], [Visual("hip_bracket", "graphite")])
    hinge("hip_roll", f"{side}_hip_bracket", "hip", (0, 0, 0), (1, 0, 0), inward, 140, 10)
    robot.link(f"{side}_hip", 1.3, [Cylinder(0.052, 0.13, turned=Z_TO_X)], [Visual("hip", "graphite")])
    hinge("hip_pitch", f"{side}_hip", "thigh", (0, 0, 0), (0, 1, 0), (-2.0, 0.8), 180, 12)
    robot.link(f"{side}_thigh", 4.2, [Box(0.11, 0.10, 0.30, (0.005, 0, -0.16))],
               [Visual("thigh", "white"), Visual("knee", "graphite", (0, 0, -THIGH))])
    hinge("knee", f"{side}_thigh", "shank", (0, 0, -THIGH), (0, 1, 0), (0, 2.4), 200, 14)
    robot.link(f"{side}_shank", 2.6, [Box(0.08, 0.075, 0.28, (-0.005, 0, -0.17))],
               [Visual("shank", "white"), Visual("knee_cap", "teal")])
    hinge("ankle_pitch", f"{side}_shank", "ankle", (0, 0, -SHANK), (0, 1, 0), (-0.9, 0.7), 120, 10)
    robot.link(f"{side}_ankle", 0.4, [Cylinder(0.03, 0.085, turned=Z_TO_Y)], [Visual("ankle", "graphite")])
    hinge("ankle_roll", f"{side}_ankle", "foot", (0, 0, 0), (1, 0, 0), (-0.45, 0.45), 80, 10)
    robot.link(f"{side}_foot", 1.1, [Box(0.24, 0.11, 0.05, (0.03, 0, -ANKLE + 0.025))],
               [Visual("foot", "white"), Visual("sole", "rubber")])


def robot(has_fingers=False):
    colors = {"white": (0.92, 0.93, 0.94), "graphite": (0.20, 0.22, 0.25), "teal": (0.05, 0.55, 0.56),
              "light": (0.55, 0.95, 0.98), "rubber": (0.11, 0.11, 0.12)}
    if has_fingers:
        colors |= {"shell": colors["white"], "blue": colors["teal"], "accent": colors["teal"]}
    man = Robot("humanoid_hands" if has_fingers else "humanoid",
                [f"A humanoid of {'25 hinges and two hands of 15' if has_fingers else '25 hinges'}, 1.6 m tall; x is "
                 "forward, the root is the pelvis.",
                 "Legs: hip yaw, roll and pitch (axes cross), knee, ankle pitch and roll (axes cross).",
                 "At zero it stands straight, its soles 0.885 m below the root."], colors, "package://humanoid/meshes/")
    if has_fingers:
        man.borrow(robot())
        man.borrow(hand.robot())
    else:
        trunk_meshes(man)
        arm_meshes(man)
        leg_meshes(man)
    man.link("pelvis", 6.5, [Box(0.14, 0.22, 0.09, (0, 0, 0.02))], [Visual("pelvis", "white")])
    for side, sign in (("left", 1), ("right", -1)):
        leg(man, side, sign)
        man.overlap(f"{side}_hip_bracket", f"{side}_thigh")
    man.joint("waist_yaw", "revolute", "pelvis", "torso", (0, 0, 0.08), axis=(0, 0, 1), limits=(-1.2, 1.2), effort=120,
              velocity=6, damping=0.5, friction=0.2)
    man.link("torso", 14, [Box(0.18, 0.28, 0.38, (0, 0, 0.22))], [Visual("torso")])
    for side, sign in (("left", 1), ("right", -1)):
        arm(man, side, sign, has_fingers)
        man.overlap(f"{side}_shoulder_bracket", f"{side}_upper_arm")
    man.joint("neck_yaw", "revolute", "torso", "neck", (0, 0, 0.42), axis=(0, 0, 1), limits=(-1.4, 1.4), effort=10,
              velocity=6, damping=0.1, friction=0.05)
    man.link("neck", 0.5, [Cylinder(0.035, 0.09, (0, 0, 0.02))], [Visual("neck", "graphite")])
    man.joint("neck_pitch", "revolute", "neck", "head", (0, 0, 0.06), axis=(0, 1, 0), limits=(-0.6, 0.7), effort=10,
              velocity=6, damping=0.1, friction=0.05)
    man.link("head", 2.4, [Box(0.16, 0.14, 0.19, (0, 0, 0.085))],
             [Visual("head", "white"), Visual("visor", "graphite"), Visual("eyes", "light")])
    man.state("home")
    bends = {"hip_pitch": -0.7, "knee": 1.4, "ankle_pitch": -0.7, "shoulder_pitch": -0.6, "elbow": -0.6}
    man.state("squat", **{f"{side}_{joint}": bend for side in ("left", "right") for joint, bend in bends.items()})
    return man
