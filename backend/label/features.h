// Feature charts: CAD edges that lie inside charts get an axis of their own, so that the grid follows them.
#pragma once

#include "label/label.h"

namespace polycube {

enum class EdgeCapture {
  kBoundary,  ///< runs along chart boundaries
  kFeature,   ///< runs along chart boundaries and feature charts
  kLost       ///< cannot, see reason
};

inline constexpr std::array<const char*, 3> kCaptureNames{"boundary", "feature", "lost"};

struct FeatureEdge {
  int edge = 0;  ///< CAD edge
  EdgeCapture capture = EdgeCapture::kBoundary;
  std::string reason;  ///< of kLost
};

struct FeatureChart {
  int edge = 0;  ///< CAD edge
  Chart chart;   ///< sign 0; axis and nodes filled
};

struct Features {
  std::vector<FeatureChart> charts;
  std::vector<FeatureEdge> edges;  ///< one per CAD edge that is neither seam nor degenerate
};

/// The mesh points along a CAD edge from its start to its end vertex, ordered; empty where the mesh has no segments there. First and last are the
/// same of a closed edge, and of one that a tiny edge closes.
std::vector<std::vector<int>> edge_chains(const CadModel& model, const TetMesh& mesh);

/// How far the faces beside a CAD edge are from smooth at most, radians.
double bend(const CadEdge& edge);

/// Per CAD edge number whether it bends less than `angle` (radians) everywhere and is on none of the faces to keep.
std::vector<char> smooth_edges(const CadModel& model, double angle, const std::vector<int>& keep_faces = {});

/// `left_out`: per CAD edge number, those that get no feature chart.
Features find_features(const CadModel& model, const TetMesh& mesh, const Labelling& labelling, const std::vector<char>& left_out, const Monitor& monitor);

}  // namespace polycube
