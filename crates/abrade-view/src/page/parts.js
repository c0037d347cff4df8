// Where the points of rigid parts are at an instant.

const POSE = 7;

/** Centre and quaternion of a part at an instant. */
function poseOf({ poses }, part) {
  return poses.subarray(POSE * part, POSE * part + POSE);
}

/** Part of a point. */
function partOf(shape, point) {
  return shape.part ? shape.part[point] : 0;
}

/** Turns the vector at `from[i]` by the quaternion of `pose` into `to[i]`. */
function turn(pose, from, to, i) {
  const [x, y, z] = [from[i], from[i + 1], from[i + 2]];
  const [qx, qy, qz, qw] = [pose[3], pose[4], pose[5], pose[6]];
  const tx = 2 * (qy * z - qz * y);
  const ty = 2 * (qz * x - qx * z);
  const tz = 2 * (qx * y - qy * x);
  to[i] = x + qw * tx + qy * tz - qz * ty;
  to[i + 1] = y + qw * ty + qz * tx - qx * tz;
  to[i + 2] = z + qw * tz + qx * ty - qy * tx;
}

/** The points at an instant, of surfaces without wear [m], from the page's origin. */
function placed(instant) {
  const { shape } = instant;
  const out = new Float32Array(3 * shape.points);
  const poses = Array.from({ length: shape.parts }, (_, part) => poseOf(instant, part));
  for (let point = 0; point < shape.points; point++) {
    const pose = poses[partOf(shape, point)];
    turn(pose, shape.local, out, 3 * point);
    for (let axis = 0; axis < 3; axis++) out[3 * point + axis] += pose[axis];
  }
  return out;
}

/** The nodes of a surface at an instant: where they began (`rest`) and where they are (`now`) [m]. */
function placedSurface(instant) {
  const { shape, depth } = instant;
  const rest = placed(instant);
  const now = rest.slice();
  const normal = new Float32Array(3 * shape.points);
  for (let node = 0; node < shape.points; node++) {
    if (!(depth[node] > 0)) continue;
    turn(poseOf(instant, partOf(shape, node)), shape.normal, normal, 3 * node);
    for (let axis = 0; axis < 3; axis++) now[3 * node + axis] -= normal[3 * node + axis] * depth[node];
  }
  return { rest, now };
}

/** The triangles of each part. */
function trianglesOfParts(shape) {
  if (shape.parts === 1) return [shape.triangles];
  const of = (at) => shape.part[shape.triangles[at]];
  const counts = new Uint32Array(shape.parts);
  for (let at = 0; at < shape.triangles.length; at += 3) counts[of(at)] += 3;
  const lists = Array.from(counts, (count) => new Uint32Array(count));
  counts.fill(0);
  for (let at = 0; at < shape.triangles.length; at += 3) {
    const part = of(at);
    lists[part].set(shape.triangles.subarray(at, at + 3), counts[part]);
    counts[part] += 3;
  }
  return lists;
}

/** Distance of each part's farthest point from its centre [m]. */
function radiiOfParts(shape) {
  const radii = new Float32Array(shape.parts);
  for (let point = 0; point < shape.points; point++) {
    const [x, y, z] = shape.local.subarray(3 * point, 3 * point + 3);
    const part = partOf(shape, point);
    radii[part] = Math.max(radii[part], Math.hypot(x, y, z));
  }
  return radii;
}

/** True when a part of the first shape is where it was at every instant, and turned as it was. */
function isAtRest({ instants }, part, radius) {
  const first = poseOf(instants[0], part);
  return instants.every((instant) => {
    const pose = poseOf(instant, part);
    return first.every((value, i) => Math.abs(pose[i] - value) <= 1e-5 * (i < 3 ? radius : 1));
  });
}

/** A box that holds `points` [m]. */
function boxOfPoints(points) {
  const [low, high] = [[Infinity, Infinity, Infinity], [-Infinity, -Infinity, -Infinity]];
  for (let at = 0; at < points.length; at++) {
    low[at % 3] = Math.min(low[at % 3], points[at]);
    high[at % 3] = Math.max(high[at % 3], points[at]);
  }
  return { low, high };
}

/** A box that holds `solids` at every instant: {low, high} [m]. */
function boundsOf(solids) {
  const [low, high] = [[Infinity, Infinity, Infinity], [-Infinity, -Infinity, -Infinity]];
  for (const solid of solids) {
    const rests = Array.from(radiiOfParts(solid.shapes[0]), (radius, part) => isAtRest(solid, part, radius));
    const atRest = solid.shapes.length === 1 && rests.every(Boolean);
    for (const instant of atRest ? solid.instants.slice(0, 1) : solid.instants) {
      const box = boxOfPoints(placed(instant));
      for (let axis = 0; axis < 3; axis++) {
        low[axis] = Math.min(low[axis], box.low[axis]);
        high[axis] = Math.max(high[axis], box.high[axis]);
      }
    }
  }
  return { low, high };
}

/**
 * The deepest node of all surfaces at an instant: {depth, place, radius} [m], the radius that of its
 * part; null where nothing wore.
 */
function deepest(surfaces, number) {
  let found = null;
  for (const surface of surfaces) {
    const instant = surface.instants[number];
    instant.depth.forEach((depth, node) => {
      if (depth > (found?.depth ?? 0)) found = { depth, instant, node };
    });
  }
  if (!found) return null;
  const { instant, node, depth } = found;
  const pose = poseOf(instant, partOf(instant.shape, node));
  const place = new Float32Array(3);
  turn(pose, instant.shape.local.subarray(3 * node, 3 * node + 3), place, 0);
  const radius = radiiOfParts(instant.shape)[partOf(instant.shape, node)];
  return { depth, radius, place: [0, 1, 2].map((axis) => place[axis] + pose[axis]) };
}
