/**
 * Colours for speeds: from slow to fast, told apart in light and dark, and by people who see red and green alike.
 */

// Blue to yellow over grey-green; every step is lighter than the one before.
const STOPS = [
  [52, 66, 160],
  [45, 112, 179],
  [40, 148, 163],
  [73, 178, 128],
  [148, 200, 83],
  [236, 205, 72],
];
export const STEPS = 32;

/**
 * The colours as CSS, slow first.
 * @returns {string[]}
 */
export function speedColours() {
  return Array.from({ length: STEPS }, (_, i) => {
    const place = (i / (STEPS - 1)) * (STOPS.length - 1);
    const low = Math.min(STOPS.length - 2, Math.floor(place));
    const mixed = STOPS[low].map((value, channel) =>
      Math.round(value + (place - low) * (STOPS[low + 1][channel] - value)),
    );
    return `rgb(${mixed.join(" ")})`;
  });
}

/** Whether the page is dark now. */
export function isDark() {
  return matchMedia("(prefers-color-scheme: dark)").matches;
}

/**
 * Call a function now and whenever the page turns dark or light.
 * @param {(theme: "light"|"dark") => void} use
 */
export function followTheme(use) {
  const query = matchMedia("(prefers-color-scheme: dark)");
  const tell = () => use(query.matches ? "dark" : "light");
  query.addEventListener("change", tell);
  tell();
}
