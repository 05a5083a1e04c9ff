// FreeCAD documents (.FCStd): which object is the part, and where FreeCAD shows it.
#include <zip.h>

#include <BRep_Builder.hxx>
#include <TopAbs_ShapeEnum.hxx>
#include <TopExp_Explorer.hxx>
#include <TopLoc_Location.hxx>
#include <TopoDS_Compound.hxx>
#include <boost/property_tree/ptree.hpp>
#include <boost/property_tree/xml_parser.hpp>
#include <cmath>
#include <filesystem>
#include <gp_Quaternion.hxx>
#include <gp_Trsf.hxx>
#include <map>
#include <optional>
#include <set>
#include <sstream>

#include "cad/shape.h"
#include "core/error.h"

namespace polycube {
namespace {

using Tree = boost::property_tree::ptree;

class Archive {
 public:
  explicit Archive(const std::string& path) : path_(path) {
    int error = 0;
    zip_.reset(zip_open(path.c_str(), ZIP_RDONLY, &error));
    if (!zip_) throw InvalidInput(path + " is not a FreeCAD document");
  }
  std::string read(const std::string& name) const {
    zip_stat_t stat;
    const std::unique_ptr<zip_file_t, int (*)(zip_file_t*)> file(zip_fopen(zip_.get(), name.c_str(), 0), zip_fclose);
    if (!file || zip_stat(zip_.get(), name.c_str(), 0, &stat) != 0) throw InvalidInput(path_ + " has no " + name);
    const auto damaged = [&] { return InvalidInput(path_ + ": " + name + " is damaged"); };
    // Deflate makes at most 1032 bytes of one: a length beyond that is a damaged one, not to be believed.
    constexpr zip_uint64_t kMostDeflated = 1032;
    if (!(stat.valid & ZIP_STAT_SIZE) || !(stat.valid & ZIP_STAT_COMP_SIZE) || stat.size / kMostDeflated > stat.comp_size) throw damaged();
    if (stat.comp_size > std::filesystem::file_size(path_)) throw damaged();
    std::string text(stat.size, '\0');
    if (zip_fread(file.get(), text.data(), text.size()) != static_cast<zip_int64_t>(text.size())) throw damaged();
    return text;
  }

 private:
  struct Close {
    void operator()(zip_t* zip) const { zip_discard(zip); }
  };
  std::string path_;
  std::unique_ptr<zip_t, Close> zip_;
};

struct DocumentObject {
  std::string name, label, type, shape_file;
  gp_Trsf placement;
  std::string tip;                 ///< of a PartDesign body
  std::vector<std::string> group;  ///< what it contains
  std::set<std::string> links;     ///< all objects that its properties name
  std::string container, body;     ///< names of the container and of the body it is in, or empty

  bool is_body() const { return type == "PartDesign::Body"; }
  /// Whether the objects in it have their coordinates from it. A plain group has none.
  bool has_coordinates() const { return is_body() || type == "App::Part"; }
  std::string title() const { return label.empty() || label == name ? name : name + " \"" + label + "\""; }
};

std::string attribute(const Tree& node, const std::string& name) { return node.get<std::string>("<xmlattr>." + name, ""); }

gp_Trsf placement_of(const Tree& node) {
  const auto number = [&](const char* name) { return node.get<double>(std::string("<xmlattr>.") + name, 0); };
  const gp_Quaternion turn(number("Q0"), number("Q1"), number("Q2"), number("Q3"));
  gp_Trsf result;
  if (turn.Norm() > 0) result.SetRotation(turn.Normalized());
  result.SetTranslationPart({number("Px"), number("Py"), number("Pz")});
  return result;
}

/// Links of all kinds: <Link value="Pad"/>, <LinkSub value="Sketch">, <Link obj="Box" sub="Face1"/>, <XLink name="Box" file="">.
void collect_links(const Tree& property, std::set<std::string>& links) {
  for (const auto& [tag, node] : property) {
    if (tag == "Link" || tag == "LinkSub" || tag == "XLink" || tag == "XLinkSub") {
      for (const char* key : {"value", "obj", "name"}) {
        // A link into another file names an object that this one may have too.
        if (const std::string target = attribute(node, key); !target.empty() && attribute(node, "file").empty()) links.insert(target);
      }
    }
    if (tag != "<xmlattr>") collect_links(node, links);
  }
}

// Of a link, after its name.
constexpr const char* kLink = ", which is a link: the workbench in FreeCAD follows links, a STEP file holds what they lead to";

/// Of an object that FreeCAD could not compute, or has not.
class NoShape : public InvalidInput {
 public:
  using InvalidInput::InvalidInput;
};

class Document {
 public:
  explicit Document(const std::string& path) : path_(path), archive_(path) {
    Tree xml;
    std::istringstream text(archive_.read("Document.xml"));
    boost::property_tree::read_xml(text, xml);
    std::map<std::string, std::string> types;
    for (const auto& [tag, node] : xml.get_child("Document.Objects")) {
      if (tag == "Object") types[attribute(node, "name")] = attribute(node, "type");
    }
    for (const auto& [tag, node] : xml.get_child("Document.ObjectData")) {
      if (tag != "Object") continue;
      DocumentObject object = read_object(node);
      object.type = types[object.name];
      if (index_.emplace(object.name, objects_.size()).second) objects_.push_back(std::move(object));
    }
    for (const auto& [tag, node] : xml.get_child("Document.Objects")) {
      if (tag != "ObjectDeps" || !find(attribute(node, "Name"))) continue;
      for (const auto& [dep_tag, dep] : node)
        if (dep_tag == "Dep") find(attribute(node, "Name"))->links.insert(attribute(dep, "Name"));
    }
    find_containers();
  }

  FileShape take(const std::string& wanted, const Monitor& monitor) {
    if (!wanted.empty()) {
      std::vector<const DocumentObject*> chosen = named(wanted, monitor);
      if (chosen.empty()) {
        std::istringstream list(wanted);
        for (std::string one; std::getline(list, one, ',');) {
          const std::vector<const DocumentObject*> more = named(one, monitor);
          if (more.empty()) throw InvalidInput(path_ + " has no object with a shape named '" + one + "'");
          chosen.insert(chosen.end(), more.begin(), more.end());
        }
      }
      return together(chosen, monitor);
    }
    const std::vector<const DocumentObject*> candidates = finals("", monitor);
    if (candidates.empty()) throw InvalidInput(unreadable_.empty() ? path_ + " has no object with a shape" : unreadable_.back().reason);
    if (candidates.size() == 1) return together(candidates, monitor);
    throw InvalidInput(path_ + " has several solids: choose one with --object (" + titles(candidates) + "), or some as --object A,B");
  }

 private:
  struct Unreadable {
    const DocumentObject* object;
    std::string reason;
    bool empty;
  };

  static std::string titles(const std::vector<const DocumentObject*>& objects) {
    std::string text;
    for (const DocumentObject* object : objects) text += (text.empty() ? "" : ", ") + object->title();
    return text;
  }

  static DocumentObject read_object(const Tree& node) {
    DocumentObject object;
    object.name = attribute(node, "name");
    for (const auto& [tag, property] : node.get_child("Properties")) {
      if (tag != "Property") continue;
      const std::string name = attribute(property, "name");
      collect_links(property, object.links);
      if (name == "Label") object.label = property.get<std::string>("String.<xmlattr>.value", "");
      if (name == "Shape") object.shape_file = property.get<std::string>("Part.<xmlattr>.file", "");
      if (name == "Tip") object.tip = property.get<std::string>("Link.<xmlattr>.value", "");
      if (name == "Placement")
        if (const auto found = property.get_child_optional("PropertyPlacement")) object.placement = placement_of(*found);
      if (name == "Group")
        if (const auto list = property.get_child_optional("LinkList"))
          for (const auto& [link_tag, link] : *list)
            if (link_tag == "Link") object.group.push_back(attribute(link, "value"));
    }
    object.links.erase(object.name);
    return object;
  }

  /// The object of that name or label, or what is in it where it has no shape of its own.
  std::vector<const DocumentObject*> named(const std::string& wanted, const Monitor& monitor) {
    // Names are unique, labels need not be; a name goes first.
    const DocumentObject* object = find(wanted);
    for (const DocumentObject& o : objects_)
      if (!object && o.label == wanted) object = &o;
    if (!object) return {};
    if (is_link(*object)) throw InvalidInput(path_ + ": " + object->title() + kLink);
    return object->shape_file.empty() ? finals(object->name, monitor) : std::vector<const DocumentObject*>{object};
  }

  /// The shape of one object, or a compound of several.
  FileShape together(const std::vector<const DocumentObject*>& objects, const Monitor& monitor) {
    std::vector<FileShape> shapes;
    for (const DocumentObject* object : objects) {
      FileShape& read = shapes.emplace_back(shape_of(*object, monitor));
      for (TopExp_Explorer it(read.shape, TopAbs_SOLID); it.More(); it.Next())
        read.labels.emplace_back(it.Current(), object->label.empty() ? object->name : object->label);
    }
    for (const std::string& line : left_out_) shapes.front().warnings.push_back(line);
    if (shapes.size() == 1) return shapes.front();
    FileShape all;
    all.warnings = shapes.front().warnings;
    TopoDS_Compound compound;
    BRep_Builder().MakeCompound(compound);
    for (FileShape& read : shapes) {
      BRep_Builder().Add(compound, read.shape);
      all.labels.insert(all.labels.end(), read.labels.begin(), read.labels.end());
    }
    all.shape = compound;
    return all;
  }

  DocumentObject* find(const std::string& name) {
    const auto at = index_.find(name);
    return at == index_.end() ? nullptr : &objects_[at->second];
  }

  void find_containers() {
    for (const DocumentObject& container : objects_) {
      for (const std::string& name : container.group) {
        DocumentObject* member = find(name);
        if (!member || member == &container) continue;
        // An object may be in a plain group and in the part around the group.
        if (member->container.empty() || container.has_coordinates()) member->container = container.name;
        if (container.is_body()) member->body = container.name;
      }
      // The tip of a body is in it, whatever an old file says of its group.
      if (DocumentObject* tip = container.is_body() ? find(container.tip) : nullptr) tip->body = tip->container = container.name;
    }
  }

  /// The containers' placements, outermost first, multiplied.
  gp_Trsf place_of(const DocumentObject& object) {
    gp_Trsf place;
    std::set<std::string> seen{object.name};
    for (const DocumentObject* at = find(object.container); at && seen.insert(at->name).second; at = find(at->container)) {
      if (at->has_coordinates()) place.PreMultiply(at->placement);
    }
    return place;
  }

  bool inside(const DocumentObject& object, const std::string& container) {
    std::set<std::string> seen;
    for (const DocumentObject* at = &object; at && seen.insert(at->name).second; at = find(at->container))
      if (at->container == container) return true;
    return false;
  }

  TopoDS_Shape stored_shape(const DocumentObject& object, const Monitor& monitor) {
    if (std::filesystem::path(object.shape_file).extension() != ".brp")
      throw InvalidInput("object " + object.name + ": its shape is stored in binary; save the document with text shapes, or export STEP");
    const std::string text = archive_.read(object.shape_file);
    return text.empty() ? TopoDS_Shape() : parse_brep(text, monitor).shape;
  }

  FileShape shape_of(const DocumentObject& object, const Monitor& monitor) {
    try {
      TopoDS_Shape shape = object.shape_file.empty() ? TopoDS_Shape() : stored_shape(object, monitor);
      gp_Trsf place = place_of(object);
      if (object.is_body() && !TopExp_Explorer(shape, TopAbs_FACE).More()) {
        const DocumentObject* tip = find(object.tip);
        shape = tip && !tip->shape_file.empty() ? stored_shape(*tip, monitor) : TopoDS_Shape();
        if (tip) place = place_of(*tip);
      }
      if (shape.IsNull()) throw NoShape(path_ + ": " + object.title() + " has no shape: recompute it in FreeCAD");
      return {shape.Moved(TopLoc_Location(place)), 0, {}};
    } catch (const NoShape&) {
      throw;
    } catch (const InvalidInput& error) {
      throw InvalidInput(path_ + ": " + object.title() + ": " + error.what());
    }
  }

  /// Objects in the container ("": anywhere) with a solid, or with faces where none has a solid, that no other such object is built from.
  std::vector<const DocumentObject*> finals(const std::string& container, const Monitor& monitor) {
    std::vector<const DocumentObject*> solids, surfaces;
    for (const DocumentObject& object : objects_) {
      if (is_link(object) && (container.empty() || inside(object, container))) leave_out(object.title() + kLink);
      // Of a body the body itself counts: what is in it are steps towards its tip.
      if ((object.shape_file.empty() && !object.is_body()) || !object.body.empty()) continue;
      if (!container.empty() && !inside(object, container)) continue;
      monitor.check();
      try {
        const TopoDS_Shape shape = shape_of(object, monitor).shape;
        if (TopExp_Explorer(shape, TopAbs_SOLID).More()) {
          solids.push_back(&object);
        } else if (TopExp_Explorer(shape, TopAbs_FACE).More()) {
          surfaces.push_back(&object);
        } else {
          continue;
        }
      } catch (const NoShape& error) {
        unreadable_.push_back({&object, error.what(), true});
      } catch (const InvalidInput& error) {
        unreadable_.push_back({&object, error.what(), false});
      }
    }
    std::vector<const DocumentObject*>& found = solids.empty() ? surfaces : solids;
    std::set<std::string> used;
    for (const DocumentObject* object : found) {
      for (const std::string& name : built_from(*object)) used.insert(name);
    }
    std::erase_if(found, [&](const DocumentObject* object) { return used.contains(object->name); });
    note_unreadable(found);
    return found;
  }

  /// The file holds no shape of a link.
  bool is_link(const DocumentObject& object) {
    if (!object.type.starts_with("App::Link") || !object.shape_file.empty()) return false;
    return std::any_of(object.links.begin(), object.links.end(), [&](const std::string& name) {
      const DocumentObject* target = find(name);
      return target && (!target->shape_file.empty() || target->has_coordinates() || target->type.starts_with("App::Link"));
    });
  }

  void leave_out(const std::string& what) {
    const std::string line = "left out: " + what;
    if (std::find(left_out_.begin(), left_out_.end(), line) == left_out_.end()) left_out_.push_back(line);
  }

  /// An object whose shape is damaged, or that was to be made of one found and is not there, may be the part: it is not passed over without a word.
  void note_unreadable(const std::vector<const DocumentObject*>& found) {
    for (const Unreadable& u : unreadable_) {
      const std::set<std::string> sources = built_from(*u.object);
      const bool replaced = std::any_of(found.begin(), found.end(), [&](const DocumentObject* object) { return sources.contains(object->name); });
      if (!found.empty() && (!u.empty || replaced)) throw InvalidInput(u.reason + "; another can be chosen with --object (" + titles(found) + ")");
      leave_out(u.object->title() + ", which has no shape");
    }
  }

  /// Names of the objects that this one, or a step of this body, links to; a step of another body stands for that body.
  std::set<std::string> built_from(const DocumentObject& object) {
    std::set<std::string> links = object.links, result;
    for (const DocumentObject& step : objects_)
      if (step.body == object.name) links.insert(step.links.begin(), step.links.end());
    for (const std::string& name : links) {
      const DocumentObject* target = find(name);
      if (target) result.insert(target->body.empty() ? name : target->body);
    }
    result.erase(object.name);
    return result;
  }

  std::string path_;
  Archive archive_;
  std::vector<DocumentObject> objects_;
  std::map<std::string, std::size_t> index_;
  std::vector<Unreadable> unreadable_;
  std::vector<std::string> left_out_;  ///< warnings
};

}  // namespace

FileShape read_document(const std::string& path, const std::string& object, const Monitor& monitor) {
  try {
    return Document(path).take(object, monitor);
  } catch (const boost::property_tree::ptree_error& error) {
    throw InvalidInput(path + " is not a FreeCAD document: " + error.what());
  }
}

}  // namespace polycube
