#include "engine/contour/planar_graph.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace lamina::engine {
namespace {

/// Lattice steps per mm: 2^-20 mm is the model tolerance, nearly.
constexpr double kStepsPerMillimetre = 1048576.0;
constexpr int kMostRounds = 40;

struct Piece {
  std::uint32_t a;
  std::uint32_t b;
  std::uint32_t chain;
  std::uint32_t segment;
};

/// Vertices by place.
class VertexTable {
 public:
  explicit VertexTable(std::vector<LatticePoint>& vertices) : vertices_(vertices) {}

  std::uint32_t at(LatticePoint point) {
    const auto [entry, added] = numbers_.try_emplace(point, static_cast<std::uint32_t>(vertices_.size()));
    if (added) vertices_.push_back(point);
    return entry->second;
  }

 private:
  std::vector<LatticePoint>& vertices_;
  std::map<LatticePoint, std::uint32_t> numbers_;
};

struct Split {
  std::uint32_t piece;
  double place;  ///< along the piece
  std::uint32_t vertex;
};

double along(LatticePoint a, LatticePoint b, LatticePoint p) {
  return static_cast<double>(b.x - a.x) * static_cast<double>(p.x - a.x) +
         static_cast<double>(b.y - a.y) * static_cast<double>(p.y - a.y);
}

/// Whether p lies on the segment a b within a lattice step, strictly between its ends.
bool lies_on(LatticePoint a, LatticePoint b, LatticePoint p) {
  const double length_squared = along(a, b, b);
  const double place = along(a, b, p);
  if (!(place > 0.0 && place < length_squared)) return false;
  const auto off = static_cast<double>(turn(a, b, p));
  return off * off <= length_squared;
}

/// Where two segments cross that are known to.
LatticePoint crossing(LatticePoint a, LatticePoint b, LatticePoint c, LatticePoint d) {
  const auto abc = static_cast<long double>(turn(a, b, c));
  const auto abd = static_cast<long double>(turn(a, b, d));
  const long double t = abc / (abc - abd);
  return {c.x + static_cast<std::int64_t>(std::llround(t * static_cast<long double>(d.x - c.x))),
          c.y + static_cast<std::int64_t>(std::llround(t * static_cast<long double>(d.y - c.y)))};
}

/// Pairs of pieces whose boxes meet, each once, by sweeping over x.
template <typename Visit>
void for_each_close_pair(const std::vector<LatticePoint>& vertices, const std::vector<Piece>& pieces,
                         Visit visit) {
  struct Span {
    std::int64_t low_x, high_x, low_y, high_y;
    std::uint32_t piece;
  };
  std::vector<Span> spans;
  spans.reserve(pieces.size());
  for (std::uint32_t k = 0; k < pieces.size(); ++k) {
    const LatticePoint a = vertices[pieces[k].a];
    const LatticePoint b = vertices[pieces[k].b];
    spans.push_back(
        {std::min(a.x, b.x) - 1, std::max(a.x, b.x) + 1, std::min(a.y, b.y) - 1, std::max(a.y, b.y) + 1, k});
  }
  std::sort(spans.begin(), spans.end(), [](const Span& s, const Span& t) {
    return std::tie(s.low_x, s.piece) < std::tie(t.low_x, t.piece);
  });
  std::vector<Span> open;
  for (const Span& span : spans) {
    std::erase_if(open, [&](const Span& before) { return before.high_x < span.low_x; });
    for (const Span& before : open) {
      if (before.low_y <= span.high_y && span.low_y <= before.high_y) visit(before.piece, span.piece);
    }
    open.push_back(span);
  }
}

/// One round: finds where pieces have to be split.
std::vector<Split> find_splits(PlanarGraph& graph, VertexTable& table, const std::vector<Piece>& pieces) {
  std::vector<Split> splits;
  const auto split = [&](std::uint32_t k, std::uint32_t vertex) {
    const Piece& piece = pieces[k];
    if (vertex == piece.a || vertex == piece.b) return;
    splits.push_back(
        {k, along(graph.vertices[piece.a], graph.vertices[piece.b], graph.vertices[vertex]), vertex});
  };
  for_each_close_pair(graph.vertices, pieces, [&](std::uint32_t k, std::uint32_t l) {
    const Piece e = pieces[k];
    const Piece f = pieces[l];
    const LatticePoint a = graph.vertices[e.a];
    const LatticePoint b = graph.vertices[e.b];
    const LatticePoint c = graph.vertices[f.a];
    const LatticePoint d = graph.vertices[f.b];
    bool touching = false;
    const auto snap = [&](std::uint32_t piece, LatticePoint from, LatticePoint to, std::uint32_t vertex) {
      if (vertex == pieces[piece].a || vertex == pieces[piece].b ||
          !lies_on(from, to, graph.vertices[vertex]))
        return;
      split(piece, vertex);
      touching = true;
    };
    snap(k, a, b, f.a);
    snap(k, a, b, f.b);
    snap(l, c, d, e.a);
    snap(l, c, d, e.b);
    if (touching || e.a == f.a || e.a == f.b || e.b == f.a || e.b == f.b) return;
    if ((turn(a, b, c) > 0) == (turn(a, b, d) > 0) || (turn(c, d, a) > 0) == (turn(c, d, b) > 0)) return;
    const std::uint32_t vertex = table.at(crossing(a, b, c, d));
    split(k, vertex);
    split(l, vertex);
    if (e.chain != f.chain)
      graph.crossings.emplace_back(std::min(e.chain, f.chain), std::max(e.chain, f.chain));
  });
  std::sort(splits.begin(), splits.end(), [](const Split& s, const Split& t) {
    return std::tie(s.piece, s.place, s.vertex) < std::tie(t.piece, t.place, t.vertex);
  });
  return splits;
}

std::vector<Piece> split_pieces(const std::vector<Piece>& pieces, const std::vector<Split>& splits) {
  std::vector<Piece> result;
  result.reserve(pieces.size() + splits.size());
  std::size_t next = 0;
  for (std::uint32_t k = 0; k < pieces.size(); ++k) {
    Piece rest = pieces[k];
    for (; next < splits.size() && splits[next].piece == k; ++next) {
      if (splits[next].vertex == rest.a) continue;
      result.push_back({rest.a, splits[next].vertex, rest.chain, rest.segment});
      rest.a = splits[next].vertex;
    }
    if (rest.a != rest.b) result.push_back(rest);
  }
  return result;
}

}  // namespace

LatticePoint lattice_point(const Vector2& position) {
  return {std::llround(position.x() * kStepsPerMillimetre), std::llround(position.y() * kStepsPerMillimetre)};
}

Vector2 position_of(LatticePoint point) {
  return {static_cast<double>(point.x) / kStepsPerMillimetre,
          static_cast<double>(point.y) / kStepsPerMillimetre};
}

PlanarGraph draw_planar_graph(const std::vector<NodeChain>& chains) {
  PlanarGraph graph;
  VertexTable table(graph.vertices);
  std::vector<Piece> pieces;
  for (std::uint32_t c = 0; c < chains.size(); ++c) {
    const auto& nodes = chains[c].nodes;
    const std::size_t count = nodes.size() - (chains[c].closed ? 0 : 1);
    for (std::uint32_t s = 0; s < count; ++s) {
      const std::uint32_t a = table.at(lattice_point(nodes[s].position));
      const std::uint32_t b = table.at(lattice_point(nodes[(s + 1) % nodes.size()].position));
      if (a != b) pieces.push_back({a, b, c, s});
    }
  }
  for (int round = 0; round < kMostRounds; ++round) {
    const std::vector<Split> splits = find_splits(graph, table, pieces);
    if (splits.empty()) break;
    pieces = split_pieces(pieces, splits);
  }
  std::sort(graph.crossings.begin(), graph.crossings.end());
  graph.crossings.erase(std::unique(graph.crossings.begin(), graph.crossings.end()), graph.crossings.end());

  std::stable_sort(pieces.begin(), pieces.end(), [](const Piece& s, const Piece& t) {
    return std::minmax(s.a, s.b) < std::minmax(t.a, t.b);
  });
  for (const Piece& piece : pieces) {
    const auto [a, b] = std::minmax(piece.a, piece.b);
    if (graph.edges.empty() || graph.edges.back().a != a || graph.edges.back().b != b)
      graph.edges.push_back({a, b, {}});
    graph.edges.back().parts.push_back({piece.chain, piece.segment, piece.a == a});
  }
  return graph;
}

}  // namespace lamina::engine
