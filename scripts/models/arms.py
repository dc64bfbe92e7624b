"""Arms by the tables of Denavit and Hartenberg that their makers publish, drawn as round housings and tubes."""

from math import atan2, cos, hypot, pi, sin

from solid import circle, slab
from urdf import Cylinder, Robot, Visual

# A part is its kind, both ends and its radius, in the frame of its link. Rings only mark where a link turns on another.
SHELL, LID, RING = "shell", "graphite", "accent"


class Arm:
    """Rows as Craig counts them: a joint lies a along the x axis before it and d along its own axis, alpha apart."""

    def __init__(self, name, about, accent, lender=None):
        self.robot = Robot(name, about, {SHELL: (0.93, 0.93, 0.91), LID: (0.21, 0.23, 0.26), RING: accent})
        if lender:
            self.robot.borrow(lender)
        else:
            self.robot.mesh("tube", slab(circle(1, 48), 1, 0.1, 3))
        self.last = ""

    def link(self, name, mass, *parts):
        """A tube of radius and length 1, scaled, for each part."""
        shapes, looks = [], []
        for kind, start, end, radius in parts:
            x, y, z = (b - a for a, b in zip(start, end))
            length, at = hypot(x, y, z), tuple((a + b) / 2 for a, b in zip(start, end))
            turned = (0, atan2(hypot(x, y), z), atan2(y, x))
            looks.append(Visual("tube", kind, at, turned, (radius, radius, length)))
            if kind != RING:
                shapes.append(Cylinder(radius, length, at, turned))
        self.robot.link(name, mass, shapes, looks)
        self.last = name

    def joint(self, name, child, a, alpha, d, limits, effort, velocity, mass, *parts):
        self.robot.joint(name, "revolute", self.last, child, (a, -d * sin(alpha), d * cos(alpha)), (alpha, 0, 0),
                         (0, 0, 1), limits, effort, velocity, damping=0.002 * effort, friction=0.001 * effort)
        self.link(child, mass, *parts)

    def tool(self, d):
        self.robot.joint("tool_mount", "fixed", self.last, "tool", (0, 0, d))
        self.robot.frame("tool")
        return self.robot


def column(kind, low, high, radius, x=0):
    """Along z."""
    return kind, (x, 0, low), (x, 0, high), radius


def across(kind, low, high, radius, x=0):
    """Along y."""
    return kind, (x, low, 0), (x, high, 0), radius


def lids(half, radius):
    """Of a housing along z."""
    return [column(LID, half, half + 0.01, radius), column(LID, -half - 0.01, -half, radius)]


def panda_like():
    arm = Arm("arm7offset", ["An arm with seven hinges, whose elbow and wrist are offset.",
                             "Lengths, limits, speeds and efforts are those that Franka publishes for the Panda."],
              (0.10, 0.62, 0.60))
    arm.link("base", 3.0, column(LID, 0, 0.03, 0.1), column(SHELL, 0.03, 0.19, 0.068))
    arm.joint("joint1", "shoulder_yaw", 0, 0, 0.333, (-2.8973, 2.8973), 87, 2.175, 2.9, column(SHELL, -0.143, 0, 0.062),
              across(SHELL, -0.07, 0.07, 0.062), column(RING, -0.147, -0.139, 0.064))
    arm.joint("joint2", "shoulder", 0, -pi / 2, 0, (-1.7628, 1.7628), 87, 2.175, 2.9, across(SHELL, -0.19, 0, 0.058),
              *lids(0.07, 0.052))
    arm.joint("joint3", "upper_arm", 0, pi / 2, 0.316, (-2.8973, 2.8973), 87, 2.175, 2.6,
              column(SHELL, -0.126, 0.02, 0.056), across(SHELL, -0.055, 0.055, 0.055, 0.0825),
              column(RING, -0.13, -0.122, 0.059))
    arm.joint("joint4", "elbow", 0.0825, pi / 2, 0, (-3.0718, -0.0698), 87, 2.175, 2.6,
              (SHELL, (0, 0, 0), (-0.0825, 0.09, 0), 0.046), across(SHELL, 0.05, 0.2, 0.052, -0.0825),
              *lids(0.055, 0.046))
    arm.joint("joint5", "forearm", -0.0825, -pi / 2, 0.384, (-2.8973, 2.8973), 12, 2.61, 2.2,
              column(SHELL, -0.184, 0, 0.044), across(SHELL, -0.05, 0.05, 0.045), column(RING, -0.188, -0.18, 0.053))
    arm.joint("joint6", "wrist", 0, pi / 2, 0, (-0.0175, 3.7525), 12, 2.61, 1.3, (SHELL, (0, 0, 0), (0.088, 0, 0), 0.04),
              across(SHELL, -0.045, 0.045, 0.042, 0.088), *lids(0.05, 0.038))
    arm.joint("joint7", "flange", 0.088, pi / 2, 0, (-2.8973, 2.8973), 12, 2.61, 0.5, column(LID, 0.047, 0.107, 0.038),
              column(RING, 0.043, 0.051, 0.041))
    robot = arm.tool(0.107)
    robot.state("home", joint2=-pi / 4, joint4=-3 * pi / 4, joint6=pi / 2, joint7=pi / 4)
    robot.state("reach", joint1=1.2, joint2=0.4, joint3=0.3, joint4=-1.4, joint5=0.2, joint6=1.9, joint7=0.2)
    return robot


def ur_like(lender):
    arm = Arm("arm6dof", ["An arm with six hinges, three of which are parallel.",
                          "Lengths, limits, speeds, efforts and masses are those that Universal Robots publishes for the "
                          "UR5, and angles are counted as there."], (0.95, 0.49, 0.10), lender)
    turn, elbow = (-2 * pi, 2 * pi), (-pi, pi)
    arm.link("base", 4.0, column(LID, 0, 0.034, 0.064))
    arm.joint("base_yaw", "shoulder", 0, 0, 0.089159, turn, 150, pi, 3.7, column(SHELL, -0.055, 0.062, 0.06),
              across(SHELL, -0.075, 0, 0.058), column(RING, -0.053, -0.045, 0.0615))
    arm.joint("shoulder_lift", "upper_arm", 0, pi / 2, 0, turn, 150, pi, 8.393, column(SHELL, 0.076, 0.196, 0.058),
              column(LID, 0.196, 0.206, 0.05), (SHELL, (0, 0, 0.136), (-0.425, 0, 0.136), 0.045),
              column(SHELL, 0.082, 0.19, 0.05, -0.425), column(LID, 0.19, 0.2, 0.043, -0.425),
              column(RING, 0.074, 0.08, 0.0595))
    arm.joint("elbow", "forearm", -0.425, 0, 0, elbow, 150, pi, 2.33, column(SHELL, -0.035, 0.08, 0.048),
              column(LID, -0.045, -0.035, 0.041), (SHELL, (0, 0, 0.016), (-0.39225, 0, 0.016), 0.037),
              column(SHELL, -0.03, 0.057, 0.04, -0.39225), column(LID, -0.038, -0.03, 0.034, -0.39225),
              column(RING, 0.078, 0.084, 0.0495))
    arm.joint("wrist_bend", "wrist", -0.39225, 0, 0.10915, turn, 28, pi, 1.219, column(SHELL, -0.05, 0.04, 0.04),
              column(LID, 0.04, 0.048, 0.034), across(SHELL, -0.05, 0, 0.038), column(RING, -0.054, -0.048, 0.0415))
    arm.joint("wrist_yaw", "wrist_end", 0, pi / 2, 0.09465, turn, 28, pi, 1.219, column(SHELL, -0.043, 0.04, 0.04),
              column(LID, 0.04, 0.048, 0.034), across(SHELL, 0, 0.046, 0.037), column(RING, -0.047, -0.041, 0.0415))
    arm.joint("flange_roll", "flange", 0, -pi / 2, 0.0823, turn, 28, pi, 0.1879, column(LID, -0.034, 0, 0.037),
              column(RING, -0.038, -0.032, 0.0385))
    robot = arm.tool(0)
    robot.state("home", shoulder_lift=-pi / 2, wrist_bend=-pi / 2)
    robot.state("reach", base_yaw=0.6, shoulder_lift=-1.9, elbow=-1.7, wrist_bend=-1.1, wrist_yaw=pi / 2)
    return robot


def robots():
    panda = panda_like()
    return panda, ur_like(panda)
