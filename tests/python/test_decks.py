"""Decks with every kind of card that takes a set or a surface of an included mesh, run by CalculiX: what arrives is what was asked for."""

import math
import re
import subprocess
import unittest

import numpy as np
from support import VECTOR, FolderTest, Part, box, ccx, needs_calculix

import _polycube

STEEL, CONDUCTIVITY = 210000.0, 50.0
ORDERS = ("C3D8I", "C3D8", "C3D20", "C3D20R")


def half_tube(inner, outer, height):
    """Cut at y = 0."""
    tube = Part.makeCylinder(outer, height).cut(Part.makeCylinder(inner, height))
    return tube.common(Part.makeBox(4 * outer, 2 * outer, height, VECTOR(-2 * outer, 0, 0)))


def face(shape, test):
    """"Face3", the one face for which the test holds."""
    found = [number for number, one in enumerate(shape.Faces, 1) if test(one)]
    assert len(found) == 1, found
    return "Face{}".format(found[0])


def plane(axis, value):
    return lambda one: one.Surface.TypeId == "Part::GeomPlane" and abs(one.Surface.Axis[axis]) > 0.99 and abs(one.CenterOfMass[axis] - value) < 1e-6


def round_side(radius):
    return lambda one: one.Surface.TypeId == "Part::GeomCylinder" and abs(one.Surface.Radius - radius) < 1e-6


def renumbered(text, first, suffix):
    """A mesh file for a deck with two of them: nodes and elements numbered from `first` on, a suffix to every name."""
    lines = []
    for line in text.splitlines():
        if line.startswith("**"):
            continue
        if line.startswith("*"):
            surface = line.startswith("*SURFACE")
            node = line.startswith("*NODE,")
            lines.append(re.sub(r"((?:NSET|ELSET|NAME)=\w+)", r"\1" + suffix, line))
            continue
        fields = [field.strip() for field in line.rstrip(",").split(",")]
        count = 1 if node or surface else len(fields)
        fields[:count] = [str(int(field) + first) for field in fields[:count]]
        lines.append(", ".join(fields) + ("," if line.endswith(",") else ""))
    return "\n".join(lines) + "\n"


class DeckTest(FolderTest):
    """A test that runs decks of one solid of STEEL."""

    def mesh(self, shape, element_type, size, name="mesh.inp"):
        mesh = _polycube.mesh(brep=shape.exportBrepToString(), size=size, element_type=element_type)
        mesh.write(self.path(name))
        return mesh

    def run_deck(self, text):
        """Runs the deck; returns what CalculiX printed into the .dat file."""
        with open(self.path("job.inp"), "w") as file:
            file.write(text)
        run = subprocess.run([ccx.find(), "job"], cwd=self.folder, capture_output=True, text=True, timeout=300)
        self.assertNotIn("*ERROR", run.stdout)
        self.assertIn("Job finished", run.stdout)
        with open(self.path("job.dat")) as file:
            return file.read()

    @staticmethod
    def last(text, heading):
        """Numbers of the first line that has some below the last line with this heading."""
        below = text[text.rindex(heading) :].splitlines()[1:]
        return next([float(number) for number in line.split()] for line in below if re.fullmatch(r"[\s\d.E+-]*\d[\s\d.E+-]*", line))

    @staticmethod
    def moved(text):
        """Mean displacement of the nodes that it is printed for."""
        rows = [line.split() for line in text[text.index("displacements") :].splitlines() if re.match(r"\s+\d+\s+\S+\s+\S+\s+\S+$", line)]
        return np.array([[float(x) for x in row[1:]] for row in rows]).mean(axis=0)

    STATIC = """*INCLUDE, INPUT=mesh.inp
*MATERIAL, NAME=STEEL
*ELASTIC
{e}, 0.0
*SOLID SECTION, ELSET=Solid1, MATERIAL=STEEL
*BOUNDARY
{fixed}, 1, 3
*STEP
*STATIC
{load}
*NODE PRINT, NSET={fixed}, TOTALS=ONLY
RF
{more}
*END STEP
"""


@needs_calculix
class Decks(DeckTest):
    def reaction(self, fixed, load, more=""):
        text = self.run_deck(self.STATIC.format(e=STEEL, fixed=fixed, load=load, more=more))
        return np.array(self.last(text, "total force")), text

    def test_tension_is_exact(self):
        shape = box()
        fixed, end = face(shape, plane(0, 0)), face(shape, plane(0, 8))
        for element_type in (*ORDERS, "C3D8R"):
            with self.subTest(element_type):
                self.mesh(shape, element_type, 0.5)
                # A pressure of -100 pulls with 400 N.
                force, text = self.reaction(fixed, "*DLOAD\n" + self.by_side(end, "{0}_S{1}, P{1}, -100."), "*NODE PRINT, NSET={}\nU".format(end))
                self.assertAlmostEqual(self.moved(text)[0], 100 / STEEL * 8, delta=1e-7)
                self.assertAlmostEqual(force[0], -400, delta=0.1)

    def test_bending_needs_the_right_element(self):
        shape = box()
        fixed, end = face(shape, plane(0, 0)), face(shape, plane(0, 8))
        beam = 100 * 8**3 / (3 * STEEL * 2**4 / 12)  # 100 N at the tip, without shear
        for element_type in ("C3D20", "C3D20R", "C3D8I"):
            with self.subTest(element_type):
                nodes = self.mesh(shape, element_type, 0.5).groups[end]["nodes"]
                force, text = self.reaction(fixed, "*CLOAD\n{}, 3, {}".format(end, -100 / len(nodes)), "*NODE PRINT, NSET={}\nU".format(end))
                self.assertAlmostEqual(force[2], 100, delta=0.1)
                self.assertGreater(-self.moved(text)[2], beam)
                self.assertLess(-self.moved(text)[2], 1.2 * beam)

    def test_pressure_on_a_plane_face(self):
        shape = box()
        fixed, end = face(shape, plane(0, 0)), face(shape, plane(0, 8))
        for element_type in ORDERS:
            with self.subTest(element_type):
                self.mesh(shape, element_type, 1)
                force, _ = self.reaction(fixed, "*DSLOAD\n{}_Surface, P, 100.".format(end))
                np.testing.assert_allclose(force, [400, 0, 0], atol=0.01)

    def test_pressure_on_a_round_face(self):
        """Its resultant is that on the plane between its straight edges, whatever the elements make of the circle. By surface and by element sets."""
        shape = half_tube(5, 8, 6)
        fixed, inside = face(shape, round_side(8)), face(shape, round_side(5))
        for element_type in ORDERS:
            with self.subTest(element_type):
                self.mesh(shape, element_type, 1.5)
                force, _ = self.reaction(fixed, "*DSLOAD\n{}_Surface, P, 2.".format(inside))
                np.testing.assert_allclose(force, [0, -2 * 10 * 6, 0], atol=0.01)
                force, _ = self.reaction(fixed, "*DLOAD\n" + self.by_side(inside, "{0}_S{1}, P{1}, 2."))
                np.testing.assert_allclose(force, [0, -2 * 10 * 6, 0], atol=0.01)

    def by_side(self, face_name, row):
        """A row for each of the face's element sets."""
        with open(self.path("mesh.inp")) as file:
            sides = sorted(set(re.findall(r"ELSET={}_S(\d)\n".format(face_name), file.read())))
        return "\n".join(row.format(face_name, side) for side in sides)

    def test_forces_on_nodes(self):
        shape = half_tube(5, 8, 6)
        fixed, inside = face(shape, round_side(8)), face(shape, round_side(5))
        for element_type in ("C3D8", "C3D20"):
            with self.subTest(element_type):
                mesh = self.mesh(shape, element_type, 1.5)
                force, _ = self.reaction(fixed, "*CLOAD\n{}, 3, -2.5".format(inside))
                np.testing.assert_allclose(force, [0, 0, 2.5 * len(mesh.groups[inside]["nodes"])], atol=0.01)

    def test_section_print(self):
        """The force through the clamped face and its area, plane and round."""
        for shape, clamped, loaded, area, pressed in (
            (box(), plane(0, 0), plane(0, 8), 4.0, 4.0),
            (half_tube(5, 8, 6), round_side(8), round_side(5), 8 * math.pi * 6, 10.0 * 6),
        ):
            clamped, loaded = face(shape, clamped), face(shape, loaded)
            for element_type in ("C3D8", "C3D20"):
                with self.subTest(element_type, area=area):
                    self.mesh(shape, element_type, 1)
                    printed = "*SECTION PRINT, SURFACE={}_Surface, NAME=SP\nSOF, SOM, SOAREA".format(clamped)
                    force, text = self.reaction(clamped, "*DSLOAD\n{}_Surface, P, 10.".format(loaded), printed)
                    np.testing.assert_allclose(np.linalg.norm(force), 10 * pressed, rtol=1e-5)
                    section = text[text.index("statistics for surface set") :]
                    numbers = [float(word) for word in re.findall(r"-?\d\.\d+E[+-]\d+", section[section.index("\n") :])]
                    # numbers: force, moment about the origin, centre, normal, moment about the centre, area, normal force, shear force
                    self.assertAlmostEqual(numbers[15] / area, 1, delta=2e-3 if element_type == "C3D20" else 1e-2)
                    np.testing.assert_allclose(np.linalg.norm(numbers[:3]), 10 * pressed, rtol=0.02 if element_type == "C3D20" else 0.1)

    HEAT = """*INCLUDE, INPUT=mesh.inp
*MATERIAL, NAME=STEEL
*CONDUCTIVITY
{k}
*SOLID SECTION, ELSET=Solid1, MATERIAL=STEEL
*INITIAL CONDITIONS, TYPE=TEMPERATURE
Solid1_Nodes, 300.
*STEP
*HEAT TRANSFER, STEADY STATE
*BOUNDARY
{held}, 11, 11, 300.
{load}
*NODE PRINT, NSET={held}, TOTALS=ONLY
RFL
*NODE PRINT, NSET={hot}
NT
*END STEP
"""

    def heat(self, held, hot, load):
        """(heat that leaves through the face that is held at 300 K, mean temperature of the nodes of the hot face)"""
        text = self.run_deck(self.HEAT.format(k=CONDUCTIVITY, held=held, hot=hot, load=load))
        rows = re.findall(r"^\s+\d+\s+(\S+)\s*$", text[text.index("temperatures") :], re.M)
        return -self.last(text, "total heat generation")[0], np.mean([float(row) for row in rows])

    def films(self, face_name, sink, coefficient):
        return "*FILM\n" + self.by_side(face_name, "{{0}}_S{{1}}, F{{1}}, {}, {}".format(sink, coefficient))

    def test_heat_through_a_bar(self):
        shape = box()
        held, hot = face(shape, plane(0, 0)), face(shape, plane(0, 8))
        for element_type in ("C3D8", "C3D20"):
            with self.subTest(element_type):
                self.mesh(shape, element_type, 1)
                heat, temperature = self.heat(held, hot, "*DFLUX\n{}_Surface, S, 25.".format(hot))
                self.assertAlmostEqual(heat, 25 * 4, delta=0.01)
                self.assertAlmostEqual(temperature, 300 + 25 * 8 / CONDUCTIVITY, delta=1e-3)
                heat, temperature = self.heat(held, hot, self.films(hot, 400.0, 5.0))
                flux = 100 / (1 / 5 + 8 / CONDUCTIVITY)
                self.assertAlmostEqual(heat, 4 * flux, delta=0.01)
                self.assertAlmostEqual(temperature, 400 - flux / 5, delta=1e-3)

    def test_heat_through_a_wall_of_a_tube(self):
        shape = half_tube(5, 8, 6)
        held, hot = face(shape, round_side(8)), face(shape, round_side(5))
        for element_type, tolerance in (("C3D8", 0.02), ("C3D20", 1e-3)):
            with self.subTest(element_type):
                self.mesh(shape, element_type, 1.5)
                heat, temperature = self.heat(held, hot, "*DFLUX\n{}_Surface, S, 25.".format(hot))
                self.assertAlmostEqual(heat / (25 * 5 * math.pi * 6), 1, delta=tolerance)
                self.assertAlmostEqual((temperature - 300) / (25 * 5 * math.log(8 / 5) / CONDUCTIVITY), 1, delta=tolerance)
                heat, temperature = self.heat(held, hot, self.films(hot, 400.0, 5.0))
                total = 100 * math.pi * 6 / (1 / (5.0 * 5) + math.log(8 / 5) / CONDUCTIVITY)
                self.assertAlmostEqual(heat / total, 1, delta=tolerance)
                self.assertAlmostEqual((temperature - 300) / (100 - total / (5.0 * 5 * math.pi * 6)), 1, delta=tolerance)

    PAIR = """*INCLUDE, INPUT=lower.inp
*INCLUDE, INPUT=upper.inp
*MATERIAL, NAME=STEEL
*ELASTIC
{e}, 0.0
*SOLID SECTION, ELSET=Solid1, MATERIAL=STEEL
*SOLID SECTION, ELSET=Solid1b, MATERIAL=STEEL
*BOUNDARY
{fixed}, 1, 3
{joint}
*STEP
*STATIC
*DSLOAD
{pressed}_Surfaceb, P, 20.
*NODE PRINT, NSET={fixed}, TOTALS=ONLY
RF
*NODE PRINT, NSET={pressed}b
U
*END STEP
"""

    def mesh_pair(self, lower, upper, sizes, element_type):
        self.mesh(lower, element_type, sizes[0], "lower.inp")
        self.mesh(upper, element_type, sizes[1], "upper.inp")
        with open(self.path("upper.inp")) as file:
            text = renumbered(file.read(), 100000, "b")
        with open(self.path("upper.inp"), "w") as file:
            file.write(text)

    def press_pair(self, joint, names):
        """(reaction, mean displacement of the pressed face)"""
        text = self.run_deck(self.PAIR.format(e=STEEL, joint=joint.format(**names), **names))
        return np.array(self.last(text, "total force")), self.moved(text)

    TIE = "*TIE, NAME=GLUE, POSITION TOLERANCE=0.5\n{slave}_Surfaceb, {master}_Surface"
    # Nothing but friction holds the upper part sideways.
    CONTACT = (
        "*SURFACE INTERACTION, NAME=TOUCH\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n1e8, 1.\n*FRICTION\n0.5, 1e6\n"
        "*CONTACT PAIR, INTERACTION=TOUCH, TYPE=SURFACE TO SURFACE\n{slave}_Surfaceb, {master}_Surface"
    )

    def test_two_blocks_pressed_together(self):
        """Meshes that do not fit each other: the whole force goes through a tie and through contact."""
        lower, upper = Part.makeBox(4, 4, 3), Part.makeBox(4, 4, 3, VECTOR(0, 0, 3))
        bottom, top = face(lower, plane(2, 0)), face(lower, plane(2, 3))
        names = {"fixed": bottom, "pressed": face(upper, plane(2, 6)), "slave": face(upper, plane(2, 3)), "master": top}
        for element_type in ("C3D8", "C3D20"):
            self.mesh_pair(lower, upper, (2, 1.4), element_type)
            for joint in (self.TIE, self.CONTACT):
                with self.subTest(joint[:12], element_type=element_type):
                    force, moved = self.press_pair(joint, names)
                    np.testing.assert_allclose(force, [0, 0, 20 * 16], atol=0.5)
                    self.assertAlmostEqual(moved[2] / (-20 * 6 / STEEL), 1, delta=0.02)

    def test_a_half_tube_round_another(self):
        """Tie and contact on round faces."""
        inner, outer = half_tube(3, 5, 8), half_tube(5, 8, 8)
        names = {"fixed": face(inner, round_side(3)), "pressed": face(outer, round_side(8)), "slave": face(outer, round_side(5)), "master": face(inner, round_side(5))}
        for element_type in ("C3D8", "C3D20"):
            self.mesh_pair(inner, outer, (2.5, 2), element_type)
            for joint in (self.TIE, self.CONTACT):
                with self.subTest(joint[:12], element_type=element_type):
                    force, _ = self.press_pair(joint, names)
                    np.testing.assert_allclose(force, [0, 20 * 16 * 8, 0], rtol=1e-3, atol=5)


if __name__ == "__main__":
    unittest.main()
