#include "cad/exchange.h"

#include <IFSelect_WorkLibrary.hxx>
#include <Interface_EntityIterator.hxx>
#include <Interface_Graph.hxx>
#include <Interface_InterfaceModel.hxx>
#include <Interface_Protocol.hxx>
#include <TCollection_HAsciiString.hxx>
#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string_view>
#include <vector>

#include "core/error.h"

namespace polycube {
namespace {

/// Views, labels and the like may list what refers to them.
bool is_geometry(const Standard_Transient& entity) {
  static constexpr std::array<const char*, 6> kPackages{"StepShape_", "StepGeom_", "StepRepr_", "IGESGeom_", "IGESBasic_", "IGESSolid_"};
  const std::string type = entity.DynamicType()->Name();
  return std::any_of(kPackages.begin(), kPackages.end(), [&](const char* package) { return type.rfind(package, 0) == 0; });
}

/// Number of a geometric entity that is reached from itself, 0 if there is none.
int on_cycle(const Interface_InterfaceModel& model, const Interface_Graph& graph) {
  const auto count = static_cast<std::size_t>(model.NbEntities());
  std::vector<std::vector<int>> parts(count + 1), users(count + 1);
  for (int i = 1; i <= model.NbEntities(); ++i) {
    if (!is_geometry(*model.Value(i))) continue;
    for (Interface_EntityIterator it = graph.Shareds(model.Value(i)); it.More(); it.Next()) {
      const int part = model.Number(it.Value());
      if (part == 0 || !is_geometry(*model.Value(part))) continue;
      parts[static_cast<std::size_t>(i)].push_back(part);
      users[static_cast<std::size_t>(part)].push_back(i);
    }
  }
  // Entities whose parts are all sound are sound; what never becomes so is on a cycle or built on one.
  std::vector<std::size_t> waiting(count + 1, 0);
  std::vector<int> sound;
  for (std::size_t i = 1; i <= count; ++i) {
    waiting[i] = parts[i].size();
    if (waiting[i] == 0) sound.push_back(static_cast<int>(i));
  }
  for (std::size_t k = 0; k < sound.size(); ++k) {
    for (const int user : users[static_cast<std::size_t>(sound[k])])
      if (--waiting[static_cast<std::size_t>(user)] == 0) sound.push_back(user);
  }
  const auto unsound = [&](int i) { return waiting[static_cast<std::size_t>(i)] > 0; };
  for (int i = 1; i <= model.NbEntities(); ++i) {
    if (!unsound(i)) continue;
    // From part to part the way leads onto the cycle before long.
    int at = i;
    for (std::size_t step = 0; step < count; ++step) {
      const auto& below = parts[static_cast<std::size_t>(at)];
      at = *std::find_if(below.begin(), below.end(), unsound);
    }
    return at;
  }
  return 0;
}

/// Throws InvalidInput where no double holds the square of a real number in the file: lengths become infinite, and OCCT counts periods up to them for ever.
void check_reals(const std::string& path, bool quotes) {
  std::ostringstream buffer;
  buffer << std::ifstream(path, std::ios::binary).rdbuf();
  const std::string text = std::move(buffer).str();
  const auto digit = [&](std::size_t i) { return i < text.size() && std::isdigit(static_cast<unsigned char>(text[i])); };
  bool quoted = false;
  for (std::size_t i = 1; i < text.size(); ++i) {
    if (quotes && text[i] == '\'') quoted = !quoted;
    if (quoted || std::string_view("EeDd").find(text[i]) == std::string_view::npos) continue;
    std::size_t start = i, end = i + 1;
    while (start > 0 && (digit(start - 1) || text[start - 1] == '.')) --start;
    if (end < text.size() && (text[end] == '+' || text[end] == '-')) ++end;
    const std::size_t exponent = end;
    while (digit(end)) ++end;
    if (start == i || end == exponent || (start > 0 && std::isalnum(static_cast<unsigned char>(text[start - 1])))) continue;
    const std::string number = text.substr(start, i - start) + "E" + text.substr(i + 1, end - i - 1);
    const double value = std::strtod(number.c_str(), nullptr);
    if (!std::isfinite(value * value)) throw InvalidInput(path + ": the file holds a number that is out of range, " + number.substr(0, 40));
  }
}

}  // namespace

bool load_entities(const opencascade::handle<XSControl_WorkSession>& session, const std::string& path, std::istream* stream) {
  check_reals(path, stream != nullptr);
  opencascade::handle<Interface_InterfaceModel> model;
  const opencascade::handle<IFSelect_WorkLibrary>& library = session->WorkLibrary();
  const int status = stream ? library->ReadStream(path.c_str(), *stream, model, session->Protocol()) : library->ReadFile(path.c_str(), model, session->Protocol());
  if (status != 0 || model.IsNull()) return false;
  if (const int at = on_cycle(*model, Interface_Graph(model, session->Protocol())); at > 0)
    throw InvalidInput(path + ": the file is damaged: entity " + model->StringLabel(model->Value(at))->ToCString() + " is built on itself");
  session->SetModel(model);
  session->InitTransferReader(4);  // ready to transfer the whole model, as ReadFile leaves it
  return true;
}

}  // namespace polycube
