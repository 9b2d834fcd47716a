// The moving lumen in 3-D, before and after side by side: one camera, one colour scale, one time. Plain WebGL.

export const surfaceVertex = `
attribute vec3 place, normal;
attribute vec2 value;            // (distance over the scale's range, 1), or (0, 0) where nothing was measured
uniform mat4 view;
varying vec3 facing;
varying vec2 measured;
void main() {
  gl_Position = view * vec4(place, 1.0);
  facing = mat3(view) * normal;
  measured = value;
}`;

export const surfaceFragment = `
precision mediump float;
uniform sampler2D scale;
uniform vec3 unmeasured;
varying vec3 facing;
varying vec2 measured;
void main() {
  vec3 n = normalize(facing);
  float light = 0.74 + 0.26 * abs(n.z) + 0.06 * n.y;
  vec3 colour = unmeasured;
  if (measured.y > 0.5) colour = texture2D(scale, vec2(0.5 + 0.5 * clamp(measured.x / measured.y, -0.995, 0.995), 0.5)).rgb;
  gl_FragColor = vec4(colour * light, 1.0);
}`;

export const lineVertex = `
attribute vec3 here, there;
attribute vec2 corner;           // along the piece: 0 or 1; to its side: -1 or 1
uniform mat4 view;
uniform vec2 pixel;              // size of a pixel in clip space
uniform float wide, nearer;
void main() {
  vec4 a = view * vec4(here, 1.0), b = view * vec4(there, 1.0);
  vec2 along = normalize((b.xy - a.xy) / pixel + vec2(1e-6, 0.0));
  vec4 at = mix(a, b, corner.x);
  gl_Position = at + vec4((vec2(-along.y, along.x) * corner.y + along * (2.0 * corner.x - 1.0) * 0.5) * wide * pixel, -nearer, 0.0);
}`;

export const lineFragment = `
precision mediump float;
uniform vec3 colour;
void main() { gl_FragColor = vec4(colour, 1.0); }`;
