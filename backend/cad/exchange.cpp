#include "cad/exchange.h"

#include <IFSelect_WorkLibrary.hxx>
#include <Interface_EntityIterator.hxx>
#include <Interface_Graph.hxx>
#include <Interface_InterfaceModel.hxx>
#include <Interface_Protocol.hxx>
#include <Standard_Version.hxx>
#include <StepData_StepModel.hxx>
#include <TCollection_HAsciiString.hxx>
#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string_view>
#include <unordered_set>
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
void check_reals(const std::string& path, const std::string& text) {
  const auto digit = [&](std::size_t i) { return i < text.size() && std::isdigit(static_cast<unsigned char>(text[i])); };
  for (std::size_t i = 1; i < text.size(); ++i) {
    if (std::string_view("EeDd").find(text[i]) == std::string_view::npos) continue;
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

std::string text_of(const std::string& path) {
  std::ostringstream buffer;
  buffer << std::ifstream(path, std::ios::binary).rdbuf();
  return std::move(buffer).str();
}

/// Where the string or comment ends that begins at `from`. As for OCCT, a string goes on over quotes after which neither a comma nor a parenthesis comes.
std::size_t end_of_text(const std::string& step, std::size_t from) {
  const std::size_t last = step.size() - 1;
  if (step[from] != '\'') return std::min(step.find("*/", from + 2), last - 1) + 1;
  for (std::size_t quote = step.find('\'', from + 1); quote != std::string::npos; quote = step.find('\'', quote + 1)) {
    const std::size_t next = step.find_first_not_of("\" \n\r", quote + 1);
    if (next != std::string::npos && (step[next] == ',' || step[next] == ')')) return quote;
  }
  return last;
}

/// A STEP file without its strings and comments.
std::string statements_of(std::string step) {
  for (std::size_t i = 0; i < step.size(); ++i) {
    if (step[i] != '\'' && step.compare(i, 2, "/*") != 0) continue;
    const std::size_t end = end_of_text(step, i);
    std::fill(step.begin() + static_cast<std::ptrdiff_t>(i), step.begin() + static_cast<std::ptrdiff_t>(end) + 1, ' ');
    i = end;
  }
  return step;
}

/// Throws InvalidInput where two entities of a STEP file have one number: OCCT then walks through lists that it has not filled.
void check_numbers(const std::string& path, const std::string& statements) {
  std::unordered_set<unsigned long long> seen;
  for (std::size_t i = statements.find('#'); i != std::string::npos; i = statements.find('#', i + 1)) {
    char* end = nullptr;
    const unsigned long long number = std::strtoull(statements.c_str() + i + 1, &end, 10);
    while (*end == ' ' || *end == '\t' || *end == '\r' || *end == '\n') ++end;
    if (*end == '=' && !seen.insert(number).second) throw InvalidInput(path + ": the STEP file is damaged: there are two entities #" + std::to_string(number));
  }
}

/// What OpenCASCADE reads a STEP file into: since 7.8 it takes the one that it is given, and crashes where there is none.
opencascade::handle<StepData_StepModel> empty_step_model() {
  opencascade::handle<StepData_StepModel> model = new StepData_StepModel;
#if OCC_VERSION_HEX >= 0x070800
  model->InternalParameters.InitFromStatic();
#endif
  return model;
}

/// What an IGES file says of its entities: the first 64 columns of the lines that have a P in column 73.
std::string parameters_of(const std::string& iges) {
  std::istringstream lines(iges);
  std::string result;
  for (std::string line; std::getline(lines, line);) {
    if (line.size() > 72 && line[72] == 'P') result += line.substr(0, 64) + "\n";
  }
  return result;
}

}  // namespace

bool load_entities(const opencascade::handle<XSControl_WorkSession>& session, const std::string& path, std::istream* stream) {
  const std::string text = stream ? statements_of(text_of(path)) : parameters_of(text_of(path));
  check_reals(path, text);
  if (stream) check_numbers(path, text);
  opencascade::handle<Interface_InterfaceModel> model;
  if (stream) model = empty_step_model();
  const opencascade::handle<IFSelect_WorkLibrary>& library = session->WorkLibrary();
  const int status =
      stream ? library->ReadStream(path.c_str(), *stream, model, session->Protocol()) : library->ReadFile(path.c_str(), model, session->Protocol());
  if (status != 0 || model.IsNull()) return false;
  if (const int at = on_cycle(*model, Interface_Graph(model, session->Protocol())); at > 0)
    throw InvalidInput(path + ": the file is damaged: entity " + model->StringLabel(model->Value(at))->ToCString() + " is built on itself");
  session->SetModel(model);
  session->InitTransferReader(4);  // ready to transfer the whole model, as ReadFile leaves it
  return true;
}

}  // namespace polycube
