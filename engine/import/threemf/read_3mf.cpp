#include "engine/import/threemf/read_3mf.h"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "engine/import/breach_log.h"
#include "engine/import/import_error.h"
#include "engine/import/mesh/coordinate.h"
#include "engine/import/threemf/model_part.h"

namespace lamina::engine {
namespace {

constexpr int kDeepestNesting = 32;

/// Unfolds the build of a package into meshes.
class PackageReader {
 public:
  PackageReader(std::string_view bytes, const std::string& file, std::size_t max_bytes)
      : archive_(bytes, file, max_bytes), file_(file) {}

  ImportResult read() {
    const std::string root = find_root_part(archive_, file_);
    const ModelPart& part = this->part(root);
    ImportResult result;
    result.report.format = "3MF";
    result.report.unit = part.unit;
    if (part.build.empty()) {
      // Some writers forget the build: then every object that is part of no other stands for itself.
      log_.note("build without items, all objects taken", root, 0);
      for (const auto& [id, object] : part.objects) {
        if (!is_component(part, id))
          place({{root, id}, Eigen::Affine3d::Identity(), 0}, Eigen::Affine3d::Identity(), 0);
      }
    }
    for (const ObjectUse& item : part.build) place(item, Eigen::Affine3d::Identity(), 0);
    if (meshes_.empty())
      throw ImportError({.file = file_}, "nothing to slice: no object with triangles is built");
    result.model.name = file_;
    result.model.meshes = std::move(meshes_);
    result.report.tolerated = log_.list();
    return result;
  }

 private:
  static bool is_component(const ModelPart& part, std::uint32_t id) {
    return std::any_of(part.objects.begin(), part.objects.end(), [id](const auto& entry) {
      const auto& components = entry.second.components;
      return std::any_of(components.begin(), components.end(),
                         [id](const ObjectUse& use) { return use.object.id == id; });
    });
  }

  const ModelPart& part(const std::string& name) {
    const auto known = parts_.find(name);
    if (known != parts_.end()) return known->second;
    ModelPart read = read_model_part(archive_, name, file_, log_);
    for (const auto& [id, object] : read.objects) facets_read_ += object.mesh.facets.size();
    return parts_.emplace(name, std::move(read)).first->second;
  }

  void place(const ObjectUse& use, const Eigen::Affine3d& outer, int depth) {
    const auto fail = [&](const std::string& problem) {
      throw ImportError({.file = file_, .section = use.object.part, .line = use.line}, problem,
                        "export the file again");
    };
    if (depth > kDeepestNesting)
      fail(fmt::format("objects contain each other, or are nested deeper than {}", kDeepestNesting));
    if (!archive_.holds(use.object.part)) fail(fmt::format("the archive has no part {}", use.object.part));
    const auto& objects = part(use.object.part).objects;
    const auto found = objects.find(use.object.id);
    if (found == objects.end()) fail(fmt::format("there is no object {}", use.object.id));
    const PackageObject& object = found->second;
    if (object.is_support) {
      log_.note("support object, left out", use.object.part, use.line);
      return;
    }
    const Eigen::Affine3d placement = outer * use.placement;
    spend(object.mesh.facets.size() + 1, fail);
    if (!object.mesh.facets.empty()) {
      // 3MF Core Specification, section 4.1: what overlaps is united.
      meshes_.push_back(placed(object.mesh, placement, fail));
      meshes_.back().solid = static_cast<std::uint32_t>(meshes_.size());
    }
    for (const ObjectUse& component : object.components) place(component, placement, depth + 1);
  }

  template <typename Fail>
  TriangleMesh placed(const TriangleMesh& mesh, const Eigen::Affine3d& placement, const Fail& fail) const {
    TriangleMesh result = mesh;
    if (placement.matrix().isIdentity(0.0)) return result;
    for (Eigen::Vector3f& vertex : result.vertices) {
      vertex = (placement * vertex.cast<double>()).cast<float>();
      if (!is_usable(vertex)) fail("a placement moves a vertex beyond 1e9 mm");
    }
    return result;
  }

  /// Objects may be used often, but not without bound: each use makes its triangles again.
  template <typename Fail>
  void spend(std::size_t facets, const Fail& fail) {
    constexpr std::size_t kCopies = 64;
    constexpr std::size_t kAlwaysAllowed = 1U << 20U;
    facets_made_ += facets;
    if (facets_made_ > kAlwaysAllowed + kCopies * facets_read_)
      fail("components unfold to more triangles than a file of this size can mean");
  }

  ZipArchive archive_;
  const std::string& file_;
  BreachLog log_;
  std::map<std::string, ModelPart> parts_;
  std::vector<TriangleMesh> meshes_;
  std::size_t facets_read_ = 0;
  std::size_t facets_made_ = 0;
};

}  // namespace

bool looks_like_zip(std::string_view bytes) {
  return bytes.substr(0, 4) == "PK\x03\x04" || bytes.substr(0, 4) == "PK\x05\x06";
}

ImportResult read_3mf(std::string_view bytes, const std::string& file, std::size_t max_bytes) {
  return PackageReader(bytes, file, max_bytes).read();
}

}  // namespace lamina::engine
