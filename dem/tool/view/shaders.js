// SPDX-License-Identifier: MIT
// Ellipsoids and force chains as flat pieces whose every pixel finds its ray's point: outlines are exact, without a
// mesh. The rays are parallel. With L L' = A A' by Cholesky, A the axes in the frame of the screen (z towards the
// eye), a body is { c + L s : |s| <= 1 }: its outline is |(s1, s2)| = 1, and what is seen there has s3 = sqrt(1 - s1^2 - s2^2).

const COMMON = `#version 300 es
precision highp float;
uniform mat3 turn;      // space to screen
uniform vec3 middle;    // of the picture, in space
uniform vec2 scale;     // length to half the picture
uniform float reach;    // of depths, length
uniform vec4 plane;     // in the screen's frame, n.p <= w is drawn; n = 0: all
`;
// Items are read from a texture by the number of the vertex, six an item: drawn as instances they would take ten times
// as long by a processor, which begins anew with each.
const ITEMS = `
uniform highp sampler2D items;
const vec2 kCorners[6] = vec2[6](vec2(-1, -1), vec2(1, -1), vec2(-1, 1), vec2(-1, 1), vec2(1, -1), vec2(1, 1));
vec4 item(int texels, int which) {
  int at = gl_VertexID / 6 * texels + which, wide = textureSize(items, 0).x;
  return texelFetch(items, ivec2(at % wide, at / wide), 0);
}
`;
const LIGHT = `
uniform sampler2D ramp;
out vec4 colour;
float depth_of(float z) { return 0.5 - 0.5 * z / reach; }
vec3 lit(float value, vec3 n) {
  vec3 base = value < -0.5 ? vec3(0.75) : texture(ramp, vec2(clamp(value, 0.002, 0.998), 0.5)).rgb;
  float light = 0.35 + 0.65 * max(0.0, dot(n, normalize(vec3(-0.35, 0.45, 0.82))));
  return base * light;
}
`;

// Three texels: centre and value, orientation x y z w, semi-axes.
const BODY_VERTEX = COMMON + ITEMS + `
uniform float size;  // of bodies, to their own
out vec2 s;
flat out vec3 at;
flat out vec3 diagonal;  // of L
flat out vec3 below;     // l21, l31, l32
flat out float shade;
flat out int body;
mat3 rotation(vec4 q) {
  q = normalize(q);
  vec3 v = q.xyz + q.xyz;
  vec3 xx = q.x * v, yy = q.y * v, w = q.w * v;
  float zz = q.z * v.z;
  return mat3(1.0 - yy.y - zz, xx.y + w.z, xx.z - w.y, xx.y - w.z, 1.0 - xx.x - zz, yy.z + w.x,
              xx.z + w.y, yy.z - w.x, 1.0 - xx.x - yy.y);
}
void main() {
  vec4 first = item(3, 0);
  mat3 a = turn * rotation(item(3, 1));
  vec3 r = size * item(3, 2).xyz;
  a = mat3(a[0] * r.x, a[1] * r.y, a[2] * r.z);
  vec3 x = vec3(a[0].x, a[1].x, a[2].x), y = vec3(a[0].y, a[1].y, a[2].y), z = vec3(a[0].z, a[1].z, a[2].z);
  float l11 = length(x), l21 = dot(x, y) / l11, l31 = dot(x, z) / l11;
  float l22 = length(y - x * (l21 / l11));
  float l32 = (dot(y, z) - l21 * l31) / l22;
  // The determinant of L is the volume: without a difference of squares.
  diagonal = vec3(l11, l22, r.x * r.y * r.z / (l11 * l22));
  below = vec3(l21, l31, l32);
  at = turn * (first.xyz - middle);
  s = kCorners[gl_VertexID % 6];
  shade = first.w;
  body = gl_VertexID / 6;
  gl_Position = vec4((at.xy + vec2(l11 * s.x, l21 * s.x + l22 * s.y)) * scale, 0.0, 1.0);
}`;

const BODY_FRAGMENT = COMMON + LIGHT + `
in vec2 s;
flat in vec3 at;
flat in vec3 diagonal;
flat in vec3 below;
flat in float shade;
flat in int body;
uniform int picked;
void main() {
  float rest = 1.0 - dot(s, s);
  if (rest < 0.0) discard;
  float s3 = sqrt(rest);
  float lean = at.z + below.y * s.x + below.z * s.y, far = diagonal.z * s3;
  float z = lean + far;
  vec3 n;
  n.z = s3 / diagonal.z;
  n.y = (s.y - below.z * n.z) / diagonal.y;
  n.x = (s.x - below.x * n.y - below.y * n.z) / diagonal.x;
  n = normalize(n);
  if (plane.xyz != vec3(0.0)) {
    vec3 p = at + vec3(diagonal.x * s.x, below.x * s.x + diagonal.y * s.y, 0.0);
    float outside = plane.x * p.x + plane.y * p.y + plane.z * z - plane.w;
    if (outside > 0.0) {
      // The ray goes on to the plane: a flat cut where that lies within the body.
      if (plane.z <= 1e-6) discard;
      z -= outside / plane.z;
      if (z < lean - far) discard;
      n = plane.xyz;
    }
  }
  gl_FragDepth = depth_of(z);
  vec3 c = lit(shade, n);
  if (body == picked) c = mix(c, vec3(1.0, 0.1, 0.5), 0.6);
  colour = vec4(c, 1.0);
}`;

// Two texels: the ends, with half the width and the value.
const CHAIN_VERTEX = COMMON + ITEMS + `
out float side;
out vec3 p;
flat out float radius;
flat out float shade;
flat out vec2 across;
void main() {
  vec4 from = item(2, 0), to = item(2, 1);
  vec2 corner = kCorners[gl_VertexID % 6];
  vec3 a = turn * (from.xyz - middle), b = turn * (to.xyz - middle);
  vec2 way = b.xy - a.xy;
  float size = length(way);
  across = size > 0.0 ? vec2(-way.y, way.x) / size : vec2(1.0, 0.0);
  side = corner.y;
  radius = from.w;
  shade = to.w;
  p = mix(a, b, 0.5 + 0.5 * corner.x) + vec3(across * radius * side, 0.0);
  gl_Position = vec4(p.xy * scale, 0.0, 1.0);
}`;

const CHAIN_FRAGMENT = COMMON + LIGHT + `
in float side;
in vec3 p;
flat in float radius;
flat in float shade;
flat in vec2 across;
void main() {
  float up = sqrt(max(0.0, 1.0 - side * side));
  vec3 q = p + vec3(0.0, 0.0, radius * up);
  if (dot(plane.xyz, q) > plane.w) discard;
  gl_FragDepth = depth_of(q.z);
  colour = vec4(lit(shade, vec3(across * side, up)), 1.0);
}`;

const EDGE_VERTEX = COMMON + `
layout(location = 0) in vec3 place;
void main() {
  vec3 p = turn * (place - middle);
  gl_Position = vec4(p.xy * scale, -p.z / reach, 1.0);
}`;
const EDGE_FRAGMENT = COMMON + `
out vec4 colour;
void main() { colour = vec4(0.45, 0.47, 0.5, 1.0); }`;
