"""An input file for CalculiX as FreeCAD's writer made it, and what this workbench puts into it: other element types, more cards."""

import collections
import re

from .errors import InvalidInput
from .words import count, tr

#: element types by order of the mesh, the default first; FreeCAD writes C3D8 and C3D20
TYPES = {1: ("C3D8I", "C3D8"), 2: ("C3D20R", "C3D20")}
#: numbers of the sides of a hexahedron in CalculiX that lie across from each other
_ACROSS = ((1, 2), (3, 5), (4, 6))
_ELEMENTS = re.compile(r"^\*ELEMENT\s*,\s*TYPE=(C3D8|C3D20)\s*,(.*)$", re.IGNORECASE)


def choose(element, order, mesh, loaded, heat=False):
    """(element type, {type: cells} for cells that get another one, a line that says why or "").

    element: one of TYPES[order], or None for the default. mesh: a GroupedMesh, loaded: nodes with loads or supports of a single point. heat: whether
    temperatures are looked for: with those C3D20 is the default of second order, its stresses have a third of the error where it changes from place to place
    (NAFEMS LE11 on one block: 0.4 % and 1.7 %).
    C3D20R takes 8 integration points of 27: better stresses at half the cost of C3D20, but some shapes of deformation without any stiffness. Where cells
    are stacked they hold each other. A free bar of 80 x 5 x 5 mm, one cell in its section, has 376 Hz in place of 4101; a plate of one layer of cells is as
    good as with C3D20. So cells with free sides across from each other in two directions get C3D20, and those at point loads.
    """
    if element is not None and element not in TYPES[order]:
        raise InvalidInput(tr("{} is not an element of a mesh of order {}: {}").format(element, order, ", ".join(TYPES[order])))
    chosen = element or ("C3D20" if heat and order == 2 else TYPES[order][0])
    if element or chosen != "C3D20R":
        return chosen, {}, ""
    alone, pointed = _alone(mesh), {volume for volume in mesh.Volumes if loaded.intersection(mesh.getElementNodes(volume))} if loaded else set()
    others = sorted(alone | pointed)
    if not others:
        return chosen, {}, ""
    why = [tr("{} that are the whole section of a bar").format(count(len(alone)))] if alone else []
    why += [tr("{} at point loads").format(count(len(pointed - alone)))] if pointed - alone else []
    line = tr("C3D20 in place of C3D20R in {} of {} cells, against hourglassing: {}").format(count(len(others)), count(mesh.VolumeCount), tr(" and ").join(why))
    return chosen, {"C3D20": others}, line


def _alone(mesh):
    """Cells with two pairs of sides across from each other on the boundary: only those before and behind hold them."""
    free = {}
    for volume, side in mesh.sides().values():
        free.setdefault(volume, set()).add(side)
    return {volume for volume, sides in free.items() if sum(first in sides and second in sides for first, second in _ACROSS) > 1}


def set_types(text, chosen, others):
    """The text with the element type `chosen` for its hexahedra, and for some cells others: {type: cells}."""
    of_cell = {cell: kind for kind, cells in others.items() for cell in cells}
    found, lines = [], iter(text.split("\n"))
    line = next(lines, None)
    while line is not None:
        head = _ELEMENTS.match(line)
        found.append(line)
        line = next(lines, None)
        if not head:
            continue
        blocks = {chosen: []}
        while line is not None and not line.startswith("*"):
            cell, numbers = [line], _numbers(line)
            while 0 < len(numbers) <= int(head.group(1)[3:]):  # the cell goes on in the next line
                cell.append(next(lines))
                numbers += _numbers(cell[-1])
            if numbers:
                blocks.setdefault(of_cell.get(int(numbers[0]), chosen), []).extend(cell)
            line = next(lines, None)
        found.pop()
        for kind, cells in blocks.items():
            if cells:
                found += ["*ELEMENT, TYPE={},{}".format(kind, head.group(2)), *cells]
    return "\n".join(found)


def _numbers(line):
    return [number for number in line.replace(",", " ").split() if number]


def add_cards(text, model, step):
    """The text with lines before its step and at the end of it."""
    lines = text.split("\n")
    for keyword, added in (("*END STEP", step), ("*STEP", model)):
        at = next(i for i, line in enumerate(lines) if line.upper().startswith(keyword))
        lines[at:at] = added
    return "\n".join(lines)


def outputs_of(text, node_set):
    """The text with results for the nodes of a set only: those of the ground that springs end at are none of the part's."""
    return re.sub(r"^(\*(?:NODE|EL) FILE)\b", r"\1, NSET=" + node_set, text, flags=re.MULTILINE)


def without_others(frd, last_node, last_element):
    """The text of a result file without nodes and elements of higher numbers, as those of springs."""
    heads = {"    2C": last_node, "    3C": last_element}
    found, lines, last, dropped = [], frd.split("\n"), None, False
    for line in lines:
        if line[:6] in heads:
            last, head, count = heads[line[:6]], len(found), 0
        elif last is not None and line.startswith(" -3"):
            found[head] = found[head][:24] + "{:12d}".format(count) + found[head][36:]
            last = None
        elif last is not None and line.startswith(" -1"):
            dropped = int(line[3:13]) > last
            count += not dropped
        if last is None or line[:3] not in (" -1", " -2") or not dropped:
            found.append(line)
    return "\n".join(found)


def undiluted(frd, text, cells):
    """The text of a result file whose stresses and strains are means over the cells at a node: CalculiX counts the springs of the input file `text` there as
    cells without any, which halves them where one cell has one spring. cells: {node: number of its cells}.
    """
    springs = collections.Counter(int(node) for node in re.findall(r"^\*ELEMENT, TYPE=SPRINGA.*\n\d+,(\d+),", text, re.MULTILINE))
    found, is_mean = [], False
    for line in frd.split("\n"):
        if line.startswith(" -4"):
            is_mean = line[5:11].strip() in ("STRESS", "TOSTRA")
        node = int(line[3:13]) if is_mean and line.startswith(" -1") else None
        if node in springs and node in cells:
            values = [float(line[at : at + 12]) * (1 + springs[node] / cells[node]) for at in range(13, len(line.rstrip()), 12)]
            line = line[:13] + "".join("{:12.5E}".format(value) for value in values)
        found.append(line)
    return "\n".join(found)
