// Reading STEP and BREP, and refusing what is not one valid solid.
#include <BRepCheck_Analyzer.hxx>
#include <BRepGProp.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Bnd_Box.hxx>
#include <BRepBndLib.hxx>
#include <GProp_GProps.hxx>
#include <Interface_CheckIterator.hxx>
#include <Interface_InterfaceModel.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Message_Printer.hxx>
#include <OSD.hxx>
#include <STEPControl_Reader.hxx>
#include <Standard_Failure.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TopAbs_ShapeEnum.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopoDS.hxx>
#include <XSControl_WorkSession.hxx>
#include <signal.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <mutex>
#include <sstream>

#include "cad/shape.h"
#include "core/error.h"

namespace polycube {
namespace {

// Largest and smallest size of a part that double precision and OCCT's absolute confusion of 1e-7 mm leave room for.
constexpr double kLargest = 1e8, kSmallest = 1e-4;

int count(const TopoDS_Shape& shape, TopAbs_ShapeEnum kind, TopAbs_ShapeEnum avoid = TopAbs_SHAPE) {
  TopTools_IndexedMapOfShape map;
  for (TopExp_Explorer it(shape, kind, avoid); it.More(); it.Next()) map.Add(it.Current());
  return map.Extent();
}

std::string lower_extension(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

/// OCCT's readers keep settings and tables in globals, and some of them talk on std::cout: one at a time, in silence.
class ReaderGuard {
 public:
  ReaderGuard() : lock_(mutex()), output_(std::cout.rdbuf(nullptr)) { Message::DefaultMessenger()->RemovePrinters(STANDARD_TYPE(Message_Printer)); }
  ~ReaderGuard() { std::cout.rdbuf(output_); }
  ReaderGuard(const ReaderGuard&) = delete;
  ReaderGuard& operator=(const ReaderGuard&) = delete;

 private:
  static std::mutex& mutex() {
    static std::mutex instance;
    return instance;
  }
  std::lock_guard<std::mutex> lock_;
  std::streambuf* output_;
};

/// OCCT marks entities whose parameters it could not read, and then follows their null references into a crash: such a file must not be
/// transferred. Entities other than shapes and geometry may be damaged without harm.
void check_entities(const STEPControl_Reader& reader, const std::string& path) {
  const opencascade::handle<Interface_InterfaceModel> model = reader.WS()->Model();
  Interface_CheckIterator checks = reader.WS()->ModelCheckList();
  for (checks.Start(); checks.More(); checks.Next()) {
    if (!checks.Value()->HasFailed()) continue;
    const int number = checks.Number();
    if (number == 0) throw InvalidInput(path + ": the STEP file is damaged");
    const std::string type = model->Value(number)->DynamicType()->Name();
    if (type.rfind("StepShape_", 0) == 0 || type.rfind("StepGeom_", 0) == 0 || type.rfind("StepData_", 0) == 0)
      throw InvalidInput(path + ": the STEP file is damaged at entity #" + model->StringLabel(model->Value(number))->ToCString());
  }
}

/// While it lives OCCT turns a segmentation fault of its own into a Standard_Failure, which its transfer catches entity by entity: references
/// of the wrong kind in a damaged STEP file end there. The process' own handlers come back afterwards.
class SignalGuard {
 public:
  SignalGuard() {
    for (std::size_t i = 0; i < kSignals.size(); ++i) sigaction(kSignals[i], nullptr, &before_[i]);
    OSD::SetSignal(Standard_False);
    // Interrupts stay with whoever handles them.
    for (std::size_t i = kFaults; i < kSignals.size(); ++i) sigaction(kSignals[i], &before_[i], nullptr);
  }
  ~SignalGuard() {
    for (std::size_t i = 0; i < kFaults; ++i) sigaction(kSignals[i], &before_[i], nullptr);
  }
  SignalGuard(const SignalGuard&) = delete;
  SignalGuard& operator=(const SignalGuard&) = delete;

 private:
  static constexpr std::size_t kFaults = 5;
  static constexpr std::array<int, 9> kSignals{SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGSYS, SIGHUP, SIGINT, SIGQUIT, SIGTERM};
  std::array<struct sigaction, 9> before_{};
};

TopoDS_Shape read_step(const std::string& path) {
  const ReaderGuard guard;
  const SignalGuard signals;
  STEPControl_Reader reader;
  if (reader.ReadFile(path.c_str()) != IFSelect_RetDone) throw InvalidInput(path + ": not a STEP file");
  check_entities(reader, path);
  reader.TransferRoots();
  if (reader.NbShapes() == 0) throw InvalidInput(path + ": the STEP file holds no shape");
  return reader.OneShape();
}

TopoDS_Shape read_brep(std::istream& stream) {
  const ReaderGuard guard;
  TopoDS_Shape shape;
  // At the end of a text cut short OCCT would read on forever; an exception ends that.
  stream.exceptions(std::ios::failbit | std::ios::badbit);
  BRepTools::Read(shape, stream, BRep_Builder());
  return shape;
}

void check_coordinates(const TopoDS_Shape& shape) {
  TopTools_IndexedMapOfShape vertices;
  TopExp::MapShapes(shape, TopAbs_VERTEX, vertices);
  for (int i = 1; i <= vertices.Extent(); ++i) {
    const gp_Pnt p = BRep_Tool::Pnt(TopoDS::Vertex(vertices(i)));
    for (int k = 1; k <= 3; ++k)
      if (!std::isfinite(p.Coord(k)) || std::abs(p.Coord(k)) > kLargest)
        throw InvalidInput(name({0, i}) + " has no usable coordinates");
  }
}

/// Every edge bounds exactly two faces, or the same face twice, or is a mere point.
void check_closed(const TopoDS_Shape& shape) {
  TopTools_IndexedDataMapOfShapeListOfShape faces_of;
  TopExp::MapShapesAndAncestors(shape, TopAbs_EDGE, TopAbs_FACE, faces_of);
  TopTools_IndexedMapOfShape edges;
  TopExp::MapShapes(shape, TopAbs_EDGE, edges);
  for (int i = 1; i <= edges.Extent(); ++i) {
    const TopoDS_Edge edge = TopoDS::Edge(edges(i));
    if (BRep_Tool::Degenerated(edge)) continue;
    const int uses = faces_of.Contains(edge) ? faces_of.FindFromKey(edge).Extent() : 0;
    if (uses < 2) throw InvalidInput("the shape is open at " + name({1, i}));
    if (uses > 2) throw InvalidInput("more than two faces meet at " + name({1, i}));
  }
}

void validate_unguarded(const TopoDS_Shape& shape) {
  if (shape.IsNull()) throw InvalidInput("the shape is empty");
  const int solids = count(shape, TopAbs_SOLID);
  if (solids == 0) {
    if (count(shape, TopAbs_FACE) == 0) throw InvalidInput("the shape is empty: it has no face");
    throw InvalidInput("the shape is a shell or loose faces, not a solid");
  }
  if (solids > 1) throw InvalidInput("the shape holds " + std::to_string(solids) + " solids; one is needed");
  if (count(shape, TopAbs_FACE, TopAbs_SOLID) + count(shape, TopAbs_EDGE, TopAbs_FACE) > 0)
    throw InvalidInput("the shape holds loose faces or edges beside its solid");
  if (count(shape, TopAbs_FACE) == 0) throw InvalidInput("the solid has no face");
  check_coordinates(shape);
  check_closed(shape);
  const BRepCheck_Analyzer analyzer(shape);
  if (!analyzer.IsValid()) {
    static constexpr std::array<std::pair<TopAbs_ShapeEnum, int>, 3> kKinds{{{TopAbs_FACE, 2}, {TopAbs_EDGE, 1}, {TopAbs_VERTEX, 0}}};
    for (const auto& [kind, dim] : kKinds) {
      TopTools_IndexedMapOfShape map;
      TopExp::MapShapes(shape, kind, map);
      for (int i = 1; i <= map.Extent(); ++i)
        if (!analyzer.IsValid(map(i))) throw InvalidInput("the shape is not valid at " + name({dim, i}) + " (OpenCASCADE's check)");
    }
    throw InvalidInput("the solid is not valid (OpenCASCADE's check)");
  }
  Bnd_Box box;
  BRepBndLib::Add(shape, box, false);
  const double diagonal = box.IsVoid() ? 0 : std::sqrt(box.SquareExtent());
  if (!(diagonal > kSmallest && diagonal < kLargest)) throw InvalidInput("the solid's size is not usable: " + std::to_string(diagonal) + " mm across");
  GProp_GProps properties;
  BRepGProp::VolumeProperties(shape, properties);
  const double volume = properties.Mass();
  if (!std::isfinite(volume) || std::abs(volume) < 1e-12 * std::pow(diagonal, 3)) throw InvalidInput("the solid has no volume");
  if (volume < 0) throw InvalidInput("the solid is inside out: its volume is negative");
  // The box has OCCT's safety margins, so this can only fail on faces that cross each other.
  if (volume > 1.01 * std::pow(diagonal, 3)) throw InvalidInput("the solid intersects itself");
}

}  // namespace

TopoDS_Shape read_shape(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) throw InvalidInput(path + ": no such file");
  if (std::filesystem::file_size(path, error) == 0) throw InvalidInput(path + ": the file is empty");
  const std::string extension = lower_extension(path);
  const bool step = extension == ".step" || extension == ".stp";
  if (!step && extension != ".brep" && extension != ".brp") throw InvalidInput(path + ": not a .step, .stp, .brep or .brp file");
  try {
    if (step) return read_step(path);
    std::ifstream stream(path);
    const TopoDS_Shape shape = read_brep(stream);
    if (shape.IsNull()) throw InvalidInput(path + ": not a BREP file");
    return shape;
  } catch (const Standard_Failure&) {
    throw InvalidInput(path + ": OpenCASCADE cannot read the file");
  } catch (const std::ios_base::failure&) {
    throw InvalidInput(path + ": the file is cut short or damaged");
  }
}

TopoDS_Shape parse_brep(const std::string& text) {
  try {
    std::istringstream stream(text);
    const TopoDS_Shape shape = read_brep(stream);
    if (shape.IsNull()) throw InvalidInput("not a BREP shape");
    return shape;
  } catch (const Standard_Failure&) {
    throw InvalidInput("OpenCASCADE cannot read the BREP shape");
  } catch (const std::ios_base::failure&) {
    throw InvalidInput("the BREP shape is cut short or damaged");
  }
}

void validate(const TopoDS_Shape& shape) {
  try {
    validate_unguarded(shape);
  } catch (const Standard_Failure& failure) {
    throw InvalidInput("OpenCASCADE cannot check the shape: " + std::string(failure.GetMessageString()));
  }
}

}  // namespace polycube
