#include "coin/ShaderPainter.h"

#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <span>
#include <string>
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

/// The ground's texture repeats after about 2 km and exactly kGrains grains, which are a whole number of
/// samples, so that its place is exact anywhere. Patterns are as large on any lattice.
struct Period {
  static constexpr double kGrains = 1024.0, kMetres = 2048.0;
  explicit Period(double spacing)
      : samples(static_cast<std::int64_t>(std::clamp(std::round(kMetres / spacing), 1.0, 0x1p23))),
        grain(kGrains / static_cast<double>(samples)) {}
  /// [grains] -kGrains / 2 ... kGrains / 2
  float place(std::int64_t sample) const {
    const std::int64_t ahead = ((sample % samples) + samples) % samples;
    return static_cast<float>(grain * static_cast<double>(2 * ahead < samples ? ahead : ahead - samples));
  }
  std::int64_t samples;
  double grain;  // grains of a sample
};

const SbVec3f kDeepWater(0.05F, 0.16F, 0.22F);
constexpr int kClearRings = 14;  // of the water's disc: see kClearShare
static_assert(WaterCells::radius(kClearRings) == kClearShare);

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
  if (const Result<void> linked = painter->link(); !linked) {
    painter->release();
    return linked.error();
  }
  const SavedState saved;
  painter->makeNoise();
  painter->water_.make();
  return std::unique_ptr<TerrainPainter>(std::move(painter));
}

Result<void> ShaderPainter::link() {
  struct Depth {
    const char *ofVertices, *ofFragments;
  };
  constexpr std::array<Depth, kDepths> kDepth{{{kProjectedDepth, kOrdinaryDepth},
                                               {kProjectedDepth, kLogarithmicDepthShader},
                                               {kDepthOfVertices, kOrdinaryDepth}}};
  struct Kind {
    const char *detail, *height, *fragment;
  };
  constexpr std::array<Kind, kGrounds> kGround{{{kDetail, "", kGroundFragmentShader},
                                                {kDetail, kHighOrLow, kGroundFragmentShader},
                                                {kNoDetail, kHighOrLow, kGroundFragmentShader},
                                                {kNoDetail, "", kTintedFragmentShader}}};
  constexpr std::array<Kind, kWaters> kWater{{{kDetail, "", kWaterFragmentShader},
                                              {kNoDetail, "", kWaterFragmentShader},
                                              {kNoDetail, "", kDeepFragmentShader}}};
  constexpr std::array<const char*, 6> kGroundAttributes{"cell",  "height",        "slope",
                                                         "place", "coarserHeight", "coarserSlope"};
  const auto make = [](ShaderProgram& program, const char* vertex, const Depth& depth, const Kind& kind,
                       std::span<const char* const> attributes) -> Result<void> {
    const std::string placed = std::string(kVersion) + depth.ofVertices + vertex;
    const std::array<const char*, 5> pieces{kVersion, depth.ofFragments, kind.detail, kind.height,
                                            kind.fragment};
    const Result<ShaderProgram> linked = ShaderProgram::link(placed.c_str(), pieces, attributes);
    if (!linked) return linked.error();
    program = *linked;
    return {};
  };
  for (std::size_t depth = 0; depth < kDepths; ++depth) {
    Programs& programs = programs_[depth];
    for (std::size_t kind = 0; kind < kGrounds; ++kind) {
      if (Result<void> made = make(programs.ground[kind], kGroundVertexShader, kDepth[depth], kGround[kind],
                                   kGroundAttributes);
          !made)
        return made;
    }
    if (depth == kByVertex) continue;  // the water's triangles are too large
    for (std::size_t kind = 0; kind < kWaters; ++kind) {
      if (Result<void> made = make(programs.water[kind], kWaterVertexShader, kDepth[depth], kWater[kind],
                                   std::span(kGroundAttributes).first(1));
          !made)
        return made;
    }
  }
  return {};
}

void ShaderPainter::forget(const Mesh& mesh) {
  buffers_.forget(mesh);
  depthByVertex_.forget(mesh);
}

void ShaderPainter::release() {
  buffers_.clear();
  for (Programs& programs : programs_) {
    for (ShaderProgram& program : programs.ground) program.release();
    for (ShaderProgram& program : programs.water) program.release();
  }
  glDeleteTextures(1, &noise_);
  water_.release();
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

/// Tells a program all that is the same for the whole of a picture.
void ShaderPainter::prepare(const ShaderProgram& program, const Picture& picture, const Anchor& anchor,
                            const SbDPMatrix& toClip) {
  program.use();
  program.set("toClip", toClip);
  program.set("spacing", static_cast<float>(picture.placement.spacing()));
  program.set("anchorHeight", anchor.height);
  program.set("eye", SbVec3f(picture.eye - picture.placement.position(anchor)));
  program.set("tolerance", picture.morph.tolerance());
  program.set("ranges", picture.morph.ranges());
  program.set("detailEye", SbVec3f(picture.detailEye - picture.placement.position(anchor)));
  const Period period(picture.placement.spacing());
  program.set("phase", period.place(anchor.sample.column), period.place(anchor.sample.row));
  program.set("grain", static_cast<float>(period.grain));
  program.set("sun", picture.sun);
  program.set("viewDistance", picture.viewDistance);
  program.set("detailEnds", static_cast<float>(kDetailEnds));
  program.set("waterLevel", picture.waterLevel);
  program.set("haze", picture.haze);
  program.set("sunlight", picture.sunlight);
  program.set("deep", kDeepWater);
  program.set("clearShare", kClearShare);
  if (picture.depthScale) program.set("depthScale", (*picture.depthScale)[0], (*picture.depthScale)[1]);
}

void ShaderPainter::draw(const Picture& picture, std::span<const Mesh* const> meshes) {
  const SavedState saved;
  buffers_.frame();
  const Anchor anchor = picture.placement.anchorNear(picture.eye, kAnchorStep);
  SbDPMatrix toClip = picture.toEye;
  toClip.multRight(picture.toClip);
  for (const std::size_t depth : {kOrdinary, kByFragment, kByVertex}) {
    if ((depth == kOrdinary) == picture.depthScale.has_value()) continue;
    for (std::size_t kind = 0; kind < kGrounds; ++kind) {
      if ((kind == kTinted) != picture.tints.empty())
        prepare(programs_[depth].ground[kind], picture, anchor, toClip);
    }
    if (depth == kByVertex || picture.wet.empty()) continue;
    for (const ShaderProgram& program : programs_[depth].water) prepare(program, picture, anchor, toClip);
  }
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, noise_);
  findWater(picture);
  if (!picture.wet.empty()) drawFarWater(picture);
  // Backs of the ground are seen only from below; a mirroring model matrix turns fronts into backs.
  glEnable(GL_CULL_FACE);
  glCullFace(GL_BACK);
  glFrontFace(picture.toEye.det3() < 0.0 ? GL_CW : GL_CCW);
  drawGround(picture, anchor.sample, toClip, meshes);
  glDisable(GL_CULL_FACE);
  if (!picture.wet.empty()) drawClearWater(picture);
}

/// The program that draws a mesh.
const ShaderProgram& ShaderPainter::programFor(const Mesh& mesh, const Picture& picture,
                                               const SbDPMatrix& toClip) {
  std::size_t depth = kOrdinary;
  if (picture.depthScale)
    depth = depthByVertex_.does(mesh, picture.placement, picture.eye, toClip) ? kByVertex : kByFragment;
  if (!picture.tints.empty()) return programs_[depth].ground[kTinted];
  const SbVec3f eye(picture.eye);
  const float away = (picture.placement.box(mesh).getClosestPoint(eye) - eye).length();
  const bool plain = mesh.maxHeight <= kSnowAbove && mesh.minHeight >= picture.waterLevel + kShoreBelow;
  return programs_[depth].ground[static_cast<double>(away) >= kDetailEnds ? kDistant
                                 : plain                                  ? kPlain
                                                                          : kHighOrLowGround];
}

void ShaderPainter::drawGround(const Picture& picture, const Sample& anchor, const SbDPMatrix& toClip,
                               std::span<const Mesh* const> meshes) {
  constexpr std::int64_t kExact = std::int64_t{1} << 23;  // leaves room for the mesh itself below 2^24
  glDisable(GL_BLEND);
  for (const GLuint attribute : kOfVertices) glEnableVertexAttribArray(attribute);
  const ShaderProgram* last = nullptr;
  for (std::size_t index = 0; index < meshes.size(); ++index) {
    const Mesh* mesh = meshes[index];
    const std::int64_t column = mesh->originColumn - anchor.column;
    const std::int64_t row = mesh->originRow - anchor.row;
    if (std::abs(column) > kExact || std::abs(row) > kExact) continue;  // thousands of kilometres away
    const ShaderProgram* program = &programFor(*mesh, picture, toClip);
    if (program != last) program->use();
    last = program;
    if (!picture.tints.empty()) program->set("tint", picture.tints[index]);
    const TerrainBuffers::Start start = buffers_.bind(*mesh);
    pointAttributes(start.vertices);
    glVertexAttrib3f(kPlace, static_cast<float>(column), static_cast<float>(row),
                     static_cast<float>(std::int64_t{1} << mesh->level));
    glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(mesh->indices->size()), GL_UNSIGNED_INT, start.indices);
  }
  for (const GLuint attribute : kOfVertices) glDisableVertexAttribArray(attribute);
}

void ShaderPainter::findWater(const Picture& picture) {
  cells_.clear();
  const auto reach = static_cast<double>(picture.viewDistance);
  for (const SbBox2f& wet : picture.wet) {
    const SbVec2f low = wet.getMin(), high = wet.getMax();
    cells_.mark((static_cast<double>(low[0]) - picture.eye[0]) / reach,
                (static_cast<double>(low[1]) - picture.eye[1]) / reach,
                (static_cast<double>(high[0]) - picture.eye[0]) / reach,
                (static_cast<double>(high[1]) - picture.eye[1]) / reach);
  }
}

void ShaderPainter::drawFarWater(const Picture& picture) {
  const std::span<const ShaderProgram, kWaters> water =
      programs_[picture.depthScale ? kByFragment : kOrdinary].water;
  glDisable(GL_BLEND);
  const bool smooth = static_cast<double>(kClearShare * picture.viewDistance) >= kDetailEnds;
  water[smooth ? kSmoothWater : kRippledWater].use();
  water_.draw(cells_, kClearRings, WaterCells::kRings - kClearRings, kCell);
  glPushAttrib(GL_DEPTH_BUFFER_BIT);
  glDepthMask(GL_FALSE);
  water[kDeepWaterBelow].use();
  water_.draw(cells_, 0, kClearRings, kCell);
  glPopAttrib();
}

void ShaderPainter::drawClearWater(const Picture& picture) {
  glEnable(GL_BLEND);
  glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  programs_[picture.depthScale ? kByFragment : kOrdinary].water[kRippledWater].use();
  water_.draw(cells_, 0, kClearRings, kCell);
}

}  // namespace teren
