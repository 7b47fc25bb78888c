#include "tests/coin/Stage.h"

#include <cmath>
#include <cstdlib>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <utility>
#include <vector>

#include <Inventor/SbRotation.h>
#include <Inventor/SoDB.h>
#include <Inventor/SoInput.h>
#include <Inventor/SoOutput.h>
#include <Inventor/actions/SoWriteAction.h>
#include <Inventor/nodes/SoPerspectiveCamera.h>
#include <Inventor/nodes/SoSeparator.h>
#include <QImage>

#include "coin/SoTerrain.h"

namespace teren {
namespace {

std::shared_ptr<const TriangleIndices> gridTriangles(int intervals) {
  const auto vertex = [intervals](int column, int row) {
    return static_cast<std::uint32_t>(row * (intervals + 1) + column);
  };
  auto triangles = std::make_shared<TriangleIndices>();
  for (int row = 0; row < intervals; ++row) {
    for (int column = 0; column < intervals; ++column) {
      triangles->insert(triangles->end(),
                        {vertex(column, row), vertex(column + 1, row), vertex(column + 1, row + 1)});
      triangles->insert(triangles->end(),
                        {vertex(column, row), vertex(column + 1, row + 1), vertex(column, row + 1)});
    }
  }
  return triangles;
}

std::int16_t packed(double value) {
  return static_cast<std::int16_t>(std::lround(32767.0 * value));
}

SurfaceVertex vertexAt(const HandMade& plan, int column, int row, double x, double y) {
  const double step = std::ldexp(1.0, plan.level);
  const double east = (plan.height(x + step, y) - plan.height(x - step, y)) / (2.0 * step * plan.spacing);
  const double north = (plan.height(x, y + step) - plan.height(x, y - step)) / (2.0 * step * plan.spacing);
  const double length = std::sqrt(east * east + north * north + 1.0);
  return {static_cast<std::int16_t>(column), static_cast<std::int16_t>(row),
          static_cast<float>(plan.height(x, y)), packed(-east / length), packed(-north / length)};
}

std::shared_ptr<const Mesh> makeMesh(const HandMade& plan, int i, int j,
                                     std::shared_ptr<const TriangleIndices> triangles) {
  const std::int64_t side = std::int64_t{plan.intervals} << plan.level;
  auto mesh = std::make_shared<Mesh>();
  mesh->id = plan.firstId + static_cast<std::uint64_t>(j * plan.side + i);
  mesh->level = plan.level;
  mesh->originColumn = plan.column + i * side;
  mesh->originRow = plan.row + j * side;
  mesh->columns = mesh->rows = plan.intervals;
  mesh->indices = std::move(triangles);
  for (int row = 0; row <= plan.intervals; ++row) {
    for (int column = 0; column <= plan.intervals; ++column) {
      const auto x = static_cast<double>(i * side + (std::int64_t{column} << plan.level));
      const auto y = static_cast<double>(j * side + (std::int64_t{row} << plan.level));
      mesh->vertices.push_back(vertexAt(plan, column, row, x, y));
      const float height = mesh->vertices.back().height;
      if (mesh->vertices.size() == 1) mesh->minHeight = mesh->maxHeight = height;
      mesh->minHeight = std::min(mesh->minHeight, height);
      mesh->maxHeight = std::max(mesh->maxHeight, height);
    }
  }
  return mesh;
}

}  // namespace

Stage::Stage() : root(new SoSeparator), camera(new SoPerspectiveCamera), terrain(new SoTerrain) {
  root->ref();
  root->addChild(camera);
  root->addChild(terrain);
  camera->nearDistance = 1.0F;
  camera->farDistance = 5000.0F;
}

Stage::~Stage() {
  root->unref();
}

void Stage::look(const SbVec3f& from, double heading, double pitch) const {
  constexpr double kDegree = std::numbers::pi / 180.0;
  camera->position = from;
  camera->orientation = SbRotation(SbVec3f(1.0F, 0.0F, 0.0F), static_cast<float>((90.0 + pitch) * kDegree)) *
                        SbRotation(SbVec3f(0.0F, 0.0F, 1.0F), static_cast<float>(-heading * kDegree));
}

void makeSmall(SoTerrain& terrain) {
  terrain.viewLevel = 0;
  terrain.viewDistance = 100.0F;
}

SoNode* readScene(const std::string& text) {
  SoInput input;
  input.setBuffer(text.data(), text.size());
  SoSeparator* root = SoDB::readAll(&input);
  if (root == nullptr) throw std::runtime_error("Inventor cannot read: " + text);
  root->ref();
  return root;
}

std::string writeScene(SoNode* root) {
  SoOutput output;
  constexpr std::size_t kFirstSize = 4096;
  output.setBuffer(std::malloc(kFirstSize), kFirstSize, std::realloc);
  SoWriteAction action(&output);
  action.apply(root);
  void* text = nullptr;
  std::size_t size = 0;
  output.getBuffer(text, size);
  const std::string result(static_cast<const char*>(text), size);
  std::free(text);
  return result;
}

int backgroundPixels(const QImage& picture) {
  int count = 0;
  for (int x = 0; x < picture.width(); ++x) {
    for (int y = 0; y < picture.height(); ++y) count += picture.pixel(x, y) == qRgb(255, 0, 255) ? 1 : 0;
  }
  return count;
}

int backgroundBelowTheHorizon(const QImage& picture) {
  const QRgb background = qRgb(255, 0, 255);
  int count = 0;
  for (int x = 0; x < picture.width(); ++x) {
    bool below = false;
    for (int y = 0; y < picture.height(); ++y) {
      if (picture.pixel(x, y) != background) {
        below = true;
      } else if (below) {
        ++count;
      }
    }
  }
  return count;
}

std::shared_ptr<const Scene> makeScene(const HandMade& plan, std::uint64_t serial) {
  const std::shared_ptr<const TriangleIndices> triangles = gridTriangles(plan.intervals);
  std::vector<std::shared_ptr<const Mesh>> meshes;
  for (int j = 0; j < plan.side; ++j) {
    for (int i = 0; i < plan.side; ++i) meshes.push_back(makeMesh(plan, i, j, triangles));
  }
  return std::make_shared<const Scene>(serial, plan.spacing, std::move(meshes));
}

}  // namespace teren
