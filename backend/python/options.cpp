#include "core/error.h"
#include "job/describe.h"
#include "python/bindings.h"

namespace polycube::python {
namespace {

std::string labels_text(const py::dict& labels) {
  std::string text;
  for (const auto& [face, label] : labels) {
    const std::string key = py::str(face);
    text += (text.empty() ? "" : ",") + (py::isinstance<py::int_>(face) ? "Face" + key : key) + "=" + std::string(py::str(label));
  }
  return text;
}

/// Two directions, as sequences of three numbers each.
std::string frame_text(const py::handle& axes) {
  std::string text;
  for (const py::handle axis : axes) {
    std::string row;
    if (!py::isinstance<py::iterable>(axis)) return py::str(axes);
    for (const py::handle number : axis) row += (row.empty() ? "" : ",") + std::string(py::str(py::float_(py::reinterpret_borrow<py::object>(number))));
    text += (text.empty() ? "" : "/") + row;
  }
  return text;
}

/// Faces as names or numbers.
std::string faces_text(const py::iterable& faces) {
  std::string text;
  for (const py::handle face : faces)
    text += (text.empty() ? "" : ",") + std::string(py::isinstance<py::int_>(face) ? "Face" : "") + std::string(py::str(face));
  return text;
}

}  // namespace

MeshOptions options_from(const py::kwargs& given) {
  std::vector<std::pair<std::string, std::string>> texts;
  for (const auto& [key, value] : given) {
    if (value.is_none()) continue;
    const std::string name = py::str(key);
    if (name == "frame" && py::isinstance<py::iterable>(value) && !py::isinstance<py::str>(value)) {
      if (const std::string text = frame_text(value); !text.empty()) texts.emplace_back(name, text);
    } else if (name == "keep_faces" && py::isinstance<py::iterable>(value) && !py::isinstance<py::str>(value)) {
      texts.emplace_back(name, faces_text(py::reinterpret_borrow<py::iterable>(value)));
    } else if (!py::isinstance<py::dict>(value)) {
      texts.emplace_back(name, py::str(value));
    } else if (const std::string text = labels_text(py::reinterpret_borrow<py::dict>(value)); !text.empty()) {
      texts.emplace_back(name, text);
    }
  }
  return parse_options(texts);
}

void bind_options(py::module_& module) {
  module.def(
      "options", []() -> py::object { return py::module_::import("json").attr("loads")(describe_engine())["options"]; },
      "One dict per option of mesh() and labels(): name, unit, meaning, type, default, min, max, choices, advanced.");
}

}  // namespace polycube::python
