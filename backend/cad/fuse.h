// What solids become where they are joined. Private to cad.
#pragma once

#include <BRepAlgoAPI_BuilderAlgo.hxx>
#include <Standard_Failure.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_ListOfShape.hxx>
#include <vector>

#include "cad/occt.h"
#include "cad/shape.h"

namespace polycube {

/// OCCT's general fuse of the solids: what each of them, and each of their faces, becomes where common parts exist once.
class GeneralFuse {
 public:
  GeneralFuse(const std::vector<CadModel>& solids, const Monitor& monitor) {
    TopTools_ListOfShape arguments;
    for (const CadModel& solid : solids) arguments.Append(solid.shape().shape);
    builder_.SetArguments(arguments);
    builder_.SetNonDestructive(true);
    builder_.SetRunParallel(false);
    const opencascade::handle<OcctProgress> progress = new OcctProgress(monitor);
    builder_.Build(progress->Start());
    monitor.check();
    if (!builder_.IsDone() || builder_.HasErrors()) throw Standard_Failure("the general fuse of the solids fails");
  }

  std::vector<TopoDS_Shape> images(const TopoDS_Shape& shape) {
    std::vector<TopoDS_Shape> result;
    for (const TopoDS_Shape& image : builder_.Modified(shape)) result.push_back(image);
    if (result.empty() && !builder_.IsDeleted(shape)) result.push_back(shape);
    return result;
  }

 private:
  BRepAlgoAPI_BuilderAlgo builder_;
};

/// The solid itself where a compound is around it.
inline TopoDS_Shape solid_in(const TopoDS_Shape& shape) { return TopExp_Explorer(shape, TopAbs_SOLID).Current(); }

}  // namespace polycube
