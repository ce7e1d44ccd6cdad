#include "engine/geometry/bspline_basis.h"

#include <cmath>
#include <numeric>
#include <random>

#include <catch2/catch.hpp>

namespace lamina::tests {
namespace {

using engine::Knots;

/// The recursion of Cox and de Boor, straight from its definition: function i of degree p at t.
double cox_de_boor(const Knots& knots, std::size_t i, std::size_t p, double t) {
  if (p == 0) {
    const bool last_span = knots[i] < knots[i + 1] && knots[i + 1] == knots.back() && t == knots.back();
    return (knots[i] <= t && t < knots[i + 1]) || last_span ? 1.0 : 0.0;
  }
  double value = 0.0;
  if (knots[i + p] > knots[i])
    value += (t - knots[i]) / (knots[i + p] - knots[i]) * cox_de_boor(knots, i, p - 1, t);
  if (knots[i + p + 1] > knots[i + 1]) {
    value += (knots[i + p + 1] - t) / (knots[i + p + 1] - knots[i + 1]) * cox_de_boor(knots, i + 1, p - 1, t);
  }
  return value;
}

struct Case {
  int degree;
  Knots knots;
};

std::vector<Case> cases() {
  return {{1, {0, 0, 1, 1}},
          {2, {0, 0, 0, 1, 2, 2, 5, 5, 5}},
          {3, {-1, -1, -1, -1, 0.2, 0.7, 0.7, 0.7, 3, 3, 3, 3}},
          {3, {0, 1, 2, 3, 4, 5, 6, 7, 8}},       // unclamped
          {2, {-2, -1, 0, 0.5, 1.5, 2, 4, 4.5}},  // unclamped, uneven
          {5, {0, 0, 0, 0, 0, 0, 1, 4, 4, 9, 9, 9, 9, 9, 9}},
          {4, {0, 0, 0, 0, 0, 1e-3, 1, 1, 1, 1, 1}}};
}

std::vector<double> parameters_of(const Case& sample) {
  const auto p = static_cast<std::size_t>(sample.degree);
  const double first = sample.knots[p];
  const double last = sample.knots[sample.knots.size() - 1 - p];
  std::vector<double> parameters(sample.knots.begin() + sample.degree, sample.knots.end() - sample.degree);
  for (int k = 0; k <= 50; ++k) parameters.push_back(first + (last - first) * k / 50.0);
  return parameters;
}

}  // namespace

TEST_CASE("a span contains its parameter", "[basis]") {
  for (const Case& sample : cases()) {
    const auto p = static_cast<std::size_t>(sample.degree);
    const double last = sample.knots[sample.knots.size() - 1 - p];
    for (const double t : parameters_of(sample)) {
      CAPTURE(sample.degree, t);
      const std::size_t span = engine::find_span(sample.knots, sample.degree, t);
      CHECK(span >= p);
      CHECK(span + p + 1 < sample.knots.size());
      CHECK(sample.knots[span] < sample.knots[span + 1]);
      CHECK(sample.knots[span] <= t);
      CHECK((t < sample.knots[span + 1] || t == last));
      CHECK(t <= sample.knots[span + 1]);
    }
  }
}

TEST_CASE("basis functions agree with the recursion of Cox and de Boor and sum to one", "[basis]") {
  for (const Case& sample : cases()) {
    const auto p = static_cast<std::size_t>(sample.degree);
    for (const double t : parameters_of(sample)) {
      CAPTURE(sample.degree, t);
      const std::size_t span = engine::find_span(sample.knots, sample.degree, t);
      const engine::BasisRow values = engine::basis_functions(sample.knots, sample.degree, span, t);
      REQUIRE(values.size() == p + 1);
      CHECK(std::accumulate(values.begin(), values.end(), 0.0) == Approx(1.0).margin(1e-13));
      const bool end_inside_knots =
          t == sample.knots[sample.knots.size() - 1 - p] && t != sample.knots.back();
      if (end_inside_knots) continue;  // the recursion takes the span to the right, outside the domain
      for (std::size_t r = 0; r <= p; ++r) {
        CHECK(values[r] == Approx(cox_de_boor(sample.knots, span - p + r, p, t)).margin(1e-13));
        CHECK(values[r] >= 0.0);
      }
    }
  }
}

TEST_CASE("derivatives of basis functions agree with central differences", "[basis]") {
  constexpr double kStep = 1e-5;
  for (const Case& sample : cases()) {
    for (std::size_t i = 0; i + 1 < engine::break_points(sample.knots, sample.degree).size(); ++i) {
      const std::vector<double> breaks = engine::break_points(sample.knots, sample.degree);
      if (breaks[i + 1] - breaks[i] < 0.1) continue;
      for (const double share : {0.2, 0.5, 0.9}) {
        const double t = breaks[i] + share * (breaks[i + 1] - breaks[i]);
        const std::size_t span = engine::find_span(sample.knots, sample.degree, t);
        const auto rows = engine::basis_derivatives(sample.knots, sample.degree, span, t);
        const auto low = engine::basis_functions(sample.knots, sample.degree, span, t - kStep);
        const auto middle = engine::basis_functions(sample.knots, sample.degree, span, t);
        const auto high = engine::basis_functions(sample.knots, sample.degree, span, t + kStep);
        CAPTURE(sample.degree, t);
        REQUIRE(rows.size() == 3);
        for (std::size_t r = 0; r < middle.size(); ++r) {
          CHECK(rows[0][r] == Approx(middle[r]).margin(1e-14));
          CHECK(rows[1][r] == Approx((high[r] - low[r]) / (2 * kStep)).margin(1e-6).epsilon(1e-6));
          CHECK(rows[2][r] ==
                Approx((high[r] - 2 * middle[r] + low[r]) / (kStep * kStep)).margin(1e-3).epsilon(1e-4));
        }
      }
    }
  }
}

TEST_CASE("derivatives above the degree are zero", "[basis]") {
  const Knots knots{0, 0, 1, 2, 2};
  const auto rows = engine::basis_derivatives(knots, 1, engine::find_span(knots, 1, 0.3), 0.3);
  CHECK(rows[1][0] == Approx(-1.0));
  CHECK(rows[1][1] == Approx(1.0));
  for (const double value : rows[2]) CHECK(value == 0.0);
}

TEST_CASE("Bernstein polynomials have their binomial form", "[basis]") {
  for (int degree = 0; degree <= 9; ++degree) {
    for (const double t : {0.0, 0.1, 0.5, 0.77, 1.0}) {
      const std::vector<double> values = engine::bernstein(degree, t);
      REQUIRE(values.size() == static_cast<std::size_t>(degree) + 1);
      double binomial = 1.0;
      for (int k = 0; k <= degree; ++k) {
        CAPTURE(degree, k, t);
        CHECK(values[static_cast<std::size_t>(k)] ==
              Approx(binomial * std::pow(t, k) * std::pow(1.0 - t, degree - k)).margin(1e-14));
        binomial = binomial * (degree - k) / (k + 1);
      }
    }
  }
}

TEST_CASE("break points are the distinct knots of the domain", "[basis]") {
  CHECK(engine::break_points({0, 0, 0, 1, 2, 2, 5, 5, 5}, 2) == std::vector<double>{0, 1, 2, 5});
  CHECK(engine::break_points({0, 1, 2, 3, 4, 5, 6, 7, 8}, 3) == std::vector<double>{3, 4, 5});
}

}  // namespace lamina::tests
