// What the parts of the Python module share.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <atomic>
#include <filesystem>
#include <mutex>
#include <optional>

#include "cad/assembly.h"
#include "core/error.h"
#include "core/monitor.h"
#include "core/options.h"

namespace polycube::python {

namespace py = pybind11;

/// A Monitor over Python callables. Throttled, so that stages may ask as often as they like. An exception in a callback (or Ctrl-C) cancels
/// the work; rethrow() then hands it on.
class Callbacks {
 public:
  Callbacks(const py::object& progress, const py::object& log, const py::object& cancel);
  Monitor monitor;
  /// Call with the GIL held, after the work ended by Cancelled: throws the callback's exception if there was one.
  void rethrow();

 private:
  bool cancel_requested();
  void report(const std::string& stage, double fraction);
  /// Runs work with the GIL held and keeps the first exception.
  template <typename Work>
  bool guarded(const Work& work);

  py::object progress_, log_, cancel_;
  std::mutex mutex_;
  std::optional<py::error_already_set> error_;
  std::atomic<bool> stop_{false};
  std::atomic<Monitor::Clock::rep> next_cancel_{0}, next_progress_{0};
};

/// Options from keyword arguments; None means the default. Throws InvalidInput.
MeshOptions options_from(const py::kwargs& given);

/// Exactly one of path and brep must be given. Throws InvalidInput.
inline Assembly read_part(const std::optional<std::filesystem::path>& path, const std::optional<std::string>& brep, const std::optional<std::string>& object,
                          const MeshOptions& options, const Monitor& monitor) {
  if (path.has_value() == brep.has_value()) throw InvalidInput("give either path or brep");
  if (object && brep) throw InvalidInput("object is for FreeCAD documents only");
  const ReadOptions how{.object = object.value_or(""), .sew = options.sew};
  return path ? Assembly::read(path->string(), how, monitor) : Assembly::from_brep(*brep, how, monitor);
}

/// Runs `work` with the GIL released and the time limit of the options, and turns what callbacks threw into what comes out.
template <typename Work>
auto run_released(Callbacks& callbacks, const MeshOptions& options, const Work& work) {
  if (options.time_limit > 0)
    callbacks.monitor.set_deadline(Monitor::Clock::now() +
                                   std::chrono::duration_cast<Monitor::Clock::duration>(std::chrono::duration<double>(options.time_limit)));
  try {
    const py::gil_scoped_release released;
    return work();
  } catch (...) {
    callbacks.rethrow();
    throw;
  }
}

/// A copy of rows of fixed width as (n, columns) array; columns <= the rows' width.
template <typename Element, typename Row>
py::array_t<Element> to_array(const std::vector<Row>& rows, int columns) {
  py::array_t<Element> array({static_cast<py::ssize_t>(rows.size()), static_cast<py::ssize_t>(columns)});
  auto view = array.template mutable_unchecked<2>();
  for (py::ssize_t i = 0; i < std::ssize(rows); ++i)
    for (int k = 0; k < columns; ++k) view(i, k) = rows[static_cast<std::size_t>(i)][k];
  return array;
}

template <typename Element>
py::array_t<Element> to_array(const std::vector<Element>& values) {
  return py::array_t<Element>(static_cast<py::ssize_t>(values.size()), values.data());
}

void bind_options(py::module_& module);
void bind_mesh(py::module_& module);
void bind_labels(py::module_& module);

}  // namespace polycube::python
