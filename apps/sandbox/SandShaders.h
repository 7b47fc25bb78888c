// The GLSL programs that draw sand, for OpenGL 2.1.
#pragma once

namespace teren {

/// Numbers of the vertex attributes.
enum SandAttribute : unsigned { kSandPlace = 0, kSandHeight = 1, kSandLoose = 2, kSandNormal = 3 };

inline constexpr char kSandVertexShader[] = R"(#version 120
invariant gl_Position;
attribute vec2 place;   // [steps]
attribute float height;  // [m]
attribute float loose;   // [m]
attribute vec2 normal;   // times 32767
uniform float step;      // [m]
uniform float hiding;    // [m] of loose material that hide the ground
varying vec3 position;   // [m]
varying vec4 ground;     // normal, and how much of what is seen is loose

void main() {
  position = vec3(place * step, height);
  gl_Position = gl_ModelViewProjectionMatrix * vec4(position, 1.0);
  vec2 across = normal * (1.0 / 32767.0);
  ground = vec4(across, sqrt(max(1.0 - dot(across, across), 0.0)), clamp(loose / hiding, 0.0, 1.0));
}
)";

/// Grain is noise in two octaves that follow the distance: those whose cells are 1.4 to 5.6 pixels wide. So
/// it is fine however near one looks, and does not flicker from afar: cells wider than 1/400 of the box do
/// not exist, so where those are too small to be seen sand is smooth. It is laid on from above, on walls
/// steeper than 60 degrees from beside.
inline constexpr char kSandFragmentShader[] = R"(#version 120
uniform vec3 sun;        // towards it
uniform vec3 sunlight;
uniform float moisture;
uniform float cells;     // of the coarsest octave [1/m]
uniform float cut;
uniform float sky;
uniform float wet;
uniform vec3 looseColour;
uniform vec3 solidColour;
uniform vec3 shade;
uniform vec3 light;
varying vec3 position;
varying vec4 ground;

// No cell lies along the sides of the box, where its lattice would be seen.
const mat2 kTurn = mat2(0.8, 0.6, -0.6, 0.8);

float random(vec2 cell) {
  vec3 p = fract(cell.xyx * vec3(0.1031, 0.1030, 0.0973));
  p += dot(p, p.yzx + 33.33);
  return fract((p.x + p.y) * p.z) * 2.0 - 1.0;
}

// Value noise of one octave: its gradient in cells, and itself.
vec3 noise(vec2 at) {
  vec2 cell = floor(at), t = at - cell;
  vec2 s = t * t * (3.0 - 2.0 * t), slope = 6.0 * t * (1.0 - t);
  float a = random(cell), b = random(cell + vec2(1.0, 0.0));
  float c = random(cell + vec2(0.0, 1.0)), d = random(cell + vec2(1.0, 1.0));
  float across = a - b - c + d;
  return vec3(slope * vec2(b - a + across * s.y, c - a + across * s.x),
              a + (b - a) * s.x + (c - a) * s.y + across * s.x * s.y);
}

void main() {
  vec3 normal = normalize(ground.xyz);
  bool wall = normal.z < 0.5;
  vec2 at = (wall ? vec2(position.x + position.y, position.z) : position.xy) * cells;
  vec2 eastwards = dFdx(at), northwards = dFdy(at);
  float pixel = max(max(length(eastwards), length(northwards)), 1e-9);  // [cells of the coarsest octave]
  float finest = log2(0.7 / pixel);                                     // the octave of cells of 1.4 pixels
  float first = max(ceil(finest) - 2.0, 0.0);
  vec2 gradient = vec2(0.0);
  float value = 0.0;
  for (int k = 0; k < 2; ++k) {
    float octave = first + float(k);
    float finer = finest - octave;  // by how many octaves finer ones could be seen
    float weight = min(finer, 1.0) * (2.0 - finer);
    if (finer <= 0.0) continue;
    vec3 one = noise(kTurn * at * exp2(octave) + 17.0 * octave);
    gradient += weight * (one.xy * kTurn);
    value += weight * one.z;
  }
  float loose = ground.w;
  vec3 bump = (wall ? gradient.xxy : vec3(gradient, 0.0)) * mix(0.09, 0.14, loose) * (1.0 - 0.4 * moisture);
  vec3 bumped = normalize(normal - (bump - normal * dot(normal, bump)));

  float lit = sky * (0.5 + 0.5 * bumped.z) + (1.0 - sky) * max(dot(bumped, sun), 0.0);
  float stretched = (lit - cut) / (1.0 - 2.0 * cut);
  // Rounded at both ends: 0 for -0.25 and less, 1 for 1.25 and more.
  stretched = smoothstep(-0.25, 1.25, stretched);
  // From afar sand is not all one colour.
  float broad = clamp(0.5 * finest + 2.0, 0.0, 1.0) * noise(at * (1.0 / 16.0)).z;
  vec3 colour = mix(solidColour, looseColour, loose) * (1.0 + 0.12 * value + 0.04 * broad);
  colour *= mix(1.0, wet, moisture);
  gl_FragColor = vec4(colour * mix(shade, light * sunlight, stretched), 1.0);
}
)";

/// Edges, in one colour.
inline constexpr char kSandWireShader[] = R"(#version 120
uniform vec3 colour;
uniform float cover;

void main() { gl_FragColor = vec4(colour, cover); }
)";

}  // namespace teren
