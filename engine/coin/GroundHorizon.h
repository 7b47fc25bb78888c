// Finds the meshes that lie wholly behind nearer ground, before anything is drawn of them: half of the
// triangles in the picture of a hilly country.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "teren/Scene.h"

#include "coin/MovedVertices.h"
#include "coin/ScenePlacement.h"

namespace teren {

/// The land is a function, so a line of sight that begins above its surface and is below it in one place has
/// met it before: what lies farther in that direction and not higher is hidden. In squares of kBlock x kBlock
/// intervals the surface is nowhere lower than its lowest vertex; around the eye such squares raise a
/// horizon, sector by sector, in the order of their distance, and a mesh whose squares all stay below the
/// horizon as it is on this side of them cannot be seen. Nothing is taken for hidden that is not, in exact
/// arithmetic; in doubles, to a millionth of a pixel. An eye below the ground, or beyond the land's end, may
/// see slopes from below through what it does not see from behind: for it nothing is left out.
class GroundHorizon {
 public:
  static constexpr int kBlock = 4;       ///< larger: less hidden is found, for less time
  static constexpr int kSectors = 1024;  ///< of the whole horizon

  /// Takes the meshes that cannot be seen from `eye` out of `meshes`, those of `scene`, its vertices
  /// moved like this, that are in the picture. Ground nearer than `nearest` [m], the camera's near plane, is
  /// not drawn and hides nothing: where there is any, all meshes stay. A millisecond for 200 meshes,
  /// and a look at every mesh of the scene.
  void leaveOutHidden(std::vector<const Mesh*>& meshes, const Scene& scene, const MovedVertices& moved,
                      const ScenePlacement& placement, const SbVec3d& eye, double nearest);
  /// Must be called before a mesh dies.
  void forget(const Mesh& mesh) { blocks_.erase(&mesh); }

 private:
  struct Block {
    std::int16_t west, south, east, north;
    float low, high;  // [m]
  };
  /// Ground that hides what is farther than `distance` and lower than `slope` in these sectors.
  struct Ridge {
    double distance, slope;
    int first, last;
  };
  /// A part of a mesh that begins at `distance` and is nowhere higher than `slope`, in these sectors.
  struct Part {
    double distance, slope;
    int first, last;
    std::size_t mesh;  // which of those asked about
  };
  static std::vector<Block> blocksOf(const Mesh& mesh);
  bool add(const Mesh& mesh, std::size_t number, const ScenePlacement& placement, const SbVec3d& eye,
           double nearest);
  void raise(const Ridge& ridge) noexcept;
  bool isBelow(const Part& part) const noexcept;

  std::unordered_map<const Mesh*, std::vector<Block>> blocks_;
  std::vector<Ridge> ridges_;
  std::vector<Part> parts_;
  std::vector<char> seen_;  // of the meshes asked about
  std::array<double, kSectors> horizon_{};
};

}  // namespace teren
