#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "tests/fuzz/fuzz_targets.h"

// The fuzzers' entry functions over their corpora, and over mutations of these from fixed seeds. tools/fuzz
// lets libFuzzer look for more.

namespace {

using namespace lamina::fuzz;

std::vector<std::string> corpus(const std::string& name) {
  std::vector<std::filesystem::path> paths;
  for (const auto& entry :
       std::filesystem::directory_iterator(LAMINA_SOURCE_DIR "/tests/fuzz/corpus/" + name))
    paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  std::vector<std::string> inputs;
  for (const auto& path : paths) {
    std::ifstream file(path, std::ios::binary);
    inputs.emplace_back(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
  }
  return inputs;
}

std::string mutated(std::string input, const std::vector<std::string>& others, std::mt19937_64& random) {
  for (std::size_t count = 1 + random() % 8; count > 0; --count) {
    const std::size_t at = input.empty() ? 0 : random() % input.size();
    switch (random() % 6) {
      case 0:
        if (!input.empty()) input[at] = static_cast<char>(random());
        break;
      case 1:
        if (!input.empty()) input[at] = static_cast<char>(input[at] ^ (1 << (random() % 8)));
        break;
      case 2:
        input.insert(at, 1, static_cast<char>(random()));
        break;
      case 3:
        input.erase(at, random() % 8);
        break;
      case 4:
        input.insert(at, input.substr(at, random() % 32));
        break;
      default: {
        const std::string& other = others[random() % others.size()];
        if (!other.empty()) input.insert(at, other.substr(random() % other.size(), random() % 64));
        break;
      }
    }
  }
  if (input.size() > 4096) input.resize(4096);
  return input;
}

}  // namespace

TEST_CASE("fuzz: the corpora and their mutations break no promise") {
  const Target target = GENERATE(from_range(kTargets.begin(), kTargets.end()));
  const std::vector<std::string> inputs = corpus(target.name);
  REQUIRE(inputs.size() >= 3);
  target.run("");
  for (const std::string& input : inputs) target.run(input);
  constexpr std::uint64_t kSeed = 20261122;
  std::mt19937_64 random(kSeed);
  for (int round = 0; round < 1500; ++round) {
    const std::string input = mutated(inputs[random() % inputs.size()], inputs, random);
    try {
      target.run(input);
    } catch (const BrokenPromise& broken) {
      std::string hex;
      for (const char byte : input) {
        constexpr std::string_view kDigits = "0123456789abcdef";
        hex += kDigits[static_cast<unsigned char>(byte) >> 4U];
        hex += kDigits[static_cast<unsigned char>(byte) & 15U];
      }
      FAIL(target.name << ", round " << round << ": " << broken.what() << "; input " << hex);
    }
  }
}
