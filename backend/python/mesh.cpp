#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "core/error.h"
#include "pipeline/part_mesh.h"
#include "python/bindings.h"

namespace polycube::python {
namespace {

using Mesh = PartMesh;

py::array_t<int> nodes_of(const Mesh& mesh, const std::vector<std::array<int, 20>>& rows) { return to_array<int>(rows, mesh.fem.order == 2 ? 20 : 8); }

py::dict groups(const Mesh& mesh) {
  py::dict all;
  for (const FemGroup& group : mesh.fem.groups) {
    py::dict entry;
    entry["nodes"] = to_array(group.nodes);
    if (group.entity.dim > 0) entry[kGroupElements.at(static_cast<std::size_t>(group.entity.dim))] = to_array(group.elements);
    all[py::str(group_name(group))] = entry;
  }
  return all;
}

py::array_t<double> per_cell(const Mesh& mesh, double (*measure)(const std::vector<Vec3>&, const Hex&)) { return to_array(cell_values(mesh.fem, measure)); }

py::object report(const Mesh& mesh) { return py::module_::import("json").attr("loads")(to_json(mesh.report)); }

Mesh make(const std::optional<std::filesystem::path>& path, const std::optional<std::string>& brep, const std::optional<std::string>& object,
          const py::object& progress, const py::object& log, const py::object& cancel, const py::kwargs& given) {
  const MeshOptions options = options_from(given);
  Callbacks callbacks(progress, log, cancel);
  return run_released(callbacks, options,
                      [&] { return mesh_part([&] { return read_part(path, brep, object, options, callbacks.monitor); }, options, callbacks.monitor); });
}

/// A part that is meshed several times. What is given to mesh() comes before what was given at first.
class PartSession {
  /// Does the work with the options of all, released and with the callbacks' monitor.
  template <class Work>
  auto at_work(const py::object& progress, const py::object& log, const py::object& cancel, const py::kwargs& more, const Work& work) {
    py::kwargs all(given_.attr("copy")());
    const auto names_size = [](const py::dict& d) { return d.contains("size") || d.contains("hexes") || d.contains("coarsest"); };
    if (names_size(more)) {
      for (const char* name : {"size", "hexes", "coarsest"}) all.attr("pop")(name, py::none());
    }
    all.attr("update")(more);
    const MeshOptions options = options_from(all);
    Callbacks callbacks(progress, log, cancel);
    const std::unique_lock lock(at_work_, std::try_to_lock);
    if (!lock.owns_lock()) throw InvalidInput("the session is at work in another thread");
    return run_released(callbacks, options, [&] { return work(options, callbacks.monitor); });
  }

 public:
  PartSession(Assembly assembly, py::kwargs given) : session_(std::move(assembly), options_from(given)), given_(std::move(given)) {}

  void prepare(Callbacks& callbacks) {
    const MeshOptions options = options_from(given_);
    run_released(callbacks, options, [&] {
      session_.prepare(callbacks.monitor);
      return true;
    });
  }

  Mesh mesh(const py::object& progress, const py::object& log, const py::object& cancel, const py::kwargs& more) {
    return at_work(progress, log, cancel, more, [&](const MeshOptions& options, const Monitor& monitor) { return session_.mesh(options, monitor); });
  }

  int count(const py::object& progress, const py::object& log, const py::object& cancel, const py::kwargs& more) {
    return at_work(progress, log, cancel, more, [&](const MeshOptions& options, const Monitor& monitor) { return session_.count(options, monitor); });
  }

 private:
  AssemblySession session_;
  py::kwargs given_;
  std::mutex at_work_;
};

std::unique_ptr<PartSession> prepare(const std::optional<std::filesystem::path>& path, const std::optional<std::string>& brep,
                                     const std::optional<std::string>& object, const py::object& progress, const py::object& log, const py::object& cancel,
                                     const py::kwargs& given) {
  const MeshOptions options = options_from(given);
  Callbacks callbacks(progress, log, cancel);
  Assembly assembly = run_released(callbacks, options, [&] { return read_part(path, brep, object, options, callbacks.monitor); });
  auto session = std::make_unique<PartSession>(std::move(assembly), given);
  session->prepare(callbacks);
  return session;
}

void write_mesh(const Mesh& mesh, const std::filesystem::path& path, const std::optional<std::string>& element_type) {
  const py::gil_scoped_release released;
  write(mesh.fem, path.string(), element_type.value_or(effective_element_type(mesh.report.options)), Monitor());
}

}  // namespace

void bind_mesh(py::module_& module) {
  py::class_<Mesh> cls(module, "Mesh", "Finite element mesh; see backend/python/README.md for shapes and orders.");
  const auto fields =
      std::make_tuple(std::make_pair("order", [](const Mesh& m) { return py::object(py::int_(m.fem.order)); }),
                      std::make_pair("nodes", [](const Mesh& m) { return py::object(to_array<double>(m.fem.points, 3)); }),
                      std::make_pair("hexes", [](const Mesh& m) { return py::object(nodes_of(m, m.fem.hexes)); }),
                      std::make_pair("hex_block", [](const Mesh& m) { return py::object(to_array(m.fem.hex_block)); }),
                      std::make_pair("hex_solid", [](const Mesh& m) { return py::object(to_array(solid_numbers(m.fem))); }),
                      std::make_pair("quads", [](const Mesh& m) { return py::object(to_array<int>(m.fem.quads, m.fem.order == 2 ? 8 : 4)); }),
                      std::make_pair("quad_face", [](const Mesh& m) { return py::object(to_array(m.fem.quad_face)); }),
                      std::make_pair("quad_hex", [](const Mesh& m) { return py::object(to_array<int>(m.fem.quad_hex, 2)); }),
                      std::make_pair("segments", [](const Mesh& m) { return py::object(to_array<int>(m.fem.segments, m.fem.order == 2 ? 3 : 2)); }),
                      std::make_pair("segment_edge", [](const Mesh& m) { return py::object(to_array(m.fem.segment_edge)); }),
                      std::make_pair("groups", [](const Mesh& m) { return py::object(groups(m)); }),
                      std::make_pair("scaled_jacobian", [](const Mesh& m) { return py::object(per_cell(m, scaled_jacobian)); }),
                      std::make_pair("edge_ratio", [](const Mesh& m) { return py::object(per_cell(m, edge_ratio)); }),
                      std::make_pair("skew", [](const Mesh& m) { return py::object(per_cell(m, skew)); }),
                      std::make_pair("warpage", [](const Mesh& m) { return py::object(per_cell(m, warpage)); }),
                      std::make_pair("report", [](const Mesh& m) { return report(m); }));
  std::apply([&](const auto&... field) { (cls.def_property_readonly(field.first, field.second), ...); }, fields);
  cls.def("to_dict", [fields](const Mesh& m) {
    py::dict all;
    std::apply([&](const auto&... field) { ((all[field.first] = field.second(m)), ...); }, fields);
    return all;
  });
  cls.def("write", &write_mesh, py::arg("path"), py::arg("element_type") = py::none(),
          "Writes .inp, .unv, .vtu, .med or .mesh by suffix; element_type (.inp only) overrides the option.");
  py::class_<PartSession>(module, "Session", "A part that is meshed several times; what does not depend on counts and sizes is made once.")
      .def("mesh", &PartSession::mesh, py::kw_only(), py::arg("progress") = py::none(), py::arg("log") = py::none(), py::arg("cancel") = py::none(),
           "As mesh(), by the options given to prepare() and these, which come first.")
      .def("count", &PartSession::count, py::kw_only(), py::arg("progress") = py::none(), py::arg("log") = py::none(), py::arg("cancel") = py::none(),
           "How many hexahedra mesh() would make of these options, without fitting them.");
  module.def("prepare", &prepare, py::kw_only(), py::arg("path") = py::none(), py::arg("brep") = py::none(), py::arg("object") = py::none(),
             py::arg("progress") = py::none(), py::arg("log") = py::none(), py::arg("cancel") = py::none(),
             "A Session of one CAD solid or several, with tetrahedra, labels, map and blocks made. Further keyword arguments: options().");
  module.def("mesh", &make, py::kw_only(), py::arg("path") = py::none(), py::arg("brep") = py::none(), py::arg("object") = py::none(),
             py::arg("progress") = py::none(), py::arg("log") = py::none(), py::arg("cancel") = py::none(),
             "Hexahedral mesh of a CAD solid, or of several. Further keyword arguments: options().");
}

}  // namespace polycube::python
