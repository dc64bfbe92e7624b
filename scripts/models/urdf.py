"""A robot as a URDF file with its meshes. Metres, radians, kilograms."""

from dataclasses import dataclass
from math import pi

import mesh_file
from solid import rotation

ORIGIN = (0, 0, 0)


def text(*numbers, digits=6):
    """Numbers for the file; adding zero keeps -0 away."""
    return " ".join(f"{round(x, 12) + 0.0:.{digits}g}" for x in numbers)


@dataclass
class Box:
    x: float
    y: float
    z: float
    at: tuple = ORIGIN
    turned: tuple = ORIGIN

    def volume(self):
        return self.x * self.y * self.z

    def moments(self):
        """Per kilogram, about the middle."""
        return [(self.y ** 2 + self.z ** 2) / 12, (self.x ** 2 + self.z ** 2) / 12, (self.x ** 2 + self.y ** 2) / 12]

    def xml(self):
        return f'<box size="{text(self.x, self.y, self.z)}"/>'


@dataclass
class Cylinder:
    radius: float
    length: float
    at: tuple = ORIGIN
    turned: tuple = ORIGIN

    def volume(self):
        return pi * self.radius ** 2 * self.length

    def moments(self):
        across = self.radius ** 2 / 4 + self.length ** 2 / 12
        return [across, across, self.radius ** 2 / 2]

    def xml(self):
        return f'<cylinder radius="{text(self.radius)}" length="{text(self.length)}"/>'


@dataclass
class Sphere:
    radius: float
    at: tuple = ORIGIN
    turned: tuple = ORIGIN

    def volume(self):
        return 4 / 3 * pi * self.radius ** 3

    def moments(self):
        return [0.4 * self.radius ** 2] * 3

    def xml(self):
        return f'<sphere radius="{text(self.radius)}"/>'


@dataclass
class Visual:
    mesh: str
    material: str = ""
    at: tuple = ORIGIN
    turned: tuple = ORIGIN
    scale: float | tuple = 1  # of all three axes, or of each


def mass_properties(mass, shapes):
    """Centre of mass, and inertia about it, of shapes that share the mass by their volumes."""
    total = sum(shape.volume() for shape in shapes)
    shares = [mass * shape.volume() / total for shape in shapes]
    com = [sum(m * shape.at[i] for m, shape in zip(shares, shapes)) / mass for i in range(3)]
    inertia = [[0.0] * 3 for _ in range(3)]
    for m, shape in zip(shares, shapes):
        R, moments = rotation(*shape.turned), shape.moments()
        r = [a - b for a, b in zip(shape.at, com)]
        for i in range(3):
            for k in range(3):
                inertia[i][k] += m * (sum(R[i][n] * moments[n] * R[k][n] for n in range(3)) - r[i] * r[k])
            inertia[i][i] += m * sum(x * x for x in r)
    return com, inertia


def origin(at, turned):
    if at == ORIGIN and turned == ORIGIN:
        return []
    turn = f' rpy="{text(*turned, digits=10)}"' if turned != ORIGIN else ""
    return [f'<origin xyz="{text(*at)}"{turn}/>']


class Robot:
    """Collects links, joints and meshes. `folder` is how the file names the folder of the meshes."""

    def __init__(self, name, about, colors, folder="meshes/"):
        self.name, self.about, self.colors, self.folder = name, about, colors, folder
        self.meshes, self.borrowed, self.lines = {}, {}, []
        self.overlaps, self.moving, self.states = [], {}, {}

    def borrow(self, other):
        """Uses the meshes of another robot."""
        self.borrowed.update({path: f"package://{other.name}/meshes/" for path in other.meshes})

    def mesh(self, name, *solids):
        self.meshes[f"meshes/{name}.stl"] = mesh_file.stl(solids)

    def painted_mesh(self, name, parts):
        """Parts are pairs (colour, solids)."""
        self.meshes[f"meshes/{name}.obj"] = mesh_file.obj(parts, f"{name}.mtl")
        self.meshes[f"meshes/{name}.mtl"] = mesh_file.mtl({color: self.colors[color] for color, _ in parts})

    def part(self, head, content):
        """An element whose content stands on lines of its own."""
        self.lines += ["", f"  <{head}>"] + ["    " + line for line in content] + [f"  </{head.split()[0]}>"]

    def frame(self, name):
        """A link without mass or shape."""
        self.lines += ["", f'  <link name="{name}"/>']

    def link(self, name, mass, shapes, visuals):
        """Shapes are what collides; the mass is spread over them."""
        com, inertia = mass_properties(mass, shapes)
        (xx, xy, xz), (_, yy, yz), (_, _, zz) = inertia
        entries = zip(("ixx", "ixy", "ixz", "iyy", "iyz", "izz"), (xx, xy, xz, yy, yz, zz))
        content = ["<inertial>", f'  <origin xyz="{text(*com)}"/>', f'  <mass value="{text(mass)}"/>',
                   "  <inertia " + " ".join(f'{key}="{text(value)}"' for key, value in entries) + "/>", "</inertial>"]
        for visual in visuals:
            content += ["<visual>"] + ["  " + line for line in origin(visual.at, visual.turned) + self.look(visual)] + \
                       ["</visual>"]
        for shape in shapes:
            content += ["<collision>"] + ["  " + line for line in origin(shape.at, shape.turned)] + \
                       [f"  <geometry>{shape.xml()}</geometry>", "</collision>"]
        self.part(f'link name="{name}"', content)

    def look(self, visual):
        file = visual.mesh + (".stl" if visual.material else ".obj")
        assert f"meshes/{file}" in self.meshes | self.borrowed, file
        factors = visual.scale if isinstance(visual.scale, tuple) else (visual.scale,) * 3
        scale = f' scale="{text(*factors)}"' if factors != (1, 1, 1) else ""
        lines = [f'<geometry><mesh filename="{self.borrowed.get(f"meshes/{file}", self.folder)}{file}"{scale}/></geometry>']
        return lines + ([f'<material name="{visual.material}"/>'] if visual.material else [])

    def joint(self, name, kind, parent, child, at=ORIGIN, turned=ORIGIN, axis=None, limits=None, effort=0, velocity=0,
              damping=0, friction=0, mimic=None):
        """`limits` is a pair; `mimic` is (joint, multiplier, offset)."""
        content = [f'<parent link="{parent}"/>', f'<child link="{child}"/>'] + origin(at, turned)
        if axis and not mimic:
            self.moving[name] = limits or (0, 0)
        if axis:
            content.append(f'<axis xyz="{text(*axis)}"/>')
        if effort:
            bounds = f'lower="{text(limits[0])}" upper="{text(limits[1])}" ' if limits else ""
            content.append(f'<limit {bounds}effort="{text(effort)}" velocity="{text(velocity)}"/>')
        if damping or friction:
            content.append(f'<dynamics damping="{text(damping)}" friction="{text(friction)}"/>')
        if mimic:
            content.append(f'<mimic joint="{mimic[0]}" multiplier="{text(mimic[1])}" offset="{text(mimic[2])}"/>')
        self.part(f'joint name="{name}" type="{kind}"', content)

    def overlap(self, link, other):
        """Links around one joint of several axes, whose colliding shapes overlap where the links do not, or that are
        made to touch."""
        self.overlaps.append((link, other))

    def state(self, name, **joints):
        """A posture; joints that it does not name are at 0, or at the limit next to it."""
        assert not joints.keys() - self.moving.keys(), joints
        self.states[name] = {joint: joints.get(joint, min(max(0, low), high)) for joint, (low, high) in self.moving.items()}

    def srdf(self):
        def element(head, children):
            return [f"  <{head}>"] + [f"    <joint {child}/>" for child in children] + [f"  </{head.split()[0]}>"]
        lines = element('group name="all"', [f'name="{joint}"' for joint in self.moving])
        for name, values in self.states.items():
            lines += element(f'group_state name="{name}" group="all"',
                             [f'name="{joint}" value="{text(value)}"' for joint, value in values.items()])
        lines += [f'  <disable_collisions link1="{a}" link2="{b}" reason="User"/>' for a, b in self.overlaps]
        return "\n".join(['<?xml version="1.0"?>', "<!-- scripts/make-meshes writes this file. -->",
                          f'<robot name="{self.name}">', *lines, "</robot>", ""])

    def files(self):
        """What belongs into the folder of the robot: path to bytes."""
        head = ['<?xml version="1.0"?>'] + [f"<!-- {line} -->" for line in self.about]
        head += ["<!-- scripts/make-meshes writes this file and its meshes. -->", f'<robot name="{self.name}">']
        for name, (red, green, blue) in self.colors.items():
            head.append(f'  <material name="{name}"><color rgba="{text(red, green, blue, 1)}"/></material>')
        urdf = "\n".join(head + self.lines + ["</robot>", ""])
        choices = {f"{self.name}.srdf": self.srdf().encode()} if self.states else {}
        return {f"{self.name}.urdf": urdf.encode(), **choices, **self.meshes}
