// Colours that charts and the 3D view need as values; the page itself follows the system by style.css.

const darkMode = matchMedia("(prefers-color-scheme: dark)");

export function isDark(): boolean {
  return darkMode.matches;
}

export function onThemeChange(listener: () => void): void {
  darkMode.addEventListener("change", listener);
}

/** The value of a custom property of style.css: styleColour("--text"). */
export function styleColour(property: string): string {
  return getComputedStyle(document.documentElement).getPropertyValue(property).trim();
}
