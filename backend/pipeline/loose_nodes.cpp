#include "pipeline/loose_nodes.h"

#include <algorithm>

namespace polycube {

int count_loose_nodes(const CadModel& model, const Association& association, const std::vector<Vec3>& points) {
  constexpr double kOnFace = 1e-7;  // mm
  int count = 0;
  for (std::size_t v = 0; v < points.size(); ++v) {
    const auto [dim, id] = association.point_cad[v];
    // The tolerance bounds how far the curve is from its faces.
    if (dim != 1 || model.edge(id).tolerance <= kOnFace) continue;
    const auto& faces = model.edge(id).faces;
    count += std::any_of(faces.begin(), faces.end(), [&](int f) { return model.project_to_face(f, points[v]).distance > kOnFace; });
  }
  return count;
}

}  // namespace polycube
