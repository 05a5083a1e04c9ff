"""What the mesher says, in FreeCAD's language: its refusals and warnings come as finished English lines, with numbers and names such as Face12 in them.

MESSAGES has them as texts with places; a line is told by the one that it fits, and what stands in the places is told likewise, as far as it is words.
tests/architecture/test_engine_words.py holds the table against the engine's sources.
"""

import re
from functools import lru_cache

from .words import noop, tr

#: By where they come from: the shape, solids together, options, what is asked of places, the stages, what a mesh is warned of.
MESSAGES = noop(
    (
        "the shape is empty",
        "the shape is empty: it has no face",
        "the shape is a shell or loose faces, not a solid",
        "the shape is a shell or loose faces, not a solid: sewn within {} mm {}",
        "nothing is left of it",
        "it is open at {}",
        "no shell comes of it",
        "the shape holds {} solids; one is needed",
        "the shape's faces sew to {} solids; one is needed",
        "the shape is open at {}",
        "more than two faces meet at {}",
        "the shape is not valid at {} (OpenCASCADE's check)",
        "the solid has no face",
        "the solid is not valid (OpenCASCADE's check)",
        "the solid's size is not usable: {} mm across",
        "the solid has no volume",
        "the solid is inside out: its volume is negative",
        "the solid intersects itself",
        "the solid touches or crosses itself at {}",
        "{} and others",
        "{} has no usable coordinates",
        "{} has no curve on {}",
        "{} bounds {} faces; two are needed",
        "OpenCASCADE cannot check the shape",
        "OpenCASCADE cannot evaluate the shape",
        "OpenCASCADE cannot read the BREP shape",
        "OpenCASCADE cannot place the shape",
        "OpenCASCADE cannot move the shape",
        "OpenCASCADE changes the shape when it moves it",
        "OpenCASCADE renumbers the shape when it moves it",
        "OpenCASCADE cannot tell where the solids touch",
        "OpenCASCADE cannot join the solids",
        "a solid falls to pieces",
        "not a BREP shape",
        "the BREP shape is cut short or damaged",
        # solids together
        "{} and {} overlap: they have {} mm^3 in common",
        "the solids together make no solid: more than two faces meet where they touch along a line only",
        "the solids together make no solid: their outside touches itself in a point only",
        "the solids together make no solid",
        "the two solids do not see their common face alike",
        "a block of the grid belongs to no solid",
        "the grid changes from one solid to another where there is no interface",
        "the mesh does not tell a common face from what is beside it",
        "of {} solids that are meshed separately each has axes of its own: look at one of them, or at those that touch",
        "of several solids the labels are shown without a map",
        "{}; --interfaces separate meshes each solid by itself",
        "{}: the map folds",
        # options
        "there is no option '{}'",
        "the options are no JSON object",
        "{} cannot be read",
        "{}: '{}' is out of range",
        "{}: '{}' is not {}",
        "a number",
        "a whole number",
        "{} is not a number",
        "{}: '{}' is neither true nor false",
        "{}: '{}' is not one of {}",
        "{} must be greater than 0",
        "{} must be {}, not {}",
        "greater than 0",
        "at least {}",
        "{} must be at most {}, not {}",
        "give only one of size, hexes and coarsest",
        "coarsest leaves no room for {}",
        "element_type {} is of order {}, but order {} is asked for",
        "size {} mm is larger than the part (bounding-box diagonal {} mm)",
        "that would make about {} hexahedra, more than the {} that are possible",
        "two directions are needed, those of X and Y, not {}",
        "a direction is not a number",
        "a direction has no length",
        "X and Y must be at right angles, not {} degrees apart",
        "the folder for temporary files, TMPDIR, does not exist",
        "no folder can be made in that for temporary files, {}; TMPDIR names another",
        # what is asked of places
        "{}: '{}' is not of the form {}",
        "1,0,0/0,1,0 (the directions of X and Y)",
        "Edge4=6, Face1-Face2=3.. or Solid2=3.. (3: exactly, 3..: at least, ..3: at most, 2..5: between)",
        "Face3=0.5, X=2 or Solid2=1.5",
        "Face7=2, Edge3=1, Vertex2=1 or Solid1=1",
        "{}: '{}' has a comma where a point is wanted, as in 0.5",
        "{} does not belong to the solid",
        "{} does not exist, the part has {}",
        "{} faces",
        "{} edges",
        "{} vertices",
        "{} solid",
        "{} solids",
        "{} is given twice",
        "of the walls of a solid only the least number can be given, as {}=3..",
        "there must be 1 element at least, not {}",
        "{}: {} leaves no number",
        "{}: {} elements are too many",
        "the size of {} must be greater than 0",
        "the ratio of {} must be from 0.001 to 1000",
        "the levels of {} must be from 1 to {}, not {}",
        "the edge is a seam, which meshes do not follow",
        "the edge is a point",
        "both faces are the same",
        "the faces belong to different solids",
        "{} cannot be {} all over, it turns against it; {}",
        "{} cannot be {}, it does not face that way; {}",
        "it turns too far for any one label",
        "it can be {}",
        "it can be {} or {}",
        "it can be {} or {} or {}",
        "{} and {} contradict each other: they are the two sides of one face",
        # tetrahedra
        "Gmsh makes no usable tetrahedra with any of {} settings; last: {}",
        "Gmsh's {} lies on no CAD entity",
        "two of Gmsh's entities lie on {}",
        "a tetrahedron has no volume",
        "more than two tetrahedra share a facet",
        "a boundary facet of the tetrahedra lies on no CAD face",
        "some surface triangles bound no tetrahedron",
        "a piece of {} is no edge of the boundary",
        "the tetrahedra of a solid are not bounded by its faces",
        "a solid has no tetrahedra",
        "the tetrahedra leave out {}",
        "the boundary of the tetrahedra has another topology than the CAD",
        "Gmsh died of signal {}",
        "Gmsh failed without a word",
        "Gmsh ran longer than {} s",
        "Gmsh made no tetrahedra",
        "the program polycube-tet is missing",
        "cannot start {}: {}",
        "the worker's mesh is cut short",
        "the worker wrote no mesh",
        "cannot write {}",
        "cannot read the setting {}",
        "the tetrahedra cannot be written: the folder for temporary files (TMPDIR) is full or must not grow",
        "the part cannot be written for Gmsh: the folder for temporary files (TMPDIR) is full or must not grow",
        # labels, map and blocks
        "no map can have these labels: along one axis each of these charts would have to lie beyond the one before it, and the first beyond the last: {}",
        "{}, with {} set by hand",
        "the same as one before",
        "the charts leave no room along {}",
        "charts {}",
        "the charts' planes do not bound a volume",
        "the image of the map has no volume",
        "the blocks do not fill the image of the map",
        "charts that bound no volume in the image of the map",
        "blocks have sides on no chart",
        "blocks do not fit their neighbours",
        "charts touch, the boundary of the blocks is not a manifold",
        "the blocks do not have the topology of the solid, Euler characteristic {} instead of {}",
        "blocks between the charts' planes are not boxes",
        "a block has a side on no chart's sheet",
        "its two ends lie on different charts of one axis",
        "a face beside it would be squeezed flat",
        "the tet mesh has no nodes on it",
        "smooth, below the feature angle",
        "the map folds there",
        # numbers of cells
        "the order of the charts contradicts itself",
        "constraint {} contradicts the shape of the part",
        "constraints that cannot hold together: {}",
        "the constraints leave no valid mesh: some charts would have to coincide",
        "no valid mesh satisfies {}",
        "constraint '{}' is not between two charts of one axis",
        "constraint '{}' is on a feature that no sheet reaches",
        "at least {} elements through every wall",
        "{} elements through every wall",
        "an element through the walls of a solid",
        "{} elements through the walls of a solid",
        "no edge longer than the largest size",
        "no cell longer than 10 times its width",
        "cells that grow by {} at most",
        "{} round the bore",
        "{} round the shaft",
        "{} round the curve",
        "{} along the arc",
        "room for edges",
        "room for CAD vertices",
        "the structure of the coarser mesh",
        "the faces of division {} are nowhere opposite each other",
        "the grid does not follow the edge of division {}",
        "division {}: the edge takes {} turns of the grid, it needs as many elements",
        "the grid does not follow the edge of --bias {}",
        # cells
        "charts without a quad: {}",
        "the integers of the charts are not in the order of the map",
        "the integers do not keep the structure of the coarser ones",
        "the hexahedra do not form a conforming mesh with the topology of the solid",
        "the mesh has another topology than the solid",
        "the surface of the hexahedral mesh is not the surface of the part",
        "padding broke the mesh",
        "the mesh handed to padding is not sound",
        "the mesh does not conform",
        "a sheet would branch at node {}",
        "a quad is no side of a cell",
        "{} cells stay inverted",
        "cells stay inverted, and no CAD edge is left to give up there",
        "cells stay inverted after {} attempts",
        "a grid of {} cells would take longer than its share of the time",
        "cells stay flat",
        "cells without positive Jacobian",
        "cells lose their volume on the way back to the part's place",
        "a cell without size",
        "a node is off its CAD entity",
        "the mesh has no cells",
        "{} cells have a Jacobian that is not positive at an integration point",
        "a boundary quad belongs to no cell",
        "a boundary edge belongs to no cell",
        "no plan is left",
        "out of memory",
        "internal error",
        "cancelled",
        "out of time",
        "stopped by the user",
        # warnings
        "the search was ended early; this is the best mesh so far",
        "the time limit ended the search; this is the best mesh so far",
        "the cells are finer than asked for",
        "the sizes of the cells could be better still: the best integers were not found within the search's nodes",
        "walls have fewer layers than the default: with them the mesh would be poor or none",
        "the size alone decides: with the cells that walls and circles ask for the mesh would be poor or none",
        "{} hexahedra where {} were asked for",
        "{} has no mesh edges on it",
        "{}: {} through the wall, not {}",
        "{}: {} round the curve, not {}",
        "{}: {} along the curve, not {}",
        "{} element",
        "{} elements",
        "size {}: the cells there are {} mm long",
        "division {}: the mesh has {} elements there",
        "{} and {} more",
        "{} more walls with fewer elements through them than asked for",
        "{} more CAD edges with fewer elements along them than their turning asks for",
        "{} more sizes of faces that the cells do not have",
        "{} are one surface to the mesh, as the feature angle asks: the borders of their mesh faces are off the CAD edges between them, "
        "and their areas differ from the CAD's",
        "{} mid-edge nodes are off the CAD, where they would spoil a cell: {}",
        "local refinement: {} cells are divided besides the {} asked for, since only convex regions have templates round them",
        "local refinement: {} has no cells, as the mesh does not follow it",
        "the shape is no solid: its {} face is sewn to {} within {} mm",
        "the shape is no solid: its {} faces are sewn to {} within {} mm",
        "one",
        "left out beside the solid: {}",
        "{} loose face",
        "{} loose faces",
        "{} loose edge",
        "{} loose edges",
        "{} loose vertex",
        "{} loose vertices",
        "the solid is in the shape {} times; it is meshed once",
        "{} and {} meet in {} alone: they have no nodes in common, and no load passes from one to the other",
        "{} and {} touch in a line or a point alone: they have no nodes in common, and no load passes from one to the other",
        "{} and {} do not touch: they are {} mm apart, and have no common nodes",
    )
)

#: Names of what was asked for, as 'Face5: 12 elements round the bore', 'Edge4=6'
_LIST = re.compile(r"'[^']*'(, '[^']*')*")


def told(line):
    """The line in FreeCAD's language; as it is where there is no translation, or no message that it fits."""
    if _LIST.fullmatch(line):
        return _quoted(line)
    for pattern, text in _patterns():
        found = pattern.fullmatch(line)
        if found:
            translated = tr(text)
            return line if translated == text else translated.format(*map(told, found.groups()))
    # "Solid1: ...", "sizes: ...": whose it is stands before it.
    for colon in re.finditer(": ", line):
        whose, rest = line[: colon.start()], line[colon.end() :]
        words = told(whose), told(rest)
        if words != (whose, rest):
            return ": ".join(words)
    return ", ".join(map(told, line.split(", "))) if ", " in line else line


def _quoted(line):
    """The line with what stands between quotation marks told."""
    return re.sub(r"'([^']*)'", lambda one: "'{}'".format(told(one.group(1))), line)


@lru_cache(maxsize=None)
def _patterns():
    """(pattern, text) of the messages, those of the most words first: a line that fits two is the one of more words."""
    found = []
    for text in MESSAGES:
        words = re.findall(r"[^\W\d_]{2,}", text.replace("{}", ""))
        # Beside a single word, as in "{} faces", stands a number or a name, no sentence.
        place = r"(.+?)" if len(words) > 1 else r"(\S+)"
        found.append((re.compile(place.join(map(re.escape, text.split("{}")))), text))
    return sorted(found, key=lambda one: len(one[1].replace("{}", "")), reverse=True)
