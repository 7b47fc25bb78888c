#include "coin/ShaderPainter.h"

#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <numbers>
#include <utility>
#include <vector>

#include "coin/GroundTexture.h"
#include "coin/LogarithmicDepth.h"
#include "coin/OpenGL.h"
#include "coin/TerrainShaders.h"

namespace teren {
namespace {

std::string programLog(GLuint program) {
  std::array<char, 512> text{};
  glGetProgramInfoLog(program, static_cast<GLsizei>(text.size()), nullptr, text.data());
  return text.data();
}

void attach(GLuint program, GLenum kind, std::span<const char* const> source) {
  const GLuint shader = glCreateShader(kind);
  glShaderSource(shader, static_cast<GLsizei>(source.size()), source.data(), nullptr);
  glCompileShader(shader);
  glAttachShader(program, shader);
  glDeleteShader(shader);  // lives as long as the program
}

bool glslThere() {
  const auto* version = reinterpret_cast<const char*>(glGetString(GL_SHADING_LANGUAGE_VERSION));
  int major = 0;
  int minor = 0;
  if (version == nullptr || std::sscanf(version, "%d.%d", &major, &minor) != 2) return false;
  return major > 1 || (major == 1 && minor >= 20);
}

/// Restores what drawing changes, so that Inventor's own idea of GL's state stays true.
class SavedState {
 public:
  SavedState() {
    glGetIntegerv(GL_CURRENT_PROGRAM, &program_);
    glPushAttrib(GL_COLOR_BUFFER_BIT | GL_CURRENT_BIT | GL_ENABLE_BIT | GL_POLYGON_BIT | GL_TEXTURE_BIT);
    glPushClientAttrib(GL_CLIENT_VERTEX_ARRAY_BIT);
  }
  SavedState(const SavedState&) = delete;
  SavedState& operator=(const SavedState&) = delete;
  ~SavedState() {
    glUseProgram(static_cast<GLuint>(program_));
    glBindBuffer(GL_ARRAY_BUFFER, 0);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, 0);
    glPopClientAttrib();
    glPopAttrib();
  }

 private:
  GLint program_ = 0;
};

const void* at(const std::byte* start, std::size_t offset) {
  return reinterpret_cast<const void*>(reinterpret_cast<std::uintptr_t>(start) + offset);
}

void pointAttributes(const std::byte* vertices) {
  constexpr GLsizei kStride = sizeof(SurfaceVertex);
  glVertexAttribPointer(kCell, 2, GL_SHORT, GL_FALSE, kStride, at(vertices, offsetof(SurfaceVertex, column)));
  glVertexAttribPointer(kHeight, 1, GL_FLOAT, GL_FALSE, kStride,
                        at(vertices, offsetof(SurfaceVertex, height)));
  glVertexAttribPointer(kSlope, 2, GL_SHORT, GL_FALSE, kStride,
                        at(vertices, offsetof(SurfaceVertex, normalX)));
  glVertexAttribPointer(kCoarserHeight, 1, GL_FLOAT, GL_FALSE, kStride,
                        at(vertices, offsetof(SurfaceVertex, coarserHeight)));
  glVertexAttribPointer(kCoarserSlope, 2, GL_SHORT, GL_FALSE, kStride,
                        at(vertices, offsetof(SurfaceVertex, coarserNormalX)));
}

constexpr std::array<GLuint, 5> kOfVertices{kCell, kHeight, kSlope, kCoarserHeight, kCoarserSlope};

constexpr double kAnchorStep = 1.0;  // [m]

/// A sample's place in the period of the ground's texture, -512 ... 511.
float inPeriod(std::int64_t sample) {
  constexpr std::int64_t kPeriod = 1024;
  const std::int64_t ahead = ((sample % kPeriod) + kPeriod) % kPeriod;
  return static_cast<float>(ahead < kPeriod / 2 ? ahead : ahead - kPeriod);
}

const SbVec3f kDeepWater(0.05F, 0.16F, 0.22F);
constexpr int kWaterRings = 32;
constexpr int kWaterSectors = 64;
constexpr int kClearRings = 14;  // the clear ones: see ringRadius() and kClearShare

/// Share of the view distance; denser inside.
constexpr float ringRadius(int ring) {
  const float share = static_cast<float>(ring) / kWaterRings;
  return share * share;
}
static_assert(ringRadius(kClearRings) == kClearShare);

/// How many indices the rings before this one have: the innermost has one triangle a sector, the others two.
constexpr int discIndices(int rings) {
  return rings == 0 ? 0 : 3 * kWaterSectors * (2 * rings - 1);
}

/// x and y of the disc's vertices: the centre, then ring by ring.
std::vector<float> discVertices() {
  std::vector<float> vertices{0.0F, 0.0F};
  for (int ring = 1; ring <= kWaterRings; ++ring) {
    const auto radius = static_cast<double>(ringRadius(ring));
    for (int sector = 0; sector < kWaterSectors; ++sector) {
      const double angle = 2.0 * std::numbers::pi * sector / kWaterSectors;
      vertices.push_back(static_cast<float>(radius * std::cos(angle)));
      vertices.push_back(static_cast<float>(radius * std::sin(angle)));
    }
  }
  return vertices;
}

std::vector<std::uint16_t> discTriangles() {
  const auto vertex = [](int ring, int sector) {
    return static_cast<std::uint16_t>(ring == 0 ? 0
                                                : 1 + (ring - 1) * kWaterSectors + sector % kWaterSectors);
  };
  std::vector<std::uint16_t> triangles;
  for (int ring = 0; ring < kWaterRings; ++ring) {
    for (int sector = 0; sector < kWaterSectors; ++sector) {
      const std::uint16_t outer = vertex(ring + 1, sector);
      const std::uint16_t nextOuter = vertex(ring + 1, sector + 1);
      triangles.insert(triangles.end(), {vertex(ring, sector), outer, nextOuter});
      if (ring > 0)
        triangles.insert(triangles.end(), {vertex(ring, sector), nextOuter, vertex(ring, sector + 1)});
    }
  }
  return triangles;
}

template <class T>
std::size_t uploadOnce(GLenum target, unsigned& name, const std::vector<T>& data) {
  glGenBuffers(1, &name);
  glBindBuffer(target, name);
  glBufferData(target, static_cast<GLsizeiptr>(data.size() * sizeof(T)), data.data(), GL_STATIC_DRAW);
  return data.size() * sizeof(T);
}

}  // namespace

Result<ShaderProgram> ShaderProgram::link(const char* vertexShader,
                                          std::span<const char* const> fragmentShader,
                                          std::span<const char* const> attributes) {
  if (!glslThere()) return Error{"OpenGL offers no shading language 1.20 here"};
  ShaderProgram program;
  program.name_ = glCreateProgram();
  attach(program.name_, GL_VERTEX_SHADER, {&vertexShader, 1});
  attach(program.name_, GL_FRAGMENT_SHADER, fragmentShader);
  for (GLuint number = 0; number < attributes.size(); ++number) {
    glBindAttribLocation(program.name_, number, attributes[number]);
  }
  glLinkProgram(program.name_);
  GLint linked = GL_FALSE;
  glGetProgramiv(program.name_, GL_LINK_STATUS, &linked);
  if (linked == GL_TRUE) return program;
  Error error{"the shaders were refused: " + programLog(program.name_)};
  program.release();
  return error;
}

void ShaderProgram::use() const {
  glUseProgram(name_);
}

void ShaderProgram::set(const char* name, float value) const {
  glUniform1f(glGetUniformLocation(name_, name), value);
}

void ShaderProgram::set(const char* name, float x, float y) const {
  glUniform2f(glGetUniformLocation(name_, name), x, y);
}

void ShaderProgram::set(const char* name, const SbVec3f& value) const {
  glUniform3fv(glGetUniformLocation(name_, name), 1, value.getValue());
}

void ShaderProgram::set(const char* name, std::span<const Morph::Range> ranges) const {
  static_assert(sizeof(Morph::Range) == 2 * sizeof(float));
  glUniform2fv(glGetUniformLocation(name_, name), static_cast<GLsizei>(ranges.size()), &ranges.front().error);
}

void ShaderProgram::set(const char* name, const SbDPMatrix& matrix) const {
  std::array<float, 16> values{};  // Inventor's rows are GL's columns
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) {
      values[static_cast<std::size_t>(row * 4 + column)] = static_cast<float>(matrix[row][column]);
    }
  }
  glUniformMatrix4fv(glGetUniformLocation(name_, name), 1, GL_FALSE, values.data());
}

void ShaderProgram::release() {
  glDeleteProgram(name_);
  name_ = 0;
}

Result<std::unique_ptr<TerrainPainter>> ShaderPainter::create() {
  std::unique_ptr<ShaderPainter> painter(new ShaderPainter);
  for (const Result<void>& linked :
       {link(painter->ordinary_, kOrdinaryDepth), link(painter->logarithmic_, kLogarithmicDepthShader)}) {
    if (linked) continue;
    painter->release();
    return linked.error();
  }
  const SavedState saved;
  painter->makeNoise();
  painter->makeWater();
  return std::unique_ptr<TerrainPainter>(std::move(painter));
}

Result<void> ShaderPainter::link(Programs& programs, const char* depth) {
  constexpr std::array<const char*, 6> kGround{"cell",  "height",        "slope",
                                               "place", "coarserHeight", "coarserSlope"};
  constexpr std::array<const char*, 1> kWater{"cell"};
  const auto make = [depth](ShaderProgram& program, const char* vertex, const char* fragment,
                            std::span<const char* const> attributes) -> Result<void> {
    const std::array<const char*, 3> pieces{kVersion, depth, fragment};
    const Result<ShaderProgram> linked = ShaderProgram::link(vertex, pieces, attributes);
    if (!linked) return linked.error();
    program = *linked;
    return {};
  };
  if (Result<void> made = make(programs.ground, kGroundVertexShader, kGroundFragmentShader, kGround); !made)
    return made;
  if (Result<void> made = make(programs.tinted, kGroundVertexShader, kTintedFragmentShader, kGround); !made)
    return made;
  if (Result<void> made = make(programs.water, kWaterVertexShader, kWaterFragmentShader, kWater); !made)
    return made;
  return make(programs.deep, kWaterVertexShader, kDeepFragmentShader, kWater);
}

void ShaderPainter::release() {
  buffers_.clear();
  for (Programs* programs : {&ordinary_, &logarithmic_}) {
    for (ShaderProgram* program : {&programs->ground, &programs->tinted, &programs->water, &programs->deep}) {
      program->release();
    }
  }
  glDeleteTextures(1, &noise_);
  glDeleteBuffers(1, &waterVertices_);
  glDeleteBuffers(1, &waterIndices_);
  waterBytes_ = 0;
}

void ShaderPainter::makeNoise() {
  static const std::vector<std::uint8_t> texels = groundTexture();
  glGenTextures(1, &noise_);
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, noise_);
  glTexParameteri(GL_TEXTURE_2D, GL_GENERATE_MIPMAP, GL_TRUE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, kGroundTextureSide, kGroundTextureSide, 0, GL_RGBA,
               GL_UNSIGNED_BYTE, texels.data());
}

void ShaderPainter::makeWater() {
  waterBytes_ = uploadOnce(GL_ARRAY_BUFFER, waterVertices_, discVertices());
  waterBytes_ += uploadOnce(GL_ELEMENT_ARRAY_BUFFER, waterIndices_, discTriangles());
}

/// The programs for a picture, with all that is the same for the whole of it.
const ShaderPainter::Programs& ShaderPainter::prepare(const Picture& picture, const Anchor& anchor) const {
  const Programs& programs = picture.depthScale ? logarithmic_ : ordinary_;
  const SbVec3f eye(picture.eye - picture.placement.position(anchor));
  SbDPMatrix toClip = picture.toEye;
  toClip.multRight(picture.toClip);
  const SbVec3f detailEye(picture.detailEye - picture.placement.position(anchor));
  const ShaderProgram& ground = picture.tints.empty() ? programs.ground : programs.tinted;
  for (const ShaderProgram* program : {&ground, &programs.water, &programs.deep}) {
    program->use();
    program->set("toClip", toClip);
    program->set("spacing", static_cast<float>(picture.placement.spacing()));
    program->set("anchorHeight", anchor.height);
    program->set("eye", eye);
    program->set("tolerance", picture.morph.tolerance());
    program->set("ranges", picture.morph.ranges());
    program->set("detailEye", detailEye);
    program->set("phase", inPeriod(anchor.sample.column), inPeriod(anchor.sample.row));
    program->set("sun", picture.sun);
    program->set("viewDistance", picture.viewDistance);
    program->set("waterLevel", picture.waterLevel);
    program->set("haze", picture.haze);
    program->set("sunlight", picture.sunlight);
    program->set("deep", kDeepWater);
    program->set("clearShare", kClearShare);
    if (picture.depthScale) program->set("depthScale", (*picture.depthScale)[0], (*picture.depthScale)[1]);
  }
  return programs;
}

void ShaderPainter::draw(const Picture& picture, std::span<const Mesh* const> meshes) {
  const SavedState saved;
  buffers_.frame();
  const Anchor anchor = picture.placement.anchorNear(picture.eye, kAnchorStep);
  const Programs& programs = prepare(picture, anchor);
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, noise_);
  if (picture.water) drawFarWater(programs);
  // Backs of the ground are seen only from below; a mirroring model matrix turns fronts into backs.
  glEnable(GL_CULL_FACE);
  glCullFace(GL_BACK);
  glFrontFace(picture.toEye.det3() < 0.0 ? GL_CW : GL_CCW);
  drawGround(picture.tints.empty() ? programs.ground : programs.tinted, anchor.sample, meshes, picture.tints);
  glDisable(GL_CULL_FACE);
  if (picture.water) drawClearWater(programs.water);
}

void ShaderPainter::drawGround(const ShaderProgram& program, const Sample& anchor,
                               std::span<const Mesh* const> meshes, std::span<const SbColor> tints) {
  constexpr std::int64_t kExact = std::int64_t{1} << 23;  // leaves room for the mesh itself below 2^24
  glDisable(GL_BLEND);
  program.use();
  for (const GLuint attribute : kOfVertices) glEnableVertexAttribArray(attribute);
  for (std::size_t index = 0; index < meshes.size(); ++index) {
    const Mesh* mesh = meshes[index];
    if (!tints.empty()) program.set("tint", tints[index]);
    const std::int64_t column = mesh->originColumn - anchor.column;
    const std::int64_t row = mesh->originRow - anchor.row;
    if (std::abs(column) > kExact || std::abs(row) > kExact) continue;  // thousands of kilometres away
    const TerrainBuffers::Start start = buffers_.bind(*mesh);
    pointAttributes(start.vertices);
    glVertexAttrib3f(kPlace, static_cast<float>(column), static_cast<float>(row),
                     static_cast<float>(std::int64_t{1} << mesh->level));
    glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(mesh->indices->size()), GL_UNSIGNED_INT, start.indices);
  }
  for (const GLuint attribute : kOfVertices) glDisableVertexAttribArray(attribute);
}

void ShaderPainter::drawFarWater(const Programs& programs) const {
  glDisable(GL_BLEND);
  programs.water.use();
  drawRings(kClearRings, kWaterRings - kClearRings);
  glPushAttrib(GL_DEPTH_BUFFER_BIT);
  glDepthMask(GL_FALSE);
  programs.deep.use();
  drawRings(0, kClearRings);
  glPopAttrib();
}

void ShaderPainter::drawClearWater(const ShaderProgram& program) const {
  glEnable(GL_BLEND);
  glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  program.use();
  drawRings(0, kClearRings);
}

void ShaderPainter::drawRings(int first, int count) const {
  const int start = discIndices(first);
  const auto offset = static_cast<std::size_t>(start) * sizeof(std::uint16_t);
  glBindBuffer(GL_ARRAY_BUFFER, waterVertices_);
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, waterIndices_);
  glEnableVertexAttribArray(kCell);
  glVertexAttribPointer(kCell, 2, GL_FLOAT, GL_FALSE, 0, nullptr);
  glDrawElements(GL_TRIANGLES, discIndices(first + count) - start, GL_UNSIGNED_SHORT, at(nullptr, offset));
  glDisableVertexAttribArray(kCell);
}

}  // namespace teren
