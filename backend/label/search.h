// Repair of a labelling by search over the labels of whole regions.
#pragma once

#include "core/monitor.h"
#include "label/validity.h"

namespace polycube {

/// Of the regions' labels (Region::data) and of the changes between them (Arc::weight).
double region_energy(const RegionGraph& graph, const std::vector<int>& region_label);

/// Lowers the violations, then the energy (Region::data and Arc::weight), by relabelling single regions, pairs of adjacent regions, whole
/// charts and all regions round a bad corner.
/// Never returns a labelling with a higher score than it was given. Deterministic; ends when no move helps.
/// `weight`: what one point of Violations::score is worth in energy.
std::vector<int> repair(const RegionGraph& graph, const std::vector<Vec3>& points, std::vector<int> region_label, double noise, double weight, int threads,
                        const Monitor& monitor);

}  // namespace polycube
