#include "core/demands.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <sstream>
#include <string_view>

#include "core/error.h"

namespace polycube {
namespace {

constexpr std::string_view kAxes = "XYZ";
// Ratio of the last cell to the first along an edge: beyond it is a slip of the pen.
constexpr double kSteepest = 1000;

template <class Number>
std::optional<Number> number(std::string_view text) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// The number of "Face3" where kind is "Face".
std::optional<int> entity(std::string_view text, std::string_view kind) {
  if (!text.starts_with(kind)) return std::nullopt;
  const auto id = number<int>(text.substr(kind.size()));
  return id && *id > 0 ? id : std::nullopt;
}

/// Throws InvalidInput for Face3=0,5: a comma ends an item.
void check_point(const std::string& flag, const std::string& dense) {
  const auto digit = [&](std::size_t i) { return i < dense.size() && dense[i] >= '0' && dense[i] <= '9'; };
  for (std::size_t comma = dense.find(','); comma != std::string::npos; comma = dense.find(',', comma + 1)) {
    if (comma == 0 || !digit(comma - 1) || !digit(comma + 1)) continue;
    const std::size_t start = dense.rfind('=', comma) + 1, end = std::min(dense.find(',', comma + 1), dense.size());
    throw InvalidInput(flag + ": '" + dense.substr(start, end - start) + "' has a comma where a point is wanted, as in 0.5");
  }
}

/// Calls read(left of '=', right of '=') for every item; false refuses it.
template <class Read>
void for_items(const std::string& flag, const std::string& text, const char* form, const Read& read) {
  std::string dense = text;
  std::erase(dense, ' ');
  check_point(flag, dense);
  std::istringstream items(dense);
  for (std::string item; std::getline(items, item, ',');) {
    const auto equals = item.find('=');
    const std::string_view all = item;
    if (equals == std::string::npos || !read(all.substr(0, equals), all.substr(equals + 1)))
      throw InvalidInput(std::string(flag).append(": '").append(item).append("' is not of the form ").append(form));
  }
}

std::string face_name(int id) { return "Face" + std::to_string(id); }
std::string solid_name(int id) { return "Solid" + std::to_string(id); }

std::string number_text(double value) {
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value).ptr;
  return {buffer, end};
}

}  // namespace

Divisions parse_divisions(const std::string& flag, const std::string& text) {
  Divisions result;
  for_items(flag, text, "Edge4=6, Face1-Face2=3.. or Solid2=3.. (3: exactly, 3..: at least, ..3: at most, 2..5: between)",
            [&](std::string_view what, std::string_view count) {
              Division d;
              if (const auto edge = entity(what, "Edge")) {
                d.edge = *edge;
              } else if (const auto solid = entity(what, "Solid")) {
                d.solid = *solid;
              } else {
                const auto dash = what.find('-');
                if (dash == std::string_view::npos) return false;
                const auto a = entity(what.substr(0, dash), "Face"), b = entity(what.substr(dash + 1), "Face");
                if (!a || !b) return false;
                d.faces = {std::min(*a, *b), std::max(*a, *b)};
              }
              const auto dots = count.find("..");
              const std::string_view low = count.substr(0, dots);
              if (dots == std::string_view::npos) {
                const auto exact = number<int>(count);
                if (!exact) return false;
                d.at_least = d.at_most = *exact;
              } else {
                const std::string_view high = count.substr(dots + 2);
                if (low.empty() && high.empty()) return false;
                const auto from = low.empty() ? std::optional<int>(1) : number<int>(low);
                const auto to = high.empty() ? std::optional<int>(Division::kNoMaximum) : number<int>(high);
                if (!from || !to) return false;
                d.at_least = *from;
                d.at_most = *to;
              }
              if (d.solid > 0 && d.at_most != Division::kNoMaximum)
                throw InvalidInput(flag + ": of the walls of a solid only the least number can be given, as " + std::string(what) + "=3..");
              if (d.at_least < 1) throw InvalidInput(flag + ": there must be 1 element at least, not " + std::string(count));
              if (d.at_most < d.at_least) throw InvalidInput(flag + ": " + std::string(what) + "=" + std::string(count) + " leaves no number");
              if (d.at_least > 1'000'000) throw InvalidInput(flag + ": " + std::to_string(d.at_least) + " elements are too many");
              result.push_back(d);
              return true;
            });
  return result;
}

LocalSizes parse_local_sizes(const std::string& flag, const std::string& text) {
  LocalSizes result;
  for_items(flag, text, "Face3=0.5, X=2 or Solid2=1.5", [&](std::string_view what, std::string_view value) {
    LocalSize s;
    if (const auto face = entity(what, "Face")) {
      s.face = *face;
    } else if (const auto solid = entity(what, "Solid")) {
      s.solid = *solid;
    } else if (what.size() == 1 && kAxes.find(what[0]) != std::string_view::npos) {
      s.axis = static_cast<int>(kAxes.find(what[0]));
    } else {
      return false;
    }
    const auto size = number<double>(value);
    if (!size || !std::isfinite(*size)) return false;
    if (!(*size > 0)) throw InvalidInput(flag + ": the size of " + std::string(what) + " must be greater than 0");
    s.size = *size;
    for (const LocalSize& other : result) {
      if (other.face == s.face && other.axis == s.axis && other.solid == s.solid) throw InvalidInput(flag + ": " + std::string(what) + " is given twice");
    }
    result.push_back(s);
    return true;
  });
  return result;
}

EdgeBiases parse_biases(const std::string& flag, const std::string& text) {
  EdgeBiases result;
  for_items(flag, text, "Edge4=2.0", [&](std::string_view what, std::string_view value) {
    const auto edge = entity(what, "Edge");
    const auto ratio = number<double>(value);
    if (!edge || !ratio || !std::isfinite(*ratio)) return false;
    if (!(*ratio >= 1 / kSteepest && *ratio <= kSteepest)) throw InvalidInput(flag + ": the ratio of " + std::string(what) + " must be from 0.001 to 1000");
    for (const EdgeBias& other : result) {
      if (other.edge == *edge) throw InvalidInput(flag + ": " + std::string(what) + " is given twice");
    }
    result.push_back({*edge, *ratio});
    return true;
  });
  return result;
}

LocalRefinements parse_refinements(const std::string& flag, const std::string& text) {
  LocalRefinements result;
  for_items(flag, text, "Face7=2, Edge3=1, Vertex2=1 or Solid1=1", [&](std::string_view what, std::string_view value) {
    LocalRefinement r;
    r.entity.dim = -1;
    for (const auto& [dim, kind] : {std::pair(0, "Vertex"), std::pair(1, "Edge"), std::pair(2, "Face"), std::pair(3, "Solid")}) {
      if (const auto id = entity(what, kind)) r.entity = {dim, *id};
    }
    const auto levels = number<int>(value);
    if (r.entity.dim < 0 || !levels) return false;
    if (*levels < 1 || *levels > LocalRefinement::kMostLevels)
      throw InvalidInput(flag + ": the levels of " + std::string(what) + " must be from 1 to " + std::to_string(LocalRefinement::kMostLevels) + ", not " +
                         std::string(value));
    r.levels = *levels;
    for (const LocalRefinement& other : result) {
      if (other.entity == r.entity) throw InvalidInput(flag + ": " + std::string(what) + " is given twice");
    }
    result.push_back(r);
    return true;
  });
  return result;
}

FaceList parse_faces(const std::string& flag, const std::string& text) {
  FaceList faces;
  std::string dense = text;
  std::erase(dense, ' ');
  std::istringstream items(dense);
  for (std::string item; std::getline(items, item, ',');) {
    const auto face = entity(item, "Face");
    if (!face) throw InvalidInput(std::string(flag).append(": '").append(item).append("' is not of the form Face3"));
    faces.push_back(*face);
  }
  std::sort(faces.begin(), faces.end());
  faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
  return faces;
}

std::string text_of(const Division& d) {
  const std::string what = d.edge > 0    ? "Edge" + std::to_string(d.edge)
                           : d.solid > 0 ? solid_name(d.solid)
                                         : face_name(d.faces[0]) + "-" + face_name(d.faces[1]);
  if (d.at_least == d.at_most) return what + "=" + std::to_string(d.at_least);
  if (d.at_most == Division::kNoMaximum) return what + "=" + std::to_string(d.at_least) + "..";
  return what + "=" + (d.at_least > 1 ? std::to_string(d.at_least) : "") + ".." + std::to_string(d.at_most);
}

std::string text_of(const LocalSize& s) {
  const std::string what = s.face > 0 ? face_name(s.face) : s.solid > 0 ? solid_name(s.solid) : std::string(1, kAxes[static_cast<std::size_t>(s.axis)]);
  return what + "=" + number_text(s.size);
}

std::string text_of(const EdgeBias& b) { return "Edge" + std::to_string(b.edge) + "=" + number_text(b.ratio); }

std::string text_of(const LocalRefinement& r) { return name(r.entity) + "=" + std::to_string(r.levels); }

}  // namespace polycube
