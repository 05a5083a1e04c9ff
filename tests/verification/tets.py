#!/usr/bin/python3
"""A mesh of tetrahedra with ten nodes, by the Gmsh library with the options that FreeCAD's Gmsh mesher gives it; run as a program of its own.

    tets.py SHAPE.brep SIZE OUT.unv
"""

import ctypes
import ctypes.util
import sys

#: those of FreeCAD 0.20's GmshTools for a mesh of second order, and the optimization without which it ends in negative Jacobians on many parts
OPTIONS = {
    "General.Terminal": 0,
    "Mesh.CharacteristicLengthMin": 0,
    "Mesh.ElementOrder": 2,
    "Mesh.SecondOrderLinear": 0,
    "Mesh.HighOrderOptimize": 1,
    "Mesh.Optimize": 1,
    "Mesh.Algorithm": 2,
    "Mesh.Algorithm3D": 1,
    "Mesh.SaveAll": 1,
}


def mesh(shape, size, out):
    gmsh = ctypes.CDLL(ctypes.util.find_library("gmsh"))
    trouble = ctypes.c_int()

    def call(name, *arguments):
        getattr(gmsh, name)(*arguments, ctypes.byref(trouble))
        if trouble.value:
            raise RuntimeError("{} failed".format(name))

    # Argument 4 came with Gmsh 4.9; a library that is older takes it for the place of the error, and 0 for none.
    gmsh.gmshInitialize(0, None, 0, 0, ctypes.byref(trouble))
    for name, value in {**OPTIONS, "Mesh.CharacteristicLengthMax": size}.items():
        call("gmshOptionSetNumber", name.encode(), ctypes.c_double(value))
    call("gmshOpen", shape.encode())
    call("gmshModelMeshGenerate", 3)
    call("gmshWrite", out.encode())


if __name__ == "__main__":
    mesh(sys.argv[1], float(sys.argv[2]), sys.argv[3])
