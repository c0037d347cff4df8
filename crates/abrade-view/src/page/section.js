// A cut through triangles by a plane across one axis of the world.

const AXES = ["x", "y", "z"];

/** The axes of a section's chart, across then up, for a plane across `axis` (0 x, 1 y, 2 z). */
function chartAxes(axis) {
  return [[1, 2], [0, 2], [0, 1]][axis];
}

/**
 * The segments in which the plane cuts triangles of `now`: across and up of their two ends [m]. With
 * `rest` and `depth`, also where the same ends would be without wear, and their depths. `edges` has a
 * number per end that segments share where they join.
 */
function cut({ now, rest, depth, triangles }, axis, at) {
  const [across, up] = chartAxes(axis);
  const lines = [];
  const begun = [];
  const depths = [];
  const edges = [];
  const ends = [];
  for (let first = 0; first < triangles.length; first += 3) {
    ends.length = 0;
    for (let corner = 0; corner < 3; corner++) {
      const a = triangles[first + corner];
      const b = triangles[first + ((corner + 1) % 3)];
      const [da, db] = [now[3 * a + axis] - at, now[3 * b + axis] - at];
      // A corner on the plane is of the side above it, so that each cut has two ends.
      if (da < 0 !== db < 0) ends.push(a, b, da / (da - db));
    }
    if (ends.length < 6) continue;
    for (let end = 0; end < 6; end += 3) {
      const [a, b, share] = ends.slice(end, end + 3);
      const between = (values, step, i) =>
        values[step * a + i] + share * (values[step * b + i] - values[step * a + i]);
      lines.push(between(now, 3, across), between(now, 3, up));
      if (rest) begun.push(between(rest, 3, across), between(rest, 3, up));
      if (depth) depths.push(between(depth, 1, 0));
      edges.push((Math.min(a, b) * now.length) / 3 + Math.max(a, b));
    }
  }
  return { lines, begun, depths, edges };
}

/** The segments at each edge that the plane cuts. */
function segmentsAtEdges({ edges }) {
  const segments = new Map();
  edges.forEach((edge, end) => segments.set(edge, [...(segments.get(edge) ?? []), end >> 1]));
  return segments;
}

/** Number of the deepest end. */
function deepestEnd({ depths }) {
  return depths.reduce((best, depth, end) => (depth > depths[best] ? end : best), 0);
}

/** The ends of the worn segments that are joined to the deepest one. */
function deepestCrater(cut) {
  const segments = segmentsAtEdges(cut);
  const found = new Set([deepestEnd(cut) >> 1]);
  for (const segment of found) {
    for (const end of [2 * segment, 2 * segment + 1]) {
      if (cut.depths[end] > 0) for (const next of segments.get(cut.edges[end])) found.add(next);
    }
  }
  return [...found].flatMap((segment) => [2 * segment, 2 * segment + 1]);
}

/**
 * The profile through the deepest end laid straight: across the way along it before the wear [m], from
 * the deepest end, up minus the depth. Both ways at once, so that a closed profile parts opposite to it.
 */
function straightened(cut) {
  const out = { lines: [], begun: [], depths: [], edges: [] };
  if (cut.edges.length === 0) return out;
  const segments = segmentsAtEdges(cut);
  const start = deepestEnd(cut);
  const passed = new Set();
  const walks = [{ from: start, along: 0, sign: 1 }, { from: start, along: 0, sign: -1 }];
  const step = (walk) => {
    const next = segments.get(cut.edges[walk.from]).find((segment) => !passed.has(segment));
    if (next === undefined) return false;
    passed.add(next);
    const near = cut.edges[2 * next] === cut.edges[walk.from] ? 2 * next : 2 * next + 1;
    const far = near ^ 1;
    const [dx, dy] = [0, 1].map((i) => cut.begun[2 * far + i] - cut.begun[2 * near + i]);
    const along = walk.along + walk.sign * Math.hypot(dx, dy);
    for (const [end, place] of [[near, walk.along], [far, along]]) {
      out.lines.push(place, -cut.depths[end]);
      out.begun.push(place, 0);
      out.depths.push(cut.depths[end]);
      out.edges.push(cut.edges[end]);
    }
    Object.assign(walk, { from: far, along });
    return true;
  };
  while (walks.map(step).some(Boolean));
  return out;
}

/** A section with the profile of its deepest surface laid straight. */
function straightSection(section) {
  const most = ({ depths }) => depths.reduce((most, depth) => Math.max(most, depth), 0);
  const [deepest] = [...section.surfaces].sort((a, b) => most(b) - most(a));
  const axes = [{ name: "along the surface", from: 0 }, { name: "depth", from: 0, isDown: true }];
  return { axes, surfaces: deepest ? [straightened(deepest)] : [], bodies: [] };
}

/** The cuts of all surfaces and bodies at the instant of this number. */
function sectionOf(run, number, axis, at, isShown) {
  const surfaces = run.surfaces
    .filter((surface) => isShown(surface.name))
    .map(({ instants }) => {
      const { shape, depth } = instants[number];
      return cut({ ...placedSurface(instants[number]), depth, triangles: shape.triangles }, axis, at);
    });
  const bodies = [];
  if (run.bodies) {
    const instant = run.bodies.instants[number];
    const now = placed(instant);
    run.bodies.lists ??= trianglesOfParts(instant.shape);
    run.bodies.lists.forEach((triangles, body) => {
      if (isShown(run.bodies.names[body])) bodies.push(cut({ now, triangles }, axis, at).lines);
    });
  }
  const axes = chartAxes(axis).map((i) => ({ name: AXES[i], from: run.origin[i] }));
  return { axes, surfaces, bodies };
}
