"""A gripper with two parallel fingers, the second of which follows the first."""

from math import pi

from solid import Z_TO_Y, box, cylinder
from urdf import Box, Cylinder, Robot, Visual

STROKE, GRASP = 0.04, 0.105  # of each finger; from the flange to the middle of the pads


def robot():
    gripper = Robot("gripper", ["A gripper: its fingers point along z and close along y, the frame grasp between them.",
                                "Opening, speed and force are those that Franka publishes for the hand of the Panda."],
                    {"shell": (0.93, 0.93, 0.91), "graphite": (0.21, 0.23, 0.26), "accent": (0.10, 0.62, 0.60)})
    gripper.mesh("body", box(0.062, 0.19, 0.045, 0.028, 0.008).moved((0, 0, 0.036)),
                 box(0.05, 0.1, 0.03, 0.022, 0.008).moved((0, 0, 0.052)))
    gripper.mesh("body_trim", cylinder(0.04, 0.016, 0.002).moved((0, 0, 0.008)),
                 *(cylinder(0.005, 0.172, 0.001, 20).moved((x, 0, 0.064), Z_TO_Y) for x in (-0.017, 0.017)))
    gripper.mesh("finger", box(0.05, 0.022, 0.018, 0.006, 0.003).moved((0, 0.016, 0.007)),
                 box(0.022, 0.016, 0.048, 0.005, 0.003).moved((0, 0.013, 0.03)))
    gripper.mesh("pad", box(0.02, 0.006, 0.02, 0.002, 0.001).moved((0, 0.003, 0.044)))
    gripper.link("body", 0.67, [Box(0.062, 0.19, 0.045, (0, 0, 0.036)), Box(0.05, 0.172, 0.02, (0, 0, 0.059)),
                                 Cylinder(0.04, 0.016, (0, 0, 0.008))], [Visual("body", "shell"), Visual("body_trim", "graphite")])
    for name, turned, mimic in (("left", 0, None), ("right", pi, ("left_slide", 1, 0))):
        gripper.joint(f"{name}_slide", "prismatic", "body", f"{name}_finger", (0, 0, GRASP - 0.044), (0, 0, turned),
                      (0, 1, 0), (0, STROKE), 70, 0.05, mimic=mimic)
        gripper.link(f"{name}_finger", 0.03, [Box(0.05, 0.022, 0.018, (0, 0.016, 0.007)), Box(0.022, 0.021, 0.054, (0, 0.0105, 0.027))],
                     [Visual("finger", "graphite"), Visual("pad", "accent")])
    gripper.joint("grasp_mount", "fixed", "body", "grasp", (0, 0, GRASP))
    gripper.frame("grasp")
    gripper.overlap("left_finger", "right_finger")
    gripper.state("home", left_slide=STROKE)
    gripper.state("closed")
    return gripper
