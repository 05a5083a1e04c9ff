#include <BOPAlgo_ArgumentAnalyzer.hxx>
#include <Standard_Failure.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopTools_ListOfShape.hxx>
#include <algorithm>

#include "cad/shape.h"

namespace polycube {

std::vector<CadRef> CadModel::self_contacts() const {
  std::vector<CadRef> contacts;
  try {
    BOPAlgo_ArgumentAnalyzer analyzer;
    analyzer.SetShape1(shape_->shape);
    analyzer.ArgumentTypeMode() = true;
    analyzer.SelfInterMode() = true;
    analyzer.Perform();
    for (const BOPAlgo_CheckResult& result : analyzer.GetCheckResult()) {
      if (result.GetCheckStatus() != BOPAlgo_SelfIntersect) continue;
      for (const auto& [kind, dim] : {std::pair{TopAbs_FACE, 2}, std::pair{TopAbs_EDGE, 1}, std::pair{TopAbs_VERTEX, 0}}) {
        TopTools_IndexedMapOfShape map;
        TopExp::MapShapes(shape_->shape, kind, map);
        for (const TopoDS_Shape& faulty : result.GetFaultyShapes1()) {
          if (map.Contains(faulty)) contacts.push_back({dim, brep_order(dim)[static_cast<std::size_t>(map.FindIndex(faulty)) - 1]});
        }
      }
    }
  } catch (const Standard_Failure&) {
    return {};  // what OpenCASCADE cannot compare, nobody can blame
  }
  // Faces first: they tell most.
  const auto key = [](const CadRef& c) { return std::pair(-c.dim, c.id); };
  std::sort(contacts.begin(), contacts.end(), [&](const CadRef& a, const CadRef& b) { return key(a) < key(b); });
  contacts.erase(std::unique(contacts.begin(), contacts.end(), [&](const CadRef& a, const CadRef& b) { return key(a) == key(b); }), contacts.end());
  return contacts;
}

}  // namespace polycube
