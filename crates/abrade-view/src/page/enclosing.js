// Which surfaces hide what goes on inside them: drums, pipes, bores.

/** Instants and, of each, bodies inside a surface's box that are looked at. */
const SAMPLED = { instants: 5, bodies: 3 };
/** Sides, of six, on which a surface must be to enclose a place: a drum has no ends. */
const SIDES = 4;

/** Surfaces of one part that enclose a body or another surface at some instant. */
function enclosingSurfaces(run) {
  const last = run.times.length - 1;
  const shares = Array.from({ length: SAMPLED.instants }, (_, i) => i / (SAMPLED.instants - 1));
  const sampled = [...new Set(shares.map((share) => Math.round(share * last)))];
  const single = run.surfaces.filter((surface) => surface.shapes[0].parts === 1);
  return single.filter((surface) => sampled.some((number) => enclosesAt(run, surface, number)));
}

function enclosesAt(run, surface, number) {
  const instant = surface.instants[number];
  const points = placed(instant);
  const { low, high } = boxOfPoints(points);
  const isInside = (place) => [0, 1, 2].every((i) => place[i] > low[i] && place[i] < high[i]);
  const solids = run.bodies ? [...run.surfaces, run.bodies] : run.surfaces;
  const others = solids.filter((solid) => solid !== surface).map((solid) => solid.instants[number]);
  const centres = others.flatMap((other) => Array.from({ length: other.shape.parts }, (_, part) => poseOf(other, part)));
  const near = centres.filter(isInside).slice(0, SAMPLED.bodies);
  return near.some((place) => sidesOf(place, points, instant.shape.triangles) >= SIDES);
}

/** On how many of the six sides of `place`, along the axes, there is a triangle. */
function sidesOf(place, points, triangles) {
  const found = new Set();
  for (let first = 0; first < triangles.length; first += 3) {
    const corners = [0, 1, 2].map((i) => 3 * triangles[first + i]);
    for (let axis = 0; axis < 3; axis++) {
      const at = crossing(place, corners, points, axis);
      if (at !== null) found.add(2 * axis + (at > place[axis] ? 1 : 0));
    }
  }
  return found.size;
}

/** Where the line through `place` along `axis` goes through a triangle; null where it does not. */
function crossing(place, corners, points, axis) {
  const [u, v] = chartAxes(axis);
  const away = corners.map((corner) => [points[corner + u] - place[u], points[corner + v] - place[v]]);
  // Twice the areas that the line cuts the triangle into, seen along the axis.
  const areas = [0, 1, 2].map((i) => {
    const [b, c] = [away[(i + 1) % 3], away[(i + 2) % 3]];
    return b[0] * c[1] - b[1] * c[0];
  });
  if (!(areas.every((area) => area > 0) || areas.every((area) => area < 0))) return null;
  const whole = areas[0] + areas[1] + areas[2];
  return areas.reduce((sum, area, i) => sum + (area / whole) * points[corners[i] + axis], 0);
}
