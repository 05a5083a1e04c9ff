"""Planes of symmetry in an input file of CalculiX: plane faces that cannot move along their normal, can in all other directions, and are not drawn along themselves.

A force along the plane is that of both sides, between which shear stresses jump: what is on one side says nothing of the other.
"""

#: what may make the two sides of such a plane differ: loads that are not mirrored, nodes that hang together, axes that are turned
_UNLIKE = {"*TEMPERATURE", "*COUPLED TEMPERATURE-DISPLACEMENT", "*UNCOUPLED TEMPERATURE-DISPLACEMENT"}
_UNLIKE |= {"*EQUATION", "*MPC", "*RIGID BODY", "*TRANSFORM", "*INCLUDE", "*ORIENTATION"}
_UNLIKE_LOADS = ("GRAV", "CENTRIF")
#: a plane is plane within this share of the part's size; Theory: FreeCAD writes 13 digits of a coordinate, 7 are those of a small part far from the origin
_NEAR = 1e-7


def planes(path, numbers, points, sides):
    """[(axis, nodes of a plane across it)] of the part in an input file.

    numbers: those of the nodes in the file, by rows of points (n, 3). sides: (q, 8), rows of points of the sides of cells on the boundary.
    """
    import numpy

    held, drawn = _held(path)
    if not held:
        return []
    fixed, forced = numpy.zeros((2, len(points), 3), bool)
    row = {number: row for row, number in enumerate(numbers)}
    for marks, found in ((fixed, held), (forced, drawn)):
        for node, axes in found.items():
            if node in row:
                marks[row[node], list(axes)] = True
    near, found = _NEAR * numpy.ptp(points, axis=0).max(), []
    whole = fixed[sides].all(axis=1)
    for axis in range(3):
        flat = numpy.ptp(points[sides, axis], axis=1) < near
        mine = sides[flat & whole[:, axis] & (whole.sum(axis=1) == 1)]
        # a force on a face beside the plane is on the nodes of their common edge too, never on all of a side
        along = numpy.delete(forced, axis, axis=1).any(axis=1)
        while len(mine):
            level = points[mine[0, 0], axis]
            same = numpy.abs(points[mine[:, 0], axis] - level) < near
            here = mine[same]
            pulled = along[here].all(axis=1)
            nodes = numpy.setdiff1d(here[~pulled], here[pulled])
            found += [(axis, nodes)] if len(nodes) else []
            mine = mine[~same]
    return found


def _held(path):
    """({node: axes, 0 to 2, along which it cannot move}, {node: axes of forces and springs on it}); empty where something in the file makes the sides of a plane
    differ, or is not known here."""
    sets, rows, drawn, keyword, name = {}, [], {}, "", ""
    with open(path, encoding="utf-8") as file:
        for line in file:
            if line.startswith("**"):
                continue
            if line.startswith("*"):
                head = [word.strip() for word in line.strip().split(",")]
                keyword = head[0].upper()
                if keyword == "*ELEMENT" and any(word.upper().replace(" ", "").startswith("TYPE=SPRING") for word in head[1:]):
                    keyword = "SPRINGS"
                if keyword in _UNLIKE:
                    return {}, {}
                name = next((word.split("=")[1].strip().upper() for word in head[1:] if word.upper().startswith("NSET=")), "")
            elif keyword == "*NSET":
                sets.setdefault(name, set()).update(int(word) for word in line.replace(",", " ").split() if word.isdigit())
            elif keyword == "*DLOAD" and any(load in line.upper() for load in _UNLIKE_LOADS):
                return {}, {}
            elif keyword == "*CLOAD" and line.strip():
                node, axis, force, *_ = (word.strip() for word in line.split(","))
                if not node.isdigit():
                    return {}, {}
                if axis in "123" and float(force):
                    drawn.setdefault(int(node), set()).add(int(axis) - 1)
            elif keyword == "SPRINGS":
                for node in (word.strip() for word in line.split(",")[1:]):
                    if node.isdigit():
                        drawn.setdefault(int(node), set()).update(range(3))
            elif keyword == "*BOUNDARY":
                rows.append([word.strip() for word in line.split(",")])
    found = {}
    for what, first, *more in (row for row in rows if len(row) > 1):
        if not what.isdigit() and what.upper() not in sets:
            return {}, {}
        # one that is moved by an amount is held in every direction here: it may be a plane that is bent
        moved = len(more) > 1 and more[1] and float(more[1]) != 0
        axes = range(3) if moved else range(int(first) - 1, min(int(more[0]) if more and more[0] else int(first), 3))
        for node in (int(what),) if what.isdigit() else sets[what.upper()]:
            found.setdefault(node, set()).update(axes)
    return found, drawn
