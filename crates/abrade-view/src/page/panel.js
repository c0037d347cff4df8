// The numbers of the run, and the list of what is shown.

/** Rows above which surfaces or bodies are told together. */
const ROWS = 4;

/** Fills the table with what the run's summary says. */
function tellNumbers(body, { summary }) {
  const surfaces = Object.entries(summary.surfaces);
  const bodies = Object.entries(summary.bodies);
  if (surfaces.length > ROWS) {
    const all = surfaces.map(([, surface]) => surface);
    const sum = (key) => all.reduce((total, surface) => total + surface[key], 0);
    heading(body, `${surfaces.length} surfaces together`);
    row(body, "Displaced", volume(sum("wear_volume_m3")));
    row(body, "Largest depth", quantity(Math.max(...all.map((surface) => surface.max_depth_m)), LENGTHS));
    row(body, "Worn nodes", `${grouped(String(sum("worn_nodes")))} of ${grouped(String(sum("nodes")))}`);
  } else {
    for (const [name, surface] of surfaces) {
      heading(body, `Surface ${name}`);
      row(body, "Displaced", volume(surface.wear_volume_m3));
      if (Math.abs(surface.removed_volume_m3 / surface.wear_volume_m3 - 1) > 1e-9) row(body, "Debris", volume(surface.removed_volume_m3));
      row(body, "Largest depth", quantity(surface.max_depth_m, LENGTHS));
      row(body, "Worn nodes", `${grouped(String(surface.worn_nodes))} of ${grouped(String(surface.nodes))}`);
    }
  }
  const struck = bodies.filter(([, entry]) => entry.restitution !== null);
  if (struck.length > ROWS) {
    heading(body, `${bodies.length} bodies, ${struck.length} have struck`);
    const mean = struck.reduce((total, [, entry]) => total + entry.restitution, 0) / struck.length;
    row(body, "Speed after over before, mean", number(mean));
  } else {
    for (const [name, entry] of struck) {
      heading(body, `Body ${name}`);
      row(body, "Speed after over before", number(entry.restitution));
      if (entry.rebound_angle_deg !== null) row(body, "Leaves from the surface at", `${number(entry.rebound_angle_deg)}°`);
      if (entry.restitution_normal != null) row(body, "Normal restitution", number(entry.restitution_normal));
    }
  }
  if (summary.energy) {
    heading(body, "Energy");
    const energy = summary.energy;
    const scale = Math.max(energy.initial_J, energy.wear_J, Math.abs(energy.external_work_J));
    const names = { initial_J: "At the start", external_work_J: "External work", kinetic_J: "Kinetic now", wear_J: "Wear", friction_J: "Friction", damping_J: "Damping", history_J: "Tangential history", adhesion_J: "Adhesion", elastic_J: "Stored in springs", numerical_J: "Numerical" };
    for (const [key, name] of Object.entries(names)) {
      if (Math.abs(energy[key]) > 1e-12 * scale) row(body, name, quantity(energy[key], ENERGIES));
    }
  }
  heading(body, "Run");
  row(body, "Simulated", quantity(summary.simulated_s, TIMES));
  row(body, "Ended", summary.stop ?? (summary.complete ? "complete" : "broken off"));
  row(body, "abrade", `${summary.abrade}, ${summary.precision}`);
}

function heading(body, text) {
  const line = body.insertRow();
  const cell = document.createElement("th");
  cell.colSpan = 2;
  cell.scope = "colgroup";
  cell.textContent = text;
  line.append(cell);
}

function row(body, name, value) {
  const line = body.insertRow();
  const cell = document.createElement("th");
  cell.scope = "row";
  cell.textContent = name;
  line.append(cell);
  line.insertCell().textContent = value;
}

/**
 * The list of surfaces and bodies with a box each, bodies of a stream with one for all. `chosen` is
 * called with a function that tells by name what is shown.
 */
function listShown(list, run, chosen) {
  const groups = new Map();
  const add = (kind, name, group) => {
    const key = `${kind} ${group}`;
    if (!groups.has(key)) groups.set(key, { kind, group, names: [] });
    groups.get(key).names.push(name);
  };
  for (const { name } of run.surfaces) add("surface", name, name);
  const names = run.bodies?.names ?? [];
  const stems = names.map((name) => name.replace(/_\d+$/, ""));
  const counts = {};
  for (const stem of stems) counts[stem] = (counts[stem] ?? 0) + 1;
  names.forEach((name, i) => add("body", name, counts[stems[i]] > 1 ? stems[i] : name));
  const hidden = new Set();
  for (const { kind, group, names: members } of groups.values()) {
    const box = labelled(list, members.length > 1 ? `${group}, ${members.length} bodies` : `${group}, ${kind}`);
    box.addEventListener("change", () => {
      for (const name of members) box.checked ? hidden.delete(name) : hidden.add(name);
      chosen((name) => !hidden.has(name));
    });
  }
  return (name) => !hidden.has(name);
}

/** A box with its label, ticked. */
function labelled(list, text) {
  const label = document.createElement("label");
  const box = Object.assign(document.createElement("input"), { type: "checkbox", checked: true });
  label.append(box, ` ${text}`);
  list.append(label);
  return box;
}
