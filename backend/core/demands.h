// What an engineer asks of single edges, walls, regions and directions.
#pragma once

#include <array>
#include <limits>
#include <string>
#include <vector>

#include "core/types.h"

namespace polycube {

/// How many elements along a CAD edge, between two CAD faces opposite each other, or at least through every wall of a solid.
struct Division {
  static constexpr int kNoMaximum = std::numeric_limits<int>::max();
  int edge = 0;                ///< CAD edge, or 0
  std::array<int, 2> faces{};  ///< CAD faces, ascending, where edge is 0
  int at_least = 1, at_most = kNoMaximum;
  int solid = 0;  ///< number of the solid where edge and faces are 0
  friend bool operator==(const Division&, const Division&) = default;
};

/// Another edge length of the hexahedra.
struct LocalSize {
  int face = 0;     ///< the blocks on this CAD face, or 0
  int axis = 0;     ///< along the frame's axis 0, 1, 2 = X, Y, Z where face and solid are 0
  double size = 0;  ///< mm
  int solid = 0;    ///< of all of this solid, or 0
  friend bool operator==(const LocalSize&, const LocalSize&) = default;
};

/// Cells along a CAD edge that grow from its start to its end.
struct EdgeBias {
  int edge = 0;
  double ratio = 1;  ///< of the last cell's length to the first's
  friend bool operator==(const EdgeBias&, const EdgeBias&) = default;
};

/// Cells at a CAD entity divided 1:3 along every edge, several times.
struct LocalRefinement {
  static constexpr int kMostLevels = 6;  ///< edges a 729th as long: beyond it is a slip of the pen
  CadRef entity;
  int levels = 1;
  friend bool operator==(const LocalRefinement&, const LocalRefinement&) = default;
};

/// CAD faces, ascending, each once.
using FaceList = std::vector<int>;
using Divisions = std::vector<Division>;
using LocalSizes = std::vector<LocalSize>;
using EdgeBiases = std::vector<EdgeBias>;
using LocalRefinements = std::vector<LocalRefinement>;

/// From text such as "Edge4=6,Face1-Face2=3..,Face3-Face5=..4,Edge7=2..5,Solid2=3..": exactly, at least, at most, between; of a solid's walls at least only.
/// Throws InvalidInput that starts with `flag`.
Divisions parse_divisions(const std::string& flag, const std::string& text);
/// From text such as "Face3=0.5,X=2,Solid2=1.5".
LocalSizes parse_local_sizes(const std::string& flag, const std::string& text);

/// From text such as "Edge4=2.0,Edge7=0.5".
EdgeBiases parse_biases(const std::string& flag, const std::string& text);

/// From text such as "Face7=2,Edge3=1,Vertex2=1,Solid1=1".
LocalRefinements parse_refinements(const std::string& flag, const std::string& text);

/// From text such as "Face3,Face7".
FaceList parse_faces(const std::string& flag, const std::string& text);

/// Text that is read back as the same.
std::string text_of(const Division& division);
std::string text_of(const LocalSize& size);
std::string text_of(const EdgeBias& bias);
std::string text_of(const LocalRefinement& refinement);

}  // namespace polycube
