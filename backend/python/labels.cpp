#include <pybind11/stl.h>

#include <Eigen/Geometry>
#include <map>

#include "pipeline/label_part.h"
#include "python/bindings.h"

namespace polycube::python {
namespace {

/// The label that covers most of each CAD face.
py::dict face_labels(const LabelledPart& part) {
  std::map<int, std::array<double, 6>> areas;
  for (std::size_t t = 0; t < part.tets.triangles.size(); ++t) {
    const auto& [a, b, c] = part.tets.triangles[t];
    const auto& p = part.tets.points;
    auto [it, fresh] = areas.try_emplace(part.tets.triangle_face[t]);
    if (fresh) it->second.fill(0);
    it->second[static_cast<std::size_t>(part.labelling.label[t])] += (p[b] - p[a]).cross(p[c] - p[a]).norm();
  }
  py::dict labels;
  for (const auto& [face, area] : areas) labels[py::int_(face)] = std::distance(area.begin(), std::max_element(area.begin(), area.end()));
  return labels;
}

py::dict make(const std::optional<std::string>& path, const std::optional<std::string>& brep, const py::object& progress, const py::object& log,
              const py::object& cancel, const py::kwargs& given) {
  const MeshOptions options = options_from(given);
  Callbacks callbacks(progress, log, cancel);
  const LabelledPart part = run_released(callbacks, options, [&] {
    const CadModel model = read_model(path, brep);
    check(options, model.diagonal(), model.face_count());
    return label_part(model, options, callbacks.monitor);
  });
  py::array_t<double> frame({3, 3});
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) frame.mutable_at(i, k) = part.labelling.frame(i, k);
  py::dict result;
  result["points"] = to_array<double>(part.tets.points, 3);
  result["triangles"] = to_array<int>(part.tets.triangles, 3);
  result["triangle_face"] = to_array(part.tets.triangle_face);
  result["label"] = to_array(part.labelling.label);
  result["frame"] = frame;
  result["face_label"] = face_labels(part);
  return result;
}

}  // namespace

void bind_labels(py::module_& module) {
  module.def("labels", &make, py::kw_only(), py::arg("path") = py::none(), py::arg("brep") = py::none(), py::arg("progress") = py::none(),
             py::arg("log") = py::none(), py::arg("cancel") = py::none(),
             "Labels of the boundary of one CAD solid (0..5 = +X -X +Y -Y +Z -Z of the frame), to look at.");
}

}  // namespace polycube::python
