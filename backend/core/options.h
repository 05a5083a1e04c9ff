// The one source of options: the command line, the Python signature and FreeCAD's properties are made from this table.
#pragma once

#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "core/demands.h"
#include "core/types.h"

namespace polycube {

/// A mesh of more hexahedra is not attempted: it takes about 1.4 GB a million.
inline constexpr int kMostHexes = 10'000'000;

/// (CAD face, label 0..5 = +X -X +Y -Y +Z -Z).
using FaceLabels = std::vector<std::pair<int, int>>;

/// Directions of the labels' X and Y in the part's coordinates, of any length; empty: the frame is found from the part.
using FrameAxes = std::vector<Vec3>;

/// What a user can ask of a mesh. Meaning, unit and bounds of each member: option_table().
struct MeshOptions {
  double size = 0;
  int hexes = 0;
  bool coarsest = false;
  int order = 2;
  std::string element_type;
  std::string effort = "normal";
  double time_limit = 0;
  double feature_angle = 0;
  bool sew = true;
  FaceList keep_faces;
  int threads = 0;
  FaceLabels labels;
  FrameAxes frame;
  int min_layers = 0;
  int per_circle = 12;
  double max_size = 0;
  double growth = 1.5;
  Divisions divisions;
  LocalSizes sizes;
  EdgeBiases bias;
  LocalRefinements refine;
  std::string interfaces = "conform";
  double fidelity = 3;
  double compactness = 1;
  friend bool operator==(const MeshOptions&, const MeshOptions&) = default;
};

/// One option. `name` is snake_case; the command line writes it --time-limit, FreeCAD TimeLimit.
struct OptionSpec {
  using Member = std::variant<double MeshOptions::*, int MeshOptions::*, bool MeshOptions::*, std::string MeshOptions::*, FaceLabels MeshOptions::*,
                              FrameAxes MeshOptions::*, Divisions MeshOptions::*, LocalSizes MeshOptions::*, EdgeBiases MeshOptions::*, FaceList MeshOptions::*,
                              LocalRefinements MeshOptions::*>;
  std::string name;
  std::string unit;     ///< "mm", "s", "degrees" or empty
  std::string meaning;  ///< one sentence
  Member member;
  double min = 0, max = 0;             ///< inclusive bounds of a number
  bool zero_is_unset = false;          ///< the default 0 stands for "not given"; giving 0 is an error
  std::vector<std::string> choices{};  ///< allowed values of a word, or of a number as text; empty: any within the bounds
  bool advanced = false;               ///< not for everyday use
};

const std::vector<OptionSpec>& option_table();

/// "double", "int", "bool", "string", "labels", "frame", "divisions", "sizes", "bias", "faces" or "refine".
std::string option_type(const OptionSpec& option);

/// Options from (name, text) pairs such as ("size", "2.5"), ("coarsest", "true"), ("labels", "Face3=+X,Face7=-Z"),
/// ("frame", "1,0,0/0,1,0"), checked.
/// An element type given without an order brings its own order. Throws InvalidInput naming the option.
MeshOptions parse_options(const std::vector<std::pair<std::string, std::string>>& given);

/// The value as text that parse_options reads back.
std::string option_text(const MeshOptions& options, const OptionSpec& option);

/// Throws InvalidInput, one line naming the option: not a number, out of bounds, not a choice, two ways of giving the size at once,
/// an element type that contradicts the order,
/// a frame whose axes are no directions or not at right angles.
void check(const MeshOptions& options);

/// Numbers of what a part has, ascending.
struct PartNumbers {
  std::vector<int> faces, edges, vertices;
  int solids = 1;
};

/// The same against a part: throws where size exceeds the part's bounding-box diagonal (mm) or a label, a division, a local size or a face to keep
/// names a face, edge or vertex that is not among the numbers of the part's (ascending), or a solid beyond its number of solids.
void check(const MeshOptions& options, double diagonal, const PartNumbers& numbers);

/// "+X", "-X", ... of a label 0..5.
const char* label_name(int label);

/// The right-handed orthonormal frame (rows: the axes) of checked, not empty FrameAxes. Y is made exactly square to X.
Mat3 frame_of(const FrameAxes& axes);

/// Throws InvalidInput where about `hexes` hexahedra would be made and that is more than kMostHexes.
void check_count(double hexes);

/// Edge length to come near to, mm: `size`, or diagonal / 20 where it is 0 (three quarters of max_size where that is less).
double effective_size(const MeshOptions& options, double diagonal);

/// Edge length that none is to exceed, mm: max_size, or diagonal / 15 where no size is given; infinite where a size, a number or the coarsest mesh is asked
/// for.
double effective_max_size(const MeshOptions& options, double diagonal);

/// Elements at least through every wall: `min_layers`, or 2 of second and 3 of first order where it is 0; of the coarsest mesh 1.
int effective_min_layers(const MeshOptions& options);

/// Elements at least round a full circle; 0: as the size has it. The coarsest mesh has none to keep.
int effective_per_circle(const MeshOptions& options);

/// Abaqus name of the elements in force: `element_type`, or C3D8 / C3D20 by order.
std::string effective_element_type(const MeshOptions& options);

}  // namespace polycube
