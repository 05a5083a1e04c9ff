// Files and text to shapes, by their kind.
#include <unistd.h>

#include <BRepTools_ShapeSet.hxx>
#include <BRep_Builder.hxx>
#include <IGESControl_Reader.hxx>
#include <IGESData_GlobalSection.hxx>
#include <IGESData_IGESModel.hxx>
#include <Standard_Failure.hxx>
#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "cad/exchange.h"
#include "cad/occt.h"
#include "cad/shape.h"

namespace polycube {
namespace {

std::string lower_extension(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

FileShape transfer_iges(const std::string& path, const Monitor& monitor) {
  IGESControl_Reader reader;
  // As FreeCAD: what the file marks as hidden is construction.
  reader.SetReadVisible(true);
  if (!load_entities(reader.WS(), path)) throw InvalidInput(path + ": not an IGES file");
  monitor.check();
  const opencascade::handle<OcctProgress> progress = new OcctProgress(monitor);
  reader.TransferRoots(progress->Start());
  monitor.check();
  if (reader.NbShapes() == 0) throw InvalidInput(path + ": the IGES file holds no shape");
  const IGESData_GlobalSection& header = reader.IGESModel()->GlobalSection();
  return {reader.OneShape(), header.Resolution() * header.UnitValue(), {}};
}

FileShape read_iges(const std::string& path, const Monitor& monitor) {
  const ReaderGuard guard;
  return catching_faults([&] { return transfer_iges(path, monitor); });
}

FileShape read_brep(std::istream& stream, const Monitor& monitor) {
  const ReaderGuard guard;
  const opencascade::handle<OcctProgress> progress = new OcctProgress(monitor);
  FileShape read;
  // At the end of a text cut short OCCT would read on forever; an exception ends that.
  stream.exceptions(std::ios::failbit | std::ios::badbit);
  catching_faults([&] {
    // As BRepTools::Read does it, which looks for the shape in what was read even where reading was stopped in the middle: a fault.
    BRepTools_ShapeSet set{BRep_Builder()};
    set.Read(stream, progress->Start());
    if (!OcctProgress::stopped(monitor)) set.Read(read.shape, stream);
  });
  monitor.check();
  return read;
}

}  // namespace

FileShape read_shape(const std::string& path, const ReadOptions& options, const Monitor& monitor) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) throw InvalidInput(path + ": no such file");
  if (!std::filesystem::is_regular_file(path, error)) throw InvalidInput(path + " is no file");
  if (access(path.c_str(), R_OK) != 0) throw InvalidInput(path + " cannot be read: " + std::strerror(errno));
  if (std::filesystem::file_size(path, error) == 0) throw InvalidInput(path + ": the file is empty");
  const std::string extension = lower_extension(path);
  const bool document = extension == ".fcstd";
  if (!document && !options.object.empty()) throw InvalidInput("--object is for FreeCAD documents only");
  try {
    if (document) return read_document(path, options.object, monitor);
    if (extension == ".step" || extension == ".stp") return read_step(path, monitor);
    if (extension == ".iges" || extension == ".igs") return read_iges(path, monitor);
    if (extension != ".brep" && extension != ".brp") throw InvalidInput(path + ": not a .step, .stp, .iges, .igs, .brep, .brp or .FCStd file");
    std::ifstream stream(path);
    FileShape read = read_brep(stream, monitor);
    if (read.shape.IsNull()) throw InvalidInput(path + ": not a BREP file");
    return read;
  } catch (const Standard_Failure&) {
    monitor.check();  // a call that was stopped may end so
    throw InvalidInput(path + ": OpenCASCADE cannot read the file");
  } catch (const std::ios_base::failure&) {
    monitor.check();
    throw InvalidInput(path + ": the file is cut short or damaged");
  }
}

FileShape parse_brep(const std::string& text, const Monitor& monitor) {
  try {
    std::istringstream stream(text);
    FileShape read = read_brep(stream, monitor);
    if (read.shape.IsNull()) throw InvalidInput("not a BREP shape");
    return read;
  } catch (const Standard_Failure&) {
    monitor.check();  // a call that was stopped may end so
    throw InvalidInput("OpenCASCADE cannot read the BREP shape");
  } catch (const std::ios_base::failure&) {
    monitor.check();
    throw InvalidInput("the BREP shape is cut short or damaged");
  }
}

}  // namespace polycube
