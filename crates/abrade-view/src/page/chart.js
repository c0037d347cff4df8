// The chart of a section: the profile now, where it began, what lies between, the bodies' outlines.

/** Height over width below which a profile would be too flat to read and is drawn taller. */
const FLAT = 0.3;
/** Depth over the width of a profile below which it would not be seen. */
const SEEN = 0.02;
const MARGIN = { left: 62, right: 14, top: 12, bottom: 40 };

class Chart {
  constructor(svg, readout, note) {
    Object.assign(this, { svg, readout, note, section: null, zoomed: true, straight: false });
    svg.addEventListener("pointermove", (event) => this.point(event));
    svg.addEventListener("pointerleave", () => this.point(null));
  }

  /** Shows the section of a plane. */
  show(section) {
    this.whole = section;
    this.draw();
  }

  draw() {
    if (!this.whole) return;
    this.section = this.straight ? straightSection(this.whole) : this.whole;
    const { section, svg } = this;
    const [width, height] = [svg.clientWidth || 600, svg.clientHeight || 260];
    svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
    const view = this.view(width, height);
    this.scales = view;
    svg.replaceChildren();
    this.pointed = null;
    this.say(view);
    if (!view) return;
    const clip = element("clipPath", { id: "chart-clip" });
    clip.append(element("rect", view.frame));
    svg.append(clip);
    this.drawAxes(view);
    const inside = element("g", { "clip-path": "url(#chart-clip)" });
    inside.append(element("path", { class: "worn", d: areas(section.surfaces, view) }));
    for (const lines of section.bodies) inside.append(element("path", { class: "body", d: path(lines, view) }));
    for (const { begun } of section.surfaces) inside.append(element("path", { class: "begun", d: path(begun, view) }));
    for (const { lines } of section.surfaces) inside.append(element("path", { class: "now", d: path(lines, view) }));
    svg.append(inside);
    this.mark = element("circle", { class: "mark", r: 4, visibility: "hidden" });
    svg.append(this.mark);
  }

  /** What part of the section is shown, and how large; null where the plane cuts no surface. */
  view(width, height) {
    const box = boxOf(this.section, this.zoomed);
    if (!box) return null;
    const frame = { x: MARGIN.left, y: MARGIN.top, width: width - MARGIN.left - MARGIN.right, height: height - MARGIN.top - MARGIN.bottom };
    const [wide, high] = [box.high[0] - box.low[0], box.high[1] - box.low[1]];
    const fit = [frame.width / (wide || 1), frame.height / (high || wide || 1)];
    const equal = high >= FLAT * wide;
    const scale = equal ? [Math.min(...fit), Math.min(...fit)] : fit;
    const middle = [0, 1].map((i) => (box.low[i] + box.high[i]) / 2);
    return {
      frame,
      middle,
      scale,
      taller: scale[1] / scale[0],
      x: (value) => frame.x + frame.width / 2 + (value - middle[0]) * scale[0],
      y: (value) => frame.y + frame.height / 2 - (value - middle[1]) * scale[1],
    };
  }

  drawAxes(view) {
    const { frame, middle, scale } = view;
    this.units = this.section.axes.map(({ name, from, isDown }, i) => {
      const half = (i ? frame.height : frame.width) / 2 / scale[i];
      const [low, high] = [middle[i] - half + from, middle[i] + half + from];
      const [unit, size] = high - low < 1e-3 ? unitOf(high - low, LENGTHS) : unitOfExtent(high - low);
      const { values, decimals } = ticks(low / size, high / size, i ? frame.height / 45 : frame.width / 80);
      for (const value of values) {
        const at = value * size - from;
        const text = fixed(isDown ? -value : value, decimals);
        if (i) this.tick({ y1: view.y(at), y2: view.y(at), x1: frame.x, x2: frame.x + frame.width }, text, frame.x - 8, view.y(at) + 4, "end");
        else this.tick({ x1: view.x(at), x2: view.x(at), y1: frame.y, y2: frame.y + frame.height }, text, view.x(at), frame.y + frame.height + 16, "middle");
      }
      const label = `${name}, ${unit}`;
      if (i) this.svg.append(element("text", { class: "axis", x: 0, y: 0, "text-anchor": "middle", transform: `translate(13 ${frame.y + frame.height / 2}) rotate(-90)` }, label));
      else this.svg.append(element("text", { class: "axis", x: frame.x + frame.width / 2, y: frame.y + frame.height + 34, "text-anchor": "middle" }, label));
      return { name, from, unit, size, isDown };
    });
  }

  tick(line, text, x, y, anchor) {
    this.svg.append(element("line", { class: "grid", ...line }));
    this.svg.append(element("text", { class: "tick", x, y, "text-anchor": anchor }, text));
  }

  /** What the chart shows, in words. */
  say(view) {
    const { section } = this;
    let most = 0;
    for (const { depths } of section.surfaces) for (const depth of depths) most = Math.max(most, depth);
    const depth = most > 0 ? `deepest here ${quantity(most, LENGTHS)}` : "not worn here";
    const taller = view && view.taller > 1.05 ? `, heights drawn ${Number(view.taller.toPrecision(2))} times larger` : "";
    this.note.textContent = view ? depth + taller : "The plane cuts no surface here.";
    this.svg.setAttribute("aria-label", `Cross-section: ${this.note.textContent}`);
  }

  /** Tells the place of the profile that is nearest to the pointer. */
  point(event) {
    const { scales: view, section } = this;
    let found = null;
    if (event && view) {
      const { left, top } = this.svg.getBoundingClientRect();
      const [px, py] = [event.clientX - left, event.clientY - top];
      for (const { lines, depths } of section.surfaces) {
        for (let i = 0; i < lines.length; i += 2) {
          const [x, y] = [view.x(lines[i]), view.y(lines[i + 1])];
          const away = Math.hypot(x - px, 0.2 * (y - py));
          if (away < (found?.away ?? 40)) found = { away, x, y, place: [lines[i], lines[i + 1]], depth: depths[i / 2] };
        }
      }
    }
    this.mark?.setAttribute("visibility", found ? "visible" : "hidden");
    this.readout.textContent = found ? this.told(found) : "";
    if (found) {
      this.mark.setAttribute("cx", found.x);
      this.mark.setAttribute("cy", found.y);
    }
  }

  told({ place, depth }) {
    const places = this.units.map(({ name, from, unit, size }, i) => `${name} ${spaced(number((place[i] + from) / size), unit)}`);
    const shown = this.straight ? places.slice(0, 1) : places;
    return [...shown, `depth ${quantity(Math.max(0, depth), LENGTHS)}`].join(", ");
  }
}

/**
 * The box that the chart shows: {low, high} [m]; null where the plane cuts no surface. Zoomed it is
 * that of the worn profile, or of the deepest crater where the depths would be lost in that.
 */
function boxOf({ surfaces }, zoomed) {
  const isWorn = ({ depths }) => depths.flatMap((depth, end) => (depth > 0 ? [end] : []));
  const all = boxOfEnds(surfaces, ({ depths }) => depths.keys());
  const worn = zoomed && boxOfEnds(surfaces, isWorn);
  if (!worn) return all && withRoom(all, 0.04);
  const most = (surface) => surface.depths.reduce((most, depth) => Math.max(most, depth), 0);
  const [deepest] = [...surfaces].sort((a, b) => most(b) - most(a));
  const isSeen = most(deepest) >= SEEN * Math.max(worn.high[0] - worn.low[0], worn.high[1] - worn.low[1]);
  return withRoom(isSeen ? worn : boxOfEnds([deepest], deepestCrater), 0.3);
}

/** The box of the ends that `chosen` names of each surface, now and before the wear. */
function boxOfEnds(surfaces, chosen) {
  const [low, high] = [[Infinity, Infinity], [-Infinity, -Infinity]];
  for (const surface of surfaces) {
    for (const end of chosen(surface)) {
      for (const points of [surface.lines, surface.begun]) {
        for (let axis = 0; axis < 2; axis++) {
          low[axis] = Math.min(low[axis], points[2 * end + axis]);
          high[axis] = Math.max(high[axis], points[2 * end + axis]);
        }
      }
    }
  }
  return high[0] >= low[0] ? { low, high } : null;
}

/** A box with a share of its width added on either side, and a little of its height. */
function withRoom({ low, high }, share) {
  const room = [share * (high[0] - low[0]), 0.08 * (high[1] - low[1])];
  return { low: low.map((value, i) => value - room[i]), high: high.map((value, i) => value + room[i]) };
}

function path(lines, view) {
  let text = "";
  for (let i = 0; i < lines.length; i += 4) {
    text += `M${place(lines, i, view)}L${place(lines, i + 2, view)}`;
  }
  return text;
}

/** What was worn away: between each segment and where it began. */
function areas(surfaces, view) {
  let text = "";
  for (const { lines, begun, depths } of surfaces) {
    for (let i = 0; i < lines.length; i += 4) {
      if (!(depths[i / 2] > 0 || depths[i / 2 + 1] > 0)) continue;
      text += `M${place(lines, i, view)}L${place(lines, i + 2, view)}L${place(begun, i + 2, view)}L${place(begun, i, view)}Z`;
    }
  }
  return text;
}

function place(points, i, view) {
  return `${view.x(points[i]).toFixed(1)} ${view.y(points[i + 1]).toFixed(1)}`;
}

function element(name, attributes, text) {
  const made = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  if (text !== undefined) made.textContent = text;
  return made;
}
