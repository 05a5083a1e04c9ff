#include "core/options.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <sstream>
#include <string_view>

#include "core/error.h"
#include "core/tuning.h"

namespace polycube {
namespace {

constexpr std::array<const char*, 6> kLabelNames{"+X", "-X", "+Y", "-Y", "+Z", "-Z"};
// Degrees: axes typed with four digits are as square as this.
constexpr double kSquare = 0.1;

std::string flag(const std::string& name) {
  if (name == "labels") return "--label";  // given once for every face
  std::string text = "--" + name;
  std::replace(text.begin(), text.end(), '_', '-');
  return text;
}

std::string number_text(double value) {
  // The shortest text that reads back as the same number.
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value).ptr;
  return {buffer, end};
}

template <typename T>
T parse_number(const OptionSpec& option, const std::string& text) {
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(static_cast<double>(value))) {
    if (error == std::errc::result_out_of_range) throw InvalidInput(flag(option.name) + ": '" + text + "' is out of range");
    const char* kind = std::is_same_v<T, int> ? "a whole number" : "a number";
    throw InvalidInput(flag(option.name) + ": '" + text + "' is not " + kind);
  }
  if (option.zero_is_unset && value == 0) throw InvalidInput(flag(option.name) + " must be greater than 0");
  return value;
}

bool parse_bool(const OptionSpec& option, std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (text == "true" || text == "1" || text == "yes") return true;
  if (text == "false" || text == "0" || text == "no") return false;
  throw InvalidInput(flag(option.name) + ": '" + text + "' is neither true nor false");
}

FaceLabels parse_labels(const OptionSpec& option, const std::string& text) {
  FaceLabels labels;
  std::istringstream items(text);
  for (std::string item; std::getline(items, item, ',');) {
    const auto fail = [&] { return InvalidInput(flag(option.name) + ": '" + item + "' is not of the form Face3=+X"); };
    const auto equals = item.find('=');
    if (item.rfind("Face", 0) != 0 || equals == std::string::npos) throw fail();
    int face = 0;
    const char* last = item.data() + equals;
    const auto [end, error] = std::from_chars(item.data() + 4, last, face);
    const auto label = std::find(kLabelNames.begin(), kLabelNames.end(), std::string_view(item).substr(equals + 1));
    if (error != std::errc() || end != last || face < 1 || label == kLabelNames.end()) throw fail();
    for (const auto& [other, unused] : labels)
      if (other == face) throw InvalidInput(flag(option.name) + ": Face" + std::to_string(face) + " is given twice");
    labels.emplace_back(face, static_cast<int>(label - kLabelNames.begin()));
  }
  std::sort(labels.begin(), labels.end());
  return labels;
}

FrameAxes parse_frame(const OptionSpec& option, const std::string& text) {
  FrameAxes axes;
  std::istringstream rows(text);
  for (std::string row; std::getline(rows, row, '/');) {
    Vec3 axis;
    const char *at = row.data(), *last = row.data() + row.size();
    for (int k = 0; k < 3; ++k) {
      if (k > 0 && (at == last || *at++ != ',')) at = nullptr;
      while (at && at != last && *at == ' ') ++at;
      if (at && at != last && *at == '+') ++at;
      const auto [end, error] = at ? std::from_chars(at, last, axis[k]) : std::from_chars_result{last, std::errc::invalid_argument};
      at = error == std::errc() ? end : nullptr;
      if (!at) break;
    }
    if (at != last) throw InvalidInput(flag(option.name) + ": '" + text + "' is not of the form 1,0,0/0,1,0 (the directions of X and Y)");
    axes.push_back(axis);
  }
  return axes;
}

void check_frame(const OptionSpec& option, const FrameAxes& axes) {
  if (axes.empty()) return;
  const std::string start = flag(option.name) + ": ";
  if (axes.size() != 2) throw InvalidInput(start + "two directions are needed, those of X and Y, not " + std::to_string(axes.size()));
  for (const Vec3& axis : axes) {
    if (!axis.allFinite()) throw InvalidInput(start + "a direction is not a number");
    if (!(axis.stableNorm() > 0)) throw InvalidInput(start + "a direction has no length");
  }
  const double angle = std::acos(std::clamp(axes[0].stableNormalized().dot(axes[1].stableNormalized()), -1.0, 1.0)) * 180 / std::numbers::pi;
  if (std::abs(angle - 90) > kSquare) {
    char text[96];
    std::snprintf(text, sizeof text, "X and Y must be at right angles, not %.4g degrees apart", angle);
    throw InvalidInput(start + text);
  }
}

const OptionSpec& find(const std::string& name) {
  for (const OptionSpec& option : option_table())
    if (option.name == name) return option;
  throw InvalidInput("there is no option '" + name + "'");
}

template <class... Ts>
struct Overloaded : Ts... {
  using Ts::operator()...;
};
template <class... Ts>
Overloaded(Ts...) -> Overloaded<Ts...>;

void set(MeshOptions& options, const OptionSpec& option, const std::string& text) {
  std::visit(Overloaded{
                 [&](double MeshOptions::*m) { options.*m = parse_number<double>(option, text); },
                 [&](int MeshOptions::*m) { options.*m = parse_number<int>(option, text); },
                 [&](bool MeshOptions::*m) { options.*m = parse_bool(option, text); },
                 [&](std::string MeshOptions::*m) { options.*m = text; },
                 [&](FaceLabels MeshOptions::*m) { options.*m = parse_labels(option, text); },
                 [&](FrameAxes MeshOptions::*m) { options.*m = parse_frame(option, text); },
                 [&](Divisions MeshOptions::*m) { options.*m = parse_divisions(flag(option.name), text); },
                 [&](LocalSizes MeshOptions::*m) { options.*m = parse_local_sizes(flag(option.name), text); },
                 [&](EdgeBiases MeshOptions::*m) { options.*m = parse_biases(flag(option.name), text); },
                 [&](FaceList MeshOptions::*m) { options.*m = parse_faces(flag(option.name), text); },
                 [&](LocalRefinements MeshOptions::*m) { options.*m = parse_refinements(flag(option.name), text); },
             },
             option.member);
}

void check_bounds(const OptionSpec& option, double value) {
  if (std::isnan(value)) throw InvalidInput(flag(option.name) + " is not a number");
  if (value < option.min) {
    const std::string bound = option.zero_is_unset ? "greater than 0" : "at least " + number_text(option.min);
    throw InvalidInput(flag(option.name) + " must be " + bound + ", not " + number_text(value));
  }
  if (value > option.max) throw InvalidInput(flag(option.name) + " must be at most " + number_text(option.max) + ", not " + number_text(value));
}

int order_of(const std::string& element_type) { return element_type.rfind("C3D20", 0) == 0 ? 2 : 1; }

}  // namespace

const std::vector<OptionSpec>& option_table() {
  static const std::vector<OptionSpec> table{
      {.name = "size",
       .unit = "mm",
       .meaning = "Edge length of the hexahedra. Default: by the part, near to bounding-box diagonal / 20.",
       .member = &MeshOptions::size,
       .max = 1e12,
       .zero_is_unset = true},
      {.name = "hexes",
       .unit = "",
       .meaning = "Number of hexahedra to come near to, instead of a size.",
       .member = &MeshOptions::hexes,
       .max = kMostHexes,
       .zero_is_unset = true},
      {.name = "coarsest", .unit = "", .meaning = "The fewest hexahedra that keep the part's shape, instead of a size.", .member = &MeshOptions::coarsest},
      {.name = "order",
       .unit = "",
       .meaning = "Element order: 1 (8 nodes) or 2 (20 nodes, mid-edge nodes on the CAD).",
       .member = &MeshOptions::order,
       .min = 1,
       .max = 2,
       .choices = {"1", "2"}},
      {.name = "element_type",
       .unit = "",
       .meaning = "Element of .inp files. Default: C3D8 or C3D20 by order.",
       .member = &MeshOptions::element_type,
       .choices = {"C3D8", "C3D8I", "C3D8R", "C3D20", "C3D20R"}},
      {.name = "effort",
       .unit = "",
       .meaning = "How many ways are tried where the first gives no good mesh: bounds the work, not the clock.",
       .member = &MeshOptions::effort,
       .choices = {"quick", "normal", "thorough"}},
      {.name = "time_limit",
       .unit = "s",
       .meaning = "Stop after this time, with the best mesh so far if there is one. Default: no limit.",
       .member = &MeshOptions::time_limit,
       .max = 1e9,
       .zero_is_unset = true},
      {.name = "sew",
       .unit = "",
       .meaning = "Take faces without a solid for one if they sew to it within the file's own tolerance.",
       .member = &MeshOptions::sew,
       .advanced = true},
      {.name = "labels", .unit = "", .meaning = "Axes of CAD faces set by hand, such as Face3=+X,Face7=-Z.", .member = &MeshOptions::labels},
      {.name = "frame",
       .unit = "",
       .meaning = "Directions of the labels' X and Y in the part's coordinates, such as 1,0,0/0,1,0. Default: found from the part.",
       .member = &MeshOptions::frame},
      {.name = "min_layers",
       .unit = "",
       .meaning = "Elements through every wall at least. Default: 2 of second order, 3 of first.",
       .member = &MeshOptions::min_layers,
       .max = 1000,
       .zero_is_unset = true},
      {.name = "per_circle",
       .unit = "",
       .meaning = "Elements round every full circle at least, arcs in proportion. 0: as the size has it.",
       .member = &MeshOptions::per_circle,
       .max = 1000},
      {.name = "max_size",
       .unit = "mm",
       .meaning = "Edge length that no hexahedron is to exceed. Default: bounding-box diagonal / 15 where no size is given.",
       .member = &MeshOptions::max_size,
       .max = 1e12,
       .zero_is_unset = true},
      {.name = "growth",
       .unit = "",
       .meaning = "Ratio of the lengths of neighbouring hexahedra, at most, where they grow away from small ones. 1: evenly spaced in every block.",
       .member = &MeshOptions::growth,
       .min = 1,
       .max = 100},
      {.name = "divisions",
       .unit = "",
       .meaning = "Elements along CAD edges and between opposite CAD faces, such as Edge4=6,Face1-Face2=3.. (at least), ..4 (at most), 2..5; at least through "
                  "the walls of a solid: Solid2=3..",
       .member = &MeshOptions::divisions},
      {.name = "sizes",
       .unit = "mm",
       .meaning = "Other edge lengths at CAD faces, along the labels' axes and of solids, such as Face3=0.5,X=2,Solid2=1.5.",
       .member = &MeshOptions::sizes},
      {.name = "bias",
       .unit = "",
       .meaning = "Length of the last hexahedron along a CAD edge over that of the first, such as Edge4=2.0; from its start to its end.",
       .member = &MeshOptions::bias},
      {.name = "refine",
       .unit = "",
       .meaning = "Times that the hexahedra at a CAD face, edge or vertex, and no others, are divided into three along every edge, such as Face7=2,Edge3=1.",
       .member = &MeshOptions::refine},
      {.name = "interfaces",
       .unit = "",
       .meaning = "Where solids touch: one mesh with common nodes (conform), or a mesh of each with nodes of its own, for ties and contact (separate).",
       .member = &MeshOptions::interfaces,
       .choices = {"conform", "separate"}},
      {.name = "feature_angle",
       .unit = "degrees",
       .meaning = "CAD edges that bend less than this are ignored: the faces on both sides share their mesh faces. 0: none.",
       .member = &MeshOptions::feature_angle,
       .max = 180,
       .advanced = true},
      {.name = "keep_faces",
       .unit = "",
       .meaning = "CAD faces none of whose edges is ignored, such as Face3,Face7. FreeCAD adds those that carry constraints.",
       .member = &MeshOptions::keep_faces,
       .advanced = true},
      {.name = "threads",
       .unit = "",
       .meaning = "Threads to use; the mesh does not depend on it. 0: all cores.",
       .member = &MeshOptions::threads,
       .max = 1024,
       .advanced = true},
      {.name = "fidelity",
       .unit = "",
       .meaning = "Weight of labels that agree with the surface normal.",
       .member = &MeshOptions::fidelity,
       .max = 1000,
       .advanced = true},
      {.name = "compactness",
       .unit = "",
       .meaning = "Weight of short borders between labels.",
       .member = &MeshOptions::compactness,
       .max = 1000,
       .advanced = true},
  };
  return table;
}

std::string option_type(const OptionSpec& option) {
  static constexpr std::array<const char*, 11> kTypes{"double", "int", "bool", "string", "labels", "frame", "divisions", "sizes", "bias", "faces", "refine"};
  return kTypes[option.member.index()];
}

MeshOptions parse_options(const std::vector<std::pair<std::string, std::string>>& given) {
  MeshOptions options;
  bool order_given = false;
  for (const auto& [name, text] : given) {
    set(options, find(name), text);
    order_given |= name == "order";
  }
  if (!order_given && !options.element_type.empty()) options.order = order_of(options.element_type);
  check(options);
  return options;
}

namespace {

template <class Items>
std::string joined(const Items& items) {
  std::string text;
  for (const auto& item : items) text += (text.empty() ? "" : ",") + text_of(item);
  return text;
}

}  // namespace

std::string option_text(const MeshOptions& options, const OptionSpec& option) {
  return std::visit(Overloaded{
                        [&](double MeshOptions::*m) { return number_text(options.*m); },
                        [&](int MeshOptions::*m) { return std::to_string(options.*m); },
                        [&](bool MeshOptions::*m) { return std::string(options.*m ? "true" : "false"); },
                        [&](std::string MeshOptions::*m) { return options.*m; },
                        [&](FaceLabels MeshOptions::*m) {
                          std::string text;
                          for (const auto& [face, label] : options.*m)
                            text += (text.empty() ? "Face" : ",Face") + std::to_string(face) + "=" + kLabelNames.at(label);
                          return text;
                        },
                        [&](FrameAxes MeshOptions::*m) {
                          std::string text;
                          for (const Vec3& axis : options.*m)
                            text += (text.empty() ? "" : "/") + number_text(axis[0]) + "," + number_text(axis[1]) + "," + number_text(axis[2]);
                          return text;
                        },
                        [&](Divisions MeshOptions::*m) { return joined(options.*m); },
                        [&](LocalSizes MeshOptions::*m) { return joined(options.*m); },
                        [&](EdgeBiases MeshOptions::*m) { return joined(options.*m); },
                        [&](FaceList MeshOptions::*m) {
                          std::string text;
                          for (int face : options.*m) text += (text.empty() ? "Face" : ",Face") + std::to_string(face);
                          return text;
                        },
                        [&](LocalRefinements MeshOptions::*m) { return joined(options.*m); },
                    },
                    option.member);
}

void check(const MeshOptions& options) {
  for (const OptionSpec& option : option_table()) {
    if (const auto* m = std::get_if<double MeshOptions::*>(&option.member)) check_bounds(option, options.*(*m));
    if (const auto* m = std::get_if<int MeshOptions::*>(&option.member)) check_bounds(option, options.*(*m));
    if (const auto* m = std::get_if<FrameAxes MeshOptions::*>(&option.member)) check_frame(option, options.*(*m));
    if (const auto* m = std::get_if<std::string MeshOptions::*>(&option.member)) {
      const std::string& word = options.*(*m);
      if (word.empty() || std::find(option.choices.begin(), option.choices.end(), word) != option.choices.end()) continue;
      std::string all;
      for (const std::string& choice : option.choices) all += (all.empty() ? "" : ", ") + choice;
      throw InvalidInput(flag(option.name).append(": '").append(word).append("' is not one of ").append(all));
    }
  }
  if ((options.size > 0) + (options.hexes > 0) + options.coarsest > 1) throw InvalidInput("give only one of --size, --hexes and --coarsest");
  if (options.coarsest && !options.sizes.empty()) throw InvalidInput("--coarsest leaves no room for --sizes");
  if (options.coarsest && options.max_size > 0) throw InvalidInput("--coarsest leaves no room for --max-size");
  if (!options.element_type.empty() && order_of(options.element_type) != options.order)
    throw InvalidInput("--element-type " + options.element_type + " is of order " + std::to_string(order_of(options.element_type)) + ", but --order " +
                       std::to_string(options.order) + " is asked for");
}

void check(const MeshOptions& options, double diagonal, const PartNumbers& part) {
  check(options);
  if (options.size > diagonal) {
    char text[160];
    std::snprintf(text, sizeof text, "--size %g mm is larger than the part (bounding-box diagonal %g mm)", options.size, diagonal);
    throw InvalidInput(text);
  }
  const auto check_entity = [](const char* option, const std::string& kind, int id, const std::vector<int>& numbers) {
    if (id == 0 || std::binary_search(numbers.begin(), numbers.end(), id)) return;
    const std::string start = std::string(option) + ": " + kind + std::to_string(id);
    if (!numbers.empty() && id < numbers.back()) throw InvalidInput(start + " does not belong to the solid");
    throw InvalidInput(start + " does not exist, the part has " + std::to_string(numbers.size()) +
                       (kind == "Face"   ? " faces"
                        : kind == "Edge" ? " edges"
                                         : " vertices"));
  };
  const auto check_solid = [&](const char* option, int id) {
    if (id > part.solids)
      throw InvalidInput(std::string(option) + ": Solid" + std::to_string(id) + " does not exist, the part has " + std::to_string(part.solids) +
                         (part.solids == 1 ? " solid" : " solids"));
  };
  for (const auto& [face, label] : options.labels) check_entity("--label", "Face", face, part.faces);
  for (const Division& d : options.divisions) {
    check_entity("--divisions", "Edge", d.edge, part.edges);
    for (int face : d.faces) check_entity("--divisions", "Face", face, part.faces);
    check_solid("--divisions", d.solid);
  }
  for (const LocalSize& s : options.sizes) {
    check_entity("--sizes", "Face", s.face, part.faces);
    check_solid("--sizes", s.solid);
  }
  for (const EdgeBias& b : options.bias) check_entity("--bias", "Edge", b.edge, part.edges);
  for (const LocalRefinement& r : options.refine) {
    if (r.entity.dim == 3) {
      check_solid("--refine", r.entity.id);
    } else {
      const std::array kinds{std::pair("Vertex", &part.vertices), std::pair("Edge", &part.edges), std::pair("Face", &part.faces)};
      const auto& [kind, numbers] = kinds[static_cast<std::size_t>(r.entity.dim)];
      check_entity("--refine", kind, r.entity.id, *numbers);
    }
  }
  for (int face : options.keep_faces) check_entity("--keep-faces", "Face", face, part.faces);
}

void check_count(double hexes) {
  if (!(hexes > kMostHexes)) return;
  char text[96];
  std::snprintf(text, sizeof text, "that would make about %.2g hexahedra, more than the %d that are possible", hexes, kMostHexes);
  throw InvalidInput(text);
}

const char* label_name(int label) { return kLabelNames.at(label); }

Mat3 frame_of(const FrameAxes& axes) {
  Mat3 frame;
  frame.row(0) = axes.at(0).stableNormalized();
  const Vec3 x = frame.row(0), y = axes.at(1).stableNormalized();
  frame.row(1) = (y - y.dot(x) * x).normalized();
  frame.row(2) = frame.row(0).cross(frame.row(1));
  return frame;
}

double effective_size(const MeshOptions& options, double diagonal) {
  if (options.size > 0) return options.size;
  const double longest = std::min(diagonal / kCoreTuning.longest_per_diagonal, options.max_size > 0 ? options.max_size : diagonal);
  return longest * kCoreTuning.longest_per_diagonal / kCoreTuning.sizes_per_diagonal;
}

double effective_max_size(const MeshOptions& options, double diagonal) {
  if (options.max_size > 0) return options.max_size;
  const bool automatic = options.size == 0 && options.hexes == 0 && !options.coarsest;
  return automatic ? diagonal / kCoreTuning.longest_per_diagonal : std::numeric_limits<double>::infinity();
}

int effective_min_layers(const MeshOptions& options) {
  if (options.min_layers > 0) return options.min_layers;
  return options.coarsest ? 1 : options.order == 2 ? kCoreTuning.layers_of_second_order : kCoreTuning.layers_of_first_order;
}

int effective_per_circle(const MeshOptions& options) { return options.coarsest ? 0 : options.per_circle; }

std::string effective_element_type(const MeshOptions& options) {
  if (!options.element_type.empty()) return options.element_type;
  return options.order == 2 ? "C3D20" : "C3D8";
}

}  // namespace polycube
