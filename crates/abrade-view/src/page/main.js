// What the page shows, and what its controls change.

/** Time that playing a whole run takes, and the shortest and longest of an instant [ms]. */
const PLAYING = { run: 6000, least: 40, most: 500 };
/** Largest depth that the exaggeration may reach, over the size of what is shown. */
const DEEP = 0.15;
/** Share of the extent by which a section stays off the edge. */
const EDGE = 1e-6;
/** Radius that is seen around the deepest node when the view goes there, over the depth. */
const AROUND = 25;

const byId = (id) => document.getElementById(id);

async function start() {
  const run = await readRun();
  const last = run.times.length - 1;
  drawColourBar(byId("colours"), run);
  tellNumbers(byId("numbers").tBodies[0], run);
  const stage = stageOf(run);
  const chart = new Chart(byId("chart"), byId("readout"), byId("chart-note"));
  const bounds = stage ?? boundsOf(run.surfaces);
  const state = { instant: last, axis: 1, at: 0, isShown: () => true, open: false };
  const enclosing = enclosingSurfaces(run);

  // At the very edge a plane would touch the surface and cut nothing.
  const inside = (at) => {
    const [low, high] = [bounds.low[state.axis], bounds.high[state.axis]];
    const edge = EDGE * (high - low);
    return Math.min(Math.max(at, low + edge), high - edge);
  };
  const showSection = later(() => chart.show(sectionOf(run, state.instant, state.axis, inside(state.at), state.isShown)));
  const showPlane = () => {
    const place = state.at + run.origin[state.axis];
    const [unit, size] = unitOfExtent(bounds.high[state.axis] - bounds.low[state.axis]);
    byId("at-value").textContent = `${AXES[state.axis]} = ${spaced(fixed(place / size, 3), unit)}`;
    byId("at").setAttribute("aria-valuetext", byId("at-value").textContent);
    byId("at").value = Math.round(1000 * ((state.at - bounds.low[state.axis]) / (bounds.high[state.axis] - bounds.low[state.axis])));
    stage?.setPlane(state.axis, state.at, state.open ? (enclosing.length ? enclosing : run.surfaces) : []);
    showSection();
  };
  const movePlane = (at) => {
    state.at = Math.min(Math.max(at, bounds.low[state.axis]), bounds.high[state.axis]);
    showPlane();
  };
  const toDeepest = () => {
    const found = deepest(run.surfaces, state.instant) ?? deepest(run.surfaces, last);
    movePlane(found ? found.place[state.axis] : (bounds.low[state.axis] + bounds.high[state.axis]) / 2);
  };
  const showInstant = (instant) => {
    state.instant = instant;
    byId("time").value = instant;
    const time = quantity(run.times[instant], TIMES, run.times[last]);
    byId("time-value").textContent = `${time}, instant ${instant + 1} of ${last + 1}`;
    byId("time").setAttribute("aria-valuetext", byId("time-value").textContent);
    const most = Math.max(...run.surfaces.map((surface) => surface.maxDepths[instant]));
    byId("wear-value").textContent = most > 0 ? `deepest ${quantity(most, LENGTHS)}` : "no wear yet";
    stage?.show(instant);
    showSection();
  };

  byId("time").max = last;
  byId("time").addEventListener("input", () => showInstant(Number(byId("time").value)));
  playBy(byId("play"), last, () => state.instant, showInstant);
  if (last === 0) {
    for (const id of ["time", "play"]) byId(id).disabled = true;
    byId("one-instant").hidden = false;
  }
  byId("at").addEventListener("input", () => {
    const share = Number(byId("at").value) / 1000;
    movePlane(bounds.low[state.axis] + share * (bounds.high[state.axis] - bounds.low[state.axis]));
  });
  for (const input of document.querySelectorAll("input[name=axis]")) {
    input.addEventListener("change", () => {
      state.axis = Number(input.value);
      toDeepest();
    });
  }
  byId("deepest").addEventListener("click", toDeepest);
  byId("closer").addEventListener("click", () => {
    const found = deepest(run.surfaces, state.instant) ?? deepest(run.surfaces, last);
    if (found) stage?.lookCloser(found.place, Math.min(AROUND * found.depth, 1.2 * found.radius));
  });
  byId("zoom").addEventListener("change", () => {
    chart.zoomed = byId("zoom").checked;
    chart.draw();
  });
  byId("straight").addEventListener("change", () => {
    chart.straight = byId("straight").checked;
    chart.draw();
  });
  byId("open").checked = state.open = enclosing.length > 0;
  byId("open").addEventListener("change", () => {
    state.open = byId("open").checked;
    showPlane();
  });
  exaggerateBy(byId("exaggeration"), byId("exaggeration-value"), run, bounds, stage);
  const choose = () => {
    stage?.choose(state.isShown, byId("paths").checked);
    showSection();
  };
  byId("paths").addEventListener("change", choose);
  listShown(byId("shown"), run, (isShown) => {
    state.isShown = isShown;
    choose();
  });
  for (const button of document.querySelectorAll("button[data-look]")) {
    button.addEventListener("click", () => stage?.look(button.dataset.look));
  }
  if (stage) {
    dragPlane(stage, () => state, movePlane);
    turnByKeys(stage);
    const dark = matchMedia("(prefers-color-scheme: dark)");
    dark.addEventListener("change", () => stage.dress());
    stage.dress();
  }
  new ResizeObserver(() => chart.draw()).observe(byId("chart").parentElement);
  choose();
  showInstant(last);
  if (enclosing.length) {
    const { low, high } = boxOfPoints(placed(enclosing[0].instants[last]));
    const spans = [0, 1, 2].map((i) => high[i] - low[i]);
    state.axis = spans.indexOf(Math.min(...spans));
    movePlane((low[state.axis] + high[state.axis]) / 2);
  } else toDeepest();
  document.querySelector(`input[name=axis][value="${state.axis}"]`).checked = true;
  byId("loading").hidden = true;
  document.body.dataset.ready = "true";
}

/** The view in three dimensions, or null where the browser has none to offer. */
function stageOf(run) {
  try {
    return new Stage(byId("view"), run);
  } catch (error) {
    byId("no-webgl").hidden = false;
    byId("no-webgl").textContent = `The view needs WebGL, which this browser does not offer (${error.message}). Section and numbers need none.`;
    return null;
  }
}

/** `work` at the next frame of the screen, once however often it is asked. */
function later(work) {
  let asked = false;
  return () => {
    if (asked) return;
    asked = true;
    requestAnimationFrame(() => {
      asked = false;
      work();
    });
  };
}

function playBy(button, last, instant, show) {
  let timer = null;
  const stop = () => {
    clearInterval(timer);
    timer = null;
    button.textContent = "Play";
  };
  button.addEventListener("click", () => {
    if (timer !== null) return stop();
    if (instant() === last) show(0);
    button.textContent = "Pause";
    const each = Math.min(Math.max(PLAYING.run / (last + 1), PLAYING.least), PLAYING.most);
    timer = setInterval(() => (instant() < last ? show(instant() + 1) : stop()), each);
  });
}

/** A slider of factors, from 1 to what makes the largest depth a good part of the view. */
function exaggerateBy(slider, output, run, bounds, stage) {
  const size = Math.hypot(...[0, 1, 2].map((i) => bounds.high[i] - bounds.low[i]));
  const most = Math.max(2, (DEEP * size) / (run.maxDepth || size));
  const show = () => {
    const factor = most ** (Number(slider.value) / 100);
    const shown = factor < 10 ? Math.round(10 * factor) / 10 : Math.round(factor);
    output.textContent = shown === 1 ? "true to scale" : `${shown} times`;
    slider.setAttribute("aria-valuetext", output.textContent);
    stage?.exaggerate(shown);
  };
  slider.addEventListener("input", show);
  show();
}

/** The plane follows the pointer that takes its knob. */
function dragPlane(stage, state, movePlane) {
  const reach = 22;
  const { canvas } = stage;
  let held = null;
  const near = (event) => {
    const { left, top } = canvas.getBoundingClientRect();
    const knob = stage.knobOnCanvas();
    return Math.hypot(event.clientX - left - knob.x, event.clientY - top - knob.y) < reach ? knob : null;
  };
  // Before the controls of the camera hear of it.
  canvas.parentElement.addEventListener("pointerdown", (event) => {
    const knob = near(event);
    if (!knob) return;
    event.stopPropagation();
    held = { knob, x: event.clientX, y: event.clientY, at: state().at };
    canvas.parentElement.setPointerCapture(event.pointerId);
  }, true);
  canvas.parentElement.addEventListener("pointermove", (event) => {
    if (!held) {
      canvas.style.cursor = near(event) ? "grab" : "";
      return;
    }
    const [ax, ay] = held.knob.along;
    const length = ax * ax + ay * ay;
    // Seen along its axis the plane does not move on the canvas.
    if (length * stage.size * stage.size < 100) return;
    movePlane(held.at + ((event.clientX - held.x) * ax + (event.clientY - held.y) * ay) / length);
  });
  for (const end of ["pointerup", "pointercancel"]) {
    canvas.parentElement.addEventListener(end, () => (held = null));
  }
}

/** Arrow keys turn the view, plus and minus bring it nearer and farther. */
function turnByKeys(stage) {
  const { canvas, controls } = stage;
  const step = Math.PI / 24;
  const keys = {
    ArrowLeft: () => controls.rotateLeft(step),
    ArrowRight: () => controls.rotateLeft(-step),
    ArrowUp: () => controls.rotateUp(step),
    ArrowDown: () => controls.rotateUp(-step),
    "+": () => controls.dollyIn(1.15),
    "=": () => controls.dollyIn(1.15),
    "-": () => controls.dollyOut(1.15),
  };
  canvas.addEventListener("keydown", (event) => {
    const act = keys[event.key];
    if (!act || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    act();
    controls.update();
  });
}

start().catch((error) => {
  byId("loading").textContent = `The page's data cannot be read: ${error.message}`;
  throw error;
});
