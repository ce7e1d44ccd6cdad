#include "tests/support/scan_models.h"

#include <cmath>
#include <numbers>
#include <random>
#include <utility>

namespace lamina::tests {
namespace {

using engine::ScannedPoints;
using engine::Vector3;

class Scanner {
 public:
  explicit Scanner(const ScanSampling& sampling) : sampling_(sampling), random_(sampling.seed) {}

  std::size_t count(double area) const {
    return static_cast<std::size_t>(area / (sampling_.spacing * sampling_.spacing));
  }
  double part() { return std::uniform_real_distribution<double>(0.0, 1.0)(random_); }

  void add(const Vector3& point, const Vector3& normal) {
    const double off = sampling_.noise * std::normal_distribution<double>()(random_);
    if (sampling_.hidden && sampling_.hidden(point)) return;
    points.points.push_back((point + off * normal).cast<float>());
    if (sampling_.with_normals) points.normals.push_back(normal.cast<float>());
  }

  ScannedPoints points;

 private:
  const ScanSampling& sampling_;
  std::mt19937 random_;
};

}  // namespace

ScannedPoints scanned_sphere(const Vector3& center, double radius, const ScanSampling& sampling) {
  constexpr double kPi = std::numbers::pi;
  Scanner scanner(sampling);
  const std::size_t count = scanner.count(4.0 * kPi * radius * radius);
  for (std::size_t i = 0; i < count; ++i) {
    // Equal heights have equal areas (Archimedes).
    const double z = 2.0 * scanner.part() - 1.0;
    const double angle = 2.0 * kPi * scanner.part();
    const double r = std::sqrt(1.0 - z * z);
    const Vector3 normal(r * std::cos(angle), r * std::sin(angle), z);
    scanner.add(center + radius * normal, normal);
  }
  return std::move(scanner.points);
}

ScannedPoints scanned_torus(double middle_radius, double tube_radius, const ScanSampling& sampling) {
  constexpr double kPi = std::numbers::pi;
  Scanner scanner(sampling);
  const std::size_t count = scanner.count(4.0 * kPi * kPi * middle_radius * tube_radius);
  for (std::size_t i = 0; i < count; ++i) {
    const double around = 2.0 * kPi * scanner.part();
    double tube = 2.0 * kPi * scanner.part();
    // The outside has more area: the others are drawn again.
    while (scanner.part() * (middle_radius + tube_radius) > middle_radius + tube_radius * std::cos(tube))
      tube = 2.0 * kPi * scanner.part();
    const Vector3 normal(std::cos(tube) * std::cos(around), std::cos(tube) * std::sin(around),
                         std::sin(tube));
    const Vector3 middle(middle_radius * std::cos(around), middle_radius * std::sin(around), 0.0);
    scanner.add(middle + tube_radius * normal, normal);
  }
  return std::move(scanner.points);
}

engine::Model model_of(ScannedPoints scanned) {
  engine::Model model;
  model.name = "scan";
  model.clouds.push_back(engine::prepare_scan(std::move(scanned)).cloud);
  return model;
}

}  // namespace lamina::tests
