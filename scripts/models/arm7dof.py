"""An arm with seven hinges: forks and necks of three sizes, one turned into the next."""

from math import pi

from solid import Z_TO_Y, around, bar, box, circle, cylinder, lathe, limb, slab
from urdf import Box, Cylinder, Robot, Visual

FORK, NECK = 0.18, 0.20  # lengths at scale 1: from a roll axis up to a bend axis, and on to the next roll axis
SIZES = (1, 0.88, 0.74)  # of shoulder, elbow and wrist
FLANGE = 0.06


def meshes(robot):
    bolts = around(cylinder(0.009, 0.014, 0.002, 10).moved((0.098, 0, 0.023)), 6, pi / 6)
    robot.mesh("base", cylinder(0.12, 0.035, 0.006, 40).moved((0, 0, 0.0175)),
               lathe([(0.086, 0.03), (0.084, 0.06), (0.076, 0.10), (0.074, 0.148), (0.072, 0.15)]))
    robot.mesh("base_trim", *bolts, box(0.05, 0.06, 0.05, 0.006, 0.004).moved((-0.085, 0, 0.062)),
               cylinder(0.068, 0.02, 0.002).moved((0, 0, 0.15)))
    plate = bar(0.056, 0.052, 0.09, 0.034, 0.008).moved((0, 0, FORK), (pi, 0, 0))
    robot.mesh("fork", limb([(0.004, 0.14, 0.14, 0.0699, 0), (0.04, 0.14, 0.14, 0.0699, 0),
                             (0.075, 0.125, 0.148, 0.06, 0), (0.105, 0.10, 0.154, 0.04, 0)], 0.006, 6),
               plate.moved((0, 0.06, 0)), plate.moved((0, -0.06, 0)))
    cap = slab(circle(0.04, 28), 0.018, 0.005)
    face = cylinder(0.026, 0.006, 0.002, 28).moved((0, 0, 0.009))
    caps = [part.moved((0, side * 0.08, FORK), (-side * pi / 2, 0, 0)) for side in (1, -1) for part in (cap, face)]
    robot.mesh("fork_caps", *caps)
    robot.mesh("neck", bar(0.055, 0.05, 0.09, 0.078, 0.008),
               limb([(0.07, 0.09, 0.076, 0.03, 0), (0.105, 0.105, 0.1, 0.045, 0), (0.13, 0.124, 0.124, 0.0619, 0),
                     (0.172, 0.128, 0.128, 0.0639, 0)], 0.008, 5))
    robot.mesh("ring", lathe([(0.058, 0.165), (0.0665, 0.168), (0.0665, 0.180), (0.06, 0.184), (0.06, 0.196)]))
    robot.mesh("flange", cylinder(0.034, 0.03, 0.004).moved((0, 0, 0.013)),
               cylinder(0.0315, 0.014, 0.002).moved((0, 0, 0.045)))
    pins = around(cylinder(0.003, 0.01, 0.001, 8).moved((0.024, 0, 0.05)), 6)
    robot.mesh("flange_trim", cylinder(0.027, 0.03, 0.002).moved((0, 0, 0.03)), cylinder(0.012, 0.016, 0.002, 20)
               .moved((0, 0, 0.05)), *pins)


def robot():
    arm = Robot("arm7dof", ["An arm with seven hinges and a flange: it rolls and bends by turns.",
                            "At zero it stands upright; a link turns about z, the next about y."],
                {"shell": (0.93, 0.93, 0.91), "graphite": (0.21, 0.23, 0.26), "accent": (0.95, 0.49, 0.10)})
    meshes(arm)
    arm.link("base", 4.5, [Cylinder(0.12, 0.035, (0, 0, 0.0175)), Cylinder(0.08, 0.12, (0, 0, 0.095))],
             [Visual("base", "graphite"), Visual("base_trim", "accent")])
    masses, efforts, speeds = ((3.6, 3.1), (2.7, 2.2), (1.6, 1.1)), (180, 180, 110, 110, 60, 40, 40), \
        (1.7, 1.7, 1.75, 2.3, 2.4, 3.1, 3.1)
    bodies = (("turret", "shoulder"), ("upper_arm", "elbow"), ("forearm", "wrist"))
    joints = (("shoulder_yaw", "shoulder_pitch"), ("upper_arm_roll", "elbow_pitch"), ("forearm_roll", "wrist_pitch"))
    bends = (2.1, 2.3, 2.1)
    parent, up, drive = "base", 0.16, 0
    for size, mass, names, moves, bend in zip(SIZES, masses, bodies, joints, bends):
        for i, (name, move) in enumerate(zip(names, moves)):
            limits = (-bend, bend) if i else (-2.9, 2.9)
            arm.joint(move, "revolute", parent, name, (0, 0, up), axis=(0, i, 1 - i), limits=limits,
                      effort=efforts[drive], velocity=speeds[drive], damping=0.5 * size, friction=0.2 * size)
            if i == 0:
                shapes = [Cylinder(0.07 * size, 0.1 * size, (0, 0, 0.055 * size)),
                          Cylinder(0.056 * size, 0.17 * size, (0, 0, FORK * size), Z_TO_Y)]
                looks = [Visual("fork", "shell", scale=size), Visual("fork_caps", "graphite", scale=size)]
            else:
                shapes = [Box(0.1 * size, 0.078 * size, 0.11 * size, (0, 0, 0.05 * size)),
                          Cylinder(0.064 * size, 0.085 * size, (0, 0, 0.14 * size))]
                looks = [Visual("neck", "shell", scale=size), Visual("ring", "accent", scale=size)]
            arm.link(name, mass[i], shapes, looks)
            parent, up, drive = name, (NECK if i else FORK) * size, drive + 1
    arm.joint("flange_roll", "revolute", parent, "flange", (0, 0, up), axis=(0, 0, 1), limits=(-3.05, 3.05),
              effort=efforts[6], velocity=speeds[6], damping=0.3, friction=0.1)
    arm.link("flange", 0.4, [Cylinder(0.034, 0.055, (0, 0, 0.0275))],
             [Visual("flange", "shell"), Visual("flange_trim", "graphite")])
    arm.joint("tool_mount", "fixed", "flange", "tool", (0, 0, FLANGE))
    arm.frame("tool")
    arm.state("home", shoulder_pitch=0.5, elbow_pitch=1.2, wrist_pitch=0.9)
    arm.state("up")
    return arm
