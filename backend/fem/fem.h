// The finite element mesh: elements of first or second order, boundary faces, and a group per CAD entity; and its files.
#pragma once

#include <string>

#include "cad/cad.h"
#include "core/mesh.h"
#include "core/monitor.h"
#include "core/report.h"

namespace polycube {

/// Nodes and elements that stand for one CAD entity, or for one side of an interface between solids. 0-based, ascending.
struct FemGroup {
  CadRef entity;  ///< of an interface {2, 0}
  std::vector<int> nodes;
  std::vector<int> elements;                ///< solid: hexes; face: quads; edge: segments; vertex: none
  std::vector<std::array<int, 2>> sides{};  ///< face: per element its hex on the group's side and the hex's face 0 to 5 as Abaqus' S1 to S6
  int solid = 0;                            ///< not 0: only what this solid has of an entity that several share, or of an interface
  int other = 0;                            ///< interface: the solid that `solid` touches there
};

/// "Face3"; of one solid "Solid1_Face3"; the faces of Solid1 that touch Solid2 "Solid1_Solid2".
std::string group_name(const FemGroup& group);

/// Abaqus' face number (0 = S1) of each face of core/hexahedron.h.
inline constexpr std::array<int, 6> kAbaqusFace{5, 3, 2, 4, 0, 1};

/// Node order within elements is VTK's (= Abaqus'): corners, then mid-edge nodes in the order of kHexEdges. In a mesh of order 1 the
/// places of mid-edge nodes hold -1.
struct FemMesh {
  int order = 1;
  int corner_count = 0;      ///< points before this one are corners, the others mid-edge nodes
  std::vector<Vec3> points;  ///< mm
  std::vector<std::array<int, 20>> hexes;
  std::vector<int> hex_block;                ///< per hex: the block that it is part of; may be empty
  std::vector<int> hex_solid;                ///< per hex: number of its solid; empty for one solid
  std::vector<std::array<int, 8>> quads;     ///< all boundary faces, outward; those between two solids with common nodes once
  std::vector<int> quad_face;                ///< per quad: CAD face
  std::vector<std::array<int, 2>> quad_hex;  ///< per quad: its hex (between two solids that of the lower number), and the hex's face 0 to 5 as Abaqus' S1 to S6
  std::vector<std::array<int, 3>> segments;  ///< start, end, middle
  std::vector<int> segment_edge;             ///< per segment: CAD edge
  std::vector<FemGroup> groups;              ///< ascending by solid, other and entity; only entities that have a node
  std::vector<int> straight_nodes;           ///< mid-edge nodes off the CAD, because an edge on it would spoil a cell; ascending
};

struct FemOptions {
  int order = 2;
  int threads = 0;  ///< 0: all cores. The result does not depend on it.
};

/// Mid-edge nodes go to the CAD edge or face they stand for, and stay in the middle of inner edges but where that would spoil a cell. Throws
/// StageFailed("fem", ...) where a cell's Jacobian is not positive at an integration point even with straight edges.
FemMesh build_fem_mesh(const CadModel& model, const HexMesh& mesh, const Association& association, const FemOptions& options, const Monitor& monitor);

/// Completes the report of the mesh that the elements were built from: nodes, straightened edges, and a warning that names their CAD faces.
void complete(MeshReport& report, const FemMesh& mesh);

/// Smallest Jacobian determinant of a cell at its 8 corners and 27 Gauss points, mm^3 (of the reference cube [-1, 1]^3).
double least_jacobian(const FemMesh& mesh, int hex);

/// Per cell the number of its solid: 1 where there is only one.
std::vector<int> solid_numbers(const FemMesh& mesh);

/// A measure of core/quality.h per cell, of its corners.
std::vector<double> cell_values(const FemMesh& mesh, double (*measure)(const std::vector<Vec3>&, const Hex&));

/// What the elements of a group are, by its entity's dimension.
inline constexpr std::array<const char*, 4> kGroupElements{"", "segments", "quads", "hexes"};

/// SMESH (FreeCAD, MED) winds cells the other way: its node i is our node kSmeshHex20[i]. The first 8 are those of the 8-node cell.
inline constexpr std::array<int, 20> kSmeshHex20{0, 3, 2, 1, 4, 7, 6, 5, 11, 10, 9, 8, 15, 14, 13, 12, 16, 19, 18, 17};

/// Writes by suffix: .inp (CalculiX/Abaqus), .unv, .vtu, .med, .mesh (Medit; corners only). `element_type` is the Abaqus name for .inp.
/// The file appears complete or not at all. Throws InvalidInput: unknown suffix, folder missing, not writable.
void write(const FemMesh& mesh, const std::string& path, const std::string& element_type, const Monitor& monitor);

/// Throws InvalidInput unless `write` knows the suffix and the folder exists. For a check before the work.
void check_output(const std::string& path);

}  // namespace polycube
