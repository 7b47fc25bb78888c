// What an object looks like, free of any renderer: triangles in its own frame. Programs turn them into nodes
// or buffers of theirs.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace teren {

/// [m] In an object's frame: x to the right, y ahead, z up, zero where its Motion is.
using ModelPoint = std::array<float, 3>;

/// A piece of one colour.
struct ModelPart {
  std::array<float, 3> color{0.8F, 0.8F, 0.8F};  ///< red, green, blue, each 0 ... 1
  float shininess = 0.4F;                        ///< 0 ... 1
  std::vector<ModelPoint> points = {};
  /// Anticlockwise seen from outside; every index is that of a point.
  std::vector<std::array<std::uint32_t, 3>> triangles = {};
  /// [rad/s] The part turns about the axis through `hub` that points ahead: propellers, drills.
  float spin = 0.0F;
  ModelPoint hub{0.0F, 0.0F, 0.0F};
};

struct Model {
  std::string kind = {};  ///< a word for renderers that have a better picture of such things, e.g. "aircraft"
  std::vector<ModelPart> parts = {};  ///< none: the object is not seen
};

}  // namespace teren
