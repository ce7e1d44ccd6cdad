#include <algorithm>
#include <chrono>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "tests/engine/import/peak_memory.h"
#include "tests/engine/import/reading.h"
#include "tests/support/corpus.h"

using namespace lamina::engine;
using namespace lamina::tests;

namespace {

constexpr std::uint32_t kSeed = 20260611;

std::string read_bytes(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

/// Damages a text in one of many ways; all choices come from `random`, so a seed repeats them.
class Mutator {
 public:
  explicit Mutator(std::uint32_t seed) : random_(seed) {}

  std::string operator()(std::string text) {
    const std::size_t rounds = 1 + below(4);
    for (std::size_t i = 0; i < rounds && text.size() > 80; ++i) {
      switch (below(6)) {
        case 0:
          text[below(text.size())] = static_cast<char>(below(256));
          break;
        case 1:
          text[below(text.size())] = kLikely[below(kLikely.size())];
          break;
        case 2:
          text.resize(below(text.size()));
          break;
        case 3:
          swap_lines(text);
          break;
        case 4:
          replace_number(text);
          break;
        default:
          replace_column(text);
          break;
      }
    }
    return text;
  }

 private:
  std::size_t below(std::size_t bound) { return random_() % bound; }

  std::string random_number() {
    static const std::vector<std::string> kNumbers{
        "0",     "-1",     "1",          "2",      "3",      "99999999", "2147483647",
        "1E308", "-1E308", "1.D-300",    "NaN",    "1H,",    "999H",     "0.5",
        "-0.",   "65535",  "4294967297", "1.E400", "100000", ";",        ","};
    return kNumbers[below(kNumbers.size())];
  }

  void swap_lines(std::string& text) {
    const std::size_t lines = text.size() / 81;
    if (lines < 2) return;
    const std::size_t a = below(lines) * 81;
    const std::size_t b = below(lines) * 81;
    for (std::size_t i = 0; i < 81; ++i) std::swap(text[a + i], text[b + i]);
  }

  /// A number of the parameter or global section becomes another, the line keeping its length.
  void replace_number(std::string& text) {
    const std::size_t at = text.find_first_of("0123456789", below(text.size()));
    if (at == std::string::npos) return;
    const std::string number = random_number();
    for (std::size_t i = 0; i < number.size() && at + i < text.size() && text[at + i] != '\n'; ++i)
      text[at + i] = number[i];
  }

  /// A field of eight columns becomes another number: the directory section.
  void replace_column(std::string& text) {
    const std::size_t line = below(text.size()) / 81 * 81;
    const std::size_t field = line + 8 * below(9);
    if (field + 8 > text.size()) return;
    text.replace(field, 8, right_aligned(random_number()).substr(0, 8));
  }

  static constexpr std::string_view kLikely = "0123456789+-.,;EDH SGPT\r\n";
  std::mt19937 random_;
};

/// Reads what may be broken. Whatever comes out is a model or an ImportError; a model is whole.
bool survives(const std::string& text) {
  try {
    const ImportResult result = read_iges(text, "mutant.igs");
    for (const Surface& surface : result.model.surfaces) {
      const NurbsSurface& s = surface.nurbs;
      const bool sizes_fit = s.knots_u.size() == s.net.count_u + static_cast<std::size_t>(s.degree_u) + 1 &&
                             s.knots_v.size() == s.net.count_v + static_cast<std::size_t>(s.degree_v) + 1 &&
                             s.net.points.size() == s.net.count_u * s.net.count_v;
      const bool sorted = std::is_sorted(s.knots_u.begin(), s.knots_u.end()) &&
                          std::is_sorted(s.knots_v.begin(), s.knots_v.end());
      const bool has_domain = s.first_u() < s.last_u() && s.first_v() < s.last_v();
      const bool finite = std::all_of(s.net.points.begin(), s.net.points.end(),
                                      [](const Vector4& p) { return p.allFinite() && p.w() > 0.0; });
      REQUIRE((sizes_fit && sorted && has_domain && finite));
    }
    return !result.model.surfaces.empty();
  } catch (const ImportError&) {
    return false;
  }
}

/// Files with every entity that is read, own ones so that the test does not depend on the corpus.
std::vector<std::string> own_files() {
  const std::string net = "0.,0.,0.,1.,0.,0.,0.,1.,0.,1.,1.,0.,0.,1.,0.,1.";
  return {iges_text({{128, "1,1,1,1,0,0,1,0,0,0.,0.,1.,1.,0.,0.,1.,1.,1.,1.,1.,1.," + net, 0, 3},
                     {124, "1.,0.,0.,5.,0.,1.,0.,0.,0.,0.,1.,0.", 0, 5},
                     {124, "0.,1.,0.,5.,1.,0.,0.,0.,0.,0.,1.,0."}}),
          iges_text(
              {{100, "0.,0.,0.,5.,0.,0.,5.", 0, 0, "00010000"},
               {104, "1.,0.,4.,0.,0.,-4.,1.,2.,0.,0.,1.", 1, 0, "00010000"},
               {110, "0.,0.,-1.,0.,0.,4.", 0, 0, "00010000"},
               {112, "3,1,3,1,0.,2.,1.,1.,0.5,0.,2.,0.,1.,0.,3.,0.,0.,1.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.",
                0, 0, "00010000"},
               {126, "2,2,0,0,0,0,0.,0.,0.,1.,1.,1.,1.,2.,1.,0.,5.,0.,1.,2.,3.,4.,4.,0.,0.,1.,0.,0.,1.", 0, 0,
                "00010000"},
               {102, "2,1,9", 0, 0, "00010000"},
               {116, "3.,4.,5.,0", 0, 0, "00010000"},
               {118, "11,13,0,0", 1},
               {118, "3,7,1,0", 0},
               {120, "5,11,0.,4."}})};
}

}  // namespace

TEST_CASE("mutated files are read or refused, quickly and within bounds") {
  std::vector<std::string> files = own_files();
  for (const std::string& file : files) REQUIRE(survives(file));
  if (corpus_present()) {
    for (const std::string name :
         {"analytic/cylinder_upright.igs", "entities/mix_100_110_118_120_122_124.igs",
          "entities/mix_112_120.igs", "entities/mix_114_128.igs", "entities/mix_124_inch.igs",
          "entities/lex_delims.igs", "entities/lex_hollerith.igs", "entities/plane108_118.igs",
          "entities/trim144_n1zero.igs", "seed/torus.igs"}) {
      files.push_back(read_bytes(corpus_file(name)));
    }
  } else {
    WARN("the model corpus is missing: own files only");
  }
  INFO("seed " << kSeed);
  Mutator mutate(kSeed);
  std::size_t read = 0;
  std::size_t refused = 0;
  std::chrono::steady_clock::duration slowest{};
  double most_memory = 0.0;  // beyond a fixed 4 MB, per byte of file
  for (int i = 0; i < 60000; ++i) {
    const std::string mutant = mutate(files[static_cast<std::size_t>(i) % files.size()]);
    const auto start = std::chrono::steady_clock::now();
    const std::size_t before = start_peak_memory();
    (survives(mutant) ? read : refused) += 1;
    const auto used = static_cast<double>(peak_memory() - before);
    most_memory = std::max(most_memory, (used - double{1 << 22}) / static_cast<double>(mutant.size() + 1));
    slowest = std::max(slowest, std::chrono::steady_clock::now() - start);
  }
  // The campaign must reach both ends, or it proves little.
  CHECK(read > 5000);
  CHECK(refused > 10000);
  CHECK(slowest < std::chrono::seconds(2));
  CHECK(most_memory < 40.0);
}

TEST_CASE("memory stays within a multiple of the file where entities multiply each other") {
  // Arcs of a curve of degree 25 with many spans, ruled against each other and revolved.
  std::string knots;
  std::string weights;
  std::string points;
  constexpr int kCount = 4000;
  for (int i = 0; i < kCount + 26; ++i)
    knots += std::to_string(i < 26 ? 0 : std::min(i - 25, kCount - 25)) + ",";
  for (int i = 0; i < kCount; ++i) {
    weights += "1,";
    points += std::to_string(i % 10) + ",1,0,";
  }
  const std::string curve = std::to_string(kCount - 1) + ",25,0,0,1,0," + knots + weights + points + "0.," +
                            std::to_string(kCount - 25) + ".";
  std::vector<IgesEntity> entities{{126, curve, 0, 0, "00010000"},
                                   {110, "0.,0.,0.,1.,0.,0.", 0, 0, "00010000"}};
  for (int i = 0; i < 200; ++i)
    entities.push_back({i % 2 == 0 ? 118 : 120, i % 2 == 0 ? "1,3,0,0" : "3,1,0.,6.", 1});
  const std::string text = iges_text(entities);
  const std::size_t before = start_peak_memory();
  CHECK(error_of(text).find("unfold to more control points") != std::string::npos);
  CHECK(peak_memory() - before < 40 * text.size() + (1 << 22));
}

TEST_CASE("a file cut anywhere is read or refused") {
  for (const std::string& file : own_files()) {
    for (std::size_t length = 0; length < file.size(); ++length) survives(file.substr(0, length));
  }
  SUCCEED();
}
