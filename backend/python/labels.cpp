#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "core/charts.h"
#include "pipeline/inspect.h"
#include "python/bindings.h"

namespace polycube::python {
namespace {

py::dict make(const std::optional<std::filesystem::path>& path, const std::optional<std::string>& brep, const std::optional<std::string>& object,
              const py::object& progress, const py::object& log, const py::object& cancel, const py::kwargs& given) {
  const MeshOptions options = options_from(given);
  Callbacks callbacks(progress, log, cancel);
  int face_count = 0;
  const LabelledPart part = run_released(callbacks, options, [&] {
    const Assembly assembly = read_part(path, brep, object, options, callbacks.monitor);
    check(options, assembly.diagonal(), {assembly.faces(), assembly.edges(), assembly.vertices(), static_cast<int>(assembly.solids.size())});
    face_count = assembly.faces().back();
    return label_part(assembly, options, callbacks.monitor, Until::kLabels);
  });
  const Inspection inspection = inspect(part);
  py::array_t<double> frame({3, 3});
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) frame.mutable_at(i, k) = part.labelling.frame(i, k);
  py::dict result;
  result["points"] = to_array<double>(part.tets.points, 3);
  result["triangles"] = to_array<int>(part.tets.triangles, 3);
  result["triangle_face"] = to_array(part.tets.triangle_face);
  result["label"] = to_array(part.labelling.label);
  result["frame"] = frame;
  py::dict face_label;
  const std::vector<int> labels = face_labels(part, face_count);
  for (int f = 1; f <= face_count; ++f) face_label[py::int_(f)] = labels[static_cast<std::size_t>(f)];
  result["face_label"] = face_label;
  result["chart"] = to_array(inspection.chart);
  result["corners"] = to_array(inspection.corners);
  result["turning_points"] = to_array(inspection.turning_points);
  result["valid"] = inspection.violations.valid();
  py::dict edges;
  for (const FeatureEdge& e : part.features.edges) edges[py::int_(e.edge)] = py::make_tuple(kCaptureNames.at(static_cast<std::size_t>(e.capture)), e.reason);
  result["edges"] = edges;
  return result;
}

}  // namespace

void bind_labels(py::module_& module) {
  py::list names, colours;
  for (int label = 0; label < 6; ++label) {
    names.append(label_name(label));
    const auto [r, g, b] = label_colour(label);
    colours.append(py::make_tuple(r, g, b));
  }
  module.attr("LABEL_NAMES") = names;
  module.attr("LABEL_COLOURS") = colours;
  module.def(
      "labels", &make, py::kw_only(), py::arg("path") = py::none(), py::arg("brep") = py::none(), py::arg("object") = py::none(),
      py::arg("progress") = py::none(), py::arg("log") = py::none(), py::arg("cancel") = py::none(),
      "Labels of the boundary of one CAD solid, or of several that touch (0..5 = +X -X +Y -Y +Z -Z of the frame), to look at; see backend/python/README.md.");
}

}  // namespace polycube::python
