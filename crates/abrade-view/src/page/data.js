// The run's data: JSON whose long arrays are texts, base64 of zlib of little-endian numbers. What
// the arrays hold stands in block.rs, which writes them.

/** An array from its text. */
async function unpack(text, Type) {
  const coded = atob(text);
  const bytes = new Uint8Array(coded.length);
  for (let i = 0; i < coded.length; i++) bytes[i] = coded.charCodeAt(i);
  const plain = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Type(await new Response(plain).arrayBuffer());
}

/** Bodies or a surface: the shapes that it has one after the other, and its instants. */
async function unpackSolid(block) {
  const shapes = [];
  for (const { points, parts, local, normal, part, triangles } of block.shapes) {
    shapes.push({
      points,
      parts,
      local: await unpack(local, Float32Array),
      normal: normal && (await unpack(normal, Float32Array)),
      part: part && (await unpack(part, Uint32Array)),
      triangles: await unpack(triangles, Uint32Array),
    });
  }
  const instants = [];
  for (const { shape, poses, depth } of block.instants) {
    instants.push({
      shape: shapes[shape],
      poses: await unpack(poses, Float32Array),
      depth: depth && (await unpack(depth, Float32Array)),
    });
  }
  return { shapes, instants };
}

/** The run that the page holds. */
async function readRun() {
  const block = JSON.parse(document.getElementById("data").textContent);
  const surfaces = [];
  for (const surface of block.surfaces) {
    const { name, max_depths_m: maxDepths } = surface;
    surfaces.push({ name, maxDepths, ...(await unpackSolid(surface)) });
  }
  let bodies = null;
  if (block.bodies) {
    const paths = [];
    for (const text of block.bodies.paths ?? []) paths.push(await unpack(text, Float32Array));
    bodies = { names: block.bodies.names, paths, ...(await unpackSolid(block.bodies)) };
  }
  return {
    summary: block.summary,
    origin: block.origin_m,
    times: block.times_s,
    surfaces,
    bodies,
    colours: await unpack(block.colours, Uint8Array),
    maxDepth: surfaces.reduce((most, surface) => Math.max(most, ...surface.maxDepths), 0),
  };
}
