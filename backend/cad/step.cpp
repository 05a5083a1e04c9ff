// STEP: what of the file is damaged, whether the solid uses it, and the shape of the rest.
#include <Interface_CheckIterator.hxx>
#include <Interface_EntityIterator.hxx>
#include <Interface_Graph.hxx>
#include <Interface_InterfaceModel.hxx>
#include <STEPConstruct_UnitContext.hxx>
#include <STEPControl_Reader.hxx>
#include <Standard_Version.hxx>
#include <StepBasic_Product.hxx>
#include <StepBasic_ProductDefinition.hxx>
#include <StepBasic_ProductDefinitionFormation.hxx>
#include <StepGeom_GeomRepContextAndGlobUnitAssCtxAndGlobUncertaintyAssCtx.hxx>
#include <StepRepr_GlobalUncertaintyAssignedContext.hxx>
#include <StepRepr_GlobalUnitAssignedContext.hxx>
#include <StepRepr_HArray1OfRepresentationItem.hxx>
#include <StepRepr_PropertyDefinition.hxx>
#include <StepRepr_Representation.hxx>
#include <StepRepr_RepresentationContext.hxx>
#include <StepRepr_RepresentationRelationship.hxx>
#include <StepShape_FaceBasedSurfaceModel.hxx>
#include <StepShape_ShapeDefinitionRepresentation.hxx>
#include <StepShape_ShellBasedSurfaceModel.hxx>
#include <StepShape_SolidModel.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TopExp_Explorer.hxx>
#include <TransferBRep.hxx>
#include <Transfer_TransientProcess.hxx>
#include <XSControl_TransferReader.hxx>
#include <XSControl_WorkSession.hxx>
#include <algorithm>
#include <array>
#include <fstream>
#include <set>
#include <string_view>
#if OCC_VERSION_HEX >= 0x070800
#include <StepData_Factors.hxx>
#endif

#include "cad/exchange.h"
#include "cad/occt.h"
#include "cad/shape.h"

namespace polycube {
namespace {

using Entity = opencascade::handle<Standard_Transient>;
using Item = opencascade::handle<StepRepr_RepresentationItem>;
using Representation = opencascade::handle<StepRepr_Representation>;

/// A file that seems to end when the monitor wants a stop: OCCT's parser has no other way out.
class StoppableFile : public std::filebuf {
 public:
  StoppableFile(const std::string& path, const Monitor& monitor) : monitor_(monitor) {
    open(path, std::ios::in | std::ios::binary);
    constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";  // OCCT does not know it
    std::array<char, kByteOrderMark.size()> start{};
    if (std::filebuf::xsgetn(start.data(), start.size()) != static_cast<std::streamsize>(start.size()) ||
        std::string_view(start.data(), start.size()) != kByteOrderMark)
      pubseekpos(0);
  }

 protected:
  int_type underflow() override { return OcctProgress::stopped(monitor_) ? traits_type::eof() : std::filebuf::underflow(); }
  std::streamsize xsgetn(char* to, std::streamsize count) override { return OcctProgress::stopped(monitor_) ? 0 : std::filebuf::xsgetn(to, count); }

 private:
  const Monitor& monitor_;
};

/// Whether the file's faults at the entity are names that are missing, and now are empty.
bool only_nameless(const Entity& entity, int fails) {
  const opencascade::handle<TCollection_HAsciiString> empty = new TCollection_HAsciiString("");
  if (const Item item = Item::DownCast(entity)) {
    if (!item->Name().IsNull() || fails > 1) return false;
    item->SetName(empty);
    return true;
  }
  const Representation representation = Representation::DownCast(entity);
  if (representation.IsNull() || representation->Items().IsNull() || representation->ContextOfItems().IsNull()) return false;
  if (representation->Name().IsNull()) representation->SetName(empty);
  return true;  // items that could not be read are null; they are left out later
}

bool is_solid(const Entity& entity) { return entity->IsKind(STANDARD_TYPE(StepShape_SolidModel)); }

bool is_surface(const Entity& entity) {
  return entity->IsKind(STANDARD_TYPE(StepShape_ShellBasedSurfaceModel)) || entity->IsKind(STANDARD_TYPE(StepShape_FaceBasedSurfaceModel));
}

/// What matters of a file's entities: geometry and topology, the representations that hold them, their units, and what OCCT could not make out at all.
bool is_shape(const Entity& entity) {
  const std::string type = entity->DynamicType()->Name();
  const auto starts = [&](const char* text) { return type.rfind(text, 0) == 0; };
  return starts("StepShape_") || starts("StepGeom_") || starts("StepData_") || (starts("StepBasic_") && type.find("Unit") != std::string::npos) ||
         entity->IsKind(STANDARD_TYPE(StepRepr_Representation)) || entity->IsKind(STANDARD_TYPE(StepRepr_RepresentationItem)) ||
         entity->IsKind(STANDARD_TYPE(StepRepr_RepresentationContext));
}

/// Whether the file has the end that the format demands.
bool is_whole(const std::string& path) {
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  constexpr std::streamoff kTail = 4096;  // signatures and blank lines may follow
  const std::streamoff size = file.tellg();
  std::string tail(static_cast<std::size_t>(std::min(size, kTail)), '\0');
  file.seekg(size - static_cast<std::streamoff>(tail.size()));
  file.read(tail.data(), static_cast<std::streamsize>(tail.size()));
  return tail.find("END-ISO-10303-21") != std::string::npos;
}

/// Whether the file has the beginning that the format demands, comments aside.
bool begins_as_step(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  constexpr std::streamsize kHead = 4096;  // a byte order mark or comments may come before
  std::string head(kHead, '\0');
  file.read(head.data(), kHead);
  return head.find("ISO-10303-21;") != std::string::npos;
}

/// Leaves out the items that are null or among `tainted` (by number in the model).
void drop_items(const Interface_InterfaceModel& model, const Representation& representation, const std::vector<char>& tainted) {
  const auto items = representation->Items();
  if (items.IsNull()) return;
  std::vector<Item> kept;
  for (const Item& item : *items) {
    const int number = item.IsNull() ? 0 : model.Number(item);
    if (!item.IsNull() && (number == 0 || !tainted[static_cast<std::size_t>(number)])) kept.push_back(item);
  }
  if (static_cast<int>(kept.size()) == items->Length()) return;
  opencascade::handle<StepRepr_HArray1OfRepresentationItem> rest;
  if (!kept.empty()) {
    rest = new StepRepr_HArray1OfRepresentationItem(1, static_cast<int>(kept.size()));
    for (std::size_t i = 0; i < kept.size(); ++i) rest->SetValue(static_cast<int>(i) + 1, kept[i]);
  }
  representation->SetItems(rest);
}

/// OCCT marks entities whose parameters it could not read, and then follows their null references into a crash. Where a solid (or, in a file without
/// one, a surface model) is built on such an entity the file is refused; elsewhere everything that is built on it is left out, as if the file had not held it.
/// What the parser could not read at all is missing from the entities that refer to it, which are marked too. Returns how many faults there were.
int leave_out_damaged(const STEPControl_Reader& reader, const std::string& path) {
  const opencascade::handle<Interface_InterfaceModel> model = reader.WS()->Model();
  Interface_CheckIterator checks = reader.WS()->ModelCheckList();
  std::vector<int> damaged;
  int faults = 0;
  for (checks.Start(); checks.More(); checks.Next()) {
    if (!checks.Value()->HasFailed()) continue;
    if (checks.Number() == 0) {
      if (!is_whole(path)) throw InvalidInput(path + ": the STEP file is cut short");
      faults += checks.Value()->NbFails();
      continue;
    }
    const Entity& entity = model->Value(checks.Number());
    if (is_shape(entity) && !only_nameless(entity, checks.Value()->NbFails())) damaged.push_back(checks.Number());
  }
  const int count = model->NbEntities();
  bool solids = false;
  for (int i = 1; i <= count; ++i) solids = solids || is_solid(model->Value(i));
  const auto needed = [&](const Entity& entity) { return solids ? is_solid(entity) : is_surface(entity); };

  const Interface_Graph graph(model);
  std::vector<char> tainted(static_cast<std::size_t>(count) + 1, 0);
  for (const int start : damaged) {
    const auto refuse = [&] { return InvalidInput(path + ": the STEP file is damaged at entity " + model->StringLabel(model->Value(start))->ToCString()); };
    std::vector<int> stack{start};
    while (!stack.empty()) {
      const int at = stack.back();
      stack.pop_back();
      if (tainted[static_cast<std::size_t>(at)]) continue;
      tainted[static_cast<std::size_t>(at)] = 1;
      const Entity& entity = model->Value(at);
      if (needed(entity)) throw refuse();
      if (const Representation representation = Representation::DownCast(entity)) {
        const auto context = representation->ContextOfItems();
        // It does without an item, but without its context it has no units.
        if (at != start && !context.IsNull() && !tainted[static_cast<std::size_t>(model->Number(context))]) {
          tainted[static_cast<std::size_t>(at)] = 0;
          continue;
        }
        const auto items = representation->Items();
        if (!items.IsNull() && std::any_of(items->begin(), items->end(), [&](const Item& item) { return !item.IsNull() && needed(item); })) throw refuse();
      }
      for (Interface_EntityIterator users = graph.Sharings(entity); users.More(); users.Next()) {
        if (const int user = model->Number(users.Value()); user > 0) stack.push_back(user);
      }
    }
  }
  for (int i = 1; i <= count; ++i) {
    if (const Representation representation = Representation::DownCast(model->Value(i))) drop_items(*model, representation, tainted);
  }
  return faults + static_cast<int>(damaged.size());
}

/// The largest uncertainty of lengths that the file declares, mm; 0 where it declares none.
double declared_tolerance(const Interface_InterfaceModel& model) {
  double largest = 0;
  for (int i = 1; i <= model.NbEntities(); ++i) {
    const auto context = opencascade::handle<StepGeom_GeomRepContextAndGlobUnitAssCtxAndGlobUncertaintyAssCtx>::DownCast(model.Value(i));
    if (context.IsNull() || context->GlobalUnitAssignedContext().IsNull() || context->GlobalUncertaintyAssignedContext().IsNull()) continue;
    STEPConstruct_UnitContext units;
#if OCC_VERSION_HEX >= 0x070800
    units.ComputeFactors(context->GlobalUnitAssignedContext(), StepData_Factors());
#else
    units.ComputeFactors(context->GlobalUnitAssignedContext());
#endif
    units.ComputeTolerance(context->GlobalUncertaintyAssignedContext());
    if (units.HasUncertainty()) largest = std::max(largest, units.Uncertainty() * units.LengthFactor());
  }
  return largest;
}

/// The name of the product whose shape the entity belongs to: the nearest one that builds on it; empty where there is none.
std::string product_of(const Interface_Graph& graph, const Entity& entity) {
  std::set<int> seen;
  std::vector<Entity> ring{entity};
  while (!ring.empty()) {
    std::vector<Entity> next;
    for (const Entity& at : ring) {
      for (Interface_EntityIterator users = graph.Sharings(at); users.More(); users.Next()) {
        const auto definition = opencascade::handle<StepShape_ShapeDefinitionRepresentation>::DownCast(users.Value());
        const auto property = definition.IsNull() ? nullptr : definition->Definition().PropertyDefinition();
        const auto product = property.IsNull() ? nullptr : property->Definition().ProductDefinition();
        if (!product.IsNull() && !product->Formation().IsNull() && !product->Formation()->OfProduct().IsNull()) {
          const auto name = product->Formation()->OfProduct()->Name();
          if (!name.IsNull()) return name->ToCString();
        }
        // Only representations lead from a solid to its product; a context would lead to all.
        if (users.Value()->IsKind(STANDARD_TYPE(StepRepr_Representation)) || users.Value()->IsKind(STANDARD_TYPE(StepRepr_RepresentationRelationship)))
          if (seen.insert(graph.EntityNumber(users.Value())).second) next.push_back(users.Value());
      }
      if (const auto relation = opencascade::handle<StepRepr_RepresentationRelationship>::DownCast(at); !relation.IsNull()) {
        for (const Entity& side : {Entity(relation->Rep1()), Entity(relation->Rep2())})
          if (!side.IsNull() && seen.insert(graph.EntityNumber(side)).second) next.push_back(side);
      }
    }
    ring = std::move(next);
  }
  return {};
}

/// Solids with the name of their own entity, or else of their product.
std::vector<std::pair<TopoDS_Shape, std::string>> solid_labels(const STEPControl_Reader& reader, const TopoDS_Shape& shape) {
  std::vector<std::pair<TopoDS_Shape, std::string>> labels;
  const Interface_Graph graph(reader.WS()->Model());
  const opencascade::handle<Transfer_TransientProcess> process = reader.WS()->TransferReader()->TransientProcess();
  for (int i = 1; i <= process->NbMapped(); ++i) {
    const Entity entity = process->Mapped(i);
    if (entity.IsNull() || !is_solid(entity)) continue;
    const TopoDS_Shape result = TransferBRep::ShapeResult(process, entity);
    const Item item = Item::DownCast(entity);
    std::string label = item.IsNull() || item->Name().IsNull() ? "" : item->Name()->ToCString();
    if (label.empty()) label = product_of(graph, entity);
    // One entity may be placed several times.
    for (TopExp_Explorer it(shape, TopAbs_SOLID); !label.empty() && it.More(); it.Next())
      if (it.Current().IsPartner(result)) labels.emplace_back(it.Current(), label);
  }
  return labels;
}

/// Solids that the file has, of which the transfer made none: what they are built on is missing.
void refuse_lost_solids(const STEPControl_Reader& reader, const std::string& path) {
  const opencascade::handle<Interface_InterfaceModel> model = reader.WS()->Model();
  const opencascade::handle<Transfer_TransientProcess> process = reader.WS()->TransferReader()->TransientProcess();
  for (int i = 1; i <= model->NbEntities(); ++i) {
    const Entity entity = model->Value(i);
    if (!is_solid(entity)) continue;
    const TopoDS_Shape result = TransferBRep::ShapeResult(process, entity);
    if (result.IsNull() || !TopExp_Explorer(result, TopAbs_SOLID).More())
      throw InvalidInput(path + ": the STEP file is damaged: its solid " + model->StringLabel(entity)->ToCString() + " cannot be made of it");
  }
}

FileShape transfer_step(const std::string& path, const Monitor& monitor) {
  STEPControl_Reader reader;
  StoppableFile file(path, monitor);
  std::istream stream(&file);
  const bool loaded = load_entities(reader.WS(), path, &stream);
  monitor.check();
  if (!loaded) throw InvalidInput(path + (begins_as_step(path) ? ": the STEP file is damaged or cut off" : ": not a STEP file"));
  const int faults = leave_out_damaged(reader, path);
  const opencascade::handle<OcctProgress> progress = new OcctProgress(monitor);
  reader.TransferRoots(progress->Start());
  monitor.check();
  if (reader.NbShapes() == 0) throw InvalidInput(path + ": the STEP file holds no shape");
  refuse_lost_solids(reader, path);
  FileShape read{reader.OneShape(), declared_tolerance(*reader.WS()->Model()), {}};
  read.labels = solid_labels(reader, read.shape);
  if (faults > 0)
    read.warnings.push_back("OpenCASCADE finds " + std::to_string(faults) + (faults == 1 ? " fault" : " faults") +
                            " in the STEP file; the solid is not built on any of them");
  return read;
}

}  // namespace

FileShape read_step(const std::string& path, const Monitor& monitor) {
  const ReaderGuard guard;
  return catching_faults([&] { return transfer_step(path, monitor); });
}

}  // namespace polycube
