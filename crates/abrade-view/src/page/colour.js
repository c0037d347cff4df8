// Colours of depth: the run's own table, the bar that explains it.

/** A texture of the table, for the surfaces' shader. */
function colourTexture(colours) {
  const texels = new Uint8Array(4 * 256);
  for (let i = 0; i < 256; i++) {
    texels.set(colours.subarray(3 * i, 3 * i + 3), 4 * i);
    texels[4 * i + 3] = 255;
  }
  const texture = new THREE.DataTexture(texels, 256, 1);
  texture.colorSpace = THREE.SRGBColorSpace;
  texture.minFilter = texture.magFilter = THREE.LinearFilter;
  texture.needsUpdate = true;
  return texture;
}

/** Fills the colour bar: from no depth to the largest of the run. */
function drawColourBar(element, run) {
  const bar = element.querySelector(".bar");
  const labels = element.querySelector(".ticks");
  if (!(run.maxDepth > 0)) {
    element.querySelector(".name").textContent = "No wear";
    element.setAttribute("aria-label", "No wear at any instant");
    bar.remove();
    labels.remove();
    return;
  }
  const [unit, size] = unitOf(run.maxDepth, LENGTHS);
  const most = run.maxDepth / size;
  element.querySelector(".name").textContent = `Depth, ${unit}`;
  element.setAttribute("aria-label", `Colours of depth, from 0 to ${spaced(number(most), unit)}`);
  const stops = [];
  for (let i = 0; i < 256; i += 15) {
    stops.push(`rgb(${run.colours.subarray(3 * i, 3 * i + 3).join(" ")}) ${(100 * i) / 255}%`);
  }
  bar.style.background = `linear-gradient(to right, ${stops.join(", ")})`;
  const { values, decimals } = ticks(0, most, 4);
  for (const value of values) {
    const label = document.createElement("span");
    label.textContent = fixed(value, decimals);
    label.style.left = `${(100 * value) / most}%`;
    labels.append(label);
  }
}
