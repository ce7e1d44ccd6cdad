#include "engine/contour/fit/walked_chain.h"

#include <algorithm>

namespace lamina::engine {

WalkedChain::WalkedChain(const SmoothChain& smooth) : chain(smooth), lengths(segment_lengths(smooth)) {
  walked.reserve(chain.positions.size());
  walked.push_back(0.0);
  for (const double length : lengths) walked.push_back(walked.back() + length);
}

std::vector<FitSample> samples_of(const WalkedChain& walk, std::size_t wanted) {
  const std::size_t stride = std::max<std::size_t>(1, walk.segments() / wanted);
  const std::size_t parts = (wanted + walk.segments() - 1) / walk.segments();
  std::vector<FitSample> samples;
  samples.reserve(walk.segments() / stride * parts + 2);
  for_each_place(walk, stride, parts, [&](const Vector2& position, const Vector2& tangent, double walked) {
    samples.push_back({position, tangent, walked, walked});
  });
  return samples;
}

}  // namespace lamina::engine
