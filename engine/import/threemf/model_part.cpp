#include "engine/import/threemf/model_part.h"

#include <array>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "engine/import/import_error.h"
#include "engine/import/mesh/coordinate.h"
#include "engine/import/mesh/text_cursor.h"
#include "engine/import/threemf/xml_parser.h"

namespace lamina::engine {
namespace {

/// Names inside the archive have no leading slash.
std::string part_name(std::string_view path) {
  if (path.substr(0, 1) == "/") path.remove_prefix(1);
  return std::string(path);
}

void parse_part(ZipArchive& archive, const std::string& name, XmlHandler& handler, const std::string& file) {
  XmlParser parser(handler, file);
  archive.read(name, [&parser](std::string_view piece) { parser.feed(piece); });
  parser.finish();
}

/// Takes the elements of a model part as they come.
class ModelPartReader : public XmlHandler {
 public:
  ModelPartReader(const std::string& name, const std::string& file, BreachLog& log)
      : name_(name), file_(file), log_(log) {
    part_.unit.name = "millimeter";
  }

  void start(std::string_view name, const XmlAttributes& attributes) override {
    if (name == "vertex") {
      vertex(attributes);
    } else if (name == "triangle") {
      triangle(attributes);
    } else if (name == "model") {
      unit(attributes);
    } else if (name == "object") {
      object(attributes);
    } else if (name == "component") {
      if (object_ == nullptr) fail("a component stands outside of an object");
      object_->components.push_back(use(attributes));
    } else if (name == "item") {
      const std::string_view printable = attributes.find("printable").value_or("1");
      if (printable == "0" || printable == "false") {
        log_.note("build item that is not printable, left out", "XML", line);
      } else {
        part_.build.push_back(use(attributes));
      }
    }
  }

  void end(std::string_view name) override {
    if (name != "object" || object_ == nullptr) return;
    const std::size_t count = object_->mesh.vertices.size();
    for (const auto& facet : object_->mesh.facets) {
      for (const std::uint32_t v : facet) {
        if (v >= count) fail(fmt::format("a triangle names vertex {}, and the object has {}", v, count));
      }
    }
    object_ = nullptr;
  }

  ModelPart take() { return std::move(part_); }

 private:
  [[noreturn]] void fail(const std::string& problem) const {
    throw ImportError({.file = file_, .section = name_, .line = line}, problem, "export the file again");
  }

  std::string_view attribute(const XmlAttributes& attributes, std::string_view name) const {
    const auto value = attributes.find(name);
    if (!value) fail(fmt::format("the attribute \"{}\" is missing", name));
    return *value;
  }

  template <typename Number>
  Number number(std::string_view text, std::string_view name) const {
    const auto value = parse_number<Number>(text);
    if (!value) fail(fmt::format("{} is \"{}\", not a number in range", name, text.substr(0, 40)));
    return *value;
  }

  void unit(const XmlAttributes& attributes) {
    struct Unit {
      std::string_view name;
      double millimetres;
    };
    static constexpr std::array<Unit, 6> kUnits{{{"micron", 0.001},
                                                 {"millimeter", 1.0},
                                                 {"centimeter", 10.0},
                                                 {"inch", 25.4},
                                                 {"foot", 304.8},
                                                 {"meter", 1000.0}}};
    const std::string_view name = attributes.find("unit").value_or("millimeter");
    for (const Unit& known : kUnits) {
      if (known.name != name) continue;
      part_.unit = {0, std::string(name), known.millimetres};
      return;
    }
    fail(fmt::format("the unit \"{}\" is not known", name.substr(0, 40)));
  }

  void object(const XmlAttributes& attributes) {
    const auto id = number<std::uint32_t>(attribute(attributes, "id"), "the object's id");
    const auto [entry, is_new] = part_.objects.try_emplace(id);
    if (!is_new) fail(fmt::format("the object {} is there twice", id));
    object_ = &entry->second;
    const std::string_view type = attributes.find("type").value_or("model");
    object_->is_support = type == "support" || type == "solidsupport" || type == "other";
  }

  ObjectUse use(const XmlAttributes& attributes) const {
    ObjectUse made;
    made.object.part = part_name(attributes.find("path").value_or(name_));
    made.object.id = number<std::uint32_t>(attribute(attributes, "objectid"), "the objectid");
    made.line = line;
    if (const auto text = attributes.find("transform")) made.placement = placement(*text);
    return made;
  }

  /// Twelve numbers: the images of the three axes, then of the origin.
  Eigen::Affine3d placement(std::string_view text) const {
    Eigen::Affine3d result = Eigen::Affine3d::Identity();
    TextCursor cursor(text);
    for (Eigen::Index column = 0; column < 4; ++column) {
      for (Eigen::Index row = 0; row < 3; ++row) {
        const auto value = number<double>(cursor.word_across_lines(), "a number of the transform");
        if (!(std::abs(value) < 1e12)) fail(fmt::format("a number of the transform is {}", value));
        result.matrix()(row, column) = value;
      }
    }
    result.translation() *= part_.unit.millimetres;
    return result;
  }

  void vertex(const XmlAttributes& attributes) {
    if (object_ == nullptr) fail("a vertex stands outside of an object");
    Eigen::Vector3f point;
    Eigen::Index axis = 0;
    for (const std::string_view name : {"x", "y", "z"}) {
      const auto value = number<double>(attribute(attributes, name), name);
      point[axis++] = static_cast<float>(value * part_.unit.millimetres);
    }
    if (!is_usable(point)) fail("a coordinate is no number within 1e9 mm");
    object_->mesh.vertices.push_back(point);
  }

  void triangle(const XmlAttributes& attributes) {
    if (object_ == nullptr) fail("a triangle stands outside of an object");
    std::array<std::uint32_t, 3> facet;
    std::size_t corner = 0;
    for (const std::string_view name : {"v1", "v2", "v3"}) {
      facet[corner++] = number<std::uint32_t>(attribute(attributes, name), name);
    }
    object_->mesh.facets.push_back(facet);
  }

  const std::string& name_;
  const std::string& file_;
  BreachLog& log_;
  ModelPart part_;
  PackageObject* object_ = nullptr;  ///< the one that is open
};

/// Looks for the relationship to the 3D model.
class RelationshipReader : public XmlHandler {
 public:
  void start(std::string_view name, const XmlAttributes& attributes) override {
    constexpr std::string_view kModelType = "/3dmodel";
    const std::string_view type = attributes.find("Type").value_or("");
    if (name != "Relationship" || type.size() < kModelType.size()) return;
    if (type.substr(type.size() - kModelType.size()) != kModelType || !target.empty()) return;
    target = part_name(attributes.find("Target").value_or(""));
  }
  void end(std::string_view) override {}

  std::string target;
};

}  // namespace

ModelPart read_model_part(ZipArchive& archive, const std::string& name, const std::string& file,
                          BreachLog& log) {
  ModelPartReader reader(name, file, log);
  parse_part(archive, name, reader, file);
  return reader.take();
}

std::string find_root_part(ZipArchive& archive, const std::string& file) {
  const std::string kRelationships = "_rels/.rels";
  const std::string kUsual = "3D/3dmodel.model";
  RelationshipReader reader;
  if (archive.holds(kRelationships)) parse_part(archive, kRelationships, reader, file);
  if (!reader.target.empty() && archive.holds(reader.target)) return reader.target;
  if (archive.holds(kUsual)) return kUsual;
  throw ImportError({.file = file}, "is a ZIP archive without a 3D model in it",
                    "if it holds model files, unpack it first");
}

}  // namespace lamina::engine
