#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

#include "engine/model.h"
#include "engine/nurbs/curve.h"

namespace lamina::engine {

/// An edge of a face: a curve of its surface's parameter plane, the face on its left.
struct FaceEdge {
  std::size_t surface = 0;  ///< index in the model
  NurbsCurve curve;
};

/// Edges of all surfaces: trim curves, or the sides of untrimmed surfaces; without those that are a point.
std::vector<FaceEdge> face_edges(const Model& model);

/// Point of an edge in space.
Vector3 edge_point(const Model& model, const FaceEdge& edge, double t);

/// Edges as chords, found by place. The model and the edges must outlive it.
class EdgeChords {
 public:
  /// `reach`: how far from an edge it is found, mm.
  EdgeChords(const Model& model, const std::vector<FaceEdge>& edges, double reach);

  struct Chord {
    std::size_t edge = 0;
    double first = 0.0;  ///< parameters
    double last = 0.0;
    Vector3 start;
    Vector3 end;
  };
  const std::vector<Chord>& chords() const { return chords_; }

  struct Nearest {
    std::size_t edge = 0;
    double distance = 0.0;
    Vector3 direction;      ///< of the edge there
    std::size_t alike = 1;  ///< edges that are as near as this one
  };

  /// The nearest edge but `other_than`, within reach of a point.
  std::optional<Nearest> nearest(const Vector3& point, std::size_t other_than) const;

 private:
  std::uint64_t cell_of(const Vector3& point) const;
  double distance_to_edge(const FaceEdge& edge, const Chord& chord, const Vector3& point) const;

  const Model& model_;
  const std::vector<FaceEdge>& edges_;
  double reach_;
  double cell_;
  std::vector<Chord> chords_;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cells_;
};

}  // namespace lamina::engine
