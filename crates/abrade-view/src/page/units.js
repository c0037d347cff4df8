// Numbers as people read them: a unit that fits the size, ticks at round values.

const LENGTHS = [["m", 1], ["mm", 1e-3], ["µm", 1e-6], ["nm", 1e-9]];
const VOLUMES = [["m³", 1], ["cm³", 1e-6], ["mm³", 1e-9], ["µm³", 1e-18], ["nm³", 1e-27]];
const TIMES = [["s", 1], ["ms", 1e-3], ["µs", 1e-6], ["ns", 1e-9]];
const ENERGIES = [["kJ", 1e3], ["J", 1], ["mJ", 1e-3], ["µJ", 1e-6], ["nJ", 1e-9]];

/** The largest unit of `units` in which `value` [SI] is at least one, as [name, size]. */
function unitOf(value, units) {
  const fits = ([, size]) => Math.abs(value) >= size * (1 - 1e-9);
  return units.find(fits) ?? units[units.length - 1];
}

/** Millimetres for the extent of a view [m], unless it is too small or too large for them. */
function unitOfExtent(extent) {
  return extent < 1e-4 || extent >= 10 ? unitOf(extent, LENGTHS) : LENGTHS[1];
}

/** Cubic millimetres from a thousandth of one to a cubic centimetre; beyond, the unit that fits. */
function volume(value) {
  const isUsual = Math.abs(value) >= 1e-12 && Math.abs(value) < 1e-6;
  return quantity(value, isUsual ? VOLUMES.slice(2, 3) : VOLUMES);
}

/** `value` [SI] with four significant digits, in the unit that fits it or `scale` (another value). */
function quantity(value, units, scale = value) {
  const [name, size] = value === 0 && scale === 0 ? ["", 1] : unitOf(scale, units);
  return spaced(number(value / size), name);
}

function spaced(text, unit) {
  return unit ? `${text}\u00a0${unit}` : text;
}

/** Four significant digits, a true minus sign, a gap between thousands. */
function number(value) {
  const size = Math.abs(value);
  if (size === 0 || !Number.isFinite(value)) return String(value);
  if (size < 1e-3 || size >= 1e7) return raised(value);
  const decimals = Math.max(0, 3 - Math.floor(Math.log10(size)));
  return grouped(value.toFixed(decimals));
}

function raised(value) {
  const [digits, power] = value.toExponential(3).split("e");
  const over = { "-": "⁻", 0: "⁰", 1: "¹", 2: "²", 3: "³", 4: "⁴", 5: "⁵", 6: "⁶", 7: "⁷", 8: "⁸", 9: "⁹" };
  const exponent = [...String(Number(power))].map((c) => over[c]).join("");
  return `${signed(digits)}\u00a0×\u00a010${exponent}`;
}

function signed(text) {
  return text.replace("-", "−");
}

function grouped(text) {
  const [whole, rest] = text.split(".");
  const digits = whole.replace("-", "");
  const spacedWhole = digits.length < 5 ? whole : whole.replace(/\B(?=(\d{3})+$)/g, "\u00a0");
  return signed(rest === undefined ? spacedWhole : `${spacedWhole}.${rest}`);
}

/** `value` with its sign and `decimals`; never a negative zero. */
function fixed(value, decimals) {
  const text = value.toFixed(decimals);
  return signed(Number(text) === 0 ? text.replace("-", "") : text);
}

/** Round values from `low` to `high`, about `wanted` of them, and the decimals they need. */
function ticks(low, high, wanted) {
  const raw = (high - low) / wanted;
  if (!(raw > 0 && Number.isFinite(raw))) return { values: [], decimals: 0 };
  const decade = 10 ** Math.floor(Math.log10(raw));
  const step = decade * ([1, 2, 5].find((factor) => factor * decade >= raw * 0.999) ?? 10);
  const slack = 1e-9;
  const first = Math.ceil(low / step - slack);
  const last = Math.floor(high / step + slack);
  const values = [];
  for (let i = first; i <= last; i++) values.push(i * step);
  return { values, decimals: Math.max(0, Math.ceil(-Math.log10(step) - slack)) };
}
