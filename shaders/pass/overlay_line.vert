// Draws each segment as a rectangle of constant width on the screen, one instance per segment.

uniform mat4 clip_from_stage;
uniform vec2 viewport_px;
uniform float width_px;

layout(location = 0) in vec3 from;
layout(location = 1) in vec3 to;
layout(location = 2) in vec4 colour;

out vec4 line_colour;
out float offset_px;  // distance from the middle of the line

const float kNearest = 1e-5;

// Returns point, or the point of the segment just in front of the viewer if point is behind it.
vec4 ClipToFront(vec4 point, vec4 other) {
  if (point.w >= kNearest) {
    return point;
  }
  return mix(point, other, (kNearest - point.w) / (other.w - point.w));
}

void main() {
  vec4 a = clip_from_stage * vec4(from, 1.0);
  vec4 b = clip_from_stage * vec4(to, 1.0);
  line_colour = colour;
  if (max(a.w, b.w) < kNearest) {
    offset_px = 0.0;
    gl_Position = vec4(0.0, 0.0, 2.0, 1.0);  // outside the clip volume
    return;
  }
  vec4 front_a = ClipToFront(a, b);
  vec4 front_b = ClipToFront(b, a);
  vec3 start = front_a.xyz / front_a.w;
  vec3 end = front_b.xyz / front_b.w;
  vec2 along = (end.xy - start.xy) * viewport_px;
  float length_px = length(along);
  along = length_px > 1e-6 ? along / length_px : vec2(1.0, 0.0);

  float side = (gl_VertexID & 1) == 0 ? -1.0 : 1.0;
  offset_px = side * 0.5 * (width_px + 1.0);  // the rim fades over one pixel
  vec2 across = vec2(-along.y, along.x) * offset_px * 2.0 / viewport_px;
  vec3 middle = gl_VertexID < 2 ? start : end;
  gl_Position = vec4(middle.xy + across, middle.z, 1.0);
}
