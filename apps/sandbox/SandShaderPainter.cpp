#include "apps/sandbox/SandShaderPainter.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "apps/sandbox/SandShaders.h"
#include "coin/OpenGL.h"

namespace teren {
namespace {

constexpr GLuint kAttributes[] = {kSandPlace, kSandHeight, kSandLoose, kSandNormal};
constexpr float kCellsPerSide = 400.0F;  // of the coarsest grain

const void* at(const SandVertex* start, std::size_t offset) {
  return reinterpret_cast<const void*>(reinterpret_cast<std::uintptr_t>(start) + offset);
}

/// Restores what drawing changes, so that Inventor's own idea of GL's state stays true.
class SavedState {
 public:
  SavedState() {
    glGetIntegerv(GL_CURRENT_PROGRAM, &program_);
    glPushAttrib(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_ENABLE_BIT | GL_LINE_BIT | GL_POLYGON_BIT);
    glPushClientAttrib(GL_CLIENT_VERTEX_ARRAY_BIT);
  }
  SavedState(const SavedState&) = delete;
  SavedState& operator=(const SavedState&) = delete;
  ~SavedState() {
    glUseProgram(static_cast<GLuint>(program_));
    for (const GLuint attribute : kAttributes) glDisableVertexAttribArray(attribute);
    glBindBuffer(GL_ARRAY_BUFFER, 0);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, 0);
    glPopClientAttrib();
    glPopAttrib();
  }

 private:
  GLint program_ = 0;
};

/// `start`: in memory, or nullptr for that of the buffer.
void pointAttributes(const SandVertex* start) {
  constexpr GLsizei kStride = sizeof(SandVertex);
  for (const GLuint attribute : kAttributes) glEnableVertexAttribArray(attribute);
  glVertexAttribPointer(kSandPlace, 2, GL_INT, GL_FALSE, kStride, at(start, offsetof(SandVertex, place)));
  glVertexAttribPointer(kSandHeight, 1, GL_FLOAT, GL_FALSE, kStride, at(start, offsetof(SandVertex, height)));
  glVertexAttribPointer(kSandLoose, 1, GL_FLOAT, GL_FALSE, kStride, at(start, offsetof(SandVertex, loose)));
  glVertexAttribPointer(kSandNormal, 2, GL_SHORT, GL_FALSE, kStride, at(start, offsetof(SandVertex, normal)));
}

void drawRuns(const std::vector<PageRun>& runs) {
  constexpr std::size_t kIndices = 3 * SandTrianglePage::kSlots;
  for (const PageRun& run : runs) {
    glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(run.count * kIndices), GL_UNSIGNED_INT,
                   at(nullptr, run.first * kIndices * sizeof(VertexId)));
  }
}

void setColour(const ShaderProgram& program, const float (&colour)[4]) {
  program.set("colour", SbVec3f(colour));
  program.set("cover", colour[3]);
}

}  // namespace

Result<std::unique_ptr<SandPainter>> SandShaderPainter::create() {
  constexpr std::array<const char*, 4> kNames{"place", "height", "loose", "normal"};
  std::unique_ptr<SandShaderPainter> painter(new SandShaderPainter);
  const auto sand = ShaderProgram::link(kSandVertexShader, std::array{kSandFragmentShader}, kNames);
  if (!sand) return sand.error();
  painter->sand_ = *sand;
  const auto wire = ShaderProgram::link(kSandVertexShader, std::array{kSandWireShader}, kNames);
  if (!wire) {
    painter->release();
    return wire.error();
  }
  painter->wire_ = *wire;
  return std::unique_ptr<SandPainter>(std::move(painter));
}

void SandShaderPainter::release() {
  buffers_.clear();
  constrained_.clear();
  sides_.clear();
  sand_.release();
  wire_.release();
}

void SandShaderPainter::draw(const SandPicture& picture) {
  const SavedState saved;
  buffers_.follow(picture.sand);
  glDisable(GL_BLEND);
  glDisable(GL_CULL_FACE);
  const std::vector<PageRun> runs = visibleRuns(*picture.sand, picture.toClip);
  if (picture.wireframe) {
    glEnable(GL_POLYGON_OFFSET_FILL);
    glPolygonOffset(1.0F, 1.0F);
  }
  drawSand(picture, runs);
  if (picture.wireframe) {
    drawWire(picture, runs);
  } else {
    constrained_.clear();
  }
}

void SandShaderPainter::drawSand(const SandPicture& picture, const std::vector<PageRun>& runs) {
  const float side = sideOf(*picture.sand);
  sand_.use();
  sand_.set("step", static_cast<float>(picture.sand->frame().step));
  sand_.set("hiding", SandLook::kHiding * side);
  sand_.set("sun", picture.sun);
  sand_.set("sunlight", picture.sunlight);
  sand_.set("moisture", picture.moisture);
  sand_.set("cells", kCellsPerSide / side);
  sand_.set("cut", SandLook::kCut);
  sand_.set("sky", SandLook::kSky);
  sand_.set("wet", SandLook::kWet);
  sand_.set("looseColour", SandLook::kLoose);
  sand_.set("solidColour", SandLook::kSolid);
  sand_.set("shade", SandLook::kShade);
  sand_.set("light", SandLook::kLight);
  const std::vector<SandVertex>& walls = sides_.of(picture.sand);
  glBindBuffer(GL_ARRAY_BUFFER, 0);  // they are few, and come from the program's own memory
  pointAttributes(walls.data());
  glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(walls.size()));
  buffers_.bind();
  pointAttributes(nullptr);
  drawRuns(runs);
}

void SandShaderPainter::drawWire(const SandPicture& picture, const std::vector<PageRun>& runs) {
  wire_.use();
  wire_.set("step", static_cast<float>(picture.sand->frame().step));
  wire_.set("hiding", 1.0F);
  glEnable(GL_BLEND);
  glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  glDepthMask(GL_FALSE);
  glDepthFunc(GL_LEQUAL);
  glPolygonMode(GL_FRONT_AND_BACK, GL_LINE);
  glLineWidth(1.0F);
  setColour(wire_, SandLook::kWire);
  drawRuns(runs);
  const std::vector<VertexId>& edges = constrained_.of(picture.sand);
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, 0);
  glLineWidth(SandLook::kConstrainedWidth);
  setColour(wire_, SandLook::kConstrained);
  glDrawElements(GL_LINES, static_cast<GLsizei>(edges.size()), GL_UNSIGNED_INT, edges.data());
}

}  // namespace teren
