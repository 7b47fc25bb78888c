// The GLSL programs that draw ground and water, for OpenGL 2.1. Before each shader comes kVersion; before the
// ground's vertex shader kProjectedDepth or kDepthOfVertices; before a fragment shader kOrdinaryDepth or
// kLogarithmicDepthShader, and before that of ground and water kDetail or kNoDetail.
#pragma once

namespace teren {

/// Numbers of the vertex attributes.
enum GroundAttribute : unsigned {
  kCell = 0,
  kHeight = 1,
  kSlope = 2,
  kPlace = 3,
  kCoarserHeight = 4,
  kCoarserSlope = 5
};

inline constexpr char kVersion[] = "#version 120\n";

/// What the rasterizer makes of the depth, so that hidden fragments need not be computed.
inline constexpr char kOrdinaryDepth[] = "void writeDepth() {}\n";

inline constexpr char kProjectedDepth[] = "invariant gl_Position;\nvoid placeDepth() {}\n";
/// The logarithmic depth (LogarithmicDepth.h) at the vertices: see DepthByVertex.
inline constexpr char kDepthOfVertices[] = R"(
invariant gl_Position;
uniform vec2 depthScale;
void placeDepth() {
  gl_Position.z = (2.0 * depthScale.y * log2(depthScale.x * gl_Position.w) - 1.0) * gl_Position.w;
}
)";

/// Noise that repeats after some 128 m: from afar its repetition would be a pattern. `near` is 1 at the eye
/// and 0 from where there is none (see kDetailEnds).
inline constexpr char kDetail[] = R"(
uniform sampler2D noise;
vec4 detail(vec2 place, float near) { return (texture2D(noise, place) - 0.5) * near; }
)";
inline constexpr char kNoDetail[] = "vec4 detail(vec2 place, float near) { return vec4(0.0); }\n";
inline constexpr double kDetailEnds = 3072.0;  ///< [m] from the eye

/// Snow and shores are computed for meshes with ground above the one or below the other [m]: the noise moves
/// them by so much at most.
inline constexpr char kHighOrLow[] = "#define HIGH_OR_LOW\n";
inline constexpr float kSnowAbove = 420.0F - 0.5F * (150.0F + 25.0F);
inline constexpr float kShoreBelow = 7.0F + 0.5F * 8.0F;  ///< above the water's level

/// Watertight by arithmetic: `cell * place.z + place.xy` is a whole number below 2^24, so it is exact and
/// equal for the shared vertices of neighbouring meshes, whichever mesh it is counted from; everything after
/// it is the same computation on the same numbers. Precise by arithmetic: the anchor is near the eye, so no
/// step loses more than some last digits of a vertex's distance from the eye. How near a vertex draws to the
/// next coarser surface is Morph::share, from attributes that are equal wherever it is shared.
inline constexpr char kGroundVertexShader[] = R"(
attribute vec2 cell;     // column and row in the mesh
attribute float height;  // [m]
attribute vec2 slope;    // x and y of the unit normal, times 32767
attribute vec3 place;    // the mesh's origin counted from the anchor, and its step
attribute float coarserHeight;  // [m] of the next coarser surface
attribute vec2 coarserSlope;    // likewise; the last four bits of x are the level
uniform mat4 toClip;         // from positions relative to the eye
uniform float spacing;       // [m]
uniform float anchorHeight;  // [m]
uniform vec3 eye;            // [m] from the anchor
uniform vec2 phase;          // where in the texture's period of 1024 grains the anchor is
uniform float grain;         // grains of a sample
uniform vec3 sun;            // towards it
uniform float viewDistance;  // [m]
uniform float tolerance;     // Morph
uniform vec2 ranges[16];     // its, by level
uniform vec3 detailEye;      // [m] from the anchor: whose distance counts
uniform sampler2D noise;
uniform vec3 sunlight;
uniform float waterLevel;    // [m]
uniform float detailEnds;    // [m]
varying vec2 grains;
varying vec4 growth;   // height, gradient, strata and woods, with the noise over hundreds of metres in them
varying vec4 light;    // what of the ground's colour reaches the eye, and how much of the haze
varying vec4 more;     // tone, depth below the water, how far beyond the view's end, how much detail
varying float direct;  // sunlight

void main() {
  vec2 counted = cell * place.z + place.xy;
  grains = counted * grain + phase;
  vec2 flatPlace = counted * spacing;
  float level = mod(coarserSlope.x, 16.0);
  vec2 range = ranges[int(level)];
  float away = distance(vec3(flatPlace, height - anchorHeight), detailEye);
  float along = clamp((tolerance * away - range.x) * range.y, 0.0, 1.0);
  float near_ = along * along;
  float drawn = mix(height, coarserHeight, near_);
  vec3 position = vec3(flatPlace, drawn - anchorHeight) - eye;
  gl_Position = toClip * vec4(position, 1.0);
  placeDepth();

  vec2 flat_ = mix(slope, coarserSlope + vec2(8.0 - level, 0.0), near_) * (1.0 / 32767.0);
  float squared = dot(flat_, flat_);
  float up = sqrt(max(1.0 - squared, 1e-4));
  direct = max(dot(vec3(flat_, up), sun), 0.0);
  float share = min(length(position.xy) / viewDistance, 1.0);
  float cube = share * share * share;
  float clear = exp(-1.1 * share) * (1.0 - cube * cube);
  float end = smoothstep(0.97, 1.0, 1.0 - clear);
  clear *= 1.0 - end;
  vec4 broad = texture2DLod(noise, grains * (1.0 / 1024.0), 0.0) - 0.5;  // once a vertex is enough
  growth = vec4(drawn + 150.0 * broad.r, sqrt(squared) / up + 0.3 * broad.g, 0.028 * drawn + 4.0 * broad.r,
                broad.a);
  light = vec4(clear * (1.0 + 0.3 * broad.g) * (vec3(0.40, 0.46, 0.56) + sunlight * direct), 1.0 - clear);
  more = vec4(broad.b, waterLevel - drawn, end, clamp(2.0 - 2.0 * length(position) / detailEnds, 0.0, 1.0));
}
)";

/// Before it kHighOrLow may come.
inline constexpr char kGroundFragmentShader[] = R"(
uniform vec3 haze;
uniform vec3 deep;  // what the water swallows
varying vec2 grains;
varying vec4 growth;
varying vec4 light;
varying vec4 more;

// Straight, where smoothstep would be round: with the noise on top nobody sees it, and it costs a third.
float ramp(float from, float to, float value) {
  return clamp(value * (1.0 / (to - from)) - from / (to - from), 0.0, 1.0);
}

void main() {
  vec4 fine = detail(grains * (1.0 / 64.0), more.w);
  float height = growth.x + 25.0 * fine.r;
  float steep = growth.y + 0.35 * fine.g;

  vec3 grass = mix(vec3(0.26, 0.34, 0.13), vec3(0.40, 0.41, 0.20), clamp(0.5 + 2.0 * more.x + fine.b, 0.0, 1.0));
  vec3 forest = vec3(0.13, 0.21, 0.10) * (1.0 + 0.9 * fine.a);
  float trees = ramp(0.02, 0.10, growth.w + 0.35 * fine.b) * ramp(260.0, 120.0, height);
  vec3 alpine = vec3(0.43, 0.41, 0.27);
  vec3 colour = mix(mix(grass, alpine, ramp(120.0, 380.0, height)), forest, trees);

  float strata = abs(fract(growth.z + fine.g) - 0.5);
  vec3 rock = vec3(0.47, 0.43, 0.39) * (0.86 + 0.45 * strata + 0.7 * fine.b + 0.5 * more.x);
  colour = mix(colour, rock, ramp(0.55, 0.80, steep));
#ifdef HIGH_OR_LOW
  float snow = ramp(420.0, 480.0, height) * ramp(1.05, 0.70, steep);
  colour = mix(colour, vec3(0.93, 0.95, 0.99), snow);
  float shore = ramp(-7.0, -2.5, more.y + 8.0 * fine.r) * ramp(0.75, 0.45, steep);
  colour = mix(colour, vec3(0.74, 0.67, 0.50) * (1.0 + 0.3 * fine.a), shore);
#endif
  vec3 seen = colour * ((1.0 + 0.35 * fine.g) * light.rgb) + haze * light.a;
#ifdef HIGH_OR_LOW
  // Below the water nothing is lost in haze but everything in the deep: the water above has the haze.
  // Where the view ends the water ends too, and haze covers what is left, deep or not.
  seen = mix(mix(deep, seen, exp2(-0.13 * max(more.y, 0.0))), haze, more.z);
#endif
  gl_FragColor = vec4(seen, 1.0);
  writeDepth();
}
)";

/// For the same vertices: each mesh in a colour of its own, lit, in so thin a haze that the colour can be
/// told to the end of the view.
inline constexpr char kTintedFragmentShader[] = R"(
uniform vec3 tint;
uniform vec3 haze;
uniform vec3 deep;  // what the water swallows
varying vec4 light;
varying vec4 more;
varying float direct;

void main() {
  vec3 seen = mix(tint * (0.45 + 0.55 * direct), haze, 0.4 * light.a);
  gl_FragColor = vec4(mix(deep, seen, exp2(-0.13 * max(more.y, 0.0))), 1.0);
  writeDepth();
}
)";

/// A disc around the eye at the water's level.
inline constexpr char kWaterVertexShader[] = R"(
attribute vec2 cell;  // in the unit disc
uniform mat4 toClip;         // from positions relative to the eye
uniform float spacing;       // [m]
uniform float anchorHeight;  // [m]
uniform vec3 eye;            // [m] from the anchor
uniform vec2 phase;          // where in the texture's period of 1024 grains the anchor is
uniform float grain;         // grains of a sample
uniform float viewDistance;  // [m]
uniform float waterLevel;    // [m]
uniform float clearShare;    // of the view distance: from there the water is opaque
uniform float detailEnds;    // [m]
varying vec2 grains;
varying vec4 view;  // from the eye, and the haze
varying vec2 opaque;  // and how much detail

void main() {
  vec3 position = vec3(cell * viewDistance, waterLevel - anchorHeight - eye.z);
  gl_Position = toClip * vec4(position, 1.0);
  grains = (eye.xy + position.xy) / spacing * grain + phase;
  float share = min(length(cell), 1.0);
  opaque = clamp(vec2(1.5 * share / clearShare - 0.5, 2.0 - 2.0 * length(position) / detailEnds), 0.0, 1.0);
  float cube = share * share * share;
  view = vec4(position, 1.0 - exp(-1.1 * share) * (1.0 - cube * cube));
}
)";

inline constexpr char kWaterFragmentShader[] = R"(
uniform vec3 haze;
uniform vec3 deep;
uniform vec3 sun;
uniform vec3 sunlight;
varying vec2 grains;
varying vec4 view;
varying vec2 opaque;

void main() {
  // Turned, so that the repetition does not run along the axes; still whole periods in 1024 grains.
  vec2 turned = vec2(3.0 * grains.x + grains.y, 3.0 * grains.y - grains.x);
  vec2 ripples = detail(turned * (1.0 / 256.0), opaque.y).rg;
  vec3 normal = vec3(0.26 * ripples, 1.0);  // of length 1 within 2 %
  vec3 ray = normalize(view.xyz);
  vec3 mirrored = reflect(ray, normal);
  float grazing = 1.0 - clamp(abs(dot(ray, normal)), 0.0, 1.0);
  float squared = grazing * grazing;
  float fresnel = 0.03 + 0.85 * squared * squared * grazing;
  vec3 sky = mix(haze, vec3(0.26, 0.45, 0.72), sqrt(clamp(mirrored.z, 0.0, 1.0)));
  float glint = max(dot(mirrored, sun), 0.0);
  glint *= glint;
  glint *= glint;
  glint *= glint;
  glint *= glint;
  glint *= glint;
  glint *= glint * glint * glint;  // to the power of 128
  vec3 colour = mix(deep * 1.15, sky, fresnel) + sunlight * glint;
  float cover = max(0.62 + 0.38 * opaque.x, max(fresnel, glint));
  gl_FragColor = vec4(mix(colour, haze, view.w), mix(cover, 1.0, view.w));
  writeDepth();
}
)";

/// The same disc, far below and behind everything.
inline constexpr char kDeepFragmentShader[] = R"(
uniform vec3 deep;

void main() {
  gl_FragColor = vec4(deep, 1.0);
  writeDepth();
}
)";

}  // namespace teren
