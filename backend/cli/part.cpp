#include "cli/part.h"

#include <zip.h>

#include <algorithm>
#include <boost/property_tree/ptree.hpp>
#include <boost/property_tree/xml_parser.hpp>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <sstream>

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
    std::string text(stat.size, '\0');
    if (zip_fread(file.get(), text.data(), text.size()) != static_cast<zip_int64_t>(text.size()))
      throw InvalidInput(path_ + ": " + name + " is damaged");
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
  std::string name, label, shape_file;
};

std::string attribute(const Tree& node, const std::string& name) { return node.get<std::string>("<xmlattr>." + name, ""); }

/// Objects of the document that have a shape and that no other object with a shape is built from.
std::vector<DocumentObject> shaped_objects(const Archive& archive, bool final_only) {
  Tree document;
  std::istringstream text(archive.read("Document.xml"));
  boost::property_tree::read_xml(text, document);
  std::vector<DocumentObject> objects;
  std::set<std::string> shaped;
  for (const auto& [tag, node] : document.get_child("Document.ObjectData")) {
    if (tag != "Object") continue;
    DocumentObject object{attribute(node, "name"), "", ""};
    for (const auto& [property_tag, property] : node.get_child("Properties")) {
      if (property_tag != "Property") continue;
      if (attribute(property, "name") == "Label") object.label = property.get<std::string>("String.<xmlattr>.value", "");
      if (attribute(property, "name") == "Shape") object.shape_file = property.get<std::string>("Part.<xmlattr>.file", "");
    }
    if (object.shape_file.empty()) continue;
    shaped.insert(object.name);
    objects.push_back(std::move(object));
  }
  if (!final_only) return objects;
  std::set<std::string> used;
  for (const auto& [tag, node] : document.get_child("Document.Objects")) {
    if (tag != "ObjectDeps" || !shaped.contains(attribute(node, "Name"))) continue;
    for (const auto& [dep_tag, dep] : node)
      if (dep_tag == "Dep") used.insert(attribute(dep, "Name"));
  }
  std::erase_if(objects, [&](const DocumentObject& object) { return used.contains(object.name); });
  return objects;
}

CadModel read_object(const Archive& archive, const DocumentObject& object) {
  if (std::filesystem::path(object.shape_file).extension() != ".brp")
    throw InvalidInput("object " + object.name + ": its shape is stored in binary; save the document with text shapes, or export STEP");
  return CadModel::from_brep(archive.read(object.shape_file));
}

CadModel read_document(const std::string& path, const std::string& wanted) {
  const Archive archive(path);
  if (!wanted.empty()) {
    for (const DocumentObject& object : shaped_objects(archive, false))
      if (object.name == wanted || object.label == wanted) return read_object(archive, object);
    throw InvalidInput(path + " has no object with a shape named '" + wanted + "'");
  }
  const auto objects = shaped_objects(archive, true);
  std::optional<CadModel> found;
  std::string names, complaint;
  for (const DocumentObject& object : objects) {
    try {
      CadModel model = read_object(archive, object);
      names += (names.empty() ? "" : ", ") + object.name;
      found.emplace(std::move(model));
    } catch (const InvalidInput& e) {
      complaint = object.name + ": " + e.what();
    }
  }
  if (names.find(',') != std::string::npos) throw InvalidInput(path + " has several solids: choose one with --object (" + names + ")");
  if (found) return *found;
  throw InvalidInput(path + (objects.empty() ? " has no object with a shape" : ": " + complaint));
}

}  // namespace

CadModel read_part(const std::string& path, const std::string& object) {
  std::string suffix = std::filesystem::path(path).extension().string();
  std::transform(suffix.begin(), suffix.end(), suffix.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (!std::filesystem::exists(path)) throw InvalidInput(path + " does not exist");
  if (suffix != ".fcstd") {
    if (!object.empty()) throw InvalidInput("--object is for FreeCAD documents only");
    return CadModel::read(path);
  }
  try {
    return read_document(path, object);
  } catch (const boost::property_tree::ptree_error& e) {
    throw InvalidInput(path + " is not a FreeCAD document: " + e.what());
  }
}

}  // namespace polycube
