#include "tests/reference/pointcloud/patch_lists.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <catch2/catch.hpp>

#include "tests/reference/pointcloud/decompose.h"
#include "tests/support/analytic_models.h"

namespace lamina::tests {
namespace {

using reference::ActiveList;
using reference::ListedPatch;

constexpr double kEpsilon = 0.1;
const reference::SampleOptions sampling{kEpsilon, 2.0};

std::vector<ListedPatch> listed(const engine::Model& model, double layer_thickness) {
  return reference::make_global_list(reference::decompose(model, {layer_thickness, 3}));
}

std::set<std::size_t> active_indices(const ActiveList& list) {
  std::set<std::size_t> indices;
  for (const reference::ActivePatch& patch : list.patches()) indices.insert(patch.index);
  return indices;
}

}  // namespace

TEST_CASE("the global list rises by the lower end of each patch and keeps the model's order among equals",
          "[patch-lists]") {
  const std::vector<ListedPatch> list = listed(sphere({0, 0, 0}, 3.0).model, 0.2);
  for (std::size_t k = 1; k < list.size(); ++k) CHECK(list[k - 1].box.min().z() <= list[k].box.min().z());

  // Flat patches at the same height, told apart by their place.
  std::vector<engine::BezierPatch> level;
  for (const double x : {5.0, 1.0, 3.0}) {
    const auto patches = engine::bezier_patches(bilinear({x, 0, 1}, {x + 1, 0, 1}, {x, 1, 1}, {x + 1, 1, 1}));
    level.insert(level.end(), patches.begin(), patches.end());
  }
  const std::vector<ListedPatch> kept = reference::make_global_list(level);
  CHECK(kept[0].box.min().x() == 5.0);
  CHECK(kept[1].box.min().x() == 1.0);
  CHECK(kept[2].box.min().x() == 3.0);
}

TEST_CASE("a listed patch's box contains it", "[patch-lists]") {
  for (const ListedPatch& listed_patch : listed(flat_torus({0, 0, 0}, 3.0, 1.0).model, 0.5)) {
    const engine::Box3 box(listed_patch.box.min() - engine::Vector3::Constant(1e-12),
                           listed_patch.box.max() + engine::Vector3::Constant(1e-12));
    for (const double u : {0.0, 0.5, 1.0}) {
      for (const double v : {0.0, 0.3, 1.0}) CHECK(box.contains(engine::evaluate(listed_patch.patch, u, v)));
    }
  }
}

TEST_CASE("the active list holds exactly the patches that the plane may meet", "[patch-lists]") {
  const std::vector<ListedPatch> global_list = listed(sphere({0, 0, 0}, 3.0).model, 0.2);
  ActiveList active(global_list, 0.2, 6.0);
  std::set<std::size_t> before;
  for (double z = -3.5; z <= 3.5; z += 0.2) {
    active.advance(global_list, z, kEpsilon, sampling);
    std::set<std::size_t> expected;
    for (std::size_t k = 0; k < global_list.size(); ++k) {
      const engine::Box3& box = global_list[k].box;
      if (box.min().z() <= z + kEpsilon && box.max().z() >= z - kEpsilon) expected.insert(k);
    }
    CAPTURE(z);
    const std::set<std::size_t> now = active_indices(active);
    CHECK(now == expected);
    CHECK(now.size() == active.patches().size());  // none twice
    std::size_t came = 0;
    for (const std::size_t k : now) came += before.count(k) == 0 ? 1U : 0U;
    std::size_t went = 0;
    for (const std::size_t k : before) went += now.count(k) == 0 ? 1U : 0U;
    CHECK(active.added() == came);
    CHECK(active.removed() == went);
    before = now;
  }
  CHECK(active.patches().empty());  // the plane has passed the model: no point is held any more
}

TEST_CASE("a patch is sampled once and its points stay while it is active", "[patch-lists]") {
  const std::vector<ListedPatch> global_list = listed(sphere({0, 0, 0}, 3.0).model, 0.5);
  ActiveList active(global_list, 0.5, 6.0);
  active.advance(global_list, 0.0, kEpsilon, sampling);
  REQUIRE_FALSE(active.patches().empty());
  std::set<const engine::Vector3*> stored;
  for (const reference::ActivePatch& patch : active.patches()) {
    CHECK(patch.points == reference::sample(global_list[patch.index].patch, sampling));
    stored.insert(patch.points.data());
  }
  active.advance(global_list, 0.01, kEpsilon, sampling);
  CHECK(active.added() < active.patches().size());
  std::size_t moved_only = 0;
  for (const reference::ActivePatch& patch : active.patches())
    moved_only += stored.count(patch.points.data());
  CHECK(moved_only + active.added() == active.patches().size());
}

TEST_CASE("the active list is allocated for one layer's share and grows by doubling", "[patch-lists]") {
  const std::vector<ListedPatch> global_list = listed(sphere({0, 0, 0}, 3.0).model, 0.2);
  const auto share = static_cast<std::size_t>(std::ceil(static_cast<double>(global_list.size()) * 0.2 / 6.0));
  ActiveList active(global_list, 0.2, 6.0);
  REQUIRE(active.patches().capacity() == share);
  for (double z = -3.0; z <= 0.0; z += 0.2) active.advance(global_list, z, kEpsilon, sampling);
  REQUIRE(active.patches().size() > share);
  const auto growth = static_cast<double>(active.patches().capacity()) / static_cast<double>(share);
  CHECK(std::exp2(std::round(std::log2(growth))) == growth);
}

TEST_CASE("patches between two planes are passed over", "[patch-lists]") {
  const std::vector<ListedPatch> global_list = listed(sphere({0, 0, 0}, 3.0).model, 0.2);
  ActiveList active(global_list, 0.2, 6.0);
  active.advance(global_list, 10.0, kEpsilon, sampling);
  CHECK(active.patches().empty());
  CHECK(active.added() == 0);
}

TEST_CASE("an empty model has empty lists", "[patch-lists]") {
  const std::vector<ListedPatch> none = reference::make_global_list({});
  ActiveList active(none, 0.2, 0.0);
  active.advance(none, 1.0, kEpsilon, sampling);
  CHECK(active.patches().empty());
}

}  // namespace lamina::tests
