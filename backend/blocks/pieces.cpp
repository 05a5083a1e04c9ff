#include "blocks/pieces.h"

#include <algorithm>

namespace polycube {

Pieces::Pieces(const TetMesh& mesh, const PolycuboidMap& map, const TetTopology& topology, const SheetCuts& cuts)
    : mesh_(mesh), topology_(topology), cuts_(cuts), chart_of_triangle_(mesh.triangles.size(), -1) {
  for (int c = 0; c < static_cast<int>(map.charts.size()); ++c) {
    for (int t : map.charts[c].triangles) chart_of_triangle_[t] = c;
  }
  axis_.reserve(map.charts.size());
  for (const Chart& chart : map.charts) axis_.push_back(chart.axis);
}

void Pieces::run(const Monitor& monitor) {
  const int tet_count = static_cast<int>(mesh_.tets.size());
  offset.assign(tet_count + 1, 0);
  for (int t = 0; t < tet_count; ++t) {
    const auto n = counts(t);
    offset[t + 1] = offset[t] + (n[0] + 1) * (n[1] + 1) * (n[2] + 1);
  }
  volume_.assign(offset.back(), 0);
  used_.assign(offset.back(), 0);
  UnionFind sets(offset.back());
  sets_ = &sets;
  for (int t = 0; t < tet_count; ++t) {
    if (t % 4096 == 0) monitor.progress("blocks", 0.1 + 0.7 * t / tet_count);
    cut_tet(t);
  }
  component.assign(offset.back(), -1);
  for (int p = 0; p < offset.back(); ++p) {
    if (!used_[p]) continue;
    const int root = sets.find(p);
    if (component[root] < 0) {
      component[root] = static_cast<int>(volume.size());
      volume.push_back(0);
    }
    component[p] = component[root];
    volume[component[p]] += volume_[p];
  }
  for (Flux& f : fluxes) {
    f.low = component[f.low];
    f.high = component[f.high];
  }
  const auto key = [](const Flux& f) { return std::array{f.low, f.high, f.axis, f.plane, f.sheet}; };
  std::stable_sort(fluxes.begin(), fluxes.end(), [&](const Flux& a, const Flux& b) { return key(a) < key(b); });
  std::size_t kept = 0;
  for (const Flux& f : fluxes) {
    if (kept > 0 && key(fluxes[kept - 1]) == key(f)) {
      fluxes[kept - 1].area += f.area;
    } else {
      fluxes[kept++] = f;
    }
  }
  fluxes.resize(kept);
  for (ChartArea& a : chart_areas) a.component = component[a.component];
}

std::array<int, 3> Pieces::counts(int t) const {
  std::array<int, 3> n{};
  for (int i = cuts_.first[t]; i < cuts_.first[t + 1]; ++i) ++n[cuts_.cuts[i].axis];
  return n;
}

void Pieces::cut_tet(int t) {
  const Tet& tet = mesh_.tets[t];
  clipper_.load({cuts_.image[tet[0]], cuts_.image[tet[1]], cuts_.image[tet[2]], cuts_.image[tet[3]]});
  begin_[0] = cuts_.first[t];
  const auto n = counts(t);
  for (int d = 0; d < 3; ++d) begin_[d + 1] = begin_[d] + n[d];
  slice(t, 0, clipper_.whole(), {});
}

void Pieces::slice(int t, int axis, const Polyhedron& in, std::array<int, 3> at) {
  if (axis == 3) return emit(t, in, at);
  if (begin_[axis] == begin_[axis + 1]) return slice(t, axis + 1, in, at);
  auto& [rest, below, above] = buffers_[axis];
  rest = in;
  for (int i = begin_[axis]; i < begin_[axis + 1] && !rest.tags.empty(); ++i, ++at[axis]) {
    clipper_.split(rest, axis, cuts_.planes[axis][cuts_.cuts[i].plane], below, above);
    if (!below.tags.empty()) slice(t, axis + 1, below, at);
    std::swap(rest, above);
  }
  if (!rest.tags.empty()) slice(t, axis + 1, rest, at);
}

int Pieces::piece(int t, const std::array<int, 3>& at) const {
  return offset[t] + (at[0] * (begin_[2] - begin_[1] + 1) + at[1]) * (begin_[3] - begin_[2] + 1) + at[2];
}

void Pieces::emit(int t, const Polyhedron& p, const std::array<int, 3>& at) {
  const int self = piece(t, at);
  used_[self] = 1;
  volume_[self] = clipper_.volume6(p) / 6;
  for (int f = 0; f < static_cast<int>(p.tags.size()); ++f) {
    const int tag = p.tags[f];
    if (tag >= 4) {
      if (tag % 2 == 0) continue;  // a cut is booked once, from below
      const int axis = (tag - 4) / 2;
      auto above = at;
      ++above[axis];
      const Cut& cut = cuts_.cuts[begin_[axis] + at[axis]];
      fluxes.push_back({self, piece(t, above), axis, cut.plane, cut.sheet, clipper_.area2(p, f, axis) / 2});
    } else if (const int n = topology_.neighbours[t][tag]; n < 0) {
      const int chart = chart_of_triangle_[topology_.triangles[t][tag]];
      chart_areas.push_back({self, chart, clipper_.area2(p, f, axis_[chart]) / 2});
    } else if (n > t) {
      sets_->unite(self, neighbour_piece(t, tag, n, at));
    }
  }
}

int Pieces::neighbour_piece(int t, int f, int n, const std::array<int, 3>& at) const {
  int index = 0, i = cuts_.first[n];
  const int end = cuts_.first[n + 1];
  for (int axis = 0; axis < 3; ++axis) {
    const int low = at[axis] > 0 ? cuts_.cuts[begin_[axis] + at[axis] - 1].plane : -1;
    double smallest = cuts_.image[mesh_.tets[t][kTetFacets[f][0]]][axis];
    for (int k : kTetFacets[f]) smallest = std::min(smallest, cuts_.image[mesh_.tets[t][k]][axis]);
    int below = 0, count = 0;
    for (; i < end && cuts_.cuts[i].axis == axis; ++i, ++count) {
      const int plane = cuts_.cuts[i].plane;
      if (plane <= low || cuts_.planes[axis][plane] < smallest) ++below;
    }
    index = index * (count + 1) + below;
  }
  return offset[n] + index;
}

}  // namespace polycube
