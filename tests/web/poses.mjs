// Distances between poses in pixels, for tests.

function inCamera({rotation: [x, y, z, w], translation: t}, p) {
  const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
  const v = [x, y, z];
  const once = cross(v, p).map((c) => 2 * c);
  const twice = cross(v, once);
  return p.map((c, i) => c + w * once[i] + twice[i] + t[i]);
}

export function pixel(pose, c, point) {
  const [px, py, pz] = inCamera(pose, point);
  const [x, y] = [px / pz, py / pz];
  const r2 = x * x + y * y;
  const radial = 1 + c.k1 * r2 + c.k2 * r2 * r2;
  return [c.fx * (x * radial + 2 * c.p1 * x * y + c.p2 * (r2 + 2 * x * x)) + c.cx,
    c.fy * (y * radial + c.p1 * (r2 + 2 * y * y) + 2 * c.p2 * x * y) + c.cy];
}

// The largest distance between where a tracked image and tracker_reference see the points of the latter.
export function distancePx(tracked, expected) {
  return Math.max(...expected.points.map((point) => {
    const [a, b] = [pixel(tracked.pose, tracked.camera, point), pixel(expected, expected.camera, point)];
    return Math.hypot(a[0] - b[0], a[1] - b[1]);
  }));
}
