"""In which analysis a mesh is: chosen in the panel, one mesh for each analysis."""


def of(document):
    """The analyses of a document."""
    return [obj for obj in document.Objects if obj.isDerivedFrom("Fem::FemAnalysis")]


def active(document):
    """The analysis that the user works on, if it is one of this document."""
    import FemGui

    analysis = FemGui.getActiveAnalysis()
    return analysis if analysis and analysis.Document == document else None


def other_meshes(analysis, mesh=None):
    """The FEM meshes of an analysis but this one, and but the meshes that results are shown on."""
    found = [obj for obj in analysis.Group if obj.isDerivedFrom("Fem::FemMeshObject") and obj != mesh]
    return [obj for obj in found if getattr(getattr(obj, "Proxy", None), "Type", "") != "Fem::MeshResult"]


def shown_results(analysis):
    """What results of an analysis are shown on: their meshes, and pipelines of them with their filters, which FreeCAD 1.x makes of every result."""
    found = [obj.Mesh for obj in analysis.Group if obj.isDerivedFrom("Fem::FemResultObject") and obj.Mesh]
    for obj in analysis.Group:
        if obj.isDerivedFrom("Fem::FemPostObject"):
            found += [obj, *(inner for inner in obj.OutListRecursive if inner.isDerivedFrom("Fem::FemPostObject"))]
    return found


def move(mesh, analysis):
    """Has the mesh in this analysis and in no other; in none where it is None."""
    for other in of(mesh.Document):
        if other != analysis and mesh in other.Group:
            other.removeObject(mesh)
    if analysis and mesh not in analysis.Group:
        analysis.addObject(mesh)
