// The module _polycube: version, exceptions, orders of nodes.
#include "core/error.h"
#include "fem/fem.h"
#include "job/job.h"
#include "python/bindings.h"

namespace polycube::python {
namespace {

py::handle invalid_input, stage_failed, cancelled;

py::handle add_exception(py::module_& module, const char* name, PyObject* base) {
  PyObject* type = PyErr_NewException((std::string("_polycube.") + name).c_str(), base, nullptr);
  if (type == nullptr) throw py::error_already_set();
  module.add_object(name, type);
  return type;  // the module keeps it alive
}

void raise_stage_failed(const StageFailed& failure) {
  py::list entities;
  for (const CadRef& entity : failure.entities()) entities.append(name(entity));
  py::object error = stage_failed(failure.what());
  error.attr("stage") = failure.stage();
  error.attr("entities") = entities;
  PyErr_SetObject(stage_failed.ptr(), error.ptr());
}

void translate(std::exception_ptr pointer) {  // NOLINT(performance-unnecessary-value-param): as pybind11 wants it
  try {
    if (pointer) std::rethrow_exception(pointer);
  } catch (const InvalidInput& e) {
    PyErr_SetString(invalid_input.ptr(), e.what());
  } catch (const StageFailed& e) {
    raise_stage_failed(e);
  } catch (const Cancelled& e) {
    PyErr_SetString(cancelled.ptr(), e.what());
  }
}

py::array_t<int> order(const std::vector<int>& nodes) { return to_array(nodes); }

}  // namespace
}  // namespace polycube::python

PYBIND11_MODULE(_polycube, module) {
  using namespace polycube::python;
  module.doc() = "Hexahedral meshes of CAD solids by polycube maps.";
  module.attr("__version__") = POLYCUBE_VERSION;
  invalid_input = add_exception(module, "InvalidInput", PyExc_ValueError);
  stage_failed = add_exception(module, "StageFailed", PyExc_RuntimeError);
  cancelled = add_exception(module, "Cancelled", PyExc_RuntimeError);
  py::register_exception_translator(&translate);
  const auto& smesh = polycube::kSmeshHex20;
  module.attr("SMESH_HEX8") = order({smesh.begin(), smesh.begin() + 8});
  module.attr("SMESH_HEX20") = order({smesh.begin(), smesh.end()});
  module.attr("SMESH_QUAD4") = order({0, 1, 2, 3});
  module.attr("SMESH_QUAD8") = order({0, 1, 2, 3, 4, 5, 6, 7});
  module.def(
      "serve_job",
      [](const std::string& folder, const std::string& kind) {
        const py::gil_scoped_release released;
        return polycube::serve_job(folder, polycube::job_kind(kind));
      },
      py::arg("folder"), py::arg("kind") = "mesh",
      "Does the job in a folder as `polycube serve-job` does and returns the exit status; for a process that does nothing else. See backend/job/README.md.");
  bind_options(module);
  bind_mesh(module);
  bind_labels(module);
}
