#include "cad/assembly.h"

#include <BRepExtrema_DistShapeShape.hxx>
#include <BRepGProp.hxx>
#include <GProp_GProps.hxx>
#include <Precision.hxx>
#include <Standard_Failure.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <algorithm>
#include <map>
#include <numeric>
#include <set>

#include "cad/fuse.h"
#include "cad/occt.h"
#include "cad/shape.h"
#include "cad/tuning.h"
#include "core/error.h"

namespace polycube {
namespace {

std::string number_text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

double area_of(const TopoDS_Shape& face) {
  GProp_GProps properties;
  BRepGProp::SurfaceProperties(face, properties);
  return properties.Mass();
}

double volume_of(const TopoDS_Shape& solid) {
  GProp_GProps properties;
  BRepGProp::VolumeProperties(solid, properties);
  return properties.Mass();
}

void refuse_overlaps(const Assembly& assembly, GeneralFuse& fuse) {
  TopTools_IndexedMapOfShape pieces;
  std::vector<int> owner;
  for (int s = 0; s < static_cast<int>(assembly.solids.size()); ++s) {
    for (const TopoDS_Shape& piece : fuse.images(solid_in(assembly.solids[s].shape().shape))) {
      const int at = pieces.Add(piece);
      if (at > static_cast<int>(owner.size())) {
        owner.push_back(s);
        continue;
      }
      const int other = owner[static_cast<std::size_t>(at) - 1];
      const double common = volume_of(piece);
      if (common > kCadTuning.overlap * std::min(assembly.solids[s].volume(), assembly.solids[other].volume()))
        throw InvalidInput(assembly.name(other + 1) + " and " + assembly.name(s + 1) + " overlap: they have " + number_text(common) + " mm^3 in common");
    }
  }
}

std::vector<Interface> find_interfaces(const std::vector<CadModel>& solids, GeneralFuse& fuse) {
  TopTools_IndexedMapOfShape pieces;
  std::vector<std::vector<std::array<int, 2>>> uses;  // per piece: solid and CAD face
  for (int s = 0; s < static_cast<int>(solids.size()); ++s) {
    for (const int f : solids[s].faces()) {
      for (const TopoDS_Shape& piece : fuse.images(solids[s].shape().face(f).face)) {
        const auto at = static_cast<std::size_t>(pieces.Add(piece));
        uses.resize(std::max(uses.size(), at));
        uses[at - 1].push_back({s + 1, f});
      }
    }
  }
  std::map<std::array<int, 2>, Interface> found;
  for (std::size_t p = 0; p < uses.size(); ++p) {
    for (std::size_t i = 0; i < uses[p].size(); ++i) {
      for (std::size_t k = i + 1; k < uses[p].size(); ++k) {
        const auto& [a, face_a] = uses[p][i];
        const auto& [b, face_b] = uses[p][k];
        if (a == b) continue;
        Interface& interface = found[{a, b}];
        interface.solids = {a, b};
        interface.faces[0].push_back(face_a);
        interface.faces[1].push_back(face_b);
        interface.area += area_of(pieces(static_cast<int>(p) + 1));
      }
    }
  }
  std::vector<Interface> result;
  for (auto& [pair, interface] : found) {
    for (std::vector<int>& faces : interface.faces) {
      std::sort(faces.begin(), faces.end());
      faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
    }
    result.push_back(std::move(interface));
  }
  return result;
}

/// Per solid, the least of those that it hangs together with by interfaces.
std::vector<int> parts_by_interfaces(const Assembly& assembly) {
  std::vector<int> part(assembly.solids.size() + 1);
  std::iota(part.begin(), part.end(), 0);
  for (const Interface& interface : assembly.interfaces) {
    const int a = part[static_cast<std::size_t>(interface.solids[0])], b = part[static_cast<std::size_t>(interface.solids[1])];
    std::replace(part.begin(), part.end(), std::max(a, b), std::min(a, b));
  }
  return part;
}

constexpr const char* kNothingPasses = " alone: they have no nodes in common, and no load passes from one to the other";

/// Warns of solids that meet in edges or vertices and hang together by no interfaces: nothing passes from one to the other. Returns their pairs.
std::set<std::array<int, 2>> tell_bare_contacts(Assembly& assembly, GeneralFuse& fuse) {
  std::map<std::array<int, 2>, CadRef> found;  // the first edge, or else vertex, of the pair
  for (const int dim : {1, 0}) {
    TopTools_IndexedMapOfShape pieces;
    std::vector<std::vector<std::pair<int, CadRef>>> uses;  // per piece: solid and CAD entity
    for (int s = 0; s < static_cast<int>(assembly.solids.size()); ++s) {
      const CadModel::Shape& shape = assembly.solids[s].shape();
      TopTools_IndexedMapOfShape own;
      TopExp::MapShapes(shape.shape, kKinds[static_cast<std::size_t>(dim)], own);
      for (int i = 1; i <= own.Extent(); ++i) {
        for (const TopoDS_Shape& piece : fuse.images(own(i))) {
          const auto at = static_cast<std::size_t>(pieces.Add(piece));
          uses.resize(std::max(uses.size(), at));
          uses[at - 1].emplace_back(s + 1, CadRef{dim, shape.numbers[static_cast<std::size_t>(dim)][static_cast<std::size_t>(i) - 1]});
        }
      }
    }
    for (const auto& same : uses)
      for (const auto& [a, entity] : same)
        for (const auto& [b, unused] : same)
          if (a < b) found.try_emplace({a, b}, entity);
  }
  const std::vector<int> part = parts_by_interfaces(assembly);
  std::set<std::array<int, 2>> pairs;
  for (const auto& [pair, entity] : found) {
    pairs.insert(pair);
    if (part[static_cast<std::size_t>(pair[0])] == part[static_cast<std::size_t>(pair[1])]) continue;
    assembly.warnings.push_back(assembly.name(pair[0]) + " and " + assembly.name(pair[1]) + " meet in " + name(entity) + kNothingPasses);
  }
  return pairs;
}

/// Whether the box of a solid comes near that of another at all.
bool may_touch(const std::vector<CadModel>& solids) {
  for (std::size_t a = 0; a < solids.size(); ++a)
    for (std::size_t b = a + 1; b < solids.size(); ++b) {
      const double reach = 1e-6 * std::max(solids[a].diagonal(), solids[b].diagonal());
      if (solids[a].shape().box.exteriorDistance(solids[b].shape().box) <= reach) return true;
    }
  return false;
}

/// Returns the pairs that meet in edges or vertices.
std::set<std::array<int, 2>> find_touching(Assembly& assembly, const Monitor& monitor) {
  std::set<std::array<int, 2>> meeting;
  if (!may_touch(assembly.solids)) return meeting;
  try {
    catching_faults([&] {
      GeneralFuse fuse(assembly.solids, monitor);
      refuse_overlaps(assembly, fuse);
      assembly.interfaces = find_interfaces(assembly.solids, fuse);
      meeting = tell_bare_contacts(assembly, fuse);
    });
  } catch (const Standard_Failure& failure) {
    monitor.check();
    throw InvalidInput("OpenCASCADE cannot tell where the solids touch: " + reason_of(failure));
  }
  return meeting;
}

/// How thick the smallest box along the axes is that both boxes reach over; negative where they are apart.
double common_thickness(const Eigen::AlignedBox3d& a, const Eigen::AlignedBox3d& b) {
  return (a.max().cwiseMin(b.max()) - a.min().cwiseMax(b.min())).minCoeff();
}

/// Solids beside each other that all but touch get no common nodes, which is seldom what is wanted; nor do those that are tangent, of which `meeting` has none.
void tell_gaps(Assembly& assembly, const std::set<std::array<int, 2>>& meeting, const Monitor& monitor) {
  const std::vector<int> part = parts_by_interfaces(assembly);
  for (std::size_t a = 0; a < assembly.solids.size(); ++a) {
    for (std::size_t b = a + 1; b < assembly.solids.size(); ++b) {
      const CadModel &one = assembly.solids[a], &other = assembly.solids[b];
      const double reach = kCadTuning.gap * std::min(one.diagonal(), other.diagonal());
      const std::array pair{static_cast<int>(a) + 1, static_cast<int>(b) + 1};
      const auto is_pair = [&](const Interface& i) { return i.solids == pair; };
      if (std::abs(common_thickness(one.shape().box, other.shape().box)) > reach) continue;
      if (std::any_of(assembly.interfaces.begin(), assembly.interfaces.end(), is_pair)) continue;
      monitor.check();
      double gap = -1;
      try {
        catching_faults([&] {
          const BRepExtrema_DistShapeShape distance(one.shape().shape, other.shape().shape);
          if (distance.IsDone()) gap = distance.Value();
        });
      } catch (const Standard_Failure&) {
        monitor.check();  // what OpenCASCADE cannot measure is not told
      }
      if (gap > Precision::Confusion() && gap <= reach)
        assembly.warnings.push_back(assembly.name(pair[0]) + " and " + assembly.name(pair[1]) + " do not touch: they are " + number_text(gap) +
                                    " mm apart, and have no common nodes");
      if (gap >= 0 && gap <= Precision::Confusion() && !meeting.contains(pair) && part[a + 1] != part[b + 1])
        assembly.warnings.push_back(assembly.name(pair[0]) + " and " + assembly.name(pair[1]) + " touch in a line or a point" + kNothingPasses);
    }
  }
}

std::vector<int> all_numbers(const std::vector<CadModel>& solids, const std::vector<int>& (CadModel::*numbers)() const) {
  std::set<int> all;
  for (const CadModel& solid : solids) all.insert((solid.*numbers)().begin(), (solid.*numbers)().end());
  return {all.begin(), all.end()};
}

}  // namespace

Assembly Assembly::of(const FileShape& read, const ReadOptions& options, const Monitor& monitor) {
  const FoundSolids found = find_solids(read, options.sew, monitor);
  Assembly assembly;
  const bool one = found.solids.size() == 1;
  for (const FoundSolid& solid : found.solids) {
    std::string& label = assembly.labels.emplace_back();
    for (const auto& [shape, text] : read.labels)
      if (shape.IsSame(solid_in(solid.solid))) label = text;
    const int number = static_cast<int>(assembly.labels.size());
    if (label.empty() && options.labels.size() == found.solids.size()) label = options.labels[static_cast<std::size_t>(number) - 1];
    try {
      assembly.solids.push_back(CadModel(described(solid, one ? read.warnings : std::vector<std::string>(), monitor)));
    } catch (const InvalidInput& error) {
      throw one ? error : InvalidInput(assembly.name(number) + ": " + error.what());
    }
  }
  if (one) return assembly;
  assembly.warnings = read.warnings;
  assembly.warnings.insert(assembly.warnings.end(), found.warnings.begin(), found.warnings.end());
  const std::set<std::array<int, 2>> meeting = find_touching(assembly, monitor);
  tell_gaps(assembly, meeting, monitor);
  return assembly;
}

Assembly Assembly::read(const std::string& path, const ReadOptions& options, const Monitor& monitor) {
  const FileShape shape = read_shape(path, options, monitor);
  try {
    return of(shape, options, monitor);
  } catch (const InvalidInput& error) {
    throw InvalidInput(path + ": " + error.what());
  }
}

Assembly Assembly::from_brep(const std::string& text, const ReadOptions& options, const Monitor& monitor) {
  return of(parse_brep(text, monitor), options, monitor);
}

std::string Assembly::name(int solid) const {
  const std::string& label = labels.at(static_cast<std::size_t>(solid) - 1);
  return polycube::name({3, solid}) + (label.empty() ? "" : " \"" + label + "\"");
}

double Assembly::diagonal() const {
  Eigen::AlignedBox3d box;
  for (const CadModel& solid : solids) box.extend(solid.shape().box);
  return box.diagonal().norm();
}

double Assembly::volume() const {
  double sum = 0;
  for (const CadModel& solid : solids) sum += solid.volume();
  return sum;
}

std::vector<int> Assembly::faces() const { return all_numbers(solids, &CadModel::faces); }
std::vector<std::string> Assembly::all_warnings() const {
  std::vector<std::string> all = warnings;
  for (const CadModel& solid : solids) all.insert(all.end(), solid.warnings().begin(), solid.warnings().end());
  return all;
}

std::vector<int> Assembly::edges() const { return all_numbers(solids, &CadModel::edges); }
std::vector<int> Assembly::vertices() const { return all_numbers(solids, &CadModel::vertices); }

}  // namespace polycube
